//! `vibro-audit branch SCENE`.

use super::complete::{Complete, incomplete};
use super::{Answer, Asked, Failure, Options, SceneArguments, note};
use crate::number::{Decimals, Interval, Rung, Told};
use crate::orbit::{
    Family, Followed, Found, Goal, Instant, Moment, Open, OpenEvent, Prepared, Rounded, Wanted, Word, confirmed_at,
};
use crate::report::{Cell, Table};
use crate::scene::{Over, Quantity, Scene, Setting, Sweep, Want};

/// The motions of the wanted words over a sweep, and every bifurcation on the way
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    complete: Complete,
}

/// The columns that scripts rely on; where something other than d is swept, its name stands before d.
const COLUMNS: [&str; 15] = [
    "kind",
    "word",
    "periods",
    "d",
    "phases",
    "velocities",
    "times",
    "trace",
    "clearance",
    "admissible",
    "error_bound",
    "number",
    "complete",
    "low",
    "high",
];

/// Where d stands.
const GAP: usize = 3;

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let scene = arguments.scene.load_for(&[Want::Branch])?;
    Ok(arguments.complete.answer(table(&scene, options)?))
}

/// The table of a scene: word by word, periods by periods, in the direction of the sweep.
pub fn table(scene: &Scene, options: &Options) -> Result<Table, Failure> {
    match options.goal_for(scene)? {
        Asked::Doubles(goal) => table_as(scene, &goal),
        Asked::Decimals(goal) => table_as(scene, &goal),
    }
}

fn table_as<W: Wanted>(scene: &Scene, wanted: &W) -> Result<Table, Failure>
where
    Cell: From<W::Number> + From<Vec<W::Number>>,
{
    let sweep = scene.sweep()?;
    let setting = scene.swept_setting()?;
    let mut table = Table::new(columns(&sweep));
    for word in scene.words()? {
        for periods in 1..=scene.max_periods()? {
            for row in rows(wanted, &setting, &sweep, &word, periods)? {
                table.push(row)?;
            }
        }
    }
    Ok(table)
}

/// The rows of the motions of a word over so many periods.
fn rows<W: Wanted>(
    wanted: &W,
    setting: &Setting,
    sweep: &Sweep,
    word: &Word,
    periods: u32,
) -> Result<Vec<Vec<Cell>>, Failure>
where
    Cell: From<W::Number> + From<Vec<W::Number>>,
{
    let values: Vec<Quantity> = sweep.values().collect();
    let [from, to] = [&sweep.from, &sweep.to].map(|end| end.value::<Interval<f64>>());
    let range = from.hull(&to);
    // the ends as f64: rounded outward they reach beyond a restitution of 1
    let [one, other] = [&sweep.from, &sweep.to].map(|end| end.value::<f64>());
    let nearest = Interval::new(one.min(other), one.max(other));
    let (points, events) = if *word == Word::pair() {
        pairs(wanted, setting, sweep.over, periods, range, &values)?
    } else {
        followed(wanted, setting, sweep.over, word, periods, nearest, &values)?
    };
    let mut rows: Vec<(f64, Vec<Cell>)> = Vec::new();
    for (value, found) in values.iter().zip(points) {
        tell(value, &found);
        let [_, d, _, _] = wanted.parameters(&setting.fixed(value))?;
        let told = wanted.value(value);
        let at = told.to_f64();
        let complete = found.is_complete(word, periods);
        let row = |orbit: &Rounded<_>| (at, point(sweep.over, told.clone(), d.clone(), orbit.clone(), complete));
        rows.extend(found.orbits.iter().map(row));
        let place = |open: &Open| [open.place(), vec![Interval::point(at)]].concat();
        let open = found
            .open
            .iter()
            .map(|open| (at, undecided(sweep.over, word, periods, &place(open))));
        rows.extend(open);
    }
    rows.extend(events);
    if rows.is_empty() && *word != Word::pair() {
        // nothing was found, which proves nothing
        rows.push((nearest.low(), undecided(sweep.over, word, periods, &[])));
    }
    let sign = if from.midpoint() > to.midpoint() { -1.0 } else { 1.0 };
    rows.sort_by(|(one, _), (other, _)| (sign * one).total_cmp(&(sign * other)));
    Ok(rows.into_iter().map(|(_, row)| row).collect())
}

/// Motions at each value, and rows of events with the value of each.
type Swept<N> = (Vec<Found<N>>, Vec<(f64, Vec<Cell>)>);

/// The 1-1 motions: all of them, and every event.
fn pairs<W: Wanted>(
    wanted: &W,
    setting: &Setting,
    over: Over,
    periods: u32,
    range: Interval<f64>,
    values: &[Quantity],
) -> Result<Swept<W::Number>, Failure>
where
    Cell: From<W::Number> + From<Vec<W::Number>>,
{
    let prepared = Prepared::new(setting, periods, range)?;
    let points = prepared.points_as(wanted, values)?;
    let (events, open) = prepared.bifurcations_as(wanted);
    let is_complete = OpenEvent::are_all_there(&open);
    let mut rows = Vec::new();
    for open in &open {
        note(&open.to_string());
        let row = undecided(over, &Word::pair(), periods, open.cell());
        rows.push((open.cell()[2].midpoint(), row));
    }
    for event in events {
        let at = event.parameter.to_f64();
        if event.error_bound.is_none() {
            note(&format!(
                "a {} at {at}: not located to the figures asked for",
                event.event
            ));
        }
        rows.push((at, instant(over, event, is_complete)));
    }
    Ok((points, rows))
}

