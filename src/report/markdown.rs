//! A table as Markdown.

use super::printer::Printer;
use super::{Cell, Table};
use std::io::{self, Write};

/// One line per row.
pub struct Lines;

/// Writes a header, and a rule that aligns columns of numbers to the right.
pub fn begin(head: &Table, to: &mut dyn Write) -> io::Result<Lines> {
    write_line(to, head.columns().iter().map(|column| escape(&column.name)))?;
    let rule = (0..head.columns().len()).map(|index| {
        let rule = if head.is_numeric(index) { "---:" } else { "---" };
        rule.to_owned()
    });
    write_line(to, rule)?;
    Ok(Lines)
}

impl Printer for Lines {
    fn rows(&mut self, rows: &[Vec<Cell>], to: &mut dyn Write) -> io::Result<()> {
        for row in rows {
            write_line(to, row.iter().map(|cell| escape(&cell.plain())))?;
        }
        Ok(())
    }
}

fn write_line(to: &mut dyn Write, cells: impl Iterator<Item = String>) -> io::Result<()> {
    to.write_all(b"|")?;
    for cell in cells {
        write!(to, " {cell} |")?;
    }
    to.write_all(b"\n")
}

/// What would end the cell or change how the rest of it reads.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '|' | '\\' | '*' | '`' | '<' => escaped.extend(['\\', c]),
            c if super::acts_on_a_terminal(c) => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::super::Format;
    use super::*;

    #[test]
    fn a_bar_or_a_line_break_does_not_end_the_cell() {
        let mut table = Table::new(["label", "x"]);
        table.push([Cell::from("|r_B| < 1\nalways"), Cell::from(0.25)]).unwrap();
        let mut bytes = Vec::new();
        table.write(&mut bytes, Format::Markdown, 12).unwrap();
        let expected = "| label | x |\n| --- | ---: |\n| \\|r_B\\| \\< 1 always | 0.25 |\n";
        assert_eq!(String::from_utf8(bytes).unwrap(), expected);
    }
}
