//! What one motion shows: its phase portrait, capsule and ball.

use super::super::Failure;
use super::claims::Claims;
use crate::impact::{Event, Kind, Simulation, Snapshot, Start, Trajectory};
use crate::model::{Motion, Side};
use crate::report::figure::{Path, Portrait, displacement};
use crate::report::plot::{Panel, Point};
use crate::scene::Scene;

/// The paper's t_final: "the codes are run again with t_final = 10".
const UNTIL: f64 = 10.0;

/// Times between two events: enough for a smooth line.
const BETWEEN: u32 = 60;

/// Events of a chatter that are drawn, at most.
const MOST_EVENTS: usize = 2000;

/// The two panels of a motion from its start on.
///
/// # Errors
/// What the motion requires and the scene lacks.
pub(super) fn panels(scene: &Scene, claims: &Claims) -> Result<[Panel; 2], Failure> {
    let motion = scene.motion::<f64>()?;
    let start = scene.start()?;
    let start = Start {
        side: Side::Bottom,
        phase: start.phase.value(),
        velocity: start.velocity.value(),
    };
    let events: Vec<Event<f64>> = Simulation::new(&motion, &start).take(MOST_EVENTS).collect();
    let course = Drawn::new(&motion, &events);
    let portrait = Portrait {
        gap: *motion.d(),
        flights: course.flights,
        impacts: course.jumps,
    };
    Ok([
        portrait.panel(&claims.at(scene)),
        displacement(&course.path, *motion.d(), &course.impacts),
    ])
}

/// The lines of a motion.
#[derive(Default)]
struct Drawn {
    path: Path,
    flights: Vec<Vec<Point>>,
    /// Z, and Zdot before and after.
    jumps: Vec<(f64, f64, f64)>,
    /// Time and place of the ball.
    impacts: Vec<Point>,
}

impl Drawn {
    /// From event to event, each of them met; to the last time.
    fn new(motion: &Motion<f64>, events: &[Event<f64>]) -> Self {
        let mut drawn = Self::default();
        let Some(first) = events.first() else { return drawn };
        let mut trajectory = Trajectory::new(motion.clone(), events.iter().cloned());
        let mut times: Vec<f64> = events.iter().map(|event| event.time(&first.phase)).collect();
        times.retain(|time| *time < UNTIL);
        times.push(UNTIL);
        let mut launch: Option<Point> = None;
        for (index, pair) in times.windows(2).enumerate() {
            let Some(event) = events.get(index) else { break };
            let Some(here) = trajectory.at(&pair[0]) else { break };
            if index == 0 {
                drawn.sample(&here);
            }
            let wall = event.side.sign() * motion.d() / 2.0;
            if event.kind == Kind::Impact {
                let after = -motion.restitution(event.side) * event.velocity;
                drawn.jumps.push((wall, event.velocity, after));
                drawn.impacts.push((here.time, here.capsule - wall));
                launch = Some((wall, after));
            }
            let mut flight: Vec<Point> = launch.take().into_iter().collect();
            for step in 1..=BETWEEN {
                let part = f64::from(step) / f64::from(BETWEEN);
                let time = if step == BETWEEN {
                    pair[1]
                } else {
                    pair[0] + part * (pair[1] - pair[0])
                };
                let Some(snapshot) = trajectory.at(&time) else { break };
                flight.push((snapshot.z, snapshot.zdot));
                drawn.sample(&snapshot);
            }
            drawn.flights.push(flight);
        }
        drawn
    }

    fn sample(&mut self, snapshot: &Snapshot<f64>) {
        let Path {
            times, capsule, ball, ..
        } = &mut self.path;
        times.push(snapshot.time);
        capsule.push(snapshot.capsule);
        ball.push(snapshot.ball);
    }
}
