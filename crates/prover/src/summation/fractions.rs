//! Rational functions of an index with rational coefficients and rational poles.

use super::super::integration::tree::{integer, number, power, product, quotient, sum, symbol};
use super::at;
use numbers::{Field, Rational};
use texmath::{Name, Tree, number_of};

/// The highest degree, and how far from 0 poles are looked for and by which denominators.
const HIGHEST: i64 = 8;
const FARTHEST: i64 = 60;
const DENOMINATORS: i64 = 4;

/// Coefficients, the lowest first, the last not 0.
type Polynomial = Vec<Rational>;

/// `factor/(k + shift)^order`.
#[derive(Clone, Debug)]
pub(super) struct Pole {
    pub factor: Rational,
    pub shift: Rational,
    pub order: i64,
}

/// A polynomial and poles.
pub(super) struct Fraction {
    pub whole: Polynomial,
    pub poles: Vec<Pole>,
}

fn zero() -> Rational {
    Rational::from_integer(0)
}

fn trimmed(mut polynomial: Polynomial) -> Polynomial {
    while polynomial.last().is_some_and(|last| *last == zero()) {
        polynomial.pop();
    }
    polynomial
}

fn times(left: &Polynomial, right: &Polynomial) -> Polynomial {
    let mut out = vec![zero(); (left.len() + right.len()).saturating_sub(1)];
    for (i, a) in left.iter().enumerate() {
        for (j, b) in right.iter().enumerate() {
            if let Some(entry) = out.get_mut(i + j) {
                *entry += a.clone() * b.clone();
            }
        }
    }
    trimmed(out)
}

fn value(polynomial: &Polynomial, at: &Rational) -> Rational {
    polynomial
        .iter()
        .rev()
        .fold(zero(), |total, own| total * at.clone() + own.clone())
}

/// The quotient and the rest.
fn divided(above: &Polynomial, below: &Polynomial) -> Option<(Polynomial, Polynomial)> {
    let lead = below.last()?.clone();
    let (mut rest, mut out) = (above.clone(), vec![zero(); above.len()]);
    while rest.len() >= below.len() {
        let place = rest.len() - below.len();
        let factor = rest.last()?.clone() / lead.clone();
        *out.get_mut(place)? = factor.clone();
        for (j, own) in below.iter().enumerate() {
            *rest.get_mut(place + j)? -= factor.clone() * own.clone();
        }
        rest.pop();
        rest = trimmed(rest);
    }
    Some((trimmed(out), rest))
}

/// The numerator and the denominator of a sum of quotients.
pub(super) fn quotient_of(tree: &Tree) -> (Tree, Tree) {
    match tree {
        Tree::Negate(inner) => {
            let (above, below) = quotient_of(inner);
            (product(vec![integer(-1), above]), below)
        }
        Tree::Quotient(above, below, _) => {
            let ((up, under), (over, down)) = (quotient_of(above), quotient_of(below));
            (product(vec![up, down]), product(vec![under, over]))
        }
        Tree::Product(factors) => {
            let (above, below) = factors.iter().map(quotient_of).unzip();
            (product(above), product(below))
        }
        Tree::Sum(terms) => {
            let terms = terms.iter().map(quotient_of);
            terms.fold((integer(0), integer(1)), |(above, below), (up, down)| {
                let over = sum(vec![
                    product(vec![above, down.clone()]),
                    product(vec![up, below.clone()]),
                ]);
                (over, product(vec![below, down]))
            })
        }
        tree => (tree.clone(), integer(1)),
    }
}

/// The polynomial that trees multiply to, by its values.
fn polynomial(factors: &[Tree], index: &Name) -> Option<Polynomial> {
    factors
        .iter()
        .try_fold(vec![Rational::from_integer(1)], |product, factor| {
            Some(times(&product, &of_tree(factor, index)?))
        })
}

fn of_tree(tree: &Tree, index: &Name) -> Option<Polynomial> {
    let there = |k: i64| number_of(&at(tree, index, k));
    let mut differences: Vec<Rational> = (0..=HIGHEST + 1).map(there).collect::<Option<_>>()?;
    let (mut out, mut basis) = (Vec::new(), vec![Rational::from_integer(1)]);
    for order in 0..=HIGHEST + 1 {
        let lead = differences.first()?.clone();
        if order == HIGHEST + 1 && lead != zero() {
            return None;
        }
        let scaled = times(&basis, &vec![lead]);
        out.resize(usize::max(scaled.len(), Vec::len(&out)), zero());
        for (entry, own) in out.iter_mut().zip(scaled) {
            *entry += own;
        }
        let next = vec![Rational::new(-order, order + 1)?, Rational::new(1, order + 1)?];
        basis = times(&basis, &next);
        differences = differences
            .windows(2)
            .map(|pair| Some(pair.get(1)?.clone() - pair.first()?.clone()))
            .collect::<Option<_>>()?;
    }
    Some(trimmed(out))
}

/// The polynomial as a tree.
pub(super) fn tree(polynomial: &Polynomial, index: &Name) -> Tree {
    let terms = (0..)
        .zip(polynomial)
        .map(|(degree, own)| product(vec![number(own), power(symbol(index), degree)]));
    sum(terms.collect())
}

/// The roots of a polynomial with their multiplicities, if these are all.
fn roots(of: &Polynomial) -> Option<Vec<(Rational, i64)>> {
    let (mut rest, mut found): (Polynomial, Vec<(Rational, i64)>) = (of.clone(), Vec::new());
    for below in 1..=DENOMINATORS {
        for above in -FARTHEST..=FARTHEST {
            let root = Rational::new(above, below)?;
            let mut order = 0;
            while rest.len() > 1 && value(&rest, &root) == zero() {
                rest = divided(&rest, &vec![zero() - root.clone(), Rational::from_integer(1)])?.0;
                order += 1;
            }
            if order > 0 {
                found.push((root, order));
            }
        }
    }
    (rest.len() == 1).then_some(found)
}

