//! Curves of bifurcations over two parameters, followed with every step proved: of 1-1 motions, with their special
//! points located, and of motions of any word.

pub(crate) mod coefficient;
pub(crate) mod curve_system;
pub(crate) mod follow;
pub(crate) mod one_one_curves;
pub(crate) mod queue;
pub(crate) mod special_points;
pub(crate) mod word_curves;
