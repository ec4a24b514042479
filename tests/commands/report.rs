//! A table that is written reads back equal, numbers bit for bit, whatever is in it.

use proptest::prelude::*;
use vibro_audit::report::{Cell, Format, Table, acts_on_a_terminal};

/// One kind per column, as commands have it: a reader knows the kind from the column.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Text,
    Number,
    Numbers,
    Integer,
    Flag,
}

fn kinds() -> impl Strategy<Value = Vec<Kind>> {
    let kind = prop_oneof![
        Just(Kind::Text),
        Just(Kind::Number),
        Just(Kind::Numbers),
        Just(Kind::Integer),
        Just(Kind::Flag)
    ];
    prop::collection::vec(kind, 1..6)
}

/// Any bits at all, with the corners more often than chance would have them.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<u64>().prop_map(f64::from_bits),
        -2.0..2.0,
        prop::sample::select(vec![
            0.0,
            -0.0,
            1.0,
            1e16,
            1e-5,
            5e-324,
            f64::MAX,
            f64::INFINITY,
            f64::NEG_INFINITY
        ]),
    ]
}

/// Text that tries to break out of its cell.
fn text() -> impl Strategy<Value = String> {
    prop_oneof![
        ".{0,12}",
        "[,;\"'|\n\r\\\\ =]{0,6}",
        "[=@+\\-\u{ff1d}\u{ff20}\u{ff0b}\u{ff0d}\u{202e}\u{2066}\u{7}1(]{0,4}",
        Just("\\frac{1}{1 - r_B r_T}".to_owned())
    ]
}

fn cell(kind: Kind) -> BoxedStrategy<Cell> {
    match kind {
        Kind::Text => text().prop_map(Cell::Text).boxed(),
        Kind::Number => prop_oneof![4 => number().prop_map(Cell::Number), 1 => Just(Cell::Empty)].boxed(),
        // An empty list and an empty cell look the same in CSV; a motion has one impact at least.
        Kind::Numbers => prop::collection::vec(number(), 1..4).prop_map(Cell::Numbers).boxed(),
        Kind::Integer => any::<i64>().prop_map(Cell::Integer).boxed(),
        Kind::Flag => any::<bool>().prop_map(Cell::Flag).boxed(),
    }
}

fn table() -> impl Strategy<Value = (Vec<Kind>, Table)> {
    kinds().prop_flat_map(|kinds| {
        let row: Vec<BoxedStrategy<Cell>> = kinds.iter().map(|&kind| cell(kind)).collect();
        (Just(kinds), prop::collection::vec(row, 0..6)).prop_map(|(kinds, rows)| {
            let mut table = Table::new((0..kinds.len()).map(|index| format!("column {index}")));
            for row in rows {
                table.push(row).unwrap();
            }
            (kinds, table)
        })
    })
}

fn write(table: &Table, format: Format, digits: usize) -> String {
    let mut bytes = Vec::new();
    table.write(&mut bytes, format, digits).unwrap();
    String::from_utf8(bytes).unwrap()
}

/// Equality of bits; one NaN is as good as another, since no format has a place for its payload.
fn same(left: f64, right: f64) -> bool {
    left.to_bits() == right.to_bits() || (left.is_nan() && right.is_nan())
}

fn same_cell(left: &Cell, right: &Cell) -> bool {
    match (left, right) {
        (Cell::Number(left), Cell::Number(right)) => same(*left, *right),
        (Cell::Numbers(left), Cell::Numbers(right)) => {
            left.len() == right.len() && left.iter().zip(right).all(|(left, right)| same(*left, *right))
        }
        _ => left == right,
    }
}

fn assert_same(written: &Table, read: &[Vec<Cell>], text: &str) {
    assert_eq!(written.rows().len(), read.len(), "{text}");
    for (written, read) in written.rows().iter().zip(read) {
        let same = written.len() == read.len() && written.iter().zip(read).all(|(left, right)| same_cell(left, right));
        assert!(same, "{written:?}\nreads back as\n{read:?}\nfrom\n{text}");
    }
}

