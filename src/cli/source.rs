//! Where a command reads from: a file, `-` for stdin.

use super::{caller, note};
use crate::input::{open_regular, read_at_most};
use crate::report::{note_input, note_stdin};
use crate::scene::find;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// The longest sheet or scene that is read, in MB: TOML takes up to eighty times its length in memory.
pub const TOML_AT_MOST: u64 = 2;

/// The longest document, and the longest file that it includes, in MB.
pub const DOCUMENT_AT_MOST: u64 = 8;

/// The longest notebook that is read, in MB: nearly all of a long one is the output of its code.
pub const NOTEBOOK_AT_MOST: u64 = 64;

/// The longest table of answers that is read, in MB.
pub const ANSWERS_AT_MOST: u64 = 16;

/// A file, or stdin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// Standard input, named `-`.
    Stdin,
    /// Standard input in the place of a file, whose name says what it is and where what it includes lies.
    InPlaceOf(PathBuf),
    /// A file; one that is called `-` can be named `./-`.
    File(PathBuf),
}

/// Input that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("cannot read {place}: {problem}")]
pub struct SourceError {
    /// The path as the user gave it, or `stdin`.
    pub place: String,
    /// What failed.
    pub problem: SourceProblem,
}

/// What failed.
#[derive(Debug, thiserror::Error)]
pub enum SourceProblem {
    /// Nothing stands at the path.
    #[error("there is no such file; give the path of a file, or `-` for stdin")]
    Missing,
    /// The name is that of a built-in scene.
    #[error(
        "there is no such file; `{0}` is a scene, which `vibro-audit run {0} --out DIR`, orbits, branch, sweep and their like take"
    )]
    Scene(String),
    /// The path is a directory.
    #[error("it is a directory; name a file in it")]
    Directory,
    /// It has more than so many MB.
    #[error("it has more than {0} MB; no sheet, scene or table of answers is that long")]
    TooLarge(u64),
    /// The bytes are no text.
    #[error("it is not UTF-8 from byte {0} on; save it as UTF-8")]
    NotText(usize),
    /// The system refused.
    #[error("{0}")]
    System(io::Error),
}

impl From<io::Error> for SourceProblem {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound => Self::Missing,
            io::ErrorKind::IsADirectory => Self::Directory,
            _ => Self::System(error),
        }
    }
}

impl FromStr for Source {
    type Err = std::convert::Infallible;

    fn from_str(argument: &str) -> Result<Self, Self::Err> {
        Ok(if argument == "-" {
            Self::Stdin
        } else {
            Self::File(PathBuf::from(argument))
        })
    }
}

/// Reads all bytes, at most so many MB.
fn limited(from: impl Read, most: u64) -> Result<Vec<u8>, SourceProblem> {
    read_at_most(from, most << 20).map_err(|error| match error.kind() {
        io::ErrorKind::FileTooLarge => SourceProblem::TooLarge(most),
        _ => error.into(),
    })
}

impl Source {
    /// How errors name the place: the path as given, or `stdin`.
    pub fn name(&self) -> String {
        match self {
            Self::Stdin => caller::with_input(|input| input.name.clone()).unwrap_or_else(|| "stdin".to_owned()),
            Self::File(path) | Self::InPlaceOf(path) => path.display().to_string(),
        }
    }

    /// The path of the file that it is, or stands for.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::Stdin => None,
            Self::File(path) | Self::InPlaceOf(path) => Some(path),
        }
    }

    /// True of standard input.
    pub fn is_stdin(&self) -> bool {
        matches!(self, Self::Stdin | Self::InPlaceOf(_))
    }

    /// The whole text, of at most so many MB.
    pub fn read(&self, most: u64) -> Result<String, SourceError> {
        self.text(most).map_err(|problem| self.named(problem))
    }

    fn named(&self, problem: SourceProblem) -> SourceError {
        SourceError {
            place: self.name(),
            problem: match problem {
                SourceProblem::Missing if find(&self.name()).is_some() => SourceProblem::Scene(self.name()),
                problem => problem,
            },
        }
    }

    /// The whole text of a document, of at most so many MB; what is not UTF-8 is taken for Latin-1, and said to be.
    pub fn read_document(&self, most: u64) -> Result<String, SourceError> {
        let bytes = self.bytes(most).map_err(|problem| self.named(problem))?;
        String::from_utf8(bytes).or_else(|error| {
            let bytes = error.into_bytes();
            // what has zero bytes is no text at all
            if bytes.contains(&0) {
                return Err(self.named(SourceProblem::NotText(0)));
            }
            note(&format!("{}: it is not UTF-8, and taken for Latin-1", self.name()));
            Ok(bytes.into_iter().map(char::from).collect())
        })
    }

    /// Returns a text that was read, of at most so many MB.
    pub fn of_length<'t>(&self, text: &'t str, most: u64) -> Result<&'t str, SourceError> {
        match text.len() as u64 > most << 20 {
            true => Err(SourceError {
                place: self.name(),
                problem: SourceProblem::TooLarge(most),
            }),
            false => Ok(text),
        }
    }

    fn text(&self, most: u64) -> Result<String, SourceProblem> {
        String::from_utf8(self.bytes(most)?).map_err(|error| SourceProblem::NotText(error.utf8_error().valid_up_to()))
    }

    fn bytes(&self, most: u64) -> Result<Vec<u8>, SourceProblem> {
        Ok(match self {
            Self::Stdin | Self::InPlaceOf(_) => {
                match caller::with_input(|input| limited(input.text.as_bytes(), most)) {
                    Some(given) => given?,
                    None => {
                        note_stdin();
                        limited(io::stdin().lock(), most)?
                    }
                }
            }
            Self::File(path) => {
                note_input(path);
                // a program that asks cannot write into a pipe that it names, and standard input may be its own
                let file = match caller::is_there() {
                    true => open_regular(path)?,
                    false => fs::File::open(path)?,
                };
                limited(file, most)?
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dash_is_stdin_and_all_else_a_file() {
        assert_eq!("-".parse(), Ok(Source::Stdin));
        assert_eq!("./-".parse(), Ok(Source::File(PathBuf::from("./-"))));
    }

    #[test]
    fn what_cannot_be_read_is_named_with_what_to_do() {
        let missing = Source::File(PathBuf::from("no/such/sheet.toml")).read(1).unwrap_err();
        assert!(matches!(missing.problem, SourceProblem::Missing), "{missing}");
        assert!(
            missing.to_string().starts_with("cannot read no/such/sheet.toml: "),
            "{missing}"
        );
        let directory = Source::File(std::env::temp_dir()).read(1).unwrap_err();
        assert!(matches!(directory.problem, SourceProblem::Directory), "{directory}");
    }
}
