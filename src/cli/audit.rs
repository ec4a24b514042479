//! `vibro-audit audit [SHEET] [--explain LABEL]`.

use super::{Answer, Content, Exit, Failure, Options, Source};
use crate::claim::{self, Fault, Sheet};
use crate::evidence::{Evidence, witness};
use crate::prove::{self, Decision, mention_refuted};
use crate::report::{Cell, Table};
use rayon::prelude::*;

/// Decide for each formula of a sheet whether it follows from its premises
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The sheet, a TOML file or `-` for stdin; without it, the paper's own appendix
    #[arg(value_name = "SHEET")]
    sheet: Option<Source>,
    /// Print the proof or the counterexample of this equation alone
    #[arg(long, value_name = "LABEL")]
    explain: Option<String>,
}

/// The columns that scripts rely on.
const COLUMNS: [&str; 6] = ["label", "verdict", "expected", "digits", "counterexample", "reason"];

/// Random points at which each claim is tried.
const POINTS: usize = 6;

/// Runs the command.
pub fn run(arguments: &Arguments, _options: &Options) -> Result<Answer, Failure> {
    let name = arguments
        .sheet
        .as_ref()
        .map_or("the paper's equations".to_string(), |source| source.name().to_string());
    let in_sheet = |fault: Fault| Failure::Sheet {
        name: name.clone(),
        fault,
    };
    let vocabulary = claim::vocabulary().map_err(in_sheet)?;
    let text = match &arguments.sheet {
        Some(source) => source.read()?,
        None => claim::EQUATIONS.to_string(),
    };
    let sheet = Sheet::read(&text, &vocabulary).map_err(in_sheet)?;
    match &arguments.explain {
        Some(label) => explain(&sheet, label).map_err(in_sheet),
        None => decide_sheet(&sheet, &name),
    }
}

/// The table of the sheet with this text, which errors call `name`.
pub(super) fn verdicts(text: &str, name: &str) -> Result<Answer, Failure> {
    let in_sheet = |fault: Fault| Failure::Sheet {
        name: name.to_owned(),
        fault,
    };
    let vocabulary = claim::vocabulary().map_err(in_sheet)?;
    let sheet = Sheet::read(text, &vocabulary).map_err(in_sheet)?;
    decide_sheet(&sheet, name)
}

fn decide_sheet(sheet: &Sheet, name: &str) -> Result<Answer, Failure> {
    let mut decided = decide_all(sheet).map_err(|fault| Failure::Sheet {
        name: name.to_owned(),
        fault,
    })?;
    mention_refuted(sheet, decided.iter_mut().map(|(decision, _)| decision));
    table(&decided)
}

/// Decides each claim and looks for witnesses, on all cores; in the order of the sheet.
fn decide_all(sheet: &Sheet) -> Result<Vec<(Decision, Evidence)>, Fault> {
    let claims: Vec<usize> = (0..sheet.entries.len()).filter(|&n| sheet.is_claim(n)).collect();
    claims.par_iter().map(|&position| decide(sheet, position)).collect()
}

fn decide(sheet: &Sheet, position: usize) -> Result<(Decision, Evidence), Fault> {
    let decision = prove::decide(sheet, position, &prove::Options::default());
    let evidence = witness(sheet, position, decision.verdict, POINTS)?;
    Ok((decision, evidence))
}

fn table(decided: &[(Decision, Evidence)]) -> Result<Answer, Failure> {
    let mut table = Table::new(COLUMNS);
    let mut as_expected = true;
    for (decision, evidence) in decided {
        let mut reason = decision.reason.clone();
        if let Some(against) = &evidence.against {
            reason = format!("EVIDENCE AGAINST THE VERDICT: {against}; {reason}");
        }
        // How the maps flown agree is for `--explain`: a table is read for what is amiss.
        let flown = evidence.flown.as_ref().map(ToString::to_string);
        for note in evidence.notes.iter().filter(|note| Some(*note) != flown.as_ref()) {
            reason = format!("{reason}; {note}");
        }
        as_expected &= decision.is_expected() && evidence.against.is_none();
        table.push(vec![
            Cell::from(decision.label.clone()),
            Cell::from(decision.verdict.to_string()),
            Cell::from(decision.expected.to_string()),
            Cell::from(evidence.digits.map(|digits| (digits * 10.0).round().max(0.0) / 10.0)),
            Cell::from(decision.counterexample.as_ref().map(ToString::to_string)),
            Cell::from(reason),
        ])?;
    }
    Ok(Answer {
        content: Content::Table(table),
        exit: Exit::from_verdict(as_expected),
    })
}

fn explain(sheet: &Sheet, label: &str) -> Result<Answer, Fault> {
    let Some(position) = sheet.find(label).filter(|&n| sheet.is_claim(n)) else {
        let claims = (0..sheet.entries.len())
            .filter(|&n| sheet.is_claim(n))
            .filter_map(|n| sheet.entries.get(n));
        let known: Vec<&str> = claims.map(|entry| entry.label.as_str()).collect();
        return Err(Fault::new(format!(
            "no claim `{label}` (there are: {})",
            known.join(", ")
        )));
    };
    let (mut decision, evidence) = decide(sheet, position)?;
    let others = decide_all(sheet)?;
    let mut others: Vec<Decision> = others.into_iter().map(|(decision, _)| decision).collect();
    mention_refuted(sheet, others.iter_mut());
    if let Some(told) = others.into_iter().find(|other| other.label == decision.label) {
        decision = told;
    }
    let mut text = prove::explain(sheet, position, &decision, &prove::Options::default());
    text.push_str(&told(&evidence));
    let as_expected = decision.is_expected() && evidence.against.is_none();
    Ok(Answer {
        content: Content::Text(text),
        exit: Exit::from_verdict(as_expected),
    })
}

/// The evidence in words.
fn told(evidence: &Evidence) -> String {
    let mut lines = vec!["\nevidence, which shares no code with the above".to_string()];
    match (evidence.digits, evidence.median) {
        (Some(digits), Some(median)) => lines.push(format!(
            "left and right agree to {digits:.1} digits at the worst of {} random points of the premises in f64, to {median:.1} at half of them",
            evidence.points
        )),
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
