//! Points at which all premises of a claim hold.

use super::newton::Equations;
use super::program::Node;
use super::space::Slot;
use super::system::{Kind, System};
use super::tolerance::{PREMISE, PREMISE_WIDE};
use crate::number::{Analytic, Sequence, Wide};
use num_dual::DualNum;
use std::collections::BTreeSet;

/// Sets the sequences of neighbouring seeds far apart.
const SPREAD: u64 = 0xd134_2543_de82_ef95;
const START: u64 = 0x2545_f491_4f6c_dd1d;

/// A point: a value for each slot, and a running time for claims that have one.
#[derive(Clone, Debug, PartialEq)]
pub struct Point<T> {
    pub values: Vec<T>,
    pub running: T,
}

/// Starts for each point wanted; most starts lead to a point.
const MOST_STARTS: usize = 12;

impl System {
    /// Up to `count` points, the same ones each time.
    pub fn points(&self, count: usize, seed: u64) -> Vec<Point<f64>> {
        let mut points = Vec::new();
        for start in 0..count * MOST_STARTS {
            if points.len() == count || (start >= 3 * MOST_STARTS && points.is_empty()) {
                break;
            }
            points.extend(self.point(seed.wrapping_mul(1000).wrapping_add(start as u64)));
        }
        points
    }

    /// The point that a random start leads to, if it does.
    fn point(&self, seed: u64) -> Option<Point<f64>> {
        let mut random = Sequence::new(seed.wrapping_mul(SPREAD).wrapping_add(START));
        let mut point = self.start(&mut random);
        // Not less or equal: NaN fails too.
        let meets = |rest: f64| rest <= PREMISE;
        if !meets(self.settle(&mut point.values, PREMISE)) {
            return None;
        }
        let env = self.env(&point.values);
        let positive = self.positive.iter().all(|node| node.value(&env) > 1e-3);
        let sane = point.values.iter().all(|value| value.abs() < 1e3);
        let small = self.at_most_one.iter().all(|node| node.value(&env) <= 1.0);
        if !positive || !small || !sane {
            return None;
        }
        meets(self.derive(&mut point.values, PREMISE)?).then_some(())?;
        let env = self.env(&point.values);
        let holds = |node: &Node| {
            let (value, size) = node.sized(&env);
            value.abs() <= 100.0 * PREMISE * size
        };
        self.checks.iter().all(holds).then_some(point)
    }

    /// The largest residual of a premise at a point, relative to the size of its terms.
    pub fn residual(&self, point: &Point<f64>) -> f64 {
        let env = self.env(&point.values);
        let relative = |node: &Node| {
            let (value, size) = node.sized(&env);
            if value == 0.0 { 0.0 } else { value.abs() / size }
        };
        self.rows
            .iter()
            .map(|row| &row.node)
            .chain(&self.late)
            .map(relative)
            .fold(0.0, f64::max)
    }

    /// The point over 40 digits, where all premises hold to them.
    pub fn widened(&self, point: &Point<f64>) -> Option<Point<Wide<40>>> {
        let wide = |value: &f64| <Wide<40> as Analytic>::from_f64(*value);
        let mut values: Vec<Wide<40>> = point.values.iter().map(wide).collect();
        let met = self.settle(&mut values, PREMISE_WIDE) <= PREMISE_WIDE;
        let derived = met && self.derive(&mut values, PREMISE_WIDE)? <= PREMISE_WIDE;
        derived.then(|| Point {
            values,
            running: wide(&point.running),
        })
    }

    fn start(&self, random: &mut Sequence) -> Point<f64> {
        let positive: BTreeSet<usize> = slots_of(&self.positive);
        let small: BTreeSet<usize> = slots_of(&self.at_most_one);
        let mut clock = random.between(0.0, 0.5);
        let mut values = vec![0.0; self.space.slots.len()];
        // Impacts one after the other, towards one wall and the other in turn.
        let mut order: Vec<usize> = (0..values.len()).collect();
        order.sort_by_key(|slot| (self.space.impact(*slot), *slot));
        for slot in order {
            let value = match self.space.slots.get(slot) {
                Some(Slot::Time { .. }) => {
                    clock += random.between(0.6, 1.4);
                    clock
                }
                Some(Slot::State { index, .. }) => {
                    let size = random.between(0.3, 1.5);
                    if index % 2 == 0 { size } else { -size }
                }
                _ if small.contains(&slot) => random.between(0.2, 0.9),
                Some(Slot::Parameter(_)) if positive.contains(&slot) => random.between(0.4, 2.2),
                Some(Slot::Coefficient { .. }) => random.between(-1.0, 1.0),
                _ => random.between(-1.5, 1.5),
            };
            if let Some(place) = values.get_mut(slot) {
                *place = if self.zeros.contains(&slot) { 0.0 } else { value };
            }
        }
        if self.kind == Kind::Cosine {
            self.make_cosine(&mut values, random);
        }
        let start = values.get(self.start).copied().unwrap_or(0.0);
        Point {
            values,
            running: start + random.between(0.1, 1.0),
        }
    }

