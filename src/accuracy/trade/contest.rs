//! Several means to the same end, on the same problems, in every number that makes sense.

use super::clock::{Timing, timing};
use super::{Attempt, TradeError, TradeOptions, TradeRow, Unsolved, digits_of, quantile};
use crate::number::{Analytic, Any, AtRung, Counted, Counts, Machine, Rung, Wide, of_type};

/// The number that judges: some forty digits beyond the widest that is judged.
pub type Exact = Wide<100>;

/// The digits that a reference has beyond the number it judges.
const BEYOND: f64 = 15.0;

/// What is to be computed: problems, and their answers.
pub(super) struct Task<'a, P> {
    /// Such as `dp/random/trace`.
    pub name: String,
    /// The problems, the same on every machine.
    pub points: &'a [P],
    /// The answer by two means that share no formula, `None` where there is none.
    pub exact: fn(&P) -> Option<[Vec<Exact>; 2]>,
    /// How far an answer is from the exact one.
    pub error: fn(&[Exact], &[Exact]) -> f64,
    /// What an answer is that is not the right one.
    pub miss: fn(&P, &[Exact]) -> Unsolved,
    /// The problem in words, `key=value;...`.
    pub place: fn(&P) -> String,
}

/// A way to the answers.
pub(super) trait Means<P> {
    /// As the table has it.
    fn name(&self) -> &'static str;
    /// The numbers it makes sense in.
    fn rungs(&self) -> &'static [Rung];
    /// The answer over `T`, from the problem on.
    ///
    /// # Errors
    /// Why it finds none.
    fn answer<T: Machine>(&self, point: &P) -> Result<Vec<T>, Unsolved>;
}

/// Bits of a drawn number: of a range that is a power of 2, f32 holds them with bits to spare.
pub(super) const BITS: u32 = 20;

/// A formula as the paper prints it, and the one that the program uses.
#[derive(Clone, Copy)]
pub(super) enum Form {
    Printed,
    Stable,
}

impl Form {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Printed, Self::Stable];

    /// As tables have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Printed => "printed",
            Self::Stable => "stable",
        }
    }
}

/// The rungs of most means.
pub(super) const EVERY: &[Rung] = &[Rung::Single, Rung::Double, Rung::DoubleDouble, Rung::Wide(50)];

/// The rungs of means that come from a crate for the numbers of the machine, or that gain nothing from more digits.
pub(super) const OF_THE_MACHINE: &[Rung] = &[Rung::Single, Rung::Double];

/// Digits that an answer has that counts as right.
const RIGHT: f64 = 6.0;

/// Digits of an answer that is the right one, but for its errors.
const BESIDE: f64 = 2.0;

/// The largest difference over the largest exact value, 0 for 0/0.
pub(super) fn relative_error(found: &[Exact], exact: &[Exact]) -> f64 {
    // unlike f64::max this lets NaN through
    let largest = |values: Vec<f64>| {
        values
            .into_iter()
            .fold(0.0, |a: f64, b| if b.abs() <= a { a } else { b.abs() })
    };
    let apart = found.iter().zip(exact).map(|(a, b)| (a.clone() - b.clone()).to_f64());
    let apart = largest(apart.collect());
    let size = largest(exact.iter().map(Analytic::to_f64).collect());
    if apart == 0.0 { 0.0 } else { apart / size }
}

/// The largest of the relative errors.
pub(super) fn worst_relative_error(found: &[Exact], exact: &[Exact]) -> f64 {
    let one = |(a, b): (&Exact, &Exact)| relative_error(std::slice::from_ref(a), std::slice::from_ref(b));
    let errors = found.iter().zip(exact).map(one);
    // unlike f64::max this lets NaN through
    errors.fold(0.0, |worst, error| if error <= worst { worst } else { error })
}

/// A row for each means in each number that `options` want.
///
/// # Errors
/// `Points` without problems, `Reference` where the two exact answers to one of them agree to fewer digits than it
/// takes to judge the widest number.
pub(super) fn rows<P, M: Means<P>>(
    task: &Task<P>,
    means: &[M],
    options: &TradeOptions,
) -> Result<Vec<TradeRow>, TradeError> {
    let wanted = |means: &M, rung: Rung| options.wants(means.name(), rung);
    let pairs = means
        .iter()
        .flat_map(|means| means.rungs().iter().map(move |rung| (means, *rung)));
    let pairs: Vec<(&M, Rung)> = pairs.filter(|(means, rung)| wanted(means, *rung)).collect();
    let Some(widest) = pairs.iter().map(|(_, rung)| *rung).max() else {
        return Ok(Vec::new());
    };
    let exact = exact(task, widest)?;
    let row = |(means, rung): (&M, Rung)| {
        let contest = Contest {
            task,
            means,
            exact: &exact,
            budget: options.seconds_per_row,
            rung,
        };
        rung.at(contest)
    };
    Ok(pairs.into_iter().map(row).collect())
}

