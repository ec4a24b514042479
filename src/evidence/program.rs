//! A formula with its names resolved to slots, so that it is evaluated often without a look at a name.

use super::course::Course;
use crate::number::Analytic;

/// A formula over slots.
#[derive(Clone, Debug)]
pub enum Node {
    /// A ratio of integers.
    Number(i64, i64),
    /// A number beyond those.
    Float(f64),
    Pi,
    Slot(usize),
    /// The running time of a flight.
    Running,
    /// The value of a member of a course at a time.
    Value {
        course: usize,
        level: usize,
        time: Box<Node>,
    },
    /// The body with the running time put in.
    At {
        time: Box<Node>,
        body: Box<Node>,
    },
    Negate(Box<Node>),
    Sum(Vec<Node>),
    Product(Vec<Node>),
    Quotient(Box<Node>, Box<Node>),
    Power(Box<Node>, i32),
    Root(Box<Node>),
    /// `\pm` (true) or `\mp`.
    Signed(Box<Node>, bool),
}

/// What a formula is evaluated with.
#[derive(Clone, Debug)]
pub struct Env<'a, T> {
    pub values: &'a [T],
    pub running: Option<T>,
    /// Which sign `\pm` stands for.
    pub upper: Option<bool>,
    pub courses: &'a [Course],
}

impl<T: Analytic> Env<'_, T> {
    /// The value of a slot; NaN where there is none.
    pub fn slot(&self, slot: usize) -> T {
        self.values.get(slot).cloned().unwrap_or_else(|| T::from_f64(f64::NAN))
    }

    fn course(&self, course: usize, level: usize, time: &T) -> T {
        match self.courses.get(course) {
            Some(known) => known.value(level, time, self),
            None => T::from_f64(f64::NAN),
        }
    }

    /// The same with another running time.
    pub fn at(&self, time: T) -> Self {
        Self {
            values: self.values,
            running: Some(time),
            upper: self.upper,
            courses: self.courses,
        }
    }
}

impl Node {
    /// `self - other`.
    pub fn minus(self, other: Self) -> Self {
        Self::Sum(vec![self, Self::Negate(Box::new(other))])
    }

    /// The value.
    pub fn value<T: Analytic>(&self, env: &Env<T>) -> T {
        match self {
            Self::Number(above, 1) => T::from_integer(*above),
            Self::Number(above, below) => T::from_ratio(*above, *below),
            Self::Float(value) => T::from_f64(*value),
            Self::Pi => T::pi(),
            Self::Slot(slot) => env.slot(*slot),
            Self::Running => env.running.clone().unwrap_or_else(|| T::from_f64(f64::NAN)),
            Self::Value { course, level, time } => env.course(*course, *level, &time.value(env)),
            Self::At { time, body } => body.value(&env.at(time.value(env))),
            Self::Negate(body) => -body.value(env),
            Self::Sum(terms) => terms.iter().fold(T::zero(), |sum, term| sum + term.value(env)),
            Self::Product(factors) => factors
                .iter()
                .fold(T::one(), |product, factor| product * factor.value(env)),
            Self::Quotient(above, below) => {
                let below = below.value(env);
                divided(above.value(env), below)
            }
            Self::Power(base, exponent) => {
                let power = base.value(env).to_power(exponent.abs());
                if *exponent < 0 { divided(T::one(), power) } else { power }
            }
            Self::Root(radicand) => radicand.value(env).sqrt(),
            Self::Signed(body, plus) => match env.upper {
                Some(upper) if upper == *plus => body.value(env),
                Some(_) => -body.value(env),
                None => T::from_f64(f64::NAN),
            },
        }
    }

