//! Conditions that a verdict holds under and says: that improper integrals have values, and bases of powers.
//!
//! Powers whose exponents are no numbers are taken at positive bases, or at bases that are not 0 where the exponents are integers: what such
//! a power is at 0 hangs on the sign of its exponent.

use super::build::{integer, is_zero};
use super::cases::is_absolute;
use super::{Goal, Reduced, Rule, trees};
use numbers::{Field, Rational};
use std::collections::BTreeSet;
use texmath::{Condition, Equation, Name, Relation, Symbols, Tree, any, mapped, names_in, number_of, speaks_of};

/// Returns the goals with the bases of such powers assumed to be positive and integrals to have values, and these assumptions as
/// they print; nothing where there is none that is not assumed already.
pub fn under_conditions(goals: &Reduced) -> Option<(Reduced, Vec<String>)> {
    let mut further = goals.clone();
    let mut provided: Vec<String> = Vec::new();
    for condition in &plainly(&goals.converging) {
        let printed = condition.to_string();
        if !provided.contains(&printed) {
            provided.push(printed);
        }
        // what shows that a sum has no value outside of its region must hold there
        let states_it = |goal: &Goal| {
            goal.statements
                .claims
                .iter()
                .all(|claim| goals.converging.contains(claim))
        };
        let is_of_region = |goal: &&mut Goal| !goal.statements.rules.contains(&Rule::SeriesInfinite) || states_it(goal);
        let lemmas = further.lemmas.iter_mut().filter(is_of_region);
        for goal in further.sufficient.iter_mut().chain(lemmas) {
            goal.statements.assume.push(Condition::Relation(condition.clone()));
            goal.statements
                .rules
                .insert(match goal.statements.rules.contains(&Rule::SeriesInfinite) {
                    true => Rule::SeriesConverges,
                    false => Rule::IntegralConverges,
                });
        }
    }
    let mut at_zero: [Vec<Goal>; 2] = Default::default();
    let mut of_lemmas: Vec<Equation> = Vec::new();
    let claims: Vec<&Tree> = goals
        .sufficient
        .iter()
        .flat_map(|goal| trees(&goal.statements))
        .collect();
    let is_of_others = |condition: &Equation| {
        let mut names = BTreeSet::new();
        names_in(&condition.left, &mut names);
        !names.iter().all(|name| claims.iter().any(|tree| tree.has_free(name)))
    };
    let of_lists = further.sufficient.iter_mut().map(|goal| (goal, 0));
    for (goal, list) in of_lists.chain(further.lemmas.iter_mut().map(|goal| (goal, 1))) {
        let whole = goal.clone();
        let statements = &mut goal.statements;
        // an integer, or what may be one by its definition: the base may be negative
        let assumed = |name: &Name| {
            statements
                .assume
                .iter()
                .any(|own| matches!(own, Condition::Integer(own) if speaks_of(own, name)))
        };
        let has_value = |name: &Name| statements.locals.iter().any(|local| local.name == *name);
        let is_whole = |name: &Name| goal.symbols.is_integer(name) || assumed(name) || has_value(name);
        let is_assumed = |own: &Equation| statements.assume.contains(&Condition::Relation(own.clone()));
        let mut found: Vec<Equation> = Vec::new();
        for tree in trees(statements) {
            if goal.symbols.may_be_complex(tree) {
                return None;
            }
            any(tree, &mut |node| {
                conditions(node, &goal.symbols, &is_whole, &mut found);
                false
            });
        }
        let mut seen: Vec<Equation> = Vec::new();
        found.retain(|own| {
            let is_new = !is_assumed(own) && !seen.contains(own);
            seen.push(own.clone());
            is_new
        });
        at_zero[list].extend(where_bases_vanish(&whole, &found)?);
        for condition in found {
            let printed = condition.to_string();
            // what a lemma says of a letter of its own is no condition on the claim
            let is_of_claim = list == 0 || !is_of_others(&condition);
            if is_of_claim && !provided.contains(&printed) {
                provided.push(printed);
            }
            if is_of_claim && list == 1 && !of_lemmas.contains(&condition) {
                of_lemmas.push(condition.clone());
            }
            statements.rules.insert(match condition.relation {
                Relation::NotEqual => Rule::NonzeroBases,
                _ => Rule::PositiveBases,
            });
            statements.assume.push(Condition::Relation(condition));
        }
    }
    for goal in &mut further.sufficient {
        for condition in of_lemmas.iter().cloned().map(Condition::Relation) {
            if !goal.statements.assume.contains(&condition) {
                goal.statements.assume.push(condition);
            }
        }
    }
    let [sufficient, lemmas] = at_zero;
    further.sufficient.extend(sufficient);
    further.lemmas.extend(lemmas);
    further.sufficient.extend(goals.where_zero.iter().cloned());
    (!provided.is_empty()).then_some((further, provided))
}

