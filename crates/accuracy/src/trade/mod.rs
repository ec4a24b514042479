//! Cost against true error of each means, and which of them are worth having.

mod advice;
mod clock;
mod contest;
mod dp;
mod impact;
mod integration;
mod machine;
mod multipliers;
mod orbit;
mod points;
mod statistics;
mod voltage;

pub use advice::{Advice, AdviceError, Basis, Need, Rank, advise};
pub use clock::{Latency, Timing};
pub use machine::machine;

use numbers::Rung;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

/// One means in one number at one task.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeRow {
    /// What is computed and where, as `dp/random/trace`.
    pub task: String,
    /// The number it was computed in.
    pub number: Rung,
    /// The means.
    pub method: &'static str,
    /// Operations of one evaluation, from the inputs to the answer, rounded mean over the points: + - x ÷ and
    /// functions, each as one.
    pub operations: u64,
    /// Median wall time of one evaluation.
    pub seconds: f64,
    /// Digits at half of the problems that are solved: -log10 of the relative error, never more than the number type
    /// holds. 0 where none is.
    pub digits: f64,
    /// Whether no other means of the task costs less, keeps at least as many digits at 19 of 20 of what it solves, and
    /// solves at least as much.
    pub on_front: bool,
    /// Digits that 19 of 20 of the solved problems keep.
    pub worst: f64,
    /// How many problems came to the right answer: to 6 digits, or to half of those that the number holds.
    pub solved: usize,
    /// What became of each problem, in their order.
    pub problems: Vec<Attempt>,
    /// Divisions among the operations.
    pub divisions: u64,
    /// Pairs of sine and cosine among the operations.
    pub sincos: u64,
    /// Of the time: half of the distance between its quartiles, over the median.
    pub spread: f64,
    /// The time over L, [`Latency::least`], measured in the same run.
    pub latencies: f64,
    /// The step, tolerance, count of iterations or of impacts of the means, `key=value`; empty where it has none, or
    /// where it is the one that the means is used with.
    pub setting: String,
    /// The operations in instructions, as `golden/accuracy/weights.csv` has them: one scale for all numbers.
    pub cost: u64,
    /// Whether an answer comes with a proof of its bound.
    pub proved: bool,
}

impl TradeRow {
    /// The names of the columns.
    pub const COLUMNS: [&str; 18] = [
        "task",
        "number",
        "method",
        "operations",
        "seconds",
        "digits",
        "on_front",
        "worst",
        "solved",
        "problems",
        "failures",
        "divisions",
        "sincos",
        "spread",
        "latencies",
        "setting",
        "cost",
        "proved",
    ];

    /// The digits that hold at this share of all problems, solved or not.
    pub fn kept(&self, share: f64) -> f64 {
        let digits = self.problems.iter().map(|problem| problem.digits.unwrap_or(0.0));
        let count = self.problems.len() as f64;
        // of the least that may be left out, the next one counts
        let left_out = ((1.0 - share) * count + ROUNDING).floor();
        quantile(&digits.collect::<Vec<_>>(), (left_out + 1.0) / count)
    }

    /// Why problems are not solved, as `another orbit 3; no convergence 2`, the most frequent first.
    pub fn failures(&self) -> String {
        let mut counts: BTreeMap<Unsolved, usize> = BTreeMap::new();
        for miss in self.problems.iter().filter_map(|outcome| outcome.miss) {
            *counts.entry(miss).or_default() += 1;
        }
        let mut counts: Vec<(Unsolved, usize)> = counts.into_iter().collect();
        counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        let told = counts
            .into_iter()
            .map(|(miss, count)| format!("{} {count}", miss.name()));
        told.collect::<Vec<_>>().join("; ")
    }
}

/// A share times a count is a whole number to within this.
const ROUNDING: f64 = 1e-9;

/// What became of a problem.
#[derive(Clone, Debug, PartialEq)]
pub struct Attempt {
    /// The problem, `key=value;...`, as every means is given it.
    pub at: Arc<str>,
    /// The digits that hold of the answer; none where there is no answer.
    pub digits: Option<f64>,
    /// Why it is not solved, where it is not.
    pub miss: Option<Unsolved>,
}

