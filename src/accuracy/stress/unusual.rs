//! Inputs that are no numbers, infinite, subnormal or huge: an error, no number, or the right one; never a wrong one.

use super::row::{BAR, Form, StressRow, place};
use crate::accuracy::trade::digits_of;
use crate::impact::{Kind as What, Simulation, Start};
use crate::model::{Device, Flight, Forcing, Impact, Membrane, Motion, Passage, Side, next_impact};
use crate::orbit::{Balance, Kind, Link, multipliers, trace};
use std::fmt::Display;

/// A function of one input, the others harmless.
struct Probe {
    formula: &'static str,
    input: &'static str,
    /// A number, which may be NaN, or an error in its words.
    ask: fn(f64) -> Result<f64, String>,
    /// Subnormal and huge inputs with the right answers, nearest in f64; all by hand, to first order.
    right: &'static [[f64; 2]],
}

/// What no function has an answer to.
const NONSENSE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// The least positive number.
const LEAST: f64 = 5e-324;

fn told<T, E: Display>(result: Result<T, E>) -> Result<T, String> {
    result.map_err(|error| error.to_string())
}

fn motion(g: f64) -> Result<Motion<f64>, String> {
    told(Motion::new(g, 0.4, 0.5, 0.5))
}

fn impact(time: f64, velocity: f64) -> Impact<f64> {
    let side = Side::Bottom;
    Impact { side, time, velocity }
}

/// The duration of the flight after an impact.
fn duration(time: f64, velocity: f64) -> Result<f64, String> {
    let leg = next_impact(&motion(0.3)?, &Forcing::harmonic(&0.0), &impact(time, velocity));
    told(leg).map(|leg| leg.duration)
}

/// The phase of the first event after the start, where there is one that is decided.
fn next_phase(phase: f64, velocity: f64) -> Result<f64, String> {
    let start = Start {
        side: Side::Bottom,
        phase,
        velocity,
    };
    let next = Simulation::new(&motion(0.3)?, &start).nth(1);
    let next = next.filter(|event| event.kind != What::Undecided);
    next.map(|event| event.phase).ok_or_else(|| "undecided".to_owned())
}

fn membrane(speed: f64, stiffness: f64) -> Result<f64, String> {
    let membrane = told(Membrane::new(0.0035, stiffness, 2.6, 0.005, 0.0063, 2000.0))?;
    Ok(membrane.voltage(&speed))
}

fn scale(frequency: f64) -> Result<f64, String> {
    let device = Device {
        capsule_mass: 0.1245,
        forcing_amplitude: 5.0,
        angular_frequency: frequency,
        incline: 0.5,
        gravity: 9.8,
    };
    told(device.scales()).map(|scales| scales.g)
}

fn fall(duration: f64) -> Result<f64, String> {
    let flight = Flight::after(&motion(0.3)?, &Forcing::harmonic(&0.0), &impact(0.0, 0.5));
    Ok(told(flight)?.state(&duration).displacement)
}

fn derivative(velocity: f64) -> Result<f64, String> {
    let passage = Passage::new(&motion(0.3)?, &Forcing::harmonic(&0.0), &impact(0.2, velocity), &0.9);
    told(passage.by_formula()).map(|matrix| matrix.m11)
}

fn stability(arrival: f64) -> Result<f64, String> {
    let link = Link {
        restitution: 0.5,
        velocity: 0.5,
        time: 1.0,
        push: 0.4,
        pull: 0.2,
        arrival,
    };
    Ok(trace(&[link]))
}

