//! Inverse functions of sine, cosine and tangent.
//!
//! Complete for sums of them, with whole multiples, whose sine is 0 and whose cosine is 1 by what is known of their
//! arguments, and whose size is below a full turn by their ranges and signs.

use super::angles;
use super::roots;
use super::session::Session;
use dashu_int::UBig;
use dashu_ratio::RBig;
use kernel::{Elementary, Inference, Node, Polynomial, Property, Term};
use numbers::{Field, Rational};
use std::collections::BTreeSet;

/// Adds ranges and signs, and what the other functions of inverse functions are.
pub fn describe(session: &mut Session, met: &BTreeSet<Term>) {
    if session.checker.statement.is_complex() {
        return;
    }
    for &term in met {
        if let Node::Elementary(function @ (Elementary::Sin | Elementary::Cos), of) = session.node(term)
            && !session.checker.statement.terms().is_closed(of)
        {
            sign_of_sine(session, function, of);
        }
    }
    for &term in met {
        if let Node::Elementary(function @ (Elementary::Arcsin | Elementary::Arccos | Elementary::Arctan), of) =
            session.node(term)
        {
            describe_one(session, function, term, of)
        }
    }
}

/// The half turns that are added to an argument to find the range that it lies in.
const HALF_TURNS: [i64; 5] = [0, -1, 1, -2, 2];

/// The sign of a sine or cosine whose argument is in a range where it has one.
fn sign_of_sine(session: &mut Session, function: Elementary, of: Term) -> Option<()> {
    if !session.described.insert((function, of)) {
        return None;
    }
    HALF_TURNS
        .into_iter()
        .find_map(|turns| sign_after_half_turns(session, function, of, turns))
}

/// The sign by `\sin x = (-1)^k \sin(x + k \pi)` and `\cos x = (-1)^k \sin(\pi/2 - x + k \pi)`, where this argument is between 0
/// and pi.
fn sign_after_half_turns(session: &mut Session, function: Elementary, of: Term, turns: i64) -> Option<()> {
    let (pi, two) = (session.terms().add(Node::Pi), session.terms().integer(2));
    let upright = match function {
        Elementary::Sin => of,
        _ => {
            let half = session.terms().quotient(pi, two);
            session.terms().difference(half, of)
        }
    };
    let shifted = match turns {
        0 => upright,
        turns => {
            let turns = session.terms().integer(turns);
            let more = session.terms().product(vec![turns, pi]);
            session.terms().sum(vec![upright, more])
        }
    };
    if shifted == of {
        return session.show_sine_sign(of).map(|_| ());
    }
    let angle = session.numerator_of_polynomial(shifted)?;
    let rest = Polynomial::generator(pi).minus(&angle);
    session.show_sign(&angle, false)?;
    session.show_sign(&rest, false)?;
    session.show_sine_sign(shifted)?;
    let sine = session.terms().elementary(Elementary::Sin, shifted);
    let own = session.terms().elementary(function, of);
    angles::expand(session, &BTreeSet::from([sine, own]));
    session.triangulate_all();
    let value = match turns % 2 {
        0 => Polynomial::generator(own),
        _ => Polynomial::generator(own).negated(),
    };
    session.show_sign(&value, false)?;
    Some(())
}

fn describe_one(session: &mut Session, function: Elementary, arc: Term, of: Term) {
    if !session.described.insert((function, arc)) {
        return;
    }
    let [above, below] = match function {
        Elementary::Arcsin => ["ArcsinAbove", "ArcsinBelow"],
        Elementary::Arccos => ["ArccosAbove", "ArccosBelow"],
        _ => ["ArctanAbove", "ArctanBelow"],
    };
    session.axiom(above, &[of]);
    session.axiom(below, &[of]);
    let other = match function {
        Elementary::Arccos => Elementary::Sin,
        _ => Elementary::Cos,
    };
    let other = session.terms().elementary(other, arc);
    session.axiom("Pythagoras", &[arc]);
    session.triangulate_all();
    let (one, square) = (session.terms().integer(1), session.terms().add(Node::Power(of, 2)));
    if function == Elementary::Arctan {
        // cos(arctan x) = 1/sqrt(1 + x^2)
        let sum = session.terms().sum(vec![one, square]);
        let root = session.terms().elementary(Elementary::Root(2), sum);
        let inverse = session.terms().quotient(one, other);
        session.describe_roots(root);
        roots::simplify(session, &BTreeSet::from([root]));
        if let Some(first) = session.unique_root_fact(root, inverse) {
            let (root, cosine) = (Polynomial::generator(root), Polynomial::generator(other));
            // in products with the denominator only numbers divide
            if let Ok(quotient) = session.checker.expansion.of(session.checker.statement.terms(), sum) {
                let mut below = Polynomial::integer(1);
                for (divisor, power) in &quotient.divisors {
                    for _ in 0..*power {
                        below = below.times(divisor);
                    }
                }
                // c N - r D = r D (r c - 1) - c (r^2 D - N)
                let above = quotient.numerator.clone();
                let difference = cosine.times(&above).minus(&root.times(&below));
                let square = root.times(&root).times(&below).minus(&above);
                let second = session
                    .checker
                    .facts
                    .iter()
                    .position(|fact| fact.property == Property::Zero && fact.polynomial == square);
                if let Some(second) = second {
                    let step = Inference::Zero {
                        target: difference,
                        power: 1,
                        squares: Vec::new(),
                        factors: Vec::new(),
                        terms: vec![(root.times(&below), first), (cosine.negated(), second)],
                    };
                    session.nonzero_fact(&above);
                    if let Ok(fact) = session.step(step) {
                        session.triangulate(fact, &|_, generator| generator == other);
                    }
                }
            }
        }
    } else {
        let rest = session.terms().difference(one, square);
        let root = session.terms().elementary(Elementary::Root(2), rest);
        session.describe_roots(root);
        roots::simplify(session, &BTreeSet::from([root]));
        session.unique_root(root, other);
    }
    if function != Elementary::Arccos {
        sign_of_arc(session, arc, of);
    }
    session.triangulate_all();
}

