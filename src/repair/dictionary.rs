//! What may be missing in a formula: numbers, names, products and sums of names, longer parts of what is given.

use super::context::Context;
use super::edit::{number, pi, product, quotient, sum};
use super::path::size;
use crate::evidence::sampled::{Leaves, Number, Value, real};
use crate::number::{Field, Rational};
use crate::tex::{At, Name, Tree};
use std::collections::HashMap;

/// The most names of which products are formed, and the most of which sums of these are; and the most longer parts.
const MOST_ATOMS: usize = 24;
const MOST_SUMMED: usize = 14;
const MOST_PARTS: usize = 240;
/// The most nodes of a longer part.
const LONGEST: u32 = 24;
/// Numerators and denominators of the numbers.
const NUMBERS: std::ops::RangeInclusive<i64> = 1..=9;
/// The most pairs that are given of what makes up one value.
const MOST_PAIRS: usize = 4;

/// How close values must come to be those of an entry, and those of two entries together.
const CLOSE: f64 = 1e-7;
/// A number that is rounding.
const NOTHING: f64 = 1e-9;

/// A formula with its values.
#[derive(Clone, Debug)]
pub struct Entry {
    pub tree: Tree,
    values: Vec<Number>,
}

/// Formulas by their values.
#[derive(Debug, Default)]
pub struct Dictionary {
    /// In the order of the size of the first value.
    entries: Vec<Entry>,
    firsts: Vec<f64>,
}

/// What a value may be: one of several at each place.
#[derive(Clone, Debug, Default)]
pub struct Wanted {
    /// By place, the points there with the values at them.
    pub places: Vec<Vec<(usize, Number)>>,
}

impl Wanted {
    /// The same, with another value at each point.
    pub fn map(&self, new: impl Fn(usize, Number) -> Number) -> Self {
        let place = |place: &Vec<(usize, Number)>| place.iter().map(|(at, value)| (*at, new(*at, *value))).collect();
        Self {
            places: self.places.iter().map(place).collect(),
        }
    }

    /// Whether at each place a value is the wanted one.
    fn is_met(&self, value: impl Fn(usize) -> Number) -> bool {
        let is_it = |(at, wanted): &(usize, Number)| (value(*at) - wanted).norm() <= CLOSE * wanted.norm();
        self.places.iter().all(|place| place.iter().any(is_it))
    }
}

/// Everything that may be missing.
#[derive(Debug)]
pub struct Dictionaries {
    pub factors: Dictionary,
    pub terms: Dictionary,
    /// Short products, of which two make a sum.
    summands: Dictionary,
}

impl Dictionaries {
    pub fn new(context: &Context, leaves: &Leaves, definitions: &HashMap<Name, Tree>) -> Self {
        let (atoms, parts) = known(context, leaves, definitions);
        Self {
            factors: Dictionary::factors(&atoms, &parts, leaves.points),
            terms: Dictionary::terms(&atoms, &parts, leaves.points),
            summands: Dictionary::summands(&atoms, &parts, leaves.points),
        }
    }

    /// Finds what a factor may be, and whether it is negative: an entry, or where `joined` a product of two, a sum of two short
    /// products, or 1 and a product of two, none of them negative.
    pub fn factor(&self, wanted: &Wanted, joined: bool) -> Vec<(Tree, bool)> {
        if !joined {
            return signed(self.factors.find(wanted));
        }
        let mut found = self.factors.products(wanted);
        found.extend(self.sums(wanted));
        for sign in [1.0, -1.0] {
            let rest = wanted.map(|_, value| (value - 1.0) * sign);
            for tree in self.factors.products(&rest) {
                let tree = if sign < 0.0 { minus(&tree) } else { tree };
                found.push(sum(vec![number(1), tree]));
            }
        }
        shortest(found).into_iter().map(|tree| (tree, false)).collect()
    }

