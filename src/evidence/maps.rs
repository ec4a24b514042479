//! Jacobians: which partial derivatives stand in which matrix.

use super::compiler::{Compiler, Unwitnessed};
use super::formula::{Formula, Formulas, Op};
use super::space::{Slot, Space};
use super::system::any;
use crate::claim::{Map, Statements, Vocabulary, flies};
use crate::tex::{Equation, Invariant, Name, Tree};

/// The derivatives of some quantities by others.
#[derive(Clone, Debug)]
pub struct Step {
    pub name: Name,
    pub of: Vec<usize>,
    pub by: Vec<usize>,
    /// The equations that are meant, where the vocabulary gives them.
    pub equations: Vec<Formula>,
    /// What each of `of` is, where the equations say so outright.
    pub images: Vec<Formula>,
    /// Whether a premise says something of what the map gives.
    pub is_led: bool,
}

/// All maps of a vocabulary.
#[derive(Clone, Debug, Default)]
pub struct Maps {
    pub steps: Vec<Step>,
    pub products: Vec<(Name, Vec<Name>)>,
    /// Whether no premise says anything of the maps: a trace is then a number of its own.
    pub opaque: bool,
}

impl Step {
    /// A derivative of an image.
    fn slope(&self, of: usize, by: usize, formulas: &mut Formulas) -> Option<Formula> {
        let place = self.of.iter().position(|known| *known == of)?;
        let image = *self.images.get(place)?;
        Some(formulas.slope(image, Op::Slot(by)))
    }
}

type Matrix = Vec<Vec<Formula>>;

fn partial(of: usize, by: usize, space: &mut Space, formulas: &mut Formulas) -> Formula {
    let slot = space.slot(Slot::Partial { of, by });
    formulas.slot(slot)
}

impl Maps {
    /// The derivative of one quantity by another, by the chain rule where impacts lie between.
    pub fn entry(&self, of: usize, by: usize, space: &mut Space, formulas: &mut Formulas) -> Option<Formula> {
        self.chain(of, by, space, formulas, self.steps.len())
    }

    fn chain(&self, of: usize, by: usize, space: &mut Space, formulas: &mut Formulas, left: usize) -> Option<Formula> {
        let starts = |step: &&Step| step.by.contains(&by);
        let explicit: Vec<&Step> = self
            .steps
            .iter()
            .filter(starts)
            .filter(|step| !step.images.is_empty())
            .collect();
        let leads = |step: &&&Step| step.of.contains(&of);
        let may_lead = |step: &Step| step.equations.is_empty() && (step.is_led || !explicit.iter().any(|e| leads(&e)));
        let here = || self.steps.iter().filter(starts).filter(|step| may_lead(step));
        if self
            .steps
            .iter()
            .any(|step| step.by.contains(&by) && step.by.contains(&of))
        {
            return Some(formulas.integer(i64::from(of == by)));
        }
        if here().any(|step| step.of.contains(&of)) {
            return Some(partial(of, by, space, formulas));
        }
        // where no premise leads, along the one explicit map that does
        let mut along = explicit.iter().filter(leads);
        if let (Some(step), None) = (along.next(), along.next()) {
            return step.slope(of, by, formulas);
        }
        if left == 0 {
            return None;
        }
        here().find_map(|step| {
            let mut terms = Vec::new();
            for &between in &step.of {
                let inner = partial(between, by, space, formulas);
                let outer = self.chain(of, between, space, formulas, left - 1)?;
                terms.push(formulas.multiply(outer, inner));
            }
            Some(formulas.sum(terms))
        })
    }

    /// Trace or determinant of a map.
    pub fn invariant(
        &self,
        kind: Invariant,
        name: &Name,
        space: &mut Space,
        formulas: &mut Formulas,
    ) -> Option<Formula> {
        let matrix = self.matrix(name, space, formulas, self.products.len() + 1)?;
        if matrix.is_empty() || matrix.iter().any(|row| row.len() != matrix.len()) {
            return None;
        }
        Some(match kind {
            Invariant::Trace => formulas.sum(matrix.iter().enumerate().filter_map(|(n, row)| row.get(n).copied())),
            Invariant::Determinant => determinant(&matrix, formulas),
        })
    }

