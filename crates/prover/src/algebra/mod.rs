//! Exact algebra over the kernel's polynomials, for the search of certificates. Nothing here is trusted: every
//! function that finds an identity returns its cofactors, and the kernel multiplies them out.
//!
//! Work is limited by [`Steps`], never by time: a function that would need more returns [`Exhausted`].

mod algebraic;
mod coefficient;
mod division;
mod factor;
mod gcd;
mod groebner;
mod linear;
mod membership;
mod order;
mod positive;
mod reduction;
mod residue;
mod root;
mod simplex;
mod steps;
#[cfg(test)]
mod testing;
mod univariate;

pub use algebraic::{MinimalPolynomial, QuotientAlgebra};
pub use division::{
    coefficients_in, combination, degree_in, derivative, divide, exact_quotient, exponent, from_coefficients_in,
    is_constant, is_one, lead_monomial, power, power_of, primitive, pseudo_divide, shifted, substitute, times,
    total_degree,
};
pub use factor::{Factors, factors};
pub use gcd::{content_in, gcd, primitive_in, split_monomial, squarefree};
pub use groebner::{Basis, groebner};
pub use linear::{null_space, rank, solve};
pub use membership::{RadicalMembership, Refutation, contradiction, member, radical_member};
pub use order::Order;
pub use positive::{Certificate, Fact, Summand, positive, right_side};
pub use residue::{MODULUS, Residue, evaluate_mod};
pub use root::{rational_root, square_root};
pub use steps::{Exhausted, Result, Steps};
