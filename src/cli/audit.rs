//! `vibro-audit audit [SHEET] [--explain LABEL] [--effort N] [--template]`.

use super::source::TOML_AT_MOST;
use super::{Answer, Content, Exit, Failure, Options, Source, document};
use crate::claim::{self, Fault, Sheet, Verdict};
use crate::evidence::{Evidence, witness};
use crate::prove::{self, Decision, mention_refuted};
use crate::repair::{Repair, repairs};
use crate::report::{Cell, OutputError, OutputProblem, Table};
use crate::stop::Token;
use rayon::prelude::*;
use std::fs::OpenOptions;
use std::io::Write;
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
    #[arg(long)]
    repair: bool,
    /// Write each proof and each counterexample into this directory, as a Python script that checks itself with SymPy
    /// and mpmath
    #[arg(long, value_name = "DIR", conflicts_with = "explain")]
    proof: Option<std::path::PathBuf>,
    /// Print a sheet to start from, with every key explained
    #[arg(long, conflicts_with_all = ["sheet", "explain", "effort", "proof"])]
    template: bool,
    /// Print the sheet that a document is taken for, what is guessed of it included
    #[arg(long, requires = "sheet", conflicts_with_all = ["explain", "effort", "proof"])]
    draft: bool,
}

/// The largest `--effort`.
const MOST_EFFORT: u64 = 1_000_000;

/// What the verdicts promise.
const PROMISES: &str = "\
A claim is true when both sides agree for all values of its symbols for which its premises and
assumptions hold and everything written in premises and claim is defined. Symbols are real unless
[symbols] says otherwise.
  proved     A proof was accepted by a small kernel that uses nothing of the search, and so
             was a point at which the premises hold. The column `provided` lists what it excludes.
  refuted    Exact values of the symbols were accepted at which every premise holds and the two
             sides differ, or the claim is nowhere defined.
  undecided  Neither was found within the limit, which --effort raises. It is never a pass.
  unread     The formula, or a name in it, cannot be read: `place` and `reason` say where and why.
Exit status: 0 all as expected; 1 a verdict is not, or evidence speaks against one; 2 unread.";

/// A sheet to start from.
const TEMPLATE: &str = include_str!("../../golden/template.toml");

/// The columns that scripts rely on.
const COLUMNS: [&str; 9] = [
    "label",
    "verdict",
    "expected",
    "digits",
    "counterexample",
    "reason",
    "provided",
    "place",
    "repair",
];

/// Random points at which each claim is tried; fewer where one costs much.
const POINTS: usize = 24;

/// What is found of one claim.
struct Row {
    decision: Decision,
    /// Nothing where there is no claim to be tried.
    evidence: Option<Evidence>,
    /// What would make a refuted claim true, where that is asked for; the smallest first.
    repairs: Vec<Repair>,
}

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
    let sheet = match (&document, &arguments.sheet) {
        (Some(document), _) => {
            document::tell(document, &name);
            document.sheet(&vocabulary)
        }
        (None, Some(source)) => Sheet::read(&source.read(TOML_AT_MOST)?, &vocabulary),
        (None, None) => Sheet::read(claim::EQUATIONS, &vocabulary),
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
            let answer = decide_sheet(&sheet, &name, &options, arguments.repair)?;
            match (&document, &arguments.sheet) {
                (Some(document), Some(source)) => document::with_numbers(answer, document, source, global),
                _ => Ok(answer),
            }
        }
    }
}

/// Writes a script for each question that is decided, over nothing that is there already.
fn write_proofs(sheet: &Sheet, directory: &Path, options: &prove::Options) -> Result<(), Failure> {
    let rows = sheet.rows();
    let scripts: Vec<(String, String)> = rows
        .par_iter()
        .flat_map_iter(|&position| prove::scripts(sheet, position, options))
        .collect();
    super::run::create(directory)?;
    for (name, script) in &scripts {
        let path = directory.join(name);
        // nothing that is there is written over
        let opened = OpenOptions::new().write(true).create_new(true).open(&path);
        let written = opened.and_then(|mut file| file.write_all(script.as_bytes()));
        written.map_err(|source| OutputError {
            place: path.display().to_string(),
            problem: OutputProblem::System {
                doing: "writing a new file",
                source,
            },
        })?;
    }
    super::note(&format!(
        "{} scripts in {}: run each with Python, SymPy and mpmath",
        scripts.len(),
        directory.display()
    ));
    Ok(())
}

/// The table of the sheet with this text, which errors call `name`.
pub(super) fn verdicts(text: &str, name: &str) -> Result<Answer, Failure> {
    let in_sheet = |fault: Fault| Failure::Sheet {
        name: name.to_owned(),
        fault: Box::new(fault),
    };
    let vocabulary = claim::vocabulary().map_err(in_sheet)?;
    let sheet = Sheet::read(text, &vocabulary).map_err(in_sheet)?;
    decide_sheet(&sheet, name, &prove::Options::default(), false)
}

fn decide_sheet(sheet: &Sheet, name: &str, options: &prove::Options, repair: bool) -> Result<Answer, Failure> {
    let mut rows = decide_all(sheet, options, repair).map_err(|fault| Failure::Sheet {
        name: name.to_owned(),
        fault: Box::new(fault),
    })?;
    mention_refuted(sheet, rows.iter_mut().map(|row| &mut row.decision));
    let unread = sheet.entries.iter().filter(|entry| entry.expect != Verdict::Unread);
    for fault in unread.filter_map(|entry| entry.unread.as_ref()) {
        super::note(&format!("{name}: {fault}"));
    }
    Ok(Answer {
        exit: exit(&rows),
        content: Content::Table(table(&rows)?),
    })
}

