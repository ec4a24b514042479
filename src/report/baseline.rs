//! Findings that are known, by what they are about and not by where it stands.

use super::json::FORMULAS;
use crate::checksum::Checksum;
use serde_json::Value;
use std::collections::BTreeMap;

/// The version of fingerprints. It changes with what they are computed from, so that an older baseline is refused and does not
/// silently know nothing.
const VERSION: &str = "v2";

/// Returns what a finding is known by: the version, and a sum of its label, its verdict and the text of its formula, blanks
/// aside. Lines may move.
pub fn fingerprint(label: &str, verdict: &str, formula: &str) -> String {
    let formula: String = formula.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut sum = Checksum::default();
    sum.add([label, verdict, &formula].join("\u{0}").as_bytes());
    format!("{VERSION}:{sum}")
}

/// What the keys of fingerprints in SARIF begin with; the version follows.
const FAMILY: &str = "vibroAudit/";

/// Returns the key of a fingerprint in SARIF.
pub(super) fn fingerprint_key() -> String {
    format!("{FAMILY}{VERSION}")
}

/// Findings of an earlier run.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Baseline {
    /// Labels by fingerprint.
    findings: BTreeMap<String, String>,
}

/// A file that is no baseline.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BaselineError {
    /// It is no output of `audit` that tells what it found.
    #[error("it is no output of `audit --format sarif`, `json`, `jsonl` or `csv`: {0}")]
    Unreadable(String),
    /// Its fingerprints are computed in another way.
    #[error(
        "its fingerprints are of version {0}, and this program knows {VERSION}: make the baseline anew, by `audit FILE --format sarif --out BASELINE`"
    )]
    Version(String),
    /// Nothing in it is about this document.
    #[error("it is of another document: of what it knows, {0}, nothing is here")]
    OfAnother(String),
}

impl Baseline {
    /// Reads what `audit` wrote as SARIF, JSON, JSON lines or CSV.
    ///
    /// # Errors
    /// A text that is none of these, or that has no fingerprints.
    pub fn read(text: &str) -> Result<Self, BaselineError> {
        let text = text.trim_start_matches('\u{feff}');
        match text.trim_start().chars().next() {
            Some('{' | '[') => Self::of_json(text),
            _ => Self::of_csv(text),
        }
    }

    fn of_json(text: &str) -> Result<Self, BaselineError> {
        let mut known = Self::default();
        for value in serde_json::Deserializer::from_str(text).into_iter::<Value>() {
            let value = value.map_err(|error| BaselineError::Unreadable(error.to_string()))?;
            let runs = value.get("runs").and_then(Value::as_array);
            match (runs, value.as_array()) {
                (Some(runs), _) => {
                    for result in runs.iter().filter_map(|run| run.get("results")?.as_array()).flatten() {
                        // a number that the document prints
                        let rule = result.get("ruleId").and_then(Value::as_str);
                        if rule.is_some_and(|rule| rule.starts_with("number-")) {
                            continue;
                        }
                        let label = result.pointer("/locations/0/logicalLocations/0/name");
                        known.take(label, of_result(result)?)?;
                    }
                }
                (None, Some(rows)) => known.take_rows(rows)?,
                (None, None) => match value.get(FORMULAS).and_then(Value::as_array) {
                    // of the tables of a document the other one holds its numbers
                    Some(rows) => known.take_rows(rows)?,
                    None => known.take_row(&value)?,
                },
            }
        }
        Ok(known)
    }

    fn take_rows(&mut self, rows: &[Value]) -> Result<(), BaselineError> {
        rows.iter().try_for_each(|row| self.take_row(row))
    }

    fn take_row(&mut self, row: &Value) -> Result<(), BaselineError> {
        match row.get("verdict").and_then(Value::as_str) {
            Some("proved") => Ok(()),
            // a number that the document prints
            Some(_) if row.get("label").is_none() && row.get("id").is_some() => Ok(()),
            _ => self.take(row.get("label"), row.get("fingerprint")),
        }
    }

