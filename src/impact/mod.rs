//! The motion from a start on: impacts, chatter, rest and release, without a time step.
//!
//! Uses `number/` and `model/`.

mod chatter;
mod course;
mod event;
mod expansion;
mod flight;
mod growth;
mod history;
mod meeting;
mod scaled;
mod simulation;
mod swing;
mod trajectory;
mod widening;

pub use event::{Event, Kind};
pub use growth::Growth;
pub use history::{Extent, History, Origin, Row, history, history_in_decimals};
pub use simulation::{LISTED, Simulation, Start};
pub use trajectory::{Snapshot, Trajectory};
pub use widening::Widening;
