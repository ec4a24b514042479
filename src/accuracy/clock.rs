//! Wall time of something short.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// Batches timed; their median is not moved by a few that were interrupted.
const BATCHES: usize = 9;

/// The median time of one `work()`, in seconds, measured for about `budget` seconds in all.
///
/// The work is repeated within a batch until a batch takes its share of the budget, so that the resolution of the
/// clock does not matter. A budget of 0 times single runs.
pub(super) fn median_seconds<R>(budget: f64, mut work: impl FnMut() -> R) -> f64 {
    let share = budget / BATCHES as f64;
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
    let mut times: Vec<f64> = (0..BATCHES)
        .map(|_| run(repeats).as_secs_f64() / f64::from(repeats))
        .collect();
    times.sort_by(f64::total_cmp);
    times[BATCHES / 2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hundred_times_the_work_takes_longer() {
        let sum = |terms: u64| {
            move || (0..black_box(terms)).fold(0_u64, |sum, term| black_box(sum ^ term))
        };
        assert!(median_seconds(0.01, sum(20_000)) > median_seconds(0.01, sum(200)));
    }

    #[test]
    fn no_budget_and_nonsense_budgets_still_answer() {
        for budget in [0.0, -1.0, f64::NAN] {
            assert!(median_seconds(budget, || 1) >= 0.0);
        }
    }
}
