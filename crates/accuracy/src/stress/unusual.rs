//! Inputs that are no numbers, infinite, subnormal or huge: an error, no number, or the right one; never a wrong one.

use super::row::{BAR, Form, StressRow, place};
use crate::trade::digits_of;
use dynamics::impact::{Kind as What, Simulation, Start};
use dynamics::model::{Device, Flight, Forcing, Impact, Membrane, Motion, Passage, Side, next_impact};
use dynamics::orbit::{FlightJacobian, OneOneEquations, OrbitKind, multipliers, trace};
use std::fmt::Display;

/// A function of one input that varies, the others harmless.
struct Probe {
    formula: &'static str,
    /// The one that varies.
    input: &'static str,
    /// All inputs with their harmless values.
    harmless: &'static [&'static [Input]],
    /// A number, which may be NaN, or an error in its words.
    ask: fn(&Inputs) -> Result<f64, String>,
    /// Subnormal and huge inputs with the right answers, nearest in f64; all by hand, to first order.
    right: &'static [[f64; 2]],
}

/// An input and a value of it.
type Input = (&'static str, f64);

/// What a function is asked for.
struct Inputs(Vec<Input>);

impl Inputs {
    /// The value of an input; NaN where there is none of this name.
    fn of(&self, name: &str) -> f64 {
        let found = self.0.iter().find(|(own, _)| *own == name);
        found.map_or(f64::NAN, |(_, value)| *value)
    }
}

const MOTION: [Input; 4] = [("g", 0.3), ("d", 0.4), ("r_B", 0.5), ("r_T", 0.5)];
const IMPACT: [Input; 2] = [("time", 0.1), ("velocity", 0.5)];
const START: [Input; 2] = [("phase", 0.1), ("velocity", 0.5)];
const MEMBRANE: [Input; 7] = [
    ("speed", 1.0),
    ("mass", 0.0035),
    ("stiffness", 4.0847e5),
    ("exponent", 2.6),
    ("ball", 0.005),
    ("rim", 0.0063),
    ("voltage", 2000.0),
];
const DEVICE: [Input; 5] = [
    ("capsule_mass", 0.1245),
    ("forcing_amplitude", 5.0),
    ("angular_frequency", 15.7),
    ("incline", 0.5),
    ("gravity", 9.8),
];
const LINK: [Input; 6] = [
    ("r", 0.5),
    ("velocity", 0.5),
    ("time", 1.0),
    ("push", 0.4),
    ("pull", 0.2),
    ("arrival", -0.5),
];

/// What no function has an answer to.
const NONSENSE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// The least positive number.
const LEAST: f64 = 5e-324;

fn told<T, E: Display>(result: Result<T, E>) -> Result<T, String> {
    result.map_err(|error| error.to_string())
}

fn motion(at: &Inputs) -> Result<Motion<f64>, String> {
    told(Motion::new(at.of("g"), at.of("d"), at.of("r_B"), at.of("r_T")))
}

fn impact(at: &Inputs) -> Impact<f64> {
    Impact {
        side: Side::Bottom,
        time: at.of("time"),
        velocity: at.of("velocity"),
    }
}

/// The duration of the flight after an impact.
fn duration(at: &Inputs) -> Result<f64, String> {
    let leg = next_impact(&motion(at)?, &Forcing::harmonic(&0.0), &impact(at));
    told(leg).map(|leg| leg.duration)
}

/// The phase of the first event after the start, where there is one that is decided.
fn next_phase(at: &Inputs) -> Result<f64, String> {
    let start = Start::impact(Side::Bottom, at.of("phase"), at.of("velocity"));
    let next = Simulation::new(&motion(at)?, &start).nth(1);
    let next = next.filter(|event| event.kind != What::Undecided);
    next.map(|event| event.phase).ok_or_else(|| "undecided".to_owned())
}

fn membrane(at: &Inputs) -> Result<f64, String> {
    let [mass, stiffness, exponent] = ["mass", "stiffness", "exponent"].map(|name| at.of(name));
    let membrane = Membrane::new(mass, stiffness, exponent, at.of("ball"), at.of("rim"), at.of("voltage"));
    Ok(told(membrane)?.voltage(&at.of("speed")))
}

fn scale(at: &Inputs) -> Result<f64, String> {
    let device = Device {
        capsule_mass: at.of("capsule_mass"),
        forcing_amplitude: at.of("forcing_amplitude"),
        angular_frequency: at.of("angular_frequency"),
        incline: at.of("incline"),
        gravity: at.of("gravity"),
    };
    told(device.scales()).map(|scales| scales.g)
}

fn fall(at: &Inputs) -> Result<f64, String> {
    let flight = Flight::after(&motion(at)?, &Forcing::harmonic(&0.0), &impact(at));
    Ok(told(flight)?.state(&at.of("duration")).displacement)
}

fn balance(at: &Inputs) -> Result<f64, String> {
    Ok(OneOneEquations::new(&motion(at)?, 1).velocities(&at.of("T_1"), &at.of("psi"))[0])
}

fn derivative(at: &Inputs) -> Result<f64, String> {
    let passage = Passage::new(&motion(at)?, &Forcing::harmonic(&0.0), &impact(at), &at.of("T_1"));
    told(passage.by_formula()).map(|matrix| matrix.m11)
}

fn stability(at: &Inputs) -> Result<f64, String> {
    let link = FlightJacobian {
        restitution: at.of("r"),
        velocity: at.of("velocity"),
        time: at.of("time"),
        push: at.of("push"),
        pull: at.of("pull"),
        arrival: at.of("arrival"),
    };
    Ok(trace(&[link]))
}

const PROBES: &[Probe] = &[
    Probe {
        formula: "Motion",
        input: "g",
        harmless: &[&MOTION],
        ask: |at| motion(at).map(|motion| *motion.g()),
        right: &[[LEAST, LEAST], [1e300, 1e300]],
    },
    Probe {
        formula: "Motion",
        input: "d",
        harmless: &[&MOTION],
        ask: |at| motion(at).map(|motion| *motion.d()),
        right: &[[LEAST, LEAST], [1e300, 1e300]],
    },
    Probe {
        formula: "Motion",
        input: "r_B",
        harmless: &[&MOTION],
        ask: |at| motion(at).map(|motion| *motion.restitution(Side::Bottom)),
        right: &[[LEAST, LEAST]],
    },
    Probe {
        formula: "Device",
        input: "angular_frequency",
        harmless: &[&DEVICE],
        ask: scale,
        right: &[],
    },
    Probe {
        formula: "(6)",
        input: "speed",
        harmless: &[&MEMBRANE],
        ask: membrane,
        right: &[[LEAST, 0.0], [-0.0, 0.0]],
    },
    Probe {
        formula: "(6)",
        input: "stiffness",
        harmless: &[&MEMBRANE],
        ask: membrane,
        right: &[],
    },
    Probe {
        formula: "f",
        input: "t",
        harmless: &[&[("t", 0.0)]],
        ask: |at| Ok(Forcing::harmonic(&0.0).at(&at.of("t")).f),
        right: &[[LEAST, 1.0]],
    },
    Probe {
        formula: "F_1",
        input: "t",
        harmless: &[&[("t", 0.0)]],
        ask: |at| Ok(Forcing::harmonic(&0.0).at(&at.of("t")).f1),
        right: &[[LEAST, LEAST]],
    },
    Probe {
        formula: "(4)",
        input: "duration",
        harmless: &[&MOTION, &IMPACT, &[("duration", 0.1)]],
        ask: fall,
        // -r v s
        right: &[[1e-300, -0.25e-300]],
    },
    Probe {
        formula: "(8)",
        input: "velocity",
        harmless: &[&MOTION, &IMPACT],
        ask: duration,
        // d / (r v) without time to fall; 2 r v / (f + g) without room for the push to change
        right: &[[1e300, 8e-301], [1e-290, 7.990_250_574_203_99e-291]],
    },
    Probe {
        formula: "(8)",
        input: "time",
        harmless: &[&MOTION, &IMPACT],
        ask: duration,
        right: &[],
    },
    Probe {
        formula: "simulation",
        input: "phase",
        harmless: &[&MOTION, &START],
        ask: next_phase,
        right: &[],
    },
    Probe {
        formula: "simulation",
        input: "velocity",
        harmless: &[&MOTION, &START],
        ask: next_phase,
        // no time passes
        right: &[[1e300, 0.1], [1e-290, 0.1], [LEAST, 0.1]],
    },
    Probe {
        formula: "(14)-(16)",
        input: "T_1",
        harmless: &[&MOTION, &[("T_1", 0.9), ("psi", 1.0)]],
        ask: balance,
        right: &[],
    },
    Probe {
        formula: "(19)",
        input: "Tr",
        harmless: &[&[("Tr", 0.1), ("loss", 0.18)]],
        ask: |at| Ok(multipliers(&at.of("Tr"), &at.of("loss"), OrbitKind::Focus)[0].im),
        right: &[[LEAST, 0.18]],
    },
    Probe {
        formula: "(20)",
        input: "velocity",
        harmless: &[&MOTION, &IMPACT, &[("T_1", 0.9)]],
        ask: derivative,
        right: &[],
    },
    Probe {
        formula: "(22)",
        input: "arrival",
        harmless: &[&LINK],
        ask: stability,
        right: &[],
    },
];

impl Probe {
    /// The inputs with this value of the one that varies, which comes first.
    fn inputs(&self, input: f64) -> Inputs {
        let others = self.harmless.concat().into_iter();
        let others = others.filter(|(name, _)| *name != self.input);
        Inputs([(self.input, input)].into_iter().chain(others).collect())
    }

    fn row(&self, input: f64, right: Option<f64>) -> StressRow {
        let inputs = self.inputs(input);
        let answer = (self.ask)(&inputs);
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
        let (names, values): (Vec<&str>, Vec<f64>) = inputs.0.into_iter().unzip();
        StressRow {
            case: case.to_owned(),
            formula: self.formula.to_owned(),
            number: "f64".to_owned(),
            form,
            digits,
            condition: if refused { f64::INFINITY } else { 1.0 },
            at: place(&names, &values),
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
    fn harmless_inputs_have_an_answer_so_that_none_that_a_function_needs_is_left_out() {
        for probe in PROBES {
            let harmless = probe.harmless.concat();
            let own = harmless.iter().find(|(name, _)| *name == probe.input).unwrap();
            let answer = (probe.ask)(&probe.inputs(own.1));
            assert!(
                answer.as_ref().is_ok_and(|found| found.is_finite()),
                "{}: {answer:?}",
                probe.formula
            );
        }
    }

    #[test]
    fn a_wrong_number_would_be_seen() {
        let probe = Probe {
            formula: "wrong",
            input: "x",
            harmless: &[&[("x", 0.0)]],
            ask: |_| Ok(1.0),
            right: &[],
        };
        assert!(probe.row(f64::NAN, None).is_below_bar());
        assert!(probe.row(1.0, Some(2.0)).is_below_bar());
        assert!(!probe.row(1.0, Some(1.0)).is_below_bar());
    }
}
