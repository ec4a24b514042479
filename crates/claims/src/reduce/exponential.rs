//! Sums of `c x^k e^(a x) cos(b x + d)`, or with a sine: closed under products by the addition theorems, and each with an
//! antiderivative of the same kind.
//!
//! Nothing rests on what is found: it is shown to be an antiderivative.

use super::build::{call, integer, negative, power, product, quotient, sum, symbol};
use super::derivative::mentions;
use numbers::{Field, Rational};
use texmath::{Name, Tree, number_of};

/// The most terms, the highest power of x, and the highest beside both an exponential and a wave.
const MOST: usize = 120;
const HIGHEST: u32 = 24;
const HIGHEST_DAMPED: u32 = 6;

/// A sum of rational multiples of trees, none of them 0.
#[derive(Clone, Debug, Default, PartialEq)]
struct Combination(Vec<(Tree, Rational)>);

impl Combination {
    fn of(tree: &Tree) -> Self {
        let mut found = Self::default();
        found.collect(tree, &Rational::from_integer(1));
        found
    }

    fn add(&mut self, tree: Tree, factor: &Rational) {
        match self.0.iter_mut().find(|(known, _)| *known == tree) {
            Some((_, sum)) => *sum += factor.clone(),
            None => self.0.push((tree, factor.clone())),
        }
        self.0.retain(|(_, factor)| *factor != Rational::from_integer(0));
    }

    fn collect(&mut self, tree: &Tree, factor: &Rational) {
        match tree {
            Tree::Sum(terms) => terms.iter().for_each(|term| self.collect(term, factor)),
            Tree::Negate(inner) => self.collect(inner, &(Rational::from_integer(0) - factor.clone())),
            tree => match number_of(tree) {
                Some(value) => self.add(integer(1), &(value * factor.clone())),
                None => self.collect_product(tree, factor),
            },
        }
    }

    fn collect_product(&mut self, tree: &Tree, factor: &Rational) {
        match tree {
            Tree::Product(factors) => {
                let (mut number, mut rest) = (factor.clone(), Vec::new());
                for part in factors {
                    match number_of(part) {
                        Some(value) => number *= value,
                        None => rest.push(part.clone()),
                    }
                }
                match rest.as_slice() {
                    [one] => self.collect(one, &number),
                    _ => self.add(product(rest), &number),
                }
            }
            Tree::Quotient(above, below, _) => match number_of(below) {
                Some(value) if value != Rational::from_integer(0) => self.collect(above, &(factor.clone() / value)),
                _ => {
                    let mut over = Self::default();
                    over.collect(above, factor);
                    for (tree, factor) in over.0 {
                        self.add(quotient(tree, (**below).clone()), &factor);
                    }
                }
            },
            tree => self.add(tree.clone(), factor),
        }
    }

    fn plus(&self, other: &Self, factor: i64) -> Self {
        let mut total = self.clone();
        for (tree, own) in &other.0 {
            total.add(tree.clone(), &(own.clone() * Rational::from_integer(factor)));
        }
        total
    }

    fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    fn tree(&self) -> Tree {
        sum(self
            .0
            .iter()
            .map(|(tree, factor)| times(factor, tree.clone()))
            .collect())
    }
}

fn times(factor: &Rational, tree: Tree) -> Tree {
    let zero = Rational::from_integer(0);
    match *factor < zero {
        true => negative(product(vec![Tree::Number(zero - factor.clone()), tree])),
        false => product(vec![Tree::Number(factor.clone()), tree]),
    }
}

/// A sine or a cosine of `slope x + phase`; the slope is not 0.
#[derive(Clone, Debug, PartialEq)]
struct Wave {
    is_sine: bool,
    slope: Combination,
    phase: Combination,
}

/// `number factors x^degree e^(growth x) wave`.
#[derive(Clone, Debug, PartialEq)]
struct Term {
    number: Rational,
    factors: Vec<Tree>,
    degree: u32,
    growth: Combination,
    wave: Option<Wave>,
}

impl Term {
    fn constant(number: Rational, factors: Vec<Tree>) -> Self {
        Self {
            number,
            factors,
            degree: 0,
            growth: Combination::default(),
            wave: None,
        }
    }

    /// A sine or cosine, which is a constant where its argument does not move.
    fn of_wave(wave: Wave) -> Self {
        let one = Self::constant(Rational::from_integer(1), Vec::new());
        match (wave.slope.is_zero(), wave.phase.is_zero(), wave.is_sine) {
            (false, ..) => Self {
                wave: Some(wave),
                ..one
            },
            (true, true, is_sine) => Self {
                number: Rational::from_integer(i64::from(!is_sine)),
                ..one
            },
            (true, false, is_sine) => Self {
                factors: vec![call(if is_sine { "\\sin" } else { "\\cos" }, wave.phase.tree())],
                ..one
            },
        }
    }

