//! Positivity: certificates of small degree that a polynomial is positive, or not negative, where other polynomials
//! are and some are 0.
//!
//! Sources: Stengle, A Nullstellensatz and a Positivstellensatz in semialgebraic geometry, Math. Ann. 207 (1974);
//! Handelman, Representing polynomials by positive linear functions, Pacific J. Math. 132 (1988); Ahmadi, Majumdar,
//! DSOS and SDSOS optimization, SIAM J. Appl. Algebra Geom. 3 (2019), for sums of squares by linear programming.

use super::division::{coefficients_in, combination, degree_in, is_constant, power, times, total_degree};
use super::factor::factors;
use super::groebner::{Basis, groebner};
use super::linear::integral_row;
use super::order::Order;
use super::simplex::nonnegative_solution;
use super::steps::{Result, Steps};
use dashu_ratio::RBig;
use kernel::{Monomial, Polynomial, Term};
use num_traits::{One, Zero};
use numbers::Rational;
use std::collections::{BTreeMap, BTreeSet};

/// A polynomial that is positive, or at least not negative.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    pub polynomial: Polynomial,
    /// Whether it is not 0 either.
    pub strict: bool,
}

/// `coefficient * prod facts[j]^exponents[j] * square^2`, where the coefficient is above 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Summand {
    pub coefficient: Rational,
    pub exponents: Vec<u32>,
    pub square: Polynomial,
}

/// `p * prod facts[j]^multiplier[j] = sum of summands + sum cofactors[i] * zeros[i]`.
///
/// Only strict facts occur in the multiplier, so that p is not negative. It is positive where `strict` is set: then
/// some summand has a constant square and no fact that is not strict.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Certificate {
    pub multiplier: Vec<u32>,
    pub summands: Vec<Summand>,
    pub cofactors: Vec<Polynomial>,
    pub strict: bool,
}

/// The most summands that one linear program chooses from.
const MOST_ATOMS: usize = 400;
/// With so few monomials, sums with weights up to 3 are squared, too.
const FEW_MONOMIALS: usize = 5;
/// What it costs, in steps, to look for what reduces a term.
const COST_OF_TERM: u64 = 10;
/// The most monomials whose sums and differences are squared.
const MOST_MONOMIALS: usize = 12;

/// Looks for a certificate that p is not negative, or positive where `strict`. Not complete: products of at most
/// three facts (more where there are at most three), squares of sums of two monomials, quadratic forms, and what
/// factors and discriminants reduce to these.
pub fn positive(
    p: &Polynomial,
    strict: bool,
    facts: &[Fact],
    zeros: &[Polynomial],
    steps: &mut Steps,
) -> Result<Option<Certificate>> {
    let basis = if zeros.iter().all(Polynomial::is_zero) {
        None
    } else {
        Some(groebner(zeros, &Order::triangular(zeros), steps)?)
    };
    let search = Search { facts, basis };
    let Some(found) = search.by_factors(p, strict, steps)? else {
        return Ok(None);
    };
    search.certificate(p, found, zeros.len(), steps)
}

/// A certificate without its cofactors.
#[derive(Clone, Debug)]
struct Found {
    multiplier: Vec<u32>,
    summands: Vec<Summand>,
}

/// A summand with coefficient 1, and its normal form.
struct Atom {
    exponents: Vec<u32>,
    square: Polynomial,
    value: Polynomial,
}

struct Search<'a> {
    facts: &'a [Fact],
    basis: Option<Basis>,
}

