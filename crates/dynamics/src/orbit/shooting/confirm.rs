//! Rows of the first means as the second one has them.

use crate::model::Parameters;
use crate::orbit::bifurcation::point::BifurcationPoint;
use crate::orbit::equations::flight::OrbitImpact;
use crate::orbit::family::Family;
use crate::orbit::orbit::reduced;
use crate::orbit::rounding::RoundedOrbit;
use crate::orbit::shooting::return_map::{ShootingError, ShootingSolution, shoot, shoot_bifurcation};
use numbers::{Decimal, Decimals, Interval, Telling, Told, Wide};

/// The digits of the second means; it loses some to the condition of a motion.
const DIGITS: usize = 100;

type Number = Wide<DIGITS>;

fn told(decimals: Decimals, value: Number) -> Decimal {
    decimals.tell(&Interval::point(value))
}

/// Phases, velocities and times.
fn lists(decimals: Decimals, fixes: &[OrbitImpact<Number>]) -> [Vec<Decimal>; 3] {
    let phase = |fix: &OrbitImpact<Number>| decimals.tell(&reduced(&Interval::point(fix.phase.clone())));
    [
        fixes.iter().map(phase).collect(),
        fixes.iter().map(|fix| told(decimals, fix.velocity.clone())).collect(),
        fixes.iter().map(|fix| told(decimals, fix.time.clone())).collect(),
    ]
}

/// A motion by the return map instead, near where the first means has it: phases, velocities, times, trace and
/// determinant, to at most 60 figures. The clearance is not known, nor a bound; what is no number is as it was.
///
/// # Errors
/// Those of [`shoot`].
pub fn confirm_orbit(
    parameters: &impl Parameters,
    orbit: &RoundedOrbit<Decimal>,
    decimals: Decimals,
) -> Result<RoundedOrbit<Decimal>, ShootingError> {
    let ShootingSolution {
        fixes,
        trace,
        determinant,
    } = shoot(&parameters.motion::<Number>()?, &orbit.nearest())?;
    let [phases, velocities, times] = lists(decimals, &fixes);
    let tell = |value: Option<Number>| value.map_or_else(Decimal::unknown, |value| told(decimals, value));
    Ok(RoundedOrbit {
        phases,
        velocities,
        times,
        trace: tell(trace),
        determinant: tell(determinant),
        clearance: Decimal::unknown(),
        error_bound: None,
        ..orbit.clone()
    })
}

/// A bifurcation by the return map instead, near where the first means has it: the parameter, d, phases, velocities,
/// times and trace, to at most 60 figures.
///
/// # Errors
/// Those of [`shoot_bifurcation`].
pub fn confirm_bifurcation(
    family: &impl Family,
    point: &BifurcationPoint<Decimal>,
    decimals: Decimals,
) -> Result<BifurcationPoint<Decimal>, ShootingError> {
    let (parameter, found) = shoot_bifurcation::<Number>(family, &point.nearest())?;
    let d = family.motion_at(&parameter)?.d().clone();
    let lists = lists(decimals, &found.fixes);
    let [phases, velocities, times] = lists;
    Ok(BifurcationPoint {
        parameter: told(decimals, parameter),
        d: told(decimals, d),
        phases,
        velocities,
        times,
        trace: found
            .trace
            .map_or_else(Decimal::infinite, |trace| told(decimals, trace)),
        clearance: Decimal::unknown(),
        error_bound: None,
        ..point.clone()
    })
}
