//! Edits that may mend the claim, before anything is tried.

use super::edit::Edit;
use super::path::Path;

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
use crate::evidence::sampled::Value;
