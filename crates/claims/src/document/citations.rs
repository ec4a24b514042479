//! The formulas that the text in front of a display names: `substituting \eqref{a} into \eqref{b}`.

use super::scan::Formula;

/// The most bytes in front of a display that are looked at.
const FARTHEST: usize = 800;

/// Commands and roles that print the numbers of formulas, with what ends the list of names behind them.
const REFERENCES: [(&str, char); 9] = [
    (r"\eqref{", '}'),
    (r"\ref{", '}'),
    (r"\cref{", '}'),
    (r"\Cref{", '}'),
    (r"\autoref{", '}'),
    (r"\labelcref{", '}'),
    ("{eq}`", '`'),
    ("{numref}`", '`'),
    (":eq:`", '`'),
];

/// Words in a sentence that does not say that what it names holds.
const AGAINST: [&str; 9] = [
    "not",
    "instead",
    "unlike",
    "contrast",
    "contradicts",
    "wrong",
    "without",
    "compare",
    "cannot",
];

/// Words in front of a display whose rows may hold one or the other.
const OF_ALTERNATIVES: [&str; 11] = [
    "or",
    "either",
    "roots",
    "solutions",
    "cases",
    "choices",
    "options",
    "alternatives",
    "conditions",
    "values",
    "respectively",
];

/// Words in a sentence whose display need not hold: it is asked for, a condition, wrong, or holds of what is equal or nearly so.
const OF_CONDITIONS: [&str; 33] = [
    "approximately",
    "assume",
    "assuming",
    "binary",
    "coincide",
    "condition",
    "conditions",
    "equilateral",
    "error",
    "find",
    "hexadecimal",
    "identical",
    "if",
    "incorrect",
    "isosceles",
    "let",
    "mistake",
    "nearly",
    "need",
    "provided",
    "replace",
    "require",
    "rounded",
    "rounding",
    "roughly",
    "set",
    "solve",
    "suppose",
    "tempting",
    "unless",
    "want",
    "when",
    "wrong",
];

/// The formulas that the text in front of a display names, and what it says of the display.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Cited {
    /// Their labels or numbers.
    pub names: Vec<String>,
    /// True if the sentence goes on from the display before it.
    pub goes_on: bool,
    /// True if the rows of the display may hold one or the other.
    pub has_alternatives: bool,
    /// True if the display may be asked for, or a condition.
    pub is_condition: bool,
}

impl Cited {
    /// Returns what is named in front of the display whose first formula stands at `start`; the display before it ends at `before`.
    pub fn of(text: &str, before: usize, start: usize) -> Self {
        let from = before.max(start.saturating_sub(FARTHEST));
        let between = (from..=start)
            .find_map(|from| text.get(from..start))
            .unwrap_or_default();
        let between = uncommented(between);
        let last = between.trim_end().rsplit("\n\n").next().unwrap_or_default();
        let has_any = |text: &str, words: &[&str]| {
            text.split(|c: char| !c.is_alphabetic())
                .any(|own| words.iter().any(|word| own.eq_ignore_ascii_case(word)))
        };
        let has_alternatives = has_any(last, &OF_ALTERNATIVES);
        // what we find is derived
        let sentence = last.rsplit(". ").next().unwrap_or_default().replace("we find", "");
        let front = last.trim_end().trim_end_matches("$$").trim_end_matches(r"\[");
        let front = match front.rsplit_once(r"\begin{") {
            Some((front, name)) if name.ends_with('}') => front,
            _ => front,
        };
        let is_over = front.trim_end().ends_with('.');
        let is_condition = OF_CONDITIONS
            .iter()
            .any(|word| has_any(&sentence, &[*word]) && !(is_over && *word == "let"));
        let is_false = sentence.contains("not true") || has_any(&sentence, &["false", "wrong"]);
        let is_condition = is_condition || is_false || says_equal(last);
        let is_against = has_any(last, &AGAINST);
        let begins_small = behind_environment(&between).starts_with(|c: char| c.is_lowercase());
        Self {
            names: if is_against { Vec::new() } else { references(last) },
            goes_on: !is_against && from == before && begins_small && !between.contains(". "),
            has_alternatives,
            is_condition,
        }
    }
}

