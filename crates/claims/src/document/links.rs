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

/// The most links that a formula is parted into.
const MOST: usize = 100;

/// Parts each chain `A = B = C` into `A = B` and its link `B = C`; `text` is what the formulas stand in.
pub(super) fn parted(formulas: Vec<Formula>, text: &str) -> Vec<Formula> {
    let mut all: Vec<Formula> = Vec::with_capacity(formulas.len());
    // where each display begins in what is made
    let mut firsts: Vec<usize> = Vec::with_capacity(formulas.len());
    for formula in formulas {
        firsts.push(all.len());
        let first = firsts.get(formula.first).copied().unwrap_or_default();
        let tex = formula.tex.as_deref().unwrap_or_default();
        let links = links(tex);
        if links.len() < 2 {
            all.push(Formula { first, ..formula });
            continue;
        }
        // a macro that was replaced shifts what stands behind it
        let is_as_printed = text.get(formula.part.clone()) == Some(tex);
        for (number, link) in links.into_iter().enumerate() {
            let part = match is_as_printed {
                true => formula.part.start + link.start..formula.part.start + link.end,
                false => formula.part.clone(),
            };
            all.push(Formula {
                part,
                tex: Ok(tex.get(link).unwrap_or_default().to_owned()),
                is_link: number > 0 || formula.is_link,
                goes_with_last: number > 0 || formula.goes_with_last,
                first,
                ..formula.clone()
            });
        }
    }
    all
}

/// The links of a formula: of each the sides and what stands behind the last one.
fn links(tex: &str) -> Vec<Range<usize>> {
    let mut relations: Vec<Range<usize>> = Vec::new();
    for met in outside(tex, 0..tex.len()) {
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
    let side = |number: usize| relations.get(number).map_or(tex.len(), |relation| relation.start);
    let start = |number: usize| {
        number
            .checked_sub(1)
            .and_then(|before| relations.get(before))
            .map_or(0, |relation| relation.end)
    };
    (0..count)
        .map(|number| {
            let end = if number + 1 == count {
                tex.len()
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
        links(tex).into_iter().map(|link| tex[link].trim()).collect()
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
    fn what_is_no_chain_is_left_whole() {
        for whole in [r"a = b \Rightarrow c = d", r"a = b \approx c", r"a = b \\ c = d = e"] {
            assert!(shown(whole).is_empty(), "{whole}");
        }
    }
}