    /// What a term may be, with whether it is negative: an entry, or where `joined` a product of two, or a sum of two.
    pub fn term(&self, wanted: &Wanted, joined: bool) -> Vec<(Tree, bool)> {
        if !joined {
            return signed(self.terms.find(wanted));
        }
        let mut found: Vec<(Tree, bool)> = Vec::new();
        for negative in [false, true] {
            let of = wanted.map(|_, value| if negative { -value } else { value });
            found.extend(self.factors.products(&of).into_iter().map(|tree| (tree, negative)));
        }
        found.extend(self.sums(wanted).into_iter().map(|tree| (tree, false)));
        let opposite = wanted.map(|_, value| -value);
        found.extend(self.sums_of_positive(&opposite).into_iter().map(|tree| (tree, true)));
        // a sum times a value of a function
        for call in self
            .summands
            .entries
            .iter()
            .filter(|entry| matches!(entry.tree, Tree::Call(..)))
        {
            let sums = self.sums(&wanted.map(|at, value| value / call.at(at)));
            found.extend(
                sums.iter()
                    .map(|tree| (product(vec![tree.clone(), call.tree.clone()]), false)),
            );
        }
        found.sort_by_key(|(tree, _)| size(tree));
        found.truncate(MOST_PAIRS);
        found
    }

    /// The sums of two short products, and no differences.
    fn sums_of_positive(&self, wanted: &Wanted) -> Vec<Tree> {
        let mut found = self.sums(wanted);
        found.retain(
            |tree| !matches!(tree, Tree::Sum(terms) if terms.iter().any(|term| matches!(term, Tree::Negate(_)))),
        );
        found
    }

    /// The sums and differences of two short products.
    fn sums(&self, wanted: &Wanted) -> Vec<Tree> {
        let mut found = Vec::new();
        for one in &self.summands.entries {
            let rest = self.summands.find_after(wanted, |at, value| value - one.at(at));
            for (other, negative) in rest {
                // the positive one first, of two the longer
                if (negative || size(&one.tree) >= size(other)) && one.tree != *other {
                    let other = if negative { minus(other) } else { other.clone() };
                    found.push(sum(vec![one.tree.clone(), other]));
                }
            }
        }
        shortest(found)
    }
}

fn signed(found: Vec<(&Tree, bool)>) -> Vec<(Tree, bool)> {
    let found = found.into_iter();
    found.map(|(tree, negative)| (tree.clone(), negative)).collect()
}

fn shortest(mut found: Vec<Tree>) -> Vec<Tree> {
    found.sort_by_key(size);
    found.dedup();
    found.truncate(MOST_PAIRS);
    found
}

fn minus(tree: &Tree) -> Tree {
    Tree::Negate(Box::new(tree.clone()))
}

impl Dictionary {
    fn factors(atoms: &[Entry], parts: &[Entry], points: usize) -> Self {
        let mut entries = numbers(points);
        let one = number(1);
        for (n, atom) in atoms.iter().enumerate() {
            entries.push(atom.clone());
            if atom.is_constant() {
                let others = atoms.iter().filter(|other| !other.is_constant());
                entries.extend(others.map(|other| atom.by(other, |x, y| x * y, joined(&atom.tree, &other.tree))));
                continue;
            }
            let own = square(&atom.tree);
            entries.push(atom.by(atom, |x, _| x * x, own.clone()));
            entries.push(atom.by(atom, |x, _| x * 2.0, product(vec![number(2), atom.tree.clone()])));
            entries.push(atom.by(atom, |x, _| x / 2.0, quotient(atom.tree.clone(), number(2))));
            for other in atoms
                .get(n + 1..)
                .unwrap_or_default()
                .iter()
                .filter(|other| !other.is_constant())
            {
                let both = product(vec![atom.tree.clone(), other.tree.clone()]);
                entries.push(atom.by(other, |x, y| x * y, both.clone()));
                entries.push(atom.by(other, |x, y| x / y, quotient(atom.tree.clone(), other.tree.clone())));
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
                entries.push(atom.by(other, |x, y| real(1.0) + x * y, sum(vec![one.clone(), both.clone()])));
                entries.push(atom.by(other, |x, y| real(1.0) - x * y, sum(vec![one.clone(), minus(&both)])));
            }
            let plus = |tree: &Tree| sum(vec![one.clone(), tree.clone()]);
            entries.push(atom.by(atom, |x, _| real(1.0) + x, plus(&atom.tree)));
            entries.push(atom.by(atom, |x, _| real(1.0) - x, plus(&minus(&atom.tree))));
            entries.push(atom.by(atom, |x, _| real(1.0) + x * x, plus(&own)));
            entries.push(atom.by(atom, |x, _| real(1.0) - x * x, plus(&minus(&own))));
            let less = sum(vec![atom.tree.clone(), minus(&one)]);
            entries.push(atom.by(atom, |x, _| x - 1.0, less));
        }
        entries.extend_from_slice(parts);
        Self::of(entries)
    }

