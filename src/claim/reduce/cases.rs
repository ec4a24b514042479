//! Values by cases: one goal for each choice of cases, under the conditions of these.

use super::super::premise::Statements;
use super::super::substitute::{any, mapped, runs};
use super::super::vocabulary::{Vocabulary, index_of};
use super::build::{integer, negative};
use super::{holds, rewritten, trees};
use crate::tex::{Case, Condition, Equation, Name, Operation, Relation, Tree};

/// The most choices of cases.
const MOST: usize = 64;

/// The sign of a number, which is 0 at 0, by cases.
pub(super) fn signs(tree: &Tree) -> Tree {
    mapped(tree, &|node| {
        let Tree::Call(_, argument, at) = node else {
            return None;
        };
        if !is_sign(node) {
            return None;
        }
        let argument = signs(argument);
        let case = |relation, value| Case {
            value: integer(value),
            conditions: vec![Condition::Relation(Equation {
                relation,
                ..Equation::between(argument.clone(), integer(0))
            })],
        };
        let cases = [(Relation::Greater, 1), (Relation::Less, -1), (Relation::Equal, 0)];
        let cases = cases.map(|(relation, value)| case(relation, value)).to_vec();
        Some(Tree::Operation(Box::new(Operation::Cases(cases)), *at))
    })
}

/// Absolute values of real numbers by cases.
pub(super) fn absolute_values(tree: &Tree) -> Tree {
    mapped(tree, &|node| {
        let Tree::Call(_, argument, at) = node else {
            return None;
        };
        if !is_absolute(node) {
            return None;
        }
        let argument = absolute_values(argument);
        let case = |relation, value| Case {
            value,
            conditions: vec![Condition::Relation(Equation {
                relation,
                ..Equation::between(argument.clone(), integer(0))
            })],
        };
        let negative = negative(argument.clone());
        let cases = vec![
            case(Relation::GreaterOrEqual, argument.clone()),
            case(Relation::Less, negative),
        ];
        Some(Tree::Operation(Box::new(Operation::Cases(cases)), *at))
    })
}

/// `|a| <= b` as `a <= b` and `-a <= b`; any other claim as it is.
pub(super) fn between_bounds(claim: &Equation) -> Vec<Equation> {
    let (inner, bound, relation) = match (&claim.left, claim.relation, &claim.right) {
        (Tree::Call(_, inner, _), Relation::Less | Relation::LessOrEqual, bound) if is_absolute(&claim.left) => {
            (inner, bound, claim.relation)
        }
        (bound, Relation::Greater | Relation::GreaterOrEqual, Tree::Call(_, inner, _)) if is_absolute(&claim.right) => {
            (inner, bound, claim.relation.turned())
        }
        _ => return vec![claim.clone()],
    };
    let sides = [(**inner).clone(), negative((**inner).clone())];
    let own = |left: Tree| Equation {
        left,
        relation,
        right: bound.clone(),
        ..claim.clone()
    };
    sides.map(own).to_vec()
}

/// Whether a node is the absolute value of something.
pub(super) fn is_absolute(node: &Tree) -> bool {
    matches!(node, Tree::Call(name, ..) if name.base == r"\abs")
}

/// Whether a node is the sign of something.
pub(super) fn is_sign(node: &Tree) -> bool {
    matches!(node, Tree::Call(name, ..) if name.base == r"\sgn")
}

