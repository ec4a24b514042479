//! A proof in the making: the steps so far, and the facts that the kernel makes of them.

use super::laws::Laws;
use crate::algebra::{
    Order, QuotientAlgebra, Steps, coefficients_in, degree_in, exact_quotient, pseudo_divide, radical_member,
};
use dashu_ratio::RBig;
use kernel::{
    Axiom, AxiomRow, Certificate, Checker, Elementary, Fact, Inference, Node, Polynomial, Property, Quantity, Refusal,
    Statement, Summand, Symbol, Term, Terms, sign,
};
use num_traits::{One, Zero};
use numbers::{Field, Rational};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// The steps that the kernel may take for each one of the search, in all inferences of a session: what it refuses and
/// what is not used in the end costs steps too.
const KERNEL_STEPS: u64 = 4;

/// The monomials that are looked at in the time of one operation on coefficients.
const LOOKS_OF_A_STEP: u64 = 16;

/// What an inference costs, as steps of a division do.
const STEPS_OF_INFERENCE: u64 = 20;

/// The most terms of a polynomial while it is reduced: what grows further is checked at great cost, if ever.
const MOST_TERMS: usize = 4000;

/// A proof in the making.
pub struct Session<'a> {
    /// The laws found so far.
    pub laws: Laws,
    pub checker: Checker<'a>,
    pub steps: Vec<Inference>,
    pub budget: Steps,
    /// Facts that vanish and are reduced by one another, each with what it determines.
    pub triangle: Vec<Pivot>,
    /// Axioms that were taken, so that none is taken twice.
    taken: BTreeSet<String>,
    tried: BTreeSet<usize>,
    left_over: Vec<usize>,
    /// Facts that follow from others by the triangle alone, and bring nothing new.
    derived: BTreeSet<usize>,
    /// The copy of a fact that is reduced by the triangle in its present state, if there is one.
    reduced: HashMap<usize, (usize, Option<usize>)>,
    /// Counts the changes of the triangle.
    version: usize,
    /// Facts that were divided by their factors, or taken apart into summands that vanish.
    pub divided: BTreeSet<usize>,
    pub summed: BTreeSet<usize>,
    /// Facts whose exponentials were compared; functions of arguments of which signs and ranges were looked for.
    pub compared: BTreeSet<usize>,
    pub described: BTreeSet<(Elementary, Term)>,
    /// Signs that were not found, in the state of what was known.
    hopeless: BTreeSet<String>,
    /// Whether sets that are thin in generic symbols are excluded.
    excludes: bool,
}

/// What a session knows besides the facts, to be returned to after a case.
struct Snapshot {
    laws: Laws,
    mark: (usize, usize, bool),
    triangle: Vec<Pivot>,
    taken: BTreeSet<String>,
    tried: BTreeSet<usize>,
    left_over: Vec<usize>,
    derived: BTreeSet<usize>,
    reduced: HashMap<usize, (usize, Option<usize>)>,
    version: usize,
    divided: BTreeSet<usize>,
    summed: BTreeSet<usize>,
    hopeless: BTreeSet<String>,
    compared: BTreeSet<usize>,
    described: BTreeSet<(Elementary, Term)>,
    steps: Vec<Inference>,
}

/// A fact that determines a generator, or a power of it, by those before it.
#[derive(Clone, Debug)]
pub struct Pivot {
    pub fact: usize,
    pub generator: Term,
    pub degree: u32,
    /// Facts whose product is the leading coefficient, up to a number; none where it is a number.
    pub lead: Vec<(usize, u32)>,
    /// What it is determined by.
    by: Vec<Term>,
}

/// A proof that a polynomial vanishes, from the last step to the first: `factors * before = quotients + after`.
pub struct Link {
    pub before: Polynomial,
    pub factors: Vec<(usize, u32)>,
    pub terms: Vec<(Polynomial, usize)>,
    after: Polynomial,
}

impl<'a> Session<'a> {
    pub fn new(statement: &'a mut Statement, whole: Vec<Term>, budget: u64) -> Self {
        let certificate = Certificate {
            whole,
            steps: Vec::new(),
        };
        Self {
            checker: Checker::new(statement, &certificate, budget.saturating_mul(KERNEL_STEPS)),
            laws: Laws::default(),
            steps: Vec::new(),
            budget: Steps::new(budget),
            triangle: Vec::new(),
            taken: BTreeSet::new(),
            tried: BTreeSet::new(),
            left_over: Vec::new(),
            derived: BTreeSet::new(),
            reduced: HashMap::new(),
            version: 0,
            divided: BTreeSet::new(),
            summed: BTreeSet::new(),
            hopeless: BTreeSet::new(),
            compared: BTreeSet::new(),
            described: BTreeSet::new(),
            excludes: false,
        }
    }

