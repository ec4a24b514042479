//! What formulas say of formulas: `A \Rightarrow B`, `A \Leftrightarrow B`, "A or B".

use super::definition::{has_sign, letters_of, with_sign};
use super::fault::{Fault, Source};
use numbers::{Field, Rational};
use std::collections::HashSet;
use texmath::{
    Condition, Display, Elementary, Equation, Name, Names, ReadError, Relation, Symbols, Tree, any, is_constant,
    read_conditions, read_display,
};

/// A way of an equivalence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// From its left side to its right one.
    Right,
    Left,
}

/// The signs of an implication between what is assumed and what is claimed.
const IMPLIES: [&str; 5] = ["\\Rightarrow", "\\Longrightarrow", "\\implies", "\u{21d2}", "\u{27f9}"];

/// The signs of an equivalence.
const EQUIVALENT: [&str; 5] = [
    "\\Leftrightarrow",
    "\\Longleftrightarrow",
    "\\iff",
    "\u{21d4}",
    "\u{27fa}",
];

/// Whether a formula says that two others are equivalent.
pub(super) fn is_equivalence(tex: &str) -> bool {
    parted(tex, &EQUIVALENT).is_some()
}

/// What stands before and behind the one sign of these that stands in a formula; `None` for none or several.
fn parted<'t>(tex: &'t str, signs: &[&str]) -> Option<(&'t str, &'t str)> {
    let is_word = |end: usize| {
        tex.get(end..)
            .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_alphabetic()))
    };
    let found = signs.iter().flat_map(|sign| tex.match_indices(sign));
    let mut found = found.filter(|(at, sign)| !(sign.starts_with('\\') && is_word(at + sign.len())));
    let (at, sign) = found.next().filter(|_| found.next().is_none())?;
    Some((tex.get(..at)?, tex.get(at + sign.len()..)?))
}

/// The formulas that a formula is made of: the sides of its one arrow, the alternatives of each.
pub(super) fn formulas(tex: &str) -> Vec<String> {
    let sides = parted(tex, &IMPLIES).or_else(|| parted(tex, &EQUIVALENT));
    let sides = sides.map_or_else(|| vec![tex], |(left, right)| vec![left, right]);
    sides.into_iter().flat_map(parts).collect()
}

/// Whether signs stand on both sides of an arrow: the upper ones go together, as one of two equations on each side would not.
pub(super) fn signs_go_together((when, then): &(Source, Source)) -> bool {
    let has_sign = |source: &Source| {
        [r"\pm", r"\mp", "\u{b1}", "\u{2213}"]
            .iter()
            .any(|sign| source.tex.contains(sign))
    };
    has_sign(when) && has_sign(then)
}

/// What a claim `A \Rightarrow B`, or this way of `A \Leftrightarrow B`, assumes, and what it states, both at their places; `None`
/// where it is no implication, or more than one.
pub(super) fn implication(source: &Source, way: Option<Way>) -> Option<(Source, Source)> {
    let signs = if way.is_some() { &EQUIVALENT } else { &IMPLIES };
    let (left, right) = parted(&source.tex, signs)?;
    let before = " ".repeat(source.tex.len() - right.len());
    let (left, right) = (source.with_tex(left.to_owned()), source.with_tex(before + right));
    match way {
        Some(Way::Left) => Some((right, left)),
        _ => Some((left, right)),
    }
}

/// The sides of an equation that gives a letter, that letter first.
fn gives(equation: &Equation) -> Option<(&Name, &Tree)> {
    let (Tree::Symbol(name, _), Relation::Equal) = (&equation.left, equation.relation) else {
        return None;
    };
    Some((name, &equation.right))
}

