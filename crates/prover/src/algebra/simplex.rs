//! Linear programming over the rationals, exact: rows of integers without a common factor.

use super::coefficient::Coefficient;
use super::linear::remove_content;
use super::steps::{Result, Steps};
use dashu_int::IBig;
use dashu_ratio::RBig;
use numbers::Rational;

/// Rows of integers, the right side last in each.
type Rows = Vec<Vec<IBig>>;

/// A system `rows x = right` with `x >= 0`, during the simplex method.
struct Tableau {
    /// Each row, its right side last; every row may be scaled by a positive number of its own.
    rows: Rows,
    /// The column that is basic in each row; none in a row that still has its artificial variable.
    basis: Vec<Option<usize>>,
    columns: usize,
}

/// A solution `x >= 0` of `rows x = right`, given as integers with the right side last in each row, as the columns
/// with values above 0. Where `favoured` columns are given, one of them has a value above 0. `None` where there is
/// no such solution, or the favoured columns can be raised only without bound.
///
/// Source: Dantzig, Linear Programming and Extensions, chapter 5, two phases; Bland's rule against cycles after many
/// pivots.
pub(super) fn nonnegative_solution(
    rows: Rows,
    columns: usize,
    favoured: Option<&[bool]>,
    steps: &mut Steps,
) -> Result<Option<Vec<(usize, Rational)>>> {
    let Some((rows, kept)) = presolved(rows, columns, steps)? else {
        return Ok(None);
    };
    let mut tableau = Tableau {
        basis: vec![None; rows.len()],
        rows,
        columns: kept.len(),
    };
    if !tableau.make_feasible(steps)? {
        return Ok(None);
    }
    if let Some(favoured) = favoured {
        let favoured: Vec<bool> = kept.iter().map(|&column| favoured[column]).collect();
        if !tableau.raise(&favoured, steps)? {
            return Ok(None);
        }
    }
    let values = tableau.values().map(|(column, value)| (kept[column], Rational(value)));
    Ok(Some(values.filter(|(_, value)| !value.0.is_zero()).collect()))
}

/// Leaves away columns that must be 0, since in some row with right side 0 all entries have one sign; returns the
/// columns that are left. `None` where a row shows that there is no solution.
fn presolved(mut rows: Rows, columns: usize, steps: &mut Steps) -> Result<Option<(Rows, Vec<usize>)>> {
    for row in &mut rows {
        if row[columns] < IBig::ZERO {
            row.iter_mut().for_each(|value| *value = -&*value);
        }
    }
    let mut kept = vec![true; columns];
    loop {
        let mut changed = false;
        for row in &rows {
            steps.take(columns as u64 / 16 + 1)?;
            let entries = || (0..columns).filter(|&column| kept[column] && !row[column].is_zero());
            let positive = entries().any(|column| row[column] > IBig::ZERO);
            let negative = entries().any(|column| row[column] < IBig::ZERO);
            if !row[columns].is_zero() {
                if !positive {
                    return Ok(None);
                }
            } else if positive != negative {
                changed = true;
                let empty: Vec<usize> = entries().collect();
                empty.into_iter().for_each(|column| kept[column] = false);
            }
        }
        if !changed {
            break;
        }
    }
    let kept: Vec<usize> = (0..columns).filter(|&column| kept[column]).collect();
    let narrowed = rows.into_iter().map(|row| {
        let mut narrowed: Vec<IBig> = kept.iter().map(|&column| row[column].clone()).collect();
        narrowed.push(row[columns].clone());
        remove_content(&mut narrowed);
        narrowed
    });
    let narrowed = narrowed
        .filter(|row| row.iter().any(|value| !value.is_zero()))
        .collect();
    Ok(Some((narrowed, kept)))
}

impl Tableau {
    /// First phase: drives a sum of artificial variables to 0; false where its minimum is positive.
    fn make_feasible(&mut self, steps: &mut Steps) -> Result<bool> {
        let mut excess = vec![IBig::ZERO; self.columns + 1];
        for row in &self.rows {
            for (sum, value) in excess.iter_mut().zip(row) {
                *sum += value;
            }
        }
        let mut pivots = 0;
        while !excess[self.columns].is_zero() {
            let Some(column) = self.entering(&excess, pivots) else {
                return Ok(false);
            };
            let Some(row) = self.leaving(column) else {
                return Ok(false);
            };
            self.pivot(row, column, &mut excess, steps)?;
            pivots += 1;
        }
        // artificial variables that are still basic are 0: another column takes their row, or it says nothing
        for row in (0..self.rows.len()).rev() {
            if self.basis[row].is_none() {
                match (0..self.columns).find(|&column| !self.rows[row][column].is_zero()) {
                    Some(column) => {
                        if self.rows[row][column] < IBig::ZERO {
                            self.rows[row].iter_mut().for_each(|value| *value = -&*value);
                        }
                        self.pivot(row, column, &mut excess, steps)?;
                    }
                    None => {
                        self.rows.remove(row);
                        self.basis.remove(row);
                    }
                }
            }
        }
        Ok(true)
    }

