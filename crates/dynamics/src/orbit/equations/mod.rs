//! The equations of periodic motions, of 1-1 motions and of other words, and those of their bifurcations.

pub(crate) mod conditions;
pub(crate) mod duals;
pub(crate) mod flight;
pub(crate) mod one_one;
pub(crate) mod one_one_bifurcations;
pub(crate) mod square_system;
pub(crate) mod touch;
pub(crate) mod words;
