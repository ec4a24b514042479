//! How many points are computed together: so many that nobody waits long for the first of them.

use std::time::{Duration, Instant};

/// A block that takes less is followed by one of twice as many.
const QUICK: Duration = Duration::from_millis(150);

/// A block that takes longer is followed by one of half as many: so much of a run is lost that is stopped.
const SLOW: Duration = Duration::from_millis(500);

/// The size of the next block. What is computed does not depend on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    size: u64,
    least: u64,
}

impl Pace {
    /// Of at least so many for each thread.
    pub fn new(together: u64) -> Self {
        let least = together * rayon::current_num_threads() as u64;
        Self { size: least, least }
    }

    /// Works on a block of at most so many, at least one.
    pub fn block<R>(&mut self, most: u64, work: impl FnOnce(u64) -> R) -> R {
        let size = self.size.min(most).max(1);
        let start = Instant::now();
        let made = work(size);
        let took = start.elapsed();
        if took < QUICK {
            self.size = size.saturating_mul(2).max(self.size);
        } else if took > SLOW {
            self.size = (size / 2).max(self.least);
        }
        made
    }
}
