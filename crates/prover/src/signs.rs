//! Signs: what is positive, not negative, or not 0, and what follows where signs meet.
//!
//! Complete for what [`crate::algebra::positive`] finds from the facts and the powers of the triangle; for facts that
//! vanish: factors that cannot vanish are divided out, and of a sum of what is not negative every summand is 0.

use super::session::Session;
use crate::algebra::{self, Fact, coefficients_in, factors, power, times};
use dashu_ratio::RBig;
use kernel::{Axiom, Elementary, Inference, LawSource, Monomial, Node, Polynomial, Property, Summand, Term, sign};
use num_traits::{One, Zero};
use numbers::{Field, Rational};
use std::collections::BTreeSet;

/// The most facts that a proof of a sign is searched from.
const MOST_FACTS: usize = 14;
/// The most steps of one search for a sign.
const MOST_STEPS: u64 = 200_000;
/// The most letters whose bounds are used, and the steps that enclosures between these cost.
const MOST_LETTERS: usize = 3;
const STEPS_OF_ENCLOSURES: u64 = 20_000;
/// The most facts of which it is tried whether their opposites hold, too.
const MOST_SQUEEZED: usize = 16;

impl Session<'_> {
    fn is_closed(&self, polynomial: &Polynomial) -> bool {
        let terms = self.checker.statement.terms();
        polynomial.generators().iter().all(|&term| terms.is_closed(term))
    }

    /// Shows that a polynomial is positive (`strict`) or not negative; gives the fact that says just this.
    pub fn show_sign(&mut self, polynomial: &Polynomial, strict: bool) -> Option<usize> {
        let known = self.checker.facts.iter().position(|fact| {
            let fits = fact.property == Property::Positive || (!strict && fact.property == Property::NonNegative);
            fits && fact.polynomial == *polynomial
        });
        if known.is_some() {
            return known;
        }
        if self.is_closed(polynomial)
            && let Some(found) = sign(self.checker.statement.terms(), polynomial)
        {
            return match found {
                1 => self.step(Inference::Enclosure(polynomial.clone())).ok(),
                _ => None,
            };
        }
        if let Some(found) = self.written_squares(polynomial, strict) {
            return Some(found);
        }
        if !self.is_hopeful(polynomial, strict) {
            return None;
        }
        if let Some(found) = self.between_bounds(polynomial) {
            return Some(found);
        }
        let (rest, links) = self.exact_reduction(polynomial)?;
        let mut last = self.sign_of_reduced(&rest, strict)?;
        for link in links.into_iter().rev() {
            let summand = Summand {
                factor: Rational::one(),
                facts: vec![last],
                root: Polynomial::integer(1),
            };
            last = self
                .step(Inference::Sign {
                    target: link.before,
                    strict,
                    factors: Vec::new(),
                    summands: vec![summand],
                    terms: link.terms,
                })
                .ok()?;
        }
        Some(last)
    }

    /// The sign of a sum of positive multiples of even powers as it is written: reduced, it may be none any more.
    fn written_squares(&mut self, polynomial: &Polynomial, strict: bool) -> Option<usize> {
        let summand = |(monomial, value): &(Monomial, RBig)| {
            let is_square = *value > RBig::ZERO && monomial.iter().all(|(_, exponent)| exponent % 2 == 0);
            let root = monomial.iter().map(|&(term, exponent)| (term, exponent / 2)).collect();
            is_square.then(|| Summand {
                factor: Rational(value.clone()),
                facts: Vec::new(),
                root: Polynomial::from_terms([(root, RBig::ONE)]),
            })
        };
        let summands = polynomial
            .terms()
            .iter()
            .map(summand)
            .collect::<Option<Vec<Summand>>>()?;
        let has_constant = polynomial.terms().iter().any(|(monomial, _)| monomial.is_empty());
        let step = Inference::Sign {
            target: polynomial.clone(),
            strict,
            factors: Vec::new(),
            summands,
            terms: Vec::new(),
        };
        (has_constant || !strict).then(|| self.step(step).ok())?
    }

    /// The sign of a polynomial whose letters all lie between numbers, by enclosures; gives the fact that it is positive.
    fn between_bounds(&mut self, polynomial: &Polynomial) -> Option<usize> {
        let terms = self.checker.statement.terms();
        let generators = polynomial.generators().into_iter();
        let inside: BTreeSet<Term> = generators.flat_map(|term| terms.inside(term)).collect();
        let is_letter = |term: &Term| matches!(terms.node(*term), Node::Symbol(_));
        let letters: Vec<Term> = inside.iter().copied().filter(is_letter).collect();
        let is_other = |term: &Term| matches!(terms.node(*term), Node::Value(..) | Node::Imaginary);
        if letters.is_empty() || letters.len() > MOST_LETTERS || inside.iter().any(is_other) {
            return None;
        }
        let within: Vec<[usize; 2]> = letters
            .iter()
            .map(|letter| self.bounds(*letter))
            .collect::<Option<_>>()?;
        self.budget.take(STEPS_OF_ENCLOSURES).ok()?;
        let target = polynomial.clone();
        self.step(Inference::Between { target, within }).ok()
    }

    /// The facts that give a letter its closest bounds by numbers, from below and from above.
    fn bounds(&self, letter: Term) -> Option<[usize; 2]> {
        let terms = self.checker.statement.terms();
        let mut found: [Option<(usize, Polynomial)>; 2] = [None, None];
        for (number, fact) in self.checker.facts.iter().enumerate() {
            if !matches!(fact.property, Property::Positive | Property::NonNegative) {
                continue;
            }
            let is_own = |(monomial, _): &&(Monomial, RBig)| monomial.as_slice() == [(letter, 1)];
            let Some((_, factor)) = fact.polynomial.terms().iter().find(is_own) else {
                continue;
            };
            let size = Rational(RBig::ONE / factor.clone());
            let size = if size < Rational::zero() { -size } else { size };
            let scaled = fact.polynomial.scaled(&size);
            let place = usize::from(*factor < RBig::ZERO);
            let one = if place == 0 { -1 } else { 1 };
            let rest = scaled.plus(&Polynomial::generator(letter).scaled(&Rational::from_integer(one)));
            if !self.is_closed(&rest) {
                continue;
            }
            // the smaller the rest, the closer the bound
            if let Some(side) = found.get_mut(place) {
                let is_closer = side.as_ref().is_none_or(|(_, known)| {
                    let less = known.plus(&rest.negated());
                    match less.as_constant() {
                        Some(value) => value > Rational::zero(),
                        None => sign(terms, &less) == Some(1),
                    }
                });
                if is_closer {
                    *side = Some((number, rest));
                }
            }
        }
        let [Some((low, _)), Some((high, _))] = found else {
            return None;
        };
        Some([low, high])
    }

    fn sign_of_reduced(&mut self, polynomial: &Polynomial, strict: bool) -> Option<usize> {
        if let Some(value) = polynomial.as_constant() {
            let summands = if value.is_zero() {
                Vec::new()
            } else {
                vec![Summand {
                    factor: value.clone(),
                    facts: Vec::new(),
                    root: Polynomial::integer(1),
                }]
            };
            if value < Rational::zero() || (strict && summands.is_empty()) {
                return None;
            }
            return self
                .step(Inference::Sign {
                    target: polynomial.clone(),
                    strict,
                    factors: Vec::new(),
                    summands,
                    terms: Vec::new(),
                })
                .ok();
        }
        let (facts, zeros) = self.signs_near(polynomial);
        let own = self.sign_facts(&facts);
        let vanishing: Vec<Polynomial> = zeros.iter().map(|&fact| self.polynomial(fact)).collect();
        let most = (self.budget.left() / 20).min(MOST_STEPS);
        let found = self.budget.attempt(most, |steps| {
            algebra::positive(polynomial, strict, &own, &vanishing, steps)
        })??;
        let multiplier = facts.iter().copied().zip(found.multiplier.iter().copied());
        let summands = found.summands.iter().map(|summand| Summand {
            factor: summand.coefficient.clone(),
            facts: repeated(&facts, &summand.exponents),
            root: summand.square.clone(),
        });
        let terms = found.cofactors.into_iter().zip(zeros);
        self.step(Inference::Sign {
            target: polynomial.clone(),
            strict,
            factors: multiplier.filter(|(_, exponent)| *exponent > 0).collect(),
            summands: summands.collect(),
            terms: terms.filter(|(cofactor, _)| !cofactor.is_zero()).collect(),
        })
        .ok()
    }

    fn sign_facts(&self, numbers: &[usize]) -> Vec<Fact> {
        let facts = numbers.iter().map(|&number| Fact {
            polynomial: self.polynomial(number),
            strict: self
                .checker
                .facts
                .get(number)
                .is_some_and(|fact| fact.property == Property::Positive),
        });
        facts.collect()
    }

    /// Facts with a sign, none a copy of another, each reduced by the triangle.
    fn reduced_signs(&mut self) -> Vec<usize> {
        let facts = self.checker.facts.iter().enumerate();
        let wanted = |property: Property| matches!(property, Property::Positive | Property::NonNegative);
        let numbers: Vec<usize> = facts
            .filter(|(number, fact)| wanted(fact.property) && !self.is_derived(*number))
            .map(|(number, _)| number)
            .collect();
        let mut kept: Vec<usize> = Vec::new();
        for number in numbers {
            let Some(copy) = self.reduced_fact(number) else {
                continue;
            };
            let polynomial = self.polynomial(copy);
            let property = self.checker.facts[copy].property;
            let known = |&other: &usize| {
                self.polynomial(other) == polynomial
                    && (self.checker.facts[other].property == property || property == Property::NonNegative)
            };
            if !kept.iter().any(known) {
                kept.push(copy);
            }
        }
        kept
    }

    /// The facts with signs, and those that vanish, that speak of the symbols of a polynomial.
    fn signs_near(&mut self, polynomial: &Polynomial) -> (Vec<usize>, Vec<usize>) {
        if self.budget.take(self.checker.facts.len() as u64).is_err() {
            return (Vec::new(), Vec::new());
        }
        let mut facts: Vec<usize> = self.reduced_signs();
        facts.retain(|&fact| self.polynomial(fact).as_constant().is_none());
        let mut powers: Vec<usize> = self
            .triangle
            .iter()
            .filter(|pivot| pivot.degree > 1 || !pivot.lead.is_empty())
            .map(|pivot| pivot.fact)
            .collect();
        powers.extend(self.undetermining());
        let open = |session: &Self, polynomial: &Polynomial| -> BTreeSet<Term> {
            let terms = session.checker.statement.terms();
            polynomial
                .generators()
                .into_iter()
                .filter(|&term| !terms.is_closed(term))
                .collect()
        };
        let own = open(self, polynomial);
        let mut met = own.clone();
        for _ in 0..3 {
            for &fact in facts.iter().chain(&powers) {
                let generators = open(self, &self.polynomial(fact));
                if generators.iter().any(|term| met.contains(term)) {
                    met.extend(generators);
                }
            }
        }
        powers.retain(|&fact| open(self, &self.polynomial(fact)).iter().all(|term| met.contains(term)));
        facts.retain(|&fact| open(self, &self.polynomial(fact)).iter().all(|term| met.contains(term)));
        facts.sort_by_key(|&fact| {
            let generators = open(self, &self.polynomial(fact));
            (generators.difference(&own).count(), self.polynomial(fact).terms().len())
        });
        facts.truncate(MOST_FACTS);
        // numbers that are no rationals have signs of their own
        let mut closed: BTreeSet<Term> = BTreeSet::new();
        for spoken in facts
            .iter()
            .map(|&fact| self.polynomial(fact))
            .chain([polynomial.clone()])
        {
            closed.extend(spoken.generators());
        }
        closed.retain(|&term| self.checker.statement.terms().is_closed(term));
        for term in closed.into_iter().take(4) {
            if let Some((number, _)) = self.closed_nonzero(&Polynomial::generator(term))
                && !facts.contains(&number)
            {
                facts.push(number);
            }
        }
        let spoken: BTreeSet<Term> = facts
            .iter()
            .flat_map(|&fact| self.polynomial(fact).generators())
            .chain(polynomial.generators())
            .collect();
        powers.retain(|&fact| {
            self.polynomial(fact)
                .generators()
                .iter()
                .any(|term| spoken.contains(term))
        });
        (facts, powers)
    }

    /// A fact that a polynomial is not 0, with the number that the fact is times the polynomial.
    pub fn nonzero_fact(&mut self, polynomial: &Polynomial) -> Option<(usize, Rational)> {
        let known = self.checker.facts.iter().position(|fact| {
            matches!(fact.property, Property::Nonzero | Property::Positive)
                && fact.polynomial.is_multiple_of(polynomial)
        });
        let number = match known {
            Some(number) => number,
            None => match self.show_sign(polynomial, true) {
                Some(number) => number,
                None => self.show_sign(&polynomial.negated(), true)?,
            },
        };
        let fact = self.polynomial(number);
        let (above, below) = (fact.terms().first()?.1.clone(), polynomial.terms().first()?.1.clone());
        Some((number, Rational(above / below)))
    }

    /// Shows the signs of what stands before the generators of a polynomial in facts that vanish, as x + 1 in (x + 1) y = 1:
    /// a sign of the generator may follow.
    pub fn sign_leads(&mut self, polynomial: &Polynomial) {
        let pivots = self.triangle.iter().flat_map(|pivot| &pivot.lead);
        let mut leads: Vec<Polynomial> = pivots.map(|(fact, _)| self.polynomial(*fact)).collect();
        for fact in self.undetermining() {
            let vanishing = self.polynomial(fact);
            for generator in polynomial.generators() {
                if let [_, lead] = coefficients_in(&vanishing, generator).as_slice() {
                    leads.push(lead.clone());
                }
            }
        }
        for lead in leads {
            if lead.as_constant().is_none() && self.show_sign(&lead, true).is_none() {
                let _ = self.show_sign(&lead.negated(), true);
            }
        }
    }

    /// A fact that is reduced by the triangle, unless it is a power in there itself.
    fn reduced_power(&mut self, fact: usize) -> Option<usize> {
        if self.triangle.iter().any(|pivot| pivot.fact == fact) {
            return Some(fact);
        }
        self.reduced_fact(fact)
    }

    /// Of each fact that vanishes: the product of its different factors that may vanish.
    pub fn divide_out(&mut self) {
        let numbers: Vec<usize> = self.vanishing();
        let facts = self.checker.facts.len();
        for number in numbers {
            let Some(number) = self.reduced_power(number) else {
                continue;
            };
            if !self.divided.insert(number) {
                continue;
            }
            let polynomial = self.polynomial(number);
            if polynomial.as_constant().is_some() || polynomial.terms().len() > 60 {
                continue;
            }
            let _ = self.divide_out_of(number, &polynomial);
        }
        for number in facts..self.checker.facts.len() {
            self.divided.insert(number);
        }
    }

    fn divide_out_of(&mut self, number: usize, polynomial: &Polynomial) -> Option<()> {
        let most = self.budget.left() / 20;
        let found = self.budget.attempt(most, |steps| factors(polynomial, &[], steps))?;
        let mut nonzero: Vec<(usize, u32)> = Vec::new();
        let mut scale = Rational::one();
        let mut open: Vec<(Polynomial, u32)> = Vec::new();
        for (factor, exponent) in found.factors {
            match self.nonzero_fact(&factor) {
                Some((fact, ratio)) => {
                    nonzero.push((fact, exponent));
                    scale *= ratio.to_power(i32::try_from(exponent).ok()?);
                }
                None => match self.generic_fact(&factor) {
                    Some(fact) => nonzero.push((fact, exponent)),
                    None => open.push((factor, exponent)),
                },
            }
        }
        if nonzero.is_empty() && open.iter().all(|(_, exponent)| *exponent == 1) {
            return None;
        }
        let highest = open.iter().map(|(_, exponent)| *exponent).max().unwrap_or(1);
        let (target, coefficient) = self.budget.attempt(most, |steps| {
            let mut target = Polynomial::integer(1);
            let mut coefficient = Polynomial::constant(&(scale.clone() / found.constant.clone()));
            for (factor, exponent) in &open {
                target = times(&target, factor, steps)?;
                coefficient = times(&coefficient, &power(factor, highest - exponent, steps)?, steps)?;
            }
            Ok((target, coefficient))
        })?;
        self.step(Inference::Zero {
            target,
            power: highest,
            squares: Vec::new(),
            factors: nonzero,
            terms: vec![(coefficient, number)],
        })
        .ok()
        .map(|_| ())
    }

    /// What is not negative, and not positive, is 0.
    pub fn squeeze(&mut self) {
        let facts = self.reduced_signs();
        if facts.len() > MOST_SQUEEZED {
            return;
        }
        for low in facts {
            let polynomial = self.polynomial(low);
            if polynomial.is_zero() && self.checker.facts[low].property == Property::NonNegative {
                continue;
            }
            let Some(high) = self.show_sign(&polynomial.negated(), false) else {
                continue;
            };
            if self.checker.facts[low].property == Property::Positive {
                self.contradict(low, high);
                return;
            }
            let _ = self.step(Inference::Squeezed { low, high });
        }
    }

    /// From a positive fact, and its opposite that is not negative.
    fn contradict(&mut self, positive: usize, opposite: usize) {
        let summand = |fact: usize| Summand {
            factor: Rational::one(),
            facts: vec![fact],
            root: Polynomial::integer(1),
        };
        let nothing = self.step(Inference::Sign {
            target: Polynomial::default(),
            strict: true,
            factors: Vec::new(),
            summands: vec![summand(positive), summand(opposite)],
            terms: Vec::new(),
        });
        if let Ok(nothing) = nothing {
            self.absurd_from(nothing);
        }
    }

    /// From a fact that 0 is not 0.
    fn absurd_from(&mut self, nothing: usize) {
        let _ = self.step(Inference::Zero {
            target: Polynomial::integer(1),
            power: 1,
            squares: Vec::new(),
            factors: vec![(nothing, 1)],
            terms: Vec::new(),
        });
    }

    /// Of a sum of what is not negative that vanishes, every summand does.
    pub fn vanishing_summands(&mut self) {
        let numbers: Vec<usize> = self.vanishing();
        let facts = self.checker.facts.len();
        for number in numbers {
            let Some(number) = self.reduced_power(number) else {
                continue;
            };
            if !self.summed.insert(number) {
                continue;
            }
            let polynomial = self.polynomial(number);
            if (2..=30).contains(&polynomial.terms().len()) && !self.is_closed(&polynomial) {
                let _ = self.vanishing_summands_of(number, &polynomial);
            }
        }
        for number in facts..self.checker.facts.len() {
            self.summed.insert(number);
        }
    }

    fn vanishing_summands_of(&mut self, number: usize, polynomial: &Polynomial) -> Option<()> {
        let (numbers, _) = self.signs_near(polynomial);
        let own = self.sign_facts(&numbers);
        for opposite in [false, true] {
            let sum = if opposite {
                polynomial.negated()
            } else {
                polynomial.clone()
            };
            let most = self.budget.left() / 30;
            let Some(Some(found)) = self
                .budget
                .attempt(most, |steps| algebra::positive(&sum, false, &own, &[], steps))
            else {
                continue;
            };
            if found.multiplier.iter().any(|exponent| *exponent > 0) {
                continue;
            }
            let summands: Vec<Summand> = found
                .summands
                .iter()
                .map(|summand| Summand {
                    factor: summand.coefficient.clone(),
                    facts: repeated(&numbers, &summand.exponents),
                    root: summand.square.clone(),
                })
                .collect();
            for (place, summand) in summands.iter().enumerate() {
                let mut value = summand.root.times(&summand.root).scaled(&summand.factor);
                for &fact in &summand.facts {
                    value = value.times(&self.polynomial(fact));
                }
                let own = Inference::Sign {
                    target: value.clone(),
                    strict: false,
                    factors: Vec::new(),
                    summands: vec![summand.clone()],
                    terms: Vec::new(),
                };
                // -value = sum of the others - sum
                let mut others = summands.clone();
                others.remove(place);
                let factor = Polynomial::integer(if opposite { 1 } else { -1 });
                let rest = Inference::Sign {
                    target: value.negated(),
                    strict: false,
                    factors: Vec::new(),
                    summands: others,
                    terms: vec![(factor, number)],
                };
                let (low, high) = (self.step(own).ok()?, self.step(rest).ok()?);
                self.mark_derived(low);
                self.mark_derived(high);
                self.step(Inference::Squeezed { low, high }).ok()?;
            }
            return Some(());
        }
        None
    }

    /// Looks for a contradiction among the facts.
    pub fn show_absurd(&mut self) -> bool {
        if self.checker.is_absurd() {
            return true;
        }
        for number in 0..self.checker.facts.len() {
            let property = self.checker.facts[number].property;
            if !matches!(property, Property::Nonzero | Property::Positive) || self.is_derived(number) {
                continue;
            }
            if let Some(copy) = self.reduced_fact(number)
                && self.polynomial(copy).is_zero()
            {
                self.absurd_from(copy);
                return self.checker.is_absurd();
            }
        }
        // what is supposed stands last
        let mut newest = self.reduced_signs();
        newest.reverse();
        for fact in newest.into_iter().take(MOST_SQUEEZED) {
            let strict = self.checker.facts[fact].property == Property::Positive;
            let polynomial = self.polynomial(fact);
            let opposite = self.show_sign(&polynomial.negated(), !strict);
            if let Some(opposite) = opposite {
                let (positive, other) = if strict { (fact, opposite) } else { (opposite, fact) };
                self.contradict(positive, other);
                break;
            }
        }
        self.checker.is_absurd()
    }

    /// Whether the root of a positive number is known to be positive: shows it.
    pub fn show_root_positive(&mut self, root: Term, of: &Polynomial) -> Option<usize> {
        self.show_sign(of, true)?;
        let root = Polynomial::generator(root);
        self.by_cases(&root.clone(), true, Property::Positive, &root, &mut |session| {
            session.triangulate_all();
            session.show_absurd().then_some(())
        })
    }

    /// Shows that what is neither negative nor 0 is positive.
    pub fn show_positive(&mut self, polynomial: &Polynomial) -> Option<usize> {
        let nonzero = match self.show_nonzero(polynomial) {
            Some(fact) => fact,
            None => self.nonzero_fact(polynomial)?.0,
        };
        self.show_sign(polynomial, false)?;
        self.by_cases(polynomial, true, Property::Positive, polynomial, &mut |session| {
            session.triangulate_all();
            if let Some(copy) = session.reduced_fact(nonzero)
                && session.polynomial(copy).is_zero()
            {
                session.absurd_from(copy);
            }
            session.show_absurd().then_some(())
        })
    }

    /// Shows that a sine is not negative where its argument is between 0 and pi.
    pub fn show_sine_sign(&mut self, argument: Term) -> Option<usize> {
        let pi = self.terms().add(Node::Pi);
        let angle = self.numerator_of_polynomial(argument)?;
        let rest = Polynomial::generator(pi).minus(&angle);
        self.show_sign(&angle, false)?;
        self.show_sign(&rest, false)?;
        let zero = self.terms().integer(0);
        let [sine, of_pi, of_zero] = [argument, pi, zero].map(|at| self.terms().elementary(Elementary::Sin, at));
        let value = Polynomial::generator(sine);
        if self.show_sign(&angle, true).is_some() && self.show_sign(&rest, true).is_some() {
            return self.axiom("SinePositive", &[argument]);
        }
        self.axiom("SineOfPi", &[]);
        self.axiom("SineOfZero", &[zero]);
        self.by_cases(&angle, true, Property::NonNegative, &value, &mut |session| {
            let congruent = |session: &mut Self, other: Term| {
                let step = Inference::Congruence {
                    left: sine,
                    right: other,
                };
                session.step(step).ok()?;
                session.triangulate_all();
                session.show_zero(&value).map(|_| ())
            };
            if session.checker.knows_polynomial(Property::Zero, &angle) {
                return congruent(session, of_zero);
            }
            if !session.checker.knows_polynomial(Property::Positive, &angle) {
                return session.show_absurd().then_some(());
            }
            let shown = session.by_cases(&rest, true, Property::NonNegative, &value, &mut |session| {
                if session.checker.knows_polynomial(Property::Zero, &rest) {
                    return congruent(session, of_pi);
                }
                if session.checker.knows_polynomial(Property::Positive, &rest) {
                    return session
                        .step(Inference::Axiom(Axiom {
                            name: "SinePositive",
                            terms: vec![argument],
                        }))
                        .ok()
                        .map(|_| ());
                }
                session.show_absurd().then_some(())
            });
            shown.map(|_| ())
        })
    }

    /// Shows what must hold for a law to say something at a time.
    pub fn show_conditions(&mut self, source: LawSource, at: Option<Term>) -> Option<()> {
        let conditions = self.checker.instance(source, at).ok()?.conditions;
        self.show_all(conditions)
    }

    /// Shows properties of terms, one after the other.
    pub fn show_all(&mut self, properties: Vec<(Property, Term)>) -> Option<()> {
        for (property, of) in properties {
            if self.checker.knows(property, of).ok()? {
                continue;
            }
            self.describe_roots(of);
            for inner in self.checker.statement.terms().inside(of) {
                if let Node::Elementary(Elementary::Root(index), radicand) = self.node(inner)
                    && index % 2 == 0
                    && let Some(radicand) = self.numerator_of_polynomial(radicand)
                {
                    self.show_root_positive(inner, &radicand);
                }
            }
            self.nonzero_radicands();
            match property {
                Property::Positive | Property::NonNegative => {
                    let signed = self.signed_numerator(of)?;
                    self.show_sign(&signed, property == Property::Positive)?;
                }
                Property::Nonzero => {
                    let numerator = self.numerator(of)?;
                    if self.show_nonzero(&numerator).is_none() {
                        self.nonzero_fact(&numerator)?;
                    }
                }
                Property::Zero | Property::Integer => return None,
            }
        }
        Some(())
    }

    /// The radicand of a root that is not 0 is not 0.
    fn nonzero_radicands(&mut self) {
        for generator in self.generators(&[]) {
            let Node::Elementary(Elementary::Root(index), of) = self.node(generator) else {
                continue;
            };
            let Some(radicand) = self.numerator_of_polynomial(of) else {
                continue;
            };
            let root = Polynomial::generator(generator);
            let mut power = Polynomial::integer(1);
            for _ in 0..index {
                power = power.times(&root);
            }
            let relation = power.minus(&radicand);
            let facts = &self.checker.facts;
            let relation = facts
                .iter()
                .position(|fact| fact.property == Property::Zero && fact.polynomial == relation);
            if self.checker.knows_polynomial(Property::Nonzero, &radicand) {
                continue;
            }
            if let Some(relation) = relation
                && let Some(nonzero) = self.show_nonzero(&root)
            {
                let _ = self.step(Inference::Nonzero {
                    target: radicand,
                    cofactor: Polynomial::integer(1),
                    factors: vec![(nonzero, index)],
                    terms: vec![(Polynomial::integer(-1), relation)],
                });
            }
        }
    }

    /// A term without divisors, as a polynomial.
    pub fn numerator_of_polynomial(&mut self, term: Term) -> Option<Polynomial> {
        let quotient = self.checker.expansion.of(self.checker.statement.terms(), term).ok()?;
        quotient.divisors.is_empty().then_some(quotient.numerator)
    }
}

fn repeated(facts: &[usize], exponents: &[u32]) -> Vec<usize> {
    let each = facts.iter().zip(exponents);
    each.flat_map(|(&fact, &exponent)| std::iter::repeat_n(fact, exponent as usize))
        .collect()
}
