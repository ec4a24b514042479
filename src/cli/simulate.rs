//! `vibro-audit simulate SCENE [--impacts N] [--until T] [--last N]`.

use super::rows::Rows;
use super::{Answer, Content, Exit, Failure, Options, SceneArguments, note};
use crate::impact::{self, Extent, Kind, Known, Row, rows, rows_in_decimals};
use crate::model::{MotionError, Parameters};
use crate::number::{FIGURES_OF_F64, Rung, Told};
use crate::report::{Cell, Column, Table};
use crate::scene::{Scene, Want};

/// Compute the impacts of one motion, with rest and release
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit simulate fig03 --impacts 1000 --last 10")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Stop after N impacts; the start is number 1 [default: 100, or no limit with --until]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    impacts: Option<u64>,
    /// Simulate up to time T; the period of the forcing is 2
    #[arg(long, value_name = "T", value_parser = time, allow_negative_numbers = true)]
    until: Option<f64>,
    /// Print only the last N events
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    last: Option<u32>,
    /// Bound the errors of each event with proof; stop where they can no longer be bounded
    #[arg(long)]
    proved: bool,
}

/// The columns that scripts rely on.
const COLUMNS: [&str; 8] = ["event", "time", "phase", "side", "velocity", "kind", "digits", "number"];

/// Those that `--proved` adds: upper bounds of how far the printed numbers are from the exact ones.
const BOUNDS: [&str; 3] = ["time_error_bound", "phase_error_bound", "velocity_error_bound"];

/// The impacts that are told where nothing limits them.
const IMPACTS: u64 = 100;

/// The digits that every event has where none are asked for.
pub const DIGITS: u32 = 6;

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let scene = arguments.scene.load_for(&[Want::Impacts])?;
    let impacts = match (arguments.impacts, arguments.until) {
        (Some(impacts), _) => impacts,
        (None, Some(_)) => u64::MAX,
        (None, None) => IMPACTS,
    };
    let asked = Extent {
        impacts,
        until: arguments.until.unwrap_or(f64::INFINITY),
        digits: options.asked_of(&scene)?.unwrap_or(DIGITS),
        proved: arguments.proved,
    };
    Ok(Answer {
        content: Content::Rows(told(&scene, &asked, arguments.last)?),
        exit: Exit::AsExpected,
    })
}

/// The table of a scene, as many impacts as where nothing limits them.
pub fn table(scene: &Scene, options: &Options) -> Result<Table, Failure> {
    let asked = Extent {
        impacts: IMPACTS,
        until: f64::INFINITY,
        digits: options.asked_of(scene)?.unwrap_or(DIGITS),
        proved: false,
    };
    told(scene, &asked, None)?.table()
}

fn told(scene: &Scene, asked: &Extent, last: Option<u32>) -> Result<Rows, Failure> {
    let (setting, start) = (scene.setting()?, scene.start()?);
    let first = Rung::reaching(asked.digits);
    if asked.digits <= FIGURES_OF_F64 {
        listed(rows(setting, start, asked, first)?, asked, last)
    } else {
        listed(rows_in_decimals(setting, start, asked, first)?, asked, last)
    }
}

fn listed<P, O, N>(mut told: impact::Rows<P, O, N>, asked: &Extent, last: Option<u32>) -> Result<Rows, Failure>
where
    P: Parameters + 'static,
    O: impact::Origin + 'static,
    N: Told + 'static,
    Cell: From<N>,
{
    let proved = asked.proved;
    let added = if proved { &BOUNDS[..] } else { &[] };
    let columns = COLUMNS.iter().chain(added).map(|name| Column::from(*name)).collect();
    if let Some(last) = last {
        let history = told.last(last as usize)?;
        say(&history.known, history.rows.back().map(|row| row.kind), proved);
        return Ok(Rows::new(columns, history.rows.into_iter().map(|row| Ok(cells(row)))));
    }
    let (mut latest, mut is_over) = (None, false);
    let row = move || -> Option<Result<Row<N>, MotionError>> {
        let row = told.next();
        match &row {
            Some(Ok(row)) => latest = Some(row.kind),
            // a closed iterator may be asked again
            None if !std::mem::replace(&mut is_over, true) => say(told.known(), latest, proved),
            _ => {}
        }
        row
    };
    Ok(Rows::new(columns, std::iter::from_fn(row).map(|row| Ok(cells(row?)))))
}

fn cells<N>(row: Row<N>) -> Vec<Cell>
where
    Cell: From<N>,
{
    let mut cells = vec![
        Cell::Integer(i64::try_from(row.event).unwrap_or(i64::MAX)),
        Cell::from(row.time),
        Cell::from(row.phase),
        Cell::Text(row.side.to_string()),
        Cell::from(row.velocity),
        Cell::Text(row.kind.to_string()),
        Cell::Integer(i64::from(row.digits)),
        Cell::Text(row.number.to_string()),
    ];
    cells.extend(row.bounds.into_iter().flatten().map(Cell::from));
    cells
}

/// What is to be said after the last row.
fn say(known: &Known, latest: Option<Kind>, proved: bool) {
    if proved && latest == Some(Kind::Undecided) {
        return note(&format!(
            "what follows is not proved: up to the time of the last row nothing else happens, beyond it enclosures in {} \
             are too wide, or the flight lasts too long to be followed",
            known.number
        ));
    }
    if latest == Some(Kind::Undecided) {
        note(&format!(
            "rounding hides whether the ball touches at the last event, computed in {}, or its flight lasts too long to be \
             followed",
            known.number
        ));
    } else if let Some(event) = known.lost_at {
        note(&format!(
            "from event {event} on no digit holds, computed in {}: what follows tells how such a motion goes \
             on, not how this one does; Lyapunov exponent {:.3} per unit of time",
            known.number, known.lyapunov
        ));
    }
    if known.has_ended && latest != Some(Kind::Undecided) {
        note("nothing follows the last event, or no impact of 1e-6 and above");
    }
}

fn time(text: &str) -> Result<f64, String> {
    let time: f64 = text
        .parse()
        .map_err(|_| "write a number; the forcing has period 2, so that 100 periods are 200".to_string())?;
    if time >= 0.0 && time.is_finite() {
        Ok(time)
    } else {
        Err("a finite number, at least 0".to_string())
    }
}
