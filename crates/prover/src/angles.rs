//! Sines, cosines and exponentials of sums: written in those of a basis of their arguments.
//!
//! Complete for identities that hold modulo sin² + cos² = 1 (exp x exp(-x) = 1) of the basis: every argument is a
//! whole combination of basis arguments, so that u/2, u and 3u share one; multiples of pi are algebraic numbers.

use super::session::Session;
use dashu_int::ops::Gcd;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use kernel::{Elementary, Inference, Monomial, Node, Polynomial, Term};
use numbers::{Field, Rational};
use std::collections::{BTreeMap, BTreeSet};

/// An atom of arguments: a product of generators over divisors.
type Atom = (Monomial, Vec<(Polynomial, u32)>);

/// The largest multiple of a basis argument that is written out.
const LARGEST_MULTIPLE: i64 = 64;

/// The most summands of an argument that are written out: each takes four steps, each longer than the one before.
const MOST_SUMMANDS: usize = 24;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Family {
    Circular,
    Exponential,
}

/// Adds what is known of the sines, cosines and exponentials among these terms.
pub fn expand(session: &mut Session, met: &BTreeSet<Term>) -> bool {
    let mut changed = false;
    for family in [Family::Circular, Family::Exponential] {
        let wanted = |function: Elementary| match family {
            Family::Circular => matches!(function, Elementary::Sin | Elementary::Cos),
            Family::Exponential => function == Elementary::Exp,
        };
        let mut arguments: BTreeSet<Term> = BTreeSet::new();
        for &term in met {
            if let Node::Elementary(function, of) = session.node(term)
                && wanted(function)
            {
                arguments.insert(of);
            }
        }
        if !arguments.is_empty() {
            changed |= expand_family(session, family, &arguments);
        }
    }
    changed
}

/// An argument as a combination of atoms with rational coefficients, modulo what the premises say.
fn combination(session: &mut Session, argument: Term) -> Option<Vec<(Atom, RBig)>> {
    let quotient = session
        .checker
        .expansion
        .of(session.checker.statement.terms(), argument)
        .ok()?;
    let numerator = if quotient.divisors.is_empty() {
        session.normal_form(&quotient.numerator)?
    } else {
        quotient.numerator
    };
    let terms = numerator
        .terms()
        .iter()
        .map(|(monomial, value)| (in_lowest_terms(monomial, &quotient.divisors), value.clone()));
    Some(terms.collect())
}

/// A monomial over divisors, without the generators that both have; divisors that are products are taken apart.
fn in_lowest_terms(monomial: &Monomial, divisors: &[(Polynomial, u32)]) -> Atom {
    let mut powers: BTreeMap<Term, i64> = monomial.iter().map(|&(term, power)| (term, i64::from(power))).collect();
    let mut below = Vec::new();
    for (divisor, power) in divisors {
        match divisor.terms() {
            [(product, value)] if *value == RBig::ONE => {
                for &(term, own) in product {
                    *powers.entry(term).or_default() -= i64::from(own) * i64::from(*power);
                }
            }
            _ => below.push((divisor.clone(), *power)),
        }
    }
    let mut above = Monomial::new();
    for (term, power) in powers {
        let size = u32::try_from(power.unsigned_abs()).unwrap_or(u32::MAX);
        match power {
            0 => {}
            1.. => above.push((term, size)),
            _ => below.push((Polynomial::generator(term), size)),
        }
    }
    (above, below)
}

