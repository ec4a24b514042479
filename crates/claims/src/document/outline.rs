//! The outline of a formula that cannot be read whole: which letters it relates, and whether it gives one of them a value.

use super::tex::{Outside, command, is_equating, orders, outside};
use std::collections::BTreeSet;
use texmath::Names;

/// The outline of a formula, from its text alone.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Outline {
    /// The letters before its first relation, and those behind it.
    letters: [BTreeSet<String>; 2],
    /// The left side of its first relation, without blanks, if that is one letter with its marks, or a call.
    name: Option<String>,
    /// True if its first relation makes both sides equal or orders them.
    compares: bool,
}

impl Outline {
    pub(super) fn of(tex: &str) -> Self {
        let relation = outside(tex, 0..tex.len()).into_iter().find_map(|met| match met {
            Outside::Relation(at) => Some(at),
            _ => None,
        });
        let Some(relation) = relation else {
            return Self {
                letters: [letters(tex), BTreeSet::new()],
                ..Self::default()
            };
        };
        let part = |from: usize, to: usize| tex.get(from..to).unwrap_or_default();
        let [left, right] = [part(0, relation.start), part(relation.end, tex.len())];
        let sign = part(relation.start, relation.end);
        let name: String = left.chars().filter(|c| !c.is_whitespace() && *c != '&').collect();
        let is_equal = matches!(sign, "=" | ":=" | "≡" | r"\equiv");
        Self {
            letters: [letters(left), letters(right)],
            compares: is_equal || (!is_equating(sign) && sign != r"\in" && orders(sign)),
            name: Some(name).filter(|name| is_equal && is_name(name)),
        }
    }

    /// The name to which the formula is the first to give a value; `given` holds those that have one.
    pub(super) fn defined(&self, given: &BTreeSet<String>) -> Option<&String> {
        let [left, right] = &self.letters;
        let own = left.iter().next();
        let is_new = |name: &&String| !given.contains(*name) && own.is_none_or(|own| !right.contains(own));
        self.name.as_ref().filter(is_new)
    }

    /// True if it states no equation, or one that holds by what its author says: with a letter that is not `met` before, and
    /// different letters on its sides.
    pub(super) fn is_said(&self, met: &BTreeSet<String>) -> bool {
        let [left, right] = &self.letters;
        !self.compares || (left != right && self.all().any(|letter| !met.contains(letter)))
    }

    /// Its letters.
    pub(super) fn all(&self) -> impl Iterator<Item = &String> {
        self.letters.iter().flatten()
    }
}

fn letters(tex: &str) -> BTreeSet<String> {
    let printed = texmath::letters(tex, &Names::default()).into_iter();
    printed.map(|(letter, _)| letter).collect()
}

/// Returns true for one letter or word with accents, scripts and primes, and at most one pair of brackets behind it.
fn is_name(text: &str) -> bool {
    let (mut heads, mut depth, mut at) = (0_usize, 0_usize, 0_usize);
    let (mut in_script, mut is_called) = (false, false);
    while let Some(c) = text.get(at..).and_then(|rest| rest.chars().next()) {
        let here = at;
        at += c.len_utf8();
        let script = std::mem::take(&mut in_script);
        match c {
            '\\' => {
                let (name, end) = command(text, here);
                at = end;
                let is_frame = matches!(
                    name,
                    "left" | "right" | "big" | "bigl" | "bigr" | "Big" | "Bigl" | "Bigr"
                );
                let is_accent =
                    text.get(end..).is_some_and(|rest| rest.starts_with('{')) && name != "frac" && name != "sqrt";
                let is_letter = name.starts_with(|c: char| c.is_ascii_alphabetic());
                match name {
                    _ if script || is_frame || is_accent => {}
                    "frac" | "sqrt" | "sum" | "int" | "prod" | "lim" | "partial" | "begin" | "cdot" | "times"
                    | "pm" => {
                        return false;
                    }
                    _ if is_letter && depth == 0 => heads += 1,
                    _ => {}
                }
            }
            '_' | '^' => match text.get(at..).and_then(|rest| rest.find('}')) {
                Some(_) if text.get(at..).is_some_and(|rest| rest.starts_with('{')) => {
                    at = closing(text, at);
                }
                _ => in_script = true,
            },
            '(' | '[' => {
                is_called = heads == 1;
                depth += 1;
            }
            ')' | ']' => depth = depth.saturating_sub(1),
            '{' => {
                // the letters of a font or an accent are one name
                let end = closing(text, here);
                heads += usize::from(depth == 0);
                at = end;
            }
            '\'' | '}' => {}
            _ if script || depth > 0 => {}
            c if c.is_alphabetic() && !is_called => heads += 1,
            _ => return false,
        }
    }
    heads == 1
}

/// Returns the end of the group that opens at a byte.
fn closing(text: &str, at: usize) -> usize {
    super::tex::group(text, at, super::tex::BRACES).map_or(text.len(), |own| own.end + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_one_letter_with_its_marks_or_a_call() {
        for name in [
            "x",
            r"P_{t|t-1}",
            r"\hat{\beta}_1",
            r"\mathbf{x}'",
            r"f(x,y)",
            r"\mu",
            r"\mathbb{E}[X]",
            r"x^*",
            r"\text{RSS}",
        ] {
            assert!(is_name(name), "{name}");
        }
        for none in [
            "xy",
            "2x",
            "x+y",
            r"\frac{a}{b}",
            r"f(x)g(y)",
            r"A\mathbf{x}",
            r"\sum_ia_i",
            "",
        ] {
            assert!(!is_name(none), "{none}");
        }
    }

    #[test]
    fn an_outline_knows_what_it_gives_and_what_it_only_says() {
        let none = BTreeSet::new();
        let outline = Outline::of(r"P_{t|t-1} = A \otimes B");
        assert_eq!(outline.defined(&none).map(String::as_str), Some("P_{t|t-1}"));
        assert_eq!(outline.defined(&BTreeSet::from(["P_{t|t-1}".to_owned()])), None);
        assert_eq!(Outline::of(r"P = P \otimes B").defined(&none), None);
        assert!(Outline::of(r"x \sim N(0, 1)").is_said(&none));
        assert!(Outline::of(r"\max_x f \perp g").is_said(&none));
        let link = Outline::of(r"a \circ b = b \circ a");
        assert!(!link.is_said(&none));
        let met: BTreeSet<String> = ["a", "b", "c"].map(str::to_owned).into();
        assert!(!Outline::of(r"a \circ b = c").is_said(&met));
        assert!(Outline::of(r"a \circ b = d").is_said(&met));
    }
}
