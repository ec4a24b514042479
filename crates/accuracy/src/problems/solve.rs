//! The problems as this program itself answers them in f64.

use super::problem::{Kind, Means, Problem};
use super::values::Values;
use super::{Why, jacobians, orbits, runs, voltages};

/// The quantities of a problem in f64.
///
/// # Errors
/// The means has no answer.
pub fn solve(problem: &Problem, means: Means) -> Result<Vec<(String, f64)>, Why> {
    let values: Values<f64> = match problem.kind {
        Kind::Orbit => orbits::solved(problem, means)?,
        Kind::Impact | Kind::Run => runs::solved(problem, means)?,
        Kind::Jacobian => jacobians::solved(problem, means)?,
        Kind::Voltage => voltages::solved(problem, means)?,
    };
    Ok(values.0)
}
