//! Partial derivatives of a one-impact map by implicit differentiation of the premises, with dual numbers.

use super::newton::{Slopes, least, norm};
use super::program::{Env, Node};
use super::space::Slot;
use super::system::System;
use super::tolerance::{DEPENDENT, SLOPE, SLOPE_WIDE};
use crate::number::{Analytic, Dual};
use num_dual::DualNum;

/// What implicit differentiation found for one map.
pub struct Found<T> {
    /// The slot of each partial derivative and its value.
    pub partials: Vec<(usize, T)>,
    /// Whether the premises determine them.
    pub determined: bool,
}

/// The rows that determine a map, and the slots that move along with it.
struct Moving<'a> {
    rows: Vec<&'a Node>,
    slots: Vec<usize>,
    determined: bool,
}

impl System {
    /// The derivatives of map number `step` at a point. What the premises leave open keeps, as near as they allow,
    /// the value that is in `values`.
    pub fn differentiate<T: Analytic + DualNum>(&self, step: usize, values: &[T]) -> Option<Found<T>> {
        let map = self.maps.steps.get(step)?;
        let rough: Vec<f64> = values.iter().map(Analytic::to_f64).collect();
        let moving = self.moving(step, &rough)?;
        let mut partials = Vec::new();
        for &by in &map.by {
            let slopes = self.along(&moving, by, values, &rough)?;
            for &of in &map.of {
                let Some(slot) = self.space.slots.iter().position(|s| *s == Slot::Partial { of, by }) else {
                    continue;
                };
                let known = moving.slots.iter().position(|s| *s == of).and_then(|n| slopes.get(n));
                partials.push((slot, known.or(values.get(slot))?.clone()));
            }
        }
        let determined = moving.determined && map.of.iter().all(|of| moving.slots.contains(of));
        Some(Found { partials, determined })
    }

    /// What the premises say of the derivatives of a map that they leave open, as equations between these; nothing
    /// where they speak of derivatives that have no slot.
    pub fn linear_rows(&self, step: usize, rough: &[f64]) -> Option<Vec<Node>> {
        let map = self.maps.steps.get(step)?;
        let moving = self.moving(step, rough)?;
        let mut rows = Vec::new();
        for row in &moving.rows {
            let gradient = self.gradient(row, rough);
            let slope = |slot: usize| gradient.get(slot).copied().unwrap_or(0.0);
            for &by in &map.by {
                let mut terms = vec![Node::Float(slope(by))];
                for &of in &moving.slots {
                    let partial = self.space.slots.iter().position(|s| *s == Slot::Partial { of, by })?;
                    terms.push(Node::Product(vec![Node::Float(slope(of)), Node::Slot(partial)]));
                }
                rows.push(Node::Sum(terms));
            }
        }
        Some(rows)
    }

