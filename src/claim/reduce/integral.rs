//! Integrals: indefinite ones by differentiation, definite ones by an antiderivative whose own claims are lemmas.

use super::super::premise::Statements;
use super::super::substitute::{any, mapped, rewrite};
use super::super::vocabulary::Vocabulary;
use super::antiderivative::antiderivative;
use super::build::{difference, integer, plain, product, sum, symbol};
use super::derivative::By;
use super::evaluate::evaluated;
use super::{Goal, Reduced, defined, fresh, holds};
use crate::tex::{Condition, Equation, Name, Operation, Relation, Tree};

/// The constant of integration, where nothing else has its name.
const CONSTANT: &str = "C";

/// Whether an undeclared name is the constant of integration.
pub fn is_constant_of_integration(name: &Name) -> bool {
    *name == plain(CONSTANT)
}

/// Whether a claim holds an integral without limits.
pub(super) fn is_indefinite(statements: &Statements) -> bool {
    statements.claims.iter().any(holds_indefinite)
}

/// Whether an equation holds an integral without limits.
pub fn holds_indefinite(equation: &Equation) -> bool {
    holds(equation, &|operation| {
        matches!(operation, Operation::Integral { limits: None, .. })
    })
}

/// The claims about indefinite integrals with both sides differentiated: these are equal up to a constant on each
/// interval exactly where the derivatives are equal.
pub(super) fn differentiated(statements: &Statements, vocabulary: &Vocabulary) -> Result<Statements, String> {
    let mut out = statements.clone();
    out.claims.clear();
    for claim in &statements.claims {
        if !holds_indefinite(claim) {
            out.claims.push(claim.clone());
            continue;
        }
        if claim.relation != Relation::Equal {
            return Err("an antiderivative in an inequality".to_owned());
        }
        let mut by: Option<Name> = None;
        let mut slopes = Vec::new();
        for side in [&claim.left, &claim.right] {
            let mut own = Vec::new();
            terms(side, false, &mut own);
            slopes.push(own);
        }
        for (_, term) in slopes.iter().flatten() {
            if let Some((_, name)) = integrand(term) {
                if by.as_ref().is_some_and(|by| by != name) {
                    return Err("integrals by different letters".to_owned());
                }
                by = Some(name.clone());
            }
        }
        let by = by.ok_or("an integral within a product or a function")?;
        let pins = |condition: &Condition| {
            let is_equation =
                matches!(condition, Condition::Relation(relation) if relation.relation == Relation::Equal);
            is_equation && condition.sides().into_iter().any(|side| super::is_free_in(side, &by))
        };
        if super::is_spoken_of(statements, vocabulary, &by) || statements.assume.iter().any(pins) {
            return Err(format!("premises speak of `{by}`, which the integral is by"));
        }
        super::is_continuous(statements, vocabulary, &by)?;
        let constant = plain(CONSTANT);
        let is_free = !vocabulary.knows(&constant);
        let mut sides = Vec::new();
        for own in slopes {
            let mut side = Vec::new();
            for (is_negative, term) in own {
                let slope = match integrand(&term) {
                    Some((of, _)) => of.clone(),
                    None if is_free && matches!(&term, Tree::Symbol(name, _) if *name == constant) => integer(0),
                    None if is_free && super::is_free_in(&term, &constant) => {
                        return Err(format!(
                            "the constant {CONSTANT} stands elsewhere than added: declare it"
                        ));
                    }
                    None => {
                        out.claims.push(Equation::between(term.clone(), term.clone()));
                        By { vocabulary, name: &by }.of(&term)?
                    }
                };
                side.push(if is_negative {
                    super::build::negative(slope)
                } else {
                    slope
                });
            }
            sides.push(sum(side));
        }
        let right = sides.pop().unwrap_or_else(|| integer(0));
        let left = sides.pop().unwrap_or_else(|| integer(0));
        out.claims.insert(
            0,
            Equation {
                left,
                right,
                ..claim.clone()
            },
        );
    }
    Ok(out)
}

/// The terms of a side with their signs.
fn terms(tree: &Tree, is_negative: bool, found: &mut Vec<(bool, Tree)>) {
    match tree {
        Tree::Sum(parts) => parts.iter().for_each(|part| terms(part, is_negative, found)),
        Tree::Negate(inner) => terms(inner, !is_negative, found),
        tree => found.push((is_negative, tree.clone())),
    }
}

