//! The values at a point, as Rocq writes them: of symbols closed terms, of functions terms in a letter.

use super::steps::Steps;
use super::text::{Names, Unwritten, Writer};
use crate::algebra::{Steps as Effort, solve};
use kernel::{At, EFFORT, Expansion, Function, Node, Statement, Symbol, Term, With, Witness};
use num_traits::{One, Zero};
use numbers::{Field, Rational};
use std::collections::{BTreeMap, BTreeSet};

/// The values at a point of the symbols and functions that have names, in the order of these.
///
/// # Errors
/// Which of them is not written.
pub fn values(steps: &mut Steps, witness: &With<Witness>) -> Result<Vec<String>, Unwritten> {
    let mut own = witness.statement.clone();
    let at = At::unchecked(&mut own, &witness.evidence, EFFORT);
    let symbols: Vec<Symbol> = steps.names.symbols().map(|(symbol, _)| *symbol).collect();
    let functions: Vec<(u32, u32)> = steps.names.functions().map(|(function, _)| *function).collect();
    let mut point = Point {
        at,
        witness: &witness.evidence,
        known: BTreeMap::new(),
    };
    let symbols = symbols.into_iter().map(|symbol| point.symbol(symbol));
    let mut values = symbols.collect::<Result<Vec<_>, _>>()?;
    for (function, order) in functions {
        values.push(point.function(Function(function), order)?);
    }
    Ok(values)
}

struct Point<'a> {
    at: At<'a>,
    witness: &'a Witness,
    /// Functions given by values at single times, as polynomials.
    known: BTreeMap<Function, Vec<Coefficient>>,
}

/// A coefficient of a polynomial: a number, and multiples of terms that are not written as one.
#[derive(Clone)]
struct Coefficient {
    number: Rational,
    others: Vec<(Rational, Term)>,
}

