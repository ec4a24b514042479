//! `vibro-audit branch SCENE`.

use super::complete::{Complete, incomplete};
use super::curves::{self, COLUMNS, GAP};
use super::motions::Motions;
use super::rows::Rows;
use super::{Answer, Asked, Failure, Options, SceneArguments, note};
use crate::number::{Decimals, Interval, Rung, Told};
use crate::orbit::{
    BifurcationPoint, Family, FoundOrbits, OneOneBranches, OpenBifurcation, OpenOrbit, Output, OutputPrecision,
    RoundedOrbit, Word, WordBranches, confirm_bifurcation,
};
use crate::report::{Cell, Column, Table};
use crate::scene::{Over, Quantity, Scene, Setting, Sweep, Want};
use std::collections::VecDeque;

/// Follow periodic motions over a parameter and find every bifurcation
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit branch fig02 --format csv --out branch.csv")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    complete: Complete,
}

/// The values that are computed together.
const BLOCK: u32 = 1024;

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let scene = arguments.scene.load_for(&[Want::Branch])?;
    let rows = rows(&scene, options)?.leaving_out("point", "points of branches");
    Ok(arguments.complete.answer(rows))
}

/// The rows of a scene: word by word, periods by periods, in the direction of the sweep.
pub fn rows(scene: &Scene, options: &Options) -> Result<Rows, Failure> {
    if scene.branches_over_two() {
        return curves::rows(scene, options);
    }
    match options.goal_for(scene)? {
        Asked::Doubles(goal) => rows_as(scene, goal),
        Asked::Decimals(goal) => rows_as(scene, goal),
    }
}

fn rows_as<W: Output + Clone + 'static>(scene: &Scene, wanted: W) -> Result<Rows, Failure>
where
    Cell: From<W::Number> + From<Vec<W::Number>>,
{
    let (sweep, setting) = (scene.sweep()?, scene.swept_setting()?);
    let kinds = scene.words_and_periods()?;
    let columns = columns(&sweep).into_iter().map(Column::from).collect();
    let switches = scene.switches()?;
    let known = kinds.clone();
    let rows = kinds.into_iter().flat_map(move |(word, periods)| -> Made {
        match BranchRows::new(&wanted, &setting, &sweep, word, periods) {
            Ok(rows) => {
                let parting = rows.parting(switches, &known);
                Box::new(rows.chain(parting))
            }
            Err(failure) => Box::new(std::iter::once(Err(failure))),
        }
    });
    Ok(Rows::new(columns, rows))
}

/// Rows as they are made.
type Made = Box<dyn Iterator<Item = Result<Vec<Cell>, Failure>>>;

/// The rows of the motions of a word over so many periods, a block of values at a time.
struct BranchRows<W> {
    wanted: W,
    setting: Setting,
    sweep: Sweep,
    word: Word,
    periods: u32,
    motions: Motions,
    /// Rows of events, each with its value, in the direction of the sweep.
    events: VecDeque<(f64, Vec<Cell>)>,
    next: u32,
    ready: VecDeque<Vec<Cell>>,
    /// Whether no row has come yet.
    is_empty: bool,
}

impl<W: Output + Clone> BranchRows<W>
where
    Cell: From<W::Number> + From<Vec<W::Number>>,
{
    fn new(wanted: &W, setting: &Setting, sweep: &Sweep, word: Word, periods: u32) -> Result<Self, Failure> {
        let motions = Motions::new(setting, sweep, &word, periods, wanted.options())?;
        let events = match &motions {
            Motions::Pairs(prepared) => events_of_pairs(prepared, wanted, sweep.over, periods),
            Motions::Others(followed) => events_of_others(followed, wanted, sweep.over, &word, periods),
        };
        Ok(Self::of(wanted, setting, sweep, (word, periods), (motions, events)))
    }

    fn of(
        wanted: &W,
        setting: &Setting,
        sweep: &Sweep,
        (word, periods): (Word, u32),
        (motions, mut events): (Motions, Events),
    ) -> Self {
        let sign = direction(sweep);
        events.sort_by(|(one, _), (other, _)| (sign * one).total_cmp(&(sign * other)));
        Self {
            wanted: wanted.clone(),
            setting: setting.clone(),
            sweep: sweep.clone(),
            word,
            periods,
            motions,
            events: events.into(),
            next: 0,
            ready: VecDeque::new(),
            is_empty: true,
        }
    }

    /// The rows of the branches that part from these.
    fn parting(&self, switches: u32, known: &[(Word, u32)]) -> Vec<Result<Vec<Cell>, Failure>> {
        let (wanted, setting, sweep) = (&self.wanted, &self.setting, &self.sweep);
        let parting = self.motions.parting(setting, sweep, wanted.options(), switches, known);
        let rows = parting.into_iter().flat_map(|followed| {
            let (word, periods) = followed.word();
            let events = events_of_others(&followed, wanted, sweep.over, &word, periods);
            Self::of(
                wanted,
                setting,
                sweep,
                (word, periods),
                (Motions::Others(followed), events),
            )
        });
        rows.collect()
    }

    /// The rows of the next block of values, and of the events on the way there.
    fn advance(&mut self) -> Result<(), Failure> {
        let end = self.sweep.points.min(self.next + BLOCK);
        let values: Vec<Quantity> = (self.next..end).map(|index| self.sweep.value(index)).collect();
        self.next = end;
        let (wanted, over) = (&self.wanted, self.sweep.over);
        let found = self.motions.points_as(wanted, &values)?;
        let sign = direction(&self.sweep);
        for (value, found) in values.iter().zip(found) {
            tell(value, &found);
            let [_, d, _, _] = wanted.parameters(&self.setting.fixed(value))?;
            let told = wanted.value(value);
            let at = told.to_f64();
            let passed = self.events.partition_point(|(event, _)| sign * *event < sign * at);
            self.ready.extend(self.events.drain(..passed).map(|(_, row)| row));
            let complete = found.is_complete(&self.word, self.periods);
            let row = |orbit: &RoundedOrbit<_>| point(over, told.clone(), d.clone(), orbit.clone(), complete);
            self.ready.extend(found.orbits.iter().map(row));
            let place = |open: &OpenOrbit| [open.place(), vec![Interval::point(at)]].concat();
            let open = |open| undecided(over, &self.word, self.periods, &place(open));
            self.ready.extend(found.open.iter().map(open));
        }
        if self.next == self.sweep.points {
            self.ready.extend(self.events.drain(..).map(|(_, row)| row));
            if self.is_empty && self.ready.is_empty() && matches!(self.motions, Motions::Others(_)) {
                // nothing was found, which proves nothing
                self.ready.push_back(undecided(over, &self.word, self.periods, &[]));
            }
        }
        Ok(())
    }
}

