//! Derivatives of equations by dual numbers: one pass for each unknown.

use num_dual::DualNum;
use numbers::{Analytic, Dual, Endpoint, Interval, seeded};

/// The values of `D` equations at a point, and their derivatives, one row an equation.
pub type Linearised<T, const D: usize> = ([T; D], [[T; D]; D]);

/// The values of `equations` at a point, or over a box, and their derivatives; `None` where they have none.
pub fn by_duals<T: Analytic + DualNum, const D: usize>(
    equations: impl Fn(&[Dual<T>; D]) -> Option<[Dual<T>; D]>,
    at: &[T; D],
) -> Option<Linearised<T, D>> {
    let pass = |column: usize| {
        let seeds = std::array::from_fn(|i| {
            let value = at[i].clone();
            if i == column {
                seeded(value)
            } else {
                Dual::from_re(value)
            }
        });
        equations(&seeds)
    };
    let passes: Vec<[Dual<T>; D]> = (0..D).map(pass).collect::<Option<_>>()?;
    let values = passes.first()?.each_ref().map(|value| value.re.clone());
    let slopes = std::array::from_fn(|row| std::array::from_fn(|column| passes[column][row].eps.clone()));
    Some((values, slopes))
}

/// Computes the values of any number of equations at a point, or over a box, and their derivatives, one row an
/// equation; `None` where they have none.
pub fn rows_by_duals<T: Analytic + DualNum>(
    equations: impl Fn(&[Dual<T>]) -> Option<Vec<Dual<T>>>,
    at: &[T],
) -> Option<(Vec<T>, Vec<Vec<T>>)> {
    let pass = |column: usize| {
        let seeds = at.iter().enumerate().map(|(i, value)| match i == column {
            true => seeded(value.clone()),
            false => Dual::from_re(value.clone()),
        });
        equations(&seeds.collect::<Vec<_>>())
    };
    let passes: Vec<Vec<Dual<T>>> = (0..at.len()).map(pass).collect::<Option<_>>()?;
    let values: Vec<T> = passes.first()?.iter().map(|value| value.re.clone()).collect();
    let row = |row: usize| passes.iter().map(|pass| pass[row].eps.clone()).collect();
    let rows = (0..values.len()).map(row).collect();
    Some((values, rows))
}

/// Where the equations have no value, as where a parameter is out of its range: nothing is known.
pub fn unknown<E: Endpoint, const D: usize>() -> Linearised<Interval<E>, D> {
    let whole = || std::array::from_fn(|_| Interval::whole());
    (whole(), std::array::from_fn(|_| whole()))
}
