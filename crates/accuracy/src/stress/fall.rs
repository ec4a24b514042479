//! A flight shortly after its start: (4) as a difference of integrals of the forcing, and by what changes since then.

use super::StressError;
use super::approach::{Approach, SHORT};
use super::paper::{Formula, Paper, Values};
use super::quantity::{Number, Quantity, Visitor};
use dynamics::model::{Flight, Forcing, Motion, Side};

/// (4) less Z_k.
struct Fall(Formula);

/// Visits (4).
pub(super) fn each(paper: &Paper, visitor: &mut impl Visitor) -> Result<(), StressError> {
    visitor.visit(&Fall(paper.formula("4", &[])?))
}

impl Quantity for Fall {
    fn case(&self) -> &'static str {
        "short flight"
    }

    fn formula(&self) -> &'static str {
        "(4)"
    }

    fn inputs(&self) -> &'static [&'static str] {
        &["velocity", "r", "g", "t_k", "duration"]
    }

    fn dials(&self) -> Vec<[f64; 2]> {
        vec![[-15.0, 0.0], [0.05, 1.0], [-1.0, 1.0], [0.0, 2.0], [-15.0, 0.3]]
    }

    fn set(&self, dials: &[f64]) -> Vec<f64> {
        let power = |(at, dial): (usize, &f64)| if at % 4 == 0 { 10_f64.powf(*dial) } else { *dial };
        dials.iter().enumerate().map(power).collect()
    }

    fn approach(&self) -> Approach {
        SHORT
    }

    fn near(&self, exponent: f64) -> Vec<Vec<f64>> {
        vec![vec![exponent, 0.5, 0.12, 0.7, exponent]]
    }

    fn exponents(&self) -> Vec<f64> {
        [0, -2, -4, -8, -12, -15].map(f64::from).to_vec()
    }

    fn given_names(&self) -> &'static [&'static str] {
        &["velocity", "r", "g", "t_k", "duration", "t"]
    }

    fn given<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
        let [velocity, r, g, start, duration] = inputs else {
            return None;
        };
        let end = start.clone() + duration.clone();
        let values = [velocity, r, g, start, duration, &end];
        Some(values.map(T::clone).to_vec())
    }

    /// (4) with sines, in the differences that cancel.
    fn reference<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
        let [velocity, r, g, start, duration] = inputs else {
            return None;
        };
        let s = || duration.clone();
        let (sin, cos) = (T::pi() * start.clone()).sincos();
        let (_, later) = (T::pi() * (start.clone() + s())).sincos();
        let pull = g.clone() * s() * s() * T::from_ratio(1, 2);
        let swung = (cos - later) / (T::pi() * T::pi()) - sin / T::pi() * s();
        Some(vec![pull + swung - r.clone() * velocity.clone() * s()])
    }

    fn printed<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
        let [velocity, r, g, start, _, end] = given else {
            return None;
        };
        let forcing = Forcing::harmonic(&T::zero());
        let [before, after] = [start, end].map(|time| forcing.at(time));
        self.0.values(Values::new([
            ("Z_k^-", T::zero()),
            (r"\dot{Z}_k^-", velocity.clone()),
            ("r", r.clone()),
            (r"\overline{g}", g.clone()),
            ("t", end.clone()),
            ("t_k", start.clone()),
            ("F_2(t)", after.f2),
            ("F_2(t_k)", before.f2),
            ("F_1(t_k)", before.f1),
        ]))
    }

    fn stable<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
        let [velocity, r, g, start, duration, _] = given else {
            return None;
        };
        // the gap has no say before the end of a flight
        let motion = Motion::new(g.clone(), T::one(), r.clone(), r.clone()).ok()?;
        let launch = -(r.clone() * velocity.clone());
        let forcing = Forcing::harmonic(&T::zero());
        let flight = Flight::launched(&motion, &forcing, Side::Bottom, start, launch).ok()?;
        Some(vec![flight.state(duration).displacement])
    }
}

#[cfg(test)]
mod tests {
    use super::super::quantity::tests::Agreeing;
    use super::*;

    #[test]
    fn equation_4_is_the_flight_in_many_digits_at_every_setting() {
        each(&Paper::new().unwrap(), &mut Agreeing).unwrap();
    }
}
