//! Letters that one sheet prints in two ways, which are read as one, products of vectors that are read as numbers, and
//! constants of solutions.

use super::entry::{Entry, RawEntry, Role};
use std::collections::{BTreeMap, BTreeSet, HashSet};
use texmath::{
    At, Condition, Doubt, DoubtKind, Equation, Name, Operation, Symbols, Tree, any, any_side, index_of, letters,
};

/// Makes the entries `unread` that hold a letter which the formulas print in two ways: `\mathbf{a}` and `a`, `\phi` and
/// `\varphi` are read as one letter, and are mostly two symbols where both are printed.
pub(super) fn refuse_two_spellings(raw: &[RawEntry], entries: &mut [Entry], symbols: &Symbols) {
    let mut printed: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for tex in raw.iter().flat_map(RawEntry::formulas) {
        for (letter, shape) in letters(tex, &symbols.names) {
            printed.entry(letter).or_default().insert(shape);
        }
    }
    printed.retain(|_, shapes| shapes.len() > 1);
    if printed.is_empty() {
        return;
    }
    for (raw, entry) in raw.iter().zip(entries) {
        let mut own = raw.formulas().flat_map(|tex| letters(tex, &symbols.names));
        // where letters in bold are names of their own, only those that are not told apart are read as others
        let is_told = |letter: &str, shape: &str| symbols.names.opaque.is_some() && letter == shape;
        let found = own.find_map(|(letter, shape)| printed.get(&letter).filter(|_| !is_told(&letter, &shape)));
        if let Some(shapes) = found {
            let shapes: Vec<String> = shapes.iter().map(|shape| format!("`{shape}`")).collect();
            let problem = format!(
                "{} are read as one letter, and both are printed: call one of them by another letter",
                shapes.join(" and ")
            );
            entry
                .unread
                .get_or_insert_with(|| entry.tex.fault(0, problem).of(&entry.label));
        }
    }
}

/// Makes the entries `unread` that print a product `\times`, or `\cdot` of several letters, of letters in bold or under an arrow that
/// are declared as numbers.
pub(super) fn refuse_products_of_vectors(raw: &[RawEntry], entries: &mut [Entry], symbols: &Symbols) {
    let is_number = |letter: &str, accents: &[&str]| {
        let is_it = |name: &Name| name.base == letter && name.subscript.is_empty() && name.accents == accents;
        symbols.parameters().any(is_it)
    };
    // where letters are known to be vectors, it is decided of them
    for (raw, entry) in raw.iter().zip(entries).filter(|(_, entry)| entry.operators.is_empty()) {
        for tex in raw.formulas() {
            let has_arrows = tex.contains(r"\vec");
            let bold = |(letter, printed): (String, String)| {
                let is_vector = (printed.starts_with(r"\mathbf") && is_number(&letter, &[]))
                    || (has_arrows && is_number(&letter, &[r"\vec"]));
                is_vector.then_some(letter)
            };
            let vectors: BTreeSet<String> = letters(tex, &symbols.names).into_iter().filter_map(bold).collect();
            let is_cross = !vectors.is_empty() && (tex.contains(r"\times") || tex.contains('×'));
            let is_dot = vectors.len() > 1 && (tex.contains(r"\cdot") || tex.contains(['·', '⋅']));
            if is_cross || is_dot {
                let problem = "a product of vectors by the look of its letters, which are declared as numbers: define them as columns";
                entry
                    .unread
                    .get_or_insert_with(|| entry.tex.fault(0, problem).of(&entry.label));
            }
        }
    }
}

/// Whether a matrix stands in a tree, or a letter of these.
fn holds_matrix(tree: &Tree, matrices: &HashSet<Name>) -> bool {
    any(tree, &mut |node| match node {
        Tree::Operation(operation, _) => matches!(
            **operation,
            Operation::Matrix(_) | Operation::Transpose(_) | Operation::Cross(..)
        ),
        Tree::Symbol(name, _) | Tree::Call(name, ..) => matrices.contains(name),
        _ => false,
    })
}

/// Makes the claims `unread` that have matrices among their alternatives: that their product is 0 does not say that one of
/// them is.
pub(super) fn refuse_alternative_matrices(entries: &mut [Entry]) {
    let beside = |entry: &Entry| -> Vec<Equation> {
        let own = entry.local.iter().chain(&entry.with).map(|(equation, _)| equation);
        entry.equations.iter().chain(own).cloned().collect()
    };
    let all: Vec<Equation> = entries.iter().flat_map(beside).collect();
    let mut matrices: HashSet<Name> = HashSet::new();
    loop {
        let known = matrices.len();
        for Equation { left, right, .. } in &all {
            for (side, other) in [(left, right), (right, left)] {
                if let Tree::Symbol(name, _) | Tree::Call(name, ..) = side
                    && holds_matrix(other, &matrices)
                {
                    matrices.insert(name.clone());
                }
            }
        }
        if matrices.len() == known {
            break;
        }
    }
    for entry in entries {
        let mut sides = entry.alternatives.iter().flat_map(|one| [&one.left, &one.right]);
        if sides.any(|side| holds_matrix(side, &matrices)) {
            let problem = "alternatives are read of numbers, not of matrices: say it by their entries";
            let fault = entry.tex.fault(0, problem).of(&entry.label);
            entry.unread.get_or_insert(fault);
        }
    }
}

/// Whether this is a derivative of a function.
fn is_derivative(node: &Tree, symbols: &Symbols) -> bool {
    match node {
        Tree::Symbol(name, _) | Tree::Call(name, ..) => {
            symbols.names.is_function(name)
                && (name.primes > 0 || name.accents.iter().any(|accent| accent.starts_with(r"\d")))
        }
        Tree::Operation(operation, _) => matches!(**operation, Operation::Derivative { order: 1.., .. }),
        _ => false,
    }
}

