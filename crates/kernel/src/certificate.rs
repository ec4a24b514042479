//! Certificates: the forms that the kernel accepts, as data.

use super::axiom::Axiom;
use super::polynomial::Polynomial;
use super::statement::Property;
use super::term::{Symbol, Term};
use numbers::Rational;

/// A proof: terms that stay whole, and steps of which each adds one fact (or one law) to those known.
#[derive(Clone, Debug, Default)]
pub struct Certificate {
    /// Terms that polynomials keep as generators although they could be expanded.
    pub whole: Vec<Term>,
    pub steps: Vec<Inference>,
}

/// Where a law comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawSource {
    /// A given law, its index moved on.
    Given { given: usize, shift: i32 },
    /// A law that an earlier step derived, by its number.
    Derived(usize),
}

/// A summand of a sign proof: a positive number times facts that are not negative times a square.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Summand {
    pub factor: Rational,
    /// Numbers of facts, each `Positive` or `NonNegative`.
    pub facts: Vec<usize>,
    pub root: Polynomial,
}

/// One step of a proof. Facts are numbered in the order in which steps add them.
#[derive(Clone, Debug, PartialEq)]
pub enum Inference {
    /// A given that is no law.
    Given(usize),
    /// An instance of a law at a time; none for laws that run over indices only.
    Law { source: LawSource, at: Option<Term> },
    /// An instance of an axiom.
    Axiom(Axiom),
    /// A whole term, or the symbol of an abbreviation, is what it stands for.
    Unfold(Term),
    /// A polynomial without symbols and unknown functions is positive, by an enclosure of its value.
    Enclosure(Polynomial),
    /// `target` is positive wherever its letters lie between the facts `within`, of each letter two that are not negative: a
    /// positive multiple of the letter plus a number, and a negative one.
    Between {
        target: Polynomial,
        within: Vec<[usize; 2]>,
    },
    /// `target` is 0: the product of the nonzero `factors` times (target^power + sum of `squares`) is the combination
    /// of the `terms`, each a coefficient and the number of a fact `Zero`. Squares need an even power, and real numbers.
    Zero {
        target: Polynomial,
        power: u32,
        squares: Vec<(Rational, Polynomial)>,
        factors: Vec<(usize, u32)>,
        terms: Vec<(Polynomial, usize)>,
    },
    /// `target` is not 0: `cofactor` times it is the product of the nonzero `factors` plus the combination of `terms`.
    Nonzero {
        target: Polynomial,
        cofactor: Polynomial,
        factors: Vec<(usize, u32)>,
        terms: Vec<(Polynomial, usize)>,
    },
    /// `target` is positive (`strict`) or not negative: the product of the positive `factors` times it is the sum of
    /// `summands` plus the combination of `terms`; if strict, one summand has positive facts only and a root without
    /// generators.
    Sign {
        target: Polynomial,
        strict: bool,
        factors: Vec<(usize, u32)>,
        summands: Vec<Summand>,
        terms: Vec<(Polynomial, usize)>,
    },
    /// What is neither positive nor negative is 0: the numbers of the two facts `NonNegative`.
    Squeezed { low: usize, high: usize },
    /// Equal arguments have equal values: the two terms are the same function of two terms whose difference is 0.
    Congruence { left: Term, right: Term },
    /// `property` holds of `target` in every case: `on` is 0 or not; with `order`, it is positive, 0 or negative.
    Cases {
        on: Polynomial,
        order: bool,
        property: Property,
        target: Polynomial,
        branches: Vec<Vec<Inference>>,
    },
    /// The law that follows by differentiating a law with respect to its time.
    Derivative(LawSource),
    /// The law that `of`, a term in the symbol `time`, has the value at `time` that it has at `at`: its derivative is 0
    /// by the steps, at every time, and it is differentiable there.
    Constant {
        of: Term,
        time: Symbol,
        at: Term,
        /// The interval that the law is for; none for the whole real line.
        interval: Option<i32>,
        steps: Vec<Inference>,
    },
    /// A term in generic symbols alone is not 0: a thin set is excluded. The point of a proof must lie outside it.
    Generic(Term),
    /// An equation that determines implicit quantities, differentiated by one that these depend on.
    Along {
        implicit: usize,
        equation: usize,
        by: Symbol,
    },
}

impl Inference {
    /// The polynomials that it speaks of, without those of steps within it.
    pub fn polynomials(&self) -> Vec<&Polynomial> {
        fn coefficients(terms: &[(Polynomial, usize)]) -> impl Iterator<Item = &Polynomial> {
            terms.iter().map(|(coefficient, _)| coefficient)
        }
        match self {
            Self::Enclosure(polynomial) => vec![polynomial],
            Self::Zero {
                target, squares, terms, ..
            } => {
                let roots = squares.iter().map(|(_, root)| root);
                roots.chain(coefficients(terms)).chain([target]).collect()
            }
            Self::Nonzero {
                target,
                cofactor,
                terms,
                ..
            } => coefficients(terms).chain([target, cofactor]).collect(),
            Self::Sign {
                target,
                summands,
                terms,
                ..
            } => {
                let roots = summands.iter().map(|summand| &summand.root);
                roots.chain(coefficients(terms)).chain([target]).collect()
            }
            Self::Cases { on, target, .. } => vec![on, target],
            Self::Between { target, .. } => vec![target],
            _ => Vec::new(),
        }
    }

    /// The terms that it names, without those of polynomials and of steps within it.
    pub fn terms(&self) -> Vec<Term> {
        match self {
            Self::Law { at, .. } => at.iter().copied().collect(),
            Self::Axiom(axiom) => axiom.terms.clone(),
            Self::Unfold(term) | Self::Generic(term) => vec![*term],
            Self::Congruence { left, right } => vec![*left, *right],
            Self::Constant { of, at, .. } => vec![*of, *at],
            _ => Vec::new(),
        }
    }

    /// The steps within it.
    pub fn within(&self) -> Vec<&Self> {
        match self {
            Self::Cases { branches, .. } => branches.iter().flatten().collect(),
            Self::Constant { steps, .. } => steps.iter().collect(),
            _ => Vec::new(),
        }
    }
}
