//! `vibro-audit trajectory SCENE [--samples N] [--until T | --impacts N]`.

use super::rows::Rows;
use super::simulate::DIGITS;
use super::{Answer, Content, Exit, Failure, Options, SceneArguments, note};
use crate::impact::{self, Event, Extent, Origin, Row, Snapshot, Trajectory, rows};
use crate::model::{MotionError, Scales};
use crate::number::{FIGURES_OF_F64, Rung};
use crate::report::{Cell, Column, Table};
use crate::scene::{Scene, Setting, Start, Want};
use std::cell::RefCell;
use std::f64::consts::{PI, TAU};
use std::rc::Rc;
use std::str::FromStr;

/// The samples where none are named.
const SAMPLES: u32 = 1001;
/// The paper's t_final: "the codes are run again with t_final = 10".
pub const UNTIL: f64 = 10.0;

/// Print position and velocity between impacts at evenly spaced times
///
/// z is capsule minus ball, and zdot its rate: z = d/2 at the bottom, -d/2 at the top. capsule is the middle of the
/// capsule and ball = capsule - z the ball, in the frame in which the capsule swings about 0; the columns in SI follow,
/// empty where [device] does not give the units. energy is zdot²/2 - g z, that of the ball against the capsule, and
/// ball_energy its energy in the frame at rest. At an impact the velocity is that before it.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit trajectory fig02 --until 4 --samples 401 --format csv")]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Number of time points, both ends counted
    #[arg(long, value_name = "N", default_value_t = SAMPLES, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    samples: u32,
    /// The last time; the forcing has period 2 [default: 10, as in the paper]
    #[arg(long, value_name = "T", conflicts_with = "impacts")]
    until: Option<Duration>,
    /// End at impact N; the start is number 1
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    impacts: Option<u32>,
}

/// Where the samples end.
#[derive(Clone, Copy, Debug)]
enum End {
    Time(f64),
    /// The time of this impact, from 1.
    Impact(u32),
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

/// The columns that scripts rely on, then the same in SI, then energies over the mass of the ball, without
/// unit, and the digits of the event before.
const COLUMNS: [&str; 14] = [
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
    "energy",
    "ball_energy",
    "digits",
];

/// Runs the command.
pub fn run(arguments: &Arguments, options: &Options) -> Result<Answer, Failure> {
    let scene = arguments.scene.load_for(&[Want::Trajectory])?;
    let until = arguments.until.map_or(UNTIL, |Duration(time)| time);
    let end = arguments.impacts.map_or(End::Time(until), End::Impact);
    Ok(Answer {
        content: Content::Rows(sampled(&scene, options, end, arguments.samples)?),
        exit: Exit::AsExpected,
    })
}

/// The table of a scene, as far and as fine as without options.
pub fn table(scene: &Scene, options: &Options) -> Result<Table, Failure> {
    sampled(scene, options, End::Time(UNTIL), SAMPLES)?.table()
}

fn sampled(scene: &Scene, options: &Options, end: End, samples: u32) -> Result<Rows, Failure> {
    let until = match end {
        End::Time(time) => time,
        End::Impact(count) => time_of_impact(scene, options, count)?,
    };
    if options.digits.is_some_and(|digits| digits > FIGURES_OF_F64) {
        note(&format!(
            "samples are f64, of {FIGURES_OF_F64} digits at most; `simulate` tells the events in more"
        ));
    }
    let motion = scene.motion::<f64>()?;
    let g = *motion.g();
    let units = units(scene);
    // one event beyond the end is looked at
    let mut events = events(scene, options, u64::MAX, until)?;
    let latest = Rc::new(RefCell::new(Latest::default()));
    let seen = Rc::clone(&latest);
    let start: impact::Start<f64> = scene.start()?.start();
    let phase = start.phase.rem_euclid(TAU);
    let mut first = start.position.map(|_| phase);
    let told = std::iter::from_fn(move || {
        let told = events.next();
        let mut latest = seen.borrow_mut();
        latest.lost_at = events.known().lost_at;
        match told? {
            Ok(row) => {
                latest.push((row.time, row.digits));
                Some(event(&row, *first.get_or_insert(row.phase)))
            }
            Err(error) => {
                latest.failure = Some(error);
                None
            }
        }
    });
    let mut trajectory = match start.position {
        None => Trajectory::new(motion, told),
        Some(position) => Trajectory::in_flight(motion, phase, position, start.velocity, told),
    };
    let mut index = 0;
    let rows = std::iter::from_fn(move || {
        if index == samples {
            latest.borrow().say();
            index += 1;
        }
        if index > samples {
            return None;
        }
        let time = sample(index, samples, until);
        index += 1;
        let Some(snapshot) = trajectory.at(&time) else {
            index = samples + 1;
            let mut latest = latest.borrow_mut();
            note(&format!(
                "rounding hides what happens at time {}; what follows is not known",
                latest.time()
            ));
            return latest.failure.take().map(|error| Err(Failure::from(error)));
        };
        let mut cells = row(&snapshot, units, g);
        cells.push(Cell::from(latest.borrow().digits_before(time)));
        Some(Ok(cells))
    });
    Ok(Rows::new(COLUMNS.map(Column::from).to_vec(), rows))
}

/// The latest events that a trajectory has asked for: it looks one ahead of its time.
#[derive(Debug, Default)]
struct Latest {
    /// Times and digits.
    events: [Option<(f64, u32)>; 3],
    lost_at: Option<u64>,
    failure: Option<MotionError>,
}

impl Latest {
    fn push(&mut self, event: (f64, u32)) {
        self.events.rotate_left(1);
        self.events[2] = Some(event);
    }