/// Where the conclusion of an implication gives a letter by an integer that is not `given`, and why that cannot be read:
/// authors mean that there is such an integer.
pub(super) fn new_integer(
    equations: &[Equation],
    given: &[(Condition, Source)],
    beside: &[(Condition, Source)],
    symbols: &Symbols,
) -> Option<(usize, String)> {
    let names = |tree: &Tree, is_it: &mut dyn FnMut(&Name) -> bool| {
        any(tree, &mut |node| matches!(node, Tree::Symbol(name, _) if is_it(name)))
    };
    let is_given = |name: &Name| {
        given.iter().any(|(condition, _)| match condition {
            Condition::Relation(relation) => {
                let is_it = &mut |other: &Name| other == name;
                names(&relation.left, is_it) || names(&relation.right, is_it)
            }
            Condition::Integer(tree) => names(tree, &mut |other| other == name),
        })
    };
    let is_integer = |name: &Name| {
        let is_said =
            |condition: &Condition| matches!(condition, Condition::Integer(Tree::Symbol(own, _)) if own == name);
        symbols.is_integer(name) || beside.iter().any(|(condition, _)| is_said(condition))
    };
    equations.iter().find_map(|equation| {
        let (letter, value) = gives(equation)?;
        let mut found = None;
        names(value, &mut |name| {
            let is_new = is_integer(name) && !is_given(name);
            found = found.take().or_else(|| is_new.then(|| name.clone()));
            is_new
        });
        let new = found.filter(|_| is_given(letter))?;
        let problem = format!("`{new}` stands in what follows alone: whether for some or for every one is not said");
        Some((equation.at.0, problem))
    })
}

/// The integers in these equations of which neither what is `given` speaks, nor a condition `beside` them that has other
/// letters.
pub(super) fn integers_alone(
    equations: &[Equation],
    [beside, given]: [&[(Condition, Source)]; 2],
    symbols: &Symbols,
) -> Vec<Name> {
    let said = |(condition, _): &(Condition, Source)| match condition {
        Condition::Integer(Tree::Symbol(name, _)) => Some(name.clone()),
        _ => None,
    };
    let mut integers: Vec<Name> = symbols.integers().cloned().collect();
    integers.extend(beside.iter().chain(given).filter_map(said));
    let letters = |trees: &[&Tree]| -> HashSet<Name> { trees.iter().flat_map(|tree| letters_of(tree)).collect() };
    let mut known: HashSet<Name> = HashSet::new();
    for (condition, _) in given {
        known.extend(letters(&condition.sides()));
    }
    for (condition, _) in beside {
        let own = letters(&condition.sides());
        known.extend(if own.len() > 1 { own } else { HashSet::new() });
    }
    let sides: Vec<&Tree> = equations
        .iter()
        .flat_map(|equation| [&equation.left, &equation.right])
        .collect();
    let stated = letters(&sides);
    integers.retain(|name| stated.contains(name) && !known.contains(name));
    integers
}

/// Where a claim gives a letter two values, and why that cannot be read: authors list solutions so.
pub(super) fn listed_values(equations: &[Equation]) -> Option<(usize, String)> {
    let is_value = |tree: &Tree| {
        !any(tree, &mut |node| match node {
            Tree::Symbol(name, _) => !is_constant(name),
            node => matches!(
                node,
                Tree::Call(..) | Tree::Operation(..) | Tree::PlusMinus(_) | Tree::MinusPlus(_)
            ),
        })
    };
    let values: Vec<(&Name, &Tree, usize)> = equations
        .iter()
        .filter_map(|equation| gives(equation).map(|(name, value)| (name, value, equation.at.0)))
        .filter(|(_, value, _)| is_value(value))
        .collect();
    values.iter().enumerate().find_map(|(place, (name, value, at))| {
        let is_other = |(other, before, _): &&(&Name, &Tree, usize)| other == name && before != value;
        let (_, before, _) = values.get(..place)?.iter().find(is_other)?;
        let problem = format!("`{name}` is `{before}` and `{value}`: give each value an entry of its own, or claim the equation that both solve");
        Some((*at, problem))
    })
}

/// Whether an equation has `\pm` on one side, and no symbol on the other whose subscript says that two are meant; or says
/// `\pm a = \pm b`, whose signs may go apart.
pub(super) fn has_one_sided_sign(equation: &Equation) -> bool {
    let is_for_both = |side: &Tree| {
        any(
            side,
            &mut |node| matches!(node, Tree::Symbol(name, _) if name.subscript.contains(',')),
        )
    };
    match (has_sign(&equation.left), has_sign(&equation.right)) {
        (true, false) => !is_for_both(&equation.right),
        (false, true) => !is_for_both(&equation.left),
        (true, true) => [&equation.left, &equation.right].into_iter().all(is_signed),
        _ => false,
    }
}

