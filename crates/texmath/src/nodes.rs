//! What stands in a tree.

use super::command::is_letter;
use super::{Equation, Name, Operation, Tree};
use std::collections::BTreeSet;

/// Returns true if any node of the tree passes the test.
pub fn any(tree: &Tree, test: &mut dyn FnMut(&Tree) -> bool) -> bool {
    test(tree) || tree.find_below(&mut |part| any(part, test).then_some(())).is_some()
}

/// Returns true if any node of either side passes the test.
pub fn any_side(equation: &Equation, test: &mut dyn FnMut(&Tree) -> bool) -> bool {
    any(&equation.left, test) || any(&equation.right, test)
}

/// Returns the parts directly below a node, in the order of [`Tree::map`].
pub fn parts(tree: &Tree) -> Vec<Tree> {
    let mut found = Vec::new();
    let _ = tree.map(&mut |part| {
        found.push(part.clone());
        part.clone()
    });
    found
}

/// Returns the tree with a symbol replaced, bound or not.
pub fn with_symbol(tree: &Tree, name: &Name, new: &Tree) -> Tree {
    match tree {
        Tree::Symbol(own, _) if own == name => new.clone(),
        other => other.map(&mut |part| with_symbol(part, name, new)),
    }
}

/// Returns the tree with a part of it replaced wherever it stands.
pub fn with_part(tree: &Tree, part: &Tree, new: &Tree) -> Tree {
    match tree == part {
        true => new.clone(),
        false => tree.map(&mut |below| with_part(below, part, new)),
    }
}

/// Adds the names in a tree, those of functions too; names of elementary functions are none.
pub fn names_in(tree: &Tree, names: &mut BTreeSet<Name>) {
    any(tree, &mut |node| {
        match node {
            Tree::Symbol(name, _) => {
                names.insert(name.clone());
            }
            Tree::Partial { of, by, .. } => names.extend([of.clone(), by.clone()]),
            Tree::Call(name, ..)
                if !name.base.starts_with('\\') || !name.accents.is_empty() || is_letter(&name.base) =>
            {
                names.insert(name.clone());
            }
            _ => {}
        }
        false
    });
}

/// Returns the names in equations, as [`names_in`] tells them.
pub fn names_of<'e>(equations: impl IntoIterator<Item = &'e Equation>) -> BTreeSet<Name> {
    let mut names = BTreeSet::new();
    for equation in equations {
        names_in(&equation.left, &mut names);
        names_in(&equation.right, &mut names);
    }
    names
}

/// Returns the number of nodes of a tree.
pub fn nodes_of(tree: &Tree) -> usize {
    let mut count = 0;
    any(tree, &mut |_| {
        count += 1;
        false
    });
    count
}

/// Returns true if a name stands anywhere in a tree.
pub fn speaks_of(tree: &Tree, name: &Name) -> bool {
    any(tree, &mut |node| match node {
        Tree::Symbol(other, _) => other == name,
        Tree::Partial { of, by, .. } => of == name || by == name,
        _ => false,
    })
}

/// Returns true if an equation holds an operation that passes the test.
pub fn holds(equation: &Equation, test: &dyn Fn(&Operation) -> bool) -> bool {
    any_side(
        equation,
        &mut |node| matches!(node, Tree::Operation(operation, _) if test(operation)),
    )
}

/// Returns true if an equation holds an integral without limits.
pub fn holds_indefinite(equation: &Equation) -> bool {
    holds(equation, &|operation| {
        matches!(operation, Operation::Integral { limits: None, .. })
    })
}
