//! Cycles through a rest: a release forgets what was before, so the second one from a wall closes a cycle.

use crate::impact::{Event, Kind, Simulation};
use crate::model::{MotionError, Parameters, Side};
use numbers::{Analytic, Digits, DoubleDouble, Rung, at_digits};
use stop;

/// The releases of a ball so far.
///
/// The ball leaves a wall at rest at a phase where f + g changes its sign, which the motion alone gives: one on each wall
/// under the cosine of the paper, some on each under several harmonics.
#[derive(Clone, Debug, Default)]
pub struct Releases {
    seen: Vec<(Side, f64)>,
}

/// Phases of release that are no farther apart are one.
const SAME: f64 = 1e-6;

fn is_same_release(event: &Event<f64>, side: Side, phase: f64) -> bool {
    event.kind == Kind::Release && event.side == side && (event.phase - phase).abs() < SAME
}

impl Releases {
    /// Takes in an event: whether it is a release that the ball has had before.
    pub fn is_second(&mut self, event: &Event<f64>) -> bool {
        if event.kind != Kind::Release {
            return false;
        }
        let is_known = |(side, phase): &(Side, f64)| is_same_release(event, *side, *phase);
        let is_second = self.seen.iter().any(is_known);
        if !is_second {
            self.seen.push((event.side, event.phase));
        }
        is_second
    }
}

/// A cycle through a rest: from a release to the next one from that wall at that phase.
///
/// The release is known by itself to every digit, so all of the cycle is that of the exact parameters, in a number wide
/// enough for the estimated errors of its events to stay below 1e-13.
#[derive(Clone, Debug, PartialEq)]
pub struct RestingCycle {
    /// The wall that releases the ball.
    pub side: Side,
    /// The phase of the release, rad, to 1e-6 or better.
    pub phase: f64,
    /// The number that holds the cycle.
    pub number: Rung,
    /// The forcing periods it takes.
    pub periods: i64,
    /// What happens on it, the next release from that wall last, so that nobody has to compute it again; none of a cycle
    /// of more than [`HELD`] events.
    events: Vec<Event<f64>>,
}

/// The largest error of phase and velocity of an event of a cycle, which is told in f64: not far above its rounding.
const EXACT: f64 = 1e-13;

/// The most events of a cycle that are kept.
const HELD: usize = 20_000;

