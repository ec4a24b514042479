//! Documents as `audit` reads them: the files that they include, the numbers that they print.

use super::audit_table::Unusable;
use super::files::Files;
use super::source::{DOCUMENT_AT_MOST, NOTEBOOK_AT_MOST};
use super::{Failure, Options, Source, golden, note, notebook};
use crate::claim::{Document, Fault, Markup, PrintedNumber};
use crate::reference::{self, Directory, Outcome, PRINTED_COLUMNS, Printed};
use std::path::Path;

/// The document in a file whose name says that it is one, and its text.
///
/// # Errors
/// A file that cannot be read.
pub fn read(source: &Source) -> Result<Option<(Document, String)>, Failure> {
    let Some(form) = Form::of(source) else {
        return Ok(None);
    };
    let text = source.read_document(form.most())?;
    Ok(of_text(source, &text)?.map(|document| (document, text)))
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

/// The format of a document, as the ending of its name says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// LaTeX.
    Tex,
    /// Markdown, also that of Quarto and R.
    Markdown,
    /// A Jupyter notebook, of which the Markdown cells are read.
    Notebook,
}

impl Form {
    /// Returns the format of the document in a file; `None` where its name is that of no document.
    pub fn of(source: &Source) -> Option<Self> {
        Self::of_path(source.path()?)
    }

    /// Returns the format of the document at a path; `None` where its name is that of no document.
    pub fn of_path(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "tex" | "ltx" => Some(Self::Tex),
            "md" | "markdown" | "qmd" | "rmd" => Some(Self::Markdown),
            "ipynb" => Some(Self::Notebook),
            _ => None,
        }
    }

    /// The longest that is read, in MB.
    pub fn most(self) -> u64 {
        match self {
            Self::Tex | Self::Markdown => DOCUMENT_AT_MOST,
            Self::Notebook => NOTEBOOK_AT_MOST,
        }
    }
}

/// Returns the document that a text is in the place of a file, if the name is that of a document.
///
/// # Errors
/// A notebook that is none.
pub fn of_text(source: &Source, text: &str) -> Result<Option<Document>, Failure> {
    let (Some(form), Some(path)) = (Form::of(source), source.path()) else {
        return Ok(None);
    };
    let read = |text: &str, markup| with_files(text, markup, &Files::around(path, text));
    Ok(Some(match form {
        Form::Tex => read(text, Markup::Tex),
        Form::Markdown => read(text, Markup::Markdown),
        Form::Notebook => {
            let cells = notebook::markdown(text).map_err(|problem| Failure::Notebook(source.name(), problem))?;
            read(&cells, Markup::Markdown)
        }
    }))
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
    match (source.path(), included) {
        (Some(path), Some(name)) => path.with_file_name(name).display().to_string(),
        _ => source.name(),
    }
}

/// Checks the printed numbers. One that makes no sense is told, and stops no other.
pub fn numbers(document: &Document, source: &Source, options: &Options) -> (Vec<Outcome>, Vec<Unusable>) {
    let Some(path) = source.path() else {
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
