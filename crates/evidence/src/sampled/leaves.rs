//! Values of formulas at points where the premises hold, worked out from those of the names and calls in them.

use super::value::{Arithmetic, Number, Op, UNDEFINED, Value, rational, real, whole};
use numbers::{Field, Rational};
use std::cell::Cell;
use std::collections::{HashMap, HashSet};
use texmath::{Name, Operation, Series, Tree, pair_of, parts, with_symbol};

/// Definitions that are put into definitions, at most.
const DEEPEST: usize = 24;
/// The most terms of a sum, and how small three terms in a row must be for the rest of an infinite one to be left out.
const MOST_TERMS: i64 = 600;
const NEGLIGIBLE: f64 = 1e-14;
/// Steps of an integral over (0, 1) by the double exponential rule: Takahasi and Mori, Publ. RIMS 9 (1974) 721.
const STEP: f64 = 0.1;
const STEPS: i32 = 29;
/// How many steps there are for each of these over an interval without end.
const FINER: i32 = 4;
/// How near half the points must come to the integral.
const ROUGH: f64 = 1e-6;
/// The largest step of a central difference, and how often it is halved.
const DIFFERENCE: f64 = 0.04;
const HALVINGS: usize = 4;
/// The highest derivative that is worked out.
const HIGHEST: u32 = 2;
/// Nodes that may be evaluated within sums, integrals and derivatives.
const WORK: u64 = 40_000_000;

/// A value, and the sum of the sizes of the terms that it is the sum of.
#[derive(Clone, Debug)]
pub struct SizedValue {
    pub value: Value,
    pub size: f64,
}

/// Whether two sides are equal but for rounding.
pub fn agree(left: &SizedValue, right: &SizedValue) -> bool {
    super::value::agree(&left.value, &right.value, left.size + right.size)
}

/// The values of leaves at points.
#[derive(Debug)]
pub struct Leaves {
    pub values: HashMap<Tree, Vec<Number>>,
    pub points: usize,
    pub is_complex: bool,
    /// Whether each place is there as two points, one for each sign that `\pm` stands for.
    pub has_signs: bool,
    /// Whether a claim need only hold under one of them.
    pub is_either: bool,
    /// The letter of time, and what depends on it without showing it.
    pub running: Option<Name>,
    pub moving: HashSet<Tree>,
    pub work: Cell<u64>,
}

/// A letter that is bound around a formula, with its value.
#[derive(Clone, Copy)]
struct Binding<'a> {
    letter: &'a Name,
    value: Number,
    stands: Stands<'a>,
}

type Bound<'a> = &'a [Binding<'a>];

/// Where a bound letter stands, as a formula of what is not bound.
#[derive(Clone, Copy)]
enum Stands<'a> {
    /// Somewhere.
    Anywhere,
    /// At this part of the way from the first to the second.
    Between(&'a Tree, &'a Tree, f64),
    /// So far from here.
    Near(&'a Tree, f64),
}

impl Stands<'_> {
    fn tree(self) -> Option<Tree> {
        let number = |value: f64| {
            let (size, unit) = ((value.abs() * UNIT).round(), UNIT as i64);
            let tree = Tree::Number(Rational::from_ratio(size as i64, unit));
            if value < 0.0 {
                Tree::Negate(Box::new(tree))
            } else {
                tree
            }
        };
        let weighted = |by: f64, tree: &Tree| Tree::Product(vec![number(by), tree.clone()]);
        match self {
            Self::Anywhere => None,
            Self::Between(low, high, part) => Some(Tree::Sum(vec![weighted(1.0 - part, low), weighted(part, high)])),
            Self::Near(at, by) => Some(Tree::Sum(vec![at.clone(), number(by)])),
        }
    }
}

/// The denominator of numbers in formulas of where a letter stands.
const UNIT: f64 = (1_u64 << 52) as f64;

/// What a function is asked as where its argument is bound: with the formula of where the letter stands. Of a function
/// without its argument that is where the time stands.
fn standing(leaf: &Tree, letter: &Name, stands: Stands) -> Option<Tree> {
    let place = stands.tree()?;
    match leaf {
        Tree::Symbol(name, at) => Some(Tree::Call(name.clone(), Box::new(place), *at)),
        other => Some(with_symbol(other, letter, &place)),
    }
}

