//! Sums whose terms depend on their length, by creative telescoping (Zeilberger, The method of creative telescoping,
//! Journal of Symbolic Computation 11, 1991): with polynomials a, b and a multiple G of the terms F of which
//! `a F(n+1, k) + b F(n, k) = G(n, k+1) - G(n, k)` holds, `a S(n+1) + b S(n)` is what stands at the ends.
//!
//! The polynomials are found modulo a prime. Nothing rests on that: the equation is a claim of its own.

use super::build::{difference, integer, power, product, quotient, sum, symbol};
use super::derivative::mentions;
use super::factorial::{self, FACTORIAL};
use std::collections::BTreeMap;
use texmath::{Equation, Name, Operation, Series, Tree, mapped, rewrite};

/// The highest degree of the factor of the terms, of the polynomials in the length, and the most parameters.
const HIGHEST: i32 = 4;
const HIGHEST_OF_LENGTH: i32 = 4;
const MOST_PARAMETERS: usize = 3;

/// A prime, below 2^61, and how far the integers are from which numbers are drawn.
const PRIME: u128 = (1 << 61) - 1;
const SPREAD: u64 = 40;

/// The largest number whose factorial is multiplied out.
const LARGEST_FACTORIAL: i64 = 2000;

/// The largest numerator and denominator of a coefficient.
const LARGEST: u128 = 10_000;

/// What is known of a sum at the next length.
pub(super) struct Telescoped {
    /// The terms' own equation, at each index from the first one to the last one.
    pub of_terms: Equation,
    /// What the sum, its value at the next length and the ends come to.
    pub of_sums: Equation,
}

/// A sum from a number to the length and a number, over terms that depend on the length.
pub(super) struct Sum<'a> {
    pub of: &'a Tree,
    pub index: &'a Name,
    pub from: i64,
    pub to: &'a Tree,
    pub letter: &'a Name,
}

impl<'a> Sum<'a> {
    pub(super) fn read(operation: &'a Operation, letter: &'a Name) -> Option<Self> {
        if operation.letter() == Some(letter) {
            return None;
        }
        match operation {
            Operation::Series {
                kind: Series::Sum,
                of,
                index,
                from,
                to,
            } if mentions(of, letter) => Some(Self {
                of,
                index,
                from: super::integers::whole(from)?,
                to,
                letter,
            }),
            _ => None,
        }
    }

    /// The term at a length and an index.
    fn term(&self, letter: &Tree, index: &Tree) -> Tree {
        let put_in = |name: &Name| match name {
            name if name == self.letter => Some(letter.clone()),
            name if name == self.index => Some(index.clone()),
            _ => None,
        };
        tidy(&rewrite(self.of, &put_in))
    }

    /// The equations of the sum, where some are found; `now` and `next` stand for its values, of which the next one has `step`
    /// terms more.
    pub(super) fn telescoped(&self, now: &Name, next: &Name, step: i64) -> Option<Telescoped> {
        let mut parameters = Vec::new();
        symbols(self.of, &mut |name| {
            if name != self.letter && name != self.index && !parameters.contains(name) {
                parameters.push(name.clone());
            }
        });
        // a name with a letter below it may be another for each number
        if parameters.len() > MOST_PARAMETERS || parameters.iter().any(|name| !name.subscript.is_empty()) {
            return None;
        }
        let degrees = (0..=HIGHEST_OF_LENGTH).flat_map(|length| [0, 1].map(|degree| (length, degree)));
        let found = degrees
            .filter(|(_, degree)| *degree == 0 || !parameters.is_empty())
            .find_map(|(length, degree)| self.solved(&parameters, length, degree))?;
        let [next_factor, now_factor, multiple @ ..] = found.as_slice() else {
            return None;
        };
        let at = |name: &Name| symbol(name);
        let more = |tree: Tree| sum(vec![tree, integer(1)]);
        let (letter, index) = (at(self.letter), at(self.index));
        // G(n, k) = p(n, k) F(n + 1, k)
        let multiple_at = |index: &Tree| {
            let powers = multiple.iter().zip(0..);
            let terms = powers.map(|(factor, degree)| product(vec![factor.clone(), power(index.clone(), degree)]));
            product(vec![sum(terms.collect()), self.term(&more(letter.clone()), index)])
        };
        let of_terms = Equation::between(
            sum(vec![
                product(vec![next_factor.clone(), self.term(&more(letter.clone()), &index)]),
                product(vec![now_factor.clone(), self.term(&letter, &index)]),
            ]),
            difference(multiple_at(&more(index.clone())), multiple_at(&index)),
        );
        let last = more(self.to.clone());
        let further = (1..=step).map(|j| self.term(&more(letter.clone()), &sum(vec![self.to.clone(), integer(j)])));
        let but_last = difference(at(next), sum(further.collect()));
        let of_sums = Equation::between(
            sum(vec![
                product(vec![next_factor.clone(), but_last]),
                product(vec![now_factor.clone(), at(now)]),
            ]),
            difference(multiple_at(&last), multiple_at(&integer(self.from))),
        );
        Some(Telescoped { of_terms, of_sums })
    }

