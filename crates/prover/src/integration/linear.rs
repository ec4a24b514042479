//! Sparse linear systems over the numbers, or over the quotients of polynomials in the letters.

use super::fraction::Fraction;
use super::tower::Tower;
use num_traits::Zero;
use numbers::Rational;
use std::collections::BTreeMap;

/// An element of the field that a system is solved over.
pub(super) trait Scalar: Clone {
    fn is_nothing(&self) -> bool;
    /// `self - factor other`.
    fn less(&self, factor: &Self, other: &Self, tower: &mut Tower) -> Option<Self>;
    fn over(&self, other: &Self, tower: &mut Tower) -> Option<Self>;
    fn nothing() -> Self;
}

impl Scalar for Rational {
    fn is_nothing(&self) -> bool {
        self.is_zero()
    }

    fn less(&self, factor: &Self, other: &Self, tower: &mut Tower) -> Option<Self> {
        tower.steps.take(1).ok()?;
        Some(self.clone() - factor.clone() * other.clone())
    }

    fn over(&self, other: &Self, _: &mut Tower) -> Option<Self> {
        (!other.is_zero()).then(|| self.clone() / other.clone())
    }

    fn nothing() -> Self {
        Self::zero()
    }
}

impl Scalar for Fraction {
    fn is_nothing(&self) -> bool {
        self.is_zero()
    }

    fn less(&self, factor: &Self, other: &Self, tower: &mut Tower) -> Option<Self> {
        let part = tower
            .times(factor, other)?
            .scaled(&Rational(dashu_ratio::RBig::NEG_ONE));
        self.plus(&part, &mut tower.steps)
    }

    fn over(&self, other: &Self, tower: &mut Tower) -> Option<Self> {
        tower.over(self, other)
    }

    fn nothing() -> Self {
        Self::integer(0)
    }
}

/// An equation: the sum of unknowns, each by its factor, is the right side.
#[derive(Clone, Debug)]
pub(super) struct Row<S> {
    pub factors: BTreeMap<usize, S>,
    pub right: S,
}

/// A solution, where what is free is 0 and not listed; `None` where there is none.
pub(super) fn solve<S: Scalar>(mut rows: Vec<Row<S>>, tower: &mut Tower) -> Option<BTreeMap<usize, S>> {
    let mut solved: Vec<(usize, Row<S>)> = Vec::new();
    loop {
        if rows.iter().any(|row| row.factors.is_empty() && !row.right.is_nothing()) {
            return None;
        }
        rows.retain(|row| !row.factors.is_empty());
        let shortest = rows.iter().enumerate().min_by_key(|(_, row)| row.factors.len());
        let Some((place, _)) = shortest else { break };
        let row = rows.swap_remove(place);
        let mut occurrences: BTreeMap<usize, usize> = row.factors.keys().map(|unknown| (*unknown, 0)).collect();
        for other in &rows {
            for unknown in other.factors.keys() {
                occurrences.entry(*unknown).and_modify(|count| *count += 1);
            }
        }
        tower.steps.take(1 + rows.len() as u64).ok()?;
        let (pivot, _) = occurrences.into_iter().min_by_key(|(_, count)| *count)?;
        let by = row.factors.get(&pivot)?.clone();
        for other in &mut rows {
            eliminate(other, &row, pivot, &by, tower)?;
        }
        solved.push((pivot, row));
    }
    let mut solution: BTreeMap<usize, S> = BTreeMap::new();
    for (pivot, row) in solved.into_iter().rev() {
        let mut right = row.right;
        for (unknown, factor) in row.factors.iter().filter(|(unknown, _)| **unknown != pivot) {
            if let Some(value) = solution.get(unknown) {
                right = right.less(factor, value, tower)?;
            }
        }
        let value = right.over(row.factors.get(&pivot)?, tower)?;
        if !value.is_nothing() {
            solution.insert(pivot, value);
        }
    }
    Some(solution)
}

fn eliminate<S: Scalar>(other: &mut Row<S>, row: &Row<S>, pivot: usize, by: &S, tower: &mut Tower) -> Option<()> {
    let Some(own) = other.factors.remove(&pivot) else {
        return Some(());
    };
    let multiple = own.over(by, tower)?;
    for (unknown, factor) in row.factors.iter().filter(|(unknown, _)| **unknown != pivot) {
        let before = other.factors.remove(unknown).unwrap_or_else(S::nothing);
        let after = before.less(&multiple, factor, tower)?;
        if !after.is_nothing() {
            other.factors.insert(*unknown, after);
        }
    }
    other.right = other.right.less(&multiple, &row.right, tower)?;
    Some(())
}
