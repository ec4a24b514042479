//! `vibro-audit trade [TASK]`.

use super::{Answer, Failure, Options};

/// Measure cost against true error of each means to one end, and mark the Pareto front
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// What to compute
    #[arg(value_name = "TASK", value_enum, default_value_t = Task::Dp)]
    task: Task,
}

/// What the means are compared on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Task {
    /// The Jacobian of a 1-1 motion's map, DP = DP_2 DP_1
    Dp,
}

/// Runs the command.
pub fn run(arguments: &Arguments, _options: &Options) -> Result<Answer, Failure> {
    match arguments.task {
        Task::Dp => Err(Failure::NotBuilt("trade dp")),
    }
}
