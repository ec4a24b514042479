//! The velocity at the bottom of a 1-1 motion: (14), (15), (16), and by the balance without a denominator that vanishes.

use super::StressError;
use super::approach::{Approach, DEAD, LOSSLESS, TURN};
use super::closed::{self, Closed};
use super::paper::{Formula, Paper, Values};
use super::quantity::{Number, Quantity, Visitor};
use dynamics::model::{Forcing, Motion};
use dynamics::orbit::OneOneEquations;
use std::f64::consts::PI;

/// Which denominator comes near 0.
#[derive(Clone, Copy)]
enum Extreme {
    /// 1 - r_B r_T in (14).
    Loss,
    /// T_1 - r_T T_2 in (15).
    Turn,
    /// r_B in (16).
    Dead,
}

/// One of the three formulas near its extreme.
struct Velocity {
    extreme: Extreme,
    formula: Formula,
}

/// The misprint of (16) and its mend: the last term belongs inside the bracket.
pub(super) const MEND: (&str, &str) = (r"\right] - F_1(t_k) T_1", r"- F_1(t_k) T_1 \right]");

/// Visits (14), (15) and (16).
pub(super) fn each(paper: &Paper, visitor: &mut impl Visitor) -> Result<(), StressError> {
    for (extreme, label, mended) in [
        (Extreme::Loss, "14", &[][..]),
        (Extreme::Turn, "15", &[]),
        (Extreme::Dead, "16", &[MEND]),
    ] {
        let formula = paper.formula(label, mended)?;
        visitor.visit(&Velocity { extreme, formula })?;
    }
    Ok(())
}

impl Quantity for Velocity {
    fn case(&self) -> &'static str {
        match self.extreme {
            Extreme::Loss => "r_B r_T near 1",
            Extreme::Turn => "T_1 near r_T T_2",
            Extreme::Dead => "r_B near 0",
        }
    }

    fn formula(&self) -> &'static str {
        match self.extreme {
            Extreme::Loss => "(14)",
            Extreme::Turn => "(15)",
            Extreme::Dead => "(16)",
        }
    }

    fn inputs(&self) -> &'static [&'static str] {
        &["r_B", "r_T", "T_1", "psi"]
    }

    fn dials(&self) -> Vec<[f64; 2]> {
        let others = [[0.05, 0.95], [0.2, 1.8], [-PI, PI]];
        match self.extreme {
            Extreme::Loss => vec![[-15.0, -1.0], [-15.0, -1.0], others[1], others[2]],
            Extreme::Turn => vec![[-15.0, -1.0], others[0], others[0], others[2]],
            Extreme::Dead => vec![[-15.0, -1.0], others[0], others[1], others[2]],
        }
    }

    fn set(&self, dials: &[f64]) -> Vec<f64> {
        let [first, second, third, psi] = [0, 1, 2, 3].map(|at| dials.get(at).copied().unwrap_or(f64::NAN));
        let small = 10_f64.powf(first);
        match self.extreme {
            Extreme::Loss => vec![1.0 - small, 1.0 - 10_f64.powf(second), third, psi],
            Extreme::Turn => {
                let (r_b, r_t) = (second, third);
                let balanced = 2.0 * r_t / (1.0 + r_t);
                vec![r_b, r_t, balanced * (1.0 + small), psi]
            }
            Extreme::Dead => vec![small, second, third, psi],
        }
    }

    fn approach(&self) -> Approach {
        match self.extreme {
            Extreme::Loss => LOSSLESS,
            Extreme::Turn => TURN,
            Extreme::Dead => DEAD,
        }
    }

    fn near(&self, exponent: f64) -> Vec<Vec<f64>> {
        vec![match self.extreme {
            Extreme::Loss => vec![exponent, exponent, 1.3, 1.8],
            Extreme::Turn => vec![exponent, 0.5, 0.5, 2.4],
            Extreme::Dead => vec![exponent, 0.5, 1.1, 3.0],
        }]
    }

    fn exponents(&self) -> Vec<f64> {
        [-1, -3, -6, -9, -12, -15].map(f64::from).to_vec()
    }

    fn given_names(&self) -> &'static [&'static str] {
        &closed::NAMES
    }

    fn given<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
        let [r_b, r_t, t_1, psi] = inputs else {
            return None;
        };
        Closed::by_phase(r_b, r_t, t_1, psi).map(Closed::list)
    }

    fn reference<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
        let given = self.given(inputs)?;
        Closed::of(&given).map(|closed| vec![closed.velocities[0].clone()])
    }

    fn printed<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
        let closed = Closed::of(given)?;
        let forcing = Forcing::harmonic(&T::zero());
        let [start, end] = closed.times.each_ref().map(|time| forcing.at(time));
        let [t_1, t_2] = closed.flights;
        self.formula.values(Values::new([
            ("r_B", closed.r_b),
            ("r_T", closed.r_t),
            (r"\overline{g}", closed.g),
            ("d", closed.d),
            ("T", T::from_integer(2)),
            ("T_1", t_1),
            ("T_2", t_2),
            ("F_1(t_k)", start.f1),
            ("F_1(t_{k+1})", end.f1),
            ("F_2(t_k)", start.f2),
            ("F_2(t_{k+1})", end.f2),
        ]))
    }

    fn stable<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
        let Closed {
            r_b,
            r_t,
            g,
            d,
            flights: [t_1, _],
            middle,
            ..
        } = Closed::of(given)?;
        let motion = Motion::new(g, d, r_b, r_t).ok()?;
        let [v, _] = OneOneEquations::new(&motion, 1).velocities(&t_1, &middle);
        Some(vec![v])
    }
}

#[cfg(test)]
mod tests {
    use super::super::quantity::tests::Agreeing;
    use super::*;

    #[test]
    fn the_three_formulas_are_the_balance_in_many_digits_at_every_setting() {
        each(&Paper::new().unwrap(), &mut Agreeing).unwrap();
    }
}
