//! Constants of motion: terms whose derivative by a time vanishes by the laws, so that they are the same at all times.
//!
//! Complete for: sides of a claim that differ by a constant, where the laws at that time show it by themselves; functions
//! that satisfy a homogeneous linear differential equation of order 1 or 2 whose coefficients are constant and whose
//! characteristic polynomial splits, over the complex numbers, into factors with polynomial coefficients.

use super::session::Session;
use super::values;
use crate::algebra::{coefficients_in, square_root};
use kernel::{Elementary, Function, FunctionOf, Node, Polynomial, Property, Quantity, Symbol, Term};
use numbers::{Field, Rational};
use std::collections::BTreeSet;

/// Laws from the goals, and from linear differential equations, each looked for once.
pub fn find(session: &mut Session, goals: &[Polynomial]) {
    if std::mem::replace(&mut session.laws.constants, true) {
        return;
    }
    values::laws(session, goals);
    linear_equations(session);
    let goals = session.checker.statement.goal().to_vec();
    for (property, goal) in goals {
        if property == Property::Zero {
            same_at_all_times(session, goal);
        }
    }
}

/// The difference of the sides is constant in a symbol at which unknown functions have values.
fn same_at_all_times(session: &mut Session, goal: Term) -> Option<()> {
    let goal = session.checker.statement.written_out(goal);
    let mut symbols: BTreeSet<Symbol> = BTreeSet::new();
    for (_, _, at) in values::values_of(session.checker.statement, goal) {
        let terms = session.checker.statement.terms();
        symbols.extend(
            terms
                .inside(at)
                .into_iter()
                .filter_map(|inner| match terms.node(inner) {
                    Node::Symbol(symbol) => Some(*symbol),
                    _ => None,
                }),
        );
    }
    for symbol in symbols {
        let moves = matches!(
            session.checker.statement.quantity(symbol),
            Some(Quantity::Running | Quantity::Parameter | Quantity::Index)
        );
        if !moves || session.checker.statement.interval().is_some() {
            continue;
        }
        let fresh = session.checker.statement.fresh("t");
        let running = session.terms().symbol(fresh);
        let of = session.terms().substitute(goal, symbol, running);
        let zero = session.terms().integer(0);
        if let Some(law) = values::constant(session, of, fresh, zero, None) {
            let at = session.terms().symbol(symbol);
            values::instance(session, &law, at);
            return Some(());
        }
    }
    None
}

/// The constants of every homogeneous linear differential equation among the laws and declared derivatives.
fn linear_equations(session: &mut Session) {
    let functions: Vec<Function> = (0..session.checker.statement.functions().len())
        .filter_map(|number| u32::try_from(number).ok().map(Function))
        .collect();
    for function in functions {
        let line = matches!(
            session.checker.statement.functions().get(function.0 as usize),
            Some(FunctionOf::Line)
        );
        if !line {
            continue;
        }
        let fresh = session.checker.statement.fresh("t");
        let time = session.terms().symbol(fresh);
        let chain = [0, 1, 2].map(|order| session.checker.statement.value(function, order, time));
        if let Some(coefficients) = equation(session, &chain, time) {
            for of in constants_of(session, &chain, &coefficients, time).unwrap_or_default() {
                let zero = session.terms().integer(0);
                if let Some(law) = values::constant(session, of, fresh, zero, None) {
                    session.laws.push(law);
                }
            }
        }
    }
}

