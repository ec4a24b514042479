//! The motion between the events: where ball and capsule are at any time.

use super::event::{Event, Kind};
#[cfg(any(test, feature = "calls"))]
use crate::model::calls::{self, Call};
use crate::model::{Flight, FlightError, Forcing, Motion, Side};
use numbers::Analytic;

/// Ball and capsule at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot<T> {
    /// The time since the first event; the period of the forcing is 2.
    pub time: T,
    /// The phase of the forcing, rad, in [0, 2 pi).
    pub phase: T,
    /// Z, the place of the ball in the capsule: +d/2 at the bottom, -d/2 at the top.
    pub z: T,
    /// Zdot; at an impact that just before it.
    pub zdot: T,
    /// X, the middle of the capsule, in the frame in which it swings about 0 without a drift: F_2, which is -cos(phase)/pi²
    /// under the forcing of the paper. The frame is a choice: (1) gives X up to a constant and a steady velocity, and the
    /// motion depends on neither.
    pub capsule: T,
    /// x = X - Z, the ball in the same frame, in which it falls with -g between the impacts.
    pub ball: T,
}

/// A motion as a function of time, from its events.
///
/// Under the forcing of the motion. Each state is computed from the event before it by (3) and (4) in closed form, so
/// nothing adds up along the motion but the error of the events themselves; a few roundings of `T` come on top.
#[derive(Clone, Debug)]
pub struct Trajectory<T, E> {
    motion: Motion<T>,
    events: E,
    /// The phase of the first event.
    start: Option<T>,
    /// What happens from the last event before the time asked for on.
    course: Course<T>,
    /// When that begins.
    since: Option<T>,
    /// The last event before the time asked for, and the first one after it.
    last: Option<Event<T>>,
    next: Option<Event<T>>,
}

/// What the ball does from one event to the next.
#[derive(Clone, Debug)]
enum Course<T> {
    /// From a place Z.
    Flight(T, Flight<T>),
    Chatter(Chatter<T>),
    Rest(Side),
    /// Nothing has happened yet, or what happened is undecided.
    Unknown,
}

/// The end of a chatter, of which the impacts are not listed: each flight is r times as long and as fast as the one
/// before, as it is under the constant acceleration that f + g tends to.
#[derive(Clone, Debug)]
struct Chatter<T> {
    side: Side,
    restitution: T,
    /// The speed after the last impact that is listed.
    launch: T,
    /// The time from there to the rest.
    left: T,
}

impl<T: Analytic, E: Iterator<Item = Event<T>>> Trajectory<T, E> {
    /// The motion with these events, in order; the time is 0 at the first.
    pub fn new(motion: Motion<T>, mut events: E) -> Self {
        let next = events.next();
        Self {
            motion,
            events,
            start: next.as_ref().map(|event| event.phase.clone()),
            course: Course::Unknown,
            since: None,
            last: None,
            next,
        }
    }

    /// The motion that starts in flight and then has these events, in order; the time is 0 at the start.
    pub fn in_flight(motion: Motion<T>, phase: T, position: T, velocity: T, mut events: E) -> Self {
        let next = events.next();
        let flight = launched(&motion, Side::Bottom, &phase, velocity);
        Self {
            motion,
            events,
            course: flight.map_or(Course::Unknown, |flight| Course::Flight(position, flight)),
            start: Some(phase),
            since: Some(T::zero()),
            last: None,
            next,
        }
    }

    /// Ball and capsule at `time`, which must not be before any time asked for earlier. At an event the state is that
    /// before it. From the last listed impact of a chatter to the rest the flights are those under a constant
    /// acceleration, right to the first order in their length; beyond the last event the ball flies or rests on.
    ///
    /// `None` before the first event, after an undecided one, and where the time is no number.
    pub fn at(&mut self, time: &T) -> Option<Snapshot<T>> {
        #[cfg(any(test, feature = "calls"))]
        calls::count(Call::Snapshot);
        let start = self.start.clone()?;
        while let Some(event) = self.next.take_if(|event| is_after(time, &event.time(&start))) {
            self.next = self.events.next();
            self.course = self.course_from(&event, &start);
            self.last = Some(event);
        }
        let (z, zdot) = match (&self.last, &self.since, &self.next) {
            (Some(last), ..) => self.state(&since(last, &start, time))?,
            (None, Some(from), _) if !is_after(from, time) => self.state(time)?,
            (None, None, Some(first)) if first.time(&start) == *time => (self.wall(first.side), first.velocity.clone()),
            _ => return None,
        };
        let turn = T::pi() + T::pi();
        // whole periods are taken off before pi comes in, so that the phase keeps its digits
        let phase = start + T::pi() * Forcing::<T>::harmonic(&T::zero()).reduced(time);
        let phase = if is_after(&turn, &phase) { phase } else { phase - turn };
        let capsule = match self.motion.other_forcing() {
            None => -(phase.sincos().1 / (T::pi() * T::pi())),
            Some(forcing) => forcing.at(&(phase.clone() / T::pi())).f2,
        };
        Some(Snapshot {
            time: time.clone(),
            phase,
            ball: capsule.clone() - z.clone(),
            capsule,
            z,
            zdot,
        })
    }

