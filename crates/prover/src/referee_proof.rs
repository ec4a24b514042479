//! The argument of a proof as a short script: what is given as expressions, and identities that lead to the claim.

use super::explanation::{Proof, named, unmarked};
use super::print::tex;
use super::referee_lines::{Block, NoScript, WIDEST};
use super::script::Decided;
use super::session::term_of;
use super::sympy::{Printer, assumptions, number};
use kernel::{
    AxiomRow, Certificate, Checker, Expansion, Function, Inference, LawSource, Node, Origin, Polynomial, Property,
    Statement, Summand, Symbol, Term, With,
};
use num_traits::One;
use numbers::Rational;
use std::collections::{BTreeMap, BTreeSet};

/// Writes the argument of a proof.
pub(super) fn write(one: &Decided, certificate: &With<Certificate>, block: &mut Block) -> Result<(), NoScript> {
    let mut writer = Writer {
        one,
        proof: Proof::replayed(certificate),
        certificate: &certificate.evidence,
        printer: Printer::default(),
        written: BTreeMap::new(),
        count: 0,
        equations: BTreeMap::new(),
        derivatives: BTreeMap::new(),
        block: Block::default(),
    };
    writer.argument()?;
    let provided = provided(&writer.proof.statement);
    if !provided.is_empty() {
        block.comment(&format!("provided: {provided}"));
    }
    declare(&writer.printer, &writer.derivatives, &mut writer.proof.statement, block);
    block.lines.append(&mut writer.block.lines);
    Ok(())
}

/// The givens that derivatives exist, which no premise says.
fn provided(statement: &Statement) -> String {
    let origins = statement.givens().iter().map(|given| &given.origin);
    let origins = origins.filter(|origin| matches!(origin, Origin::DerivativesExist(_)));
    let provided: BTreeSet<String> = origins.map(ToString::to_string).collect();
    provided.into_iter().collect::<Vec<_>>().join("; ")
}

/// Declares the symbols and functions that were named, some of these with their derivatives.
fn declare(
    printer: &Printer,
    derivatives: &BTreeMap<(Function, u32), (Function, u32)>,
    statement: &mut Statement,
    block: &mut Block,
) {
    let mut kinds: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for (symbol, name) in printer.symbols() {
        kinds.entry(assumptions(statement, *symbol)).or_default().push(name);
    }
    let real = if statement.is_complex() { "" } else { ", real=True" };
    let functions = printer
        .functions()
        .iter()
        .filter(|(function, _)| !derivatives.contains_key(function));
    let functions = functions.map(|(_, name)| name.as_str());
    kinds.insert(format!("cls=Function{real}"), functions.collect());
    for (assumed, names) in kinds {
        let declared = |some: &[&str]| format!("{} = symbols(\"{}\", {assumed})", some.join(", "), some.join(" "));
        let mut rest = names.as_slice();
        while !rest.is_empty() {
            // a text cannot be broken
            let fits = (1..=rest.len())
                .rev()
                .find(|&count| declared(&rest[..count]).len() <= WIDEST);
            let (some, after) = rest.split_at(fits.unwrap_or(1));
            block.code(&declared(some), "");
            rest = after;
        }
    }
    for (function, derivative) in derivatives {
        let name = |function| printer.functions().get(function).map_or("", String::as_str);
        let (name, derivative) = (name(function), name(derivative));
        let own = format!("{{\"fdiff\": lambda self, i=1: {derivative}(self.args[0])}}");
        block.code(
            &format!("{name} = type(\"{name}\", (Function,), {own})"),
            &format!("{name}' = {derivative}"),
        );
    }
}

/// The unknown functions in a term, each with the order of its derivative.
fn functions_in(statement: &Statement, term: Term) -> BTreeSet<(Function, u32)> {
    let inside = statement.terms().inside(term).into_iter();
    let function = |inner| match statement.terms().node(inner) {
        Node::Value(function, order, _) => Some((*function, *order)),
        _ => None,
    };
    inside.filter_map(function).collect()
}

/// The symbols in a term.
fn symbols_in(statement: &Statement, term: Term) -> BTreeSet<Symbol> {
    let inside = statement.terms().inside(term).into_iter();
    let symbol = |inner| match statement.terms().node(inner) {
        Node::Symbol(symbol) => Some(*symbol),
        _ => None,
    };
    inside.filter_map(symbol).collect()
}

