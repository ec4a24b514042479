//! `vibro-audit score FILE` and `vibro-audit score --exec CMD`.

use super::problems::{Selection, csv, table};
use super::source::ANSWERS_AT_MOST;
use super::{Answer, Content, Exit, Failure, Options, Source, note};
use crate::accuracy::problems::{self, Certified};
use crate::accuracy::score::{Answers, Precision, Program, Rating, parts, rate, worst};
use crate::report::figure;
use crate::report::plot::{Figure, Panel};
use crate::report::{Cell, Format, Output, Page, Part, Table};
use std::path::PathBuf;

/// Rate a solver by the correct digits of its answers to `problems`
///
/// FILE is CSV with the columns problem, quantity, answer and, if you like, seconds (of the whole problem), in any order;
/// other columns are passed over. What is no number (nothing, NaN, inf) counts as missing.
/// Digits are -log10 of the relative error, of a phase those of the difference around the circle in rad; 30 at most.
///
/// With --exec, CMD is run by `sh -c` at one tolerance after the other, which it finds in VIBRO_TOLERANCE and in place
/// of {tolerance}; it reads the problems without answers as CSV from stdin and writes such answers to stdout.
#[derive(Debug, clap::Args)]
#[command(verbatim_doc_comment)]
#[command(after_help = "Example: vibro-audit score answers.csv --summary")]
pub struct Arguments {
    /// The answers; `-` for stdin
    #[arg(value_name = "FILE", required_unless_present = "exec", conflicts_with = "exec")]
    file: Option<Source>,
    /// A program that answers
    #[arg(long, value_name = "CMD")]
    exec: Option<String>,
    /// The tolerances it is run at, between commas
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "1e-3,1e-6,1e-9,1e-12", value_parser = tolerance, requires = "exec")]
    tolerances: Vec<String>,
    /// How long each run may take
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = seconds, requires = "exec")]
    limit: f64,
    #[command(flatten)]
    selection: Selection,
    /// Worst and median of each kind and level; with --exec, of each tolerance: the work-precision curve
    #[arg(long)]
    pub(super) summary: bool,
    /// Draw the digits of every problem; with --exec, the work-precision curve
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// Exit with 1 where any quantity has fewer digits than this, or no answer; with --exec, at the last tolerance
    #[arg(long, value_name = "N", value_parser = digits)]
    at_least: Option<f64>,
}

fn positive(text: &str, what: &str) -> Result<f64, String> {
    let read = text
        .parse()
        .ok()
        .filter(|value: &f64| value.is_finite() && *value > 0.0);
    read.ok_or_else(|| format!("{what} is a number above 0"))
}

/// As it was typed: a program reads it as it likes.
fn tolerance(text: &str) -> Result<String, String> {
    positive(text, "a tolerance").map(|_| text.to_owned())
}

fn seconds(text: &str) -> Result<f64, String> {
    positive(text, "a limit")
}

fn digits(text: &str) -> Result<f64, String> {
    let read = text.parse().ok().filter(|value| (0.0..=30.0).contains(value));
    read.ok_or_else(|| "digits are a number from 0 to 30".to_owned())
}

/// A run of a program.
struct Run {
    tolerance: String,
    seconds: f64,
    ratings: Vec<Rating>,
}

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    options.beside(arguments.plot.as_ref())?;
    match &arguments.exec {
        Some(command) => by_program(arguments, command, options),
        None => by_file(arguments, options),
    }
}

fn asked(arguments: &Arguments) -> Result<Vec<Certified>, Failure> {
    Ok(problems::all(|problem| arguments.selection.has(problem))?)
}

fn by_file(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let source = arguments.file.clone().unwrap_or(Source::Stdin);
    let (name, text) = (source.name(), source.read(ANSWERS_AT_MOST)?);
    let asked = asked(arguments)?;
    let ratings = rate(&asked, &Answers::read(&name, &text, &asked)?);
    let content = if arguments.summary {
        summary(&ratings)?
    } else {
        rows(&ratings)?
    };
    let figure = figure("Digits of the answers", figure::digits(&ratings));
    draw(arguments, &figure)?;
    tell(&ratings);
    Ok(answer(arguments, &ratings, content, figure, options))
}

