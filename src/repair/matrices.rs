//! Matrices that may be missing as factors.

use super::candidate::Candidate;
use super::context::Context;
use super::edit::{self, missing_factor, product};
use super::graph::{Graph, Node};
use super::path::{size, walk};
use crate::evidence::sampled::{Leaves, Value};
use crate::tex::{Name, Tree, with_symbol};
use std::collections::HashMap;

/// The most matrices that are put in, and the most nodes of one.
const MOST: usize = 160;
const LONGEST: u32 = 90;

/// Every edit that puts a matrix of the claim or its premises in as a factor: as it stands there, or with another symbol, or
/// the opposite, in the place of one.
pub fn inserted(
    graph: &Graph,
    context: &Context,
    leaves: &Leaves,
    definitions: &HashMap<Name, Tree>,
) -> Vec<Candidate> {
    let is_matrix = |value: Option<&Value>| matches!(value, Some(Value::Matrix(_)));
    let places = graph.nodes.iter().filter(|node| is_matrix(node.values.first()));
    let places: Vec<&Node> = places.filter(|node| !is_product(node.within.as_ref())).collect();
    if places.is_empty() {
        return Vec::new();
    }
    let is_one = |tree: &&Tree| size(tree) <= LONGEST && is_matrix(Some(&leaves.value(tree, 0, definitions)));
    let known: Vec<&Tree> = context.terms.iter().filter(is_one).collect();
    let mut matrices: Vec<Tree> = known.iter().map(|tree| (*tree).clone()).collect();
    for tree in known {
        for new in variants(tree, context) {
            if !matrices.contains(&new) {
                matrices.push(new);
            }
        }
    }
    matrices.truncate(MOST);
    let mut found = Vec::new();
    for node in places {
        let factors = match &node.tree {
            Tree::Product(factors) => factors.clone(),
            other => vec![other.clone()],
        };
        for matrix in &matrices {
            for place in 0..=factors.len() {
                let mut all = factors.clone();
                all.insert(place, matrix.clone());
                found.push(Candidate {
                    formula: node.place.0,
                    path: node.place.1.clone(),
                    edit: edit::Edit {
                        tree: product(all),
                        ..missing_factor(matrix, &node.tree, true)
                    },
                });
            }
        }
    }
    found
}

fn is_product(tree: Option<&Tree>) -> bool {
    matches!(tree, Some(Tree::Product(_)))
}

/// A matrix with another symbol, or the opposite, in the place of each of its symbols.
fn variants(tree: &Tree, context: &Context) -> Vec<Tree> {
    let mut names: Vec<Name> = Vec::new();
    walk(tree, None, &mut Vec::new(), &mut |node, _, _| match node {
        Tree::Symbol(name, _) if !names.contains(name) => names.push(name.clone()),
        _ => {}
    });
    let mut found = Vec::new();
    for name in &names {
        for atom in &context.atoms {
            match atom {
                Tree::Symbol(other, _) if other == name => {
                    let opposite = Tree::Negate(Box::new(atom.clone()));
                    found.push(with_symbol(tree, name, &opposite));
                }
                Tree::Symbol(..) => found.push(with_symbol(tree, name, atom)),
                _ => {}
            }
        }
    }
    found
}
