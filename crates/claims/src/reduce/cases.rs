//! Values by cases: one goal for each choice of cases, under the conditions of these.

use super::super::premise::Statements;
use super::build::{integer, negative};
use super::derivative::mentions;
use super::{Goal, Rule, rewritten, trees};
use texmath::{
    Case, Condition, Equation, Name, Operation, Relation, Symbols, Tree, any, holds, index_of, mapped, pair_of, runs,
    tree_runs,
};

/// The most choices of cases.
const MOST: usize = 64;

/// The most absolute values, each of two cases: with one more there are more choices than that.
pub(super) const MOST_BARS: usize = 6;

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

/// The statements with each `|a| <= b` that is claimed or assumed as `a <= b` and `-a <= b`.
pub(super) fn between_bounds(statements: &Statements) -> Statements {
    let conditions = |all: &[Condition]| -> Vec<Condition> {
        let both = |condition: &Condition| match condition {
            Condition::Relation(relation) => both(relation).into_iter().map(Condition::Relation).collect(),
            Condition::Integer(_) => vec![condition.clone()],
        };
        all.iter().flat_map(both).collect()
    };
    let mut between = statements.clone();
    between.claims = statements.claims.iter().flat_map(both).collect();
    between.assume = conditions(&statements.assume);
    for premise in &mut between.premises {
        premise.assume = conditions(&premise.assume);
    }
    match between.has_formulas_of(statements) {
        true => between,
        false => between.by(Rule::ModulusBounds),
    }
}

/// `|a| <= b` as `a <= b` and `-a <= b`; any other relation as it is.
fn both(relation: &Equation) -> Vec<Equation> {
    let (inner, bound, kind) = match (&relation.left, relation.relation, &relation.right) {
        (Tree::Call(_, inner, _), Relation::Less | Relation::LessOrEqual, bound) if is_absolute(&relation.left) => {
            (inner, bound, relation.relation)
        }
        (bound, Relation::Greater | Relation::GreaterOrEqual, Tree::Call(_, inner, _))
            if is_absolute(&relation.right) =>
        {
            (inner, bound, relation.relation.turned())
        }
        _ => return vec![relation.clone()],
    };
    let sides = [(**inner).clone(), negative((**inner).clone())];
    let own = |left: Tree| Equation {
        left,
        relation: kind,
        right: bound.clone(),
        ..relation.clone()
    };
    sides.map(own).to_vec()
}

/// How many absolute values there are, each counted once.
pub(super) fn bars(statements: &Statements) -> usize {
    let mut found: Vec<Tree> = Vec::new();
    for tree in trees(statements) {
        any(tree, &mut |node| {
            if is_absolute(node) && !found.contains(node) {
                found.push(node.clone());
            }
            false
        });
    }
    found.len()
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
pub(super) struct Split {
    pub choices: Vec<(String, Statements)>,
    /// That no case ends where the statements hold, where derivatives are taken of it.
    pub lemmas: Vec<Goal>,
}

/// Splits the statements by the cases in them.
///
/// # Errors
/// Why the statements do not hold where all of them hold in each case: something is said at more than one point of what
/// the cases speak of, or there are too many choices.
pub(super) fn split(statements: &Statements, symbols: &Symbols) -> Result<Split, String> {
    if trees(statements).into_iter().any(is_bound_within) {
        return Err("cases of a letter that a sum, an integral or a derivative binds".to_owned());
    }
    let too_many = || format!("more than {MOST} choices of cases");
    // each of them splits what there is at least in two
    let is_by_cases =
        |node: &Tree| matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Cases(_)));
    let mut found: Vec<Tree> = Vec::new();
    for tree in trees(statements) {
        any(tree, &mut |node| {
            if is_by_cases(node) && !found.contains(node) {
                found.push(node.clone());
            }
            found.len() > MOST
        });
    }
    if found.len() > MOST {
        return Err(too_many());
    }
    let mut all = vec![(Vec::<String>::new(), statements.clone())];
    let mut lemmas = Vec::new();
    while let Some(cases) = all.iter().find_map(|(_, statements)| first(statements)) {
        if cases.len() > MOST {
            return Err(too_many());
        }
        at_one_point(statements, symbols, &cases)?;
        let conditions = conditions(&cases)?;
        if is_differentiated(statements, symbols) {
            lemmas.extend(ends(statements, symbols, &cases, &conditions)?);
        }
        let mut more = Vec::new();
        for (chosen, statements) in all {
            if first(&statements).as_ref() != Some(&cases) {
                more.push((chosen, statements));
                continue;
            }
            for (case, conditions) in cases.iter().zip(&conditions) {
                let mut own = rewritten(&statements, Rule::CasesSplit, &|tree| {
                    replaced(tree, &cases, &case.value)
                });
                own.assume.extend(conditions.iter().cloned());
                let shown: Vec<String> = conditions.iter().map(shown).collect();
                let chosen = chosen.iter().cloned().chain([shown.join(", ")]).collect();
                more.push((chosen, own));
            }
        }
        if more.len() > MOST {
            return Err(too_many());
        }
        all = more;
    }
    let said = |chosen: Vec<String>| match chosen.is_empty() {
        true => String::new(),
        false => format!("the case {}", chosen.join(", ")),
    };
    Ok(Split {
        choices: all.into_iter().map(|(chosen, own)| (said(chosen), own)).collect(),
        lemmas,
    })
}

