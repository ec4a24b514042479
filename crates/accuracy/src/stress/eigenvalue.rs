//! The multipliers (19): where Delta is near 0, and where one is far larger than the other.

use super::StressError;
use super::approach::{Approach, DELTA, SADDLE};
use super::paper::{Formula, Paper, Values};
use super::quantity::{Number, Quantity, Visitor};
use dynamics::orbit::{OrbitKind, multipliers};
use numbers::Analytic;

/// Which multiplier, where.
#[derive(Clone, Copy, PartialEq)]
enum Extreme {
    /// The larger one of a node, Delta near 0.
    Meeting,
    /// The imaginary part of those of a focus, Delta near 0.
    Parting,
    /// The smaller one of a saddle, Delta near Tr².
    Apart,
}

struct Eigenvalue {
    extreme: Extreme,
    formula: Formula,
}

/// Newton steps to a simple root from far outside: each halves the distance at least, until it squares it.
const MOST_STEPS: usize = 2000;

/// Visits (19) at its three extremes.
pub(super) fn each(paper: &Paper, visitor: &mut impl Visitor) -> Result<(), StressError> {
    for extreme in [Extreme::Meeting, Extreme::Parting, Extreme::Apart] {
        let formula = paper.formula("19", &[])?;
        visitor.visit(&Eigenvalue { extreme, formula })?;
    }
    Ok(())
}

/// The larger root of x² - trace x + determinant by Newton's method from above, monotone.
fn larger_root<T: Number>(trace: &T, determinant: &T) -> Option<T> {
    let mut root = trace.clone() + <T as num_traits::One>::one();
    let mut steps_left = MOST_STEPS;
    loop {
        let value = (root.clone() - trace.clone()) * root.clone() + determinant.clone();
        let slope = root.clone() + root.clone() - trace.clone();
        let step = value / slope;
        root -= step.clone();
        steps_left = steps_left.checked_sub(1)?;
        // some further steps, for the parts of dual numbers
        if step.to_f64().abs() <= 1e-90 * root.to_f64().abs() {
            steps_left = steps_left.min(3);
        }
        if steps_left == 0 {
            return Some(root);
        }
    }
}

impl Quantity for Eigenvalue {
    fn case(&self) -> &'static str {
        match self.extreme {
            Extreme::Meeting | Extreme::Parting => "Delta near 0",
            Extreme::Apart => "multipliers far apart",
        }
    }

    fn formula(&self) -> &'static str {
        match self.extreme {
            Extreme::Meeting => "(19) larger",
            Extreme::Parting => "(19) imaginary",
            Extreme::Apart => "(19) smaller",
        }
    }

    /// The loss factor is r_B r_T.
    fn inputs(&self) -> &'static [&'static str] {
        &["Tr", "loss"]
    }

    fn dials(&self) -> Vec<[f64; 2]> {
        let first = match self.extreme {
            Extreme::Apart => [0.5, 15.0],
            _ => [-14.0, -0.5],
        };
        vec![first, [0.0025, 1.0]]
    }

    fn set(&self, dials: &[f64]) -> Vec<f64> {
        let [first, loss] = [0, 1].map(|at| dials.get(at).copied().unwrap_or(f64::NAN));
        let power = 10_f64.powf(first);
        let double = 2.0 * loss;
        let trace = match self.extreme {
            Extreme::Meeting => double * (1.0 + power),
            Extreme::Parting => double * (1.0 - power),
            Extreme::Apart => power,
        };
        vec![trace, loss]
    }

    fn approach(&self) -> Approach {
        match self.extreme {
            Extreme::Meeting | Extreme::Parting => DELTA,
            Extreme::Apart => SADDLE,
        }
    }

    fn near(&self, exponent: f64) -> Vec<Vec<f64>> {
        vec![vec![exponent, 0.18]]
    }

    fn exponents(&self) -> Vec<f64> {
        let exponents = match self.extreme {
            Extreme::Apart => [1, 4, 8, 12, 15],
            _ => [-1, -4, -8, -11, -14],
        };
        exponents.map(f64::from).to_vec()
    }

    fn given_names(&self) -> &'static [&'static str] {
        &["Tr", "Det", "loss"]
    }

    fn given<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
        let [trace, loss] = inputs else {
            return None;
        };
        let half = (trace.to_f64() * 0.5 - loss.to_f64()).abs();
        // exactly double is nothing to be told apart
        (half > 0.0).then(|| vec![trace.clone(), loss.clone() * loss.clone(), loss.clone()])
    }

    fn reference<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
        let given = self.given(inputs)?;
        let [trace, determinant, loss] = given.as_slice() else {
            return None;
        };
        let excess = trace.clone() - loss.clone() - loss.clone();
        let is_real = excess.to_f64() > 0.0;
        match self.extreme {
            Extreme::Meeting if is_real => Some(vec![larger_root(trace, determinant)?]),
            Extreme::Apart if is_real => Some(vec![trace.clone() - larger_root(trace, determinant)?]),
            // loss sin a where loss cos a is half the trace
            Extreme::Parting if !is_real => {
                let cos = trace.clone() / (loss.clone() + loss.clone());
                let (sin, _) = Analytic::acos(&cos).sincos();
                Some(vec![loss.clone() * sin])
            }
            _ => None,
        }
    }

    fn printed<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
        let [trace, determinant, _] = given else {
            return None;
        };
        let values = Values::new([("Tr(DP)", trace.clone()), ("Det(DP)", determinant.clone())]);
        match self.extreme {
            Extreme::Meeting => self.formula.values(values)?.into_iter().take(1).map(Some).collect(),
            Extreme::Apart => self
                .formula
                .values(values.lower())?
                .into_iter()
                .take(1)
                .map(Some)
                .collect(),
            Extreme::Parting => {
                let discriminant = self.formula.values(values)?.into_iter().nth(1)?;
                Some(vec![Analytic::sqrt(&-discriminant) * T::from_ratio(1, 2)])
            }
        }
    }

    fn stable<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
        let [trace, _, loss] = given else {
            return None;
        };
        let kind = match self.extreme {
            Extreme::Meeting => OrbitKind::Node,
            Extreme::Parting => OrbitKind::Focus,
            Extreme::Apart => OrbitKind::Saddle,
        };
        let [first, second] = multipliers(trace, loss, kind);
        Some(vec![match self.extreme {
            Extreme::Meeting => first.re,
            Extreme::Parting => first.im,
            Extreme::Apart => second.re,
        }])
    }
}

#[cfg(test)]
mod tests {
    use super::super::quantity::tests::Agreeing;
    use super::*;

    #[test]
    fn printed_multipliers_are_the_default_ones_in_many_digits_at_every_setting() {
        each(&Paper::new().unwrap(), &mut Agreeing).unwrap();
    }

    #[test]
    fn the_larger_root_is_found_from_above_also_where_both_nearly_meet() {
        let apart = larger_root(&5.0_f64, &6.0).unwrap();
        assert!((apart - 3.0).abs() < 1e-15, "{apart}");
        let close = larger_root(&2.0_f64, &(1.0 - 1e-10)).unwrap();
        assert!((close - 1.00001).abs() < 1e-10, "{close}");
    }
}
