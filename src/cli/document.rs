//! Documents as `audit` reads them: the files that they include, the numbers that they print.

use super::files::Files;
use super::source::DOCUMENT_AT_MOST;
use super::verdicts::Unusable;
use super::{Failure, Options, Source, golden, note};
use crate::claim::{Document, Fault, Markup, PrintedNumber};
use crate::reference::{self, Directory, Outcome, PRINTED_COLUMNS, Printed};
use std::path::Path;

/// The document in a file whose name says that it is one.
///
/// # Errors
/// A file that cannot be read.
pub fn read(source: &Source) -> Result<Option<Document>, Failure> {
    if markup(source).is_none() {
        return Ok(None);
    }
    let text = source.read_document(DOCUMENT_AT_MOST)?;
    Ok(of_text(source, &text))
}

/// Returns the document that stdin has, if it looks like TeX or Markdown and not like a sheet.
pub fn of_stdin(text: &str) -> Option<Document> {
    let is_sheet = text
        .lines()
        .any(|line| matches!(line.trim(), "[[equation]]" | "[symbols]"));
    let markup = match text.trim_start().chars().next() {
        _ if is_sheet => return None,
        Some('\\' | '%') => Markup::Tex,
        _ if text.contains("\\begin{document}") || text.contains("\\begin{equation}") => Markup::Tex,
        _ if text.contains("$$") => Markup::Markdown,
        _ => return None,
    };
    Some(with_files(text, markup, &Files::around(Path::new("./stdin"), text)))
}

/// Returns how the document in a file is written; `None` where its name is that of no document.
pub fn markup(source: &Source) -> Option<Markup> {
    let Source::File(path) = source else {
        return None;
    };
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("tex" | "ltx") => Some(Markup::Tex),
        Some("md" | "markdown") => Some(Markup::Markdown),
        _ => None,
    }
}

/// Returns the document that a text is in the place of a file.
pub fn of_text(source: &Source, text: &str) -> Option<Document> {
    let (markup, Source::File(path)) = (markup(source)?, source) else {
        return None;
    };
    Some(with_files(text, markup, &Files::around(path, text)))
}

fn with_files(text: &str, markup: Markup, files: &Files) -> Document {
    Document::read_below(text, &files.preamble(text), markup, &mut |name| files.included(name))
}

/// Says what is wrong with a document and what was guessed of it.
pub fn tell(document: &Document, name: &str) {
    for fault in &document.faults {
        note(&format!("{name}: {fault}"));
    }
    for guess in &document.guesses {
        note(&format!("{name}: {guess}"));
    }
}

/// Returns the faults of a document, for reports.
pub fn unusable(document: &Document, source: &Source) -> Vec<Unusable> {
    let of = |fault: &Fault| Unusable {
        file: Some(file_of(source, fault.file.as_deref())),
        place: fault.place,
        message: fault.message.clone(),
    };
    document.faults.iter().map(of).collect()
}

/// The path of a file that a document includes, or of the document.
fn file_of(source: &Source, included: Option<&str>) -> String {
    match (source, included) {
        (Source::File(path), Some(name)) => path.with_file_name(name).display().to_string(),
        _ => source.name(),
    }
}

/// Checks the printed numbers. One that makes no sense is told, and stops no other.
pub fn numbers(document: &Document, source: &Source, options: &Options) -> (Vec<Outcome>, Vec<Unusable>) {
    let Source::File(path) = source else {
        return (Vec::new(), Vec::new());
    };
    let directory = Directory::At(super::files::directory(path));
    let (mut outcomes, mut unusable) = (Vec::new(), Vec::new());
    for (place, number) in document.numbers.iter().enumerate() {
        match outcome(&row(place, number), &source.name(), &directory, options) {
            Ok(found) => outcomes.extend(found),
            Err(problem) => {
                let (line, column) = number.place;
                let file = file_of(source, number.file.as_deref());
                note(&format!("{file}: line {line}, column {column}: {problem}"));
                unusable.push(Unusable {
                    file: Some(file),
                    place: Some(number.place),
                    message: problem,
                });
            }
        }
    }
    (outcomes, unusable)
}

/// What a row of golden values comes to.
fn outcome(row: &[String], name: &str, directory: &Directory, options: &Options) -> Result<Vec<Outcome>, String> {
    let text = Printed::with_row("", row).map_err(|fault| fault.to_string())?;
    let printed = Printed::read(name, &text).map_err(|fault| fault.message().to_owned())?;
    let mut compute = |request: &_| golden::answer(directory, request, options).map_err(|failure| failure.to_string());
    let (outcomes, faults) = reference::check(&printed, &[], &mut compute, &mut || ());
    faults
        .first()
        .map_or(Ok(outcomes), |fault| Err(fault.message().to_owned()))
}

/// The row of golden values that a printed number is.
fn row(place: usize, number: &PrintedNumber) -> Vec<String> {
    let (line, column) = number.place;
    let file = number.file.as_ref().map_or(String::new(), |file| format!("{file}:"));
    let field = |name: &str| match name {
        "id" => format!("number-{}", place + 1),
        "place" => format!("{file}{line}:{column}"),
        "scene" => number.scene.clone(),
        "set" => number.set.join(";"),
        "quantity" => number.quantity.clone(),
        "printed" => number.printed.clone(),
        "expected" => "reproduced".to_owned(),
        _ => String::new(),
    };
    PRINTED_COLUMNS.iter().map(|name| field(name)).collect()
}
