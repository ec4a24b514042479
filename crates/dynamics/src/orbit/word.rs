//! The word of a periodic motion: its impacts in order, by wall.

use crate::model::{Map, Side};
use smallvec::SmallVec;
use std::fmt;
use std::str::FromStr;

/// The impacts of one periodic motion by wall, `B` for the bottom and `T` for the top: `BT` is the 1-1 motion.
///
/// A word is a circle: `TB` is `BT`. It is written from a bottom impact that follows a top one; where several do
/// (`BBTBT` and `BTBBT`), a text is read as the one that comes first in the alphabet, and the list of a motion's
/// impacts starts at the fastest of them, so that its word may be another [rotation](Word::rotated).
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Word(SmallVec<[Letter; Word::LONGEST]>);

/// A wall, in the order of the alphabet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
enum Letter {
    B,
    T,
}

/// A text that is no word.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WordError {
    /// No letter at all.
    #[error("a word has no letter; write the impacts of one motion by wall, as in BT or BTT")]
    Empty,
    /// A letter other than B and T.
    #[error("the word `{word}` has the letter `{found}`; only B (bottom) and T (top) are allowed")]
    Letter {
        /// The text.
        word: String,
        /// The first letter that is none.
        found: char,
    },
    /// More impacts than a word may have.
    #[error("the word `{word}` has {found} impacts; at most {} are allowed", Word::LONGEST)]
    Long {
        /// The text.
        word: String,
        /// Its letters.
        found: usize,
    },
}

impl Word {
    /// The most impacts a word may have.
    pub const LONGEST: usize = 12;

    /// The 1-1 motion, `BT`.
    pub fn pair() -> Self {
        Self([Letter::B, Letter::T].into_iter().collect())
    }

    /// The number of impacts, from 1 to [`Word::LONGEST`].
    pub fn impacts(&self) -> usize {
        self.0.len()
    }

    /// The walls in order.
    pub fn sides(&self) -> impl ExactSizeIterator<Item = Side> + '_ {
        self.0.iter().map(|letter| letter.side())
    }

    /// The map of (8) that each flight is: the flight that follows impact `index`, in order.
    pub fn flights(&self) -> impl ExactSizeIterator<Item = Map> + '_ {
        let next = |index: usize| self.0[(index + 1) % self.0.len()].side();
        let flight = move |(index, letter): (usize, &Letter)| Map::between(letter.side(), next(index));
        self.0.iter().enumerate().map(flight)
    }

    /// Whether impact `index` may stand first: a bottom impact that follows a top one, and any impact of a word
    /// on one wall.
    pub fn may_start_at(&self, index: usize) -> bool {
        let at = |index: usize| self.0[index % self.0.len()];
        let before = at(index + self.0.len() - 1);
        let one_wall = self.0.iter().all(|letter| *letter == self.0[0]);
        one_wall || (at(index) == Letter::B && before == Letter::T)
    }

    /// The same circle written from impact `first` on.
    pub fn rotated(&self, first: usize) -> Self {
        let mut letters = self.0.clone();
        let length = letters.len();
        letters.rotate_left(first % length);
        Self(letters)
    }

    /// The one spelling that all rotations of a word share: the first in the alphabet, of those that start as a
    /// word does.
    pub fn spelled(&self) -> Self {
        let starts = (0..self.impacts()).filter(|index| self.may_start_at(*index));
        let spellings = starts.map(|first| self.rotated(first));
        spellings.min().unwrap_or_else(|| self.clone())
    }

    /// The rotations other than none that leave the word as it is: 2 for `BTBT`. A motion that such a rotation
    /// leaves as it is too is one of a shorter word.
    pub fn symmetries(&self) -> impl Iterator<Item = usize> + '_ {
        (1..self.impacts()).filter(|shift| self.rotated(*shift) == *self)
    }

    /// Returns the word gone through twice; `None` where that has more impacts than a word may have.
    pub fn twice(&self) -> Option<Self> {
        (2 * self.impacts() <= Self::LONGEST).then(|| Self(self.0.iter().chain(&self.0).copied().collect()))
    }

    /// The word that this one goes through twice.
    pub(crate) fn half(&self) -> Option<Self> {
        let half = self.impacts() / 2;
        let repeats = self.impacts().is_multiple_of(2) && self.0[..half] == self.0[half..];
        repeats.then(|| Self(self.0.iter().take(half).copied().collect()))
    }

    /// The word with one more impact on the wall of this one, next to it.
    pub(crate) fn doubled(&self, index: usize) -> Self {
        let mut letters = self.0.clone();
        letters.insert(index, letters[index]);
        Self(letters)
    }

    /// The word without this impact, if another one stays.
    pub(crate) fn without(&self, index: usize) -> Option<Self> {
        let mut letters = self.0.clone();
        letters.remove(index);
        (!letters.is_empty()).then_some(Self(letters))
    }

    /// The word of the mirrored motion: walls exchanged.
    pub fn mirrored(&self) -> Self {
        Self(self.0.iter().map(|letter| letter.other()).collect()).spelled()
    }
}

