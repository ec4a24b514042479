//! The motion from a start on: impacts, chatter, rest and release, without a time step.
//!
//! Uses `number/` and `model/`.

mod any_course;
pub mod batch;
mod chatter;
mod contact;
mod course;
mod enclosure;
mod event;
mod expansion;
mod flight;
mod growth;
mod history;
mod meeting;
mod scaled;
mod simulation;
mod start;
mod swing;
mod trajectory;
mod turns;
mod waves;
mod widening;

pub use batch::{Batch, Grown, Instructions, in_lanes};
pub use chatter::LISTED;
pub use enclosure::Enclosure;
pub use event::{Event, Kind};
pub use growth::Growth;
pub use history::{Extent, History, Known, Row, Rows, history, history_in_decimals, rows, rows_in_decimals};
pub use simulation::Simulation;
pub use start::{Origin, Start};
pub use trajectory::{Snapshot, Trajectory};
pub use widening::Widening;
