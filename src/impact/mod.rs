//! The motion from a start on: impacts, chatter, rest and release, without a time step.
//!
//! Uses `number/` and `model/`.

mod event;
mod simulation;
mod trajectory;

pub use event::{Event, Kind};
pub use simulation::{Simulation, Start};
pub use trajectory::{Snapshot, Trajectory};
