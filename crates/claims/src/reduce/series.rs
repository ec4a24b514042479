//! Series of real powers of one small quantity with trees as coefficients, and the numbers that say what is worth a proof.

use super::build::{call, integer, negative, power, product, quotient, real_power, root, sum};
use numbers::{Field, Rational};
use std::collections::BTreeMap;
use texmath::{Elementary, Equation, Name, Relation, Tree, number_of};

/// A sum of coefficients times powers of a small positive quantity, the largest term first.
#[derive(Clone, Debug)]
pub(super) struct Series {
    /// Exponents and coefficients; no coefficient is written as 0.
    pub terms: Vec<(Tree, Tree)>,
    /// The exponent from which on nothing is known; `None` where the terms are all there is.
    pub end: Option<Tree>,
}

impl Series {
    pub fn zero() -> Self {
        Self {
            terms: Vec::new(),
            end: None,
        }
    }

    /// Returns a coefficient times a power of the small quantity.
    pub fn term(exponent: Tree, coefficient: Tree) -> Self {
        let terms = [(exponent, coefficient)];
        Self {
            terms: terms.into_iter().filter(|(_, own)| !is_zero(own)).collect(),
            end: None,
        }
    }

    pub fn constant(tree: Tree) -> Self {
        Self::term(integer(0), tree)
    }

    /// Returns the exponent of the first term, known or not; `None` for 0.
    pub fn low(&self) -> Option<&Tree> {
        self.terms.first().map(|(exponent, _)| exponent).or(self.end.as_ref())
    }

    /// Returns the series times a coefficient and a power of the small quantity.
    pub fn shifted(&self, by: &Tree, factor: &Tree) -> Self {
        let up = |exponent: &Tree| add(vec![exponent.clone(), by.clone()]);
        let terms = self.terms.iter();
        let terms = terms.map(|(exponent, own)| (up(exponent), multiply(vec![factor.clone(), own.clone()])));
        Self {
            terms: terms.filter(|(_, own)| !is_zero(own)).collect(),
            end: self.end.as_ref().map(up),
        }
    }

    pub fn scaled(&self, factor: &Tree) -> Self {
        self.shifted(&integer(0), factor)
    }
}

/// Returns the tree, a number where it is written with numbers.
pub(super) fn tidy(tree: Tree) -> Tree {
    match number_of(&tree) {
        Some(value) => number(&value),
        None => tree,
    }
}

pub(super) fn number(value: &Rational) -> Tree {
    let zero = Rational::from_integer(0);
    match *value < zero {
        true => Tree::Negate(Box::new(Tree::Number(zero - value.clone()))),
        false => Tree::Number(value.clone()),
    }
}

pub(super) fn ratio(above: i64, below: i64) -> Tree {
    number(&(Rational::from_integer(above) / Rational::from_integer(below)))
}

pub(super) fn is_zero(tree: &Tree) -> bool {
    number_of(tree) == Some(Rational::from_integer(0))
}

pub(super) fn is_one(tree: &Tree) -> bool {
    number_of(tree) == Some(Rational::from_integer(1))
}

/// Returns the factor of a tree that is a number, and the rest; nothing where all of it is one.
fn parts(tree: &Tree) -> (Rational, Option<Tree>) {
    let one = Rational::from_integer(1);
    if let Some(value) = number_of(tree) {
        return (value, None);
    }
    match tree {
        Tree::Negate(inner) => {
            let (factor, rest) = parts(inner);
            (-factor, rest)
        }
        Tree::Product(factors) => {
            let mut total = one;
            let mut rest = Vec::new();
            for factor in factors {
                let (own, left) = parts(factor);
                total *= own;
                match left {
                    Some(Tree::Product(inner)) => rest.extend(inner),
                    left => rest.extend(left),
                }
            }
            match total == Rational::from_integer(0) {
                true => (total, None),
                false => (total, Some(product(rest))),
            }
        }
        Tree::Quotient(above, below, _) => {
            let (up, above) = parts(above);
            let (down, below) = parts(below);
            // a divisor that is 0 stays as it stands
            if down == Rational::from_integer(0) {
                return (one, Some(tree.clone()));
            }
            if up == Rational::from_integer(0) {
                return (up, None);
            }
            let above = above.unwrap_or_else(|| integer(1));
            let rest = below.map_or(above.clone(), |below| quotient(above, below));
            (up / down, Some(rest))
        }
        tree => (one, Some(tree.clone())),
    }
}

