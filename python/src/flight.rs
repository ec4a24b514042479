//! The one-impact map (8) over arrays of states.

use super::{buffer, input_error, watched};
use pyo3::prelude::*;
use rayon::prelude::*;
use vibro_audit::model::{FlightError, Forcing, Impact, Motion, Passage, Side, next_impact as next};
use vibro_audit::stop::Token;

/// Where a flight ends, and DP by rows.
struct Arrival {
    side: Side,
    duration: f64,
    phase: f64,
    velocity: f64,
    jacobian: [f64; 4],
}

/// Sides, times, phases, velocities, the Jacobian, and of each state without a next impact the reason.
type Found = (Vec<Option<&'static str>>, [Py<PyAny>; 4], Vec<(usize, String)>);

/// The squares of velocities lose digits in f64 below 1e-154 and are 0 below 1e-162, and with them what tells a short hop
/// from none; some orders are left for what they are multiplied by.
const SLOWEST: f64 = 1e-140;

fn arrival(
    motion: &Motion<f64>,
    side: Side,
    phase: f64,
    velocity: f64,
    with_jacobian: bool,
) -> Result<Arrival, String> {
    if velocity != 0.0 && velocity.abs() < SLOWEST {
        return Err(format!(
            "its velocity {velocity:e} is too small to be followed in f64: at least {SLOWEST:e} is needed, or 0"
        ));
    }
    let told = |error: FlightError| error.to_string();
    let forcing = Forcing::harmonic(&phase);
    let impact = Impact {
        side,
        time: 0.0,
        velocity,
    };
    let leg = next(motion, &forcing, &impact).map_err(told)?;
    let jacobian = if with_jacobian {
        let passage = Passage::new(motion, &forcing, &impact, &leg.duration);
        let found = passage.by_formula().map_err(|error| error.to_string())?;
        [found[(0, 0)], found[(0, 1)], found[(1, 0)], found[(1, 1)]]
    } else {
        [f64::NAN; 4]
    };
    let turn = std::f64::consts::TAU;
    let end = (phase + std::f64::consts::PI * leg.duration).rem_euclid(turn);
    Ok(Arrival {
        side: leg.to.side,
        duration: leg.duration,
        // rounding may reach the whole turn
        phase: if end < turn { end } else { 0.0 },
        velocity: leg.to.velocity,
        jacobian,
    })
}

fn numbers(bytes: &[u8]) -> Vec<f64> {
    let (each, _) = bytes.as_chunks::<8>();
    each.iter().map(|own| f64::from_ne_bytes(*own)).collect()
}

/// The impact after each of these: `is_top` a byte each, `phases` and `velocities` the bytes of f64, all of one length.
#[pyfunction]
pub fn next_impact(
    py: Python<'_>,
    is_top: &[u8],
    phases: &[u8],
    velocities: &[u8],
    parameters: [f64; 4],
    with_jacobian: bool,
) -> PyResult<Found> {
    let [g, d, r_b, r_t] = parameters;
    let motion = Motion::new(g, d, r_b, r_t).map_err(|error| input_error(py, (error.to_string(),)))?;
    let (is_top, phases, velocities) = (is_top.to_vec(), numbers(phases), numbers(velocities));
    let count = is_top.len();
    let arrivals: Vec<Result<Arrival, String>> = watched::run(py, move || {
        let token = Token::current();
        let states = (is_top, phases, velocities).into_par_iter();
        states
            .map(|(is_top, phase, velocity)| {
                if token.is_stopped() {
                    return Err("stopped".to_owned());
                }
                let side = if is_top == 0 { Side::Bottom } else { Side::Top };
                arrival(&motion, side, phase, velocity, with_jacobian)
            })
            .collect()
    })?;
    let sides = arrivals.iter().map(|found| {
        found.as_ref().ok().map(|found| match found.side {
            Side::Bottom => "bottom",
            Side::Top => "top",
        })
    });
    let array = |of: fn(&Arrival) -> f64| {
        let numbers = arrivals.iter().map(|found| found.as_ref().map_or(f64::NAN, of));
        buffer(py, "d", &[count], &numbers.collect::<Vec<_>>(), f64::to_ne_bytes)
    };
    let jacobians = arrivals
        .iter()
        .flat_map(|found| found.as_ref().map_or([f64::NAN; 4], |found| found.jacobian));
    let jacobians = buffer(
        py,
        "d",
        &[count, 2, 2],
        &jacobians.collect::<Vec<_>>(),
        f64::to_ne_bytes,
    )?;
    let arrays = [
        array(|found| found.duration)?,
        array(|found| found.phase)?,
        array(|found| found.velocity)?,
        jacobians,
    ];
    let faults = arrivals.iter().enumerate();
    let faults = faults.filter_map(|(place, found)| Some((place, found.as_ref().err()?.clone())));
    Ok((sides.collect(), arrays, faults.collect()))
}
