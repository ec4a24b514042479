//! What is decided of a claim.

use serde::Deserialize;
use std::fmt;

/// Whether a claim follows from its premises.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// It does, by exact algebra.
    #[default]
    Proved,
    /// It does not: there is a counterexample, or it is nowhere defined.
    Refuted,
    /// Not decided within the limits. Never a pass, and never to be expected.
    #[serde(skip)]
    Undecided,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Proved => "proved",
            Self::Refuted => "refuted",
            Self::Undecided => "undecided",
        })
    }
}
