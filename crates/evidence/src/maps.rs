//! Jacobians: which partial derivatives stand in which matrix.

use super::formula::{Formula, Formulas, Op};
use super::space::{Slot, Space};
use texmath::{Invariant, Name};

/// The derivatives of some quantities by others.
#[derive(Clone, Debug)]
pub struct Step {
    pub name: Name,
    pub of: Vec<usize>,
    pub by: Vec<usize>,
    /// The equations that are meant, where the symbol table gives them.
    pub equations: Vec<Formula>,
    /// What each of `of` is, where the equations say so outright.
    pub images: Vec<Formula>,
    /// Whether a premise says something of what the map gives.
    pub is_led: bool,
}

/// All maps of a symbol table.
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
