#![doc = include_str!("../README.md")]
//!
//! The kernel: the statement of a claim, and the certificates and witnesses that decide it.
//!
//! Nothing else can make a [`Proved`] or a [`Refuted`]. Trusted are what makes statements, this crate, and of `numbers`
//! the exact [`Rational`](numbers::Rational) and the enclosures [`Interval`](numbers::Interval)
//! over [`Wide`](numbers::Wide) with their `sqrt`, `sincos`, `acos`, `atan2`, `bounded_exp` and `bounded_ln`.
//! Whatever searches for a certificate is not trusted.

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

mod axiom;
mod boxes;
mod certificate;
mod check;
mod draft;
mod enclosure;
mod ends;
mod expand;
mod implicit;
mod polynomial;
mod quadrature;
mod statement;
mod term;
mod verdict;
mod witness;
mod words;

pub use axiom::{AXIOMS, Axiom, AxiomRow, Guard};
pub use certificate::{Certificate, Inference, LawSource, Summand};
pub use check::{Checker, Fact};
pub use draft::{Draft, Parts};
pub use enclosure::{enclose, sign, term_value};
pub use expand::{Derivatives, Expansion, Quotient, Refusal, vanishes};
pub use implicit::{determinant, slope_determinant};
pub use polynomial::{Monomial, Polynomial, product};
pub use statement::{
    DERIVATIVES_EXIST, FunctionOf, Given, Implicit, Instance, Law, Origin, Piecewise, Property, Quantity, Sequence,
    Statement,
};
pub use term::{Elementary, Function, Node, Symbol, Term, Terms};
pub use verdict::{
    EFFORT, Evaluated, Point, Proved, Refuted, With, contradicts, evaluate, follows, prove, refute, refute_nowhere,
};
pub use witness::{At, Witness};
pub use words::{Letter, Word, WordMultiple, WordProof, WordQuestion, WordSource, Words, prove_in_words};
