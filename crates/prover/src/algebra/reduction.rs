//! Working polynomials and their reduction: a sum of multiples of other polynomials is taken off, term by term.

use super::coefficient::Coefficient;
use super::order::{Key, Order, key_product, key_quotient};
use super::residue::Residue;
use super::steps::{Result, Steps};
use dashu_int::ops::Gcd;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use kernel::Polynomial;
use std::collections::BTreeMap;

/// A working polynomial: its terms, the greatest first, none 0.
pub(super) type Working<C> = Vec<(Key, C)>;

/// A polynomial over the rationals as a number times one over the integers without content.
pub(super) fn integral(p: &Polynomial, order: &Order) -> Result<(Working<IBig>, RBig)> {
    let mut denominator = UBig::ONE;
    for (_, coefficient) in p.terms() {
        let other = coefficient.denominator();
        if !other.is_one() {
            denominator = &denominator / (&denominator).gcd(other) * other;
        }
    }
    let mut list: Working<IBig> = Vec::with_capacity(p.terms().len());
    for (monomial, coefficient) in p.terms() {
        let factor = &denominator / coefficient.denominator();
        list.push((order.key(monomial)?, coefficient.numerator() * IBig::from(factor)));
    }
    list.sort_unstable_by(|a, b| b.0.cmp(&a.0));
    let content = make_primitive(&mut list);
    Ok((list, RBig::from_parts(content, denominator)))
}

/// Divides by the content, with the sign of the leading coefficient, and returns it; 1 for the polynomial 0.
pub(super) fn make_primitive<C: Coefficient + From<u8>>(list: &mut Working<C>) -> C {
    let content = C::content(list.iter().map(|(_, c)| c)).unwrap_or_else(|| C::from(1));
    if !content.is_one() {
        for (_, coefficient) in list.iter_mut() {
            coefficient.divide(&content);
        }
    }
    content
}

impl From<u8> for Residue {
    fn from(value: u8) -> Self {
        Self::new(u64::from(value))
    }
}

/// The polynomial modulo the prime, not normalised; `None` where a denominator or the leading coefficient vanishes.
pub(super) fn modular(p: &Working<IBig>) -> Option<Working<Residue>> {
    let list: Working<Residue> = (p.iter())
        .map(|(key, coefficient)| (key.clone(), Residue::of_integer(coefficient)))
        .filter(|(_, coefficient)| !coefficient.is_zero())
        .collect();
    (list.first().map(|(key, _)| key) == p.first().map(|(key, _)| key)).then_some(list)
}

/// The kernel's polynomial.
pub(super) fn polynomial<'a>(terms: impl IntoIterator<Item = (&'a Key, RBig)>, order: &Order) -> Polynomial {
    Polynomial::from_terms(terms.into_iter().map(|(key, value)| (order.monomial(key), value)))
}

/// A polynomial by which others are reduced, with what finds quickly whether its leading monomial divides another.
#[derive(Clone, Debug)]
pub(super) struct Divisor {
    exponents: Vec<(usize, u16)>,
    mask: u64,
}

impl Divisor {
    pub(super) fn new(lead: &Key, order: &Order) -> Self {
        let exponents = order.exponents(lead);
        Self {
            mask: mask(&exponents),
            exponents: exponents.iter().copied().enumerate().filter(|(_, e)| *e > 0).collect(),
        }
    }

    /// Whether the leading monomial divides the monomial with these exponents and their [`mask`].
    pub(super) fn divides(&self, exponents: &Key, mask: u64) -> bool {
        self.mask & !mask == 0
            && self
                .exponents
                .iter()
                .all(|&(place, exponent)| exponents[place] >= exponent)
    }
}

/// The generators that occur, as bits.
pub(super) fn mask(exponents: &Key) -> u64 {
    let places = exponents.iter().enumerate().filter(|(_, e)| **e > 0);
    places.fold(0, |mask, (place, _)| mask | 1 << (place % 64))
}

/// A polynomial `p` during its reduction: `rest + done = scale (p - sum quotient * divisor)`.
#[derive(Clone, Debug)]
pub(super) struct Reduction<C: Coefficient> {
    /// The terms that may still be reducible.
    pub(super) rest: BTreeMap<Key, C>,
    /// The terms that no divisor reduces, the greatest first.
    pub(super) done: Working<C>,
    pub(super) scale: C::Fraction,
    /// The terms of the quotients: the divisor's number, a monomial, its coefficient.
    pub(super) quotients: Vec<(usize, Key, C::Fraction)>,
    scaled: u32,
}

