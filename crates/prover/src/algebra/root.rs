//! Square roots of rationals and polynomials that are squares.

use super::order::{Key, Order, key_product, key_quotient};
use super::residue::{MODULUS, Residue, evaluate_mod};
use super::steps::{Result, Steps};
use super::univariate::pseudo_random;
use dashu_int::ops::SquareRootRem;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use kernel::Polynomial;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// The square root, with either sign; `None` where p is not the square of a polynomial with rational coefficients.
pub fn square_root(p: &Polynomial, steps: &mut Steps) -> Result<Option<Polynomial>> {
    steps.take(p.terms().len() as u64)?;
    if p.is_zero() {
        return Ok(Some(Polynomial::default()));
    }
    if (0..4).any(|seed| is_nonresidue(p, seed)) {
        return Ok(None);
    }
    let order = Order::graded(&p.generators());
    let mut rest: BTreeMap<Key, RBig> = BTreeMap::new();
    for (monomial, value) in p.terms() {
        rest.insert(order.key(monomial)?, value.clone());
    }
    let Some((square, value)) = rest.pop_last() else {
        return Ok(None);
    };
    let exponents = order.exponents(&square);
    if exponents.iter().any(|exponent| exponent % 2 == 1) {
        return Ok(None);
    }
    let Some(value) = rational_root(&value) else {
        return Ok(None);
    };
    let lead = order.key_of_exponents(&exponents.iter().map(|exponent| exponent / 2).collect());
    let twice = &value + &value;
    let mut root = vec![(lead.clone(), value)];
    // (root + next)^2 = root^2 + (2 root + next) next, where 2 lead next is what leads the rest
    while let Some((key, value)) = rest.pop_last() {
        if !order.divides(&lead, &key) {
            return Ok(None);
        }
        let next = (key_quotient(&key, &lead), value / &twice);
        steps.take(1 + root.len() as u64)?;
        for (key, value) in root.iter().skip(1) {
            subtract(&mut rest, key_product(key, &next.0)?, (value + value) * &next.1);
        }
        subtract(&mut rest, key_product(&next.0, &next.0)?, &next.1 * &next.1);
        root.push(next);
    }
    let terms = root.into_iter().map(|(key, value)| (order.monomial(&key), value));
    Ok(Some(Polynomial::from_terms(terms)))
}

/// Whether a value of p modulo the prime is no square there, by Euler's criterion: then p is none either.
fn is_nonresidue(p: &Polynomial, seed: u64) -> bool {
    let value = evaluate_mod(p, &|term| pseudo_random(term, seed));
    value.is_some_and(|value| value.power((MODULUS - 1) / 2) == Residue::new(MODULUS - 1))
}

fn subtract(sum: &mut BTreeMap<Key, RBig>, key: Key, value: RBig) {
    match sum.entry(key) {
        Entry::Vacant(place) => {
            place.insert(-value);
        }
        Entry::Occupied(mut place) => {
            *place.get_mut() -= value;
            if place.get().is_zero() {
                place.remove();
            }
        }
    }
}

/// The square root of a rational that is a square.
pub fn rational_root(value: &RBig) -> Option<RBig> {
    if value.numerator() < &IBig::ZERO {
        return None;
    }
    let (numerator, rest) = UBig::try_from(value.numerator().clone()).ok()?.sqrt_rem();
    let (denominator, other) = value.denominator().clone().sqrt_rem();
    (rest.is_zero() && other.is_zero()).then(|| RBig::from_parts(numerator.into(), denominator))
}

#[cfg(test)]
mod tests {
    use super::super::testing::{any_polynomial, plenty, poly};
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn known_roots() {
        for (square, root) in [
            ("4x^2 - 4x y + y^2", Some("2x - y")),
            ("x^2 + x y + y^2", None),
            ("-x^2", None),
            ("9/4", Some("3/2")),
        ] {
            let found = square_root(&poly(square), &mut plenty()).unwrap();
            assert_eq!(found.is_some(), root.is_some(), "{square}");
            if let (Some(found), Some(root)) = (found, root) {
                assert!(found == poly(root) || found == poly(root).negated(), "{square}");
            }
        }
    }

    proptest! {
        #[test]
        fn squares_have_roots(p in any_polynomial(3, 5, 2)) {
            let root = square_root(&p.times(&p), &mut plenty()).unwrap().unwrap();
            prop_assert!(root == p || root == p.negated());
            if let Some(root) = square_root(&p, &mut plenty()).unwrap() {
                prop_assert_eq!(root.times(&root), p);
            }
        }
    }
}
