//! `vibro-audit scenes [NAME]`.

use super::scene::unknown;
use super::{Answer, Content, Exit, Failure};
use crate::report::{Cell, Table};
use crate::scene::{self, Want};

/// List the built-in scenes, or print one to start from
#[derive(Debug, clap::Args)]
#[command(after_help = "Example: vibro-audit scenes fig02 > mine.toml")]
pub struct Arguments {
    /// The scene to print, as TOML
    #[arg(value_name = "NAME")]
    name: Option<String>,
}

/// The columns that scripts rely on.
const COLUMNS: [&str; 3] = ["name", "title", "want"];

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let content = match &arguments.name {
        Some(name) => Content::Text(scene::find(name).ok_or_else(|| unknown(name))?.to_string()),
        None => Content::Table(table()?),
    };
    Ok(Answer {
        content,
        exit: Exit::AsExpected,
    })
}

fn table() -> Result<Table, Failure> {
    let mut table = Table::new(COLUMNS);
    for scene in scene::built_in()? {
        let wants: Vec<&str> = scene.want()?.into_iter().map(Want::name).collect();
        table.push([
            Cell::from(scene.name()),
            Cell::from(scene.title()?.map(str::to_string)),
            Cell::from(wants.join(";")),
        ])?;
    }
    Ok(table)
}
