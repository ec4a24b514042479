//! The tree of a formula, as written: nothing is simplified, nothing is known of what the names mean.

use super::Doubts;
use numbers::Rational;
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

impl Name {
    /// The name of this letter, word or command with nothing at it.
    pub fn plain(base: &str) -> Self {
        Self {
            base: base.to_owned(),
            ..Self::default()
        }
    }

    /// The name without subscript, mark and primes.
    pub fn bare(&self) -> Self {
        Self {
            base: self.base.clone(),
            accents: self.accents.clone(),
            ..Self::default()
        }
    }

    /// The name of the derivative by time: one dot more.
    pub fn dotted(&self) -> Self {
        let mut name = self.clone();
        match name.accents.last_mut() {
            Some(last) if last == r"\dot" => *last = r"\ddot".to_string(),
            Some(last) if last == r"\ddot" => *last = r"\dddot".to_string(),
            _ => name.accents.push(r"\dot".to_string()),
        }
        name
    }

    /// The name without its dots.
    pub fn without_dots(&self) -> Self {
        let mut name = self.clone();
        name.accents.retain(|accent| !accent.ends_with("dot"));
        name
    }
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
    /// A function's value: `F_1(t_{k+1})`, `\dot{Z}^-(t_k)`, `\cos(\pi t)`; that of a function of several arguments has one
    /// [`Operation::Arguments`]. The absolute value is the function `\abs`.
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
    /// What is no function of numbers alone: it binds a letter, or holds rows.
    Operation(Box<Operation>, At),
}

/// Matrices, derivatives, integrals, finite sums and products, values by cases.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Operation {
    /// The formulas between the brackets of a function of several arguments: two or more.
    Arguments(Vec<Tree>),
    /// Rows of equal length, one or more.
    Matrix(Vec<Vec<Tree>>),
    Determinant(Tree),
    Trace(Tree),
    /// `A^\top`.
    Transpose(Tree),
    /// The root of this index, which is no number: `\sqrt[n]{x}`.
    Root {
        of: Tree,
        index: Tree,
    },
    /// `\vec{a} \times \vec{b}`, `\vec{a} \cdot \vec{b}`; of numbers their product.
    Cross(Tree, Tree),
    Dot(Tree, Tree),
    /// `\binom{n}{k}`: the coefficient of x^k in (1 + x)^n.
    Binomial(Tree, Tree),
    /// The derivative of this order of `of` by `by`, at the value `at` of it; that of order 0 is the value there.
    Derivative {
        of: Tree,
        by: Name,
        order: u32,
        at: Tree,
    },
    /// `\int_a^b of \, d by`, whose limits may be infinite; without limits any antiderivative.
    Integral {
        of: Tree,
        by: Name,
        limits: Option<(Tree, Tree)>,
    },
    /// `\sum_{index = from}^{to} of`, or `\prod`.
    Series {
        kind: Series,
        of: Tree,
        index: Name,
        from: Tree,
        to: Tree,
    },
    /// `\lim_{by \to to} of`.
    Limit {
        of: Tree,
        by: Name,
        to: Tree,
    },
    /// `O(x^2)`, and `o(x^2)` if true.
    Order(Tree, bool),
    /// What the left side of a condition `x \to 0` tends to.
    Approaches(Tree),
    /// `0^+`, from above, or `0^-`.
    OneSided(Tree, bool),
    /// `\infty`.
    Infinity,
    /// The value of the first case whose conditions hold.
    Cases(Vec<Case>),
}

/// What a series does with its terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Series {
    Sum,
    Product,
}

/// A value and the conditions under which it is meant; none for what is meant otherwise.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Case {
    pub value: Tree,
    pub conditions: Vec<Condition>,
}

impl Tree {
    /// The node with each part directly below it replaced.
    pub fn map(&self, new: &mut dyn FnMut(&Self) -> Self) -> Self {
        let mut boxed = |tree: &Self| Box::new(new(tree));
        match self {
            Self::Number(_) | Self::Symbol(..) | Self::Partial { .. } | Self::Invariant { .. } => self.clone(),
            Self::Call(name, argument, at) => Self::Call(name.clone(), boxed(argument), *at),
            Self::Negate(inner) => Self::Negate(boxed(inner)),
            Self::Sum(terms) => Self::Sum(terms.iter().map(new).collect()),
            Self::Product(factors) => Self::Product(factors.iter().map(new).collect()),
            Self::Quotient(above, below, at) => Self::Quotient(boxed(above), boxed(below), *at),
            Self::Power(base, exponent, at) => Self::Power(boxed(base), *exponent, *at),
            Self::RealPower(base, exponent, at) => Self::RealPower(boxed(base), boxed(exponent), *at),
            Self::Root(inner, index, at) => Self::Root(boxed(inner), *index, *at),
            Self::PlusMinus(inner) => Self::PlusMinus(boxed(inner)),
            Self::MinusPlus(inner) => Self::MinusPlus(boxed(inner)),
            Self::Operation(operation, at) => Self::Operation(Box::new(operation.map(&mut |part, _| new(part))), *at),
        }
    }
}

