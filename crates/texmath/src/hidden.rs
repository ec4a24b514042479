//! Terms that cannot be read, each put out of sight as one symbol, so that what is around it can be.

use super::command::is_unread;
use super::relations::related;
use super::shorthand::{OPAQUE, Plain, opened};
use super::{Name, Names};
use std::borrow::Cow;
use std::ops::Range;

/// The most terms of a formula that are put out of sight.
pub(super) const MOST: usize = 4;

/// Signs between sides and what is said of them, beside relations.
const BETWEEN_SIDES: [&str; 11] = [
    ",", ";", "&", r"\\", r"\quad", r"\qquad", r"\text", r"\textrm", r"\textit", r"\mbox", r"\forall",
];

fn is_between_sides(sign: &str) -> bool {
    BETWEEN_SIDES.contains(&sign) || related(sign).is_some()
}

/// Signs between terms.
const BETWEEN_TERMS: [&str; 6] = ["+", "-", "−", "±", r"\pm", r"\mp"];

/// Operators that may take in the terms that follow.
const TAKING_TERMS: [&str; 17] = [
    r"\int", r"\oint", r"\iint", r"\iiint", r"\sum", r"\prod", r"\lim", r"\limsup", r"\liminf", r"\max", r"\min",
    r"\sup", r"\inf", r"\argmax", r"\argmin", r"\bigcup", r"\bigcap",
];

/// Brackets that open and close.
const OPENING: [&str; 9] = [
    "{", "(", "[", r"\{", r"\left", r"\langle", r"\lfloor", r"\lceil", r"\lvert",
];
const CLOSING: [&str; 9] = [
    "}", ")", "]", r"\}", r"\right", r"\rangle", r"\rfloor", r"\rceil", r"\rvert",
];

/// Signs of a formula that is not parted into terms: brackets that open as they close, relations and arrows that are not read,
/// environments.
const PARTING: [&str; 20] = [
    "|",
    r"\|",
    r"\vert",
    r"\Vert",
    r"\mid",
    r"\bigg|",
    r"\sim",
    r"\simeq",
    r"\propto",
    r"\to",
    r"\mapsto",
    r"\Rightarrow",
    r"\Leftrightarrow",
    r"\implies",
    r"\iff",
    r"\rightarrow",
    r"\begin",
    r"\end",
    r"\cap",
    r"\cup",
];

/// Signs of a term without a value: dots of matrices, relations and questions.
const NO_VALUES: [&str; 4] = [r"\vdots", r"\ddots", r"\sim", "?"];

/// Dots in the place of terms or factors.
pub(super) const DOTS: [&str; 7] = [r"\dots", r"\ldots", r"\cdots", r"\hdots", r"\dotsc", r"\dotsb", "…"];

/// Returns true if a text leaves terms or factors out by dots outside of brackets, of which nobody knows what they are.
pub fn has_dots(text: &str) -> bool {
    let all = signs(text);
    outside(&all).any(|(_, sign)| DOTS.contains(&sign))
}

/// Returns true for a list in brackets that is not whole, `(x_1, \dots, x_n)`.
fn is_list_with_dots(term: &str) -> bool {
    let all = signs(term);
    let is_listed = |pair: &[Sign<'_>]| matches!(pair, [comma, dots] if comma.text == "," && DOTS.contains(&dots.text));
    all.first().is_some_and(|first| OPENING.contains(&first.text)) && all.windows(2).any(is_listed)
}

/// The name of a term that is out of sight, as it prints.
pub(super) fn name(text: &str, names: &Names) -> Option<Name> {
    let is_one = !outside(&signs(text)).any(|(_, sign)| is_between_sides(sign) || PARTING.contains(&sign));
    (names.opaque.is_some() && is_one && has_value(text)).then(|| Name {
        base: opened(text).replace(OPAQUE, ""),
        ..Name::default()
    })
}

/// A command or a character, with its place.
struct Sign<'a> {
    text: &'a str,
    at: usize,
}

fn signs(text: &str) -> Vec<Sign<'_>> {
    let (mut found, mut at) = (Vec::new(), 0);
    while let Some(c) = text.get(at..).and_then(|rest| rest.chars().next()) {
        let rest = text.get(at + c.len_utf8()..).unwrap_or_default();
        let behind = match c {
            '\\' => match rest.bytes().take_while(u8::is_ascii_alphabetic).count() {
                0 => rest.chars().next().map_or(0, char::len_utf8),
                letters => letters,
            },
            // a term that is out of sight already
            _ if c == OPAQUE[0] => rest.find(OPAQUE[1]).map_or(0, |end| end + OPAQUE[1].len_utf8()),
            _ => 0,
        };
        let end = at + c.len_utf8() + behind;
        if !c.is_whitespace() {
            let text = text.get(at..end).unwrap_or_default();
            found.push(Sign { text, at });
        }
        at = end;
    }
    found
}

/// The signs outside of brackets, with their numbers; a bracket that closes is one.
fn outside<'a>(all: &'a [Sign<'a>]) -> impl Iterator<Item = (usize, &'a str)> {
    let mut depth = 0_usize;
    let signs = all.iter().map(|sign| sign.text).enumerate();
    signs.filter(move |(_, sign)| {
        depth += usize::from(OPENING.contains(sign));
        depth = depth.saturating_sub(usize::from(CLOSING.contains(sign)));
        depth == 0
    })
}

