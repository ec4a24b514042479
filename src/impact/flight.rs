//! The flight from a wall to the next contact, with no time step.
//!
//! Between two zeros of f + g the distance from a wall is convex or concave, and those zeros are explicit: cos = -g.
//! So on each such piece the values at its ends decide: towards the wall that f + g presses it to, the ball arrives
//! there or not; towards the other it may dip, once, and two tangents or the very bottom of the dip decide.

use super::expansion::{Expansion, seen};
use super::meeting::{Meeting, Stretch};
use super::scaled::{Departure, Scaled};
use crate::model::Side;
use crate::number::Analytic;
use std::f64::consts::TAU;

/// Beyond this angle a flight is not followed.
const LONGEST: f64 = 1e15;

/// A flight of more pieces than this, which touches a wall again and again as far as can be told, is not followed.
const MOST_PIECES: u32 = 20_000;

/// Dips that stay this far from a wall are not looked at more closely when whole turns are skipped.
const WELL_CLEAR: f64 = 1e-3;

/// The end of a flight.
#[derive(Clone, Debug)]
pub(super) struct Arrival<T> {
    /// The wall.
    pub side: Side,
    /// The angle of the forcing since the departure.
    pub angle: T,
    /// The flight there, as seen from the wall that was left; `w` points towards the wall.
    pub there: Expansion<T>,
    /// The least distance of a dip from a wall, times pi²; infinite where there was none, a lower bound else.
    pub clearance: f64,
}

/// Why a flight has no end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stop {
    /// Rounding hides whether the ball touches this wall, about so far after the departure.
    Undecided { wall: Side, angle: f64 },
    /// The ball meets no wall any more.
    Unending,
}

/// A flight: where it starts, and the walls as seen from there.
#[derive(Debug)]
pub(super) struct Flight<'a, T> {
    pub scaled: &'a Scaled<T>,
    pub from: &'a Departure<T>,
    pub start: Expansion<T>,
    /// g as seen from the wall that was left.
    pub g: T,
}

/// A zero of f + g, as an angle after the departure.
struct Zero<T> {
    angle: T,
    /// From + to -, so that the bottom presses before and releases after.
    falling: bool,
}

/// An end of a piece.
#[derive(Clone, Debug)]
struct End<T> {
    angle: T,
    there: Expansion<T>,
}

impl<'a, T: Analytic> Flight<'a, T> {
    pub fn new(scaled: &'a Scaled<T>, from: &'a Departure<T>) -> Self {
        Self {
            scaled,
            from,
            start: Expansion::start(scaled, from),
            g: from.side.signed(scaled.g.clone()),
        }
    }

    /// What the same flight in f64 says, where the number is a wider one: what f64 can tell need not be computed in that.
    pub fn in_f64<R>(&self, ask: impl FnOnce(&Flight<f64>) -> R) -> Option<R> {
        let scaled = self.scaled.narrow.as_deref()?;
        let [phase, sin, cos, speed] =
            [&self.from.phase, &self.from.sin, &self.from.cos, &self.from.speed].map(T::to_f64);
        let from = Departure {
            side: self.from.side,
            phase,
            sin,
            cos,
            speed,
            released: self.from.released,
        };
        let [y, w, push, sin, cos] = [
            &self.start.y,
            &self.start.w,
            &self.start.push,
            &self.start.sin,
            &self.start.cos,
        ]
        .map(T::to_f64);
        Some(ask(&Flight {
            scaled,
            from: &from,
            start: Expansion { y, w, push, sin, cos },
            g: self.g.to_f64(),
        }))
    }

    /// The next contact. `recent` proposes the angle at which a flight between the two walls ends.
    #[inline]
    pub fn arrival(&self, recent: &[[f64; 2]; 2]) -> Result<Arrival<T>, Stop> {
        let meeting = Meeting {
            flight: self,
            recent: recent[self.from.side as usize],
        };
        let (stretch, clearance) = self.contact(&meeting)?;
        Ok(meeting.arrival(&stretch, clearance))
    }

