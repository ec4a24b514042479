//! The equations (9) to (13) of any word, in the phases of its impacts alone.

use crate::model::{Map, Motion};
use crate::orbit::equations::flight::{FlightBoundaryDerivatives, FlightBoundaryValues, OrbitImpact};
use crate::orbit::word::Word;
use numbers::Analytic;

/// A word at a motion: as many equations as impacts, in the phases of the impacts.
///
/// Phases increase along the word, and impact m is impact 0 again, n turns later. The equation of an impact says
/// that the ball leaves with -r times the velocity it arrived with.
#[derive(Clone, Debug)]
pub struct WordEquations<T> {
    /// Parameters.
    pub motion: Motion<T>,
    /// Impacts.
    pub word: Word,
    /// n.
    pub periods: u32,
}

impl<T: Analytic> WordEquations<T> {
    /// The flights, as map and phases of start and end.
    fn flights<'a>(&'a self, phases: &'a [T]) -> impl Iterator<Item = (Map, T, T)> + 'a {
        let turns = T::from_integer(2 * i64::from(self.periods)) * T::pi();
        let end = move |index: usize| match phases.get(index) {
            Some(phase) => phase.clone(),
            None => phases[0].clone() + turns.clone(),
        };
        let maps = self.word.flights().enumerate();
        maps.map(move |(index, map)| (map, phases[index].clone(), end(index + 1)))
    }

