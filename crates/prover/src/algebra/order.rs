//! Monomial orders, and exponent vectors whose plain comparison is the order.

use super::steps::{Exhausted, Result};
use kernel::{Monomial, Polynomial, Term};
use smallvec::SmallVec;
use std::cmp::Ordering;
use std::collections::{BTreeSet, HashMap};

/// A monomial as a vector of partial sums of exponents: products are sums, and the monomial order is the order of
/// vectors. In a block with exponents `e_1 .. e_n` it holds `e_1 + .. + e_n`, `e_1 + .. + e_(n-1)`, .., `e_1`.
pub(super) type Key = SmallVec<[u16; 24]>;

/// A monomial order: generators are ranked, the greatest first, and parted into blocks. Within a block monomials are
/// compared by graded reverse lexicographic order, and an earlier block decides before a later one.
///
/// One block is graded reverse lexicographic order, blocks of one generator each are lexicographic order.
#[derive(Clone, Debug, Default)]
pub struct Order {
    generators: Vec<Term>,
    /// Of each generator, where its block starts and ends.
    blocks: Vec<(usize, usize)>,
    places: HashMap<Term, usize>,
}

impl Order {
    /// Lexicographic order, the greatest generator first.
    pub fn lexicographic(ranking: &[Term]) -> Self {
        Self::blocks(ranking.iter().map(std::slice::from_ref))
    }

    /// Graded reverse lexicographic order, the greatest generator first.
    pub fn graded(ranking: &[Term]) -> Self {
        Self::blocks([ranking])
    }

