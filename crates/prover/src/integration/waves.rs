//! Sums of `c x^k e^(a x) cos(b x + d)`, or with a sine: closed under products by the addition theorems, and each with an
//! antiderivative of the same kind.

use super::fraction::Fraction;
use super::tower::{Kind, Tower, VARIABLE};
use super::tree::{call, power, product, quotient, real_power, sum, symbol};
use crate::algebra::coefficients_in;
use kernel::Polynomial;
use numbers::{Field as _, Rational};
use texmath::{Name, Tree, speaks_of};

/// The most terms, and the highest power.
const MOST: usize = 300;
const HIGHEST: u32 = 24;

/// A term `factor x^degree e^(growth x) cos(slope x + phase)`, or with a sine.
#[derive(Clone, Debug, PartialEq)]
struct Wave {
    factor: Fraction,
    degree: u32,
    growth: Fraction,
    slope: Fraction,
    phase: Fraction,
    is_sine: bool,
}

fn minus() -> Rational {
    Rational::from_integer(-1)
}

impl Wave {
    fn constant(factor: Fraction) -> Self {
        let zero = Fraction::integer(0);
        Self {
            factor,
            degree: 0,
            growth: zero.clone(),
            slope: zero.clone(),
            phase: zero,
            is_sine: false,
        }
    }

    fn is_constant(&self) -> bool {
        self.slope.is_zero() && self.phase.is_zero()
    }

    fn is_like(&self, other: &Self) -> bool {
        let is_same = self.degree == other.degree && self.is_sine == other.is_sine;
        is_same && self.slope == other.slope && self.phase == other.phase && self.growth == other.growth
    }

    /// The wave with a leading coefficient of its slope, or of its phase, that is positive.
    fn turned(mut self) -> Self {
        let leading = if self.slope.is_zero() { &self.phase } else { &self.slope };
        let is_negative = leading
            .above
            .terms()
            .last()
            .is_some_and(|(_, value)| *value < dashu_ratio::RBig::ZERO);
        if is_negative {
            self.slope = self.slope.scaled(&minus());
            self.phase = self.phase.scaled(&minus());
            if self.is_sine {
                self.factor = self.factor.scaled(&minus());
            }
        }
        if self.is_sine && self.is_constant() {
            self.factor = Fraction::integer(0);
        }
        self
    }

    fn times(&self, other: &Self, tower: &mut Tower) -> Option<Vec<Self>> {
        let mut whole = self.clone();
        whole.factor = tower.times(&self.factor, &other.factor)?;
        whole.degree += other.degree;
        whole.growth = self.growth.plus(&other.growth, &mut tower.steps)?;
        if self.is_constant() || other.is_constant() {
            let wave = if self.is_constant() { other } else { self };
            whole.slope = wave.slope.clone();
            whole.phase = wave.phase.clone();
            whole.is_sine = wave.is_sine;
            return Some(vec![whole]);
        }
        whole.factor = whole.factor.scaled(&Rational::from_ratio(1, 2));
        let part = |sign: i64, is_sine: bool, factor: i64, tower: &mut Tower| {
            let sign = Rational::from_integer(sign);
            let mut part = whole.clone();
            part.slope = self.slope.plus(&other.slope.scaled(&sign), &mut tower.steps)?;
            part.phase = self.phase.plus(&other.phase.scaled(&sign), &mut tower.steps)?;
            part.is_sine = is_sine;
            part.factor = part.factor.scaled(&Rational::from_integer(factor));
            Some(part.turned())
        };
        let [less, more] = match (self.is_sine, other.is_sine) {
            (false, false) => [part(-1, false, 1, tower)?, part(1, false, 1, tower)?],
            (true, true) => [part(-1, false, 1, tower)?, part(1, false, -1, tower)?],
            (true, false) => [part(-1, true, 1, tower)?, part(1, true, 1, tower)?],
            (false, true) => [part(-1, true, -1, tower)?, part(1, true, 1, tower)?],
        };
        Some(vec![less, more])
    }

    /// The terms of an antiderivative.
    fn integrated(&self, tower: &mut Tower) -> Option<Vec<Self>> {
        if self.growth.is_zero() && self.slope.is_zero() {
            let mut whole = self.clone();
            whole.degree += 1;
            whole.factor = whole.factor.scaled(&Rational::from_ratio(1, i64::from(whole.degree)));
            return Some(vec![whole]);
        }
        let (growth, slope) = (
            tower.times(&self.growth, &self.growth)?,
            tower.times(&self.slope, &self.slope)?,
        );
        let size = growth.plus(&slope, &mut tower.steps)?;
        let over = tower.over(&self.factor, &size)?;
        let mut same = self.clone();
        same.factor = tower.times(&over, &self.growth)?;
        let mut other = self.clone();
        other.is_sine = !self.is_sine;
        let sign = Rational::from_integer(if self.is_sine { -1 } else { 1 });
        other.factor = tower.times(&over, &self.slope)?.scaled(&sign);
        let mut all = vec![same, other];
        if self.degree > 0 {
            for part in all.clone() {
                let mut part = part;
                part.factor = part.factor.scaled(&Rational::from_integer(-i64::from(self.degree)));
                part.degree -= 1;
                all.extend(part.integrated(tower)?);
            }
        }
        gathered(all, tower)
    }

