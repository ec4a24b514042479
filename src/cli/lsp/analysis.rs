//! The view of a text in an editor: diagnostics, hovers, and repairs as edits.

use super::lines::{Lines, Position, Range};
use super::memory::{Keys, Memory};
use crate::claim::{Fault, Sheet, Standing, Verdict};
use crate::cli::audit_table::Row;
use crate::cli::document::{Form, of_text};
use crate::cli::edits::replacements;
use crate::cli::source::TOML_AT_MOST;
use crate::cli::{Failure, Source};
use crate::prove;
use crate::tex::Symbols;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The name of the program beside each diagnostic.
const SOURCE: &str = "vibro-audit";

/// A row as an editor shows it.
#[derive(Debug)]
struct Item {
    range: Range,
    hover: String,
    diagnostic: Option<Value>,
    fixes: Vec<Fix>,
}

/// A repair as edits of the text.
#[derive(Debug)]
struct Fix {
    title: String,
    edits: Vec<(Range, String)>,
}

/// The view of one version of a text.
#[derive(Debug, Default)]
pub struct Analysis {
    items: Vec<Item>,
    /// Diagnostics of what is no formula.
    faults: Vec<Value>,
}

/// A sheet or document that is read, with the keys of its claims.
pub struct Read {
    sheet: Result<(Sheet, Keys), Fault>,
    faults: Vec<Fault>,
}

impl Read {
    /// Reads a text as the file at a path; `None` if that is no file of formulas.
    ///
    /// # Errors
    /// A notebook that is none.
    pub fn new(path: &Path, text: &str, symbols: &Symbols, options: &prove::Options) -> Result<Option<Self>, Failure> {
        let source = Source::InPlaceOf(PathBuf::from(path));
        let document = match Form::of_path(path) {
            // an editor shows the cells of a notebook as documents of their own
            Some(Form::Notebook) => return Ok(None),
            Some(form) => {
                source.of_length(text, form.most())?;
                of_text(&source, text)?
            }
            None => None,
        };
        let is_sheet = path.extension().is_some_and(|ending| ending == "toml") && text.contains("[[equation]]");
        let (sheet, faults) = match &document {
            // a document without formulas is none that is audited
            Some(document) => (document.sheet(symbols), document.faults.clone()),
            None if is_sheet => (Sheet::read(source.of_length(text, TOML_AT_MOST)?, symbols), Vec::new()),
            None => return Ok(None),
        };
        let sheet = sheet.map(|sheet| {
            let keys = Keys::new(&sheet, options);
            (sheet, keys)
        });
        Ok(Some(Self { sheet, faults }))
    }

    /// Decides the claims. Returns what is shown of them, how many were decided anew, and whether repairs are
    /// still to be found.
    pub fn decide(
        &self,
        text: &str,
        memory: &Memory,
        options: &prove::Options,
        repair: bool,
    ) -> (Analysis, usize, bool) {
        let lines = Lines::new(text);
        let mut analysis = Analysis {
            items: Vec::new(),
            faults: self.faults.iter().filter_map(|fault| of_fault(fault, &lines)).collect(),
        };
        let decided = match &self.sheet {
            Err(fault) => Err(fault.clone()),
            Ok((sheet, keys)) => memory
                .decide(sheet, keys, options, repair)
                .map(|decided| (sheet, decided)),
        };
        match decided {
            Err(fault) => {
                // a document in which nothing is to be decided has no place for it
                analysis.faults.extend(of_fault(&fault, &lines));
                (analysis, 0, false)
            }
            Ok((sheet, decided)) => {
                // rows of files that are included belong to these
                let rows = decided.rows.iter().filter(|row| row.decision.file.is_none());
                analysis.items = rows.filter_map(|row| item(sheet, row, text, &lines)).collect();
                (analysis, decided.anew, decided.lacks_repairs)
            }
        }
    }
}

fn of_fault(fault: &Fault, lines: &Lines) -> Option<Value> {
    let place = fault.place.filter(|_| fault.file.is_none())?;
    let range = Range {
        start: lines.position(place),
        end: lines.end(place.0),
    };
    Some(diagnostic(range, 1, "input", &fault.message))
}

fn diagnostic(range: Range, severity: u8, code: &str, message: &str) -> Value {
    json!({ "range": range.json(), "severity": severity, "code": code, "source": SOURCE, "message": message })
}

