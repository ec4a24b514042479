//! Greatest common divisors, contents and square-free parts.

use super::division::{
    coefficients_in, degree_in, derivative, exact_quotient, from_coefficients_in, is_constant, primitive,
    pseudo_divide, shifted, times,
};
use super::root::square_root;
use super::steps::{Result, Steps};
use super::univariate;
use dashu_ratio::RBig;
use kernel::{Monomial, Polynomial, Term};

/// A greatest common divisor: integer coefficients without a common factor; 0 of two zeros.
///
/// Images modulo 2^61 - 1 bound its degree in each generator; generators that cannot occur are split off, and the
/// rest is done by primitive remainder sequences.
pub fn gcd(p: &Polynomial, q: &Polynomial, steps: &mut Steps) -> Result<Polynomial> {
    let (Some((_, p)), Some((_, q))) = (primitive(p), primitive(q)) else {
        return Ok(primitive(&p.plus(q)).map_or_else(Polynomial::default, |(_, primitive)| primitive));
    };
    let (monomial_p, p) = split_monomial(&p);
    let (monomial_q, q) = split_monomial(&q);
    let common: Monomial = (monomial_p.iter())
        .filter_map(|&(term, n)| Some((term, n.min(monomial_q.iter().find(|(other, _)| *other == term)?.1))))
        .collect();
    Ok(shifted(&gcd_without_monomials(&p, &q, steps)?, &common, &RBig::ONE))
}

/// Of two primitive polynomials that no generator divides.
fn gcd_without_monomials(p: &Polynomial, q: &Polynomial, steps: &mut Steps) -> Result<Polynomial> {
    if p == q {
        return Ok(p.clone());
    }
    let one = Polynomial::integer(1);
    if is_constant(p) || is_constant(q) {
        return Ok(one);
    }
    let (in_p, in_q) = (p.generators(), q.generators());
    // a generator that only one of them holds, or in which their images are coprime, is not in the divisor
    for (inner, outer, generators) in [(p, q, &in_p), (q, p, &in_q)] {
        if let Some(alone) = generators.iter().find(|term| degree_in(outer, **term) == 0) {
            return gcd_of_coefficients(outer, inner, *alone, steps);
        }
    }
    let mut bounds = Vec::with_capacity(in_p.len());
    for &generator in &in_p {
        let bound = degree_bound(p, q, generator, steps)?;
        if bound == 0 {
            let content = content_in(p, generator, steps)?;
            return gcd_of_coefficients(&content, q, generator, steps);
        }
        bounds.push((bound, generator));
    }
    for (smaller, larger) in [(p, q), (q, p)] {
        let whole = bounds
            .iter()
            .all(|&(bound, generator)| degree_in(smaller, generator) == bound);
        if whole && exact_quotient(larger, smaller, steps)?.is_some() {
            return Ok(smaller.clone());
        }
    }
    let least = bounds
        .iter()
        .min_by_key(|&&(_, term)| degree_in(p, term).max(degree_in(q, term)));
    let Some(&(_, generator)) = least else { return Ok(one) };
    let (content_p, mut a) = primitive_in(p, generator, steps)?;
    let (content_q, mut b) = primitive_in(q, generator, steps)?;
    let content = gcd(&content_p, &content_q, steps)?;
    if degree_in(&a, generator) < degree_in(&b, generator) {
        (a, b) = (b, a);
    }
    loop {
        let Some((_, _, remainder)) = pseudo_divide(&a, &b, generator, steps)? else {
            break;
        };
        if remainder.is_zero() {
            break;
        }
        if degree_in(&remainder, generator) == 0 {
            return Ok(content);
        }
        (a, b) = (b, primitive_in(&remainder, generator, steps)?.1);
    }
    let whole = times(&b, &content, steps)?;
    Ok(primitive(&whole).map_or(one, |(_, primitive)| primitive))
}

