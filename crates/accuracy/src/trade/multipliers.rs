//! The task `multipliers`: the eigenvalues (19) of a trace and a determinant, the square of r_B r_T, as printed and without
//! cancellation.

use super::contest::{self, BITS, EVERY, Form, Means, RIGHT, Task, Twice, worst_relative_error};
use super::{TradeError, TradeOptions, TradeRow, Unsolved};
use dynamics::orbit::{OrbitKind, multipliers};
use numbers::{Analytic, Machine, Rung, Sequence};

/// A real pair of multipliers, by numbers that f32 holds exactly.
struct Point {
    trace: f64,
    /// r_B r_T, the root of the determinant.
    loss: f64,
}

/// Where the points lie.
#[derive(Clone, Copy)]
enum Region {
    /// Nodes and saddles with multipliers of like size.
    Random,
    /// Saddles with a trace of 1e2 to 1e6, as beside a grazing.
    Saddle,
}

impl Region {
    fn name(self) -> &'static str {
        match self {
            Self::Random => "multipliers/random",
            Self::Saddle => "multipliers/saddle",
        }
    }

    fn points(self, options: &TradeOptions) -> Vec<Point> {
        let mut sequence = Sequence::new(options.seed);
        let draw = || {
            let narrow = |value: f64| f64::from(value as f32);
            let loss = narrow(sequence.on_grid(BITS, 0.05, 0.9));
            let (low, high) = match self {
                Self::Random => ((2.1 * loss).log10(), 1.0),
                Self::Saddle => (2.0, 6.0),
            };
            let size = 10_f64.powf(sequence.on_grid(BITS, low, high));
            let sign = if sequence.on_grid(BITS, 0.0, 1.0) < 0.5 {
                -1.0
            } else {
                1.0
            };
            let trace = narrow(sign * size);
            Point { trace, loss }
        };
        std::iter::repeat_with(draw).take(options.points).collect()
    }
}

/// Printed, (19): (Tr ± sqrt(Tr² - 4 Det)) / 2. Stable: Delta as a product, the larger in size so, the other from the
/// determinant.
struct Way(Form);

impl Means<Point> for Way {
    fn name(&self) -> &'static str {
        self.0.name()
    }

    fn rungs(&self) -> &'static [Rung] {
        EVERY
    }

    fn answer<T: Machine>(&self, point: &Point) -> Result<Vec<T>, Unsolved> {
        let [trace, loss] = [point.trace, point.loss].map(<T as Analytic>::from_f64);
        let [larger, smaller] = match self.0 {
            Form::Stable => multipliers(&trace, &loss, OrbitKind::Saddle).map(|multiplier| multiplier.re),
            Form::Printed => {
                let delta = trace.clone() * trace.clone() - T::from_integer(4) * (loss.clone() * loss);
                let root = Analytic::sqrt(&delta);
                let half = T::from_ratio(1, 2);
                let [plus, minus] = [trace.clone() + root.clone(), trace - root].map(|sum| sum * half.clone());
                if point.trace < 0.0 {
                    [minus, plus]
                } else {
                    [plus, minus]
                }
            }
        };
        Ok(vec![larger, smaller])
    }
}

/// The trade of task `multipliers`: random nodes and saddles, and saddles beside a grazing.
pub(super) fn rows(options: &TradeOptions) -> Result<Vec<TradeRow>, TradeError> {
    let mut rows = Vec::new();
    for region in [Region::Random, Region::Saddle] {
        let task = Task {
            name: region.name().to_owned(),
            points: &region.points(options),
            error: worst_relative_error,
            miss: |_, _| Unsolved::FewDigits,
            place: |Point { trace, loss }| format!("trace={trace};r_B r_T={loss}"),
            right: RIGHT,
        };
        let exact: Twice<Point> = |point| {
            Some([
                Way(Form::Stable).answer(point).ok()?,
                Way(Form::Printed).answer(point).ok()?,
            ])
        };
        rows.extend(contest::rows(&task, exact, &Form::ALL.map(Way), options)?);
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_form_loses_digits_where_a_multiplier_is_large_and_ours_does_not() {
        let options = TradeOptions {
            points: 80,
            seconds_per_row: 0.0,
            ..TradeOptions::default()
        };
        let rows = rows(&options).expect("a trade");
        assert_eq!(rows.len(), 2 * 2 * 4);
        let worst = |task: &str, method: &str, number: Rung| {
            let row = rows
                .iter()
                .find(|row| row.task == task && row.method == method && row.number == number);
            row.expect("a row").worst
        };
        for (number, digits) in [(Rung::Double, 15.0), (Rung::DoubleDouble, 30.0), (Rung::Wide(50), 58.0)] {
            assert!(worst("multipliers/saddle", "stable", number) > digits);
            assert!(worst("multipliers/saddle", "printed", number) < digits - 4.0);
        }
    }
}
