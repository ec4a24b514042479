//! Values of formulas at points, and what becomes of the two sides when single nodes take other values.

use super::path::{Path, parts};
use crate::number::Rational;
use crate::tex::{Equation, Name, Tree};
use std::collections::{HashMap, HashSet};

/// A difference below this part of what it is the difference of is taken for rounding.
const ROUNDING: f64 = 1e-7;

/// Steps of the secant method.
const MOST_SECANTS: usize = 16;

/// The last operation of a node.
#[derive(Clone, Copy, Debug)]
enum Op {
    /// What is evaluated as a whole.
    Leaf,
    /// A name that a definition gives.
    Same,
    Negate,
    Sum,
    Product,
    Quotient,
    Power(i32),
    RealPower,
    Root(u32),
    Function(fn(f64) -> f64),
}

impl Op {
    fn of(tree: &Tree) -> Self {
        match tree {
            Tree::Negate(_) => Self::Negate,
            Tree::Sum(_) => Self::Sum,
            Tree::Product(_) => Self::Product,
            Tree::Quotient(..) => Self::Quotient,
            Tree::Power(_, exponent, _) => Self::Power(*exponent),
            Tree::RealPower(..) => Self::RealPower,
            Tree::Root(_, index, _) => Self::Root(*index),
            Tree::Call(name, ..) => elementary(name).map_or(Self::Leaf, Self::Function),
            _ => Self::Leaf,
        }
    }

    fn apply(self, count: usize, part: impl Fn(usize) -> f64) -> f64 {
        match self {
            Self::Leaf => f64::NAN,
            Self::Same => part(0),
            Self::Negate => -part(0),
            Self::Sum => (0..count).map(part).sum(),
            Self::Product => (0..count).map(part).product(),
            Self::Quotient => part(0) / part(1),
            Self::Power(exponent) => part(0).powi(exponent),
            Self::RealPower => part(0).powf(part(1)),
            Self::Root(2) => part(0).sqrt(),
            Self::Root(index) if index % 2 == 1 => {
                let base = part(0);
                base.signum() * base.abs().powf(1.0 / f64::from(index))
            }
            Self::Root(index) => part(0).powf(1.0 / f64::from(index)),
            Self::Function(function) => function(part(0)),
        }
    }
}

fn elementary(name: &Name) -> Option<fn(f64) -> f64> {
    let plain = Name {
        base: name.base.clone(),
        ..Name::default()
    };
    if plain != *name {
        return None;
    }
    Some(match name.base.as_str() {
        r"\sin" => f64::sin,
        r"\cos" => f64::cos,
        r"\tan" => f64::tan,
        r"\cot" => |x| 1.0 / x.tan(),
        r"\exp" => f64::exp,
        r"\ln" => f64::ln,
        r"\sinh" => f64::sinh,
        r"\cosh" => f64::cosh,
        r"\tanh" => f64::tanh,
        r"\arcsin" => f64::asin,
        r"\arccos" => f64::acos,
        r"\arctan" => f64::atan,
        r"\abs" => f64::abs,
        _ => return None,
    })
}

fn float(value: &Rational) -> f64 {
    value.0.to_f64().value()
}

/// A value, and the sum of the sizes of the terms that it is the sum of.
#[derive(Clone, Copy, Debug)]
pub struct Sized {
    pub value: f64,
    pub size: f64,
}

/// Whether two sides are equal but for rounding.
pub fn agree(left: Sized, right: Sized) -> bool {
    (left.value - right.value).abs() <= ROUNDING * (left.size + right.size)
}

/// The values of leaves at points.
#[derive(Debug, Default)]
pub struct Leaves {
    pub values: HashMap<Tree, Vec<f64>>,
    pub points: usize,
}

/// Takes the leaves of a tree as they stand, again and again; names that definitions give are none.
pub fn take_leaves(tree: &Tree, defined: &HashSet<Name>, into: &mut Vec<Tree>) {
    match tree {
        Tree::Number(_) => {}
        Tree::Symbol(name, _) if defined.contains(name) => {}
        _ if matches!(Op::of(tree), Op::Leaf) => {
            into.push(tree.clone());
        }
        _ => parts(tree).iter().for_each(|part| take_leaves(part, defined, into)),
    }
}

