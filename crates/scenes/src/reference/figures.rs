//! A number as it is printed: its exact value and what its last figure is worth.

use dashu_int::IBig;
use dashu_ratio::RBig;
use num_traits::{One, Zero};
use numbers::{Field, Rational};
use std::fmt;

/// Powers of ten beyond this are a slip of the keyboard, and would cost memory.
const LARGEST_POWER: i32 = 400;

/// Decimals of no more characters than this are shown in full.
pub const LEGIBLE: usize = 40;

/// A decimal as printed, exact.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Figures {
    /// The value.
    pub value: Rational,
    /// The place of the last figure: it counts powers `10^-places`.
    pub places: i32,
    /// The significant figures: those after leading zeros; at least 1.
    pub count: i32,
}

impl Figures {
    /// Reads `0.677449`, `.26`, `-37876.8`, `5.319e-3`; a true minus sign is one too.
    ///
    /// `None` for anything else, NaN and infinities included, and for powers of ten beyond 400.
    pub fn read(text: &str) -> Option<Self> {
        let (negative, unsigned) = match text.strip_prefix(['-', '\u{2212}']) {
            Some(rest) => (true, rest),
            None => (false, text.strip_prefix('+').unwrap_or(text)),
        };
        let (mantissa, power) = match unsigned.split_once(['e', 'E']) {
            Some((mantissa, power)) => (mantissa, power.parse::<i32>().ok()?),
            None => (unsigned, 0),
        };
        if power.abs() > LARGEST_POWER {
            return None;
        }
        let magnitude = Rational::from_decimal(mantissa)? * power_of_ten(power);
        let fraction = mantissa.split_once('.').map_or("", |(_, fraction)| fraction);
        let digits = mantissa.replace('.', "");
        let significant = digits.trim_start_matches('0').len().max(1);
        Some(Self {
            value: if negative { -magnitude } else { magnitude },
            places: i32::try_from(fraction.len()).ok()?.checked_sub(power)?,
            count: i32::try_from(significant).ok()?,
        })
    }

    /// Whether this is 0 without places after the point, whose unit says nothing.
    pub fn is_zero_alone(&self) -> bool {
        self.value.is_zero() && self.places <= 0
    }

    /// One unit of the last figure.
    pub fn unit(&self) -> Rational {
        power_of_ten(-self.places)
    }

    /// Reads a number as papers print it: as [`Figures::read`] does, or with a power of ten as in `8.327 \times 10^{-1}`,
    /// `8.327 \cdot 10^{-1}` or `8.327×10^-1`, with an uncertainty as in `0.8327(1)` or `0.8327 \pm 0.0001`, or with both;
    /// between dollar signs or not. The second value is the uncertainty.
    pub fn read_printed(text: &str) -> Option<(Self, Option<Rational>)> {
        let text = text.trim();
        let text = text
            .strip_prefix('$')
            .and_then(|text| text.strip_suffix('$'))
            .unwrap_or(text);
        let plain = text
            .replace("\\,", "")
            .replace("\\times", "×")
            .replace("\\cdot", "×")
            .replace('·', "×");
        let plain: String = plain.replace("\\pm", "±").split_whitespace().collect();
        // blanks stand around signs, never within a number
        let is_cut = |pair: &[&str]| matches!(pair, [a, b] if a.ends_with(is_numeral) && b.starts_with(is_numeral));
        if text.split_whitespace().collect::<Vec<_>>().windows(2).any(is_cut) {
            return None;
        }
        let (mantissa, power) = match plain.split_once('×') {
            Some((mantissa, power)) => {
                let power = power.strip_prefix("10^")?;
                let power = power
                    .strip_prefix('{')
                    .and_then(|power| power.strip_suffix('}'))
                    .unwrap_or(power);
                (mantissa, power.replace('\u{2212}', "-").parse::<i32>().ok()?)
            }
            None => (plain.as_str(), 0),
        };
        if power.abs() > LARGEST_POWER || (power != 0 && mantissa.contains(['e', 'E'])) {
            return None;
        }
        let (value, uncertainty) = uncertain(mantissa)?;
        let scaled = Self {
            value: value.value * power_of_ten(power),
            places: value.places.checked_sub(power)?,
            count: value.count,
        };
        Some((scaled, uncertainty.map(|uncertainty| uncertainty * power_of_ten(power))))
    }

