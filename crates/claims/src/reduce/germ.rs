//! Functions of a letter that grows without bound, compared by how fast they grow: limits by the algorithm of Gruntz
//! (On Computing Limits in a Symbolic Manipulation System, ETH thesis 1996, chapter 3).
//!
//! One small quantity stands for all that varies most rapidly; the coefficients of a series in it vary less, and the first of them is
//! followed in turn. Zeros and signs of coefficients are guessed at numbers, and each guess is a condition that a lemma shows.

use super::build::{call, integer, negative, quotient, real_power, symbol};
use super::derivative::{By, mentions};
use super::series::{
    Series, add, divide, exponential_of, guess_at, holds_of_numbers, is_one, is_zero, multiply, power_of, ratio,
    relation, value_at, vanishes_at,
};
use numbers::{Field, Rational};
use std::cmp::Ordering;
use std::collections::{BTreeMap, HashMap};
use texmath::{
    At, Elementary, Equation, Name, Operation, Relation, Symbols, Tree, any, mapped, nodes_of, number_of, rewrite,
};

/// The steps of one limit, the deepest it goes, and the largest tree.
const STEPS: u32 = 4_000;
const DEEPEST: u32 = 24;
const LARGEST: usize = 4_000;

/// Numbers for what grows without bound.
const LARGE: [f64; 4] = [3.1, 5.3, 11.7, 37.9];

/// The limit of a function of real numbers.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum End {
    Finite(Box<Tree>),
    /// Above all numbers, or below.
    Infinite(bool),
}

impl End {
    pub fn finite(tree: Tree) -> Self {
        Self::Finite(Box::new(tree))
    }
}

type Found<T> = Result<T, String>;

/// The powers of e that vary most rapidly, of one order of growth: each is a power of the small quantity times what varies less.
struct Scale {
    /// The small quantity is e to minus this, which grows.
    exponent: Tree,
    /// Each power of e, its exponent, and how many times `exponent` that is.
    members: Vec<(Tree, Tree, Tree)>,
}

/// A letter between -1 and 1 for a function that oscillates.
pub(super) struct Wave {
    pub of: Tree,
    pub name: Name,
    /// Conditions under which it takes both of these values again and again, if any are known.
    pub full: Option<Vec<Equation>>,
}

/// Functions of a letter that grows without bound.
pub(super) struct Germs<'a> {
    pub symbols: &'a Symbols,
    /// Functions of which premises speak: how smooth these are is not known.
    pub given: Vec<Name>,
    pub letter: Name,
    /// The letter that tends to something, which is this one where that is infinity.
    pub by: Name,
    /// Names for functions that oscillate.
    pub names: Vec<Name>,
    /// True if the letter takes integers alone.
    pub is_integer: bool,
    /// Letters of which no sign is known.
    pub unsigned: Vec<Name>,
    /// Numbers for all other letters.
    pub point: BTreeMap<Name, f64>,
    /// The number of terms of a series.
    pub length: usize,
    /// Conditions under which the result is right: at large values of the letter, and for all values of others.
    pub needed: Vec<Equation>,
    /// Trees that do not move and must have a value, also where they meet a 0.
    pub written: Vec<Tree>,
    pub waves: Vec<Wave>,
    /// True if the result may be another one where the small quantity is negative.
    pub is_one_sided: bool,
    pub limits: HashMap<Tree, Found<End>>,
    pub steps: u32,
    pub depth: u32,
}

