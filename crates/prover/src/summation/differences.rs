//! Functions with given differences: `G(k + 1) - G(k) = t(k)` for polynomials in k times powers of numbers.

use super::super::integration::tree::{integer, number, product, quotient, sum, symbol};
use super::{HIGHEST, MOST_TERMS, choose, linear};
use numbers::{Field, Rational};
use std::collections::BTreeMap;
use texmath::{Name, Tree, number_of};

/// The coefficient of `k^degree base^k`, by degree and base.
type Terms = BTreeMap<(i64, Rational), Vec<Tree>>;

fn one() -> Rational {
    Rational::from_integer(1)
}

fn times(left: &Terms, right: &Terms) -> Option<Terms> {
    let mut found = Terms::new();
    for ((degree, base), coefficients) in left {
        for ((other, ratio), factors) in right {
            let whole = product(vec![sum(coefficients.clone()), sum(factors.clone())]);
            let key = (degree + other, base.clone() * ratio.clone());
            found.entry(key).or_default().push(whole);
        }
    }
    (found.len() <= MOST_TERMS && found.keys().all(|(degree, _)| *degree <= HIGHEST)).then_some(found)
}

/// A tree as such terms.
fn terms(tree: &Tree, index: &Name) -> Option<Terms> {
    let of_one = |degree: i64, base: Rational, coefficient: Tree| Terms::from([((degree, base), vec![coefficient])]);
    if !tree.has_free(index) {
        return Some(of_one(0, one(), tree.clone()));
    }
    match tree {
        Tree::Symbol(..) => Some(of_one(1, one(), integer(1))),
        Tree::Negate(inner) => times(&terms(inner, index)?, &of_one(0, one(), integer(-1))),
        Tree::Sum(parts) => {
            let mut all = Terms::new();
            for part in parts {
                for (key, coefficients) in terms(part, index)? {
                    all.entry(key).or_default().extend(coefficients);
                }
            }
            (all.len() <= MOST_TERMS).then_some(all)
        }
        Tree::Product(factors) => {
            let mut whole = of_one(0, one(), integer(1));
            for factor in factors {
                whole = times(&whole, &terms(factor, index)?)?;
            }
            Some(whole)
        }
        Tree::Quotient(above, below, _) if !below.has_free(index) => {
            let inverse = quotient(integer(1), (**below).clone());
            times(&terms(above, index)?, &of_one(0, one(), inverse))
        }
        Tree::Quotient(above, below, _) => {
            let below = terms(below, index)?;
            let mut single = below.iter();
            let (((0, base), coefficients), None) = (single.next()?, single.next()) else {
                return None;
            };
            let inverse = quotient(integer(1), sum(coefficients.clone()));
            times(&terms(above, index)?, &of_one(0, one() / base.clone(), inverse))
        }
        Tree::Power(base, exponent @ 0..=8, _) => {
            let base = terms(base, index)?;
            (0..*exponent).try_fold(of_one(0, one(), integer(1)), |whole, _| times(&whole, &base))
        }
        Tree::RealPower(base, exponent, _) => {
            let base = number_of(base).filter(|base: &Rational| *base != Rational::from_integer(0))?;
            let (factor, offset) = linear(exponent, index)?;
            let power = |exponent: i64| {
                let whole = (0..exponent.unsigned_abs().min(64)).fold(one(), |whole, _| whole * base.clone());
                (exponent.abs() <= 64).then(|| if exponent < 0 { one() / whole } else { whole })
            };
            Some(of_one(0, power(factor)?, number(&power(offset)?)))
        }
        _ => None,
    }
}

/// The coefficients of the polynomial Q, the lowest first, with `base Q(k + 1) - Q(k) = k^degree`.
fn difference_of(degree: i64, base: &Rational) -> Vec<Rational> {
    let mut known: Vec<Vec<Rational>> = Vec::new();
    for d in 0..=degree {
        // of k^(d + 1) for base 1, of k^d else: what is left are multiples of lower powers
        let (top, factor) = match *base == one() {
            true => (d + 1, Rational::from_integer(d + 1)),
            false => (d, base.clone() - one()),
        };
        let zero = Rational::from_integer(0);
        let mut own = vec![zero; usize::try_from(top).unwrap_or_default() + 1];
        if let Some(last) = own.last_mut() {
            *last = one();
        }
        for (j, lower) in known.iter().enumerate() {
            let multiple = base.clone() * Rational::from_integer(choose(top, i64::try_from(j).unwrap_or_default()));
            for (own, lower) in own.iter_mut().zip(lower) {
                *own -= multiple.clone() * lower.clone();
            }
        }
        known.push(own.into_iter().map(|value| value / factor.clone()).collect());
    }
    known.pop().unwrap_or_default()
}

/// Returns a function of the index whose differences are a tree.
pub(super) fn telescoping(of: &Tree, index: &Name) -> Option<Tree> {
    let mut whole = Vec::new();
    for ((degree, base), coefficients) in terms(of, index)? {
        let power = |degree: usize| vec![symbol(index); degree];
        let polynomial = difference_of(degree, &base).into_iter().enumerate();
        let polynomial = polynomial.map(|(degree, value)| {
            let factors = std::iter::once(number(&value)).chain(power(degree));
            product(factors.collect())
        });
        let mut factors = vec![sum(coefficients), sum(polynomial.collect())];
        if base != one() {
            let at = texmath::At::default();
            factors.push(Tree::RealPower(Box::new(number(&base)), Box::new(symbol(index)), at));
        }
        whole.push(product(factors));
    }
    Some(sum(whole))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_the_powers_that_they_are_of() {
        let value = |coefficients: &[Rational], k: i64| {
            let mut whole = Rational::from_integer(0);
            for coefficient in coefficients.iter().rev() {
                whole = whole * Rational::from_integer(k) + coefficient.clone();
            }
            whole
        };
        for base in [(1, 1), (2, 1), (-1, 1), (1, 3)].map(|(above, below)| Rational::new(above, below).unwrap()) {
            for degree in 0..=HIGHEST {
                let found = difference_of(degree, &base);
                for k in [-3, 0, 1, 5] {
                    let power = (0..degree).fold(one(), |whole, _| whole * Rational::from_integer(k));
                    let step = base.clone() * value(&found, k + 1) - value(&found, k);
                    assert_eq!(step, power, "{degree} at {k}");
                }
            }
        }
    }
}
