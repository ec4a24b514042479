//! Dots between the first terms or factors and the last one, `1 + 2 + \cdots + n`.
//!
//! A law for them is read off what is printed, in one of three ways: the last term is the law and its letter runs, `x^n` after
//! `1 + x`; the first term is the law and its letter runs down, `n (n - 1) \cdots 1`; or a number in the first two terms grows by 1,
//! `\frac{1}{n + 1} + \frac{1}{n + 2} + \cdots + \frac{1}{2 n}`. All printed terms must be values of the law, the last one at an
//! index that is found. Two laws, or none, are no reading.

use super::error::Fault;
use super::evaluate::{Scope, Unsupported, evaluate};
use super::nodes::{any, names_in};
use super::part::{product, starts_factor};
use super::reader::{Reader, dots_left_open};
use super::substitute::rewrite;
use super::symbols::is_constant;
use super::token::{Kind, Token};
use super::{At, Name, Operation, Series, Tree};
use numbers::{Field, Rational};
use std::collections::BTreeSet;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::RangeInclusive;

/// The numbers at which a law may start or end.
const STARTS: RangeInclusive<i64> = -9..=20;

/// The differences between the index at which a law ends and a letter or number of the last term.
const OFFSETS: RangeInclusive<i64> = -3..=3;

/// The sets of numbers for letters at which terms are compared.
const POINTS: u64 = 4;

/// The letters that an index is called by, where they do not stand in the terms.
const INDICES: [&str; 6] = ["k", "j", "l", "m", "r", "s"];

/// Terms or factors between the first and the last one.
struct Law {
    term: Tree,
    letter: Name,
    /// The indices of all terms but one at an end, which is printed: without it there would be no first term.
    from: Tree,
    to: Tree,
    printed: Tree,
}

impl<'a> Reader<'a> {
    /// The terms before dots that were read, those for which the dots stand, and the last one, which stands next.
    pub(super) fn terms_between(&mut self, dots: Token<'a>, first: &[Tree]) -> Result<Tree, Fault> {
        if !matches!(self.peek_kind(), Some(Kind::Plus | Kind::Minus)) {
            return Err(dots_left_open(dots));
        }
        let last = self.signed_term()?;
        let last = self.beside(last)?;
        with_terms_between(Series::Sum, first, &last, At(dots.at)).ok_or_else(|| dots_left_open(dots))
    }

    /// The same of factors, of which the last one is all that no sign parts.
    pub(super) fn factors_between(&mut self, dots: Token<'a>, first: &[Tree]) -> Result<Tree, Fault> {
        self.take(Kind::Times);
        let mut last = Vec::new();
        while last.is_empty() || self.peek_kind().is_some_and(starts_factor) {
            let factor = self.factor()?;
            last.push(*self.beside(factor)?);
        }
        let last = product(last);
        with_terms_between(Series::Product, first, &last, At(dots.at)).ok_or_else(|| dots_left_open(dots))
    }

    /// Takes dots that stand in the place of factors, with a sign of multiplication before them if there is one.
    pub(super) fn dots_of_factors(&mut self) -> Option<Token<'a>> {
        let ahead = usize::from(self.peek_kind() == Some(Kind::Times));
        let dots = self.look(ahead).filter(|token| token.kind == Kind::Dots)?;
        self.next += ahead + 1;
        Some(dots)
    }
}

/// Returns the sum or product of terms, of which the first ones and the last one are printed.
fn with_terms_between(kind: Series, first: &[Tree], last: &Tree, at: At) -> Option<Tree> {
    let [one, two, ..] = first else {
        return None;
    };
    let ways = [by_last(first, last), by_first(first, last), by_number(first, last)];
    let Law {
        term,
        letter,
        from,
        to,
        printed,
    } = ways.into_iter().find(|laws| !laws.is_empty()).and_then(only)?;
    let are_numbers = [one, two].iter().all(|term| matches!(term, Tree::Number(_)));
    let is_clear = is_clear(&term, &letter, two) && (!are_numbers || is_straight(&term, &letter));
    if first.len() == 2 && !is_clear {
        return None;
    }
    let mut names = BTreeSet::new();
    first.iter().chain([last]).for_each(|term| names_in(term, &mut names));
    let mut indices = INDICES.iter().map(|base| Name::plain(base));
    let index = indices.find(|index| {
        !names
            .iter()
            .any(|name| name.base == index.base || name.subscript.contains(&index.base))
    })?;
    let of = rewrite(&term, &|name| {
        (*name == letter).then(|| Tree::Symbol(index.clone(), at))
    });
    let series = Operation::Series {
        kind,
        of,
        index,
        from,
        to,
    };
    let parts = vec![printed, Tree::Operation(Box::new(series), at)];
    Some(match kind {
        Series::Sum => Tree::Sum(parts),
        Series::Product => Tree::Product(parts),
    })
}

