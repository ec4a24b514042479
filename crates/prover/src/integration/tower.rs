//! The functions that an integrand is built of, as generators of a field with a derivation.

use super::fraction::{Fraction, times};
use super::tree::{call, number, power, product, quotient, real_power, root, sum, symbol, value};
use crate::algebra::{Steps, coefficients_in, degree_in, derivative, factors};
use dashu_int::ops::Gcd;
use dashu_ratio::RBig;
use kernel::{Monomial, Polynomial, Term};
use num_traits::{One, Zero};
use numbers::{Field, Rational};
use texmath::{At, Elementary, Name, Symbols, Tree, number_of};

/// The highest power that is multiplied out.
const HIGHEST: i32 = 40;

/// The function that a generator stands for.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    Variable,
    Constant(Tree),
    Exponential(Fraction),
    Logarithm(Fraction),
    Sine(Fraction),
    /// The cosine stands behind the sine of the same angle.
    Cosine(Fraction),
    /// The tangent of an angle, or of half of it, whose sine is the generator before the last.
    Tangent {
        angle: Fraction,
        is_half: bool,
        sine: Term,
    },
    Root(Polynomial, u32),
    Function(Name, Fraction),
    /// A function of which nothing is known, at an argument or without one.
    Unknown(Name, Option<Fraction>),
}

/// Trees that generators, or powers of them, are printed as.
pub(super) type Replaced<'a> = &'a [(Term, u32, Tree)];

/// The generators, in order: each is a function of those before it.
pub(super) struct Tower<'a> {
    pub by: &'a Name,
    pub symbols: &'a Symbols,
    pub kinds: Vec<Kind>,
    slopes: Vec<Option<Fraction>>,
    /// What the arguments of exponentials, and of sines, are multiples of.
    bases: Vec<(bool, Fraction, RBig)>,
    is_outdated: bool,
    /// True if sines are expressed by cosines, not cosines by sines.
    pub is_turned: bool,
    /// True if the numbers taken for letters ascend.
    pub is_reversed: bool,
    pub steps: Steps,
}

pub(super) const VARIABLE: Term = Term(0);

impl<'a> Tower<'a> {
    pub fn new(by: &'a Name, symbols: &'a Symbols, steps: Steps) -> Self {
        Self {
            by,
            symbols,
            kinds: vec![Kind::Variable],
            slopes: vec![Some(Fraction::integer(1))],
            bases: Vec::new(),
            is_outdated: false,
            is_turned: false,
            is_reversed: false,
            steps,
        }
    }

    /// The tree as a quotient of polynomials in generators.
    pub fn read_all(&mut self, tree: &Tree) -> Option<Fraction> {
        let known = self.kinds.len();
        for _ in 0..6 {
            self.is_outdated = false;
            let whole = self.read(tree);
            if !self.is_outdated {
                return self.normal(&whole?);
            }
            self.kinds.truncate(known);
            self.slopes.truncate(known);
        }
        None
    }

    pub fn kind(&self, term: Term) -> &Kind {
        self.kinds.get(term.0 as usize).unwrap_or(&Kind::Variable)
    }

    pub fn term_of(&mut self, kind: Kind) -> Term {
        let place = self.kinds.iter().position(|known| *known == kind);
        let place = place.unwrap_or_else(|| {
            self.kinds.push(kind);
            self.slopes.push(None);
            self.kinds.len() - 1
        });
        Term(u32::try_from(place).unwrap_or(u32::MAX))
    }

    fn read(&mut self, tree: &Tree) -> Option<Fraction> {
        if let Some(number) = number_of(tree) {
            return Some(Fraction::constant(&number));
        }
        match tree {
            Tree::Symbol(name, _) if name == self.by => Some(Fraction::generator(VARIABLE)),
            Tree::Symbol(name, _) if self.is_euler(name) => self.exponential(&Fraction::integer(1)),
            Tree::Symbol(name, _) if self.moves(name) => {
                Some(Fraction::generator(self.term_of(Kind::Unknown(name.clone(), None))))
            }
            Tree::Symbol(..) => Some(Fraction::generator(self.term_of(Kind::Constant(tree.clone())))),
            Tree::Negate(inner) => Some(self.read(inner)?.scaled(&Rational::from_integer(-1))),
            Tree::Sum(terms) => {
                let mut total = Fraction::integer(0);
                for term in terms {
                    let term = self.read(term)?;
                    total = total.plus(&term, &mut self.steps)?;
                }
                Some(total)
            }
            Tree::Product(factors) => {
                let mut total = Fraction::integer(1);
                for factor in factors {
                    let factor = self.read(factor)?;
                    total = self.times(&total, &factor)?;
                }
                Some(total)
            }
            Tree::Quotient(above, below, _) => {
                let (above, below) = (self.read(above)?, self.read(below)?);
                self.over(&above, &below)
            }
            Tree::Power(base, exponent, _) => self.read_power(base, *exponent),
            Tree::Root(radicand, index, _) => {
                let radicand = self.read(radicand)?;
                self.root(&radicand, *index)
            }
            Tree::RealPower(base, exponent, _) => self.read_real_power(base, exponent),
            Tree::Call(name, argument, _) => self.read_call(name, argument),
            _ => None,
        }
    }

