//! Cost against true error of each means, and which of them are worth having.

/// One means in one number at one task.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeRow {
    /// What is computed and where, as `dp/random/trace`.
    pub task: String,
    /// `f32`, `f64`.
    pub number: &'static str,
    /// The means.
    pub method: &'static str,
    /// Operations of one evaluation, from the inputs to the answer, rounded mean over the points: + - x ÷ and
    /// functions, each as one.
    pub operations: u64,
    /// Median wall time of one evaluation.
    pub seconds: f64,
    /// Digits that 19 of 20 points keep: the 5% quantile of -log10 of the relative error. 0 where there is no
    /// answer, never more than the number type holds.
    pub digits: f64,
    /// Whether no other means of the task is both cheaper and at least as accurate.
    pub on_front: bool,
    /// Digits at the worst point.
    pub worst_digits: f64,
    /// Digits at half of the points.
    pub median_digits: f64,
    /// Divisions among the operations.
    pub divisions: u64,
    /// Pairs of sine and cosine among the operations.
    pub sincos: u64,
}

impl TradeRow {
    /// The names of the columns, in the order of [`TradeRow::fields`].
    pub const COLUMNS: [&str; 11] = [
        "task",
        "number",
        "method",
        "operations",
        "seconds",
        "digits",
        "on_front",
        "worst_digits",
        "median_digits",
        "divisions",
        "sincos",
    ];

    /// The row as text, every number so that it reads back to the same value.
    pub fn fields(&self) -> [String; 11] {
        [
            self.task.clone(),
            self.number.to_string(),
            self.method.to_string(),
            self.operations.to_string(),
            format!("{:e}", self.seconds),
            self.digits.to_string(),
            self.on_front.to_string(),
            self.worst_digits.to_string(),
            self.median_digits.to_string(),
            self.divisions.to_string(),
            self.sincos.to_string(),
        ]
    }
}

/// How much to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TradeOptions {
    /// Points for each region.
    pub points: usize,
    /// Seconds of timing for each row.
    pub seconds_per_row: f64,
    /// Of the points: the same seed gives the same points on every machine.
    pub seed: u64,
}

impl Default for TradeOptions {
    /// 400 points put 20 below the 5% quantile; 0.05 s a row keeps a whole task within five seconds.
    fn default() -> Self {
        Self {
            points: 400,
            seconds_per_row: 0.05,
            seed: 1,
        }
    }
}

/// A comparison that could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TradeError {
    /// No points.
    #[error("{task} has {found} points of the {wanted} wanted")]
    Points {
        /// The task.
        task: String,
        /// How many were asked for.
        wanted: usize,
        /// How many there are.
        found: usize,
    },
    /// Two ways to the exact value disagree, so neither may judge.
    #[error("the references of {task} agree to {digits:.1} digits only at point {point}")]
    Reference {
        /// The task.
        task: String,
        /// The point, from 0.
        point: usize,
        /// How far they agree.
        digits: f64,
    },
}

/// Times closer than this ratio are taken as equal: a repeated run differs by as much. Operations decide there.
const SAME_TIME: f64 = 1.1;

/// Marks the rows that no other row of the same task beats: one that is cheaper and at least as accurate, or more
/// accurate and no dearer. A means that leaves no digit is on no front.
pub(super) fn mark_front(rows: &mut [TradeRow]) {
    let marks: Vec<bool> = rows
        .iter()
        .map(|row| {
            row.digits > 0.0
                && !rows
                    .iter()
                    .any(|other| other.task == row.task && beats(other, row))
        })
        .collect();
    for (row, mark) in rows.iter_mut().zip(marks) {
        row.on_front = mark;
    }
}

fn beats(a: &TradeRow, b: &TradeRow) -> bool {
    let (cheaper, dearer) = (costs_less(a, b), costs_less(b, a));
    (cheaper && a.digits >= b.digits) || (!dearer && a.digits > b.digits)
}

fn costs_less(a: &TradeRow, b: &TradeRow) -> bool {
    let same = a.seconds <= b.seconds * SAME_TIME && b.seconds <= a.seconds * SAME_TIME;
    if same {
        a.operations < b.operations
    } else {
        a.seconds < b.seconds
    }
}

/// -log10 of a relative error, between 0 and the digits that a number of this `epsilon` holds.
pub(super) fn digits_of(relative_error: f64, epsilon: f64) -> f64 {
    let most = -(0.5 * epsilon).log10();
    let digits = -relative_error.log10();
    // NaN, from no answer, is no digit; and no digit is 0, not -0
    if digits > 0.0 { digits.min(most) } else { 0.0 }
}

/// The smallest value with at least the fraction `part` of all values at or below it; 0 of nothing.
pub(super) fn quantile(values: &[f64], part: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let index = (part * sorted.len() as f64).ceil() as usize;
    sorted.get(index.saturating_sub(1)).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(method: &'static str, seconds: f64, operations: u64, digits: f64) -> TradeRow {
        TradeRow {
            task: "t".into(),
            number: "f64",
            method,
            operations,
            seconds,
            digits,
            on_front: false,
            worst_digits: 0.0,
            median_digits: 0.0,
            divisions: 0,
            sincos: 0,
        }
    }

    fn front(mut rows: Vec<TradeRow>) -> Vec<&'static str> {
        mark_front(&mut rows);
        rows.iter()
            .filter(|row| row.on_front)
            .map(|row| row.method)
            .collect()
    }

    #[test]
    fn the_front_holds_what_is_not_beaten() {
        let rows = vec![
            row("fast", 1.0, 10, 5.0),
            row("exact", 9.0, 90, 15.0),
            row("poor", 2.0, 20, 4.0),
        ];
        assert_eq!(front(rows), ["fast", "exact"]);
    }

    #[test]
    fn where_the_clock_cannot_tell_operations_decide() {
        let rows = vec![row("more", 1.0, 20, 5.0), row("fewer", 1.05, 10, 5.0)];
        assert_eq!(front(rows), ["fewer"]);
        let rows = vec![row("coarse", 1.0, 10, 4.0), row("fine", 1.05, 10, 5.0)];
        assert_eq!(front(rows), ["fine"]);
    }

    #[test]
    fn no_digits_are_no_answer_however_cheap() {
        assert_eq!(
            front(vec![row("nothing", 0.1, 1, 0.0), row("slow", 9.0, 9, 1.0)]),
            ["slow"]
        );
    }

    #[test]
    fn digits_lie_between_none_and_what_the_number_holds() {
        assert_eq!(digits_of(f64::NAN, f64::EPSILON), 0.0);
        assert_eq!(digits_of(f64::INFINITY, f64::EPSILON), 0.0);
        assert_eq!(digits_of(1e-8, f64::EPSILON), 8.0);
        assert!((digits_of(0.0, f64::EPSILON) - 15.95).abs() < 0.01);
    }

    #[test]
    fn a_quantile_is_one_of_the_values() {
        let values: Vec<f64> = (1..=20).rev().map(f64::from).collect();
        assert_eq!(quantile(&values, 0.05), 1.0);
        assert_eq!(quantile(&values, 0.5), 10.0);
        assert_eq!(quantile(&values, 0.0), 1.0);
        assert_eq!(quantile(&[], 0.5), 0.0);
    }
}
