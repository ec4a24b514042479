//! Factorials and binomial coefficients: of numbers their values, of letters positive quantities of which n! = n (n - 1)! is
//! known.

use super::super::premise::Statements;
use super::build::{call, difference, integer, product, quotient, real_power, sum, symbol};
use super::integers::whole;
use super::{Rule, fresh, rewritten, trees};
use numbers::{Field, Rational};
use std::collections::BTreeMap;
use texmath::{Condition, Equation, Name, Relation, Symbols, Tree, any, mapped, number_of};

pub(super) const FACTORIAL: &str = "\\factorial";
pub(super) const DOUBLE_FACTORIAL: &str = "\\doublefactorial";

/// The largest number whose factorial is written out, and the most factors n (n - 1) ... of a symbol.
const LARGEST: i64 = 200;
const MOST_FACTORS: i64 = 20;

/// Whether a tree holds a factorial.
pub(super) fn stands_in(tree: &Tree) -> bool {
    any(tree, &mut |node| is_one(node))
}

/// Whether a node is a factorial.
pub(super) fn is_one(node: &Tree) -> bool {
    matches!(node, Tree::Call(name, ..) if is_of(name))
}

/// Returns true if a function is a factorial, simple or double.
pub(super) fn is_of(function: &Name) -> bool {
    [FACTORIAL, DOUBLE_FACTORIAL].contains(&function.base.as_str())
}

/// The factorial of a number, simple or double; `None` where the argument is no number.
pub(super) fn of_number(name: &Name, argument: &Tree) -> Option<Result<Tree, String>> {
    let step = match name.base.as_str() {
        FACTORIAL => 1,
        DOUBLE_FACTORIAL => 2,
        _ => return None,
    };
    let mut value = whole(argument)?;
    if !(0..=LARGEST).contains(&value) {
        return Some(Err(format!("the factorial of {value}")));
    }
    let mut total = Rational::from_integer(1);
    while value > 1 {
        total *= Rational::from_integer(value);
        value -= step;
    }
    Some(Ok(Tree::Number(total)))
}

/// A binomial coefficient with its arguments written out: (n + 1) n / 2 for a number below.
///
/// # Errors
/// What stands below where it is no integer, or larger than what is written out.
pub(super) fn binomial(of: &Tree, chosen: &Tree) -> Result<Tree, String> {
    let Some(chosen) = whole(chosen) else {
        return match number_of(chosen) {
            Some(_) => Err(format!("a binomial coefficient over {chosen}, which is no integer")),
            None => Ok(by_factorials(of, chosen)),
        };
    };
    let most = if whole(of).is_some() { LARGEST } else { MOST_FACTORS };
    match chosen {
        ..0 => Ok(integer(0)),
        0 => Ok(integer(1)),
        chosen if chosen > most => Err(format!("a binomial coefficient over {chosen}")),
        chosen => {
            let falling = (0..chosen).map(|less| sum(vec![of.clone(), integer(-less)]));
            let below = (1..=chosen).fold(Rational::from_integer(1), |product, factor| {
                product * Rational::from_integer(factor)
            });
            Ok(quotient(product(falling.collect()), Tree::Number(below)))
        }
    }
}

/// n!/(k! (n - k)!), which a binomial coefficient is for integers with 0 <= k <= n.
pub(super) fn by_factorials(of: &Tree, chosen: &Tree) -> Tree {
    let factorial = |tree: Tree| match linear(&tree) {
        Some(linear) => call(FACTORIAL, tree_of(&linear)),
        None => call(FACTORIAL, tree),
    };
    let others = difference(of.clone(), chosen.clone());
    let below = product(vec![factorial(chosen.clone()), factorial(others)]);
    quotient(factorial(of.clone()), below)
}

/// Letters times integers, by their names, and an integer.
pub(super) type Linear = (BTreeMap<Name, i64>, i64);

