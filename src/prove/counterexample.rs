//! Points at which the premises of a claim hold and the claim does not.

use super::print::{simplified, tex};
use crate::kernel::{Node, Property, Quantity, Statement, Symbol, Term, With, Witness};
use crate::number::{Field, Rational};
use std::collections::{BTreeSet, HashMap};
use std::fmt;

/// A point, in the names of the sheet, and the two sides of the claim there.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// The symbols that premises and claim speak of, with their values.
    pub point: Vec<(String, String)>,
    pub left: String,
    pub right: String,
    /// The terms of the two sides with their values.
    pub terms: Vec<(String, String)>,
}

impl fmt::Display for Counterexample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, value) in &self.point {
            write!(f, "{name}={value}; ")?;
        }
        write!(f, "left={}; right={}", self.left, self.right)
    }
}

/// The point of a witness, in the names of the sheet, and the two sides of the goal that fails there.
pub fn at(witness: &With<Witness>) -> Option<Counterexample> {
    let mut statement = witness.statement.clone();
    let witness = &witness.evidence;
    let solved: HashMap<Symbol, Term> = witness.solved.iter().copied().collect();
    let sample: HashMap<Symbol, Term> = witness.sample.iter().copied().collect();
    let value = |term: Term, statement: &mut Statement| {
        let mut term = statement.written_out(term);
        for _ in 0..4 {
            term = statement.with_functions(term, &witness.functions);
            term = statement.terms_mut().rewrite(term, &mut |_, node| match node {
                Node::Symbol(symbol) => solved.get(symbol).copied(),
                Node::Value(function, order, at) => {
                    let found = witness
                        .table
                        .iter()
                        .find(|(f, n, time, _)| (f, n, time) == (function, order, at));
                    found.map(|(.., value)| *value)
                }
                _ => None,
            });
        }
        let term = statement.terms_mut().rewrite(term, &mut |_, node| match node {
            Node::Symbol(symbol) => sample.get(symbol).copied(),
            _ => None,
        });
        simplified(statement.terms_mut(), term)
    };
    // what the claim and its premises speak of
    let mut spoken: BTreeSet<Symbol> = BTreeSet::new();
    let givens = statement.givens().iter();
    let written: Vec<Term> = givens
        .filter(|given| !given.label.starts_with('['))
        .map(|given| given.term)
        .chain(statement.goal().iter().map(|(_, term)| *term))
        .collect();
    for term in written {
        let whole = statement.written_out(term);
        for inner in statement
            .terms()
            .inside(term)
            .into_iter()
            .chain(statement.terms().inside(whole))
        {
            if let Node::Symbol(symbol) = statement.terms().node(inner) {
                spoken.insert(*symbol);
            }
        }
    }
    let order = |symbol: &Symbol, statement: &Statement| match statement.quantity(*symbol) {
        Some(Quantity::Parameter(_) | Quantity::Local { .. }) => Some(0),
        Some(Quantity::Time { .. } | Quantity::Running) => Some(1),
        Some(Quantity::State { .. } | Quantity::Absolute { .. }) => Some(2),
        Some(Quantity::Partial { .. } | Quantity::Invariant { .. }) => Some(3),
        Some(Quantity::Fresh(_)) | None => None,
    };
    let mut symbols: Vec<(i32, Symbol)> = spoken
        .into_iter()
        .filter_map(|symbol| Some((order(&symbol, &statement)?, symbol)))
        .collect();
    symbols.sort();
    let mut point = Vec::new();
    for (_, symbol) in symbols {
        let term = statement.terms_mut().symbol(symbol);
        let found = value(term, &mut statement);
        if statement.terms().is_closed(found) {
            point.push((
                statement.terms().symbol_name(symbol).to_string(),
                tex(statement.terms(), found),
            ));
        }
    }
    for (function, order, time, _) in &witness.table {
        let named = statement.value(*function, *order, *time);
        let name = tex(statement.terms(), named);
        let found = value(named, &mut statement);
        point.push((name, tex(statement.terms(), found)));
    }
    for (function, time, term) in &witness.functions {
        let name = format!(
            "{}({})",
            statement.terms().function_name(*function),
            statement.terms().symbol_name(*time)
        );
        let found = value(*term, &mut statement);
        point.push((name, tex(statement.terms(), found)));
    }
    let goals = statement.goal().to_vec();
    for (property, goal) in goals {
        // a goal is the difference of its sides
        let (first, second) = match statement.terms().node(goal).clone() {
            Node::Sum(parts) => match parts.as_slice() {
                [first, second] => (*first, negated(&mut statement, *second)),
                _ => (goal, statement.terms_mut().integer(0)),
            },
            _ => (goal, statement.terms_mut().integer(0)),
        };
        let (left, right) = (value(first, &mut statement), value(second, &mut statement));
        if property == Property::Zero && left == right {
            continue;
        }
        let mut terms = Vec::new();
        for side in [first, second] {
            let side = statement.written_out(side);
            if let Node::Sum(parts) = statement.terms().node(side).clone() {
                for part in parts {
                    let found = value(part, &mut statement);
                    terms.push((tex(statement.terms(), part), tex(statement.terms(), found)));
                }
            }
        }
        return Some(Counterexample {
            point,
            left: tex(statement.terms(), left),
            right: tex(statement.terms(), right),
            terms,
        });
    }
    None
}

/// `x` of `-x`, as goals are written.
fn negated(statement: &mut Statement, term: Term) -> Term {
    if let Node::Product(parts) = statement.terms().node(term).clone()
        && let [minus, of] = parts.as_slice()
        && *statement.terms().node(*minus) == Node::Number(<Rational as Field>::from_integer(-1))
    {
        return *of;
    }
    statement.terms_mut().negative(term)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_counterexample_is_one_line() {
        let text = |a: &str, b: &str| (a.to_string(), b.to_string());
        let counterexample = Counterexample {
            point: vec![text("r_B", "1/2"), text("T", "2")],
            left: "2".to_string(),
            right: "3".to_string(),
            terms: Vec::new(),
        };
        assert_eq!(counterexample.to_string(), "r_B=1/2; T=2; left=2; right=3");
    }
}
