//! The acceptance of certificates: each step is checked by multiplying out, nothing is searched for.

use super::axiom::{Axiom, Guard, written};
use super::boxes;
use super::certificate::{Certificate, Inference, LawSource, Summand};
use super::expand::{Expansion, Refusal, vanishes};
use super::polynomial::Polynomial;
use super::statement::{Instance, Property, Quantity, Statement};
use super::term::{Node, Symbol, Term};
use num_traits::Zero;
use numbers::Rational;
use std::collections::HashSet;

/// A property of a polynomial over terms.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    pub property: Property,
    pub polynomial: Polynomial,
}

/// A law that steps derived: the term vanishes at every value of its time at which the conditions hold.
#[derive(Clone, Debug)]
struct Derived {
    time: Symbol,
    term: Term,
    conditions: Vec<(Property, Term)>,
    /// What the laws that this one was derived from need to have values.
    domain: Vec<(Property, Term)>,
    interval: Option<i32>,
}

/// What is known while the steps of a certificate are followed.
pub struct Checker<'a> {
    pub statement: &'a mut Statement,
    pub expansion: Expansion,
    pub facts: Vec<Fact>,
    laws: Vec<Derived>,
    /// Properties of terms that are given as they stand.
    assumed: HashSet<(Property, Term)>,
    /// A symbol that runs over an interval within the steps of a `Constant`.
    running: Option<(Symbol, i32)>,
    /// Whether 0 = 1 is known: in a case that cannot be.
    absurd: bool,
    /// What generic symbols were taken not to make 0.
    excluded: Vec<Term>,
}

type Outcome<T> = Result<T, Refusal>;

fn refused<T>(why: impl Into<String>) -> Outcome<T> {
    Err(Refusal::Other(why.into()))
}

impl<'a> Checker<'a> {
    /// A checker that knows what the statement gives, and adds up at most `effort` products.
    pub fn new(statement: &'a mut Statement, certificate: &Certificate, effort: u64) -> Self {
        let givens = statement.givens.iter().filter(|given| given.law.is_none());
        let assumed = givens.map(|given| (given.property, given.term)).collect();
        Self {
            statement,
            expansion: Expansion::new(certificate.whole.iter().copied().collect(), effort),
            facts: Vec::new(),
            laws: Vec::new(),
            assumed,
            running: None,
            absurd: false,
            excluded: Vec::new(),
        }
    }

    /// The terms in generic symbols that were taken not to vanish, in whatever case.
    pub fn excluded(&self) -> &[Term] {
        &self.excluded
    }

    /// Follows steps in order.
    pub fn follow(&mut self, steps: &[Inference]) -> Outcome<()> {
        for (number, step) in steps.iter().enumerate() {
            self.step(step).map_err(|refusal| match refusal {
                Refusal::Other(why) => Refusal::Other(format!("step {number}: {why}")),
                refusal => refusal,
            })?;
        }
        Ok(())
    }

    /// Follows one step.
    pub fn apply(&mut self, step: &Inference) -> Outcome<()> {
        self.step(step)
    }

    /// How many facts and laws there are, to be taken back to.
    pub fn mark(&self) -> (usize, usize, bool) {
        (self.facts.len(), self.laws.len(), self.absurd)
    }

    /// Forgets what was added since a mark.
    pub fn back_to(&mut self, (facts, laws, absurd): (usize, usize, bool)) {
        self.facts.truncate(facts);
        self.laws.truncate(laws);
        self.absurd = absurd;
    }

    /// Takes a property of a polynomial as the case that steps are followed in.
    pub fn suppose(&mut self, property: Property, polynomial: Polynomial) {
        self.add(property, polynomial);
    }

    /// Takes a symbol as one that runs over an interval; gives the one that ran before.
    pub fn run_over(&mut self, running: Option<(Symbol, i32)>) -> Option<(Symbol, i32)> {
        std::mem::replace(&mut self.running, running)
    }

    /// How many laws steps have derived.
    pub fn laws(&self) -> usize {
        self.laws.len()
    }

    /// Whether 0 = 1 is known.
    pub fn is_absurd(&self) -> bool {
        self.absurd
    }

