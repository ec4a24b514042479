//! Claims about letters that need not commute, as matrices: what follows in every ring with an involution.
//!
//! A claim is accepted as a combination of what is given, each multiplied by words in front and behind (Raab, Regensburger and
//! Hossein Poor 2021: such a combination proves the claim of matrices of whatever shapes, where claim and premises have one).

use super::expand::Refusal;
use super::verdict::Proved;
use num_traits::{One, Zero};
use numbers::Rational;
use std::collections::BTreeMap;

/// Words that are added up for one proof, at most.
const MOST_WORDS: usize = 2_000_000;

/// The most terms of a sum of words that is multiplied out.
const MOST_TERMS_OF_SUM: usize = 2_000;

/// A factor that keeps its place.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Letter {
    pub name: String,
    pub is_transposed: bool,
    /// True for a vector of which products are numbers, and not associative.
    pub is_vector: bool,
}

/// A product: its commuting factors with their powers, and the others in their order.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Word {
    pub scalars: BTreeMap<String, i32>,
    pub letters: Vec<Letter>,
}

impl Word {
    /// Returns the product of two words.
    pub fn times(&self, other: &Self) -> Self {
        let mut product = self.clone();
        for (factor, power) in &other.scalars {
            *product.scalars.entry(factor.clone()).or_default() += power;
        }
        product.scalars.retain(|_, power| *power != 0);
        product.letters.extend(other.letters.iter().cloned());
        product
    }

    /// Returns the word whose factors, each transposed, stand in the other order.
    pub fn transposed(&self) -> Self {
        let letter = |letter: &Letter| Letter {
            is_transposed: !letter.is_transposed,
            ..letter.clone()
        };
        Self {
            scalars: self.scalars.clone(),
            letters: self.letters.iter().rev().map(letter).collect(),
        }
    }

    /// Counts its vectors.
    pub fn vectors(&self) -> usize {
        self.letters.iter().filter(|letter| letter.is_vector).count()
    }
}

/// A sum of words with their coefficients, none of which is 0.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Words(BTreeMap<Word, Rational>);

impl Words {
    /// Returns its value at numbers, which are their own transposes; nothing where a factor has none, or is 0 and divided by.
    pub fn value(&self, point: &BTreeMap<String, Rational>) -> Option<Rational> {
        let mut sum = Rational::zero();
        for (word, coefficient) in self.terms() {
            let letters = word.letters.iter().map(|letter| (&letter.name, 1));
            let scalars = word.scalars.iter().map(|(name, power)| (name, *power));
            let mut product = coefficient.clone();
            for (name, power) in letters.chain(scalars) {
                let value = point.get(name)?.clone();
                let factor = match power < 0 {
                    true if value.is_zero() => return None,
                    true => Rational::one() / value,
                    false => value,
                };
                for _ in 0..power.unsigned_abs() {
                    product *= factor.clone();
                }
            }
            sum += product;
        }
        Some(sum)
    }

    /// Makes a number of one word.
    pub fn of(word: Word, coefficient: Rational) -> Self {
        let mut words = Self::default();
        words.add(word, coefficient);
        words
    }

    /// Makes a number of a constant.
    pub fn constant(value: Rational) -> Self {
        Self::of(Word::default(), value)
    }

    /// Iterates over the words with their coefficients.
    pub fn terms(&self) -> impl DoubleEndedIterator<Item = (&Word, &Rational)> + Clone {
        self.0.iter()
    }

    /// Counts the words.
    pub fn size(&self) -> usize {
        self.0.len()
    }

    /// Iterates over the words.
    pub fn words(&self) -> impl Iterator<Item = &Word> {
        self.0.keys()
    }

    /// Returns true if this is 0 in every ring.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds a multiple of a word.
    pub fn add(&mut self, word: Word, coefficient: Rational) {
        let total = match self.0.remove(&word) {
            Some(known) => known + coefficient,
            None => coefficient,
        };
        if !total.is_zero() {
            self.0.insert(word, total);
        }
    }

    /// Adds the product of a number, a word in front, another sum, and a word behind.
    pub fn add_between(&mut self, coefficient: &Rational, front: &Word, words: &Self, behind: &Word) {
        for (word, own) in &words.0 {
            self.add(front.times(word).times(behind), own.clone() * coefficient.clone());
        }
    }

    /// Returns the sum of each word transposed.
    pub fn transposed(&self) -> Self {
        let mut words = Self::default();
        for (word, coefficient) in &self.0 {
            words.add(word.transposed(), coefficient.clone());
        }
        words
    }

    /// Returns the sum with each coefficient negated.
    pub fn negated(&self) -> Self {
        let mut words = Self::default();
        words.add_between(&-Rational::one(), &Word::default(), self, &Word::default());
        words
    }

    /// Returns the sum of two.
    pub fn plus(mut self, other: &Self) -> Self {
        self.add_between(&Rational::one(), &Word::default(), other, &Word::default());
        self
    }