/// The divisor that p has in common with the coefficients of q in a generator that p does not hold.
fn gcd_of_coefficients(p: &Polynomial, q: &Polynomial, generator: Term, steps: &mut Steps) -> Result<Polynomial> {
    let mut common = p.clone();
    let mut coefficients = coefficients_in(q, generator);
    coefficients.sort_by_key(|coefficient| coefficient.terms().len());
    for coefficient in coefficients.iter().filter(|coefficient| !coefficient.is_zero()) {
        common = gcd(&common, coefficient, steps)?;
        if is_constant(&common) {
            break;
        }
    }
    Ok(common)
}

/// A bound for the degree of the greatest common divisor in a generator: the degree of that of the images, for values
/// of the other generators at which no leading coefficient vanishes.
fn degree_bound(p: &Polynomial, q: &Polynomial, generator: Term, steps: &mut Steps) -> Result<u32> {
    let (n, m) = (degree_in(p, generator), degree_in(q, generator));
    steps.take((p.terms().len() + q.terms().len()) as u64)?;
    let values = |term| univariate::pseudo_random(term, 0);
    let images = [(p, n), (q, m)].map(|(p, degree)| {
        let image = univariate::univariate_mod(p, generator, &values);
        image.filter(|image| image.len() == degree as usize + 1)
    });
    let [Some(a), Some(b)] = images else {
        return Ok(n.min(m));
    };
    Ok(univariate::gcd(a, b, steps)?.len() as u32 - 1)
}

/// The greatest monomial that divides every term, and the quotient by it.
pub fn split_monomial(p: &Polynomial) -> (Monomial, Polynomial) {
    let mut lists = p.terms().iter().map(|(monomial, _)| monomial);
    let Some(first) = lists.next() else {
        return (Monomial::new(), p.clone());
    };
    let common = lists.fold(first.clone(), |common, monomial| {
        let shared = common.iter().filter_map(|&(term, n)| {
            let other = super::division::exponent(monomial, term);
            (other > 0).then_some((term, n.min(other)))
        });
        shared.collect()
    });
    if common.is_empty() {
        return (common, p.clone());
    }
    let reduced = p.terms().iter().map(|(monomial, value)| {
        let left = monomial
            .iter()
            .map(|&(term, n)| (term, n - super::division::exponent(&common, term)));
        (left.filter(|(_, n)| *n > 0).collect(), value.clone())
    });
    let reduced = Polynomial::from_terms(reduced);
    (common, reduced)
}

/// The content with respect to a generator: the greatest common divisor of the coefficients of its powers.
pub fn content_in(p: &Polynomial, generator: Term, steps: &mut Steps) -> Result<Polynomial> {
    gcd_of_coefficients(&Polynomial::default(), p, generator, steps)
}

/// The content with respect to a generator, and the polynomial divided by it.
pub fn primitive_in(p: &Polynomial, generator: Term, steps: &mut Steps) -> Result<(Polynomial, Polynomial)> {
    let content = content_in(p, generator, steps)?;
    if is_constant(&content) {
        let primitive = primitive(p).map_or_else(Polynomial::default, |(_, primitive)| primitive);
        return Ok((content, primitive));
    }
    let mut quotients = coefficients_in(p, generator);
    for coefficient in &mut quotients {
        *coefficient = exact_quotient(coefficient, &content, steps)?.unwrap_or_default();
    }
    let quotient = from_coefficients_in(&quotients, generator);
    let primitive = primitive(&quotient).map_or(quotient, |(_, primitive)| primitive);
    Ok((content, primitive))
}

