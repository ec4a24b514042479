//! How a formula is written as one product, whatever the order and the grouping of its factors.

use crate::number::{Field, Rational};
use crate::tex::{Equation, Tree};
use num_traits::{One, Zero};
use std::collections::BTreeMap;

/// A number times powers of what is no product: `\frac{a}{2}\,a` and `a^2/2` are the same.
#[derive(Clone, Debug, PartialEq)]
struct Monomial {
    number: Rational,
    /// Exponents by what is raised, which are not 0.
    powers: BTreeMap<String, Rational>,
}

/// Whether two formulas are the same product: nothing is multiplied out, no function is known but that ln e is 1.
pub fn is_same_product(one: &Tree, other: &Tree) -> bool {
    Monomial::of(one) == Monomial::of(other)
}

/// Returns true if both sides of an equation are the same product by how they are written, which says nothing: a side that was
/// printed so, and adds up multiples of one product, says that they are that much.
pub fn is_balanced(equation: &Equation, printed: &Equation) -> bool {
    let says_a_sum = |side: &Tree, printed: &Tree| side == printed && adds_multiples(side);
    is_same_product(&equation.left, &equation.right)
        && !says_a_sum(&equation.left, &printed.left)
        && !says_a_sum(&equation.right, &printed.right)
}

/// Returns true for a sum of terms that are multiples of one product and do not cancel.
fn adds_multiples(tree: &Tree) -> bool {
    let Tree::Sum(terms) = tree else { return false };
    let terms = flattened(terms, false);
    let mut pairs = terms.iter().zip(terms.iter().skip(1));
    pairs.all(|(one, other)| one.powers == other.powers) && !Monomial::of(tree).number.is_zero()
}

/// Returns true if a formula is a rational number, whatever symbols cancel in it.
pub fn is_number(tree: &Tree) -> bool {
    Monomial::of(tree).powers.is_empty()
}

impl Monomial {
    fn number(number: Rational) -> Self {
        let powers = BTreeMap::new();
        Self { number, powers }
    }

    fn atom(text: String) -> Self {
        let powers = BTreeMap::from([(text, Rational::one())]);
        Self {
            number: Rational::one(),
            powers,
        }
    }

    fn of(tree: &Tree) -> Self {
        let own = || Self::atom(text_of(tree));
        match tree {
            Tree::Number(number) => Self::number(number.clone()),
            Tree::Negate(body) => Self::number(-Rational::one()).times(&Self::of(body)),
            Tree::Product(factors) => factors.iter().fold(Self::number(Rational::one()), |all, factor| {
                all.times(&Self::of(factor))
            }),
            Tree::Quotient(above, below, _) => {
                let below = Self::of(below).to_the(&-Rational::one());
                below.map_or_else(own, |below| Self::of(above).times(&below))
            }
            Tree::Power(base, exponent, _) => {
                let raised = Self::of(base).to_the(&Rational::from_integer(i64::from(*exponent)));
                raised.unwrap_or_else(own)
            }
            Tree::RealPower(base, exponent, ..) => match &**exponent {
                Tree::Number(exponent) => Self::of(base).to_the(exponent).unwrap_or_else(own),
                _ if Self::of(base) == Self::number(Rational::one()) => Self::number(Rational::one()),
                _ => own(),
            },
            Tree::Root(base, index, _) => {
                let part = Rational::from_ratio(1, i64::from(*index));
                Self::of(base).to_the(&part).unwrap_or_else(own)
            }
            Tree::Sum(terms) => Self::of_sum(terms),
            Tree::Call(name, argument, _) if name.base == r"\ln" && argument.to_string() == "e" => {
                Self::number(Rational::one())
            }
            _ => own(),
        }
    }

    /// Terms that are multiples of each other are one.
    fn of_sum(terms: &[Tree]) -> Self {
        let mut all: Vec<Self> = Vec::new();
        for term in flattened(terms, false) {
            match all.iter_mut().find(|known| known.powers == term.powers) {
                Some(known) => known.number += term.number,
                None => all.push(term),
            }
        }
        all.retain(|term| !term.number.is_zero());
        match all.as_slice() {
            [] => Self::number(Rational::zero()),
            [term] => term.clone(),
            _ => {
                let mut texts: Vec<String> = all.iter().map(|term| format!("{term:?}")).collect();
                texts.sort_unstable();
                Self::atom(texts.join("+"))
            }
        }
    }

