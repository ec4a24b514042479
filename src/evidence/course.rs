//! A concrete course of time: a trigonometric polynomial with a polynomial, and its integrals and derivatives.
//!
//! A forcing of this kind stands for any function: its values and those of its integrals at a few times are
//! independent of each other, since it has more coefficients than there are values.

use super::program::{Env, Node};
use crate::number::Analytic;
use crate::tex::Name;

/// The period of a course that no premise gives one: longer than any motion asked about, and in no ratio to it.
const LONG: f64 = 7.389_056_1;

/// A function of time with those that come from it by differentiating.
#[derive(Clone, Debug)]
pub struct Course {
    /// From the highest integral down; each is the derivative of the one before it.
    pub names: Vec<Name>,
    /// The impact whose flight this is, for a state in flight.
    pub flight: Option<i32>,
    /// The slot of the first coefficient.
    pub first: usize,
    /// How many powers of time the highest integral has.
    pub powers: usize,
    pub harmonics: usize,
    /// The period, where there is one: of this member and all below it.
    pub period: Option<Box<Node>>,
}

impl Course {
    /// The number of coefficients.
    pub fn terms(&self) -> usize {
        self.powers + 2 * self.harmonics
    }

    /// The slots of the coefficients.
    pub fn slots(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.terms()
    }

    /// Value of the member `level` steps below the highest integral.
    pub fn value<T: Analytic>(&self, level: usize, time: &T, env: &Env<T>) -> T {
        let mut value = self.polynomial(level, time, env);
        if self.harmonics == 0 {
            return value;
        }
        // The coefficients are those of the lowest member that has a name.
        let integrals = self.names.len() as i32 - 1 - level as i32;
        let base = T::from_integer(2) * T::pi() / self.length(env);
        let (s, c) = (base.clone() * time.clone()).sincos();
        let (mut sin, mut cos) = (T::zero(), T::one());
        for n in 0..self.harmonics {
            let rate = base.clone() * T::from_integer(n as i64 + 1);
            (sin, cos) = (
                sin.clone() * c.clone() + cos.clone() * s.clone(),
                cos * c.clone() - sin * s.clone(),
            );
            let a = env.slot(self.first + self.powers + 2 * n);
            let b = env.slot(self.first + self.powers + 2 * n + 1);
            let term = match integrals.rem_euclid(4) {
                0 => a * cos.clone() + b * sin.clone(),
                1 => a * sin.clone() - b * cos.clone(),
                2 => -(a * cos.clone() + b * sin.clone()),
                _ => b * cos.clone() - a * sin.clone(),
            };
            value += term * rate.to_power(-integrals);
        }
        value
    }

    /// The period at this point.
    pub fn length<T: Analytic>(&self, env: &Env<T>) -> T {
        match &self.period {
            Some(period) => period.value(env),
            None => T::from_f64(LONG),
        }
    }

    fn polynomial<T: Analytic>(&self, level: usize, time: &T, env: &Env<T>) -> T {
        let mut sum = T::zero();
        for power in (level..self.powers).rev() {
            // Horner's scheme in t^j / j!
            let next = T::from_integer((power - level + 1) as i64);
            sum = env.slot(self.first + power) + sum * time.clone() / next;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::super::program::Env;
    use super::*;
    use crate::number::{Dual, seeded};

    #[test]
    fn each_member_is_the_derivative_of_the_one_above_it() {
        for period in [None, Some(Box::new(Node::Number(17, 10)))] {
            let course = Course {
                names: vec![Name::default(); 3],
                flight: None,
                first: 0,
                powers: 4,
                harmonics: 3,
                period,
            };
            let values: Vec<Dual<f64>> = (0..10).map(|n| Dual::from_re((f64::from(n) * 1.3).sin())).collect();
            let env = Env {
                values: &values,
                running: None,
                upper: None,
                courses: &[],
            };
            for t in [0.0, 0.4, 2.9] {
                for level in 0..4 {
                    let above = course.value(level, &seeded(t), &env).eps;
                    let below = course.value(level + 1, &Dual::from_re(t), &env).re;
                    assert!((above - below).abs() < 1e-13 * (1.0 + below.abs()), "{level} {t}");
                }
            }
        }
    }
}
