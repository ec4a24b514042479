//! One ansatz for an antiderivative: a quotient with undetermined coefficients, and logarithms and angles with such.
//!
//! Source: Bronstein, Symbolic Integration I, chapter 10 (parallel integration); Geddes, Czapor, Labahn, Algorithms for
//! Computer Algebra, chapter 12.

use super::candidates::{Candidate, Logarithms};
use super::field::Field;
use super::fraction::{Fraction, times};
use super::linear::{Row, Scalar, solve};
use super::tangents::without_tangents;
use super::tower::{Kind, Tower};
use super::tree::{product, quotient, sum};
use crate::algebra::{coefficients_in, degree_in, derivative, exact_quotient, exponent, power};
use kernel::{Monomial, Polynomial, Term};
use num_traits::One;
use numbers::Rational;
use std::collections::BTreeMap;
use texmath::Tree;

/// The most undetermined coefficients, over the numbers and over quotients of letters.
const MOST: usize = 260;
const MOST_WITH_LETTERS: usize = 60;

impl Field {
    /// The antiderivative in the three spellings of its logarithms.
    pub fn integrated(&self, tower: &mut Tower) -> Option<Vec<Tree>> {
        let candidates = self.candidates(tower)?;
        let below = self.below(tower)?;
        let monomials = self.monomials(&below, tower)?;
        let (columns, right) = self.columns(&below, &monomials, &candidates, tower)?;
        let solution = self.coefficients(&columns, &right, tower)?;
        self.trees(&below, &monomials, &candidates, &solution, &self.constant, tower)
    }

    /// The value of the letter that is free, and the antiderivative of the integrand with it.
    pub fn integrated_with(&self, free: Term, tower: &mut Tower) -> Option<(Fraction, Tree)> {
        let candidates = self.candidates(tower)?;
        let below = self.below(tower)?;
        let monomials = self.monomials(&below, tower)?;
        let (mut columns, right) = self.columns(&below, &monomials, &candidates, tower)?;
        let [right, of_free] = coefficients_in(&right, free).try_into().ok()?;
        columns.push(of_free.negated());
        let mut solution = self.coefficients(&columns, &right, tower)?;
        let value = solution.remove(&(columns.len() - 1))?;
        let found = self.trees(&below, &monomials, &candidates, &solution, &self.constant, tower)?;
        Some((value, found.into_iter().next()?))
    }

    /// The denominator of the rational part.
    fn below(&self, tower: &mut Tower) -> Option<Polynomial> {
        let mut below = Polynomial::integer(1);
        for divisor in &self.divisors {
            let exponent = match divisor.is_special {
                true => divisor.exponent,
                false => divisor.exponent.saturating_sub(1),
            };
            let part = power(&divisor.factor, exponent, &mut tower.steps).ok()?;
            below = times(&below, &part, &mut tower.steps).ok()?;
        }
        Some(below)
    }

    /// The range of exponents of a generator above the rational part.
    fn range(&self, term: Term, below: &Polynomial, tower: &mut Tower) -> Option<(u32, u32)> {
        let of = |p: &Polynomial| degree_in(p, term);
        let (above, under) = (&self.integrand.above, &self.integrand.below);
        let excess = of(above).saturating_sub(of(under));
        let lowest = |p: &Polynomial| {
            p.terms()
                .iter()
                .map(|(monomial, _)| exponent(monomial, term))
                .min()
                .unwrap_or(0)
        };
        Some(match tower.kind(term).clone() {
            Kind::Exponential(_) if lowest(under) == of(under) => (lowest(above).min(of(above)), of(above)),
            Kind::Exponential(_) => (0, excess + of(below)),
            Kind::Tangent { .. } => (0, excess + of(below)),
            Kind::Root(_, index) => (0, index.saturating_sub(1)),
            Kind::Unknown(..) => (0, self.degree_of_unknown(term, tower)?),
            Kind::Logarithm(_) | Kind::Function(..) => (0, excess + of(below) + 1),
            _ => (0, excess + of(below) + 1),
        })
    }

