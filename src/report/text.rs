//! A table as aligned text, for a reader at a terminal.
//!
//! What fits [`WIDTH`] columns is one line per row. What does not: the widest columns of words or lists move
//! beneath their row, a line `name: value` each, until the rest fits; a table that is too wide even then is
//! written as records, one line per cell. Nothing is ever cut off.

use super::csv::texts;
use super::figures::rounded;
use super::printer::Printer;
use super::{Cell, Table};
use std::io::{self, Write};

/// The width a reviewer's terminal is taken to have.
const WIDTH: usize = 100;
const GAP: usize = 2;
const INDENT: usize = 4;

/// Lays out the rows that begin like those of `head`, with numbers rounded to `digits` significant figures, and writes
/// the header.
pub fn begin(head: &Table, digits: usize, to: &mut dyn Write) -> io::Result<Layout> {
    let layout = Layout::new(head, digits);
    if !layout.has_records() {
        layout.write_header(to)?;
    }
    Ok(layout)
}

impl Printer for Layout {
    fn rows(&mut self, rows: &[Vec<Cell>], to: &mut dyn Write) -> io::Result<()> {
        for row in rows {
            let cells: Vec<String> = row.iter().map(|cell| show(cell, self.digits)).collect();
            if self.has_records() {
                self.write_record(to, &cells)?;
            } else {
                self.write_row(to, &cells)?;
            }
            self.is_empty = false;
        }
        Ok(())
    }
}

/// Where each column stands.
pub struct Layout {
    digits: usize,
    /// Whether nothing has been written yet but the header.
    is_empty: bool,
    /// Whether there are rows to lay out at all.
    has_rows: bool,
    names: Vec<String>,
    widths: Vec<usize>,
    right: Vec<bool>,
    beneath: Vec<bool>,
}

impl Layout {
    fn new(table: &Table, digits: usize) -> Self {
        let names: Vec<String> = table.columns().iter().map(|column| one_line(&column.name)).collect();
        let rows: Vec<Vec<String>> = table
            .rows()
            .iter()
            .map(|row| row.iter().map(|cell| show(cell, digits)).collect())
            .collect();
        let width = |index: usize| {
            let cells = rows
                .iter()
                .filter_map(|row| row.get(index))
                .map(|cell| cell.chars().count());
            cells
                .chain(names.get(index).map(|name| name.chars().count()))
                .max()
                .unwrap_or(0)
        };
        let widths = (0..names.len()).map(width).collect();
        let right = (0..names.len()).map(|index| table.is_numeric(index)).collect();
        let beneath = vec![false; names.len()];
        let mut layout = Self {
            digits,
            is_empty: true,
            has_rows: !rows.is_empty(),
            names,
            widths,
            right,
            beneath,
        };
        layout.move_beneath();
        layout
    }

    /// Moves the widest column of words or lists beneath, again and again, while the line is too wide. The first
    /// column stays: it names the row. Columns of numbers stay: they are compared down the table.
    fn move_beneath(&mut self) {
        while self.line_width() > WIDTH {
            let movable = self.in_line().filter(|&(index, _)| index > 0 && !self.right[index]);
            let Some((widest, _)) = movable.max_by_key(|&(_, width)| width) else {
                return;
            };
            self.beneath[widest] = true;
        }
    }

    /// The columns that stand in the line of their row, with their widths.
    fn in_line(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let columns = self.widths.iter().copied().enumerate();
        columns.filter(|&(index, _)| !self.beneath[index])
    }

    fn line_width(&self) -> usize {
        self.in_line()
            .map(|(_, width)| width + GAP)
            .sum::<usize>()
            .saturating_sub(GAP)
    }

    /// Whether even what cannot move beneath is too wide for a line.
    fn has_records(&self) -> bool {
        self.has_rows && self.line_width() > WIDTH
    }

    fn write_header(&self, to: &mut dyn Write) -> io::Result<()> {
        self.write_line(to, &self.names)?;
        let rules: Vec<String> = self.widths.iter().map(|&width| "-".repeat(width)).collect();
        self.write_line(to, &rules)
    }

    fn write_row(&self, to: &mut dyn Write, row: &[String]) -> io::Result<()> {
        self.write_line(to, row)?;
        for (index, (name, cell)) in self.names.iter().zip(row).enumerate() {
            // each of several repairs, as `;;` joins them, on a line of its own
            for one in cell.split(" ;; ").filter(|one| self.beneath[index] && !one.is_empty()) {
                write_wrapped(to, &format!("{name}: {one}"), INDENT, INDENT + GAP)?;
            }
        }
        Ok(())
    }

    fn write_line(&self, to: &mut dyn Write, cells: &[String]) -> io::Result<()> {
        let mut line = String::new();
        for (position, (index, width)) in self.in_line().enumerate() {
            let cell = cells.get(index).map_or("", String::as_str);
            let blanks = " ".repeat(width - cell.chars().count().min(width));
            if position > 0 {
                line.push_str(&" ".repeat(GAP));
            }
            if self.right[index] {
                line.push_str(&blanks);
                line.push_str(cell);
            } else {
                line.push_str(cell);
                line.push_str(&blanks);
            }
        }
        writeln!(to, "{}", line.trim_end())
    }

    /// One line per cell, names aligned, an empty line between rows.
    fn write_record(&self, to: &mut dyn Write, row: &[String]) -> io::Result<()> {
        let width = self.names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
        if !self.is_empty {
            writeln!(to)?;
        }
        for (name, cell) in self.names.iter().zip(row).filter(|(_, cell)| !cell.is_empty()) {
            let blanks = " ".repeat(width - name.chars().count().min(width) + GAP);
            write_wrapped(to, &format!("{name}{blanks}{cell}"), 0, width + GAP)?;
        }
        Ok(())
    }
}

