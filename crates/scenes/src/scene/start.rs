//! The impact that a motion starts with, as typed.

use super::Quantity;
use dynamics::impact;
use dynamics::model::Side;
use numbers::Analytic;

/// The impact that a motion starts with: at the bottom.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// The phase of the forcing, rad, as typed (not reduced).
    pub phase: Quantity,
    /// The velocity just before the impact, non-dimensional, not negative.
    pub velocity: Quantity,
}

impl impact::Origin for Start {
    fn start<T: Analytic>(&self) -> impact::Start<T> {
        impact::Start {
            side: Side::Bottom,
            phase: self.phase.angle(),
            velocity: self.velocity.value(),
        }
    }
}