    /// Multiplies out; `None` where it is too large, or where three vectors meet: (b c) d of vectors is not b (c d).
    pub fn times(&self, other: &Self) -> Option<Self> {
        let vectors = |words: &Self| words.0.keys().map(Word::vectors).max().unwrap_or_default();
        if self.0.len().saturating_mul(other.0.len()) > MOST_TERMS_OF_SUM || vectors(self) + vectors(other) > 2 {
            return None;
        }
        let mut product = Self::default();
        for (word, coefficient) in &self.0 {
            product.add_between(coefficient, word, other, &Word::default());
        }
        Some(product)
    }

    /// Returns the only term, if it is one.
    pub fn only(&self) -> Option<(&Word, &Rational)> {
        let mut terms = self.0.iter();
        let only = terms.next()?;
        terms.next().is_none().then_some(only)
    }
}

/// A claim about letters that need not commute: sums of words that vanish where those that are given do.
#[derive(Clone, Debug, Default)]
pub struct WordQuestion {
    pub claims: Vec<Words>,
    /// The premises, and that each inverse is one, as sums that vanish.
    pub givens: Vec<Words>,
    /// Conditions that the claim rests on: lengths of sums, `n \ge 0`, and inverses that it brings in.
    pub provided: Vec<String>,
}

/// A sum that vanishes where what is given does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum WordSource {
    Given(usize),
    /// What is given, transposed.
    Transposed(usize),
    /// A line before.
    Line(usize),
}

/// A multiple of a sum that vanishes.
#[derive(Clone, Debug)]
pub struct WordMultiple {
    pub coefficient: Rational,
    pub front: Word,
    pub of: WordSource,
    pub behind: Word,
}

/// A proof: lines, each a sum of multiples of what is given and of lines before it. A claim is one of the lines.
#[derive(Clone, Debug, Default)]
pub struct WordProof {
    pub lines: Vec<Vec<WordMultiple>>,
    /// The line of each claim.
    pub claims: Vec<usize>,
    /// Numbers that the letters may be, for which everything given holds.
    pub point: BTreeMap<String, Rational>,
}

/// Accepts a proof: each claim is its line, and what is given holds of numbers.
///
/// # Errors
/// A [`Refusal`] that says which line, claim or given is not shown.
pub fn prove_in_words(question: &WordQuestion, proof: &WordProof) -> Result<Proved, Refusal> {
    let refused = |why: String| Err(Refusal::Other(why));
    // a product of vectors is one of numbers: it is not associative
    let sums = question.claims.iter().chain(&question.givens);
    let is_linear = sums.flat_map(Words::terms).any(|(word, _)| word.vectors() > 0);
    let mut left = MOST_WORDS;
    let mut lines: Vec<Words> = Vec::new();
    for (number, line) in proof.lines.iter().enumerate() {
        let mut sum = Words::default();
        for multiple in line {
            if is_linear && !(multiple.front.letters.is_empty() && multiple.behind.letters.is_empty()) {
                return refused(format!("line {number} multiplies by a word what has vectors"));
            }
            let transposed;
            let of = match multiple.of {
                WordSource::Given(given) => question.givens.get(given),
                WordSource::Transposed(given) => {
                    transposed = question.givens.get(given).map(Words::transposed);
                    transposed.as_ref()
                }
                WordSource::Line(before) => lines.get(before),
            };
            let Some(of) = of else {
                return refused(format!("line {number} is of what is not there"));
            };
            let count = of.terms().count();
            if count > left {
                return Err(Refusal::Effort);
            }
            left -= count;
            if let Some(inverse) =
                uninverted(question, &multiple.front).or_else(|| uninverted(question, &multiple.behind))
            {
                return refused(format!("line {number} divides by {inverse}, which nothing else does"));
            }
            sum.add_between(&multiple.coefficient, &multiple.front, of, &multiple.behind);
        }
        lines.push(sum);
    }
    if question.claims.is_empty() || question.claims.len() != proof.claims.len() {
        return refused("there is not one line for each claim".into());
    }
    for (claim, line) in question.claims.iter().zip(&proof.claims) {
        if lines.get(*line) != Some(claim) {
            return refused("a line is not the claim".into());
        }
    }
    for (number, given) in question.givens.iter().enumerate() {
        match given.value(&proof.point) {
            Some(value) if value.is_zero() => {}
            _ => return refused(format!("given {number} is not shown to hold at the point")),
        }
    }
    for claim in &question.claims {
        if claim.value(&proof.point).is_none() {
            return refused("the claim has no value at the point".into());
        }
    }
    Ok(Proved::of_words())
}

/// A number that a word divides by, which neither claim nor premises do.
fn uninverted<'w>(question: &WordQuestion, word: &'w Word) -> Option<&'w String> {
    let divided = word.scalars.iter().filter(|(_, power)| **power < 0);
    let is_divided_by = |factor: &String| {
        let sums = question.claims.iter().chain(&question.givens);
        sums.flat_map(Words::terms)
            .any(|(word, _)| word.scalars.get(factor).is_some_and(|power| *power < 0))
    };
    divided.map(|(factor, _)| factor).find(|factor| !is_divided_by(factor))
}
