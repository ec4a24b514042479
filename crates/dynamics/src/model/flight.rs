//! A flight between impacts, equations (3) and (4).

use super::ahead::Ahead;
use super::forcing::Forcing;
use super::motion::{Motion, Side};
use numbers::Analytic;

/// Flights are followed for this many forcing periods. Where gravity is not 0 a flight ends by itself; without
/// gravity a ball may float for ever, and 10,000 periods of an event-free flight tell nothing more.
pub const LONGEST_FLIGHT: i64 = 10_000;

/// An impact: where, when and how fast.
#[derive(Clone, Debug, PartialEq)]
pub struct Impact<T> {
    /// The wall.
    pub side: Side,
    /// t_k; only its phase in the forcing period matters.
    pub time: T,
    /// Zdot_k just before the impact: positive at the bottom, negative at the top.
    pub velocity: T,
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
    #[error("the flight grazes the {side}: it arrives with velocity {velocity:e}")]
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
    pub(super) side: Side,
    pub(super) launch: T,
    pub(super) g: T,
    pub(super) d: T,
    pub(super) has_top: bool,
    pub(super) period: T,
    pub(super) ahead: Ahead<T>,
}

impl<T: Analytic> Flight<T> {
    /// The flight that follows `impact`: it starts with -r times the velocity of the impact.
    ///
    /// # Errors
    /// `NotFinite`, `WrongWay`, and `Rest` where the velocity is 0 and f + g does not take the ball off the wall.
    pub fn after(motion: &Motion<T>, forcing: &Forcing<T>, impact: &Impact<T>) -> Result<Self, FlightError> {
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
        if velocity == 0.0 && side.sign() * flight.push().to_f64() >= 0.0 {
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
            has_top: motion.has_top(),
            period,
            ahead,
        };
        let found = flight.push().to_f64();
        if !found.is_finite() {
            return Err(FlightError::NotFinite { name: "phase", found });
        }
        Ok(flight)
    }

    /// The wall the flight starts from.
    pub fn side(&self) -> Side {
        self.side
    }

    /// f + g at the start.
    pub(super) fn push(&self) -> T {
        self.g.clone() + self.ahead.now()
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

    /// The same without derivative parts.
    pub(super) fn constant(&self) -> Self {
        Self {
            side: self.side,
            launch: self.launch.constant(),
            g: self.g.constant(),
            d: self.d.constant(),
            has_top: self.has_top,
            period: self.period.constant(),
            ahead: self.ahead.constant(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(g: f64) -> Motion<f64> {
        let Ok(motion) = Motion::new(g, 0.4, 0.6, 0.3) else {
            panic!("a motion")
        };
        motion
    }

    fn impact(side: Side, time: f64, velocity: f64) -> Impact<f64> {
        Impact { side, time, velocity }
    }

    #[test]
    fn a_flight_is_equations_3_and_4() {
        let forcing = Forcing::harmonic(&0.3);
        let (t, v, g) = (0.7, -0.5, 0.12);
        let Ok(flight) = Flight::after(&motion(g), &forcing, &impact(Side::Top, t, v)) else {
            panic!("a flight")
        };
        for s in [0.0, 0.1, 0.6, 1.9] {
            let (start, end, state) = (forcing.at(&t), forcing.at(&(t + s)), flight.state(&s));
            let velocity = -0.3 * v + g * s + end.f1 - start.f1;
            let place = -0.2 - 0.3 * v * s + 0.5 * g * s * s + end.f2 - start.f2 - start.f1 * s;
            assert!((state.velocity - velocity).abs() < 1e-15);
            assert!((flight.position(&s) - place).abs() < 1e-15);
            assert!((state.acceleration - (end.f + g)).abs() < 1e-15);
        }
    }

    #[test]
    fn what_cannot_start_is_said() {
        let after = |impact| Flight::after(&motion(0.5), &Forcing::harmonic(&0.0), &impact).err();
        let wrong = FlightError::WrongWay {
            side: Side::Bottom,
            velocity: -0.1,
        };
        assert_eq!(after(impact(Side::Bottom, 0.0, -0.1)), Some(wrong));
        let not_finite =
            |impact, wanted| matches!(after(impact), Some(FlightError::NotFinite { name, .. }) if name == wanted);
        assert!(not_finite(impact(Side::Top, 0.0, f64::NAN), "velocity"));
        assert!(not_finite(impact(Side::Top, f64::INFINITY, -0.1), "time"));
        // f + g = 1.5 presses down onto the bottom and off the top
        assert_eq!(
            after(impact(Side::Bottom, 0.0, 0.0)),
            Some(FlightError::Rest { side: Side::Bottom })
        );
        assert_eq!(after(impact(Side::Top, 0.0, 0.0)), None);
    }
}
