//! The field that an antiderivative is looked for in: what the integrand and the derivatives of its functions are made of.

use super::fraction::{Fraction, times};
use super::tangents::{Tangent, tangents};
use super::tower::{Kind, Tower, VARIABLE};
use crate::algebra::{degree_in, derivative, exact_quotient, factors, gcd, power};
use kernel::{Polynomial, Term};
use std::collections::BTreeMap;

/// A factor below the integrand or the derivatives of the generators.
pub(super) struct Divisor {
    pub factor: Polynomial,
    /// Its exponent below the integrand.
    pub exponent: u32,
    /// True if it divides its derivative.
    pub is_special: bool,
}

/// The field that an antiderivative is looked for in.
pub(super) struct Field {
    pub integrand: Fraction,
    pub generators: Vec<Term>,
    pub tangents: Vec<Tangent>,
    pub slopes: BTreeMap<Term, Polynomial>,
    /// The common denominator of the derivatives of the generators.
    pub common: Polynomial,
    pub divisors: Vec<Divisor>,
    /// The factor of the integrand's denominator that holds letters alone.
    pub constant: Polynomial,
}

/// The generators that the integrand and their derivatives hold.
fn closed(f: &Fraction, tower: &mut Tower) -> Option<Vec<Term>> {
    let mut all = vec![VARIABLE];
    let mut open = f.generators();
    while let Some(term) = open.pop() {
        if all.contains(&term) || !tower.varies(term) {
            continue;
        }
        all.push(term);
        if !matches!(tower.kind(term), Kind::Unknown(..)) {
            open.extend(tower.slope(term)?.generators());
        }
        if all.len() > 9 {
            return None;
        }
    }
    Some(all)
}

impl Field {
    pub fn of(f: &Fraction, tower: &mut Tower) -> Option<Self> {
        let mut generators = closed(f, tower)?;
        add_antiderivatives(&mut generators, tower);
        let mut told = vec![f.clone()];
        for term in &generators {
            if !matches!(tower.kind(*term), Kind::Sine(_) | Kind::Cosine(_)) {
                told.push(tower.slope(*term)?);
            }
        }
        let tangents = tangents(tower, &told)?;
        generators.retain(|term| !matches!(tower.kind(*term), Kind::Sine(_) | Kind::Cosine(_)));
        generators.extend(tangents.iter().map(|tangent| tangent.tangent));
        generators.sort_unstable();
        let put_in =
            |f: Fraction, tower: &mut Tower| tangents.iter().try_fold(f, |f, tangent| tangent.put_in(&f, tower));
        let integrand = put_in(f.clone(), tower)?;
        let mut slopes = BTreeMap::new();
        let mut common = Polynomial::integer(1);
        for term in &generators {
            let slope = tower.slope(*term)?;
            let slope = put_in(slope, tower)?;
            let shared = gcd(&common, &slope.below, &mut tower.steps).ok()?;
            let rest = exact_quotient(&slope.below, &shared, &mut tower.steps).ok()??;
            common = times(&common, &rest, &mut tower.steps).ok()?;
            slopes.insert(*term, slope);
        }
        let mut raised = BTreeMap::new();
        for (term, slope) in slopes {
            let rest = exact_quotient(&common, &slope.below, &mut tower.steps).ok()??;
            raised.insert(term, times(&slope.above, &rest, &mut tower.steps).ok()?);
        }
        let mut field = Self {
            integrand,
            generators,
            tangents,
            slopes: raised,
            common,
            divisors: Vec::new(),
            constant: Polynomial::integer(1),
        };
        field.find_divisors(tower)?;
        Some(field)
    }

    fn find_divisors(&mut self, tower: &mut Tower) -> Option<()> {
        let of_common = factors(&self.common, &[], &mut tower.steps).ok()?;
        let hints: Vec<Polynomial> = of_common.factors.iter().map(|(factor, _)| factor.clone()).collect();
        let below = factors(&self.integrand.below, &hints, &mut tower.steps).ok()?;
        let mut constant = Polynomial::constant(&below.constant);
        let mut found: Vec<(Polynomial, u32)> = Vec::new();
        for (factor, exponent) in below.factors {
            match self.varies(&factor) {
                true => found.push((factor, exponent)),
                false => {
                    let factor = power(&factor, exponent, &mut tower.steps).ok()?;
                    constant = times(&constant, &factor, &mut tower.steps).ok()?;
                }
            }
        }
        for factor in hints {
            if self.varies(&factor) && !found.iter().any(|(known, _)| known.is_multiple_of(&factor)) {
                found.push((factor, 0));
            }
        }
        for (factor, exponent) in found {
            let slope = self.slope(&factor, tower)?;
            let reduced = Fraction::new(&slope, &self.common, &mut tower.steps)?;
            let is_special = exact_quotient(&reduced.above, &factor, &mut tower.steps)
                .ok()?
                .is_some();
            self.divisors.push(Divisor {
                factor,
                exponent,
                is_special,
            });
        }
        self.constant = constant;
        Some(())
    }

    /// The generator that a factor holds, if it holds one alone.
    pub fn only_generator(&self, factor: &Polynomial) -> Option<Term> {
        let mut varying = self.generators.iter().filter(|term| degree_in(factor, **term) > 0);
        varying.next().copied().filter(|_| varying.next().is_none())
    }

    pub fn varies(&self, p: &Polynomial) -> bool {
        p.generators().iter().any(|term| self.generators.contains(term))
    }

    /// The derivative of a polynomial, times the common denominator.
    pub fn slope(&self, p: &Polynomial, tower: &mut Tower) -> Option<Polynomial> {
        let mut total = Polynomial::default();
        for term in p.generators() {
            if let Some(slope) = self.slopes.get(&term) {
                total = total.plus(&times(&derivative(p, term), slope, &mut tower.steps).ok()?);
            }
        }
        tower.reduced(&total)
    }
}

/// The functions that unknown ones are derivatives of.
fn add_antiderivatives(generators: &mut Vec<Term>, tower: &mut Tower) {
    let mut open = generators.clone();
    while let Some(term) = open.pop() {
        let Kind::Unknown(name, argument) = tower.kind(term).clone() else {
            continue;
        };
        let Some(before) = tower.symbols.antiderivative_of(&name) else {
            continue;
        };
        let before = tower.term_of(Kind::Unknown(before, argument));
        if !generators.contains(&before) && generators.len() < 9 {
            generators.push(before);
            open.push(before);
        }
    }
}
