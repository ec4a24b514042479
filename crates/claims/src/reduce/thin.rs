//! Where a claim has a value: on a thin set alone, where what stands under a root cannot be above 0, or wherever what is given holds.

use super::build::{difference, integer, power, product};
use super::defined::conditions_beside;
use super::{Goal, trees};
use texmath::{Condition, Elementary, Equation, Relation, Tree, any, number_of};

/// The most roots that are looked at.
const MOST: usize = 4;

/// For each root of real numbers in a claim what stands under it, for each inverse function with ends of its domain what is
/// not negative within them, and the goal that this is nowhere above 0 where all others have a value. Where one of these is
/// proved, the claim is about its zeros alone.
pub fn thin_domains(goal: &Goal) -> Vec<(Tree, Goal)> {
    let Goal {
        statements, symbols, ..
    } = goal;
    if trees(statements).into_iter().any(|tree| symbols.may_be_complex(tree)) {
        return Vec::new();
    }
    let mut radicands: Vec<Tree> = Vec::new();
    for side in statements.claims.iter().flat_map(|claim| [&claim.left, &claim.right]) {
        any(side, &mut |node| {
            radicands.extend(whole_radicand(node).filter(|own| !radicands.contains(own)));
            false
        });
    }
    let against_zero = |radicand: &Tree, relation: Relation| Equation {
        relation,
        ..Equation::between(radicand.clone(), integer(0))
    };
    let of = |radicand: &Tree| {
        let mut alone = statements.clone();
        alone.claims = vec![against_zero(radicand, Relation::LessOrEqual)];
        let others = radicands.iter().filter(|other| *other != radicand);
        let have_values = others.map(|other| Condition::Relation(against_zero(other, Relation::GreaterOrEqual)));
        alone.assume.extend(have_values);
        let part = format!("{radicand} is nowhere above 0");
        (radicand.clone(), Goal::of(&alone, symbols, part))
    };
    radicands.iter().take(MOST).map(of).collect()
}

/// What stands under an even root, or is not negative where an inverse function has a value; of a product with a root, all of it
/// under the root, which has the same sign.
fn whole_radicand(node: &Tree) -> Option<Tree> {
    let under = |node: &Tree| match node {
        Tree::Root(radicand, index, _) if index % 2 == 0 && number_of(radicand).is_none() => Some((**radicand).clone()),
        Tree::Call(name, at, _) if number_of(at).is_none() => {
            let domain = Elementary::named(name)?.domain(at).into_iter();
            let mut closed = domain.filter(|condition| condition.relation == Relation::GreaterOrEqual);
            closed
                .next()
                .map(|condition| difference(condition.left, condition.right))
        }
        _ => None,
    };
    let Tree::Product(factors) = node else {
        return under(node);
    };
    let place = factors.iter().position(|factor| under(factor).is_some())?;
    let mut whole: Vec<Tree> = factors.iter().map(|factor| power(factor.clone(), 2)).collect();
    whole[place] = factors.get(place).and_then(under)?;
    Some(product(whole))
}

/// Conditions for a claim to have a value, each with the goal that it holds where the premises and assumptions do. Functions that
/// are not elementary have a value at each number.
///
/// # Errors
/// Names a part of the claim of which it is not known where it has a value.
pub fn values(goal: &Goal) -> Result<Vec<(Equation, Goal)>, String> {
    let Goal {
        statements, symbols, ..
    } = goal;
    let sides = statements.claims.iter().flat_map(|claim| [&claim.left, &claim.right]);
    let conditions: Result<Vec<Vec<Equation>>, String> =
        sides.map(|side| conditions_beside(side, symbols, &|_| true)).collect();
    let of = |condition: Equation| {
        let mut alone = statements.clone();
        alone.claims = vec![condition.clone()];
        let part = format!("{condition} where what is given holds");
        (condition, Goal::of(&alone, symbols, part))
    };
    Ok(conditions?.into_iter().flatten().map(of).collect())
}