const PROBES: &[Probe] = &[
    Probe {
        formula: "Motion",
        input: "g",
        ask: |g| motion(g).map(|motion| *motion.g()),
        right: &[[LEAST, LEAST], [1e300, 1e300]],
    },
    Probe {
        formula: "Motion",
        input: "d",
        ask: |d| told(Motion::new(0.1, d, 0.5, 0.5)).map(|motion| *motion.d()),
        right: &[[LEAST, LEAST], [1e300, 1e300]],
    },
    Probe {
        formula: "Motion",
        input: "r_B",
        ask: |r| told(Motion::new(0.1, 0.4, r, 0.5)).map(|motion| *motion.restitution(Side::Bottom)),
        right: &[[LEAST, LEAST]],
    },
    Probe {
        formula: "Device",
        input: "angular_frequency",
        ask: scale,
        right: &[],
    },
    Probe {
        formula: "(6)",
        input: "speed",
        ask: |speed| membrane(speed, 4.0847e5),
        right: &[[LEAST, 0.0], [-0.0, 0.0]],
    },
    Probe {
        formula: "(6)",
        input: "stiffness",
        ask: |stiffness| membrane(1.0, stiffness),
        right: &[],
    },
    Probe {
        formula: "f",
        input: "t",
        ask: |t| Ok(Forcing::harmonic(&0.0).at(&t).f),
        right: &[[LEAST, 1.0]],
    },
    Probe {
        formula: "F_1",
        input: "t",
        ask: |t| Ok(Forcing::harmonic(&0.0).at(&t).f1),
        right: &[[LEAST, LEAST]],
    },
    Probe {
        formula: "(4)",
        input: "duration",
        ask: fall,
        // -r v s
        right: &[[1e-300, -0.25e-300]],
    },
    Probe {
        formula: "(8)",
        input: "velocity",
        ask: |velocity| duration(0.1, velocity),
        // d / (r v) without time to fall; 2 r v / (f + g) without room for the push to change
        right: &[[1e300, 8e-301], [1e-290, 7.990_250_574_203_99e-291]],
    },
    Probe {
        formula: "(8)",
        input: "time",
        ask: |time| duration(time, 0.5),
        right: &[],
    },
    Probe {
        formula: "simulation",
        input: "phase",
        ask: |phase| next_phase(phase, 0.5),
        right: &[],
    },
    Probe {
        formula: "simulation",
        input: "velocity",
        ask: |velocity| next_phase(0.1, velocity),
        // no time passes
        right: &[[1e300, 0.1], [1e-290, 0.1], [LEAST, 0.1]],
    },
    Probe {
        formula: "(14)-(16)",
        input: "T_1",
        ask: |t_1| Ok(Balance::new(&motion(0.3)?, 1).velocities(&t_1, &1.0)[0]),
        right: &[],
    },
    Probe {
        formula: "(19)",
        input: "Tr",
        ask: |trace| Ok(multipliers(&trace, &0.18, Kind::Focus)[0].im),
        right: &[[LEAST, 0.18]],
    },
    Probe {
        formula: "(20)",
        input: "velocity",
        ask: derivative,
        right: &[],
    },
    Probe {
        formula: "(22)",
        input: "arrival",
        ask: stability,
        right: &[],
    },
];

impl Probe {
    fn row(&self, input: f64, right: Option<f64>) -> StressRow {
        let answer = (self.ask)(input);
        let case = match right {
            Some(_) if input.abs() >= 1.0 => "huge input",
            Some(_) => "subnormal and tiny input",
            None if input.is_nan() => "NaN",
            None => "infinite input",
        };
        let (form, digits, answer) = match (answer, right) {
            (Err(error), _) => (Form::Refused, 0.0, error),
            (Ok(found), _) if !found.is_finite() => (Form::Refused, 0.0, format!("{found:?}")),
            (Ok(found), Some(right)) => {
                let error = if found == right { 0.0 } else { (found - right) / right };
                (Form::Stable, digits_of(error.abs(), f64::EPSILON), format!("{found:?}"))
            }
            // a number where there is none
            (Ok(found), None) => (Form::Stable, 0.0, format!("{found:?}")),
        };
        let refused = form == Form::Refused;
        StressRow {
            case: case.to_owned(),
            formula: self.formula.to_owned(),
            number: "f64".to_owned(),
            form,
            digits,
            condition: if refused { f64::INFINITY } else { 1.0 },
            at: place(&[self.input], &[input]),
            allowed: if refused { 0.0 } else { BAR },
            frozen: None,
            answer,
        }
    }
}

/// A row for each function and unusual input.
pub(super) fn rows() -> Vec<StressRow> {
    let rows = PROBES.iter().flat_map(|probe| {
        let nonsense = NONSENSE.into_iter().map(|input| probe.row(input, None));
        let right = probe.right.iter().map(|[input, right]| probe.row(*input, Some(*right)));
        nonsense.chain(right)
    });
    rows.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nonsense_is_never_answered_by_a_number_and_what_is_tiny_or_huge_by_no_wrong_one() {
        let wrong: Vec<_> = rows().into_iter().filter(StressRow::is_below_bar).collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
    }

    #[test]
    fn a_wrong_number_would_be_seen() {
        let probe = Probe {
            formula: "wrong",
            input: "x",
            ask: |_| Ok(1.0),
            right: &[],
        };
        assert!(probe.row(f64::NAN, None).is_below_bar());
        assert!(probe.row(1.0, Some(2.0)).is_below_bar());
        assert!(!probe.row(1.0, Some(1.0)).is_below_bar());
    }
}
