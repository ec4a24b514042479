//! Logarithms: each is written by those of the prime numbers and of the coprime factors of its argument.
//!
//! Complete for real logarithms of products of powers of what is known to be positive; exponentials that are equal
//! have equal exponents.

use super::angles;
use super::roots::{self, Form};
use super::session::Session;
use dashu_int::IBig;
use dashu_ratio::RBig;
use kernel::{Elementary, Inference, Node, Polynomial, Property, Term};
use std::collections::BTreeSet;

/// Writes the logarithms among these terms by simpler ones, and compares exponents.
pub fn simplify(session: &mut Session, met: &BTreeSet<Term>) {
    if session.checker.statement.is_complex() {
        for &term in met {
            principal(session, term);
        }
        return;
    }
    for &term in met {
        match session.node(term) {
            Node::Elementary(Elementary::Ln, of) if !session.is_determined(term) => {
                session.axiom("ExpOfLn", &[of]);
                for form in roots::forms(session, of) {
                    if let Some(value) = logarithm(session, &form)
                        && value != term
                        && exponents_equal(session, term, value).is_some()
                    {
                        break;
                    }
                }
            }
            Node::RealPower(base, exponent) => {
                if let Some(signed) = session.signed_numerator(base) {
                    session.show_sign(&signed, true);
                }
                session.real_power(base, exponent);
            }
            _ => {}
        }
    }
    let facts: Vec<usize> = session.triangle.iter().map(|pivot| pivot.fact).collect();
    for fact in session.zeros().into_iter().chain(facts) {
        equal_exponentials(session, fact);
    }
}

/// The principal logarithm of a negative number, and of 1.
fn principal(session: &mut Session, term: Term) -> Option<()> {
    let Node::Elementary(Elementary::Ln, of) = session.node(term) else {
        return None;
    };
    let argument = session.numerator_of_polynomial(of)?;
    let right = if argument == Polynomial::integer(1) {
        let zero = session.terms().integer(0);
        session.axiom("ExpOfZero", &[zero]);
        session.axiom("LnOfExp", &[zero])?;
        let one = session.terms().elementary(Elementary::Exp, zero);
        session.terms().elementary(Elementary::Ln, one)
    } else {
        let opposite = argument.negated();
        session.show_sign(&opposite, true)?;
        let opposite = session.polynomial_term(&opposite);
        session.axiom("LnOfNegative", &[opposite])?;
        let negative = session.terms().negative(opposite);
        session.terms().elementary(Elementary::Ln, negative)
    };
    if right != term {
        session.step(Inference::Congruence { left: term, right }).ok()?;
    }
    Some(())
}

/// The logarithm of a product, as a term.
fn logarithm(session: &mut Session, form: &Form) -> Option<Term> {
    let mut parts: Vec<Term> = Vec::new();
    let (mut negative, mut together) = (false, Polynomial::integer(1));
    for (factor, exponent) in form {
        if *factor == Polynomial::integer(-1) {
            negative ^= exponent % 2 != 0;
            continue;
        }
        let inner = if session.show_sign(factor, true).is_some() {
            of_positive(session, factor)
        } else if session.show_sign(&factor.negated(), true).is_some() {
            negative ^= exponent % 2 != 0;
            of_positive(session, &factor.negated())
        } else if exponent % 2 != 0 {
            if *exponent != 1 {
                return None;
            }
            together = together.times(factor);
            continue;
        } else {
            // of the absolute value
            let base = session.polynomial_term(factor);
            let square = session.terms().add(Node::Power(base, 2));
            let absolute = session.terms().elementary(Elementary::Root(2), square);
            session.describe_roots(absolute);
            session.show_nonzero(factor)?;
            let squared = session.numerator_of_polynomial(square)?;
            session.show_nonzero(&squared)?;
            session.show_root_positive(absolute, &squared)?;
            of_positive(session, &Polynomial::generator(absolute))
        };
        let count = session.terms().integer(*exponent);
        parts.push(session.terms().product(vec![count, inner]));
    }
    if negative {
        together = together.negated();
    }
    if together != Polynomial::integer(1) {
        session.show_sign(&together, true)?;
        parts.push(of_positive(session, &together));
    }
    Some(session.terms().sum(parts))
}

