//! Proofs of claims about letters that need not commute: words are rewritten by what is given, which is completed within bounds
//! (Mora 1986).

use kernel::{Letter, Word, WordMultiple, WordProof, WordQuestion, WordSource, Words};
use num_traits::{One, Zero};
use numbers::{Field, Rational};
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// The most rules that are derived, and the most letters of a word that is rewritten.
const MOST_RULES: usize = 80;
const MOST_LETTERS: usize = 16;

/// The most rewritings for one claim.
const MOST_STEPS: usize = 20_000;

/// The most terms of a sum that is rewritten.
const MOST_TERMS: usize = 400;

/// The most choices of numbers for the letters.
const MOST_CHOICES: u64 = 12;

/// Returns what proves the claims, if it is found within the bounds.
pub fn proof(question: &WordQuestion) -> Option<WordProof> {
    let point = point(question)?;
    let mut search = Search::new(question);
    let mut claims = Vec::new();
    for claim in &question.claims {
        claims.push(search.derive(claim)?);
    }
    Some(WordProof {
        lines: search.lines,
        claims,
        point,
    })
}

/// A sum that vanishes: its leading word may be replaced by the others.
#[derive(Clone, Debug)]
struct Rule {
    sum: Words,
    lead: Word,
    coefficient: Rational,
    source: WordSource,
}

impl Rule {
    fn of(sum: Words, source: WordSource) -> Option<Self> {
        let (lead, coefficient) = sum.terms().max_by(|one, other| order(one.0, other.0))?;
        let (lead, coefficient) = (lead.clone(), coefficient.clone());
        Some(Self {
            sum,
            lead,
            coefficient,
            source,
        })
    }
}

/// The order of words: those of more letters later, then by their letters, then by their scalars.
fn order(one: &Word, other: &Word) -> Ordering {
    let size = |word: &Word| word.scalars.values().map(|power| i64::from(power.abs())).sum::<i64>();
    (one.letters.len().cmp(&other.letters.len()))
        .then_with(|| one.letters.cmp(&other.letters))
        .then_with(|| size(one).cmp(&size(other)))
        .then_with(|| one.scalars.cmp(&other.scalars))
}

struct Search {
    rules: Vec<Rule>,
    lines: Vec<Vec<WordMultiple>>,
    /// Pairs of rules whose leading words are still to be laid over each other.
    open: Vec<(usize, usize)>,
    /// Scalars that are divided by.
    inverted: BTreeSet<String>,
    /// True if nothing may be multiplied by letters.
    is_linear: bool,
    steps: usize,
}

impl Search {
    fn new(question: &WordQuestion) -> Self {
        let words = || {
            question
                .claims
                .iter()
                .chain(&question.givens)
                .flat_map(Words::terms)
                .map(|(word, _)| word)
        };
        let divided = words().flat_map(|word| word.scalars.iter().filter(|(_, power)| **power < 0));
        let mut search = Self {
            rules: Vec::new(),
            lines: Vec::new(),
            open: Vec::new(),
            inverted: divided.map(|(factor, _)| factor.clone()).collect(),
            is_linear: words().any(|word| word.vectors() > 0),
            steps: 0,
        };
        let has_transposes = words().any(|word| word.letters.iter().any(|letter| letter.is_transposed));
        for (number, given) in question.givens.iter().enumerate() {
            search.add(Rule::of(given.clone(), WordSource::Given(number)));
            let transposed = given.transposed();
            if has_transposes && transposed != *given && transposed != given.clone().negated() {
                search.add(Rule::of(transposed, WordSource::Transposed(number)));
            }
        }
        search
    }

