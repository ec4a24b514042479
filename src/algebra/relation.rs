//! Side relations `s^2 = Delta`: square roots as variables of their own.

use super::fraction::Fraction;
use super::monomial::{Monomial, Variable};
use super::polynomial::Polynomial;
use dashu_int::IBig;
use dashu_int::ops::{SquareRoot, UnsignedAbs};

/// `root^2 = square`.
#[derive(Clone, Debug)]
pub struct Relation {
    /// The variable that stands for the root.
    pub root: Variable,
    /// Its square.
    pub square: Polynomial,
}

impl Relation {
    /// The polynomial with even powers of the root replaced: `(a, b)` of `a + b root`.
    pub fn split(&self, polynomial: &Polynomial) -> (Polynomial, Polynomial) {
        let mut parts = [Polynomial::default(), Polynomial::default()];
        for (power, coefficient) in polynomial.coefficients(self.root).iter().enumerate() {
            let even = self.square.to_power(power as u32 / 2);
            parts[power % 2] = parts[power % 2].plus(&coefficient.times(&even));
        }
        let [a, b] = parts;
        (a, b)
    }

    /// The polynomial in normal form: the root at most to the first power.
    pub fn reduce(&self, polynomial: &Polynomial) -> Polynomial {
        if polynomial.degree(self.root) < 2 {
            return polynomial.clone();
        }
        let (a, b) = self.split(polynomial);
        a.plus(&b.times(&Polynomial::variable(self.root)))
    }

    /// The function with numerator and denominator in normal form; zero exactly where its numerator then is, as
    /// long as the square of the relation is no square itself.
    pub fn reduce_fraction(&self, function: &Fraction) -> Fraction {
        if !function.contains(self.root) {
            return function.clone();
        }
        let above = Fraction::from(self.reduce(function.numerator()));
        above / Fraction::from(self.reduce(&function.denominator()))
    }
}

/// The polynomial whose square is `polynomial`, with a positive leading coefficient, where there is one.
pub fn square_root(polynomial: &Polynomial) -> Option<Polynomial> {
    let (lead, coefficient) = polynomial.terms().first()?;
    let lead = half(lead)?;
    let coefficient = integer_root(coefficient)?;
    let double = coefficient.clone() * IBig::from(2);
    let mut root = Polynomial::term(lead.clone(), coefficient);
    // As by hand: the next term of the root is the leading term of the rest over twice the root's leading term.
    loop {
        let rest = polynomial.minus(&root.times(&root));
        let Some((monomial, c)) = rest.terms().first() else {
            return Some(root);
        };
        let next = monomial.over(&lead)?;
        let last = root.terms().last().map(|(m, _)| m.clone())?;
        if next >= last || !(c % &double).is_zero() {
            return None;
        }
        root = root.plus(&Polynomial::term(next, c / &double));
    }
}

fn half(monomial: &Monomial) -> Option<Monomial> {
    monomial
        .factors()
        .iter()
        .try_fold(Monomial::one(), |product, &(variable, exponent)| {
            (exponent % 2 == 0).then(|| product.times(&Monomial::power(variable, exponent / 2)))
        })
}

fn integer_root(value: &IBig) -> Option<IBig> {
    if *value < IBig::ZERO {
        return None;
    }
    let root = value.clone().unsigned_abs().sqrt();
    (IBig::from(&root * &root) == *value).then(|| IBig::from(root))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn x(n: u32) -> Polynomial {
        Polynomial::variable(Variable(n))
    }

    #[test]
    fn the_conjugates_multiply_to_a_square_minus_b_square_times_delta() {
        let relation = Relation {
            root: Variable(9),
            square: x(1).plus(&x(2)),
        };
        let product = x(0).plus(&x(9)).times(&x(0).minus(&x(9)));
        assert_eq!(relation.reduce(&product), x(0).to_power(2).minus(&x(1)).minus(&x(2)));
    }

    #[test]
    fn a_square_has_its_root_and_a_neighbour_of_a_square_has_none() {
        let root = x(2)
            .scaled(&IBig::from(3))
            .minus(&x(1).times(&x(0)))
            .plus(&Polynomial::from(5));
        let square = root.times(&root);
        assert_eq!(square_root(&square), Some(root));
        assert_eq!(square_root(&square.plus(&Polynomial::from(1))), None);
        assert_eq!(square_root(&square.negated()), None);
        assert_eq!(square_root(&x(1)), None);
    }
}
