//! Derivatives by the rules of differentiation: a value where each rule gives one.

use super::build::{
    call, difference, integer, is_zero, negative, plain, power, product, quotient, real_power, sum, symbol,
};
use texmath::{Elementary, Name, Operation, Series, Symbols, Tree, any, nodes_of, rewrite};

/// The largest derivative, in nodes.
const LARGEST: usize = 20_000;

/// Whether a tree speaks of a symbol.
pub(super) fn mentions(tree: &Tree, name: &Name) -> bool {
    any(
        tree,
        &mut |node| matches!(node, Tree::Symbol(other, _) if other == name),
    )
}

/// Differentiates by one symbol.
pub(super) struct By<'a> {
    pub symbols: &'a Symbols,
    pub name: &'a Name,
}

impl By<'_> {
    /// The derivative of this order.
    pub fn of_order(&self, tree: &Tree, order: u32) -> Result<Tree, String> {
        let mut slope = tree.clone();
        for _ in 0..order {
            slope = self.of(&slope)?;
            if nodes_of(&slope) > LARGEST {
                return Err("the derivative is too large".to_owned());
            }
        }
        Ok(slope)
    }

    fn runs(&self) -> bool {
        self.symbols.running() == Some(self.name)
    }

    /// The derivative of a tree; nothing in it is an abbreviation or a definition.
    pub fn of(&self, tree: &Tree) -> Result<Tree, String> {
        let unchanged = || Ok(integer(0));
        Ok(match tree {
            Tree::Number(_) => return unchanged(),
            Tree::Symbol(name, _) if name == self.name => integer(1),
            Tree::Symbol(name, _) if self.runs() && self.moves(name) => self.derivative_of(name, None)?,
            Tree::Symbol(..) => return unchanged(),
            Tree::Call(name, argument, _) => {
                let slope = self.of(argument)?;
                if is_zero(&slope) {
                    return unchanged();
                }
                let outer = match self.symbols.is_function(name) || self.symbols.is_in_flight(name) {
                    true => self.derivative_of(name, Some(argument))?,
                    false => Elementary::named(name)
                        .and_then(|function| function.derivative(argument))
                        .ok_or_else(|| format!("`{name}` is not differentiated"))?,
                };
                product(vec![outer, slope])
            }
            Tree::Negate(inner) => negative(self.of(inner)?),
            Tree::Sum(terms) => sum(terms.iter().map(|term| self.of(term)).collect::<Result<_, _>>()?),
            Tree::Product(factors) => {
                let mut terms = Vec::new();
                for (place, factor) in factors.iter().enumerate() {
                    let slope = self.of(factor)?;
                    let mut parts: Vec<Tree> = factors.clone();
                    if let Some(part) = parts.get_mut(place) {
                        *part = slope;
                    }
                    terms.push(product(parts));
                }
                sum(terms)
            }
            Tree::Quotient(above, below, _) => {
                let (up, down) = (self.of(above)?, self.of(below)?);
                if is_zero(&down) {
                    return Ok(quotient(up, (**below).clone()));
                }
                let above = difference(
                    product(vec![up, (**below).clone()]),
                    product(vec![(**above).clone(), down]),
                );
                quotient(above, power((**below).clone(), 2))
            }
            Tree::Power(base, exponent, _) => {
                let slope = self.of(base)?;
                let factor = integer(i64::from(*exponent));
                product(vec![factor, power((**base).clone(), exponent.saturating_sub(1)), slope])
            }
            Tree::Root(radicand, index, at) => {
                let slope = self.of(radicand)?;
                let degree = i32::try_from(*index).map_err(|_| "this root is not differentiated".to_owned())?;
                let again = Tree::Root(radicand.clone(), *index, *at);
                let below = product(vec![integer(i64::from(*index)), power(again, degree - 1)]);
                quotient(slope, below)
            }
            Tree::RealPower(base, exponent, _) => self.of_power(base, exponent)?,
            Tree::Operation(operation, at) => match &**operation {
                Operation::Series {
                    kind: Series::Sum,
                    of,
                    index,
                    from,
                    to,
                } if index != self.name && !mentions(from, self.name) && !mentions(to, self.name) => {
                    let operation = Operation::Series {
                        kind: Series::Sum,
                        of: self.of(of)?,
                        index: index.clone(),
                        from: from.clone(),
                        to: to.clone(),
                    };
                    Tree::Operation(Box::new(operation), *at)
                }
                _ => return Err("an operation within a derivative is not differentiated".to_owned()),
            },
            Tree::Partial { .. } | Tree::Invariant { .. } | Tree::PlusMinus(_) | Tree::MinusPlus(_) => {
                return Err(format!("`{tree}` is not differentiated"));
            }
        })
    }

    fn of_power(&self, base: &Tree, exponent: &Tree) -> Result<Tree, String> {
        let (up, down) = (self.of(exponent)?, self.of(base)?);
        let whole = real_power(base.clone(), exponent.clone());
        let euler = plain("e");
        let is_euler = matches!(base, Tree::Symbol(name, _) if *name == euler) && !self.symbols.declares(&euler);
        Ok(match (is_zero(&up), is_zero(&down)) {
            (true, true) => integer(0),
            (false, true) if is_euler => product(vec![whole, up]),
            (false, true) => product(vec![whole, call("\\ln", base.clone()), up]),
            (true, false) => {
                let less = sum(vec![exponent.clone(), integer(-1)]);
                product(vec![exponent.clone(), real_power(base.clone(), less), down])
            }
            (false, false) => {
                let first = product(vec![up, call("\\ln", base.clone())]);
                let second = quotient(product(vec![exponent.clone(), down]), base.clone());
                product(vec![whole, sum(vec![first, second])])
            }
        })
    }

    /// The derivative of a value of a function, by its argument.
    pub fn next(&self, value: &Tree) -> Result<Tree, String> {
        match value {
            Tree::Call(name, argument, _) => self.derivative_of(name, Some(argument)),
            _ => Err(format!("`{value}` is not differentiated further")),
        }
    }

    /// Whether a name without an argument is a value at the running time.
    fn moves(&self, name: &Name) -> bool {
        let is_flying = self.symbols.is_in_flight(name) && name.mark.is_empty() && name.subscript.is_empty();
        is_flying || (self.symbols.is_function(name) && !self.symbols.is_parameter(name))
    }

    /// The derivative of a function or a state, at its argument.
    fn derivative_of(&self, name: &Name, argument: Option<&Tree>) -> Result<Tree, String> {
        let at = |slope: Name| match argument {
            Some(argument) => Tree::Call(slope, Box::new(argument.clone()), texmath::At::default()),
            None => symbol(&slope),
        };
        if self.symbols.is_in_flight(name) {
            let dotted = name.dotted();
            return match self.symbols.is_in_flight(&dotted) {
                true => Ok(at(dotted)),
                false => Err(format!("`{name}` is not differentiated further")),
            };
        }
        let declared = self.symbols.functions().find(|(function, _)| *function == name);
        Ok(match declared.and_then(|(_, slope)| slope) {
            Some(Tree::Symbol(slope, _)) => at(slope.clone()),
            Some(slope) => match (argument, self.symbols.running()) {
                (Some(argument), Some(running)) => rewrite(slope, &|name| (name == running).then(|| argument.clone())),
                _ => slope.clone(),
            },
            None => at(Name {
                primes: name.primes.saturating_add(1),
                ..name.clone()
            }),
        })
    }
}
