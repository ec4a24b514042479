//! Power series in one small quantity, by the recurrences of their coefficients (Knuth, The Art of Computer Programming,
//! volume 2, section 4.7): what limits and orders are decided by.
//!
//! A series holds where what it needs does: each division, logarithm and root says so.

use super::build::{call, infinity, integer, negative, power, product, quotient, real_power, root, sum, symbol};
use super::derivative::{By, mentions};
use super::factorial;
use numbers::{Field, Rational};
use texmath::{At, Elementary, Equation, Name, Operation, Parity, Relation, Symbols, Tree, any, mapped, number_of};

/// The sum of `terms[k] h^(low + k)`, and what follows is not known.
#[derive(Clone, Debug)]
pub(super) struct Series {
    pub low: i32,
    pub terms: Vec<Tree>,
}

/// Series in a quantity h that tends to 0.
pub(super) struct Small<'a> {
    pub symbols: &'a Symbols,
    /// Functions of which premises speak: how smooth these are is not known.
    pub given: Vec<Name>,
    /// What moves, and its series.
    pub name: &'a Name,
    pub value: Series,
    /// Whether h is positive.
    pub is_positive: bool,
    /// The number of terms.
    pub length: usize,
    /// What must hold for the series to be right.
    pub needed: Vec<Equation>,
    /// What does not move and must have a value, also where it meets a 0.
    pub written: Vec<Tree>,
}

type Found = Result<Series, String>;

/// The tree, a number where it is written with numbers.
fn tidy(tree: Tree) -> Tree {
    match number_of(&tree) {
        Some(value) => number(&value),
        None => tree,
    }
}

fn number(value: &Rational) -> Tree {
    let zero = Rational::from_integer(0);
    match *value < zero {
        true => Tree::Negate(Box::new(Tree::Number(zero - value.clone()))),
        false => Tree::Number(value.clone()),
    }
}

fn add(terms: Vec<Tree>) -> Tree {
    tidy(sum(terms))
}

fn multiply(factors: Vec<Tree>) -> Tree {
    tidy(product(factors))
}

fn divide(above: Tree, below: Tree) -> Tree {
    tidy(quotient(above, below))
}

fn ratio(above: i64, below: i64) -> Tree {
    number(&(Rational::from_integer(above) / Rational::from_integer(below)))
}

pub(super) fn is_zero(tree: &Tree) -> bool {
    number_of(tree) == Some(Rational::from_integer(0))
}

/// A value at a point of no meaning, to tell what may vanish: nothing rests on it.
fn guess(tree: &Tree) -> Option<f64> {
    guess_at(tree, &|name| Some(seed(name)))
}

/// A number for a name, the same at each time.
pub(super) fn seed(name: &Name) -> f64 {
    hashed(&name.to_string())
}

fn hashed(text: &str) -> f64 {
    let hash = text.bytes().fold(2_166_136_261_u32, |hash, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(16_777_619)
    });
    0.4 + f64::from(hash % 1009) / 1009.0
}

/// A value where symbols have values, to tell what is worth a proof: nothing rests on it.
pub(super) fn guess_at(tree: &Tree, of: &dyn Fn(&Name) -> Option<f64>) -> Option<f64> {
    let value = |tree: &Tree| guess_at(tree, of);
    let all = |trees: &[Tree]| trees.iter().map(value).collect::<Option<Vec<f64>>>();
    Some(match tree {
        Tree::Number(number) => number.0.to_f64().value(),
        Tree::Symbol(name, _) => match name.base.as_str() {
            "\\pi" => std::f64::consts::PI,
            "e" => std::f64::consts::E,
            _ => of(name)?,
        },
        Tree::Negate(inner) => -value(inner)?,
        Tree::Sum(terms) => all(terms)?.into_iter().sum(),
        Tree::Product(factors) => all(factors)?.into_iter().product(),
        Tree::Quotient(above, below, _) => value(above)? / value(below)?,
        Tree::Power(base, exponent, _) => value(base)?.powi(*exponent),
        Tree::RealPower(base, exponent, _) => value(base)?.powf(value(exponent)?),
        Tree::Root(radicand, index, _) => value(radicand)?.powf(1.0 / f64::from(*index)),
        Tree::Call(name, argument, _) => {
            let at = value(argument)?;
            match Elementary::named(name) {
                Some(function) => (function.real)(at),
                None => hashed(&format!("{name} {at:.9}")),
            }
        }
        _ => return None,
    })
}

