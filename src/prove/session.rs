//! A proof in the making: the steps so far, and the facts that the kernel makes of them.

use crate::algebra::{Order, Steps, coefficients_in, degree_in, exact_quotient, pseudo_divide, radical_member};
use crate::kernel::{
    Axiom, Certificate, Checker, Inference, Node, Polynomial, Property, Quantity, Refusal, Statement, Summand, Term,
    Terms, sign,
};
use crate::number::{Field, Rational};
use num_traits::{One, Zero};
use std::collections::{BTreeMap, BTreeSet};

/// A proof in the making.
pub struct Session<'a> {
    pub checker: Checker<'a>,
    pub steps: Vec<Inference>,
    pub budget: Steps,
    /// Facts that vanish and are reduced by one another, each with what it determines.
    pub triangle: Vec<Pivot>,
    /// Axioms that were taken, so that none is taken twice.
    taken: BTreeSet<String>,
    tried: BTreeSet<usize>,
    left_over: Vec<usize>,
}

/// A fact that determines a generator, or a power of it, by those before it.
#[derive(Clone, Debug)]
pub struct Pivot {
    pub fact: usize,
    pub generator: Term,
    pub degree: u32,
    /// Facts whose product is the leading coefficient, up to a number; none where it is a number.
    pub lead: Vec<(usize, u32)>,
}

/// A proof that a polynomial vanishes, from the last step to the first: `factors * before = quotients + after`.
struct Link {
    before: Polynomial,
    factors: Vec<(usize, u32)>,
    terms: Vec<(Polynomial, usize)>,
    after: Polynomial,
}

impl<'a> Session<'a> {
    pub fn new(statement: &'a mut Statement, whole: Vec<Term>, budget: u64) -> Self {
        let certificate = Certificate {
            whole,
            steps: Vec::new(),
        };
        Self {
            checker: Checker::new(statement, &certificate, 200_000_000),
            steps: Vec::new(),
            budget: Steps::new(budget),
            triangle: Vec::new(),
            taken: BTreeSet::new(),
            tried: BTreeSet::new(),
            left_over: Vec::new(),
        }
    }

    pub fn terms(&mut self) -> &mut Terms {
        self.checker.statement.terms_mut()
    }

    /// Adds a step, and gives the number of the fact that it makes.
    pub fn step(&mut self, step: Inference) -> Result<usize, Refusal> {
        self.checker.apply(&step)?;
        self.steps.push(step);
        Ok(self.checker.facts.len() - 1)
    }

    /// Adds an axiom once; nothing where the kernel does not accept it.
    pub fn axiom(&mut self, axiom: Axiom) -> Option<usize> {
        if !self.taken.insert(format!("{axiom:?}")) {
            return None;
        }
        self.step(Inference::Axiom(axiom)).ok()
    }

    pub fn polynomial(&self, fact: usize) -> Polynomial {
        self.checker
            .facts
            .get(fact)
            .map(|fact| fact.polynomial.clone())
            .unwrap_or_default()
    }

    /// The facts that say that something vanishes.
    pub fn zeros(&self) -> Vec<usize> {
        let facts = self.checker.facts.iter().enumerate();
        let zeros = facts.filter(|(_, fact)| fact.property == Property::Zero && !fact.polynomial.is_zero());
        zeros.map(|(number, _)| number).collect()
    }

    /// The facts that say that something is not 0.
    pub fn nonzeros(&self) -> Vec<usize> {
        let facts = self.checker.facts.iter().enumerate();
        let wanted = |property: Property| matches!(property, Property::Nonzero | Property::Positive);
        let found = facts.filter(|(_, fact)| wanted(fact.property) && fact.polynomial.as_constant().is_none());
        found.map(|(number, _)| number).collect()
    }

    /// Every generator of the facts and of these polynomials.
    pub fn generators(&self, more: &[Polynomial]) -> BTreeSet<Term> {
        let facts = self.checker.facts.iter().flat_map(|fact| fact.polynomial.generators());
        facts.chain(more.iter().flat_map(Polynomial::generators)).collect()
    }