fn expand_family(session: &mut Session, family: Family, arguments: &BTreeSet<Term>) -> bool {
    let before = session.checker.facts.len();
    let mut combinations: Vec<(Term, Vec<(Atom, RBig)>)> = Vec::new();
    let mut denominators: Vec<(Atom, UBig)> = Vec::new();
    for &argument in arguments {
        let Some(parts) = combination(session, argument).filter(|parts| parts.len() <= MOST_SUMMANDS) else {
            continue;
        };
        for (atom, value) in &parts {
            let below = value.denominator().clone();
            match denominators.iter_mut().find(|(known, _)| known == atom) {
                Some((_, known)) => *known = least_common(known, &below),
                None => denominators.push((atom.clone(), below)),
            }
        }
        combinations.push((argument, parts));
    }
    let pi = session.terms().add(Node::Pi);
    let mut basis: Vec<(Atom, Term, UBig)> = Vec::new();
    for (atom, below) in denominators {
        let is_pi = family == Family::Circular && atom.1.is_empty() && atom.0.as_slice() == [(pi, 1)];
        // the sine of pi/n is a polynomial in its cosine for even n
        let below = if is_pi && &below % UBig::from(2_u8) != UBig::ZERO {
            below * UBig::from(2_u8)
        } else {
            below
        };
        let term = atom_term(session, &atom);
        let number = Rational(RBig::from_parts(IBig::ONE, below.clone()));
        let factor = session.terms().number(number);
        let base = if below == UBig::ONE {
            term
        } else {
            session.terms().product(vec![factor, term])
        };
        if family == Family::Circular {
            half_turns(session, pi, &atom, base);
        }
        imaginary(session, family, &atom, base);
        if is_pi {
            let Ok(count) = i64::try_from(&below) else { continue };
            if count > LARGEST_MULTIPLE {
                continue;
            }
            pi_over(session, pi, base, count);
        } else if family == Family::Circular {
            session.axiom("Pythagoras", &[base]);
        } else {
            exponential_base(session, base);
        }
        basis.push((atom, base, below));
    }
    for (argument, parts) in combinations {
        let mut pieces: Vec<Term> = Vec::new();
        let mut fits = true;
        for (atom, value) in &parts {
            let Some((_, base, below)) = basis.iter().find(|(known, ..)| known == atom).cloned() else {
                fits = false;
                continue;
            };
            let count = value * RBig::from(below);
            let count = if *count.denominator() == UBig::ONE {
                i64::try_from(count.numerator()).ok()
            } else {
                None
            };
            match count.filter(|count| count.abs() <= LARGEST_MULTIPLE) {
                Some(count) => pieces.push(multiple(session, family, base, count)),
                None => fits = false,
            }
        }
        if fits {
            sum(session, family, argument, &pieces);
        }
    }
    session.checker.facts.len() > before
}

/// Euler's formula, for an argument with the imaginary unit as a factor.
fn imaginary(session: &mut Session, family: Family, atom: &Atom, base: Term) -> Option<()> {
    let unit = session.terms().add(Node::Imaginary);
    if !atom.0.iter().any(|&(term, _)| term == unit) {
        return None;
    }
    let polynomial = session.numerator_of_polynomial(base)?;
    match family {
        Family::Exponential => {
            // base = i angle
            let angle = polynomial.times(&Polynomial::generator(unit)).negated();
            let angle = session.normal_form(&angle)?;
            let angle = session.polynomial_term(&angle);
            session.axiom("ExpOfImaginary", &[angle])?;
            let product = session.terms().product(vec![unit, angle]);
            congruent(session, family, base, product);
        }
        Family::Circular => {
            for angle in [polynomial.clone(), polynomial.negated()] {
                let angle = session.polynomial_term(&angle);
                session.axiom("ExpOfImaginary", &[angle]);
            }
        }
    }
    Some(())
}

/// The functions of two arguments that are equal.
fn congruent(session: &mut Session, family: Family, a: Term, b: Term) {
    if a == b || session.show_equal(a, b).is_none() {
        return;
    }
    for &function in functions(family) {
        let [left, right] = [a, b].map(|at| session.terms().elementary(function, at));
        let _ = session.step(Inference::Congruence { left, right });
    }
}

/// The sine and cosine of a whole multiple of pi.
fn half_turns(session: &mut Session, pi: Term, atom: &Atom, base: Term) -> Option<()> {
    let others: Vec<_> = atom.0.iter().copied().filter(|&(term, _)| term != pi).collect();
    if others.len() + 1 != atom.0.len() || others.is_empty() || !atom.1.is_empty() {
        return None;
    }
    let count = atom_term(session, &(others.into_iter().collect(), Vec::new()));
    session.axiom("SineOfHalfTurns", &[count])?;
    session.axiom("CosineOfHalfTurns", &[count])?;
    let whole = session.terms().product(vec![pi, count]);
    congruent(session, Family::Circular, base, whole);
    Some(())
}

