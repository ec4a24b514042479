//! The search for a proof: everything known is written over few generators, and the claim is reduced by it.

use super::angles;
use super::constants;
use super::inverse;
use super::laws::Usable;
use super::logarithms;
use super::powers;
use super::roots;
use super::session::Session;
use super::values;
use crate::algebra::factors;
use kernel::{Certificate, Elementary, Inference, Node, Polynomial, Property, Statement, Term, With};
use std::collections::BTreeSet;

/// The largest power of a sum that is multiplied out rather than kept whole.
const LARGEST_EXPANSION: usize = 12;

/// Passes of adding what is known of the functions that occur.
const PASSES: usize = 4;

/// Looks for a certificate of every goal, and counts the steps that it uses.
pub fn search(statement: &Statement, budget: u64, used: &mut u64) -> Option<With<Certificate>> {
    let whole = large_bases(statement);
    let attempts: Vec<Vec<Term>> = if whole.is_empty() {
        vec![Vec::new()]
    } else {
        vec![whole, Vec::new()]
    };
    for whole in attempts {
        let mut own = statement.clone();
        let mut session = Session::new(&mut own, whole.clone(), budget);
        let is_proved = prove_goals(&mut session).is_some();
        *used += budget - session.budget.left();
        if is_proved {
            let steps = std::mem::take(&mut session.steps);
            return Some(With {
                statement: own,
                evidence: Certificate { whole, steps },
            });
        }
    }
    None
}

/// Looks for a proof that the givens contradict each other: something is not 0 that vanishes, something positive is not
/// positive, or 1 is in the ideal of what vanishes.
pub fn contradiction(statement: &Statement, budget: u64) -> Option<With<Certificate>> {
    let mut own = statement.clone();
    let mut session = Session::new(&mut own, Vec::new(), budget);
    prepare(&mut session, &[])?;
    let one = Polynomial::integer(1);
    for _ in 0..PASSES {
        let count = session.checker.facts.len();
        if session.show_absurd() {
            break;
        }
        deduce(&mut session, &one);
        if session.checker.facts.len() == count {
            break;
        }
    }
    if !session.checker.is_absurd() {
        session.show_zero(&one)?;
    }
    let steps = std::mem::take(&mut session.steps);
    Some(With {
        statement: own,
        evidence: Certificate {
            whole: Vec::new(),
            steps,
        },
    })
}

/// Sums in the goals that are raised to large powers.
pub fn large_bases(statement: &Statement) -> Vec<Term> {
    let mut whole = BTreeSet::new();
    let terms = statement.terms();
    for (_, term) in statement.goal() {
        for inner in terms.inside(*term) {
            if let Node::Power(base, exponent) = terms.node(inner)
                && let Node::Sum(parts) = terms.node(*base)
                && parts
                    .len()
                    .saturating_mul(usize::try_from(*exponent).unwrap_or(usize::MAX))
                    > LARGEST_EXPANSION
            {
                whole.insert(*base);
            }
        }
    }
    whole.into_iter().collect()
}

fn prove_goals(session: &mut Session) -> Option<()> {
    let goals = session.checker.statement.goal().to_vec();
    let mut polynomials = Vec::new();
    for (_, term) in &goals {
        polynomials.push(session.numerator(*term)?);
    }
    given(session);
    let generators = session.generators(&polynomials).into_iter();
    let met = generators.flat_map(|term| session.checker.statement.terms().inside(term));
    let met: BTreeSet<Term> = met.collect();
    single_functions(session, &met);
    session.triangulate_all();
    // what follows from the premises as they stand needs no maps, laws and functions
    for ((property, _), polynomial) in goals.iter().zip(&polynomials) {
        if *property == Property::Zero {
            session.show_by_triangle(polynomial);
        }
    }
    if goals
        .iter()
        .all(|(property, term)| session.checker.knows(*property, *term) == Ok(true))
    {
        return Some(());
    }
    prepare(session, &polynomials)?;
    for (property, term) in goals {
        if session.checker.knows(property, term).ok()? {
            continue;
        }
        let polynomial = match property {
            Property::Positive | Property::NonNegative => session.signed_numerator(term)?,
            _ => session.numerator(term)?,
        };
        show(session, property, &polynomial)?;
        if !session.checker.knows(property, term).ok()? {
            return None;
        }
    }
    Some(())
}

/// How deep cases are within cases.
const DEEPEST_CASES: usize = 3;

fn show(session: &mut Session, property: Property, polynomial: &Polynomial) -> Option<()> {
    attempt(session, property, polynomial).or_else(|| settle(session, property, polynomial, DEEPEST_CASES))
}

