//! The motion from a start on: impacts, chatter, rest and release, without a time step.
//!
//! Uses `number/` and `model/`.

mod chatter;
mod course;
mod event;
mod expansion;
mod flight;
mod growth;
mod meeting;
mod scaled;
mod simulation;
mod swing;
mod trajectory;

pub use event::{Event, Kind};
pub use growth::Growth;
pub use simulation::{LISTED, Simulation, Start};
pub use trajectory::{Snapshot, Trajectory};
