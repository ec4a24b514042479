//! How fast motions that start a little apart part, or come together.

use crate::impact::Event;
use crate::model::Motion;
#[cfg(any(test, feature = "calls"))]
use crate::model::calls::{self, Call};
use crate::orbit::long_run::attractor::Attractor;
use crate::orbit::stability::FlightJacobian;
use nalgebra::Matrix2;
use numbers::Analytic;

/// The largest Lyapunov exponent of a cycle, per unit of time (the forcing period is 2): that of its multipliers,
/// ln |lambda| / (2 periods), as accurate as the cycle; minus infinity through a rest, which wipes every distance out.
/// `None` where the cycle grazes exactly.
pub fn lyapunov(motion: &Motion<f64>, cycle: &Attractor) -> Option<f64> {
    #[cfg(any(test, feature = "calls"))]
    calls::count(Call::Exponent);
    if cycle.rests() {
        return Some(f64::NEG_INFINITY);
    }
    let periods = cycle.periods?;
    let largest = largest_multiplier(motion, &cycle.impacts, periods)?;
    Some(largest.ln() / (2.0 * periods as f64))
}

/// The size of the largest multiplier of a cycle, from the Jacobians (20), (21) along its impacts; `None` where it
/// grazes exactly.
pub fn largest_multiplier<T: Analytic>(motion: &Motion<T>, impacts: &[Event<T>], periods: i64) -> Option<T> {
    let after = |index: usize| impacts.get(index + 1).or(impacts.first());
    let mut product: Matrix2<T> = Matrix2::identity();
    let mut losses = T::one();
    for (index, from) in impacts.iter().enumerate() {
        let to = after(index)?;
        let later = if index + 1 < impacts.len() { 0 } else { periods };
        let restitution = motion.restitution(from.side).clone();
        let turns = T::from_integer(2 * (to.turns + later - from.turns));
        let link = FlightJacobian {
            restitution: restitution.clone(),
            velocity: from.velocity.clone(),
            time: turns + (to.phase.clone() - from.phase.clone()) / T::pi(),
            push: motion.push(&from.phase),
            pull: motion.push(&to.phase),
            arrival: to.velocity.clone(),
        };
        product = link.scaled_jacobian() * product / to.velocity.clone();
        losses *= restitution;
    }
    let trace = product.trace();
    let size = if trace.to_f64() < 0.0 { -trace } else { trace };
    let half = size * T::from_ratio(1, 2);
    // the determinant is the square of the losses
    let apart = (half.clone() - losses.clone()) * (half.clone() + losses.clone());
    let largest = if apart.to_f64() < 0.0 {
        losses
    } else {
        half + apart.sqrt()
    };
    largest.to_f64().is_finite().then_some(largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::{Start, Widening};
    use crate::model::Side;
    use crate::orbit::SteadyState;

    fn cycle(d: f64, [r_b, r_t]: [f64; 2]) -> (Motion<f64>, Attractor) {
        let motion = Motion::new(0.12201, d, r_b, r_t).expect("a motion");
        let (side, phase, velocity) = (Side::Bottom, 6.18, 0.5293);
        let start = Start::impact(side, phase, velocity);
        let settled = SteadyState::after(Widening::new(&motion, &start), 500, 60);
        (motion, settled.attractor.expect("a cycle"))
    }

    #[test]
    fn a_focus_comes_in_as_its_determinant_says() {
        let (motion, cycle) = cycle(0.4, [0.5, 0.5]);
        let found = lyapunov(&motion, &cycle).expect("a number");
        assert!((found - 0.25_f64.ln() / 2.0).abs() < 1e-12, "{found}");
    }

    #[test]
    fn a_rest_wipes_every_distance_out() {
        let (motion, cycle) = cycle(0.18, [0.6, 0.3]);
        assert!(cycle.rests());
        assert_eq!(lyapunov(&motion, &cycle), Some(f64::NEG_INFINITY));
    }
}
