//! Values of unknown functions: instances of laws, equal arguments, whole periods, integrals of laws.

use super::angles::polynomial_term;
use super::constants;
use super::session::Session;
use crate::algebra::{coefficients_in, degree_in};
use crate::kernel::{
    Elementary, Function, FunctionOf, Inference, LawSource, Node, Polynomial, Property, Quantity, Statement, Symbol,
    Term,
};
use crate::number::{Field, Rational};
use num_traits::Zero;
use std::collections::{BTreeMap, BTreeSet};

/// The most whole periods between two times that are tried.
const MOST_PERIODS: i64 = 8;

/// How often a law is integrated, and differentiated: a motion has two integrals, its forcing two more.
const MOST_INTEGRALS: u8 = 4;
const MOST_DERIVATIVES: u8 = 3;

/// The laws found so far, and which of them were differentiated and integrated.
#[derive(Clone, Default)]
pub struct Laws {
    all: Vec<Usable>,
    differentiated: BTreeSet<usize>,
    integrated: BTreeSet<usize>,
    taken: BTreeSet<(i32, usize)>,
    /// Whether constants of motion were looked for.
    pub constants: bool,
}

impl Laws {
    pub fn all(&self) -> &[Usable] {
        &self.all
    }

    pub fn push(&mut self, law: Usable) {
        self.all.push(law);
    }
}

/// A law that can be taken at a time.
#[derive(Clone)]
pub struct Usable {
    source: LawSource,
    time: Symbol,
    term: Term,
    flight: Option<i32>,
    /// How many times it was differentiated, and integrated, to be what it is.
    derivatives: u8,
    integrals: u8,
}

impl Usable {
    /// A law that a step derived.
    pub fn derived(source: LawSource, time: Symbol, term: Term, flight: Option<i32>) -> Self {
        Self {
            source,
            time,
            term,
            flight,
            derivatives: 0,
            integrals: 0,
        }
    }

    pub fn term(&self) -> Term {
        self.term
    }

    pub fn time(&self) -> Symbol {
        self.time
    }

    /// Whether it is a law of a flight.
    pub fn flies(&self) -> bool {
        self.flight.is_some()
    }

    /// Whether it is a premise, rather than derived.
    pub fn is_given(&self) -> bool {
        matches!(self.source, LawSource::Given { .. })
    }
}

/// The values of unknown functions in a term.
pub fn values_of(statement: &Statement, term: Term) -> Vec<(Function, u32, Term)> {
    let terms = statement.terms();
    let inside = terms
        .inside(term)
        .into_iter()
        .filter_map(|inner| match terms.node(inner) {
            Node::Value(function, order, at) => Some((*function, *order, *at)),
            _ => None,
        });
    inside.collect()
}

/// Adds instances of the laws at the times that the facts and the goals speak of. Gives the laws.
pub fn instantiate(session: &mut Session, goals: &[Polynomial]) -> Vec<Usable> {
    sequences(session, goals);
    given_laws(session, goals);
    integrate(session, goals);
    derivatives(session, goals);
    constants::find(session);
    let laws = session.laws.all.clone();
    // a law that names a function brings the functions in its own formula along
    for _ in 0..3 {
        let count = session.checker.facts.len();
        at_arguments(session, &laws, goals);
        if session.checker.facts.len() == count {
            break;
        }
    }
    merge(session, goals);
    whole_periods(session, &laws, goals);
    laws
}

/// The values of unknown functions among the generators: function, order, argument.
fn values(session: &Session, goals: &[Polynomial]) -> BTreeSet<(Function, u32, Term)> {
    let terms = session.checker.statement.terms();
    let mut found = BTreeSet::new();
    for generator in session.generators(goals) {
        for inner in terms.inside(generator) {
            if let Node::Value(function, order, at) = terms.node(inner) {
                found.insert((*function, *order, *at));
            }
        }
    }
    found
}

