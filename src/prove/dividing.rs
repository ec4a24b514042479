//! What authors divide a premise by without a word.

use super::{Outcome, outcome};
use crate::claim::{Goal, any, divisors};
use crate::kernel;
use crate::number::{Field, Rational};
use crate::tex::{Condition, DoubtKind, Equation, Relation, Tree};

/// Returns the doubt of a refuted claim that follows where a premise can be solved for what the claim speaks of: what the
/// premise is divided by then is 0 at the counterexample.
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
    if divisors.is_empty() {
        return None;
    }
    let all = within(&divisors);
    if matches!(all, Some(Outcome::Refuted(..))) {
        return None;
    }
    let is_proved = |outcome: &Option<Outcome>| matches!(outcome, Some(Outcome::Proved(..)));
    // a law holds at other times than that at which its divisor is not 0
    let runs = |divisor: &Tree| {
        let time = goal.vocabulary.running.as_ref();
        any(
            divisor,
            &mut |node| matches!(node, Tree::Symbol(name, _) if Some(name) == time),
        )
    };
    let alone = divisors.iter().find(|divisor| {
        let found = within(std::slice::from_ref(*divisor));
        is_proved(&found) || (runs(&divisor.1) && matches!(found, Some(Outcome::Undecided(_))))
    });
    let (premise, factor) = alone.or_else(|| divisors.first().filter(|_| is_proved(&all)))?;
    Some(DoubtKind::Factor {
        factor: factor.to_string(),
        premise: premise.clone(),
    })
}
