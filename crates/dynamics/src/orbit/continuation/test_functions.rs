//! Test functions, in f64: a change of sign along a branch brackets a bifurcation.

use crate::model::Side;
use crate::orbit::clearance::OrbitFlight;
use crate::orbit::equations::conditions::BifurcationCondition;
use crate::orbit::equations::flight::LaunchedFlight;
use crate::orbit::equations::words::WordEquations;
use crate::orbit::orbit::flight_jacobians;
use numbers::Interval;
use std::f64::consts::{PI, TAU};

/// Steps to a turning point: bisection alone would take fifty.
const MOST_STEPS: usize = 60;

/// The test functions of one motion: their signs change at bifurcations.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TestFunctions {
    /// Those of [`BifurcationCondition::MULTIPLIERS`], in that order: without poles.
    pub multipliers: [f64; 4],
    /// How often each flight goes through the bottom and through the top strictly between its ends.
    pub crossings: Vec<[usize; 2]>,
    /// The turning points of each flight.
    pub turns: Vec<Vec<TurningPoint>>,
    /// Towards the wall, of each impact.
    pub speeds: Vec<f64>,
    /// Of the flight after each.
    pub times: Vec<f64>,
}

/// Where a flight turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TurningPoint {
    /// Into the flight.
    pub after: f64,
    /// From the bottom and the top, negative beyond.
    pub distances: [f64; 2],
}

/// The walls, as distances are listed.
pub(crate) const WALLS: [Side; 2] = [Side::Bottom, Side::Top];

impl TestFunctions {
    pub fn new(system: &WordEquations<f64>, phases: &[f64]) -> Self {
        let impacts = system.orbit_impacts(phases);
        let sides: Vec<Side> = system.word.sides().collect();
        let jacobians = flight_jacobians(&sides, &system.motion, &impacts);
        let flights = sides.iter().zip(&impacts);
        let turns: Vec<Vec<TurningPoint>> = flights
            .map(|(side, impact)| turns(&LaunchedFlight::after(&system.motion, *side, impact), impact.time))
            .collect();
        let crossings = turns.iter().map(|turns| crossings(turns));
        Self {
            multipliers: BifurcationCondition::MULTIPLIERS.map(|condition| condition.multiplier_excess(&jacobians)),
            crossings: crossings.collect(),
            speeds: sides
                .iter()
                .zip(&impacts)
                .map(|(side, impact)| side.signed(impact.velocity))
                .collect(),
            times: impacts.iter().map(|impact| impact.time).collect(),
            turns,
        }
    }

    /// Whether the ball moves to its wall at every impact, and every flight takes time.
    pub fn moves(&self) -> bool {
        self.speeds.iter().chain(&self.times).all(|value| *value > 0.0)
    }

    /// The conditions met between this motion and another, an odd number of times each.
    pub fn conditions_met(&self, other: &Self) -> Vec<BifurcationCondition> {
        let multipliers = BifurcationCondition::MULTIPLIERS.iter().enumerate();
        let crossed = multipliers.filter(|(i, _)| self.multipliers[*i] * other.multipliers[*i] < 0.0);
        let mut conditions: Vec<BifurcationCondition> = crossed.map(|(_, condition)| *condition).collect();
        for (flight, (here, there)) in self.crossings.iter().zip(&other.crossings).enumerate() {
            let walls = WALLS.iter().enumerate().filter(|(i, _)| here[*i] != there[*i]);
            conditions.extend(walls.map(|(_, wall)| BifurcationCondition::Touch(flight, *wall)));
        }
        let slow = self.speeds.iter().zip(&other.speeds).enumerate();
        let slow = slow.filter(|(_, (here, there))| **here > 0.0 && **there <= 0.0);
        conditions.extend(slow.map(|(impact, _)| BifurcationCondition::ZeroVelocity(impact)));
        conditions
    }

    /// The turning point of a flight that is nearest to a wall.
    pub fn nearest(&self, flight: usize, wall: Side) -> Option<TurningPoint> {
        let index = usize::from(wall == Side::Top);
        let turns = self.turns.get(flight)?.iter().copied();
        turns.min_by(|one, other| one.distances[index].abs().total_cmp(&other.distances[index].abs()))
    }

    /// The least distance from a wall where a flight turns; infinite where none does.
    pub fn clearance(&self) -> f64 {
        let turns = self.turns.iter().flatten();
        turns.flat_map(|turn| turn.distances).fold(f64::INFINITY, f64::min)
    }
}