    /// The first figure, counted from 1, in which this and a number that is rounded to as many places differ; past the
    /// last one if they do not.
    pub fn first_differing(&self, number: &Rational) -> i32 {
        let digits = |value: &Rational| rounded(&(size(value.clone()) * power_of_ten(self.places)), 0);
        let (own, other) = (digits(&self.value), digits(number));
        let is_negative = |value: &Rational| *value < Rational::zero();
        if self.is_zero_alone() || other.len() > own.len() || is_negative(&self.value) != is_negative(number) {
            return 1;
        }
        let zeros = own.len() - other.len();
        let padded = "0".repeat(zeros) + &other;
        let same = own.bytes().zip(padded.bytes()).take_while(|(a, b)| a == b).count();
        // of a number such as 0.00 the zeros are no figures
        let leading = own.len().saturating_sub(usize::try_from(self.count).unwrap_or(0));
        i32::try_from(same.saturating_sub(leading)).map_or(self.count, |same| same + 1)
    }
}

/// Returns true for a character of a decimal.
fn is_numeral(c: char) -> bool {
    c.is_ascii_digit() || c == '.'
}

/// Parses a decimal with an uncertainty or without one: `0.8327(1)`, whose bracket counts units of the last figure,
/// `0.8327±0.0001`, `(0.8327±0.0001)`.
fn uncertain(text: &str) -> Option<(Figures, Option<Rational>)> {
    let inner = text
        .strip_prefix('(')
        .and_then(|text| text.strip_suffix(')'))
        .unwrap_or(text);
    if let Some((value, uncertainty)) = inner.split_once('±') {
        let uncertainty = Figures::read(uncertainty)?.value;
        return (uncertainty >= Rational::zero()).then_some((Figures::read(value)?, Some(uncertainty)));
    }
    if let Some((value, units)) = text.strip_suffix(')').and_then(|text| text.split_once('(')) {
        let value = Figures::read(value)?;
        let is_plain = !units.is_empty() && units.bytes().all(|byte| byte.is_ascii_digit());
        let uncertainty = Rational::from_decimal(units).filter(|_| is_plain)? * value.unit();
        return Some((value, Some(uncertainty)));
    }
    Some((Figures::read(text)?, None))
}

/// In full, or with a power of ten where that is long.
impl fmt::Display for Figures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let decimal = rounded(&self.value, self.places.max(0));
        if decimal.len() <= LEGIBLE {
            return f.write_str(&decimal);
        }
        let mantissa = rounded(&(self.value.clone() * power_of_ten(self.places)), 0);
        write!(f, "{mantissa}e{}", -self.places)
    }
}

/// `10^power`, exact.
pub fn power_of_ten(power: i32) -> Rational {
    Rational::from_integer(10).to_power(power)
}

/// The size of a number.
pub fn size(value: Rational) -> Rational {
    if value < Rational::zero() { -value } else { value }
}

/// The value rounded to so many places after the point, a half away from zero.
pub fn rounded(value: &Rational, places: i32) -> String {
    let scale = power_of_ten(places);
    let scaled = value.clone() * scale.clone();
    let half = Rational(RBig::from_parts(IBig::ONE, dashu_int::UBig::from(2u8)));
    let shifted = if scaled < Rational::zero() {
        scaled - half
    } else {
        scaled + half
    };
    // Truncation, so that the half above decides.
    let whole = Rational(RBig::from(shifted.0.trunc()));
    (whole / scale).to_decimal().unwrap_or_default()
}

/// The nearest f64, an infinity beyond its range.
pub fn to_f64(value: &Rational) -> f64 {
    value.0.to_f64().value()
}

