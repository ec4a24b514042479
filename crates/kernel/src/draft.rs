//! Statements while they are made, by what gives notation its meaning.

use super::expand::Derivatives;
use super::statement::{Given, Property, Statement, Step};
use super::term::{Symbol, Term};
use std::collections::BTreeMap;
use std::ops::{Deref, DerefMut};
use std::sync::atomic::{AtomicU64, Ordering};
use texmath::Name;

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
    pub steps: &'a mut Vec<Step>,
    /// The explicit maps whose derivatives are those of their right sides.
    pub outright: &'a mut Vec<Step>,
    /// Terms that the claim writes besides, and that so must have a value.
    pub beside: &'a mut Vec<Term>,
    /// The flight that the running time of the claim is in.
    pub flight: &'a mut Option<i32>,
}

impl Draft {
    /// A draft in which these states may be named at impacts, which this letter numbers; an impact does not change those that are
    /// `continuous`.
    pub fn new(complex: bool, states: Vec<Name>, continuous: Vec<Name>, letter: String) -> Self {
        Self(Statement {
            complex,
            states,
            continuous,
            letter,
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
            steps: &mut own.steps,
            outright: &mut own.outright,
            beside: &mut own.beside,
            flight: &mut own.flight,
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
