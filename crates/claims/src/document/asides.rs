//! Formulas within the text that say what a letter is or that something holds: `where $N = N_t + N_c$`, `let $u = x^4$`.

/// Words in front of what is said of the display before, and of what comes after.
const BEHIND: [&str; 2] = ["where", "with"];
const IN_FRONT: [&str; 20] = [
    "let",
    "define",
    "denote",
    "since",
    "because",
    "recall",
    "recall that",
    "set",
    "setting",
    "write",
    "writing",
    "put",
    "putting",
    "introduce",
    "introducing",
    "denoting",
    "defining",
    "given that",
    "using",
    "note that",
];

/// Words and signs between two such formulas.
const BETWEEN: [&str; 6] = ["and", ",", ", and", ", where", "and where", ", with"];

/// What a formula has that gives no letter and states no equality of values.
const NO_EQUALITIES: [&str; 24] = [
    "<",
    ">",
    r"\le",
    r"\ge",
    r"\lt",
    r"\gt",
    r"\ne",
    r"\approx",
    r"\sim",
    r"\in",
    r"\to",
    r"\dots",
    r"\ldots",
    r"\cdots",
    r"\subset",
    r"\Rightarrow",
    r"\iff",
    r"\propto",
    r"\equiv",
    r"\mapsto",
    r"\pm",
    r"\{",
    r"\infty",
    "?",
];

/// The longest formula within the text that is looked at.
const LONGEST: usize = 200;

/// Returns true if a formula is one equation, and not the value of a letter as a case has it, `x = 0`.
pub(super) fn states(tex: &str) -> bool {
    let Some((left, right)) = tex.split_once('=').filter(|_| tex.len() <= LONGEST) else {
        return false;
    };
    let is_number = |side: &str| {
        let side = side.trim().trim_end_matches(['.', ',']);
        side.is_empty() || side.chars().all(|c| c.is_ascii_digit() || ".-+ ".contains(c))
    };
    let is_there = |sign: &str| {
        let ends = |at: usize| {
            let behind = tex.get(at + sign.len()..).unwrap_or_default();
            !behind.starts_with(|c: char| c.is_ascii_alphabetic())
        };
        tex.match_indices(sign)
            .any(|(at, _)| !sign.starts_with('\\') || ends(at))
    };
    !right.contains('=')
        && !left.trim_end().ends_with(':')
        && !is_number(left)
        && !is_number(right)
        && !tex.contains(',')
        && !NO_EQUALITIES.iter().any(|sign| is_there(sign))
}

/// Returns whether what words in front of a formula announce is said of the display before; nothing where they announce nothing.
/// `between` is the text since the formula before that was announced, if any, and whether that was said of the display before.
pub(super) fn announced(before: &str, between: Option<(&str, bool)>) -> Option<bool> {
    if let Some((between, is_behind)) = between
        && BETWEEN.contains(&between.split_whitespace().collect::<Vec<_>>().join(" ").as_str())
    {
        return Some(is_behind);
    }
    let start = before.char_indices().rev().nth(40).map_or(0, |(start, _)| start);
    let near = before.get(start..).unwrap_or_default().trim_end().to_lowercase();
    let ends_in = |word: &str| {
        near.strip_suffix(word)
            .is_some_and(|rest| !rest.ends_with(|c: char| c.is_alphanumeric()))
    };
    // `replace this with $...$`
    let is_first = |word: &str| {
        let before = near.strip_suffix(word).unwrap_or_default().trim_end();
        ["}", r"\]", "$$", ","].iter().any(|end| before.ends_with(end))
    };
    match (
        BEHIND
            .iter()
            .any(|word| ends_in(word) && (*word == "where" || is_first(word))),
        IN_FRONT.iter().any(|word| ends_in(word)),
    ) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_words_announce_is_told_from_cases() {
        assert_eq!(announced("This holds, where", None), Some(true));
        assert_eq!(announced("Let", None), Some(false));
        assert_eq!(announced("We recall that", None), Some(false));
        for text in ["if", "when", "for", "elsewhere", "at", "assume", ""] {
            assert_eq!(announced(text, None), None, "{text}");
        }
        assert_eq!(announced("where $a = b$ and", Some(("  and ", true))), Some(true));
        assert_eq!(
            announced("where $a = b$ and this is", Some((" and this is ", true))),
            None
        );
        assert!(states("N = N_t + N_c") && states("A C = I") && states(r"\bar x = \frac{1}{n} s"));
        for tex in [
            "x = 0",
            "n = 1, 2",
            "a < b = c",
            "a = b = c",
            "k = -2.5",
            "x = ",
            r"i = 1, \dots, n",
            "y := x",
        ] {
            assert!(!states(tex), "{tex}");
        }
    }
}