    /// The value, and the size of the terms it is made of: what a rounding error is to be compared with.
    pub fn sized(&self, env: &Env<f64>) -> (f64, f64) {
        match self {
            Self::At { time, body } => body.sized(&env.at(time.value(env))),
            Self::Negate(body) => {
                let (value, size) = body.sized(env);
                (-value, size)
            }
            Self::Signed(body, _) => (self.value(env), body.sized(env).1),
            Self::Sum(terms) => terms
                .iter()
                .map(|term| term.sized(env))
                .fold((0.0, 0.0), |(v, s), (a, b)| (v + a, s + b)),
            Self::Product(factors) => factors
                .iter()
                .map(|factor| factor.sized(env))
                .fold((1.0, 1.0), |(v, s), (a, b)| (v * a, s * b)),
            Self::Quotient(above, below) => {
                let ((value, size), below) = (above.sized(env), below.value(env));
                (value / below, size / below.abs())
            }
            Self::Power(base, exponent) if *exponent >= 0 => {
                let (value, size) = base.sized(env);
                (value.powi(*exponent), size.powi(*exponent))
            }
            _ => {
                let value = self.value(env);
                (value, value.abs())
            }
        }
    }

    /// Calls `visit` on this node and on all below it, outside the periods of courses.
    pub fn walk(&self, visit: &mut impl FnMut(&Self)) {
        visit(self);
        match self {
            Self::Value { time: body, .. } | Self::Negate(body) | Self::Power(body, _) => body.walk(visit),
            Self::Root(body) | Self::Signed(body, _) => body.walk(visit),
            Self::At { time: a, body: b } | Self::Quotient(a, b) => {
                a.walk(visit);
                b.walk(visit);
            }
            Self::Sum(parts) | Self::Product(parts) => parts.iter().for_each(|part| part.walk(visit)),
            Self::Number(..) | Self::Float(_) | Self::Pi | Self::Slot(_) | Self::Running => {}
        }
    }

    /// Whether any node below passes the test.
    pub fn any(&self, test: impl Fn(&Self) -> bool) -> bool {
        let mut found = false;
        self.walk(&mut |node| found |= test(node));
        found
    }

    /// The slots written in the formula, in order; those of courses and periods are left out.
    pub fn written(&self) -> Vec<usize> {
        let mut slots = Vec::new();
        self.walk(&mut |node| {
            if let Self::Slot(slot) = node {
                slots.push(*slot);
            }
        });
        slots.sort_unstable();
        slots.dedup();
        slots
    }

    /// The courses in the formula.
    pub fn courses(&self) -> Vec<usize> {
        let mut found = Vec::new();
        self.walk(&mut |node| {
            if let Self::Value { course, .. } = node {
                found.push(*course);
            }
        });
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Every slot that the value depends on.
    pub fn slots(&self, courses: &[Course]) -> Vec<usize> {
        let mut slots = self.written();
        for course in self.courses().into_iter().filter_map(|course| courses.get(course)) {
            slots.extend(course.slots());
            slots.extend(course.period.iter().flat_map(|period| period.written()));
        }
        slots.sort_unstable();
        slots.dedup();
        slots
    }
}

/// A quotient that is no number where there is nothing to divide by, in every number type.
fn divided<T: Analytic>(above: T, below: T) -> T {
    // Duals compare as zero by value alone: a dual number over zero has no value either.
    if below.is_zero() {
        T::from_f64(f64::NAN)
    } else {
        above / below
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_knows_the_size_of_its_terms() {
        let node = Node::Product(vec![Node::Number(2, 1), Node::Slot(0).minus(Node::Slot(1))]);
        let env = Env {
            values: &[5.0, 4.0],
            running: None,
            upper: None,
            courses: &[],
        };
        assert_eq!(node.sized(&env), (2.0, 18.0));
        assert_eq!(node.value(&env), 2.0);
        assert_eq!(node.written(), [0, 1]);
    }

    #[test]
    fn nothing_is_divided_by_zero() {
        let node = Node::Quotient(Box::new(Node::Number(1, 1)), Box::new(Node::Slot(0)));
        let env = Env {
            values: &[0.0_f64],
            running: None,
            upper: None,
            courses: &[],
        };
        assert!(node.value(&env).is_nan());
    }
}
