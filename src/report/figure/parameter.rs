//! The axis of what is swept.

use crate::report::plot::{Axis, Ticks};

/// What stands on the horizontal axis of a diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its symbol and meaning, with the unit.
    pub label: String,
    /// The ends of the sweep, in either order.
    pub ends: (f64, f64),
    /// The form of its numbers.
    pub ticks: Ticks,
}

/// How far an axis goes beyond the ends of the sweep, relative to its length: what happens there is seen.
const MARGIN: f64 = 0.02;

impl Parameter {
    /// The parameter that a column of this name has; the units are those in which the motion is without unit.
    pub fn new(name: &str, ends: (f64, f64)) -> Self {
        let label = match name {
            "d" => "gap $d$  [$A\u{3c0}\u{b2}/(M\u{3c9}\u{b2})$]",
            "r_b" => "restitution of the bottom, r_B",
            "r_t" => "restitution of the top, r_T",
            "r" => "restitution of both membranes, $r$",
            "incline" => "incline $\u{3b2}$  [rad]",
            "g" => "gravity along the capsule $g$  [$A/M$]",
            "forcing_amplitude" => "forcing amplitude $A$  [N]",
            other => other,
        };
        Self {
            label: label.to_owned(),
            ends,
            ticks: match name {
                "incline" => Ticks::Pi,
                _ => Ticks::Decimals,
            },
        }
    }

    pub(super) fn axis(&self) -> Axis {
        let (one, other) = self.ends;
        let margin = MARGIN * (other - one);
        Axis::over(self.label.clone(), (one - margin, other + margin)).with_ticks(self.ticks)
    }
}