    /// Excludes sets that are thin in generic symbols from now on; `false` where that is nothing new.
    pub fn exclude(&mut self) -> bool {
        if self.excludes || self.checker.statement.generic().is_empty() {
            return false;
        }
        self.excludes = true;
        self.divided.clear();
        true
    }

    /// A polynomial as a term.
    pub fn polynomial_term(&mut self, polynomial: &Polynomial) -> Term {
        term_of(self.terms(), polynomial)
    }

    /// A fact that a polynomial in generic symbols is not 0, where such are excluded.
    pub fn generic_fact(&mut self, polynomial: &Polynomial) -> Option<usize> {
        let mut nodes = polynomial.generators().into_iter().map(|term| self.node(term));
        let generic = self.checker.statement.generic();
        let fits = |node: Node| matches!(node, Node::Symbol(symbol) if generic.contains(&symbol));
        if !self.excludes || !nodes.all(fits) {
            return None;
        }
        let term = self.polynomial_term(polynomial);
        self.step(Inference::Generic(term)).ok()
    }

    /// Whether a term is a symbol that is known to be an integer.
    pub fn is_integer(&self, term: Term) -> bool {
        let of_term = Polynomial::generator(term);
        matches!(self.node(term), Node::Symbol(_)) && self.checker.knows_polynomial(Property::Integer, &of_term)
    }

    /// Shows a property of a polynomial in each case of the sign of another (`order`), or of whether it is 0. `prove`
    /// is called in every case and need not do anything where the case contradicts what is known.
    pub fn by_cases(
        &mut self,
        on: &Polynomial,
        order: bool,
        property: Property,
        target: &Polynomial,
        prove: &mut dyn FnMut(&mut Self) -> Option<()>,
    ) -> Option<usize> {
        let cases = match order {
            true => vec![
                (Property::Positive, on.clone()),
                (Property::Zero, on.clone()),
                (Property::Positive, on.negated()),
            ],
            false => vec![(Property::Zero, on.clone()), (Property::Nonzero, on.clone())],
        };
        let mut branches = Vec::new();
        for (case, polynomial) in cases {
            let before = self.snapshot();
            self.checker.suppose(case, polynomial);
            let known =
                |session: &Self| session.checker.is_absurd() || session.checker.knows_polynomial(property, target);
            let shown = known(self) || {
                let _ = prove(self);
                known(self)
            };
            let steps = self.restore(before);
            if !shown {
                return None;
            }
            branches.push(steps);
        }
        self.step(Inference::Cases {
            on: on.clone(),
            order,
            property,
            target: target.clone(),
            branches,
        })
        .ok()
    }

    /// The steps that `prove` takes while a symbol runs over a flight (if any); what they add is forgotten again.
    pub fn aside(
        &mut self,
        running: Option<(Symbol, i32)>,
        prove: &mut dyn FnMut(&mut Self) -> Option<()>,
    ) -> Option<Vec<Inference>> {
        let before = self.snapshot();
        let outer = self.checker.run_over(running);
        let shown = prove(self);
        self.checker.run_over(outer);
        let steps = self.restore(before);
        shown.map(|()| steps)
    }

    fn snapshot(&mut self) -> Snapshot {
        Snapshot {
            laws: self.laws.clone(),
            mark: self.checker.mark(),
            triangle: self.triangle.clone(),
            taken: self.taken.clone(),
            tried: self.tried.clone(),
            left_over: self.left_over.clone(),
            derived: self.derived.clone(),
            reduced: self.reduced.clone(),
            version: self.version,
            divided: self.divided.clone(),
            summed: self.summed.clone(),
            hopeless: self.hopeless.clone(),
            compared: self.compared.clone(),
            described: self.described.clone(),
            steps: std::mem::take(&mut self.steps),
        }
    }

    /// Forgets what was found since a snapshot; gives the steps that were taken.
    fn restore(&mut self, before: Snapshot) -> Vec<Inference> {
        self.checker.back_to(before.mark);
        self.laws = before.laws;
        self.triangle = before.triangle;
        self.taken = before.taken;
        self.tried = before.tried;
        self.left_over = before.left_over;
        self.derived = before.derived;
        self.reduced = before.reduced;
        self.version = before.version;
        self.divided = before.divided;
        self.summed = before.summed;
        self.hopeless = before.hopeless;
        self.compared = before.compared;
        self.described = before.described;
        std::mem::replace(&mut self.steps, before.steps)
    }

    pub fn terms(&mut self) -> &mut Terms {
        self.checker.statement.terms_mut()
    }

    /// Adds a step, and gives the number of the fact that it makes.
    pub fn step(&mut self, step: Inference) -> Result<usize, Refusal> {
        self.budget.take(STEPS_OF_INFERENCE).map_err(|_| Refusal::Effort)?;
        self.checker.apply(&step)?;
        self.steps.push(step);
        Ok(self.checker.facts.len() - 1)
    }