/// By what is known now.
fn attempt(session: &mut Session, property: Property, polynomial: &Polynomial) -> Option<()> {
    let known =
        |session: &Session| session.checker.is_absurd() || session.checker.knows_polynomial(property, polynomial);
    if known(session) {
        return Some(());
    }
    match property {
        Property::Zero => session.show_zero(polynomial)?,
        Property::Nonzero => match session.show_nonzero(polynomial) {
            Some(fact) => fact,
            None => session.nonzero_fact(polynomial)?.0,
        },
        Property::Positive => match session.show_sign(polynomial, true) {
            Some(fact) => fact,
            None => session.show_positive(polynomial)?,
        },
        Property::NonNegative => session.show_sign(polynomial, false)?,
        Property::Integer => return None,
    };
    known(session).then_some(())
}

/// By what is known of roots, logarithms, inverse functions and signs, then by cases.
fn settle(session: &mut Session, property: Property, polynomial: &Polynomial, depth: usize) -> Option<()> {
    if property == Property::Zero
        && roots::as_claimed(session, polynomial).is_some()
        && attempt(session, property, polynomial).is_some()
    {
        return Some(());
    }
    for _ in 0..PASSES {
        let count = session.checker.facts.len();
        deduce(session, polynomial);
        if property != Property::Zero {
            session.sign_leads(polynomial);
        }
        if attempt(session, property, polynomial).is_some() {
            return Some(());
        }
        if property == Property::Zero && inverse::show_angle(session, polynomial).is_some() {
            return Some(());
        }
        if session.show_absurd() {
            return Some(());
        }
        if session.checker.facts.len() == count && !session.exclude() {
            break;
        }
    }
    if depth == 0 {
        return None;
    }
    let most = if depth == DEEPEST_CASES { 2 } else { 1 };
    let mut splits: Vec<(Polynomial, bool)> = splits(session, polynomial).into_iter().take(most).collect();
    // what contradicts the premises where it is 0 or has the other sign
    if depth == DEEPEST_CASES && property != Property::Zero && polynomial.terms().len() == 1 {
        splits.push((polynomial.clone(), property != Property::Nonzero));
    }
    for (on, order) in splits {
        let found = session.by_cases(&on, order, property, polynomial, &mut |session| {
            session.triangulate_all();
            attempt(session, property, polynomial).or_else(|| settle(session, property, polynomial, depth - 1))
        });
        if found.is_some() {
            return Some(());
        }
    }
    None
}

/// Every generator of the facts and of a polynomial, and what is inside.
fn met(session: &Session, polynomial: &Polynomial) -> BTreeSet<Term> {
    let mut met: BTreeSet<Term> = BTreeSet::new();
    for generator in session.generators(std::slice::from_ref(polynomial)) {
        met.extend(session.checker.statement.terms().inside(generator));
    }
    met
}

fn deduce(session: &mut Session, polynomial: &Polynomial) {
    session.divide_out();
    session.vanishing_summands();
    session.squeeze();
    session.triangulate_all();
    inverse::describe(session, &met(session, polynomial));
    roots::simplify(session, &met(session, polynomial));
    logarithms::simplify(session, &met(session, polynomial));
    let met = met(session, polynomial);
    single_functions(session, &met);
    session.triangulate_all();
    angles::expand(session, &met);
    session.triangulate_all();
}

/// What cases may be told apart by: the sign of the base of a root of a square, a factor of what vanishes.
fn splits(session: &mut Session, polynomial: &Polynomial) -> Vec<(Polynomial, bool)> {
    let mut found: Vec<(Polynomial, bool)> = Vec::new();
    for term in met(session, polynomial) {
        if let Node::Elementary(Elementary::Root(index), of) = session.node(term)
            && index % 2 == 0
            && !session.is_determined(term)
            && !session.checker.statement.is_complex()
        {
            for form in roots::forms(session, of) {
                for (factor, exponent) in form {
                    if exponent % 2 == 0
                        && factor.as_constant().is_none()
                        && session.show_sign(&factor, false).is_none()
                        && session.show_sign(&factor.negated(), false).is_none()
                        && !found.contains(&(factor.clone(), true))
                    {
                        found.push((factor, true));
                    }
                }
            }
        }
    }
    for term in met(session, polynomial) {
        if session.is_integer(term) && !session.is_determined(term) {
            found.push((Polynomial::generator(term), true));
        }
    }
    for fact in session.zeros() {
        let Some(fact) = session.reduced_fact(fact) else {
            continue;
        };
        let vanishing = session.polynomial(fact);
        if vanishing.as_constant().is_some() || vanishing.terms().len() > 60 {
            continue;
        }
        let most = session.budget.left() / 20;
        let Some(parts) = session.budget.attempt(most, |steps| factors(&vanishing, &[], steps)) else {
            continue;
        };
        if parts.factors.len() > 1 {
            for (factor, _) in parts.factors {
                if !found.contains(&(factor.clone(), false)) {
                    found.push((factor, false));
                }
            }
        }
    }
    found
}

