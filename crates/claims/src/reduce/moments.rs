//! Integrals of powers times exponentials of a power, from 0 or over all numbers, by the gamma function (Whittaker and Watson,
//! A Course of Modern Analysis, section 12.2):
//!
//! `\int_0^\infty x^s e^{-a x^q} dx = \Gamma((s + 1)/q)/(q a^{(s + 1)/q})` for `s > -1` and positive a and q.

use super::build::{
    call, difference, infinity, integer, is_zero, negative, plain, power, product, quotient, real_power, root, sum,
    symbol,
};
use super::derivative::mentions;
use super::factorial::{FACTORIAL, is_integer, linear};
use super::gaussian::{exponent_of_e, polynomial};
use numbers::{Field, Rational};
use std::collections::BTreeMap;
use texmath::{Equation, Name, Relation, Symbols, Tree, number_of};

/// The most terms, and the largest number of which a factorial is taken.
const MOST_TERMS: usize = 80;
const LARGEST: i64 = 60;

/// Integer letters times integers, and a number, added up.
#[derive(Clone, Debug, PartialEq)]
struct Exponent {
    letters: BTreeMap<Name, i64>,
    constant: Rational,
}

impl Exponent {
    fn number(constant: Rational) -> Self {
        Self {
            letters: BTreeMap::new(),
            constant,
        }
    }

    fn plus(&self, other: &Self, sign: i64) -> Self {
        let mut letters = self.letters.clone();
        for (name, factor) in &other.letters {
            *letters.entry(name.clone()).or_default() += sign * factor;
        }
        letters.retain(|_, factor| *factor != 0);
        Self {
            letters,
            constant: self.constant.clone() + other.constant.clone() * Rational::from_integer(sign),
        }
    }

    /// The quotient by an integer; None where the letters are not multiples of it.
    fn over(&self, by: i64) -> Option<Self> {
        let letters = self.letters.iter();
        let letters = letters.map(|(name, factor)| (factor % by == 0).then(|| (name.clone(), factor / by)));
        Some(Self {
            letters: letters.collect::<Option<_>>()?,
            constant: self.constant.clone() / Rational::from_integer(by),
        })
    }

    fn tree(&self) -> Tree {
        let terms = self.letters.iter();
        let terms = terms.map(|(name, factor)| product(vec![integer(*factor), symbol(name)]));
        sum(terms.chain([number(&self.constant)]).collect())
    }

    /// A base to this power.
    fn power_of(&self, base: Tree) -> Tree {
        let whole = self.constant.to_integer().and_then(|whole| i32::try_from(whole).ok());
        match whole.filter(|_| self.letters.is_empty()) {
            Some(whole) if whole >= 0 => power(base, whole),
            Some(whole) => quotient(integer(1), power(base, -whole)),
            None => real_power(base, self.tree()),
        }
    }

    /// The parity of an integer; None where it depends on the letters, or for what need not be an integer.
    fn is_even(&self) -> Option<bool> {
        let whole = self.constant.to_integer()?;
        let is_known = self.letters.values().all(|factor| factor % 2 == 0);
        is_known.then_some(whole % 2 == 0)
    }
}

fn number(value: &Rational) -> Tree {
    match *value < Rational::from_integer(0) {
        true => negative(Tree::Number(-value.clone())),
        false => Tree::Number(value.clone()),
    }
}

fn factorial(number: i64) -> Rational {
    (2..=number).fold(Rational::from_integer(1), |total, factor| {
        total * Rational::from_integer(factor)
    })
}

/// A term `factor x^power e^(c_0 + c_1 x + ...)`.
#[derive(Clone, Debug)]
struct Term {
    factor: Tree,
    power: Exponent,
    /// The coefficients of the polynomial in the exponent.
    exponent: Vec<Tree>,
}

impl Term {
    fn constant(factor: Tree) -> Self {
        Self {
            factor,
            power: Exponent::number(Rational::from_integer(0)),
            exponent: Vec::new(),
        }
    }

    fn times(&self, other: &Self) -> Self {
        let length = self.exponent.len().max(other.exponent.len());
        let at = |place: usize| {
            let parts = [self, other].map(|term| term.exponent.get(place).cloned());
            sum(parts.into_iter().flatten().collect())
        };
        Self {
            factor: product(vec![self.factor.clone(), other.factor.clone()]),
            power: self.power.plus(&other.power, 1),
            exponent: (0..length).map(at).collect(),
        }
    }

