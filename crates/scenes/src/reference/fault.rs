//! What is wrong with a golden file, and where.

use std::fmt;

/// A golden file that cannot be used: the message says what was found and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    file: String,
    line: Option<u64>,
    column: Option<String>,
    message: String,
}

impl Fault {
    /// A fault of the file as a whole.
    pub fn of_file(file: &str, message: impl Into<String>) -> Self {
        Self {
            file: file.to_owned(),
            line: None,
            column: None,
            message: message.into(),
        }
    }

    /// What is wrong, without the place.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// The file.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The line in it, counted from 1, where it is known.
    pub fn line(&self) -> Option<u64> {
        self.line
    }

    /// The same fault, at this line, counted from 1.
    #[must_use]
    pub fn at_line(mut self, line: u64) -> Self {
        self.line = Some(line);
        self
    }

    /// The same fault, of a row that stands on no line yet.
    #[must_use]
    pub fn without_line(mut self) -> Self {
        self.line = None;
        self
    }

    /// The same fault, in the column of this name.
    #[must_use]
    pub fn in_column(mut self, column: &str) -> Self {
        self.column = Some(column.to_owned());
        self
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        if let Some(line) = self.line {
            write!(f, ", line {line}")?;
        }
        if let Some(column) = &self.column {
            write!(f, ", column `{column}`")?;
        }
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for Fault {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_names_file_line_and_column() {
        let fault = Fault::of_file("printed.csv", "it is empty");
        assert_eq!(fault.to_string(), "printed.csv: it is empty");
        let fault = fault.at_line(3).in_column("expected");
        assert_eq!(fault.to_string(), "printed.csv, line 3, column `expected`: it is empty");
    }
}