/// The agreeing digits of two numbers that differ: `-log10 |difference / reference|`, never below 0.
pub fn agreeing(difference: &Rational, reference: &Rational) -> f64 {
    let reference = if reference.is_zero() {
        Rational::one()
    } else {
        size(reference.clone())
    };
    let relative = to_f64(&(difference.clone() / reference));
    (-relative.log10()).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Option<String>, i32, i32) {
        Figures::read(text).map_or((None, 0, 0), |figures| {
            (figures.value.to_decimal(), figures.places, figures.count)
        })
    }

    #[test]
    fn every_spelling_of_a_printed_number_is_read_exactly() {
        for (text, value, places, count) in [
            ("0.677449", "0.677449", 6, 6),
            ("-.67004", "-0.67004", 5, 5),
            ("\u{2212}0.5", "-0.5", 1, 1),
            ("37876.8", "37876.8", 1, 6),
            ("1.21387", "1.21387", 5, 6),
            ("0.0120", "0.012", 4, 3),
            ("5.319e-3", "0.005319", 6, 4),
            ("6E4", "60000", -4, 1),
            ("2000", "2000", 0, 4),
            ("0", "0", 0, 1),
            ("+1.0", "1", 1, 2),
        ] {
            assert_eq!(read(text), (Some(value.to_owned()), places, count), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_not_guessed() {
        for text in [
            "", "-", ".", "abc", "NaN", "inf", "1,5", "1.2.3", "0x1", "1e", "1e999", "e5", "--1", "1 2",
        ] {
            assert_eq!(Figures::read(text), None, "{text}");
        }
    }

    #[test]
    fn the_first_figure_that_differs_is_counted_from_the_first_that_is_not_0() {
        for (printed, computed, figure) in [
            ("0.701752", "0.7017134", 5),
            ("0.8330", "0.8328", 3),
            ("0.08330", "0.08328", 3),
            ("0.83284", "0.83272", 4),
            ("1.002", "0.998", 1),
            ("37876", "37976", 3),
            ("12", "123", 1),
            ("-5.1", "5.1", 1),
            ("0.00", "0.02", 1),
            ("5.31e-3", "0.00537", 3),
            ("0.25", "0.2501", 3),
        ] {
            let both = Figures::read(printed).zip(Figures::read(computed));
            let found = both.map(|(printed, computed)| printed.first_differing(&computed.value));
            assert_eq!(found, Some(figure), "{printed} {computed}");
        }
    }

    #[test]
    fn numbers_are_read_as_papers_print_them() {
        for (text, plain, uncertainty) in [
            ("0.8327", "0.8327", None),
            (r"8.327 \times 10^{-1}", "8.327e-1", None),
            (r"$8.327 \cdot 10^{-1}$", "8.327e-1", None),
            (r"-8.327\,\times\,10^3", "-8.327e3", None),
            ("\u{2212}8.327×10^{\u{2212}1}", "-8.327e-1", None),
            ("0.8327(1)", "0.8327", Some("0.0001")),
            ("0.8327(12)", "0.8327", Some("0.0012")),
            ("832(5)", "832", Some("5")),
            (r"0.8327 \pm 0.0001", "0.8327", Some("0.0001")),
            ("0.8327 ± 0.0001", "0.8327", Some("0.0001")),
            (r"8.327(1) \times 10^{-1}", "8.327e-1", Some("0.0001")),
            (r"(8.327 \pm 0.001) \times 10^{-1}", "8.327e-1", Some("0.0001")),
        ] {
            let wanted = Figures::read(plain).map(|figures| (figures, uncertainty.and_then(Rational::from_decimal)));
            assert_eq!(Figures::read_printed(text), wanted, "{text}");
        }
        for text in [
            "0.83 27",
            "1 2",
            "(0.4, 1)",
            "< 3",
            "1 \\times 2",
            "1 \\times 10",
            "0.8(x)",
            "0.8()",
            "0.8(0.1)",
            "(1)",
            "1e400×10^{5}",
            "1 \\pm -2",
            "1 \\pm",
            "word",
            "",
            "$",
            "10^{-1}",
            "1×10^{999}",
        ] {
            assert_eq!(Figures::read_printed(text), None, "{text}");
        }
    }

    #[test]
    fn rounding_is_to_the_nearest_decimal() {
        let rounded_text = |text: &str, places| Figures::read(text).map(|figures| rounded(&figures.value, places));
        assert_eq!(rounded_text("0.70171343", 6).as_deref(), Some("0.701713"));
        assert_eq!(rounded_text("-0.55547166", 5).as_deref(), Some("-0.55547"));
        assert_eq!(rounded_text("-0.55547866", 5).as_deref(), Some("-0.55548"));
        assert_eq!(rounded_text("0.5", 0).as_deref(), Some("1"));
    }
}
