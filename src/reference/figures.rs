//! A number as it is printed: its exact value and what its last figure is worth.

use crate::number::{Field, Rational};
use dashu_int::IBig;
use dashu_ratio::RBig;
use num_traits::{One, Zero};
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

    /// The first figure, counted from 1, whose unit a difference of this size reaches; past the last one where
    /// the difference is smaller than every unit.
    pub fn first_differing(&self, difference: &Rational) -> i32 {
        let mut unit = self.unit() * power_of_ten(self.count - 1);
        for figure in 1..=self.count {
            if *difference >= unit {
                return figure;
            }
            unit /= Rational::from_integer(10);
        }
        self.count + 1
    }
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
    fn a_difference_is_placed_at_the_figure_whose_unit_it_reaches() {
        let printed = Figures::read("0.701752");
        let off = Rational::from_decimal("0.0000385686");
        let figure = printed.zip(off).map(|(printed, off)| printed.first_differing(&off));
        assert_eq!(figure, Some(5));
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
