//! Polynomials with rational coefficients over terms, as certificates state them and the kernel multiplies them out.

use super::term::{Mixed, Term};
use dashu_int::ops::Gcd;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use num_traits::Zero;
use numbers::Rational;
use smallvec::SmallVec;
use std::collections::HashMap;
use std::hash::BuildHasherDefault;

/// A product of powers of generators, sorted by generator, without exponents that are 0.
pub type Monomial = SmallVec<[(Term, u32); 4]>;

/// A polynomial over terms: each term stands for its own value, whatever is inside it.
///
/// The list is sorted by monomial and holds no coefficient that is 0, so that equality is equality of polynomials.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Polynomial(Vec<(Monomial, RBig)>);

impl Polynomial {
    /// A constant.
    pub fn constant(value: &Rational) -> Self {
        Self::from_list(vec![(Monomial::new(), value.0.clone())])
    }

    /// An integer.
    pub fn integer(value: i64) -> Self {
        Self::from_list(vec![(Monomial::new(), RBig::from(value))])
    }

    /// One generator.
    pub fn generator(term: Term) -> Self {
        Self(vec![(Monomial::from_slice(&[(term, 1)]), RBig::ONE)])
    }

    /// The polynomial with these terms, equal monomials added up.
    pub fn from_terms(terms: impl IntoIterator<Item = (Monomial, RBig)>) -> Self {
        let mut sums: HashMap<Monomial, RBig, BuildHasherDefault<Mixed>> = HashMap::default();
        for (monomial, coefficient) in terms {
            *sums.entry(monomial).or_insert(RBig::ZERO) += coefficient;
        }
        let mut list: Vec<(Monomial, RBig)> = sums.into_iter().collect();
        list.sort_unstable_by(|a, b| a.0.cmp(&b.0));
        Self::from_list(list)
    }

    /// Returns true if each monomial holds terms of a store with this many, each once and in order, to powers above 0.
    pub fn is_proper(&self, terms: usize) -> bool {
        let is_ordered = |monomial: &Monomial| monomial.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let is_power = |(term, power): &(Term, u32)| (term.0 as usize) < terms && *power > 0;
        let mut monomials = self.0.iter().map(|(monomial, _)| monomial);
        monomials.all(|monomial| is_ordered(monomial) && monomial.iter().all(is_power))
    }

    fn from_list(mut list: Vec<(Monomial, RBig)>) -> Self {
        list.retain(|(_, coefficient)| !coefficient.is_zero());
        Self(list)
    }

    /// Its terms, in the order of their monomials.
    pub fn terms(&self) -> &[(Monomial, RBig)] {
        &self.0
    }

    /// Whether it is 0 identically.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Its value, where it holds no generator.
    pub fn as_constant(&self) -> Option<Rational> {
        match self.0.as_slice() {
            [] => Some(Rational::zero()),
            [(monomial, value)] if monomial.is_empty() => Some(Rational(value.clone())),
            _ => None,
        }
    }

    /// Every generator that occurs, in order, each once.
    pub fn generators(&self) -> Vec<Term> {
        let mut met: Vec<Term> = self
            .0
            .iter()
            .flat_map(|(m, _)| m.iter().map(|(term, _)| *term))
            .collect();
        met.sort_unstable();
        met.dedup();
        met
    }

    /// The largest sum of the exponents of a term.
    pub fn degree(&self) -> u32 {
        let of = |monomial: &Monomial| monomial.iter().fold(0, |sum: u32, (_, n)| sum.saturating_add(*n));
        self.0.iter().map(|(monomial, _)| of(monomial)).max().unwrap_or(0)
    }

