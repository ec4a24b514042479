//! Intervals with outward rounding: what is proved about every number between two ends.

mod arithmetic;
mod derivable;
mod functions;

use super::Endpoint;
use arithmetic::{product_above, product_below, sum_above};
use std::fmt;

/// All numbers from `low` to `high`, both included.
///
/// Every operation returns an interval that contains the exact result for all choices of numbers in its operands
/// (inclusion), whatever the rounding; and from a smaller operand that has a result no larger one (monotonicity). An
/// end moves outward by what [`Endpoint`] says, one ulp of f64, and not at all where a product with 0 or a sum of 0 is
/// exact.
///
/// **Where something has no value** (a NaN, a root of negative numbers alone, a division by an interval around 0,
/// overflow in a type without infinities) the result is the whole line: nothing is claimed. An interval is never
/// empty. Numbers outside the domain of a root or an arc cosine are left out where others are inside.
///
/// ```
/// use numbers::{Field, Interval};
/// let tenth = Interval::<f64>::from_ratio(1, 10);
/// assert!(tenth.low() < tenth.high() && tenth.contains(&0.1));
/// assert!(!(tenth - tenth).is_positive() && (tenth - tenth).contains_zero());
/// ```
#[derive(Clone, Copy)]
pub struct Interval<E = f64> {
    low: E,
    high: E,
}

impl Interval<f64> {
    /// Every number.
    pub const WHOLE: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };
}

#[inline]
fn least<E: Endpoint>(a: E, b: E) -> E {
    if b < a { b } else { a }
}

#[inline]
fn greatest<E: Endpoint>(a: E, b: E) -> E {
    if b > a { b } else { a }
}

impl<E: Endpoint> Interval<E> {
    /// From `low` to `high`; the whole line where they are not two numbers in this order.
    #[inline]
    pub fn new(low: E, high: E) -> Self {
        if low <= high && low < E::highest() && high > E::lowest() {
            return Self { low, high };
        }
        Self::checked(low, high)
    }

    /// As `new`, for ends whose type has no infinities to compare with.
    #[cold]
    fn checked(low: E, high: E) -> Self {
        if low <= high && low.is_finite() && high.is_finite() {
            return Self { low, high };
        }
        Self::whole()
    }

    /// From a lower to an upper bound of one result. Infinities that bounds may be are right as they are.
    #[inline]
    fn bounded(low: E, high: E) -> Self {
        if E::INFINITE {
            Self { low, high }
        } else {
            Self::new(low, high)
        }
    }

    /// The one number `value`; the whole line for an infinity or what is no number.
    #[inline]
    pub fn point(value: E) -> Self {
        Self::new(value.clone(), value)
    }

    /// Every number.
    pub fn whole() -> Self {
        Self {
            low: E::lowest(),
            high: E::highest(),
        }
    }

    /// What the operation that returned `value` gives without rounding.
    #[inline]
    fn around(value: &E) -> Self {
        Self::bounded(value.below(), value.above())
    }

    /// The lower end; of the whole line minus infinity, or no number where `E` has none.
    #[inline]
    pub fn low(&self) -> E {
        self.low.clone()
    }

    /// The upper end; of the whole line infinity, or no number where `E` has none.
    #[inline]
    pub fn high(&self) -> E {
        self.high.clone()
    }

    /// Whether both ends are finite.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// Whether this is every number.
    pub fn is_whole(&self) -> bool {
        !self.low.is_finite() && !self.high.is_finite()
    }

    /// A number of the interval, close to its middle; 0 of the whole line, the end of a half line.
    pub fn midpoint(&self) -> E {
        match (self.low.is_finite(), self.high.is_finite()) {
            (false, false) => E::zero(),
            (true, false) => self.low(),
            (false, true) => self.high(),
            (true, true) => {
                // halved first, so that the sum cannot overflow
                let half = E::from_ratio(1, 2);
                let middle = self.low() * half.clone() + self.high() * half;
                least(greatest(middle, self.low()), self.high())
            }
        }
    }

    /// An upper bound of the distance from the midpoint to either end.
    pub fn radius(&self) -> E {
        if !self.is_finite() {
            return E::highest();
        }
        let middle = self.midpoint();
        let below = sum_above(middle.clone(), -self.low());
        greatest(sum_above(self.high(), -middle), below)
    }

    /// An upper bound of the distance between the ends.
    #[inline]
    pub fn width(&self) -> E {
        if !self.is_finite() {
            return E::highest();
        }
        sum_above(self.high(), -self.low())
    }

    /// The largest size of a number in the interval.
    #[inline]
    pub fn magnitude(&self) -> E {
        greatest(-self.low(), self.high())
    }

    /// The least size of a number in the interval.
    #[inline]
    pub fn mignitude(&self) -> E {
        if self.contains_zero() {
            return E::zero();
        }
        greatest(self.low(), -self.high())
    }

