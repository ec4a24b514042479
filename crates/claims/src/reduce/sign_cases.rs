//! A claim by the sign of a term: where it is positive, negative and 0. It holds where it holds in each of these cases.

use super::super::premise::Statements;
use super::build::{difference, integer, negative, sum};
use super::cases::is_absolute;
use super::{Goal, Rule, defined, is_spoken_of, rewritten, trees};
use numbers::Rational;
use std::collections::BTreeSet;
use texmath::{Condition, Equation, Name, Relation, Symbols, Tree, any, mapped, names_in, number_of, rewrite};

/// Functions that have a value at each real number.
const TOTAL: [&str; 6] = ["\\sin", "\\cos", "\\exp", "\\arctan", "\\sinh", "\\cosh"];

/// Returns conditions of which one holds for all values of the letters, such that a condition that is not shown is decided by
/// each; none where its letters are not those of the statements, or nothing in it has a value everywhere.
pub fn sign_cases(open: &Equation, statements: &Statements, symbols: &Symbols) -> Vec<Equation> {
    let whole = match number_of(&open.right).is_some_and(|value| value.0.is_zero()) {
        true => open.left.clone(),
        false => difference(open.left.clone(), open.right.clone()),
    };
    let Some(on) = term(&whole) else {
        return Vec::new();
    };
    let mut names = BTreeSet::new();
    names_in(&on, &mut names);
    let all = trees(statements);
    let is_met = |name: &Name| texmath::is_constant(name) || all.iter().any(|tree| tree.has_free(name));
    let is_real = !all.iter().any(|tree| symbols.may_be_complex(tree));
    let is_letter = |name: &Name| symbols.is_parameter(name) || symbols.is_integer(name) || texmath::is_constant(name);
    if !is_real || names.is_empty() || !names.iter().all(|name| is_met(name) && is_letter(name)) {
        return Vec::new();
    }
    let to_zero = |relation: Relation| Equation {
        relation,
        ..Equation::between(on.clone(), integer(0))
    };
    match open.relation {
        Relation::NotEqual => [Relation::NotEqual, Relation::Equal].map(to_zero).into(),
        Relation::Equal => Vec::new(),
        _ => [Relation::Greater, Relation::Less, Relation::Equal].map(to_zero).into(),
    }
}

/// Returns the letter that a case gives a number, and the number.
pub fn number_in(case: &Equation, symbols: &Symbols) -> Option<(Name, Rational)> {
    let (letter, value) = solved(&case.left, symbols).filter(|_| case.relation == Relation::Equal)?;
    Some((letter, number_of(&value)?))
}

/// Returns a goal that contradicts what is given where the statements hold nowhere, or the claims have no value.
pub fn of_nothing(statements: &Statements, symbols: &Symbols) -> Goal {
    let mut own = defined::with_domain(statements, symbols);
    own.claims = vec![Equation::between(integer(0), integer(0))];
    let mut goal = Goal::of(&own, symbols, String::new());
    goal.rest_on_numbers();
    goal
}

/// A term that has a value everywhere and on whose sign that of a tree depends.
fn term(tree: &Tree) -> Option<Tree> {
    match tree {
        tree if number_of(tree).is_some() => None,
        Tree::Quotient(above, below, _) => term(below).or_else(|| term(above)),
        Tree::Product(factors) => factors.iter().find_map(term),
        Tree::Negate(inner) | Tree::Power(inner, ..) | Tree::Root(inner, ..) | Tree::RealPower(inner, ..) => {
            term(inner)
        }
        Tree::Sum(terms) => match terms.as_slice() {
            // the difference of two squares
            [Tree::Power(one, 2, _), Tree::Negate(other)] | [Tree::Negate(other), Tree::Power(one, 2, _)] => {
                match &**other {
                    Tree::Power(other, 2, _) if is_total(one) && is_total(other) => {
                        Some(difference((**one).clone(), (**other).clone()))
                    }
                    _ => is_total(tree).then(|| tree.clone()),
                }
            }
            _ => is_total(tree).then(|| tree.clone()),
        },
        Tree::Symbol(..) => Some(tree.clone()),
        _ => None,
    }
}

