//! The links of a chain on one line, each a formula of its own, as the rows of a display are.

use super::scan::Formula;
use super::tex::{Outside, outside};
use std::ops::Range;

/// The relations of a chain of which each link is judged by itself.
const LINKING: [&str; 16] = [
    "=",
    ":=",
    "≡",
    "<",
    ">",
    "≤",
    "≥",
    r"\equiv",
    r"\le",
    r"\leq",
    r"\leqslant",
    r"\ge",
    r"\geq",
    r"\geqslant",
    r"\lt",
    r"\gt",
];

/// The arrows from what is given to what follows.
const IMPLYING: [&str; 6] = [
    r"\Rightarrow",
    r"\implies",
    r"\Longrightarrow",
    r"\Leftrightarrow",
    r"\iff",
    r"\Longleftrightarrow",
];

/// The most links that a formula is parted into.
const MOST: usize = 100;

/// Parts each chain `A = B = C` into `A = B` and its link `B = C`, and `A = B \Rightarrow C = D \Rightarrow E = F` into what it
/// states, each implied by the one before; `text` is what the formulas stand in. One implication between two equations stays
/// whole: what it assumes may hold nowhere else.
pub(super) fn parted(formulas: Vec<Formula>, text: &str) -> Vec<Formula> {
    let mut all: Vec<Formula> = Vec::with_capacity(formulas.len());
    // where each display begins in what is made
    let mut firsts: Vec<usize> = Vec::with_capacity(formulas.len());
    // the formulas of the last statement
    let mut last = 0..0;
    let mut formulas = formulas.into_iter().peekable();
    while let Some(formula) = formulas.next() {
        firsts.push(all.len());
        let first = firsts.get(formula.first).copied().unwrap_or_default();
        let tex = formula.tex.as_deref().unwrap_or_default();
        let (is_implied, statements) = statements(tex);
        let parts: Vec<Vec<Range<usize>>> = statements.iter().map(|own| links(tex, own.clone())).collect();
        // what it states is given to the next
        let leads = formulas
            .peek()
            .is_some_and(|next| next.tex.as_deref().is_ok_and(begins_with_arrow));
        let is_whole = !is_implied
            && match parts.as_slice() {
                [one] => one.len() < 2,
                [one, other] => one.len() < 2 && other.len() < 2 && !leads,
                _ => false,
            };
        if is_whole {
            last = all.len()..all.len() + 1;
            all.push(Formula { first, ..formula });
            continue;
        }
        // a macro that was replaced shifts what stands behind it
        let is_as_printed = text.get(formula.part.clone()) == Some(tex);
        let mut implied_by = if is_implied { last.clone() } else { 0..0 };
        let (mut is_first, mut is_assumed) = (true, !is_implied && statements.len() > 1);
        for (statement, links) in statements.into_iter().zip(parts) {
            let start = all.len();
            let links = if links.is_empty() { vec![statement] } else { links };
            for (number, link) in links.into_iter().enumerate() {
                let part = match is_as_printed {
                    true => formula.part.start + link.start..formula.part.start + link.end,
                    false => formula.part.clone(),
                };
                all.push(Formula {
                    part,
                    tex: Ok(tex.get(link).unwrap_or_default().to_owned()),
                    is_link: number > 0 || (is_first && formula.is_link),
                    goes_with_last: !is_first || formula.goes_with_last,
                    implied_by: implied_by.clone(),
                    is_assumed,
                    first,
                    ..formula.clone()
                });
                is_first = false;
            }
            implied_by = start..all.len();
            is_assumed = false;
        }
        last = implied_by;
    }
    all
}

fn begins_with_arrow(tex: &str) -> bool {
    statements(tex).0
}

/// The statements that arrows of implication part, and true if an arrow stands before the first.
fn statements(tex: &str) -> (bool, Vec<Range<usize>>) {
    let mut bounds = vec![0];
    for met in outside(tex, 0..tex.len()) {
        if let Outside::Relation(at) = met
            && tex.get(at.clone()).is_some_and(|sign| IMPLYING.contains(&sign))
        {
            bounds.extend([at.start, at.end]);
        }
    }
    bounds.push(tex.len());
    let all: Vec<Range<usize>> = bounds
        .chunks_exact(2)
        .filter_map(|pair| match pair {
            [start, end] => Some(printed(tex, *start..*end)),
            _ => None,
        })
        .collect();
    match all.as_slice() {
        [before, behind, ..] if before.is_empty() && behind.end > behind.start => (true, all[1..].to_vec()),
        _ => (false, all),
    }
}

