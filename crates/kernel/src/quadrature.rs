//! Enclosures of definite integrals of elementary functions between numbers.
//!
//! The interval is halved until each piece is done in one of two ways (Petras, "Principles of verified numerical
//! integration", 2007; Johansson, "Numerical integration in arbitrary-precision ball arithmetic", 2018):
//!
//! - by the rule of Gauss and Legendre, with a bound of its error from a bound of the integrand on a rectangle of complex
//!   numbers around the piece, where the integrand is shown to be holomorphic;
//! - by the mean value theorem, an enclosure of the integrand on the piece times its length.
//!
//! Both show that the integrand is defined and continuous on the closed piece. At an end of the interval where that is not
//! shown, the pieces become shorter toward the end, and the last one is done by a germ (`ends`), which shows that the
//! integrand is continuous up to the end, and that the integral converges absolutely there.

use super::enclosure::{
    Complex, complex_elementary, complex_ln, complex_quotient, complex_root, complex_value, plus, rational, term_value,
    times,
};
use super::ends::{Beside, End, Exact};
use super::polynomial::Polynomial;
use super::term::{Elementary, Node, Term, Terms};
use dashu_ratio::RBig;
use num_traits::{One, Zero};
use numbers::{Analytic, Endpoint, Field, Interval, Rational, Wide};
use std::cell::RefCell;
use std::collections::HashMap;
use std::f64::consts::PI;

/// The nodes of the rule: an even number, at least 2.
const NODES: i32 = 16;

/// The sum of the half axes of the ellipse around a piece from -1 to 1. It leaves out what lies one length from an end of the
/// piece, so that halving toward a singular end leaves pieces that are done.
const ELLIPSE: i64 = 5;

/// The power of two that a node is looked for within, above the rounding of 40 digits.
const RADIUS: i32 = -120;

/// An error of a piece is small enough at this power of two times the length times some values of the integrand.
const ACCURACY: i32 = -70;

/// The same for an interval with an end that needs a germ.
const ACCURACY_OF_GERMS: i32 = -64;

/// The most halvings: where neither the mean value theorem nor a germ says anything even then, there is no enclosure.
const SHORTEST: u32 = 56;

/// The most values, over numbers, intervals and rectangles, of all terms with the letter in the integrand together.
const EFFORT: usize = 20_000;

/// Halvings toward an end from one germ to the next.
const GERMS: u32 = 2;

/// The values that a germ counts for.
const GERM: usize = 8;

/// The largest degree of a polynomial under a root that is looked at from the end of a piece.
const DEGREE: u32 = 32;

impl Terms {
    /// The integral of a term in the bound letter alone between closed terms; none where it is not shown to have a value: that
    /// what is integrated is continuous between the ends, and that the integral converges absolutely at each of them.
    pub fn integral(&mut self, of: Term, low: Term, high: Term) -> Option<Term> {
        let is_of_letter = |inner: &Term| {
            let node = self.node(*inner);
            *node == Node::Bound || self.is_closed(*inner) || !self.parts(*inner).is_empty()
        };
        let is_plain = |inner: &Term| {
            !matches!(
                self.node(*inner),
                Node::Imaginary | Node::Integral { .. } | Node::Value(..)
            )
        };
        let is_known = |term: &Term| (term.0 as usize) < self.len();
        let is_integral = [of, low, high].iter().all(is_known)
            && self.is_closed(low)
            && self.is_closed(high)
            && self
                .inside(of)
                .iter()
                .all(|inner| is_of_letter(inner) && is_plain(inner));
        let letter = self.add(Node::Bound);
        is_integral.then_some(())?;
        let key = [of, low, high].map(|term| self.renumbered(term));
        let known = KNOWN.with_borrow(|known| known.get(&key).cloned());
        let bounds = known.unwrap_or_else(|| {
            let bounds = bounds(self, of, letter, [low, high]);
            // an integral within a limit is no part of it
            let is_whole = |nodes: &Vec<Node>| !nodes.iter().any(|node| matches!(node, Node::Integral { .. }));
            if key.iter().all(is_whole) {
                KNOWN.with_borrow_mut(|known| {
                    if known.len() >= MOST_KNOWN {
                        known.clear();
                    }
                    known.insert(key, bounds.clone());
                });
            }
            bounds
        });
        Some(self.add_integral([of, low, high], bounds?))
    }

    /// The nodes inside a term, in which terms are the numbers of their places: the same for equal terms of all stores.
    fn renumbered(&self, term: Term) -> Vec<Node> {
        let inside = self.inside(term);
        let place = |part: Term| {
            inside
                .binary_search(&part)
                .ok()
                .and_then(|place| u32::try_from(place).ok())
        };
        let moved = |part: Term| Term(place(part).unwrap_or(u32::MAX));
        inside
            .iter()
            .map(|inner| self.node(*inner).with_parts(&moved))
            .collect()
    }
}

/// The nodes of an integrand and of the ends of its interval.
type Key = [Vec<Node>; 3];

/// The most integrals whose bounds are kept.
const MOST_KNOWN: usize = 256;

thread_local! {
    /// Bounds of integrals that were found before: one claim builds the same integral in several stores.
    static KNOWN: RefCell<HashMap<Key, Option<[Rational; 2]>>> = RefCell::new(HashMap::new());
}

/// Bounds of the integral of a term by the bound letter between closed terms, where it is shown to have a value.
fn bounds(terms: &Terms, of: Term, letter: Term, ends: [Term; 2]) -> Option<[Rational; 2]> {
    let end = |term: Term| {
        let value = term_value::<Wide<40>>(terms, term, &mut HashMap::new())?;
        let exact = Exact::value(terms, term);
        Some(End { value, exact })
    };
    let [low, high] = ends.map(end);
    let found = integral(terms, of, letter, &low?, &high?)?;
    let below = beside(&found.low(), -1)?;
    let above = beside(&found.high(), 1)?;
    // rounding of the bounds is none of their own
    let is_bound =
        rational::<Wide<40>>(&below)?.high() <= found.low() && found.high() <= rational::<Wide<40>>(&above)?.low();
    is_bound.then_some([below, above])
}

/// A rational number a little below (-1) or above (1) another one.
fn beside(bound: &Wide<40>, side: i64) -> Option<Rational> {
    let (mut sum, mut rest) = (RBig::ZERO, bound.clone());
    for _ in 0..3 {
        let part = rest.to_f64();
        sum += RBig::try_from(part).ok()?;
        rest -= Wide::from_f64(part);
    }
    let margin = RBig::try_from(bound.to_f64().abs().max(f64::MIN_POSITIVE) * 1e-35).ok()?;
    Some(Rational(sum + margin * RBig::from(side)))
}

