//! Polynomials in many variables with integer coefficients.

use super::monomial::{Monomial, Variable};
use crate::number::{Field, Rational};
use dashu_int::IBig;
use dashu_int::ops::BitTest;
use dashu_ratio::RBig;
use num_traits::Zero;
use std::collections::BTreeSet;

/// A sparse polynomial: terms with non-zero coefficients, the largest monomial first.
///
/// One that outgrows the limits below is not kept but marked, as a float that overflows is. What it goes into is
/// marked too, and a marked polynomial is never zero: nothing is proved with it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Polynomial {
    pub(super) terms: Vec<(Monomial, IBig)>,
    pub(super) too_large: bool,
}

/// Products of terms that one multiplication may take: a tenth of a second.
const MOST_PRODUCTS: usize = 400_000;
/// The highest power that is expanded or evaluated, and the bits of a coefficient.
const HIGHEST_POWER: u32 = 20_000;
const MOST_BITS: usize = 200_000;

/// How a polynomial uses a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Usage {
    pub variable: Variable,
    /// Its highest power.
    pub degree: u32,
    /// The number of terms that hold it.
    pub terms: usize,
    /// Whether it stands in no term with another variable.
    pub is_plain: bool,
}

impl Polynomial {
    /// The constant `value`.
    pub fn constant(value: IBig) -> Self {
        Self::term(Monomial::one(), value)
    }

    /// The polynomial that is one variable.
    pub fn variable(variable: Variable) -> Self {
        Self::term(Monomial::power(variable, 1), IBig::ONE)
    }

    /// `coefficient * monomial`.
    pub fn term(monomial: Monomial, coefficient: IBig) -> Self {
        let mut terms = Vec::new();
        if !coefficient.is_zero() {
            terms.push((monomial, coefficient));
        }
        Self {
            terms,
            too_large: false,
        }
    }

    fn oversized() -> Self {
        Self {
            terms: Vec::new(),
            too_large: true,
        }
    }

    /// Whether the limits were passed, so that nothing more is known.
    pub fn is_too_large(&self) -> bool {
        self.too_large
    }

    /// The terms, the largest monomial first.
    pub fn terms(&self) -> &[(Monomial, IBig)] {
        &self.terms
    }

