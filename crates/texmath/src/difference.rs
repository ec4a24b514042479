//! What differs between two formulas.

use super::{Equation, Tree};
use numbers::{Field, Rational};

/// The smallest parts of two trees that differ: those of the one, and those of the other. A term or factor that only one
/// of them has is a part of it.
pub fn difference<'a>(one: &'a Tree, other: &'a Tree) -> (Vec<&'a Tree>, Vec<&'a Tree>) {
    let (mut own, mut others) = (Vec::new(), Vec::new());
    compare(one, other, &mut own, &mut others);
    (own, others)
}

/// The same of both sides of two equations.
pub fn difference_of<'a>(one: &'a Equation, other: &'a Equation) -> (Vec<&'a Tree>, Vec<&'a Tree>) {
    let (mut own, mut others) = difference(&one.left, &other.left);
    compare(&one.right, &other.right, &mut own, &mut others);
    (own, others)
}

fn compare<'a>(one: &'a Tree, other: &'a Tree, own: &mut Vec<&'a Tree>, others: &mut Vec<&'a Tree>) {
    if one == other {
        return;
    }
    let mut pairs: Vec<(&Tree, &Tree)> = Vec::new();
    match (one, other) {
        (Tree::Sum(left), Tree::Sum(right)) | (Tree::Product(left), Tree::Product(right)) => {
            let (left, right) = unmatched(left, right);
            if left.len() == right.len() {
                pairs.extend(left.into_iter().zip(right));
            } else {
                own.extend(left);
                others.extend(right);
            }
        }
        _ if is_alike(one, other) => pairs.extend(parts(one).into_iter().zip(parts(other))),
        _ => {
            own.push(one);
            others.push(other);
        }
    }
    for (one, other) in pairs {
        compare(one, other, own, others);
    }
}

/// What each list has that the other has not, in order.
fn unmatched<'a>(one: &'a [Tree], other: &'a [Tree]) -> (Vec<&'a Tree>, Vec<&'a Tree>) {
    let mut others: Vec<&Tree> = other.iter().collect();
    let mut own = Vec::new();
    for tree in one {
        match others.iter().position(|other| *other == tree) {
            Some(place) => drop(others.remove(place)),
            None => own.push(tree),
        }
    }
    (own, others)
}

/// Whether two trees are the same but for the parts directly below them.
fn is_alike(one: &Tree, other: &Tree) -> bool {
    let emptied = |tree: &Tree| tree.map(&mut |_| Tree::Number(Rational::from_ratio(0, 1)));
    emptied(one) == emptied(other) && parts(one).len() == parts(other).len()
}

fn parts(tree: &Tree) -> Vec<&Tree> {
    match tree {
        Tree::Number(_) | Tree::Symbol(..) | Tree::Partial { .. } | Tree::Invariant { .. } => Vec::new(),
        Tree::Call(_, part, _)
        | Tree::Negate(part)
        | Tree::Power(part, ..)
        | Tree::Root(part, ..)
        | Tree::PlusMinus(part)
        | Tree::MinusPlus(part) => vec![part],
        Tree::Sum(parts) | Tree::Product(parts) => parts.iter().collect(),
        Tree::Quotient(above, below, _) | Tree::RealPower(above, below, _) => vec![above, below],
        Tree::Operation(operation, _) => operation.parts().into_iter().map(|(part, _)| part).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Names, read_expression};
    use super::*;

    #[test]
    fn the_smallest_parts_are_found_and_what_is_equal_differs_in_none() {
        for (one, other, own, others) in [
            ("a + b c", "a + b c", vec![], vec![]),
            ("a + b c", "a + b d", vec!["c"], vec!["d"]),
            ("a - b", "a + b", vec!["-b"], vec!["b"]),
            ("a + b", "a + b + c d", vec![], vec!["c d"]),
            (r"\frac{a}{1 - r_B}", r"\frac{a}{1 - r_T}", vec!["r_B"], vec!["r_T"]),
            ("x^2 y", "x^3 y", vec!["x^2"], vec!["x^3"]),
            (r"\sqrt{x}", "x", vec![r"\sqrt{x}"], vec!["x"]),
            ("(a + b) c", "a + b c", vec!["(a + b) c"], vec!["a + b c"]),
            (r"\sin(x)", r"\cos(x)", vec![r"\sin(x)"], vec![r"\cos(x)"]),
        ] {
            let read = |tex: &str| read_expression(tex, &Names::default()).unwrap();
            let (one, other) = (read(one), read(other));
            let found = difference(&one, &other);
            let shown = |trees: Vec<&Tree>| trees.iter().map(ToString::to_string).collect::<Vec<_>>();
            assert_eq!(
                (shown(found.0), shown(found.1)),
                (
                    own.iter().map(ToString::to_string).collect(),
                    others.iter().map(ToString::to_string).collect()
                )
            );
        }
    }
}
