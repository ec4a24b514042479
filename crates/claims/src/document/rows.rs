//! The rows of a display, and the formulas that they make.

use super::tex::{
    BRACES, Groups, Outside, after_blanks, environment, group, is_equating, orders, outside, relates, trimmed,
};
use std::ops::Range;
use texmath::{printed, related, says_nothing};

/// A row of a display, or several that are one formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Row {
    /// Where it stands, labels and tags blanked out.
    pub part: Range<usize>,
    /// The end of its last line, or of the display.
    pub line_end: usize,
    pub labels: Vec<String>,
    pub tag: Option<String>,
    /// How many numbers it prints, where each row prints one.
    pub numbers: usize,
    /// The last side of the row before, where this one starts with a relation and continues it.
    pub continues: Option<Range<usize>>,
    /// Whether another row of the display could be a condition on it, or it one on another.
    pub is_doubtful: bool,
    /// Why it cannot be told from the others.
    pub problem: Option<&'static str>,
}

/// Environments within a display that lay out its rows.
const LAYERS: [&str; 15] = [
    "split",
    "aligned",
    "alignedat",
    "gathered",
    "cases",
    "array",
    "multlined",
    "align",
    "align*",
    "equation",
    "equation*",
    "gather",
    "gather*",
    "multline",
    "multline*",
];

/// Those whose columns are equations beside each other, in pairs of two sides.
const PAIRED: [&str; 11] = [
    "align",
    "align*",
    "aligned",
    "alignedat",
    "alignat",
    "alignat*",
    "flalign",
    "flalign*",
    "xalignat",
    "xalignat*",
    "split",
];

/// Commands of words between rows.
const BETWEEN_ROWS: [&str; 2] = ["intertext", "shortintertext"];

/// The most characters of a row, counted once for each of its columns.
const MOST_COMPARED: usize = 1_000_000;