/// Takes what functions are asked as under the integrals and derivatives of a tree; `runs` says of a symbol whether it
/// is a function of the time.
pub fn take_standing(tree: &Tree, running: Option<&Name>, runs: &dyn Fn(&Tree) -> bool, into: &mut Vec<Tree>) {
    if let Tree::Operation(operation, _) = tree {
        let binds: Option<(_, _, Vec<Stands>)> = match &**operation {
            Operation::Integral {
                of,
                by,
                limits: Some((low, high)),
            } => {
                let parts = (-STEPS..=STEPS).map(|n| Stands::Between(low, high, abscissa(n, 1)[0]));
                Some((of, by, parts.collect()))
            }
            Operation::Derivative { of, by, order: 1, at } => {
                let near = differences().flat_map(|step| [Stands::Near(at, step), Stands::Near(at, -step)]);
                Some((of, by, near.collect()))
            }
            _ => None,
        };
        if let Some((of, letter, places)) = binds {
            let mut leaves = Vec::new();
            take_leaves(of, &HashSet::new(), &mut leaves);
            leaves.retain(|leaf| match leaf {
                Tree::Symbol(name, _) => name != letter && running == Some(letter) && runs(leaf),
                other => other.has_free(letter),
            });
            for leaf in leaves {
                into.extend(places.iter().filter_map(|place| standing(&leaf, letter, *place)));
            }
        }
    }
    parts(tree)
        .iter()
        .for_each(|part| take_standing(part, running, runs, into));
}

fn differences() -> impl Iterator<Item = f64> {
    (0..HALVINGS).map(|n| DIFFERENCE / f64::from(1 << n))
}

/// Of a point of the double exponential rule with a step so many times finer: its place in (0, 1), its distance from 1, its weight.
fn abscissa(n: i32, finer: i32) -> [f64; 3] {
    let step = STEP / f64::from(finer);
    let t = step * f64::from(n);
    let u = std::f64::consts::FRAC_PI_2 * t.sinh();
    let (part, rest) = (1.0 / (1.0 + (-2.0 * u).exp()), 1.0 / (1.0 + (2.0 * u).exp()));
    [part, rest, step * std::f64::consts::PI * t.cosh() * part * rest]
}

/// A point, and what the names mean there.
struct Place<'a> {
    point: usize,
    definitions: &'a HashMap<Name, Tree>,
    depth: usize,
}

/// Takes the leaves of a tree as they stand, again and again; names that definitions give are none.
pub fn take_leaves(tree: &Tree, defined: &HashSet<Name>, into: &mut Vec<Tree>) {
    match tree {
        Tree::Number(_) => {}
        Tree::Symbol(name, _) if defined.contains(name) => {}
        Tree::Symbol(..) | Tree::Partial { .. } | Tree::Invariant { .. } => into.push(tree.clone()),
        Tree::Call(..) if Op::of(tree).is_none() => into.push(tree.clone()),
        _ => parts(tree).iter().for_each(|part| take_leaves(part, defined, into)),
    }
}

/// What a leaf is asked as: of `x_{1,2}` it is `x`.
pub fn asked(leaf: &Tree) -> Tree {
    match leaf {
        Tree::Symbol(name, at) => Tree::Symbol(pair_of(name).unwrap_or_else(|| name.clone()), *at),
        other => other.clone(),
    }
}

impl Leaves {
    /// These values at these points.
    pub fn new(values: HashMap<Tree, Vec<Number>>, points: usize, is_complex: bool) -> Self {
        Self {
            values,
            points,
            is_complex,
            has_signs: false,
            is_either: false,
            running: None,
            moving: HashSet::new(),
            work: Cell::new(WORK),
        }
    }

    /// The same at each point under either sign.
    pub fn under_both_signs(mut self, is_either: bool) -> Self {
        for values in self.values.values_mut() {
            *values = values.iter().flat_map(|value| [*value, *value]).collect();
        }
        (self.points, self.has_signs, self.is_either) = (2 * self.points, true, is_either);
        self
    }

    /// Keeps the points, or pairs of these, of which one passes the test.
    pub fn keep(&mut self, test: impl Fn(usize) -> bool) {
        let passes: Vec<bool> = (0..self.points).map(test).collect();
        let pair = if self.has_signs { 2 } else { 1 };
        let kept = |point: usize| {
            passes
                .chunks(pair)
                .nth(point / pair)
                .is_some_and(|all| all.contains(&true))
        };
        for values in self.values.values_mut() {
            let all = values.iter().enumerate();
            *values = all.filter(|(point, _)| kept(*point)).map(|(_, value)| *value).collect();
        }
        self.points = (0..self.points).filter(|point| kept(*point)).count();
    }

    /// Whether something holds at all places.
    pub fn everywhere(&self, mut holds: impl FnMut(usize) -> bool) -> bool {
        match self.has_signs && self.is_either {
            false => (0..self.points).all(holds),
            true => (0..self.points / 2).all(|place| holds(2 * place) || holds(2 * place + 1)),
        }
    }

