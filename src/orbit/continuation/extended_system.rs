//! The motions of a word along a parameter: a curve in the phases and the parameter, followed in f64.

use crate::number::{Analytic, Dual, Interval, seeded};
use crate::orbit::equations::words::WordEquations;
use crate::orbit::family::Family;
use crate::orbit::interval_box::apart;
use crate::orbit::options::OrbitOptions;
use crate::orbit::solve::newton::{Ending, newton};
use crate::orbit::word::Word;
use nalgebra::{DMatrix, DVector};
use num_dual::DualNum;

/// How Newton's method ends: from a good prediction it takes three steps.
const ENDING: Ending = Ending {
    most_steps: 8,
    last_step: 1e-10,
    growth: 1.0,
    rounding: 0.0,
};

/// The equations of a word as those of a curve: as many as impacts, in the phases and one unknown more, the place of
/// the parameter in its range, from 0 to 1.
pub(crate) struct ExtendedSystem<F> {
    pub family: F,
    pub word: Word,
    pub periods: u32,
    /// Of the parameter.
    pub range: Interval<f64>,
    pub options: OrbitOptions,
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

    /// The derivatives of the residuals at a point, or over a box, by the place; `None` where it can be no such.
    fn by_place<T: Analytic + DualNum>(&self, phases: &[T], place: &T) -> Option<Vec<T>> {
        let lifted: Vec<_> = phases.iter().cloned().map(Dual::from_re).collect();
        let residuals = self.at_place(&seeded(place.clone()))?.residuals(&lifted);
        Some(residuals.into_iter().map(|residual| residual.eps).collect())
    }

    /// Residuals and their derivatives, row by row, those by the place last.
    fn linearised(&self, point: &[f64]) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
        let (phases, place) = point.split_at(self.impacts());
        let (residuals, rows) = self.at_place(&place[0])?.linearised(phases)?;
        Some((residuals, with_column(rows, self.by_place(phases, &place[0])?)))
    }

    /// Enclosures of the derivatives over a box, row by row, those by the place last.
    pub fn slopes(&self, cell: &[Interval<f64>]) -> Option<Vec<Vec<Interval<f64>>>> {
        let (phases, place) = cell.split_at(self.impacts());
        let rows = self.at_place(&place[0])?.jacobian(phases);
        Some(with_column(rows, self.by_place(phases, &place[0])?))
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

    /// The point of the curve at a place, near a guess.
    pub fn solved_at(&self, guess: &[f64], place: f64) -> Option<(Vec<f64>, f64)> {
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
        let extended = |index: usize| {
            (0..count)
                .map(|i| if i == index { 1.0 } else { 0.0 })
                .collect::<Vec<f64>>()
        };
        let tangents = (0..count)
            .rev()
            .filter_map(|index| self.tangent(point, &extended(index)));
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

fn with_column<T>(mut rows: Vec<Vec<T>>, column: Vec<T>) -> Vec<Vec<T>> {
    for (row, entry) in rows.iter_mut().zip(column) {
        row.push(entry);
    }
    rows
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