    fn time(&self) -> f64 {
        self.events[2].map_or(0.0, |(time, _)| time)
    }

    /// The digits of the last event before a time, or of the first.
    fn digits_before(&self, time: f64) -> Option<i64> {
        let events = || self.events.iter().flatten();
        let before = events().rfind(|event| event.0 < time).or(events().next());
        before.map(|(_, digits)| i64::from(*digits))
    }

    fn say(&self) {
        if let Some(event) = self.lost_at {
            note(&format!(
                "from event {event} on no digit holds: what follows tells how such a motion goes on, not how this one does"
            ));
        }
    }
}

/// The events up to a number of impacts and a time, in numbers wide enough for them.
fn events(
    scene: &Scene,
    options: &Options,
    impacts: u64,
    until: f64,
) -> Result<impact::Rows<Setting, Start, f64>, Failure> {
    let asked = options.asked_of(scene)?;
    let digits = asked.map_or(DIGITS, |digits| digits.min(FIGURES_OF_F64));
    let first = Rung::reaching(digits);
    let extent = Extent {
        impacts,
        until,
        digits,
        proved: false,
    };
    Ok(rows(scene.setting()?, scene.start()?, &extent, first)?)
}

/// The time of an impact, the start counted as the first, or of the last event before it.
fn time_of_impact(scene: &Scene, options: &Options, impact: u32) -> Result<f64, Failure> {
    let told = events(scene, options, u64::from(impact), f64::INFINITY)?.last(1)?;
    if told.known.has_ended {
        note(&format!(
            "there are not {impact} impacts: the last row is at the last event"
        ));
    }
    Ok(told.rows.back().map_or(0.0, |row| row.time))
}

/// An event with its turn of the forcing, counted from that of the start, of phase `first`.
fn event(row: &Row<f64>, first: f64) -> Event<f64> {
    Event {
        kind: row.kind,
        side: row.side,
        turns: ((row.time - (row.phase - first) / PI) / 2.0).round() as i64,
        phase: row.phase,
        velocity: row.velocity,
    }
}

/// The units of time, Z, Zdot, X and x; none where the device does not give them.
fn units(scene: &Scene) -> Option<[f64; 5]> {
    let scales = scene.scales::<f64>();
    if let Err(error) = &scales {
        note(&format!("the columns in SI are empty: {error}"));
    }
    let Scales {
        length, velocity, time, ..
    } = scales.ok()?;
    Some([time, length, velocity, length, length])
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

fn row(snapshot: &Snapshot<f64>, units: Option<[f64; 5]>, g: f64) -> Vec<Cell> {
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
    // Xdot is F_1, of zero mean in this frame
    let falling = phase.sin() / PI - zdot;
    let energies = [0.5 * zdot * zdot - g * z, 0.5 * falling * falling + g * ball];
    cells.extend(energies.map(Cell::from));
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
