//! Values of unknown functions: instances of laws, equal arguments, whole periods, integrals of laws.

use super::angles;
use super::laws::Usable;
use super::session::Session;
use crate::algebra::{coefficients_in, degree_in};
use kernel::{
    Elementary, Function, FunctionOf, Inference, LawSource, Monomial, Node, Polynomial, Property, Quantity, Statement,
    Symbol, Term,
};
use num_traits::Zero;
use numbers::{Field, Rational};
use std::collections::{BTreeMap, BTreeSet};

/// The most whole periods between two times that are tried, of each of one, two or three periods.
const MOST_TURNS: [i64; 3] = [8, 6, 2];

/// How often a law is integrated, and differentiated: a motion has two integrals, its forcing two more.
const MOST_INTEGRALS: u8 = 4;
const MOST_DERIVATIVES: u8 = 3;

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
    self::laws(session, goals);
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

/// The laws that are given, their integrals and derivatives.
pub fn laws(session: &mut Session, goals: &[Polynomial]) {
    given_laws(session, goals);
    integrate(session, goals);
    derivatives(session, goals);
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

/// What the facts and goals speak of.
fn spoken(session: &Session, goals: &[Polynomial]) -> Vec<Term> {
    let goal_terms = session.checker.statement.goal().iter().map(|(_, term)| *term);
    session.generators(goals).into_iter().chain(goal_terms).collect()
}

/// The impacts that the facts and goals speak of.
fn impacts(session: &Session, goals: &[Polynomial]) -> BTreeSet<i32> {
    let statement = &session.checker.statement;
    spoken(session, goals)
        .into_iter()
        .flat_map(|term| indices(statement, term))
        .collect()
}

/// The states at impacts that the facts and goals speak of.
fn states(session: &Session, goals: &[Polynomial]) -> BTreeSet<(usize, i32)> {
    let statement = &session.checker.statement;
    let inside = spoken(session, goals)
        .into_iter()
        .flat_map(|term| statement.terms().inside(term));
    let state = |inner: Term| match statement.terms().node(inner) {
        Node::Symbol(symbol) => statement.number_of(*symbol),
        _ => None,
    };
    inside.filter_map(state).collect()
}

/// The impacts that a term speaks of.
fn indices(statement: &Statement, term: Term) -> BTreeSet<i32> {
    let mut found: BTreeSet<i32> = BTreeSet::new();
    for inner in statement.terms().inside(term) {
        match statement.terms().node(inner) {
            Node::Symbol(symbol) => {
                if let Some(Quantity::Member { offset, .. }) = statement.quantity(*symbol) {
                    found.insert(offset);
                }
            }
            Node::Value(function, ..) => {
                if let Some(FunctionOf::Interval { offset, .. }) = statement.functions().get(function.0 as usize) {
                    found.insert(*offset);
                }
            }
            _ => {}
        }
    }
    found
}

/// Recursions over an index, at every shift that stays within what the goals and premises speak of, and two beyond
/// where the recursion is linear.
fn sequences(session: &mut Session, goals: &[Polynomial]) {
    if session.laws.spoken.is_empty() {
        session.laws.spoken = impacts(session, goals);
    }
    let spoken = session.laws.spoken.clone();
    let (Some(&first), Some(&last)) = (spoken.first(), spoken.last()) else {
        return;
    };
    for given in 0..session.checker.statement.givens().len() {
        let entry = session.checker.statement.givens()[given].clone();
        if entry.law.is_none_or(|law| law.time.is_some() || !law.every_index) {
            continue;
        }
        let written = session.checker.statement.written_out(entry.term);
        let own = indices(session.checker.statement, written);
        let (Some(low), Some(high)) = (own.first(), own.last()) else {
            continue;
        };
        let margin = match polynomial(session, written) {
            Some(form) if form.degree() == 1 => 2,
            _ => 0,
        };
        for shift in (first - margin - low)..=(last + margin - high) {
            if !session.laws.taken.insert((shift, given)) {
                continue;
            }
            let source = LawSource::Given { given, shift };
            let step = Inference::Law { source, at: None };
            if session.step(step.clone()).is_err() {
                let shown = session.show_conditions(source, None);
                if shown.is_none() || session.step(step).is_err() {
                    // what it needs may be known later
                    session.laws.taken.remove(&(shift, given));
                }
            }
        }
    }
}

fn given_laws(session: &mut Session, goals: &[Polynomial]) {
    let (spoken, states) = (impacts(session, goals), states(session, goals));
    let flights: Vec<i32> = match (spoken.first(), spoken.last()) {
        (Some(&first), Some(&last)) => {
            // a law is first of all one of the flight that it is written of
            let named = session.checker.statement.functions().iter().filter_map(|of| match of {
                FunctionOf::Interval { offset, .. } => Some(offset + 1),
                FunctionOf::Line => None,
            });
            let last = named.fold(last.max(first + 1), i32::max);
            (first - 1..last).collect()
        }
        _ => vec![0],
    };
    for given in 0..session.checker.statement.givens().len() {
        let entry = session.checker.statement.givens()[given].clone();
        let Some(law) = entry.law.filter(|_| entry.property == Property::Zero) else {
            continue;
        };
        let Some(time) = law.time else { continue };
        let base = law.interval.unwrap_or(0);
        let shifts: Vec<i32> = match (law.every_index, law.interval) {
            (true, Some(_)) => flights.iter().map(|flight| flight - base).collect(),
            _ => vec![0],
        };
        for shift in shifts {
            if !session.laws.taken.insert((shift, given)) {
                continue;
            }
            let written = session.checker.statement.written_out(entry.term);
            let flight = law.interval.map(|flight| flight + shift);
            // of the flight before all others a law tells where it brings nothing else along
            if flight.is_some() && flight < flights.get(1).copied() {
                let is_own = indices(session.checker.statement, written) == BTreeSet::from([base]);
                if !is_own || !has_end(session, written, time, &states, flight) {
                    continue;
                }
            }
            let term = session.checker.statement.moved(written, None, shift);
            session.laws.all.push(Usable {
                source: LawSource::Given { given, shift },
                time,
                term,
                flight,
                derivatives: 0,
                integrals: 0,
            });
        }
    }
}

/// Whether a law tells of one of these states at the end of a flight, itself or by its derivatives.
fn has_end(session: &Session, law: Term, time: Symbol, states: &BTreeSet<(usize, i32)>, flight: Option<i32>) -> bool {
    let values = values_in(session, law, time).into_iter();
    let mut named = values.flat_map(|(function, order, _)| {
        (0..=MOST_DERIVATIVES).filter_map(move |more| end_states(session, function, order + u32::from(more)))
    });
    named.any(|(ends, _)| {
        let is_met = |state: usize| flight.is_some_and(|flight| states.contains(&(state, flight + 1)));
        ends.into_iter().any(is_met)
    })
}

/// The law as a polynomial, its numerator.
fn polynomial(session: &mut Session, term: Term) -> Option<Polynomial> {
    let mut expansion = kernel::Expansion::new(BTreeSet::new(), 1_000_000);
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
                if let Some(&time) = session.checker.statement.instants().get(&index) {
                    times.insert(session.terms().symbol(time));
                }
            }
            if session.checker.statement.interval() == Some(flight)
                && let Some(running) = session.checker.statement.running()
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
    session.show_conditions(law.source, Some(at))?;
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
    let rest = session.polynomial_term(&coefficients[0]);
    let difference = session.terms().difference(at, rest);
    // simplified, so that t + T at t_k - T is t_k
    let simple = polynomial(session, difference)?.scaled(&(<Rational as Field>::from_integer(1) / slope));
    Some(session.polynomial_term(&simple))
}