    /// Known nonzero facts whose product is the polynomial up to a number, with that number.
    pub fn nonzero_product(&mut self, polynomial: &Polynomial) -> Option<(Rational, Vec<(usize, u32)>)> {
        let mut rest = polynomial.clone();
        let mut factors: Vec<(usize, u32)> = Vec::new();
        for number in self.nonzeros() {
            if rest.as_constant().is_some() {
                break;
            }
            let fact = self.polynomial(number);
            let mut power = 0;
            while rest.as_constant().is_none()
                && let Ok(Some(quotient)) = exact_quotient(&rest, &fact, &mut self.budget)
            {
                rest = quotient;
                power += 1;
            }
            if power > 0 {
                factors.push((number, power));
            }
        }
        if let Some(value) = rest.as_constant() {
            return (!value.is_zero()).then_some((value, factors));
        }
        // a number that is no rational: by an enclosure
        let (number, sign) = self.closed_nonzero(&rest)?;
        factors.push((number, 1));
        Some((Rational::from_integer(sign), factors))
    }

    /// A fact that a polynomial without symbols, or its opposite (-1), is positive.
    pub fn closed_nonzero(&mut self, polynomial: &Polynomial) -> Option<(usize, i64)> {
        let sign = i64::from(sign(self.checker.statement.terms(), polynomial)?);
        let positive = polynomial.scaled(&Rational::from_integer(sign));
        let known = self
            .checker
            .facts
            .iter()
            .position(|fact| fact.property == Property::Positive && fact.polynomial == positive);
        let number = match known {
            Some(number) => number,
            None => self.step(Inference::Axiom(Axiom::Enclosure(positive))).ok()?,
        };
        Some((number, sign))
    }

    /// Takes a fact that vanishes into the triangle, reduced by those in it, if a generator of it can be the main one.
    /// `may` says which generators may be.
    pub fn triangulate(&mut self, fact: usize, may: &dyn Fn(&Terms, Term) -> bool) -> Option<()> {
        let fact = self.reduced_fact(fact)?;
        let polynomial = self.polynomial(fact);
        if polynomial.is_zero() {
            return Some(());
        }
        if polynomial.as_constant().is_some() {
            return None;
        }
        let mains: BTreeSet<Term> = self.triangle.iter().map(|pivot| pivot.generator).collect();
        let mut best: Option<((u32, bool, (u8, i32), usize), Pivot)> = None;
        for generator in polynomial.generators() {
            if mains.contains(&generator) || !may(self.checker.statement.terms(), generator) {
                continue;
            }
            let coefficients = coefficients_in(&polynomial, generator);
            let degree = u32::try_from(coefficients.len() - 1).ok()?;
            let Some(lead) = coefficients.last().cloned() else {
                continue;
            };
            // a power is reduced by a number only, or every reduction would need the coefficient
            if degree > 1 && lead.as_constant().is_none() {
                continue;
            }
            let rank = (
                degree,
                lead.as_constant().is_none(),
                self.late(generator),
                lead.terms().len(),
            );
            if best.as_ref().is_some_and(|(known, _)| *known <= rank) {
                continue;
            }
            let Some((_, lead)) = self.nonzero_product(&lead) else {
                continue;
            };
            best = Some((
                rank,
                Pivot {
                    fact,
                    generator,
                    degree,
                    lead,
                },
            ));
        }
        let (_, pivot) = best?;
        self.triangle.push(pivot);
        Some(())
    }

