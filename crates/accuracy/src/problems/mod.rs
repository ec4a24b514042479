//! Problems with answers of 30 digits, against which anyone's solver can be held.
//!
//! The motion is that of Z'' = cos(pi t + phase) + g between the bottom at Z = +d/2 and the top at Z = -d/2, where Z' turns
//! into -r_B Z' and -r_T Z'; time and velocities without units. Velocities are those just before an impact.

mod certified;
mod jacobians;
mod list;
mod orbits;
mod problem;
mod runs;
mod solve;
mod values;
mod voltages;

pub use certified::{Answer, Certified, ProblemError, all, certified};
pub use list::list;
pub use problem::{Kind, Level, Means, Problem};
pub use solve::solve;
pub use values::Number;
pub(super) use values::digits;

use dynamics::model::{FlightError, JacobianError, MembraneError, MotionError};
use dynamics::orbit::ShootingError;

/// Why a problem has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Why {
    /// An input that is needed is missing or no plain decimal.
    #[error("`{0}` is missing or no plain decimal")]
    Missing(&'static str),
    /// No periodic motion with this word and these periods.
    #[error("there is no such periodic motion")]
    NoOrbit,
    /// Something is open of the periodic motion.
    #[error("the periodic motion is not proved to enough digits")]
    Unproved,
    /// The motion has no such impact, or comes to no rest.
    #[error("the motion has no such impact, or does not come to rest and off again")]
    NoRest,
    /// Too few digits are left of a run.
    #[error("{0} digits are left at the end")]
    Lost(u32),
    /// A quantity that is 0 has no relative error.
    #[error("{0} is 0, and has no relative error")]
    Zero(String),
    /// The two means answer different quantities.
    #[error("the two means answer different quantities")]
    Unlike,
    /// The two means do not agree.
    #[error("the two means agree to {digits:.1} digits of {quantity}")]
    Apart {
        /// The quantity.
        quantity: String,
        /// How far they agree.
        digits: f64,
    },
    /// A parameter cannot be.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// A membrane cannot be.
    #[error(transparent)]
    Membrane(#[from] MembraneError),
    /// A flight cannot be followed.
    #[error(transparent)]
    Flight(#[from] FlightError),
    /// The return map has no fixed point there.
    #[error(transparent)]
    Return(#[from] ShootingError),
    /// A derivative has no value.
    #[error(transparent)]
    Jacobian(#[from] JacobianError),
}
