//! Power products.

use smallvec::SmallVec;

/// A variable, by its number. A larger number is the larger variable in the order of monomials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Variable(pub u32);

/// A product of powers of variables: pairs of variable and positive exponent, the largest variable first, so that
/// comparing the pairs one by one is the lexicographic order of monomials.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Monomial(SmallVec<[(Variable, u32); 6]>);

impl Monomial {
    /// The empty product.
    pub fn one() -> Self {
        Self::default()
    }

    /// `variable` to the power `exponent`.
    pub fn power(variable: Variable, exponent: u32) -> Self {
        let mut factors = SmallVec::new();
        if exponent > 0 {
            factors.push((variable, exponent));
        }
        Self(factors)
    }

    /// The factors, the largest variable first.
    pub fn factors(&self) -> &[(Variable, u32)] {
        &self.0
    }

    /// Whether this is the empty product.
    pub fn is_one(&self) -> bool {
        self.0.is_empty()
    }

    /// The exponent of `variable`, 0 where it is absent.
    pub fn exponent(&self, variable: Variable) -> u32 {
        self.0.iter().find(|(v, _)| *v == variable).map_or(0, |(_, e)| *e)
    }

    /// The product of two monomials.
    pub fn times(&self, other: &Self) -> Self {
        self.merge(other, |a, b| Some(a + b)).unwrap_or_default()
    }

    /// `self / other` where that is a monomial.
    pub fn over(&self, other: &Self) -> Option<Self> {
        // An exponent that `other` alone has stands on the left as 0 and cannot be lowered.
        self.merge(other, |a, b| a.checked_sub(b))
    }

    /// The greatest common divisor.
    pub fn common(&self, other: &Self) -> Self {
        self.merge(other, |a, b| Some(a.min(b))).unwrap_or_default()
    }

    /// The monomial without `variable`.
    pub fn without(&self, variable: Variable) -> Self {
        Self(self.0.iter().filter(|(v, _)| *v != variable).copied().collect())
    }

    /// Joins the factors of both, `join` being given the two exponents (0 where absent); a result of 0 drops out.
    fn merge(&self, other: &Self, join: impl Fn(u32, u32) -> Option<u32>) -> Option<Self> {
        let (mut left, mut right) = (self.0.iter().peekable(), other.0.iter().peekable());
        let mut factors = SmallVec::new();
        loop {
            let (variable, a, b) = match (left.peek(), right.peek()) {
                (None, None) => return Some(Self(factors)),
                (Some(&&(v, a)), Some(&&(w, b))) if v == w => (v, a, b),
                (Some(&&(v, a)), Some(&&(w, _))) if v > w => (v, a, 0),
                (Some(&&(v, a)), None) => (v, a, 0),
                (_, Some(&&(w, b))) => (w, 0, b),
            };
            if a > 0 {
                left.next();
            }
            if b > 0 {
                right.next();
            }
            let exponent = join(a, b)?;
            if exponent > 0 {
                factors.push((variable, exponent));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn monomial(factors: &[(u32, u32)]) -> Monomial {
        factors
            .iter()
            .fold(Monomial::one(), |m, &(v, e)| m.times(&Monomial::power(Variable(v), e)))
    }

    #[test]
    fn a_product_divided_by_a_factor_is_the_other() {
        let (a, b) = (monomial(&[(1, 2), (3, 1)]), monomial(&[(2, 1), (3, 4)]));
        assert_eq!(a.times(&b).over(&a), Some(b.clone()));
        assert_eq!(a.over(&b), None);
        assert_eq!(a.common(&b), monomial(&[(3, 1)]));
        assert_eq!(a.without(Variable(3)), monomial(&[(1, 2)]));
    }

    #[test]
    fn the_order_is_lexicographic_from_the_largest_variable_down() {
        assert!(monomial(&[(2, 1)]) > monomial(&[(1, 5)]));
        assert!(monomial(&[(2, 1), (1, 1)]) > monomial(&[(2, 1)]));
        assert!(monomial(&[(2, 2)]) > monomial(&[(2, 1), (1, 9)]));
    }
}
