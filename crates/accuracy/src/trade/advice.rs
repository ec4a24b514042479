//! Which means to take, for how many digits, at how many of the problems.

use super::{SAME_TIME, TradeRow};
use std::str::FromStr;

/// What is asked of a means.
#[derive(Clone, Debug, PartialEq)]
pub struct Need {
    /// The digits that are to hold.
    pub digits: f64,
    /// At this share of the problems.
    pub solved: f64,
    /// Whether a proof has to come with the answer.
    pub proved: bool,
    /// Whether it is asked of statistics, by their relative error.
    pub of_statistics: bool,
    /// Only tasks with this in their names.
    pub task: Option<String>,
}

/// A need that is none.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AdviceError {
    /// Not `key=value`.
    #[error("`{0}` is not key=value; such as digits=8,solved=0.99,task=orbit")]
    Pair(String),
    /// No such key.
    #[error("there is no `{0}`: digits or error, solved, proved, task")]
    Key(String),
    /// A key that is given twice.
    #[error("`{0}` is given twice")]
    Twice(String),
    /// A value out of its range.
    #[error("{key}={value}: {range}")]
    Value {
        /// The key.
        key: &'static str,
        /// Its value.
        value: String,
        /// What it may be.
        range: &'static str,
    },
    /// Digits and an error, or neither.
    #[error("either digits=N, of formulas and solvers, or error=E, of statistics")]
    Goal,
    /// No task with this in its name.
    #[error("no task has `{task}` in its name; there are {tasks}")]
    Task {
        /// What was asked for.
        task: String,
        /// Those there are.
        tasks: String,
    },
}

/// More digits than these no number of the comparison holds.
const MOST_DIGITS: f64 = 1000.0;

impl FromStr for Need {
    type Err = AdviceError;

    /// `digits=8,solved=0.99,task=orbit` or `error=0.01,task=voltage`; `proved=true` where a proof is wanted. Without
    /// `solved` it is asked at every problem.
    fn from_str(text: &str) -> Result<Self, AdviceError> {
        let (mut digits, mut error, mut solved, mut proved, mut task) = (None, None, 1.0, false, None);
        let mut keys: Vec<&str> = Vec::new();
        for pair in text.split(',') {
            let (key, value) = pair.split_once('=').ok_or_else(|| AdviceError::Pair(pair.to_owned()))?;
            let (key, value) = (key.trim(), value.trim());
            if keys.contains(&key) {
                return Err(AdviceError::Twice(key.to_owned()));
            }
            keys.push(key);
            let number = |key, range, may_be: fn(f64) -> bool| {
                let number = value.parse().ok().filter(|number| may_be(*number));
                number.ok_or_else(|| AdviceError::Value {
                    key,
                    value: value.to_owned(),
                    range,
                })
            };
            match key {
                "digits" => {
                    let may_be = |digits| digits > 0.0 && digits <= MOST_DIGITS;
                    digits = Some(number("digits", "must be a number above 0 and at most 1000", may_be)?);
                }
                "error" => {
                    let may_be = |error| error > 0.0 && error < 1.0;
                    error = Some(number("error", "must be a number above 0 and below 1", may_be)?);
                }
                "solved" => {
                    let may_be = |solved| solved > 0.0 && solved <= 1.0;
                    solved = number("solved", "must be a number above 0 and at most 1", may_be)?;
                }
                "proved" => {
                    proved = value.parse().map_err(|_| AdviceError::Value {
                        key: "proved",
                        value: value.to_owned(),
                        range: "must be true or false",
                    })?;
                }
                "task" => task = Some(value.to_owned()),
                other => return Err(AdviceError::Key(other.to_owned())),
            }
        }
        let (digits, of_statistics) = match (digits, error) {
            (Some(digits), None) => (digits, false),
            (None, Some(error)) => (-f64::log10(error), true),
            _ => return Err(AdviceError::Goal),
        };
        Ok(Self {
            digits,
            solved,
            proved,
            of_statistics,
            task,
        })
    }
}

