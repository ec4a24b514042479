//! What is said of an enclosure: a number of a table, and how far it may be wrong.

use super::{Analytic, DoubleDouble, Endpoint, Field, Interval, Wide};
use num_traits::Zero;
use std::fmt;

/// The decimal figures that every f64 has.
pub const FIGURES_OF_F64: u32 = 15;

/// A decimal number: as many significant figures as were asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decimal(String);

impl Decimal {
    /// What is not known.
    pub fn unknown() -> Self {
        Self("NaN".to_owned())
    }

    /// The text, such as `-0.26000`, `2.60e-12` or `inf`.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A number of a table.
pub trait Told: Clone + fmt::Debug + PartialEq + Send {
    /// What stands for no bound at all.
    fn infinite() -> Self;
    /// To f64, for the order of rows.
    fn to_f64(&self) -> f64;
    /// The same number in many digits; no number where it is none.
    fn wide<const DIGITS: usize>(&self) -> Wide<DIGITS>;
}

impl Told for f64 {
    fn infinite() -> Self {
        f64::INFINITY
    }

    fn to_f64(&self) -> f64 {
        *self
    }

    fn wide<const DIGITS: usize>(&self) -> Wide<DIGITS> {
        Wide::from_f64(*self)
    }
}

impl Told for Decimal {
    fn infinite() -> Self {
        Self("inf".to_owned())
    }

    fn to_f64(&self) -> f64 {
        self.0.parse().unwrap_or(f64::NAN)
    }

    fn wide<const DIGITS: usize>(&self) -> Wide<DIGITS> {
        Wide::parse(&self.0).unwrap_or(Wide::INVALID)
    }
}

/// How enclosures over `E` are told.
pub trait Telling<E: Endpoint> {
    /// As what.
    type Number: Told;
    /// The number for an enclosure.
    fn tell(&self, value: &Interval<E>) -> Self::Number;
    /// An upper bound of the distance from that number to any point of `value`.
    fn error(&self, told: &Self::Number, value: &Interval<E>) -> E;
    /// A number not below `error`.
    fn bound(&self, error: E) -> Self::Number;
    /// Whether the enclosure is narrow enough for what is told of it.
    fn holds(&self, value: &Interval<E>) -> bool;
}

/// As f64, the nearest to the middle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Doubles;

impl<E: Endpoint> Telling<E> for Doubles {
    type Number = f64;

    fn tell(&self, value: &Interval<E>) -> f64 {
        value.to_f64()
    }

    fn error(&self, told: &f64, value: &Interval<E>) -> E {
        (Interval::from_f64(*told) - value.clone()).magnitude()
    }

    fn bound(&self, error: E) -> f64 {
        // the magnitude is rounded to f64, either way
        if error.is_zero() { 0.0 } else { error.to_f64().next_up() }
    }

    fn holds(&self, _value: &Interval<E>) -> bool {
        true
    }
}

/// As f64, rounded to the figures that the enclosure supports: what is not proved says no more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Supported;

impl<E: Endpoint> Telling<E> for Supported {
    type Number = f64;

    fn tell(&self, value: &Interval<E>) -> f64 {
        let (middle, size) = (value.to_f64(), value.mignitude().to_f64());
        let part = value.radius().to_f64() / size;
        // the figures before an error of this part, half a unit each
        let figures = (-part.log10()).floor().clamp(0.0, f64::from(FIGURES_OF_F64));
        match figures as usize {
            0 => 0.0,
            figures => format!("{middle:.*e}", figures - 1).parse().unwrap_or(middle),
        }
    }

    fn error(&self, told: &f64, value: &Interval<E>) -> E {
        Doubles.error(told, value)
    }

    fn bound(&self, error: E) -> f64 {
        Doubles.bound(error)
    }

    fn holds(&self, _value: &Interval<E>) -> bool {
        false
    }
}

/// As decimals of so many significant figures, at least 1, over [`Wide`] of more digits than that; of fewer where the
/// enclosure does not support as many. Each is within one unit of its last figure of every point of the enclosure, but
/// for one around 0 or without a figure.
///
/// An enclosure around 0 is told as 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decimals(pub usize);

impl Decimals {
    /// Ten to the figures and one more.
    fn scale<const DIGITS: usize>(self) -> Wide<DIGITS> {
        let ten = <Wide<DIGITS> as Field>::from_integer(10);
        Field::to_power(&ten, i32::try_from(self.0 + 1).unwrap_or(i32::MAX))
    }
}

impl<const DIGITS: usize> Telling<Wide<DIGITS>> for Decimals {
    type Number = Decimal;

    fn tell(&self, value: &Interval<Wide<DIGITS>>) -> Decimal {
        let middle = if value.contains_zero() {
            <Wide<DIGITS> as Field>::from_integer(0)
        } else {
            value.midpoint()
        };
        let supported = || (1..self.0).rev().find(|figures| Decimals(*figures).holds(value));
        let figures = if self.holds(value) {
            self.0
        } else {
            supported().unwrap_or(1)
        };
        Decimal(middle.to_decimal(figures))
    }

