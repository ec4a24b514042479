//! `vibro-audit trade [TASK]`.

use super::{Answer, Content, Exit, Failure, Options};
use crate::accuracy::{TradeOptions, TradeRow, trade_dp};
use crate::report::{Cell, Format, Table};

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

/// The columns that text has: the named ones.
const SHOWN: usize = 7;

/// The number with so many significant figures as a measurement bears.
fn measured(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let rows = match arguments.task {
        Task::Dp => trade_dp(&TradeOptions::default())?,
    };
    // A person reads one table of the width of a terminal; scripts get every column.
    let columns = if options.format == Format::Text {
        SHOWN
    } else {
        TradeRow::COLUMNS.len()
    };
    let mut table = Table::new(TradeRow::COLUMNS.into_iter().take(columns));
    for row in rows {
        table.push(cells(&row).into_iter().take(columns).collect::<Vec<_>>())?;
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
        Cell::from(measured(row.seconds)),
        Cell::from(measured(row.digits)),
        Cell::from(row.on_front),
        Cell::from(measured(row.worst_digits)),
        Cell::from(measured(row.median_digits)),
        count(row.divisions),
        count(row.sincos),
    ]
}
