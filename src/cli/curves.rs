//! `vibro-audit branch SCENE` over the two parameters of `[branch]`: curves of bifurcations.

use super::complete::incomplete;
use super::rows::Rows;
use super::{Asked, Failure, Options, note};
use crate::number::Interval;
use crate::orbit::{
    BifurcationKind, CurvePoint, OneOneCurves, OrbitOptions, Output, ParameterPlane, Word, WordCurves, is_covered,
};
use crate::report::{Cell, Column};
use crate::scene::{Over, Plane, Scene};

/// The columns of the command that scripts rely on; where something other than d is swept, its name stands before d.
pub(super) const COLUMNS: [&str; 15] = [
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
pub(super) const GAP: usize = 3;

/// The columns behind those of a sweep.
const MORE: [&str; 3] = ["curve", "point", "joined"];

/// A box of (T_1, psi, x, y) in which there may be bifurcations.
type Open = (BifurcationKind, [Interval<f64>; 4]);

/// Rows that belong together.
enum Group {
    Undecided(u32, Vec<Open>),
    Curve(Vec<CurvePoint>),
}

/// A row for each point of each curve, as they are made.
pub(super) fn rows(scene: &Scene, options: &Options) -> Result<Rows, Failure> {
    let (plane, searched) = (scene.plane()?, scene.options()?);
    let is_double = match options.goal_for(scene)? {
        Asked::Doubles(goal) => goal.is_double(),
        Asked::Decimals(goal) => goal.is_double(),
    };
    if !is_double {
        note("curves of bifurcations are located in f64");
    }
    let overs = [plane.x.over, plane.y.over];
    let mut columns = COLUMNS.to_vec();
    columns.splice(
        GAP..GAP,
        overs.into_iter().filter(|over| *over != Over::D).map(Over::name),
    );
    columns.extend(MORE);
    let count = columns.len();
    let kinds = scene.words_and_periods()?;
    let groups = kinds
        .into_iter()
        .flat_map(move |(word, periods)| groups(&plane, &word, periods, &searched));
    let mut number = 0;
    let rows = groups.flat_map(move |group| -> Vec<Result<Vec<Cell>, Failure>> {
        match group {
            Err(failure) => vec![Err(failure)],
            Ok(Group::Undecided(periods, open)) => {
                let rows = open.iter().map(|open| Ok(undecided(count, periods, open)));
                rows.collect()
            }
            Ok(Group::Curve(points)) => {
                number += 1;
                points
                    .into_iter()
                    .map(|found| Ok(point(overs, number, found)))
                    .collect()
            }
        }
    });
    Ok(Rows::new(columns.into_iter().map(Column::from).collect(), rows))
}

/// What is open of motions of so many periods, then each curve of them.
fn groups(
    plane: &Plane,
    word: &Word,
    periods: u32,
    options: &OrbitOptions,
) -> Box<dyn Iterator<Item = Result<Group, Failure>>> {
    let is_of_pairs = match are_of_pairs(plane, word) {
        Ok(is_of_pairs) => is_of_pairs,
        Err(failure) => return Box::new(std::iter::once(Err(failure))),
    };
    if !is_of_pairs {
        note(&format!(
            "{word} over {periods} forcing periods: curves from bifurcations on branches that many starts lead to; there \
             may be more"
        ));
        return match WordCurves::new(plane.clone(), word, periods, plane.lines, options) {
            Ok(curves) => Box::new(curves.map(Group::Curve).map(Ok)),
            Err(failure) => Box::new(std::iter::once(Err(failure.into()))),
        };
    }
    let curves = match OneOneCurves::new(plane.clone(), periods, plane.lines, options) {
        Ok(curves) => curves,
        Err(failure) => return Box::new(std::iter::once(Err(failure.into()))),
    };
    let open = curves.undecided().to_vec();
    for (kind, [_, _, x, y]) in &open {
        note(&format!(
            "BT over {periods} forcing periods: undecided whether there is a {kind} at {x}, {y}"
        ));
    }
    let first = std::iter::once(Group::Undecided(periods, open));
    Box::new(first.chain(curves.map(Group::Curve)).map(Ok))
}

/// Returns true if motions of a word over a plane are those of which all bifurcations on a line are found.
fn are_of_pairs(plane: &Plane, word: &Word) -> Result<bool, Failure> {
    let middle = plane.ranges().map(|range| Interval::point(range.midpoint()));
    Ok(is_covered(&plane.motion_at(middle.each_ref())?, word))
}

/// The curves of a word over so many periods, one after the other.
pub(super) fn curves(
    plane: &Plane,
    word: &Word,
    periods: u32,
    options: &OrbitOptions,
) -> Result<Box<dyn Iterator<Item = Vec<CurvePoint>>>, Failure> {
    Ok(match are_of_pairs(plane, word)? {
        true => Box::new(OneOneCurves::new(plane.clone(), periods, plane.lines, options)?),
        false => Box::new(WordCurves::new(plane.clone(), word, periods, plane.lines, options)?),
    })
}

fn undecided(count: usize, periods: u32, (_, place): &Open) -> Vec<Cell> {
    let mut row = vec![
        Cell::from("undecided"),
        Cell::from(Word::pair().to_string()),
        Cell::from(i64::from(periods)),
    ];
    let [complete, low, high] = incomplete(place);
    row.resize(count - MORE.len() - 3, Cell::Empty);
    row.extend([complete, low, high]);
    row.resize(count, Cell::Empty);
    row
}

fn point(overs: [Over; 2], curve: i64, found: CurvePoint) -> Vec<Cell> {
    let CurvePoint {
        special,
        motion,
        y,
        has_clearance,
        is_joined,
    } = found;
    let or_empty = |cell: Cell| if has_clearance { cell } else { Cell::Empty };
    let mut row = vec![
        Cell::from(motion.kind.to_string()),
        Cell::from(motion.word.to_string()),
        Cell::from(i64::from(motion.periods)),
    ];
    let parameters = overs.into_iter().zip([motion.parameter, y]);
    row.extend(
        parameters
            .filter(|(over, _)| *over != Over::D)
            .map(|(_, value)| Cell::from(value)),
    );
    row.extend([
        Cell::from(motion.d),
        Cell::from(motion.phases),
        Cell::from(motion.velocities),
        Cell::from(motion.times),
        Cell::from(motion.trace),
        or_empty(Cell::from(motion.clearance)),
        or_empty(Cell::from(motion.admissible)),
        motion.error_bound.map_or(Cell::Empty, Cell::from),
        Cell::from(motion.computed_in.to_string()),
        // between the lines that were searched there may be others
        Cell::from(false),
        Cell::Empty,
        Cell::Empty,
        Cell::from(curve),
        Cell::from(special.to_string()),
        is_joined.map_or(Cell::Empty, Cell::from),
    ]);
    row
}
