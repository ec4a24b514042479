//! The budget of a computation.

use stop;

/// The steps after which a computation asks whether to go on.
const BETWEEN_STOPS: u64 = 1 << 14;

/// The budget ran out: nothing is known of the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the budget of steps is exhausted")]
pub struct Exhausted;

/// A result, or [`Exhausted`].
pub type Result<T> = std::result::Result<T, Exhausted>;

/// How many operations on coefficients a computation may still use; one on large integers counts once per word.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Steps {
    left: u64,
}

impl Steps {
    /// A budget.
    pub fn new(left: u64) -> Self {
        Self { left }
    }

    /// What is left of the budget.
    pub fn left(&self) -> u64 {
        self.left
    }

    /// Uses some of the budget.
    pub fn take(&mut self, steps: u64) -> Result<()> {
        match self.left.checked_sub(steps) {
            Some(left) if left / BETWEEN_STOPS == self.left / BETWEEN_STOPS || stop::goes_on() => {
                self.left = left;
                Ok(())
            }
            _ => {
                self.left = 0;
                Err(Exhausted)
            }
        }
    }

    /// Runs an attempt that may use at most `most` steps of this budget; `None` where these did not suffice.
    pub fn attempt<T>(&mut self, most: u64, attempt: impl FnOnce(&mut Self) -> Result<T>) -> Option<T> {
        let allowed = most.min(self.left);
        let mut part = Self { left: allowed };
        let result = attempt(&mut part).ok();
        self.left -= allowed - part.left;
        result
    }
}
