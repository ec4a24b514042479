//! A table of verdicts as JUnit XML, which CI shows: one test a row, named by the first column, failed where the
//! verdict is not the expected one.

use super::{Cell, Table};
use std::io::{self, Write};

/// Writes one suite.
///
/// # Errors
/// What the writer says; a table without the columns `verdict` and `expected`.
pub fn write(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    let Some((verdict, expected)) = table.position("verdict").zip(table.position("expected")) else {
        let message = "a test report needs the columns `verdict` and `expected`";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    };
    let reason = table.position("reason");
    let place = table.position("place");
    let text = |row: &[Cell], index: usize| row.get(index).map_or(String::new(), |cell| escaped(&cell.plain()));
    let failed = |row: &[Cell]| row.get(verdict) != row.get(expected);
    let failures = table.rows().iter().filter(|row| failed(row)).count();
    writeln!(to, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>")?;
    writeln!(
        to,
        "<testsuite name=\"vibro-audit\" tests=\"{}\" failures=\"{failures}\" errors=\"0\" skipped=\"0\">",
        table.rows().len()
    )?;
    for row in table.rows() {
        let class = place.map_or(String::new(), |index| text(row, index));
        write!(to, "  <testcase name=\"{}\" classname=\"{class}\"", text(row, 0))?;
        if !failed(row) {
            writeln!(to, "/>")?;
            continue;
        }
        let message = reason.map_or(String::new(), |index| text(row, index));
        let (found, wanted) = (text(row, verdict), text(row, expected));
        writeln!(to, ">")?;
        writeln!(
            to,
            "    <failure type=\"{found}\" message=\"{message}\">expected {wanted}, is {found}</failure>"
        )?;
        writeln!(to, "  </testcase>")?;
    }
    writeln!(to, "</testsuite>")
}

/// The text within XML: markup escaped, and what XML 1.0 cannot hold replaced.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' | '\t' | '\r' => escaped.push(' '),
            c if super::acts_on_a_terminal(c) || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn print(table: &Table) -> io::Result<String> {
        let mut bytes = Vec::new();
        write(table, &mut bytes)?;
        String::from_utf8(bytes).map_err(io::Error::other)
    }

    #[test]
    fn a_row_with_another_verdict_than_expected_is_a_failure() {
        let mut table = Table::new(["id", "place", "verdict", "expected", "reason"]);
        table
            .push(["a", "Fig. 2", "wrong", "wrong", ""].map(Cell::from))
            .unwrap();
        table
            .push(["b", "\"3\" & <4>", "wrong", "reproduced", "x < 1\u{1b}\ny"].map(Cell::from))
            .unwrap();
        let expected = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
            <testsuite name=\"vibro-audit\" tests=\"2\" failures=\"1\" errors=\"0\" skipped=\"0\">\n\
            \x20 <testcase name=\"a\" classname=\"Fig. 2\"/>\n\
            \x20 <testcase name=\"b\" classname=\"&quot;3&quot; &amp; &lt;4&gt;\">\n\
            \x20   <failure type=\"wrong\" message=\"x &lt; 1\u{fffd} y\">expected reproduced, is wrong</failure>\n\
            \x20 </testcase>\n\
            </testsuite>\n";
        assert_eq!(print(&table).unwrap(), expected);
    }

    #[test]
    fn a_table_without_verdicts_is_no_test_report() {
        assert!(print(&Table::new(["a"])).is_err_and(|error| error.to_string().contains("`verdict`")));
    }
}
