//! `vibro-audit basins SCENE`.

use super::answer::Rows;
use super::progress::Progress;
use super::shard::{Label, PartArguments, Shard};
use super::{Answer, Content, Exit, Failure, Options, SceneArguments};
use crate::report::{Cell, Column, Table};
use crate::scene::{ReachedAttractor, ReachedAttractors, Scene, Want};
use std::cell::RefCell;
use std::rc::Rc;

/// Which attractor each of a grid of starts comes to, then a row for each attractor
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// The attractors alone, without a row for each start
    #[arg(long, conflicts_with = "shard")]
    pub(super) attractors: bool,
    #[command(flatten)]
    part: PartArguments,
}

/// The columns that scripts rely on.
pub(super) const COLUMNS: [&str; 3] = ["phase", "velocity", "attractor"];

/// The columns of the table of attractors.
pub(super) const ATTRACTORS: [&str; 11] = [
    "attractor",
    "word",
    "periods",
    "fraction",
    "fraction_error",
    "voltage_rate",
    "voltage_rate_error",
    "starts",
    "phases",
    "velocities",
    "error_bound",
];

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let scene = arguments.scene.load_for(&[Want::Basins])?;
    let shard = arguments.part.shard;
    let label = shard
        .map(|shard| Label::new(shard, "basins", &scene, &[Want::Basins]))
        .transpose()?;
    let rows = rows_of(&scene, shard, options)?;
    Ok(Answer {
        content: match arguments.attractors {
            true => rows.following()?.map_or(Content::Tables(Vec::new()), Content::Table),
            false => Content::Rows(rows.part(label)),
        },
        exit: Exit::AsExpected,
    })
}

/// A row for each start, and after them a table of the attractors.
pub fn rows(scene: &Scene, options: &Options) -> Result<Rows, Failure> {
    rows_of(scene, None, options)
}

fn rows_of(scene: &Scene, shard: Option<Shard>, options: &Options) -> Result<Rows, Failure> {
    let mut points = scene.basins()?;
    let all = points.grid().starts();
    let own = shard.map_or(0..all, |shard| shard.range(all));
    points = points.starts(own.clone());
    let count = own.end - own.start;
    let total = usize::try_from(count).unwrap_or(usize::MAX);
    let points = Progress::over(points, total, "starts", options.out.is_some());
    let found = Rc::new(RefCell::new(ReachedAttractors::default()));
    let known = Rc::clone(&found);
    let rows = points.map(move |point| {
        let point = point?;
        let number = point.attractor.map(|attractor| known.borrow_mut().add(attractor));
        Ok(vec![
            Cell::from(point.phase.value::<f64>()),
            Cell::from(point.velocity.value::<f64>()),
            Cell::from(number.map(shown)),
        ])
    });
    let rows = Rows::new(COLUMNS.map(Column::from).to_vec(), rows);
    Ok(rows.then(move || table(&found.borrow(), count)))
}

/// Attractors are numbered from 1.
pub(super) fn shown(number: usize) -> i64 {
    i64::try_from(number).map_or(i64::MAX, |number| number.saturating_add(1))
}

/// A row for each attractor, of so many starts.
pub(super) fn table(found: &ReachedAttractors, starts: u64) -> Result<Table, Failure> {
    let mut table = Table::new(ATTRACTORS);
    for (number, attractor) in found.list.iter().enumerate() {
        table.push(row(number, attractor, starts))?;
    }
    Ok(table)
}

fn row(number: usize, attractor: &ReachedAttractor, starts: u64) -> Vec<Cell> {
    let fraction = attractor.fraction(starts);
    vec![
        Cell::from(shown(number)),
        attractor.word.as_deref().map_or(Cell::Empty, Cell::from),
        Cell::from(attractor.periods),
        Cell::from(fraction.value),
        Cell::from(fraction.error),
        Cell::from(attractor.voltage_rate.map(|rate| rate.value)),
        Cell::from(attractor.voltage_rate.and_then(|rate| rate.error)),
        Cell::from(i64::try_from(attractor.starts).unwrap_or(i64::MAX)),
        Cell::from(attractor.phases.clone()),
        Cell::from(attractor.velocities.clone()),
        Cell::from(attractor.error_bound),
    ]
}
