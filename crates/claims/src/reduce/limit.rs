//! Limits, and what is of the order of a power, by power series in what tends to 0.

use super::super::premise::Statements;
use super::build::{difference, infinity, integer, is_zero, sum};
use super::derivative::mentions;
use super::integers::whole;
use super::series::{Series, Small, is_likely_zero, with_factorials};
use super::{Goal, Rule, is_spoken_of, rewritten, trees};
use texmath::{Condition, Equation, Name, Operation, Relation, Symbols, Tree, any, holds, mapped, rewrite};

/// The terms of a series of a limit, and those that are taken beyond an order.
const TERMS: usize = 10;
const BEYOND: usize = 4;

/// The highest order.
const HIGHEST: i64 = 20;

/// Whether limits or orders stand in the statements.
pub(super) fn stands_in(statements: &Statements) -> bool {
    trees(statements).into_iter().any(|tree| {
        any(tree, &mut |node| {
            matches!(node, Tree::Operation(operation, _)
                if matches!(**operation, Operation::Limit { .. } | Operation::Order(_) | Operation::Approaches(_)))
        })
    })
}

/// The statements without limits and orders, and what must hold for these to be what they are.
pub(super) fn evaluated(statements: &Statements, symbols: &Symbols) -> Result<(Statements, Vec<Goal>), String> {
    let mut out = rewritten(statements, Rule::BinomialFactorials, &with_factorials);
    let approached = approached(&mut out)?;
    let mut lemmas = Vec::new();
    // the innermost first
    while let Some(limit) = first_limit(&out) {
        let Operation::Limit { of, by, to } = &limit else {
            break;
        };
        let (value, needed, written) = of_limit(&out, symbols, of, by, to)?;
        out.claims
            .extend(written.into_iter().map(|tree| Equation::between(tree.clone(), tree)));
        lemmas.extend(as_goals(&out, symbols, needed));
        out = rewritten(&out, Rule::LimitSeries, &|tree| {
            mapped(tree, &|node| match node {
                Tree::Operation(operation, _) if **operation == limit => Some(value.clone()),
                _ => None,
            })
        });
    }
    let mut claims = Vec::new();
    for claim in std::mem::take(&mut out.claims) {
        if !holds(&claim, &|operation| matches!(operation, Operation::Order(_))) {
            claims.push(claim);
            continue;
        }
        let approached = approached.clone().or_else(|| implied(&claim, symbols));
        let (by, to) = approached.ok_or("what tends to what? write `x \\to 0` as an assumption")?;
        let (own, needed) = of_order(&out, symbols, &claim, &by, &to)?;
        out = out.by(Rule::OrderSeries);
        lemmas.extend(as_goals(&out, symbols, needed));
        claims.extend(own);
    }
    out.claims = claims;
    Ok((out, lemmas))
}

/// What tends to 0 in `a = 1 + x + O(x^2)`: beside an order, lower powers of the same symbol say so, for where it grows
/// they would be of that order themselves.
fn implied(claim: &Equation, symbols: &Symbols) -> Option<(Name, Tree)> {
    let Tree::Sum(terms) = &claim.right else {
        return None;
    };
    let order = |term: &Tree| match term {
        Tree::Operation(operation, _) => match &**operation {
            Operation::Order(of) => Some(of.clone()),
            _ => None,
        },
        _ => None,
    };
    let (orders, lower): (Vec<&Tree>, Vec<&Tree>) = terms.iter().partition(|term| order(term).is_some());
    let (name, degree) = match order(orders.first()?)? {
        Tree::Symbol(name, _) => (name, 1),
        Tree::Power(base, degree, _) => match *base {
            Tree::Symbol(name, _) => (name, degree),
            _ => return None,
        },
        _ => return None,
    };
    let is_lower = |term: &&Tree| {
        let term = rewrite(term, &|name| symbols.meaning(name, &|_| false));
        degree_in(&term, &name).is_some_and(|own| own < degree)
    };
    let is_meant = orders.len() == 1 && !lower.is_empty() && lower.iter().all(is_lower);
    let is_number = symbols.is_parameter(&name) && !symbols.is_integer(&name);
    (is_meant && is_number).then_some((name, integer(0)))
}

