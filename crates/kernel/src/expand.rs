//! Terms as quotients of polynomials, and derivatives of terms.

use super::polynomial::Polynomial;
use super::term::{Elementary, Function, Node, Symbol, Term, TermMap, Terms};
use num_traits::{One, Zero};
use numbers::{Field, Rational};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// A numerator over a product of powers of polynomials, each with leading coefficient 1.
#[derive(Clone, Debug)]
pub struct Quotient {
    pub numerator: Polynomial,
    pub divisors: Vec<(Polynomial, u32)>,
}

/// Why a term is not expanded.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    #[error("the effort of the kernel is used up")]
    Effort,
    #[error("a divisor is 0")]
    Division,
    #[error("{0}")]
    Other(String),
}

/// A polynomial with more monomials than this is not built, whatever effort is left, so that memory stays bounded.
const MOST_MONOMIALS: usize = 20_000;

/// Expands terms, those in `whole` excepted: they stay generators, as functions and symbols do.
pub struct Expansion {
    pub whole: BTreeSet<Term>,
    /// Products of two terms of polynomials that may still be added up.
    pub effort: u64,
    done: TermMap<Rc<Quotient>>,
}

impl Quotient {
    fn polynomial(numerator: Polynomial) -> Self {
        Self {
            numerator,
            divisors: Vec::new(),
        }
    }

    /// The product of the divisors that `self` has and `other` lacks.
    fn lacking(&self, other: &Self) -> Vec<(Polynomial, u32)> {
        let power_in = |p: &Polynomial| other.divisors.iter().find(|(q, _)| q == p).map_or(0, |(_, n)| *n);
        let lacking = self
            .divisors
            .iter()
            .map(|(p, n)| (p.clone(), n.saturating_sub(power_in(p))));
        lacking.filter(|(_, n)| *n > 0).collect()
    }
}

impl Expansion {
    /// An expansion that keeps `whole` as generators and adds up at most `effort` products.
    pub fn new(whole: BTreeSet<Term>, effort: u64) -> Self {
        Self {
            whole,
            effort,
            done: TermMap::default(),
        }
    }

    /// The product, within the effort.
    pub fn times(&mut self, a: &Polynomial, b: &Polynomial) -> Result<Polynomial, Refusal> {
        let cost = a.terms().len().saturating_mul(b.terms().len()) as u64;
        self.effort = self.effort.checked_sub(cost).ok_or(Refusal::Effort)?;
        // exponents that do not fit would be cut off without a word
        a.degree().checked_add(b.degree()).ok_or(Refusal::Effort)?;
        bounded(a.times(b))
    }

    /// The power, within the effort.
    pub fn power(&mut self, base: &Polynomial, exponent: u32) -> Result<Polynomial, Refusal> {
        if base.terms().len() <= 1 && exponent > 1 {
            return monomial_power(base, exponent);
        }
        let mut result = Polynomial::integer(1);
        for _ in 0..exponent {
            result = self.times(&result, base)?;
        }
        Ok(result)
    }

    /// The term as a quotient. Its divisors are what the term divides by; that none of them is 0 is the caller's to know.
    pub fn of(&mut self, terms: &Terms, term: Term) -> Result<Quotient, Refusal> {
        Ok(Rc::unwrap_or_clone(self.shared(terms, term)?))
    }

    fn shared(&mut self, terms: &Terms, term: Term) -> Result<Rc<Quotient>, Refusal> {
        if let Some(known) = self.done.get(&term) {
            return Ok(Rc::clone(known));
        }
        let result = if self.whole.contains(&term) {
            Quotient::polynomial(Polynomial::generator(term))
        } else {
            self.unfolded(terms, term)?
        };
        let result = Rc::new(result);
        self.done.insert(term, Rc::clone(&result));
        Ok(result)
    }

    /// The term expanded even where it is whole itself; what is inside it stays whole.
    pub fn unfolded(&mut self, terms: &Terms, term: Term) -> Result<Quotient, Refusal> {
        Ok(match terms.node(term) {
            Node::Number(value) => Quotient::polynomial(Polynomial::constant(value)),
            Node::Sum(parts) => {
                let mut sum = Quotient::polynomial(Polynomial::default());
                for &part in parts {
                    let part = self.shared(terms, part)?;
                    sum = self.sum(&sum, &part)?;
                }
                sum
            }
            Node::Product(parts) => {
                let mut product = Quotient::polynomial(Polynomial::integer(1));
                for &part in parts {
                    let part = self.shared(terms, part)?;
                    product = self.product(&product, &part)?;
                }
                product
            }
            Node::Power(base, exponent) => {
                let base = self.shared(terms, *base)?;
                let exponent = u32::try_from(*exponent).map_err(|_| Refusal::Other("a negative power".into()))?;
                let numerator = self.power(&base.numerator, exponent)?;
                let mut divisors = Vec::new();
                for (divisor, power) in base.divisors.iter().filter(|_| exponent > 0) {
                    divisors.push((divisor.clone(), power.checked_mul(exponent).ok_or(Refusal::Effort)?));
                }
                Quotient { numerator, divisors }
            }
            Node::Quotient(above, below) => {
                let (above, below) = (self.shared(terms, *above)?, self.shared(terms, *below)?);
                let inverse = self.inverse(&below)?;
                self.product(&above, &inverse)?
            }
            _ => Quotient::polynomial(Polynomial::generator(term)),
        })
    }