/// The impacts that the facts and goals speak of.
fn impacts(session: &Session, goals: &[Polynomial]) -> BTreeSet<i32> {
    let statement = &session.checker.statement;
    let mut found: BTreeSet<i32> = BTreeSet::new();
    let goal_terms: Vec<Term> = statement.goal().iter().map(|(_, term)| *term).collect();
    for generator in session.generators(goals).into_iter().chain(goal_terms) {
        for inner in statement.terms().inside(generator) {
            match statement.terms().node(inner) {
                Node::Symbol(symbol) => {
                    if let Some(Quantity::State { index, .. } | Quantity::Time { index, .. }) =
                        statement.quantity(*symbol)
                    {
                        found.insert(*index);
                    }
                }
                Node::Value(function, ..) => {
                    if let Some(FunctionOf::Flight { impact, .. }) = statement.functions().get(function.0 as usize) {
                        found.insert(*impact);
                    }
                }
                _ => {}
            }
        }
    }
    found
}

/// Recursions over an index, at every shift that stays within what is spoken of.
fn sequences(session: &mut Session, goals: &[Polynomial]) {
    let spoken = impacts(session, goals);
    let (Some(&first), Some(&last)) = (spoken.first(), spoken.last()) else {
        return;
    };
    for given in 0..session.checker.statement.givens().len() {
        let law = session.checker.statement.givens()[given].law.clone();
        if law.is_none_or(|law| law.time.is_some() || !law.every_impact) {
            continue;
        }
        for shift in (first - last - 2)..=(last - first + 2) {
            let source = LawSource::Given { given, shift };
            let mark = session.checker.mark();
            if session.step(Inference::Law { source, at: None }).is_err() {
                session.checker.back_to(mark);
            }
        }
    }
}

fn given_laws(session: &mut Session, goals: &[Polynomial]) {
    let spoken = impacts(session, goals);
    let flights: Vec<i32> = match (spoken.first(), spoken.last()) {
        (Some(&first), Some(&last)) => (first..last.max(first + 1)).collect(),
        _ => vec![0],
    };
    for given in 0..session.checker.statement.givens().len() {
        let entry = session.checker.statement.givens()[given].clone();
        let Some(law) = entry.law.filter(|_| entry.property == Property::Zero) else {
            continue;
        };
        let Some(time) = law.time else { continue };
        let base = law.flight.unwrap_or(0);
        let shifts: Vec<i32> = match (law.every_impact, law.flight) {
            (true, Some(_)) => flights.iter().map(|flight| flight - base).collect(),
            _ => vec![0],
        };
        for shift in shifts {
            if !session.laws.taken.insert((shift, given)) {
                continue;
            }
            let written = session.checker.statement.written_out(entry.term);
            let term = session.checker.statement.moved(written, None, shift);
            session.laws.all.push(Usable {
                source: LawSource::Given { given, shift },
                time,
                term,
                flight: law.flight.map(|flight| flight + shift),
                derivatives: 0,
                integrals: 0,
            });
        }
    }
}

/// The law as a polynomial, its numerator.
fn polynomial(session: &mut Session, term: Term) -> Option<Polynomial> {
    let mut expansion = crate::kernel::Expansion::new(BTreeSet::new(), 1_000_000);
    let quotient = expansion.of(session.checker.statement.terms(), term).ok()?;
    Some(quotient.numerator)
}

/// Laws at the times at which the functions they are about have values in what is to be shown.
fn at_arguments(session: &mut Session, laws: &[Usable], goals: &[Polynomial]) {
    let known = values(session, goals);
    for law in laws {
        let own: Vec<(Function, u32, Term)> = values_in(session, law.term, law.time);
        let recurrent = own
            .iter()
            .any(|(f, n, u)| own.iter().any(|(g, m, v)| (f, n) == (g, m) && u != v));
        let mut times: BTreeSet<Term> = BTreeSet::new();
        if let Some(flight) = law.flight {
            for index in [flight, flight + 1] {
                if let Some(&time) = session.checker.statement.times().get(&index) {
                    times.insert(session.terms().symbol(time));
                }
            }
            if session.checker.statement.flight() == Some(flight)
                && let Some(running) = running(session)
            {
                times.insert(session.terms().symbol(running));
            }
        } else {
            for (function, order, inner) in &own {
                for (_, _, at) in known.iter().filter(|(f, n, _)| (f, n) == (function, order)) {
                    if let Some(time) = solved(session, *inner, law.time, *at)
                        && (!recurrent || reflects(session, *inner, law.time))
                    {
                        times.insert(time);
                    }
                }
            }
            if own.is_empty() {
                continue;
            }
        }
        for at in times {
            instance(session, law, at);
        }
    }
}