/// Takes a display apart: `text` is what it stands in, `body` where, `name` the environment. Labels, tags and column signs become
/// blanks, but for a comma between columns that are equations of their own.
pub(super) fn rows(text: &mut String, body: Range<usize>, name: &str) -> Vec<Row> {
    let end = body.end;
    let line_end = |text: &str, at: usize| {
        let rest = text.get(at..end).and_then(|rest| rest.find('\n'));
        rest.map_or(end, |found| at + found)
    };
    let mut whole = Row::new(body.clone(), line_end(text, body.end));
    // what is said outside a layer is said of all of it
    let mut own = text.get(body.clone()).unwrap_or_default().to_owned();
    let length = own.len();
    let has_words = BETWEEN_ROWS.iter().any(|name| own.contains(&format!("\\{name}")));
    whole.take_names(&mut own, 0..length);
    let (inner, name) = match layer(&own) {
        Some((name, inner)) => {
            let name = name.to_owned();
            text.replace_range(body.clone(), &own);
            (body.start + inner.start..body.start + inner.end, name)
        }
        None => {
            whole = Row::new(body.clone(), whole.line_end);
            (body, name.to_owned())
        }
    };
    let mut pieces: Vec<(Range<usize>, bool, bool)> = Vec::new();
    let mut start = inner.start;
    let mut columns: Vec<usize> = Vec::new();
    let mut has_columns = false;
    let mut end_of_row = |text: &mut String, part: Range<usize>, columns: &mut Vec<usize>| {
        let starts = text
            .get(part.clone())
            .is_some_and(|row| row.trim_start().starts_with('&'));
        let mut column = part.start;
        let columns = std::mem::take(columns);
        // each column is compared with the rest of its row
        let is_wide = columns.len().saturating_mul(part.len()) > MOST_COMPARED;
        if is_wide {
            columns.iter().for_each(|&at| text.replace_range(at..=at, " "));
        }
        for (place, at) in columns.into_iter().enumerate().filter(|_| !is_wide) {
            let shown = |side: Range<usize>| text.get(side).unwrap_or_default().replace('&', " ");
            let (left, right) = (shown(column..at), shown(at + 1..part.end));
            let (left, right) = (printed(&left), printed(&right));
            let is_pair = place % 2 == 1 && PAIRED.contains(&name.as_str());
            // a column of its own begins where an equation is complete and no part of it follows
            let goes_on = begins_with(right, &OPERATORS) && !(is_pair && right.starts_with(['-', '−']));
            let is_complete = !relations(left).is_empty() && !is_continued(left);
            let parts = is_complete && !right.is_empty() && !goes_on && !begins_with_relation(right);
            if parts {
                column = at + 1;
            }
            has_columns |= parts && equates(right);
            text.replace_range(at..=at, if parts { "," } else { " " });
        }
        pieces.push((part, starts, is_wide));
    };
    for found in outside(text, inner.clone()) {
        match found {
            Outside::Row(at) => {
                end_of_row(text, start..at.start, &mut columns);
                start = at.end;
            }
            Outside::Column(at) => columns.push(at),
            // words between rows end the one before them, with or without `\\`
            Outside::Command(at)
                if text
                    .get(at.start + 1..at.end)
                    .is_some_and(|name| BETWEEN_ROWS.contains(&name)) =>
            {
                end_of_row(text, start..at.start, &mut columns);
                start = at.start;
            }
            _ => {}
        }
    }
    end_of_row(text, start..inner.end, &mut columns);
    let mut rows: Vec<Row> = Vec::new();
    // the first side of the chain that a row continues
    let mut head: Option<Range<usize>> = None;
    let (mut goes_on, mut is_implied, mut has_arrow) = (false, false, false);
    for (piece, is_aligned, is_wide) in pieces {
        let mut row = Row::new(piece.clone(), line_end(text, trimmed(text, piece.clone()).end));
        row.take_names(text, piece.clone());
        row.part = trimmed(text, piece);
        row.problem = is_wide.then_some("a row of too many columns: give each formula a display of its own");
        if row.part.is_empty() {
            continue;
        }
        // the sign of equality at the end of a row is the one that the next begins with
        if let Some(last) = rows.last_mut()
            && let Some(end) = repeated_sign(text, &last.part, &row.part)
        {
            blank(text, end..last.part.end);
            last.part = trimmed(text, last.part.start..end);
        }
        let joined = match (rows.last(), name.starts_with("multline")) {
            (Some(_), true) => Some(Joined::Row),
            (last, _) => last.and_then(|last| joined(text, &last.part, &row.part, is_aligned)),
        };
        goes_on |= joined.is_some() || (!rows.is_empty() && starts_with_relation(text, &row.part));
        has_arrow |= begins_with(printed(text.get(row.part.clone()).unwrap_or_default()), &ARROWS);
        match (rows.last_mut(), joined) {
            (Some(last), Some(Joined::Blank)) => {
                // one formula of two rows is read as one row, without the blanks that indent the second
                let own = text.get(row.part.clone()).unwrap_or_default();
                let indent = own.find(printed(own)).unwrap_or(0);
                blank(text, last.part.end..row.part.start + indent);
                last.join(row);
            }
            (Some(last), Some(Joined::Row)) => last.join(row),
            (last, _) => {
                match last.filter(|_| starts_with_relation(text, &row.part)) {
                    // what is given behind an arrow is given to the rows that go on too
                    Some(last) => {
                        is_implied |= implies(text, &last.part);
                        row.continues = side_before(text, &last.part, &row.part, head.clone()).filter(|_| !is_implied);
                    }
                    None => (head, is_implied) = (first_side(text, &row.part), false),
                }
                rows.push(row);
            }
        }
    }
    if let Some(first) = rows.first_mut() {
        first.labels.splice(0..0, whole.labels);
        first.tag = whole.tag.or(first.tag.take());
        first.numbers *= whole.numbers;
    }
    if let Some(last) = rows.last_mut() {
        last.line_end = whole.line_end;
    }
    // a comma within what is one formula may part it from its condition
    let has_parts = |row: &Row| {
        text.get(row.part.clone())
            .is_some_and(|row| row.trim_end_matches(',').contains(','))
    };
    // beside a row that an arrow begins the others may be given, or follow
    let is_doubtful = has_words
        || (has_arrow && rows.len() > 1)
        || share_conditions(text, &rows)
        || (name.starts_with("multline") && rows.iter().any(has_parts));
    let problem = "columns of equations that go on in another row: give each formula a display of its own";
    for row in &mut rows {
        row.is_doubtful = is_doubtful;
        row.problem = row.problem.or((has_columns && goes_on).then_some(problem));
    }
    rows
}

