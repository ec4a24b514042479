//! `reference/*.csv`: values with 30 digits, made by one means and confirmed by another.

use super::compare::{Comparison, certified_against};
use super::outcome::{Outcome, unexpected};
use super::request::{Asked, Request};
use super::value::Value;
use super::{Fault, Figures, Quantity, Setting, Verdict, records, records::Record};

/// The columns of a reference file.
pub const COLUMNS: &[&str] = &["id", "scene", "set", "quantity", "value", "by", "confirmed_by"];

/// The significant figures of a certified value.
pub const FIGURES: i32 = 30;

/// The digits in which a certified value is computed again, and the key of a scene that says so.
const ASKED: i32 = FIGURES + 5;
const DIGITS: &str = "digits";

/// A row of a reference file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Certified {
    /// Where it stands; every field as written.
    pub record: Record,
    /// The file, relative to the directory.
    pub file: String,
    /// What it is the value of.
    pub quantity: Quantity,
    /// The scene's overrides and the row that is meant.
    pub setting: Setting,
}

impl Certified {
    /// The rows of a reference file. The value may be empty: blessing fills it.
    ///
    /// # Errors
    /// Another header, a row of another length, no row, an id that is empty or stands twice; a quantity or a set that
    /// cannot be read; an extreme of several rows, which nothing certifies; a value that is no number.
    pub fn read(file: &str, text: &str) -> Result<Vec<Self>, Fault> {
        let records = records::read(file, text, COLUMNS)?;
        records
            .into_iter()
            .map(|record| Self::from_record(file, record))
            .collect()
    }

    fn from_record(file: &str, record: Record) -> Result<Self, Fault> {
        let quantity: Quantity = record
            .required("quantity")?
            .parse()
            .map_err(|error: super::NoQuantity| record.fault("quantity", error.to_string()))?;
        if quantity.across.is_some() {
            return Err(record.fault(
                "quantity",
                "a certified value is that of one row, without .min, .max, .spread, .trend or .count",
            ));
        }
        let value = record.field("value");
        if !value.is_empty() && Figures::read(value).is_none() {
            return Err(record.fault("value", format!("`{value}` is not a number such as 0.251070185389869")));
        }
        Ok(Self {
            file: file.to_owned(),
            setting: Setting::read(&record)?,
            quantity,
            record,
        })
    }

    /// What it asks for.
    pub fn request(&self) -> Request {
        Request::new(&self.quantity.command, &self.record, &self.setting)
    }

    /// The same with more digits than are certified.
    fn request_of_all_figures(&self) -> Request {
        let mut request = self.request();
        if !request.overrides.iter().any(|(key, _)| key == DIGITS) {
            request.overrides.push((DIGITS.to_owned(), ASKED.to_string()));
        }
        request
    }

    fn against(
        &self,
        value: &str,
        request: &Request,
        asked: &mut Asked<'_>,
    ) -> Result<(Value, Comparison, String), Fault> {
        let table = asked.ask(request, &self.record)?;
        let picked = table.picked(&self.quantity, &self.setting);
        let computed = table
            .value(&self.quantity, &self.setting)
            .map_err(|message| self.record.fault("quantity", message))?;
        let comparison = certified_against(value, &computed).map_err(|message| self.record.fault("value", message))?;
        Ok((computed, comparison, picked))
    }

    /// Holds the value against what is computed, within the bound of that: in f64, and to all its figures.
    ///
    /// # Errors
    /// An empty value, no answer, no row or several rows meant.
    pub fn hold(&self, asked: &mut Asked<'_>) -> Result<Outcome, Fault> {
        let value = self.record.field("value");
        if value.is_empty() {
            return Err(self
                .record
                .fault("value", "it is empty; `check DIR --bless` computes it"));
        }
        let (mut computed, mut comparison, mut picked) = self.against(value, &self.request(), asked)?;
        if comparison.verdict == Verdict::Reproduced {
            // f64 knows nothing of the figures beyond its own
            (computed, comparison, picked) = self.against(value, &self.request_of_all_figures(), asked)?;
        }
        let mut outcome = Outcome {
            id: self.record.field("id").to_owned(),
            place: self.file.clone(),
            printed: value.to_owned(),
            computed: computed.text,
            digits: comparison.digits,
            verdict: comparison.verdict,
            expected: Verdict::Reproduced,
            rests_on: format!("{}; {}", self.record.field("by"), self.record.field("confirmed_by")),
            reason: comparison.reason,
            picked,
        };
        if !outcome.is_expected() {
            outcome.reason = unexpected(&outcome);
        }
        Ok(outcome)
    }
}
