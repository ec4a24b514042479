#![doc = include_str!("../README.md")]
//!
//! A witness starts from the formulas as they are printed: nothing of the reductions of `claims`
//! is used. Premises and claim become programs over slots (`formula`), evaluated over the reals or the complex numbers
//! (`value`), in f64, in duals and in 40 digits. Printed operations (`operation`) are evaluated in loops over the values
//! of their letter (`loops`): sums by their terms (`series`), integrals by quadrature (`quadrature`), limits by
//! extrapolation (`limit`), each with an estimate of its error. Random points are moved onto the premises by
//! Gauss-Newton steps (`newton`, `point`); functions of time flow by their laws (`evaluation`), or are trigonometric
//! polynomials where no premise gives them; derivatives of maps come by implicit differentiation (`derivative`). There
//! the sides of the claim are compared (`claimed`, `judgement`). No elimination, no polynomial, no closed form.

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

mod body;
mod claimed;
mod compiler;
mod course;
mod derivative;
mod domain;
mod evaluation;
mod formula;
mod gap;
mod index;
mod judgement;
mod limit;
mod loops;
mod maps;
mod motion;
mod newton;
mod operation;
mod point;
mod quadrature;
pub mod sampled;
mod samples;
mod series;
mod space;
mod stated_maps;
mod system;
mod tolerance;
mod value;

pub use compiler::Unwitnessed;
pub use judgement::{Evidence, trial, witness, witness_near};
pub use motion::Flown;
pub use samples::{Samples, samples};