/// Notes the parameters of which nothing that a claim rests on speaks, where that is a differential equation or a recurrence:
/// authors mean constants of its solution.
pub(super) fn note_constants_of_solutions(entries: &mut [Entry], symbols: &Symbols) {
    let found = |entry: &Entry| -> Vec<Name> {
        let below = entry.follows_from.iter().filter_map(|&number| entries.get(number));
        let mut said = below.flat_map(|premise| &premise.equations);
        let runs = |letter: &str| symbols.indices().any(|name| name.base == letter);
        let is_step = |node: &Tree| match node {
            Tree::Symbol(name, _) => index_of(&name.subscript, &symbols.index).is_some_and(|shift| shift != 0),
            _ => false,
        };
        let is_moved = said.any(|equation| {
            any_side(equation, &mut |node| {
                is_derivative(node, symbols) || (runs(&symbols.index) && is_step(node))
            })
        });
        let stands = |name: &&Name| {
            let is_it = |node: &Tree| matches!(node, Tree::Symbol(own, _) if own == *name);
            entry
                .equations
                .iter()
                .any(|equation| any_side(equation, &mut |node| is_it(node)))
        };
        let parameters = symbols.parameters().filter(|_| is_moved);
        parameters.filter(stands).cloned().collect()
    };
    let found: Vec<Vec<Name>> = entries.iter().map(found).collect();
    for (entry, found) in entries.iter_mut().zip(found) {
        entry.of_some.extend(found);
    }
}

/// Makes what speaks of a parameter `unread` that carries an integer as its index: it is meant for a sequence.
pub(super) fn refuse_indexed_parameters(entries: &mut [Entry], symbols: &Symbols) {
    for entry in entries {
        let own = entry.local.iter().chain(&entry.with).map(|(equation, _)| equation);
        let mut met: Option<(Name, Name)> = None;
        for equation in entry.equations.iter().chain(own) {
            any_side(equation, &mut |node| {
                if let Tree::Symbol(name, _) = node
                    && let Some(letter) = symbols.index_in(name)
                {
                    met.get_or_insert_with(|| (name.clone(), letter.clone()));
                }
                false
            });
        }
        let Some((name, letter)) = met else { continue };
        let bare = name.bare();
        let problem = format!(
            "`{name}` is declared as a parameter and carries the integer `{letter}` as its index: for a sequence declare \
             `{bare}` in `states` and `{letter}` in `indices` (in a document: `symbols states {bare}; indices {letter}`)"
        );
        let fault = entry.tex.fault(0, problem).of(&entry.label);
        entry.unread.get_or_insert(fault);
    }
}

/// Makes the claims `unread` that give a function of a differential equation by parameters of which no premise of the sheet
/// speaks: with such constants authors mean that some solve it.
pub(super) fn refuse_constants_of_solutions(entries: &mut [Entry], symbols: &Symbols) {
    let sides = |equation: &Equation| [equation.left.clone(), equation.right.clone()];
    let premises = entries.iter().filter(|entry| entry.role != Role::Claim);
    let known: Vec<Tree> = premises
        .flat_map(|premise| premise.equations.iter().flat_map(sides))
        .collect();
    let found: Vec<(usize, usize, Name)> = entries
        .iter()
        .enumerate()
        .filter(|(_, entry)| entry.role == Role::Claim)
        .filter_map(|(position, entry)| {
            let below = entry.follows_from.iter().filter_map(|&number| entries.get(number));
            let mut equations = below.flat_map(|premise| premise.equations.iter().flat_map(sides));
            if !equations.any(|tree| any(&tree, &mut |node| is_derivative(node, symbols))) {
                return None;
            }
            let mut given: Vec<Tree> = Vec::new();
            let beside = entry.local.iter().chain(&entry.with).map(|(equation, _)| equation);
            given.extend(beside.flat_map(sides));
            let assumed = entry.assume.iter().filter_map(|(condition, _)| match condition {
                Condition::Relation(relation) => Some(relation),
                Condition::Integer(_) => None,
            });
            given.extend(assumed.flat_map(sides));
            let names =
                |tree: &Tree, name: &Name| any(tree, &mut |node| matches!(node, Tree::Symbol(own, _) if own == name));
            entry.equations.iter().find_map(|equation| {
                let runs =
                    |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if Some(name) == symbols.names.running.as_ref());
                let is_given = match &equation.left {
                    Tree::Symbol(name, _) => symbols.names.is_function(name),
                    Tree::Call(name, argument, _) => symbols.names.is_function(name) && runs(argument),
                    _ => false,
                };
                let is_free = |name: &&Name| {
                    names(&equation.right, name) && !known.iter().chain(&given).any(|tree| names(tree, name))
                };
                let free = symbols.parameters().find(is_free).filter(|_| is_given)?;
                Some((position, equation.at.0, free.clone()))
            })
        })
        .collect();
    for (position, at, name) in found {
        if let Some(entry) = entries.get_mut(position) {
            // what a document means is open, not wrong
            if !entry.guessed.is_empty() {
                entry.doubts.push(Doubt {
                    kind: DoubtKind::OfSome(name),
                    at: At(at),
                });
                continue;
            }
            let problem =
                format!("`{name}` stands in this claim alone: whether for some or for every value is not said");
            entry
                .unread
                .get_or_insert_with(|| entry.tex.fault(at, problem).of(&entry.label));
        }
    }
}
