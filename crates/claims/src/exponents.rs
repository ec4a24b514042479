//! Powers whose exponents are integers at some values of their letters alone.

use numbers::{Field, Rational};
use std::collections::BTreeSet;
use texmath::{Condition, Elementary, Name, Operation, Relation, Symbols, Tree, any, number_of, rewrite, speaks_of};

/// The numbers from 0 that are put in for the letters of an exponent, and the most letters.
const NUMBERS: i64 = 8;
const MOST_LETTERS: u32 = 3;

/// Whether a power has an exponent in integers alone that is an integer at some of their values and not at others, as
/// `x^{n/2}`: that its base is not negative may be meant, or not.
pub(super) fn is_at_times_whole(exponent: &Tree, integers: &[Name]) -> bool {
    let mut letters: BTreeSet<&Name> = BTreeSet::new();
    let is_plain = !any(exponent, &mut |node| {
        matches!(
            node,
            Tree::Call(..) | Tree::Operation(..) | Tree::Partial { .. } | Tree::Invariant { .. }
        )
    });
    for name in integers.iter().filter(|name| speaks_of(exponent, name)) {
        letters.insert(name);
    }
    let count = u32::try_from(letters.len()).unwrap_or(u32::MAX);
    if !is_plain || count == 0 || count > MOST_LETTERS {
        return false;
    }
    let values = (0..NUMBERS.pow(count)).filter_map(|tuple| {
        let put_in = |name: &Name| {
            let place = letters.iter().position(|letter| *letter == name)?;
            let power = NUMBERS.pow(u32::try_from(place).ok()?);
            Some(Tree::Number(Rational::from_integer(tuple / power % NUMBERS)))
        };
        number_of(&rewrite(exponent, &put_in))
    });
    let (whole, broken): (Vec<Rational>, Vec<Rational>) = values.partition(|value| value.0.is_int());
    !whole.is_empty() && !broken.is_empty()
}

/// The bases of such powers in a tree; `None` where one stands in an operation that binds a letter of it.
pub(super) fn bases<'t>(tree: &'t Tree, integers: &[Name], found: &mut Vec<(&'t Tree, &'t Tree)>) -> Option<()> {
    if let Tree::RealPower(base, exponent, _) = tree
        && is_at_times_whole(exponent, integers)
    {
        found.push((base, exponent));
    }
    let known = found.len();
    if tree
        .find_below(&mut |part| bases(part, integers, found).is_none().then_some(()))
        .is_some()
    {
        return None;
    }
    let letter = match tree {
        Tree::Operation(operation, _) => operation.letter(),
        _ => None,
    };
    let is_bound = |(base, exponent): &(&Tree, &Tree)| {
        letter.is_some_and(|letter| speaks_of(base, letter) || speaks_of(exponent, letter))
    };
    (!found.iter().skip(known).any(is_bound)).then_some(())
}

/// Whether a tree is plainly not negative, by how it is written, by what is declared, or by what is assumed.
pub(super) fn is_plainly_not_negative(tree: &Tree, symbols: &Symbols, assumed: &[&Condition]) -> bool {
    let again = |tree: &Tree| is_plainly_not_negative(tree, symbols, assumed);
    let is_said = assumed.iter().any(|condition| match condition {
        Condition::Relation(relation) => {
            let (high, low) = match relation.relation {
                Relation::Greater | Relation::GreaterOrEqual => (&relation.left, &relation.right),
                Relation::Less | Relation::LessOrEqual => (&relation.right, &relation.left),
                Relation::Equal | Relation::NotEqual => return false,
            };
            high == tree && number_of(low).is_some_and(|low: Rational| low >= Rational::from_integer(0))
        }
        Condition::Integer(_) => false,
    });
    is_said
        || match tree {
            Tree::Number(_) => true,
            Tree::Symbol(name, _) => {
                texmath::is_constant(name) && name.base != "i"
                    || symbols.is_positive(name)
                    || symbols.is_nonnegative(name)
            }
            Tree::Call(name, ..) if matches!(name.base.as_str(), r"\factorial" | r"\doublefactorial") => true,
            Tree::Call(name, ..) => Elementary::named(name).is_some_and(Elementary::is_never_negative),
            Tree::Power(inner, exponent, _) => exponent % 2 == 0 || again(inner),
            Tree::Root(_, index, _) => index % 2 == 0,
            Tree::RealPower(base, ..) => again(base),
            Tree::Sum(parts) | Tree::Product(parts) => parts.iter().all(again),
            Tree::Quotient(above, below, _) => again(above) && again(below),
            Tree::Operation(operation, _) => matches!(**operation, Operation::Binomial(..)),
            _ => false,
        }
}
