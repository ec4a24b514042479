//! Findings in the Static Analysis Results Interchange Format 2.1.0, by which CI marks lines.

use super::baseline::fingerprint_key;
use serde_json::{Map, Value, json};

/// What was checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Formula,
    Number,
    /// A file, or a comment in it.
    Input,
}

/// Text to be put in the place of other text, each from a line and column to a line and column that it does not reach.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// What is wrong.
    pub words: String,
    pub replacements: Vec<([(usize, usize); 2], String)>,
}

/// What was found of one formula or number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    pub kind: Kind,
    pub label: String,
    pub verdict: String,
    pub is_expected: bool,
    /// Whether an earlier run knows it; nothing where none was asked.
    pub is_known: Option<bool>,
    pub message: String,
    /// The file that it stands in, by its path; none for what is built in.
    pub file: Option<String>,
    /// Where it starts, from 1, and perhaps where it ends.
    pub start: Option<(usize, usize)>,
    pub end: Option<(usize, usize)>,
    /// What stands there.
    pub formula: String,
    pub fingerprint: String,
    pub fixes: Vec<Fix>,
}

/// The rules: kind, verdict, how serious it is where it was not expected, and what it says.
const RULES: [(Kind, &str, &str, &str); 14] = [
    (
        Kind::Input,
        "unusable",
        "error",
        "A file or a comment cannot be read, so that something is not checked.",
    ),
    (
        Kind::Formula,
        "proved",
        "warning",
        "The formula follows from its premises; the source says that it does not.",
    ),
    (
        Kind::Formula,
        "refuted",
        "error",
        "The formula fails where its premises hold, at values that were proved.",
    ),
    (
        Kind::Formula,
        "suspect",
        "warning",
        "The link of a chain fails where what stands before it holds, and one small change makes it hold.",
    ),
    (
        Kind::Formula,
        "conditional",
        "note",
        "The formula follows but for values at which a factor of a premise is 0, which its author divided by.",
    ),
    (
        Kind::Formula,
        "undecided",
        "warning",
        "Neither a proof nor a counterexample was found.",
    ),
    (Kind::Formula, "unread", "error", "The formula cannot be read."),
    (
        Kind::Number,
        "reproduced",
        "warning",
        "The number is reproduced; the source says that it is not.",
    ),
    (
        Kind::Number,
        "truncated",
        "warning",
        "The last figures of the number are cut off instead of rounded.",
    ),
    (
        Kind::Number,
        "off-by-one",
        "warning",
        "The last figure of the number is off by one.",
    ),
    (
        Kind::Number,
        "rounded",
        "warning",
        "The number agrees in all but its last figure.",
    ),
    (
        Kind::Number,
        "wrong",
        "error",
        "Something else is computed than the number that is printed.",
    ),
    (
        Kind::Number,
        "undetermined",
        "warning",
        "What is printed does not determine the number.",
    ),
    (
        Kind::Number,
        "undecided",
        "warning",
        "The number could not be computed.",
    ),
];

fn rule(kind: Kind, verdict: &str) -> String {
    let kind = match kind {
        Kind::Formula => "formula",
        Kind::Number => "number",
        Kind::Input => "input",
    };
    format!("{kind}-{verdict}")
}

/// The log of one run. What is proved or reproduced as expected is no finding.
pub fn sarif(findings: &[Finding]) -> String {
    let rules: Vec<Value> = RULES
        .iter()
        .map(|(kind, verdict, level, text)| {
            json!({
                "id": rule(*kind, verdict),
                "shortDescription": { "text": text },
                "defaultConfiguration": { "level": level },
            })
        })
        .collect();
    let is_good = |finding: &&Finding| {
        !(finding.is_expected
            && finding.is_known != Some(true)
            && ["proved", "reproduced", "given"].contains(&&*finding.verdict))
    };
    let results: Vec<Value> = findings.iter().filter(is_good).map(result).collect();
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": env!("CARGO_PKG_NAME"),
                "semanticVersion": env!("CARGO_PKG_VERSION"),
                "rules": rules,
            }},
            "columnKind": "unicodeCodePoints",
            "results": results,
        }],
    });
    format!("{log:#}\n")
}

