//! Numbers exactly as typed.

use dashu_int::IBig;
use dashu_ratio::RBig;
use num_traits::{One, Zero};
use numbers::{Analytic, Rational, Wide};
use std::cmp::Ordering;
use std::fmt;

/// `plain + pi turns`, both parts exact.
///
/// Typed are `0.26`, `4.0847e5`, `1/3`, `pi`, `pi/6`, `5 pi`, `-2 pi/3`; sums arise between the ends of a sweep. A typed
/// number has at most 100 digits and is 0 or between 1e-100 and 1e100 in size.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    plain: Exactly,
    turns: Exactly,
}

/// A rational, and its value as f64 knows it, so that it costs little to evaluate again.
#[derive(Clone, Debug)]
struct Exactly {
    value: Rational,
    /// The nearest f64.
    nearest: f64,
    /// The nearest f64 to what that lacks, and a bound on what both together lack.
    rest: [f64; 2],
}

impl PartialEq for Exactly {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl Eq for Exactly {}

impl From<Rational> for Exactly {
    fn from(value: Rational) -> Self {
        let nearest = value.0.to_f64().value();
        let lacks = |from: &RBig, part: f64| RBig::try_from(part).map_or(RBig::ZERO, |part| from - part);
        let lacking = lacks(&value.0, nearest);
        let second = lacking.to_f64().value();
        let slack = match lacks(&lacking, second) {
            left if left.is_zero() => 0.0,
            _ => (second.abs() * f64::EPSILON).next_up(),
        };
        Self {
            value,
            nearest,
            rest: [second, slack],
        }
    }
}

impl Exactly {
    /// The value over `T`: the nearest f64, and what it lacks. One division of large integers would round three times.
    fn over<T: Analytic>(&self) -> T {
        let [lacking, slack] = self.rest;
        if self.rest == [0.0; 2] {
            // nothing to add: an interval stays a point, and a restitution of 1 stays 1
            return T::from_f64(self.nearest);
        }
        if T::epsilon().to_f64() > SHORT {
            let rest = match slack == 0.0 {
                true => T::from_f64(lacking),
                false => T::from_f64(lacking) + T::from_f64(slack) * T::unit(),
            };
            return T::from_f64(self.nearest) + rest;
        }
        let lacking = RBig::try_from(self.nearest).map(|near| Rational(&self.value.0 - near));
        let lacking = lacking.ok().and_then(|lacking| lacking.embed::<T>());
        match lacking.filter(|lacking| lacking.to_f64().is_finite()) {
            Some(lacking) => T::from_f64(self.nearest) + lacking,
            None => self.value.embed::<T>().unwrap_or_else(|| T::from_f64(self.nearest)),
        }
    }

    fn is_zero(&self) -> bool {
        self.value.is_zero()
    }
}

/// Text that is no [`Quantity`]; says what is allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum QuantityError {
    /// Not a number, or NaN, or infinite.
    #[error("a finite number such as 0.26, 4.0847e5, \"pi/6\" or \"5 pi\"")]
    NoNumber,
    /// So large or small that f64 or its products would overflow.
    #[error("0 or between 1e-100 and 1e100 in size")]
    Extreme,
    /// More digits than any number of this project has.
    #[error("of at most {MOST_DIGITS} digits")]
    Long,
}

/// The most digits of a number, before and after the point and in the exponent.
const MOST_DIGITS: usize = 100;

/// The largest power of ten a number may have.
const LARGEST_EXPONENT: usize = 100;

/// Two f64 give every digit of a number type with an epsilon above this.
const SHORT: f64 = 1e-17;

/// Digits in which a sum of both parts is compared with 0: more than a typed number can cancel by accident.
const COMPARED: usize = 250;

