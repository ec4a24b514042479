//! The other meanings that a claim may have: what its verdict may not rest on.

use super::definition::is_constant;
use super::entry::{Entry, Role, approached};
use super::exponents::{is_at_times_whole, is_plainly_not_negative};
use super::nodes::{any, any_side, holds, speaks_of};
use super::sheet::Sheet;
use super::substitute::flies;
use crate::number::{Field, Rational};
use crate::tex::{Condition, DoubtKind, Equation, Name, Operation, Readings, Relation, Tree};
use std::collections::BTreeSet;

/// The most places of a claim at which two readings are decided each.
const MOST_PLACES: usize = 3;

impl Entry {
    /// The entry with the other reading of places of its equations, where all of them stand there.
    fn read_otherwise(&self, places: &[&Readings]) -> Option<Self> {
        let mut entry = self.clone();
        for place in places {
            let mut met = false;
            let stated = entry.equations.iter_mut().chain(&mut entry.stated);
            let sides = stated.flat_map(|equation| [&mut equation.left, &mut equation.right]);
            for side in sides.chain(entry.own.iter_mut().map(|local| &mut local.tree)) {
                *side = with_part(side, &place.taken, &place.other, &mut met);
            }
            if !met {
                return None;
            }
        }
        Some(entry)
    }
}

/// Returns a tree with a part of it replaced; `met` is set where the part stands in it.
fn with_part(tree: &Tree, part: &Tree, new: &Tree, met: &mut bool) -> Tree {
    match tree == part {
        true => {
            *met = true;
            new.clone()
        }
        false => tree.map(&mut |below| with_part(below, part, new, met)),
    }
}

impl Sheet {
    /// The places at which the claim at a position, or something that it rests on, has a meaning that was not taken.
    pub fn doubts(&self, position: usize) -> Vec<DoubtKind> {
        let Some(claim) = self.entries.get(position) else {
            return Vec::new();
        };
        let mut found: Vec<DoubtKind> = claim.guessed.iter().cloned().map(DoubtKind::Guess).collect();
        let below = self.below(claim);
        let read = std::iter::once(claim).chain(below.iter().copied());
        let read = read.flat_map(|entry| &entry.doubts).map(|doubt| &doubt.kind);
        for kind in read.filter(|kind| self.is_plausible(kind, claim, &below)) {
            if !found.contains(kind) {
                found.push(kind.clone());
            }
        }
        found.extend(self.powers_of_signs(claim, &below));
        found.extend(self.of_some(claim, &below).into_iter().map(DoubtKind::OfSome));
        found.extend(self.one_step(claim, &below));
        found.extend(tends(claim).map(DoubtKind::Tends));
        found
    }

    /// The sheets in which the claim at a position is read otherwise at places of two readings, one for each choice, and the
    /// places; none where a reading is not of the claim's equations alone, or the places are more than three.
    pub fn read_otherwise(&self, position: usize) -> (Vec<Sheet>, Vec<DoubtKind>) {
        let kinds = self.doubts(position);
        let places: Vec<(DoubtKind, Readings)> = kinds
            .into_iter()
            .filter_map(|kind| kind.readings().cloned().map(|readings| (kind, readings)))
            .collect();
        let Some(claim) = self.entries.get(position).filter(|_| places.len() <= MOST_PLACES) else {
            return (Vec::new(), Vec::new());
        };
        let below = self.below(claim);
        let beside = claim.local.iter().chain(&claim.with).map(|(equation, _)| equation);
        let beside = beside
            .chain(&claim.alternatives)
            .chain(below.iter().flat_map(|entry| &entry.equations));
        let assumed = claim.assume.iter().flat_map(|(condition, _)| condition.sides());
        let mut elsewhere = beside
            .flat_map(|equation| [&equation.left, &equation.right])
            .chain(assumed);
        if elsewhere.any(|side| any(side, &mut |node| places.iter().any(|(_, place)| place.taken == *node))) {
            return (Vec::new(), Vec::new());
        }
        let choices = 1..1_u32 << places.len();
        let otherwise = choices.map(|choice| {
            let chosen = places.iter().enumerate().filter(|(at, _)| choice >> at & 1 == 1);
            let readings: Vec<&Readings> = chosen.map(|(_, (_, readings))| readings).collect();
            claim.read_otherwise(&readings).map(|claim| {
                let mut sheet = self.clone();
                if let Some(entry) = sheet.entries.get_mut(position) {
                    *entry = claim;
                }
                sheet
            })
        });
        match otherwise.collect::<Option<Vec<Sheet>>>() {
            Some(sheets) => (sheets, places.into_iter().map(|(kind, _)| kind).collect()),
            None => (Vec::new(), Vec::new()),
        }
    }