/// The coefficients of a polynomial in the distance from a point.
fn about(of: &Polynomial, point: &Rational) -> Polynomial {
    let by = vec![point.clone(), Rational::from_integer(1)];
    let mut total = Vec::new();
    for own in of.iter().rev() {
        total = times(&total, &by);
        match total.first_mut() {
            Some(first) => *first += own.clone(),
            None => total = trimmed(vec![own.clone()]),
        }
    }
    total
}

/// The partial fractions of a quotient of products.
pub(super) fn partial(above: &[Tree], below: &[Tree], index: &Name) -> Option<Fraction> {
    let (above, below) = (polynomial(above, index)?, polynomial(below, index)?);
    let (whole, above) = divided(&above, &below)?;
    let mut poles = Vec::new();
    for (root, order) in roots(&below)? {
        let places = usize::try_from(order).ok()?;
        // what is left of the divisor, and the quotient of the two, in powers of the distance from the root
        let other: Vec<Rational> = about(&below, &root).split_off(places);
        let numerator = about(&above, &root);
        let mut series: Vec<Rational> = Vec::new();
        for k in 0..places {
            let mut own = numerator.get(k).cloned().unwrap_or_else(zero);
            for (j, known) in series.iter().enumerate() {
                own -= known.clone() * other.get(k - j).cloned().unwrap_or_else(zero);
            }
            series.push(own / other.first()?.clone());
        }
        for (power, factor) in (1..=order).rev().zip(series) {
            if factor != zero() {
                poles.push(Pole {
                    factor,
                    shift: zero() - root.clone(),
                    order: power,
                });
            }
        }
    }
    Some(Fraction { whole, poles })
}

/// The function whose differences are poles that cancel far out, if they do.
pub(super) fn telescoped(poles: &[Pole], index: &Name) -> Option<Tree> {
    let (mut open, mut terms): (Vec<Pole>, Vec<Tree>) = (poles.to_vec(), Vec::new());
    while let Some(first) = open.first().cloned() {
        let is_like = |other: &Pole| {
            let apart = other.shift.clone() - first.shift.clone();
            other.order == first.order && apart.to_integer().is_some()
        };
        let (own, rest): (Vec<Pole>, Vec<Pole>) = open.into_iter().partition(is_like);
        open = rest;
        let total = own.iter().fold(zero(), |total, pole| total + pole.factor.clone());
        let least = own.iter().map(|pole| pole.shift.clone()).min()?;
        if total != zero() {
            return None;
        }
        for pole in own {
            let steps = (pole.shift.clone() - least.clone()).to_integer()?;
            for step in 0..steps {
                let shift = least.clone() + Rational::from_integer(step);
                let below = sum(vec![symbol(index), number(&shift)]);
                let below = power(below, u32::try_from(pole.order).ok()?);
                terms.push(product(vec![number(&pole.factor), quotient(integer(1), below)]));
            }
        }
    }
    Some(sum(terms))
}

/// Takes a multiple of the harmonic series out of poles, so that what is left of those at integers cancels far out: the
/// factor, and the least shift. None where they cancel.
pub(super) fn balanced(poles: &mut Vec<Pole>) -> Option<(Rational, i64)> {
    let simple = poles.iter().filter(|pole| pole.order == 1);
    let shifts = simple.filter_map(|pole| Some((pole.shift.to_integer()?, pole.factor.clone())));
    let shifts: Vec<(i64, Rational)> = shifts.collect();
    let least = shifts.iter().map(|(shift, _)| *shift).min()?;
    let total = shifts.into_iter().fold(zero(), |total, (_, factor)| total + factor);
    if total == zero() {
        return None;
    }
    poles.push(Pole {
        factor: zero() - total.clone(),
        shift: Rational::from_integer(least),
        order: 1,
    });
    Some((total, least))
}

/// A quotient over the factorial of `k + offset` as a polynomial over a later factorial: its numerator and the offset.
pub(super) fn over_factorial(above: &[Tree], below: &[Tree], index: &Name, offset: i64) -> Option<(Tree, i64)> {
    let below = polynomial(below, index)?;
    let shifts = roots(&below)?.into_iter().map(|(root, _)| (zero() - root).to_integer());
    let last = shifts.collect::<Option<Vec<i64>>>()?.into_iter().max()?;
    let mut numerator = polynomial(above, index)?;
    for shift in offset + 1..=last {
        numerator = times(
            &numerator,
            &vec![Rational::from_integer(shift), Rational::from_integer(1)],
        );
    }
    let (numerator, rest) = divided(&numerator, &below)?;
    rest.is_empty().then(|| (tree(&numerator, index), last.max(offset)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn partial_fractions_have_the_values_of_the_quotient() {
        let k = Name::plain("k");
        let linear = |shift: i64| sum(vec![symbol(&k), integer(shift)]);
        let below = [linear(1), linear(1), linear(3)];
        let found = partial(&[linear(7)], &below, &k).unwrap();
        let there = Rational::from_integer(5);
        let total = found.poles.iter().fold(zero(), |total, pole| {
            let distance = there.clone() + pole.shift.clone();
            let power = (0..pole.order).fold(Rational::from_integer(1), |power, _| power * distance.clone());
            total + pole.factor.clone() / power
        });
        assert!(found.whole.is_empty());
        assert_eq!(total, Rational::new(12, 36 * 8).unwrap());
    }
}
