//! Sequences: what statements say of members with a running index, and of nothing beside them that moves.

use super::super::premise::Statements;
use super::derivative::mentions;
use super::evaluate::only_factorials;
use super::{Goal, factorial, trees};
use std::collections::BTreeSet;
use texmath::{Meaning, Name, Symbols, Tree, any, index_of, place_of};

/// Returns true if a claim speaks of members of a sequence.
pub(super) fn is_spoken_of(statements: &Statements, symbols: &Symbols) -> bool {
    let is_member = |node: &Tree| match node {
        Tree::Symbol(name, _) => symbols.is_state(&name.bare()),
        _ => false,
    };
    let mut sides = statements.claims.iter().flat_map(|claim| [&claim.left, &claim.right]);
    symbols.indices().next().is_some() && sides.any(|side| any(side, &mut |node| is_member(node)))
}

/// The sequences that statements speak of, and nothing beside them that moves.
pub(super) struct Setting {
    /// The symbol table in which the index is an integer and members are parameters.
    pub(super) plain: Symbols,
    /// The letter of the index.
    pub(super) letter: Name,
    pub(super) states: BTreeSet<Name>,
}

impl Setting {
    /// The index and the sequences of statements that are about members alone.
    ///
    /// # Errors
    /// The statements are about something else besides, which the message names.
    pub(super) fn of(statements: &Statements, symbols: &Symbols) -> Result<Self, String> {
        let mut indices = symbols.indices();
        let (Some(letter), None) = (indices.next(), indices.next()) else {
            return Err("more than one index runs".to_owned());
        };
        let is_tied = !(symbols.relations.is_empty() && symbols.laws.is_empty());
        if is_tied || letter.to_string() != symbols.index {
            return Err("a recurrence beside relations or laws has no induction here".to_owned());
        }
        let all = trees(statements);
        if all.iter().any(|tree| symbols.may_be_complex(tree)) {
            return Err("sequences of complex numbers have no induction here".to_owned());
        }
        let moves = |node: &Tree| match node {
            Tree::Symbol(name, _) | Tree::Call(name, ..) => {
                let is_time = symbols.is_time(&name.bare()) || symbols.running() == Some(name);
                is_time || symbols.is_function(name) || symbols.maps().any(|(map, _)| map == name)
            }
            _ => false,
        };
        if all.iter().any(|tree| any(tree, &mut |node| moves(node))) {
            return Err("a recurrence beside times, functions or maps has no induction here".to_owned());
        }
        if all.iter().any(|tree| any(tree, &mut |node| is_strange(node, letter))) {
            return Err(format!("{letter} is bound, or signs are left open"));
        }
        let states = the_states(&all, symbols, letter)?;
        let listed = [
            Meaning::Positive,
            Meaning::Nonnegative,
            Meaning::Nonzero,
            Meaning::AtMostOne,
            Meaning::Integer,
            Meaning::Generic,
        ];
        let listed = listed.iter().flat_map(|kind| symbols.all(kind));
        let mut runs_in_list = listed.filter(|name| place_of(&name.subscript, &letter.base).is_some());
        if let Some(name) = runs_in_list.find(|name| states.contains(&name.bare())) {
            return Err(format!("[symbols] says something of every member of {}", name.bare()));
        }
        let mut plain = symbols.clone();
        plain.retain(|_, own| !matches!(own, Meaning::State | Meaning::Index | Meaning::Continuous));
        plain.names.functions.clear();
        plain.index = Symbols::default().index;
        plain.let_be_parameter(letter, false);
        plain.declare(letter.clone(), Meaning::Integer);
        Ok(Self {
            plain,
            letter: letter.clone(),
            states,
        })
    }

    /// Returns true if a formula speaks of the index or of members that run with it.
    pub(super) fn runs(&self, tree: &Tree) -> bool {
        mentions(tree, &self.letter)
            || any(
                tree,
                &mut |node| matches!(node, Tree::Symbol(name, _) if self.is_running(name)),
            )
    }

