//! A flight between impacts, equations (3) and (4), and the time at which it first reaches a wall.
//!
//! No time step: between two changes of sign of f + g the velocity is monotone, so the position has at most one
//! extremum there, and each rise or fall crosses a wall once or not at all.

use super::forcing::{Ahead, Forcing, Turnings};
use super::map::Impact;
use super::motion::{Motion, Side};
use super::root::{Sample, root};
use crate::number::Analytic;

/// Flights are followed for this many forcing periods. Where gravity is not 0 a flight ends by itself; without
/// gravity a ball may float for ever, and 10,000 periods of an event-free flight tell nothing more.
pub const LONGEST_FLIGHT: i64 = 10_000;

/// Under several harmonics a flight advances by steps that are proved not to pass a wall; a flight that needs
/// more than this many of them grazes closer than the number can tell.
const MOST_STEPS: usize = 1_000_000;

/// The walls at which a flight is to end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Watch {
    /// Whichever comes first, as in the device.
    Both,
    /// This one alone, passing through the other: for orbits that are to be called inadmissible afterwards.
    Only(Side),
}

impl Watch {
    fn includes(self, side: Side) -> bool {
        self == Self::Both || self == Self::Only(side)
    }
}

/// Position, velocity and acceleration of the ball against the capsule.
#[derive(Clone, Debug, PartialEq)]
pub struct State<T> {
    /// Z, less its value at the start of the flight.
    pub displacement: T,
    /// Zdot, equation (3).
    pub velocity: T,
    /// f + g.
    pub acceleration: T,
}

/// Where a flight ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing<T> {
    /// The wall reached.
    pub side: Side,
    /// The time since the start of the flight.
    pub duration: T,
}

/// A flight that cannot be, or whose end cannot be told.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FlightError {
    /// NaN or infinity at the start.
    #[error("the {name} at the start of the flight is {found}, must be a finite number")]
    NotFinite {
        /// `time`, `velocity` or `phase`.
        name: &'static str,
        /// What was given.
        found: f64,
    },
    /// The impact velocity points away from the wall.
    #[error("an impact at the {side} needs a velocity towards it, not {velocity}")]
    WrongWay {
        /// The wall.
        side: Side,
        /// The velocity just before the impact.
        velocity: f64,
    },
    /// Velocity 0, and nothing that takes the ball off the wall: rest, not flight.
    #[error("the ball rests on the {side}")]
    Rest {
        /// The wall.
        side: Side,
    },
    /// No wall within [`LONGEST_FLIGHT`] periods.
    #[error("no wall is reached within {LONGEST_FLIGHT} forcing periods")]
    Unending,
    /// The wall is reached with a velocity that is 0 to the precision of the number: no derivative there.
    #[error("the flight grazes the {side}: it arrives with velocity {velocity}")]
    Grazing {
        /// The wall.
        side: Side,
        /// The velocity of arrival.
        velocity: f64,
    },
    /// Whether the wall is reached cannot be decided in this number.
    #[error("rounding cannot decide whether the flight reaches a wall after time {after}")]
    Undecided {
        /// The time since the start.
        after: f64,
    },
}

/// The motion of the ball after an impact, until it reaches a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Flight<T> {
    side: Side,
    launch: T,
    g: T,
    d: T,
    period: T,
    ahead: Ahead<T>,
}

impl<T: Analytic> Flight<T> {
    /// The flight that follows `impact`: it starts with -r times the velocity of the impact.
    ///
    /// # Errors
    /// `NotFinite`, `WrongWay`, and `Rest` where the velocity is 0 and f + g does not take the ball off the wall.
    pub fn after(
        motion: &Motion<T>,
        forcing: &Forcing<T>,
        impact: &Impact<T>,
    ) -> Result<Self, FlightError> {
        let velocity = impact.velocity.to_f64();
        if !velocity.is_finite() {
            return Err(FlightError::NotFinite {
                name: "velocity",
                found: velocity,
            });
        }
        let side = impact.side;
        if side.sign() * velocity < 0.0 {
            return Err(FlightError::WrongWay { side, velocity });
        }
        let launch = -(motion.restitution(side).clone() * impact.velocity.clone());
        let flight = Self::launched(motion, forcing, side, &impact.time, launch)?;
        if velocity == 0.0 && side.sign() * flight.state(&T::zero()).acceleration.to_f64() >= 0.0 {
            return Err(FlightError::Rest { side });
        }
        Ok(flight)
    }

    /// The flight of a ball that leaves `side` at `time` with the velocity `launch`, 0 after a rest: the caller
    /// knows that it does leave.
    ///
    /// # Errors
    /// `NotFinite`.
    pub fn launched(
        motion: &Motion<T>,
        forcing: &Forcing<T>,
        side: Side,
        time: &T,
        launch: T,
    ) -> Result<Self, FlightError> {
        for (name, found) in [("time", time.to_f64()), ("velocity", launch.to_f64())] {
            if !found.is_finite() {
                return Err(FlightError::NotFinite { name, found });
            }
        }
        let (g, d) = (motion.g().clone(), motion.d().clone());
        let (period, ahead) = (forcing.period().clone(), forcing.ahead(time));
        let flight = Self {
            side,
            launch,
            g,
            d,
            period,
            ahead,
        };
        let found = flight.state(&T::zero()).acceleration.to_f64();
        if !found.is_finite() {
            return Err(FlightError::NotFinite {
                name: "phase",
                found,
            });
        }
        Ok(flight)
    }