impl Search<'_> {
    fn normal_form(&self, p: &Polynomial, steps: &mut Steps) -> Result<Polynomial> {
        match &self.basis {
            None => Ok(p.clone()),
            Some(basis) => {
                steps.take(COST_OF_TERM * p.terms().len() as u64)?;
                basis.normal_form(p, steps)
            }
        }
    }

    fn none(&self) -> Vec<u32> {
        vec![0; self.facts.len()]
    }

    /// Whether a summand is positive, not only not negative.
    fn is_strict(&self, exponents: &[u32], square: &Polynomial) -> bool {
        let strict = self
            .facts
            .iter()
            .zip(exponents)
            .all(|(fact, &exponent)| fact.strict || exponent == 0);
        strict && is_constant(square) && !square.is_zero()
    }

    fn product(&self, exponents: &[u32], steps: &mut Steps) -> Result<Polynomial> {
        let mut product = Polynomial::integer(1);
        for (fact, &exponent) in self.facts.iter().zip(exponents) {
            product = times(&product, &power(&fact.polynomial, exponent, steps)?, steps)?;
        }
        Ok(product)
    }

    /// Multiplies out, and finds the cofactors of what is left; `None` where it is not in the ideal of the zeros.
    fn certificate(
        &self,
        p: &Polynomial,
        found: Found,
        zeros: usize,
        steps: &mut Steps,
    ) -> Result<Option<Certificate>> {
        let mut left = times(p, &self.product(&found.multiplier, steps)?, steps)?;
        for summand in &found.summands {
            let square = times(&summand.square, &summand.square, steps)?;
            let value = times(&self.product(&summand.exponents, steps)?, &square, steps)?;
            left = left.minus(&value.scaled(&summand.coefficient));
        }
        let cofactors = match &self.basis {
            None if left.is_zero() => vec![Polynomial::default(); zeros],
            None => return Ok(None),
            Some(basis) => match basis.member(&left, steps)? {
                Some(cofactors) => cofactors,
                None => return Ok(None),
            },
        };
        let strict = found
            .summands
            .iter()
            .any(|summand| self.is_strict(&summand.exponents, &summand.square));
        Ok(Some(Certificate {
            multiplier: found.multiplier,
            summands: found.summands,
            cofactors,
            strict,
        }))
    }

    /// A product is positive where its factors are, or an even number of them is negative.
    fn by_factors(&self, p: &Polynomial, strict: bool, steps: &mut Steps) -> Result<Option<Found>> {
        let p = self.normal_form(p, steps)?;
        if p.is_zero() {
            return Ok((!strict).then(|| Found {
                multiplier: self.none(),
                summands: Vec::new(),
            }));
        }
        let hints: Vec<Polynomial> = self.facts.iter().map(|fact| fact.polynomial.clone()).collect();
        let factors = factors(&p, &hints, steps)?;
        if let [(_, 1)] | [] = factors.factors.as_slice() {
            return self.directly(&p, strict, 2, steps);
        }
        let one = Summand {
            coefficient: Rational::one(),
            exponents: self.none(),
            square: Polynomial::integer(1),
        };
        let (mut product, mut sign) = (
            Found {
                multiplier: self.none(),
                summands: vec![one],
            },
            factors.constant.clone(),
        );
        for (factor, exponent) in &factors.factors {
            let times_factor = if strict { *exponent } else { exponent % 2 };
            if !strict {
                for summand in &mut product.summands {
                    summand.square = times(&summand.square, &power(factor, exponent / 2, steps)?, steps)?;
                }
            }
            if times_factor == 0 {
                continue;
            }
            let share = steps.left() / 4;
            let mut found = None;
            for negate in [false, true] {
                let signed = if negate { factor.negated() } else { factor.clone() };
                found = steps
                    .attempt(share, |steps| self.directly(&signed, strict, 2, steps))
                    .flatten();
                if found.is_some() {
                    if negate && times_factor % 2 == 1 {
                        sign = -sign;
                    }
                    break;
                }
            }
            let Some(found) = found else {
                return self.directly(&p, strict, 2, steps);
            };
            for _ in 0..times_factor {
                product = multiplied(&product, &found, steps)?;
            }
        }
        if sign.0 < RBig::ZERO {
            return self.directly(&p, strict, 2, steps);
        }
        for summand in &mut product.summands {
            summand.coefficient = summand.coefficient.clone() * sign.clone();
        }
        Ok(Some(product))
    }

    /// The searches for one polynomial in normal form, the cheap ones first.
    fn directly(&self, p: &Polynomial, strict: bool, depth: u32, steps: &mut Steps) -> Result<Option<Found>> {
        if let Some(value) = p.as_constant() {
            let enough = if strict {
                value.0 > RBig::ZERO
            } else {
                value.0 >= RBig::ZERO
            };
            let summand = Summand {
                coefficient: value,
                exponents: self.none(),
                square: Polynomial::integer(1),
            };
            let summands = if summand.coefficient.is_zero() {
                Vec::new()
            } else {
                vec![summand]
            };
            return Ok(enough.then(|| Found {
                multiplier: self.none(),
                summands,
            }));
        }
        if let Some(found) = self.term_by_term(p, strict) {
            return Ok(Some(found));
        }
        let share = steps.left() / 8;
        let one = self.none();
        for degree in 1..=2 {
            let attempt = |steps: &mut Steps| self.by_linear_program(p, &one, degree, false, strict, steps);
            if let Some(found) = steps.attempt(share, attempt).flatten() {
                return Ok(Some(found));
            }
        }
        if let Some(found) = self.quadratic_form(p, strict, steps)? {
            return Ok(Some(found));
        }
        if depth > 0
            && let Some(found) = self.by_discriminant(p, strict, depth, steps)?
        {
            return Ok(Some(found));
        }
        // few facts, such as the ends of an interval: their products of higher degree (Bernstein's form)
        let few = match self.connected(p).len() {
            0..=2 => total_degree(p).max(3) + 4,
            3 => 6,
            _ => 3,
        };
        for (degree, squares) in [(1, true), (few, false), (2, true)] {
            let attempt = |steps: &mut Steps| self.by_linear_program(p, &one, degree, squares, strict, steps);
            if let Some(found) = steps.attempt(share, attempt).flatten() {
                return Ok(Some(found));
            }
        }
        for (index, fact) in self.facts.iter().enumerate() {
            if fact.strict && !is_constant(&fact.polynomial) {
                let mut multiplier = self.none();
                multiplier[index] = 1;
                let attempt = |steps: &mut Steps| self.by_linear_program(p, &multiplier, 2, true, strict, steps);
                if let Some(found) = steps.attempt(share / 4, attempt).flatten() {
                    return Ok(Some(found));
                }
            }
        }
        Ok(None)
    }

    /// Every term is a positive number times facts that are generators times a square.
    fn term_by_term(&self, p: &Polynomial, strict: bool) -> Option<Found> {
        let mut summands = Vec::with_capacity(p.terms().len());
        for (monomial, value) in p.terms() {
            let (mut coefficient, mut exponents) = (value.clone(), self.none());
            let mut square = Monomial::new();
            for &(term, exponent) in monomial {
                let known = self
                    .facts
                    .iter()
                    .enumerate()
                    .filter_map(|(index, fact)| match fact.polynomial.terms() {
                        [(single, factor)] if single.as_slice() == [(term, 1)] => Some((index, factor, fact.strict)),
                        _ => None,
                    });
                // a strict fact if there is one: then even powers are positive, too
                let known = known.max_by_key(|(_, _, strict)| *strict);
                match known {
                    Some((index, factor, is_strict)) if is_strict || exponent % 2 == 1 => {
                        let times = if is_strict { exponent } else { 1 };
                        exponents[index] += times;
                        coefficient /= factor.pow(times as isize);
                        square.extend((exponent > times).then_some((term, (exponent - times) / 2)));
                    }
                    _ if exponent % 2 == 0 => square.push((term, exponent / 2)),
                    _ => return None,
                }
            }
            if coefficient < RBig::ZERO {
                return None;
            }
            let square = Polynomial::from_terms([(square, RBig::ONE)]);
            summands.push(Summand {
                coefficient: Rational(coefficient),
                exponents,
                square,
            });
        }
        let enough = !strict
            || summands
                .iter()
                .any(|summand| self.is_strict(&summand.exponents, &summand.square));
        enough.then(|| Found {
            multiplier: self.none(),
            summands,
        })
    }

    /// The facts that are connected with p by generators; others say nothing about it.
    fn connected(&self, p: &Polynomial) -> Vec<usize> {
        let mut generators: BTreeSet<Term> = p.generators().into_iter().chain(self.bound_with(p)).collect();
        let mut connected = BTreeSet::new();
        loop {
            let before = connected.len();
            for (index, fact) in self.facts.iter().enumerate() {
                let held = fact.polynomial.generators();
                if held.iter().any(|term| generators.contains(term)) {
                    connected.insert(index);
                    generators.extend(held);
                }
            }
            if connected.len() == before {
                return connected.into_iter().collect();
            }
        }
    }

    /// Products of at most so many of these facts, as exponents, those of few facts first.
    fn products(&self, facts: &[usize], degree: u32) -> Vec<Vec<u32>> {
        let mut all = vec![self.none()];
        let mut last = all.clone();
        for _ in 0..degree {
            let mut next = BTreeSet::new();
            for product in &last {
                for &index in facts {
                    let mut more = product.clone();
                    more[index] += 1;
                    next.insert(more);
                }
            }
            last = next.into_iter().collect();
            all.extend(last.iter().cloned());
            if all.len() > MOST_ATOMS {
                break;
            }
        }
        all.truncate(MOST_ATOMS);
        all
    }

    /// `p * multiplier` as a sum, with positive coefficients, of products of facts and, where wanted, their products
    /// with squares of monomials and of sums and differences of two monomials.
    fn by_linear_program(
        &self,
        p: &Polynomial,
        multiplier: &[u32],
        degree: u32,
        squares: bool,
        strict: bool,
        steps: &mut Steps,
    ) -> Result<Option<Found>> {
        let target = times(p, &self.product(multiplier, steps)?, steps)?;
        let target = self.normal_form(&target, steps)?;
        let mut bases = vec![Polynomial::integer(1)];
        if squares {
            let monomials = half_monomials(&target, &self.bound_with(&target));
            for (index, a) in monomials.iter().enumerate() {
                bases.extend((!is_constant(a)).then(|| a.clone()));
                for b in &monomials[..index] {
                    bases.extend([a.plus(b), a.minus(b)]);
                    if monomials.len() <= FEW_MONOMIALS {
                        let ratios = [(2, 1), (1, 2), (3, 1), (1, 3), (3, 2), (2, 3)];
                        let weighted = ratios.map(|(n, m)| [(n, m), (n, -m)]).into_iter().flatten();
                        bases.extend(weighted.map(|(n, m)| scaled(a, n).plus(&scaled(b, m))));
                    }
                }
            }
        }
        let mut atoms: Vec<Atom> = Vec::new();
        let most_degree = total_degree(&target).max(degree).max(2) + u32::from(!squares);
        for exponents in self.products(&self.connected(&target), degree) {
            let product = self.normal_form(&self.product(&exponents, steps)?, steps)?;
            for square in &bases {
                if atoms.len() >= MOST_ATOMS || total_degree(&product) + 2 * total_degree(square) > most_degree {
                    continue;
                }
                let value = times(&product, &times(square, square, steps)?, steps)?;
                let value = self.normal_form(&value, steps)?;
                atoms.push(Atom {
                    exponents: exponents.clone(),
                    square: square.clone(),
                    value,
                });
            }
        }
        let Some(found) = self.chosen(&target, &atoms, strict, steps)? else {
            return Ok(None);
        };
        let summands = found.into_iter().map(|(index, coefficient)| {
            let atom = &atoms[index];
            Summand {
                coefficient,
                exponents: atom.exponents.clone(),
                square: atom.square.clone(),
            }
        });
        Ok(Some(Found {
            multiplier: multiplier.to_vec(),
            summands: summands.collect(),
        }))
    }

    /// The generators that the zeros hold together with one of p's.
    fn bound_with(&self, p: &Polynomial) -> BTreeSet<Term> {
        let own = p.generators();
        let elements = self
            .basis
            .iter()
            .flat_map(|basis| basis.elements())
            .map(Polynomial::generators);
        elements
            .filter(|held| held.iter().any(|term| own.contains(term)))
            .flatten()
            .collect()
    }

    /// Coefficients above 0 of atoms whose sum is the target.
    fn chosen(
        &self,
        target: &Polynomial,
        atoms: &[Atom],
        strict: bool,
        steps: &mut Steps,
    ) -> Result<Option<Vec<(usize, Rational)>>> {
        let mut entries: BTreeMap<&Monomial, Vec<(usize, &RBig)>> = BTreeMap::new();
        let columns = atoms.iter().map(|atom| &atom.value).chain([target]);
        for (column, p) in columns.enumerate() {
            for (monomial, value) in p.terms() {
                entries.entry(monomial).or_default().push((column, value));
            }
        }
        steps.take((entries.len() * atoms.len()) as u64)?;
        let rows = entries.values().map(|entries| {
            let mut row = vec![RBig::ZERO; atoms.len() + 1];
            entries
                .iter()
                .for_each(|(column, value)| row[*column] = (*value).clone());
            integral_row(&row)
        });
        let favoured: Vec<bool> = atoms
            .iter()
            .map(|atom| self.is_strict(&atom.exponents, &atom.square))
            .collect();
        nonnegative_solution(
            rows.collect(),
            atoms.len(),
            strict.then_some(favoured.as_slice()),
            steps,
        )
    }

    /// A quadratic polynomial with constant coefficients as a sum of squares, by completing squares.
    fn quadratic_form(&self, p: &Polynomial, strict: bool, steps: &mut Steps) -> Result<Option<Found>> {
        if total_degree(p) != 2 {
            return Ok(None);
        }
        let (mut rest, mut summands) = (p.clone(), Vec::new());
        for generator in p.generators() {
            let coefficients = coefficients_in(&rest, generator);
            let [_, linear, square] = coefficients.as_slice() else {
                // a generator that is left without its square is in no sum of squares
                if degree_in(&rest, generator) > 0 {
                    return Ok(None);
                }
                continue;
            };
            let Some(pivot) = square.as_constant().filter(|pivot| pivot.0 > RBig::ZERO) else {
                return Ok(None);
            };
            // a x^2 + b x = a (x + b/(2a))^2 - ..
            let half = linear.scaled(&(Rational::one() / (pivot.clone() + pivot.clone())));
            let root = Polynomial::generator(generator).plus(&half);
            rest = rest.minus(&times(&root, &root, steps)?.scaled(&pivot));
            summands.push(Summand {
                coefficient: pivot,
                exponents: self.none(),
                square: root,
            });
        }
        let Some(constant) = rest.as_constant() else {
            return Ok(None);
        };
        if constant.0 < RBig::ZERO || strict && constant.is_zero() {
            return Ok(None);
        }
        if !constant.is_zero() {
            let square = Polynomial::integer(1);
            summands.push(Summand {
                coefficient: constant,
                exponents: self.none(),
                square,
            });
        }
        Ok(Some(Found {
            multiplier: self.none(),
            summands,
        }))
    }

    /// `4a (a x^2 + b x + c) = (2a x + b)^2 + (4ac - b^2)`, where `a` is a number times strict facts and
    /// `4ac - b^2` is positive.
    fn by_discriminant(&self, p: &Polynomial, strict: bool, depth: u32, steps: &mut Steps) -> Result<Option<Found>> {
        for generator in p.generators() {
            let coefficients = coefficients_in(p, generator);
            let [c, b, a] = coefficients.as_slice() else { continue };
            let Some((factor, multiplier)) = self.as_product(a, steps)? else {
                continue;
            };
            let four = Rational(RBig::from(4));
            let rest = times(a, c, steps)?.scaled(&four).minus(&times(b, b, steps)?);
            let rest = self.normal_form(&rest, steps)?;
            let share = steps.left() / 4;
            let attempt = |steps: &mut Steps| self.directly(&rest, strict, depth - 1, steps);
            let Some(mut found) = steps.attempt(share, attempt).flatten() else {
                continue;
            };
            // the multiplier that the rest needs is put on the square, too
            let twice = a.scaled(&Rational(RBig::from(2)));
            let square = times(&twice, &Polynomial::generator(generator), steps)?.plus(b);
            found.summands.push(Summand {
                coefficient: Rational::one(),
                exponents: found.multiplier.clone(),
                square,
            });
            for (known, more) in found.multiplier.iter_mut().zip(&multiplier) {
                *known += more;
            }
            let scale = four * factor;
            for summand in &mut found.summands {
                summand.coefficient = summand.coefficient.clone() / scale.clone();
            }
            return Ok(Some(found));
        }
        Ok(None)
    }

    /// A positive number and exponents of strict facts whose product p is.
    fn as_product(&self, p: &Polynomial, steps: &mut Steps) -> Result<Option<(Rational, Vec<u32>)>> {
        let mut exponents = self.none();
        let mut rest = p.clone();
        for (index, fact) in self.facts.iter().enumerate() {
            if !fact.strict || is_constant(&fact.polynomial) {
                continue;
            }
            while !is_constant(&rest)
                && let Some(quotient) = super::division::exact_quotient(&rest, &fact.polynomial, steps)?
            {
                rest = quotient;
                exponents[index] += 1;
            }
        }
        Ok(rest
            .as_constant()
            .filter(|value| value.0 > RBig::ZERO)
            .map(|value| (value, exponents)))
    }
}

