//! The worst points that a search has found, frozen: golden/stress/worst.csv.

use super::StressError;
use super::row::{Form, StressRow};

/// The embedded file.
pub const WORST: &str = include_str!("../../golden/stress/worst.csv");

/// Where it stands in the repository.
pub const WORST_PATH: &str = "golden/stress/worst.csv";

const COLUMNS: [&str; 6] = ["case", "formula", "number", "form", "digits", "at"];

/// One row of it: what a form kept when it was frozen.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Frozen {
    pub case: String,
    pub formula: String,
    pub number: String,
    pub form: Form,
    pub digits: f64,
    pub at: String,
}

impl Frozen {
    /// What is wrong with it.
    pub fn fault(&self, what: &str) -> StressError {
        let Self { case, formula, at, .. } = self;
        StressError::Frozen {
            line: 0,
            what: format!("{case} {formula} at {at}: {what}"),
        }
    }
}

/// The rows of a file.
///
/// # Errors
/// `Frozen`, with the line: another header, a row of another length, digits or a form that are none.
pub(super) fn read(text: &str) -> Result<Vec<Frozen>, StressError> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let fault = |line: u64, what: String| StressError::Frozen { line, what };
    let header = reader.headers().map_err(|error| fault(1, error.to_string()))?;
    if !header.iter().eq(COLUMNS) {
        return Err(fault(1, format!("the header must be {}", COLUMNS.join(","))));
    }
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| {
            let line = error.position().map_or(0, csv::Position::line);
            fault(line, error.to_string())
        })?;
        let line = record.position().map_or(0, csv::Position::line);
        let field = |index: usize| record.get(index).unwrap_or_default().to_owned();
        let digits: f64 = field(4)
            .parse()
            .map_err(|_| fault(line, format!("digits `{}`", field(4))))?;
        if !digits.is_finite() {
            return Err(fault(line, format!("digits `{}`", field(4))));
        }
        rows.push(Frozen {
            case: field(0),
            formula: field(1),
            number: field(2),
            form: Form::of(&field(3)).ok_or_else(|| fault(line, format!("form `{}`", field(3))))?,
            digits,
            at: field(5),
        });
    }
    Ok(rows)
}

/// The file that freezes these rows.
///
/// # Errors
/// `Frozen` where a row cannot be written.
pub fn frozen_text(rows: &[StressRow]) -> Result<String, StressError> {
    let fault = |what: String| StressError::Frozen { line: 0, what };
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(COLUMNS).map_err(|error| fault(error.to_string()))?;
    for row in rows {
        let digits = format!("{:.2}", row.digits);
        let fields = [&row.case, &row.formula, &row.number, row.form.name(), &digits, &row.at];
        writer.write_record(fields).map_err(|error| fault(error.to_string()))?;
    }
    let bytes = writer.into_inner().map_err(|error| fault(error.to_string()))?;
    String::from_utf8(bytes).map_err(|error| fault(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::super::row::tests::row;
    use super::*;

    #[test]
    fn what_is_frozen_reads_back() {
        let text = frozen_text(&[row(Form::Printed, "50-digits", 3.254, 1e7)]).unwrap();
        let rows = read(&text).unwrap();
        assert_eq!(rows.len(), 1);
        assert_eq!(
            (rows[0].digits, rows[0].form, rows[0].at.as_str()),
            (3.25, Form::Printed, "x=1.0")
        );
    }

    #[test]
    fn a_file_that_makes_no_sense_is_an_error_with_its_line() {
        let header = "case,formula,number,form,digits,at\n";
        for (text, wrong) in [
            ("a,b\n".to_owned(), 1),
            (format!("{header}c,f,f64,stable,15,x=1\nc,f,f64,other,15,x=1\n"), 3),
            (format!("{header}c,f,f64,stable,many,x=1\n"), 2),
            (format!("{header}c,f,f64,stable,NaN,x=1\n"), 2),
            (format!("{header}c,f,f64\n"), 2),
        ] {
            let found = read(&text);
            assert!(
                matches!(found, Err(StressError::Frozen { line, .. }) if line == wrong),
                "{found:?}"
            );
        }
    }

    #[test]
    fn the_embedded_file_makes_sense() {
        assert!(!read(WORST).unwrap().is_empty());
    }
}