fn result(finding: &Finding) -> Value {
    let id = rule(finding.kind, &finding.verdict);
    let index = RULES.iter().position(|(kind, verdict, ..)| rule(*kind, verdict) == id);
    // what is expected or known is told and fails nothing
    let level = match index.and_then(|place| RULES.get(place)) {
        Some((_, _, level, _)) if !finding.is_expected => *level,
        _ => "note",
    };
    let mut location = Map::new();
    if let Some(file) = &finding.file {
        let mut physical = json!({ "artifactLocation": { "uri": uri(file) } });
        if let Some(start) = finding.start {
            physical["region"] = region(start, finding.end);
            if finding.end.is_some() {
                physical["region"]["snippet"] = json!({ "text": finding.formula });
            }
        }
        location.insert("physicalLocation".to_owned(), physical);
    }
    location.insert(
        "logicalLocations".to_owned(),
        json!([{ "name": finding.label, "kind": "object" }]),
    );
    let mut result = json!({
        "ruleId": id,
        "level": level,
        "message": { "text": format!("({}) {}: {}", finding.label, finding.verdict, finding.message) },
        "locations": [location],
        "partialFingerprints": { fingerprint_key(): finding.fingerprint },
    });
    if let Some(index) = index {
        result["ruleIndex"] = json!(index);
    }
    if let Some(is_known) = finding.is_known {
        result["baselineState"] = json!(if is_known { "unchanged" } else { "new" });
    }
    if let Some(file) = finding.file.as_ref().filter(|_| !finding.fixes.is_empty()) {
        let fixes: Vec<Value> = finding.fixes.iter().map(|fix| fixed(fix, file)).collect();
        result["fixes"] = json!(fixes);
    }
    result
}

fn fixed(fix: &Fix, file: &str) -> Value {
    let replacements: Vec<Value> = fix
        .replacements
        .iter()
        .map(|([start, end], text)| json!({ "deletedRegion": region(*start, Some(*end)), "insertedContent": { "text": text } }))
        .collect();
    json!({
        "description": { "text": fix.words },
        "artifactChanges": [{ "artifactLocation": { "uri": uri(file) }, "replacements": replacements }],
    })
}

fn region((line, column): (usize, usize), end: Option<(usize, usize)>) -> Value {
    let mut region = json!({ "startLine": line, "startColumn": column });
    if let Some((line, column)) = end {
        region["endLine"] = json!(line);
        region["endColumn"] = json!(column);
    }
    region
}

/// A path as a URI, relative where it is.
fn uri(path: &str) -> String {
    let path = path.replace('\\', "/");
    let path = path.strip_prefix("./").unwrap_or(&path);
    let mut uri = String::from(if path.starts_with('/') { "file://" } else { "" });
    for (place, byte) in path.bytes().enumerate() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => uri.push(char::from(byte)),
            // a drive
            b':' if place == 1 => uri.push(':'),
            byte => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finding() -> Finding {
        Finding {
            kind: Kind::Formula,
            label: "2".to_owned(),
            verdict: "refuted".to_owned(),
            is_expected: false,
            is_known: None,
            message: "left is not right".to_owned(),
            file: Some("./my paper.tex".to_owned()),
            start: Some((3, 1)),
            end: Some((3, 6)),
            formula: "a = b".to_owned(),
            fingerprint: "aa".to_owned(),
            fixes: vec![Fix {
                words: "a sign".to_owned(),
                replacements: vec![([(3, 1), (3, 6)], "a = -b".to_owned())],
            }],
        }
    }

    fn log(findings: &[Finding]) -> Value {
        serde_json::from_str(&sarif(findings)).unwrap()
    }

    #[test]
    fn a_finding_has_its_rule_its_place_and_its_repair() {
        let log = log(&[finding()]);
        let result = &log["runs"][0]["results"][0];
        let rule = &log["runs"][0]["tool"]["driver"]["rules"][result["ruleIndex"].as_u64().unwrap() as usize];
        assert_eq!((&result["ruleId"], &result["level"]), (&rule["id"], &json!("error")));
        let place = &result["locations"][0]["physicalLocation"];
        assert_eq!(place["artifactLocation"]["uri"], "my%20paper.tex");
        assert_eq!(
            (&place["region"]["startLine"], &place["region"]["endColumn"]),
            (&json!(3), &json!(6))
        );
        let replacement = &result["fixes"][0]["artifactChanges"][0]["replacements"][0];
        assert_eq!(replacement["insertedContent"]["text"], "a = -b");
    }

    #[test]
    fn what_is_proved_as_expected_is_no_finding_and_what_is_known_fails_nothing() {
        let proved = Finding {
            verdict: "proved".to_owned(),
            is_expected: true,
            ..finding()
        };
        let known = Finding {
            is_expected: true,
            is_known: Some(true),
            ..finding()
        };
        let log = log(&[proved, known]);
        let results = log["runs"][0]["results"].as_array().unwrap();
        assert_eq!(results.len(), 1);
        assert_eq!(
            (&results[0]["level"], &results[0]["baselineState"]),
            (&json!("note"), &json!("unchanged"))
        );
    }
}
