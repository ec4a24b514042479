//! How far a flight keeps off the walls where it turns.

use crate::orbit::equations::flight::HarmonicFlight;
use crate::orbit::inconclusive::{Inconclusive, Property, undecided};
use numbers::{Analytic, Endpoint, Field, Interval};
use std::f64::consts::PI;

/// A flight between two impacts whose start and duration are enclosed. Its launch velocity is decided to lead off its wall,
/// and the velocity with which it ends to lead to a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitFlight<E: Endpoint> {
    /// The flight, as long as one looks.
    pub flight: HarmonicFlight<Interval<E>>,
    /// Until the next impact.
    pub time: Interval<E>,
}

/// More halvings than any number of use has bits.
const MOST_STEPS: usize = 400;

/// Halvings that take f64 from any time of use well inside what the proof looks at.
const HALVINGS: usize = 40;

/// More than f64 loses of a number of turns.
const ROUNDING: f64 = 1e-6;

/// About a turning point proposed in f64 the proof looks this far: well above its rounding, well below a flight.
const PROPOSED: f64 = 1e-9;

impl<E: Endpoint> OrbitFlight<E> {
    /// The least distance from a wall over the turning points strictly inside the flight, negative beyond the wall;
    /// `None` where the flight does not turn.
    ///
    /// Between two changes of sign of f + g the velocity is monotone and the flight turns there once or not at all,
    /// as the signs at the ends say. Where f + g changes sign is explicit: cos(phase) = -g.
    ///
    /// # Errors
    /// `Undecided`, where the flight comes near to turning without doing so, or g near to 1 in size.
    pub fn clearance(&self) -> Result<Option<Interval<E>>, Inconclusive> {
        let mut nodes = vec![(Interval::from_integer(0), sign(&self.flight.launch)?)];
        for change in self.changes()? {
            if let Some(rising) = self.sign_at(&change)? {
                nodes.push((change, rising));
            }
        }
        nodes.push((self.time.clone(), sign(&self.flight.velocity(&self.time))?));
        let mut clearance = None;
        for pair in nodes.windows(2) {
            let [(low, before), (high, after)] = pair else { continue };
            if before != after {
                let turn = self.turn(&Interval::new(low.low(), high.high()), *after)?;
                clearance = least(clearance, Some(self.distance(&turn)));
            }
        }
        Ok(clearance)
    }

    /// The times at which f + g changes sign, in order; all that may lie inside the flight, and some outside.
    fn changes(&self) -> Result<Vec<Interval<E>>, Inconclusive> {
        let one = || Interval::<E>::from_integer(1);
        let g = &self.flight.g;
        let [above, below] = [g.clone() - one(), -g.clone() - one()];
        // g = 1 itself belongs here: f + g touches 0 and keeps its sign
        if above.low() >= E::zero() || below.low() >= E::zero() {
            return Ok(Vec::new());
        }
        if !(above.is_negative() && below.is_negative()) {
            return undecided(Property::Turning);
        }
        let reach = (-g.clone()).acos();
        let (pi, turn) = (Interval::<E>::pi(), Interval::<E>::pi() + Interval::pi());
        let start = self.flight.phase.to_f64() / turn.to_f64();
        let end = start + self.time.to_f64() / 2.0;
        let part = reach.to_f64() / turn.to_f64();
        let mut changes = Vec::new();
        for index in start.floor() as i64..=end.ceil() as i64 {
            for (angle, part) in [(-reach.clone(), -part), (reach.clone(), part)] {
                // in turns, to rounding: what is farther outside than that does not count
                let at = index as f64 + part;
                if at > start - ROUNDING && at < end + ROUNDING {
                    let whole = turn.clone() * Interval::from_integer(index);
                    changes.push((whole + angle - self.flight.phase.clone()) / pi.clone());
                }
            }
        }
        Ok(changes)
    }

