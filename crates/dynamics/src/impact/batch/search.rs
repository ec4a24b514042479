//! Between which angles an ordinary flight meets which wall, one lane of it, without a branch.
//!
//! The same pieces between zeros of f + g as in contact.rs. What is close is not decided here.

use super::angle::pick;
use std::f64::consts::{PI, TAU};

/// Distances closer to a wall than this, times pi², are left to a closer look: far more than rounding makes of the
/// speeds and gaps that are taken up.
const CLOSE: f64 = 1e-9;

/// The ball of a lane as it leaves, and its motion; all as seen from the wall it leaves.
#[derive(Clone, Copy)]
pub(super) struct Leaving {
    pub side: f64,
    pub phase: f64,
    pub sin: f64,
    pub cos: f64,
    pub speed: f64,
    pub g: f64,
    pub gap: f64,
    pub turn: f64,
    pub turn_sin: f64,
}

/// The stretch of a flight in which it meets a wall, once.
#[derive(Clone, Copy)]
pub(super) struct Stretch {
    /// Whether there is one; if not, the rest means nothing.
    pub is_found: bool,
    /// Whether it is the other wall.
    pub is_far: bool,
    pub low: f64,
    pub high: f64,
    /// The distances from the wall at both ends, and the rates of approach.
    pub distances: [f64; 2],
    pub approaches: [f64; 2],
}

/// The search, piece after piece.
#[derive(Clone, Copy)]
pub(super) struct Search {
    /// Whether to go on.
    pub is_open: bool,
    pub found: Stretch,
    /// The beginning of the piece that comes next: angle, distance from the wall that was left, its rate.
    pub low: [f64; 3],
    /// Its end.
    pub high: f64,
    /// 1 where f + g falls through 0 there, -1 where it rises.
    pub falling: f64,
    /// The least distance of the dips so far from a wall, a lower bound; as [`Arrival`](crate::impact::flight::Arrival)
    /// has it.
    pub clearance: f64,
}

impl Leaving {
    /// The search for the next contact, which is clear of every doubt but that of a dip which turns back short of the
    /// wall, where there is no contact.
    #[inline(always)]
    pub fn search(&self, is_ordinary: bool) -> Search {
        let first = self.turn - self.phase;
        let second = TAU - self.turn - self.phase;
        let is_rising = (first <= 0.0) & (second > 0.0);
        Search {
            is_open: is_ordinary,
            found: Stretch {
                is_found: false,
                is_far: false,
                low: 0.0,
                high: 1.0,
                distances: [1.0, -1.0],
                approaches: [1.0; 2],
            },
            low: [0.0, 0.0, self.speed],
            high: pick(first > 0.0, first, pick(second > 0.0, second, first + TAU)),
            falling: pick(is_rising, -1.0, 1.0),
            clearance: f64::INFINITY,
        }
    }

