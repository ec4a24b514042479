//! Impacts, simulation, sweeps and trajectories, and their bounds.

#[path = "../common/mod.rs"]
mod common;

mod basins;
mod driven;
mod many_digits;
mod map;
mod optimum;
mod simulate;
mod sweep;
mod swept_voltages;
mod trajectory;
