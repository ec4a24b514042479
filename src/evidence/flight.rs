//! Laws that hold at every time, as equations for the coefficients of courses: asked at more times than there are
//! coefficients, a law of courses of this kind holds everywhere.

use super::compiler::Compiler;
use super::program::Node;
use super::system::Row;
use std::collections::BTreeSet;

/// A law of the flight that starts at an impact.
#[derive(Clone, Debug)]
pub struct Law {
    pub course: usize,
    pub start: i32,
    /// Zero at every running time.
    pub node: Node,
}

/// The times at which a law is asked: over all flights between four impacts, of no special kind. A course has at
/// most 10 coefficients.
const TIMES: [f64; 12] = [0.07, 0.39, 0.71, 1.03, 1.37, 1.67, 1.99, 2.31, 2.63, 2.93, 3.29, 3.61];

fn at(law: &Node, time: f64) -> Node {
    Node::At {
        time: Box::new(Node::Float(time)),
        body: Box::new(law.clone()),
    }
}

/// A law of functions alone.
pub fn everywhere(law: &Node, _start: usize) -> Vec<Row> {
    let row = |time| Row {
        node: at(law, time),
        impacts: BTreeSet::new(),
        in_flight: false,
    };
    TIMES.into_iter().map(row).collect()
}

/// The laws of flights, that they start with the states of their impact and, unless the claim has a running time of
/// its own, that they end with those of the next one.
pub fn rows(laws: &[Law], runs: bool, compiler: &mut Compiler) -> Vec<(i32, Node)> {
    let mut rows = Vec::new();
    for law in laws {
        rows.extend(TIMES.into_iter().map(|time| (law.start, at(&law.node, time))));
        let mut order = 0;
        law.node.walk(&mut |node| {
            if let Node::Value { course, level, .. } = node
                && *course == law.course
            {
                order = order.max(*level);
            }
        });
        let mut tie = |level: usize, index: i32, after: bool| {
            let name = compiler.space.courses.get(law.course)?.names.get(level)?.clone();
            if !compiler.vocabulary.states.contains(&name) {
                return None;
            }
            let time = Box::new(Node::Slot(compiler.time(index)));
            let state = Node::Slot(compiler.state(name, index, after));
            Some((
                law.start,
                Node::Value {
                    course: law.course,
                    level,
                    time,
                }
                .minus(state),
            ))
        };
        // A law of order n leaves n constants of integration to the start of the flight.
        rows.extend((0..order).filter_map(|level| tie(level, law.start, true)));
        if !runs {
            rows.extend((0..3).filter_map(|level| tie(level, law.start + 1, false)));
        }
    }
    rows
}
