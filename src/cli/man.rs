//! `vibro-audit man DIR`.

use super::{Answer, Content, Exit, Failure};
use crate::report::{Cell, Output, Table};
use clap_mangen::Man;
use std::path::PathBuf;

/// Write a manual page for each command
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit man ~/.local/share/man/man1")]
pub struct Arguments {
    /// The directory that they go to, such as ~/.local/share/man/man1
    #[arg(value_name = "DIR")]
    directory: PathBuf,
    /// Write the reference pages of the guide instead: keys of scenes, columns, options
    #[arg(long)]
    guide: bool,
}

/// Runs the command.
pub fn run(arguments: &Arguments, mut line: clap::Command) -> Result<Answer, Failure> {
    line.build();
    super::options::create_directory(&arguments.directory)?;
    let commands = line.get_subcommands().filter(|command| command.get_name() != "help");
    let mut pages: Vec<(String, Vec<u8>)> = Vec::new();
    if arguments.guide {
        let guide = super::guide::pages(&line)?.into_iter();
        pages.extend(guide.map(|(name, text)| (name.to_owned(), text.into_bytes())));
    } else {
        for page in std::iter::once(&line).chain(commands) {
            let name = page.get_display_name().unwrap_or("vibro-audit");
            let mut text = Vec::new();
            // writing to memory does not fail
            let _ = Man::new(page.clone()).render(&mut text);
            pages.push((format!("{name}.1"), text));
        }
    }
    let outputs = pages.iter().map(|(name, _)| arguments.directory.join(name));
    let outputs: Vec<Output> = outputs.map(Output::Member).collect();
    // all or none
    outputs.iter().try_for_each(Output::check)?;
    let mut table = Table::new(["file"]);
    for (output, (name, text)) in outputs.iter().zip(&pages) {
        output.write(|to| to.write_all(text))?;
        table.push([Cell::from(arguments.directory.join(name).display().to_string())])?;
    }
    Ok(Answer {
        content: Content::Table(table),
        exit: Exit::AsExpected,
    })
}
