#![doc = include_str!("../README.md")]
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

mod paper_equations;
pub mod problems;
pub mod score;
pub mod stress;
mod trade;
mod weights;

pub use trade::{
    Advice, AdviceError, Attempt, Basis, Latency, Need, Rank, Task, Timing, TradeError, TradeOptions, TradeRow,
    Unsolved, advise, machine, trade,
};
pub use weights::WEIGHTS;
