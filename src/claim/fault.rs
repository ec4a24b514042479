//! What is wrong with a sheet, and where.

use crate::tex::{Lines, Name, Place};
use std::fmt;
use toml::Spanned;

/// A file within a text of several: where it starts, and its name if it is not the first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    pub start: usize,
    pub name: Option<String>,
}

/// A text of one file, or of several one after the other.
pub(super) struct Text<'a> {
    lines: Lines<'a>,
    files: &'a [File],
}

impl<'a> Text<'a> {
    /// The text of a file.
    pub fn new(text: &'a str) -> Self {
        Self::of_files(text, &[])
    }

    /// A text in which these files start.
    pub fn of_files(text: &'a str, files: &'a [File]) -> Self {
        let lines = Lines::new(text);
        Self { lines, files }
    }

    /// The file that byte `at` stands in, if it is not the first, and the place there.
    fn place(&self, at: usize) -> (Option<String>, Place) {
        let Place { line, column } = self.lines.place(at);
        let file = self.files.iter().rev().find(|file| file.start <= at);
        let before = file.map_or(1, |file| self.lines.place(file.start).line);
        let line = line + 1 - before;
        (file.and_then(|file| file.name.clone()), Place { line, column })
    }
}

/// A piece of TeX and where in the file it starts.
#[derive(Clone, Debug, Default)]
pub struct Source {
    pub tex: String,
    /// The file, where it is not the one that is read but one that it includes.
    pub file: Option<String>,
    line: usize,
    column: usize,
    /// Whether a place in the TeX is a place in the file (not where the TOML string has escapes).
    verbatim: bool,
}

/// Characters shown on either side of the place of a fault.
const MOST_SHOWN: usize = 160;

impl Source {
    /// Another text of the same length at the same place.
    pub(super) fn with_tex(&self, tex: String) -> Self {
        Self { tex, ..self.clone() }
    }

    pub(super) fn new(text: &Text, value: &Spanned<String>) -> Self {
        let span = value.span();
        let raw = text.lines.text.get(span.clone()).unwrap_or_default();
        let offset = raw.find(value.get_ref().as_str());
        let (file, Place { line, column }) = text.place(span.start + offset.unwrap_or(0));
        Self {
            tex: value.get_ref().clone(),
            file,
            line,
            column,
            verbatim: offset.is_some(),
        }
    }

    /// TeX that stands in no file.
    pub(super) fn unplaced(tex: String) -> Self {
        Self { tex, ..Self::default() }
    }

    /// Line and column where the TeX starts in the file, from 1.
    pub fn place(&self) -> (usize, usize) {
        (self.line, self.column)
    }

    /// Line and column of byte `at` of the TeX, where what stands in the file is this TeX.
    pub fn place_of(&self, at: usize) -> Option<(usize, usize)> {
        let before = self.tex.get(..at)?;
        let row = before.matches('\n').count();
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count();
        let place = match row {
            0 => (self.line, self.column + column),
            row => (self.line + row, column + 1),
        };
        self.verbatim.then_some(place)
    }

    /// A fault at byte `at` of the TeX.
    pub fn fault(&self, at: usize, message: impl Into<String>) -> Fault {
        let at = (0..=at.min(self.tex.len()))
            .rev()
            .find(|&n| self.tex.is_char_boundary(n))
            .unwrap_or(0);
        let (before, after) = self.tex.split_at(at);
        let line_start = before.rfind('\n').map_or(0, |n| n + 1);
        let head = before.get(line_start..).unwrap_or_default();
        let tail = after.split('\n').next().unwrap_or_default();
        let place = self.place_of(at).unwrap_or((self.line, self.column));
        // Of a line of megabytes the part around the place is enough.
        let near = |text: &str, from_end: bool| -> String {
            let count = text.chars().count();
            let skip = if from_end { count.saturating_sub(MOST_SHOWN) } else { 0 };
            text.chars().skip(skip).take(MOST_SHOWN).collect()
        };
        let (head, tail) = (near(head, true), near(tail, false));
        let indent = " ".repeat(head.chars().count());
        let shown = format!("    {head}{tail}\n    {indent}^").replace('\t', " ");
        Fault {
            message: message.into(),
            label: None,
            file: self.file.clone(),
            place: Some(place),
            more: Some(Box::new(More {
                shown,
                unknown: Vec::new(),
            })),
        }
    }
}

/// A symbol that nothing declares, and the declared one that was probably meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Unknown {
    pub name: Name,
    pub meant: Option<String>,
}

/// What else is known of a fault within TeX.
#[derive(Clone, Debug, PartialEq, Eq)]
struct More {
    /// The line of TeX with a caret beneath.
    shown: String,
    /// The symbols that nothing declares, where that is the fault.
    unknown: Vec<Unknown>,
}

/// Why a sheet cannot be used: what, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    pub message: String,
    /// The equation at fault.
    pub label: Option<String>,
    /// The file, where it is not the one that is read but one that it includes.
    pub file: Option<String>,
    /// Line and column in the file, from 1.
    pub place: Option<(usize, usize)>,
    more: Option<Box<More>>,
}

impl Fault {
    /// A fault without a place.
    pub fn new(message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            label: None,
            file: None,
            place: None,
            more: None,
        }
    }

    /// The fault, said of the equation `label` where none is named yet.
    pub fn of(mut self, label: &str) -> Self {
        self.label.get_or_insert_with(|| label.to_string());
        self
    }

    /// Two faults of one equation: the place is that of the first.
    pub(super) fn and(mut self, other: Self) -> Self {
        let place = other
            .place
            .map(|(line, column)| format!("line {line}, column {column}: "));
        self.message = format!("{}; {}{}", self.message, place.unwrap_or_default(), other.message);
        if let (Some(more), Some(others)) = (&mut self.more, other.more) {
            more.unknown.extend(others.unknown);
        }
        self
    }

    /// The fault, which is that nothing declares this symbol.
    pub(super) fn of_unknown(mut self, unknown: Option<Unknown>) -> Self {
        if let Some(more) = &mut self.more {
            more.unknown.extend(unknown);
        }
        self
    }

    /// The symbols that nothing declares, where that is the fault.
    pub(super) fn unknown(&self) -> &[Unknown] {
        self.more.as_ref().map_or(&[], |more| &more.unknown)
    }

    /// The fault with a word in front of its message.
    pub(super) fn within(mut self, part: &str) -> Self {
        self.message = format!("{part} {}", self.message);
        self
    }

    /// The fault, at the start of `source` where it has no place yet.
    pub fn at(mut self, source: &Source) -> Self {
        if self.place.is_none() {
            self.place = Some((source.line, source.column));
            self.file.clone_from(&source.file);
        }
        self
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}, ")?;
        }
        if let Some((line, column)) = self.place {
            write!(f, "line {line}, column {column}: ")?;
        }
        if let Some(label) = &self.label {
            write!(f, "({label}) ")?;
        }
        f.write_str(&self.message)?;
        match &self.more {
            Some(more) => write!(f, "\n{}", more.shown),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Fault {}