/// The exact answers, each confirmed.
fn exact<P>(task: &Task<P>, widest: Rung) -> Result<Vec<Vec<Exact>>, TradeError> {
    let name = || task.name.clone();
    if task.points.is_empty() {
        return Err(TradeError::Points { task: name() });
    }
    let wanted = f64::from(widest.digits()) + BEYOND;
    let confirmed = task.points.iter().enumerate().map(|(point, at)| {
        let both = (task.exact)(at);
        let digits = both
            .as_ref()
            .map_or(0.0, |[one, other]| digits_of((task.error)(other, one), 1e-99));
        match both {
            Some([exact, _]) if digits >= wanted => Ok(exact),
            _ => Err(TradeError::Reference {
                task: name(),
                point,
                digits,
                wanted,
            }),
        }
    });
    confirmed.collect()
}

/// A spread above this is that of the machine and not of the work: what else runs there got in between.
const QUIET: f64 = 0.1;

/// Times that something is timed at most for a quiet answer.
const TIMED: usize = 4;

/// The first timing with a small spread, or that with the least.
fn quiet(measure: impl Fn() -> Timing) -> Timing {
    let mut best = measure();
    for _ in 1..TIMED {
        if best.spread <= QUIET {
            break;
        }
        let again = measure();
        if again.spread < best.spread {
            best = again;
        }
    }
    best
}

/// One means in one number.
struct Contest<'a, P, M> {
    task: &'a Task<'a, P>,
    means: &'a M,
    exact: &'a [Vec<Exact>],
    budget: f64,
    rung: Rung,
}

impl<P, M: Means<P>> AtRung for Contest<'_, P, M> {
    type Output = TradeRow;

    fn run<N: Machine>(self) -> TradeRow {
        let points = self.task.points;
        let epsilon = <N as Analytic>::epsilon().to_f64();
        let right = RIGHT.min(0.5 * digits_of(0.0, epsilon));
        let outcome = |(point, exact): (&P, &Vec<Exact>)| {
            let found = self.means.answer::<N>(point);
            let found = found.map(|found| found.iter().map(Machine::to_wide).collect::<Vec<Exact>>());
            let digits = found.as_ref().ok();
            let digits = digits.map(|found| digits_of((self.task.error)(found, exact), epsilon));
            let miss = match (&found, digits) {
                (Err(miss), _) => Some(*miss),
                (Ok(_), Some(digits)) if (BESIDE..right).contains(&digits) => Some(Unsolved::FewDigits),
                (Ok(found), Some(digits)) if digits < right => Some((self.task.miss)(point, found)),
                _ => None,
            };
            let at = (self.task.place)(point).into();
            Attempt { at, digits, miss }
        };
        let problems: Vec<Attempt> = points.iter().zip(self.exact).map(outcome).collect();
        let solved = problems.iter().filter(|outcome| outcome.miss.is_none());
        let digits: Vec<f64> = solved.filter_map(|outcome| outcome.digits).collect();
        let (_, counts) = Counts::of(|| {
            of_type(self.rung, || {
                for point in points {
                    // a problem without an answer costs what was done until that was known
                    let _ = self.means.answer::<Counted<Any>>(point);
                }
            });
        });
        let Timing { median, spread } = quiet(|| {
            timing(self.budget, || {
                for point in points {
                    let _ = std::hint::black_box(self.means.answer::<N>(std::hint::black_box(point)));
                }
            })
        });
        let mean = |total: u64| (total as f64 / points.len() as f64).round() as u64;
        TradeRow {
            task: self.task.name.clone(),
            number: self.rung,
            method: self.means.name(),
            operations: mean(counts.total()),
            seconds: median / points.len() as f64,
            digits: quantile(&digits, 0.5),
            on_front: false,
            worst: quantile(&digits, 0.05),
            solved: digits.len(),
            problems,
            divisions: mean(counts.divisions),
            sincos: mean(counts.sincos),
            spread,
            latencies: f64::NAN,
        }
    }
}
