//! A million impacts of a motion that attracts: what rounding has made of it by then.

use super::StressError;
use super::motion::{Known, errors, known};
use super::quantity::{Exact, largest, widen};
use super::row::{Form, StressRow, allowed, place};
use crate::accuracy::trade::digits_of;
use crate::impact::{Simulation, Start};
use crate::model::{Flight, Forcing, Impact, Motion, Parameters, Side, Watch};
use crate::number::Analytic;
use crate::orbit::{Fix, Rounded, Word, find};

/// g, d, r_B, r_T: the paper's first orbit.
const SCENE: [f64; 4] = [0.12201, 0.4, 0.5, 0.5];

/// The extreme.
pub(super) const CASE: &str = "a million impacts";

/// How far from the orbit the motion starts: enough to have to settle.
const OFF: f64 = 0.01;

/// The rows after so many impacts, an even number.
///
/// The quantity is the impact at the bottom, phase and velocity, that a motion near a stable 1-1 orbit has come to:
/// that of the orbit, whatever the start. Printed is the map (8) with the time as it is, as the paper's t_k.
///
/// # Errors
/// `Point` where the orbit is not found or not confirmed.
pub(super) fn rows(impacts: u32) -> Result<Vec<StressRow>, StressError> {
    let [g, d, r_b, r_t] = SCENE;
    let at = place(
        &["g", "d", "r_B", "r_T", "impacts"],
        &[g, d, r_b, r_t, f64::from(impacts)],
    );
    let case = CASE;
    let fault = || StressError::Point { case, at: at.clone() };
    let motion = Motion::new(g, d, r_b, r_t).map_err(|_| fault())?;
    let found = find(&motion, &Word::pair(), 1).map_err(|_| fault())?;
    let orbit = found.orbits.iter().find(|orbit| orbit.stable).ok_or_else(fault)?;
    let known = known(SCENE, orbit).ok_or_else(fault)?;
    let [single, double] = [f64::from(f32::EPSILON), f64::EPSILON];
    let made = [
        ("f32", Form::Printed, single, by_time::<f32>(&motion, orbit, impacts)),
        ("f64", Form::Printed, double, by_time::<f64>(&motion, orbit, impacts)),
        ("f32", Form::Stable, single, by_phase::<f32>(&motion, orbit, impacts)),
        ("f64", Form::Stable, double, by_phase::<f64>(&motion, orbit, impacts)),
    ];
    let row = |(number, form, epsilon, fix): (&str, Form, f64, Option<Fix<Exact>>)| StressRow {
        case: case.to_owned(),
        formula: "(8)".to_owned(),
        number: number.to_owned(),
        form,
        digits: digits_of(fix.map_or(f64::NAN, |fix| error(fix, &known)), epsilon),
        condition: known.condition,
        at: at.clone(),
        allowed: allowed(epsilon, known.condition),
        frozen: None,
        answer: String::new(),
    };
    Ok(made.map(row).to_vec())
}

/// Of phase and velocity; the time of the flight after is not known.
fn error(fix: Fix<Exact>, known: &Known) -> f64 {
    let Some(first) = known.fixes.first() else {
        return f64::NAN;
    };
    let time = first.time.clone();
    largest(errors(&[Fix { time, ..fix }], std::slice::from_ref(first)))
}

/// Phase and velocity to start with.
fn start(orbit: &Rounded) -> Option<[f64; 2]> {
    let (phase, velocity) = orbit.phases.first().zip(orbit.velocities.first())?;
    Some([phase + OFF, velocity * (1.0 + OFF)])
}

fn by_phase<T: Analytic>(motion: &Motion<f64>, orbit: &Rounded, impacts: u32) -> Option<Fix<Exact>> {
    let [phase, velocity] = start(orbit)?.map(T::from_f64);
    let side = Side::Bottom;
    let start = Start { side, phase, velocity };
    let event = Simulation::new(&motion.motion::<T>().ok()?, &start).nth(impacts as usize)?;
    (event.side == Side::Bottom).then(|| Fix {
        phase: widen(&event.phase),
        velocity: widen(&event.velocity),
        time: Exact::from(0.0),
    })
}

fn by_time<T: Analytic>(motion: &Motion<f64>, orbit: &Rounded, impacts: u32) -> Option<Fix<Exact>> {
    let [phase, velocity] = start(orbit)?;
    let motion: Motion<T> = motion.motion().ok()?;
    let forcing = Forcing::harmonic(&T::zero());
    let mut impact = Impact {
        side: Side::Bottom,
        time: T::from_f64(phase / std::f64::consts::PI),
        velocity: T::from_f64(velocity),
    };
    for _ in 0..impacts {
        let flight = Flight::after(&motion, &forcing, &impact).ok()?;
        let crossing = flight.crossing(Watch::Both).ok()?;
        let velocity = flight.state(&crossing.duration).velocity;
        impact = Impact {
            side: crossing.side,
            time: impact.time + crossing.duration,
            velocity,
        };
    }
    (impact.side == Side::Bottom).then(|| Fix {
        phase: widen(&impact.time) * Exact::pi(),
        velocity: widen(&impact.velocity),
        time: Exact::from(0.0),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_some_thousand_impacts_the_time_has_cost_digits_and_the_phase_none() {
        let rows = rows(4000).unwrap();
        let digits = |form, number: &str| {
            let row = rows.iter().find(|row| row.form == form && row.number == number);
            row.map_or(f64::NAN, |row| row.digits)
        };
        assert!(digits(Form::Stable, "f64") > 14.0 && digits(Form::Stable, "f32") > 5.5);
        assert!(digits(Form::Printed, "f64") < digits(Form::Stable, "f64") - 1.0);
    }
}
