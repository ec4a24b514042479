//! What is wrong with a sheet, and where.

use std::fmt;
use texmath::{Lines, Place, ReadError, Unknown};
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
#[derive(Clone, Debug, PartialEq, Default)]
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

    /// The fault that the TeX cannot be read, with advice where it has a decimal comma or a unit.
    pub fn misread(&self, error: &ReadError) -> Fault {
        let advice = advice(&self.tex, error.at).map_or(String::new(), |advice| format!("; {advice}"));
        self.fault(error.at, format!("{}{advice}", error.reason))
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

/// Returns what to write instead of TeX that cannot be read at a place, where that can be told.
fn advice(tex: &str, at: usize) -> Option<&'static str> {
    let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let has_comma = ["{,}", ","].iter().any(|comma| {
        tex.match_indices(comma).any(|(place, _)| {
            let (before, behind) = (tex.get(..place), tex.get(place + comma.len()..));
            // x_{1,2} and (1,2) are lists
            let whole = before.map(|text| text.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.'));
            let is_list = whole.is_some_and(|text| text.ends_with("_{") || text.ends_with(['(', '[', ',']));
            !is_list
                && is_digit(before.and_then(|text| text.chars().last()))
                && is_digit(behind.and_then(|text| text.chars().next()))
        })
    });
    if has_comma {
        return Some("write numbers with a decimal point, 9.81");
    }
    // a unit stands where the reading ends, or is a command of siunitx
    let of_siunitx = [r"\SI{", r"\si{", r"\qty{", r"\unit{"]
        .iter()
        .any(|command| tex.contains(command));
    // the fault is the command, or stands in its braces
    let before = tex.get(..at).unwrap_or_default();
    let start = before
        .rfind('\\')
        .filter(|start| !tex[*start..at].contains('}'))
        .unwrap_or(at);
    let starts = [at, start].map(|start| tex.get(start..).unwrap_or_default().trim_start());
    let commands = [r"\mathrm{", r"\text{", r"\textrm{", r"\rm "];
    let inner = starts
        .iter()
        .find_map(|near| commands.iter().find_map(|command| near.strip_prefix(command)));
    let unit = inner.and_then(|inner| inner.split('}').next()).unwrap_or_default();
    let is_unit = |word: &str| UNITS.contains(&word);
    let words = unit.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty());
    let is_of_units = !unit.is_empty() && words.clone().count() > 0 && words.clone().all(is_unit);
    (of_siunitx || is_of_units).then_some("units are not read: leave them out")
}

/// Units that stand behind numbers.
const UNITS: [&str; 24] = [
    "m", "mm", "cm", "km", "s", "ms", "min", "h", "kg", "g", "N", "kN", "J", "W", "V", "A", "Hz", "kHz", "Pa", "kPa",
    "K", "C", "rad", "deg",
];

/// The line at fault within TeX, and the symbols that it lacks.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decimal_comma_and_a_unit_are_told_as_such() {
        let point = Some("write numbers with a decimal point, 9.81");
        let unit = Some("units are not read: leave them out");
        for (tex, at, wanted) in [
            ("g = 9,81", 0, point),
            (r"g = \frac{9,81}{2}", 11, point),
            ("g = 9{,}81", 5, point),
            (r"9.81 \mathrm{m/s^2}", 5, unit),
            (r"9.81 \mathrm{m/s^2}", 12, unit),
            (r"9.81\,\text{m/s}^2", 6, unit),
            (r"\SI{9.81}{m/s^2}", 0, unit),
            (r"x = \foo", 4, None),
            (r"x_{1,2} = \foo (1,2)", 10, None),
            (r"f(a, b) = \text{for}", 10, None),
            (r"\mathrm{m} x = \foo", 15, None),
        ] {
            assert_eq!(advice(tex, at), wanted, "{tex}");
        }
    }
}
