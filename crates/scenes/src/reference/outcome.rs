//! What is found of a golden row.

use super::Verdict;

/// What is found of one golden row.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The row's permanent name.
    pub id: String,
    /// Where in the paper, or in which reference file, it stands.
    pub place: String,
    /// The value as printed or certified.
    pub printed: String,
    /// The value computed, as CSV prints it; empty where there is none.
    pub computed: String,
    /// The agreeing digits.
    pub digits: Option<f64>,
    /// What is found.
    pub verdict: Verdict,
    /// What is expected.
    pub expected: Verdict,
    /// What was inferred on the way, as the row names it; of a certified value the means that made it.
    pub rests_on: String,
    /// Why the verdict is not `reproduced`, in one line.
    pub reason: String,
    /// Which row of the table, and which entry of a list in it, was picked; nothing where there was no choice.
    pub picked: String,
}

impl Outcome {
    /// Whether the verdict is the expected one.
    pub fn is_expected(&self) -> bool {
        self.verdict == self.expected
    }
}

/// The reason of an outcome that is not as expected, which a person reads first.
pub fn unexpected(outcome: &Outcome) -> String {
    let Outcome {
        expected,
        verdict,
        reason,
        ..
    } = outcome;
    let colon = if reason.is_empty() { "" } else { ": " };
    format!("EXPECTED {expected}, IS {verdict}{colon}{reason}")
}