    fn read_power(&mut self, base: &Tree, exponent: i32) -> Option<Fraction> {
        if let Tree::Symbol(name, _) = base
            && self.is_euler(name)
        {
            return self.exponential(&Fraction::integer(i64::from(exponent)));
        }
        let base = self.read(base)?;
        let terms = base.above.terms().len().max(base.below.terms().len());
        if exponent.abs() > HIGHEST && terms > 1 {
            return None;
        }
        let whole = base.power(exponent, &mut self.steps)?;
        self.normal(&whole)
    }

    fn read_real_power(&mut self, base: &Tree, exponent: &Tree) -> Option<Fraction> {
        let exponent = self.read(exponent)?;
        let is_euler = matches!(base, Tree::Symbol(name, _) if self.is_euler(name));
        if is_euler {
            return self.exponential(&exponent);
        }
        let base = self.read(base)?;
        if let Some(number) = exponent.as_constant() {
            let index = u32::try_from(number.0.denominator().clone()).ok()?;
            let times = i32::try_from(number.0.numerator().clone()).ok()?;
            let whole = self.root(&base, index)?.power(times, &mut self.steps)?;
            return self.normal(&whole);
        }
        let logarithm = self.logarithm(&base)?;
        let exponent = self.times(&exponent, &logarithm)?;
        self.exponential(&exponent)
    }

    fn read_call(&mut self, name: &Name, argument: &Tree) -> Option<Fraction> {
        if self.symbols.is_function(name) || self.symbols.is_in_flight(name) {
            let argument = self.read(argument)?;
            return Some(self.unknown(name.clone(), Some(argument)));
        }
        let function = Elementary::named(name)?;
        let at = self.read(argument)?;
        let half = |tower: &mut Self| {
            let pi = Tree::Symbol(Name::plain("\\pi"), At::default());
            Fraction::generator(tower.term_of(Kind::Constant(pi))).scaled(&Rational::from_ratio(1, 2))
        };
        match function.command {
            "\\exp" => self.exponential(&at),
            "\\ln" => self.logarithm(&at),
            "\\sin" => Some(self.wave(&at)?.0),
            "\\cos" => Some(self.wave(&at)?.1),
            "\\arccos" => {
                let half = half(self);
                let other = Fraction::generator(self.term_of(Kind::Function(Name::plain("\\arcsin"), at)));
                half.plus(&other.scaled(&Rational::from_integer(-1)), &mut self.steps)
            }
            "\\abs" => {
                let square = at.power(2, &mut self.steps)?;
                let square = self.normal(&square)?;
                let below = square.below.clone();
                let radicand = times(&square.above, &below, &mut self.steps).ok()?;
                let absolute = Fraction::generator(self.term_of(Kind::Root(radicand, 2)));
                absolute.over(&Fraction::of(below), &mut self.steps)
            }
            "\\arcsin" | "\\arctan" | "\\arsinh" | "\\arcosh" | "\\artanh" => {
                let term = self.term_of(Kind::Function(Name::plain(function.command), at));
                Some(Fraction::generator(term))
            }
            _ => self.read(&function.definition(argument)?),
        }
    }

    fn is_euler(&self, name: &Name) -> bool {
        *name == Name::plain("e") && !self.symbols.declares(name)
    }

    fn moves(&self, name: &Name) -> bool {
        if self.symbols.running() != Some(self.by) {
            return false;
        }
        let is_flying = self.symbols.is_in_flight(name) && name.mark.is_empty() && name.subscript.is_empty();
        is_flying || (self.symbols.is_function(name) && !self.symbols.is_parameter(name))
    }

    fn unknown(&mut self, name: Name, argument: Option<Fraction>) -> Fraction {
        let name = self.declared(name);
        Fraction::generator(self.term_of(Kind::Unknown(name, argument)))
    }

