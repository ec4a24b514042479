//! `vibro-audit audit [SHEET ...] [--explain LABEL] [--effort N] [--template]`.

use super::audit_table::{Audited, Row, Unusable, answer, compare, exit, explained};
use super::decide::{decide, decide_sheet};
use super::document::{self, Form};
use super::mended::{self, Comment};
use super::proofs::ProofForm;
use super::source::{ANSWERS_AT_MOST, DOCUMENT_AT_MOST, TOML_AT_MOST};
use super::{Answer, Content, Exit, Failure, Options, Source};
use crate::claim::{self, Document, Fault, Sheet};
use crate::prove;
use crate::reference::Outcome;
use crate::repair::Repair;
use crate::report::{Baseline, Format, NewDirectory};
use crate::tex::Symbols;

/// Decide for each formula whether it follows from its premises
#[derive(Debug, clap::Args)]
#[command(after_long_help = PROMISES)]
pub struct Arguments {
    /// Sheets (TOML), documents (.tex, .md, .qmd, .ipynb) or `-` for stdin [default: the paper's equations]
    #[arg(value_name = "SHEET")]
    sheets: Vec<Source>,
    /// Read stdin as if it were this file, which need not exist: its ending, and where what it includes lies
    #[arg(long, value_name = "FILE", requires = "sheets")]
    stdin_name: Option<std::path::PathBuf>,
    /// Print the proof or the counterexample of one equation
    #[arg(long, value_name = "LABEL")]
    explain: Option<String>,
    /// Search N times as far for proofs and counterexamples
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=MOST_EFFORT))]
    effort: u64,
    /// Find the smallest edits that make a refuted formula true (column `repair`)
    #[arg(long)]
    repair: bool,
    /// Write a copy of the input to FILE, with each first repair as a comment before its formula
    #[arg(long, value_name = "FILE", conflicts_with = "explain")]
    repair_into: Option<std::path::PathBuf>,
    /// Write each proof and counterexample into the new directory DIR, as data with a checker and a schema; with
    /// `--format sympy` as a script of at most 40 lines to be read, with `--format rocq` as a theorem for Rocq
    #[arg(long, value_name = "DIR", conflicts_with = "explain")]
    proof: Option<std::path::PathBuf>,
    /// Do not fail on findings of an earlier run, written by `audit` as sarif, json or csv
    #[arg(long, value_name = "FILE", conflicts_with = "explain")]
    baseline: Option<Source>,
    /// Print a sheet to start from, with every key explained
    #[arg(long, conflicts_with_all = ["sheets", "explain", "effort", "proof", "repair", "repair_into"])]
    template: bool,
    /// Convert a document into a sheet that can be edited, with every guess marked
    #[arg(long, requires = "sheets", conflicts_with_all = ["explain", "effort", "proof", "repair", "repair_into"])]
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
A document without comments has two more, and none is refuted or expected:
  given      A definition, or a law that does not follow from what stands before it.
  suspect    An equation, mostly a link of a chain, fails, and a small repair makes it provable. Exit 1.
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
    arguments.refuse_for_several(global)?;
    let form = ProofForm::of(global.format, arguments.proof.is_some())?;
    let sheets = arguments.sources()?;
    let symbols = claim::vocabulary().map_err(|fault| in_sheet(PAPER, fault))?;
    let options = prove::Options {
        effort: arguments.effort,
    };
    if let (Some(label), [] | [_]) = (&arguments.explain, sheets.as_slice()) {
        let read = Read::new(sheets.first(), &symbols)?;
        return explain(&read.sheet, label, &options, arguments.repair).map_err(|fault| in_sheet(&read.name, fault));
    }
    if let (true, [source]) = (arguments.draft, sheets.as_slice()) {
        let (document, _) = document::read(source)?.ok_or_else(|| Failure::NoDocument(source.name()))?;
        document::tell(&document, &source.name());
        return Ok(Answer {
            content: Content::Text(document.draft(&source.name())),
            exit: match document.faults.is_empty() {
                true => Exit::AsExpected,
                false => Exit::Unusable,
            },
        });
    }
    let baseline = arguments.baseline.as_ref().map(known).transpose()?;
    let (mut all, mut unusable, mut worst) = (Vec::new(), Vec::new(), Exit::AsExpected);
    // a report for machines says what cannot be read, and of several files the others are decided all the same
    let goes_on = sheets.len() > 1 || matches!(global.format, Format::Junit | Format::Sarif);
    let sources = match sheets.as_slice() {
        [] => vec![None],
        sheets => sheets.iter().map(Some).collect(),
    };
    for source in sources {
        match arguments.audited(source, &symbols, global, form) {
            Ok(audited) => all.push(audited),
            Err(failure) if goes_on => {
                super::say("error", &failure.to_string());
                unusable.push(Unusable::from(&failure));
                worst = Exit::Unusable;
            }
            Err(failure) => return Err(failure),
        }
    }
    if let (Some(baseline), Some(source)) = (&baseline, &arguments.baseline) {
        tell_gone(&mut all, baseline, source)?;
    }
    for (audited, document) in &mut all {
        let (exit, mut wrong) = check_numbers(audited, document.as_ref(), global);
        worst = worst.or_worse(exit);
        unusable.append(&mut wrong);
    }
    let all: Vec<Audited> = all.into_iter().map(|(audited, _)| audited).collect();
    answer(&all, &unusable, sheets.len() > 1, worst, &options, global)
}