/// Brings in all that is given, and what is known of the functions that occur.
pub fn prepare(session: &mut Session, goals: &[Polynomial]) -> Option<()> {
    bring_in(session, goals);
    session.triangulate_all();
    for _ in 0..PASSES {
        let count = session.checker.facts.len();
        let mut met: BTreeSet<Term> = BTreeSet::new();
        for generator in session.generators(goals) {
            met.extend(session.checker.statement.terms().inside(generator));
        }
        single_functions(session, &met);
        constants::find(session, goals);
        values::instantiate(session, goals);
        along(session, goals);
        session.triangulate_all();
        let mut met: BTreeSet<Term> = BTreeSet::new();
        for generator in session.generators(goals) {
            met.extend(session.checker.statement.terms().inside(generator));
        }
        angles::expand(session, &met);
        session.triangulate_all();
        if session.checker.facts.len() == count || session.checker.is_absurd() {
            break;
        }
    }
    Some(())
}

/// Brings in what premises and laws say, and nothing of elementary functions. Gives the laws.
pub fn prepare_premises(session: &mut Session, goals: &[Polynomial]) -> Vec<Usable> {
    bring_in(session, goals);
    session.triangulate_all();
    let mut laws = Vec::new();
    for _ in 0..2 {
        constants::find(session, goals);
        laws = values::instantiate(session, goals);
        session.triangulate_all();
    }
    laws
}

fn bring_in(session: &mut Session, goals: &[Polynomial]) {
    given(session);
    along(session, goals);
}

/// Brings in the premises that are no laws, and what abbreviations stand for.
fn given(session: &mut Session) {
    for number in 0..session.checker.statement.givens().len() {
        let given = Inference::Given(number);
        if session.checker.statement.givens()[number].law.is_none() && !session.steps.contains(&given) {
            let _ = session.step(given);
        }
    }
    let definitions: Vec<kernel::Symbol> = session.checker.statement.definitions().keys().copied().collect();
    for symbol in definitions {
        let term = session.terms().symbol(symbol);
        session.unfold(term);
    }
}

/// What is known of roots, logarithms, powers and inverse functions by themselves.
fn single_functions(session: &mut Session, met: &BTreeSet<Term>) {
    for &term in met {
        match session.node(term) {
            Node::Elementary(Elementary::Root(_), _) => session.describe_root(term),
            Node::Elementary(Elementary::Ln, of) => {
                session.axiom("ExpOfLn", &[of]);
            }
            Node::Elementary(Elementary::Arcsin, of) => {
                session.axiom("SineOfArcsin", &[of]);
                session.axiom("CosineOfArcsin", &[of]);
            }
            Node::Elementary(Elementary::Arccos, of) => {
                session.axiom("CosineOfArccos", &[of]);
                session.axiom("SineOfArccos", &[of]);
            }
            Node::Elementary(Elementary::Arctan, of) => {
                session.axiom("ArctanOfZero", &[of]);
                session.axiom("SineOfArctan", &[of]);
                session.axiom("CosineOfArctan", &[of]);
            }
            Node::RealPower(base, exponent) => {
                session.real_power(base, exponent);
            }
            Node::Symbol(_) if session.is_integer(term) => {
                session.axiom("IntegerAtLeastOne", &[term]);
                let negative = session.terms().negative(term);
                session.axiom("IntegerAtLeastOne", &[negative]);
            }
            Node::Imaginary => {
                session.axiom("ImaginarySquare", &[]);
            }
            _ => {}
        }
    }
    powers::relate(session, met);
}

/// Differentiates the equations of maps, where derivatives along them are spoken of.
fn along(session: &mut Session, goals: &[Polynomial]) {
    let spoken = session
        .generators(goals)
        .into_iter()
        .any(|term| session.is_partial(term));
    if !spoken {
        return;
    }
    for map in 0..session.checker.statement.implicit().len() {
        let step = session.checker.statement.implicit()[map].clone();
        for equation in 0..step.equations.len() {
            for &by in &step.by {
                let along = Inference::Along {
                    implicit: map,
                    equation,
                    by,
                };
                if session.steps.contains(&along) || session.step(along.clone()).is_ok() {
                    continue;
                }
                let (_, term) = step.equations[equation].clone();
                let slope = session.checker.statement.along(term, &step, by);
                let mut needed = session.checker.statement.domain(term);
                let near = session
                    .checker
                    .statement
                    .holding_near(&needed, &[term], &Statement::depends);
                needed.extend(near.unwrap_or_default());
                needed.extend(session.checker.statement.domain(slope));
                if session.show_all(needed).is_some() {
                    let _ = session.step(along);
                }
            }
        }
    }
}