    /// The name that is declared for a derivative, as `\dot f` for f'.
    fn declared(&self, name: Name) -> Name {
        let plain = Name {
            primes: 0,
            ..name.clone()
        };
        let mut functions = self.symbols.functions();
        match functions.find(|(function, _)| name.primes > 0 && **function == plain) {
            Some((_, Some(Tree::Symbol(slope, _)))) if *slope != name => self.declared(Name {
                primes: slope.primes.saturating_add(name.primes).saturating_sub(1),
                ..slope.clone()
            }),
            _ => name,
        }
    }

    pub fn times(&mut self, left: &Fraction, right: &Fraction) -> Option<Fraction> {
        let whole = left.times(right, &mut self.steps)?;
        self.normal(&whole)
    }

    pub fn over(&mut self, above: &Fraction, below: &Fraction) -> Option<Fraction> {
        let below = self.normal(below)?;
        let whole = above.over(&below, &mut self.steps)?;
        self.normal(&whole)
    }

    /// The terms of an argument: a product of powers of generators, and its factor.
    fn split(&mut self, argument: &Fraction) -> Option<Vec<(Fraction, RBig)>> {
        let mut parts = Vec::new();
        for (monomial, coefficient) in argument.above.terms() {
            let one = Polynomial::from_terms([(monomial.clone(), RBig::ONE)]);
            let part = Fraction::new(&one, &argument.below, &mut self.steps)?;
            parts.push((part, coefficient.clone()));
        }
        Some(parts)
    }

    /// The number that all factors of this part are whole multiples of, and the multiple that this factor is.
    fn multiple(&mut self, is_wave: bool, part: &Fraction, factor: &RBig) -> Option<(RBig, i32)> {
        let known = self
            .bases
            .iter_mut()
            .find(|(kind, known, _)| *kind == is_wave && known == part);
        let base = match known {
            Some((_, _, base)) => {
                let multiple = factor / &*base;
                if !multiple.denominator().is_one() {
                    let common = factor.denominator() * base.denominator();
                    let left = (factor * RBig::from(common.clone())).numerator().clone();
                    let right = (&*base * RBig::from(common.clone())).numerator().clone();
                    *base = RBig::from(left.gcd(right)) / RBig::from(common);
                    self.is_outdated = true;
                }
                base.clone()
            }
            None => {
                let base = if *factor < RBig::ZERO {
                    -factor.clone()
                } else {
                    factor.clone()
                };
                self.bases.push((is_wave, part.clone(), base.clone()));
                base
            }
        };
        let multiple = factor / &base;
        let multiple = i32::try_from(multiple.numerator().clone()).ok()?;
        Some((base, multiple))
    }

    fn exponential(&mut self, argument: &Fraction) -> Option<Fraction> {
        let mut total = Fraction::integer(1);
        for (part, factor) in self.split(argument)? {
            let factor_of_it = match self.single_logarithm(&part) {
                Some(of) => {
                    let index = u32::try_from(factor.denominator().clone()).ok()?;
                    let times = i32::try_from(factor.numerator().clone()).ok()?;
                    self.root(&of, index)?.power(times, &mut self.steps)?
                }
                None => {
                    let (base, multiple) = self.multiple(false, &part, &factor)?;
                    let term = self.term_of(Kind::Exponential(part.scaled(&Rational(base))));
                    Fraction::generator(term).power(multiple, &mut self.steps)?
                }
            };
            total = self.times(&total, &factor_of_it)?;
        }
        Some(total)
    }

    fn single_logarithm(&self, part: &Fraction) -> Option<Fraction> {
        let is_whole = part.below.as_constant().is_some();
        match part.above.terms() {
            [(monomial, _)] if is_whole => match monomial.as_slice() {
                [(term, 1)] => match self.kind(*term) {
                    Kind::Logarithm(of) => Some(of.clone()),
                    _ => None,
                },
                _ => None,
            },
            _ => None,
        }
    }

