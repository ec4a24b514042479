//! Symbolic-numeric verification of printed formulas.

pub mod cli;
pub mod number;
pub mod report;
pub mod tex;
