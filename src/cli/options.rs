//! The options that every command knows.

use super::Failure;
use crate::number::{Decimals, Doubles, FIGURES_OF_F64, Rung};
use crate::orbit::{OutputPrecision, most_figures};
use crate::report::{DEFAULT_DIGITS, Format, Output, OutputError, OutputProblem, is_same_file};
use crate::scene::{MOST_DIGITS, Scene};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::fs;
use std::path::{Path, PathBuf};

/// How motions are wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asked {
    /// In f64.
    Doubles(OutputPrecision<Doubles>),
    /// In decimals.
    Decimals(OutputPrecision<Decimals>),
}

/// The options that every command knows.
#[derive(Clone, Debug, clap::Args)]
pub struct Options {
    /// Format of the output; without it the one that the name of --out ends with, as in verdicts.html
    #[arg(long, global = true, value_name = "FORMAT", default_value = Format::Text.name(), value_parser = format_parser(&Format::ALL))]
    pub format: Format,
    /// Write to FILE instead of stdout, when the run has ended
    #[arg(long, global = true, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Significant digits to compute and to print [default: double precision, of which tables as text show 12; 6 for simulated motion]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_DIGITS)))]
    pub digits: Option<u32>,
}

impl Options {
    /// Where to write.
    pub fn output(&self) -> Output {
        self.out.clone().map_or(Output::Stdout, Output::File)
    }

    /// The format that the name of `--out` ends with.
    pub fn format_of_file(&self) -> Option<Format> {
        let ending = self.out.as_ref()?.extension()?.to_str()?;
        Some(match ending {
            "csv" => Format::Csv,
            "json" => Format::Json,
            "html" => Format::Html,
            "sarif" => Format::Sarif,
            "md" => Format::Markdown,
            _ => return None,
        })
    }

    /// Where a file beside the table goes, if one is wanted; looked at before a long computation.
    ///
    /// # Errors
    /// A file that cannot be written, or that the table is to go to.
    pub fn beside(&self, file: Option<&PathBuf>) -> Result<Option<Output>, Failure> {
        file.map(|file| self.apart(file, Output::File(file.clone())))
            .transpose()
    }

    /// Returns the output for a file of a directory, under a name that the program chose.
    ///
    /// # Errors
    /// As [`Options::beside`], and a symbolic link.
    pub fn member(&self, file: PathBuf) -> Result<Output, Failure> {
        self.apart(&file, Output::Member(file.clone()))
    }

    fn apart(&self, file: &Path, output: Output) -> Result<Output, Failure> {
        if self.out.as_ref().is_some_and(|out| is_same_file(out, file)) {
            return Err(Failure::SameFile(file.display().to_string()));
        }
        output.check()?;
        Ok(output)
    }

    /// The digits asked for: `--digits`, or those of the scene; `None` where neither asks.
    ///
    /// # Errors
    /// Digits of the scene that are none, or more than motions are computed with.
    pub fn asked_of(&self, scene: &Scene) -> Result<Option<u32>, Failure> {
        let asked = match self.digits {
            Some(digits) => Some(digits),
            None => scene.asked_digits()?,
        };
        let most = most_figures();
        match asked.map(|digits| digits as usize) {
            Some(figures) if figures > most => Err(Failure::Digits { figures, most }),
            _ => Ok(asked),
        }
    }

    /// How motions are wanted: in f64, where that shows the digits asked, else in decimals; and the number to begin with.
    ///
    /// # Errors
    /// As [`Options::asked_of`].
    pub fn goal_for(&self, scene: &Scene) -> Result<Asked, Failure> {
        let options = scene.options()?;
        Ok(match self.asked_of(scene)? {
            None => Asked::Doubles(OutputPrecision::DOUBLES.searched(&options)),
            Some(digits) => {
                let first = Rung::reaching(digits);
                if digits <= FIGURES_OF_F64 {
                    Asked::Doubles(OutputPrecision::doubles(digits, first).searched(&options))
                } else {
                    // of as many figures the last one may be off by more than so many digits allow
                    Asked::Decimals(OutputPrecision::decimals(Decimals(digits as usize + 1), first).searched(&options))
                }
            }
        })
    }

    /// The significant figures of a number in text.
    pub fn figures(&self) -> usize {
        self.digits
            .and_then(|digits| usize::try_from(digits).ok())
            .unwrap_or(DEFAULT_DIGITS)
    }
}

/// Lists the formats in help and in errors, which a plain `FromStr` parser could not.
fn format_parser(formats: &[Format]) -> impl TypedValueParser<Value = Format> + use<> {
    let names: Vec<&str> = formats.iter().map(|format| format.name()).collect();
    PossibleValuesParser::new(names).try_map(|name| name.parse::<Format>())
}

/// The formats that a command has.
pub(super) fn formats(command: &str) -> Vec<Format> {
    let has = |format: &Format| match format {
        Format::Junit => matches!(command, "audit" | "check"),
        Format::Sarif | Format::Sympy | Format::Rocq => command == "audit",
        Format::Html => matches!(command, "audit" | "check" | "trade" | "score" | "run"),
        _ => true,
    };
    Format::ALL.into_iter().filter(has).collect()
}

/// Returns an option of every command as the help of one command shows it.
pub(super) fn of_command(option: clap::Arg, command: &str) -> clap::Arg {
    match option.get_id().as_str() {
        "format" => option
            .value_parser(format_parser(&formats(command)))
            .hide(matches!(command, "completions" | "lsp" | "mcp" | "plot")),
        "digits" => option.hide(matches!(
            command,
            "completions" | "lsp" | "man" | "mcp" | "merge" | "scenes"
        )),
        "out" if command == "run" => option
            .value_name("DIR")
            .help("Write the files of all commands into the directory DIR"),
        "out" if matches!(command, "lsp" | "mcp") => option.hide(true),
        "out" if command == "plot" => {
            option.help("Write the drawing to FILE instead of stdout; of `plot all` a directory")
        }
        _ => option,
    }
}

/// Makes a directory, and those that it lies in.
pub(super) fn create_directory(directory: &Path) -> Result<(), OutputError> {
    fs::create_dir_all(directory).map_err(|source| OutputError {
        place: directory.display().to_string(),
        problem: OutputProblem::System {
            doing: "creating the directory",
            source,
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct Line {
        #[command(flatten)]
        options: Options,
    }

    #[test]
    fn without_options_text_goes_to_stdout_with_twelve_figures() {
        let options = Line::try_parse_from(["vibro-audit"]).unwrap().options;
        assert_eq!(
            (options.format, options.output(), options.figures()),
            (Format::Text, Output::Stdout, 12)
        );
    }

    #[test]
    fn every_format_is_understood_and_zero_digits_are_not() {
        for format in Format::ALL {
            let line = Line::try_parse_from(["vibro-audit", "--format", format.name()]).unwrap();
            assert_eq!(line.options.format, format);
        }
        for digits in ["0", "-1", "1.5", "NaN", "10001"] {
            assert!(
                Line::try_parse_from(["vibro-audit", "--digits", digits]).is_err(),
                "{digits}"
            );
        }
    }
}