fn least_common(a: &UBig, b: &UBig) -> UBig {
    a * b / a.gcd(b)
}

fn atom_term(session: &mut Session, atom: &Atom) -> Term {
    let mut factors = Vec::new();
    for &(term, power) in &atom.0 {
        let exponent = i32::try_from(power).unwrap_or(i32::MAX);
        factors.push(if power == 1 {
            term
        } else {
            session.terms().add(Node::Power(term, exponent))
        });
    }
    let above = session.terms().product(factors);
    if atom.1.is_empty() {
        return above;
    }
    let mut below = Vec::new();
    for (polynomial, power) in &atom.1 {
        let term = session.polynomial_term(polynomial);
        let exponent = i32::try_from(*power).unwrap_or(i32::MAX);
        below.push(if *power == 1 {
            term
        } else {
            session.terms().add(Node::Power(term, exponent))
        });
    }
    let below = session.terms().product(below);
    session.terms().quotient(above, below)
}

fn functions(family: Family) -> &'static [Elementary] {
    match family {
        Family::Circular => &[Elementary::Sin, Elementary::Cos],
        Family::Exponential => &[Elementary::Exp],
    }
}

/// The axiom for a function of a sum of two terms.
fn of_sum(session: &mut Session, family: Family, sum: Term, parts: [Term; 2]) {
    match family {
        Family::Circular => {
            session.axiom("SineOfSum", &[sum, parts[0], parts[1]]);
            session.axiom("CosineOfSum", &[sum, parts[0], parts[1]]);
        }
        Family::Exponential => {
            session.axiom("ExpOfSum", &[sum, parts[0], parts[1]]);
        }
    }
}

/// The multiple of a basis argument, with what is known of its functions.
fn multiple(session: &mut Session, family: Family, base: Term, count: i64) -> Term {
    if count == 1 {
        return base;
    }
    let factor = session.terms().integer(count);
    let term = session.terms().product(vec![factor, base]);
    match count {
        0 => zero(session, family, term),
        ..0 => {
            let positive = multiple(session, family, base, -count);
            negative(session, family, term, positive);
        }
        _ => {
            let half = count / 2;
            let (low, high) = (
                multiple(session, family, base, half),
                multiple(session, family, base, count - half),
            );
            of_sum(session, family, term, [low, high]);
        }
    }
    term
}

fn zero(session: &mut Session, family: Family, term: Term) {
    match family {
        Family::Circular => {
            session.axiom("SineOfZero", &[term]);
            session.axiom("CosineOfZero", &[term]);
        }
        Family::Exponential => {
            session.axiom("ExpOfZero", &[term]);
        }
    }
}

fn negative(session: &mut Session, family: Family, negative: Term, of: Term) {
    match family {
        Family::Circular => {
            session.axiom("SineOfNegative", &[negative, of]);
            session.axiom("CosineOfNegative", &[negative, of]);
        }
        Family::Exponential => {
            exponential_base(session, of);
            let sum = session.terms().sum(vec![negative, of]);
            session.axiom("ExpOfZero", &[sum]);
            session.axiom("ExpOfSum", &[sum, negative, of]);
        }
    }
}

fn exponential_base(session: &mut Session, base: Term) {
    if session.axiom("ExpPositive", &[base]).is_none() {
        session.axiom("ExpNonzero", &[base]);
    }
}

/// Connects a function of an argument with those of the pieces it is the sum of.
fn sum(session: &mut Session, family: Family, argument: Term, pieces: &[Term]) {
    let whole = session.terms().sum(pieces.to_vec());
    let mut so_far = match pieces {
        [] => {
            let nothing = session.terms().integer(0);
            zero(session, family, nothing);
            nothing
        }
        [first, ..] => *first,
    };
    for (count, piece) in pieces.iter().enumerate().skip(1) {
        let next = if count + 1 == pieces.len() {
            whole
        } else {
            session.terms().sum(pieces[..=count].to_vec())
        };
        of_sum(session, family, next, [so_far, *piece]);
        so_far = next;
    }
    // equal by themselves, or by what the premises say
    congruent(session, family, argument, so_far);
}

