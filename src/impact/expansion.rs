//! A flight expanded about one of its angles.

use super::scaled::{Departure, Scaled};
use super::swing::Swing;
use crate::model::Side;
use crate::number::Analytic;

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
        let Swing { sin, fall, lag, rest } = Swing::of(step, epsilon);
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