/// The term around a byte of a formula; none where it is not clear where it begins and ends, or has no value.
fn term(text: &str, place: usize) -> Option<Range<usize>> {
    let all = signs(text);
    // a side, the term in it, and the first term in it that an operator may take others into
    let (mut side, mut own) = (0..text.len(), 0..text.len());
    let (mut taking, mut is_taking, mut is_found) = (None, false, false);
    let (mut depth, mut before, mut is_delimiter) = (0_usize, "", false);
    for sign in &all {
        let is_met = sign.at >= place;
        if std::mem::take(&mut is_delimiter) {
            before = sign.text;
            continue;
        }
        if OPENING.contains(&sign.text) {
            depth += 1;
        } else if CLOSING.contains(&sign.text) {
            depth = depth.checked_sub(1)?;
        } else if depth == 0 {
            let is_script = ["^", "_"].contains(&before);
            if PARTING.contains(&sign.text) {
                return None;
            }
            is_taking |= TAKING_TERMS.contains(&sign.text);
            // \int f dx ends here
            let is_differential = before == "d" || before == r"\mathrm";
            is_taking &= !(is_differential && has_integral(text.get(own.start..sign.at)?));
            if is_between_sides(sign.text) {
                if is_found || is_met {
                    own.end = own.end.min(sign.at);
                    side.end = sign.at;
                    break;
                }
                (side.start, own.start) = (sign.at + sign.text.len(), sign.at + sign.text.len());
                (taking, is_taking) = (None, false);
            } else if BETWEEN_TERMS.contains(&sign.text) && !is_script {
                if is_taking && taking.is_none() {
                    taking = Some(own.start);
                }
                if is_met && !is_found {
                    own.end = sign.at;
                    is_found = true;
                }
                if !is_found {
                    own.start = sign.at + sign.text.len();
                }
            }
        }
        is_delimiter = [r"\left", r"\right"].contains(&sign.text);
        before = sign.text;
    }
    if depth > 0 && side.end == text.len() {
        return None;
    }
    if is_taking && taking.is_none() {
        taking = Some(own.start);
    }
    if let Some(start) = taking.filter(|start| *start <= own.start) {
        own = start..side.end;
    } else if may_take_terms(text.get(own.clone())?) {
        own = side.clone();
    }
    let inside = text.get(own.clone())?;
    let blanks = |c: char| c.is_whitespace() || c == '.' || c == '~';
    let length = inside
        .trim_end_matches(blanks)
        .trim_end_matches([',', ';', '\\'])
        .trim_end_matches(blanks)
        .len();
    let start = own.start + inside.len() - inside.trim_start().len();
    // 1, 2, \dots
    if DOTS.contains(&inside.trim()) && text.get(..own.start)?.trim_end().ends_with(',') {
        return None;
    }
    let own = start..own.start + length;
    (own.contains(&place) && has_value(text.get(own.clone())?)).then_some(own)
}

/// Returns true if a command that is not read stands between factors of a term, where it may print any sign, or begins it with an
/// index, as a sum does.
fn may_take_terms(term: &str) -> bool {
    let all = signs(term);
    outside(&all).filter(|(_, sign)| is_unread(sign)).any(|(number, _)| {
        let next = all.get(number + 1).map_or("", |next| next.text);
        match number {
            0 => next == "_",
            _ => !next.is_empty() && !["{", "_", "^", "'"].contains(&next),
        }
    })
}

fn has_integral(text: &str) -> bool {
    text.contains(r"\int") || text.contains(r"\oint") || text.contains(r"\iint") || text.contains(r"\iiint")
}

