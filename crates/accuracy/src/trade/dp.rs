//! The task `dp`: entries, trace and determinant of DP by closed form, dual numbers and differences.

use super::contest::{self, EVERY, Exact, Means, RIGHT, Task, Twice, relative_error};
use super::points::{Point, Region, points};
use super::{TradeError, TradeOptions, TradeRow, Unsolved};
use dynamics::model::{Forcing, JacobianError, Motion, Order, Pair, Passage};
use nalgebra::Matrix2;
use num_dual::DualNum;
use numbers::{Analytic, Machine, Rung};

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

    /// By the closed form and by dual numbers.
    fn exact(self) -> Twice<Point> {
        fn both(quantity: Quantity, point: &Point) -> Option<[Vec<Exact>; 2]> {
            let by = |method| Way { quantity, method }.answer(point);
            Some([by(Method::Formula).ok()?, by(Method::Dual).ok()?])
        }
        match self {
            Self::Entries => |point| both(Self::Entries, point),
            Self::Trace => |point| both(Self::Trace, point),
            Self::Determinant => |point| both(Self::Determinant, point),
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
    /// With the step that balances rounding against truncation, or with one of 10^-n.
    Difference(Order, Option<usize>),
}

/// The steps of differences, as powers of 1/10 of the distance over which the map changes by its own size.
const STEPS: [usize; 9] = [1, 2, 3, 4, 6, 8, 12, 16, 24];

impl Method {
    fn all_for(quantity: Quantity) -> Vec<Self> {
        let mut all = vec![Self::Formula];
        // of the entries the product of (20) and (21) is the closed form
        if quantity != Quantity::Entries {
            all.push(Self::Product);
        }
        all.push(Self::Dual);
        for order in [Order::Two, Order::Four, Order::Six] {
            all.push(Self::Difference(order, None));
            // trace and determinant are of the same matrix
            if quantity == Quantity::Entries {
                all.extend(STEPS.map(|step| Self::Difference(order, Some(step))));
            }
        }
        all
    }

    fn name(self) -> &'static str {
        match self {
            Self::Formula => "formula",
            Self::Product => "product",
            Self::Dual => "dual",
            Self::Difference(Order::Two, _) => "difference-2",
            Self::Difference(Order::Four, _) => "difference-4",
            Self::Difference(Order::Six, _) => "difference-6",
        }
    }
}

/// The step of so many zeros.
fn part(step: usize) -> f64 {
    0.1_f64.powi(step as i32)
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
        let motion = Motion::new(number(point.g), T::one(), number(point.r_b), number(point.r_t)).ok()?;
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
        let pair = Pair::new(&self.motion, &self.forcing, &self.time, &self.velocity, [first, second]);
        let product = match (method, quantity) {
            (Method::Formula, Quantity::Trace) => return Ok(scalar(pair.trace_by_formula()?)),
            (Method::Formula, Quantity::Determinant) => {
                return Ok(scalar(pair.determinant_by_formula()?));
            }
            (Method::Formula | Method::Product, _) => pair.by_formula()?,
            (Method::Dual, _) => pair.product(Passage::by_duals)?,
            (Method::Difference(order, None), _) => pair.product(|passage| passage.by_differences(order))?,
            (Method::Difference(order, Some(step)), _) => {
                pair.product(|passage| passage.by_differences_over(order, part(step)))?
            }
        };
        Ok(quantity.of(&product))
    }
}

/// A means to one of the quantities.
struct Way {
    quantity: Quantity,
    method: Method,
}

impl Means<Point> for Way {
    fn name(&self) -> &'static str {
        self.method.name()
    }

    fn setting(&self) -> String {
        match self.method {
            Method::Difference(_, Some(step)) => format!("step=1e-{step}"),
            _ => String::new(),
        }
    }

    fn rungs(&self) -> &'static [Rung] {
        match self.method {
            // a step of less than a rounding is none
            Method::Difference(_, Some(0..=6)) => &EVERY[..3],
            Method::Difference(_, Some(7..=15)) => &EVERY[1..3],
            Method::Difference(_, Some(_)) => &EVERY[2..3],
            // more digits buy two thirds of them at a thousand times the cost
            Method::Difference(_, None) => &EVERY[..3],
            _ => EVERY,
        }
    }

    fn answer<T: Machine>(&self, point: &Point) -> Result<Vec<T>, Unsolved> {
        let input = Input::new(point).ok_or(Unsolved::LeftDomain)?;
        let answer = input.evaluate(self.quantity, self.method);
        answer.map(|answer| answer.to_vec()).map_err(|_| Unsolved::LeftDomain)
    }
}

