//! The motion of a ball in a shaken, inclined capsule: impacts, periodic motions, their stability and bifurcations.
//!
//! [`model`] has the parameters, [`impact`] flights and impacts, [`orbit`] periodic motions and long runs; all of them over any
//! number of the crate `numbers`.

// Library code never panics by its own word: errors are returned.
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::todo,
        clippy::unimplemented,
        clippy::unreachable
    )
)]

pub mod impact;
pub mod model;
pub mod orbit;
