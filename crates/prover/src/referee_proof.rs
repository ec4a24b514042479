//! The argument of a proof as a short script: what is given as expressions, and identities that lead to the claim.

use super::explanation::{Proof, named, unmarked};
use super::print::tex;
use super::referee::{Block, NoScript};
use super::script::Decided;
use super::session::term_of;
use super::sympy::{Printer, assumptions, number};
use kernel::{
    AxiomRow, Certificate, Checker, Expansion, Inference, LawSource, Node, Origin, Polynomial, Property, Statement,
    Summand, Term, With,
};
use num_traits::One;
use numbers::Rational;
use std::collections::BTreeMap;

/// Writes the argument of a proof.
pub(super) fn write(one: &Decided, certificate: &With<Certificate>, block: &mut Block) -> Result<(), NoScript> {
    let mut writer = Writer {
        one,
        proof: Proof::replayed(certificate),
        certificate: &certificate.evidence,
        printer: Printer::default(),
        written: BTreeMap::new(),
        block: Block::default(),
    };
    writer.argument()?;
    declare(&writer.printer, &mut writer.proof.statement, block);
    block.lines.append(&mut writer.block.lines);
    Ok(())
}

/// Declares the symbols and functions that were named.
pub(super) fn declare(printer: &Printer, statement: &mut Statement, block: &mut Block) {
    let mut kinds: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for (symbol, name) in printer.symbols() {
        kinds.entry(assumptions(statement, *symbol)).or_default().push(name);
    }
    let real = if statement.is_complex() { "" } else { ", real=True" };
    let functions = printer.functions().values().map(String::as_str);
    kinds.insert(format!("cls=Function{real}"), functions.collect());
    for (assumed, names) in kinds {
        // a text is not broken
        for some in names.chunks(12) {
            let declared = format!("{} = symbols(\"{}\", {assumed})", some.join(", "), some.join(" "));
            block.code(&declared, "");
        }
    }
}

/// A fact as a script has it.
struct Written {
    name: String,
    /// What it is multiplied by to be the fact; empty for 1.
    multiplier: String,
}

/// A property that a step needs, and the fact that says so.
struct Condition {
    property: Property,
    term: Term,
    fact: usize,
}

/// A goal, cleared of its divisors.
struct Goal {
    name: String,
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
            if !conditions.contains_key(&fact) {
                let needed = self.conditions(fact)?;
                open.extend(self.proof.below(&self.proof.facts[fact].1).range(..fact));
                open.extend(needed.iter().flat_map(|condition| self.basis(condition.fact)));
                conditions.insert(fact, needed);
            }
        }
        let goals = self.goals(known)?;
        let shown: Vec<usize> = conditions.keys().copied().collect();
        self.proof.numbers = shown.iter().copied().zip(1..).collect();
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

    /// What must be known for a step, where a fact is needed to say so.
    fn conditions(&mut self, fact: usize) -> Result<Vec<Condition>, NoScript> {
        let statement = &mut self.proof.statement;
        let needed = match self.proof.facts[fact].1.clone() {
            Inference::Axiom(axiom) => axiom.conditions(statement).map_err(|_| NoScript::Step)?.0,
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
            Inference::Along { .. } => return Err(NoScript::Maps),
            Inference::Derivative(_) | Inference::Constant { .. } => return Err(NoScript::Laws),
            _ => Vec::new(),
        };
        let mut conditions = Vec::new();
        for (property, term) in needed {
            if let Some(fact) = self.first_known(property, term, fact)? {
                conditions.push(Condition { property, term, fact });
            }
        }
        Ok(conditions)
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
        let name = format!("e{}", self.proof.numbers[&number]);
        let source = lowered(&unmarked(&self.proof.source(&step)));
        let mut comment = format!("{name} is {}, {source}", words(fact.property));
        let mut multiplier = String::new();
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

    /// What must hold for a step; what is 0 by a combination is asserted.
    fn conditions_in_words(&mut self, conditions: &[Condition]) -> Result<Vec<String>, NoScript> {
        let mut words = Vec::new();
        for condition in conditions {
            let reference = self.reference(condition.fact)?;
            match (condition.property, self.written.get(&condition.fact)) {
                (Property::Zero, _) | (_, None) => {
                    let (polynomial, multiplier) =
                        self.cleared(condition.property, condition.term).ok_or(NoScript::Step)?;
                    let known = &self.proof.facts[condition.fact].0.polynomial;
                    let ratio = ratio(known, &polynomial);
                    let own = self.printer.factor(&self.proof.statement, condition.term)?;
                    let left = scaled(&ratio, &product(&[&own, &multiplier]));
                    let comment = format!("so {} = 0", tex(self.proof.statement.terms(), condition.term));
                    self.block
                        .code(&format!("assert is_zero({left} - ({reference}))"), &comment);
                }
                (property, Some(written)) => words.push(format!("{} is {}", written.name, self::words(property))),
            }
        }
        Ok(words)
    }

    /// The term that a fact says something of, and what the fact has it multiplied by.
    fn term(&mut self, number: usize) -> Option<(Term, String)> {
        let (fact, step) = self.proof.facts[number].clone();
        let statement = &mut self.proof.statement;
        let term = match step {
            Inference::Given(given) => statement.givens().get(given)?.term,
            Inference::Axiom(axiom) => axiom.conditions(statement).ok()?.1.1,
            Inference::Law { source, at } => {
                let mut checker = Checker::new(statement, self.certificate, u64::MAX);
                checker.instance(source, at).ok()?.term
            }
            _ => return None,
        };
        let (polynomial, multiplier) = self.cleared(fact.property, term)?;
        (polynomial == fact.polynomial).then_some((term, multiplier))
    }

    /// What a step rests on as it is printed.
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
            parts.push(self.times(coefficient, &reference)?);
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
        self.block.code(&format!("assert is_zero({left} - ({right}))"), &so);
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
            let by_itself = match goal.property {
                Property::Zero => format!("assert is_zero({})", goal.name),
                _ if goal.polynomial.is_zero() => format!("assert is_zero({})", goal.name),
                Property::Nonzero => format!("assert abs(N({}, 50)) > 0", goal.name),
                Property::Positive | Property::NonNegative => format!("assert N({}, 50) > 0", goal.name),
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
        self.block.code(&format!("assert is_zero({left} - ({reference}))"), &so);
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