    /// The logarithm, as a sum of those of the factors; these are positive at some point where the whole is.
    fn logarithm(&mut self, of: &Fraction) -> Option<Fraction> {
        if of.is_zero() {
            return None;
        }
        let mut parts: Vec<(Polynomial, i32)> = Vec::new();
        let mut constant = Rational::one();
        for (side, sign) in [(of.above.clone(), 1), (of.below.clone(), -1)] {
            let found = factors(&side, &[], &mut self.steps).ok()?;
            constant *= if sign == 1 {
                found.constant
            } else {
                Rational::one() / found.constant
            };
            for (factor, exponent) in found.factors {
                parts.push((factor, sign * i32::try_from(exponent).ok()?));
            }
        }
        let point = self.point_where_positive(of);
        let mut total = Fraction::integer(0);
        for (factor, exponent) in parts {
            let is_below = self
                .value_at(&Fraction::of(factor.clone()), point)
                .is_some_and(|value| value < 0.0);
            let factor = if is_below { factor.negated() } else { factor };
            if is_below && exponent % 2 != 0 {
                constant = Rational::zero() - constant;
            }
            let part = self
                .logarithm_of_factor(&factor)?
                .scaled(&Rational::from_integer(i64::from(exponent)));
            total = total.plus(&part, &mut self.steps)?;
        }
        if constant < Rational::zero() {
            return Some(Fraction::generator(self.term_of(Kind::Logarithm(of.clone()))));
        }
        for (prime, exponent) in primes(&constant) {
            let term = self.term_of(Kind::Logarithm(Fraction::constant(&prime)));
            let part = Fraction::generator(term).scaled(&Rational::from_integer(exponent));
            total = total.plus(&part, &mut self.steps)?;
        }
        Some(total)
    }

    fn logarithm_of_factor(&mut self, factor: &Polynomial) -> Option<Fraction> {
        if let [(monomial, value)] = factor.terms()
            && let ([(term, 1)], true) = (monomial.as_slice(), *value == RBig::ONE)
            && let Kind::Exponential(argument) = self.kind(*term)
        {
            return Some(argument.clone());
        }
        Some(Fraction::generator(
            self.term_of(Kind::Logarithm(Fraction::of(factor.clone()))),
        ))
    }

    fn point_where_positive(&self, of: &Fraction) -> f64 {
        let points = [0.5, 1.7, 3.3, 0.1, -0.5, -1.7, 20.0, -20.0];
        let positive = points
            .into_iter()
            .find(|point| self.value_at(of, *point).is_some_and(|value| value > 0.0));
        positive.unwrap_or(0.5)
    }

    /// The value at a point, with some numbers for the letters.
    pub fn value_at(&self, of: &Fraction, point: f64) -> Option<f64> {
        let tree = self.print(of, &[])?;
        value(&tree, &|name| letter(name, self.by, point, self.is_reversed)).filter(|value| value.is_finite())
    }

    /// The sine and the cosine.
    fn wave(&mut self, argument: &Fraction) -> Option<(Fraction, Fraction)> {
        let (mut sine, mut cosine) = (Fraction::integer(0), Fraction::integer(1));
        for (part, factor) in self.split(argument)? {
            let (s, c) = self.wave_of(&part, &factor)?;
            (sine, cosine) = self.turned((&sine, &cosine), (&s, &c))?;
        }
        Some((sine, cosine))
    }

    /// The sine and the cosine of the sum of two angles.
    fn turned(&mut self, one: (&Fraction, &Fraction), other: (&Fraction, &Fraction)) -> Option<(Fraction, Fraction)> {
        let (left, right) = (self.times(one.0, other.1)?, self.times(one.1, other.0)?);
        let sine = left.plus(&right, &mut self.steps)?;
        let (left, right) = (self.times(one.1, other.1)?, self.times(one.0, other.0)?);
        let cosine = left.plus(&right.scaled(&Rational::from_integer(-1)), &mut self.steps)?;
        Some((sine, cosine))
    }

    fn wave_of(&mut self, part: &Fraction, factor: &RBig) -> Option<(Fraction, Fraction)> {
        let pi = Kind::Constant(Tree::Symbol(Name::plain("\\pi"), At::default()));
        let is_pi = part
            .above
            .generators()
            .as_slice()
            .first()
            .is_some_and(|term| *self.kind(*term) == pi);
        let twice = factor * RBig::from(2);
        if is_pi && part.above.degree() == 1 && part.below.as_constant().is_some() && twice.denominator().is_one() {
            let quarter = i64::try_from(twice.numerator() % dashu_int::IBig::from(4))
                .ok()?
                .rem_euclid(4);
            let (sine, cosine) = [(0, 1), (1, 0), (0, -1), (-1, 0)]
                .get(usize::try_from(quarter).ok()?)
                .copied()?;
            return Some((Fraction::integer(sine), Fraction::integer(cosine)));
        }
        if let Some(one) = self.wave_of_inverse(part) {
            let multiple = i32::try_from(factor.numerator().clone()).ok()?;
            return if factor.denominator().is_one() {
                self.repeated(&one, multiple)
            } else {
                None
            };
        }
        let (base, multiple) = self.multiple(true, part, factor)?;
        let angle = part.scaled(&Rational(base));
        let known = self.kinds.contains(&Kind::Sine(angle.clone()));
        let sine = self.term_of(Kind::Sine(angle.clone()));
        if !known {
            self.kinds.push(Kind::Cosine(angle));
            self.slopes.push(None);
        }
        self.repeated(
            &(Fraction::generator(sine), Fraction::generator(Term(sine.0 + 1))),
            multiple,
        )
    }