/// An enclosure of the integral of a term by the bound letter between two numbers that are enclosed, the first of which may be the
/// larger one. The term is that of a statement about real numbers. `None` where it is not shown that it is continuous between
/// these numbers, and that the integral converges absolutely at each of them.
pub(super) fn integral<E: Endpoint>(
    terms: &Terms,
    of: Term,
    by: Term,
    low: &End<E>,
    high: &End<E>,
) -> Option<Interval<E>> {
    (low.value.is_finite() && high.value.is_finite()).then_some(())?;
    let mut integrand = Integrand::new(terms, of, by)?;
    let sum = if low.value.midpoint() > high.value.midpoint() {
        -integrand.over(high, low)?
    } else {
        integrand.over(low, high)?
    };
    sum.is_finite().then_some(sum)
}

/// A term as a function of the bound letter.
struct Integrand<'a, E: Endpoint> {
    terms: &'a Terms,
    of: Term,
    by: Term,
    /// The values of what is inside without the letter: those over real numbers, over complex ones too.
    constants: HashMap<Term, Interval<E>>,
    /// The nodes and weights of the rule.
    rule: Vec<[Interval<E>; 2]>,
    /// The values of the integrand that may still be computed, by number.
    left: usize,
}

impl<'a, E: Endpoint> Integrand<'a, E> {
    fn new(terms: &'a Terms, of: Term, by: Term) -> Option<Self> {
        matches!(terms.node(by), Node::Bound).then_some(())?;
        let mut constants = HashMap::new();
        for inner in terms.inside(of).into_iter().filter(|&inner| terms.is_closed(inner)) {
            term_value(terms, inner, &mut constants)?;
        }
        Some(Self {
            terms,
            of,
            by,
            rule: rule()?,
            left: EFFORT / (terms.inside(of).len() - constants.len()).max(1),
            constants,
        })
    }

    /// An enclosure of the integral from one end to another, whose middle is not below that of the first one.
    fn over(&mut self, lower: &End<E>, upper: &End<E>) -> Option<Interval<E>> {
        let (from, to) = (lower.value.midpoint(), upper.value.midpoint());
        let germs = [(lower, to.clone(), true), (upper, from.clone(), false)]
            .map(|(end, other, is_above)| self.needs_germ(end, &other, is_above));
        let [is_below, is_above] = germs;
        let power = if is_below || is_above {
            ACCURACY_OF_GERMS
        } else {
            ACCURACY
        };
        let small = self.sizes(&from, &to) * E::from_integer(2).to_power(power);
        if !is_below && !is_above {
            // from l in `lower` to h in `upper`: from l to `from`, on to `to`, and from there to h, in whatever order they lie
            let between = self.between(&from, &to, &small)?;
            return Some(self.next_to(&lower.value, from)? + between - self.next_to(&upper.value, to)?);
        }
        // here the ends are apart
        (lower.value.high() < upper.value.low()).then_some(())?;
        let middle = match (is_below, is_above) {
            (true, true) => Interval::new(from.clone(), to.clone()).midpoint(),
            (true, false) => to.clone(),
            _ => from.clone(),
        };
        let mut sum = Interval::zero();
        if is_below {
            let all = self.left;
            self.left = if is_above { all / 2 } else { all };
            sum += self.toward(lower, middle.clone(), true, &small)?;
            self.left = if is_above { self.left + all / 2 } else { self.left };
        } else {
            sum += self.next_to(&lower.value, from)?;
        }
        if is_above {
            sum += self.toward(upper, middle, false, &small)?;
        } else {
            sum -= self.next_to(&upper.value, to)?;
        }
        Some(sum)
    }

    /// The part of the way from an end to another number that is next to the end, after all halvings.
    fn last_piece(end: &End<E>, other: &E) -> Interval<E> {
        let distance = other.clone() - end.value.midpoint();
        let next = end.value.midpoint() + distance * E::from_integer(2).to_power(-(SHORTEST as i32));
        end.value.hull(&Interval::point(next))
    }

    /// Returns true if a germ is to be used at an end: where the integrand has no values next to it, and where it is not
    /// holomorphic there and has a germ. Nothing rests on it but how the integral is found.
    fn needs_germ(&mut self, end: &End<E>, other: &E, is_above: bool) -> bool {
        let piece = Self::last_piece(end, other);
        if self.error(&piece).is_some() {
            return self.value(&piece).is_none();
        }
        let next = if is_above { piece.high() } else { piece.low() };
        self.value(&piece).is_none() || self.germ(end, &next, is_above).is_some()
    }

    /// An enclosure of the integral between an end and a number, by the germ of the integrand at the end.
    fn germ(&mut self, end: &End<E>, number: &E, is_above: bool) -> Option<Interval<E>> {
        self.left = self.left.checked_sub(GERM)?;
        let (terms, of, by) = (self.terms, self.of, self.by);
        let beside = Beside {
            terms,
            of,
            by,
            end,
            is_above,
        };
        let distance = match is_above {
            true => Interval::point(number.clone()) - end.value.clone(),
            false => end.value.clone() - Interval::point(number.clone()),
        };
        beside.integral(&distance, &self.constants)
    }

    /// An enclosure of the integral between an end and a number above it, or below: pieces toward the end that become shorter,
    /// until the germ is narrow enough, or what may be computed is. The last enclosure found is the one that is used.
    fn toward(&mut self, end: &End<E>, number: E, is_above: bool, small: &E) -> Option<Interval<E>> {
        let last = Self::last_piece(end, &number);
        let last = if is_above { last.high() } else { last.low() };
        // without a germ next to the end there is none farther off
        self.germ(end, &last, is_above)?;
        let (mut sum, mut found, mut far) = (Interval::zero(), None, number);
        for halvings in 0..=SHORTEST {
            let germ = (halvings % GERMS == 0 || self.left < EFFORT / 100).then(|| self.germ(end, &far, is_above));
            if let Some(germ) = germ.flatten() {
                let is_done = germ.width() <= *small;
                found = Some(sum.clone() + germ);
                if is_done {
                    break;
                }
            }
            let middle = end.value.midpoint();
            let near = middle.clone() + (far.clone() - middle) / E::from_integer(2);
            let (from, to) = if is_above { (&near, &far) } else { (&far, &near) };
            let Some(piece) = self.between(from, to, small) else {
                break;
            };
            sum += piece;
            far = near;
        }
        found
    }

