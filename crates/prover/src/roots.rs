//! Roots: each is written by roots of coprime factors of known sign.
//!
//! Complete for real roots whose radicands split, modulo the triangle, into rational factors: a perfect power comes
//! out with the sign that is known of its base, or with the root of its square where none is known; numbers split
//! into primes. Products of odd roots whose radicands multiply to a perfect power, too.

use super::session::Session;
use crate::algebra::{Factors, coefficients_in, degree_in, factors};
use dashu_int::{IBig, UBig};
use kernel::{Elementary, Inference, Node, Polynomial, Term};
use num_traits::{One, Zero};
use numbers::Rational;
use std::collections::BTreeSet;

/// Numbers up to this are split into primes.
const LARGEST_PRIME: u64 = 10_000;
/// The largest number of roots that are multiplied with each other.
const MOST_PAIRS: usize = 4;

/// Writes the roots among these terms by simpler ones.
pub fn simplify(session: &mut Session, met: &BTreeSet<Term>) {
    if session.checker.statement.is_complex() {
        for &term in met {
            principal(session, term);
        }
        return;
    }
    let mut odd: Vec<(Term, u32, Polynomial)> = Vec::new();
    for &term in met {
        let Node::Elementary(Elementary::Root(index), of) = session.node(term) else {
            continue;
        };
        // what a premise determines is a root all the same
        if !session.described.insert((Elementary::Root(index), term)) && session.is_determined(term) {
            continue;
        }
        if index % 2 == 0
            && !session.checker.statement.terms().is_closed(term)
            && let Some(radicand) = session.numerator_of_polynomial(of)
            && session.show_sign(&Polynomial::generator(term), true).is_none()
        {
            let _ = session.show_root_positive(term, &radicand);
        }
        if let Some(radicand) = session.numerator(of)
            && session.reduces_to_zero(&radicand)
        {
            let zero = session.terms().integer(0);
            session.unique_root(term, zero);
            continue;
        }
        for form in forms(session, of) {
            if let Some(value) = value(session, index, &form)
                && value != term
                && session.unique_root(term, value).is_some()
            {
                break;
            }
        }
        if index % 2 == 1
            && let Some(radicand) = session.numerator_of_polynomial(of)
        {
            odd.push((term, index, radicand));
        }
    }
    odd.truncate(MOST_PAIRS);
    for (place, (first, index, a)) in odd.iter().enumerate() {
        for (second, other, b) in odd.iter().skip(place + 1) {
            if index == other {
                product_of_odd(session, *index, [*first, *second], &a.times(b));
            }
        }
    }
}

/// Shows that a root is what a claim makes it, where the claim is linear in it.
pub fn as_claimed(session: &mut Session, polynomial: &Polynomial) -> Option<()> {
    for generator in polynomial.generators() {
        if !matches!(session.node(generator), Node::Elementary(Elementary::Root(_), _))
            || session.is_determined(generator)
        {
            continue;
        }
        let Ok([rest, lead]) = <[Polynomial; 2]>::try_from(coefficients_in(polynomial, generator)) else {
            continue;
        };
        let Some(lead) = lead.as_constant().filter(|lead| !lead.is_zero()) else {
            continue;
        };
        let value = rest.scaled(&(-Rational::one() / lead));
        if value
            .generators()
            .iter()
            .any(|&term| session.checker.statement.terms().inside(term).contains(&generator))
        {
            continue;
        }
        let value = session.polynomial_term(&value);
        session.unique_root(generator, value)?;
        return Some(());
    }
    None
}

/// The principal square root of a negative number, and of the square of a positive one.
fn principal(session: &mut Session, root: Term) -> Option<()> {
    let Node::Elementary(Elementary::Root(2), of) = session.node(root) else {
        return None;
    };
    let radicand = session.numerator_of_polynomial(of)?;
    if session.show_sign(&radicand, false).is_some() {
        for form in forms(session, of) {
            let value = value(session, 2, &form).filter(|&value| value != root)?;
            session.unique_root(root, value);
        }
        return Some(());
    }
    let opposite = radicand.negated();
    session.show_sign(&opposite, false)?;
    let opposite = session.polynomial_term(&opposite);
    session.axiom("RootOfNegative", &[opposite])?;
    let negative = session.terms().negative(opposite);
    let right = session.terms().elementary(Elementary::Root(2), negative);
    if right != root {
        session.step(Inference::Congruence { left: root, right }).ok()?;
    }
    Some(())
}

