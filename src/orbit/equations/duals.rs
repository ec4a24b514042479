//! Derivatives of equations over intervals, by dual numbers: one pass for each unknown.

use crate::number::{Dual, Endpoint, Interval, seeded};
use crate::orbit::interval_box::IntervalBox;
use num_dual::DualNum;

/// The values of `equations` over `cell` and their derivatives, one row an equation.
pub fn by_duals<E: Endpoint, const D: usize>(
    equations: impl Fn(&[Dual<Interval<E>>; D]) -> [Dual<Interval<E>>; D],
    cell: &IntervalBox<E, D>,
) -> (IntervalBox<E, D>, [IntervalBox<E, D>; D])
where
    Interval<E>: DualNum,
{
    let passes: [[Dual<Interval<E>>; D]; D] = std::array::from_fn(|column| {
        let at = std::array::from_fn(|i| {
            let side = cell[i].clone();
            if i == column { seeded(side) } else { Dual::from_re(side) }
        });
        equations(&at)
    });
    let values = passes[0].each_ref().map(|value| value.re.clone());
    let slopes = std::array::from_fn(|row| std::array::from_fn(|column| passes[column][row].eps.clone()));
    (values, slopes)
}
