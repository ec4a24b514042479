//! `vibro-audit map SCENE`.

use super::part::PartArguments;
use super::progress::Progress;
use super::resume::Unfinished;
use super::rows::Rows;
use super::shard::Label;
use super::sweep::summarised;
use super::{Answer, Exit, Failure, Options, SceneArguments};
use crate::report::{Cell, Column};
use crate::scene::{MapPoint, MapPoints, MapWant, Scene, Want};

/// Compute the long-term motion at each point of two parameters
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit map examples/map.toml --out map.csv --resume")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    part: PartArguments,
}

/// The columns that scripts rely on.
const COLUMNS: [&str; 13] = [
    "x",
    "y",
    "start",
    "word",
    "periods",
    "impacts",
    "mean_voltage",
    "mean_voltage_error",
    "voltage_rate",
    "voltage_rate_error",
    "lyapunov",
    "lyapunov_error",
    "digits",
];

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let scene = arguments.scene.load_for(&[Want::Map])?;
    let part = &arguments.part;
    let label = |shard| Label::new(shard, "map", &scene, &[Want::Map]);
    let mut points = scene.map_points()?;
    let unfinished = part.unfinished(options, points.follow(), label, &COLUMNS)?;
    if let Some(shard) = part.shard {
        let own = shard.range(points.count_rows());
        points = points.rows(own);
    }
    points = points.without(unfinished.as_ref().map_or(0, Unfinished::rows));
    let label = part.shard.map(label).transpose()?;
    Ok(Answer {
        content: PartArguments::content(rows_of(points, options), label, unfinished),
        exit: Exit::AsExpected,
    })
}

/// A row for each point and start.
pub fn rows(scene: &Scene, options: &Options) -> Result<Rows, Failure> {
    Ok(rows_of(scene.map_points()?, options))
}

fn rows_of(points: MapPoints, options: &Options) -> Rows {
    let map = points.grid();
    let shown: Vec<bool> = COLUMNS.iter().map(|column| is_wanted(&map.wants, column)).collect();
    let total = map.x.points as usize * points.count_rows() as usize;
    let points = Progress::bar(total, "points")
        .beside_rows(options.out.is_some())
        .over(points);
    let rows = points.map(move |point| {
        let point = point?;
        let cell = |(column, is_shown): (&&str, &bool)| if *is_shown { cell(&point, column) } else { Cell::Empty };
        Ok(COLUMNS.iter().zip(&shown).map(cell).collect())
    });
    Rows::new(COLUMNS.map(Column::from).to_vec(), rows)
}

fn is_wanted(wants: &[MapWant], column: &str) -> bool {
    let by = match column {
        "word" | "periods" => MapWant::Word,
        "mean_voltage" | "mean_voltage_error" => MapWant::MeanVoltage,
        "voltage_rate" | "voltage_rate_error" => MapWant::VoltageRate,
        "lyapunov" | "lyapunov_error" | "digits" => MapWant::Lyapunov,
        _ => return true,
    };
    wants.contains(&by)
}

fn cell(found: &MapPoint, column: &str) -> Cell {
    match column {
        "x" => Cell::from(found.point.value.value::<f64>()),
        "y" => Cell::from(found.y.value::<f64>()),
        "start" => Cell::from(found.start as i64),
        _ => summarised(&found.point, column),
    }
}