    fn matrix(&self, name: &Name, space: &mut Space, formulas: &mut Formulas, left: usize) -> Option<Matrix> {
        if let Some(step) = self.steps.iter().find(|step| step.name == *name) {
            if !step.images.is_empty() {
                let mut row = |of: &usize| step.by.iter().map(|&by| step.slope(*of, by, formulas)).collect();
                return step.of.iter().map(&mut row).collect();
            }
            let mut row = |of: &usize| step.by.iter().map(|&by| partial(*of, by, space, formulas)).collect();
            return Some(step.of.iter().map(&mut row).collect());
        }
        let (_, factors) = self.products.iter().find(|(known, _)| known == name)?;
        let mut product: Option<Matrix> = None;
        for factor in factors {
            let next = (left > 0).then(|| self.matrix(factor, space, formulas, left - 1))??;
            product = Some(match product {
                Some(product) => multiplied(&product, &next, formulas)?,
                None => next,
            });
        }
        product
    }
}

fn multiplied(left: &Matrix, right: &Matrix, formulas: &mut Formulas) -> Option<Matrix> {
    let columns = right.first()?.len();
    if left.iter().any(|row| row.len() != right.len()) {
        return None;
    }
    let mut entry = |row: &[Formula], column: usize| {
        let pairs = row.iter().zip(right).filter_map(|(a, b)| Some((*a, *b.get(column)?)));
        let terms: Vec<Formula> = pairs.map(|(a, b)| formulas.multiply(a, b)).collect();
        formulas.sum(terms)
    };
    Some(
        left.iter()
            .map(|row| (0..columns).map(|column| entry(row, column)).collect())
            .collect(),
    )
}

/// By the first row: the matrices are small.
fn determinant(matrix: &Matrix, formulas: &mut Formulas) -> Formula {
    let Some((first, rest)) = matrix.split_first() else {
        return formulas.integer(1);
    };
    let mut terms = Vec::new();
    for (column, entry) in first.iter().enumerate() {
        let without = |row: &Vec<Formula>| {
            row.iter()
                .enumerate()
                .filter(|(n, _)| *n != column)
                .map(|(_, e)| *e)
                .collect()
        };
        let minor = determinant(&rest.iter().map(without).collect(), formulas);
        let term = formulas.multiply(*entry, minor);
        terms.push(if column % 2 == 0 {
            term
        } else {
            formulas.make(Op::Negate(term))
        });
    }
    formulas.sum(terms)
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
                    let slot = |tree: &Tree| match tree {
                        Tree::Symbol(name, _) => compiler.quantity(name),
                        _ => None,
                    };
                    trees.iter().filter_map(slot).collect()
                };
                Step {
                    name: name.clone(),
                    of: slots(of),
                    by: slots(by),
                    equations: Vec::new(),
                    images: Vec::new(),
                    is_led: false,
                }
            }
            Map::Equations(equations) => explicit(name, equations, compiler)?,
        };
        maps.steps.push(step);
    }
    Ok(maps)
}

impl Maps {
    /// Tells to which maps premises lead: those of which one names what the map gives, all where there are laws of flight.
    pub fn tell_led(&mut self, statements: &Statements, compiler: &mut Compiler) {
        let equations = || statements.premises.iter().map(|premise| &premise.equation);
        let vocabulary = compiler.vocabulary;
        let flies = equations().any(|equation| flies(equation, vocabulary));
        for step in &mut self.steps {
            let is_of = |tree: &Tree, compiler: &mut Compiler| match tree {
                Tree::Symbol(name, _) => compiler.quantity(name).is_some_and(|slot| step.of.contains(&slot)),
                _ => false,
            };
            let compiler = std::cell::RefCell::new(&mut *compiler);
            let names = |equation: &Equation| any(equation, &|tree| is_of(tree, &mut compiler.borrow_mut()));
            step.is_led = flies || equations().any(names);
        }
    }

