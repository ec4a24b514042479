//! Logarithms and angles that an antiderivative may hold besides a rational part.

use super::field::Field;
use super::fraction::{Fraction, times};
use super::tangents::without_tangents;
use super::tower::{Kind, Tower, VARIABLE};
use super::tree::{call, negative, product, quotient, sum};
use crate::algebra::{coefficients_in, rational_root};
use dashu_ratio::RBig;
use kernel::{Monomial, Polynomial, Term};
use num_traits::Zero;
use numbers::{Field as _, Rational};
use texmath::{Tree, number_of};

/// The spelling of a logarithm whose argument may be negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Logarithms {
    Plain,
    Absolute,
    Opposite,
}

/// A function with its derivative: an angle, or a logarithm of the argument.
#[derive(Debug)]
pub(super) enum Function {
    Whole(Tree),
    /// The factor before the logarithm, its argument, and whether this is negative at a usual point.
    Logarithm(Option<Box<Tree>>, Box<Tree>, bool),
    /// The first, with the second added or subtracted, times what is given.
    Pair(Option<Tree>, Box<[Function; 2]>),
}

/// A function that an antiderivative may hold, times a constant.
#[derive(Debug)]
pub(super) struct Candidate {
    pub slope: Fraction,
    pub function: Function,
}

impl Candidate {
    pub fn tree(&self, spelling: Logarithms) -> Tree {
        self.function.tree(spelling)
    }
}

impl Function {
    fn tree(&self, spelling: Logarithms) -> Tree {
        match self {
            Self::Whole(tree) => tree.clone(),
            Self::Logarithm(factor, argument, is_negative) => {
                let argument = (**argument).clone();
                let argument = match spelling {
                    Logarithms::Absolute => call("\\abs", argument),
                    Logarithms::Plain if *is_negative => opposite(argument),
                    Logarithms::Opposite if !*is_negative => opposite(argument),
                    _ => argument,
                };
                let logarithm = call("\\ln", argument);
                match factor {
                    Some(factor) => product(vec![(**factor).clone(), logarithm]),
                    None => logarithm,
                }
            }
            Self::Pair(factor, pair) => {
                let [first, second] = pair.as_ref();
                let (first, second) = (first.tree(spelling), second.tree(spelling));
                match factor {
                    Some(factor) => product(vec![factor.clone(), sum(vec![first, negative(second)])]),
                    None => sum(vec![first, second]),
                }
            }
        }
    }
}

/// The opposite, of a sum term by term.
pub(super) fn opposite(tree: Tree) -> Tree {
    match tree {
        Tree::Sum(terms) => {
            let mut terms: Vec<Tree> = terms.into_iter().map(negative).collect();
            let is_negative = |term: &Tree| matches!(term, Tree::Negate(_)) || number_of(term) < Some(Rational::zero());
            terms.sort_by_key(is_negative);
            sum(terms)
        }
        Tree::Quotient(above, below, at) => Tree::Quotient(Box::new(opposite(*above)), below, at),
        tree => negative(tree),
    }
}

/// The points at which signs are told.
const POINTS: [f64; 4] = [0.37, 0.83, 1.4, 3.2];

impl Field {
    pub fn candidates(&self, tower: &mut Tower) -> Option<Vec<Candidate>> {
        let mut all = Vec::new();
        for divisor in self.divisors.iter().filter(|divisor| !divisor.is_special) {
            all.extend(self.logarithm(&divisor.factor, tower));
            all.extend(self.angle(&divisor.factor, tower));
            all.extend(self.angle_of_squares(&divisor.factor, tower));
            all.extend(self.quartic(&divisor.factor, tower).unwrap_or_default());
        }
        for tangent in &self.tangents {
            let argument = Fraction::of(tangent.inverse_of_secant());
            let slope = tangent.slope_of_secant(tower)?.scaled(&tangent.power_of_inverse());
            let slope = self.in_tangents(&slope, tower)?;
            all.push(Candidate {
                slope,
                function: self.logarithm_of(None, &argument, tower)?,
            });
            let [_, _, angle] = tangent.doubled(tower)?;
            all.extend(self.argument(&angle, tower));
        }
        for term in &self.generators {
            match tower.kind(*term).clone() {
                Kind::Exponential(argument) => all.extend(self.argument(&argument, tower)),
                Kind::Root(radicand, 2) => all.extend(self.of_root(*term, &radicand, tower)),
                _ => {}
            }
        }
        Some(all)
    }

