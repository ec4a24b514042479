//! The reference pages of the guide, from the tables that read scenes, name columns and parse command lines.

use super::{Failure, described, described_commands};
use crate::scene::described_keys;
use std::fmt::Write;

/// The name of a page and its text.
pub(super) type Page = (&'static str, String);

/// The line above each page.
const WRITTEN: &str = "<!-- Written by `vibro-audit man --guide doc/reference`: change the program, not this page. -->";

/// Returns the pages.
///
/// # Errors
/// None but a fault of ours.
pub(super) fn pages(line: &clap::Command) -> Result<[Page; 3], Failure> {
    Ok([
        ("keys.md", keys()?),
        ("columns.md", columns()),
        ("options.md", options(line)),
    ])
}

/// Returns a page that begins with its title and what it is for.
fn page(title: &str, lead: &str) -> String {
    format!("{WRITTEN}\n\n# {title}\n\n{lead}\n")
}

/// Adds a table: the names of its columns, and its rows.
fn table<const N: usize>(page: &mut String, names: [&str; N], rows: impl IntoIterator<Item = [String; N]>) {
    let mut row = |cells: &[String]| {
        // writing to a string does not fail
        let _ = writeln!(page, "| {} |", cells.join(" | "));
    };
    row(&names.map(str::to_owned));
    row(&names.map(|_| "---".to_owned()));
    rows.into_iter().for_each(|cells| row(&cells));
}

/// Text in a cell: what Markdown would read as its own is escaped.
fn cell(text: &str) -> String {
    let mut cell = String::with_capacity(text.len());
    for (place, part) in text.split('`').enumerate() {
        let is_code = place % 2 == 1;
        if place > 0 {
            cell.push('`');
        }
        for c in part.chars() {
            match c {
                '|' => cell.push_str("\\|"),
                '\n' => cell.push(' '),
                '<' if !is_code => cell.push_str("&lt;"),
                '*' if !is_code => cell.push_str("\\*"),
                _ => cell.push(c),
            }
        }
    }
    cell
}

/// Code in a cell; nothing of nothing.
fn code(text: &str) -> String {
    match text {
        "" => String::new(),
        text => format!("`{}`", text.replace('|', "\\|")),
    }
}

fn keys() -> Result<String, Failure> {
    let mut page = page(
        "Keys of a scene",
        "A scene is a TOML file with these keys. What no `want` requires is neither read nor checked; \
         `vibro-audit run SCENE --explain` says what a scene reads. A key without a default is required where it is \
         read. A number may be typed as a text with pi, as `\"5 pi\"`. A, M and omega are `device.forcing_amplitude`, \
         `device.capsule_mass` and `device.angular_frequency`.",
    );
    let keys = described_keys()?;
    for section in keys.chunk_by(|one, other| one.section == other.section) {
        let title = match section[0].section {
            "" => "Above the sections".to_owned(),
            name => format!("`[{name}]`"),
        };
        let _ = write!(page, "\n## {title}\n\n");
        let rows = section.iter().map(|key| {
            [
                code(key.name),
                cell(key.meaning),
                cell(key.unit),
                cell(&key.range),
                cell(key.default.as_deref().unwrap_or_default()),
                code(key.example),
            ]
        });
        table(
            &mut page,
            ["key", "what it is", "unit", "range", "default", "example"],
            rows,
        );
    }
    Ok(page)
}

fn columns() -> String {
    let mut page = page(
        "Columns of the tables",
        "The columns that each command writes, in order; `vibro-audit --columns COMMAND` prints them, with `--schema` as a \
         JSON Schema. Unit 1 is a number without unit: lengths are in A pi²/(M omega²), velocities in A pi/(M omega), \
         times in pi/omega.",
    );
    for command in described_commands() {
        let _ = write!(page, "\n## `{command}`\n\n");
        let rows = described(command).map(|known| {
            let may_be_empty = if known.is_optional { "yes" } else { "" };
            [
                code(&known.column),
                known.form.name().to_owned(),
                cell(&known.unit),
                may_be_empty.to_owned(),
                cell(&known.meaning),
            ]
        });
        table(&mut page, ["column", "type", "unit", "may be empty", "meaning"], rows);
    }
    page
}

fn options(line: &clap::Command) -> String {
    let mut page = page(
        "Commands and options",
        "Every command with its arguments and options; `vibro-audit COMMAND --help` prints them.",
    );
    for command in line.get_subcommands().filter(|command| command.get_name() != "help") {
        let about = command.get_long_about().or(command.get_about());
        let usage = command.clone().render_usage().to_string();
        let usage = usage.trim_start_matches("Usage: ");
        let about = about.map(ToString::to_string).unwrap_or_default();
        let (first, more) = about.split_once('\n').unwrap_or((&about, ""));
        let _ = write!(
            page,
            "\n## `{}`\n\n{}.\n\n```text\n{usage}\n",
            command.get_name(),
            cell(first)
        );
        if !more.trim().is_empty() {
            let _ = write!(page, "\n{}\n", more.trim_matches('\n'));
        }
        let _ = write!(page, "```\n\n");
        let own = |argument: &&clap::Arg| !argument.is_hide_set() && argument.get_id() != "help";
        let rows = command.get_arguments().filter(own).map(option);
        table(&mut page, ["option", "what it does", "default"], rows);
        let example = command.get_after_help().map(ToString::to_string).unwrap_or_default();
        if let Some(example) = example.strip_prefix("Example: ") {
            let _ = write!(page, "\n```sh\n{example}\n```\n");
        }
    }
    page
}

/// The row of an option.
fn option(argument: &clap::Arg) -> [String; 3] {
    let value = argument.get_value_names().unwrap_or_default().join(" ");
    let takes = argument.get_action().takes_values();
    let name = match argument.get_long() {
        Some(long) if takes => format!("--{long} {value}"),
        Some(long) => format!("--{long}"),
        None => value,
    };
    let help = argument.get_long_help().or(argument.get_help());
    let mut help = cell(&help.map(ToString::to_string).unwrap_or_default());
    let choices: Vec<String> = argument
        .get_possible_values()
        .iter()
        .map(|choice| code(choice.get_name()))
        .collect();
    if takes && !choices.is_empty() && !argument.is_hide_possible_values_set() {
        let _ = write!(help, ": {}", choices.join(", "));
    }
    let defaults = argument
        .get_default_values()
        .iter()
        .map(|value| value.to_string_lossy());
    let defaults: Vec<_> = defaults.filter(|_| takes).collect();
    [code(&name), help, code(&defaults.join(","))]
}

#[cfg(test)]
mod tests {
    use super::super::Line;
    use super::*;

    #[test]
    fn the_pages_of_the_guide_are_those_that_the_program_writes() {
        let mut line = Line::grammar();
        line.build();
        for (name, text) in pages(&line).unwrap() {
            let path = format!("{}/doc/reference/{name}", env!("CARGO_MANIFEST_DIR"));
            let committed = std::fs::read_to_string(&path).unwrap_or_default();
            assert!(
                committed == text,
                "doc/reference/{name} is stale: cargo run -- man --guide doc/reference"
            );
        }
    }

    #[test]
    fn what_markdown_would_read_as_its_own_is_escaped() {
        assert_eq!(cell("|Tr| < 1 of BT*, `a|b*`"), "\\|Tr\\| &lt; 1 of BT\\*, `a\\|b*`");
    }
}
