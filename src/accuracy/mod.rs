//! Speed against accuracy, measured: what each means costs and how many digits it leaves.

mod choice;
mod costs;
pub mod problems;
pub mod score;
pub mod stress;
mod trade;

pub use choice::{COSTS, ChoiceError, Cost, Purpose, cheapest, costs};
pub use costs::{WEIGHTS, measured_costs};
pub use trade::{Attempt, Task, Timing, TradeError, TradeOptions, TradeRow, Unsolved, latency, machine, trade};
