//! The steps of a certificate as assertions of Rocq, each with a proof that needs no search: those that nothing rests on are left out.

use super::text::{Names, Unwritten, Writer, number, property};
use kernel::{
    Axiom, AxiomRow, Certificate, Checker, EFFORT, FunctionOf, Guard, Inference, Instance, LawSource, Node, Polynomial,
    Property, Quotient, Statement, Summand, Symbol, Term, vanishes,
};
use num_traits::{One, Zero};
use numbers::Rational;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use texmath::Name;

/// Something that a step rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ground {
    Fact(usize),
    Law(usize),
    Given(usize),
    /// A given law with its impacts moved on.
    Shifted(usize, i32),
    /// An equation of a map that holds near the point: the map and the equation.
    Near(usize, usize),
    /// An abbreviation of the statement, by its symbol.
    Definition(u32),
    /// A term that has a name.
    Named(Term),
    /// A term in generic symbols that is taken not to be 0.
    Generic(Term),
}

pub type Grounds = BTreeSet<Ground>;

/// A step that is written out: what it adds, and what it rests on.
struct Written {
    adds: Ground,
    /// Its text, or why it has none.
    text: Result<String, Unwritten>,
    on: Grounds,
}

/// Sums that are used once, as multiples, and are written where they are used: a chain of reductions is one identity then, in
/// place of an identity for each of its long intermediate sums.
struct Chains {
    uses: BTreeMap<usize, usize>,
    sums: BTreeMap<usize, Vec<(Polynomial, usize)>>,
}

impl Chains {
    /// Counts how often steps of one scope use each fact; no sum is known yet.
    fn new(steps: &[Inference]) -> Self {
        let (mut uses, mut open) = (BTreeMap::new(), steps.iter().collect::<Vec<_>>());
        while let Some(step) = open.pop() {
            open.extend(step.within());
            for (_, fact) in combination_of(step) {
                *uses.entry(*fact).or_insert(0) += 1;
            }
        }
        Self {
            uses,
            sums: BTreeMap::new(),
        }
    }

    /// Adds the sum that a step says a fact is.
    fn add(&mut self, fact: usize, step: Cow<Inference>) {
        if self.uses.get(&fact) == Some(&1)
            && let Inference::Zero {
                power: 1,
                squares,
                factors,
                terms,
                ..
            } = step.into_owned()
            && squares.is_empty()
            && factors.is_empty()
        {
            self.sums.insert(fact, terms);
        }
    }

    /// Returns the step with the sums that it uses as multiples written out.
    fn joined<'s>(&mut self, step: &'s Inference) -> Cow<'s, Inference> {
        let is_multiple = |(coefficient, fact): &(Polynomial, usize)| {
            self.sums.contains_key(fact) && coefficient.as_constant().is_some()
        };
        if !combination_of(step).iter().any(is_multiple) {
            return Cow::Borrowed(step);
        }
        let mut all: BTreeMap<usize, Polynomial> = BTreeMap::new();
        for (coefficient, fact) in combination_of(step).to_vec() {
            let (sum, factor) = match (coefficient.as_constant(), self.sums.remove(&fact)) {
                (Some(constant), Some(sum)) => (sum, constant),
                _ => (vec![(coefficient, fact)], Rational::one()),
            };
            for (own, fact) in sum {
                let known = all.entry(fact).or_insert_with(|| Polynomial::integer(0));
                *known = known.plus(&own.scaled(&factor));
            }
        }
        let mut step = step.clone();
        if let Inference::Zero { terms, .. } | Inference::Nonzero { terms, .. } | Inference::Sign { terms, .. } =
            &mut step
        {
            *terms = all.into_iter().map(|(fact, coefficient)| (coefficient, fact)).collect();
        }
        Cow::Owned(step)
    }
}

/// The multiples of facts that a step adds up.
fn combination_of(step: &Inference) -> &[(Polynomial, usize)] {
    match step {
        Inference::Zero { terms, .. } | Inference::Nonzero { terms, .. } | Inference::Sign { terms, .. } => terms,
        _ => &[],
    }
}

/// A proof that is being written.
pub struct Steps<'a> {
    checker: Checker<'a>,
    pub names: Names,
    whole: BTreeSet<Term>,
    on: Grounds,
    /// The times over which derived laws run, and their flights.
    times: BTreeMap<usize, (Symbol, Option<i32>)>,
    /// The flights that are spoken of.
    pub flights: BTreeSet<i32>,
    /// The derivatives of what maps say outright that are written, with what they are.
    pub outright: BTreeMap<String, Term>,
    /// The number of times that have been bound.
    bound: usize,
    /// Letters that printed formulas bind, with the names that they have there, the innermost last.
    letters: Vec<(String, String)>,
}

/// The beginning of a law: the time over which it runs, the flight that it is in, and its conditions.
#[derive(Default)]
pub struct Before {
    pub time: Option<String>,
    pub flight: Option<String>,
    pub conditions: Vec<String>,
}

impl Before {
    pub fn all(&self, says: &str) -> String {
        let mut text = String::new();
        if let Some(time) = &self.time {
            let _ = write!(text, "forall {time} : R, ");
        }
        for condition in self.flight.iter().chain(&self.conditions) {
            let _ = write!(text, "{condition} -> ");
        }
        text + says
    }

    /// Names for all of it, as they are introduced.
    pub fn names(&self) -> String {
        let time = self.time.as_ref().map(|_| "T0".to_owned());
        let flight = self.flight.as_ref().map(|_| "I0".to_owned());
        let conditions = (0..self.conditions.len()).map(|n| format!("C{n}"));
        let all: Vec<String> = time.into_iter().chain(flight).chain(conditions).collect();
        all.join(" ")
    }
}

/// The name of an index, as names have it.
pub fn place(index: i32) -> String {
    match index {
        0.. => index.to_string(),
        _ => format!("m{}", index.unsigned_abs()),
    }
}

/// The name of a given, its impacts moved on.
pub fn given_name(given: usize, shift: i32) -> String {
    match shift {
        0 => format!("G{given}"),
        _ => format!("G{given}s{}", place(shift)),
    }
}

type Text = Result<String, Unwritten>;

const NO_SUCH: Unwritten = Unwritten::Not("a step that rests on what is not known");

/// The tactic for an equation of polynomials: without fractions the quicker one.
fn equal(sides: &str) -> &'static str {
    if sides.contains(" / ") { "field" } else { "ring" }
}

fn ratio(of: &Polynomial, by: &Polynomial) -> Option<Rational> {
    let (above, below) = (of.terms().first()?, by.terms().first()?);
    Some(Rational(&above.1 / &below.1))
}

impl<'a> Steps<'a> {
    pub fn new(statement: &'a mut Statement, certificate: &Certificate, index: &str) -> Self {
        Self {
            checker: Checker::new(statement, certificate, EFFORT),
            names: Names::new(index),
            whole: certificate.whole.iter().copied().collect(),
            on: Grounds::new(),
            times: BTreeMap::new(),
            flights: BTreeSet::new(),
            outright: BTreeMap::new(),
            bound: 0,
            letters: Vec::new(),
        }
    }

    /// Binds a letter of a printed formula, under a name of its own.
    pub fn bind(&mut self, letter: &Name) -> String {
        let printed = letter.to_string();
        let name = self.names.letter(&printed);
        self.letters.push((printed, name.clone()));
        name
    }

    /// Puts a text in the place of a letter of a printed formula.
    pub fn put(&mut self, letter: &Name, text: &str) {
        self.letters.push((letter.to_string(), text.to_owned()));
    }

    pub fn unbind(&mut self) {
        self.letters.pop();
    }

    /// The name of a letter that is bound.
    pub fn bound(&self, printed: &str) -> Option<String> {
        let mut known = self.letters.iter().rev();
        known
            .find(|(letter, _)| letter == printed)
            .map(|(_, name)| name.clone())
    }

