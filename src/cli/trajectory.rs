//! `vibro-audit trajectory SCENE [--samples N] [--until T | --impacts N]`.

use super::{Answer, Content, Exit, Failure, Options, SceneArguments, note};
use crate::impact::{Event, Kind, Simulation, Snapshot, Start, Trajectory};
use crate::model::Side;
use crate::report::{Cell, Table};
use crate::scene::{Scene, Want};
use std::str::FromStr;

/// The samples where none are named.
const SAMPLES: u32 = 1001;
/// The paper's t_final: "the codes are run again with t_final = 10".
const UNTIL: f64 = 10.0;

/// The motion between the impacts, at evenly spaced times, without unit and in SI
///
/// z and zdot are the ball's against the capsule: z = d/2 at the bottom, -d/2 at the top. capsule is the middle of the
/// capsule and ball = capsule - z the ball, in the frame in which the capsule swings about 0; the columns in SI follow,
/// empty where [device] does not give the units. At an impact the velocity is that before it.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// How many times, both ends counted
    #[arg(long, value_name = "N", default_value_t = SAMPLES, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    samples: u32,
    /// The last time; the forcing period is 2. The default is the paper's t_final [default: 10]
    #[arg(long, value_name = "T", conflicts_with = "impacts")]
    until: Option<Duration>,
    /// The last time is that of this impact, the start counted as the first
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    impacts: Option<u32>,
}

/// A time that can be waited for.
#[derive(Clone, Copy, Debug)]
struct Duration(f64);

impl FromStr for Duration {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let time = text.parse().ok().filter(|&time: &f64| time > 0.0 && time.is_finite());
        time.map(Self).ok_or("a finite number above 0 is needed")
    }
}

/// The columns that scripts rely on, then the same in SI.
const COLUMNS: [&str; 11] = [
    "time",
    "phase",
    "z",
    "zdot",
    "capsule",
    "ball",
    "time_s",
    "z_m",
    "zdot_m_s",
    "capsule_m",
    "ball_m",
];

/// Runs the command.
pub fn run(arguments: &Arguments, _: &Options) -> Result<Answer, Failure> {
    let scene = arguments.scene.load_for(&[Want::Trajectory])?;
    let until = match arguments.impacts {
        Some(count) => time_of_impact(&scene, count)?,
        None => arguments.until.map_or(UNTIL, |Duration(time)| time),
    };
    Ok(Answer {
        content: Content::Table(sampled(&scene, until, arguments.samples)?),
        exit: Exit::AsExpected,
    })
}

/// The table of a scene, as far and as fine as without options.
pub fn table(scene: &Scene, _: &Options) -> Result<Table, Failure> {
    sampled(scene, UNTIL, SAMPLES)
}

fn simulation(scene: &Scene) -> Result<Simulation<f64>, Failure> {
    let start = scene.start()?;
    let start = Start {
        side: Side::Bottom,
        phase: start.phase.value(),
        velocity: start.velocity.value(),
    };
    Ok(Simulation::new(&scene.motion::<f64>()?, &start))
}

/// The time of an impact, counted from 1; that of the last event where there are not so many.
fn time_of_impact(scene: &Scene, count: u32) -> Result<f64, Failure> {
    let mut events = simulation(scene)?;
    let Some(first) = events.next() else { return Ok(0.0) };
    let (mut last, mut left) = (first.clone(), count - 1);
    while left > 0 {
        let Some(event) = events.next() else {
            note(&format!(
                "there are {} impacts, not {count}: the last row is at the last event",
                count - left
            ));
            break;
        };
        left -= u32::from(event.kind == Kind::Impact);
        last = event;
    }
    Ok(last.time(&first.phase))
}

fn sampled(scene: &Scene, until: f64, samples: u32) -> Result<Table, Failure> {
    let scales = scene.scales::<f64>();
    if let Err(error) = &scales {
        note(&format!("the columns in SI are empty: {error}"));
    }
    let units = scales.ok().map(|scales| {
        let (length, velocity, time) = (scales.length, scales.velocity, scales.time);
        [time, length, velocity, length, length]
    });
    let mut undecided: Option<Event<f64>> = None;
    let events = simulation(scene)?.inspect(|event| {
        if event.kind == Kind::Undecided {
            undecided = Some(event.clone());
        }
    });
    let mut trajectory = Trajectory::new(scene.motion()?, events);
    let mut table = Table::new(COLUMNS);
    for index in 0..samples {
        let Some(snapshot) = trajectory.at(&sample(index, samples, until)) else {
            break;
        };
        table.push(row(&snapshot, units))?;
    }
    drop(trajectory);
    if let Some(event) = undecided {
        let Event { side, phase, turns, .. } = event;
        note(&format!(
            "rounding hides whether the ball touches the {side} at phase {phase} of turn {turns}: what follows is not known"
        ));
    }
    Ok(table)
}

/// The time of a sample; the last is `until` to every digit.
fn sample(index: u32, samples: u32, until: f64) -> f64 {
    if samples < 2 {
        return 0.0;
    }
    let steps = f64::from(samples - 1);
    if index == samples - 1 {
        until
    } else {
        until * (f64::from(index) / steps)
    }
}

fn row(snapshot: &Snapshot<f64>, units: Option<[f64; 5]>) -> Vec<Cell> {
    let Snapshot {
        time,
        phase,
        z,
        zdot,
        capsule,
        ball,
    } = *snapshot;
    let mut cells: Vec<Cell> = [time, phase, z, zdot, capsule, ball].map(Cell::from).into();
    let of_unit =
        |index: usize, value: f64| Cell::from(units.and_then(|units| units.get(index).map(|unit| unit * value)));
    let values = [time, z, zdot, capsule, ball].into_iter().enumerate();
    cells.extend(values.map(|(index, value)| of_unit(index, value)));
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_reach_from_end_to_end() {
        let times: Vec<f64> = (0..5).map(|index| sample(index, 5, 10.0)).collect();
        assert_eq!(times, [0.0, 2.5, 5.0, 7.5, 10.0]);
        let until = 0.1 + 0.7;
        assert_eq!(sample(6, 7, until), until);
        assert_eq!(sample(0, 1, until), 0.0);
    }

    #[test]
    fn a_time_that_cannot_be_waited_for_is_refused() {
        for text in ["0", "-1", "NaN", "inf", "ten", ""] {
            assert!(text.parse::<Duration>().is_err(), "{text}");
        }
    }
}