impl<C: Coefficient + From<u8>> Reduction<C> {
    /// Begins with a multiple of a polynomial by a monomial.
    pub(super) fn new(p: &Working<C>, by: Option<&Key>) -> Result<Self> {
        let mut rest = BTreeMap::new();
        for (key, coefficient) in p {
            let key = by.map_or_else(|| Ok(key.clone()), |by| key_product(key, by))?;
            rest.insert(key, coefficient.clone());
        }
        Ok(Self {
            rest,
            done: Vec::new(),
            scale: C::one(),
            quotients: Vec::new(),
            scaled: 0,
        })
    }

    /// Takes off the multiple of a divisor that cancels the term `key`, where its leading monomial divides it and
    /// `coefficient` is what stood there; that term is out of `rest` already.
    pub(super) fn cancel(
        &mut self,
        key: &Key,
        mut coefficient: C,
        divisor: (usize, &Working<C>),
        steps: &mut Steps,
    ) -> Result<()> {
        let Some((lead, tail)) = divisor.1.split_first() else {
            return Ok(());
        };
        self.simplify(&mut coefficient);
        let (factor, multiple) = coefficient.cancel(&lead.1);
        if !factor.is_one() {
            self.multiply(&factor, steps)?;
        }
        let by = key_quotient(key, &lead.0);
        steps.take(1 + tail.len() as u64 * multiple.cost())?;
        for (monomial, value) in tail {
            match self.rest.entry(key_product(monomial, &by)?) {
                std::collections::btree_map::Entry::Vacant(place) => {
                    place.insert(multiple.times(value).negated());
                }
                std::collections::btree_map::Entry::Occupied(mut place) => {
                    place.get_mut().subtract_product(&multiple, value);
                    if place.get().is_zero() {
                        place.remove();
                    }
                }
            }
        }
        self.quotients.push((divisor.0, by, multiple.over(&self.scale)));
        Ok(())
    }

    /// Cancels the term at this monomial; false where there is none.
    pub(super) fn cancel_at(&mut self, key: &Key, divisor: (usize, &Working<C>), steps: &mut Steps) -> Result<bool> {
        match self.rest.remove(key) {
            Some(coefficient) => self.cancel(key, coefficient, divisor, steps).map(|()| true),
            None => Ok(false),
        }
    }

    /// Reduces by the divisors that `find` chooses for a monomial; the leading term only, or every term.
    pub(super) fn reduce<'a>(
        &mut self,
        every: bool,
        mut find: impl FnMut(&Key) -> Option<(usize, &'a Working<C>)>,
        steps: &mut Steps,
    ) -> Result<()>
    where
        C: 'a,
    {
        while let Some((key, coefficient)) = self.rest.pop_last() {
            steps.take(1)?;
            match find(&key) {
                Some(divisor) => self.cancel(&key, coefficient, divisor, steps)?,
                None => {
                    self.done.push((key, coefficient));
                    if !every {
                        break;
                    }
                }
            }
        }
        Ok(())
    }

    /// Makes every term one that may be reducible.
    pub(super) fn reopen(&mut self) {
        self.rest.extend(self.done.drain(..));
    }

    fn multiply(&mut self, factor: &C, steps: &mut Steps) -> Result<()> {
        for value in self.rest.values_mut().chain(self.done.iter_mut().map(|(_, c)| c)) {
            steps.take(value.cost())?;
            *value = value.times(factor);
        }
        self.scale = factor.scale(&self.scale);
        self.scaled += 1;
        Ok(())
    }

    /// Divides by the common factor of all coefficients, after every eighth multiplication.
    fn simplify(&mut self, coefficient: &mut C) {
        if self.scaled < 8 {
            return;
        }
        self.scaled = 0;
        let others = self.rest.values().chain(self.done.iter().map(|(_, c)| c));
        let Some(content) = C::content(std::iter::once(&*coefficient).chain(others)) else {
            return;
        };
        if !content.is_one() {
            coefficient.divide(&content);
            for value in self.rest.values_mut().chain(self.done.iter_mut().map(|(_, c)| c)) {
                value.divide(&content);
            }
            self.scale = content.unscale(&self.scale);
        }
    }

    /// What remains, the greatest term first; it is `scale` times the remainder.
    pub(super) fn remainder(&mut self) -> Working<C> {
        let mut list = std::mem::take(&mut self.done);
        list.extend(std::mem::take(&mut self.rest).into_iter().rev());
        list
    }
}
