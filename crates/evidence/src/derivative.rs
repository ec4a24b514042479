//! Partial derivatives of a one-impact map by implicit differentiation of the premises, with dual numbers.

use super::formula::{Formula, Op, Program};
use super::newton::{Unknown, least, norm};
use super::space::Slot;
use super::system::{StepRows, System};
use super::tolerance::{CORNER, DEPENDENT, SLOPE, SLOPE_WIDE};
use super::value::{Function, Numbers, Real, Reals, Value};
use numbers::{Analytic, Dual};
use std::collections::BTreeSet;

/// What implicit differentiation found for one map.
struct Found<T> {
    /// The slot of each partial derivative and its value.
    partials: Vec<(usize, T)>,
    /// Whether the premises determine them.
    determined: bool,
}

/// The rows that determine a map, and the slots that move along with it.
struct Moving {
    program: Program,
    slots: Vec<usize>,
    /// The derivatives of the rows by these slots.
    jacobian: Vec<Vec<f64>>,
    determined: bool,
}

impl System {
    /// Finds the derivatives, then what premises say of them; the largest relative residual of these.
    pub fn derive<N: Numbers, T: Real>(&self, values: &mut [N::Of<T>], enough: f64) -> Option<f64> {
        if self.late.is_empty() && self.step_rows.iter().all(Vec::is_empty) {
            return Some(0.0);
        }
        let mut fixed: BTreeSet<usize> = self.row_slots.iter().copied().collect();
        let mut open = BTreeSet::new();
        for (number, rows) in self.step_rows.iter().enumerate() {
            if rows.is_empty() {
                continue;
            }
            // Maps are real; a symbol of the claim may be complex all the same.
            let reals: Vec<T> = values.iter().map(|value| value.parts()[0].clone()).collect();
            let found = self.differentiate(number, &reals)?;
            let slots = found.partials.iter().map(|(slot, _)| *slot);
            if found.determined {
                fixed.extend(slots)
            } else {
                open.extend(slots)
            }
            for (slot, value) in found.partials {
                *values.get_mut(slot)? = N::Of::<T>::real(value);
            }
        }
        if self.late.is_empty() {
            return Some(0.0);
        }
        let slots = self.formulas.slots(&self.late);
        let is_coefficient = |slot: usize| matches!(self.space.slots.get(slot), Some(Slot::Coefficient { .. }));
        if !slots.iter().any(|slot| open.contains(slot)) {
            let unknowns = slots
                .into_iter()
                .filter(|slot| !fixed.contains(slot) && !is_coefficient(*slot));
            let program = self.formulas.program(&self.late);
            return Some(self.solve::<N, T>(&program, values, &self.unknowns(unknowns), enough));
        }
        // The coefficients of what the premises say of open derivatives are those of f64.
        if <T as Analytic>::epsilon().to_f64() < 1e-20 {
            return None;
        }
        let rough: Vec<f64> = values.iter().map(|value| value.parts()[0].to_f64()).collect();
        let mut formulas = self.formulas.clone();
        let mut rows = self.late.clone();
        for step in 0..self.step_rows.len() {
            rows.extend(self.linear_rows(step, &rough, &mut formulas)?);
        }
        let unknowns = formulas
            .slots(&rows)
            .into_iter()
            .filter(|slot| !fixed.contains(slot) && !is_coefficient(*slot));
        let program = formulas.program(&rows);
        Some(self.solve::<N, T>(&program, values, &self.unknowns(unknowns), enough))
    }

    fn partial(&self, of: usize, by: usize) -> Option<usize> {
        self.space.find(&Slot::Partial { of, by })
    }

    /// The derivatives of map number `step` at a point. What the premises leave open keeps, as near as they allow,
    /// the value that is in `values`.
    fn differentiate<T: Real>(&self, step: usize, values: &[T]) -> Option<Found<T>> {
        let map = self.maps.steps.get(step)?;
        let rough: Vec<f64> = values.iter().map(Analytic::to_f64).collect();
        if self.is_at_corner(step, &rough) {
            return None;
        }
        let moving = self.moving(step, &rough)?;
        let mut partials = Vec::new();
        for &by in &map.by {
            let slots: Vec<(usize, usize)> = map
                .of
                .iter()
                .filter_map(|&of| Some((of, self.partial(of, by)?)))
                .collect();
            if slots.is_empty() {
                continue;
            }
            let slopes = self.along(&moving, by, values)?;
            for (of, slot) in slots {
                let known = moving.slots.iter().position(|s| *s == of).and_then(|n| slopes.get(n));
                partials.push((slot, known.or(values.get(slot))?.clone()));
            }
        }
        let determined = moving.determined && map.of.iter().all(|of| moving.slots.contains(of));
        Some(Found { partials, determined })
    }

    /// Whether something between bars, or whose sign is taken, is 0 in the rows of a map: these have no derivative there.
    fn is_at_corner(&self, step: usize, values: &[f64]) -> bool {
        let rows = self.step_rows.get(step).map_or(&[][..], Vec::as_slice);
        let parts = self.formulas.parts(rows).into_iter();
        let turns = parts.filter_map(|part| match self.formulas.op(part) {
            Op::Apply(Function::Abs | Function::Sgn, inside) => Some(inside),
            Op::If { test, .. } => Some(test),
            _ => None,
        });
        let turns: Vec<Formula> = turns.collect();
        if turns.is_empty() {
            return false;
        }
        let program = self.formulas.program(&turns);
        let found = program.run(&self.inputs(values, None));
        program.outputs(&found).iter().any(|value| value.abs() < CORNER)
    }