    /// Adds the map from one impact to another where a derivative between them belongs to no map: all times and states
    /// of the one, each with the others held. An explicit map is that map only where no premise is `said` of the one.
    pub fn add_step(&mut self, of: &Name, by: &Name, said: bool, compiler: &mut Compiler) {
        let (Some(above), Some(below)) = (compiler.quantity(of), compiler.quantity(by)) else {
            return;
        };
        let is_explicit = |step: &Step| !step.equations.is_empty();
        let explicit = self.steps.iter().all(is_explicit) && said;
        if !explicit && self.entry(above, below, compiler.space, compiler.formulas).is_some() {
            return;
        }
        let vocabulary = compiler.vocabulary;
        let mut all = |subscript: &str| -> Vec<usize> {
            let families = vocabulary.times.iter().chain(&vocabulary.states);
            let indexed = families.map(|name| Name {
                subscript: subscript.to_string(),
                ..name.clone()
            });
            indexed.filter_map(|name| compiler.quantity(&name)).collect()
        };
        let step = Step {
            name: Name::default(),
            of: all(&of.subscript),
            by: all(&by.subscript),
            equations: Vec::new(),
            images: Vec::new(),
            is_led: said,
        };
        self.steps.push(step);
    }
}

/// The map from the first impact that its equations name to the last: times before states, as declared.
fn explicit(name: &Name, equations: &[Equation], compiler: &mut Compiler) -> Result<Step, Unwitnessed> {
    let (mut rows, mut sides) = (Vec::new(), Vec::new());
    for equation in equations {
        let (left, right) = (compiler.tree(&equation.left)?, compiler.tree(&equation.right)?);
        rows.push(compiler.formulas.subtract(left, right));
        sides.push((left, right));
    }
    let mut order: Vec<(i32, usize, usize)> = Vec::new();
    for slot in compiler.formulas.slots(&rows) {
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
        let there = order.iter().filter(|(i, ..)| Some(*i) == index);
        there.map(|(.., slot)| *slot).collect()
    };
    let (of, by): (Vec<usize>, Vec<usize>) = (side(order.last().map(|o| o.0)), side(order.first().map(|o| o.0)));
    let image = |slot: &usize| {
        let mut own = sides
            .iter()
            .filter(|(left, _)| compiler.formulas.op(*left) == Op::Slot(*slot));
        let (_, right) = own.next()?;
        let moves = compiler
            .formulas
            .slots(&[*right])
            .into_iter()
            .any(|slot| of.contains(&slot));
        (!moves && sides.len() == of.len()).then_some(*right)
    };
    let images: Option<Vec<Formula>> = of.iter().map(image).collect();
    Ok(Step {
        name: name.clone(),
        images: images.unwrap_or_default(),
        of,
        by,
        equations: rows,
        is_led: false,
    })
}

#[cfg(test)]
mod tests {
    use super::super::formula::{Inputs, Work};
    use super::*;

    #[test]
    fn the_determinant_of_three_rows() {
        let mut formulas = Formulas::default();
        let rows = [[2, 0, 1], [1, 3, 2], [1, 1, 4]];
        let matrix: Matrix = rows.map(|row| row.map(|n| formulas.integer(n)).to_vec()).to_vec();
        let determinant = determinant(&matrix, &mut formulas);
        let program = formulas.program(&[determinant]);
        let inputs = Inputs::<f64> {
            slots: &[],
            running: None,
            formulas: &formulas,
            work: &Work::new(1000),
            depth: 0,
        };
        assert_eq!(program.outputs(&program.run(&inputs)), [18.0]);
    }
}