/// How often a flight goes through the bottom and through the top strictly between its ends, of its turning points.
pub(crate) fn crossings(turns: &[TurningPoint]) -> [usize; 2] {
    // a flight starts and ends between the walls
    std::array::from_fn(|wall| {
        let beyond = std::iter::once(false).chain(turns.iter().map(|turn| turn.distances[wall] < 0.0));
        let beyond: Vec<bool> = beyond.chain(std::iter::once(false)).collect();
        beyond.windows(2).filter(|pair| pair[0] != pair[1]).count()
    })
}

/// The turning points strictly inside a flight of this duration, in order: between two changes of sign of f + g, or on
/// the pieces of [`OrbitFlight::pieces`], the velocity has one zero or none, as its signs at the ends say.
fn turns(flight: &LaunchedFlight<f64>, time: f64) -> Vec<TurningPoint> {
    let velocity = |after: f64| flight.velocity(&after);
    let mut nodes = vec![0.0];
    if flight.other_forcing().is_some() {
        let flight = flight.convert(|value| Interval::point(*value));
        let time = Interval::point(time);
        nodes.extend(OrbitFlight { flight, time }.pieces().times);
    } else if flight.g.abs() < 1.0 {
        let reach = (-flight.g).acos();
        let end = flight.phase + PI * time;
        let first = (flight.phase / TAU).floor() as i64;
        let last = (end / TAU).ceil() as i64;
        let changes = (first..=last).flat_map(|turn| [turn as f64 * TAU - reach, turn as f64 * TAU + reach]);
        let inside = changes.filter(|phase| *phase > flight.phase && *phase < end);
        nodes.extend(inside.map(|phase| (phase - flight.phase) / PI));
    }
    nodes.push(time);
    let mut before = velocity(0.0);
    let mut turns = Vec::new();
    for pair in nodes.windows(2) {
        let after = velocity(pair[1]);
        if before * after < 0.0 {
            let slope = |after: f64| flight.acceleration(&after);
            let after = zero(velocity, slope, pair[0], pair[1], before);
            let distances = WALLS.map(|wall| match wall {
                Side::Top if !flight.has_top() => f64::INFINITY,
                wall => flight.distance(wall, &after),
            });
            turns.push(TurningPoint { after, distances });
        }
        before = after;
    }
    turns
}

/// The zero of a monotone function by Newton's method, bisecting where that leaves the bracket.
fn zero(value: impl Fn(f64) -> f64, slope: impl Fn(f64) -> f64, low: f64, high: f64, at_low: f64) -> f64 {
    let (mut low, mut high) = (low, high);
    let mut x = 0.5 * (low + high);
    for _ in 0..MOST_STEPS {
        let here = value(x);
        if here * at_low > 0.0 {
            low = x;
        } else {
            high = x;
        }
        let newton = x - here / slope(x);
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        if (next - x).abs() <= f64::EPSILON * (1.0 + x.abs()) {
            return next;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;
    use crate::orbit::options::OrbitOptions;
    use crate::orbit::solve::words::search_word;

    #[test]
    fn the_gauge_agrees_with_the_enclosures_of_a_motion() {
        let mut turning = 0;
        for (d, word, periods) in [
            (0.2, "BTT", 1),
            (0.275, "BTT", 1),
            (0.12, "BTT", 1),
            (0.2, "BTT", 2),
            (0.1, "B", 1),
        ] {
            let motion = Motion::new(0.12201, d, 0.6, 0.3).expect("a motion");
            let line = motion.convert(|value| Interval::point(*value)).expect("a motion");
            let word: crate::orbit::word::Word = word.parse().expect("a word");
            for cycle in search_word(&word, periods, &line, &OrbitOptions::DEFAULT).expect("a search") {
                let Ok(orbit) = cycle.orbit(&line) else { continue };
                let orbit = orbit.rounded();
                let system = WordEquations {
                    motion: motion.clone(),
                    word: word.clone(),
                    periods,
                };
                let functions = TestFunctions::new(&system, cycle.phases());
                assert!(functions.moves());
                let velocities: f64 = orbit.velocities.iter().product();
                let above = (orbit.trace + 1.0 + orbit.determinant) * velocities;
                assert!((functions.multipliers[0] - above).abs() < 1e-9 * (1.0 + above.abs()));
                let clearance = functions.clearance();
                assert!(clearance == orbit.clearance || (clearance - orbit.clearance).abs() < 1e-9);
                let through = functions.crossings.iter().flatten().any(|count| *count > 0);
                assert_eq!(through, !orbit.admissible);
                turning += usize::from(clearance.is_finite());
            }
        }
        assert!(turning > 3, "{turning}");
    }
}