    pub fn statement(&mut self) -> &mut Statement {
        self.checker.statement
    }

    /// Writes with what is known here; generators by their names, or written out.
    pub fn write(&mut self, is_short: bool, write: &mut dyn FnMut(&mut Writer) -> Text) -> Text {
        let mut writer = Writer {
            statement: &*self.checker.statement,
            names: &mut self.names,
            whole: &self.whole,
            is_short,
            met: BTreeSet::new(),
            letters: BTreeMap::new(),
        };
        let text = write(&mut writer);
        let met = std::mem::take(&mut writer.met);
        self.on.extend(met.into_iter().map(Ground::Named));
        text
    }

    pub fn short(&mut self, term: Term) -> Text {
        self.write(true, &mut |writer| writer.term(term))
    }

    pub fn full(&mut self, term: Term) -> Text {
        self.write(false, &mut |writer| writer.term(term))
    }

    fn polynomial(&mut self, polynomial: &Polynomial) -> Text {
        self.write(true, &mut |writer| writer.polynomial(polynomial))
    }

    fn full_polynomial(&mut self, polynomial: &Polynomial) -> Text {
        self.write(false, &mut |writer| writer.polynomial(polynomial))
    }

    fn fact(&mut self, number: usize) -> String {
        self.on.insert(Ground::Fact(number));
        format!("F{number}")
    }

    fn given(&mut self, number: usize) -> String {
        self.on.insert(Ground::Given(number));
        format!("G{number}")
    }

    fn shifted(&mut self, given: usize, shift: i32) -> String {
        self.on.insert(match shift {
            0 => Ground::Given(given),
            _ => Ground::Shifted(given, shift),
        });
        given_name(given, shift)
    }

    fn source(&mut self, source: LawSource) -> String {
        match source {
            LawSource::Given { given, shift } => self.shifted(given, shift),
            LawSource::Derived(number) => {
                self.on.insert(Ground::Law(number));
                format!("L{number}")
            }
        }
    }

    /// The time over which a law runs, and the flight that it is in.
    fn runs(&self, source: LawSource) -> Option<(Symbol, Option<i32>)> {
        match source {
            LawSource::Given { given, shift } => {
                let law = self.checker.statement.givens().get(given)?.law.clone()?;
                Some((law.time?, law.interval.map(|flight| flight + shift)))
            }
            LawSource::Derived(number) => self.times.get(&number).copied(),
        }
    }

    /// A law at the time over which it runs.
    fn general(&mut self, source: LawSource) -> Result<Instance, Unwritten> {
        let runs = self.runs(source);
        let at = runs.map(|(time, _)| self.checker.statement.terms_mut().symbol(time));
        let running = runs.and_then(|(time, flight)| Some((time, flight?)));
        let outer = self.checker.run_over(running);
        let instance = self.checker.instance(source, at);
        self.checker.run_over(outer);
        Ok(instance?)
    }

    /// The times between which a flight lies.
    fn ends(&mut self, flight: i32) -> Result<[String; 2], Unwritten> {
        self.flights.insert(flight);
        let statement = &mut *self.checker.statement;
        let mut end = |index: i32| {
            let instant = statement.instant(index);
            instant.ok_or(Unwritten::Not("a flight whose ends have no names"))
        };
        let ends = [end(flight)?, end(flight + 1)?];
        let [from, to] = ends.map(|symbol| self.checker.statement.terms_mut().symbol(symbol));
        Ok([self.full(from)?, self.full(to)?])
    }

    fn in_flight(&mut self, flight: i32, time: &str) -> Text {
        let [from, to] = self.ends(flight)?;
        Ok(format!("{from} <= {time} <= {to}"))
    }

    /// The beginning of a given law, and what it says.
    pub fn law_said(&mut self, given: usize, shift: i32) -> Result<(Before, String), Unwritten> {
        let source = LawSource::Given { given, shift };
        let instance = self.general(source)?;
        let mut before = Before::default();
        if let Some((time, flight)) = self.runs(source) {
            let at = self.checker.statement.terms_mut().symbol(time);
            let time = self.full(at)?;
            before.flight = flight.map(|flight| self.in_flight(flight, &time)).transpose()?;
            before.time = Some(time);
        }
        for (shown, of) in instance.conditions {
            before.conditions.push(property(shown, &self.full(of)?));
        }
        let says = property(instance.property, &self.full(instance.term)?);
        Ok((before, says))
    }

    /// A name for a time that is bound, which the symbol has until it is given back.
    fn bind_time(&mut self, time: Symbol) -> (String, Option<String>) {
        self.bound += 1;
        let name = format!("U{}", self.bound);
        (name.clone(), self.names.put(time, Some(name)))
    }

    /// The names of what a motion is at an end of its flight, where a law is taken there.
    fn at_end(&mut self, general: &Instance, at: Term) -> Vec<String> {
        let Node::Symbol(symbol) = *self.checker.statement.terms().node(at) else {
            return Vec::new();
        };
        let statement = &*self.checker.statement;
        let all = general.conditions.iter().map(|(_, of)| *of).chain([general.term]);
        let inside: BTreeSet<Term> = all.flat_map(|term| statement.terms().inside(term)).collect();
        let mut names = Vec::new();
        for inner in inside {
            if let Node::Value(function, order, _) = statement.terms().node(inner)
                && let Some(FunctionOf::Interval { offset: impact, .. }) =
                    statement.functions().get(function.0 as usize)
            {
                for (index, mark) in [(*impact, 'a'), (*impact + 1, 'b')] {
                    if statement.instants().get(&index) == Some(&symbol) {
                        let name = format!("E{}_{order}{mark}", function.0);
                        if statement.end_of(*function, *order, mark == 'a').is_some() && !names.contains(&name) {
                            names.push(name);
                        }
                    }
                }
            }
        }
        names
    }

    fn polynomial_of(&self, fact: usize) -> Result<Polynomial, Unwritten> {
        let fact = self.checker.facts.get(fact).ok_or(NO_SUCH)?;
        Ok(fact.polynomial.clone())
    }

    fn property_of(&self, fact: usize) -> Result<Property, Unwritten> {
        Ok(self.checker.facts.get(fact).ok_or(NO_SUCH)?.property)
    }

    /// The proof that a fact, positive or other than 0, is not 0.
    fn nonzero_fact(&mut self, number: usize) -> Text {
        let name = self.fact(number);
        Ok(match self.property_of(number)? {
            Property::Positive => format!("(Rgt_not_eq _ _ {name})"),
            _ => name,
        })
    }

    fn nonnegative_fact(&mut self, number: usize) -> Text {
        let name = self.fact(number);
        Ok(match self.property_of(number)? {
            Property::Positive => format!("(Rgt_ge _ _ {name})"),
            Property::Zero => format!("(Req_ge _ _ {name})"),
            _ => name,
        })
    }

    fn quotient(&mut self, term: Term) -> Result<Quotient, Unwritten> {
        let terms = self.checker.statement.terms().clone();
        Ok(self.checker.expansion.of(&terms, term)?)
    }

    /// The product of powers of divisors; `halved` for the one whose square makes the powers even.
    fn divisors(&mut self, quotient: &Quotient, is_halved: bool) -> Text {
        let mut factors = Vec::new();
        for (divisor, power) in &quotient.divisors {
            let power = if is_halved { power.div_ceil(2) } else { *power };
            factors.push(format!("{} ^ {power}", self.polynomial(divisor)?));
            self.rests_on_nonzero(divisor);
        }
        Ok(match factors.is_empty() {
            true => "1".to_owned(),
            false => format!("({})", factors.join(" * ")),
        })
    }