/// Returns true if a text says within dollars that two letters are equal, `$m = M$`.
fn says_equal(text: &str) -> bool {
    let is_letter = |side: &str| {
        let letter = side.trim().trim_start_matches('\\');
        let is_name = letter.len() < side.trim().len() || letter.len() == 1;
        is_name && letter.starts_with(|c: char| c.is_ascii_alphabetic()) && letter.chars().all(char::is_alphanumeric)
    };
    let mut formulas = text.split('$').skip(1).step_by(2);
    formulas.any(|formula| {
        formula
            .split_once('=')
            .is_some_and(|(one, other)| is_letter(one) && is_letter(other))
    })
}

/// The text between two displays, without the end of the first.
fn behind_environment(between: &str) -> &str {
    let mut rest = between.trim_start();
    loop {
        let signs = rest.trim_start_matches(|c: char| c.is_whitespace() || "$,;.}]".contains(c));
        let ended = signs.strip_prefix(r"\end{").and_then(|rest| rest.split_once('}'));
        let ended = ended.map(|(_, rest)| rest).or_else(|| signs.strip_prefix(r"\]"));
        match ended {
            Some(next) => rest = next,
            None => return signs,
        }
    }
}

/// The text without the comments of TeX.
fn uncommented(text: &str) -> String {
    let lines = text.lines().filter(|line| !line.trim_start().starts_with('%'));
    lines.collect::<Vec<_>>().join("\n")
}

/// The names that references call, in their order.
fn references(text: &str) -> Vec<String> {
    let mut found: Vec<(usize, String)> = Vec::new();
    for (command, end) in REFERENCES {
        for (at, _) in text.match_indices(command) {
            let names = text.get(at + command.len()..).and_then(|rest| rest.split_once(end));
            let names = names.into_iter().flat_map(|(names, _)| names.split(','));
            found.extend(names.map(|name| (at, name.trim().to_owned())));
        }
    }
    found.sort();
    found.into_iter().map(|(_, name)| name).collect()
}

/// Returns for each display, by the number of its first formula, the formulas that the text in front of it names.
pub(super) fn citations(text: &str, formulas: &[Formula]) -> Vec<Cited> {
    let mut before = 0;
    let of = |(at, formula): (usize, &Formula)| {
        let cited = match !formula.is_aside && formula.first == at {
            true => Cited::of(text, before, formula.part.start),
            false => Cited::default(),
        };
        if !formula.is_aside {
            before = before.max(formula.part.end);
        }
        cited
    };
    formulas.iter().enumerate().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cited(text: &str) -> Cited {
        Cited::of(text, 0, text.len())
    }

    #[test]
    fn the_last_paragraph_names_formulas() {
        let found = cited(
            "From \\eqref{old} it is clear.\n\nSubstituting Eqs.~\\eqref{a} and \\ref{b} into \\cref{c,d} gives\n\n",
        );
        assert_eq!(found.names, ["a", "b", "c", "d"]);
        assert_eq!(cited("By {eq}`law`,\n").names, ["law"]);
        assert!(cited("In contrast to \\eqref{a}, we have\n").names.is_empty());
    }

    #[test]
    fn a_display_may_be_a_condition() {
        assert!(cited("We know $x$. Now solve\n\n").is_condition && cited("if and only if\n").is_condition);
        assert!(!cited("If $x$ is 1, all is well. Hence\n\n").is_condition);
        assert!(cited("The masses are equal, $m = M$. Hence\n").is_condition);
        assert!(!cited("With $m = 2 M$ and $v = g t$ we find\n").is_condition);
    }

    #[test]
    fn a_sentence_goes_on_from_the_display_before() {
        assert!(cited("\n\\end{equation}\n%\nthe force is\n\\begin{equation}").goes_on);
        assert!(cited("$$\n\nso that\n\n").goes_on);
        assert!(!cited("\\end{equation}\nThe force is\n").goes_on);
        assert!(!cited("\\end{equation}\nwhere m is a mass. The force is\n").goes_on);
    }
}
