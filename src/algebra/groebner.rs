//! Gröbner bases and ideal membership, with cofactors in the polynomials that were given.
//!
//! Buchberger's algorithm runs modulo the prime 2^61 - 1 and records what it does. What the wanted result rests on is
//! then done again over the rationals, and the cofactors are collected backwards from the result, so that nothing is
//! computed for elements that are not needed. A prime that divides a leading coefficient can only hide a membership.

use super::division::{coefficients_in, degree_in, exact_quotient, power, shifted, times};
use super::order::{Key, Order, key_product, key_quotient};
use super::reduction::{Divisor, Reduction, Working, integral, make_primitive, mask, modular, polynomial};
use super::residue::Residue;
use super::steps::{Exhausted, Result, Steps};
use crate::kernel::{Monomial, Polynomial, Term};
use dashu_int::IBig;
use dashu_ratio::RBig;
use std::collections::BTreeMap;

/// Where the computation of an element begins.
#[derive(Clone, Debug)]
enum Start {
    /// A given polynomial.
    Given(usize),
    /// A monomial times an element: the first half of an S-polynomial, the other half is the first step.
    Multiple(usize, Key),
}

/// An element of the basis modulo the prime, and how it was made.
#[derive(Clone, Debug)]
struct Element {
    poly: Working<Residue>,
    lead: Key,
    test: Divisor,
    sugar: u32,
    start: Start,
    /// The multiples of elements that were taken off, in their order.
    reduced_by: Vec<(usize, Key)>,
    /// The factors that were divided out, by their number in `Engine::nonzero`.
    divided_by: Vec<usize>,
    /// Whether the leading monomial of a later element divides this one's.
    redundant: bool,
}

/// What is still to be reduced.
#[derive(Clone, Debug)]
struct Candidate {
    sugar: u32,
    lcm: Key,
    of: Origin,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    Given(usize),
    Pair(usize, usize),
}

/// Buchberger's algorithm modulo the prime.
struct Engine {
    order: Order,
    given: Vec<Working<IBig>>,
    given_factor: Vec<RBig>,
    /// Factors that may be divided out, each with the generator that stands for its inverse.
    nonzero: Vec<(Polynomial, Term)>,
    nonzero_working: Vec<(Working<IBig>, Working<Residue>, RBig)>,
    elements: Vec<Element>,
    queue: Vec<Candidate>,
}

/// What one target came to.
struct Target {
    start: Working<IBig>,
    factor: RBig,
    reduction: Reduction<Residue>,
}

impl Engine {
    /// Prepares; the generators of nonzero factors' inverses must not occur elsewhere.
    fn new(polynomials: &[Polynomial], nonzero: &[(Polynomial, Term)], order: Order) -> Result<Self> {
        let mut engine = Self {
            order,
            given: Vec::new(),
            given_factor: Vec::new(),
            nonzero: nonzero.to_vec(),
            nonzero_working: Vec::new(),
            elements: Vec::new(),
            queue: Vec::new(),
        };
        for p in polynomials {
            let (list, factor) = integral(p, &engine.order)?;
            if let Some((lead, _)) = list.first() {
                let sugar = list.iter().map(|(key, _)| engine.order.degree(key)).max().unwrap_or(0);
                let of = Origin::Given(engine.given.len());
                engine.queue.push(Candidate {
                    sugar,
                    lcm: lead.clone(),
                    of,
                });
            }
            engine.given.push(list);
            engine.given_factor.push(factor);
        }
        for (p, _) in nonzero {
            let (list, factor) = integral(p, &engine.order)?;
            let residues = modular(&list).ok_or(Exhausted)?;
            engine.nonzero_working.push((list, residues, factor));
        }
        Ok(engine)
    }

    /// The first element that is not redundant and whose leading monomial divides this one.
    fn find(&self, key: &Key) -> Option<(usize, &Working<Residue>)> {
        let exponents = self.order.exponents(key);
        let mask = mask(&exponents);
        let mut elements = self.elements.iter().enumerate();
        let found = elements.find(|(_, e)| !e.redundant && e.test.divides(&exponents, mask));
        found.map(|(index, element)| (index, &element.poly))
    }

    /// Runs until a target is 0 in the quotient, and returns its number; `None` where the basis is complete first.
    fn run(&mut self, targets: &mut [Target], steps: &mut Steps) -> Result<Option<usize>> {
        loop {
            for (index, target) in targets.iter_mut().enumerate() {
                let newest = self.elements.last();
                let reducible = |key: &Key| newest.is_none_or(|element| self.order.divides(&element.lead, key));
                if target.reduction.done.iter().any(|(key, _)| reducible(key)) {
                    target.reduction.reopen();
                }
                target.reduction.reduce(true, |key| self.find(key), steps)?;
                if target.reduction.done.is_empty() {
                    return Ok(Some(index));
                }
            }
            loop {
                steps.take(1 + self.queue.len() as u64 / 4)?;
                let least = (0..self.queue.len()).min_by(|&a, &b| {
                    let (a, b) = (&self.queue[a], &self.queue[b]);
                    (a.sugar, &a.lcm).cmp(&(b.sugar, &b.lcm))
                });
                let Some(least) = least else { return Ok(None) };
                let candidate = self.queue.swap_remove(least);
                if self.add(&candidate, steps)? {
                    break;
                }
            }
        }
    }