    /// The greatest degree in a function or its derivatives; 0 of the derivative of highest order.
    fn degree_of_unknown(&self, term: Term, tower: &mut Tower) -> Option<u32> {
        let mut degree = degree_in(&self.integrand.above, term);
        let mut next = term;
        for order in 0..8 {
            let after = tower.slope(next)?.generators();
            let unknown = |term: &&Term| matches!(tower.kind(**term), Kind::Unknown(..));
            let Some(after) = after.iter().find(unknown).copied() else {
                break;
            };
            if !self.generators.contains(&after) {
                return Some(if order == 0 { 0 } else { degree });
            }
            degree = degree.max(degree_in(&self.integrand.above, after));
            next = after;
        }
        Some(degree)
    }

    fn monomials(&self, below: &Polynomial, tower: &mut Tower) -> Option<Vec<Monomial>> {
        let degree = |p: &Polynomial| {
            let of = |monomial: &Monomial| {
                let varying = monomial.iter().filter(|(term, _)| self.generators.contains(term));
                varying.map(|(_, exponent)| *exponent).sum::<u32>()
            };
            p.terms().iter().map(|(monomial, _)| of(monomial)).max().unwrap_or(0)
        };
        let excess = degree(&self.integrand.above).saturating_sub(degree(&self.integrand.below));
        let functions = self.generators.iter().filter(|term| {
            matches!(
                tower.kind(**term),
                Kind::Logarithm(_) | Kind::Function(..) | Kind::Unknown(..)
            )
        });
        let of_functions: u32 = functions.map(|term| degree_in(&self.integrand.above, *term)).sum();
        let most = excess.max(of_functions) + degree(below) + 1;
        let mut all: Vec<(Monomial, u32)> = vec![(Monomial::new(), 0)];
        for term in &self.generators {
            let (low, high) = self.range(*term, below, tower)?;
            let is_free = matches!(tower.kind(*term), Kind::Tangent { .. } | Kind::Exponential(_));
            let mut next = Vec::new();
            for (monomial, sum) in &all {
                for power in low..=high {
                    let sum = sum + if is_free { 0 } else { power };
                    if sum > most {
                        break;
                    }
                    let mut longer = monomial.clone();
                    if power > 0 {
                        longer.push((*term, power));
                    }
                    next.push((longer, sum));
                }
            }
            all = next;
            if all.len() > MOST {
                return None;
            }
        }
        Some(all.into_iter().map(|(monomial, _)| monomial).collect())
    }

    /// Returns the factors of the coefficients in the equation for them, and its right side, which is taken times the letters that
    /// stand below the integrand.
    fn columns(
        &self,
        below: &Polynomial,
        monomials: &[Monomial],
        candidates: &[Candidate],
        tower: &mut Tower,
    ) -> Option<(Vec<Polynomial>, Polynomial)> {
        let mut normal = Polynomial::integer(1);
        for divisor in self.divisors.iter().filter(|divisor| !divisor.is_special) {
            normal = times(&normal, &divisor.factor, &mut tower.steps).ok()?;
        }
        let side = times(&self.common, &normal, &mut tower.steps).ok()?;
        let whole = times(&side, below, &mut tower.steps).ok()?;
        // the derivative of m/below, times whole, is the sum of e m/g times the slope of g, less m times that of below
        let mut slopes = BTreeMap::new();
        for (term, slope) in &self.slopes {
            slopes.insert(*term, times(slope, &normal, &mut tower.steps).ok()?);
        }
        let of_below = times(&self.slope(below, tower)?, &normal, &mut tower.steps).ok()?;
        let of_below = exact_quotient(&of_below, below, &mut tower.steps).ok()??;
        let mut columns = Vec::new();
        for monomial in monomials {
            let own = Polynomial::from_terms([(monomial.clone(), dashu_ratio::RBig::ONE)]);
            let mut total = times(&own, &of_below, &mut tower.steps).ok()?.negated();
            for (term, _) in monomial {
                let slope = slopes.get(term)?;
                total = total.plus(&times(&derivative(&own, *term), slope, &mut tower.steps).ok()?);
            }
            columns.push(tower.reduced(&total)?);
        }
        for candidate in candidates {
            let part = times(&candidate.slope.above, &whole, &mut tower.steps).ok()?;
            let part = exact_quotient(&part, &candidate.slope.below, &mut tower.steps).ok()?;
            let part = part.unwrap_or_default();
            columns.push(tower.reduced(&part)?);
        }
        let right = times(&self.integrand.above, &whole, &mut tower.steps).ok()?;
        let right = times(&right, &self.constant, &mut tower.steps).ok()?;
        let right = exact_quotient(&right, &self.integrand.below, &mut tower.steps).ok()??;
        Some((columns, tower.reduced(&right)?))
    }