    /// The polynomials of these degrees in the length and in the parameters: those of the next and of this sum, and those
    /// of the powers of the index in the multiple of the terms.
    fn solved(&self, parameters: &[Name], length: i32, degree: usize) -> Option<Vec<Tree>> {
        let mut monomials = Vec::new();
        for power_of in 0..=length {
            monomials.push((power_of, None));
            if degree > 0 {
                monomials.extend(parameters.iter().map(|name| (power_of, Some(name))));
            }
        }
        let polynomials = usize::try_from(HIGHEST).ok()? + 3;
        let unknown = polynomials * monomials.len();
        let mut rows = Vec::new();
        let mut random = Random(1);
        for _ in 0..unknown * 20 {
            if rows.len() >= unknown + 12 {
                break;
            }
            rows.extend(self.row(parameters, &monomials, &mut random));
        }
        let solution = (rows.len() >= unknown + 12).then(|| null_vector(rows, unknown))??;
        let tree = |coefficients: &[u128]| -> Option<Tree> {
            let terms = coefficients
                .iter()
                .zip(&monomials)
                .map(|(coefficient, (power_of, name))| {
                    let (above, below) = rational(*coefficient)?;
                    let own = quotient(integer(above), integer(below));
                    let other = name.map_or_else(|| integer(1), symbol);
                    Some(product(vec![own, power(symbol(self.letter), *power_of), other]))
                });
            Some(sum(terms.collect::<Option<_>>()?))
        };
        let found: Vec<Tree> = solution.chunks(monomials.len()).map(tree).collect::<Option<_>>()?;
        // one that says nothing of the next sum is no step
        let is_step = solution.iter().take(monomials.len()).any(|value| *value != 0);
        is_step.then_some(found)
    }

    /// The terms' equation at numbers that are drawn, one entry for each unknown coefficient.
    fn row(&self, parameters: &[Name], monomials: &[(i32, Option<&Name>)], random: &mut Random) -> Option<Vec<u128>> {
        let letter = i64::try_from(random.below(SPREAD)).ok()? + 2;
        let index = i64::try_from(random.below(SPREAD)).ok()?;
        let mut values = BTreeMap::new();
        for name in parameters {
            values.insert(name.clone(), u128::from(random.below(1 << 40)) + 2);
        }
        let term = |letter: i64, index: i64| {
            let known = |name: &Name| match name {
                name if name == self.letter => Some(modular(letter)),
                name if name == self.index => Some(modular(index)),
                name => values.get(name).copied(),
            };
            let whole = |tree: &Tree| {
                let put_in = |name: &Name| match name {
                    name if name == self.letter => Some(integer(letter)),
                    name if name == self.index => Some(integer(index)),
                    _ => None,
                };
                super::integers::whole(&rewrite(tree, &put_in))
            };
            value(self.of, &known, &whole)
        };
        let [next, now, beyond] = [
            term(letter + 1, index)?,
            term(letter, index)?,
            term(letter + 1, index + 1)?,
        ];
        if next == 0 && now == 0 && beyond == 0 {
            return None;
        }
        let mut factors = vec![next, now];
        for degree in 0..=HIGHEST {
            let power = |index: i64| raised(modular(index), u128::try_from(degree).unwrap_or(0));
            let there = times(power(index + 1), beyond);
            factors.push(minus(times(power(index), next), there));
        }
        let of_monomial = |(power_of, name): &(i32, Option<&Name>)| {
            let own = raised(modular(letter), u128::try_from(*power_of).unwrap_or(0));
            let other = name.map_or(Some(1), |name| values.get(name).copied());
            other.map(|other| times(own, other))
        };
        let monomials: Vec<u128> = monomials.iter().map(of_monomial).collect::<Option<_>>()?;
        let row = factors
            .iter()
            .flat_map(|factor| monomials.iter().map(|own| times(*factor, *own)));
        Some(row.collect())
    }
}

