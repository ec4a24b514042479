//! Enclosures of terms without symbols, by intervals of many digits.

use super::polynomial::Polynomial;
use super::term::{Elementary, Node, Term, Terms};
use dashu_int::ops::BitTest;
use dashu_ratio::RBig;
use num_traits::{One, Zero};
use numbers::{Analytic, Endpoint, Field, Interval, Rational, Wide};
use std::cmp::Ordering;
use std::collections::HashMap;

/// The largest integer up to which all are machine numbers.
const EXACT: u64 = 1 << 53;

/// The most terms of a polynomial whose sign is looked for.
const LARGEST: usize = 2000;

fn sign_of<E: Endpoint>(value: &Interval<E>) -> Option<i8> {
    match (value.is_positive(), value.is_negative()) {
        (true, _) => Some(1),
        (_, true) => Some(-1),
        _ => None,
    }
}

/// The sign of a term without symbols over the real numbers: 1 or -1, where an enclosure shows it.
pub fn term_sign(terms: &Terms, term: Term) -> Option<i8> {
    terms.is_closed(term).then_some(())?;
    let quick = term_value::<f64>(terms, term, &mut HashMap::new());
    quick
        .and_then(|value| sign_of(&value))
        .or_else(|| sign_of(&term_value::<Wide<40>>(terms, term, &mut HashMap::new())?))
        .or_else(|| sign_of(&term_value::<Wide<150>>(terms, term, &mut HashMap::new())?))
}

/// The sign of a polynomial without symbols: 1 or -1, where an enclosure shows it.
pub fn sign(terms: &Terms, polynomial: &Polynomial) -> Option<i8> {
    if let Some(value) = polynomial.as_constant() {
        let zero = Rational::zero();
        return match value.cmp(&zero) {
            Ordering::Equal => None,
            Ordering::Greater => Some(1),
            Ordering::Less => Some(-1),
        };
    }
    if polynomial.terms().len() > LARGEST || polynomial.generators().iter().any(|&term| !terms.is_closed(term)) {
        return None;
    }
    let quick = enclose::<f64>(terms, polynomial).and_then(|value| sign_of(&value));
    quick
        .or_else(|| sign_of(&enclose::<Wide<40>>(terms, polynomial)?))
        .or_else(|| sign_of(&enclose::<Wide<150>>(terms, polynomial)?))
}

/// An enclosure of a polynomial whose generators have values; `None` where one has none for certain.
pub fn enclose<E: Endpoint>(terms: &Terms, polynomial: &Polynomial) -> Option<Interval<E>> {
    enclose_with(terms, polynomial, HashMap::new())
}

