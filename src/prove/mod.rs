//! The search for proofs and counterexamples. Whatever it finds, the kernel decides.

mod angles;
mod counterexample;
mod decision;
mod proof;
mod session;
mod values;

pub use counterexample::Counterexample;
pub use decision::{Decision, mention_refuted};

use crate::claim::{Sheet, Verdict};

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
    for question in questions {
        match proof::search(&question.statement, 5_000_000 * options.effort) {
            Some(certificate) => {
                if let Err(refusal) = crate::kernel::follows(&certificate) {
                    decision.verdict = Verdict::Undecided;
                    decision.reason = format!("KERNEL: {refusal}");
                }
            }
            None => {
                decision.verdict = Verdict::Undecided;
                decision.reason = "no proof found".into();
            }
        }
    }
    decision
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