/// Whether a row could be a condition on another, or hold one that is said of another too: an inequality beside equations, or between
/// single letters; words, an arrow or what states nothing in a row of its own; a condition behind some rows and not
/// behind others, or behind a link of a chain.
fn share_conditions(text: &str, rows: &[Row]) -> bool {
    let own = |row: &Row| printed(text.get(row.part.clone()).unwrap_or_default());
    let is_said = |row: &Row| {
        let own = own(row);
        let has_words = WORDS.iter().any(|command| own.contains(command)) && !is_followed(text, &row.part, orders);
        relations(own).is_empty() || has_words || begins_with(own, &ARROWS) || own.starts_with(r"\forall")
    };
    let is_bare = |row: &Row| {
        let (own, mut start, mut sides) = (own(row), 0, Vec::new());
        for at in relations(own) {
            sides.extend(own.get(start..at.start));
            start = at.end;
        }
        sides.extend(own.get(start..));
        let is_letter = |side: &&str| {
            !side
                .trim()
                .trim_end_matches(['.', ','])
                .contains([' ', '+', '-', '^', '(', '|'])
        };
        !equates(own) && sides.iter().all(is_letter)
    };
    let equations = rows.iter().filter(|row| equates(own(row))).count();
    let has_condition = |row: &Row| is_followed(text, &row.part, orders);
    let conditioned = rows.iter().filter(|row| has_condition(row)).count();
    let is_mixed = |count: usize| 0 < count && count < rows.len();
    let is_doubtful = |row: &Row| is_said(row) || is_bare(row) || (row.continues.is_some() && has_condition(row));
    is_mixed(equations) || is_mixed(conditioned) || (rows.len() > 1 && rows.iter().any(is_doubtful))
}

/// The arrows between what is given and what follows.
const ARROWS: [&str; 9] = [
    r"\therefore",
    r"\Rightarrow",
    r"\implies",
    r"\Longrightarrow",
    r"\Leftrightarrow",
    r"\iff",
    r"\Longleftrightarrow",
    r"\Downarrow",
    r"\therefore",
];

/// Whether an arrow stands in a row.
fn implies(text: &str, part: &Range<usize>) -> bool {
    let own = text.get(part.clone()).unwrap_or_default();
    relations(own)
        .into_iter()
        .any(|at| own.get(at).is_some_and(|relation| ARROWS.contains(&relation)))
}

fn begins_with(text: &str, commands: &[&str]) -> bool {
    commands.iter().any(|command| text.starts_with(command))
}

impl Row {
    fn new(part: Range<usize>, line_end: usize) -> Self {
        Self {
            part,
            line_end,
            labels: Vec::new(),
            tag: None,
            numbers: 1,
            continues: None,
            is_doubtful: false,
            problem: None,
        }
    }