    fn is_running(&self, name: &Name) -> bool {
        self.states.contains(&name.bare()) && place_of(&name.subscript, &self.letter.base).is_some()
    }

    /// A claim about parameters: each member is one.
    pub(super) fn goal(&self, statements: &Statements, part: String) -> Result<Goal, String> {
        self.goal_in(statements, &self.plain, part)
    }

    /// The same in a symbol table that knows more letters.
    pub(super) fn goal_in(&self, statements: &Statements, symbols: &Symbols, part: String) -> Result<Goal, String> {
        let (statements, mut symbols) = factorial::as_quantities(&only_factorials(statements, symbols)?, symbols)?;
        let mut names: BTreeSet<Name> = BTreeSet::new();
        for tree in trees(&statements) {
            any(tree, &mut |node| {
                if let Tree::Symbol(name, _) = node
                    && self.states.contains(&name.bare())
                    && !symbols.is_parameter(name)
                {
                    names.insert(name.clone());
                }
                false
            });
        }
        let is_member = |name: &Name| self.is_running(name) || name.subscript.parse::<i64>().is_ok();
        if let Some(name) = names.iter().find(|name| !is_member(name)) {
            return Err(format!("`{name}` is no member that is followed"));
        }
        for name in &names {
            symbols.let_be_parameter(name, false);
        }
        Ok(Goal::of(&statements, &symbols, part))
    }

    /// Returns true if a claim names members at a multiple of the running index, as a_{2n}.
    pub(super) fn has_multiples(&self, statements: &Statements) -> bool {
        let is_multiple = |node: &Tree| match node {
            Tree::Symbol(name, _) if self.states.contains(&name.bare()) => {
                place_of(&name.subscript, &self.letter.base).is_some_and(|(multiple, _)| multiple != 1)
            }
            _ => false,
        };
        let mut sides = statements.claims.iter().flat_map(|claim| [&claim.left, &claim.right]);
        sides.any(|side| any(side, &mut |node| is_multiple(node)))
    }
}

/// Returns true if a formula speaks of members of a sequence that run with the index.
pub(super) fn runs_by_member(tree: &Tree, state: &Name, letter: &Name) -> bool {
    any(tree, &mut |node| match node {
        Tree::Symbol(name, _) => name.bare() == *state && index_of(&name.subscript, &letter.base).is_some(),
        _ => false,
    })
}

/// Returns true if a node binds the index, or leaves a sign open.
fn is_strange(node: &Tree, letter: &Name) -> bool {
    match node {
        Tree::Operation(operation, _) => operation.letter() == Some(letter),
        Tree::PlusMinus(_) | Tree::MinusPlus(_) | Tree::Partial { .. } | Tree::Invariant { .. } => true,
        _ => false,
    }
}

/// The sequences that are spoken of.
fn the_states(all: &[&Tree], symbols: &Symbols, letter: &Name) -> Result<BTreeSet<Name>, String> {
    let mut met: BTreeSet<Name> = BTreeSet::new();
    let mut strange = None;
    let is_base = |name: &Name| symbols.states().any(|state| state.base == name.base);
    for tree in all {
        any(tree, &mut |node| {
            match node {
                Tree::Symbol(name, _) if is_base(name) && !symbols.is_single(name) => {
                    let is_plain = name.mark.is_empty() && name.primes == 0 && !name.subscript.is_empty();
                    match is_plain && symbols.is_state(&name.bare()) {
                        true => met.insert(name.bare()),
                        false => strange.replace(name.clone()).is_none(),
                    };
                }
                Tree::Call(name, ..) if is_base(name) => strange = Some(name.clone()),
                _ => {}
            }
            false
        });
    }
    if let Some(name) = strange {
        return Err(format!("`{name}` is no member of a sequence in {letter}"));
    }
    match met.is_empty() {
        true => Err("no sequence is spoken of".to_owned()),
        false => Ok(met),
    }
}