impl Letter {
    fn side(self) -> Side {
        match self {
            Self::B => Side::Bottom,
            Self::T => Side::Top,
        }
    }

    fn other(self) -> Self {
        match self {
            Self::B => Self::T,
            Self::T => Self::B,
        }
    }
}

impl FromStr for Word {
    type Err = WordError;

    fn from_str(text: &str) -> Result<Self, WordError> {
        let found = text.chars().count();
        if found == 0 {
            return Err(WordError::Empty);
        }
        let letter = |found: char| match found {
            'B' => Ok(Letter::B),
            'T' => Ok(Letter::T),
            _ => Err(WordError::Letter {
                word: text.to_owned(),
                found,
            }),
        };
        let letters = text.chars().map(letter).collect::<Result<_, _>>()?;
        if found > Self::LONGEST {
            let word = text.to_owned();
            return Err(WordError::Long { word, found });
        }
        Ok(Self(letters).spelled())
    }
}

impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letters = self.0.iter().map(|letter| match letter {
            Letter::B => 'B',
            Letter::T => 'T',
        });
        f.pad(&letters.collect::<String>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word(text: &str) -> Word {
        text.parse().expect("a word")
    }

    #[test]
    fn every_rotation_of_a_word_is_read_as_one_spelling() {
        let spellings = [
            ("BT", &["BT", "TB"][..]),
            ("BTT", &["BTT", "TTB", "TBT"]),
            ("BBT", &["BBT", "BTB", "TBB"]),
            ("BTBT", &["BTBT", "TBTB"]),
            ("BBTBT", &["BBTBT", "BTBTB", "TBTBB", "BTBBT", "TBBTB"]),
            ("B", &["B"]),
            ("T", &["T"]),
            ("TT", &["TT"]),
        ];
        for (spelling, texts) in spellings {
            for text in texts {
                assert_eq!(word(text).to_string(), spelling, "{text}");
            }
        }
        assert_eq!(Word::pair(), word("TB"));
    }

    #[test]
    fn a_text_that_is_no_word_says_why() {
        let error = |text: &str| text.parse::<Word>().expect_err("no word").to_string();
        assert!(error("").contains("no letter"));
        assert!(error("BXT").contains("`X`"));
        assert!(error("bt").contains("`b`"));
        assert!(error("BTBTBTBTBTBTB").contains("13 impacts; at most 12"));
        assert!("BTBTBTBTBTBT".parse::<Word>().is_ok());
    }

    #[test]
    fn the_flights_are_the_maps_between_neighbours() {
        let flights = |text: &str| word(text).flights().collect::<Vec<_>>();
        assert_eq!(flights("BT"), [Map::P1, Map::P2]);
        assert_eq!(flights("BTT"), [Map::P1, Map::P4, Map::P2]);
        assert_eq!(flights("BBT"), [Map::P3, Map::P1, Map::P2]);
        assert_eq!(flights("B"), [Map::P3]);
    }

    #[test]
    fn a_word_starts_at_a_bottom_impact_that_follows_a_top_one() {
        let starts = |text: &str| {
            let word = word(text);
            (0..word.impacts())
                .filter(|index| word.may_start_at(*index))
                .collect::<Vec<_>>()
        };
        assert_eq!(starts("BBTBT"), [0, 3]);
        assert_eq!(starts("BTT"), [0]);
        assert_eq!(starts("TT"), [0, 1]);
        assert_eq!(word("BBTBT").rotated(3).to_string(), "BTBBT");
    }

    #[test]
    fn the_mirror_exchanges_the_walls() {
        for (text, mirrored) in [("BT", "BT"), ("BTT", "BBT"), ("B", "T"), ("BBTBT", "BTBTT")] {
            assert_eq!(word(text).mirrored().to_string(), mirrored);
            assert_eq!(word(mirrored).mirrored(), word(text));
        }
    }

    #[test]
    fn a_word_with_an_impact_or_itself_twice_has_a_shorter_one() {
        assert_eq!(word("BT").twice(), Some(word("BTBT")));
        assert_eq!(word("BTTBTT").twice().map(|twice| twice.impacts()), Some(12));
        assert_eq!(word("BTTBTTT").twice(), None);
        assert_eq!(word("BTBT").half(), Some(word("BT")));
        assert_eq!((word("BTT").half(), word("BBTT").half()), (None, None));
        assert_eq!(word("BT").doubled(1), word("BTT"));
        assert_eq!(word("BTT").without(2), Some(word("BT")));
        assert_eq!(word("B").without(0), None);
    }

    #[test]
    fn a_word_that_repeats_itself_has_symmetries() {
        let symmetries = |text: &str| word(text).symmetries().collect::<Vec<_>>();
        assert_eq!(symmetries("BTBT"), [2]);
        assert_eq!(symmetries("BTBTBT"), [2, 4]);
        assert!(symmetries("BTT").is_empty());
        assert_eq!(symmetries("BB"), [1]);
    }
}