    /// Reduces a candidate; true where it makes a new element.
    fn add(&mut self, candidate: &Candidate, steps: &mut Steps) -> Result<bool> {
        let (start, mut reduction) = match candidate.of {
            Origin::Given(index) => {
                let residues = modular(&self.given[index]).ok_or(Exhausted)?;
                (Start::Given(index), Reduction::new(&residues, None)?)
            }
            Origin::Pair(a, b) => {
                let (first, second) = (&self.elements[a], &self.elements[b]);
                let by = key_quotient(&candidate.lcm, &first.lead);
                let mut reduction = Reduction::new(&first.poly, Some(&by))?;
                reduction.cancel_at(&candidate.lcm, (b, &second.poly), steps)?;
                (Start::Multiple(a, by), reduction)
            }
        };
        reduction.reduce(false, |key| self.find(key), steps)?;
        let reduced_by = reduction
            .quotients
            .drain(..)
            .map(|(index, key, _)| (index, key))
            .collect();
        let mut poly = reduction.remainder();
        let mut divided_by = Vec::new();
        if poly.is_empty() {
            return Ok(false);
        }
        for (index, (_, factor, _)) in self.nonzero_working.iter().enumerate() {
            while let Some(quotient) = exact(&poly, factor, &self.order, steps)? {
                divided_by.push(index);
                poly = quotient;
            }
        }
        make_primitive(&mut poly);
        let Some((lead, _)) = poly.first() else {
            return Ok(false);
        };
        let lead = lead.clone();
        let degree = poly.iter().map(|(key, _)| self.order.degree(key)).max().unwrap_or(0);
        let sugar = if divided_by.is_empty() {
            candidate.sugar.max(degree)
        } else {
            degree
        };
        let test = Divisor::new(&lead, &self.order);
        self.update(&lead, sugar, steps)?;
        self.elements.push(Element {
            poly,
            lead,
            test,
            sugar,
            start,
            reduced_by,
            divided_by,
            redundant: false,
        });
        Ok(true)
    }

    /// The pairs with a new element; pairs that others make superfluous are left away.
    ///
    /// Source: Gebauer, Möller, On an installation of Buchberger's algorithm, J. Symb. Comput. 6 (1988) 275-286.
    fn update(&mut self, lead: &Key, sugar: u32, steps: &mut Steps) -> Result<()> {
        let new = self.elements.len();
        steps.take(1 + self.queue.len() as u64 + new as u64)?;
        let order = &self.order;
        let lcms: Vec<Key> = self
            .elements
            .iter()
            .map(|element| order.lcm(&element.lead, lead))
            .collect();
        self.queue.retain(|candidate| match candidate.of {
            Origin::Given(_) => true,
            Origin::Pair(a, b) => {
                !order.divides(lead, &candidate.lcm) || lcms[a] == candidate.lcm || lcms[b] == candidate.lcm
            }
        });
        let mut kept: Vec<usize> = (0..new).filter(|&index| !self.elements[index].redundant).collect();
        let coprime = |index: usize| {
            let product = key_product(&self.elements[index].lead, lead);
            product.is_ok_and(|product| product == lcms[index])
        };
        // of several pairs with one least common multiple, one of coprime monomials goes first: it then goes alone
        kept.sort_by_key(|&index| (order.degree(&lcms[index]), !coprime(index)));
        let mut chosen: Vec<usize> = Vec::new();
        for index in kept {
            if !chosen.iter().any(|&other| order.divides(&lcms[other], &lcms[index])) {
                chosen.push(index);
            }
        }
        for index in chosen {
            if coprime(index) {
                continue;
            }
            let element = &self.elements[index];
            let lcm = lcms[index].clone();
            let over = |sugar: u32, lead: &Key| sugar.saturating_sub(order.degree(lead));
            let above = over(element.sugar, &element.lead).max(over(sugar, lead));
            self.queue.push(Candidate {
                sugar: above + order.degree(&lcm),
                lcm,
                of: Origin::Pair(index, new),
            });
        }
        for element in &mut self.elements {
            element.redundant |= order.divides(lead, &element.lead);
        }
        Ok(())
    }

    /// Does again over the rationals what these elements rest on; `None` where the prime was an unlucky one.
    fn lift(&self, wanted: impl IntoIterator<Item = usize>, steps: &mut Steps) -> Result<Option<Lifted>> {
        let needed = self.needed(wanted);
        let mut lifted = Lifted {
            elements: vec![None; self.elements.len()],
        };
        for index in (0..self.elements.len()).filter(|&index| needed[index]) {
            let Some(element) = self.lift_element(index, &lifted, steps)? else {
                return Ok(None);
            };
            lifted.elements[index] = Some(element);
        }
        Ok(Some(lifted))
    }

