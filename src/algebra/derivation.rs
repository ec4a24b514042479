//! Derivations: sums, products and quotients by Leibniz, once it is said what the derivative of each variable is.

use super::fraction::Fraction;
use super::monomial::Variable;
use super::polynomial::Polynomial;
use num_traits::Zero;

/// A derivation of the rational functions, given by its values on the variables.
pub struct Derivation<F: FnMut(Variable) -> Fraction> {
    of_variable: F,
}

impl<F: FnMut(Variable) -> Fraction> Derivation<F> {
    /// The derivation that takes each variable to `of_variable` of it (zero for a constant).
    pub fn new(of_variable: F) -> Self {
        Self { of_variable }
    }

    /// The derivative of a polynomial.
    pub fn of_polynomial(&mut self, polynomial: &Polynomial) -> Fraction {
        polynomial
            .variables()
            .into_iter()
            .fold(Fraction::zero(), |sum, variable| {
                let inner = (self.of_variable)(variable);
                if inner.is_zero() {
                    sum
                } else {
                    sum + Fraction::from(polynomial.derivative(variable)) * inner
                }
            })
    }

    /// The derivative of a rational function.
    pub fn of(&mut self, function: &Fraction) -> Fraction {
        let above = self.of_polynomial(function.numerator());
        let below = function.denominator();
        let slope = self.of_polynomial(&below);
        let below = Fraction::from(below);
        if slope.is_zero() {
            above / below
        } else {
            above / below.clone() - function.clone() * slope / below
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Field;

    #[test]
    fn a_quotient_obeys_the_quotient_rule_and_a_constant_stays() {
        let [x, y, c] = [0, 1, 2].map(|n| Fraction::variable(Variable(n)));
        // x' = y, y' = -x, c' = 0: the oscillator.
        let mut derivation = Derivation::new(|v| match v.0 {
            0 => Fraction::variable(Variable(1)),
            1 => -Fraction::variable(Variable(0)),
            _ => Fraction::zero(),
        });
        let tangent = x.clone() / (c.clone() * y.clone());
        let expected = (x.to_power(2) + y.to_power(2)) / (c * y.to_power(2));
        assert_eq!(derivation.of(&tangent), expected);
    }
}
