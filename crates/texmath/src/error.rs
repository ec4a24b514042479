//! Why a formula could not be read, and where.

use super::Place;

/// What stood in the way of reading a formula; each message says what to write instead where that is known.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Reason {
    /// Longer than any formula.
    #[error("the formula is {bytes} bytes long; at most {most} are read")]
    TooLong { bytes: usize, most: usize },
    /// Nested deeper than the stack of the walks over the tree allows.
    #[error("nested deeper than {most} levels")]
    TooDeep { most: usize },
    /// Nothing, or an expression without a relation.
    #[error("no equation here: write `left = right`, or an inequality")]
    NoEquation,
    /// No condition, or an expression alone.
    #[error("no condition here: write `x > 0`, `x \\in [0, 1]` or `n \\in \\mathbb{{Z}}`")]
    NoCondition,
    /// A sign or command that has no meaning here.
    #[error("cannot read {found} here{instead}")]
    Unreadable { found: String, instead: String },
    /// Something known, but out of place.
    #[error("found {found} where {wanted} must stand")]
    Unexpected { found: String, wanted: String },
    /// A bracket, brace or environment without its end.
    #[error("{open} is not closed")]
    Unclosed { open: String },
    /// An end without its beginning.
    #[error("{close} closes nothing")]
    Unopened { close: String },
    /// A bracket of one kind closed by one of another.
    #[error("{open} is closed by {close}")]
    Mismatched { open: String, close: String },
    /// Something that authors mean different things by.
    #[error("{found} can be read in more than one way: {instead}")]
    Ambiguous { found: String, instead: &'static str },
    /// Something with exactly two readings.
    #[error("{found} can be read as {first} or as {second}: write the one that is meant")]
    TwoReadings {
        found: String,
        first: String,
        second: String,
    },
    /// Something with a clear meaning that is not supported.
    #[error("{found} cannot be read: {instead}")]
    Unsupported { found: String, instead: &'static str },
    /// A trace or determinant of something that was not declared a matrix.
    #[error("{found} is no known matrix (known: {known})")]
    UnknownMatrix { found: String, known: String },
    /// An upright word that was not declared.
    #[error("{found} is no declared name: declare it, or set its letters apart")]
    UnknownWord { found: String },
}

/// A formula that could not be read: why, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}, column {column}: {reason}")]
pub struct ReadError {
    /// What stood in the way.
    pub reason: Reason,
    /// The byte offset into the TeX.
    pub at: usize,
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
}

impl ReadError {
    /// The offending line of `tex` and a caret beneath the place.
    pub fn caret(&self, tex: &str) -> String {
        let line = tex.split('\n').nth(self.line.saturating_sub(1)).unwrap_or("");
        // A tab would shift the caret, so it is shown as one blank.
        let shown = line.trim_end_matches('\r').replace('\t', " ");
        let indent = " ".repeat(self.column.saturating_sub(1));
        format!("{shown}\n{indent}^")
    }
}

/// A reason and its byte offset, before line and column are known. Small, because it is part of every result of
/// the recursive reader, whose stack must stay small.
#[derive(Debug)]
pub(super) struct Fault {
    reason: Box<Reason>,
    at: usize,
}

impl Fault {
    pub(super) fn new(at: usize, reason: Reason) -> Self {
        let reason = Box::new(reason);
        Self { reason, at }
    }

    pub(super) fn unreadable(at: usize, found: &str, instead: &str) -> Self {
        let (found, instead) = (quoted(found), instead.to_owned());
        Self::new(at, Reason::Unreadable { found, instead })
    }

    pub(super) fn unexpected(at: usize, found: &str, wanted: &str) -> Self {
        let (found, wanted) = (quoted(found), wanted.to_owned());
        Self::new(at, Reason::Unexpected { found, wanted })
    }

    pub(super) fn ambiguous(at: usize, found: &str, instead: &'static str) -> Self {
        let found = found.to_owned();
        Self::new(at, Reason::Ambiguous { found, instead })
    }

    pub(super) fn two_readings(at: usize, found: &str, first: &str, second: &str) -> Self {
        let (found, first, second) = (found.to_owned(), shortened(first, 120), shortened(second, 120));
        Self::new(at, Reason::TwoReadings { found, first, second })
    }

    pub(super) fn unsupported(at: usize, found: &str, instead: &'static str) -> Self {
        let found = found.to_owned();
        Self::new(at, Reason::Unsupported { found, instead })
    }

    pub(super) fn unclosed(at: usize, open: &str) -> Self {
        let open = quoted(open);
        Self::new(at, Reason::Unclosed { open })
    }

    /// The place of what may be put out of sight: of a formula that is no equation, or is too large, nothing is.
    pub(super) fn place(&self) -> Option<usize> {
        let is_whole = matches!(
            *self.reason,
            Reason::TooLong { .. } | Reason::TooDeep { .. } | Reason::NoEquation | Reason::NoCondition
        );
        (!is_whole).then_some(self.at)
    }

    /// The same fault at another place.
    pub(super) fn moved(self, to: impl Fn(usize) -> usize) -> Self {
        let at = to(self.at);
        Self { at, ..self }
    }

    /// The error as the user sees it: line and column counted in `tex`.
    pub(super) fn located(self, tex: &str) -> ReadError {
        let Place { line, column } = Place::of(tex, self.at);
        let mut at = self.at.min(tex.len());
        while !tex.is_char_boundary(at) {
            at -= 1;
        }
        ReadError {
            reason: *self.reason,
            at,
            line,
            column,
        }
    }
}

/// `text` between backticks, shortened: a message is no place for a whole formula.
fn quoted(text: &str) -> String {
    format!("`{}`", shortened(text, 24))
}

/// At most the first `most` characters of `text`.
fn shortened(text: &str, most: usize) -> String {
    let mut shown: String = text.chars().take(most).collect();
    if shown.len() < text.len() {
        shown.push('…');
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_characters_not_bytes() {
        let tex = "a = b\n% é −\n− é ? x";
        let at = tex.find('?').unwrap();
        let error = Fault::unreadable(at, "?", "").located(tex);
        assert_eq!((error.line, error.column), (3, 5));
        assert_eq!(error.caret(tex), "− é ? x\n    ^");
        assert_eq!(error.to_string(), "line 3, column 5: cannot read `?` here");
    }

    #[test]
    fn survives_a_place_off_the_text() {
        let error = Fault::new(99, Reason::NoEquation).located("é");
        assert_eq!((error.at, error.column), (2, 2));
        assert_eq!(error.caret(""), "\n ^");
    }
}