    /// An elimination order: of two monomials that differ in an earlier block, this block decides.
    pub fn blocks<'a>(blocks: impl IntoIterator<Item = &'a [Term]>) -> Self {
        let mut order = Self::default();
        for block in blocks {
            order.push_block(block);
        }
        order
    }

    /// An order under which polynomials that define a generator by others, such as `x - y^2`, are rules that replace
    /// it: generators that occur in some polynomial linearly with a constant coefficient come first, each after those
    /// that are defined by it; all others follow in one graded block.
    pub fn triangular(polynomials: &[Polynomial]) -> Self {
        let mut open: Vec<&Polynomial> = polynomials.iter().filter(|p| !p.is_zero()).collect();
        let mut ranking: Vec<Term> = Vec::new();
        loop {
            // a generator that only one open polynomial holds, or else one with the shortest definition
            let mut best: Option<(usize, usize, Term, usize)> = None;
            for (index, p) in open.iter().enumerate() {
                for term in defined_by(p) {
                    let uses = open
                        .iter()
                        .filter(|q| q.generators().binary_search(&term).is_ok())
                        .count();
                    let candidate = (uses, p.terms().len(), term, index);
                    if best.is_none_or(|known| candidate < known) {
                        best = Some(candidate);
                    }
                }
            }
            let Some((_, _, term, index)) = best else { break };
            open.remove(index);
            if !ranking.contains(&term) {
                ranking.push(term);
            }
        }
        let mut order = Self::lexicographic(&ranking);
        order.cover(polynomials);
        order
    }

    /// The generators, the greatest first.
    pub fn generators(&self) -> &[Term] {
        &self.generators
    }

    /// Appends a block below all others; generators that are there already keep their place.
    pub(super) fn push_block(&mut self, block: &[Term]) {
        let start = self.generators.len();
        for &term in block {
            if let std::collections::hash_map::Entry::Vacant(place) = self.places.entry(term) {
                place.insert(self.generators.len());
                self.generators.push(term);
            }
        }
        let end = self.generators.len();
        self.blocks.extend(std::iter::repeat_n((start, end), end - start));
    }

    /// Appends the generators of these polynomials that have no place yet as one block.
    pub(super) fn cover<'a>(&mut self, polynomials: impl IntoIterator<Item = &'a Polynomial>) {
        let met: BTreeSet<Term> = polynomials.into_iter().flat_map(Polynomial::generators).collect();
        self.push_block(&met.into_iter().collect::<Vec<_>>());
    }

    /// How many generators there are.
    pub(super) fn len(&self) -> usize {
        self.generators.len()
    }

    /// The place of a generator.
    pub(super) fn place(&self, term: Term) -> Option<usize> {
        self.places.get(&term).copied()
    }

    /// Compares two monomials whose generators the order ranks.
    pub fn compare(&self, a: &Monomial, b: &Monomial) -> Ordering {
        match (self.key(a), self.key(b)) {
            (Ok(a), Ok(b)) => a.cmp(&b),
            _ => a.cmp(b),
        }
    }

    /// The key of 1.
    pub(super) fn unit(&self) -> Key {
        SmallVec::from_elem(0, self.len())
    }

    /// The key of a power of the generator at a place.
    pub(super) fn key_of_power(&self, place: usize, exponent: u16) -> Key {
        let mut key = self.unit();
        let (start, end) = self.blocks[place];
        for slot in &mut key[start..end - (place - start)] {
            *slot = exponent;
        }
        key
    }

    /// The key of a monomial; exponents beyond 16 bits, and generators without a place, exhaust any budget.
    pub(super) fn key(&self, monomial: &Monomial) -> Result<Key> {
        let mut key = self.unit();
        for &(term, exponent) in monomial {
            let place = self.place(term).ok_or(Exhausted)?;
            let exponent = u16::try_from(exponent).map_err(|_| Exhausted)?;
            let (start, end) = self.blocks[place];
            for slot in &mut key[start..end - (place - start)] {
                *slot = slot.checked_add(exponent).ok_or(Exhausted)?;
            }
        }
        Ok(key)
    }

    /// The exponents of a key, by place.
    pub(super) fn exponents(&self, key: &Key) -> Key {
        let mut exponents = key.clone();
        for (place, &(start, end)) in self.blocks.iter().enumerate() {
            let slot = end - 1 - (place - start);
            exponents[place] = if place == start {
                key[slot]
            } else {
                key[slot] - key[slot + 1]
            };
        }
        exponents
    }

    /// The key of exponents by place.
    pub(super) fn key_of_exponents(&self, exponents: &Key) -> Key {
        let mut key = exponents.clone();
        for (place, &(start, end)) in self.blocks.iter().enumerate() {
            let slot = end - 1 - (place - start);
            key[slot] = if place == start {
                exponents[place]
            } else {
                exponents[place].saturating_add(key[slot + 1])
            };
        }
        key
    }

    /// The total degree of a key.
    pub(super) fn degree(&self, key: &Key) -> u32 {
        let starts = self
            .blocks
            .iter()
            .enumerate()
            .filter(|(place, block)| *place == block.0);
        starts.map(|(place, _)| u32::from(key[place])).sum()
    }

    /// The monomial of a key.
    pub(super) fn monomial(&self, key: &Key) -> Monomial {
        let exponents = self.exponents(key);
        let mut monomial: Monomial = (self.generators.iter().zip(&exponents))
            .filter(|(_, exponent)| **exponent > 0)
            .map(|(term, exponent)| (*term, u32::from(*exponent)))
            .collect();
        monomial.sort_unstable();
        monomial
    }

    /// The least common multiple.
    pub(super) fn lcm(&self, a: &Key, b: &Key) -> Key {
        let (mut a, b) = (self.exponents(a), self.exponents(b));
        for (x, y) in a.iter_mut().zip(&b) {
            *x = (*x).max(*y);
        }
        self.key_of_exponents(&a)
    }

    /// Whether the first divides the second.
    pub(super) fn divides(&self, a: &Key, b: &Key) -> bool {
        // the greatest slots of the blocks decide most cases
        if a.iter().zip(b).any(|(x, y)| x > y) {
            return false;
        }
        self.blocks.iter().enumerate().all(|(place, &(start, end))| {
            let slot = end - 1 - (place - start);
            place == start || b[slot] - a[slot] >= b[slot + 1] - a[slot + 1]
        })
    }
}

/// The key of a product; exponents beyond 16 bits exhaust any budget.
pub(super) fn key_product(a: &Key, b: &Key) -> Result<Key> {
    let mut product = a.clone();
    for (x, y) in product.iter_mut().zip(b) {
        *x = x.checked_add(*y).ok_or(Exhausted)?;
    }
    Ok(product)
}

/// The key of a quotient of monomials, the second of which divides the first.
pub(super) fn key_quotient(a: &Key, b: &Key) -> Key {
    let mut quotient = a.clone();
    for (x, y) in quotient.iter_mut().zip(b) {
        *x -= y;
    }
    quotient
}

/// The generators that occur in a polynomial only as a term of their own, linearly.
fn defined_by(p: &Polynomial) -> Vec<Term> {
    let alone = p.terms().iter().filter_map(|(monomial, _)| match monomial.as_slice() {
        [(term, 1)] => Some(*term),
        _ => None,
    });
    alone
        .filter(|term| {
            let holding = p
                .terms()
                .iter()
                .filter(|(monomial, _)| monomial.iter().any(|(inner, _)| inner == term));
            holding.count() == 1
        })
        .collect()
}
