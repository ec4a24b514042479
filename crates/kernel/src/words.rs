//! Claims about letters that need not commute, as matrices: what follows in every ring with an involution.
//!
//! A claim is accepted as a combination of what is given, each multiplied by words in front and behind (Raab, Regensburger and
//! Hossein Poor 2021: such a combination proves the claim of matrices of whatever shapes, where claim and premises have one).

use super::expand::Refusal;
use super::verdict::Proved;
use claims::{Word, WordQuestion, Words};
use num_traits::Zero;
use numbers::Rational;
use std::collections::BTreeMap;

/// Words that are added up for one proof, at most.
const MOST_WORDS: usize = 2_000_000;

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
    // a product of vectors under arrows is one of numbers: it is not associative
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