    fn times(mut self, other: &Self) -> Self {
        self.number *= other.number.clone();
        for (base, exponent) in &other.powers {
            let own = self.powers.entry(base.clone()).or_insert_with(Rational::zero);
            *own += exponent.clone();
        }
        let is_zero = self.number.is_zero();
        self.powers.retain(|_, exponent| !exponent.is_zero() && !is_zero);
        self
    }

    /// Nothing where the number to this power is none, or irrational.
    fn to_the(&self, exponent: &Rational) -> Option<Self> {
        let number = match i32::try_from(exponent.0.numerator()).ok() {
            _ if self.number.is_one() => Rational::one(),
            Some(whole) if exponent.0.denominator().is_one() && whole.unsigned_abs() < 100 => {
                let base = match whole < 0 {
                    true if self.number.is_zero() => return None,
                    true => Rational::one() / self.number.clone(),
                    false => self.number.clone(),
                };
                (0..whole.unsigned_abs()).fold(Rational::one(), |all, _| all * base.clone())
            }
            _ => return None,
        };
        let powers = self.powers.iter();
        let powers = powers.map(|(base, own)| (base.clone(), own.clone() * exponent.clone()));
        Some(Self {
            number,
            powers: powers.filter(|(_, exponent)| !exponent.is_zero()).collect(),
        })
    }
}

/// How what is no product is told apart: its parts as products.
fn text_of(tree: &Tree) -> String {
    match tree {
        Tree::Call(name, argument, _) => format!("{name}({:?})", Monomial::of(argument)),
        Tree::RealPower(base, exponent, ..) => format!("({:?})^({:?})", Monomial::of(base), Monomial::of(exponent)),
        other => other.to_string(),
    }
}

/// The terms of a sum and of the sums in it, with their signs.
fn flattened(terms: &[Tree], is_negative: bool) -> Vec<Monomial> {
    let each = terms.iter().flat_map(|term| match term {
        Tree::Sum(inner) => flattened(inner, is_negative),
        Tree::Negate(body) => flattened(std::slice::from_ref(body), !is_negative),
        other if is_negative => vec![Monomial::number(-Rational::one()).times(&Monomial::of(other))],
        other => vec![Monomial::of(other)],
    });
    each.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tex::{Names, read};

    fn is_same(equation: &str) -> bool {
        let equations = read(equation, &Names::default()).expect("an equation");
        is_same_product(&equations[0].left, &equations[0].right)
    }

    #[test]
    fn factors_may_stand_in_any_order_and_grouping() {
        for equation in [
            r"a^2 = a a",
            r"\frac{a}{2} a = \frac{a^2}{2}",
            r"\sqrt{x^2}^2 = x^2",
            r"\ln a = \frac{\ln a}{\ln e}",
            r"R^4 = R^3 R",
            r"4 a c = (2 + 2) a c",
            r"\frac{x + y}{y + x} = 1",
            r"x - 2 x = -x",
            r"e^{\frac{x y}{y}} = e^x",
            r"(\frac{a}{a})^y = 1",
            r"[x - 3 - (x - 3)] y = 0",
            r"\sin(x a) = \sin(a x)",
        ] {
            assert!(is_same(equation), "{equation}");
        }
    }

    #[test]
    fn a_sum_of_multiples_that_was_printed_says_how_much_they_are() {
        let read = |tex: &str| read(tex, &Names::default()).expect("an equation").remove(0);
        let is_balanced = |new: &str, printed: &str| is_balanced(&read(new), &read(printed));
        assert!(!is_balanced(
            r"\frac{a}{12} + \frac{a}{4} = \frac{a}{3}",
            r"\frac{a}{12} + \frac{a}{4} = \frac{1}{3}"
        ));
        assert!(is_balanced(r"a + b - b = a", r"a + b = a"));
        assert!(is_balanced(r"a b = b a", r"a b = b"));
    }

    #[test]
    fn what_must_be_multiplied_out_or_known_is_not_the_same() {
        for equation in [
            r"(a + b)^2 = a^2 + 2 a b + b^2",
            r"\sin(2 x) = 2 \sin x \cos x",
            r"a^2 = a",
            r"\sqrt{2} = 2",
            r"a (b + c) = a b + a c",
        ] {
            assert!(!is_same(equation), "{equation}");
        }
    }
}
