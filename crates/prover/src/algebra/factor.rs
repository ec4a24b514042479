//! Factors over the rationals.

use super::division::{
    coefficients_in, degree_in, exact_quotient, exponent, from_coefficients_in, is_constant, lead_monomial, power_of,
    primitive, times, total_degree,
};
use super::gcd::{gcd, primitive_in, split_monomial, squarefree};
use super::order::Order;
use super::residue::{MODULUS, Residue};
use super::root::square_root;
use super::steps::{Result, Steps};
use super::univariate::{self, Univariate};
use dashu_int::IBig;
use dashu_ratio::RBig;
use kernel::{Polynomial, Term};
use num_traits::{One, Zero};
use numbers::Rational;

/// The greatest degree of a univariate polynomial, or of the image of a multivariate one, that is factored.
const MOST_DEGREE: u32 = 40;

/// A product `constant * prod factors[i].0 ^ factors[i].1`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Factors {
    pub constant: Rational,
    /// Integer coefficients without a common factor; pairwise different, none constant.
    pub factors: Vec<(Polynomial, u32)>,
}

/// Factors over the rationals; of 0 the constant 0.
///
/// Not complete: each factor is without squares and has no divisor in common with a hint, unless it divides it. A
/// factor of degree 1 or 2 in some generator is irreducible; so is a univariate one of degree at most 40 whose
/// divisors have coefficients below 2^60. Others are split by what is cheap: powers of a generator taken together,
/// homogeneous polynomials with a generator set to 1, and Kronecker's substitution for small degrees.
pub fn factors(p: &Polynomial, hints: &[Polynomial], steps: &mut Steps) -> Result<Factors> {
    let Some((constant, core)) = primitive(p) else {
        return Ok(Factors {
            constant: Rational::zero(),
            factors: Vec::new(),
        });
    };
    let mut found: Vec<(Polynomial, u32)> = Vec::new();
    for (part, exponent) in squarefree(&core, steps)? {
        let mut open = vec![part];
        while let Some(part) = open.pop() {
            match split(&part, hints, steps)? {
                Some(parts) => open.extend(parts),
                None => match found.iter_mut().find(|(known, _)| known.is_multiple_of(&part)) {
                    Some((_, known)) => *known += exponent,
                    None => found.push((part, exponent)),
                },
            }
        }
    }
    found.sort_by_key(|(factor, _)| (total_degree(factor), factor.terms().len()));
    // leading coefficients are multiplicative
    let order = Order::graded(&core.generators());
    let lead = |p: &Polynomial| lead_monomial(p, &order).map_or_else(Rational::one, |(_, value)| value);
    let product = found.iter().fold(Rational::one(), |product, (factor, exponent)| {
        product * Rational(lead(factor).0.pow(*exponent as isize))
    });
    Ok(Factors {
        constant: constant * lead(&core) / product,
        factors: found,
    })
}

/// Divisors whose product is p up to a number; `None` where none is found but p.
fn split(p: &Polynomial, hints: &[Polynomial], steps: &mut Steps) -> Result<Option<Vec<Polynomial>>> {
    let (monomial, core) = split_monomial(p);
    if !monomial.is_empty() && (monomial.len() > 1 || !is_constant(&core)) {
        let mut parts: Vec<Polynomial> = monomial.iter().map(|&(term, _)| Polynomial::generator(term)).collect();
        parts.extend((!is_constant(&core)).then_some(core));
        return Ok(Some(parts));
    }
    let generators = p.generators();
    for &generator in &generators {
        let (content, primitive) = primitive_in(p, generator, steps)?;
        if !is_constant(&content) {
            return Ok(Some(vec![content, primitive]));
        }
    }
    for hint in hints {
        let common = gcd(p, hint, steps)?;
        if !is_constant(&common)
            && let Some(quotient) = exact_quotient(p, &common, steps)?
            && !is_constant(&quotient)
        {
            return Ok(Some(vec![common, quotient]));
        }
    }
    let Some(&least) = generators.iter().min_by_key(|term| degree_in(p, **term)) else {
        return Ok(None);
    };
    match (degree_in(p, least), generators.len()) {
        // primitive and linear: irreducible
        (1, _) => Ok(None),
        (2, _) => split_quadratic(p, least, steps),
        (degree, 1) if degree <= MOST_DEGREE => split_univariate(p, least, steps),
        (_, 1) => Ok(None),
        _ => split_multivariate(p, &generators, steps),
    }
}

