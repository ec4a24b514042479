//! A flight at one of its angles, one lane of it, without a branch.

use super::angle::{pick, sin_cos};
use super::search::Leaving;

/// As [`Expansion`](crate::impact::expansion::Expansion): distance from the wall that was left, its rate, the pressure
/// to it, sine and cosine of the forcing.
#[derive(Clone, Copy)]
pub(super) struct Near {
    pub y: f64,
    pub w: f64,
    pub push: f64,
    pub sin: f64,
    pub cos: f64,
}

impl Leaving {
    /// The flight an angle `x` after the departure, by (3) and (4). Cancels where `x` is small.
    #[inline(always)]
    pub fn at(&self, x: f64) -> Near {
        let (sin, cos) = sin_cos(self.phase + x);
        let (sin, cos) = (self.side * sin, self.side * cos);
        let drift = self.speed + self.sin;
        let bent = self.g * x;
        Near {
            y: (drift - 0.5 * bent) * x + (cos - self.cos),
            w: drift - bent - sin,
            push: cos + self.g,
            sin,
            cos,
        }
    }

    /// The same, where `x` is at most [`REACH`](crate::impact::swing::REACH), with relative accuracy.
    #[inline(always)]
    pub fn close(&self, x: f64) -> Near {
        let start = Near {
            y: 0.0,
            w: self.speed,
            push: self.cos + self.g,
            sin: self.sin,
            cos: self.cos,
        };
        let z = x * x;
        let lag = x * z * (1.0 / 6.0) * tail::<4, 7>(z);
        let rest = z * z * (1.0 / 24.0) * tail::<5, 7>(z);
        start.swung(x, lag, rest)
    }
}

impl Near {
    /// This or another.
    #[inline(always)]
    pub fn or(self, other: Self, is_this: bool) -> Self {
        Self {
            y: pick(is_this, self.y, other.y),
            w: pick(is_this, self.w, other.w),
            push: pick(is_this, self.push, other.push),
            sin: pick(is_this, self.sin, other.sin),
            cos: pick(is_this, self.cos, other.cos),
        }
    }

    /// The same flight a `step` on, so short that two terms of the series are all.
    #[inline(always)]
    pub fn after(&self, step: f64) -> Self {
        let z = step * step;
        let lag = step * z * (1.0 / 6.0) * tail::<4, 2>(z);
        let rest = z * z * (1.0 / 24.0) * tail::<5, 2>(z);
        self.swung(step, lag, rest)
    }

    /// A step `x` on, with x - sin x and x²/2 - 1 + cos x.
    #[inline(always)]
    fn swung(&self, x: f64, lag: f64, rest: f64) -> Self {
        let (s, c) = (self.sin, self.cos);
        let (sin, fall) = (x - lag, x * x * 0.5 - rest);
        let turned = c * fall + s * sin;
        let pressed = self.push * x;
        Self {
            y: self.y + ((self.w - pressed * 0.5) * x + (c * rest + s * lag)),
            w: self.w - pressed + (c * lag + s * fall),
            push: self.push - turned,
            sin: s + (c * sin - s * fall),
            cos: c - turned,
        }
    }
}

/// `1 - z/(n(n+1)) (1 - z/((n+2)(n+3)) (1 - ...))`, so many terms.
#[inline(always)]
fn tail<const N: usize, const TERMS: usize>(z: f64) -> f64 {
    let mut sum = 1.0;
    for pair in (0..TERMS).rev() {
        let first = (N + 2 * pair) as f64;
        sum = 1.0 - z * (1.0 / (first * (first + 1.0))) * sum;
    }
    sum
}