    fn is_like(&self, other: &Self) -> bool {
        let number = other.number.clone();
        Self { number, ..self.clone() } == *other
    }

    fn times(&self, other: &Self) -> Option<Vec<Self>> {
        let base = Self {
            number: self.number.clone() * other.number.clone(),
            factors: self.factors.iter().chain(&other.factors).cloned().collect(),
            degree: self
                .degree
                .checked_add(other.degree)
                .filter(|degree| *degree <= HIGHEST)?,
            growth: self.growth.plus(&other.growth, 1),
            wave: None,
        };
        let (one, two) = match (&self.wave, &other.wave) {
            (None, None) => return Some(vec![base]),
            (Some(wave), None) | (None, Some(wave)) => {
                let wave = Some(wave.clone());
                return Some(vec![Self { wave, ..base }]);
            }
            (Some(one), Some(two)) => (one, two),
        };
        // the sum and the difference of the arguments, each with half the product
        let wave = |sign: i64| {
            Self::of_wave(Wave {
                is_sine: one.is_sine != two.is_sine,
                slope: one.slope.plus(&two.slope, sign),
                phase: one.phase.plus(&two.phase, sign),
            })
        };
        let signs = match (one.is_sine, two.is_sine) {
            (false, false) | (true, false) => [1, 1],
            (true, true) => [-1, 1],
            (false, true) => [1, -1],
        };
        let mut out = Vec::new();
        for (part, sign) in [(wave(1), signs[0]), (wave(-1), signs[1])] {
            let half = base.number.clone() * Rational::from_ratio(sign, 2);
            out.push(Self {
                number: part.number.clone() * half,
                factors: base.factors.iter().cloned().chain(part.factors).collect(),
                wave: part.wave,
                ..base.clone()
            });
        }
        Some(out)
    }

    /// `x^degree` times exponential and wave, with or without a coefficient.
    fn tree(&self, by: &Name) -> Tree {
        let argument = |slope: &Combination| product(vec![slope.tree(), symbol(by)]);
        let mut factors = self.factors.clone();
        factors.push(power(symbol(by), i32::try_from(self.degree).unwrap_or(0)));
        if !self.growth.is_zero() {
            factors.push(call("\\exp", argument(&self.growth)));
        }
        if let Some(wave) = &self.wave {
            let name = if wave.is_sine { "\\sin" } else { "\\cos" };
            factors.push(call(name, sum(vec![argument(&wave.slope), wave.phase.tree()])));
        }
        times(&self.number, product(factors))
    }

    /// An antiderivative, by parts: x^k w is the derivative of x^k W but for k x^(k-1) W.
    fn integrated(&self, by: &Name) -> Option<Tree> {
        let next = i64::from(self.degree) + 1;
        let growth = (!self.growth.is_zero()).then(|| self.growth.tree());
        let turned = self.wave.as_ref().map(|wave| Self {
            wave: Some(Wave {
                is_sine: !wave.is_sine,
                ..wave.clone()
            }),
            ..self.clone()
        });
        let is_sine = self.wave.as_ref().is_some_and(|wave| wave.is_sine);
        let slope = self.wave.as_ref().map(|wave| wave.slope.tree());
        // the antiderivative W of the rest as multiples of terms
        let parts: Vec<(Tree, Self)> = match (growth, slope, turned) {
            (None, Some(slope), Some(turned)) => {
                let over = quotient(integer(if is_sine { -1 } else { 1 }), slope);
                vec![(over, turned)]
            }
            (Some(growth), Some(slope), Some(turned)) => {
                if self.degree > HIGHEST_DAMPED {
                    return None;
                }
                let below = sum(vec![power(growth.clone(), 2), power(slope.clone(), 2)]);
                let slope = if is_sine { negative(slope) } else { slope };
                vec![
                    (quotient(growth, below.clone()), self.clone()),
                    (quotient(slope, below), turned),
                ]
            }
            (Some(growth), ..) => vec![(quotient(integer(1), growth), self.clone())],
            (None, ..) => {
                let whole = Self {
                    degree: self.degree.checked_add(1)?,
                    ..self.clone()
                };
                return Some(quotient(whole.tree(by), integer(next)));
            }
        };
        let mut terms = Vec::new();
        for (factor, part) in parts {
            terms.push(product(vec![factor.clone(), part.tree(by)]));
            if let Some(degree) = part.degree.checked_sub(1) {
                let less = Self { degree, ..part.clone() }.integrated(by)?;
                terms.push(negative(product(vec![integer(i64::from(part.degree)), factor, less])));
            }
        }
        Some(sum(terms))
    }
}

/// An antiderivative of a sum of such terms, by `by`; `exponent` is that of a power of e, `linear` the constant and the
/// slope of what is linear.
pub(super) struct Terms<'a> {
    pub by: &'a Name,
    pub exponent: &'a dyn Fn(&Tree) -> Option<Tree>,
    pub linear: &'a dyn Fn(&Tree) -> Option<(Tree, Tree)>,
}