    /// Whether every coefficient is zero.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty() && !self.too_large
    }

    /// The value of a constant polynomial.
    pub fn as_constant(&self) -> Option<IBig> {
        match self.terms.as_slice() {
            [] => (!self.too_large).then_some(IBig::ZERO),
            [(monomial, coefficient)] if monomial.is_one() => Some(coefficient.clone()),
            _ => None,
        }
    }

    /// Whether this is the constant one.
    pub fn is_one(&self) -> bool {
        matches!(self.terms.as_slice(), [(m, c)] if m.is_one() && *c == IBig::ONE)
    }

    /// Every variable that occurs.
    pub fn variables(&self) -> BTreeSet<Variable> {
        self.terms
            .iter()
            .flat_map(|(m, _)| m.factors().iter().map(|(v, _)| *v))
            .collect()
    }

    /// How each variable is used.
    pub fn uses(&self) -> Vec<Usage> {
        let mut uses: Vec<Usage> = Vec::new();
        for (monomial, _) in &self.terms {
            let is_alone = monomial.factors().len() == 1;
            for &(variable, exponent) in monomial.factors() {
                match uses.iter_mut().find(|usage| usage.variable == variable) {
                    Some(usage) => {
                        usage.degree = usage.degree.max(exponent);
                        usage.terms += 1;
                        usage.is_plain &= is_alone;
                    }
                    None => uses.push(Usage {
                        variable,
                        degree: exponent,
                        terms: 1,
                        is_plain: is_alone,
                    }),
                }
            }
        }
        uses
    }

    /// Whether `variable` occurs.
    pub fn contains(&self, variable: Variable) -> bool {
        self.terms.iter().any(|(m, _)| m.exponent(variable) > 0)
    }

    /// The highest power of `variable`.
    pub fn degree(&self, variable: Variable) -> u32 {
        self.terms.iter().map(|(m, _)| m.exponent(variable)).max().unwrap_or(0)
    }

    /// The coefficients of the powers of `variable`, from the power 0 up.
    pub fn coefficients(&self, variable: Variable) -> Vec<Self> {
        if self.too_large {
            return vec![Self::oversized()];
        }
        let mut by_power = vec![Self::default(); self.degree(variable) as usize + 1];
        for (monomial, coefficient) in &self.terms {
            // Taking the same variable out of monomials of one power leaves their order as it was.
            if let Some(power) = by_power.get_mut(monomial.exponent(variable) as usize) {
                power.terms.push((monomial.without(variable), coefficient.clone()));
            }
        }
        by_power
    }

    /// The partial derivative by `variable`, all others held.
    pub fn derivative(&self, variable: Variable) -> Self {
        if self.too_large {
            return Self::oversized();
        }
        let one = Monomial::power(variable, 1);
        Self::collect(
            self.terms
                .iter()
                .filter_map(|(m, c)| Some((m.over(&one)?, c * IBig::from(m.exponent(variable)))))
                .collect(),
        )
    }

    /// The sum.
    pub fn plus(&self, other: &Self) -> Self {
        self.merge(other, false)
    }

    /// The difference.
    pub fn minus(&self, other: &Self) -> Self {
        self.merge(other, true)
    }

    /// The polynomial with all signs changed.
    pub fn negated(&self) -> Self {
        self.scaled(&IBig::NEG_ONE)
    }

    /// The product with an integer.
    pub fn scaled(&self, factor: &IBig) -> Self {
        if factor.is_zero() {
            return Self::default();
        }
        Self {
            terms: self.terms.iter().map(|(m, c)| (m.clone(), c * factor)).collect(),
            too_large: self.too_large,
        }
    }

    /// The product.
    pub fn times(&self, other: &Self) -> Self {
        if other.is_one() {
            return self.clone();
        }
        if self.is_zero() || other.is_zero() {
            return Self::default();
        }
        let bits = |p: &Self| p.terms.first().map_or(0, |(_, c)| c.bit_len());
        let products = self.terms.len().saturating_mul(other.terms.len());
        if self.too_large || other.too_large || products > MOST_PRODUCTS || bits(self) + bits(other) > MOST_BITS {
            return Self::oversized();
        }
        match (self.terms.as_slice(), other.terms.as_slice()) {
            ([term], many) | (many, [term]) => Self {
                terms: many.iter().map(|(m, c)| (m.times(&term.0), c * &term.1)).collect(),
                too_large: false,
            },
            (left, right) => {
                let mut products = Vec::with_capacity(left.len() * right.len());
                for (m, c) in left {
                    products.extend(right.iter().map(|(n, e)| (m.times(n), c * e)));
                }
                Self::collect(products)
            }
        }
    }

    /// The power, by squaring.
    pub fn to_power(&self, exponent: u32) -> Self {
        let highest = self.uses().iter().map(|usage| usage.degree).max().unwrap_or(0);
        if highest.saturating_mul(exponent) > HIGHEST_POWER {
            return Self::oversized();
        }
        let mut result = Self::constant(IBig::ONE);
        for bit in (0..u32::BITS - exponent.leading_zeros()).rev() {
            result = result.times(&result);
            if exponent >> bit & 1 == 1 {
                result = result.times(self);
            }
        }
        result
    }

    /// The value where every variable has one, `None` where one has none or a power is too high.
    pub fn evaluate(&self, value: &impl Fn(Variable) -> Option<Rational>) -> Option<Rational> {
        if self.too_large {
            return None;
        }
        let mut sum = Rational::zero();
        for (monomial, coefficient) in &self.terms {
            let mut product = Rational(RBig::from(coefficient.clone()));
            for &(variable, exponent) in monomial.factors() {
                if exponent > HIGHEST_POWER {
                    return None;
                }
                product *= value(variable)?.to_power(exponent as i32);
            }
            sum += product;
        }
        Some(sum)
    }

    /// Sorts terms and joins those of one monomial.
    fn collect(mut terms: Vec<(Monomial, IBig)>) -> Self {
        terms.sort_unstable_by(|a, b| b.0.cmp(&a.0));
        let mut joined: Vec<(Monomial, IBig)> = Vec::with_capacity(terms.len());
        for (monomial, coefficient) in terms {
            match joined.last_mut() {
                Some((last, sum)) if *last == monomial => *sum += coefficient,
                _ => joined.push((monomial, coefficient)),
            }
        }
        joined.retain(|(_, c)| !c.is_zero());
        Self {
            terms: joined,
            too_large: false,
        }
    }

    fn merge(&self, other: &Self, subtract: bool) -> Self {
        if self.too_large || other.too_large {
            return Self::oversized();
        }
        let signed = |c: &IBig| if subtract { -c } else { c.clone() };
        let mut terms = Vec::with_capacity(self.terms.len() + other.terms.len());
        let (mut left, mut right) = (self.terms.iter().peekable(), other.terms.iter().peekable());
        loop {
            match (left.peek(), right.peek()) {
                (None, None) => {
                    return Self {
                        terms,
                        too_large: false,
                    };
                }
                (Some((m, c)), Some((n, e))) if m == n => {
                    let sum = c + signed(e);
                    if !sum.is_zero() {
                        terms.push((m.clone(), sum));
                    }
                    left.next();
                    right.next();
                }
                (Some((m, c)), next) if next.is_none_or(|(n, _)| m > n) => {
                    terms.push((m.clone(), c.clone()));
                    left.next();
                }
                (_, Some((n, e))) => {
                    terms.push((n.clone(), signed(e)));
                    right.next();
                }
                (Some(_), None) => {
                    return Self {
                        terms,
                        too_large: false,
                    };
                }
            }
        }
    }
}

