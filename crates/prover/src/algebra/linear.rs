//! Linear algebra over the rationals, without fractions: rows of integers without a common factor.

use super::coefficient::Coefficient;
use super::steps::{Result, Steps};
use dashu_int::ops::Gcd;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use num_traits::Zero;
use numbers::Rational;

/// Rows in echelon form: each has its first entry that is not 0, its pivot, in a column where no other row has one.
#[derive(Clone, Debug, Default)]
pub(super) struct Echelon {
    /// How many columns may hold pivots; further ones are only carried along.
    columns: usize,
    /// The rows with the columns of their pivots, these ascending.
    rows: Vec<(usize, Vec<IBig>)>,
}

impl Echelon {
    pub(super) fn new(columns: usize) -> Self {
        Self {
            columns,
            rows: Vec::new(),
        }
    }

    /// How many rows are independent.
    pub(super) fn rank(&self) -> usize {
        self.rows.len()
    }

    /// Adds a row; where it depends on the others in the columns of pivots, what is left of it behind them.
    pub(super) fn insert(&mut self, mut row: Vec<IBig>, steps: &mut Steps) -> Result<Option<Vec<IBig>>> {
        for (pivot, known) in &self.rows {
            if row[*pivot].is_zero() {
                continue;
            }
            let (factor, multiple) = row[*pivot].cancel(&known[*pivot]);
            steps.take(row.len() as u64 * (factor.cost() + multiple.cost()))?;
            for (value, other) in row.iter_mut().zip(known) {
                *value = &*value * &factor - other * &multiple;
            }
            remove_content(&mut row);
        }
        match row[..self.columns].iter().position(|value| !value.is_zero()) {
            Some(pivot) => {
                let place = self.rows.partition_point(|(other, _)| *other < pivot);
                self.rows.insert(place, (pivot, row));
                Ok(None)
            }
            None => Ok(Some(row.split_off(self.columns))),
        }
    }
}

/// Divides by the common factor of the entries.
pub(super) fn remove_content(row: &mut [IBig]) {
    let content = (row.iter().filter(|value| !value.is_zero())).fold(UBig::ZERO, |content, value| content.gcd(value));
    if !content.is_zero() && !content.is_one() {
        let content = IBig::from(content);
        row.iter_mut().for_each(|value| *value /= &content);
    }
}

/// The row times the least common denominator.
pub(super) fn integral_row<'a>(row: impl IntoIterator<Item = &'a RBig> + Clone) -> Vec<IBig> {
    let common = row.clone().into_iter().fold(UBig::ONE, |common, value| {
        let other = value.denominator();
        &common / (&common).gcd(other) * other
    });
    let scaled = |value: &RBig| value.numerator() * IBig::from(&common / value.denominator());
    row.into_iter().map(scaled).collect()
}

/// The rank of a matrix, given by its rows.
pub fn rank(rows: &[Vec<Rational>], steps: &mut Steps) -> Result<usize> {
    let mut echelon = Echelon::new(rows.first().map_or(0, Vec::len));
    for row in rows {
        echelon.insert(integral_row(row.iter().map(|value| &value.0)), steps)?;
    }
    Ok(echelon.rank())
}

/// A solution x of `rows x = right`, with 0 for unknowns that are free; `None` where there is none.
pub fn solve(rows: &[Vec<Rational>], right: &[Rational], steps: &mut Steps) -> Result<Option<Vec<Rational>>> {
    let columns = rows.first().map_or(0, Vec::len);
    let mut echelon = Echelon::new(columns);
    for (row, value) in rows.iter().zip(right) {
        let row = integral_row(row.iter().chain([value]).map(|value| &value.0));
        if let Some(rest) = echelon.insert(row, steps)?
            && rest.iter().any(|value| !value.is_zero())
        {
            return Ok(None);
        }
    }
    let mut solution = vec![Rational::zero(); columns];
    for (pivot, row) in echelon.rows.iter().rev() {
        solution[*pivot] = Rational(back_substituted(
            row,
            *pivot,
            &solution,
            RBig::from(row[columns].clone()),
            steps,
        )?);
    }
    Ok(Some(solution))
}

/// A basis of the vectors x with `rows x = 0`.
pub fn null_space(rows: &[Vec<Rational>], columns: usize, steps: &mut Steps) -> Result<Vec<Vec<Rational>>> {
    let mut echelon = Echelon::new(columns);
    for row in rows {
        echelon.insert(integral_row(row.iter().map(|value| &value.0)), steps)?;
    }
    let mut basis = Vec::new();
    for free in (0..columns).filter(|free| echelon.rows.iter().all(|(pivot, _)| pivot != free)) {
        let mut vector = vec![Rational::zero(); columns];
        vector[free] = Rational(RBig::ONE);
        for (pivot, row) in echelon.rows.iter().rev().filter(|(pivot, _)| *pivot < free) {
            vector[*pivot] = Rational(back_substituted(row, *pivot, &vector, RBig::ZERO, steps)?);
        }
        basis.push(vector);
    }
    Ok(basis)
}

/// The unknown at the pivot, where those behind it are known.
fn back_substituted(row: &[IBig], pivot: usize, known: &[Rational], right: RBig, steps: &mut Steps) -> Result<RBig> {
    let mut sum = right;
    for (coefficient, value) in row.iter().zip(known).skip(pivot + 1) {
        if !coefficient.is_zero() && !value.0.is_zero() {
            steps.take(coefficient.cost())?;
            sum -= &value.0 * coefficient;
        }
    }
    Ok(sum / &row[pivot])
}

#[cfg(test)]
mod tests {
    use super::super::testing::plenty;
    use super::*;
    use proptest::prelude::*;

    fn product(rows: &[Vec<Rational>], x: &[Rational]) -> Vec<Rational> {
        let row = |row: &Vec<Rational>| {
            row.iter()
                .zip(x)
                .fold(Rational::zero(), |sum, (a, b)| sum + a.clone() * b.clone())
        };
        rows.iter().map(row).collect()
    }

    proptest! {
        #[test]
        fn solutions_solve(
            entries in prop::collection::vec(-3i64..=3, 20),
            x in prop::collection::vec(-3i64..=3, 5),
            right in prop::collection::vec(-3i64..=3, 4),
        ) {
            let rational = |list: &[i64]| list.iter().map(|&n| Rational::new(n, 2).unwrap()).collect::<Vec<_>>();
            let rows: Vec<Vec<Rational>> = entries.chunks(5).map(rational).collect();
            let b = product(&rows, &rational(&x));
            let solution = solve(&rows, &b, &mut plenty()).unwrap().unwrap();
            prop_assert_eq!(product(&rows, &solution), b);
            let null = null_space(&rows, 5, &mut plenty()).unwrap();
            let rank_of_rows = rank(&rows, &mut plenty()).unwrap();
            prop_assert_eq!(null.len() + rank_of_rows, 5);
            for vector in &null {
                prop_assert!(product(&rows, vector).iter().all(Zero::is_zero));
            }
            // solvable if and only if the right side raises no rank
            let right = rational(&right);
            let wider: Vec<Vec<Rational>> = rows.iter().zip(&right)
                .map(|(row, value)| row.iter().chain([value]).cloned().collect())
                .collect();
            let solvable = rank(&wider, &mut plenty()).unwrap() == rank_of_rows;
            prop_assert_eq!(solve(&rows, &right, &mut plenty()).unwrap().is_some(), solvable);
        }
    }
}