/// An arc has the sign of its argument.
fn sign_of_arc(session: &mut Session, arc: Term, of: Term) -> Option<usize> {
    let signed = session.signed_numerator(of)?;
    let value = Polynomial::generator(arc);
    if session.checker.statement.terms().is_closed(arc) {
        return None;
    }
    let mut found = None;
    for (argument, target, opposite) in [
        (&signed, value.clone(), true),
        (&signed.negated(), value.negated(), false),
    ] {
        if found.is_some() || session.show_sign(argument, false).is_none() {
            continue;
        }
        let strict = session.show_sign(argument, true).is_some();
        let property = if strict {
            Property::Positive
        } else {
            Property::NonNegative
        };
        let pi = session.terms().add(Node::Pi);
        let zero = session.terms().integer(0);
        // the arc with the wrong sign
        let wrong = if opposite { session.terms().negative(arc) } else { arc };
        let room = Polynomial::generator(pi).plus(&target);
        session.show_sign(&room, true)?;
        found = session.by_cases(&target, true, property, &target, &mut |session| {
            if session.checker.knows_polynomial(Property::Zero, &target) {
                let [left, right] = [arc, zero].map(|at| session.terms().elementary(Elementary::Sin, at));
                session.axiom("SineOfZero", &[zero]);
                session.step(Inference::Congruence { left, right }).ok()?;
            } else {
                session.axiom("SinePositive", &[wrong]);
                if opposite {
                    session.axiom("SineOfNegative", &[wrong, arc]);
                }
            }
            session.triangulate_all();
            session.show_absurd().then_some(())
        });
    }
    found
}

/// Shows that a sum of inverse functions and multiples of pi vanishes.
pub fn show_angle(session: &mut Session, goal: &Polynomial) -> Option<usize> {
    let holds_arc = |session: &Session| {
        goal.generators().into_iter().any(|term| {
            matches!(
                session.node(term),
                Node::Elementary(Elementary::Arcsin | Elementary::Arccos | Elementary::Arctan, _)
            )
        })
    };
    if !holds_arc(session) || goal.terms().iter().any(|(monomial, _)| monomial.len() != 1) {
        return None;
    }
    let mut scale = UBig::ONE;
    for (_, value) in goal.terms() {
        let below = value.denominator();
        if &scale % below != UBig::ZERO {
            scale *= below;
        }
    }
    let mut whole = goal.scaled(&Rational(RBig::from(scale)));
    let pi = session.terms().add(Node::Pi);
    // halves of pi need no doubling
    for divisor in [4_i64, 3, 2, 6, 12] {
        let part = whole.scaled(&(Rational::from_integer(1) / Rational::from_integer(divisor)));
        let fits = |(monomial, value): &(kernel::Monomial, RBig)| {
            *value.denominator() == UBig::ONE || monomial.iter().any(|&(term, _)| term == pi)
        };
        if part.terms().iter().all(fits) {
            whole = part;
        }
    }
    let turn = Polynomial::generator(pi).scaled(&Rational::from_integer(2));
    session.show_sign(&turn.minus(&whole), true)?;
    session.show_sign(&turn.plus(&whole), true)?;
    let angle = session.polynomial_term(&whole);
    let zero = session.terms().integer(0);
    session.axiom("SineOfZero", &[zero]);
    session.axiom("CosineOfZero", &[zero]);
    let mut met = BTreeSet::new();
    let mut pairs = Vec::new();
    for function in [Elementary::Sin, Elementary::Cos] {
        let [a, b] = [angle, zero].map(|at| session.terms().elementary(function, at));
        met.insert(a);
        pairs.push((a, b));
    }
    angles::expand(session, &met);
    session.triangulate_all();
    for (a, b) in pairs {
        session.show_equal(a, b)?;
    }
    session.axiom("AngleUnique", &[angle, zero])?;
    session.show_zero(goal)
}
