//! Bound letters under names of their own, so that what is said of a free letter of the same name is not taken to be said of them.

use super::super::premise::Statements;
use super::{Rule, fresh_like, rewritten, stands_in_symbols, trees};
use std::cell::RefCell;
use texmath::{Meaning, Name, Operation, Symbols, Tree, any, mapped, rewrite};

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
            let letter = binds(operation).filter(|letter| is_said(letter))?;
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
