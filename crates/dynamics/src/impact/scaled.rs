//! A motion in units without pi, seen from the wall that the ball left.

use super::swing::REACH;
use super::turns::Turn;
use super::waves::{Bounds, Cosine, Waves};
use crate::model::{Motion, Side};
use numbers::Analytic;

/// What a motion needs in flight, in units without pi: the angle x = pi t of the forcing stands for the time, lengths
/// are pi² times those of [`Motion`], velocities pi times.
#[derive(Clone, Debug)]
pub(super) struct Scaled<T: Analytic, W: Waves<T> = Cosine<T>> {
    pub g: T,
    pub gap: T,
    pub has_top: bool,
    /// Of bottom and top.
    pub restitution: [T; 2],
    pub drive: W::Drive,
    pub bounds: Bounds,
    /// The largest angle for which a flight is expanded.
    pub reach: f64,
    /// Where f + g changes sign, in order; none where it never does.
    pub turns: Vec<Turn<T, W>>,
    pub pi: T,
    /// 2 pi.
    pub circle: T,
    /// 1 / pi, which brings a velocity back.
    pub inverse_pi: T,
    /// Of the number; a wide one is slow to tell it.
    pub epsilon: f64,
    /// The same in f64, where the number is a wider one.
    pub narrow: Option<Box<Scaled<f64, W::Narrow>>>,
}

impl<T: Analytic, W: Waves<T>> Scaled<T, W> {
    pub fn new(motion: &Motion<T>) -> Self {
        let pi = T::pi();
        let g = motion.g().clone();
        let drive = W::drive(motion);
        let bounds = W::bounds(&drive, |value| value.to_f64().abs());
        let mut scaled = Self {
            gap: pi.clone() * pi.clone() * motion.d().clone(),
            has_top: motion.has_top(),
            restitution: [Side::Bottom, Side::Top].map(|side| motion.restitution(side).clone()),
            turns: W::turns(&drive, &g),
            bounds,
            reach: REACH / bounds.highest,
            drive,
            circle: pi.clone() + pi.clone(),
            inverse_pi: T::one() / pi.clone(),
            epsilon: T::epsilon().to_f64(),
            narrow: None,
            pi,
            g,
        };
        if scaled.epsilon < f64::EPSILON {
            scaled.narrow = Some(Box::new(scaled.in_f64()));
        }
        scaled
    }

    fn in_f64(&self) -> Scaled<f64, W::Narrow> {
        let turns = self.turns.iter().map(|turn| Turn {
            phase: turn.phase.to_f64(),
            falling: turn.falling,
            waves: turn.waves.in_f64(),
            to_next: turn.to_next.to_f64(),
        });
        Scaled {
            g: self.g.to_f64(),
            gap: self.gap.to_f64(),
            has_top: self.has_top,
            restitution: [0, 1].map(|side| self.restitution[side].to_f64()),
            drive: W::narrow(&self.drive),
            bounds: self.bounds,
            reach: self.reach,
            turns: turns.collect(),
            pi: self.pi.to_f64(),
            circle: self.circle.to_f64(),
            inverse_pi: self.inverse_pi.to_f64(),
            epsilon: f64::EPSILON,
            narrow: None,
        }
    }

    pub fn restitution(&self, side: Side) -> &T {
        &self.restitution[side as usize]
    }

    /// Returns true if there is this wall.
    #[inline(always)]
    pub fn has(&self, side: Side) -> bool {
        self.has_top || side == Side::Bottom
    }

    /// The forcing at a phase, as seen from a wall.
    #[inline(always)]
    pub fn seen(&self, side: Side, phase: &T) -> W {
        W::at(&self.drive, phase).seen(side)
    }

    /// The turns at which a ball that rests on `side` is released.
    pub fn releases(&self, side: Side) -> impl Iterator<Item = &Turn<T, W>> {
        let turns = self.turns.iter();
        turns.filter(move |turn| turn.falling == (side == Side::Bottom))
    }

    /// The phase at which a ball that has rested on `side` since a phase is released, and the whole turns that are
    /// completed before; `None` where it never is.
    pub fn release(&self, side: Side, since: &T) -> Option<(T, i64)> {
        let is_later = |turn: &&Turn<T, W>| (turn.phase.clone() - since.clone()).to_f64() >= 0.0;
        match self.releases(side).find(is_later) {
            Some(turn) => Some((turn.phase.clone(), 0)),
            None => Some((self.releases(side).next()?.phase.clone(), 1)),
        }
    }
}

/// A ball that has just left a wall, or starts in flight.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Departure<T, W> {
    pub side: Side,
    /// In [0, 2 pi).
    pub phase: T,
    /// The forcing at the phase, as seen from the bottom.
    pub waves: W,
    /// The speed away from the wall, at least 0 where it leaves that.
    pub speed: T,
    /// The distance from the wall of a ball that starts in flight.
    pub height: Option<T>,
    /// Whether f + g is just taking it off, so that it vanishes here.
    pub released: bool,
}

impl<T: Analytic, W> Departure<T, W> {
    /// The same in another number.
    pub fn convert<U: Analytic, V: Waves<U>>(&self, drive: &V::Drive, convert: impl Fn(&T) -> U) -> Departure<U, V> {
        let phase = convert(&self.phase);
        Departure {
            side: self.side,
            waves: V::at(drive, &phase),
            phase,
            speed: convert(&self.speed),
            height: self.height.as_ref().map(convert),
            released: self.released,
        }
    }
}
