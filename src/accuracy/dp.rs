//! The task `dp`: entries, trace and determinant of DP by closed form, dual numbers and differences.

use super::clock::median_seconds;
use super::points::{Point, Region, points};
use super::trade::{TradeError, TradeOptions, TradeRow, digits_of, mark_front, quantile};
use crate::model::{Forcing, JacobianError, Motion, Order, Pair, Passage};
use crate::number::{Analytic, Counted, Counts, Machine, Wide};
use nalgebra::Matrix2;
use num_dual::DualNum;

/// The number that judges: 24 digits beyond f64, of which grazing may eat some.
type Exact = Wide<40>;

/// Two ways to the exact value have to agree this far before it judges f64.
const REFERENCE_DIGITS: f64 = 25.0;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantity {
    Entries,
    Trace,
    Determinant,
}

impl Quantity {
    const ALL: [Self; 3] = [Self::Entries, Self::Trace, Self::Determinant];

    fn name(self) -> &'static str {
        match self {
            Self::Entries => "entries",
            Self::Trace => "trace",
            Self::Determinant => "determinant",
        }
    }

    /// The quantity of a matrix; a scalar in the first of four places.
    fn of<T: Analytic>(self, matrix: &Matrix2<T>) -> [T; 4] {
        let [a, b, c, d] = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|at| matrix[at].clone());
        match self {
            Self::Entries => [a, b, c, d],
            Self::Trace => scalar(a + d),
            Self::Determinant => scalar(a * d - b * c),
        }
    }
}

fn scalar<T: Analytic>(value: T) -> [T; 4] {
    [value, T::zero(), T::zero(), T::zero()]
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    /// (20) to (23) as they stand: the closed form of the very quantity.
    Formula,
    /// Trace or determinant of the product of the closed entries (20), (21).
    Product,
    Dual,
    Difference(Order),
}

impl Method {
    fn all_for(quantity: Quantity) -> Vec<Self> {
        let all = [
            Self::Formula,
            Self::Product,
            Self::Dual,
            Self::Difference(Order::Two),
            Self::Difference(Order::Four),
        ];
        // of the entries the product of (20) and (21) is the closed form
        all.into_iter()
            .filter(|method| quantity != Quantity::Entries || *method != Self::Product)
            .collect()
    }

    fn name(self) -> &'static str {
        match self {
            Self::Formula => "formula",
            Self::Product => "product",
            Self::Dual => "dual",
            Self::Difference(Order::Two) => "difference-2",
            Self::Difference(Order::Four) => "difference-4",
        }
    }
}

/// A point in the number of a method.
struct Input<T> {
    motion: Motion<T>,
    forcing: Forcing<T>,
    time: T,
    velocity: T,
    durations: [T; 2],
}

impl<T: Analytic> Input<T> {
    /// `None` where a parameter is out of range, which no point is.
    fn new(point: &Point) -> Option<Self> {
        let number = T::from_f64;
        // the gap is wherever the flights lead; no method asks for it
        let motion = Motion::new(
            number(point.g),
            T::one(),
            number(point.r_b),
            number(point.r_t),
        )
        .ok()?;
        let durations = point.durations.map(number);
        let (time, velocity) = (number(point.time), number(point.velocity));
        Some(Self {
            motion,
            forcing: Forcing::harmonic(&T::zero()),
            time,
            velocity,
            durations,
        })
    }

    /// From the inputs to the answer.
    fn evaluate(&self, quantity: Quantity, method: Method) -> Result<[T; 4], JacobianError>
    where
        T: DualNum,
    {
        let [first, second] = &self.durations;
        let pair = Pair::new(
            &self.motion,
            &self.forcing,
            &self.time,
            &self.velocity,
            [first, second],
        );
        let product = match (method, quantity) {
            (Method::Formula, Quantity::Trace) => return Ok(scalar(pair.trace_by_formula()?)),
            (Method::Formula, Quantity::Determinant) => {
                return Ok(scalar(pair.determinant_by_formula()?));
            }
            (Method::Formula | Method::Product, _) => pair.product(Passage::by_formula)?,
            (Method::Dual, _) => pair.product(Passage::by_duals)?,
            (Method::Difference(order), _) => {
                pair.product(|passage| passage.by_differences(order))?
            }
        };
        Ok(quantity.of(&product))
    }
}