    fn tree(&self, tower: &Tower) -> Option<Tree> {
        let x = Fraction::generator(VARIABLE);
        let mut steps = tower.steps.clone();
        let part = |p: &Polynomial| tower.print(&Fraction::of(p.clone()), &[]);
        let mut factors = vec![part(&self.factor.above)?, power(symbol(tower.by), self.degree)];
        if !self.growth.is_zero() {
            let exponent = self.growth.times(&x, &mut steps)?;
            factors.push(real_power(symbol(&Name::plain("e")), tower.print(&exponent, &[])?));
        }
        let angle = self.slope.times(&x, &mut steps)?.plus(&self.phase, &mut steps)?;
        if self.is_sine || !angle.is_zero() {
            let function = if self.is_sine { "\\sin" } else { "\\cos" };
            factors.push(call(function, tower.print(&angle, &[])?));
        }
        Some(quotient(product(factors), part(&self.factor.below)?))
    }
}

/// The terms with like ones added; `None` where they are too many.
fn gathered(terms: Vec<Wave>, tower: &mut Tower) -> Option<Vec<Wave>> {
    let mut total: Vec<Wave> = Vec::new();
    for term in terms {
        tower.steps.take(5 * (1 + total.len() as u64)).ok()?;
        match total.iter_mut().find(|known| known.is_like(&term)) {
            Some(known) => known.factor = known.factor.plus(&term.factor, &mut tower.steps)?,
            None => total.push(term),
        }
    }
    total.retain(|term| !term.factor.is_zero());
    (total.len() <= MOST).then_some(total)
}

/// An antiderivative of a tree that is such a sum.
pub(super) fn integrated(tree: &Tree, tower: &mut Tower) -> Option<Tree> {
    if tower.symbols.declares(&Name::plain("e")) {
        return None;
    }
    let mut all = Vec::new();
    for term in read(tree, tower)? {
        all.extend(term.integrated(tower)?);
    }
    let all = gathered(all, tower)?;
    Some(sum(all.iter().map(|term| term.tree(tower)).collect::<Option<_>>()?))
}

/// The constant and the slope of what is linear.
pub(super) fn linear(tree: &Tree, tower: &mut Tower) -> Option<(Fraction, Fraction)> {
    let f = tower.read_all(tree)?;
    let mut list = coefficients_in(&f.above, VARIABLE);
    list.resize(list.len().max(2), Default::default());
    let [constant, slope] = list.as_slice() else {
        return None;
    };
    let over = |p: &Polynomial, tower: &mut Tower| {
        let part = Fraction::new(p, &f.below, &mut tower.steps)?;
        let varies = part.generators().iter().any(|term| tower.varies(*term));
        (!varies).then_some(part)
    };
    Some((over(constant, tower)?, over(slope, tower)?))
}

fn read(tree: &Tree, tower: &mut Tower) -> Option<Vec<Wave>> {
    if !speaks_of(tree, tower.by) {
        let factor = tower.read_all(tree)?;
        return gathered(vec![Wave::constant(factor)], tower);
    }
    match tree {
        Tree::Symbol(..) => {
            let mut one = Wave::constant(Fraction::integer(1));
            one.degree = 1;
            Some(vec![one])
        }
        Tree::Negate(inner) => multiplied(&[(**inner).clone()], Wave::constant(Fraction::integer(-1)), tower),
        Tree::Sum(parts) => {
            let mut total = Vec::new();
            for part in parts {
                total.extend(read(part, tower)?);
            }
            gathered(total, tower)
        }
        Tree::Product(factors) => multiplied(factors, Wave::constant(Fraction::integer(1)), tower),
        Tree::Power(base, exponent, _) if (1..=12).contains(exponent) => {
            let factors: Vec<Tree> = (0..*exponent).map(|_| (**base).clone()).collect();
            multiplied(&factors, Wave::constant(Fraction::integer(1)), tower)
        }
        Tree::Quotient(above, below, _) if !speaks_of(below, tower.by) => {
            let below = tower.read_all(below)?;
            let over = tower.over(&Fraction::integer(1), &below)?;
            multiplied(&[(**above).clone()], Wave::constant(over), tower)
        }
        Tree::RealPower(base, exponent, _) if matches!(&**base, Tree::Symbol(name, _) if *name == Name::plain("e")) => {
            exponential(exponent, tower)
        }
        Tree::Call(name, argument, _) => match name.base.as_str() {
            "\\exp" => exponential(argument, tower),
            "\\sin" | "\\cos" => {
                let (phase, slope) = linear(argument, tower)?;
                let mut wave = Wave::constant(Fraction::integer(1));
                wave.is_sine = name.base == "\\sin";
                (wave.phase, wave.slope) = (phase, slope);
                gathered(vec![wave.turned()], tower)
            }
            _ => None,
        },
        _ => None,
    }
}

fn exponential(exponent: &Tree, tower: &mut Tower) -> Option<Vec<Wave>> {
    let (constant, growth) = linear(exponent, tower)?;
    let factor = match constant.is_zero() {
        true => Fraction::integer(1),
        false => Fraction::generator(tower.term_of(Kind::Exponential(constant))),
    };
    let mut wave = Wave::constant(factor);
    wave.growth = growth;
    Some(vec![wave])
}

fn multiplied(factors: &[Tree], start: Wave, tower: &mut Tower) -> Option<Vec<Wave>> {
    let mut total = vec![start];
    for factor in factors {
        let own = read(factor, tower)?;
        let mut next = Vec::new();
        for term in &total {
            for other in &own {
                next.extend(term.times(other, tower)?);
            }
        }
        total = gathered(next, tower)?;
        if total.iter().any(|term| term.degree > HIGHEST) {
            return None;
        }
    }
    Some(total)
}
