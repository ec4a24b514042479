//! What authors divide a premise by without a word.

use super::{Outcome, outcome};
use crate::claim::{Goal, divisors};
use crate::kernel;
use crate::number::{Field, Rational};
use crate::tex::{Condition, DoubtKind, Equation, Relation, Tree};

/// Returns the doubt of a refuted claim of which no counterexample is found where a premise can be solved for what the claim
/// speaks of: what it is divided by then, which is not 0 everywhere that the premises hold, is 0 at all that are found.
pub(super) fn doubt(goal: &Goal, question: &kernel::Question, effort: u64) -> Option<DoubtKind> {
    let divisors = divisors(goal);
    let within = |divisors: &[(String, Tree)]| {
        let mut within = goal.statements.clone();
        within.assume.extend(divisors.iter().map(|(_, divisor)| {
            Condition::Relation(Equation {
                relation: Relation::NotEqual,
                ..Equation::between(divisor.clone(), Tree::Number(Rational::from_integer(0)))
            })
        }));
        let questions = kernel::questions(&within, &goal.vocabulary).ok()?;
        let is_same =
            |other: &&kernel::Question| other.equation == question.equation && other.instance == question.instance;
        let same = questions.iter().find(is_same)?;
        Some(outcome(&same.statement, effort))
    };
    let fails = |outcome: &Option<Outcome>| matches!(outcome, Some(Outcome::Refuted(..)));
    if divisors.is_empty() || fails(&within(&divisors)) {
        return None;
    }
    let (premise, factor) = divisors.iter().find(|divisor| {
        let found = within(std::slice::from_ref(*divisor));
        !fails(&found) && !matches!(found, None | Some(Outcome::Contradictory(_)))
    })?;
    Some(DoubtKind::Factor {
        factor: factor.to_string(),
        premise: premise.clone(),
    })
}