/// The largest difference over the largest exact value, 0 for 0/0.
fn relative_error(found: &[Exact; 4], exact: &[Exact; 4]) -> f64 {
    // unlike f64::max this lets NaN through
    let largest = |values: [f64; 4]| {
        values
            .into_iter()
            .fold(0.0, |a: f64, b| if b.abs() <= a { a } else { b.abs() })
    };
    let apart = [0, 1, 2, 3].map(|at| (found[at].clone() - exact[at].clone()).to_f64());
    let size = largest(exact.each_ref().map(Analytic::to_f64));
    let apart = largest(apart);
    if apart == 0.0 { 0.0 } else { apart / size }
}

/// What the points of a task are judged by.
struct Reference<'a> {
    task: String,
    quantity: Quantity,
    points: &'a [Point],
    exact: Vec<[Exact; 4]>,
}

impl<'a> Reference<'a> {
    fn new(task: String, quantity: Quantity, points: &'a [Point]) -> Result<Self, TradeError> {
        let mut exact = Vec::with_capacity(points.len());
        for (index, point) in points.iter().enumerate() {
            let by = |method| {
                Input::<Exact>::new(point).and_then(|input| input.evaluate(quantity, method).ok())
            };
            let both = by(Method::Formula).zip(by(Method::Dual));
            let digits = both.as_ref().map_or(0.0, |(formula, dual)| {
                digits_of(relative_error(dual, formula), 1e-40)
            });
            match both {
                Some((formula, _)) if digits >= REFERENCE_DIGITS => exact.push(formula),
                _ => {
                    return Err(TradeError::Reference {
                        task,
                        point: index,
                        digits,
                    });
                }
            }
        }
        Ok(Self {
            task,
            quantity,
            points,
            exact,
        })
    }

    /// One row: `method` in `T`, its operations counted in `Counted<T>`.
    fn row<T: Machine>(&self, number: &'static str, method: Method, budget: f64) -> TradeRow {
        let epsilon = <T as Analytic>::epsilon().to_f64();
        let inputs: Vec<Input<T>> = self.points.iter().filter_map(Input::new).collect();
        let digits: Vec<f64> = inputs
            .iter()
            .zip(&self.exact)
            .map(|(input, exact)| {
                let found = input.evaluate(self.quantity, method);
                let found = found
                    .map(|found| found.map(|part| <Exact as Analytic>::from_f64(part.to_f64())));
                digits_of(
                    found.map_or(f64::NAN, |found| relative_error(&found, exact)),
                    epsilon,
                )
            })
            .collect();
        let counts = self.count::<T>(method);
        let seconds = median_seconds(budget, || {
            for input in &inputs {
                let _ = std::hint::black_box(
                    std::hint::black_box(input).evaluate(self.quantity, method),
                );
            }
        });
        let mean = |total: u64| (total as f64 / self.points.len() as f64).round() as u64;
        TradeRow {
            task: self.task.clone(),
            number,
            method: method.name(),
            operations: mean(counts.total()),
            seconds: seconds / self.points.len() as f64,
            digits: quantile(&digits, 0.05),
            on_front: false,
            worst_digits: quantile(&digits, 0.0),
            median_digits: quantile(&digits, 0.5),
            divisions: mean(counts.divisions),
            sincos: mean(counts.sincos),
        }
    }

    fn count<T: Machine>(&self, method: Method) -> Counts {
        let inputs: Vec<Input<Counted<T>>> = self.points.iter().filter_map(Input::new).collect();
        Counts::of(|| {
            for input in &inputs {
                // a point without an answer costs what was done until that was known
                let _ = input.evaluate(self.quantity, method);
            }
        })
        .1
    }
}