/// A fact as a script has it.
struct Written {
    name: String,
    /// The factor that it is multiplied by to be the fact; empty for 1.
    multiplier: String,
}

/// A property that a step needs, and the fact that says so; none where it is given as it stands.
struct Condition {
    property: Property,
    term: Term,
    fact: Option<usize>,
}

/// A goal, cleared of its divisors.
struct Goal {
    name: String,
    term: Term,
    property: Property,
    /// The goal times what it divides by, as a polynomial and as an expression.
    polynomial: Polynomial,
    expression: String,
    fact: Option<usize>,
}

/// Writes the facts that a proof rests on, in order.
struct Writer<'a> {
    one: &'a Decided,
    proof: Proof,
    certificate: &'a Certificate,
    printer: Printer,
    written: BTreeMap<usize, Written>,
    /// The number of expressions that have a name.
    count: usize,
    /// The names of equations of maps, and the derivatives of functions in these.
    equations: BTreeMap<(usize, usize), String>,
    derivatives: BTreeMap<(Function, u32), (Function, u32)>,
    block: Block,
}

impl Writer<'_> {
    fn argument(&mut self) -> Result<(), NoScript> {
        let known = self.known_goals()?;
        let mut conditions: BTreeMap<usize, Vec<Condition>> = BTreeMap::new();
        let mut open: Vec<usize> = known
            .iter()
            .filter_map(|(.., fact)| *fact)
            .flat_map(|fact| self.basis(fact))
            .collect();
        while let Some(fact) = open.pop() {
            if conditions.contains_key(&fact) {
                continue;
            }
            let needed = self.conditions(fact)?;
            open.extend(self.proof.below(&self.proof.facts[fact].1).range(..fact));
            let facts = needed.iter().filter_map(|condition| condition.fact);
            open.extend(facts.flat_map(|fact| self.basis(fact)));
            conditions.insert(fact, needed);
        }
        let goals = self.goals(known)?;
        let shown: Vec<usize> = conditions.keys().copied().collect();
        for fact in shown {
            let needed = conditions.remove(&fact).unwrap_or_default();
            self.fact(fact, &needed, &goals)?;
        }
        goals.iter().try_for_each(|goal| self.conclude(goal))
    }

    /// The facts that a fact is a linear combination of.
    fn basis(&self, fact: usize) -> Vec<usize> {
        self.proof
            .combinations
            .get(fact)
            .into_iter()
            .flat_map(BTreeMap::keys)
            .copied()
            .collect()
    }

    /// The goals with the facts that show them.
    fn known_goals(&mut self) -> Result<Vec<(Property, Term, Option<usize>)>, NoScript> {
        let goals = self.proof.statement.goal().to_vec();
        let shown: Vec<Option<usize>> = self.proof.goals.iter().map(|(.., fact)| *fact).collect();
        if goals.is_empty() || goals.iter().any(|(property, _)| *property == Property::Integer) {
            return Err(NoScript::Step);
        }
        Ok(goals
            .into_iter()
            .zip(shown)
            .map(|((property, term), fact)| (property, term, fact))
            .collect())
    }

    /// Names the goals.
    fn goals(&mut self, known: Vec<(Property, Term, Option<usize>)>) -> Result<Vec<Goal>, NoScript> {
        let several = known.len() > 1;
        let mut goals = Vec::new();
        for (place, (property, term, fact)) in (1..).zip(known) {
            let name = if several {
                format!("claim_{place}")
            } else {
                "claim".to_owned()
            };
            let expression = self.printer.expression(&self.proof.statement, term)?;
            let (polynomial, multiplier) = self.cleared(property, term).ok_or(NoScript::Step)?;
            if let Some(fact) = fact
                && !self.proof.facts[fact].0.polynomial.is_multiple_of(&polynomial)
            {
                return Err(NoScript::Contradiction);
            }
            self.block
                .name(&name, &expression, &format!("to be shown: it is {}", words(property)));
            let expression = product(&[&name, &multiplier]);
            goals.push(Goal {
                name,
                term,
                property,
                polynomial,
                expression,
                fact,
            });
        }
        Ok(goals)
    }

    /// A term times what it divides by, and that: to even powers where its sign matters.
    fn cleared(&mut self, property: Property, term: Term) -> Option<(Polynomial, String)> {
        let mut expansion = Expansion::new(self.certificate.whole.iter().copied().collect(), u64::MAX);
        let quotient = expansion.of(self.proof.statement.terms(), term).ok()?;
        let has_sign = matches!(property, Property::Positive | Property::NonNegative);
        let (mut polynomial, mut factors) = (quotient.numerator, Vec::new());
        for (divisor, power) in quotient.divisors {
            let is_odd = has_sign && power % 2 == 1;
            if is_odd {
                polynomial = polynomial.times(&divisor);
            }
            factors.push(self.power(&divisor, power + u32::from(is_odd)).ok()?);
        }
        let factors: Vec<&str> = factors.iter().map(String::as_str).collect();
        Some((polynomial, product(&factors)))
    }

    /// A power of a polynomial, as a factor.
    fn power(&mut self, base: &Polynomial, power: u32) -> Result<String, NoScript> {
        let term = term_of(self.proof.statement.terms_mut(), base);
        Ok(match power {
            1 => self.printer.factor(&self.proof.statement, term)?,
            _ => format!("{}**{power}", self.printer.atom(&self.proof.statement, term)?),
        })
    }

    fn polynomial(&mut self, polynomial: &Polynomial) -> Result<String, NoScript> {
        let term = term_of(self.proof.statement.terms_mut(), polynomial);
        Ok(self.printer.expression(&self.proof.statement, term)?)
    }

    /// The conditions of a step, where a fact is needed to say so.
    fn conditions(&mut self, fact: usize) -> Result<Vec<Condition>, NoScript> {
        let statement = &mut self.proof.statement;
        let needed = match self.proof.facts[fact].1.clone() {
            Inference::Axiom(axiom) => axiom.reading(statement).map_err(|_| NoScript::Step)?.conditions,
            Inference::Law { source, at } => {
                let mut checker = Checker::new(statement, self.certificate, u64::MAX);
                let instance = checker.instance(source, at).map_err(|_| NoScript::Laws)?;
                instance.conditions
            }
            Inference::Congruence { left, right } => {
                let arguments: Vec<Term> = [left, right]
                    .iter()
                    .flat_map(|&term| statement.terms().parts(term))
                    .collect();
                match arguments.as_slice() {
                    [a, b] => vec![(Property::Zero, statement.terms_mut().difference(*a, *b))],
                    _ => return Err(NoScript::Step),
                }
            }
            Inference::Between { .. } => return Err(NoScript::Bounds),
            Inference::Cases { .. } => return Err(NoScript::Cases),
            Inference::Along {
                implicit: map,
                equation,
                by,
            } => along_conditions(statement, map, equation, by)?,
            Inference::Derivative(_) | Inference::Constant { .. } => return Err(NoScript::Laws),
            _ => Vec::new(),
        };
        let mut conditions = Vec::new();
        for (property, term) in needed {
            let fact = self.first_known(property, term, fact)?;
            if fact.is_some() || self.is_said(property, term) {
                conditions.push(Condition { property, term, fact });
            }
        }
        Ok(conditions)
    }

    /// Returns true if a property of a term, and not of a symbol, is given as it stands.
    fn is_said(&self, property: Property, term: Term) -> bool {
        let statement = &self.proof.statement;
        let is_symbol = matches!(statement.terms().node(term), Node::Symbol(_));
        !is_symbol && !statement.terms().is_closed(term) && given_as(statement, property, term).is_some()
    }

    /// The fact before another from which on a property is known; none where it is known by itself.
    fn first_known(&mut self, property: Property, term: Term, before: usize) -> Result<Option<usize>, NoScript> {
        let facts: Vec<kernel::Fact> = self.proof.facts[..before]
            .iter()
            .map(|(fact, _)| fact.clone())
            .collect();
        let mut checker = Checker::new(&mut self.proof.statement, self.certificate, u64::MAX);
        let (mut least, mut most) = (0, before);
        while least < most {
            let middle = usize::midpoint(least, most);
            checker.facts = facts[..middle].to_vec();
            match checker.knows(property, term).unwrap_or(false) {
                true => most = middle,
                false => least = middle + 1,
            }
        }
        checker.facts = facts;
        match checker.knows(property, term) {
            Ok(true) => Ok(most.checked_sub(1)),
            _ => Err(NoScript::Step),
        }
    }

    /// Writes a fact: what it is, and why.
    fn fact(&mut self, number: usize, conditions: &[Condition], goals: &[Goal]) -> Result<(), NoScript> {
        let (fact, step) = self.proof.facts[number].clone();
        let is_derived = is_derived(&step);
        let goal = goals
            .iter()
            .find(|goal| goal.fact == Some(number))
            .filter(|_| is_derived);
        let own = match goal {
            Some(goal) => {
                let ratio = ratio(&fact.polynomial, &goal.polynomial);
                Some(scaled(&ratio, &goal.expression))
            }
            None => None,
        };
        if let Inference::Congruence { left, right } = step
            && self.printer.expression(&self.proof.statement, left)?
                == self.printer.expression(&self.proof.statement, right)?
        {
            // SymPy writes both alike
            self.written.insert(
                number,
                Written {
                    name: "0".to_owned(),
                    multiplier: String::new(),
                },
            );
            return Ok(());
        }
        self.count += 1;
        let name = format!("e{}", self.count);
        let source = lowered(&unmarked(&self.proof.source(&step)));
        let mut comment = format!("{name} is {}, {source}", words(fact.property));
        let mut multiplier = String::new();
        if let Inference::Along {
            implicit: map,
            equation,
            by,
        } = step
        {
            let of = self.premise_along(map, equation)?;
            multiplier = self.along(&name, of, [map, equation], by, &fact.polynomial)?;
            self.written.insert(number, Written { name, multiplier });
            return Ok(());
        }
        let expression = match (own, self.term(number)) {
            (Some(own), _) => own,
            (None, Some((term, clears))) => {
                multiplier = clears;
                self.printer.expression(&self.proof.statement, term)?
            }
            (None, None) => self.polynomial(&fact.polynomial)?,
        };
        if let Some(printed) = self.printed(&step) {
            comment = format!("{comment}:  {printed}");
        }
        let conditions = self.conditions_in_words(conditions)?;
        if !conditions.is_empty() {
            comment = format!("{comment}, as {}", conditions.join(", "));
        }
        if is_derived {
            comment = String::new();
        }
        self.block.name(&name, &expression, &comment);
        self.written.insert(
            number,
            Written {
                name: name.clone(),
                multiplier,
            },
        );
        if is_derived {
            self.derive(&name, &step)?;
        } else if matches!(step, Inference::Enclosure(_)) {
            self.block.code(&format!("assert N({name}, 50) > 0"), "");
        }
        Ok(())
    }

    /// Names an equation of a map, abbreviations written out, as it is differentiated; gives the name.
    fn premise_along(&mut self, map: usize, equation: usize) -> Result<String, NoScript> {
        let key = (map, equation);
        if let Some(name) = self.equations.get(&key) {
            return Ok(name.clone());
        }
        let maps = self.proof.statement.implicit();
        let own = maps.get(map).and_then(|step| step.equations.get(equation)).cloned();
        let (origin, term) = own.ok_or(NoScript::Step)?;
        let written = self.proof.statement.written_out(term);
        let name = self.printer.free("p");
        let expression = self.printer.expression(&self.proof.statement, written)?;
        let givens = self.proof.statement.givens().iter();
        let place = givens
            .clone()
            .position(|given| given.origin == origin && given.term == term);
        let printed = place
            .and_then(|given| self.premise(given))
            .map_or(String::new(), |tex| format!(":  {tex}"));
        self.block.name(
            &name,
            &expression,
            &format!("{name} is 0 by ({origin}), abbreviations written out{printed}"),
        );
        for function in functions_in(&self.proof.statement, written) {
            self.differentiate(function);
        }
        self.equations.insert(key, name.clone());
        Ok(name)
    }

    /// Names the derivative of a function, for SymPy to differentiate by.
    fn differentiate(&mut self, (function, order): (Function, u32)) {
        let statement = &mut self.proof.statement;
        let zero = statement.terms_mut().integer(0);
        let next = statement.value(function, order + 1, zero);
        if let Node::Value(next, more, _) = *statement.terms().node(next) {
            self.printer.function(statement, next, more);
            self.derivatives.insert((function, order), (next, more));
        }
    }

    /// Names the derivative of an equation along a map, as SymPy finds it; gives what clears it.
    fn along(
        &mut self,
        name: &str,
        of: String,
        [map, equation]: [usize; 2],
        by: Symbol,
        fact: &Polynomial,
    ) -> Result<String, NoScript> {
        let [written, slope] = slope_along(&mut self.proof.statement, map, equation, by)?;
        let (polynomial, multiplier) = self.cleared(Property::Zero, slope).ok_or(NoScript::Step)?;
        if polynomial != *fact {
            return Err(NoScript::Step);
        }
        let starts = self
            .proof
            .statement
            .implicit()
            .get(map)
            .map(|step| step.by.clone())
            .unwrap_or_default();
        let (mut parts, mut moved) = (Vec::new(), Vec::new());
        for symbol in symbols_in(&self.proof.statement, written) {
            let printed = self.printer.symbol(&self.proof.statement, symbol);
            if symbol == by {
                parts.insert(0, format!("diff({of}, {printed})"));
            } else if self.proof.statement.depends(symbol) && !starts.contains(&symbol) {
                let partial = self.proof.statement.partial(symbol, by);
                let partial = self.printer.symbol(&self.proof.statement, partial);
                parts.push(format!("diff({of}, {printed})*{partial}"));
                moved.push(printed);
            }
        }
        let by = self.printer.symbol(&self.proof.statement, by);
        let comment = format!(
            "{name} is 0: {of} differentiated by {by}{}",
            match moved.as_slice() {
                [] => String::new(),
                moved => format!(" along the map, which moves {}", moved.join(" and ")),
            }
        );
        self.block.name(name, &sum(&parts), &comment);
        Ok(multiplier)
    }

    /// The conditions of a step; what is 0 by a combination is asserted.
    fn conditions_in_words(&mut self, conditions: &[Condition]) -> Result<Vec<String>, NoScript> {
        let mut words = Vec::new();
        for condition in conditions {
            let Some(fact) = condition.fact else {
                let shown = tex(self.proof.statement.terms(), condition.term);
                words.push(format!("{shown} is {}", self::words(condition.property)));
                continue;
            };
            match (condition.property, self.written.get(&fact)) {
                (Property::Zero, _) | (_, None) => self.vanishing(condition.term, fact)?,
                (property, Some(written)) => words.push(format!("{} is {}", written.name, self::words(property))),
            }
        }
        Ok(words)
    }

    /// Asserts that a term is 0, as a fact says.
    fn vanishing(&mut self, term: Term, fact: usize) -> Result<(), NoScript> {
        let (polynomial, multiplier) = self.cleared(Property::Zero, term).ok_or(NoScript::Step)?;
        let ratio = ratio(&self.proof.facts[fact].0.polynomial, &polynomial);
        let own = self.printer.factor(&self.proof.statement, term)?;
        let left = scaled(&ratio, &product(&[&own, &multiplier]));
        let so = format!("so {} = 0", tex(self.proof.statement.terms(), term));
        let right = self.reference(fact)?;
        self.block
            .code(&format!("assert is_zero({})", difference(&left, &right)), &so);
        Ok(())
    }

    /// The term that a fact says something of, and what the fact has it multiplied by.
    fn term(&mut self, number: usize) -> Option<(Term, String)> {
        let (fact, step) = self.proof.facts[number].clone();
        let statement = &mut self.proof.statement;
        let term = match step {
            Inference::Given(given) => statement.givens().get(given)?.term,
            Inference::Axiom(axiom) => axiom.reading(statement).ok()?.term,
            Inference::Law { source, at } => {
                let mut checker = Checker::new(statement, self.certificate, u64::MAX);
                checker.instance(source, at).ok()?.term
            }
            _ => return None,
        };
        let (polynomial, multiplier) = self.cleared(fact.property, term)?;
        (polynomial == fact.polynomial).then_some((term, multiplier))
    }

    /// The givens that a step rests on, as they are printed.
    fn printed(&self, step: &Inference) -> Option<String> {
        match step {
            Inference::Given(given)
            | Inference::Law {
                source: LawSource::Given { given, .. },
                ..
            } => self.premise(*given),
            Inference::Axiom(axiom) => AxiomRow::named(axiom.name).map(|row| row.conclusion.to_owned()),
            Inference::Unfold(term) => {
                let statement = &self.proof.statement;
                let Node::Symbol(symbol) = statement.terms().node(*term) else {
                    return None;
                };
                let meaning = tex(statement.terms(), *statement.definitions().get(symbol)?);
                Some(format!("{} = {meaning}", tex(statement.terms(), *term)))
            }
            _ => None,
        }
    }

    /// The premise that a given says, where it says all of it.
    fn premise(&self, given: usize) -> Option<String> {
        let givens = self.proof.statement.givens();
        let origin = &givens.get(given)?.origin;
        let Origin::Premise(label) = origin else {
            return None;
        };
        let premises = self
            .one
            .goal
            .statements
            .premises
            .iter()
            .filter(|premise| premise.label == *label);
        let premises: Vec<_> = premises.collect();
        let same: Vec<usize> = (0..givens.len())
            .filter(|&other| givens[other].origin == *origin)
            .collect();
        match premises.as_slice() {
            [single] => Some(single.equation.to_string()),
            several if several.len() == same.len() => {
                let place = same.iter().position(|other| *other == given)?;
                Some(several.get(place)?.equation.to_string())
            }
            _ => Some(format!(
                "{} = 0",
                tex(self.proof.statement.terms(), givens.get(given)?.term)
            )),
        }
    }

    /// A fact as a combination of those that are written.
    fn reference(&mut self, fact: usize) -> Result<String, NoScript> {
        let mut parts = Vec::new();
        for (number, coefficient) in self.proof.combinations[fact].clone() {
            let (name, multiplier) = match self.written.get(&number) {
                Some(written) if written.name == "0" => continue,
                Some(written) => (written.name.clone(), written.multiplier.clone()),
                None => return Err(NoScript::Step),
            };
            parts.push(self.times(&coefficient, &product(&[&multiplier, &name]))?);
        }
        Ok(sum(&parts))
    }

    /// A polynomial times an expression.
    fn times(&mut self, coefficient: &Polynomial, by: &str) -> Result<String, NoScript> {
        if let Some(value) = coefficient.as_constant() {
            return Ok(scaled(&value, by));
        }
        let term = term_of(self.proof.statement.terms_mut(), coefficient);
        let text = self.printer.expression(&self.proof.statement, term)?;
        Ok(match coefficient.terms() {
            // one term, its sign first
            [_] => format!("{text}*{by}"),
            _ => format!("({text})*{by}"),
        })
    }

    /// The sum of multiples of facts that are 0.
    fn combination(&mut self, terms: &[(Polynomial, usize)]) -> Result<Vec<String>, NoScript> {
        let mut parts = Vec::new();
        for (coefficient, fact) in terms {
            let reference = bracketed(&self.reference(*fact)?);
            if reference != "0" {
                parts.push(self.times(coefficient, &reference)?);
            }
        }
        Ok(parts)
    }

    /// A product of powers of facts.
    fn factors(&mut self, factors: &[(usize, u32)]) -> Result<String, NoScript> {
        let mut parts = Vec::new();
        for (fact, power) in factors {
            let reference = bracketed(&self.reference(*fact)?);
            parts.push(match power {
                1 => reference,
                power => format!("({reference})**{power}"),
            });
        }
        let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
        Ok(product(&parts))
    }

    /// Asserts the identity that a step is.
    fn derive(&mut self, name: &str, step: &Inference) -> Result<(), NoScript> {
        let (left, right, so) = match step {
            Inference::Zero {
                power,
                squares,
                factors,
                terms,
                ..
            } => {
                let raised = if *power == 1 {
                    name.to_owned()
                } else {
                    format!("{name}**{power}")
                };
                let mut left = vec![raised];
                for (factor, root) in squares {
                    let root = self.power(root, 2)?;
                    left.push(scaled(factor, &root));
                }
                let left = product(&[&self.factors(factors)?, &bracketed(&sum(&left))]);
                let because = match (factors.is_empty(), squares.is_empty()) {
                    (true, true) => String::new(),
                    (false, true) => format!(", as {} is not 0", self.factors(factors)?),
                    _ => ", as squares are not negative".to_owned(),
                };
                (left, sum(&self.combination(terms)?), format!("so {name} = 0{because}"))
            }
            Inference::Nonzero {
                cofactor,
                factors,
                terms,
                ..
            } => {
                let left = self.times(cofactor, name)?;
                let mut right = vec![self.factors(factors)?];
                right.extend(self.combination(terms)?);
                let because = self.factors(factors)?;
                (left, sum(&right), format!("so {name} is not 0, as {because} is not"))
            }
            Inference::Sign {
                strict,
                factors,
                summands,
                terms,
                ..
            } => {
                let left = product(&[&self.factors(factors)?, name]);
                let mut right = Vec::new();
                for summand in summands {
                    right.push(self.summand(summand)?);
                }
                right.extend(self.combination(terms)?);
                let sign = if *strict {
                    "> 0: no summand is negative, one is > 0"
                } else {
                    ">= 0: no summand is negative"
                };
                (left, sum(&right), format!("so {name} {sign}"))
            }
            Inference::Squeezed { low, high } => {
                let (low, high) = (self.reference(*low)?, self.reference(*high)?);
                (
                    format!("({low})"),
                    format!("-({high})"),
                    format!("so {name} = 0: neither positive nor negative"),
                )
            }
            _ => return Err(NoScript::Step),
        };
        self.block
            .code(&format!("assert is_zero({})", difference(&left, &right)), &so);
        Ok(())
    }

    fn summand(&mut self, summand: &Summand) -> Result<String, NoScript> {
        let mut parts = Vec::new();
        for fact in &summand.facts {
            parts.push(bracketed(&self.reference(*fact)?));
        }
        let is_one = summand.root.as_constant().is_some_and(|root| root.is_one());
        if !is_one || parts.is_empty() {
            parts.push(self.power(&summand.root, 2)?);
        }
        let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
        Ok(scaled(&summand.factor, &product(&parts)))
    }

    /// Asserts that a goal follows from the facts that are written.
    fn conclude(&mut self, goal: &Goal) -> Result<(), NoScript> {
        let so = format!("so {} is {}", goal.name, words(goal.property));
        let Some(fact) = goal.fact else {
            let given = given_as(&self.proof.statement, goal.property, goal.term);
            if let Some(given) = given.filter(|_| goal.polynomial.as_constant().is_none()) {
                let source = lowered(&unmarked(&self.proof.source(&Inference::Given(given))));
                let printed = self
                    .premise(given)
                    .map_or(String::new(), |printed| format!(":  {printed}"));
                self.block.comment(&format!("{so}, {source}{printed}"));
                return Ok(());
            }
            let mut generators = goal.polynomial.generators().into_iter();
            let is_number = generators.all(|term| self.proof.statement.terms().is_closed(term));
            let value = match self.proof.statement.terms().is_closed(goal.term) {
                true => goal.name.clone(),
                false => format!("simplify({})", goal.name),
            };
            let by_itself = match goal.property {
                Property::Zero => format!("assert is_zero({})", goal.name),
                _ if goal.polynomial.is_zero() => format!("assert is_zero({})", goal.name),
                _ if !is_number => return Err(NoScript::Step),
                Property::Nonzero => format!("assert abs(N({value}, 50)) > 0"),
                Property::Positive | Property::NonNegative => format!("assert N({value}, 50) > 0"),
                Property::Integer => return Err(NoScript::Step),
            };
            self.block.code(&by_itself, &so);
            return Ok(());
        };
        let (known, step) = self.proof.facts[fact].clone();
        let is_combination = self.basis(fact) != [fact];
        if is_derived(&step) && !is_combination {
            self.block.comment(&so);
            return Ok(());
        }
        let left = scaled(&ratio(&known.polynomial, &goal.polynomial), &goal.expression);
        let reference = self.reference(fact)?;
        self.block
            .code(&format!("assert is_zero({})", difference(&left, &reference)), &so);
        Ok(())
    }
}

