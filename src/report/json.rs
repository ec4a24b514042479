//! A table as JSON: an array with one object per row, keys in column order, one row per line; or the lines alone.

use super::csv::texts;
use super::figures::whole;
use super::printer::Printer;
use super::{Cell, Column, Table, acts_on_a_terminal};
use serde::ser::{Serialize, SerializeMap, SerializeSeq, Serializer};
use std::io::{self, Write};

/// The key of the verdicts on formulas in an object of several tables.
pub const FORMULAS: &str = "formulas";

/// The key of the numbers that a document prints.
pub const NUMBERS: &str = "numbers";

/// Writes tables as one object, each under its key.
pub fn write_tables(tables: &[(&str, &Table)], to: &mut dyn Write) -> io::Result<()> {
    to.write_all(b"{")?;
    for (place, (key, table)) in tables.iter().enumerate() {
        to.write_all(if place == 0 { b"\n" } else { b",\n" })?;
        serde_json::to_writer(&mut *to, key)?;
        to.write_all(b": ")?;
        let mut array = begin(table, to)?;
        array.rows(table.rows(), to)?;
        array.close(to)?;
    }
    to.write_all(b"\n}\n")
}

/// One object per row of an array.
pub struct Objects {
    columns: Vec<Column>,
    is_empty: bool,
}

/// One object per line.
pub struct Lines {
    columns: Vec<Column>,
}

/// Opens the array.
pub fn begin(head: &Table, to: &mut dyn Write) -> io::Result<Objects> {
    to.write_all(b"[")?;
    Ok(Objects {
        columns: head.columns().to_vec(),
        is_empty: true,
    })
}

/// Lines of objects.
pub fn lines(head: &Table) -> Lines {
    Lines {
        columns: head.columns().to_vec(),
    }
}

impl Objects {
    fn close(&self, to: &mut dyn Write) -> io::Result<()> {
        to.write_all(if self.is_empty { b"]" } else { b"\n]" })
    }
}

impl Printer for Objects {
    fn rows(&mut self, rows: &[Vec<Cell>], to: &mut dyn Write) -> io::Result<()> {
        let columns = &self.columns;
        for cells in rows {
            to.write_all(if self.is_empty { b"\n" } else { b",\n" })?;
            self.is_empty = false;
            write(&Row { columns, cells }, to)?;
        }
        Ok(())
    }

    fn end(&mut self, to: &mut dyn Write) -> io::Result<()> {
        self.close(to)?;
        to.write_all(b"\n")
    }
}

impl Printer for Lines {
    fn rows(&mut self, rows: &[Vec<Cell>], to: &mut dyn Write) -> io::Result<()> {
        let columns = &self.columns;
        for cells in rows {
            write(&Row { columns, cells }, to)?;
            to.write_all(b"\n")?;
        }
        to.flush()
    }
}

/// Writes a row; a character that acts on a terminal is escaped, which any reader of JSON undoes.
fn write(row: &Row<'_>, to: &mut dyn Write) -> io::Result<()> {
    let mut serializer = serde_json::Serializer::with_formatter(to, Escaping);
    Ok(row.serialize(&mut serializer)?)
}

/// JSON without blanks, and without characters that act on a terminal.
struct Escaping;

impl serde_json::ser::Formatter for Escaping {
    fn write_string_fragment<W: ?Sized + Write>(&mut self, to: &mut W, fragment: &str) -> io::Result<()> {
        for part in fragment.split_inclusive(acts_on_a_terminal) {
            let last = part.chars().next_back().filter(|c| acts_on_a_terminal(*c));
            let plain = part.strip_suffix(|c| Some(c) == last).unwrap_or(part);
            to.write_all(plain.as_bytes())?;
            // none of them lies beyond the plane of four digits
            last.map_or(Ok(()), |c| write!(to, "\\u{:04x}", u32::from(c)))?;
        }
        Ok(())
    }
}

impl Serialize for Table {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let columns = self.columns();
        serializer.collect_seq(self.rows().iter().map(|cells| Row { columns, cells }))
    }
}

