//! Text in an SVG: symbols in italics, letters with subscripts as `r_B`, Greek letters by their names, as a person types
//! them; between dollar signs every letter alone is a symbol, and `^` raises what follows.

use crate::markup::escaped_line;
use crate::tex::letter;

/// The size of a subscript or superscript and how far it is moved, in units of the font's size.
const SMALL: f64 = 0.72;
const LOWERED: f64 = 0.22;
const RAISED: f64 = 0.38;

/// The height of a part of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::report) enum Level {
    Line,
    Below,
    Above,
}

/// A part of a text in one font.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::report) struct Piece {
    pub text: String,
    pub level: Level,
    /// Symbols of quantities are in italics.
    pub is_symbol: bool,
}

/// Returns the parts of a text: `r_B` is a symbol and its subscript, `beta` and `d = 1` begin with symbols.
pub(in crate::report) fn pieces(text: &str) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    let mut rest = text;
    while let Some((before, (inner, after))) = rest
        .split_once('$')
        .and_then(|(before, rest)| Some((before, rest.split_once('$')?)))
    {
        parse(before, false, &mut pieces);
        parse(inner, true, &mut pieces);
        rest = after;
    }
    parse(rest, false, &mut pieces);
    pieces
}

/// Adds the parts of a text without dollar signs.
fn parse(text: &str, is_formula: bool, pieces: &mut Vec<Piece>) {
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        if is_formula && let Some((raised, tail)) = rest.strip_prefix('^').map(split_raised) {
            push(pieces, raised, Level::Above, false);
            rest = tail;
            continue;
        }
        if !c.is_alphanumeric() {
            let gap = rest.find(|c: char| c.is_alphanumeric() || (is_formula && c == '^'));
            let (own, tail) = rest.split_at(gap.unwrap_or(rest.len()));
            push(pieces, own, Level::Line, false);
            rest = tail;
            continue;
        }
        let end = rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len());
        let greek = letter(&format!("\\{}", &rest[..end])).filter(|letter| ('\u{370}'..'\u{400}').contains(letter));
        // letters of a formula side by side are a product
        let end = if is_formula && greek.is_none() {
            c.len_utf8()
        } else {
            end
        };
        let (own, tail) = rest.split_at(end);
        rest = tail;
        let shown = greek.map_or_else(|| own.to_owned(), String::from);
        let is_letter = shown.chars().count() == 1 && shown.chars().all(char::is_alphabetic);
        let is_within = pieces.last().is_some_and(|last| last.text.ends_with('_'));
        let below = subscript(rest).filter(|_| is_letter && !is_within);
        let is_named = greek.is_some() || is_formula || below.is_some() || is_set(rest);
        // the number pi is no quantity
        push(pieces, &shown, Level::Line, is_letter && is_named && shown != "\u{3c0}");
        if let Some((below, after)) = below {
            push(pieces, below, Level::Below, false);
            rest = after;
        }
    }
}

/// Adds text to the last part where that looks the same.
fn push(pieces: &mut Vec<Piece>, text: &str, level: Level, is_symbol: bool) {
    match pieces.last_mut() {
        Some(last) if (last.level, last.is_symbol) == (level, is_symbol) => last.text.push_str(text),
        _ if text.is_empty() => {}
        _ => pieces.push(Piece {
            text: text.to_owned(),
            level,
            is_symbol,
        }),
    }
}

/// Splits a superscript from what follows it: a sign and digits.
fn split_raised(rest: &str) -> (&str, &str) {
    let is_raised = |c: char| c.is_ascii_digit() || c == '-' || c == '\u{2212}';
    rest.split_at(rest.find(|c| !is_raised(c)).unwrap_or(rest.len()))
}

/// Returns true if the text before is set equal to something.
fn is_set(rest: &str) -> bool {
    rest.trim_start().starts_with('=')
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
    let mut out = String::new();
    // how far the line is from where it began
    let mut down = 0;
    for Piece { text, level, is_symbol } in pieces(text) {
        let wanted = match level {
            Level::Line => 0.0,
            Level::Below => LOWERED * size,
            Level::Above => -RAISED * size,
        };
        let moved = wanted.round() as i32 - down;
        down += moved;
        let mut attributes = String::new();
        if moved != 0 {
            attributes.push_str(&format!(" dy=\"{moved}\""));
        }
        if level != Level::Line {
            attributes.push_str(&format!(" font-size=\"{}\"", (SMALL * size).round()));
        }
        if is_symbol {
            attributes.push_str(" font-style=\"italic\"");
        }
        let text = escaped_line(&text);
        out.push_str(&match attributes.as_str() {
            "" => text,
            attributes => format!("<tspan{attributes}>{text}</tspan>"),
        });
    }
    out
}

/// About how wide a text is as it is typeset, in units of the font's size.
pub(super) fn width(text: &str) -> f64 {
    let wide = |piece: &Piece| advance(&piece.text) * if piece.level == Level::Line { 1.0 } else { SMALL };
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
            "<tspan font-style=\"italic\">r</tspan><tspan dy=\"22\" font-size=\"72\">B</tspan><tspan dy=\"-22\"> = 0.5, \
             </tspan><tspan font-style=\"italic\">\u{3b2}</tspan>"
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
            let whole = Piece {
                text: plain.to_owned(),
                level: Level::Line,
                is_symbol: false,
            };
            assert_eq!(pieces(plain), [whole]);
        }
        assert_eq!(shown("a < b"), "a &lt; b");
    }

    #[test]
    fn symbols_are_in_italics_and_words_units_and_numbers_upright() {
        let symbols = |text: &str| -> String {
            let found = pieces(text).into_iter().filter(|piece| piece.is_symbol);
            found.map(|piece| piece.text).collect()
        };
        assert_eq!(symbols("gap $d$  [$A\u{3c0}\u{b2}/(M\u{3c9}\u{b2})$]"), "dAM\u{3c9}");
        assert_eq!(symbols("A ball on a table, d = 0.3, beta = pi/6"), "d\u{3b2}");
        assert_eq!(symbols("BT, 5 N and 3 $"), "");
        assert_eq!(
            typeset("$10^\u{2212}5$", 100.0),
            "10<tspan dy=\"-38\" font-size=\"72\">\u{2212}5</tspan>"
        );
    }

    #[test]
    fn wide_words_are_wider() {
        assert!(width("mmm") > width("nnn") && width("nnn") > width("iii") && width("") == 0.0);
    }
}
