//! Polynomials in letters that do not commute: sums of words.

use num_traits::{One, Zero};
use numbers::{Field, Rational};
use std::collections::{BTreeMap, BTreeSet};
use texmath::{Equation, Name, Relation, Tree, any, base_alone};

/// The most terms of a sum of words, and the highest power that is multiplied out.
const MOST_TERMS: usize = 2_000;
const HIGHEST_POWER: i32 = 12;

/// Values within values beyond which nothing is put in.
const DEEPEST: usize = 20;

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

    /// Counts its factors under an arrow.
    fn vectors(&self) -> usize {
        let is_arrow = |factor: &str| [r"\vec", r"\overrightarrow"].iter().any(|arrow| factor.contains(arrow));
        self.others.iter().filter(|(factor, _)| is_arrow(factor)).count()
    }

    /// The word whose factors, each transposed, stand in the other order.
    fn transposed(self) -> Self {
        let factors = self.others.into_iter().rev();
        let others = factors.map(|(factor, power)| match factor.strip_suffix(TRANSPOSED) {
            Some(plain) => (plain.to_owned(), power),
            None => (format!("{factor}{TRANSPOSED}"), power),
        });
        Self {
            commuting: self.commuting,
            others: others.collect(),
        }
    }
}

/// The mark of a factor that is transposed.
const TRANSPOSED: char = '\u{22a4}';

/// A sum of words with their coefficients.
type Words = BTreeMap<Word, Rational>;

/// The letters of a document: those that do not commute, and their values.
pub(super) struct Letters<'a> {
    /// Those that do not commute.
    operators: &'a BTreeSet<Name>,
    /// Those that equations define, with their values.
    values: BTreeMap<&'a Name, &'a Tree>,
    /// The factors that are printed with an inverse of their own.
    inverted: BTreeSet<String>,
}

impl<'a> Letters<'a> {
    pub fn new(operators: &'a BTreeSet<Name>) -> Self {
        Self {
            operators,
            values: BTreeMap::new(),
            inverted: BTreeSet::new(),
        }
    }

    /// Takes the values that equations give their left sides.
    pub fn with_values(mut self, given: &[&'a Equation]) -> Self {
        for equation in given {
            if let (Tree::Symbol(name, _), Relation::Equal) = (&equation.left, equation.relation) {
                self.values.insert(name, &equation.right);
            }
        }
        self
    }

    /// Returns true if an equation holds, whatever the letters are that do not commute.
    pub fn has_identity(&self, equation: &Equation) -> bool {
        equation.relation == Relation::Equal && self.difference(equation).is_some_and(|words| words.is_empty())
    }

    /// Returns true if an equation says what another one says.
    pub fn are_one(&self, equation: &Equation, other: &Equation) -> bool {
        let are_equations = [equation, other].iter().all(|one| one.relation == Relation::Equal);
        are_equations
            && match (self.difference(equation), self.difference(other)) {
                (Some(one), Some(other)) => one == other || one == negated(&other),
                _ => false,
            }
    }

    /// The left side less the right one.
    fn difference(&self, equation: &Equation) -> Option<Words> {
        let mut inverted = BTreeSet::new();
        for side in [&equation.left, &equation.right] {
            any(side, &mut |node| {
                if let Tree::Power(of, exponent, _) = node
                    && *exponent < 0
                {
                    inverted.insert(of.to_string());
                }
                false
            });
        }
        let own = Self {
            operators: self.operators,
            values: self.values.clone(),
            inverted,
        };
        let mut words = own.expanded(&equation.left, 0)?;
        for (word, coefficient) in own.expanded(&equation.right, 0)? {
            add(&mut words, word, -coefficient);
        }
        Some(words)
    }

    /// Multiplies a tree out, which stands in so many values; `None` where it is too large or divides by a sum.
    fn expanded(&self, tree: &Tree, depth: usize) -> Option<Words> {
        let expand = |tree: &Tree| self.expanded(tree, depth);
        match tree {
            Tree::Symbol(name, _) if self.values.contains_key(name) => {
                let value = self.values.get(name)?;
                (depth < DEEPEST).then(|| self.expanded(value, depth + 1)).flatten()
            }
            Tree::Number(number) => Some(constant(number.clone())),
            Tree::Negate(of) => Some(negated(&expand(of)?)),
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
                // (A^T A)^{-1} says of no factor that it has an inverse
                let has_inverse =
                    |(factor, _): &(String, i32)| self.inverted.contains(factor.trim_end_matches(TRANSPOSED));
                let of = inverse(&expand(of)?)
                    .filter(|words| {
                        words
                            .keys()
                            .all(|word| word.others.len() < 2 || word.others.iter().all(has_inverse))
                    })
                    .unwrap_or_else(|| self.atom(of, -1));
                (0..-*exponent).try_fold(constant(Rational::one()), |product, _| times(&product, &of))
            }
            // a quotient does not say on which side the divisor stands
            Tree::Quotient(above, below, _) => {
                let below = expand(below)?;
                let commutes = below.keys().all(|word| word.others.is_empty());
                times(&expand(above)?, &inverse(&below).filter(|_| commutes)?)
            }
            Tree::RealPower(of, exponent, _) if is_sign_of_transpose(of, exponent) => {
                let of = expand(of)?;
                let may_conjugate = !matches!(&**exponent, Tree::Symbol(name, _) if ["T", r"\top", r"\intercal"].contains(&name.base.as_str()));
                let has_scalars = of.keys().any(|word| !word.commuting.is_empty());
                match may_conjugate && has_scalars {
                    true => Some(self.atom(tree, 1)),
                    false => Some(
                        of.into_iter()
                            .map(|(word, coefficient)| (word.transposed(), coefficient))
                            .collect(),
                    ),
                }
            }
            tree => Some(self.atom(tree, 1)),
        }
    }

