//! Golden CSV, read strictly: the header as it must be, every record as long as the header.

use super::Fault;
use std::collections::HashMap;

/// One record with the place where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Record {
    file: String,
    /// The line on which it begins, counted from 1.
    pub line: u64,
    /// Where in the text it begins and ends, line break included.
    pub bytes: std::ops::Range<usize>,
    columns: &'static [&'static str],
    fields: Vec<String>,
}

impl Record {
    /// The field of this column without blanks around it; empty where there is no such column.
    pub fn field(&self, column: &str) -> &str {
        let index = self.columns.iter().position(|&name| name == column);
        index
            .and_then(|index| self.fields.get(index))
            .map_or("", String::as_str)
    }

    /// The field of this column, which must not be empty.
    ///
    /// # Errors
    /// Where it is empty, by line and column.
    pub fn required(&self, column: &str) -> Result<&str, Fault> {
        match self.field(column) {
            "" => Err(self.fault(column, "it is empty, and every row needs one")),
            text => Ok(text),
        }
    }

    /// A fault in this column of this record.
    pub fn fault(&self, column: &str, message: impl Into<String>) -> Fault {
        Fault::of_file(&self.file, message).at_line(self.line).in_column(column)
    }

    /// A fault of this record as a whole.
    pub fn fault_of_row(&self, message: impl Into<String>) -> Fault {
        Fault::of_file(&self.file, message).at_line(self.line)
    }

    /// Every field, in the order of the columns.
    pub fn fields(&self) -> &[String] {
        &self.fields
    }
}

/// The records of `text`, whose header must be `columns` in this order. `file` is how errors name it.
///
/// # Errors
/// No text, another header, a record of another length, no record at all, an empty `id` or one that stands twice.
pub fn read(file: &str, text: &str, columns: &'static [&'static str]) -> Result<Vec<Record>, Fault> {
    let text_alone = text.strip_prefix('\u{feff}').unwrap_or(text);
    let skipped = text.len() - text_alone.len();
    if text_alone.trim().is_empty() {
        return Err(Fault::of_file(
            file,
            format!("it is empty; its header is {}", columns.join(",")),
        ));
    }
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text_alone.as_bytes());
    let mut records = Vec::new();
    let mut header_seen = false;
    let mut raw = csv::StringRecord::new();
    let mut lines = Lines::new(text_alone);
    while reader
        .read_record(&mut raw)
        .map_err(|error| Fault::of_file(file, error.to_string()))?
    {
        let start = raw.position().map_or(0, csv::Position::byte);
        let fields: Vec<String> = raw.iter().map(str::to_owned).collect();
        if !header_seen {
            check_header(file, &fields, columns)?;
            header_seen = true;
            continue;
        }
        let (start, end) = (lines.to(start), lines.end(reader.position().byte()));
        let record = Record {
            file: file.to_owned(),
            line: lines.line,
            bytes: skipped + start..skipped + end,
            columns,
            fields,
        };
        check_length(&record)?;
        records.push(record);
    }
    if records.is_empty() {
        return Err(Fault::of_file(
            file,
            "it has a header and no rows; nothing would be checked",
        ));
    }
    check_ids(&records)?;
    Ok(records)
}

/// Counts lines along a text. The csv crate counts them too, but its records begin with the empty lines, and the
/// second half of the line break, that stand before them.
pub struct Lines<'a> {
    text: &'a str,
    at: usize,
    /// The line, from 1, that was walked to.
    pub line: u64,
}

impl<'a> Lines<'a> {
    /// At the beginning of a text.
    pub fn new(text: &'a str) -> Self {
        let (at, line) = (0, 1);
        Self { text, at, line }
    }

    /// Walks on to the record that the csv crate says begins at `byte`, and answers where it does begin.
    pub fn to(&mut self, byte: u64) -> usize {
        let start = self.offset(byte);
        let rest = self.text.get(start..).unwrap_or_default();
        let blank = rest.len() - rest.trim_start_matches(['\r', '\n']).len();
        let passed = self.text.get(self.at..start + blank).unwrap_or_default();
        self.line += passed.bytes().map(|byte| u64::from(byte == b'\n')).sum::<u64>();
        self.at = start + blank;
        self.at
    }