/// That all of what is said by cases, or beside it, is said at one point of what these cases speak of.
fn at_one_point(statements: &Statements, symbols: &Symbols, cases: &[Case]) -> Result<(), String> {
    let is_cases = |operation: &Operation| matches!(operation, Operation::Cases(_));
    let in_equation = |equation: &Equation| holds(equation, &is_cases);
    let in_condition = |condition: &Condition| condition.sides().into_iter().any(stands_in);
    let is_law = |condition: &Condition| match condition {
        Condition::Relation(relation) => symbols.is_law(relation),
        Condition::Integer(tree) => tree_runs(tree, symbols),
    };
    let runs_in_claim = statements.claims.iter().any(|claim| runs(claim, symbols))
        && (statements.claims.iter().any(in_equation)
            || statements.assume.iter().any(|own| is_law(own) && in_condition(own)));
    let in_law = statements.premises.iter().any(|premise| {
        let is_law = symbols.is_law(&premise.equation) || premise.assume.iter().any(is_law);
        is_law && (in_equation(&premise.equation) || premise.assume.iter().any(in_condition))
    });
    if runs_in_claim || in_law {
        return Err("cases of what runs are not read: write each as an equation with its condition".to_owned());
    }
    let speaks = |name: &Name| {
        let conditions = cases
            .iter()
            .flat_map(|case| &case.conditions)
            .flat_map(Condition::sides);
        let values = cases.iter().map(|case| &case.value);
        conditions.chain(values).any(|tree| mentions(tree, name))
    };
    match solved_for(statements).iter().find(|name| speaks(name)) {
        Some(name) => Err(format!("cases of `{name}`, of which the claim says all values")),
        None => Ok(()),
    }
}

/// Whether derivatives of what premises give are written, so that premises are used beside the point too.
fn is_differentiated(statements: &Statements, symbols: &Symbols) -> bool {
    let has_partial = |tree: &Tree| any(tree, &mut |node| matches!(node, Tree::Partial { .. }));
    trees(statements).into_iter().any(has_partial) || statements.clone().with_overview(symbols).speaks_of_maps
}

/// That the conditions of cases in premises hold around each point at which all else does: none of their ends is met.
fn ends(
    statements: &Statements,
    symbols: &Symbols,
    cases: &[Case],
    conditions: &[Vec<Condition>],
) -> Result<Vec<Goal>, String> {
    let is_cases = |operation: &Operation| matches!(operation, Operation::Cases(own) if own == cases);
    if !statements
        .premises
        .iter()
        .any(|premise| holds(&premise.equation, &is_cases))
    {
        return Ok(Vec::new());
    }
    let mut rest = statements.clone().by(Rule::CasesSplit);
    rest.premises
        .retain(|premise| !holds(&premise.equation, &|operation| matches!(operation, Operation::Cases(_))));
    rest.assume
        .retain(|condition| !condition.sides().into_iter().any(stands_in));
    let mut goals: Vec<Goal> = Vec::new();
    for condition in conditions.iter().flatten() {
        let Condition::Relation(relation) = condition else {
            return Err("the derivative of what is said of integers".to_owned());
        };
        let end = Equation {
            relation: Relation::NotEqual,
            ..relation.clone()
        };
        if stands_in(&end.left) || stands_in(&end.right) {
            return Err("the derivative of cases within the conditions of cases".to_owned());
        }
        if !goals.iter().any(|goal| goal.statements.claims.contains(&end)) {
            let part = format!("a derivative beside the end {end} of a case");
            rest.claims = vec![end];
            goals.push(Goal::of(&rest, symbols, part));
        }
    }
    Ok(goals)
}

/// Whether there are values by cases in a tree.
pub(super) fn stands_in(tree: &Tree) -> bool {
    any(
        tree,
        &mut |node| matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Cases(_))),
    )
}

/// The symbols of which claims state all values, as `x_{1,2} = a \pm b` does of x.
pub(super) fn solved_for(statements: &Statements) -> Vec<Name> {
    let claims = statements.claims.iter();
    let single = |claim: &Equation| match &claim.left {
        Tree::Symbol(name, _) => pair_of(name),
        _ => None,
    };
    claims.filter_map(single).collect()
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