/// Letters times integers and an integer, added up; None where a tree is something else.
pub(super) fn linear(tree: &Tree) -> Option<Linear> {
    let scaled = |(letters, constant): Linear, by: i64| -> Option<Linear> {
        let letters = letters
            .into_iter()
            .map(|(name, factor)| Some((name, factor.checked_mul(by)?)));
        Some((letters.collect::<Option<_>>()?, constant.checked_mul(by)?))
    };
    Some(match tree {
        Tree::Symbol(name, _) => (BTreeMap::from([(name.clone(), 1)]), 0),
        Tree::Negate(inner) => scaled(linear(inner)?, -1)?,
        Tree::Sum(terms) => {
            let mut total: Linear = (BTreeMap::new(), 0);
            for term in terms {
                let (letters, constant) = linear(term)?;
                total.1 = total.1.checked_add(constant)?;
                for (name, factor) in letters {
                    let known = total.0.entry(name).or_default();
                    *known = known.checked_add(factor)?;
                }
            }
            total.0.retain(|_, factor| *factor != 0);
            total
        }
        Tree::Product(factors) => {
            let mut total: Linear = (BTreeMap::new(), 1);
            for factor in factors {
                let (letters, constant) = linear(factor)?;
                total = match (total.0.is_empty(), letters.is_empty()) {
                    (_, true) => scaled(total, constant)?,
                    (true, false) => scaled((letters, constant), total.1)?,
                    (false, false) => return None,
                };
            }
            total
        }
        tree => (BTreeMap::new(), whole(tree)?),
    })
}

fn tree_of((letters, constant): &Linear) -> Tree {
    let terms = letters
        .iter()
        .map(|(name, factor)| product(vec![integer(*factor), symbol(name)]));
    sum(terms.chain([integer(*constant)]).collect())
}

/// Double factorials as simple ones: (2m)!! = 2^m m!, (2m - 1)!! = (2m)!/(2^m m!).
fn simple(tree: &Tree) -> Tree {
    mapped(tree, &|node| {
        let Tree::Call(name, argument, _) = node else {
            return None;
        };
        if name.base != DOUBLE_FACTORIAL {
            return None;
        }
        let (letters, constant) = linear(argument)?;
        if letters.values().any(|factor| factor % 2 != 0) {
            return None;
        }
        let up = constant.rem_euclid(2);
        let half: Linear = (
            letters
                .iter()
                .map(|(name, factor)| (name.clone(), factor / 2))
                .collect(),
            (constant + up) / 2,
        );
        let of = |tree: Tree| call(FACTORIAL, tree);
        let even = product(vec![real_power(integer(2), tree_of(&half)), of(tree_of(&half))]);
        Some(match up {
            0 => even,
            _ => quotient(of(tree_of(&(letters, constant + 1))), even),
        })
    })
}

/// The tree with double factorials as simple ones, and with these of letters times integers alone: (n + 2)! = n! (n + 1) (n + 2)
/// where n! has a value.
pub(super) fn by_letters(tree: &Tree) -> Tree {
    mapped(&simple(tree), &|node| {
        let Tree::Call(name, argument, _) = node else {
            return None;
        };
        let (letters, constant) = linear(argument).filter(|_| name.base == FACTORIAL)?;
        if letters.is_empty() || constant == 0 || constant.abs() > MOST_FACTORS {
            return None;
        }
        let at = |more: i64| tree_of(&(letters.clone(), more));
        let alone = call(FACTORIAL, at(0));
        Some(match constant {
            1.. => product(std::iter::once(alone).chain((1..=constant).map(at)).collect()),
            _ => quotient(alone, product((constant + 1..=0).map(at).collect())),
        })
    })
}

