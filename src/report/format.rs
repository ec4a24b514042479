//! The formats a table can be printed in.

use std::fmt;
use std::str::FromStr;

/// How a table is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Format {
    /// Aligned columns for a reader; numbers are rounded.
    #[default]
    Text,
    /// A header and one record per row.
    Csv,
    /// An array with one object per row.
    Json,
    /// One object per row and line, each written when it is known.
    Jsonl,
    /// A table for a report or an issue.
    Markdown,
    /// A test report for CI, one test a row; of tables that have verdicts only.
    Junit,
    /// A page for a reader, one file.
    Html,
    /// Findings for CI, with their places in the source.
    Sarif,
    /// Proofs as short scripts for people, with the rows as text.
    Sympy,
    /// Proofs as files for Rocq, with the rows as text.
    Rocq,
}

impl Format {
    /// Every format, in the order in which help lists them.
    pub const ALL: [Self; 10] = [
        Self::Text,
        Self::Csv,
        Self::Json,
        Self::Jsonl,
        Self::Markdown,
        Self::Junit,
        Self::Html,
        Self::Sarif,
        Self::Sympy,
        Self::Rocq,
    ];

    /// Whether it prints tables row by row, whatever they hold.
    pub const fn is_of_rows(self) -> bool {
        !matches!(self, Self::Junit | Self::Html | Self::Sarif)
    }

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::Csv => "csv",
            Self::Json => "json",
            Self::Jsonl => "jsonl",
            Self::Markdown => "markdown",
            Self::Junit => "junit",
            Self::Html => "html",
            Self::Sarif => "sarif",
            Self::Sympy => "sympy",
            Self::Rocq => "rocq",
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that is no format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown format `{0}`: text, csv, json, jsonl, markdown, junit, html, sarif, sympy and rocq are known")]
pub struct UnknownFormat(pub String);

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(name: &str) -> Result<Self, UnknownFormat> {
        Self::ALL
            .into_iter()
            .find(|format| format.name() == name)
            .ok_or_else(|| UnknownFormat(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_format_reads_back_from_its_name() {
        for format in Format::ALL {
            assert_eq!(format.name().parse(), Ok(format));
        }
    }

    #[test]
    fn an_unknown_name_is_an_error_that_lists_the_known_ones() {
        let error = "xml".parse::<Format>().unwrap_err().to_string();
        for format in Format::ALL {
            assert!(error.contains(format.name()), "{error}");
        }
    }
}
