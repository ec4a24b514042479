//! The motions of a word along a parameter: a curve in the phases and the parameter, followed in f64.

use crate::orbit::continuation::branch::{BranchEnd, BranchPoint, Continued, TOGETHER};
use crate::orbit::continuation::curve::CurveEquations;
use crate::orbit::continuation::test_functions::TestFunctions;
use crate::orbit::equations::words::WordEquations;
use crate::orbit::family::Family;
use crate::orbit::interval_box::apart;
use crate::orbit::options::OrbitOptions;
use crate::orbit::solve::starts::{brought_near, listed_from};
use crate::orbit::word::Word;
use num_dual::DualNum;
use numbers::{Analytic, Dual, Interval, seeded};
use std::f64::consts::PI;
use std::ops::Range;

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

/// The parameter at a place of its range, from 0 to 1.
pub(crate) fn parameter_at<T: Analytic>(range: &Interval<f64>, place: &T) -> T {
    T::from_f64(range.low()) + T::from_f64(width(range)) * place.clone()
}

/// The place of a parameter in its range.
pub(crate) fn place_of(range: &Interval<f64>, parameter: f64) -> f64 {
    ((parameter - range.low()) / width(range)).clamp(0.0, 1.0)
}

impl<F: Family> ExtendedSystem<F> {
    pub fn impacts(&self) -> usize {
        self.word.impacts()
    }

    /// The parameter at a place of its range.
    pub fn parameter<T: Analytic>(&self, place: &T) -> T {
        parameter_at(&self.range, place)
    }

    /// The place of a parameter of the range.
    pub fn place(&self, parameter: f64) -> f64 {
        place_of(&self.range, parameter)
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
}

impl<F: Family> CurveEquations for ExtendedSystem<F> {
    fn linearised(&self, point: &[f64]) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
        let (phases, place) = point.split_at(self.impacts());
        let (residuals, rows) = self.at_place(&place[0])?.linearised(phases);
        Some((residuals, with_column(rows, self.by_place(phases, &place[0])?)))
    }

    fn values(&self, cell: &[Interval<f64>]) -> Option<Vec<Interval<f64>>> {
        let (phases, place) = cell.split_at(self.impacts());
        Some(self.at_place(&place[0])?.residuals(phases))
    }

    fn slopes(&self, cell: &[Interval<f64>]) -> Option<Vec<Vec<Interval<f64>>>> {
        let (phases, place) = cell.split_at(self.impacts());
        let rows = self.at_place(&place[0])?.jacobian(phases);
        Some(with_column(rows, self.by_place(phases, &place[0])?))
    }
}

impl<F: Family> Continued for ExtendedSystem<F> {
    type Functions = TestFunctions;

    fn options(&self) -> &OrbitOptions {
        &self.options
    }

    fn places(&self) -> Range<usize> {
        self.impacts()..self.impacts() + 1
    }

    fn functions(&self, point: &[f64]) -> Option<TestFunctions> {
        let (phases, place) = point.split_at(self.impacts());
        Some(TestFunctions::new(&self.at_place(&place[0])?, phases))
    }

    fn ends(&self, node: &BranchPoint) -> Option<BranchEnd> {
        if !node.functions.moves() {
            return Some(BranchEnd::Slow);
        }
        let phases = &node.point[..self.impacts()];
        let mut repeats = self.word.symmetries().map(|first| {
            let listed = listed_from(phases, first, self.periods);
            apart(&brought_near(&listed, phases[0]), phases)
        });
        let shortest = node.functions.times.iter().copied().fold(f64::INFINITY, f64::min);
        let is_shorter = repeats.any(|apart| apart < TOGETHER) || PI * shortest < TOGETHER;
        is_shorter.then_some(BranchEnd::Shorter)
    }

    fn images(&self, point: &[f64], near: &[f64]) -> Vec<Vec<f64>> {
        let (phases, place) = point.split_at(self.impacts());
        let firsts = std::iter::once(0).chain(self.word.symmetries());
        firsts
            .map(|first| {
                let mut listed = brought_near(&listed_from(phases, first, self.periods), near[0]);
                listed.push(place[0]);
                listed
            })
            .collect()
    }
}

fn with_column<T>(mut rows: Vec<Vec<T>>, column: Vec<T>) -> Vec<Vec<T>> {
    for (row, entry) in rows.iter_mut().zip(column) {
        row.push(entry);
    }
    rows
}