    /// Which elements these elements rest on, themselves included.
    fn needed(&self, wanted: impl IntoIterator<Item = usize>) -> Vec<bool> {
        let mut needed = vec![false; self.elements.len()];
        wanted.into_iter().for_each(|index| needed[index] = true);
        for index in (0..self.elements.len()).rev() {
            if needed[index] {
                let element = &self.elements[index];
                if let Start::Multiple(other, _) = element.start {
                    needed[other] = true;
                }
                element.reduced_by.iter().for_each(|(other, _)| needed[*other] = true);
            }
        }
        needed
    }

    fn lift_element(&self, index: usize, lifted: &Lifted, steps: &mut Steps) -> Result<Option<Exact>> {
        let element = &self.elements[index];
        let (mut reduction, start) = match &element.start {
            Start::Given(given) => {
                let reduction = Reduction::<IBig>::new(&self.given[*given], None)?;
                let source = Source::Given(*given);
                (
                    reduction,
                    (source, self.order.unit(), RBig::ONE / &self.given_factor[*given]),
                )
            }
            Start::Multiple(other, by) => {
                let Some(exact) = lifted.get(*other) else {
                    return Ok(None);
                };
                (
                    Reduction::new(&exact.poly, Some(by))?,
                    (Source::Element(*other), by.clone(), RBig::ONE),
                )
            }
        };
        if !replay(&mut reduction, &element.reduced_by, lifted, steps)? {
            return Ok(None);
        }
        let mut made_of = vec![start];
        for (other, key, value) in reduction.quotients.drain(..) {
            made_of.push((Source::Element(other), key, -value));
        }
        let mut scale = reduction.scale.clone();
        let mut poly = reduction.remainder();
        for &factor in &element.divided_by {
            let (divisor, _, by) = &self.nonzero_working[factor];
            let Some(quotient) = exact(&poly, divisor, &self.order, steps)? else {
                return Ok(None);
            };
            poly = quotient;
            // the factor is `by` times its primitive part
            scale *= by;
        }
        if poly.first().map(|(key, _)| key) != Some(&element.lead) {
            return Ok(None);
        }
        let content = make_primitive(&mut poly);
        let inverse = element.divided_by.iter().try_fold(self.order.unit(), |key, &factor| {
            let place = self.order.place(self.nonzero[factor].1).ok_or(Exhausted)?;
            key_product(&key, &self.order.key_of_power(place, 1))
        })?;
        scale /= RBig::from(content);
        for (_, key, value) in &mut made_of {
            *key = key_product(key, &inverse)?;
            *value *= &scale;
        }
        Ok(Some(Exact { poly, made_of }))
    }

    /// The cofactors, in the given polynomials, of a sum of multiples of elements.
    fn express(
        &self,
        sum: impl IntoIterator<Item = (usize, Key, RBig)>,
        lifted: &Lifted,
        steps: &mut Steps,
    ) -> Result<Vec<BTreeMap<Key, RBig>>> {
        let mut cofactors = vec![BTreeMap::new(); self.given.len()];
        let mut multiples: Vec<BTreeMap<Key, RBig>> = vec![BTreeMap::new(); self.elements.len()];
        for (index, key, value) in sum {
            add_to(&mut multiples[index], key, value);
        }
        for index in (0..self.elements.len()).rev() {
            let multiple = std::mem::take(&mut multiples[index]);
            let Some(exact) = lifted.get(index) else { continue };
            for (source, by, factor) in &exact.made_of {
                let sum = match source {
                    Source::Given(given) => &mut cofactors[*given],
                    Source::Element(other) => &mut multiples[*other],
                };
                for (key, value) in &multiple {
                    steps.take(1 + bits(value) / 64)?;
                    add_to(sum, key_product(key, by)?, value * factor);
                }
            }
        }
        Ok(cofactors)
    }

    /// The cofactors of a target that was reduced to 0; generators for inverses may occur in them.
    fn cofactors(&self, target: &Target, steps: &mut Steps) -> Result<Option<Vec<Polynomial>>> {
        let trail: Vec<(usize, Key)> = target
            .reduction
            .quotients
            .iter()
            .map(|(index, key, _)| (*index, key.clone()))
            .collect();
        let Some(lifted) = self.lift(trail.iter().map(|(index, _)| *index), steps)? else {
            return Ok(None);
        };
        let mut reduction = Reduction::<IBig>::new(&target.start, None)?;
        if !replay(&mut reduction, &trail, &lifted, steps)? || !reduction.rest.is_empty() {
            return Ok(None);
        }
        let sum = reduction
            .quotients
            .into_iter()
            .map(|(index, key, value)| (index, key, value * &target.factor));
        let cofactors = self.express(sum, &lifted, steps)?;
        let as_polynomial = |cofactor: &BTreeMap<Key, RBig>| {
            polynomial(cofactor.iter().map(|(key, value)| (key, value.clone())), &self.order)
        };
        Ok(Some(cofactors.iter().map(as_polynomial).collect()))
    }