    /// The search after one more piece. `GROWTH`: whether how far dips keep away is wanted.
    #[inline(always)]
    pub fn piece<const GROWTH: bool>(&self, search: Search) -> Search {
        let [low, y, w] = search.low;
        let high = search.high;
        // whether f + g presses the ball to the wall it left
        let is_pressed = search.falling * self.side > 0.0;
        let drift = self.speed + self.sin;
        let end_y = (drift - 0.5 * self.g * high) * high - (self.g + self.cos);
        let end_w = drift - self.g * high - pick(is_pressed, self.turn_sin, -self.turn_sin);

        // the wall from which f + g pulls the ball away: it may dip there
        let distance = |y: f64| pick(is_pressed, self.gap - y, y);
        let approach = |w: f64| pick(is_pressed, w, -w);
        let end = [high, distance(end_y), approach(end_w)];
        let (from, to) = self.narrowed(&search, is_pressed, [low, distance(y), approach(w)], end);
        let ([start, near, before], [stop, far, after]) = (from, to);
        let is_towards = approach(w) > 0.0;
        let turns = after < 0.0;
        // the tangents at both ends meet short of the wall
        let clears = (near - CLOSE) * (before - after) > before * (near - far - after * (stop - start));
        let clearance = if GROWTH {
            let bound = near - before * (near - far - after * (stop - start)) / (before - after);
            let closer = pick(bound < search.clearance, bound, search.clearance);
            pick(is_towards & turns & clears, closer, search.clearance)
        } else {
            search.clearance
        };
        let is_past = far < -CLOSE;
        let dips = is_towards & (is_past | (turns & !clears));
        let is_clear = !is_towards | (turns & clears) | (!turns & (far > CLOSE));

        // the wall to which f + g presses it
        let beyond = end[1] - self.gap;
        let presses = is_clear & (beyond > CLOSE);
        let goes_on = is_clear & (beyond < -CLOSE) & !dips;

        let either = |dip: f64, press: f64| pick(dips, dip, press);
        let found = Stretch {
            is_found: true,
            is_far: is_pressed == dips,
            low: either(start, low),
            high: either(stop, high),
            distances: [either(near, self.gap - distance(y)), either(far, -beyond)],
            approaches: [either(before, -approach(w)), either(after, -end[2])],
        };
        let falling = -search.falling;
        let twice = self.turn + self.turn;
        Search {
            is_open: search.is_open & goes_on,
            found: found.or(search.found, search.is_open & (dips | presses)),
            low: [high, end_y, end_w],
            high: high + pick(falling > 0.0, twice, 2.0 * PI - twice),
            falling,
            clearance: pick(search.is_open, clearance, search.clearance),
        }
    }

    /// The half of a piece, if it has two, in which the ball is nearest to a wall or meets it: angle, distance and
    /// approach at both ends. In the middle of a whole piece the forcing is at an extreme.
    #[inline(always)]
    fn narrowed(&self, search: &Search, is_pressed: bool, from: [f64; 3], to: [f64; 3]) -> ([f64; 3], [f64; 3]) {
        let half = pick(search.falling > 0.0, self.turn, PI - self.turn);
        let middle = search.high - half;
        let drift = self.speed + self.sin;
        let w = drift - self.g * middle;
        let y = (drift - 0.5 * self.g * middle) * middle + (pick(is_pressed, 1.0, -1.0) - self.cos);
        let distance = pick(is_pressed, self.gap - y, y);
        let approach = pick(is_pressed, w, -w);
        let is_inside = middle > from[0];
        let is_before = (approach > 0.0) & (distance > 0.0);
        let there = [middle, distance, approach];
        (
            three(is_inside & is_before, there, from),
            three(is_inside & !is_before, there, to),
        )
    }
}

#[inline(always)]
fn three(condition: bool, yes: [f64; 3], no: [f64; 3]) -> [f64; 3] {
    [
        pick(condition, yes[0], no[0]),
        pick(condition, yes[1], no[1]),
        pick(condition, yes[2], no[2]),
    ]
}

impl Stretch {
    /// This or another.
    #[inline(always)]
    fn or(self, other: Self, is_this: bool) -> Self {
        let either =
            |this: [f64; 2], other: [f64; 2]| [pick(is_this, this[0], other[0]), pick(is_this, this[1], other[1])];
        Self {
            is_found: (is_this & self.is_found) | (!is_this & other.is_found),
            is_far: (is_this & self.is_far) | (!is_this & other.is_far),
            low: pick(is_this, self.low, other.low),
            high: pick(is_this, self.high, other.high),
            distances: either(self.distances, other.distances),
            approaches: either(self.approaches, other.approaches),
        }
    }

    /// About where the ball meets the wall: by the cubic through both ends, as in meeting.rs.
    #[inline(always)]
    pub fn cubic(&self) -> f64 {
        let length = self.high - self.low;
        let [before, after] = self.distances;
        let (m, n) = (-self.approaches[0] * length, -self.approaches[1] * length);
        let change = after - before;
        let (square, cube) = (3.0 * change - 2.0 * m - n, m + n - 2.0 * change);
        let mut part = pick(m < n, 0.0, 1.0);
        for _ in 0..2 {
            let value = before + part * (m + part * (square + part * cube));
            let slope = m + part * (2.0 * square + 3.0 * part * cube);
            part -= value / slope;
        }
        let is_inside = (part > 0.0) & (part < 1.0);
        self.low + pick(is_inside, part, 0.5) * length
    }
}
