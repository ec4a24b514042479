//! Speed against accuracy, measured: what each means costs and how many digits it leaves.

mod clock;
mod dp;
mod points;
pub mod stress;
mod trade;

pub use dp::trade_dp;
pub use trade::{TradeError, TradeOptions, TradeRow};