    /// Notes the facts that show that a polynomial is not 0.
    fn rests_on_nonzero(&mut self, polynomial: &Polynomial) {
        let shows = |fact: &kernel::Fact| {
            matches!(fact.property, Property::Nonzero | Property::Positive)
                && fact.polynomial.is_multiple_of(polynomial)
        };
        let found = self.checker.facts.iter().position(shows);
        self.on.extend(found.map(Ground::Fact));
    }

    /// Notes what shows that no divisor within a term is 0.
    fn rests_on_divisors(&mut self, term: Term) -> Result<(), Unwritten> {
        let mut open = vec![term];
        let mut below = BTreeSet::new();
        while let Some(term) = open.pop() {
            if self.whole.contains(&term) {
                continue;
            }
            match self.checker.statement.terms().node(term) {
                Node::Sum(parts) | Node::Product(parts) => open.extend(parts),
                Node::Power(base, _) => open.push(*base),
                Node::Quotient(upper, lower) => {
                    open.extend([*upper, *lower]);
                    below.insert(*lower);
                }
                _ => {}
            }
        }
        for lower in below {
            let quotient = self.quotient(lower)?;
            self.rests_on_nonzero(&quotient.numerator);
        }
        Ok(())
    }

    /// The numerator of a term as facts have it: times the divisors of odd power where its sign is meant.
    fn numerator(&mut self, shown: Property, quotient: &Quotient) -> Result<Polynomial, Unwritten> {
        let mut product = quotient.numerator.clone();
        if matches!(shown, Property::Positive | Property::NonNegative) {
            for (divisor, power) in &quotient.divisors {
                if power % 2 == 1 {
                    product = self.checker.expansion.times(&product, divisor)?;
                }
            }
        }
        Ok(product)
    }

    /// The fact that says a property of a polynomial, up to a factor, with this factor.
    fn saying(&self, shown: Property, polynomial: &Polynomial) -> Option<(usize, Rational)> {
        use Property::{Integer, NonNegative, Nonzero, Positive, Zero};
        let says = |fact: &kernel::Fact| {
            let factor = ratio(polynomial, &fact.polynomial).unwrap_or_else(Rational::one);
            let fits = match (fact.property, shown) {
                (Integer, Integer) => return (fact.polynomial == *polynomial).then_some(factor),
                (Zero, Zero | NonNegative) | (Nonzero | Positive, Nonzero) => true,
                (Positive, Positive | NonNegative) | (NonNegative, NonNegative) => factor > Rational::zero(),
                _ => false,
            };
            (fits && fact.polynomial.is_multiple_of(polynomial)).then_some(factor)
        };
        let mut facts = self.checker.facts.iter().enumerate();
        facts.find_map(|(number, fact)| Some((number, says(fact)?)))
    }

    /// A fact that cannot be, where there is one.
    fn absurd(&mut self) -> Option<String> {
        let cannot_be = |fact: &kernel::Fact| {
            fact.property == Property::Zero && !vanishes(&fact.polynomial) && fact.polynomial.as_constant().is_some()
        };
        let number = self.checker.facts.iter().position(cannot_be)?;
        let name = self.fact(number);
        Some(format!("exfalso; revert {name}; clear; intro; lra"))
    }

    /// The tactic that shows a property of a term.
    pub fn shown(&mut self, shown: Property, term: Term) -> Text {
        if let Some(text) = self.as_given(shown, term) {
            return Ok(text);
        }
        self.rests_on_divisors(term)?;
        let quotient = self.quotient(term)?;
        let polynomial = self.numerator(shown, &quotient)?;
        if shown == Property::Zero && vanishes(&polynomial) {
            return Ok("same_fraction".into());
        }
        if shown == Property::NonNegative && vanishes(&polynomial) {
            return Ok("apply Req_ge; same_fraction".into());
        }
        if let Some((number, factor)) = self.saying(shown, &polynomial) {
            let is_sign = matches!(shown, Property::Positive | Property::NonNegative);
            let by = self.divisors(&quotient, is_sign)?;
            return self.by_fact(shown, number, &factor, &by, "nonzero");
        }
        if shown != Property::Integer && self.checker.statement.sign_of(&polynomial).is_some() {
            let full = self.full(term)?;
            return Ok(format!("change ({}); enclose", property(shown, &full)));
        }
        if shown == Property::Integer {
            return self.integer(&polynomial);
        }
        self.absurd().ok_or(NO_SUCH)
    }

    /// The tactic that shows a property by a fact: what it is said of, times `by`, is a multiple of the fact. That `by` is not 0 is left to
    /// the tactic `nonzero`.
    fn by_fact(&mut self, shown: Property, number: usize, factor: &Rational, by: &str, nonzero: &str) -> Text {
        let factor = super::text::number(factor);
        Ok(match shown {
            Property::Zero => {
                let fact = self.fact(number);
                format!("refine (zero_of _ {by} {factor} _ {fact} _ _); [{nonzero} | same_fraction]")
            }
            Property::Nonzero => {
                let fact = self.nonzero_fact(number)?;
                format!("refine (nonzero_of _ {by} {factor} _ {fact} _ _); [lra | same_fraction]")
            }
            Property::Positive => {
                let fact = self.fact(number);
                format!("refine (positive_of _ {by} {factor} _ {fact} _ _); [lra | same_fraction]")
            }
            Property::NonNegative if self.property_of(number)? == Property::Zero => {
                let fact = self.fact(number);
                format!("apply Req_ge; refine (zero_of _ {by} {factor} _ {fact} _ _); [{nonzero} | same_fraction]")
            }
            Property::NonNegative => {
                let fact = self.nonnegative_fact(number)?;
                format!("refine (nonnegative_of _ {by} {factor} _ {fact} _ _ _); [lra | {nonzero} | same_fraction]")
            }
            Property::Integer => format!("exact {}", self.fact(number)),
        })
    }

    fn as_given(&mut self, shown: Property, term: Term) -> Option<String> {
        let stronger: &[(Property, &str)] = match shown {
            Property::Nonzero => &[(Property::Nonzero, ""), (Property::Positive, "apply Rgt_not_eq; ")],
            Property::NonNegative => &[
                (Property::NonNegative, ""),
                (Property::Positive, "apply Rgt_ge; "),
                (Property::Zero, "apply Req_ge; "),
            ],
            shown => &[(shown, "")],
        };
        stronger.iter().find_map(|(own, by)| {
            let mut givens = self.checker.statement.givens().iter();
            let number =
                givens.position(|given| given.law.is_none() && given.property == *own && given.term == term)?;
            Some(format!("{by}exact {}", self.given(number)))
        })
    }

    /// The tactic that shows a property of a polynomial.
    fn shown_polynomial(&mut self, shown: Property, polynomial: &Polynomial) -> Text {
        if let Some(text) = self.absurd() {
            return Ok(text);
        }
        if shown == Property::Zero && vanishes(polynomial) {
            return Ok("reflexivity".into());
        }
        if shown == Property::NonNegative && vanishes(polynomial) {
            return Ok("apply Req_ge; reflexivity".into());
        }
        if let Some((number, factor)) = self.saying(shown, polynomial) {
            return self.by_fact(shown, number, &factor, "1", "lra");
        }
        if shown != Property::Integer && self.checker.statement.sign_of(polynomial).is_some() {
            let full = self.full_polynomial(polynomial)?;
            return Ok(format!("change ({}); enclose", property(shown, &full)));
        }
        if shown == Property::Integer {
            return self.integer(polynomial);
        }
        Err(NO_SUCH)
    }

