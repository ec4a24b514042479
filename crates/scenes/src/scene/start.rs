//! The start of a motion, as typed.

use super::Quantity;
use dynamics::impact;
use dynamics::model::Side;
use numbers::Analytic;

/// An impact that a motion starts with, or a ball in flight.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// The phase of the forcing, rad, as typed (not reduced).
    pub phase: Quantity,
    /// Without unit: the size of the velocity just before the impact; in flight Zdot.
    pub velocity: Quantity,
    /// The wall of the impact.
    pub side: Side,
    /// Z of a ball in flight, without unit.
    pub position: Option<Quantity>,
}

impl impact::Origin for Start {
    fn start<T: Analytic>(&self) -> impact::Start<T> {
        let (phase, velocity) = (self.phase.angle(), self.velocity.value());
        match &self.position {
            None => impact::Start::impact(self.side, phase, self.side.signed(velocity)),
            Some(position) => impact::Start::in_flight(phase, position.value(), velocity),
        }
    }
}
