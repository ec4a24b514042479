//! Text in an SVG.

/// `text` as XML has it. What XML has no way to say becomes U+FFFD.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for sign in text.chars() {
        match sign {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.push(' '),
            '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            _ if crate::report::acts_on_a_terminal(sign) => out.push('\u{fffd}'),
            other => out.push(other),
        }
    }
    out
}

/// About how wide text is, in units of the font's size: that of DejaVu Sans, the widest of the family that is asked
/// for, so that nothing overlaps in any of them.
pub(super) fn width(text: &str) -> f64 {
    let wide = |sign: char| match sign {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '|' | '\'' | '!' | ' ' | '/' | 'I' => 0.33,
        'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '-' => 0.41,
        'm' | 'w' | 'M' | 'W' | '%' | '@' => 0.98,
        '=' | '+' | '\u{2212}' | '<' | '>' => 0.84,
        'A'..='Z' | '\u{17b}' => 0.72,
        _ => 0.63,
    };
    text.chars().map(wide).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_xml_reserves_is_escaped() {
        assert_eq!(
            escaped("a<b & \"c\">\n\u{1}é"),
            "a&lt;b &amp; &quot;c&quot;&gt; \u{fffd}é"
        );
    }

    #[test]
    fn wide_words_are_wider() {
        assert!(width("mmm") > width("nnn") && width("nnn") > width("iii") && width("") == 0.0);
    }
}
