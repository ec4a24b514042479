//! Equations and inequalities with a root or the value of an inverse function alone on one side, by what these mean: the
//! value of `\arccos a` is the number from 0 to pi whose cosine is a, that of a square root of a the number that is not
//! negative and whose square is a.

use super::super::premise::Statements;
use super::build::{call, integer, negative, plain, power, related, sum};
use super::integral::terms;
use super::{Goal, Rule};
use texmath::{Condition, Elementary, Equation, Relation, Symbols, Tree, any};

/// What a value is known by.
struct Meaning {
    /// The equation that says it.
    equation: Equation,
    /// Where the value lies.
    range: Vec<Equation>,
    /// What must hold for there to be a value, which what is written says already.
    domain: Vec<Equation>,
}

/// The largest index of a root whose power is written out.
const HIGHEST: u32 = 12;

fn is_root(tree: &Tree) -> Option<(&Tree, u32)> {
    match tree {
        Tree::Root(radicand, index, _) => Some((radicand, *index)),
        _ => None,
    }
}

/// What it means that the root, or the value of an inverse function, is `value`.
fn meaning(tree: &Tree, value: &Tree) -> Option<Meaning> {
    if let Some((radicand, index)) = is_root(tree) {
        let is_even = index % 2 == 0;
        let signs = |tree: &Tree| related(tree.clone(), Relation::GreaterOrEqual, integer(0));
        return (index <= HIGHEST).then(|| Meaning {
            equation: Equation::between(
                power(value.clone(), i32::try_from(index).unwrap_or(0)),
                radicand.clone(),
            ),
            range: is_even.then(|| signs(value)).into_iter().collect(),
            domain: is_even.then(|| signs(radicand)).into_iter().collect(),
        });
    }
    let Tree::Call(name, argument, _) = tree else {
        return None;
    };
    let function = Elementary::named(name)?;
    let inverse = Elementary::by_command(function.inverse_of?)?;
    Some(Meaning {
        equation: Equation::between(call(inverse.command, value.clone()), (**argument).clone()),
        range: function.range(value),
        domain: inverse.range(argument),
    })
}

/// The ways to prove a claim of real numbers by the meaning of one of its terms; the goals of each are enough together.
pub(super) fn ways(statements: &Statements, symbols: &Symbols, claim: &Equation) -> Vec<Vec<Goal>> {
    if symbols.knows(&plain("\\pi")) && symbols.declares(&plain("\\pi")) {
        return Vec::new();
    }
    let mut all = Vec::new();
    terms(&claim.left, false, &mut all);
    terms(&claim.right, true, &mut all);
    let goals = |claims: Vec<Equation>, domain: &[Equation]| -> Vec<Goal> {
        let is_signed = |tree: &Tree| {
            any(tree, &mut |node| {
                matches!(node, Tree::PlusMinus(_) | Tree::MinusPlus(_))
            })
        };
        let domain = domain.iter().filter(|condition| !is_signed(&condition.left));
        let domain: Vec<Condition> = domain.cloned().map(Condition::Relation).collect();
        let goal = |claim: Equation| {
            let mut alone = statements.clone().by(Rule::InverseRange);
            let part = format!("what it means: {claim}");
            alone.claims = vec![claim];
            alone.assume.extend(domain.iter().cloned());
            Goal::of(&alone, symbols, part)
        };
        claims.into_iter().map(goal).collect()
    };
    let mut ways = Vec::new();
    let is_even = |node: &Tree| is_root(node).is_some_and(|(_, index)| index % 2 == 0);
    let sides = [&claim.left, &claim.right];
    if claim.relation == Relation::Equal && sides.into_iter().any(|side| any(side, &mut |node| is_even(node))) {
        // numbers that are not negative are equal where their squares are
        let signs = sides.map(|side| related(side.clone(), Relation::GreaterOrEqual, integer(0)));
        let squares = sides.map(|side| power(side.clone(), 2));
        let [left, right] = squares;
        ways.push(goals(
            signs.into_iter().chain([Equation::between(left, right)]).collect(),
            &[],
        ));
    }
    for (place, (is_negative, term)) in all.iter().enumerate() {
        let others = all.iter().enumerate().filter(|(other, _)| *other != place);
        // the value that the term has where both sides are equal
        let rest = others.map(|(_, (sign, term))| match sign == is_negative {
            true => negative(term.clone()),
            false => term.clone(),
        });
        let rest = sum(rest.collect());
        let Some(meaning) = meaning(term, &rest) else {
            continue;
        };
        let is_larger = match claim.relation {
            Relation::Equal => {
                let claims = meaning.range.into_iter().chain([meaning.equation]).collect();
                ways.push(goals(claims, &meaning.domain));
                continue;
            }
            Relation::NotEqual => continue,
            Relation::Greater | Relation::GreaterOrEqual => !is_negative,
            Relation::Less | Relation::LessOrEqual => *is_negative,
        };
        // a square root compares with a number as the squares do, where that is not negative; it is larger than others
        if is_root(term).is_some_and(|(_, index)| index == 2) {
            let is_strict = matches!(claim.relation, Relation::Greater | Relation::Less);
            let kind = match (is_larger, is_strict) {
                (true, false) => Relation::LessOrEqual,
                (true, true) => Relation::Less,
                (false, false) => Relation::GreaterOrEqual,
                (false, true) => Relation::Greater,
            };
            let squares = related(meaning.equation.left, kind, meaning.equation.right);
            let signs = if is_larger { Vec::new() } else { meaning.range };
            ways.push(goals(signs.into_iter().chain([squares]).collect(), &meaning.domain));
        }
    }
    ways
}
