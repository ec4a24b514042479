//! Exact algebra over the kernel's polynomials, for the search of certificates. Nothing here is trusted: every
//! function that finds an identity returns its cofactors, and the kernel multiplies them out.
//!
//! Work is limited by [`Steps`], never by time: a function that would need more returns [`Exhausted`].

mod coefficient;
mod division;
mod groebner;
mod order;
mod reduction;
mod residue;
mod steps;
#[cfg(test)]
mod testing;

pub use division::{
    coefficients_in, combination, degree_in, derivative, divide, exact_quotient, exponent, from_coefficients_in,
    is_constant, is_one, lead_monomial, power, power_of, primitive, pseudo_divide, shifted, substitute, times,
    total_degree,
};
pub use groebner::{Basis, RadicalMembership, Refutation, contradiction, groebner, member, radical_member};
pub use order::Order;
pub use residue::{MODULUS, Residue, evaluate_mod};
pub use steps::{Exhausted, Result, Steps};
