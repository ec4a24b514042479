//! Motions of any word by Newton's method in f64 from many starts: proposed, not proved.

use crate::orbit::equations::words::WordEquations;
use crate::orbit::solve::newton::{Ending, newton_sized};
use nalgebra::{DMatrix, DVector};
use numbers::{Sequence, mix};
use std::f64::consts::{PI, TAU};

/// How Newton's method ends: starts that lead to an orbit take some ten steps.
const ENDING: Ending = Ending {
    most_steps: 40,
    last_step: 1e-9,
    growth: f64::INFINITY,
    rounding: 0.0,
};

/// Halvings of one step before it is given up: a step a thousandth as long makes no way.
const MOST_HALVINGS: usize = 10;

/// A flight may shrink to this part of itself in one step, so that impacts keep their order.
const LEAST_PART: f64 = 0.2;

/// The longest step of a phase, in radians: beyond it the linear equations know nothing of the forcing.
const LONGEST_STEP: f64 = 1.0;

/// Where to start: impact 0 anywhere in the forcing period, the times anywhere among those that add up. Repeatable.
///
/// Points are a rank-1 lattice shifted at random rather than random themselves, so that they leave no large gaps.
pub(crate) fn starts(system: &WordEquations<f64>, count: usize) -> impl Iterator<Item = Vec<f64>> + '_ {
    let dimensions = system.word.impacts();
    let mut sequence = Sequence::new(mix(count as u64));
    let shifts: Vec<f64> = (0..dimensions).map(|_| sequence.between(0.0, 1.0)).collect();
    let rates = rates(dimensions);
    let whole = TAU * f64::from(system.periods);
    (1..=count).map(move |index| {
        let at = |dimension: usize| (shifts[dimension] + rates[dimension] * index as f64).fract();
        let first = TAU * at(0);
        let mut later: Vec<f64> = (1..dimensions).map(at).collect();
        // sorted uniform points cut a length into parts that are uniform on the simplex
        later.sort_by(f64::total_cmp);
        let later = later.into_iter().map(|part| first + whole * part);
        std::iter::once(first).chain(later).collect()
    })
}

/// The powers of the inverse of the root of x^(m+1) = x + 1, the golden ratio's way in m dimensions (Roberts 2018).
fn rates(dimensions: usize) -> Vec<f64> {
    let power = 1.0 / (dimensions as f64 + 1.0);
    let root = (0..60).fold(1.5_f64, |root, _| (1.0 + root).powf(power));
    (1..=dimensions).map(|exponent| root.powi(-(exponent as i32))).collect()
}

/// The phases of an orbit near `start`, if Newton's method settles with its impacts in order: steps are halved until the
/// residuals decrease.
pub(crate) fn solve_word(system: &WordEquations<f64>, start: Vec<f64>) -> Option<Vec<f64>> {
    newton_sized(start, &ENDING, |phases: &Vec<f64>| {
        let (residuals, rows) = system.linearised(phases);
        let step = solve(&rows, &residuals)?;
        // of the whole step, and beside the phases: where two impacts come together steps shrink slowly, by rounding in the end
        let size = largest(&step) / (1.0 + largest(phases));
        if size <= ENDING.last_step {
            return moved(system, phases, &step, 1.0).map(|_| (step, size));
        }
        let before = length(&residuals);
        let mut part = longest_part(system, phases, &step);
        for _ in 0..MOST_HALVINGS {
            let tried = moved(system, phases, &step, part)?;
            if length(&system.residuals(&tried)) < before {
                return Some((step.iter().map(|step| part * step).collect(), size));
            }
            part *= 0.5;
        }
        None
    })
}

/// The part of `step` that keeps every flight forward and every phase within reach.
fn longest_part(system: &WordEquations<f64>, phases: &[f64], step: &[f64]) -> f64 {
    let count = phases.len();
    let whole = TAU * f64::from(system.periods);
    let after = |values: &[f64], index: usize, round: f64| {
        let next = values.get(index + 1).copied().unwrap_or(values[0] + round);
        next - values[index]
    };
    let shrinking = (0..count).map(|index| {
        let (time, less) = (after(phases, index, whole), after(step, index, 0.0));
        // the step is subtracted
        if less > 0.0 {
            (1.0 - LEAST_PART) * time / less
        } else {
            1.0
        }
    });
    let reach = LONGEST_STEP / largest(step);
    shrinking.fold(reach.min(1.0), f64::min)
}

