//! A table in a format, whole or row by row as it comes, in memory that does not grow with the number of rows.

use super::printer::Printer;
use super::{Cell, Column, Format, Table, csv, json, junit, markdown, text};
use std::io::{self, Write};

/// The rows that are written at once. The first of these decide the layout: in text the widths of the columns, in text
/// and Markdown which of them hold numbers.
const HEAD: usize = 1000;

/// Prints what stands before the rows; `head` decides the layout. A format that needs all rows at once has none.
fn begin(head: &Table, format: Format, digits: usize, to: &mut dyn Write) -> io::Result<Box<dyn Printer>> {
    Ok(match format {
        Format::Text | Format::Sympy | Format::Rocq => Box::new(text::begin(head, digits, to)?),
        Format::Csv => Box::new(csv::begin(head, to)?),
        Format::Json => Box::new(json::begin(head, to)?),
        Format::Jsonl => Box::new(json::lines(head)),
        Format::Markdown => Box::new(markdown::begin(head, to)?),
        Format::Junit | Format::Html | Format::Sarif => {
            let message = "it is written as a whole";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
    })
}

impl Table {
    /// Writes the table. `digits` is the number of significant figures in text, at least 1; the other formats
    /// print every number whole. JUnit needs a table of verdicts ([`Table::has_verdicts`]); a page and findings are no
    /// tables.
    pub fn write(&self, to: &mut dyn Write, format: Format, digits: usize) -> io::Result<()> {
        if format == Format::Junit {
            return junit::write(&[self], to);
        }
        let mut printer = begin(self, format, digits, to)?;
        printer.rows(self.rows(), to)?;
        printer.end(to)
    }
}

/// A table that is written while it is made.
///
/// What comes out is what [`Table::write`] prints of the same rows, but that the first thousand of them decide the
/// layout: a later cell that is wider than its column in text pushes the rest of its row aside.
pub struct Stream<'a> {
    /// The rows that are not written yet.
    held: Table,
    format: Format,
    digits: usize,
    to: &'a mut dyn Write,
    printer: Option<Box<dyn Printer>>,
}

impl<'a> Stream<'a> {
    /// A stream of rows of these columns; `digits` as in [`Table::write`].
    pub fn new(columns: Vec<Column>, format: Format, digits: usize, to: &'a mut dyn Write) -> Self {
        Self {
            held: Table::new(columns),
            format,
            digits,
            to,
            printer: None,
        }
    }

    /// A stream of more rows of a CSV whose line of columns stands already.
    pub fn continued(columns: Vec<Column>, to: &'a mut dyn Write) -> Self {
        let printer: Box<dyn Printer> = Box::new(csv::Records);
        Self {
            printer: Some(printer),
            ..Self::new(columns, Format::Csv, 0, to)
        }
    }

    /// Adds a row, which must have as many cells as there are columns.
    ///
    /// # Errors
    /// Another number of cells, a format that is not one of rows, and what the writer says.
    pub fn push(&mut self, row: Vec<Cell>) -> io::Result<()> {
        self.held.push(row).map_err(io::Error::other)?;
        if self.held.rows().len() == HEAD || self.format == Format::Jsonl {
            self.print()?;
        }
        Ok(())
    }

    /// Writes the rows that are held.
    ///
    /// # Errors
    /// What the writer says.
    pub fn flush(&mut self) -> io::Result<()> {
        self.print()?;
        self.to.flush()
    }

    /// Writes what is left, and what follows the last row.
    ///
    /// # Errors
    /// What the writer says, and a format that is not one of rows.
    pub fn end(mut self) -> io::Result<()> {
        self.print()?;
        self.printer.map_or(Ok(()), |mut printer| printer.end(self.to))
    }

    fn print(&mut self) -> io::Result<()> {
        if self.printer.is_none() {
            self.printer = Some(begin(&self.held, self.format, self.digits, self.to)?);
        }
        if let Some(printer) = &mut self.printer {
            printer.rows(self.held.rows(), self.to)?;
        }
        self.held.clear();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STREAMED: [Format; 5] = [Format::Text, Format::Csv, Format::Json, Format::Jsonl, Format::Markdown];

    fn row(number: usize) -> Vec<Cell> {
        let side = if number.is_multiple_of(2) { "bottom" } else { "top" };
        let odd = (!number.is_multiple_of(7)).then(|| (number as f64).sqrt());
        vec![Cell::from(number as f64 / 3.0), Cell::from(side), Cell::from(odd)]
    }

    fn both(format: Format, rows: usize) -> [String; 2] {
        let columns = ["number", "side", "root"];
        let mut table = Table::new(columns);
        let (mut whole, mut streamed) = (Vec::new(), Vec::new());
        let mut stream = Stream::new(columns.map(Column::from).to_vec(), format, 12, &mut streamed);
        for number in 0..rows {
            table.push(row(number)).unwrap();
            stream.push(row(number)).unwrap();
        }
        stream.end().unwrap();
        table.write(&mut whole, format, 12).unwrap();
        [whole, streamed].map(|bytes| String::from_utf8(bytes).unwrap())
    }

    #[test]
    fn a_stream_prints_what_the_table_of_its_rows_does() {
        for format in STREAMED {
            for rows in [0, 1, HEAD - 1, HEAD, HEAD + 1, 3 * HEAD] {
                let [whole, streamed] = both(format, rows);
                assert_eq!(whole, streamed, "{format} of {rows}");
            }
        }
    }

    #[test]
    fn a_late_cell_that_is_too_wide_pushes_its_own_row_aside_and_is_whole() {
        let mut bytes = Vec::new();
        let mut stream = Stream::new(vec![Column::from("a"), Column::from("b")], Format::Text, 12, &mut bytes);
        for number in 0..HEAD + 2 {
            let text = if number == HEAD { "wide, wider" } else { "x" };
            stream.push(vec![Cell::from(text), Cell::from(1_i64)]).unwrap();
        }
        stream.end().unwrap();
        let text = String::from_utf8(bytes).unwrap();
        let tail: Vec<&str> = text.lines().rev().take(2).collect();
        assert_eq!(tail, ["x  1", "wide, wider  1"]);
    }

    #[test]
    fn a_row_that_does_not_fit_and_a_format_without_rows_are_refused() {
        let mut bytes = Vec::new();
        let mut stream = Stream::new(vec![Column::from("a")], Format::Csv, 12, &mut bytes);
        assert!(stream.push(row(1)).unwrap_err().to_string().contains("3 cells"));
        let stream = Stream::new(vec![Column::from("a")], Format::Junit, 12, &mut bytes);
        assert!(stream.end().is_err());
        assert!(bytes.is_empty());
    }
}