/// Where the radicands of two odd roots multiply to a perfect power, so do the roots.
fn product_of_odd(session: &mut Session, index: u32, roots: [Term; 2], radicand: &Polynomial) -> Option<()> {
    let plain = without_squares(session, radicand)?;
    let (reduced, _) = session.exact_reduction(radicand)?;
    let mut found = None;
    for radicand in [plain, reduced] {
        let form = split(session, &radicand, &Polynomial::integer(1))?;
        let own = |(factor, _): &(Polynomial, i64)| roots.iter().any(|&root| *factor == Polynomial::generator(root));
        let perfect = form
            .iter()
            .all(|(_, exponent)| exponent.rem_euclid(i64::from(index)) == 0);
        if perfect && !form.iter().any(own) {
            found = Some((radicand, form));
            break;
        }
    }
    let (radicand, form) = found?;
    let value = value(session, index, &form)?;
    let radicand = session.polynomial_term(&radicand);
    let root = session.terms().elementary(Elementary::Root(index), radicand);
    let product = session.terms().product(roots.to_vec());
    session.unique_root(root, value)?;
    session.unique_root(root, product)?;
    Some(())
}

/// A polynomial with squares of square roots replaced by their radicands.
fn without_squares(session: &mut Session, polynomial: &Polynomial) -> Option<Polynomial> {
    let mut current = polynomial.clone();
    for generator in polynomial.generators().into_iter().rev() {
        let Node::Elementary(Elementary::Root(2), of) = session.node(generator) else {
            continue;
        };
        let Some(radicand) = session.numerator_of_polynomial(of) else {
            continue;
        };
        let root = Polynomial::generator(generator);
        let coefficients = coefficients_in(&current, generator);
        let mut sum = Polynomial::default();
        for (power, coefficient) in coefficients.iter().enumerate() {
            let mut product = coefficient.clone();
            for _ in 0..power / 2 {
                product = product.times_within(&radicand, 2000)?;
            }
            if power % 2 == 1 {
                product = product.times(&root);
            }
            sum = sum.plus(&product);
        }
        current = sum;
    }
    Some(current)
}

/// A product of powers of primes, -1, and polynomials.
pub type Form = Vec<(Polynomial, i64)>;

/// The forms of a term as a product: modulo the triangle, and with squares of sines for those of cosines.
pub fn forms(session: &mut Session, term: Term) -> Vec<Form> {
    let Ok(quotient) = session.checker.expansion.of(session.checker.statement.terms(), term) else {
        return Vec::new();
    };
    let mut below = Polynomial::integer(1);
    for (divisor, power) in &quotient.divisors {
        for _ in 0..*power {
            below = below.times(divisor);
        }
    }
    let (Some((above, above_below)), Some((below, below_below))) = (
        session.reduced_quotient(&quotient.numerator),
        session.reduced_quotient(&below),
    ) else {
        return Vec::new();
    };
    let (above, below) = (above.times(&below_below), below.times(&above_below));
    let mut found: Vec<Form> = Vec::new();
    let swapped = with_swapped_squares(session, &above);
    for above in swapped.into_iter().chain([above]) {
        found.extend(split(session, &above, &below));
    }
    found
}

