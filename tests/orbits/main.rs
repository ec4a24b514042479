//! Periodic orbits, branches and bifurcations.

#[path = "../common/mod.rs"]
mod common;

mod bifurcations;
mod curves;
mod follow;
mod optimum;
mod orbits;
mod printed_orbits;
mod references;
mod scan;
mod words;