/// A row with its keys, written as a stream so that the order of the columns is kept.
struct Row<'a> {
    columns: &'a [Column],
    cells: &'a [Cell],
}

impl Serialize for Row<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.cells.len()))?;
        for (column, cell) in self.columns.iter().zip(self.cells) {
            map.serialize_entry(&column.name, cell)?;
            if let Cell::Values(_, values) = cell {
                map.serialize_entry(&format!("{}_values", column.name), &Object(values))?;
            }
        }
        map.end()
    }
}

/// Values by their names, in their order.
struct Object<'a>(&'a [(String, String)]);

impl Serialize for Object<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

impl Serialize for Cell {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Text(text) | Self::Values(text, _) => serializer.serialize_str(text),
            Self::Number(number) => Finite(*number).serialize(serializer),
            Self::Numbers(numbers) => {
                let mut list = serializer.serialize_seq(Some(numbers.len()))?;
                for number in numbers {
                    list.serialize_element(&Finite(*number))?;
                }
                list.end()
            }
            Self::Decimal(decimal) => serializer.serialize_str(decimal.as_str()),
            Self::Decimals(decimals) => serializer.collect_seq(texts(decimals)),
            Self::Integer(integer) => serializer.serialize_i64(*integer),
            Self::Flag(flag) => serializer.serialize_bool(*flag),
            Self::Empty => serializer.serialize_none(),
        }
    }
}

/// JSON has no infinities and no NaN: they become strings, where serde_json would lose them as `null`.
struct Finite(f64);

impl Serialize for Finite {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() {
            serializer.serialize_f64(self.0)
        } else {
            serializer.serialize_str(&whole(self.0))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Format;
    use super::*;

    #[test]
    fn keys_keep_the_column_order_and_what_is_not_finite_is_a_string() {
        let mut table = Table::new(["z", "a", "list", "none", "flag"]);
        let list = Cell::from(vec![0.5, f64::INFINITY]);
        table
            .push([
                Cell::from(1_i64),
                Cell::from(f64::NAN),
                list,
                Cell::Empty,
                Cell::from(true),
            ])
            .unwrap();
        let mut bytes = Vec::new();
        table.write(&mut bytes, Format::Json, 12).unwrap();
        let expected = "[\n{\"z\":1,\"a\":\"NaN\",\"list\":[0.5,\"inf\"],\"none\":null,\"flag\":true}\n]\n";
        assert_eq!(String::from_utf8(bytes).unwrap(), expected);
    }

    #[test]
    fn values_are_an_object_under_a_key_of_their_own() {
        let mut table = Table::new(["point", "b"]);
        let values = vec![
            ("x".to_owned(), "1/2".to_owned()),
            (r"F(\pi)".to_owned(), "2".to_owned()),
        ];
        table
            .push([Cell::Values("x=1/2".to_owned(), values), Cell::Empty])
            .unwrap();
        let mut bytes = Vec::new();
        table.write(&mut bytes, Format::Json, 12).unwrap();
        let expected = "[\n{\"point\":\"x=1/2\",\"point_values\":{\"x\":\"1/2\",\"F(\\\\pi)\":\"2\"},\"b\":null}\n]\n";
        assert_eq!(String::from_utf8(bytes).unwrap(), expected);
    }

    #[test]
    fn characters_that_act_on_a_terminal_are_escaped_and_read_back() {
        let text = "a\u{1b}[31m \u{9b}\u{7f}b\u{202e}\u{2066}\n\"\u{e9}";
        let mut table = Table::new([text]);
        table.push([Cell::from(text)]).unwrap();
        let mut bytes = Vec::new();
        table.write(&mut bytes, Format::Jsonl, 12).unwrap();
        let json = String::from_utf8(bytes).unwrap();
        assert!(!json.trim_end().contains(acts_on_a_terminal), "{json}");
        let read: serde_json::Value = serde_json::from_str(&json).unwrap();
        assert_eq!(read[text], text);
    }

    #[test]
    fn no_rows_are_an_empty_array() {
        let mut bytes = Vec::new();
        Table::new(["a"]).write(&mut bytes, Format::Json, 12).unwrap();
        assert_eq!(bytes, b"[]\n");
    }
}
