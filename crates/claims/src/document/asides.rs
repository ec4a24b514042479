//! Formulas within the text that say what a letter is or that something holds: `where $N = N_t + N_c$`, `let $u = x^4$`.

use super::tex::{BRACES, Groups, after_blanks};
use std::ops::Range;

/// Words right behind a display, in front of what is said of it.
const BEHIND: [&str; 2] = ["where", "with"];

/// Words at the beginning of a sentence, in front of what is said of what comes after.
const IN_FRONT: [&str; 14] = [
    "let",
    "define",
    "denote",
    "recall",
    "recall that",
    "set",
    "write",
    "put",
    "we define",
    "we denote",
    "we write",
    "we set",
    "we put",
    "we let",
];

/// Words right in front of what is said of the next display: `using $v = g t$`, `with $v = g t$ we get`.
const LEADING: [&str; 11] = [
    "with",
    "since",
    "because",
    "using",
    "use",
    "substituting",
    "substitute",
    "inserting",
    "insert",
    "by",
    "from",
];

/// Words right behind what is said of the next display: `we have $v = g t$, so`.
const TO_NEXT: [&str; 6] = [", so", ", and so", ", hence", ", and hence", ", thus", ", therefore"];

/// Words and signs right in front of one more thing that a sentence says, `Let $m$ be the mass and $v = g t$ the speed`.
const ONE_MORE: [&str; 4] = ["and", ",", "with", "where"];

/// The most words of a sentence in front of a formula, and bytes between it and the display that it is said of.
const MOST_IN_FRONT: usize = 15;
const FARTHEST_DISPLAY: usize = 400;

/// Words and signs between two such formulas.
const BETWEEN: [&str; 5] = ["and", ",", ", and", ", where", "and where"];

/// Words in the rest of a sentence with which a formula may not hold, or not everywhere.
const BUT: [&str; 53] = [
    "not",
    "no",
    "if",
    "iff",
    "unless",
    "when",
    "whenever",
    "or",
    "for",
    "only",
    "under",
    "provided",
    "never",
    "except",
    "fail",
    "fails",
    "false",
    "excluded",
    "impossible",
    "approximately",
    "order",
    "average",
    "almost",
    "sign",
    "modulo",
    "case",
    "asymptotically",
    "as",
    "initially",
    "limit",
    "respectively",
    "resp",
    "otherwise",
    "contradiction",
    "contradicts",
    "wrong",
    "else",
    "implies",
    "probability",
    "distribution",
    "small",
    "large",
    "constant",
    "gives",
    "means",
    "denotes",
    "corresponds",
    "equation",
    "read",
    "printed",
    "cannot",
    "may",
    "need",
];

/// Commands and environments in which formulas are said of something else.
const ELSEWHERE: [&str; 9] = [
    r"\footnote{",
    r"\caption{",
    r"\title{",
    r"\marginnote{",
    r"\begin{abstract}",
    r"\begin{tabular}",
    r"\begin{algorithm",
    r"\begin{quote}",
    "``",
];

/// Signs of formulas that give no letter a value and state no equality of values.
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

/// Returns where what is said within the text at a place ends to hold: at the end of the environment or item around it, or at the
/// next heading, `\section{...}`, `# ...` of Markdown, or a word with a number as `Case 2.` at the start of a sentence; some pages
/// on at the latest.
pub(super) fn scope_end(text: &str, at: usize) -> usize {
    let behind = text.get(at..).unwrap_or_default();
    let far = behind.len().min(FARTHEST_END);
    let far = (far..behind.len())
        .find(|far| behind.is_char_boundary(*far))
        .unwrap_or(behind.len());
    let behind = behind.get(..far).unwrap_or_default();
    let mut depth = 0_usize;
    for (offset, c) in behind.char_indices() {
        let rest = behind.get(offset..).unwrap_or_default();
        let before = behind.get(..offset).unwrap_or_default();
        let begins_line = before.ends_with('\n');
        if c == '\\' {
            if rest.starts_with(r"\begin{") {
                depth += 1;
            } else if rest.starts_with(r"\end{") {
                match depth.checked_sub(1) {
                    Some(outer) => depth = outer,
                    None => return at + offset,
                }
            } else if depth == 0 && HEADINGS.iter().any(|heading| starts_with_command(rest, heading)) {
                return at + offset;
            }
        } else if depth == 0 && c == '#' && begins_line {
            return at + offset;
        } else if depth == 0 && c.is_ascii_uppercase() {
            let lead = before.trim_end_matches([' ', '*', '_']);
            let begins_sentence = lead.ends_with(['.', '\n', '}']) || lead.is_empty();
            if begins_sentence && is_numbered_heading(rest) {
                return at + offset;
            }
        }
    }
    match at + far == text.len() {
        true => usize::MAX,
        false => at + far,
    }
}