/// The most bases that may vanish.
const MOST_BASES: usize = 3;

/// The goals for where some of these bases are 0: a power of one has a value where its exponent is positive, and is 0. None where
/// so many may be 0.
fn where_bases_vanish(goal: &Goal, conditions: &[Equation]) -> Option<Vec<Goal>> {
    let bases: Vec<&Tree> = conditions.iter().map(|own| &own.left).collect();
    // that a base is not 0 was to be shown for its power to have a value
    if goal.statements.claims.iter().all(|claim| conditions.contains(claim)) {
        return Some(Vec::new());
    }
    if bases.len() > MOST_BASES {
        return None;
    }
    let cases = (1..1_usize << bases.len()).filter_map(|case| {
        let (mut zero, mut other) = (Vec::new(), Vec::new());
        for (place, (base, condition)) in bases.iter().zip(conditions).enumerate() {
            match case >> place & 1 == 1 {
                true => zero.push(*base),
                false => other.push(Condition::Relation(condition.clone())),
            }
        }
        where_these_vanish(goal, &zero, other)
    });
    Some(cases.collect())
}

/// The goal for where these terms are 0, and other conditions hold; None where a power is of a quotient by one of them.
fn where_these_vanish(goal: &Goal, zero: &[&Tree], other: Vec<Condition>) -> Option<Goal> {
    let is_any = |factors: Vec<&Tree>| factors.into_iter().any(|own| zero.contains(&own));
    // a power of a product vanishes where a factor of its base does
    let vanishes = |base: &Tree| zero.contains(&base) || is_any(factors_of(base));
    let mut powers: Vec<(Tree, Tree)> = Vec::new();
    for tree in trees(&goal.statements) {
        any(tree, &mut |node| {
            if let Tree::RealPower(base, exponent, _) = node
                && vanishes(base)
            {
                powers.push(((**base).clone(), (**exponent).clone()));
            }
            false
        });
    }
    if powers.iter().any(|(base, _)| is_any(divisors_of(base))) {
        return None;
    }
    let at_zero = |tree: &Tree| {
        mapped(tree, &|node| match node {
            Tree::RealPower(base, ..) => vanishes(base).then(|| integer(0)),
            _ => None,
        })
    };
    let statements = super::rewritten(&goal.statements, Rule::NonzeroBases, &at_zero);
    let relation = |left: Tree, relation: Relation| {
        Condition::Relation(Equation {
            relation,
            ..Equation::between(left, integer(0))
        })
    };
    let zeros = zero.iter().map(|base| relation((*base).clone(), Relation::Equal));
    let mut there = Goal {
        statements,
        may_be_empty: true,
        ..goal.clone()
    };
    let assume = &mut there.statements.assume;
    assume.extend(other.into_iter().chain(zeros));
    // what is written in the powers has a value
    for (base, exponent) in powers {
        let base = at_zero(&base);
        let conditions = [
            relation(base.clone(), Relation::Equal),
            relation(exponent, Relation::Greater),
        ];
        for condition in conditions.into_iter().skip(usize::from(is_zero(&base))) {
            if !assume.contains(&condition) {
                assume.push(condition);
            }
        }
    }
    there.part = match goal.part.as_str() {
        "" => "where a base is 0".to_owned(),
        part => format!("{part}, where a base is 0"),
    };
    Some(there)
}

/// The factors that a product is divided by.
fn divisors_of(tree: &Tree) -> Vec<&Tree> {
    match tree {
        Tree::Product(factors) => factors.iter().flat_map(divisors_of).collect(),
        Tree::Quotient(above, below, _) => divisors_of(above).into_iter().chain(factors_of(below)).collect(),
        Tree::Power(inner, ..=-1, _) => factors_of(inner),
        Tree::Negate(inner) | Tree::Power(inner, ..) | Tree::RealPower(inner, ..) => divisors_of(inner),
        _ => Vec::new(),
    }
}

