//! Signs of polynomials in letters that lie between numbers: by halving the box of these letters until an enclosure over
//! each piece is positive (Moore, "Interval analysis", 1966).

use super::enclosure::{enclose, enclose_with};
use super::polynomial::Polynomial;
use super::term::{Node, Term, Terms};
use numbers::{Field, Interval};
use std::collections::HashMap;

type Line = Interval<f64>;

/// The most pieces that a polynomial is enclosed over.
const MOST_PIECES: usize = 1000;

/// The letter of a bound and the number that it gives: a multiple of the letter plus a number without letters, that is not
/// negative. True for a lower bound.
fn bound(terms: &Terms, polynomial: &Polynomial) -> Option<(Term, Line, bool)> {
    let is_open = |term: &Term| !terms.is_closed(*term);
    let mut letter = None;
    let mut rest = Polynomial::default();
    for (monomial, coefficient) in polynomial.terms() {
        let own = Polynomial::from_terms(vec![(monomial.clone(), coefficient.clone())]);
        match monomial.as_slice() {
            [(term, 1)] if is_open(term) && letter.is_none() => letter = Some((*term, own)),
            _ if !monomial.iter().any(|(term, _)| is_open(term)) => rest = rest.plus(&own),
            _ => return None,
        }
    }
    let (term, multiple) = letter?;
    matches!(terms.node(term), Node::Symbol(_)).then_some(())?;
    let of_one = HashMap::from([(term, Line::from_integer(1))]);
    let factor = enclose_with(terms, &multiple, of_one)?;
    let is_lower = factor.is_positive();
    (is_lower || factor.is_negative()).then_some(())?;
    Some((term, -enclose(terms, &rest)? / factor, is_lower))
}

/// Returns true if a polynomial over real numbers is positive wherever each letter of it lies between two bounds, each a
/// polynomial that is not negative, and has a value there.
pub(super) fn is_positive(terms: &Terms, target: &Polynomial, within: &[[Polynomial; 2]]) -> bool {
    let mut sides: Vec<(Term, Line)> = Vec::new();
    for pair in within {
        let [Some((letter, low, true)), Some((other, high, false))] = [0, 1].map(|n: usize| bound(terms, &pair[n]))
        else {
            return false;
        };
        let is_new = sides.iter().all(|(known, _)| *known != letter);
        let is_side = low.is_finite() && high.is_finite() && low.low() <= high.high();
        if letter != other || !is_new || !is_side {
            return false;
        }
        sides.push((letter, Line::new(low.low(), high.high())));
    }
    is_positive_over(terms, target, sides)
}

fn is_positive_over(terms: &Terms, target: &Polynomial, whole: Vec<(Term, Line)>) -> bool {
    let (mut open, mut left) = (vec![whole], MOST_PIECES);
    while let Some(piece) = open.pop() {
        let known: HashMap<Term, Line> = piece.iter().cloned().collect();
        if enclose_with(terms, target, known).is_some_and(|value| value.is_positive()) {
            continue;
        }
        let widest = piece.iter().enumerate();
        let widest = widest.max_by(|(_, (_, one)), (_, (_, other))| one.width().total_cmp(&other.width()));
        let Some((place, (letter, side))) = widest.map(|(place, (letter, side))| (place, (*letter, *side))) else {
            return false;
        };
        let (lower, upper) = side.halves();
        if left == 0 || lower.width() >= side.width() {
            return false;
        }
        left -= 1;
        for half in [lower, upper] {
            let mut part = piece.clone();
            if let Some(own) = part.get_mut(place) {
                *own = (letter, half);
            }
            open.push(part);
        }
    }
    true
}