/// Checks the numbers that a document prints. Returns the exit status of all that is decided, and what cannot be used.
fn check_numbers(audited: &mut Audited, document: Option<&Document>, global: &Options) -> (Exit, Vec<Unusable>) {
    let status = exit(&audited.rows);
    let (Some(document), Some(source)) = (document, &audited.source) else {
        return (status, Vec::new());
    };
    let (numbers, wrong) = document::numbers(document, source, global);
    let is_expected = numbers.iter().all(Outcome::is_expected);
    let wrong = [document::unusable(document, source), wrong].concat();
    let of_numbers = match wrong.is_empty() {
        true => Exit::from_verdict(is_expected),
        false => Exit::Unusable,
    };
    audited.numbers = numbers;
    (status.or_worse(of_numbers), wrong)
}

/// Decides all of the one sheet or document that is named, and checks the numbers that it prints.
///
/// # Errors
/// Input that cannot be used.
pub fn decided(arguments: &Arguments, global: &Options) -> Result<(Audited, Exit), Failure> {
    let form = ProofForm::of(global.format, false)?;
    let sources = arguments.sources()?;
    let symbols = claim::vocabulary().map_err(|fault| in_sheet(PAPER, fault))?;
    let (mut audited, document) = arguments.audited(sources.first(), &symbols, global, form)?;
    let (exit, _) = check_numbers(&mut audited, document.as_ref(), global);
    Ok((audited, exit))
}

/// How errors name the built-in sheet.
const PAPER: &str = "the paper's equations";

fn in_sheet(name: &str, fault: Fault) -> Failure {
    Failure::Sheet {
        name: name.to_owned(),
        fault: Box::new(fault),
    }
}

/// A sheet or document that is read.
struct Read {
    name: String,
    sheet: Sheet,
    document: Option<Document>,
    text: String,
}

impl Read {
    fn new(source: Option<&Source>, symbols: &Symbols) -> Result<Self, Failure> {
        let name = source.map_or(PAPER.to_owned(), Source::name);
        let (document, text) = match source {
            None => (None, claim::EQUATIONS.to_owned()),
            Some(source @ Source::Stdin) => {
                let text = source.read(DOCUMENT_AT_MOST)?;
                match document::of_stdin(&text) {
                    Some(document) => (Some(document), text),
                    None => (None, source.of_length(&text, TOML_AT_MOST)?.to_owned()),
                }
            }
            Some(source) => match document::read(source)? {
                Some((document, text)) => (Some(document), text),
                None => (None, source.read(TOML_AT_MOST)?),
            },
        };
        let sheet = match &document {
            Some(document) => {
                document::tell(document, &name);
                // where nothing is to be decided, what is wrong before says why
                let cause = |fault: Fault| document.faults.first().cloned().unwrap_or(fault);
                document.sheet(symbols).map_err(cause)
            }
            None => Sheet::read(&text, symbols),
        };
        let sheet = sheet.map_err(|fault| in_sheet(&name, fault))?;
        Ok(Self {
            name,
            sheet,
            document,
            text,
        })
    }
}

impl Arguments {
    /// The sources of the input; stdin has the name that is given for it.
    fn sources(&self) -> Result<Vec<Source>, Failure> {
        let Some(name) = &self.stdin_name else {
            return Ok(self.sheets.clone());
        };
        if !self.sheets.iter().any(Source::is_stdin) {
            return Err(Failure::Usage(
                "--stdin-name names `-`, which is not among the input".to_owned(),
            ));
        }
        let named = |source: &Source| match source {
            Source::Stdin => Source::InPlaceOf(name.clone()),
            source => source.clone(),
        };
        Ok(self.sheets.iter().map(named).collect())
    }

    /// Refuses what is of one file where several are named.
    fn refuse_for_several(&self, global: &Options) -> Result<(), Failure> {
        if self.sheets.len() < 2 {
            return Ok(());
        }
        if self.sheets.iter().filter(|source| source.is_stdin()).count() > 1 {
            return Err(Failure::Usage(
                "`-` is stdin, which is read once: name it once".to_owned(),
            ));
        }
        let given = [
            (self.explain.is_some(), "--explain"),
            (self.draft, "--draft"),
            (self.proof.is_some(), "--proof"),
            (self.repair_into.is_some(), "--repair-into"),
            (global.format == Format::Html, "--format html"),
        ];
        match given.iter().find(|(is_given, _)| *is_given) {
            Some((_, flag)) => Err(Failure::OfOneFile {
                flag,
                count: self.sheets.len(),
            }),
            None => Ok(()),
        }
    }

