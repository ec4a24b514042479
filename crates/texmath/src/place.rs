//! Where in a text something stands, as an editor counts.

use std::fmt;

/// Line and column, both from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    pub line: usize,
    pub column: usize,
}

/// A text and where its lines start, for the places of many bytes of it.
#[derive(Debug)]
pub struct Lines<'a> {
    pub text: &'a str,
    starts: Vec<usize>,
    /// The characters that start before each block of [`BLOCK`] bytes: a line may be as long as the text.
    characters: Vec<usize>,
}

const BLOCK: usize = 1024;

/// The characters that start within these bytes.
fn characters(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| **byte & 0xC0 != 0x80).count()
}

impl<'a> Lines<'a> {
    /// The lines of a text.
    pub fn new(text: &'a str) -> Self {
        let ends = text.match_indices('\n').map(|(end, _)| end + 1);
        let starts = std::iter::once(0).chain(ends).collect();
        let blocks = text.as_bytes().chunks(BLOCK).scan(0, |before, block| {
            *before += characters(block);
            Some(*before)
        });
        let characters = std::iter::once(0).chain(blocks).collect();
        Self {
            text,
            starts,
            characters,
        }
    }

    /// The characters before byte `at`.
    fn before(&self, at: usize) -> usize {
        let block = at / BLOCK;
        let rest = self.text.as_bytes().get(block * BLOCK..at).unwrap_or_default();
        self.characters.get(block).copied().unwrap_or_default() + characters(rest)
    }

    /// The place of byte `at`; within a character, that character's; beyond the end, the end.
    pub fn place(&self, at: usize) -> Place {
        let mut at = at.min(self.text.len());
        while !self.text.is_char_boundary(at) {
            at -= 1;
        }
        let line = self.starts.partition_point(|&start| start <= at);
        let start = line.checked_sub(1).and_then(|n| self.starts.get(n)).copied();
        Place {
            line,
            column: self.before(at) - self.before(start.unwrap_or(0)) + 1,
        }
    }
}

impl Place {
    /// The place of one byte of `text`, as [`Lines::place`] says.
    pub fn of(text: &str, at: usize) -> Self {
        Lines::new(text).place(at)
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}", self.line, self.column)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_are_counted_not_bytes() {
        let text = "a = 1\né = −2\n";
        let place = |at| (Place::of(text, at).line, Place::of(text, at).column);
        let two = text.find('2').unwrap();
        assert_eq!([place(0), place(two), place(999)], [(1, 1), (2, 6), (3, 1)]);
        assert_eq!(place(two - 1), (2, 5), "within the minus sign");
        assert_eq!(Place::of(text, two).to_string(), "line 2, column 6");
        let long = "é−a".repeat(1000);
        let lines = Lines::new(&long);
        for (n, (at, _)) in long.char_indices().enumerate() {
            assert_eq!(lines.place(at), Place { line: 1, column: n + 1 });
        }
    }
}