fn by_program(arguments: &Arguments, command: &str, options: &Options) -> Result<Answer, Failure> {
    let asked = asked(arguments)?;
    let stdin = csv(&table(&asked, false)?, options.figures())?;
    let (command, limit) = (command.to_owned(), arguments.limit);
    let program = Program { command, limit };
    let mut runs = Vec::new();
    for tolerance in &arguments.tolerances {
        let ran = program.run(tolerance, &stdin)?;
        let file = format!("what `{}` wrote at tolerance {tolerance}", program.command);
        let ratings = rate(&asked, &Answers::read(&file, &ran.stdout, &asked)?);
        let (tolerance, seconds) = (tolerance.clone(), ran.seconds);
        runs.push(Run {
            tolerance,
            seconds,
            ratings,
        });
    }
    let content = if arguments.summary {
        curve(&runs)?
    } else {
        rows_of_runs(&runs)?
    };
    let timed: Vec<(f64, Precision)> = runs
        .iter()
        .map(|run| (run.seconds, Precision::of(&run.ratings)))
        .collect();
    let figure = figure("What digits cost", vec![figure::work_precision(&timed)]);
    draw(arguments, &figure)?;
    let last = runs.last().map_or(&[][..], |run| &run.ratings);
    tell(last);
    Ok(answer(arguments, last, content, figure, options))
}

/// What the tables do not say.
fn tell(ratings: &[Rating]) {
    let Precision {
        quantities, answered, ..
    } = Precision::of(ratings);
    if answered < quantities {
        note(&format!(
            "{} of {quantities} quantities have no answer",
            quantities - answered
        ));
    }
}

fn answer(arguments: &Arguments, ratings: &[Rating], table: Table, figure: Figure, options: &Options) -> Answer {
    let as_expected = arguments.at_least.is_none_or(|least| worst(ratings) >= least);
    let content = match options.format {
        Format::Html => {
            let said = "Digits are -log10 of the relative error, of a phase those of the difference around the circle.";
            let mut parts = vec![Part::Table("Digits".to_owned(), said.to_owned(), table)];
            // answers to nothing draw nothing
            if !figure.panels.is_empty() {
                parts.insert(0, Part::Figure(figure));
            }
            Content::Page(Page {
                title: "Score of a solver".to_owned(),
                notes: Vec::new(),
                parts,
            })
        }
        _ => Content::Table(table),
    };
    Answer {
        content,
        exit: Exit::from_verdict(as_expected),
    }
}

fn figure(title: &str, panels: Vec<Panel>) -> Figure {
    Figure {
        columns: 2,
        ..Figure::new(title, panels)
    }
}

fn draw(arguments: &Arguments, figure: &Figure) -> Result<(), Failure> {
    let Some(path) = &arguments.plot else {
        return Ok(());
    };
    let image = figure.bytes(Some(path))?;
    Ok(Output::File(path.clone()).write(|to| to.write_all(&image))?)
}

fn count(count: usize) -> Cell {
    Cell::from(i64::try_from(count).unwrap_or(i64::MAX))
}

/// A tenth of a digit is all that two answers differ by to any reader; more figures keep the order.
fn told(digits: Option<f64>) -> Cell {
    Cell::from(digits.map(|digits| (digits * 1000.0).round() / 1000.0))
}

fn cells(rating: &Rating) -> Vec<Cell> {
    vec![
        Cell::from(rating.problem),
        Cell::from(rating.quantity.as_str()),
        told(rating.digits),
        Cell::from(rating.seconds),
        Cell::from(rating.kind.name()),
        Cell::from(rating.level.name()),
    ]
}

const COLUMNS: [&str; 6] = ["problem", "quantity", "digits", "seconds", "kind", "level"];

fn rows(ratings: &[Rating]) -> Result<Table, Failure> {
    let mut table = Table::new(COLUMNS);
    for rating in ratings {
        table.push(cells(rating))?;
    }
    Ok(table)
}

fn rows_of_runs(runs: &[Run]) -> Result<Table, Failure> {
    let mut table = Table::new(COLUMNS.into_iter().chain(["tolerance"]));
    for run in runs {
        for rating in &run.ratings {
            let mut row = cells(rating);
            row.push(Cell::from(run.tolerance.as_str()));
            table.push(row)?;
        }
    }
    Ok(table)
}

fn precision(precision: &Precision) -> [Cell; 5] {
    [
        count(precision.quantities),
        count(precision.answered),
        told(precision.worst),
        told(precision.median),
        Cell::from(precision.seconds),
    ]
}

fn summary(ratings: &[Rating]) -> Result<Table, Failure> {
    let mut table = Table::new(["kind", "level", "quantities", "answered", "worst", "median", "seconds"]);
    for part in parts(ratings) {
        let head = [Cell::from(part.kind.name()), Cell::from(part.level.name())];
        table.push(head.into_iter().chain(precision(&part.precision)).collect::<Vec<_>>())?;
    }
    Ok(table)
}

/// The work-precision curve; its seconds are those of the clock on the wall.
fn curve(runs: &[Run]) -> Result<Table, Failure> {
    let mut table = Table::new(["tolerance", "quantities", "answered", "worst", "median", "seconds"]);
    for run in runs {
        let mut precision = Precision::of(&run.ratings);
        precision.seconds = Some(run.seconds);
        let head = [Cell::from(run.tolerance.as_str())];
        table.push(head.into_iter().chain(self::precision(&precision)).collect::<Vec<_>>())?;
    }
    Ok(table)
}
