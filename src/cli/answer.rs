//! What a command hands back, and how it is printed.

use super::{Exit, Failure, Options};
use crate::report::{Output, Table};

/// What a command found, and what the exit status says of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// What to print.
    pub content: Content,
    /// Whether it is as expected.
    pub exit: Exit,
}

/// What to print.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Rows, in the format the user chose.
    Table(Table),
    /// Text that has one form only, such as a proof; `--format` has no say in it.
    Text(String),
}

impl Answer {
    /// Prints the answer to `output`; text ends with a line break.
    pub fn write(&self, output: &Output, options: &Options) -> Result<(), Failure> {
        output.write(|to| match &self.content {
            Content::Table(table) => table.write(to, options.format, options.figures()),
            Content::Text(text) => writeln!(to, "{}", text.trim_end_matches('\n')),
        })?;
        Ok(())
    }
}