/// Returns true for a step that is an identity with facts before it.
fn is_derived(step: &Inference) -> bool {
    let mut names_any = matches!(
        step,
        Inference::Zero { .. } | Inference::Nonzero { .. } | Inference::Sign { .. }
    );
    named(step, &mut |_| names_any = true);
    names_any
}

/// How many times a polynomial is another one.
fn ratio(of: &Polynomial, unit: &Polynomial) -> Rational {
    let lead = |polynomial: &Polynomial| polynomial.terms().first().map(|(_, value)| value.clone());
    match (lead(of), lead(unit)) {
        (Some(of), Some(unit)) => Rational(of / unit),
        _ => Rational::one(),
    }
}

/// A number times an expression.
fn scaled(factor: &Rational, expression: &str) -> String {
    match factor {
        one if one.is_one() => expression.to_owned(),
        minus if *minus == -Rational::one() => format!("-{expression}"),
        factor => format!("{}*{expression}", number(factor)),
    }
}

/// An equation of a map, and its derivative along it.
fn slope_along(statement: &mut Statement, map: usize, equation: usize, by: Symbol) -> Result<[Term; 2], NoScript> {
    let step = statement.implicit().get(map).cloned().ok_or(NoScript::Step)?;
    let (_, term) = step.equations.get(equation).ok_or(NoScript::Step)?;
    Ok([statement.written_out(*term), statement.along(*term, &step, by)])
}