/// Collects the terms of a sum, each a number times a tree or 1.
fn terms_of(tree: &Tree, factor: &Rational, found: &mut Vec<(Rational, Option<Tree>)>) {
    let (own, rest) = parts(tree);
    let factor = own * factor.clone();
    match rest {
        Some(Tree::Sum(terms)) => terms.iter().for_each(|term| terms_of(term, &factor, found)),
        rest => match found.iter_mut().find(|(_, known)| *known == rest) {
            Some((total, _)) => *total += factor,
            None => found.push((factor, rest)),
        },
    }
}

fn times_number(factor: &Rational, tree: Tree) -> Tree {
    let one = Rational::from_integer(1);
    match *factor {
        _ if *factor == one => tree,
        _ if *factor == -one => negative(tree),
        _ if *factor < Rational::from_integer(0) => negative(product(vec![number(&-factor.clone()), tree])),
        _ => product(vec![number(factor), tree]),
    }
}

/// Returns the sum, with equal terms as one.
pub(super) fn add(terms: Vec<Tree>) -> Tree {
    let mut found = Vec::new();
    let one = Rational::from_integer(1);
    terms.iter().for_each(|term| terms_of(term, &one, &mut found));
    let zero = Rational::from_integer(0);
    found.retain(|(factor, _)| *factor != zero);
    let tree = |(factor, rest): (Rational, Option<Tree>)| match rest {
        Some(rest) => times_number(&factor, rest),
        None => number(&factor),
    };
    sum(found.into_iter().map(tree).collect())
}

/// Returns the product, with its numbers as one.
pub(super) fn multiply(factors: Vec<Tree>) -> Tree {
    match parts(&Tree::Product(factors)) {
        (factor, Some(rest)) => times_number(&factor, rest),
        (factor, None) => number(&factor),
    }
}

pub(super) fn divide(above: Tree, below: Tree) -> Tree {
    tidy(quotient(above, below))
}

/// Returns a tree to a power that is a number or a tree.
pub(super) fn power_of(first: Tree, exponent: &Tree) -> Tree {
    let half = number_of(exponent);
    match super::integers::whole(exponent).and_then(|whole| i32::try_from(whole).ok()) {
        _ if is_one(&first) => first,
        Some(whole) if whole >= 0 => tidy(power(first, whole)),
        Some(whole) => divide(integer(1), power(first, -whole)),
        None if half == Some(Rational::from_ratio(1, 2)) => root(first),
        None if half == number_of(&ratio(-1, 2)) => quotient(integer(1), root(first)),
        None => real_power(first, exponent.clone()),
    }
}

/// Returns the value of a function, a number at 0, 1 and quarter turns.
pub(super) fn value_at(function: &str, argument: Tree) -> Tree {
    let is_odd = Elementary::by_command(function).is_some_and(|own| own.parity == Some(texmath::Parity::Odd));
    // quarter turns
    if let (turns, Some(Tree::Symbol(name, _))) = parts(&argument)
        && name.base == "\\pi"
        && let Some(quarters) = (turns * Rational::from_integer(2)).to_integer()
    {
        match (function, quarters.rem_euclid(4)) {
            ("\\sin", 0 | 2) | ("\\cos", 1 | 3) => return integer(0),
            ("\\sin", 1) | ("\\cos", 0) => return integer(1),
            ("\\sin", 3) | ("\\cos", 2) => return integer(-1),
            _ => {}
        }
    }
    match function {
        _ if is_odd && is_zero(&argument) => integer(0),
        "\\cos" | "\\cosh" if is_zero(&argument) => integer(1),
        "\\ln" if is_one(&argument) => integer(0),
        "\\exp" if is_zero(&argument) => integer(1),
        _ => call(function, argument),
    }
}

/// Returns the number e to a power.
pub(super) fn exponential_of(exponent: Tree) -> Tree {
    match is_zero(&exponent) {
        true => integer(1),
        false => call("\\exp", exponent),
    }
}

/// Returns a number for a name, the same at each time.
pub(super) fn seed(name: &Name) -> f64 {
    hashed(&name.to_string())
}

pub(super) fn hashed(text: &str) -> f64 {
    let hash = text.bytes().fold(2_166_136_261_u32, |hash, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(16_777_619)
    });
    0.4 + f64::from(hash % 1009) / 1009.0
}

