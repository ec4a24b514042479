//! Polynomials in letters that do not commute: sums of words.

use num_traits::{One, Zero};
use numbers::{Field, Rational};
use std::collections::{BTreeMap, BTreeSet};
use texmath::{Equation, Name, Relation, Tree, any};

/// The most terms of a sum of words, and the highest power that is multiplied out.
const MOST_TERMS: usize = 2_000;
const HIGHEST_POWER: i32 = 12;

/// A product: its commuting factors with their powers, and the others in their order.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Word {
    commuting: BTreeMap<String, i32>,
    others: Vec<(String, i32)>,
}

impl Word {
    fn times(&self, other: &Self) -> Self {
        let mut product = self.clone();
        for (factor, power) in &other.commuting {
            *product.commuting.entry(factor.clone()).or_default() += power;
        }
        product.commuting.retain(|_, power| *power != 0);
        for (factor, power) in &other.others {
            match product.others.last_mut() {
                Some((last, known)) if last == factor => {
                    *known += power;
                    if *known == 0 {
                        product.others.pop();
                    }
                }
                _ => product.others.push((factor.clone(), *power)),
            }
        }
        product
    }
}

/// A sum of words with their coefficients.
type Words = BTreeMap<Word, Rational>;

/// Returns true if an equation holds where the factors of these letters never change places.
pub(super) fn is_identity_of_words(equation: &Equation, operators: &BTreeSet<Name>) -> bool {
    let sides = [&equation.left, &equation.right].map(|side| expanded(side, operators));
    let [Some(left), Some(right)] = sides else {
        return false;
    };
    equation.relation == Relation::Equal && left == right
}

/// Multiplies a tree out; `None` where it is too large or divides by a sum.
fn expanded(tree: &Tree, operators: &BTreeSet<Name>) -> Option<Words> {
    let expand = |tree: &Tree| expanded(tree, operators);
    match tree {
        Tree::Number(number) => Some(constant(number.clone())),
        Tree::Negate(of) => {
            let terms = expand(of)?.into_iter();
            Some(terms.map(|(word, coefficient)| (word, -coefficient)).collect())
        }
        Tree::Sum(parts) => {
            let mut sum = Words::new();
            for part in parts {
                for (word, coefficient) in expand(part)? {
                    add(&mut sum, word, coefficient);
                }
            }
            (sum.len() <= MOST_TERMS).then_some(sum)
        }
        Tree::Product(factors) => factors.iter().try_fold(constant(Rational::one()), |product, factor| {
            times(&product, &expand(factor)?)
        }),
        Tree::Power(of, exponent, _) if (0..=HIGHEST_POWER).contains(exponent) => {
            let of = expand(of)?;
            (0..*exponent).try_fold(constant(Rational::one()), |product, _| times(&product, &of))
        }
        Tree::Power(of, exponent, _) if (-HIGHEST_POWER..0).contains(exponent) => {
            let of = inverse(&expand(of)?).unwrap_or_else(|| atom(of, -1, operators));
            (0..-*exponent).try_fold(constant(Rational::one()), |product, _| times(&product, &of))
        }
        // a quotient does not say on which side the divisor stands
        Tree::Quotient(above, below, _) => {
            let below = expand(below)?;
            let commutes = below.keys().all(|word| word.others.is_empty());
            times(&expand(above)?, &inverse(&below).filter(|_| commutes)?)
        }
        tree => Some(atom(tree, 1, operators)),
    }
}

fn constant(value: Rational) -> Words {
    let mut words = Words::new();
    add(&mut words, Word::default(), value);
    words
}

/// A power of what is not looked into.
fn atom(tree: &Tree, power: i32, operators: &BTreeSet<Name>) -> Words {
    let is_operator =
        |node: &Tree| matches!(node, Tree::Symbol(name, _) | Tree::Call(name, ..) if operators.contains(name));
    let mut word = Word::default();
    if any(tree, &mut |node| is_operator(node)) {
        word.others.push((tree.to_string(), power));
    } else {
        word.commuting.insert(tree.to_string(), power);
    }
    Words::from([(word, Rational::from_integer(1))])
}

fn add(sum: &mut Words, word: Word, coefficient: Rational) {
    let total = match sum.remove(&word) {
        Some(known) => known + coefficient,
        None => coefficient,
    };
    if !total.is_zero() {
        sum.insert(word, total);
    }
}

fn times(left: &Words, right: &Words) -> Option<Words> {
    if left.len().saturating_mul(right.len()) > MOST_TERMS {
        return None;
    }
    let mut product = Words::new();
    for (one, first) in left {
        for (other, second) in right {
            add(&mut product, one.times(other), first.clone() * second.clone());
        }
    }
    Some(product)
}

/// The inverse of a product, whose factors stand in the other order.
fn inverse(words: &Words) -> Option<Words> {
    let mut terms = words.iter();
    let (word, coefficient) = terms.next()?;
    if terms.next().is_some() {
        return None;
    }
    let inverted = |(factor, power): (&String, &i32)| (factor.clone(), -power);
    let word = Word {
        commuting: word.commuting.iter().map(inverted).collect(),
        others: word
            .others
            .iter()
            .rev()
            .map(|(factor, power)| inverted((factor, power)))
            .collect(),
    };
    Some(Words::from([(word, Rational::one() / coefficient.clone())]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use texmath::{Names, read};

    fn holds(tex: &str, operators: &[&str]) -> bool {
        let name = |letter: &&str| Name {
            base: (*letter).to_owned(),
            ..Name::default()
        };
        let operators = operators.iter().map(name).collect();
        let read = read(tex, &Names::default()).unwrap();
        read.iter().all(|equation| is_identity_of_words(equation, &operators))
    }

    #[test]
    fn factors_keep_their_places() {
        for tex in [
            "(A + B) C = A C + B C",
            "(A + B)^2 = A^2 + A B + B A + B^2",
            r"\frac{A m B}{2 n} = \frac{1}{2} m A B n^{-1}",
            "A^{-1} A B = B",
            "(A m B)^{-1} = m^{-1} B^{-1} A^{-1}",
            "(A C)(B C)^{-1} = A B^{-1}",
            "A B - A B = 0",
        ] {
            assert!(holds(tex, &["A", "B", "C"]), "{tex}");
        }
        for tex in [
            "A B = B A",
            "(A + B)(A - B) = A^2 - B^2",
            "A^{-1} B A = B",
            "A + B = A",
            "e^{A + B} = e^A e^B",
            r"\frac{B}{A} A = B",
            "(A B)^{-1} = A^{-1} B^{-1}",
        ] {
            assert!(!holds(tex, &["A", "B", "C"]), "{tex}");
        }
        assert!(holds("(a + b)(a - b) = a^2 - b^2", &["A"]));
    }
}
