//! Stopping a long computation between its steps, and asking how far it is.
//!
//! ```
//! use stop::Token;
//!
//! let token = Token::new();
//! let other = token.clone(); // for another thread, which may ask `other.steps()` and say `other.stop()`
//! other.stop();
//! let found = token.during(|| stop::goes_on());
//! assert!(!found && token.steps() == 1);
//! ```

// Library code never panics by its own word: errors are returned.
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::todo,
        clippy::unimplemented,
        clippy::unreachable
    )
)]

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

thread_local! {
    static CURRENT: RefCell<Option<Token>> = const { RefCell::new(None) };
}

/// What a long computation looks at between its steps: a block of impacts, a box of a search, some thousands of
/// operations of a proof. Clones are the same token.
///
/// A computation that is stopped returns at once with what it has, which claims nothing that was not found: a search is
/// not complete, a claim undecided, rows end.
#[derive(Clone, Debug, Default)]
pub struct Token(Arc<State>);

#[derive(Debug, Default)]
struct State {
    is_stopped: AtomicBool,
    steps: AtomicU64,
}

impl Token {
    /// A token that nobody has stopped.
    pub fn new() -> Self {
        Self::default()
    }

    /// Stops what is computed under this token, on whichever thread.
    pub fn stop(&self) {
        self.0.is_stopped.store(true, Ordering::Relaxed);
    }

    /// Whether it was stopped.
    pub fn is_stopped(&self) -> bool {
        self.0.is_stopped.load(Ordering::Relaxed)
    }

    /// The steps taken so far.
    pub fn steps(&self) -> u64 {
        self.0.steps.load(Ordering::Relaxed)
    }

    /// Computes under this token, and whatever is computed in parallel from there.
    pub fn during<R>(&self, work: impl FnOnce() -> R) -> R {
        /// Puts back what was there, after a panic as well.
        struct Before(Option<Token>);
        impl Drop for Before {
            fn drop(&mut self) {
                CURRENT.set(self.0.take());
            }
        }
        let _before = Before(CURRENT.replace(Some(self.clone())));
        work()
    }

    /// The token of this thread; where there is none, a new one.
    pub fn current() -> Self {
        CURRENT.with_borrow(|token| token.clone().unwrap_or_default())
    }
}

/// Takes a step: whether the computation is to go on.
pub fn goes_on() -> bool {
    CURRENT.with_borrow(|token| {
        token.as_ref().is_none_or(|Token(state)| {
            state.steps.fetch_add(1, Ordering::Relaxed);
            !state.is_stopped.load(Ordering::Relaxed)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_stops_what_is_computed_under_it_and_nothing_else() {
        assert!(goes_on());
        let (token, other) = (Token::new(), Token::new());
        token.stop();
        token.during(|| {
            assert!(!goes_on());
            other.during(|| assert!(goes_on()));
            assert!(!goes_on());
            let carried = Token::current();
            std::thread::spawn(move || {
                assert!(goes_on());
                carried.during(|| assert!(!goes_on()));
            })
            .join()
            .unwrap();
        });
        assert!(goes_on());
        assert_eq!((token.steps(), other.steps(), token.is_stopped()), (3, 1, true));
    }
}