/// The polynomial with the square of a sine or cosine replaced by that of the other.
fn with_swapped_squares(session: &mut Session, polynomial: &Polynomial) -> Option<Polynomial> {
    for generator in polynomial.generators() {
        let Node::Elementary(function, of) = session.node(generator) else {
            continue;
        };
        let other = match function {
            Elementary::Sin => Elementary::Cos,
            Elementary::Cos => Elementary::Sin,
            _ => continue,
        };
        if degree_in(polynomial, generator) != 2 {
            continue;
        }
        let other = session.terms().elementary(other, of);
        let coefficients = coefficients_in(polynomial, generator);
        if !coefficients[1].is_zero() {
            continue;
        }
        let square = Polynomial::integer(1).minus(&Polynomial::generator(other).times(&Polynomial::generator(other)));
        return Some(coefficients[0].plus(&coefficients[2].times(&square)));
    }
    None
}

/// A quotient as a product of powers.
fn split(session: &mut Session, above: &Polynomial, below: &Polynomial) -> Option<Form> {
    if above.is_zero() || below.is_zero() || above.terms().len() > 60 {
        return None;
    }
    let most = session.budget.left() / 20;
    let mut form: Form = Vec::new();
    for (polynomial, sign) in [(above, 1), (below, -1)] {
        let Factors { constant, factors } = session.budget.attempt(most, |steps| factors(polynomial, &[], steps))?;
        number_factors(&constant, sign, &mut form);
        for (factor, exponent) in factors {
            add(&mut form, factor, sign * i64::from(exponent));
        }
    }
    form.retain(|(_, exponent)| *exponent != 0);
    Some(form)
}

fn add(form: &mut Form, factor: Polynomial, exponent: i64) {
    match form.iter_mut().find(|(known, _)| *known == factor) {
        Some((_, known)) => *known += exponent,
        None => form.push((factor, exponent)),
    }
}

fn number_factors(value: &Rational, sign: i64, form: &mut Form) {
    if *value < Rational::zero() {
        add(form, Polynomial::integer(-1), 1);
    }
    let numerator = UBig::try_from(value.0.numerator().clone())
        .unwrap_or_else(|_| UBig::try_from(-value.0.numerator().clone()).unwrap_or(UBig::ONE));
    for (mut rest, sign) in [(numerator, sign), (value.0.denominator().clone(), -sign)] {
        let mut prime = 2_u64;
        while prime <= LARGEST_PRIME && rest != UBig::ONE {
            let mut count = 0;
            while &rest % UBig::from(prime) == UBig::ZERO {
                rest /= UBig::from(prime);
                count += 1;
            }
            if count > 0 {
                add(form, Polynomial::constant(&whole(UBig::from(prime))), sign * count);
            }
            prime += if prime == 2 { 1 } else { 2 };
            if UBig::from(prime) * UBig::from(prime) > rest {
                break;
            }
        }
        if rest != UBig::ONE {
            add(form, Polynomial::constant(&whole(rest)), sign);
        }
    }
}

fn whole(value: UBig) -> Rational {
    Rational(IBig::from(value).into())
}