    /// The tactic for an integer: sums and products of integers are integers.
    fn integer(&mut self, polynomial: &Polynomial) -> Text {
        let is_whole = polynomial
            .terms()
            .iter()
            .all(|(_, coefficient)| Rational(coefficient.clone()).to_integer().is_some());
        if !is_whole {
            return Err(Unwritten::Not("a polynomial with fractions whose values are integers"));
        }
        for generator in polynomial.generators() {
            self.as_given(Property::Integer, generator);
            let found = self.saying(Property::Integer, &Polynomial::generator(generator));
            self.on.extend(found.map(|(number, _)| Ground::Fact(number)));
        }
        Ok("is_integer".into())
    }

    /// Writes steps; those that come to nothing that is wanted are left out. Also gives what they rest on from before.
    pub fn scope(
        &mut self,
        steps: &[Inference],
        wanted: &mut dyn FnMut(&mut Self) -> Text,
    ) -> Result<(String, Grounds), Unwritten> {
        let (mut written, mut chains) = (Vec::new(), Chains::new(steps));
        for step in steps {
            let joined = chains.joined(step);
            let place = self.checker.facts.len();
            let own = self.step(step, &joined)?;
            chains.add(place, joined);
            written.push(own);
        }
        self.on.clear();
        let end = wanted(self)?;
        let mut on = std::mem::take(&mut self.on);
        let mut kept = Vec::new();
        for own in written.into_iter().rev() {
            if on.remove(&own.adds) {
                on.extend(own.on);
                kept.push(own.text?);
            }
        }
        kept.reverse();
        Ok((kept.concat() + &end, on))
    }

    /// Follows a step and writes it, as it is with its chains joined; what cannot be written is only missed where something rests on it.
    fn step(&mut self, step: &Inference, joined: &Inference) -> Result<Written, Unwritten> {
        let (mark, place, laws) = (self.checker.mark(), self.checker.facts.len(), self.checker.laws());
        self.on.clear();
        let text = self.followed(step, joined);
        if text.is_err() {
            self.checker.back_to(mark);
            self.checker.apply(step)?;
        }
        let adds = match self.checker.laws() > laws {
            true => Ground::Law(laws),
            false => Ground::Fact(place),
        };
        Ok(Written {
            adds,
            text,
            on: std::mem::take(&mut self.on),
        })
    }

    fn followed(&mut self, step: &Inference, joined: &Inference) -> Text {
        let place = self.checker.facts.len();
        if let Inference::Derivative(source) = step {
            return self.derivative(step, *source);
        }
        if let Inference::Constant { .. } = step {
            return self.constant(step);
        }
        // what a proof rests on is what was known before
        let before = self.before(step)?;
        self.checker.apply(step)?;
        let fact = self.checker.facts.get(place).cloned().ok_or(NO_SUCH)?;
        let held = self.checker.facts.split_off(place);
        let claimed = self.polynomial(&fact.polynomial)?;
        let proof = match before {
            Some(proof) => proof,
            None => self.proof(joined, &claimed)?,
        };
        self.checker.facts.extend(held);
        // what ends in cases has ended
        let end = if proof.ends_with('}') { "" } else { "." };
        Ok(format!(
            "assert (F{place} : {}).\n{{ {proof}{end} }}\n",
            property(fact.property, &claimed)
        ))
    }

    /// The proof of a step whose parts must be followed before it.
    fn before(&mut self, step: &Inference) -> Result<Option<String>, Unwritten> {
        let Inference::Cases {
            on,
            order,
            property: shown,
            target,
            branches,
        } = step
        else {
            return Ok(None);
        };
        let of = self.polynomial(on)?;
        let place = self.checker.facts.len();
        let cases = match order {
            true => vec![
                (Property::Positive, on.clone()),
                (Property::Zero, on.clone()),
                (Property::Positive, on.negated()),
            ],
            false => vec![(Property::Zero, on.clone()), (Property::Nonzero, on.clone())],
        };
        let mut text = match order {
            true => format!("destruct (by_order {of}) as [C{place}|[C{place}|C{place}]]."),
            false => format!("destruct (by_zero {of}) as [C{place}|C{place}]."),
        };
        let mut grounds = std::mem::take(&mut self.on);
        for ((case, polynomial), steps) in cases.into_iter().zip(branches) {
            let mark = self.checker.mark();
            self.checker.suppose(case, polynomial.clone());
            let (inner, mut on) = self.scope(steps, &mut |own| own.shown_polynomial(*shown, target))?;
            self.checker.back_to(mark);
            on.remove(&Ground::Fact(place));
            grounds.extend(on);
            let stated = self.polynomial(&polynomial)?;
            grounds.append(&mut self.on);
            let _ = write!(
                text,
                "\n{{ assert (F{place} : {}) by (clear - C{place}; lra).\n{inner}. }}",
                property(case, &stated)
            );
        }
        self.on = grounds;
        Ok(Some(text))
    }