impl Quantity {
    /// The number that `text` spells.
    ///
    /// # Errors
    /// Anything else, with what is allowed.
    pub fn read(text: &str) -> Result<Self, QuantityError> {
        let text = text.trim();
        let (negative, text) = match text.strip_prefix(['-', '+']) {
            Some(rest) => (text.starts_with('-'), rest.trim_start()),
            None => (false, text),
        };
        let (above, below) = match text.split_once('/') {
            Some((above, below)) => (above.trim_end(), Some(below.trim_start())),
            None => (text, None),
        };
        let (factor, is_turn) = match above.strip_suffix("pi").or_else(|| above.strip_suffix('π')) {
            Some("") => ("1", true),
            Some(factor) => {
                let factor = factor.trim_end();
                (factor.strip_suffix('*').map_or(factor, str::trim_end), true)
            }
            None => (above, false),
        };
        let mut value = unsigned(factor)?;
        if let Some(below) = below {
            let below = unsigned(below)?;
            if below.is_zero() {
                return Err(QuantityError::NoNumber);
            }
            value /= below;
        }
        let largest = power_of_ten(LARGEST_EXPONENT);
        if !value.is_zero() && (value > largest || value < Rational::one() / largest) {
            return Err(QuantityError::Extreme);
        }
        let value = if negative { -value } else { value };
        let (plain, turns) = if is_turn {
            (Rational::zero(), value)
        } else {
            (value, Rational::zero())
        };
        Ok(Self::new(plain, turns))
    }

    fn new(plain: Rational, turns: Rational) -> Self {
        let [plain, turns] = [plain, turns].map(Exactly::from);
        Self { plain, turns }
    }

    /// The integer `value`.
    pub fn integer(value: i64) -> Self {
        Self::new(Rational(RBig::from(value)), Rational::zero())
    }

    /// The value over `T`: in f64 the nearest number to the rational part, else to a few roundings of `T`.
    pub fn value<T: Analytic>(&self) -> T {
        let plain = self.plain.over();
        if self.turns.is_zero() {
            return plain;
        }
        let turns = self.turns.over::<T>() * T::pi();
        if self.plain.is_zero() { turns } else { plain + turns }
    }

    /// The value as an angle in [0, 2 pi), to a few roundings of `T` however many turns it has; 2 pi itself only by
    /// rounding.
    pub fn angle<T: Analytic>(&self) -> T {
        let value = self.value::<Wide<COMPARED>>();
        let circle = Wide::pi() + Wide::pi();
        if value >= Wide::zero() && value < circle {
            return self.value();
        }
        let (sin, cos) = value.sincos();
        let angle = sin.atan2(&cos);
        let angle = if angle < Wide::zero() { angle + circle } else { angle };
        in_parts(&angle)
    }

    /// The rational, where pi has no part in it.
    pub fn rational(&self) -> Option<&Rational> {
        self.turns.is_zero().then_some(&self.plain.value)
    }

    /// How the number compares with 0. Exact for every number that is typed.
    pub fn sign(&self) -> Ordering {
        let zero = Rational::zero();
        if self.turns.is_zero() {
            self.plain.value.cmp(&zero)
        } else if self.plain.is_zero() {
            self.turns.value.cmp(&zero)
        } else {
            let value = self.value::<Wide<COMPARED>>();
            value.partial_cmp(&Wide::zero()).unwrap_or(Ordering::Equal)
        }
    }

    /// How the number compares with another. Exact for every number that is typed.
    pub fn compared_with(&self, other: &Self) -> Ordering {
        let plain = self.plain.value.clone() - other.plain.value.clone();
        let turns = self.turns.value.clone() - other.turns.value.clone();
        Self::new(plain, turns).sign()
    }

    /// How the number compares with 1.
    pub fn compared_with_one(&self) -> Ordering {
        let plain = self.plain.value.clone() - Rational::one();
        Self::new(plain, self.turns.value.clone()).sign()
    }

    /// The point at `part` of `whole` of the way from `self` to `to`; `self` where `whole` is 0. Exact.
    pub fn towards(&self, to: &Self, part: u32, whole: u32) -> Self {
        let share = Rational::new(i64::from(part), i64::from(whole)).unwrap_or_else(Rational::zero);
        let between = |from: &Exactly, to: &Exactly| {
            if from == to {
                // the turns, as a rule, which are 0 at both ends: rationals are slow beside an impact
                return from.clone();
            }
            let (from, to) = (from.value.clone(), to.value.clone());
            Exactly::from(from.clone() + (to - from) * share.clone())
        };
        Self {
            plain: between(&self.plain, &to.plain),
            turns: between(&self.turns, &to.turns),
        }
    }
}