impl Need {
    fn is_met(&self, row: &TradeRow) -> bool {
        row.kept(self.solved) >= self.digits && (row.proved || !self.proved)
    }

    /// At how many of its problems a means keeps the digits.
    pub fn kept_at(&self, row: &TradeRow) -> usize {
        let digits = row.problems.iter().filter_map(|problem| problem.digits);
        digits.filter(|digits| *digits >= self.digits).count()
    }
}

/// What costs are compared by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// The time on this machine.
    Seconds,
    /// Counted operations, in instructions: the same on every machine.
    Operations,
}

impl Basis {
    /// As tables have it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Seconds => "seconds",
            Self::Operations => "operations",
        }
    }

    /// Whether the first costs less. Times that the clock cannot tell apart are compared by operations.
    fn is_less(self, a: &TradeRow, b: &TradeRow) -> bool {
        let is_apart = a.seconds.max(b.seconds) > (1.0 + SAME_TIME) * a.seconds.min(b.seconds);
        match self {
            Self::Seconds if is_apart => a.seconds < b.seconds,
            _ => a.cost < b.cost,
        }
    }
}

/// What a row is to a need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rank {
    /// It meets it, for the least.
    Cheapest,
    /// Of another means or number, the cheapest that meets it.
    RunnerUp,
    /// Nothing meets it, and this comes closest.
    Closest,
}

impl Rank {
    /// As tables have it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cheapest => "cheapest",
            Self::RunnerUp => "runner-up",
            Self::Closest => "closest",
        }
    }
}

/// A means that is advised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advice<'a> {
    /// What it is to the need.
    pub rank: Rank,
    /// By which cost.
    pub basis: Basis,
    /// What was measured of it.
    pub row: &'a TradeRow,
}

/// For each task among `rows` the cheapest means that meets the need and the runner-up, by time and by operations; where
/// none meets it, the one that comes closest.
pub fn advise<'a>(rows: &'a [TradeRow], need: &Need) -> Vec<Advice<'a>> {
    let mut tasks: Vec<&str> = Vec::new();
    for row in rows {
        if !tasks.contains(&row.task.as_str()) {
            tasks.push(&row.task);
        }
    }
    let mut advice = Vec::new();
    for task in tasks {
        let of_task: Vec<&TradeRow> = rows.iter().filter(|row| row.task == task).collect();
        let met: Vec<&TradeRow> = of_task.iter().copied().filter(|row| need.is_met(row)).collect();
        for basis in [Basis::Seconds, Basis::Operations] {
            let least = |among: &[&'a TradeRow]| {
                let less = |a: &'a TradeRow, b: &'a TradeRow| if basis.is_less(b, a) { b } else { a };
                among.iter().copied().reduce(less)
            };
            let cheapest = least(&met);
            let is_other = |row: &&TradeRow| {
                cheapest.is_some_and(|cheapest| row.method != cheapest.method || row.number != cheapest.number)
            };
            let others: Vec<&TradeRow> = met.iter().copied().filter(is_other).collect();
            let ranked = [(Rank::Cheapest, cheapest), (Rank::RunnerUp, least(&others))];
            let ranked = ranked
                .into_iter()
                .filter_map(|(rank, row)| Some(Advice { rank, basis, row: row? }));
            advice.extend(ranked);
        }
        if met.is_empty() {
            // where nothing proves, what comes closest does not either
            let proves = need.proved && of_task.iter().any(|row| row.proved);
            let may_be = of_task.into_iter().filter(|row| row.proved || !proves);
            let closest = may_be.max_by(|a, b| {
                let kept = a.kept(need.solved).total_cmp(&b.kept(need.solved));
                (need.kept_at(a).cmp(&need.kept_at(b)))
                    .then(kept)
                    .then(b.cost.cmp(&a.cost))
            });
            let (rank, basis) = (Rank::Closest, Basis::Operations);
            advice.extend(closest.map(|row| Advice { rank, basis, row }));
        }
    }
    advice
}

