//! The voltage of tiny and huge impacts: (5) and (6) as a difference of squares of areas, and without it.

use super::StressError;
use super::approach::{Approach, SLIGHT};
use super::quantity::{Number, Quantity, Visitor};
use super::row::place;
use dynamics::model::Membrane;
use numbers::Analytic;

/// U_k of (6), of the paper's membrane.
struct Voltage;

/// Visits (5) and (6).
pub(super) fn each(visitor: &mut impl Visitor) -> Result<(), StressError> {
    visitor.visit(&Voltage)
}

/// The speed of an impact and the membrane.
const INPUTS: [&str; 7] = ["speed", "mass", "stiffness", "exponent", "ball", "rim", "voltage"];

/// The paper's membrane: ball mass, stiffness, exponent, radii of ball and membrane, voltage.
const MEMBRANE: [f64; 6] = [0.0035, 4.0847e5, 2.6, 0.005, 0.0063, 2000.0];

fn membrane<T: Number>(given: &[T]) -> Option<(Membrane<T>, &T)> {
    let [speed, mass, stiffness, exponent, ball, rim, voltage] = given else {
        return None;
    };
    let [mass, stiffness, exponent, ball, rim, voltage] = [mass, stiffness, exponent, ball, rim, voltage].map(T::clone);
    let membrane = Membrane::new(mass, stiffness, exponent, ball, rim, voltage).ok()?;
    Some((membrane, speed))
}

/// The paper's membrane, as the column `at` has it.
pub(super) fn membrane_at() -> String {
    place(&INPUTS[1..], &MEMBRANE)
}

/// The paper's membrane over a number.
pub(super) fn of_paper<T: Number>() -> Option<Membrane<T>> {
    let given: Vec<T> = [&[0.0], &MEMBRANE[..]]
        .concat()
        .into_iter()
        .map(<T as Analytic>::from_f64)
        .collect();
    membrane(&given).map(|(membrane, _)| membrane)
}

impl Quantity for Voltage {
    fn case(&self) -> &'static str {
        "tiny and huge impacts"
    }

    fn formula(&self) -> &'static str {
        "(5)-(6)"
    }

    fn inputs(&self) -> &'static [&'static str] {
        &INPUTS
    }

    fn dials(&self) -> Vec<[f64; 2]> {
        vec![[-15.0, 3.0]]
    }

    fn set(&self, dials: &[f64]) -> Vec<f64> {
        let speed = dials.first().map_or(f64::NAN, |dial| 10_f64.powf(*dial));
        [&[speed], &MEMBRANE[..]].concat()
    }

    fn approach(&self) -> Approach {
        SLIGHT
    }

    fn near(&self, exponent: f64) -> Vec<Vec<f64>> {
        vec![vec![exponent]]
    }

    fn exponents(&self) -> Vec<f64> {
        [3, 1, 0, -3, -6, -9, -12, -15, -30].map(f64::from).to_vec()
    }

    fn given<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
        Some(inputs.to_vec())
    }

    /// The contact angle from (R_b - delta) cos a + R_c sin a = R_b by arcs, then cap and cone.
    fn reference<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
        let [speed, mass, stiffness, exponent, ball, rim, voltage] = inputs else {
            return None;
        };
        let one = || <T as num_traits::One>::one();
        let square = |value: &T| value.clone() * value.clone();
        let more = exponent.clone() + one();
        let energy = more.clone() * mass.clone() * square(speed) / (stiffness.clone() + stiffness.clone());
        let pressed = Analytic::powf(&energy, &(one() / more));
        let above = ball.clone() - pressed;
        let reach = Analytic::sqrt(&(square(&above) + square(rim)));
        let angle = Analytic::atan2(rim, &above) - Analytic::acos(&(ball.clone() / reach));
        let (sin, cos) = angle.sincos();
        let twice = T::from_integer(2);
        let cap = twice * square(ball) * (one() - cos.clone());
        let cone = (square(rim) - square(ball) * square(&sin)) / cos;
        let ratio = (cap + cone) / square(rim);
        Some(vec![(square(&ratio) - one()) * voltage.clone()])
    }

    fn printed<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
        let (membrane, speed) = membrane(given)?;
        Some(vec![membrane.voltage_as_printed(speed)])
    }

    fn stable<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
        let (membrane, speed) = membrane(given)?;
        Some(vec![membrane.voltage(speed)])
    }
}

#[cfg(test)]
mod tests {
    use super::super::quantity::tests::Agreeing;
    use super::*;

    #[test]
    fn the_printed_voltage_is_the_default_one_in_many_digits_at_every_setting() {
        each(&mut Agreeing).unwrap();
    }
}
