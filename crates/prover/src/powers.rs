//! Powers whose exponents are integers: by powers of the factors of their bases, and of the parts of their exponents.

use super::session::{Session, term_of};
use dashu_ratio::RBig;
use kernel::{Node, Polynomial, Property, Term};
use std::collections::{BTreeSet, VecDeque};

/// The most powers that are taken apart at once, and the largest number in an exponent that is.
const MOST_POWERS: usize = 64;
const LARGEST: i64 = 12;

/// The furthest that two integer exponents of one base may be apart for x^(n + d) = x^n x^d to be brought in.
const FURTHEST: i64 = 64;

/// A power whose exponent is an integer.
#[derive(Clone)]
struct Power {
    term: Term,
    base: Term,
    exponent: Term,
    polynomial: Polynomial,
}

impl Power {
    fn of(session: &mut Session, term: Term) -> Option<Self> {
        let Node::RealPower(base, exponent) = session.node(term) else {
            return None;
        };
        let polynomial = session.numerator_of_polynomial(exponent)?;
        let is_integer = session.checker.knows_polynomial(Property::Integer, &polynomial);
        is_integer.then_some(Self {
            term,
            base,
            exponent,
            polynomial,
        })
    }
}

/// Brings in how the integer powers that were met hang together.
pub fn relate(session: &mut Session, met: &BTreeSet<Term>) {
    let mut waiting: VecDeque<Term> = met.iter().copied().collect();
    let mut known: BTreeSet<Term> = met.clone();
    let (mut powers, mut of_any_base) = (0, Vec::new());
    while let Some(term) = waiting.pop_front() {
        let Some(power) = Power::of(session, term) else {
            continue;
        };
        powers += 1;
        if powers > MOST_POWERS {
            break;
        }
        let mut parts = of_factors(session, &power);
        match session.show_all(vec![(Property::Nonzero, power.base)]) {
            Some(()) => parts.extend(of_parts(session, &power)),
            None => of_any_base.push(power),
        }
        for (base, exponent) in parts {
            let part = session.terms().add(Node::RealPower(base, exponent));
            if known.insert(part) {
                waiting.push_back(part);
            }
        }
    }
    beside_each_other(session, &of_any_base);
}

/// A power of a product, of a quotient or of a power by powers of what these are made of, which are returned.
fn of_factors(session: &mut Session, power: &Power) -> Vec<(Term, Term)> {
    let (base, exponent) = (power.base, power.exponent);
    if session.numerator_of_polynomial(base) == Some(Polynomial::integer(-1)) {
        session.axiom("CosineOfHalfTurns", &[exponent]);
    }
    let [first, rest] = match session.node(base) {
        Node::Product(parts) => {
            let Some((&first, rest)) = parts.split_first() else {
                return Vec::new();
            };
            [first, session.terms().product(rest.to_vec())]
        }
        Node::Power(of, index @ 2..) if i64::from(index) <= LARGEST => {
            let rest = match index {
                2 => of,
                index => session.terms().add(Node::Power(of, index - 1)),
            };
            [of, rest]
        }
        Node::Quotient(above, below) => {
            // what is above is the product of the quotient and of what is below
            power_of_product(session, [above, base, below, exponent]);
            return vec![(above, exponent), (below, exponent)];
        }
        Node::RealPower(inner, outer) => {
            let product = session.terms().product(vec![outer, exponent]);
            session.axiom("PowerOfPower", &[inner, product, outer, exponent]);
            return vec![(inner, product)];
        }
        Node::Number(_) => {
            session.axiom("PowerOfOne", &[base, exponent]);
            return Vec::new();
        }
        _ => return Vec::new(),
    };
    power_of_product(session, [base, first, rest, exponent]);
    vec![(first, exponent), (rest, exponent)]
}

fn power_of_product(session: &mut Session, terms: [Term; 4]) {
    if session.axiom("PowerOfProduct", &terms).is_none() {
        let [_, a, b, _] = terms;
        let _ = session.show_all(vec![(Property::Nonzero, a), (Property::Nonzero, b)]);
        session.axiom("NonzeroPowerOfProduct", &terms);
    }
}