fn is_total(tree: &Tree) -> bool {
    !any(tree, &mut |node| match node {
        Tree::Number(_) | Tree::Symbol(..) | Tree::Sum(_) | Tree::Product(_) | Tree::Negate(_) => false,
        Tree::Power(_, exponent, _) => *exponent < 0,
        Tree::Call(name, ..) => !TOTAL.contains(&name.base.as_str()),
        _ => true,
    })
}

/// The letter that is plus or minus one term of what is 0, and what it is equal to.
fn solved(vanishing: &Tree, symbols: &Symbols) -> Option<(Name, Tree)> {
    let terms = match vanishing {
        Tree::Sum(terms) => terms.clone(),
        tree => vec![tree.clone()],
    };
    (0..terms.len()).rev().find_map(|place| {
        let mut rest = terms.clone();
        let own = rest.remove(place);
        let (name, rest) = match own {
            Tree::Symbol(name, _) => (name, negative(sum(rest))),
            Tree::Negate(inner) => match *inner {
                Tree::Symbol(name, _) => (name, sum(rest)),
                _ => return None,
            },
            _ => return None,
        };
        let is_letter = symbols.is_parameter(&name) || symbols.is_integer(&name);
        (is_letter && !rest.has_free(&name)).then_some((name, rest))
    })
}

/// The conditions on the value of a letter that are declared of the letter.
fn declared(letter: &Name, value: &Tree, symbols: &Symbols) -> Vec<Condition> {
    let relation = |relation: Relation, bound: i64| {
        Condition::Relation(Equation {
            relation,
            ..Equation::between(value.clone(), integer(bound))
        })
    };
    let all = [
        (symbols.is_positive(letter), relation(Relation::Greater, 0)),
        (symbols.is_nonnegative(letter), relation(Relation::GreaterOrEqual, 0)),
        (symbols.is_nonzero(letter), relation(Relation::NotEqual, 0)),
        (symbols.is_at_most_one(letter), relation(Relation::LessOrEqual, 1)),
        (symbols.is_at_most_one(letter), relation(Relation::Greater, 0)),
        (symbols.is_integer(letter), Condition::Integer(value.clone())),
    ];
    all.into_iter()
        .filter(|(is_declared, _)| *is_declared)
        .map(|(_, condition)| condition)
        .collect()
}

impl Statements {
    /// The statements in one case; a letter that has a value there has it in all of them.
    pub fn in_case(&self, case: &Equation, symbols: &Symbols) -> Self {
        let mut own = self.clone().by(Rule::CasesSplit);
        let has_locals = !own.locals.is_empty() || own.premises.iter().any(|premise| !premise.locals.is_empty());
        if case.relation == Relation::Equal
            && !has_locals
            && let Some((letter, value)) = solved(&case.left, symbols)
            && !is_spoken_of(&own, symbols, &letter)
            && !self.binds_any_of(&value)
        {
            own = rewritten(&own, Rule::CasesSplit, &|tree| {
                rewrite(tree, &|name| (*name == letter).then(|| value.clone()))
            });
            own.assume.extend(declared(&letter, &value, symbols));
            return own;
        }
        let modulus = match case.relation {
            Relation::Greater => Some(case.left.clone()),
            Relation::Less => Some(negative(case.left.clone())),
            _ => None,
        };
        if let Some(modulus) = modulus {
            own = rewritten(&own, Rule::ModulusCases, &|tree| {
                mapped(tree, &|node| match node {
                    Tree::Call(_, inner, _) if is_absolute(node) && **inner == case.left => Some(modulus.clone()),
                    _ => None,
                })
            });
        }
        own.assume.push(Condition::Relation(case.clone()));
        own
    }

    /// Returns true if an operation binds a letter of a tree.
    fn binds_any_of(&self, tree: &Tree) -> bool {
        let mut names = BTreeSet::new();
        names_in(tree, &mut names);
        let is_one = |node: &Tree| match node {
            Tree::Operation(operation, _) => operation.letter().is_some_and(|letter| names.contains(letter)),
            _ => false,
        };
        trees(self).into_iter().any(|tree| any(tree, &mut |node| is_one(node)))
    }
}