    /// An enclosure of the integral from `from` to `to`, which is not below it, where the integrand is continuous on the closed
    /// interval.
    fn between(&mut self, from: &E, to: &E, small: &E) -> Option<Interval<E>> {
        let (mut sum, mut smooth) = (Interval::zero(), Vec::new());
        let mut open = vec![(Interval::new(from.clone(), to.clone()), 0)];
        while let Some((piece, halvings)) = open.pop() {
            let error = self.error(&piece);
            if let Some(error) = error.clone().filter(|error| error.high() <= *small) {
                smooth.push((piece, error));
                continue;
            }
            let last = halvings >= SHORTEST || piece.low() == piece.high();
            let length = Interval::point(piece.high()) - Interval::point(piece.low());
            let flat = (last || error.is_none()).then(|| self.value(&piece)).flatten();
            let flat = flat.map(|value| value * length);
            if let Some(flat) = flat.filter(|flat| last || flat.width() <= *small) {
                sum += flat;
                continue;
            }
            let (lower, upper) = (!last).then(|| piece.halves())?;
            open.extend([(upper, halvings + 1), (lower, halvings + 1)]);
        }
        // only once all pieces are known to be done
        for (piece, error) in smooth {
            sum += self.gauss(&piece)? + error;
        }
        Some(sum)
    }

    /// The size of some values of the integrand, times the length. Nothing rests on it but when to stop.
    fn sizes(&mut self, from: &E, to: &E) -> E {
        let (mut sizes, length) = (E::zero(), to.clone() - from.clone());
        for part in [3, 10, 17, 22, 29, 37] {
            let at = Interval::point(from.clone() + length.clone() * E::from_ratio(part, 41));
            sizes += self.value(&at).map_or_else(E::zero, |value| value.magnitude());
        }
        sizes * length
    }

    /// The values over real numbers; `None` where one of them is not known to be defined.
    fn value(&mut self, at: &Interval<E>) -> Option<Interval<E>> {
        self.left = self.left.checked_sub(1)?;
        let mut known = self.constants.clone();
        known.insert(self.by, at.clone());
        if let Some(value) = term_value(self.terms, self.of, &mut known) {
            return Some(value);
        }
        // what is 0 at an end of a domain may be rounded below 0, and its square root be lost
        for inner in self.terms.inside(self.of) {
            let Node::Elementary(Elementary::Root(2), radicand) = self.terms.node(inner) else {
                continue;
            };
            let seen = [at.low(), at.high()].map(|end| seen_from(self.terms, *radicand, self.by, at, end));
            let inside = seen.into_iter().flatten().find(|seen| seen.low() >= E::zero());
            known.extend(inside.map(|seen| (*radicand, seen)));
        }
        term_value(self.terms, self.of, &mut known)
    }

    /// The integral from a number that an end encloses to a number in that enclosure, by the mean value theorem.
    fn next_to(&mut self, end: &Interval<E>, number: E) -> Option<Interval<E>> {
        let difference = Interval::point(number) - end.clone();
        if difference.is_zero() {
            return Some(difference);
        }
        Some(difference * self.value(end)?)
    }

    /// The middle and half the length of a piece.
    fn placed(piece: &Interval<E>) -> [Interval<E>; 2] {
        let (low, high) = (Interval::point(piece.low()), Interval::point(piece.high()));
        let two = Interval::from_integer(2);
        [(low.clone() + high.clone()) / two.clone(), (high - low) / two]
    }

    /// The sum of the rule on a piece.
    fn gauss(&mut self, piece: &Interval<E>) -> Option<Interval<E>> {
        let ([middle, half], mut sum) = (Self::placed(piece), Interval::zero());
        for [node, weight] in self.rule.clone() {
            sum += weight * self.value(&(middle.clone() + half.clone() * node))?;
        }
        Some(sum * half)
    }

    /// From minus to plus a bound of the error of the rule on a piece.
    ///
    /// For f holomorphic and of size at most M inside the ellipse with the foci -1 and 1 and the half axes (r + 1/r)/2 and
    /// (r - 1/r)/2, r > 1, the rule of n >= 2 nodes is wrong by at most (64/15) M r^(-2n) / (1 - r^-2): Trefethen,
    /// "Approximation theory and approximation practice", theorem 19.3, which has n + 1 nodes and r^(-2n) / (r^2 - 1), after
    /// his "Is Gauss quadrature better than Clenshaw-Curtis?", 2008. The proof: f is the sum of a_k T_k with
    /// |a_k| <= 2 M r^-k. The rule is exact up to the degree 2n - 1, and for odd k by symmetry. For even k >= 2n >= 4 the
    /// integral of T_k is 2/(1 - k^2), at most 2/15 in size, and the sum of the rule for T_k is at most 2 in size, since its
    /// weights are positive and their sum is 2. The error is at most the sum of 2 M r^-k (2 + 2/15) over the even k from 2n.
    fn error(&mut self, piece: &Interval<E>) -> Option<Interval<E>> {
        self.left = self.left.checked_sub(1)?;
        let [middle, half] = Self::placed(piece);
        let around = <Interval<E> as Analytic>::unit();
        let (r, inverse) = (Interval::from_integer(ELLIPSE), Interval::from_ratio(1, ELLIPSE));
        // the rectangle of the half axes holds the ellipse
        let [real, imaginary] = [r.clone() + inverse.clone(), r - inverse.clone()]
            .map(|axis| around.clone() * half.clone() * axis / Interval::from_integer(2));
        let (real, imaginary) = self.continued((middle + real, Some(imaginary)))?;
        let imaginary = imaginary.unwrap_or_else(Interval::zero);
        let size = Interval::point(real.magnitude()) + Interval::point(imaginary.magnitude());
        let ratio = inverse.to_power(2 * NODES) / (Interval::one() - inverse.square());
        let error = around * half * Interval::from_ratio(64, 15) * size * ratio;
        error.is_finite().then_some(error)
    }

    /// The values over a rectangle of complex numbers around some real ones.
    ///
    /// Where there are some, every term inside is holomorphic on a neighbourhood of the rectangle, and at its real numbers it
    /// is what [`term_value`] takes it for. For sums, products, integer powers from 0 on and quotients (off 0) of such terms
    /// are that, and so is a function of [`continued`] of one, and e^(y ln x) for positive x, by which a real power is defined.
    /// An imaginary part is absent of real constants alone.
    fn continued(&self, rectangle: Complex<E>) -> Option<Complex<E>> {
        let constant = |(term, value): (&Term, &Interval<E>)| (*term, (value.clone(), None));
        let mut known: HashMap<Term, Complex<E>> = self.constants.iter().map(constant).collect();
        known.insert(self.by, rectangle);
        complex_value(self.terms, self.of, continued, &mut known)
    }
}

