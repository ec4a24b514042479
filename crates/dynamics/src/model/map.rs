//! The one-impact maps P_1 to P_4 of equation (8).

use super::crossing::Watch;
use super::flight::{Flight, FlightError, Impact};
use super::forcing::Forcing;
use super::motion::{Motion, Side};
use numbers::Analytic;

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
    /// The leg from `impact` to `side` whose duration is already known to the precision of `T`: Newton steps on
    /// Z(duration) = wall, which in dual arithmetic are the implicit function theorem, up to third derivatives.
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
            to: Impact { side, time, velocity },
            duration,
        })
    }
}

/// Duration and velocity of arrival after two Newton steps. Each doubles the order to which derivative parts are
/// right, so two serve three levels of dual numbers.
fn arrival<T: Analytic>(flight: &Flight<T>, side: Side, duration: &T) -> Result<(T, T), FlightError> {
    let state = flight.state(duration);
    let velocity = state.velocity.to_f64();
    let launch = flight.launch.to_f64().abs();
    // The displacement is a sum of terms of this size, so it is off by dy = epsilon times it, and the velocity of
    // arrival by a dy / v: as much as it is itself where v² = a dy. Four roundings are allowed for.
    let noise = 4.0 * T::epsilon().to_f64();
    let size = flight.target(side).to_f64().abs() + launch * duration.to_f64().abs();
    let blurred = noise * size * state.acceleration.to_f64().abs();
    let towards = side.sign() * velocity;
    if towards <= noise * launch || velocity * velocity <= blurred || velocity.is_nan() {
        return Err(FlightError::Grazing { side, velocity });
    }
    let duration = duration.clone() - (state.displacement - flight.target(side)) / state.velocity;
    let state = flight.state(&duration);
    let step = (state.displacement - flight.target(side)) / state.velocity.clone();
    // the velocity goes along to first order in the step: the second order is beyond the third derivative
    let velocity = state.velocity - state.acceleration * step.clone();
    let after = duration.clone() - step;
    // A step that leaves the flight, or no number at all: rounding hides when the ball arrives.
    if after.to_f64() >= 0.0 {
        Ok((after, velocity))
    } else {
        Err(FlightError::Undecided {
            after: duration.to_f64(),
        })
    }
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
    let (duration, velocity) = arrival(&flight, side, &crossing.duration)?;
    let time = forcing.reduced(&(impact.time.clone() + duration.clone()));
    Ok(Leg {
        from: impact.clone(),
        to: Impact { side, time, velocity },
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

#[cfg(test)]
mod tests {
    use super::*;

    fn motion() -> Motion<f64> {
        let Ok(motion) = Motion::new(0.12201, 0.4, 0.5, 0.5) else {
            panic!("a motion")
        };
        motion
    }

    fn impact(side: Side, time: f64, velocity: f64) -> Impact<f64> {
        Impact { side, time, velocity }
    }

    #[test]
    fn every_map_leads_between_its_walls() {
        for map in [Map::P1, Map::P2, Map::P3, Map::P4] {
            assert_eq!(Map::between(map.from(), map.to()), map);
        }
    }

    #[test]
    fn a_map_says_which_wall_is_wrong() {
        let forcing = Forcing::harmonic(&0.0);
        let start = impact(Side::Bottom, 0.16, 0.83);
        assert!(
            Map::P1
                .apply(&motion(), &forcing, &start)
                .is_ok_and(|leg| leg.to.side == Side::Top)
        );
        assert_eq!(
            Map::P3.apply(&motion(), &forcing, &start),
            Err(MapError::OtherWall { map: Map::P3 })
        );
        let error = Map::P2
            .apply(&motion(), &forcing, &start)
            .map_err(|error| error.to_string());
        assert_eq!(
            error,
            Err("P2 starts at the top, the impact is at the other wall".into())
        );
        let through = Map::P3.apply_through(&motion(), &forcing, &start);
        assert!(through.is_ok_and(|leg| leg.to.side == Side::Bottom && leg.to.velocity > 0.0));
    }

    #[test]
    fn a_leg_closed_again_from_its_own_duration_stays_as_it_is() {
        let forcing = Forcing::harmonic(&0.0);
        let start = impact(Side::Bottom, 0.16, 0.83);
        let Ok(leg) = next_impact(&motion(), &forcing, &start) else {
            panic!("a leg")
        };
        let Ok(again) = Leg::closed(&motion(), &forcing, &start, leg.to.side, &leg.duration) else {
            panic!("a leg")
        };
        assert!((again.duration - leg.duration).abs() < 1e-15);
        assert!((again.to.velocity - leg.to.velocity).abs() < 1e-15);
    }

    #[test]
    fn a_grazing_arrival_has_no_derivative_and_says_so() {
        // against g = 1 alone a speed of 1 climbs exactly 1/2, to velocity 0
        let Ok(motion) = Motion::new(1.0, 0.5, 1.0, 1.0) else {
            panic!("a motion")
        };
        let Ok(forcing) = Forcing::periodic(2.0, &[], &[]) else {
            panic!("a forcing")
        };
        let leg = next_impact(&motion, &forcing, &impact(Side::Bottom, 0.0, 1.0));
        assert!(
            matches!(leg, Err(FlightError::Grazing { side: Side::Top, .. })),
            "{leg:?}"
        );
    }
}
