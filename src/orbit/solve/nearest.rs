//! The motion, or the event, next to a guess: Newton's method in f64. Quick, and proved by nobody.

use crate::number::{Dual, seeded};
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::equations::one_one_bifurcations::Conditioned;
use crate::orbit::family::Family;
use nalgebra::{Matrix3, Vector3};

/// Newton's method from a guess that is no better takes fewer steps than this, or none leads anywhere.
const MOST_STEPS: usize = 20;

/// A step of this size in T_1 and psi squares to less than rounding: the step after it is not needed.
const LAST_STEP: f64 = 1e-7;

/// The 1-1 motion (T_1, psi) that Newton's method leads to, to about 1e-14 where the motion is not near a fold.
///
/// `None` where the steps do not settle. What is found may have velocities that point away from their walls, and is
/// not proved: [`prove`](crate::orbit::prove) does that, [`isolate_one_one`](crate::orbit::isolate_one_one()) needs no guess.
pub fn newton_one_one(balance: &OneOneEquations<f64>, guess: [f64; 2]) -> Option<[f64; 2]> {
    let [mut t_1, mut middle] = guess;
    for _ in 0..MOST_STEPS {
        let ([first, second], [[a, b], [c, d]]) = balance.linearised(&t_1, &middle);
        let determinant = a * d - b * c;
        let step = [
            (d * first - b * second) / determinant,
            (a * second - c * first) / determinant,
        ];
        t_1 -= step[0];
        middle -= step[1];
        let size = step[0].abs() + step[1].abs();
        if size < LAST_STEP {
            return Some([t_1, middle]);
        }
        if !size.is_finite() {
            return None;
        }
    }
    None
}

/// The event (T_1, psi, parameter) that Newton's method leads to: as [`newton_one_one`], with derivatives by dual numbers.
pub fn newton_one_one_bifurcation(system: &Conditioned<impl Family>, guess: [f64; 3]) -> Option<[f64; 3]> {
    let mut point = guess;
    for _ in 0..MOST_STEPS {
        let columns: Vec<[Dual<f64>; 3]> = (0..3)
            .map(|column| {
                let at = std::array::from_fn(|i| {
                    if i == column {
                        seeded(point[i])
                    } else {
                        Dual::from_re(point[i])
                    }
                });
                system.equations(&at).ok()
            })
            .collect::<Option<_>>()?;
        let jacobian = Matrix3::from_fn(|row, column| columns[column][row].eps);
        let values = Vector3::from_fn(|row, _| columns[0][row].re);
        let step = jacobian.lu().solve(&values)?;
        point = std::array::from_fn(|i| point[i] - step[i]);
        let size = step.abs().sum();
        if size < LAST_STEP {
            return Some(point);
        }
        if !size.is_finite() {
            return None;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;
    use crate::orbit::equations::conditions::Condition;

    /// r_B = r_T = 0.5, beta = pi/6, d = 0.4.
    fn motion() -> Motion<f64> {
        let Ok(motion) = Motion::new(0.122_01, 0.4, 0.5, 0.5) else {
            panic!("a motion")
        };
        motion
    }

    #[test]
    fn a_guess_five_percent_off_leads_to_the_motion_whichever_way_it_is_off() {
        let balance = OneOneEquations::new(&motion(), 1);
        let Some(exact) = newton_one_one(&balance, [1.1, 2.2]) else {
            panic!("a motion")
        };
        assert!(balance.residual(&exact[0], &exact[1]).iter().all(|h| h.abs() < 1e-14));
        for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            let guess = [0, 1].map(|i| exact[i] * (1.0 + 0.05 * signs[i]));
            let found = newton_one_one(&balance, guess).map(|found| (found[0] - exact[0]).hypot(found[1] - exact[1]));
            assert!(found.is_some_and(|off| off < 1e-13), "{signs:?} {found:?}");
        }
    }

    #[test]
    fn a_guess_near_the_period_doubling_leads_to_it() {
        let motion = motion();
        let system = Conditioned {
            family: &motion,
            periods: 1,
            condition: Condition::MultiplierMinusOne,
            apart: Vec::new(),
        };
        let found = newton_one_one_bifurcation(&system, [1.3, 2.2, 0.26]);
        // FACTS: d = .25107018538986923
        assert!(
            found.is_some_and(|[_, _, d]| (d - 0.251_070_185_389_869_23).abs() < 1e-13),
            "{found:?}"
        );
    }

    #[test]
    fn where_nothing_is_near_there_is_no_answer() {
        let balance = OneOneEquations::new(&motion(), 1);
        assert_eq!(newton_one_one(&balance, [f64::NAN, 1.0]), None);
    }
}
