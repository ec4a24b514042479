//! Roots whose index is a symbol: `\sqrt[n]{x}` is `x^{1/n}` where x is not negative, which is to be shown; whether there is
//! a root of a negative number depends on the index.

use super::super::premise::Statements;
use super::build::{integer, quotient, real_power};
use super::derivative::mentions;
use super::{Goal, Rule, rewritten, trees};
use numbers::{Field, Rational};
use texmath::{Condition, Equation, Operation, Relation, Symbols, Tree, any, mapped};

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

/// The statements with such roots as powers, and what must hold for these to be the same.
///
/// # Errors
/// The root of what a sum, an integral or a limit moves.
pub(super) fn as_powers(statements: &Statements, symbols: &Symbols) -> Result<(Statements, Vec<Goal>), String> {
    let mut radicands: Vec<Tree> = Vec::new();
    let mut is_bound = false;
    for tree in trees(statements) {
        any(tree, &mut |node| {
            if let Some((of, _)) = parts(node)
                && !radicands.contains(of)
            {
                radicands.push(of.clone());
            }
            if let Tree::Operation(operation, _) = node
                && let Some(letter) = operation.letter()
            {
                let moves = |node: &Tree| parts(node).is_some_and(|(of, _)| mentions(of, letter));
                let mut bound = operation.parts().into_iter().filter(|(_, is_bound)| *is_bound);
                is_bound |= bound.any(|(part, _)| any(part, &mut |node| moves(node)));
            }
            false
        });
    }
    if is_bound {
        return Err("a root with a symbolic index of what a sum, an integral or a limit moves".to_owned());
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