    pub(super) fn in_tangents(&self, f: &Fraction, tower: &mut Tower) -> Option<Fraction> {
        self.tangents
            .iter()
            .try_fold(f.clone(), |f, tangent| tangent.put_in(&f, tower))
    }

    /// The argument of an exponential or a sine, where it is none of the generators.
    fn argument(&self, argument: &Fraction, tower: &mut Tower) -> Option<Candidate> {
        let slope = tower.derivative(argument)?;
        let is_known = slope.generators().iter().all(|term| !tower.varies(*term)) || slope.is_zero();
        let slope = self.in_tangents(&slope, tower)?;
        let tree = tower.print(argument, &[])?;
        (!is_known).then_some(Candidate {
            slope,
            function: Function::Whole(tree),
        })
    }

    fn logarithm_of(&self, factor: Option<Tree>, argument: &Fraction, tower: &mut Tower) -> Option<Function> {
        let values = POINTS.iter().filter_map(|point| tower.value_at(argument, *point));
        let negative = values.clone().filter(|value| *value < 0.0).count();
        let is_negative = 2 * negative > values.count();
        let argument = Box::new(tower.print(argument, &[])?);
        Some(Function::Logarithm(factor.map(Box::new), argument, is_negative))
    }

    /// The logarithm of a factor below, of tangents with a power of the cosine.
    pub(super) fn logarithm(&self, factor: &Polynomial, tower: &mut Tower) -> Option<Candidate> {
        let mut argument = factor.clone();
        let is_odd = |p: &Polynomial| {
            let mut tangents = self.tangents.iter();
            tangents.any(|tangent| tangent.made_whole_is_odd(p))
        };
        let times_two = is_odd(&argument);
        if times_two {
            argument = times(factor, factor, &mut tower.steps).ok()?;
        }
        let above = tower.derivative_of(&argument)?;
        let above = self.in_tangents(&above, tower)?;
        let mut slope = tower.over(&above, &Fraction::of(argument.clone()))?;
        for tangent in &self.tangents {
            let (whole, degree) = tangent.made_whole(&argument, tower)?;
            argument = whole;
            let part = tangent
                .slope_of_secant(tower)?
                .scaled(&Rational::from_integer(-i64::from(degree)));
            let part = self.in_tangents(&part, tower)?;
            slope = slope.plus(&part, &mut tower.steps)?;
        }
        Some(Candidate {
            slope,
            function: self.logarithm_of(None, &Fraction::of(argument), tower)?,
        })
    }

    /// The antiderivative of `g'/factor` for a quadratic factor in the generator g: an angle, or a logarithm.
    fn angle(&self, factor: &Polynomial, tower: &mut Tower) -> Option<Candidate> {
        let term = &self.only_generator(factor)?;
        let coefficients = coefficients_in(factor, *term);
        let [last, middle, first] = coefficients.as_slice() else {
            return None;
        };
        let parts = [first, middle, last].map(|p| Fraction::of(p.clone()));
        let slope = tower.slope(*term)?;
        let slope = self.in_tangents(&slope, tower)?;
        let slope = tower.over(&slope, &Fraction::of(factor.clone()))?;
        let function = self.reciprocal(*term, parts, tower)?;
        Some(Candidate { slope, function })
    }

    /// The arctangent of u/v for a factor `u^2 + v^2` of two terms.
    fn angle_of_squares(&self, factor: &Polynomial, tower: &mut Tower) -> Option<Candidate> {
        let [one, other] = factor.terms() else { return None };
        let side = |(monomial, value): &(Monomial, RBig)| {
            let half = monomial.iter().map(|(term, exponent)| {
                let is_tangent = self.tangents.iter().any(|tangent| tangent.tangent == *term);
                (exponent % 2 == 0 && !is_tangent).then_some((*term, exponent / 2))
            });
            Some(Polynomial::from_terms([(
                half.collect::<Option<Monomial>>()?,
                rational_root(value)?,
            )]))
        };
        let (one, other) = (Fraction::of(side(one)?), Fraction::of(side(other)?));
        let ratio = tower.over(&one, &other)?;
        if ratio.above.degree() + ratio.below.degree() < 2 {
            return None;
        }
        let square = tower
            .times(&ratio, &ratio)?
            .plus(&Fraction::integer(1), &mut tower.steps)?;
        let slope = tower.derivative(&ratio)?;
        let slope = tower.over(&slope, &square)?;
        Some(Candidate {
            slope: self.in_tangents(&slope, tower)?,
            function: Function::Whole(call("\\arctan", tower.print(&ratio, &[])?)),
        })
    }

