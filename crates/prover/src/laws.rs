//! Laws of unknown functions that can be taken at times.

use kernel::{LawSource, Symbol, Term};
use std::collections::BTreeSet;

/// The laws found so far, and which of them were differentiated and integrated.
#[derive(Clone, Default)]
pub struct Laws {
    pub(super) all: Vec<Usable>,
    pub(super) differentiated: BTreeSet<usize>,
    pub(super) integrated: BTreeSet<usize>,
    pub(super) taken: BTreeSet<(i32, usize)>,
    /// The impacts that the goals and premises speak of.
    pub(super) spoken: BTreeSet<i32>,
    /// Whether constants of motion were looked for.
    pub constants: bool,
}

impl Laws {
    pub fn all(&self) -> &[Usable] {
        &self.all
    }

    pub fn push(&mut self, law: Usable) {
        self.all.push(law);
    }
}

/// A law that can be taken at a time.
#[derive(Clone)]
pub struct Usable {
    pub(super) source: LawSource,
    pub(super) time: Symbol,
    pub(super) term: Term,
    pub(super) flight: Option<i32>,
    /// How many times it was differentiated, and integrated, to be what it is.
    pub(super) derivatives: u8,
    pub(super) integrals: u8,
}

impl Usable {
    /// A law that a step derived.
    pub fn derived(source: LawSource, time: Symbol, term: Term, flight: Option<i32>) -> Self {
        Self {
            source,
            time,
            term,
            flight,
            derivatives: 0,
            integrals: 0,
        }
    }

    pub fn term(&self) -> Term {
        self.term
    }

    pub fn time(&self) -> Symbol {
        self.time
    }

    /// Whether it is a law of a flight.
    pub fn flies(&self) -> bool {
        self.flight.is_some()
    }

    /// Whether it is a premise, rather than derived.
    pub fn is_given(&self) -> bool {
        matches!(self.source, LawSource::Given { .. })
    }
}