/// Returns the parts of a text at whose end what their displays say ends to hold: examples, exercises, proofs and cases, as environments,
/// directives, items or under headings of their own.
pub(super) fn local_parts(text: &str) -> Vec<Range<usize>> {
    [local_environments(text), local_items(text), local_sections(text)].concat()
}

fn local_environments(text: &str) -> Vec<Range<usize>> {
    let (mut parts, mut open) = (Vec::new(), Vec::new());
    for (at, _) in text.match_indices('\\') {
        let behind = text.get(at..).unwrap_or_default();
        if let Some(name) = behind.strip_prefix(r"\begin{") {
            open.push((at, is_local(name)));
        } else if behind.starts_with(r"\end{")
            && let Some((start, true)) = open.pop()
        {
            parts.push(start..at);
        }
    }
    parts
}

fn local_items(text: &str) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    for (at, item) in text.match_indices(r"\item") {
        let behind = text.get(at + item.len()..).unwrap_or_default();
        let behind = match behind.strip_prefix('[').and_then(|label| label.split_once(']')) {
            Some((label, behind)) if !is_local(label) => behind,
            _ => behind,
        };
        let behind = from_letter(behind);
        if is_supposed(behind) {
            // past `Case 1:`, which begins a part as well
            parts.push(at..scope_end(text, text.len() - behind.len() + 1));
        }
    }
    parts
}

/// Returns the parts under headings, in directives, and from `Case 2.` at the start of a line on.
fn local_sections(text: &str) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    // those that are open, by the level of their heading or the sign that closes them, with their start and whether they are local
    let mut sections: Vec<(usize, usize, bool)> = Vec::new();
    let mut directives: Vec<(&str, usize, bool)> = Vec::new();
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let start = at;
        at += line.len();
        let own = line.trim();
        let levels = own.len() - own.trim_start_matches('#').len();
        let (fence, directive) = own.split_at(own.len() - own.trim_start_matches([':', '`']).len());
        let mut commands = HEADINGS.iter().filter(|heading| **heading != r"\item");
        let command = commands.position(|heading| starts_with_command(own, heading));
        let heading = match command {
            Some(level) => own.split_once('{').map(|(_, title)| (level, title)),
            None => (levels > 0).then_some((levels, own)),
        };
        if let Some((level, title)) = heading {
            while let Some((_, start, is_local)) = sections.pop_if(|(own, ..)| *own >= level) {
                parts.extend(is_local.then_some(start..at - line.len()));
            }
            sections.push((level, start, is_local(title)));
        } else if fence.len() >= 3 && !directive.is_empty() {
            directives.push((fence, start, is_local(directive)));
        } else if fence.len() >= 3 {
            if let Some((_, start, true)) = directives.pop_if(|(sign, ..)| *sign == fence) {
                parts.push(start..at);
            }
        } else if is_local(own) && is_numbered_heading(from_letter(own)) {
            // past the first letter, which begins this part
            parts.push(start..scope_end(text, at - from_letter(line).len() + 1));
        }
    }
    parts
}

/// Returns a text from its first letter on.
fn from_letter(text: &str) -> &str {
    text.trim_start_matches(|c: char| !c.is_alphabetic())
}

/// The first words of what holds to its end alone.
const LOCAL: [&str; 16] = [
    "example",
    "exampl",
    "exercise",
    "problem",
    "question",
    "case",
    "proof",
    "solution",
    "answer",
    "counterexample",
    "task",
    "homework",
    "xca",
    "ex",
    "prob",
    "sol",
];

/// Returns true if the first word of a title or of the name of an environment is one of these, `example*`, `Case 2`.
fn is_local(title: &str) -> bool {
    let word: String = from_letter(title)
        .chars()
        .take_while(char::is_ascii_alphabetic)
        .collect();
    let word = word.to_lowercase();
    LOCAL
        .iter()
        .any(|local| *local == word || word.strip_suffix('s') == Some(local))
}