/// The trade of task `dp`: entries, trace and determinant of DP at random points and close to grazing.
///
/// Every means starts from (g, r_B, r_T, t_k, Zdot_k, T_1, T_2), numbers that f32 holds exactly, with
/// T_1 + T_2 = 2, so that (22) and (23) hold; the flights need not be solved. The exact value is that of these very
/// inputs, taken from the closed form and confirmed through dual numbers. An error is relative to the largest of the
/// exact values.
pub(super) fn rows(options: &TradeOptions) -> Result<Vec<TradeRow>, TradeError> {
    let mut rows = Vec::new();
    for region in [Region::Random, Region::Grazing] {
        let points = points(region, options.points, options.seed);
        for quantity in Quantity::ALL {
            let task = Task {
                name: format!("dp/{}/{}", region.name(), quantity.name()),
                points: &points,
                error: relative_error,
                miss: |_, _| Unsolved::FewDigits,
                place: Point::place,
                right: RIGHT,
            };
            let means: Vec<Way> = Method::all_for(quantity)
                .into_iter()
                .map(|method| Way { quantity, method })
                .collect();
            rows.extend(contest::rows(&task, quantity.exact(), &means, options)?);
        }
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::super::{Latency, trade};
    use super::*;

    fn few() -> Vec<TradeRow> {
        let options = TradeOptions {
            points: 60,
            seconds_per_row: 0.0,
            seed: 7,
            ..TradeOptions::default()
        };
        trade(super::super::Task::Dp, &options, &Latency::none()).expect("a trade")
    }

    fn row<'a>(rows: &'a [TradeRow], task: &str, number: Rung, method: &str) -> &'a TradeRow {
        let wanted = |row: &&TradeRow| row.task == task && row.number == number && row.method == method;
        rows.iter()
            .find(wanted)
            .unwrap_or_else(|| panic!("{task} {number} {method}"))
    }

    #[test]
    fn every_task_has_every_means_in_every_number_and_a_front() {
        let rows = few();
        // three differences in three numbers, the others in four; of the entries five steps in three numbers, two in two
        // and two in one
        assert_eq!(rows.len(), 2 * (3 * 9 + 4 * (2 + 3 + 3) + 3 * (5 * 3 + 2 * 2 + 2)));
        for task in ["dp/random/entries", "dp/grazing/trace", "dp/grazing/determinant"] {
            assert!(rows.iter().any(|row| row.task == task && row.on_front));
        }
    }

    #[test]
    fn formula_and_duals_keep_nearly_all_digits_at_random_points_and_differences_do_not() {
        let rows = few();
        let digits = |number, method| row(&rows, "dp/random/entries", number, method).worst;
        for (number, least) in [
            (Rung::Single, 4.5),
            (Rung::Double, 13.0),
            (Rung::DoubleDouble, 28.0),
            (Rung::Wide(50), 55.0),
        ] {
            assert!(
                digits(number, "formula") > least && digits(number, "dual") > least,
                "{number}"
            );
        }
        assert!(digits(Rung::Double, "difference-2") < digits(Rung::Double, "formula") - 3.0);
    }

    #[test]
    fn a_difference_of_the_fourth_order_keeps_more_digits_than_one_of_the_second() {
        let rows = few();
        let digits = |number, method| row(&rows, "dp/random/entries", number, method).digits;
        for number in [Rung::Double, Rung::DoubleDouble] {
            assert!(digits(number, "difference-4") > digits(number, "difference-2") + 1.0);
        }
    }

    #[test]
    fn the_step_that_is_used_is_about_the_best_of_its_ladder() {
        let rows = few();
        for method in ["difference-2", "difference-4", "difference-6"] {
            for number in [Rung::Double, Rung::DoubleDouble] {
                let is_meant =
                    |row: &&TradeRow| row.task == "dp/random/entries" && row.method == method && row.number == number;
                let ladder = rows.iter().filter(is_meant).filter(|row| !row.setting.is_empty());
                let best = ladder.map(|row| row.digits).fold(0.0, f64::max);
                let used = row(&rows, "dp/random/entries", number, method).digits;
                // the best is known only when all have been tried
                assert!(used > best - 1.5, "{method} {number}: {used}, {best}");
            }
        }
    }

    #[test]
    fn close_to_grazing_every_means_loses_digits() {
        let rows = few();
        for method in ["formula", "dual", "difference-2", "difference-4", "difference-6"] {
            let digits = |region: &str| row(&rows, &format!("dp/{region}/entries"), Rung::Double, method).digits;
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
        let none = trade(super::super::Task::Dp, &options, &Latency::none());
        assert!(matches!(none, Err(TradeError::Points { .. })));
    }
}