/// A quadratic polynomial is irreducible unless its discriminant is a square.
fn split_quadratic(p: &Polynomial, generator: Term, steps: &mut Steps) -> Result<Option<Vec<Polynomial>>> {
    let [c, b, a] = coefficients_in(p, generator).try_into().unwrap_or_default();
    let ac = times(&a, &c, steps)?;
    let discriminant = times(&b, &b, steps)?.minus(&ac.scaled(&Rational(RBig::from(4))));
    let Some(root) = square_root(&discriminant, steps)? else {
        return Ok(None);
    };
    let twice = a.scaled(&Rational(RBig::from(2)));
    let mut parts = Vec::with_capacity(2);
    for constant in [b.plus(&root), b.minus(&root)] {
        parts.push(
            primitive_in(
                &from_coefficients_in(&[constant, twice.clone()], generator),
                generator,
                steps,
            )?
            .1,
        );
    }
    Ok(Some(parts))
}

/// Irreducible factors of a square-free integer polynomial in one generator: those modulo a prime, recombined.
///
/// Source: Zassenhaus, On Hensel factorization I, J. Number Theory 1 (1969) 291-311; the prime 2^61 - 1 stands in for
/// lifting, so that divisors with coefficients of 2^60 or more are not found.
fn split_univariate(p: &Polynomial, generator: Term, steps: &mut Steps) -> Result<Option<Vec<Polynomial>>> {
    let Some(image) = univariate::univariate_mod(p, generator, &|_| Residue::default()) else {
        return Ok(None);
    };
    if image.len() != degree_in(p, generator) as usize + 1 {
        return Ok(None);
    }
    let mut pool = univariate::irreducible_factors(&image, steps)?;
    let (mut rest, mut parts, mut size) = (p.clone(), Vec::new(), 1);
    while 2 * size <= pool.len() {
        match recombined(&rest, &pool, size, generator, steps)? {
            Some((factor, quotient, used)) => {
                parts.push(factor);
                rest = quotient;
                let mut index = 0;
                pool.retain(|_| {
                    index += 1;
                    !used.contains(&(index - 1))
                });
            }
            None => size += 1,
        }
    }
    if parts.is_empty() {
        return Ok(None);
    }
    parts.extend((!is_constant(&rest)).then_some(rest));
    Ok(Some(parts))
}

/// A divisor that is the image of a product of so many factors modulo the prime, its cofactor, and which they are.
fn recombined(
    p: &Polynomial,
    pool: &[Univariate],
    size: usize,
    generator: Term,
    steps: &mut Steps,
) -> Result<Option<(Polynomial, Polynomial, Vec<usize>)>> {
    let coefficients = coefficients_in(p, generator);
    let integer = |p: Option<&Polynomial>| {
        p.and_then(Polynomial::as_constant)
            .map_or(IBig::ZERO, |c| c.0.into_parts().0)
    };
    let (first, lead) = (integer(coefficients.first()), integer(coefficients.last()));
    let lead_residue = Residue::of_integer(&lead);
    let mut chosen: Vec<usize> = (0..size).collect();
    loop {
        steps.take(size as u64)?;
        let constants = chosen.iter().map(|&index| pool[index][0]);
        let constant = symmetric(constants.fold(lead_residue, |product, value| product * value));
        // the constant of a divisor, times the leading coefficient, divides the product of these two
        if !constant.is_zero() && (&first * &lead % constant).is_zero() {
            let mut product = vec![lead_residue];
            for &index in &chosen {
                product = univariate::product(&product, &pool[index], steps)?;
            }
            let terms = product.iter().enumerate();
            let terms = terms.map(|(at, value)| (power_of(generator, at as u32), RBig::from(symmetric(*value))));
            let candidate = Polynomial::from_terms(terms);
            if let Some((_, candidate)) = primitive(&candidate)
                && let Some(quotient) = exact_quotient(p, &candidate, steps)?
            {
                let quotient = primitive(&quotient).map_or(quotient, |(_, quotient)| quotient);
                return Ok(Some((candidate, quotient, chosen)));
            }
        }
        if !next_subset(&mut chosen, pool.len()) {
            return Ok(None);
        }
    }
}