/// The statements with factorials as positive quantities, which is enough to prove them; and the symbol table with these.
pub(super) fn as_quantities(statements: &Statements, symbols: &Symbols) -> Result<(Statements, Symbols), String> {
    let statements = rewritten(statements, Rule::FactorialRecurrence, &|tree| simple(tree));
    let mut groups: BTreeMap<BTreeMap<Name, i64>, Vec<i64>> = BTreeMap::new();
    let mut unknown = None;
    for tree in trees(&statements) {
        any(tree, &mut |node| {
            if let Tree::Call(name, argument, _) = node
                && is_one(node)
            {
                match linear(argument).filter(|_| name.base == FACTORIAL) {
                    Some((letters, constant)) if !letters.is_empty() => {
                        groups.entry(letters).or_default().push(constant);
                    }
                    Some(_) => {}
                    None => unknown = Some(argument.to_string()),
                }
            }
            false
        });
    }
    if let Some(unknown) = unknown {
        return Err(format!("the factorial of {unknown}"));
    }
    let mut symbols = symbols.clone();
    let mut quantities: BTreeMap<BTreeMap<Name, i64>, (i64, Name)> = BTreeMap::new();
    let mut out = statements.clone();
    for (letters, constants) in groups {
        let least = constants.into_iter().min().unwrap_or_default();
        let name = fresh(&statements, &symbols, "N");
        symbols.let_be_parameter(&name, true);
        let argument = tree_of(&(letters.clone(), least));
        // a way of an equivalence is to be shown to have a value
        if statements.is_way && !is_from_zero(&argument, &statements.assume, &symbols) {
            return Err(format!("that {argument} is not negative is not shown"));
        }
        let condition = Equation {
            relation: Relation::GreaterOrEqual,
            ..Equation::between(argument, integer(0))
        };
        out.assume.push(Condition::Relation(condition));
        quantities.insert(letters, (least, name));
    }
    let written = |node: &Tree| -> Option<Tree> {
        let Tree::Call(name, argument, _) = node else {
            return None;
        };
        if let Some(Ok(number)) = of_number(name, argument) {
            return Some(number);
        }
        if name.base != FACTORIAL {
            return None;
        }
        let (letters, constant) = linear(argument)?;
        if letters.is_empty() {
            return of_number(name, &integer(constant))?.ok();
        }
        let (least, quantity) = quantities.get(&letters)?;
        let rising = (least + 1..=constant).map(|more| tree_of(&(letters.clone(), more)));
        Some(product(std::iter::once(symbol(quantity)).chain(rising).collect()))
    };
    let out = rewritten(&out, Rule::FactorialRecurrence, &|tree| mapped(tree, &written));
    match trees(&out).into_iter().any(stands_in) {
        true => Err("the factorial of what is no natural number".to_owned()),
        false => Ok((out, symbols)),
    }
}

/// Letters times integers and an integer, added up; `None` where a tree is something else.
pub(super) fn added_up(tree: &Tree) -> Option<Tree> {
    linear(tree).map(|linear| tree_of(&linear))
}

/// The factor of a letter in a tree that is an integer times it and an integer, and that integer.
pub(super) fn multiple_of(tree: &Tree, letter: &Name) -> Option<(i64, i64)> {
    let (letters, constant) = linear(tree)?;
    let is_alone = letters.keys().all(|name| name == letter);
    is_alone.then(|| (letters.get(letter).copied().unwrap_or(0), constant))
}

/// Whether a tree is letters times integers and an integer, added up.
pub(super) fn is_linear(tree: &Tree) -> bool {
    linear(tree).is_some()
}

/// The least value of such a tree by the least values of its letters, which are added.
pub(super) fn least_value(tree: &Tree, least: &dyn Fn(&Name) -> Option<i64>) -> Option<i64> {
    let (letters, constant) = linear(tree)?;
    letters.iter().try_fold(constant, |sum, (letter, factor)| {
        let own = (*factor > 0).then(|| least(letter))??;
        sum.checked_add(factor.checked_mul(own)?)
    })
}

/// Returns true if such a tree is not negative by what is declared or assumed of each of its letters.
fn is_from_zero(tree: &Tree, assume: &[Condition], symbols: &Symbols) -> bool {
    let assumed = |letter: &Name| {
        let bounds = assume.iter().filter_map(|condition| match condition {
            Condition::Relation(own) if own.left == symbol(letter) => match own.relation {
                Relation::GreaterOrEqual => whole(&own.right),
                Relation::Greater => whole(&own.right).map(|bound| bound + 1),
                _ => None,
            },
            _ => None,
        });
        bounds.max()
    };
    let least = least_value(tree, &|letter| match letter {
        letter if symbols.is_positive(letter) => Some(1),
        letter if symbols.is_nonnegative(letter) => Some(0),
        letter => assumed(letter),
    });
    least.is_some_and(|least| least >= 0)
}

/// Whether a tree is such with letters that are among these.
pub(super) fn is_linear_in(tree: &Tree, letters: &[Name]) -> bool {
    linear(tree).is_some_and(|(own, _)| own.keys().all(|name| letters.contains(name)))
}

/// Whether a tree is such with letters that are integers.
pub(super) fn is_integer(tree: &Tree, symbols: &Symbols) -> bool {
    let letters = linear(tree).map(|(letters, _)| letters);
    letters.is_some_and(|letters| letters.keys().all(|name| symbols.is_integer(name)))
}
