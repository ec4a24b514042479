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

/// Goals under conditions that are not given.
pub struct Conditional {
    pub goals: Reduced,
    pub provided: Vec<Provided>,
}

/// A condition that goals are under.
pub struct Provided {
    /// The condition as it prints.
    pub printed: String,
    /// Goals for where the base that it keeps from 0 is 0. The claim holds at 0 too where one of these is proved, and the others
    /// are or speak of nothing.
    pub at_zero: Vec<Goal>,
}

impl Conditional {
    /// Assumes in the goals and lemmas that an integral or a sum has a value where a condition holds.
    fn converge_where(&mut self, condition: &Equation) {
        let converging = &self.goals.converging;
        // what shows that a sum has no value outside of its region must hold there
        let is_of_region = |goal: &&mut Goal| {
            let mut claims = goal.statements.claims.iter();
            !goal.statements.rules.contains(&Rule::SeriesInfinite) || claims.all(|claim| converging.contains(claim))
        };
        let lemmas = self.goals.lemmas.iter_mut().filter(is_of_region);
        for goal in self.goals.sufficient.iter_mut().chain(lemmas) {
            goal.statements.assume.push(Condition::Relation(condition.clone()));
            let rule = match goal.statements.rules.contains(&Rule::SeriesInfinite) {
                true => Rule::SeriesConverges,
                false => Rule::IntegralConverges,
            };
            goal.statements.rules.insert(rule);
        }
    }

    /// Adds a condition, once.
    fn provide(&mut self, condition: &Equation, at_zero: Vec<Goal>) {
        let printed = condition.to_string();
        match self.provided.iter_mut().find(|own| own.printed == printed) {
            Some(own) => own.at_zero.extend(at_zero),
            None => self.provided.push(Provided { printed, at_zero }),
        }
    }
}

/// Returns the goals with the bases of such powers assumed to be positive and integrals to have values; nothing where there is
/// none that is not assumed already.
pub fn under_conditions(goals: &Reduced) -> Option<Conditional> {
    let mut out = Conditional {
        goals: goals.clone(),
        provided: Vec::new(),
    };
    for condition in &plainly(&goals.converging) {
        out.provide(condition, Vec::new());
        out.converge_where(condition);
    }
    let claims: Vec<&Tree> = goals
        .sufficient
        .iter()
        .flat_map(|goal| trees(&goal.statements))
        .collect();
    // what a lemma says of a letter of its own is no condition on the claim
    let is_of_claim = |condition: &Equation| {
        let mut names = BTreeSet::new();
        names_in(&condition.left, &mut names);
        names.iter().all(|name| claims.iter().any(|tree| tree.has_free(name)))
    };
    let mut met: Vec<(Equation, Vec<Goal>)> = Vec::new();
    let mut sufficient = Vec::new();
    for goal in &mut out.goals.sufficient {
        sufficient.extend(keep_from_zero(goal, &mut met)?);
    }
    let (mut of_lemmas, mut lemmas) = (Vec::new(), Vec::new());
    for goal in &mut out.goals.lemmas {
        lemmas.extend(keep_from_zero(goal, &mut of_lemmas)?);
    }
    of_lemmas.retain(|(condition, _)| is_of_claim(condition));
    for goal in &mut out.goals.sufficient {
        for condition in of_lemmas.iter().map(|(own, _)| Condition::Relation(own.clone())) {
            if !goal.statements.assume.contains(&condition) {
                goal.statements.assume.push(condition);
            }
        }
    }
    for (condition, at_zero) in met.into_iter().chain(of_lemmas) {
        out.provide(&condition, at_zero);
    }
    out.goals.sufficient.extend(sufficient);
    out.goals.lemmas.extend(lemmas);
    out.goals.sufficient.extend(goals.where_zero.iter().cloned());
    (!out.provided.is_empty()).then_some(out)
}

/// Assumes in a goal that the bases of its powers are positive, or not 0, where this is not known; adds these conditions to what
/// was met, each with the goals for where its base is 0, and returns all of these goals. None where it cannot be said.
fn keep_from_zero(goal: &mut Goal, met: &mut Vec<(Equation, Vec<Goal>)>) -> Option<Vec<Goal>> {
    let found = new_conditions(goal)?;
    let vanishing = where_bases_vanish(goal, &found)?;
    for (place, condition) in found.into_iter().enumerate() {
        // x^n has a value at x = 0 and n = 0 too, which these goals do not speak of
        let is_of_reals = condition.relation != Relation::NotEqual;
        let own = vanishing
            .iter()
            .filter(|(case, _)| is_of_reals && case >> place & 1 == 1);
        met.push((condition.clone(), own.map(|(_, goal)| goal.clone()).collect()));
        goal.statements.rules.insert(match condition.relation {
            Relation::NotEqual => Rule::NonzeroBases,
            _ => Rule::PositiveBases,
        });
        goal.statements.assume.push(Condition::Relation(condition));
    }
    Some(vanishing.into_iter().map(|(_, goal)| goal).collect())
}

/// The conditions on the bases of powers in a goal that it does not assume, each once; None where complex numbers take part.
fn new_conditions(goal: &Goal) -> Option<Vec<Equation>> {
    let statements = &goal.statements;
    // an integer, or what may be one by its definition: the base may be negative
    let assumed = |name: &Name| {
        let mut all = statements.assume.iter();
        all.any(|own| matches!(own, Condition::Integer(own) if speaks_of(own, name)))
    };
    let has_value = |name: &Name| statements.locals.iter().any(|local| local.name == *name);
    let is_whole = |name: &Name| goal.symbols.is_integer(name) || assumed(name) || has_value(name);
    let mut all: Vec<Equation> = Vec::new();
    for tree in trees(statements) {
        if goal.symbols.may_be_complex(tree) {
            return None;
        }
        any(tree, &mut |node| {
            conditions(node, &goal.symbols, &is_whole, &mut all);
            false
        });
    }
    let mut found: Vec<Equation> = Vec::new();
    for condition in all {
        if !found.contains(&condition) && !statements.assume.contains(&Condition::Relation(condition.clone())) {
            found.push(condition);
        }
    }
    Some(found)
}

/// The most bases that may vanish.
const MOST_BASES: usize = 3;

/// The goals for where some of these bases are 0, with a bit for each that is: a power of one has a value where its exponent is
/// positive, and is 0. None where so many may be 0.
fn where_bases_vanish(goal: &Goal, conditions: &[Equation]) -> Option<Vec<(usize, Goal)>> {
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
        Some((case, where_these_vanish(goal, &zero, other)?))
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