    /// The sine and the cosine of an arcsine or an arctangent.
    fn wave_of_inverse(&mut self, part: &Fraction) -> Option<(Fraction, Fraction)> {
        let is_single = part.below.as_constant().is_some() && part.above.degree() == 1;
        let term = part.above.generators().first().copied().filter(|_| is_single)?;
        let Kind::Function(name, argument) = self.kind(term).clone() else {
            return None;
        };
        let square = self.times(&argument, &argument)?;
        let one = Fraction::integer(1);
        match name.base.as_str() {
            "\\arcsin" => {
                let rest = one.plus(&square.scaled(&Rational::from_integer(-1)), &mut self.steps)?;
                Some((argument, self.root(&rest, 2)?))
            }
            "\\arctan" => {
                let sum = one.plus(&square, &mut self.steps)?;
                let root = self.root(&sum, 2)?;
                Some((self.over(&argument, &root)?, self.over(&one, &root)?))
            }
            _ => None,
        }
    }

    /// The sine and the cosine of a multiple of an angle.
    fn repeated(&mut self, one: &(Fraction, Fraction), multiple: i32) -> Option<(Fraction, Fraction)> {
        if multiple.abs() > HIGHEST {
            return None;
        }
        let mut total = (Fraction::integer(0), Fraction::integer(1));
        for _ in 0..multiple.abs() {
            total = self.turned((&total.0, &total.1), (&one.0, &one.1))?;
        }
        let (sine, cosine) = total;
        Some(match multiple < 0 {
            true => (sine.scaled(&Rational::from_integer(-1)), cosine),
            false => (sine, cosine),
        })
    }

    /// The root of this index.
    pub fn root(&mut self, of: &Fraction, index: u32) -> Option<Fraction> {
        if index <= 1 {
            return Some(of.clone());
        }
        let mut radicand = of.above.clone();
        for _ in 1..index {
            radicand = times(&radicand, &of.below, &mut self.steps).ok()?;
        }
        let cosine = self.cosine_below_root(&mut radicand, index)?;
        let found = factors(&radicand, &[], &mut self.steps).ok()?;
        let (outside, constant) = rooted(&found.constant, index);
        let mut outside = cosine.scaled(&outside);
        let mut inside = Polynomial::constant(&constant);
        let point = self.point_where_positive(of);
        for (factor, exponent) in found.factors {
            let (whole, rest) = (exponent / index, exponent % index);
            if whole > 0 {
                let value = self.value_at(&Fraction::of(factor.clone()), point).unwrap_or(1.0);
                let side = if value < 0.0 && index.is_multiple_of(2) {
                    factor.negated()
                } else {
                    factor.clone()
                };
                let side = Fraction::of(side).power(i32::try_from(whole).ok()?, &mut self.steps)?;
                outside = outside.times(&side, &mut self.steps)?;
            }
            for _ in 0..rest {
                inside = times(&inside, &factor, &mut self.steps).ok()?;
            }
        }
        let root = match inside.as_constant() {
            Some(one) if one == Rational::one() => Fraction::integer(1),
            _ => Fraction::generator(self.term_of(Kind::Root(inside, index))),
        };
        let whole = outside.times(&root, &mut self.steps)?;
        whole.over(&Fraction::of(of.below.clone()), &mut self.steps)
    }

    /// Takes the squares of cosines, written as `1 - s^2`, out of what stands under a square root.
    fn cosine_below_root(&mut self, radicand: &mut Polynomial, index: u32) -> Option<Fraction> {
        let mut outside = Fraction::integer(1);
        let places = 0..u32::try_from(self.kinds.len()).ok()?;
        for term in places.map(Term).filter(|_| index == 2) {
            if !matches!(self.kind(term), Kind::Cosine(_)) {
                continue;
            }
            let Some((_, square)) = self.relation(term) else {
                continue;
            };
            while let Some(rest) = crate::algebra::exact_quotient(radicand, &square, &mut self.steps).ok()? {
                if radicand.is_zero() {
                    break;
                }
                *radicand = rest;
                outside = outside.times(&Fraction::generator(term), &mut self.steps)?;
            }
        }
        Some(outside)
    }

