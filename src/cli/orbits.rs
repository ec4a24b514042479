//! `vibro-audit orbits SCENE [--explain]`.

use super::complete::{Complete, incomplete};
use super::{Answer, Asked, Content, Exit, Failure, Options, SceneArguments, note};
use crate::number::{Decimals, Interval, Rung, Told};
use crate::orbit::{
    FoundOrbits, Isolation, OneOneSearch, Output, OutputPrecision, Parameters, RoundedOrbit, Word, confirm_orbit,
    find_as, is_covered, isolate_one_one,
};
use crate::report::{Cell, Table};
use crate::scene::{Scene, Want};

/// Find all periodic motions of a scene, with proof
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit orbits fig02 --set motion.d=0.3 --digits 30")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Show how the search for 1-1 motions went, piece by piece
    #[arg(long)]
    explain: bool,
    #[command(flatten)]
    complete: Complete,
}

/// The columns that scripts rely on.
const COLUMNS: [&str; 20] = [
    "word",
    "periods",
    "d",
    "g",
    "r_b",
    "r_t",
    "phases",
    "velocities",
    "times",
    "trace",
    "determinant",
    "kind",
    "stable",
    "clearance",
    "admissible",
    "error_bound",
    "number",
    "complete",
    "low",
    "high",
];

/// Where the kind stands.
const KIND: usize = 11;

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let scene = arguments.scene.load_for(&[Want::Orbits])?;
    if arguments.explain {
        return Ok(Answer {
            content: Content::Text(explain(&scene)?),
            exit: Exit::AsExpected,
        });
    }
    Ok(arguments.complete.answer(table(&scene, options)?))
}

/// The table of a scene.
pub fn table(scene: &Scene, options: &Options) -> Result<Table, Failure> {
    match options.goal_for(scene)? {
        Asked::Doubles(goal) => table_as(scene, &goal),
        Asked::Decimals(goal) => table_as(scene, &goal),
    }
}

fn table_as<W: Output>(scene: &Scene, wanted: &W) -> Result<Table, Failure>
where
    Cell: From<W::Number> + From<Vec<W::Number>>,
{
    let setting = scene.setting()?;
    let parameters = wanted.parameters(&setting)?;
    let mut table = Table::new(COLUMNS);
    for word in scene.words()? {
        let found = find_as(wanted, &setting, &word, scene.max_periods()?)?;
        tell(&word, &found);
        let complete = |periods| found.is_complete(&word, periods);
        for orbit in &found.orbits {
            table.push(row(parameters.clone(), orbit.clone(), complete(orbit.periods)))?;
        }
        for open in &found.open {
            let periods = open.periods();
            table.push(undecided(&word, periods, parameters.clone(), &open.place()))?;
        }
        for periods in 1..=scene.max_periods()? {
            let is_said = found.orbits.iter().any(|orbit| orbit.periods == periods)
                || found.open.iter().any(|open| open.periods() == periods);
            if !is_said && !complete(periods) {
                table.push(undecided(&word, periods, parameters.clone(), &[]))?;
            }
        }
    }
    Ok(table)
}

/// The table by two means, in decimals: the proved enclosures, and the return map; a motion that the second means does
/// not reach has no row there.
pub fn twice(scene: &Scene, decimals: Decimals) -> Result<[Table; 2], Failure> {
    let setting = scene.setting()?;
    let goal = OutputPrecision::decimals(decimals, Rung::Wide(50));
    let parameters = goal.parameters(&setting)?;
    let mut tables = [Table::new(COLUMNS), Table::new(COLUMNS)];
    for word in scene.words()? {
        let found = find_as(&goal, &setting, &word, scene.max_periods()?)?;
        for orbit in found.orbits.clone() {
            let complete = found.is_complete(&word, orbit.periods);
            if let Ok(again) = confirm_orbit(&setting, &orbit, decimals) {
                tables[1].push(row(parameters.clone(), again, complete))?;
            }
            tables[0].push(row(parameters.clone(), orbit, complete))?;
        }
    }
    Ok(tables)
}

/// What a reader of the rows alone would miss.
fn tell<N: Told>(word: &Word, found: &FoundOrbits<N>) {
    for open in &found.open {
        note(&open.to_string());
    }
    match (found.orbits.is_empty() && found.open.is_empty(), found.is_covered()) {
        (true, true) => note(&format!("no motion {word}")),
        (true, false) => note(&format!(
            "{word}: many starts lead to none; that there is none is not proved"
        )),
        (false, false) => note(&format!("{word}: motions that many starts lead to; there may be more")),
        (false, true) => {}
    }
    let unbounded = found.orbits.iter().filter(|orbit| orbit.error_bound.is_none()).count();
    if unbounded > 0 {
        note(&format!(
            "{word}: {unbounded} without error_bound: not certified, no figure of these is proved"
        ));
    }
}