fn scaled(p: &Polynomial, factor: i64) -> Polynomial {
    p.scaled(&Rational(RBig::from(factor)))
}

/// The product of two sums of summands.
fn multiplied(a: &Found, b: &Found, steps: &mut Steps) -> Result<Found> {
    let added = |a: &[u32], b: &[u32]| a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<u32>>();
    let mut summands = Vec::with_capacity(a.summands.len() * b.summands.len());
    for x in &a.summands {
        for y in &b.summands {
            summands.push(Summand {
                coefficient: x.coefficient.clone() * y.coefficient.clone(),
                exponents: added(&x.exponents, &y.exponents),
                square: times(&x.square, &y.square, steps)?,
            });
        }
    }
    Ok(Found {
        multiplier: added(&a.multiplier, &b.multiplier),
        summands,
    })
}

/// Monomials whose squares may be needed in a sum of squares: at most half the degree in each generator and in all,
/// and at most linear in the others that are bound to these, those whose squares are terms of p first.
fn half_monomials(p: &Polynomial, bound: &BTreeSet<Term>) -> Vec<Polynomial> {
    let half = total_degree(p).div_ceil(2).max(u32::from(!bound.is_empty()));
    let mut monomials = vec![Monomial::new()];
    let generators: BTreeSet<Term> = p.generators().into_iter().chain(bound.iter().copied()).collect();
    for generator in generators {
        let most = degree_in(p, generator)
            .div_ceil(2)
            .max(u32::from(bound.contains(&generator)));
        let longer = monomials.iter().flat_map(|monomial| {
            let degree: u32 = monomial.iter().map(|(_, exponent)| exponent).sum();
            (0..=most.min(half - degree)).map(move |exponent| {
                let mut monomial = monomial.clone();
                monomial.extend((exponent > 0).then_some((generator, exponent)));
                monomial
            })
        });
        monomials = longer.take(2000).collect();
    }
    let present: BTreeSet<&Monomial> = p.terms().iter().map(|(monomial, _)| monomial).collect();
    let square = |monomial: &Monomial| monomial.iter().map(|&(term, n)| (term, 2 * n)).collect::<Monomial>();
    let degree = |monomial: &Monomial| monomial.iter().map(|(_, n)| n).sum::<u32>();
    monomials.sort_by_key(|monomial| (!present.contains(&square(monomial)), degree(monomial)));
    monomials.truncate(MOST_MONOMIALS);
    monomials
        .into_iter()
        .map(|monomial| Polynomial::from_terms([(monomial, RBig::ONE)]))
        .collect()
}

