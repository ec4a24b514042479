//! The links of a chain on one line, each a formula of its own, as the rows of a display are.

use super::scan::{Aside, Formula};
use super::tex::{Outside, outside};
use std::collections::HashSet;
use std::ops::Range;
use texmath::{Names, Related, letters, read_name, related};

/// Returns true for a relation of a chain of which each link is judged by itself.
fn is_linking(sign: &str) -> bool {
    matches!(related(sign), Some(Related::Equal | Related::Ordered))
}

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

/// Parts each chain `A = B = C` into `A = B` and its link `B = C`, and `A \Rightarrow B = C \Leftrightarrow D` into `A \Rightarrow B`, `B = C` and
/// `B = C \Leftrightarrow D`; what an arrow begins follows from the last formula. `text` is what the formulas stand in.
pub(super) fn parted(formulas: Vec<Formula>, text: &str) -> Vec<Formula> {
    let mut all: Vec<Formula> = Vec::with_capacity(formulas.len());
    // where each display begins in what is made
    let mut firsts: Vec<usize> = Vec::with_capacity(formulas.len());
    // the link that is stated last
    let mut last = String::new();
    let mut met: HashSet<String> = HashSet::new();
    for formula in formulas {
        firsts.push(all.len());
        if formula.is_aside {
            let first = all.len();
            all.push(Formula { first, ..formula });
            continue;
        }
        let first = firsts.get(formula.first).copied().unwrap_or_default();
        let tex = formula.tex.as_deref().unwrap_or_default();
        // a macro that was replaced shifts what stands behind it
        let is_as_printed = text.get(formula.part.clone()) == Some(tex);
        let parts = definitions_first(tex, parts(tex, &last), &met);
        met.extend(letters_of(tex));
        if let Some(stated) = statements(tex).last() {
            let link = links(tex, stated.clone()).pop().unwrap_or_else(|| stated.clone());
            tex.get(link).unwrap_or_default().clone_into(&mut last);
        }
        if parts.len() < 2 && parts.iter().all(|part| part.given.is_none()) {
            all.push(Formula { first, ..formula });
            continue;
        }
        for (number, part) in parts.into_iter().enumerate() {
            let own = tex.get(part.range.clone()).unwrap_or_default();
            all.push(Formula {
                part: match is_as_printed {
                    true => formula.part.start + part.range.start..formula.part.start + part.range.end,
                    false => formula.part.clone(),
                },
                tex: Ok(part
                    .given
                    .map_or_else(|| own.to_owned(), |given| format!("{given} {own}"))),
                is_link: part.is_link || (number == 0 && formula.is_link),
                goes_with_last: number > 0 || formula.goes_with_last,
                first,
                ..formula.clone()
            });
        }
    }
    all
}

/// A formula that is judged by itself.
struct Part {
    range: Range<usize>,
    /// The formula that its arrow leads from, where that does not stand before it.
    given: Option<String>,
    is_link: bool,
    /// True for the first link of an equation that stands beside another.
    is_beside: bool,
}

/// The most equations that stand side by side.
const MOST_BESIDE: usize = 20;

/// Letters that are variables by convention: an equation that gives one says where the other holds.
const VARIABLES: [&str; 9] = ["t", "x", "y", "z", "r", "s", r"\theta", r"\phi", r"\varphi"];

/// Words and signs between equations that are printed side by side.
const BETWEEN: [&str; 12] = [
    "",
    "and",
    "where",
    "with",
    "so",
    "so that",
    "hence",
    "thus",
    "therefore",
    "i.e.",
    "that is",
    "which gives",
];

