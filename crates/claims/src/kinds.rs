//! What the lists of `[symbols]` say of the values of a symbol.

use numbers::{Field, Rational};
use texmath::{Condition, Equation, Meaning, Name, Relation, Symbols, Tree, any, number_of};

/// A list of `[symbols]` that says which values a symbol has: how they stand to a number, or that they are integers.
#[derive(PartialEq)]
pub(super) struct List {
    pub(super) name: &'static str,
    bound: Option<(Relation, i64)>,
}

impl List {
    pub(super) fn allows(&self, value: &Rational) -> bool {
        let Some((relation, bound)) = self.bound else {
            return *value.0.denominator() == dashu_int::UBig::ONE;
        };
        let bound = Rational::from_integer(bound);
        match relation {
            Relation::LessOrEqual => *value <= bound,
            Relation::Greater => *value > bound,
            Relation::GreaterOrEqual => *value >= bound,
            _ => *value != bound,
        }
    }

    /// The same of the right side of an equation.
    pub(super) fn said_of(&self, equation: &Equation) -> Condition {
        let Some((relation, bound)) = self.bound else {
            return Condition::Integer(equation.right.clone());
        };
        Condition::Relation(Equation {
            left: equation.right.clone(),
            relation,
            right: Tree::Number(Rational::from_integer(bound)),
            ..equation.clone()
        })
    }
}

/// Refuses an argument beyond what `[symbols]` says of the one that a function is defined with.
pub(super) fn may_take(symbols: &Symbols, formal: &Name, argument: &Tree) -> Result<(), String> {
    if is_complex_in(symbols, argument) && !symbols.is_complex(formal) {
        return Err(format!("`{formal}` is real: it cannot be {argument}"));
    }
    let lists = lists_of(symbols, formal);
    match lists.iter().find(|list| !is_within(symbols, argument, list)) {
        Some(list) => {
            let problem = "write the definition with a symbol of which [symbols] says nothing";
            Err(format!(
                "`{formal}` stands in `{}`, which {argument} may not be: {problem}",
                list.name
            ))
        }
        None => Ok(()),
    }
}

/// Whether a list holds for a formula of numbers and symbols of which it holds.
fn is_within(symbols: &Symbols, tree: &Tree, list: &List) -> bool {
    let all = |parts: &[Tree]| parts.iter().all(|part| is_within(symbols, part, list));
    let is_sign = matches!(list.bound, Some((Relation::Greater | Relation::GreaterOrEqual, 0)));
    match tree {
        Tree::Number(number) => list.allows(number),
        Tree::Symbol(name, _) => lists_of(symbols, name).contains(list),
        Tree::Sum(parts) | Tree::Product(parts) => (is_sign || list.bound.is_none()) && all(parts),
        Tree::Negate(inner) => list.bound.is_none() && is_within(symbols, inner, list),
        _ => false,
    }
}

/// The lists of `[symbols]` that say which values a symbol has.
pub(super) fn lists_of(symbols: &Symbols, name: &Name) -> Vec<List> {
    let lists = [
        ("at_most_one", Meaning::AtMostOne, Some((Relation::LessOrEqual, 1))),
        ("positive", Meaning::Positive, Some((Relation::Greater, 0))),
        ("nonnegative", Meaning::Nonnegative, Some((Relation::GreaterOrEqual, 0))),
        ("nonzero", Meaning::Nonzero, Some((Relation::NotEqual, 0))),
        ("integers", Meaning::Integer, None),
    ];
    let own = lists.into_iter().filter(|(_, kind, _)| symbols.is(name, kind));
    own.map(|(name, _, bound)| List { name, bound }).collect()
}

/// Whether a complex symbol, the imaginary unit or the square root of a negative number stands in a formula.
pub(super) fn is_complex_in(symbols: &Symbols, tree: &Tree) -> bool {
    let zero = Rational::from_integer(0);
    let is_imaginary = |node: &Tree| match node {
        Tree::Root(of, index, _) => index % 2 == 0 && number_of(of).is_some_and(|number| number < zero),
        _ => false,
    };
    symbols.may_be_complex(tree) || any(tree, &mut |node| is_imaginary(node))
}

/// The abbreviation of which a list says what it may be, and in which this symbol stands.
pub(super) fn listed_with<'s>(symbols: &'s Symbols, name: &Name) -> Option<&'s Name> {
    let meant = symbols
        .abbreviations()
        .filter(|(own, _)| *own != name && !lists_of(symbols, own).is_empty());
    let is_inner = |node: &Tree| matches!(node, Tree::Symbol(inner, _) if inner == name);
    let mut holding = meant.filter(|(own, _)| {
        let meaning = symbols.meaning(own, &|_| false);
        meaning.is_some_and(|tree| any(&tree, &mut |node| is_inner(node)))
    });
    holding.next().map(|(own, _)| own)
}
