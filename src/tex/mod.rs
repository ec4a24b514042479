//! TeX formulas: read, print, evaluate over any [`Field`](crate::number::Field).

mod tree;

pub use tree::{At, Equation, Invariant, Name, Tree};
