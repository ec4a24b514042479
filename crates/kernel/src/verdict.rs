//! The two verdicts that the kernel gives. Their fields are private: nothing else can make one.

use super::certificate::Certificate;
use super::check::Checker;
use super::expand::Refusal;
use super::statement::{Origin, Property, Statement};
use super::term::Term;
use super::witness::{At, Witness};
use std::collections::BTreeSet;

/// Products of two terms of polynomials that the kernel adds up for one certificate or witness.
pub const EFFORT: u64 = 20_000_000;

/// A claim that follows: its certificate is accepted, and there is a [`Point`] at which everything given holds.
///
/// Nothing outside can make one:
///
/// ```compile_fail,E0451
/// let proved = kernel::Proved { provided: Vec::new(), excluded: Vec::new() };
/// ```
/// ```compile_fail,E0599
/// let proved = kernel::Proved::default();
/// ```
#[derive(Clone, Debug)]
pub struct Proved {
    provided: Vec<String>,
    excluded: Vec<Term>,
}

impl Proved {
    /// What is accepted of letters that need not commute, which provides nothing and excludes nothing.
    pub(super) fn of_words() -> Self {
        Self {
            provided: Vec::new(),
            excluded: Vec::new(),
        }
    }

    /// The conditions that the proof takes for granted: derivatives of implicit quantities that must exist.
    pub fn provided(&self) -> &[String] {
        &self.provided
    }

    /// The terms in generic symbols, of the statement of the certificate, that are taken not to be 0.
    pub fn excluded(&self) -> &[Term] {
        &self.excluded
    }
}

/// A claim that does not follow: a point at which everything given holds and the claim fails, or nowhere defined.
///
/// Nothing outside can make one, nor change what is given:
///
/// ```compile_fail,E0451
/// let refuted = kernel::Refuted { nowhere: false };
/// ```
/// ```compile_fail,E0616
/// let mut statement = kernel::Statement::default();
/// statement.givens.clear();
/// ```
#[derive(Clone, Debug)]
pub struct Refuted {
    nowhere: bool,
}

impl Refuted {
    /// Whether the claim is defined nowhere.
    pub fn is_nowhere_defined(&self) -> bool {
        self.nowhere
    }
}

/// A statement with the terms that a certificate or a witness speaks of.
#[derive(Clone, Debug)]
pub struct With<T> {
    pub statement: Statement,
    pub evidence: T,
}

/// Whether what comes along is about a copy of the statement, perhaps with more terms.
fn same<T>(statement: &Statement, with: &With<T>) -> Result<(), Refusal> {
    let is_same = statement.identity != 0 && statement.identity == with.statement.identity;
    match is_same && with.statement.extends(statement) {
        true => Ok(()),
        false => Err(Refusal::Other("this is about another statement".into())),
    }
}

/// A point at which everything given holds: what is proved from the givens is not proved from a contradiction.
///
/// Nothing outside can make one:
///
/// ```compile_fail,E0451
/// let point = kernel::Point { witness: todo!() };
/// ```
#[derive(Clone, Debug)]
pub struct Point {
    witness: Box<With<Witness>>,
}

/// What holds at a point of the premises.
#[derive(Clone, Debug)]
pub enum Evaluated {
    /// The claim is not known to fail there.
    Holds(Point),
    Fails(Refuted),
}

/// Checks that everything given holds at a witness, and whether the claim fails there.
///
/// # Errors
/// A [`Refusal`] that says which given is not shown.
pub fn evaluate(statement: &Statement, witness: &With<Witness>) -> Result<Evaluated, Refusal> {
    same(statement, witness)?;
    let mut own = witness.statement.clone();
    let mut at = At::new(&mut own, &witness.evidence, EFFORT)?;
    Ok(match at.fails() {
        Ok(true) => Evaluated::Fails(Refuted { nowhere: false }),
        _ => Evaluated::Holds(Point {
            witness: Box::new(witness.clone()),
        }),
    })
}

