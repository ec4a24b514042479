//! The options that every command knows.

use super::Failure;
use crate::number::{Decimals, FIGURES_OF_F64};
use crate::orbit::most_figures;
use crate::report::{DEFAULT_DIGITS, Format, Output};
use crate::scene::{MOST_DIGITS, Scene, SceneError};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::path::PathBuf;

/// The options that every command knows.
#[derive(Clone, Debug, clap::Args)]
pub struct Options {
    /// How to print tables
    #[arg(long, global = true, value_name = "FORMAT", default_value = Format::Text.name(), value_parser = format_parser())]
    pub format: Format,
    /// Write to this file instead of stdout; it is there whole or not at all. For `run` and `plot all`, a directory
    #[arg(long, global = true, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// How many significant digits to reach and, in text, to print [default: 12]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_DIGITS)))]
    pub digits: Option<u32>,
}

impl Options {
    /// Where to write.
    pub fn output(&self) -> Output {
        self.out.clone().map_or(Output::Stdout, Output::File)
    }

    /// The significant digits to reach: `--digits`, or those of the scene.
    ///
    /// # Errors
    /// Digits of the scene that are none.
    pub fn digits_for(&self, scene: &Scene) -> Result<u32, SceneError> {
        self.digits.map_or_else(|| scene.digits(), Ok)
    }

    /// The decimals in which motions are wanted: where more digits are asked for than f64 has to the last one.
    ///
    /// # Errors
    /// Digits of the scene that are none, or more than motions are computed with.
    pub fn decimals_for(&self, scene: &Scene) -> Result<Option<Decimals>, Failure> {
        let figures = self.digits_for(scene)? as usize;
        let most = most_figures();
        if figures > most {
            return Err(Failure::Digits { figures, most });
        }
        Ok((figures > FIGURES_OF_F64 as usize).then_some(Decimals(figures)))
    }

    /// The significant figures of a number in text.
    pub fn figures(&self) -> usize {
        self.digits
            .and_then(|digits| usize::try_from(digits).ok())
            .unwrap_or(DEFAULT_DIGITS)
    }
}

/// Lists the formats in help and in errors, which a plain `FromStr` parser could not.
fn format_parser() -> impl TypedValueParser<Value = Format> {
    PossibleValuesParser::new(Format::ALL.map(Format::name)).try_map(|name| name.parse::<Format>())
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