    fn target(&self, p: &Polynomial) -> Result<Target> {
        let (start, factor) = integral(p, &self.order)?;
        let residues = modular(&start).ok_or(Exhausted)?;
        Ok(Target {
            reduction: Reduction::new(&residues, None)?,
            start,
            factor,
        })
    }
}

/// A given polynomial or an element.
#[derive(Clone, Copy, Debug)]
enum Source {
    Given(usize),
    Element(usize),
}

/// An element over the rationals: `poly = sum value * monomial * source`.
#[derive(Clone, Debug)]
struct Exact {
    poly: Working<IBig>,
    made_of: Vec<(Source, Key, RBig)>,
}

/// The elements that were done again over the rationals.
#[derive(Clone, Debug)]
struct Lifted {
    elements: Vec<Option<Exact>>,
}

impl Lifted {
    fn get(&self, index: usize) -> Option<&Exact> {
        self.elements.get(index).and_then(Option::as_ref)
    }
}

/// Takes off the same multiples of the same elements; false where the terms do not fit.
fn replay(reduction: &mut Reduction<IBig>, trail: &[(usize, Key)], lifted: &Lifted, steps: &mut Steps) -> Result<bool> {
    for (index, by) in trail {
        let Some(exact) = lifted.get(*index) else {
            return Ok(false);
        };
        let Some((lead, _)) = exact.poly.first() else {
            return Ok(false);
        };
        if !reduction.cancel_at(&key_product(lead, by)?, (*index, &exact.poly), steps)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The exact quotient by a primitive polynomial that is not constant; `None` where it is none.
fn exact<C: super::coefficient::Coefficient<Fraction: Integral<C>> + From<u8>>(
    p: &Working<C>,
    divisor: &Working<C>,
    order: &Order,
    steps: &mut Steps,
) -> Result<Option<Working<C>>> {
    let Some((lead, _)) = divisor.first() else {
        return Ok(None);
    };
    let divides = |key: &Key| order.divides(lead, key);
    if order.degree(lead) == 0 || !p.first().is_some_and(|(key, _)| divides(key)) {
        return Ok(None);
    }
    let mut reduction = Reduction::new(p, None)?;
    reduction.reduce(false, |key| divides(key).then_some((0, divisor)), steps)?;
    if !reduction.done.is_empty() {
        return Ok(None);
    }
    // Gauss: the quotient by a primitive divisor is integral
    let quotient = reduction
        .quotients
        .drain(..)
        .map(|(_, key, value)| Some((key, value.integral()?)));
    Ok(quotient.collect())
}

/// A quotient of coefficients as a coefficient.
trait Integral<C> {
    fn integral(self) -> Option<C>;
}

impl Integral<IBig> for RBig {
    fn integral(self) -> Option<IBig> {
        self.is_int().then(|| self.into_parts().0)
    }
}

impl Integral<Residue> for Residue {
    fn integral(self) -> Option<Residue> {
        Some(self)
    }
}

fn add_to(sum: &mut BTreeMap<Key, RBig>, key: Key, value: RBig) {
    match sum.entry(key) {
        std::collections::btree_map::Entry::Vacant(place) => {
            place.insert(value);
        }
        std::collections::btree_map::Entry::Occupied(mut place) => {
            *place.get_mut() += value;
            if place.get().is_zero() {
                place.remove();
            }
        }
    }
}

fn bits(value: &RBig) -> u64 {
    use dashu_int::ops::BitTest;
    (value.numerator().bit_len() + value.denominator().bit_len()) as u64
}

/// A Gröbner basis, with cofactors in the polynomials that were given.
pub struct Basis {
    engine: Engine,
    lifted: Lifted,
    /// The elements that make the basis.
    members: Vec<usize>,
    elements: Vec<Polynomial>,
}

/// A minimal Gröbner basis: no leading monomial divides another.
///
/// Its elements are proved to be in the ideal by their cofactors; that it is complete holds unless 2^61 - 1 is an
/// unlucky prime for these polynomials. Generators that the order does not rank come last, in a graded block.
pub fn groebner(polynomials: &[Polynomial], order: &Order, steps: &mut Steps) -> Result<Basis> {
    let mut order = order.clone();
    order.cover(polynomials);
    let mut engine = Engine::new(polynomials, &[], order)?;
    engine.run(&mut [], steps)?;
    let members: Vec<usize> = (0..engine.elements.len())
        .filter(|&index| !engine.elements[index].redundant)
        .collect();
    let lifted = engine.lift(members.iter().copied(), steps)?.ok_or(Exhausted)?;
    let exact = members.iter().filter_map(|&index| lifted.get(index));
    let elements = exact.map(|exact| {
        let terms = exact.poly.iter().map(|(key, value)| (key, RBig::from(value.clone())));
        polynomial(terms, &engine.order)
    });
    let elements = elements.collect();
    Ok(Basis {
        engine,
        lifted,
        members,
        elements,
    })
}

impl Basis {
    /// The elements: integer coefficients without a common factor, the leading one positive.
    pub fn elements(&self) -> &[Polynomial] {
        &self.elements
    }

    /// The cofactors of an element: `elements[index] = sum cofactors[i] * polynomials[i]`.
    pub fn cofactors(&self, index: usize, steps: &mut Steps) -> Result<Vec<Polynomial>> {
        let Some(&element) = self.members.get(index) else {
            return Ok(Vec::new());
        };
        self.express([(element, self.engine.order.unit(), RBig::ONE)], steps)
    }

    /// The normal form: `p - normal form` is in the ideal, and no leading monomial divides one of its terms. Unique
    /// for each class modulo the ideal.
    pub fn normal_form(&self, p: &Polynomial, steps: &mut Steps) -> Result<Polynomial> {
        let mut sum = Polynomial::default();
        for (outer, part) in self.parts(p) {
            sum = sum.plus(&shifted(&self.reduced(&part, steps)?.1, &outer, &RBig::ONE));
        }
        Ok(sum)
    }

    /// Cofactors of p in the polynomials that were given; `None` where p is not in the ideal.
    pub fn member(&self, p: &Polynomial, steps: &mut Steps) -> Result<Option<Vec<Polynomial>>> {
        let mut cofactors = vec![Polynomial::default(); self.engine.given.len()];
        for (outer, part) in self.parts(p) {
            let (sum, remainder) = self.reduced(&part, steps)?;
            if !remainder.is_zero() {
                return Ok(None);
            }
            for (cofactor, more) in cofactors.iter_mut().zip(self.express(sum, steps)?) {
                *cofactor = cofactor.plus(&shifted(&more, &outer, &RBig::ONE));
            }
        }
        Ok(Some(cofactors))
    }

    fn express(&self, sum: impl IntoIterator<Item = (usize, Key, RBig)>, steps: &mut Steps) -> Result<Vec<Polynomial>> {
        let cofactors = self.engine.express(sum, &self.lifted, steps)?;
        let order = &self.engine.order;
        let as_polynomial =
            |list: &BTreeMap<Key, RBig>| polynomial(list.iter().map(|(key, value)| (key, value.clone())), order);
        Ok(cofactors.iter().map(as_polynomial).collect())
    }

    /// The multiples of elements that are taken off, and what remains.
    fn reduced(&self, p: &Polynomial, steps: &mut Steps) -> Result<(Vec<(usize, Key, RBig)>, Polynomial)> {
        let order = &self.engine.order;
        let (start, factor) = integral(p, order)?;
        let mut reduction = Reduction::<IBig>::new(&start, None)?;
        let find = |key: &Key| {
            let (index, _) = self.engine.find(key)?;
            Some((index, &self.lifted.get(index)?.poly))
        };
        reduction.reduce(true, find, steps)?;
        let sum = reduction
            .quotients
            .drain(..)
            .map(|(index, key, value)| (index, key, value * &factor))
            .collect();
        let scale = factor / &reduction.scale;
        let remainder = reduction.remainder();
        Ok((
            sum,
            polynomial(remainder.iter().map(|(key, value)| (key, &scale * value)), order),
        ))
    }

    /// The coefficients of p over the generators that the basis does not know, with their monomials.
    fn parts(&self, p: &Polynomial) -> BTreeMap<Monomial, Polynomial> {
        let known = |term: &Term| self.engine.order.place(*term).is_some();
        let mut parts: BTreeMap<Monomial, Vec<(Monomial, RBig)>> = BTreeMap::new();
        for (monomial, value) in p.terms() {
            let (inner, outer) = monomial.iter().copied().partition(|(term, _)| known(term));
            parts.entry(outer).or_default().push((inner, value.clone()));
        }
        parts
            .into_iter()
            .map(|(outer, list)| (outer, Polynomial::from_terms(list)))
            .collect()
    }
}

/// Cofactors of p in the ideal of the polynomials: `p = sum cofactors[i] * polynomials[i]`. `None` where p is not in
/// it, unless 2^61 - 1 is an unlucky prime for these polynomials.
pub fn member(
    p: &Polynomial,
    polynomials: &[Polynomial],
    order: &Order,
    steps: &mut Steps,
) -> Result<Option<Vec<Polynomial>>> {
    let found = first_member(&[p], polynomials, &[], order, steps)?;
    Ok(found.map(|(_, cofactors)| cofactors))
}

/// A product of the factors that are not 0 lies in the ideal:
/// `prod nonzero[j]^exponents[j] = sum cofactors[i] * polynomials[i]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refutation {
    pub exponents: Vec<u32>,
    pub cofactors: Vec<Polynomial>,
}

/// A power of p times factors that are not 0 lies in the ideal:
/// `p^power * prod nonzero[j]^exponents[j] = sum cofactors[i] * polynomials[i]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RadicalMembership {
    pub power: u32,
    pub exponents: Vec<u32>,
    pub cofactors: Vec<Polynomial>,
}

