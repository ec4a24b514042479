//! Exact rationals.

use super::Field;
use dashu_ratio::RBig;
use std::fmt;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A rational number, exact and of any size. Dividing by zero panics: test with `is_zero` first.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rational(pub RBig);

impl Rational {
    /// `numerator / denominator` in lowest terms; `None` where the denominator is 0.
    pub fn new(numerator: i64, denominator: i64) -> Option<Self> {
        (denominator != 0).then(|| Self(RBig::from(numerator) / RBig::from(denominator)))
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

macro_rules! operation {
    ($trait:ident, $method:ident, $assign_trait:ident, $assign:ident) => {
        impl $trait for Rational {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
        impl $assign_trait for Rational {
            fn $assign(&mut self, other: Self) {
                *self = self.clone().$method(other);
            }
        }
    };
}
operation!(Add, add, AddAssign, add_assign);
operation!(Sub, sub, SubAssign, sub_assign);
operation!(Mul, mul, MulAssign, mul_assign);
operation!(Div, div, DivAssign, div_assign);

impl Neg for Rational {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl num_traits::Zero for Rational {
    fn zero() -> Self {
        Self(RBig::ZERO)
    }
    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}

impl num_traits::One for Rational {
    fn one() -> Self {
        Self(RBig::ONE)
    }
}

impl Field for Rational {
    fn from_integer(value: i64) -> Self {
        Self(RBig::from(value))
    }
}