fn negative<E: Endpoint>(of: &Complex<E>) -> Complex<E> {
    (-of.0.clone(), of.1.clone().map(|part| -part))
}

/// The values of an elementary function over a rectangle, where it is holomorphic on a neighbourhood of that and at real
/// numbers the real function: the parts that are shown to be positive or negative are so on an open set.
fn continued<E: Endpoint>(function: Elementary, at: &Complex<E>) -> Option<Complex<E>> {
    let one = (Interval::one(), None);
    let turned = || (-at.1.clone().unwrap_or_else(Interval::zero), Some(at.0.clone())); // i at
    let ln = |of: &Complex<E>| of.0.is_positive().then(|| complex_ln(of))?; // principal, in the right half plane
    Some(match function {
        // entire
        Elementary::Sin | Elementary::Cos | Elementary::Exp => complex_elementary(function, at)?,
        Elementary::Ln => ln(at)?,
        // e^(ln(at) / index) in the right half plane; in the left one minus that of -at, as for real numbers
        Elementary::Root(index) if at.0.is_positive() => complex_root(at, index)?,
        Elementary::Root(index) if at.0.is_negative() && index % 2 == 1 => {
            negative(&complex_root(&negative(at), index)?)
        }
        Elementary::Root(_) => return None,
        Elementary::Arctan => continued_arctan(at)?,
        // ln(sqrt(1 - at^2) + i at) / i: of a real number the angle from -pi/2 to pi/2 that has it for its sine
        Elementary::Arcsin => {
            let rest = plus(&one, &negative(&times(at, at)));
            let root = rest.0.is_positive().then(|| complex_root(&rest, 2))??;
            let (real, imaginary) = ln(&plus(&root, &turned()))?;
            (imaginary?, Some(-real))
        }
        Elementary::Arccos => {
            let quarter = (<Interval<E> as Analytic>::pi() / Interval::from_integer(2), None);
            plus(&quarter, &negative(&continued(Elementary::Arcsin, at)?))
        }
    })
}

/// The arc tangent: (ln(1 + i at) - ln(1 - i at)) / (2i), whose derivative is 1 / (1 + at^2), and which is 0 at 0.
///
/// In the right half plane it is pi/2 - arctan(1/at), too, since both are holomorphic there and agree at positive numbers; in
/// the left one minus that of -at.
fn continued_arctan<E: Endpoint>(at: &Complex<E>) -> Option<Complex<E>> {
    let one = (Interval::one(), None);
    if at.0.is_negative() {
        return Some(negative(&continued_arctan(&negative(at))?));
    }
    if at.0.low() >= E::one() {
        let quarter = (<Interval<E> as Analytic>::pi() / Interval::from_integer(2), None);
        let inverse = complex_quotient(one, at.clone())?;
        // its real part is positive, and at most 1
        return Some(plus(&quarter, &negative(&arctan_by_logarithms(&inverse)?)));
    }
    arctan_by_logarithms(at)
}

/// The arc tangent by logarithms: see [`continued_arctan`].
fn arctan_by_logarithms<E: Endpoint>(at: &Complex<E>) -> Option<Complex<E>> {
    let one = (Interval::one(), None);
    let turned = (-at.1.clone().unwrap_or_else(Interval::zero), Some(at.0.clone())); // i at
    let [above, below] = [plus(&one, &turned), plus(&one, &negative(&turned))];
    (above.0.is_positive() && below.0.is_positive()).then_some(())?;
    let (real, imaginary) = plus(&complex_ln(&above)?, &negative(&complex_ln(&below)?));
    let two = Interval::from_integer(2);
    Some((imaginary? / two.clone(), Some(-real / two)))
}

/// The values of a polynomial with rational coefficients on an interval, as its value at an end plus a multiple of the
/// distance from there: exactly 0 at the end where it is 0. `None` of other terms, and where the end is no f64.
fn seen_from<E: Endpoint>(terms: &Terms, term: Term, by: Term, at: &Interval<E>, end: E) -> Option<Interval<E>> {
    let exact = Some(end.to_f64()).filter(|exact| E::from_f64(*exact) == end)?;
    let number = Polynomial::constant(&Rational(RBig::try_from(exact).ok()?));
    let polynomial = shifted(terms, term, by, &number)?;
    let distance = at.clone() - Interval::point(end);
    let (mut constant, mut slope) = (Interval::zero(), Interval::zero());
    for (monomial, coefficient) in polynomial.terms() {
        let coefficient = rational(&Rational(coefficient.clone()))?;
        match monomial.first() {
            None => constant = coefficient,
            Some((_, power)) => slope += coefficient * distance.to_power(i32::try_from(*power - 1).ok()?),
        }
    }
    Some(constant + distance * slope)
}

/// A term as a polynomial in `by` minus a number, which the generator `by` stands for.
fn shifted(terms: &Terms, term: Term, by: Term, number: &Polynomial) -> Option<Polynomial> {
    let mut known: HashMap<Term, Polynomial> = HashMap::new();
    let product = |a: Polynomial, b: &Polynomial| Some(a.times(b)).filter(|product| product.degree() <= DEGREE);
    for inner in terms.inside(term) {
        let of = |part: &Term| known.get(part);
        let (zero, one) = (Polynomial::default(), Polynomial::integer(1));
        let value = match terms.node(inner) {
            Node::Bound if inner == by => number.plus(&Polynomial::generator(by)),
            Node::Number(value) => Polynomial::constant(value),
            Node::Sum(parts) => parts.iter().try_fold(zero, |a, b| Some(a.plus(of(b)?)))?,
            Node::Product(parts) => parts.iter().try_fold(one, |a, b| product(a, of(b)?))?,
            Node::Power(base, exponent) => {
                let times = u32::try_from(*exponent).ok().filter(|times| *times <= DEGREE)?;
                (0..times).try_fold(one, |a, _| product(a, of(base)?))?
            }
            _ => return None,
        };
        known.insert(inner, value);
    }
    known.remove(&term)
}

