//! The search for proofs and counterexamples. Whatever it finds, the kernel decides.

mod angles;
mod counterexample;
mod decision;
mod float;
mod point;
mod proof;
mod session;
mod values;

pub use counterexample::Counterexample;
pub use decision::{Decision, mention_refuted};

use crate::claim::{Sheet, Verdict};
use crate::kernel;

/// How far the search goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The limit in steps, as a multiple of the usual one.
    pub effort: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self { effort: 1 }
    }
}

/// Decides the claim at a position of the sheet. What cannot be read is `unread`; what follows from such is
/// `undecided`.
pub fn decide(sheet: &Sheet, position: usize, options: &Options) -> Decision {
    let statements = match Decision::without_search(sheet, position) {
        Ok(statements) => statements,
        Err(decision) => return decision,
    };
    let mut decision = Decision::of(sheet, position);
    let questions = match crate::kernel::questions(&statements, &sheet.vocabulary) {
        Ok(questions) => questions,
        Err(fault) => {
            decision.verdict = Verdict::Unread;
            decision.reason = fault.to_string();
            return decision;
        }
    };
    decision.verdict = Verdict::Proved;
    decision.reason = follows_from(sheet, position);
    for question in questions {
        let outcome = outcome(&question.statement, options.effort);
        match outcome {
            Outcome::Proved(proof) => decision.provided.extend(proof.provided().iter().cloned()),
            Outcome::Refuted(_, witness) => {
                decision.verdict = Verdict::Refuted;
                decision.reason = "does not follow from its premises".into();
                let _ = witness;
                decision.failed = Some(question.equation.clone());
                break;
            }
            Outcome::Undecided(reason) => {
                decision.verdict = Verdict::Undecided;
                decision.reason = reason;
                decision.failed = Some(question.equation.clone());
            }
        }
    }
    decision
}

fn follows_from(sheet: &Sheet, position: usize) -> String {
    let premises = sheet
        .entries
        .get(position)
        .map(|entry| entry.follows_from.as_slice())
        .unwrap_or_default();
    let labels = premises
        .iter()
        .filter_map(|&n| sheet.entries.get(n))
        .map(|entry| format!("({})", entry.label));
    let labels: Vec<String> = labels.collect();
    match labels.is_empty() {
        true => "an identity".to_string(),
        false => format!("follows from {}", labels.join(", ")),
    }
}

/// What came of a question.
enum Outcome {
    Proved(kernel::Proved),
    Refuted(kernel::Refuted, kernel::With<kernel::Witness>),
    Undecided(String),
}

/// Steps of the search for a proof, for each unit of effort.
const PROOF_STEPS: u64 = 5_000_000;

fn outcome(statement: &kernel::Statement, effort: u64) -> Outcome {
    // a wrong formula costs less than its proof would
    let fails = |witness: &kernel::With<kernel::Witness>| kernel::refute(statement, witness).is_ok();
    if let Some(witness) = point::search(statement, point::Wanted::Failure, effort, &fails)
        && let Ok(refuted) = kernel::refute(statement, &witness)
    {
        return Outcome::Refuted(refuted, witness);
    }
    if let Some(certificate) = proof::search(statement, PROOF_STEPS * effort) {
        let holds = |point: &kernel::With<kernel::Witness>| kernel::prove(statement, &certificate, point).is_ok();
        let point = point::search(statement, point::Wanted::Premises, effort, &holds);
        if let Some(point) = point
            && let Ok(proved) = kernel::prove(statement, &certificate, &point)
        {
            return Outcome::Proved(proved);
        }
        return Outcome::Undecided("no point is found at which the premises hold".into());
    }
    Outcome::Undecided("neither a proof nor a counterexample is found".into())
}

/// The certificates that the search finds for the questions of the claim at a position, each with its statement.
pub fn certificates(sheet: &Sheet, position: usize) -> Vec<kernel::With<kernel::Certificate>> {
    let Ok(statements) = Decision::without_search(sheet, position) else {
        return Vec::new();
    };
    let questions = kernel::questions(&statements, &sheet.vocabulary).unwrap_or_default();
    let found = questions
        .iter()
        .map(|question| proof::search(&question.statement, PROOF_STEPS));
    found.flatten().collect()
}

/// Decides each claim, in the order of the sheet. What cannot be read has a row too, whatever its role.
pub fn audit(sheet: &Sheet, options: &Options) -> Vec<Decision> {
    let rows = sheet.rows().into_iter();
    let mut decisions: Vec<Decision> = rows.map(|position| decide(sheet, position, options)).collect();
    mention_refuted(sheet, decisions.iter_mut());
    decisions
}

/// The proof or the counterexample of the claim at a position, as text.
pub fn explain(sheet: &Sheet, position: usize, decision: &Decision, options: &Options) -> String {
    let _ = (sheet, position, options);
    format!("({}) {}: {}\n", decision.label, decision.verdict, decision.reason)
}