/// The logarithm of a positive polynomial: the exponent of an exponential.
fn of_positive(session: &mut Session, polynomial: &Polynomial) -> Term {
    if let [(monomial, value)] = polynomial.terms()
        && let [(generator, 1)] = monomial.as_slice()
        && *value == RBig::ONE
        && let Node::Elementary(Elementary::Exp, of) = session.node(*generator)
    {
        return of;
    }
    let base = session.polynomial_term(polynomial);
    session.axiom("ExpOfLn", &[base]);
    session.terms().elementary(Elementary::Ln, base)
}

/// Shows that two terms are equal as their exponentials are.
fn exponents_equal(session: &mut Session, a: Term, b: Term) -> Option<usize> {
    let values = [a, b].map(|of| session.terms().elementary(Elementary::Exp, of));
    let mut met: BTreeSet<Term> = session
        .checker
        .statement
        .terms()
        .inside(values[0])
        .into_iter()
        .collect();
    met.extend(session.checker.statement.terms().inside(values[1]));
    for generator in session.generators(&[]) {
        if let Node::Elementary(Elementary::Exp, _) = session.node(generator) {
            met.insert(generator);
        }
    }
    for &term in &met {
        if let Node::Elementary(Elementary::Ln, of) = session.node(term) {
            session.axiom("ExpOfLn", &[of]);
        }
    }
    session.triangulate_all();
    angles::expand(session, &met);
    session.triangulate_all();
    session.show_equal(values[0], values[1])?;
    let found = session.axiom("ExpInjective", &[a, b])?;
    session.triangulate_all();
    Some(found)
}

/// Of two products of exponentials that are equal, the exponents are.
fn equal_exponentials(session: &mut Session, fact: usize) -> Option<()> {
    if !session.compared.insert(fact) {
        return None;
    }
    let polynomial = session.polynomial(fact);
    let [(first, a), (second, b)] = polynomial.terms() else {
        return None;
    };
    if *(a * b).numerator() > IBig::ZERO {
        return None;
    }
    let moves = |session: &Session, term: Term| {
        matches!(session.node(term), Node::Elementary(Elementary::Exp, of)
            if !session.checker.statement.terms().is_closed(of))
    };
    if !polynomial.generators().into_iter().any(|term| moves(session, term)) {
        return None;
    }
    let mut sides: Vec<Term> = Vec::new();
    for (monomial, value) in [(first, a), (second, b)] {
        let mut parts = Vec::new();
        let size = if *value.numerator() < IBig::ZERO {
            -value.clone()
        } else {
            value.clone()
        };
        if size != RBig::ONE {
            let number = Polynomial::constant(&numbers::Rational(size));
            parts.push(of_positive(session, &number));
        }
        for &(generator, power) in monomial {
            let generator = Polynomial::generator(generator);
            session.show_sign(&generator, true)?;
            let inner = of_positive(session, &generator);
            let count = session.terms().integer(i64::from(power));
            parts.push(session.terms().product(vec![count, inner]));
        }
        sides.push(session.terms().sum(parts));
    }
    // by now there may be nothing to compare
    let difference = session.terms().difference(sides[0], sides[1]);
    let difference = session.numerator(difference)?;
    if session.reduces_to_zero(&difference) {
        return None;
    }
    let facts = session.checker.facts.len();
    exponents_equal(session, sides[0], sides[1])?;
    for number in facts..session.checker.facts.len() {
        if session.checker.facts[number].property == Property::Zero {
            session.compared.insert(number);
        }
    }
    Some(())
}