/// Returns true if an item begins as a case or a supposition does.
fn is_supposed(item: &str) -> bool {
    let word: String = item.chars().take_while(char::is_ascii_alphabetic).collect();
    let supposed = ["if", "when", "suppose", "assume", "assuming", "for"];
    is_local(item) || supposed.contains(&word.to_lowercase().as_str())
}

/// The most bytes over which what is said within the text holds.
const FARTHEST_END: usize = 30_000;

/// Commands that begin another part of a text.
const HEADINGS: [&str; 7] = [
    r"\part",
    r"\chapter",
    r"\section",
    r"\subsection",
    r"\subsubsection",
    r"\paragraph",
    r"\item",
];

fn starts_with_command(text: &str, command: &str) -> bool {
    let behind = text.strip_prefix(command);
    behind.is_some_and(|behind| !behind.starts_with(|c: char| c.is_ascii_alphabetic()))
}

/// Returns true for `Case 2.`, `Example 3.1:`.
fn is_numbered_heading(text: &str) -> bool {
    let word = text.chars().take_while(char::is_ascii_alphabetic).count();
    let Some(number) = text.get(word..).and_then(|rest| rest.strip_prefix(' ')) else {
        return false;
    };
    let digits = number.chars().take_while(|c| c.is_ascii_digit() || *c == '.').count();
    let number = number.get(..digits).unwrap_or_default();
    let behind = text.get(word + 1 + digits..).unwrap_or_default();
    word > 2 && number.starts_with(|c: char| c.is_ascii_digit()) && (number.ends_with('.') || behind.starts_with(':'))
}

/// Returns true if nothing in the rest of its sentence, behind a formula, takes back that it holds: only more formulas, and what
/// the letter is.
pub(super) fn is_plain_behind(behind: &str) -> bool {
    let sentence = match behind.find("\n\n") {
        Some(end) => behind.get(..end).unwrap_or_default(),
        None => behind,
    };
    let ends = [". ", ".\n", ";", ":", r"\begin{", r"\[", "$$"];
    let end = ends
        .iter()
        .filter_map(|end| sentence.find(end))
        .min()
        .unwrap_or(sentence.len());
    let rest = sentence.get(..end).unwrap_or_default();
    // what stands between dollars is looked at by itself
    let words = rest
        .split('$')
        .step_by(2)
        .flat_map(|text| text.split(|c: char| !c.is_alphabetic()));
    let mut words = words.filter(|word| !word.is_empty()).map(str::to_lowercase).peekable();
    let is_short = words.clone().count() <= MOST_WORDS;
    let begins_well = words.peek().is_none_or(|word| BEHIND_IT.contains(&word.as_str()));
    is_short && begins_well && !words.any(|word| BUT.contains(&word.as_str()))
}

/// The first words of the rest of a sentence that takes nothing back.
const BEHIND_IT: [&str; 18] = [
    "and",
    "are",
    "be",
    "denote",
    "hence",
    "in",
    "into",
    "is",
    "it",
    "so",
    "the",
    "then",
    "therefore",
    "this",
    "thus",
    "we",
    "where",
    "with",
];

/// The most words in the rest of a sentence.
const MOST_WORDS: usize = 25;

/// Returns where the display ends that a sentence leads to, at a place of which something is said of it.
pub(super) fn next_display(text: &str, at: usize) -> Option<usize> {
    let signs = [
        (r"\begin{equation", r"\end{equation"),
        (r"\begin{align", r"\end{align"),
        (r"\begin{gather", r"\end{gather"),
        (r"\[", r"\]"),
        ("$$", "$$"),
    ];
    let behind = text.get(at..)?;
    let far = (FARTHEST_DISPLAY..behind.len()).find(|far| behind.is_char_boundary(*far));
    let near = behind.get(..far.unwrap_or(behind.len()))?;
    let found = signs
        .iter()
        .filter_map(|(open, close)| Some((near.find(open)?, *open, *close)));
    let (start, open, close) = found.min()?;
    let inside = start + open.len();
    let end = inside + behind.get(inside..)?.find(close)?;
    Some(at + end + close.len())
}