/// The conditions for an equation of a map to be differentiated along it.
fn along_conditions(
    statement: &mut Statement,
    map: usize,
    equation: usize,
    by: Symbol,
) -> Result<Vec<(Property, Term)>, NoScript> {
    let [written, slope] = slope_along(statement, map, equation, by)?;
    let domain = statement.domain(written);
    let near = statement.holding_near(&domain, &[written], &Statement::depends);
    let slopes = statement.domain(slope);
    Ok([domain, slopes, near.ok_or(NoScript::Step)?].concat())
}

/// The difference of expressions that may stand in sums.
fn difference(left: &str, right: &str) -> String {
    match right {
        "0" => left.to_owned(),
        right if right.contains(' ') || right.starts_with('-') => format!("{left} - ({right})"),
        right => format!("{left} - {right}"),
    }
}

/// The given, of no time or index, that says a property of a term as it stands.
fn given_as(statement: &Statement, property: Property, term: Term) -> Option<usize> {
    let implied = |known: Property| match property {
        Property::Nonzero => matches!(known, Property::Nonzero | Property::Positive),
        Property::NonNegative => matches!(known, Property::NonNegative | Property::Positive | Property::Zero),
        _ => known == property,
    };
    let mut givens = statement.givens().iter();
    givens.position(|given| given.law.is_none() && given.term == term && implied(given.property))
}