/// Looks for a proof that the polynomials have no common zero, over the complex numbers, where none of the factors
/// is 0. `None` where there are such zeros, unless 2^61 - 1 is an unlucky prime.
///
/// First factors are only divided out where they show; then their inverses are adjoined (Rabinowitsch).
pub fn contradiction(
    polynomials: &[Polynomial],
    nonzero: &[Polynomial],
    order: &Order,
    steps: &mut Steps,
) -> Result<Option<Refutation>> {
    let one = Polynomial::integer(1);
    let inverses = with_inverses(nonzero);
    let half = steps.left() / 2;
    let quick = |steps: &mut Steps| first_member(&[&one], polynomials, &inverses, order, steps);
    let found = match steps.attempt(half, quick).flatten() {
        Some((_, cofactors)) => Some(cofactors),
        None if nonzero.is_empty() => None,
        None => adjoined(polynomials, &inverses, order, steps)?,
    };
    let Some(cofactors) = found else {
        return if steps.left() < half { Err(Exhausted) } else { Ok(None) };
    };
    let (exponents, cofactors) = clear_inverses(cofactors, &inverses, steps)?;
    Ok(Some(Refutation { exponents, cofactors }))
}

/// Looks for a proof that p is 0 at all common zeros of the polynomials, over the complex numbers, where none of the
/// factors is 0. `None` where it is not, unless 2^61 - 1 is an unlucky prime.
///
/// First small powers of p are reduced while factors are divided out; then the inverses of the factors and of p are
/// adjoined (Rabinowitsch), which decides.
pub fn radical_member(
    p: &Polynomial,
    polynomials: &[Polynomial],
    nonzero: &[Polynomial],
    order: &Order,
    steps: &mut Steps,
) -> Result<Option<RadicalMembership>> {
    // factors of p that are not 0 are split off first
    let (mut core, mut split) = (p.clone(), Polynomial::integer(1));
    for factor in nonzero.iter().filter(|factor| factor.as_constant().is_none()) {
        while !core.is_zero()
            && let Some(quotient) = exact_quotient(&core, factor, steps)?
        {
            core = quotient;
            split = times(&split, factor, steps)?;
        }
    }
    let mut inverses = with_inverses(nonzero);
    let mut powers = vec![core.clone()];
    if core.terms().len() <= 12 {
        powers.push(times(&core, &core, steps)?);
    }
    let half = steps.left() / 2;
    let quick = |steps: &mut Steps| {
        let powers: Vec<&Polynomial> = powers.iter().collect();
        first_member(&powers, polynomials, &inverses, order, steps)
    };
    let (power_of_core, exponents, cofactors) = match steps.attempt(half, quick).flatten() {
        Some((index, cofactors)) => {
            let (exponents, cofactors) = clear_inverses(cofactors, &inverses, steps)?;
            (index as u32 + 1, exponents, cofactors)
        }
        None => {
            inverses = with_inverses(&[nonzero, &[core]].concat());
            let Some(cofactors) = adjoined(polynomials, &inverses, order, steps)? else {
                return Ok(None);
            };
            let (mut exponents, cofactors) = clear_inverses(cofactors, &inverses, steps)?;
            (exponents.pop().unwrap_or(0), exponents, cofactors)
        }
    };
    let factor = power(&split, power_of_core, steps)?;
    let mut whole = Vec::with_capacity(cofactors.len());
    for cofactor in &cofactors {
        whole.push(times(cofactor, &factor, steps)?);
    }
    Ok(Some(RadicalMembership {
        power: power_of_core,
        exponents,
        cofactors: whole,
    }))
}

