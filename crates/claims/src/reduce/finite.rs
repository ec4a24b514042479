//! Sums of symbolic length in closed form: where `t(k) = G(k + 1) - G(k)` at each k from a to n, the sum of t over these is
//! `G(n + 1) - G(a)` for n from a - 1 on. The inner ones of several come first, so that sums of sums are done, and limits of
//! sums.
//!
//! G is proposed; that its differences are the terms is a lemma.

use super::super::premise::Statements;
use super::build::{difference, infinity, integer, sum, symbol};
use super::defined::{conditions, with_domain};
use super::factorial::{is_linear_in, least_value};
use super::induction::first_value;
use super::integers::{integers, whole};
use super::{Goal, Proposals, Rule, fresh, has_operation, is_spoken_of, rewritten, trees};
use std::cell::RefCell;
use texmath::{
    At, Condition, Equation, Meaning, Name, Operation, Relation, Series, Symbols, Tree, any, mapped, rewrite,
};

/// An integer beyond which it does not matter to a limit at infinity what holds.
const FAR: i64 = 1000;

/// Statements with the sums that have one in closed form, and the claims that must hold for these to be right.
pub(super) struct Closed {
    pub statements: Statements,
    pub lemmas: Vec<Goal>,
}

/// The statements with sums of symbolic length in closed form; None where there is none that is found.
pub(super) fn closed(statements: &Statements, symbols: &Symbols, proposals: &dyn Proposals) -> Option<Closed> {
    let is_sum = |node: &Tree| matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Series { kind: Series::Sum, .. }));
    let all = trees(statements);
    let is_any = all.iter().any(|tree| any(tree, &mut |node| is_sum(node)));
    if !is_any || all.iter().any(|tree| symbols.may_be_complex(tree)) {
        return None;
    }
    let plain = Statements {
        premises: Vec::new(),
        ..with_domain(statements, symbols)
    };
    let scope = Scope {
        said: &statements.assume,
        statements: plain,
        symbols: symbols.clone(),
        letters: integers(statements, symbols),
        least: Vec::new(),
        proposals,
    };
    let lemmas = RefCell::new(Vec::new());
    let out = rewritten(statements, Rule::SeriesTelescoping, &|tree| {
        scope.closed(tree, &mut lemmas.borrow_mut())
    });
    let lemmas = lemmas.into_inner();
    (!lemmas.is_empty()).then_some(Closed {
        statements: out,
        lemmas,
    })
}

/// The place of a formula: what holds of the letters that are bound around it.
struct Scope<'a> {
    /// The conditions of the claim, without those on bound letters.
    said: &'a [Condition],
    statements: Statements,
    symbols: Symbols,
    /// The letters that are integers.
    letters: Vec<Name>,
    /// The least values of those that are bound.
    least: Vec<(Name, i64)>,
    proposals: &'a dyn Proposals,
}