/// A product of expressions that may stand in one; those that are empty are 1.
fn product(factors: &[&str]) -> String {
    let factors: Vec<&str> = factors.iter().copied().filter(|factor| !factor.is_empty()).collect();
    factors.join("*")
}

/// A sum of expressions that may stand in one.
fn sum(parts: &[String]) -> String {
    let mut text = String::new();
    for part in parts {
        match (text.is_empty(), part.strip_prefix('-')) {
            (true, _) => text.clone_from(part),
            (false, Some(part)) => text = format!("{text} - {part}"),
            (false, None) => text = format!("{text} + {part}"),
        }
    }
    if text.is_empty() { "0".into() } else { text }
}

/// An expression in brackets, but for a name.
fn bracketed(expression: &str) -> String {
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    match expression.chars().all(is_name) {
        true => expression.to_owned(),
        false => format!("({expression})"),
    }
}

/// A property in words.
fn words(property: Property) -> &'static str {
    match property {
        Property::Zero => "0",
        Property::Nonzero => "not 0",
        Property::Positive => "> 0",
        Property::NonNegative => ">= 0",
        Property::Integer => "an integer",
    }
}

/// Words within a sentence.
fn lowered(words: &str) -> String {
    let mut letters = words.chars();
    match letters.next() {
        Some(first) => first.to_lowercase().chain(letters).collect(),
        None => String::new(),
    }
}
