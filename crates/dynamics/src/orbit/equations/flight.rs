//! One flight under the forcing of the motion: the laws (3) and (4), and the boundary value problem between two phases.

use crate::model::{Forcing, Map, Motion, Side};
use numbers::Analytic;
use std::sync::Arc;

/// One impact of a periodic motion, and how long the flight after it lasts.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitImpact<T> {
    /// pi t at the impact: the forcing of the paper is cos(phase). Any number of turns.
    pub phase: T,
    /// Just before the impact: positive at the bottom, negative at the top.
    pub velocity: T,
    /// Of the flight that follows; the forcing period is 2.
    pub time: T,
}

/// The forcing at one phase, scaled so that for the paper's cos(phase) no value needs a division.
pub(crate) struct ScaledForcing<T> {
    /// f; cos(phase) for the paper's forcing.
    pub f: T,
    /// pi F_1; sin(phase).
    pub first: T,
    /// -pi^2 F_2; cos(phase).
    pub second: T,
}

impl<T: Analytic> ScaledForcing<T> {
    /// Evaluates the forcing at a phase: cos(phase), or another one of period 2, whose harmonic n turns with n times
    /// the phase.
    pub fn new(other: Option<&Forcing<T>>, phase: &T) -> Self {
        let Some(forcing) = other else {
            let (sin, cos) = phase.sincos();
            return Self {
                f: cos.clone(),
                first: sin,
                second: cos,
            };
        };
        let [mut f, mut first, mut second] = [T::zero(), T::zero(), T::zero()];
        for (order, cosine, sine) in forcing.harmonics() {
            let (sin, cos) = (T::from_integer(order) * phase.clone()).sincos();
            let along = cosine.clone() * cos.clone() + sine.clone() * sin.clone();
            let across = cosine.clone() * sin - sine.clone() * cos;
            f += along.clone();
            first += across * T::from_ratio(1, order);
            second += along * T::from_ratio(1, order * order);
        }
        Self { f, first, second }
    }
}

/// The flight after an impact, by (3) and (4), whether or not it would have ended at a wall before.
#[derive(Clone, Debug, PartialEq)]
pub struct LaunchedFlight<T> {
    /// The wall it starts from.
    pub side: Side,
    /// At the start.
    pub phase: T,
    /// The velocity just after the impact it starts from.
    pub launch: T,
    /// Gravity.
    pub g: T,
    /// The gap.
    pub d: T,
    /// True if there is a wall at the top.
    has_top: bool,
    /// pi F_1 and -pi^2 F_2 at the start.
    start: (T, T),
    /// The forcing, if it is not cos(phase).
    forcing: Option<Arc<Forcing<T>>>,
}

impl<T: Analytic> LaunchedFlight<T> {
    /// The flight of a ball launched from one of two walls, under the forcing cos(phase).
    pub fn new(side: Side, phase: T, launch: T, g: T, d: T) -> Self {
        let start = phase.sincos();
        Self {
            side,
            phase,
            launch,
            g,
            d,
            has_top: true,
            start,
            forcing: None,
        }
    }

    /// The flight after an impact at a wall, under the forcing of the motion.
    pub fn after(motion: &Motion<T>, side: Side, impact: &OrbitImpact<T>) -> Self {
        let phase = impact.phase.clone();
        let ScaledForcing { first, second, .. } = ScaledForcing::new(motion.other_forcing(), &phase);
        Self {
            side,
            phase,
            launch: -(motion.restitution(side).clone() * impact.velocity.clone()),
            g: motion.g().clone(),
            d: motion.d().clone(),
            has_top: motion.has_top(),
            start: (first, second),
            forcing: motion.shared_forcing(),
        }
    }

    /// Returns the forcing, if it is not cos(phase).
    pub fn other_forcing(&self) -> Option<&Forcing<T>> {
        self.forcing.as_deref()
    }