/// The tree with the arguments of factorials and the exponents in it added up.
pub(super) fn tidy(tree: &Tree) -> Tree {
    mapped(tree, &|node| match node {
        Tree::Call(name, argument, at) if name.base == FACTORIAL => {
            Some(Tree::Call(name.clone(), Box::new(factorial::added_up(argument)?), *at))
        }
        Tree::Operation(operation, at) => match &**operation {
            Operation::Binomial(of, chosen) => {
                let (of, chosen) = (factorial::added_up(of)?, factorial::added_up(chosen)?);
                Some(Tree::Operation(Box::new(Operation::Binomial(of, chosen)), *at))
            }
            _ => None,
        },
        Tree::RealPower(base, exponent, at) => {
            let (base, exponent) = (tidy(base), factorial::added_up(exponent)?);
            let whole = super::integers::whole(&exponent).and_then(|whole| i32::try_from(whole).ok());
            Some(match whole {
                Some(whole) => power(base, whole),
                None => Tree::RealPower(Box::new(base), Box::new(exponent), *at),
            })
        }
        _ => None,
    })
}

fn symbols(tree: &Tree, met: &mut dyn FnMut(&Name)) {
    if let Tree::Symbol(name, _) = tree {
        met(name);
    }
    tree.find_below(&mut |part| {
        symbols(part, met);
        None::<()>
    });
}

struct Random(u64);

impl Random {
    /// A number below a bound (splitmix64).
    fn below(&mut self, bound: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed ^ (mixed >> 31)) % bound
    }
}

fn modular(value: i64) -> u128 {
    let size = u128::from(value.unsigned_abs()) % PRIME;
    if value < 0 { minus(0, size) } else { size }
}

fn times(left: u128, right: u128) -> u128 {
    left * right % PRIME
}

fn minus(left: u128, right: u128) -> u128 {
    (left + PRIME - right) % PRIME
}

fn raised(base: u128, mut exponent: u128) -> u128 {
    let (mut base, mut out) = (base, 1);
    while exponent > 0 {
        if exponent % 2 == 1 {
            out = times(out, base);
        }
        base = times(base, base);
        exponent /= 2;
    }
    out
}

fn inverted(value: u128) -> Option<u128> {
    (value != 0).then(|| raised(value, PRIME - 2))
}

/// The value of a tree modulo the prime.
fn value(tree: &Tree, known: &dyn Fn(&Name) -> Option<u128>, whole: &dyn Fn(&Tree) -> Option<i64>) -> Option<u128> {
    let of = |tree: &Tree| value(tree, known, whole);
    let to_power = |base: u128, exponent: i64| {
        let size = raised(base, u128::from(exponent.unsigned_abs()));
        if exponent < 0 { inverted(size) } else { Some(size) }
    };
    Some(match tree {
        Tree::Number(number) => {
            let whole = number.to_integer();
            match whole {
                Some(whole) => modular(whole),
                None => {
                    let (above, below) = number.0.clone().into_parts();
                    let above = modular(i64::try_from(above).ok()?);
                    times(above, inverted(modular(i64::try_from(below).ok()?))?)
                }
            }
        }
        Tree::Symbol(name, _) => known(name)?,
        Tree::Negate(inner) => minus(0, of(inner)?),
        Tree::Sum(terms) => {
            let terms = terms.iter().map(of).collect::<Option<Vec<_>>>()?;
            terms.into_iter().fold(0, |total, term| (total + term) % PRIME)
        }
        Tree::Product(factors) => {
            let factors = factors.iter().map(of).collect::<Option<Vec<_>>>()?;
            factors.into_iter().fold(1, times)
        }
        Tree::Quotient(above, below, _) => times(of(above)?, inverted(of(below)?)?),
        Tree::Power(base, exponent, _) => to_power(of(base)?, i64::from(*exponent))?,
        Tree::RealPower(base, exponent, _) => to_power(of(base)?, whole(exponent)?)?,
        Tree::Call(name, argument, _) if name.base == FACTORIAL => {
            let last = whole(argument).filter(|last| (0..=LARGEST_FACTORIAL).contains(last))?;
            (1..=last).fold(1, |total, factor| times(total, modular(factor)))
        }
        Tree::Operation(operation, _) => match &**operation {
            Operation::Binomial(above, chosen) => of(&factorial::by_factorials(above, chosen))?,
            _ => return None,
        },
        _ => return None,
    })
}