/// Motions that may be there, or what is known of one that is: nothing but where. No place stands for a search that found
/// nothing and proves nothing.
fn undecided<N>(word: &Word, periods: u32, [g, d, r_b, r_t]: [N; 4], place: &[Interval<f64>]) -> Vec<Cell>
where
    Cell: From<N>,
{
    let mut row = vec![
        Cell::Text(word.to_string()),
        Cell::Integer(i64::from(periods)),
        Cell::from(d),
        Cell::from(g),
        Cell::from(r_b),
        Cell::from(r_t),
    ];
    row.resize(KIND, Cell::Empty);
    row.push(Cell::Text("undecided".to_string()));
    row.resize(COLUMNS.len() - 3, Cell::Empty);
    row.extend(incomplete(place));
    row
}

fn row<N>([g, d, r_b, r_t]: [N; 4], orbit: RoundedOrbit<N>, complete: bool) -> Vec<Cell>
where
    Cell: From<N> + From<Vec<N>>,
{
    vec![
        Cell::from(orbit.word.to_string()),
        Cell::from(i64::from(orbit.periods)),
        Cell::from(d),
        Cell::from(g),
        Cell::from(r_b),
        Cell::from(r_t),
        Cell::from(orbit.phases),
        Cell::from(orbit.velocities),
        Cell::from(orbit.times),
        Cell::from(orbit.trace),
        Cell::from(orbit.determinant),
        Cell::from(orbit.kind.to_string()),
        Cell::from(orbit.stable),
        Cell::from(orbit.clearance),
        Cell::from(orbit.admissible),
        orbit.error_bound.map_or(Cell::Empty, Cell::from),
        Cell::from(orbit.computed_in.to_string()),
        Cell::from(complete),
        Cell::Empty,
        Cell::Empty,
    ]
}

/// The search for 1-1 motions, piece by piece.
fn explain(scene: &Scene) -> Result<String, Failure> {
    let motion = scene.setting()?.motion::<Interval<f64>>()?;
    let mut lines = Vec::new();
    for word in scene.words()? {
        if !is_covered(&motion, &word) {
            lines.push(format!(
                "{word}: Newton's method from many starts, each motion proved by itself; no list of pieces\n"
            ));
            continue;
        }
        for periods in 1..=scene.max_periods()? {
            lines.extend(told(&isolate_one_one(&motion, periods, &scene.options()?)));
        }
    }
    Ok(lines.join("\n"))
}

fn told(search: &OneOneSearch) -> Vec<String> {
    let total = 2 * search.periods;
    let Isolation {
        roots,
        decided,
        undecided,
    } = &search.isolation;
    let mut lines =
        vec![
        format!("BT over {} forcing periods: T_1 in (0, {total}), psi in a turn", search.periods),
        "psi is the phase of the forcing halfway through the flight from bottom to top; h_1, h_2 are the two equations"
            .to_string(),
        "that (9) to (13) leave when the velocities are eliminated".to_string(),
        format!(
            "proposed by Brent's method on the curve of 1-1 motions, and proved: {}; proved on the way: {}",
            search.proposed,
            roots.len() - search.proposed
        ),
    ];
    for (index, root) in roots.iter().enumerate() {
        let [t_1, psi] = root.enclosure.map(|side| side.midpoint());
        let [near, around] = root.unique.map(|side| side.radius());
        let fate = if search.motions.contains(root) {
            "a motion"
        } else {
            "no motion: a velocity points away from its wall, or it is another one a turn on"
        };
        lines.push(format!(
            "  root {}: T_1 = {t_1:.12}, psi = {psi:.12}, the only one within {near:.1e} and {around:.1e}; {fate}",
            index + 1
        ));
    }
    lines.push(format!(
        "{} pieces examined; what Krawczyk's operator cut off a piece holds no motion, and is not listed:",
        decided.len()
    ));
    lines.push(format!("  {:<24}{:<24}decided", "T_1", "psi"));
    for ([t_1, psi], decision) in decided {
        let span = |side: &Interval<f64>| format!("[{:.6}, {:.6}]", side.low(), side.high());
        lines.push(format!("  {:<24}{:<24}{decision}", span(t_1), span(psi)));
    }
    lines.push(match undecided.len() {
        0 => format!("complete: {} motions, and no others\n", search.motions.len()),
        open => format!("{open} pieces stay undecided in f64 and go to a wider number\n"),
    });
    lines
}
