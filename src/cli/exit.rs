//! The exit status.

use std::process::ExitCode;

/// What the exit status says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// All is as expected: 0.
    AsExpected,
    /// A verdict or a value is not as expected: 1.
    NotAsExpected,
    /// The input cannot be used: 2.
    Unusable,
    /// A signal has stopped it: 130.
    Stopped,
}

impl Exit {
    /// [`Exit::AsExpected`] where `as_expected` holds, else [`Exit::NotAsExpected`].
    pub const fn from_verdict(as_expected: bool) -> Self {
        if as_expected {
            Self::AsExpected
        } else {
            Self::NotAsExpected
        }
    }

    /// Returns the worse of two.
    pub const fn or_worse(self, other: Self) -> Self {
        if other.code() > self.code() { other } else { self }
    }

    /// The number the shell sees.
    pub const fn code(self) -> u8 {
        match self {
            Self::AsExpected => 0,
            Self::NotAsExpected => 1,
            Self::Unusable => 2,
            Self::Stopped => super::signals::STATUS,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worse_of_two_is_that_of_both() {
        let [good, open, bad] = [Exit::AsExpected, Exit::NotAsExpected, Exit::Unusable];
        assert_eq!(
            [good.or_worse(open), bad.or_worse(open), good.or_worse(good)],
            [open, bad, good]
        );
    }

    #[test]
    fn scripts_may_rely_on_the_numbers() {
        assert_eq!(
            [Exit::AsExpected, Exit::NotAsExpected, Exit::Unusable, Exit::Stopped].map(Exit::code),
            [0, 1, 2, 130]
        );
        assert_eq!(
            [true, false].map(Exit::from_verdict),
            [Exit::AsExpected, Exit::NotAsExpected]
        );
    }
}