/// The first target that lies in the ideal, where the factors may be divided by; its cofactors may hold the
/// generators that stand for inverses.
fn first_member(
    targets: &[&Polynomial],
    polynomials: &[Polynomial],
    inverses: &[(Polynomial, Term)],
    order: &Order,
    steps: &mut Steps,
) -> Result<Option<(usize, Vec<Polynomial>)>> {
    let mut order = order.clone();
    order.cover(
        polynomials
            .iter()
            .chain(targets.iter().copied())
            .chain(inverses.iter().map(|(p, _)| p)),
    );
    order.push_block(&inverses.iter().map(|(_, inverse)| *inverse).collect::<Vec<_>>());
    let mut engine = Engine::new(polynomials, inverses, order)?;
    let mut targets: Vec<Target> = targets.iter().map(|p| engine.target(p)).collect::<Result<_>>()?;
    let Some(index) = engine.run(&mut targets, steps)? else {
        return Ok(None);
    };
    let cofactors = engine.cofactors(&targets[index], steps)?;
    Ok(cofactors.map(|cofactors| (index, cofactors)))
}

/// Cofactors of 1 in the ideal of the polynomials and the relations `inverse * factor - 1`.
fn adjoined(
    polynomials: &[Polynomial],
    inverses: &[(Polynomial, Term)],
    order: &Order,
    steps: &mut Steps,
) -> Result<Option<Vec<Polynomial>>> {
    let mut all = polynomials.to_vec();
    let one = Polynomial::integer(1);
    for (factor, inverse) in inverses {
        all.push(times(factor, &Polynomial::generator(*inverse), steps)?.minus(&one));
    }
    let found = first_member(&[&one], &all, inverses, order, steps)?;
    Ok(found.map(|(_, mut cofactors)| {
        cofactors.truncate(polynomials.len());
        cofactors
    }))
}

