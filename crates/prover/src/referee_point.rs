//! A counterexample as a short script: the values, what is given there, and that the claim fails.

use super::formula::quoted;
use super::print::{simplified, tex};
use super::referee_lines::{Block, NoScript};
use super::script::Decided;
use super::sympy::{Printer, number};
use kernel::{At, EFFORT, Function, Given, Node, Origin, Property, Statement, Symbol, Term, With, Witness, refute};
use num_traits::Zero;
use numbers::Rational;
use std::collections::BTreeSet;

/// Writes a counterexample.
pub(super) fn write(one: &Decided, witness: &With<Witness>, block: &mut Block) -> Result<(), NoScript> {
    if refute(&one.question.statement, witness).is_err() {
        return Err(NoScript::Nowhere);
    }
    if !witness.statement.implicit().is_empty() {
        return Err(NoScript::Maps);
    }
    let mut statement = witness.statement.clone();
    let givens = spoken_givens(&statement);
    let mut point = Point {
        at: At::unchecked(&mut statement, &witness.evidence, EFFORT),
        witness: &witness.evidence,
        printer: Printer::default(),
        bound: BTreeSet::new(),
        asserts: Block::default(),
    };
    point.givens(one, &givens)?;
    point.claim()?;
    let mut values = Block::default();
    point.values(&mut values)?;
    block.lines.append(&mut values.lines);
    block.lines.append(&mut point.asserts.lines);
    Ok(())
}

/// All that is given, but for what holds of all functions that are declared.
fn spoken_givens(statement: &Statement) -> Vec<Given> {
    let goals: BTreeSet<Term> = statement
        .goal()
        .iter()
        .flat_map(|(_, term)| statement.terms().inside(*term))
        .collect();
    let said: BTreeSet<Term> = statement
        .givens()
        .iter()
        .filter(|given| !matches!(given.origin, Origin::Declared(_)))
        .flat_map(|given| statement.terms().inside(given.term))
        .chain(goals)
        .collect();
    // a declared sign of a symbol that nothing speaks of is left out
    let is_spoken = |given: &&Given| !matches!(given.origin, Origin::Declared(_)) || said.contains(&given.term);
    statement.givens().iter().filter(is_spoken).cloned().collect()
}

/// A statement at a point.
struct Point<'a> {
    at: At<'a>,
    witness: &'a Witness,
    printer: Printer,
    /// Symbols that run over all numbers, and have no value.
    bound: BTreeSet<Symbol>,
    asserts: Block,
}

