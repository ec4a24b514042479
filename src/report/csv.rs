//! A table as CSV.

use super::figures::{whole, whole_list};
use super::printer::Printer;
use super::{Cell, Table};
use crate::number::Decimal;
use std::borrow::Cow;
use std::io::{self, Write};

impl Cell {
    /// The value as CSV has it, without quoting: a number so that it reads back, a count without a point.
    pub fn plain(&self) -> Cow<'_, str> {
        match self {
            Self::Text(text) | Self::Values(text, _) => Cow::Borrowed(text),
            Self::Number(number) => Cow::Owned(whole(*number)),
            Self::Numbers(numbers) => Cow::Owned(whole_list(numbers)),
            Self::Decimal(decimal) => Cow::Borrowed(decimal.as_str()),
            Self::Decimals(decimals) => Cow::Owned(texts(decimals).join(";")),
            Self::Integer(integer) => Cow::Owned(integer.to_string()),
            Self::Flag(flag) => Cow::Borrowed(if *flag { "true" } else { "false" }),
            Self::Empty => Cow::Borrowed(""),
        }
    }
}

/// One record per row.
pub struct Records;

/// Writes the header.
pub fn begin(head: &Table, to: &mut dyn Write) -> io::Result<Records> {
    let mut writer = csv::Writer::from_writer(to);
    writer
        .write_record(head.columns().iter().map(|column| &column.name))
        .map_err(to_io)?;
    writer.flush()?;
    Ok(Records)
}

impl Printer for Records {
    fn rows(&mut self, rows: &[Vec<Cell>], to: &mut dyn Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(to);
        for row in rows {
            writer
                .write_record(row.iter().map(|cell| harmless(cell).into_owned().into_bytes()))
                .map_err(to_io)?;
        }
        writer.flush()
    }
}

/// The cell as text that does nothing to a terminal and that a spreadsheet takes for text.
///
/// A spreadsheet executes what begins with `=`, `@`, a tab or a line break, and after a sign what calls a function or
/// another program or is a sum of numbers and cells; a number alone and TeX after a sign are none.
fn harmless(cell: &Cell) -> Cow<'_, str> {
    let (Cell::Text(text) | Cell::Values(text, _)) = cell else {
        return cell.plain();
    };
    let is_executed = match text.chars().next() {
        Some('=' | '\u{ff1d}' | '@' | '\u{ff20}' | '\t' | '\r' | '\n') => true,
        Some('+' | '-' | '\u{ff0b}' | '\u{ff0d}') => text.contains(['|', '!']) || calls(text) || is_sum(text),
        _ => false,
    };
    let acts = |c: char| super::acts_on_a_terminal(c) && c != '\n';
    let has_control = text.chars().any(acts);
    if !is_executed && !has_control {
        return Cow::Borrowed(text);
    }
    let shown = text.chars().map(|c| if acts(c) { '\u{fffd}' } else { c });
    Cow::Owned(is_executed.then_some('\'').into_iter().chain(shown).collect())
}

/// Whether a text behind a sign has nothing of TeX, and is no number.
fn is_sum(text: &str) -> bool {
    text.parse::<f64>().is_err() && !text.contains(['\\', '_', '{', '='])
}

/// Whether a name of three letters or more, which is no command of TeX, is followed by a bracket.
fn calls(text: &str) -> bool {
    text.match_indices('(').any(|(at, _)| {
        let before = text.get(..at).unwrap_or_default();
        let name = before.trim_end_matches(|c: char| c.is_ascii_alphanumeric() || c == '.' || c == '_');
        before.len() - name.len() >= 3 && !name.ends_with('\\')
    })
}

/// The texts of decimals.
pub fn texts(decimals: &[Decimal]) -> Vec<&str> {
    decimals.iter().map(Decimal::as_str).collect()
}

/// The csv crate's own conversion hides the kind, by which a broken pipe is told from a full disk.
fn to_io(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Format;
    use super::*;

    #[test]
    fn fields_with_commas_quotes_and_line_breaks_are_quoted() {
        let mut table = Table::new(["text", "numbers", "none"]);
        table
            .push([Cell::from("a,\"b\"\nc"), Cell::from(vec![0.1, -2.0]), Cell::Empty])
            .unwrap();
        let mut bytes = Vec::new();
        table.write(&mut bytes, Format::Csv, 12).unwrap();
        assert_eq!(
            String::from_utf8(bytes).unwrap(),
            "text,numbers,none\n\"a,\"\"b\"\"\nc\",0.1;-2.0,\n"
        );
    }

    #[test]
    fn text_that_a_spreadsheet_would_execute_begins_with_an_apostrophe_and_numbers_and_tex_do_not() {
        let cells = [
            ("=1+2", "'=1+2"),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("+cmd|' /C calc'!A0", "'+cmd|' /C calc'!A0"),
            ("-HYPERLINK(A1)", "'-HYPERLINK(A1)"),
            ("-x_k + f(t)", "-x_k + f(t)"),
            (r"-\sqrt{x} \sin(t)", r"-\sqrt{x} \sin(t)"),
            ("x = -1", "x = -1"),
            ("-1.5e-3", "-1.5e-3"),
            ("-2+3+A1", "'-2+3+A1"),
            ("+A1*B2", "'+A1*B2"),
            ("\u{ff1d}1+1", "'\u{ff1d}1+1"),
            ("a\u{202e}b", "a\u{fffd}b"),
            ("\u{1b}[31m", "\u{fffd}[31m"),
        ];
        for (text, shown) in cells {
            assert_eq!(harmless(&Cell::from(text)), shown);
        }
        assert_eq!(harmless(&Cell::from(-1.5)), "-1.5");
    }
}