    fn error(&self, told: &Decimal, value: &Interval<Wide<DIGITS>>) -> Wide<DIGITS> {
        let read = Wide::parse(&told.0).unwrap_or(Wide::INVALID);
        // read is the nearest number to the decimal, not the decimal itself; 0 is
        let read = if read.is_zero() {
            Interval::point(read)
        } else {
            Interval::new(read.below(), read.above())
        };
        (read - value.clone()).magnitude()
    }

    fn bound(&self, error: Wide<DIGITS>) -> Decimal {
        // three figures, half a unit of the last of which is 0.5 percent at most
        let more = <Wide<DIGITS> as Field>::from_ratio(101, 100);
        Decimal((error * more).to_decimal(3))
    }

    fn holds(&self, value: &Interval<Wide<DIGITS>>) -> bool {
        let one = <Wide<DIGITS> as Field>::from_integer(1);
        if value.contains_zero() {
            value.magnitude() * self.scale() <= one
        } else {
            value.radius() * self.scale() <= value.mignitude()
        }
    }
}

/// The decimal digits in which a double-double is read: more than it has.
const READ: usize = 50;

fn widened(value: &Interval<DoubleDouble>) -> Interval<Wide<READ>> {
    let [low, high] = [value.low(), value.high()].map(|end| end.to_wide::<READ>());
    // exact, but where the parts are far from each other
    Interval::new(low.below(), high.above())
}

/// As over [`Wide`].
impl Telling<DoubleDouble> for Decimals {
    type Number = Decimal;

    fn tell(&self, value: &Interval<DoubleDouble>) -> Decimal {
        self.tell(&widened(value))
    }

    fn error(&self, told: &Decimal, value: &Interval<DoubleDouble>) -> DoubleDouble {
        DoubleDouble::from_wide(&Telling::<Wide<READ>>::error(self, told, &widened(value))).above()
    }

    fn bound(&self, error: DoubleDouble) -> Decimal {
        Telling::<Wide<READ>>::bound(self, error.to_wide())
    }

    fn holds(&self, value: &Interval<DoubleDouble>) -> bool {
        self.holds(&widened(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Line = Interval<Wide<50>>;

    #[test]
    fn a_decimal_is_within_its_bound_of_every_point() {
        for (value, figures) in [
            (Line::pi(), 30),
            (-Line::from_ratio(1, 3), 44),
            (Line::from_ratio(1, 300_000_000), 20),
        ] {
            let telling = Decimals(figures);
            let told = telling.tell(&value);
            let bound = telling.bound(telling.error(&told, &value));
            let [told, bound] = [&told, &bound].map(|text| Wide::<200>::parse(text.as_str()).expect("a number"));
            for end in [value.low(), value.high()] {
                let apart = end.convert::<200>() - told.clone();
                assert!(apart <= bound && -bound.clone() <= apart, "{told} {bound}");
            }
            assert!(telling.holds(&value));
        }
    }

    #[test]
    fn a_decimal_of_a_double_double_is_within_its_bound() {
        let third = Interval::<DoubleDouble>::from_ratio(1, 3);
        let told = Decimals(25).tell(&third);
        let bound = Telling::<DoubleDouble>::bound(&Decimals(25), Decimals(25).error(&told, &third));
        let [told, bound] = [&told, &bound].map(|text| Wide::<100>::parse(text.as_str()).expect("a number"));
        let apart = told - Wide::from_ratio(1, 3);
        assert!(apart <= bound && -bound.clone() <= apart && bound.to_f64() < 1e-25);
        assert!(Decimals(28).holds(&third) && !Decimals(33).holds(&third));
    }

    #[test]
    fn more_figures_than_an_enclosure_has_do_not_hold() {
        let value = Line::new(Wide::from_ratio(1, 3), Wide::from_ratio(1, 3) + Wide::from_f64(1e-20));
        assert!(Decimals(18).holds(&value) && !Decimals(20).holds(&value));
    }

    #[test]
    fn what_may_be_zero_is_told_as_zero() {
        let near = Line::new(Wide::from_f64(-1e-40), Wide::from_f64(1e-40));
        assert_eq!(Decimals(4).tell(&near).as_str(), "0.000");
        assert!(Decimals(30).holds(&near) && !Decimals(40).holds(&near));
    }

    #[test]
    fn doubles_know_their_rounding() {
        let tenth = Interval::<Wide<50>>::from_ratio(1, 10);
        let error = Doubles.bound(Doubles.error(&0.1, &tenth));
        assert!(error > 0.0 && error < 1e-17);
        let wide = Interval::<f64>::new(0.0, 0.75);
        let error: f64 = Doubles.bound(Doubles.error(&0.5, &wide));
        assert!(error >= 0.5);
    }
}
