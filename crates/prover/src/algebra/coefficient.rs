//! The coefficients of working polynomials: integers without common factor, or residues.

use super::residue::Residue;
use dashu_int::IBig;
use dashu_int::ops::{BitTest, Gcd};
use dashu_ratio::RBig;

/// A coefficient of a working polynomial.
pub(super) trait Coefficient: Clone + PartialEq {
    /// The field of its quotients.
    type Fraction: Clone;
    /// 1 in the field of quotients.
    fn one() -> Self::Fraction;
    fn is_zero(&self) -> bool;
    /// Whether multiplying by it changes nothing.
    fn is_one(&self) -> bool;
    /// `self * by`
    fn times(&self, by: &Self) -> Self;
    /// `self - a b`
    fn subtract_product(&mut self, a: &Self, b: &Self);
    fn negated(&self) -> Self;
    /// `(a, b)`, as small as possible, such that `a self = b lead`.
    fn cancel(&self, lead: &Self) -> (Self, Self);
    /// `self / scale`
    fn over(&self, scale: &Self::Fraction) -> Self::Fraction;
    /// `fraction * self`
    fn scale(&self, fraction: &Self::Fraction) -> Self::Fraction;
    /// `fraction / self`
    fn unscale(&self, fraction: &Self::Fraction) -> Self::Fraction;
    /// The number that makes these coefficients, the leading one first, the simplest when divided by it.
    fn content<'a>(coefficients: impl Iterator<Item = &'a Self>) -> Option<Self>
    where
        Self: 'a;
    /// The exact quotient by a content.
    fn divide(&mut self, content: &Self);
    /// How many steps an operation with it takes.
    fn cost(&self) -> u64;
}

impl Coefficient for IBig {
    type Fraction = RBig;
    fn one() -> RBig {
        RBig::ONE
    }
    fn is_zero(&self) -> bool {
        IBig::is_zero(self)
    }
    fn is_one(&self) -> bool {
        IBig::is_one(self)
    }
    fn times(&self, by: &Self) -> Self {
        self * by
    }
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        *self -= a * b;
    }
    fn negated(&self) -> Self {
        -self
    }
    fn cancel(&self, lead: &Self) -> (Self, Self) {
        if lead.is_one() {
            return (IBig::ONE, self.clone());
        }
        let common = IBig::from(self.gcd(lead));
        let (factor, multiple) = (lead / &common, self / &common);
        if factor < IBig::ZERO {
            (-factor, -multiple)
        } else {
            (factor, multiple)
        }
    }
    fn over(&self, scale: &RBig) -> RBig {
        RBig::from(self.clone()) / scale
    }
    fn scale(&self, fraction: &RBig) -> RBig {
        fraction * self
    }
    fn unscale(&self, fraction: &RBig) -> RBig {
        fraction / self
    }
    fn content<'a>(coefficients: impl Iterator<Item = &'a Self>) -> Option<Self> {
        let (mut common, mut negative) = (None::<IBig>, false);
        for coefficient in coefficients {
            match &common {
                None => {
                    negative = *coefficient < IBig::ZERO;
                    common = Some(if negative { -coefficient } else { coefficient.clone() });
                }
                Some(known) if known.is_one() => break,
                Some(known) => common = Some(IBig::from(known.gcd(coefficient))),
            }
        }
        common.map(|content| if negative { -content } else { content })
    }
    fn divide(&mut self, content: &Self) {
        *self /= content;
    }
    fn cost(&self) -> u64 {
        1 + BitTest::bit_len(self) as u64 / 64
    }
}

impl Coefficient for Residue {
    type Fraction = Residue;
    fn one() -> Residue {
        Residue::new(1)
    }
    fn is_zero(&self) -> bool {
        Residue::is_zero(*self)
    }
    fn is_one(&self) -> bool {
        self.value() == 1
    }
    fn times(&self, by: &Self) -> Self {
        *self * *by
    }
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        *self = *self - *a * *b;
    }
    fn negated(&self) -> Self {
        -*self
    }
    fn cancel(&self, lead: &Self) -> (Self, Self) {
        if lead.value() == 1 {
            return (Residue::new(1), *self);
        }
        (Residue::new(1), *self * lead.inverse().unwrap_or_default())
    }
    fn over(&self, scale: &Residue) -> Residue {
        if scale.value() == 1 {
            *self
        } else {
            *self * scale.inverse().unwrap_or_default()
        }
    }
    fn scale(&self, fraction: &Residue) -> Residue {
        *fraction * *self
    }
    fn unscale(&self, fraction: &Residue) -> Residue {
        *fraction * self.inverse().unwrap_or_default()
    }
    fn content<'a>(mut coefficients: impl Iterator<Item = &'a Self>) -> Option<Self> {
        coefficients.next().copied()
    }
    fn divide(&mut self, content: &Self) {
        *self = *self * content.inverse().unwrap_or_default();
    }
    fn cost(&self) -> u64 {
        1
    }
}