    fn inverse(&mut self, of: &Quotient) -> Result<Quotient, Refusal> {
        let Some((_, lead)) = of.numerator.terms().first() else {
            return Err(Refusal::Division);
        };
        let scale = Rational::one() / Rational(lead.clone());
        let mut numerator = Polynomial::constant(&scale);
        for (divisor, power) in &of.divisors {
            let power = self.power(divisor, *power)?;
            numerator = self.times(&numerator, &power)?;
        }
        let divisor = of.numerator.scaled(&scale);
        let divisors = if divisor.as_constant().is_some() {
            Vec::new()
        } else {
            vec![(divisor, 1)]
        };
        Ok(Quotient { numerator, divisors })
    }

    fn product(&mut self, a: &Quotient, b: &Quotient) -> Result<Quotient, Refusal> {
        let mut divisors = a.divisors.clone();
        for (divisor, power) in &b.divisors {
            match divisors.iter_mut().find(|(known, _)| known == divisor) {
                Some((_, known)) => *known = known.checked_add(*power).ok_or(Refusal::Effort)?,
                None => divisors.push((divisor.clone(), *power)),
            }
        }
        let numerator = self.times(&a.numerator, &b.numerator)?;
        Ok(Quotient { numerator, divisors })
    }

    fn sum(&mut self, a: &Quotient, b: &Quotient) -> Result<Quotient, Refusal> {
        let (for_a, for_b) = (b.lacking(a), a.lacking(b));
        let (mut left, mut right) = (Cow::Borrowed(&a.numerator), Cow::Borrowed(&b.numerator));
        for (divisor, power) in &for_a {
            let factor = self.power(divisor, *power)?;
            left = Cow::Owned(self.times(&left, &factor)?);
        }
        for (divisor, power) in &for_b {
            let factor = self.power(divisor, *power)?;
            right = Cow::Owned(self.times(&right, &factor)?);
        }
        let mut divisors = a.divisors.clone();
        for (divisor, power) in for_a {
            match divisors.iter_mut().find(|(known, _)| *known == divisor) {
                Some((_, known)) => *known = known.checked_add(power).ok_or(Refusal::Effort)?,
                None => divisors.push((divisor, power)),
            }
        }
        let cost = (left.terms().len() + right.terms().len()) as u64;
        self.effort = self.effort.checked_sub(cost).ok_or(Refusal::Effort)?;
        let numerator = bounded(left.plus(&right))?;
        Ok(Quotient { numerator, divisors })
    }
}

fn bounded(polynomial: Polynomial) -> Result<Polynomial, Refusal> {
    match polynomial.terms().len() > MOST_MONOMIALS {
        true => Err(Refusal::Effort),
        false => Ok(polynomial),
    }
}

/// A power of a polynomial with at most one term.
fn monomial_power(base: &Polynomial, exponent: u32) -> Result<Polynomial, Refusal> {
    let Some((monomial, coefficient)) = base.terms().first() else {
        return Ok(Polynomial::default());
    };
    let bits = 64 - u64::from(exponent).leading_zeros() + 20;
    let size = coefficient.numerator().to_string().len() + coefficient.denominator().to_string().len();
    if !Rational(coefficient.clone()).0.is_one() && size.saturating_mul(exponent as usize) > 1 << bits.min(20) {
        return Err(Refusal::Effort);
    }
    let exponents = monomial.iter().map(|&(term, n)| Some((term, n.checked_mul(exponent)?)));
    let exponents: Option<super::polynomial::Monomial> = exponents.collect();
    let exponents = exponents.ok_or(Refusal::Effort)?;
    let power = i32::try_from(exponent).map_err(|_| Refusal::Effort)?;
    let value = Rational(coefficient.clone()).to_power(power);
    Ok(Polynomial::from_terms([(exponents, value.0)]))
}

/// What a declared derivative of an unknown function is: another function, or the next order of its own.
pub type Derivatives = BTreeMap<Function, Function>;