    /// What follows `event`.
    fn course_from(&self, event: &Event<T>, start: &T) -> Course<T> {
        let restitution = self.motion.restitution(event.side).clone();
        match (event.kind, &self.next) {
            (Kind::Undecided, _) => Course::Unknown,
            (Kind::Rest, _) => Course::Rest(event.side),
            (Kind::Impact, Some(rest)) if rest.kind == Kind::Rest => Course::Chatter(Chatter {
                side: event.side,
                launch: event.side.signed(restitution.clone() * event.velocity.clone()),
                restitution,
                left: since(event, start, &rest.time(start)),
            }),
            (Kind::Impact | Kind::Release, _) => {
                let launch = -(restitution * event.velocity.clone());
                let flight = launched(&self.motion, event.side, &event.phase, launch);
                flight.map_or(Course::Unknown, |flight| Course::Flight(self.wall(event.side), flight))
            }
        }
    }

    fn wall(&self, side: Side) -> T {
        side.signed(self.motion.d().clone() * T::from_ratio(1, 2))
    }

    /// Z and Zdot a time `s` after the last event.
    fn state(&self, s: &T) -> Option<(T, T)> {
        match &self.course {
            Course::Unknown => None,
            Course::Rest(side) => Some((self.wall(*side), T::zero())),
            Course::Chatter(chatter) => {
                let (away, velocity) = chatter.state(s);
                let side = chatter.side;
                Some((self.wall(side) - side.signed(away), -side.signed(velocity)))
            }
            Course::Flight(from, flight) => {
                let state = flight.state(s);
                Some((from.clone() + state.displacement, state.velocity))
            }
        }
    }
}

/// The flight that begins at a phase of the forcing with a velocity.
fn launched<T: Analytic>(motion: &Motion<T>, side: Side, phase: &T, velocity: T) -> Result<Flight<T>, FlightError> {
    match motion.other_forcing() {
        // the phase goes into the forcing, where no rounding is added to it
        None => Flight::launched(motion, &Forcing::harmonic(phase), side, &T::zero(), velocity),
        Some(forcing) => Flight::launched(motion, forcing, side, &(phase.clone() / T::pi()), velocity),
    }
}

impl<T: Analytic> Chatter<T> {
    /// The distance from the wall and the velocity away from it, a time `s` after the last listed impact.
    fn state(&self, s: &T) -> (T, T) {
        let (left, rest) = (self.left.clone(), self.left.clone() - s.clone());
        let part = (rest.clone() / left.clone()).to_f64();
        if !(part > 0.0 && self.launch.to_f64() > 0.0) {
            return (T::zero(), T::zero());
        }
        // after n more impacts r^n of the time is left
        let flights = (part.ln() / self.restitution.to_f64().ln()).floor();
        let shrunk = self.restitution.to_power(flights as i32);
        let passed = shrunk.clone() * left.clone() - rest;
        // all flights together take the time that is left: 2 launch / (pull (1 - r))
        let half_pull = self.launch.clone() / (left * (T::one() - self.restitution.clone()));
        let launch = shrunk * self.launch.clone();
        let lost = half_pull * passed.clone();
        ((launch.clone() - lost.clone()) * passed, launch - lost.clone() - lost)
    }
}

fn is_after<T: Analytic>(time: &T, other: &T) -> bool {
    (time.clone() - other.clone()).to_f64() > 0.0
}