    /// Takes the labels, the tag and the like out of a part of the text.
    fn take_names(&mut self, text: &mut String, part: Range<usize>) {
        let commands: Vec<Range<usize>> = outside(text, part.clone())
            .into_iter()
            .filter_map(|found| match found {
                Outside::Command(at) => Some(at),
                _ => None,
            })
            .collect();
        let own = text.get(part.clone()).unwrap_or_default().to_owned();
        let groups = Groups::of(&own);
        for at in commands {
            let name = text.get(at.start + 1..at.end).unwrap_or_default().to_owned();
            let star = usize::from(text.as_bytes().get(at.end) == Some(&b'*'));
            let argument = groups.group(&own, at.end + star - part.start, BRACES);
            let argument = argument.map(|own| part.start + own.start..part.start + own.end);
            let own = argument
                .clone()
                .and_then(|own| text.get(own))
                .unwrap_or_default()
                .trim()
                .to_owned();
            let end = argument.map_or(at.end, |own| own.end + 1);
            match name.as_str() {
                "label" => self.labels.push(own),
                "tag" => {
                    self.tag = Some(
                        own.trim_matches('$')
                            .trim_start_matches('(')
                            .trim_end_matches(')')
                            .to_owned(),
                    )
                }
                name if BETWEEN_ROWS.contains(&name) => {}
                "nonumber" | "notag" => {
                    self.numbers = 0;
                    blank(text, at);
                    continue;
                }
                _ => continue,
            }
            blank(text, at.start..end);
        }
    }

    fn join(&mut self, more: Self) {
        self.part.end = more.part.end;
        self.line_end = more.line_end;
        self.numbers += more.numbers;
        self.labels.extend(more.labels);
        self.tag = self.tag.take().or(more.tag);
        self.problem = self.problem.or(more.problem);
    }
}

/// Leaves of `\overset{(a)}{=}` the relation alone, where what stands above it says nothing.
pub(super) fn print_relations(text: &mut String, part: Range<usize>) {
    let own = text.get(part.clone()).unwrap_or_default();
    let groups = Groups::of(own);
    let relation = |at: usize, sign: &str| {
        let above = groups.group(own, at + sign.len(), BRACES)?;
        let relation = groups.group(own, above.end + 1, BRACES)?;
        let (start, end) = (part.start + at, part.start + relation.end + 1);
        let sign = own.get(relation)?.trim();
        let is_plain = related(sign).is_some() && says_nothing(own.get(above)?);
        is_plain.then(|| (start..end, sign.to_owned()))
    };
    let found: Vec<(Range<usize>, String)> = [r"\overset", r"\stackrel"]
        .iter()
        .flat_map(|sign| own.match_indices(sign).filter_map(|(at, sign)| relation(at, sign)))
        .collect();
    for (place, sign) in found {
        blank(text, place.clone());
        text.replace_range(place.start..place.start + sign.len(), &sign);
    }
}

/// Writes blanks over a part of the text, so that all places stay as they are.
pub(super) fn blank(text: &mut String, part: Range<usize>) {
    let blanks: String = text
        .get(part.clone())
        .unwrap_or_default()
        .chars()
        .map(|c| {
            if c == '\n' {
                "\n".to_owned()
            } else {
                " ".repeat(c.len_utf8())
            }
        })
        .collect();
    text.replace_range(part, &blanks);
}

