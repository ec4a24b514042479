//! What may be missing in a formula: numbers, names, products and sums of names, longer parts of what is given.

use super::context::Context;
use super::edit::{number, product, quotient, sum};
use super::path::size;
use super::values::Leaves;
use crate::number::{Field, Rational};
use crate::tex::{At, Name, Tree};
use std::collections::HashMap;

/// The most names of which products are formed, and the most longer parts.
const MOST_ATOMS: usize = 24;
const MOST_PARTS: usize = 80;
/// The most nodes of a longer part.
const LONGEST: u32 = 24;
/// Numerators and denominators of the numbers.
const NUMBERS: std::ops::RangeInclusive<i64> = 1..=9;

/// How close values must come to be those of an entry.
const CLOSE: f64 = 1e-7;

/// A formula with its values.
#[derive(Clone, Debug)]
pub struct Entry {
    pub tree: Tree,
    values: Vec<f64>,
}

/// Formulas by their values.
#[derive(Debug, Default)]
pub struct Dictionary {
    /// In the order of the size of the first value.
    entries: Vec<Entry>,
}

impl Dictionary {
    /// What a factor may be.
    pub fn factors(context: &Context, leaves: &Leaves, definitions: &HashMap<Name, Tree>) -> Self {
        let (atoms, parts) = known(context, leaves, definitions);
        let mut entries = numbers(leaves.points);
        let one = number(1);
        for (n, atom) in atoms.iter().enumerate() {
            entries.push(atom.clone());
            entries.push(atom.by(atom, |x, y| x * y, square(&atom.tree)));
            for other in atoms.get(n + 1..).unwrap_or_default() {
                let both = product(vec![atom.tree.clone(), other.tree.clone()]);
                entries.push(atom.by(other, |x, y| x * y, both.clone()));
                entries.push(atom.by(other, |x, y| x / y, quotient(atom.tree.clone(), other.tree.clone())));
                let minus = |tree: &Tree| Tree::Negate(Box::new(tree.clone()));
                let (x, y) = (atom.tree.clone(), other.tree.clone());
                entries.push(atom.by(other, |x, y| x + y, sum(vec![x.clone(), y.clone()])));
                let squares = [square(&x), square(&y)];
                let [one_square, other_square] = squares;
                let less = sum(vec![one_square.clone(), minus(&other_square)]);
                entries.push(atom.by(other, |x, y| x * x + y * y, sum(vec![one_square, other_square])));
                entries.push(atom.by(other, |x, y| x * x - y * y, less));
                entries.push(atom.by(other, |x, y| x - y, sum(vec![x.clone(), minus(&y)])));
                entries.push(atom.by(other, |x, y| y - x, sum(vec![y, minus(&x)])));
                entries.push(atom.by(other, |x, y| y / x, quotient(other.tree.clone(), atom.tree.clone())));
                entries.push(atom.by(other, |x, y| 1.0 + x * y, sum(vec![one.clone(), both.clone()])));
                entries.push(atom.by(other, |x, y| 1.0 - x * y, sum(vec![one.clone(), minus(&both)])));
            }
            let minus = Tree::Negate(Box::new(atom.tree.clone()));
            entries.push(atom.by(atom, |x, _| 1.0 + x, sum(vec![one.clone(), atom.tree.clone()])));
            entries.push(atom.by(atom, |x, _| 1.0 - x, sum(vec![one.clone(), minus])));
            let less = sum(vec![atom.tree.clone(), Tree::Negate(Box::new(one.clone()))]);
            entries.push(atom.by(atom, |x, _| x - 1.0, less));
        }
        entries.extend(parts);
        Self::of(entries)
    }

    /// What a term may be, but for its sign.
    pub fn terms(context: &Context, leaves: &Leaves, definitions: &HashMap<Name, Tree>) -> Self {
        let (atoms, parts) = known(context, leaves, definitions);
        let mut products: Vec<Entry> = atoms.clone();
        for (n, atom) in atoms.iter().enumerate() {
            for (m, other) in atoms.iter().enumerate().skip(n) {
                let two = atom.by(other, |x, y| x * y, joined(&atom.tree, &other.tree));
                for third in atoms.get(m..).unwrap_or_default() {
                    products.push(two.by(third, |x, y| x * y, joined(&two.tree, &third.tree)));
                }
                products.push(two);
            }
            for part in &parts {
                products.push(atom.by(part, |x, y| x * y, joined(&atom.tree, &part.tree)));
            }
        }
        products.extend(parts);
        let mut entries = numbers(leaves.points);
        entries.push(Entry {
            tree: number(1),
            values: vec![1.0; leaves.points],
        });
        for entry in products {
            let half = quotient(entry.tree.clone(), number(2));
            let twice = product(vec![number(2), entry.tree.clone()]);
            entries.push(entry.by(&entry, |x, _| x / 2.0, half));
            entries.push(entry.by(&entry, |x, _| x * 2.0, twice));
            entries.push(entry);
        }
        Self::of(entries)
    }

