//! Several edits at once: what each adds to the difference of the sides is looked up among what the others leave.

use super::candidate::{Candidate, Valued};
use super::graph::{Graph, Overlay};
use crate::evidence::sampled::{Leaves, Number, Value};
use std::collections::BTreeMap;

/// Pairs of edits of one term that are evaluated, for each unit of effort.
const MOST_PAIRS: u64 = 1_500_000;
/// Sets of edits that are kept.
const MOST_KEPT: usize = 60;
/// Larger edits are tried alone only.
const LARGEST: u32 = 16;
/// How close sums must come, as a part of the largest.
const CLOSE: f64 = 1e-9;
/// How much of the imaginary part counts where one number tells of a complex one.
const IMAGINARY: f64 = 0.618;

/// An edit with what it adds to a sum at the first point.
struct Change<'a> {
    valued: &'a Valued,
    /// The terms of the sum that it changes, one bit each.
    terms: u64,
    adds: f64,
}

/// Sets of two or three edits after which all equations hold at the points.
pub fn combined(
    (graph, leaves): (&Graph, &Leaves),
    valued: &[Valued],
    failing: &[usize],
    edits: usize,
    effort: u64,
) -> Vec<Vec<Candidate>> {
    let ([failing], false) = (failing, leaves.is_either) else {
        return Vec::new();
    };
    let Some((_, sides)) = graph.sides.get(*failing) else {
        return Vec::new();
    };
    let mut over = Sum {
        graph,
        leaves,
        sides: *sides,
        terms: Vec::new(),
        overlay: Overlay::default(),
        left: MOST_PAIRS * effort,
        found: Vec::new(),
    };
    let [left, right] = *sides;
    over.take_terms(left);
    over.take_terms(right);
    over.search(valued, edits);
    over.found.sort_by_key(|(cost, _)| *cost);
    over.found.truncate(MOST_KEPT);
    over.found.into_iter().map(|(_, set)| set).collect()
}

/// The difference of the sides of an equation as a sum of terms.
struct Sum<'a> {
    graph: &'a Graph,
    leaves: &'a Leaves,
    sides: [usize; 2],
    terms: Vec<usize>,
    overlay: Overlay,
    /// Pairs that may still be evaluated.
    left: u64,
    found: Vec<(u32, Vec<Candidate>)>,
}

impl Sum<'_> {
    fn take_terms(&mut self, node: usize) {
        match self.graph.terms_of(node) {
            Some(inner) => inner.iter().for_each(|&part| self.take_terms(part)),
            None => self.terms.push(node),
        }
    }

    fn gap(&self, overlay: &Overlay) -> f64 {
        let [left, right] = self.sides.map(|side| self.graph.seen(side, 0, overlay));
        let Number { re, im } = left.plus(right.negated()).told();
        re + IMAGINARY * im
    }

    fn after(&mut self, changes: &[(usize, &Value)]) -> f64 {
        self.graph.change(0, changes, &mut self.overlay);
        self.gap(&self.overlay)
    }

    /// The terms that depend on a node or are a part of it.
    fn changed(&self, node: usize) -> u64 {
        let above = |node: usize| {
            self.graph
                .nodes
                .get(node)
                .map(|node| node.above.as_slice())
                .unwrap_or_default()
        };
        let touches = |term: usize| term == node || above(node).contains(&term) || above(term).contains(&node);
        let terms = self.terms.iter().enumerate().take(64);
        terms
            .filter(|(_, term)| touches(**term))
            .fold(0, |mask, (n, _)| mask | 1 << n)
    }

    fn search(&mut self, valued: &[Valued], edits: usize) {
        let start = self.gap(&Overlay::default());
        let mut changes: Vec<Change> = Vec::new();
        for valued in valued.iter().filter(|valued| valued.candidate.edit.cost <= LARGEST) {
            let Some(value) = valued.values.first() else { continue };
            let adds = self.after(&[(valued.node, value)]) - start;
            let terms = self.changed(valued.node);
            if adds.is_finite() && adds != 0.0 && terms != 0 {
                changes.push(Change { valued, terms, adds });
            }
        }
        changes.sort_by(|a, b| a.adds.total_cmp(&b.adds));
        let wanted = -start;
        if edits == 2 {
            for change in &changes {
                self.look_up(&changes, &[change], wanted - change.adds, change.terms);
            }
        }
        // edits of the same terms do not add up
        let mut groups: BTreeMap<u64, Vec<&Change>> = BTreeMap::new();
        for change in &changes {
            groups.entry(change.terms).or_default().push(change);
        }
        let mut groups: Vec<(u64, Vec<&Change>)> = groups.into_iter().collect();
        groups.sort_by_key(|(terms, changes)| (terms.count_ones(), changes.len()));
        for (terms, group) in &mut groups {
            group.sort_by_key(|change| change.valued.candidate.edit.cost);
            for (n, one) in group.iter().enumerate() {
                for other in group.get(..n).unwrap_or_default() {
                    if self.left == 0 {
                        return;
                    }
                    if nested(&one.valued.candidate, &other.valued.candidate) || one.valued.node == other.valued.node {
                        continue;
                    }
                    self.left -= 1;
                    let (Some(first), Some(second)) = (one.valued.values.first(), other.valued.values.first()) else {
                        continue;
                    };
                    let both = [(one.valued.node, first), (other.valued.node, second)];
                    let adds = self.after(&both) - start;
                    match edits {
                        2 if (adds - wanted).abs() <= CLOSE * (adds.abs() + wanted.abs()) => self.keep(&[one, other]),
                        2 => {}
                        _ => self.look_up(&changes, &[one, other], wanted - adds, *terms),
                    }
                }
            }
        }
        if edits == 3 {
            for (n, one) in changes.iter().enumerate() {
                for other in changes.get(..n).unwrap_or_default() {
                    if one.terms & other.terms != 0 {
                        continue;
                    }
                    if self.left == 0 {
                        return;
                    }
                    self.left -= 1;
                    let rest = wanted - one.adds - other.adds;
                    self.look_up(&changes, &[one, other], rest, one.terms | other.terms);
                }
            }
        }
    }

    /// Keeps the edits that add what is left, of terms that are not changed yet.
    fn look_up(&mut self, changes: &[Change], with: &[&Change], rest: f64, taken: u64) {
        if !rest.is_finite() {
            return;
        }
        let largest = with.iter().map(|change| change.adds.abs()).fold(rest.abs(), f64::max);
        let close = CLOSE * largest;
        let from = changes.partition_point(|change| change.adds < rest - close);
        let near = changes.get(from..).unwrap_or_default();
        for last in near.iter().take_while(|change| change.adds <= rest + close) {
            let is_ordered = with.len() > 1 || with.iter().all(|first| first.adds <= last.adds);
            if last.terms & taken == 0 && is_ordered {
                let mut all = with.to_vec();
                all.push(last);
                self.keep(&all);
            }
        }
    }

    fn keep(&mut self, set: &[&Change]) {
        let changes: Vec<(usize, &[Value])> = set
            .iter()
            .map(|change| (change.valued.node, change.valued.values.as_slice()))
            .collect();
        if self.graph.all_hold(&changes, self.leaves, &mut self.overlay) {
            let set: Vec<Candidate> = set.iter().map(|change| change.valued.candidate.clone()).collect();
            let cost = set.iter().map(|candidate| candidate.edit.cost).sum();
            self.found.push((cost, set));
        }
    }
}

/// Whether one edit is within the other.
fn nested(one: &Candidate, other: &Candidate) -> bool {
    one.formula == other.formula && (one.path.starts_with(&other.path) || other.path.starts_with(&one.path))
}
