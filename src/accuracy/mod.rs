//! Speed against accuracy, measured: what each means costs and how many digits it leaves.

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
