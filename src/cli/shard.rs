//! One of several parts of a long run, which says what it is.

use super::Failure;
use crate::orbit::OptimumPart;
use crate::report::{Checksum, fingerprint};
use crate::scene::{Scene, Want};
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// One of several parts of a run, as in `3/16`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 1.
    number: u32,
    of: u32,
}

impl Shard {
    /// All of a run.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// The same of a search for an optimum.
    pub fn part(self) -> OptimumPart {
        let Self { number, of } = self;
        OptimumPart { number, of }
    }

    /// What of so many things it has: the parts follow one another and differ by one at most.
    pub fn range(self, total: u64) -> Range<u64> {
        // no more than `total`, which fits
        let before = |parts: u32| (u128::from(total) * u128::from(parts) / u128::from(self.of)) as u64;
        before(self.number - 1)..before(self.number)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(number, of)| {
            let read = |text: &str| text.parse::<u32>().ok().filter(|number| *number > 0);
            Some((read(number)?, read(of)?))
        });
        match numbers {
            Some((number, of)) if number <= of => Ok(Self { number, of }),
            _ => Err("write the part and their number, from 1/N to N/N, as in 3/16".to_owned()),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {}", self.number, self.of)
    }
}

/// What a part says of itself: in its first line what it is part of, in its last how many rows it has, and a sum over them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    pub number: u32,
    pub of: u32,
    /// Version, command and scene.
    pub run: String,
}

const HEAD: &str = "# vibro-audit part ";
const TAIL: &str = "# end of part ";

impl Label {
    /// Of a part of a command, which computes what this scene says for these wants.
    pub fn new(shard: Shard, command: &str, scene: &Scene, wants: &[Want]) -> Result<Self, Failure> {
        let explained = scene.explain(wants, |_| true)?;
        // the name of the scene, which may be another on another machine, stands in the first line
        let (_, modelled) = explained.split_once('\n').unwrap_or_default();
        let version = env!("CARGO_PKG_VERSION");
        Ok(Self {
            number: shard.number,
            of: shard.of,
            run: format!("{command} {version} {}", fingerprint(command, version, modelled)),
        })
    }

    /// Whether it is a part of this command.
    pub fn is_of(&self, command: &str) -> bool {
        self.run.split(' ').next() == Some(command)
    }

    /// The first line of the part.
    pub fn head(&self) -> String {
        format!("{HEAD}{} of {}: {}", self.number, self.of, self.run)
    }

    /// The last line of the part; `sum`: of what stands between it and the first.
    pub fn tail(&self, rows: usize, sum: Checksum) -> String {
        format!("{TAIL}{} of {}: {rows} rows, {sum}", self.number, self.of)
    }

    /// Reads the first line of a part.
    pub fn read(line: &str) -> Option<Self> {
        let (part, run) = line.strip_prefix(HEAD)?.split_once(": ")?;
        let (number, of) = part.split_once(" of ")?;
        let (number, of) = (number.parse().ok()?, of.parse().ok()?);
        (1 <= number && number <= of).then(|| Self {
            number,
            of,
            run: run.to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_parts_follow_one_another_and_are_of_one_size(total in 0u64..=u64::MAX, of in 1u32..60) {
            let mut next = 0;
            for number in 1..=of {
                let part = Shard { number, of }.range(total);
                prop_assert_eq!(part.start, next);
                let size = part.end - part.start;
                prop_assert!(size == total / u64::from(of) || size == total / u64::from(of) + 1);
                next = part.end;
            }
            prop_assert_eq!(next, total);
        }
    }

    #[test]
    fn what_is_no_part_is_refused() {
        assert_eq!("3/16".parse(), Ok(Shard { number: 3, of: 16 }));
        for text in [
            "",
            "3",
            "0/4",
            "5/4",
            "1/0",
            "-1/4",
            "1/4/2",
            "1.0/4",
            "a/b",
            "99999999999/99999999999",
        ] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }

    #[test]
    fn a_part_says_what_it_is() {
        let label = Label {
            number: 3,
            of: 16,
            run: "map 0.1.0 0123".to_owned(),
        };
        assert_eq!(Label::read(&label.head()), Some(label.clone()));
        assert_eq!(
            label.tail(7, Checksum::default()),
            "# end of part 3 of 16: 7 rows, cbf29ce484222325"
        );
        for line in [
            "",
            "x,y",
            "# vibro-audit part 3 of 2: map",
            "# vibro-audit part 0 of 2: map",
        ] {
            assert_eq!(Label::read(line), None, "{line}");
        }
    }
}
