//! Repairs as edits of the text that prints the formula: what the formula does not say (labels, alignment, comments) stays.

use crate::claim::{Sheet, Source};
use crate::repair::{Part, Repair};
use crate::tex::{Equation, Relation};
use std::ops::Range;

/// New text in place of old text, between places of line and column, from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replacement {
    pub start: (usize, usize),
    /// The place behind the last character.
    pub end: (usize, usize),
    pub old: String,
    pub new: String,
}

/// Returns a repair of the claim at a position as edits of `text`, in which it is printed; `None` if an edit would take out more
/// than the formula, such as a label or a comment within it.
pub fn replacements(sheet: &Sheet, position: usize, repair: &Repair, text: &str) -> Option<Vec<Replacement>> {
    let entry = sheet.entries.get(position)?;
    let mut replacements = Vec::new();
    for (part, mended) in &repair.mended {
        let (equation, source): (&Equation, &Source) = match part {
            Part::Stated(n) => (entry.equations.get(*n)?, &entry.tex),
            Part::Definition(n) => entry.local.get(*n).map(|(equation, source)| (equation, source))?,
        };
        let (start, end) = (equation.at.0, equation.end.0);
        // a link of a chain shares a side with another; a definition has a text of its own
        let shares = |other: &Equation| {
            let is_beside = matches!(part, Part::Stated(_)) && !std::ptr::eq(other, equation);
            is_beside && other.at.0 < end && start < other.end.0
        };
        if source.file.is_some() || entry.equations.iter().any(shares) || end <= start {
            return None;
        }
        for (range, new) in changed(&source.tex, start..end, equation, mended)? {
            replacements.push(replacement(source, text, range, new)?);
        }
    }
    (!replacements.is_empty()).then_some(replacements)
}

/// The sides that a repair changes, each by itself if the sign of equality between them is found, else the whole formula.
fn changed(
    tex: &str,
    range: Range<usize>,
    equation: &Equation,
    mended: &Equation,
) -> Option<Vec<(Range<usize>, String)>> {
    let whole = || Some(vec![(trimmed(tex, range.clone())?, mended.to_string())]);
    let printed = tex.get(range.clone())?;
    let is_equality = equation.relation == Relation::Equal && mended.relation == Relation::Equal;
    let Some(at) = equality(printed).filter(|_| is_equality) else {
        return whole();
    };
    let sign = range.start + at;
    let sides = [
        (range.start..sign, &equation.left, &mended.left),
        (sign + 1..range.end, &equation.right, &mended.right),
    ];
    let mut edits = Vec::new();
    for (side, old, new) in sides {
        if old.to_string() != new.to_string() {
            edits.push((trimmed(tex, side)?, new.to_string()));
        }
    }
    if edits.is_empty() { whole() } else { Some(edits) }
}

/// The place of the one sign of equality that stands in no brackets.
fn equality(tex: &str) -> Option<usize> {
    let (mut depth, mut found) = (0_i32, Vec::new());
    for (at, c) in tex.char_indices() {
        match c {
            '{' | '(' | '[' => depth += 1,
            '}' | ')' | ']' => depth -= 1,
            '=' if depth == 0 => found.push(at),
            _ => {}
        }
    }
    match found.as_slice() {
        [one] if depth == 0 => Some(*one),
        _ => None,
    }
}

/// The range without blanks at its ends; `None` if nothing else is there.
fn trimmed(tex: &str, range: Range<usize>) -> Option<Range<usize>> {
    let own = tex.get(range.clone())?;
    let start = range.start + (own.len() - own.trim_start().len());
    let end = range.start + own.trim_end().len();
    (start < end).then_some(start..end)
}

/// Commands that size a bracket; they belong to the formula that begins with the bracket.
const SIZES: [&str; 10] = [
    r"\left", r"\mleft", r"\bigl", r"\Bigl", r"\biggl", r"\Biggl", r"\big", r"\Big", r"\bigg", r"\Bigg",
];

fn replacement(source: &Source, text: &str, range: Range<usize>, new: String) -> Option<Replacement> {
    let read = source.tex.get(range.clone())?;
    let (start, end) = (source.place_of(range.start)?, source.place_of(range.end)?);
    let [mut first, last] = [byte_of(text, start)?, byte_of(text, end)?];
    // blanks stand where something was passed over; where it stood between words of the formula, it would be lost
    let own = |text: &str| text.chars().filter(|c| !c.is_whitespace()).collect::<String>();
    if own(text.get(first..last)?) != own(read) {
        return None;
    }
    let before = text.get(..first)?;
    let begins_with_bracket = read.starts_with(['(', '[', '|', '.', '\\']);
    let size = SIZES
        .iter()
        .find(|size| begins_with_bracket && before.ends_with(**size));
    let length = size.map_or(0, |size| size.len());
    first -= length;
    let old = text.get(first..last)?;
    is_balanced(old).then(|| Replacement {
        start: (start.0, start.1 - length),
        end,
        old: old.to_owned(),
        new,
    })
}

/// The byte of a text at a place of line and column, from 1.
fn byte_of(text: &str, (line, column): (usize, usize)) -> Option<usize> {
    let mut start = 0;
    for _ in 1..line {
        start += text.get(start..)?.find('\n')? + 1;
    }
    let rest = text.get(start..)?;
    let own = rest.split('\n').next().unwrap_or_default();
    let mut places = own.char_indices().map(|(at, _)| at).chain([own.len()]);
    places.nth(column.checked_sub(1)?).map(|at| start + at)
}

/// Returns true if each brace, and each `\left`, is closed within the text.
fn is_balanced(text: &str) -> bool {
    let mut braces = 0_i32;
    for (at, c) in text.char_indices() {
        let is_escaped = text.get(..at).is_some_and(|before| before.ends_with('\\'));
        match c {
            '{' if !is_escaped => braces += 1,
            '}' if !is_escaped => braces -= 1,
            _ => {}
        }
        if braces < 0 {
            return false;
        }
    }
    let count = |word: &str| {
        let ends = text.match_indices(word).map(|(at, _)| at + word.len());
        ends.filter(|&end| {
            !text
                .get(end..)
                .is_some_and(|rest| rest.starts_with(char::is_alphabetic))
        })
        .count()
    };
    braces == 0 && count(r"\left") == count(r"\right") && count(r"\begin") == count(r"\end")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_between_two_sides_is_found() {
        assert_eq!(equality("a (b = c) = d"), Some(10));
        assert_eq!(equality("a = b = c"), None);
        assert_eq!(equality("a) = (b"), None);
    }

    #[test]
    fn what_is_cut_through_a_pair_is_no_edit() {
        assert!(is_balanced(r"\left( x \right)^{2} \leftarrow"));
        for text in [r"( x \right)^2", "a}", "}{", r"\left( x"] {
            assert!(!is_balanced(text), "{text}");
        }
        assert!(is_balanced(r"\{ x"));
    }

    #[test]
    fn places_are_counted_in_characters() {
        assert_eq!(byte_of("é\nüx", (2, 2)), Some(5));
        assert_eq!(byte_of("a\n", (2, 1)), Some(2));
        assert_eq!(byte_of("a", (1, 3)), None);
    }
}
