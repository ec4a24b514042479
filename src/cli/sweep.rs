//! `vibro-audit sweep SCENE [--summary]`.

use super::answer::Rows;
use super::progress::Progress;
use super::{Answer, Content, Exit, Failure, Options, SceneArguments, note};
use crate::number::FIGURES_OF_F64;
use crate::report::{Cell, Column, Table};
use crate::scene::{Over, Point, Points, Scene, Want};

/// The bifurcation diagram of a scene: at each value of its sweep the last impacts and their voltage
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// One row per value: what the motion has come to, and its mean voltage
    #[arg(long)]
    summary: bool,
}

/// The columns that scripts rely on; where something other than d is swept, its name stands before d.
const COLUMNS: [&str; 6] = ["d", "impact", "side", "phase", "velocity", "voltage"];
const SUMMARY: [&str; 8] = [
    "d",
    "word",
    "periods",
    "impacts",
    "mean_voltage",
    "lyapunov",
    "digits",
    "mean_over",
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
    let rows = if arguments.summary { summary_rows } else { impact_rows };
    Ok(Answer {
        content: rows(&scene, options).map(Content::Rows)?,
        exit: Exit::AsExpected,
    })
}

/// The last impacts at each value, all at once: for sweeps of few values.
pub fn table(scene: &Scene, options: &Options) -> Result<Table, Failure> {
    impact_rows(scene, options)?.table()
}

/// What the motion at each value has come to, all at once.
pub fn summary(scene: &Scene, options: &Options) -> Result<Table, Failure> {
    summary_rows(scene, options)?.table()
}

/// The last impacts at each value.
pub fn impact_rows(scene: &Scene, options: &Options) -> Result<Rows, Failure> {
    rows(scene.points()?.listed(), options, &COLUMNS, of_impacts)
}

/// What the motion at each value has come to.
pub fn summary_rows(scene: &Scene, options: &Options) -> Result<Rows, Failure> {
    rows(scene.points()?.with_reliance(), options, &SUMMARY, |point| {
        vec![of_point(point)]
    })
}

fn rows(
    points: Points,
    options: &Options,
    columns: &[&str],
    of: fn(&Point) -> Vec<Vec<Cell>>,
) -> Result<Rows, Failure> {
    let over = points.sweep().over;
    let total = points.sweep().points as usize;
    let swept = (over != Over::D).then_some(over.name());
    let rows_of = move |point: &Point| {
        let mut rows = of(point);
        if over != Over::D {
            for row in &mut rows {
                row.insert(0, Cell::from(point.value.value::<f64>()));
            }
        }
        rows
    };
    let points = Progress::over(points, total, "values", options.out.is_some());
    let rows = points.flat_map(move |point| match point {
        Ok(point) => rows_of(&point).into_iter().map(Ok).collect(),
        Err(error) => vec![Err(Failure::from(error))],
    });
    Ok(Rows {
        columns: swept
            .into_iter()
            .chain(columns.iter().copied())
            .map(Column::from)
            .collect(),
        rows: Box::new(rows),
    })
}

fn of_impacts(point: &Point) -> Vec<Vec<Cell>> {
    let d = *point.motion.d();
    let kept = point.settled.kept.iter().enumerate();
    let row = kept.map(|(index, impact)| {
        let voltage = point
            .voltages
            .as_ref()
            .and_then(|voltages| voltages.get(index))
            .copied();
        vec![
            Cell::from(d),
            count(point.settled.first + index as u64),
            Cell::from(impact.side.to_string()),
            Cell::from(impact.phase),
            Cell::from(impact.velocity),
            Cell::from(voltage),
        ]
    });
    row.collect()
}

fn of_point(point: &Point) -> Vec<Cell> {
    let (counted, over) = point.counted();
    let attractor = point.settled.attractor.as_ref();
    vec![
        Cell::from(*point.motion.d()),
        attractor.map_or(Cell::Empty, |found| Cell::from(found.word.as_str())),
        Cell::from(attractor.and_then(|found| found.periods)),
        count(counted.len() as u64),
        Cell::from(point.mean_voltage),
        Cell::from(point.reliance.and_then(|reliance| reliance.lyapunov)),
        Cell::from(point.reliance.map(|reliance| i64::from(reliance.digits))),
        Cell::from(over.name()),
    ]
}

fn count(number: u64) -> Cell {
    Cell::from(i64::try_from(number).unwrap_or(i64::MAX))
}
