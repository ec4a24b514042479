//! Symbolic-numeric verification of printed formulas.

pub mod number;
pub mod tex;