    fn of(mut entries: Vec<Entry>) -> Self {
        entries.retain(|entry| entry.values.iter().all(|value| value.is_finite() && *value != 0.0));
        let first = |entry: &Entry| entry.values.first().map_or(0.0, |value| value.abs());
        entries.sort_by(|a, b| first(a).total_cmp(&first(b)));
        Self { entries }
    }

    /// The formulas that at each point have one of these values, and whether with the opposite sign.
    pub fn find(&self, values: &[Vec<f64>]) -> Vec<(&Tree, bool)> {
        let of = |entry: &Entry| entry.values.first().map_or(0.0, |value| value.abs());
        let mut found: Vec<(&Tree, bool)> = Vec::new();
        for first in values
            .iter()
            .filter_map(|values| values.first().map(|value| value.abs()))
        {
            let from = self.entries.partition_point(|entry| of(entry) < first * (1.0 - CLOSE));
            let near = self.entries.get(from..).unwrap_or_default();
            for entry in near.iter().take_while(|entry| of(entry) <= first * (1.0 + CLOSE)) {
                let is_it = |own: f64, wanted: f64| (own - wanted).abs() <= CLOSE * wanted.abs();
                let fits = |sign: f64| {
                    let mut points = entry.values.iter().enumerate();
                    points.all(|(point, own)| {
                        let mut wanted = values.iter().filter_map(|values| values.get(point));
                        wanted.any(|wanted| is_it(own * sign, *wanted))
                    })
                };
                if fits(1.0) {
                    found.push((&entry.tree, false));
                } else if fits(-1.0) {
                    found.push((&entry.tree, true));
                }
            }
        }
        found.sort_by_key(|(tree, _)| size(tree));
        found.dedup();
        found
    }
}

impl Entry {
    fn by(&self, other: &Self, of: impl Fn(f64, f64) -> f64, tree: Tree) -> Self {
        let pairs = self.values.iter().zip(&other.values);
        Self {
            tree,
            values: pairs.map(|(x, y)| of(*x, *y)).collect(),
        }
    }
}

fn square(tree: &Tree) -> Tree {
    Tree::Power(Box::new(tree.clone()), 2, At::default())
}

/// The product of two formulas, equal factors as a square.
fn joined(one: &Tree, other: &Tree) -> Tree {
    match one {
        _ if one == other => square(one),
        Tree::Product(factors) if factors.last() == Some(other) => {
            let mut factors = factors.clone();
            factors.pop();
            factors.push(square(other));
            product(factors)
        }
        Tree::Power(base, 2, at) if **base == *other => Tree::Power(base.clone(), 3, *at),
        _ => product(vec![one.clone(), other.clone()]),
    }
}

/// The names and the longer parts that have values.
fn known(context: &Context, leaves: &Leaves, definitions: &HashMap<Name, Tree>) -> (Vec<Entry>, Vec<Entry>) {
    let entry = |tree: &Tree| Entry {
        tree: tree.clone(),
        values: leaves.all(tree, definitions),
    };
    let has_values = |entry: &Entry| entry.values.iter().all(|value| value.is_finite());
    let atoms = context.atoms.iter().map(entry).filter(has_values).take(MOST_ATOMS);
    let short = context.terms.iter().filter(|tree| size(tree) <= LONGEST);
    let parts = short.map(entry).filter(has_values).take(MOST_PARTS);
    (atoms.collect(), parts.collect())
}

fn numbers(points: usize) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for above in NUMBERS {
        for below in NUMBERS {
            let value = above as f64 / below as f64;
            let is_known = |entry: &Entry| entry.values.first() == Some(&value);
            if above == below || entries.iter().any(is_known) {
                continue;
            }
            let tree = match below {
                1 => number(above),
                _ => quotient(number(above), number(below)),
            };
            let values = vec![value; points];
            entries.push(Entry { tree, values });
        }
    }
    let pi = Name {
        base: r"\pi".to_owned(),
        ..Name::default()
    };
    entries.push(Entry {
        tree: Tree::Symbol(pi, At::default()),
        values: vec![std::f64::consts::PI; points],
    });
    entries
}

/// The number that values are, where it is one and a simple one.
pub fn number_of(values: &[f64]) -> Option<Tree> {
    let first = *values.first()?;
    if values.iter().any(|value| (value - first).abs() > CLOSE * first.abs()) {
        return None;
    }
    (1..=60_i64).find_map(|below| {
        let above = (first * below as f64).round();
        let is_it = (above / below as f64 - first).abs() <= CLOSE * first.abs();
        let is_simple = above.abs() < 1e4 && above >= 0.0;
        (is_it && is_simple).then(|| Tree::Number(Rational::from_ratio(above as i64, below)))
    })
}
