//! `vibro-audit trade [TASK] [--plot FILE]`.

use super::progress::Progress;
use super::{Answer, Content, Exit, Failure, Options, note};
use crate::accuracy::{
    Advice, AdviceError, Latency, Need, Rank, Task, TradeError, TradeOptions, TradeRow, Unsolved, advise, machine,
    trade,
};
use crate::number::Rung;
use crate::orbit::most_figures;
use crate::report::figure::trades;
use crate::report::{Cell, Format, Output, Page, Part, Table};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::path::PathBuf;

/// Measure time against true error for each method of a task
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit trade --advise digits=8,task=orbit")]
pub struct Arguments {
    /// What to compute [default: all of them, within a minute]
    #[arg(value_name = "TASK", value_parser = task_parser())]
    task: Option<Task>,
    /// Only this method, by its name in the table
    #[arg(long, value_name = "NAME")]
    method: Option<String>,
    /// Only this number
    #[arg(long, value_name = "NAME", value_parser = rung_parser())]
    number: Option<Rung>,
    /// List every problem of the task with the result of each method, untimed
    #[arg(long, conflicts_with = "plot")]
    pub(super) problems: bool,
    /// Name the cheapest means for a need, and the runner-up: digits=8,solved=0.99,task=orbit, or error=0.01,task=voltage
    ///
    /// `digits` are to hold at the share `solved` of the problems (at all of them where it is not given), `error` is the
    /// relative error of a statistic, `proved=true` asks for a proof, `task` for the tasks with this in their names. Exits
    /// with 1 where neither a means of a task nor a command does it, and names the closest.
    #[arg(long, value_name = "NEED", conflicts_with_all = ["task", "problems", "method", "number"])]
    pub(super) advise: Option<Need>,
    /// Draw digits against time as SVG or PNG, a panel for each task; the fastest method for each number of digits is marked
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
const SHOWN: [usize; 8] = [0, 1, METHOD, 4, 5, 7, 8, 6];

/// The column of the means.
const METHOD: usize = 2;

/// The number with so many significant figures as a measurement bears.
fn measured(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let drawing = options.beside(arguments.plot.as_ref())?;
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
    if let Some(need) = &arguments.advise {
        return advised(need, &asked, drawing, options.format == Format::Text);
    }
    let latency = measured_latency(arguments.problems);
    let mut rows = Vec::new();
    let mut none = None;
    let progress = Progress::bar(tasks.len(), "tasks");
    for task in tasks {
        progress.step();
        match trade(task, &asked, &latency) {
            Ok(found) => rows.extend(found),
            // a means of one task is none of the others
            Err(error @ TradeError::Means { .. }) => none = Some(error),
            Err(error) => return Err(error.into()),
        }
    }
    if let Some(error) = none.filter(|_| rows.is_empty()) {
        return Err(error.into());
    }
    draw(&rows, drawing)?;
    let table = match arguments.problems {
        true => problems(&rows)?,
        false => table(&rows, options)?,
    };
    let content = match options.format {
        Format::Html => Content::Page(page(table, &rows, &latency, arguments.problems)),
        _ => Content::Table(table),
    };
    Ok(Answer {
        content,
        exit: Exit::AsExpected,
    })
}

/// The table, and where there is a clock the drawing.
fn page(table: Table, rows: &[TradeRow], latency: &Latency, without_clock: bool) -> Page {
    let said = "Cost against true error of each means; `on_front` where no other is both cheaper and more accurate.";
    let mut parts = vec![Part::Table("Means".to_owned(), said.to_owned(), table)];
    let mut notes = Vec::new();
    if !without_clock {
        notes.push(format!("Times are of {}; {latency}.", machine()));
        parts.insert(0, Part::Figure(trades(rows, &machine())));
    }
    Page {
        title: "What digits cost".to_owned(),
        notes,
        parts,
    }
}

/// L, told on stderr with the machine; not measured where nothing is timed.
fn measured_latency(without_clock: bool) -> Latency {
    if without_clock {
        return Latency::none();
    }
    let latency = Latency::measured();
    note(&format!("times are of {}; {latency}", machine()));
    latency
}

fn draw(rows: &[TradeRow], drawing: Option<Output>) -> Result<(), Failure> {
    if let Some(output) = drawing {
        let image = trades(rows, &machine()).bytes(output.path())?;
        output.write(|out| out.write_all(&image))?;
    }
    Ok(())
}

/// The columns of [`advised`]; of these, text has the first, with the setting behind the means.
const ADVICE: [&str; 12] = [
    "task", "rank", "by", "number", "method", "kept", "seconds", "setting", "solved", "problems", "cost", "proved",
];
const ADVICE_SHOWN: usize = 7;

/// What to take, of the tasks that a need speaks of.
fn advised(need: &Need, asked: &TradeOptions, drawing: Option<Output>, is_text: bool) -> Result<Answer, Failure> {
    let wanted = need.task.as_deref().unwrap_or("");
    let is_meant = |task: &Task| (*task == Task::Statistics) == need.of_statistics;
    let none = |tasks: Vec<&str>| AdviceError::Task {
        task: wanted.to_owned(),
        tasks: tasks.join(", "),
    };
    let meant: Vec<Task> = Task::ALL.into_iter().filter(is_meant).collect();
    let tasks: Vec<Task> = meant.iter().copied().filter(|task| task.is_named(wanted)).collect();
    if tasks.is_empty() {
        return Err(none(meant.into_iter().map(Task::name).collect()).into());
    }
    let latency = measured_latency(false);
    let mut all = Vec::new();
    let progress = Progress::bar(tasks.len(), "tasks");
    for task in tasks {
        progress.step();
        all.extend(trade(task, asked, &latency)?);
    }
    let rows: Vec<TradeRow> = all.iter().filter(|row| row.task.contains(wanted)).cloned().collect();
    if rows.is_empty() {
        let mut parts: Vec<&str> = all.iter().map(|row| row.task.as_str()).collect();
        parts.dedup();
        return Err(none(parts).into());
    }
    draw(&rows, drawing)?;
    let advice = advise(&rows, need);
    let shown = if is_text { ADVICE_SHOWN } else { ADVICE.len() };
    let mut table = Table::new(ADVICE.into_iter().take(shown));
    for Advice { rank, basis, row } in &advice {
        if *rank == Rank::Closest {
            let (digits, share) = (need.digits, 100.0 * need.solved);
            let (kept, problems) = (need.kept_at(row), row.problems.len());
            let proof = match (need.proved, row.proved) {
                (true, false) => " and nothing proves them",
                _ => "",
            };
            note(&format!(
                "{}: nothing measured keeps {digits:.1} digits at {share}% of the problems{proof}; the closest keeps them at {kept} of {problems}",
                row.task
            ));
        }
        let cells = [
            Cell::from(row.task.clone()),
            Cell::from(rank.name()),
            Cell::from(basis.name()),
            Cell::from(row.number.to_string()),
            if is_text {
                with_setting(row)
            } else {
                Cell::from(row.method)
            },
            Cell::from(measured(row.kept(need.solved))),
            Cell::from(measured(row.seconds)),
            setting(row),
            count(row.solved as u64),
            count(row.problems.len() as u64),
            count(row.cost),
            Cell::from(row.proved),
        ];
        table.push(cells.into_iter().take(shown).collect::<Vec<_>>())?;
    }
    for line in chosen(need, &advice) {
        note(&line);
    }
    let is_met = advice
        .iter()
        .all(|advice| advice.rank != Rank::Closest || Taker::is_met(&advice.row.task, need));
    Ok(Answer {
        content: Content::Table(table),
        exit: Exit::from_verdict(is_met),
    })
}

/// A command that computes what a task compares, in as wide a number as `--digits` needs.
struct Taker {
    task: Task,
    command: &'static str,
    method: &'static str,
    proves: bool,
    /// The reason for a method that is not the cheapest.
    why: &'static str,
}

impl Taker {
    const ALL: [Self; 2] = [
        Self {
            task: Task::Orbit,
            command: "orbits",
            method: "certified",
            proves: true,
            why: "a command proves the orbits that it prints",
        },
        Self {
            task: Task::Impact,
            command: "simulate",
            method: "own",
            proves: false,
            why: "a command says how many digits hold",
        },
    ];

