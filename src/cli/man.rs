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
}

/// Runs the command.
pub fn run(arguments: &Arguments, mut line: clap::Command) -> Result<Answer, Failure> {
    line.build();
    super::options::create_directory(&arguments.directory)?;
    let mut table = Table::new(["file"]);
    let commands = line.get_subcommands().filter(|command| command.get_name() != "help");
    let pages = std::iter::once(&line).chain(commands).map(|page| {
        let name = page.get_display_name().unwrap_or("vibro-audit");
        (arguments.directory.join(format!("{name}.1")), page.clone())
    });
    let pages: Vec<(PathBuf, clap::Command)> = pages.collect();
    // all or none
    for (path, _) in &pages {
        Output::Member(path.clone()).check()?;
    }
    for (path, page) in pages {
        Output::Member(path.clone()).write(|to| Man::new(page).render(to))?;
        table.push([Cell::from(path.display().to_string())])?;
    }
    Ok(Answer {
        content: Content::Table(table),
        exit: Exit::AsExpected,
    })
}
