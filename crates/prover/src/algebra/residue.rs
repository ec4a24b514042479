//! Integers modulo the prime 2^61 - 1: a quick sieve for identities, which are then proved over the rationals.

use dashu_int::IBig;
use dashu_ratio::RBig;
use kernel::{Polynomial, Term};
use std::ops::{Add, Mul, Neg, Sub};

/// The prime 2^61 - 1.
pub const MODULUS: u64 = (1 << 61) - 1;

/// An integer modulo [`MODULUS`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Residue(u64);

impl Residue {
    /// The residue class of an integer.
    pub fn new(value: u64) -> Self {
        Self(value % MODULUS)
    }

    /// Its least representative that is not negative.
    pub fn value(self) -> u64 {
        self.0
    }

    /// Whether it is 0.
    pub fn is_zero(self) -> bool {
        self.0 == 0
    }

    /// A power.
    pub fn power(self, mut exponent: u64) -> Self {
        let (mut result, mut base) = (Self(1), self);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = result * base;
            }
            base = base * base;
            exponent >>= 1;
        }
        result
    }

    /// The inverse; `None` of 0.
    pub fn inverse(self) -> Option<Self> {
        // Fermat: a^(p - 2) = 1/a
        (!self.is_zero()).then(|| self.power(MODULUS - 2))
    }

    /// The residue class of an integer of any size.
    pub fn of_integer(value: &IBig) -> Self {
        let modulus = IBig::from(MODULUS);
        let remainder = value % &modulus;
        let positive = if remainder < IBig::ZERO {
            remainder + modulus
        } else {
            remainder
        };
        Self(u64::try_from(positive).unwrap_or(0))
    }

    /// The residue class of a rational; `None` where the prime divides its denominator.
    pub fn of_rational(value: &RBig) -> Option<Self> {
        let numerator = Self::of_integer(value.numerator());
        if value.is_int() {
            return Some(numerator);
        }
        let denominator = Self::of_integer(&IBig::from(value.denominator().clone()));
        Some(numerator * denominator.inverse()?)
    }
}

impl Add for Residue {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        Self(if sum >= MODULUS { sum - MODULUS } else { sum })
    }
}

impl Sub for Residue {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Residue {
    type Output = Self;
    fn neg(self) -> Self {
        Self(if self.0 == 0 { 0 } else { MODULUS - self.0 })
    }
}

impl Mul for Residue {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        // 2^61 = 1: the high part of the product is added to the low part
        let product = u128::from(self.0) * u128::from(other.0);
        let (low, high) = (product as u64 & MODULUS, (product >> 61) as u64);
        let sum = low + high;
        Self(if sum >= MODULUS { sum - MODULUS } else { sum })
    }
}

/// The value of a polynomial modulo [`MODULUS`]; `None` where the prime divides the denominator of a coefficient.
pub fn evaluate_mod(p: &Polynomial, values: &dyn Fn(Term) -> Residue) -> Option<Residue> {
    let mut sum = Residue(0);
    for (monomial, coefficient) in p.terms() {
        let factor = Residue::of_rational(coefficient)?;
        let powers = monomial
            .iter()
            .map(|&(term, exponent)| values(term).power(u64::from(exponent)));
        sum = sum + powers.fold(factor, |product, power| product * power);
    }
    Some(sum)
}
