//! Places of a text as the protocol counts them: lines from 0, and UTF-16 code units in them.

use serde_json::{Value, json};

/// The lines of a text.
#[derive(Debug)]
pub struct Lines<'t>(Vec<&'t str>);

/// A place by its line and its UTF-16 code units, both from 0.
pub type Position = (usize, usize);

/// A part of a text, its end left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    pub start: Position,
    pub end: Position,
}

impl<'t> Lines<'t> {
    /// Splits a text at `\n` and `\r\n`.
    pub fn new(text: &'t str) -> Self {
        let lines = text.split('\n').map(|line| line.strip_suffix('\r').unwrap_or(line));
        Self(lines.collect())
    }

    /// Converts a line and a column in characters, both from 1; a column behind the end of the line is its end.
    pub fn position(&self, (line, column): (usize, usize)) -> Position {
        let line = line.saturating_sub(1);
        let Some(text) = self.0.get(line) else {
            return (self.0.len(), 0);
        };
        let before = text.chars().take(column.saturating_sub(1));
        (line, before.map(char::len_utf16).sum())
    }

    /// Returns the end of a line, which is counted from 1.
    pub fn end(&self, line: usize) -> Position {
        self.position((line, usize::MAX))
    }
}

impl Range {
    /// Reads a range of the protocol.
    pub fn read(value: &Value) -> Option<Self> {
        let [start, end] = ["start", "end"].map(|key| value.get(key).and_then(position));
        Some(Self {
            start: start?,
            end: end?,
        })
    }

    /// Returns the range as the protocol writes it.
    pub fn json(self) -> Value {
        let place = |(line, character): Position| json!({ "line": line, "character": character });
        json!({ "start": place(self.start), "end": place(self.end) })
    }

    /// Returns true if both ranges have a place in common, ends included.
    pub fn meets(self, other: Self) -> bool {
        self.start <= other.end && other.start <= self.end
    }
}

/// Reads a position of the protocol.
pub fn position(value: &Value) -> Option<Position> {
    let number = |key: &str| value.get(key)?.as_u64().and_then(|number| usize::try_from(number).ok());
    number("line").zip(number("character"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_counted_in_utf_16() {
        let lines = Lines::new("a\u{e4}b\r\n\u{1f600}x\n");
        for (place, expected) in [
            ((1, 1), (0, 0)),
            ((1, 3), (0, 2)),
            ((1, 99), (0, 3)),
            ((2, 2), (1, 2)),
            ((2, 3), (1, 3)),
            ((3, 1), (2, 0)),
            ((9, 4), (3, 0)),
        ] {
            assert_eq!(lines.position(place), expected, "{place:?}");
        }
        assert_eq!(lines.end(2), (1, 3));
    }
}