    /// The power of a generator that is a polynomial in others.
    fn relation(&self, term: Term) -> Option<(u32, Polynomial)> {
        let complement = |other: u32| {
            let square = Polynomial::from_terms([(Monomial::from_slice(&[(Term(other), 2)]), RBig::ONE)]);
            Polynomial::integer(1).minus(&square)
        };
        match self.kind(term) {
            Kind::Cosine(_) if !self.is_turned => Some((2, complement(term.0.checked_sub(1)?))),
            Kind::Sine(_) if self.is_turned => Some((2, complement(term.0.checked_add(1)?))),
            Kind::Root(of, index) => Some((*index, of.clone())),
            _ => None,
        }
    }

    /// The polynomial with the powers of roots and cosines that are polynomials in others put in.
    pub fn reduced(&mut self, p: &Polynomial) -> Option<Polynomial> {
        let mut p = p.clone();
        for term in p.generators().into_iter().rev() {
            let Some((index, square)) = self.relation(term) else {
                continue;
            };
            if degree_in(&p, term) < index {
                continue;
            }
            let mut total = Polynomial::default();
            for (exponent, coefficient) in (0_u32..).zip(coefficients_in(&p, term)) {
                let mut part = coefficient;
                for _ in 0..exponent / index {
                    part = times(&part, &square, &mut self.steps).ok()?;
                }
                let rest = crate::algebra::power_of(term, exponent % index);
                total = total.plus(&crate::algebra::shifted(&part, &rest, &RBig::ONE));
            }
            return self.reduced(&total);
        }
        p = p.clone();
        Some(p)
    }

    /// The quotient without roots and cosines below.
    pub fn normal(&mut self, of: &Fraction) -> Option<Fraction> {
        let related = |tower: &Self, of: &Fraction| of.generators().iter().any(|term| tower.relation(*term).is_some());
        if !related(self, of) {
            return Some(of.clone());
        }
        let (mut above, mut below) = (self.reduced(&of.above)?, self.reduced(&of.below)?);
        for _ in 0..12 {
            let with_relation = below.generators().into_iter().rev();
            let Some((term, (index, square))) = with_relation
                .filter_map(|term| Some((term, self.relation(term)?)))
                .next()
            else {
                break;
            };
            let coefficients = coefficients_in(&below, term);
            let conjugate = match (coefficients.as_slice(), index) {
                ([even, odd], 2) => {
                    let odd = times(odd, &Polynomial::generator(term), &mut self.steps).ok()?;
                    even.minus(&odd)
                }
                (list, index) => {
                    let lowest = list.iter().position(|coefficient| !coefficient.is_zero())?;
                    if lowest + 1 != list.len() || square.is_zero() {
                        break;
                    }
                    let exponent = index.checked_sub(u32::try_from(lowest).ok()?)?;
                    Polynomial::from_terms([(crate::algebra::power_of(term, exponent), RBig::ONE)])
                }
            };
            above = times(&above, &conjugate, &mut self.steps).ok()?;
            above = self.reduced(&above)?;
            below = times(&below, &conjugate, &mut self.steps).ok()?;
            below = self.reduced(&below)?;
        }
        Fraction::new(&above, &below, &mut self.steps)
    }

    /// The derivative of a generator.
    pub fn slope(&mut self, term: Term) -> Option<Fraction> {
        let place = term.0 as usize;
        if let Some(Some(slope)) = self.slopes.get(place) {
            return Some(slope.clone());
        }
        let own = Fraction::generator(term);
        let slope = match self.kind(term).clone() {
            Kind::Variable => Fraction::integer(1),
            Kind::Constant(_) => Fraction::integer(0),
            Kind::Exponential(argument) => {
                let slope = self.derivative(&argument)?;
                self.times(&own, &slope)?
            }
            Kind::Logarithm(argument) => {
                let slope = self.derivative(&argument)?;
                self.over(&slope, &argument)?
            }
            Kind::Sine(angle) => {
                let slope = self.derivative(&angle)?;
                self.times(&Fraction::generator(Term(term.0 + 1)), &slope)?
            }
            Kind::Cosine(angle) => {
                let slope = self.derivative(&angle)?.scaled(&Rational::from_integer(-1));
                self.times(&Fraction::generator(Term(term.0 - 1)), &slope)?
            }
            Kind::Tangent { angle, is_half, .. } => {
                let slope = self.derivative(&angle)?;
                let slope = slope.scaled(&Rational::from_ratio(1, if is_half { 2 } else { 1 }));
                let square = own
                    .power(2, &mut self.steps)?
                    .plus(&Fraction::integer(1), &mut self.steps)?;
                self.times(&slope, &square)?
            }
            Kind::Root(of, index) => {
                let of = Fraction::of(of);
                let slope = self.derivative(&of)?.scaled(&Rational::from_ratio(1, i64::from(index)));
                let above = self.times(&slope, &own)?;
                self.over(&above, &of)?
            }
            Kind::Function(name, argument) => {
                let slope = self.derivative(&argument)?;
                let tree = self.print(&argument, &[])?;
                let outer = Elementary::named(&name)?.derivative(&tree)?;
                let outer = self.read(&outer)?;
                self.times(&outer, &slope)?
            }
            Kind::Unknown(name, argument) => self.slope_of_unknown(name, argument)?,
        };
        let slope = self.normal(&slope)?;
        if let Some(known) = self.slopes.get_mut(place) {
            *known = Some(slope.clone());
        }
        Some(slope)
    }

