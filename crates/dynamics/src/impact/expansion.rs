//! A flight expanded about one of its angles.

use super::scaled::{Departure, Scaled};
use super::swing::Swing;
use crate::model::Side;
use numbers::Analytic;

/// The distance from the wall that was left, its rate and the pressure towards that wall, with sine and cosine of the
/// forcing; all as seen from that wall, so that the top looks as the bottom does: Y'' = -(cos + g).
#[derive(Clone, Debug)]
pub(super) struct Expansion<T> {
    /// Y, at least 0 in flight.
    pub y: T,
    /// Y'.
    pub w: T,
    /// cos + g: positive where the ball is pressed towards the wall.
    pub push: T,
    pub sin: T,
    pub cos: T,
}

impl<T: Analytic> Expansion<T> {
    /// At the departure.
    pub fn start(scaled: &Scaled<T>, from: &Departure<T>) -> Self {
        let [sin, cos, g] = [&from.sin, &from.cos, &scaled.g].map(|value| from.side.signed(value.clone()));
        Self {
            y: T::zero(),
            w: from.speed.clone(),
            // where the ball is being released f + g vanishes, not only to rounding
            push: if from.released { T::zero() } else { cos.clone() + g },
            sin,
            cos,
        }
    }

    /// At an angle `x` after the departure, from the departure, by (3) and (4); `sin` and `cos` are those of the
    /// forcing there. Cancels where `x` is small.
    #[inline]
    pub fn far(&self, g: &T, x: &T, sin: T, cos: T) -> Self {
        let drift = self.w.clone() + self.sin.clone();
        let bent = g.clone() * x.clone();
        let mean = drift.clone() - bent.clone() * T::from_ratio(1, 2);
        Self {
            y: mean * x.clone() + (cos.clone() - self.cos.clone()),
            w: drift - bent - sin.clone(),
            push: cos.clone() + g.clone(),
            sin,
            cos,
        }
    }

    /// The same flight an angle `step` on, of at most [`REACH`](super::swing::REACH); relative accuracy is kept
    /// however short it is.
    #[inline]
    pub fn after(&self, step: &T, epsilon: f64) -> Self {
        self.swung(step, Swing::of(step, epsilon))
    }

    /// The same with the swing of that step.
    #[inline]
    pub fn swung(&self, step: &T, swing: Swing<T>) -> Self {
        let Swing { sin, fall, lag, rest } = swing;
        let (s, c) = (&self.sin, &self.cos);
        let turned = c.clone() * fall.clone() + s.clone() * sin.clone();
        let pressed = self.push.clone() * step.clone();
        let mean = self.w.clone() - pressed.clone() * T::from_ratio(1, 2);
        Self {
            y: self.y.clone() + (mean * step.clone() + (c.clone() * rest + s.clone() * lag.clone())),
            w: self.w.clone() - pressed + (c.clone() * lag + s.clone() * fall.clone()),
            push: self.push.clone() - turned.clone(),
            sin: s.clone() + (c.clone() * sin - s.clone() * fall),
            cos: c.clone() - turned,
        }
    }
}

/// Sine and cosine as seen from a wall.
#[inline]
pub(super) fn seen<T: Analytic>(side: Side, (sin, cos): (T, T)) -> (T, T) {
    (side.signed(sin), side.signed(cos))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;

    #[test]
    fn a_short_step_and_the_closed_form_are_one_flight() {
        for (side, g, phase, speed) in [
            (Side::Bottom, 0.12, 0.4, 0.9),
            (Side::Top, -0.7, 3.0, 0.0),
            (Side::Top, 1.3, 5.0, 2.0),
        ] {
            let scaled = Scaled::new(&Motion::new(g, 0.4, 0.6, 0.3).expect("a motion"));
            let (sin, cos) = f64::sin_cos(phase);
            let start = Expansion::start(
                &scaled,
                &Departure {
                    side,
                    phase,
                    sin,
                    cos,
                    speed,
                    released: false,
                },
            );
            let g = side.signed(g);
            for x in [0.05, 0.3, 0.49, -0.2] {
                let (sin, cos) = seen(side, (phase + x).sin_cos());
                let (far, after) = (start.far(&g, &x, sin, cos), start.after(&x, f64::EPSILON));
                for (a, b) in [
                    (far.y, after.y),
                    (far.w, after.w),
                    (far.push, after.push),
                    (far.sin, after.sin),
                    (far.cos, after.cos),
                ] {
                    assert!((a - b).abs() < 1e-15, "{side} {x}: {a} {b}");
                }
            }
        }
    }
}
