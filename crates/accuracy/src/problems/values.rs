//! Quantities with their values, and how many digits two values share.

use crate::trade::digits_of;
use nalgebra::Matrix2;
use numbers::{Analytic, Decimal, Wide};

/// As what answers are held and compared.
pub type Number = Wide<60>;

/// Quantities by name, in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Values<T>(pub Vec<(String, T)>);

impl<T> Values<T> {
    /// Quantities with names that are known beforehand.
    pub(super) fn new<const N: usize>(values: [(&str, T); N]) -> Self {
        Self(
            values
                .into_iter()
                .map(|(name, value)| (name.to_owned(), value))
                .collect(),
        )
    }

    /// The same over another number.
    pub fn convert<U>(self, convert: impl Fn(T) -> U) -> Values<U> {
        let each = self.0.into_iter();
        Values(each.map(|(name, value)| (name, convert(value))).collect())
    }
}

impl<T: Clone> Values<T> {
    /// Those of a periodic motion.
    pub(super) fn of_cycle(lists: [&[T]; 3], trace: T) -> Self {
        let [phases, velocities, times] = lists;
        let mut values = Vec::new();
        for (index, ((phase, velocity), time)) in phases.iter().zip(velocities).zip(times).enumerate() {
            let impact = index + 1;
            values.push((format!("phase_{impact}"), phase.clone()));
            values.push((format!("velocity_{impact}"), velocity.clone()));
            values.push((format!("time_{impact}"), time.clone()));
        }
        values.push(("trace".to_owned(), trace));
        Self(values)
    }

    /// The entries of a derivative.
    pub(super) fn of_matrix(matrix: &Matrix2<T>) -> Self
    where
        T: nalgebra::Scalar,
    {
        let entry = |row, column| matrix[(row, column)].clone();
        Self::new([
            ("dt_dt", entry(0, 0)),
            ("dt_dv", entry(0, 1)),
            ("dv_dt", entry(1, 0)),
            ("dv_dv", entry(1, 1)),
        ])
    }

    /// With one more.
    pub(super) fn and(mut self, name: &str, value: T) -> Self {
        self.0.push((name.to_owned(), value));
        self
    }
}

/// The value of a decimal.
pub(super) fn read(decimal: &Decimal) -> Number {
    Number::parse(decimal.as_str()).unwrap_or(Number::INVALID)
}

/// `angle` less whole turns, in [0, 2 pi).
pub(super) fn reduced<T: Analytic>(angle: &T) -> T {
    let turn = T::pi() + T::pi();
    let turns = (angle.to_f64() / turn.to_f64()).floor();
    let angle = angle.clone() - turn.clone() * T::from_f64(turns);
    // the quotient is rounded, which matters next to a whole turn
    if angle.to_f64() < 0.0 {
        angle + turn
    } else if (angle.clone() - turn.clone()).to_f64() >= 0.0 {
        angle - turn
    } else {
        angle
    }
}

/// Whether a quantity is an angle, of which whole turns do not matter.
pub(super) fn is_phase(quantity: &str) -> bool {
    quantity == "phase" || quantity.starts_with("phase_")
}

/// The digits of `value` as the `exact` value of a quantity, at most `most`: -log10 of the relative error; of a phase,
/// of the difference around the circle, rad. 0 where the value is none.
pub(crate) fn digits(quantity: &str, value: &Number, exact: &Number, most: f64) -> f64 {
    let difference = value.clone() - exact.clone();
    let error = if is_phase(quantity) {
        let around = reduced(&difference);
        let back = Number::pi() + Number::pi() - around.clone();
        if around < back { around } else { back }
    } else {
        difference / exact.clone()
    };
    let error = error.to_f64().abs();
    digits_of(error, 2.0 * 10_f64.powf(-most))
}

/// A number as the nearest of [`Number`].
pub(super) fn number<const DIGITS: usize>(value: Wide<DIGITS>) -> Number {
    value.convert()
}

#[cfg(test)]
mod tests {
    use super::*;
    use numbers::Field;

    fn of(quantity: &str, value: &str, exact: &str) -> f64 {
        let [value, exact] = [value, exact].map(|text| Number::parse(text).unwrap());
        digits(quantity, &value, &exact, 30.0)
    }

    #[test]
    fn digits_are_those_of_the_relative_error_whatever_the_size() {
        for exact in ["1", "-3e-20", "7.5e40"] {
            let value = Number::parse(exact).unwrap();
            for lost in [1, 7, 15, 29] {
                let error = <Number as Field>::from_integer(1) + Field::to_power(&Number::from_integer(10), -lost);
                let found = digits("time", &(value.clone() * error), &value, 30.0);
                assert!((found - f64::from(lost)).abs() < 1e-9, "{exact} {lost}: {found}");
            }
            assert_eq!(of("time", exact, exact), 30.0);
        }
    }

    #[test]
    fn a_phase_is_compared_around_the_circle() {
        let near = of("phase_2", "6.2831853", "0.0000000");
        assert!((near - 8.14).abs() < 0.01, "{near}");
        assert!((of("phase", "-0.001", "0.001") - 2.699).abs() < 0.001);
        assert_eq!(of("phase", "1000", "3"), 0.0);
        // the same text as a velocity is all wrong
        assert_eq!(of("velocity_2", "6.2831853", "0.001"), 0.0);
    }

    #[test]
    fn what_is_no_number_has_no_digits() {
        assert_eq!(digits("time", &Number::INVALID, &Number::from_integer(1), 30.0), 0.0);
        assert_eq!(of("time", "1e5000", "1"), 0.0);
        assert_eq!(of("time", "-1", "1"), 0.0);
    }

    #[test]
    fn whole_turns_are_taken_off() {
        for (angle, left) in [(-0.5, 5.783_185_307_179_586), (7.0, 0.716_814_692_820_414), (1.0, 1.0)] {
            let found: f64 = reduced(&angle);
            assert!((found - left).abs() < 1e-12);
        }
    }
}