/// Those of any other word: the branches that a search leads to.
fn followed<W: Wanted>(
    wanted: &W,
    setting: &Setting,
    over: Over,
    word: &Word,
    periods: u32,
    range: Interval<f64>,
    values: &[Quantity],
) -> Result<Swept<W::Number>, Failure> {
    let followed = Followed::new(setting, word, periods, range)?;
    let points = followed.points_as(wanted, values)?;
    let events = followed.moments();
    let (branches, lost) = followed.branches();
    note(&format!(
        "{word} over {periods} forcing periods: {branches} branches that many starts lead to; there may be more, and \
         more happening on them between two steps"
    ));
    if lost > 0 {
        note(&format!("{word}: at {lost} ends of these no step on could be made"));
    }
    if !events.is_empty() && !wanted.is_double() {
        note(&format!("{word}: its bifurcations are located in f64"));
    }
    let unproved = events.iter().filter(|event| event.error_bound.is_none());
    for event in unproved {
        let (kind, at) = (event.event, event.parameter);
        note(&format!(
            "{word}: a {kind} near {over} = {at} is likely, but not proved"
        ));
    }
    let events = events.iter().map(|event| (event.parameter, moment(over, event)));
    Ok((points, events.collect()))
}

/// The bifurcations of 1-1 motions by two means, in decimals: the proved enclosures, and the return map; one that the
/// second means does not locate has no row there.
pub fn twice(scene: &Scene, decimals: Decimals) -> Result<[Table; 2], Failure> {
    let sweep = scene.sweep()?;
    let setting = scene.swept_setting()?;
    let [from, to] = [&sweep.from, &sweep.to].map(|end| end.value::<Interval<f64>>());
    let columns = columns(&sweep);
    let mut tables = [Table::new(columns.clone()), Table::new(columns)];
    for periods in 1..=scene.max_periods()? {
        let (events, open) = Prepared::new(&setting, periods, from.hull(&to))?
            .bifurcations_as(&Goal::decimals(decimals, Rung::Wide(50)));
        let is_complete = OpenEvent::are_all_there(&open);
        for event in events {
            if let Ok(again) = confirmed_at(&setting, &event, decimals) {
                tables[1].push(instant(sweep.over, again, is_complete))?;
            }
            tables[0].push(instant(sweep.over, event, is_complete))?;
        }
    }
    Ok(tables)
}

fn columns(sweep: &Sweep) -> Vec<&'static str> {
    let mut columns = COLUMNS.to_vec();
    if sweep.over != Over::D {
        columns.insert(GAP, sweep.over.name());
    }
    columns
}

fn tell<N>(value: &Quantity, found: &Found<N>) {
    for open in &found.open {
        note(&format!("at {value}: {open}"));
    }
}

/// What may be there in a box, or is there and cannot be told: nothing but where.
fn undecided(over: Over, word: &Word, periods: u32, place: &[Interval<f64>]) -> Vec<Cell> {
    let mut row = vec![
        Cell::from("undecided"),
        Cell::from(word.to_string()),
        Cell::from(i64::from(periods)),
    ];
    row.resize(COLUMNS.len() - 3 + usize::from(over != Over::D), Cell::Empty);
    row.extend(incomplete(place));
    row
}

fn point<N>(over: Over, parameter: N, d: N, orbit: Rounded<N>, complete: bool) -> Vec<Cell>
where
    Cell: From<N> + From<Vec<N>>,
{
    let mut row = vec![
        Cell::from("point"),
        Cell::from(orbit.word.to_string()),
        Cell::from(i64::from(orbit.periods)),
        Cell::from(d),
        Cell::from(orbit.phases),
        Cell::from(orbit.velocities),
        Cell::from(orbit.times),
        Cell::from(orbit.trace),
        Cell::from(orbit.clearance),
        Cell::from(orbit.admissible),
        orbit.error_bound.map_or(Cell::Empty, Cell::from),
        Cell::from(orbit.computed_in.to_string()),
        Cell::from(complete),
        Cell::Empty,
        Cell::Empty,
    ];
    if over != Over::D {
        row.insert(GAP, Cell::from(parameter));
    }
    row
}

fn instant<N>(over: Over, event: Instant<N>, complete: bool) -> Vec<Cell>
where
    Cell: From<N> + From<Vec<N>>,
{
    let mut row = vec![
        Cell::from(event.event.to_string()),
        Cell::from(Word::pair().to_string()),
        Cell::from(i64::from(event.periods)),
        Cell::from(event.d),
        Cell::from(Vec::from(event.phases)),
        Cell::from(Vec::from(event.velocities)),
        Cell::from(Vec::from(event.times)),
        Cell::from(event.trace),
        Cell::from(event.clearance),
        Cell::from(event.admissible),
        event.error_bound.map_or(Cell::Empty, Cell::from),
        Cell::from(event.computed_in.to_string()),
        Cell::from(complete),
        Cell::Empty,
        Cell::Empty,
    ];
    if over != Over::D {
        row.insert(GAP, Cell::from(event.parameter));
    }
    row
}

fn moment(over: Over, event: &Moment) -> Vec<Cell> {
    let mut row = vec![
        Cell::from(event.event.to_string()),
        Cell::from(event.word.to_string()),
        Cell::from(i64::from(event.periods)),
        Cell::from(event.d),
        Cell::from(event.phases.clone()),
        Cell::from(event.velocities.clone()),
        Cell::from(event.times.clone()),
        Cell::from(event.trace),
        Cell::from(event.clearance),
        Cell::from(event.admissible),
        Cell::from(event.error_bound),
        Cell::from(Rung::Double.to_string()),
        Cell::from(false),
        Cell::Empty,
        Cell::Empty,
    ];
    if over != Over::D {
        row.insert(GAP, Cell::from(event.parameter));
    }
    row
}
