//! How far a flight keeps off the walls where it turns.

use crate::orbit::equations::flight::LaunchedFlight;
use crate::orbit::inconclusive::{Inconclusive, Property, undecided};
use numbers::{Analytic, Endpoint, Field, Interval};

/// A flight between two impacts whose start and duration are enclosed. Its launch velocity is decided to lead off its wall,
/// and the velocity with which it ends to lead to a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct OrbitFlight<E: Endpoint> {
    /// The flight, as long as one looks.
    pub flight: LaunchedFlight<Interval<E>>,
    /// Until the next impact.
    pub time: Interval<E>,
}

/// The times that part a flight into pieces.
pub(crate) struct Pieces<E> {
    /// In order, without the start and the end.
    pub times: Vec<E>,
    /// True if every piece could be decided; one that could not is as small as pieces get.
    pub are_decided: bool,
}

/// The part of a flight below which pieces are not halved.
const FINEST_PIECE: f64 = 1e-9;

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
    /// as the signs at the ends say. Where f + g changes sign is explicit for one cosine: cos(phase) = -g. Under any
    /// other forcing the flight is halved until on each piece the velocity is monotone or not 0.
    ///
    /// # Errors
    /// `Undecided`, where the flight comes near to turning without doing so, or g near to 1 in size.
    pub fn clearance(&self) -> Result<Option<Interval<E>>, Inconclusive> {
        let mut nodes = vec![(Interval::from_integer(0), self.sign_at_start()?)];
        if self.flight.other_forcing().is_none() {
            for change in self.changes()? {
                if let Some(rising) = self.sign_at(&change)? {
                    nodes.push((change, rising));
                }
            }
        } else {
            let pieces = self.pieces();
            if !pieces.are_decided {
                return undecided(Property::Turning);
            }
            for time in pieces.times.into_iter().map(Interval::point) {
                let rising = sign(&self.flight.velocity(&time))?;
                nodes.push((time, rising));
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

    /// Decides the sign of the velocity just after the start: after a plastic impact, where it is 0, that of f + g.
    fn sign_at_start(&self) -> Result<bool, Inconclusive> {
        if self.flight.launch.magnitude() == E::zero() {
            return sign(&self.flight.acceleration(&Interval::from_integer(0)));
        }
        sign(&self.flight.launch)
    }

    /// Parts the flight into pieces on each of which the velocity is monotone or not 0.
    pub(crate) fn pieces(&self) -> Pieces<E> {
        let mut pieces = Pieces {
            times: Vec::new(),
            are_decided: true,
        };
        let finest = self.time.to_f64() * FINEST_PIECE;
        let mut left = vec![(E::zero(), self.time.high())];
        while let Some((low, high)) = left.pop() {
            let piece = Interval::new(low.clone(), high.clone());
            let is_simple = self.is_simple(&piece);
            if !is_simple && piece.width().to_f64() > finest {
                let middle = self.parting(&piece);
                left.extend([(middle.clone(), high), (low, middle)]);
                continue;
            }
            pieces.are_decided &= is_simple;
            if !left.is_empty() {
                pieces.times.push(high);
            }
        }
        pieces
    }

    /// Returns true if the velocity is not 0 over a piece of the flight, or monotone: from its values, and from the
    /// mean value theorem.
    fn is_simple(&self, piece: &Interval<E>) -> bool {
        let slope = self.flight.acceleration(piece);
        let middle = Interval::point(piece.midpoint());
        let velocity = || self.flight.velocity(&middle) + slope.clone() * (piece.clone() - middle.clone());
        !slope.contains_zero() || !velocity().contains_zero()
    }

    /// Returns a time near the middle of a piece, if there is one at which the velocity has a sign.
    fn parting(&self, piece: &Interval<E>) -> E {
        let at = |part: i64| {
            let ahead = (Interval::point(piece.high()) - Interval::point(piece.low())) * Interval::from_ratio(part, 16);
            (Interval::point(piece.low()) + ahead).midpoint()
        };
        let has_sign = |time: &E| !self.flight.velocity(&Interval::point(time.clone())).contains_zero();
        [8, 7, 9].into_iter().map(at).find(has_sign).unwrap_or_else(|| at(8))
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
        let flight = self.flight.convert(Analytic::to_f64);
        let (mut low, mut high) = (within.low().to_f64(), within.high().to_f64());
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if (flight.velocity(&middle) > 0.0) == rising {
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

    /// The distance from the nearer wall, or the only one, at the turning point within `turn`, by the mean value
    /// theorem: the position changes little where the velocity is 0.
    fn distance(&self, turn: &Interval<E>) -> Interval<E> {
        let middle = Interval::point(turn.midpoint());
        let moved = self.flight.velocity(turn) * (turn.clone() - middle.clone());
        let position = self.flight.position(&middle) + moved;
        let half = self.flight.d.clone() * Interval::from_ratio(1, 2);
        if !self.flight.has_top() {
            return half - position;
        }
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
    use crate::model::{Forcing, Motion, Side};
    use crate::orbit::equations::flight::OrbitImpact;
    use numbers::Sequence;
    use std::f64::consts::PI;

    fn path(side: Side, [phase, launch, time, g, d]: [f64; 5]) -> OrbitFlight<f64> {
        let [phase, launch, time, g, d] = [phase, launch, time, g, d].map(Interval::point);
        OrbitFlight {
            flight: LaunchedFlight::new(side, phase, launch, g, d),
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
    fn under_harmonics_the_clearance_is_that_of_many_sampled_points() {
        let mut sequence = Sequence::new(4);
        let (mut turning, mut straight) = (0, 0);
        for _ in 0..300 {
            let amplitudes: [f64; 6] = std::array::from_fn(|n| sequence.between(-1.0, 1.0) / (1 + n / 2) as f64);
            let [phase, launch, time, g, d] = [(0.0, 6.2), (-1.0, -0.01), (0.1, 6.0), (-1.4, 1.4), (0.05, 2.0)]
                .map(|(low, high)| sequence.between(low, high));
            let forcing = Forcing::periodic(2.0, &amplitudes[..2], &amplitudes[2..]).expect("a forcing");
            let motion = Motion::new(g, d, 1.0, 1.0).expect("a motion");
            let motion = motion.with_forcing(forcing).expect("of period 2");
            let impact = OrbitImpact {
                phase,
                velocity: -launch,
                time,
            };
            let flight = LaunchedFlight::after(&motion, Side::Bottom, &impact);
            let found = OrbitFlight {
                flight: flight.convert(|value| Interval::point(*value)),
                time: Interval::point(time),
            };
            // f, its integral and the integral of that, from the trapezoidal rule of 100,000 steps
            let steps = 100_000;
            let step = time / f64::from(steps);
            let push = |at: f64| {
                let term = |list: &[f64], wave: fn(f64) -> f64| -> f64 {
                    let terms = list.iter().zip(1..);
                    terms
                        .map(|(part, n)| part * wave(f64::from(n) * (phase + PI * at)))
                        .sum()
                };
                g + term(&amplitudes[..2], f64::cos) + term(&amplitudes[2..], f64::sin)
            };
            let (mut velocity, mut inwards, mut expected) = (launch, 0.0, f64::INFINITY);
            for index in 0..steps {
                let at = step * f64::from(index);
                let next = velocity + step * 0.5 * (push(at) + push(at + step));
                if velocity * next < 0.0 {
                    expected = f64::min(expected, f64::min(inwards, d - inwards));
                }
                inwards -= step * 0.5 * (velocity + next);
                velocity = next;
            }
            match found.clearance().expect("decided") {
                None => assert_eq!(expected, f64::INFINITY, "{flight:?}"),
                Some(clearance) => {
                    assert!(clearance.width() < 1e-12, "{clearance}");
                    assert!((clearance.to_f64() - expected).abs() < 1e-6, "{clearance} {expected}");
                }
            }
            turning += i32::from(expected.is_finite());
            straight += i32::from(expected == f64::INFINITY);
        }
        assert!(turning > 100 && straight > 20, "{turning} {straight}");
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