/// The power of a symbol that a term is a multiple of.
fn degree_in(tree: &Tree, name: &Name) -> Option<i32> {
    match tree {
        Tree::Symbol(other, _) if other == name => Some(1),
        tree if !mentions(tree, name) => Some(0),
        Tree::Negate(inner) => degree_in(inner, name),
        Tree::Product(factors) => factors.iter().map(|factor| degree_in(factor, name)).sum(),
        Tree::Quotient(above, below, _) if !mentions(below, name) => degree_in(above, name),
        Tree::Power(base, power @ 0.., _) => degree_in(base, name)?.checked_mul(*power),
        _ => None,
    }
}

/// Takes what is assumed to tend to something out of the assumptions.
fn approached(statements: &mut Statements) -> Result<Option<(Name, Tree)>, String> {
    let mut found = None;
    let mut rest = Vec::new();
    for condition in std::mem::take(&mut statements.assume) {
        let target = match &condition {
            Condition::Relation(relation) => match (&relation.left, &relation.right) {
                (Tree::Symbol(name, _), Tree::Operation(operation, _)) => match &**operation {
                    Operation::Approaches(to) => Some((name.clone(), to.clone())),
                    _ => None,
                },
                _ => None,
            },
            Condition::Integer(_) => None,
        };
        match target {
            Some(_) if found.is_some() => return Err("two quantities tend to something".to_owned()),
            Some(target) => found = Some(target),
            None => rest.push(condition),
        }
    }
    statements.assume = rest;
    Ok(found)
}

fn first_limit(statements: &Statements) -> Option<Operation> {
    let mut found = None;
    for tree in trees(statements) {
        any(tree, &mut |node| {
            if let Tree::Operation(operation, _) = node
                && matches!(**operation, Operation::Limit { .. })
            {
                found = Some((**operation).clone());
            }
            false
        });
    }
    found
}

/// Each condition as a goal of its own: in one statement they would be taken to be defined together.
pub(super) fn as_goals(statements: &Statements, symbols: &Symbols, needed: Vec<Equation>) -> Vec<Goal> {
    let goal = |condition: Equation| {
        let mut alone = statements.clone().by(Rule::LimitSeries);
        alone.premises.retain(|premise| !holds(&premise.equation, &|_| true));
        let part = format!("the series: {condition}");
        alone.claims = vec![condition];
        Goal::of(&alone, symbols, part)
    };
    needed.into_iter().map(goal).collect()
}

/// A series in what tends to 0 when `by` tends to `to`.
fn small<'a>(
    statements: &Statements,
    symbols: &'a Symbols,
    by: &'a Name,
    to: &Tree,
    length: usize,
) -> Result<Small<'a>, String> {
    if is_spoken_of(statements, symbols, by) || symbols.running() == Some(by) {
        return Err(format!(
            "premises speak of `{by}`: what depends on it there is not followed"
        ));
    }
    if trees(statements).into_iter().any(|tree| symbols.may_be_complex(tree)) {
        return Err("limits of complex numbers are not read".to_owned());
    }
    let (to, side) = match to {
        Tree::Operation(operation, _) => match &**operation {
            Operation::OneSided(to, is_above) => (to, Some(*is_above)),
            _ => (to, None),
        },
        to => (to, None),
    };
    let (value, is_positive) = match infinity(to) {
        Some(is_above) => {
            let value = Series::small(-1, length);
            (if is_above { value } else { value.scaled(&integer(-1)) }, true)
        }
        None => {
            let sign = integer(if side == Some(false) { -1 } else { 1 });
            let mut value = match is_zero(to) {
                true => Series::small(1, length),
                false => Series::constant(to.clone(), length),
            };
            let first = usize::from(value.low == 0);
            if let Some(term) = value.terms.get_mut(first) {
                *term = sign;
            }
            (value, side.is_some())
        }
    };
    let spoken = |name: &Name| {
        let premises = statements.premises.iter();
        let mut sides = premises.flat_map(|premise| [&premise.equation.left, &premise.equation.right]);
        sides.any(|side| {
            any(
                side,
                &mut |node| matches!(node, Tree::Call(other, ..) | Tree::Symbol(other, _) if other.bare() == name.bare()),
            )
        })
    };
    let functions = symbols.functions().map(|(name, _)| name);
    let given = functions.filter(|name| spoken(name)).cloned().collect();
    Ok(Small {
        symbols,
        given,
        name: by,
        value,
        is_positive,
        length,
        needed: Vec::new(),
        written: Vec::new(),
    })
}