impl Terms<'_> {
    pub fn integrated(&self, tree: &Tree) -> Option<Tree> {
        let terms = self.of(tree)?;
        let parts = terms.iter().map(|term| term.integrated(self.by));
        Some(sum(parts.collect::<Option<_>>()?))
    }

    fn of(&self, tree: &Tree) -> Option<Vec<Term>> {
        let one = || Rational::from_integer(1);
        if !mentions(tree, self.by) {
            return Some(match number_of(tree) {
                Some(number) => vec![Term::constant(number, Vec::new())],
                None => vec![Term::constant(one(), vec![tree.clone()])],
            });
        }
        if let Some(exponent) = (self.exponent)(tree) {
            let (constant, slope) = (self.linear)(&exponent)?;
            let constant = Combination::of(&constant);
            let factors = match constant.is_zero() {
                true => Vec::new(),
                false => vec![call("\\exp", constant.tree())],
            };
            let growth = Combination::of(&slope);
            return Some(vec![Term {
                growth,
                ..Term::constant(one(), factors)
            }]);
        }
        match tree {
            Tree::Symbol(..) => Some(vec![Term {
                degree: 1,
                ..Term::constant(one(), Vec::new())
            }]),
            Tree::Negate(inner) => self.scaled(inner, &Term::constant(Rational::from_integer(-1), Vec::new())),
            Tree::Sum(parts) => {
                let mut total = Vec::new();
                for part in parts {
                    total.extend(self.of(part)?);
                }
                gathered(total)
            }
            Tree::Product(factors) => self.multiplied(factors),
            Tree::Power(base, exponent @ 1..=12, _) => {
                let factors: Vec<Tree> = (0..*exponent).map(|_| (**base).clone()).collect();
                self.multiplied(&factors)
            }
            Tree::Quotient(above, below, _) if !mentions(below, self.by) => {
                let over = quotient(integer(1), (**below).clone());
                let over = match number_of(&over) {
                    Some(number) => Term::constant(number, Vec::new()),
                    None => Term::constant(one(), vec![over]),
                };
                self.scaled(above, &over)
            }
            Tree::Call(name, argument, _) => {
                let (constant, slope) = (self.linear)(argument)?;
                let (slope, phase) = (Combination::of(&slope), Combination::of(&constant));
                match name.base.as_str() {
                    "\\sin" | "\\cos" => Some(vec![Term::of_wave(Wave {
                        is_sine: name.base == "\\sin",
                        slope,
                        phase,
                    })]),
                    _ => None,
                }
            }
            _ => None,
        }
    }

    fn scaled(&self, tree: &Tree, factor: &Term) -> Option<Vec<Term>> {
        let mut total = Vec::new();
        for term in self.of(tree)? {
            total.extend(term.times(factor)?);
        }
        Some(total)
    }

    fn multiplied(&self, factors: &[Tree]) -> Option<Vec<Term>> {
        let mut total = vec![Term::constant(Rational::from_integer(1), Vec::new())];
        for factor in factors {
            let mut next = Vec::new();
            let own = self.of(factor)?;
            for term in &total {
                for other in &own {
                    next.extend(term.times(other)?);
                }
            }
            total = gathered(next)?;
        }
        Some(total)
    }
}

/// The terms with like ones added; `None` where they are too many.
fn gathered(terms: Vec<Term>) -> Option<Vec<Term>> {
    let mut total: Vec<Term> = Vec::new();
    for term in terms {
        match total.iter_mut().find(|known| known.is_like(&term)) {
            Some(known) => known.number += term.number,
            None => total.push(term),
        }
    }
    total.retain(|term| term.number != Rational::from_integer(0));
    (total.len() <= MOST).then_some(total)
}

#[cfg(test)]
mod tests {
    use super::super::super::symbols::RawSymbols;
    use super::super::antiderivative::antiderivative;
    use super::super::build::plain;
    use texmath::{Names, read_expression};

    fn found(tex: &str) -> Option<String> {
        let tree = read_expression(tex, &Names::default()).unwrap();
        let symbols = RawSymbols::default().read().unwrap();
        antiderivative(&tree, &plain("x"), &symbols).map(|whole| whole.to_string())
    }

    #[test]
    fn products_of_waves_are_sums_of_waves() {
        assert_eq!(found(r"\sin x \cos x").unwrap(), r"\frac{-1}{2} [0.5 \cos(2 x)]");
        for tex in [
            r"\cos^4 x",
            r"\sin m x \cos n x",
            r"x e^{-x} \sin x",
            r"(e^{-x} \cos x)^2",
            r"(x + \sin x)^2",
        ] {
            assert!(found(tex).is_some(), "{tex}");
        }
        for tex in [r"\cos x^2", r"\frac{\sin x}{x}", r"\cos^{13} x \sin^{13} x"] {
            assert!(found(tex).is_none(), "{tex}");
        }
    }
}
