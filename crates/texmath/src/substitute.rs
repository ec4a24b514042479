//! Substitutions in a tree, and what an equation is said of.

use super::nodes::{any, any_side};
use super::symbols::{Symbols, index_of, subscript_of};
use super::{At, Condition, Equation, Name, Operation, Tree, evaluate};
use numbers::{Field, Rational};
use std::collections::{BTreeMap, BTreeSet};

/// Returns the tree with each symbol for which `new` has a tree replaced by it. What is put in keeps its meaning: a letter that an
/// operation binds there makes way.
pub fn rewrite(tree: &Tree, new: &dyn Fn(&Name) -> Option<Tree>) -> Tree {
    replaced(tree, new, Put::Rewritten)
}

/// Returns the tree with names replaced by what they stand for: what is put in is read where it stands, as an author who defines
/// W = x^2 means it in an integral of W over x.
pub fn put_in(tree: &Tree, new: &dyn Fn(&Name) -> Option<Tree>) -> Tree {
    replaced(tree, new, Put::AsWritten)
}

/// Does as [`put_in`], with the names in what is put in replaced too. It must come to an end.
pub fn put_in_throughout(tree: &Tree, new: &dyn Fn(&Name) -> Option<Tree>) -> Tree {
    replaced(tree, new, Put::Throughout)
}

/// What is done with a tree that takes the place of a name.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Put {
    /// It keeps its meaning: a letter that an operation binds there makes way.
    Rewritten,
    /// It is read where it stands.
    AsWritten,
    /// It is read where it stands, and its own names are replaced too.
    Throughout,
}

fn replaced(tree: &Tree, new: &dyn Fn(&Name) -> Option<Tree>, put: Put) -> Tree {
    let again = |tree: &Tree| replaced(tree, new, put);
    // A derivative is of and by names: only a name can take the place of one.
    let renamed = |name: &Name| {
        let mut name = name.clone();
        while let Some(Tree::Symbol(next, _)) = new(&name) {
            name = next;
            if put != Put::Throughout {
                break;
            }
        }
        name
    };
    match tree {
        Tree::Symbol(name, _) => match new(name) {
            Some(tree) if put == Put::Throughout => again(&tree),
            Some(tree) => tree,
            None => tree.clone(),
        },
        Tree::Partial { of, by, at } => Tree::Partial {
            of: renamed(of),
            by: renamed(by),
            at: *at,
        },
        Tree::Operation(operation, at) => {
            let operation = match put {
                Put::Rewritten => out_of_the_way(operation, new),
                Put::AsWritten | Put::Throughout => (**operation).clone(),
            };
            let letter = operation.letter().cloned();
            let operation = operation.map(&mut |part, is_bound| match &letter {
                Some(letter) if is_bound => replaced(part, &|name| new(name).filter(|_| name != letter), put),
                _ => again(part),
            });
            Tree::Operation(Box::new(operation), *at)
        }
        tree => tree.map(&mut |part| again(part)),
    }
}

/// Returns the tree with each node replaced for which `new` has another.
pub fn mapped(tree: &Tree, new: &dyn Fn(&Tree) -> Option<Tree>) -> Tree {
    new(tree).unwrap_or_else(|| tree.map(&mut |part| mapped(part, new)))
}

/// The operation with a letter bound that nothing speaks of which is put in where it is bound.
fn out_of_the_way(operation: &Operation, new: &dyn Fn(&Name) -> Option<Tree>) -> Operation {
    let Some(letter) = operation.letter() else {
        return operation.clone();
    };
    let mut met: Vec<Name> = Vec::new();
    for (part, _) in operation.parts().into_iter().filter(|(_, is_bound)| *is_bound) {
        any(part, &mut |node| {
            if let Tree::Symbol(name, _) = node {
                match new(name).filter(|_| name != letter) {
                    Some(tree) => {
                        any(&tree, &mut |node| {
                            met.extend(name_of(node));
                            false
                        });
                    }
                    None => met.extend((name != letter).then(|| name.clone())),
                }
            }
            false
        });
    }
    if !met.contains(letter) {
        return operation.clone();
    }
    let mut other = letter.clone();
    while met.contains(&other) || other == *letter {
        other.primes = other.primes.saturating_add(1);
    }
    let renamed = operation.map(&mut |part, is_bound| match is_bound {
        true => rewrite(part, &|name| {
            (name == letter).then(|| Tree::Symbol(other.clone(), At::default()))
        }),
        false => part.clone(),
    });
    renamed.with_letter(other)
}