impl Germs<'_> {
    pub fn need(&mut self, condition: Equation) {
        if !holds_of_numbers(&condition) && !self.needed.contains(&condition) {
            self.needed.push(condition);
        }
    }

    pub fn moves(&self, tree: &Tree) -> bool {
        mentions(tree, &self.letter)
    }

    pub fn oscillates(&self, tree: &Tree) -> bool {
        self.waves.iter().any(|wave| mentions(tree, &wave.name))
    }

    fn step(&mut self, tree: &Tree) -> Found<()> {
        self.steps += 1;
        match self.steps > STEPS || nodes_of(tree) > LARGEST {
            true => Err("a limit that is not followed so far".to_owned()),
            false => Ok(()),
        }
    }

    fn values<'s>(&'s self) -> impl Iterator<Item = impl Fn(&Name) -> Option<f64> + 's> + 's {
        LARGE.iter().map(move |large| {
            move |name: &Name| match *name == self.letter {
                true => Some(*large),
                false => self.point.get(name).copied(),
            }
        })
    }

    pub fn is_likely_zero(&self, tree: &Tree) -> bool {
        let mut values = self.values().filter_map(|of| vanishes_at(tree, &of));
        let first = is_zero(tree) || values.next() == Some(true);
        first && values.all(|vanishes| vanishes)
    }

    /// Compares two exponents.
    fn compare(&mut self, one: &Tree, other: &Tree) -> Found<Ordering> {
        if let (Some(one), Some(other)) = (number_of(one), number_of(other)) {
            return Ok(one.cmp(&other));
        }
        let difference = add(vec![one.clone(), negative(other.clone())]);
        self.side(&difference)
    }

    /// Compares a number with letters with 0.
    fn side(&mut self, tree: &Tree) -> Found<Ordering> {
        let zero = Rational::from_integer(0);
        if let Some(value) = number_of(tree) {
            return Ok(value.cmp(&zero));
        }
        if self.is_likely_zero(tree) {
            self.need(relation(tree.clone(), Relation::Equal));
            return Ok(Ordering::Equal);
        }
        Ok(if self.sign(tree)? {
            Ordering::Greater
        } else {
            Ordering::Less
        })
    }

    /// Returns true if a function is positive in the end; it is negative otherwise.
    pub fn sign(&mut self, tree: &Tree) -> Found<bool> {
        if self.moves(tree) {
            let (exponent, first) = self.first(tree)?;
            self.is_one_sided |= !is_zero(&exponent);
            return self.sign(&first);
        }
        let value = self.values().next().and_then(|of| guess_at(tree, &of));
        let is_positive = value.ok_or_else(|| format!("the sign of `{tree}`"))? > 0.0;
        let sign = if is_positive { Relation::Greater } else { Relation::Less };
        self.need(relation(tree.clone(), sign));
        Ok(is_positive)
    }

    /// Requires that a function is not 0 in the end.
    pub fn nonzero(&mut self, tree: &Tree) -> Found<()> {
        if self.moves(tree) {
            let (_, first) = self.first(tree)?;
            return self.nonzero(&first);
        }
        if self.is_likely_zero(tree) {
            return Err(format!("a division by `{tree}`, which may be 0"));
        }
        self.need(relation(tree.clone(), Relation::NotEqual));
        Ok(())
    }

    /// Returns the first term of a function that is not 0, as the exponent of the small quantity and its coefficient.
    fn first(&mut self, tree: &Tree) -> Found<(Tree, Tree)> {
        let (series, _) = self.expanded(tree)?;
        let series = self.leading(&series)?;
        series
            .terms
            .into_iter()
            .next()
            .ok_or_else(|| "no term is known".to_owned())
    }

    /// Returns the limit of a prepared tree.
    pub fn limit(&mut self, tree: &Tree) -> Found<End> {
        match tree {
            Tree::Symbol(name, _) if *name == self.letter => return Ok(End::Infinite(true)),
            tree if !self.moves(tree) => return Ok(End::finite(tree.clone())),
            _ => {}
        }
        if let Some(known) = self.limits.get(tree) {
            return known.clone();
        }
        self.step(tree)?;
        if self.depth >= DEEPEST {
            return Err("a limit that is not followed so deep".to_owned());
        }
        self.depth += 1;
        let found = self.limit_of_series(tree);
        self.depth -= 1;
        self.limits.insert(tree.clone(), found.clone());
        found
    }

    fn limit_of_series(&mut self, tree: &Tree) -> Found<End> {
        let (series, _) = self.expanded(tree)?;
        for (exponent, coefficient) in &series.terms {
            match self.side(exponent)? {
                Ordering::Greater => return Ok(End::finite(integer(0))),
                Ordering::Equal => return self.limit(coefficient),
                Ordering::Less if self.is_likely_zero(coefficient) => {
                    self.need(relation(coefficient.clone(), Relation::Equal));
                }
                Ordering::Less => return Ok(End::Infinite(self.sign(coefficient)?)),
            }
        }
        match &series.end {
            Some(end) if self.side(end)? != Ordering::Greater => Err(SHORT.to_owned()),
            _ => Ok(End::finite(integer(0))),
        }
    }

    /// Returns what must be 0 for a prepared tree to stay bounded, or to vanish: 1 where it does not.
    pub fn unbounded(&mut self, tree: &Tree, must_vanish: bool) -> Found<Vec<Tree>> {
        let (series, _) = self.expanded(tree)?;
        let mut found = Vec::new();
        for (exponent, coefficient) in &series.terms {
            match self.side(exponent)? {
                Ordering::Greater => return Ok(found),
                Ordering::Less if self.oscillates(coefficient) => {
                    return Err("what oscillates has an effect on the order".to_owned());
                }
                Ordering::Less if !self.moves(coefficient) => found.push(coefficient.clone()),
                Ordering::Less if self.is_likely_zero(coefficient) => {
                    self.need(relation(coefficient.clone(), Relation::Equal));
                }
                Ordering::Less => {
                    self.nonzero(coefficient)?;
                    found.push(integer(1));
                }
                Ordering::Equal => {
                    match self.limit(coefficient)? {
                        End::Infinite(_) => found.push(integer(1)),
                        End::Finite(value) if must_vanish && self.oscillates(&value) => {
                            return Err("what oscillates has an effect on the order".to_owned());
                        }
                        End::Finite(value) => found.extend(must_vanish.then_some(*value)),
                    }
                    return Ok(found);
                }
            }
        }
        match &series.end {
            Some(end) if self.side(end)? != Ordering::Greater => Err(SHORT.to_owned()),
            _ => Ok(found),
        }
    }

    /// Returns what varies most rapidly in a prepared tree: the letter, and powers of e.
    fn fastest(&mut self, tree: &Tree) -> Found<Vec<Tree>> {
        if !self.moves(tree) {
            return Ok(Vec::new());
        }
        let mut all = match tree {
            Tree::Symbol(..) => return Ok(vec![tree.clone()]),
            Tree::Call(name, exponent, _) if name.base == "\\exp" => match self.limit(exponent)? {
                End::Infinite(_) => {
                    self.is_one_sided = true;
                    vec![tree.clone()]
                }
                End::Finite(_) => Vec::new(),
            },
            _ => Vec::new(),
        };
        let mut parts = Vec::new();
        tree.find_below(&mut |part| {
            parts.push(part.clone());
            None::<()>
        });
        for part in parts {
            let own = self.fastest(&part)?;
            all = self.faster(all, own)?;
        }
        Ok(all)
    }

    /// Returns the one of two sets that varies more rapidly; both where they are of one order of growth.
    fn faster(&mut self, one: Vec<Tree>, mut other: Vec<Tree>) -> Found<Vec<Tree>> {
        let (Some(first), Some(second)) = (one.first(), other.first()) else {
            return Ok(if one.is_empty() { other } else { one });
        };
        if !other.iter().any(|own| one.contains(own)) {
            let ratio = quotient(Self::logarithm_of(first), Self::logarithm_of(second));
            match self.limit(&ratio)? {
                End::Infinite(_) => return Ok(one),
                End::Finite(ratio) => {
                    if self.side(&ratio)? == Ordering::Equal {
                        return Ok(other);
                    }
                }
            }
        }
        other.retain(|own| !one.contains(own));
        Ok(one.into_iter().chain(other).collect())
    }

    /// Returns the logarithm of the letter or of a power of e.
    fn logarithm_of(tree: &Tree) -> Tree {
        match tree {
            Tree::Call(_, exponent, _) => (**exponent).clone(),
            tree => call("\\ln", tree.clone()),
        }
    }

    /// Returns the tree with e to the letter in place of the letter.
    fn raised_up(&self, tree: &Tree) -> Tree {
        let put = rewrite(tree, &|name| {
            (*name == self.letter).then(|| call("\\exp", symbol(&self.letter)))
        });
        let up = |node: &Tree| match node {
            Tree::Call(outer, inner, _) if outer.base == "\\ln" => match &**inner {
                Tree::Call(name, letter, _) if name.base == "\\exp" && matches!(**letter, Tree::Symbol(..)) => {
                    Some((**letter).clone())
                }
                _ => None,
            },
            _ => None,
        };
        mapped(&put, &up)
    }

    /// Returns the series of a prepared tree in what varies most rapidly.
    pub fn expanded(&mut self, tree: &Tree) -> Found<(Series, Tree)> {
        if !self.moves(tree) {
            return Ok((Series::constant(tree.clone()), symbol(&self.letter)));
        }
        self.step(tree)?;
        let (mut tree, mut members) = (tree.clone(), self.fastest(tree)?);
        if members.iter().any(|own| matches!(own, Tree::Symbol(..))) {
            tree = self.raised_up(&tree);
            members = members.iter().map(|own| self.raised_up(own)).collect();
        }
        let exponent = |own: &Tree| Self::logarithm_of(own);
        let least = members.iter().map(exponent).min_by_key(nodes_of);
        let least = least.ok_or("nothing moves")?;
        let is_growing = match self.limit(&least)? {
            End::Infinite(is_growing) => is_growing,
            End::Finite(_) => return Err("what varies most rapidly does not grow".to_owned()),
        };
        let slow = if is_growing { least } else { negative(least) };
        let mut scale = Scale {
            exponent: slow.clone(),
            members: Vec::new(),
        };
        for member in members {
            let own = exponent(&member);
            let times = if own == slow {
                integer(1)
            } else if own == negative(slow.clone()) {
                integer(-1)
            } else {
                match self.limit(&quotient(own.clone(), slow.clone()))? {
                    End::Finite(times) => *times,
                    End::Infinite(_) => return Err("two orders of growth".to_owned()),
                }
            };
            scale.members.push((member, own, times));
        }
        let series = self.series(&tree, &scale)?;
        Ok((series, slow))
    }

    /// Returns the series of a prepared tree on a scale.
    fn series(&mut self, tree: &Tree, scale: &Scale) -> Found<Series> {
        let is_member = |node: &Tree| scale.members.iter().any(|(member, ..)| member == node);
        if !any(tree, &mut |node| is_member(node)) {
            return Ok(Series::constant(tree.clone()));
        }
        self.step(tree)?;
        if let Some((_, exponent, times)) = scale.members.iter().find(|(member, ..)| member == tree) {
            let rest = add(vec![
                exponent.clone(),
                negative(multiply(vec![times.clone(), scale.exponent.clone()])),
            ]);
            let rest = self.series(&rest, scale)?;
            return Ok(self.exponential(&rest)?.shifted(&negative(times.clone()), &integer(1)));
        }
        match tree {
            Tree::Negate(inner) => Ok(self.series(inner, scale)?.scaled(&integer(-1))),
            Tree::Sum(terms) => {
                let mut total = Series::zero();
                for term in terms {
                    let term = self.series(term, scale)?;
                    total = self.plus(&total, &term)?;
                }
                Ok(total)
            }
            Tree::Product(factors) => {
                let mut total = Series::constant(integer(1));
                for factor in factors {
                    let factor = self.series(factor, scale)?;
                    total = self.times(&total, &factor)?;
                }
                Ok(total)
            }
            Tree::Quotient(above, below, _) => {
                let (above, below) = (self.series(above, scale)?, self.series(below, scale)?);
                let inverse = self.raised(&below, &integer(-1))?;
                self.times(&above, &inverse)
            }
            Tree::Power(base, exponent, _) => {
                let base = self.series(base, scale)?;
                self.raised(&base, &integer(i64::from(*exponent)))
            }
            Tree::RealPower(base, exponent, _) => {
                let base = self.series(base, scale)?;
                self.raised(&base, exponent)
            }
            Tree::Call(name, argument, _) => self.of_call(name, argument, scale),
            Tree::Operation(operation, _) => match &**operation {
                // an integral over an interval that shrinks: where it ends, and the integrand there
                Operation::Arguments(parts) => match parts.as_slice() {
                    [end, slope] => {
                        let (end, slope) = (self.series(end, scale)?, self.series(slope, scale)?);
                        self.integrated(integer(0), &end, &slope)
                    }
                    _ => Err("several arguments within a limit".to_owned()),
                },
                _ => Err("an operation within a limit".to_owned()),
            },
            _ => Err(format!("the series of `{tree}`")),
        }
    }

    fn of_call(&mut self, name: &Name, argument: &Tree, scale: &Scale) -> Found<Series> {
        let inner = self.series(argument, scale)?;
        if self.symbols.is_function(name) {
            return self.of_unknown(name, &inner);
        }
        let minus = |k: usize| if k % 4 < 2 { 1 } else { -1 };
        Ok(match name.base.as_str() {
            "\\exp" => self.exponential(&inner)?,
            "\\ln" => self.logarithm(&inner, scale)?,
            "\\sin" | "\\cos" | "\\sinh" | "\\cosh" => {
                let is_hyperbolic = name.base.ends_with('h');
                let names = if is_hyperbolic {
                    ["\\sinh", "\\cosh"]
                } else {
                    ["\\sin", "\\cos"]
                };
                let (first, step) = self.regular(&inner)?;
                let sign = |k: usize| if is_hyperbolic { 1 } else { minus(k) };
                let wave = |odd: usize| {
                    let term = move |k: usize| if k % 2 == odd { integer(sign(k)) } else { integer(0) };
                    move |k: usize| divide(term(k), factorial_of(k))
                };
                let sine = self.composed(&step, &wave(1))?;
                let cosine = self.composed(&step, &wave(0))?;
                let [odd, even] = names.map(|name| value_at(name, first.clone()));
                let is_odd = name.base.starts_with("\\sin");
                let cross = if is_hyperbolic || is_odd { 1 } else { -1 };
                let (with_cosine, with_sine) = if is_odd { (odd, even) } else { (even, odd) };
                let with_sine = multiply(vec![integer(cross), with_sine]);
                self.plus(&cosine.scaled(&with_cosine), &sine.scaled(&with_sine))?
            }
            _ => {
                let slope = Elementary::named(name).and_then(|function| function.derivative(argument));
                let slope = slope.ok_or_else(|| format!("the series of `{name}`"))?;
                let slope = self.series(&as_powers(&slope), scale)?;
                let (first, _) = self.regular(&inner)?;
                self.integrated(value_at(&name.base, first), &inner, &slope)?
            }
        })
    }

    fn exponential(&mut self, series: &Series) -> Found<Series> {
        let (first, step) = self.regular(series)?;
        let whole = self.composed(&step, &|k| divide(integer(1), factorial_of(k)))?;
        let start = match self.moves(&first) {
            true => call("\\exp", first),
            false => exponential_of(first),
        };
        Ok(whole.scaled(&start))
    }

    fn logarithm(&mut self, series: &Series, scale: &Scale) -> Found<Series> {
        let (exponent, first, step) = self.relative(series)?;
        let sign = |k: usize| if k % 2 == 1 { 1 } else { -1 };
        let rest = self.composed(&step, &|k| match i64::try_from(k) {
            Ok(k @ 1..) => ratio(sign(k as usize), k),
            _ => integer(0),
        })?;
        self.is_one_sided |= !is_zero(&exponent);
        let large = negative(multiply(vec![exponent, scale.exponent.clone()]));
        let start = add(vec![value_at("\\ln", first), large]);
        self.plus(&Series::constant(start), &rest)
    }

    /// Returns the series of a power whose exponent does not move.
    fn raised(&mut self, series: &Series, exponent: &Tree) -> Found<Series> {
        let whole = super::integers::whole(exponent);
        if let Some(times) = whole
            .and_then(|whole| usize::try_from(whole).ok())
            .filter(|times| *times <= 40)
        {
            let mut total = Series::constant(integer(1));
            for _ in 0..times {
                total = self.times(&total, series)?;
            }
            return Ok(total);
        }
        let (low, first, step) = self.relative(series)?;
        self.is_one_sided |= whole.is_none() && !is_zero(&low);
        let mut binomials = vec![integer(1)];
        for k in 1..=self.length {
            let k = i64::try_from(k).unwrap_or(i64::MAX);
            let next = multiply(vec![ratio(1, k), add(vec![exponent.clone(), integer(1 - k)])]);
            let before = binomials.last().cloned().unwrap_or_else(|| integer(1));
            binomials.push(multiply(vec![before, next]));
        }
        let whole = self.composed(&step, &|k| binomials.get(k).cloned().unwrap_or_else(|| integer(0)))?;
        let start = power_of(first, exponent);
        Ok(whole.shifted(&multiply(vec![low, exponent.clone()]), &start))
    }

    /// Expands a smooth function that is not known, by its derivatives.
    fn of_unknown(&mut self, name: &Name, inner: &Series) -> Found<Series> {
        if self.given.iter().any(|given| given.bare() == name.bare()) {
            return Err(format!("premises speak of `{name}`: how smooth it is is not known"));
        }
        let (first, step) = self.regular(inner)?;
        let running = self
            .symbols
            .running()
            .ok_or_else(|| format!("`{name}` has no derivatives here"))?;
        let by = By {
            symbols: self.symbols,
            name: running,
        };
        let mut slopes = vec![Tree::Call(name.clone(), Box::new(first), At::default())];
        for _ in 1..self.length {
            let next = slopes.last().map(|slope| by.next(slope)).ok_or("no derivative")??;
            slopes.push(next);
        }
        self.composed(&step, &|k| {
            let slope = slopes.get(k).cloned().unwrap_or_else(|| integer(0));
            multiply(vec![divide(integer(1), factorial_of(k)), slope])
        })
    }

    /// Splits a series into its limit and the rest; what grows must be 0.
    fn regular(&mut self, series: &Series) -> Found<(Tree, Series)> {
        let (mut first, mut rest) = (integer(0), Series::zero());
        rest.end.clone_from(&series.end);
        for (exponent, coefficient) in &series.terms {
            match self.side(exponent)? {
                Ordering::Greater => rest.terms.push((exponent.clone(), coefficient.clone())),
                Ordering::Equal => first = add(vec![first, coefficient.clone()]),
                Ordering::Less if self.is_likely_zero(coefficient) => {
                    self.need(relation(coefficient.clone(), Relation::Equal));
                }
                Ordering::Less => return Err("a function of what grows without bound".to_owned()),
            }
        }
        match &series.end {
            Some(end) if self.side(end)? != Ordering::Greater => Err(SHORT.to_owned()),
            _ => Ok((first, rest)),
        }
    }

    /// Drops the first terms of a series that vanish; the first of the rest does not.
    fn leading(&mut self, series: &Series) -> Found<Series> {
        let mut rest = series.clone();
        while let Some((_, coefficient)) = rest.terms.first().cloned() {
            if !self.is_likely_zero(&coefficient) {
                self.nonzero(&coefficient)?;
                return Ok(rest);
            }
            self.need(relation(coefficient, Relation::Equal));
            rest.terms.remove(0);
        }
        Err(match rest.end {
            Some(_) => SHORT.to_owned(),
            None => "a division by 0, or the sign of 0".to_owned(),
        })
    }

    /// Returns the exponent and the coefficient of the first term, and the rest of the series relative to it.
    fn relative(&mut self, series: &Series) -> Found<(Tree, Tree, Series)> {
        let series = self.leading(series)?;
        let Some((exponent, first)) = series.terms.first().cloned() else {
            return Err("no term is known".to_owned());
        };
        let mut rest = series;
        rest.terms.remove(0);
        let rest = match is_one(&first) {
            true => rest.shifted(&negative(exponent.clone()), &integer(1)),
            false => {
                let mut rest = rest.shifted(&negative(exponent.clone()), &integer(1));
                rest.terms
                    .iter_mut()
                    .for_each(|(_, own)| *own = divide(own.clone(), first.clone()));
                rest
            }
        };
        Ok((exponent, first, rest))
    }

    /// Sums weights times powers of a series that vanishes.
    fn composed(&mut self, step: &Series, weight: &dyn Fn(usize) -> Tree) -> Found<Series> {
        let mut total = Series::constant(weight(0));
        let Some(low) = step.low().cloned() else {
            return Ok(total);
        };
        let mut powers = Series::constant(integer(1));
        for k in 1..self.length {
            powers = self.times(&powers, step)?;
            let term = powers.scaled(&weight(k));
            total = self.plus(&total, &term)?;
        }
        let last = i64::try_from(self.length).unwrap_or(i64::MAX);
        let unknown = Series {
            terms: Vec::new(),
            end: Some(multiply(vec![integer(last), low])),
        };
        self.plus(&total, &unknown)
    }

    /// Returns the series that starts with `first` and whose derivative is that of `inner` times `slope`.
    fn integrated(&mut self, first: Tree, inner: &Series, slope: &Series) -> Found<Series> {
        let mut rates = inner.clone();
        rates.terms.retain(|(exponent, _)| !is_zero(exponent));
        rates
            .terms
            .iter_mut()
            .for_each(|(exponent, own)| *own = multiply(vec![exponent.clone(), own.clone()]));
        let mut rest = self.times(&rates, slope)?;
        for (exponent, own) in &mut rest.terms {
            if self.side(exponent)? != Ordering::Greater {
                return Err("a function where it is not continuous".to_owned());
            }
            *own = multiply(vec![divide(integer(1), exponent.clone()), own.clone()]);
        }
        match &rest.end {
            Some(end) if self.side(end)? != Ordering::Greater => Err(SHORT.to_owned()),
            _ => self.plus(&Series::constant(first), &rest),
        }
    }

    fn plus(&mut self, one: &Series, other: &Series) -> Found<Series> {
        let end = self.least(one.end.as_ref(), other.end.as_ref())?;
        self.gathered(one.terms.iter().chain(&other.terms).cloned().collect(), end)
    }

    fn times(&mut self, one: &Series, other: &Series) -> Found<Series> {
        let up = |end: &Option<Tree>, low: Option<&Tree>| Some(add(vec![end.clone()?, low?.clone()]));
        let ends = [up(&one.end, other.low()), up(&other.end, one.low())];
        let end = self.least(ends[0].as_ref(), ends[1].as_ref())?;
        let pairs = one.terms.iter().flat_map(|(e, a)| {
            let product =
                move |(f, b): &(Tree, Tree)| (add(vec![e.clone(), f.clone()]), multiply(vec![a.clone(), b.clone()]));
            other.terms.iter().map(product)
        });
        self.gathered(pairs.collect(), end)
    }

    fn least(&mut self, one: Option<&Tree>, other: Option<&Tree>) -> Found<Option<Tree>> {
        Ok(match (one, other) {
            (Some(one), Some(other)) => match self.compare(one, other)? {
                Ordering::Greater => Some(other.clone()),
                _ => Some(one.clone()),
            },
            (one, other) => one.or(other).cloned(),
        })
    }

    /// Returns the series with these terms in order, equal powers as one, and none from the end on.
    fn gathered(&mut self, terms: Vec<(Tree, Tree)>, mut end: Option<Tree>) -> Found<Series> {
        let mut all: Vec<(Tree, Vec<Tree>)> = Vec::new();
        for (exponent, coefficient) in terms {
            if let Some(end) = &end
                && self.compare(&exponent, end)? != Ordering::Less
            {
                continue;
            }
            let mut place = 0;
            let mut is_known = false;
            while let Some((known, own)) = all.get_mut(place) {
                let known = known.clone();
                match self.compare(&known, &exponent)? {
                    Ordering::Less => place += 1,
                    Ordering::Equal => {
                        own.push(coefficient.clone());
                        is_known = true;
                        break;
                    }
                    Ordering::Greater => break,
                }
            }
            if !is_known {
                all.insert(place, (exponent, vec![coefficient]));
            }
        }
        let mut all: Vec<(Tree, Tree)> = all.into_iter().map(|(exponent, own)| (exponent, add(own))).collect();
        all.retain(|(_, own)| !is_zero(own));
        if all.len() > self.length {
            end = all.get(self.length).map(|(exponent, _)| exponent.clone());
            all.truncate(self.length);
        }
        Ok(Series { terms: all, end })
    }
}

