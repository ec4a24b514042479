//! The search for proofs and counterexamples. Whatever it finds, the kernel decides.

mod counterexample;
mod decision;

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
    let _ = options;
    match Decision::without_search(sheet, position) {
        Ok(_statements) => {
            let mut decision = Decision::of(sheet, position);
            decision.verdict = Verdict::Undecided;
            decision.reason = "not decided yet".to_string();
            decision
        }
        Err(decision) => decision,
    }
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