    /// Adds an axiom once; nothing where the kernel does not accept it.
    pub fn axiom(&mut self, name: &'static str, terms: &[Term]) -> Option<usize> {
        debug_assert!(AxiomRow::named(name).is_some(), "no axiom {name}");
        let terms = terms.to_vec();
        self.once(Inference::Axiom(Axiom { name, terms }))
    }

    /// Writes a whole term, or the symbol of an abbreviation, out.
    pub fn unfold(&mut self, term: Term) -> Option<usize> {
        self.once(Inference::Unfold(term))
    }

    /// Writes a power whose exponent is any number by exponential and logarithm.
    pub fn real_power(&mut self, base: Term, exponent: Term) -> Option<usize> {
        self.axiom("RealPower", &[base, exponent])
            .or_else(|| self.axiom("ComplexPower", &[base, exponent]))
    }

    /// Adds a step once.
    fn once(&mut self, step: Inference) -> Option<usize> {
        let name = format!("{step:?}");
        if self.taken.contains(&name) {
            return None;
        }
        // what is not known now may be known later
        let found = self.step(step).ok()?;
        self.taken.insert(name);
        Some(found)
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
        let new = zeros.filter(|(number, _)| !self.derived.contains(number));
        new.map(|(number, _)| number).collect()
    }

    /// The facts that say that something is not 0.
    pub fn nonzeros(&self) -> Vec<usize> {
        let facts = self.checker.facts.iter().enumerate();
        let wanted = |property: Property| matches!(property, Property::Nonzero | Property::Positive);
        let found = facts.filter(|(_, fact)| wanted(fact.property) && fact.polynomial.as_constant().is_none());
        found.map(|(number, _)| number).collect()
    }

    /// Takes from the budget what a look at every fact costs.
    fn look_at_facts(&mut self) -> Option<()> {
        let looked_at = self.checker.facts.len() as u64;
        self.budget.take(looked_at / LOOKS_OF_A_STEP).ok()
    }

    /// Every generator of the facts and of these polynomials.
    pub fn generators(&self, more: &[Polynomial]) -> BTreeSet<Term> {
        let facts = self.checker.facts.iter().flat_map(|fact| fact.polynomial.generators());
        facts.chain(more.iter().flat_map(Polynomial::generators)).collect()
    }

