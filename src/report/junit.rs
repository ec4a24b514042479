//! A table of verdicts as JUnit XML, which CI shows: one test a row, named by the first column, failed where the
//! verdict is not the expected one.

use super::{Cell, Table};
use crate::markup::escaped_line;
use std::io::{self, Write};

/// Writes a suite, or one for each table.
///
/// # Errors
/// What the writer says; a table without the columns `verdict` and `expected`.
pub fn write(tables: &[&Table], to: &mut dyn Write) -> io::Result<()> {
    writeln!(to, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>")?;
    match tables {
        [table] => suite(table, to),
        tables => {
            writeln!(to, "<testsuites>")?;
            tables.iter().try_for_each(|table| suite(table, to))?;
            writeln!(to, "</testsuites>")
        }
    }
}

fn suite(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    let Some((verdict, expected)) = table.position("verdict").zip(table.position("expected")) else {
        let message = "a test report needs the columns `verdict` and `expected`";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    };
    let reason = table.position("reason");
    let [file, place] = ["file", "place"].map(|name| table.position(name));
    let [counterexample, repair] = ["counterexample", "repair"].map(|name| table.position(name));
    let text = |row: &[Cell], index: usize| row.get(index).map_or(String::new(), |cell| escaped_line(&cell.plain()));
    let failed = |row: &[Cell]| !Table::is_expected(&text(row, verdict), &text(row, expected));
    let failures = table.rows().iter().filter(|row| failed(row)).count();
    writeln!(
        to,
        "<testsuite name=\"vibro-audit\" tests=\"{}\" failures=\"{failures}\" errors=\"0\" skipped=\"0\">",
        table.rows().len()
    )?;
    for row in table.rows() {
        let parts = [file, place].into_iter().flatten().map(|index| text(row, index));
        let class = parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join(":");
        write!(to, "  <testcase name=\"{}\" classname=\"{class}\"", text(row, 0))?;
        if let Some(file) = file.map(|index| text(row, index)).filter(|file| !file.is_empty()) {
            write!(to, " file=\"{file}\"")?;
        }
        if !failed(row) {
            writeln!(to, "/>")?;
            continue;
        }
        let mut message = reason.map_or(String::new(), |index| text(row, index));
        let point = counterexample
            .map(|index| text(row, index))
            .filter(|point| !point.is_empty());
        message.extend(point.map(|point| format!("; counterexample: {point}")));
        let mended = repair.map(|index| text(row, index)).filter(|mended| !mended.is_empty());
        message.extend(mended.map(|mended| format!("; repair: {mended}")));
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

#[cfg(test)]
mod tests {
    use super::*;

    fn print(table: &Table) -> io::Result<String> {
        let mut bytes = Vec::new();
        write(&[table], &mut bytes)?;
        String::from_utf8(bytes).map_err(io::Error::other)
    }

    #[test]
    fn a_row_with_another_verdict_than_expected_is_a_failure() {
        let mut table = Table::new(["id", "place", "verdict", "expected", "reason", "repair"]);
        table
            .push(["a", "Fig. 2", "wrong", "wrong", "", ""].map(Cell::from))
            .unwrap();
        table
            .push(["b", "\"3\" & <4>", "wrong", "reproduced", "x < 1\u{1b}\ny", "$a<b$"].map(Cell::from))
            .unwrap();
        let expected = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
            <testsuite name=\"vibro-audit\" tests=\"2\" failures=\"1\" errors=\"0\" skipped=\"0\">\n\
            \x20 <testcase name=\"a\" classname=\"Fig. 2\"/>\n\
            \x20 <testcase name=\"b\" classname=\"&quot;3&quot; &amp; &lt;4&gt;\">\n\
            \x20   <failure type=\"wrong\" message=\"x &lt; 1\u{fffd} y; repair: $a&lt;b$\">expected reproduced, is wrong</failure>\n\
            \x20 </testcase>\n\
            </testsuite>\n";
        assert_eq!(print(&table).unwrap(), expected);
    }

    #[test]
    fn several_tables_are_one_document() {
        let mut table = Table::new(["id", "verdict", "expected"]);
        table.push(["a", "wrong", "wrong"].map(Cell::from)).unwrap();
        let mut bytes = Vec::new();
        write(&[&table, &table], &mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        let document = roxmltree::Document::parse(&text).unwrap();
        let suites = document
            .root_element()
            .children()
            .filter(|node| node.has_tag_name("testsuite"));
        assert_eq!(suites.count(), 2);
    }

    #[test]
    fn a_table_without_verdicts_is_no_test_report() {
        assert!(print(&Table::new(["a"])).is_err_and(|error| error.to_string().contains("`verdict`")));
    }
}