/// An enclosure of a polynomial over all values of the terms that are known; `None` where it may have none.
pub(super) fn enclose_with<E: Endpoint>(
    terms: &Terms,
    polynomial: &Polynomial,
    mut known: HashMap<Term, Interval<E>>,
) -> Option<Interval<E>> {
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

/// The most bits of a number that is known exactly.
const LONGEST: usize = 4096;

/// The value of a sum, product, power or quotient of numbers that are known exactly.
fn exact(node: &Node, of: &dyn Fn(&Term) -> Option<RBig>) -> Option<RBig> {
    let all = |parts: &[Term]| parts.iter().map(of).collect::<Option<Vec<RBig>>>();
    let value = match node {
        Node::Number(value) => value.0.clone(),
        Node::Sum(parts) => all(parts)?.into_iter().fold(RBig::ZERO, |sum, part| sum + part),
        Node::Product(parts) => all(parts)?.into_iter().fold(RBig::ONE, |product, part| product * part),
        Node::Power(base, exponent @ 0..=16) => of(base)?.pow(isize::try_from(*exponent).ok()?),
        Node::Quotient(above, below) => {
            let below = of(below).filter(|below| *below != RBig::ZERO)?;
            of(above)? / below
        }
        _ => return None,
    };
    let bits = value.numerator().bit_len() + value.denominator().bit_len();
    (bits <= LONGEST).then_some(value)
}

/// An enclosure of a term that holds no symbol and no unknown function.
pub fn term_value<E: Endpoint>(
    terms: &Terms,
    term: Term,
    known: &mut HashMap<Term, Interval<E>>,
) -> Option<Interval<E>> {
    if let Some(value) = known.get(&term) {
        return Some(value.clone());
    }
    // rounding would take the root of 1 - 1, and the arc sine of 1, out of their domains
    let mut exactly: HashMap<Term, RBig> = HashMap::new();
    for inner in terms.inside(term) {
        if let Some(value) = exact(terms.node(inner), &|part| exactly.get(part).cloned()) {
            let enclosed = match Rational(value.clone()).to_integer() {
                Some(whole) => Interval::from_integer(whole),
                _ => rational(&Rational(value.clone()))?,
            };
            exactly.insert(inner, value);
            known.entry(inner).or_insert(enclosed);
        }
        if known.contains_key(&inner) {
            continue;
        }
        let of = |part: &Term| known.get(part).cloned();
        let value = match terms.node(inner) {
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
            Node::Integral { .. } => {
                let [low, high] = terms.bounds(inner)?;
                Interval::new(rational::<E>(low)?.low().clone(), rational::<E>(high)?.high().clone())
            }
            Node::Number(value) => rational(value)?,
            Node::Symbol(_) | Node::Value(..) | Node::Imaginary | Node::Bound => return None,
        };
        value.is_finite().then_some(())?;
        known.insert(inner, value);
    }
    known.get(&term).cloned()
}

/// A complex number: its real part, and its imaginary part unless that is exactly 0.
pub type Complex<E> = (Interval<E>, Option<Interval<E>>);

/// The signs of the real and the imaginary part of a polynomial over complex numbers, principal branches throughout;
/// `None` of a part that is not separated from 0.
pub fn complex_signs(terms: &Terms, polynomial: &Polynomial) -> Option<[Option<i8>; 2]> {
    let mut known: HashMap<Term, Complex<Wide<40>>> = HashMap::new();
    let mut sum: Complex<Wide<40>> = (Interval::zero(), None);
    for (monomial, coefficient) in polynomial.terms() {
        let mut product: Complex<Wide<40>> = (rational(&Rational(coefficient.clone()))?, None);
        for &(term, power) in monomial {
            let base = complex_value(terms, term, complex_elementary, &mut known)?;
            for _ in 0..(power <= 1000).then_some(power)? {
                product = times(&product, &base);
            }
        }
        sum = plus(&sum, &product);
    }
    let sign = |part: &Interval<Wide<40>>| match (part.is_finite(), part.is_positive(), part.is_negative()) {
        (true, true, _) => Some(1),
        (true, _, true) => Some(-1),
        _ => None,
    };
    let imaginary = match &sum.1 {
        Some(part) => sign(part),
        None => Some(0),
    };
    Some([sign(&sum.0), imaginary])
}

pub(super) fn plus<E: Endpoint>(a: &Complex<E>, b: &Complex<E>) -> Complex<E> {
    let imaginary = match (&a.1, &b.1) {
        (Some(x), Some(y)) => Some(x.clone() + y.clone()),
        (part, None) | (None, part) => part.clone(),
    };
    (a.0.clone() + b.0.clone(), imaginary)
}

pub(super) fn times<E: Endpoint>(a: &Complex<E>, b: &Complex<E>) -> Complex<E> {
    let real = a.0.clone() * b.0.clone();
    match (&a.1, &b.1) {
        (None, None) => (real, None),
        (Some(x), None) => (real, Some(x.clone() * b.0.clone())),
        (None, Some(y)) => (real, Some(a.0.clone() * y.clone())),
        (Some(x), Some(y)) => (
            real - x.clone() * y.clone(),
            Some(a.0.clone() * y.clone() + x.clone() * b.0.clone()),
        ),
    }
}

pub(super) fn complex_quotient<E: Endpoint>(above: Complex<E>, below: Complex<E>) -> Option<Complex<E>> {
    Some(match below.1 {
        None => {
            (!below.0.contains_zero()).then_some(())?;
            (above.0 / below.0.clone(), above.1.map(|part| part / below.0))
        }
        Some(y) => times(&above, &complex_inverse(&below.0, &y)?),
    })
}

/// The inverse of x + i y, of which one part is not 0: 1/(x + y^2/x) and -y/(x^2 + y^2), where x is not 0. The latter is at
/// most 1/(2 |x|) in size.
fn complex_inverse<E: Endpoint>(x: &Interval<E>, y: &Interval<E>) -> Option<Complex<E>> {
    let size = x.to_power(2) + y.to_power(2);
    (!size.contains_zero()).then_some(())?;
    let bounded = |own: &Interval<E>, other: &Interval<E>| {
        let plain = own.clone() / size.clone();
        if !own.contains_zero() {
            let sum = own.clone() + other.square() / own.clone();
            return (Interval::one() / sum).intersection(&plain).unwrap_or(plain);
        }
        let most = Interval::one() / (Interval::from_integer(2) * other.size());
        let around = (-most.clone()).hull(&most);
        match other.contains_zero() {
            true => plain,
            false => around.intersection(&plain).unwrap_or(plain),
        }
    };
    Some((bounded(x, y), Some(-bounded(y, x))))
}

/// The principal value of an elementary function.
pub(super) fn complex_elementary<E: Endpoint>(function: Elementary, at: &Complex<E>) -> Option<Complex<E>> {
    Some(match (function, &at.1) {
        (Elementary::Exp, _) => complex_exp(at),
        (Elementary::Ln, _) => complex_ln(at)?,
        (Elementary::Root(index), Some(_)) => complex_root(at, index)?,
        (Elementary::Root(index), None) if !at.0.is_positive() => complex_root(at, index)?,
        (Elementary::Sin | Elementary::Cos, Some(y)) => {
            let (sine, cosine) = at.0.sincos();
            let (above, below) = (exp(y), exp(&-y.clone()));
            let two = Interval::from_integer(2);
            let wide = (above.clone() + below.clone()) / two.clone();
            let odd = (above - below) / two;
            match function {
                Elementary::Sin => (sine * wide, Some(cosine * odd)),
                _ => (cosine * wide, Some(-(sine * odd))),
            }
        }
        (Elementary::Arcsin | Elementary::Arccos, None) => {
            let inside = |part: Interval<E>| part.is_positive().then_some(());
            inside(Interval::one() - at.0.clone())?;
            inside(Interval::one() + at.0.clone())?;
            (elementary(function, &at.0)?, None)
        }
        (_, None) => (elementary(function, &at.0)?, None),
        _ => return None,
    })
}

/// A branch of the elementary functions.
pub type Branch<E> = fn(Elementary, &Complex<E>) -> Option<Complex<E>>;

/// An enclosure of a term that holds no symbol and no unknown function, over complex numbers.
pub(super) fn complex_value<E: Endpoint>(
    terms: &Terms,
    term: Term,
    elementary: Branch<E>,
    known: &mut HashMap<Term, Complex<E>>,
) -> Option<Complex<E>> {
    for inner in terms.inside(term) {
        if known.contains_key(&inner) {
            continue;
        }
        let of = |part: &Term| known.get(part).cloned();
        let one = || (Interval::<E>::one(), None);
        let value = match terms.node(inner) {
            Node::Number(value) => (rational(value)?, None),
            Node::Pi => (<Interval<E> as Analytic>::pi(), None),
            Node::Imaginary => (Interval::zero(), Some(Interval::one())),
            Node::Sum(parts) => {
                let parts: Option<Vec<_>> = parts.iter().map(of).collect();
                parts?
                    .iter()
                    .fold((Interval::zero(), None), |sum, part| plus(&sum, part))
            }
            Node::Product(parts) => {
                let parts: Option<Vec<_>> = parts.iter().map(of).collect();
                parts?.iter().fold(one(), |product, part| times(&product, part))
            }
            Node::Power(base, exponent) => {
                let base = of(base)?;
                (0..=1000).contains(exponent).then_some(())?;
                (0..*exponent).fold(one(), |power, _| times(&power, &base))
            }
            Node::Quotient(above, below) => complex_quotient(of(above)?, of(below)?)?,
            Node::RealPower(base, exponent) => {
                complex_exp(&times(&of(exponent)?, &elementary(Elementary::Ln, &of(base)?)?))
            }
            Node::Elementary(function, of_term) => elementary(*function, &of(of_term)?)?,
            Node::Integral { .. } => (term_value(terms, inner, &mut HashMap::new())?, None),
            Node::Symbol(_) | Node::Value(..) | Node::Bound => return None,
        };
        let finite = value.0.is_finite() && value.1.as_ref().is_none_or(Interval::is_finite);
        finite.then_some(())?;
        known.insert(inner, value);
    }
    known.get(&term).cloned()
}

pub(super) fn complex_exp<E: Endpoint>(at: &Complex<E>) -> Complex<E> {
    let size = exp(&at.0);
    match &at.1 {
        None => (size, None),
        Some(y) => {
            let (sine, cosine) = y.sincos();
            (size.clone() * cosine, Some(size * sine))
        }
    }
}

/// The principal logarithm: the argument is more than -pi and at most pi.
pub(super) fn complex_ln<E: Endpoint>(at: &Complex<E>) -> Option<Complex<E>> {
    match &at.1 {
        None if at.0.is_positive() => Some((ln(&at.0), None)),
        None if at.0.is_negative() => Some((ln(&-at.0.clone()), Some(<Interval<E> as Analytic>::pi()))),
        None => None,
        Some(y) => {
            let off_the_cut = at.0.is_positive() || y.is_positive() || y.is_negative();
            off_the_cut.then_some(())?;
            let size = at.0.to_power(2) + y.to_power(2);
            size.is_positive().then_some(())?;
            Some((ln(&size) / Interval::from_integer(2), Some(y.atan2(&at.0))))
        }
    }
}

pub(super) fn complex_root<E: Endpoint>(at: &Complex<E>, index: u32) -> Option<Complex<E>> {
    let index = Interval::from_integer(i64::from(index));
    let logarithm = complex_ln(at)?;
    let part = (logarithm.0 / index.clone(), logarithm.1.map(|part| part / index));
    Some(complex_exp(&part))
}

pub(super) fn rational<E: Endpoint>(value: &Rational) -> Option<Interval<E>> {
    let (above, below) = (value.0.numerator(), value.0.denominator());
    if let (Ok(above), Ok(below)) = (i64::try_from(above), i64::try_from(below))
        && above.unsigned_abs().max(below.unsigned_abs()) <= EXACT
    {
        return Some(Interval::from_integer(above) / Interval::from_integer(below));
    }
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

pub(super) fn exp<E: Endpoint>(of: &Interval<E>) -> Interval<E> {
    Interval::new(of.low().bounded_exp().below(), of.high().bounded_exp().above())
}

pub(super) fn ln<E: Endpoint>(of: &Interval<E>) -> Interval<E> {
    Interval::new(of.low().bounded_ln().below(), of.high().bounded_ln().above())
}

pub(super) fn elementary<E: Endpoint>(function: Elementary, of: &Interval<E>) -> Option<Interval<E>> {
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
            let positive = |of: &Interval<E>| exp(&(ln(of) / Interval::from_integer(i64::from(index))));
            let root = |end: E| match Interval::point(end) {
                end if end.is_positive() => Some(positive(&end)),
                end if end.is_negative() && index % 2 == 1 => Some(-positive(&-end)),
                end if end.is_zero() => Some(end),
                _ => None,
            };
            // it grows with what it is of
            Interval::new(root(of.low())?.low(), root(of.high())?.high())
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
