//! Formulas of Markdown that are printed by way of its own escapes: `\\[ a = b \\]`, `\\( x \\)`.

use std::borrow::Cow;

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