/// The value of a certificate's right side, for its check: `sum of summands + sum cofactors[i] * zeros[i]`.
pub fn right_side(
    certificate: &Certificate,
    facts: &[Fact],
    zeros: &[Polynomial],
    steps: &mut Steps,
) -> Result<Polynomial> {
    let search = Search { facts, basis: None };
    let mut sum = combination(certificate.cofactors.iter().zip(zeros), steps)?;
    for summand in &certificate.summands {
        let square = times(&summand.square, &summand.square, steps)?;
        let product = times(&search.product(&summand.exponents, steps)?, &square, steps)?;
        sum = sum.plus(&product.scaled(&summand.coefficient));
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{any_polynomial, plenty, poly, polys};
    use super::*;
    use proptest::prelude::*;

    fn facts(texts: &[&str]) -> Vec<Fact> {
        // "x" is x > 0, "=x" is x >= 0
        let fact = |text: &&str| Fact {
            polynomial: poly(text.trim_start_matches('=')),
            strict: !text.starts_with('='),
        };
        texts.iter().map(fact).collect()
    }

    fn proved(
        p: &Polynomial,
        strict: bool,
        facts: &[Fact],
        zeros: &[Polynomial],
        steps: &mut Steps,
    ) -> Option<Certificate> {
        let certificate = positive(p, strict, facts, zeros, steps).unwrap()?;
        let multiplier = Search { facts, basis: None }
            .product(&certificate.multiplier, &mut plenty())
            .unwrap();
        assert_eq!(
            p.times(&multiplier),
            right_side(&certificate, facts, zeros, &mut plenty()).unwrap()
        );
        assert!(
            facts
                .iter()
                .zip(&certificate.multiplier)
                .all(|(fact, exponent)| fact.strict || *exponent == 0)
        );
        assert!(
            certificate
                .summands
                .iter()
                .all(|summand| summand.coefficient.0 > RBig::ZERO)
        );
        let strictly = certificate.summands.iter().any(|summand| {
            let strict = facts
                .iter()
                .zip(&summand.exponents)
                .all(|(fact, exponent)| fact.strict || *exponent == 0);
            strict && is_constant(&summand.square) && !summand.square.is_zero()
        });
        assert_eq!(certificate.strict, strictly);
        assert!(strictly || !strict);
        Some(certificate)
    }

    #[test]
    fn known_positive() {
        for (p, strict, given, zeros) in [
            ("3x^3 y^2 + 2 x + 1", true, &["x"][..], &[][..]),
            ("x^2 y + x", true, &["x", "=y"], &[]),
            ("x^2 - x y + y^2", false, &[], &[]),
            ("x^2 - 3x y + 3y^2 + 1", true, &[], &[]),
            ("x^2 - 2x + 1", false, &[], &[]),
            ("1 - a b", true, &["1 - a", "1 - b", "a", "b"], &[]),
            ("1 + r^2 - 2 r c", true, &["1 - r", "r", "=1 - c", "=1 + c"], &[]),
            ("(1 - r)^3 (2 + r)", true, &["1 - r", "r"], &[]),
            ("-(r - 1) (r + 1)", true, &["1 - r", "r"], &[]),
            ("1 - s", false, &[], &["s^2 + c^2 - 1"]),
            ("a x^2 + b x + c", true, &["a", "4a c - b^2"], &[]),
            ("y", true, &["x", "x y - 1"], &[]),
            ("x^4 - 2x^3 + 3x^2 - 2x + 2", true, &[], &[]),
            ("x^4 + y^4 + z^4 - x y z (x + y + z)", false, &[], &[]),
            // the least values in the interval are about 0.01
            ("3x^2 - 3x + 1/5 + 14/25", true, &["x", "1 - x"], &[]),
            ("x^3 - x + 2/5", true, &["x", "1 - x"], &[]),
            ("a^2 - 3a b + 5/2 b^2", false, &[], &[]),
            ("2a^4 - 6a^2 b + 5b^2 + a", true, &["a"], &[]),
            ("u v + 2 - u - v", true, &["=u - 2", "v - 1"], &[]),
        ] {
            let (given, zeros) = (facts(given), polys(zeros));
            let steps = &mut Steps::new(40_000_000);
            let found = proved(&poly(p), strict, &given, &zeros, steps);
            println!("{p}: {} {}", found.is_some(), 40_000_000 - steps.left());
            assert!(found.is_some(), "{p}");
        }
        for (p, strict, given) in [
            ("x", false, &[][..]),
            ("x^2", true, &[]),
            ("x - 1", false, &["x"]),
            ("1 - 3x + x^2", false, &["x"]),
        ] {
            assert_eq!(proved(&poly(p), strict, &facts(given), &[], &mut plenty()), None, "{p}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn what_is_found_multiplies_out(
            p in any_polynomial(3, 4, 2),
            f in any_polynomial(3, 2, 1),
            g in any_polynomial(2, 2, 1),
            strict: bool,
        ) {
            let facts = vec![
                Fact { polynomial: f, strict: true },
                Fact { polynomial: g, strict: false },
                Fact { polynomial: poly("a"), strict: true },
            ];
            if let Ok(Some(_)) = positive(&p, strict, &facts, &[], &mut Steps::new(2_000_000)) {
                proved(&p, strict, &facts, &[], &mut Steps::new(2_000_000));
            }
            if let Ok(Some(_)) = positive(&p.times(&p), false, &facts, &[poly("a b - 1")], &mut Steps::new(2_000_000)) {
                proved(&p.times(&p), false, &facts, &[poly("a b - 1")], &mut Steps::new(2_000_000));
            }
        }
    }
}
