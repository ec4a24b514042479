//! Rewriting a reference file: every value computed anew by two means, and written where both agree.

use super::certified::{Certified, FIGURES};
use super::figures::{Figures, size};
use super::request::Request;
use super::{Fault, Quantity, Setting};
use num_traits::Zero;
use numbers::Rational;

/// A value made by one means and confirmed by another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Made {
    /// The decimal of the first means, with at least 30 significant figures.
    pub value: String,
    /// The first means.
    pub by: String,
    /// The decimal of the second means, as many figures.
    pub other: String,
    /// The second means.
    pub confirmed_by: String,
}

/// A value that blessing changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// The row.
    pub id: String,
    /// The value before; empty where there was none.
    pub before: String,
    /// The value now.
    pub after: String,
}

/// A reference file as it should be, and what changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Blessed {
    /// The whole text; rows that did not change keep their bytes.
    pub text: String,
    /// The rows that did.
    pub changes: Vec<Change>,
}

/// Computes every value of a reference file anew. `text` is the file's, `rows` what was read from it; `make` computes
/// a quantity of a request by two means, in the row that the setting names.
///
/// # Errors
/// The first row, by line, that cannot be made, or whose two means disagree within 30 figures: nothing is to be
/// written then.
pub fn bless(
    text: &str,
    rows: &[Certified],
    make: &mut dyn FnMut(&Request, &Quantity, &Setting) -> Result<Made, String>,
) -> Result<Blessed, Fault> {
    let mut written = String::with_capacity(text.len());
    let mut changes = Vec::new();
    let mut at = 0;
    for row in rows {
        let made =
            make(&row.request(), &row.quantity, &row.setting).map_err(|message| row.record.fault_of_row(message))?;
        let value = agreed(&made).map_err(|message| row.record.fault("value", message))?;
        let now = [value.as_str(), &made.by, &made.confirmed_by];
        let before = ["value", "by", "confirmed_by"].map(|column| row.record.field(column));
        if now == before {
            continue;
        }
        let record = row.record.bytes.clone();
        written.push_str(text.get(at..record.start).unwrap_or_default());
        let kept = row.record.fields().iter().take(row.record.fields().len() - now.len());
        let fields: Vec<&str> = kept.map(String::as_str).chain(now).collect();
        let before_it = text.get(record.clone()).unwrap_or_default();
        let ending = before_it
            .get(before_it.trim_end_matches(['\r', '\n']).len()..)
            .unwrap_or_default();
        written.push_str(&line(&fields).map_err(|message| row.record.fault_of_row(message))?);
        written.push_str(ending);
        at = record.end;
        changes.push(Change {
            id: row.record.field("id").to_owned(),
            before: before[0].to_owned(),
            after: value,
        });
    }
    written.push_str(text.get(at..).unwrap_or_default());
    Ok(Blessed { text: written, changes })
}

/// The value to 30 significant figures, where both means give it within one unit of the last.
fn agreed(made: &Made) -> Result<String, String> {
    let number = |text: &str, by: &str| {
        let figures = Figures::read(text).ok_or_else(|| format!("{by} gives `{text}`, which is not a number"))?;
        if figures.count < FIGURES && !figures.value.is_zero() {
            return Err(format!(
                "{by} gives {text}, which has {} figures of {FIGURES}",
                figures.count
            ));
        }
        Ok(figures)
    };
    if made.by == made.confirmed_by {
        return Err(format!("`{}` cannot confirm itself", made.by));
    }
    let (first, second) = (number(&made.value, &made.by)?, number(&made.other, &made.confirmed_by)?);
    let places = first.places - (first.count - FIGURES).max(0);
    let unit = super::figures::power_of_ten(-places);
    // Rounding to the last figure may differ by one even where both are right.
    if size(first.value.clone() - second.value) > unit {
        return Err(format!(
            "the two means disagree: {} gives {}, {} gives {}",
            made.by, made.value, made.confirmed_by, made.other
        ));
    }
    Ok(padded(&first.value, places))
}

