//! `vibro-audit completions SHELL`.

use super::{Answer, Content, Exit, Failure};
use clap_complete::Shell;

/// Print a shell completion script
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example: vibro-audit completions bash > ~/.local/share/bash-completion/completions/vibro-audit"
)]
pub struct Arguments {
    /// The shell; its manual says where the script goes
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

/// Runs the command.
pub fn run(arguments: &Arguments, mut line: clap::Command) -> Result<Answer, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut line, "vibro-audit", &mut script);
    Ok(Answer {
        content: Content::Text(String::from_utf8_lossy(&script).into_owned()),
        exit: Exit::AsExpected,
    })
}
