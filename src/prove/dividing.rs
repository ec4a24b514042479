//! Factors of premises that authors divide by without a word.

use super::{Outcome, outcome, print};
use crate::claim::{Goal, any_side};
use crate::kernel::{self, Expansion, Property, Statement, Term};
use crate::number::{Field, Rational};
use crate::tex::{Condition, DoubtKind, Equation, Relation, Tree};
use std::collections::BTreeSet;

/// Products of terms for a premise multiplied out.
const MOST_STEPS: u64 = 100_000;

/// The factors that every term of a premise has, of which no counterexample is found where they are not 0: authors divide
/// by them.
pub(super) fn doubts(goal: &Goal, question: &kernel::Question, effort: u64) -> Vec<DoubtKind> {
    let mut found = Vec::new();
    for (premise, printed) in common_factors(&question.statement) {
        let mut factor = None;
        for given in &goal.statements.premises {
            any_side(&given.equation, &mut |node| {
                let is_it = matches!(node, Tree::Symbol(..) | Tree::Call(..)) && node.to_string() == printed;
                if is_it && factor.is_none() {
                    factor = Some(node.clone());
                }
                is_it
            });
        }
        let Some(factor) = factor else { continue };
        let mut divided = goal.statements.clone();
        let mut nonzero = Equation::between(factor, Tree::Number(Rational::from_integer(0)));
        nonzero.relation = Relation::NotEqual;
        divided.assume.push(Condition::Relation(nonzero));
        let questions = kernel::questions(&divided, &goal.vocabulary).unwrap_or_default();
        let is_same =
            |other: &&kernel::Question| other.equation == question.equation && other.instance == question.instance;
        let fails = questions
            .iter()
            .find(is_same)
            .is_some_and(|question| matches!(outcome(&question.statement, effort), Outcome::Refuted(..)));
        if !fails {
            found.push(DoubtKind::Factor {
                factor: printed,
                premise,
            });
        }
    }
    found
}

/// The factors that all terms of a premise have which is, multiplied out, no single term, each with the label of the
/// premise and as it is printed, but for those that are known not to be 0.
fn common_factors(statement: &Statement) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let is_nonzero = |term: Term| {
        let known = |given: &kernel::Given| {
            given.term == term && matches!(given.property, Property::Nonzero | Property::Positive)
        };
        statement.givens().iter().any(known)
    };
    for given in statement
        .givens()
        .iter()
        .filter(|given| given.property == Property::Zero)
    {
        let form = Expansion::new(BTreeSet::new(), MOST_STEPS).of(statement.terms(), given.term);
        let Ok(numerator) = form.map(|form| form.numerator) else {
            continue;
        };
        let [(first, _), rest @ ..] = numerator.terms() else {
            continue;
        };
        let is_common = |term: Term| {
            rest.iter()
                .all(|(monomial, _)| monomial.iter().any(|(own, _)| *own == term))
        };
        for &(term, _) in first
            .iter()
            .filter(|(term, _)| !rest.is_empty() && is_common(*term) && !is_nonzero(*term))
        {
            found.push((given.label.clone(), print::tex(statement.terms(), term)));
        }
    }
    found
}