    /// Whether it is an integer wherever its generators are: where it is one at each point of the grid 0, ..., degree in each
    /// generator, so are all its forward differences there, and it is a sum of these times products of binomial
    /// coefficients (Polya, Ueber ganzwertige ganze Funktionen, 1915). Of more than a thousand such points only whole
    /// coefficients tell.
    pub fn is_integer_valued(&self) -> bool {
        if self.0.iter().all(|(_, value)| *value.denominator() == UBig::ONE) {
            return true;
        }
        let generators = self.generators();
        let degree = |of: &Term| {
            let powers = self.0.iter().flat_map(|(monomial, _)| monomial.iter());
            powers
                .filter(|(term, _)| term == of)
                .map(|(_, power)| *power)
                .max()
                .unwrap_or(0)
        };
        let degrees: Vec<u32> = generators.iter().map(degree).collect();
        let points = degrees
            .iter()
            .try_fold(1_u32, |points, degree| points.checked_mul(degree.checked_add(1)?));
        let Some(points) = points.filter(|points| *points <= 1000) else {
            return false;
        };
        let is_integer_at = |number: u32| {
            let mut rest = number;
            let mut at: HashMap<Term, u32> = HashMap::new();
            for (generator, degree) in generators.iter().zip(&degrees) {
                at.insert(*generator, rest % (degree + 1));
                rest /= degree + 1;
            }
            let value = self.0.iter().fold(RBig::ZERO, |sum, (monomial, coefficient)| {
                let factors = monomial.iter().map(|(term, power)| {
                    let base = at.get(term).copied().unwrap_or_default();
                    RBig::from(UBig::from(base).pow(*power as usize))
                });
                sum + factors.fold(coefficient.clone(), |product, factor| product * factor)
            });
            *value.denominator() == UBig::ONE
        };
        (0..points).all(is_integer_at)
    }

    /// The sum.
    pub fn plus(&self, other: &Self) -> Self {
        self.merged(other, false)
    }

    /// The difference.
    pub fn minus(&self, other: &Self) -> Self {
        self.merged(other, true)
    }

    fn merged(&self, other: &Self, negate: bool) -> Self {
        let signed = |value: &RBig| if negate { -value.clone() } else { value.clone() };
        let (mut list, mut left, mut right) = (Vec::with_capacity(self.0.len() + other.0.len()), 0, 0);
        while let (Some(a), Some(b)) = (self.0.get(left), other.0.get(right)) {
            match a.0.cmp(&b.0) {
                std::cmp::Ordering::Less => {
                    list.push(a.clone());
                    left += 1;
                }
                std::cmp::Ordering::Greater => {
                    list.push((b.0.clone(), signed(&b.1)));
                    right += 1;
                }
                std::cmp::Ordering::Equal => {
                    let sum = &a.1 + signed(&b.1);
                    if !sum.is_zero() {
                        list.push((a.0.clone(), sum));
                    }
                    (left, right) = (left + 1, right + 1);
                }
            }
        }
        list.extend(self.0.iter().skip(left).cloned());
        list.extend(other.0.iter().skip(right).map(|(m, c)| (m.clone(), signed(c))));
        Self(list)
    }

    /// The product; `None` where more than `most` products of terms would be added up.
    pub fn times_within(&self, other: &Self, most: usize) -> Option<Self> {
        if self.0.len().saturating_mul(other.0.len()) > most {
            return None;
        }
        Some(self.times(other))
    }

    /// The product.
    pub fn times(&self, other: &Self) -> Self {
        if let [(monomial, value)] = other.0.as_slice()
            && monomial.is_empty()
        {
            return self.scaled(&Rational(value.clone()));
        }
        let (many, single) = if self.0.len() == 1 {
            (other, self)
        } else {
            (self, other)
        };
        if let [(monomial, value)] = single.0.as_slice() {
            // different monomials stay different
            let terms = many
                .0
                .iter()
                .map(|(own, factor)| (product(own, monomial), factor * value));
            let mut list: Vec<(Monomial, RBig)> = terms.collect();
            list.sort_unstable_by(|a, b| a.0.cmp(&b.0));
            return Self(list);
        }
        self.packed_times(other).unwrap_or_else(|| {
            let pairs = self.0.iter().flat_map(|a| other.0.iter().map(move |b| (a, b)));
            Self::from_terms(pairs.map(|(a, b)| (product(&a.0, &b.0), &a.1 * &b.1)))
        })
    }