    /// Takes every fact that vanishes into the triangle that fits there, short ones first.
    pub fn triangulate_all(&mut self) {
        let held: BTreeSet<usize> = self.triangle.iter().map(|pivot| pivot.fact).collect();
        let mut open: Vec<usize> = self
            .zeros()
            .into_iter()
            .filter(|fact| !held.contains(fact) && self.tried.insert(*fact))
            .collect();
        open.extend(std::mem::take(&mut self.left_over));
        for _ in 0..3 {
            open.sort_by_key(|&fact| self.polynomial(fact).terms().len());
            let count = open.len();
            let facts = self.checker.facts.len();
            open.retain(|&fact| self.triangulate(fact, &|_, _| true).is_none());
            // reduced copies are facts too
            for number in facts..self.checker.facts.len() {
                self.tried.insert(number);
            }
            if open.is_empty() || open.len() == count {
                break;
            }
        }
        self.left_over = open;
    }

    /// Shows that a polynomial is not 0: as a product of what is known not to be.
    pub fn show_nonzero(&mut self, polynomial: &Polynomial) -> Option<usize> {
        let (rest, links) = self.reduce(polynomial)?;
        let (scale, factors) = self.nonzero_product(&rest)?;
        let mut last = self
            .step(Inference::Nonzero {
                target: rest,
                cofactor: Polynomial::constant(&(Rational::one() / scale)),
                factors,
                terms: Vec::new(),
            })
            .ok()?;
        for link in links.into_iter().rev() {
            // factors * before = terms + after, and after is not 0
            let mut cofactor = Polynomial::integer(1);
            for (number, power) in &link.factors {
                for _ in 0..*power {
                    cofactor = cofactor.times(&self.polynomial(*number));
                }
            }
            last = self
                .step(Inference::Nonzero {
                    target: link.before,
                    cofactor,
                    factors: vec![(last, 1)],
                    terms: link.terms,
                })
                .ok()?;
        }
        Some(last)
    }

    /// How early a generator is expressed by others: definitions first, then what maps and premises determine, then
    /// values of functions, and parameters last.
    fn late(&self, generator: Term) -> (u8, i32) {
        let statement = &self.checker.statement;
        match statement.terms().node(generator) {
            Node::Symbol(symbol) => match statement.quantity(*symbol) {
                Some(Quantity::Local { scope: 0, .. }) => (8, 0),
                Some(Quantity::Local { .. }) => (0, -(symbol.0 as i32)),
                Some(Quantity::Partial { .. } | Quantity::Invariant { .. }) => (1, 0),
                Some(Quantity::State { index, after, .. }) => (2, -2 * *index - i32::from(*after)),
                Some(Quantity::Time { index, .. }) => (5, -*index),
                _ if statement.generic().contains(symbol) => (7, 0),
                _ => (6, 0),
            },
            Node::Value(..) => (3, -(generator.0 as i32)),
            Node::Pi | Node::Imaginary => (9, 0),
            _ => (4, -(generator.0 as i32)),
        }
    }

    /// A fact reduced by the triangle, as a new fact of the same property.
    pub fn reduced_fact(&mut self, fact: usize) -> Option<usize> {
        let property = self.checker.facts.get(fact)?.property;
        let mut current = fact;
        for _ in 0..50 {
            let mut changed = false;
            for pivot in self.triangle.clone() {
                let polynomial = self.polynomial(current);
                if pivot.fact == current || degree_in(&polynomial, pivot.generator) < pivot.degree {
                    continue;
                }
                let divisor = self.polynomial(pivot.fact);
                let (multiplier, quotient, rest) =
                    pseudo_divide(&polynomial, &divisor, pivot.generator, &mut self.budget).ok()??;
                let step = match property {
                    Property::Zero => Inference::Zero {
                        target: rest,
                        power: 1,
                        squares: Vec::new(),
                        factors: Vec::new(),
                        terms: vec![(multiplier, current), (quotient.negated(), pivot.fact)],
                    },
                    Property::Nonzero | Property::Positive | Property::NonNegative => {
                        let (scale, factors) = self.nonzero_product(&multiplier)?;
                        if property == Property::Nonzero {
                            let mut all = factors.clone();
                            all.push((current, 1));
                            // rest = multiplier * polynomial - quotient * divisor
                            let inverse = Rational::one() / scale;
                            Inference::Nonzero {
                                target: rest,
                                cofactor: Polynomial::constant(&inverse),
                                factors: all,
                                terms: vec![(quotient.negated().scaled(&inverse), pivot.fact)],
                            }
                        } else {
                            if !factors.is_empty() || scale <= Rational::zero() {
                                break;
                            }
                            let summand = Summand {
                                factor: scale,
                                facts: vec![current],
                                root: Polynomial::integer(1),
                            };
                            Inference::Sign {
                                target: rest,
                                strict: property == Property::Positive,
                                factors: Vec::new(),
                                summands: vec![summand],
                                terms: vec![(quotient.negated(), pivot.fact)],
                            }
                        }
                    }
                    Property::Integer => return Some(current),
                };
                current = self.step(step).ok()?;
                changed = true;
            }
            if !changed {
                break;
            }
        }
        Some(current)
    }

