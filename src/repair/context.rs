//! What else stands in the sheet: the names and terms that a repair may put in.

use super::path::{parts, walk};
use crate::claim::{Entry, Sheet};
use crate::tex::{At, Equation, Map, Name, Operation, Tree, any, index_of, subscript_of, with_symbol};
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// Entries on either side of the claim whose names are looked at beside those of its premises.
const NEIGHBOURS: usize = 12;
/// The most names of a kind that are put in for one another.
const MOST_NAMES: usize = 60;

/// The names and terms of a claim, its premises and its neighbours.
#[derive(Debug, Default)]
pub struct Context {
    symbols: Vec<Name>,
    called: Vec<Name>,
    derivatives: Vec<(Name, Name)>,
    pub maps: Vec<Name>,
    letters: Vec<String>,
    /// What stands there by itself: each node of each formula but those of the claim.
    pub said: HashSet<Tree>,
    /// What values may be missing in the claim: symbols, values of functions and derivatives in it and in its premises.
    pub atoms: Vec<Tree>,
    /// Longer parts of these.
    pub terms: Vec<Tree>,
    /// Longer parts of other formulas.
    pub near: Vec<Tree>,
    /// What vectors are multiplied.
    operands: Vec<Tree>,
}

/// Functions that are taken for each other.
const FUNCTIONS: [(&str, &str); 6] = [
    (r"\sin", r"\cos"),
    (r"\sinh", r"\cosh"),
    (r"\tan", r"\cot"),
    (r"\sin", r"\tan"),
    (r"\arcsin", r"\arccos"),
    (r"\sin", r"\sinh"),
];

/// Functions of which each is the derivative of the other, but for a sign.
const PARTNERS: [(&str, &str); 2] = [(r"\sin", r"\cos"), (r"\sinh", r"\cosh")];

impl Context {
    pub fn new(sheet: &Sheet, position: usize) -> Self {
        let mut context = Self::default();
        let letter = &sheet.symbols.index;
        context.letters.extend((!letter.is_empty()).then(|| letter.clone()));
        context.letters.extend(sheet.symbols.indices().map(Name::to_string));
        let Some(entry) = sheet.entries.get(position) else {
            return context;
        };
        let mut near = entry.follows_from.clone();
        let window = position.saturating_sub(NEIGHBOURS)..(position + NEIGHBOURS + 1).min(sheet.entries.len());
        for neighbour in window {
            if neighbour != position && !near.contains(&neighbour) {
                near.push(neighbour);
            }
        }
        let own = trees_of(entry);
        for tree in &own {
            context.take(tree, true, false);
        }
        for &other in &near {
            let bears = entry.follows_from.contains(&other);
            for tree in sheet.entries.get(other).map(trees_of).unwrap_or_default() {
                context.take(&tree, bears, true);
            }
        }
        context.take_values(sheet);
        context.take_derivatives(sheet);
        context.take_partners(sheet);
        for (map, _) in sheet.symbols.maps() {
            if !context.maps.contains(map) {
                context.maps.push(map.clone());
            }
        }
        context
    }

