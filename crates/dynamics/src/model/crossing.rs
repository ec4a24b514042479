//! The time at which a flight first reaches a wall.
//!
//! No time step: between two changes of sign of f + g the velocity is monotone, so the position has at most one
//! extremum there, and each rise or fall crosses a wall once or not at all.

use super::ahead::Turnings;
use super::flight::{Flight, FlightError, LONGEST_FLIGHT, State};
use super::motion::Side;
use super::root::{Bracket, Sample, root};
use numbers::Analytic;

/// Under several harmonics a flight advances by steps that are proved not to pass a wall; a flight that needs
/// more than this many of them grazes closer than the number can tell.
const MOST_STEPS: usize = 1_000_000;

/// The walls at which a flight is to end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Watch {
    /// Whichever comes first, as in the device; of one wall that.
    Both,
    /// This one alone, passing through the other: for orbits that are to be called inadmissible afterwards.
    Only(Side),
}

impl Watch {
    fn includes(self, side: Side) -> bool {
        self == Self::Both || self == Self::Only(side)
    }
}

/// Where a flight ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing<T> {
    /// The wall reached.
    pub side: Side,
    /// The time since the start of the flight.
    pub duration: T,
}

impl<T: Analytic> Flight<T> {
    /// The first time at which the flight reaches a watched wall from inside, to the precision of `T` (the error
    /// of the displacement, a few roundings, divided by the velocity of arrival). Derivative parts of a dual
    /// number are dropped: [`Leg`](super::Leg) puts them in by the implicit function theorem.
    ///
    /// # Errors
    /// `Unending`; `Undecided` for a grazing contact that rounding hides.
    pub fn crossing(&self, watch: Watch) -> Result<Crossing<T>, FlightError> {
        let watch = if self.has_top { watch } else { Watch::Only(Side::Bottom) };
        let flight = self.constant();
        match flight.ahead.turnings(&flight.g) {
            Turnings::Unknown => flight.crossing_by_steps(watch),
            Turnings::Never => {
                let period = flight.period.clone();
                flight.crossing_by_pieces(watch, |index| period.clone() * T::from_integer(index))
            }
            Turnings::Periodic {
                times: [odd, even],
                period,
            } => flight.crossing_by_pieces(watch, |index| {
                let first = if index % 2 == 1 { odd.clone() } else { even.clone() };
                first + period.clone() * T::from_integer((index - 1) / 2)
            }),
        }
    }

    /// Piece by piece between the times `end_of(1)`, `end_of(2)`, ..., on each of which the velocity is monotone.
    fn crossing_by_pieces(&self, watch: Watch, end_of: impl Fn(i64) -> T) -> Result<Crossing<T>, FlightError> {
        let longest = self.period.to_f64() * LONGEST_FLIGHT as f64;
        let mut low = T::zero();
        let mut before = self.state(&low);
        for index in 1.. {
            let high = end_of(index);
            let after = self.state(&high);
            let (v, w) = (before.velocity.to_f64(), after.velocity.to_f64());
            let mut found = None;
            if v * w < 0.0 {
                let bracket = Bracket {
                    low: &low,
                    high: &high,
                    values: [v, w],
                };
                let turn = root(&bracket, |s| self.velocity_sample(s));
                let peak = self.state(&turn);
                found = self.rise(watch, (&low, &before), (&turn, &peak));
                if found.is_none() {
                    found = self.rise(watch, (&turn, &peak), (&high, &after));
                }
            } else {
                found = found.or_else(|| self.rise(watch, (&low, &before), (&high, &after)));
            }
            if let Some(crossing) = found {
                return Ok(crossing);
            }
            let followed = high.to_f64();
            if followed >= longest || followed.is_nan() {
                break;
            }
            (low, before) = (high, after);
        }
        Err(FlightError::Unending)
    }

