//! What one motion shows: its phase portrait, capsule and ball.

use super::super::Failure;
use super::super::trajectory::UNTIL;
use super::claims::Claims;
use crate::impact::{Event, Kind, Origin, Snapshot, Trajectory, Widening};
use crate::model::Motion;
use crate::report::figure::{Path, Portrait, displacement};
use crate::report::plot::{Panel, Point};
use crate::scene::Scene;

/// Times between two events: enough for a smooth line.
const BETWEEN: u32 = 60;

/// Events that are drawn, at most: where there are more, the lines end at the last of these.
const MOST_EVENTS: usize = 5000;

/// The two panels of a motion from its start on.
///
/// # Errors
/// What the motion requires and the scene lacks.
pub(super) fn panels(scene: &Scene, claims: &Claims) -> Result<[Panel; 2], Failure> {
    let (motion, events) = followed(scene)?;
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

/// The motion, and its events up to the first one after the last time.
fn followed(scene: &Scene) -> Result<(Motion<f64>, Vec<Event<f64>>), Failure> {
    let motion = scene.motion::<f64>()?;
    let start = scene.start()?.start();
    let mut events: Vec<Event<f64>> = Vec::new();
    for event in Widening::new(&motion, &start).take(MOST_EVENTS) {
        let time = events.first().map_or(0.0, |first| event.time(&first.phase));
        events.push(event);
        if time > UNTIL {
            break;
        }
    }
    Ok((motion, events))
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
        if times.len() < MOST_EVENTS {
            times.push(UNTIL);
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;

    /// The lines of a built-in scene with overrides.
    fn drawn(name: &str, sets: &[&str]) -> (f64, Drawn) {
        let mut scene = Scene::read(scene::find(name).unwrap(), name).unwrap();
        sets.iter().for_each(|set| scene.set(set).unwrap());
        let (motion, events) = followed(&scene).unwrap();
        (*motion.d(), Drawn::new(&motion, &events))
    }

    #[test]
    fn the_ball_stays_between_the_walls_and_leaves_each_with_its_restitution() {
        for sets in [
            &[][..],
            &["motion.d=0.18"],
            &["motion.d=0.0005"],
            &["motion.r_b=1", "motion.r_t=1"],
        ] {
            let (d, drawn) = drawn("fig12", sets);
            let places = || drawn.flights.iter().flatten().map(|point| point.0);
            assert!(places().all(|z| z.abs() <= 0.5 * d + 1e-12), "{sets:?}");
            assert!(drawn.jumps.len() > 5 && drawn.jumps.iter().all(|(z, before, _)| z * before >= 0.0));
            let end = drawn.path.times.last().copied().unwrap_or(0.0);
            assert!(end == UNTIL || drawn.jumps.len() + 10 > MOST_EVENTS, "{sets:?}: {end}");
        }
    }

    #[test]
    fn in_the_frame_of_the_capsule_the_ball_is_where_the_portrait_has_it() {
        let (d, drawn) = drawn("fig13", &[]);
        for (capsule, ball) in drawn.path.capsule.iter().zip(&drawn.path.ball) {
            assert!((capsule - ball).abs() <= 0.5 * d + 1e-12);
        }
        // bottom, top, top, five times in ten units of time, and the bottom at the end
        assert_eq!(drawn.jumps.len(), 16);
    }
}
