//! Derivatives of equations by dual numbers that carry those by several unknowns at once.

use nalgebra::{Const, U1};
use num_dual::DualNum;
use numbers::{Analytic, Endpoint, Gradient, Interval};
use smallvec::SmallVec;

/// The values of `D` equations at a point, and their derivatives, one row an equation.
pub type Linearised<T, const D: usize> = ([T; D], [[T; D]; D]);

/// The number of derivatives that one pass takes: the same for all systems, so that their equations are compiled once.
pub const LANES: usize = 4;

/// The values of `equations` at a point, or over a box, and their derivatives; `None` where they have none.
pub fn by_duals<T: Analytic + DualNum, const D: usize>(
    equations: impl Fn(&[Gradient<T, LANES>; D]) -> Option<[Gradient<T, LANES>; D]>,
    at: &[T; D],
) -> Option<Linearised<T, D>> {
    let passes = (0..D).step_by(LANES).map(|first| {
        let found = equations(&std::array::from_fn(|i| seeded_from(first, i, &at[i])))?;
        Some(found.map(|value| (value.re, value.eps.unwrap_generic(Const::<LANES>, U1))))
    });
    let passes: SmallVec<[_; 1]> = passes.collect::<Option<_>>()?;
    let values = passes.first()?.each_ref().map(|(value, _)| value.clone());
    let slope = |row: usize, column: usize| passes[column / LANES][row].1[column % LANES].clone();
    Some((
        values,
        std::array::from_fn(|row| std::array::from_fn(|column| slope(row, column))),
    ))
}

/// Unknown number `i`, a variable of the derivatives by the unknowns from `first` on where it is one of them.
fn seeded_from<T: Analytic + DualNum>(first: usize, i: usize, value: &T) -> Gradient<T, LANES> {
    let value = Gradient::from_re(value.clone());
    match i.checked_sub(first).filter(|lane| *lane < LANES) {
        Some(lane) => value.derivative(lane),
        None => value,
    }
}

/// Computes the values of any number of equations at a point, or over a box, and their derivatives, one row an
/// equation; `None` where they have none.
pub fn rows_by_duals<T: Analytic + DualNum>(
    equations: impl Fn(&[Gradient<T, LANES>]) -> Option<Vec<Gradient<T, LANES>>>,
    at: &[T],
) -> Option<(Vec<T>, Vec<Vec<T>>)> {
    let (mut values, mut rows): (Vec<T>, Vec<Vec<T>>) = (Vec::new(), Vec::new());
    for first in (0..at.len()).step_by(LANES) {
        let seeds = at.iter().enumerate().map(|(i, value)| seeded_from(first, i, value));
        let found = equations(&seeds.collect::<Vec<_>>())?;
        rows.resize(found.len(), Vec::new());
        values = Vec::with_capacity(found.len());
        for (row, value) in rows.iter_mut().zip(found) {
            let slopes = value.eps.unwrap_generic(Const::<LANES>, U1);
            row.extend(slopes.iter().take(at.len() - first).cloned());
            values.push(value.re);
        }
    }
    Some((values, rows))
}

/// Where the equations have no value, as where a parameter is out of its range: nothing is known.
pub fn unknown<E: Endpoint, const D: usize>() -> Linearised<Interval<E>, D> {
    let whole = || std::array::from_fn(|_| Interval::whole());
    (whole(), std::array::from_fn(|_| whole()))
}
