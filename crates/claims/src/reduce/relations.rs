//! Logarithms and values of inverse functions as multiples of others or of pi, where these relations are likely: each is a claim
//! of its own, and what is left holds fewer of them.

use super::super::premise::Statements;
use super::build::{integer, plain, product, sum, symbol};
use super::series::guess_at;
use super::{Rule, rewritten, trees};
use numbers::{Field, Rational};
use texmath::{Elementary, Equation, Symbols, Tree, any, mapped, nodes_of};

/// The most such values that are looked at, and how far a relation may be off.
const MOST: usize = 10;
const CLOSE: f64 = 1e-12;

/// The denominators of multiples of pi, and of multiples of other values.
const PARTS_OF_PI: i32 = 24;
const PARTS: i32 = 4;

/// The statements with such values by relations between them, and the relations.
pub(super) fn simplified(statements: &Statements, symbols: &Symbols) -> (Statements, Vec<Equation>) {
    let mut values: Vec<Tree> = Vec::new();
    for tree in trees(statements) {
        any(tree, &mut |node| {
            if is_transcendental(node, symbols) && !values.contains(node) {
                values.push(node.clone());
            }
            false
        });
    }
    let has_pi = !symbols.declares(&plain("\\pi"));
    if values.len() > MOST || !has_pi {
        return (statements.clone(), Vec::new());
    }
    values.sort_by_key(nodes_of);
    let (mut basis, mut found): (Vec<(Tree, f64)>, Vec<Equation>) = (Vec::new(), Vec::new());
    for tree in values {
        let Some(value) = guess_at(&tree, &|_| None).filter(|value| value.is_finite()) else {
            continue;
        };
        // that of a number is as simple as it gets
        let is_plain =
            matches!(&tree, Tree::Call(_, inner, _) if is_logarithm(&tree) && matches!(**inner, Tree::Number(_)));
        match relation(&tree, value, &basis).filter(|_| !is_plain) {
            Some(other) => found.push(Equation::between(tree, other)),
            None => basis.push((tree, value)),
        }
    }
    let out = rewritten(statements, Rule::ValueRelations, &|tree| {
        mapped(tree, &|node| {
            let known = found.iter().find(|relation| relation.left == *node);
            known.map(|relation| relation.right.clone())
        })
    });
    (out, found)
}

/// Returns true for a logarithm or a value of an inverse function without letters.
fn is_transcendental(node: &Tree, symbols: &Symbols) -> bool {
    let Tree::Call(name, inner, _) = node else {
        return false;
    };
    let is_free = |node: &Tree| match node {
        Tree::Symbol(name, _) => symbols.declares(name) || !texmath::is_constant(name),
        Tree::Operation(..) => true,
        _ => false,
    };
    let is_one = is_logarithm(node) || is_arc(node);
    !symbols.is_function(name) && is_one && !any(inner, &mut |node| is_free(node))
}

fn is_logarithm(node: &Tree) -> bool {
    matches!(node, Tree::Call(name, ..) if name.base == "\\ln")
}

fn is_arc(node: &Tree) -> bool {
    let is_one = |function: &Elementary| ["\\sin", "\\cos", "\\tan"].contains(&function.inverse_of.unwrap_or_default());
    matches!(node, Tree::Call(name, ..) if Elementary::named(name).is_some_and(is_one))
}

/// A small quotient of integers that a number is close to.
fn ratio(value: f64, parts: i32) -> Option<Rational> {
    let below = (1..=parts).find(|below| {
        let above = value * f64::from(*below);
        (above - above.round()).abs() < CLOSE * f64::from(parts) && above.abs() < 1e4
    })?;
    let above = (-10_000..=10_000_i32).find(|above| (value * f64::from(below) - f64::from(*above)).abs() < 0.5)?;
    Some(Rational::from_ratio(i64::from(above), i64::from(below)))
}

fn multiple(factor: &Rational, of: Tree) -> Tree {
    let zero = Rational::from_integer(0);
    let number = match *factor < zero {
        true => Tree::Negate(Box::new(Tree::Number(-factor.clone()))),
        false => Tree::Number(factor.clone()),
    };
    product(vec![number, of])
}

