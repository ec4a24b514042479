//! Symbolic-numeric verification of printed formulas.

pub mod accuracy;
pub mod model;
pub mod number;
pub mod tex;