/// A power of what is not 0 by powers whose exponents are the parts of its own, which are returned.
fn of_parts(session: &mut Session, power: &Power) -> Vec<(Term, Term)> {
    let parts = power.polynomial.terms();
    let exponent = |session: &mut Session, parts: &[(kernel::Monomial, RBig)]| {
        term_of(session.terms(), &Polynomial::from_terms(parts.iter().cloned()))
    };
    let (base, whole) = (power.base, power.exponent);
    if let Some(value) = power.polynomial.as_constant().and_then(|value| value.to_integer()) {
        if value.abs() <= FURTHEST {
            let size = session.terms().integer(value.abs());
            let row = if value < 0 { "NegativePower" } else { "IntegerPower" };
            session.axiom(row, &[base, whole, size]);
        }
        return Vec::new();
    }
    session.axiom("PowerNonzero", &[base, whole]);
    let split = match parts {
        [] => None,
        [(monomial, value)] => {
            let one = vec![(monomial.clone(), RBig::ONE)];
            match i64::try_from(value.numerator())
                .ok()
                .filter(|value| value.abs() <= LARGEST)
            {
                // how a power is called does not matter
                Some(1) => {
                    let one = exponent(session, &one);
                    let zero = session.terms().integer(0);
                    (one != whole).then_some([one, zero])
                }
                Some(value) if value > 1 => {
                    let rest = vec![(monomial.clone(), RBig::from(value - 1))];
                    Some([exponent(session, &one), exponent(session, &rest)])
                }
                Some(value) => {
                    // x^(-n) x^n = x^0
                    let opposite = vec![(monomial.clone(), RBig::from(-value))];
                    let opposite = exponent(session, &opposite);
                    let zero = session.terms().integer(0);
                    session.axiom("NonzeroPowerOfSum", &[base, zero, whole, opposite]);
                    return vec![(base, zero), (base, opposite)];
                }
                None => None,
            }
        }
        [first @ .., last] => {
            let last = std::slice::from_ref(last);
            Some([exponent(session, first), exponent(session, last)])
        }
    };
    let Some([a, b]) = split else { return Vec::new() };
    session.axiom("NonzeroPowerOfSum", &[base, whole, a, b]);
    vec![(base, a), (base, b)]
}

/// Powers of one base that may be 0, by the lowest of those whose exponents are a number apart, or by one whose exponent is half
/// of another.
fn beside_each_other(session: &mut Session, powers: &[Power]) {
    for power in powers {
        let others = powers
            .iter()
            .filter(|other| other.term != power.term && other.base == power.base);
        let apart = |other: &Power| {
            let apart = power.polynomial.minus(&other.polynomial).as_constant();
            apart.and_then(|apart| apart.to_integer())
        };
        // of two spellings of one exponent the first is the lower
        let is_lower = |apart: i64, other: &Power| match apart {
            0 => other.term < power.term,
            apart => (1..=FURTHEST).contains(&apart),
        };
        let lower = others.clone().filter_map(|other| Some((apart(other)?, other)));
        let lowest = lower
            .filter(|(apart, other)| is_lower(*apart, other))
            .max_by_key(|(apart, other)| (*apart, std::cmp::Reverse(other.term)));
        if let Some((apart, lowest)) = lowest {
            let step = session.terms().integer(apart);
            let _ = session.show_all(vec![
                (Property::NonNegative, lowest.exponent),
                (Property::NonNegative, step),
            ]);
            session.axiom("PowerOfSum", &[power.base, power.exponent, lowest.exponent, step]);
            session.axiom("IntegerPower", &[power.base, step, step]);
            continue;
        }
        let mut halves = others.filter(|other| {
            let half = &other.polynomial;
            let rest = power.polynomial.minus(half).minus(half);
            rest.as_constant().is_some() && half.as_constant().is_none()
        });
        if let Some(half) = halves.next() {
            let rest = session.terms().difference(power.exponent, half.exponent);
            session.axiom("PowerOfSum", &[power.base, power.exponent, half.exponent, rest]);
        }
    }
}