/// A generator of its own for the inverse of each factor: numbers from the end, which no statement reaches.
fn with_inverses(factors: &[Polynomial]) -> Vec<(Polynomial, Term)> {
    factors
        .iter()
        .zip(0u32..)
        .map(|(factor, index)| (factor.clone(), Term(u32::MAX - index)))
        .collect()
}

/// Replaces the generators for inverses: all is multiplied by the least powers of the factors that clear them.
fn clear_inverses(
    cofactors: Vec<Polynomial>,
    inverses: &[(Polynomial, Term)],
    steps: &mut Steps,
) -> Result<(Vec<u32>, Vec<Polynomial>)> {
    let (mut exponents, mut cleared) = (Vec::with_capacity(inverses.len()), cofactors);
    for (factor, inverse) in inverses {
        let mut most = cleared
            .iter()
            .map(|cofactor| degree_in(cofactor, *inverse))
            .max()
            .unwrap_or(0);
        for cofactor in &mut cleared {
            // sum a_k / factor^k, times factor^most, by Horner's scheme
            let coefficients = coefficients_in(cofactor, *inverse);
            let (mut sum, missing) = (Polynomial::default(), most + 1 - coefficients.len().max(1) as u32);
            for coefficient in &coefficients {
                sum = times(&sum, factor, steps)?.plus(coefficient);
            }
            for _ in 0..missing {
                sum = times(&sum, factor, steps)?;
            }
            *cofactor = sum;
        }
        while most > 0 {
            let mut quotients = Vec::with_capacity(cleared.len());
            for cofactor in &cleared {
                match exact_quotient(cofactor, factor, steps)? {
                    Some(quotient) => quotients.push(quotient),
                    None => break,
                }
            }
            if quotients.len() < cleared.len() {
                break;
            }
            (cleared, most) = (quotients, most - 1);
        }
        exponents.push(most);
    }
    Ok((exponents, cleared))
}

#[cfg(test)]
mod tests {
    use super::super::testing::{any_polynomial, generator, plenty, poly, polys, sum_of_products};
    use super::*;
    use proptest::prelude::*;

    fn letters(text: &str) -> Vec<Term> {
        text.chars().map(generator).collect()
    }

    fn proved(found: &RadicalMembership, p: &Polynomial, given: &[Polynomial], nonzero: &[Polynomial]) {
        let mut left = power(p, found.power, &mut plenty()).unwrap();
        for (factor, exponent) in nonzero.iter().zip(&found.exponents) {
            left = left.times(&power(factor, *exponent, &mut plenty()).unwrap());
        }
        assert_eq!(left, sum_of_products(&found.cofactors, given));
    }

    #[test]
    fn known_bases() {
        // Cox, Little, O'Shea, section 2.7, example 1 and section 2.8, example 2
        let given = polys(&["x^3 - 2x y", "x^2 y - 2y^2 + x"]);
        let basis = groebner(&given, &Order::graded(&letters("xy")), &mut plenty()).unwrap();
        assert_eq!(basis.elements(), polys(&["x^2", "2y^2 - x", "x y"]));
        for (index, element) in basis.elements().iter().enumerate() {
            assert_eq!(
                *element,
                sum_of_products(&basis.cofactors(index, &mut plenty()).unwrap(), &given)
            );
        }
        let sphere = polys(&["x^2 + y^2 + z^2 - 1", "x^2 + z^2 - y", "x - z"]);
        let basis = groebner(&sphere, &Order::lexicographic(&letters("xyz")), &mut plenty()).unwrap();
        let reduced = basis.normal_form(&poly("4z^4 + 2z^2"), &mut plenty()).unwrap();
        assert_eq!(reduced, poly("1"));
        assert_eq!(
            basis.normal_form(&poly("w x - w z + w"), &mut plenty()).unwrap(),
            poly("w")
        );
    }

