//! Solutions of the equations: proposed by Newton's method, proved by Krawczyk's operator, isolated and covered.

pub(crate) mod certify;
pub(crate) mod contraction;
pub(crate) mod cover;
pub(crate) mod isolate;
pub(crate) mod krawczyk;
pub(crate) mod newton;
pub(crate) mod one_one;
pub(crate) mod proposals;
pub(crate) mod refine;
pub(crate) mod starts;
pub(crate) mod words;
