//! The four operations and the root.
//!
//! Joldes, Muller, Popescu, "Tight and rigorous error bounds for basic building blocks of double-word arithmetic",
//! ACM TOMS 44 (2017) 15res; the root by Lefèvre, Louvet, Muller, Picot, Rideau, "Accurate calculation of Euclidean
//! norms using double-word arithmetic", ACM TOMS 49 (2023) 1. Their proofs exclude overflow and underflow, so that
//! operands outside [2^-450, 2^450] are scaled there first.

use super::DoubleDouble;
use crate::error_free::{quick_two_sum, two_product, two_sum};
use std::ops::{Add, Div, Mul, Neg, Rem, Sub};

/// The biased exponent of f64, 0 of zeros and subnormals.
#[inline]
fn exponent(value: f64) -> u64 {
    value.to_bits() >> 52 & 0x7ff
}

/// Whether `value` is in [2^-450, 2^450).
#[inline]
fn is_moderate(value: f64) -> bool {
    exponent(value).wrapping_sub(1023 - 450) < 900
}

/// 2^`power`, within the range of normal numbers.
fn power_of_two(power: i64) -> f64 {
    f64::from_bits(((1023 + power.clamp(-1022, 1023)) as u64) << 52)
}

impl DoubleDouble {
    /// The value times 2^`power`, rounded where it underflows.
    pub(super) fn scaled(self, power: i64) -> Self {
        let (mut high, mut low, mut left) = (self.high, self.low, power);
        while left != 0 {
            let step = left.clamp(-1000, 1000);
            high *= power_of_two(step);
            low *= power_of_two(step);
            left -= step;
        }
        let (high, low) = if high.is_finite() {
            quick_two_sum(high, low)
        } else {
            (high, 0.0)
        };
        Self::from_parts(high, low)
    }

    /// A number with an exponent near 0, and the power of two that was taken out; for finite numbers but 0.
    pub(super) fn normalised(self) -> (Self, i64) {
        if exponent(self.high) == 0 {
            let (value, power) = self.scaled(200).normalised();
            return (value, power - 200);
        }
        let power = exponent(self.high) as i64 - 1023;
        (self.scaled(-power), power)
    }

    #[inline]
    fn is_zero_or_infinite(&self) -> bool {
        self.high == 0.0 || !self.high.is_finite()
    }

    /// Algorithm 10.
    #[inline]
    fn product(self, other: Self) -> Self {
        let (high, error) = two_product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        let (high, low) = quick_two_sum(high, error + cross);
        Self { high, low }
    }

    #[cold]
    fn scaled_product(self, other: Self) -> Self {
        if self.is_zero_or_infinite() || other.is_zero_or_infinite() {
            return Self::from_parts(self.high * other.high, 0.0);
        }
        let ((a, a_power), (b, b_power)) = (self.normalised(), other.normalised());
        a.product(b).scaled(a_power + b_power)
    }

    /// Algorithm 17, on algorithm 7 for the product by an f64.
    #[inline]
    fn quotient(self, other: Self) -> Self {
        let first = self.high / other.high;
        let (high, error) = two_product(other.high, first);
        let (high, low) = quick_two_sum(high, other.low * first);
        let (high, low) = quick_two_sum(high, low + error);
        let left = (self.high - high) + (self.low - low);
        let (high, low) = quick_two_sum(first, left / other.high);
        Self { high, low }
    }

    #[cold]
    fn scaled_quotient(self, other: Self) -> Self {
        if self.is_zero_or_infinite() || other.is_zero_or_infinite() {
            return Self::from_parts(self.high / other.high, 0.0);
        }
        let ((a, a_power), (b, b_power)) = (self.normalised(), other.normalised());
        a.quotient(b).scaled(a_power - b_power)
    }

    /// Algorithm 8 of the second paper. The residue of a root is an f64, so that both differences are exact.
    #[inline]
    pub(super) fn root(self) -> Self {
        if !is_moderate(self.high) || self.high < 0.0 {
            return self.scaled_root();
        }
        let first = self.high.sqrt();
        let (square, error) = two_product(first, first);
        let left = ((self.high - square) - error) + self.low;
        let (high, low) = quick_two_sum(first, left / (2.0 * first));
        Self { high, low }
    }

    #[cold]
    fn scaled_root(self) -> Self {
        if self.is_zero_or_infinite() || self.high < 0.0 {
            return Self::from_parts(self.high.sqrt(), 0.0);
        }
        let (value, power) = self.normalised();
        let odd = power.rem_euclid(2);
        value.scaled(odd).root().scaled((power - odd) / 2)
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    /// Algorithm 6.
    #[inline]
    fn add(self, other: Self) -> Self {
        let (sum, error) = two_sum(self.high, other.high);
        let (rest, rest_error) = two_sum(self.low, other.low);
        let (high, low) = quick_two_sum(sum, error + rest);
        let (high, low) = quick_two_sum(high, rest_error + low);
        if high.is_finite() {
            return Self { high, low };
        }
        // an infinity leaves NaN in its wake
        Self::from_parts(sum, 0.0)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        if is_moderate(self.high) && is_moderate(other.high) {
            return self.product(other);
        }
        self.scaled_product(other)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        if is_moderate(self.high) && is_moderate(other.high) {
            return self.quotient(other);
        }
        self.scaled_quotient(other)
    }
}

impl Rem for DoubleDouble {
    type Output = Self;
    /// What the division to an integer towards 0 leaves; NaN by 0.
    fn rem(self, other: Self) -> Self {
        if self.is_zero_or_infinite() || other.is_zero_or_infinite() {
            return Self::from_parts(self.high % other.high, 0.0);
        }
        Self::from_wide(&(self.to_wide::<80>() % other.to_wide::<80>()))
    }
}

impl num_traits::Zero for DoubleDouble {
    #[inline]
    fn zero() -> Self {
        Self { high: 0.0, low: 0.0 }
    }
    #[inline]
    fn is_zero(&self) -> bool {
        self.high == 0.0
    }
}

impl num_traits::One for DoubleDouble {
    #[inline]
    fn one() -> Self {
        Self { high: 1.0, low: 0.0 }
    }
}