/// The reason where more terms of a series may tell.
pub(super) const SHORT: &str = "a series that is not followed far enough";

fn factorial_of(k: usize) -> Tree {
    let factors = (1..=i64::try_from(k).unwrap_or(0)).map(Rational::from_integer);
    Tree::Number(factors.fold(Rational::from_integer(1), |total, k| total * k))
}

/// Returns the tree with roots as powers.
fn as_powers(tree: &Tree) -> Tree {
    let up = |node: &Tree| match node {
        Tree::Root(radicand, index, _) => Some(real_power(as_powers(radicand), ratio(1, i64::from(*index)))),
        _ => None,
    };
    mapped(tree, &up)
}

#[cfg(test)]
mod tests {
    use super::super::build::plain;
    use super::super::limit::of_limit;
    use super::*;
    use crate::premise::Statements;
    use texmath::{Names, read_expression};

    /// The limit of a function of x, which grows, with the conditions that it needs.
    fn limit(tex: &str) -> Result<(Option<End>, usize), String> {
        let mut symbols = Symbols::default();
        for name in ["x", "a"] {
            symbols.let_be_parameter(&plain(name), false);
        }
        let names = Names {
            letters: vec!["x".to_owned(), "a".to_owned()],
            ..Names::default()
        };
        let of = read_expression(tex, &names).map_err(|fault| fault.to_string())?;
        let infinity = Tree::Operation(Box::new(Operation::Infinity), At::default());
        let found = of_limit(&Statements::default(), &symbols, &of, &plain("x"), &infinity, &[])?;
        Ok((found.end, found.lemmas.len()))
    }

