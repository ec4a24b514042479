//! A flight from a wall: where it starts, how the walls are seen from there, and how it can end.

use super::expansion::Expansion;
use super::scaled::{Departure, Scaled};
use super::waves::Waves;
use crate::model::Side;
use numbers::Analytic;

/// The end of a flight.
#[derive(Clone, Debug)]
pub(super) struct Arrival<T, W> {
    /// The wall.
    pub side: Side,
    /// The angle of the forcing since the departure.
    pub angle: T,
    /// The flight there, as seen from the wall that was left; `w` points towards the wall.
    pub there: Expansion<T, W>,
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
pub(super) struct Flight<'a, T: Analytic, W: Waves<T>> {
    pub scaled: &'a Scaled<T, W>,
    pub from: &'a Departure<T, W>,
    pub start: Expansion<T, W>,
    /// g as seen from the wall that was left.
    pub g: T,
}

impl<'a, T: Analytic, W: Waves<T>> Flight<'a, T, W> {
    pub fn new(scaled: &'a Scaled<T, W>, from: &'a Departure<T, W>) -> Self {
        Self {
            scaled,
            from,
            start: Expansion::start(scaled, from),
            g: from.side.signed(scaled.g.clone()),
        }
    }

    /// What the same flight in f64 says, where the number is a wider one: what f64 can tell need not be computed in that.
    pub fn in_f64<R>(&self, ask: impl FnOnce(&Flight<f64, W::Narrow>) -> R) -> Option<R> {
        let scaled = self.scaled.narrow.as_deref()?;
        let (from, start) = (self.from, &self.start);
        let from = Departure {
            side: from.side,
            phase: from.phase.to_f64(),
            waves: from.waves.in_f64(),
            speed: from.speed.to_f64(),
            height: from.height.as_ref().map(T::to_f64),
            released: from.released,
        };
        let [y, w, push] = [&start.y, &start.w, &start.push].map(T::to_f64);
        let waves = start.waves.in_f64();
        Some(ask(&Flight {
            scaled,
            from: &from,
            start: Expansion { y, w, push, waves },
            g: self.g.to_f64(),
        }))
    }

    /// Whether a ball without velocity stays: f + g presses it to the wall, or, 0 as far as rounding can tell, is about to.
    pub fn starts_at_rest(&self) -> bool {
        let start = &self.start;
        let push = start.push.to_f64();
        let noise = 4.0 * self.scaled.epsilon * self.scaled.bounds.f;
        let turns_to_press = push.abs() <= noise && start.waves.minus_slope().to_f64() < 0.0;
        let is_at_wall = self.from.height.is_none();
        is_at_wall && start.w.is_zero() && !self.from.released && (push > 0.0 || turns_to_press)
    }

    /// The distance from a wall, seen from the one that was left.
    pub fn distance(&self, wall: Side, there: &Expansion<T, W>) -> T {
        if wall == self.from.side {
            there.y.clone()
        } else {
            self.scaled.gap.clone() - there.y.clone()
        }
    }

    /// The rate at which the ball approaches a wall.
    pub fn approach(&self, wall: Side, there: &Expansion<T, W>) -> T {
        if wall == self.from.side {
            -there.w.clone()
        } else {
            there.w.clone()
        }
    }

    /// How far rounding may have moved `y` at an angle after the departure.
    pub fn noise(&self, angle: f64) -> f64 {
        let (start, bounds) = (&self.start, &self.scaled.bounds);
        let bent = 0.5 * angle * angle;
        let size = if angle < self.scaled.reach {
            // terms of the series; the push, and with it the second, has an absolute error
            start.w.to_f64().abs() * angle + bounds.f * bent
        } else {
            let drift = start.w.to_f64() + start.waves.f1().to_f64();
            drift.abs() * angle + self.g.to_f64().abs() * bent + 2.0 * bounds.f2
        };
        // of a start in flight the distances from the walls are rounded as well
        let apart = match &self.from.height {
            None => 0.0,
            Some(height) => self.scaled.gap.to_f64() + height.to_f64(),
        };
        4.0 * self.scaled.epsilon * (size + apart)
    }
}
