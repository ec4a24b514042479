//! `vibro-audit stress [CASE] [--search SECONDS [--bless]] [--frozen FILE]`, `stress --curve [CASE] [--plot FILE]`.

use super::source::ANSWERS_AT_MOST;
use super::{Answer, Content, Exit, Failure, Options, Source, SourceError, note};
use crate::accuracy::stress::{BAR, CurveRow, StressRow, WORST, WORST_PATH, curves, frozen_text, search, stress};
use crate::report::figure::extremes;
use crate::report::{Cell, Format, Output, Table};
use std::path::PathBuf;

/// Count the correct digits of each formula at extreme parameters
///
/// Text shows double precision; csv, json and markdown have every number type. Exits with 1 where the form that is used
/// keeps fewer digits than 14.5 - log10(condition), or where a stored worst point has become less accurate.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit stress 'Delta near 0'")]
pub struct Arguments {
    /// Only the cases that have this in their names
    #[arg(value_name = "CASE", conflicts_with = "search")]
    case: Option<String>,
    /// Search for new worst points for this long instead
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    search: Option<f64>,
    /// Store the points found in golden/stress/worst.csv (run it at the root of the repository)
    #[arg(long, requires = "search")]
    bless: bool,
    /// Compare with the points of this file instead of the built-in ones
    #[arg(long, value_name = "FILE", conflicts_with = "search")]
    frozen: Option<Source>,
    /// Approach each extreme step by step: digits against the distance, or against the length that grows
    #[arg(long, conflicts_with_all = ["search", "bless", "frozen"])]
    pub(super) curve: bool,
    /// Draw the curves as SVG or PNG, a panel for each extreme
    #[arg(long, value_name = "FILE", requires = "curve")]
    plot: Option<PathBuf>,
}

/// The longest search: a day.
const LONGEST: f64 = 86_400.0;

fn seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| "not a number of seconds".to_owned())?;
    if seconds > 0.0 && seconds <= LONGEST {
        Ok(seconds)
    } else {
        Err(format!("must be above 0 and at most {LONGEST}"))
    }
}

/// The columns that text has: the named ones.
const SHOWN: usize = 7;

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    if arguments.curve {
        return curve(arguments, options);
    }
    let Some(seconds) = arguments.search else {
        let frozen = arguments
            .frozen
            .as_ref()
            .map_or(Ok(WORST.to_owned()), |source| source.read(ANSWERS_AT_MOST))?;
        return judged(&stress(arguments.case.as_deref(), &frozen)?, options);
    };
    if arguments.bless {
        // before a long search, not after: it must be there
        std::fs::metadata(WORST_PATH).map_err(|error| SourceError {
            place: WORST_PATH.to_string(),
            problem: error.into(),
        })?;
    }
    let rows = search(seconds)?;
    if arguments.bless {
        let text = frozen_text(&rows)?;
        Output::Member(PathBuf::from(WORST_PATH)).write(|to| to.write_all(text.as_bytes()))?;
        note(&format!(
            "{WORST_PATH} has {} rows; build again to hold against them",
            rows.len()
        ));
    }
    judged(&rows, options)
}

/// The columns of a curve; text has all but the last.
const CURVE_COLUMNS: [&str; 9] = [
    "extreme",
    "distance",
    "formula",
    "number",
    "form",
    "digits",
    "condition",
    "at",
    "allowed",
];

/// The curves, drawn where that is asked for.
fn curve(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let drawing = options.beside(arguments.plot.as_ref())?;
    let rows = curves(arguments.case.as_deref())?;
    if let Some(output) = drawing {
        let image = extremes(&rows).bytes(output.path())?;
        output.write(|out| out.write_all(&image))?;
    }
    let is_text = options.format == Format::Text;
    let columns = CURVE_COLUMNS.len() - usize::from(is_text);
    let mut table = Table::new(CURVE_COLUMNS.into_iter().take(columns));
    for CurveRow {
        approach,
        distance,
        row,
    } in rows.iter().filter(|row| is_shown(&row.row, is_text))
    {
        let extreme = [Cell::from(approach.name), Cell::from(rounded(*distance))];
        // without the case, of which the extreme takes the place
        let cells = extreme.into_iter().chain(cells(row).into_iter().skip(1));
        table.push(cells.take(columns).collect::<Vec<_>>())?;
    }
    let exit = exit(rows.iter().map(|row| &row.row));
    let content = Content::Table(table);
    Ok(Answer { content, exit })
}

/// The table, and whether all is as it should be.
fn judged(rows: &[StressRow], options: &Options) -> Result<Answer, Failure> {
    let is_text = options.format == Format::Text;
    let columns = if is_text { SHOWN } else { StressRow::COLUMNS.len() };
    let mut table = Table::new(StressRow::COLUMNS.into_iter().take(columns));
    for row in rows.iter().filter(|row| is_shown(row, is_text)) {
        table.push(cells(row).into_iter().take(columns).collect::<Vec<_>>())?;
    }
    let exit = exit(rows.iter());
    let content = Content::Table(table);
    Ok(Answer { content, exit })
}

/// Text has the rows of f64.
fn is_shown(row: &StressRow, is_text: bool) -> bool {
    !is_text || row.number == "f64"
}

/// Whether all is as it should be; what is not is named.
fn exit<'a>(rows: impl Iterator<Item = &'a StressRow> + Clone) -> Exit {
    let below = rows.clone().filter(|row| row.is_below_bar());
    for row in below.clone() {
        note(&format!("below {BAR} - log10(condition): {}", named(row)));
    }
    let lost = rows.filter(|row| row.has_lost_a_digit());
    for row in lost.clone() {
        note(&format!(
            "a digit is lost, {} before: {}",
            row.frozen.unwrap_or(f64::NAN),
            named(row)
        ));
    }
    Exit::from_verdict(below.count() == 0 && lost.count() == 0)
}

fn named(row: &StressRow) -> String {
    let StressRow {
        case,
        formula,
        number,
        digits,
        at,
        ..
    } = row;
    let form = row.form.name();
    format!("{case}, {formula}, {number}, {form}: {digits:.2} digits at {at}")
}

/// With so many figures as an order of magnitude bears.
fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

fn cells(row: &StressRow) -> Vec<Cell> {
    // so many figures as a measurement bears
    let digits = |value: f64| Cell::from((value * 100.0).round() / 100.0);
    let condition = rounded(row.condition);
    vec![
        Cell::from(row.case.as_str()),
        Cell::from(row.formula.as_str()),
        Cell::from(row.number.as_str()),
        Cell::from(row.form.name()),
        digits(row.digits),
        Cell::from(condition),
        Cell::from(row.at.as_str()),
        digits(row.allowed),
        Cell::from(row.frozen),
        Cell::from(Some(row.answer.as_str()).filter(|answer| !answer.is_empty())),
    ]
}
