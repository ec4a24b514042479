//! Many motions at once, several to a processor core.

mod angle;
mod flights;
mod instructions;
mod lanes;
mod near;
mod search;
pub mod step;

pub use instructions::Instructions;

use super::event::{Event, Kind};
use super::simulation::{LISTED, Simulation};
use super::start::Start;
use crate::model::Motion;
use flights::Flights;
use instructions::Available;
use lanes::{Lanes, WIDTH};

/// Motions from their starts on, followed in lanes: for a sweep, a basin, an ensemble.
///
/// Each motion is what [`Simulation`] makes of it, event by event, to a few roundings per impact; so it is the same as
/// far as the number tells it, and where it is chaotic a different one after some fifty impacts. An ordinary flight, to
/// the other wall or back, clear of every doubt, is followed in lanes; a flight that grazes, a chatter that completes, a
/// rest, a release, a contact that f64 cannot decide is left to `Simulation`, and so is all that |g| >= 1 or a start of
/// no ordinary speed brings. What a motion comes to depends neither on the motions beside it nor on the instructions.
///
/// Made for ten motions and more; for a few, `Simulation` is faster. On every core, give each a part of the motions.
///
/// Each impact follows from the one before to 8 epsilon (1 + a)(1 + b) / min(1, |velocity|), a and b the angles of the
/// latest two flights: the error of phase and velocity, as for `Simulation`.
#[derive(Clone, Debug)]
pub struct Batch<'a> {
    motions: &'a [(Motion<f64>, Start<f64>)],
    available: Available,
}

impl<'a> Batch<'a> {
    /// These motions, by the fastest instructions of this machine.
    pub fn new(motions: &'a [(Motion<f64>, Start<f64>)]) -> Self {
        let fastest = Instructions::all().last().copied().unwrap_or(Instructions::Portable);
        Self {
            motions,
            available: Available::or_portable(fastest),
        }
    }

    /// The same by other instructions, or by the portable ones where this machine does not have them.
    pub fn on(self, instructions: Instructions) -> Self {
        Self {
            available: Available::or_portable(instructions),
            ..self
        }
    }

    /// The instructions it goes by.
    pub fn instructions(&self) -> Instructions {
        self.available.instructions()
    }

    /// Follows each motion for so many impacts, that of the start among them, or to its end, or until it is
    /// [idle](Simulation::is_idle), and shows each event with the index of its motion. The events of a motion come in
    /// their order; those of different motions in between, in an order that is the same on every machine.
    pub fn run(&self, impacts: u64, mut each: impl FnMut(usize, &Event<f64>)) {
        if impacts == 0 {
            return;
        }
        let motions = self.motions.iter().enumerate();
        let mut waiting = motions.map(|(index, (motion, start))| Ball::new(index, motion, start, impacts));
        let (mut lanes, mut flights) = (Lanes::idle(), Flights::none());
        let mut balls: [Option<Ball>; WIDTH] = [const { None }; WIDTH];
        loop {
            let mut is_over = true;
            for (lane, ball) in balls.iter_mut().enumerate() {
                is_over &= !go_on(ball, &mut lanes, lane, &mut waiting, &mut each);
            }
            if is_over {
                return;
            }
            self.available.step(&mut lanes, &mut flights);
        }
    }
}

/// Brings a lane to its next ordinary flight: of its ball, or, where that motion is over, of one that waits; `false` where
/// there is none.
#[inline]
fn go_on(
    place: &mut Option<Ball>,
    lanes: &mut Lanes,
    lane: usize,
    waiting: &mut impl Iterator<Item = Ball>,
    each: &mut impl FnMut(usize, &Event<f64>),
) -> bool {
    loop {
        if let Some(ball) = place
            && ball.goes_on(lanes, lane, each)
        {
            return true;
        }
        *place = waiting.next();
        match place {
            Some(ball) => lanes.enter(lane, ball.simulation.course.scaled()),
            None => {
                lanes.leave(lane);
                return false;
            }
        }
    }
}

/// A motion in a lane.
struct Ball {
    index: usize,
    /// Where the latest event that was no ordinary flight has led.
    simulation: Simulation<f64>,
    /// The turns up to the latest event.
    turns: i64,
    /// The impacts still to come.
    left: u64,
}