/// The next subset of the same size of the numbers below `of`; false after the last.
pub(super) fn next_subset(chosen: &mut [usize], of: usize) -> bool {
    let size = chosen.len();
    let Some(at) = (0..size).rev().find(|&at| chosen[at] + size - at < of) else {
        return false;
    };
    chosen[at] += 1;
    for later in at + 1..size {
        chosen[later] = chosen[later - 1] + 1;
    }
    true
}

/// The representative of least absolute value.
fn symmetric(value: Residue) -> IBig {
    let value = value.value();
    if value > MODULUS / 2 {
        -IBig::from(MODULUS - value)
    } else {
        IBig::from(value)
    }
}

/// Cheap attempts at a polynomial that has degree 3 or more in each of several generators.
fn split_multivariate(p: &Polynomial, generators: &[Term], steps: &mut Steps) -> Result<Option<Vec<Polynomial>>> {
    // x^(kn) as x^n
    for &generator in generators {
        let step = p.terms().iter().fold(0, |step, (monomial, _)| {
            common_step(step, exponent(monomial, generator))
        });
        if step > 1 {
            let taken = with_exponents(p, generator, |exponent| exponent / step);
            if let Some(parts) = split(&taken, &[], steps)? {
                let back = parts
                    .iter()
                    .map(|part| with_exponents(part, generator, |exponent| exponent * step));
                return Ok(Some(back.collect()));
            }
        }
    }
    let degree = |monomial: &[(Term, u32)]| monomial.iter().map(|(_, exponent)| exponent).sum::<u32>();
    let whole = total_degree(p);
    let last = generators[generators.len() - 1];
    if p.terms().iter().all(|(monomial, _)| degree(monomial) == whole) {
        let flat = with_exponents(p, last, |_| 0);
        let Some(parts) = split(&flat, &[], steps)? else {
            return Ok(None);
        };
        let homogeneous = |part: &Polynomial| {
            let whole = total_degree(part);
            let terms = part.terms().iter().map(|(monomial, value)| {
                let missing = power_of(last, whole - degree(monomial));
                (kernel::product(monomial, &missing), value.clone())
            });
            Polynomial::from_terms(terms)
        };
        return Ok(Some(parts.iter().map(homogeneous).collect()));
    }
    split_by_substitution(p, generators, steps)
}

fn common_step(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { common_step(b, a % b) }
}

/// The polynomial with the exponents of a generator changed.
fn with_exponents(p: &Polynomial, generator: Term, new: impl Fn(u32) -> u32) -> Polynomial {
    let terms = p.terms().iter().map(|(monomial, value)| {
        let changed = monomial
            .iter()
            .map(|&(term, n)| (term, if term == generator { new(n) } else { n }));
        (changed.filter(|(_, n)| *n > 0).collect(), value.clone())
    });
    Polynomial::from_terms(terms)
}