/// The name and the body of an environment that is all there is, or that stands behind a brace or in a box.
fn layer(text: &str) -> Option<(&str, Range<usize>)> {
    let is_nothing = |behind: &str| behind.chars().all(|c| c.is_whitespace() || ",.;".contains(c));
    let mut own = trimmed(text, 0..text.len());
    if text.get(own.clone())?.starts_with(r"\boxed") {
        let inside = group(text, after_blanks(text, own.start + r"\boxed".len()), BRACES)?;
        if !is_nothing(text.get(inside.end + 1..own.end)?) {
            return None;
        }
        own = trimmed(text, inside);
    }
    let rest = text.get(own.clone())?;
    let braced = [r"\left\{", r"\left \{", r"\left\lbrace"]
        .iter()
        .find_map(|brace| rest.strip_prefix(brace));
    let start = after_blanks(text, own.end - braced.unwrap_or(rest).len());
    if !text.get(start..own.end)?.starts_with(r"\begin") {
        return None;
    }
    let (name, inner, end) = environment(text, start)?;
    let behind = text.get(end..own.end)?;
    let behind = if braced.is_some() {
        behind.trim_start().trim_start_matches(r"\right.")
    } else {
        behind
    };
    let states = || {
        outside(text, inner.clone())
            .iter()
            .any(|found| matches!(found, Outside::Relation(_)))
    };
    if !is_nothing(behind) || !LAYERS.contains(&name) || (name == "array" && !states()) {
        return None;
    }
    let columns = matches!(name, "array" | "alignedat")
        .then(|| group(text, inner.start, BRACES))
        .flatten();
    let start = columns.map_or(inner.start, |columns| columns.end + 1);
    Some((name, start..inner.end))
}

fn relations(text: &str) -> Vec<Range<usize>> {
    let found = outside(text, 0..text.len()).into_iter();
    found
        .filter_map(|found| match found {
            Outside::Relation(at) => Some(at),
            _ => None,
        })
        .collect()
}

fn starts_with_relation(text: &str, part: &Range<usize>) -> bool {
    begins_with_relation(printed(text.get(part.clone()).unwrap_or_default()))
}

/// Returns where the `=` stands that ends a row, if the next begins with one.
fn repeated_sign(text: &str, before: &Range<usize>, part: &Range<usize>) -> Option<usize> {
    let own = text.get(before.clone())?.strip_suffix('=')?;
    let is_whole = !own.ends_with(['<', '>', ':', '!', '=']) && !own.trim_end_matches(['&', ' ']).is_empty();
    let is_repeated = printed(text.get(part.clone())?).starts_with('=');
    (is_whole && is_repeated).then_some(before.start + own.len())
}

/// Whether a text states an equation.
fn equates(text: &str) -> bool {
    relations(text)
        .into_iter()
        .any(|at| text.get(at).is_some_and(is_equating))
}

fn begins_with_relation(text: &str) -> bool {
    relations(text).first().is_some_and(|first| first.start == 0)
}

/// The signs that join two sides of a row's end.
const OPERATORS: [&str; 8] = ["+", "-", "−", r"\pm", r"\mp", r"\cdot", r"\times", "/"];

/// How a row is the same formula as the one before it.
#[derive(Clone, Copy)]
enum Joined {
    /// By a blank.
    Blank,
    /// By a row, which does not make a product of what stands on its sides.
    Row,
}

/// How a row is the same formula as the one before it, if it is: that one cannot end where it does, or states nothing yet, or this
/// one states nothing itself and starts with an operator, a condition or a column sign.
fn joined(text: &str, before: &Range<usize>, part: &Range<usize>, is_aligned: bool) -> Option<Joined> {
    let shown = |part: &Range<usize>| printed(text.get(part.clone()).unwrap_or_default());
    let (before, own) = (shown(before), shown(part));
    let states_nothing = relations(own).is_empty();
    let starts = begins_with(own, &OPERATORS) || own.starts_with(r"\right");
    let is_left_side = starts_with_relation(text, part) && relations(before).is_empty();
    // an arrow goes on from what is given
    let is_consequence = begins_with(own, &ARROWS) && !states_nothing;
    if is_left_side || is_continued(before) || is_consequence || (starts && (is_aligned || states_nothing)) {
        return Some(Joined::Blank);
    }
    let is_in_brackets = own.starts_with('(') && relates(own);
    let is_incomplete = relations(before).is_empty() || (starts && !own.starts_with(['-', '−']));
    (is_incomplete || says_condition(own) || (states_nothing && (is_aligned || is_in_brackets))).then_some(Joined::Row)
}