impl Ball {
    fn new(index: usize, motion: &Motion<f64>, start: &Start<f64>, impacts: u64) -> Self {
        let simulation = Simulation::new(motion, start);
        Self {
            index,
            simulation,
            turns: 0,
            left: impacts,
        }
    }

    /// Shows what has happened in the lane, and all that follows up to a departure for an ordinary flight; `false` where
    /// the motion is over.
    #[inline]
    fn goes_on(&mut self, lanes: &mut Lanes, lane: usize, each: &mut impl FnMut(usize, &Event<f64>)) -> bool {
        if lanes.flown[lane] > 0.0 {
            self.turns += lanes.turns[lane] as i64;
            let event = Event {
                kind: Kind::Impact,
                side: lanes.side(lane),
                turns: self.turns,
                phase: lanes.phase[lane],
                velocity: lanes.velocity[lane],
            };
            each(self.index, &event);
            self.left -= 1;
            return self.left > 0;
        }
        self.goes_by_itself(lanes, lane, each)
    }

    #[inline(never)]
    fn goes_by_itself(&mut self, lanes: &mut Lanes, lane: usize, each: &mut impl FnMut(usize, &Event<f64>)) -> bool {
        if lanes.speed[lane] > 0.0 {
            self.simulation.depart(lanes.departure(lane), self.turns);
        }
        lanes.leave(lane);
        while let Some(event) = self.simulation.next() {
            each(self.index, &event);
            self.turns = event.turns;
            if event.kind == Kind::Impact {
                self.left -= 1;
            }
            if self.left == 0 || self.simulation.is_idle() {
                return false;
            }
            if event.kind == Kind::Impact
                && event.velocity.abs() > 2.0 * LISTED
                && let Some(from) = self.simulation.course.departure()
            {
                lanes.depart(lane, from);
                return true;
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Side;
    use crate::number::{Analytic, DoubleDouble};
    use proptest::prelude::*;
    use std::f64::consts::{PI, TAU};

    type Orbit = (Motion<f64>, Start<f64>);

    fn orbit(motion: [f64; 4], side: Side, phase: f64, speed: f64) -> Orbit {
        let [g, d, r_b, r_t] = motion;
        let velocity = side.signed(speed);
        (
            Motion::new(g, d, r_b, r_t).expect("a motion"),
            Start { side, phase, velocity },
        )
    }

    /// Of the paper's range and well around it; many chatter, and where |g| > 1 the ball ends at rest.
    fn orbits(most: usize) -> impl Strategy<Value = Vec<Orbit>> {
        let motion = [-1.4..1.4, 0.05..2.0, 0.05..1.0, 0.05..1.0];
        let orbit = (motion, any::<bool>(), -9.0..9.0, 0.0..3.0).prop_map(|(motion, is_bottom, phase, speed)| {
            orbit(motion, if is_bottom { Side::Bottom } else { Side::Top }, phase, speed)
        });
        prop::collection::vec(orbit, 1..most)
    }

    /// The gaps of Fig. 3.
    fn sweep(r_b: f64, r_t: f64) -> Vec<Orbit> {
        let gaps = (0..401).map(|index| 0.1 + 0.001 * f64::from(index));
        gaps.map(|d| orbit([0.12201, d, r_b, r_t], Side::Bottom, 6.18, 0.5293))
            .collect()
    }

    fn stream(batch: &Batch, impacts: u64) -> Vec<(usize, Event<f64>)> {
        let mut stream = Vec::new();
        batch.run(impacts, |index, event| stream.push((index, event.clone())));
        stream
    }

    fn each(orbits: &[Orbit], impacts: u64) -> Vec<Vec<Event<f64>>> {
        let mut events = vec![Vec::new(); orbits.len()];
        Batch::new(orbits).run(impacts, |index, event| events[index].push(event.clone()));
        events
    }

    /// The angle of the forcing from one event to another.
    fn angle(from: &Event<f64>, to: &Event<f64>) -> f64 {
        TAU * (to.turns - from.turns) as f64 + to.phase - from.phase
    }

    fn apart(phase: f64, other: f64) -> f64 {
        ((phase - other + PI).rem_euclid(TAU) - PI).abs()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        #[test]
        fn all_instructions_give_the_same_bits(orbits in orbits(60)) {
            let portable = stream(&Batch::new(&orbits).on(Instructions::Portable), 80);
            for instructions in Instructions::all() {
                let batch = Batch::new(&orbits).on(instructions);
                prop_assert_eq!(batch.instructions(), instructions);
                prop_assert_eq!(&stream(&batch, 80), &portable);
            }
        }

        #[test]
        fn a_motion_is_the_same_whatever_is_beside_it(orbits in orbits(40)) {
            for (orbit, together) in orbits.iter().zip(each(&orbits, 60)) {
                prop_assert_eq!(&each(std::slice::from_ref(orbit), 60)[0], &together);
            }
        }

        /// From the event itself, so that chaos does not matter.
        #[test]
        fn each_event_follows_from_the_one_before_to_a_few_roundings(orbits in orbits(40)) {
            for ((motion, _), events) in orbits.iter().zip(each(&orbits, 60)) {
                let wide = motion.convert(|value| DoubleDouble::from_f64(*value)).expect("a motion");
                for three in events.windows(3) {
                    let [earlier, before, after] = three else { continue };
                    if after.kind == Kind::Undecided {
                        continue;
                    }
                    let from = before.convert(|value| DoubleDouble::from_f64(*value));
                    let mut simulation = Simulation::new(&wide, &Start::from(&from));
                    simulation.resume(&from);
                    let exact = simulation.next().expect("an event");
                    prop_assert_eq!((after.kind, after.side, after.turns), (exact.kind, exact.side, exact.turns));
                    // sine and cosine are those of an angle that the flight before, if long, has rounded more
                    let flights = (1.0 + angle(earlier, before)) * (1.0 + angle(before, after));
                    let roundings = match after.kind {
                        Kind::Impact => 8.0 / after.velocity.abs().min(1.0),
                        // the impacts that are not listed round as well
                        _ => 80.0,
                    };
                    let error = roundings * f64::EPSILON * flights;
                    let phases = apart(after.phase, exact.phase.to_f64());
                    let velocities = (after.velocity - exact.velocity.to_f64()).abs();
                    prop_assert!(phases <= error, "{:?} {:?} {} {}", before, after, phases, error);
                    prop_assert!(velocities <= error, "{:?} {:?} {} {}", before, after, velocities, error);
                }
            }
        }
    }

    #[test]
    fn through_rests_and_releases_it_is_the_motion_of_the_simulation_as_far_as_f64_tells_it() {
        let (mut rests, mut compared) = (0, 0);
        for orbits in [sweep(0.6, 0.3), sweep(0.3, 0.6)] {
            for ((motion, start), events) in orbits.iter().zip(each(&orbits, 500)) {
                let mut simulation = Simulation::new(motion, start).with_growth();
                for event in &events {
                    let one = simulation.next().expect("an event");
                    let growth = simulation.tracked();
                    if !growth.holds() || growth.phase_error() > 1e-6 {
                        break;
                    }
                    assert_eq!((event.kind, event.side, event.turns), (one.kind, one.side, one.turns));
                    // two motions, each as far off as is allowed for where digits are claimed: eight times what is estimated
                    assert!(apart(event.phase, one.phase) <= 16.0 * growth.phase_error() + 1e-15);
                    assert!((event.velocity - one.velocity).abs() <= 16.0 * growth.velocity_error());
                    compared += 1;
                    rests += usize::from(event.kind == Kind::Rest);
                }
            }
        }
        assert!(rests > 5_000 && compared > 300_000);
    }

    #[test]
    fn a_motion_ends_after_its_impacts_or_by_itself() {
        let orbits = [
            orbit([0.12, 0.4, 0.5, 0.5], Side::Bottom, 6.18, 0.5293),
            // pressed to the bottom for ever
            orbit([1.1, 0.5, 0.6, 0.6], Side::Bottom, 0.0, 0.4),
            // meets its wall only at rest and release
            orbit([0.3, 0.5, 0.6, 0.6], Side::Bottom, 0.2, 0.0),
        ];
        let impacts = |events: &[Event<f64>]| events.iter().filter(|event| event.kind == Kind::Impact).count();
        for most in [0, 1, 2, 100] {
            let events = each(&orbits, most);
            assert_eq!(impacts(&events[0]), most as usize);
            assert!(impacts(&events[1]) <= most as usize);
        }
        let ended = &each(&orbits, 1000)[1];
        assert_eq!(ended.last().map(|event| event.kind), Some(Kind::Rest));
        assert!(each(&[], 10).is_empty());
    }
}