    /// Whether the property of the term is known: given, a fact, or shown by an enclosure.
    pub fn knows(&mut self, property: Property, term: Term) -> Outcome<bool> {
        let implied: &[Property] = match property {
            Property::Nonzero => &[Property::Nonzero, Property::Positive],
            Property::NonNegative => &[Property::NonNegative, Property::Positive, Property::Zero],
            _ => &[property],
        };
        if self.absurd || implied.iter().any(|&property| self.assumed.contains(&(property, term))) {
            return Ok(true);
        }
        let polynomial = self.of_term(property, term)?;
        Ok(self.knows_polynomial(property, &polynomial))
    }

    /// Whether the property of the polynomial is known.
    pub fn knows_polynomial(&self, property: Property, polynomial: &Polynomial) -> bool {
        if self.absurd {
            return true;
        }
        let sign = || self.statement.sign_of(polynomial);
        let by_itself = match property {
            Property::Zero => vanishes(polynomial),
            Property::Nonzero => sign().is_some(),
            Property::Positive => sign() == Some(1),
            Property::NonNegative => vanishes(polynomial) || sign() == Some(1),
            Property::Integer => self.is_integer(polynomial),
        };
        by_itself || self.facts.iter().any(|fact| implies(fact, property, polynomial))
    }

    /// Whether a polynomial holds only generators that are known to be integers, and is an integer wherever they are.
    fn is_integer(&self, polynomial: &Polynomial) -> bool {
        let integer = |term: &Term| {
            let fact = Fact {
                property: Property::Integer,
                polynomial: Polynomial::generator(*term),
            };
            self.assumed.contains(&(Property::Integer, *term)) || self.facts.contains(&fact)
        };
        polynomial.generators().iter().all(integer) && polynomial.is_integer_valued()
    }

    /// The polynomial of which the property is that of the term, where the divisors of the term are not 0.
    fn of_term(&mut self, property: Property, term: Term) -> Outcome<Polynomial> {
        let quotient = self.expansion.of(&self.statement.terms, term)?;
        Ok(match property {
            Property::Zero | Property::Nonzero => quotient.numerator,
            Property::Integer if quotient.divisors.is_empty() => quotient.numerator,
            Property::Integer => return refused("an integer is given by a quotient"),
            Property::Positive | Property::NonNegative => {
                // times the square of what divides to an odd power
                let mut product = quotient.numerator;
                for (divisor, power) in &quotient.divisors {
                    if power % 2 == 1 {
                        product = self.expansion.times(&product, divisor)?;
                    }
                }
                product
            }
        })
    }

    fn add(&mut self, property: Property, polynomial: Polynomial) {
        if property == Property::Zero && !vanishes(&polynomial) && polynomial.as_constant().is_some() {
            self.absurd = true;
        }
        self.facts.push(Fact { property, polynomial });
    }

    /// Adds a property of a term that has a value.
    fn conclude(&mut self, property: Property, term: Term) -> Outcome<()> {
        let polynomial = self.of_term(property, term)?;
        self.add(property, polynomial);
        Ok(())
    }

    fn need(&mut self, property: Property, term: Term) -> Outcome<()> {
        match self.knows(property, term)? {
            true => Ok(()),
            false => refused(format!("{property:?} is not known of a term that must be so")),
        }
    }

    /// The terms have values: what they divide by is not 0, roots and logarithms are of what they are defined for.
    fn defined(&mut self, terms: &[Term]) -> Outcome<()> {
        for &term in terms {
            for (property, of) in self.statement.domain(term) {
                self.need(property, of)?;
            }
        }
        Ok(())
    }

    fn real(&self, polynomial: &Polynomial) -> Outcome<()> {
        match polynomial.generators().iter().all(|&term| self.statement.is_real(term)) {
            true => Ok(()),
            false => refused("an order between complex numbers"),
        }
    }

    fn reals(&self, terms: &[Term]) -> Outcome<()> {
        match terms.iter().all(|&term| self.statement.is_real(term)) {
            true => Ok(()),
            false => refused("a law of real numbers for complex ones"),
        }
    }

    fn fact(&self, number: usize, properties: &[Property]) -> Outcome<Polynomial> {
        match self.facts.get(number) {
            Some(fact) if properties.contains(&fact.property) => Ok(fact.polynomial.clone()),
            Some(fact) => refused(format!("fact {number} is {:?}", fact.property)),
            None => refused(format!("there is no fact {number}")),
        }
    }