    /// Where the record ends that the csv crate says ends at `byte`: it leaves half of a `\r\n` to the next one.
    fn end(&self, byte: u64) -> usize {
        let end = self.offset(byte);
        let (before, after) = self.text.split_at_checked(end).unwrap_or((self.text, ""));
        end + usize::from(before.ends_with('\r') && after.starts_with('\n'))
    }

    fn offset(&self, byte: u64) -> usize {
        usize::try_from(byte).unwrap_or(usize::MAX).min(self.text.len())
    }
}

fn check_header(file: &str, found: &[String], columns: &[&str]) -> Result<(), Fault> {
    if found.iter().map(String::as_str).eq(columns.iter().copied()) {
        return Ok(());
    }
    let missing = columns.iter().find(|&&name| !found.iter().any(|field| field == name));
    let strange = found.iter().find(|field| !columns.contains(&field.as_str()));
    let what = match (missing, strange) {
        (Some(missing), Some(strange)) => format!("the header has `{strange}` and no `{missing}`"),
        (Some(missing), None) => format!("the header has no `{missing}`"),
        (None, Some(strange)) => format!("the header has `{strange}`, which is no column"),
        (None, None) => "the columns of the header stand in another order or twice".to_owned(),
    };
    let message = format!("{what}; it must be {}", columns.join(","));
    Err(Fault::of_file(file, message).at_line(1))
}

fn check_length(record: &Record) -> Result<(), Fault> {
    let (found, wanted) = (record.fields.len(), record.columns.len());
    if found == wanted {
        return Ok(());
    }
    Err(record.fault_of_row(format!(
        "{found} fields where the header has {wanted}; a field with a comma stands in double quotes, which are closed"
    )))
}

fn check_ids(records: &[Record]) -> Result<(), Fault> {
    let mut seen: HashMap<&str, u64> = HashMap::new();
    for record in records {
        let id = record.required("id")?;
        if let Some(line) = seen.insert(id, record.line) {
            return Err(record.fault(
                "id",
                format!("`{id}` stands on line {line} already; an id is permanent and unique"),
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: &[&str] = &["id", "value"];

    fn fault(text: &str) -> String {
        read("x.csv", text, COLUMNS).map_or_else(|fault| fault.to_string(), |records| format!("{records:?}"))
    }

    #[test]
    fn records_know_their_line_and_their_bytes() {
        let text = "id,value\r\na,1\r\n\r\n\"b, c\",\"2\n3\"\r\nd,4";
        let records = read("x.csv", text, COLUMNS).unwrap_or_default();
        let lines: Vec<u64> = records.iter().map(|record| record.line).collect();
        assert_eq!(lines, [2, 4, 6]);
        assert_eq!(records.get(1).map(|record| record.field("value")), Some("2\n3"));
        let texts: Vec<&str> = records
            .iter()
            .map(|record| text.get(record.bytes.clone()).unwrap_or_default().trim())
            .collect();
        assert_eq!(texts, ["a,1", "\"b, c\",\"2\n3\"", "d,4"]);
    }

    #[test]
    fn a_byte_order_mark_is_no_part_of_the_header() {
        let text = "\u{feff}id,value\na,1\n";
        let records = read("x.csv", text, COLUMNS).unwrap_or_default();
        let bytes = records.first().map(|record| record.bytes.clone()).unwrap_or_default();
        assert_eq!(text.get(bytes), Some("a,1\n"));
    }

    #[test]
    fn what_is_no_golden_file_is_named_with_what_is_allowed() {
        for (text, words) in [
            ("", "x.csv: it is empty; its header is id,value"),
            (" \n\n", "x.csv: it is empty"),
            ("id,value\n", "x.csv: it has a header and no rows"),
            (
                "id,values\na,1\n",
                "x.csv, line 1: the header has `values` and no `value`",
            ),
            ("id\na\n", "x.csv, line 1: the header has no `value`"),
            ("id,value,more\na,1,2\n", "x.csv, line 1: the header has `more`"),
            ("value,id\n1,a\n", "another order"),
            ("id,value\na,1\nb\n", "x.csv, line 3: 1 fields where the header has 2"),
            ("id,value\na,1,2\n", "x.csv, line 2: 3 fields"),
            ("id,value\n,1\n", "x.csv, line 2, column `id`: it is empty"),
            (
                "id,value\na,1\na,2\n",
                "x.csv, line 3, column `id`: `a` stands on line 2 already",
            ),
        ] {
            assert!(fault(text).contains(words), "{text:?}: {}", fault(text));
        }
    }
}
