//! What is found of a printed value.

use std::fmt;
use std::str::FromStr;

/// What is found of a printed value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// Within half a unit of the last printed figure: correctly rounded; of words, the same.
    Reproduced,
    /// The computed value with its last figures cut off instead of rounded.
    Truncated,
    /// Any other value within one unit of the last printed figure.
    OffByOne,
    /// Within one unit of the figure before the last.
    Rounded,
    /// None of these; the computed value is the true one.
    Wrong,
    /// The paper does not say enough for anything to be computed.
    Undetermined,
    /// The computed value is not known well enough to tell: never a pass, so never expected.
    Undecided,
}

impl Verdict {
    /// Those that a row may expect.
    pub const EXPECTED: [Self; 6] = [
        Self::Reproduced,
        Self::Truncated,
        Self::OffByOne,
        Self::Rounded,
        Self::Wrong,
        Self::Undetermined,
    ];

    /// The name in files and tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Truncated => "truncated",
            Self::OffByOne => "off-by-one",
            Self::Rounded => "rounded",
            Self::Wrong => "wrong",
            Self::Undetermined => "undetermined",
            Self::Undecided => "undecided",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A word that no row may expect.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no verdict to expect: reproduced, truncated, off-by-one, rounded, wrong and undetermined are")]
pub struct UnknownVerdict(pub String);

impl FromStr for Verdict {
    type Err = UnknownVerdict;

    fn from_str(name: &str) -> Result<Self, UnknownVerdict> {
        Self::EXPECTED
            .into_iter()
            .find(|verdict| verdict.name() == name)
            .ok_or_else(|| UnknownVerdict(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_verdict_but_undecided_may_be_expected() {
        for verdict in Verdict::EXPECTED {
            assert_eq!(verdict.name().parse(), Ok(verdict));
        }
        for name in ["undecided", "correct", "Reproduced", ""] {
            assert!(name.parse::<Verdict>().is_err(), "{name}");
        }
    }
}
