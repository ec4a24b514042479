//! Where 1-1 motions bifurcate along the gap, where a device is at an extreme.

use super::StressError;
use super::quantity::Exact;
use super::row::{StressRow, place};
use dynamics::model::Motion;
use dynamics::orbit::{BifurcationPoint, OneOneBranches, OrbitOptions, OutputPrecision, confirm_bifurcation};
use numbers::{Analytic, Decimal, Decimals, Interval, Rung};

/// The device, the bifurcation, and the range of gaps in which it is located.
const INPUTS: [&str; 6] = ["g", "r_B", "r_T", "d", "low", "high"];

/// The extremes, each with g, r_B and r_T of a device and a range of gaps that has a bifurcation or more.
const DEVICES: [(&str, [f64; 3], [f64; 2]); 4] = [
    ("branches, r near 1", [0.12201, 0.999999, 0.99999], [0.226, 0.227]),
    ("branches, |g| near 1", [0.999999, 0.6, 0.3], [0.7, 1.0]),
    ("branches, d near 0", [0.122, 0.6, 0.3], [5e-3, 5.2e-3]),
    ("branches, grazing", [0.3, 0.6, 0.6], [0.34, 0.36]),
];

/// The figures to which gaps are located, and to which two means have to agree.
const FIGURES: usize = 60;
const AGREED: f64 = 1e-45;

/// How far a parameter is moved, relatively, to see how far the gap moves.
const MOVED: f64 = 1e-12;

/// The names of the cases.
pub(super) fn cases() -> impl Iterator<Item = &'static str> {
    DEVICES.into_iter().map(|(case, ..)| case)
}

/// The rows of a case: the gap of each bifurcation as `branch` tells it in f64, against that of the return map.
///
/// # Errors
/// `Point` where there is no bifurcation, or none in decimals; `Reference` where the return map has it elsewhere.
pub(super) fn rows(case: &'static str) -> Result<Vec<StressRow>, StressError> {
    let found = DEVICES.into_iter().find(|(name, ..)| *name == case);
    let Some((_, device, range)) = found else {
        return Err(StressError::NoCase(case.to_owned()));
    };
    let at = |gap: f64| place(&INPUTS, &[device[0], device[1], device[2], gap, range[0], range[1]]);
    let fault = |gap: f64| StressError::Point { case, at: at(gap) };
    let motion = motion(device).ok_or_else(|| fault(f64::NAN))?;
    let prepared = prepared(&motion, range).ok_or_else(|| fault(f64::NAN))?;
    let (told, _) = prepared.bifurcations();
    let decimals = located(&prepared);
    let mut rows = Vec::new();
    for instant in &told {
        let gap = instant.parameter;
        let decimal = nearest(&decimals, instant).ok_or_else(|| fault(gap))?;
        let again = confirm_bifurcation(&motion, decimal, Decimals(FIGURES)).map_err(|_| fault(gap))?;
        let [enclosed, exact] = [decimal, &again].map(|instant| value(&instant.parameter));
        let apart = relative(&enclosed, &exact);
        if apart > AGREED {
            let digits = -apart.log10();
            return Err(StressError::Reference {
                case,
                at: at(gap),
                digits,
            });
        }
        let condition = condition(device, range, instant, &exact).ok_or_else(|| fault(gap))?;
        let error = relative(&Exact::from(gap), &exact);
        rows.push(StressRow::stable(
            case,
            &instant.kind.to_string(),
            error,
            condition,
            at(gap),
        ));
    }
    match rows.is_empty() {
        true => Err(fault(f64::NAN)),
        false => Ok(rows),
    }
}

fn motion([g, r_b, r_t]: [f64; 3]) -> Option<Motion<f64>> {
    Motion::new(g, 1.0, r_b, r_t).ok()
}

fn prepared(motion: &Motion<f64>, [low, high]: [f64; 2]) -> Option<OneOneBranches<&Motion<f64>>> {
    OneOneBranches::new(motion, 1, Interval::new(low, high), &OrbitOptions::DEFAULT).ok()
}

/// The bifurcations in decimals.
fn located(prepared: &OneOneBranches<&Motion<f64>>) -> Vec<BifurcationPoint<Decimal>> {
    let goal = OutputPrecision::decimals(Decimals(FIGURES), Rung::Wide(100));
    prepared.bifurcations_as(&goal).0
}

/// That of the same kind whose gap is nearest.
fn nearest<'a>(found: &'a [BifurcationPoint<Decimal>], to: &BifurcationPoint) -> Option<&'a BifurcationPoint<Decimal>> {
    let apart = |one: &&BifurcationPoint<Decimal>| (one.nearest().parameter - to.parameter).abs();
    let alike = found.iter().filter(|one| one.kind == to.kind);
    alike.min_by(|one, other| apart(one).total_cmp(&apart(other)))
}

fn value(decimal: &Decimal) -> Exact {
    Exact::parse(&decimal.to_string()).unwrap_or(Exact::INVALID)
}

fn relative(one: &Exact, other: &Exact) -> f64 {
    ((one.clone() - other.clone()) / other.clone()).to_f64().abs()
}

/// The most that the gap changes, relatively, for relative changes of g and both restitutions.
fn condition(device: [f64; 3], range: [f64; 2], instant: &BifurcationPoint, exact: &Exact) -> Option<f64> {
    let mut changes = 0.0;
    for index in 0..device.len() {
        let mut moved = device;
        moved[index] *= 1.0 - MOVED;
        let motion = motion(moved)?;
        let found = located(&prepared(&motion, range)?);
        let change = relative(&value(&nearest(&found, instant)?.parameter), exact);
        changes += change / (1.0 - moved[index] / device[index]);
    }
    Some(changes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bifurcation_at_an_extreme_is_told_to_the_last_digits_of_f64() {
        for case in cases() {
            let rows = rows(case).unwrap();
            assert!(rows.iter().all(|row| row.digits > 15.0), "{rows:#?}");
            assert!(rows.iter().all(|row| row.condition.is_finite()), "{rows:#?}");
        }
    }
}
