//! Gröbner bases, with cofactors in the polynomials that were given.
//!
//! Buchberger's algorithm runs modulo the prime 2^61 - 1 and records what it does. What the wanted result rests on is
//! then done again over the rationals, and the cofactors are collected backwards from the result, so that nothing is
//! computed for elements that are not needed. A prime that divides a leading coefficient can only hide a membership.

use super::division::shifted;
use super::order::{Key, Order, key_product, key_quotient};
use super::reduction::{Divisor, Reduction, Working, integral, make_primitive, mask, modular, polynomial};
use super::residue::Residue;
use super::steps::{Exhausted, Result, Steps};
use dashu_int::IBig;
use dashu_ratio::RBig;
use kernel::{Monomial, Polynomial, Term};
use std::collections::BTreeMap;

/// A sum of multiples of elements: the element, a monomial, a number.
type Multiples = Vec<(usize, Key, RBig)>;

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
pub(super) struct Engine {
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
pub(super) struct Target {
    start: Working<IBig>,
    factor: RBig,
    reduction: Reduction<Residue>,
}

impl Engine {
    /// Prepares; the generators of nonzero factors' inverses must not occur elsewhere.
    pub(super) fn new(polynomials: &[Polynomial], nonzero: &[(Polynomial, Term)], order: Order) -> Result<Self> {
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
    pub(super) fn run(&mut self, targets: &mut [Target], steps: &mut Steps) -> Result<Option<usize>> {
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
    pub(super) fn cofactors(&self, target: &Target, steps: &mut Steps) -> Result<Option<Vec<Polynomial>>> {
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

    pub(super) fn target(&self, p: &Polynomial) -> Result<Target> {
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
    fn reduced(&self, p: &Polynomial, steps: &mut Steps) -> Result<(Multiples, Polynomial)> {
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
