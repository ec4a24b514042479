//! Gauss-Newton steps of minimum norm: from anywhere near onto the solution set, however many unknowns are left free.

use super::formula::{Inputs, Program};
use super::system::System;
use super::tolerance::{DEPENDENT, PREMISE};
use super::value::{Numbers, Real, Value};
use nalgebra::{Const, U1};
use numbers::{Analytic, Gradient};

/// The real or the imaginary part of a slot, to be moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unknown {
    pub slot: usize,
    pub imaginary: bool,
}

/// The most steps from a start; quadratic convergence takes some six.
const MOST_STEPS: usize = 25;

/// Derivatives by this many unknowns are found at once.
const LANES: usize = 8;

/// The value in f64.
pub fn rough<N: Numbers, T: Real>(value: &N::Of<T>) -> N::Of<f64> {
    let [re, im] = value.parts().map(|part| part.to_f64());
    N::Of::<f64>::new(re, im)
}

/// The value over another number type.
pub fn lift<N: Numbers, T: Real>(value: &N::Of<f64>) -> N::Of<T> {
    let [re, im] = value.parts().map(|part| <T as Analytic>::from_f64(part));
    N::Of::<T>::new(re, im)
}

impl System {
    /// What a program is evaluated with at a point.
    pub fn inputs<'a, V>(&'a self, slots: &'a [V], running: Option<&'a V>) -> Inputs<'a, V> {
        Inputs {
            slots,
            running,
            formulas: &self.formulas,
            work: &self.work,
            depth: 0,
        }
    }

    /// What may be moved of these slots.
    pub fn unknowns(&self, slots: impl IntoIterator<Item = usize>) -> Vec<Unknown> {
        let mut unknowns = Vec::new();
        for slot in slots.into_iter().filter(|slot| !self.fixed.contains(slot)) {
            unknowns.push(Unknown { slot, imaginary: false });
            if self.is_complex && self.kinds.get(slot).is_some_and(|kind| kind.complex) {
                unknowns.push(Unknown { slot, imaginary: true });
            }
        }
        unknowns
    }

    /// The Jacobian of a program by dual numbers: a row for the real part of each output and, over the complex numbers,
    /// one for its imaginary part.
    pub fn jacobian<N: Numbers>(
        &self,
        program: &Program,
        values: &[N::Of<f64>],
        unknowns: &[Unknown],
    ) -> Vec<Vec<f64>> {
        let parts = if N::COMPLEX { 2 } else { 1 };
        let mut rows = vec![vec![0.0; unknowns.len()]; program.outputs.len() * parts];
        let mut lifted: Vec<N::Of<Gradient<f64, LANES>>> = values.iter().map(lift::<N, Gradient<f64, LANES>>).collect();
        for (chunk, some) in unknowns.chunks(LANES).enumerate() {
            for (lane, unknown) in some.iter().enumerate() {
                if let Some(value) = lifted.get_mut(unknown.slot) {
                    let [mut re, mut im] = value.parts();
                    let part = if unknown.imaginary { &mut im } else { &mut re };
                    // Both parts of one slot may be seeded: each keeps the lane that it has.
                    *part += Gradient::from_re(0.0).derivative(lane);
                    *value = N::Of::<Gradient<f64, LANES>>::new(re, im);
                }
            }
            let found = program.outputs(&program.run(&self.inputs(&lifted, None)));
            for (output, value) in found.iter().enumerate() {
                for (part, value) in value.parts().into_iter().take(parts).enumerate() {
                    let slopes = value.eps.unwrap_generic(Const::<LANES>, U1);
                    if let Some(row) = rows.get_mut(output * parts + part) {
                        for (entry, slope) in row.iter_mut().skip(chunk * LANES).zip(slopes.iter()) {
                            *entry = *slope;
                        }
                    }
                }
            }
            for unknown in some {
                if let (Some(value), Some(known)) = (lifted.get_mut(unknown.slot), values.get(unknown.slot)) {
                    *value = lift::<N, Gradient<f64, LANES>>(known);
                }
            }
        }
        rows
    }

    /// The residuals, and the largest relative to the size of its terms; NaN where there is none.
    fn residuals<N: Numbers, T: Real>(&self, program: &Program, values: &[N::Of<T>]) -> (Vec<f64>, f64) {
        let parts = if N::COMPLEX { 2 } else { 1 };
        let found = program.run(&self.inputs(values, None));
        let near: Vec<N::Of<f64>> = found.iter().map(rough::<N, T>).collect();
        let sizes = program.sizes(&near, &|_| 0.0);
        let mut worst = 0.0_f64;
        let mut residuals = Vec::with_capacity(program.outputs.len() * parts);
        for &output in &program.outputs {
            let value = near.get(output).map(Value::parts).unwrap_or([f64::NAN; 2]);
            residuals.extend(value.into_iter().take(parts));
            let gap = value[0].hypot(value[1]);
            let size = sizes
                .as_ref()
                .and_then(|sizes| sizes.get(output))
                .copied()
                .unwrap_or(f64::NAN);
            let relative = match gap {
                0.0 => 0.0,
                // beside terms without a size, as where a slope is infinite, nothing is small
                _ if size.is_infinite() => f64::NAN,
                _ => gap / size,
            };
            // NaN counts as large, and stays.
            worst = if relative <= worst { worst } else { relative };
            if worst.is_nan() {
                break;
            }
        }
        (residuals, worst)
    }

    /// The size that errors of a slot are relative to, at a point where the premises were solved.
    pub fn solved<N: Numbers, T: Real>(&self, values: &[N::Of<T>]) -> impl Fn(usize) -> f64 {
        let sizes = self
            .row_slots
            .iter()
            .filter_map(|slot| values.get(*slot))
            .map(Value::size);
        let largest = sizes.fold(0.0, f64::max);
        move |slot| {
            if self.row_slots.binary_search(&slot).is_ok() {
                largest
            } else {
                0.0
            }
        }
    }

    /// The largest residual of the premises at a point, relative to the size of its terms.
    pub fn residual<N: Numbers>(&self, values: &[N::Of<f64>]) -> f64 {
        self.residuals::<N, f64>(&self.rows_program, values).1
    }

    /// Moves the unknowns onto the solution set; the largest relative residual that is left. Over a wide number the
    /// Jacobian stays that of f64, and the steps refine the point by its digits each.
    pub fn solve<N: Numbers, T: Real>(
        &self,
        program: &Program,
        values: &mut [N::Of<T>],
        unknowns: &[Unknown],
        enough: f64,
    ) -> f64 {
        let mut best = f64::INFINITY;
        let mut after = 0;
        // Beside a double root a step gains one bit.
        let most = if <T as Analytic>::epsilon().to_f64() < 1e-20 {
            4 * MOST_STEPS
        } else {
            MOST_STEPS
        };
        for _ in 0..most {
            let (residuals, worst) = self.residuals::<N, T>(program, values);
            // One step more than enough, for the last digits.
            after += usize::from(worst <= enough);
            let stalls = worst <= PREMISE && worst > 0.5 * best;
            if after > 1 || worst == 0.0 || stalls || worst.is_nan() || self.work.is_over() {
                return worst;
            }
            best = best.min(worst);
            let near: Vec<N::Of<f64>> = values.iter().map(rough::<N, T>).collect();
            let (rows, rank) = (residuals.len(), residuals.len().min(unknowns.len()));
            if !self.work.take(rows * rank * unknowns.len() / LANES) {
                return worst;
            }
            let step = least(self.jacobian::<N>(program, &near, unknowns), &residuals, unknowns.len());
            let length = norm(&step);
            if !length.is_finite() {
                return f64::NAN;
            }
            // Far from the solution a step is a direction only.
            let place = |unknown: &Unknown| near.get(unknown.slot).map_or(0.0, Value::size);
            let longest = (0.1 * norm(&unknowns.iter().map(place).collect::<Vec<f64>>())).max(1.5);
            let part = if length > longest { longest / length } else { 1.0 };
            for (unknown, change) in unknowns.iter().zip(&step) {
                if let Some(value) = values.get_mut(unknown.slot) {
                    let [mut re, mut im] = value.parts();
                    let change = <T as Analytic>::from_f64(change * part);
                    if unknown.imaginary {
                        im -= change
                    } else {
                        re -= change
                    }
                    *value = N::Of::<T>::new(re, im);
                }
            }
        }
        self.residuals::<N, T>(program, values).1
    }
}

