//! Polynomials in one generator modulo the prime 2^61 - 1: lists of coefficients, from the constant on, the last of
//! which is not 0.

use super::division::exponent;
use super::residue::{MODULUS, Residue};
use super::steps::{Result, Steps};
use kernel::{Polynomial, Term};

/// A polynomial in one generator modulo the prime.
pub(super) type Univariate = Vec<Residue>;

/// The polynomial in one generator with values for all others; `None` where the prime divides a denominator.
pub(super) fn univariate_mod(p: &Polynomial, generator: Term, values: &dyn Fn(Term) -> Residue) -> Option<Univariate> {
    let mut list = Univariate::new();
    for (monomial, coefficient) in p.terms() {
        let at = exponent(monomial, generator) as usize;
        if list.len() <= at {
            list.resize(at + 1, Residue::default());
        }
        let others = monomial.iter().filter(|(term, _)| *term != generator);
        let powers = others.map(|&(term, exponent)| values(term).power(u64::from(exponent)));
        list[at] = list[at] + powers.fold(Residue::of_rational(coefficient)?, |product, power| product * power);
    }
    trim(&mut list);
    Some(list)
}

/// A value for each generator that no polynomial singles out; other seeds give other values.
pub(super) fn pseudo_random(term: Term, seed: u64) -> Residue {
    // the finaliser of splitmix64 (Steele, Lea, Flood 2014)
    let mut z = (u64::from(term.0) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ seed.wrapping_mul(0xd1b5_4a32_d192_ed03);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    Residue::new(z ^ (z >> 31))
}

fn trim(list: &mut Univariate) {
    while list.last().is_some_and(|last| last.is_zero()) {
        list.pop();
    }
}

/// The polynomial divided by its leading coefficient.
pub(super) fn monic(mut p: Univariate) -> Univariate {
    if let Some(inverse) = p.last().and_then(|lead| lead.inverse()) {
        p.iter_mut().for_each(|value| *value = *value * inverse);
    }
    p
}

/// The product.
pub(super) fn product(a: &Univariate, b: &Univariate, steps: &mut Steps) -> Result<Univariate> {
    steps.take((a.len() * b.len()) as u64)?;
    let mut product = vec![Residue::default(); (a.len() + b.len()).saturating_sub(1)];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] = product[i + j] + *x * *y;
        }
    }
    trim(&mut product);
    Ok(product)
}

/// The quotient and the remainder; `(0, p)` where the divisor is 0.
fn divided(mut p: Univariate, divisor: &Univariate, steps: &mut Steps) -> Result<(Univariate, Univariate)> {
    let Some(inverse) = divisor.last().and_then(|lead| lead.inverse()) else {
        return Ok((Univariate::new(), p));
    };
    let mut quotient = vec![Residue::default(); (p.len() + 1).saturating_sub(divisor.len())];
    steps.take((quotient.len() * divisor.len()) as u64)?;
    for shift in (0..quotient.len()).rev() {
        let factor = p[shift + divisor.len() - 1] * inverse;
        quotient[shift] = factor;
        for (index, value) in divisor.iter().enumerate() {
            p[shift + index] = p[shift + index] - factor * *value;
        }
    }
    trim(&mut p);
    Ok((quotient, p))
}

/// The greatest common divisor, monic.
pub(super) fn gcd(mut a: Univariate, mut b: Univariate, steps: &mut Steps) -> Result<Univariate> {
    while !b.is_empty() {
        let (_, remainder) = divided(a, &b, steps)?;
        (a, b) = (b, remainder);
    }
    Ok(monic(a))
}

/// A power modulo a polynomial.
fn power(p: &Univariate, mut exponent: u64, modulo: &Univariate, steps: &mut Steps) -> Result<Univariate> {
    let (mut result, mut base) = (vec![Residue::new(1)], p.clone());
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = divided(product(&result, &base, steps)?, modulo, steps)?.1;
        }
        base = divided(product(&base, &base, steps)?, modulo, steps)?.1;
        exponent >>= 1;
    }
    Ok(result)
}

/// The irreducible factors, monic, of a polynomial without square factors.
///
/// Source: Cantor, Zassenhaus, A new algorithm for factoring polynomials over finite fields, Math. Comp. 36 (1981)
/// 587-592.
pub(super) fn irreducible_factors(p: &Univariate, steps: &mut Steps) -> Result<Vec<Univariate>> {
    let (mut factors, mut rest, mut degree) = (Vec::new(), monic(p.clone()), 0);
    let x = vec![Residue::default(), Residue::new(1)];
    let mut frobenius = x.clone();
    while rest.len() > 1 {
        degree += 1;
        if 2 * degree > rest.len() - 1 {
            factors.push(rest);
            break;
        }
        frobenius = power(&frobenius, MODULUS, &rest, steps)?;
        let mut difference = frobenius.clone();
        difference.resize(difference.len().max(2), Residue::default());
        difference[1] = difference[1] - Residue::new(1);
        trim(&mut difference);
        let part = gcd(rest.clone(), difference, steps)?;
        if part.len() > 1 {
            rest = divided(rest, &part, steps)?.0;
            frobenius = divided(frobenius, &rest, steps)?.1;
            split_equal_degrees(part, degree, &mut factors, steps)?;
        }
    }
    Ok(factors)
}

/// Splits a product of irreducible factors of one degree.
fn split_equal_degrees(p: Univariate, degree: usize, factors: &mut Vec<Univariate>, steps: &mut Steps) -> Result<()> {
    let mut open = vec![p];
    let mut seed = 1;
    while let Some(p) = open.pop() {
        if p.len() - 1 <= degree {
            factors.push(p);
            continue;
        }
        seed += 1;
        let mut trial: Univariate = (0..p.len() as u32 - 1).map(|i| pseudo_random(Term(i), seed)).collect();
        trim(&mut trial);
        // the norm to the prime field, and whether it is a square there: one half of the factors each
        let (mut norm, mut conjugate) = (trial.clone(), trial);
        for _ in 1..degree {
            conjugate = power(&conjugate, MODULUS, &p, steps)?;
            norm = divided(product(&norm, &conjugate, steps)?, &p, steps)?.1;
        }
        let mut symbol = power(&norm, (MODULUS - 1) / 2, &p, steps)?;
        symbol.resize(symbol.len().max(1), Residue::default());
        symbol[0] = symbol[0] - Residue::new(1);
        trim(&mut symbol);
        let part = gcd(p.clone(), symbol, steps)?;
        if part.len() > 1 && part.len() < p.len() {
            open.push(divided(p, &part, steps)?.0);
            open.push(part);
        } else {
            open.push(p);
        }
    }
    Ok(())
}
