//! The four operations and integer powers of intervals.

use super::{Interval, greatest, least};
use crate::{Endpoint, Field};
use std::ops::{Add, Neg, Sub};

/// A lower bound of a sum. A sum of floats that is 0 is exact.
#[inline]
pub(super) fn sum_below<E: Endpoint>(a: E, b: E) -> E {
    let sum = a + b;
    if sum.is_zero() { sum } else { sum.below() }
}

#[inline]
pub(super) fn sum_above<E: Endpoint>(a: E, b: E) -> E {
    let sum = a + b;
    if sum.is_zero() { sum } else { sum.above() }
}

/// Whether the exact product is not below 0.
#[cold]
fn is_not_negative<E: Endpoint>(a: &E, b: &E) -> bool {
    a.is_zero() || b.is_zero() || (*a > E::zero()) == (*b > E::zero())
}

#[cold]
fn is_not_positive<E: Endpoint>(a: &E, b: &E) -> bool {
    a.is_zero() || b.is_zero() || (*a > E::zero()) != (*b > E::zero())
}

/// A lower bound of a product, which keeps the sign that its factors give it: a product with 0 is exactly 0.
#[inline]
pub(super) fn product_below<E: Endpoint>(a: &E, b: &E) -> E {
    let product = a.clone() * b.clone();
    let bound = product.below();
    if product >= E::zero() && bound < E::zero() && is_not_negative(a, b) {
        E::zero()
    } else {
        bound
    }
}

#[inline]
pub(super) fn product_above<E: Endpoint>(a: &E, b: &E) -> E {
    let product = a.clone() * b.clone();
    let bound = product.above();
    if product <= E::zero() && bound > E::zero() && is_not_positive(a, b) {
        E::zero()
    } else {
        bound
    }
}

#[inline]
pub(super) fn quotient_below<E: Endpoint>(a: &E, b: &E) -> E {
    let quotient = a.clone() / b.clone();
    if a.is_zero() { quotient } else { quotient.below() }
}

#[inline]
pub(super) fn quotient_above<E: Endpoint>(a: &E, b: &E) -> E {
    let quotient = a.clone() / b.clone();
    if a.is_zero() { quotient } else { quotient.above() }
}

impl<E: Endpoint> Interval<E> {
    /// By repeated products, each rounded outward, of numbers that keep one sign.
    fn repeated(&self, times: u32) -> Self {
        let (mut result, mut square, mut left) = (Self::point(E::one()), self.clone(), times);
        while left > 0 {
            if left & 1 == 1 {
                result *= square.clone();
            }
            left >>= 1;
            if left > 0 {
                square = square.clone() * square;
            }
        }
        result
    }

    /// The quotient by numbers that are not below 0.
    #[inline]
    fn over_positive(&self, divisor: &Self) -> Self {
        let open = divisor.low.is_zero();
        if open && (divisor.high.is_zero() || !(self.low >= E::zero() || self.high <= E::zero())) {
            return Self::whole();
        }
        // the size of an end is largest over the least divisor: an infinity where that is 0
        let low = if self.low >= E::zero() {
            greatest(quotient_below(&self.low, &divisor.high), E::zero())
        } else if open {
            E::lowest()
        } else {
            quotient_below(&self.low, &divisor.low)
        };
        let high = if self.high <= E::zero() {
            least(quotient_above(&self.high, &divisor.high), E::zero())
        } else if open {
            E::highest()
        } else {
            quotient_above(&self.high, &divisor.low)
        };
        Self::bounded(low, high)
    }
}

impl<E: Endpoint> Add for Interval<E> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::bounded(sum_below(self.low, other.low), sum_above(self.high, other.high))
    }
}

impl<E: Endpoint> Sub for Interval<E> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::bounded(sum_below(self.low, -other.high), sum_above(self.high, -other.low))
    }
}

impl<E: Endpoint> Neg for Interval<E> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self {
            low: -self.high,
            high: -self.low,
        }
    }
}

impl<E: Endpoint> std::ops::Mul for Interval<E> {
    type Output = Self;
    /// By the signs of the ends, so that two products do for all but two intervals around 0.
    #[inline]
    fn mul(self, other: Self) -> Self {
        let zero = E::zero();
        let (a, b) = (&self, &other);
        let (least_pair, largest_pair) = if a.low >= zero {
            let least = if b.low >= zero { &a.low } else { &a.high };
            let largest = if b.high >= zero { &a.high } else { &a.low };
            ((least, &b.low), (largest, &b.high))
        } else if a.high <= zero {
            let least = if b.high >= zero { &a.low } else { &a.high };
            let largest = if b.low >= zero { &a.high } else { &a.low };
            ((least, &b.high), (largest, &b.low))
        } else if b.low >= zero {
            ((&a.low, &b.high), (&a.high, &b.high))
        } else if b.high <= zero {
            ((&a.high, &b.low), (&a.low, &b.low))
        } else {
            let low = least(product_below(&a.low, &b.high), product_below(&a.high, &b.low));
            let high = greatest(product_above(&a.low, &b.low), product_above(&a.high, &b.high));
            return Self::bounded(low, high);
        };
        Self::bounded(
            product_below(least_pair.0, least_pair.1),
            product_above(largest_pair.0, largest_pair.1),
        )
    }
}