/// The equations that blanks part, `a = b, \quad c = d`; none where one of them may be a condition on others, or another value of the
/// same letter: `y = a x, \quad x = 1`, `x = 1, \quad x = 2`.
fn side_by_side(tex: &str) -> Vec<Range<usize>> {
    let (mut pieces, mut commas, mut start, mut relations) = (Vec::new(), Vec::new(), 0, 0);
    for met in outside(tex, 0..tex.len()) {
        match met {
            Outside::Relation(at) if tex.get(at.clone()) == Some("=") => relations += 1,
            Outside::Command(at) => match tex.get(at.clone()).unwrap_or_default() {
                r"\quad" | r"\qquad" if relations > 0 => {
                    pieces.push(start..at.start);
                    (start, relations) = (at.end, 0);
                }
                r"\forall" | r"\exists" => return Vec::new(),
                _ => {}
            },
            Outside::Relation(_) | Outside::Row(_) | Outside::Column(_) => return Vec::new(),
            Outside::Comma(at) => commas.push(at),
        }
    }
    if relations == 0 || pieces.len() >= MOST_BESIDE {
        return Vec::new();
    }
    pieces.push(start..tex.len());
    let mut sides: Vec<&str> = Vec::new();
    for piece in &mut pieces {
        let own = tex.get(piece.clone()).unwrap_or_default();
        let (word, length) = leading_word(own);
        if !BETWEEN.contains(&word) {
            return Vec::new();
        }
        *piece = printed(tex, piece.start + length..piece.end);
        let own = tex.get(piece.clone()).unwrap_or_default();
        let own = own.trim_end_matches([',', ';', '.', ' ']);
        piece.end = piece.start + own.len();
        let Some((left, right)) = own.split_once('=') else {
            return Vec::new();
        };
        // `x = L`, `\theta = \pi/2`
        let is_variable = VARIABLES.contains(&left.trim());
        let is_value = is_name(left) && (is_variable || is_name(right) || letters_of(right).is_empty());
        let has_words = [r"\text", r"\mbox", r"\dots", r"\ldots"]
            .iter()
            .any(|sign| own.contains(sign));
        let is_list = commas.iter().any(|comma| piece.contains(comma));
        if is_value || has_words || is_list || sides.contains(&left.trim()) {
            return Vec::new();
        }
        sides.push(left.trim());
    }
    pieces
}

/// The word in text that a formula begins with, as `\text{and }`, and where it ends.
fn leading_word(tex: &str) -> (&str, usize) {
    let own = tex.trim_start_matches([' ', '\n', ',', ';']);
    let word = [r"\text{", r"\mbox{", r"\textrm{"]
        .iter()
        .find_map(|sign| own.strip_prefix(sign));
    match word.and_then(|word| word.split_once('}')) {
        Some((word, behind)) => (word.trim().trim_matches(',').trim(), tex.len() - behind.len()),
        None => ("", tex.len() - own.len()),
    }
}

/// Returns true for a side that is one letter, with a subscript or not.
fn is_name(side: &str) -> bool {
    read_name(side.trim(), &Names::default()).is_ok()
}

/// The letters of a formula that are no numbers.
fn letters_of(tex: &str) -> HashSet<String> {
    let all = letters(tex, &Names::default()).into_iter().map(|(letter, _)| letter);
    all.filter(|letter| ![r"\pi", "e", "i"].contains(&letter.as_str()))
        .collect()
}

/// The parts with what gives a letter of an equation that it stands beside in front of that.
fn definitions_first(tex: &str, parts: Vec<Part>, met: &HashSet<String>) -> Vec<Part> {
    let (mut first, mut others) = (Vec::new(), Vec::new());
    let mut is_first = false;
    for part in parts {
        let (own, before) = (tex.get(part.range.clone()), tex.get(..part.range.start));
        if !part.is_link {
            let gives = |own, before| gives(own, before, met);
            is_first = part.is_beside && own.zip(before).is_some_and(|(own, before)| gives(own, before));
        }
        if is_first { first.push(part) } else { others.push(part) }
    }
    first.append(&mut others);
    first
}

/// Returns true if an equation gives a letter that stands before it and that no formula before has a value in terms of others.
fn gives(equation: &str, before: &str, met: &HashSet<String>) -> bool {
    let Some((left, right)) = equation.split_once('=') else {
        return false;
    };
    let (own, right) = (letters_of(left), letters_of(right));
    let is_new =
        |letter: &String| letters_of(before).contains(letter) && !met.contains(letter) && !right.contains(letter);
    is_name(left) && own.len() == 1 && own.iter().all(is_new) && right.len() > 1
}