    fn take(&mut self, label: Option<&Value>, fingerprint: Option<&Value>) -> Result<(), BaselineError> {
        let Some((label, fingerprint)) = label.and_then(Value::as_str).zip(fingerprint.and_then(Value::as_str)) else {
            return Err(BaselineError::Unreadable(
                "a finding has no label or no fingerprint".to_owned(),
            ));
        };
        self.insert(label, fingerprint)
    }

    fn insert(&mut self, label: &str, fingerprint: &str) -> Result<(), BaselineError> {
        match fingerprint.split_once(':') {
            Some((VERSION, _)) => {
                self.findings.insert(fingerprint.to_owned(), label.to_owned());
                Ok(())
            }
            Some((version, _)) => Err(BaselineError::Version(version.to_owned())),
            None => Err(BaselineError::Version("v1".to_owned())),
        }
    }

    fn of_csv(text: &str) -> Result<Self, BaselineError> {
        let unreadable = |problem: String| BaselineError::Unreadable(problem);
        let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(text.as_bytes());
        let head = reader.headers().map_err(|error| unreadable(error.to_string()))?.clone();
        let column = |name: &str| {
            let found = head.iter().position(|own| own == name);
            found.ok_or_else(|| unreadable(format!("it has no column `{name}`")))
        };
        let columns = [column("label")?, column("verdict")?, column("fingerprint")?];
        let mut known = Self::default();
        for row in reader.records() {
            let row = row.map_err(|error| unreadable(error.to_string()))?;
            let [label, verdict, fingerprint] = columns.map(|place| row.get(place).unwrap_or_default());
            // what keeps a spreadsheet from executing it
            let label = label
                .strip_prefix('\'')
                .filter(|rest| !rest.is_empty())
                .unwrap_or(label);
            // a number that the document prints has no label
            if verdict != "proved" && !label.is_empty() {
                known.insert(label, fingerprint)?;
            }
        }
        Ok(known)
    }

    /// Whether a finding is known.
    pub fn knows(&self, fingerprint: &str) -> bool {
        self.findings.contains_key(fingerprint)
    }

    /// Refuses a baseline that knows something of which nothing is of any of these labels, each with its fingerprint.
    ///
    /// # Errors
    /// It is another document's.
    pub fn refuse_other(&self, found: &[(String, String)]) -> Result<(), BaselineError> {
        let is_here = |known: &String| found.iter().any(|(label, _)| label == known);
        if self.findings.is_empty() || self.findings.values().any(is_here) {
            return Ok(());
        }
        let first = self.findings.values().take(3);
        let mut labels: Vec<String> = first.map(|label| format!("({label})")).collect();
        if self.findings.len() > 3 {
            labels.push("...".to_owned());
        }
        Err(BaselineError::OfAnother(labels.join(", ")))
    }

    /// The labels of what is known and not among these fingerprints, each with its label.
    pub fn gone(&self, found: &[(String, String)]) -> Vec<String> {
        let missing = |(fingerprint, _): &(&String, &String)| !found.iter().any(|(_, own)| own == *fingerprint);
        let mut labels: Vec<String> = self
            .findings
            .iter()
            .filter(missing)
            .map(|(_, label)| label.clone())
            .collect();
        labels.sort();
        labels.dedup();
        labels
    }
}

