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
            Tree::Product(parts) => Ok(product(self.all(parts)?)),
            Tree::Quotient(above, below, _) if !self.moves(below) => {
                let factor = quotient(integer(1), (**below).clone());
                self.write(&factor);
                Ok(product(vec![factor, self.prepared(above)?]))
            }
            Tree::Quotient(above, below, _) => {
                let (above, below) = (self.prepared(above)?, self.prepared(below)?);
                self.nonzero(&below)?;
                Ok(quotient(above, below))
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
        let at_integers = rewrite(exponent, &|name| (*name == self.letter).then(|| symbol(&self.by)));
        let is_whole = factorial::is_integer(&at_integers, self.symbols);
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

/// Returns the tree with factorials of numbers written out.
pub(super) fn with_factorials(tree: &Tree) -> Tree {
    mapped(tree, &|node| match node {
        Tree::Call(name, argument, _) => factorial::of_number(name, argument).and_then(Result::ok),
        _ => None,
    })
}