    /// The product with the exponents of a monomial in one number and integer coefficients over one denominator;
    /// `None` where the exponents do not fit.
    fn packed_times(&self, other: &Self) -> Option<Self> {
        let mut generators = self.generators();
        generators.extend(other.generators());
        generators.sort_unstable();
        generators.dedup();
        let bits = 128_u32.checked_div(u32::try_from(generators.len()).ok()?)?.min(32);
        let limit = 1_u64 << bits;
        if u64::from(self.degree()) + u64::from(other.degree()) >= limit {
            return None;
        }
        let packed = |of: &Self| -> Option<(Vec<(u128, IBig)>, UBig)> {
            let denominators = of.0.iter().map(|(_, value)| value.denominator().clone());
            let common = denominators.fold(
                UBig::ONE,
                |a, b| if b.is_one() { a } else { &a / a.clone().gcd(&b) * b },
            );
            let terms = of.0.iter().map(|(monomial, value)| {
                let mut exponents = 0_u128;
                for (term, power) in monomial {
                    let place = generators.binary_search(term).ok()?;
                    exponents |= u128::from(*power) << (bits * u32::try_from(place).ok()?);
                }
                Some((exponents, value.numerator() * (&common / value.denominator())))
            });
            Some((terms.collect::<Option<_>>()?, common))
        };
        let ((a, above), (b, below)) = (packed(self)?, packed(other)?);
        let mut sums: HashMap<u128, IBig, BuildHasherDefault<Mixed>> = HashMap::default();
        for (x, value) in &a {
            for (y, other) in &b {
                *sums.entry(x + y).or_insert(IBig::ZERO) += value * other;
            }
        }
        let common = above * below;
        let mask = u128::from(limit - 1);
        let terms = sums.into_iter().filter(|(_, value)| !value.is_zero());
        let terms = terms.map(|(exponents, value)| {
            let places = generators.iter().zip((0..).step_by(bits as usize));
            let powers = places.map(|(term, place)| (*term, ((exponents >> place) & mask) as u32));
            (
                powers.filter(|(_, power)| *power > 0).collect(),
                RBig::from_parts(value, common.clone()),
            )
        });
        let mut list: Vec<(Monomial, RBig)> = terms.collect();
        list.sort_unstable_by(|a, b| a.0.cmp(&b.0));
        Some(Self(list))
    }

    /// The product with a number.
    pub fn scaled(&self, factor: &Rational) -> Self {
        let list = self.0.iter().map(|(m, c)| (m.clone(), c * &factor.0));
        Self::from_list(list.collect())
    }

    /// The opposite.
    pub fn negated(&self) -> Self {
        Self(self.0.iter().map(|(m, c)| (m.clone(), -c.clone())).collect())
    }

    /// Whether one is the other times a number that is not 0.
    pub fn is_multiple_of(&self, other: &Self) -> bool {
        let (Some(a), Some(b)) = (self.0.first(), other.0.first()) else {
            return self.is_zero() && other.is_zero();
        };
        self.0.len() == other.0.len() && a.0 == b.0 && *self == other.scaled(&Rational(&a.1 / &b.1))
    }
}

/// The product of two monomials.
pub fn product(a: &Monomial, b: &Monomial) -> Monomial {
    let (mut merged, mut left, mut right) = (Monomial::new(), 0, 0);
    while let (Some(&(x, n)), Some(&(y, m))) = (a.get(left), b.get(right)) {
        match x.cmp(&y) {
            std::cmp::Ordering::Less => {
                merged.push((x, n));
                left += 1;
            }
            std::cmp::Ordering::Greater => {
                merged.push((y, m));
                right += 1;
            }
            std::cmp::Ordering::Equal => {
                merged.push((x, n.saturating_add(m)));
                (left, right) = (left + 1, right + 1);
            }
        }
    }
    merged.extend(a.iter().skip(left).copied());
    merged.extend(b.iter().skip(right).copied());
    merged
}
