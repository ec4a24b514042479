//! Formulas of Markdown in quotes, and those that are printed by way of its own escapes: `\\[ a = b \\]`, `\\( x \\)`.

use std::borrow::Cow;

/// Writes blanks in the place of the signs `>` that begin the lines of a quote. Within a display that begins outside of a quote such a
/// sign is a relation, and in code it is what it is.
pub(super) fn unquoted(text: &str) -> Cow<'_, str> {
    let is_quoted = |line: &str| line.trim_start_matches(' ').starts_with('>');
    if !text.lines().any(is_quoted) {
        return Cow::Borrowed(text);
    }
    let mut written = String::with_capacity(text.len());
    // whether a display is open, and whether it began in a quote
    let (mut is_display, mut began_quoted, mut is_code) = (false, false, false);
    for line in text.split_inclusive('\n') {
        let is_sign = is_quoted(line) && !is_code && (!is_display || began_quoted);
        let signs = line.len() - line.trim_start_matches([' ', '>']).len();
        let (signs, rest) = line.split_at(if is_sign { signs } else { 0 });
        written.extend(signs.chars().map(|_| ' '));
        written.push_str(rest);
        is_code ^= rest.trim_start().starts_with("```");
        let (opened, closed) = DISPLAYS.iter().fold((0, 0), |(opened, closed), [open, close]| {
            (
                opened + rest.matches(open).count(),
                closed + rest.matches(close).count(),
            )
        });
        let was_display = is_display;
        is_display = (is_display ^ (rest.matches("$$").count() % 2 == 1) || opened > closed) && closed <= opened;
        if is_display && !was_display {
            began_quoted = is_sign;
        }
    }
    Cow::Owned(written)
}

/// The signs that open and close displays, beside dollars.
const DISPLAYS: [[&str; 2]; 5] = [
    [r"\[", r"\]"],
    [r"\begin{equation", r"\end{equation"],
    [r"\begin{align", r"\end{align"],
    [r"\begin{gather", r"\end{gather"],
    [r"\begin{multline", r"\end{multline"],
];

/// Writes displays between `\\[` and `\\]` as those between `\[` and `\]`, formulas between `\\(` and `\\)` as those between dollars,
/// and what is escaped within as it prints; each byte stays in its place.
pub(super) fn unescaped(text: &str) -> Cow<'_, str> {
    if ![r"\\[", r"\\("].iter().any(|open| text.contains(open)) {
        return Cow::Borrowed(text);
    }
    let mut written = String::with_capacity(text.len());
    // in a display between dollars, where `\\[` begins a row, or in code
    let (mut is_display, mut is_code) = (false, false);
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        if rest.starts_with("```") || (rest.starts_with("$$") && !is_code) {
            let sign = rest.get(..2 + usize::from(c == '`')).unwrap_or_default();
            is_code ^= c == '`';
            is_display ^= c == '$';
            written.push_str(sign);
            rest = rest.get(sign.len()..).unwrap_or_default();
            continue;
        }
        let pair = [(r"\\[", r"\\]", r" \[", r" \]"), (r"\\(", r"\\)", "  $", "$  ")];
        let found = pair
            .iter()
            .filter(|_| !is_display && !is_code)
            .find_map(|(open, close, opens, closes)| {
                let inside = rest.strip_prefix(open)?;
                let end = inside.find("\n\n").unwrap_or(inside.len());
                let inside = inside.get(..inside.get(..end)?.find(close)?)?;
                let length = open.len() + inside.len() + close.len();
                Some((format!("{opens}{}{closes}", printed(inside)), length))
            });
        let (own, length) = found.unwrap_or_else(|| (c.to_string(), c.len_utf8()));
        written.push_str(&own);
        rest = rest.get(length..).unwrap_or_default();
    }
    Cow::Owned(written)
}

/// Writes a formula as it prints in which a backslash escapes the next character of punctuation.
fn printed(formula: &str) -> String {
    const ESCAPES: [(&str, &str); 5] = [
        (r"\\\\", r"  \\"),
        (r"\\", r" \"),
        (r"\'", " '"),
        (r"\_", " _"),
        (r"\*", " *"),
    ];
    let mut written = String::with_capacity(formula.len());
    let mut rest = formula;
    while let Some(c) = rest.chars().next() {
        let escape = ESCAPES.iter().find(|(escape, _)| rest.starts_with(escape));
        match escape {
            Some((_, own)) => written.push_str(own),
            None => written.push(c),
        }
        rest = rest
            .get(escape.map_or(c.len_utf8(), |(escape, _)| escape.len())..)
            .unwrap_or_default();
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_of_quotes_are_blanks_and_relations_stay() {
        for (text, wanted) in [
            (
                "> so\n> $$\n> a = b\n> + c\n> $$\n",
                "  so\n  $$\n  a = b\n  + c\n  $$\n",
            ),
            ("$$\na\n> b\n$$\n> $$ c\n> > d $$", "$$\na\n> b\n$$\n  $$ c\n    d $$"),
            ("> \\[\n>  a \\]\n\\[ b\n> c \\]", "  \\[\n   a \\]\n\\[ b\n> c \\]"),
            (
                "> \\begin{align}\n> a\n> \\end{align}",
                "  \\begin{align}\n  a\n  \\end{align}",
            ),
            ("```\n> a\n```\n> b", "```\n> a\n```\n  b"),
            ("$a$ and $b > c$", "$a$ and $b > c$"),
        ] {
            let found = unquoted(text);
            assert_eq!((found.as_ref(), found.len()), (wanted, text.len()), "{text}");
        }
    }

    #[test]
    fn what_markdown_escapes_is_read_as_it_prints_and_stays_in_its_place() {
        for (text, wanted) in [
            (r"so \\[f\'(a) = 2a\\] is", r"so  \[f '(a) = 2a \] is"),
            (r"\\[a \\le b_1 \\\\ c\_1\\]", r" \[a  \le b_1   \\ c _1 \]"),
            (r"the \\(a\\) of", "the   $a$   of"),
            (r"$$ a \\[2pt] b $$ \\[ c \\]", r"$$ a \\[2pt] b $$  \[ c  \]"),
            ("```\n\\\\[ c \\\\]\n```", "```\n\\\\[ c \\\\]\n```"),
            (r"\\[ a", r"\\[ a"),
        ] {
            let found = unescaped(text);
            assert_eq!((found.as_ref(), found.len()), (wanted, text.len()), "{text}");
        }
    }
}
