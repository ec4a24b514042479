#![cfg_attr(feature = "cli", doc = include_str!("../README.md"))]
#![cfg_attr(
    not(feature = "cli"),
    doc = "Verification of printed formulas for vibro-impact dynamics; the README's examples need the feature `cli`."
)]
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
#[cfg(all(doctest, feature = "cli"))]
#[doc = include_str!("../doc/library.md")]
struct Guide;

#[cfg(feature = "audit")]
pub mod input;
pub use dynamics::{impact, model, orbit};
pub use numbers as number;
pub use stop;
pub use texmath as tex;
pub use texmath::markup;

#[cfg(feature = "audit")]
pub mod checksum;

// Formulas and their proofs, and what holds formulas and numbers against each other.
#[cfg(feature = "audit")]
pub mod algebra;
#[cfg(feature = "kernel")]
pub mod claim;
#[cfg(feature = "audit")]
pub mod evidence;
#[cfg(feature = "kernel")]
pub mod kernel;
#[cfg(feature = "audit")]
pub mod prove;
#[cfg(feature = "audit")]
pub mod reference;
#[cfg(feature = "audit")]
pub mod repair;

// Scenes, tables, commands.
#[cfg(feature = "cli")]
pub mod accuracy;
#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "cli")]
pub mod report;
#[cfg(feature = "cli")]
pub mod scene;