    /// Decides all of a file, or of the built-in sheet; numbers that a document prints are not looked at yet.
    fn audited(
        &self,
        source: Option<&Source>,
        symbols: &Symbols,
        global: &Options,
        form: ProofForm,
    ) -> Result<(Audited, Option<Document>), Failure> {
        let options = prove::Options { effort: self.effort };
        let mended = global.beside(self.repair_into.as_ref())?;
        let Read {
            name,
            sheet,
            document,
            text,
        } = Read::new(source, symbols)?;
        let proofs = self.proof.as_deref().map(NewDirectory::create).transpose()?;
        let rows = decide_sheet(&sheet, &name, &options, self.repair || mended.is_some())?;
        if let (Some(new), Some(directory)) = (proofs, &self.proof) {
            form.write(&sheet, &rows, new, directory, &options)?;
        }
        if let Some(mended) = &mended {
            let text = with_repairs(source, &name, &text, &sheet, symbols, &rows)?;
            mended.write(|to| to.write_all(text.as_bytes()))?;
        }
        let audited = Audited {
            sheet,
            name,
            source: source.cloned(),
            text,
            rows,
            numbers: Vec::new(),
        };
        Ok((audited, document))
    }
}

/// The findings of an earlier run.
fn known(source: &Source) -> Result<Baseline, Failure> {
    let text = source.read(ANSWERS_AT_MOST)?;
    Baseline::read(&text).map_err(|problem| Failure::Baseline(source.name(), problem))
}

/// Marks what is known, and says what is known and gone.
fn tell_gone(all: &mut [(Audited, Option<Document>)], baseline: &Baseline, source: &Source) -> Result<(), Failure> {
    let each = all.iter_mut().map(|(audited, _)| audited);
    let gone = compare(each, baseline).map_err(|problem| Failure::Baseline(source.name(), problem))?;
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

/// The text of the sheet or document with the first repair of each formula as a comment, which changes nothing that is read.
fn with_repairs(
    source: Option<&Source>,
    name: &str,
    text: &str,
    sheet: &Sheet,
    symbols: &Symbols,
    rows: &[Row],
) -> Result<String, Failure> {
    let is_document = source.and_then(Form::of).is_some();
    let read = |text: &str| -> Option<mended::Content> {
        match source.filter(|_| is_document) {
            Some(source) => {
                let sheet = document::of_text(source, text).ok()??.sheet(symbols).ok()?;
                let entries = sheet.entries.into_iter();
                // a label of its own is the line of the formula, which a comment before it changes
                Some(mended::Content::Document(entries.map(|entry| entry.tex.tex).collect()))
            }
            None => text.parse().ok().map(mended::Content::Sheet),
        }
    };
    let repaired = sheet.rows().into_iter().zip(rows);
    let comment = Comment::of(name);
    let said = repaired.filter_map(|(position, row)| mended::said(sheet, position, row.repairs().first()?, comment));
    let said: Vec<mended::Said> = said.collect();
    mended::with_comments(text, comment, said, &read).map_err(|label| Failure::NoPlace {
        name: name.to_owned(),
        label,
    })
}

fn explain(sheet: &Sheet, label: &str, options: &prove::Options, repair: bool) -> Result<Answer, Fault> {
    let rows = sheet.rows();
    // (16) is how a paper prints the label
    let bare = || label.strip_prefix('(')?.strip_suffix(')');
    let found = sheet.find(label).or_else(|| sheet.find(bare()?));
    let Some(position) = found.filter(|position| rows.contains(position)) else {
        let entries = rows.iter().filter_map(|&n| sheet.entries.get(n));
        let known: Vec<&str> = entries.map(|entry| entry.label.as_str()).collect();
        return Err(Fault::new(format!(
            "no claim `{label}` (there are: {})",
            known.join(", ")
        )));
    };
    let mut row = decide(sheet, position, options, repair)?;
    // Whether what it rests on is refuted takes the verdicts of all.
    let others = prove::audit(sheet, options);
    if let Some(decision) = others.into_iter().find(|other| other.label == row.decision.label) {
        row.decision = decision;
    }
    let mut text = explained(sheet, &row, options);
    if let Some(repairs) = &row.repairs {
        let one = |repair: &Repair| format!("  {}\n    {repair}\n", repair.words().replace("; ", "\n  "));
        let all: String = repairs.found.iter().map(one).collect();
        let none = repairs.none().map(|none| format!("  {none}\n"));
        text.say(&format!("\nrepairs, each proved\n{all}{}", none.unwrap_or_default()));
    }
    Ok(Answer {
        content: Content::Text(text.to_string()),
        exit: exit(&[row]),
    })
}