    /// Takes in the values of each function of time that is met, and of its derivatives, at each time that is met: by itself, as
    /// an argument, or as that of a state at an impact; and what abbreviates the difference of two of these.
    fn take_values(&mut self, sheet: &Sheet) {
        let symbols = &sheet.symbols;
        let is_timed = |name: &Name| symbols.is_function(name) || symbols.is_state(&name.bare());
        let (mut names, mut times): (Vec<Name>, Vec<Tree>) = (Vec::new(), Vec::new());
        let mut add_time = |time: Tree| {
            let is_new = !times.contains(&time);
            times.extend(is_new.then_some(time));
        };
        for atom in &self.atoms {
            match atom {
                Tree::Call(name, time, _) if is_timed(name) => {
                    let is_new = symbols.is_function(name) && !names.contains(name);
                    names.extend(is_new.then(|| name.clone()));
                    add_time((**time).clone());
                }
                Tree::Symbol(name, _) if symbols.is_time(&name.bare()) => add_time(atom.clone()),
                Tree::Symbol(name, at) if symbols.is_state(&name.bare()) => {
                    if let (Some(_), Some(family)) = (index_of(&name.subscript, &symbols.index), symbols.times().next())
                    {
                        let subscript = name.subscript.clone();
                        let time = Name {
                            subscript,
                            ..family.bare()
                        };
                        add_time(Tree::Symbol(time, *at));
                    }
                }
                _ => {}
            }
        }
        for (name, derivative) in symbols.functions() {
            let Some(Tree::Symbol(derivative, _)) = derivative else {
                continue;
            };
            for (one, other) in [(name, derivative), (derivative, name)] {
                if names.contains(one) && !names.contains(other) {
                    names.push(other.clone());
                }
            }
        }
        for (name, length) in symbols.abbreviations() {
            let is_met =
                |tree: &Tree| times.contains(tree) || matches!(tree, Tree::Negate(inner) if times.contains(inner));
            if parts(length).iter().all(is_met) {
                keep(&mut self.symbols, name);
                self.take_atom(Tree::Symbol(name.clone(), At::default()));
            }
        }
        // the values of states at the impacts that are met
        let subscripts: BTreeSet<String> = times
            .iter()
            .filter_map(|time| match time {
                Tree::Symbol(name, _) if index_of(&name.subscript, &symbols.index).is_some() => {
                    Some(name.subscript.clone())
                }
                _ => None,
            })
            .collect();
        let is_state = |atom: &&Tree| matches!(atom, Tree::Symbol(name, _) | Tree::Call(name, ..) if symbols.is_state(&name.bare()));
        let states: BTreeSet<Name> = self
            .atoms
            .iter()
            .filter(is_state)
            .filter_map(|atom| match atom {
                Tree::Symbol(name, _) | Tree::Call(name, ..) => Some(name.bare()),
                _ => None,
            })
            .collect();
        for (state, subscript) in states
            .iter()
            .flat_map(|state| subscripts.iter().map(move |subscript| (state, subscript)))
        {
            let subscript = subscript.clone();
            self.take_atom(Tree::Symbol(
                Name {
                    subscript,
                    ..state.clone()
                },
                At::default(),
            ));
        }
        for name in &names {
            keep(&mut self.called, name);
            for time in &times {
                self.take_atom(Tree::Call(name.clone(), Box::new(time.clone()), At::default()));
            }
        }
        // what an elementary function of the time is then, and what is longer and speaks of a function
        let Some(running) = symbols.running() else {
            return;
        };
        for atom in self.atoms.clone() {
            if matches!(atom, Tree::Call(ref name, ..) if !symbols.is_function(name)) && atom.has_free(running) {
                for time in &times {
                    self.take_atom(with_symbol(&atom, running, time));
                }
            }
        }
        for term in self.terms.clone() {
            let speaks = any(
                &term,
                &mut |node| matches!(node, Tree::Call(name, ..) if symbols.is_function(name)),
            );
            if speaks && term.has_free(running) {
                for time in &times {
                    let then = with_symbol(&term, running, time);
                    if !self.terms.contains(&then) {
                        self.terms.push(then);
                    }
                }
            }
        }
    }

    /// Takes in the derivatives that maps are made of, where the claim or a premise speaks of one.
    fn take_derivatives(&mut self, sheet: &Sheet) {
        if self.derivatives.is_empty() {
            return;
        }
        for (_, map) in sheet.symbols.maps() {
            let Map::Premises { of, by } = map else { continue };
            for (of, by) in of.iter().flat_map(|of| by.iter().map(move |by| (of, by))) {
                let (Tree::Symbol(of, _), Tree::Symbol(by, _)) = (of, by) else {
                    continue;
                };
                self.take_derivative(of, by);
                let (of, by, at) = (of.clone(), by.clone(), At::default());
                self.take_atom(Tree::Partial { of, by, at });
            }
        }
    }

    fn take_derivative(&mut self, of: &Name, by: &Name) {
        let pair = (of.clone(), by.clone());
        if !self.derivatives.contains(&pair) {
            self.derivatives.push(pair);
        }
    }