    /// The antiderivative of `t'/(a t^2 + b t + c)`.
    pub(super) fn reciprocal(&self, term: Term, [a, b, c]: [Fraction; 3], tower: &mut Tower) -> Option<Function> {
        let four = Rational::from_integer(-4);
        let part = tower.times(&a, &c)?.scaled(&four);
        let discriminant = tower.times(&b, &b)?.plus(&part, &mut tower.steps)?;
        let value = tower.value_at(&discriminant, 1.0)?;
        let minus = Rational::from_integer(-1);
        Some(match value < 0.0 {
            true => {
                let positive = discriminant.scaled(&minus);
                let root = tower.root(&positive, 2)?;
                let is_negative = tower.value_at(&a, 1.0)? < 0.0;
                let parts = match is_negative {
                    true => [a.scaled(&minus), b.scaled(&minus), c.scaled(&minus)],
                    false => [a, b, c],
                };
                let angle = self.angle_tree(term, &parts, &root, tower)?;
                let two = Rational::from_integer(if is_negative { -2 } else { 2 });
                let before = tower.over(&Fraction::constant(&two), &root)?;
                Function::Whole(product(vec![tower.print(&before, &[])?, angle]))
            }
            false => self.ratio(term, &[a, b], &discriminant, tower)?,
        })
    }

    /// `\arctan((2 a t + b)/root)`, of a tangent without jumps.
    fn angle_tree(&self, term: Term, [a, b, c]: &[Fraction; 3], root: &Fraction, tower: &mut Tower) -> Option<Tree> {
        let minus = Rational::from_integer(-1);
        let Some(tangent) = self.tangents.iter().find(|tangent| tangent.tangent == term) else {
            let linear = tower.times(&a.scaled(&Rational::from_integer(2)), &Fraction::generator(term))?;
            let above = linear.plus(b, &mut tower.steps)?;
            let inside = tower.over(&above, root)?;
            return Some(call("\\arctan", tower.print(&inside, &[])?));
        };
        let [sine, cosine, angle] = tangent.doubled(tower)?;
        let (less, sum_of) = (
            a.plus(&c.scaled(&minus), &mut tower.steps)?,
            a.plus(c, &mut tower.steps)?.plus(root, &mut tower.steps)?,
        );
        let above = less.times(&sine, &mut tower.steps)?;
        let above = above.plus(&b.times(&cosine, &mut tower.steps)?, &mut tower.steps)?;
        let below = less.scaled(&minus).times(&cosine, &mut tower.steps)?;
        let below = below.plus(&b.times(&sine, &mut tower.steps)?, &mut tower.steps)?;
        let below = below.plus(&sum_of, &mut tower.steps)?;
        let angle = tower.print(&angle, &[])?;
        if above.is_zero() {
            return Some(angle);
        }
        let inside = quotient(tower.print(&above, &[])?, tower.print(&below, &[])?);
        Some(sum(vec![angle, call("\\arctan", inside)]))
    }

    /// `\ln((2 a t + b - r)/(2 a t + b + r))/r`, with the root r of the discriminant.
    fn ratio(
        &self,
        term: Term,
        [a, b]: &[Fraction; 2],
        discriminant: &Fraction,
        tower: &mut Tower,
    ) -> Option<Function> {
        let root = tower.root(discriminant, 2)?;
        let linear = tower.times(&a.scaled(&Rational::from_integer(2)), &Fraction::generator(term))?;
        let linear = linear.plus(b, &mut tower.steps)?;
        let above = linear.plus(&root.scaled(&Rational::from_integer(-1)), &mut tower.steps)?;
        let below = linear.plus(&root, &mut tower.steps)?;
        let ratio = Fraction::new(&above.above, &below.above, &mut tower.steps)?;
        let ratio = without_tangents(&self.tangents, &ratio, tower)?;
        let before = tower.over(&Fraction::integer(1), &root)?;
        let before = tower.print(&before, &[])?;
        self.logarithm_of(Some(before), &ratio, tower)
    }

    /// The antiderivatives of `1/y` and `1/((x - r) y)` for the root y of a quadratic.
    fn of_root(&self, root: Term, radicand: &Polynomial, tower: &mut Tower) -> Vec<Candidate> {
        let mut all = Vec::new();
        let coefficients = coefficients_in(radicand, VARIABLE);
        let [last, middle, first] = coefficients.as_slice() else {
            return all;
        };
        if [last, middle, first].iter().any(|p| self.varies(p)) {
            return all;
        }
        all.extend(self.reciprocal_of_root(root, radicand, [first, middle], tower));
        for divisor in &self.divisors {
            let linear = coefficients_in(&divisor.factor, VARIABLE);
            if let [constant, slope] = linear.as_slice()
                && !self.varies(constant)
                && !self.varies(slope)
            {
                all.extend(self.over_linear(root, radicand, [constant, slope], tower));
            }
        }
        all
    }