    fn coefficients(
        &self,
        columns: &[Polynomial],
        right: &Polynomial,
        tower: &mut Tower,
    ) -> Option<BTreeMap<usize, Fraction>> {
        let mut rows: BTreeMap<Monomial, Row<Fraction>> = BTreeMap::new();
        let mut holds_letters = false;
        let places = columns.iter().map(Some).chain([None]);
        for (place, column) in places.enumerate() {
            let mut parts: BTreeMap<Monomial, Vec<(Monomial, dashu_ratio::RBig)>> = BTreeMap::new();
            for (monomial, value) in column.unwrap_or(right).terms() {
                let (varying, letters): (Monomial, Monomial) = monomial
                    .iter()
                    .copied()
                    .partition(|(term, _)| self.generators.contains(term));
                holds_letters |= !letters.is_empty();
                parts.entry(varying).or_default().push((letters, value.clone()));
            }
            for (monomial, terms) in parts {
                let factor = Fraction::of(Polynomial::from_terms(terms));
                let row = rows.entry(monomial).or_insert_with(|| Row {
                    factors: BTreeMap::new(),
                    right: Fraction::nothing(),
                });
                match column {
                    Some(_) => drop(row.factors.insert(place, factor)),
                    None => row.right = factor,
                }
            }
        }
        let rows: Vec<Row<Fraction>> = rows.into_values().collect();
        if holds_letters {
            return (columns.len() <= MOST_WITH_LETTERS).then(|| solve(rows, tower))?;
        }
        let plain = |row: Row<Fraction>| {
            let factors = row
                .factors
                .into_iter()
                .filter_map(|(place, factor)| Some((place, factor.as_constant()?)));
            let factors = factors.collect();
            Some(Row {
                factors,
                right: row.right.as_constant()?,
            })
        };
        let rows: Vec<Row<Rational>> = rows.into_iter().map(plain).collect::<Option<_>>()?;
        let solution = solve(rows, tower)?;
        Some(
            solution
                .into_iter()
                .map(|(place, value)| (place, Fraction::constant(&value)))
                .collect(),
        )
    }

    fn trees(
        &self,
        below: &Polynomial,
        monomials: &[Monomial],
        candidates: &[Candidate],
        solution: &BTreeMap<usize, Fraction>,
        constant: &Polynomial,
        tower: &mut Tower,
    ) -> Option<Vec<Tree>> {
        let constant = Fraction::of(constant.clone());
        let mut rational = Fraction::integer(0);
        let mut terms: Vec<(Fraction, &Candidate)> = Vec::new();
        for (place, value) in solution {
            let value = tower.over(value, &constant)?;
            match monomials.get(*place) {
                Some(monomial) => {
                    let own = Polynomial::from_terms([(monomial.clone(), Rational::one().0)]);
                    let part = value.times(&Fraction::of(own), &mut tower.steps)?;
                    rational = rational.plus(&part, &mut tower.steps)?;
                }
                None => terms.push((value, candidates.get(place - monomials.len())?)),
            }
        }
        let rational = Fraction::new(
            &rational.above,
            &times(&rational.below, below, &mut tower.steps).ok()?,
            &mut tower.steps,
        )?;
        let rational = without_tangents(&self.tangents, &rational, tower)?;
        let first = tower.print(&rational, &[])?;
        let spellings = [Logarithms::Plain, Logarithms::Opposite, Logarithms::Absolute];
        let mut found: Vec<Tree> = Vec::new();
        for spelling in spellings {
            let mut all = vec![first.clone()];
            for (value, candidate) in &terms {
                all.push(scaled(value, candidate.tree(spelling), tower)?);
            }
            let whole = sum(all);
            if !found.contains(&whole) {
                found.push(whole);
            }
        }
        Some(found)
    }
}

/// The product, with a number before the tree or below it.
fn scaled(value: &Fraction, tree: Tree, tower: &Tower) -> Option<Tree> {
    let above = Fraction::of(value.above.clone());
    let below = Fraction::of(value.below.clone());
    let above = product(vec![tower.print(&above, &[])?, tree]);
    Some(quotient(above, tower.print(&below, &[])?))
}