    fn combination(&mut self, terms: &[(Polynomial, usize)]) -> Outcome<Polynomial> {
        let mut sum = Polynomial::default();
        for (coefficient, number) in terms {
            let fact = self.fact(*number, &[Property::Zero])?;
            let product = self.expansion.times(coefficient, &fact)?;
            sum = sum.plus(&product);
        }
        Ok(sum)
    }

    fn product(&mut self, factors: &[(usize, u32)], properties: &[Property]) -> Outcome<Polynomial> {
        let mut product = Polynomial::integer(1);
        for (number, power) in factors {
            let fact = self.fact(*number, properties)?;
            let raised = self.expansion.power(&fact, *power)?;
            product = self.expansion.times(&product, &raised)?;
        }
        Ok(product)
    }

    fn step(&mut self, step: &Inference) -> Outcome<()> {
        let count = self.statement.terms.len();
        let is_term = |term: &Term| (term.0 as usize) < count;
        if !step.terms().iter().all(is_term) || !step.polynomials().iter().all(|own| own.is_proper(count)) {
            return refused("a term that is none, or a monomial out of order");
        }
        match step {
            Inference::Given(number) => match self.statement.givens.get(*number).cloned() {
                Some(given) if given.law.is_none() => self.conclude(given.property, given.term),
                _ => refused("there is no such given, or it is a law"),
            },
            Inference::Law { source, at } => self.law(*source, *at),
            Inference::Axiom(axiom) => self.axiom(axiom),
            Inference::Unfold(term) => self.unfold(*term),
            Inference::Enclosure(polynomial) => self.enclosed(polynomial),
            Inference::Between { target, within } => self.between(target, within),
            Inference::Zero {
                target,
                power,
                squares,
                factors,
                terms,
            } => self.zero(target, *power, squares, factors, terms),
            Inference::Nonzero {
                target,
                cofactor,
                factors,
                terms,
            } => self.nonzero(target, cofactor, factors, terms),
            Inference::Sign {
                target,
                strict,
                factors,
                summands,
                terms,
            } => self.sign(target, *strict, factors, summands, terms),
            Inference::Squeezed { low, high } => self.squeezed(*low, *high),
            Inference::Congruence { left, right } => self.congruence(*left, *right),
            Inference::Cases {
                on,
                order,
                property,
                target,
                branches,
            } => self.cases(on, *order, *property, target, branches),
            Inference::Derivative(source) => self.derivative(*source),
            Inference::Constant {
                of,
                time,
                at,
                interval,
                steps,
            } => self.constant(*of, *time, *at, *interval, steps),
            Inference::Generic(term) => self.generic(*term),
            Inference::Along { implicit, equation, by } => self.along(*implicit, *equation, *by),
        }
    }

    /// Adds the law that follows by differentiating a law with respect to its time.
    fn derivative(&mut self, source: LawSource) -> Outcome<()> {
        let mut law = self.derived(source)?;
        let time = law.time;
        let mut terms = vec![law.term];
        terms.extend(law.conditions.iter().map(|(_, of)| *of));
        let moves = |_: &Statement, symbol| symbol == time;
        if !terms
            .iter()
            .all(|&of| self.statement.is_differentiable(of, &|symbol| symbol == time))
        {
            return refused("a branch of a complex function is differentiated");
        }
        law.domain.extend(self.statement.domain(law.term));
        // where a law holds at single times only, its derivative says nothing
        let conditions: Vec<(Property, Term)> = law.conditions.iter().chain(&law.domain).copied().collect();
        let Some(near) = self.statement.holding_near(&conditions, &terms, &moves) else {
            return refused("the law does not hold on an open set");
        };
        law.domain.extend(near);
        let term = self.statement.derivative(law.term, time);
        self.laws.push(Derived { term, ..law });
        Ok(())
    }

    /// Takes a term in generic symbols alone for not 0.
    fn generic(&mut self, term: Term) -> Outcome<()> {
        let vanishing = self
            .statement
            .givens
            .iter()
            .filter(|given| given.property == Property::Zero);
        let vanishing: Vec<Term> = vanishing.map(|given| given.term).collect();
        let said: Vec<Term> = vanishing
            .into_iter()
            .map(|term| self.statement.written_out(term))
            .collect();
        let statement = &self.statement;
        let in_generic = |inner: Term| match statement.terms.node(inner) {
            Node::Symbol(symbol) => statement.generic.contains(symbol),
            Node::Number(_) | Node::Sum(_) | Node::Product(_) | Node::Power(..) => true,
            _ => false,
        };
        let is_generic = |term: Term| statement.terms.inside(term).into_iter().all(in_generic);
        // what premises say of generic symbols alone would have parts, of which one may not be left out
        if !is_generic(term) || said.into_iter().any(is_generic) {
            return refused("no polynomial in generic symbols that are free");
        }
        self.excluded.push(term);
        self.conclude(Property::Nonzero, term)
    }