impl From<i64> for Polynomial {
    fn from(value: i64) -> Self {
        Self::constant(IBig::from(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn x(n: u32) -> Polynomial {
        Polynomial::variable(Variable(n))
    }

    #[test]
    fn a_cube_equals_three_products_and_expands_to_four_terms() {
        let sum = x(0).plus(&x(1));
        assert_eq!(sum.to_power(3), sum.times(&sum).times(&sum));
        assert_eq!(sum.to_power(3).terms().len(), 4);
        assert!(sum.to_power(0).is_one());
    }

    #[test]
    fn what_outgrows_the_limits_is_never_zero() {
        let sum = (0..30).fold(Polynomial::from(1), |sum, n| sum.plus(&x(n)));
        let huge = sum.to_power(40);
        assert!(huge.is_too_large() && !huge.minus(&huge).is_zero());
        assert!(huge.times(&Polynomial::default()).is_zero());
        assert!(x(0).to_power(100_000).is_too_large());
        let number = (0..40).fold(Polynomial::from(3), |n, _| n.times(&n));
        assert!(number.is_too_large());
    }

    #[test]
    fn the_derivative_of_a_product_obeys_leibniz() {
        let (a, b) = (
            x(0).to_power(2).plus(&x(1)),
            x(0).times(&x(1)).minus(&Polynomial::from(5)),
        );
        let v = Variable(0);
        let leibniz = a.derivative(v).times(&b).plus(&a.times(&b.derivative(v)));
        assert_eq!(a.times(&b).derivative(v), leibniz);
    }

    #[test]
    fn coefficients_put_together_again_give_the_polynomial() {
        let p = x(0).plus(&x(1)).to_power(3).plus(&x(2));
        let again = p
            .coefficients(Variable(1))
            .iter()
            .enumerate()
            .fold(Polynomial::default(), |sum, (n, c)| {
                sum.plus(&c.times(&x(1).to_power(n as u32)))
            });
        assert_eq!(again, p);
    }

    #[test]
    fn the_value_of_a_polynomial_is_exact() {
        let p = x(0).to_power(2).minus(&Polynomial::from(2));
        let value = p.evaluate(&|_| Rational::new(3, 2));
        assert_eq!(value, Some(Rational::from_ratio(1, 4)));
        assert_eq!(p.evaluate(&|_| None), None);
    }
}
