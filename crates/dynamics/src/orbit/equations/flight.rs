//! One flight under the forcing cos(phase): the laws (3) and (4), and the boundary value problem between two phases.

use crate::model::{Map, Motion, Side};
use numbers::Analytic;

/// One impact of a periodic motion, and how long the flight after it lasts.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitImpact<T> {
    /// pi t at the impact: the forcing is cos(phase). Any number of turns.
    pub phase: T,
    /// Just before the impact: positive at the bottom, negative at the top.
    pub velocity: T,
    /// Of the flight that follows; the forcing period is 2.
    pub time: T,
}

/// The flight after an impact, by (3) and (4), whether or not it would have ended at a wall before.
#[derive(Clone, Debug, PartialEq)]
pub struct HarmonicFlight<T> {
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
    /// sin(phase) and cos(phase) at the start.
    start: (T, T),
}

impl<T: Analytic> HarmonicFlight<T> {
    /// The flight of a ball launched from a wall.
    pub fn new(side: Side, phase: T, launch: T, g: T, d: T) -> Self {
        let start = phase.sincos();
        Self {
            side,
            phase,
            launch,
            g,
            d,
            start,
        }
    }

    /// The flight after an impact at a wall.
    pub fn after(motion: &Motion<T>, side: Side, impact: &OrbitImpact<T>) -> Self {
        let launch = -(motion.restitution(side).clone() * impact.velocity.clone());
        Self::new(
            side,
            impact.phase.clone(),
            launch,
            motion.g().clone(),
            motion.d().clone(),
        )
    }

    /// The phase a time `after` the start.
    pub fn phase_at(&self, after: &T) -> T {
        self.phase.clone() + T::pi() * after.clone()
    }

    /// f + g, a time `after` the start.
    pub fn acceleration(&self, after: &T) -> T {
        self.phase_at(after).sincos().1 + self.g.clone()
    }

    /// Equation (3), a time `after` the start.
    pub fn velocity(&self, after: &T) -> T {
        let gained = (self.phase_at(after).sincos().0 - self.start.0.clone()) / T::pi();
        self.launch.clone() + self.g.clone() * after.clone() + gained
    }

    /// Equation (4), a time `after` the start, from the wall it starts from.
    fn displacement(&self, after: &T) -> T {
        let pi = T::pi();
        let fall = self.g.clone() * after.clone() * T::from_ratio(1, 2);
        let drift = self.launch.clone() - self.start.0.clone() / pi.clone() + fall;
        let forced = (self.start.1.clone() - self.phase_at(after).sincos().1) / (pi.clone() * pi);
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
        let time = (end.clone() - start.clone()) / T::pi();
        let (start_sin, start_cos) = start.sincos();
        let (end_sin, end_cos) = end.sincos();
        let mean = mean(motion, map, &time, end_cos - start_cos);
        let fall = motion.g().clone() * time * T::from_ratio(1, 2);
        Self {
            launch: mean.clone() - fall.clone() + start_sin / T::pi(),
            arrival: mean + fall + end_sin / T::pi(),
        }
    }

    /// The derivatives in closed form, for the proofs: nothing of dual numbers has to be trusted over intervals.
    pub fn slopes(motion: &Motion<T>, map: Map, start: &T, end: &T) -> FlightBoundaryDerivatives<T> {
        let pi = T::pi();
        let time = (end.clone() - start.clone()) / pi.clone();
        let (start_sin, start_cos) = start.sincos();
        let (end_sin, end_cos) = end.sincos();
        let mean = mean(motion, map, &time, end_cos.clone() - start_cos.clone());
        let fall = motion.g().clone() * T::from_ratio(1, 2);
        let over = pi.clone() * time;
        let by_start = (mean.clone() + start_sin / pi.clone()) / over.clone();
        let by_end = -(mean + end_sin / pi.clone()) / over;
        FlightBoundaryDerivatives {
            launch: [
                by_start.clone() + (fall.clone() + start_cos) / pi.clone(),
                by_end.clone() - fall.clone() / pi.clone(),
            ],
            arrival: [by_start - fall.clone() / pi.clone(), by_end + (fall + end_cos) / pi],
        }
    }
}

/// The displacement, less what the forcing adds, over the time: `(climb - (F_2(end) - F_2(start))) / time`.
fn mean<T: Analytic>(motion: &Motion<T>, map: Map, time: &T, gained_cos: T) -> T {
    let climb = match (map.from(), map.to()) {
        (Side::Bottom, Side::Top) => -motion.d().clone(),
        (Side::Top, Side::Bottom) => motion.d().clone(),
        _ => T::zero(),
    };
    (climb + gained_cos / (T::pi() * T::pi())) / time.clone()
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
            let flight = HarmonicFlight::after(&motion, side, &impact);
            let (at_start, launch) = (flight.distance(side, &0.0), flight.velocity(&0.0));
            let (at_end, arrival) = (flight.distance(map.to(), &impact.time), flight.velocity(&impact.time));
            assert!(at_start == 0.0 && (launch - solved.launch).abs() < 1e-15);
            assert!(at_end.abs() < 1e-15 && (arrival - solved.arrival).abs() < 1e-14);
            let [one, other] = walls.map(|wall| flight.distance(wall, &0.3));
            assert!((one + other - motion.d()).abs() < 1e-15);
        }
    }
}
