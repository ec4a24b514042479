//! A search for antiderivatives: polynomials, powers of what is linear, and products of polynomials with exponentials, sines
//! and cosines of linear arguments.
//!
//! Nothing rests on what is found: it is shown to be one.

use super::build::{
    call, difference, integer, is_zero, negative, plain, power, product, quotient, real_power, root, sum, symbol,
};
use super::derivative::{By, mentions};
use super::exponential::Terms;
use super::parts::Parts;
use numbers::{Field, Rational};
use texmath::{Name, Symbols, Tree, any, number_of};

/// The highest degree of a polynomial.
const HIGHEST: usize = 24;

/// An antiderivative of `of` by `by`.
pub(super) fn antiderivative(of: &Tree, by: &Name, symbols: &Symbols) -> Option<Tree> {
    let search = Search { by, symbols };
    search.of(of)
}

/// A factor and the coefficients, from the constant on, of the exponent of `c e^(u + v x + w x^2)`.
pub(super) fn quadratic_exponential(of: &Tree, by: &Name, symbols: &Symbols) -> Option<(Tree, [Tree; 3])> {
    let search = Search { by, symbols };
    match of {
        Tree::Negate(inner) => {
            let (factor, coefficients) = quadratic_exponential(inner, by, symbols)?;
            Some((negative(factor), coefficients))
        }
        Tree::Quotient(above, below, _) if !mentions(below, by) => {
            let (factor, coefficients) = quadratic_exponential(above, by, symbols)?;
            Some((quotient(factor, (**below).clone()), coefficients))
        }
        Tree::Product(factors) => {
            let (mut rest, mut free): (Vec<Tree>, Vec<Tree>) =
                factors.iter().cloned().partition(|factor| mentions(factor, by));
            let single = rest.pop().filter(|_| rest.is_empty())?;
            let (factor, coefficients) = quadratic_exponential(&single, by, symbols)?;
            free.push(factor);
            Some((product(free), coefficients))
        }
        tree => {
            let coefficients = search.polynomial(&search.exponent(tree)?)?;
            let coefficients: [Tree; 3] = coefficients.try_into().ok()?;
            Some((integer(1), coefficients))
        }
    }
}

struct Search<'a> {
    by: &'a Name,
    symbols: &'a Symbols,
}