/// Decides each claim, looks for witnesses and, where asked, for repairs, on all cores; in the order of the sheet.
fn decide_all(sheet: &Sheet, options: &prove::Options, repair: bool) -> Result<Vec<Row>, Fault> {
    let rows = sheet.rows();
    let token = Token::current();
    rows.par_iter()
        .map(|&position| token.during(|| decide(sheet, position, options, repair)))
        .collect()
}

fn decide(sheet: &Sheet, position: usize, options: &prove::Options, repair: bool) -> Result<Row, Fault> {
    let decision = prove::decide(sheet, position, options);
    let read = decision.verdict != Verdict::Unread && sheet.unread_below(position).is_empty();
    let evidence = read
        .then(|| witness(sheet, position, decision.verdict, POINTS))
        .transpose()?;
    let repairs = match decision.verdict {
        Verdict::Refuted if repair => repairs(sheet, position, options),
        _ => Vec::new(),
    };
    Ok(Row {
        decision,
        evidence,
        repairs,
    })
}

/// 2 where something cannot be read that was expected to be, 1 where a verdict is not as expected or evidence speaks
/// against it.
fn exit(rows: &[Row]) -> Exit {
    let unread = |row: &Row| row.decision.verdict == Verdict::Unread && !row.decision.is_expected();
    let as_expected = |row: &Row| {
        let speaks_for = |evidence: &Evidence| evidence.against.is_none();
        row.decision.is_expected() && row.evidence.as_ref().is_none_or(speaks_for)
    };
    if rows.iter().any(unread) {
        Exit::Unusable
    } else {
        Exit::from_verdict(rows.iter().all(as_expected))
    }
}

fn table(rows: &[Row]) -> Result<Table, Failure> {
    let mut table = Table::new(COLUMNS);
    for row in rows {
        let (decision, evidence) = (&row.decision, &row.evidence);
        let mut reason = decision.reason.clone();
        if let Some(repair) = row.repairs.first() {
            reason = format!("{reason}; {}", repair.words());
        }
        if let Some(evidence) = evidence {
            if let Some(against) = &evidence.against {
                reason = format!("EVIDENCE AGAINST THE VERDICT: {against}; {reason}");
            }
            // How the maps flown agree is for `--explain`: a table is read for what is amiss.
            let flown = evidence.flown.as_ref().map(ToString::to_string);
            for note in evidence.notes.iter().filter(|note| Some(*note) != flown.as_ref()) {
                reason = format!("{reason}; {note}");
            }
        }
        let digits = evidence.as_ref().and_then(|evidence| evidence.digits);
        let file = decision.file.as_ref().map_or(String::new(), |file| format!("{file}:"));
        let place = decision.place.map(|(line, column)| format!("{file}{line}:{column}"));
        table.push(vec![
            Cell::from(decision.label.clone()),
            Cell::from(decision.verdict.to_string()),
            Cell::from(decision.expected.to_string()),
            Cell::from(digits.map(|digits| (digits * 10.0).round().max(0.0) / 10.0)),
            Cell::from(decision.counterexample.as_ref().map(ToString::to_string)),
            Cell::from(reason),
            Cell::from((!decision.provided.is_empty()).then(|| decision.provided.join("; "))),
            Cell::from(place),
            Cell::from((!row.repairs.is_empty()).then(|| shown(&row.repairs))),
        ])?;
    }
    Ok(table)
}

/// Repairs as the column has them.
fn shown(repairs: &[Repair]) -> String {
    let shown: Vec<String> = repairs.iter().map(ToString::to_string).collect();
    shown.join(" ;; ")
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
    if let Some(decision) = others.into_iter().find(|other| other.label == label) {
        row.decision = decision;
    }
    let mut text = prove::explain(sheet, position, &row.decision, options);
    if let Some(fault) = sheet.entries.get(position).and_then(|entry| entry.unread.as_ref()) {
        text.push_str(&format!("{fault}\n"));
    }
    if let Some(evidence) = &row.evidence {
        text.push_str(&in_words(evidence));
    }
    Ok(Answer {
        content: Content::Text(text),
        exit: exit(&[row]),
    })
}

/// The evidence in words.
fn in_words(evidence: &Evidence) -> String {
    let mut lines = vec!["\nevidence, which shares no code with the above".to_string()];
    match (evidence.digits, evidence.median) {
        (Some(digits), Some(median)) => lines.push(format!(
            "left and right agree to {digits:.1} digits at the worst of {} random points of the premises in f64, to {median:.1} at half of them",
            evidence.points
        )),
        _ if evidence.points > 0 => lines.push(format!("the inequality was tried at {} random points", evidence.points)),
        _ => lines.push("no point".to_string()),
    }
    lines.extend((!evidence.worst.is_empty()).then(|| format!("worst point: {}", evidence.worst)));
    lines.extend(evidence.notes.iter().cloned());
    lines.extend(
        evidence
            .against
            .as_ref()
            .map(|against| format!("AGAINST THE VERDICT: {against}")),
    );
    lines.join("\n  ")
}
