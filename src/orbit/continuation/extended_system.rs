//! The motions of a word along a parameter: a curve in the phases and the parameter, followed in f64.

use crate::number::{Analytic, Dual, Interval, seeded};
use crate::orbit::equations::words::WordEquations;
use crate::orbit::family::Family;
use crate::orbit::word::Word;
use nalgebra::{DMatrix, DVector};

/// Newton steps to the curve: from a good prediction it takes three.
const MOST_STEPS: usize = 8;

/// A last step this small leaves nothing to gain.
const SETTLED: f64 = 1e-10;

/// The equations of a word as those of a curve: as many as impacts, in the phases and one unknown more, the place of
/// the parameter in its range, from 0 to 1.
pub(crate) struct ExtendedSystem<F> {
    pub family: F,
    pub word: Word,
    pub periods: u32,
    /// Of the parameter.
    pub range: Interval<f64>,
}

/// The range of a parameter as long as places go: never beyond its end by rounding, where a restitution cannot go.
fn width(range: &Interval<f64>) -> f64 {
    (range.high() - range.low()).next_down()
}

impl<F: Family> ExtendedSystem<F> {
    pub fn impacts(&self) -> usize {
        self.word.impacts()
    }

    /// The parameter at a place of its range.
    pub fn parameter<T: Analytic>(&self, place: &T) -> T {
        T::from_f64(self.range.low()) + T::from_f64(width(&self.range)) * place.clone()
    }

    /// The place of a parameter of the range.
    pub fn place(&self, parameter: f64) -> f64 {
        ((parameter - self.range.low()) / width(&self.range)).clamp(0.0, 1.0)
    }

    /// The equations at one value of the parameter; `None` where it can have no such value.
    pub fn at<T: Analytic>(&self, parameter: &T) -> Option<WordEquations<T>> {
        Some(WordEquations {
            motion: self.family.motion_at(parameter).ok()?,
            word: self.word.clone(),
            periods: self.periods,
        })
    }

    pub fn at_place<T: Analytic>(&self, place: &T) -> Option<WordEquations<T>> {
        self.at(&self.parameter(place))
    }

    /// Residuals and their derivatives, row by row, those by the place last.
    fn linearised(&self, point: &[f64]) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
        let (phases, place) = point.split_at(self.impacts());
        let (residuals, mut rows) = self.at_place(&place[0])?.linearised(phases)?;
        let lifted: Vec<_> = phases.iter().map(|phase| Dual::from_re(*phase)).collect();
        let by_place = self.at_place(&seeded(place[0]))?.residuals(&lifted);
        for (row, residual) in rows.iter_mut().zip(by_place) {
            row.push(residual.eps);
        }
        Some((residuals, rows))
    }

    /// Enclosures of the derivatives over a box, row by row, those by the place last.
    pub fn slopes(&self, cell: &[Interval<f64>]) -> Option<Vec<Vec<Interval<f64>>>> {
        let (phases, place) = cell.split_at(self.impacts());
        let mut rows = self.at_place(&place[0])?.jacobian(phases);
        let lifted: Vec<_> = phases.iter().map(|phase| Dual::from_re(*phase)).collect();
        let by_place = self.at_place(&seeded(place[0]))?.residuals(&lifted);
        for (row, residual) in rows.iter_mut().zip(by_place) {
            row.push(residual.eps);
        }
        Some(rows)
    }

    /// Residuals and derivatives with one more row, that of a plane across the curve.
    pub fn bordered(&self, point: &[f64], normal: &[f64]) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let (residuals, mut rows) = self.linearised(point)?;
        rows.push(normal.to_vec());
        let count = rows.len();
        let matrix = DMatrix::from_fn(count, count, |row, column| rows[row][column]);
        let values = DVector::from_fn(count, |row, _| residuals.get(row).copied().unwrap_or(0.0));
        Some((values, matrix))
    }

    /// The point of the curve in the plane across `normal` at `offset`, and how far Newton's method went for it.
    pub fn corrected(&self, guess: &[f64], normal: &[f64], offset: f64) -> Option<(Vec<f64>, f64)> {
        let mut point = guess.to_vec();
        let mut last = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let (mut values, matrix) = self.bordered(&point, normal)?;
            let count = values.len();
            values[count - 1] = dot(&point, normal) - offset;
            let step = matrix.lu().solve(&values)?;
            let size = step.amax();
            let shrinks = size < last; // NaN does not
            if !shrinks {
                return None;
            }
            for (coordinate, step) in point.iter_mut().zip(step.iter()) {
                *coordinate -= step;
            }
            if size < SETTLED {
                return Some((point.clone(), apart(&point, guess)));
            }
            last = size;
        }
        None
    }

    /// The point of the curve at a place, near a guess.
    pub fn settled_at(&self, guess: &[f64], place: f64) -> Option<(Vec<f64>, f64)> {
        let mut guess = guess.to_vec();
        let count = guess.len();
        guess[count - 1] = place;
        self.corrected(&guess, &axis(count), place)
    }

    /// The unit tangent at a point, on the side of `near`.
    pub fn tangent(&self, point: &[f64], near: &[f64]) -> Option<Vec<f64>> {
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
    pub fn first_tangent(&self, point: &[f64]) -> Option<Vec<f64>> {
        let count = point.len();
        // the curve may turn in the parameter there, but not in all phases as well
        let along = |index: usize| {
            (0..count)
                .map(|i| if i == index { 1.0 } else { 0.0 })
                .collect::<Vec<f64>>()
        };
        let tangents = (0..count).rev().filter_map(|index| self.tangent(point, &along(index)));
        let mut best: Option<(f64, Vec<f64>)> = None;
        for (index, tangent) in tangents.enumerate() {
            let part = tangent[count - 1 - index].abs();
            if best.as_ref().is_none_or(|(most, _)| part > *most) {
                best = Some((part, tangent));
            }
        }
        best.map(|(_, tangent)| tangent)
    }
}

/// The direction of the parameter alone.
fn axis(count: usize) -> Vec<f64> {
    (1..=count)
        .map(|index| if index == count { 1.0 } else { 0.0 })
        .collect()
}

pub(crate) fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

/// The distance in the maximum norm.
pub(crate) fn apart(one: &[f64], other: &[f64]) -> f64 {
    let parts = one.iter().zip(other).map(|(one, other)| (one - other).abs());
    parts.fold(0.0, f64::max)
}
