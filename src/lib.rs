#![doc = include_str!("../README.md")]
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

/// The examples of the guide are run as those of the README are.
#[cfg(doctest)]
#[doc = include_str!("../doc/library.md")]
struct Guide;

pub use claims as claim;
pub use dynamics::{impact, model, orbit};
pub use numbers as number;
pub use prover as prove;
pub use prover::{algebra, checksum};
pub use scenes::{input, reference, scene};
pub use stop;
pub use texmath as tex;
pub use texmath::markup;
pub use {accuracy, evidence, kernel};

pub mod cli;
pub mod repair;
pub mod report;
