//! `vibro-audit audit [SHEET] [--explain LABEL] [--effort N] [--template]`.

use super::decide::{decide, decide_sheet};
use super::mended::{self, Comment};
use super::source::{ANSWERS_AT_MOST, DOCUMENT_AT_MOST, TOML_AT_MOST};
use super::verdicts::{Audited, Row, compare, exit, explained};
use super::{Answer, Content, Exit, Failure, Options, Source, document};
use crate::claim::{self, Fault, Sheet};
use crate::prove;
use crate::report::{Baseline, NewDirectory, OutputError};
use crate::stop::Token;
use rayon::prelude::*;
use std::path::Path;

/// Decide for each formula of a sheet whether it follows from its premises
#[derive(Debug, clap::Args)]
#[command(after_long_help = PROMISES)]
pub struct Arguments {
    /// The sheet, a TOML file or `-` for stdin; or a document, `.tex` or `.md`; without it, the paper's own appendix
    #[arg(value_name = "SHEET")]
    sheet: Option<Source>,
    /// Print the proof or the counterexample of this equation alone
    #[arg(long, value_name = "LABEL")]
    explain: Option<String>,
    /// How far to search for proofs and counterexamples, as a multiple of the usual limit in steps
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=MOST_EFFORT))]
    effort: u64,
    /// Look for the smallest edits that make a refuted formula true: the column `repair`
    #[arg(long, conflicts_with = "explain")]
    repair: bool,
    /// Write the sheet or document to this file, with the first repair of each refuted formula as a comment before it
    #[arg(long, value_name = "FILE", conflicts_with = "explain")]
    repair_into: Option<std::path::PathBuf>,
    /// Write each proof and each counterexample into this new directory, as a Python script that checks itself with
    /// SymPy and mpmath
    #[arg(long, value_name = "DIR", conflicts_with = "explain")]
    proof: Option<std::path::PathBuf>,
    /// Findings of an earlier run do not fail: what `audit` wrote as sarif, json or csv. A finding is known by its label,
    /// verdict and formula, wherever that stands now
    #[arg(long, value_name = "FILE", conflicts_with = "explain")]
    baseline: Option<Source>,
    /// Print a sheet to start from, with every key explained
    #[arg(long, conflicts_with_all = ["sheet", "explain", "effort", "proof", "repair", "repair_into"])]
    template: bool,
    /// Print the sheet that a document is taken for, what is guessed of it included
    #[arg(long, requires = "sheet", conflicts_with_all = ["explain", "effort", "proof", "repair", "repair_into"])]
    draft: bool,
}

/// The largest `--effort`.
const MOST_EFFORT: u64 = 1_000_000;

/// What the verdicts promise.
const PROMISES: &str = "\
A claim is true when both sides agree for all values of its symbols for which its premises and
assumptions hold and everything written in premises and claim is defined. Symbols are real unless
[symbols] says otherwise.
  proved     A proof was accepted by a kernel that uses nothing of the search, and so was a
             point at which the premises hold. The column `provided` lists what it excludes;
             `reductions` the rules that made goals for the kernel of the claim: these are trusted.
  refuted    Exact values of the symbols were accepted at which every premise holds and the two
             sides differ, or the claim is nowhere defined.
  undecided  Neither was found within the limit, which --effort raises. It is never a pass.
  unread     The formula, or a name in it, cannot be read: `place` and `reason` say where and why.
Exit status: 0 all as expected; 1 a verdict is not, or evidence speaks against one; 2 unread.";

/// A sheet to start from.
const TEMPLATE: &str = include_str!("../../golden/template.toml");

