//! `vibro-audit lsp`: a server of the Language Server Protocol on standard input and output.

mod analysis;
mod lines;
mod memory;
mod server;

use super::{Answer, Content, Exit, Failure};
use std::io;

/// Serve audits to an editor over the Language Server Protocol, on standard input and output
#[derive(Debug, clap::Args)]
#[command(
    after_help = "An editor starts it with the argument `lsp` for files of TeX, Markdown and TOML. It opens no network \
                  connection and writes no file."
)]
pub struct Arguments {
    /// Accepted and ignored: standard input and output are all that there is
    #[arg(long)]
    stdio: bool,
}

/// Runs the command until its client says `exit`, or its input ends.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let Arguments { stdio: _ } = arguments;
    let is_orderly = server::serve(&mut io::stdin().lock(), io::stdout());
    Ok(Answer {
        content: Content::Tables(Vec::new()),
        exit: Exit::from_verdict(is_orderly),
    })
}
