//! How far a result in many digits may be from the exact one.

use super::Wide;
use crate::derivable::Elementary;
use crate::{Endpoint, Rung};
use dashu_float::Repr;

/// The power of two that an end is moved by from 0, which results are alone where they are exact. It leaves room for
/// products of some such ends before these are invalid.
const SMALLEST_EXPONENT: isize = -(1 << 21);

/// By four times the bound of rounding to nearest: dashu rounds operations and functions so, in all cases tried, and
/// moving an end is rounded once more. There is no infinity: an interval that has lost an end is the whole line.
impl<const DIGITS: usize> Endpoint for Wide<DIGITS> {
    const INFINITE: bool = false;

    fn below(&self) -> Self {
        self.moved(-1)
    }

    fn above(&self) -> Self {
        self.moved(1)
    }

    fn lowest() -> Self {
        Self::INVALID
    }

    fn highest() -> Self {
        Self::INVALID
    }

    fn is_finite(&self) -> bool {
        self.is_valid()
    }

    fn rung() -> Rung {
        Rung::Wide(u32::try_from(Self::digits()).unwrap_or(u32::MAX))
    }

    fn bounded_exp(&self) -> Self {
        self.elementary(Elementary::Exp)
    }

    fn bounded_ln(&self) -> Self {
        self.elementary(Elementary::Ln)
    }
}

impl<const DIGITS: usize> Wide<DIGITS> {
    /// By 2^(2 - bits) of its size, in a direction.
    fn moved(&self, direction: i8) -> Self {
        let Some(big) = &self.0 else {
            return Self::INVALID;
        };
        let step = if num_traits::Zero::is_zero(self) {
            Repr::new(direction.into(), SMALLEST_EXPONENT)
        } else {
            let repr = big.repr();
            let bits = isize::try_from(Self::context().precision()).unwrap_or(isize::MAX);
            let outward = if (*big > super::Big::ZERO) == (direction > 0) {
                1
            } else {
                -1
            };
            let Some(exponent) = repr.exponent().checked_sub(bits - 2) else {
                return Self::INVALID;
            };
            Repr::new(repr.significand() * outward, exponent)
        };
        self.clone() + Self::from_repr(step)
    }
}