/// The square-free decomposition: `p` is a number times `prod factors^exponents`, where the factors have no square
/// factors, pairwise none in common, and integer coefficients without a common factor.
///
/// Source: Yun, On square-free decomposition algorithms, SYMSAC 1976, with contents split off first.
pub fn squarefree(p: &Polynomial, steps: &mut Steps) -> Result<Vec<(Polynomial, u32)>> {
    let Some((_, p)) = primitive(p) else {
        return Ok(Vec::new());
    };
    let (monomial, p) = split_monomial(&p);
    let mut factors: Vec<(Polynomial, u32)> = monomial
        .iter()
        .map(|&(term, exponent)| (Polynomial::generator(term), exponent))
        .collect();
    let Some(&generator) = p.generators().iter().min_by_key(|term| degree_in(&p, **term)) else {
        return Ok(factors);
    };
    let (content, p) = primitive_in(&p, generator, steps)?;
    for (factor, exponent) in squarefree(&content, steps)? {
        factors.push((factor, exponent));
    }
    // perfect squares are frequent and cheap to see
    for signed in [p.clone(), p.negated()] {
        if let Some(root) = square_root(&signed, steps)?
            && !is_constant(&root)
        {
            let parts = squarefree(&root, steps)?;
            factors.extend(parts.into_iter().map(|(factor, exponent)| (factor, 2 * exponent)));
            return Ok(factors);
        }
    }
    let slope = derivative(&p, generator);
    let common = gcd(&p, &slope, steps)?;
    let quotient = |p: &Polynomial, q: &Polynomial, steps: &mut Steps| -> Result<Polynomial> {
        Ok(exact_quotient(p, q, steps)?.unwrap_or_default())
    };
    let mut open = quotient(&p, &common, steps)?;
    let mut rest = quotient(&slope, &common, steps)?;
    let mut exponent = 1;
    while !is_constant(&open) {
        let difference = rest.minus(&derivative(&open, generator));
        let factor = if difference.is_zero() {
            open.clone()
        } else {
            gcd(&open, &difference, steps)?
        };
        open = quotient(&open, &factor, steps)?;
        rest = quotient(&difference, &factor, steps)?;
        if !is_constant(&factor) {
            factors.push((primitive(&factor).map_or(factor, |(_, primitive)| primitive), exponent));
        }
        exponent += 1;
    }
    Ok(factors)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{any_polynomial, generator, plenty, poly};
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn known_divisors() {
        let common = |p: &str, q: &str| gcd(&poly(p), &poly(q), &mut plenty()).unwrap();
        assert!(common("6x^2 - 6y^2", "4x y - 4y^2").is_multiple_of(&poly("x - y")));
        assert_eq!(common("x + y", "x - y"), poly("1"));
        assert_eq!(common("0", "-2x"), poly("x"));
        assert_eq!(common("0", "0"), poly("0"));
        assert!(common("x (a + b) (x y - 1)", "x^3 (a + b) (c + 2)").is_multiple_of(&poly("x (a + b)")));
        // Knuth, volume 2, section 4.6.1: coprime, with large remainders
        assert_eq!(
            common(
                "x^8 + x^6 - 3x^4 - 3x^3 + 8x^2 + 2x - 5",
                "3x^6 + 5x^4 - 4x^2 - 9x + 21"
            ),
            poly("1")
        );
        let parts = squarefree(&poly("2 y^2 (x - y)^3 (x + 1)^3 (a x - b)"), &mut plenty()).unwrap();
        let exponents: Vec<u32> = parts.iter().map(|(_, exponent)| *exponent).collect();
        assert_eq!(exponents.iter().copied().max(), Some(3));
        assert_eq!(
            content_in(&poly("a b x^2 - a"), generator('x'), &mut plenty()),
            Ok(poly("a"))
        );
    }

    proptest! {
        #[test]
        fn divisors_divide_and_leave_coprime_cofactors(
            p in any_polynomial(3, 3, 2),
            q in any_polynomial(3, 3, 2),
            common in any_polynomial(3, 3, 2),
        ) {
            let (a, b) = (p.times(&common), q.times(&common));
            let steps = &mut plenty();
            let divisor = gcd(&a, &b, steps).unwrap();
            if !a.is_zero() && !b.is_zero() {
                prop_assert!(exact_quotient(&divisor, &common, steps).unwrap().is_some());
                let (a, b) = (exact_quotient(&a, &divisor, steps).unwrap(), exact_quotient(&b, &divisor, steps).unwrap());
                prop_assert!(is_constant(&gcd(&a.unwrap(), &b.unwrap(), steps).unwrap()));
            }
            let square = p.times(&q).times(&q);
            let parts = squarefree(&square, steps).unwrap();
            let product = parts.iter().fold(Polynomial::integer(1), |product, (factor, exponent)| {
                (0..*exponent).fold(product, |product, _| product.times(factor))
            });
            prop_assert!(square.is_zero() || product.is_multiple_of(&square));
        }
    }
}
