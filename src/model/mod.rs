//! The motion of the ball in the shaken capsule, from one impact to the next.
//!
//! Everything is generic over [`Analytic`](crate::number::Analytic), so that one text gives f64, many digits and,
//! over dual numbers, derivatives. Uses `number/` and nothing else of ours.

mod device;
mod flight;
mod forcing;
mod jacobian;
mod map;
mod motion;
mod root;

pub use device::{Device, DeviceError, Scales};
pub use flight::{Crossing, Flight, FlightError, LONGEST_FLIGHT, State, Watch};
pub use forcing::{Ahead, Forced, Forcing, ForcingError, Turnings};
pub use jacobian::{JacobianError, Order, Pair, Passage};
pub use map::{Impact, Leg, Map, MapError, next_impact};
pub use motion::{Motion, MotionError, Side};
