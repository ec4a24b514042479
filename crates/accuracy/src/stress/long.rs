//! Many impacts of a motion that attracts: what rounding has made of it by then.

use super::StressError;
use super::impacts::{FORMULA, Setup, SimulatedImpact, error};
use super::motion::known;
use super::row::{Evaluation, Form, StressRow};
use dynamics::model::Motion;
use dynamics::orbit::{Word, find};
use numbers::Rung;

/// g, d, r_B, r_T: the paper's first orbit.
const SCENE: [f64; 4] = [0.12201, 0.4, 0.5, 0.5];

/// The extremes, and their impacts.
pub(super) const CASES: [(&str, u32); 2] = [("a million impacts", 1_000_000), ("a billion impacts", 1_000_000_000)];

/// So many impacts by the map (8) take a tenth of a second; the time grows, so that such a motion never goes round.
const MOST_BY_TIME: u32 = 1_000_000;

/// How far from the orbit the motion starts: enough to have to settle.
pub(super) const OFF: f64 = 0.01;

/// The rows after so many impacts, an even number, of a start so far from the orbit.
///
/// The quantity is the impact at the bottom, phase and velocity, that a motion near a stable 1-1 orbit has come to:
/// that of the orbit, whatever the start. Printed is the map (8) with the time as it is, as the paper's t_k, for a
/// million impacts at most.
///
/// # Errors
/// `Point` where the orbit is not found or not confirmed.
pub(super) fn rows(case: &'static str, impacts: u32, off: f64) -> Result<Vec<StressRow>, StressError> {
    let [g, d, r_b, r_t] = SCENE;
    let from = |phase: f64, velocity: f64| SimulatedImpact {
        inputs: [g, d, r_b, r_t, phase + off, velocity * (1.0 + off)],
        setup: Setup::Paper,
        impacts,
    };
    let fault = || StressError::Point {
        case,
        at: from(f64::NAN, f64::NAN).at(),
    };
    let motion = Motion::new(g, d, r_b, r_t).map_err(|_| fault())?;
    let found = find(&motion, &Word::pair(), 1).map_err(|_| fault())?;
    let orbit = found.orbits.iter().find(|orbit| orbit.stable).ok_or_else(fault)?;
    let known = known(SCENE, orbit).ok_or_else(fault)?;
    let first = orbit.phases.first().zip(orbit.velocities.first());
    let simulated = first
        .map(|(phase, velocity)| from(*phase, *velocity))
        .ok_or_else(fault)?;
    let exact = known.fixes.first().ok_or_else(fault)?;
    let by_time = || {
        vec![
            Evaluation::of::<f32>(Rung::Single, Form::Printed, error(simulated.by_time::<f32>(), exact)),
            Evaluation::of::<f64>(Rung::Double, Form::Printed, error(simulated.by_time::<f64>(), exact)),
        ]
    };
    let mut made = if impacts <= MOST_BY_TIME { by_time() } else { Vec::new() };
    made.extend([
        Evaluation::of::<f32>(Rung::Single, Form::Stable, error(simulated.by_rounds::<f32>(), exact)),
        Evaluation::of::<f64>(Rung::Double, Form::Stable, error(simulated.by_rounds::<f64>(), exact)),
    ]);
    let row = |evaluation| StressRow::new(case, FORMULA, evaluation, known.condition, simulated.at());
    Ok(made.into_iter().map(row).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_some_thousand_impacts_the_time_has_cost_digits_and_the_phase_none() {
        let rows = rows(CASES[0].0, 4000, OFF).unwrap();
        let digits = |form, number: &str| {
            let row = rows.iter().find(|row| row.form == form && row.number == number);
            row.map_or(f64::NAN, |row| row.digits)
        };
        assert!(digits(Form::Stable, "f64") > 14.0 && digits(Form::Stable, "f32") > 5.5);
        assert!(digits(Form::Printed, "f64") < digits(Form::Stable, "f64") - 1.0);
    }

    #[test]
    fn rounds_that_are_left_out_change_nothing() {
        let [g, d, r_b, r_t] = SCENE;
        for impacts in [0, 1, 2, 77, 3000, 20_001, 50_000] {
            let simulated = SimulatedImpact {
                inputs: [g, d, r_b, r_t, 6.0, 0.6],
                setup: Setup::Paper,
                impacts,
            };
            assert_eq!(simulated.by_rounds::<f64>(), simulated.by_phase::<f64>(), "{impacts}");
            assert_eq!(simulated.by_rounds::<f32>(), simulated.by_phase::<f32>(), "{impacts}");
        }
    }
}