impl<E: Endpoint> std::ops::Div for Interval<E> {
    type Output = Self;
    /// The whole line over an interval around 0; over one that ends at 0 a half line, where the signs allow.
    #[inline]
    fn div(self, other: Self) -> Self {
        if other.low >= E::zero() {
            self.over_positive(&other)
        } else if other.high <= E::zero() {
            (-self).over_positive(&-other)
        } else {
            Self::whole()
        }
    }
}

macro_rules! assigning {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<E: Endpoint> std::ops::$trait for Interval<E> {
            #[inline]
            fn $method(&mut self, other: Self) {
                *self = self.clone() $operator other;
            }
        }
    };
}
assigning!(AddAssign, add_assign, +);
assigning!(SubAssign, sub_assign, -);
assigning!(MulAssign, mul_assign, *);
assigning!(DivAssign, div_assign, /);

impl<E: Endpoint> num_traits::Zero for Interval<E> {
    #[inline]
    fn zero() -> Self {
        Self::point(E::zero())
    }
    /// Whether this is the number 0 and no other.
    #[inline]
    fn is_zero(&self) -> bool {
        self.low.is_zero() && self.high.is_zero()
    }
}

impl<E: Endpoint> num_traits::One for Interval<E> {
    #[inline]
    fn one() -> Self {
        Self::point(E::one())
    }
}

/// Integers beyond this size are rounded by f64.
const EXACT_IN_F64: u64 = 1 << f64::MANTISSA_DIGITS;

impl<E: Endpoint> Field for Interval<E> {
    /// The integer itself up to 2^53 (where `E` holds it), around it beyond.
    fn from_integer(value: i64) -> Self {
        let nearest = E::from_integer(value);
        if value.unsigned_abs() <= EXACT_IN_F64 && nearest.to_f64() == value as f64 {
            return Self::point(nearest);
        }
        Self::around(&nearest)
    }

    /// Tight: an even power is never below 0, an odd one is taken at the ends.
    fn to_power(&self, exponent: i32) -> Self {
        if self.is_whole() {
            return if exponent == 0 {
                Self::point(E::one())
            } else {
                Self::whole()
            };
        }
        let times = exponent.unsigned_abs();
        let base = if times.is_multiple_of(2) {
            self.size()
        } else {
            self.clone()
        };
        let low = Self::point(base.low).repeated(times).low;
        let high = Self::point(base.high).repeated(times).high;
        let power = Self::bounded(low, high);
        if exponent < 0 {
            Self::point(E::one()) / power
        } else {
            power
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Analytic, Rational};

    type Line = Interval<f64>;

    fn between(low: f64, high: f64) -> Line {
        Line::new(low, high)
    }

    #[test]
    fn a_division_by_what_ends_at_zero_is_a_half_line() {
        assert_eq!(
            between(1.0, 2.0) / between(0.0, 1.0),
            between(1.0_f64.next_down(), f64::INFINITY)
        );
        assert_eq!(
            between(1.0, 2.0) / between(-1.0, 0.0),
            between(f64::NEG_INFINITY, (-1.0_f64).next_up())
        );
        assert_eq!(between(0.0, 2.0) / between(0.0, 1.0), between(0.0, f64::INFINITY));
        assert!((between(-1.0, 2.0) / between(0.0, 1.0)).is_whole());
        assert!((between(1.0, 2.0) / between(-1.0, 1.0)).is_whole());
        assert!((between(1.0, 2.0) / Line::point(0.0)).is_whole());
    }

    #[test]
    fn overflow_leaves_the_finite_end_finite() {
        let large = Line::point(f64::MAX);
        assert_eq!(large + large, between(f64::MAX, f64::INFINITY));
        assert_eq!(large * large, between(f64::MAX, f64::INFINITY));
        assert!((Line::WHOLE * Line::point(0.0)).contains_zero());
    }

    #[test]
    fn powers_are_tight_and_never_negative_when_even() {
        assert_eq!(between(-1.0, 2.0).square().low(), 0.0);
        assert_eq!(between(-1.0, 2.0).to_power(2).low(), 0.0);
        let cube = between(-1.0, 2.0).to_power(3);
        assert!(cube.contains(&-1.0) && cube.contains(&8.0) && cube.width() < 9.000_000_1);
        assert!(between(2.0, 4.0).to_power(-1).contains(&0.25) && between(-1.0, 1.0).to_power(-2).low() > 0.99);
        let power = Analytic::powf(&between(0.5, 2.0), &between(-1.0, 2.0));
        assert!(power.contains(&4.0) && power.contains(&0.25) && power.width() < 3.750_000_1);
    }

    #[test]
    fn embeds_a_rational_around_its_value() {
        let third = Rational::new(1, 3).unwrap();
        let around: Line = third.embed().unwrap();
        assert!(around.low() < around.high() && around.contains(&(1.0 / 3.0)));
        let big = Rational::from_decimal("123456789012345678901234567890.5").unwrap();
        let around: Line = big.embed().unwrap();
        assert!(around.contains(&123_456_789_012_345_678_901_234_567_890.5) && around.width() < 1e16);
        assert!(Line::from_integer(i64::MAX).width() > 0.0 && Line::from_integer(1 << 53).width() == 0.0);
    }
}
