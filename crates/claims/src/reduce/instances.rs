//! A claim at numbers for its integers, or for the letters in its integrals: what must hold if the claim does.

use super::super::elaborate;
use super::super::exponents::bases;
use super::super::premise::Statements;
use super::build::integer;
use super::evaluate::evaluated;
use super::integers::free_integers;
use super::integral::{are_numbers, by_antiderivatives, outermost};
use super::{Goal, Proposals, Reduced, Rule, rewritten, trees};
use dashu_int::ops::BitTest;
use numbers::{Field, Rational};
use std::collections::BTreeSet;
use texmath::{
    At, Condition, Equation, Name, Operation, Relation, Symbols, Tree, any, mapped, names_in, number_of, rewrite,
};

/// The highest number that is put in, the most letters, and the most goals.
const HIGHEST: i64 = 7;
const MOST_LETTERS: usize = 3;
const MOST_GOALS: usize = 8;
const MOST_WITH_INTEGRALS: usize = 4;

/// The numbers that are put in for a letter in an integral: where it stands in an exponent, and elsewhere.
const IN_EXPONENTS: [(i64, i64); 4] = [(1, 2), (3, 2), (1, 4), (5, 4)];
const ELSEWHERE: [(i64, i64); 6] = [(1, 1), (2, 1), (1, 2), (3, 1), (-1, 1), (1, 5)];

/// Numbers that stand for letters.
type Numbers<'a> = [(&'a Name, Rational)];

/// The claim at small numbers for its integers, in all the places where they stand.
pub(super) fn of(statements: &Statements, symbols: &Symbols) -> Vec<Goal> {
    let goal = |instance: &Statements, pairs: &Numbers<'_>| {
        let evaluated = evaluated(instance, symbols).ok()?;
        if trees(&evaluated).into_iter().any(super::factorial::stands_in) {
            return None;
        }
        Some(Goal::of(&evaluated, symbols, named(pairs)).at(pairs))
    };
    first_found(statements, symbols, MOST_GOALS, &goal)
}

/// The claim with integrals at small numbers for its integers; each instance holds where its lemmas do.
pub(super) fn with_integrals(statements: &Statements, symbols: &Symbols, proposals: &dyn Proposals) -> Option<Reduced> {
    let reduced = |instance: &Statements, pairs: &Numbers<'_>| {
        let mut reduced = by_antiderivatives(instance, symbols, proposals).ok()??;
        reduced.sufficient = reduced.sufficient.into_iter().map(|goal| goal.at(pairs)).collect();
        for goal in &mut reduced.sufficient {
            goal.part = named(pairs);
        }
        Some(reduced)
    };
    let all = first_found(statements, symbols, MOST_WITH_INTEGRALS, &reduced);
    let mut all = all.into_iter();
    let mut together = all.next()?;
    for more in all {
        together.lemmas.extend(more.lemmas);
        together.sufficient.extend(more.sufficient);
    }
    Some(Reduced {
        necessary: together.sufficient,
        sufficient: Vec::new(),
        is_equivalent: false,
        ..together
    })
}