/// The fingerprint of a result of SARIF.
fn of_result(result: &Value) -> Result<Option<&Value>, BaselineError> {
    let Some(prints) = result.get("partialFingerprints").and_then(Value::as_object) else {
        return Ok(None);
    };
    let found = prints.get(&fingerprint_key());
    let other = prints.keys().find_map(|key| key.strip_prefix(FAMILY));
    match (found, other) {
        (None, Some(version)) => Err(BaselineError::Version(version.to_owned())),
        _ => Ok(found),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finding_is_known_wherever_its_formula_stands_and_not_when_it_changes() {
        let known = fingerprint("22", "refuted", "a = b\n + c");
        assert_eq!(known, fingerprint("22", "refuted", "a = b + c "));
        for (label, verdict, formula) in [
            ("23", "refuted", "a = b + c"),
            ("22", "undecided", "a = b + c"),
            ("22", "refuted", "a = b - c"),
        ] {
            assert_ne!(known, fingerprint(label, verdict, formula));
        }
    }

    #[test]
    fn fingerprints_of_another_version_are_refused() {
        // what a fingerprint is computed from changes with its version alone
        assert_eq!(fingerprint("22", "refuted", "a = b"), "v2:a8ecc8de1038313a");
        let result = |prints: &str| {
            let place = r#"[{"logicalLocations":[{"name":"2"}]}]"#;
            let prints = format!("{{\"locations\":{place},\"partialFingerprints\":{prints}}}");
            format!("{{\"runs\":[{{\"results\":[{prints}]}}]}}")
        };
        for (text, version) in [
            (result(r#"{"vibroAudit/v1":"93670cd32f6bff47"}"#), "v1"),
            (result(r#"{"vibroAudit/v3":"v3:93670cd32f6bff47"}"#), "v3"),
            (
                "label,verdict,fingerprint\n2,refuted,93670cd32f6bff47\n".to_owned(),
                "v1",
            ),
            (
                r#"[{"label":"2","verdict":"refuted","fingerprint":"v3:1"}]"#.to_owned(),
                "v3",
            ),
        ] {
            assert_eq!(
                Baseline::read(&text),
                Err(BaselineError::Version(version.to_owned())),
                "{text}"
            );
        }
        assert!(Baseline::read(&result(r#"{"vibroAudit/v2":"v2:1"}"#)).is_ok());
    }

    #[test]
    fn every_format_that_audit_writes_reads_back_to_the_same() {
        let print = fingerprint("2", "refuted", "a = b");
        let csv = format!("label,verdict,fingerprint,id\n1,proved,0,\n'2,refuted,{print},\n,wrong,,number-1\n");
        let row = format!("{{\"label\":\"2\",\"verdict\":\"refuted\",\"fingerprint\":\"{print}\"}}");
        let json = format!("{{\"formulas\":[{row}],\"numbers\":[{{\"id\":\"1\",\"verdict\":\"wrong\"}}]}}");
        let rows = format!("[{row}]");
        let lines = format!(
            "{{\"label\":\"1\",\"verdict\":\"proved\"}}\n{{\"label\":\"2\",\"verdict\":\"refuted\",\"fingerprint\":\"{print}\"}}"
        );
        let baselines = [csv, json, rows, lines].map(|text| Baseline::read(&text).unwrap());
        for baseline in &baselines {
            assert_eq!(baseline, &baselines[0]);
            assert!(baseline.knows(&print) && !baseline.knows("0"));
        }
    }

    #[test]
    fn a_baseline_of_another_document_is_an_error_and_what_is_gone_is_told() {
        let baseline = Baseline::read("label,verdict,fingerprint\n2,refuted,v2:aa\n7,unread,v2:bb\n").unwrap();
        let found = |label: &str, print: &str| (label.to_owned(), print.to_owned());
        let here = [found("2", "v2:cc"), found("7", "v2:bb")];
        assert_eq!(baseline.gone(&here), ["2"]);
        assert_eq!(baseline.refuse_other(&here), Ok(()));
        let error = baseline.refuse_other(&[found("A", "v2:aa")]).unwrap_err();
        assert!(
            error.to_string().contains("another document") && error.to_string().contains("(2), (7)"),
            "{error}"
        );
        for text in [
            "",
            "label,verdict\n",
            "{}",
            "[{\"verdict\":\"refuted\"}]",
            "{",
            "<html>",
        ] {
            assert!(
                matches!(Baseline::read(text), Err(BaselineError::Unreadable(_))),
                "{text}"
            );
        }
    }
}
