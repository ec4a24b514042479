//! Statements while they are made, by what gives notation its meaning.

use super::expand::Derivatives;
use super::statement::{Given, Implicit, Piecewise, Property, Sequence, Statement};
use super::term::{Symbol, Term};
use std::collections::BTreeMap;
use std::ops::{Deref, DerefMut};
use std::sync::atomic::{AtomicU64, Ordering};

/// A statement in the making. It can be added to until it is finished; then nothing given and no goal can be changed.
#[derive(Clone, Debug, Default)]
pub struct Draft(Statement);

/// The parts of a draft, to be set.
pub struct Parts<'a> {
    /// True if complex numbers take part, so that all functions are principal branches.
    pub complex: &'a mut bool,
    pub givens: &'a mut Vec<Given>,
    /// Symbols that are abbreviations.
    pub definitions: &'a mut BTreeMap<Symbol, Term>,
    /// The declared derivatives of unknown functions.
    pub derivatives: &'a mut Derivatives,
    /// Symbols that are declared complex, those declared generic.
    pub complex_symbols: &'a mut Vec<Symbol>,
    pub generic: &'a mut Vec<Symbol>,
    /// The quantities whose derivatives by others the statement speaks of.
    pub implicit: &'a mut Vec<Implicit>,
    /// Terms that the claim writes besides, and that so must have a value.
    pub beside: &'a mut Vec<Term>,
    /// The offset of the interval that the running time of the claim is in.
    pub interval: &'a mut Option<i32>,
}

impl Draft {
    /// A draft about these sequences and functions on intervals. A derivative of one quantity by another has the texts
    /// `derivative_text` before, between and after theirs.
    pub fn new(
        complex: bool,
        sequences: Vec<Sequence>,
        piecewise: Vec<Piecewise>,
        derivative_text: [String; 3],
    ) -> Self {
        Self(Statement {
            complex,
            sequences,
            piecewise,
            derivative_text,
            ..Statement::default()
        })
    }

    /// Lends its parts. It is another statement from here on.
    pub fn parts(&mut self) -> Parts<'_> {
        let own = &mut self.0;
        own.identity = 0;
        Parts {
            complex: &mut own.complex,
            givens: &mut own.givens,
            definitions: &mut own.definitions,
            derivatives: &mut own.derivatives,
            complex_symbols: &mut own.complex_symbols,
            generic: &mut own.generic,
            implicit: &mut own.implicit,
            beside: &mut own.beside,
            interval: &mut own.interval,
        }
    }

    /// The statement with what is to be shown.
    pub fn finish(mut self, goal: Vec<(Property, Term)>) -> Statement {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        self.0.goal = goal;
        self.0.identity = NEXT.fetch_add(1, Ordering::Relaxed);
        self.0
    }
}

impl Deref for Draft {
    type Target = Statement;

    fn deref(&self) -> &Statement {
        &self.0
    }
}

impl DerefMut for Draft {
    fn deref_mut(&mut self) -> &mut Statement {
        &mut self.0
    }
}
