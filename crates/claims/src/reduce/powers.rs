//! Powers whose exponents are no numbers, at positive bases: what such a power is at 0 hangs on the sign of its exponent.

use super::build::integer;
use super::{Reduced, Rule, trees};
use std::collections::BTreeSet;
use texmath::{Condition, Equation, Name, Relation, Symbols, Tree, any, names_in, number_of, speaks_of};

/// Returns the goals with the bases of such powers assumed to be positive, and these assumptions as they print; nothing where there
/// is none that is not assumed already.
pub fn at_positive_bases(goals: &Reduced) -> Option<(Reduced, Vec<String>)> {
    let mut further = goals.clone();
    let mut provided: Vec<String> = Vec::new();
    for goal in further.sufficient.iter_mut().chain(&mut further.lemmas) {
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
                let own = positive_base(node, &goal.symbols, &is_whole);
                found.extend(own.filter(|own| !found.contains(own) && !is_assumed(own)));
                false
            });
        }
        for condition in found {
            let printed = condition.to_string();
            if !provided.contains(&printed) {
                provided.push(printed);
            }
            statements.assume.push(Condition::Relation(condition));
            statements.rules.insert(Rule::PositiveBases);
        }
    }
    (!provided.is_empty()).then_some((further, provided))
}

/// That the base of a power is positive, where it must not be negative and nothing else is known of its sign.
fn positive_base(node: &Tree, symbols: &Symbols, is_whole: &dyn Fn(&Name) -> bool) -> Option<Equation> {
    let Tree::RealPower(base, exponent, _) = node else {
        return None;
    };
    let is_known = match &**base {
        Tree::Symbol(name, _) => symbols.is_positive(name) || (*name == Name::plain("e") && !symbols.declares(name)),
        base => number_of(base).is_some(),
    };
    let mut names = BTreeSet::new();
    names_in(exponent, &mut names);
    (!is_known && !names.iter().all(is_whole)).then(|| Equation {
        relation: Relation::Greater,
        ..Equation::between((**base).clone(), integer(0))
    })
}
