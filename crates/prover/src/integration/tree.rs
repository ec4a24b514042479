//! Trees built with the least that is needed, and their values as machine numbers.

use numbers::{Field, Rational};
use texmath::{At, Elementary, Name, Operation, Tree};

pub(crate) fn integer(value: i64) -> Tree {
    number(&Rational::from_integer(value))
}

pub(crate) fn number(value: &Rational) -> Tree {
    let zero = Rational::from_integer(0);
    match *value < zero {
        true => Tree::Negate(Box::new(Tree::Number(zero - value.clone()))),
        false => Tree::Number(value.clone()),
    }
}

pub(crate) fn symbol(name: &Name) -> Tree {
    Tree::Symbol(name.clone(), At::default())
}

fn is_number(tree: &Tree, value: i64) -> bool {
    matches!(tree, Tree::Number(number) if *number == Rational::from_integer(value))
}

pub(crate) fn sum(terms: Vec<Tree>) -> Tree {
    let mut terms: Vec<Tree> = terms.into_iter().filter(|term| !is_number(term, 0)).collect();
    match terms.len() {
        0 => integer(0),
        1 => terms.remove(0),
        _ => Tree::Sum(terms),
    }
}

/// The product, with the signs of the factors before it.
pub(crate) fn product(factors: Vec<Tree>) -> Tree {
    if factors.iter().any(|factor| is_number(factor, 0)) {
        return integer(0);
    }
    let (mut plain, mut is_negative) = (Vec::new(), false);
    for factor in factors {
        let factor = match factor {
            Tree::Negate(inner) => {
                is_negative = !is_negative;
                *inner
            }
            factor => factor,
        };
        match factor {
            Tree::Product(inner) => plain.extend(inner),
            factor if is_number(&factor, 1) => {}
            factor => plain.push(factor),
        }
    }
    let whole = match plain.len() {
        0 => integer(1),
        1 => plain.remove(0),
        _ => Tree::Product(plain),
    };
    if is_negative { negative(whole) } else { whole }
}

pub(crate) fn negative(tree: Tree) -> Tree {
    match tree {
        Tree::Negate(inner) => *inner,
        tree if is_number(&tree, 0) => tree,
        tree => Tree::Negate(Box::new(tree)),
    }
}

pub(crate) fn quotient(above: Tree, below: Tree) -> Tree {
    match is_number(&above, 0) || is_number(&below, 1) {
        true => above,
        false => Tree::Quotient(Box::new(above), Box::new(below), At::default()),
    }
}

pub(crate) fn power(base: Tree, exponent: u32) -> Tree {
    match exponent {
        0 => integer(1),
        1 => base,
        _ => Tree::Power(
            Box::new(base),
            i32::try_from(exponent).unwrap_or(i32::MAX),
            At::default(),
        ),
    }
}

pub(crate) fn real_power(base: Tree, exponent: Tree) -> Tree {
    Tree::RealPower(Box::new(base), Box::new(exponent), At::default())
}

pub(crate) fn root(radicand: Tree, index: u32) -> Tree {
    match is_number(&radicand, 1) || is_number(&radicand, 0) {
        true => radicand,
        false => Tree::Root(Box::new(radicand), index, At::default()),
    }
}

/// The square root of a positive number, a number where it is one.
pub(crate) fn square_root(size: &Rational) -> Tree {
    let (above, below) = size.0.clone().into_parts();
    let parts = [above.to_string(), below.to_string()].map(|part| part.parse::<i64>().ok());
    let exact = parts.map(|part| {
        let part = part.filter(|part| *part < 1 << 50)?;
        let near = (part as f64).sqrt().round() as i64;
        (near * near == part).then_some(near)
    });
    match exact {
        [Some(above), Some(below)] => Rational::new(above, below).map_or_else(|| integer(1), |root| number(&root)),
        _ => root(number(size), 2),
    }
}

pub(crate) fn call(function: &str, argument: Tree) -> Tree {
    Tree::Call(Name::plain(function), Box::new(argument), At::default())
}

/// The value of a tree, with those of the letters; `None` where it holds what has no plain value.
pub(crate) fn value(tree: &Tree, letters: &dyn Fn(&Name) -> f64) -> Option<f64> {
    let of = |tree: &Tree| value(tree, letters);
    Some(match tree {
        Tree::Number(number) => number.0.to_f64().value(),
        Tree::Symbol(name, _) => letters(name),
        Tree::Negate(inner) => -of(inner)?,
        Tree::Sum(terms) => terms.iter().map(of).sum::<Option<f64>>()?,
        Tree::Product(factors) => factors.iter().map(of).product::<Option<f64>>()?,
        Tree::Quotient(above, below, _) => of(above)? / of(below)?,
        Tree::Power(base, exponent, _) => of(base)?.powi(*exponent),
        Tree::RealPower(base, exponent, _) => of(base)?.powf(of(exponent)?),
        Tree::Root(radicand, index, _) => {
            let radicand = of(radicand)?;
            match (*index, radicand < 0.0) {
                (2, _) => radicand.sqrt(),
                (odd, true) if odd % 2 == 1 => -(-radicand).powf(1.0 / f64::from(odd)),
                (index, _) => radicand.powf(1.0 / f64::from(index)),
            }
        }
        Tree::Call(name, argument, _) => match Elementary::named(name) {
            Some(function) => (function.real)(of(argument)?),
            // an unknown function: any smooth one serves, but its derivatives are not told from it
            None => return None,
        },
        Tree::Operation(operation, _) if matches!(**operation, Operation::Infinity) => f64::INFINITY,
        _ => return None,
    })
}