/// The cosine of pi/count by its minimal polynomial, the sine as a polynomial in it; count is even.
fn pi_over(session: &mut Session, pi: Term, base: Term, count: i64) {
    session.axiom("SineOfPi", &[]);
    session.axiom("CosineOfPi", &[]);
    if session.axiom("Pythagoras", &[base]).is_none() {
        return;
    }
    let turned = multiple(session, Family::Circular, base, count);
    congruent(session, Family::Circular, turned, pi);
    let sine = session.terms().elementary(Elementary::Sin, base);
    let cosine = session.terms().elementary(Elementary::Cos, base);
    let (s, c) = (Polynomial::generator(sine), Polynomial::generator(cosine));
    // T_n(c) + 1 is 0; it is the square of the minimal polynomial, up to factors that are not 0 at cos(pi/n)
    let minimal = minimal_polynomial(count, &c);
    let chebyshev = chebyshev(count, &c).plus(&Polynomial::integer(1));
    let Some(known) = session.show_with_family(&chebyshev) else {
        return;
    };
    let mut square = minimal.times(&minimal);
    let mut power = 2;
    let mut rest = crate::algebra::exact_quotient(&chebyshev, &square, &mut session.budget)
        .ok()
        .flatten();
    if rest.is_none() {
        (square, power) = (minimal.clone(), 1);
        rest = crate::algebra::exact_quotient(&chebyshev, &square, &mut session.budget)
            .ok()
            .flatten();
    }
    let Some(rest) = rest else { return };
    let (factors, scale) = match rest.as_constant() {
        Some(value) => (Vec::new(), value),
        None => match session.closed_nonzero(&rest) {
            Some((fact, sign)) => (vec![(fact, 1)], Rational::from_integer(sign)),
            None => return,
        },
    };
    // factors * minimal^power = chebyshev / scale
    let one = <Rational as Field>::from_integer(1);
    let step = Inference::Zero {
        target: minimal.clone(),
        power,
        squares: Vec::new(),
        factors,
        terms: vec![(Polynomial::constant(&(one / scale)), known)],
    };
    if session.step(step).is_err() {
        return;
    }
    // sin(pi/n) = cos((n/2 - 1) pi/n)
    let other = self::chebyshev(count / 2 - 1, &c);
    let (difference, sum) = (s.minus(&other), s.plus(&other));
    if session.closed_nonzero(&sum).is_some() {
        session.show_with_family(&difference);
    }
}

impl Session<'_> {
    /// Shows that a polynomial in sines and cosines of one argument vanishes, from what is known by now.
    fn show_with_family(&mut self, polynomial: &Polynomial) -> Option<usize> {
        self.triangulate_all();
        self.show_zero(polynomial)
    }
}

/// The Chebyshev polynomial of the first kind (DLMF 18.9.1).
fn chebyshev(degree: i64, at: &Polynomial) -> Polynomial {
    let (mut before, mut now) = (Polynomial::integer(1), at.clone());
    if degree == 0 {
        return before;
    }
    let twice = at.scaled(&Rational::from_integer(2));
    for _ in 1..degree {
        let next = twice.times(&now).minus(&before);
        before = std::mem::replace(&mut now, next);
    }
    now
}

/// The minimal polynomial of cos(pi/n), from its conjugates 2 cos(pi j/n), j prime to 2n, whose sums of products are
/// integers. Where rounding misleads, the kernel does not accept what follows.
fn minimal_polynomial(count: i64, cosine: &Polynomial) -> Polynomial {
    let coprime = |j: &i64| {
        let (mut a, mut b) = (*j, 2 * count);
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a == 1
    };
    let roots = (1..=count)
        .filter(coprime)
        .map(|j| 2.0 * (std::f64::consts::PI * j as f64 / count as f64).cos());
    let mut coefficients = vec![1.0_f64];
    for root in roots {
        let mut next = vec![0.0; coefficients.len() + 1];
        for (power, value) in coefficients.iter().enumerate() {
            next[power + 1] += value;
            next[power] -= root * value;
        }
        coefficients = next;
    }
    let twice = cosine.scaled(&Rational::from_integer(2));
    coefficients.iter().rev().fold(Polynomial::default(), |sum, value| {
        sum.times(&twice).plus(&Polynomial::integer(value.round() as i64))
    })
}