    fn restitutions(&self) -> impl Iterator<Item = T> + '_ {
        self.word.sides().map(|side| self.motion.restitution(side).clone())
    }

    /// r times the velocity of arrival, plus the launch velocity, at each impact: 0 on an orbit.
    pub fn residuals(&self, phases: &[T]) -> Vec<T> {
        let flights = self.flights(phases);
        let flights = flights.map(|(map, start, end)| FlightBoundaryValues::new(&self.motion, map, &start, &end));
        self.missed(&flights.collect::<Vec<_>>())
    }

    fn missed(&self, leaps: &[FlightBoundaryValues<T>]) -> Vec<T> {
        let impacts = self.restitutions().zip(leaps).enumerate();
        let residual = |(index, (r, leap)): (usize, (T, &FlightBoundaryValues<T>))| {
            let before = &leaps[(index + leaps.len() - 1) % leaps.len()];
            r * before.arrival.clone() + leap.launch.clone()
        };
        impacts.map(residual).collect()
    }

    /// The derivatives of the residuals, row by row, from those of each leap.
    fn assembled(&self, slopes: &[FlightBoundaryDerivatives<T>]) -> Vec<Vec<T>> {
        let count = slopes.len();
        let mut rows = vec![vec![T::zero(); count]; count];
        for (index, r) in self.restitutions().enumerate() {
            let before = (index + count - 1) % count;
            let after = (index + 1) % count;
            let row = &mut rows[index];
            // entries of one impact add up where a word is so short that neighbours are the same impact
            let [by_start, by_end] = &slopes[before].arrival;
            row[before] += r.clone() * by_start.clone();
            row[index] += r * by_end.clone();
            let [by_start, by_end] = &slopes[index].launch;
            row[index] += by_start.clone();
            row[after] += by_end.clone();
        }
        rows
    }

    /// The residuals and their derivatives, row by row.
    pub fn linearised(&self, phases: &[T]) -> (Vec<T>, Vec<Vec<T>>) {
        let flights = self.flights(phases);
        let both = flights.map(|(map, start, end)| FlightBoundaryValues::linearised(&self.motion, map, &start, &end));
        let (values, slopes): (Vec<_>, Vec<_>) = both.unzip();
        (self.missed(&values), self.assembled(&slopes))
    }

    /// The derivatives of the residuals in closed form.
    pub fn jacobian(&self, phases: &[T]) -> Vec<Vec<T>> {
        let flights = self.flights(phases);
        let slopes: Vec<_> = flights
            .map(|(map, start, end)| FlightBoundaryValues::slopes(&self.motion, map, &start, &end))
            .collect();
        self.assembled(&slopes)
    }

    /// The impacts at these phases.
    pub fn orbit_impacts(&self, phases: &[T]) -> Vec<OrbitImpact<T>> {
        let flights = self.flights(phases);
        let leaps = flights.map(|(map, start, end)| {
            let leap = FlightBoundaryValues::new(&self.motion, map, &start, &end);
            (leap.arrival, (end - start) / T::pi())
        });
        let (mut velocities, times): (Vec<T>, Vec<T>) = leaps.unzip();
        // the flight before impact 0 is the last one
        velocities.rotate_right(1);
        let impacts = phases.iter().cloned().zip(velocities).zip(times);
        let fix = |((phase, velocity), time)| OrbitImpact { phase, velocity, time };
        impacts.map(fix).collect()
    }

    /// The same over another number.
    ///
    /// # Errors
    /// A parameter that leaves its range by rounding.
    pub fn convert<U: Analytic>(
        &self,
        convert: impl Fn(&T) -> U,
    ) -> Result<WordEquations<U>, crate::model::MotionError> {
        Ok(WordEquations {
            motion: self.motion.convert(convert)?,
            word: self.word.clone(),
            periods: self.periods,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Forcing, Impact, Side, next_impact};
    use numbers::{Dual, seeded};
    use std::f64::consts::PI;

    fn system(word: &str, periods: u32) -> WordEquations<f64> {
        WordEquations {
            motion: Motion::new(0.12, 0.3, 0.6, 0.4).expect("a motion"),
            word: word.parse().expect("a word"),
            periods,
        }
    }

    #[test]
    fn a_leap_is_the_flight_of_the_model() {
        let motion = system("BT", 1).motion;
        for (map, time, velocity) in [(Map::P1, 0.9, 1.3), (Map::P3, 0.1, 0.3)] {
            let impact = Impact {
                side: Side::Bottom,
                time,
                velocity,
            };
            let leg = next_impact(&motion, &Forcing::harmonic(&0.0), &impact).expect("a flight");
            assert_eq!(leg.to.side, map.to());
            let leap = FlightBoundaryValues::new(&motion, map, &(PI * time), &(PI * (time + leg.duration)));
            assert!((leap.launch + 0.6 * velocity).abs() < 1e-14);
            assert!((leap.arrival - leg.to.velocity).abs() < 1e-14);
        }
    }

    #[test]
    fn the_slopes_in_closed_form_are_those_of_dual_numbers() {
        for (word, phases) in [
            ("B", &[0.4][..]),
            ("BT", &[0.4, 2.0]),
            ("BTT", &[0.4, 2.0, 3.1]),
            ("BBTBTT", &[0.4, 1.1, 2.2, 3.0, 3.3, 5.5]),
        ] {
            let forcing = Forcing::periodic(2.0, &[0.7, -0.2], &[0.1, 0.3, 0.4]).expect("a forcing");
            let mut other = system(word, 2);
            other.motion = other.motion.with_forcing(forcing).expect("of period 2");
            for system in [system(word, 2), other] {
                let (residuals, in_closed_form) = system.linearised(phases);
                assert_eq!(in_closed_form, system.jacobian(phases));
                let lifted = system.convert(|value| Dual::from_re(*value)).expect("a motion");
                for column in 0..phases.len() {
                    let lift = |(i, phase): (usize, &f64)| match i == column {
                        true => seeded(*phase),
                        false => Dual::from_re(*phase),
                    };
                    let by_duals = lifted.residuals(&phases.iter().enumerate().map(lift).collect::<Vec<_>>());
                    let mut rows = by_duals.iter().zip(&in_closed_form);
                    assert!(rows.all(|(dual, row)| (dual.eps - row[column]).abs() < 1e-13), "{word}");
                }
                let plain = system.residuals(phases);
                assert!(
                    residuals.iter().zip(&plain).all(|(a, b)| (a - b).abs() < 1e-14),
                    "{word}"
                );
            }
        }
    }
}
