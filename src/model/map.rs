//! The one-impact maps P_1 to P_4 of equation (8).

use super::flight::{Flight, FlightError, Watch};
use super::forcing::Forcing;
use super::motion::{Motion, Side};
use crate::number::Analytic;

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

/// One flight with the impacts at both ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg<T> {
    /// Where it starts.
    pub from: Impact<T>,
    /// Where it ends; its time is reduced into one forcing period.
    pub to: Impact<T>,
    /// t_{k+1} - t_k.
    pub duration: T,
}

impl<T: Analytic> Leg<T> {
    /// The leg from `impact` to `side` whose duration is already known to the precision of `T`: one Newton step
    /// on Z(duration) = wall, which in dual arithmetic is the implicit function theorem. It serves one level of
    /// dual numbers over the `T` in which `duration` was solved.
    ///
    /// # Errors
    /// Those of [`Flight::after`]; `Grazing` where the velocity of arrival is 0 within rounding.
    pub fn closed(
        motion: &Motion<T>,
        forcing: &Forcing<T>,
        impact: &Impact<T>,
        side: Side,
        duration: &T,
    ) -> Result<Self, FlightError> {
        let flight = Flight::after(motion, forcing, impact)?;
        let (duration, velocity) = arrival(&flight, side, duration)?;
        let time = forcing.reduced(&(impact.time.clone() + duration.clone()));
        Ok(Self {
            from: impact.clone(),
            to: Impact {
                side,
                time,
                velocity,
            },
            duration,
        })
    }
}

/// Duration and velocity of arrival after one Newton step.
fn arrival<T: Analytic>(
    flight: &Flight<T>,
    side: Side,
    duration: &T,
) -> Result<(T, T), FlightError> {
    let state = flight.state(duration);
    let velocity = state.velocity.to_f64();
    let speed = flight.state(&T::zero()).velocity.to_f64().abs();
    // the velocity is a sum of terms no smaller than the launch velocity, each rounded
    let noise = 4.0 * T::epsilon().to_f64() * speed;
    if side.sign() * velocity <= noise || velocity.is_nan() {
        return Err(FlightError::Grazing { side, velocity });
    }
    let step = (state.displacement - flight.target(side)) / state.velocity;
    let duration = duration.clone() - step;
    let velocity = flight.state(&duration).velocity;
    Ok((duration, velocity))
}

/// The impact that follows `impact`, at whichever wall comes first, with the flight between them.
///
/// Duration and velocity to the precision of `T`, the rounding of the displacement divided by the velocity of
/// arrival; derivative parts of (nested, up to the third order) dual numbers are those of the exact map.
/// Source: (3), (4) and (8).
///
/// # Errors
/// Those of [`Flight::after`] and [`Flight::crossing`]; `Grazing` where the map has no derivative.
pub fn next_impact<T: Analytic>(
    motion: &Motion<T>,
    forcing: &Forcing<T>,
    impact: &Impact<T>,
) -> Result<Leg<T>, FlightError> {
    leg(motion, forcing, impact, Watch::Both)
}

fn leg<T: Analytic>(
    motion: &Motion<T>,
    forcing: &Forcing<T>,
    impact: &Impact<T>,
    watch: Watch,
) -> Result<Leg<T>, FlightError> {
    let flight = Flight::after(motion, forcing, impact)?;
    let crossing = flight.crossing(watch)?;
    let side = crossing.side;
    // each Newton step doubles the order to which derivative parts are right: two serve three levels of duals
    let (duration, _) = arrival(&flight, side, &crossing.duration)?;
    let (duration, velocity) = arrival(&flight, side, &duration)?;
    let time = forcing.reduced(&(impact.time.clone() + duration.clone()));
    Ok(Leg {
        from: impact.clone(),
        to: Impact {
            side,
            time,
            velocity,
        },
        duration,
    })
}

/// The four maps of equation (8).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Map {
    /// Bottom to top.
    P1,
    /// Top to bottom.
    P2,
    /// Bottom to bottom.
    P3,
    /// Top to top.
    P4,
}

/// Why a map has no value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MapError {
    /// The impact is at the wrong wall for this map.
    #[error("{map:?} starts at the {wanted}, the impact is at the other wall", wanted = map.from())]
    Start {
        /// The map.
        map: Map,
    },
    /// The other wall is reached first.
    #[error("{map:?} ends at the {wanted}, but the flight reaches the other wall first", wanted = map.to())]
    OtherWall {
        /// The map.
        map: Map,
    },
    /// There is no such flight.
    #[error(transparent)]
    Flight(#[from] FlightError),
}

impl Map {
    /// The map between two walls.
    pub fn between(from: Side, to: Side) -> Self {
        match (from, to) {
            (Side::Bottom, Side::Top) => Self::P1,
            (Side::Top, Side::Bottom) => Self::P2,
            (Side::Bottom, Side::Bottom) => Self::P3,
            (Side::Top, Side::Top) => Self::P4,
        }
    }

    /// The wall it starts from.
    pub fn from(self) -> Side {
        if matches!(self, Self::P1 | Self::P3) {
            Side::Bottom
        } else {
            Side::Top
        }
    }

    /// The wall it ends at.
    pub fn to(self) -> Side {
        if matches!(self, Self::P2 | Self::P3) {
            Side::Bottom
        } else {
            Side::Top
        }
    }

    /// The map as the device has it: both walls stop the ball. Accuracy as [`next_impact`].
    ///
    /// # Errors
    /// `Start`, `OtherWall`, and those of [`next_impact`].
    pub fn apply<T: Analytic>(
        self,
        motion: &Motion<T>,
        forcing: &Forcing<T>,
        impact: &Impact<T>,
    ) -> Result<Leg<T>, MapError> {
        let leg = self.leg(motion, forcing, impact, Watch::Both)?;
        if leg.to.side == self.to() {
            Ok(leg)
        } else {
            Err(MapError::OtherWall { map: self })
        }
    }

    /// The map of equations (9) to (12) alone: the first arrival at its wall, whether or not the ball would have
    /// passed through the other one.
    ///
    /// # Errors
    /// `Start`, and those of [`next_impact`].
    pub fn apply_through<T: Analytic>(
        self,
        motion: &Motion<T>,
        forcing: &Forcing<T>,
        impact: &Impact<T>,
    ) -> Result<Leg<T>, MapError> {
        self.leg(motion, forcing, impact, Watch::Only(self.to()))
    }

    fn leg<T: Analytic>(
        self,
        motion: &Motion<T>,
        forcing: &Forcing<T>,
        impact: &Impact<T>,
        watch: Watch,
    ) -> Result<Leg<T>, MapError> {
        if impact.side != self.from() {
            return Err(MapError::Start { map: self });
        }
        Ok(leg(motion, forcing, impact, watch)?)
    }
}
