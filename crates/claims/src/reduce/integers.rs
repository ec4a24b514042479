//! Which numbers and letters are integers.

use super::super::premise::Statements;
use super::derivative::mentions;
use super::trees;
use texmath::{Condition, Name, Symbols, Tree, number_of};

/// The integer that a tree of numbers is.
pub(super) fn whole(tree: &Tree) -> Option<i64> {
    number_of(tree).and_then(|value| value.to_integer())
}

/// The letters that are integers and stand in the statements.
pub(super) fn integers(statements: &Statements, symbols: &Symbols) -> Vec<Name> {
    let said = statements.assume.iter().filter_map(|condition| match condition {
        Condition::Integer(Tree::Symbol(name, _)) => Some(name.clone()),
        _ => None,
    });
    let mut found: Vec<Name> = Vec::new();
    for name in symbols.integers().cloned().chain(said) {
        let is_met = trees(statements).into_iter().any(|tree| mentions(tree, &name));
        if is_met && !found.contains(&name) && !symbols.is_indexed(&name) && !symbols.is_index(&name) {
            found.push(name);
        }
    }
    found
}

/// Those of them that stand where no operation binds them.
pub(super) fn free_integers(statements: &Statements, symbols: &Symbols) -> Vec<Name> {
    let mut letters = integers(statements, symbols);
    letters.retain(|letter| trees(statements).into_iter().any(|tree| tree.has_free(letter)));
    letters
}
