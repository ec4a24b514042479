//! Branches of motions along a parameter, each step proved.

pub(crate) mod branch;
pub(crate) mod curve;
pub(crate) mod extended_system;
pub(crate) mod segment;
pub(crate) mod test_functions;