    fn add(&mut self, rule: Option<Rule>) {
        let Some(rule) = rule.filter(|rule| self.rules.iter().all(|known| known.sum != rule.sum)) else {
            return;
        };
        let number = self.rules.len();
        self.rules.push(rule);
        self.open
            .extend((0..=number).flat_map(|other| [(number, other), (other, number)]));
        // the shortest first
        let length = |pair: &(usize, usize)| {
            let letters = |rule: usize| self.rules.get(rule).map_or(0, |rule| rule.lead.letters.len());
            std::cmp::Reverse(letters(pair.0) + letters(pair.1))
        };
        self.open.sort_by_key(length);
        self.open.dedup();
    }

    /// Returns the line of a sum, where it is derived.
    fn derive(&mut self, sum: &Words) -> Option<usize> {
        loop {
            let (rest, multiples) = self.rewritten(sum.clone())?;
            if rest.is_zero() {
                self.lines.push(multiples);
                return Some(self.lines.len() - 1);
            }
            // what follows from the rules is laid over them until the claim is rewritten further
            let known = self.rules.len();
            while self.rules.len() == known {
                let (one, other) = self.open.pop()?;
                self.overlay(one, other);
            }
            if self.rules.len() > MOST_RULES || self.steps > MOST_STEPS {
                return None;
            }
        }
    }

    /// Rewrites a sum by the rules as far as it goes; returns the rest, and the multiples that were taken off.
    fn rewritten(&mut self, mut sum: Words) -> Option<(Words, Vec<WordMultiple>)> {
        let (mut multiples, mut rest) = (Vec::new(), Words::default());
        while let Some((word, coefficient)) = sum.terms().max_by(|one, other| order(one.0, other.0)) {
            let (word, coefficient) = (word.clone(), coefficient.clone());
            self.steps += 1;
            if self.steps > MOST_STEPS || sum.terms().count() > MOST_TERMS || word.letters.len() > MOST_LETTERS {
                return None;
            }
            let found = self
                .rules
                .iter()
                .find_map(|rule| Some((rule, self.around(&word, &rule.lead)?)));
            match found {
                Some((rule, (front, behind))) => {
                    let factor = coefficient / rule.coefficient.clone();
                    sum.add_between(&-factor.clone(), &front, &rule.sum, &behind);
                    multiples.push(WordMultiple {
                        coefficient: factor,
                        front,
                        of: rule.source,
                        behind,
                    });
                }
                None => {
                    sum.add(word.clone(), -coefficient.clone());
                    rest.add(word, coefficient);
                }
            }
        }
        Some((rest, multiples))
    }

    /// Returns what stands in front of and behind a word in another one, the scalars in front.
    fn around(&self, word: &Word, inner: &Word) -> Option<(Word, Word)> {
        let length = inner.letters.len();
        if length > word.letters.len() || (self.is_linear && length != word.letters.len()) {
            return None;
        }
        let at = (0..=word.letters.len() - length)
            .find(|at| word.letters.get(*at..at + length) == Some(inner.letters.as_slice()))?;
        let mut scalars = word.scalars.clone();
        for (factor, power) in &inner.scalars {
            *scalars.entry(factor.clone()).or_default() -= power;
        }
        scalars.retain(|_, power| *power != 0);
        let may_be = |(factor, power): (&String, &i32)| *power > 0 || self.inverted.contains(factor);
        let letters = |letters: Option<&[Letter]>| letters.unwrap_or_default().to_vec();
        scalars.iter().all(may_be).then(|| {
            let front = Word {
                scalars,
                letters: letters(word.letters.get(..at)),
            };
            let behind = Word {
                letters: letters(word.letters.get(at + length..)),
                ..Word::default()
            };
            (front, behind)
        })
    }