impl Point<'_> {
    fn symbol(&mut self, symbol: Symbol) -> Result<String, Unwritten> {
        if symbol.0 as usize >= self.at.statement().terms().symbols() {
            // what only a proof speaks of
            return Ok("0".to_owned());
        }
        let term = self.at.statement().terms_mut().symbol(symbol);
        let value = self.at.value(term)?;
        match self.at.statement().terms().is_closed(value) {
            true => closed(self.at.statement(), value),
            // a time over which laws run
            false => Ok("0".to_owned()),
        }
    }

    /// The derivative of an order of a function, as a function.
    fn function(&mut self, function: Function, order: u32) -> Result<String, Unwritten> {
        let named = self.witness.functions.iter().find(|(own, ..)| *own == function);
        let value = match named {
            Some(&(_, time, term)) => {
                let mut value = self.at.value(term)?;
                for _ in 0..order {
                    value = self.at.statement().derivative(value, time);
                }
                value
            }
            None => {
                let (first, depth) = self.first(function);
                let polynomial = self.through_values(first)?;
                self.derivative(&polynomial, order + depth)
            }
        };
        let body = closed(self.at.statement(), value)?;
        Ok(format!("(fun {RUNNING} : R => {body})"))
    }

    /// The derivative of an order of a polynomial, as a term.
    fn derivative(&mut self, polynomial: &[Coefficient], order: u32) -> Term {
        let statement = self.at.statement();
        let letter = statement.fresh(RUNNING);
        let terms = statement.terms_mut();
        let letter = terms.symbol(letter);
        let mut sums = Vec::new();
        for (power, coefficient) in (0_u32..).zip(polynomial) {
            if power < order || (coefficient.number.is_zero() && coefficient.others.is_empty()) {
                continue;
            }
            let factor = slope(power, order, &Rational::one());
            let mut parts = vec![terms.number(coefficient.number.clone() * factor.clone())];
            for (multiple, value) in &coefficient.others {
                let multiple = terms.number(multiple.clone() * factor.clone());
                parts.push(terms.product(vec![multiple, *value]));
            }
            let sum = terms.sum(parts);
            sums.push(match power - order {
                0 => sum,
                left => {
                    let power = terms.add(Node::Power(letter, i32::try_from(left).unwrap_or(i32::MAX)));
                    terms.product(vec![sum, power])
                }
            });
        }
        terms.sum(sums)
    }

    /// The function that is not declared to be a derivative of which a function is one, and of which order.
    fn first(&mut self, function: Function) -> (Function, u32) {
        let declared = self.at.statement().derivatives().clone();
        let (mut first, mut depth) = (function, 0);
        while let Some((&before, _)) = declared.iter().find(|(_, slope)| **slope == first)
            && before != function
        {
            (first, depth) = (before, depth + 1);
        }
        (first, depth)
    }

    /// A polynomial whose derivatives have the values that are given at single times, of it and of functions that are derivatives of it.
    fn through_values(&mut self, first: Function) -> Result<Vec<Coefficient>, Unwritten> {
        if let Some(known) = self.known.get(&first) {
            return Ok(known.clone());
        }
        let names: Vec<Function> = self.witness.functions.iter().map(|(own, ..)| *own).collect();
        if names.into_iter().any(|own| self.first(own).0 == first) {
            return Err(Unwritten::Not("a function given by a formula of its derivative"));
        }
        if self.has_laws(first) {
            return Err(Unwritten::Not(
                "a function given at single times of which a law speaks, as that it has a period",
            ));
        }
        let mut conditions = Vec::new();
        for (function, order, time, value) in self.witness.table.clone() {
            let (own, depth) = self.first(function);
            if own == first {
                let (time, value) = (self.at.value(time)?, self.at.value(value)?);
                let time = self.number(time)?;
                let time = time.ok_or(Unwritten::Not("a function given at times that are not rational"))?;
                conditions.push((order + depth, time, value));
            }
        }
        let columns = u32::try_from(conditions.len()).unwrap_or(0) + 3;
        let row =
            |(order, time, _): &(u32, Rational, Term)| (0..columns).map(|power| slope(power, *order, time)).collect();
        let rows: Vec<Vec<Rational>> = conditions.iter().map(row).collect();
        let none = Coefficient {
            number: Rational::zero(),
            others: Vec::new(),
        };
        let mut polynomial = vec![none; rows.first().map_or(0, Vec::len)];
        for (place, (.., value)) in conditions.iter().enumerate() {
            let is_own = |own: usize| Rational::from_integer(i64::from(own == place));
            let right: Vec<Rational> = (0..conditions.len()).map(is_own).collect();
            let solved = solve(&rows, &right, &mut Effort::new(EFFORT)).ok().flatten();
            let solved = solved.ok_or(Unwritten::Not("a function given by derivatives at single times"))?;
            let number = self.number(*value)?;
            for (multiple, own) in solved
                .into_iter()
                .zip(&mut polynomial)
                .filter(|(multiple, _)| !multiple.is_zero())
            {
                match &number {
                    Some(number) => own.number = own.number.clone() + multiple * number.clone(),
                    None => own.others.push((multiple, *value)),
                }
            }
        }
        self.known.insert(first, polynomial.clone());
        Ok(polynomial)
    }

    /// Returns true if a law speaks of a function, or of one that is a derivative of it.
    fn has_laws(&mut self, first: Function) -> bool {
        let statement = self.at.statement();
        let laws = statement.givens().iter().filter(|given| given.law.is_some());
        let inside = laws.flat_map(|given| statement.terms().inside(given.term));
        let spoken: BTreeSet<Function> = inside
            .filter_map(|inner| match statement.terms().node(inner) {
                Node::Value(function, ..) => Some(*function),
                _ => None,
            })
            .collect();
        spoken.into_iter().any(|own| self.first(own).0 == first)
    }

    /// A closed term that is a rational number.
    fn number(&mut self, term: Term) -> Result<Option<Rational>, Unwritten> {
        let quotient = Expansion::new(BTreeSet::new(), EFFORT).of(self.at.statement().terms(), term)?;
        Ok(quotient
            .numerator
            .as_constant()
            .filter(|_| quotient.divisors.is_empty()))
    }
}

/// The derivative of this order of a power of a letter, at a number.
fn slope(power: u32, order: u32, at: &Rational) -> Rational {
    if order > power {
        return Rational::zero();
    }
    let falling = (0..order).map(|less| Rational::from_integer(i64::from(power - less)));
    falling.fold(
        at.to_power(i32::try_from(power - order).unwrap_or(i32::MAX)),
        |all, factor| all * factor,
    )
}

/// The letter of the functions of a point.
const RUNNING: &str = "u";

/// A term in which one symbol at most is left, which runs.
fn closed(statement: &Statement, term: Term) -> Result<String, Unwritten> {
    let mut names = Names::default();
    for inner in statement.terms().inside(term) {
        if let Node::Symbol(symbol) = statement.terms().node(inner) {
            names.let_be(*symbol, RUNNING);
        }
    }
    let mut writer = Writer {
        statement,
        names: &mut names,
        whole: &BTreeSet::new(),
        is_short: false,
        met: BTreeSet::new(),
        letters: BTreeMap::new(),
    };
    writer.term(term)
}
