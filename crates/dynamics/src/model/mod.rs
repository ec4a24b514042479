//! The motion of the ball in the shaken capsule, from one impact to the next.
//!
//! Everything is generic over [`Analytic`](numbers::Analytic), so that one text gives f64, many digits and,
//! over dual numbers, derivatives. Uses `number/` and nothing else of ours.

mod ahead;
#[cfg(any(test, feature = "calls"))]
pub mod calls;
mod crossing;
mod device;
mod exact;
mod flight;
mod forcing;
mod jacobian;
mod map;
mod membrane;
mod motion;
mod pair;
mod root;

pub use ahead::{Ahead, Forced, Turnings};
pub use crossing::{Crossing, Watch};
pub use device::{Device, DeviceError, Scales, gravity_component};
pub use exact::{Exact, Parameters};
pub use flight::{Flight, FlightError, Impact, LONGEST_FLIGHT, State};
pub use forcing::{Forcing, ForcingError};
pub use jacobian::{JacobianError, Order, Passage};
pub use map::{Leg, Map, MapError, next_impact};
pub use membrane::{Membrane, MembraneError};
pub use motion::{Motion, MotionError, Side};
pub use pair::Pair;
pub use root::{Bracket, Sample, root};
