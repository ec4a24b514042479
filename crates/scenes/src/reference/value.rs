//! A computed value and how far it may be wrong.

use super::figures::{Figures, power_of_ten, size};
use num_traits::Zero;
use numbers::{Field, Rational};

/// More digits than any row has.
const MOST_DIGITS: f64 = 1e4;

/// A computed value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Value {
    /// As CSV prints it; empty where it is not known.
    pub text: String,
    /// How far the true value may be from the text; `None` where nothing is certified. Words and counts are exact.
    pub bound: Option<Rational>,
}

/// How far the true value may be from `text`: the certified bound of its row or, where there is none, what the digits
/// of the row leave open; and what printing it costs. Words are exact, and so are counts, which CSV prints without a
/// point.
pub fn bound(text: &str, certified: &str, digits: &str) -> Option<Rational> {
    let Some(figures) = Figures::read(text) else {
        return Some(Rational::zero());
    };
    if !text.contains(['.', 'e', 'E']) {
        return Some(Rational::zero());
    }
    let known = Figures::read(certified).filter(|bound| bound.value >= Rational::zero());
    let certified = match known {
        Some(bound) => bound.value,
        // Where not even one digit holds, nothing is claimed.
        None => {
            let digits: f64 = digits.parse().ok().filter(|&digits: &f64| digits >= 1.0)?;
            size(figures.value.clone()) * power_of_ten(-(digits.min(MOST_DIGITS) as i32))
        }
    };
    // Up to 17 figures it is an f64 in its shortest form, which is within half a unit in its last place of it.
    let of_text = if figures.count <= 17 {
        size(figures.value) * Rational::from_integer(2).to_power(-53)
    } else {
        power_of_ten(-figures.places) / Rational::from_integer(2)
    };
    Some(certified + of_text)
}
