//! Where a motion starts.

use super::event::Event;
use crate::model::Side;
use numbers::Analytic;

/// The impact that a motion starts with.
#[derive(Clone, Debug, PartialEq)]
pub struct Start<T> {
    /// The wall.
    pub side: Side,
    /// The phase of the forcing, rad; any.
    pub phase: T,
    /// Zdot just before: at least 0 at the bottom, at most 0 at the top.
    pub velocity: T,
}

impl<T> Start<T> {
    /// The same start over another number.
    pub fn convert<U>(&self, convert: impl Fn(&T) -> U) -> Start<U> {
        Start {
            side: self.side,
            phase: convert(&self.phase),
            velocity: convert(&self.velocity),
        }
    }
}

impl<T: Analytic> From<&Event<T>> for Start<T> {
    fn from(event: &Event<T>) -> Self {
        Self {
            side: event.side,
            phase: event.phase.clone(),
            velocity: event.velocity.clone(),
        }
    }
}

/// A start known exactly, over any number.
pub trait Origin {
    /// The start impact, its phase in [0, 2 pi).
    fn start<T: Analytic>(&self) -> Start<T>;
}

impl<O: Origin> Origin for &O {
    fn start<T: Analytic>(&self) -> Start<T> {
        (*self).start()
    }
}

/// The numbers of an f64 start, taken as exact.
impl Origin for Start<f64> {
    fn start<T: Analytic>(&self) -> Start<T> {
        self.convert(|&value| T::from_f64(value))
    }
}
