//! Jacobians: which partial derivatives stand in which matrix.

use super::compiler::{Compiler, Unwitnessed};
use super::program::Node;
use super::space::{Slot, Space};
use crate::claim::{Map, Vocabulary};
use crate::tex::{Equation, Invariant, Name, Tree};

/// The derivatives of some quantities by others.
#[derive(Clone, Debug)]
pub struct Step {
    pub name: Name,
    pub of: Vec<usize>,
    pub by: Vec<usize>,
    /// The equations that are meant, where the vocabulary gives them.
    pub equations: Vec<Node>,
}

/// All maps of a vocabulary.
#[derive(Clone, Debug, Default)]
pub struct Maps {
    pub steps: Vec<Step>,
    pub products: Vec<(Name, Vec<Name>)>,
    /// Whether no premise says anything of the maps: a trace is then a number of its own.
    pub opaque: bool,
}

type Matrix = Vec<Vec<Node>>;

impl Maps {
    /// The derivative of one quantity by another, by the chain rule where impacts lie between.
    pub fn entry(&self, of: usize, by: usize, space: &mut Space) -> Option<Node> {
        self.chain(of, by, space, self.steps.len())
    }

    fn chain(&self, of: usize, by: usize, space: &mut Space, left: usize) -> Option<Node> {
        let here = || self.steps.iter().filter(|step| step.by.contains(&by));
        if here().any(|step| step.of.contains(&of)) {
            return Some(Node::Slot(space.slot(Slot::Partial { of, by })));
        }
        if left == 0 {
            return None;
        }
        here().find_map(|step| {
            let terms = step.of.iter().map(|&between| {
                let inner = Node::Slot(space.slot(Slot::Partial { of: between, by }));
                Some(Node::Product(vec![self.chain(of, between, space, left - 1)?, inner]))
            });
            terms.collect::<Option<Vec<_>>>().map(Node::Sum)
        })
    }

    /// Trace or determinant of a map.
    pub fn invariant(&self, kind: Invariant, name: &Name, space: &mut Space) -> Option<Node> {
        let matrix = self.matrix(name, space, self.products.len() + 1)?;
        if matrix.iter().any(|row| row.len() != matrix.len()) {
            return None;
        }
        Some(match kind {
            Invariant::Trace => Node::Sum(
                matrix
                    .iter()
                    .enumerate()
                    .filter_map(|(n, row)| row.get(n).cloned())
                    .collect(),
            ),
            Invariant::Determinant => determinant(&matrix),
        })
    }

    fn matrix(&self, name: &Name, space: &mut Space, left: usize) -> Option<Matrix> {
        if let Some(step) = self.steps.iter().find(|step| step.name == *name) {
            let mut entry = |of: usize, by: usize| Node::Slot(space.slot(Slot::Partial { of, by }));
            return Some(
                step.of
                    .iter()
                    .map(|&of| step.by.iter().map(|&by| entry(of, by)).collect())
                    .collect(),
            );
        }
        let (_, factors) = self.products.iter().find(|(known, _)| known == name)?;
        let mut product: Option<Matrix> = None;
        for factor in factors {
            let next = (left > 0).then(|| self.matrix(factor, space, left - 1))??;
            product = Some(match product {
                Some(product) => multiplied(&product, &next)?,
                None => next,
            });
        }
        product
    }
}

fn multiplied(left: &Matrix, right: &Matrix) -> Option<Matrix> {
    let columns = right.first()?.len();
    if left.iter().any(|row| row.len() != right.len()) {
        return None;
    }
    let entry = |row: &[Node], column: usize| {
        let pairs = row.iter().zip(right).filter_map(|(a, b)| Some((a, b.get(column)?)));
        Node::Sum(pairs.map(|(a, b)| Node::Product(vec![a.clone(), b.clone()])).collect())
    };
    Some(
        left.iter()
            .map(|row| (0..columns).map(|column| entry(row, column)).collect())
            .collect(),
    )
}

/// By the first row: the matrices are small.
fn determinant(matrix: &Matrix) -> Node {
    let Some((first, rest)) = matrix.split_first() else {
        return Node::Number(1, 1);
    };
    let terms = first.iter().enumerate().map(|(column, entry)| {
        let minor: Matrix = rest
            .iter()
            .map(|row| {
                row.iter()
                    .enumerate()
                    .filter(|(n, _)| *n != column)
                    .map(|(_, node)| node.clone())
                    .collect()
            })
            .collect();
        let term = Node::Product(vec![entry.clone(), determinant(&minor)]);
        if column % 2 == 0 {
            term
        } else {
            Node::Negate(Box::new(term))
        }
    });
    Node::Sum(terms.collect())
}

/// The maps of a vocabulary.
///
/// # Errors
/// [`Unwitnessed`] where the equations of a map have no concrete form.
pub fn read_maps(vocabulary: &Vocabulary, compiler: &mut Compiler) -> Result<Maps, Unwitnessed> {
    let mut maps = Maps::default();
    for (name, map) in &vocabulary.maps {
        let step = match map {
            Map::Product(factors) => {
                maps.products.push((name.clone(), factors.clone()));
                continue;
            }
            Map::Premises { of, by } => {
                let mut slots = |trees: &[Tree]| {
                    trees
                        .iter()
                        .filter_map(|tree| match tree {
                            Tree::Symbol(name, _) => compiler.quantity(name),
                            _ => None,
                        })
                        .collect()
                };
                Step {
                    name: name.clone(),
                    of: slots(of),
                    by: slots(by),
                    equations: Vec::new(),
                }
            }
            Map::Equations(equations) => explicit(name, equations, compiler)?,
        };
        maps.steps.push(step);
    }
    Ok(maps)
}

/// The map from the first impact that its equations name to the last: times before states, as declared.
fn explicit(name: &Name, equations: &[Equation], compiler: &mut Compiler) -> Result<Step, Unwitnessed> {
    let mut nodes = Vec::new();
    for equation in equations {
        let left = compiler.tree(&equation.left)?;
        nodes.push(left.minus(compiler.tree(&equation.right)?));
    }
    let mut order: Vec<(i32, usize, usize)> = Vec::new();
    for slot in nodes.iter().flat_map(Node::written) {
        match compiler.space.slots.get(slot) {
            Some(Slot::Time { index, .. }) => order.push((*index, 0, slot)),
            Some(Slot::State { state, index, .. }) => {
                let rank = compiler.vocabulary.states.iter().position(|known| known == state);
                order.push((*index, rank.map_or(usize::MAX, |rank| rank + 1), slot));
            }
            _ => {}
        }
    }
    order.sort_unstable();
    order.dedup();
    let side = |index: Option<i32>| {
        order
            .iter()
            .filter(|(i, ..)| Some(*i) == index)
            .map(|(.., slot)| *slot)
            .collect()
    };
    let (of, by) = (side(order.last().map(|o| o.0)), side(order.first().map(|o| o.0)));
    Ok(Step {
        name: name.clone(),
        of,
        by,
        equations: nodes,
    })
}

#[cfg(test)]
mod tests {
    use super::super::program::Env;
    use super::*;

    #[test]
    fn the_determinant_of_three_rows() {
        let rows = [[2, 0, 1], [1, 3, 2], [1, 1, 4]];
        let matrix: Matrix = rows
            .iter()
            .map(|row| row.iter().map(|&n| Node::Number(n, 1)).collect())
            .collect();
        let env = Env {
            values: &[],
            running: None,
            upper: None,
            courses: &[],
        };
        assert_eq!(determinant(&matrix).value::<f64>(&env), 18.0);
    }
}
