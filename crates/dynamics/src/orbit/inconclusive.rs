//! Why intervals make no orbit.

/// Why enclosures of the impacts make no orbit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Inconclusive {
    /// The intervals are too wide to decide; narrower ones, over a wider number, may.
    #[error("the intervals are too wide to tell {what}")]
    Undecided {
        /// What is open.
        what: Property,
    },
    /// A velocity certainly points away from its wall, or is 0: the equations hold, but nothing moves so.
    #[error("impact {impact} moves away from its wall")]
    Backwards {
        /// From 0, in the order given.
        impact: usize,
    },
    /// A flight certainly lasts no time.
    #[error("the flight after impact {impact} takes no time")]
    Timeless {
        /// From 0, in the order given.
        impact: usize,
    },
    /// Not one fix for each impact of the word.
    #[error("the word has {wanted} impacts, but {found} are given")]
    Count {
        /// Impacts of the word.
        wanted: usize,
        /// Fixes given.
        found: usize,
    },
}

/// What intervals may leave open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// The sign of a velocity.
    Direction,
    /// The sign of a time.
    Order,
    /// Node, focus or saddle.
    Kind,
    /// Whether the determinant is below 1.
    Damping,
    /// Whether there is a motion at all, and one only.
    Existence,
    /// Where a flight turns.
    Turning,
    /// Whether a turning point keeps off the wall.
    Clearance,
}

impl std::fmt::Display for Property {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            Self::Direction => "which way the ball moves at an impact",
            Self::Order => "which of two impacts comes first",
            Self::Kind => "node, focus and saddle apart",
            Self::Damping => "whether the impacts take energy",
            Self::Existence => "whether there is such a motion, and one only",
            Self::Turning => "where the flight turns",
            Self::Clearance => "whether the flight keeps off the walls",
        })
    }
}

/// That the intervals leave `what` open.
pub(crate) fn undecided<T>(what: Property) -> Result<T, Inconclusive> {
    Err(Inconclusive::Undecided { what })
}