    /// The first rows that have as much to say as there is to know; what is left over restricts the point.
    fn moving<'a>(&'a self, step: usize, rough: &[f64]) -> Option<Moving<'a>> {
        let map = self.maps.steps.get(step)?;
        let candidates = self.step_rows.get(step)?;
        let moves = |slot: &usize| match self.space.slots.get(*slot) {
            Some(Slot::Time { .. } | Slot::State { .. }) => !map.by.contains(slot),
            Some(Slot::Coefficient { course, .. }) => self
                .space
                .courses
                .get(*course)
                .is_some_and(|course| course.flight.is_some()),
            _ => false,
        };
        let mut moving = Moving {
            rows: Vec::new(),
            slots: Vec::new(),
            determined: false,
        };
        let mut units: Vec<Vec<f64>> = Vec::new();
        for row in candidates {
            moving
                .slots
                .extend(row.node.slots(&self.space.courses).into_iter().filter(moves));
            moving.slots.sort_unstable();
            moving.slots.dedup();
            moving.rows.push(&row.node);
            let mut gradient = self.gradient(&row.node, rough);
            for (slot, entry) in gradient.iter_mut().enumerate() {
                if !moving.slots.contains(&slot) {
                    *entry = 0.0;
                }
            }
            units.extend(new_direction(gradient, &units));
            moving.determined = units.len() >= moving.slots.len();
            if moving.determined && !row.in_flight && map.of.iter().all(|of| moving.slots.contains(of)) {
                break;
            }
        }
        Some(moving)
    }

    /// The derivatives of a row by all slots.
    fn gradient(&self, row: &Node, rough: &[f64]) -> Vec<f64> {
        let mut gradient = vec![0.0; rough.len()];
        let slots = row.slots(&self.space.courses);
        let slopes = Slopes::new(rough, &self.space.courses).of(row, &slots);
        for (slot, slope) in slots.into_iter().zip(slopes) {
            if let Some(entry) = gradient.get_mut(slot) {
                *entry = slope;
            }
        }
        gradient
    }

    /// The slopes of the moving slots by one quantity, all else held.
    fn along<T: Analytic + DualNum>(&self, moving: &Moving, by: usize, values: &[T], rough: &[f64]) -> Option<Vec<T>> {
        let mut jacobian = Vec::new();
        for row in &moving.rows {
            let gradient = self.gradient(row, rough);
            jacobian.push(
                moving
                    .slots
                    .iter()
                    .map(|slot| gradient.get(*slot).copied().unwrap_or(0.0))
                    .collect::<Vec<f64>>(),
            );
        }
        let start = |of: &usize| {
            let partial = self
                .space
                .slots
                .iter()
                .position(|s| *s == Slot::Partial { of: *of, by });
            partial
                .and_then(|slot| values.get(slot))
                .cloned()
                .unwrap_or_else(T::zero)
        };
        let mut slopes: Vec<T> = moving.slots.iter().map(start).collect();
        let mut lifted: Vec<Dual<T>> = values.iter().map(|value| Dual::from_re(value.clone())).collect();
        lifted.get_mut(by)?.eps = T::one();
        // Each step gains the digits of the Jacobian in f64: two for f64 itself, six for 40 digits near grazing.
        let wide = T::epsilon().to_f64() < 1e-20;
        let (steps, enough) = if wide { (8, SLOPE_WIDE) } else { (3, SLOPE) };
        let mut last = f64::INFINITY;
        for _ in 0..steps {
            for (slot, slope) in moving.slots.iter().zip(&slopes) {
                lifted.get_mut(*slot)?.eps = slope.clone();
            }
            let env = self.env(&lifted);
            let rest: Vec<f64> = moving.rows.iter().map(|row| row.value(&env).eps.to_f64()).collect();
            let change = least(jacobian.clone(), &rest, moving.slots.len());
            for (slope, change) in slopes.iter_mut().zip(&change) {
                *slope -= <T as Analytic>::from_f64(*change);
            }
            let size = norm(&slopes.iter().map(Analytic::to_f64).collect::<Vec<f64>>());
            last = norm(&change) / (1.0 + size);
            if last <= enough * 1e-3 {
                break;
            }
        }
        // Not larger: NaN is turned away too.
        (last <= enough).then_some(())?;
        Some(slopes)
    }

    /// What a formula of this system is evaluated with.
    pub fn env<'a, T>(&'a self, values: &'a [T]) -> Env<'a, T> {
        Env {
            values,
            running: None,
            upper: None,
            courses: &self.space.courses,
        }
    }
}

/// The direction in which a row says something that the rows before it do not.
fn new_direction(mut gradient: Vec<f64>, units: &[Vec<f64>]) -> Option<Vec<f64>> {
    let before = norm(&gradient);
    for unit in units {
        let along: f64 = gradient.iter().zip(unit).map(|(a, b)| a * b).sum();
        gradient
            .iter_mut()
            .zip(unit)
            .for_each(|(entry, part)| *entry -= along * part);
    }
    let size = norm(&gradient);
    gradient.iter_mut().for_each(|entry| *entry /= size);
    (size > DEPENDENT * before).then_some(gradient)
}
