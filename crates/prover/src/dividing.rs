//! Divisions that authors do not mention.

use super::{Outcome, outcome, proof};
use claims::{Goal, divisors};
use numbers::{Field, Rational};
use texmath::{Condition, DoubtKind, Equation, Relation, Tree, any};

/// Steps of the search for a proof that a claim follows after a division.
const FEW_STEPS: u64 = 200_000;

/// Returns the doubt of a refuted claim that follows where a premise can be solved for what the claim speaks of: what the
/// premise is divided by then is 0 at the counterexample.
pub(super) fn doubt(goal: &Goal, question: &claims::Question, effort: u64) -> Option<DoubtKind> {
    let divisors = divisors(goal);
    let within = |divisors: &[(String, Tree)]| {
        let mut within = goal.statements.clone();
        within.assume.extend(divisors.iter().map(|(_, divisor)| {
            Condition::Relation(Equation {
                relation: Relation::NotEqual,
                ..Equation::between(divisor.clone(), Tree::Number(Rational::from_integer(0)))
            })
        }));
        let questions = claims::questions(&within, &goal.symbols).ok()?;
        let is_same =
            |other: &claims::Question| other.equation == question.equation && other.instance == question.instance;
        questions.into_iter().find(is_same).map(|question| question.statement)
    };
    let is_quick = |statement: &kernel::Statement| proof::search(statement, FEW_STEPS).is_some();
    let is_proved = |statement: &kernel::Statement| matches!(outcome(statement, effort), Outcome::Proved(..));
    let follows = |divisors: &[(String, Tree)]| {
        within(divisors).is_some_and(|statement| is_quick(&statement) && is_proved(&statement))
    };
    // a law holds at other times than that at which its divisor is not 0
    let runs = |divisor: &Tree| {
        let time = goal.symbols.running();
        any(
            divisor,
            &mut |node| matches!(node, Tree::Symbol(name, _) if Some(name) == time),
        )
    };
    let is_open = |divisor: &(String, Tree)| {
        let statement = || within(std::slice::from_ref(divisor));
        let is_undecided = |statement| matches!(outcome(&statement, effort), Outcome::Undecided(_));
        runs(&divisor.1) && statement().is_some_and(is_undecided)
    };
    let (premise, factor) = match !divisors.is_empty() && follows(&divisors) {
        true => {
            let alone = divisors.iter().find(|divisor| follows(std::slice::from_ref(*divisor)));
            alone.or(divisors.first())?
        }
        false => divisors.iter().find(|divisor| is_open(divisor))?,
    };
    Some(DoubtKind::Factor {
        factor: factor.to_string(),
        premise: premise.clone(),
    })
}
