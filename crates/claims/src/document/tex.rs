//! What TeX source looks like from outside: groups, environments, rows, relations. Nothing of its mathematics.

use std::collections::HashMap;
use std::ops::Range;
use texmath::{Related, related, sign_at};

/// The command at byte `at`, a backslash: its name, of letters or of one other character, and where it ends.
pub(super) fn command(text: &str, at: usize) -> (&str, usize) {
    let rest = text.get(at + 1..).unwrap_or_default();
    let letters = rest.bytes().take_while(u8::is_ascii_alphabetic).count();
    let length = match letters {
        0 => rest.chars().next().map_or(0, char::len_utf8),
        letters => letters,
    };
    (rest.get(..length).unwrap_or_default(), at + 1 + length)
}

/// A formula without blanks and sizes of brackets.
pub(super) fn unspaced(tex: &str) -> String {
    tex.replace(r"\left", "")
        .replace(r"\right", "")
        .split_whitespace()
        .collect()
}

/// Where blanks that start at byte `at` end.
pub(super) fn after_blanks(text: &str, at: usize) -> usize {
    let rest = text.get(at..).unwrap_or_default();
    at + rest.len() - rest.trim_start().len()
}

/// What stands between the braces, or these other brackets, that open at byte `at`, or blanks later.
pub(super) fn group(text: &str, at: usize, brackets: [u8; 2]) -> Option<Range<usize>> {
    let [open, close] = brackets;
    let start = after_blanks(text, at);
    let bytes = text.as_bytes();
    if bytes.get(start) != Some(&open) {
        return None;
    }
    let (mut braces, mut next) = (0_usize, start + 1);
    while let Some(&byte) = bytes.get(next) {
        match byte {
            b'\\' => next += 1,
            _ if byte == close && braces == 0 => return Some(start + 1..next),
            b'{' => braces += 1,
            b'}' => braces = braces.checked_sub(1)?,
            _ => {}
        }
        next += 1;
    }
    None
}

pub(super) const BRACES: [u8; 2] = *b"{}";
pub(super) const SQUARE: [u8; 2] = *b"[]";

/// Where the braces and square brackets of a text close, found in one pass: looking for the end of each would cost the square
/// of a text in which nothing closes.
#[derive(Clone, Debug, Default)]
pub(super) struct Groups(Vec<(usize, usize)>);

impl Groups {
    /// Finds those of a whole text.
    pub(super) fn of(text: &str) -> Self {
        let mut groups = Self::default();
        groups.add(text, 0..text.len());
        groups
    }

    /// Adds those that open and close in a part behind all parts so far.
    pub(super) fn add(&mut self, text: &str, part: Range<usize>) {
        let known = self.0.len();
        // the braces that are open, each with the square brackets that are open in it
        let mut open: Vec<(Option<usize>, Vec<usize>)> = vec![(None, Vec::new())];
        let mut next = part.start;
        while let Some(byte) = text.as_bytes().get(next).filter(|_| next < part.end) {
            match (byte, open.last_mut()) {
                (b'\\', _) => next += 1,
                (b'{', _) => open.push((Some(next), Vec::new())),
                (b'[', Some((_, squares))) => squares.push(next),
                (b']', Some((_, squares))) => self.0.extend(squares.drain(..).map(|at| (at, next))),
                (b'}', Some((brace, squares))) => match brace {
                    Some(at) => {
                        self.0.push((*at, next));
                        open.pop();
                    }
                    None => squares.clear(),
                },
                _ => {}
            }
            next += 1;
        }
        if let Some(new) = self.0.get_mut(known..) {
            new.sort_unstable();
        }
    }

    /// What stands between the braces, or these other brackets, that open at byte `at`, or blanks later.
    pub(super) fn group(&self, text: &str, at: usize, brackets: [u8; 2]) -> Option<Range<usize>> {
        let start = after_blanks(text, at);
        text.as_bytes().get(start).filter(|byte| **byte == brackets[0])?;
        let found = self.0.binary_search_by_key(&start, |(open, _)| *open).ok()?;
        self.0.get(found).map(|(_, close)| start + 1..*close)
    }
}

/// The commands of a text, each with where it ends.
pub(super) fn words(text: &str) -> impl Iterator<Item = (&str, usize)> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let here = at + text.get(at..)?.find('\\')?;
        let (word, next) = command(text, here);
        at = next;
        Some((word, next))
    })
}

