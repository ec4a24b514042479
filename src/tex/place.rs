//! Where in a text something stands, as an editor counts.

use std::fmt;

/// Line and column, both from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    pub line: usize,
    pub column: usize,
}

impl Place {
    /// The place of byte `at` of `text`; within a character, that character's; beyond the end, the end.
    pub fn of(text: &str, at: usize) -> Self {
        let mut at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        let before = text.get(..at).unwrap_or_default();
        let last = before.rsplit('\n').next().unwrap_or_default();
        Self {
            line: before.matches('\n').count() + 1,
            column: last.chars().count() + 1,
        }
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
    }
}
