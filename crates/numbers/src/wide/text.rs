//! Decimals in and out, correctly rounded, by integers alone.

use super::Wide;
use dashu_float::Repr;
use dashu_int::{IBig, Sign, UBig};

/// Powers of ten beyond this take too long to be of use; f64 ends at 308.
const LARGEST_POWER: u32 = 100_000;

/// Whether a binary exponent belongs to a value too large or too small to be written with a power of ten.
pub(super) fn needs_power_of_two(exponent: isize) -> bool {
    exponent.unsigned_abs() > 4 * LARGEST_POWER as usize
}

impl<const DIGITS: usize> Wide<DIGITS> {
    /// The number nearest to a decimal such as `-0.26`, `1e-3` or `.5`: sign, digits with at most one point, power of
    /// ten up to 100000 in size.
    pub fn parse(text: &str) -> Option<Self> {
        let (negative, unsigned) = match text.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text.strip_prefix('+').unwrap_or(text)),
        };
        let (digits, power) = match unsigned.split_once(['e', 'E']) {
            Some((digits, power)) => (digits, power.parse::<i64>().ok()?),
            None => (unsigned, 0),
        };
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let digits = format!("{whole}{fraction}");
        if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
            return None;
        }
        let power = power.checked_sub(i64::try_from(fraction.len()).ok()?)?;
        let scale = u32::try_from(power.unsigned_abs())
            .ok()
            .filter(|power| *power <= LARGEST_POWER)?;
        let scale = UBig::from(10_u8).pow(scale as usize);
        let integer = digits.parse::<UBig>().ok()?;
        let value = if power >= 0 {
            Self::from_repr(Repr::new(IBig::from(integer * scale), 0))
        } else {
            Self::from_quotient(integer, &scale)
        };
        Some(if negative { -value } else { value })
    }

    /// Rounded once: two bits more than needed, and a last one that says whether anything was left.
    fn from_quotient(numerator: UBig, denominator: &UBig) -> Self {
        let wanted = Self::context().precision() + 2;
        let shift = (wanted + bits(denominator)).saturating_sub(bits(&numerator));
        let shifted = numerator << shift;
        let (quotient, rest) = (&shifted / denominator, &shifted % denominator);
        let sticky = u8::from(rest != UBig::ZERO);
        let Ok(exponent) = isize::try_from(shift + 1) else {
            return Self::INVALID;
        };
        Self::from_repr(Repr::new(IBig::from((quotient << 1) + sticky), -exponent))
    }

    /// The decimal of `significant` digits nearest to the value, halves to even: `-0.26000`, or `2.60e-12` where
    /// the power of ten is below -5 or leaves no room for the point. Values too large or too small for a power of ten
    /// are written with a power of two: `1.7333*2^14426950408`. NaN where invalid.
    pub fn to_decimal(&self, significant: usize) -> String {
        let Some(big) = &self.0 else {
            return "NaN".to_owned();
        };
        let significant = significant.max(1);
        if num_traits::Zero::is_zero(self) {
            return positional("", &"0".repeat(significant), 0);
        }
        let repr = big.repr();
        let (sign, integer) = repr.significand().clone().into_parts();
        let sign = if sign == Sign::Negative { "-" } else { "" };
        let exponent = repr.exponent();
        if needs_power_of_two(exponent) {
            let places = isize::try_from(bits(&integer) - 1).unwrap_or_default();
            let mantissa = Self::from_repr(Repr::new(IBig::from(integer), -places));
            let mantissa = mantissa.to_decimal(significant);
            return format!("{sign}{mantissa}*2^{}", exponent.saturating_add(places));
        }
        // an estimate of the power of ten of the first digit, at most one too small
        let size = exponent as f64 + (bits(&integer) - 1) as f64;
        let mut power = (size * std::f64::consts::LOG10_2).floor() as i64 - 1;
        loop {
            let digits = rounded(&integer, exponent, significant as i64 - 1 - power).to_string();
            if digits.len() > significant {
                power += 1;
                continue;
            }
            return if (-5..significant as i64).contains(&power) {
                positional(sign, &digits, power)
            } else {
                let (first, rest) = digits.split_at(1);
                let point = if rest.is_empty() { "" } else { "." };
                format!("{sign}{first}{point}{rest}e{power}")
            };
        }
    }
}

fn bits(integer: &UBig) -> usize {
    use dashu_int::ops::BitTest;
    integer.bit_len()
}