    /// Reduces a polynomial by the triangle: what is left, and the links that lead back to it.
    fn reduce(&mut self, polynomial: &Polynomial) -> Option<(Polynomial, Vec<Link>)> {
        let (mut current, mut links) = (polynomial.clone(), Vec::new());
        for _ in 0..50 {
            let mut changed = false;
            for pivot in self.triangle.clone() {
                if degree_in(&current, pivot.generator) < pivot.degree {
                    continue;
                }
                let divisor = self.polynomial(pivot.fact);
                let (multiplier, quotient, rest) =
                    pseudo_divide(&current, &divisor, pivot.generator, &mut self.budget).ok()??;
                let (scale, factors) = self.nonzero_product(&multiplier)?;
                let inverse = Rational::one() / scale;
                let after = rest.scaled(&inverse);
                links.push(Link {
                    before: current,
                    factors,
                    terms: vec![(quotient.scaled(&inverse), pivot.fact)],
                    after: after.clone(),
                });
                current = after;
                changed = true;
            }
            if !changed || current.is_zero() {
                break;
            }
        }
        Some((current, links))
    }

    /// What a polynomial is modulo the triangle.
    pub fn normal_form(&mut self, polynomial: &Polynomial) -> Option<Polynomial> {
        self.reduce(polynomial).map(|(rest, _)| rest)
    }

    /// Shows that a polynomial vanishes: by the triangle, then by an ideal of what is left.
    pub fn show_zero(&mut self, polynomial: &Polynomial) -> Option<usize> {
        if polynomial.is_zero() {
            return self.zero_step(Polynomial::default(), Vec::new(), Vec::new());
        }
        let (rest, links) = self.reduce(polynomial)?;
        let mut last = match rest.is_zero() {
            true => self.zero_step(rest, Vec::new(), Vec::new())?,
            false => self.show_rest(&rest)?,
        };
        for link in links.into_iter().rev() {
            let mut terms = link.terms;
            if !link.after.is_zero() {
                terms.push((Polynomial::integer(1), last));
            }
            last = self.zero_step(link.before, link.factors, terms)?;
        }
        Some(last)
    }

    fn zero_step(
        &mut self,
        target: Polynomial,
        factors: Vec<(usize, u32)>,
        terms: Vec<(Polynomial, usize)>,
    ) -> Option<usize> {
        let step = Inference::Zero {
            target,
            power: 1,
            squares: Vec::new(),
            factors,
            terms,
        };
        self.step(step).ok()
    }

