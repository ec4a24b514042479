//! The search for tests of convergence of sums to infinity, with bounds of these. Nothing rests on it: that the conditions of a test
//! hold, and that bounds are ones, is shown by lemmas.

use super::super::integration;
use super::super::integration::tree::{
    integer, negative, number, power, product, quotient, real_power, root, sum, symbol, value,
};
use super::linear;
use claims::{SeriesTest, Test};
use numbers::{Field, Rational};
use texmath::{Name, Symbols, Tree, any, mapped, number_of, rewrite};

/// The index up to which terms are looked at, and some further ones.
const LOOKED_AT: i64 = 120;
const FAR: [f64; 4] = [1e3, 1e4, 1e5, 1e6];

/// The most terms before those of a test, and how close bounds are to be.
const MOST_BEFORE: i64 = 50;
const CLOSE: f64 = 1e-9;

/// The base of powers that those whose bases move are compared with.
const BASE: i64 = 4;

/// The ratios that are tried.
const RATIOS: [(i64, i64); 6] = [(1, 4), (1, 2), (2, 3), (3, 4), (4, 5), (9, 10)];

/// The multiples of powers that terms are compared with.
const MULTIPLES: [(i64, i64); 6] = [(1, 1), (2, 1), (4, 1), (10, 1), (1, 2), (1, 10)];

/// Bounds are multiples of this part of 1.
const PARTS: f64 = 1e10;

/// Returns tests of a sum whose index runs from 0 on, the likeliest first.
pub fn tests(of: &Tree, index: &Name, symbols: &Symbols) -> Vec<SeriesTest> {
    let terms = Terms {
        of: of.clone(),
        index,
        symbols,
    };
    let values: Option<Vec<f64>> = (0..LOOKED_AT).map(|k| terms.value(k)).collect();
    let Some(values) = values.filter(|values| values.iter().all(|value| value.is_finite())) else {
        return Vec::new();
    };
    if let Some(other) = with_numbers_as_bases(of, index) {
        return terms.by_ratios_of(&other, &values).into_iter().collect();
    }
    let last = values.get(MOST_BEFORE as usize..).unwrap_or_default();
    let mut found = Vec::new();
    let all = |is_one: &dyn Fn(f64, f64) -> bool| {
        let mut pairs = last.iter().zip(last.iter().skip(1));
        pairs.all(|(one, next)| is_one(*one, *next))
    };
    if all(&|one, next| one * next < 0.0) {
        found.extend(terms.alternating(&values));
    }
    let is_negative = all(&|one, _| one <= 0.0);
    if is_negative || all(&|one, _| one >= 0.0) {
        let signed = Terms {
            of: if is_negative { negative(of.clone()) } else { of.clone() },
            ..terms.clone()
        };
        found.extend(signed.of_one_sign(&values, is_negative));
    }
    found.extend(terms.by_powers(&values));
    found
}

/// The terms of a sum.
#[derive(Clone)]
struct Terms<'a> {
    of: Tree,
    index: &'a Name,
    symbols: &'a Symbols,
}

