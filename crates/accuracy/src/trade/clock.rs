//! Wall time of something short.

use std::fmt;
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

/// How long one sine and cosine of f64 take, where each waits for the one before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Latency {
    /// By Rust's `sin_cos`, two calls of the C library.
    pub rust: Timing,
    /// By `sincos` of the C library, one call, where that has it.
    pub platform: Option<Timing>,
}

impl Latency {
    /// Measures both, in turns: what slows the machine slows both.
    pub fn measured() -> Self {
        let chained = |pair: fn(f64) -> (f64, f64)| {
            let chain = timing(0.05, || {
                (0..CHAINED).fold(black_box(1.0_f64), |x, _| {
                    let (sin, cos) = pair(x);
                    sin + cos + 0.5
                })
            });
            Timing {
                median: chain.median / f64::from(CHAINED),
                ..chain
            }
        };
        let rust = || chained(f64::sin_cos);
        let platform = || PLATFORM.map(chained);
        let (first, second) = ((rust(), platform()), (rust(), platform()));
        let less = |a: Timing, b: Timing| if a.median <= b.median { a } else { b };
        Self {
            rust: less(first.0, second.0),
            platform: first.1.zip(second.1).map(|(a, b)| less(a, b)),
        }
    }

    /// That of no run.
    pub const fn none() -> Self {
        let rust = Timing {
            median: f64::NAN,
            spread: 0.0,
        };
        Self { rust, platform: None }
    }

    /// The pair that takes the lesser.
    pub fn pair(&self) -> fn(f64) -> (f64, f64) {
        self.lesser().and(PLATFORM).unwrap_or(f64::sin_cos)
    }

    /// L, the lesser: what nobody who needs a sine and a cosine can be below.
    pub fn least(&self) -> Timing {
        self.lesser().unwrap_or(self.rust)
    }

    /// That of the platform, where it is the lesser.
    fn lesser(&self) -> Option<Timing> {
        self.platform.filter(|platform| platform.median < self.rust.median)
    }
}

impl fmt::Display for Latency {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let nanoseconds = |timing: Timing| timing.median * 1e9;
        let (least, rust) = (nanoseconds(self.least()), nanoseconds(self.rust));
        write!(f, "L = {least:.1} ns, the lesser of Rust's sin_cos {rust:.1} ns and ")?;
        match self.platform {
            Some(platform) => write!(f, "the C library's sincos {:.1} ns", nanoseconds(platform)),
            None => f.write_str("the C library's sincos, which is not here"),
        }
    }
}

#[cfg(all(target_os = "linux", target_env = "gnu"))]
const PLATFORM: Option<fn(f64) -> (f64, f64)> = Some(sincos);
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
const PLATFORM: Option<fn(f64) -> (f64, f64)> = None;

/// `sincos` of the GNU C library, which Rust does not offer.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
fn sincos(x: f64) -> (f64, f64) {
    mod c {
        unsafe extern "C" {
            pub fn sincos(x: f64, sin: *mut f64, cos: *mut f64);
        }
    }
    let (mut sin, mut cos) = (0.0, 0.0);
    // SAFETY: both pointers are to values of this function that outlive the call, which writes one f64 to each
    unsafe { c::sincos(x, &raw mut sin, &raw mut cos) };
    (sin, cos)
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
        let latency = Latency::measured();
        let least = latency.least().median;
        assert!(least > 1e-9 && least < 1e-6, "{latency}");
        assert!(least <= latency.rust.median && latency.platform.is_none_or(|platform| least <= platform.median));
    }

    #[test]
    fn both_pairs_of_sine_and_cosine_are_the_same() {
        for x in [0.0_f64, 1.0, -2.5, 1e3, 1e9] {
            let (sin, cos) = x.sin_cos();
            let pair = PLATFORM.map_or((sin, cos), |pair| pair(x));
            assert!(
                (pair.0 - sin).abs() <= f64::EPSILON && (pair.1 - cos).abs() <= f64::EPSILON,
                "{x}"
            );
        }
    }
}