    /// Returns true if there is a wall at the top.
    pub fn has_top(&self) -> bool {
        self.has_top
    }

    /// Converts the flight to another number.
    pub(crate) fn convert<U: Analytic>(&self, convert: impl Fn(&T) -> U) -> LaunchedFlight<U> {
        LaunchedFlight {
            side: self.side,
            phase: convert(&self.phase),
            launch: convert(&self.launch),
            g: convert(&self.g),
            d: convert(&self.d),
            has_top: self.has_top,
            start: (convert(&self.start.0), convert(&self.start.1)),
            forcing: self.forcing.as_ref().map(|forcing| Arc::new(forcing.convert(&convert))),
        }
    }

    /// The phase a time `after` the start.
    pub fn phase_at(&self, after: &T) -> T {
        self.phase.clone() + T::pi() * after.clone()
    }

    fn forcing_at(&self, after: &T) -> ScaledForcing<T> {
        ScaledForcing::new(self.other_forcing(), &self.phase_at(after))
    }

    /// f + g, a time `after` the start.
    pub fn acceleration(&self, after: &T) -> T {
        self.forcing_at(after).f + self.g.clone()
    }

    /// Equation (3), a time `after` the start.
    pub fn velocity(&self, after: &T) -> T {
        let gained = (self.forcing_at(after).first - self.start.0.clone()) / T::pi();
        self.launch.clone() + self.g.clone() * after.clone() + gained
    }

    /// Equation (4), a time `after` the start, from the wall it starts from.
    fn displacement(&self, after: &T) -> T {
        let pi = T::pi();
        let fall = self.g.clone() * after.clone() * T::from_ratio(1, 2);
        let drift = self.launch.clone() - self.start.0.clone() / pi.clone() + fall;
        let forced = (self.start.1.clone() - self.forcing_at(after).second) / (pi.clone() * pi);
        drift * after.clone() + forced
    }

    /// Z by equation (4), a time `after` the start.
    pub fn position(&self, after: &T) -> T {
        self.side.signed(self.d.clone() * T::from_ratio(1, 2)) + self.displacement(after)
    }

    /// The distance from a wall, a time `after` the start: negative beyond it.
    pub fn distance(&self, wall: Side, after: &T) -> T {
        let inwards = -self.side.signed(self.displacement(after));
        if wall == self.side {
            inwards
        } else {
            self.d.clone() - inwards
        }
    }
}

/// A flight between two given phases. That it ends at its wall, (10), (12) or the same with displacement 0 for P_3
/// and P_4, is linear in the launch velocity and gives it; (9), (11) then give the velocity of arrival.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightBoundaryValues<T> {
    /// Just after the impact it starts from.
    pub launch: T,
    /// Just before the impact it ends with.
    pub arrival: T,
}

/// The derivatives of a leap by the phases of its start and end, in this order.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightBoundaryDerivatives<T> {
    /// Of the launch velocity.
    pub launch: [T; 2],
    /// Of the velocity of arrival.
    pub arrival: [T; 2],
}

impl<T: Analytic> FlightBoundaryValues<T> {
    /// The flight of `map` from phase `start` to phase `end`, further on by pi times its duration.
    pub fn new(motion: &Motion<T>, map: Map, start: &T, end: &T) -> Self {
        BoundaryTerms::new(motion, map, start, end).values()
    }

    /// The derivatives in closed form, for the proofs: nothing of dual numbers has to be trusted over intervals.
    pub fn slopes(motion: &Motion<T>, map: Map, start: &T, end: &T) -> FlightBoundaryDerivatives<T> {
        BoundaryTerms::new(motion, map, start, end).slopes()
    }

    /// Computes the flight and its derivatives.
    pub fn linearised(motion: &Motion<T>, map: Map, start: &T, end: &T) -> (Self, FlightBoundaryDerivatives<T>) {
        let terms = BoundaryTerms::new(motion, map, start, end);
        (terms.values(), terms.slopes())
    }
}

