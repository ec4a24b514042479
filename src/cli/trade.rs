//! `vibro-audit trade [TASK] [--plot FILE]`.

use super::{Answer, Content, Exit, Failure, Options, note};
use crate::accuracy::{Task, TradeError, TradeOptions, TradeRow, Unsolved, machine, trade};
use crate::number::Rung;
use crate::report::figure::trades;
use crate::report::{Cell, Format, Table};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::path::PathBuf;

/// Measure cost against true error of each means to one end, and mark the Pareto front
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// What to compute [default: all of them, within a minute]
    #[arg(value_name = "TASK", value_parser = task_parser())]
    task: Option<Task>,
    /// Only this means, by the name that the table gives it
    #[arg(long, value_name = "NAME")]
    method: Option<String>,
    /// Only this number
    #[arg(long, value_name = "NAME", value_parser = rung_parser())]
    number: Option<Rung>,
    /// List every problem of the task, and what each means did on it, without a clock
    #[arg(long)]
    problems: bool,
    /// Draw time against digits as an SVG, the front as a line
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
}

fn task_parser() -> impl TypedValueParser<Value = Task> {
    let named = |name: String| Task::ALL.into_iter().find(|task| task.name() == name);
    PossibleValuesParser::new(Task::ALL.map(Task::name)).try_map(move |name| named(name).ok_or("no task"))
}

/// The widest numbers are not compared: a user who needs them has no choice.
fn rung_parser() -> impl TypedValueParser<Value = Rung> {
    let names = ["f32", "f64", "double-double", "50-digits"];
    PossibleValuesParser::new(names).try_map(|name| Rung::named(&name).ok_or("no number"))
}

/// The columns that text has, as many as a terminal is wide.
const SHOWN: [usize; 8] = [0, 1, 2, 4, 5, 7, 8, 6];

/// The number with so many significant figures as a measurement bears.
fn measured(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let drawing = options.drawing(arguments.plot.as_ref())?;
    let tasks: Vec<Task> = arguments.task.map_or_else(|| Task::ALL.to_vec(), |task| vec![task]);
    let ordinary = TradeOptions::default();
    let asked = TradeOptions {
        seconds_per_row: if arguments.problems {
            0.0
        } else {
            ordinary.seconds_per_row
        },
        method: arguments.method.clone(),
        number: arguments.number,
        ..ordinary
    };
    if !arguments.problems {
        note(&format!("times are of {}", machine()));
    }
    let mut rows = Vec::new();
    let mut none = None;
    for task in tasks {
        match trade(task, &asked) {
            Ok(found) => rows.extend(found),
            // a means of one task is none of the others
            Err(error @ TradeError::Means { .. }) => none = Some(error),
            Err(error) => return Err(error.into()),
        }
    }
    if let Some(error) = none.filter(|_| rows.is_empty()) {
        return Err(error.into());
    }
    if let Some(output) = drawing {
        let svg = trades(&rows, &machine()).svg()?;
        output.write(|out| out.write_all(svg.as_bytes()))?;
    }
    Ok(Answer {
        content: Content::Table(match arguments.problems {
            true => problems(&rows)?,
            false => table(&rows, options)?,
        }),
        exit: Exit::AsExpected,
    })
}

/// A person reads one table of the width of a terminal; scripts get every column.
fn table(rows: &[TradeRow], options: &Options) -> Result<Table, Failure> {
    let shown: Vec<usize> = match options.format {
        Format::Text => SHOWN.to_vec(),
        _ => (0..TradeRow::COLUMNS.len()).collect(),
    };
    let mut table = Table::new(shown.iter().map(|&column| TradeRow::COLUMNS[column]));
    for row in rows {
        let cells = cells(row);
        table.push(shown.iter().map(|&column| cells[column].clone()).collect::<Vec<_>>())?;
    }
    Ok(table)
}

/// The columns of [`problems`].
const PROBLEMS: [&str; 7] = ["task", "number", "method", "problem", "digits", "outcome", "at"];

/// What each means did on each problem.
fn problems(rows: &[TradeRow]) -> Result<Table, Failure> {
    let mut table = Table::new(PROBLEMS);
    for row in rows {
        for (number, outcome) in row.problems.iter().enumerate() {
            table.push(vec![
                Cell::from(row.task.clone()),
                Cell::from(row.number.to_string()),
                Cell::from(row.method),
                Cell::from(number as i64 + 1),
                Cell::from(outcome.digits.map(measured)),
                Cell::from(outcome.miss.map_or("solved", Unsolved::name)),
                Cell::from(outcome.at.to_string()),
            ])?;
        }
    }
    Ok(table)
}

fn cells(row: &TradeRow) -> Vec<Cell> {
    let count = |n: u64| Cell::from(i64::try_from(n).unwrap_or(i64::MAX));
    vec![
        Cell::from(row.task.clone()),
        Cell::from(row.number.to_string()),
        Cell::from(row.method),
        count(row.operations),
        Cell::from(measured(row.seconds)),
        Cell::from(measured(row.digits)),
        Cell::from(row.on_front),
        Cell::from(measured(row.worst)),
        count(row.solved as u64),
        count(row.problems.len() as u64),
        Cell::from(row.failures()),
        count(row.divisions),
        count(row.sincos),
        Cell::from(measured(row.spread)),
        Cell::from(measured(row.latencies)),
    ]
}
