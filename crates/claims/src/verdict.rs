//! What is decided of a claim.

use serde::Deserialize;
use std::fmt;

/// Whether a claim follows from its premises.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// It does, by proofs that the kernel accepts of the goals to which it is reduced.
    #[default]
    Proved,
    /// It does not: the kernel accepts a point at which the premises hold and the claim fails, or the claim is nowhere
    /// defined.
    Refuted,
    /// It does but where a factor of each term of a premise is 0: there the kernel accepts a point at which it fails and one at
    /// which it holds. An author divided by the factor.
    Conditional,
    /// Neither was found within the limits. Never a pass, and never to be expected.
    #[serde(skip)]
    Undecided,
    /// The formula, or a name in it, cannot be read.
    Unread,
    /// A document without comments gives it: a definition, or a law that does not follow from what stands before it.
    #[serde(skip)]
    Given,
    /// A link of a chain in a document without comments that fails where what stands before it holds, and that one small
    /// repair makes provable.
    #[serde(skip)]
    Suspect,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Proved => "proved",
            Self::Refuted => "refuted",
            Self::Conditional => "conditional",
            Self::Undecided => "undecided",
            Self::Unread => "unread",
            Self::Given => "given",
            Self::Suspect => "suspect",
        })
    }
}