    fn inverse(&self) -> Self {
        let zero = Exponent::number(Rational::from_integer(0));
        Self {
            factor: quotient(integer(1), self.factor.clone()),
            power: zero.plus(&self.power, -1),
            exponent: self.exponent.iter().cloned().map(negative).collect(),
        }
    }

    fn tree(&self, by: &Name) -> Tree {
        let degrees = (0_i32..).zip(&self.exponent);
        let exponent = degrees.map(|(degree, own)| product(vec![own.clone(), power(symbol(by), degree)]));
        let exponent = sum(exponent.collect());
        let mut factors = vec![self.factor.clone(), self.power.power_of(symbol(by))];
        if !is_zero(&exponent) {
            factors.push(call("\\exp", exponent));
        }
        product(factors)
    }

    fn coefficient(&self, degree: usize) -> Tree {
        self.exponent.get(degree).cloned().unwrap_or_else(|| integer(0))
    }

    /// The degrees, from 1 on, that the exponent has.
    fn degrees(&self) -> Vec<usize> {
        let is_there = |degree: &usize| number_of(&self.coefficient(*degree)) != Some(Rational::from_integer(0));
        (1..self.exponent.len()).filter(is_there).collect()
    }

    /// The integral from 0 on, where the exponent is a constant and a multiple of one power, with what must hold for it.
    fn on_half_line(&self) -> Option<(Tree, Vec<Equation>)> {
        let [degree] = self.degrees().try_into().ok()?;
        let rate = negative(self.coefficient(degree));
        let own = Exponent::number(Rational::from_integer(1)).plus(&self.power, 1);
        let degree = i64::try_from(degree).ok()?;
        let of = own.over(degree)?;
        let value = quotient(gamma_over_power(&of, &rate)?, integer(degree));
        let needed = vec![
            Equation {
                relation: Relation::Greater,
                ..Equation::between(rate, integer(0))
            },
            Equation {
                relation: Relation::Greater,
                ..Equation::between(own.tree(), integer(0))
            },
        ];
        Some((
            product(vec![self.factor.clone(), self.factor_of_constant(), value]),
            needed,
        ))
    }

    /// e to the constant in the exponent.
    fn factor_of_constant(&self) -> Tree {
        let constant = self.coefficient(0);
        match is_zero(&constant) {
            true => integer(1),
            false => call("\\exp", constant),
        }
    }

    /// The integral over all numbers.
    fn over_all(&self) -> Option<(Tree, Vec<Equation>)> {
        let degrees = self.degrees();
        if degrees == [1, 2] {
            return self.shifted();
        }
        let [degree] = degrees.try_into().ok()?;
        if degree % 2 != 0 {
            return None;
        }
        let (half, needed) = self.on_half_line()?;
        match self.power.is_even()? {
            true => Some((product(vec![integer(2), half]), needed)),
            false => Some((integer(0), needed)),
        }
    }

    /// The integral over all numbers of `x^s e^(c_0 + c_1 x + c_2 x^2)`, about the place where the exponent is largest.
    fn shifted(&self) -> Option<(Tree, Vec<Equation>)> {
        let power_of_x = self
            .power
            .constant
            .to_integer()
            .filter(|_| self.power.letters.is_empty())?;
        let power_of_x = i32::try_from(power_of_x)
            .ok()
            .filter(|power| (0..=20).contains(power))?;
        let [constant, linear, square] = [0, 1, 2].map(|degree| self.coefficient(degree));
        let place = negative(quotient(linear.clone(), product(vec![integer(2), square.clone()])));
        let least = quotient(power(linear, 2), product(vec![integer(4), square.clone()]));
        let mut terms = Vec::new();
        let mut needed = Vec::new();
        for degree in (0..=power_of_x).step_by(2) {
            let chosen =
                factorial(power_of_x.into()) / (factorial(degree.into()) * factorial((power_of_x - degree).into()));
            let term = Self {
                factor: product(vec![number(&chosen), power(place.clone(), power_of_x - degree)]),
                power: Exponent::number(Rational::from_integer(degree.into())),
                exponent: vec![integer(0), integer(0), square.clone()],
            };
            let (value, conditions) = term.over_all()?;
            terms.push(value);
            needed.extend(conditions);
        }
        let before = call("\\exp", difference(constant, least));
        Some((product(vec![self.factor.clone(), before, sum(terms)]), needed))
    }
}

