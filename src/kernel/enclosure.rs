//! Enclosures of terms without symbols, by intervals of many digits.

use super::polynomial::Polynomial;
use super::term::{Elementary, Node, Term, Terms};
use crate::number::{Analytic, Endpoint, Field, Interval, Rational, Wide};
use num_traits::{One, Zero};
use std::collections::HashMap;

/// The digits tried, one after the other, until a sign is certain.
type First = Interval<Wide<40>>;
type Second = Interval<Wide<150>>;

/// The sign of a polynomial without symbols: 1 or -1, where an enclosure shows it.
pub fn sign(terms: &Terms, polynomial: &Polynomial) -> Option<i8> {
    let certain = |positive: bool, negative: bool| match (positive, negative) {
        (true, _) => Some(1),
        (_, true) => Some(-1),
        _ => None,
    };
    if let Some(value) = polynomial.as_constant() {
        let zero = Rational::zero();
        return certain(value > zero, value < zero);
    }
    if polynomial.generators().iter().any(|&term| !terms.is_closed(term)) {
        return None;
    }
    let first: Option<First> = enclose(terms, polynomial);
    let found = first.and_then(|value| certain(value.is_positive(), value.is_negative()));
    found.or_else(|| {
        let second: Second = enclose(terms, polynomial)?;
        certain(second.is_positive(), second.is_negative())
    })
}

/// An enclosure of a polynomial whose generators have values; `None` where one has none for certain.
pub fn enclose<E: Endpoint>(terms: &Terms, polynomial: &Polynomial) -> Option<Interval<E>> {
    let mut known = HashMap::new();
    let mut sum = Interval::<E>::zero();
    for (monomial, coefficient) in polynomial.terms() {
        let mut product = rational(&Rational(coefficient.clone()))?;
        for &(term, power) in monomial {
            let base = term_value(terms, term, &mut known)?;
            product *= base.to_power(i32::try_from(power).ok().filter(|power| *power < 100_000)?);
        }
        sum += product;
    }
    sum.is_finite().then_some(sum)
}

/// An enclosure of a term that holds no symbol and no unknown function.
pub fn term_value<E: Endpoint>(
    terms: &Terms,
    term: Term,
    known: &mut HashMap<Term, Interval<E>>,
) -> Option<Interval<E>> {
    for inner in terms.inside(term) {
        if known.contains_key(&inner) {
            continue;
        }
        let of = |part: &Term| known.get(part).cloned();
        let value = match terms.node(inner) {
            Node::Number(value) => rational(value)?,
            Node::Pi => <Interval<E> as Analytic>::pi(),
            Node::Sum(parts) => {
                let parts: Option<Vec<_>> = parts.iter().map(of).collect();
                parts?.into_iter().fold(Interval::zero(), |sum, part| sum + part)
            }
            Node::Product(parts) => {
                let parts: Option<Vec<_>> = parts.iter().map(of).collect();
                parts?.into_iter().fold(Interval::one(), |product, part| product * part)
            }
            Node::Power(base, exponent) => {
                (0..=100_000).contains(exponent).then_some(())?;
                of(base)?.to_power(*exponent)
            }
            Node::Quotient(above, below) => {
                let below = of(below)?;
                (!below.contains_zero()).then_some(())?;
                of(above)? / below
            }
            Node::RealPower(base, exponent) => {
                let base = of(base)?;
                base.is_positive().then_some(())?;
                exp(&(of(exponent)? * ln(&base)))
            }
            Node::Elementary(function, of_term) => elementary(*function, &of(of_term)?)?,
            Node::Symbol(_) | Node::Value(..) | Node::Imaginary => return None,
        };
        value.is_finite().then_some(())?;
        known.insert(inner, value);
    }
    known.get(&term).cloned()
}

fn rational<E: Endpoint>(value: &Rational) -> Option<Interval<E>> {
    let (above, below) = (value.0.numerator(), value.0.denominator());
    let whole = |digits: &str| -> Interval<E> {
        // nine digits at a time, so that every step is exact in f64 and rounded outward in E
        let mut sum = Interval::<E>::zero();
        for chunk in digits.as_bytes().chunks(9) {
            let part = chunk.iter().fold(0_i64, |n, digit| 10 * n + i64::from(digit - b'0'));
            let scale = 10_i64.pow(u32::try_from(chunk.len()).unwrap_or(9));
            sum = sum * Interval::from_integer(scale) + Interval::from_integer(part);
        }
        sum
    };
    let text = above.to_string();
    let size = whole(text.trim_start_matches('-'));
    let value = size / whole(&below.to_string());
    let value = if text.starts_with('-') { -value } else { value };
    value.is_finite().then_some(value)
}

fn exp<E: Endpoint>(of: &Interval<E>) -> Interval<E> {
    Interval::new(of.low().bounded_exp().below(), of.high().bounded_exp().above())
}

fn ln<E: Endpoint>(of: &Interval<E>) -> Interval<E> {
    Interval::new(of.low().bounded_ln().below(), of.high().bounded_ln().above())
}

fn elementary<E: Endpoint>(function: Elementary, of: &Interval<E>) -> Option<Interval<E>> {
    let half_turn = || <Interval<E> as Analytic>::pi() / Interval::from_integer(2);
    Some(match function {
        Elementary::Sin => of.sincos().0,
        Elementary::Cos => of.sincos().1,
        Elementary::Exp => exp(of),
        Elementary::Ln => {
            of.is_positive().then_some(())?;
            ln(of)
        }
        Elementary::Root(2) => {
            (of.low() >= E::zero()).then_some(())?;
            of.sqrt()
        }
        Elementary::Root(index) => {
            let root = |of: &Interval<E>| exp(&(ln(of) / Interval::from_integer(i64::from(index))));
            if of.is_positive() {
                root(of)
            } else if of.is_negative() && index % 2 == 1 {
                -root(&-of.clone())
            } else {
                return None;
            }
        }
        Elementary::Arcsin | Elementary::Arccos => {
            (of.low() >= -E::one() && of.high() <= E::one()).then_some(())?;
            let cosine = Analytic::acos(of);
            if function == Elementary::Arccos {
                cosine
            } else {
                half_turn() - cosine
            }
        }
        Elementary::Arctan => of.atan2(&Interval::one()),
    })
}
