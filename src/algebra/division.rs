//! Division of polynomials that leaves nothing: by polynomials, by contents, by monomials.

use super::monomial::Monomial;
use super::polynomial::Polynomial;
use dashu_int::IBig;
use dashu_int::ops::{DivRem, Gcd};

/// Terms that one division may go through: it serves to keep fractions small, and is not worth more.
const MOST_DIVISION: usize = 20_000;

impl Polynomial {
    /// `self / divisor` where the division leaves nothing; `None` otherwise, for a zero divisor, and where it takes
    /// more steps than a fraction kept small is worth.
    pub fn exact_quotient(&self, divisor: &Self) -> Option<Self> {
        // The last terms must divide as well as the first: most that does not divide is found out here.
        if let (Some((last, c)), Some((end, e))) = (self.terms.last(), divisor.terms.last())
            && (last.over(end).is_none() || !(c % e).is_zero())
        {
            return None;
        }
        if self.too_large {
            return None;
        }
        let (lead, lead_coefficient) = divisor.terms.first()?;
        let mut rest = self.clone();
        let mut quotient = Vec::new();
        let mut steps = 0;
        while let Some((monomial, coefficient)) = rest.terms.first() {
            let power = monomial.over(lead)?;
            let (times, left_over) = coefficient.div_rem(lead_coefficient);
            if !left_over.is_zero() {
                return None;
            }
            steps += rest.terms.len();
            if steps > MOST_DIVISION {
                return None;
            }
            let term = Self::term(power, times);
            rest = rest.minus(&divisor.times(&term));
            quotient.extend(term.terms);
        }
        Some(Self {
            terms: quotient,
            too_large: false,
        })
    }

    /// The greatest integer that divides every coefficient, with the sign of the leading one; 0 for zero.
    pub fn content(&self) -> IBig {
        let mut content = IBig::ZERO;
        for (_, coefficient) in &self.terms {
            content = IBig::from(content.gcd(coefficient));
            if content == IBig::ONE {
                break;
            }
        }
        match self.terms.first() {
            Some((_, lead)) if *lead < IBig::ZERO => -content,
            _ => content,
        }
    }

    /// The greatest monomial that divides every term.
    pub fn common_monomial(&self) -> Monomial {
        let mut monomials = self.terms.iter().map(|(m, _)| m);
        let first = monomials.next().cloned().unwrap_or_default();
        monomials.fold(first, |common, m| common.common(m))
    }

    /// The polynomial divided by an integer and a monomial that divide it.
    pub fn reduced(&self, content: &IBig, monomial: &Monomial) -> Self {
        if content.is_zero() {
            return self.clone();
        }
        Self {
            terms: self
                .terms
                .iter()
                .map(|(m, c)| (m.over(monomial).unwrap_or_default(), c / content))
                .collect(),
            too_large: self.too_large,
        }
    }

    /// The polynomial divided by its content: coefficients without a common factor, the leading one positive.
    pub fn primitive(&self) -> Self {
        self.reduced(&self.content(), &Monomial::one())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Variable;

    fn x(n: u32) -> Polynomial {
        Polynomial::variable(Variable(n))
    }

    #[test]
    fn a_product_divided_by_a_factor_is_the_other_and_by_a_stranger_nothing() {
        let a = x(1).plus(&x(2).scaled(&IBig::from(3)));
        let b = x(1).minus(&x(3)).plus(&Polynomial::from(7));
        assert_eq!(a.times(&b).exact_quotient(&a), Some(b.clone()));
        assert_eq!(a.times(&b).plus(&Polynomial::from(1)).exact_quotient(&a), None);
        assert_eq!(a.exact_quotient(&Polynomial::default()), None);
    }
}