/// Accepts a proof: every goal is known once the steps are followed, and there is a point at which the givens hold.
///
/// # Errors
/// A [`Refusal`] that says which step or goal is not shown.
pub fn prove(statement: &Statement, certificate: &With<Certificate>, point: &Point) -> Result<Proved, Refusal> {
    same(statement, certificate)?;
    let is_same = point.witness.statement.identity == statement.identity;
    if !(is_same && point.witness.statement.extends(statement)) {
        return Err(Refusal::Other("this is a point of another statement".into()));
    }
    let excluded = excluded(certificate)?;
    if !excluded.is_empty() {
        let mut own = point.witness.statement.clone();
        let copied = excluded.iter();
        let copied = copied.map(|&term| own.terms.copied(&certificate.statement.terms, term));
        let copied: Vec<Term> = copied.collect();
        let mut at = At::new(&mut own, &point.witness.evidence, EFFORT)?;
        for term in copied {
            if !at.property(Property::Nonzero, term)? {
                return Err(Refusal::Other("the point lies in a set that the proof excludes".into()));
            }
        }
    }
    Ok(Proved {
        provided: provided(statement),
        excluded,
    })
}

/// Whether the goals follow by a certificate; that the givens do not contradict each other is not asked.
///
/// # Errors
/// A [`Refusal`] that says which step or goal is not shown.
pub fn follows(certificate: &With<Certificate>) -> Result<(), Refusal> {
    excluded(certificate).map(|_| ())
}

/// What a certificate that leads to the goals excludes of generic symbols.
fn excluded(certificate: &With<Certificate>) -> Result<Vec<Term>, Refusal> {
    let mut statement = certificate.statement.clone();
    let goals = statement.goal.clone();
    if goals.is_empty() {
        return Err(Refusal::Other("there is no goal".into()));
    }
    let mut checker = Checker::new(&mut statement, &certificate.evidence, EFFORT);
    checker.follow(&certificate.evidence.steps)?;
    for (property, term) in goals {
        for (condition, of) in checker.statement.domain(term) {
            if !checker.knows(condition, of)? {
                return Err(Refusal::Other("the claim is not known to be defined".into()));
            }
        }
        if !checker.knows(property, term)? {
            return Err(Refusal::Other("the steps do not lead to the claim".into()));
        }
    }
    Ok(checker.excluded().to_vec())
}

/// Accepts a counterexample: the givens hold at the witness, and a goal fails.
///
/// # Errors
/// A [`Refusal`] that says which given is not shown, or that the claim is not known to fail there.
pub fn refute(statement: &Statement, witness: &With<Witness>) -> Result<Refuted, Refusal> {
    match evaluate(statement, witness)? {
        Evaluated::Fails(refuted) => Ok(refuted),
        Evaluated::Holds(_) => Err(Refusal::Other("the claim is not known to fail at the witness".into())),
    }
}

/// Accepts that a claim is defined nowhere: its domain contradicts the premises by the certificate, while these hold
/// at the witness.
///
/// # Errors
/// A [`Refusal`] that says which step or given is not shown.
pub fn refute_nowhere(
    statement: &Statement,
    certificate: &With<Certificate>,
    witness: &With<Witness>,
) -> Result<Refuted, Refusal> {
    same(statement, certificate)?;
    same(statement, witness)?;
    contradicts(certificate)?;
    At::new(&mut witness.statement.premises(), &witness.evidence, EFFORT)?;
    Ok(Refuted { nowhere: true })
}

/// Whether the givens contradict each other by a certificate.
///
/// # Errors
/// A [`Refusal`] that says which step is not shown.
pub fn contradicts(certificate: &With<Certificate>) -> Result<(), Refusal> {
    let mut statement = certificate.statement.clone();
    let mut checker = Checker::new(&mut statement, &certificate.evidence, EFFORT);
    checker.follow(&certificate.evidence.steps)?;
    match checker.is_absurd() && checker.excluded().is_empty() {
        true => Ok(()),
        false => Err(Refusal::Other("the steps lead to no contradiction".into())),
    }
}

/// The givens of the statement that derivatives exist, which no premise says.
fn provided(statement: &Statement) -> Vec<String> {
    let origins = statement.givens.iter().map(|given| &given.origin);
    let origins = origins.filter(|origin| matches!(origin, Origin::DerivativesExist(_)));
    let provided: BTreeSet<String> = origins.map(ToString::to_string).collect();
    provided.into_iter().collect()
}
