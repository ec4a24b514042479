//! Text in an SVG: letters with subscripts as `r_B`, Greek letters by their names, as a person types them.

use crate::markup::escaped_line;
use crate::tex::letter;

/// The size of a subscript and how far it is lowered, in units of the font's size.
const BELOW: f64 = 0.72;
const LOWERED: f64 = 0.22;

/// A part of a text, and whether it is a subscript.
pub(in crate::report) type Piece = (String, bool);

/// The parts of a text: `r_B` is a letter and its subscript, `beta` the letter.
pub(in crate::report) fn pieces(text: &str) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    let mut plain = String::new();
    let mut rest = text;
    while !rest.is_empty() {
        let word = rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len());
        let (own, tail) = rest.split_at(word);
        let greek = letter(&format!("\\{own}")).filter(|letter| ('\u{370}'..'\u{400}').contains(letter));
        let shown = greek.map_or_else(|| own.to_owned(), String::from);
        let is_letter = shown.chars().count() == 1 && shown.chars().all(char::is_alphabetic);
        let is_within = plain.ends_with('_');
        plain.push_str(&shown);
        rest = tail;
        if is_letter
            && !is_within
            && let Some((below, after)) = subscript(rest)
        {
            pieces.push((std::mem::take(&mut plain), false));
            pieces.push((below.to_owned(), true));
            rest = after;
            continue;
        }
        // signs and blanks up to the next word
        let gap = rest.find(char::is_alphanumeric).unwrap_or(rest.len());
        let (own, tail) = rest.split_at(gap);
        plain.push_str(own);
        rest = tail;
    }
    pieces.push((plain, false));
    pieces.retain(|(text, _)| !text.is_empty());
    pieces
}

/// What stands behind a letter as its subscript, and the rest.
fn subscript(rest: &str) -> Option<(&str, &str)> {
    let below = rest.strip_prefix('_')?;
    let end = below.find(|c: char| !c.is_alphanumeric()).unwrap_or(below.len());
    let is_short = (1..=3).contains(&below.get(..end)?.chars().count());
    (is_short && !below.get(end..)?.starts_with('_')).then(|| below.split_at(end))
}

/// The text as XML has it, in a font of this size.
pub(super) fn typeset(text: &str, size: f64) -> String {
    let (small, lowered) = ((BELOW * size).round(), (LOWERED * size).round());
    let mut out = String::new();
    let mut is_below = false;
    for (piece, below) in pieces(text) {
        let piece = escaped_line(&piece);
        out.push_str(&match (is_below, below) {
            (_, true) => format!("<tspan dy=\"{lowered}\" font-size=\"{small}\">{piece}</tspan>"),
            (true, false) => format!("<tspan dy=\"-{lowered}\">{piece}</tspan>"),
            (false, false) => piece,
        });
        is_below = below;
    }
    out
}

/// About how wide a text is as it is typeset, in units of the font's size.
pub(super) fn width(text: &str) -> f64 {
    let wide = |(piece, below): &Piece| advance(piece) * if *below { BELOW } else { 1.0 };
    pieces(text).iter().map(wide).sum()
}

/// The size of a font at which a text has room, as large as asked where it can be and legible whatever.
pub(super) fn fitting(text: &str, size: f64, room: f64) -> f64 {
    const LEAST: f64 = 11.0;
    size.min((room / width(text).max(1.0)).max(LEAST))
}

/// About how wide text is, in units of the font's size: that of DejaVu Sans, the widest of the family that is asked
/// for, so that nothing overlaps in any of them.
fn advance(text: &str) -> f64 {
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
    fn letters_have_their_subscripts_and_greek_names_are_letters() {
        let shown = |text: &str| typeset(text, 100.0);
        assert_eq!(
            shown("r_B = 0.5, beta"),
            "r<tspan dy=\"22\" font-size=\"72\">B</tspan><tspan dy=\"-22\"> = 0.5, \u{3b2}</tspan>"
        );
        for plain in [
            "node_focus",
            "simulated, top",
            "a < b",
            "x_",
            "_x",
            "f64",
            "d_e_f",
            "alphabet",
        ] {
            assert_eq!(pieces(plain), [(plain.to_owned(), false)]);
        }
        assert_eq!(shown("a < b"), "a &lt; b");
        assert_eq!(pieces("T_12"), [("T".to_owned(), false), ("12".to_owned(), true)]);
    }

    #[test]
    fn wide_words_are_wider() {
        assert!(width("mmm") > width("nnn") && width("nnn") > width("iii") && width("") == 0.0);
    }
}