impl Point<'_> {
    /// The value of a term, in its simplest form.
    fn value(&mut self, term: Term) -> Result<Term, NoScript> {
        let value = self.at.value(term).map_err(|_| NoScript::Value)?;
        let value = simplified(self.at.statement().terms_mut(), value);
        match self.at.statement().terms().is_closed(value) {
            true => Ok(value),
            false => Err(NoScript::Value),
        }
    }

    fn expression(&mut self, term: Term) -> Result<String, NoScript> {
        Ok(self.printer.expression(self.at.statement(), term)?)
    }

    /// Asserts what is given: premises one by one, then signs and domains.
    fn givens(&mut self, one: &Decided, givens: &[Given]) -> Result<(), NoScript> {
        let mut conditions: Vec<String> = Vec::new();
        for given in givens {
            if given.law.is_some() {
                self.law(given)?;
                continue;
            }
            let is_number = self.at.statement().terms().is_closed(given.term);
            let holds = self.holds(given.property, given.term)?;
            match &given.origin {
                Origin::Premise(label) => {
                    let comment = format!("({label})  {}", printed(one, label, self.at.statement(), given.term));
                    self.asserts.code(&format!("assert ({holds})"), &comment);
                }
                _ if !is_number && !conditions.contains(&holds) => conditions.push(holds),
                _ => {}
            }
        }
        if !conditions.is_empty() {
            let conditions = conditions.join(" and ");
            self.asserts
                .code(&format!("assert ({conditions})"), "assumptions and domains");
        }
        Ok(())
    }

    /// That a term has a property at the point, as Python.
    fn holds(&mut self, property: Property, term: Term) -> Result<String, NoScript> {
        let expression = self.expression(term)?;
        let value = self.value(term)?;
        let is_plain = matches!(self.at.statement().terms().node(value), Node::Number(_));
        Ok(match (property, is_plain) {
            (Property::Zero, true) => format!("{expression} == 0"),
            (Property::Zero, false) => format!("simplify({expression}) == 0"),
            (Property::Nonzero, true) => format!("{expression} != 0"),
            (Property::Nonzero, false) => format!("abs(N({expression}, 30)) > 10**-20"),
            (Property::Positive, _) => format!("{expression} > 0"),
            (Property::NonNegative, _) => format!("{expression} >= 0"),
            (Property::Integer, _) => format!("S({expression}).is_integer"),
        })
    }

    /// Asserts a law where all functions in it are given by formulas.
    fn law(&mut self, given: &Given) -> Result<(), NoScript> {
        let (Some(law), Property::Zero) = (&given.law, given.property) else {
            return Err(NoScript::Functions);
        };
        let (Some(time), None, true) = (law.time, law.interval, law.conditions.is_empty()) else {
            return Err(NoScript::Functions);
        };
        let statement = self.at.statement();
        let functions = functions_in(statement, given.term);
        let is_named = |function: &Function| self.witness.functions.iter().any(|(named, ..)| named == function);
        if !functions.iter().all(is_named) {
            return Err(NoScript::Functions);
        }
        // the claim may be of one time
        let statement = self.at.statement();
        let printed = statement.terms().symbol_name(time).to_owned();
        let any = statement.fresh(&printed);
        let at_any = statement.terms_mut().symbol(any);
        let term = statement.terms_mut().substitute(given.term, time, at_any);
        self.bound.insert(any);
        let name = self.printer.symbol(self.at.statement(), any);
        let expression = self.expression(term)?;
        let quoted = quoted(&name);
        self.asserts.code(&format!("{name} = symbols({quoted}, real=True)"), "");
        let comment = format!("({}), at all {name}", given.origin);
        self.asserts
            .code(&format!("assert simplify({expression}) == 0"), &comment);
        Ok(())
    }

    /// Asserts that the claim fails.
    fn claim(&mut self) -> Result<(), NoScript> {
        let goals = self.at.statement().goal().to_vec();
        let mut failing = None;
        for (property, term) in &goals {
            let value = self.value(*term)?;
            let fails = match self.at.statement().terms().node(value) {
                Node::Number(value) => match property {
                    Property::Zero => !value.is_zero(),
                    Property::Nonzero => value.is_zero(),
                    Property::Positive => *value <= Rational::zero(),
                    Property::NonNegative => *value < Rational::zero(),
                    Property::Integer => value.to_integer().is_none(),
                },
                _ => goals.len() == 1,
            };
            if fails {
                failing = Some((*property, *term, value));
                break;
            }
        }
        let (property, term, value) = failing.ok_or(NoScript::Value)?;
        let expression = self.expression(term)?;
        let is_plain = matches!(self.at.statement().terms().node(value), Node::Number(_));
        let shown = tex(self.at.statement().terms(), value);
        self.asserts
            .name("claim", &expression, &format!("left and right differ by {shown}"));
        let fails = match (property, is_plain) {
            (Property::Zero, true) => "assert claim != 0".to_owned(),
            (Property::Zero, false) => "assert abs(N(claim, 30)) > 10**-20".to_owned(),
            (Property::Nonzero, true) => "assert claim == 0".to_owned(),
            (Property::Nonzero, false) => "assert simplify(claim) == 0".to_owned(),
            (Property::Positive, _) => "assert not claim > 0".to_owned(),
            (Property::NonNegative, _) => "assert not claim >= 0".to_owned(),
            (Property::Integer, _) => "assert not S(claim).is_integer".to_owned(),
        };
        self.asserts.code(&fails, "the claim says otherwise");
        Ok(())
    }

    /// Writes the values of all that was named; of an abbreviation what it stands for.
    fn values(&mut self, to: &mut Block) -> Result<(), NoScript> {
        let functions = self.functions()?;
        let (mut done, mut definitions) = (self.bound.clone(), Vec::new());
        while let Some((symbol, name)) = self.next(&done) {
            done.insert(symbol);
            let statement = self.at.statement();
            if let Some(&meaning) = statement.definitions().get(&symbol) {
                definitions.push((name, self.expression(meaning)?));
                continue;
            }
            let printed = statement.terms().symbol_name(symbol).to_owned();
            let term = statement.terms_mut().symbol(symbol);
            let value = self.value(term)?;
            let text = self.exact(value)?;
            let comment = if printed == name { "" } else { printed.as_str() };
            to.name(&name, &text, comment);
        }
        // what an abbreviation stands for may hold others, which were met later
        for (name, meaning) in definitions.into_iter().rev() {
            to.name(&name, &meaning, "by definition");
        }
        for (name, meaning) in functions {
            to.name(&name, &meaning, "");
        }
        Ok(())
    }

    fn next(&self, done: &BTreeSet<Symbol>) -> Option<(Symbol, String)> {
        let mut symbols = self.printer.symbols().iter();
        symbols
            .find(|(symbol, _)| !done.contains(symbol))
            .map(|(symbol, name)| (*symbol, name.clone()))
    }

    /// A value that Python does not round.
    fn exact(&mut self, value: Term) -> Result<String, NoScript> {
        match self.at.statement().terms().node(value).clone() {
            Node::Number(value) if number(&value).starts_with("Rational") => Ok(number(&value)),
            Node::Number(value) => Ok(format!("Integer({})", number(&value))),
            _ => self.expression(value),
        }
    }

    /// The functions that were named, each as a function of Python.
    fn functions(&mut self) -> Result<Vec<(String, String)>, NoScript> {
        let mut found = Vec::new();
        for ((function, order), name) in self.printer.functions().clone() {
            let named = self.witness.functions.iter().find(|(named, ..)| *named == function);
            let meaning = match named {
                Some(&(_, time, term)) => self.formula(time, term, order)?,
                None => {
                    // the values are named by symbols: no argument may hide one
                    let argument = self.printer.free("at");
                    format!("lambda {argument}: {}[{argument}]", self.table(function, order)?)
                }
            };
            found.push((name, meaning));
        }
        Ok(found)
    }

    /// The derivative of this order of a term in a symbol, as a function of Python.
    fn formula(&mut self, time: Symbol, term: Term, order: u32) -> Result<String, NoScript> {
        let slope = (0..order).fold(term, |slope, _| self.at.statement().derivative(slope, time));
        let slope = simplified(self.at.statement().terms_mut(), slope);
        if !functions_in(self.at.statement(), slope).is_empty() {
            return Err(NoScript::Functions);
        }
        self.bound.insert(time);
        let name = self.printer.symbol(self.at.statement(), time);
        let expression = self.exact(slope)?;
        Ok(format!("lambda {name}: {expression}"))
    }

    /// The values of a function at the times that claim and premises speak of.
    fn table(&mut self, function: Function, order: u32) -> Result<String, NoScript> {
        let statement = self.at.statement();
        let givens = statement
            .givens()
            .iter()
            .filter(|given| given.law.is_none())
            .map(|given| given.term);
        let written: Vec<Term> = givens.chain(statement.goal().iter().map(|(_, term)| *term)).collect();
        let inside: BTreeSet<Term> = written
            .iter()
            .flat_map(|term| statement.terms().inside(*term))
            .collect();
        let mut rows: Vec<String> = Vec::new();
        for inner in inside {
            if let Node::Value(of, own, time) = *self.at.statement().terms().node(inner)
                && (of, own) == (function, order)
            {
                let value = self.value(inner)?;
                rows.push(format!("{}: {}", self.expression(time)?, self.exact(value)?));
            }
        }
        Ok(format!("{{{}}}", rows.join(", ")))
    }
}

/// The unknown functions in a term.
fn functions_in(statement: &Statement, term: Term) -> BTreeSet<Function> {
    let inside = statement.terms().inside(term).into_iter();
    let function = |inner| match statement.terms().node(inner) {
        Node::Value(function, ..) => Some(*function),
        _ => None,
    };
    inside.filter_map(function).collect()
}

/// A premise as it is printed, where its label names one.
fn printed(one: &Decided, label: &str, statement: &Statement, term: Term) -> String {
    let premises = one
        .goal
        .statements
        .premises
        .iter()
        .filter(|premise| premise.label == label);
    match premises.collect::<Vec<_>>().as_slice() {
        [single] => single.equation.to_string(),
        _ => format!("{} = 0", tex(statement.terms(), term)),
    }
}