/// What is found at the first numbers for the integers, at most so many.
fn first_found<T>(
    statements: &Statements,
    symbols: &Symbols,
    most: usize,
    found: &dyn Fn(&Statements, &Numbers<'_>) -> Option<T>,
) -> Vec<T> {
    let letters = free_integers(statements, symbols);
    let mut all = Vec::new();
    let solved = super::cases::solved_for(statements);
    let is_kept = |letter: &Name| super::stands_in_symbols(symbols, letter) || solved.contains(letter);
    if letters.is_empty() || letters.len() > MOST_LETTERS || letters.iter().any(is_kept) {
        return all;
    }
    for total in 0..=HIGHEST * 2 {
        for values in tuples(letters.len(), total) {
            if all.len() >= most {
                return all;
            }
            let values = values.into_iter().map(Rational::from_integer);
            let pairs: Vec<(&Name, Rational)> = letters.iter().zip(values).collect();
            if let Some(instance) = at(statements, symbols, &pairs) {
                all.extend(found(&instance, &pairs));
            }
        }
    }
    all
}

/// The numbers that stand for letters, as they print.
fn named(pairs: &Numbers<'_>) -> String {
    let all: Vec<String> = pairs.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    all.join(", ")
}

/// The tuples of numbers from 0 that add up to `total`.
fn tuples(length: usize, total: i64) -> Vec<Vec<i64>> {
    if length == 1 {
        return if total <= HIGHEST {
            vec![vec![total]]
        } else {
            Vec::new()
        };
    }
    let first = 0..=total.min(HIGHEST);
    first
        .flat_map(|first| {
            tuples(length - 1, total - first)
                .into_iter()
                .map(move |rest| std::iter::once(first).chain(rest).collect())
        })
        .collect()
}

/// The claim at numbers for the letters in its integrals, each of which is then a number; nothing where other operations stand
/// in it.
pub(super) fn of_integrals(statements: &Statements, symbols: &Symbols) -> Vec<Goal> {
    let integrals: Vec<Tree> = trees(statements).into_iter().flat_map(outermost).map(as_tree).collect();
    let mut names = BTreeSet::new();
    integrals.iter().for_each(|tree| names_in(tree, &mut names));
    names.retain(|name| integrals.iter().any(|tree| tree.has_free(name)));
    let is_known = |name: &Name| texmath::is_constant(name) && !symbols.declares(name);
    let letters: Vec<Name> = names.into_iter().filter(|name| !is_known(name)).collect();
    let integers = super::integers::integers(statements, symbols);
    let is_real = |name: &Name| (symbols.is_parameter(name) || integers.contains(name)) && !symbols.is_generic(name);
    let is_kept = |name: &Name| super::stands_in_symbols(symbols, name) || !is_real(name);
    if letters.is_empty() || letters.len() > MOST_LETTERS || letters.iter().any(is_kept) {
        return Vec::new();
    }
    let is_positive = |base: &Tree| match base {
        Tree::Symbol(name, _) => is_known(name),
        base => number_of(base).is_some_and(|value| value > Rational::from_integer(0)),
    };
    let mut powers = Vec::new();
    for tree in trees(statements) {
        any(tree, &mut |node| {
            if let Tree::RealPower(base, exponent, _) = node
                && !is_positive(base)
            {
                powers.push(exponent.as_ref().clone());
            }
            false
        });
    }
    let numbers = |letter: &Name| match powers.iter().any(|exponent| exponent.has_free(letter)) {
        _ if integers.contains(letter) => vec![(0, 1), (1, 1), (2, 1), (3, 1)],
        true => IN_EXPONENTS.to_vec(),
        false => ELSEWHERE.to_vec(),
    };
    let numbers: Vec<Vec<(i64, i64)>> = letters.iter().map(numbers).collect();
    let longest = numbers.iter().map(Vec::len).max().unwrap_or_default();
    let mut goals = Vec::new();
    for total in 0..longest * letters.len() {
        for places in tuples(letters.len(), i64::try_from(total).unwrap_or_default()) {
            if goals.len() >= MOST_WITH_INTEGRALS {
                return goals;
            }
            let number = |(numbers, place): (&Vec<(i64, i64)>, i64)| {
                let (above, below) = *numbers.get(usize::try_from(place).ok()?)?;
                Rational::new(above, below)
            };
            let values: Option<Vec<Rational>> = numbers.iter().zip(places).map(number).collect();
            let Some(values) = values else {
                continue;
            };
            let pairs: Vec<(&Name, Rational)> = letters.iter().zip(values).collect();
            goals.extend(number_goal(statements, symbols, &pairs, &powers));
        }
    }
    goals
}

/// The claim at numbers, where its integrals are numbers that have a value there.
fn number_goal(
    statements: &Statements,
    symbols: &Symbols,
    pairs: &[(&Name, Rational)],
    exponents: &[Tree],
) -> Option<Goal> {
    // a power whose exponent is a letter has a value where its base is positive: one whose exponent is written as an integer, or
    // as a fraction with an odd denominator, has one where it is negative too
    let is_of_real = |exponent: &&Tree| {
        let mut moved = pairs.iter().filter(|(name, _)| exponent.has_free(name));
        moved.any(|(name, _)| !symbols.is_integer(name))
    };
    let is_even_root = |exponent: &Tree| {
        let there = rewrite(exponent, &|name| {
            let pair = pairs.iter().find(|(letter, _)| *letter == name);
            pair.map(|(_, value)| Tree::Number(value.clone()))
        });
        number_of(&there).is_some_and(|value: Rational| !value.0.denominator().bit(0))
    };
    if !exponents.iter().filter(is_of_real).all(is_even_root) {
        return None;
    }
    let instance = at(statements, symbols, pairs)?;
    if !are_numbers(&instance, symbols) {
        return None;
    }
    let goal = Goal::of(&instance, symbols, named(pairs)).at(pairs);
    elaborate::questions(&goal.statements, &goal.symbols)
        .is_ok()
        .then_some(goal)
}

fn as_tree(operation: Operation) -> Tree {
    Tree::Operation(Box::new(operation), At::default())
}

/// The statements with numbers for letters; `None` where these are not admissible.
pub(super) fn at(statements: &Statements, symbols: &Symbols, pairs: &[(&Name, Rational)]) -> Option<Statements> {
    let (zero, one) = (Rational::from_integer(0), Rational::from_integer(1));
    let excluded = |name: &Name, value: &Rational| {
        (*value <= zero && (symbols.is_positive(name) || symbols.is_at_most_one(name)))
            || (*value < zero && symbols.is_nonnegative(name))
            || (*value == zero && symbols.is_nonzero(name))
            || (*value > one && symbols.is_at_most_one(name))
            || (symbols.is_integer(name) && !value.0.is_int())
    };
    if pairs.iter().any(|(name, value)| excluded(name, value)) {
        return None;
    }
    let put_in = |name: &Name| {
        let pair = pairs.iter().find(|(letter, _)| *letter == name);
        pair.map(|(_, value)| Tree::Number(value.clone()))
    };
    let mut instance = rewritten(statements, Rule::IntegerInstances, &|tree| {
        folded(&rewrite(tree, &put_in))
    });
    // a power keeps the condition on its base where its exponent comes out as an integer
    let letters: Vec<Name> = pairs.iter().map(|(name, _)| (*name).clone()).collect();
    let mut powers = Vec::new();
    for tree in trees(statements) {
        bases(tree, &letters, &mut powers)?;
    }
    for (base, _) in powers {
        let base = folded(&rewrite(base, &put_in));
        if number_of(&base).is_some_and(|value: Rational| value >= Rational::from_integer(0)) {
            continue;
        }
        let mut relation = Equation::between(base, integer(0));
        relation.relation = Relation::GreaterOrEqual;
        instance.assume.push(Condition::Relation(relation));
    }
    for condition in &instance.assume {
        let holds = match condition {
            Condition::Relation(relation) => relation_holds(relation),
            Condition::Integer(tree) => number_of(tree).map(|value| value.0.is_int()),
        };
        if holds == Some(false) {
            return None;
        }
    }
    instance.assume.retain(|condition| match condition {
        Condition::Relation(relation) => relation_holds(relation).is_none(),
        Condition::Integer(tree) => number_of(tree).is_none(),
    });
    Some(instance)
}

/// Whether a relation between numbers holds.
pub(super) fn relation_holds(relation: &Equation) -> Option<bool> {
    let (left, right): (Rational, Rational) = (number_of(&relation.left)?, number_of(&relation.right)?);
    Some(match relation.relation {
        Relation::Equal => left == right,
        Relation::NotEqual => left != right,
        Relation::Less => left < right,
        Relation::LessOrEqual => left <= right,
        Relation::Greater => left > right,
        Relation::GreaterOrEqual => left >= right,
    })
}

/// The tree with exponents that are integers written as such.
fn folded(tree: &Tree) -> Tree {
    let is_power = |node: &Tree| matches!(node, Tree::RealPower(..));
    if !any(tree, &mut |node| is_power(node)) {
        return tree.clone();
    }
    mapped(tree, &|node| match node {
        Tree::RealPower(base, exponent, at) => {
            let exponent = i32::try_from(super::integers::whole(exponent)?).ok()?;
            Some(Tree::Power(Box::new(folded(base)), exponent, *at))
        }
        _ => None,
    })
}