/// Laws for the derivatives of functions that a law says something of, where these are spoken of.
fn derivatives(session: &mut Session, goals: &[Polynomial]) {
    let known = values(session, goals);
    let states = states(session, goals);
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
        let ends = |(function, order): &(Function, u32)| {
            end_states(session, *function, *order).is_some_and(|(ends, flight)| {
                let is_met = |state| {
                    [flight, flight + 1]
                        .into_iter()
                        .any(|index| states.contains(&(state, index)))
                };
                ends.into_iter().any(is_met)
            })
        };
        let wanted = wanted || (law.integrals == 0 && next.iter().any(ends));
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

/// The states that a derivative of a function of flight is at the ends of the flight, and the impact that it follows.
fn end_states(session: &Session, function: Function, order: u32) -> Option<([usize; 2], i32)> {
    let statement = &session.checker.statement;
    match *statement.functions().get(function.0 as usize)? {
        FunctionOf::Interval { piecewise, offset } => {
            let ends = &statement.piecewise().get(piecewise)?.ends;
            Some((ends.get(order as usize).copied()??, offset))
        }
        FunctionOf::Line => None,
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
    // quotients have no form of their own: their differences are looked at
    type Argument = (Term, Option<Polynomial>);
    let mut groups: BTreeMap<(Function, u32), Vec<Argument>> = BTreeMap::new();
    for (function, order, at) in values(session, goals) {
        let form = session.value_form(at);
        groups.entry((function, order)).or_default().push((at, form));
    }
    for ((function, order), members) in groups {
        for (n, (a, form)) in members.iter().enumerate() {
            let mut equal = members[..n].iter().filter(|(b, other)| match (form, other) {
                (Some(form), Some(other)) => form == other,
                _ => n < MOST_COMPARED && session.is_difference_zero(*a, *b),
            });
            let Some((b, _)) = equal.next() else {
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

/// Values of one function of which the arguments are quotients, compared with each other.
const MOST_COMPARED: usize = 12;

/// A law that says something of a function at two times that are a fixed time apart.
struct Recurrence {
    law: Usable,
    later: Term,
    apart: Polynomial,
}

/// Chains of recurrent laws between two values that whole multiples of their periods lie between.
fn whole_periods(session: &mut Session, laws: &[Usable], goals: &[Polynomial]) {
    let mut recurrences: BTreeMap<(Function, u32), Vec<Recurrence>> = BTreeMap::new();
    for law in laws {
        let own = values_in(session, law.term, law.time);
        for (n, &(function, order, u)) in own.iter().enumerate() {
            for &(g, m, v) in own.iter().skip(n + 1) {
                if (function, order) != (g, m) || reflects(session, u, law.time) || reflects(session, v, law.time) {
                    continue;
                }
                let apart = session.terms().difference(u, v);
                let Some(apart) = polynomial(session, apart).and_then(|form| session.normal_form(&form)) else {
                    continue;
                };
                if !apart.is_zero() {
                    let known = recurrences.entry((function, order)).or_default();
                    if !known.iter().any(|known| known.apart == apart) {
                        let law = law.clone();
                        known.push(Recurrence { law, later: u, apart });
                    }
                }
            }
        }
    }
    for (of, mut recurrences) in recurrences {
        recurrences.truncate(MOST_TURNS.len());
        chains(session, of, &recurrences, goals);
    }
}

/// Integers within a bound, those of smaller sum first.
fn turns(count: usize) -> Vec<Vec<i64>> {
    let most = MOST_TURNS[count - 1];
    let mut all: Vec<Vec<i64>> = vec![Vec::new()];
    for _ in 0..count {
        let longer = |turns: &Vec<i64>| {
            let turns = turns.clone();
            (-most..=most).map(move |turn| [turns.clone(), vec![turn]].concat())
        };
        all = all.iter().flat_map(longer).collect();
    }
    all.sort_by_key(|turns| turns.iter().map(|turn| turn.abs()).sum::<i64>());
    all
}

fn chains(session: &mut Session, of: (Function, u32), recurrences: &[Recurrence], goals: &[Polynomial]) {
    let members: Vec<Term> = values(session, goals)
        .into_iter()
        .filter(|(f, n, _)| (*f, *n) == of)
        .map(|(_, _, at)| at)
        .collect();
    let forms: Vec<Option<Polynomial>> = members
        .iter()
        .map(|&at| session.numerator(at).and_then(|form| session.normal_form(&form)))
        .collect();
    let turns: Vec<(Vec<i64>, Polynomial)> = turns(recurrences.len())
        .into_iter()
        .map(|turns| {
            let parts = turns.iter().zip(recurrences);
            let sum = parts.fold(Polynomial::default(), |sum, (turn, recurrence)| {
                sum.plus(&recurrence.apart.scaled(&Rational::from_integer(*turn)))
            });
            (turns, sum)
        })
        .collect();
    let mut added = false;
    for (n, a) in members.iter().enumerate() {
        for (m, b) in members.iter().enumerate().skip(n + 1) {
            let (Some(fa), Some(fb)) = (&forms[n], &forms[m]) else {
                continue;
            };
            let difference = fa.minus(fb);
            let Some((turns, _)) = turns.iter().find(|(_, sum)| *sum == difference) else {
                continue;
            };
            // from b step by step, the last one to a itself
            let steps: Vec<(usize, bool)> = turns
                .iter()
                .enumerate()
                .flat_map(|(place, turn)| std::iter::repeat_n((place, *turn > 0), turn.unsigned_abs() as usize))
                .collect();
            let (mut at, mut from) = (fb.clone(), *b);
            for (step, (place, forward)) in steps.iter().enumerate() {
                let Recurrence { law, later, apart } = &recurrences[*place];
                at = if *forward { at.plus(apart) } else { at.minus(apart) };
                let to = match step + 1 == steps.len() {
                    true => *a,
                    false => session.polynomial_term(&at),
                };
                let high = if *forward { to } else { from };
                if let Some(time) = solved(session, *later, law.time, high) {
                    added |= instance(session, law, time).is_some();
                }
                from = to;
            }
        }
    }
    if added {
        merge(session, goals);
    }
}

/// The law that a term in a fresh symbol is at every time what it is at `at`, if laws show its derivative to vanish.
pub fn constant(session: &mut Session, of: Term, time: Symbol, at: Term, flight: Option<i32>) -> Option<Usable> {
    let slope = session.checker.statement.derivative(of, time);
    let numerator = session.numerator(slope)?;
    let laws = session.laws.all().to_vec();
    let steps = session.aside(flight.map(|flight| (time, flight)), &mut |session| {
        at_running(session, &laws, &numerator, time);
        session.triangulate_all();
        if session.show_zero(&numerator).is_some() {
            return Some(());
        }
        let met: BTreeSet<Term> = numerator.generators().into_iter().collect();
        angles::expand(session, &met);
        session.triangulate_all();
        session.show_zero(&numerator).map(|_| ())
    })?;
    session.step_law(Inference::Constant {
        of,
        time,
        at,
        interval: flight,
        steps,
    })?;
    let source = LawSource::Derived(session.checker.laws() - 1);
    let there = session.checker.statement.moved(of, Some((time, at)), 0);
    let term = session.terms().difference(of, there);
    Some(Usable::derived(source, time, term, flight))
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
    // lead function(t) = formula: a value at t itself, times what does not depend on t
    let (function, order, lead) = form.generators().into_iter().find_map(|generator| {
        let Node::Value(function, order, at) = session.node(generator) else {
            return None;
        };
        let coefficients = coefficients_in(&form, generator);
        let lead = coefficients.get(1).filter(|_| coefficients.len() == 2 && at == time)?;
        (fixed(session, lead, law.time) && has_integral(session, function, order))
            .then(|| (function, order, lead.clone()))
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
    let rest = form.minus(&lead.times(&Polynomial::generator(value)));
    let formula = antiderivative_of(session, &rest.negated(), law.time)?;
    let formula = match lead.as_constant() {
        Some(lead) => {
            let factor = session.terms().number(Rational::from_integer(1) / lead);
            times(session, factor, formula)
        }
        None => {
            let lead = session.polynomial_term(&lead);
            session.terms().quotient(formula, lead)
        }
    };
    let fresh = session.checker.statement.fresh("t");
    let running = session.terms().symbol(fresh);
    let whole = session.checker.statement.value(outer, outer_order, time);
    let whole = session.terms().difference(whole, formula);
    // the values of a flight at its end are those of the states there only once the time is put in
    let of = session.terms().substitute(whole, law.time, running);
    let at = match law.flight {
        Some(flight) => {
            let start = *session.checker.statement.instants().get(&flight)?;
            session.terms().symbol(start)
        }
        None => session.terms().integer(0),
    };
    let constant = constant(session, of, fresh, at, law.flight)?;
    Some(Usable {
        integrals: law.integrals + 1,
        ..constant
    })
}

/// Whether nothing in a polynomial depends on a time.
fn fixed(session: &Session, polynomial: &Polynomial, time: Symbol) -> bool {
    let terms = session.checker.statement.terms();
    !polynomial.generators().iter().any(|&term| terms.holds(term, time))
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

/// An antiderivative of a sum of: powers of the time, times products of sines and cosines of affine arguments, or an
/// exponential of one; values of functions that are declared derivatives.
pub fn antiderivative_of(session: &mut Session, form: &Polynomial, time: Symbol) -> Option<Term> {
    let of_time = session.terms().symbol(time);
    let mut parts = Vec::new();
    for (monomial, value) in form.terms() {
        let (moving, fixed): (Monomial, Monomial) = monomial
            .iter()
            .copied()
            .partition(|(term, _)| session.checker.statement.terms().holds(*term, time));
        let constant = Polynomial::from_terms([(fixed, value.clone())]);
        let constant = session.polynomial_term(&constant);
        let power = moving
            .iter()
            .find(|(term, _)| *term == of_time)
            .map_or(0, |(_, power)| *power);
        let factors = moving.iter().filter(|(term, _)| *term != of_time);
        let factors: Vec<Term> = factors
            .flat_map(|(term, power)| std::iter::repeat_n(*term, *power as usize))
            .collect();
        for (number, factor) in sum_of_products(session, &factors)? {
            let number = session.terms().number(number);
            let integral = integral_of(session, factor, power, time)?;
            let integral = times(session, number, integral);
            parts.push(times(session, constant, integral));
        }
    }
    Some(session.terms().sum(parts))
}

/// A product of two terms, of which the first may be 1.
fn times(session: &mut Session, a: Term, b: Term) -> Term {
    match session.terms().integer(1) == a {
        true => b,
        false => session.terms().product(vec![a, b]),
    }
}

/// A product of sines and cosines as a sum of such, times numbers; nothing for 1.
fn sum_of_products(session: &mut Session, factors: &[Term]) -> Option<Vec<(Rational, Option<Term>)>> {
    use Elementary::{Cos, Sin};
    let one = Rational::from_integer(1);
    let Some((&first, rest)) = factors.split_first() else {
        return Some(vec![(one, None)]);
    };
    let half = one.clone() / Rational::from_integer(2);
    let mut sum = vec![(one, Some(first))];
    for &factor in rest {
        let Node::Elementary(g @ (Sin | Cos), b) = session.node(factor) else {
            return None;
        };
        let mut next = Vec::new();
        for (number, term) in sum {
            let Some(Node::Elementary(f @ (Sin | Cos), a)) = term.map(|term| session.node(term)) else {
                next.push((number, Some(factor)));
                continue;
            };
            // DLMF 4.21.15 to 4.21.17
            let (plus, minus) = (session.terms().sum(vec![a, b]), session.terms().difference(a, b));
            let (outer, signs) = match (f, g) {
                (Sin, Sin) => (Cos, [-1, 1]),
                (Cos, Cos) => (Cos, [1, 1]),
                (Sin, _) => (Sin, [1, 1]),
                _ => (Sin, [1, -1]),
            };
            for (angle, sign) in [(plus, signs[0]), (minus, signs[1])] {
                let angle = polynomial(session, angle)?;
                let number = number.clone() * half.clone() * Rational::from_integer(sign);
                if angle.is_zero() {
                    if outer == Cos {
                        next.push((number, None));
                    }
                    continue;
                }
                let angle = session.polynomial_term(&angle);
                next.push((number, Some(session.terms().elementary(outer, angle))));
            }
        }
        sum = next;
    }
    Some(sum)
}

/// The integral of a power of the time times a function of an affine argument, by parts.
fn integral_of(session: &mut Session, of: Option<Term>, power: u32, time: Symbol) -> Option<Term> {
    let of_time = session.terms().symbol(time);
    let exponent = i32::try_from(power).ok()?;
    let Some(term) = of.filter(|&term| session.checker.statement.terms().holds(term, time)) else {
        let integral = match power {
            0 => of_time,
            _ => {
                let raised = session.terms().add(Node::Power(of_time, exponent.checked_add(1)?));
                let below = session.terms().integer(i64::from(power) + 1);
                session.terms().quotient(raised, below)
            }
        };
        return Some(match of {
            Some(factor) => session.terms().product(vec![factor, integral]),
            None => integral,
        });
    };
    let (inner, sign, outer) = match session.node(term) {
        Node::Elementary(Elementary::Sin, at) => (at, -1, session.terms().elementary(Elementary::Cos, at)),
        Node::Elementary(Elementary::Cos, at) => (at, 1, session.terms().elementary(Elementary::Sin, at)),
        Node::Elementary(Elementary::Exp, at) => (at, 1, term),
        Node::Value(function, order, at) if power == 0 => {
            let (function, order) = antiderivative(session, function, order)?;
            (at, 1, session.checker.statement.value(function, order, at))
        }
        _ => return None,
    };
    let slope = session.checker.statement.derivative(inner, time);
    let form = polynomial(session, slope)?;
    if form.is_zero() || !fixed(session, &form, time) {
        return None;
    }
    let sign = session.terms().integer(sign);
    let above = times(session, sign, outer);
    let whole = match form == Polynomial::integer(1) {
        true => above,
        false => session.terms().quotient(above, slope),
    };
    if power == 0 {
        return Some(whole);
    }
    let raised = match exponent {
        1 => of_time,
        _ => session.terms().add(Node::Power(of_time, exponent)),
    };
    let first = session.terms().product(vec![raised, whole]);
    // less the integral of the derivative of the power
    let rest = integral_of(session, Some(outer), power - 1, time)?;
    let number = session.terms().integer(i64::from(power));
    let factor = session.terms().product(vec![sign, number]);
    let factor = session.terms().quotient(factor, slope);
    let rest = session.terms().product(vec![factor, rest]);
    Some(session.terms().difference(first, rest))
}