/// The parts of a formula: the links of each statement, and each arrow with the link before and the one behind it. A statement of
/// one link beside an arrow is no formula of its own: what is assumed there may hold nowhere else.
fn parts(tex: &str, last: &str) -> Vec<Part> {
    let part = |range, is_link| Part {
        range,
        given: None,
        is_link,
        is_beside: false,
    };
    let mut all = Vec::new();
    let equations = side_by_side(tex);
    if equations.len() > 1 {
        for equation in equations {
            let links = match links(tex, equation.clone()) {
                links if links.is_empty() => vec![equation],
                links => links,
            };
            let numbered = links.into_iter().enumerate();
            all.extend(numbered.map(|(number, link)| Part {
                is_beside: number == 0,
                ..part(link, number > 0)
            }));
        }
        return all;
    }
    let mut before: Option<Range<usize>> = None;
    let statements = statements(tex);
    for statement in &statements {
        let links = match links(tex, statement.clone()) {
            links if links.is_empty() => vec![statement.clone()],
            links => links,
        };
        let Some(link) = links.first() else { continue };
        let arrow = arrow_before(tex, statement.start);
        match (before, arrow) {
            (Some(before), _) => all.push(part(before.start..link.end, false)),
            (None, Some(arrow)) if !last.is_empty() => all.push(Part {
                given: Some(last.to_owned()),
                ..part(arrow..link.end, false)
            }),
            _ if links.len() > 1 || statements.len() == 1 => all.push(part(link.clone(), false)),
            _ => {}
        }
        all.extend(links.iter().skip(1).map(|link| part(link.clone(), true)));
        before = links.last().cloned();
    }
    all
}

/// Finds the start of the arrow that leads to a statement.
fn arrow_before(tex: &str, start: usize) -> Option<usize> {
    let before = tex.get(..start).unwrap_or_default();
    IMPLYING.iter().filter_map(|arrow| before.rfind(arrow)).max()
}

/// The statements that arrows of implication part.
fn statements(tex: &str) -> Vec<Range<usize>> {
    let mut bounds = vec![0];
    for met in outside(tex, 0..tex.len()) {
        if let Outside::Relation(at) = met
            && tex.get(at.clone()).is_some_and(|sign| IMPLYING.contains(&sign))
        {
            bounds.extend([at.start, at.end]);
        }
    }
    bounds.push(tex.len());
    let all = bounds.chunks_exact(2).filter_map(|pair| match pair {
        [start, end] => Some(printed(tex, *start..*end)),
        _ => None,
    });
    all.filter(|statement| !statement.is_empty()).collect()
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
            Outside::Relation(at) if tex.get(at.clone()).is_some_and(is_linking) => relations.push(at),
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

/// Puts formulas within the text among the displays, where they are said.
pub(super) fn merged(formulas: Vec<Formula>, asides: Vec<Aside>) -> Vec<Formula> {
    let mut all: Vec<Formula> = Vec::with_capacity(formulas.len() + asides.len());
    let mut asides = asides.into_iter().peekable();
    let mut places: Vec<usize> = Vec::with_capacity(formulas.len());
    let number = formulas.len();
    for (at, formula) in formulas.into_iter().map(Some).chain([None]).enumerate() {
        while let Some(aside) = asides.next_if(|aside| aside.after <= at.min(number)) {
            let first = all.len();
            all.push(Formula { first, ..aside.formula });
        }
        if let Some(formula) = formula {
            places.push(all.len());
            let first = places.get(formula.first).copied().unwrap_or_default();
            all.push(Formula { first, ..formula });
        }
    }
    all
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
    fn each_arrow_is_judged_by_itself() {
        let shown = |tex: &str, last: &str| {
            let parts = parts(tex, last).into_iter();
            let text = |part: Part| part.given.unwrap_or_default() + &tex[part.range];
            parts.map(text).collect::<Vec<_>>()
        };
        assert_eq!(
            shown(r"a = b \quad\Rightarrow\quad c = d = e \iff f = g", ""),
            [r"a = b \quad\Rightarrow\quad c = d ", " d = e", r" d = e \iff f = g"]
        );
        assert_eq!(
            shown(r"a = b = c \implies d = e", ""),
            ["a = b ", " b = c", r" b = c \implies d = e"]
        );
        assert_eq!(shown(r"\Rightarrow c = d", "a = b"), [r"a = b\Rightarrow c = d"]);
        assert_eq!(shown("a = b", "x = y"), ["a = b"]);
    }

    #[test]
    fn what_is_no_chain_is_left_whole() {
        for whole in [r"a = b \Rightarrow c = d", r"a = b \approx c", r"a = b \\ c = d = e"] {
            assert!(shown(whole).is_empty(), "{whole}");
        }
    }
}
