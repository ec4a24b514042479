#![doc = include_str!("../README.md")]
//!
//! ## The traits
//!
//! [`Field`] is what an algebraic formula needs, [`Analytic`] what the motion of the capsule needs on top.
//! One file per number type. Names stay apart from those of num-dual's `DualNum` (`sincos`, not `sin_cos`),
//! because both traits are often in scope.

// Library code never panics by its own word: errors are returned.
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::todo,
        clippy::unimplemented,
        clippy::unreachable
    )
)]

use std::fmt;
use std::ops::{AddAssign, DivAssign, MulAssign, Neg, SubAssign};
use std::ops::{Div, Sub};

/// A field: the four operations and the integers.
///
/// Addition and multiplication come through `num_traits::{Zero, One}`, and the rest is what a scalar of nalgebra is, so that
/// its matrices work over every `Field`. Dividing by zero is the caller's to rule out (`is_zero`): floats answer with an infinity or
/// NaN, exact types panic.
pub trait Field:
    Clone
    + PartialEq
    + fmt::Debug
    + 'static
    + num_traits::Zero
    + num_traits::One
    + Sub<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// The integer `value`, exactly where the type can hold it, else rounded once.
    fn from_integer(value: i64) -> Self;

    /// `numerator / denominator`, rounded as a division of the type is. `denominator` must not be 0.
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        Self::from_integer(numerator) / Self::from_integer(denominator)
    }

    /// `self` to an integer power, by squaring; a negative power divides one by the positive one.
    fn to_power(&self, exponent: i32) -> Self {
        let mut result = Self::one();
        let mut square = self.clone();
        let mut left = exponent.unsigned_abs();
        while left > 0 {
            if left & 1 == 1 {
                result *= square.clone();
            }
            left >>= 1;
            if left > 0 {
                square = square.clone() * square;
            }
        }
        if exponent < 0 { Self::one() / result } else { result }
    }
}

/// A field with the functions that flights under a harmonic forcing need.
pub trait Analytic: Field {
    /// The circle constant, to the full precision of the type.
    fn pi() -> Self;
    /// The square root of a number that is not negative; of a negative one, NaN where the type has it.
    fn sqrt(&self) -> Self;
    /// Sine and cosine, in this order.
    fn sincos(&self) -> (Self, Self);
    /// The angle in [0, pi] whose cosine is `self`, for `self` in [-1, 1].
    fn acos(&self) -> Self;
    /// The angle in (-pi, pi] of the point (`x`, `self`).
    fn atan2(&self, x: &Self) -> Self;
    /// `self` to a real power, for positive `self`.
    fn powf(&self, exponent: &Self) -> Self;
    /// `value` exactly, where the type is at least as wide as f64.
    fn from_f64(value: f64) -> Self;
    /// The nearest f64 to the value (of a dual number: to its real part).
    fn to_f64(&self) -> f64;

    /// A constant of which only is known that it lies in [-1, 1]: all of that for intervals, 0 for numbers. It bounds what is
    /// cut off a series.
    fn unit() -> Self {
        Self::zero()
    }

    /// The value alone: what a dual number carries beside its real part is dropped, at every depth.
    ///
    /// A root is bracketed on values; derivatives follow afterwards from the implicit function theorem.
    fn constant(&self) -> Self {
        self.clone()
    }

    /// The distance from 1 to the next number of the type, by Kahan's 3 (4/3 - 1) - 1, which a type that rounds
    /// as IEEE 754 does misses by exactly that much (Kahan, "Paranoia", 1983).
    fn epsilon() -> Self {
        let third = Self::from_ratio(4, 3) - Self::one();
        let missed = Self::from_integer(3) * third - Self::one();
        if missed.to_f64() < 0.0 { -missed } else { missed }
    }
}

// its macros are those of the modules below
#[macro_use]
mod derivable;

mod any;
mod counted;
mod decimal;
mod double_double;
mod dual;
mod endpoint;
mod error_free;
mod gradient;
mod interval;
mod machine;
mod rational;
mod real;
mod rung;
mod sequence;
mod telling;
mod wide;

pub use num_dual;
pub use num_traits;

pub use any::{Any, of_type};
pub use counted::{Counted, Counts};
pub use double_double::DoubleDouble;
pub use dual::{Dual, seeded};
pub use endpoint::Endpoint;
pub use gradient::Gradient;
pub use interval::Interval;
pub use machine::{AtRung, Machine};
pub use rational::Rational;
pub use rung::Rung;
pub use sequence::{Sequence, mix};
pub use telling::{Decimal, Decimals, Doubles, FIGURES_OF_F64, Supported, Telling, Told};
pub use wide::{Digits, Wide, at_digits};
