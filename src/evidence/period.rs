//! `f(t) = f(t + T)`: a premise that gives a course its shape.

use super::program::{Env, Node};
use super::space::Space;

/// That a member of a course, and all below it, repeats.
#[derive(Clone, Debug)]
pub struct Period {
    pub course: usize,
    pub level: usize,
    pub shift: Node,
}

/// The period that an equation declares, if that is all it does.
pub fn period_of(left: &Node, right: &Node, space: &Space) -> Option<Period> {
    let value = |node: &Node| match node {
        Node::Value { course, level, time } => Some((*course, *level, time.as_ref().clone())),
        _ => None,
    };
    let is_zero = |node: &Node| matches!(node, Node::Number(0, _));
    let pair = match (left, right) {
        (Node::Sum(parts), zero) | (zero, Node::Sum(parts)) if is_zero(zero) => match parts.as_slice() {
            [a, Node::Negate(b)] | [Node::Negate(b), a] => (value(a)?, value(b)?),
            _ => return None,
        },
        (left, right) => (value(left)?, value(right)?),
    };
    let ((course, level, early), (other, same, late)) = pair;
    if course != other || level != same {
        return None;
    }
    // Both times must run as fast as t does.
    let values: Vec<f64> = (0..space.slots.len()).map(|n| 0.3 + (n as f64 * 0.7).sin()).collect();
    let at = |time: &Node, running: f64| {
        let env = Env {
            values: &values,
            running: Some(running),
            upper: None,
            courses: &space.courses,
        };
        time.value(&env)
    };
    let runs = |time: &Node| ((at(time, 1.5) - at(time, 0.5)) - 1.0).abs() < 1e-12;
    let shift = late.clone().minus(early.clone());
    if !runs(&early) || !runs(&late) || at(&shift, 0.0).abs() < 1e-12 {
        return None;
    }
    let time = Box::new(Node::Number(0, 1));
    Some(Period {
        course,
        level,
        shift: Node::At {
            time,
            body: Box::new(shift),
        },
    })
}

impl Period {
    /// What is zero where the course repeats so.
    pub fn checks(&self) -> Vec<Node> {
        let value = |time| Node::Value {
            course: self.course,
            level: self.level,
            time: Box::new(time),
        };
        let times = [0.137, 0.791, 1.523].map(Node::Float);
        let check = |time: Node| value(time.clone()).minus(value(Node::Sum(vec![time, self.shift.clone()])));
        times.into_iter().map(check).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(time: Node) -> Node {
        Node::Value {
            course: 0,
            level: 1,
            time: Box::new(time),
        }
    }

    #[test]
    fn a_shift_of_the_running_time_is_a_period_and_nothing_else() {
        let space = Space::default();
        let later = |shift| Node::Sum(vec![Node::Running, shift]);
        let found = period_of(&at(Node::Running), &at(later(Node::Number(3, 2))), &space).unwrap();
        let env = Env {
            values: &[],
            running: None,
            upper: None,
            courses: &[],
        };
        assert_eq!((found.level, found.shift.value::<f64>(&env)), (1, 1.5));
        let twice = Node::Product(vec![Node::Number(2, 1), Node::Running]);
        assert!(period_of(&at(Node::Running), &at(twice), &space).is_none());
        assert!(period_of(&at(Node::Running), &at(Node::Running), &space).is_none());
        assert!(period_of(&at(Node::Running), &Node::Number(1, 1), &space).is_none());
    }
}
