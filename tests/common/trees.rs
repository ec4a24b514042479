//! Random trees, such as the reader makes them, and values for all their names.

use proptest::collection::vec;
use proptest::prelude::*;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use vibro_audit::number::{Field, Rational};
use vibro_audit::tex::{At, Doubts, Equation, Invariant, Name, Relation, Scope, Tree, Unsupported, evaluate};

fn word(choices: &'static [&'static str]) -> impl Strategy<Value = String> {
    prop::sample::select(choices).prop_map(str::to_owned)
}

/// Any name, functions included.
pub fn name() -> impl Strategy<Value = Name> {
    let accents = prop::sample::select(vec![vec![], vec![], vec!["\\dot"], vec!["\\overline", "\\ddot"]]);
    (
        word(&["a", "b", "T", "r", "e", "f", "F", "Z", "\\epsilon", "\\phi", "eta"]),
        accents,
        word(&[
            "", "", "k", "k+1", "1", "B", "1,2", "in", "\\phi k", "k_1", "*", "\\lambda",
        ]),
        word(&["", "", "", "-", "+", "*", "imp", "(1)", "U"]),
        prop::sample::select(vec![0u8, 0, 0, 1, 2]),
    )
        .prop_map(|(base, accents, subscript, mark, primes)| Name {
            base,
            accents: accents.into_iter().map(str::to_owned).collect(),
            subscript,
            mark,
            primes,
        })
}

/// A name that is a function in the vocabulary of the tests, or an elementary one.
fn function() -> impl Strategy<Value = Name> {
    let heads = prop::sample::select(vec![("f", "", ""), ("F", "", "1"), ("Z", "\\dot", ""), ("Z", "", "")]);
    let declared = (heads, name()).prop_map(|((base, accent, subscript), scripts)| Name {
        base: base.into(),
        accents: [accent]
            .iter()
            .filter(|accent| !accent.is_empty())
            .map(ToString::to_string)
            .collect(),
        subscript: subscript.into(),
        ..scripts
    });
    let elementary = word(&[
        "\\cos", "\\sin", "\\exp", "\\coth", "\\arcosh", "\\sgn", "\\abs", "\\abs",
    ])
    .prop_map(|base| Name {
        base,
        ..Name::default()
    });
    prop_oneof![3 => declared, 1 => elementary]
}

fn number() -> impl Strategy<Value = Tree> {
    (0u32..2000, 0usize..4).prop_map(|(digits, places)| {
        let text = format!("{digits:05}");
        let (whole, fraction) = text.split_at(text.len() - places);
        Tree::Number(Rational::from_decimal(&format!("{whole}.{fraction}")).expect("a decimal"))
    })
}

fn leaf() -> impl Strategy<Value = Tree> {
    let invariant = prop::sample::select(vec![Invariant::Trace, Invariant::Determinant]);
    let matrix = Name {
        base: "DP".into(),
        ..Name::default()
    };
    prop_oneof![
        2 => number(),
        4 => name().prop_map(|name| Tree::Symbol(name, At::default())),
        1 => (name(), name()).prop_map(|(of, by)| Tree::Partial { of, by, at: At::default() }),
        1 => invariant.prop_map(move |kind| Tree::Invariant { kind, of: matrix.clone(), at: At::default() }),
    ]
}

/// Whether the reader takes an exponent for a number, which makes a power of another kind where it is a multiple of 1/2.
fn is_literal(exponent: &Tree) -> bool {
    let number = |tree: &Tree| matches!(tree, Tree::Number(_));
    match exponent {
        Tree::Number(_) => true,
        Tree::Quotient(above, below, _) => number(above) && number(below),
        Tree::Negate(body) => is_literal(body),
        _ => false,
    }
}

/// Any equation or inequality that a reader might make.
pub fn equation() -> impl Strategy<Value = Equation> {
    let relation = prop::sample::select(vec![
        Relation::Equal,
        Relation::NotEqual,
        Relation::Less,
        Relation::LessOrEqual,
        Relation::Greater,
        Relation::GreaterOrEqual,
    ]);
    (tree(), relation, tree()).prop_map(|(left, relation, right)| Equation {
        left,
        relation,
        right,
        at: At::default(),
        end: At::default(),
        explains: false,
        doubts: Doubts::default(),
    })
}

