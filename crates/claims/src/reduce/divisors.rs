//! What authors divide premises by when they solve them.

use super::Goal;
use super::build::{difference, is_zero, symbol};
use super::derivative::By;
use texmath::{Equation, Name, Relation, Symbols, Tree, any, any_side, number_of, with_part};

/// The most letters and values of functions by which premises are differentiated.
const MOST: usize = 20;

/// Returns what the premises of a goal are divided by when they are solved for a letter or a value of a function in its claim,
/// each with the label of the premise: the derivatives of left minus right by it, unless a premise gives it without a
/// division. A product that is 0 is not divided: either factor may be 0.
pub fn divisors(goal: &Goal) -> Vec<(String, Tree)> {
    let Goal {
        statements, symbols, ..
    } = goal;
    let mut letters: Vec<Tree> = Vec::new();
    for claim in &statements.claims {
        any_side(claim, &mut |node| {
            let is_letter = match node {
                Tree::Symbol(name, _) => symbols.running() != Some(name),
                Tree::Call(name, ..) => symbols.is_function(name) || symbols.is_in_flight(name),
                _ => false,
            };
            if is_letter && letters.len() < MOST && !letters.contains(node) {
                letters.push(node.clone());
            }
            false
        });
    }
    let name = Name {
        base: r"\slope".to_owned(),
        ..Name::default()
    };
    let premises = statements.premises.iter();
    let premises: Vec<_> = premises.filter(|premise| is_divided(&premise.equation)).collect();
    let mut found: Vec<(String, Tree)> = Vec::new();
    for letter in &letters {
        let slopes = premises.iter().filter_map(|premise| {
            let whole = difference(premise.equation.left.clone(), premise.equation.right.clone());
            let of = with_part(&whole, letter, &symbol(&name));
            let slope = By { symbols, name: &name }.of(&of).ok()?;
            let slope = with_part(&slope, &symbol(&name), letter);
            (!is_zero(&slope)).then(|| (premise.label.clone(), slope))
        });
        let slopes: Vec<(String, Tree)> = slopes.collect();
        if slopes.iter().all(|(_, slope)| number_of(slope).is_none()) {
            // no divisor: what contains the letter, what is 0 at some times of a law, derivatives of unknown functions
            let is_divisor = |slope: &Tree| {
                !runs(slope, symbols)
                    && !has_derivative(slope, letter, symbols)
                    && !any(slope, &mut |part| part == letter)
            };
            found.extend(slopes.into_iter().filter(|(_, slope)| is_divisor(slope)));
        }
    }
    found.dedup_by(|(_, slope), (_, before)| slope == before);
    found
}

/// Returns true for an equation that is no product that is 0.
fn is_divided(equation: &Equation) -> bool {
    let (left, right) = (&equation.left, &equation.right);
    let is_product = |side: &Tree| {
        side.find_below(&mut |_| Some(())).is_some() && !any(side, &mut |node| matches!(node, Tree::Sum(_)))
    };
    equation.relation == Relation::Equal
        && !(is_zero(right) && is_product(left))
        && !(is_zero(left) && is_product(right))
}

/// Returns true if the running time stands in a tree otherwise than as the argument of an unknown function.
fn runs(tree: &Tree, symbols: &Symbols) -> bool {
    match tree {
        Tree::Symbol(name, _) => symbols.running() == Some(name),
        Tree::Call(name, ..) if symbols.is_function(name) || symbols.is_in_flight(name) => false,
        tree => tree.find_below(&mut |part| runs(part, symbols).then_some(())).is_some(),
    }
}

/// Returns true if an unknown function is taken at a letter by which a slope is.
fn has_derivative(slope: &Tree, letter: &Tree, symbols: &Symbols) -> bool {
    any(slope, &mut |node| match node {
        Tree::Call(name, argument, _) => {
            (symbols.is_function(name) || symbols.is_in_flight(name))
                && node != letter
                && any(argument, &mut |part| part == letter)
        }
        _ => false,
    })
}