/// Writes `text` behind `first` blanks, broken at blanks where it passes [`WIDTH`]; the lines that follow stand
/// behind `hanging` blanks. A word that is too long for a line is left whole.
fn write_wrapped(to: &mut dyn Write, text: &str, first: usize, hanging: usize) -> io::Result<()> {
    let mut rest = text;
    let mut indent = first;
    while !rest.is_empty() {
        let room = WIDTH.saturating_sub(indent).max(1);
        let (line, after) = break_line(
            rest,
            room,
            if indent == first {
                hanging.saturating_sub(first)
            } else {
                0
            },
        );
        writeln!(to, "{}{}", " ".repeat(indent), line.trim_end())?;
        rest = after.trim_start();
        indent = hanging;
    }
    Ok(())
}

/// Splits at the last blank within `room` characters, or else at the first one after; never within the first
/// `keep` characters, where a name and its blanks stand.
fn break_line(text: &str, room: usize, keep: usize) -> (&str, &str) {
    if text.chars().count() <= room {
        return (text, "");
    }
    let mut place = None;
    for (count, (index, c)) in text.char_indices().enumerate() {
        if count > room && place.is_some() {
            break;
        }
        if c == ' ' && count > keep {
            place = Some(index);
        }
    }
    place.map_or((text, ""), |index| text.split_at(index))
}

fn show(cell: &Cell, digits: usize) -> String {
    match cell {
        Cell::Text(text) | Cell::Values(text, _) => one_line(text),
        Cell::Number(number) => rounded(*number, digits),
        Cell::Numbers(numbers) => {
            let numbers: Vec<String> = numbers.iter().map(|&number| rounded(number, digits)).collect();
            numbers.join("; ")
        }
        Cell::Decimal(decimal) => decimal.to_string(),
        Cell::Decimals(decimals) => texts(decimals).join("; "),
        Cell::Integer(integer) => integer.to_string(),
        Cell::Flag(flag) => flag.to_string(),
        Cell::Empty => String::new(),
    }
}

/// Text comes from other people's sheets: a line break would break the table, an escape code the terminal.
fn one_line(text: &str) -> String {
    let text: String = text
        .chars()
        .map(|c| if super::acts_on_a_terminal(c) { ' ' } else { c })
        .collect();
    text.trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::super::Format;
    use super::*;

    fn print(table: &Table) -> String {
        let mut bytes = Vec::new();
        table.write(&mut bytes, Format::Text, 12).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn columns_are_aligned_and_lines_have_no_trailing_blanks() {
        let mut table = Table::new(["label", "digits", "reason"]);
        table.push([Cell::from("9"), Cell::from(15.5), Cell::Empty]).unwrap();
        table
            .push([Cell::from("22"), Cell::from(1.0 / 3.0), Cell::from("sign")])
            .unwrap();
        let expected = "label          digits  reason\n\
                        -----  --------------  ------\n\
                        9                15.5\n\
                        22     0.333333333333  sign\n";
        assert_eq!(print(&table), expected);
    }

    #[test]
    fn what_does_not_fit_stands_beneath_its_row_whole() {
        let mut table = Table::new(["label", "verdict", "counterexample"]);
        let long = (0..30).map(|n| format!("T_{n}={n}/7;")).collect::<Vec<_>>().join(" ");
        table
            .push([Cell::from("9"), Cell::from("proved"), Cell::Empty])
            .unwrap();
        table
            .push([Cell::from("22"), Cell::from("refuted"), Cell::from(long.as_str())])
            .unwrap();
        let text = print(&table);
        assert!(
            text.starts_with("label  verdict\n-----  -------\n9      proved\n22     refuted\n    counterexample: T_0")
        );
        assert!(
            text.lines()
                .all(|line| line.chars().count() <= WIDTH && line.trim_end() == line),
            "{text}"
        );
        let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        assert!(words(&text).ends_with(&words(&long)));
    }

    #[test]
    fn a_table_of_too_many_numbers_is_written_as_records() {
        let names: Vec<String> = (0..12).map(|n| format!("column_{n}")).collect();
        let mut table = Table::new(names);
        for _ in 0..2 {
            table.push(vec![Cell::from(1.0 / 3.0); 12]).unwrap();
        }
        let text = print(&table);
        assert_eq!(text.lines().count(), 25);
        assert!(text.starts_with("column_0   0.333333333333\ncolumn_1 "), "{text}");
    }

    #[test]
    fn a_word_longer_than_the_line_is_left_whole() {
        let mut table = Table::new(["label", "reason"]);
        let word = "x".repeat(150);
        table.push([Cell::from("9"), Cell::from(word.as_str())]).unwrap();
        assert!(print(&table).contains(&word));
    }

    #[test]
    fn control_characters_do_not_reach_the_terminal() {
        let mut table = Table::new(["a"]);
        table.push([Cell::from("x\u{1b}[31m\ny")]).unwrap();
        assert_eq!(print(&table), "a\n--------\nx [31m y\n");
    }

    #[test]
    fn a_table_without_rows_prints_its_header() {
        assert_eq!(
            print(&Table::new(["word", "periods"])),
            "word  periods\n----  -------\n"
        );
        assert_eq!(print(&Table::default()), "\n\n");
    }
}