fn name_of(tree: &Tree) -> Option<Name> {
    match tree {
        Tree::Symbol(name, _) => Some(name.clone()),
        _ => None,
    }
}

/// Returns the equation with both sides rewritten.
pub fn rewrite_equation(equation: &Equation, new: &dyn Fn(&Name) -> Option<Tree>) -> Equation {
    Equation {
        left: rewrite(&equation.left, new),
        right: rewrite(&equation.right, new),
        ..equation.clone()
    }
}

/// Returns the value of a tree that is written with numbers alone.
pub fn number_of(tree: &Tree) -> Option<Rational> {
    evaluate(tree, &mut BTreeMap::<Name, Rational>::new()).ok()
}

/// Returns the condition with what stands in it rewritten, as sides of an equation.
pub fn rewrite_condition(condition: &Condition, new: &dyn Fn(&Equation) -> Equation) -> Condition {
    match condition {
        Condition::Relation(relation) => Condition::Relation(new(relation)),
        Condition::Integer(tree) => Condition::Integer(rewrite_alone(tree, new)),
    }
}

/// Returns the tree rewritten as a side of an equation would be.
pub fn rewrite_alone(tree: &Tree, new: &dyn Fn(&Equation) -> Equation) -> Tree {
    let nothing = Tree::Number(<Rational as num_traits::Zero>::zero());
    new(&Equation::between(tree.clone(), nothing)).left
}

/// Returns true if an equation is said of a running time: by its symbol, or by a function without a bracket.
pub fn runs(equation: &Equation, symbols: &Symbols) -> bool {
    tree_runs(&equation.left, symbols) || tree_runs(&equation.right, symbols)
}

/// Returns true if an equation speaks of a state in flight: at the time of an impact it is the state there.
pub fn flies(equation: &Equation, symbols: &Symbols) -> bool {
    let is_state = |name: &Name| {
        let mut states = symbols.states();
        states.any(|s| [s.clone(), s.dotted(), s.dotted().dotted()].contains(&name.bare()))
    };
    let at_impact = |argument: &Tree| matches!(argument, Tree::Symbol(time, _) if symbols.impact(time).is_some());
    let mut test = |node: &Tree| match node {
        Tree::Call(name, argument, _) => name.subscript.is_empty() && is_state(name) && !at_impact(argument),
        Tree::Symbol(name, _) => name.subscript.is_empty() && is_state(name),
        _ => false,
    };
    any_side(equation, &mut test)
}

/// Returns true if a formula is said of a running time.
pub fn tree_runs(tree: &Tree, symbols: &Symbols) -> bool {
    any(tree, &mut |node| match node {
        Tree::Symbol(name, _) => {
            symbols.running() == Some(name) || (symbols.names.functions.contains(name) && !symbols.is_parameter(name))
        }
        _ => false,
    })
}

impl Symbols {
    /// Returns the impact that an indexed time or state belongs to.
    pub fn impact(&self, name: &Name) -> Option<i32> {
        let bare = name.bare();
        let indexed = self.is_time(&bare) || self.is_state(&bare);
        if indexed {
            index_of(&name.subscript, &self.index)
        } else {
            None
        }
    }

    /// Returns the impacts that an equation speaks of.
    pub fn impacts(&self, equation: &Equation) -> BTreeSet<i32> {
        let mut met = self.impacts_in(&equation.left);
        self.collect_impacts(&equation.right, &mut met);
        met
    }

    /// Returns the impacts that a formula speaks of.
    pub fn impacts_in(&self, tree: &Tree) -> BTreeSet<i32> {
        let mut met = BTreeSet::new();
        self.collect_impacts(tree, &mut met);
        met
    }

    /// Adds the impacts that a formula speaks of.
    pub fn collect_impacts(&self, tree: &Tree, met: &mut BTreeSet<i32>) {
        any(tree, &mut |node| {
            match node {
                Tree::Symbol(name, _) => match self.abbreviation(name) {
                    Some(tree) => self.collect_impacts(tree, met),
                    None => met.extend(self.impact(name)),
                },
                Tree::Partial { of, by, .. } => met.extend(self.impact(of).into_iter().chain(self.impact(by))),
                _ => {}
            }
            false
        });
    }

