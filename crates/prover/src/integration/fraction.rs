//! Quotients of polynomials, in lowest terms.

use crate::algebra::{self, Steps, exact_quotient, gcd, power, primitive};
use kernel::{Polynomial, Term};
use num_traits::One;
use numbers::Rational;

/// The steps that a product of terms takes: more than the numbers in them tell.
const PER_TERM: u64 = 6;

/// The product.
pub(super) fn times(a: &Polynomial, b: &Polynomial, steps: &mut Steps) -> algebra::Result<Polynomial> {
    steps.take(PER_TERM * (a.terms().len() * b.terms().len()) as u64)?;
    algebra::times(a, b, steps)
}

/// The steps that a quotient takes at least.
const OVERHEAD: u64 = 20;

/// A quotient in lowest terms; what stands below has integer coefficients without a common factor.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fraction {
    pub above: Polynomial,
    pub below: Polynomial,
}

impl Fraction {
    pub fn of(above: Polynomial) -> Self {
        let below = Polynomial::integer(1);
        Self { above, below }
    }

    pub fn integer(value: i64) -> Self {
        Self::of(Polynomial::integer(value))
    }

    pub fn constant(value: &Rational) -> Self {
        Self::of(Polynomial::constant(value))
    }

    pub fn generator(term: Term) -> Self {
        Self::of(Polynomial::generator(term))
    }

    /// The quotient; `None` where `below` is 0 or the steps do not suffice.
    pub fn new(above: &Polynomial, below: &Polynomial, steps: &mut Steps) -> Option<Self> {
        if below.is_zero() {
            return None;
        }
        steps.take(OVERHEAD).ok()?;
        let (mut above, mut below) = (above.clone(), below.clone());
        if below.as_constant().is_none() {
            let common = gcd(&above, &below, steps).ok()?;
            if common.as_constant().is_none() {
                above = exact_quotient(&above, &common, steps).ok()??;
                below = exact_quotient(&below, &common, steps).ok()??;
            }
        }
        let (content, below) = primitive(&below)?;
        let above = above.scaled(&(Rational::one() / content));
        Some(Self { above, below })
    }

    pub fn is_zero(&self) -> bool {
        self.above.is_zero()
    }

    pub fn as_constant(&self) -> Option<Rational> {
        let below = self.below.as_constant()?;
        Some(self.above.as_constant()? / below)
    }

    pub fn holds(&self, term: Term) -> bool {
        let occurs = |p: &Polynomial| p.generators().contains(&term);
        occurs(&self.above) || occurs(&self.below)
    }

    pub fn generators(&self) -> Vec<Term> {
        let mut all = self.above.generators();
        all.extend(self.below.generators());
        all.sort_unstable();
        all.dedup();
        all
    }

    pub fn plus(&self, other: &Self, steps: &mut Steps) -> Option<Self> {
        if self.below == other.below {
            return Self::new(&self.above.plus(&other.above), &self.below, steps);
        }
        let left = times(&self.above, &other.below, steps).ok()?;
        let right = times(&other.above, &self.below, steps).ok()?;
        Self::new(
            &left.plus(&right),
            &times(&self.below, &other.below, steps).ok()?,
            steps,
        )
    }

    pub fn times(&self, other: &Self, steps: &mut Steps) -> Option<Self> {
        let above = times(&self.above, &other.above, steps).ok()?;
        Self::new(&above, &times(&self.below, &other.below, steps).ok()?, steps)
    }

    pub fn over(&self, other: &Self, steps: &mut Steps) -> Option<Self> {
        let above = times(&self.above, &other.below, steps).ok()?;
        Self::new(&above, &times(&self.below, &other.above, steps).ok()?, steps)
    }

    pub fn scaled(&self, factor: &Rational) -> Self {
        Self {
            above: self.above.scaled(factor),
            below: self.below.clone(),
        }
    }

    pub fn power(&self, exponent: i32, steps: &mut Steps) -> Option<Self> {
        let size = exponent.unsigned_abs();
        let above = power(&self.above, size, steps).ok()?;
        let below = power(&self.below, size, steps).ok()?;
        match exponent < 0 {
            true => Self::new(&below, &above, steps),
            false => Some(Self { above, below }),
        }
    }
}