/// `\Gamma(h)/a^h`, where that is written with factorials and the root of pi.
fn gamma_over_power(of: &Exponent, rate: &Tree) -> Option<Tree> {
    let half = Exponent::number(Rational::from_ratio(1, 2));
    if let Some(whole) = of.constant.to_integer() {
        let before = of.plus(&Exponent::number(Rational::from_integer(1)), -1);
        let above = match Some(whole).filter(|_| of.letters.is_empty()) {
            Some(whole) if !(1..=LARGEST).contains(&whole) => return None,
            Some(whole) => number(&factorial(whole - 1)),
            None => call(FACTORIAL, before.tree()),
        };
        return Some(quotient(above, of.power_of(rate.clone())));
    }
    // \Gamma(n + 1/2) = (2n)! \sqrt{\pi}/(4^n n!)
    let before = of.plus(&half, -1);
    let whole = before.constant.to_integer()?;
    let factor = match before.letters.is_empty() {
        true if !(0..=LARGEST).contains(&whole) => return None,
        true => {
            let above = factorial(2 * whole) / factorial(whole);
            let below = (0..whole).fold(Rational::from_integer(1), |total, _| total * Rational::from_integer(4));
            number(&(above / below))
        }
        false => {
            let twice = call(FACTORIAL, before.plus(&before, 1).tree());
            let below = product(vec![before.power_of(integer(4)), call(FACTORIAL, before.tree())]);
            quotient(twice, below)
        }
    };
    let pi = symbol(&plain("\\pi"));
    let below = before.power_of(rate.clone());
    Some(quotient(product(vec![factor, root(quotient(pi, rate.clone()))]), below))
}

/// The integral of a sum of powers times exponentials.
pub(super) struct Moments {
    pub value: Tree,
    /// The sum that the integrand must be.
    pub sum: Tree,
    /// Conditions for the value, besides that the integrand is the sum.
    pub needed: Vec<Equation>,
}

/// The integral of a sum of such terms between limits; None where it is no such sum, or the limits are others.
pub(super) fn moments(of: &Tree, by: &Name, [low, high]: [&Tree; 2], symbols: &Symbols) -> Option<Moments> {
    let is_half = match (infinity(low), infinity(high)) {
        (Some(false), Some(true)) => false,
        (None, Some(true)) if is_zero(low) => true,
        _ => return None,
    };
    let terms = Reader { by, symbols }.terms(of)?;
    let (mut values, mut needed) = (Vec::new(), Vec::new());
    for term in &terms {
        let (value, conditions) = if is_half {
            term.on_half_line()?
        } else {
            term.over_all()?
        };
        values.push(value);
        for condition in conditions {
            if !needed.contains(&condition) {
                needed.push(condition);
            }
        }
    }
    Some(Moments {
        value: sum(values),
        sum: sum(terms.iter().map(|term| term.tree(by)).collect()),
        needed,
    })
}

struct Reader<'a> {
    by: &'a Name,
    symbols: &'a Symbols,
}

