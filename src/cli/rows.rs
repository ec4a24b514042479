//! Rows that are made while they are printed.

use super::shard::Label;
use super::{Failure, note};
use crate::report::{Cell, Column, Format, Output, Stream, Summed, Table};
use crate::stop::Token;
use std::fmt;
use std::io::{self, Write};

/// Rows of which only a few are held at a time.
pub struct Rows {
    /// The columns.
    pub columns: Vec<Column>,
    /// The rows in order; the first failure ends them.
    rows: Box<dyn Iterator<Item = Result<Vec<Cell>, Failure>>>,
    /// The column whose cells are all to be true, lest [`Exit::NotAsExpected`](super::Exit::NotAsExpected).
    required: Option<usize>,
    /// What they are a part of, where they are not all.
    part: Option<Label>,
    /// A table of other columns, which all rows together make.
    following: Option<Box<MakeTable>>,
    /// How rows begin that are left out of text, and what they are called.
    left_out: Option<(&'static str, &'static str)>,
}

/// Makes a table after the last row.
type MakeTable = dyn FnOnce() -> Result<Table, Failure>;

impl fmt::Debug for Rows {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Rows")
            .field("columns", &self.columns)
            .finish_non_exhaustive()
    }
}

impl From<Table> for Rows {
    fn from(table: Table) -> Self {
        let (columns, rows) = table.into_parts();
        Self::new(columns, rows.into_iter().map(Ok))
    }
}

impl Rows {
    /// Rows that are made as they are asked for.
    pub fn new(columns: Vec<Column>, rows: impl Iterator<Item = Result<Vec<Cell>, Failure>> + 'static) -> Self {
        Self {
            columns,
            rows: Box::new(rows),
            required: None,
            part: None,
            following: None,
            left_out: None,
        }
    }

    /// The same rows, of which text leaves out those that begin with `first`; a note says how many `called` so there are.
    pub fn leaving_out(self, first: &'static str, called: &'static str) -> Self {
        let left_out = Some((first, called));
        Self { left_out, ..self }
    }

    /// The same rows, and behind them, after an empty line, a table that is made when the last of them is; not in JSON.
    pub fn then(self, table: impl FnOnce() -> Result<Table, Failure> + 'static) -> Self {
        let following: Option<Box<MakeTable>> = Some(Box::new(table));
        Self { following, ..self }
    }

    /// The same rows as a part of a run, which says what it is.
    pub fn part(self, label: Option<Label>) -> Self {
        Self { part: label, ..self }
    }

    /// The same rows, of which all cells of a column are to be true.
    pub fn requiring(self, column: &str) -> Self {
        let required = self.columns.iter().position(|own| own.name == column);
        Self { required, ..self }
    }

    /// All rows at once, without what follows them.
    pub(super) fn table(self) -> Result<Table, Failure> {
        let mut table = Table::new(self.columns);
        for row in self.rows {
            table.push(row?)?;
        }
        Ok(table)
    }

    /// The table that follows the rows, which are made and left out; none where there is none.
    pub(super) fn following(self) -> Result<Option<Table>, Failure> {
        let token = Token::current();
        self.each(|_| Ok(!token.is_stopped())).map(|(_, table)| table)
    }

    /// Passes every row on while `each` says so; whether all are as is required, and the table that follows all of them.
    pub(super) fn each(
        self,
        mut each: impl FnMut(Vec<Cell>) -> Result<bool, Failure>,
    ) -> Result<(bool, Option<Table>), Failure> {
        let mut is_met = true;
        for row in self.rows {
            let row = row?;
            is_met &= is_as_required(self.required, &row);
            if !each(row)? {
                return Ok((is_met, None));
            }
        }
        let following = self.following.map(|table| table()).transpose()?;
        Ok((is_met, following))
    }

    /// Prints them, and tells the number of rows and whether they are as is required.
    pub(super) fn write(self, output: &Output, format: Format, figures: usize) -> Result<(usize, bool), Failure> {
        let Self {
            columns,
            rows,
            required,
            part,
            following,
            left_out,
        } = self;
        let left_out = left_out.filter(|_| format == Format::Text);
        let mut hidden = 0;
        if part.is_some() && format != Format::Csv {
            return Err(Failure::Usage("a part of a run is CSV: add --format csv".to_owned()));
        }
        let (mut count, mut is_met, mut failure) = (0, true, None);
        let token = Token::current();
        let written = output.write(|to| {
            if let Some(label) = &part {
                writeln!(to, "{}", label.head())?;
            }
            let mut to = Summed::new(to);
            let mut stream = Stream::new(columns, format, figures, &mut to);
            // a row that was stopped on its way is none
            for row in rows.take_while(|_| !token.is_stopped()) {
                match row {
                    Ok(row) => {
                        is_met &= is_as_required(required, &row);
                        let first = row.first().map(Cell::plain);
                        if left_out.is_some_and(|(left_out, _)| first.as_deref() == Some(left_out)) {
                            hidden += 1;
                            continue;
                        }
                        stream.push(row)?;
                    }
                    Err(failed) => {
                        failure = Some(failed);
                        // so that nothing of the file remains
                        return Err(io::Error::other("stopped"));
                    }
                }
                count += 1;
            }
            stream.end()?;
            // a program that reads JSON asks for one table
            let is_text = !matches!(format, Format::Json | Format::Jsonl);
            if let Some(table) = following.filter(|_| is_text && !token.is_stopped()) {
                match table() {
                    Ok(table) => {
                        writeln!(to)?;
                        table.write(&mut to, format, figures)?;
                    }
                    Err(failed) => {
                        failure = Some(failed);
                        return Err(io::Error::other("stopped"));
                    }
                }
            }
            match &part {
                // one that was stopped does not say that it is whole
                Some(label) if !token.is_stopped() => writeln!(to.to, "{}", label.tail(count, to.sum)),
                _ => Ok(()),
            }
        });
        match failure {
            Some(failure) => Err(failure),
            None => {
                written?;
                if let Some((_, called)) = left_out.filter(|_| hidden > 0) {
                    note(&format!("{hidden} {called} are left out; --format csv lists them too"));
                }
                Ok((count, is_met))
            }
        }
    }
}

fn is_as_required(required: Option<usize>, row: &[Cell]) -> bool {
    required.is_none_or(|column| row.get(column) == Some(&Cell::Flag(true)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn rows(count: usize) -> Rows {
        let row = move |number: usize| {
            if number < count {
                Ok(vec![Cell::from(number as f64)])
            } else {
                Err(Failure::NoDirectory)
            }
        };
        Rows::new(vec![Column::from("number")], (0..5000).map(row))
    }

    #[test]
    fn a_failure_midway_is_told_and_leaves_no_file() {
        let path = std::env::temp_dir().join(format!("vibro-audit-answer-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        let output = Output::File(path.join("rows.csv"));
        let failure = rows(4000).write(&output, Format::Csv, 12).unwrap_err();
        assert!(matches!(failure, Failure::NoDirectory), "{failure}");
        assert_eq!(fs::read_dir(&path).unwrap().count(), 0);
        assert_eq!(rows(5000).write(&output, Format::Csv, 12).unwrap(), (5000, true));
        assert_eq!(fs::read_to_string(path.join("rows.csv")).unwrap().lines().count(), 5001);
        fs::remove_dir_all(&path).unwrap();
    }

    #[test]
    fn all_rows_at_once_are_a_table() {
        assert_eq!(rows(5000).table().unwrap().rows().len(), 5000);
        assert!(rows(3).table().is_err());
    }
}