/// Whether a sign stands before all of a side.
fn is_signed(side: &Tree) -> bool {
    matches!(side, Tree::PlusMinus(_) | Tree::MinusPlus(_))
}

/// The words between equations of which one holds.
const OR: [&str; 4] = ["\\text", "\\mbox", "\\textrm", "\\mathrm"];

/// The parts of a formula between the words "or", each at its place; one where there is no such word.
fn parts(tex: &str) -> Vec<String> {
    let mut cuts: Vec<(usize, usize)> = Vec::new();
    for (at, command) in OR.iter().flat_map(|command| tex.match_indices(command)) {
        let inside = tex
            .get(at + command.len()..)
            .and_then(|rest| rest.strip_prefix('{')?.split_once('}'));
        if let Some((word, _)) =
            inside.filter(|(word, _)| word.trim_matches(|c: char| c.is_whitespace() || c == ',') == "or")
        {
            cuts.push((at, at + command.len() + word.len() + 2));
        }
    }
    cuts.extend(
        ["\\lor", "\\vee", "\u{2228}"]
            .iter()
            .flat_map(|sign| tex.match_indices(sign))
            .map(|(at, sign)| (at, at + sign.len())),
    );
    cuts.sort_unstable();
    let starts = std::iter::once(0).chain(cuts.iter().map(|(_, end)| *end));
    let ends = cuts.iter().map(|(start, _)| *start).chain([tex.len()]);
    let parts = starts
        .zip(ends)
        .filter_map(|(start, end)| Some(" ".repeat(start) + tex.get(start..end)?));
    parts.collect()
}

/// The parts of an equation that may have no value somewhere.
fn partial(equation: &Equation) -> HashSet<Tree> {
    let mut found = HashSet::new();
    for side in [&equation.left, &equation.right] {
        any(side, &mut |node| {
            let is_number = |tree: &Tree| matches!(tree, Tree::Number(_));
            let part = match node {
                Tree::Quotient(_, below, _) if !is_number(below) => Some(below.as_ref()),
                Tree::Power(_, ..0, _) | Tree::RealPower(..) | Tree::Operation(..) => Some(node),
                Tree::Root(of, ..) if !is_number(of) => Some(node),
                Tree::Call(name, ..)
                    if name.base.starts_with('\\') && !Elementary::named(name).is_some_and(Elementary::is_total) =>
                {
                    Some(node)
                }
                _ => None,
            };
            found.extend(part.cloned());
            false
        });
    }
    found
}

/// The equation that holds where one of several does: the product of their differences is 0. `None` where one of them may
/// have no value while another holds.
fn one_of(equations: Vec<Equation>) -> Option<Equation> {
    let mut partial = equations.iter().map(partial);
    let first = partial.next()?;
    if partial.any(|other| other != first) {
        return None;
    }
    let ends = [equations.first()?.at, equations.last()?.end];
    let difference = |equation: Equation| Tree::Sum(vec![equation.left, Tree::Negate(Box::new(equation.right))]);
    Some(Equation {
        at: ends[0],
        end: ends[1],
        ..Equation::between(
            Tree::Product(equations.into_iter().map(difference).collect()),
            Tree::Number(Rational::from_integer(0)),
        )
    })
}

/// What a formula states.
pub(super) struct Stated {
    pub display: Display,
    /// The equations of which its one equation says that one holds; none where it says all that it prints.
    pub alternatives: Vec<Equation>,
}