impl Reader<'_> {
    fn power_of_letter(&self, tree: &Tree, exponent: Exponent) -> Option<Vec<Term>> {
        let is_letter = matches!(tree, Tree::Symbol(name, _) if name == self.by);
        is_letter.then(|| {
            let mut term = Term::constant(integer(1));
            term.power = exponent;
            vec![term]
        })
    }

    fn terms(&self, tree: &Tree) -> Option<Vec<Term>> {
        if !mentions(tree, self.by) {
            return Some(vec![Term::constant(tree.clone())]);
        }
        if let Some(exponent) = exponent_of_e(tree, self.symbols) {
            let mut term = Term::constant(integer(1));
            term.exponent = polynomial(exponent, self.by)?;
            return Some(vec![term]);
        }
        match tree {
            Tree::Symbol(..) => self.power_of_letter(tree, Exponent::number(Rational::from_integer(1))),
            Tree::Negate(inner) => self.multiplied([&integer(-1), &**inner].into_iter()),
            Tree::Sum(parts) => {
                let parts = parts.iter().map(|part| self.terms(part));
                let parts: Option<Vec<Vec<Term>>> = parts.collect();
                parts.map(|parts| parts.into_iter().flatten().collect())
            }
            Tree::Product(factors) => self.multiplied(factors.iter()),
            Tree::Power(base, exponent @ 0.., _) => {
                let exponent = usize::try_from(*exponent).ok().filter(|own| *own <= 24);
                match &**base {
                    Tree::Symbol(..) => {
                        let exponent = Rational::from_integer(i64::try_from(exponent?).ok()?);
                        self.power_of_letter(base, Exponent::number(exponent))
                    }
                    base => self.multiplied(std::iter::repeat_n(base, exponent?)),
                }
            }
            Tree::Power(base, exponent, _) => {
                let exponent = Rational::from_integer(i64::from(*exponent));
                self.power_of_letter(base, Exponent::number(exponent))
            }
            Tree::Root(radicand, index, _) => {
                let exponent = Rational::from_ratio(1, i64::from(*index));
                self.power_of_letter(radicand, Exponent::number(exponent))
            }
            Tree::RealPower(base, exponent, _) => self.power_of_letter(base, self.exponent(exponent)?),
            Tree::Quotient(above, below, _) => {
                let [below] = self.terms(below)?.try_into().ok()?;
                let below = below.inverse();
                Some(self.terms(above)?.iter().map(|term| term.times(&below)).collect())
            }
            _ => None,
        }
    }

    fn exponent(&self, tree: &Tree) -> Option<Exponent> {
        if let Some(constant) = number_of(tree) {
            return Some(Exponent::number(constant));
        }
        let (letters, constant) = linear(tree).filter(|_| is_integer(tree, self.symbols))?;
        Some(Exponent {
            letters,
            constant: Rational::from_integer(constant),
        })
    }

    fn multiplied<'t>(&self, factors: impl Iterator<Item = &'t Tree>) -> Option<Vec<Term>> {
        let mut total = vec![Term::constant(integer(1))];
        for factor in factors {
            let own = self.terms(factor)?;
            if total.len() * own.len() > MOST_TERMS {
                return None;
            }
            let products = total.iter().flat_map(|term| own.iter().map(|other| term.times(other)));
            total = products.collect();
        }
        Some(total)
    }
}

#[cfg(test)]
mod tests {
    use super::super::series::guess_at;
    use super::*;
    use texmath::{At, Names, Operation, read_expression};

    fn value_of(tex: &str, is_half: bool) -> Option<f64> {
        let names = Names::default();
        let tree = read_expression(tex, &names).unwrap();
        let above = Tree::Operation(Box::new(Operation::Infinity), At::default());
        let low = if is_half { integer(0) } else { negative(above.clone()) };
        let symbols = Symbols::new(names);
        let found = moments(&tree, &Name::plain("x"), [&low, &above], &symbols)?;
        guess_at(&found.value, &|_| None)
    }

    #[test]
    fn known_moments_are_found() {
        let root = std::f64::consts::PI.sqrt();
        for (tex, is_half, expected) in [
            ("x^3 e^{-x^2}", true, 0.5),
            ("x^2 e^{-2 x^2}", true, root / (8.0 * 2.0_f64.sqrt())),
            ("x^5 e^{-x^4}", true, root / 8.0),
            ("(x + 1)^4 e^{-x^2}", true, 4.0 + 19.0 * root / 8.0),
            (r"\sqrt{x} e^{-x}", true, root / 2.0),
            ("x e^{-x^2 + 2 x}", false, root * std::f64::consts::E),
            ("x^3 e^{-x^4}", false, 0.0),
            (r"\frac{x^5}{e^x}", true, 120.0),
        ] {
            let value = value_of(tex, is_half).unwrap_or(f64::NAN);
            assert!((value - expected).abs() < 1e-12, "{tex}: {value}");
        }
    }

    #[test]
    fn what_has_another_form_is_left_alone() {
        assert!(value_of("x^2", true).is_none() && value_of(r"e^{-x - x^2}", true).is_none());
        assert!(value_of("e^{-x^3}", false).is_none() && value_of(r"\sqrt[3]{x} e^{-x}", true).is_none());
    }
}