    /// Known nonzero facts whose product is the polynomial up to a number, with that number.
    pub fn nonzero_product(&mut self, polynomial: &Polynomial) -> Option<(Rational, Vec<(usize, u32)>)> {
        self.look_at_facts()?;
        let mut rest = polynomial.clone();
        let mut factors: Vec<(usize, u32)> = Vec::new();
        for number in self.nonzeros() {
            if rest.as_constant().is_some() {
                break;
            }
            let fact = self.polynomial(number);
            if fact.terms().is_empty() || fact.generators().iter().any(|&inner| degree_in(&rest, inner) == 0) {
                continue;
            }
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

    /// A known nonzero fact that is a multiple of the polynomial, with the quotient.
    fn nonzero_multiple(&mut self, polynomial: &Polynomial) -> Option<(Polynomial, Vec<(usize, u32)>)> {
        let mut own = self.nonzeros();
        own.retain(|&number| !self.is_derived(number));
        for number in own {
            self.reduced_fact(number);
        }
        self.look_at_facts()?;
        self.nonzeros().into_iter().find_map(|number| {
            let fact = self.polynomial(number);
            let quotient = exact_quotient(&fact, polynomial, &mut self.budget).ok()??;
            Some((quotient, vec![(number, 1)]))
        })
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
            None => self.step(Inference::Enclosure(positive)).ok()?,
        };
        Some((number, sign))
    }

    /// Takes a fact that vanishes into the triangle, if a generator of it can be the main one: as it is, where it is
    /// linear in a new generator and the triangle stays without circles, else reduced by those in it. `may` says which
    /// generators may be.
    pub fn triangulate(&mut self, fact: usize, may: &dyn Fn(&Terms, Term) -> bool) -> Option<()> {
        self.budget.take(self.triangle.len() as u64).ok()?;
        if let Some(pivot) = self.definition(fact, may) {
            self.triangle.push(pivot);
            self.sort_triangle();
            return Some(());
        }
        let fact = self.reduced_fact(fact)?;
        let polynomial = self.polynomial(fact);
        if polynomial.is_zero() {
            return Some(());
        }
        if polynomial.as_constant().is_some() {
            return None;
        }
        let mains: BTreeMap<Term, u32> = self
            .triangle
            .iter()
            .map(|pivot| (pivot.generator, pivot.degree))
            .collect();
        type Rank = (u32, bool, (u8, i32), usize);
        let mut best: Option<(Rank, Pivot)> = None;
        // what speaks of derivatives along maps determines these, not what they depend on
        let of_partials = polynomial.generators().iter().any(|&term| self.is_partial(term));
        for generator in polynomial.generators() {
            let is_symbol = matches!(self.node(generator), Node::Symbol(_) | Node::Value(..));
            if !may(self.checker.statement.terms(), generator)
                || (of_partials && is_symbol && !self.is_partial(generator))
            {
                continue;
            }
            self.budget.take(polynomial.terms().len() as u64).ok()?;
            let coefficients = coefficients_in(&polynomial, generator);
            let degree = u32::try_from(coefficients.len() - 1).ok()?;
            let Some(lead) = coefficients.last().cloned() else {
                continue;
            };
            // a smaller power takes the place of a larger one
            if mains
                .get(&generator)
                .is_some_and(|&known| known <= degree || lead.as_constant().is_none())
            {
                continue;
            }
            // a power is reduced by a number only, or every reduction would need the coefficient
            if degree > 1 && lead.as_constant().is_none() {
                continue;
            }
            // a root is determined by its power, rather than a symbol with a coefficient by the root
            let is_root = lead.as_constant().is_some()
                && degree > 1
                && matches!(self.node(generator), Node::Elementary(Elementary::Root(index), _) if index == degree);
            let rank = (
                if is_root { 1 } else { degree },
                lead.as_constant().is_none(),
                if is_root {
                    (10, 0)
                } else if self.is_inside_another(generator, &polynomial) {
                    (12, 0)
                } else {
                    self.late(generator)
                },
                lead.terms().len(),
            );
            if best.as_ref().is_some_and(|(known, _)| *known <= rank) {
                continue;
            }
            let mut factors = self.nonzero_product(&lead);
            if factors.is_none() && self.is_partial(generator) {
                // that a derivative exists is known of what the lead was before it was reduced
                let mut known = self.nonzeros();
                known.retain(|&fact| !self.is_derived(fact) && self.checker.facts[fact].polynomial.terms().len() > 1);
                for fact in known {
                    self.reduced_fact(fact);
                }
                factors = self.nonzero_product(&lead);
            }
            let Some((_, lead)) = factors else {
                continue;
            };
            best = Some((
                rank,
                Pivot {
                    fact,
                    generator,
                    degree,
                    lead,
                    by: polynomial
                        .generators()
                        .into_iter()
                        .filter(|&by| by != generator)
                        .collect(),
                },
            ));
        }
        let (_, pivot) = best?;
        let replaced = self
            .triangle
            .iter()
            .position(|known| known.generator == pivot.generator);
        if let Some(place) = replaced {
            self.left_over.push(self.triangle.remove(place).fact);
        }
        // powers that the new one determines a part of are taken in again, so that none reduces another in a circle
        let generator = pivot.generator;
        for place in (0..self.triangle.len()).rev() {
            let known = &self.triangle[place];
            if known.degree > 1 && degree_in(&self.polynomial(known.fact), generator) >= pivot.degree {
                self.left_over.push(self.triangle.remove(place).fact);
            }
        }
        self.triangle.push(pivot);
        self.sort_triangle();
        Some(())
    }

    /// Whether a term is a derivative along a map.
    pub fn is_partial(&self, term: Term) -> bool {
        let statement = &self.checker.statement;
        matches!(statement.terms().node(term), Node::Symbol(symbol)
            if matches!(statement.quantity(*symbol), Some(Quantity::Partial { .. })))
    }

    /// A fact as the definition of a symbol by others, some of which are determined themselves: such chains are
    /// followed link by link and never multiplied out.
    fn definition(&mut self, fact: usize, may: &dyn Fn(&Terms, Term) -> bool) -> Option<Pivot> {
        let polynomial = self.polynomial(fact);
        let generators = polynomial.generators();
        let linear = |session: &Self, term: Term| session.is_determined(term);
        if !generators.iter().any(|&term| linear(self, term)) || generators.iter().any(|&term| self.is_partial(term)) {
            return None;
        }
        let mut best: Option<((u8, i32), Pivot)> = None;
        for &generator in &generators {
            // derivatives along maps have leading coefficients, which are short once they are reduced
            let is_symbol = matches!(self.node(generator), Node::Symbol(_)) && !self.is_partial(generator);
            let known = self.triangle.iter().any(|pivot| pivot.generator == generator);
            let late = self.late(generator);
            if !is_symbol
                || known
                || !may(self.checker.statement.terms(), generator)
                || degree_in(&polynomial, generator) != 1
                || best.as_ref().is_some_and(|(best, _)| *best <= late)
                || self.leads_to(&generators, generator)
            {
                continue;
            }
            let coefficients = coefficients_in(&polynomial, generator);
            let Some((_, lead)) = coefficients
                .get(1)
                .cloned()
                .and_then(|lead| self.nonzero_product(&lead))
            else {
                continue;
            };
            let by = generators.iter().copied().filter(|&by| by != generator).collect();
            let degree = 1;
            best = Some((
                late,
                Pivot {
                    fact,
                    generator,
                    degree,
                    lead,
                    by,
                },
            ));
        }
        best.map(|(_, pivot)| pivot)
    }

    /// Whether what determines these generators, or them in turn, holds another one.
    fn leads_to(&self, from: &[Term], to: Term) -> bool {
        let pivots: HashMap<Term, &Pivot> = self.triangle.iter().map(|pivot| (pivot.generator, pivot)).collect();
        let (mut open, mut met): (Vec<Term>, HashSet<Term>) = (from.to_vec(), HashSet::new());
        open.retain(|&term| term != to);
        while let Some(term) = open.pop() {
            if term == to {
                return true;
            }
            if let Some(pivot) = pivots.get(&term)
                && met.insert(term)
            {
                open.extend(&pivot.by);
            }
        }
        false
    }

    /// What is determined by others stands before these, so that nothing is reduced twice.
    fn sort_triangle(&mut self) {
        let unsorted = std::mem::take(&mut self.triangle);
        let places: HashMap<Term, usize> = (0..)
            .zip(&unsorted)
            .map(|(place, pivot)| (pivot.generator, place))
            .collect();
        let determined =
            |pivot: &Pivot| -> Vec<usize> { pivot.by.iter().filter_map(|by| places.get(by).copied()).collect() };
        let mut needed = vec![0usize; unsorted.len()];
        for place in unsorted.iter().flat_map(determined) {
            needed[place] += 1;
        }
        let mut open: BTreeSet<usize> = (0..unsorted.len()).collect();
        let mut free: BTreeSet<usize> = open.iter().copied().filter(|&place| needed[place] == 0).collect();
        while let Some(place) = free.pop_first().or_else(|| open.first().copied()) {
            open.remove(&place);
            for by in determined(&unsorted[place]) {
                needed[by] -= 1;
                if needed[by] == 0 && open.contains(&by) {
                    free.insert(by);
                }
            }
            self.triangle.push(unsorted[place].clone());
        }
        self.version += 1;
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
            let replaced = std::mem::take(&mut self.left_over);
            if replaced.is_empty() && (open.is_empty() || open.len() == count) {
                break;
            }
            open.extend(replaced);
        }
        self.left_over.extend(open);
    }

