//! A motion at one value of the parameter, and what of its impacts is shown.

use crate::report::plot::{Axis, Dash, Ticks};
use std::f64::consts::{PI, TAU};

/// How a motion goes on when it is disturbed, if it can be at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Course {
    Stable,
    Unstable,
    /// It would pass through a wall.
    Inadmissible,
}

impl Course {
    /// From what a table says of a motion.
    pub const fn of(stable: bool, admissible: bool) -> Self {
        match (admissible, stable) {
            (false, _) => Self::Inadmissible,
            (true, true) => Self::Stable,
            (true, false) => Self::Unstable,
        }
    }

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Unstable => "unstable",
            Self::Inadmissible => "unphysical (through a wall)",
        }
    }

    pub(super) const fn dash(self) -> Dash {
        match self {
            Self::Stable => Dash::Solid,
            Self::Unstable => Dash::Dashed,
            Self::Inadmissible => Dash::Dotted,
        }
    }
}

/// A motion at one value of the parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The value.
    pub at: f64,
    /// Its word, and its periods where they are more than one.
    pub name: String,
    /// Of its impacts, in [0, 2 pi).
    pub phases: Vec<f64>,
    /// Just before each: positive at the bottom, negative at the top.
    pub velocities: Vec<f64>,
    pub course: Course,
}

/// What of the impacts is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    Velocity,
    Phase,
}

impl Quantity {
    const fn label(self) -> &'static str {
        match self {
            Self::Velocity => "velocity before impact, $\u{17b}$  [$A\u{3c0}/(M\u{3c9})$]",
            Self::Phase => "phase of impact, $\u{3c6}$  [rad]",
        }
    }

    pub(super) const fn heading(self) -> &'static str {
        match self {
            Self::Velocity => "Velocity of the impacts",
            Self::Phase => "Phase of the impacts",
        }
    }

    pub(super) fn of(self, step: &Step, impact: usize) -> f64 {
        let values = match self {
            Self::Velocity => &step.velocities,
            Self::Phase => &step.phases,
        };
        values.get(impact).copied().unwrap_or(f64::NAN)
    }

    /// Whether a line from one value to the next goes over the cut of the circle.
    pub(super) fn is_broken(one: f64, other: f64) -> bool {
        (one - other).abs() > PI
    }

    pub(super) fn axis(self) -> Axis {
        match self {
            Self::Velocity => Axis::new(self.label()),
            Self::Phase => Axis::over(self.label(), (-0.02 * TAU, 1.02 * TAU)).with_ticks(Ticks::Pi),
        }
    }
}
