//! `vibro-audit mcp`: a server of the Model Context Protocol on standard input and output.

mod guide;
mod server;
mod tools;

use super::{Answer, Content, Exit, Failure};
use std::io;

/// Serve audits to an assistant over the Model Context Protocol, on standard input and output
#[derive(Debug, clap::Args)]
#[command(
    after_help = "A client starts it with the arguments [\"mcp\"] and talks to it in lines of JSON. It opens no \
                        network connection and writes no file. Paths are relative to the directory it is started in."
)]
pub struct Arguments {}

/// Runs the command until its input ends.
pub fn run(_: &Arguments) -> Result<Answer, Failure> {
    server::serve(&mut io::stdin().lock(), io::stdout());
    Ok(Answer {
        content: Content::Tables(Vec::new()),
        exit: Exit::AsExpected,
    })
}