/// What a formula states; of "A or B", and of `x = \pm y` where `is_implied`, one equation.
///
/// # Errors
/// What cannot be read, and alternatives that are not one equation each.
pub(super) fn stated_of(source: &Source, names: &Names, is_implied: bool) -> Result<Stated, Fault> {
    let mut alternatives = Vec::new();
    let fault = |error: ReadError| source.misread(&error);
    let parts = parts(&source.tex);
    let mut display = match parts.as_slice() {
        [_] => read_display(&source.tex, names).map_err(fault)?,
        parts => {
            let mut equations = Vec::new();
            for part in parts {
                let mut display = read_display(part, names).map_err(fault)?;
                let is_one = display.equations.len() == 1 && display.beside.is_empty() && display.conditions.is_empty();
                match display
                    .equations
                    .pop()
                    .filter(|equation| is_one && equation.relation == Relation::Equal)
                {
                    Some(equation) => equations.push(equation),
                    None => {
                        let at = part.len() - part.trim_start().len();
                        return Err(source.fault(at, "\"or\" is read between single equations"));
                    }
                }
            }
            if equations
                .iter()
                .any(|equation| has_sign(&equation.left) || has_sign(&equation.right))
            {
                return Err(source.fault(0, "\"or\" between equations with `\\pm` is not read"));
            }
            let problem = "where one of these has no value another may hold: multiply by what may be 0, or give each an entry of its own";
            alternatives.clone_from(&equations);
            let one = one_of(equations).ok_or_else(|| source.fault(0, problem))?;
            Display {
                equations: vec![one],
                ..Display::default()
            }
        }
    };
    if let ([equation], true) = (display.equations.as_slice(), is_implied)
        && equation.relation == Relation::Equal
        && has_one_sided_sign(equation)
        && [&equation.left, &equation.right].map(signs).iter().sum::<usize>() == 1
    {
        let both = [true, false].map(|upper| Equation {
            left: with_sign(&equation.left, upper),
            right: with_sign(&equation.right, upper),
            ..equation.clone()
        });
        // within a sum or an integral the sign stays, and says nothing
        let is_clear = both.iter().all(|one| signs(&one.left) + signs(&one.right) == 0);
        if let Some(one) = one_of(both.to_vec()).filter(|_| is_clear) {
            alternatives = both.to_vec();
            display.equations = vec![one];
        }
    }
    Ok(Stated { display, alternatives })
}

/// How many `\pm` and `\mp` stand in a tree.
fn signs(tree: &Tree) -> usize {
    let mut count = 0;
    any(tree, &mut |node| {
        count += usize::from(matches!(node, Tree::PlusMinus(_) | Tree::MinusPlus(_)));
        false
    });
    count
}

/// Where one of these equations may have no value although one of the alternatives that are assumed holds.
pub(super) fn unseen(equations: &[Equation], alternatives: &[Equation]) -> Option<usize> {
    let seen = partial(alternatives.first()?);
    let is_seen = |equation: &&Equation| partial(equation).is_subset(&seen);
    let at = |equation: &Equation| equation.at.0;
    equations.iter().find(|equation| !is_seen(equation)).map(at)
}

/// What the side of an implication assumes that stands before it, and the alternatives of which one is assumed.
///
/// # Errors
/// As [`stated_of`].
pub(super) fn assumed(source: &Source, names: &Names) -> Result<(Vec<Condition>, Vec<Equation>), Fault> {
    let is_plain = parts(&source.tex).len() == 1 && !source.tex.contains("\\pm");
    if is_plain {
        let read = read_conditions(&source.tex, names);
        return read
            .map(|conditions| (conditions, Vec::new()))
            .map_err(|error| source.misread(&error));
    }
    let Stated { display, alternatives } = stated_of(source, names, true)?;
    let stated = display
        .equations
        .into_iter()
        .chain(display.beside)
        .map(Condition::Relation);
    Ok((stated.chain(display.conditions).collect(), alternatives))
}

#[cfg(test)]
mod tests {
    #[test]
    fn alternatives_stand_between_the_words_or() {
        let parts =
            |tex: &str| -> Vec<String> { super::parts(tex).iter().map(|part| part.trim().to_owned()).collect() };
        assert_eq!(
            parts(r"x = 1 \quad \text{ or } \quad x = 2"),
            [r"x = 1 \quad", r"\quad x = 2"]
        );
        assert_eq!(parts(r"a = b \lor a = c \mbox{or} a = 0"), ["a = b", "a = c", "a = 0"]);
        assert_eq!(parts(r"\text{for} = a"), [r"\text{for} = a"]);
    }
}
