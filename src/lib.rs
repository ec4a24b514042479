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

pub mod input;
pub use dynamics::{impact, model, orbit};
pub use numbers as number;
pub use stop;
pub use texmath as tex;
pub use texmath::markup;

pub mod checksum;

// Formulas and their proofs, and what holds formulas and numbers against each other.
pub mod algebra;
pub mod claim;
pub mod evidence;
pub mod kernel;
pub mod prove;
pub mod reference;
pub mod repair;

// Scenes, tables, commands.
pub mod accuracy;
pub mod cli;
pub mod report;
pub mod scene;
