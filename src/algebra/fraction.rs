//! Rational functions: a numerator over a product of named factors.
//!
//! The denominator is kept as factors, because the formulas of a motion divide by the same few velocities again and
//! again: a common denominator is then a matter of comparing factors, and no greatest common divisor is needed.
//! Two equal functions may be written differently; only the test for zero is a normal form, and equality uses it.

use super::monomial::{Monomial, Variable};
use super::polynomial::Polynomial;
use crate::number::{Field, Rational};
use dashu_int::ops::{Gcd, UnsignedAbs};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use num_traits::Zero;

/// A denominator vanishes identically.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a denominator is zero everywhere")]
pub struct Undefined;

/// `numerator / (scale * product of factor^power)`; the factors are primitive, not constant and sorted.
#[derive(Clone, Debug)]
pub struct Fraction {
    pub(super) numerator: Polynomial,
    pub(super) scale: UBig,
    pub(super) factors: Vec<(Polynomial, u32)>,
}

impl Fraction {
    /// The function that is one variable.
    pub fn variable(variable: Variable) -> Self {
        Self::from(Polynomial::variable(variable))
    }

    /// The polynomial above the line. The function is zero exactly where this is the zero polynomial.
    pub fn numerator(&self) -> &Polynomial {
        &self.numerator
    }

    /// The polynomials below the line with their powers, without the integer.
    pub fn factors(&self) -> &[(Polynomial, u32)] {
        &self.factors
    }

    /// The whole denominator, multiplied out.
    pub fn denominator(&self) -> Polynomial {
        self.factors.iter().fold(
            Polynomial::constant(IBig::from(self.scale.clone())),
            |product, (f, e)| product.times(&f.to_power(*e)),
        )
    }

    /// The value of a constant function.
    pub fn as_constant(&self) -> Option<Rational> {
        if !self.factors.is_empty() {
            return self.numerator.is_zero().then(Rational::zero);
        }
        let numerator = self.numerator.as_constant()?;
        Some(Rational(RBig::from_parts(numerator, self.scale.clone())))
    }

    /// Whether both are written alike. Functions without factors below the line are, where they are equal.
    pub fn has_form_of(&self, other: &Self) -> bool {
        self.numerator == other.numerator && self.scale == other.scale && self.factors == other.factors
    }

    /// Whether `variable` occurs, above or below the line.
    pub fn contains(&self, variable: Variable) -> bool {
        self.numerator.contains(variable) || self.factors.iter().any(|(f, _)| f.contains(variable))
    }

    /// Every variable that occurs, above or below the line.
    pub fn variables(&self) -> std::collections::BTreeSet<Variable> {
        let mut all = self.numerator.variables();
        for (factor, _) in &self.factors {
            all.extend(factor.variables());
        }
        all
    }

    /// The function with `value` for `variable`.
    ///
    /// # Errors
    /// [`Undefined`] where that makes a denominator zero everywhere.
    pub fn substituted(&self, variable: Variable, value: &Self) -> Result<Self, Undefined> {
        if !self.contains(variable) {
            return Ok(self.clone());
        }
        let mut result = insert(&self.numerator, variable, value);
        result /= Self::from(Polynomial::constant(IBig::from(self.scale.clone())));
        for (factor, power) in &self.factors {
            let factor = insert(factor, variable, value);
            if factor.is_zero() {
                return Err(Undefined);
            }
            for _ in 0..*power {
                result /= factor.clone();
            }
        }
        Ok(result)
    }

    /// The value at a point; `Ok(None)` where a variable has no value.
    ///
    /// # Errors
    /// [`Undefined`] where a denominator vanishes at the point.
    pub fn evaluate(&self, value: &impl Fn(Variable) -> Option<Rational>) -> Result<Option<Rational>, Undefined> {
        let mut denominator = Rational(RBig::from(self.scale.clone()));
        for (factor, power) in &self.factors {
            let Some(factor) = factor.evaluate(value) else {
                return Ok(None);
            };
            denominator *= factor.to_power(*power as i32);
        }
        if denominator.is_zero() {
            return Err(Undefined);
        }
        Ok(self.numerator.evaluate(value).map(|n| n / denominator))
    }

    /// Puts the polynomial `below` under the line: its integer, its variables and the factors already known apart.
    pub(super) fn divide_by(&mut self, below: &Polynomial) {
        if below.is_too_large() {
            self.numerator = below.clone();
            return;
        }
        let content = below.content();
        if content < IBig::ZERO {
            self.numerator = self.numerator.negated();
        }
        self.scale *= content.clone().unsigned_abs();
        let monomial = below.common_monomial();
        for &(variable, exponent) in monomial.factors() {
            self.push_factor(Polynomial::variable(variable), exponent);
        }
        let mut rest = below.reduced(&content, &monomial);
        for known in self.factors.iter().map(|(f, _)| f.clone()).collect::<Vec<_>>() {
            while let Some(quotient) = rest.exact_quotient(&known) {
                self.push_factor(known.clone(), 1);
                rest = quotient;
            }
        }
        if rest.as_constant().is_none() {
            self.push_factor(rest, 1);
        }
        self.reduce();
    }

    pub(super) fn push_factor(&mut self, factor: Polynomial, power: u32) {
        match self.factors.binary_search_by(|(f, _)| f.cmp(&factor)) {
            Ok(at) => self.factors[at].1 += power,
            Err(at) => self.factors.insert(at, (factor, power)),
        }
    }

