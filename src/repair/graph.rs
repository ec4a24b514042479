//! The formulas of a claim as one graph, and what becomes of the two sides when single nodes take other values.

use super::candidate::Formula;
use super::path::{Path, parts};
use crate::evidence::sampled::{Arithmetic, Leaves, Number, Op, SizedValue, Value, agree, real};
use crate::tex::{Name, Tree};
use std::collections::HashMap;

/// Steps of the secant method, and how near each other its last two must be.
const MOST_SECANTS: usize = 16;
const SETTLED: f64 = 1e-7;

/// Definitions that are put into definitions, at most.
const DEEPEST: usize = 24;

/// How a node follows from its parts.
#[derive(Clone, Copy, Debug)]
enum Rule {
    /// It is evaluated as a whole.
    Whole,
    /// It is a name that a definition gives.
    Same,
    By(Op),
}

/// A node of the formulas of a claim.
#[derive(Debug)]
pub struct Node {
    rule: Rule,
    parts: Vec<usize>,
    pub values: Vec<Value>,
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
    arithmetic: Vec<Arithmetic>,
}

/// Values of nodes that differ from those of the graph.
#[derive(Debug, Default)]
pub struct Overlay {
    now: u32,
    stamps: Vec<u32>,
    values: Vec<Value>,
}

/// The formulas that a graph is made of, with the leaves and what all names mean.
struct Source<'a> {
    formulas: &'a [Formula],
    leaves: &'a Leaves,
    definitions: &'a HashMap<Name, Tree>,
}