/// A part of a formula without the blanks at its ends.
fn printed(tex: &str, mut part: Range<usize>) -> Range<usize> {
    loop {
        let own = tex.get(part.clone()).unwrap_or_default();
        let before = part.clone();
        part.start += own.len() - own.trim_start().len();
        let own = tex.get(part.clone()).unwrap_or_default();
        part.end -= own.len() - own.trim_end().len();
        let own = tex.get(part.clone()).unwrap_or_default();
        for blank in [r"\qquad", r"\quad", r"\;", r"\,", r"\ "] {
            let is_word = |rest: &str| rest.starts_with(|c: char| c.is_ascii_alphabetic());
            if own.strip_prefix(blank).is_some_and(|rest| !is_word(rest)) {
                part.start += blank.len();
                break;
            }
            if own.ends_with(blank) {
                part.end -= blank.len();
                break;
            }
        }
        if part == before {
            return part;
        }
    }
}

/// The links of a statement: of each the sides and what stands behind the last one.
fn links(tex: &str, statement: Range<usize>) -> Vec<Range<usize>> {
    let mut relations: Vec<Range<usize>> = Vec::new();
    for met in outside(tex, statement.clone()) {
        match met {
            Outside::Relation(at) if tex.get(at.clone()).is_some_and(|sign| LINKING.contains(&sign)) => {
                relations.push(at)
            }
            Outside::Relation(_) | Outside::Row(_) => return Vec::new(),
            // what stands behind is of the last link
            Outside::Comma(_) => break,
            Outside::Command(at) => match tex.get(at).unwrap_or_default() {
                r"\quad" | r"\qquad" | r"\text" | r"\mbox" | r"\textrm" | r"\textit" => break,
                r"\forall" | r"\rightarrow" | r"\leftrightarrow" | r"\stackrel" | r"\overset" | r"\underset" => {
                    return Vec::new();
                }
                _ => {}
            },
            Outside::Column(_) => {}
        }
    }
    if relations.len() > MOST {
        return Vec::new();
    }
    let count = relations.len();
    let side = |number: usize| relations.get(number).map_or(statement.end, |relation| relation.start);
    let start = |number: usize| {
        number
            .checked_sub(1)
            .and_then(|before| relations.get(before))
            .map_or(statement.start, |relation| relation.end)
    };
    (0..count)
        .map(|number| {
            let end = if number + 1 == count {
                statement.end
            } else {
                side(number + 1)
            };
            start(number)..end
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(tex: &str) -> Vec<&str> {
        links(tex, 0..tex.len())
            .into_iter()
            .map(|link| tex[link].trim())
            .collect()
    }

    #[test]
    fn each_link_has_two_sides_and_the_last_what_stands_behind() {
        assert_eq!(
            shown("y = a (b = c) = 2 < 3, x > 0"),
            ["y = a (b = c)", "a (b = c) = 2", "2 < 3, x > 0"]
        );
        assert_eq!(shown("y = a"), ["y = a"]);
    }

    #[test]
    fn arrows_part_what_follows_from_each_other() {
        let shown = |tex: &str| {
            let (is_implied, all) = statements(tex);
            (
                is_implied,
                all.into_iter().map(|own| tex[own].to_owned()).collect::<Vec<_>>(),
            )
        };
        let of = |all: &[&str]| all.iter().map(|own| (*own).to_owned()).collect::<Vec<_>>();
        assert_eq!(
            shown(r"a = b \quad\Rightarrow\quad c = d \iff e = f"),
            (false, of(&["a = b", "c = d", "e = f"]))
        );
        assert_eq!(shown(r"\Rightarrow c = d"), (true, of(&["c = d"])));
        assert_eq!(shown(r"a = b"), (false, of(&["a = b"])));
    }

    #[test]
    fn what_is_no_chain_is_left_whole() {
        for whole in [r"a = b \Rightarrow c = d", r"a = b \approx c", r"a = b \\ c = d = e"] {
            assert!(shown(whole).is_empty(), "{whole}");
        }
    }
}