    /// Lays one leading word over the end of another, or inside it, in each way, and keeps what follows.
    fn overlay(&mut self, one: usize, other: usize) {
        let (Some(first), Some(second)) = (self.rules.get(one).cloned(), self.rules.get(other).cloned()) else {
            return;
        };
        let (left, right) = (&first.lead.letters, &second.lead.letters);
        for at in 0..left.len() {
            let shared = right.len().min(left.len() - at);
            let is_whole = one == other && shared == left.len();
            let is_laid = left.get(at..at + shared) == right.get(..shared);
            if shared == 0
                || is_whole
                || !is_laid
                || (self.is_linear && (shared != left.len() || shared != right.len()))
            {
                continue;
            }
            // the scalars that both need
            let mut scalars = first.lead.scalars.clone();
            for (factor, power) in &second.lead.scalars {
                let known = scalars.entry(factor.clone()).or_default();
                *known = (*known).max(*power);
            }
            let beside = |own: &Word, letters: &[Letter]| {
                let mut scalars = scalars.clone();
                for (factor, power) in &own.scalars {
                    *scalars.entry(factor.clone()).or_default() -= power;
                }
                scalars.retain(|_, power| *power != 0);
                Word {
                    scalars,
                    letters: letters.to_vec(),
                }
            };
            let behind = beside(&first.lead, right.get(shared..).unwrap_or_default());
            let front = beside(&second.lead, left.get(..at).unwrap_or_default());
            let rest = Word {
                letters: left.get(at + shared..).unwrap_or_default().to_vec(),
                ..Word::default()
            };
            let may_be = |word: &Word| {
                word.scalars
                    .iter()
                    .all(|(factor, power)| *power > 0 || self.inverted.contains(factor))
            };
            if !may_be(&behind) || !may_be(&front) {
                continue;
            }
            let (a, b) = (
                Rational::one() / first.coefficient.clone(),
                -(Rational::one() / second.coefficient.clone()),
            );
            let mut sum = Words::default();
            sum.add_between(&a, &Word::default(), &first.sum, &behind);
            sum.add_between(&b, &front, &second.sum, &rest);
            let Some((new, taken)) = self.rewritten(sum).filter(|(new, _)| !new.is_zero()) else {
                continue;
            };
            let mut line = vec![
                WordMultiple {
                    coefficient: a,
                    front: Word::default(),
                    of: first.source,
                    behind,
                },
                WordMultiple {
                    coefficient: b,
                    front,
                    of: second.source,
                    behind: rest,
                },
            ];
            line.extend(taken.into_iter().map(|multiple| WordMultiple {
                coefficient: -multiple.coefficient.clone(),
                ..multiple
            }));
            self.lines.push(line);
            self.add(Rule::of(new, WordSource::Line(self.lines.len() - 1)));
        }
    }
}

/// Numbers for all letters of which what is given holds, each solved for a letter that it is linear in.
fn point(question: &WordQuestion) -> Option<BTreeMap<String, Rational>> {
    // inverses, which are given last, before the rest, and those of letters before those of sums of them;
    // what holds of all numbers leaves the letters open
    let mut givens: Vec<&Words> = question.givens.iter().rev().filter(|given| !vanishes(given)).collect();
    givens.sort_by_key(|given| names(given).len());
    (0..MOST_CHOICES).find_map(|seed| {
        let mut choose = Choice(seed);
        let mut values = BTreeMap::new();
        for given in &givens {
            choose.solve(given, &mut values)?;
        }
        for words in question.claims.iter().chain(&question.givens) {
            for name in names(words) {
                values.entry(name).or_insert_with(|| choose.next());
            }
        }
        Some(values)
    })
}

/// Numbers in some order.
struct Choice(u64);

impl Choice {
    /// The next number: the small ones in the first rounds.
    fn next(&mut self) -> Rational {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let number = i64::try_from(self.0 >> 60).unwrap_or_default();
        Rational::from_integer(if number % 2 == 0 { number + 1 } else { -number - 1 })
    }

