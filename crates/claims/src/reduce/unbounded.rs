//! Claims with an infinite side: `= \infty` of what grows without bound, and `< \infty` of what has a value.

use super::super::premise::Statements;
use super::build::{infinity, integer, negative, quotient, sum};
use super::{Rule, rewritten};
use texmath::{At, Equation, Operation, Relation, Tree, any, mapped};

/// Returns a claim that holds nowhere.
pub(super) fn falsehood() -> Equation {
    Equation::between(integer(0), integer(1))
}

/// Returns the claim that a tree has a value.
pub(super) fn has_value(tree: Tree) -> Equation {
    Equation::between(tree.clone(), tree)
}

/// Returns infinity above or below all numbers.
pub(super) fn infinite(is_above: bool) -> Tree {
    let above = Tree::Operation(Box::new(Operation::Infinity), At::default());
    if is_above { above } else { negative(above) }
}

/// Returns what has no value, as a quotient that has none.
pub(super) fn without_value() -> Tree {
    quotient(integer(1), integer(0))
}

/// Returns what is no number as without a value.
pub(super) fn number(tree: Tree) -> Tree {
    match infinity(&tree) {
        Some(_) => without_value(),
        None => tree,
    }
}

/// Adds terms of which some are infinite: infinite where these have one sign, and without a value where they have both.
pub(super) fn total(terms: Vec<Tree>) -> Tree {
    let signs: Vec<bool> = terms.iter().filter_map(infinity).collect();
    match (signs.contains(&true), signs.contains(&false)) {
        (false, false) => sum(terms),
        (true, true) => without_value(),
        (is_above, _) => infinite(is_above),
    }
}

/// Returns true if a limit, a definite integral or a sum to infinity stands in a tree, which may be infinite.
fn may_grow(tree: &Tree) -> bool {
    any(tree, &mut |node| match node {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Limit { .. } | Operation::Integral { limits: Some(_), .. } => true,
            Operation::Series { to, .. } => infinity(to).is_some(),
            _ => false,
        },
        _ => false,
    })
}

/// Returns the other side of a claim with one infinite side, and true if that is above all numbers.
fn beside_infinity(claim: &Equation) -> Option<(&Tree, bool)> {
    match (infinity(&claim.left), infinity(&claim.right)) {
        (Some(is_above), None) => Some((&claim.right, is_above)),
        (None, Some(is_above)) => Some((&claim.left, is_above)),
        _ => None,
    }
}

impl Statements {
    /// Returns true if the claims say of something that it has a value: a way of an equivalence does, and `< \infty` of a sum.
    pub fn assert_values(&self) -> bool {
        self.is_way
            || self.rules.contains(&Rule::Infinity)
            || self.claims.iter().any(|claim| beside_infinity(claim).is_some())
    }
}

/// Returns true for an equation between infinity and what may be infinite.
pub(super) fn is_infinite(claim: &Equation) -> bool {
    claim.relation == Relation::Equal && beside_infinity(claim).is_some()
}

/// The statements in which what is claimed to be below infinity, a sum or an integral, has a value.
pub(super) fn finite(statements: &Statements) -> Statements {
    let is_one = |claim: &Equation| match claim.relation {
        Relation::Less => infinity(&claim.right) == Some(true) && may_grow(&claim.left),
        Relation::Greater => infinity(&claim.left) == Some(true) && may_grow(&claim.right),
        _ => false,
    };
    if !statements.claims.iter().any(is_one) {
        return statements.clone();
    }
    let mut out = statements.clone().by(Rule::Infinity);
    for claim in out.claims.iter_mut().filter(|claim| is_one(claim)) {
        if let Some(other) = beside_infinity(claim).map(|(other, _)| other.clone()) {
            *claim = has_value(other);
        }
    }
    out
}

/// Reduces an equation with an infinite side to claims about numbers; None where no side is infinite, and where the other
/// one may be.
pub(super) fn of_infinity(claim: &Equation) -> Result<Option<Vec<Equation>>, String> {
    let is_equation = claim.relation == Relation::Equal;
    Ok(
        match (infinity(&claim.left), infinity(&claim.right), beside_infinity(claim)) {
            (None, None, _) => None,
            (_, _, Some((other, _))) if may_grow(other) => None,
            (Some(left), Some(right), _) if is_equation && left == right => Some(vec![has_value(integer(0))]),
            (Some(_), Some(_), _) if is_equation => Some(vec![falsehood()]),
            (_, _, Some((other, _))) if is_equation => Some(vec![falsehood(), has_value(other.clone())]),
            _ => return Err("a limit stands where it is not read".to_owned()),
        },
    )
}

/// The statements with claims that a sum or an integral is infinite as what refutes them, where that has a value.
pub(super) fn refuted_by_value(statements: &Statements) -> Statements {
    if !statements.claims.iter().any(is_infinite) {
        return statements.clone();
    }
    let mut out = statements.clone().by(Rule::Infinity);
    out.claims.clear();
    for claim in &statements.claims {
        match beside_infinity(claim).filter(|_| is_infinite(claim)) {
            Some((other, _)) => out.claims.extend([falsehood(), has_value(other.clone())]),
            None => out.claims.push(claim.clone()),
        }
    }
    out
}

/// The statements with operations replaced by their values, of which some are infinite: these are one side of an equation with
/// infinity, and have no value elsewhere.
pub(super) fn with_values(statements: &Statements, rule: Rule, values: &[(Tree, Tree)]) -> Result<Statements, String> {
    let value = |node: &Tree| values.iter().find(|(known, _)| known == node).map(|(_, value)| value);
    let mut out = statements.clone();
    let is_endless = |node: &Tree| value(node).is_some_and(|value| infinity(value).is_some());
    for claim in out.claims.iter_mut().filter(|claim| claim.relation == Relation::Equal) {
        let Some((other, is_above)) =
            beside_infinity(claim).filter(|(other, _)| any(other, &mut |node| is_endless(node)))
        else {
            continue;
        };
        let whole = mapped(other, &|node| value(node).cloned());
        let terms = match whole {
            Tree::Sum(terms) => terms,
            whole => vec![whole],
        };
        let finite = terms.iter().filter(|term| infinity(term).is_none()).cloned().collect();
        *claim = match infinity(&total(terms)) {
            Some(own) if own == is_above => has_value(sum(finite)),
            Some(_) => falsehood(),
            None => return Err("what is infinite stands in a formula beside infinity".to_owned()),
        };
    }
    if !out.has_formulas_of(statements) {
        out = out.by(rule).by(Rule::Infinity);
    }
    out = rewritten(&out, rule, &|tree| {
        mapped(tree, &|node| value(node).cloned().map(number))
    });
    let mut claims = Vec::new();
    for claim in std::mem::take(&mut out.claims) {
        match of_infinity(&claim)? {
            Some(own) => claims.extend(own),
            None => claims.push(claim),
        }
    }
    out.claims = claims;
    Ok(out)
}
