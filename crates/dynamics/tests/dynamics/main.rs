//! Motions, periodic orbits and bifurcations, held against other ways to compute them.

mod bifurcations;
mod bounds;
mod curves;
mod follow;
mod forced;
mod forcings;
mod model;
mod motions;
mod orbits;
mod printed_orbits;
mod scan;
mod words;