/// Whether a row cannot end where it does: behind an operator or a relation.
fn is_continued(own: &str) -> bool {
    let related = relations(own).last().is_some_and(|last| last.end == own.len());
    related || OPERATORS.iter().any(|operator| own.ends_with(operator))
}

/// The commands that print words.
const WORDS: [&str; 3] = [r"\text", r"\mbox", r"\textrm"];

/// Whether what stands at the start of a text says that a condition follows.
fn says_condition(text: &str) -> bool {
    let said = WORDS.iter().find_map(|command| text.strip_prefix(command));
    let word = said.map(|said| said.trim_start().trim_start_matches('{').trim_start());
    let word = word.map(|word| {
        word.split(|c: char| !c.is_ascii_alphabetic())
            .next()
            .unwrap_or_default()
    });
    let words = ["for", "if", "when", "whenever", "provided", "unless", "as"];
    text.starts_with(r"\forall") || word.is_some_and(|word| words.contains(&word))
}

/// The first side of a row.
fn first_side(text: &str, part: &Range<usize>) -> Option<Range<usize>> {
    let found = outside(text, part.clone()).into_iter();
    let mut ends = found.filter_map(|found| match found {
        Outside::Relation(at) => Some(at.start),
        _ => None,
    });
    let side = trimmed(text, part.start..ends.next()?);
    (!side.is_empty()).then_some(side)
}

/// The side that a row continues which starts with a relation: the last one of the row before it; behind a row that holds under a
/// condition the first of the chain, `head`, where this row has a condition too, and else none, as it could be either.
fn side_before(
    text: &str,
    before: &Range<usize>,
    part: &Range<usize>,
    head: Option<Range<usize>>,
) -> Option<Range<usize>> {
    match (is_followed(text, before, relates), is_followed(text, part, relates)) {
        (true, true) => head,
        (true, false) => None,
        (false, _) => last_side(text, before).map(|(side, _)| side),
    }
}

/// Whether something stands behind the sides of a row that states, by this test, or says that it is a condition.
fn is_followed(text: &str, part: &Range<usize>, states: impl Fn(&str) -> bool) -> bool {
    let behind = last_side(text, part).and_then(|(_, end)| text.get(end..part.end));
    behind.is_some_and(|behind| {
        let mut commands = behind.match_indices('\\').filter_map(|(at, _)| behind.get(at..));
        states(behind) || commands.any(says_condition)
    })
}