    /// A power of what is not looked into.
    fn atom(&self, tree: &Tree, power: i32) -> Words {
        let is_operator = |node: &Tree| {
            matches!(node, Tree::Symbol(name, _) | Tree::Call(name, ..)
                if self.operators.contains(name) || self.values.contains_key(name))
        };
        let mut word = Word::default();
        if any(tree, &mut |node| is_operator(node)) {
            word.others.push((tree.to_string(), power));
        } else {
            word.commuting.insert(tree.to_string(), power);
        }
        Words::from([(word, Rational::from_integer(1))])
    }
}

fn negated(words: &Words) -> Words {
    let terms = words.iter();
    terms
        .map(|(word, coefficient)| (word.clone(), -coefficient.clone()))
        .collect()
}

fn constant(value: Rational) -> Words {
    let mut words = Words::new();
    add(&mut words, Word::default(), value);
    words
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
    // (b c) d of vectors is not b (c d)
    let vectors = |words: &Words| words.keys().map(Word::vectors).max().unwrap_or_default();
    if vectors(left) + vectors(right) > 2 {
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

/// Returns true if an exponent is the sign of a transpose or an adjoint.
pub(super) fn is_sign_of_transpose(of: &Tree, exponent: &Tree) -> bool {
    let Tree::Symbol(name, _) = exponent else {
        return false;
    };
    let is_capital =
        |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if name.base.chars().all(|c| c.is_ascii_uppercase()));
    let is_alone = *name == base_alone(name);
    match name.base.as_str() {
        r"\top" | r"\intercal" | r"\dagger" => true,
        "T" => is_alone && !matches!(of, Tree::Number(_)),
        "H" => is_alone && is_capital(of),
        _ => false,
    }
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
        read.iter()
            .all(|equation| Letters::new(&operators).has_identity(equation))
    }

    #[test]
    fn factors_keep_their_places() {
        for tex in [
            "(A + B) C = A C + B C",
            "(A + B)^2 = A^2 + A B + B A + B^2",
            r"\frac{A m B}{2 n} = \frac{1}{2} m A B n^{-1}",
            "A^{-1} A B = B",
            "(A m B)^{-1} = m^{-1} B^{-1} A^{-1}",
            "(m B)^{-1} = m^{-1} B^{-1}",
            "A B - A B = 0",
            "(A B)^T = B^T A^T",
            r"(A^{-1} B^\top)^\top = B (A^\top)^{-1}",
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
            "(A C)(m B C)^{-1} = A B^{-1} m^{-1}",
            r"(B A)(A^\top A)^{-1} A^\top = B",
            "(A B)^T = A^T B^T",
            "(z A)^H = z A^H",
        ] {
            assert!(!holds(tex, &["A", "B", "C"]), "{tex}");
        }
        assert!(holds("(a + b)(a - b) = a^2 - b^2", &["A"]));
        let (operators, names) = (BTreeSet::new(), Names::default());
        let given = read("C = A B, A B A = C + B", &names).unwrap();
        let given: Vec<&Equation> = given.iter().collect();
        let letters = Letters::new(&operators).with_values(&given);
        let has = |tex: &str| letters.has_identity(&read(tex, &names).unwrap()[0]);
        assert!(has("C A = A B A") && !has("C = B A B"));
        let is_said = |tex: &str| letters.are_one(&read(tex, &names).unwrap()[0], given[1]);
        assert!(is_said("B = A B A - A B") && !is_said("B = 2 A B A - 2 A B"));
    }
}