/// Terms that the values and the derivatives of a flight between two phases share.
struct BoundaryTerms<T> {
    time: T,
    g: T,
    mean: T,
    start: ScaledForcing<T>,
    end: ScaledForcing<T>,
}

impl<T: Analytic> BoundaryTerms<T> {
    fn new(motion: &Motion<T>, map: Map, start: &T, end: &T) -> Self {
        let time = (end.clone() - start.clone()) / T::pi();
        let [start, end] = [start, end].map(|phase| ScaledForcing::new(motion.other_forcing(), phase));
        Self {
            mean: mean(motion, map, &time, end.second.clone() - start.second.clone()),
            g: motion.g().clone(),
            time,
            start,
            end,
        }
    }

    fn values(&self) -> FlightBoundaryValues<T> {
        let Self {
            time,
            g,
            mean,
            start,
            end,
        } = self;
        let fall = g.clone() * time.clone() * T::from_ratio(1, 2);
        FlightBoundaryValues {
            launch: mean.clone() - fall.clone() + start.first.clone() / T::pi(),
            arrival: mean.clone() + fall + end.first.clone() / T::pi(),
        }
    }

    fn slopes(&self) -> FlightBoundaryDerivatives<T> {
        let Self {
            time,
            g,
            mean,
            start,
            end,
        } = self;
        let pi = T::pi();
        let fall = g.clone() * T::from_ratio(1, 2);
        let over = pi.clone() * time.clone();
        let by_start = (mean.clone() + start.first.clone() / pi.clone()) / over.clone();
        let by_end = -(mean.clone() + end.first.clone() / pi.clone()) / over;
        FlightBoundaryDerivatives {
            launch: [
                by_start.clone() + (fall.clone() + start.f.clone()) / pi.clone(),
                by_end.clone() - fall.clone() / pi.clone(),
            ],
            arrival: [
                by_start - fall.clone() / pi.clone(),
                by_end + (fall + end.f.clone()) / pi,
            ],
        }
    }
}

/// The displacement, less what the forcing adds, over the time: `(climb - (F_2(end) - F_2(start))) / time`.
fn mean<T: Analytic>(motion: &Motion<T>, map: Map, time: &T, gained: T) -> T {
    let climb = match (map.from(), map.to()) {
        (Side::Bottom, Side::Top) => -motion.d().clone(),
        (Side::Top, Side::Bottom) => motion.d().clone(),
        _ => T::zero(),
    };
    (climb + gained / (T::pi() * T::pi())) / time.clone()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flight_is_at_its_walls_where_it_starts_and_ends() {
        let motion = Motion::new(0.12, 0.3, 0.6, 0.4).expect("a motion");
        let walls = [Side::Bottom, Side::Top];
        for (map, start, end) in [
            (Map::P1, 0.4, 2.0),
            (Map::P2, 2.0, 5.1),
            (Map::P3, 0.4, 3.0),
            (Map::P4, 1.0, 4.0),
        ] {
            let solved = FlightBoundaryValues::new(&motion, map, &start, &end);
            let side = map.from();
            let impact = OrbitImpact {
                phase: start,
                velocity: -solved.launch / motion.restitution(side),
                time: (end - start) / std::f64::consts::PI,
            };
            let flight = LaunchedFlight::after(&motion, side, &impact);
            let (at_start, launch) = (flight.distance(side, &0.0), flight.velocity(&0.0));
            let (at_end, arrival) = (flight.distance(map.to(), &impact.time), flight.velocity(&impact.time));
            assert!(at_start == 0.0 && (launch - solved.launch).abs() < 1e-15);
            assert!(at_end.abs() < 1e-15 && (arrival - solved.arrival).abs() < 1e-14);
            let [one, other] = walls.map(|wall| flight.distance(wall, &0.3));
            assert!((one + other - motion.d()).abs() < 1e-15);
        }
    }
}