/// Returns what a list holds alone.
fn only(mut laws: Vec<Law>) -> Option<Law> {
    let one = laws.pop();
    one.filter(|_| laws.is_empty())
}

/// Finds laws that are the last term at a smaller value of one of its letters.
fn by_last(first: &[Tree], last: &Tree) -> Vec<Law> {
    let fits = |letter: &Name, start: i64| {
        (start..)
            .zip(first)
            .all(|(place, term)| is_equal(last, Some((letter, place)), term))
    };
    let law = |(letter, start): (Name, i64)| {
        Some(Law {
            term: last.clone(),
            from: number(start + 1),
            to: symbol(&letter),
            printed: first.first()?.clone(),
            letter,
        })
    };
    places(last, &fits).into_iter().filter_map(law).collect()
}

/// Finds laws that are the first term at a greater value of one of its letters, which runs down.
fn by_first(first: &[Tree], last: &Tree) -> Vec<Law> {
    let Some(one) = first.first() else {
        return Vec::new();
    };
    let lower = |letter: &Name, less: i64| rewrite(one, &|name| (name == letter).then(|| plus(symbol(letter), -less)));
    let fits = |letter: &Name, end: i64| {
        (0..)
            .zip(first)
            .all(|(less, term)| is_equal(&lower(letter, less), None, term))
            && is_equal(one, Some((letter, end)), last)
    };
    let law = |(letter, end): (Name, i64)| Law {
        term: one.clone(),
        from: number(end),
        to: plus(symbol(&letter), -1),
        printed: one.clone(),
        letter,
    };
    places(one, &fits).into_iter().map(law).collect()
}

/// Finds laws by a number that grows by 1 from the first term to the second.
fn by_number(first: &[Tree], last: &Tree) -> Vec<Law> {
    let [one, two, ..] = first else {
        return Vec::new();
    };
    let letter = Name::plain("\\index");
    let mut start = None;
    let Some(term) = growing(one, two, &letter, &mut start) else {
        return Vec::new();
    };
    let Some(start) = start.filter(|start| {
        (*start..)
            .zip(first)
            .all(|(place, own)| is_equal(&term, Some((&letter, place)), own))
    }) else {
        return Vec::new();
    };
    let mut ends: Vec<Tree> = Vec::new();
    any(last, &mut |node| {
        let whole = whole(node).map(number).filter(|_| matches!(node, Tree::Number(_)));
        let name = match node {
            Tree::Symbol(name, _) if !is_constant(name) => Some(symbol(name)),
            _ => None,
        };
        for end in whole
            .or(name)
            .into_iter()
            .flat_map(|end| OFFSETS.map(move |more| plus(end.clone(), more)))
        {
            if !ends.contains(&end) {
                ends.push(end);
            }
        }
        false
    });
    ends.retain(|end| whole(end).is_none_or(|end| end > start));
    let at_end = |end: &Tree| rewrite(&term, &|name| (*name == letter).then(|| end.clone()));
    ends.retain(|end| is_equal(&at_end(end), None, last));
    let law = |to: Tree| Law {
        term: term.clone(),
        letter: letter.clone(),
        from: number(start + 1),
        to,
        printed: one.clone(),
    };
    ends.into_iter().map(law).collect()
}