/// Returns the conditions that a formula within the text states of letters, each by itself: `a > 0` and `b > 0` for `a, b > 0`.
pub(super) fn signs(tex: &str) -> Vec<String> {
    let relations = [
        r"\geq", r"\ge", r"\gt", r"\neq", r"\ne", r"\leq", r"\le", r"\lt", ">", "<",
    ];
    let found = relations.iter().find_map(|sign| Some((tex.split_once(sign)?, *sign)));
    let Some(((letters, _), sign)) = found.filter(|((_, number), _)| number.trim() == "0") else {
        return Vec::new();
    };
    let letters: Vec<&str> = letters.split(',').map(str::trim).collect();
    let is_letter = |letter: &&str| texmath::read_name(letter, &texmath::Names::default()).is_ok();
    match tex.len() <= LONGEST && letters.iter().all(is_letter) {
        true => letters.iter().map(|letter| format!("{letter} {sign} 0")).collect(),
        false => Vec::new(),
    }
}

/// Words right in front of a condition that holds from there on.
const FROM_HERE: [&str; 6] = ["let", "assume", "suppose", "assume that", "suppose that", "we assume"];

/// Words right in front of a condition on one display: the next one, or the last one where they stand right behind it.
const OF_ONE: [&str; 9] = [
    "for",
    "if",
    "when",
    "with",
    "provided",
    "provided that",
    "for all",
    "for any",
    "for every",
];

/// Words between those and the letters: `for constants $a, b > 0$`.
const KINDS: [&str; 8] = [
    "a",
    "some",
    "constant",
    "constants",
    "real",
    "numbers",
    "parameters",
    "fixed",
];

/// Returns the displays of which words say that a condition holds, if they do; `since` is the text since the last display, if any.
pub(super) fn condition_announced(before: &str, since: Option<&str>, behind: &str) -> Option<Announced> {
    let words = |text: &str| -> Vec<String> {
        let text = text.to_lowercase();
        let all = text
            .split(|c: char| !c.is_alphabetic() && c != '$' && c != '\\')
            .filter(|word| !word.is_empty());
        all.map(str::to_owned).collect()
    };
    let ends = [". ", ".\n", "; ", "}", "]", "$"];
    let last = |text: &'_ str| {
        ends.iter()
            .filter_map(|end| text.rfind(end).map(|at| at + end.len()))
            .max()
            .unwrap_or(0)
    };
    let sentence = before.rsplit("\n\n").next().unwrap_or_default();
    let mut front = words(sentence.get(last(sentence)..).unwrap_or_default());
    while front.last().is_some_and(|word| KINDS.contains(&word.as_str())) {
        front.pop();
    }
    let is_taken_back = |text: &str| {
        words(text)
            .iter()
            .any(|word| ["not", "unless", "otherwise", "else", "or"].contains(&word.as_str()))
    };
    let rest = [". ", ".\n", "\n\n", r"\[", "$$", r"\begin"]
        .iter()
        .filter_map(|end| behind.find(end))
        .min();
    if is_taken_back(behind.get(..rest.unwrap_or(behind.len())).unwrap_or_default()) {
        return None;
    }
    let says = |list: &[&str]| list.contains(&front.join(" ").as_str());
    let behind_display = since.is_some_and(|since| {
        let plain = [
            r"\]",
            "$$",
            r"\end{equation}",
            r"\end{equation*}",
            r"\end{align}",
            r"\end{align*}",
        ]
        .iter()
        .fold(since.to_owned(), |text, end| text.replace(end, " "));
        // a capital letter begins a sentence about the next one
        let first = plain.chars().find(|c| c.is_alphabetic());
        first.is_some_and(char::is_lowercase)
            && [&OF_ONE[..], &["where"]]
                .concat()
                .contains(&words(&plain).join(" ").as_str())
    });
    match () {
        () if behind_display => Some(Announced::Behind),
        () if says(&FROM_HERE) => Some(Announced::FromHere),
        () if says(&OF_ONE) || says(&["assuming"]) => Some(Announced::Next),
        () => None,
    }
}

