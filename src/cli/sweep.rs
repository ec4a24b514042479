//! `vibro-audit sweep SCENE [--summary]`.

use super::part::PartArguments;
use super::progress::Progress;
use super::resume::Unfinished;
use super::rows::Rows;
use super::shard::{Label, Shard};
use super::{Answer, Exit, Failure, Options, SceneArguments, note};
use crate::number::FIGURES_OF_F64;
use crate::orbit::Estimate;
use crate::report::{Cell, Column, Table};
use crate::scene::{Means, Over, Point, Points, Scene, Want};
use std::ops::Range;

/// Compute a bifurcation diagram: the last impacts at each value of a parameter
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit sweep fig03 --summary")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Print one row per value: the long-term motion and its mean voltage
    #[arg(long)]
    pub(super) summary: bool,
    #[command(flatten)]
    part: PartArguments,
}

/// The columns that scripts rely on; where something other than d is swept, its name stands before d.
const COLUMNS: [&str; 6] = ["d", "impact", "side", "phase", "velocity", "voltage"];
const SUMMARY: [&str; 13] = [
    "d",
    "word",
    "periods",
    "impacts",
    "mean_voltage",
    "lyapunov",
    "digits",
    "mean_over",
    "mean_voltage_error",
    "voltage_rate",
    "voltage_rate_error",
    "lyapunov_error",
    "error_met",
];

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let scene = arguments.scene.load()?;
    let wants = scene.wants_of_sweep()?;
    arguments.scene.check(&scene, &wants)?;
    if !wants.contains(&Want::Voltage) {
        note("no voltage: the scene does not want it, or has no [membrane]");
    }
    if options.asked_of(&scene)?.is_some_and(|digits| digits > FIGURES_OF_F64) {
        note(&format!(
            "a sweep runs in f64: {FIGURES_OF_F64} digits at most; `--summary` says how many hold"
        ));
    }
    let part = &arguments.part;
    let command = if arguments.summary { "sweep --summary" } else { "sweep" };
    let label = |shard| Label::new(shard, command, &scene, &wants);
    let points = scene.points()?;
    let columns: &[&str] = if arguments.summary { &SUMMARY } else { &COLUMNS };
    let columns = columns_over(points.sweep().over, columns);
    let mut unfinished = part.unfinished(options, points.follow(), label, &columns)?;
    let mut values = values_of(&points, part.shard)?;
    if let Some(unfinished) = &mut unfinished {
        values.start = match arguments.summary {
            // a row for each value; no more than there are
            true => (values.start + unfinished.rows() as u32).min(values.end),
            false => first_left(unfinished, &points, values.clone())?,
        };
    }
    let points = points.values(values);
    let rows = if arguments.summary { summary_of } else { impacts_of };
    let rows = rows(points, options)?;
    let label = part.shard.map(label).transpose()?;
    Ok(Answer {
        content: PartArguments::content(rows, label, unfinished),
        exit: Exit::AsExpected,
    })
}

/// The first value whose rows are not all there: the last one that has some, as more may follow.
fn first_left(unfinished: &mut Unfinished, points: &Points, values: Range<u32>) -> Result<u32, Failure> {
    let Some(last) = unfinished.without_last() else {
        return Ok(values.start);
    };
    let is_it = |index: &u32| last.parse() == Ok(points.sweep().value(*index).value::<f64>());
    values.clone().find(is_it).ok_or_else(|| {
        let problem = format!("the part of the run that is there ends at {last}, which is no value of the sweep");
        Failure::Usage(problem)
    })
}

/// The columns, with the name of what is swept before d.
fn columns_over<'a>(over: Over, columns: &[&'a str]) -> Vec<&'a str> {
    let swept = (over != Over::D).then_some(over.name());
    swept.into_iter().chain(columns.iter().copied()).collect()
}

/// The last impacts at each value, all at once: for sweeps of few values.
pub fn table(scene: &Scene, options: &Options) -> Result<Table, Failure> {
    impact_rows(scene, options)?.table()
}

/// What the motion at each value has come to, all at once.
pub fn summary(scene: &Scene, options: &Options) -> Result<Table, Failure> {
    summary_rows(scene, options)?.table()
}