/// The nodes and weights of the rule of Gauss and Legendre on [-1, 1].
///
/// The nodes are the roots of P_n, which has n, all different; n enclosures that are apart, each of at least one root, have
/// one each. One root is in m - P(m)/P'(X), where that is inside X, for m in X: the step of Newton for intervals (Moore,
/// "Interval analysis", 1966). The weight is 2 / ((1 - x^2) P'(x)^2) (Abramowitz and Stegun, 25.4.29).
fn rule<E: Endpoint>() -> Option<Vec<[Interval<E>; 2]>> {
    let (mut rule, mut before) = (Vec::new(), E::one());
    let radius = <Interval<E> as Analytic>::unit() * Interval::from_integer(2).to_power(RADIUS);
    for k in 1..=NODES / 2 {
        // not trusted: steps of Newton from an estimate
        let mut start = E::from_f64((PI * (f64::from(k) - 0.25) / (f64::from(NODES) + 0.5)).cos());
        for _ in 0..5 {
            let (value, slope) = legendre(&start);
            start -= value / slope;
        }
        let middle = Interval::point(start);
        let (value, _) = legendre(&middle);
        let around = middle.clone() + radius.clone();
        let (_, slope) = legendre(&around);
        let node = middle - value / slope.clone();
        // P_n is even: the other half of the roots are minus these
        (node.is_inside(&around) && node.is_positive() && node.high() < before).then_some(())?;
        before = node.low();
        let weight = Interval::from_integer(2) / ((Interval::one() - node.square()) * slope.square());
        rule.extend([[node.clone(), weight.clone()], [-node, weight]]);
    }
    Some(rule)
}

/// The value and the slope of the Legendre polynomial P_n, n = [`NODES`]: (k + 1) P_(k+1) = (2k + 1) x P_k - k P_(k-1) and
/// (x^2 - 1) P_n' = n (x P_n - P_(n-1)) (Abramowitz and Stegun, 22.7.10 and 22.8.5).
fn legendre<F: Field>(x: &F) -> (F, F) {
    let integer = F::from_integer;
    let (mut before, mut value) = (F::one(), x.clone());
    for k in 1..i64::from(NODES) {
        let next = (integer(2 * k + 1) * x.clone() * value.clone() - integer(k) * before) / integer(k + 1);
        before = std::mem::replace(&mut value, next);
    }
    let slope = integer(i64::from(NODES)) * (x.clone() * value.clone() - before) / (x.clone() * x.clone() - F::one());
    (value, slope)
}

#[cfg(test)]
pub(super) use tests::{Line, Number, Writer, whole};

#[cfg(test)]
mod tests {
    use super::*;
    use Elementary::{Arccos, Arcsin, Arctan, Cos, Exp, Ln, Root, Sin};
    use numbers::Sequence;

    pub(crate) type Number = Wide<40>;
    pub(crate) type Line = Interval<Number>;

    /// Terms in one symbol.
    pub(crate) struct Writer {
        pub(crate) terms: Terms,
        pub(crate) x: Term,
    }

    impl Writer {
        pub(crate) fn new() -> Self {
            let mut terms = Terms::default();
            let x = terms.add(Node::Bound);
            Self { terms, x }
        }

        pub(crate) fn ratio(&mut self, above: i64, below: i64) -> Term {
            self.terms.number(Rational::new(above, below).unwrap())
        }

        pub(crate) fn of(&mut self, function: Elementary, at: Term) -> Term {
            self.terms.elementary(function, at)
        }

        pub(crate) fn power(&mut self, base: Term, exponent: i32) -> Term {
            self.terms.add(Node::Power(base, exponent))
        }

        pub(crate) fn plus(&mut self, a: Term, value: i64) -> Term {
            let b = self.ratio(value, 1);
            self.terms.sum(vec![a, b])
        }

        pub(crate) fn times(&mut self, factor: i64, a: Term) -> Term {
            let b = self.ratio(factor, 1);
            self.terms.product(vec![b, a])
        }

        pub(crate) fn inverse(&mut self, a: Term) -> Term {
            let one = self.ratio(1, 1);
            self.terms.quotient(one, a)
        }

        pub(crate) fn over(&self, of: Term, low: &Line, high: &Line) -> Option<Line> {
            integral(&self.terms, of, self.x, &end(low), &end(high))
        }

        pub(crate) fn at(&self, of: Term, x: &Line) -> Option<Line> {
            term_value(&self.terms, of, &mut HashMap::from([(self.x, x.clone())]))
        }

        pub(crate) fn at_complex(&self, of: Term, x: Complex<Number>) -> Option<Complex<Number>> {
            Integrand::new(&self.terms, of, self.x)?.continued(x)
        }

        /// The derivative by x, by the rules of every textbook.
        fn derivative(&mut self, of: Term) -> Term {
            let node = self.terms.node(of).clone();
            match node {
                Node::Bound => self.ratio(1, 1),
                Node::Sum(parts) => {
                    let parts = parts.into_iter().map(|part| self.derivative(part)).collect();
                    self.terms.sum(parts)
                }
                Node::Product(parts) => {
                    let product = |n: usize, own: &mut Self| {
                        let mut parts = parts.clone();
                        parts[n] = own.derivative(parts[n]);
                        own.terms.product(parts)
                    };
                    let parts = (0..parts.len()).map(|n| product(n, self)).collect();
                    self.terms.sum(parts)
                }
                Node::Quotient(a, b) => {
                    let (da, db) = (self.derivative(a), self.derivative(b));
                    let parts = [vec![da, b], vec![a, db]].map(|parts| self.terms.product(parts));
                    let above = self.terms.difference(parts[0], parts[1]);
                    let below = self.power(b, 2);
                    self.terms.quotient(above, below)
                }
                Node::Elementary(function, a) => {
                    let outer = self.slope(function, a, of);
                    let inner = self.derivative(a);
                    self.terms.product(vec![outer, inner])
                }
                _ => self.ratio(0, 1),
            }
        }

        /// The derivative of a function at `a`, where its value is `of`.
        fn slope(&mut self, function: Elementary, a: Term, of: Term) -> Term {
            let square = self.power(a, 2);
            match function {
                Sin => self.of(Cos, a),
                Cos => {
                    let sine = self.of(Sin, a);
                    self.times(-1, sine)
                }
                Exp => of,
                Ln => self.inverse(a),
                Root(index) => {
                    let power = self.power(of, index as i32 - 1);
                    let below = self.times(i64::from(index), power);
                    self.inverse(below)
                }
                Arctan => {
                    let below = self.plus(square, 1);
                    self.inverse(below)
                }
                Arcsin | Arccos => {
                    let minus = self.times(-1, square);
                    let rest = self.plus(minus, 1);
                    let root = self.of(Root(2), rest);
                    let sign = if function == Arcsin { 1 } else { -1 };
                    let below = self.times(sign, root);
                    self.inverse(below)
                }
            }
        }
    }