/// Returns a value where symbols have values, to tell what is worth a proof: nothing rests on it.
pub(super) fn guess_at(tree: &Tree, of: &dyn Fn(&Name) -> Option<f64>) -> Option<f64> {
    let value = |tree: &Tree| guess_at(tree, of);
    let all = |trees: &[Tree]| trees.iter().map(value).collect::<Option<Vec<f64>>>();
    Some(match tree {
        Tree::Number(number) => number.0.to_f64().value(),
        Tree::Symbol(name, _) => match name.base.as_str() {
            "\\pi" => std::f64::consts::PI,
            "e" => std::f64::consts::E,
            _ => of(name)?,
        },
        Tree::Negate(inner) => -value(inner)?,
        Tree::Sum(terms) => all(terms)?.into_iter().sum(),
        Tree::Product(factors) => all(factors)?.into_iter().product(),
        Tree::Quotient(above, below, _) => value(above)? / value(below)?,
        Tree::Power(base, exponent, _) => value(base)?.powi(*exponent),
        Tree::RealPower(base, exponent, _) => value(base)?.powf(value(exponent)?),
        Tree::Root(radicand, index, _) => value(radicand)?.powf(1.0 / f64::from(*index)),
        Tree::Call(name, argument, _) => {
            let at = value(argument)?;
            match Elementary::named(name) {
                Some(function) => (function.real)(at),
                None => hashed(&format!("{name} {at:.9}")),
            }
        }
        _ => return None,
    })
}

/// Returns true if a tree is 0 as far as can be seen where symbols have values.
pub(super) fn vanishes_at(tree: &Tree, of: &dyn Fn(&Name) -> Option<f64>) -> Option<bool> {
    let value = guess_at(tree, of).filter(|value| value.is_finite())?;
    let terms: &[Tree] = match tree {
        Tree::Sum(terms) => terms,
        _ => &[],
    };
    let size: f64 = terms.iter().filter_map(|term| guess_at(term, of)).map(f64::abs).sum();
    Some(value.abs() < 1e-9 * size.max(1e-6))
}

/// Returns true if a tree is likely to be 0: nothing rests on it.
pub(super) fn is_likely_zero(tree: &Tree) -> bool {
    is_zero(tree) || vanishes_at(tree, &|name| Some(seed(name))) == Some(true)
}

/// Returns numbers for letters, which meet the conditions if some are found.
pub(super) fn point_of(names: &[Name], conditions: &[&Equation], symbols: &texmath::Symbols) -> BTreeMap<Name, f64> {
    let mut point = BTreeMap::new();
    for attempt in 0..400_u32 {
        for name in names {
            let one = match attempt {
                0 => seed(name),
                _ => hashed(&format!("{name} {attempt}")),
            };
            let scale = [1.0, 1.0, 0.5, 3.0, 10.0, 30.0]
                .get(attempt as usize % 6)
                .copied()
                .unwrap_or(1.0);
            let is_negative = attempt > 8 && hashed(&format!("sign {attempt} {name}")) > 0.9;
            let value = if is_negative && !symbols.is_positive(name) {
                -one * scale
            } else {
                one * scale
            };
            let value = if symbols.is_integer(name) {
                (3.0 * value).ceil()
            } else {
                value
            };
            point.insert(name.clone(), value);
        }
        let of = |name: &Name| point.get(name).copied();
        let holds = |condition: &&Equation| {
            let (left, right) = (guess_at(&condition.left, &of), guess_at(&condition.right, &of));
            let (Some(left), Some(right)) = (left, right) else {
                return true;
            };
            match condition.relation {
                Relation::Equal => (left - right).abs() < 1e-9,
                Relation::NotEqual => (left - right).abs() > 1e-9,
                Relation::Less => left < right,
                Relation::LessOrEqual => left <= right,
                Relation::Greater => left > right,
                Relation::GreaterOrEqual => left >= right,
            }
        };
        if conditions.iter().all(holds) {
            break;
        }
    }
    point
}

pub(super) fn relation(left: Tree, relation: Relation) -> Equation {
    Equation {
        relation,
        ..Equation::between(left, integer(0))
    }
}

/// Returns true if both sides are numbers of which the relation holds.
pub(super) fn holds_of_numbers(condition: &Equation) -> bool {
    let (Some(left), Some(right)) = (number_of(&condition.left), number_of(&condition.right)) else {
        return false;
    };
    match condition.relation {
        Relation::Equal => left == right,
        Relation::NotEqual => left != right,
        Relation::Less => left < right,
        Relation::LessOrEqual => left <= right,
        Relation::Greater => left > right,
        Relation::GreaterOrEqual => left >= right,
    }
}
