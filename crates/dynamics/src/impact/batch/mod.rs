//! Many motions at once, several to a processor core.

mod angle;
mod flights;
mod growth;
mod instructions;
mod lanes;
mod near;
mod search;
pub mod step;

pub use instructions::Instructions;

use super::chatter::LISTED;
use super::event::{Event, Kind};
use super::start::Start;
use super::widening::Widening;
use crate::model::Motion;
use flights::Flights;
use growth::Growths;
use instructions::Available;
use lanes::{Lanes, WIDTH};

/// Motions from their starts on, followed in lanes: for a sweep, a basin, an ensemble.
///
/// Each motion is what [`Widening`] makes of it, event by event, to a few roundings per impact; so it is the same as
/// far as the number tells it, and where it is chaotic a different one after some fifty impacts. An ordinary flight, to
/// the other wall or back, clear of every doubt, is followed in lanes; a flight that grazes, a chatter that completes, a
/// rest, a release, a contact that f64 cannot decide is left to `Widening`, and so is all that |g| >= 1 or a start of
/// no ordinary speed brings. What a motion comes to depends neither on the motions beside it nor on the instructions.
///
/// Made for ten motions and more; for a few, `Widening` is faster. On every core, give each a part of the motions.
///
/// Each impact follows from the one before to 8 epsilon (1 + a)(1 + b) / min(1, |velocity|), a and b the angles of the
/// latest two flights: the error of phase and velocity, as for `Widening`.
#[derive(Clone, Debug)]
pub struct Batch<'a> {
    motions: &'a [(Motion<f64>, Start<f64>)],
    available: Available,
}

impl<'a> Batch<'a> {
    /// These motions, by the fastest instructions of this machine.
    pub fn new(motions: &'a [(Motion<f64>, Start<f64>)]) -> Self {
        Self {
            motions,
            available: Available::fastest(),
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
    /// [idle](Widening::is_idle), and shows each event with the index of its motion. The events of a motion come in
    /// their order; those of different motions in between, in an order that is the same on every machine.
    pub fn run(&self, impacts: u64, mut each: impl FnMut(usize, &Event<f64>)) {
        if impacts == 0 {
            return;
        }
        let motions = self.motions.iter().enumerate();
        let motions = motions.map(|(index, (motion, start))| {
            let motion = Widening::new(motion, start).without_growth();
            (motion, (index, impacts))
        });
        let each = |(index, left): &mut (usize, u64), event: &Event<f64>, _: &Grown| {
            each(*index, event);
            *left -= u64::from(event.kind == Kind::Impact);
            *left > 0
        };
        follow::<(usize, u64), false>(self.available, motions, each, |_, _| {});
    }
}

/// Follows motions in lanes, as [`Batch`] does; where `with_growth`, with the growth of their errors.
///
/// Of each motion, `each` is shown the events in their order, with what the motion has been given beside it, until it says
/// that no more are wanted, the motion ends or is [idle](Widening::is_idle); then `ended` is given the motion as it stands.
pub fn in_lanes<M>(
    motions: impl IntoIterator<Item = (Widening, M)>,
    with_growth: bool,
    each: impl FnMut(&mut M, &Event<f64>, &Grown) -> bool,
    ended: impl FnMut(M, Widening),
) {
    let motions = motions.into_iter();
    match with_growth {
        true => follow::<M, true>(Available::fastest(), motions, each, ended),
        false => follow::<M, false>(Available::fastest(), motions, each, ended),
    }
}

fn follow<M, const GROWTH: bool>(
    available: Available,
    motions: impl Iterator<Item = (Widening, M)>,
    mut each: impl FnMut(&mut M, &Event<f64>, &Grown) -> bool,
    mut ended: impl FnMut(M, Widening),
) {
    let mut waiting = motions.map(|(motion, beside)| Ball {
        motion,
        beside,
        turns: 0,
    });
    let mut tracked = TrackedLanes {
        lanes: Lanes::idle(),
        growths: Growths::none(),
    };
    let mut flights = Flights::none();
    let mut balls: [Option<Ball<M>>; WIDTH] = [const { None }; WIDTH];
    loop {
        let mut is_over = true;
        for (lane, place) in balls.iter_mut().enumerate() {
            is_over &= !tracked.goes_on::<M, GROWTH>(place, lane, &mut waiting, &mut each, &mut ended);
        }
        if is_over {
            return;
        }
        available.step::<GROWTH>(&mut tracked.lanes, &mut flights, &mut tracked.growths);
    }
}

/// How the errors of a motion in a lane have grown.
pub struct Grown<'a> {
    motion: &'a Widening,
    since: Option<(&'a Growths, usize)>,
}

impl Grown<'_> {
    /// As [`Growth::stretch_since_release`](super::Growth::stretch_since_release).
    pub fn stretch_since_release(&self) -> f64 {
        let since = self.since.map_or(0.0, |(growths, lane)| growths.stretch(lane));
        self.motion.growth().stretch_since_release() + since
    }
}

/// All lanes, with what is known of their errors.
struct TrackedLanes {
    lanes: Lanes,
    growths: Growths,
}

/// A motion in a lane, with what it has been given beside it.
struct Ball<M> {
    /// Where the latest event that was no ordinary flight has led.
    motion: Widening,
    beside: M,
    /// The turns up to the latest event.
    turns: i64,
}

impl TrackedLanes {
    /// Brings a lane to its next ordinary flight: of its ball, or, where that motion is over, of one that waits; `false`
    /// where there is none.
    #[inline]
    fn goes_on<M, const GROWTH: bool>(
        &mut self,
        place: &mut Option<Ball<M>>,
        lane: usize,
        waiting: &mut impl Iterator<Item = Ball<M>>,
        each: &mut impl FnMut(&mut M, &Event<f64>, &Grown) -> bool,
        ended: &mut impl FnMut(M, Widening),
    ) -> bool {
        loop {
            if let Some(ball) = place {
                if self.flies::<M, GROWTH>(ball, lane, each) {
                    return true;
                }
                if let Some(ball) = place.take() {
                    ended(ball.beside, ball.motion);
                }
            }
            *place = waiting.next();
            match place {
                Some(ball) => match ball.motion.simulation.course.ordinary() {
                    Some(scaled) => self.lanes.enter(lane, scaled),
                    None => self.lanes.leave(lane),
                },
                None => {
                    self.lanes.leave(lane);
                    return false;
                }
            }
        }
    }