/// An environment: its name, what it holds, and where its `\end` ends.
type Environment<'t> = (&'t str, Range<usize>, usize);

/// The environment that `\begin` at byte `at` opens.
pub(super) fn environment(text: &str, at: usize) -> Option<Environment<'_>> {
    let rest = text.get(at..)?;
    let (name, body, end) = environments(rest, &Groups::of(rest)).remove(&0)?;
    Some((name, at + body.start..at + body.end, at + end))
}

/// The environments of a text by where their `\begin` stands.
fn environments<'t>(text: &'t str, groups: &Groups) -> HashMap<usize, Environment<'t>> {
    let mut found = HashMap::new();
    let mut open: HashMap<&str, Vec<(usize, usize)>> = HashMap::new();
    for (word, next) in words(text).filter(|(word, _)| matches!(*word, "begin" | "end")) {
        let Some(own) = groups.group(text, next, BRACES) else {
            continue;
        };
        let (here, close) = (next - word.len() - 1, own.end + 1);
        let name = text.get(own).unwrap_or_default();
        let open = open.entry(name).or_default();
        match word {
            "begin" => open.push((here, close)),
            _ => found.extend(open.pop().map(|(begin, start)| (begin, (name, start..here, close)))),
        }
    }
    found
}

/// What is met outside braces, brackets and environments within a formula, in order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Outside {
    /// `\\` with what belongs to it.
    Row(Range<usize>),
    /// `&`.
    Column(usize),
    /// `,` or `;`.
    Comma(usize),
    /// A relation.
    Relation(Range<usize>),
    /// Any other command with what it is called.
    Command(Range<usize>),
}

/// The commands that relate, beside the relations between values.
const RELATING: [&str; 12] = [
    "sim",
    "to",
    "propto",
    "ll",
    "gg",
    "Rightarrow",
    "implies",
    "Leftrightarrow",
    "Longrightarrow",
    "Longleftrightarrow",
    "iff",
    "in",
];

/// The relations that say that what is claimed follows, or that two sides are alike, beside those between values.
const EQUATING: [&str; 9] = [
    r"\sim",
    r"\to",
    r"\propto",
    r"\Rightarrow",
    r"\implies",
    r"\Leftrightarrow",
    r"\Longrightarrow",
    r"\Longleftrightarrow",
    r"\iff",
];

/// Returns true if a relation says that two sides are equal, or nearly.
pub(super) fn is_equating(relation: &str) -> bool {
    matches!(related(relation), Some(Related::Equal | Related::Near)) || EQUATING.contains(&relation)
}

/// Returns true for a command that relates.
fn relates_by(name: &str) -> bool {
    RELATING.contains(&name) || related(&format!("\\{name}")).is_some()
}

/// Returns the relation that begins a text, where it is no command.
fn relation_at(text: &str) -> Option<&'static str> {
    sign_at(text).or_else(|| ["≲", "≳"].into_iter().find(|sign| text.starts_with(sign)))
}

/// The relations that stand anywhere in a formula, be it within brackets.
fn relations(tex: &str) -> impl Iterator<Item = &str> {
    let commands = tex.match_indices('\\').filter_map(|(at, _)| {
        let (name, end) = command(tex, at);
        relates_by(name).then(|| tex.get(at..end)).flatten()
    });
    let signs = tex.char_indices().filter_map(|(at, _)| relation_at(tex.get(at..)?));
    signs.chain(commands)
}

/// Whether a relation stands anywhere in a formula, be it within brackets.
pub(super) fn relates(tex: &str) -> bool {
    relations(tex).next().is_some()
}

/// Whether an inequality or `\in` stands anywhere in a formula.
pub(super) fn orders(tex: &str) -> bool {
    relations(tex).any(|relation| !is_equating(relation))
}