/// Definitions that are put into definitions, at most.
const DEEPEST: usize = 24;

impl Leaves {
    /// The value of a tree at a point, names replaced by their definitions.
    pub fn value(&self, tree: &Tree, point: usize, definitions: &HashMap<Name, Tree>) -> f64 {
        self.value_in(tree, point, definitions, 0)
    }

    fn value_in(&self, tree: &Tree, point: usize, definitions: &HashMap<Name, Tree>, depth: usize) -> f64 {
        let of = |part: &Tree| self.value_in(part, point, definitions, depth);
        match tree {
            Tree::Number(value) => float(value),
            Tree::Symbol(name, _) if definitions.contains_key(name) => match definitions.get(name) {
                Some(meant) if depth < DEEPEST => self.value_in(meant, point, definitions, depth + 1),
                _ => f64::NAN,
            },
            Tree::Sum(terms) => terms.iter().map(of).sum(),
            Tree::Product(factors) => factors.iter().map(of).product(),
            Tree::Quotient(above, below, _) => of(above) / of(below),
            Tree::Negate(body) => -of(body),
            Tree::Power(base, exponent, _) => of(base).powi(*exponent),
            _ => match Op::of(tree) {
                Op::Leaf => self
                    .values
                    .get(tree)
                    .and_then(|values| values.get(point))
                    .copied()
                    .unwrap_or(f64::NAN),
                op => {
                    let inner: Vec<f64> = parts(tree).iter().map(of).collect();
                    op.apply(inner.len(), |n| inner.get(n).copied().unwrap_or(f64::NAN))
                }
            },
        }
    }

    /// The values of a tree at all points, each with the size of its terms.
    pub fn sized(&self, tree: &Tree, definitions: &HashMap<Name, Tree>) -> Vec<Sized> {
        let points = 0..self.points;
        points
            .map(|point| Sized {
                value: self.value(tree, point, definitions),
                size: self.size(tree, point, definitions),
            })
            .collect()
    }

    fn size(&self, tree: &Tree, point: usize, definitions: &HashMap<Name, Tree>) -> f64 {
        match tree {
            Tree::Sum(terms) => terms.iter().map(|term| self.size(term, point, definitions)).sum(),
            Tree::Negate(body) => self.size(body, point, definitions),
            _ => self.value(tree, point, definitions).abs(),
        }
    }

    /// The values of a tree at all points.
    pub fn all(&self, tree: &Tree, definitions: &HashMap<Name, Tree>) -> Vec<f64> {
        (0..self.points)
            .map(|point| self.value(tree, point, definitions))
            .collect()
    }
}

/// A node of the formulas of a claim.
#[derive(Debug)]
pub struct Node {
    op: Op,
    parts: Vec<usize>,
    pub values: Vec<f64>,
    /// The nodes that depend on it, from the inside out.
    pub above: Vec<usize>,
    /// The formula that it stands in, and where.
    pub place: (usize, Path),
    pub tree: Tree,
    /// What it is directly a part of.
    pub within: Option<Tree>,
}

/// The formulas of a claim as one graph: a definition is there once, however often its name is used.
#[derive(Debug, Default)]
pub struct Graph {
    pub nodes: Vec<Node>,
    /// The two sides of each equation that is to hold, with the number of the formula.
    pub sides: Vec<(usize, [usize; 2])>,
    pub places: HashMap<(usize, Path), usize>,
    definitions: HashMap<Name, usize>,
}

/// Values of nodes that differ from those of the graph.
#[derive(Debug, Default)]
pub struct Overlay {
    now: u32,
    stamps: Vec<u32>,
    values: Vec<f64>,
}