    /// Shows that a polynomial is not 0: as a product of what is known not to be.
    pub fn show_nonzero(&mut self, polynomial: &Polynomial) -> Option<usize> {
        let (rest, links) = self.reduce(polynomial, false)?;
        let (cofactor, factors) = match self.nonzero_product(&rest) {
            Some((scale, factors)) => (Polynomial::constant(&(Rational::one() / scale)), factors),
            None => self.nonzero_multiple(&rest)?,
        };
        let mut last = self
            .step(Inference::Nonzero {
                target: rest,
                cofactor,
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

    /// Whether a function with symbols is part of what another generator is a function of.
    fn is_inside_another(&self, generator: Term, polynomial: &Polynomial) -> bool {
        let terms = self.checker.statement.terms();
        let is_function = matches!(terms.node(generator), Node::Elementary(..)) && !terms.is_closed(generator);
        let holds = |other: &Term| *other != generator && terms.inside(*other).contains(&generator);
        is_function && polynomial.generators().iter().any(holds)
    }

    /// How early a generator is expressed by others: what maps and premises determine first, then values of functions,
    /// then definitions, which stand for what they shorten, and parameters last.
    fn late(&self, generator: Term) -> (u8, i32) {
        let statement = &self.checker.statement;
        match statement.terms().node(generator) {
            Node::Symbol(symbol) => match statement.quantity(*symbol) {
                Some(Quantity::Abbreviation { is_local: false }) => (8, 0),
                Some(Quantity::Abbreviation { is_local: true }) => (3, 1),
                Some(Quantity::Partial { .. } | Quantity::Fixed) => (1, 0),
                Some(Quantity::Member { offset, .. }) if statement.instant_of(*symbol).is_some() => (5, -offset),
                Some(Quantity::Member { sequence, offset }) => {
                    let ends = statement.piecewise().iter().flat_map(|own| own.ends.iter().flatten());
                    let begins = ends.into_iter().any(|[begin, end]| *begin == sequence && begin != end);
                    (2, -2 * offset - i32::from(begins))
                }
                _ if statement.generic().contains(symbol) => (7, 0),
                _ => (6, 0),
            },
            Node::Value(..) => (3, -(generator.0 as i32)),
            Node::Pi | Node::Imaginary | Node::Bound | Node::Integral { .. } => (9, 0),
            _ => (4, -(generator.0 as i32)),
        }
    }

    /// A fact reduced by the triangle, as a new fact of the same property.
    pub fn reduced_fact(&mut self, fact: usize) -> Option<usize> {
        let known = self.reduced.get(&fact).copied();
        if let Some((version, copy)) = known
            && version == self.version
        {
            return copy;
        }
        let copy = self.reduce_fact(fact);
        self.reduced.insert(fact, (self.version, copy));
        if let Some(copy) = copy {
            self.reduced.insert(copy, (self.version, Some(copy)));
        }
        copy
    }

    fn reduce_fact(&mut self, fact: usize) -> Option<usize> {
        let property = self.checker.facts.get(fact)?.property;
        let mut current = fact;
        for _ in 0..50 {
            let mut changed = false;
            for place in 0..self.triangle.len() {
                let pivot = &self.triangle[place];
                let (known, generator, degree) = (pivot.fact, pivot.generator, pivot.degree);
                let looked_at = self.checker.facts[current].polynomial.terms().len() as u64;
                self.budget.take(looked_at / LOOKS_OF_A_STEP).ok()?;
                if known == current || degree_in(&self.checker.facts[current].polynomial, generator) < degree {
                    continue;
                }
                let polynomial = self.polynomial(current);
                let divisor = self.polynomial(known);
                let (multiplier, quotient, rest) =
                    pseudo_divide(&polynomial, &divisor, generator, &mut self.budget).ok()??;
                let step = match property {
                    Property::Zero => Inference::Zero {
                        target: rest,
                        power: 1,
                        squares: Vec::new(),
                        factors: Vec::new(),
                        terms: vec![(multiplier, current), (quotient.negated(), known)],
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
                                terms: vec![(quotient.negated().scaled(&inverse), known)],
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
                                terms: vec![(quotient.negated(), known)],
                            }
                        }
                    }
                    Property::Integer => return Some(current),
                };
                current = self.step(step).ok()?;
                self.derived.insert(current);
                changed = true;
            }
            if !changed {
                break;
            }
        }
        Some(current)
    }

    /// Whether a fact follows from others by the triangle alone.
    pub fn is_derived(&self, fact: usize) -> bool {
        self.derived.contains(&fact)
    }

    /// Says that a fact brings nothing new.
    pub fn mark_derived(&mut self, fact: usize) {
        self.derived.insert(fact);
    }

    /// Whether a sign was not tried yet in the present state.
    pub fn is_hopeful(&mut self, polynomial: &Polynomial, strict: bool) -> bool {
        let signs = |property: Property| matches!(property, Property::Positive | Property::NonNegative);
        let facts = self.checker.facts.iter().enumerate();
        let count = facts
            .filter(|(number, fact)| signs(fact.property) && !self.derived.contains(number))
            .count();
        self.hopeless
            .insert(format!("{polynomial:?} {strict} {count} {}", self.version))
    }

    /// Reduces a polynomial by the pivots with a number as leading coefficient, so that its value stays the same.
    pub fn exact_reduction(&mut self, polynomial: &Polynomial) -> Option<(Polynomial, Vec<Link>)> {
        self.reduce(polynomial, true)
    }

    /// A polynomial as a quotient that is reduced by the triangle.
    pub fn reduced_quotient(&mut self, polynomial: &Polynomial) -> Option<(Polynomial, Polynomial)> {
        let (rest, links) = self.reduce(polynomial, false)?;
        let mut below = Polynomial::integer(1);
        for (number, power) in links.iter().flat_map(|link| link.factors.clone()) {
            for _ in 0..power {
                below = below.times_within(&self.polynomial(number), 2000)?;
            }
        }
        Some((rest, below))
    }

    /// Short facts that vanish and determine nothing, reduced by the triangle.
    pub fn undetermining(&mut self) -> Vec<usize> {
        let reduced = self
            .left_over
            .clone()
            .into_iter()
            .filter_map(|fact| self.reduced_fact(fact));
        let mut numbers: Vec<usize> = reduced.collect();
        numbers.retain(|&fact| (1..=12).contains(&self.polynomial(fact).terms().len()));
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }

    /// The facts that vanish: those that are no copies, and the powers of the triangle.
    pub fn vanishing(&self) -> Vec<usize> {
        let mut numbers = self.zeros();
        let powers = self.triangle.iter().filter(|pivot| pivot.degree > 1);
        numbers.extend(powers.map(|pivot| pivot.fact));
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }

    /// Reduces a polynomial by the triangle: what is left, and the links that lead back to it.
    fn reduce(&mut self, polynomial: &Polynomial, exact: bool) -> Option<(Polynomial, Vec<Link>)> {
        let (mut current, mut links) = (polynomial.clone(), Vec::new());
        for _ in 0..50 {
            let mut changed = false;
            for place in 0..self.triangle.len() {
                let pivot = &self.triangle[place];
                let (known, generator) = (pivot.fact, pivot.generator);
                if degree_in(&current, generator) < pivot.degree || (exact && !pivot.lead.is_empty()) {
                    continue;
                }
                let divisor = self.polynomial(known);
                let (multiplier, quotient, rest) =
                    pseudo_divide(&current, &divisor, generator, &mut self.budget).ok()??;
                if rest.terms().len() > MOST_TERMS {
                    return None;
                }
                let (scale, factors) = self.nonzero_product(&multiplier)?;
                let inverse = Rational::one() / scale;
                let after = rest.scaled(&inverse);
                links.push(Link {
                    before: current,
                    factors,
                    terms: vec![(quotient.scaled(&inverse), known)],
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

    /// Whether a polynomial vanishes by the triangle.
    pub fn reduces_to_zero(&mut self, polynomial: &Polynomial) -> bool {
        self.reduce(polynomial, false).is_some_and(|(rest, _)| rest.is_zero())
    }

    /// What a polynomial is modulo the pivots with a number as leading coefficient, so that equal values have equal forms.
    pub fn normal_form(&mut self, polynomial: &Polynomial) -> Option<Polynomial> {
        self.reduce(polynomial, true).map(|(rest, _)| rest)
    }

    /// What a term is by the pivots with a number as leading coefficient, where that tells it from others: not of a
    /// quotient, nor where a pivot divides by more than a number.
    pub fn value_form(&mut self, term: Term) -> Option<Polynomial> {
        let quotient = self.checker.expansion.of(self.checker.statement.terms(), term).ok()?;
        let divided: Vec<Term> = self
            .triangle
            .iter()
            .filter(|pivot| !pivot.lead.is_empty())
            .map(|pivot| pivot.generator)
            .collect();
        let is_plain =
            quotient.divisors.is_empty() && !quotient.numerator.generators().iter().any(|of| divided.contains(of));
        is_plain.then(|| self.normal_form(&quotient.numerator)).flatten()
    }

    /// Whether the difference of two terms vanishes by the triangle.
    pub fn is_difference_zero(&mut self, a: Term, b: Term) -> bool {
        let difference = self.terms().difference(a, b);
        self.numerator(difference)
            .is_some_and(|form| self.reduces_to_zero(&form))
    }

    /// Shows that a polynomial vanishes: by the triangle, then by an ideal of what is left.
    pub fn show_zero(&mut self, polynomial: &Polynomial) -> Option<usize> {
        self.show_zero_by(polynomial, &mut |session, rest| session.show_rest(rest))
    }

    /// Shows that a polynomial vanishes by the triangle alone.
    pub fn show_by_triangle(&mut self, polynomial: &Polynomial) -> Option<usize> {
        self.show_zero_by(polynomial, &mut |_, _| None)
    }

    fn show_zero_by(
        &mut self,
        polynomial: &Polynomial,
        show_rest: &mut dyn FnMut(&mut Self, &Polynomial) -> Option<usize>,
    ) -> Option<usize> {
        if polynomial.is_zero() {
            return self.zero_step(Polynomial::default(), Vec::new(), Vec::new());
        }
        let (rest, links) = self.reduce(polynomial, false)?;
        let mut last = match rest.is_zero() {
            true => self.zero_step(rest, Vec::new(), Vec::new())?,
            false => show_rest(self, &rest)?,
        };
        for link in links.into_iter().rev() {
            let mut terms = link.terms;
            if !link.after.is_zero() {
                terms.push((Polynomial::integer(1), last));
            }
            last = self.zero_step(link.before, link.factors, terms)?;
            self.derived.insert(last);
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
        let is_known = |fact: &Fact| fact.property == Property::Zero && fact.polynomial.is_multiple_of(rest);
        if let Some(known) = self.checker.facts.iter().position(is_known) {
            let (own, (_, value)) = (rest.terms().first()?, self.polynomial(known).terms().first()?.clone());
            let ratio = Polynomial::constant(&Rational(&own.1 / &value));
            return self.zero_step(rest.clone(), Vec::new(), vec![(ratio, known)]);
        }
        if rest
            .generators()
            .iter()
            .all(|&g| self.checker.statement.terms().is_closed(g))
        {
            return self.show_closed(rest);
        }
        if let Some(found) = self.show_coefficients(rest) {
            return Some(found);
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

    /// Shows that an algebraic number is 0: its minimal polynomial modulo the relations of the triangle is a power of
    /// the unknown times a factor that is not 0 by an enclosure. Complete, within the steps and digits, for numbers
    /// whose generators the triangle determines.
    fn show_closed(&mut self, number: &Polynomial) -> Option<usize> {
        if sign(self.checker.statement.terms(), number).is_some() {
            return None;
        }
        let mut wanted: BTreeSet<Term> = number.generators().into_iter().collect();
        let (mut relations, mut facts): (Vec<(Term, Polynomial)>, Vec<usize>) = (Vec::new(), Vec::new());
        while let Some(pivot) = self
            .triangle
            .iter()
            .find(|pivot| wanted.contains(&pivot.generator) && !facts.contains(&pivot.fact))
        {
            let polynomial = self.polynomial(pivot.fact);
            wanted.extend(polynomial.generators());
            relations.push((pivot.generator, polynomial));
            facts.push(pivot.fact);
        }
        let algebra = QuotientAlgebra::new(&relations)?;
        let most = self.budget.left() / 2;
        let (power, other, product) = self.budget.attempt(most, |steps| {
            let Some(minimal) = algebra.minimal_polynomial(number, steps)? else {
                return Ok(None);
            };
            let power = minimal.multiplicity_of_zero();
            let mut other = Polynomial::default();
            for coefficient in minimal.coefficients.iter().skip(power).rev() {
                let product = crate::algebra::times(&other, number, steps)?;
                other = algebra.normal_form(&product, steps)?.0;
                other = other.plus(&Polynomial::constant(coefficient));
            }
            let raised = crate::algebra::power(number, u32::try_from(power).unwrap_or(u32::MAX), steps)?;
            Ok(Some((
                power,
                other.clone(),
                crate::algebra::times(&raised, &other, steps)?,
            )))
        })??;
        if power == 0 {
            return None;
        }
        let (factors, scale) = match other.as_constant() {
            Some(value) => (Vec::new(), Rational::one() / value),
            None => {
                let (fact, sign) = self.closed_nonzero(&other)?;
                (vec![(fact, 1)], Rational::from_integer(sign))
            }
        };
        let product = product.scaled(&scale);
        let (_, cofactors) = self
            .budget
            .attempt(most, |steps| algebra.normal_form(&product, steps))?;
        let terms = cofactors.into_iter().zip(facts);
        let step = Inference::Zero {
            target: number.clone(),
            power: u32::try_from(power).ok()?,
            squares: Vec::new(),
            factors,
            terms: terms.filter(|(cofactor, _)| !cofactor.is_zero()).collect(),
        };
        self.step(step).ok()
    }

    /// Shows that a combination of open monomials vanishes as its coefficients, numbers, do.
    fn show_coefficients(&mut self, rest: &Polynomial) -> Option<usize> {
        let mut coefficients: BTreeMap<kernel::Monomial, Vec<(kernel::Monomial, dashu_ratio::RBig)>> = BTreeMap::new();
        let mut some_closed = false;
        for (monomial, value) in rest.terms() {
            let terms = self.checker.statement.terms();
            let (closed, open): (Vec<_>, Vec<_>) = monomial.iter().partition(|(term, _)| terms.is_closed(*term));
            some_closed |= !closed.is_empty();
            let entry = coefficients.entry(open.into_iter().collect()).or_default();
            entry.push((closed.into_iter().collect(), value.clone()));
        }
        if !some_closed {
            return None;
        }
        let mut terms = Vec::new();
        for (monomial, parts) in coefficients {
            let coefficient = Polynomial::from_terms(parts);
            let fact = self.show_closed(&coefficient)?;
            terms.push((Polynomial::from_terms([(monomial, dashu_ratio::RBig::ONE)]), fact));
        }
        self.zero_step(rest.clone(), Vec::new(), terms)
    }

    /// The facts that share generators with a polynomial, directly or through others: reduced ones only.
    pub fn relevant(&mut self, polynomial: &Polynomial) -> (Vec<usize>, Vec<usize>) {
        let reduced = |of: Vec<usize>, session: &mut Self| -> Vec<usize> {
            let mut kept: Vec<usize> = Vec::new();
            for fact in of {
                let Some(number) = session.reduced_fact(fact) else {
                    continue;
                };
                if session.budget.take(kept.len() as u64).is_err() {
                    break;
                }
                let polynomial = &session.checker.facts[number].polynomial;
                let known = |&other: &usize| session.checker.facts[other].polynomial.is_multiple_of(polynomial);
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
        let zeros = self.zeros().into_iter().filter(|fact| !pivots.contains(fact));
        let zeros: Vec<usize> = zeros.collect();
        let mut zeros = reduced(zeros, self);
        zeros.extend(
            powers
                .iter()
                .filter(|fact| !zeros.contains(fact))
                .copied()
                .collect::<Vec<_>>(),
        );
        let mut nonzeros = self.nonzeros();
        nonzeros.retain(|fact| !self.derived.contains(fact));
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

    /// The node of a term.
    pub fn node(&self, term: Term) -> Node {
        self.checker.statement.terms().node(term).clone()
    }
}

/// A polynomial as a sum of products of its generators.
pub fn term_of(terms: &mut Terms, polynomial: &Polynomial) -> Term {
    let mut parts = Vec::new();
    for (monomial, value) in polynomial.terms() {
        let mut factors = Vec::new();
        if *value != RBig::ONE || monomial.is_empty() {
            factors.push(terms.number(Rational(value.clone())));
        }
        for &(term, power) in monomial {
            let exponent = i32::try_from(power).unwrap_or(i32::MAX);
            factors.push(if power == 1 {
                term
            } else {
                terms.add(Node::Power(term, exponent))
            });
        }
        parts.push(terms.product(factors));
    }
    terms.sum(parts)
}