    /// Where bisection in f64, at the middle of all intervals, puts the turning point.
    fn proposal(&self, within: &Interval<E>, rising: bool) -> f64 {
        let [phase, launch, g] = [&self.flight.phase, &self.flight.launch, &self.flight.g].map(Analytic::to_f64);
        let start = phase.sin();
        let (mut low, mut high) = (within.low().to_f64(), within.high().to_f64());
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let velocity = launch + g * middle + ((phase + PI * middle).sin() - start) / PI;
            if (velocity > 0.0) == rising {
                high = middle;
            } else {
                low = middle;
            }
        }
        0.5 * (low + high)
    }

    /// The sign of the velocity at a change of sign of f + g, if that lies inside the flight. If it may be either
    /// side of an end, the velocity must have one sign from there to the end: then the change makes no difference.
    fn sign_at(&self, change: &Interval<E>) -> Result<Option<bool>, Inconclusive> {
        let after = change.clone() - self.time.clone();
        if change.high() <= E::zero() || after.low() >= E::zero() {
            return Ok(None);
        }
        if change.is_positive() && after.is_negative() {
            return sign(&self.flight.velocity(change)).map(Some);
        }
        let start = Interval::from_integer(0);
        let end = if change.is_positive() { &self.time } else { &start };
        sign(&self.flight.velocity(&change.hull(end))).map(|_| None)
    }

    /// An enclosure of the one time in `within` at which the velocity, monotone there, is 0; `rising` says how it
    /// changes its sign.
    fn turn(&self, within: &Interval<E>, rising: bool) -> Result<Interval<E>, Inconclusive> {
        let proposal = Interval::<E>::from_f64(self.proposal(within, rising));
        let around = proposal + Interval::new(E::from_f64(-PROPOSED), E::from_f64(PROPOSED));
        let mut turn = within.clone();
        if around.is_inside(within) {
            self.cut(&mut turn, around.low(), rising);
            self.cut(&mut turn, around.high(), rising);
        }
        for _ in 0..MOST_STEPS {
            let before = turn.width();
            let middle = turn.midpoint();
            let slope = self.flight.acceleration(&turn);
            if slope.contains_zero() {
                self.cut(&mut turn, middle, rising);
            } else {
                let point = Interval::point(middle);
                let newton = point.clone() - self.flight.velocity(&point) / slope;
                turn = newton.intersection(&turn).unwrap_or(turn);
                // what Newton does not halve is rounding, and the width of the parameters
                if turn.width() + turn.width() > before {
                    return Ok(turn);
                }
            }
            // the middle may be the very point: the quarters are then decided, if anything is
            if turn.width() >= before {
                let (lower, upper) = turn.halves();
                self.cut(&mut turn, lower.midpoint(), rising);
                self.cut(&mut turn, upper.midpoint(), rising);
            }
            if turn.width() >= before {
                return Ok(turn);
            }
        }
        undecided(Property::Turning)
    }

    /// Leaves off what lies on the wrong side of the time `at`, if the velocity there has a sign.
    fn cut(&self, turn: &mut Interval<E>, at: E, rising: bool) {
        let velocity = self.flight.velocity(&Interval::point(at.clone()));
        if !turn.contains(&at) || velocity.contains_zero() {
            return;
        }
        *turn = if velocity.is_positive() == rising {
            Interval::new(turn.low(), at)
        } else {
            Interval::new(at, turn.high())
        };
    }

    /// The distance from the nearer wall at the turning point within `turn`, by the mean value theorem: the
    /// position changes little where the velocity is 0.
    fn distance(&self, turn: &Interval<E>) -> Interval<E> {
        let middle = Interval::point(turn.midpoint());
        let moved = self.flight.velocity(turn) * (turn.clone() - middle.clone());
        let position = self.flight.position(&middle) + moved;
        let half = self.flight.d.clone() * Interval::from_ratio(1, 2);
        smaller(half.clone() - position.clone(), half + position)
    }
}

/// The lesser of two clearances, of which either may be none.
pub(crate) fn least<E: Endpoint>(one: Option<Interval<E>>, other: Option<Interval<E>>) -> Option<Interval<E>> {
    match (one, other) {
        (Some(one), Some(other)) => Some(smaller(one, other)),
        (one, other) => one.or(other),
    }
}

/// The minimum of two numbers, each anywhere in its interval.
fn smaller<E: Endpoint>(one: Interval<E>, other: Interval<E>) -> Interval<E> {
    let min = |a: E, b: E| if a <= b { a } else { b };
    Interval::new(min(one.low(), other.low()), min(one.high(), other.high()))
}