/// What stands behind the last relation of what a row states first, without the conditions behind it, and where these start.
fn last_side(text: &str, part: &Range<usize>) -> Option<(Range<usize>, usize)> {
    let mut side: Option<usize> = None;
    let mut end = part.end;
    for found in outside(text, part.clone()) {
        let ends = match &found {
            Outside::Relation(at) => {
                side = Some(at.end);
                None
            }
            Outside::Comma(at) => Some(*at),
            Outside::Command(at) => {
                let name = text.get(at.clone()).unwrap_or_default();
                let parts = [r"\quad", r"\qquad", r"\forall"].contains(&name) || WORDS.contains(&name);
                parts.then_some(at.start)
            }
            _ => None,
        };
        if let (Some(at), Some(start)) = (ends, side)
            && text.get(start..at).is_some_and(|side| !side.trim().is_empty())
        {
            end = at;
            break;
        }
    }
    let side = trimmed(text, side?..end);
    let printed = text.get(side.clone())?.trim_end_matches([',', '.', ';']).trim_end();
    Some((side.start..side.start + printed.len(), end))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(tex: &str) -> Vec<(String, Option<String>, Vec<String>, bool)> {
        let mut text = tex.to_owned();
        let length = text.len();
        let rows = rows(&mut text, 0..length, "align");
        let show = |row: &Row| {
            let side = row
                .continues
                .clone()
                .map(|side| text[side].split_whitespace().collect::<Vec<_>>().join(" "));
            let own = text[row.part.clone()].split_whitespace().collect::<Vec<_>>().join(" ");
            let names = row.tag.iter().chain(&row.labels).cloned().collect();
            (own, side, names, row.numbers == 1)
        };
        rows.iter().map(show).collect()
    }

    #[test]
    fn a_row_that_starts_with_a_relation_continues_and_one_with_an_operator_is_the_same() {
        let found =
            shown(r"a &= b + c \label{one} \\ &\quad - d \\ &= \left(e = f\right), \nonumber \\ -g &\le h \tag{7}");
        assert_eq!(
            found,
            [
                (r"a = b + c - d".into(), None, vec!["one".into()], false),
                (
                    r"= \left(e = f\right),".into(),
                    Some(r"b + c - d".into()),
                    vec![],
                    false
                ),
                (r"-g \le h".into(), None, vec!["7".into()], true),
            ]
        );
    }

    #[test]
    fn columns_are_equations_and_conditions_are_no_sides() {
        let found =
            shown(r"a &= 1 & b &= 2 \\ c &= d, \qquad d > 0 \\ &= e \quad\text{for } x > 0 \\ &= f \\ &\quad - g = h");
        let own: Vec<(&str, Option<&str>)> = found.iter().map(|row| (row.0.as_str(), row.1.as_deref())).collect();
        let wanted = [
            ("a = 1 , b = 2", None),
            (r"c = d, \qquad d > 0", None),
            (r"= e \quad\text{for } x > 0", Some("c")),
            ("= f - g = h", None),
        ];
        assert_eq!(own, wanted);
    }

    #[test]
    fn what_states_nothing_belongs_to_the_row_before_it() {
        for (tex, wanted) in [
            (r"a &= b \\ &\phantom{=} + c", "a = b + c"),
            (r"a &= b \\ &\hspace{1cm} - c", "a = b - c"),
            (r"a &= b \\ & c", r"a = b \\ c"),
            (r"a &= b \\ &\text{for } x > 0", r"a = b \\ \text{for } x > 0"),
            (
                r"a = b \\ \forall x \in \mathbb{R}",
                r"a = b \\ \forall x \in \mathbb{R}",
            ),
            (r"a &= b \\ &\plus c", r"a = b \\ \plus c"),
        ] {
            let own: Vec<String> = shown(tex).into_iter().map(|row| row.0).collect();
            assert_eq!(own, [wanted], "{tex}");
        }
    }

    #[test]
    fn a_row_behind_a_condition_continues_the_first_side_or_none() {
        for (tex, wanted) in [
            (
                r"|x| &= x \text{ for } x \ge 0, \\ &= -x \text{ for } x < 0",
                Some("|x|"),
            ),
            (r"|x| &= x && (x \ge 0) \\ &= -x && (x < 0)", Some("|x|")),
            (r"|x| &= x \quad \forall x \\ &= y", None),
            (r"a &= b, \quad x > 0 \\ &= c", None),
            (r"a &= b, \\ &= c, \quad x > 0", Some("b")),
        ] {
            let found = shown(tex);
            assert_eq!(found[1].1.as_deref(), wanted, "{tex}");
        }
    }

    #[test]
    fn what_lays_out_rows_is_looked_into() {
        for tex in [
            r"\begin{split} a &= b \\ c &= d \end{split}",
            r"\label{x}\left\{\begin{array}{l} a = b \\ c = d \end{array}\right.",
            r"\begin{alignedat}{2} a &= b \\ c &= d \end{alignedat}.",
        ] {
            let found = shown(tex);
            let own: Vec<&str> = found.iter().map(|row| row.0.as_str()).collect();
            assert_eq!(own, ["a = b", "c = d"], "{tex}");
        }
        let matrix = r"M = \begin{pmatrix} 1 & 2 \\ 3 & 4 \end{pmatrix}";
        assert_eq!(shown(matrix)[0].0, matrix);
        assert_eq!(shown("a = \\\\ b").len(), 1, "an end behind a relation");
    }
}