impl Graph {
    /// The graph of these formulas; a side that two links of a chain share is there once.
    pub fn new(formulas: &[Formula], leaves: &Leaves, definitions: &HashMap<Name, Tree>) -> Self {
        let mut graph = Self {
            arithmetic: (0..leaves.points).map(|point| leaves.arithmetic(point)).collect(),
            ..Self::default()
        };
        let source = Source {
            formulas,
            leaves,
            definitions,
        };
        for (number, formula) in formulas.iter().enumerate() {
            match &formula.name {
                Some(name) => {
                    graph.define(name, &source, 0);
                }
                None => {
                    let equation = &formula.equation;
                    let left = match graph.sides.last() {
                        Some((before, [_, shared])) if formula.continues && before + 1 == number => *shared,
                        _ => graph.add(&equation.left, None, (number, vec![0]), &source, 0),
                    };
                    let right = graph.add(&equation.right, None, (number, vec![1]), &source, 0);
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

    fn define(&mut self, name: &Name, source: &Source, depth: usize) -> Option<usize> {
        if let Some(known) = self.definitions.get(name) {
            return Some(*known);
        }
        let number = source
            .formulas
            .iter()
            .position(|formula| formula.name.as_ref() == Some(name))?;
        if depth > DEEPEST {
            return None;
        }
        let formula = source.formulas.get(number)?;
        let root = self.add(&formula.equation.right, None, (number, vec![1]), source, depth + 1);
        self.definitions.insert(name.clone(), root);
        Some(root)
    }

    fn add(
        &mut self,
        tree: &Tree,
        within: Option<&Tree>,
        place: (usize, Path),
        source: &Source,
        depth: usize,
    ) -> usize {
        let mut below = Vec::new();
        let defined = match tree {
            Tree::Symbol(name, _) => self.define(name, source, depth),
            _ => None,
        };
        let rule = match (defined, Op::of(tree)) {
            (Some(root), _) => {
                below.push(root);
                Rule::Same
            }
            (None, Some(op)) => {
                for (n, part) in parts(tree).iter().enumerate() {
                    let mut path = place.1.clone();
                    path.push(n);
                    below.push(self.add(part, Some(tree), (place.0, path), source, depth));
                }
                Rule::By(op)
            }
            (None, None) => Rule::Whole,
        };
        let values = (0..source.leaves.points).map(|point| match rule {
            Rule::Whole => source.leaves.value(tree, point, source.definitions),
            rule => self.following(rule, point, &below, &|part| self.value(part, point)),
        });
        let node = Node {
            rule,
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

    /// What follows from the parts of a node.
    fn following(&self, rule: Rule, point: usize, parts: &[usize], value: &dyn Fn(usize) -> Value) -> Value {
        let part = |n: usize| parts.get(n).map_or(Value::UNDEFINED, |part| value(*part));
        match (rule, self.arithmetic.get(point)) {
            (Rule::Same, _) => part(0),
            (Rule::By(op), Some(arithmetic)) => arithmetic.apply(op, parts.len(), part),
            _ => Value::UNDEFINED,
        }
    }

    pub fn value(&self, node: usize, point: usize) -> Value {
        let node = self.nodes.get(node);
        let value = node.and_then(|node| node.values.get(point));
        value.cloned().unwrap_or(Value::UNDEFINED)
    }

    /// What a node is the sum of, or the opposite of, or another name for.
    pub fn terms_of(&self, node: usize) -> Option<&[usize]> {
        let node = self.nodes.get(node)?;
        matches!(node.rule, Rule::By(Op::Sum | Op::Negate) | Rule::Same).then_some(node.parts.as_slice())
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
    pub fn change(&self, point: usize, changes: &[(usize, &Value)], overlay: &mut Overlay) {
        overlay.stamps.resize(self.nodes.len(), 0);
        overlay.values.resize(self.nodes.len(), Value::UNDEFINED);
        overlay.now += 1;
        let now = overlay.now;
        for &(node, value) in changes {
            overlay.set(node, value.clone());
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
            let seen = |part: usize| self.seen(part, point, overlay);
            let value = self.following(node.rule, point, &node.parts, &seen);
            overlay.set(number, value);
        }
    }

    /// The value of a node with an overlay.
    pub fn seen(&self, node: usize, point: usize, overlay: &Overlay) -> Value {
        match overlay.stamps.get(node) == Some(&overlay.now) {
            true => overlay.values.get(node).cloned().unwrap_or(Value::UNDEFINED),
            false => self.value(node, point),
        }
    }

    /// Whether an equation holds at a point but for rounding.
    pub fn holds(&self, sides: [usize; 2], point: usize, overlay: &Overlay) -> bool {
        let [left, right] = sides.map(|side| SizedValue {
            value: self.seen(side, point, overlay),
            size: self.size(side, point, overlay),
        });
        agree(&left, &right)
    }

    /// The sum of the sizes of the terms of a node.
    fn size(&self, node: usize, point: usize, overlay: &Overlay) -> f64 {
        match self.terms_of(node) {
            Some(terms) => terms.iter().map(|term| self.size(*term, point, overlay)).sum(),
            None => self.seen(node, point, overlay).size(),
        }
    }

    /// Whether all equations hold at all places with these nodes changed.
    pub fn all_hold(&self, changes: &[(usize, &[Value])], leaves: &Leaves, overlay: &mut Overlay) -> bool {
        leaves.everywhere(|point| {
            let at: Vec<(usize, &Value)> = changes
                .iter()
                .map(|(node, values)| (*node, values.get(point).unwrap_or(&Value::UNDEFINED)))
                .collect();
            self.change(point, &at, overlay);
            self.sides.iter().all(|(_, sides)| self.holds(*sides, point, overlay))
        })
    }

    /// What a node that is a number must be at a point for the sides to be equal, or what a matrix must be multiplied by:
    /// the only one where their difference is a quotient of linear functions of it, else one near what is there.
    pub fn required(&self, node: usize, sides: [usize; 2], point: usize, overlay: &mut Overlay) -> Option<Number> {
        let own = self.value(node, point);
        let from = own.number().unwrap_or(real(1.0));
        let step = 0.37 * from.norm().max(0.5);
        let mut gap = |value: Number| {
            let changed = match &own {
                Value::Number(_) => Value::Number(value),
                own @ Value::Matrix(_) => own.clone().times(Value::Number(value)),
            };
            self.change(point, &[(node, &changed)], overlay);
            let [left, right] = sides.map(|side| self.seen(side, point, overlay));
            let gap = left.plus(right.negated()).told();
            (gap, self.holds(sides, point, overlay))
        };
        let [(g0, _), (g1, _), (g2, _)] = [0.0, 1.0, 2.0].map(|n| gap(from + n * step));
        if g0 == g1 {
            return None;
        }
        let bend = match g1 == g2 {
            true => real(0.0),
            false => (g2 + g0 - g1 * 2.0) / ((g1 - g2) * 2.0),
        };
        let slope = g1 + bend * g1 - g0;
        let found = from - g0 / slope * step;
        if found.is_finite() && gap(found).1 {
            return Some(found);
        }
        // by the secant method, from the value that is there
        let (mut one, mut other) = ((from, g0), (from + step, g1));
        for _ in 0..MOST_SECANTS {
            let next: Number = other.0 - other.1 * (other.0 - one.0) / (other.1 - one.1);
            let (left, is_met) = gap(next);
            if !next.is_finite() || left.is_nan() {
                return None;
            }
            if is_met && (next - other.0).norm() <= SETTLED * next.norm() {
                return Some(next);
            }
            (one, other) = (other, (next, left));
        }
        None
    }
}

impl Overlay {
    fn set(&mut self, node: usize, value: Value) {
        if let (Some(stamp), Some(place)) = (self.stamps.get_mut(node), self.values.get_mut(node)) {
            (*stamp, *place) = (self.now, value);
        }
    }
}