/// `integer` 2^`exponent` 10^`power` to the nearest integer, halves to even.
fn rounded(integer: &UBig, exponent: isize, power: i64) -> UBig {
    let ten = UBig::from(10_u8).pow(power.unsigned_abs() as usize);
    let (mut numerator, mut denominator) = (integer.clone(), UBig::ONE);
    if power >= 0 {
        numerator *= ten;
    } else {
        denominator *= ten;
    }
    if exponent >= 0 {
        numerator <<= exponent.unsigned_abs();
    } else {
        denominator <<= exponent.unsigned_abs();
    }
    let (quotient, rest) = (&numerator / &denominator, &numerator % &denominator);
    let twice = rest << 1;
    let odd = &quotient % UBig::from(2_u8) != UBig::ZERO;
    if twice > denominator || (twice == denominator && odd) {
        quotient + UBig::ONE
    } else {
        quotient
    }
}

/// Digits with the point after the one that stands for 10^0.
fn positional(sign: &str, digits: &str, power: i64) -> String {
    let Ok(before) = usize::try_from(power + 1) else {
        let zeros = "0".repeat(power.unsigned_abs() as usize - 1);
        return format!("{sign}0.{zeros}{digits}");
    };
    let (whole, fraction) = digits.split_at(before.min(digits.len()));
    match (whole.is_empty(), fraction.is_empty()) {
        (true, _) => format!("{sign}0.{fraction}"),
        (false, true) => format!("{sign}{whole}"),
        (false, false) => format!("{sign}{whole}.{fraction}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivable::Elementary;
    use crate::{Analytic, Field, Sequence};

    type Number = Wide<40>;

    #[test]
    fn values_beyond_powers_of_ten_are_written_with_powers_of_two() {
        let exponential = |exponent: i64| Number::from_integer(exponent).elementary(Elementary::Exp);
        // 10^6 / ln 2 = 1442695.0408889...
        assert_eq!(exponential(1_000_000).to_decimal(5), "1.0287*2^1442695");
        assert_eq!(exponential(-1_000_000).to_decimal(3), "1.94*2^-1442696");
        assert!(exponential(1_000_000).to_string().ends_with("*2^1442695"));
        assert_eq!(exponential(10_000_000_000).to_decimal(5), "NaN");
    }

    #[test]
    fn a_decimal_reads_as_the_nearest_number() {
        for text in [
            "0.26",
            "-0.26",
            "+1e-3",
            ".5",
            "12.",
            "1E22",
            "9007199254740993",
            "-4.9e-324",
            "1.7e308",
            "0",
        ] {
            let read = Number::parse(text).unwrap().to_f64();
            assert_eq!(read, text.parse::<f64>().unwrap(), "{text}");
        }
        for text in [
            "", ".", "-", "e5", "1e", "1e999999", "1.2.3", "0x1", "1 ", "inf", "nan", "--1", "1e1.5", "\u{661}",
        ] {
            assert!(Number::parse(text).is_none(), "{text}");
        }
        let quotient = Number::parse("1").unwrap() / Number::parse("7").unwrap();
        assert_eq!(Number::parse(&format!("0.{}", "142857".repeat(20))), Some(quotient));
    }

    #[test]
    fn a_decimal_is_written_with_the_digits_asked_for() {
        let text = |text: &str, digits: usize| Number::parse(text).unwrap().to_decimal(digits);
        assert_eq!(text("0.26", 5), "0.26000");
        assert_eq!(text("-123.456", 4), "-123.5");
        assert_eq!(text("999.96", 4), "1000");
        assert_eq!(text("999.96", 5), "999.96");
        assert_eq!(text("99996", 4), "1.000e5");
        assert_eq!(text("0.000012345", 3), "0.0000123");
        assert_eq!(text("0.0000012345", 3), "1.23e-6");
        assert_eq!(text("2.5", 1), "2");
        assert_eq!(text("3.5", 1), "4");
        assert_eq!(text("0", 3), "0.00");
        assert_eq!(Number::pi().to_decimal(30), "3.14159265358979323846264338328");
        assert_eq!(Number::INVALID.to_decimal(3), "NaN");
    }

    #[test]
    fn decimals_of_f64_are_those_of_the_standard_library_and_read_back() {
        let mut sequence = Sequence::new(11);
        for _ in 0..300 {
            let value = f64::from_bits(sequence.draw());
            if !value.is_finite() || value == 0.0 {
                continue;
            }
            let written = Number::from_f64(value).to_decimal(17);
            assert_eq!(written.parse::<f64>().unwrap(), value, "{written}");
            let (ours, theirs) = (Number::parse(&written).unwrap(), format!("{value:.16e}"));
            assert_eq!(ours, Number::parse(&theirs).unwrap(), "{written} {theirs}");
        }
    }

    #[test]
    fn forty_digits_read_back_to_forty_digits() {
        let mut sequence = Sequence::new(12);
        for _ in 0..100 {
            let value = Number::from_f64(sequence.between(-1e9, 1e9)).sincos().0;
            // 52 digits tell all numbers of 165 bits apart
            assert_eq!(Number::parse(&value.to_decimal(52)), Some(value));
        }
    }
}