    /// Shows that a reduced polynomial vanishes by the ideal of the facts.
    fn show_rest(&mut self, rest: &Polynomial) -> Option<usize> {
        if let Some(known) =
            self.checker.facts.iter().position(|fact| {
                fact.property == Property::Zero && !rest.is_zero() && fact.polynomial.is_multiple_of(rest)
            })
        {
            return Some(known);
        }
        let (zeros, nonzeros) = self.relevant(rest);
        if zeros.is_empty() {
            return None;
        }
        let polynomials: Vec<Polynomial> = zeros.iter().map(|&fact| self.polynomial(fact)).collect();
        let factors: Vec<Polynomial> = nonzeros.iter().map(|&fact| self.polynomial(fact)).collect();
        let mut all = polynomials.clone();
        all.push(rest.clone());
        let order = Order::triangular(&all);
        let most = self.budget.left() / 3;
        let found = self.budget.attempt(most, |steps| {
            radical_member(rest, &polynomials, &factors, &order, steps)
        })??;
        let factors = nonzeros
            .iter()
            .copied()
            .zip(found.exponents)
            .filter(|(_, power)| *power > 0);
        let terms = found
            .cofactors
            .into_iter()
            .zip(zeros)
            .filter(|(cofactor, _)| !cofactor.is_zero());
        let step = Inference::Zero {
            target: rest.clone(),
            power: found.power,
            squares: Vec::new(),
            factors: factors.collect(),
            terms: terms.collect(),
        };
        self.step(step).ok()
    }

    /// The facts that share generators with a polynomial, directly or through others: reduced ones only.
    pub fn relevant(&mut self, polynomial: &Polynomial) -> (Vec<usize>, Vec<usize>) {
        let reduced = |of: Vec<usize>, session: &mut Self| -> Vec<usize> {
            let mut kept: Vec<usize> = Vec::new();
            for fact in of {
                let Some(number) = session.reduced_fact(fact) else {
                    continue;
                };
                let polynomial = session.polynomial(number);
                let known = |&other: &usize| session.polynomial(other).is_multiple_of(&polynomial);
                if polynomial.as_constant().is_none() && !kept.iter().any(known) {
                    kept.push(number);
                }
            }
            kept
        };
        let pivots: BTreeSet<usize> = self
            .triangle
            .iter()
            .filter(|p| p.degree == 1)
            .map(|pivot| pivot.fact)
            .collect();
        let powers: Vec<usize> = self
            .triangle
            .iter()
            .filter(|p| p.degree > 1)
            .map(|pivot| pivot.fact)
            .collect();
        let zeros: Vec<usize> = self.zeros().into_iter().filter(|fact| !pivots.contains(fact)).collect();
        let mut zeros = reduced(zeros, self);
        zeros.extend(
            powers
                .iter()
                .filter(|fact| !zeros.contains(fact))
                .copied()
                .collect::<Vec<_>>(),
        );
        let nonzeros = self.nonzeros();
        let nonzeros = reduced(nonzeros, self);
        let mut met: BTreeSet<Term> = polynomial.generators().into_iter().collect();
        loop {
            let before = met.len();
            for &fact in &zeros {
                let generators = self.polynomial(fact).generators();
                if generators.iter().any(|term| met.contains(term)) {
                    met.extend(generators);
                }
            }
            if met.len() == before {
                break;
            }
        }
        let inside = |fact: &usize, session: &Self| {
            session
                .polynomial(*fact)
                .generators()
                .iter()
                .all(|term| met.contains(term))
        };
        let zeros = zeros.into_iter().filter(|fact| inside(fact, self)).collect();
        let nonzeros = nonzeros.into_iter().filter(|fact| inside(fact, self)).collect();
        (zeros, nonzeros)
    }

    /// The numerator of a term.
    pub fn numerator(&mut self, term: Term) -> Option<Polynomial> {
        self.checker
            .expansion
            .of(self.checker.statement.terms(), term)
            .ok()
            .map(|quotient| quotient.numerator)
    }

    /// Shows that the difference of two terms vanishes.
    pub fn show_equal(&mut self, a: Term, b: Term) -> Option<usize> {
        let difference = self.terms().difference(a, b);
        let polynomial = self.numerator(difference)?;
        self.show_zero(&polynomial)
    }

    /// The values of generators that the triangle leaves free, and of those it determines, modulo a prime.
    pub fn main_generators(&self) -> BTreeMap<Term, usize> {
        self.triangle
            .iter()
            .enumerate()
            .map(|(number, pivot)| (pivot.generator, number))
            .collect()
    }

    /// The node of a term.
    pub fn node(&self, term: Term) -> Node {
        self.checker.statement.terms().node(term).clone()
    }
}
