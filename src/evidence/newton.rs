//! Gauss-Newton steps of minimum norm: from anywhere near onto the solution set, however many unknowns are left free.

use super::course::Course;
use super::program::{Env, Node};
use super::tolerance::{DEPENDENT, PREMISE};
use crate::number::{Analytic, Gradient};
use nalgebra::{Const, U1};

/// Equations to be met, and the slots that may be moved for it.
#[derive(Clone, Debug)]
pub struct Equations<'a> {
    rows: Vec<&'a Node>,
    unknowns: Vec<usize>,
    /// For each row the unknowns it depends on, by position.
    columns: Vec<Vec<usize>>,
    courses: &'a [Course],
}

/// The most steps from a start; quadratic convergence takes some six.
const MOST_STEPS: usize = 25;

impl<'a> Equations<'a> {
    /// The rows as equations for the unknowns.
    pub fn new(rows: Vec<&'a Node>, unknowns: Vec<usize>, courses: &'a [Course]) -> Self {
        let columns = rows.iter().map(|row| {
            row.slots(courses)
                .iter()
                .filter_map(|slot| unknowns.binary_search(slot).ok())
                .collect()
        });
        let columns = columns.collect();
        Self {
            rows,
            unknowns,
            columns,
            courses,
        }
    }

    /// The Jacobian by dual numbers.
    fn jacobian(&self, values: &[f64]) -> Vec<Vec<f64>> {
        let mut slopes = Slopes::new(values, self.courses);
        let row = |(row, columns): (&&Node, &Vec<usize>)| {
            let mut entries = vec![0.0; self.unknowns.len()];
            let slots: Vec<usize> = columns
                .iter()
                .filter_map(|&column| self.unknowns.get(column).copied())
                .collect();
            for (column, slope) in columns.iter().zip(slopes.of(row, &slots)) {
                if let Some(entry) = entries.get_mut(*column) {
                    *entry = slope;
                }
            }
            entries
        };
        self.rows.iter().zip(&self.columns).map(row).collect()
    }

    /// The residuals, and the largest relative to the size of its terms.
    fn residuals<T: Analytic>(&self, values: &[T]) -> (Vec<f64>, f64) {
        let rough: Vec<f64> = values.iter().map(Analytic::to_f64).collect();
        let env = Env {
            values,
            running: None,
            upper: None,
            courses: self.courses,
        };
        let rough_env = Env {
            values: &rough,
            running: None,
            upper: None,
            courses: self.courses,
        };
        let mut worst = 0.0_f64;
        let each = self.rows.iter().map(|row| {
            let (value, size) = (row.value(&env).to_f64(), row.sized(&rough_env).1);
            // NaN counts as large.
            let relative = if value == 0.0 { 0.0 } else { (value / size).abs() };
            worst = if relative <= worst { worst } else { relative };
            value
        });
        let residuals = each.collect();
        (residuals, worst)
    }

    /// Moves the values onto the solution set; the largest relative residual that is left. Over a wide number the
    /// Jacobian stays that of f64, and the steps refine the point by its digits each.
    pub fn solve<T: Analytic>(&self, values: &mut [T], enough: f64) -> f64 {
        let mut best = f64::INFINITY;
        let mut after = 0;
        for _ in 0..MOST_STEPS {
            let (residuals, worst) = self.residuals(values);
            // One step more than enough, for the last digits.
            after += usize::from(worst <= enough);
            if after > 1 || worst == 0.0 || (worst <= PREMISE && worst > 0.5 * best) || worst.is_nan() {
                return worst;
            }
            best = best.min(worst);
            let rough: Vec<f64> = values.iter().map(Analytic::to_f64).collect();
            let step = least(self.jacobian(&rough), &residuals, self.unknowns.len());
            let length = step.iter().map(|x| x * x).sum::<f64>().sqrt();
            if !length.is_finite() {
                return f64::NAN;
            }
            // Far from the solution a step is a direction only.
            let part = if length > 1.5 { 1.5 / length } else { 1.0 };
            for (slot, change) in self.unknowns.iter().zip(&step) {
                if let Some(value) = values.get_mut(*slot) {
                    *value -= T::from_f64(change * part);
                }
            }
        }
        self.residuals(values).1
    }
}

/// Derivatives by this many slots are found at once: a row has some ten to twenty.
const LANES: usize = 8;

/// Derivatives of formulas at one point.
pub struct Slopes<'a> {
    lifted: Vec<Gradient<LANES>>,
    courses: &'a [Course],
}

impl<'a> Slopes<'a> {
    /// At a point.
    pub fn new(values: &[f64], courses: &'a [Course]) -> Self {
        Self {
            lifted: values.iter().map(|value| Gradient::from_re(*value)).collect(),
            courses,
        }
    }

    /// The derivatives of a formula by these slots, in their order.
    pub fn of(&mut self, node: &Node, slots: &[usize]) -> Vec<f64> {
        let mut slopes = Vec::with_capacity(slots.len());
        for some in slots.chunks(LANES) {
            for (lane, slot) in some.iter().enumerate() {
                if let Some(value) = self.lifted.get_mut(*slot) {
                    *value = value.derivative(lane);
                }
            }
            let env = Env {
                values: &self.lifted,
                running: None,
                upper: None,
                courses: self.courses,
            };
            let found = node.value(&env).eps.unwrap_generic(Const::<LANES>, U1);
            slopes.extend(found.iter().take(some.len()));
            for slot in some {
                if let Some(value) = self.lifted.get_mut(*slot) {
                    *value = Gradient::from_re(value.re);
                }
            }
        }
        slopes
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
    while let Some((most, size)) = rows
        .iter()
        .map(|row| norm(row))
        .enumerate()
        .max_by(|(_, a), (_, b)| a.total_cmp(b))
    {
        if size.is_nan() || size < DEPENDENT {
            break;
        }
        let (mut unit, value) = (rows.swap_remove(most), right.swap_remove(most) / size);
        unit.iter_mut().for_each(|entry| *entry /= size);
        for (row, rest) in rows.iter_mut().zip(&mut right) {
            let along: f64 = row.iter().zip(&unit).map(|(a, b)| a * b).sum();
            row.iter_mut()
                .zip(&unit)
                .for_each(|(entry, part)| *entry -= along * part);
            *rest -= along * value;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Wide;

    /// x² + y² = 2 and x y = 1 with z free: rows that are dependent at the solution itself.
    fn circle() -> [Node; 2] {
        let square = |slot| Node::Power(Box::new(Node::Slot(slot)), 2);
        let circle = Node::Sum(vec![square(0), square(1)]).minus(Node::Number(2, 1));
        let line = Node::Slot(0).minus(Node::Slot(2));
        [circle, line]
    }

    #[test]
    fn finds_the_solution_next_to_the_start() {
        let rows = circle();
        let equations = Equations::new(rows.iter().collect(), vec![0, 1, 2], &[]);
        let mut values = [0.3_f64, 1.9, -0.2];
        assert!(equations.solve(&mut values, 1e-15) < 1e-14);
        assert!((values[0] * values[0] + values[1] * values[1] - 2.0).abs() < 1e-14);
        let mut wide = values.map(Wide::<40>::from_f64);
        assert!(equations.solve(&mut wide, 1e-36) < 1e-36);
    }

    #[test]
    fn the_shortest_solution_leaves_out_what_is_said_twice() {
        let solution = least(vec![vec![1.0, 1.0], vec![2.0, 2.0]], &[2.0, 4.0], 2);
        assert!((solution[0] - 1.0).abs() < 1e-15 && (solution[1] - 1.0).abs() < 1e-15);
    }
}
