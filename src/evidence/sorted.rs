//! Premises by what kind they are of.

use super::compiler::Unwitnessed;
use super::flight::Law;
use super::maps::Maps;
use super::period::{Period, period_of};
use super::program::Node;
use super::question::any;
use super::space::{Slot, Space};
use super::system::compiler;
use crate::claim::{Statements, Vocabulary};
use crate::tex::{At, Equation, Tree};

/// What premises are sorted into.
#[derive(Default)]
pub struct Sorted {
    /// Said of times, states and parameters.
    pub rows: Vec<Node>,
    /// Said at every time of a flight.
    pub flights: Vec<Law>,
    /// Said of functions at every time.
    pub functions: Vec<Node>,
    pub periods: Vec<Period>,
    /// Said of derivatives.
    pub late: Vec<Node>,
}

impl Sorted {
    /// Reads all premises but those that speak of a trace or a determinant.
    ///
    /// # Errors
    /// [`Unwitnessed`] where something has no concrete form.
    pub fn read(
        statements: &Statements,
        vocabulary: &Vocabulary,
        space: &mut Space,
        maps: &Maps,
    ) -> Result<Self, Unwitnessed> {
        let (mut sorted, first) = (Self::default(), statements.first.unwrap_or(0));
        for statement in statements.premises.iter().filter(|s| !speaks_of_matrix(&s.equation)) {
            let flight = if statements.claim_runs {
                first
            } else {
                statement.first.unwrap_or(first)
            };
            let mut compiler = compiler(
                vocabulary,
                space,
                Some(maps),
                &statement.locals,
                statement.first,
                flight,
            );
            let sides = [
                compiler.tree(&statement.equation.left)?,
                compiler.tree(&statement.equation.right)?,
            ];
            sorted.sort(sides, space);
        }
        for equation in &vocabulary.relations {
            let mut compiler = compiler(vocabulary, space, Some(maps), &[], None, first);
            let sides = [compiler.tree(&equation.left)?, compiler.tree(&equation.right)?];
            sorted.sort(sides, space);
        }
        for (name, shift) in &vocabulary.periods {
            let mut compiler = compiler(vocabulary, space, Some(maps), &[], None, first);
            if let Node::Value { course, level, .. } = compiler.tree(&Tree::Symbol(name.clone(), At(0)))? {
                let shift = compiler.tree(shift)?;
                sorted.periods.push(Period { course, level, shift });
            }
        }
        Ok(sorted)
    }

    fn sort(&mut self, [left, right]: [Node; 2], space: &Space) {
        let is_partial = |node: &Node| match node {
            Node::Slot(slot) => matches!(space.slots.get(*slot), Some(Slot::Partial { .. })),
            _ => false,
        };
        if let Some(period) = period_of(&left, &right, space) {
            self.periods.push(period);
            return;
        }
        let node = left.minus(right);
        if node.any(is_partial) {
            self.late.push(node);
        } else if !node.any(|node| matches!(node, Node::Running)) {
            self.rows.push(node);
        } else {
            let flight = |course: usize| space.courses.get(course).and_then(|course| course.flight);
            match node.courses().into_iter().find(|&course| flight(course).is_some()) {
                Some(course) => self.flights.push(Law {
                    course,
                    start: flight(course).unwrap_or(0),
                    node,
                }),
                None => self.functions.push(node),
            }
        }
    }
}

/// Whether a trace or a determinant stands in an equation.
pub fn speaks_of_matrix(equation: &Equation) -> bool {
    any(equation, &|tree| matches!(tree, Tree::Invariant { .. }))
}
