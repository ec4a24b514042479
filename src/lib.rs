#![cfg_attr(feature = "cli", doc = include_str!("../README.md"))]
#![cfg_attr(
    not(feature = "cli"),
    doc = "Verification of printed formulas for vibro-impact dynamics; the README's examples need the feature `cli`."
)]

// The dynamics, always there.
pub mod impact;
pub mod model;
pub mod number;
pub mod orbit;

// Formulas and their proofs, and what holds formulas and numbers against each other.
#[cfg(feature = "audit")]
pub mod algebra;
#[cfg(feature = "audit")]
pub mod claim;
#[cfg(feature = "audit")]
pub mod evidence;
#[cfg(feature = "audit")]
pub mod kernel;
#[cfg(feature = "audit")]
pub mod prove;
#[cfg(feature = "audit")]
pub mod reference;
#[cfg(feature = "audit")]
pub mod tex;

// Scenes, tables, commands.
#[cfg(feature = "cli")]
pub mod accuracy;
#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "cli")]
pub mod report;
#[cfg(feature = "cli")]
pub mod scene;
