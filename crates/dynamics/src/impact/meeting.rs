//! Where in a stretch of a flight the ball meets a wall, or is nearest to it.

use super::expansion::Expansion;
use super::flight::{Arrival, Flight};
use super::waves::Waves;
use crate::model::Side;
use numbers::Analytic;

/// More steps than any precision needs: bisection alone halves a stretch this often.
const MOST_STEPS: usize = 2000;

/// A flight, asked about a wall. `recent` holds the angles at which late flights from here met bottom and top.
pub(super) struct Meeting<'a, T: Analytic, W: Waves<T>> {
    pub flight: &'a Flight<'a, T, W>,
    pub recent: [f64; 2],
}

/// Angles between which the ball meets a wall, once: it is on this side at `low` and beyond at `high`.
pub(super) struct Stretch {
    pub wall: Side,
    pub low: f64,
    pub high: f64,
    /// The distances from the wall at both ends, and the rates of approach.
    pub distances: [f64; 2],
    pub approaches: [f64; 2],
}

impl Stretch {
    /// About where the ball meets the wall: by the cubic through both ends, Newton's method from the end from which it
    /// does not overshoot.
    fn cubic(&self) -> f64 {
        let length = self.high - self.low;
        let [before, after] = self.distances;
        let [m, n] = self.approaches.map(|rate| -rate * length);
        let change = after - before;
        let (square, cube) = (3.0 * change - 2.0 * m - n, m + n - 2.0 * change);
        // from the end at which the ball is faster: it bends towards the other
        let mut part: f64 = if -m > -n { 0.0 } else { 1.0 };
        for _ in 0..3 {
            let value = before + part * (m + part * (square + part * cube));
            let slope = m + part * (2.0 * square + 3.0 * part * cube);
            part -= value / slope;
        }
        if part > 0.0 && part < 1.0 {
            self.low + part * length
        } else {
            self.low + 0.5 * length
        }
    }
}

/// A flight near one of its angles.
struct Near<T, W> {
    /// The angle about which it is expanded.
    base: T,
    about: Expansion<T, W>,
    /// The reach of the motion.
    reach: f64,
}

impl<T: Analytic, W: Waves<T>> Near<T, W> {
    /// Whether the flight is best seen from here at `angle`, which is `step` on: small angles from the departure only,
    /// because relative accuracy is lost elsewhere.
    fn serves(&self, angle: f64, step: f64) -> bool {
        step.abs() < self.reach && (self.base.is_zero() || angle >= self.reach)
    }

    /// The flight a `leap` on from `there`, itself `step` on from here. On from the departure it is seen from there:
    /// what is small keeps no relative accuracy on its way through what is large.
    fn moved(&self, there: &Expansion<T, W>, step: &T, leap: &T, epsilon: f64) -> Expansion<T, W> {
        if self.base.is_zero() {
            self.at(&(step.clone() + leap.clone()), epsilon)
        } else {
            there.after(leap, epsilon)
        }
    }

    fn at(&self, step: &T, epsilon: f64) -> Expansion<T, W> {
        if step.is_zero() {
            self.about.clone()
        } else {
            self.about.after(step, epsilon)
        }
    }
}