    /// What a claim follows from, and the definitions below that.
    fn below<'e>(&'e self, claim: &Entry) -> Vec<&'e Entry> {
        let mut below: Vec<&Entry> = claim.follows_from.iter().filter_map(|&n| self.entries.get(n)).collect();
        for definition in self.definitions_below(claim) {
            if !below.iter().any(|known| known.label == definition.label) {
                below.push(definition);
            }
        }
        below
    }

    /// Returns true if a reader would think of the other meaning: a letter has an argument where what it stands for is
    /// written with a letter that stands in the bracket, and a bracket behind a derivative is the point at which it is taken,
    /// but a sum behind the derivative of a state at an impact, which has no argument, is a factor. A function is applied again
    /// where its values are given, but no state.
    fn is_plausible(&self, kind: &DoubtKind, claim: &Entry, below: &[&Entry]) -> bool {
        let (of, inside) = match kind {
            DoubtKind::Argument { of, inside } => (of, inside),
            DoubtKind::DerivativeBeforeBracket { of, inside } => {
                return !(self.is_of_impacts(of) && matches!(inside, Tree::Sum(_)));
            }
            DoubtKind::PowerOfFunction { of, .. } => return self.is_given(of, below),
            _ => return true,
        };
        let shares = |meaning: &Tree| {
            any(meaning, &mut |node| match node {
                Tree::Symbol(name, _) => !is_constant(name) && has_outside_calls(inside, name),
                _ => false,
            })
        };
        let is_it = |tree: &Tree| matches!(tree, Tree::Symbol(name, _) if name == of);
        let own = std::iter::once(claim).chain(below.iter().copied());
        let said = own.clone().flat_map(|entry| {
            let local = entry.local.iter().map(|(equation, _)| equation);
            let equations = entry.equations.iter().filter(|_| entry.role != Role::Claim);
            local.chain(equations)
        });
        let mut sides =
            said.flat_map(|equation| [(&equation.left, &equation.right), (&equation.right, &equation.left)]);
        let mut locals = own.flat_map(|entry| &entry.own);
        let mut abbreviations = self.vocabulary.abbreviations.iter();
        sides.any(|(name, meaning)| is_it(name) && shares(meaning))
            || locals.any(|local| local.name == *of && shares(&local.tree))
            || abbreviations.any(|(name, meaning)| name == of && shares(meaning))
    }

    /// Returns true if an equation that a claim follows from gives the values of a function, f(x) = ..., that is no state.
    fn is_given(&self, function: &Name, below: &[&Entry]) -> bool {
        let is_value = |side: &Tree| matches!(side, Tree::Call(name, argument, _) if name == function && matches!(**argument, Tree::Symbol(..)));
        let mut given = below.iter().flat_map(|entry| &entry.equations);
        !self.vocabulary.is_in_flight(function) && given.any(|given| is_value(&given.left) || is_value(&given.right))
    }

    /// Returns true for the derivative of a state at an impact by one, `\partial t_{k+1}/\partial t_k`.
    fn is_of_impacts(&self, derivative: &Tree) -> bool {
        matches!(derivative, Tree::Partial { of, by, .. }
            if [of, by].iter().all(|name| self.vocabulary.impact(name).is_some()))
    }

    /// The powers with exponents that are integers at times of bases that may be negative.
    fn powers_of_signs(&self, claim: &Entry, below: &[&Entry]) -> Vec<DoubtKind> {
        let assumed: Vec<&Condition> = claim.assume.iter().map(|(condition, _)| condition).collect();
        let mut integers = self.vocabulary.integers.clone();
        integers.extend(assumed.iter().filter_map(|condition| match condition {
            Condition::Integer(Tree::Symbol(name, _)) => Some(name.clone()),
            _ => None,
        }));
        let entries = std::iter::once(claim).chain(below.iter().copied());
        let mut found = Vec::new();
        for side in entries
            .flat_map(|entry| &entry.equations)
            .flat_map(|equation| [&equation.left, &equation.right])
        {
            any(side, &mut |node| {
                if let Tree::RealPower(base, exponent, _) = node
                    && is_at_times_whole(exponent, &integers)
                    && !is_plainly_not_negative(base, &self.vocabulary, &assumed)
                {
                    let (base, exponent) = ((**base).clone(), (**exponent).clone());
                    found.push(DoubtKind::PowerOfSign { base, exponent });
                }
                false
            });
        }
        found.truncate(1);
        found
    }

    /// The letters of a claim that authors mean for some value: integers and constants of which nothing speaks that the
    /// claim rests on, letters behind an implication alone, and letters between bounds at which an unknown function is taken.
    fn of_some(&self, claim: &Entry, below: &[&Entry]) -> Vec<Name> {
        let beside = claim.local.iter().chain(&claim.with).map(|(equation, _)| equation);
        let known = below.iter().flat_map(|entry| &entry.equations).chain(beside);
        let known: Vec<&Tree> = known.flat_map(|equation| [&equation.left, &equation.right]).collect();
        let is_known = |name: &Name| known.iter().any(|side| speaks_of(side, name));
        let is_restricted = claim.is_implication || below.iter().any(|entry| entry.role != Role::Definition);
        let noted = claim
            .of_some
            .iter()
            .filter(|name| is_restricted || is_added(name, &claim.equations));
        let mut found: Vec<Name> = noted.cloned().collect();
        let assumed: Vec<&Tree> = claim
            .assume
            .iter()
            .flat_map(|(condition, _)| condition.sides())
            .collect();
        for name in &self.vocabulary.parameters {
            let stands = || {
                claim
                    .equations
                    .iter()
                    .any(|equation| any_side(equation, &mut |node| is_symbol(node, name)))
            };
            let is_assumed = assumed.iter().any(|side| speaks_of(side, name));
            let is_new = claim.is_implication && !is_assumed;
            if (is_new || (is_assumed && self.is_between(name, claim))) && stands() {
                found.push(name.clone());
            }
        }
        found.retain(|name| !is_known(name));
        found.dedup();
        found
    }

    /// Returns true if a letter stands between two bounds that are assumed, and an unknown function is taken there.
    fn is_between(&self, name: &Name, claim: &Entry) -> bool {
        let bound = |is_above: bool| {
            claim.assume.iter().any(|(condition, _)| match condition {
                Condition::Relation(Equation {
                    left, relation, right, ..
                }) => {
                    let (low, high) = match relation {
                        Relation::Less | Relation::LessOrEqual => (left, right),
                        Relation::Greater | Relation::GreaterOrEqual => (right, left),
                        Relation::Equal | Relation::NotEqual => return false,
                    };
                    is_symbol(if is_above { low } else { high }, name)
                }
                Condition::Integer(_) => false,
            })
        };
        let is_argument = |node: &Tree| match node {
            Tree::Call(function, argument, _) => {
                self.vocabulary.names.is_function(function) && speaks_of(argument, name)
            }
            _ => false,
        };
        bound(true)
            && bound(false)
            && claim
                .equations
                .iter()
                .any(|equation| any_side(equation, &mut |node| is_argument(node)))
    }

    /// Returns the doubt of a claim on a step of an index that no premise is about, although one is about another step: it
    /// may be meant for each. A premise with an abbreviation of states at two impacts, such as T_1 = t_{k+1} - t_k, is about
    /// that step alone.
    fn one_step(&self, claim: &Entry, below: &[&Entry]) -> Option<DoubtKind> {
        let letter = &self.vocabulary.index;
        let runs = self.vocabulary.indices.iter().any(|name| name.base == *letter);
        let steps = below
            .iter()
            .filter(|entry| entry.role != Role::Definition)
            .flat_map(|entry| &entry.equations);
        let steps: Vec<(&Equation, BTreeSet<i32>)> = steps
            .filter(|equation| !flies(equation, &self.vocabulary))
            .map(|equation| (equation, self.vocabulary.impacts(equation)))
            .collect();
        let said: BTreeSet<i32> = steps.iter().flat_map(|(_, impacts)| impacts).copied().collect();
        let asked = claim
            .equations
            .iter()
            .flat_map(|equation| self.vocabulary.impacts(equation));
        let goes_on = asked.into_iter().any(|index| !said.contains(&index));
        let zero = Tree::Number(Rational::from_integer(0));
        let is_fixed = |equation: &Equation| {
            self.vocabulary.abbreviations.iter().any(|(name, meaning)| {
                any_side(equation, &mut |node| is_symbol(node, name))
                    && self
                        .vocabulary
                        .impacts(&Equation::between(meaning.clone(), zero.clone()))
                        .len()
                        > 1
            })
        };
        let is_step = steps
            .iter()
            .any(|(equation, impacts)| impacts.len() > 1 && !is_fixed(equation));
        (!runs && is_step && goes_on).then(|| DoubtKind::OneStep { index: letter.clone() })
    }
}