/// The coefficients of the function, and of its derivatives, in a differential equation with leading coefficient 1.
fn equation(session: &mut Session, chain: &[Term; 3], time: Term) -> Option<Vec<Polynomial>> {
    // functions may be their own derivatives, or those of their derivatives
    for order in [1, 2] {
        if let Some(earlier) = chain[..order].iter().position(|value| *value == chain[order]) {
            return Some(
                (0..order)
                    .map(|n| Polynomial::integer(i64::from(n == earlier)))
                    .collect(),
            );
        }
    }
    for law in session.laws.all().to_vec() {
        if law.flies() || !law.is_given() {
            continue;
        }
        let term = session.checker.statement.moved(law.term(), Some((law.time(), time)), 0);
        let Some(form) = session.numerator(term) else { continue };
        let Some(order) = (1..3).rev().find(|&order| form.generators().contains(&chain[order])) else {
            continue;
        };
        let mut rest = form.clone();
        let mut coefficients = Vec::new();
        for value in &chain[..=order] {
            let parts = coefficients_in(&rest, *value);
            let part = parts.get(1).cloned().unwrap_or_default();
            rest = rest.minus(&part.times(&Polynomial::generator(*value)));
            coefficients.push(part);
        }
        let lead = coefficients.pop().and_then(|lead| lead.as_constant());
        let Some(lead) = lead.filter(|lead| !lead.0.is_zero()) else {
            continue;
        };
        let scale = Rational::from_integer(-1) / lead;
        let terms = session.checker.statement.terms();
        let moves = |polynomial: &Polynomial| {
            let moving = |generator: &Term| terms.inside(*generator).contains(&time);
            polynomial.generators().iter().any(moving)
        };
        if rest.is_zero() && !coefficients.iter().any(moves) {
            return Some(coefficients.iter().map(|part| part.scaled(&scale)).collect());
        }
    }
    None
}

/// For x' = c x: x exp(-c t). For x'' = a x' + b x, with h = a/2 and y = x' - h x, times exp(-h t): where h² + b = -w²,
/// w x cos(w t) - y sin(w t) and w x sin(w t) + y cos(w t); where it is w², (y + w x) exp(-w t) and (y - w x) exp(w t);
/// where it is 0, y and x - y t.
fn constants_of(
    session: &mut Session,
    chain: &[Term; 3],
    coefficients: &[Polynomial],
    time: Term,
) -> Option<Vec<Term>> {
    let exponential = |session: &mut Session, rate: &Polynomial| {
        let rate = rate.times(&Polynomial::generator(time));
        let rate = session.polynomial_term(&rate);
        session.terms().elementary(Elementary::Exp, rate)
    };
    let polynomial = |of: Term| Polynomial::generator(of);
    let x = polynomial(chain[0]);
    if let [rate] = coefficients {
        let factor = exponential(session, &rate.negated());
        return Some(vec![session.polynomial_term(&x.times(&polynomial(factor)))]);
    }
    let [b, a] = coefficients else { return None };
    let half = a.scaled(&(Rational::from_integer(1) / Rational::from_integer(2)));
    let y = polynomial(chain[1]).minus(&half.times(&x));
    let discriminant = half.times(&half).plus(b);
    let decay = match half.is_zero() {
        true => Polynomial::integer(1),
        false => polynomial(exponential(session, &half.negated())),
    };
    let most = session.budget.left() / 20;
    let root = |session: &mut Session, of: &Polynomial| {
        let found = session.budget.attempt(most, |steps| square_root(of, steps));
        found.flatten()
    };
    let constants = if discriminant.is_zero() {
        vec![y.clone(), x.minus(&y.times(&polynomial(time)))]
    } else if let Some(w) = root(session, &discriminant.negated()) {
        let angle = session.polynomial_term(&w.times(&polynomial(time)));
        let [sine, cosine] =
            [Elementary::Sin, Elementary::Cos].map(|f| polynomial(session.terms().elementary(f, angle)));
        let wx = w.times(&x);
        vec![
            wx.times(&cosine).minus(&y.times(&sine)),
            wx.times(&sine).plus(&y.times(&cosine)),
        ]
    } else {
        let w = root(session, &discriminant)?;
        let (down, up) = (exponential(session, &w.negated()), exponential(session, &w));
        let wx = w.times(&x);
        vec![
            y.plus(&wx).times(&polynomial(down)),
            y.minus(&wx).times(&polynomial(up)),
        ]
    };
    Some(
        constants
            .iter()
            .map(|constant| session.polynomial_term(&constant.times(&decay)))
            .collect(),
    )
}
