//! Symbolic-numeric verification of printed formulas.

pub mod algebra;
pub mod number;
pub mod tex;