/// The numbers of the values of a part, or of all.
fn values_of(points: &Points, shard: Option<Shard>) -> Result<Range<u32>, Failure> {
    let all = points.sweep().points;
    match shard {
        None => Ok(0..all),
        Some(_) if points.follow() => {
            let problem = "each value follows the one before it (sweep.start = \"follow\"): such a sweep has no parts";
            Err(Failure::Usage(problem.to_owned()))
        }
        Some(shard) => {
            let values = shard.range(u64::from(all));
            // no more than there are points
            Ok(values.start as u32..values.end as u32)
        }
    }
}

/// The last impacts at each value.
pub fn impact_rows(scene: &Scene, options: &Options) -> Result<Rows, Failure> {
    impacts_of(scene.points()?, options)
}

fn impacts_of(points: Points, options: &Options) -> Result<Rows, Failure> {
    let kept = |point: &Point| point.settled.kept.len();
    rows(points.listed(), options, &COLUMNS, kept, of_impact)
}

/// What the motion at each value has come to.
pub fn summary_rows(scene: &Scene, options: &Options) -> Result<Rows, Failure> {
    summary_of(scene.points()?, options)
}

fn summary_of(points: Points, options: &Options) -> Result<Rows, Failure> {
    rows(points.with_reliance(), options, &SUMMARY, |_| 1, of_point)
}

fn rows(
    points: Points,
    options: &Options,
    columns: &[&str],
    count: fn(&Point) -> usize,
    row: fn(&Point, usize) -> Vec<Cell>,
) -> Result<Rows, Failure> {
    let over = points.sweep().over;
    let total = points.sweep().points as usize;
    let row_of = move |point: &Point, index: usize| {
        let mut row = row(point, index);
        if over != Over::D {
            row.insert(0, Cell::from(point.value.value::<f64>()));
        }
        row
    };
    let points = Progress::bar(total, "values")
        .beside_rows(options.out.is_some())
        .over(points);
    let rows = points.flat_map(move |point| -> Box<dyn Iterator<Item = Result<Vec<Cell>, Failure>>> {
        match point {
            Ok(point) => Box::new((0..count(&point)).map(move |index| Ok(row_of(&point, index)))),
            Err(error) => Box::new(std::iter::once(Err(error.into()))),
        }
    });
    let columns = columns_over(over, columns);
    Ok(Rows::new(columns.into_iter().map(Column::from).collect(), rows))
}

fn of_impact(point: &Point, index: usize) -> Vec<Cell> {
    let impact = &point.settled.kept[index];
    let voltage = point
        .voltages
        .as_ref()
        .and_then(|voltages| voltages.get(index))
        .copied();
    vec![
        Cell::from(*point.motion.d()),
        count(point.settled.first + index as u64),
        Cell::from(impact.side.to_string()),
        Cell::from(impact.phase),
        Cell::from(impact.velocity),
        Cell::from(voltage),
    ]
}

fn of_point(point: &Point, _: usize) -> Vec<Cell> {
    SUMMARY.map(|column| summarised(point, column)).to_vec()
}

/// What a column of `sweep --summary` or `map` says of a point; empty where that has no such thing.
pub(super) fn summarised(point: &Point, column: &str) -> Cell {
    let means = point.means.as_ref();
    let attractor = point.settled.attractor.as_ref();
    let estimate = |of: fn(&Means) -> Option<Estimate>| means.and_then(of);
    let value = |of| Cell::from(estimate(of).map(|found| found.value));
    let error = |of| Cell::from(estimate(of).and_then(|found| found.error));
    match column {
        "d" => Cell::from(*point.motion.d()),
        "word" => attractor.map_or(Cell::Empty, |found| Cell::from(found.word.as_str())),
        "periods" => Cell::from(attractor.and_then(|found| found.periods)),
        "impacts" => means.map_or(Cell::Empty, |means| count(means.impacts)),
        "digits" => Cell::from(point.digits.map(i64::from)),
        "mean_over" => means.map_or(Cell::Empty, |means| Cell::from(means.over.name())),
        "mean_voltage" => value(|means| means.voltage),
        "mean_voltage_error" => error(|means| means.voltage),
        "voltage_rate" => value(|means| means.rate),
        "voltage_rate_error" => error(|means| means.rate),
        "lyapunov" => value(|means| means.lyapunov),
        "lyapunov_error" => error(|means| means.lyapunov),
        "error_met" => means.and_then(|means| means.is_met).map_or(Cell::Empty, Cell::from),
        _ => Cell::Empty,
    }
}

fn count(number: u64) -> Cell {
    Cell::from(i64::try_from(number).unwrap_or(i64::MAX))
}