impl Search<'_> {
    fn of(&self, tree: &Tree) -> Option<Tree> {
        self.by_form(tree).or_else(|| {
            let terms = Terms {
                by: self.by,
                exponent: &|tree| self.exponent(tree),
                linear: &|tree| self.linear(tree),
            };
            terms.integrated(tree).or_else(|| self.by_functions(tree))
        })
    }

    /// What holds unknown functions, and derivatives of these.
    fn by_functions(&self, tree: &Tree) -> Option<Tree> {
        let is_function = |node: &Tree| matches!(node, Tree::Call(name, ..) if self.symbols.is_function(name));
        let parts = Parts {
            by: self.by,
            symbols: self.symbols,
            slope: &|tree| self.linear(tree).map(|(_, slope)| slope),
            known: &|tree| self.of(tree),
        };
        any(tree, &mut |node| is_function(node)).then(|| parts.integrated(tree))?
    }

    fn by_form(&self, tree: &Tree) -> Option<Tree> {
        if let Some(coefficients) = self.polynomial(tree) {
            let terms = coefficients.into_iter().enumerate().map(|(degree, coefficient)| {
                let next = i32::try_from(degree).unwrap_or(i32::MAX).saturating_add(1);
                quotient(
                    product(vec![coefficient, power(symbol(self.by), next)]),
                    integer(i64::from(next)),
                )
            });
            return Some(sum(terms.collect()));
        }
        match tree {
            Tree::Sum(terms) => Some(sum(terms.iter().map(|term| self.of(term)).collect::<Option<_>>()?)),
            Tree::Negate(inner) => Some(negative(self.of(inner)?)),
            Tree::Quotient(above, below, _) if !mentions(below, self.by) => {
                Some(quotient(self.of(above)?, (**below).clone()))
            }
            Tree::Quotient(above, below, _) if !mentions(above, self.by) => {
                Some(product(vec![(**above).clone(), self.reciprocal(below)?]))
            }
            Tree::Product(factors) => self.product(factors),
            Tree::Power(base, exponent @ ..=-2, _) if !matches!(**base, Tree::Root(..)) => {
                self.power_of_linear(base, &integer(i64::from(*exponent)))
            }
            Tree::Power(base, exponent, _) if matches!(**base, Tree::Root(..)) => self.power_of_root(base, *exponent),
            Tree::Root(..) => self.power_of_root(tree, 1),
            Tree::RealPower(base, exponent, _) if !mentions(exponent, self.by) => self.power_of_linear(base, exponent),
            Tree::Call(name, argument, _) if name.base == "\\ln" => {
                let (_, slope) = self.linear(argument)?;
                let argument = (**argument).clone();
                let whole = product(vec![argument.clone(), call("\\ln", argument.clone())]);
                Some(quotient(difference(whole, argument), slope))
            }
            tree => self.product(std::slice::from_ref(tree)),
        }
    }

    /// A power of what is linear, whose exponent is not -1.
    fn power_of_linear(&self, base: &Tree, exponent: &Tree) -> Option<Tree> {
        let (_, slope) = self.linear(base)?;
        let next = number_of(exponent).map(|exponent| exponent + Rational::from_integer(1));
        let (next, whole) = match (next.clone(), next.and_then(|next| next.to_integer())) {
            (_, Some(0)) => return None,
            (_, Some(whole)) => (integer(whole), power(base.clone(), i32::try_from(whole).ok()?)),
            (_, None) => {
                let next = sum(vec![exponent.clone(), integer(1)]);
                (next.clone(), real_power(base.clone(), next))
            }
        };
        Some(quotient(whole, product(vec![next, slope])))
    }

    /// A power of a root of what is linear.
    fn power_of_root(&self, root: &Tree, exponent: i32) -> Option<Tree> {
        let Tree::Root(radicand, index, _) = root else {
            return None;
        };
        let (_, slope) = self.linear(radicand)?;
        let index = i32::try_from(*index).ok()?;
        let next = exponent.checked_add(index).filter(|next| *next != 0)?;
        let above = product(vec![integer(i64::from(index)), power(root.clone(), next)]);
        Some(quotient(above, product(vec![integer(i64::from(next)), slope])))
    }

    /// `1/below`.
    fn reciprocal(&self, below: &Tree) -> Option<Tree> {
        match below {
            Tree::Power(base, exponent @ 1.., _) if matches!(**base, Tree::Root(..)) => {
                return self.power_of_root(base, -*exponent);
            }
            Tree::Root(..) => return self.power_of_root(below, -1),
            Tree::Power(base, exponent @ 2.., _) => {
                if let Some(whole) = self.power_of_linear(base, &integer(-i64::from(*exponent))) {
                    return Some(whole);
                }
            }
            Tree::RealPower(base, exponent, _) if !mentions(exponent, self.by) => {
                return self.power_of_linear(base, &negative((**exponent).clone()));
            }
            Tree::Product(factors) => {
                let (free, rest): (Vec<Tree>, Vec<Tree>) =
                    factors.iter().cloned().partition(|factor| !mentions(factor, self.by));
                if !free.is_empty() {
                    return Some(quotient(self.reciprocal(&product(rest))?, product(free)));
                }
            }
            _ => {}
        }
        let coefficients = self.polynomial(below)?;
        match coefficients.as_slice() {
            [_, slope] => Some(quotient(call("\\ln", call("\\abs", below.clone())), slope.clone())),
            [constant, linear, square] if is_zero(linear) => {
                // 1/(p^2 + q^2 x^2) = arctan(q x/p)/(p q)
                let (p, q) = (side(constant), side(square));
                let angle = quotient(product(vec![q.clone(), symbol(self.by)]), p.clone());
                Some(quotient(call("\\arctan", angle), product(vec![p, q])))
            }
            _ => None,
        }
    }

    /// A polynomial times one exponential, sine or cosine.
    fn product(&self, factors: &[Tree]) -> Option<Tree> {
        let (mut free, mut rest) = (Vec::new(), Vec::new());
        for factor in factors {
            match mentions(factor, self.by) {
                true => rest.push(factor.clone()),
                false => free.push(factor.clone()),
            }
        }
        if !free.is_empty() {
            let rest = match rest.len() {
                1 => rest.remove(0),
                _ => Tree::Product(rest),
            };
            free.push(self.of(&rest)?);
            return Some(product(free));
        }
        let (mut polynomial, mut waves) = (Vec::new(), Vec::new());
        for factor in rest {
            match self.polynomial(&factor) {
                Some(_) => polynomial.push(factor),
                None => waves.push(factor),
            }
        }
        match waves.as_slice() {
            [wave] => self.by_parts(&product(polynomial), wave),
            _ => None,
        }
    }

    /// `p w` for a polynomial p and an exponential, sine or cosine w, whose antiderivatives repeat.
    fn by_parts(&self, polynomial: &Tree, wave: &Tree) -> Option<Tree> {
        let (mut slope, mut wave) = (polynomial.clone(), wave.clone());
        let mut terms = Vec::new();
        let by = By {
            symbols: self.symbols,
            name: self.by,
        };
        for place in 0..HIGHEST {
            wave = self.wave(&wave)?;
            let term = product(vec![slope.clone(), wave.clone()]);
            terms.push(if place % 2 == 0 { term } else { negative(term) });
            let coefficients = self.polynomial(&by.of(&slope).ok()?)?;
            if coefficients.iter().all(is_zero) {
                return Some(sum(terms));
            }
            let powers = coefficients.into_iter().enumerate().map(|(degree, coefficient)| {
                product(vec![
                    coefficient,
                    power(symbol(self.by), i32::try_from(degree).unwrap_or(0)),
                ])
            });
            slope = sum(powers.collect());
        }
        None
    }

    /// The antiderivative of an exponential, a sine or a cosine of a linear argument, perhaps over a constant.
    fn wave(&self, tree: &Tree) -> Option<Tree> {
        match tree {
            Tree::Negate(inner) => return Some(negative(self.wave(inner)?)),
            Tree::Quotient(above, below, _) if !mentions(below, self.by) => {
                return Some(quotient(self.wave(above)?, (**below).clone()));
            }
            _ => {}
        }
        if let Some(exponent) = self.exponent(tree) {
            let (_, slope) = self.linear(&exponent)?;
            return Some(quotient(tree.clone(), slope));
        }
        let Tree::Call(name, argument, _) = tree else {
            return None;
        };
        let (_, slope) = self.linear(argument)?;
        let at = |function: &str| call(function, (**argument).clone());
        let whole = match name.base.as_str() {
            "\\sin" => negative(at("\\cos")),
            "\\cos" => at("\\sin"),
            "\\sinh" => at("\\cosh"),
            "\\cosh" => at("\\sinh"),
            _ => return None,
        };
        Some(quotient(whole, slope))
    }

    fn exponent(&self, tree: &Tree) -> Option<Tree> {
        let euler = plain("e");
        match tree {
            Tree::RealPower(base, exponent, _) => {
                let is_euler = matches!(&**base, Tree::Symbol(name, _) if *name == euler);
                (is_euler && !self.symbols.declares(&euler)).then(|| (**exponent).clone())
            }
            // e^2 and the like are read as integer powers
            Tree::Call(name, argument, _) if name.base == "\\exp" => Some((**argument).clone()),
            _ => None,
        }
    }

    /// The constant and the slope of a linear tree that is not constant.
    fn linear(&self, tree: &Tree) -> Option<(Tree, Tree)> {
        match self.polynomial(tree)?.as_slice() {
            [constant, slope] => Some((constant.clone(), slope.clone())),
            _ => None,
        }
    }

    /// The coefficients of a polynomial, from the constant on, the last one not written as 0.
    fn polynomial(&self, tree: &Tree) -> Option<Vec<Tree>> {
        let mut coefficients = match tree {
            tree if !mentions(tree, self.by) => vec![tree.clone()],
            Tree::Symbol(..) => vec![integer(0), integer(1)],
            Tree::Negate(inner) => self.polynomial(inner)?.into_iter().map(negative).collect(),
            Tree::Sum(terms) => {
                let mut total: Vec<Vec<Tree>> = Vec::new();
                for term in terms {
                    for (degree, coefficient) in self.polynomial(term)?.into_iter().enumerate() {
                        if total.len() <= degree {
                            total.resize(degree + 1, Vec::new());
                        }
                        if let Some(sum) = total.get_mut(degree) {
                            sum.push(coefficient);
                        }
                    }
                }
                total.into_iter().map(sum).collect()
            }
            Tree::Product(factors) => {
                let mut total = vec![integer(1)];
                for factor in factors {
                    total = times(&total, &self.polynomial(factor)?)?;
                }
                total
            }
            Tree::Quotient(above, below, _) if !mentions(below, self.by) => {
                let above = self.polynomial(above)?.into_iter();
                above
                    .map(|coefficient| quotient(coefficient, (**below).clone()))
                    .collect()
            }
            Tree::Power(base, exponent, _) if (0..=12).contains(exponent) => {
                let base = self.polynomial(base)?;
                let mut total = vec![integer(1)];
                for _ in 0..*exponent {
                    total = times(&total, &base)?;
                }
                total
            }
            _ => return None,
        };
        while coefficients.len() > 1 && coefficients.last().is_some_and(is_zero) {
            coefficients.pop();
        }
        Some(coefficients)
    }
}

/// What the tree is the square of.
fn side(square: &Tree) -> Tree {
    match square {
        Tree::Power(base, 2, _) => (**base).clone(),
        one if number_of(one) == Some(Rational::from_integer(1)) => integer(1),
        other => root(other.clone()),
    }
}

fn times(left: &[Tree], right: &[Tree]) -> Option<Vec<Tree>> {
    let length = (left.len() + right.len()).saturating_sub(1);
    if length > HIGHEST {
        return None;
    }
    let mut total: Vec<Vec<Tree>> = vec![Vec::new(); length];
    for (one, left) in left.iter().enumerate() {
        for (other, right) in right.iter().enumerate() {
            if let Some(terms) = total.get_mut(one + other) {
                terms.push(product(vec![left.clone(), right.clone()]));
            }
        }
    }
    Some(total.into_iter().map(sum).collect())
}