/// The statements for each choice of cases, with what is chosen.
pub(super) fn split(statements: &Statements, vocabulary: &Vocabulary) -> Result<Vec<(String, Statements)>, String> {
    if trees(statements).into_iter().any(is_bound_within) {
        return Err("cases of a letter that a sum, an integral or a derivative binds".to_owned());
    }
    let mut all = vec![(Vec::<String>::new(), statements.clone())];
    while let Some(cases) = all.iter().find_map(|(_, statements)| first(statements)) {
        let is_cases = |operation: &Operation| matches!(operation, Operation::Cases(_));
        let moves = statements
            .claims
            .iter()
            .any(|claim| runs(claim, vocabulary) && holds(claim, &is_cases));
        let in_law = statements
            .premises
            .iter()
            .any(|premise| holds(&premise.equation, &is_cases) && vocabulary.is_law(&premise.equation));
        if moves || in_law {
            return Err("cases of what runs are not read: write each as an equation with its condition".to_owned());
        }
        let conditions = conditions(&cases)?;
        let mut more = Vec::new();
        for (chosen, statements) in all {
            if first(&statements).as_ref() != Some(&cases) {
                more.push((chosen, statements));
                continue;
            }
            for (case, conditions) in cases.iter().zip(&conditions) {
                let mut own = rewritten(&statements, &|tree| replaced(tree, &cases, &case.value));
                own.assume.extend(conditions.iter().cloned());
                let shown: Vec<String> = conditions.iter().map(shown).collect();
                let chosen = chosen.iter().cloned().chain([shown.join(", ")]).collect();
                more.push((chosen, own));
            }
        }
        if more.len() > MOST {
            return Err(format!("more than {MOST} choices of cases"));
        }
        all = more;
    }
    let said = |chosen: Vec<String>| match chosen.is_empty() {
        true => String::new(),
        false => format!("the case {}", chosen.join(", ")),
    };
    Ok(all.into_iter().map(|(chosen, own)| (said(chosen), own)).collect())
}

/// Whether an operation binds a letter of which cases within it speak.
fn is_bound_within(tree: &Tree) -> bool {
    any(tree, &mut |node| {
        let Tree::Operation(operation, _) = node else {
            return false;
        };
        let Some(letter) = operation.letter() else {
            return false;
        };
        let is_of_letter = |node: &Tree| {
            let is_cases = matches!(node, Tree::Operation(inner, _) if matches!(**inner, Operation::Cases(_)));
            let numbered = |name: &Name| index_of(&name.subscript, &letter.to_string()).is_some();
            is_cases
                && any(
                    node,
                    &mut |inner| matches!(inner, Tree::Symbol(name, _) if name == letter || numbered(name)),
                )
        };
        let mut inside = operation.parts().into_iter().filter(|(_, is_bound)| *is_bound);
        inside.any(|(part, _)| any(part, &mut |node| is_of_letter(node)))
    })
}

/// The first value by cases that holds none itself.
fn first(statements: &Statements) -> Option<Vec<Case>> {
    let mut found = None;
    for tree in trees(statements) {
        any(tree, &mut |node| {
            if let Tree::Operation(operation, _) = node
                && let Operation::Cases(cases) = &**operation
            {
                found = Some(cases.clone());
            }
            false
        });
    }
    found
}

fn replaced(tree: &Tree, cases: &[Case], by: &Tree) -> Tree {
    mapped(tree, &|node| match node {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Cases(own) if own == cases => Some(by.clone()),
            _ => None,
        },
        _ => None,
    })
}

/// What is assumed in each case.
fn conditions(cases: &[Case]) -> Result<Vec<Vec<Condition>>, String> {
    let mut all = Vec::new();
    for (place, case) in cases.iter().enumerate() {
        if !case.conditions.is_empty() {
            all.push(case.conditions.clone());
            continue;
        }
        let before = cases.iter().take(place).flat_map(|case| &case.conditions);
        all.push(before.map(negated).collect::<Result<_, _>>()?);
    }
    Ok(all)
}

fn negated(condition: &Condition) -> Result<Condition, String> {
    match condition {
        Condition::Integer(_) => {
            Err("write the condition of the last case: it is not said what is no integer".to_owned())
        }
        Condition::Relation(relation) => {
            let mut other = relation.clone();
            other.relation = match relation.relation {
                Relation::Equal => Relation::NotEqual,
                Relation::NotEqual => Relation::Equal,
                Relation::Less => Relation::GreaterOrEqual,
                Relation::LessOrEqual => Relation::Greater,
                Relation::Greater => Relation::LessOrEqual,
                Relation::GreaterOrEqual => Relation::Less,
            };
            Ok(Condition::Relation(other))
        }
    }
}

fn shown(condition: &Condition) -> String {
    match condition {
        Condition::Relation(relation) => relation.to_string(),
        Condition::Integer(tree) => format!("{tree} \\in \\mathbb{{Z}}"),
    }
}