    /// Differentiates an equation of implicit quantities by one that these depend on.
    fn along(&mut self, number: usize, equation: usize, by: Symbol) -> Outcome<()> {
        let Some(implicit) = self.statement.implicit.get(number).cloned() else {
            return refused("there are no such implicit quantities");
        };
        let Some((_, term)) = implicit.equations.get(equation) else {
            return refused("there is no such equation of implicit quantities");
        };
        if !implicit.by.contains(&by) {
            return refused("implicit quantities are differentiated by what they depend on");
        }
        let written = self.statement.written_out(*term);
        if !self.statement.is_smooth_along(written) {
            return refused("an equation of implicit quantities is not differentiated");
        }
        let by_term = self.statement.terms.symbol(by);
        if self.assumed.contains(&(Property::Integer, by_term)) {
            return refused("implicit quantities are differentiated by an integer");
        }
        let slope = self.statement.along(*term, &implicit, by);
        self.defined(&[*term, slope])?;
        // where the equation has a value at single points only, its derivative says nothing
        let domain = self.statement.domain(written);
        let Some(near) = self.statement.holding_near(&domain, &[written], &Statement::depends) else {
            return refused("an equation of implicit quantities does not hold on an open set");
        };
        for (property, of) in near {
            self.need(property, of)?;
        }
        self.conclude(Property::Zero, slope)
    }

    fn nonzero(
        &mut self,
        target: &Polynomial,
        cofactor: &Polynomial,
        factors: &[(usize, u32)],
        terms: &[(Polynomial, usize)],
    ) -> Outcome<()> {
        let left = self.expansion.times(cofactor, target)?;
        let product = self.product(factors, &[Property::Nonzero, Property::Positive])?;
        let right = product.plus(&self.combination(terms)?);
        self.identical(&left, &right)?;
        self.add(Property::Nonzero, target.clone());
        Ok(())
    }

    fn squeezed(&mut self, low: usize, high: usize) -> Outcome<()> {
        let sign = [Property::NonNegative, Property::Positive];
        let (low, high) = (self.fact(low, &sign)?, self.fact(high, &sign)?);
        self.identical(&low, &high.negated())?;
        self.add(Property::Zero, low);
        Ok(())
    }

    fn enclosed(&mut self, polynomial: &Polynomial) -> Outcome<()> {
        match self.statement.sign_of(polynomial) {
            Some(1) => {
                self.add(Property::Positive, polynomial.clone());
                Ok(())
            }
            _ => refused("no enclosure shows that this is positive"),
        }
    }

    /// Adds that a polynomial is positive, by enclosures over all values of its letters between facts.
    fn between(&mut self, target: &Polynomial, within: &[[usize; 2]]) -> Outcome<()> {
        if self.statement.complex {
            return refused("an order between complex numbers");
        }
        let mut bounds = Vec::new();
        for [low, high] in within {
            let sign = [Property::NonNegative, Property::Positive];
            bounds.push([self.fact(*low, &sign)?, self.fact(*high, &sign)?]);
        }
        if !boxes::is_positive(&self.statement.terms, target, &bounds) {
            return refused("no enclosure shows that this is positive between these bounds");
        }
        self.add(Property::Positive, target.clone());
        Ok(())
    }

    fn identical(&self, left: &Polynomial, right: &Polynomial) -> Outcome<()> {
        match left == right {
            true => Ok(()),
            false => refused("the two sides are not the same polynomial"),
        }
    }

    fn zero(
        &mut self,
        target: &Polynomial,
        power: u32,
        squares: &[(Rational, Polynomial)],
        factors: &[(usize, u32)],
        terms: &[(Polynomial, usize)],
    ) -> Outcome<()> {
        if power == 0 {
            return refused("the power of the claim is 0");
        }
        let mut left = self.expansion.power(target, power)?;
        if !squares.is_empty() {
            if power % 2 == 1 || squares.iter().any(|(factor, _)| *factor <= Rational::zero()) {
                return refused("squares need an even power and positive factors");
            }
            self.real(target)?;
            for (factor, root) in squares {
                self.real(root)?;
                let square = self.expansion.times(root, root)?;
                left = left.plus(&square.scaled(factor));
            }
        }
        let product = self.product(factors, &[Property::Nonzero, Property::Positive])?;
        let left = self.expansion.times(&left, &product)?;
        let right = self.combination(terms)?;
        self.identical(&left, &right)?;
        self.add(Property::Zero, target.clone());
        Ok(())
    }