    /// What the premises say of the derivatives of a map that they leave open, as equations between these; nothing
    /// where they speak of derivatives that have no slot.
    fn linear_rows(&self, step: usize, rough: &[f64], formulas: &mut super::formula::Formulas) -> Option<Vec<Formula>> {
        let map = self.maps.steps.get(step)?;
        let moving = self.moving(step, rough)?;
        let by: Vec<Unknown> = map.by.iter().map(|&slot| Unknown { slot, imaginary: false }).collect();
        let driven = self.jacobian::<Reals>(&moving.program, rough, &by);
        let mut rows = Vec::new();
        for (slopes, driven) in moving.jacobian.iter().zip(&driven) {
            for (&by, slope) in map.by.iter().zip(driven) {
                let mut sum = formulas.float(*slope);
                for (&of, slope) in moving.slots.iter().zip(slopes) {
                    let (slope, partial) = (formulas.float(*slope), formulas.slot(self.partial(of, by)?));
                    let term = formulas.multiply(slope, partial);
                    sum = formulas.make(Op::Add(sum, term));
                }
                rows.push(sum);
            }
        }
        Some(rows)
    }

    /// Prepares the rows of each map.
    pub fn prepare_steps(&mut self) {
        let moves = |slot: &usize, by: &[usize]| {
            matches!(
                self.space.slots.get(*slot),
                Some(Slot::Time { .. } | Slot::State { .. })
            ) && !by.contains(slot)
        };
        let prepared = self.maps.steps.iter().zip(&self.step_rows).map(|(map, rows)| {
            let of = |rows: &[Formula]| -> Vec<usize> {
                self.formulas
                    .slots(rows)
                    .into_iter()
                    .filter(|slot| moves(slot, &map.by))
                    .collect()
            };
            StepRows {
                all: of(rows),
                each: rows.iter().map(|row| of(&[*row])).collect(),
                program: self.formulas.program(rows),
            }
        });
        self.prepared_steps = prepared.collect();
    }

    /// The first rows that have as much to say as there is to know; what is left over restricts the point.
    fn moving(&self, step: usize, rough: &[f64]) -> Option<Moving> {
        let map = self.maps.steps.get(step)?;
        let StepRows { all, each, program } = self.prepared_steps.get(step)?;
        let unknowns: Vec<Unknown> = all.iter().map(|&slot| Unknown { slot, imaginary: false }).collect();
        let jacobian = self.jacobian::<Reals>(program, rough, &unknowns);
        let (mut slots, mut units) = (BTreeSet::new(), Vec::<Vec<f64>>::new());
        let (mut taken, mut determined) = (0, false);
        for (row, gradient) in each.iter().zip(&jacobian) {
            slots.extend(row.iter().copied());
            taken += 1;
            units.extend(new_direction(gradient.clone(), &units));
            determined = units.len() >= slots.len();
            if determined && map.of.iter().all(|of| slots.contains(of)) {
                break;
            }
        }
        // rows enough, but not here: where they cannot be solved there are no derivatives
        if taken >= slots.len() && !determined {
            return None;
        }
        let columns: Vec<usize> = (0..all.len())
            .filter(|&n| all.get(n).is_some_and(|slot| slots.contains(slot)))
            .collect();
        let chosen = |row: &Vec<f64>| columns.iter().filter_map(|&column| row.get(column).copied()).collect();
        let mut program = program.clone();
        program.outputs.truncate(taken);
        Some(Moving {
            program,
            slots: slots.into_iter().collect(),
            jacobian: jacobian.iter().take(taken).map(chosen).collect(),
            determined,
        })
    }

    /// The slopes of the moving slots by one quantity, all else held.
    fn along<T: Real>(&self, moving: &Moving, by: usize, values: &[T]) -> Option<Vec<T>> {
        let start = |of: &usize| {
            self.partial(*of, by)
                .and_then(|slot| values.get(slot))
                .cloned()
                .unwrap_or_else(T::zero)
        };
        let mut slopes: Vec<T> = moving.slots.iter().map(start).collect();
        let mut lifted: Vec<Dual<T>> = values.iter().map(|value| Dual::from_re(value.clone())).collect();
        lifted.get_mut(by)?.eps = T::one();
        // Each step gains the digits of the Jacobian in f64: two for f64 itself, six for 40 digits near grazing.
        let wide = <T as Analytic>::epsilon().to_f64() < 1e-20;
        let (steps, enough) = if wide { (8, SLOPE_WIDE) } else { (3, SLOPE) };
        let mut last = f64::INFINITY;
        for _ in 0..steps {
            for (slot, slope) in moving.slots.iter().zip(&slopes) {
                lifted.get_mut(*slot)?.eps = slope.clone();
            }
            let found = moving.program.run(&self.inputs(&lifted, None));
            let rest: Vec<f64> = moving
                .program
                .outputs(&found)
                .iter()
                .map(|value| value.eps.to_f64())
                .collect();
            let change = least(moving.jacobian.clone(), &rest, moving.slots.len());
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