/// Kronecker's substitution: `x_i = t^(D_i)`, where digits to the bases `degree + 1` give the exponents back.
fn split_by_substitution(p: &Polynomial, generators: &[Term], steps: &mut Steps) -> Result<Option<Vec<Polynomial>>> {
    let bases: Vec<u32> = generators
        .iter()
        .map(|&generator| degree_in(p, generator) + 1)
        .collect();
    let size = bases.iter().try_fold(1u32, |size, base| size.checked_mul(*base));
    if size.is_none_or(|size| size > MOST_DEGREE + 1) {
        return Ok(None);
    }
    let place = |at: usize| bases[..at].iter().product::<u32>();
    let t = generators[0];
    let image = p.terms().iter().map(|(monomial, value)| {
        let power = generators
            .iter()
            .enumerate()
            .map(|(at, &term)| exponent(monomial, term) * place(at))
            .sum();
        (power_of(t, power), value.clone())
    });
    let image = Polynomial::from_terms(image);
    let pool: Vec<Polynomial> = (factors(&image, &[], steps)?.factors.into_iter())
        .flat_map(|(factor, exponent)| std::iter::repeat_n(factor, exponent as usize))
        .collect();
    let decoded = |image: &Polynomial| {
        let terms = image.terms().iter().map(|(monomial, value)| {
            let power = exponent(monomial, t);
            let digits = generators
                .iter()
                .enumerate()
                .map(|(at, &term)| (term, power / place(at) % bases[at]));
            let mut digits: kernel::Monomial = digits.filter(|(_, n)| *n > 0).collect();
            digits.sort_unstable();
            (digits, value.clone())
        });
        Polynomial::from_terms(terms)
    };
    for size in 1..=pool.len() / 2 {
        let mut chosen: Vec<usize> = (0..size).collect();
        loop {
            let mut product = Polynomial::integer(1);
            for &index in &chosen {
                product = times(&product, &pool[index], steps)?;
            }
            let candidate = decoded(&product);
            if !is_constant(&candidate)
                && let Some(quotient) = exact_quotient(p, &candidate, steps)?
                && !is_constant(&quotient)
            {
                return Ok(Some(vec![candidate, quotient]));
            }
            if !next_subset(&mut chosen, pool.len()) {
                break;
            }
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{any_polynomial, plenty, poly};
    use super::*;
    use proptest::prelude::*;

    fn multiplied_out(found: &Factors) -> Polynomial {
        found
            .factors
            .iter()
            .fold(Polynomial::constant(&found.constant), |product, (factor, exponent)| {
                (0..*exponent).fold(product, |product, _| product.times(factor))
            })
    }

    /// The numbers of factors, each with its exponent, of products of irreducible polynomials.
    #[test]
    fn known_factors() {
        for (text, count) in [
            ("6x^2 y - 6y^3", 3),
            ("x^4 + 4", 2),
            ("x^4 + 4y^4", 2),
            ("x^4 - y^4", 3),
            ("x^12 - 1", 6),
            ("x^4 - 10x^2 + 1", 1),
            ("x^8 - 40x^6 + 352x^4 - 960x^2 + 576", 1),
            ("(x^2 - 5) (2x^3 - x + 7)^2 (3/5 x + 1)", 4),
            ("(x^3 + y^2 - 1) (x + y^3)", 2),
            ("(a b - c) (a^2 - b c) (a + c + 1)^2", 4),
            ("x^24 - 1", 8),
            ("(x^2 + y^2 - 1) (x^2 - 2y^2)", 2),
            ("x^2 + y^2", 1),
            ("-7/3", 0),
        ] {
            let found = factors(&poly(text), &[], &mut plenty()).unwrap();
            assert_eq!(multiplied_out(&found), poly(text), "{text}");
            assert_eq!(
                found.factors.iter().map(|(_, exponent)| exponent).sum::<u32>(),
                count,
                "{text}"
            );
        }
        // a hint splits what would be too large for Kronecker's substitution
        let (p, q) = (
            poly("a^3 + b^3 c^2 + d^3 + c^5 + 1"),
            poly("a^4 - b^3 d + c^4 + d^4 + 2"),
        );
        let found = factors(&p.times(&q), std::slice::from_ref(&q), &mut plenty()).unwrap();
        assert_eq!(found.factors.len(), 2);
    }

    proptest! {
        #[test]
        fn factors_multiply_out(
            p in any_polynomial(2, 3, 2),
            q in any_polynomial(3, 3, 2),
            r in any_polynomial(1, 4, 3),
        ) {
            let product = p.times(&q).times(&r).times(&r);
            let found = factors(&product, std::slice::from_ref(&p), &mut plenty()).unwrap();
            prop_assert_eq!(multiplied_out(&found), product);
            for (index, (a, _)) in found.factors.iter().enumerate() {
                for (b, _) in &found.factors[..index] {
                    prop_assert!(is_constant(&gcd(a, b, &mut plenty()).unwrap()));
                }
            }
        }
    }
}