/// Conditions without signs in front, `a > 0` for `-a < 0`, and without those that others imply.
fn plainly(conditions: &[Equation]) -> Vec<Equation> {
    let plain = |condition: &Equation| {
        let (is_negative, left) = without_sign(&condition.left);
        let relation = match condition.relation {
            Relation::Less if is_negative => Relation::Greater,
            Relation::Greater if is_negative => Relation::Less,
            Relation::LessOrEqual if is_negative => Relation::GreaterOrEqual,
            Relation::GreaterOrEqual if is_negative => Relation::LessOrEqual,
            relation => relation,
        };
        Equation {
            relation,
            left,
            ..condition.clone()
        }
    };
    let is_to_zero = |own: &&Equation| number_of(&own.right).is_some_and(|right| right == Rational::from_integer(0));
    let of_zero = conditions.iter().filter(is_to_zero).map(plain);
    let all: Vec<Equation> = of_zero
        .chain(conditions.iter().filter(|own| !is_to_zero(own)).cloned())
        .collect();
    let is_implied = |own: &Equation| {
        let is_strict = |other: &Equation| matches!(other.relation, Relation::Less | Relation::Greater);
        own.relation == Relation::NotEqual && all.iter().any(|other| is_strict(other) && other.left == own.left)
    };
    all.iter().filter(|own| !is_implied(own)).cloned().collect()
}

/// A tree without the signs in front of it, of its factors and of all of its terms, and whether these make a minus.
fn without_sign(tree: &Tree) -> (bool, Tree) {
    match tree {
        Tree::Negate(inner) => {
            let (is_negative, inner) = without_sign(inner);
            (!is_negative, inner)
        }
        Tree::Number(value) if *value < Rational::from_integer(0) => (true, Tree::Number(-value.clone())),
        Tree::Sum(terms) => {
            let (signs, parts): (Vec<bool>, Vec<Tree>) = terms.iter().map(without_sign).unzip();
            match signs.into_iter().all(|is_negative| is_negative) {
                true => (true, Tree::Sum(parts)),
                false => (false, tree.clone()),
            }
        }
        Tree::Product(factors) => {
            let (signs, parts): (Vec<bool>, Vec<Tree>) = factors.iter().map(without_sign).unzip();
            let is_one = |factor: &Tree| number_of(factor).is_some_and(|own| own == Rational::from_integer(1));
            let mut rest: Vec<Tree> = parts.into_iter().filter(|factor| !is_one(factor)).collect();
            let tree = match rest.len() {
                1 => rest.remove(0),
                _ => Tree::Product(rest),
            };
            (
                signs.into_iter().filter(|is_negative| *is_negative).count() % 2 == 1,
                tree,
            )
        }
        tree => (false, tree.clone()),
    }
}

/// That the base of a power is positive, or that the factors of the base are not 0 where the exponent is an integer, and nothing
/// else is known of their signs.
fn conditions(node: &Tree, symbols: &Symbols, is_whole: &dyn Fn(&Name) -> bool, found: &mut Vec<Equation>) {
    let Tree::RealPower(base, exponent, _) = node else {
        return;
    };
    let mut names = BTreeSet::new();
    names_in(exponent, &mut names);
    let is_positive = |name: &Name| symbols.is_positive(name) || (*name == Name::plain("e") && !symbols.declares(name));
    let condition = |of: &Tree, relation: Relation| Equation {
        relation,
        ..Equation::between(of.clone(), integer(0))
    };
    if names.iter().all(is_whole) {
        let is_known = |name: &Name| symbols.is_nonzero(name) || is_positive(name);
        let factors = factors_of(base).into_iter();
        let unknown = factors.filter(|factor| !matches!(factor, Tree::Symbol(name, _) if is_known(name)));
        found.extend(unknown.map(|factor| condition(factor, Relation::NotEqual)));
    } else if !matches!(&**base, Tree::Symbol(name, _) if is_positive(name)) && number_of(base).is_none() {
        found.push(condition(base, Relation::Greater));
    }
}

/// The factors, each no number, that must not be 0 for a product not to be.
fn factors_of(tree: &Tree) -> Vec<&Tree> {
    match tree {
        Tree::Product(factors) => factors.iter().flat_map(factors_of).collect(),
        Tree::Quotient(above, below, _) => [above, below].into_iter().flat_map(|part| factors_of(part)).collect(),
        Tree::Negate(inner) | Tree::Power(inner, ..) | Tree::RealPower(inner, ..) => factors_of(inner),
        Tree::Call(_, inner, _) if is_absolute(tree) => factors_of(inner),
        tree if number_of(tree).is_some() => Vec::new(),
        tree => vec![tree],
    }
}