/// `value` over `T`, as a sum of ever smaller f64.
fn in_parts<T: Analytic>(value: &Wide<COMPARED>) -> T {
    let (mut sum, mut rest) = (T::zero(), value.clone());
    for _ in 0..=COMPARED / 15 {
        let part = rest.to_f64();
        sum += T::from_f64(part);
        rest -= Wide::from_f64(part);
    }
    sum
}

fn power_of_ten(exponent: usize) -> Rational {
    Rational(RBig::from(IBig::from(10).pow(exponent)))
}

/// Digits with at most one point and an exponent, without a sign.
fn unsigned(text: &str) -> Result<Rational, QuantityError> {
    if text.chars().filter(char::is_ascii_digit).count() > MOST_DIGITS {
        return Err(QuantityError::Long);
    }
    let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let value = Rational::from_decimal(digits).ok_or(QuantityError::NoNumber)?;
    let size = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    if size.is_empty() || !size.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(QuantityError::NoNumber);
    }
    if value.is_zero() {
        return Ok(value);
    }
    // Digits may shift the point by as much again.
    let size = size.parse::<usize>().ok().filter(|&size| size <= 2 * LARGEST_EXPONENT);
    let power = power_of_ten(size.ok_or(QuantityError::Extreme)?);
    Ok(if exponent.starts_with('-') {
        value / power
    } else {
        value * power
    })
}

/// As it can be typed: a decimal where there is one, a multiple of pi as `2 pi/3`.
impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.turns.is_zero() {
            return write_plain(&self.plain.value, f);
        }
        let mut turns = self.turns.value.clone();
        if !self.plain.is_zero() {
            write_plain(&self.plain.value, f)?;
            f.write_str(if turns < Rational::zero() { " - " } else { " + " })?;
            if turns < Rational::zero() {
                turns = -turns;
            }
        }
        let (above, below) = (turns.0.numerator(), turns.0.denominator());
        match above {
            one if *one == IBig::ONE => f.write_str("pi")?,
            one if *one == IBig::NEG_ONE => f.write_str("-pi")?,
            other => write!(f, "{other} pi")?,
        }
        if turns.0.is_int() {
            Ok(())
        } else {
            write!(f, "/{below}")
        }
    }
}