impl Terms<'_> {
    fn value(&self, k: i64) -> Option<f64> {
        at_integer(&self.of, self.index, k)
    }

    fn far(&self, tree: &Tree, x: f64) -> Option<f64> {
        at_number(tree, self.index, x)
    }

    /// The first index, at most the last one that is tried, from which on each value is at most a multiple of the one before.
    fn first_falling(values: &[f64], ratio: f64) -> Option<i64> {
        let pairs = values.iter().zip(values.iter().skip(1));
        let mut places = pairs.enumerate().rev();
        let last = places.find(|(_, (one, next))| next.abs() > ratio * one.abs() * (1.0 + 1e-12));
        let first = last.map_or(0, |(place, _)| place as i64 + 1);
        (first <= MOST_BEFORE).then_some(first)
    }

    fn alternating(&self, values: &[f64]) -> Option<SeriesTest> {
        let mut slope = 0;
        let sizes = without_signs(&self.of, self.index, &mut slope)?;
        (slope % 2 != 0).then_some(())?;
        let first = Self::first_falling(values, 1.0)?;
        let from = enough(first, values, &|k| values.get(k as usize).map(|value| value.abs()))?;
        let is_negative = at_integer(&sizes, self.index, from)? < 0.0;
        let own = *values.get(from as usize)?;
        let rest = if own > 0.0 { [0.0, own] } else { [own, 0.0] };
        Some(SeriesTest {
            test: Test::Alternating(if is_negative { negative(sizes) } else { sizes }),
            from,
            is_negative,
            compared: None,
            bounds: Some(bounds(values, from, rest)?),
        })
    }

    /// Tests of terms that are not negative from an index on; the values are those of the sum itself.
    fn of_one_sign(&self, values: &[f64], is_negative: bool) -> Vec<SeriesTest> {
        let sized = |test: Test, from: i64, bounds: Option<[Rational; 2]>| SeriesTest {
            test,
            from,
            is_negative,
            compared: None,
            bounds,
        };
        let signed = |rest: [f64; 2]| if is_negative { [-rest[1], -rest[0]] } else { rest };
        let mut found = Vec::new();
        let far: Vec<f64> = FAR.iter().filter_map(|x| self.far(&self.of, *x)).collect();
        if let [.., before, last] = far.as_slice()
            && *last > 1e-3
            && last / before > 0.99
        {
            found.push(sized(Test::Term, 0, None));
            return found;
        }
        found.extend(Self::ratio(values).and_then(|(test, from, most)| {
            let bounds = bounds(values, from, signed([0.0, most]))?;
            Some(sized(test, from, Some(bounds)))
        }));
        found.extend(self.integral(&self.of, values).map(|(test, from, rest)| {
            let bounds = rest.and_then(|rest| bounds(values, from, signed(rest)));
            sized(test, from, bounds)
        }));
        found
    }

    /// A ratio test of terms of one sign, the index from which it applies, and a bound of their sum from there on.
    fn ratio(values: &[f64]) -> Option<(Test, i64, f64)> {
        RATIOS.iter().find_map(|(above, below)| {
            let ratio = *above as f64 / *below as f64;
            let first = Self::first_falling(values, ratio * 0.999)?;
            let most = |k: i64| values.get(k as usize).map(|value| value.abs() / (1.0 - ratio));
            let from = enough(first, values, &most)?;
            Some((Test::Ratio(Rational::new(*above, *below)?), from, most(from)?))
        })
    }

    /// A comparison with terms to which the ratio test applies.
    fn by_ratios_of(&self, other: &Tree, values: &[f64]) -> Option<SeriesTest> {
        let own: Option<Vec<f64>> = (0..LOOKED_AT).map(|k| at_integer(other, self.index, k)).collect();
        let own = own?;
        let (test, from, most) = Self::ratio(&own)?;
        let is_above = |(value, other): (&f64, &f64)| value.abs() <= other.abs() * (1.0 + 1e-9);
        let mut pairs = values.iter().zip(&own).skip(from as usize);
        pairs.all(is_above).then_some(())?;
        Some(SeriesTest {
            test,
            from,
            is_negative: false,
            compared: Some(other.clone()),
            bounds: Some(bounds(values, from, [-most, most])?),
        })
    }

    /// An integral test of a function of the index that falls from a number on, and bounds of the sum from there on.
    fn integral(&self, of: &Tree, values: &[f64]) -> Option<(Test, i64, Option<[f64; 2]>)> {
        let first = Self::first_falling(values, 1.0)?;
        let whole = integration::antiderivatives(of, self.index, self.symbols)
            .into_iter()
            .next()?;
        let ends = [1e40, 1e80].map(|x| self.far(&whole, x));
        let [Some(near), Some(far)] = ends else { return None };
        if !near.is_finite() || !far.is_finite() || (far - near).abs() > 0.05 {
            return Some((Test::Integral(whole), first, None));
        }
        let own = |k: i64| at_integer(of, self.index, k);
        let from = enough(first, values, &own)?;
        let slack = 3.0 * (far - near).abs();
        let low = far - at_integer(&whole, self.index, from)?;
        let rest = [low - slack, own(from)? + low + slack];
        Some((Test::Integral(whole), from, Some(rest)))
    }

    /// A comparison with a multiple of a power of the index.
    fn by_powers(&self, values: &[f64]) -> Option<SeriesTest> {
        let shift = shift(&self.of, self.index);
        let there = sum(vec![symbol(self.index), integer(shift)]);
        let is_negative = values.last().is_some_and(|last| *last < 0.0);
        let far: Vec<(f64, f64)> = FAR
            .iter()
            .filter_map(|x| Some((*x, self.far(&self.of, *x)?)))
            .chain(values.iter().enumerate().map(|(k, value)| (k as f64, *value)))
            .collect();
        let from = shift.max(2);
        let multiple = |exponent: f64, is_above: bool| {
            MULTIPLES.into_iter().find(|(above, below)| {
                let factor = *above as f64 / *below as f64;
                far.iter().filter(|(k, _)| *k >= from as f64).all(|(k, value)| {
                    let other = factor / (k + shift as f64).powf(exponent);
                    let value = if is_above || !is_negative { *value } else { -*value };
                    let slack = 1.0 - 1e-9;
                    if is_above {
                        value.abs() * slack <= other
                    } else {
                        value >= other * slack
                    }
                })
            })
        };
        let powers = [
            (2.0, power(there.clone(), 2)),
            (1.5, product(vec![there.clone(), root(there.clone(), 2)])),
        ];
        for (exponent, tree) in powers {
            let Some((above, below)) = multiple(exponent, true) else {
                continue;
            };
            let other = quotient(number(&Rational::new(above, below)?), tree);
            let own: Vec<f64> = (0..LOOKED_AT)
                .filter_map(|k| at_integer(&other, self.index, k))
                .collect();
            let (test, from, rest) = self.integral(&other, &own)?;
            let [_, most] = rest?;
            return Some(SeriesTest {
                test,
                from,
                is_negative: false,
                compared: Some(other),
                bounds: Some(bounds(values, from, [-most, most])?),
            });
        }
        let (above, below) = multiple(1.0, false)?;
        let other = quotient(number(&Rational::new(above, below)?), there.clone());
        let whole = product(vec![
            number(&Rational::new(above, below)?),
            Tree::Call(Name::plain("\\ln"), Box::new(there), texmath::At::default()),
        ]);
        Some(SeriesTest {
            test: Test::Integral(whole),
            from,
            is_negative,
            compared: Some(other),
            bounds: None,
        })
    }
}