fn integrand(tree: &Tree) -> Option<(&Tree, &Name)> {
    match tree {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Integral { of, by, limits: None } => Some((of, by)),
            _ => None,
        },
        _ => None,
    }
}

/// The claim with each definite integral replaced by the difference of an antiderivative, which holds where the lemmas
/// do; `None` where there is no such integral, or no antiderivative is found.
pub(super) fn by_antiderivatives(statements: &Statements, vocabulary: &Vocabulary) -> Result<Option<Reduced>, String> {
    let mut found: Vec<(Operation, Tree)> = Vec::new();
    let (mut lemmas, mut extended) = (Vec::new(), vocabulary.clone());
    for tree in super::trees(statements) {
        let mut integrals = Vec::new();
        any(tree, &mut |node| {
            if let Tree::Operation(operation, _) = node
                && matches!(**operation, Operation::Integral { limits: Some(_), .. })
            {
                integrals.push((**operation).clone());
            }
            false
        });
        for operation in integrals {
            if found.iter().any(|(known, _)| *known == operation) {
                continue;
            }
            let Operation::Integral {
                of,
                by,
                limits: Some((low, high)),
            } = &operation
            else {
                continue;
            };
            if super::has_operation(of, vocabulary)
                || super::trees(statements)
                    .into_iter()
                    .any(|tree| vocabulary.may_be_complex(tree))
            {
                return Ok(None);
            }
            if super::is_spoken_of(statements, vocabulary, by) {
                return Err(format!("premises speak of `{by}`, which the integral is by"));
            }
            let of = of.clone();
            let Some(whole) = antiderivative(&of, by, vocabulary) else {
                return Ok(None);
            };
            let letter = fresh(statements, &extended, &by.base);
            extended.let_be_parameter(&letter, false);
            lemmas.extend(on_the_interval(
                statements,
                &extended,
                [&of, &whole],
                by,
                &letter,
                [low, high],
            )?);
            let at = |limit: &Tree| rewrite(&whole, &|name| (name == by).then(|| limit.clone()));
            let value = difference(at(high), at(low));
            found.push((operation, value));
        }
    }
    if found.is_empty() {
        return Ok(None);
    }
    let without = super::rewritten(statements, &|tree| {
        mapped(tree, &|node| match node {
            Tree::Operation(operation, _) => {
                let known = found.iter().find(|(known, _)| *known == **operation);
                known.map(|(_, value)| value.clone())
            }
            _ => None,
        })
    });
    let goal = Goal::of(&evaluated(&without, vocabulary)?, vocabulary, String::new());
    Ok(Some(Reduced {
        lemmas,
        sufficient: vec![goal],
        necessary: Vec::new(),
        is_equivalent: true,
        reason: String::new(),
    }))
}

/// What an antiderivative must be: on the interval it has a value, and the derivative that is asked for, which has one too.
fn on_the_interval(
    statements: &Statements,
    vocabulary: &Vocabulary,
    [of, whole]: [&Tree; 2],
    by: &Name,
    letter: &Name,
    [low, high]: [&Tree; 2],
) -> Result<Vec<Goal>, String> {
    let at = |tree: &Tree| rewrite(tree, &|name| (name == by).then(|| symbol(letter)));
    let slope = By {
        vocabulary,
        name: letter,
    }
    .of(&at(whole))?;
    let between = product(vec![
        difference(symbol(letter), low.clone()),
        difference(symbol(letter), high.clone()),
    ]);
    let mut alone = statements.clone();
    alone.premises.retain(|premise| !holds(&premise.equation, &|_| true));
    alone.assume.push(Condition::Relation(Equation {
        relation: Relation::LessOrEqual,
        ..Equation::between(between, integer(0))
    }));
    let mut lemmas = Vec::new();
    let mut push = |claim: Equation| {
        let part = format!("the antiderivative: {claim}");
        alone.claims = vec![claim];
        lemmas.push(Goal::of(&alone, vocabulary, part));
    };
    let mut needed = defined::conditions(&at(of), vocabulary)?;
    needed.extend(defined::conditions(&at(whole), vocabulary)?);
    needed.extend(defined::conditions(&slope, vocabulary)?);
    let mut known: Vec<Equation> = Vec::new();
    for condition in needed {
        if !known.contains(&condition) {
            known.push(condition.clone());
            push(condition);
        }
    }
    push(Equation::between(slope, at(of)));
    Ok(lemmas)
}