/// Runs the command.
pub fn run(arguments: &Arguments, global: &Options) -> Result<Answer, Failure> {
    if arguments.template {
        return Ok(Answer {
            content: Content::Text(TEMPLATE.to_string()),
            exit: Exit::AsExpected,
        });
    }
    let name = arguments
        .sheet
        .as_ref()
        .map_or("the paper's equations".to_string(), |source| source.name().to_string());
    let in_sheet = |fault: Fault| Failure::Sheet {
        name: name.clone(),
        fault: Box::new(fault),
    };
    let vocabulary = claim::vocabulary().map_err(in_sheet)?;
    let document = arguments.sheet.as_ref().map(document::read).transpose()?.flatten();
    if arguments.draft {
        let document = document.ok_or_else(|| Failure::NoDocument(name.clone()))?;
        document::tell(&document, &name);
        return Ok(Answer {
            content: Content::Text(document.draft(&name)),
            exit: document::exit(&document, Exit::AsExpected),
        });
    }
    let text = match (&document, &arguments.sheet) {
        (None, Some(source)) => source.read(TOML_AT_MOST)?,
        (Some(_), Some(source)) if arguments.repair_into.is_some() => source.read(DOCUMENT_AT_MOST)?,
        (None, None) => claim::EQUATIONS.to_owned(),
        (Some(_), _) => String::new(),
    };
    let mended = global.beside(arguments.repair_into.as_ref())?;
    let sheet = match (&document, &arguments.sheet) {
        (Some(document), _) => {
            document::tell(document, &name);
            document.sheet(&vocabulary)
        }
        (None, _) => Sheet::read(&text, &vocabulary),
    };
    let sheet = sheet.map_err(in_sheet)?;
    let options = prove::Options {
        effort: arguments.effort,
    };
    if let Some(directory) = &arguments.proof {
        write_proofs(&sheet, directory, &options)?;
    }
    match &arguments.explain {
        Some(label) => explain(&sheet, label, &options).map_err(in_sheet),
        None => {
            let baseline = arguments.baseline.as_ref().map(known).transpose()?;
            let mut rows = decide_sheet(&sheet, &name, &options, arguments.repair || mended.is_some())?;
            if let Some(mended) = &mended {
                let text = with_repairs(&text, &name, &sheet, &rows);
                mended.write(|to| to.write_all(text.as_bytes()))?;
            }
            if let (Some(baseline), Some(source)) = (&baseline, &arguments.baseline) {
                tell_gone(&mut rows, &sheet, baseline, source)?;
            }
            let mut exit = exit(&rows);
            let mut numbers = Vec::new();
            if let (Some(document), Some(source)) = (&document, &arguments.sheet) {
                (numbers, exit) = document::numbers(exit, document, source, global);
            }
            let file = match &arguments.sheet {
                Some(Source::File(path)) => Some(path.as_path()),
                _ => None,
            };
            let audited = Audited {
                sheet: &sheet,
                name: &name,
                file,
                rows,
                numbers,
            };
            audited.answer(exit, &options, global)
        }
    }
}

/// The findings of an earlier run.
fn known(source: &Source) -> Result<Baseline, Failure> {
    let text = source.read(ANSWERS_AT_MOST)?;
    Baseline::read(&text).map_err(|problem| Failure::Baseline(source.name(), problem))
}

/// Marks what is known, and says what is known and gone.
fn tell_gone(rows: &mut [Row], sheet: &Sheet, baseline: &Baseline, source: &Source) -> Result<(), Failure> {
    let gone = compare(rows, sheet, baseline).map_err(|problem| Failure::Baseline(source.name(), problem))?;
    if !gone.is_empty() {
        let labels: Vec<String> = gone.iter().map(|label| format!("({label})")).collect();
        super::note(&format!(
            "{}: known there and not found any more: {}",
            source.name(),
            labels.join(", ")
        ));
    }
    Ok(())
}

/// Writes a script for each question that is decided into a new directory.
fn write_proofs(sheet: &Sheet, directory: &Path, options: &prove::Options) -> Result<(), Failure> {
    let rows = sheet.rows();
    let names = prove::file_names(sheet, &rows);
    let new = NewDirectory::create(directory)?;
    let token = Token::current();
    let write = |(position, name): (&usize, &String)| -> Result<usize, OutputError> {
        let scripts = token.during(|| prove::scripts(sheet, *position, options));
        for (number, script) in (1..).zip(&scripts) {
            let name = match number {
                1 => format!("{name}.py"),
                _ => format!("{name}-{number}.py"),
            };
            new.write(&name, script.as_bytes())?;
        }
        Ok(scripts.len())
    };
    let written: Result<Vec<usize>, OutputError> = rows.par_iter().zip(&names).map(write).collect();
    let count: usize = written?.into_iter().sum();
    new.finish()?;
    super::note(&format!(
        "{count} scripts in {}: run each with Python, SymPy and mpmath",
        directory.display()
    ));
    Ok(())
}

/// The text of the sheet or document with the first repair of each formula as a comment.
fn with_repairs(text: &str, name: &str, sheet: &Sheet, rows: &[Row]) -> String {
    let repaired = sheet.rows().into_iter().zip(rows);
    let said = repaired.filter_map(|(position, row)| mended::said(sheet, position, row.repairs.first()?));
    mended::with_comments(text, Comment::of(name), &said.collect::<Vec<_>>())
}

fn explain(sheet: &Sheet, label: &str, options: &prove::Options) -> Result<Answer, Fault> {
    let rows = sheet.rows();
    let Some(position) = sheet.find(label).filter(|position| rows.contains(position)) else {
        let entries = rows.iter().filter_map(|&n| sheet.entries.get(n));
        let known: Vec<&str> = entries.map(|entry| entry.label.as_str()).collect();
        return Err(Fault::new(format!(
            "no claim `{label}` (there are: {})",
            known.join(", ")
        )));
    };
    let mut row = decide(sheet, position, options, false)?;
    // Whether what it rests on is refuted takes the verdicts of all.
    let others = prove::audit(sheet, options);
    if let Some(decision) = others.into_iter().find(|other| other.label == row.decision.label) {
        row.decision = decision;
    }
    let text = explained(sheet, &row, options);
    Ok(Answer {
        content: Content::Text(text),
        exit: exit(&[row]),
    })
}
