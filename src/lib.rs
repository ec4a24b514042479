//! Symbolic-numeric verification of printed formulas.

pub mod algebra;
pub mod claim;
pub mod cli;
pub mod number;
pub mod report;
pub mod tex;
