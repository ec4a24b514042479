//! Where a motion starts.

use super::event::Event;
use crate::model::Side;
use numbers::Analytic;

/// An impact that a motion starts with, or a ball in flight.
///
/// A ball at rest on a wall is an impact of velocity 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Start<T> {
    /// The wall; of no meaning for a ball in flight.
    pub side: Side,
    /// The phase of the forcing, rad; any.
    pub phase: T,
    /// Zdot: just before an impact, at least 0 at the bottom and at most 0 at the top; any in flight.
    pub velocity: T,
    /// Z of a ball in flight, between the walls.
    pub position: Option<T>,
}

impl<T> Start<T> {
    /// An impact at a wall.
    pub fn impact(side: Side, phase: T, velocity: T) -> Self {
        Self {
            side,
            phase,
            velocity,
            position: None,
        }
    }

    /// A ball in flight, at Z = `position`: from -d/2 to d/2, or of one wall up to 0.
    pub fn in_flight(phase: T, position: T, velocity: T) -> Self {
        Self {
            position: Some(position),
            ..Self::impact(Side::Bottom, phase, velocity)
        }
    }

    /// The same start over another number.
    pub fn convert<U>(&self, convert: impl Fn(&T) -> U) -> Start<U> {
        Start {
            side: self.side,
            phase: convert(&self.phase),
            velocity: convert(&self.velocity),
            position: self.position.as_ref().map(convert),
        }
    }
}

impl<T: Analytic> From<&Event<T>> for Start<T> {
    fn from(event: &Event<T>) -> Self {
        Self::impact(event.side, event.phase.clone(), event.velocity.clone())
    }
}

/// A start known exactly, over any number.
pub trait Origin {
    /// The start, its phase in [0, 2 pi).
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