    /// Shows what has happened in the lane, and all that follows up to a departure for an ordinary flight; `false` where
    /// the motion is over.
    #[inline]
    fn flies<M, const GROWTH: bool>(
        &mut self,
        ball: &mut Ball<M>,
        lane: usize,
        each: &mut impl FnMut(&mut M, &Event<f64>, &Grown) -> bool,
    ) -> bool {
        let lanes = &self.lanes;
        if lanes.flown[lane] > 0.0 {
            ball.turns += lanes.turns[lane] as i64;
            let event = Event {
                kind: Kind::Impact,
                side: lanes.side(lane),
                turns: ball.turns,
                phase: lanes.phase[lane],
                velocity: lanes.velocity[lane],
            };
            let grown = Grown {
                motion: &ball.motion,
                since: GROWTH.then_some((&self.growths, lane)),
            };
            let goes_on = each(&mut ball.beside, &event, &grown);
            if !goes_on {
                self.land::<M, GROWTH>(ball, lane);
            }
            return goes_on;
        }
        self.goes_by_itself::<M, GROWTH>(ball, lane, each)
    }

    /// Brings the motion of a lane to where that is.
    fn land<M, const GROWTH: bool>(&mut self, ball: &mut Ball<M>, lane: usize) {
        if self.lanes.speed[lane] > 0.0 {
            let simulation = &mut ball.motion.simulation;
            simulation.depart(self.lanes.departure(lane), ball.turns);
            if GROWTH {
                self.growths.leave(lane, &mut simulation.growth);
            }
        }
        self.lanes.leave(lane);
    }