/// Whether a tree is likely to be 0.
pub(super) fn is_likely_zero(tree: &Tree) -> bool {
    is_zero(tree) || guess(tree).is_some_and(|value| value.abs() < 1e-9)
}

pub(super) fn relation(left: Tree, relation: Relation) -> Equation {
    Equation {
        relation,
        ..Equation::between(left, integer(0))
    }
}

/// Whether both sides are numbers of which the relation holds.
fn holds_of_numbers(condition: &Equation) -> bool {
    let (Tree::Number(left), Tree::Number(right)) = (&condition.left, &condition.right) else {
        return false;
    };
    match condition.relation {
        Relation::Equal => left == right,
        Relation::NotEqual => left != right,
        Relation::Less => left < right,
        Relation::LessOrEqual => left <= right,
        Relation::Greater => left > right,
        Relation::GreaterOrEqual => left >= right,
    }
}

impl Series {
    pub fn constant(tree: Tree, length: usize) -> Self {
        let rest = std::iter::repeat_n(integer(0), length.saturating_sub(1));
        Self {
            low: 0,
            terms: std::iter::once(tree).chain(rest).collect(),
        }
    }

    /// `h` to a power.
    pub fn small(low: i32, length: usize) -> Self {
        Self {
            low,
            ..Self::constant(integer(1), length)
        }
    }

    fn end(&self) -> i32 {
        self.low
            .saturating_add(i32::try_from(self.terms.len()).unwrap_or(i32::MAX))
    }

    /// The coefficient of a power of h; 0 below the first.
    pub fn at(&self, exponent: i32) -> Option<Tree> {
        match usize::try_from(exponent - self.low) {
            Ok(place) => self.terms.get(place).cloned(),
            Err(_) => Some(integer(0)),
        }
    }

    /// Whether a power of 1/h stands in it.
    fn grows(&self) -> bool {
        let before = usize::try_from(-self.low).unwrap_or(0);
        self.terms.iter().take(before).any(|term| !is_zero(term))
    }

    fn plus(&self, other: &Self) -> Self {
        let (low, end) = (self.low.min(other.low), self.end().min(other.end()));
        let term = |exponent| {
            let terms = [self.at(exponent), other.at(exponent)];
            add(terms.into_iter().flatten().collect())
        };
        Self {
            low,
            terms: (low..end).map(term).collect(),
        }
    }

    fn times(&self, other: &Self) -> Self {
        let length = self.terms.len().min(other.terms.len());
        let term = |k: usize| {
            let products = (0..=k).filter_map(|j| {
                let (a, b) = (self.terms.get(j)?, other.terms.get(k - j)?);
                (!is_zero(a) && !is_zero(b)).then(|| multiply(vec![a.clone(), b.clone()]))
            });
            add(products.collect())
        };
        Self {
            low: self.low.saturating_add(other.low),
            terms: (0..length).map(term).collect(),
        }
    }

    pub fn scaled(&self, factor: &Tree) -> Self {
        let terms = self.terms.iter();
        Self {
            low: self.low,
            terms: terms.map(|term| multiply(vec![factor.clone(), term.clone()])).collect(),
        }
    }
}