fn at_number(tree: &Tree, index: &Name, x: f64) -> Option<f64> {
    let letters = |name: &Name| match name.base.as_str() {
        _ if name == index => x,
        "e" => std::f64::consts::E,
        "\\pi" => std::f64::consts::PI,
        _ => f64::NAN,
    };
    value(tree, &letters).filter(|value| !value.is_nan())
}

/// The tree with a number in the place of each base that moves with its exponent; None where there is none.
fn with_numbers_as_bases(tree: &Tree, index: &Name) -> Option<Tree> {
    let moves = |node: &Tree| match node {
        Tree::RealPower(base, exponent, _) => base.has_free(index) && exponent.has_free(index),
        _ => false,
    };
    any(tree, &mut |node| moves(node)).then(|| {
        mapped(tree, &|node| match node {
            Tree::RealPower(_, exponent, _) if moves(node) => Some(real_power(integer(BASE), (**exponent).clone())),
            _ => None,
        })
    })
}

/// The value of a tree at an integer, factorials included.
fn at_integer(tree: &Tree, index: &Name, k: i64) -> Option<f64> {
    let there = rewrite(tree, &|name| (name == index).then(|| integer(k)));
    let factorial = |of: &Tree| {
        let last = number_of(of)?.to_integer().filter(|last| (0..=400).contains(last))?;
        let one = Rational::from_integer(1);
        Some(Tree::Number(
            (1..=last).fold(one, |all, factor| all * Rational::from_integer(factor)),
        ))
    };
    let there = mapped(&there, &|node| match node {
        Tree::Call(name, argument, _) if name.base == "\\factorial" => factorial(argument),
        tree => number_of(tree).map(|value| number(&value)),
    });
    at_number(&there, index, k as f64)
}

/// The index from the first one on at which bounds are close enough, and at most the last one that is tried.
fn enough(first: i64, values: &[f64], width: &dyn Fn(i64) -> Option<f64>) -> Option<i64> {
    let size = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let is_close = |k: &i64| width(*k).is_some_and(|width| width < CLOSE * size);
    let mut further = first..MOST_BEFORE;
    Some(further.find(is_close).unwrap_or(first.max(MOST_BEFORE)))
}

/// Bounds of a sum by those of its terms from an index on, with what rounding may be.
fn bounds(values: &[f64], from: i64, rest: [f64; 2]) -> Option<[Rational; 2]> {
    let before: f64 = values.iter().take(usize::try_from(from).ok()?).sum();
    let [low, high] = rest.map(|rest| (before + rest) * PARTS);
    let is_small = low.abs() < 1e17 && high.abs() < 1e17;
    let whole = |value: f64| Rational::new(value as i64, PARTS as i64);
    let slack = 2.0 + 1e-4 * (low.abs() + high.abs()) / PARTS;
    is_small.then_some([whole((low - slack).floor())?, whole((high + slack).ceil())?])
}

/// The number that is added to the index somewhere in a tree; 1 where it is nowhere.
fn shift(tree: &Tree, index: &Name) -> i64 {
    let mut found = None;
    any(tree, &mut |node| {
        if let Tree::Sum(..) = node
            && let Some((1, offset)) = linear(node, index)
        {
            found = found.or(Some(offset));
        }
        false
    });
    found.filter(|offset| *offset > 0).unwrap_or(1)
}

/// The tree without the signs that powers of negative numbers have; adds up the factors of the index in these powers.
fn without_signs(tree: &Tree, index: &Name, slope: &mut i64) -> Option<Tree> {
    Some(match tree {
        tree if !tree.has_free(index) => tree.clone(),
        Tree::Negate(inner) => negative(without_signs(inner, index, slope)?),
        Tree::Product(factors) => {
            let factors = factors.iter().map(|factor| without_signs(factor, index, slope));
            product(factors.collect::<Option<_>>()?)
        }
        Tree::Quotient(above, below, _) => {
            let above = without_signs(above, index, slope)?;
            quotient(above, without_signs(below, index, slope)?)
        }
        Tree::RealPower(base, exponent, _) => match number_of(base) {
            Some(base) if base < Rational::from_integer(0) => {
                let (own, offset) = linear(exponent, index)?;
                *slope += own;
                let size = Rational::from_integer(0) - base;
                let power = match size == Rational::from_integer(1) {
                    true => integer(1),
                    false => real_power(number(&size), (**exponent).clone()),
                };
                if offset % 2 == 0 { power } else { negative(power) }
            }
            _ => tree.clone(),
        },
        tree => tree.clone(),
    })
}