    /// The wall the flight starts from.
    pub fn side(&self) -> Side {
        self.side
    }

    /// Displacement (equation (4) less Z_k), velocity (3) and acceleration a time `s` after the start.
    ///
    /// Relative accuracy is kept however short `s` is.
    pub fn state(&self, s: &T) -> State<T> {
        let growth = self.ahead.growth(s);
        let gained = self.g.clone() * s.clone();
        let mean = self.launch.clone() + gained.clone() * T::from_ratio(1, 2);
        State {
            displacement: mean * s.clone() + growth.f2,
            velocity: self.launch.clone() + gained + growth.f1,
            acceleration: self.g.clone() + growth.f,
        }
    }

    /// Z itself, equation (4), a time `s` after the start.
    pub fn position(&self, s: &T) -> T {
        let start = self.side.signed(self.d.clone() * T::from_ratio(1, 2));
        start + self.state(s).displacement
    }

    /// Z at `wall` less Z at the start: what the displacement is when the flight ends there.
    pub fn target(&self, wall: Side) -> T {
        if wall == self.side {
            T::zero()
        } else {
            wall.signed(self.d.clone())
        }
    }

    /// The first time at which the flight reaches a watched wall from inside, to the precision of `T` (the error
    /// of the displacement, a few roundings, divided by the velocity of arrival). Derivative parts of a dual
    /// number are dropped: [`Leg`](super::Leg) puts them in by the implicit function theorem.
    ///
    /// # Errors
    /// `Unending`; `Undecided` for a grazing contact that rounding hides.
    pub fn crossing(&self, watch: Watch) -> Result<Crossing<T>, FlightError> {
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
                let first = if index % 2 == 1 {
                    odd.clone()
                } else {
                    even.clone()
                };
                first + period.clone() * T::from_integer((index - 1) / 2)
            }),
        }
    }

    fn constant(&self) -> Self {
        Self {
            side: self.side,
            launch: self.launch.constant(),
            g: self.g.constant(),
            d: self.d.constant(),
            period: self.period.constant(),
            ahead: self.ahead.constant(),
        }
    }

    /// Piece by piece between the times `end_of(1)`, `end_of(2)`, ..., on each of which the velocity is monotone.
    fn crossing_by_pieces(
        &self,
        watch: Watch,
        end_of: impl Fn(i64) -> T,
    ) -> Result<Crossing<T>, FlightError> {
        let longest = self.period.to_f64() * LONGEST_FLIGHT as f64;
        let mut low = T::zero();
        let mut before = self.state(&low);
        for index in 1.. {
            let high = end_of(index);
            let after = self.state(&high);
            let (v, w) = (before.velocity.to_f64(), after.velocity.to_f64());
            let mut found = None;
            if v * w < 0.0 {
                let turn = root(&low, &high, w > v, |s| self.velocity_sample(s));
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
    fn rise(
        &self,
        watch: Watch,
        low: (&T, &State<T>),
        high: (&T, &State<T>),
    ) -> Option<Crossing<T>> {
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
        let beyond =
            |state: &State<T>| side.sign() * (state.displacement.clone() - target.clone()).to_f64();
        let crosses = beyond(low.1) <= 0.0 && beyond(high.1) >= 0.0;
        // the ball leaves its own wall at the start and is not to be caught there; afterwards a start on the wall,
        // which only rounding makes of a start just inside, does count
        let launching = side == self.side && low.0.is_zero();
        if launching || !crosses {
            return None;
        }
        let rising = side == Side::Bottom;
        let duration = root(low.0, high.0, rising, |s| {
            self.displacement_sample(s, &target)
        });
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
        let size = (self.launch.to_f64() * time).abs()
            + (self.g.to_f64() * time * time).abs()
            + target.to_f64().abs();
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
                    let reach = 2.0 * apart
                        / (towards + (towards * towards - 2.0 * strongest * apart).sqrt());
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
                return Err(FlightError::Undecided {
                    after: time.to_f64(),
                });
            }
            time = next;
        }
        Err(FlightError::Undecided {
            after: time.to_f64(),
        })
    }

    /// A ball released with velocity 0 into an acceleration a keeps off its wall for 3 |a| / max|f'|; a third of
    /// that is taken.
    fn release_step(&self) -> f64 {
        let push = self.state(&T::zero()).acceleration.to_f64().abs();
        push / self.ahead.bound_of_slope().to_f64()
    }

    /// The crossing known to lie within `reach` after `time`; the bracket is widened by the rounding of f64.
    fn certain(&self, side: Side, time: &T, reach: f64) -> Crossing<T> {
        let wider = reach * (1.0 + 1e-9) + time.to_f64() * T::epsilon().to_f64();
        let high = time.clone() + T::from_f64(wider);
        let target = self.target(side);
        let duration = root(time, &high, side == Side::Bottom, |s| {
            self.displacement_sample(s, &target)
        });
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