/// The limit, what must hold for it to be that, and what does not move in it and must have a value.
pub(super) fn of_limit(
    statements: &Statements,
    symbols: &Symbols,
    of: &Tree,
    by: &Name,
    to: &Tree,
) -> Result<(Tree, Vec<Equation>, Vec<Tree>), String> {
    let of = rewrite(of, &|name| symbols.meaning(name, &|_| false));
    let is_carried = |name: &Name| name.subscript.split([',', ' ']).any(|part| part == by.to_string());
    let mut moves = None;
    any(&of, &mut |node| {
        if let Tree::Symbol(name, _) = node {
            moves = moves.take().or_else(|| is_carried(name).then(|| name.clone()));
        }
        moves.is_some()
    });
    if let Some(name) = moves {
        return Err(format!("`{name}` may move with `{by}`"));
    }
    let mut small = small(statements, symbols, by, to, TERMS)?;
    let series = small.of(&of)?;
    let (mut needed, written) = (small.needed, small.written);
    for exponent in series.low..0 {
        let term = series.at(exponent).ok_or("a series that is not followed far enough")?;
        if !is_likely_zero(&term) {
            return Err("this limit does not exist, as far as it is followed".to_owned());
        }
        if !is_zero(&term) {
            needed.push(Equation::between(term, integer(0)));
        }
    }
    let value = series.at(0).ok_or("a series that is not followed far enough")?;
    Ok((value, needed, written))
}

/// The claim that both sides differ by what is of an order: each coefficient below it vanishes.
fn of_order(
    statements: &Statements,
    symbols: &Symbols,
    claim: &Equation,
    by: &Name,
    to: &Tree,
) -> Result<(Vec<Equation>, Vec<Equation>), String> {
    if claim.relation != Relation::Equal {
        return Err("an order in an inequality".to_owned());
    }
    if any(
        &claim.left,
        &mut |node| matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Order(_))),
    ) {
        return Err("an order on the left of an equation".to_owned());
    }
    let mut orders = Vec::new();
    let mut sides = Vec::new();
    for side in [&claim.left, &claim.right] {
        let terms = match side {
            Tree::Sum(terms) => terms.clone(),
            side => vec![side.clone()],
        };
        let mut rest = Vec::new();
        for term in terms {
            let inner = match &term {
                Tree::Negate(inner) => inner,
                term => term,
            };
            match inner {
                Tree::Operation(operation, _) => match &**operation {
                    Operation::Order(of) => orders.push(of.clone()),
                    _ => rest.push(term.clone()),
                },
                _ => rest.push(term.clone()),
            }
        }
        sides.push(sum(rest));
    }
    let all = difference(sides.remove(0), sides.remove(0));
    if any(
        &all,
        &mut |node| matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Order(_))),
    ) {
        return Err("an order within a product or a function".to_owned());
    }
    let all = rewrite(&all, &|name| symbols.meaning(name, &|_| false));
    let mut least: Option<i32> = None;
    for order in orders {
        let mut small = small(statements, symbols, by, to, 3)?;
        let series = small.of(&order)?;
        let mut powers = series.terms.iter().enumerate().filter(|(_, term)| !is_zero(term));
        let (Some((place, term)), None) = (powers.next(), powers.next()) else {
            return Err(format!("the order {order} is no power of {by}"));
        };
        if whole(term).is_none() || !small.needed.is_empty() {
            return Err(format!("the order {order} is no power of {by}"));
        }
        let exponent = series.low.saturating_add(i32::try_from(place).unwrap_or(i32::MAX));
        least = Some(least.map_or(exponent, |known| known.min(exponent)));
    }
    let order = least.filter(|order| (1..=i32::try_from(HIGHEST).unwrap_or(20)).contains(order));
    let order = order.ok_or("an order is a positive power of what tends to 0")?;
    let length = usize::try_from(order).unwrap_or(0) + BEYOND;
    let mut small = small(statements, symbols, by, to, length)?;
    let series = small.of(&all)?;
    let mut claims = Vec::new();
    for exponent in series.low..order {
        let term = series.at(exponent).ok_or("a series that is not followed far enough")?;
        claims.push(Equation {
            left: term,
            right: integer(0),
            ..claim.clone()
        });
    }
    if claims.is_empty() {
        claims.push(Equation::between(integer(0), integer(0)));
    }
    claims.extend(
        small
            .written
            .into_iter()
            .map(|tree| Equation::between(tree.clone(), tree)),
    );
    Ok((claims, small.needed))
}
