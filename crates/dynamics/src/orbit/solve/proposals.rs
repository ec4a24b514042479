//! The explicit curve on which the 1-1 motions lie, and the likely ones on it.
//!
//! h_2 of [`OneOneEquations`] is linear in P = sin psi and has no Q = cos psi, h_1 is then linear in Q: for every T_1 both
//! follow, and P² + Q² = 1 is one equation in T_1 alone (the closed form of FACTS: (14) minus (15), multiplied out,
//! at a given d). Its roots are found here by Brent's method from changes of sign on a grid; they are likely, no more: what is
//! between two points of the grid, and what is double, is the business of [`isolate`](crate::orbit::isolate()).

use crate::orbit::equations::one_one::OneOneEquations;
use roots::{SimpleConvergency, find_root_brent};

/// Points of the grid for each period of the forcing.
const POINTS: u32 = 48;

/// The likely 1-1 motions, as (T_1, psi) with psi in (-pi, pi].
pub fn propose(balance: &OneOneEquations<f64>) -> Vec<[f64; 2]> {
    let total = balance.total();
    let points = (total / 2.0 * f64::from(POINTS)) as u32;
    let at = |index: u32| total * f64::from(index) / f64::from(points);
    let excess = |t_1: f64| balance.middle(&t_1).map_or(f64::NAN, |[_, excess]| excess);
    let mut proposals = Vec::new();
    // A root may lie on a point of the grid, where a scene has it on purpose: a grid of odd spacing misses it less.
    let mut before = (at(0), excess(at(0) + f64::EPSILON));
    for index in 1..=points {
        let here = at(index) - total / f64::from(points) * 0.381_966_011_25;
        let after = (here, excess(here));
        if before.1 * after.1 < 0.0 {
            let mut convergency = SimpleConvergency {
                eps: 1e-14,
                max_iter: 60,
            };
            // Brent's method ends on a pole as readily as on a root; the proof that follows tells them apart.
            let root = find_root_brent(before.0, after.0, excess, &mut convergency).ok();
            proposals.extend(root.and_then(|t_1| Some([t_1, balance.middle(&t_1)?[0]])));
        }
        before = after;
    }
    proposals
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;

    #[test]
    fn the_printed_orbit_is_proposed_and_what_is_proposed_is_on_the_curve() {
        let motion = Motion::new(0.12201, 0.4, 0.5, 0.5).expect("a motion");
        let balance = OneOneEquations::new(&motion, 1);
        let proposals = propose(&balance);
        let printed = |[t_1, middle]: &&[f64; 2]| {
            let phase = balance.phases(t_1, middle)[0];
            (t_1 - 1.116_500_659_3).abs() < 1e-9 && (0.5 * (phase - 0.489_395_114_7)).sin().abs() < 1e-9
        };
        assert_eq!(proposals.iter().filter(printed).count(), 1, "{proposals:?}");
        for [t_1, middle] in &proposals {
            assert!((0.0..2.0).contains(t_1) && middle.abs() <= std::f64::consts::PI);
            assert!(
                balance.residual(t_1, middle).iter().all(|h| h.abs() < 1e-9),
                "{t_1} {middle}"
            );
        }
    }
}
