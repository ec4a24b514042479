//! How fast motions that start a little apart part, or come together.

use super::{Attractor, Link, Settled};
use crate::impact::{Event, Kind, Start, Widening};
use crate::model::Motion;
use nalgebra::Matrix2;
use std::f64::consts::PI;

/// The largest Lyapunov exponent of what a motion has come to, per unit of time (the forcing period is 2): the mean rate
/// at which the logarithm of a small distance grows.
///
/// Of a cycle it is that of its multipliers, ln |lambda| / (2 periods), as accurate as the cycle; through a rest it is
/// minus infinity, since a rest wipes every distance out. Where the motion does not repeat, it is measured over as many
/// impacts again as were computed before, since the last release if that is in the first half of them, and is a statistic:
/// over a few hundred impacts, some parts in ten. `None`
/// where the motion has ended without a rest, or grazes exactly.
pub fn lyapunov(motion: &Motion<f64>, settled: &Settled, impacts: u32) -> Option<f64> {
    match &settled.attractor {
        Some(found) if found.rests() => Some(f64::NEG_INFINITY),
        Some(found) => of_cycle(motion, found),
        None => measured(motion, settled.end.as_ref()?, impacts),
    }
}

/// From the Jacobians (20), (21) along one cycle.
fn of_cycle(motion: &Motion<f64>, cycle: &Attractor) -> Option<f64> {
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

fn measured(motion: &Motion<f64>, end: &Event<f64>, impacts: u32) -> Option<f64> {
    if end.kind == Kind::Undecided {
        return None;
    }
    let start = Start::from(end);
    let mut events = Widening::new(motion, &start);
    let (mut elapsed, mut released, mut alone) = (0.0, 0.0, 0);
    for index in 0..impacts {
        let Some(event) = events.next().filter(|event| event.kind != Kind::Undecided) else {
            break;
        };
        elapsed = event.time(&start.phase);
        if event.kind == Kind::Release {
            (released, alone) = (elapsed, index);
        }
    }
    let growth = events.growth();
    // one rest that does not come again wipes out only what was before
    let (stretch, elapsed) = if growth.stretch().is_finite() || 2 * alone > impacts {
        (growth.stretch(), elapsed)
    } else {
        (growth.stretch_since_release(), elapsed - released)
    };
    (elapsed > 0.0).then_some(stretch / elapsed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Side;

    fn settled(g: f64, d: f64, [r_b, r_t]: [f64; 2], velocity: f64) -> (Motion<f64>, Settled) {
        let motion = Motion::new(g, d, r_b, r_t).expect("a motion");
        let (side, phase) = (Side::Bottom, 6.18);
        let start = Start { side, phase, velocity };
        let settled = Settled::after(Widening::new(&motion, &start), 500, 60);
        (motion, settled)
    }

    #[test]
    fn a_focus_comes_in_as_its_determinant_says() {
        let (motion, settled) = settled(0.12201, 0.4, [0.5, 0.5], 0.5293);
        let found = lyapunov(&motion, &settled, 500).expect("a cycle");
        assert!((found - 0.25_f64.ln() / 2.0).abs() < 1e-12, "{found}");
    }

    #[test]
    fn what_is_measured_is_what_the_multipliers_say() {
        for d in [0.26, 0.27, 0.33, 0.45] {
            let (motion, settled) = settled(0.12201, d, [0.6, 0.3], 0.5293);
            let exact = lyapunov(&motion, &settled, 500).expect("a cycle");
            let end = settled.end.as_ref().expect("an end");
            let measured = measured(&motion, end, 500).expect("a time");
            assert!(
                exact < 0.0 && (exact - measured).abs() < 0.02,
                "{d}: {exact} {measured}"
            );
        }
    }

    #[test]
    fn a_rest_wipes_every_distance_out() {
        let (motion, settled) = settled(0.12201, 0.18, [0.6, 0.3], 0.5293);
        assert!(settled.attractor.as_ref().is_some_and(Attractor::rests));
        assert_eq!(lyapunov(&motion, &settled, 500), Some(f64::NEG_INFINITY));
    }

    #[test]
    fn chaos_has_an_exponent_above_zero() {
        // FACTS: r .3/.6 from 67 is chaotic at about 90 of 401 values
        let exponents: Vec<f64> = (0..41)
            .filter_map(|index| {
                let (motion, settled) = settled(0.12201, 0.1 + 0.01 * f64::from(index), [0.3, 0.6], 67.0);
                settled.attractor.is_none().then(|| lyapunov(&motion, &settled, 500))?
            })
            .collect();
        let positive = exponents.iter().filter(|exponent| **exponent > 0.05).count();
        assert!(positive >= 5, "{exponents:?}");
    }
}