/// Any tree that a reader might make.
pub fn tree() -> impl Strategy<Value = Tree> {
    leaf().prop_recursive(5, 40, 3, |inner| {
        let boxed = || inner.clone().prop_map(Box::new);
        prop_oneof![
            3 => vec(inner.clone(), 2..4).prop_map(Tree::Sum),
            3 => vec(inner.clone(), 2..5).prop_map(Tree::Product),
            2 => boxed().prop_map(Tree::Negate),
            2 => (boxed(), boxed()).prop_map(|(above, below)| Tree::Quotient(above, below, At::default())),
            2 => (boxed(), -3i32..13).prop_map(|(base, exponent)| Tree::Power(base, exponent, At::default())),
            1 => (boxed(), prop::sample::select(vec![2u32, 2, 3, 1000])).prop_map(|(radicand, index)| Tree::Root(radicand, index, At::default())),
            2 => (boxed(), boxed()).prop_filter("no multiple of 1/2 written as a number", |(_, exponent)| !is_literal(exponent))
                .prop_map(|(base, exponent)| Tree::RealPower(base, exponent, At::default())),
            1 => boxed().prop_map(Tree::PlusMinus),
            1 => boxed().prop_map(Tree::MinusPlus),
            2 => (function(), boxed()).prop_map(|(name, argument)| Tree::Call(name, argument, At::default())),
        ]
    })
}

/// Gives each name a value of its own, and each function a rule.
pub struct Hashed;

fn hashed(what: impl Hash) -> Rational {
    let mut hasher = DefaultHasher::new();
    what.hash(&mut hasher);
    let bits = hasher.finish();
    let small = |bits: u64| i64::try_from(bits % 7).unwrap_or(0) + 1;
    Rational::from_ratio(small(bits), small(bits >> 8))
}

impl Scope<Rational> for Hashed {
    type Error = Unsupported;

    fn symbol(&mut self, name: &Name) -> Result<Rational, Unsupported> {
        Ok(hashed(name))
    }
    fn call(&mut self, function: &Name, argument: &Tree) -> Result<Rational, Unsupported> {
        let argument = evaluate(argument, self).map_err(|_| Unsupported::Call(function.clone()))?;
        Ok(argument * hashed(function) + Rational::from_integer(1))
    }
    fn partial(&mut self, of: &Name, by: &Name) -> Result<Rational, Unsupported> {
        Ok(hashed((of, by)))
    }
    fn invariant(&mut self, kind: Invariant, of: &Name) -> Result<Rational, Unsupported> {
        Ok(hashed((kind, of)))
    }
    fn root(&mut self, radicand: Rational, index: u32) -> Result<Rational, Unsupported> {
        Ok(radicand * Rational::from_integer(i64::from(index) + 1))
    }
    fn real_power(&mut self, base: Rational, exponent: Rational) -> Result<Rational, Unsupported> {
        Ok(base * Rational::from_integer(5) - exponent)
    }
    fn upper_sign(&self) -> Option<bool> {
        Some(true)
    }
}

/// `tree` with products of products and sums of sums made one, for comparing spellings.
pub fn flat(tree: &Tree) -> Tree {
    let boxed = |tree: &Tree| Box::new(flat(tree));
    match tree {
        Tree::Product(factors) => Tree::Product(
            factors
                .iter()
                .flat_map(|factor| match flat(factor) {
                    Tree::Product(inner) => inner,
                    other => vec![other],
                })
                .collect(),
        ),
        Tree::Sum(terms) => Tree::Sum(terms.iter().map(flat).collect()),
        Tree::Negate(body) => Tree::Negate(boxed(body)),
        Tree::PlusMinus(body) => Tree::PlusMinus(boxed(body)),
        Tree::MinusPlus(body) => Tree::MinusPlus(boxed(body)),
        Tree::Quotient(above, below, at) => Tree::Quotient(boxed(above), boxed(below), *at),
        Tree::Power(base, exponent, at) => Tree::Power(boxed(base), *exponent, *at),
        Tree::RealPower(base, exponent, at) => Tree::RealPower(boxed(base), boxed(exponent), *at),
        Tree::Root(radicand, index, at) => Tree::Root(boxed(radicand), *index, *at),
        Tree::Call(name, argument, at) => Tree::Call(name.clone(), boxed(argument), *at),
        leaf => leaf.clone(),
    }
}
