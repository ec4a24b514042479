//! What a sweep shows of a motion that attracts, where a device is at an extreme: its impacts, and their mean voltage.

use super::StressError;
use super::impacts::SimulatedImpact;
use super::motion::{Known, errors, known};
use super::quantity::{Exact, largest, widen};
use super::row::StressRow;
use super::voltage::{membrane_at, of_paper};
use crate::impact::{Event, Simulation, Start};
use crate::model::{Motion, Side};
use crate::number::Analytic;
use crate::orbit::{
    Attractor, Averaging, AveragingLength, CycleMeans, LongRun, OrbitImpact, RoundedOrbit, SteadyState, Word, find,
    multipliers,
};

/// The extremes, each with g, d, r_B and r_T of a device that has a stable 1-1 motion, and the impacts after which what is
/// left of a start beside it is less than f64 tells.
const DEVICES: [(&str, [f64; 4], u32); 3] = [
    ("sweeps, r near 1", [0.1, 0.5, 0.9999, 0.9999], 1_000_000),
    ("sweeps, |g| near 1", [0.999999, 2.0, 0.9, 0.9], 2000),
    ("sweeps, d large", [0.1, 4.0, 0.999, 0.999], 100_000),
];

/// How far from the motion the start is, relatively.
const OFF: f64 = 1e-3;

/// The names of the cases.
pub(super) fn cases() -> impl Iterator<Item = &'static str> {
    DEVICES.into_iter().map(|(case, ..)| case)
}

/// The impacts that a voltage per forcing period is measured over, in whole periods: enough for every batch.
const MEASURED: u32 = 2000;

/// The rows of a case: phases and velocities of the cycle that [`SteadyState`] finds, the mean (7) of their voltages and
/// their sum per forcing period, of the cycle and as it is measured where a motion does not repeat, against those of the
/// motion itself.
///
/// # Errors
/// `Point` where there is no stable motion, it is not confirmed, or the sweep comes to another one.
pub(super) fn rows(case: &'static str) -> Result<Vec<StressRow>, StressError> {
    let found = DEVICES.into_iter().find(|(name, ..)| *name == case);
    let Some((_, device, impacts)) = found else {
        return Err(StressError::NoCase(case.to_owned()));
    };
    let [g, d, r_b, r_t] = device;
    let from = |phase: f64, velocity: f64| SimulatedImpact {
        inputs: [g, d, r_b, r_t, phase, velocity],
        impacts,
    };
    let fault = || StressError::Point {
        case,
        at: from(f64::NAN, f64::NAN).at(),
    };
    let motion = Motion::new(g, d, r_b, r_t).map_err(|_| fault())?;
    let found = find(&motion, &Word::pair(), 1).map_err(|_| fault())?;
    let orbit = found.orbits.iter().find(|orbit| orbit.stable).ok_or_else(fault)?;
    let known = known(device, orbit).ok_or_else(fault)?;
    let condition = known.condition * gathered(orbit);
    let start = start(orbit).ok_or_else(fault)?;
    let settled = SteadyState::after(Simulation::new(&motion, &start), impacts, 2);
    let attractor = settled.attractor.ok_or_else(fault)?;
    if attractor.impacts.len() != known.fixes.len() {
        return Err(fault());
    }
    let at = from(start.phase, start.velocity).at();
    let of_impacts = of_impacts(&attractor.impacts, &known);
    let mut rows = vec![StressRow::stable(
        case,
        "(8) until it repeats",
        of_impacts,
        condition,
        at.clone(),
    )];
    let at = format!("{at};{}", membrane_at());
    let voltages = voltages(&motion, &attractor, &known).ok_or_else(fault)?;
    let of_voltage = |(formula, error): (&str, f64)| StressRow::stable(case, formula, error, condition, at.clone());
    rows.extend(voltages.map(of_voltage));
    Ok(rows)
}

/// What roundings of one size at every cycle come to: 1 / (1 - the size of the larger multiplier), the sum of what is left
/// of each.
fn gathered(orbit: &RoundedOrbit) -> f64 {
    let [larger, _] = multipliers(&orbit.trace, &orbit.determinant.sqrt(), orbit.kind);
    1.0 / (1.0 - larger.re.hypot(larger.im))
}

fn start(orbit: &RoundedOrbit) -> Option<Start<f64>> {
    let (phase, velocity) = orbit.phases.first().zip(orbit.velocities.first())?;
    Some(Start {
        side: Side::Bottom,
        phase: *phase + OFF,
        velocity: velocity * (1.0 + OFF),
    })
}

/// Of phases and velocities; times are not told.
fn of_impacts(impacts: &[Event<f64>], known: &Known) -> f64 {
    let fixes = impacts.iter().zip(&known.fixes).map(|(event, fix)| OrbitImpact {
        phase: widen(&event.phase),
        velocity: widen(&event.velocity),
        time: fix.time.clone(),
    });
    largest(errors(&fixes.collect::<Vec<_>>(), &known.fixes))
}

/// Relative errors of the mean voltage and of both voltages per forcing period, of which the motion takes one.
fn voltages(motion: &Motion<f64>, attractor: &Attractor, known: &Known) -> Option<[(&'static str, f64); 3]> {
    let (narrow, wide) = (of_paper::<f64>()?, of_paper::<Exact>()?);
    let voltage = |event: &Event<f64>| narrow.voltage(&event.velocity);
    let measure = Averaging {
        motion,
        length: AveragingLength {
            impacts: MEASURED,
            error: None,
            most: MEASURED,
        },
        voltage: Some(&voltage),
        with_growth: false,
        at_releases: false,
    };
    let cycle = CycleMeans::of(&measure, motion, attractor).ok()?;
    let measured = match measure.after(attractor.impacts.last()?) {
        LongRun::Measured(statistics) => statistics.rate?.value,
        LongRun::Released(..) => return None,
    };
    let mut sum = <Exact as Analytic>::from_f64(0.0);
    for fix in &known.fixes {
        sum += wide.voltage(&fix.velocity);
    }
    let mean = sum.clone() / <Exact as Analytic>::from_f64(known.fixes.len() as f64);
    let error = |found: f64, exact: &Exact| ((widen(&found) - exact.clone()) / exact.clone()).to_f64().abs();
    Some([
        ("(7)", error(cycle.voltage?, &mean)),
        ("voltage_rate", error(cycle.rate?, &sum)),
        ("voltage_rate measured", error(measured, &sum)),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sweep_keeps_at_an_extreme_what_conditioning_allows() {
        for case in cases() {
            let rows = rows(case).unwrap();
            assert!(rows.iter().all(|row| !row.is_below_bar()), "{rows:#?}");
            assert!(rows.iter().any(|row| row.formula == "voltage_rate"));
        }
    }
}
