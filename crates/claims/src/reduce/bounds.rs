//! Inequalities with the values of functions as letters of which bounds are known: sines and cosines lie between -1 and 1,
//! and e^u is positive and at least 1 + u (DLMF 4.5.9 and 4.21). Powers of positive numbers are positive. What holds for all such letters holds
//! for the values.

use super::build::{integer, plain, related, sum, symbol};
use super::{Goal, Rule, fresh, has_operation, trees};
use std::collections::BTreeSet;
use texmath::{Condition, Equation, Name, Relation, Tree, any, mapped, names_in};

/// The most values that become letters.
const MOST: usize = 4;

/// A value that becomes a letter.
enum Bounded {
    /// A sine or a cosine.
    Wave,
    /// A power of e, and its exponent.
    Exponential(Tree),
    /// A power of a base which is positive, with an integer for its exponent.
    Positive(Tree),
}

fn kind(node: &Tree, goal: &Goal) -> Option<Bounded> {
    let euler = plain("e");
    match node {
        Tree::Call(name, ..) if ["\\sin", "\\cos"].contains(&name.base.as_str()) => Some(Bounded::Wave),
        Tree::Call(name, argument, _) if name.base == "\\exp" => Some(Bounded::Exponential((**argument).clone())),
        Tree::RealPower(base, exponent, _) => {
            let is_euler = matches!(&**base, Tree::Symbol(name, _) if *name == euler);
            let mut names = BTreeSet::new();
            names_in(exponent, &mut names);
            let is_integer = |name: &Name| goal.symbols.is_integer(name);
            match is_euler && !goal.symbols.declares(&euler) {
                true => Some(Bounded::Exponential((**exponent).clone())),
                false if !names.is_empty() && names.iter().all(is_integer) => Some(Bounded::Positive((**base).clone())),
                false => None,
            }
        }
        _ => None,
    }
}

/// The bounds of a value.
fn bounds_of(bounded: Bounded, value: &Tree) -> Vec<Equation> {
    let to = |kind: Relation, bound: Tree| related(value.clone(), kind, bound);
    match bounded {
        Bounded::Wave => vec![
            to(Relation::GreaterOrEqual, integer(-1)),
            to(Relation::LessOrEqual, integer(1)),
        ],
        Bounded::Exponential(exponent) => vec![
            to(Relation::Greater, integer(0)),
            to(Relation::GreaterOrEqual, sum(vec![integer(1), exponent])),
        ],
        Bounded::Positive(_) => vec![to(Relation::Greater, integer(0))],
    }
}

/// The values in the claims of a goal that become letters.
fn bounded(goal: &Goal) -> Vec<(Tree, Bounded)> {
    let mut found: Vec<(Tree, Bounded)> = Vec::new();
    for side in goal
        .statements
        .claims
        .iter()
        .flat_map(|claim| [&claim.left, &claim.right])
    {
        any(side, &mut |node| {
            let own = kind(node, goal).filter(|_| !found.iter().any(|(known, _)| known == node));
            found.extend(own.map(|own| (node.clone(), own)));
            false
        });
    }
    found
}

/// The ways to prove an inequality of real numbers with such values as letters; `in_letter` gives those by one of these.
pub(super) fn ways(goal: &Goal, in_letter: &dyn Fn(&Goal, &Name) -> Vec<Vec<Goal>>) -> Vec<Vec<Goal>> {
    let is_other = |tree: &Tree| goal.symbols.may_be_complex(tree) || has_operation(tree, &goal.symbols);
    if trees(&goal.statements).into_iter().any(is_other) {
        return Vec::new();
    }
    let found = bounded(goal);
    if found.is_empty() || found.len() > MOST {
        return Vec::new();
    }
    let mut symbols = goal.symbols.clone();
    let mut statements = goal.statements.clone().by(Rule::InequalityBounds);
    let mut lemmas = Vec::new();
    let mut letters: Vec<(Tree, Name)> = Vec::new();
    for (node, bounded) in found {
        let name = fresh(&statements, &symbols, "s");
        symbols.let_be_parameter(&name, false);
        if let Bounded::Positive(base) = &bounded {
            let mut alone = goal.statements.clone().by(Rule::InequalityBounds);
            alone.claims = vec![related(base.clone(), Relation::Greater, integer(0))];
            lemmas.push(Goal::of(
                &alone,
                &goal.symbols,
                "the base of a power is positive".to_owned(),
            ));
        }
        let bounds = bounds_of(bounded, &symbol(&name));
        statements.assume.extend(bounds.into_iter().map(Condition::Relation));
        letters.push((node, name));
    }
    let with_letters = |tree: &Tree| {
        mapped(tree, &|node| {
            let known = letters.iter().find(|(known, _)| known == node);
            known.map(|(_, name)| symbol(name))
        })
    };
    let statements = super::rewritten(&statements, Rule::InequalityBounds, &with_letters);
    let part = "values between bounds as letters".to_owned();
    let main = Goal::of(&statements, &symbols, part);
    let by_letters = letters
        .iter()
        .flat_map(|(_, letter)| in_letter(&main, letter).into_iter().take(1));
    let ways = by_letters.chain([vec![main.clone()]]);
    ways.map(|way| lemmas.iter().cloned().chain(way).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::super::super::premise::Statements;
    use super::*;
    use texmath::Symbols;

    #[test]
    fn sines_become_letters_with_bounds_and_a_power_needs_a_positive_base() {
        let mut symbols = Symbols::default();
        let (x, n) = (plain("x"), plain("n"));
        symbols.let_be_parameter(&x, false);
        symbols.let_be_parameter(&n, false);
        symbols.declare(n.clone(), texmath::Meaning::Integer);
        let goals = |left: Tree| {
            let statements = Statements {
                claims: vec![related(left, Relation::LessOrEqual, integer(1))],
                ..Statements::default()
            };
            ways(&Goal::of(&statements, &symbols, String::new()), &|_, _| Vec::new())
        };
        let wave = goals(super::super::build::call("\\sin", symbol(&x)));
        let last = wave.last().and_then(|way| way.last()).unwrap();
        assert_eq!((wave.last().unwrap().len(), last.statements.assume.len()), (1, 2));
        let power = goals(super::super::build::real_power(symbol(&x), symbol(&n)));
        assert_eq!(power.last().unwrap().len(), 2);
        assert!(goals(symbol(&x)).is_empty());
    }
}
