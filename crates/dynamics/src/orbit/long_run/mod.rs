//! What a simulated motion comes to: a cycle, a rest, or statistics.

pub(crate) mod attractor;
pub(crate) mod cycle_means;
pub(crate) mod lyapunov;
pub(crate) mod proved_cycle;
pub(crate) mod repetition;
pub(crate) mod resting;
pub(crate) mod statistics;
pub(crate) mod steady_state;
pub(crate) mod symbols;