/// The value with exactly so many places, trailing zeros included: each of them is a figure that holds.
fn padded(value: &Rational, places: i32) -> String {
    let mut text = super::figures::rounded(value, places);
    let Ok(places @ 1..) = usize::try_from(places) else {
        return text;
    };
    let found = text.split_once('.').map(|(_, fraction)| fraction.len());
    if found.is_none() {
        text.push('.');
    }
    text.push_str(&"0".repeat(places.saturating_sub(found.unwrap_or(0))));
    text
}

/// The record as CSV, without a line break.
fn line(fields: &[&str]) -> Result<String, String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(fields).map_err(|error| error.to_string())?;
    let bytes = writer.into_inner().map_err(|error| error.to_string())?;
    let text = String::from_utf8(bytes).map_err(|error| error.to_string())?;
    Ok(text.trim_end_matches('\n').to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "id,scene,set,quantity,value,by,confirmed_by\r\n\
                        a , s,,branch.d,0.251070185389869230000000000000,curve,Newton\r\n\
                        b,s,\"words=['BT']\",branch.d,,,\r\n";

    fn made(value: &str, other: &str) -> Made {
        Made {
            value: value.to_owned(),
            by: "curve".to_owned(),
            other: other.to_owned(),
            confirmed_by: "Newton".to_owned(),
        }
    }

    fn blessed(value: &str, other: &str) -> Result<Blessed, String> {
        let rows = Certified::read("reference/x.csv", FILE).map_err(|fault| fault.to_string())?;
        let mut make = |_: &Request, _: &Quantity, _: &Setting| Ok(made(value, other));
        bless(FILE, &rows, &mut make).map_err(|fault| fault.to_string())
    }

    #[test]
    fn rows_that_do_not_change_keep_their_bytes() {
        let (value, other) = ("0.2510701853898692300000000000004", "0.2510701853898692300000000000001");
        let blessed = blessed(value, other);
        let text = blessed.as_ref().map(|blessed| blessed.text.clone());
        let expected = "id,scene,set,quantity,value,by,confirmed_by\r\n\
                        a , s,,branch.d,0.251070185389869230000000000000,curve,Newton\r\n\
                        b,s,words=['BT'],branch.d,0.251070185389869230000000000000,curve,Newton\r\n";
        assert_eq!(text, Ok(expected.to_owned()));
        let ids: Option<Vec<&str>> = blessed
            .as_ref()
            .ok()
            .map(|blessed| blessed.changes.iter().map(|change| change.id.as_str()).collect());
        assert_eq!(ids, Some(vec!["b"]));
    }

    #[test]
    fn what_two_means_do_not_agree_on_is_never_written() {
        for (value, other, words) in [
            (
                "0.251070185389869230000000000001",
                "0.251070185389869230000000000003",
                "the two means disagree",
            ),
            ("0.25107", "0.25107", "5 figures of 30"),
            ("0.251070185389869230000000000001", "nothing", "not a number"),
        ] {
            let message = blessed(value, other).map_or_else(|message| message, |blessed| blessed.text);
            assert!(
                message.contains(words) && message.starts_with("reference/x.csv, line 2"),
                "{message}"
            );
        }
    }

    #[test]
    fn a_means_does_not_confirm_itself() {
        let same = Made {
            confirmed_by: "curve".to_owned(),
            ..made("0.251070185389869230000000000001", "0.251070185389869230000000000001")
        };
        assert!(agreed(&same).is_err_and(|message| message.contains("cannot confirm itself")));
    }

    #[test]
    fn a_value_keeps_its_trailing_zeros() {
        let text = |value: &str| Figures::read(value).map(|figures| padded(&figures.value, 4));
        assert_eq!(text("0.5").as_deref(), Some("0.5000"));
        assert_eq!(text("2").as_deref(), Some("2.0000"));
    }
}