    /// Cancels each factor of the denominator that divides the numerator, and the common integer.
    pub(super) fn reduce(&mut self) {
        if self.numerator.is_zero() {
            self.scale = UBig::ONE;
            self.factors.clear();
            return;
        }
        let numerator = &mut self.numerator;
        self.factors.retain_mut(|(factor, power)| {
            while *power > 0 {
                let Some(quotient) = numerator.exact_quotient(factor) else {
                    break;
                };
                *numerator = quotient;
                *power -= 1;
            }
            *power > 0
        });
        if self.scale != UBig::ONE {
            let common = self.numerator.content().unsigned_abs().gcd(&self.scale);
            self.numerator = self.numerator.reduced(&IBig::from(common.clone()), &Monomial::one());
            self.scale /= common;
        }
    }

    pub(super) fn combine(self, other: Self, subtract: bool) -> Self {
        let right = if subtract {
            other.numerator.negated()
        } else {
            other.numerator.clone()
        };
        if self.factors == other.factors && self.scale == other.scale {
            let mut sum = Self {
                numerator: self.numerator.plus(&right),
                ..self
            };
            sum.reduce();
            return sum;
        }
        let mut common = self.clone();
        for (factor, power) in &other.factors {
            let have = power_of(&self.factors, factor);
            common.push_factor(factor.clone(), power.saturating_sub(have));
        }
        let shared = (&self.scale).gcd(&other.scale);
        common.scale = &self.scale / shared * &other.scale;
        let lifted = |part: &Self, numerator: &Polynomial| {
            let start = numerator.scaled(&IBig::from(&common.scale / &part.scale));
            common.factors.iter().fold(start, |product, (factor, power)| {
                match power - power_of(&part.factors, factor) {
                    0 => product,
                    missing => product.times(&factor.to_power(missing)),
                }
            })
        };
        let numerator = lifted(&self, &self.numerator).plus(&lifted(&other, &right));
        let mut sum = Self { numerator, ..common };
        sum.reduce();
        sum
    }
}

fn power_of(factors: &[(Polynomial, u32)], factor: &Polynomial) -> u32 {
    factors.iter().find(|(f, _)| f == factor).map_or(0, |(_, e)| *e)
}

/// The polynomial with `value` for `variable`: `sum c_i n^i d^(top - i) / d^top` for `value = n/d`.
fn insert(polynomial: &Polynomial, variable: Variable, value: &Fraction) -> Fraction {
    let coefficients = polynomial.coefficients(variable);
    let top = coefficients.len() - 1;
    if top == 0 {
        return Fraction::from(polynomial.clone());
    }
    let below = value.denominator();
    let mut numerator = Polynomial::default();
    let mut powers_below = vec![Polynomial::from(1)];
    for i in 0..top {
        powers_below.push(powers_below[i].times(&below));
    }
    let mut power_above = Polynomial::from(1);
    for (i, coefficient) in coefficients.iter().enumerate() {
        numerator = numerator.plus(&coefficient.times(&power_above).times(&powers_below[top - i]));
        power_above = power_above.times(&value.numerator);
    }
    let mut result = Fraction {
        numerator,
        scale: value.scale.clone().pow(top),
        factors: value.factors.iter().map(|(f, e)| (f.clone(), e * top as u32)).collect(),
    };
    result.reduce();
    result
}

impl From<Polynomial> for Fraction {
    fn from(numerator: Polynomial) -> Self {
        Self {
            numerator,
            scale: UBig::ONE,
            factors: Vec::new(),
        }
    }
}

impl From<&Rational> for Fraction {
    fn from(value: &Rational) -> Self {
        Self {
            numerator: Polynomial::constant(value.0.numerator().clone()),
            scale: value.0.denominator().clone(),
            factors: Vec::new(),
        }
    }
}

impl PartialEq for Fraction {
    fn eq(&self, other: &Self) -> bool {
        (self.clone() - other.clone()).is_zero()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Field;
    use num_traits::One;

    fn x(n: u32) -> Fraction {
        Fraction::variable(Variable(n))
    }

    #[test]
    fn a_difference_of_squares_over_a_factor_is_the_other_factor() {
        let square = x(0).to_power(2) - x(1).to_power(2);
        let quotient = square / (x(0) - x(1));
        assert_eq!(quotient, x(0) + x(1));
        assert!(quotient.factors().is_empty());
    }

    #[test]
    fn one_over_a_difference_and_over_its_negative_cancel() {
        let one = Fraction::one();
        let sum = one.clone() / (x(0) - x(1)) + one / (x(1) - x(0));
        assert!(sum.is_zero() && sum.factors().is_empty());
    }

    #[test]
    fn substitution_commutes_with_arithmetic() {
        let value = (x(2) + Fraction::from_integer(1)) / x(3);
        let f = x(0) * x(0) / (x(0) + x(1)) + Fraction::from_ratio(1, 3);
        let expected = value.clone() * value.clone() / (value.clone() + x(1)) + Fraction::from_ratio(1, 3);
        assert_eq!(f.substituted(Variable(0), &value), Ok(expected));
    }

    #[test]
    fn a_denominator_that_vanishes_is_an_error_and_not_a_number() {
        let f = Fraction::one() / (x(0) - x(1));
        assert_eq!(f.substituted(Variable(0), &x(1)), Err(Undefined));
        assert_eq!(f.evaluate(&|_| Some(Rational::one())), Err(Undefined));
    }

    #[test]
    fn fractions_of_integers_are_the_rationals() {
        let sum = Fraction::from_ratio(1, 6) + Fraction::from_ratio(1, 10) - Fraction::from_ratio(4, 15);
        assert!(sum.is_zero());
        assert_eq!(Fraction::from_ratio(-6, 4).as_constant(), Rational::new(-3, 2));
    }
}
