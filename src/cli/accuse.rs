//! Accuses formulas of documents without comments: they fail, and a slip of the pen explains it.

use crate::claim::{Entry, Role, Sheet, Standing, Verdict};
use crate::prove::{self, Decision};
use crate::repair::{Repair, Repairs, slips};
use crate::tex::{Equation, Name, Operation, Relation, Tree, any_side, is_opaque, names_in};
use std::collections::BTreeSet;

/// The most slips of a misprint in a formula with the same letters on both sides; in any other there is one at most.
const MOST_SLIPS: usize = 2;

/// The most repairs of a formula that are looked at.
const MOST_REPAIRS: usize = 6;

/// The fewest letters that are printed in an equation with a number on one side which claims something outside a chain.
const FEWEST_LETTERS: usize = 8;

/// Returns true if a formula may be misprinted: a link of a chain, an equation with the same letters on both sides, or a long one
/// with a number on one side, that fails where nothing else may be meant.
pub fn may_be_misprinted(entry: &Entry, decision: &Decision) -> bool {
    let is_claimed = match decision.standing {
        Standing::Said => false,
        Standing::Link => true,
        _ => have_one_set_of_letters(&entry.equations) || entry.equations.iter().all(is_long_and_a_number),
    };
    decision.fails && is_claimed && !entry.equations.is_empty() && !is_loose(entry)
}

/// Returns the repairs of the claim at a position with those first that show a misprint, first of all those with which the links
/// beside it hold; nothing where none shows one.
pub fn misprints(sheet: &Sheet, position: usize, repairs: Repairs, options: &prove::Options) -> Option<Repairs> {
    let entry = sheet.entries.get(position)?;
    let mut found = repairs.found;
    let others = found.split_off(found.len().min(MOST_REPAIRS));
    let (mut shown, rest): (Vec<Repair>, Vec<Repair>) = found
        .into_iter()
        .partition(|repair| is_misprint(sheet, position, entry, repair, options));
    let holds_by_more = || {
        let mut more = sheet.with_more_said(position);
        more.any(|sheet| !prove::decide(&sheet, position, options).fails)
    };
    if shown.is_empty() || holds_by_more() {
        return None;
    }
    shown.sort_by_cached_key(|repair| std::cmp::Reverse(links_beside(sheet, position, entry, repair, options).len()));
    Some(Repairs {
        found: [shown, rest, others].concat(),
        ..repairs
    })
}

/// Returns true if a repair shows a misprint: so few slips of the pen that both sides have the same letters, or an identity; else a
/// premise is missing.
fn is_misprint(sheet: &Sheet, position: usize, entry: &Entry, repair: &Repair, options: &prove::Options) -> bool {
    let ([printed], [(_, mended)]) = (entry.equations.as_slice(), repair.mended.as_slice()) else {
        return false;
    };
    let most = match have_one_set_of_letters([printed]) {
        true => MOST_SLIPS,
        false => 1,
    };
    // a small term may be left out for good, but not between two sides that have it; and letters may be equal by what the text says
    let needs_sides = slips(printed, mended, false).is_none() || repair.swaps_letters();
    let are_slips = slips(printed, mended, true).is_some_and(|slips| slips <= most)
        && (!needs_sides || links_beside(sheet, position, entry, repair, options).contains(&true));
    let is_link_of_its_letters = || {
        entry.standing == Standing::Link
            && (have_one_set_of_letters([mended])
                || (keeps_letters(printed, mended) && are_one_by_definitions(sheet, entry, mended)))
    };
    are_slips && (is_link_of_its_letters() || is_identity(sheet, position, mended, options))
}

/// Returns true if an equation is proved from nothing in the place of the claim at a position.
fn is_identity(sheet: &Sheet, position: usize, equation: &Equation, options: &prove::Options) -> bool {
    let alone = sheet.reprinted(position, &format!("{} = {}", equation.left, equation.right), &[]);
    alone.is_some_and(|mut alone| {
        if let Some(entry) = alone.entries.get_mut(position) {
            entry.follows_from.clear();
        }
        prove::decide(&alone, position, options).verdict == Verdict::Proved
    })
}

/// Returns the links before and behind one of a chain that hold once it is repaired, each by whether the side that it shares is
/// one that the repair changes.
fn links_beside(sheet: &Sheet, position: usize, entry: &Entry, repair: &Repair, options: &prove::Options) -> Vec<bool> {
    let ([printed], [(_, mended)]) = (entry.equations.as_slice(), repair.mended.as_slice()) else {
        return Vec::new();
    };
    let link = |at: usize| match sheet.entries.get(at)?.equations.as_slice() {
        [link] => Some((at, link)),
        _ => None,
    };
    let before = position
        .checked_sub(1)
        .and_then(link)
        .filter(|(_, link)| link.right == printed.left)
        .map(|(at, link)| {
            let is_changed = printed.left != mended.left;
            (at, format!("{} = {}", link.left, mended.left), is_changed)
        });
    let behind = link(position + 1)
        .filter(|(_, link)| link.left == printed.right)
        .map(|(at, link)| {
            let is_changed = printed.right != mended.right;
            (at, format!("{} = {}", mended.right, link.right), is_changed)
        });
    let links = before.into_iter().chain(behind);
    let links = links.filter(|(at, tex, _)| holds_as(sheet, *at, tex, options));
    links.map(|(.., is_changed)| is_changed).collect()
}