impl<T: Analytic, W: Waves<T>> Meeting<'_, T, W> {
    /// The flight expanded about its departure where `angle` is small, else about `angle`: one sine and cosine.
    #[inline]
    fn near(&self, angle: f64) -> (Near<T, W>, T) {
        let flight = self.flight;
        let reach = flight.scaled.reach;
        let angle = T::from_f64(angle);
        if angle.to_f64() < reach {
            let (base, about) = (T::zero(), flight.start.clone());
            return (Near { base, about, reach }, angle);
        }
        let waves = flight
            .scaled
            .seen(flight.from.side, &(flight.from.phase.clone() + angle.clone()));
        let about = flight.start.far(&flight.g, &angle, waves);
        let base = angle;
        (Near { base, about, reach }, T::zero())
    }

    /// The contact in a stretch, with the precision of the number: the noise of the distance over the velocity.
    #[inline]
    pub fn arrival(&self, stretch: &Stretch, clearance: f64) -> Arrival<T, W> {
        let flight = self.flight;
        let wall = stretch.wall;
        let epsilon = flight.scaled.epsilon;
        let (mut low, mut high) = (stretch.low, stretch.high);
        let (mut near, mut step) = self.near(self.proposal(stretch));
        let mut there = near.at(&step, epsilon);
        for _ in 0..MOST_STEPS {
            let distance = flight.distance(wall, &there);
            let here = (near.base.clone() + step.clone()).to_f64();
            if distance.to_f64() > 0.0 {
                low = here;
            } else {
                high = here;
            }
            let (leap, left) = self.leap(wall, &there, distance);
            let next = here + leap.to_f64();
            // the ends are known to f64 only
            let slack = 2.0 * f64::EPSILON * high;
            // where the ball is not approaching, Newton would lead back to the wall it has just left
            let inside = low - slack <= next
                && next <= high + slack
                && leap.to_f64().abs() < near.reach
                && flight.approach(wall, &there).to_f64() > 0.0;
            if !inside && high - low <= slack {
                break;
            }
            let is_near = near.serves(next, step.to_f64() + leap.to_f64());
            if inside && is_near && left <= 0.25 * epsilon * next {
                there = there.after(&leap, epsilon);
                step += leap;
                break;
            }
            if inside && is_near {
                there = near.moved(&there, &step, &leap, epsilon);
                step += leap;
            } else {
                let next = if inside { next } else { 0.5 * (low + high) };
                (near, step) = self.near(next);
                there = near.at(&step, epsilon);
            }
        }
        Arrival {
            side: wall,
            angle: near.base + step,
            there,
            clearance,
        }
    }

    /// The step to the wall, by the series of the inverse function to the fourth order, and a guess of what is left.
    #[inline]
    fn leap(&self, wall: Side, there: &Expansion<T, W>, distance: T) -> (T, f64) {
        let flight = self.flight;
        let inverse = T::one() / flight.approach(wall, there);
        let first = distance * inverse.clone();
        let towards = |value: &T| {
            if wall == flight.from.side {
                value.clone()
            } else {
                -value.clone()
            }
        };
        // distance(step) / approach = first - step - b step² - c step³ - d step⁴, with these
        let b = towards(&there.push) * inverse.clone() * T::from_ratio(1, 2);
        let c = -towards(&there.waves.minus_slope()) * inverse.clone() * T::from_ratio(1, 6);
        let d = -towards(&there.waves.minus_curvature()) * inverse * T::from_ratio(1, 24);
        let size = first.to_f64().abs();
        let bent = (b.to_f64() * first.to_f64()).abs().max(size);
        if bent.is_nan() || bent >= 0.1 {
            return (first, f64::INFINITY);
        }
        let bb = b.clone() * b.clone();
        let second = -b.clone();
        let third = bb.clone() + bb.clone() - c.clone();
        let fourth = b.clone() * (T::from_integer(5) * (c - bb)) - d;
        let leap = first.clone() + first.clone() * first.clone() * (second + first.clone() * (third + first * fourth));
        (leap, 14.0 * size * bent.powi(4))
    }

    /// The contact in f64, where the number is a wider one; out of the way of f64, which has none narrower.
    #[cold]
    #[inline(never)]
    fn in_f64(&self, stretch: &Stretch) -> Option<f64> {
        let recent = self.recent;
        self.flight
            .in_f64(|flight| Meeting { flight, recent }.arrival(stretch, 0.0).angle)
    }

    /// An angle of the stretch to start from: the contact in f64, that of a late flight, or by a cubic through both ends.
    #[inline]
    fn proposal(&self, stretch: &Stretch) -> f64 {
        if self.flight.scaled.narrow.is_some()
            && let Some(angle) = self.in_f64(stretch)
            && stretch.low < angle
            && angle < stretch.high
        {
            return angle;
        }
        let start = &self.flight.start;
        let from = self.flight.from;
        if stretch.low == 0.0 && stretch.wall == from.side && from.height.is_none() {
            // a short hop, under a push that hardly changes
            let (u, a) = (start.w.to_f64(), start.push.to_f64());
            let hop = 2.0 * u / a * (1.0 + 2.0 / 3.0 * start.waves.minus_slope().to_f64() * u / (a * a));
            if 0.0 < hop && hop < stretch.high.min(self.flight.scaled.reach) {
                return hop;
            }
        }
        let recent = self.recent[stretch.wall as usize];
        if stretch.low < recent && recent < stretch.high {
            return recent;
        }
        stretch.cubic()
    }

    /// The angle between two at which the ball is nearest to a wall that it does not stay at, and how near it is
    /// there: negative beyond the wall.
    pub fn bottom(&self, wall: Side, low: f64, high: f64) -> (f64, f64) {
        let flight = self.flight;
        let epsilon = flight.scaled.epsilon;
        let (mut low, mut high) = (low, high);
        let (mut near, mut step) = self.near(0.5 * (low + high));
        let mut there = near.at(&step, epsilon);
        for _ in 0..MOST_STEPS {
            let here = (near.base.clone() + step.clone()).to_f64();
            if flight.approach(wall, &there).to_f64() > 0.0 {
                low = here;
            } else {
                high = here;
            }
            // Newton on the velocity; what is left of the step moves the distance by its square only
            let leap = there.w.clone() / there.push.clone();
            let moved = leap.to_f64();
            let next = here + moved;
            let inside = low <= next && next <= high && near.serves(next, step.to_f64() + moved);
            if inside {
                step += leap;
            } else {
                (near, step) = self.near(0.5 * (low + high));
            }
            there = near.at(&step, epsilon);
            if (inside && moved * moved <= epsilon) || high - low <= 2.0 * f64::EPSILON * high {
                break;
            }
        }
        let angle = (near.base + step).to_f64();
        (angle, flight.distance(wall, &there).to_f64())
    }
}
