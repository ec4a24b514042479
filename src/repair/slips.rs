//! Counts the slips of the pen by which two formulas differ.

use super::path::parts;
use crate::number::{Field, Rational};
use crate::tex::{Equation, Name, Tree};

/// Returns how many signs, names, digits, exponents, functions and whole factors two equations differ in; nothing where they
/// differ in more: in a term, a bracket, a bar, or a number of which more than one digit is another.
pub fn slips(one: &Equation, other: &Equation) -> Option<usize> {
    (one.relation == other.relation).then_some(())?;
    Some(between(&one.left, &other.left)? + between(&one.right, &other.right)?)
}

fn between(one: &Tree, other: &Tree) -> Option<usize> {
    if one == other {
        return Some(0);
    }
    let plus_one = |one: &Tree, other: &Tree| between(one, other).map(|slips| slips + 1);
    match (one, other) {
        (Tree::Number(one), Tree::Number(other)) => {
            is_slip_of_digits(&one.0.to_string(), &other.0.to_string()).then_some(1)
        }
        (Tree::Symbol(..), Tree::Number(number)) | (Tree::Number(number), Tree::Symbol(..)) => {
            (!number.0.is_zero()).then_some(1)
        }
        (Tree::Symbol(..), Tree::Symbol(..)) => Some(1),
        (Tree::Power(one, own, _), Tree::Power(other, exponent, _)) if own != exponent => plus_one(one, other),
        // a bracket loses its power more seldom than a condition takes it
        (Tree::Power(of, ..), bare) | (bare, Tree::Power(of, ..)) if **of == *bare => {
            (!matches!(bare, Tree::Sum(_))).then_some(1)
        }
        (Tree::Call(one, of, _), Tree::Call(other, argument, _)) if one != other && of == argument => {
            (![one, other].into_iter().any(is_modulus)).then_some(1)
        }
        _ => match (shape(one) == shape(other)).then(|| (parts(one), parts(other))) {
            Some((one, other)) if !one.is_empty() => {
                one.iter().zip(&other).map(|(one, other)| between(one, other)).sum()
            }
            _ => by_sign_or_factor(one, other),
        },
    }
}

/// Counts the slips of formulas of which one alone has a minus, a whole factor or a whole divisor.
fn by_sign_or_factor(one: &Tree, other: &Tree) -> Option<usize> {
    let ways = [(one, other), (other, one)];
    ways.into_iter().find_map(|(whole, rest)| {
        bare(whole)
            .into_iter()
            .find_map(|bare| between(&bare, rest).map(|slips| slips + 1))
    })
}

/// Returns a formula without its minus, and without each of its factors and divisors that is a number.
fn bare(tree: &Tree) -> Vec<Tree> {
    let is_number = |tree: &&Tree| matches!(tree, Tree::Number(number) if !number.0.is_zero());
    match tree {
        Tree::Negate(of) => vec![(**of).clone()],
        Tree::Quotient(above, below, _) if is_number(&&**below) => vec![(**above).clone()],
        Tree::Product(factors) => {
            let numbers = factors.iter().enumerate().filter(|(_, factor)| is_number(factor));
            let without = |at: usize| {
                let mut rest = factors.clone();
                rest.remove(at);
                match rest.len() {
                    1 => rest.remove(0),
                    _ => Tree::Product(rest),
                }
            };
            numbers.map(|(at, _)| without(at)).collect()
        }
        _ => Vec::new(),
    }
}

/// Returns a node with nothing in its parts.
fn shape(tree: &Tree) -> Tree {
    tree.map(&mut |_| Tree::Number(Rational::from_integer(0)))
}

fn is_modulus(name: &Name) -> bool {
    name.base == r"\abs"
}

/// Returns true if numbers differ in one digit, or in the order of two beside each other, or have at most two digits.
fn is_slip_of_digits(one: &str, other: &str) -> bool {
    if one == "0" || other == "0" {
        return false;
    }
    let differ: Vec<usize> = (one.bytes().zip(other.bytes()).enumerate())
        .filter(|(_, (one, other))| one != other)
        .map(|(at, _)| at)
        .collect();
    let are_swapped = |first: usize, last: usize| {
        let [one, other] = [one.as_bytes(), other.as_bytes()];
        last == first + 1 && one.get(first) == other.get(last) && one.get(last) == other.get(first)
    };
    let is_short = |text: &str| text.len() < 3;
    (is_short(one) && is_short(other))
        || (one.len() == other.len()
            && match differ.as_slice() {
                [_] => true,
                [first, last] => are_swapped(*first, *last),
                _ => false,
            })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tex::{Names, read};

    fn count(one: &str, other: &str) -> Option<usize> {
        let read = |tex: &str| read(tex, &Names::default()).expect("an equation").remove(0);
        slips(&read(one), &read(other))
    }

    #[test]
    fn signs_names_digits_exponents_functions_and_whole_factors_are_slips() {
        for (one, other, wanted) in [
            ("x = a + b", "x = a + b", Some(0)),
            ("x = a + b", "x = a - b", Some(1)),
            ("x = a + b", "x = a + c", Some(1)),
            ("x = 2 a b^2", "x = 3 a b^3", Some(2)),
            ("x = a b", "x = 2 a b", Some(1)),
            ("x = a", "x = 2 a", Some(1)),
            (r"x = \frac{a}{2}", "x = a", Some(1)),
            (r"x = \frac{a}{b}", r"x = \frac{a}{2 b}", Some(1)),
            (r"x = \sin a", r"x = \cos a", Some(1)),
            ("x = 1081", "x = 1801", Some(1)),
            ("x = 1100", "x = 1081", None),
            ("x = a + b", "x = a", None),
            ("x = a b", "x = a", None),
            ("x = a + 1", "x = a + 0", None),
            ("x = (a + b) c", "x = a + b c", None),
            ("x = a + b", "x = (a + b)^2", None),
            (r"x = a", r"x = \left|a\right|", None),
            ("x = a", r"x \le a", None),
        ] {
            assert_eq!(count(one, other), wanted, "{one}: {other}");
            assert_eq!(count(other, one), wanted, "{other}: {one}");
        }
    }
}
