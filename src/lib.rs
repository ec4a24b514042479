//! Symbolic-numeric verification of printed formulas.

pub mod model;
pub mod number;
pub mod tex;
