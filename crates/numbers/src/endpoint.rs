//! Numbers that an interval can end at: each knows how far a result of its own may be from the exact one.

use super::{Analytic, Rung};

/// A number whose rounding has a bound, so that it can be the end of an [`Interval`](super::Interval).
///
/// Let x be what one operation of the type returned: a sum, difference, product or quotient by its operator, a
/// root by `Analytic::sqrt`, pi, a converted integer, or one of the functions below. Then `x.below()` is a lower
/// bound of the exact result and `x.above()` an upper one, overflow and underflow included. A sum that is zero is
/// exactly zero. Of what is no number, these are [`lowest`](Self::lowest) and [`highest`](Self::highest). A
/// comparison with what is no number is false.
pub trait Endpoint: Analytic + PartialOrd {
    /// Whether the type has infinities to end a half line at.
    const INFINITE: bool;
    /// A lower bound of what the operation that gave `self` would give without rounding.
    fn below(&self) -> Self;
    /// An upper bound of what the operation that gave `self` would give without rounding.
    fn above(&self) -> Self;
    /// The end of an interval without a lower bound: minus infinity, or no number where the type has none.
    fn lowest() -> Self;
    /// The end of an interval without an upper bound: infinity, or no number where the type has none.
    fn highest() -> Self;
    /// Whether this is a number, and a finite one.
    fn is_finite(&self) -> bool;
    /// Which number type this is.
    fn rung() -> Rung;

    /// Sine and cosine; the sign of each is right where [`below`](Self::below) and [`above`](Self::above) agree.
    fn bounded_sincos(&self) -> (Self, Self) {
        self.sincos()
    }
    /// The arc cosine on [-1, 1].
    fn bounded_acos(&self) -> Self {
        self.acos()
    }
    /// The angle of the point (`x`, `self`).
    fn bounded_atan2(&self, x: &Self) -> Self {
        self.atan2(x)
    }
    /// A power of a number that is not negative.
    fn bounded_powf(&self, exponent: &Self) -> Self {
        self.powf(exponent)
    }
    /// The exponential.
    fn bounded_exp(&self) -> Self;
    /// The natural logarithm of a positive number.
    fn bounded_ln(&self) -> Self;
}

/// One step to the neighbour. The operations of f64 are rounded to nearest; the functions are those of pxfm,
/// which are correctly rounded (compared with CORE-MATH by its author, with two references in `tests/numbers/intervals.rs`),
/// so that a step is twice what is needed. The standard library's own functions promise no bound.
impl Endpoint for f64 {
    const INFINITE: bool = true;

    #[inline]
    fn below(&self) -> Self {
        let bits = self.to_bits() as i64;
        // one less for a positive number, one more for a negative one: bits of floats are sign and magnitude
        let moved = f64::from_bits(bits.wrapping_sub(bits >> 63 | 1) as u64);
        if *self == 0.0 {
            -TINY
        } else if moved > f64::NEG_INFINITY {
            moved
        } else {
            f64::NEG_INFINITY // also for NaN, and for minus infinity, whose neighbour by bits is NaN
        }
    }

    #[inline]
    fn above(&self) -> Self {
        let bits = self.to_bits() as i64;
        let moved = f64::from_bits(bits.wrapping_add(bits >> 63 | 1) as u64);
        if *self == 0.0 {
            TINY
        } else if moved < f64::INFINITY {
            moved
        } else {
            f64::INFINITY
        }
    }

    #[inline]
    fn lowest() -> Self {
        f64::NEG_INFINITY
    }

    #[inline]
    fn highest() -> Self {
        f64::INFINITY
    }

    #[inline]
    fn is_finite(&self) -> bool {
        f64::is_finite(*self)
    }

    fn rung() -> Rung {
        Rung::Double
    }

    #[inline]
    fn bounded_sincos(&self) -> (Self, Self) {
        pxfm::f_sincos(*self)
    }

    #[inline]
    fn bounded_acos(&self) -> Self {
        pxfm::f_acos(*self)
    }

    #[inline]
    fn bounded_atan2(&self, x: &Self) -> Self {
        pxfm::f_atan2(*self, *x)
    }

    #[inline]
    fn bounded_powf(&self, exponent: &Self) -> Self {
        pxfm::f_pow(*self, *exponent)
    }

    #[inline]
    fn bounded_exp(&self) -> Self {
        pxfm::f_exp(*self)
    }

    #[inline]
    fn bounded_ln(&self) -> Self {
        // within one ulp, not nearest: the only one
        pxfm::f_log(*self)
    }
}

/// One step to the neighbour; the functions are those of f64, rounded once more, which is well within a step.
impl Endpoint for f32 {
    const INFINITE: bool = true;

    fn below(&self) -> Self {
        if self.is_nan() {
            f32::NEG_INFINITY
        } else {
            self.next_down()
        }
    }
    fn above(&self) -> Self {
        if self.is_nan() { f32::INFINITY } else { self.next_up() }
    }
    fn lowest() -> Self {
        f32::NEG_INFINITY
    }
    fn highest() -> Self {
        f32::INFINITY
    }
    fn is_finite(&self) -> bool {
        f32::is_finite(*self)
    }
    fn rung() -> Rung {
        Rung::Single
    }
    fn bounded_sincos(&self) -> (Self, Self) {
        let (sin, cos) = f64::from(*self).bounded_sincos();
        (sin as f32, cos as f32)
    }
    fn bounded_acos(&self) -> Self {
        f64::from(*self).bounded_acos() as f32
    }
    fn bounded_atan2(&self, x: &Self) -> Self {
        f64::from(*self).bounded_atan2(&f64::from(*x)) as f32
    }
    fn bounded_powf(&self, exponent: &Self) -> Self {
        f64::from(*self).bounded_powf(&f64::from(*exponent)) as f32
    }
    fn bounded_exp(&self) -> Self {
        f64::from(*self).bounded_exp() as f32
    }
    fn bounded_ln(&self) -> Self {
        f64::from(*self).bounded_ln() as f32
    }
}

/// The least positive f64.
const TINY: f64 = f64::from_bits(1);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_f32_the_functions_of_f64_lie_within_a_step() {
        for value in [0.1_f32, 1.0, 3.0, -2.5, 6.2] {
            let (sin, cos) = value.bounded_sincos();
            let (fine_sin, fine_cos) = f64::from(value).sin_cos();
            assert!(f64::from(sin.below()) < fine_sin && fine_sin < f64::from(sin.above()));
            assert!(f64::from(cos.below()) < fine_cos && fine_cos < f64::from(cos.above()));
        }
        assert_eq!((f32::NAN.below(), f32::NAN.above()), (f32::NEG_INFINITY, f32::INFINITY));
    }

    #[test]
    fn a_step_is_that_of_the_standard_library() {
        let values = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            TINY,
            -TINY,
            f64::MIN_POSITIVE,
            f64::MAX,
            f64::MIN,
            0.1,
            -3e7,
        ];
        for value in values.into_iter().chain([f64::INFINITY, f64::NEG_INFINITY]) {
            assert_eq!(value.below(), value.next_down(), "below {value}");
            assert_eq!(value.above(), value.next_up(), "above {value}");
        }
        assert_eq!((f64::NAN.below(), f64::NAN.above()), (f64::NEG_INFINITY, f64::INFINITY));
    }
}
