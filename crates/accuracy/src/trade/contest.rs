//! Several means to the same end, on the same problems, in every number that makes sense.

use super::super::weights::Weights;
use super::clock::{Timing, timing};
use super::{Attempt, TradeError, TradeOptions, TradeRow, Unsolved, digits_of, quantile};
use numbers::{Analytic, Any, AtRung, Counted, Counts, Machine, Rung, Wide, of_type};

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
    /// How far an answer is from the exact one.
    pub error: fn(&[Exact], &[Exact]) -> f64,
    /// What an answer is that is not the right one.
    pub miss: fn(&P, &[Exact]) -> Unsolved,
    /// The problem in words, `key=value;...`.
    pub place: fn(&P) -> String,
    /// Digits that an answer has that counts as right.
    pub right: f64,
}

/// An answer by two means that share no formula, `None` where there is none.
pub(super) type Twice<P> = fn(&P) -> Option<[Vec<Exact>; 2]>;

/// A way to the answers.
pub(super) trait Means<P> {
    /// As the table has it.
    fn name(&self) -> &'static str;
    /// Its step, tolerance or count, `key=value`; empty where it has none, or the one that it is used with.
    fn setting(&self) -> String {
        String::new()
    }
    /// Whether its answers are proved to be within a bound.
    fn is_proved(&self) -> bool {
        false
    }
    /// The numbers it makes sense in.
    fn rungs(&self) -> &'static [Rung];
    /// The answer over `T`, from the problem on.
    ///
    /// # Errors
    /// Why it finds none.
    fn answer<T: Machine>(&self, point: &P) -> Result<Vec<T>, Unsolved>;
    /// Does the operations of an answer, to be counted, or an equal part of them; says how many such parts there are.
    fn operate<T: Machine>(&self, point: &P) -> u64 {
        // a problem without an answer costs what was done until that was known
        let _ = self.answer::<T>(point);
        1
    }
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

/// Digits that an answer of a formula or a solver has that counts as right.
pub(super) const RIGHT: f64 = 6.0;

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

/// The part of the time of a row that is spent on one of a ladder.
const LADDER: f64 = 0.3;

/// A row for each means in each number that `options` want, judged by what `exact` has.
///
/// # Errors
/// `Points` without problems, `Reference` where the two exact answers to one of them agree to fewer digits than it
/// takes to judge the widest number.
pub(super) fn rows<P, M: Means<P>>(
    task: &Task<P>,
    exact: Twice<P>,
    means: &[M],
    options: &TradeOptions,
) -> Result<Vec<TradeRow>, TradeError> {
    let widest = wanted(means, options).into_iter().map(|(_, rung)| rung).max();
    let Some(widest) = widest else {
        return Ok(Vec::new());
    };
    let exact = confirmed(task, exact, widest)?;
    Ok(judged(task, &exact, means, options))
}

/// The means with the numbers in which they are wanted.
fn wanted<'m, P, M: Means<P>>(means: &'m [M], options: &TradeOptions) -> Vec<(&'m M, Rung)> {
    let pairs = means
        .iter()
        .flat_map(|means| means.rungs().iter().map(move |rung| (means, *rung)));
    pairs
        .filter(|(means, rung)| options.wants(means.name(), *rung))
        .collect()
}

/// The same rows, judged by these answers, one for each problem.
pub(super) fn judged<P, M: Means<P>>(
    task: &Task<P>,
    exact: &[Vec<Exact>],
    means: &[M],
    options: &TradeOptions,
) -> Vec<TradeRow> {
    let row = |(means, rung): (&M, Rung)| {
        let contest = Contest {
            task,
            means,
            exact,
            // those of a ladder are many, and like each other
            budget: options.seconds_per_row * if means.setting().is_empty() { 1.0 } else { LADDER },
            rung,
        };
        rung.at(contest)
    };
    wanted(means, options).into_iter().map(row).collect()
}

/// The exact answers, each confirmed.
fn confirmed<P>(task: &Task<P>, exact: Twice<P>, widest: Rung) -> Result<Vec<Vec<Exact>>, TradeError> {
    let name = || task.name.clone();
    if task.points.is_empty() {
        return Err(TradeError::Points { task: name() });
    }
    let wanted = f64::from(widest.digits()) + BEYOND;
    let confirmed = task.points.iter().enumerate().map(|(point, at)| {
        let both = exact(at);
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

/// The first timing with a small spread, or that with the least. What takes longer than the budget is timed once.
fn quiet(budget: f64, measure: impl Fn() -> Timing) -> Timing {
    let mut best = measure();
    for _ in 1..TIMED {
        if best.spread <= QUIET || best.median > budget {
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
        let right = self.task.right.min(0.5 * digits_of(0.0, epsilon));
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
        let counts = of_type(self.rung, || {
            let counted = points.iter().map(|point| {
                let (parts, counts) = Counts::of(|| self.means.operate::<Counted<Any>>(point));
                counts.times(parts)
            });
            counted.fold(Counts::default(), |all, one| all.and(&one))
        });
        let Timing { median, spread } = quiet(self.budget, || {
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
            setting: self.means.setting(),
            cost: mean(Weights::measured().cost(self.rung, &counts).unwrap_or(0)),
            proved: self.means.is_proved(),
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