/// Whether a time stands with another slope than 1: such a law is taken once at each argument.
fn reflects(session: &mut Session, inner: Term, time: Symbol) -> bool {
    let slope = session.checker.statement.derivative(inner, time);
    polynomial(session, slope).is_none_or(|slope| slope != Polynomial::integer(1))
}

fn running(session: &Session) -> Option<Symbol> {
    let at = session
        .checker
        .statement
        .quantities()
        .iter()
        .position(|known| *known == Quantity::Running)?;
    u32::try_from(at).ok().map(Symbol)
}

/// Laws at a running time, and at the times that the values in a polynomial, which depend on it, ask for.
pub fn at_running(session: &mut Session, laws: &[Usable], of: &Polynomial, running: Symbol) {
    let time = session.terms().symbol(running);
    for _ in 0..2 {
        let known = values(session, std::slice::from_ref(of));
        for law in laws {
            let mut times = BTreeSet::new();
            if law.flies() {
                times.insert(time);
            }
            for (function, order, inner) in values_in(session, law.term, law.time) {
                for (_, _, at) in known.iter().filter(|(f, n, _)| (*f, *n) == (function, order)) {
                    if session.checker.statement.terms().holds(*at, running)
                        && let Some(at) = solved(session, inner, law.time, *at)
                    {
                        times.insert(at);
                    }
                }
            }
            for at in times {
                instance(session, law, at);
            }
        }
    }
}

pub fn instance(session: &mut Session, law: &Usable, at: Term) -> Option<usize> {
    let step = Inference::Law {
        source: law.source,
        at: Some(at),
    };
    if let Some(known) = session.steps.iter().position(|known| *known == step) {
        let _ = known;
        return None;
    }
    if let Ok(found) = session.step(step.clone()) {
        return Some(found);
    }
    // what an instance needs may follow from what is known
    let LawSource::Given { given, shift } = law.source else {
        return None;
    };
    let (.., conditions) = session.checker.statement.instance(given, Some(at), shift, None)?;
    for (property, of) in conditions {
        if session.checker.knows(property, of).ok()? {
            continue;
        }
        match property {
            Property::Positive | Property::NonNegative => {
                let signed = session.signed_numerator(of)?;
                session.show_sign(&signed, property == Property::Positive)?;
            }
            Property::Nonzero => {
                let numerator = session.numerator(of)?;
                if session.show_nonzero(&numerator).is_none() {
                    session.nonzero_fact(&numerator)?;
                }
            }
            Property::Zero | Property::Integer => return None,
        }
    }
    session.step(step).ok()
}

fn values_in(session: &Session, term: Term, time: Symbol) -> Vec<(Function, u32, Term)> {
    let terms = session.checker.statement.terms();
    let inside = terms
        .inside(term)
        .into_iter()
        .filter_map(|inner| match terms.node(inner) {
            Node::Value(function, order, at) if terms.holds(*at, time) => Some((*function, *order, *at)),
            _ => None,
        });
    inside.collect()
}