    #[test]
    fn cyclic_and_katsura() {
        let cyclic = polys(&[
            "a + b + c + d",
            "a b + b c + c d + d a",
            "a b c + b c d + c d a + d a b",
            "a b c d - 1",
        ]);
        let basis = groebner(&cyclic, &Order::graded(&letters("abcd")), &mut plenty()).unwrap();
        assert_eq!(basis.elements().len(), 7);
        // a square that is in the ideal, of a polynomial that is not: (d + b)^2
        let p = poly("b + d");
        assert_eq!(
            member(&p, &cyclic, &Order::graded(&letters("abcd")), &mut plenty()),
            Ok(None)
        );
        let found = radical_member(&p, &cyclic, &[], &Order::graded(&letters("abcd")), &mut plenty())
            .unwrap()
            .unwrap();
        assert_eq!(found.power, 2);
        proved(&found, &p, &cyclic, &[]);
        let katsura = polys(&[
            "x + 2y + 2z + 2t - 1",
            "x^2 + 2y^2 + 2z^2 + 2t^2 - x",
            "2x y + 2y z + 2z t - y",
            "y^2 + 2x z + 2y t - z",
        ]);
        let basis = groebner(&katsura, &Order::graded(&letters("xyzt")), &mut plenty()).unwrap();
        assert_eq!(basis.elements().len(), 7);
        for (index, element) in basis.elements().iter().enumerate() {
            assert_eq!(
                *element,
                sum_of_products(&basis.cofactors(index, &mut plenty()).unwrap(), &katsura)
            );
        }
    }

    #[test]
    fn factors_that_are_not_zero() {
        let order = Order::default();
        let given = polys(&["a x - a y", "b y - b z"]);
        let nonzero = polys(&["a", "b"]);
        let p = poly("x - z");
        let found = radical_member(&p, &given, &nonzero, &order, &mut plenty())
            .unwrap()
            .unwrap();
        assert_eq!((found.power, found.exponents.as_slice()), (1, &[1, 1][..]));
        proved(&found, &p, &given, &nonzero);
        assert_eq!(
            radical_member(&p, &given, &polys(&["a"]), &order, &mut plenty()),
            Ok(None)
        );
        // x^3 = 0 and x y != 0
        let given = polys(&["x^3"]);
        let refuted = contradiction(&given, &polys(&["x y + x"]), &order, &mut plenty())
            .unwrap()
            .unwrap();
        let left = power(&poly("x y + x"), refuted.exponents[0], &mut plenty()).unwrap();
        assert_eq!(left, sum_of_products(&refuted.cofactors, &given));
        assert_eq!(contradiction(&given, &polys(&["y"]), &order, &mut plenty()), Ok(None));
        // the budget is kept
        assert_eq!(
            member(&p, &polys(&["x y - 1", "y^2 - x"]), &order, &mut Steps::new(3)),
            Err(Exhausted)
        );
    }

    #[test]
    fn a_chain_of_definitions_takes_few_steps() {
        // each of 20 generators is a quadratic polynomial of the next two
        let letters: Vec<char> = ('a'..='v').collect();
        let given: Vec<Polynomial> = (0..20)
            .map(|i| {
                let (x, y, z) = (letters[i], letters[i + 1], letters[i + 2]);
                poly(&if i % 8 == 0 {
                    format!("2{x} - {y} {z} + {z}")
                } else {
                    format!("3{x} - {y} + 2{z} - 1")
                })
            })
            .collect();
        let order = Order::triangular(&given);
        let p = poly("2a - b c + c")
            .times(&poly("f + g"))
            .plus(&poly("6e - 2f g + f + g - 1 + 2 g - 1 + 3"));
        let steps = &mut Steps::new(200_000);
        assert_eq!(member(&p, &given, &order, steps), Ok(None));
        let p = poly("a b").minus(&poly("1/2 (b c - c) b"));
        let cofactors = member(&p, &given, &order, steps).unwrap().unwrap();
        assert_eq!(p, sum_of_products(&cofactors, &given));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn members_are_found_and_proved(
            given in prop::collection::vec(any_polynomial(3, 3, 2), 2..=3),
            factors in prop::collection::vec(any_polynomial(3, 2, 1), 3),
            graded: bool,
        ) {
            let ranking = letters("abc");
            let order = if graded { Order::graded(&ranking) } else { Order::lexicographic(&ranking) };
            let p = sum_of_products(&given, &factors[..given.len()]);
            match member(&p, &given, &order, &mut Steps::new(3_000_000)) {
                Ok(Some(cofactors)) => prop_assert_eq!(&p, &sum_of_products(&cofactors, &given)),
                Ok(None) => prop_assert!(false, "a member is missed"),
                Err(Exhausted) => {}
            }
            let square = radical_member(&p, &given, &[], &order, &mut Steps::new(3_000_000));
            if let Ok(found) = square {
                proved(&found.unwrap(), &p, &given, &[]);
            }
        }

        #[test]
        fn inverses_are_cleared(
            given in any_polynomial(3, 3, 2),
            p in any_polynomial(3, 3, 1),
            factor in any_polynomial(3, 2, 1),
        ) {
            let factor = factor.plus(&poly("d"));
            let relations = vec![given.clone(), p.times(&factor)];
            let found = radical_member(&p, &relations, std::slice::from_ref(&factor), &Order::default(), &mut Steps::new(3_000_000));
            if let Ok(found) = found {
                proved(&found.unwrap(), &p, &relations, &[factor]);
            }
        }
    }
}
