//! Double-double: twice the digits of f64 at some ten times its cost.

mod arithmetic;
mod functions;

use super::derivable::Elementary;
use super::error_free::quick_two_sum;
use super::{Analytic, Endpoint, Field, Rung, Wide};
use std::fmt;

/// A number of 106 bits, 31 decimal digits: the unevaluated sum of two f64, the second at most half an ulp of the
/// first.
///
/// With u = 2^-53, the relative error of one operation is below
///
/// | operation | bound | source |
/// |---|---|---|
/// | sum, difference | 3.1 u² | Joldes, Muller, Popescu 2017, algorithm 6 |
/// | product | 7 u² | the same, algorithm 10 |
/// | quotient | 15.1 u² | the same, algorithm 17 |
/// | root | 3.2 u² | Lefèvre, Louvet, Muller, Picot, Rideau 2023, algorithm 8 |
/// | sine, cosine, for any finite angle | 64 u² | `functions.rs` |
/// | arc cosine, arc sine, angle | 128 u² | `functions.rs` |
/// | power, exponential, logarithm and the others | u² | through [`Wide`], tens of microseconds |
///
/// also for operands and results near the ends of the range of f64, where 2^-1068 is to be added for underflow and
/// above 2^1000 the bound is that of f64, 2u. Infinities and NaN are those that f64 gives for the leading parts.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    // in this order: the derived comparison is that of the values
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// The sum of any two f64, exactly, unless it overflows.
    pub fn from_sum(a: f64, b: f64) -> Self {
        let (high, low) = super::error_free::two_sum(a, b);
        Self::from_parts(high, low)
    }

    /// The leading part, which is the nearest f64.
    #[inline]
    pub fn high(&self) -> f64 {
        self.high
    }

    /// What the leading part leaves, at most half an ulp of it.
    #[inline]
    pub fn low(&self) -> f64 {
        self.low
    }

    /// Two parts whose sum rounds to the first; an infinity or NaN has no second.
    #[inline]
    fn from_parts(high: f64, low: f64) -> Self {
        let low = if high.is_finite() && low.is_finite() { low } else { 0.0 };
        Self { high, low }
    }

    /// The nearest to a number of more digits, within u²; what is invalid is NaN.
    pub fn from_wide<const DIGITS: usize>(value: &Wide<DIGITS>) -> Self {
        let high = value.to_f64();
        let rest = (value.clone() - Wide::from_f64(high)).to_f64();
        if !rest.is_finite() {
            return Self::from_parts(high, 0.0);
        }
        let (high, low) = quick_two_sum(high, rest);
        Self::from_parts(high, low)
    }

    /// The value in more digits, exactly from 33 digits on unless the two parts are far from each other.
    pub fn to_wide<const DIGITS: usize>(&self) -> Wide<DIGITS> {
        Wide::from_f64(self.high) + Wide::from_f64(self.low)
    }

    /// What many digits say; where they say nothing of an argument too large for them, what f64 does, an infinity,
    /// 0 or 1.
    fn through_wide(value: &Wide<DIGITS_BETWEEN>, is_large: bool, rough: f64) -> Self {
        match (value.is_valid(), is_large) {
            (true, _) => Self::from_wide(value),
            (false, true) => Self::from_parts(rough, 0.0),
            (false, false) => Self::from_parts(f64::NAN, 0.0),
        }
    }

    pub(crate) fn elementary(&self, function: Elementary) -> Self {
        let rough = function.of(&self.high);
        if self.high == 0.0 || !self.high.is_finite() {
            return Self::from_parts(rough, 0.0);
        }
        let value = match function {
            Elementary::Tan => {
                let (sin, cos) = self.sincos();
                return sin / cos;
            }
            Elementary::Asin => return self.asin(),
            Elementary::Atan => return Analytic::atan2(self, &num_traits::One::one()),
            // the second part alone is the distance from 1, however small
            Elementary::Ln if self.high == 1.0 => Wide::from_f64(self.low).elementary(Elementary::Ln1p),
            _ => self.to_wide::<DIGITS_BETWEEN>().elementary(function),
        };
        Self::through_wide(&value, self.high.abs() > 1024.0, rough)
    }
}

/// Digits of the way through [`Wide`]: 106 bits and room for the functions, which are rounded correctly there.
const DIGITS_BETWEEN: usize = 40;

impl From<DoubleDouble> for f64 {
    fn from(value: DoubleDouble) -> Self {
        value.high
    }
}

impl fmt::Display for DoubleDouble {
    /// 32 digits; infinities and NaN as of f64.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.high.is_finite() {
            self.to_wide::<32>().fmt(f)
        } else {
            self.high.fmt(f)
        }
    }
}

impl fmt::Debug for DoubleDouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

derivable!([] DoubleDouble);

impl Field for DoubleDouble {
    /// Exactly: 63 bits fit.
    fn from_integer(value: i64) -> Self {
        let high = value as f64;
        // i64::MAX rounds to 2^63, beyond i64
        let rest = (i128::from(value) - high as i128) as f64;
        Self::from_parts(high, rest)
    }
}

/// Relative distance that covers the error of any one operation, 128 u² and the steps of the bound itself.
const SLACK: f64 = 1.0 / (1_u128 << 98) as f64;
/// From here on products inside an operation may overflow.
const LARGE: f64 = f64::from_bits((1023 + 1000) << 52);
/// More than all that underflow may lose in one operation, 2^-1067.
const UNDERFLOW: f64 = f64::from_bits(1 << 7);

impl DoubleDouble {
    /// How far off the result of one operation may be.
    #[inline]
    fn slack(&self) -> f64 {
        let size = self.high.abs();
        let relative = if size < LARGE { SLACK } else { 2.0 * f64::EPSILON };
        size * relative + UNDERFLOW
    }
}

/// By the bounds stated for [`DoubleDouble`], all covered by one relative distance.
impl Endpoint for DoubleDouble {
    const INFINITE: bool = true;

    #[inline]
    fn below(&self) -> Self {
        if !self.high.is_finite() {
            // NaN claims nothing; what overflows is at least about the largest number
            let bound = if self.high == f64::INFINITY {
                f64::MAX
            } else {
                f64::NEG_INFINITY
            };
            return Self::from_parts(bound, 0.0);
        }
        let (high, low) = quick_two_sum(self.high, self.low - self.slack());
        Self::from_parts(high, low)
    }

    #[inline]
    fn above(&self) -> Self {
        -(-*self).below()
    }

    fn lowest() -> Self {
        Self::from_parts(f64::NEG_INFINITY, 0.0)
    }

    fn highest() -> Self {
        Self::from_parts(f64::INFINITY, 0.0)
    }

    #[inline]
    fn is_finite(&self) -> bool {
        self.high.is_finite()
    }

    fn rung() -> Rung {
        Rung::DoubleDouble
    }

    fn bounded_exp(&self) -> Self {
        self.elementary(Elementary::Exp)
    }

    fn bounded_ln(&self) -> Self {
        self.elementary(Elementary::Ln)
    }
}