    #[inline(never)]
    fn goes_by_itself<M, const GROWTH: bool>(
        &mut self,
        ball: &mut Ball<M>,
        lane: usize,
        each: &mut impl FnMut(&mut M, &Event<f64>, &Grown) -> bool,
    ) -> bool {
        self.land::<M, GROWTH>(ball, lane);
        while let Some(event) = ball.motion.next() {
            let grown = Grown {
                motion: &ball.motion,
                since: None,
            };
            let goes_on = each(&mut ball.beside, &event, &grown);
            ball.turns = event.turns;
            if !goes_on || ball.motion.is_idle() {
                return false;
            }
            if event.kind == Kind::Impact
                && event.velocity.abs() > 2.0 * LISTED
                && let Some(from) = ball.motion.simulation.course.departure()
            {
                self.lanes.depart(lane, from);
                if GROWTH {
                    self.growths.enter(lane, ball.motion.growth());
                }
                return true;
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::super::simulation::Simulation;
    use super::*;
    use crate::model::Side;
    use numbers::{Analytic, DoubleDouble};
    use proptest::prelude::*;
    use proptest::strategy::ValueTree;
    use std::f64::consts::{PI, TAU};

    type Orbit = (Motion<f64>, Start<f64>);

    fn orbit(motion: [f64; 4], side: Side, phase: f64, speed: f64) -> Orbit {
        let [g, d, r_b, r_t] = motion;
        let velocity = side.signed(speed);
        (
            Motion::new(g, d, r_b, r_t).expect("a motion"),
            Start::impact(side, phase, velocity),
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

    /// The impacts and the logarithm of the stretch at each, and the growth at the end, of a motion in lanes or alone.
    fn grown((motion, start): &Orbit, in_a_lane: bool) -> (Vec<(Event<f64>, f64)>, Widening) {
        let mut told = Vec::new();
        let mut motion = Widening::new(motion, start);
        if in_a_lane {
            let mut end = None;
            let each = |left: &mut u32, event: &Event<f64>, grown: &Grown| {
                told.push((event.clone(), grown.stretch_since_release()));
                *left -= 1;
                *left > 0
            };
            in_lanes([(motion, 60)], true, each, |_, motion| end = Some(motion));
            return (told, end.expect("it ends"));
        }
        while told.len() < 60
            && !motion.is_idle()
            && let Some(event) = motion.next()
        {
            told.push((event, motion.growth().stretch_since_release()));
        }
        (told, motion)
    }

    #[test]
    fn errors_grow_in_lanes_as_they_do_alone() {
        let mut runner = proptest::test_runner::TestRunner::deterministic();
        let (mut held, mut apart_in_claims) = (0, 0);
        for _ in 0..40 {
            let tree = orbits(40).new_tree(&mut runner).expect("orbits");
            for orbit in tree.current() {
                let (told, motion) = grown(&orbit, true);
                let (alone, other) = grown(&orbit, false);
                let (growth, one) = (motion.growth(), other.growth());
                if one.holds() != growth.holds() {
                    apart_in_claims += 1;
                    continue;
                }
                if !one.holds() || told.len() != alone.len() || one.phase_error() > 1e-11 {
                    continue;
                }
                held += 1;
                // a rounding of the motion itself grows to some 1e-6 of it by then, and a wrong term would show as a part of 1
                for ((event, stretch), (same, alone)) in told.iter().zip(&alone) {
                    assert_eq!(event.kind, same.kind);
                    assert!(
                        (stretch - alone).abs() <= 1e-2 || stretch == alone,
                        "{orbit:?} {event:?} {stretch} {alone}"
                    );
                }
                let ratios = [
                    (growth.phase_error(), one.phase_error()),
                    (growth.velocity_error(), one.velocity_error()),
                ];
                assert!(
                    ratios
                        .iter()
                        .all(|(error, alone)| (error - alone).abs() <= 1e-2 * alone),
                    "{orbit:?} {ratios:?}"
                );
            }
        }
        assert!(held > 300 && apart_in_claims < held / 100, "{held} {apart_in_claims}");
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