/// The trade of task `dp`: entries, trace and determinant of DP at random points and close to grazing.
///
/// Every means starts from (g, r_B, r_T, t_k, Zdot_k, T_1, T_2), numbers that f32 holds exactly, with
/// T_1 + T_2 = 2, so that (22) and (23) hold; the flights need not be solved. The exact value is that of these very
/// inputs in 40 digits, taken from the closed form and confirmed through dual numbers to 25 digits. An error is
/// relative to the largest of the exact values.
///
/// # Errors
/// `Points` without points, `Reference` where the two exact values disagree.
pub fn trade_dp(options: &TradeOptions) -> Result<Vec<TradeRow>, TradeError> {
    let mut rows = Vec::new();
    for region in [Region::Random, Region::Grazing] {
        let points = points(region, options.points, options.seed);
        for quantity in Quantity::ALL {
            let task = format!("dp/{}/{}", region.name(), quantity.name());
            if points.is_empty() || points.len() < options.points {
                return Err(TradeError::Points {
                    task,
                    wanted: options.points,
                    found: points.len(),
                });
            }
            let reference = Reference::new(task, quantity, &points)?;
            for method in Method::all_for(quantity) {
                rows.push(reference.row::<f32>("f32", method, options.seconds_per_row));
                rows.push(reference.row::<f64>("f64", method, options.seconds_per_row));
            }
        }
    }
    mark_front(&mut rows);
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn few() -> Vec<TradeRow> {
        let options = TradeOptions {
            points: 60,
            seconds_per_row: 0.0,
            seed: 7,
        };
        trade_dp(&options).unwrap_or_default()
    }

    fn row<'a>(rows: &'a [TradeRow], task: &str, number: &str, method: &str) -> &'a TradeRow {
        let wanted =
            |row: &&TradeRow| row.task == task && row.number == number && row.method == method;
        rows.iter()
            .find(wanted)
            .unwrap_or_else(|| panic!("{task} {number} {method}"))
    }

    #[test]
    fn every_task_has_every_means_in_both_numbers_and_a_front() {
        let rows = few();
        assert_eq!(rows.len(), 2 * 2 * (4 + 5 + 5));
        for task in [
            "dp/random/entries",
            "dp/grazing/trace",
            "dp/grazing/determinant",
        ] {
            assert!(rows.iter().any(|row| row.task == task && row.on_front));
        }
    }

    #[test]
    fn formula_and_duals_keep_nearly_all_digits_at_random_points_and_differences_do_not() {
        let rows = few();
        let digits = |number, method| row(&rows, "dp/random/entries", number, method).digits;
        assert!(digits("f64", "formula") > 13.0 && digits("f64", "dual") > 13.0);
        assert!(digits("f32", "formula") > 4.5 && digits("f32", "dual") > 4.5);
        assert!(digits("f64", "difference-2") < digits("f64", "formula") - 3.0);
    }

    #[test]
    fn close_to_grazing_every_means_loses_digits() {
        let rows = few();
        for method in ["formula", "dual", "difference-2", "difference-4"] {
            let digits = |region: &str| {
                row(&rows, &format!("dp/{region}/entries"), "f64", method).median_digits
            };
            assert!(digits("grazing") < digits("random"), "{method}");
        }
    }

    #[test]
    fn digits_and_operations_are_the_same_in_every_run() {
        let strip = |rows: Vec<TradeRow>| -> Vec<_> {
            rows.into_iter()
                .map(|row| (row.task, row.method, row.operations, row.digits.to_bits()))
                .collect()
        };
        assert_eq!(strip(few()), strip(few()));
    }

    #[test]
    fn without_points_there_is_an_error() {
        let options = TradeOptions {
            points: 0,
            ..TradeOptions::default()
        };
        assert!(matches!(
            trade_dp(&options),
            Err(TradeError::Points { wanted: 0, .. })
        ));
    }
}
