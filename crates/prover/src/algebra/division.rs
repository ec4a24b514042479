//! Division, and what else is done with the kernel's polynomials as they are.

use super::order::{Key, Order};
use super::reduction::{Divisor, Reduction, integral, mask, polynomial};
use super::steps::{Result, Steps};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use kernel::{Monomial, Polynomial, Term, product};
use num_traits::{One, Zero};
use numbers::Rational;
use std::collections::BTreeMap;

/// The product.
pub fn times(a: &Polynomial, b: &Polynomial, steps: &mut Steps) -> Result<Polynomial> {
    steps.take(1 + a.terms().len() as u64 * b.terms().len() as u64)?;
    // the kernel multiplies quickly by a constant on the right
    Ok(if a.as_constant().is_some() {
        b.times(a)
    } else {
        a.times(b)
    })
}

/// A power.
pub fn power(p: &Polynomial, exponent: u32, steps: &mut Steps) -> Result<Polynomial> {
    if let [(monomial, coefficient)] = p.terms() {
        let raised: Monomial = monomial
            .iter()
            .map(|&(term, e)| (term, e.saturating_mul(exponent)))
            .collect();
        let raised = if exponent == 0 { Monomial::new() } else { raised };
        return Ok(Polynomial::from_terms([(raised, coefficient.pow(exponent as isize))]));
    }
    let mut result = Polynomial::integer(1);
    for _ in 0..exponent {
        result = times(&result, p, steps)?;
    }
    Ok(result)
}

/// The sum of the products of two lists, pair by pair.
pub fn combination<'a>(
    pairs: impl IntoIterator<Item = (&'a Polynomial, &'a Polynomial)>,
    steps: &mut Steps,
) -> Result<Polynomial> {
    let mut sum: BTreeMap<Monomial, RBig> = BTreeMap::new();
    for (a, b) in pairs {
        steps.take(a.terms().len() as u64 * b.terms().len() as u64)?;
        for (m, x) in a.terms() {
            for (n, y) in b.terms() {
                *sum.entry(product(m, n)).or_insert(RBig::ZERO) += x * y;
            }
        }
    }
    Ok(Polynomial::from_terms(sum))
}

/// The greatest monomial under an order that ranks its generators, with its coefficient; `None` of 0.
pub fn lead_monomial(p: &Polynomial, order: &Order) -> Option<(Monomial, Rational)> {
    let greatest = p.terms().iter().max_by(|a, b| order.compare(&a.0, &b.0))?;
    Some((greatest.0.clone(), Rational(greatest.1.clone())))
}

/// Divides by several polynomials: `p = sum quotients[i] * divisors[i] + remainder`, and no leading monomial of a
/// divisor divides a monomial of the remainder. Of several divisors the first that divides is taken. Generators that
/// the order does not rank come last, in a graded block.
///
/// Source: Cox, Little, O'Shea, Ideals, Varieties, and Algorithms, section 2.3.
pub fn divide(
    p: &Polynomial,
    divisors: &[Polynomial],
    order: &Order,
    steps: &mut Steps,
) -> Result<(Vec<Polynomial>, Polynomial)> {
    let mut order = order.clone();
    order.cover(divisors.iter().chain([p]));
    let mut working = Vec::with_capacity(divisors.len());
    for divisor in divisors {
        let (list, factor) = integral(divisor, &order)?;
        let test = list.first().map(|(lead, _)| Divisor::new(lead, &order));
        working.push((list, factor, test));
    }
    let (start, factor) = integral(p, &order)?;
    let mut reduction = Reduction::<IBig>::new(&start, None)?;
    let find = |key: &Key| {
        let exponents = order.exponents(key);
        let mask = mask(&exponents);
        let divides = |test: &Option<Divisor>| test.as_ref().is_some_and(|test| test.divides(&exponents, mask));
        let index = working.iter().position(|(_, _, test)| divides(test))?;
        Some((index, &working[index].0))
    };
    reduction.reduce(true, find, steps)?;
    let mut quotients: Vec<Vec<(Key, RBig)>> = vec![Vec::new(); divisors.len()];
    for (index, key, value) in reduction.quotients.drain(..) {
        quotients[index].push((key, value * &factor / &working[index].1));
    }
    let quotients = quotients
        .iter()
        .map(|list| polynomial(list.iter().map(|(k, c)| (k, c.clone())), &order));
    let quotients = quotients.collect();
    let scale = factor / &reduction.scale;
    let remainder = reduction.remainder();
    let remainder = polynomial(remainder.iter().map(|(key, c)| (key, &scale * c)), &order);
    Ok((quotients, remainder))
}

