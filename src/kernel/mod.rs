//! The kernel: the statement of a claim, and the certificates and witnesses that decide it.

mod polynomial;
mod term;

pub use polynomial::{Monomial, Polynomial, product};
pub use term::{Elementary, Function, Node, Symbol, Term, Terms};
