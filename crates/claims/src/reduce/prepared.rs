//! Preparation of a function for its limit: powers of e in place of moving powers, and conditions under which it has a value.

use super::build::{
    call, difference, integer, is_zero, negative, plain, power, product, quotient, real_power, sum, symbol,
};
use super::evaluate::{at_index, may_be_undefined};
use super::factorial;
use super::germ::{End, Germs, Wave};
use super::series::{is_one, ratio, tidy};
use texmath::{At, Elementary, Equation, Name, Operation, Series, Tree, any, mapped, rewrite};

type Found = Result<Tree, String>;

/// The most terms of a sum that is written out.
const MOST_TERMS: i64 = 100;

impl Germs<'_> {
    /// Returns the tree with moving powers as powers of e, with letters for what oscillates, and without bars and roots. It has a
    /// value where the letter is large, if what is needed holds.
    pub fn prepared(&mut self, tree: &Tree) -> Found {
        if !self.moves(tree) {
            if any(tree, &mut |node| factorial::is_one(node)) {
                return Err(format!("the series of `{tree}`"));
            }
            self.write(tree);
            return Ok(tidy(tree.clone()));
        }
        match tree {
            Tree::Symbol(..) => Ok(tree.clone()),
            Tree::Negate(inner) => Ok(negative(self.prepared(inner)?)),
            Tree::Sum(parts) => Ok(sum(self.all(parts)?)),
            Tree::Product(parts) => Ok(with_one_exponential(product(self.all(parts)?), None)),
            Tree::Quotient(above, below, _) if !self.moves(below) => {
                let factor = quotient(integer(1), (**below).clone());
                self.write(&factor);
                Ok(product(vec![factor, self.prepared(above)?]))
            }
            Tree::Quotient(above, below, _) => {
                let (above, below) = (self.prepared(above)?, self.prepared(below)?);
                self.nonzero(&below)?;
                Ok(with_one_exponential(above, Some(below)))
            }
            Tree::Power(base, exponent, _) => {
                let base = self.prepared(base)?;
                if *exponent < 0 {
                    self.nonzero(&base)?;
                }
                Ok(power(base, *exponent))
            }
            Tree::Root(radicand, index, _) => {
                let radicand = self.prepared(radicand)?;
                let is_positive = self.sign(&radicand)?;
                let of = |radicand| real_power(radicand, ratio(1, i64::from(*index)));
                match is_positive {
                    true => Ok(of(radicand)),
                    false if index % 2 == 1 => Ok(negative(of(negative(radicand)))),
                    false => Err("an even root of what is negative".to_owned()),
                }
            }
            Tree::RealPower(base, exponent, _) => self.prepared_power(base, exponent),
            Tree::Call(name, argument, _) => self.prepared_call(name, argument),
            Tree::Operation(operation, _) => self.prepared_operation(operation),
            _ => Err(format!("the series of `{tree}`")),
        }
    }

    fn all(&mut self, parts: &[Tree]) -> Result<Vec<Tree>, String> {
        parts.iter().map(|part| self.prepared(part)).collect()
    }

    /// Records what does not move and may have no value.
    fn write(&mut self, tree: &Tree) {
        if may_be_undefined(tree) && !self.written.contains(tree) {
            self.written.push(tree.clone());
        }
    }

    fn positive(&mut self, tree: &Tree) -> Result<(), String> {
        match self.sign(tree)? {
            true => Ok(()),
            false => Err("a logarithm or a power of what is negative".to_owned()),
        }
    }

    fn prepared_power(&mut self, base: &Tree, exponent: &Tree) -> Found {
        let euler = plain("e");
        let is_euler = matches!(base, Tree::Symbol(name, _) if *name == euler) && !self.symbols.declares(&euler);
        let is_whole = factorial::is_integer(&self.at_integers(exponent), self.symbols);
        if !self.moves(exponent) {
            let (base, exponent) = (self.prepared(base)?, self.prepared(exponent)?);
            match is_whole {
                true => self.nonzero(&base)?,
                false => self.positive(&base)?,
            }
            return Ok(real_power(base, exponent));
        }
        let exponent = self.prepared(exponent)?;
        if is_euler {
            return Ok(call("\\exp", exponent));
        }
        let base = self.prepared(base)?;
        // far out the exponent is positive
        if is_zero(&base) && is_whole && matches!(self.limit(&exponent)?, End::Infinite(true)) {
            return Ok(base);
        }
        let grown = |base: Tree| call("\\exp", product(vec![exponent.clone(), call("\\ln", base)]));
        // |a^n| is at most (1 + |a|)^n
        let is_unsigned = matches!(&base, Tree::Symbol(name, _) if self.unsigned.contains(name));
        if is_unsigned && is_whole && matches!(self.limit(&exponent)?, End::Infinite(true)) {
            let share = self.wave(real_power(base.clone(), exponent.clone()), None)?;
            return Ok(product(vec![share, grown(sum(vec![integer(1), call("\\abs", base)]))]));
        }
        if self.sign(&base)? {
            return Ok(grown(base));
        }
        // (-1)^n is 1 and -1 again and again
        match is_whole && !self.moves(&base) {
            true => {
                let full = (exponent == symbol(&self.letter)).then(Vec::new);
                let wave = self.wave(real_power(integer(-1), exponent.clone()), full)?;
                let base = negative(base);
                Ok(if is_one(&base) {
                    wave
                } else {
                    product(vec![wave, grown(base)])
                })
            }
            false => Err("a power of what is negative".to_owned()),
        }
    }

    /// Returns a letter between -1 and 1 for what oscillates.
    fn wave(&mut self, of: Tree, full: Option<Vec<Equation>>) -> Found {
        self.is_one_sided = true;
        if let Some(known) = self.waves.iter().find(|known| known.of == of) {
            return Ok(symbol(&known.name));
        }
        let place = self.waves.len();
        let name = self
            .names
            .get(place)
            .cloned()
            .ok_or("so many functions that oscillate")?;
        self.point.insert(name.clone(), 0.73 - 0.19 * place as f64);
        let letter = symbol(&name);
        self.waves.push(Wave { of, name, full });
        Ok(letter)
    }

    /// Prepares a value of a function that is not known, where its argument has a limit.
    fn prepared_unknown(&mut self, name: &Name, argument: &Tree) -> Found {
        let argument = self.prepared(argument)?;
        match self.limit(&argument)? {
            End::Finite(_) => Ok(Tree::Call(name.clone(), Box::new(argument), At::default())),
            End::Infinite(_) => Err(format!("`{name}` at infinity")),
        }
    }

    fn prepared_call(&mut self, name: &Name, argument: &Tree) -> Found {
        if self.symbols.is_function(name) {
            return self.prepared_unknown(name, argument);
        }
        if factorial::is_of(name) {
            return self.prepared_factorial(name, argument);
        }
        let function = Elementary::named(name).ok_or_else(|| format!("the series of `{name}`"))?;
        if let Some((above, below)) = function.quotient() {
            let of = |own: &Elementary| call(own.command, argument.clone());
            let above = above.map_or_else(|| integer(1), of);
            return self.prepared(&quotient(above, of(below)));
        }
        let inner = self.prepared(argument)?;
        match name.base.as_str() {
            "\\abs" => {
                let is_positive = self.sign(&inner)?;
                return Ok(if is_positive { inner } else { negative(inner) });
            }
            "\\ln" | "\\log" => {
                self.positive(&inner)?;
                return Ok(call("\\ln", inner));
            }
            "\\exp" => return Ok(call("\\exp", inner)),
            "\\arcosh" | "\\artanh" => return self.defined(function, argument),
            _ => {}
        }
        let (known, end) = (self.needed.len(), self.limit(&inner));
        // bounded, whatever the limit
        if ["\\sin", "\\cos"].contains(&name.base.as_str()) && !matches!(end, Ok(End::Finite(_))) {
            let needed = self.needed.split_off(known);
            self.limits.clear();
            let full = (end.is_ok() && !self.is_integer).then_some(needed);
            return self.wave(call(&name.base, inner), full);
        }
        match (end?, name.base.as_str()) {
            (End::Infinite(is_positive), "\\arctan") => {
                self.is_one_sided = true;
                // for u > 0 it is a quarter turn less that of 1/u
                let quarter = quotient(symbol(&plain("\\pi")), integer(2));
                let quarter = if is_positive { quarter } else { negative(quarter) };
                Ok(difference(quarter, call("\\arctan", quotient(integer(1), inner))))
            }
            (End::Infinite(is_positive), "\\sinh" | "\\cosh" | "\\arsinh") => {
                self.is_one_sided = true;
                match is_positive || name.base == "\\cosh" {
                    true => self.defined(function, argument),
                    false => Ok(negative(self.defined(function, &negative(argument.clone()))?)),
                }
            }
            (End::Infinite(_), _) => Err(format!("`{name}` at infinity")),
            (End::Finite(_), "\\arcsin" | "\\arccos") => {
                self.positive(&difference(integer(1), power(inner.clone(), 2)))?;
                Ok(call(&name.base, inner))
            }
            (End::Finite(_), "\\sin" | "\\cos" | "\\sinh" | "\\cosh" | "\\arsinh" | "\\arctan") => {
                Ok(call(&name.base, inner))
            }
            (End::Finite(_), _) => Err(format!("the series of `{name}`")),
        }
    }

    /// Prepares the factorial of an integer that grows, by Stirling's formula with the bounds of Robbins (A remark on Stirling's formula,
    /// American Mathematical Monthly 62, 1955, p. 26): `m! = \sqrt{2 \pi m} m^m e^{-m} e^r` with `1/(12 m + 1) < r < 1/(12 m)` for m from
    /// 1 on, so that `r = 1/(12 m) - s/(12 m)^2` with s between 0 and 1.
    fn prepared_factorial(&mut self, name: &Name, argument: &Tree) -> Found {
        let own = call(&name.base, argument.clone());
        let by_letters = factorial::by_letters(&own);
        if by_letters != own {
            return self.prepared(&by_letters);
        }
        if name.base != factorial::FACTORIAL || !factorial::is_integer(&self.at_integers(argument), self.symbols) {
            return Err(format!("the factorial of `{argument}`"));
        }
        let m = self.prepared(argument)?;
        if self.limit(&m)? != End::Infinite(true) {
            return Err(format!("the factorial of `{argument}`, which does not grow"));
        }
        let share = self.wave(own, None)?;
        let exponent = sum(vec![
            product(vec![m.clone(), call("\\ln", m.clone())]),
            negative(m.clone()),
            quotient(integer(1), product(vec![integer(12), m.clone()])),
            negative(quotient(share, product(vec![integer(144), power(m.clone(), 2)]))),
        ]);
        let circle = product(vec![integer(2), symbol(&plain("\\pi")), m]);
        Ok(product(vec![real_power(circle, ratio(1, 2)), call("\\exp", exponent)]))
    }

    /// Returns the tree with the letter that takes integers in place of the one that grows.
    fn at_integers(&self, tree: &Tree) -> Tree {
        rewrite(tree, &|name| (*name == self.letter).then(|| symbol(&self.by)))
    }

    /// Prepares a function by its formula in simpler ones.
    fn defined(&mut self, function: &Elementary, argument: &Tree) -> Found {
        let formula = function.definition(argument).ok_or("a function without a formula")?;
        self.prepared(&formula)
    }

    fn prepared_operation(&mut self, operation: &Operation) -> Found {
        match operation {
            Operation::Integral {
                of,
                by,
                limits: Some((low, high)),
            } if !self.moves(of) => {
                let ends = [self.prepared(low)?, self.prepared(high)?];
                let (start, end) = (self.limit(&ends[0])?, self.limit(&ends[1])?);
                let (End::Finite(start), End::Finite(end)) = (start, end) else {
                    return Err("an improper integral within a limit".to_owned());
                };
                if start != end {
                    return Err("an integral over an interval that does not shrink".to_owned());
                }
                let above = self.part(of, by, high)?;
                let below = self.part(of, by, low)?;
                Ok(difference(above, below))
            }
            Operation::Series {
                kind: Series::Sum,
                of,
                index,
                from,
                to,
            } => {
                let (Some(from), Some(to)) = (super::integers::whole(from), super::integers::whole(to)) else {
                    return Err("a sum of unknown length within a limit".to_owned());
                };
                if to.saturating_sub(from) > MOST_TERMS {
                    return Err("so long a sum within a limit".to_owned());
                }
                let terms = (from..=to).map(|value| with_factorials(&at_index(of, index, value)));
                let terms: Vec<Tree> = terms.collect();
                Ok(sum(self.all(&terms)?))
            }
            Operation::Binomial(of, chosen) => self.prepared(&with_factorials(&factorial::binomial(of, chosen)?)),
            _ => Err("an operation within a limit".to_owned()),
        }
    }

    /// Returns the integral up to an end that moves, from what that tends to, as the end and the integrand there.
    fn part(&mut self, of: &Tree, by: &Name, end: &Tree) -> Found {
        if !self.moves(end) {
            return Ok(integer(0));
        }
        let there = rewrite(of, &|name| (name == by).then(|| end.clone()));
        let slope = self.prepared(&there)?;
        let is_open = matches!(self.limit(&slope)?, End::Infinite(_)) || !self.waves.is_empty();
        if is_open {
            return Err("an integral of what has no limit, within a limit".to_owned());
        }
        let parts = vec![self.prepared(end)?, slope];
        Ok(Tree::Operation(Box::new(Operation::Arguments(parts)), At::default()))
    }
}