    fn terms(atoms: &[Entry], parts: &[Entry], points: usize) -> Self {
        let mut products: Vec<Entry> = atoms.to_vec();
        for (n, atom) in atoms.iter().enumerate() {
            for (m, other) in atoms.iter().enumerate().skip(n) {
                let two = atom.by(other, |x, y| x * y, joined(&atom.tree, &other.tree));
                for third in atoms.get(m..).unwrap_or_default() {
                    products.push(two.by(third, |x, y| x * y, joined(&two.tree, &third.tree)));
                }
                products.push(two);
            }
            for part in parts {
                products.push(atom.by(part, |x, y| x * y, joined(&atom.tree, &part.tree)));
            }
        }
        products.extend_from_slice(parts);
        let mut entries = numbers(points);
        entries.push(one(points));
        for entry in products {
            let half = quotient(entry.tree.clone(), number(2));
            let twice = product(vec![number(2), entry.tree.clone()]);
            entries.push(entry.by(&entry, |x, _| x / 2.0, half));
            entries.push(entry.by(&entry, |x, _| x * 2.0, twice));
            entries.push(entry);
        }
        Self::of(entries)
    }

    fn summands(atoms: &[Entry], parts: &[Entry], points: usize) -> Self {
        let mut entries = vec![one(points)];
        entries.extend_from_slice(atoms);
        let atoms = atoms.get(..MOST_SUMMED).unwrap_or(atoms);
        for (n, atom) in atoms.iter().enumerate() {
            for (m, other) in atoms.iter().enumerate().skip(n) {
                let two = atom.by(other, |x, y| x * y, joined(&atom.tree, &other.tree));
                for third in atoms.get(m..).unwrap_or_default() {
                    entries.push(two.by(third, |x, y| x * y, joined(&two.tree, &third.tree)));
                }
                entries.push(two);
            }
        }
        let products = parts.iter().filter(|part| !matches!(part.tree, Tree::Sum(_)));
        entries.extend(products.cloned());
        Self::of(entries)
    }

    fn of(mut entries: Vec<Entry>) -> Self {
        let is_finite = |value: &Number| value.re.is_finite() && value.im.is_finite() && value.norm() > 1e-12;
        entries.retain(|entry| entry.values.iter().all(is_finite));
        entries.sort_by(|a, b| a.at(0).norm().total_cmp(&b.at(0).norm()));
        let firsts = entries.iter().map(|entry| entry.at(0).norm()).collect();
        Self { entries, firsts }
    }

    /// The formulas that have the wanted values, and whether with the opposite sign.
    pub fn find(&self, wanted: &Wanted) -> Vec<(&Tree, bool)> {
        let mut found: Vec<(&Tree, bool)> = Vec::new();
        for first in wanted
            .places
            .first()
            .into_iter()
            .flatten()
            .map(|(_, value)| value.norm())
        {
            for entry in self.near(first) {
                for (sign, negative) in [(1.0, false), (-1.0, true)] {
                    if wanted.is_met(|at| entry.at(at) * sign) {
                        found.push((&entry.tree, negative));
                        break;
                    }
                }
            }
        }
        found.sort_by_key(|(tree, _)| size(tree));
        found.dedup();
        found
    }

    /// The entries whose first value has this size.
    fn near(&self, size: f64) -> impl Iterator<Item = &Entry> {
        let from = self.firsts.partition_point(|first| *first < size * (1.0 - CLOSE));
        let rest = self.firsts.get(from..).unwrap_or_default();
        let count = rest.iter().take_while(|first| **first <= size * (1.0 + CLOSE)).count();
        self.entries.get(from..from + count).unwrap_or_default().iter()
    }