    /// The crossing within one rise or fall of Z, from (time, state) to (time, state).
    fn rise(&self, watch: Watch, low: (&T, &State<T>), high: (&T, &State<T>)) -> Option<Crossing<T>> {
        let climbed = high.1.displacement.clone() - low.1.displacement.clone();
        let side = if climbed.to_f64() > 0.0 {
            Side::Bottom
        } else {
            Side::Top
        };
        if !watch.includes(side) {
            return None;
        }
        let target = self.target(side);
        let beyond = |state: &State<T>| side.sign() * (state.displacement.clone() - target.clone()).to_f64();
        let values = [beyond(low.1), beyond(high.1)];
        let crosses = values[0] <= 0.0 && values[1] >= 0.0;
        // the ball leaves its own wall at the start and is not to be caught there; afterwards a start on the wall,
        // which only rounding makes of a start just inside, does count
        let launching = side == self.side && low.0.is_zero();
        if launching || !crosses {
            return None;
        }
        let values = values.map(|value| side.sign() * value);
        let bracket = Bracket {
            low: low.0,
            high: high.0,
            values,
        };
        let duration = root(&bracket, |s| self.displacement_sample(s, &target));
        Some(Crossing { side, duration })
    }

    fn velocity_sample(&self, s: &T) -> Sample<T> {
        let state = self.state(s);
        let size = self.launch.to_f64().abs() + (self.g.clone() * s.clone()).to_f64().abs();
        Sample {
            value: state.velocity,
            slope: state.acceleration,
            size,
        }
    }

    fn displacement_sample(&self, s: &T, target: &T) -> Sample<T> {
        let state = self.state(s);
        let value = state.displacement - target.clone();
        let time = s.to_f64();
        let size = (self.launch.to_f64() * time).abs() + (self.g.to_f64() * time * time).abs() + target.to_f64().abs();
        Sample {
            value,
            slope: state.velocity,
            size,
        }
    }

    /// By steps that no acceleration within the bound of |f| + |g| carries past a wall, until the wall is certain
    /// to be reached and the velocity certain not to change sign before: v² >= 2 a D.
    fn crossing_by_steps(&self, watch: Watch) -> Result<Crossing<T>, FlightError> {
        let strongest = self.ahead.bound().to_f64() + self.g.to_f64().abs();
        let longest = self.period.to_f64() * LONGEST_FLIGHT as f64;
        let mut time = T::zero();
        for _ in 0..MOST_STEPS {
            let state = self.state(&time);
            let mut step = f64::INFINITY;
            for side in [Side::Bottom, Side::Top] {
                if !watch.includes(side) {
                    continue;
                }
                let apart = side.sign() * (self.target(side) - state.displacement.clone()).to_f64();
                let towards = side.sign() * state.velocity.to_f64();
                let apart = apart.max(0.0);
                let starting = time.is_zero() && side == self.side;
                if towards > 0.0 && towards * towards >= 2.0 * strongest * apart && !starting {
                    let reach = 2.0 * apart / (towards + (towards * towards - 2.0 * strongest * apart).sqrt());
                    return Ok(self.certain(side, &time, reach));
                }
                step = step.min(if starting && towards == 0.0 {
                    self.release_step()
                } else {
                    safe_step(apart, towards, strongest)
                });
            }
            let next = time.clone() + T::from_f64(step);
            let (advance, reached) = ((next.clone() - time.clone()).to_f64(), next.to_f64());
            if reached >= longest {
                return Err(FlightError::Unending);
            }
            if advance <= 0.0 || advance.is_nan() {
                return Err(FlightError::Undecided { after: time.to_f64() });
            }
            time = next;
        }
        Err(FlightError::Undecided { after: time.to_f64() })
    }

    /// A ball released with velocity 0 into an acceleration a keeps off its wall for 3 |a| / max|f'|; a third of
    /// that is taken.
    fn release_step(&self) -> f64 {
        let push = self.push().to_f64().abs();
        push / self.ahead.bound_of_slope().to_f64()
    }

    /// The crossing known to lie within `reach` after `time`; the bracket is widened by the rounding of f64.
    fn certain(&self, side: Side, time: &T, reach: f64) -> Crossing<T> {
        let wider = reach * (1.0 + 1e-9) + time.to_f64() * T::epsilon().to_f64();
        let high = time.clone() + T::from_f64(wider);
        let target = self.target(side);
        // to first order the wall is reached half of the way at least
        let values = [-side.sign(), side.sign()];
        let bracket = Bracket {
            low: time,
            high: &high,
            values,
        };
        let duration = root(&bracket, |s| self.displacement_sample(s, &target));
        Crossing { side, duration }
    }
}