/// The time at which an argument that is affine in the time of a law has a value.
fn solved(session: &mut Session, inner: Term, time: Symbol, at: Term) -> Option<Term> {
    let of_time = session.terms().symbol(time);
    if inner == of_time {
        return Some(at);
    }
    let form = polynomial(session, inner)?;
    if degree_in(&form, of_time) != 1 {
        return None;
    }
    let coefficients = coefficients_in(&form, of_time);
    let slope = coefficients.get(1)?.as_constant()?;
    if slope.is_zero()
        || form
            .generators()
            .iter()
            .any(|&term| term != of_time && session.checker.statement.terms().holds(term, time))
    {
        return None;
    }
    let rest = polynomial_term(session, &coefficients[0]);
    let difference = session.terms().difference(at, rest);
    // simplified, so that t + T at t_k - T is t_k
    let simple = polynomial(session, difference)?.scaled(&(<Rational as Field>::from_integer(1) / slope));
    Some(polynomial_term(session, &simple))
}

/// Laws for the derivatives of functions that a law says something of, where these are spoken of.
fn derivatives(session: &mut Session, goals: &[Polynomial]) {
    let known = values(session, goals);
    let mut number = 0;
    // a law and those derived from it, each once
    while let Some(law) = session.laws.all.get(number).cloned() {
        let own = values_in(session, law.term, law.time);
        let mut next: BTreeSet<(Function, u32)> = BTreeSet::new();
        for (function, order, at) in own {
            let value = session.checker.statement.value(function, order + 1, at);
            if let Node::Value(function, order, _) = session.node(value) {
                next.insert((function, order));
            }
        }
        let wanted = known
            .iter()
            .any(|(f, n, _)| next.iter().any(|(g, m)| g == f && m <= n) || reaches(session, &next, *f));
        if wanted
            && law.derivatives < MOST_DERIVATIVES
            && session.laws.differentiated.insert(number)
            && session.step_law(Inference::Derivative(law.source)).is_some()
        {
            let source = LawSource::Derived(session.checker.laws() - 1);
            let term = session.checker.statement.derivative(law.term, law.time);
            session.laws.all.push(Usable {
                source,
                term,
                derivatives: law.derivatives + 1,
                ..law
            });
        }
        number += 1;
    }
}

/// Whether one of the functions has the other as a derivative.
fn reaches(session: &Session, from: &BTreeSet<(Function, u32)>, to: Function) -> bool {
    from.iter().any(|(function, _)| {
        // a function may be a derivative of its own
        let (mut current, mut seen) = (Some(*function), BTreeSet::new());
        while let Some(f) = current.filter(|f| seen.insert(*f)) {
            if f == to {
                return true;
            }
            current = session.checker.statement.derivatives().get(&f).copied();
        }
        false
    })
}

impl Session<'_> {
    /// Adds a step that makes a law.
    pub fn step_law(&mut self, step: Inference) -> Option<()> {
        self.checker.apply(&step).ok()?;
        self.steps.push(step);
        Some(())
    }
}

/// Equal arguments have equal values.
fn merge(session: &mut Session, goals: &[Polynomial]) {
    let mut groups: BTreeMap<(Function, u32), Vec<(Term, Polynomial)>> = BTreeMap::new();
    for (function, order, at) in values(session, goals) {
        let Some(form) = session.numerator(at) else { continue };
        let Some(form) = session.normal_form(&form) else {
            continue;
        };
        groups.entry((function, order)).or_default().push((at, form));
    }
    for ((function, order), members) in groups {
        for (n, (a, form)) in members.iter().enumerate() {
            let Some((b, _)) = members[..n].iter().find(|(_, other)| other == form) else {
                continue;
            };
            if session.show_equal(*a, *b).is_some() {
                let left = session.terms().add(Node::Value(function, order, *a));
                let right = session.terms().add(Node::Value(function, order, *b));
                let _ = session.step(Inference::Congruence { left, right });
            }
        }
    }
}