#[cfg(test)]
mod tests {
    use super::super::{Attempt, TradeRow};
    use super::*;
    use numbers::Rung;

    /// A means with these digits at its problems.
    fn row(method: &'static str, seconds: f64, cost: u64, digits: &[f64]) -> TradeRow {
        let attempt = |digits: &f64| Attempt {
            at: "".into(),
            digits: Some(*digits),
            miss: None,
        };
        TradeRow {
            task: "t".into(),
            number: Rung::Double,
            method,
            operations: cost,
            seconds,
            digits: 0.0,
            on_front: false,
            worst: 0.0,
            solved: digits.len(),
            problems: digits.iter().map(attempt).collect(),
            divisions: 0,
            sincos: 0,
            spread: 0.0,
            latencies: 0.0,
            setting: String::new(),
            cost,
            proved: method == "certified",
        }
    }

    fn named(rows: &[TradeRow], need: &str) -> Vec<(Rank, Basis, &'static str)> {
        let need = need.parse().expect("a need");
        let advice = advise(rows, &need).into_iter();
        advice
            .map(|advice| (advice.rank, advice.basis, advice.row.method))
            .collect()
    }

    #[test]
    fn the_cheapest_that_keeps_the_digits_at_the_share_is_advised_by_each_cost() {
        let rows = [
            row("quick", 1.0, 50, &[12.0, 12.0, 12.0, 3.0]),
            row("few", 2.0, 10, &[9.0, 9.0, 9.0, 9.0]),
            row("certified", 9.0, 90, &[14.0, 14.0, 14.0, 14.0]),
        ];
        let (seconds, operations) = (Basis::Seconds, Basis::Operations);
        assert_eq!(
            named(&rows, "digits=8,solved=0.75"),
            [
                (Rank::Cheapest, seconds, "quick"),
                (Rank::RunnerUp, seconds, "few"),
                (Rank::Cheapest, operations, "few"),
                (Rank::RunnerUp, operations, "quick"),
            ]
        );
        assert_eq!(named(&rows, "digits=8")[0], (Rank::Cheapest, seconds, "few"));
        assert_eq!(
            named(&rows, "digits=8,proved=true")[0],
            (Rank::Cheapest, seconds, "certified")
        );
        assert_eq!(named(&rows, "digits=20"), [(Rank::Closest, operations, "certified")]);
        // of two of which neither does it at all problems, the one that does it at more of them
        assert_eq!(named(&rows[..2], "digits=10"), [(Rank::Closest, operations, "quick")]);
        // where nothing proves there is a closest too
        assert_eq!(
            named(&rows[..2], "digits=8,proved=true"),
            [(Rank::Closest, operations, "few")]
        );
    }

    #[test]
    fn times_that_the_clock_cannot_tell_apart_go_by_operations() {
        let rows = [row("a", 1.00, 50, &[9.0]), row("b", 1.05, 40, &[9.0])];
        assert_eq!(named(&rows, "digits=8")[0].2, "b");
    }

    #[test]
    fn an_error_is_so_many_digits_and_nonsense_is_told() {
        let need: Need = "error=0.01,task=voltage".parse().expect("a need");
        assert!((need.digits - 2.0).abs() < 1e-12 && need.of_statistics && need.solved == 1.0);
        for text in [
            "",
            "digits",
            "digits=0",
            "digits=NaN",
            "digits=1e9",
            "solved=0.5",
            "digits=5,error=0.1",
            "digits=5,task=orbit,task=dp",
        ] {
            assert!(text.parse::<Need>().is_err(), "{text}");
        }
        for text in [
            "digits=5,solved=0",
            "digits=5,solved=1.1",
            "digits=5,proved=perhaps",
            "digits=5,speed=3",
            "error=1",
        ] {
            assert!(text.parse::<Need>().is_err(), "{text}");
        }
    }
}
