//! The tree of a formula, as written: nothing is simplified, nothing is known of what the names mean.

use crate::number::Rational;
use std::hash::{Hash, Hasher};

/// A name as an author writes it: `\dot{Z}_{k+1}^-` is base `Z`, accent `\dot`, subscript `k+1`, mark `-`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Name {
    /// A letter, a declared word or a command with its backslash: `Z`, `Tr`, `\epsilon`.
    pub base: String,
    /// Accents from the inside out, as commands with `\bar` written `\overline`: `["\dot"]`.
    pub accents: Vec<String>,
    /// The subscript without blanks, braces or font commands: `k+1`, `B`, `1,2`; empty where there is none.
    pub subscript: String,
    /// A superscript that is no power: `-` or `+` (just before, just after an impact), `*`, or a text such as `imp`; empty where there is none.
    pub mark: String,
    /// The number of primes.
    pub primes: u8,
}

/// A byte offset into the TeX a node was read from. It takes no part in comparisons.
#[derive(Clone, Copy, Debug, Default)]
pub struct At(pub usize);

impl PartialEq for At {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
impl Eq for At {}
impl Hash for At {
    fn hash<H: Hasher>(&self, _: &mut H) {}
}

/// Which number of a square matrix is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Invariant {
    Trace,
    Determinant,
}

/// A formula.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Tree {
    /// A number as printed; `0.26` is 13/50 exactly. Never negative.
    Number(Rational),
    Symbol(Name, At),
    /// A function's value: `F_1(t_{k+1})`, `\dot{Z}^-(t_k)`, `\cos(\pi t)`. The absolute value is the function `\abs`.
    Call(Name, Box<Tree>, At),
    /// `\frac{\partial of}{\partial by}`.
    Partial {
        of: Name,
        by: Name,
        at: At,
    },
    /// `Tr(DP)`, `Det(DP)`.
    Invariant {
        kind: Invariant,
        of: Name,
        at: At,
    },
    Negate(Box<Tree>),
    /// Two terms or more; a subtracted term is a `Negate`, one after `\pm` a `PlusMinus`.
    Sum(Vec<Tree>),
    /// Two factors or more.
    Product(Vec<Tree>),
    Quotient(Box<Tree>, Box<Tree>, At),
    /// An integer power.
    Power(Box<Tree>, i32, At),
    /// A power whose exponent is no multiple of 1/2 written as a number: `x^{1/3}`, `x^a`, `e^{-\zeta t}`. The letter
    /// `e` is a symbol like any other.
    RealPower(Box<Tree>, Box<Tree>, At),
    /// The root of this index, from 2 to 1000: `\sqrt{x}`, `\sqrt[3]{x}`.
    Root(Box<Tree>, u32, At),
    /// `\pm`: plus under the upper sign, minus under the lower.
    PlusMinus(Box<Tree>),
    /// `\mp`.
    MinusPlus(Box<Tree>),
}

/// How the two sides of an [`Equation`] compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub enum Relation {
    #[default]
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

/// An equation or inequality, and where in the TeX it starts and ends.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Equation {
    pub left: Tree,
    pub relation: Relation,
    pub right: Tree,
    pub at: At,
    pub end: At,
    /// Whether it stands behind "where" or "with".
    pub explains: bool,
}

impl Equation {
    /// An equation that stands in no TeX.
    pub fn between(left: Tree, right: Tree) -> Self {
        Self {
            left,
            relation: Relation::Equal,
            right,
            at: At::default(),
            end: At::default(),
            explains: false,
        }
    }
}

/// What a sheet assumes of its symbols.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[expect(clippy::large_enum_variant, reason = "a sheet holds few of them")]
pub enum Condition {
    /// An equation or inequality.
    Relation(Equation),
    /// `n \in \mathbb{Z}`: the expression is an integer.
    Integer(Tree),
}
