//! Numeric witnesses beside verdicts.
//!
//! A witness shares no code with the proof: the premises are met at random points by Gauss-Newton steps on their own
//! formulas, derivatives come by implicit differentiation with dual numbers, and the sides of the claim are compared
//! there. No elimination, no polynomial, no closed form.

mod compiler;
mod course;
mod derivative;
mod flight;
mod judgement;
mod maps;
mod motion;
mod newton;
mod period;
mod point;
mod program;
mod question;
mod sorted;
mod space;
mod system;
mod tolerance;

pub use compiler::Unwitnessed;
pub use judgement::{Evidence, witness};
pub use motion::Flown;