fn moved(system: &WordEquations<f64>, phases: &[f64], step: &[f64], part: f64) -> Option<Vec<f64>> {
    let moved: Vec<f64> = phases
        .iter()
        .zip(step)
        .map(|(phase, step)| phase - part * step)
        .collect();
    let end = moved.first()? + TAU * f64::from(system.periods);
    let ends = moved.iter().skip(1).chain(std::iter::once(&end));
    let forward = moved.iter().zip(ends).all(|(start, end)| end > start);
    forward.then_some(moved)
}

fn solve(rows: &[Vec<f64>], right: &[f64]) -> Option<Vec<f64>> {
    let matrix = DMatrix::from_fn(rows.len(), rows.len(), |row, column| rows[row][column]);
    let solution: Vec<f64> = matrix.lu().solve(&DVector::from_column_slice(right))?.data.into();
    solution.iter().all(|entry| entry.is_finite()).then_some(solution)
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| value.abs().max(largest))
}

fn length(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// Phases with impact 0 within half a turn of `near`, whole turns later or earlier.
pub(crate) fn brought_near(phases: &[f64], near: f64) -> Vec<f64> {
    let turns = TAU * ((near - phases.first().copied().unwrap_or(near) + PI) / TAU).floor();
    phases.iter().map(|phase| phase + turns).collect()
}

/// The same orbit listed from impact `first` on; the impacts before it are those of the next round.
pub(crate) fn listed_from(phases: &[f64], first: usize, periods: u32) -> Vec<f64> {
    let round = TAU * f64::from(periods);
    let next = phases.iter().take(first).map(|phase| phase + round);
    phases.iter().skip(first).copied().chain(next).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;

    fn system(word: &str, periods: u32) -> WordEquations<f64> {
        WordEquations {
            motion: Motion::new(0.12, 0.3, 0.6, 0.4).expect("a motion"),
            word: word.parse().expect("a word"),
            periods,
        }
    }

    #[test]
    fn starts_are_in_order_and_the_same_each_time() {
        let system = system("BTT", 2);
        let all: Vec<_> = starts(&system, 50).collect();
        assert_eq!(all, starts(&system, 50).collect::<Vec<_>>());
        for start in &all {
            assert!(moved(&system, start, &[0.0; 3], 1.0).is_some() && (0.0..TAU).contains(&start[0]));
        }
        let long = all.iter().filter(|start| start[1] - start[0] > TAU).count();
        assert!(
            long > 5 && long < 25,
            "{long} of 50 first flights take more than half of the time"
        );
    }

    #[test]
    fn a_word_of_one_impact_has_its_two_orbits_in_closed_form() {
        // the launch -r v and the arrival v differ by 2 n g, and the sine of the phase makes up for the rest
        let system = system("B", 1);
        let velocity = 2.0 * 0.12 / 1.6;
        let sine = PI * (0.12 - 0.6 * velocity);
        let found: Vec<_> = starts(&system, 20)
            .filter_map(|start| solve_word(&system, start))
            .collect();
        assert!(found.len() > 10);
        for phases in &found {
            assert!((phases[0].sin() - sine).abs() < 1e-12, "{phases:?}");
            assert!((system.orbit_impacts(phases)[0].velocity - velocity).abs() < 1e-12);
        }
        assert!(found.iter().any(|phases| phases[0].cos() > 0.0) && found.iter().any(|phases| phases[0].cos() < 0.0));
    }

    #[test]
    fn an_orbit_listed_from_another_impact_solves_the_rotated_word() {
        let system = system("BTBT", 2);
        let found = starts(&system, 200)
            .find_map(|start| solve_word(&system, start))
            .expect("an orbit");
        let other = brought_near(&listed_from(&found, 2, 2), 0.0);
        assert!(largest(&system.residuals(&other)) < 1e-12 && other[0].abs() <= PI + 1e-9);
    }
}
