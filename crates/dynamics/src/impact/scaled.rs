//! A motion in units without pi, seen from the wall that the ball left.

use crate::model::{Motion, Side};
use numbers::Analytic;

/// What a motion needs in flight, in units without pi: the angle x = pi t of the forcing stands for the time, lengths
/// are pi² times those of [`Motion`], velocities pi times.
#[derive(Clone, Debug)]
pub(super) struct Scaled<T> {
    pub g: T,
    pub gap: T,
    /// Of bottom and top.
    pub restitution: [T; 2],
    /// Where f + g changes sign; `None` where it never does.
    pub turn: Option<Turn<T>>,
    pub pi: T,
    /// 2 pi.
    pub circle: T,
    /// 1 / pi, which brings a velocity back.
    pub inverse_pi: T,
    /// Of the number; a wide one is slow to tell it.
    pub epsilon: f64,
    /// The same in f64, where the number is a wider one.
    pub narrow: Option<Box<Scaled<f64>>>,
}

/// cos(angle) = -g, angle in (0, pi): f + g > 0 before it, and again after 2 pi - angle.
#[derive(Clone, Debug)]
pub(super) struct Turn<T> {
    pub angle: T,
    pub sin: T,
}

impl<T: Analytic> Scaled<T> {
    pub fn new(motion: &Motion<T>) -> Self {
        let pi = T::pi();
        let g = motion.g().clone();
        let room = (T::one() - g.clone()) * (T::one() + g.clone());
        let turn = (room.to_f64() > 0.0).then(|| Turn {
            angle: (-g.clone()).acos(),
            sin: room.sqrt(),
        });
        let mut scaled = Self {
            gap: pi.clone() * pi.clone() * motion.d().clone(),
            restitution: [Side::Bottom, Side::Top].map(|side| motion.restitution(side).clone()),
            turn,
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

    fn in_f64(&self) -> Scaled<f64> {
        Scaled {
            g: self.g.to_f64(),
            gap: self.gap.to_f64(),
            restitution: [0, 1].map(|side| self.restitution[side].to_f64()),
            turn: self.turn.as_ref().map(|turn| Turn {
                angle: turn.angle.to_f64(),
                sin: turn.sin.to_f64(),
            }),
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

    /// The phase at which a ball that rests on `side` is released; `None` where it never is.
    pub fn release(&self, side: Side) -> Option<T> {
        let turn = self.turn.as_ref()?;
        Some(match side {
            Side::Bottom => turn.angle.clone(),
            Side::Top => self.circle.clone() - turn.angle.clone(),
        })
    }
}

/// A ball that has just left a wall. `sin` and `cos` belong to `phase`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Departure<T> {
    pub side: Side,
    /// In [0, 2 pi).
    pub phase: T,
    pub sin: T,
    pub cos: T,
    /// The speed away from the wall, at least 0.
    pub speed: T,
    /// Whether f + g is just taking it off, so that it vanishes here.
    pub released: bool,
}

impl<T> Departure<T> {
    /// The same in another number, with the sine and cosine that it has of the phase.
    pub fn convert<U: Analytic>(&self, convert: impl Fn(&T) -> U) -> Departure<U> {
        let phase = convert(&self.phase);
        let (sin, cos) = phase.sincos();
        Departure {
            side: self.side,
            phase,
            sin,
            cos,
            speed: convert(&self.speed),
            released: self.released,
        }
    }
}