    /// Returns true if a part of a task has a command that meets the need.
    fn is_met(part: &str, need: &Need) -> bool {
        let mut takers = Self::ALL.iter().filter(|taker| part.starts_with(taker.task.name()));
        takers.any(|taker| !need.of_statistics && Self::reach(need) && (taker.proves || !need.proved))
    }

    /// Returns true if `--digits` takes as many as are needed.
    fn reach(need: &Need) -> bool {
        need.digits.ceil() as usize <= most_figures()
    }
}

/// Describes what `--digits` and `sweep.error` take for the same need, and why, where it is not what is advised.
fn chosen(need: &Need, advice: &[Advice]) -> Vec<String> {
    let advised = |part: &str, method: &str, number: &str| {
        advice.iter().any(|advice| {
            let row = advice.row;
            row.task.starts_with(part) && row.method == method && row.number.to_string() == number
        })
    };
    if need.of_statistics {
        return vec![format!(
            "`sweep.error = {}` follows each motion until its own standard error says so, in lanes where there are eight values or more",
            measured(10_f64.powf(-need.digits))
        )];
    }
    let digits = need.digits.ceil() as u32;
    if !Taker::reach(need) {
        let most = most_figures();
        return vec![format!(
            "no command computes {digits} digits of a motion; ask for at most {most}"
        )];
    }
    let number = Rung::reaching(digits).to_string();
    let is_asked = |taker: &&Taker| {
        advice
            .iter()
            .any(|advice| advice.row.task.starts_with(taker.task.name()))
    };
    let line = |taker: &Taker| {
        let Taker {
            task,
            command,
            method,
            why,
            ..
        } = taker;
        let why = if advised(task.name(), method, &number) {
            "as advised"
        } else {
            why
        };
        format!("`{command} --digits {digits}` takes {method} in {number}: {why}")
    };
    Taker::ALL.iter().filter(is_asked).map(line).collect()
}

fn count(n: u64) -> Cell {
    Cell::from(i64::try_from(n).unwrap_or(i64::MAX))
}

/// A person reads one table of the width of a terminal: the means as they are used, and of their ladders what is on the
/// front. Scripts get every row and column.
fn table(rows: &[TradeRow], options: &Options) -> Result<Table, Failure> {
    let is_text = options.format == Format::Text;
    let shown: Vec<usize> = match options.format {
        Format::Text => SHOWN.to_vec(),
        _ => (0..TradeRow::COLUMNS.len()).collect(),
    };
    let mut table = Table::new(shown.iter().map(|&column| TradeRow::COLUMNS[column]));
    for row in rows
        .iter()
        .filter(|row| !is_text || row.setting.is_empty() || row.on_front)
    {
        let mut cells = cells(row);
        if is_text {
            cells[METHOD] = with_setting(row);
        }
        table.push(shown.iter().map(|&column| cells[column].clone()).collect::<Vec<_>>())?;
    }
    Ok(table)
}

/// The columns of [`problems`].
const PROBLEMS: [&str; 8] = [
    "task", "number", "method", "problem", "digits", "outcome", "at", "setting",
];

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
                setting(row),
            ])?;
        }
    }
    Ok(table)
}

fn cells(row: &TradeRow) -> Vec<Cell> {
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
        setting(row),
        count(row.cost),
        Cell::from(row.proved),
    ]
}

/// The means with its setting behind it, as a person reads it.
fn with_setting(row: &TradeRow) -> Cell {
    Cell::from(format!("{} {}", row.method, row.setting).trim_end().to_owned())
}

/// Empty where there is none.
fn setting(row: &TradeRow) -> Cell {
    Cell::from(Some(row.setting.as_str()).filter(|setting| !setting.is_empty()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_meets_a_need_of_its_task_in_the_numbers_that_it_has() {
        for (part, need, is_met) in [
            ("orbit/guess-5%", "digits=60", true),
            ("orbit/guess-5%", "digits=60,proved=true", true),
            // as many as `orbits` takes
            ("orbit/guess-5%", "digits=195", true),
            ("orbit/guess-5%", "digits=196", false),
            ("impact/random", "digits=60", true),
            ("impact/random", "digits=60,proved=true", false),
            ("multipliers/random", "digits=60", false),
            ("orbit/guess-5%", "error=0.01", false),
        ] {
            assert_eq!(Taker::is_met(part, &need.parse().unwrap()), is_met, "{part} {need}");
        }
    }
}