fn from_field(kind: Kind, field: &str) -> Cell {
    match kind {
        Kind::Text => Cell::from(field),
        Kind::Number if field.is_empty() => Cell::Empty,
        Kind::Number => Cell::Number(field.parse().unwrap()),
        Kind::Numbers => Cell::Numbers(field.split(';').map(|number| number.parse().unwrap()).collect()),
        Kind::Integer => Cell::Integer(field.parse().unwrap()),
        Kind::Flag => Cell::Flag(field.parse().unwrap()),
    }
}

fn from_json(kind: Kind, value: &serde_json::Value) -> Cell {
    let number = |value: &serde_json::Value| {
        value
            .as_str()
            .map_or_else(|| value.as_f64().unwrap(), |text| text.parse().unwrap())
    };
    match kind {
        Kind::Text => Cell::from(value.as_str().unwrap()),
        Kind::Number if value.is_null() => Cell::Empty,
        Kind::Number => Cell::Number(number(value)),
        Kind::Numbers => Cell::Numbers(value.as_array().unwrap().iter().map(number).collect()),
        Kind::Integer => Cell::Integer(value.as_i64().unwrap()),
        Kind::Flag => Cell::Flag(value.as_bool().unwrap()),
    }
}

/// The cells as CSV shows them: characters that act on a terminal, but line breaks, are told apart from nothing else, and what a
/// spreadsheet would execute has an apostrophe before it.
fn as_csv_shows(table: &Table, read: &[Vec<Cell>]) -> Table {
    let mut shown = Table::new(table.columns().to_vec());
    for (row, read) in table.rows().iter().zip(read) {
        let cell = |(cell, read): (&Cell, &Cell)| match (cell, read) {
            (Cell::Text(text), Cell::Text(read)) => {
                let is_executed = text.starts_with(['=', '\u{ff1d}', '@', '\u{ff20}', '\t', '\r', '\n']);
                let may_be = text.starts_with(['+', '-', '\u{ff0b}', '\u{ff0d}']) && read.starts_with('\'');
                let printed = text.chars().map(|c| {
                    if acts_on_a_terminal(c) && c != '\n' {
                        '\u{fffd}'
                    } else {
                        c
                    }
                });
                let apostrophe = (is_executed || may_be).then_some('\'');
                Cell::Text(apostrophe.into_iter().chain(printed).collect())
            }
            _ => cell.clone(),
        };
        shown.push(row.iter().zip(read).map(cell).collect::<Vec<_>>()).unwrap();
    }
    shown
}

proptest! {
    #[test]
    fn csv_reads_back_bit_for_bit((kinds, table) in table(), digits in 0_usize..40) {
        let text = write(&table, Format::Csv, digits);
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let names: Vec<String> = table.columns().iter().map(|column| column.name.clone()).collect();
        prop_assert_eq!(reader.headers().unwrap().iter().collect::<Vec<_>>(), names);
        let read: Vec<Vec<Cell>> = reader
            .records()
            .map(|record| kinds.iter().zip(&record.unwrap()).map(|(&kind, field)| from_field(kind, field)).collect())
            .collect();
        assert_same(&as_csv_shows(&table, &read), &read, &text);
    }

    #[test]
    fn json_reads_back_bit_for_bit((kinds, table) in table(), digits in 0_usize..40) {
        let text = write(&table, Format::Json, digits);
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        let read: Vec<Vec<Cell>> = value
            .as_array()
            .unwrap()
            .iter()
            .map(|row| {
                let cell = |(&kind, column): (&Kind, _)| {
                    let column: &vibro_audit::report::Column = column;
                    from_json(kind, &row[&column.name])
                };
                kinds.iter().zip(table.columns()).map(cell).collect()
            })
            .collect();
        assert_same(&table, &read, &text);
    }

    #[test]
    fn text_has_no_trailing_blanks_and_markdown_one_line_per_row((_, table) in table(), digits in 0_usize..40) {
        let text = write(&table, Format::Text, digits);
        prop_assert!(text.split('\n').all(|line| line.trim_end() == line), "{text:?}");
        let markdown = write(&table, Format::Markdown, digits);
        prop_assert_eq!(markdown.split('\n').count(), table.rows().len() + 3, "{}", markdown);
    }
}