fn item(sheet: &Sheet, row: &Row, text: &str, lines: &Lines) -> Option<Item> {
    let (entry, decision) = (sheet.entries.get(row.position)?, &row.decision);
    let (source, start) = (&entry.tex, entry.tex.place());
    let formula = Range {
        start: lines.position(start),
        end: match source.place_of(source.tex.trim_end().len()) {
            Some(end) => lines.position(end),
            None => lines.end(start.0),
        },
    };
    // what cannot be read has a place of its own in the formula
    let range = match decision.place.filter(|place| *place != start) {
        Some(place) if lines.position(place) < formula.end => Range {
            start: lines.position(place),
            ..formula
        },
        _ => formula,
    };
    let reason = row.reason();
    let mut said = vec![format!("({}) {}: {reason}", decision.label, decision.verdict)];
    let mut say = |what: &str, text: String| {
        if !text.is_empty() {
            said.push(format!("{what}: {text}"));
        }
    };
    say(
        "counterexample",
        decision
            .counterexample
            .as_ref()
            .map(ToString::to_string)
            .unwrap_or_default(),
    );
    say("provided", decision.provided.join("; "));
    say("read as", decision.readings.join("; "));
    say("reductions", decision.reductions());
    let digits = row.evidence.as_ref().and_then(|evidence| evidence.digits);
    say(
        "digits",
        digits
            .map(|digits| format!("{:.1}", digits.max(0.0)))
            .unwrap_or_default(),
    );
    // the counterexample stands behind the reason
    let shown = 1 + usize::from(decision.counterexample.is_some());
    let message = said.get(..shown).unwrap_or_default().join("\n");
    let fixes = row.repairs().iter().filter_map(|repair| {
        let edits = replacements(sheet, row.position, repair, text)?
            .into_iter()
            .map(|edit| {
                let range = Range {
                    start: lines.position(edit.start),
                    end: lines.position(edit.end),
                };
                (range, edit.new)
            });
        Some(Fix {
            title: format!("({}) {}: {repair}", decision.label, repair.words()),
            edits: edits.collect(),
        })
    });
    Some(Item {
        range: formula,
        hover: said.join("\n"),
        diagnostic: severity(row).map(|severity| diagnostic(range, severity, &decision.verdict.to_string(), &message)),
        fixes: fixes.collect(),
    })
}

/// Returns how serious a row is: 1 is an error, 2 a warning, 3 information; nothing of a row that is as expected.
fn severity(row: &Row) -> Option<u8> {
    let is_against = row.evidence.as_ref().is_some_and(|evidence| evidence.against.is_some());
    if is_against {
        return Some(1);
    }
    // a document without comments expects nothing
    let is_said = row.decision.standing == Standing::Said;
    match row.decision.verdict {
        Verdict::Suspect => Some(2),
        _ if row.is_expected() => None,
        Verdict::Refuted | Verdict::Unread if is_said => Some(1),
        Verdict::Conditional => Some(3),
        _ => Some(2),
    }
}

impl Analysis {
    /// Returns the diagnostics.
    pub fn diagnostics(&self) -> Vec<Value> {
        let own = self.items.iter().filter_map(|item| item.diagnostic.clone());
        self.faults.iter().cloned().chain(own).collect()
    }

    /// Returns what a hover at a position shows: the rows of the smallest formula there.
    pub fn hover(&self, at: Position) -> Value {
        let here = Range { start: at, end: at };
        let met = || self.items.iter().filter(|item| item.range.meets(here));
        let size = |range: &Range| (range.end.0 - range.start.0, range.end.1.saturating_sub(range.start.1));
        let Some(range) = met().map(|item| item.range).min_by_key(size) else {
            return Value::Null;
        };
        let rows = met().filter(|item| item.range == range).map(|item| item.hover.as_str());
        let text = rows.collect::<Vec<_>>().join("\n\n");
        json!({ "contents": { "kind": "plaintext", "value": text }, "range": range.json() })
    }

    /// Returns the repairs of formulas in a range, as quick fixes of a version of a document.
    pub fn actions(&self, within: Range, uri: &str, version: i64, has_versions: bool) -> Value {
        let met = self.items.iter().filter(|item| item.range.meets(within));
        let actions = met.flat_map(|item| {
            item.fixes.iter().enumerate().map(|(place, fix)| {
                let edit = |(range, new): &(Range, String)| json!({ "range": range.json(), "newText": new });
                let edits: Vec<Value> = fix.edits.iter().map(edit).collect();
                let edit = match has_versions {
                    true => json!({ "documentChanges": [
                        { "textDocument": { "uri": uri, "version": version }, "edits": edits },
                    ] }),
                    false => json!({ "changes": { uri: edits } }),
                };
                json!({
                    "title": fix.title,
                    "kind": "quickfix",
                    "diagnostics": item.diagnostic.iter().collect::<Vec<_>>(),
                    "isPreferred": place == 0,
                    "edit": edit,
                })
            })
        });
        actions.collect()
    }
}