impl Scope<'_> {
    /// The tree with its sums in closed form, where one is found.
    fn closed(&self, tree: &Tree, lemmas: &mut Vec<Goal>) -> Tree {
        let lemmas = RefCell::new(lemmas);
        mapped(tree, &|node| {
            let Tree::Operation(operation, at) = node else {
                return None;
            };
            match &**operation {
                Operation::Series {
                    kind: Series::Sum,
                    of,
                    index,
                    from,
                    to,
                } => Some(self.sum([of, from, to], index, *at, &mut lemmas.borrow_mut())),
                Operation::Limit { of, by, to } if infinity(to) == Some(true) => {
                    // far out the letter is any large integer
                    let within = self.within(by, Some(FAR), Vec::new());
                    let of = within.closed(of, &mut lemmas.borrow_mut());
                    let limit = Operation::Limit {
                        of,
                        by: by.clone(),
                        to: to.clone(),
                    };
                    Some(Tree::Operation(Box::new(limit), *at))
                }
                operation if operation.letter().is_some() => Some(node.clone()),
                _ => None,
            }
        })
    }

    /// The place within an operation that binds an integer, with its least value where that is known.
    fn within(&self, letter: &Name, least: Option<i64>, assume: Vec<Condition>) -> Scope<'_> {
        let mut statements = self.statements.clone();
        statements.assume.extend(assume);
        let mut symbols = self.symbols.clone();
        if !symbols.knows(letter) {
            symbols.let_be_parameter(letter, false);
        }
        symbols.declare(letter.clone(), Meaning::Integer);
        let letters = self.letters.iter().chain([letter]).cloned().collect();
        let own = least.map(|least| (letter.clone(), least));
        Scope {
            said: self.said,
            statements,
            symbols,
            letters,
            least: self.least.iter().cloned().chain(own).collect(),
            proposals: self.proposals,
        }
    }

    fn sum(&self, [of, from, to]: [&Tree; 3], index: &Name, at: At, lemmas: &mut Vec<Goal>) -> Tree {
        let own = fresh(&self.statements, &self.symbols, &index.base);
        let bound = |relation: Relation, bound: &Tree| {
            Condition::Relation(Equation {
                relation,
                ..Equation::between(symbol(&own), bound.clone())
            })
        };
        let assume = vec![bound(Relation::GreaterOrEqual, from), bound(Relation::LessOrEqual, to)];
        let within = self.within(&own, self.least_of(from), assume);
        let renamed = rewrite(of, &|name| (name == index).then(|| symbol(&own)));
        let of = within.closed(&renamed, lemmas);
        let open = || {
            let sum = Operation::Series {
                kind: Series::Sum,
                of: of.clone(),
                index: own.clone(),
                from: from.clone(),
                to: to.clone(),
            };
            Tree::Operation(Box::new(sum), at)
        };
        let is_whole = |tree: &Tree| is_linear_in(tree, &self.letters);
        let is_spoken = is_spoken_of(&self.statements, &self.symbols, index);
        let are_numbers = whole(from).is_some() && whole(to).is_some();
        let is_sum = is_whole(from) && is_whole(to) && !is_spoken && !are_numbers;
        let length = self.least_of(&difference(to.clone(), from.clone()));
        // within another sum the bounds of its index may say that the length is not negative
        let is_nested = !self.least.is_empty();
        let is_long = length.is_some_and(|length| length >= -1) || is_nested;
        if !is_sum || !is_long || has_operation(&of, &self.symbols) {
            return open();
        }
        let Some(found) = self.proposals.telescoping(&of, &own, &within.symbols) else {
            return open();
        };
        let there = |place: Tree| rewrite(&found, &|name| (*name == own).then(|| place.clone()));
        let next = |place: &Tree| sum(vec![place.clone(), integer(1)]);
        let steps = difference(there(next(&symbol(&own))), there(symbol(&own)));
        within.show(Equation::between(of.clone(), steps), lemmas);
        if length.is_none_or(|length| length < -1) {
            let last = next(to);
            let relation = Relation::GreaterOrEqual;
            self.show(
                Equation {
                    relation,
                    ..Equation::between(last, from.clone())
                },
                lemmas,
            );
        }
        // where the sum is empty its terms do not tell that this has a value
        let value = difference(there(next(to)), there(from.clone()));
        let Ok(needed) = conditions(&value, &within.symbols) else {
            return open();
        };
        needed.into_iter().for_each(|condition| self.show(condition, lemmas));
        value
    }

    /// Adds a claim that must hold at each value of the letters that are bound.
    fn show(&self, claim: Equation, lemmas: &mut Vec<Goal>) {
        let mut alone = self.statements.clone().by(Rule::SeriesTelescoping);
        // other sums play no part in it
        let is_plain = |side: &Tree| !has_operation(side, &self.symbols);
        alone
            .assume
            .retain(|condition| condition.sides().into_iter().all(is_plain));
        let part = format!("{claim} at each integer");
        alone.claims = vec![claim];
        lemmas.push(Goal::of(&alone, &self.symbols, part));
    }

    /// The least value of integers times letters, where it is known.
    fn least_of(&self, tree: &Tree) -> Option<i64> {
        least_value(tree, &|letter| {
            let bound = self.least.iter().rev().find(|(name, _)| name == letter);
            let said = || first_value(self.said, &self.symbols, letter).ok().flatten();
            bound.map(|(_, least)| *least).or_else(said)
        })
    }
}