    fn sign(
        &mut self,
        target: &Polynomial,
        strict: bool,
        factors: &[(usize, u32)],
        summands: &[Summand],
        terms: &[(Polynomial, usize)],
    ) -> Outcome<()> {
        self.real(target)?;
        let product = self.product(factors, &[Property::Positive])?;
        let left = self.expansion.times(&product, target)?;
        let mut right = self.combination(terms)?;
        let mut is_strict = false;
        for Summand { factor, facts, root } in summands {
            if *factor <= Rational::zero() {
                return refused("a summand needs a positive factor");
            }
            self.real(root)?;
            let mut part = self.expansion.times(root, root)?.scaled(factor);
            let mut positive = root.as_constant().is_some_and(|value| !value.is_zero());
            for &number in facts {
                let fact = self.fact(number, &[Property::Positive, Property::NonNegative])?;
                positive &= self
                    .facts
                    .get(number)
                    .is_some_and(|fact| fact.property == Property::Positive);
                part = self.expansion.times(&part, &fact)?;
            }
            is_strict |= positive;
            right = right.plus(&part);
        }
        if strict && !is_strict {
            return refused("no summand is positive for certain");
        }
        self.identical(&left, &right)?;
        let property = if strict {
            Property::Positive
        } else {
            Property::NonNegative
        };
        self.add(property, target.clone());
        Ok(())
    }

    fn congruence(&mut self, left: Term, right: Term) -> Outcome<()> {
        let (a, b) = match (
            self.statement.terms.node(left).clone(),
            self.statement.terms.node(right).clone(),
        ) {
            (Node::Elementary(f, a), Node::Elementary(g, b)) if f == g => (a, b),
            (Node::Value(f, n, a), Node::Value(g, m, b)) if f == g && n == m => (a, b),
            (Node::RealPower(x, a), Node::RealPower(y, b)) if x == y => (a, b),
            (Node::RealPower(a, x), Node::RealPower(b, y)) if x == y => (a, b),
            _ => return refused("not the same function"),
        };
        let arguments = self.statement.terms.difference(a, b);
        self.defined(&[arguments])?;
        self.need(Property::Zero, arguments)?;
        let values = self.statement.terms.difference(left, right);
        self.conclude(Property::Zero, values)
    }

    fn cases(
        &mut self,
        on: &Polynomial,
        order: bool,
        property: Property,
        target: &Polynomial,
        branches: &[Vec<Inference>],
    ) -> Outcome<()> {
        let cases = match order {
            true => {
                self.real(on)?;
                vec![
                    (Property::Positive, on.clone()),
                    (Property::Zero, on.clone()),
                    (Property::Positive, on.negated()),
                ]
            }
            false => vec![(Property::Zero, on.clone()), (Property::Nonzero, on.clone())],
        };
        if cases.len() != branches.len() {
            return refused("not one branch for each case");
        }
        for ((case, polynomial), steps) in cases.into_iter().zip(branches) {
            let (facts, laws, absurd) = (self.facts.len(), self.laws.len(), self.absurd);
            self.add(case, polynomial);
            let followed = self.follow(steps);
            let shown = followed.is_ok() && self.knows_polynomial(property, target);
            self.facts.truncate(facts);
            self.laws.truncate(laws);
            self.absurd = absurd;
            followed?;
            if !shown {
                return refused("a case does not lead to what is to be shown");
            }
        }
        self.add(property, target.clone());
        Ok(())
    }

    fn law(&mut self, source: LawSource, at: Option<Term>) -> Outcome<()> {
        let Instance {
            property,
            term,
            conditions,
        } = self.instance(source, at)?;
        let at: Vec<Term> = at.into_iter().collect();
        if !at.iter().all(|&at| self.is_time(at)) {
            return refused("a law of real times at a complex one");
        }
        self.defined(&at)?;
        for (property, of) in conditions {
            self.need(property, of)?;
        }
        self.conclude(property, term)
    }

