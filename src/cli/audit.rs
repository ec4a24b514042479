//! `vibro-audit audit [SHEET] [--explain LABEL]`.

use super::{Answer, Failure, Options, Source};

/// Decide for each formula of a sheet whether it follows from its premises
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The sheet, a TOML file or `-` for stdin; without it, the paper's own appendix
    #[arg(value_name = "SHEET")]
    sheet: Option<Source>,
    /// Print the proof or the counterexample of this equation alone
    #[arg(long, value_name = "LABEL")]
    explain: Option<String>,
}

/// Runs the command.
pub fn run(arguments: &Arguments, _options: &Options) -> Result<Answer, Failure> {
    let _text = arguments.sheet.as_ref().map(Source::read).transpose()?;
    let _label = arguments.explain.as_deref();
    Err(Failure::NotBuilt("audit"))
}