    pub fn arithmetic(&self, point: usize) -> Arithmetic {
        Arithmetic {
            is_complex: self.is_complex,
            upper: !self.has_signs || point.is_multiple_of(2),
        }
    }

    /// The value of a tree at a point, names replaced by their definitions.
    pub fn value(&self, tree: &Tree, point: usize, definitions: &HashMap<Name, Tree>) -> Value {
        let place = Place {
            point,
            definitions,
            depth: 0,
        };
        self.value_in(tree, &place, &[])
    }

    /// The values of a tree at all points.
    pub fn all(&self, tree: &Tree, definitions: &HashMap<Name, Tree>) -> Vec<Value> {
        let points = 0..self.points;
        points.map(|point| self.value(tree, point, definitions)).collect()
    }

    /// The values of a tree at all points, each with the size of its terms.
    pub fn sized(&self, tree: &Tree, definitions: &HashMap<Name, Tree>) -> Vec<SizedValue> {
        let points = 0..self.points;
        points
            .map(|point| SizedValue {
                value: self.value(tree, point, definitions),
                size: self.size(tree, point, definitions),
            })
            .collect()
    }

    fn size(&self, tree: &Tree, point: usize, definitions: &HashMap<Name, Tree>) -> f64 {
        match tree {
            Tree::Sum(terms) => terms.iter().map(|term| self.size(term, point, definitions)).sum(),
            Tree::Negate(body) => self.size(body, point, definitions),
            _ => self.value(tree, point, definitions).size(),
        }
    }

    fn value_in(&self, tree: &Tree, place: &Place, bound: Bound) -> Value {
        if !bound.is_empty() {
            let Some(left) = self.work.get().checked_sub(1) else {
                return Value::UNDEFINED;
            };
            self.work.set(left);
        }
        let of = |part: &Tree| self.value_in(part, place, bound);
        match tree {
            Tree::Number(value) => Value::Number(real(rational(value))),
            Tree::Symbol(name, _) => match bound.iter().rev().find(|binding| binding.letter == name) {
                Some(binding) => Value::Number(binding.value),
                None => match place.definitions.get(name) {
                    Some(meant) if place.depth < DEEPEST => {
                        let deeper = Place {
                            depth: place.depth + 1,
                            ..*place
                        };
                        self.value_in(meant, &deeper, bound)
                    }
                    Some(_) => Value::UNDEFINED,
                    None => self.leaf(tree, place.point, bound),
                },
            },
            Tree::Sum(terms) => match terms.split_first() {
                Some((first, rest)) => rest.iter().fold(of(first), |sum, term| sum.plus(of(term))),
                None => Value::Number(real(0.0)),
            },
            Tree::Product(factors) => match factors.split_first() {
                Some((first, rest)) => rest.iter().fold(of(first), |all, factor| all.times(of(factor))),
                None => Value::Number(real(1.0)),
            },
            _ => match (Op::of(tree), tree) {
                (Some(op), _) => {
                    let inner = parts(tree);
                    let part = |n: usize| inner.get(n).map_or(Value::UNDEFINED, of);
                    self.arithmetic(place.point).apply(op, inner.len(), part)
                }
                (None, Tree::Operation(operation, _)) => self.operation(operation, place, bound),
                (None, _) => self.leaf(tree, place.point, bound),
            },
        }
    }

    /// The value of a leaf; where it changes with a letter that is bound, that for where the letter stands.
    fn leaf(&self, tree: &Tree, point: usize, bound: Bound) -> Value {
        let value = |tree: &Tree| self.values.get(tree).and_then(|values| values.get(point)).copied();
        let moves = |binding: &&Binding| {
            tree.has_free_letter(binding.letter)
                || (self.running.as_ref() == Some(binding.letter) && self.moving.contains(tree))
        };
        let mut moving = bound.iter().filter(moves);
        let found = match (moving.next(), moving.next()) {
            (None, _) => value(tree),
            (Some(binding), None) => standing(tree, binding.letter, binding.stands).and_then(|tree| value(&tree)),
            _ => None,
        };
        Value::Number(found.unwrap_or(UNDEFINED))
    }

