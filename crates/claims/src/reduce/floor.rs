//! The largest integer up to a real number: the integer m with `m <= x < m + 1`.

use super::super::premise::Statements;
use super::build::{call, integer, plain, sum, symbol};
use super::series::guess_at;
use super::{Goal, Rule, factorial, fresh, has_operation, rewritten, trees};
use std::collections::BTreeSet;
use texmath::{
    Condition, Equation, Meaning, Name, Relation, Symbols, Tree, any, any_side, is_constant, mapped, names_in,
};

const FLOOR: &str = "\\floor";

/// The most integers of one claim.
const MOST: usize = 6;

pub(super) fn is_one(node: &Tree) -> bool {
    matches!(node, Tree::Call(name, ..) if name.base == FLOOR)
}

fn stands_in(tree: &Tree) -> bool {
    any(tree, &mut |node| is_one(node))
}

/// Returns the statements with an integer of its own in the place of each value of the floor, the symbols with these, and lemmas; None
/// where there is none.
///
/// # Errors
/// Why a value may be more than one number.
pub(super) fn as_integers(
    statements: &Statements,
    symbols: &Symbols,
) -> Result<Option<(Statements, Symbols, Vec<Goal>)>, String> {
    if !trees(statements).into_iter().any(stands_in) {
        return Ok(None);
    }
    refuse_elsewhere(statements, symbols)?;
    let mut symbols = symbols.clone();
    let (mut out, mut lemmas) = (statements.clone(), Vec::new());
    for _ in 0..MOST {
        out = rewritten(&out, Rule::FloorInteger, &|tree| without_integers(tree, &symbols));
        let Some(argument) = trees(&out).into_iter().find_map(innermost) else {
            return Ok(Some((out, symbols, lemmas)));
        };
        let value = match number(&argument) {
            Some(value) => {
                for claim in bounds(&integer(value), &argument) {
                    let mut alone = out.clone().by(Rule::FloorInteger);
                    let part = format!("the floor: {claim}");
                    alone
                        .assume
                        .retain(|condition| !condition.sides().into_iter().any(stands_in));
                    alone.claims = vec![claim];
                    lemmas.push(Goal::of(&alone, &symbols, part));
                }
                integer(value)
            }
            None => {
                let name = own_integer(&out, &mut symbols, &argument)?;
                let between = bounds(&symbol(&name), &argument);
                out.assume.extend(between.map(Condition::Relation));
                symbol(&name)
            }
        };
        let floor = call(FLOOR, argument);
        out = rewritten(&out, Rule::FloorInteger, &|tree| {
            mapped(tree, &|node| (*node == floor).then(|| value.clone()))
        });
    }
    Err("so many values of the floor".to_owned())
}

/// Refuses the floor in premises, which may hold at more than one time, and where a letter is bound.
fn refuse_elsewhere(statements: &Statements, symbols: &Symbols) -> Result<(), String> {
    let mut premises = statements.premises.iter().map(|premise| &premise.equation);
    if premises.any(|equation| any_side(equation, &mut |node| is_one(node))) {
        return Err("the floor in a premise".to_owned());
    }
    let binds = |node: &Tree| match node {
        Tree::Operation(operation, _) => operation.letter().is_some() && stands_in(node),
        _ => false,
    };
    if trees(statements)
        .into_iter()
        .any(|tree| any(tree, &mut |node| binds(node)))
    {
        return Err("the floor where a letter is bound".to_owned());
    }
    match trees(statements).into_iter().any(|tree| symbols.may_be_complex(tree)) {
        true => Err("the floor of complex numbers".to_owned()),
        false => Ok(()),
    }
}

/// Declares an integer for a value of the floor: there is one of it.
fn own_integer(statements: &Statements, symbols: &mut Symbols, argument: &Tree) -> Result<Name, String> {
    let mut names = BTreeSet::new();
    names_in(argument, &mut names);
    let is_one_number =
        |name: &Name| (symbols.is_parameter(name) || is_constant(name)) && symbols.running() != Some(name);
    let calls_function = any(
        argument,
        &mut |node| matches!(node, Tree::Call(name, ..) if symbols.is_function(name)),
    );
    if !names.iter().all(is_one_number) || calls_function || has_operation(argument, symbols) {
        return Err(format!("the floor of `{argument}`"));
    }
    let name = fresh(statements, symbols, "m");
    symbols.let_be_parameter(&name, false);
    symbols.declare(name.clone(), Meaning::Integer);
    Ok(name)
}

/// The conditions under which an integer is the floor of a number.
fn bounds(value: &Tree, of: &Tree) -> [Equation; 2] {
    let next = sum(vec![value.clone(), integer(1)]);
    [
        (value.clone(), Relation::LessOrEqual, of.clone()),
        (of.clone(), Relation::Less, next),
    ]
    .map(|(left, relation, right)| Equation {
        relation,
        ..Equation::between(left, right)
    })
}

/// Returns the tree with integers that are added within the floor outside of it.
fn without_integers(tree: &Tree, symbols: &Symbols) -> Tree {
    mapped(tree, &|node| {
        let Tree::Call(_, argument, _) = node else {
            return None;
        };
        if !is_one(node) {
            return None;
        }
        let argument = without_integers(argument, symbols);
        let terms = match &argument {
            Tree::Sum(terms) => terms.clone(),
            term => vec![term.clone()],
        };
        let (mut whole, rest): (Vec<Tree>, Vec<Tree>) =
            terms.into_iter().partition(|term| factorial::is_integer(term, symbols));
        if !rest.is_empty() {
            whole.push(call(FLOOR, sum(rest)));
        }
        Some(sum(whole))
    })
}

/// Finds the argument of a floor that holds none.
fn innermost(tree: &Tree) -> Option<Tree> {
    let mut found = None;
    any(tree, &mut |node| {
        if let Tree::Call(_, argument, _) = node
            && is_one(node)
            && !stands_in(argument)
        {
            found = Some((**argument).clone());
        }
        found.is_some()
    });
    found
}

/// Guesses the floor of a tree without letters.
fn number(argument: &Tree) -> Option<i64> {
    let pi_or_euler = |name: &Name| *name == plain("\\pi") || *name == plain("e");
    let is_known = !any(
        argument,
        &mut |node| matches!(node, Tree::Symbol(name, _) if !pi_or_euler(name)),
    );
    let value = guess_at(argument, &|_| None).filter(|value| is_known && value.abs() < 1e9)?;
    Some((value + 1e-9).floor() as i64)
}