    /// Takes in what is met with what is there: the sine with the cosine and with that of the letter at another index, a
    /// derivative with those below it.
    fn take_partners(&mut self, sheet: &Sheet) {
        for atom in self.atoms.clone() {
            match atom {
                Tree::Call(name, argument, at) => {
                    let partners = PARTNERS.iter().filter_map(|(one, other)| match name.base.as_str() {
                        base if base == *one => Some(*other),
                        base if base == *other => Some(*one),
                        _ => None,
                    });
                    if let (Tree::Symbol(letter, _), true) = (&*argument, name.base.starts_with('\\')) {
                        let others = self
                            .symbols
                            .iter()
                            .filter(|other| other.base == letter.base && *other != letter);
                        for other in others.cloned().collect::<Vec<_>>() {
                            self.take_atom(Tree::Call(name.clone(), Box::new(Tree::Symbol(other, at)), at));
                        }
                    }
                    for partner in partners {
                        let base = partner.to_owned();
                        let name = Name { base, ..name.clone() };
                        self.take_atom(Tree::Call(name, argument.clone(), at));
                    }
                }
                Tree::Symbol(ref name, at) if self.operands.contains(&atom) && name.primes == 0 => {
                    let name = Name {
                        base: r"\abs".to_owned(),
                        ..Name::default()
                    };
                    self.take_atom(Tree::Call(name, Box::new(atom), at));
                }
                Tree::Symbol(name, at) if sheet.symbols.is_function(&name.dotted()) => {
                    self.take_atom(Tree::Symbol(name.dotted(), at));
                }
                Tree::Symbol(name, at) if name.accents.last().is_some_and(|accent| accent == r"\ddot") => {
                    let mut accents = name.accents.clone();
                    accents.pop();
                    let plain = Name { accents, ..name };
                    if sheet.symbols.functions().any(|(known, _)| *known == plain) {
                        self.take_atom(Tree::Symbol(plain.dotted(), at));
                        self.take_atom(Tree::Symbol(plain, at));
                    }
                }
                _ => {}
            }
        }
    }

    fn take_atom(&mut self, atom: Tree) {
        if !self.atoms.contains(&atom) {
            self.atoms.push(atom);
        }
    }

    /// Takes in what stands in a tree; `bears` says whether it bears on the claim.
    fn take(&mut self, tree: &Tree, bears: bool, is_other: bool) {
        walk(tree, None, &mut Vec::new(), &mut |node, _, _| {
            match node {
                Tree::Symbol(name, _) => keep(&mut self.symbols, name),
                Tree::Call(name, ..) => keep(&mut self.called, name),
                Tree::Partial { of, by, .. } => {
                    self.take_derivative(of, by);
                }
                Tree::Invariant { of, .. } => keep(&mut self.maps, of),
                Tree::Operation(operation, _) => {
                    if let Operation::Cross(one, other) | Operation::Dot(one, other) = &**operation {
                        self.operands.extend([one.clone(), other.clone()]);
                    }
                }
                _ => {}
            }
            let is_atom = matches!(
                node,
                Tree::Symbol(..) | Tree::Call(..) | Tree::Partial { .. } | Tree::Invariant { .. }
            );
            if bears && is_atom && !self.atoms.contains(node) {
                self.atoms.push(node.clone());
            }
            let is_long = !is_atom && !matches!(node, Tree::Number(_) | Tree::Negate(_));
            if bears && is_long && !self.terms.contains(node) {
                self.terms.push(node.clone());
            }
            let is_whole = is_long || matches!(node, Tree::Call(..));
            if is_other && self.said.insert(node.clone()) && is_whole && !bears {
                self.near.push(node.clone());
            }
        });
    }

