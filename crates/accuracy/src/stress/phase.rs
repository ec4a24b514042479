//! The forcing at late times and where its phase wraps: cos(pi t) of the time as it is, and of the phase.

use super::StressError;
use super::approach::{Approach, LATE, WRAP};
use super::quantity::{Number, Quantity, Visitor};
use dynamics::model::Forcing;

#[derive(Clone, Copy, PartialEq)]
enum Extreme {
    /// After many periods.
    Late,
    /// Just before the end of one.
    Wrap,
}

/// f(t) and F_1(t).
struct Phase(Extreme);

/// Visits both extremes.
pub(super) fn each(visitor: &mut impl Visitor) -> Result<(), StressError> {
    visitor.visit(&Phase(Extreme::Late))?;
    visitor.visit(&Phase(Extreme::Wrap))
}

impl Quantity for Phase {
    fn case(&self) -> &'static str {
        match self.0 {
            Extreme::Late => "late time",
            Extreme::Wrap => "phase at its wrap",
        }
    }

    fn formula(&self) -> &'static str {
        match self.0 {
            Extreme::Late => "f",
            Extreme::Wrap => "F_1",
        }
    }

    fn inputs(&self) -> &'static [&'static str] {
        &["t"]
    }

    fn dials(&self) -> Vec<[f64; 2]> {
        match self.0 {
            Extreme::Late => vec![[0.0, 15.0]],
            Extreme::Wrap => vec![[-15.0, -0.5]],
        }
    }

    fn set(&self, dials: &[f64]) -> Vec<f64> {
        let inputs = dials.iter().map(|dial| match self.0 {
            Extreme::Late => 10_f64.powf(*dial),
            Extreme::Wrap => 2.0 - 10_f64.powf(*dial),
        });
        inputs.collect()
    }

    fn approach(&self) -> Approach {
        match self.0 {
            Extreme::Late => LATE,
            Extreme::Wrap => WRAP,
        }
    }

    fn near(&self, exponent: f64) -> Vec<Vec<f64>> {
        vec![vec![exponent]]
    }

    fn exponents(&self) -> Vec<f64> {
        let exponents = match self.0 {
            Extreme::Late => [0.1, 3.1, 6.1, 9.1, 12.1, 15.1],
            Extreme::Wrap => [-1.0, -3.0, -6.0, -9.0, -12.0, -15.0],
        };
        exponents.to_vec()
    }

    fn given<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
        // at whole and half times the values are 0 and 1: none has digits to lose
        let halves = 2.0 * inputs.first()?.to_f64();
        (halves.fract() != 0.0).then(|| inputs.to_vec())
    }

    /// By the angle addition of a third of the time.
    fn reference<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
        let third = inputs.first()?.clone() * T::pi() / T::from_integer(3);
        let (sin, cos) = third.sincos();
        let cube = |value: &T| value.clone() * value.clone() * value.clone();
        let (three, four) = (T::from_integer(3), T::from_integer(4));
        Some(vec![match self.0 {
            Extreme::Late => four * cube(&cos) - three * cos,
            Extreme::Wrap => (three * sin.clone() - four * cube(&sin)) / T::pi(),
        }])
    }

    fn printed<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
        let (sin, cos) = (given.first()?.clone() * T::pi()).sincos();
        Some(vec![match self.0 {
            Extreme::Late => cos,
            Extreme::Wrap => sin / T::pi(),
        }])
    }

    fn stable<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
        let at = Forcing::harmonic(&T::zero()).at(given.first()?);
        Some(vec![match self.0 {
            Extreme::Late => at.f,
            Extreme::Wrap => at.f1,
        }])
    }
}

#[cfg(test)]
mod tests {
    use super::super::quantity::tests::Agreeing;
    use super::*;

    #[test]
    fn the_forcing_is_that_of_the_phase_in_many_digits_at_every_setting() {
        each(&mut Agreeing).unwrap();
    }
}