/// Returns the equations that braces of a display state of what they stand at, `\underbrace{a - b}_{= 0}`, with their places.
pub(super) fn at_braces(text: &str, display: Range<usize>) -> Vec<(Range<usize>, String)> {
    let own = text.get(display.clone()).unwrap_or_default();
    let groups = Groups::of(own);
    let equation = |at: usize, sign: &str, script: u8| {
        let marked = groups.group(own, at + sign.len(), BRACES)?;
        let behind = after_blanks(own, marked.end + 1);
        let label = groups.group(own, behind + 1, BRACES)?;
        let is_script = own.as_bytes().get(behind) == Some(&script);
        let inside = own.get(marked.clone())?;
        let value = own.get(label)?.trim().strip_prefix('=')?;
        let is_plain =
            inside.len() + value.len() <= LONGEST && !inside.contains(['=', '&', '<', '>']) && !value.contains('=');
        let part = display.start + at..display.start + marked.end + 1;
        (is_script && is_plain).then(|| (part, format!("{inside} = {value}")))
    };
    let braces = [(r"\underbrace", b'_'), (r"\overbrace", b'^')];
    let found = braces.into_iter().flat_map(|(sign, script)| {
        let all = own.match_indices(sign);
        all.filter_map(move |(at, _)| equation(at, sign, script))
    });
    found.collect()
}

/// The display of which words in front of a formula announce it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Announced {
    /// That it holds of the display before.
    Behind,
    /// That it holds from here on.
    FromHere,
    /// That it holds of the next display.
    Next,
}

/// Returns what words in front of a formula announce, if anything. `since` is the text since the last display, if any, `between`
/// that since the formula before that was announced, with what was announced of that, and `behind` the text behind the formula.
pub(super) fn announced(
    before: &str,
    since: Option<&str>,
    between: Option<(&str, Announced)>,
    behind: &str,
) -> Option<Announced> {
    if let Some((between, announced)) = between
        && BETWEEN.contains(&between.split_whitespace().collect::<Vec<_>>().join(" ").as_str())
    {
        return Some(announced);
    }
    let paragraph = before.rsplit("\n\n").next().unwrap_or_default();
    if ELSEWHERE.iter().any(|place| paragraph.contains(place)) {
        return None;
    }
    // right behind the display, but for how it ends
    let is_behind = |since: &str| {
        let is_blank = |c: char| c.is_whitespace() || ",.;".contains(c);
        let mut rest = since.trim_start_matches(is_blank);
        for end in [r"\end{", r"\]", "$$"] {
            if let Some(behind) = rest.strip_prefix(end) {
                rest = behind
                    .split_once('}')
                    .filter(|_| end == r"\end{")
                    .map_or(behind, |(_, behind)| behind);
            }
        }
        let rest = rest.trim_matches(is_blank).to_lowercase();
        BEHIND.contains(&rest.as_str())
    };
    if since.is_some_and(is_behind) {
        return Some(Announced::Behind);
    }
    let start = paragraph.rfind(['.', ':', '}', ']', '$']).map_or(0, |at| at + 1);
    let lead: Vec<String> = paragraph
        .get(start..)
        .unwrap_or_default()
        .split_whitespace()
        .map(str::to_lowercase)
        .collect();
    let ends_sentence = |c: char| ".:}]".contains(c);
    let is_first = paragraph
        .get(..start)
        .unwrap_or_default()
        .trim_end()
        .ends_with(ends_sentence)
        || start == 0;
    if is_first && IN_FRONT.contains(&lead.join(" ").as_str()) {
        return Some(Announced::FromHere);
    }
    // what stands between dollars is looked at by itself
    let sentence = paragraph
        .split('$')
        .step_by(2)
        .collect::<Vec<_>>()
        .join(" ")
        .to_lowercase();
    let sentence = [". ", ".\n", ": ", "]", "}"]
        .iter()
        .fold(sentence.as_str(), |rest, end| rest.rsplit(end).next().unwrap_or(rest));
    let words: Vec<&str> = sentence
        .split(|c: char| !c.is_alphabetic())
        .filter(|word| !word.is_empty())
        .collect();
    if words.len() > MOST_IN_FRONT || words.iter().any(|word| BUT.contains(word) || SUPPOSING.contains(word)) {
        return None;
    }
    let ends_with = |ends: &[&str]| ends.iter().any(|end| sentence.trim_end().ends_with(end));
    let begins = |many: usize| {
        words
            .get(..many)
            .is_some_and(|lead| IN_FRONT.contains(&lead.join(" ").as_str()))
    };
    if ends_with(&ONE_MORE) && (1..=2).any(begins) {
        return Some(Announced::FromHere);
    }
    let leads = words.last().is_some_and(|word| LEADING.contains(word)) && !sentence.trim_end().ends_with(',');
    let goes_on = TO_NEXT.iter().any(|next| behind.trim_start().starts_with(next));
    (leads || goes_on).then_some(Announced::Next)
}