/// Chains of a recurrent law between two values that are whole periods apart.
fn whole_periods(session: &mut Session, laws: &[Usable], goals: &[Polynomial]) {
    for law in laws {
        let own = values_in(session, law.term, law.time);
        for (n, &(function, order, u)) in own.iter().enumerate() {
            for &(g, m, v) in own.iter().skip(n + 1) {
                if (function, order) != (g, m) || reflects(session, u, law.time) || reflects(session, v, law.time) {
                    continue;
                }
                let apart = session.terms().difference(u, v);
                let Some(period) = polynomial(session, apart).and_then(|form| session.normal_form(&form)) else {
                    continue;
                };
                if !period.is_zero() {
                    chains(session, law, (function, order), [u, v], &period, goals);
                }
            }
        }
    }
}

fn chains(
    session: &mut Session,
    law: &Usable,
    of: (Function, u32),
    [u, _]: [Term; 2],
    period: &Polynomial,
    goals: &[Polynomial],
) {
    let members: Vec<Term> = values(session, goals)
        .into_iter()
        .filter(|(f, n, _)| (*f, *n) == of)
        .map(|(_, _, at)| at)
        .collect();
    let forms: Vec<Option<Polynomial>> = members
        .iter()
        .map(|&at| session.numerator(at).and_then(|form| session.normal_form(&form)))
        .collect();
    let mut added = false;
    for (n, a) in members.iter().enumerate() {
        for (m, b) in members.iter().enumerate() {
            let (Some(fa), Some(fb)) = (&forms[n], &forms[m]) else {
                continue;
            };
            let difference = fa.minus(fb);
            let turns = (1..=MOST_PERIODS).find(|&turns| difference == period.scaled(&Rational::from_integer(turns)));
            let Some(turns) = turns else { continue };
            // from b upwards: u at b + period, b + 2 period, ..., a
            let period_term = polynomial_term(session, period);
            for turn in 1..=turns {
                let factor = session.terms().integer(turn);
                let moved = session.terms().product(vec![factor, period_term]);
                let at = if turn == turns {
                    *a
                } else {
                    session.terms().sum(vec![*b, moved])
                };
                if let Some(time) = solved(session, u, law.time, at) {
                    added |= instance(session, law, time).is_some();
                }
            }
        }
    }
    if added {
        merge(session, goals);
    }
}

/// Integrates laws that give a function, as far as its declared antiderivatives, or the motion of a flight, are spoken of.
fn integrate(session: &mut Session, goals: &[Polynomial]) {
    let mut number = 0;
    while let Some(law) = session.laws.all.get(number).cloned() {
        if law.derivatives == 0
            && law.integrals < MOST_INTEGRALS
            && !session.laws.integrated.contains(&number)
            && let Some(integral) = integral(session, &law, goals)
        {
            session.laws.integrated.insert(number);
            session.laws.all.push(integral);
        }
        number += 1;
    }
}

/// The law for the antiderivative of the function that a law gives.
fn integral(session: &mut Session, law: &Usable, goals: &[Polynomial]) -> Option<Usable> {
    let time = session.terms().symbol(law.time);
    let form = polynomial(session, law.term)?;
    // function(t) = formula: a value at t itself, times a number
    let (function, order, lead) = form
        .terms()
        .iter()
        .find_map(|(monomial, value)| match monomial.as_slice() {
            [(generator, 1)] => match session.node(*generator) {
                Node::Value(function, order, at) if at == time => {
                    let others = form
                        .terms()
                        .iter()
                        .filter(|(m, _)| m.iter().any(|(g, _)| g == generator))
                        .count();
                    (others == 1 && has_integral(session, function, order)).then(|| (function, order, value.clone()))
                }
                _ => None,
            },
            _ => None,
        })?;
    let (outer, outer_order) = antiderivative(session, function, order)?;
    if law.flight.is_none()
        && !values(session, goals)
            .iter()
            .any(|(f, n, _)| leads_to(session, (*f, *n), (outer, outer_order)))
    {
        return None;
    }
    let value = session.checker.statement.value(function, order, time);
    let rest = form
        .scaled(&Rational(dashu_ratio::RBig::ONE / lead))
        .minus(&Polynomial::generator(value));
    let formula = antiderivative_of(session, &rest.negated(), law.time)?;
    let fresh = session.checker.statement.fresh("t");
    let running = session.terms().symbol(fresh);
    let whole = session.checker.statement.value(outer, outer_order, time);
    let whole = session.terms().difference(whole, formula);
    // the values of a flight at its end are those of the states there only once the time is put in
    let of = session.terms().substitute(whole, law.time, running);
    let at = match law.flight {
        Some(flight) => {
            let start = *session.checker.statement.times().get(&flight)?;
            session.terms().symbol(start)
        }
        None => session.terms().integer(0),
    };
    let constant = constants::constant(session, of, fresh, at, law.flight)?;
    Some(Usable {
        integrals: law.integrals + 1,
        ..constant
    })
}