    /// Gives the letters of a sum values for which it vanishes: one that it is linear in what it comes to, else one of the
    /// numbers whose powers are known.
    fn solve(&mut self, sum: &Words, values: &mut BTreeMap<String, Rational>) -> Option<()> {
        let mut open: Vec<String> = names(sum)
            .into_iter()
            .filter(|name| !values.contains_key(name))
            .collect();
        let is_linear = |name: &String| {
            sum.terms()
                .all(|(word, _)| degree(word, name).is_some_and(|degree| degree <= 1))
        };
        // an inverse has the longest name
        let place = open
            .iter()
            .enumerate()
            .filter(|(_, name)| is_linear(name))
            .max_by_key(|(_, name)| name.len());
        let place = place.map(|(place, _)| place);
        let last = match place {
            Some(place) => Some(open.remove(place)),
            None => open.pop(),
        };
        for name in open {
            let number = self.next();
            values.insert(name, number);
        }
        let Some(last) = last else {
            return sum.value(values)?.is_zero().then_some(());
        };
        let mut at = |number: Rational| {
            values.insert(last.clone(), number);
            sum.value(values)
        };
        let solution = match place {
            Some(_) => {
                let constant = at(Rational::zero())?;
                let slope = at(Rational::one())? - constant.clone();
                match slope.is_zero() {
                    true => self.next(),
                    false => -constant / slope,
                }
            }
            None => {
                let known = [1, -1, 0].map(Rational::from_integer);
                known
                    .into_iter()
                    .find(|number| at(number.clone()).is_some_and(|value| value.is_zero()))?
            }
        };
        at(solution)?.is_zero().then_some(())
    }
}

/// Returns true if a sum of words is nothing where they commute and are their own transposes.
fn vanishes(words: &Words) -> bool {
    let mut sums: BTreeMap<BTreeMap<String, i32>, Rational> = BTreeMap::new();
    for (word, coefficient) in words.terms() {
        let mut powers = word.scalars.clone();
        for letter in &word.letters {
            *powers.entry(letter.name.clone()).or_default() += 1;
        }
        *sums.entry(powers).or_insert_with(Rational::zero) += coefficient.clone();
    }
    sums.values().all(Rational::is_zero)
}

/// Returns how often a factor stands in a word; nothing where it is divided by.
fn degree(word: &Word, name: &str) -> Option<usize> {
    let letters = word.letters.iter().filter(|letter| letter.name == name).count();
    let power = word.scalars.get(name).copied().unwrap_or_default();
    usize::try_from(power).ok().map(|power| power + letters)
}

