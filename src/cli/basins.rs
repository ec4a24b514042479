//! `vibro-audit basins SCENE`.

use super::part::PartArguments;
use super::progress::Progress;
use super::resume::Unfinished;
use super::rows::Rows;
use super::shard::Label;
use super::{Answer, Content, Exit, Failure, Options, SceneArguments};
use crate::report::{Cell, Column, Table};
use crate::scene::{BasinPoints, ReachedAttractor, ReachedAttractors, Scene, Want};
use std::cell::RefCell;
use std::rc::Rc;

/// Find which attractor each start of a grid reaches
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit basins examples/basins.toml --attractors")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// List only the attractors, not each start
    #[arg(long, conflicts_with_all = ["shard", "resume"])]
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
    let part = &arguments.part;
    let label = |shard| Label::new(shard, "basins", &scene, &[Want::Basins]);
    let unfinished = part.unfinished(options, false, label, &COLUMNS)?;
    let mut points = scene.basins()?;
    let all = points.grid().starts();
    let mut own = part.shard.map_or(0..all, |shard| shard.range(all));
    let starts = own.end - own.start;
    let known = match &unfinished {
        Some(unfinished) => known(unfinished, &mut points, own.start)?,
        None => ReachedAttractors::default(),
    };
    own.start += unfinished.as_ref().map_or(0, Unfinished::rows);
    let rows = rows_of(points.starts(own), known, starts, options);
    let label = part.shard.map(label).transpose()?;
    Ok(Answer {
        content: match arguments.attractors {
            true => rows.following()?.map_or(Content::Tables(Vec::new()), Content::Table),
            false => PartArguments::content(rows, label, unfinished),
        },
        exit: Exit::AsExpected,
    })
}

/// A row for each start, and after them a table of the attractors.
pub fn rows(scene: &Scene, options: &Options) -> Result<Rows, Failure> {
    let points = scene.basins()?;
    let starts = points.grid().starts();
    Ok(rows_of(points, ReachedAttractors::default(), starts, options))
}

/// A row for each attractor.
pub fn attractors(scene: &Scene, options: &Options) -> Result<Table, Failure> {
    let table = rows(scene, options)?.following()?;
    Ok(table.unwrap_or_else(|| Table::new(ATTRACTORS)))
}

/// The attractors of the rows that are there, whose first start has this number: each found anew from the first start that
/// led to it.
fn known(unfinished: &Unfinished, points: &mut BasinPoints, first: u64) -> Result<ReachedAttractors, Failure> {
    // the first row of each, and how many there are
    let mut seen: Vec<(u64, u64)> = Vec::new();
    let mut row = first;
    unfinished.each(|line| {
        if let Some((_, Some(number))) = told(line) {
            match seen.get_mut(number) {
                Some((_, starts)) => *starts += 1,
                None => seen.push((row, 1)),
            }
        }
        row += 1;
    })?;
    let mut found = ReachedAttractors::default();
    for (row, starts) in seen {
        let attractor = points.at(row)?.and_then(|point| point.attractor);
        found
            .list
            .extend(attractor.map(|attractor| ReachedAttractor { starts, ..attractor }));
    }
    Ok(found)
}

/// The rows of these points, and the attractors of them and of those that are known, of so many starts in all.
fn rows_of(points: BasinPoints, known: ReachedAttractors, starts: u64, options: &Options) -> Rows {
    let total = usize::try_from(starts).unwrap_or(usize::MAX);
    let points = Progress::bar(total, "starts")
        .beside_rows(options.out.is_some())
        .over(points);
    let found = Rc::new(RefCell::new(known));
    let all = Rc::clone(&found);
    let rows = points.map(move |point| {
        let point = point?;
        let number = point.attractor.map(|attractor| found.borrow_mut().add(attractor));
        Ok(vec![
            Cell::from(point.phase.value::<f64>()),
            Cell::from(point.velocity.value::<f64>()),
            Cell::from(number.map(shown)),
        ])
    });
    let rows = Rows::new(COLUMNS.map(Column::from).to_vec(), rows);
    rows.then(move || table(&all.borrow(), starts))
}

/// Attractors are numbered from 1.
pub(super) fn shown(number: usize) -> i64 {
    i64::try_from(number).map_or(i64::MAX, |number| number.saturating_add(1))
}

/// What stands before the attractor in a line of CSV, and its number, from 0, where it has one; nothing where that is none.
pub(super) fn told(line: &str) -> Option<(&str, Option<usize>)> {
    let (start, number) = line.rsplit_once(',')?;
    let number = match number {
        "" => None,
        number => Some(number.parse::<usize>().ok()?.checked_sub(1)?),
    };
    Some((start, number))
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
