//! `vibro-audit simulate SCENE [--impacts N] [--until T] [--last N]`.

use super::{Answer, Content, Exit, Failure, Options, SceneArguments, note};
use crate::accuracy::{Purpose, cheapest};
use crate::impact::{Extent, History, Kind, history, history_in_decimals};
use crate::number::{Decimals, FIGURES_OF_F64, Rung};
use crate::report::{Cell, Table};
use crate::scene::{Scene, Want};

/// The events of the motion from the start on: impacts, rest and release
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// At most so many impacts, the start counted [default: 100, or no limit with --until]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    impacts: Option<u64>,
    /// The events up to this time; the period of the forcing is 2
    #[arg(long, value_name = "T", value_parser = time, allow_negative_numbers = true)]
    until: Option<f64>,
    /// Only the last so many events
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    last: Option<u64>,
}

/// The columns that scripts rely on.
const COLUMNS: [&str; 8] = ["event", "time", "phase", "side", "velocity", "kind", "digits", "number"];

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
    let extent = Extent {
        impacts,
        until: arguments.until.unwrap_or(f64::INFINITY),
        last: arguments
            .last
            .map_or(usize::MAX, |last| usize::try_from(last).unwrap_or(usize::MAX)),
        digits: 0,
    };
    Ok(Answer {
        content: Content::Table(told(&scene, options, &extent)?),
        exit: Exit::AsExpected,
    })
}

/// The table of a scene, as many impacts as where nothing limits them.
pub fn table(scene: &Scene, options: &Options) -> Result<Table, Failure> {
    let extent = Extent {
        impacts: IMPACTS,
        until: f64::INFINITY,
        last: usize::MAX,
        digits: 0,
    };
    told(scene, options, &extent)
}

fn told(scene: &Scene, options: &Options, extent: &Extent) -> Result<Table, Failure> {
    let digits = options.asked_of(scene)?.unwrap_or(DIGITS);
    let extent = Extent { digits, ..*extent };
    let (setting, start) = (scene.setting()?, scene.start()?);
    let first = cheapest(Purpose::Impact, digits)?;
    if digits <= FIGURES_OF_F64 {
        listed(&history(&setting, &start, &extent, first)?)
    } else {
        let decimals = Decimals(digits as usize);
        listed(&history_in_decimals(&setting, &start, &extent, decimals, first)?)
    }
}

fn listed<N: Clone>(history: &History<N>) -> Result<Table, Failure>
where
    Cell: From<N>,
{
    let mut table = Table::new(COLUMNS);
    for row in &history.rows {
        table.push(vec![
            Cell::Integer(i64::try_from(row.event).unwrap_or(i64::MAX)),
            Cell::from(row.time.clone()),
            Cell::from(row.phase.clone()),
            Cell::Text(row.side.to_string()),
            Cell::from(row.velocity.clone()),
            Cell::Text(row.kind.to_string()),
            Cell::Integer(i64::from(row.digits)),
            // what no digit of holds was followed on in f64
            Cell::Text(
                if row.digits == 0 {
                    Rung::Double
                } else {
                    history.computed_in
                }
                .to_string(),
            ),
        ])?;
    }
    let is_undecided = history.rows.back().is_some_and(|row| row.kind == Kind::Undecided);
    if is_undecided {
        note(&format!(
            "rounding hides whether the ball touches at the last event, computed in {}",
            history.computed_in
        ));
    } else if let Some(event) = history.lost_at {
        note(&format!(
            "from event {event} on no digit holds, computed in {}: what follows tells how such a motion goes \
             on, not how this one does; Lyapunov exponent {:.3} per unit of time",
            history.computed_in, history.lyapunov
        ));
    }
    if history.has_ended {
        note("nothing follows the last event, or no impact of 1e-6 and above");
    }
    Ok(table)
}

fn time(text: &str) -> Result<f64, String> {
    let time: f64 = text.parse().map_err(|_| "a number".to_string())?;
    if time >= 0.0 && time.is_finite() {
        Ok(time)
    } else {
        Err("a finite number, at least 0".to_string())
    }
}
