//! A whole sheet decided.

use super::atom::Atoms;
use super::counterexample::Counterexample;
use super::fault::Fault;
use super::jacobian::Jacobians;
use super::parting::parting;
use super::premise::Statements;
use super::problem::Problem;
use super::proof::{Outcome, decide};
use super::sheet::{Entry, Role, Sheet};
use super::verdict::Verdict;
use crate::tex::Equation;

/// What was decided of one claim, and why.
#[derive(Clone, Debug)]
pub struct Decision {
    pub label: String,
    pub verdict: Verdict,
    pub expected: Verdict,
    pub counterexample: Option<Counterexample>,
    pub reason: String,
    /// The equation that was not proved, of the several that a label may have.
    pub failed: Option<Equation>,
}

impl Decision {
    /// Whether the verdict is the one that the sheet expects.
    pub fn is_expected(&self) -> bool {
        self.verdict == self.expected
    }
}

impl Sheet {
    /// Decides every claim, in the order of the sheet.
    ///
    /// # Errors
    /// A [`Fault`] where a claim or a premise makes no sense.
    pub fn audit(&self) -> Result<Vec<Decision>, Fault> {
        let mut decisions = Vec::new();
        for position in 0..self.entries.len() {
            if self.is_claim(position) {
                decisions.push(self.decide(position)?);
            }
        }
        self.mention_refuted(decisions.iter_mut());
        Ok(decisions)
    }

    /// What bears on the claim at a position: its premises with all substitutions made, its definitions, itself.
    ///
    /// # Errors
    /// A [`Fault`] where a definition or a substitution makes no sense.
    pub fn statements(&self, position: usize) -> Result<Statements, Fault> {
        let mut atoms = Atoms::new(&self.vocabulary.index);
        let jacobians = Jacobians::new(&self.vocabulary, &mut atoms).map_err(Fault::new)?;
        Statements::gather(self, position, &jacobians, &mut atoms)
    }

    /// Decides the claim at a position of the sheet.
    ///
    /// # Errors
    /// As [`Sheet::audit`].
    pub fn decide(&self, position: usize) -> Result<Decision, Fault> {
        let Some(entry) = self.entries.get(position) else {
            return Err(Fault::new("there is no such equation"));
        };
        self.decision(position, entry)
            .map_err(|fault| fault.of(&entry.label).at(&entry.tex))
    }

    fn decision(&self, position: usize, entry: &Entry) -> Result<Decision, Fault> {
        let mut problem = Problem::new(self, position)?;
        let claims = problem.statements.claims.clone();
        let mut decision = Decision {
            label: entry.label.clone(),
            verdict: Verdict::Proved,
            expected: entry.expect,
            counterexample: None,
            failed: None,
            reason: format!("follows from {}", self.named(&entry.follows_from)),
        };
        for (number, equation) in claims.iter().enumerate() {
            let which = if claims.len() > 1 {
                format!("equation {} of {}: ", number + 1, claims.len())
            } else {
                String::new()
            };
            let (verdict, reason) = match decide(&mut problem, entry, equation)? {
                Outcome::Holds => continue,
                Outcome::Nowhere => (
                    Verdict::Refuted,
                    "nowhere defined: a denominator vanishes wherever the premises hold".to_string(),
                ),
                Outcome::Unshown => (
                    Verdict::Undecided,
                    "the sides differ as functions, but no point in small rationals shows it".to_string(),
                ),
                Outcome::TooLarge => (
                    Verdict::Undecided,
                    "too large to expand; the sides agree at every point tried".to_string(),
                ),
                Outcome::Fails(counterexample) => {
                    decision.counterexample = Some(counterexample);
                    let mended = parting(&mut problem, entry, equation);
                    (
                        Verdict::Refuted,
                        mended.unwrap_or_else(|| "does not follow from its premises".to_string()),
                    )
                }
            };
            decision.verdict = verdict;
            decision.reason = format!("{which}{reason}");
            decision.failed = Some(equation.clone());
            break;
        }
        Ok(decision)
    }

    fn named(&self, positions: &[usize]) -> String {
        let labels = positions
            .iter()
            .filter_map(|&n| self.entries.get(n))
            .map(|entry| format!("({})", entry.label));
        labels.collect::<Vec<_>>().join(", ")
    }

    /// Whether the entry at a position is to be decided.
    pub fn is_claim(&self, position: usize) -> bool {
        self.entries
            .get(position)
            .is_some_and(|entry| entry.role == Role::Claim)
    }

    /// Says of each decision that rests on a refuted claim that it does.
    pub fn mention_refuted<'a>(&self, decisions: impl Iterator<Item = &'a mut Decision>) {
        let mut decisions: Vec<&mut Decision> = decisions.collect();
        let refuted = decisions.iter().filter(|d| d.verdict == Verdict::Refuted);
        let refuted: Vec<String> = refuted.map(|d| d.label.clone()).collect();
        for decision in &mut decisions {
            let Some(entry) = self.find(&decision.label).and_then(|n| self.entries.get(n)) else {
                continue;
            };
            let premises = entry.follows_from.iter().filter_map(|&n| self.entries.get(n));
            let wrong = premises.filter(|p| refuted.contains(&p.label));
            let wrong: Vec<String> = wrong.map(|p| format!("({})", p.label)).collect();
            if !wrong.is_empty() {
                decision.reason = format!(
                    "{}; taken as given although refuted: {}",
                    decision.reason,
                    wrong.join(", ")
                );
            }
        }
    }
}