/// The time from `event` to `time`; whole turns are taken off first, where nothing is lost.
fn since<T: Analytic>(event: &Event<T>, start: &T, time: &T) -> T {
    let turns = T::from_integer(2 * event.turns);
    time.clone() - turns - (event.phase.clone() - start.clone()) / T::pi()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Impact;
    use numbers::{Dual, Wide, seeded};
    use proptest::prelude::*;
    use std::f64::consts::{PI, TAU};

    const G: f64 = 0.122_01;

    fn motion(g: f64, d: f64, r_b: f64, r_t: f64) -> Motion<f64> {
        Motion::new(g, d, r_b, r_t).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Impacts by the maps of the model, as long as they come; the start at the bottom first.
    fn impacts(motion: &Motion<f64>, phase: f64, velocity: f64, count: usize) -> Vec<Event<f64>> {
        let forcing = Forcing::harmonic(&0.0);
        let event = |turns, side, phase, velocity| Event {
            kind: Kind::Impact,
            side,
            turns,
            phase,
            velocity,
        };
        let mut events = vec![event(0, Side::Bottom, phase, velocity)];
        while events.len() < count {
            let last = &events[events.len() - 1];
            let from = Impact {
                side: last.side,
                time: last.phase / PI,
                velocity: last.velocity,
            };
            let Ok(leg) = crate::model::next_impact(motion, &forcing, &from) else {
                break;
            };
            let angle = last.phase + PI * leg.duration;
            let turns = (angle / TAU).floor();
            let phase = (angle - turns * TAU).clamp(0.0, TAU);
            events.push(event(last.turns + turns as i64, leg.to.side, phase, leg.to.velocity));
        }
        events
    }

    /// The middles of the intervals between the events, and the interval's half width.
    fn middles(events: &[Event<f64>]) -> Vec<(f64, f64)> {
        let start = events[0].phase;
        let pairs = events.windows(2);
        pairs
            .map(|pair| {
                let [from, to] = [0, 1].map(|index: usize| pair[index].time(&start));
                (0.5 * (from + to), 0.5 * (to - from))
            })
            .collect()
    }

    #[test]
    fn at_an_impact_the_ball_is_at_the_wall_with_the_velocity_before() {
        let motion = motion(G, 0.26, 0.6, 0.3);
        let events = impacts(&motion, 6.18, 0.5293, 40);
        assert!(events.len() == 40);
        let mut trajectory = Trajectory::new(motion, events.clone().into_iter());
        for event in &events {
            let Some(at) = trajectory.at(&event.time(&events[0].phase)) else {
                panic!("a state")
            };
            assert!((at.z - event.side.sign() * 0.13).abs() < 1e-14, "{at:?}");
            assert!((at.zdot - event.velocity).abs() < 1e-13, "{at:?}");
            assert!((at.phase - event.phase).abs() < 1e-13, "{at:?}");
        }
    }

    #[test]
    fn at_rest_the_ball_stays_and_at_the_release_it_leaves_with_velocity_0() {
        let motion = motion(G, 0.18, 0.6, 0.3);
        let release = TAU - (-G).acos();
        let event = |kind, phase: f64, velocity| Event {
            kind,
            side: Side::Top,
            turns: 0,
            phase,
            velocity,
        };
        let events = [
            event(Kind::Impact, 2.0, -1e-6),
            event(Kind::Rest, 2.000_01, 0.0),
            event(Kind::Release, release, 0.0),
        ];
        let time = |phase: f64| (phase - 2.0) / PI;
        let mut trajectory = Trajectory::new(motion, events.into_iter());
        for phase in [2.000_02, 2.5, 4.0, release - 1e-9] {
            let Some(at) = trajectory.at(&time(phase)) else {
                panic!("a state")
            };
            assert_eq!((at.z, at.zdot), (-0.09, 0.0));
        }
        // it leaves with the third power of the time: f + g grows from 0 with the slope pi sqrt(1 - g²)
        for after in [1e-4, 1e-3] {
            let Some(at) = trajectory.at(&(time(release) + after)) else {
                panic!("a state")
            };
            let left = PI * (1.0 - G * G).sqrt() * after * after * after / 6.0;
            assert!(((at.z + 0.09) / left - 1.0).abs() < 1e-3, "{at:?}");
        }
    }

    #[test]
    fn the_unlisted_end_of_a_chatter_shrinks_by_the_restitution() {
        // from launch u under a pull of 1: flights of 2 u r^n, 2 u/(1 - r) in all
        let (u, r) = (0.5e-6_f64, 0.5_f64);
        let chatter = Chatter {
            side: Side::Bottom,
            restitution: r,
            launch: u,
            left: 2.0 * u / (1.0 - r),
        };
        let mut from = 0.0;
        for n in 0..20 {
            let (launch, length) = (u * r.powi(n), 2.0 * u * r.powi(n));
            for part in [0.1, 0.5, 0.9] {
                let s = part * length;
                let (away, velocity) = chatter.state(&(from + s));
                assert!((away - (launch - 0.5 * s) * s).abs() < 1e-12 * u * u, "{n} {part}");
                assert!((velocity - (launch - s)).abs() < 1e-9 * u, "{n} {part}");
            }
            from += length;
        }
        assert_eq!(chatter.state(&(4.0 * u)), (0.0, 0.0));
    }

    #[test]
    fn where_nothing_is_known_nothing_is_said() {
        let known = motion(G, 0.3, 0.5, 0.5);
        let mut none = Trajectory::new(known.clone(), std::iter::empty());
        assert!(none.at(&0.0).is_none());
        let mut events = impacts(&known, 1.0, 0.6, 3);
        events[2].kind = Kind::Undecided;
        let end = events[2].time(&1.0);
        let mut trajectory = Trajectory::new(known, events.into_iter());
        assert!(trajectory.at(&-0.1).is_none() && trajectory.at(&f64::NAN).is_none());
        assert!(trajectory.at(&0.0).is_some_and(|at| at.z == 0.15 && at.zdot == 0.6));
        assert!(trajectory.at(&(end - 1e-3)).is_some());
        assert!(trajectory.at(&(end + 1e-3)).is_none());
    }

    #[test]
    fn forty_digits_agree_with_f64_along_a_motion() {
        let float = motion(0.125, 0.25, 0.5, 0.5);
        let events = impacts(&float, 1.0, 0.6, 20);
        let wide = |value: &f64| Wide::<40>::from_f64(*value);
        let exact = events.iter().map(|event| Event {
            kind: event.kind,
            side: event.side,
            turns: event.turns,
            phase: wide(&event.phase),
            velocity: wide(&event.velocity),
        });
        let Ok(motion) = float.convert(wide) else {
            panic!("a motion")
        };
        let (mut trajectory, mut exact) = (
            Trajectory::new(float, events.clone().into_iter()),
            Trajectory::new(motion, exact),
        );
        for (middle, _) in middles(&events) {
            let (Some(at), Some(right)) = (trajectory.at(&middle), exact.at(&wide(&middle))) else {
                panic!("both")
            };
            for (found, exact) in [(at.z, right.z), (at.zdot, right.zdot), (at.ball, right.ball)] {
                assert!((wide(&found) - exact).to_f64().abs() < 4e-15, "{middle}");
            }
        }
    }

    fn parameters() -> impl Strategy<Value = (Motion<f64>, f64, f64)> {
        let motion = (-0.5_f64..0.9, 0.05_f64..0.8, 0.2_f64..1.0, 0.2_f64..1.0);
        let start = (0.0_f64..TAU, 0.1_f64..2.0);
        (motion, start)
            .prop_map(|((g, d, r_b, r_t), (phase, velocity))| (self::motion(g, d, r_b, r_t), phase, velocity))
    }

    proptest! {
        #[test]
        fn along_flights_the_laws_of_motion_hold((motion, phase, velocity) in parameters(), part in -0.99_f64..0.99) {
            let events = impacts(&motion, phase, velocity, 12);
            let (g, half) = (*motion.g(), 0.5 * motion.d());
            type Second = Dual<Dual<f64>>;
            let constant = |value: &f64| Second::from_f64(*value);
            let dual = events.iter().map(|event| Event {
                kind: event.kind,
                side: event.side,
                turns: event.turns,
                phase: constant(&event.phase),
                velocity: constant(&event.velocity),
            });
            let motion = motion.convert(constant).map_err(|error| TestCaseError::fail(error.to_string()))?;
            let mut trajectory = Trajectory::new(motion, dual);
            for (middle, reach) in middles(&events) {
                let time = Dual::new(seeded(middle + part * reach), Dual::from_re(1.0));
                let at = trajectory.at(&time).ok_or_else(|| TestCaseError::fail("no state"))?;
                let forcing = at.phase.re.re.cos();
                prop_assert!(at.z.re.re.abs() < half + 1e-14);
                prop_assert!((at.z.re.eps - at.zdot.re.re).abs() < 1e-13, "Zdot is the derivative of Z");
                prop_assert!((at.zdot.re.eps - forcing - g).abs() < 1e-13, "Zddot = f + g");
                let half_of = constant(&0.5);
                let energy = at.zdot * at.zdot * half_of - constant(&g) * at.z;
                prop_assert!((energy.re.eps - forcing * at.zdot.re.re).abs() < 1e-13, "the power is f Zdot");
                prop_assert!((at.ball.eps.eps + g).abs() < 1e-13, "the ball falls freely");
                prop_assert!((at.capsule.eps.eps - forcing).abs() < 1e-13, "the capsule follows the force");
                prop_assert!((at.capsule.re.re - at.ball.re.re - at.z.re.re).abs() < 1e-15);
            }
        }
    }
}
