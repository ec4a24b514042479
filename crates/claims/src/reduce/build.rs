//! Trees built with the least that is needed: nothing is simplified but zeros and ones.

use numbers::{Field, Rational};
use texmath::{At, Equation, Name, Operation, Relation, Series, Tree};

pub(super) fn integer(value: i64) -> Tree {
    match value < 0 {
        true => Tree::Negate(Box::new(Tree::Number(Rational::from_integer(-value)))),
        false => Tree::Number(Rational::from_integer(value)),
    }
}

pub(super) fn related(left: Tree, relation: Relation, right: Tree) -> Equation {
    Equation {
        relation,
        ..Equation::between(left, right)
    }
}

/// The term of a sum, its index, and where this starts and ends.
pub(super) fn summand(node: &Tree) -> Option<(&Tree, &Name, [&Tree; 2])> {
    let Tree::Operation(operation, _) = node else {
        return None;
    };
    match &**operation {
        Operation::Series {
            kind: Series::Sum,
            of,
            index,
            from,
            to,
        } => Some((of, index, [from, to])),
        _ => None,
    }
}

pub(super) fn symbol(name: &Name) -> Tree {
    Tree::Symbol(name.clone(), At::default())
}

/// The constant `e`, or another single letter or command.
pub(super) fn plain(base: &str) -> Name {
    Name {
        base: base.to_owned(),
        ..Name::default()
    }
}

fn is_number(tree: &Tree, value: i64) -> bool {
    matches!(tree, Tree::Number(number) if *number == Rational::from_integer(value))
}

pub(super) fn is_zero(tree: &Tree) -> bool {
    is_number(tree, 0)
}

/// Whether a tree is infinity, and whether it is that above all numbers.
pub(crate) fn infinity(tree: &Tree) -> Option<bool> {
    match tree {
        Tree::Operation(operation, _) => matches!(**operation, Operation::Infinity).then_some(true),
        Tree::Negate(inner) => infinity(inner).map(|is_above| !is_above),
        _ => None,
    }
}

pub(super) fn sum(terms: Vec<Tree>) -> Tree {
    let mut terms: Vec<Tree> = terms.into_iter().filter(|term| !is_zero(term)).collect();
    match terms.len() {
        0 => integer(0),
        1 => terms.remove(0),
        _ => Tree::Sum(terms),
    }
}

pub(super) fn product(factors: Vec<Tree>) -> Tree {
    if factors.iter().any(is_zero) {
        return integer(0);
    }
    let mut factors: Vec<Tree> = factors.into_iter().filter(|factor| !is_number(factor, 1)).collect();
    match factors.len() {
        0 => integer(1),
        1 => factors.remove(0),
        _ => Tree::Product(factors),
    }
}

pub(super) fn negative(tree: Tree) -> Tree {
    match tree {
        tree if is_zero(&tree) => tree,
        Tree::Negate(inner) => *inner,
        tree => Tree::Negate(Box::new(tree)),
    }
}

pub(super) fn difference(left: Tree, right: Tree) -> Tree {
    sum(vec![left, negative(right)])
}

pub(super) fn quotient(above: Tree, below: Tree) -> Tree {
    match is_zero(&above) || is_number(&below, 1) {
        true => above,
        false => Tree::Quotient(Box::new(above), Box::new(below), At::default()),
    }
}

pub(super) fn power(base: Tree, exponent: i32) -> Tree {
    match exponent {
        0 => integer(1),
        1 => base,
        _ => Tree::Power(Box::new(base), exponent, At::default()),
    }
}

pub(super) fn real_power(base: Tree, exponent: Tree) -> Tree {
    Tree::RealPower(Box::new(base), Box::new(exponent), At::default())
}

pub(super) fn root(radicand: Tree) -> Tree {
    Tree::Root(Box::new(radicand), 2, At::default())
}

pub(super) fn call(function: &str, argument: Tree) -> Tree {
    Tree::Call(plain(function), Box::new(argument), At::default())
}