    fn reciprocal_of_root(
        &self,
        root: Term,
        radicand: &Polynomial,
        [a, b]: [&Polynomial; 2],
        tower: &mut Tower,
    ) -> Option<Candidate> {
        let y = Fraction::generator(root);
        let whole = Fraction::of(radicand.clone());
        let slope = tower.over(&y, &whole)?;
        let first = Fraction::of(a.clone());
        let two = Rational::from_integer(2);
        let linear = tower.times(&first.scaled(&two), &Fraction::generator(VARIABLE))?;
        let linear = linear.plus(&Fraction::of(b.clone()), &mut tower.steps)?;
        if tower.value_at(&first, 1.0)? > 0.0 {
            let side = tower.root(&first, 2)?;
            let part = tower.times(&side, &y)?.scaled(&two);
            let inside = linear.plus(&part, &mut tower.steps)?;
            let before = tower.over(&Fraction::integer(1), &side)?;
            let before = tower.print(&before, &[])?;
            let function = self.logarithm_of(Some(before), &inside, tower)?;
            return Some(Candidate { slope, function });
        }
        let minus = Rational::from_integer(-1);
        let side = tower.root(&first.scaled(&minus), 2)?;
        // b^2 - 4 a c is the square of the linear one less 4 a times the radicand
        let square = tower.times(&linear, &linear)?;
        let other = tower.times(&first, &whole)?.scaled(&Rational::from_integer(-4));
        let discriminant = square.plus(&other, &mut tower.steps)?;
        let below = tower.root(&discriminant, 2)?;
        let inside = tower.over(&linear, &below)?.scaled(&minus);
        let before = tower.over(&Fraction::integer(1), &side)?;
        let tree = call("\\arcsin", tower.print(&inside, &[])?);
        let function = Function::Whole(product(vec![tower.print(&before, &[])?, tree]));
        Some(Candidate { slope, function })
    }

    fn over_linear(
        &self,
        root: Term,
        radicand: &Polynomial,
        [constant, slope]: [&Polynomial; 2],
        tower: &mut Tower,
    ) -> Option<Candidate> {
        let minus = Rational::from_integer(-1);
        let zero = tower
            .over(&Fraction::of(constant.clone()), &Fraction::of(slope.clone()))?
            .scaled(&minus);
        let (mut height, mut rise, mut power) = (Fraction::integer(0), Fraction::integer(0), Fraction::integer(1));
        let mut before = Fraction::integer(0);
        for (degree, coefficient) in (0_i64..).zip(coefficients_in(radicand, VARIABLE)) {
            let coefficient = Fraction::of(coefficient);
            let part = tower.times(&coefficient, &power)?;
            height = height.plus(&part, &mut tower.steps)?;
            let part = tower
                .times(&coefficient, &before)?
                .scaled(&Rational::from_integer(degree));
            rise = rise.plus(&part, &mut tower.steps)?;
            before = power.clone();
            power = tower.times(&power, &zero)?;
        }
        if height.is_zero() {
            return None;
        }
        let y = Fraction::generator(root);
        let shifted = Fraction::generator(VARIABLE).plus(&zero.scaled(&minus), &mut tower.steps)?;
        let below = tower.times(&shifted, &Fraction::of(radicand.clone()))?;
        let slope = tower.over(&y, &below)?;
        let two = Rational::from_integer(2);
        let linear = tower
            .times(&rise, &shifted)?
            .plus(&height.scaled(&two), &mut tower.steps)?;
        let is_positive = tower.value_at(&height, 1.0)? > 0.0;
        let size = if is_positive { height } else { height.scaled(&minus) };
        let side = tower.root(&size, 2)?;
        let before = tower.over(&Fraction::integer(1), &side)?;
        let part = tower.times(&side, &y)?.scaled(&two);
        let function = if is_positive {
            let above = linear.plus(&part, &mut tower.steps)?;
            let inside = tower.over(&above, &shifted)?;
            let before = tower.print(&before.scaled(&minus), &[])?;
            self.logarithm_of(Some(before), &inside, tower)?
        } else {
            let inside = quotient(tower.print(&linear, &[])?, tower.print(&part, &[])?);
            Function::Whole(product(vec![tower.print(&before, &[])?, call("\\arctan", inside)]))
        };
        Some(Candidate { slope, function })
    }
}