    /// The proof of the fact that a step adds.
    fn proof(&mut self, step: &Inference, claimed: &str) -> Text {
        match step {
            Inference::Given(given) => {
                let known = self.checker.statement.givens().get(*given).cloned().ok_or(NO_SUCH)?;
                let name = self.given(*given);
                self.of_term(known.property, known.term, &name)
            }
            Inference::Axiom(axiom) => self.axiom(axiom),
            Inference::Unfold(term) => self.unfold(*term),
            Inference::Enclosure(polynomial) => {
                let full = self.full_polynomial(polynomial)?;
                Ok(format!("change ({full} > 0); enclose"))
            }
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
            } => {
                let (sum, sum_proof) = self.combination(terms)?;
                let (product, product_proof) = self.product(factors, Property::Nonzero)?;
                let (target, cofactor) = (self.polynomial(target)?, self.polynomial(cofactor)?);
                let by = equal(&[sum.as_str(), &product, &target, &cofactor].concat());
                Ok(format!(
                    "refine (nonzero_step {target} {cofactor} ({sum}) ({product}) {product_proof} {sum_proof} _); {by}"
                ))
            }
            Inference::Sign {
                target,
                strict,
                factors,
                summands,
                terms,
            } => self.sign(target, *strict, factors, summands, terms),
            Inference::Squeezed { low, high } => {
                let (low, high) = (self.nonnegative_fact(*low)?, self.nonnegative_fact(*high)?);
                Ok(format!("refine (squeezed _ _ {low} {high} _); {}", equal(claimed)))
            }
            Inference::Congruence { left, right } => self.congruence(*left, *right),
            Inference::Generic(term) => {
                self.on.insert(Ground::Generic(*term));
                let name = format!("H{}", term.0);
                self.of_term(Property::Nonzero, *term, &name)
            }
            Inference::Law { source, at } => self.law(*source, *at),
            Inference::Between { target, within } => self.between(target, within),
            Inference::Along {
                implicit: map,
                equation,
                by,
            } => self.along(*map, *equation, *by),
            Inference::Cases { .. } | Inference::Derivative(_) | Inference::Constant { .. } => Err(NO_SUCH),
        }
    }

    /// The fact that comes of a property of a term that has a proof.
    fn of_term(&mut self, shown: Property, term: Term, proof: &str) -> Text {
        let text = self.short(term)?;
        let quotient = self.quotient(term)?;
        self.rests_on_divisors(term)?;
        let is_sign = matches!(shown, Property::Positive | Property::NonNegative);
        let by = self.divisors(&quotient, is_sign)?;
        Ok(match shown {
            Property::Zero => format!("refine (numerator_zero {text} {by} _ {proof} _); same_fraction"),
            Property::Nonzero => {
                format!("refine (numerator_nonzero {text} {by} _ {proof} _ _); [nonzero | same_fraction]")
            }
            Property::Positive => {
                format!("refine (numerator_positive {text} {by} _ {proof} _ _); [nonzero | same_fraction]")
            }
            Property::NonNegative => format!("refine (numerator_nonnegative {text} {by} _ {proof} _); same_fraction"),
            Property::Integer => format!("exact {proof}"),
        })
    }

    fn axiom(&mut self, axiom: &Axiom) -> Text {
        let row = AxiomRow::named(axiom.name).ok_or(NO_SUCH)?;
        let (guards, conclusion) = axiom.instance(self.checker.statement.terms_mut())?;
        let is_natural = |letter: &str| {
            let whole = format!("{} ; {}", row.guards.join(" ; "), row.conclusion);
            ["natural", "even", "odd"]
                .iter()
                .any(|kind| whole.contains(&format!("{kind}({letter})")))
                || whole.contains(&format!("root({letter},"))
        };
        let has_root = row.letters.iter().any(|letter| {
            let of = format!("root({letter},");
            row.conclusion.contains(&of) || row.guards.iter().any(|guard| guard.contains(&of))
        });
        let mut text = String::new();
        let mut call = row.name.to_owned();
        let mut natural = None;
        for (letter, &term) in row.letters.iter().zip(&axiom.terms) {
            let written = self.short(term)?;
            if row.guards.contains(&format!("natural({letter})").as_str()) {
                natural = Some((*letter, written.clone()));
            }
            let _ = match is_natural(letter) {
                true => write!(call, " {written}%nat"),
                false => write!(call, " {written}"),
            };
        }
        if has_root {
            call += " ltac:(lia)";
        }
        let mut count = 0;
        for (guard, printed) in guards.iter().zip(&row.guards) {
            match *guard {
                Guard::Holds(shown, term) => {
                    let own = self.short(term)?;
                    let by = self.shown(shown, term)?;
                    let _ = writeln!(text, "assert (A{count} : {}).\n{{ {by}. }}", property(shown, &own));
                    let is_nothing = self.is_nothing(printed, row, axiom);
                    call += &format!(
                        " {}",
                        relation(shown, printed, is_nothing, &format!("A{count}"), &natural)
                    );
                    count += 1;
                }
                // a letter has a value whatever it is here
                Guard::Defined(_) if !printed.trim_start_matches("defined(").contains('(') => {}
                Guard::Defined(term) => {
                    let domain = domain_of(self.checker.statement, term);
                    if let Some(index) = domain.root {
                        let proof = match (index % 2, domain.conditions.first()) {
                            (0, Some(&(shown, of))) => {
                                let own = self.short(of)?;
                                let by = self.shown(shown, of)?;
                                let _ = writeln!(text, "assert (A{count} : {}).\n{{ {by}. }}", property(shown, &own));
                                format!(" (fun _ => A{count})")
                            }
                            _ => " ltac:(discriminate)".to_owned(),
                        };
                        call += &proof;
                        count += 1;
                        continue;
                    }
                    for (shown, of) in domain.conditions {
                        let own = self.short(of)?;
                        let by = self.shown(shown, of)?;
                        let _ = writeln!(text, "assert (A{count} : {}).\n{{ {by}. }}", property(shown, &own));
                        call += &format!(" A{count}");
                        count += 1;
                    }
                }
                Guard::Written("even" | "odd", _) => call += " eq_refl",
                Guard::Written(..) | Guard::Real(_) => {}
                Guard::Over("complex") => return Err(Unwritten::Not("complex numbers")),
                Guard::Over(_) => {}
            }
        }
        let Guard::Holds(shown, term) = conclusion else {
            return Err(NO_SUCH);
        };
        let own = self.short(term)?;
        let whole = match (self.is_nothing(row.conclusion, row, axiom), shown) {
            (true, _) => format!("({call})"),
            (false, Property::Zero) => format!("(Rminus_diag_eq _ _ ({call}))"),
            (false, Property::Nonzero) => format!("(Rminus_eq_contra _ _ ({call}))"),
            (false, Property::Positive) => format!("(Rgt_minus _ _ ({call}))"),
            (false, _) => format!("(Rge_minus _ _ ({call}))"),
        };
        let own = property(shown, &own);
        let _ = writeln!(
            text,
            "assert (B9 : {own}) by first [exact {whole} | generalize {whole}; lra]."
        );
        text += &self.of_term(shown, term, "B9")?;
        Ok(text)
    }

    /// Returns true if the right side of a relation is 0, which the kernel leaves out.
    fn is_nothing(&self, printed: &str, row: &AxiomRow, axiom: &Axiom) -> bool {
        let terms = self.checker.statement.terms();
        let is_zero = |term: Term| matches!(terms.node(term), Node::Number(value) if value.0.is_zero());
        let right = printed.rsplit(['=', '>']).next().unwrap_or_default().trim();
        let mut letters = row.letters.iter().zip(&axiom.terms);
        right == "0" || letters.any(|(letter, &term)| *letter == right && is_zero(term))
    }

    /// The names under which maps have what they give: functions of what they start from.
    pub fn image(&mut self, of: Symbol) -> String {
        let name = self.names.symbol(&*self.checker.statement, of);
        format!("map_{name}")
    }

    /// An equation of a map, differentiated along it.
    fn along(&mut self, map: usize, equation: usize, by: Symbol) -> Text {
        let step = self.checker.statement.implicit().get(map).cloned().ok_or(NO_SUCH)?;
        let term = step.equations.get(equation).ok_or(NO_SUCH)?.1;
        let slope = self.checker.statement.along(term, &step, by);
        let written = self.checker.statement.written_out(term);
        let moving = self.checker.statement.terms().inside(written);
        for inner in moving {
            if let Node::Symbol(symbol) = *self.checker.statement.terms().node(inner)
                && self.checker.statement.depends(symbol)
                && !step.by.contains(&symbol)
                && !step.of.contains(&symbol)
            {
                return Err(Unwritten::Not("a quantity that moves along a map without being of it"));
            }
        }
        let mut text = String::new();
        let mut domain = self.checker.statement.domain(written);
        domain.extend(self.checker.statement.domain(slope));
        let near = self
            .checker
            .statement
            .holding_near(&domain, &[written], &Statement::depends);
        domain.extend(near.unwrap_or_default());
        let mut names = Vec::new();
        for (count, (shown, of)) in domain.into_iter().enumerate() {
            let own = self.full(of)?;
            let by = self.shown(shown, of)?;
            let _ = writeln!(text, "assert (A{count} : {}).\n{{ {by}. }}", property(shown, &own));
            names.push(format!("A{count}"));
        }
        let starts: Vec<String> = step
            .by
            .iter()
            .map(|&own| self.names.symbol(&*self.checker.statement, own))
            .collect();
        let (full, full_slope) = (self.full(slope), self.short(slope)?);
        let full = full?;
        let mut values = Vec::new();
        for &of in &step.of {
            let image = self.image(of);
            let outer = self.names.put(of, Some(format!("({image} {})", starts.join(" "))));
            values.push((of, format!("V_{image}"), outer));
        }
        let moved = self.full(written);
        for (of, _, outer) in &values {
            self.names.put(*of, outer.clone());
        }
        let moved = moved?;
        let by = self.names.symbol(&*self.checker.statement, by);
        self.on.insert(Ground::Near(map, equation));
        let rewrites: Vec<String> = values.iter().map(|(_, value, _)| format!("?{value}")).collect();
        let rewrites = rewrites.join(", ");
        for name in names {
            let _ = writeln!(text, "rewrite {rewrites} in {name}.");
        }
        let _ = writeln!(
            text,
            "assert (B9 : {full_slope} = 0).\n{{ change ({full} = 0). refine (slope_of_zero_near (fun {by} => {moved}) {by} _ _ _).\n\
             {{ destruct N{map}_{equation} as (W0 & W1 & W2). exists (mkposreal W0 W1). intros W3 W4. pose proof (W2 {}) as W5. cbv beta zeta in W5. as_printed W5. }}\n\
             rewrite {rewrites}. differentiate_smooth. }}",
            starts
                .iter()
                .map(|start| if *start == by { "W3".to_owned() } else { start.clone() })
                .chain(starts.iter().map(|start| match *start == by {
                    true => "W4".to_owned(),
                    false => "(near_itself _ _ W1)".to_owned(),
                }))
                .collect::<Vec<_>>()
                .join(" ")
        );
        text += &self.of_term(Property::Zero, slope, "B9")?;
        Ok(text)
    }

    fn unfold(&mut self, term: Term) -> Text {
        if let Node::Symbol(symbol) = *self.checker.statement.terms().node(term) {
            let meaning = self
                .checker
                .statement
                .definitions()
                .get(&symbol)
                .copied()
                .ok_or(NO_SUCH)?;
            let difference = self.checker.statement.terms_mut().difference(term, meaning);
            self.on.insert(Ground::Definition(symbol.0));
            return self.of_term(
                Property::Zero,
                difference,
                &format!("(Rminus_diag_eq _ _ D{})", symbol.0),
            );
        }
        self.on.insert(Ground::Named(term));
        let parts = self.checker.statement.terms().parts(term);
        for part in parts {
            self.rests_on_divisors(part)?;
        }
        Ok(format!("unfold g{}; same_fraction", term.0))
    }

    /// A sum of multiples of what is 0, and its proof.
    fn combination(&mut self, terms: &[(Polynomial, usize)]) -> Result<(String, String), Unwritten> {
        let (mut sum, mut proof) = (String::from("0"), String::from("no_terms"));
        for (coefficient, number) in terms.iter().rev() {
            let coefficient = self.polynomial(coefficient)?;
            let polynomial = self.polynomial_of(*number)?;
            let fact = self.polynomial(&polynomial)?;
            let name = self.fact(*number);
            sum = format!("{coefficient} * {fact} + ({sum})");
            proof = format!("(term {coefficient} _ _ {name} {proof})");
        }
        Ok((sum, proof))
    }

    /// A product of powers of facts, and the proof that it is not 0, or positive.
    fn product(&mut self, factors: &[(usize, u32)], shown: Property) -> Result<(String, String), Unwritten> {
        let is_positive = shown == Property::Positive;
        let none = if is_positive { "no_positive" } else { "no_factors" };
        let (mut product, mut proof) = (String::from("1"), none.to_owned());
        for (number, power) in factors.iter().rev() {
            let polynomial = self.polynomial_of(*number)?;
            let fact = self.polynomial(&polynomial)?;
            let (name, lemma) = match is_positive {
                true => (self.fact(*number), "positive_factor"),
                false => (self.nonzero_fact(*number)?, "factor"),
            };
            product = format!("{fact} ^ {power} * ({product})");
            proof = format!("({lemma} _ {power} _ {name} {proof})");
        }
        Ok((product, proof))
    }

    fn zero(
        &mut self,
        target: &Polynomial,
        power: u32,
        squares: &[(Rational, Polynomial)],
        factors: &[(usize, u32)],
        terms: &[(Polynomial, usize)],
    ) -> Text {
        if vanishes(target) {
            return Ok("reflexivity".into());
        }
        let (sum, sum_proof) = self.combination(terms)?;
        let (product, product_proof) = self.product(factors, Property::Nonzero)?;
        let target = self.polynomial(target)?;
        let mut sides = [sum.as_str(), &product, &target].concat();
        if squares.is_empty() {
            return Ok(format!(
                "refine (zero_step {target} {power} ({sum}) ({product}) {product_proof} {sum_proof} _); {}",
                equal(&sides)
            ));
        }
        let (mut all, mut proof) = (String::from("0"), String::from("no_summands"));
        for (factor, root) in squares.iter().rev() {
            let (factor, root) = (number(factor), self.polynomial(root)?);
            all = format!("{factor} * 1 * {root} ^ 2 + ({all})");
            proof = format!("(summand {factor} 1 _ _ ltac:(lra) no_nonnegative {proof})");
        }
        sides += &all;
        let half = power / 2;
        Ok(format!(
            "refine (squares_step {target} {half} ({sum}) ({product}) ({all}) {product_proof} {sum_proof} {proof} _); {}",
            equal(&sides)
        ))
    }

    fn sign(
        &mut self,
        target: &Polynomial,
        strict: bool,
        factors: &[(usize, u32)],
        summands: &[Summand],
        terms: &[(Polynomial, usize)],
    ) -> Text {
        let (sum, sum_proof) = self.combination(terms)?;
        let (product, product_proof) = self.product(factors, Property::Positive)?;
        let target = self.polynomial(target)?;
        let positive = |own: &Self, summand: &Summand| {
            let all = summand
                .facts
                .iter()
                .all(|fact| own.property_of(*fact) == Ok(Property::Positive));
            all && summand.root.as_constant().is_some_and(|value| !value.is_zero())
        };
        let chosen = match strict {
            true => Some(
                summands
                    .iter()
                    .position(|summand| positive(self, summand))
                    .ok_or(NO_SUCH)?,
            ),
            false => None,
        };
        let (mut all, mut proof) = (String::from("0"), String::from("no_summands"));
        for (place, summand) in summands.iter().enumerate().rev() {
            let is_chosen = chosen == Some(place);
            let (mut facts, mut facts_proof) = match is_chosen {
                true => (String::from("1"), String::from("no_positive")),
                false => (String::from("1"), String::from("no_nonnegative")),
            };
            for &fact in summand.facts.iter().rev() {
                let polynomial = self.polynomial_of(fact)?;
                let text = self.polynomial(&polynomial)?;
                facts = format!("{text} * ({facts})");
                facts_proof = match is_chosen {
                    true => format!("(Rmult_gt_0_compat _ _ {} {facts_proof})", self.fact(fact)),
                    false => format!(
                        "(nonnegative_factor _ _ {} {facts_proof})",
                        self.nonnegative_fact(fact)?
                    ),
                };
            }
            let (factor, root) = (number(&summand.factor), self.polynomial(&summand.root)?);
            all = format!("{factor} * ({facts}) * {root} ^ 2 + ({all})");
            proof = match chosen {
                Some(chosen) if chosen == place => {
                    format!("(strict_summand {factor} _ {root} _ ltac:(lra) {facts_proof} ltac:(lra) {proof})")
                }
                Some(chosen) if place < chosen => {
                    format!("(later_summand {factor} _ {root} _ ltac:(lra) {facts_proof} {proof})")
                }
                _ => format!("(summand {factor} _ {root} _ ltac:(lra) {facts_proof} {proof})"),
            };
        }
        let lemma = if strict { "positive_step" } else { "nonnegative_step" };
        let by = equal(&[sum.as_str(), &product, &target, &all].concat());
        Ok(format!(
            "refine ({lemma} {target} ({sum}) ({product}) ({all}) {product_proof} {sum_proof} {proof} _); {by}"
        ))
    }

    /// A polynomial is positive wherever its letters lie between facts.
    fn between(&mut self, target: &Polynomial, within: &[[usize; 2]]) -> Text {
        let (mut letters, mut given, mut bounds, mut shown) =
            (BTreeMap::new(), String::new(), String::new(), String::new());
        for (place, pair) in within.iter().enumerate() {
            let facts = [self.polynomial_of(pair[0])?, self.polynomial_of(pair[1])?];
            let letter = facts[0].generators().into_iter().find(|&letter| {
                facts[1].generators().contains(&letter) && !self.checker.statement.terms().is_closed(letter)
            });
            let letter = letter.ok_or(NO_SUCH)?;
            let own = format!("X{place}");
            letters.insert(letter, own.clone());
            let name = self.short(letter)?;
            let _ = write!(given, " {name}");
            let mut sides = Vec::new();
            for fact in &facts {
                let of_letter = |monomial: &kernel::Monomial| monomial.as_slice() == [(letter, 1)];
                let slope = fact
                    .terms()
                    .iter()
                    .find(|(monomial, _)| of_letter(monomial))
                    .ok_or(NO_SUCH)?;
                let rest = fact
                    .terms()
                    .iter()
                    .filter(|(monomial, _)| !of_letter(monomial))
                    .cloned();
                let rest = Polynomial::from_terms(rest).scaled(&(-Rational::one() / Rational(slope.1.clone())));
                sides.push(self.full_polynomial(&rest)?);
            }
            let [low, high] = [0, 1].map(|side| sides.get(side).cloned().unwrap_or_default());
            let _ = write!(bounds, "{low} <= {own} <= {high} -> ");
            let (first, second) = (self.nonnegative_fact(pair[0])?, self.nonnegative_fact(pair[1])?);
            let _ = write!(shown, " ltac:(generalize {first} {second}; intros; split; lra)");
        }
        let names: Vec<String> = letters.values().cloned().collect();
        let claim = self.write(false, &mut |writer| {
            writer.letters.clone_from(&letters);
            writer.polynomial(target)
        })?;
        let bound: Vec<String> = (0..within.len()).map(|place| format!("X{place}")).collect();
        let first = names.first().cloned().unwrap_or_default();
        Ok(format!(
            "assert (B : forall {} : R, {bounds}{claim} > 0).\n{{ intros; enclose_on {first}. }}\nexact (B{given}{shown})",
            bound.join(" ")
        ))
    }

    fn congruence(&mut self, left: Term, right: Term) -> Text {
        let terms = self.checker.statement.terms_mut();
        let [a, b] = match (terms.node(left).clone(), terms.node(right).clone()) {
            (Node::Elementary(_, a), Node::Elementary(_, b)) | (Node::Value(.., a), Node::Value(.., b)) => [a, b],
            (Node::RealPower(x, a), Node::RealPower(y, b)) if x == y => [a, b],
            (Node::RealPower(a, _), Node::RealPower(b, _)) => [a, b],
            _ => return Err(NO_SUCH),
        };
        let arguments = terms.difference(a, b);
        let by = self.shown(Property::Zero, arguments)?;
        let [inner, outer] = [[a, b], [left, right]].map(|pair| pair.map(|term| self.short(term)));
        let ([a, b], [left_name, right_name]) = (inner, outer);
        let (a, b, left_name, right_name) = (a?, b?, left_name?, right_name?);
        let written = |own: &mut Self, term| own.write(true, &mut |writer| writer.written(term));
        let (left, right) = (written(self, left)?, written(self, right)?);
        Ok(format!(
            "assert (A9 : {a} - {b} = 0).\n{{ {by}. }}\nassert (B9 : {left} = {right}) by (f_equal; exact (Rminus_diag_uniq _ _ A9)).\n\
             refine (numerator_zero ({left_name} - {right_name}) 1 _ (Rminus_diag_eq _ _ B9) _); ring"
        ))
    }

    /// An instance of a law, at a time where it runs over one.
    fn law(&mut self, source: LawSource, at: Option<Term>) -> Text {
        let general = self.general(source)?;
        let instance = self.checker.instance(source, at)?;
        let name = self.source(source);
        let mut text = String::new();
        let mut call = name;
        if let Some(at) = at {
            let short = self.short(at)?;
            call += &format!(" {short}");
            let ends = self.at_end(&general, at);
            if !ends.is_empty() {
                let rewrites: Vec<String> = ends.iter().map(|end| format!("?{end}")).collect();
                let _ = writeln!(
                    text,
                    "pose proof ({call}) as B0. rewrite {} in B0.",
                    rewrites.join(", ")
                );
                call = "B0".to_owned();
                // the states at the ends are spoken of
                for (_, of) in &instance.conditions {
                    self.full(*of)?;
                }
                self.full(instance.term)?;
            }
            if let Some((_, Some(flight))) = self.runs(source) {
                let within = self.in_flight(flight, &short)?;
                let _ = writeln!(text, "assert (I0 : {within}) by within_flight.");
                call += " I0";
            }
        }
        for (count, (shown, of)) in instance.conditions.into_iter().enumerate() {
            let own = self.short(of)?;
            let by = self.shown(shown, of)?;
            let _ = writeln!(text, "assert (A{count} : {}).\n{{ {by}. }}", property(shown, &own));
            call += &format!(" A{count}");
        }
        let own = self.short(instance.term)?;
        let _ = writeln!(
            text,
            "assert (B9 : {}) by exact ({call}).",
            property(instance.property, &own)
        );
        text += &self.of_term(instance.property, instance.term, "B9")?;
        Ok(text)
    }

    /// A law that follows by differentiating another one that holds at every time.
    fn derivative(&mut self, step: &Inference, source: LawSource) -> Text {
        let number = self.checker.laws();
        let runs = self.runs(source);
        let (time, flight) = runs.ok_or(Unwritten::Not("the derivative of a law without a time"))?;
        self.checker.apply(step)?;
        self.times.insert(number, (time, flight));
        let (base, own) = (self.general(source)?, self.general(LawSource::Derived(number))?);
        let law = self.source(source);
        let (at, outer) = self.bind_time(time);
        let text = self.slope(number, flight, &law, &at, &base, &own);
        self.names.put(time, outer);
        text
    }

    fn slope(
        &mut self,
        number: usize,
        flight: Option<i32>,
        law: &str,
        at: &str,
        base: &Instance,
        own: &Instance,
    ) -> Text {
        let (of, slope) = (self.full(base.term)?, self.full(own.term)?);
        if base.conditions.is_empty() && own.conditions.is_empty() && flight.is_none() {
            return Ok(format!(
                "assert (L{number} : forall {at} : R, {slope} = 0).\n{{ apply (slope_of_zero (fun {at} => {of}) (fun {at} => {slope})); \
                 [exact {law} | intro; differentiate_smooth]. }}\n"
            ));
        }
        let conditions = |steps: &mut Self, of: &Instance| {
            let said = of
                .conditions
                .iter()
                .map(|(shown, of)| Ok(property(*shown, &steps.full(*of)?)));
            said.collect::<Result<Vec<String>, Unwritten>>()
        };
        let (before, after) = (conditions(self, base)?, conditions(self, own)?);
        let mut own_before = Before {
            time: Some(at.to_owned()),
            flight: None,
            conditions: after,
        };
        let near = match before.is_empty() {
            true => "True".to_owned(),
            false => before.join(" /\\ "),
        };
        let names: Vec<String> = (0..before.len()).map(|n| format!("K{n}")).collect();
        let taken = match names.as_slice() {
            [] => "_".to_owned(),
            [single] => single.clone(),
            names => format!("({})", names.join(" & ")),
        };
        let proof = match flight {
            Some(flight) => {
                let [from, to] = self.ends(flight)?;
                own_before.flight = Some(format!("{from} <= {at} <= {to}"));
                format!(
                    "refine (slope_in_flight (fun {at} => {of}) (fun {at} => {near}) {from} {to} T0 _ _ _ I0 _ _); \
                     [assumption | intros W0 W1 {taken}; exact ({law} W0 W1 {}) | near_by | differentiate_smooth]",
                    names.join(" ")
                )
            }
            None => format!(
                "refine (slope_nearby (fun {at} => {of}) (fun {at} => {near}) T0 _ _ _ _); \
                 [intros W0 {taken}; exact ({law} W0 {}) | near_by | differentiate_smooth]",
                names.join(" ")
            ),
        };
        let says = own_before.all(&format!("{slope} = 0"));
        Ok(format!(
            "assert (L{number} : {says}).\n{{ intros {}. {proof}. }}\n",
            own_before.names()
        ))
    }

    /// The law that a term whose derivative is 0 has one value.
    fn constant(&mut self, step: &Inference) -> Text {
        let Inference::Constant {
            of,
            time,
            at,
            interval: flight,
            steps,
        } = step
        else {
            return Err(NO_SUCH);
        };
        let (time, flight) = (*time, *flight);
        let number = self.checker.laws();
        let of = self.checker.statement.written_out(*of);
        let slope = self.checker.statement.derivative(of, time);
        let (name, outer) = self.bind_time(time);
        let mark = self.checker.mark();
        let running = self.checker.run_over(flight.map(|flight| (time, flight)));
        let inner = self.scope(steps, &mut |own| {
            let says = property(Property::Zero, &own.short(slope)?);
            let by = own.shown(Property::Zero, slope)?;
            let domain = own.checker.statement.domain(slope);
            let mut text = String::new();
            for (count, (shown, of)) in domain.into_iter().enumerate() {
                let (full, by) = (own.full(of)?, own.shown(shown, of)?);
                let _ = writeln!(text, "assert (A{count} : {}).\n{{ {by}. }}", property(shown, &full));
            }
            Ok(format!("{text}assert (B9 : {says}).\n{{ {by}. }}\n"))
        });
        self.checker.run_over(running);
        self.checker.back_to(mark);
        let applied = self.checker.apply(step);
        self.times.insert(number, (time, flight));
        let text = self.constant_text(inner, of, slope, time, *at, flight, number, &name);
        self.names.put(time, outer);
        applied?;
        text
    }

    #[allow(clippy::too_many_arguments)]
    fn constant_text(
        &mut self,
        inner: Result<(String, Grounds), Unwritten>,
        of: Term,
        slope: Term,
        time: Symbol,
        at: Term,
        flight: Option<i32>,
        number: usize,
        name: &str,
    ) -> Text {
        let (script, mut grounds) = inner?;
        // names of what moves with the time are given where it is bound
        let named = grounds.iter().filter_map(|ground| match ground {
            Ground::Named(term) => Some(*term),
            _ => None,
        });
        let named: BTreeSet<Term> = named.collect();
        let all = self.named_with(&named)?;
        grounds.retain(|ground| !matches!(ground, Ground::Named(_)));
        let mut poses = String::new();
        for (term, body) in all {
            match self.checker.statement.terms().holds(term, time) {
                true => poses += &body,
                false => {
                    grounds.insert(Ground::Named(term));
                }
            }
        }
        self.on = grounds;
        let there = self.checker.statement.moved(of, Some((time, at)), 0);
        let general = Instance {
            property: Property::Zero,
            term: of,
            conditions: Vec::new(),
        };
        let ends = self.at_end(&general, at);
        let rewrites: Vec<String> = ends.iter().map(|end| format!("rewrite ?{end} in B9. ")).collect();
        let mut conditions = String::new();
        let mut taken = String::new();
        let own = self.general(LawSource::Derived(number))?;
        for (count, (shown, of)) in own.conditions.into_iter().enumerate() {
            conditions += &format!("{} -> ", property(shown, &self.full(of)?));
            taken += &format!("C{count} ");
        }
        let (of, there, slope, at) = (self.full(of)?, self.full(there)?, self.full(slope)?, self.full(at)?);
        let during = name.replace('U', "J");
        let (within, intro, call) = match flight {
            Some(flight) => {
                let [from, to] = self.ends(flight)?;
                let call = format!(
                    "(constant_in_flight (fun {name} => {of}) {from} {to} Z9 {name} {at} {during} ltac:(within_flight))"
                );
                let within = format!("{from} <= {name} <= {to} -> ");
                (within, format!("intros {name} {during}. "), call)
            }
            None => {
                let call = format!("(constant_everywhere (fun {name} => {of}) Z9 {name} {at})");
                (String::new(), format!("intros {name}. "), call)
            }
        };
        Ok(format!(
            "assert (L{number} : forall {name} : R, {within}{conditions}{of} - {there} = 0).\n{{ assert (Z9 : forall {name} : R, {within}is_derive (fun {name} => {of}) {name} 0).\n\
             {{ {intro}\n{poses}{script}refine (derivative_is _ _ ({slope}) _ B9); differentiate_smooth. }}\n\
             {intro}intros {taken}. pose proof {call} as B9. cbv beta in B9. {}exact B9. }}\n",
            rewrites.concat()
        ))
    }

    /// The terms that were written by their names since they were asked for.
    pub fn named_here(&mut self) -> Vec<Term> {
        let named = |ground| match ground {
            Ground::Named(term) => Some(term),
            _ => None,
        };
        std::mem::take(&mut self.on).into_iter().filter_map(named).collect()
    }

    /// The definitions of names for terms, in order.
    pub fn named(&mut self, terms: &BTreeSet<Term>) -> Text {
        let all = self.named_with(terms)?.into_iter().map(|(_, text)| text);
        Ok(all.collect())
    }

    /// The definitions of names for terms and those within them, in order.
    fn named_with(&mut self, terms: &BTreeSet<Term>) -> Result<Vec<(Term, String)>, Unwritten> {
        let mut all = terms.clone();
        let mut open: Vec<Term> = terms.iter().copied().collect();
        let mut bodies = Vec::new();
        while let Some(term) = open.pop() {
            self.on.clear();
            let body = self.write(true, &mut |writer| writer.written(term))?;
            for ground in std::mem::take(&mut self.on) {
                if let Ground::Named(inner) = ground
                    && all.insert(inner)
                {
                    open.push(inner);
                }
            }
            bodies.push((term, format!("pose (g{} := {body} : R).\n", term.0)));
        }
        bodies.sort();
        Ok(bodies)
    }
}