impl Tree {
    /// What the test finds first among the parts directly below it.
    pub fn find_below<'t, T>(&'t self, test: &mut dyn FnMut(&'t Self) -> Option<T>) -> Option<T> {
        match self {
            Self::Number(_) | Self::Symbol(..) | Self::Partial { .. } | Self::Invariant { .. } => None,
            Self::Call(_, inner, _)
            | Self::Negate(inner)
            | Self::Power(inner, ..)
            | Self::Root(inner, ..)
            | Self::PlusMinus(inner)
            | Self::MinusPlus(inner) => test(inner),
            Self::Sum(parts) | Self::Product(parts) => parts.iter().find_map(test),
            Self::Quotient(above, below, _) | Self::RealPower(above, below, _) => test(above).or_else(|| test(below)),
            Self::Operation(operation, _) => operation.parts().into_iter().find_map(|(part, _)| test(part)),
        }
    }

    /// The arguments that stand in the brackets of a call: this one, or the parts of [`Operation::Arguments`].
    pub fn arguments(&self) -> &[Self] {
        match self {
            Self::Operation(operation, _) => match &**operation {
                Operation::Arguments(several) => several,
                _ => std::slice::from_ref(self),
            },
            one => std::slice::from_ref(one),
        }
    }

    /// The letter of the sum, product or limit that it ends in: what follows may belong to that.
    pub(crate) fn open_letter(&self) -> Option<&Name> {
        match self {
            Self::Product(factors) => factors.last()?.open_letter(),
            Self::Negate(inner) | Self::PlusMinus(inner) | Self::MinusPlus(inner) => inner.open_letter(),
            Self::Operation(operation, _) => match &**operation {
                Operation::Series { index, .. } => Some(index),
                Operation::Limit { by, .. } => Some(by),
                _ => None,
            },
            _ => None,
        }
    }

    /// Whether a symbol stands in it where no operation binds it.
    pub fn has_free(&self, name: &Name) -> bool {
        self.has_free_that(name, &|other| other == name)
    }

    /// Whether a letter stands in it, as a symbol or first in a subscript, where no operation binds it.
    pub fn has_free_letter(&self, letter: &Name) -> bool {
        self.has_free_that(letter, &|other| {
            other == letter || other.subscript.starts_with(&letter.base)
        })
    }

    fn has_free_that(&self, letter: &Name, test: &dyn Fn(&Name) -> bool) -> bool {
        match self {
            Self::Symbol(other, _) => test(other),
            Self::Operation(operation, _) => {
                let parts = operation.parts().into_iter();
                let mut free = parts.filter(|(_, is_bound)| !(*is_bound && operation.letter() == Some(letter)));
                free.any(|(part, _)| part.has_free_that(letter, test))
            }
            tree => tree
                .find_below(&mut |part| part.has_free_that(letter, test).then_some(()))
                .is_some(),
        }
    }
}

impl Operation {
    /// The letter that it binds in some of its [`parts`](Self::parts).
    pub fn letter(&self) -> Option<&Name> {
        match self {
            Self::Derivative { by, .. } | Self::Integral { by, .. } | Self::Limit { by, .. } => Some(by),
            Self::Series { index, .. } => Some(index),
            _ => None,
        }
    }

    /// Its parts in the order of writing, and whether the letter that it binds is its own there.
    pub fn parts(&self) -> Vec<(&Tree, bool)> {
        let free = |tree| (tree, false);
        match self {
            Self::Arguments(parts) => parts.iter().map(free).collect(),
            Self::Matrix(rows) => rows.iter().flatten().map(free).collect(),
            Self::Determinant(of)
            | Self::Trace(of)
            | Self::Transpose(of)
            | Self::Order(of, _)
            | Self::Approaches(of)
            | Self::OneSided(of, _) => vec![free(of)],
            Self::Infinity => Vec::new(),
            Self::Limit { of, to, .. } => vec![free(to), (of, true)],
            Self::Cross(left, right) | Self::Dot(left, right) | Self::Binomial(left, right) => {
                vec![free(left), free(right)]
            }
            Self::Root { of, index } => vec![free(index), free(of)],
            Self::Derivative { of, at, .. } => vec![(of, true), free(at)],
            Self::Integral { of, limits, .. } => {
                let limits = limits.iter().flat_map(|(low, high)| [free(low), free(high)]);
                limits.chain([(of, true)]).collect()
            }
            Self::Series { of, from, to, .. } => vec![free(from), free(to), (of, true)],
            Self::Cases(cases) => cases.iter().flat_map(Case::parts).map(free).collect(),
        }
    }