/// Why a means does not come to the right answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unsolved {
    /// It comes to an orbit, but not the one beside its guess.
    AnotherOrbit,
    /// It comes to what solves its equations, and is no orbit.
    NoOrbit,
    /// Its steps do not become small.
    NoConvergence,
    /// There is no change of sign where it begins.
    NoBracket,
    /// It comes to where a formula has no value.
    LeftDomain,
    /// It comes to a contact that its number cannot decide.
    Undecided,
    /// It comes to the right answer, to fewer digits than count as solved.
    FewDigits,
}

impl Unsolved {
    /// As tables have it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::AnotherOrbit => "another orbit",
            Self::NoOrbit => "no orbit",
            Self::NoConvergence => "no convergence",
            Self::NoBracket => "no change of sign",
            Self::LeftDomain => "left the domain",
            Self::Undecided => "undecided contact",
            Self::FewDigits => "few digits",
        }
    }
}

/// What the means are compared on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// The Jacobian of a 1-1 motion's map, DP = DP_2 DP_1: its entries, trace and determinant.
    Dp,
    /// The multipliers of a trace and a determinant, (19).
    Multipliers,
    /// The voltage of an impact, (5) and (6).
    Voltage,
    /// The next impact.
    Impact,
    /// A 1-1 orbit, from guesses that are 0.1% to 20% off.
    Orbit,
    /// Mean voltage, voltage per period and Lyapunov exponent of a motion that is followed.
    Statistics,
}

impl Task {
    /// All of them, the quickest first.
    pub const ALL: [Self; 6] = [
        Self::Dp,
        Self::Multipliers,
        Self::Voltage,
        Self::Impact,
        Self::Orbit,
        Self::Statistics,
    ];

    /// As the command line has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dp => "dp",
            Self::Multipliers => "multipliers",
            Self::Voltage => "voltage",
            Self::Impact => "impact",
            Self::Orbit => "orbit",
            Self::Statistics => "statistics",
        }
    }

    /// Whether a part of it may have this in its name.
    pub fn is_named(self, text: &str) -> bool {
        match self {
            Self::Statistics => statistics::is_named(text),
            _ => text.is_empty() || text.starts_with(self.name()),
        }
    }
}

impl fmt::Display for Task {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// How much to measure.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeOptions {
    /// Points for each region.
    pub points: usize,
    /// Seconds of timing for each row.
    pub seconds_per_row: f64,
    /// Of the points: the same seed gives the same points on every machine.
    pub seed: u64,
    /// Only this means.
    pub method: Option<String>,
    /// Only this number.
    pub number: Option<Rung>,
}

impl TradeOptions {
    fn wants(&self, method: &str, number: Rung) -> bool {
        let other = self.method.as_ref().is_some_and(|wanted| wanted != method);
        !other && self.number.is_none_or(|wanted| wanted == number)
    }
}

impl Default for TradeOptions {
    /// 400 points put 20 below the 5% quantile; 0.05 s a row keeps a whole task within five seconds.
    fn default() -> Self {
        Self {
            points: 400,
            seconds_per_row: 0.05,
            seed: 1,
            method: None,
            number: None,
        }
    }
}

/// A comparison that could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TradeError {
    /// No points.
    #[error("{task} has no problems")]
    Points {
        /// The task.
        task: String,
    },
    /// Two ways to the exact value disagree, so neither may judge.
    #[error("the two references of {task} agree to {digits:.1} digits at problem {point}, not to {wanted}")]
    Reference {
        /// The task.
        task: String,
        /// The point, from 0.
        point: usize,
        /// How far they agree.
        digits: f64,
        /// How far they have to, before they judge the widest number.
        wanted: f64,
    },
    /// No means of a task has the name.
    #[error("no means {method} in {number}; `trade --format csv` lists those there are")]
    Means {
        /// What was asked for.
        method: String,
        /// And in which number.
        number: String,
    },
}