fn is_symbol(tree: &Tree, name: &Name) -> bool {
    matches!(tree, Tree::Symbol(own, _) if own == name)
}

/// Returns true if a letter stands in the equations once, as a factor of a term of a whole side, beside letters of its own.
fn is_added(name: &Name, equations: &[Equation]) -> bool {
    let mut places = 0;
    for equation in equations {
        any_side(equation, &mut |node| {
            places += usize::from(is_symbol(node, name));
            false
        });
    }
    let is_added = equations.iter().any(|equation| {
        [&equation.left, &equation.right]
            .into_iter()
            .any(|side| matches!(side, Tree::Sum(terms) if terms.iter().any(|term| has_factor(term, name))))
    });
    places == 1 && is_added
}

fn has_factor(term: &Tree, name: &Name) -> bool {
    match term {
        Tree::Negate(inner) | Tree::PlusMinus(inner) | Tree::MinusPlus(inner) => has_factor(inner, name),
        Tree::Product(factors) => factors.iter().any(|factor| is_symbol(factor, name)),
        Tree::Quotient(above, ..) => has_factor(above, name),
        term => is_symbol(term, name),
    }
}

/// What tends to a value by what is assumed of a claim that is no expansion.
fn tends(claim: &Entry) -> Option<Name> {
    let is_expansion = |equation: &Equation| holds(equation, &|operation| matches!(operation, Operation::Order(_)));
    let mut assumed = claim.assume.iter().filter_map(|(condition, _)| approached(condition));
    assumed.next().filter(|_| !claim.equations.iter().any(is_expansion))
}

/// Returns true if a name stands in a tree otherwise than in the argument of a function.
fn has_outside_calls(tree: &Tree, name: &Name) -> bool {
    match tree {
        Tree::Symbol(own, _) => own == name,
        Tree::Call(..) => false,
        _ => tree
            .find_below(&mut |part| has_outside_calls(part, name).then_some(()))
            .is_some(),
    }
}
