//! `printed.csv`: what a paper prints, one number or word a row.

use super::{Fault, Quantity, Setting, Verdict, records, records::Record};

/// The columns of `printed.csv`.
pub const COLUMNS: &[&str] = &[
    "id", "place", "scene", "set", "quantity", "printed", "unit", "expected", "rests_on", "note",
];

/// A row of `printed.csv`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Printed {
    /// Where it stands; every field as written.
    pub record: Record,
    /// What it is about; `None` where the paper does not say enough to name a quantity.
    pub quantity: Option<Quantity>,
    /// The scene's overrides and the row that is meant.
    pub setting: Setting,
    /// The verdict that is expected of it.
    pub expected: Verdict,
}

impl Printed {
    /// The row's permanent name.
    pub fn id(&self) -> &str {
        self.record.field("id")
    }

    /// The value as printed.
    pub fn printed(&self) -> &str {
        self.record.field("printed")
    }

    /// The rows of `printed.csv`; `file` is how errors name it.
    ///
    /// # Errors
    /// Another header, a row of another length, no row, an id that is empty or stands twice; an empty id, place or
    /// printed value; an unknown verdict; a quantity or a set that cannot be read. A row without a quantity must
    /// expect `undetermined` and say why in its note.
    pub fn read(file: &str, text: &str) -> Result<Vec<Self>, Fault> {
        records::read(file, text, COLUMNS)?
            .into_iter()
            .map(Self::from_record)
            .collect()
    }

    /// The text of `printed.csv` with one row more, whose fields are in the order of the columns; `text` may be empty.
    ///
    /// # Errors
    /// None but a fault of ours.
    pub fn with_row(text: &str, row: &[String]) -> Result<String, Fault> {
        let fault = |error: &dyn std::fmt::Display| Fault::of_file("a row", error.to_string());
        let (line_break, terminator) = match text.contains("\r\n") {
            true => ("\r\n", csv::Terminator::CRLF),
            false => ("\n", csv::Terminator::Any(b'\n')),
        };
        let mut writer = csv::WriterBuilder::new().terminator(terminator).from_writer(Vec::new());
        let before = match text.trim_matches(['\u{feff}', ' ', '\n', '\r']) {
            "" => "",
            _ => text,
        };
        if before.is_empty() {
            writer.write_record(COLUMNS).map_err(|error| fault(&error))?;
        }
        writer.write_record(row).map_err(|error| fault(&error))?;
        let added = writer.into_inner().map_err(|error| fault(&error))?;
        let between = match before.is_empty() || before.ends_with('\n') {
            true => "",
            false => line_break,
        };
        Ok(format!("{before}{between}{}", String::from_utf8_lossy(&added)))
    }

    fn from_record(record: Record) -> Result<Self, Fault> {
        record.required("place")?;
        record.required("printed")?;
        let expected: Verdict = record
            .required("expected")?
            .parse()
            .map_err(|unknown: super::UnknownVerdict| record.fault("expected", unknown.to_string()))?;
        let quantity = match record.field("quantity") {
            "" if expected != Verdict::Undetermined => {
                return Err(record.fault(
                    "quantity",
                    "it is empty, which only a row that expects `undetermined` may be",
                ));
            }
            "" if record.field("note").is_empty() => {
                return Err(record.fault(
                    "note",
                    "it is empty; a row without a quantity says here what the paper leaves open",
                ));
            }
            "" => None,
            text => {
                let quantity = text.parse::<Quantity>();
                Some(quantity.map_err(|error| record.fault("quantity", error.to_string()))?)
            }
        };
        Ok(Self {
            quantity,
            setting: Setting::read(&record)?,
            expected,
            record,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(row: &str) -> Result<Vec<Printed>, String> {
        let text = format!("{}\n{row}\n", COLUMNS.join(","));
        Printed::read("printed.csv", &text).map_err(|fault| fault.to_string())
    }

    #[test]
    fn a_row_is_read_with_all_it_says() {
        let rows = read("a,Fig. 2,fig02,motion.d=0.4;row.word=BT,orbits.velocities[0],0.83272,,reproduced,A,");
        let row = rows.as_ref().ok().and_then(|rows| rows.first());
        assert_eq!(
            row.map(|row| (row.id(), row.printed(), row.expected)),
            Some(("a", "0.83272", Verdict::Reproduced))
        );
        assert_eq!(row.map(|row| row.setting.overrides.len()), Some(1));
    }

    #[test]
    fn a_row_is_added_with_the_header_and_the_line_break_that_the_text_needs() {
        let row: Vec<String> = COLUMNS.iter().map(|_| "a, \"b\"".to_owned()).collect();
        let header = COLUMNS.join(",");
        for (before, breaks) in [
            ("", "\n"),
            (" \n\n", "\n"),
            (&*header, "\n"),
            (&*format!("{header}\r\n"), "\r\n"),
        ] {
            let after = Printed::with_row(before, &row).unwrap_or_default();
            let (first, rest) = after.split_once(breaks).unwrap_or_default();
            assert_eq!(first, header, "{before:?}");
            assert!(
                rest.ends_with(breaks) && rest.matches('\n').count() == 1,
                "{before:?}: {rest:?}"
            );
            let records = records::read("x", &after, COLUMNS).unwrap_or_default();
            assert_eq!(records.first().map(Record::fields), Some(&*row));
        }
    }

    #[test]
    fn what_makes_no_sense_is_named_by_line_and_column() {
        for (row, words) in [
            ("a,,s,,orbits.d,1,,wrong,,", "column `place`: it is empty"),
            ("a,p,s,,orbits.d,,,wrong,,", "column `printed`: it is empty"),
            ("a,p,s,,orbits.d,1,,,,", "column `expected`: it is empty"),
            ("a,p,s,,orbits.d,1,,right,,", "column `expected`: `right` is no verdict"),
            (
                "a,p,s,,orbits.d,1,,undecided,,",
                "column `expected`: `undecided` is no verdict",
            ),
            (
                "a,p,s,,velocity,1,,wrong,,",
                "column `quantity`: `velocity` is no quantity",
            ),
            ("a,p,s,d,orbits.d,1,,wrong,,", "column `set`: `d` is no setting"),
            ("a,p,s,,,1,,wrong,,why", "column `quantity`: it is empty"),
            ("a,p,s,,,1,,undetermined,,", "column `note`: it is empty"),
        ] {
            let found = read(row).map_or_else(|message| message, |rows| format!("{rows:?}"));
            assert!(
                found.contains(words) && found.starts_with("printed.csv, line 2"),
                "{row}: {found}"
            );
        }
        assert!(read("a,p,s,,,1,,undetermined,,why").is_ok());
    }
}