    /// What a law says at a time, and what must hold for it.
    ///
    /// # Errors
    /// A [`Refusal`] where there is no such law, or it does not extend so far.
    pub fn instance(&mut self, source: LawSource, at: Option<Term>) -> Outcome<Instance> {
        match source {
            LawSource::Given { given, shift } => {
                if self.statement.givens.get(given).is_none_or(|given| given.law.is_none()) {
                    return refused("the given is no law");
                }
                match self.statement.instance(given, at, shift, self.running) {
                    Some(instance) => Ok(instance),
                    None => refused("the law does not extend so far"),
                }
            }
            LawSource::Derived(_) => {
                let law = self.derived(source)?;
                let Some(at) = at else {
                    return refused("a derived law needs a time");
                };
                self.within(at, law.interval)?;
                let time = Some((law.time, at));
                let term = self.statement.moved(law.term, time, 0);
                let mut conditions = self.statement.domain(term);
                for (property, of) in law.conditions.into_iter().chain(law.domain) {
                    conditions.push((property, self.statement.moved(of, time, 0)));
                }
                Ok(Instance {
                    property: Property::Zero,
                    term,
                    conditions,
                })
            }
        }
    }

    /// A real number, or a symbol of the certificate: what holds of such a symbol is said of real numbers only.
    fn is_time(&self, at: Term) -> bool {
        let is_fresh = match self.statement.terms.node(at) {
            Node::Symbol(symbol) => self.statement.quantity(*symbol) == Some(Quantity::Fresh),
            _ => false,
        };
        is_fresh || self.statement.is_real(at)
    }

    /// Refuses what is no time of the interval that a law is for.
    fn within(&self, at: Term, interval: Option<i32>) -> Outcome<()> {
        match interval.is_none_or(|interval| self.statement.is_within(at, interval, self.running)) {
            true => Ok(()),
            false => refused("no time of the interval"),
        }
    }

    fn derived(&mut self, source: LawSource) -> Outcome<Derived> {
        match source {
            LawSource::Derived(number) => match self.laws.get(number) {
                Some(law) => Ok(law.clone()),
                None => refused("there is no such law"),
            },
            LawSource::Given { given, shift } => {
                let Some(given) = self.statement.givens.get(given).cloned() else {
                    return refused("there is no such given");
                };
                if shift != 0 && !self.statement.may_move(given.term) {
                    return refused("the law does not extend so far");
                }
                match given.law {
                    Some(law) if given.property == Property::Zero && (shift == 0 || law.every_index) => {
                        let Some(time) = law.time else {
                            return refused("the law does not run over a time");
                        };
                        let mut moved = |of: Term| {
                            let of = self.statement.written_out(of);
                            self.statement.moved(of, None, shift)
                        };
                        let term = moved(given.term);
                        let conditions = law.conditions.iter().map(|(property, of)| (*property, moved(*of)));
                        let mut conditions: Vec<(Property, Term)> = conditions.collect();
                        for (_, of) in conditions.clone() {
                            conditions.extend(self.statement.domain(of));
                        }
                        Ok(Derived {
                            time,
                            term,
                            conditions,
                            domain: Vec::new(),
                            interval: law.interval.map(|interval| interval + shift),
                        })
                    }
                    _ => refused("the given is no law that says what vanishes"),
                }
            }
        }
    }

    /// Checks that a symbol runs: nothing may be known of it.
    fn runs_freely(&mut self, time: Symbol) -> Outcome<()> {
        if self.statement.quantity(time) != Some(Quantity::Fresh) {
            return refused("the time of a law is a symbol of the statement");
        }
        let speaks = |fact: &Fact, statement: &Statement| {
            fact.polynomial
                .generators()
                .iter()
                .any(|&term| statement.terms.holds(term, time))
        };
        if self.facts.iter().any(|fact| speaks(fact, self.statement)) {
            return refused("something is known of the time of a law");
        }
        let given = self
            .statement
            .givens
            .iter()
            .filter(|given| given.law.is_none())
            .map(|given| given.term);
        for term in given.collect::<Vec<_>>() {
            let term = self.statement.written_out(term);
            if self.statement.terms.holds(term, time) {
                return refused("something is given of the time of a law");
            }
        }
        Ok(())
    }