/// The shortest solution of `rows x = right`, rows that say nothing new left out: Gram and Schmidt's method with
/// the row that is most its own taken next.
pub fn least(mut rows: Vec<Vec<f64>>, right: &[f64], unknowns: usize) -> Vec<f64> {
    let mut right: Vec<f64> = right.to_vec();
    for (row, value) in rows.iter_mut().zip(&mut right) {
        let norm = norm(row);
        if norm > 0.0 {
            row.iter_mut().for_each(|entry| *entry /= norm);
            *value /= norm;
        }
    }
    let mut solution = vec![0.0; unknowns];
    let mut lengths: Vec<f64> = rows.iter().map(|row| norm(row)).collect();
    while let Some((most, &size)) = lengths.iter().enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b)) {
        if size.is_nan() {
            return vec![f64::NAN; unknowns];
        }
        if size < DEPENDENT {
            break;
        }
        lengths.swap_remove(most);
        let (mut unit, value) = (rows.swap_remove(most), right.swap_remove(most) / size);
        unit.iter_mut().for_each(|entry| *entry /= size);
        for ((row, rest), length) in rows.iter_mut().zip(&mut right).zip(&mut lengths) {
            let along: f64 = row.iter().zip(&unit).map(|(a, b)| a * b).sum();
            if along != 0.0 {
                row.iter_mut()
                    .zip(&unit)
                    .for_each(|(entry, part)| *entry -= along * part);
                *rest -= along * value;
                *length = norm(row);
            }
        }
        solution
            .iter_mut()
            .zip(&unit)
            .for_each(|(entry, part)| *entry += value * part);
    }
    solution
}