/// The factors of all words.
fn names(words: &Words) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for (word, _) in words.terms() {
        found.extend(word.letters.iter().map(|letter| letter.name.clone()));
        found.extend(word.scalars.keys().cloned());
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use claims::{Local, Premise, Statements, word_question};

    fn statements(claim: &str, premises: &[&str]) -> Statements {
        let names = texmath::Names::default();
        let read = |tex: &str| texmath::read(&tex.replace('I', "1"), &names).expect(tex).remove(0);
        Statements {
            claims: vec![read(claim)],
            premises: premises.iter().map(|tex| Premise::known("p", read(tex))).collect(),
            locals: Vec::<Local>::new(),
            ..Statements::default()
        }
    }

    fn holds(claim: &str, premises: &[&str]) -> bool {
        let operators = ["A", "B", "C", "P", "Q", "R", "K", "S", "W", "x", "y", "u", "X", "I"]
            .map(str::to_owned)
            .into();
        let question = word_question(&statements(claim, premises), &operators, true).expect(claim);
        let proof = proof(&question);
        if let Some(proof) = &proof {
            kernel::prove_in_words(&question, proof).expect(claim);
        }
        proof.is_some()
    }

    #[test]
    fn what_holds_of_matrices_is_derived() {
        for tex in [
            "(A + B) C = A C + B C",
            "(A + B)^2 = A^2 + A B + B A + B^2",
            r"\frac{A m B}{2 n} = \frac{1}{2} m A B n^{-1}",
            "A^{-1} A B = B",
            "(A B)^{-1} = B^{-1} A^{-1}",
            "(m B)^{-1} = m^{-1} B^{-1}",
            "(A C)(m B C)^{-1} = A B^{-1} m^{-1}",
            r"(A B)^\top = B^\top A^\top",
            r"(A^{-1} B^\top)^\top = B (A^\top)^{-1}",
            r"\left(\frac{1}{n} X^\top X\right)^{-1} \frac{1}{n} X^\top X B = B",
            r"(A + B)^{-1} A + (A + B)^{-1} B = I",
            // push-through and Woodbury
            r"(I + A B)^{-1} A = A (I + B A)^{-1}",
            r"(A + B C)^{-1} = A^{-1} - A^{-1} B (I + C A^{-1} B)^{-1} C A^{-1}",
            r"A^{-1} - B^{-1} = A^{-1} (B - A) B^{-1}",
        ] {
            assert!(holds(tex, &[]), "{tex}");
        }
        for tex in [
            "A B = B A",
            "(A + B)(A - B) = A^2 - B^2",
            "A^{-1} B A = B",
            "A + B = A",
            "e^{A + B} = e^A e^B",
            "(A B)^{-1} = A^{-1} B^{-1}",
            r"(B A)(A^\top A)^{-1} A^\top = B",
            r"(A B)^\top = A^\top B^\top",
            "(z A)^H = z A^H",
            r"(I + A B)^{-1} A = (I + B A)^{-1} A",
        ] {
            assert!(!holds(tex, &[]), "{tex}");
        }
    }

    #[test]
    fn what_is_given_is_used_in_its_place_alone() {
        for (claim, premises) in [
            ("C A = A B A", vec!["C = A B"]),
            ("B = C", vec!["A C = I", "B A = I"]),
            ("x = A^{-1} (y - B u)", vec!["A x + B u = y"]),
            (
                r"x^\top (Q - P B R^{-1} B^\top P) x = x^\top (A^\top P + P A + 2 Q - 2 P B R^{-1} B^\top P) x",
                vec![r"A^\top P + P A - P B R^{-1} B^\top P + Q = 0"],
            ),
            (r"(A B)^\top = B A", vec![r"A^\top = A", r"B^\top = B"]),
            (r"Q^\top A Q Q^\top B Q = Q^\top A B Q", vec![r"Q Q^\top = I"]),
        ] {
            assert!(holds(claim, &premises), "{claim}");
        }
        for (claim, premises) in [
            ("C A = A A B", vec!["C = A B"]),
            ("B A = I", vec!["A B = I"]),
            ("x = (y - B u) A^{-1}", vec!["A x + B u = y"]),
            (r"(A B)^\top = A B", vec![r"A^\top = A", r"B^\top = B"]),
            (r"A Q^\top Q = A", vec![r"Q Q^\top = I"]),
            // nothing follows from what cannot be
            ("A = B", vec!["A + B = A + B + I"]),
        ] {
            assert!(!holds(claim, &premises), "{claim}");
        }
    }

    #[test]
    fn a_broken_proof_is_refused() {
        let operators = ["A", "B"].map(str::to_owned).into();
        let question = |claim: &str| word_question(&statements(claim, &[]), &operators, true).expect("words");
        let right = question("(A B)^{-1} = B^{-1} A^{-1}");
        let found = proof(&right).expect("a proof");
        assert!(kernel::prove_in_words(&right, &found).is_ok());
        let other = question("(A B)^{-1} = 2 B^{-1} A^{-1}");
        assert!(kernel::prove_in_words(&other, &found).is_err());
        for number in 0..found.lines.len() {
            let mut broken = found.clone();
            if let Some(multiple) = broken.lines[number].first_mut() {
                multiple.coefficient = multiple.coefficient.clone() + Rational::one();
                assert!(kernel::prove_in_words(&right, &broken).is_err(), "line {number}");
            }
        }
        let mut broken = found.clone();
        broken.point.values_mut().for_each(|value| *value = Rational::zero());
        assert!(kernel::prove_in_words(&right, &broken).is_err());
    }
}