    /// Between which angles the ball meets which wall, and the least distance of its dips before.
    #[inline]
    fn contact(&self, meeting: &Meeting<T>) -> Result<(Stretch, f64), Stop> {
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
            match self.dip(meeting, other, [&low, &high])? {
                Dip::Meets(stretch) => return Ok((stretch, clearance)),
                Dip::Clear(by) => clearance = clearance.min(by),
            }
            if self.distance(pressing, &high.there).to_f64() <= 0.0 {
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
                    low.there = self.start.far(&self.g, &low.angle, low.there.sin, low.there.cos);
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

    /// Whether a ball without velocity stays: f + g presses it to the wall, or, 0 as far as rounding can tell, is about to.
    pub fn starts_at_rest(&self) -> bool {
        let start = &self.start;
        let push = start.push.to_f64();
        let turns_to_press = push.abs() <= 4.0 * self.scaled.epsilon && start.sin.to_f64() < 0.0;
        start.w.is_zero() && !self.from.released && (push > 0.0 || turns_to_press)
    }

    /// The distance from a wall, seen from the one that was left.
    pub fn distance(&self, wall: Side, there: &Expansion<T>) -> T {
        if wall == self.from.side {
            there.y.clone()
        } else {
            self.scaled.gap.clone() - there.y.clone()
        }
    }

    /// The rate at which the ball approaches a wall.
    pub fn approach(&self, wall: Side, there: &Expansion<T>) -> T {
        if wall == self.from.side {
            -there.w.clone()
        } else {
            there.w.clone()
        }
    }

    /// How far rounding may have moved `y` at an angle after the departure.
    pub fn noise(&self, angle: f64) -> f64 {
        let start = &self.start;
        let bent = 0.5 * angle * angle;
        let size = if angle < super::swing::REACH {
            // terms of the series; the push, and with it the second, has an absolute error
            start.w.to_f64() * angle + bent
        } else {
            let drift = start.w.to_f64() + start.sin.to_f64();
            drift.abs() * angle + self.g.to_f64().abs() * bent + 2.0
        };
        4.0 * self.scaled.epsilon * size
    }

    /// The first zero of f + g after the departure; where there is none, a whole turn.
    fn first_zero(&self) -> Zero<T> {
        let scaled = self.scaled;
        let Some(turn) = &scaled.turn else {
            return Zero {
                angle: scaled.circle.clone(),
                falling: scaled.g.to_f64() > 0.0,
            };
        };
        if self.from.released {
            // the bottom releases where f + g falls through 0, and the other zero comes next
            let falling = self.from.side == Side::Top;
            return Zero {
                angle: length(scaled, falling),
                falling,
            };
        }
        let phase = &self.from.phase;
        let first = turn.angle.clone() - phase.clone();
        if first.to_f64() > 0.0 {
            return Zero {
                angle: first,
                falling: true,
            };
        }
        let second = scaled.circle.clone() - turn.angle.clone() - phase.clone();
        if second.to_f64() > 0.0 {
            return Zero {
                angle: second,
                falling: false,
            };
        }
        Zero {
            angle: first + scaled.circle.clone(),
            falling: true,
        }
    }

    fn following(&self, zero: &Zero<T>) -> Zero<T> {
        let scaled = self.scaled;
        if scaled.turn.is_none() {
            return Zero {
                angle: zero.angle.clone() + scaled.circle.clone(),
                falling: zero.falling,
            };
        }
        let falling = !zero.falling;
        Zero {
            angle: zero.angle.clone() + length(scaled, falling),
            falling,
        }
    }

    /// The end of the piece before `zero`, and whether f + g presses the ball on it to the wall it left.
    #[inline]
    fn end(&self, zero: &Zero<T>) -> (End<T>, bool) {
        let side = self.from.side;
        let pressed = zero.falling == (side == Side::Bottom);
        let angle = zero.angle.clone();
        let there = if angle.to_f64() < super::swing::REACH {
            self.start.after(&angle, self.scaled.epsilon)
        } else {
            let (sin, cos) = match &self.scaled.turn {
                None => (self.start.sin.clone(), self.start.cos.clone()),
                Some(turn) => {
                    let sin = if zero.falling {
                        turn.sin.clone()
                    } else {
                        -turn.sin.clone()
                    };
                    seen(side, (sin, -self.scaled.g.clone()))
                }
            };
            self.start.far(&self.g, &angle, sin, cos)
        };
        (End { angle, there }, pressed)
    }

    /// Whether the ball dips into `wall` between two ends, away from which f + g pulls it there.
    #[inline]
    fn dip(&self, meeting: &Meeting<T>, wall: Side, ends: [&End<T>; 2]) -> Result<Dip, Stop> {
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
    fn stretch(&self, wall: Side, ends: [&End<T>; 2]) -> Stretch {
        let [low, high] = ends.map(|end| end.angle.to_f64());
        Stretch {
            wall,
            low,
            high,
            distances: ends.map(|end| self.distance(wall, &end.there).to_f64()),
            approaches: ends.map(|end| self.approach(wall, &end.there).to_f64()),
        }
    }

    /// The whole turns after `angle` for which the ball stays well clear of both walls: the mean motion, a parabola,
    /// is off by one at most.
    fn turns_to_skip(&self, angle: f64) -> Result<i64, Stop> {
        let (start, g, gap) = (&self.start, self.g.to_f64(), self.scaled.gap.to_f64());
        let (drift, base) = (start.w.to_f64() + start.sin.to_f64(), start.cos.to_f64());
        let mean = |x: f64| (drift - 0.5 * g * x) * x - base;
        let room = 1.0 + WELL_CLEAR;
        let mut end = f64::INFINITY;
        for level in [room, gap - room] {
            for root in quadratic(-0.5 * g, drift, -base - level) {
                if root > angle {
                    end = end.min(root);
                }
            }
        }
        let now = mean(angle);
        if !(now > room && now < gap - room) {
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

/// The length of a piece that ends at a zero of this kind.
fn length<T: Analytic>(scaled: &Scaled<T>, falling: bool) -> T {
    let Some(turn) = &scaled.turn else {
        return scaled.circle.clone();
    };
    let twice = turn.angle.clone() + turn.angle.clone();
    if falling { twice } else { scaled.circle.clone() - twice }
}

/// The real roots of a x² + b x + c, by the form that does not cancel; NaN where there is none.
fn quadratic(a: f64, b: f64, c: f64) -> [f64; 2] {
    let root = (b * b - 4.0 * a * c).sqrt();
    let sum = -0.5 * (b + root.copysign(b));
    [sum / a, c / sum]
}