    /// The operation with each of its parts replaced; the second argument is whether the letter is bound there.
    #[must_use]
    pub fn map(&self, new: &mut dyn FnMut(&Tree, bool) -> Tree) -> Self {
        match self {
            Self::Arguments(parts) => Self::Arguments(parts.iter().map(|part| new(part, false)).collect()),
            Self::Matrix(rows) => Self::Matrix(
                rows.iter()
                    .map(|row| row.iter().map(|part| new(part, false)).collect())
                    .collect(),
            ),
            Self::Determinant(of) => Self::Determinant(new(of, false)),
            Self::Trace(of) => Self::Trace(new(of, false)),
            Self::Transpose(of) => Self::Transpose(new(of, false)),
            Self::Order(of, is_little) => Self::Order(new(of, false), *is_little),
            Self::Approaches(of) => Self::Approaches(new(of, false)),
            Self::OneSided(of, is_above) => Self::OneSided(new(of, false), *is_above),
            Self::Infinity => Self::Infinity,
            Self::Limit { of, by, to } => Self::Limit {
                to: new(to, false),
                of: new(of, true),
                by: by.clone(),
            },
            Self::Cross(left, right) => Self::Cross(new(left, false), new(right, false)),
            Self::Dot(left, right) => Self::Dot(new(left, false), new(right, false)),
            Self::Binomial(of, chosen) => Self::Binomial(new(of, false), new(chosen, false)),
            Self::Root { of, index } => Self::Root {
                index: new(index, false),
                of: new(of, false),
            },
            Self::Derivative { of, by, order, at } => Self::Derivative {
                of: new(of, true),
                by: by.clone(),
                order: *order,
                at: new(at, false),
            },
            Self::Integral { of, by, limits } => Self::Integral {
                limits: limits.as_ref().map(|(low, high)| (new(low, false), new(high, false))),
                of: new(of, true),
                by: by.clone(),
            },
            Self::Series {
                kind,
                of,
                index,
                from,
                to,
            } => Self::Series {
                kind: *kind,
                from: new(from, false),
                to: new(to, false),
                of: new(of, true),
                index: index.clone(),
            },
            Self::Cases(cases) => Self::Cases(cases.iter().map(|case| case.map(new)).collect()),
        }
    }

    /// The operation with another letter bound, in what stands there too.
    #[must_use]
    pub fn with_letter(&self, letter: Name) -> Self {
        let mut renamed = self.clone();
        match &mut renamed {
            Self::Derivative { by, .. } | Self::Integral { by, .. } | Self::Limit { by, .. } => *by = letter,
            Self::Series { index, .. } => *index = letter,
            _ => {}
        }
        renamed
    }
}

impl Case {
    fn parts(&self) -> Vec<&Tree> {
        let conditions = self.conditions.iter().flat_map(Condition::sides);
        std::iter::once(&self.value).chain(conditions).collect()
    }

    fn map(&self, new: &mut dyn FnMut(&Tree, bool) -> Tree) -> Self {
        let mut condition = |condition: &Condition| match condition {
            Condition::Relation(relation) => Condition::Relation(Equation {
                left: new(&relation.left, false),
                right: new(&relation.right, false),
                ..relation.clone()
            }),
            Condition::Integer(tree) => Condition::Integer(new(tree, false)),
        };
        Self {
            conditions: self.conditions.iter().map(&mut condition).collect(),
            value: new(&self.value, false),
        }
    }
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

impl Relation {
    /// The relation of the sides in the other order.
    pub fn turned(self) -> Self {
        match self {
            Self::Equal => Self::Equal,
            Self::NotEqual => Self::NotEqual,
            Self::Less => Self::Greater,
            Self::LessOrEqual => Self::GreaterOrEqual,
            Self::Greater => Self::Less,
            Self::GreaterOrEqual => Self::LessOrEqual,
        }
    }
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
    /// The places of its display that have more than one meaning.
    pub doubts: Doubts,
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
            doubts: Doubts::default(),
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

impl Condition {
    /// The formulas that it is about.
    pub fn sides(&self) -> Vec<&Tree> {
        match self {
            Self::Relation(relation) => vec![&relation.left, &relation.right],
            Self::Integer(tree) => vec![tree],
        }
    }
}
