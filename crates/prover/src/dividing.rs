//! Divisions that authors do not mention.

use super::budget::Budget;
use super::outcome::{Outcome, decided_outcome, points};
use super::point::Wanted;
use super::proof;
use super::script::Found;
use claims::{Goal, Premise, Question, divisors};
use kernel::Statement;
use numbers::{Field, Rational};
use texmath::{Condition, DoubtKind, Equation, Relation, Tree, any};

/// Steps of the search for a proof that a claim follows after a division.
const FEW_STEPS: u64 = 200_000;

/// A refuted claim's premise that can be solved for what the claim speaks of by a division; the divisor is 0 at the
/// counterexample.
pub(super) struct Division {
    /// That the author may have meant to divide.
    pub(super) doubt: DoubtKind,
    pub(super) exception: Option<Exception>,
}

/// A condition, that a factor is not 0, under which a claim follows; without it, it fails at some points and holds at others.
pub(super) struct Exception {
    pub(super) condition: Equation,
    /// A proof under the condition, and outside it a point at which the claim fails and a proof that it holds at one.
    pub(super) shown: Vec<Shown>,
}

/// A goal, its question, and what decides it.
pub(super) type Shown = (Goal, Question, Found);

impl Division {
    pub(super) fn of(goal: &Goal, question: &Question, effort: u64) -> Option<Self> {
        let divisors = divisors(goal);
        let search = Search { goal, question, effort };
        let (premise, factor) = match !divisors.is_empty() && search.follows(&divisors) {
            true => {
                let alone = divisors
                    .iter()
                    .find(|divisor| search.follows(std::slice::from_ref(*divisor)));
                alone.or(divisors.first())?
            }
            false => divisors.iter().find(|divisor| search.is_open(divisor))?,
        };
        let mut conditions = divisors.iter().flat_map(|(label, divisor)| {
            let mut premises = goal.statements.premises.iter();
            let premise = premises.find(|premise| premise.label == *label);
            let factors = factors(divisor).into_iter();
            factors.filter(move |factor| premise.is_some_and(|premise| is_factor(factor, &premise.equation)))
        });
        let exception = conditions.find_map(|factor| {
            Some(Exception {
                condition: relation(factor, Relation::NotEqual),
                shown: search.exception(factor)?,
            })
        });
        Some(Self {
            doubt: DoubtKind::Factor {
                factor: factor.to_string(),
                premise: premise.clone(),
            },
            exception,
        })
    }
}

fn relation(to_zero: &Tree, relation: Relation) -> Equation {
    Equation {
        relation,
        ..Equation::between(to_zero.clone(), Tree::Number(Rational::from_integer(0)))
    }
}

struct Search<'a> {
    goal: &'a Goal,
    question: &'a Question,
    effort: u64,
}