    fn slope_of_unknown(&mut self, name: Name, argument: Option<Fraction>) -> Option<Fraction> {
        let slope = match &argument {
            Some(argument) => self.derivative(argument)?,
            None => Fraction::integer(1),
        };
        if slope.is_zero() {
            return Some(slope);
        }
        let next = match self.symbols.is_in_flight(&name) {
            true => Some(name.dotted()).filter(|dotted| self.symbols.is_in_flight(dotted))?,
            false => {
                let declared = self.symbols.functions().find(|(function, _)| **function == name);
                match declared.and_then(|(_, slope)| slope) {
                    Some(Tree::Symbol(slope, _)) => slope.clone(),
                    Some(_) => return None,
                    None => Name {
                        primes: name.primes.saturating_add(1),
                        ..name
                    },
                }
            }
        };
        let outer = self.unknown(next, argument);
        self.times(&outer, &slope)
    }

    /// The derivative of a polynomial in generators.
    pub fn derivative_of(&mut self, p: &Polynomial) -> Option<Fraction> {
        let mut total = Fraction::integer(0);
        for term in p.generators() {
            let slope = self.slope(term)?;
            if !slope.is_zero() {
                let part = self.times(&Fraction::of(derivative(p, term)), &slope)?;
                total = total.plus(&part, &mut self.steps)?;
            }
        }
        Some(total)
    }

    pub fn derivative(&mut self, of: &Fraction) -> Option<Fraction> {
        let above = self.derivative_of(&of.above)?;
        if of.below.as_constant().is_some() {
            let below = Rational::one() / of.below.as_constant()?;
            return Some(above.scaled(&below));
        }
        let below = self.derivative_of(&of.below)?;
        // (a/b)' = (a' - (a/b) b')/b
        let part = self.times(of, &below)?.scaled(&Rational::from_integer(-1));
        let above = above.plus(&part, &mut self.steps)?;
        self.over(&above, &Fraction::of(of.below.clone()))
    }

    /// True if it depends on the variable.
    pub fn varies(&mut self, term: Term) -> bool {
        self.slope(term).is_none_or(|slope| !slope.is_zero())
    }

    /// The quotient as a tree; `None` where generators are replaced and what is left speaks of the variable.
    pub fn print(&self, of: &Fraction, replaced: Replaced) -> Option<Tree> {
        let above = self.print_polynomial(&of.above, replaced)?;
        Some(quotient(above, self.print_polynomial(&of.below, replaced)?))
    }

    fn print_polynomial(&self, p: &Polynomial, replaced: Replaced) -> Option<Tree> {
        let terms = p.terms().iter().rev().map(|(monomial, coefficient)| {
            let mut factors = vec![number(&Rational(coefficient.clone()))];
            for (term, exponent) in monomial {
                factors.push(self.print_power(*term, *exponent, replaced)?);
            }
            Some(product(factors))
        });
        Some(sum(terms.collect::<Option<_>>()?))
    }

    fn print_power(&self, term: Term, exponent: u32, replaced: Replaced) -> Option<Tree> {
        if let Some((_, unit, tree)) = replaced.iter().find(|(known, ..)| *known == term) {
            return exponent
                .is_multiple_of(*unit)
                .then(|| power(tree.clone(), exponent / unit));
        }
        if let Kind::Exponential(argument) = self.kind(term) {
            return self.print_exponential(&argument.scaled(&Rational::from_integer(i64::from(exponent))), replaced);
        }
        Some(power(self.print_generator(term, replaced)?, exponent))
    }