    /// An end of an interval; that of one number is this number.
    pub(crate) fn end<E: Endpoint>(value: &Interval<E>) -> End<E> {
        let number = value.low().to_f64();
        let is_exact = value.is_finite() && value.low() == value.high() && E::from_f64(number) == value.low();
        let exact = is_exact.then(|| Exact::rational(RBig::try_from(number).unwrap()));
        let value = value.clone();
        End { value, exact }
    }

    fn number(above: i64, below: i64) -> Line {
        rational(&Rational::new(above, below).unwrap()).unwrap()
    }

    pub(crate) fn whole(value: i64) -> Line {
        Line::from_integer(value)
    }

    pub(crate) fn pi() -> Line {
        <Line as Analytic>::pi()
    }

    fn closed(function: Elementary, of: i64) -> Line {
        let mut w = Writer::new();
        let of = w.ratio(of, 1);
        let term = w.of(function, of);
        w.at(term, &whole(0)).unwrap()
    }

    /// An integrand, made of x.
    type Written = fn(&mut Writer, Term) -> Term;

    fn of_square(w: &mut Writer, function: Elementary, factor: i64, constant: i64) -> Term {
        let square = w.power(w.x, 2);
        let scaled = w.times(factor, square);
        let inside = w.plus(scaled, constant);
        w.of(function, inside)
    }

    fn half_circle(w: &mut Writer, _: Term) -> Term {
        of_square(w, Root(2), -1, 1)
    }

    fn over_two_plus_cosine(w: &mut Writer, above: Term) -> Term {
        let cosine = w.of(Cos, w.x);
        let below = w.plus(cosine, 2);
        w.terms.quotient(above, below)
    }

    fn tangent(w: &mut Writer, x: Term) -> Term {
        let (sine, cosine) = (w.of(Sin, x), w.of(Cos, x));
        w.terms.quotient(sine, cosine)
    }

    /// Integrands with the ends, the integral and a bound of the width.
    fn known() -> Vec<(Written, [Line; 2], Line, f64)> {
        let two = || whole(2);
        let (half, log) = (number(1, 2), |of: i64| closed(Ln, of));
        let bell: Written = |w, x| {
            let bell = of_square(w, Exp, 1, 0);
            w.terms.product(vec![x, bell])
        };
        let square_of_log: Written = |w, x| {
            let sum = w.plus(x, 3);
            let log = w.of(Ln, sum);
            w.power(log, 2)
        };
        let squared_log = whole(4) * log(4).square() - whole(8) * log(4) - whole(3) * log(3).square();
        let sine_over: Written = |w, x| {
            let sine = w.of(Sin, x);
            over_two_plus_cosine(w, sine)
        };
        let one_over: Written = |w, _| {
            let one = w.ratio(1, 1);
            over_two_plus_cosine(w, one)
        };
        let parabola: Written = |w, x| {
            let square = w.power(x, 2);
            w.terms.difference(x, square)
        };
        let real_power: Written = |w, x| {
            let pi = w.terms.add(Node::Pi);
            w.terms.add(Node::RealPower(x, pi))
        };
        let lorentz: Written = |w, x| {
            let square = w.power(x, 2);
            let below = w.plus(square, 1);
            w.inverse(below)
        };
        vec![
            (bell, [whole(0), whole(1)], (closed(Exp, 1) - whole(1)) / two(), 1e-19),
            (
                one_over,
                [whole(0), two() * pi()],
                two() * pi() / whole(3).sqrt(),
                1e-19,
            ),
            (sine_over, [whole(0), pi()], log(3), 1e-19),
            (parabola, [whole(0), whole(1)], number(1, 6), 1e-20),
            (
                |w, x| w.power(x, 19),
                [two(), whole(-1)],
                -number((1 << 20) - 1, 20),
                1e-14,
            ),
            (
                square_of_log,
                [whole(0), whole(1)],
                squared_log + whole(6) * log(3) + two(),
                1e-19,
            ),
            (half_circle, [whole(0), whole(1)], pi() / whole(4), 1e-19),
            (half_circle, [whole(-1), whole(1)], pi() / two(), 1e-18),
            (|w, x| w.of(Root(2), x), [whole(0), whole(4)], number(16, 3), 1e-18),
            (
                |w, _| of_square(w, Root(2), 1, 0),
                [whole(-1), two()],
                number(5, 2),
                1e-18,
            ),
            (|w, x| w.of(Root(3), x), [whole(-8), whole(-1)], -number(45, 4), 1e-19),
            (
                |w, x| w.of(Arctan, x),
                [whole(0), whole(1)],
                pi() / whole(4) - log(2) / two(),
                1e-19,
            ),
            (|w, x| w.of(Arcsin, x), [-half.clone(), half.clone()], whole(0), 1e-19),
            (|w, x| w.of(Arccos, x), [-half.clone(), half], pi() / two(), 1e-19),
            (
                |w, x| w.of(Arcsin, x),
                [whole(0), whole(1)],
                pi() / two() - whole(1),
                1e-19,
            ),
            (lorentz, [whole(-1), whole(1)], pi() / two(), 1e-19),
            (|w, _| w.ratio(1, 3), [whole(0), whole(3)], whole(1), 1e-20),
            (real_power, [whole(1), whole(1)], whole(0), 1e-40),
            (|w, x| w.of(Root(2), x), [whole(0), whole(0)], whole(0), 1e-40),
        ]
    }

    #[test]
    fn known_integrals_are_enclosed_as_narrowly_as_promised() {
        for (number, (written, [low, high], value, width)) in known().into_iter().enumerate() {
            let mut w = Writer::new();
            let x = w.x;
            let of = written(&mut w, x);
            let started = std::time::Instant::now();
            let found = w.over(of, &low, &high).unwrap_or_else(|| panic!("{number}: none"));
            println!(
                "{number}: width {:.1e} in {:?}",
                found.width().to_f64(),
                started.elapsed()
            );
            assert!(
                found.intersection(&value).is_some(),
                "{number}: {found} without {value}"
            );
            assert!(found.width().to_f64() < width, "{number}: {found}");
        }
    }