    /// What binds a letter: sums, integrals, derivatives.
    fn operation(&self, operation: &Operation, place: &Place, bound: Bound) -> Value {
        let number = |tree: &Tree| self.value_in(tree, place, bound).number().unwrap_or(UNDEFINED);
        let with = |of: &Tree, letter: &Name, value: Number, stands: Stands| {
            let mut inner = bound.to_vec();
            inner.push(Binding { letter, value, stands });
            self.value_in(of, place, &inner)
        };
        match operation {
            Operation::Series {
                kind,
                of,
                index,
                from,
                to,
            } => {
                let is_endless = matches!(to, Tree::Operation(to, _) if matches!(**to, Operation::Infinity));
                let to = if is_endless { None } else { Some(whole(number(to))) };
                let (Some(from), None | Some(Some(_))) = (whole(number(from)), to) else {
                    return Value::UNDEFINED;
                };
                let to = to.flatten();
                if to.is_some_and(|to| to - from > MOST_TERMS) {
                    return Value::UNDEFINED;
                }
                let (mut all, mut small) = (None, 0);
                for n in from..=to.unwrap_or(from + MOST_TERMS) {
                    let next = with(of, index, real(n as f64), Stands::Anywhere);
                    if !next.is_finite() {
                        return Value::UNDEFINED;
                    }
                    let size = next.size();
                    let joined: Value = match (all, kind) {
                        (None, _) => next,
                        (Some(all), Series::Sum) => Value::plus(all, next),
                        (Some(all), Series::Product) => Value::times(all, next),
                    };
                    small = match size <= NEGLIGIBLE * joined.size() {
                        true => small + 1,
                        false => 0,
                    };
                    all = Some(joined);
                    if to.is_none() && *kind == Series::Sum && small == 3 {
                        break;
                    }
                }
                let none = match kind {
                    Series::Sum => 0.0,
                    Series::Product => 1.0,
                };
                match to.is_some() || small == 3 {
                    true => all.unwrap_or(Value::Number(real(none))),
                    false => Value::UNDEFINED,
                }
            }
            Operation::Integral {
                of,
                by,
                limits: Some((low, high)),
            } => {
                let from = number(low);
                let is_endless = matches!(high, Tree::Operation(high, _) if matches!(**high, Operation::Infinity));
                let to = if is_endless { from } else { number(high) };
                let finer = if is_endless { FINER } else { 1 };
                over_unit_interval(finer, |part: f64, rest: f64| match is_endless {
                    true => {
                        let slope = real(1.0 / (rest * rest));
                        with(of, by, from + part / rest, Stands::Anywhere).times(Value::Number(slope))
                    }
                    false => {
                        let stands = Stands::Between(low, high, part);
                        with(of, by, from * rest + to * part, stands).times(Value::Number(to - from))
                    }
                })
            }
            Operation::Derivative { of, by, order, at } if *order <= HIGHEST => {
                let centre = number(at);
                derivative(*order, centre, &|value| {
                    let stands = match order {
                        1 => Stands::Near(at, (value - centre).re),
                        _ => Stands::Anywhere,
                    };
                    with(of, by, value, stands)
                })
            }
            _ => Value::UNDEFINED,
        }
    }
}

/// The integral over (0, 1) of a function that is given a point and its distance from 1; it has no value where half the
/// points give another one: the error of the rule is then squared.
fn over_unit_interval(finer: i32, of: impl Fn(f64, f64) -> Value) -> Value {
    let mut sums = [None, None];
    for n in -STEPS * finer..=STEPS * finer {
        let [part, rest, weight] = abscissa(n, finer);
        let term = of(part, rest).times(Value::Number(real(weight)));
        if !term.is_finite() {
            return Value::UNDEFINED;
        }
        let sum = &mut sums[n.unsigned_abs() as usize % 2];
        *sum = Some(match sum.take() {
            None => term,
            Some(sum) => Value::plus(sum, term),
        });
    }
    let [Some(even), Some(odd)] = sums else {
        return Value::UNDEFINED;
    };
    let (gap, all) = (even.clone().plus(odd.clone().negated()), even.plus(odd));
    match gap.size() <= ROUGH * (1.0 + all.size()) {
        true => all,
        false => Value::UNDEFINED,
    }
}

/// The derivative by central differences, extrapolated to steps of length 0.
fn derivative(order: u32, at: Number, of: &dyn Fn(Number) -> Value) -> Value {
    let Some(lower) = order.checked_sub(1) else {
        return of(at);
    };
    let scaled = |value: Value, by: f64| value.times(Value::Number(real(by)));
    let mut row: Vec<Value> = Vec::new();
    for step in differences() {
        let ends = [at + step, at - step].map(|at| derivative(lower, at, of));
        let [above, below] = ends;
        let mut next = vec![scaled(above.plus(below.negated()), 0.5 / step)];
        for (n, before) in row.iter().enumerate() {
            let weight = 4_f64.powi(n as i32 + 1);
            let last = next.last().cloned().unwrap_or(Value::UNDEFINED);
            next.push(scaled(
                scaled(last, weight).plus(before.clone().negated()),
                1.0 / (weight - 1.0),
            ));
        }
        row = next;
    }
    row.pop().unwrap_or(Value::UNDEFINED)
}