/// The trade of a task: a row for each of its parts, means and number.
///
/// Every means solves the same problems, which are the same in every run and on every machine; all but the time is
/// repeatable, and is given over `latency` as well. The exact answers are computed in 100 digits by two ways that share no formula, and agree to 15 digits
/// beyond the widest number they judge.
///
/// # Errors
/// `Reference` where they do not, `Points` where there are no problems, `Means` where `options` leave nothing.
pub fn trade(task: Task, options: &TradeOptions, latency: &Latency) -> Result<Vec<TradeRow>, TradeError> {
    let mut rows = match task {
        Task::Dp => dp::rows(options),
        Task::Multipliers => multipliers::rows(options),
        Task::Voltage => voltage::rows(options),
        Task::Impact => impact::rows(options),
        Task::Orbit => orbit::rows(options),
        Task::Statistics => statistics::rows(options),
    }?;
    if rows.is_empty() {
        return Err(TradeError::Means {
            method: options.method.clone().unwrap_or_else(|| "at all".to_owned()),
            number: options
                .number
                .map_or_else(|| "any number".to_owned(), |number| number.to_string()),
        });
    }
    let one = latency.least().median;
    for row in &mut rows {
        row.latencies = row.seconds / one;
    }
    mark_front(&mut rows);
    Ok(rows)
}

/// Times closer than this part and their own spreads, up to as much again, are taken as equal: a repeated run differs by
/// as much. Operations decide there.
const SAME_TIME: f64 = 0.1;

/// Marks the rows that no other row of the same task beats: one that is no dearer, keeps as many digits and solves as
/// many problems, and is better in one of these. A means that solves nothing is on no front.
fn mark_front(rows: &mut [TradeRow]) {
    let marks: Vec<bool> = rows
        .iter()
        .map(|row| row.solved > 0 && !rows.iter().any(|other| other.task == row.task && beats(other, row)))
        .collect();
    for (row, mark) in rows.iter_mut().zip(marks) {
        row.on_front = mark;
    }
}

fn beats(a: &TradeRow, b: &TradeRow) -> bool {
    let (cheaper, dearer) = (costs_less(a, b), costs_less(b, a));
    let is_as_good = a.worst >= b.worst && a.solved >= b.solved;
    let is_better = a.worst > b.worst || a.solved > b.solved;
    is_as_good && !dearer && (cheaper || is_better)
}

fn costs_less(a: &TradeRow, b: &TradeRow) -> bool {
    let same = 1.0 + SAME_TIME + (a.spread + b.spread).min(SAME_TIME);
    let same = a.seconds <= b.seconds * same && b.seconds <= a.seconds * same;
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
            number: Rung::Double,
            method,
            operations,
            seconds,
            digits,
            on_front: false,
            worst: digits,
            solved: usize::from(digits > 0.0),
            problems: Vec::new(),
            divisions: 0,
            sincos: 0,
            spread: 0.0,
            latencies: 0.0,
            setting: String::new(),
            cost: operations,
            proved: false,
        }
    }

    fn front(mut rows: Vec<TradeRow>) -> Vec<&'static str> {
        mark_front(&mut rows);
        rows.iter().filter(|row| row.on_front).map(|row| row.method).collect()
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
    fn what_solves_more_is_on_the_front_though_it_costs_more_and_keeps_fewer_digits() {
        let rows = vec![
            TradeRow {
                solved: 3,
                ..row("sharp", 1.0, 10, 15.0)
            },
            TradeRow {
                solved: 9,
                ..row("sure", 5.0, 50, 12.0)
            },
            TradeRow {
                solved: 8,
                ..row("beaten", 6.0, 60, 12.0)
            },
        ];
        assert_eq!(front(rows), ["sharp", "sure"]);
    }

    #[test]
    fn failures_are_counted_by_kind_the_most_frequent_first() {
        let miss = |miss| Attempt {
            at: "".into(),
            digits: None,
            miss: Some(miss),
        };
        let kinds = [
            Unsolved::LeftDomain,
            Unsolved::AnotherOrbit,
            Unsolved::NoConvergence,
            Unsolved::AnotherOrbit,
        ];
        let row = TradeRow {
            problems: kinds.map(miss).to_vec(),
            ..row("m", 1.0, 1, 1.0)
        };
        assert_eq!(row.failures(), "another orbit 2; no convergence 1; left the domain 1");
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
