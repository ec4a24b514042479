//! How fast motions that start a little apart part, or come together.

use super::{Attractor, Link};
use crate::impact::Event;
use crate::model::Motion;
#[cfg(test)]
use crate::model::calls::{self, Call};
use nalgebra::Matrix2;
use std::f64::consts::PI;

/// The largest Lyapunov exponent of a cycle, per unit of time (the forcing period is 2): that of its multipliers,
/// ln |lambda| / (2 periods), as accurate as the cycle; minus infinity through a rest, which wipes every distance out.
/// `None` where the cycle grazes exactly.
pub fn lyapunov(motion: &Motion<f64>, cycle: &Attractor) -> Option<f64> {
    #[cfg(test)]
    calls::count(Call::Exponent);
    if cycle.rests() {
        return Some(f64::NEG_INFINITY);
    }
    of_multipliers(motion, cycle)
}

/// From the Jacobians (20), (21) along one cycle.
fn of_multipliers(motion: &Motion<f64>, cycle: &Attractor) -> Option<f64> {
    let periods = cycle.periods?;
    let impacts = &cycle.impacts;
    let push = |event: &Event<f64>| event.phase.cos() + motion.g();
    let after = |index: usize| impacts.get(index + 1).or(impacts.first());
    let mut product = Matrix2::identity();
    let mut determinant = 1.0;
    for (index, from) in impacts.iter().enumerate() {
        let to = after(index)?;
        let later = if index + 1 < impacts.len() { 0 } else { periods };
        let restitution = *motion.restitution(from.side);
        let link = Link {
            restitution,
            velocity: from.velocity,
            time: 2.0 * (to.turns + later - from.turns) as f64 + (to.phase - from.phase) / PI,
            push: push(from),
            pull: push(to),
            arrival: to.velocity,
        };
        product = link.scaled_jacobian() * product / to.velocity;
        determinant *= restitution * restitution;
    }
    let half = 0.5 * product.trace();
    let apart = half * half - determinant;
    let largest = if apart < 0.0 {
        determinant.sqrt()
    } else {
        half.abs() + apart.sqrt()
    };
    largest.is_finite().then(|| largest.ln() / (2.0 * periods as f64))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::{Start, Widening};
    use crate::model::Side;
    use crate::orbit::Settled;

    fn cycle(d: f64, [r_b, r_t]: [f64; 2]) -> (Motion<f64>, Attractor) {
        let motion = Motion::new(0.12201, d, r_b, r_t).expect("a motion");
        let (side, phase, velocity) = (Side::Bottom, 6.18, 0.5293);
        let start = Start { side, phase, velocity };
        let settled = Settled::after(Widening::new(&motion, &start), 500, 60);
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