/// The longest time in which a ball at distance `apart` with velocity `towards` cannot reach a wall.
fn safe_step(apart: f64, towards: f64, strongest: f64) -> f64 {
    let reach = (towards * towards + 2.0 * strongest * apart).sqrt();
    // a thousandth less, for the rounding of these formulas and of the displacement
    let part = 0.999;
    if towards < 0.0 {
        part * (reach - towards) / strongest
    } else {
        part * 2.0 * apart / (towards + reach)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Forcing, Impact, Motion};
    use super::*;

    /// A flight without a forcing, so that everything is known by hand.
    fn thrown(g: f64, d: f64, side: Side, speed: f64) -> Flight<f64> {
        let Ok(motion) = Motion::new(g, d, 1.0, 1.0) else {
            panic!("a motion")
        };
        let Ok(forcing) = Forcing::periodic(2.0, &[], &[]) else {
            panic!("a forcing")
        };
        let impact = Impact {
            side,
            time: 0.3,
            velocity: side.sign() * speed,
        };
        let Ok(flight) = Flight::after(&motion, &forcing, &impact) else {
            panic!("a flight")
        };
        flight
    }

    fn crossing(flight: &Flight<f64>, watch: Watch) -> Option<(Side, f64)> {
        flight
            .crossing(watch)
            .ok()
            .map(|crossing| (crossing.side, crossing.duration))
    }

    #[test]
    fn a_thrown_ball_returns_or_reaches_the_other_wall() {
        // against g = 1 a speed of 1 climbs 1/2
        assert_eq!(
            crossing(&thrown(1.0, 0.6, Side::Bottom, 1.0), Watch::Both),
            Some((Side::Bottom, 2.0))
        );
        let reached = crossing(&thrown(1.0, 0.4, Side::Bottom, 1.0), Watch::Both);
        let expected = 1.0 - 0.2_f64.sqrt();
        assert!(reached.is_some_and(|(side, time)| side == Side::Top && (time - expected).abs() < 1e-15));
    }

    #[test]
    fn an_unwatched_wall_is_passed_through() {
        let through = crossing(&thrown(1.0, 0.4, Side::Bottom, 1.0), Watch::Only(Side::Bottom));
        assert_eq!(through, Some((Side::Bottom, 2.0)));
    }

    #[test]
    fn a_touch_is_a_crossing_and_a_near_miss_is_not() {
        let side = |d: f64| crossing(&thrown(1.0, d, Side::Bottom, 1.0), Watch::Both).map(|(side, _)| side);
        assert_eq!(side(0.5 - 1e-14), Some(Side::Top));
        assert_eq!(side(0.5 + 1e-14), Some(Side::Bottom));
    }

    #[test]
    fn the_shortest_return_keeps_its_digits() {
        for speed in [1e-3, 1e-8, 1e-12, 1e-100] {
            let (side, time) =
                crossing(&thrown(1.0, 0.5, Side::Bottom, speed), Watch::Both).unwrap_or((Side::Top, 0.0));
            assert_eq!(side, Side::Bottom);
            assert!((time / (2.0 * speed) - 1.0).abs() < 1e-14, "{speed}: {time}");
        }
    }

    #[test]
    fn a_ball_that_rested_leaves_when_it_is_let_go() {
        // f + g turns negative: the ball leaves the bottom from velocity 0, however many harmonics are named
        let turn = (-0.2_f64).acos() / std::f64::consts::PI;
        let Ok(motion) = Motion::new(0.2, 0.3, 0.5, 0.5) else {
            panic!("a motion")
        };
        let leaves = |forcing: &Forcing<f64>, time: f64| {
            let flight = Flight::launched(&motion, forcing, Side::Bottom, &time, 0.0).ok()?;
            crossing(&flight, Watch::Both)
        };
        let explicit = leaves(&Forcing::harmonic(&0.0), turn);
        assert!(explicit.is_some_and(|(side, time)| side == Side::Top && time > 0.5 && time < 1.5));
        let Ok(several) = Forcing::periodic(2.0, &[1.0, 1e-300], &[]) else {
            panic!("a forcing")
        };
        let (later, stepped) = (
            leaves(&Forcing::harmonic(&0.0), turn + 1e-3),
            leaves(&several, turn + 1e-3),
        );
        let (Some((_, later)), Some((side, stepped))) = (later, stepped) else {
            panic!("both leave")
        };
        assert!(side == Side::Top && (later - stepped).abs() < 1e-13);
    }
}