    /// The names that may be meant by one, each with the size of the misprint.
    pub fn others(&self, name: &Name, is_called: bool) -> Vec<(Name, u32)> {
        let mut found: BTreeMap<Name, u32> = BTreeMap::new();
        let mut add = |other: Name, cost: u32| {
            if other != *name {
                let known = found.entry(other).or_insert(cost);
                *known = (*known).min(cost);
            }
        };
        if is_called && name.subscript.is_empty() {
            for (one, other) in FUNCTIONS {
                for (from, to) in [(one, other), (other, one)] {
                    if name.base == from {
                        let base = to.to_owned();
                        add(Name { base, ..name.clone() }, 10);
                    }
                }
            }
            if name.base.starts_with('\\') && found.len() > 1 {
                return found.into_iter().collect();
            }
        }
        let list = if is_called { &self.called } else { &self.symbols };
        let mut add = |other: Name, cost: u32| {
            if other != *name {
                let known = found.entry(other).or_insert(cost);
                *known = (*known).min(cost);
            }
        };
        for other in list {
            let differences = [
                other.base != name.base,
                other.accents != name.accents,
                other.subscript != name.subscript,
                other.mark != name.mark,
                other.primes != name.primes,
            ];
            let count = differences.into_iter().filter(|differs| *differs).count() as u32;
            add(other.clone(), 8 + 2 * count + if differences[0] { 3 } else { 0 });
        }
        for letter in &self.letters {
            if let Some(index) = index_of(&name.subscript, letter) {
                for (by, cost) in [(1, 10), (-1, 10), (2, 12), (-2, 12)] {
                    let subscript = subscript_of(index + by, letter);
                    add(
                        Name {
                            subscript,
                            ..name.clone()
                        },
                        cost + 1,
                    );
                }
            }
        }
        if !name.base.starts_with('\\') || !is_called {
            add(name.dotted(), 12);
            if let Some((last, rest)) = name.accents.split_last() {
                let mut accents = rest.to_vec();
                match last.as_str() {
                    r"\ddot" => accents.push(r"\dot".to_owned()),
                    r"\dddot" => accents.push(r"\ddot".to_owned()),
                    _ => {}
                }
                add(
                    Name {
                        accents,
                        ..name.clone()
                    },
                    11,
                );
            }
            let primes = name.primes.saturating_add(1);
            add(Name { primes, ..name.clone() }, 12);
            let primes = name.primes.saturating_sub(1);
            add(Name { primes, ..name.clone() }, 11);
        }
        if let Some(mark) = match name.mark.as_str() {
            "-" => Some("+"),
            "+" => Some("-"),
            _ => None,
        } {
            let mark = mark.to_owned();
            add(Name { mark, ..name.clone() }, 10);
        }
        found.into_iter().collect()
    }

    /// The derivatives that may be meant by one.
    pub fn partials(&self, of: &Name, by: &Name) -> Vec<(Name, Name)> {
        let mut found: BTreeSet<(Name, Name)> = self.derivatives.iter().cloned().collect();
        for (one, _) in &self.derivatives {
            for (_, other) in &self.derivatives {
                found.insert((one.clone(), other.clone()));
            }
        }
        found.remove(&(of.clone(), by.clone()));
        found.into_iter().collect()
    }

    /// How many of the parts of a formula stand elsewhere in the sheet too, products and longer ones.
    pub fn agreement(&self, tree: &Tree) -> u32 {
        let is_long = matches!(
            tree,
            Tree::Sum(_) | Tree::Product(_) | Tree::Quotient(..) | Tree::Power(..)
        );
        let own = u32::from(is_long && self.said.contains(tree));
        own + parts(tree).iter().map(|part| self.agreement(part)).sum::<u32>()
    }
}

/// Adds a name to a list, but for the most names.
fn keep(list: &mut Vec<Name>, name: &Name) {
    if list.len() < MOST_NAMES && !list.contains(name) {
        list.push(name.clone());
    }
}

/// Both sides of all that an entry says.
fn trees_of(entry: &Entry) -> Vec<Tree> {
    let local = entry.local.iter().map(|(equation, _)| equation);
    let with = entry.with.iter().map(|(equation, _)| equation);
    let equations = entry.equations.iter().chain(local).chain(with);
    let sides = |equation: &Equation| [equation.left.clone(), equation.right.clone()];
    equations.flat_map(sides).collect()
}