/// `p / q` where q divides p; `None` where it does not, or is 0.
pub fn exact_quotient(p: &Polynomial, q: &Polynomial, steps: &mut Steps) -> Result<Option<Polynomial>> {
    if q.is_zero() {
        return Ok(None);
    }
    if p.is_zero() {
        return Ok(Some(Polynomial::default()));
    }
    if let Some(constant) = q.as_constant() {
        return Ok(Some(p.scaled(&(Rational::one() / constant))));
    }
    // a quotient exists only where no generator has a greater degree in q
    let degrees = |p: &Polynomial| -> BTreeMap<Term, u32> {
        let mut degrees = BTreeMap::new();
        for (term, exponent) in p.terms().iter().flat_map(|(monomial, _)| monomial) {
            let degree = degrees.entry(*term).or_insert(0);
            *degree = (*degree).max(*exponent);
        }
        degrees
    };
    let above = degrees(p);
    if degrees(q)
        .iter()
        .any(|(term, degree)| above.get(term).is_none_or(|most| most < degree))
    {
        return Ok(None);
    }
    let mut order = Order::default();
    order.cover([p]);
    let ((start, factor), (divisor, by)) = (integral(p, &order)?, integral(q, &order)?);
    let Some((lead, _)) = divisor.first() else {
        return Ok(None);
    };
    let mut reduction = Reduction::<IBig>::new(&start, None)?;
    // the leading term only: one that is not divisible ends it
    reduction.reduce(false, |key| order.divides(lead, key).then_some((0, &divisor)), steps)?;
    if !reduction.done.is_empty() {
        return Ok(None);
    }
    let terms = reduction
        .quotients
        .iter()
        .map(|(_, key, value)| (key, value * &factor / &by));
    Ok(Some(polynomial(terms, &order)))
}

/// The rational content, with the sign of the last term, and the polynomial divided by it: its coefficients are
/// integers without a common factor. `None` of 0.
pub fn primitive(p: &Polynomial) -> Option<(Rational, Polynomial)> {
    use dashu_int::ops::{Gcd, UnsignedAbs};
    let (_, last) = p.terms().last()?;
    let (mut common, mut denominator) = (UBig::ZERO, UBig::ONE);
    for (_, coefficient) in p.terms() {
        common = common.gcd(coefficient.numerator().unsigned_abs());
        let other = coefficient.denominator();
        denominator = &denominator / (&denominator).gcd(other) * other;
    }
    let negative = last.numerator() < &IBig::ZERO;
    let numerator = if negative {
        -IBig::from(common)
    } else {
        IBig::from(common)
    };
    let content = Rational(RBig::from_parts(numerator, denominator));
    if content.is_one() {
        return Some((content, p.clone()));
    }
    let primitive = p.scaled(&(Rational::one() / content.clone()));
    Some((content, primitive))
}

/// The degree in a generator; 0 of 0.
pub fn degree_in(p: &Polynomial, generator: Term) -> u32 {
    p.terms()
        .iter()
        .map(|(monomial, _)| exponent(monomial, generator))
        .max()
        .unwrap_or(0)
}

/// The exponent of a generator in a monomial.
pub fn exponent(monomial: &Monomial, generator: Term) -> u32 {
    monomial
        .iter()
        .find(|(term, _)| *term == generator)
        .map_or(0, |(_, exponent)| *exponent)
}

/// The total degree; 0 of 0.
pub fn total_degree(p: &Polynomial) -> u32 {
    p.terms()
        .iter()
        .map(|(monomial, _)| monomial.iter().map(|(_, e)| e).sum())
        .max()
        .unwrap_or(0)
}

/// The coefficients of the powers of a generator, from its power 0 on; the last is not 0, and of 0 there is none.
pub fn coefficients_in(p: &Polynomial, generator: Term) -> Vec<Polynomial> {
    let mut lists: Vec<Vec<(Monomial, RBig)>> = Vec::new();
    for (monomial, value) in p.terms() {
        let exponent = exponent(monomial, generator) as usize;
        if lists.len() <= exponent {
            lists.resize(exponent + 1, Vec::new());
        }
        let other = monomial
            .iter()
            .copied()
            .filter(|(term, _)| *term != generator)
            .collect();
        lists[exponent].push((other, value.clone()));
    }
    lists.into_iter().map(Polynomial::from_terms).collect()
}