    /// Returns what an abbreviation stands for, those within it written out too, but for names that are `kept`.
    pub fn meaning(&self, name: &Name, kept: &dyn Fn(&Name) -> bool) -> Option<Tree> {
        let meant = self.abbreviation(name).filter(|_| !kept(name))?;
        Some(put_in(meant, &|inner| self.meaning(inner, kept)))
    }

    /// Returns the equation with its abbreviations written out.
    pub fn expanded(&self, equation: &Equation) -> Equation {
        let written = |tree| put_in(tree, &|name| self.meaning(name, &|_| false));
        Equation {
            left: written(&equation.left),
            right: written(&equation.right),
            ..equation.clone()
        }
    }

    /// Returns true if an equation is said of a running time or of a running index: it is more than one.
    pub fn moves(&self, equation: &Equation) -> bool {
        let counts = |letter: &Name, name: &Name| *letter == *name || index_of(&name.subscript, &letter.base).is_some();
        let equation = self.expanded(equation);
        let mut is_counted =
            |node: &Tree| matches!(node, Tree::Symbol(name, _) if self.indices().any(|letter| counts(letter, name)));
        runs(&equation, self) || any_side(&equation, &mut is_counted)
    }

    /// Returns true if an equation puts the time of one impact in for that of another, which takes the states there along.
    pub fn renames(&self, equation: &Equation) -> bool {
        let is_time = |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if self.is_time(&name.bare()) && self.impact(name).is_some());
        is_time(&equation.left) && is_time(&equation.right)
    }

    /// Returns true if an equation is said of many times, flights or indices.
    pub fn is_law(&self, equation: &Equation) -> bool {
        self.moves(equation) || flies(&self.expanded(equation), self)
    }

    /// Returns the equation said of impacts `by` further on.
    pub fn shifted(&self, equation: &Equation, by: i32) -> Equation {
        if by == 0 {
            return equation.clone();
        }
        rewrite_equation(&self.expanded(equation), &|name| {
            if self.is_index(name) && name.to_string() == self.index {
                let number = Tree::Number(Rational::from_integer(i64::from(by.abs())));
                let number = if by < 0 { Tree::Negate(Box::new(number)) } else { number };
                return Some(Tree::Sum(vec![Tree::Symbol(name.clone(), At::default()), number]));
            }
            let subscript = subscript_of(self.impact(name)? + by, &self.index);
            Some(Tree::Symbol(
                Name {
                    subscript,
                    ..name.clone()
                },
                At::default(),
            ))
        })
    }

    /// Returns the equation with symbols replaced, all at once. A time of an impact takes the states at that impact along,
    /// unless these are replaced by something else.
    pub fn substituted(&self, equation: &Equation, pairs: &[(Name, Tree)]) -> Equation {
        let find = |name: &Name| pairs.iter().find(|(from, _)| from == name).map(|(_, to)| to.clone());
        let timed = any_side(equation, &mut |node| match node {
            Tree::Symbol(name, _) => self.is_time(&name.bare()) && find(name).is_some(),
            _ => false,
        });
        // what an abbreviation stands for is replaced too, unless it is itself
        let written_out = rewrite_equation(equation, &|name| self.meaning(name, &|inner| find(inner).is_some()));
        rewrite_equation(&written_out, &|name| {
            let plain = Name {
                mark: String::new(),
                ..name.clone()
            };
            find(name).or_else(|| match find(&plain) {
                Some(Tree::Symbol(to, at)) if !self.is_time(&plain.bare()) => Some(Tree::Symbol(
                    Name {
                        mark: name.mark.clone(),
                        ..to
                    },
                    at,
                )),
                // A state that an impact does not change is the same with a mark and without.
                Some(tree) if name.mark == "-" || self.is_continuous(&plain.bare()) => Some(tree),
                _ if timed => self.state_moved(name, &find),
                _ => None,
            })
        })
    }

    fn state_moved(&self, name: &Name, find: &dyn Fn(&Name) -> Option<Tree>) -> Option<Tree> {
        if !self.is_state(&name.bare()) {
            return None;
        }
        let family = self.times().next()?;
        match find(&Name {
            subscript: name.subscript.clone(),
            ..family.clone()
        })? {
            Tree::Symbol(time, at) => Some(Tree::Symbol(
                Name {
                    subscript: time.subscript,
                    ..name.clone()
                },
                at,
            )),
            _ => None,
        }
    }
}