/// What stands outside all brackets in part of a text.
pub(super) fn outside(text: &str, part: Range<usize>) -> Vec<Outside> {
    let own = text.get(part.clone()).unwrap_or_default();
    let groups = Groups::of(own);
    let environments = environments(own, &groups);
    let group = |at: usize, brackets: [u8; 2]| {
        let own = groups.group(own, at - part.start, brackets);
        own.map(|own| part.start + own.start..part.start + own.end)
    };
    let (mut found, mut next, mut depth) = (Vec::new(), part.start, 0_usize);
    while next < part.end {
        let rest = text.get(next..part.end).unwrap_or_default();
        let Some(c) = rest.chars().next() else { break };
        let here = next;
        next += c.len_utf8();
        let relation = relation_at(rest);
        match c {
            '\\' => {
                let (name, end) = command(text, here);
                next = end;
                match name {
                    "begin" => {
                        let own = environments.get(&(here - part.start));
                        next = own.map_or(end, |(_, _, close)| part.start + close);
                    }
                    "left" | "bigl" | "Bigl" | "biggl" | "Biggl" => {
                        depth += 1;
                        next = sized(text, end);
                    }
                    "right" | "bigr" | "Bigr" | "biggr" | "Biggr" => {
                        depth = depth.saturating_sub(1);
                        next = sized(text, end);
                    }
                    "{" | "lbrace" => depth += 1,
                    "}" | "rbrace" => depth = depth.saturating_sub(1),
                    "\\" if depth == 0 => {
                        let star = usize::from(text.as_bytes().get(next) == Some(&b'*'));
                        next = group(next + star, SQUARE).map_or(next + star, |space| space.end + 1);
                        found.push(Outside::Row(here..next));
                    }
                    _ if depth > 0 => {}
                    name if relates_by(name) => found.push(Outside::Relation(here..next)),
                    _ => found.push(Outside::Command(here..next)),
                }
            }
            '{' => next = group(here, BRACES).map_or(next, |group| group.end + 1),
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            _ if depth > 0 => {}
            '&' => found.push(Outside::Column(here)),
            ',' | ';' => found.push(Outside::Comma(here)),
            _ => {
                if let Some(relation) = relation {
                    next = here + relation.len();
                    found.push(Outside::Relation(here..next));
                }
            }
        }
    }
    found
}

/// Where the bracket that a size belongs to ends.
fn sized(text: &str, at: usize) -> usize {
    let at = after_blanks(text, at);
    match text.get(at..).and_then(|rest| rest.chars().next()) {
        Some('\\') => command(text, at).1,
        Some(c) => at + c.len_utf8(),
        None => at,
    }
}

/// The part without blanks around it.
pub(super) fn trimmed(text: &str, part: Range<usize>) -> Range<usize> {
    let own = text.get(part.clone()).unwrap_or_default();
    let start = part.start + own.len() - own.trim_start().len();
    start..start + own.trim().len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_environment_ends_where_its_own_end_stands() {
        let text = r"\begin{align}a \begin{align} b \end{align} \\ \end{aligned} c\end{align} d";
        let (name, body, end) = environment(text, 0).unwrap();
        assert_eq!((name, &text[end..]), ("align", " d"));
        assert!(text[body].ends_with(r"\end{aligned} c"));
        assert_eq!(environment(r"\begin{align} a", 0), None);
    }

    #[test]
    fn rows_and_relations_are_those_outside_brackets() {
        let text =
            r"a &= \left( b \\ = c \right) \\[2pt] {x = y} \le \begin{pmatrix} 1 & 2 \\ 3 & 4 \end{pmatrix} f(x = 1)";
        let found = outside(text, 0..text.len());
        let shown: Vec<&str> = found
            .iter()
            .map(|found| match found {
                Outside::Row(at) | Outside::Relation(at) | Outside::Command(at) => &text[at.clone()],
                Outside::Column(at) | Outside::Comma(at) => &text[*at..=*at],
            })
            .collect();
        assert_eq!(shown, ["&", "=", r"\\[2pt]", r"\le"]);
    }

    #[test]
    fn a_group_holds_its_own_braces() {
        let text = r"x {a {b} \} c} d";
        assert_eq!(group(text, 1, BRACES).map(|own| &text[own]), Some(r"a {b} \} c"));
        assert_eq!(group(text, 0, BRACES), None);
        assert_eq!(group("{a", 0, BRACES), None);
        // found one by one or all at once
        for text in [text, "{a", "{a}} {[b] ]} [c {d] } ] \\{ {", r"{[} ]{\}} [[ ] }{"] {
            let groups = Groups::of(text);
            for at in 0..text.len() {
                for brackets in [BRACES, SQUARE] {
                    let is_escaped = text[..at].ends_with('\\');
                    let own = group(text, at, brackets).filter(|_| !is_escaped);
                    assert_eq!(
                        groups.group(text, at, brackets).filter(|_| !is_escaped),
                        own,
                        "{text} {at}"
                    );
                }
            }
        }
    }
}