/// Whether a velocity is positive.
fn sign<E: Endpoint>(velocity: &Interval<E>) -> Result<bool, Inconclusive> {
    if velocity.contains_zero() {
        return undecided(Property::Turning);
    }
    Ok(velocity.is_positive())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Side;
    use numbers::Sequence;

    fn path(side: Side, [phase, launch, time, g, d]: [f64; 5]) -> OrbitFlight<f64> {
        let [phase, launch, time, g, d] = [phase, launch, time, g, d].map(Interval::point);
        OrbitFlight {
            flight: HarmonicFlight::new(side, phase, launch, g, d),
            time,
        }
    }

    /// The same from 40,000 points of the flight.
    fn sampled(side: Side, [phase, launch, time, g, d]: [f64; 5]) -> f64 {
        let velocity = |s: f64| launch + g * s + ((phase + PI * s).sin() - phase.sin()) / PI;
        let position = |s: f64| {
            let forced = (phase.cos() - (phase + PI * s).cos()) / (PI * PI) - phase.sin() / PI * s;
            side.sign() * d / 2.0 + launch * s + g * s * s / 2.0 + forced
        };
        let steps = 40_000;
        let at = |step: i32| time * f64::from(step) / f64::from(steps);
        let turns = (0..steps).filter(|step| velocity(at(*step)) * velocity(at(step + 1)) < 0.0);
        let distance = |step| d / 2.0 - position(0.5 * (at(step) + at(step + 1))).abs();
        turns.map(distance).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn the_clearance_is_that_of_many_sampled_points() {
        let mut sequence = Sequence::new(3);
        let (mut turning, mut beyond, mut straight) = (0, 0, 0);
        for _ in 0..400 {
            let side = if sequence.draw() & 1 == 0 {
                Side::Bottom
            } else {
                Side::Top
            };
            let ranges = [(0.0, 6.2), (0.01, 1.0), (0.1, 6.0), (-1.4, 1.4), (0.05, 2.0)];
            let mut values = ranges.map(|(low, high)| sequence.between(low, high));
            values[1] *= -side.sign();
            let expected = sampled(side, values);
            let found = path(side, values).clearance().expect("decided");
            match found {
                None => assert_eq!(expected, f64::INFINITY, "{values:?}"),
                Some(clearance) => {
                    assert!(clearance.width() < 1e-12, "{clearance} {values:?}");
                    // a sampled extremum is off by the square of the step
                    assert!((clearance.to_f64() - expected).abs() < 1e-7, "{clearance} {expected}");
                }
            }
            turning += i32::from(expected > 0.0 && expected.is_finite());
            beyond += i32::from(expected < 0.0);
            straight += i32::from(expected == f64::INFINITY);
        }
        assert!(
            turning > 20 && beyond > 20 && straight > 20,
            "{turning} {beyond} {straight}"
        );
    }

    #[test]
    fn a_turning_point_in_the_very_middle_of_its_piece_is_found() {
        // B at r = 1: the flight is the mirror image of itself, and turns after half of its time
        let clearance = path(Side::Bottom, [PI, -0.12, 2.0, 0.12, 0.3]).clearance();
        let clearance = clearance.expect("decided").expect("a turning point");
        let by_hand = 0.3 - (0.06 + 2.0 / (PI * PI));
        assert!(clearance.contains(&by_hand) || (clearance.to_f64() - by_hand).abs() < 1e-15);
        assert!(clearance.width() < 1e-14);
    }

    #[test]
    fn a_flight_that_all_but_turns_is_left_undecided() {
        // released from a double zero of the velocity, up to the width of the intervals
        let mut near = path(Side::Bottom, [0.0, -0.5, 1.5, 0.0, 1.0]);
        // without gravity the velocity is largest at sin(phase) = 1, where it is launch + 1/pi
        near.flight.launch = Interval::new(-1.0 / PI - 1e-9, -1.0 / PI + 1e-9);
        let what = Property::Turning;
        assert_eq!(near.clearance(), Err(Inconclusive::Undecided { what }));
        near.flight.launch = Interval::point(-1.0 / PI - 1e-6);
        assert_eq!(near.clearance(), Ok(None));
        near.flight.launch = Interval::point(-1.0 / PI + 1e-6);
        assert!(near.clearance().is_ok_and(|clearance| clearance.is_some()));
    }

    #[test]
    fn gravity_of_size_one_is_decided_and_around_it_is_not() {
        let mut path = path(Side::Bottom, [0.4, -0.5, 1.5, 1.0, 1.0]);
        assert!(path.clearance().is_ok_and(|clearance| clearance.is_some()));
        path.flight.g = Interval::new(1.0 - 1e-9, 1.0 + 1e-9);
        assert!(path.clearance().is_err());
    }
}