/// Returns true if the claim at a position is proved with other TeX in its place.
pub fn holds_as(sheet: &Sheet, position: usize, tex: &str, options: &prove::Options) -> bool {
    let again = sheet.reprinted(position, tex, &[]);
    again.is_some_and(|again| prove::decide(&again, position, options).verdict == Verdict::Proved)
}

/// Returns true if one side is a number, and the other so long that one slip makes an identity of few of its like.
fn is_long_and_a_number(equation: &Equation) -> bool {
    let is_number = |side: &Tree| matches!(side, Tree::Number(_));
    let mut printed = 0;
    any_side(equation, &mut |node| {
        printed += usize::from(matches!(node, Tree::Symbol(..)));
        false
    });
    printed >= FEWEST_LETTERS && (is_number(&equation.left) || is_number(&equation.right))
}

/// Returns the letters of a side.
fn letters(side: &Tree) -> BTreeSet<Name> {
    let mut names = BTreeSet::new();
    names_in(side, &mut names);
    names
}

/// Returns true if no letter of a side is gone from it.
fn keeps_letters(printed: &Equation, mended: &Equation) -> bool {
    letters(&printed.left).is_subset(&letters(&mended.left))
        && letters(&printed.right).is_subset(&letters(&mended.right))
}

/// Returns true if both sides of an equation have the same letters once the definitions that it rests on are put in, and these are
/// all that it rests on.
fn are_one_by_definitions(sheet: &Sheet, entry: &Entry, equation: &Equation) -> bool {
    let definition = |&at: &usize| match sheet.entries.get(at)? {
        Entry {
            role: Role::Definition,
            equations,
            ..
        } => match equations.as_slice() {
            [
                Equation {
                    left: Tree::Symbol(name, _),
                    right,
                    ..
                },
            ] => Some((name.clone(), letters(right))),
            _ => None,
        },
        _ => None,
    };
    // conditions give nothing
    let gives = |at: &&usize| {
        let own = sheet.entries.get(**at);
        own.is_none_or(|own| {
            own.equations
                .iter()
                .any(|equation| equation.relation == Relation::Equal)
        })
    };
    let below = entry.follows_from.iter().filter(gives);
    let definitions: Option<Vec<(Name, BTreeSet<Name>)>> = below.map(definition).collect();
    let Some(definitions) = definitions.filter(|definitions| !definitions.is_empty()) else {
        return false;
    };
    let put_in = |side: &Tree| {
        let mut own = letters(side);
        // each once, as no definition rests on itself
        for _ in &definitions {
            for (name, of) in &definitions {
                if own.remove(name) {
                    own.extend(of.iter().cloned());
                }
            }
        }
        own
    };
    put_in(&equation.left) == put_in(&equation.right)
}

/// Returns true if both sides of each equation have the same letters, as most links of chains have.
fn have_one_set_of_letters<'e>(equations: impl IntoIterator<Item = &'e Equation>) -> bool {
    let mut equations = equations.into_iter();
    equations.all(|equation| letters(&equation.left) == letters(&equation.right))
}

/// Returns true for a formula that may be right although it fails: one with rounded numbers, an inequality, where letters may be
/// bounded, one with a constant that takes in what is added to it, one with an angle of so many turns, and a product of vectors,
/// which numbers do not show to be wrong.
fn is_loose(entry: &Entry) -> bool {
    let figures: Vec<char> = entry.tex.tex.chars().collect();
    let is_rounded = figures
        .windows(3)
        .any(|three| three[0].is_ascii_digit() && three[1] == '.' && three[2].is_ascii_digit());
    let is_letter =
        |tree: &Tree, letters: &[&str]| matches!(tree, Tree::Symbol(name, _) if letters.contains(&name.base.as_str()));
    // what is not understood may be anything
    let is_term = |node: &Tree| matches!(node, Tree::Symbol(name, _) if is_opaque(name));
    let is_of_vectors =
        |node: &Tree| matches!(node, Tree::Operation(operation, _) if matches!(**operation, Operation::Cross(..)));
    let counts_turns = |node: &Tree| match node {
        Tree::Product(factors) => {
            factors.iter().any(|factor| is_letter(factor, &[r"\pi"]))
                && factors
                    .iter()
                    .any(|factor| is_letter(factor, &["n", "m", "k", "l", "j"]))
        }
        _ => false,
    };
    let is_loose = |equation: &Equation| {
        equation.relation != Relation::Equal
            || any_side(equation, &mut |node| {
                counts_turns(node) || is_letter(node, &["C"]) || is_term(node) || is_of_vectors(node)
            })
    };
    is_rounded || entry.tex.tex.contains(r"\equiv") || entry.need_not_hold || entry.equations.iter().any(is_loose)
}