fn has_integral(session: &Session, function: Function, order: u32) -> bool {
    antiderivative(session, function, order).is_some()
}

/// The function of which another is the derivative.
fn antiderivative(session: &Session, function: Function, order: u32) -> Option<(Function, u32)> {
    if order > 0 {
        return Some((function, order - 1));
    }
    let found = session
        .checker
        .statement
        .derivatives()
        .iter()
        .find(|(_, next)| **next == function);
    found.map(|(outer, _)| (*outer, 0))
}

/// Whether a value is one of the function or of an antiderivative of it.
fn leads_to(session: &Session, (function, order): (Function, u32), to: (Function, u32)) -> bool {
    let mut current = Some(to);
    for _ in 0..6 {
        if current == Some((function, order)) {
            return true;
        }
        current = current.and_then(|(f, n)| antiderivative(session, f, n));
    }
    false
}

/// An antiderivative of a sum of powers of the time, sines, cosines and exponentials of affine arguments, and values of
/// functions that are declared derivatives.
pub fn antiderivative_of(session: &mut Session, form: &Polynomial, time: Symbol) -> Option<Term> {
    let of_time = session.terms().symbol(time);
    let mut parts = Vec::new();
    for (monomial, value) in form.terms() {
        let (moving, fixed): (Vec<(Term, u32)>, Vec<(Term, u32)>) = monomial
            .iter()
            .copied()
            .partition(|(term, _)| session.checker.statement.terms().holds(*term, time));
        let constant = Polynomial::from_terms([(fixed.into_iter().collect(), value.clone())]);
        let constant = polynomial_term(session, &constant);
        let integral = match moving.as_slice() {
            [] => of_time,
            [(term, power)] if *term == of_time => {
                let exponent = i32::try_from(*power).ok()? + 1;
                let raised = session.terms().add(Node::Power(of_time, exponent));
                let below = session.terms().integer(i64::from(exponent));
                session.terms().quotient(raised, below)
            }
            [(term, 1)] => integral_of(session, *term, time)?,
            _ => return None,
        };
        parts.push(session.terms().product(vec![constant, integral]));
    }
    Some(session.terms().sum(parts))
}

fn integral_of(session: &mut Session, term: Term, time: Symbol) -> Option<Term> {
    let (inner, outer) = match session.node(term) {
        Node::Elementary(function, of) => {
            let outer = match function {
                Elementary::Sin => {
                    let cosine = session.terms().elementary(Elementary::Cos, of);
                    session.terms().negative(cosine)
                }
                Elementary::Cos => session.terms().elementary(Elementary::Sin, of),
                Elementary::Exp => term,
                _ => return None,
            };
            (of, outer)
        }
        Node::Value(function, order, at) => {
            let (function, order) = antiderivative(session, function, order)?;
            (at, session.checker.statement.value(function, order, at))
        }
        _ => return None,
    };
    let slope = session.checker.statement.derivative(inner, time);
    let form = polynomial(session, slope)?;
    if form.is_zero()
        || form
            .generators()
            .iter()
            .any(|&g| session.checker.statement.terms().holds(g, time))
    {
        return None;
    }
    if form == Polynomial::integer(1) {
        return Some(outer);
    }
    Some(session.terms().quotient(outer, slope))
}