/// Returns true for a term that has a value, if its letters have.
fn has_value(term: &str) -> bool {
    let all = signs(term);
    let is_order = |pair: &[Sign<'_>]| matches!(pair, [name, open] if ["O", "o"].contains(&name.text) && ["(", r"\left"].contains(&open.text));
    let is_antiderivative = |pair: &[Sign<'_>]| matches!(pair, [sign, next] if sign.text == r"\int" && !["_", r"\limits"].contains(&next.text));
    let leaves_out = all.iter().any(|sign| NO_VALUES.contains(&sign.text)) || is_list_with_dots(term);
    let words = ["const", "h.o.t", "c.c.", r"\mathcal{O}", r"\mathcal O"];
    let ends_open = all.last().is_none_or(|last| {
        [
            r"\nabla",
            r"\partial",
            r"\int",
            r"\sum",
            r"\cdot",
            r"\times",
            "^",
            "_",
            "/",
            "*",
        ]
        .contains(&last.text)
    });
    // \frac{d}{dt} with nothing behind it
    let operator = term.rfind(r"\frac").and_then(|at| term.get(at + r"\frac".len()..));
    let is_operator = operator.is_some_and(|rest| {
        let bare: String = rest.chars().filter(|c| !c.is_whitespace()).collect();
        let starts = ["{d}{d", r"{\partial}{\partial", r"{\mathrm{d}}{"]
            .iter()
            .any(|start| bare.starts_with(start));
        starts && bare.matches('}').count() <= 2
    });
    !leaves_out
        && !ends_open
        && !is_operator
        && !all.windows(2).any(|pair| is_order(pair) || is_antiderivative(pair))
        && !words.iter().any(|word| term.contains(word))
}

impl Plain<'_> {
    /// The formula with the term around a place of the source as one symbol.
    pub(super) fn hidden(&self, source: usize) -> Option<Self> {
        let own = term(&self.text, self.place(source)?)?;
        let inside: String = self.text.get(own.clone())?.replace(OPAQUE, "");
        let symbol = opened(&inside);
        let text = [self.text.get(..own.start)?, &symbol, self.text.get(own.end..)?].concat();
        let shift = |at: usize| at - own.end + own.start + symbol.len();
        let parts = match self.parts.is_empty() {
            true => vec![(0, 0, true)],
            false => self.parts.clone(),
        };
        let mut moved: Vec<(usize, usize, bool)> =
            parts.iter().filter(|(start, ..)| *start < own.start).copied().collect();
        moved.push((own.start, self.source(own.start), false));
        if let Some((start, from, is_copied)) = parts.iter().rev().find(|(start, ..)| *start <= own.end) {
            let within = if *is_copied { own.end - start } else { 0 };
            moved.push((shift(own.end), from + within, *is_copied));
        }
        let behind = parts.iter().filter(|(start, ..)| *start > own.end);
        moved.extend(behind.map(|(start, from, is_copied)| (shift(*start), *from, *is_copied)));
        Some(Self {
            text: Cow::Owned(text),
            parts: moved,
        })
    }

    /// Returns the place in the text of a byte of the source.
    fn place(&self, source: usize) -> Option<usize> {
        if self.parts.is_empty() {
            return Some(source);
        }
        let ends = self
            .parts
            .iter()
            .skip(1)
            .map(|(start, ..)| *start)
            .chain([self.text.len()]);
        self.parts.iter().zip(ends).find_map(|((start, from, is_copied), end)| {
            let at = source.checked_sub(*from)?;
            match is_copied {
                true => (at < end - start).then_some(start + at),
                false => (at == 0).then_some(*start),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown<'t>(text: &'t str, at: &str) -> &'t str {
        term(text, text.find(at).unwrap()).map_or("", |own| &text[own])
    }

    #[test]
    fn a_term_ends_at_signs_outside_of_brackets() {
        for (text, at, wanted) in [
            (r"a = b + 2 \int_S f dS - c", r"\int", r"2 \int_S f dS"),
            (r"a = (b + !x) c + d", "!", "(b + !x) c"),
            (r"- x_{;} + y = 0", ";", r"x_{;}"),
            (r"u^{-1} = e^-x \foo y, \quad n > 0", r"\foo", r"e^-x \foo y"),
            (r"\sum_i a_i + b_i = c", r"\sum", r"\sum_i a_i + b_i"),
            (r"z = a + b \pl c", r"\pl", r"a + b \pl c"),
            (r"z = a + b \oplus c", r"\oplus", r"a + b \oplus c"),
            (r"z = a + b \inv", r"\inv", r"b \inv"),
            (r"a_1 + a_2 \cdots a_n = b", r"\cdots", r"a_1 + a_2 \cdots a_n"),
            (r"z = \Sum_i a_i + b_i", r"\Sum", r"\Sum_i a_i + b_i"),
            (r"z = a + \inv{2} b", r"\inv", r"\inv{2} b"),
            (r"\int_S f + g dS = c + d", "g", r"\int_S f + g dS"),
            (r"\int_S f dS + g = c", r"\int", r"\int_S f dS"),
            (r"\left. F \right) + b; = 1.", "F", r"\left. F \right)"),
        ] {
            assert_eq!(shown(text, at), wanted, "{text}");
        }
    }

    #[test]
    fn what_has_no_clear_end_or_no_value_stays_in_sight() {
        for (text, at) in [
            ("|a + b| = c", "a"),
            (r"p(x) \sim q + r", "q"),
            (r"A = \begin{pmatrix} \vdots \end{pmatrix}", r"\vdots"),
            (r"x = y + O(h^2)", "O"),
            (r"F = \int f dx + C", r"\int"),
            (r"\hat p = -i \hbar \frac{\partial}{\partial x}", r"\frac"),
            (r"a + b) = c", "a"),
            (r"a + \nabla = c", r"\nabla"),
            (r"a + b = c", "+"),
        ] {
            assert_eq!(shown(text, at), "", "{text}");
        }
    }

    #[test]
    fn a_term_out_of_sight_is_a_name() {
        let names = Names {
            opaque: Some(super::super::Opaque::default()),
            ..Names::default()
        };
        for text in [r"2\int_SvdS", r"a\pl b", r"\inv{2}\qdot_1"] {
            assert_eq!(name(text, &names).map(|name| name.base).as_deref(), Some(text));
            assert_eq!(super::super::read_expression(text, &names).unwrap().to_string(), text);
        }
    }
}