/// The guard of an axiom, as its lemma has it, from the property of the difference of its sides.
fn relation(shown: Property, printed: &str, is_nothing: bool, proof: &str, natural: &Option<(&str, String)>) -> String {
    if is_nothing || shown == Property::Integer {
        return proof.to_owned();
    }
    let equal = format!("(Rminus_diag_uniq _ _ {proof})");
    match (shown, natural) {
        (Property::Zero, Some((letter, value))) if printed.ends_with(&format!("= {letter}")) => {
            format!("(is_INR {value}%nat _ {equal})")
        }
        (Property::Zero, Some((letter, value))) if printed.ends_with(&format!("= -{letter}")) => {
            format!("(is_negative_INR {value}%nat _ {equal})")
        }
        (Property::Zero, _) => format!("ltac:(same_sides {proof})"),
        (Property::Nonzero, _) => format!("(Rminus_not_eq _ _ {proof})"),
        (Property::Positive, _) => format!("(Rminus_gt _ _ {proof})"),
        _ => format!("(Rminus_ge _ _ {proof})"),
    }
}

/// The needs of the outermost function of a term: and the index where it is a root.
struct Domain {
    root: Option<u32>,
    conditions: Vec<(Property, Term)>,
}

fn domain_of(statement: &mut Statement, term: Term) -> Domain {
    use kernel::Elementary::{Arccos, Arcsin, Ln, Root};
    let terms = statement.terms_mut();
    let Node::Elementary(function, of) = *terms.node(term) else {
        return Domain {
            root: None,
            conditions: Vec::new(),
        };
    };
    let one = terms.integer(1);
    let conditions = match function {
        Ln => vec![(Property::Positive, of)],
        Root(index) if index % 2 == 0 => vec![(Property::NonNegative, of)],
        Arcsin | Arccos => {
            let above = terms.difference(one, of);
            let below = terms.sum(vec![one, of]);
            vec![(Property::NonNegative, above), (Property::NonNegative, below)]
        }
        _ => Vec::new(),
    };
    let root = match function {
        Root(index) => Some(index),
        _ => None,
    };
    Domain { root, conditions }
}