    /// Second phase: raises the sum of the favoured columns until it is above 0; false where it cannot be.
    fn raise(&mut self, favoured: &[bool], steps: &mut Steps) -> Result<bool> {
        let reached = |tableau: &Self| {
            let mut basic = tableau.basis.iter().zip(&tableau.rows);
            basic.any(|(column, row)| column.is_some_and(|column| favoured[column]) && !row[tableau.columns].is_zero())
        };
        let mut objective: Vec<IBig> = favoured
            .iter()
            .map(|&favoured| if favoured { IBig::ONE } else { IBig::ZERO })
            .collect();
        objective.push(IBig::ZERO);
        for row in 0..self.rows.len() {
            if let Some(column) = self.basis[row] {
                eliminate(&mut objective, &self.rows[row], column, steps)?;
            }
        }
        let mut pivots = 0;
        while !reached(self) {
            let Some(column) = self.entering(&objective, pivots) else {
                return Ok(false);
            };
            let Some(row) = self.leaving(column) else {
                return Ok(false);
            };
            self.pivot(row, column, &mut objective, steps)?;
            pivots += 1;
        }
        Ok(true)
    }

    /// A column whose growth improves the objective.
    fn entering(&self, objective: &[IBig], pivots: usize) -> Option<usize> {
        let mut improving = (0..self.columns).filter(|&column| objective[column] > IBig::ZERO);
        if pivots > 4 * self.rows.len() + 50 {
            improving.next()
        } else {
            improving.max_by_key(|&column| &objective[column])
        }
    }

    /// The row whose basic variable reaches 0 first as this column grows.
    fn leaving(&self, column: usize) -> Option<usize> {
        let mut best: Option<usize> = None;
        for row in 0..self.rows.len() {
            let entry = &self.rows[row][column];
            if *entry <= IBig::ZERO {
                continue;
            }
            best = match best {
                None => Some(row),
                Some(known) => {
                    let ours = &self.rows[row][self.columns] * &self.rows[known][column];
                    let theirs = &self.rows[known][self.columns] * entry;
                    let order = ours.cmp(&theirs).then_with(|| self.basis[row].cmp(&self.basis[known]));
                    Some(if order.is_lt() { row } else { known })
                }
            };
        }
        best
    }

    fn pivot(&mut self, row: usize, column: usize, objective: &mut [IBig], steps: &mut Steps) -> Result<()> {
        let pivot = std::mem::take(&mut self.rows[row]);
        for other in self.rows.iter_mut().filter(|other| !other.is_empty()) {
            eliminate(other, &pivot, column, steps)?;
        }
        eliminate(objective, &pivot, column, steps)?;
        self.rows[row] = pivot;
        self.basis[row] = Some(column);
        Ok(())
    }

    /// The values of the basic columns.
    fn values(&self) -> impl Iterator<Item = (usize, RBig)> {
        let basic = self.basis.iter().zip(&self.rows);
        basic.filter_map(|(column, row)| {
            let column = (*column)?;
            Some((column, RBig::from(row[self.columns].clone()) / &row[column]))
        })
    }
}

/// Takes a multiple of the pivot row, whose entry in the column is above 0, off a row times a positive number, so
/// that its entry there is 0.
fn eliminate(row: &mut [IBig], pivot: &[IBig], column: usize, steps: &mut Steps) -> Result<()> {
    if row[column].is_zero() {
        return Ok(());
    }
    let (factor, multiple) = row[column].cancel(&pivot[column]);
    steps.take(row.len() as u64 * (factor.cost() + multiple.cost()))?;
    for (value, other) in row.iter_mut().zip(pivot) {
        if !factor.is_one() && !value.is_zero() {
            *value *= &factor;
        }
        if !other.is_zero() {
            *value -= other * &multiple;
        }
    }
    remove_content(row);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::testing::plenty;
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn solutions_are_found(
            entries in prop::collection::vec(-3i64..=3, 24),
            x in prop::collection::vec(0i64..=3, 6),
        ) {
            let rows: Vec<Vec<IBig>> = entries.chunks(6).map(|row| {
                let right: i64 = row.iter().zip(&x).map(|(a, b)| a * b).sum();
                row.iter().chain([&right]).map(|&value| IBig::from(value)).collect()
            }).collect();
            let found = nonnegative_solution(rows.clone(), 6, None, &mut plenty()).unwrap().unwrap();
            for row in &rows {
                let sum = found.iter().fold(RBig::ZERO, |sum, (column, value)| sum + &value.0 * &row[*column]);
                prop_assert_eq!(sum, RBig::from(row[6].clone()));
            }
            prop_assert!(found.iter().all(|(_, value)| value.0 > RBig::ZERO));
            let favoured: Vec<bool> = (0..6).map(|column| column == 2).collect();
            let found = nonnegative_solution(rows, 6, Some(&favoured), &mut plenty()).unwrap();
            if x[2] > 0 {
                prop_assert!(found.is_none_or(|found| found.iter().any(|(column, _)| *column == 2)));
            }
        }
    }
}