impl Search<'_> {
    /// The goal and its question under more conditions.
    fn under(&self, conditions: impl IntoIterator<Item = Equation>) -> Option<(Goal, Question)> {
        let mut goal = self.goal.clone();
        let conditions: Vec<Equation> = conditions.into_iter().collect();
        goal.part = conditions
            .iter()
            .map(|own| format!("where {own}"))
            .collect::<Vec<_>>()
            .join(", ");
        goal.statements
            .assume
            .extend(conditions.into_iter().map(Condition::Relation));
        let questions = claims::questions(&goal.statements, &goal.symbols).ok()?;
        let is_same =
            |other: &Question| other.equation == self.question.equation && other.instance == self.question.instance;
        let question = questions.into_iter().find(is_same)?;
        Some((goal, question))
    }

    fn without(&self, divisors: &[(String, Tree)]) -> Option<Statement> {
        let conditions = divisors
            .iter()
            .map(|(_, divisor)| relation(divisor, Relation::NotEqual));
        self.under(conditions).map(|(_, question)| question.statement)
    }

    fn follows(&self, divisors: &[(String, Tree)]) -> bool {
        let Some(statement) = self.without(divisors) else {
            return false;
        };
        // mostly it is false for another reason, which costs less to see than to look for a proof
        let found = points(&statement, Wanted::Either, self.effort);
        let is_false = matches!(found, Some((_, kernel::Evaluated::Fails(_))));
        !is_false && proof::search(&statement, FEW_STEPS, &mut 0).is_some() && self.is_proved(&statement)
    }

    fn outcome(&self, statement: &Statement) -> Outcome {
        decided_outcome(statement, &Budget::of_claim(self.effort))
    }

    fn is_proved(&self, statement: &Statement) -> bool {
        matches!(self.outcome(statement), Outcome::Proved(..))
    }

    /// Returns true if a law that is divided holds at other times than that at which its divisor is not 0.
    fn is_open(&self, divisor: &(String, Tree)) -> bool {
        let time = self.goal.symbols.running();
        let is_time = |node: &Tree| matches!(node, Tree::Symbol(name, _) if Some(name) == time);
        let is_undecided = |statement| matches!(self.outcome(&statement), Outcome::Undecided(_));
        any(&divisor.1, &mut |node| is_time(node))
            && self.without(std::slice::from_ref(divisor)).is_some_and(is_undecided)
    }

    /// Shows that the claim follows where a factor is not 0, fails at a point at which it is 0, and holds at another one.
    fn exception(&self, factor: &Tree) -> Option<Vec<Shown>> {
        let vanishes = || relation(factor, Relation::Equal);
        let follows = self.shown(self.under([relation(factor, Relation::NotEqual)])?, true)?;
        let fails = self.shown(self.under([vanishes()])?, false)?;
        let mut holding = self.goal.clone();
        let premises = holding.statements.claims.drain(..);
        let premises: Vec<Premise> = premises.map(|claim| Premise::known("the claim", claim)).collect();
        holding.statements.premises.extend(premises);
        holding.statements.claims.push(vanishes());
        holding.statements.assume.push(Condition::Relation(vanishes()));
        holding.part = format!("where {} and it holds", vanishes());
        let questions = claims::questions(&holding.statements, &holding.symbols).ok()?;
        let holds = questions
            .into_iter()
            .map(|question| self.shown((holding.clone(), question), true));
        let holds: Vec<Shown> = holds.collect::<Option<_>>()?;
        (!holds.is_empty()).then(|| [follows, fails].into_iter().chain(holds).collect())
    }

    /// A question with what decides it, where it is proved, or else refuted.
    fn shown(&self, (goal, question): (Goal, Question), is_proved: bool) -> Option<Shown> {
        let found = Found::of(self.outcome(&question.statement))?;
        let is_one = matches!(found, Found::Proved { .. }) == is_proved;
        is_one.then_some((goal, question, found))
    }
}

/// The letters and values of functions that are factors of a tree.
fn factors(tree: &Tree) -> Vec<&Tree> {
    match tree {
        Tree::Product(parts) => parts.iter().flat_map(factors).collect(),
        Tree::Negate(inner) | Tree::Power(inner, 1.., _) => factors(inner),
        Tree::Symbol(..) | Tree::Call(..) => vec![tree],
        _ => Vec::new(),
    }
}

/// Returns true if each of the terms of an equation, of which it has two at least, has a factor.
fn is_factor(factor: &Tree, equation: &Equation) -> bool {
    let sides = [&equation.left, &equation.right];
    let count: usize = sides.iter().map(|side| terms(side)).sum();
    count > 1 && sides.iter().all(|side| has_factor(side, factor))
}

fn has_factor(tree: &Tree, factor: &Tree) -> bool {
    match tree {
        tree if tree == factor => true,
        Tree::Number(value) => value.0.is_zero(),
        Tree::Product(parts) => parts.iter().any(|part| has_factor(part, factor)),
        Tree::Sum(parts) => parts.iter().all(|part| has_factor(part, factor)),
        Tree::Negate(inner) | Tree::Quotient(inner, ..) | Tree::Power(inner, 1.., _) => has_factor(inner, factor),
        _ => false,
    }
}

/// The number of terms of a tree that is multiplied out.
fn terms(tree: &Tree) -> usize {
    match tree {
        Tree::Number(value) if value.0.is_zero() => 0,
        Tree::Product(parts) => parts.iter().map(terms).product(),
        Tree::Sum(parts) => parts.iter().map(terms).sum(),
        Tree::Negate(inner) | Tree::Quotient(inner, ..) | Tree::Power(inner, 1.., _) => terms(inner),
        _ => 1,
    }
}
