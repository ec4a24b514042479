//! What a sweep or a map shows of a motion that attracts, where a device is at an extreme: its impacts, and their mean
//! voltage; and the best device near that extreme.

use super::StressError;
use super::impacts::{Setup, SimulatedImpact};
use super::motion::{Known, errors, known};
use super::quantity::{Exact, largest, widen};
use super::row::{StressRow, place};
use super::voltage::{membrane_at, of_paper};
use dynamics::impact::{Event, Simulation, Start, Widening, in_lanes};
use dynamics::model::{Motion, Side};
use dynamics::orbit::{
    AtRelease, Attractor, Averaging, AveragingLength, Choice, CycleMeans, Devices, Gap, LongRun, OptimumLimits,
    OptimumPart, OrbitImpact, OrbitOptions, Pull, Range, RoundedOrbit, Settling, SteadyState, Unit, Word, find,
    multipliers, optimum,
};
use numbers::{Analytic, Interval};

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
    let known = known(device, orbit).ok_or_else(fault)?;
    let condition = known.condition * gathered(orbit);
    let start = start(orbit).ok_or_else(fault)?;
    let settled = SteadyState::after(Simulation::new(&motion, &start), impacts, 2);
    let attractor = settled.attractor.ok_or_else(fault)?;
    let in_a_lane = settled_in_a_lane(&motion, &start, impacts).ok_or_else(fault)?;
    let at = from(start.phase, start.velocity).at();
    let mut rows = Vec::new();
    for (formula, attractor) in [
        ("(8) until it repeats", &attractor),
        ("(8) in lanes until it repeats", &in_a_lane),
    ] {
        if attractor.impacts.len() != known.fixes.len() {
            return Err(fault());
        }
        let error = of_impacts(&attractor.impacts, &known);
        rows.push(StressRow::stable(case, formula, error, condition, at.clone()));
    }
    let at = format!("{at};{}", membrane_at());
    let voltages = voltages(&motion, &attractor, &known).ok_or_else(fault)?;
    let of_voltage = |(formula, error): (&str, f64)| StressRow::stable(case, formula, error, condition, at.clone());
    rows.extend(voltages.map(of_voltage));
    rows.push(best_device(case, device).ok_or_else(fault)?);
    Ok(rows)
}

/// As `map` and `basins` follow it.
fn settled_in_a_lane(motion: &Motion<f64>, start: &Start<f64>, impacts: u32) -> Option<Attractor> {
    let settling = Settling::new(impacts, 2, &OrbitOptions::DEFAULT);
    let mut found = None;
    let motions = [(Widening::new(motion, start).without_growth(), settling)];
    in_lanes(
        motions,
        false,
        |settling, event, _| settling.take(event),
        |settling, _| found = settling.steady_state().attractor,
    );
    found
}

/// How far below a device's restitutions and gap those of a choice begin, relatively.
const LOWER: f64 = 1e-4;

/// The voltage per forcing period of the best device near one, as [`optimum`] proves it, against that of its motion in many
/// digits.
fn best_device(case: &'static str, [g, d, r_b, r_t]: [f64; 4]) -> Option<StressRow> {
    let below = |value: f64| Range {
        low: Interval::point(value * (1.0 - LOWER)),
        high: Interval::point(value),
    };
    let choice = Choice {
        devices: Devices {
            gap: Gap::Itself,
            pull: Pull::Itself,
            unit: Unit::Same(Interval::point(1.0)),
            membrane: of_paper()?,
        },
        ranges: [below(d), Range::held(Interval::point(g)), below(r_b), below(r_t)],
        max_periods: 1,
        margin: Interval::point(0.0),
        clearance: Interval::point(0.0),
    };
    let limits = OptimumLimits {
        gap: GAP,
        most_boxes: MOST_BOXES,
        part: OptimumPart::WHOLE,
    };
    let device = optimum(&choice, limits, |_| ()).device?;
    let [d, g, r_b, r_t] = device.parameters.map(|parameter| parameter.midpoint());
    let motion = Motion::new(g, d, r_b, r_t).ok()?;
    let orbits = find(&motion, &Word::pair(), 1).ok()?.orbits;
    let apart = |orbit: &&RoundedOrbit| {
        let velocities = orbit.velocities.iter().zip(&device.orbit.velocities);
        velocities
            .map(|(one, other)| (one - other.midpoint()).abs())
            .sum::<f64>()
    };
    let orbit = orbits.iter().min_by(|one, other| apart(one).total_cmp(&apart(other)))?;
    let known = known([g, d, r_b, r_t], orbit)?;
    let wide = of_paper::<Exact>()?;
    let mut sum = <Exact as Analytic>::from_f64(0.0);
    for fix in &known.fixes {
        sum += wide.voltage(&fix.velocity);
    }
    let error = ((widen(&device.rate.midpoint()) - sum.clone()) / sum).to_f64().abs();
    let at = place(&["g", "d", "r_B", "r_T"], &[g, d, r_b, r_t]);
    Some(StressRow::stable(
        case,
        "optimum",
        error,
        known.condition,
        format!("{at};{}", membrane_at()),
    ))
}

/// How far searches for the best device go.
const GAP: f64 = 1e-3;
const MOST_BOXES: u64 = 20_000;

/// What roundings of one size at every cycle come to: 1 / (1 - the size of the larger multiplier), the sum of what is left
/// of each.
fn gathered(orbit: &RoundedOrbit) -> f64 {
    let [larger, _] = multipliers(&orbit.trace, &orbit.determinant.sqrt(), orbit.kind);
    1.0 / (1.0 - larger.re.hypot(larger.im))
}

fn start(orbit: &RoundedOrbit) -> Option<Start<f64>> {
    let (phase, velocity) = orbit.phases.first().zip(orbit.velocities.first())?;
    Some(Start::impact(Side::Bottom, *phase + OFF, velocity * (1.0 + OFF)))
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
        at_release: AtRelease::Passes { longer_than: u64::MAX },
    };
    let cycle = CycleMeans::of(&measure, motion, attractor).ok()?;
    let measured = match measure.after(attractor.impacts.last()?) {
        LongRun::Measured(statistics) => statistics.rate?.value,
        LongRun::Released(..) | LongRun::Repeats(_) => return None,
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