    #[test]
    fn what_is_not_continuous_or_does_not_converge_has_no_integral() {
        let quarter = || pi() / whole(2);
        let third: Written = |w, x| {
            let third = w.ratio(1, 3);
            let below = w.terms.difference(x, third);
            w.inverse(below)
        };
        let inverse_square: Written = |w, x| {
            let square = w.power(x, 2);
            w.inverse(square)
        };
        let cosine_over: Written = |w, x| {
            let cosine = w.of(Cos, x);
            w.terms.quotient(cosine, x)
        };
        let cases: Vec<(Written, [Line; 2])> = vec![
            (|w, x| w.inverse(x), [whole(-1), whole(1)]),
            (|w, x| w.inverse(x), [whole(1), whole(0)]),
            (third, [whole(0), whole(1)]),
            (|w, x| w.of(Root(2), x), [whole(-1), whole(1)]),
            (inverse_square, [whole(0), whole(1)]),
            (|w, x| w.of(Ln, x), [whole(-1), whole(1)]),
            (|w, x| w.of(Ln, x), [whole(-2), whole(-1)]),
            (|w, x| w.of(Ln, x), [whole(-1), whole(0)]),
            (tangent, [whole(1), whole(2)]),
            (tangent, [whole(0), quarter()]),
            (|w, x| w.of(Arcsin, x), [whole(0), whole(2)]),
            (half_circle, [whole(0), number(1_000_001, 1_000_000)]),
            (half_circle, [whole(0), Line::point(Number::from_f64(1.25))]),
            (
                half_circle,
                [whole(0), Line::new(Number::one(), Number::from_f64(1.0 + 1e-15))],
            ),
            (cosine_over, [whole(0), whole(1)]),
            (cosine_over, [whole(-1), whole(0)]),
            (|w, x| w.of(Exp, x), [whole(0), Line::whole()]),
            (|w, x| w.inverse(x), [whole(0), whole(0)]),
        ];
        for (number, (written, [low, high])) in cases.into_iter().enumerate() {
            let mut w = Writer::new();
            let x = w.x;
            let of = written(&mut w, x);
            let started = std::time::Instant::now();
            assert_eq!(w.over(of, &low, &high), None, "{number}");
            println!("{number}: none in {:?}", started.elapsed());
        }
    }

    #[test]
    fn what_is_no_function_of_one_real_symbol_has_no_integral() {
        let mut w = Writer::new();
        let other = w.terms.new_symbol("y");
        let other = w.terms.symbol(other);
        let unit = w.terms.add(Node::Imaginary);
        let square = w.power(w.x, 2);
        let minus = w.ratio(-1, 1);
        let no_root = w.of(Root(2), minus);
        for of in [other, unit, no_root].map(|part| w.terms.sum(vec![w.x, part])) {
            assert_eq!(w.over(of, &whole(0), &whole(1)), None);
        }
        for (of, by) in [(square, square), (square, minus), (minus, minus)] {
            assert_eq!(integral(&w.terms, of, by, &end(&whole(0)), &end(&whole(1))), None);
        }
    }

    #[test]
    fn ends_that_are_not_known_exactly_widen_the_integral_by_as_much() {
        let mut w = Writer::new();
        let of = w.of(Exp, w.x);
        let between = |low: f64, high: f64| Line::new(Number::from_f64(low), Number::from_f64(high));
        let found = w.over(of, &between(-0.125, 0.125), &between(0.5, 1.0)).unwrap();
        let value = |x: f64| w.at(of, &Line::point(Number::from_f64(x))).unwrap();
        for (low, high) in [(-0.125, 0.5), (0.125, 0.5), (-0.125, 1.0), (0.125, 1.0), (0.0, 0.75)] {
            assert!((value(high) - value(low)).is_subset(&found), "{found}");
        }
        assert!(found.width().to_f64() < 2.0);
        // of ends that share numbers either may be the larger one
        let found = w.over(of, &between(0.0, 1.0), &between(0.5, 1.5)).unwrap();
        for (low, high) in [(1.0, 0.5), (0.0, 1.5), (0.75, 0.75)] {
            assert!((value(high) - value(low)).is_subset(&found), "{found}");
        }
    }

    #[test]
    fn other_digits_give_the_same_accuracy() {
        let mut w = Writer::new();
        let of = w.of(Exp, w.x);
        let ends = [0, 1].map(Interval::<Wide<150>>::from_integer);
        let found = integral(&w.terms, of, w.x, &end(&ends[0]), &end(&ends[1])).unwrap();
        let value = term_value(&w.terms, of, &mut HashMap::from([(w.x, ends[1].clone())])).unwrap() - ends[1].clone();
        assert!(value.is_subset(&found) && found.width().to_f64() < 1e-19);
    }

    /// On one piece whose bound is not small: what the rule misses is more than a tenth of the bound at times.
    #[test]
    fn the_bound_of_the_error_holds_and_is_needed() {
        let piece = Line::new(-Number::one(), Number::one());
        let mut closest = 0.0_f64;
        for rate in 8..30 {
            let mut w = Writer::new();
            let inside = w.times(rate, w.x);
            let of = w.of(Cos, inside);
            let mut integrand = Integrand::<Number>::new(&w.terms, of, w.x).unwrap();
            let (sum, error) = (integrand.gauss(&piece).unwrap(), integrand.error(&piece).unwrap());
            let value = whole(2) * closed(Sin, rate) / whole(rate);
            let missed = (value - sum).size();
            assert!(missed.high() <= error.high(), "{rate}: {missed} above {error}");
            closest = closest.max(missed.low().to_f64() / error.high().to_f64());
        }
        assert!(closest > 0.01, "{closest}");
    }

    /// The integral of what is halved until it is done holds the value by its bounds, and not by what is rounded.
    #[test]
    fn oscillations_are_enclosed_however_quick() {
        for rate in (1..60).step_by(4) {
            let mut w = Writer::new();
            let inside = w.times(rate, w.x);
            let of = w.of(Sin, inside);
            let found = w.over(of, &whole(0), &whole(1)).unwrap();
            let value = (whole(1) - closed(Cos, rate)) / whole(rate);
            assert!(
                value.is_subset(&found) && found.width().to_f64() < 1e-19,
                "{rate}: {found}"
            );
        }
    }

