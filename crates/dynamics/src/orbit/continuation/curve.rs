//! A curve, the solutions of one equation less than unknowns: its points and tangents, in f64.

use crate::orbit::interval_box::apart;
use crate::orbit::solve::newton::{Ending, newton};
use nalgebra::{DMatrix, DVector};
use numbers::Interval;

/// How Newton's method ends: from a good prediction it takes three steps.
const ENDING: Ending = Ending {
    most_steps: 8,
    last_step: 1e-10,
    growth: 1.0,
    rounding: 0.0,
};

/// The equations of a curve, one less than unknowns.
pub(crate) trait CurveEquations {
    /// The values and their derivatives at a point, row by row; `None` where there are none.
    fn linearised(&self, point: &[f64]) -> Option<(Vec<f64>, Vec<Vec<f64>>)>;

    /// Enclosures of the values over a box.
    fn values(&self, cell: &[Interval<f64>]) -> Option<Vec<Interval<f64>>>;

    /// Enclosures of the derivatives over a box, row by row.
    fn slopes(&self, cell: &[Interval<f64>]) -> Option<Vec<Vec<Interval<f64>>>>;

    /// Values and derivatives with one more row, that of a plane across the curve.
    fn bordered(&self, point: &[f64], normal: &[f64]) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let (residuals, mut rows) = self.linearised(point)?;
        rows.push(normal.to_vec());
        let count = rows.len();
        let matrix = DMatrix::from_fn(count, count, |row, column| rows[row][column]);
        let values = DVector::from_fn(count, |row, _| residuals.get(row).copied().unwrap_or(0.0));
        Some((values, matrix))
    }

    /// The point of the curve in the plane across `normal` at `offset`, and how far Newton's method went for it.
    fn corrected(&self, guess: &[f64], normal: &[f64], offset: f64) -> Option<(Vec<f64>, f64)> {
        let point = newton(guess.to_vec(), &ENDING, |point: &Vec<f64>| {
            let (mut values, matrix) = self.bordered(point, normal)?;
            let count = values.len();
            values[count - 1] = dot(point, normal) - offset;
            let step = matrix.lu().solve(&values)?;
            Some(step.iter().copied().collect())
        })?;
        let moved = apart(&point, guess);
        Some((point, moved))
    }

    /// The point of the curve at a value of one coordinate, near a guess.
    fn solved_at(&self, guess: &[f64], coordinate: usize, value: f64) -> Option<(Vec<f64>, f64)> {
        let mut guess = guess.to_vec();
        guess[coordinate] = value;
        let (mut point, moved) = self.corrected(&guess, &axis(guess.len(), coordinate), value)?;
        // up to the rounding of the last step it has it
        point[coordinate] = value;
        Some((point, moved))
    }

    /// The unit tangent at a point, on the side of `near`.
    fn tangent(&self, point: &[f64], near: &[f64]) -> Option<Vec<f64>> {
        let (_, matrix) = self.bordered(point, near)?;
        let count = near.len();
        let mut right = DVector::zeros(count);
        right[count - 1] = 1.0;
        let tangent = matrix.lu().solve(&right)?;
        let length = tangent.norm();
        let tangent: Vec<f64> = tangent.iter().map(|part| part / length).collect();
        tangent.iter().all(|part| part.is_finite()).then_some(tangent)
    }

    /// The tangent at a point of which nothing is known, in one of its two directions.
    fn first_tangent(&self, point: &[f64]) -> Option<Vec<f64>> {
        let count = point.len();
        // the curve may turn in some coordinates there, but not in all
        let tangents = (0..count).rev().filter_map(|index| {
            let tangent = self.tangent(point, &axis(count, index))?;
            Some((tangent[index].abs(), tangent))
        });
        let best = tangents.reduce(|best, next| if next.0 > best.0 { next } else { best });
        best.map(|(_, tangent)| tangent)
    }
}

/// The direction of one coordinate.
fn axis(count: usize, coordinate: usize) -> Vec<f64> {
    (0..count)
        .map(|index| if index == coordinate { 1.0 } else { 0.0 })
        .collect()
}

pub(crate) fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}