impl Graph {
    /// The graph of these formulas, each an equation and, where it is a definition, the name that it gives.
    pub fn new(formulas: &[(Equation, Option<Name>)], leaves: &Leaves) -> Self {
        let mut graph = Self::default();
        for (number, (equation, name)) in formulas.iter().enumerate() {
            match name {
                Some(name) => {
                    graph.define(name, formulas, leaves, 0);
                }
                None => {
                    let left = graph.add(&equation.left, None, (number, vec![0]), formulas, leaves, 0);
                    let right = graph.add(&equation.right, None, (number, vec![1]), formulas, leaves, 0);
                    graph.sides.push((number, [left, right]));
                }
            }
        }
        for number in 0..graph.nodes.len() {
            let mut above: Vec<usize> = Vec::new();
            for other in number + 1..graph.nodes.len() {
                let inner = graph
                    .nodes
                    .get(other)
                    .map(|node| node.parts.as_slice())
                    .unwrap_or_default();
                if inner.iter().any(|part| *part == number || above.contains(part)) {
                    above.push(other);
                }
            }
            if let Some(node) = graph.nodes.get_mut(number) {
                node.above = above;
            }
        }
        graph
    }

    fn define(
        &mut self,
        name: &Name,
        formulas: &[(Equation, Option<Name>)],
        leaves: &Leaves,
        depth: usize,
    ) -> Option<usize> {
        if let Some(known) = self.definitions.get(name) {
            return Some(*known);
        }
        let number = formulas.iter().position(|(_, given)| given.as_ref() == Some(name))?;
        if depth > DEEPEST {
            return None;
        }
        let (equation, _) = formulas.get(number)?;
        let root = self.add(&equation.right, None, (number, vec![1]), formulas, leaves, depth + 1);
        self.definitions.insert(name.clone(), root);
        Some(root)
    }

    fn add(
        &mut self,
        tree: &Tree,
        within: Option<&Tree>,
        place: (usize, Path),
        formulas: &[(Equation, Option<Name>)],
        leaves: &Leaves,
        depth: usize,
    ) -> usize {
        let mut op = Op::of(tree);
        let mut below = Vec::new();
        let defined = match tree {
            Tree::Symbol(name, _) => self.define(name, formulas, leaves, depth),
            _ => None,
        };
        if let Some(root) = defined {
            op = Op::Same;
            below.push(root);
        } else if !matches!(op, Op::Leaf) {
            for (n, part) in parts(tree).iter().enumerate() {
                let mut path = place.1.clone();
                path.push(n);
                below.push(self.add(part, Some(tree), (place.0, path), formulas, leaves, depth));
            }
        }
        let none = HashMap::new();
        let values = (0..leaves.points).map(|point| match op {
            Op::Leaf => leaves.value(tree, point, &none),
            op => op.apply(below.len(), |n| {
                self.value(below.get(n).copied().unwrap_or(usize::MAX), point)
            }),
        });
        let node = Node {
            op,
            values: values.collect(),
            parts: below,
            above: Vec::new(),
            place: place.clone(),
            tree: tree.clone(),
            within: within.cloned(),
        };
        self.nodes.push(node);
        self.places.insert(place, self.nodes.len() - 1);
        self.nodes.len() - 1
    }

    pub fn value(&self, node: usize, point: usize) -> f64 {
        let node = self.nodes.get(node);
        node.and_then(|node| node.values.get(point))
            .copied()
            .unwrap_or(f64::NAN)
    }

    /// What a node is the sum of, or the opposite of, or another name for.
    pub fn terms_of(&self, node: usize) -> Option<&[usize]> {
        let node = self.nodes.get(node)?;
        matches!(node.op, Op::Sum | Op::Negate | Op::Same).then_some(node.parts.as_slice())
    }

    /// The node at a place, or the innermost above it, with the rest of the path.
    pub fn nearest(&self, formula: usize, path: &[usize]) -> Option<(usize, Path)> {
        (1..=path.len()).rev().find_map(|length| {
            let (head, rest) = path.split_at_checked(length)?;
            let node = self.places.get(&(formula, head.to_vec()))?;
            Some((*node, rest.to_vec()))
        })
    }