impl RestingCycle {
    /// The cycle on which the ball is released from `side` at `phase`, rad; else the impacts within which it is known not to come back: at
    /// most `most`, and as far as f64 and wider numbers of up to `digits` digits hold.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn find(
        parameters: &impl Parameters,
        (side, phase): (Side, f64),
        most: u64,
        digits: u32,
    ) -> Result<Result<Self, u64>, MotionError> {
        let mut known = 0;
        let may_be_spent = |number: &Rung| *number == Rung::Double || number.digits() <= digits;
        for number in Rung::Double.and_wider().filter(may_be_spent) {
            let cycle = Self {
                side,
                phase,
                number,
                periods: 0,
                events: Vec::new(),
            };
            let (mut left, mut events) = (most, Vec::new());
            let closed = cycle.follow(parameters, |event| {
                left -= u64::from(event.kind == Kind::Impact);
                if events.len() <= HELD {
                    events.push(event.clone());
                }
                left > 0 && stop::goes_on()
            })?;
            match closed {
                Some(periods) => {
                    if events.len() > HELD {
                        events = Vec::new();
                    }
                    return Ok(Ok(Self {
                        periods,
                        events,
                        ..cycle
                    }));
                }
                None => known = known.max(most - left),
            }
            if left == 0 || !stop::goes_on() {
                break;
            }
        }
        Ok(Err(known))
    }

    /// Shows the events after the release to `visit`, the next release from that wall as the last.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn visit(&self, parameters: &impl Parameters, mut visit: impl FnMut(&Event<f64>)) -> Result<(), MotionError> {
        if !self.events.is_empty() {
            self.events.iter().for_each(visit);
            return Ok(());
        }
        let all = |event: &Event<f64>| {
            visit(event);
            true
        };
        self.follow(parameters, all).map(drop)
    }

    /// The turns from release to release, as long as the visitor goes on; `None` where it does not, and where the motion
    /// ends before or errors take it over.
    fn follow(
        &self,
        parameters: &impl Parameters,
        visit: impl FnMut(&Event<f64>) -> bool,
    ) -> Result<Option<i64>, MotionError> {
        match self.number {
            Rung::Single | Rung::Double => self.follow_in::<f64>(parameters, visit),
            Rung::DoubleDouble => self.follow_in::<DoubleDouble>(parameters, visit),
            Rung::Wide(digits) => at_digits(digits, || self.follow_in::<Digits>(parameters, visit)),
        }
    }

    fn follow_in<T: Analytic>(
        &self,
        parameters: &impl Parameters,
        mut visit: impl FnMut(&Event<f64>) -> bool,
    ) -> Result<Option<i64>, MotionError> {
        let motion = parameters.motion::<T>()?;
        let Some(simulation) = Simulation::released(&motion, self.side, self.phase) else {
            return Ok(None);
        };
        let mut simulation = simulation.with_growth();
        let mut released = None;
        while let Some(event) = simulation.next() {
            if !simulation.growth().is_some_and(|growth| growth.holds_to(EXACT)) {
                break;
            }
            let event = event.convert(T::to_f64);
            let is_release = is_same_release(&event, self.side, self.phase);
            match released {
                None => released = Some(event.turns),
                Some(_) if !visit(&event) => break,
                Some(turns) if is_release => return Ok(Some(event.turns - turns)),
                Some(_) => {}
            }
        }
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;

    #[test]
    fn the_second_release_from_a_wall_closes_a_cycle() {
        let event = |kind, side, phase| Event {
            kind,
            side,
            turns: 0,
            phase,
            velocity: 0.0,
        };
        let mut releases = Releases::default();
        let told = [
            (Kind::Release, Side::Bottom, 1.0, false),
            (Kind::Impact, Side::Bottom, 1.0, false),
            (Kind::Release, Side::Top, 1.0, false),
            (Kind::Release, Side::Bottom, 4.0, false),
            (Kind::Release, Side::Bottom, 1.0, true),
            (Kind::Release, Side::Top, 1.0, true),
        ];
        for (kind, side, phase, closes) in told {
            assert_eq!(releases.is_second(&event(kind, side, phase)), closes, "{kind} {side}");
        }
    }

    /// The one release from a wall, of |g| up to 1.
    fn release(motion: &Motion<f64>, side: Side) -> (Side, f64) {
        let angle = (-motion.g()).clamp(-1.0, 1.0).acos();
        let phase = if side == Side::Bottom {
            angle
        } else {
            std::f64::consts::TAU - angle
        };
        (side, phase)
    }

    fn periods(motion: &Motion<f64>, side: Side) -> Option<(i64, Rung)> {
        let found = RestingCycle::find(motion, release(motion, side), 10_000, 200).unwrap();
        found.ok().map(|cycle| (cycle.periods, cycle.number))
    }

    #[test]
    fn a_long_chaotic_cycle_is_found_in_a_number_that_holds_it() {
        // 41 periods by 60 and by 200 digits; f64 alone comes back after 39, then 59, and 31 digits leave fewer than 13
        let motion = Motion::new(0.5, 0.35, 0.5, 0.5).unwrap();
        assert_eq!(periods(&motion, Side::Bottom), Some((41, Rung::Wide(50))));
        let short = Motion::new(0.12201, 0.18, 0.6, 0.3).unwrap();
        assert_eq!(periods(&short, Side::Top), Some((1, Rung::Double)));
    }

    #[test]
    fn each_impact_of_a_cycle_holds_to_twelve_decimals() {
        // chaotic, through rests: what narrower numbers hold of these cycles falls short by up to five digits of twelve
        let mut found = 0;
        for [g, d, r_b, r_t] in [
            [0.12201, 0.13015, 0.52915, 0.3],
            [0.12201, 0.10603, 0.57940, 0.3],
            [0.5, 0.35, 0.5, 0.5],
        ] {
            let motion = Motion::new(g, d, r_b, r_t).unwrap();
            for side in [Side::Bottom, Side::Top] {
                let Ok(cycle) = RestingCycle::find(&motion, release(&motion, side), 1000, 100).unwrap() else {
                    continue;
                };
                found += 1;
                let wide = RestingCycle {
                    number: Rung::Wide(300),
                    events: Vec::new(),
                    ..cycle.clone()
                };
                let (mut told, mut exact) = (Vec::new(), Vec::new());
                cycle.visit(&motion, |event| told.push(event.clone())).unwrap();
                wide.visit(&motion, |event| exact.push(event.clone())).unwrap();
                assert_eq!(told.len(), exact.len(), "{d} {side}");
                for (told, exact) in told.iter().zip(&exact) {
                    let apart = (told.phase - exact.phase)
                        .abs()
                        .max((told.velocity - exact.velocity).abs());
                    assert!(
                        apart < 1e-12 && told.kind == exact.kind,
                        "{d} {side}: {told:?} {exact:?}"
                    );
                }
            }
        }
        assert!(found >= 3, "{found}");
    }

    #[test]
    fn a_ball_that_does_not_come_back_has_no_cycle() {
        for (motion, side) in [
            (Motion::new(1.5, 0.35, 0.5, 0.5).unwrap(), Side::Bottom),
            (Motion::new(0.12201, 0.4, 0.5, 0.5).unwrap(), Side::Bottom),
            (Motion::new(0.0, 1e-3, 1.0, 1.0).unwrap(), Side::Top),
        ] {
            assert_eq!(periods(&motion, side), None, "{motion:?}");
        }
    }
}
