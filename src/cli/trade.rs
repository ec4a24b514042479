//! `vibro-audit trade [TASK]`.

use super::{Answer, Content, Exit, Failure, Options};
use crate::accuracy::{TradeOptions, TradeRow, trade_dp};
use crate::report::{Cell, Table};

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
    let rows = match arguments.task {
        Task::Dp => trade_dp(&TradeOptions::default())?,
    };
    let mut table = Table::new(TradeRow::COLUMNS);
    for row in rows {
        table.push(cells(&row))?;
    }
    Ok(Answer {
        content: Content::Table(table),
        exit: Exit::AsExpected,
    })
}

fn cells(row: &TradeRow) -> Vec<Cell> {
    let count = |n: u64| Cell::from(i64::try_from(n).unwrap_or(i64::MAX));
    vec![
        Cell::from(row.task.clone()),
        Cell::from(row.number),
        Cell::from(row.method),
        count(row.operations),
        Cell::from(row.seconds),
        Cell::from(row.digits),
        Cell::from(row.on_front),
        Cell::from(row.worst_digits),
        Cell::from(row.median_digits),
        count(row.divisions),
        count(row.sincos),
    ]
}