    /// Whether `value` is in the interval; what is no number is in the whole line alone.
    #[inline]
    pub fn contains(&self, value: &E) -> bool {
        (self.low <= *value && *value <= self.high) || self.is_whole()
    }

    /// Whether 0 is in the interval.
    #[inline]
    pub fn contains_zero(&self) -> bool {
        !self.is_positive() && !self.is_negative()
    }

    /// Whether every number is above 0.
    #[inline]
    pub fn is_positive(&self) -> bool {
        self.low > E::zero()
    }

    /// Whether every number is below 0.
    #[inline]
    pub fn is_negative(&self) -> bool {
        self.high < E::zero()
    }

    /// Whether every number is strictly between the ends of `other`: the test of Krawczyk and Newton.
    #[inline]
    pub fn is_inside(&self, other: &Self) -> bool {
        let low = other.low < self.low || (!other.low.is_finite() && self.low.is_finite());
        let high = self.high < other.high || (!other.high.is_finite() && self.high.is_finite());
        low && high
    }

    /// Whether every number is in `other`.
    #[inline]
    pub fn is_subset(&self, other: &Self) -> bool {
        (other.low <= self.low && self.high <= other.high) || other.is_whole()
    }

    /// The numbers in both; `None` where there are none.
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        if self.high < other.low || other.high < self.low {
            return None;
        }
        if self.is_whole() {
            return Some(other.clone());
        }
        if other.is_whole() {
            return Some(self.clone());
        }
        let low = greatest(self.low(), other.low());
        let high = least(self.high(), other.high());
        Some(Self::new(low, high))
    }

    /// The least interval that holds both.
    pub fn hull(&self, other: &Self) -> Self {
        if self.is_whole() || other.is_whole() {
            return Self::whole();
        }
        Self::new(least(self.low(), other.low()), greatest(self.high(), other.high()))
    }

    /// The lower and the upper half, which share the midpoint.
    pub fn halves(&self) -> (Self, Self) {
        let middle = self.midpoint();
        let low = Self {
            low: self.low(),
            high: middle.clone(),
        };
        let high = Self {
            low: middle,
            high: self.high(),
        };
        (low, high)
    }

    /// All squares: never below 0, unlike a product of two intervals.
    #[inline]
    pub fn square(&self) -> Self {
        let (least, largest) = (self.mignitude(), self.magnitude());
        let low = greatest(product_below(&least, &least), E::zero());
        Self::bounded(low, product_above(&largest, &largest))
    }

    /// The sizes of all numbers in the interval.
    pub fn size(&self) -> Self {
        if self.is_whole() {
            return Self::whole();
        }
        Self::new(self.mignitude(), self.magnitude())
    }
}

impl<E: Endpoint> PartialEq for Interval<E> {
    /// The same two ends; two whole lines are equal.
    fn eq(&self, other: &Self) -> bool {
        (self.low == other.low && self.high == other.high) || (self.is_whole() && other.is_whole())
    }
}

impl<E: fmt::Display> fmt::Display for Interval<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("[")?;
        self.low.fmt(f)?;
        f.write_str(", ")?;
        self.high.fmt(f)?;
        f.write_str("]")
    }
}

impl<E: fmt::Debug> fmt::Debug for Interval<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "[{:?}, {:?}]", self.low, self.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Analytic;

    type Line = Interval<f64>;

    fn between(low: f64, high: f64) -> Line {
        Line::new(low, high)
    }

    #[test]
    fn what_is_no_interval_is_the_whole_line() {
        for (low, high) in [
            (f64::NAN, 1.0),
            (1.0, f64::NAN),
            (2.0, 1.0),
            (f64::INFINITY, f64::INFINITY),
        ] {
            assert!(between(low, high).is_whole(), "{low} {high}");
        }
        assert!(Line::WHOLE.contains(&f64::NAN) && !between(0.0, 1.0).contains(&f64::NAN));
        assert!(Line::from_f64(f64::INFINITY).is_whole());
    }

    #[test]
    fn parts_and_wholes() {
        let a = between(1.0, 2.0);
        assert_eq!(a.midpoint(), 1.5);
        assert!(a.radius() >= 0.5 && a.radius() < 0.500_000_1 && a.width() >= 1.0);
        let (low, high) = a.halves();
        assert_eq!(low.hull(&high), a);
        assert_eq!(low.intersection(&high), Some(Line::point(1.5)));
        assert!(low.intersection(&between(1.6, 2.0)).is_none());
        assert!(between(1.1, 1.9).is_inside(&a) && !low.is_inside(&a) && low.is_subset(&a));
        assert!(a.is_inside(&Line::WHOLE) && !Line::WHOLE.is_inside(&Line::WHOLE));
        assert_eq!(
            (between(-3.0, 2.0).magnitude(), between(-3.0, 2.0).mignitude()),
            (3.0, 0.0)
        );
        assert_eq!(between(-3.0, -2.0).mignitude(), 2.0);
        assert_eq!(between(5e-324, 5e-324).midpoint(), 5e-324);
    }
}