/// Words of a sentence that says what is so in a case, or what is asked for.
const SUPPOSING: [&str; 17] = [
    "suppose",
    "assume",
    "assuming",
    "condition",
    "conditions",
    "find",
    "show",
    "prove",
    "want",
    "would",
    "were",
    "until",
    "might",
    "should",
    "tempting",
    "claim",
    "seems",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_holds_to_the_end_of_what_it_is_said_in() {
        for text in [
            r"Let $a = b$. \begin{equation} x \end{equation} Here | \section{Other} c",
            r"\begin{lemma} Let $a = b$. |\end{lemma} c",
            r"Let $a = b$. |\item c",
            "Let $a = b$. |Case 2: c",
            "Let $a = b$ as in Section 3. It is.\n|# Other",
            "Let $a = b$. See Example 2. |",
        ] {
            let plain = text.replace('|', "");
            let end = scope_end(&plain, plain.find('$').unwrap_or_default());
            let found = plain.get(end.min(plain.len())..).unwrap_or_default();
            assert_eq!(
                found.trim_start(),
                text.split('|').nth(1).unwrap_or_default().trim_start(),
                "{text}"
            );
        }
    }

    #[test]
    fn what_words_announce_is_told_from_cases() {
        assert_eq!(
            announced("", Some(",\n\\end{equation}\nwhere "), None, ""),
            Some(Announced::Behind)
        );
        assert_eq!(announced("", Some(" \\] where "), None, ""), Some(Announced::Behind));
        for text in [
            "Let ",
            "This holds. Let ",
            "\\end{equation} We define ",
            "Recall that ",
            "\n\nSet ",
        ] {
            assert_eq!(announced(text, None, None, ""), Some(Announced::FromHere), "{text}");
        }
        for text in [
            "Let $m$ be the mass and ",
            "Let $m > 0$ and ",
            "Define $a$ by $a > b$, where ",
        ] {
            assert_eq!(announced(text, None, None, ""), Some(Announced::FromHere), "{text}");
        }
        for text in [
            "because ",
            "All is well. Using ",
            "By the law of $x$, substituting ",
            "With ",
        ] {
            assert_eq!(announced(text, None, None, ""), Some(Announced::Next), "{text}");
        }
        assert_eq!(announced("We have ", None, None, ", so"), Some(Announced::Next));
        for text in [
            "if",
            "when",
            "for",
            "elsewhere",
            "at",
            "assume",
            "",
            "If we set",
            "We do not set",
            "the maximum where",
            "It is tempting to set",
            "We have",
            "Show that with",
            "Let $m$ be the mass for",
            "Suppose that $m$ is the mass and",
            "One might think that since",
            "Should we set",
            "The solution set",
            r"\footnote{Let ",
            "Do not let",
        ] {
            assert_eq!(announced(text, None, None, ""), None, "{text}");
            assert_eq!(announced(text, Some(text), None, ""), None, "{text}");
        }
        let between = |text| Some((text, Announced::Behind));
        assert_eq!(
            announced("where $a = b$ and", None, between("  and "), ""),
            Some(Announced::Behind)
        );
        assert_eq!(
            announced("where $a = b$ and this is", None, between(" and this is "), ""),
            None
        );
        for text in [
            ". Then",
            ", and $c = d$.",
            " is the share of $x$. If",
            "",
            " and $p = q$ are the two. ",
        ] {
            assert!(is_plain_behind(text), "{text}");
        }
        for text in [
            " does not hold.",
            " if $x > 0$.",
            " is false.",
            " or $a = c$.",
            ", respectively.",
            " unless $x = 0$",
            " for small $c$.",
            " gives a line.",
            " holds on average.",
            " approximately.",
            " defines the boundary.",
        ] {
            assert!(!is_plain_behind(text), "{text}");
        }
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