/// Returns the first of two trees with a letter for a number that is greater by 1 in the second wherever they differ.
fn growing(one: &Tree, two: &Tree, letter: &Name, start: &mut Option<i64>) -> Option<Tree> {
    if one == two {
        return Some(one.clone());
    }
    if let (Tree::Number(_), Tree::Number(_)) = (one, two) {
        let (from, to) = (whole(one)?, whole(two)?);
        let is_next = from.checked_add(1) == Some(to) && *start.get_or_insert(from) == from;
        return is_next.then(|| symbol(letter));
    }
    if let (Tree::Power(base, from, at), Tree::Power(other, to, _)) = (one, two)
        && from != to
    {
        let exponent = growing(&number((*from).into()), &number((*to).into()), letter, start)?;
        return (base == other).then(|| Tree::RealPower(base.clone(), Box::new(exponent), *at));
    }
    let (mut parts, mut others) = (Vec::new(), Vec::new());
    one.find_below(&mut |part| {
        parts.push(part);
        None::<()>
    });
    two.find_below(&mut |part| {
        others.push(part);
        None::<()>
    });
    let pairs = parts.iter().zip(&others);
    let grown = pairs.map(|(part, other)| growing(part, other, letter, start));
    let grown: Vec<Tree> = grown.collect::<Option<_>>()?;
    // all else is the same where the parts of the second make the first's
    let mut own = parts.into_iter();
    let rebuilt = two.map(&mut |_| own.next().cloned().unwrap_or_else(|| number(0)));
    let mut grown = grown.into_iter();
    (rebuilt == *one).then(|| one.map(&mut |part| grown.next().unwrap_or_else(|| part.clone())))
}

/// Returns the letters of a tree with the numbers that pass the test.
fn places(tree: &Tree, fits: &dyn Fn(&Name, i64) -> bool) -> Vec<(Name, i64)> {
    let mut names = BTreeSet::new();
    names_in(tree, &mut names);
    names.retain(|name| *name == Name::plain(&name.base) && !is_constant(name));
    let all = names
        .into_iter()
        .flat_map(|name| STARTS.map(move |start| (name.clone(), start)));
    all.filter(|(name, start)| fits(name, *start)).collect()
}

/// Returns true if the second of two terms shows how exponents and arguments grow: `1 + 2 + \cdots + 2^n` may be of all integers up
/// to 2^n, and `x + x^2 + \cdots + x^{2^n}` of all powers.
fn is_clear(term: &Tree, letter: &Name, two: &Tree) -> bool {
    let is_unclear = |node: &Tree| match node {
        Tree::RealPower(base, exponent, _) if exponent.has_free(letter) => {
            let is_printed = |base: &Tree| {
                any(two, &mut |node| match node {
                    Tree::Power(own, ..) | Tree::RealPower(own, ..) => **own == *base,
                    _ => false,
                })
            };
            let is_sign = whole(base) == Some(-1);
            let is_number = super::number_of(base).is_some();
            !is_straight(exponent, letter) || (is_number && !is_sign && !is_printed(base))
        }
        Tree::Call(_, argument, _) => argument.has_free(letter) && !is_straight(argument, letter),
        _ => false,
    };
    !any(term, &mut |node| is_unclear(node))
}

/// Returns true if terms at successive indices differ by the same number.
fn is_straight(term: &Tree, letter: &Name) -> bool {
    let values = |point: u64| {
        [2, 3, 4].map(|place| {
            Point {
                at: Some((letter, place)),
                point,
            }
            .value(term)
        })
    };
    (0..POINTS).all(|point| match values(point) {
        [Some(one), Some(two), Some(three)] => is_close(one + three, 2.0 * two),
        _ => false,
    })
}

/// Returns true if a tree, with an integer for a letter, has the value of another one at all of several points.
fn is_equal(tree: &Tree, at: Option<(&Name, i64)>, other: &Tree) -> bool {
    (0..POINTS).all(|point| {
        let own = Point { at, point }.value(tree);
        let other = Point { at: None, point }.value(other);
        own.zip(other).is_some_and(|(own, other)| is_close(own, other))
    })
}

fn is_close(one: f64, other: f64) -> bool {
    (one - other).abs() <= 1e-9 * one.abs().max(other.abs()).max(1e-3)
}

/// Numbers for all letters.
struct Point<'a> {
    /// The letter that is an integer.
    at: Option<(&'a Name, i64)>,
    point: u64,
}

impl Point<'_> {
    fn value(mut self, tree: &Tree) -> Option<f64> {
        evaluate(tree, &mut self).ok().filter(|value: &f64| value.is_finite())
    }

    /// Returns a number between 1 and 2 that belongs to a name.
    fn own(&self, of: &Name) -> f64 {
        let mut hasher = DefaultHasher::new();
        (of, self.point).hash(&mut hasher);
        1.0 + (hasher.finish() % 1_000_003) as f64 / 1_000_003.0
    }
}

