//! The formulas of a claim that may be wrong, and edits that may mend it, before anything is tried.

use super::Part;
use super::edit::Edit;
use super::path::{Path, size};
use crate::evidence::sampled::Value;
use crate::tex::{Equation, Name, Tree, any_side};

/// A formula of the claim that may be wrong.
#[derive(Clone, Debug)]
pub struct Formula {
    pub part: Part,
    pub equation: Equation,
    /// The name that it defines.
    pub name: Option<Name>,
    /// Whether it is a link of a chain that begins with the right side of the formula before it.
    pub continues: bool,
}

impl Formula {
    /// The number of nodes.
    pub fn size(&self) -> u32 {
        size(&self.equation.left) + size(&self.equation.right)
    }

    /// Its sides that can change by themselves, each with its number.
    pub fn sides(&self) -> impl Iterator<Item = (usize, &Tree)> {
        let is_bound = self.name.is_some() || self.continues;
        let sides = [&self.equation.left, &self.equation.right].into_iter().enumerate();
        sides.filter(move |(side, _)| *side == 1 || !is_bound)
    }

    /// Whether a sum, an integral, a derivative or the like stands in it.
    pub fn has_operation(&self) -> bool {
        any_side(&self.equation, &mut |node| matches!(node, Tree::Operation(..)))
    }
}

/// An edit of a place.
#[derive(Clone, Debug)]
pub struct Candidate {
    pub formula: usize,
    pub path: Path,
    pub edit: Edit,
}

/// An edit with what it makes of a node of the graph.
#[derive(Clone, Debug)]
pub struct Valued {
    pub candidate: Candidate,
    pub node: usize,
    pub values: Vec<Value>,
}