/// The polynomial with these coefficients of the powers of a generator, from its power 0 on.
pub fn from_coefficients_in(coefficients: &[Polynomial], generator: Term) -> Polynomial {
    let terms = coefficients.iter().enumerate().flat_map(|(exponent, coefficient)| {
        let power = power_of(generator, exponent as u32);
        (coefficient.terms().iter()).map(move |(monomial, value)| (product(monomial, &power), value.clone()))
    });
    Polynomial::from_terms(terms)
}

/// A power of a generator as a monomial.
pub fn power_of(generator: Term, exponent: u32) -> Monomial {
    (exponent > 0).then_some((generator, exponent)).into_iter().collect()
}

/// The polynomial times a monomial and a number.
pub fn shifted(p: &Polynomial, monomial: &Monomial, factor: &RBig) -> Polynomial {
    Polynomial::from_terms(p.terms().iter().map(|(m, c)| (product(m, monomial), c * factor)))
}

/// The partial derivative by a generator.
pub fn derivative(p: &Polynomial, generator: Term) -> Polynomial {
    let mut derived = coefficients_in(p, generator);
    if derived.is_empty() {
        return Polynomial::default();
    }
    derived.remove(0);
    for (index, coefficient) in derived.iter_mut().enumerate() {
        *coefficient = coefficient.scaled(&Rational(RBig::from(index as u64 + 1)));
    }
    from_coefficients_in(&derived, generator)
}

/// The polynomial with a generator replaced by a polynomial.
pub fn substitute(p: &Polynomial, generator: Term, by: &Polynomial, steps: &mut Steps) -> Result<Polynomial> {
    // Horner's scheme
    let mut result = Polynomial::default();
    for coefficient in coefficients_in(p, generator).iter().rev() {
        result = times(&result, by, steps)?.plus(coefficient);
    }
    Ok(result)
}

/// The highest degree of what is divided with all its coefficients in memory, those that are 0 too.
const HIGHEST_DEGREE: u32 = 2_000;

/// Divides as polynomials in one generator: `multiplier * p = quotient * q + remainder`, where the remainder has a
/// lesser degree in it than q and the multiplier is a power of q's leading coefficient, with as few factors as the
/// division needs. `None` where q is 0, or the degree of p above `HIGHEST_DEGREE`.
///
/// Source: Knuth, The Art of Computer Programming, volume 2, section 4.6.1, algorithm R; a leading coefficient that
/// is divisible already is not multiplied.
pub fn pseudo_divide(
    p: &Polynomial,
    q: &Polynomial,
    generator: Term,
    steps: &mut Steps,
) -> Result<Option<(Polynomial, Polynomial, Polynomial)>> {
    let divisor = coefficients_in(q, generator);
    let Some((lead, tail)) = divisor.split_last() else {
        return Ok(None);
    };
    let degrees = p.terms().iter().flat_map(|(monomial, _)| monomial);
    let mut degrees = degrees.filter(|(term, _)| *term == generator);
    if degrees.any(|(_, degree)| *degree > HIGHEST_DEGREE) {
        return Ok(None);
    }
    let mut remainder = coefficients_in(p, generator);
    let mut multiplier = Polynomial::integer(1);
    let mut quotient = vec![Polynomial::default(); (remainder.len() + 1).saturating_sub(divisor.len())];
    while remainder.len() >= divisor.len() {
        let Some(top) = remainder.pop() else { break };
        let shift = remainder.len() + 1 - divisor.len();
        if top.is_zero() {
            continue;
        }
        let factor = match exact_quotient(&top, lead, steps)? {
            Some(factor) => factor,
            None => {
                multiplier = times(&multiplier, lead, steps)?;
                for coefficient in remainder.iter_mut().chain(&mut quotient) {
                    *coefficient = times(coefficient, lead, steps)?;
                }
                top
            }
        };
        for (index, coefficient) in tail.iter().enumerate() {
            let part = times(&factor, coefficient, steps)?;
            remainder[shift + index] = remainder[shift + index].minus(&part);
        }
        quotient[shift] = factor;
    }
    let remainder = from_coefficients_in(&remainder, generator);
    Ok(Some((
        multiplier,
        from_coefficients_in(&quotient, generator),
        remainder,
    )))
}