    /// Takes up values of nodes at a point, and what follows from them.
    pub fn change(&self, point: usize, changes: &[(usize, f64)], overlay: &mut Overlay) {
        overlay.stamps.resize(self.nodes.len(), 0);
        overlay.values.resize(self.nodes.len(), 0.0);
        overlay.now += 1;
        let now = overlay.now;
        for &(node, value) in changes {
            overlay.set(node, value);
        }
        let mut merged;
        let above: &[usize] = match changes {
            [(node, _)] => self
                .nodes
                .get(*node)
                .map(|node| node.above.as_slice())
                .unwrap_or_default(),
            _ => {
                merged = Vec::new();
                for (node, _) in changes {
                    merged.extend(
                        self.nodes
                            .get(*node)
                            .map(|node| node.above.as_slice())
                            .unwrap_or_default(),
                    );
                }
                merged.sort_unstable();
                merged.dedup();
                &merged
            }
        };
        for &number in above {
            let Some(node) = self.nodes.get(number) else { continue };
            if overlay.stamps.get(number) == Some(&now) {
                continue;
            }
            let value = node.op.apply(node.parts.len(), |n| {
                let part = node.parts.get(n).copied().unwrap_or(usize::MAX);
                self.seen(part, point, overlay)
            });
            overlay.set(number, value);
        }
    }

    /// The value of a node with an overlay.
    pub fn seen(&self, node: usize, point: usize, overlay: &Overlay) -> f64 {
        match overlay.stamps.get(node) == Some(&overlay.now) {
            true => overlay.values.get(node).copied().unwrap_or(f64::NAN),
            false => self.value(node, point),
        }
    }

    /// Whether an equation holds at a point but for rounding.
    pub fn holds(&self, sides: [usize; 2], point: usize, overlay: &Overlay) -> bool {
        let [left, right] = sides.map(|side| Sized {
            value: self.seen(side, point, overlay),
            size: self.size(side, point, overlay),
        });
        agree(left, right)
    }

    /// The sum of the sizes of the terms of a node.
    fn size(&self, node: usize, point: usize, overlay: &Overlay) -> f64 {
        match self.terms_of(node) {
            Some(terms) => terms.iter().map(|term| self.size(*term, point, overlay)).sum(),
            None => self.seen(node, point, overlay).abs(),
        }
    }

    /// Whether all equations hold at all points with these nodes changed.
    pub fn all_hold(&self, changes: &[(usize, &[f64])], points: usize, overlay: &mut Overlay) -> bool {
        (0..points).all(|point| {
            let at: Vec<(usize, f64)> = changes
                .iter()
                .map(|(node, values)| (*node, values.get(point).copied().unwrap_or(f64::NAN)))
                .collect();
            self.change(point, &at, overlay);
            self.sides.iter().all(|(_, sides)| self.holds(*sides, point, overlay))
        })
    }

    /// The value that a node must take at a point for the sides to be equal: the only one where their difference is a
    /// quotient of linear functions of it, else one near the value that is there.
    pub fn required(&self, node: usize, sides: [usize; 2], point: usize, overlay: &mut Overlay) -> Option<f64> {
        let from = self.value(node, point);
        let step = 0.37 * from.abs().max(0.5);
        let mut gap = |value: f64| {
            self.change(point, &[(node, value)], overlay);
            let [left, right] = sides.map(|side| self.seen(side, point, overlay));
            (left - right, self.holds(sides, point, overlay))
        };
        let [(g0, _), (g1, _), (g2, _)] = [0.0, 1.0, 2.0].map(|n| gap(from + n * step));
        if g0 == g1 {
            return None;
        }
        let bend = match g1 == g2 {
            true => 0.0,
            false => (g2 + g0 - 2.0 * g1) / (2.0 * (g1 - g2)),
        };
        let slope = g1 + bend * g1 - g0;
        let found = from - g0 / slope * step;
        if found.is_finite() && gap(found).1 {
            return Some(found);
        }
        // by the secant method, from the value that is there
        let (mut one, mut other) = ((from, g0), (from + step, g1));
        for _ in 0..MOST_SECANTS {
            let next = other.0 - other.1 * (other.0 - one.0) / (other.1 - one.1);
            let (left, is_met) = gap(next);
            if !next.is_finite() || left.is_nan() {
                return None;
            }
            if is_met && (next - other.0).abs() <= ROUNDING * next.abs() {
                return Some(next);
            }
            (one, other) = (other, (next, left));
        }
        None
    }
}

impl Overlay {
    fn set(&mut self, node: usize, value: f64) {
        if let (Some(stamp), Some(place)) = (self.stamps.get_mut(node), self.values.get_mut(node)) {
            (*stamp, *place) = (self.now, value);
        }
    }
}