    /// Each function is undone, at complex numbers, by entire functions alone.
    #[test]
    fn continued_functions_are_those_over_complex_numbers() {
        let undone: [(Written, bool); 7] = [
            (
                |w, x| {
                    let angle = w.of(Arctan, x);
                    tangent(w, angle)
                },
                true,
            ),
            (
                |w, x| {
                    let angle = w.of(Arcsin, x);
                    w.of(Sin, angle)
                },
                true,
            ),
            (
                |w, x| {
                    let angle = w.of(Arccos, x);
                    w.of(Cos, angle)
                },
                true,
            ),
            (
                |w, x| {
                    let log = w.of(Ln, x);
                    w.of(Exp, log)
                },
                false,
            ),
            (
                |w, x| {
                    let root = w.of(Root(2), x);
                    w.power(root, 2)
                },
                false,
            ),
            (
                |w, x| {
                    let root = w.of(Root(3), x);
                    w.power(root, 3)
                },
                true,
            ),
            (
                |w, x| {
                    let root = w.of(Root(5), x);
                    w.power(root, 5)
                },
                true,
            ),
        ];
        let mut sequence = Sequence::new(7);
        for (written, negative_too) in undone {
            let mut w = Writer::new();
            let x = w.x;
            let of = written(&mut w, x);
            let mut found = 0;
            for _ in 0..40 {
                let low = if negative_too { -0.9 } else { 0.0 };
                let (a, b) = (sequence.between(low, 0.9), sequence.between(-0.9, 0.9));
                let [a, b] = [a, b].map(|part| Line::point(Number::from_f64(part)));
                let Some((real, imaginary)) = w.at_complex(of, (a.clone(), Some(b.clone()))) else {
                    continue;
                };
                found += 1;
                assert!(
                    a.is_subset(&real) && b.is_subset(&imaginary.unwrap()),
                    "{a} {b}: {real}"
                );
                assert!(real.width().to_f64() < 1e-30);
            }
            assert!(found > 15, "{found}");
        }
    }

    #[test]
    fn a_polynomial_seen_from_an_end_has_its_values_and_is_exact_there() {
        let mut w = Writer::new();
        let cube = w.power(w.x, 3);
        let parts = [w.times(3, cube), w.times(-2, w.x)];
        let sum = w.terms.sum(parts.to_vec());
        let at = Line::new(Number::from_f64(-0.5), Number::from_f64(1.0));
        for (constant, value) in [(5, 6.0), (-1, 0.0)] {
            let of = w.plus(sum, constant);
            let seen = [at.low(), at.high()].map(|end| seen_from(&w.terms, of, w.x, &at, end).unwrap());
            for x in [-0.5, 0.0, 0.25, 1.0].map(|x| Line::point(Number::from_f64(x))) {
                let value = w.at(of, &x).unwrap();
                assert!(seen.iter().all(|seen| seen.intersection(&value).is_some()), "{x}");
            }
            let end = Line::point(at.high());
            let there = seen_from(&w.terms, of, w.x, &end, end.high()).unwrap();
            assert!(there.contains(&Number::from_f64(value)) && (value > 0.0 || there.is_zero()));
        }
        let of = w.of(Sin, w.x);
        assert!(seen_from(&w.terms, of, w.x, &at, at.low()).is_none());
        assert!(seen_from(&w.terms, cube, w.x, &at, number(1, 3).low()).is_none());
    }

    /// A random term of some depth.
    fn random(w: &mut Writer, sequence: &mut Sequence, depth: u32) -> Term {
        let mut up_to = |n: u64| (sequence.draw() % n) as i64;
        if depth == 0 {
            let (above, below) = (up_to(9) - 4, up_to(4) + 1);
            return if up_to(3) > 0 { w.x } else { w.ratio(above, below) };
        }
        let (choice, function, shift) = (up_to(8), up_to(9), up_to(4));
        let a = random(w, sequence, depth - 1);
        if choice > 3 {
            let functions = [Sin, Cos, Exp, Ln, Root(2), Root(3), Arcsin, Arccos, Arctan];
            let shifted = w.plus(a, shift);
            let at = if (3..6).contains(&function) { shifted } else { a };
            return w.of(functions[function as usize], at);
        }
        let b = random(w, sequence, depth - 1);
        match choice {
            0 => w.terms.quotient(a, b),
            1 => w.terms.sum(vec![a, b]),
            _ => w.terms.product(vec![a, b]),
        }
    }

    /// The values and integrals of the derivatives of random terms, which are differences of their values; and the values over
    /// rectangles hold those over the real numbers in them.
    #[test]
    fn integrals_of_random_derivatives_are_differences() {
        let mut sequence = Sequence::new(2024);
        let mut found = 0;
        for case in 0..90 {
            let mut w = Writer::new();
            let term = random(&mut w, &mut sequence, 1 + case % 3);
            let slope = w.derivative(term);
            let mut end = || {
                let above = (sequence.draw() % 41) as i64 - 20;
                number(above, (sequence.draw() % 9) as i64 + 5)
            };
            let ends = [end(), end()];
            let width = number(1, 9) * <Line as Analytic>::unit();
            for (term, at) in [(term, &ends[0]), (slope, &ends[1])] {
                let wide = w.at_complex(term, (at.clone() + width.clone(), Some(width.clone())));
                if let (Some((real, imaginary)), Some(value)) = (wide, w.at(term, at)) {
                    assert!(value.is_subset(&real) && imaginary.is_none_or(|part| part.contains_zero()));
                }
            }
            let values = ends.each_ref().map(|at| w.at(term, at));
            let [Some(from), Some(to)] = values else { continue };
            let Some(integral) = w.over(slope, &ends[0], &ends[1]) else {
                continue;
            };
            found += 1;
            let difference = to - from;
            assert!(
                difference.intersection(&integral).is_some(),
                "{case}: {integral}, {difference}"
            );
        }
        println!("{found} integrals");
        assert!(found > 40, "{found}");
    }

    /// Polynomials with rational coefficients times e^(kx) or a sine, whose antiderivatives are known.
    #[test]
    fn random_polynomials_have_their_exact_integrals() {
        let mut sequence = Sequence::new(5);
        for _ in 0..40 {
            let mut draw = |n: u64| (sequence.draw() % n) as i64;
            let mut w = Writer::new();
            let [from, to] = [(); 2].map(|()| Rational::new(draw(41) - 20, draw(9) + 1).unwrap());
            let (mut parts, mut value) = (Vec::new(), Rational::zero());
            for exponent in 0..=draw(8) as i32 {
                let coefficient = Rational::new(draw(201) - 100, draw(30) + 1).unwrap();
                let ends = to.to_power(exponent + 1) - from.to_power(exponent + 1);
                value += coefficient.clone() * ends / Rational::from_integer(i64::from(exponent) + 1);
                let (factor, power) = (w.terms.number(coefficient), w.power(w.x, exponent));
                parts.push(w.terms.product(vec![factor, power]));
            }
            let of = w.terms.sum(parts);
            let [low, high, value] = [from, to, value].map(|value| rational::<Number>(&value).unwrap());
            let found = w.over(of, &low, &high).unwrap();
            assert!(value.is_subset(&found), "{found} without {value}");
        }
    }
}