/// The root of a product, as a term.
fn value(session: &mut Session, index: u32, form: &Form) -> Option<Term> {
    let count = i64::from(index);
    let mut pieces: Vec<(Term, i64)> = Vec::new();
    let (mut negative, mut together) = (false, Polynomial::integer(1));
    for (factor, exponent) in form {
        if *factor == Polynomial::integer(-1) {
            negative ^= exponent % 2 != 0;
            continue;
        }
        let (mut outside, mut inside) = (exponent.div_euclid(count), exponent.rem_euclid(count));
        if index % 2 == 1 {
            let base = session.polynomial_term(factor);
            if let Some(constant) = factor.as_constant()
                && constant.is_one()
            {
                continue;
            }
            push(&mut pieces, base, outside);
            if inside > 0 {
                let root = session.terms().elementary(Elementary::Root(index), base);
                push(&mut pieces, root, inside);
            }
            continue;
        }
        let known = if session.show_sign(factor, false).is_some() {
            Some(1)
        } else if session.show_sign(&factor.negated(), false).is_some() {
            Some(-1)
        } else {
            None
        };
        let base = match known {
            Some(1) => session.polynomial_term(factor),
            Some(_) => {
                negative ^= exponent % 2 != 0;
                session.polynomial_term(&factor.negated())
            }
            None => {
                // the absolute value of what stands outside; what stands inside an odd number of times stays together
                if exponent % 2 != 0 {
                    together = together.times(factor);
                    let even = exponent - 1;
                    (outside, inside) = (even.div_euclid(count), even.rem_euclid(count));
                }
                let base = session.polynomial_term(factor);
                let square = session.terms().add(Node::Power(base, 2));
                session.terms().elementary(Elementary::Root(2), square)
            }
        };
        push(&mut pieces, base, outside);
        if inside > 0 {
            let root = session.terms().elementary(Elementary::Root(index), base);
            push(&mut pieces, root, inside);
        }
    }
    if index.is_multiple_of(2) {
        if negative {
            together = together.negated();
        }
        if together != Polynomial::integer(1) {
            session.show_sign(&together, false)?;
            let base = session.polynomial_term(&together);
            let root = session.terms().elementary(Elementary::Root(index), base);
            push(&mut pieces, root, 1);
        }
    }
    let (mut above, mut below) = (Vec::new(), Vec::new());
    if index % 2 == 1 && negative {
        above.push(session.terms().integer(-1));
    }
    for (base, exponent) in pieces {
        let size = i32::try_from(exponent.unsigned_abs()).ok()?;
        let power = if size == 1 {
            base
        } else {
            session.terms().add(Node::Power(base, size))
        };
        if exponent > 0 {
            above.push(power);
        } else {
            below.push(power);
        }
    }
    let above = session.terms().product(above);
    if below.is_empty() {
        return Some(above);
    }
    let below = session.terms().product(below);
    Some(session.terms().quotient(above, below))
}

fn push(pieces: &mut Vec<(Term, i64)>, base: Term, exponent: i64) {
    if exponent != 0 {
        pieces.push((base, exponent));
    }
}

impl Session<'_> {
    /// Whether a generator is expressed by others.
    pub fn is_determined(&self, term: Term) -> bool {
        self.triangle
            .iter()
            .any(|pivot| pivot.generator == term && pivot.degree == 1)
    }

    /// What is known of the roots inside a term by themselves.
    pub fn describe_roots(&mut self, term: Term) {
        for inner in self.checker.statement.terms().inside(term) {
            self.describe_root(inner);
        }
    }

    /// The power of a root, and its sign.
    pub fn describe_root(&mut self, root: Term) {
        if let Node::Elementary(Elementary::Root(index), of) = self.node(root) {
            let terms = [self.terms().integer(i64::from(index)), of];
            self.axiom("RootPower", &terms);
            if index % 2 == 0 {
                self.axiom("RootNonNegative", &terms);
            }
        }
    }

    /// Shows that a root is a value.
    pub fn unique_root(&mut self, root: Term, value: Term) -> Option<usize> {
        let found = self.unique_root_fact(root, value)?;
        self.triangulate_all();
        Some(found)
    }

    /// Shows that a root is a value, and leaves the triangle as it is.
    pub fn unique_root_fact(&mut self, root: Term, value: Term) -> Option<usize> {
        let Node::Elementary(Elementary::Root(index), of) = self.node(root) else {
            return None;
        };
        self.describe_roots(value);
        self.triangulate_all();
        let power = self.terms().add(Node::Power(value, i32::try_from(index).ok()?));
        self.show_equal(power, of)?;
        if index % 2 == 0 || self.checker.statement.is_complex() {
            let signed = self.signed_numerator(value)?;
            self.show_sign(&signed, false)?;
        }
        let terms = [self.terms().integer(i64::from(index)), of, value];
        self.axiom("RootUnique", &terms)
            .or_else(|| self.axiom("OddRootUnique", &terms))
    }

    /// The polynomial whose sign is that of a term: the numerator times what divides to an odd power.
    pub fn signed_numerator(&mut self, term: Term) -> Option<Polynomial> {
        let quotient = self.checker.expansion.of(self.checker.statement.terms(), term).ok()?;
        let mut product = quotient.numerator;
        for (divisor, power) in &quotient.divisors {
            if power % 2 == 1 {
                product = product.times(divisor);
            }
        }
        Some(product)
    }
}
