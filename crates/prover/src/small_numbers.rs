//! Points by evaluation alone: small numbers for all symbols that no premise defines, the others in turn.
//!
//! Complete for statements whose premises are chains of definitions, `x = ...` without x on the right, and inequalities;
//! nothing is solved or multiplied out, so that what is large to expand is refuted by its values.

use kernel::{Expansion, Node, Property, Quantity, Statement, Symbol, Term, With, Witness};
use numbers::{Field, Rational};
use std::collections::{BTreeMap, BTreeSet};

/// The values of the symbols in turn, as numerators and denominators: units have powers that stay small, fractions are near both ends of (-1, 1).
/// numbers of which one is far larger than the other are those of bounds that grow.
const VALUES: [&[(i64, i64)]; 9] = [
    &[(2, 1), (3, 1), (5, 1), (7, 1), (11, 1), (4, 1), (9, 1), (6, 1)],
    &[(1, 2), (1, 3), (2, 3), (3, 4), (1, 5), (4, 5), (5, 6)],
    &[(-1, 1), (1, 1), (2, 1), (-2, 1), (3, 1), (1, 2)],
    &[(1, 1), (2, 1), (-1, 1), (1, 2), (-3, 1)],
    &[(1, 1), (-1, 1)],
    &[(4, 5), (-3, 4), (1, 6), (-2, 3)],
    &[(-5, 6), (2, 5), (3, 4), (-1, 5)],
    &[(1000, 1), (6, 1), (500, 1), (7, 1)],
    &[(6, 1), (1000, 1), (7, 1), (500, 1)],
];
/// The most digits of a value; those of chains of squares double at each link.
const MOST_DIGITS: usize = 400;

/// Points at which the definitions among the premises hold.
pub fn points(statement: &Statement) -> Vec<With<Witness>> {
    let plain = statement.generic().is_empty() && statement.functions().is_empty();
    let laws = statement.givens().iter().any(|given| given.law.is_some());
    match plain && !laws && !statement.is_complex() {
        true => VALUES.iter().filter_map(|values| point(statement, values)).collect(),
        false => Vec::new(),
    }
}

fn point(statement: &Statement, values: &[(i64, i64)]) -> Option<With<Witness>> {
    let mut own = statement.clone();
    let mut open: Vec<(Symbol, Term)> = Vec::new();
    for given in statement
        .givens()
        .iter()
        .filter(|given| given.property == Property::Zero)
    {
        open.push(definition(&mut own, given.term)?);
    }
    let defined: BTreeSet<Symbol> = open.iter().map(|(symbol, _)| *symbol).collect();
    if defined.len() < open.len() {
        return None;
    }
    let mut known: BTreeMap<Symbol, Term> = BTreeMap::new();
    let mut next = values.iter().cycle();
    for (symbol, quantity) in (0_u32..).map(Symbol).zip(statement.quantities()) {
        if matches!(quantity, Quantity::Running | Quantity::Abbreviation { .. }) || defined.contains(&symbol) {
            continue;
        }
        let (above, below) = *next.next()?;
        let value = own.terms_mut().number(Rational::from_ratio(above, below));
        known.insert(symbol, value);
    }
    while !open.is_empty() {
        let ready = open.iter().position(|(_, right)| {
            let inside = own.terms().inside(*right);
            let missing =
                |inner: &Term| matches!(own.terms().node(*inner), Node::Symbol(symbol) if !known.contains_key(symbol));
            !inside.iter().any(missing)
        })?;
        let (symbol, right) = open.remove(ready);
        let value = own.terms_mut().rewrite(right, &mut |_, node| match node {
            Node::Symbol(symbol) => known.get(symbol).copied(),
            _ => None,
        });
        let quotient = Expansion::new(BTreeSet::new(), 10_000).of(own.terms(), value).ok()?;
        let value = quotient
            .numerator
            .as_constant()
            .filter(|_| quotient.divisors.is_empty())?;
        if value.0.numerator().to_string().len() + value.0.denominator().to_string().len() > MOST_DIGITS {
            return None;
        }
        let value = own.terms_mut().number(value);
        known.insert(symbol, value);
    }
    let evidence = Witness {
        sample: known.into_iter().collect(),
        ..Witness::default()
    };
    Some(With {
        statement: own,
        evidence,
    })
}

/// The symbol that a term which vanishes defines, and the term it is.
fn definition(statement: &mut Statement, term: Term) -> Option<(Symbol, Term)> {
    let Node::Sum(parts) = statement.terms().node(term).clone() else {
        return None;
    };
    let (first, rest) = parts.split_first()?;
    let Node::Symbol(symbol) = *statement.terms().node(*first) else {
        return None;
    };
    let rest = statement.terms_mut().sum(rest.to_vec());
    let right = statement.terms_mut().negative(rest);
    let right = statement.written_out(right);
    let is_free = !statement.terms().holds(right, symbol) && !statement.definitions().contains_key(&symbol);
    is_free.then_some((symbol, right))
}
