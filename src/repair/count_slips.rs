//! Counts the slips of the pen by which two formulas differ.

use super::path::parts;
use crate::number::{Field, Rational};
use crate::tex::{Equation, Name, Tree, any, any_side};

/// Returns how many signs, names, digits, exponents, functions and whole factors a printed equation and a mended one differ in, and
/// terms where the printed one may lack them; nothing where they differ in more: in a bracket, a bar, or a number of which more than
/// one digit is another.
pub fn slips(printed: &Equation, mended: &Equation, may_lack_terms: bool) -> Option<usize> {
    (printed.relation == mended.relation).then_some(())?;
    let count = Count {
        printed: may_lack_terms.then_some(printed),
    };
    Some(count.between(&printed.left, &mended.left)? + count.between(&printed.right, &mended.right)?)
}

/// A count of slips.
struct Count<'e> {
    /// The printed equation, where a term may be missing in it.
    printed: Option<&'e Equation>,
}

impl Count<'_> {
    fn between(&self, one: &Tree, other: &Tree) -> Option<usize> {
        if one == other {
            return Some(0);
        }
        let plus_one = |one: &Tree, other: &Tree| self.between(one, other).map(|slips| slips + 1);
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
                Some((one, other)) if !one.is_empty() => one
                    .iter()
                    .zip(&other)
                    .map(|(one, other)| self.between(one, other))
                    .sum(),
                _ if self.lacks_a_term(one, other) => Some(1),
                _ => self.by_sign_or_factor(one, other),
            },
        }
    }

    /// Counts the slips of formulas of which one alone has a minus, a whole factor or a whole divisor.
    fn by_sign_or_factor(&self, one: &Tree, other: &Tree) -> Option<usize> {
        let ways = [(one, other), (other, one)];
        ways.into_iter().find_map(|(whole, rest)| {
            bare(whole)
                .into_iter()
                .find_map(|bare| self.between(&bare, rest).map(|slips| slips + 1))
        })
    }

    /// Returns true if the terms of a mended formula are those of the printed one and one more, whose brackets are printed elsewhere:
    /// else any sides are balanced.
    fn lacks_a_term(&self, printed: &Tree, mended: &Tree) -> bool {
        let Some(equation) = self.printed else { return false };
        let terms = |tree: &Tree| match tree {
            Tree::Sum(terms) => terms.clone(),
            term => vec![term.clone()],
        };
        let (less, more) = (terms(printed), terms(mended));
        let kept = more.iter().zip(&less).take_while(|(more, less)| more == less).count();
        let is_invented =
            |node: &Tree| matches!(node, Tree::Sum(_)) && !any_side(equation, &mut |printed| printed == node);
        more.len() == less.len() + 1
            && more.get(kept + 1..) == less.get(kept..)
            && more
                .get(kept)
                .is_some_and(|term| !any(term, &mut |node| is_invented(node)))
    }
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
        slips(&read(one), &read(other), false)
    }

    #[test]
    fn a_term_is_missing_whose_brackets_are_printed() {
        let read = |tex: &str| read(tex, &Names::default()).expect("an equation").remove(0);
        for (printed, mended, wanted) in [
            ("x^2 - y^2 = (x - y) x", "x^2 - y^2 = (x - y) x + (x - y) y", Some(1)),
            ("x = a + c", "x = a + b + c", Some(1)),
            ("x = a + b", "x = a + b - a b", Some(1)),
            ("x = a + b", "x = a + b + (a - b) b", None),
            ("x = a + b + c", "x = a + c", None),
        ] {
            assert_eq!(
                slips(&read(printed), &read(mended), true),
                wanted,
                "{printed}: {mended}"
            );
            assert_eq!(slips(&read(printed), &read(mended), false), None, "{printed}: {mended}");
        }
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