/// The multiples of two values whose sum is looked at as a third one, in halves.
const HALVES: i32 = 4;

/// A logarithm as the sum of multiples of two others.
fn of_two(value: f64, basis: &[(Tree, f64)]) -> Option<Tree> {
    let logarithms: Vec<&(Tree, f64)> = basis.iter().filter(|(other, _)| is_logarithm(other)).collect();
    let mut pairs = logarithms.iter().enumerate().flat_map(|(place, one)| {
        let others = logarithms.iter().take(place);
        others.map(move |other| (one, other))
    });
    pairs.find_map(|((one, first), (other, second))| {
        let halves = (-HALVES..=HALVES).filter(|halves| *halves != 0);
        let mut found = halves.filter_map(|halves| {
            let rest = ratio((value - 0.5 * f64::from(halves) * first) / second, 2)?;
            let factor = Rational::from_ratio(i64::from(halves), 2);
            let is_small = (-HALVES..=HALVES).any(|own| Rational::from_ratio(i64::from(own), 2) == rest);
            is_small.then(|| sum(vec![multiple(&factor, one.clone()), multiple(&rest, other.clone())]))
        });
        found.next()
    })
}

/// A value as a rational number, as a multiple of pi or of another value, as a multiple of pi more or less than another one, or as the
/// sum of multiples of two others.
fn relation(tree: &Tree, value: f64, basis: &[(Tree, f64)]) -> Option<Tree> {
    let pi = || symbol(&plain("\\pi"));
    let of_pi = |value: f64| ratio(value / std::f64::consts::PI, PARTS_OF_PI);
    if value.abs() < CLOSE {
        return Some(integer(0));
    }
    if is_arc(tree) {
        if let Some(factor) = of_pi(value) {
            return Some(multiple(&factor, pi()));
        }
        let arcs = basis.iter().filter(|(other, _)| is_arc(other));
        let mut found = arcs.flat_map(|(other, known)| {
            [1.0, -1.0].into_iter().filter_map(move |sign: f64| {
                let more = of_pi(value - sign * known)?;
                let factor = Rational::from_integer(if sign > 0.0 { 1 } else { -1 });
                Some(sum(vec![multiple(&factor, other.clone()), multiple(&more, pi())]))
            })
        });
        return found.next();
    }
    if let Some(number) = ratio(value, PARTS) {
        return Some(multiple(&number, integer(1)));
    }
    let logarithms = basis.iter().filter(|(other, _)| is_logarithm(other));
    let mut found = logarithms.filter_map(|(other, known)| {
        let factor = ratio(value / known, PARTS)?;
        Some(multiple(&factor, other.clone()))
    });
    found.next().or_else(|| of_two(value, basis))
}

#[cfg(test)]
mod tests {
    use super::*;
    use texmath::{Names, read_expression};

    #[test]
    fn relations_between_values_are_found() {
        let read = |tex: &str| read_expression(tex, &Names::default()).unwrap();
        let value = |tree: &Tree| guess_at(tree, &|_| None).unwrap();
        let basis = [r"\ln(1 + \sqrt{2})", r"\arctan 3", r"\ln 2"].map(|tex| (read(tex), value(&read(tex))));
        for (tex, expected) in [
            (r"\arctan(1 + \sqrt{2})", true),
            (r"\arctan \frac{1}{3}", true),
            (r"\ln(\sqrt{2} - 1)", true),
            (r"\ln \frac{2 + \sqrt{2}}{2 - \sqrt{2}}", true),
            (r"\arcsin 0", true),
            (r"\arctan 5", false),
            (r"\ln(2 + \sqrt{2})", true),
            (r"\ln(3 + \sqrt{2})", false),
            (r"\ln \sqrt{e}", true),
        ] {
            let tree = read(tex);
            let found = relation(&tree, value(&tree), &basis);
            assert_eq!(found.is_some(), expected, "{tex}");
            assert!(
                found.is_none_or(|found| (value(&found) - value(&tree)).abs() < 1e-12),
                "{tex}"
            );
        }
    }
}
