//! A table as JSON: an array with one object per row, keys in column order, one row per line.

use super::csv::texts;
use super::figures::whole;
use super::{Cell, Column, Table};
use serde::ser::{Serialize, SerializeMap, SerializeSeq, Serializer};
use std::io::{self, Write};

/// Writes the array.
pub fn write(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    to.write_all(b"[")?;
    for (index, cells) in table.rows().iter().enumerate() {
        to.write_all(if index == 0 { b"\n" } else { b",\n" })?;
        serde_json::to_writer(
            &mut *to,
            &Row {
                columns: table.columns(),
                cells,
            },
        )?;
    }
    to.write_all(if table.rows().is_empty() { b"]\n" } else { b"\n]\n" })
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
        }
        map.end()
    }
}

impl Serialize for Cell {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Text(text) => serializer.serialize_str(text),
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
        write(&table, &mut bytes).unwrap();
        let expected = "[\n{\"z\":1,\"a\":\"NaN\",\"list\":[0.5,\"inf\"],\"none\":null,\"flag\":true}\n]\n";
        assert_eq!(String::from_utf8(bytes).unwrap(), expected);
    }

    #[test]
    fn no_rows_are_an_empty_array() {
        let mut bytes = Vec::new();
        write(&Table::new(["a"]), &mut bytes).unwrap();
        assert_eq!(bytes, b"[]\n");
    }
}
