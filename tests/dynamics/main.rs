//! Impacts, simulation, sweeps and trajectories, and their bounds.

mod basins;
mod bounds;
mod map;
mod simulate;
mod sweep;
mod swept_voltages;
mod trajectory;
