//! Bound letters under names of their own, so that what is said of a free letter of the same name is not taken to be said of them.
//!
//! The letter of a limit keeps what is said of it where it can tend to its point so: in `\lim_{x \to 0} \sqrt{x}` an x that is
//! positive tends to 0 from above.

use super::super::premise::Statements;
use super::build::infinity;
use super::instances::relation_holds;
use super::{Rule, fresh_like, rewritten, stands_in_symbols, trees};
use numbers::{Field, Rational};
use std::cell::RefCell;
use texmath::{
    Condition, Equation, Meaning, Name, Operation, Relation, Symbols, Tree, any, mapped, number_of, rewrite,
    rewrite_equation,
};

/// The letter of a limit is looked at 1/FAR from its point, or this far out.
const FAR: i64 = 1_000_000;

/// Returns the statements with each bound letter renamed of which something is declared, assumed or written elsewhere, and the
/// symbols with the new names. A letter that is an integer stays one.
pub(super) fn apart(statements: &Statements, symbols: &Symbols) -> (Statements, Symbols) {
    let known = RefCell::new(symbols.clone());
    let all = trees(statements);
    let is_said = |name: &Name| {
        let is_limited = symbols.is_positive(name) || symbols.is_nonnegative(name) || symbols.is_at_most_one(name);
        is_limited
            || symbols.is_nonzero(name)
            || symbols.is_generic(name)
            || stands_in_symbols(symbols, name)
            || all.iter().any(|tree| tree.has_free(name))
    };
    let out = rewritten(statements, Rule::Definitions, &|tree| {
        renamed(tree, &|operation| {
            let letter =
                binds(operation).filter(|letter| is_said(letter) && !tends_as_said(operation, statements, symbols))?;
            let own = is_named_alone(operation, letter, symbols).then(|| {
                let mut known = known.borrow_mut();
                let own = fresh_like(statements, &known, letter.clone());
                known.let_be_parameter(&own, false);
                if symbols.is_integer(letter) {
                    known.declare(own.clone(), Meaning::Integer);
                }
                own
            })?;
            Some(with_letter(operation, letter, &own))
        })
    });
    (out, known.into_inner())
}

/// The letter that an operation binds for good: not one by which is differentiated or integrated where it stands.
fn binds(operation: &Operation) -> Option<&Name> {
    match operation {
        Operation::Derivative { by, at, .. } => (*at != Tree::Symbol(by.clone(), Default::default())).then_some(by),
        Operation::Integral { by, limits, .. } => limits.as_ref().map(|_| by),
        operation => operation.letter(),
    }
}

/// Returns true for a limit that is approached, from one side at least, where all holds that is declared or assumed of its letter,
/// which is something.
fn tends_as_said(operation: &Operation, statements: &Statements, symbols: &Symbols) -> bool {
    let Operation::Limit { by, to, .. } = operation else {
        return false;
    };
    let (to, sides): (&Tree, &[i64]) = match to {
        Tree::Operation(inner, _) => match &**inner {
            Operation::OneSided(to, is_above) => (to, if *is_above { &[1] } else { &[-1] }),
            _ => (to, &[1]),
        },
        to => (to, &[1, -1]),
    };
    let near = |side: i64| match (infinity(to), number_of(to)) {
        (Some(is_above), _) => Some(Rational::from_integer(if is_above { FAR } else { -FAR })),
        (None, Some(to)) => Some(to + Rational::new(side, FAR)?),
        _ => None,
    };
    let about: Vec<&Condition> = statements
        .assume
        .iter()
        .filter(|own| own.sides().into_iter().any(|side| side.has_free(by)))
        .collect();
    let is_to_point = |own: &Equation| {
        let letter = super::build::symbol(by);
        [(&own.left, &own.right), (&own.right, &own.left)].contains(&(&letter, to))
    };
    let holds = |condition: &Condition, at: Option<&Rational>| match condition {
        Condition::Relation(own) if is_to_point(own) => own.relation != Relation::Equal,
        Condition::Relation(own) => at.is_some_and(|at| {
            let there = rewrite_equation(own, &|name| (name == by).then(|| Tree::Number(at.clone())));
            relation_holds(&there) == Some(true)
        }),
        Condition::Integer(_) => true,
    };
    let (zero, one) = (Rational::from_integer(0), Rational::from_integer(1));
    let is_declared = |at: Option<&Rational>| {
        let is_limited = symbols.is_positive(by) || symbols.is_nonnegative(by);
        at.map_or(!is_limited, |at| {
            (*at > zero || !is_limited) && (*at <= one || !symbols.is_at_most_one(by))
        })
    };
    let is_any =
        !about.is_empty() || symbols.is_positive(by) || symbols.is_nonnegative(by) || symbols.is_at_most_one(by);
    is_any
        && sides.iter().any(|side| {
            let at = near(*side);
            is_declared(at.as_ref()) && about.iter().all(|own| holds(own, at.as_ref()))
        })
}

/// Returns true if a letter stands nowhere in an operation but under its own name: as no index of others, and as no argument
/// that is left out.
fn is_named_alone(operation: &Operation, letter: &Name, symbols: &Symbols) -> bool {
    let is_running = symbols.running() == Some(letter);
    // `a_{k+1}`, `a_{ij}`
    let indexes = |name: &Name| {
        let mut words = name.subscript.split(|c: char| !c.is_alphabetic() && c != '\\');
        words.any(|word| word == letter.base || (word.len() == 2 && word.contains(&letter.base)))
    };
    let moves = |name: &Name| is_running && (symbols.is_function(name) || symbols.is_in_flight(name));
    let parts = operation.parts().into_iter().filter(|(_, is_bound)| *is_bound);
    let mut parts = parts.map(|(part, _)| part);
    let is_hidden = |node: &Tree| match node {
        Tree::Symbol(name, _) => indexes(name) || moves(name),
        Tree::Call(name, ..) => indexes(name),
        Tree::Partial { .. } | Tree::Invariant { .. } => true,
        _ => false,
    };
    !symbols.may_be_complex(&super::build::symbol(letter)) && !parts.any(|part| any(part, &mut |node| is_hidden(node)))
}

/// The tree with the operations replaced for which there is another one, from the outside in.
fn renamed(tree: &Tree, new: &dyn Fn(&Operation) -> Option<Operation>) -> Tree {
    mapped(tree, &|node| {
        let Tree::Operation(operation, at) = node else {
            return None;
        };
        let own = new(operation).unwrap_or_else(|| (**operation).clone());
        let own = own.map(&mut |part, _| renamed(part, new));
        Some(Tree::Operation(Box::new(own), *at))
    })
}

/// The operation with another letter in the place of the one that it binds.
fn with_letter(operation: &Operation, letter: &Name, own: &Name) -> Operation {
    let put_in = |name: &Name| (name == letter).then(|| super::build::symbol(own));
    let mut out = operation.map(&mut |part, is_bound| match is_bound {
        true => rewrite(part, &put_in),
        false => part.clone(),
    });
    match &mut out {
        Operation::Derivative { by, .. } | Operation::Integral { by, .. } | Operation::Limit { by, .. } => {
            *by = own.clone();
        }
        Operation::Series { index, .. } => *index = own.clone(),
        _ => {}
    }
    out
}
