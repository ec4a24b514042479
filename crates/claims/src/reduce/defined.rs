//! What must hold for a formula to have a value.

use super::super::premise::Statements;
use super::build::{integer, plain, related};
use super::derivative::mentions;
use super::factorial::{DOUBLE_FACTORIAL, FACTORIAL};
use numbers::{Field, Rational};
use texmath::{Condition, Elementary, Equation, Name, Operation, Relation, Symbols, Tree, number_of};

/// The conditions, together sufficient, under which a tree of real numbers has a value.
pub(super) fn conditions(tree: &Tree, symbols: &Symbols) -> Result<Vec<Equation>, String> {
    conditions_beside(tree, symbols, &|_| false)
}

/// The same where functions that pass the test have a value at each number.
pub(super) fn conditions_beside(
    tree: &Tree,
    symbols: &Symbols,
    is_smooth: &dyn Fn(&Name) -> bool,
) -> Result<Vec<Equation>, String> {
    let mut found = Vec::new();
    collect(tree, symbols, is_smooth, &mut found)?;
    found.dedup();
    Ok(found)
}

/// That a tree is not 0: none of its factors is.
fn nonzero(tree: &Tree, found: &mut Vec<Equation>) {
    match tree {
        Tree::Product(factors) => factors.iter().for_each(|factor| nonzero(factor, found)),
        Tree::Negate(inner) | Tree::Power(inner, 1.., _) => nonzero(inner, found),
        Tree::Number(value) if *value != Rational::from_integer(0) => {}
        tree => found.push(related(tree.clone(), Relation::NotEqual, integer(0))),
    }
}

fn collect(
    tree: &Tree,
    symbols: &Symbols,
    is_smooth: &dyn Fn(&Name) -> bool,
    found: &mut Vec<Equation>,
) -> Result<(), String> {
    let zero = || integer(0);
    match tree {
        Tree::Number(_) | Tree::Symbol(..) => {}
        Tree::Sum(parts) | Tree::Product(parts) => {
            for part in parts {
                collect(part, symbols, is_smooth, found)?;
            }
        }
        Tree::Negate(inner) => collect(inner, symbols, is_smooth, found)?,
        Tree::Quotient(above, below, _) => {
            collect(above, symbols, is_smooth, found)?;
            collect(below, symbols, is_smooth, found)?;
            nonzero(below, found);
        }
        Tree::Power(base, exponent, _) => {
            collect(base, symbols, is_smooth, found)?;
            if *exponent < 0 {
                nonzero(base, found);
            }
        }
        Tree::Root(radicand, index, _) => {
            collect(radicand, symbols, is_smooth, found)?;
            if index % 2 == 0 {
                found.push(related((**radicand).clone(), Relation::GreaterOrEqual, zero()));
            }
        }
        Tree::RealPower(base, exponent, _) => {
            collect(base, symbols, is_smooth, found)?;
            collect(exponent, symbols, is_smooth, found)?;
            let euler = plain("e");
            let is_positive = match &**base {
                Tree::Number(value) => *value > Rational::from_integer(0),
                Tree::Symbol(name, _) => (*name == euler && !symbols.declares(&euler)) || symbols.is_positive(name),
                _ => false,
            };
            let is_whole = super::factorial::is_integer(exponent, symbols);
            let is_nonzero = match &**base {
                Tree::Symbol(name, _) => symbols.is_nonzero(name),
                base => number_of(base).is_some_and(|value| value != Rational::from_integer(0)),
            };
            if is_whole && !is_positive && !is_nonzero {
                found.push(related((**exponent).clone(), Relation::GreaterOrEqual, zero()));
            } else if !is_whole && !is_positive {
                found.push(related((**base).clone(), Relation::Greater, zero()));
            }
        }
        Tree::Call(name, argument, _) => {
            collect(argument, symbols, is_smooth, found)?;
            match (name.base.as_str(), Elementary::named(name)) {
                (FACTORIAL | DOUBLE_FACTORIAL, _) => {
                    found.push(related((**argument).clone(), Relation::GreaterOrEqual, zero()));
                }
                (_, Some(function)) if !function.is_part() => found.extend(function.domain(argument)),
                _ if is_smooth(name) => {}
                _ => return Err(format!("where `{name}` has a value is not known")),
            }
        }
        // of integers it always has a value
        Tree::Operation(operation, _) => match &**operation {
            Operation::Binomial(of, chosen) if super::factorial::is_integer(chosen, symbols) => {
                collect(of, symbols, is_smooth, found)?;
            }
            _ => return Err(format!("where `{tree}` has a value is not known")),
        },
        _ => return Err(format!("where `{tree}` has a value is not known")),
    }
    Ok(())
}

/// The statements with what holds wherever their claims and conditions have a value assumed. A way of an equivalence is to be
/// shown to have a value, so that only conditions are taken to have one.
pub(super) fn with_domain(statements: &Statements, symbols: &Symbols) -> Statements {
    let mut out = statements.clone();
    let is_complex = |tree: &Tree| symbols.may_be_complex(tree);
    if super::trees(statements).into_iter().any(is_complex) {
        return out;
    }
    let mut found = Vec::new();
    let claims = statements.claims.iter().filter(|_| !statements.is_way);
    let claimed = claims.flat_map(|claim| [&claim.left, &claim.right]);
    for side in claimed.chain(statements.assume.iter().flat_map(Condition::sides)) {
        necessary(side, &mut found);
    }
    for condition in found.into_iter().map(Condition::Relation) {
        if !out.assume.contains(&condition) {
            out.assume.push(condition);
        }
    }
    out
}

/// Conditions that hold wherever a tree has a value. Of an integral they are those of its limits, and those of what is
/// integrated that do not move with its letter.
pub(super) fn necessary(tree: &Tree, found: &mut Vec<Equation>) {
    match tree {
        Tree::Operation(operation, _) => {
            if let Operation::Integral { of, by, limits } = &**operation {
                limits
                    .iter()
                    .flat_map(|(low, high)| [low, high])
                    .for_each(|limit| necessary(limit, found));
                let mut within = Vec::new();
                necessary(of, &mut within);
                let is_free = |condition: &Equation| !mentions(&condition.left, by) && !mentions(&condition.right, by);
                found.extend(within.into_iter().filter(is_free));
            }
            return;
        }
        Tree::Quotient(_, below, _) => nonzero(below, found),
        Tree::Power(base, ..=-1, _) => nonzero(base, found),
        Tree::Root(radicand, index, _) if index % 2 == 0 => {
            found.push(related((**radicand).clone(), Relation::GreaterOrEqual, integer(0)));
        }
        Tree::Call(name, argument, _) => {
            let function = Elementary::named(name).filter(|function| !function.is_part());
            found.extend(function.into_iter().flat_map(|function| function.domain(argument)));
        }
        _ => {}
    }
    tree.find_below(&mut |part| {
        necessary(part, found);
        None::<()>
    });
}
