//! Whether a simplified Newton iteration contracts a box: Krawczyk's test in the maximum norm, for any number of unknowns.

#[cfg(any(test, feature = "calls"))]
use crate::model::calls::{self, Call};
use crate::orbit::interval_box::larger;
use nalgebra::DMatrix;
use numbers::{Analytic, Endpoint, Field, Interval};

/// A bound of |I - Y J| in the maximum norm, of enclosures `rows` of J over a box, for any number of unknowns: below 1, the
/// simplified Newton iteration x - Y F(x) contracts the box. NaN where nothing is known.
pub(crate) fn contraction<E: Endpoint>(inverse: &DMatrix<f64>, rows: &[Vec<Interval<E>>]) -> f64 {
    #[cfg(any(test, feature = "calls"))]
    calls::count(Call::Certificate);
    let count = rows.len();
    let row_sum = |row: usize| {
        let entries = (0..count).map(|column| {
            let identity = Interval::from_integer(i64::from(row == column));
            let terms = (0..count).map(|k| Interval::from_f64(inverse[(row, k)]) * rows[k][column].clone());
            terms.fold(identity, |sum, term| sum - term).size()
        });
        let sum = entries.fold(Interval::from_integer(0), |sum, entry| sum + entry);
        sum.high().to_f64().next_up()
    };
    (0..count).map(row_sum).fold(0.0, larger)
}

/// A matrix times a vector of intervals.
pub(crate) fn times<E: Endpoint>(matrix: &DMatrix<f64>, vector: &[Interval<E>]) -> Vec<Interval<E>> {
    let entry = |row: usize| {
        let terms = vector.iter().enumerate();
        terms.fold(Interval::from_integer(0), |sum, (column, value)| {
            sum + Interval::from_f64(matrix[(row, column)]) * value.clone()
        })
    };
    (0..vector.len()).map(entry).collect()
}

/// The largest magnitude; NaN or infinite where one is.
pub(crate) fn largest<E: Endpoint>(values: &[Interval<E>]) -> E {
    values.iter().map(Interval::magnitude).fold(E::zero(), larger)
}