impl Scope<f64> for Point<'_> {
    type Error = Unsupported;

    fn symbol(&mut self, name: &Name) -> Result<f64, Unsupported> {
        Ok(match self.at {
            Some((letter, value)) if letter == name => value as f64,
            _ => self.own(name),
        })
    }

    /// Any function does, if it has the same value at the same argument.
    fn call(&mut self, function: &Name, argument: &Tree) -> Result<f64, Unsupported> {
        let unsupported = || Unsupported::Call(function.clone());
        let argument: f64 = evaluate(argument, self).map_err(|_| unsupported())?;
        if function.base != super::command::FACTORIAL {
            return Ok((self.own(function) + argument).sin());
        }
        let is_small = argument.fract() == 0.0 && (0.0..=30.0).contains(&argument);
        let product = || (1..=argument as i64).map(|factor| factor as f64).product();
        is_small.then(product).ok_or_else(unsupported)
    }

    fn root(&mut self, radicand: f64, index: u32) -> Result<f64, Unsupported> {
        Ok(radicand.powf(1.0 / f64::from(index)))
    }

    fn real_power(&mut self, base: f64, exponent: f64) -> Result<f64, Unsupported> {
        Ok(base.powf(exponent))
    }
}

fn number(value: i64) -> Tree {
    match value {
        0.. => Tree::Number(Rational::from_integer(value)),
        _ => Tree::Negate(Box::new(Tree::Number(Rational::from_integer(-value)))),
    }
}

fn symbol(name: &Name) -> Tree {
    Tree::Symbol(name.clone(), At::default())
}

fn whole(tree: &Tree) -> Option<i64> {
    super::number_of(tree)?.to_integer()
}

fn plus(tree: Tree, more: i64) -> Tree {
    match (whole(&tree), more) {
        (Some(value), _) => number(value + more),
        (None, 0) => tree,
        (None, more) => Tree::Sum(vec![tree, number(more)]),
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Names, Tree, read_expression};

    fn read(tex: &str) -> Result<Tree, String> {
        read_expression(tex, &Names::default()).map_err(|fault| fault.to_string())
    }

    #[test]
    fn the_printed_terms_give_the_others() {
        for (tex, wanted) in [
            (r"1 + 2 + \cdots + n", r"1 + \sum_{k = 2}^{n} k"),
            (r"1 + x + x^2 + \cdots + x^n", r"1 + \sum_{k = 1}^{n} x^k"),
            (r"1 + 2 + 4 + \dots + 2^n", r"1 + \sum_{k = 1}^{n} 2^k"),
            (r"1^2 + 2^2 + ... + 10^2", r"1^2 + \sum_{k = 2}^{10} k^2"),
            (r"n + (n - 1) + \cdots + 1", r"n + \sum_{k = 1}^{n - 1} k"),
            (
                r"\frac{1}{n + 1} + \frac{1}{n + 2} + \cdots + \frac{1}{2 n}",
                r"\frac{1}{n + 1} + \sum_{k = 2}^{n} \frac{1}{n + k}",
            ),
            (r"1 - x + x^2 - \cdots + (-1)^n x^n", r"1 + \sum_{k = 1}^{n} (-1)^k x^k"),
            (r"1 \cdot 3 \cdots (2 n - 1)", r"1 \cdot \prod_{k = 2}^{n} (2 k - 1)"),
            (r"2 \cdot 4 \cdot \ldots \cdot 2 n", r"2 \cdot \prod_{k = 2}^{n} (2 k)"),
            (r"k + k^2 + \cdots + k^n", r"k + \sum_{j = 2}^{n} k^j"),
            (
                r"n (n - 1) \cdots (n - m + 1)",
                r"n \cdot \prod_{k = 2}^{m} (n - k + 1)",
            ),
        ] {
            assert_eq!(read(tex), read(wanted), "{tex}");
        }
    }

    #[test]
    fn dots_that_may_stand_for_others_are_not_read() {
        for tex in [
            r"1 + \cdots + n",
            r"1 + 2 + \cdots",
            r"1 + 2 + \cdots + 2^n",
            r"1 + 3 + \cdots + 3^n",
            r"1 + \frac{1}{2} + \cdots + \frac{1}{2^n}",
            r"x + x^2 + \cdots + x^{2^n}",
            r"\cos(x) + \cos(2 x) + \cdots + \cos(2^n x)",
            r"1 + 3 + \cdots + n",
            r"1 + 2 + 5 + \cdots + n",
            r"x + 2 x + \cdots + y",
            r"a_1 \cdots a_n",
            r"1 + 2 \cdots n",
            r"a / b \cdots c",
        ] {
            let fault = read(tex).unwrap_err();
            assert!(fault.contains("write out what is meant"), "{tex}: {fault}");
        }
    }
}
