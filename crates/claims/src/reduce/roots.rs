//! Roots whose index is a symbol: `\sqrt[n]{x}` is `x^{1/n}` where x is not negative, which is to be shown; whether there is
//! a root of a negative number depends on the index.

use super::super::premise::Statements;
use super::build::{integer, quotient, real_power};
use super::derivative::mentions;
use super::{Goal, Rule, rewritten, trees};
use numbers::{Field, Rational};
use texmath::{Condition, Equation, Name, Operation, Relation, Symbols, Tree, any, mapped};

fn parts(node: &Tree) -> Option<(&Tree, &Tree)> {
    match node {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Root { of, index } => Some((of, index)),
            _ => None,
        },
        _ => None,
    }
}

/// The root of a power of a positive number has the quotient of exponents, if these are real (DLMF 4.8).
fn root_of(of: Tree, index: Tree, symbols: &Symbols) -> Tree {
    let is_positive = |base: &Tree| match base {
        Tree::Symbol(name, _) => symbols.is_positive(name),
        Tree::Number(value) => *value > Rational::from_integer(0),
        _ => false,
    };
    let is_real = |exponent: &Tree| !symbols.may_be_complex(exponent);
    match of {
        Tree::RealPower(base, exponent, _) if is_positive(&base) && is_real(&exponent) && is_real(&index) => {
            real_power(*base, quotient(*exponent, index))
        }
        Tree::Power(base, exponent, _) if is_positive(&base) && is_real(&index) => {
            real_power(*base, quotient(integer(i64::from(exponent)), index))
        }
        of => real_power(of, quotient(integer(1), index)),
    }
}

fn as_power(tree: &Tree, symbols: &Symbols) -> Tree {
    let written = |tree: &Tree| as_power(tree, symbols);
    mapped(tree, &|node| {
        let (of, index) = parts(node)?;
        Some(root_of(written(of), written(index), symbols))
    })
}

/// Collects what stands under such roots, but for what a limit moves: that it is positive is shown there. Tells if a sum or an
/// integral moves any.
fn collect(tree: &Tree, moving: &[&Name], radicands: &mut Vec<Tree>, is_bound: &mut bool) {
    if let Some((of, _)) = parts(tree)
        && !moving.iter().any(|letter| mentions(of, letter))
        && !radicands.contains(of)
    {
        radicands.push(of.clone());
    }
    let Tree::Operation(operation, _) = tree else {
        tree.find_below(&mut |part| {
            collect(part, moving, radicands, is_bound);
            None::<()>
        });
        return;
    };
    let is_limit = matches!(**operation, Operation::Limit { .. });
    for (part, is_within) in operation.parts() {
        let letter = operation.letter().filter(|_| is_within);
        let moves = |node: &Tree| parts(node).is_some_and(|(of, _)| letter.is_some_and(|own| mentions(of, own)));
        *is_bound |= !is_limit && any(part, &mut |node| moves(node));
        let own: Vec<&Name> = moving.iter().copied().chain(letter).collect();
        collect(part, &own, radicands, is_bound);
    }
}

/// The statements with such roots as powers, and what must hold for these to be the same.
///
/// # Errors
/// The root of what a sum or an integral moves.
pub(super) fn as_powers(statements: &Statements, symbols: &Symbols) -> Result<(Statements, Vec<Goal>), String> {
    let (mut radicands, mut is_bound) = (Vec::new(), false);
    for tree in trees(statements) {
        collect(tree, &[], &mut radicands, &mut is_bound);
    }
    if is_bound {
        return Err("a root with a symbolic index of what a sum or an integral moves".to_owned());
    }
    let powers = rewritten(statements, Rule::RootPower, &|tree| as_power(tree, symbols));
    // what holds a root says that there is one, which is to be shown without it
    let is_plain = |tree: &Tree| !any(tree, &mut |node| matches!(node, Tree::Operation(..)));
    let is_condition = |condition: &Condition| condition.sides().into_iter().all(is_plain);
    let mut plain = statements.clone().by(Rule::RootPower);
    plain.assume.retain(is_condition);
    plain.premises.retain(|premise| {
        let sides = [&premise.equation.left, &premise.equation.right];
        sides.into_iter().all(is_plain) && premise.assume.iter().all(is_condition)
    });
    let lemma = |radicand: &Tree| {
        let mut alone = plain.clone();
        let claim = Equation {
            relation: Relation::GreaterOrEqual,
            ..Equation::between(as_power(radicand, symbols), integer(0))
        };
        let part = format!("{claim} under a root");
        alone.claims = vec![claim];
        Goal::of(&alone, symbols, part)
    };
    let lemmas = radicands.iter().map(lemma).collect();
    Ok((powers, lemmas))
}