/// Whether it is a constant, 0 included.
pub fn is_constant(p: &Polynomial) -> bool {
    p.as_constant().is_some()
}

/// Whether it is the constant 1.
pub fn is_one(p: &Polynomial) -> bool {
    p.as_constant().is_some_and(|value| value.is_one() && !value.is_zero())
}

#[cfg(test)]
mod tests {
    use super::super::testing::{any_polynomial, generator, plenty, poly, polys, sum_of_products};
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn known_divisions() {
        // Cox, Little, O'Shea, section 2.3, examples 1 and 2
        let order = Order::lexicographic(&[generator('x'), generator('y')]);
        let (quotients, remainder) = divide(
            &poly("x^2 y + x y^2 + y^2"),
            &polys(&["x y - 1", "y^2 - 1"]),
            &order,
            &mut plenty(),
        )
        .unwrap();
        assert_eq!((quotients, remainder), (polys(&["x + y", "1"]), poly("x + y + 1")));
        assert_eq!(
            exact_quotient(&poly("x^2 - 4y^2"), &poly("2x - 4y"), &mut plenty()),
            Ok(Some(poly("1/2 x + y")))
        );
        assert_eq!(
            exact_quotient(&poly("x^2 - y"), &poly("x - y"), &mut plenty()),
            Ok(None)
        );
        assert_eq!(
            exact_quotient(&poly("0"), &poly("x - y"), &mut plenty()),
            Ok(Some(poly("0")))
        );
        assert_eq!(derivative(&poly("x^3 y - 2x + y"), generator('x')), poly("3x^2 y - 2"));
        let replaced = substitute(&poly("x^2 - y"), generator('x'), &poly("y + 1"), &mut plenty());
        assert_eq!(replaced, Ok(poly("y^2 + y + 1")));
        // no power of y is needed: each leading coefficient is divisible
        let (multiplier, ..) = pseudo_divide(&poly("y^2 x^2 + 1"), &poly("y x - 1"), generator('x'), &mut plenty())
            .unwrap()
            .unwrap();
        assert_eq!(multiplier, poly("1"));
    }

    #[test]
    fn orders_compare() {
        let ranking: Vec<Term> = "xyz".chars().map(generator).collect();
        let lead = |text: &str, order: &Order| lead_monomial(&poly(text), order).unwrap().0;
        let monomial = |text: &str| poly(text).terms()[0].0.clone();
        // Cox, Little, O'Shea, section 2.2
        let text = "4x y^2 z + 4z^2 - 5x^3 + 7x^2 z^2";
        assert_eq!(lead(text, &Order::lexicographic(&ranking)), monomial("x^3"));
        assert_eq!(lead(text, &Order::graded(&ranking)), monomial("x y^2 z"));
        let elimination = Order::blocks([&ranking[2..], &ranking[..2]]);
        assert_eq!(lead(text, &elimination), monomial("x^2 z^2"));
        let triangular = Order::triangular(&polys(&["x - y^2", "y - z^3 + 1"]));
        assert_eq!(triangular.generators(), ranking);
    }

    proptest! {
        #[test]
        fn division_multiplies_out(
            p in any_polynomial(3, 6, 3),
            divisors in prop::collection::vec(any_polynomial(3, 3, 2), 1..=3),
        ) {
            let order = Order::graded(&[generator('c'), generator('a')]);
            let (quotients, remainder) = divide(&p, &divisors, &order, &mut plenty()).unwrap();
            prop_assert_eq!(&p, &sum_of_products(&quotients, &divisors).plus(&remainder));
            let product = p.times(&divisors[0]);
            if !divisors[0].is_zero() {
                prop_assert_eq!(exact_quotient(&product, &divisors[0], &mut plenty()), Ok(Some(p.clone())));
            }
            if let Some((multiplier, quotient, remainder)) =
                pseudo_divide(&p, &divisors[0], generator('a'), &mut plenty()).unwrap()
            {
                prop_assert_eq!(multiplier.times(&p), quotient.times(&divisors[0]).plus(&remainder));
                let below = degree_in(&remainder, generator('a')) < degree_in(&divisors[0], generator('a'));
                prop_assert!(below || remainder.is_zero());
            }
        }
    }
}