    /// What is found once the wanted values are changed at each point.
    fn find_after(&self, wanted: &Wanted, new: impl Fn(usize, Number) -> Number) -> Vec<(&Tree, bool)> {
        let mut firsts = wanted.places.first().into_iter().flatten();
        match firsts.any(|(at, value)| self.near(new(*at, *value).norm()).next().is_some()) {
            true => self.find(&wanted.map(new)),
            false => Vec::new(),
        }
    }

    /// The products of two entries that have the wanted values, equal factors as a square.
    fn products(&self, wanted: &Wanted) -> Vec<Tree> {
        let mut found = Vec::new();
        for one in &self.entries {
            let rest = self.find_after(wanted, |at, value| value / one.at(at));
            for (other, _) in rest.into_iter().filter(|(_, negative)| !negative) {
                let is_first = matches!(one.tree, Tree::Number(_)) || !matches!(other, Tree::Number(_));
                match (&one.tree, other) {
                    (Tree::Quotient(above, below, _), Tree::Quotient(more, lower, _)) => {
                        found.push(quotient(joined(above, more), joined(below, lower)));
                    }
                    (Tree::Quotient(..), _) | (_, Tree::Quotient(..)) => {}
                    (one, other) if is_first => found.push(joined(one, other)),
                    _ => {}
                }
            }
        }
        shortest(found)
    }
}

impl Entry {
    fn by(&self, other: &Self, of: impl Fn(Number, Number) -> Number, tree: Tree) -> Self {
        let pairs = self.values.iter().zip(&other.values);
        Self {
            tree,
            values: pairs.map(|(x, y)| of(*x, *y)).collect(),
        }
    }

    /// Whether it has the same value at all points, as `e` and `i` have.
    fn is_constant(&self) -> bool {
        self.values.len() > 1 && self.values.iter().all(|value| *value == self.at(0))
    }

    fn at(&self, point: usize) -> Number {
        self.values
            .get(point)
            .copied()
            .unwrap_or(crate::evidence::sampled::UNDEFINED)
    }
}

fn one(points: usize) -> Entry {
    Entry {
        tree: number(1),
        values: vec![real(1.0); points],
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

/// The names and the longer parts that have values: those of the claim and its premises first.
fn known(context: &Context, leaves: &Leaves, definitions: &HashMap<Name, Tree>) -> (Vec<Entry>, Vec<Entry>) {
    let entry = |tree: &Tree| {
        let values = leaves.all(tree, definitions);
        let values: Option<Vec<Number>> = values.iter().map(Value::number).collect();
        let values = values.filter(|values| values.iter().all(|value| value.is_finite()))?;
        let tree = tree.clone();
        Some(Entry { tree, values })
    };
    let atoms = context.atoms.iter().filter_map(entry).take(MOST_ATOMS);
    // what has a name is called by it
    let is_named = |tree: &Tree| definitions.values().any(|meant| meant == tree);
    let parts = context.terms.iter().chain(&context.near);
    let parts = parts.filter(|tree| size(tree) <= LONGEST && !is_named(tree));
    (atoms.collect(), parts.filter_map(entry).take(MOST_PARTS).collect())
}

fn numbers(points: usize) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for above in NUMBERS {
        for below in NUMBERS {
            let value = real(above as f64 / below as f64);
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
    entries.push(Entry {
        tree: pi(),
        values: vec![real(std::f64::consts::PI); points],
    });
    entries
}

/// The number that has the wanted values, where it is a simple one.
pub fn number_of(wanted: &Wanted) -> Option<Tree> {
    let firsts = wanted.places.first()?.iter().map(|(_, value)| *value);
    firsts
        .filter(|first| first.im.abs() <= CLOSE * first.re.abs() + NOTHING)
        .find_map(|first| {
            let first = first.re;
            if wanted
                .places
                .iter()
                .all(|place| place.iter().any(|(_, value)| value.norm() < NOTHING))
            {
                return Some(number(0));
            }
            if !wanted.is_met(|_| real(first)) {
                return None;
            }
            (1..=60_i64).find_map(|below| {
                let above = (first * below as f64).round();
                let is_it = (above / below as f64 - first).abs() <= CLOSE * first.abs();
                let is_simple = above.abs() < 1e4 && above >= 0.0;
                (is_it && is_simple).then(|| Tree::Number(Rational::from_ratio(above as i64, below)))
            })
        })
}
