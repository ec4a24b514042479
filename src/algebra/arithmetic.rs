//! The field operations of rational functions.

use super::fraction::Fraction;
use super::polynomial::Polynomial;
use crate::number::Field;
use dashu_int::IBig;
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

impl Add for Fraction {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, false)
    }
}

impl Sub for Fraction {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.combine(other, true)
    }
}

impl Mul for Fraction {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let mut product = Self {
            numerator: self.numerator.times(&other.numerator),
            ..self
        };
        product.scale *= other.scale;
        for (factor, power) in other.factors {
            product.push_factor(factor, power);
        }
        product.reduce();
        product
    }
}

impl Div for Fraction {
    type Output = Self;
    /// Dividing by the zero function gives the zero function; rule it out with `is_zero` first.
    fn div(self, other: Self) -> Self {
        let mut quotient = Self {
            numerator: self.numerator.scaled(&IBig::from(other.scale)),
            ..self
        };
        quotient.divide_by(&other.numerator);
        other.factors.into_iter().fold(quotient, |product, (factor, power)| {
            product * Self::from(factor.to_power(power))
        })
    }
}

impl Neg for Fraction {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            numerator: self.numerator.negated(),
            ..self
        }
    }
}

macro_rules! assign {
    ($trait:ident, $method:ident, $operation:ident) => {
        impl $trait for Fraction {
            fn $method(&mut self, other: Self) {
                *self = std::mem::replace(self, Self::zero()).$operation(other);
            }
        }
    };
}

assign!(AddAssign, add_assign, add);
assign!(SubAssign, sub_assign, sub);
assign!(MulAssign, mul_assign, mul);
assign!(DivAssign, div_assign, div);

impl Zero for Fraction {
    fn zero() -> Self {
        Self::from(Polynomial::default())
    }
    fn is_zero(&self) -> bool {
        self.numerator.is_zero()
    }
}

impl One for Fraction {
    fn one() -> Self {
        Self::from(Polynomial::from(1))
    }
}

impl Field for Fraction {
    fn from_integer(value: i64) -> Self {
        Self::from(Polynomial::from(value))
    }
}