    fn print_exponential(&self, argument: &Fraction, replaced: Replaced) -> Option<Tree> {
        if let [(monomial, _)] = argument.above.terms()
            && let Some((term, of)) = monomial.iter().find_map(|(term, exponent)| match self.kind(*term) {
                Kind::Logarithm(of) if *exponent == 1 => Some((*term, of)),
                _ => None,
            })
        {
            let less = coefficients_in(&argument.above, term).pop()?;
            let exponent = Fraction {
                above: less,
                below: argument.below.clone(),
            };
            return Some(real_power(self.print(of, replaced)?, self.print(&exponent, replaced)?));
        }
        let euler = Name::plain("e");
        if self.symbols.declares(&euler) {
            return Some(call("\\exp", self.print(argument, replaced)?));
        }
        match argument.as_constant().and_then(|number| number.to_integer()) {
            Some(1) => Some(symbol(&euler)),
            Some(whole) => Some(Tree::Power(
                Box::new(symbol(&euler)),
                i32::try_from(whole).ok()?,
                At::default(),
            )),
            None => Some(real_power(symbol(&euler), self.print(argument, replaced)?)),
        }
    }

    fn print_generator(&self, term: Term, replaced: Replaced) -> Option<Tree> {
        let of = |function: &str, argument: &Fraction| Some(call(function, self.print(argument, replaced)?));
        match self.kind(term) {
            Kind::Variable => replaced.is_empty().then(|| symbol(self.by)),
            Kind::Constant(tree) => Some(tree.clone()),
            Kind::Exponential(argument) => self.print_exponential(argument, replaced),
            Kind::Logarithm(argument) => of("\\ln", argument),
            Kind::Sine(angle) => of("\\sin", angle),
            Kind::Cosine(angle) => of("\\cos", angle),
            Kind::Tangent { angle, is_half, .. } => {
                let half = Rational::from_ratio(1, if *is_half { 2 } else { 1 });
                of("\\tan", &angle.scaled(&half))
            }
            Kind::Root(radicand, index) => Some(root(self.print_polynomial(radicand, replaced)?, *index)),
            Kind::Function(name, argument) => of(&name.base, argument),
            Kind::Unknown(name, argument) if replaced.is_empty() => Some(match argument {
                Some(argument) => {
                    let argument = self.print(argument, replaced)?;
                    Tree::Call(name.clone(), Box::new(argument), At::default())
                }
                None => symbol(name),
            }),
            Kind::Unknown(..) => None,
        }
    }
}

/// A number for a letter, and the point for the variable: later letters stand for less, or for more.
pub(super) fn letter(name: &Name, by: &Name, point: f64, is_reversed: bool) -> f64 {
    match name.base.as_str() {
        _ if name == by => point,
        "\\pi" => std::f64::consts::PI,
        "e" => std::f64::consts::E,
        base => {
            let bytes = base.bytes().chain(name.subscript.bytes());
            let seed = bytes.fold(11_u32, |sum, byte| sum.wrapping_mul(37).wrapping_add(u32::from(byte)));
            let part = f64::from(seed % 31) * 0.06;
            if is_reversed { 0.63 + part } else { 2.5 - part }
        }
    }
}

/// The number as a product of powers of small primes and of what is left.
fn primes(of: &Rational) -> Vec<(Rational, i64)> {
    let mut found = Vec::new();
    for (side, sign) in [
        (RBig::from(of.0.numerator().clone()), 1),
        (RBig::from(of.0.denominator().clone()), -1),
    ] {
        let mut rest = side;
        for prime in 2..60_u32 {
            let mut exponent = 0;
            while (&rest / RBig::from(prime)).denominator().is_one() {
                rest /= RBig::from(prime);
                exponent += sign;
            }
            if exponent != 0 {
                found.push((Rational(RBig::from(prime)), exponent));
            }
        }
        if !rest.is_one() {
            found.push((Rational(rest), sign));
        }
    }
    found
}

/// The factor before the root of a number, and what stays under it.
fn rooted(of: &Rational, index: u32) -> (Rational, Rational) {
    // a/b has the root of a b^(n - 1), over b
    let below = RBig::from(of.0.denominator().clone());
    let mut inside = of.0.clone();
    for _ in 0..index {
        inside *= &below;
    }
    let mut outside = RBig::ONE / below;
    for prime in 2..60_u32 {
        let whole = RBig::from(prime).pow(index as isize);
        while (&inside / &whole).denominator().is_one() && !inside.is_zero() {
            inside /= &whole;
            outside *= RBig::from(prime);
        }
    }
    if index % 2 == 1 && inside < RBig::ZERO {
        return (Rational(-outside), Rational(-inside));
    }
    (Rational(outside), Rational(inside))
}

/// The one of a power of this exponent.
pub(super) fn one_of(term: Term, exponent: u32) -> Polynomial {
    Polynomial::from_terms([(crate::algebra::power_of(term, exponent), RBig::ONE)])
}