/// Returns a product, or a quotient by another, with its exponential functions as one.
fn with_one_exponential(above: Tree, below: Option<Tree>) -> Tree {
    let (mut factors, mut divisors, mut exponents) = (Vec::new(), Vec::new(), Vec::new());
    part_exponentials(&above, &mut factors, &mut exponents);
    let known = exponents.len();
    below
        .iter()
        .for_each(|below| part_exponentials(below, &mut divisors, &mut exponents));
    if exponents.len() < 2 {
        return match below {
            Some(below) => quotient(above, below),
            None => above,
        };
    }
    let signed = exponents.into_iter().enumerate();
    let signed = signed.map(|(place, own)| if place < known { own } else { negative(own) });
    factors.push(call("\\exp", sum(signed.collect())));
    match divisors.is_empty() {
        true => product(factors),
        false => quotient(product(factors), product(divisors)),
    }
}

fn part_exponentials(tree: &Tree, factors: &mut Vec<Tree>, exponents: &mut Vec<Tree>) {
    match tree {
        Tree::Product(parts) => parts
            .iter()
            .for_each(|part| part_exponentials(part, factors, exponents)),
        Tree::Call(name, exponent, _) if name.base == "\\exp" => exponents.push((**exponent).clone()),
        other => factors.push(other.clone()),
    }
}

/// Returns the tree with factorials of numbers written out.
pub(super) fn with_factorials(tree: &Tree) -> Tree {
    mapped(tree, &|node| match node {
        Tree::Call(name, argument, _) => factorial::of_number(name, argument).and_then(Result::ok),
        _ => None,
    })
}