impl Small<'_> {
    pub(super) fn need(&mut self, condition: Equation) {
        if !holds_of_numbers(&condition) && !self.needed.contains(&condition) {
            self.needed.push(condition);
        }
    }

    /// The series from h^0 on; what it has before that must vanish.
    fn regular(&mut self, series: &Series) -> Found {
        for exponent in series.low..0 {
            match series.at(exponent) {
                Some(term) if is_zero(&term) => {}
                Some(term) if is_likely_zero(&term) => self.need(relation(term, Relation::Equal)),
                _ => return Err("a function of what grows without bound".to_owned()),
            }
        }
        let end = series.end().min(i32::try_from(self.length).unwrap_or(i32::MAX));
        Ok(Series {
            low: 0,
            terms: (0..end).filter_map(|exponent| series.at(exponent)).collect(),
        })
    }

    /// The series without the first terms that vanish; the first of the rest does not.
    fn leading(&mut self, series: &Series) -> Found {
        let first = series.terms.iter().position(|term| !is_likely_zero(term));
        let first = first.ok_or("what is divided by vanishes, as far as it is followed")?;
        for term in series.terms.iter().take(first).filter(|term| !is_zero(term)) {
            self.need(relation(term.clone(), Relation::Equal));
        }
        let terms: Vec<Tree> = series.terms.iter().skip(first).cloned().collect();
        if let Some(term) = terms.first() {
            self.need(relation(term.clone(), Relation::NotEqual));
        }
        Ok(Series {
            low: series.low.saturating_add(i32::try_from(first).unwrap_or(i32::MAX)),
            terms,
        })
    }

    /// The series without the first terms that vanish, and whether it is negative where h is small.
    fn with_sign(&mut self, series: &Series) -> Result<(Series, bool), String> {
        let series = self.leading(series)?;
        let Some(first) = series.terms.first().cloned() else {
            return Err("no term is known".to_owned());
        };
        if series.low != 0 && !self.is_positive {
            return Err("the sign of what vanishes or grows".to_owned());
        }
        let is_negative = guess(&first).is_some_and(|value| value < 0.0);
        let sign = if is_negative { Relation::Less } else { Relation::Greater };
        self.need(relation(first, sign));
        Ok((series, is_negative))
    }

    fn inverse(&mut self, series: &Series) -> Found {
        let series = self.leading(series)?;
        let Some((first, rest)) = series.terms.split_first() else {
            return Err("no term is known".to_owned());
        };
        let mut terms: Vec<Tree> = vec![divide(integer(1), first.clone())];
        for k in 1..series.terms.len() {
            let products = rest.iter().take(k).enumerate().filter_map(|(j, b)| {
                let q = terms.get(k - 1 - j)?;
                (!is_zero(b)).then(|| multiply(vec![b.clone(), q.clone()]))
            });
            terms.push(tidy(negative(divide(add(products.collect()), first.clone()))));
        }
        Ok(Series {
            low: -series.low,
            terms,
        })
    }

    /// The series whose derivative is that of `inner` times `outer`, and that starts with `first`.
    fn integrated(first: Tree, inner: &Series, outer: &Series) -> Series {
        let mut terms = vec![first];
        for k in 1..inner.terms.len().min(outer.terms.len()) {
            let products = (1..=k).filter_map(|j| {
                let (u, w) = (inner.terms.get(j)?, outer.terms.get(k - j)?);
                let weight = ratio(i64::try_from(j).ok()?, i64::try_from(k).ok()?);
                (!is_zero(u)).then(|| multiply(vec![weight, u.clone(), w.clone()]))
            });
            terms.push(add(products.collect()));
        }
        Series { low: 0, terms }
    }

    fn exponential(&mut self, series: &Series) -> Found {
        let series = self.regular(series)?;
        let Some(first) = series.terms.first() else {
            return Err("no term is known".to_owned());
        };
        let first = match is_zero(first) {
            true => integer(1),
            false => real_power(symbol(&super::build::plain("e")), first.clone()),
        };
        let mut whole = Series {
            low: 0,
            terms: vec![first],
        };
        for k in 1..series.terms.len() {
            whole.terms.push(integer(0));
            let next = Self::integrated(integer(0), &series, &whole);
            if let (Some(place), Some(term)) = (whole.terms.get_mut(k), next.terms.get(k)) {
                *place = term.clone();
            }
        }
        Ok(whole)
    }

    /// Sine and cosine, or the hyperbolic ones.
    fn waves(&mut self, series: &Series, is_hyperbolic: bool) -> Result<(Series, Series), String> {
        let series = self.regular(series)?;
        let Some(first) = series.terms.first() else {
            return Err("no term is known".to_owned());
        };
        let names = if is_hyperbolic {
            ["\\sinh", "\\cosh"]
        } else {
            ["\\sin", "\\cos"]
        };
        let at = |name: &str, at_zero: i64| match is_zero(first) {
            true => integer(at_zero),
            false => call(name, first.clone()),
        };
        let (mut odd, mut even) = (vec![at(names[0], 0)], vec![at(names[1], 1)]);
        for k in 1..series.terms.len() {
            let term = |other: &Vec<Tree>| {
                let products = (1..=k).filter_map(|j| {
                    let (u, w) = (series.terms.get(j)?, other.get(k - j)?);
                    let weight = ratio(i64::try_from(j).ok()?, i64::try_from(k).ok()?);
                    (!is_zero(u)).then(|| multiply(vec![weight, u.clone(), w.clone()]))
                });
                add(products.collect())
            };
            let (next_odd, next_even) = (term(&even), term(&odd));
            odd.push(next_odd);
            even.push(if is_hyperbolic {
                next_even
            } else {
                tidy(negative(next_even))
            });
        }
        let series = |terms| Series { low: 0, terms };
        Ok((series(odd), series(even)))
    }

    fn logarithm(&mut self, series: &Series) -> Found {
        let series = self.regular(series)?;
        let Some(first) = series.terms.first().cloned() else {
            return Err("no term is known".to_owned());
        };
        self.need(relation(first.clone(), Relation::Greater));
        let inverse = self.inverse(&series)?;
        let first = match number_of(&first) == Some(Rational::from_integer(1)) {
            true => integer(0),
            false => call("\\ln", first),
        };
        Ok(Self::integrated(first, &series, &inverse))
    }

    /// A power whose exponent does not move.
    fn raised(&mut self, series: &Series, exponent: &Tree) -> Found {
        let whole = super::integers::whole(exponent);
        if let Some(times) = whole.and_then(|whole| usize::try_from(whole).ok())
            && times <= 40
        {
            let mut total = Series::constant(integer(1), self.length);
            for _ in 0..times {
                total = total.times(series);
            }
            return Ok(total);
        }
        let series = self.leading(series)?;
        let scaled = number_of(exponent).map(|exponent| exponent * Rational::from_integer(i64::from(series.low)));
        let low = match (series.low, scaled.and_then(|scaled| scaled.to_integer())) {
            (0, _) => 0,
            (_, Some(low)) if whole.is_some() || self.is_positive => {
                i32::try_from(low).map_err(|_| "so high a power".to_owned())?
            }
            _ => return Err("a root or power of what vanishes".to_owned()),
        };
        let Some(first) = series.terms.first().cloned() else {
            return Err("no term is known".to_owned());
        };
        let is_whole = whole.is_some() || factorial::is_integer(exponent, self.symbols);
        self.need(relation(
            first.clone(),
            if is_whole {
                Relation::NotEqual
            } else {
                Relation::Greater
            },
        ));
        let start = match number_of(&first) == Some(Rational::from_integer(1)) {
            true => integer(1),
            false => power_of(first.clone(), exponent),
        };
        let mut terms = vec![start];
        for k in 1..series.terms.len() {
            let products = (1..=k).filter_map(|j| {
                let (u, p) = (series.terms.get(j)?, terms.get(k - j)?);
                let (j, k) = (i64::try_from(j).ok()?, i64::try_from(k).ok()?);
                // (j (exponent + 1) - k)/k
                let weight = add(vec![multiply(vec![ratio(j, k), exponent.clone()]), ratio(j - k, k)]);
                (!is_zero(u)).then(|| multiply(vec![weight, u.clone(), p.clone()]))
            });
            terms.push(divide(add(products.collect()), first.clone()));
        }
        Ok(Series { low, terms })
    }

    /// The series of a tree.
    pub fn of(&mut self, tree: &Tree) -> Found {
        let symbols = self.symbols;
        let is_conjugate =
            |node: &Tree| matches!(node, Tree::Symbol(name, _) if symbols.is_conjugate_of(name, self.name));
        if any(tree, &mut |node| is_conjugate(node)) {
            return Err("a conjugate in a series".to_owned());
        }
        if !mentions(tree, self.name) && !any(tree, &mut |node| factorial::is_one(node)) {
            if super::evaluate::may_be_undefined(tree) && !self.written.contains(tree) {
                self.written.push(tree.clone());
            }
            return Ok(Series::constant(tidy(tree.clone()), self.length));
        }
        if self.vanishes_fast(tree) {
            return Ok(Series::constant(integer(0), self.length));
        }
        match tree {
            Tree::Symbol(name, _) if name == self.name => Ok(self.value.clone()),
            Tree::Negate(inner) => Ok(self.of(inner)?.scaled(&integer(-1))),
            Tree::Sum(terms) => {
                let mut total: Option<Series> = None;
                for term in terms {
                    let term = self.of(term)?;
                    total = Some(total.map_or_else(|| term.clone(), |total| total.plus(&term)));
                }
                total.ok_or_else(|| "an empty sum".to_owned())
            }
            Tree::Product(factors) => {
                let mut total = Series::constant(integer(1), self.length);
                for factor in factors {
                    total = total.times(&self.of(factor)?);
                }
                Ok(total)
            }
            Tree::Quotient(above, below, _) => {
                let below = self.of(below)?;
                let below = self.inverse(&below)?;
                Ok(self.of(above)?.times(&below))
            }
            Tree::Power(base, exponent, _) => {
                let base = self.of(base)?;
                self.raised(&base, &integer(i64::from(*exponent)))
            }
            Tree::Root(radicand, index, _) => {
                let radicand = self.of(radicand)?;
                self.raised(&radicand, &ratio(1, i64::from(*index)))
            }
            Tree::RealPower(base, exponent, _) => {
                if !mentions(exponent, self.name) {
                    let base = self.of(base)?;
                    return self.raised(&base, exponent);
                }
                let euler = super::build::plain("e");
                let is_euler = matches!(&**base, Tree::Symbol(name, _) if *name == euler);
                let exponent = self.of(exponent)?;
                if is_euler && !self.symbols.declares(&euler) {
                    return self.exponential(&exponent);
                }
                let base = self.of(base)?;
                let logarithm = self.logarithm(&base)?;
                self.exponential(&exponent.times(&logarithm))
            }
            Tree::Call(name, argument, _) => self.of_call(name, argument),
            Tree::Operation(operation, _) => match &**operation {
                Operation::Integral {
                    of,
                    by,
                    limits: Some((low, high)),
                } if !mentions(of, self.name) => self.of_integral(of, by, low, high),
                Operation::Series {
                    kind: texmath::Series::Sum,
                    of,
                    index,
                    from,
                    to,
                } => self.of_sum(of, index, from, to),
                _ => Err("an operation within a limit".to_owned()),
            },
            _ => Err(format!("the series of `{tree}`")),
        }
    }

    /// A sum of known length.
    fn of_sum(&mut self, of: &Tree, index: &Name, from: &Tree, to: &Tree) -> Found {
        let (Some(from), Some(to)) = (super::integers::whole(from), super::integers::whole(to)) else {
            return Err("a sum of unknown length within a limit".to_owned());
        };
        let mut total = Series::constant(integer(0), self.length);
        for value in from..=to.min(from.saturating_add(100)) {
            let term = with_factorials(&super::evaluate::at_index(of, index, value));
            total = total.plus(&self.of(&term)?);
        }
        match to.saturating_sub(from) > 100 {
            true => Err("so long a sum within a limit".to_owned()),
            false => Ok(total),
        }
    }

    fn of_call(&mut self, name: &Name, argument: &Tree) -> Found {
        let is_complex = self.symbols.speaks_of_complex(argument);
        if is_complex && !Elementary::named(name).is_some_and(|function| function.is_analytic) {
            return Err(format!("{name} of a complex number in a series"));
        }
        let inner = self.of(argument)?;
        if self.symbols.is_function(name) {
            return self.of_unknown(name, &inner);
        }
        let length = self.length;
        let one = || Series::constant(integer(1), length);
        if let Some((above, below)) = Elementary::named(name).and_then(Elementary::quotient) {
            let (sine, cosine) = self.waves(&inner, [r"\sinh", r"\cosh"].contains(&below.command))?;
            let of = |function: &Elementary| {
                if function.parity == Some(Parity::Odd) {
                    &sine
                } else {
                    &cosine
                }
            };
            let inverse = self.inverse(of(below))?;
            return Ok(above.map_or_else(one, |above| of(above).clone()).times(&inverse));
        }
        let square = inner.times(&inner);
        let first = inner.at(0).unwrap_or_else(|| integer(0));
        let start = |function: &str| match is_zero(&first) {
            true => integer(0),
            false => call(function, first.clone()),
        };
        let minus_half = ratio(-1, 2);
        let (slope, start) = match name.base.as_str() {
            "\\exp" => return self.exponential(&inner),
            "\\ln" | "\\log" => return self.logarithm(&inner),
            "\\sin" => return Ok(self.waves(&inner, false)?.0),
            "\\cos" => return Ok(self.waves(&inner, false)?.1),
            "\\sinh" => return Ok(self.waves(&inner, true)?.0),
            "\\cosh" => return Ok(self.waves(&inner, true)?.1),
            "\\abs" => {
                let (inner, is_negative) = self.with_sign(&inner)?;
                return Ok(if is_negative { inner.scaled(&integer(-1)) } else { inner });
            }
            "\\arctan" if inner.grows() => {
                // for u > 0 it is a quarter turn less that of 1/u
                let (inner, is_negative) = self.with_sign(&inner)?;
                let quarter = quotient(symbol(&super::build::plain("\\pi")), integer(2));
                let limit = if is_negative { negative(quarter) } else { quarter };
                let inverse = self.inverse(&inner)?;
                let inverse = self.regular(&inverse)?;
                let slope = self.inverse(&one().plus(&inverse.times(&inverse)))?;
                let rest = Self::integrated(integer(0), &inverse, &slope);
                return Ok(Series::constant(limit, length).plus(&rest.scaled(&integer(-1))));
            }
            "\\arctan" => {
                let below = one().plus(&square);
                (self.inverse(&below)?, start("\\arctan"))
            }
            "\\artanh" => {
                let below = one().plus(&square.scaled(&integer(-1)));
                self.need(relation(below.at(0).unwrap_or_else(|| integer(0)), Relation::Greater));
                (self.inverse(&below)?, start("\\artanh"))
            }
            "\\arcsin" => {
                let below = one().plus(&square.scaled(&integer(-1)));
                (self.raised(&below, &minus_half)?, start("\\arcsin"))
            }
            "\\arsinh" => {
                let below = one().plus(&square);
                (self.raised(&below, &minus_half)?, start("\\arsinh"))
            }
            "\\arccos" => {
                let below = one().plus(&square.scaled(&integer(-1)));
                let slope = self.raised(&below, &minus_half)?.scaled(&integer(-1));
                (slope, call("\\arccos", first.clone()))
            }
            _ => return Err(format!("the series of `{name}`")),
        };
        let inner = self.regular(&inner)?;
        Ok(Self::integrated(start, &inner, &slope))
    }

    /// A smooth function that is not known, by its derivatives.
    fn of_unknown(&mut self, name: &Name, inner: &Series) -> Found {
        let inner = self.regular(inner)?;
        let (first, mut step) = (inner.at(0).unwrap_or_else(|| integer(0)), inner.clone());
        if let Some(term) = step.terms.first_mut() {
            *term = integer(0);
        }
        let mut slope = Tree::Call(name.clone(), Box::new(first), At::default());
        let mut total = Series::constant(slope.clone(), self.length);
        let mut powers = Series::constant(integer(1), self.length);
        let mut factorial = 1_i64;
        if self.given.iter().any(|given| given.bare() == name.bare()) {
            return Err(format!("premises speak of `{name}`: how smooth it is is not known"));
        }
        let Some(running) = self.symbols.running() else {
            return Err(format!("`{name}` has no derivatives here"));
        };
        for k in 1..self.length {
            let by = By {
                symbols: self.symbols,
                name: running,
            };
            slope = by.next(&slope)?;
            factorial = factorial.saturating_mul(i64::try_from(k).unwrap_or(i64::MAX));
            powers = powers.times(&step);
            total = total.plus(&powers.scaled(&multiply(vec![ratio(1, factorial), slope.clone()])));
        }
        Ok(total)
    }

    /// An integral over an interval that shrinks to a point.
    fn of_integral(&mut self, of: &Tree, by: &Name, low: &Tree, high: &Tree) -> Found {
        if [low, high].into_iter().any(|limit| infinity(limit).is_some()) {
            return Err("an improper integral within a limit".to_owned());
        }
        let (low, high) = (self.of(low)?, self.of(high)?);
        let (low, high) = (self.regular(&low)?, self.regular(&high)?);
        let (start, end) = (low.at(0), high.at(0));
        let (Some(start), true) = (start.clone(), start == end) else {
            return Err("an integral over an interval that does not shrink".to_owned());
        };
        let mut inner = Small {
            symbols: self.symbols,
            given: self.given.clone(),
            name: by,
            value: Series {
                low: 0,
                terms: Series::constant(start.clone(), 1)
                    .terms
                    .into_iter()
                    .chain(Series::constant(integer(1), self.length.saturating_sub(1)).terms)
                    .collect(),
            },
            is_positive: false,
            length: self.length,
            needed: Vec::new(),
            written: Vec::new(),
        };
        let integrand = inner.of(of)?;
        let integrand = inner.regular(&integrand)?;
        self.written.append(&mut inner.written);
        let needed = std::mem::take(&mut inner.needed);
        needed.into_iter().for_each(|condition| self.need(condition));
        let at = |limit: &Series| {
            let mut step = limit.clone();
            if let Some(term) = step.terms.first_mut() {
                *term = integer(0);
            }
            let mut powers = step.clone();
            let mut total = Series::constant(integer(0), self.length);
            for (k, term) in integrand.terms.iter().enumerate() {
                let weight = ratio(1, i64::try_from(k).unwrap_or(0) + 1);
                total = total.plus(&powers.scaled(&multiply(vec![weight, term.clone()])));
                powers = powers.times(&step);
            }
            total
        };
        Ok(at(&high).plus(&at(&low).scaled(&integer(-1))))
    }
}

/// `first` to a power that is a number or a tree.
fn power_of(first: Tree, exponent: &Tree) -> Tree {
    let half = number_of(exponent);
    match super::integers::whole(exponent).and_then(|whole| i32::try_from(whole).ok()) {
        Some(whole) if whole >= 0 => power(first, whole),
        Some(whole) => quotient(integer(1), power(first, -whole)),
        None if half == Some(Rational::from_ratio(1, 2)) => root(first),
        None if half == number_of(&ratio(-1, 2)) => quotient(integer(1), root(first)),
        None => real_power(first, exponent.clone()),
    }
}

/// The tree with sums of known length written out.
pub(super) fn with_factorials(tree: &Tree) -> Tree {
    mapped(tree, &|node| match node {
        Tree::Call(name, argument, _) => factorial::of_number(name, argument).and_then(Result::ok),
        _ => None,
    })
}