impl<W: Output + Clone> Iterator for BranchRows<W>
where
    Cell: From<W::Number> + From<Vec<W::Number>>,
{
    type Item = Result<Vec<Cell>, Failure>;

    fn next(&mut self) -> Option<Self::Item> {
        while self.ready.is_empty() && self.next < self.sweep.points {
            if let Err(failure) = self.advance() {
                self.next = self.sweep.points;
                return Some(Err(failure));
            }
        }
        self.is_empty = false;
        self.ready.pop_front().map(Ok)
    }
}

/// 1 where the values of a sweep rise, else -1.
fn direction(sweep: &Sweep) -> f64 {
    let [from, to] = [&sweep.from, &sweep.to].map(|end| end.value::<f64>());
    if from > to { -1.0 } else { 1.0 }
}

/// Rows of events, each with its value.
type Events = Vec<(f64, Vec<Cell>)>;

/// Every event of the 1-1 motions.
fn events_of_pairs<W: Output>(prepared: &OneOneBranches<Setting>, wanted: &W, over: Over, periods: u32) -> Events
where
    Cell: From<W::Number> + From<Vec<W::Number>>,
{
    let (events, open) = prepared.bifurcations_as(wanted);
    let is_complete = OpenBifurcation::are_all_there(&open);
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
                event.kind
            ));
        }
        rows.push((at, bifurcation(over, event, is_complete)));
    }
    rows
}

/// The events seen on the branches of any other word.
fn events_of_others<W: Output>(
    followed: &WordBranches<Setting>,
    wanted: &W,
    over: Over,
    word: &Word,
    periods: u32,
) -> Events {
    let events = followed.bifurcations();
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
        let (kind, at) = (event.kind, event.parameter);
        note(&format!(
            "{word}: a {kind} near {over} = {at} is likely, but not proved"
        ));
    }
    events
        .into_iter()
        .map(|event| (event.parameter, bifurcation(over, event, false)))
        .collect()
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
        let (events, open) = OneOneBranches::new(&setting, periods, from.hull(&to), &scene.options()?)?
            .bifurcations_as(&OutputPrecision::decimals(decimals, Rung::Wide(50)));
        let is_complete = OpenBifurcation::are_all_there(&open);
        for event in events {
            if let Ok(again) = confirm_bifurcation(&setting, &event, decimals) {
                tables[1].push(bifurcation(sweep.over, again, is_complete))?;
            }
            tables[0].push(bifurcation(sweep.over, event, is_complete))?;
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

fn tell<N>(value: &Quantity, found: &FoundOrbits<N>) {
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

fn point<N>(over: Over, parameter: N, d: N, orbit: RoundedOrbit<N>, complete: bool) -> Vec<Cell>
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

fn bifurcation<N>(over: Over, point: BifurcationPoint<N>, complete: bool) -> Vec<Cell>
where
    Cell: From<N> + From<Vec<N>>,
{
    let mut row = vec![
        Cell::from(point.kind.to_string()),
        Cell::from(point.word.to_string()),
        Cell::from(i64::from(point.periods)),
        Cell::from(point.d),
        Cell::from(point.phases),
        Cell::from(point.velocities),
        Cell::from(point.times),
        Cell::from(point.trace),
        Cell::from(point.clearance),
        Cell::from(point.admissible),
        point.error_bound.map_or(Cell::Empty, Cell::from),
        Cell::from(point.computed_in.to_string()),
        Cell::from(complete),
        Cell::Empty,
        Cell::Empty,
    ];
    if over != Over::D {
        row.insert(GAP, Cell::from(point.parameter));
    }
    row
}