    /// Sets the coefficients of functions to those of cos(pi t + phi).
    fn make_cosine(&self, values: &mut [f64], random: &mut Sequence) {
        let is_phase = |slot: &Slot| matches!(slot, Slot::Parameter(name) if name.to_string() == r"\phi");
        let phase = self
            .space
            .slots
            .iter()
            .position(is_phase)
            .and_then(|slot| values.get(slot).copied());
        let phase = phase.unwrap_or_else(|| random.between(0.0, 6.0));
        for course in self.space.courses.iter().filter(|course| course.flight.is_none()) {
            for slot in course.slots() {
                let value = match slot - course.first {
                    term if term == course.powers => phase.cos(),
                    term if term == course.powers + 1 => -phase.sin(),
                    _ => 0.0,
                };
                if let Some(place) = values.get_mut(slot) {
                    *place = value;
                }
            }
        }
    }

    /// Moves times, states, parameters and flights until the premises hold.
    fn settle<T: Analytic>(&self, values: &mut [T], enough: f64) -> f64 {
        let rows: Vec<&Node> = self.rows.iter().map(|row| &row.node).collect();
        let movable = |slot: &usize| match self.space.slots.get(*slot) {
            Some(Slot::Coefficient { course, .. }) => {
                let flight = self
                    .space
                    .courses
                    .get(*course)
                    .is_some_and(|course| course.flight.is_some());
                !self.zeros.contains(slot) && (flight || (self.shaped && self.kind == Kind::Any))
            }
            _ => true,
        };
        let unknowns: BTreeSet<usize> = rows
            .iter()
            .flat_map(|row| row.slots(&self.space.courses))
            .filter(movable)
            .collect();
        Equations::new(rows, unknowns.into_iter().collect(), &self.space.courses).solve(values, enough)
    }

    /// Finds the derivatives, then what premises say of them.
    fn derive<T: Analytic + DualNum>(&self, values: &mut [T], enough: f64) -> Option<f64> {
        let mut fixed: BTreeSet<usize> = self
            .rows
            .iter()
            .flat_map(|row| row.node.slots(&self.space.courses))
            .collect();
        let mut open = BTreeSet::new();
        for (number, rows) in self.step_rows.iter().enumerate() {
            if rows.is_empty() {
                continue;
            }
            let found = self.differentiate(number, values)?;
            let slots = found.partials.iter().map(|(slot, _)| *slot);
            if found.determined {
                fixed.extend(slots)
            } else {
                open.extend(slots)
            }
            for (slot, value) in found.partials {
                *values.get_mut(slot)? = value;
            }
        }
        if self.late.is_empty() {
            return Some(0.0);
        }
        let mut rows: Vec<Node> = self.late.clone();
        let all: BTreeSet<usize> = rows.iter().flat_map(|row| row.slots(&self.space.courses)).collect();
        if all.iter().any(|slot| open.contains(slot)) {
            // The coefficients are those of f64.
            if T::epsilon().to_f64() < 1e-20 {
                return None;
            }
            let rough: Vec<f64> = values.iter().map(Analytic::to_f64).collect();
            for step in 0..self.step_rows.len() {
                rows.extend(self.linear_rows(step, &rough)?);
            }
        }
        let all: BTreeSet<usize> = rows.iter().flat_map(|row| row.slots(&self.space.courses)).collect();
        let movable = |slot: &usize| !matches!(self.space.slots.get(*slot), Some(Slot::Coefficient { .. }));
        let unknowns = all.difference(&fixed).copied().filter(movable).collect();
        Some(Equations::new(rows.iter().collect(), unknowns, &self.space.courses).solve(values, enough))
    }
}

/// The slots that stand alone in this list.
fn slots_of(nodes: &[Node]) -> BTreeSet<usize> {
    let alone = |node: &Node| match node {
        Node::Slot(slot) => Some(*slot),
        _ => None,
    };
    nodes.iter().filter_map(alone).collect()
}
