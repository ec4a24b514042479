//! Wall time of something short.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// Batches timed; their median is not moved by a few that were interrupted.
const BATCHES: usize = 9;

/// Batches of work that is longer than the whole budget.
const FEW_BATCHES: usize = 3;

/// How long something takes, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Of one run.
    pub median: f64,
    /// Half of the distance between the first and the third quartile, over the median.
    pub spread: f64,
}

/// The time of one `work()`, measured for about `budget` seconds in all.
///
/// The work is repeated within a batch until a batch takes its share of the budget, so that the resolution of the
/// clock does not matter. A budget of 0 times single runs.
pub(super) fn timing<R>(budget: f64, mut work: impl FnMut() -> R) -> Timing {
    let start = Instant::now();
    black_box(work());
    let is_long = start.elapsed().as_secs_f64() > budget;
    let batches = if is_long { FEW_BATCHES } else { BATCHES };
    let share = budget / batches as f64;
    let share = Duration::try_from_secs_f64(share).unwrap_or(Duration::ZERO);
    let mut repeats = 1_u32;
    let mut run = |repeats: u32| {
        let start = Instant::now();
        for _ in 0..repeats {
            black_box(work());
        }
        start.elapsed()
    };
    // doubling costs no more than one batch in all, and warms the caches
    while run(repeats) < share / 2 && repeats < 1 << 30 {
        repeats *= 2;
    }
    let mut times: Vec<f64> = (0..batches)
        .map(|_| run(repeats).as_secs_f64() / f64::from(repeats))
        .collect();
    times.sort_by(f64::total_cmp);
    let median = times[batches / 2];
    let apart = times[batches - 1 - batches / 4] - times[batches / 4];
    let spread = if median > 0.0 { 0.5 * apart / median } else { 0.0 };
    Timing { median, spread }
}

/// Pairs of sine and cosine in a chain: many to one reading of the clock.
const CHAINED: u32 = 1000;

/// L, the latency of one sine and cosine of f64: each waits for the one before it.
pub fn latency() -> Timing {
    let chain = || {
        (0..CHAINED).fold(black_box(1.0_f64), |x, _| {
            let (sin, cos) = x.sin_cos();
            sin + cos + 0.5
        })
    };
    let chain = timing(0.05, chain);
    Timing {
        median: chain.median / f64::from(CHAINED),
        ..chain
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hundred_times_the_work_takes_longer() {
        let sum = |terms: u64| move || (0..black_box(terms)).fold(0_u64, |sum, term| black_box(sum ^ term));
        assert!(timing(0.01, sum(20_000)).median > timing(0.01, sum(200)).median);
    }

    #[test]
    fn no_budget_and_nonsense_budgets_still_answer() {
        for budget in [0.0, -1.0, f64::NAN] {
            let timing = timing(budget, || 1);
            assert!(timing.median >= 0.0 && timing.spread >= 0.0);
        }
    }

    #[test]
    fn a_sine_waits_for_the_one_before_it_some_nanoseconds() {
        let latency = latency().median;
        assert!(latency > 1e-9 && latency < 1e-6, "{latency}");
    }
}
