//! The first contact of a flight with a wall, with no time step.
//!
//! Between two zeros of f + g the distance from a wall is convex or concave, and those zeros are known beforehand.
//! So on each such piece the values at its ends decide: towards the wall that f + g presses it to, the ball arrives
//! there or not; towards the other it may dip, once, and two tangents or the very bottom of the dip decide.

use super::expansion::Expansion;
use super::flight::{Arrival, Flight, Stop};
use super::meeting::{Meeting, Stretch};
use super::waves::Waves;
use crate::model::Side;
use numbers::Analytic;
use std::f64::consts::TAU;

/// Beyond this angle a flight is not followed.
const LONGEST: f64 = 1e15;

/// A flight of more pieces than this, which touches a wall again and again as far as can be told, is not followed.
const MOST_PIECES: u32 = 20_000;

/// Dips that stay this far from a wall are not looked at more closely when whole turns are skipped.
const WELL_CLEAR: f64 = 1e-3;

/// A zero of f + g, as an angle after the departure; a whole turn of it where there is none.
struct Zero<T> {
    angle: T,
    /// The number of the turn.
    index: usize,
}

/// An end of a piece.
#[derive(Clone, Debug)]
struct End<T, W> {
    angle: T,
    there: Expansion<T, W>,
}

impl<T: Analytic, W: Waves<T>> Flight<'_, T, W> {
    /// The next contact. `recent` proposes the angle at which a flight between the two walls ends.
    #[inline]
    pub fn arrival(&self, recent: &[[f64; 2]; 2]) -> Result<Arrival<T, W>, Stop> {
        let meeting = Meeting {
            flight: self,
            recent: recent[self.from.side as usize],
        };
        let (stretch, clearance) = self.contact(&meeting)?;
        Ok(meeting.arrival(&stretch, clearance))
    }

    /// Between which angles the ball meets which wall, and the least distance of its dips before.
    #[inline]
    fn contact(&self, meeting: &Meeting<T, W>) -> Result<(Stretch, f64), Stop> {
        let mut low = End {
            angle: T::zero(),
            there: self.start.clone(),
        };
        let mut zero = self.first_zero();
        let mut clearance = f64::INFINITY;
        for piece in 1..=MOST_PIECES {
            let (high, pressed) = self.end(&zero);
            let near = self.from.side;
            let (pressing, other) = if pressed {
                (near, near.opposite())
            } else {
                (near.opposite(), near)
            };
            if self.scaled.has(other) {
                match self.dip(meeting, other, [&low, &high])? {
                    Dip::Meets(stretch) => return Ok((stretch, clearance)),
                    Dip::Clear(by) => clearance = clearance.min(by),
                }
            }
            if self.scaled.has(pressing) && self.distance(pressing, &high.there).to_f64() <= 0.0 {
                return Ok((self.stretch(pressing, [&low, &high]), clearance));
            }
            let next = self.following(&zero);
            low = high;
            zero = next;
            // after some turns in mid-air: a long flight
            if piece >= 4 && piece % 2 == 0 {
                let turns = self.turns_to_skip(low.angle.to_f64())?;
                if turns > 0 {
                    clearance = clearance.min(WELL_CLEAR);
                    let skipped = self.scaled.circle.clone() * T::from_integer(turns);
                    low.angle += skipped.clone();
                    zero.angle += skipped;
                    low.there = self.start.far(&self.g, &low.angle, low.there.waves);
                }
            }
        }
        Err(self.untold(low.angle.to_f64()))
    }

    /// The flight cannot be followed beyond an angle.
    fn untold(&self, angle: f64) -> Stop {
        let wall = self.from.side;
        Stop::Undecided { wall, angle }
    }

    /// The first zero of f + g after the departure; where there is none, a whole turn.
    fn first_zero(&self) -> Zero<T> {
        let scaled = self.scaled;
        if scaled.turns.is_empty() {
            let angle = scaled.circle.clone();
            return Zero { angle, index: 0 };
        }
        if self.from.released {
            return self.following(&self.own_release());
        }
        let phase = &self.from.phase;
        for (index, turn) in scaled.turns.iter().enumerate() {
            let angle = turn.phase.clone() - phase.clone();
            if angle.to_f64() > 0.0 {
                return Zero { angle, index };
            }
        }
        let angle = scaled.turns[0].phase.clone() - phase.clone() + scaled.circle.clone();
        Zero { angle, index: 0 }
    }

    /// The zero of f + g that is releasing the ball.
    fn own_release(&self) -> Zero<T> {
        let releases = self.scaled.turns.iter().enumerate();
        let releases = releases.filter(|(_, turn)| turn.falling == (self.from.side == Side::Bottom));
        let apart = |phase: &T| (phase.clone() - self.from.phase.clone()).to_f64().abs();
        let own = releases.min_by(|(_, one), (_, other)| apart(&one.phase).total_cmp(&apart(&other.phase)));
        Zero {
            angle: T::zero(),
            index: own.map_or(0, |(index, _)| index),
        }
    }

    fn following(&self, zero: &Zero<T>) -> Zero<T> {
        let turns = &self.scaled.turns;
        let Some(turn) = turns.get(zero.index) else {
            return Zero {
                angle: zero.angle.clone() + self.scaled.circle.clone(),
                index: 0,
            };
        };
        Zero {
            angle: zero.angle.clone() + turn.to_next.clone(),
            index: if zero.index + 1 == turns.len() {
                0
            } else {
                zero.index + 1
            },
        }
    }

    /// The end of the piece before `zero`, and whether f + g presses the ball on it to the wall it left.
    #[inline]
    fn end(&self, zero: &Zero<T>) -> (End<T, W>, bool) {
        let side = self.from.side;
        let turn = self.scaled.turns.get(zero.index);
        let pressed = match turn {
            Some(turn) => turn.falling == (side == Side::Bottom),
            // f + g is all on one side of 0
            None => self.start.push.to_f64() > 0.0,
        };
        let angle = zero.angle.clone();
        let there = if angle.to_f64() < self.scaled.reach {
            self.start.after(&angle, self.scaled.epsilon)
        } else {
            let waves = turn.map_or_else(|| self.start.waves.clone(), |turn| turn.waves.clone().seen(side));
            self.start.far(&self.g, &angle, waves)
        };
        (End { angle, there }, pressed)
    }

    /// Whether the ball dips into `wall` between two ends, away from which f + g pulls it there.
    #[inline]
    fn dip(&self, meeting: &Meeting<T, W>, wall: Side, ends: [&End<T, W>; 2]) -> Result<Dip, Stop> {
        let Stretch {
            low,
            high,
            distances: [near, far],
            approaches: [before, after],
            ..
        } = self.stretch(wall, ends);
        let is_towards = before > 0.0;
        if is_towards && far <= 0.0 {
            return Ok(Dip::Meets(self.stretch(wall, ends)));
        }
        if !is_towards || after >= 0.0 {
            return Ok(Dip::Clear(f64::INFINITY));
        }
        // the tangents at both ends meet below the bottom of the dip
        let bound = near - before * (near - far - after * (high - low)) / (before - after);
        if bound > self.noise(high) {
            return Ok(Dip::Clear(bound));
        }
        // the phase, rounded, may move the dip by as much again
        let told = self.in_f64(|flight| {
            let (angle, bottom) = Meeting {
                flight,
                recent: meeting.recent,
            }
            .bottom(wall, low, high);
            (angle, bottom, 2.0 * flight.noise(angle))
        });
        let told = told.filter(|(_, bottom, noise)| bottom.abs() > *noise);
        let (angle, bottom, noise) = told.unwrap_or_else(|| {
            let (angle, bottom) = meeting.bottom(wall, low, high);
            (angle, bottom, self.noise(angle))
        });
        if bottom > noise {
            return Ok(Dip::Clear(bottom));
        }
        if bottom >= -noise {
            return Err(Stop::Undecided { wall, angle });
        }
        Ok(Dip::Meets(Stretch {
            wall,
            low,
            high: angle,
            distances: [near, bottom],
            approaches: [before, 0.0],
        }))
    }

    /// From one end of a piece to the other, with respect to a wall.
    #[inline]
    fn stretch(&self, wall: Side, ends: [&End<T, W>; 2]) -> Stretch {
        let [low, high] = ends.map(|end| end.angle.to_f64());
        Stretch {
            wall,
            low,
            high,
            distances: ends.map(|end| self.distance(wall, &end.there).to_f64()),
            approaches: ends.map(|end| self.approach(wall, &end.there).to_f64()),
        }
    }

    /// The whole turns after `angle` for which the ball stays well clear of the walls: the mean motion, a parabola, is off
    /// by the bound of F_2 at most.
    fn turns_to_skip(&self, angle: f64) -> Result<i64, Stop> {
        let (start, g, gap) = (&self.start, self.g.to_f64(), self.scaled.gap.to_f64());
        let drift = start.w.to_f64() + start.waves.f1().to_f64();
        let base = start.waves.minus_f2().to_f64() - start.y.to_f64();
        let mean = |x: f64| (drift - 0.5 * g * x) * x - base;
        let room = self.scaled.bounds.f2 + WELL_CLEAR;
        let highest = if self.scaled.has_top { gap - room } else { f64::INFINITY };
        let mut end = f64::INFINITY;
        for level in [room, highest] {
            for root in quadratic(-0.5 * g, drift, -base - level) {
                if root > angle {
                    end = end.min(root);
                }
            }
        }
        let now = mean(angle);
        if !(now > room && now < highest) {
            return Ok(0);
        }
        if end.is_infinite() {
            return Err(Stop::Unending);
        }
        if end.is_nan() || end >= LONGEST {
            return Err(self.untold(angle));
        }
        Ok((((end - angle) / TAU).floor() - 1.0).max(0.0) as i64)
    }
}

/// What a ball does at a wall that it does not stay at.
enum Dip {
    /// It keeps away by at least so much, times pi².
    Clear(f64),
    /// It touches.
    Meets(Stretch),
}

/// The real roots of a x² + b x + c, by the form that does not cancel; NaN where there is none.
fn quadratic(a: f64, b: f64, c: f64) -> [f64; 2] {
    let root = (b * b - 4.0 * a * c).sqrt();
    let sum = -0.5 * (b + root.copysign(b));
    [sum / a, c / sum]
}
