//! What a command hands back, and how it is printed.

use super::resume::Unfinished;
use super::rows::Rows;
use super::{Exit, Failure, Options};
use crate::report::{Format, Output, Page, Table, Verdicts, acts_on_a_terminal, json_tables, junit};
use std::fmt;
use std::io::{self, IsTerminal};

/// What a command found, and what the exit status says of it.
#[derive(Debug)]
pub struct Answer {
    /// What to print.
    pub content: Content,
    /// Whether it is as expected.
    pub exit: Exit,
}

/// What to print.
#[derive(Debug)]
pub enum Content {
    /// Rows, in the format the user chose.
    Table(Table),
    /// Tables of different columns, each with its key in JSON.
    Tables(Vec<(&'static str, Table)>),
    /// Rows that are made while they are printed.
    Rows(Rows),
    /// Rows of which some may stand in a file already, and those that do not.
    Unfinished(Unfinished, Rows),
    /// What a search has found whose record stands in a file meanwhile.
    Recorded(Unfinished, Rows),
    /// A page for a reader.
    Page(Page),
    /// Bytes that have one form only, made while they are printed; how many rows they are.
    Copied(Copied),
    /// Text that has one form only, such as a proof; `--format` has no say in it.
    Text(String),
}

/// Writes several tables as one document of the format; nothing where there are none.
fn write_all(
    tables: &[(&'static str, Table)],
    to: &mut dyn io::Write,
    format: Format,
    figures: usize,
) -> io::Result<()> {
    let all: Vec<&Table> = tables.iter().map(|(_, table)| table).collect();
    match format {
        _ if tables.is_empty() => Ok(()),
        Format::Junit => junit(&all, to),
        Format::Json => json_tables(&tables.iter().map(|(key, table)| (*key, table)).collect::<Vec<_>>(), to),
        Format::Csv => Table::joined(&all).write(to, format, figures),
        // a line is an object whatever its keys
        Format::Jsonl => all.iter().try_for_each(|table| table.write(to, format, figures)),
        _ => {
            for (place, table) in all.iter().enumerate() {
                if place > 0 {
                    writeln!(to)?;
                }
                table.write(to, format, figures)?;
            }
            Ok(())
        }
    }
}

/// Writes rows, and counts them.
type Copying = dyn FnOnce(&mut dyn io::Write) -> io::Result<usize>;

/// What writes rows that are printed already.
pub struct Copied(pub Box<Copying>);

impl fmt::Debug for Copied {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Copied")
    }
}

impl Answer {
    /// Prints the answer to `output`, text with a line break at its end, and says how the command exits.
    pub fn write(self, output: &Output, options: &Options) -> Result<Exit, Failure> {
        let is_read = *output == Output::Stdout && options.format == Format::Text && io::stdout().is_terminal();
        let summary = if is_read { self.summary() } else { None };
        let (_, is_met) = self.content.write(output, options.format, options.figures())?;
        if let Some(summary) = summary {
            output.write(|to| writeln!(to, "\n{summary}"))?;
        }
        Ok(if is_met { self.exit } else { Exit::NotAsExpected })
    }

    /// Returns how many rows have each verdict, and whether all is as expected; nothing of tables without verdicts.
    fn summary(&self) -> Option<String> {
        let tables: Vec<&Table> = match &self.content {
            Content::Table(table) => vec![table],
            Content::Tables(tables) => tables.iter().map(|(_, table)| table).collect(),
            _ => return None,
        };
        let verdicts = Verdicts::of(tables.into_iter());
        let against = match verdicts.are_expected() && self.exit != Exit::AsExpected {
            true => ", but evidence speaks against a verdict or something could not be read",
            false => "",
        };
        Some(format!("{}{against}", verdicts.in_words()?))
    }
}

impl Content {
    /// Prints it, and tells the number of rows and whether they are as is required.
    pub(super) fn write(self, output: &Output, format: Format, figures: usize) -> Result<(usize, bool), Failure> {
        match self {
            Self::Table(table) => {
                // what is no page is read where it is asked for
                let format = if format == Format::Html { Format::Text } else { format };
                output.write(|to| table.write(to, format, figures))?;
                Ok((table.rows().len(), true))
            }
            Self::Rows(rows) => rows.write(output, format, figures),
            Self::Unfinished(unfinished, rows) => unfinished.write(rows, output),
            Self::Recorded(unfinished, rows) => unfinished.end(rows, output, figures),
            Self::Copied(Copied(copy)) => {
                let mut rows = 0;
                output.write(|to| {
                    rows = copy(to)?;
                    Ok(())
                })?;
                Ok((rows, true))
            }
            Self::Page(page) => {
                output.write(|to| page.write(to, figures))?;
                Ok((page.rows(), true))
            }
            Self::Tables(tables) => {
                output.write(|to| write_all(&tables, to, format, figures))?;
                Ok((tables.iter().map(|(_, table)| table.rows().len()).sum(), true))
            }
            Self::Text(text) => {
                let acts = |c: char| acts_on_a_terminal(c) && !"\n\t".contains(c);
                let text = text.replace(acts, "\u{fffd}");
                output.write(|to| writeln!(to, "{}", text.trim_end_matches('\n')))?;
                Ok((0, true))
            }
        }
    }
}