/// The value of the derivative of order `order`, under the name that is declared for it.
pub fn value(terms: &mut Terms, declared: &Derivatives, mut function: Function, mut order: u32, at: Term) -> Term {
    while order > 0
        && let Some(next) = declared.get(&function)
    {
        (function, order) = (*next, order - 1);
    }
    terms.add(Node::Value(function, order, at))
}

/// The derivative of a term: `slope` gives that of a symbol. Where it has a value the term is differentiable there,
/// and its domain is part of the domain of the result together with that of the term.
pub fn derivative(
    terms: &mut Terms,
    term: Term,
    declared: &Derivatives,
    slope: &mut dyn FnMut(&mut Terms, Symbol) -> Term,
) -> Term {
    let zero = terms.integer(0);
    let mut done: TermMap<Term> = TermMap::default();
    for inner in terms.inside(term) {
        let of = |part: &Term| done.get(part).copied().unwrap_or(zero);
        let result = match terms.node(inner).clone() {
            Node::Number(_) | Node::Pi | Node::Imaginary | Node::Bound | Node::Integral { .. } => zero,
            Node::Symbol(symbol) => slope(terms, symbol),
            Node::Sum(parts) => {
                let moving: Vec<Term> = parts.iter().map(of).filter(|&slope| slope != zero).collect();
                terms.sum(moving)
            }
            Node::Product(parts) => {
                let mut sum = Vec::new();
                for (at, part) in parts.iter().enumerate().filter(|(_, part)| of(part) != zero) {
                    let mut factors = parts.clone();
                    factors[at] = of(part);
                    sum.push(terms.product(factors));
                }
                terms.sum(sum)
            }
            _ if terms.parts(inner).iter().all(|part| of(part) == zero) => zero,
            Node::Power(_, 0) => terms.integer(0),
            Node::Power(base, 1) => of(&base),
            Node::Power(base, exponent) => {
                let outer = terms.integer(i64::from(exponent));
                let lower = terms.add(Node::Power(base, exponent.saturating_sub(1)));
                terms.product(vec![outer, lower, of(&base)])
            }
            Node::Quotient(above, below) => {
                // a'/b - (a/b) b'/b
                let first = terms.quotient(of(&above), below);
                let second = terms.quotient(of(&below), below);
                let second = terms.product(vec![inner, second]);
                terms.difference(first, second)
            }
            Node::RealPower(base, exponent) => {
                let logarithm = terms.elementary(Elementary::Ln, base);
                let by_exponent = terms.product(vec![of(&exponent), logarithm]);
                let relative = terms.quotient(of(&base), base);
                let by_base = terms.product(vec![exponent, relative]);
                let sum = terms.sum(vec![by_exponent, by_base]);
                terms.product(vec![inner, sum])
            }
            Node::Value(function, order, at) => {
                let outer = value(terms, declared, function, order + 1, at);
                terms.product(vec![outer, of(&at)])
            }
            Node::Elementary(function, at) => {
                let outer = elementary_slope(terms, function, at, inner);
                terms.product(vec![outer, of(&at)])
            }
        };
        done.insert(inner, result);
    }
    done.get(&term).copied().unwrap_or(zero)
}

/// The derivative of an elementary function at `at`, where its value is `inner`.
fn elementary_slope(terms: &mut Terms, function: Elementary, at: Term, inner: Term) -> Term {
    let one = terms.integer(1);
    match function {
        Elementary::Sin => terms.elementary(Elementary::Cos, at),
        Elementary::Cos => {
            let sine = terms.elementary(Elementary::Sin, at);
            terms.negative(sine)
        }
        Elementary::Exp => inner,
        Elementary::Ln => terms.quotient(one, at),
        Elementary::Root(index) => {
            let index = terms.integer(i64::from(index));
            let below = terms.product(vec![index, at]);
            terms.quotient(inner, below)
        }
        Elementary::Arcsin | Elementary::Arccos => {
            let square = terms.add(Node::Power(at, 2));
            let rest = terms.difference(one, square);
            let root = terms.elementary(Elementary::Root(2), rest);
            let slope = terms.quotient(one, root);
            if function == Elementary::Arcsin {
                slope
            } else {
                terms.negative(slope)
            }
        }
        Elementary::Arctan => {
            let square = terms.add(Node::Power(at, 2));
            let sum = terms.sum(vec![one, square]);
            terms.quotient(one, sum)
        }
    }
}

/// Whether a polynomial is 0 at every value of its generators.
pub fn vanishes(polynomial: &Polynomial) -> bool {
    polynomial.as_constant().is_some_and(|value| value.is_zero())
}
