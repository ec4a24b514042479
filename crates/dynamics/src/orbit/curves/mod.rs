//! Curves of bifurcations of 1-1 motions over two parameters: followed with every step proved, their special points
//! located.

pub(crate) mod coefficient;
pub(crate) mod curve_system;
pub(crate) mod follow;
pub(crate) mod one_one_curves;
pub(crate) mod special_points;