/// Euclid's length.
pub fn norm(row: &[f64]) -> f64 {
    row.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Columns on which the rows can be solved, one for each row that says something new; `weights` prefer some to others.
pub fn basis(mut rows: Vec<Vec<f64>>, weights: &[f64]) -> Vec<usize> {
    let mut columns = Vec::new();
    for number in 0..rows.len() {
        let Some((row, rest)) = rows.get_mut(number..).and_then(|rows| rows.split_first_mut()) else {
            break;
        };
        let weighed =
            |(column, entry): (usize, &f64)| (column, entry.abs() * weights.get(column).copied().unwrap_or(1.0));
        let largest = row
            .iter()
            .enumerate()
            .map(weighed)
            .max_by(|(_, a), (_, b)| a.total_cmp(b));
        let Some((column, size)) = largest else { break };
        if size.is_nan() || size <= DEPENDENT {
            continue;
        }
        columns.push(column);
        for other in rest {
            let part = other[column] / row[column];
            other
                .iter_mut()
                .zip(row.iter())
                .for_each(|(entry, base)| *entry -= part * base);
        }
    }
    columns.sort_unstable();
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_solution_leaves_out_what_is_said_twice() {
        let solution = least(vec![vec![1.0, 1.0], vec![2.0, 2.0]], &[2.0, 4.0], 2);
        assert!((solution[0] - 1.0).abs() < 1e-15 && (solution[1] - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_basis_has_a_column_for_each_independent_row() {
        let rows = vec![vec![1.0, 1.0, 0.0], vec![2.0, 2.0, 0.0], vec![0.0, 1.0, 3.0]];
        assert_eq!(basis(rows.clone(), &[1.0, 2.0, 1.0]), [1, 2]);
        assert_eq!(basis(rows, &[2.0, 1.0, 1.0]), [0, 2]);
    }
}
