//! The extent of arguments without brackets and of divisors: the readings of a term.

use super::command::ABSOLUTE;
use super::elementary::Elementary;
use super::part::{is_differential, product};
use super::{At, DoubtKind, Name, OtherReading, Tree};

/// A factor that may belong to the argument or divisor before it.
#[derive(Clone, Copy)]
pub(super) struct Belongs {
    /// True if it is usually taken as a factor.
    pub is_usual: bool,
}

/// The factors of a term some of which may belong to the argument or divisor before them.
#[derive(Default)]
pub(super) struct Extents {
    /// The number of the factor that may go on, and whether it usually does not.
    open: Vec<(usize, Belongs)>,
    /// The number of a quotient whose divisor may go on.
    divisor: Option<usize>,
}

impl Extents {
    /// Notes that what follows the factor of a number may belong to its argument.
    pub fn argument(&mut self, number: usize, belongs: Belongs) {
        self.open.push((number, belongs));
    }

    /// Notes that what follows the quotient of a number may belong to its divisor: no convention says of `1/2 a` which is meant.
    pub fn divisor(&mut self, number: usize) {
        self.divisor = Some(number);
        self.open.push((number, Belongs { is_usual: false }));
    }

    /// The doubt of a term of these factors, which ends here; none where nothing in it may go on.
    pub fn doubt(&self, factors: &[Tree]) -> Option<DoubtKind> {
        // the differential of an integral is none of its factors
        let factors = match factors.split_last() {
            Some((last, rest)) if is_differential(last) => rest,
            _ => factors,
        };
        self.among(&product(factors.to_vec()), self.others(factors))
    }

    /// The doubt of a term of these factors that is divided; `is_open` says that the divisor may belong to the argument that ends it.
    pub fn doubt_of_quotient(&self, factors: &[Tree], below: &Tree, at: At, is_open: bool) -> Option<DoubtKind> {
        let divided = |tree: &Tree| Tree::Quotient(Box::new(tree.clone()), Box::new(below.clone()), at);
        let (above, others) = (*product(factors.to_vec()), self.others(factors));
        let goes_on = others.iter().chain(is_open.then_some(&above));
        let within = goes_on.filter(|tree| last_call(tree).is_some());
        let within: Vec<Tree> = within.map(|tree| with_last_argument(tree, &divided)).collect();
        self.among(&divided(&above), others.iter().map(divided).chain(within).collect())
    }

    fn among(&self, taken: &Tree, others: Vec<Tree>) -> Option<DoubtKind> {
        let mut readings: Vec<OtherReading> = Vec::new();
        for other in others {
            if readings.iter().all(|known| known.other != other) {
                let taken = taken.clone();
                readings.push(OtherReading { taken, other });
            }
        }
        let is_usual = !self.open.is_empty() && self.open.iter().all(|(_, belongs)| belongs.is_usual);
        (!readings.is_empty()).then_some(DoubtKind::Extent { readings, is_usual })
    }

    /// The other readings of a product of these factors.
    fn others(&self, factors: &[Tree]) -> Vec<Tree> {
        // from the last factor that may go on to the first, so that the numbers of those before stay
        let mut readings: Vec<Vec<Tree>> = vec![factors.to_vec()];
        for &(number, _) in self.open.iter().rev() {
            for read in readings.clone() {
                // the next factor alone belongs to it, or all of them
                for end in [number + 2, read.len()] {
                    let grown = self.grown(&read, number, end);
                    let new = grown.filter(|grown| !readings.contains(grown));
                    readings.extend(new);
                }
            }
            if readings.len() > MOST_EXTENTS {
                break;
            }
        }
        readings.into_iter().skip(1).map(|read| *product(read)).collect()
    }

    /// The factors once the one of a number takes those up to another one in.
    fn grown(&self, factors: &[Tree], number: usize, end: usize) -> Option<Vec<Tree>> {
        let (before, own) = (factors.get(..number)?, factors.get(number)?);
        let more = factors.get(number + 1..end).filter(|more| !more.is_empty())?;
        let behind = factors.get(end..)?;
        let join = |inner: &Tree| {
            let inner = match inner {
                Tree::Product(factors) => factors.clone(),
                inner => vec![inner.clone()],
            };
            *product(inner.into_iter().chain(more.iter().cloned()).collect())
        };
        let grown = match own {
            Tree::Quotient(above, below, at) if self.divisor == Some(number) => {
                Tree::Quotient(above.clone(), Box::new(join(below)), *at)
            }
            own => with_last_argument(own, &join),
        };
        Some(
            before
                .iter()
                .cloned()
                .chain([grown])
                .chain(behind.iter().cloned())
                .collect(),
        )
    }
}

/// The most readings of a term to which another place that is open adds more: with more of them than are decided nothing is
/// refuted, and only the usual one proved.
const MOST_EXTENTS: usize = 16;

/// The elementary function in whose value a tree ends, and its argument; the bars of an absolute value end it.
pub(super) fn last_call(tree: &Tree) -> Option<(&Name, &Tree)> {
    match tree {
        Tree::Call(name, argument, _) => {
            let is_open = name.base != ABSOLUTE && Elementary::by_command(&name.base).is_some();
            is_open.then_some((name, &**argument))
        }
        Tree::Power(base, ..) | Tree::RealPower(base, ..) => last_call(base),
        // a logarithm with a base
        Tree::Quotient(above, ..) => last_call(above),
        Tree::Product(factors) => factors.last().and_then(last_call),
        _ => None,
    }
}

/// `tree` with the argument that it ends in replaced.
fn with_last_argument(tree: &Tree, new: &dyn Fn(&Tree) -> Tree) -> Tree {
    let again = |tree: &Tree| Box::new(with_last_argument(tree, new));
    match tree {
        Tree::Call(name, argument, at) => Tree::Call(name.clone(), Box::new(new(argument)), *at),
        Tree::Power(base, exponent, at) => Tree::Power(again(base), *exponent, *at),
        Tree::RealPower(base, exponent, at) => Tree::RealPower(again(base), exponent.clone(), *at),
        Tree::Quotient(above, below, at) => Tree::Quotient(again(above), below.clone(), *at),
        Tree::Product(factors) => match factors.split_last() {
            Some((last, rest)) => {
                let last = with_last_argument(last, new);
                Tree::Product(rest.iter().cloned().chain([last]).collect())
            }
            None => tree.clone(),
        },
        _ => tree.clone(),
    }
}
