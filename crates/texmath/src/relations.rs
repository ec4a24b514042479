//! The signs of relations between values.

/// The relation between two values that a sign states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Related {
    Equal,
    Ordered,
    Unequal,
    Near,
}

/// The signs, the longer before those that they begin with.
const RELATIONS: [(&str, Related); 25] = [
    (":=", Related::Equal),
    ("<=", Related::Ordered),
    (">=", Related::Ordered),
    ("=", Related::Equal),
    ("≡", Related::Equal),
    (r"\equiv", Related::Equal),
    (r"\coloneqq", Related::Equal),
    ("<", Related::Ordered),
    (">", Related::Ordered),
    ("≤", Related::Ordered),
    ("≥", Related::Ordered),
    (r"\lt", Related::Ordered),
    (r"\gt", Related::Ordered),
    (r"\le", Related::Ordered),
    (r"\leq", Related::Ordered),
    (r"\leqslant", Related::Ordered),
    (r"\ge", Related::Ordered),
    (r"\geq", Related::Ordered),
    (r"\geqslant", Related::Ordered),
    ("≠", Related::Unequal),
    (r"\ne", Related::Unequal),
    (r"\neq", Related::Unequal),
    ("≈", Related::Near),
    (r"\approx", Related::Near),
    (r"\simeq", Related::Near),
];

/// Returns what a sign says of the values beside it; nothing where it is no relation that is read.
pub fn related(sign: &str) -> Option<Related> {
    RELATIONS
        .iter()
        .find(|(own, _)| *own == sign)
        .map(|(_, related)| *related)
}

/// Returns the sign that begins a text, where it is no command.
pub fn sign_at(text: &str) -> Option<&'static str> {
    let mut signs = RELATIONS.iter().map(|(sign, _)| *sign);
    signs.find(|sign| !sign.starts_with('\\') && text.starts_with(sign))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_sign_is_met() {
        assert_eq!(sign_at(":= x"), Some(":="));
        assert_eq!(sign_at(">= x"), Some(">="));
        assert_eq!(sign_at(r"\le x"), None);
        assert_eq!(related(r"\leq"), Some(Related::Ordered));
        assert_eq!(related(r"\to"), None);
    }
}