    #[test]
    fn orders_of_growth_are_compared() {
        let zero = || Some(End::finite(integer(0)));
        for (tex, wanted) in [
            (r"x^9 e^{-x}", zero()),
            (r"\frac{\ln x}{x}", zero()),
            (r"\frac{x^x}{e^{x^2}}", zero()),
            (r"\frac{e^{x + e^{-x}}}{e^x}", Some(End::finite(integer(1)))),
            (r"e^x (e^{1/x - e^{-x}} - e^{1/x})", Some(End::finite(integer(-1)))),
            (r"\frac{e^x}{x^9}", Some(End::Infinite(true))),
            (r"-\ln \ln x", Some(End::Infinite(false))),
        ] {
            assert_eq!(limit(tex), Ok((wanted, 0)), "{tex}");
        }
    }

    #[test]
    fn signs_of_letters_are_conditions() {
        for tex in [r"e^{-a x}", r"x^{-a}"] {
            let is_right = |(end, lemmas)| end == Some(End::finite(integer(0))) && lemmas > 0;
            assert!(limit(tex).is_ok_and(is_right), "{tex}");
        }
    }

    #[test]
    fn what_oscillates_has_a_limit_only_where_it_has_no_effect() {
        assert_eq!(limit(r"\frac{\sin x}{x}"), Ok((Some(End::finite(integer(0))), 0)));
        assert_eq!(limit(r"\sin x").map(|(end, _)| end), Ok(None));
        assert!(limit(r"\sin(x)^2").is_ok_and(|(end, lemmas)| end.is_none() && lemmas == 1));
        assert!(limit(r"\sin(x)^2 + \cos(x)^2").is_err());
        assert!(limit(r"\ln(5 - x) e^{-x}").is_err());
    }
}