fn write_plain(value: &Rational, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    match value.to_decimal() {
        Some(decimal) => f.write_str(&decimal),
        None => write!(f, "{value}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn read(text: &str) -> Quantity {
        Quantity::read(text).unwrap()
    }

    #[test]
    fn a_number_that_f64_holds_is_one_point_of_an_interval() {
        use numbers::Interval;
        for (text, value) in [("1", 1.0), ("0.5", 0.5), ("-3", -3.0), ("0", 0.0)] {
            let enclosed = Quantity::read(text).unwrap().value::<Interval<f64>>();
            assert_eq!((enclosed.low(), enclosed.high()), (value, value), "{text}");
        }
        let tenth = Quantity::read("0.1").unwrap().value::<Interval<f64>>();
        assert!(tenth.low() < tenth.high());
    }

    #[test]
    fn enclosures_from_two_f64_hold_the_exact_value_and_are_as_narrow_as_those_from_the_rational() {
        use numbers::{DoubleDouble, Interval};
        let mut sequence = numbers::Sequence::new(19);
        for _ in 0..2000 {
            let size = sequence.between(-90.0, 90.0) as i32;
            let text = format!("{}e{size}", sequence.between(-10.0, 10.0) as f32);
            let exact = read(&text);
            let near = exact.value::<Interval<f64>>();
            let wide = exact.value::<Wide<60>>();
            let (low, high) = (Wide::from_f64(near.low()), Wide::from_f64(near.high()));
            assert!(low <= wide && wide <= high, "{text}: {near}");
            let Exactly { value, nearest, .. } = &exact.plain;
            let lacking = Rational(&value.0 - RBig::try_from(*nearest).unwrap()).embed::<Interval<f64>>();
            let by_rational = Interval::from_f64(*nearest) + lacking.unwrap();
            assert!(near.width() <= by_rational.width(), "{text}: {near}, {by_rational}");
            let fine = exact.value::<Interval<DoubleDouble>>();
            assert!(near.low() <= fine.low().to_f64() && fine.high().to_f64() <= near.high());
        }
    }

    #[test]
    fn decimals_are_exact_not_the_nearest_f64() {
        let ratio = |n, d| Rational::new(n, d);
        for (text, n, d) in [
            ("0.26", 13, 50),
            ("4.0847e5", 408_470, 1),
            ("-1E-3", -1, 1000),
            ("+2", 2, 1),
            ("1/3", 1, 3),
            ("1e-2/4", 1, 400),
            ("0e999999999999", 0, 1),
        ] {
            assert_eq!(read(text).rational(), ratio(n, d).as_ref(), "{text}");
        }
        let wide = read("0.26").value::<Wide<40>>();
        let exact = Wide::<40>::from_f64(13.0) / Wide::from_f64(50.0);
        assert!((wide - exact).to_f64().abs() < 1e-40);
    }

    #[test]
    fn multiples_of_pi_keep_their_pi() {
        for (text, value) in [
            ("pi", PI),
            ("pi/6", PI / 6.0),
            ("5 pi", 5.0 * PI),
            ("5pi", 5.0 * PI),
            ("2 pi/3", 2.0 * PI / 3.0),
            ("- 2*pi / 3", -2.0 * PI / 3.0),
            ("0.5 π", PI / 2.0),
        ] {
            let found: f64 = read(text).value();
            assert!(
                (found - value).abs() <= 2.0 * f64::EPSILON * value.abs(),
                "{text}: {found}"
            );
            assert!(read(text).rational().is_none());
        }
        let sixth = read("pi/6").value::<Wide<40>>() * Wide::from_f64(6.0);
        assert!((sixth - Wide::pi()).to_f64().abs() < 1e-39);
    }

    #[test]
    fn what_is_no_number_is_refused_and_says_what_is() {
        for text in [
            "", "-", "--1", ".", "nan", "inf", "-inf", "wide", "1e", "1e+", "1e1.5", "1/0", "pi/0", "1/2/3", "pi pi",
            "* pi", "6/pi", "1 2", "0x10", "1_0", "١",
        ] {
            assert_eq!(Quantity::read(text), Err(QuantityError::NoNumber), "{text}");
        }
        for text in [
            "1e999999999",
            "1e-999999999",
            "1e101",
            "1e-101",
            "1e99999999999999999999999",
        ] {
            assert_eq!(Quantity::read(text), Err(QuantityError::Extreme), "{text}");
        }
        assert_eq!(Quantity::read(&"9".repeat(101)), Err(QuantityError::Long));
    }

    #[test]
    fn numbers_print_as_they_can_be_typed() {
        for text in [
            "0.26", "-3", "1/3", "pi", "-pi", "pi/6", "5 pi", "2 pi/3", "-2 pi/3", "0",
        ] {
            assert_eq!(read(text).to_string(), text);
        }
        let between = read("0.1").towards(&read("pi/3"), 1, 2);
        assert_eq!(between.to_string(), "0.05 + pi/6");
        assert_eq!(between.sign(), Ordering::Greater);
        assert_eq!(read("22/7").towards(&read("-pi"), 1, 2).sign(), Ordering::Greater);
        assert_eq!(read("-22/7").towards(&read("pi"), 1, 2).sign(), Ordering::Less);
    }

    #[test]
    fn one_is_one_to_every_digit() {
        let above = format!("1.{}1", "0".repeat(60));
        assert_eq!(read(&above).compared_with_one(), Ordering::Greater);
        assert_eq!(read("1.000").compared_with_one(), Ordering::Equal);
        assert_eq!(read("pi/4").compared_with_one(), Ordering::Less);
    }

    proptest! {
        #[test]
        fn in_f64_the_value_is_the_nearest_one(digits in "[0-9]{1,30}", point in 0_usize..30, exponent in -60_i32..60) {
            let point = point.min(digits.len());
            let text = format!("{}.{}e{exponent}", &digits[..point], &digits[point..]);
            let expected: f64 = text.parse().unwrap();
            prop_assert_eq!(read(&text).value::<f64>(), expected, "{}", text);
        }

        #[test]
        fn what_is_printed_reads_back(n in -10_000_i64..10_000, d in 1_i64..1000, turn: bool) {
            let text = format!("{n}{}/{d}", if turn { " pi" } else { "" });
            let value = read(&text);
            prop_assert_eq!(read(&value.to_string()), value);
        }
    }
}