/// A vector that all rows annihilate; `None` where there is none.
fn null_vector(mut rows: Vec<Vec<u128>>, columns: usize) -> Option<Vec<u128>> {
    let mut pivots: Vec<usize> = Vec::new();
    for column in 0..columns {
        let done = pivots.len();
        let Some(place) = (done..rows.len()).find(|row| rows.get(*row).and_then(|row| row.get(column)) != Some(&0))
        else {
            continue;
        };
        rows.swap(done, place);
        let pivot = rows.get(done)?.clone();
        let scale = inverted(*pivot.get(column)?)?;
        let pivot: Vec<u128> = pivot.into_iter().map(|entry| times(entry, scale)).collect();
        for (place, row) in rows.iter_mut().enumerate() {
            let factor = *row.get(column)?;
            if place != done && factor != 0 {
                for (entry, own) in row.iter_mut().zip(&pivot) {
                    *entry = minus(*entry, times(factor, *own));
                }
            }
        }
        *rows.get_mut(done)? = pivot;
        pivots.push(column);
    }
    let free = (0..columns).find(|column| !pivots.contains(column))?;
    let mut found = vec![0; columns];
    *found.get_mut(free)? = 1;
    for (row, pivot) in rows.iter().zip(&pivots) {
        *found.get_mut(*pivot)? = minus(0, *row.get(free)?);
    }
    Some(found)
}

/// The fraction of small numbers that a number is modulo the prime (Wang, A p-adic algorithm for univariate partial
/// fractions, 1981).
fn rational(value: u128) -> Option<(i64, i64)> {
    let (mut before, mut now) = ((PRIME, 0_i128), (value, 1_i128));
    while now.0 > LARGEST {
        let times = before.0 / now.0;
        let next = (before.0 - times * now.0, before.1 - i128::try_from(times).ok()? * now.1);
        (before, now) = (now, next);
    }
    let (above, below) = (i64::try_from(now.0).ok()?, i64::try_from(now.1).ok()?);
    let is_small = u128::from(below.unsigned_abs()) <= LARGEST && below != 0;
    is_small.then_some((if below < 0 { -above } else { above }, below.abs()))
}

#[cfg(test)]
mod tests {
    use super::super::build::{call, plain};
    use super::*;

    fn binomial(of: &Tree, index: &Tree) -> Tree {
        let factorial = |tree: Tree| call(FACTORIAL, tree);
        let below = product(vec![
            factorial(index.clone()),
            factorial(difference(of.clone(), index.clone())),
        ]);
        quotient(factorial(of.clone()), below)
    }

    #[test]
    fn fractions_are_found_again() {
        for (above, below) in [(1, 2), (-7, 3), (0, 1), (9999, 1000)] {
            let value = times(modular(above), inverted(modular(below)).unwrap());
            assert_eq!(rational(value), Some((above, below)));
        }
    }

    #[test]
    fn the_squares_of_binomial_coefficients_have_a_recurrence_and_other_powers_of_the_length_have_none() {
        let (n, k) = (plain("n"), plain("k"));
        let squared = power(binomial(&symbol(&n), &symbol(&k)), 2);
        let of = |of: &Tree| {
            let to = symbol(&n);
            let sum = Sum {
                of,
                index: &k,
                from: 0,
                to: &to,
                letter: &n,
            };
            sum.telescoped(&plain("S"), &plain("N"), 1).is_some()
        };
        assert!(of(&squared));
        assert!(!of(&Tree::RealPower(
            Box::new(symbol(&k)),
            Box::new(symbol(&n)),
            texmath::At::default()
        )));
    }
}