    fn constant(
        &mut self,
        of: Term,
        time: Symbol,
        at: Term,
        interval: Option<i32>,
        steps: &[Inference],
    ) -> Outcome<()> {
        self.runs_freely(time)?;
        self.within(at, interval)?;
        if interval.is_some() && self.statement.terms.node(at) == &Node::Symbol(time) {
            return refused("the constant is taken at the running time");
        }
        let of = self.statement.written_out(of);
        if !self.statement.is_differentiable(of, &|symbol| symbol == time) {
            return refused("a branch of a complex function is differentiated");
        }
        let slope = self.statement.derivative(of, time);
        let (facts, laws, absurd) = (self.facts.len(), self.laws.len(), self.absurd);
        let outer = std::mem::replace(&mut self.running, interval.map(|interval| (time, interval)));
        let shown = self.follow(steps).and_then(|()| {
            self.defined(&[of, slope])?;
            self.need(Property::Zero, slope)
        });
        self.facts.truncate(facts);
        self.laws.truncate(laws);
        self.absurd = absurd;
        self.running = outer;
        shown?;
        self.defined(&[at])?;
        let there = self.statement.moved(of, Some((time, at)), 0);
        let term = self.statement.terms.difference(of, there);
        self.laws.push(Derived {
            time,
            term,
            conditions: Vec::new(),
            domain: Vec::new(),
            interval,
        });
        Ok(())
    }

    /// Writes a whole term, or the symbol of an abbreviation, out.
    fn unfold(&mut self, term: Term) -> Outcome<()> {
        self.defined(&[term])?;
        if let Node::Symbol(symbol) = self.statement.terms.node(term) {
            let Some(&meaning) = self.statement.definitions.get(symbol) else {
                return refused("the symbol is no abbreviation");
            };
            let difference = self.statement.terms.difference(term, meaning);
            return self.conclude(Property::Zero, difference);
        }
        let meaning = self.expansion.unfolded(&self.statement.terms, term)?;
        let mut product = Polynomial::generator(term);
        for (divisor, power) in &meaning.divisors {
            let raised = self.expansion.power(divisor, *power)?;
            product = self.expansion.times(&product, &raised)?;
        }
        self.add(Property::Zero, product.minus(&meaning.numerator));
        Ok(())
    }

    fn axiom(&mut self, axiom: &Axiom) -> Outcome<()> {
        let (guards, conclusion) = axiom.instance(&mut self.statement.terms)?;
        for guard in guards {
            self.meets(guard)?;
        }
        match conclusion {
            Guard::Holds(property, term) => self.conclude(property, term),
            _ => refused("an axiom concludes a property"),
        }
    }

    /// Refuses an instance of an axiom that does not meet a guard.
    fn meets(&mut self, guard: Guard) -> Outcome<()> {
        match guard {
            Guard::Holds(property, term) => {
                self.defined(&[term])?;
                self.need(property, term)
            }
            Guard::Defined(term) => self.defined(&[term]),
            Guard::Real(term) => self.reals(&[term]),
            Guard::Written(kind, term) => {
                let fits = |number: i64| number >= 0 && (kind == "natural" || (number % 2 == 0) == (kind == "even"));
                match written(&self.statement.terms, term).is_some_and(fits) {
                    true => Ok(()),
                    false => refused(format!("no {kind} number")),
                }
            }
            Guard::Over(kind) => match self.statement.complex == (kind == "complex") {
                true => Ok(()),
                false => refused("an axiom of real numbers for complex ones, or of complex ones for real ones"),
            },
        }
    }
}

/// Whether the fact says the property of the polynomial, up to a factor of numbers.
fn implies(fact: &Fact, property: Property, polynomial: &Polynomial) -> bool {
    use Property::{Integer, NonNegative, Nonzero, Positive, Zero};
    let fits = match (fact.property, property) {
        (Integer, Integer) => return fact.polynomial == *polynomial,
        (Zero, Zero | NonNegative) | (Nonzero | Positive, Nonzero) => {
            return fact.polynomial.is_multiple_of(polynomial);
        }
        (Positive, Positive | NonNegative) | (NonNegative, NonNegative) => true,
        _ => false,
    };
    let ratio = || {
        let (a, b) = (fact.polynomial.terms().first()?, polynomial.terms().first()?);
        Some(Rational(&a.1 / &b.1))
    };
    fits && fact.polynomial.is_multiple_of(polynomial) && ratio().is_some_and(|ratio| ratio > Rational::zero())
}
