//! What an author says of a formula in a comment that does not print.

use super::super::entry::Role;
use super::super::symbols::{MapEntry, Pairs, RawSymbols};
use super::super::verdict::Verdict;
use texmath::nearest;

/// What a comment says, a key at a time.
#[derive(Clone, Debug)]
pub(super) enum Key {
    Role(Role),
    /// The formula is not looked at.
    Skip,
    Label(String),
    FollowsFrom(Vec<String>),
    With(String),
    Where(String),
    Assume(String),
    Expect(Verdict),
    /// What formulas are that say nothing of themselves; `None` to skip them.
    Default(Option<Role>),
    /// The symbols of the document; `None` for those of the impact pair.
    Symbols(Option<Box<RawSymbols>>),
    /// A printed number: its quantity, its scene, and what the scene is set to.
    Value {
        quantity: String,
        scene: String,
        set: Vec<String>,
    },
}

/// The words that keys begin with.
const KEYS: [&str; 13] = [
    "claim",
    "premise",
    "definition",
    "skip",
    "follows from",
    "with",
    "where",
    "assume",
    "expect",
    "label",
    "default",
    "symbols",
    "value",
];

/// The keys of a comment.
///
/// # Errors
/// What to say of a key that is none.
pub(super) fn keys(text: &str) -> Result<Vec<Key>, String> {
    let mut keys = Vec::new();
    if is_misspelt(text) {
        let beginning = text.split_inclusive([':', ' ']).next().unwrap_or(text).trim();
        return Err(format!(
            "`{beginning}` does not begin a comment that is read; did you mean `audit:`?"
        ));
    }
    if text.ends_with(',') {
        return Err("this ends with a comma: each line of a comment begins with audit:".to_owned());
    }
    let mut parts = parted(text, ';').into_iter().filter(|part| !part.is_empty()).peekable();
    while let Some(part) = parts.next() {
        let (word, rest) = part.split_once(char::is_whitespace).unwrap_or((part, ""));
        let rest = rest.trim();
        let own = rest.to_owned();
        let role = role(word);
        keys.push(match word {
            "skip" if rest.is_empty() => Key::Skip,
            _ if role.is_some() && rest.is_empty() => Key::Role(role.unwrap_or(Role::Claim)),
            "label" if !rest.is_empty() => Key::Label(own),
            "follows" | "from" => Key::FollowsFrom(labels(rest.strip_prefix("from ").unwrap_or(rest))),
            "with" if !rest.is_empty() => Key::With(own),
            "where" if !rest.is_empty() => Key::Where(own),
            "assume" if !rest.is_empty() => Key::Assume(own),
            "expect" => Key::Expect(verdict(rest)?),
            "default" if rest == "skip" => Key::Default(None),
            "default" => match self::role(rest) {
                Some(role) => Key::Default(Some(role)),
                None => return Err(format!("`default {rest}`: claim, premise, definition or skip is")),
            },
            "symbols" if rest == "impact pair" || rest == "of the impact pair" => Key::Symbols(None),
            "symbols" => {
                let mut all = vec![rest];
                while let Some(more) = parts.next_if(|part| !begins_key(part)) {
                    all.push(more);
                }
                Key::Symbols(Some(Box::new(symbols(&all)?)))
            }
            "value" => {
                let mut said = parted(rest, ',').into_iter();
                let quantity = said.next().unwrap_or_default().to_owned();
                let (scenes, set): (Vec<&str>, Vec<&str>) = said.partition(|part| part.starts_with("scene "));
                let scene = scenes.first().and_then(|scene| scene.strip_prefix("scene "));
                Key::Value {
                    quantity,
                    scene: scene.unwrap_or_default().trim().to_owned(),
                    set: set.into_iter().map(str::to_owned).collect(),
                }
            }
            _ => {
                let word = part.split_whitespace().next().unwrap_or_default();
                let first = word.trim_end_matches(',');
                let firsts = KEYS.map(|key| key.split(' ').next().unwrap_or(key));
                return Err(match nearest(word, firsts) {
                    _ if first != word && begins_key(first) => {
                        format!("`{part}`: keys are parted by `;`, not by a comma")
                    }
                    Some(key) if key != word => format!("`{part}` says nothing here; did you mean `{key}`?"),
                    _ => format!("`{part}` says nothing here (known: {})", KEYS.join(", ")),
                });
            }
        });
    }
    Ok(keys)
}

/// Returns true if a comment speaks of the document as a whole, and of no formula.
pub(super) fn is_of_document(text: &str) -> bool {
    let is_of_whole = |key: &Key| matches!(key, Key::Symbols(_) | Key::Default(_));
    keys(text).is_ok_and(|keys| !keys.is_empty() && keys.iter().all(is_of_whole))
}

/// Returns true if a comment is keys behind a misspelt `audit:`, as `audti: claim`, `Audit : claim` or `audit claim` are.
pub(super) fn is_misspelt(text: &str) -> bool {
    let length = text.find(|c: char| !c.is_alphabetic()).unwrap_or(text.len());
    let (word, rest) = text.split_at(length);
    if text.starts_with("audit:") || nearest(word, ["audit"]).is_none() {
        return false;
    }
    match rest.trim_start().strip_prefix(':') {
        Some(rest) => parted(rest, ';').first().is_some_and(|part| begins_key(part)),
        // prose may begin with these words, but does not consist of them
        None => matches!(
            keys(rest.trim()).as_deref(),
            Ok([Key::Role(_) | Key::Skip | Key::Default(_), ..])
        ),
    }
}

/// Whether a part of a comment behind declarations of symbols is a key of its own.
fn begins_key(part: &str) -> bool {
    let word = part.split(char::is_whitespace).next().unwrap_or_default();
    let keys = [
        "skip", "label", "follows", "from", "with", "where", "assume", "expect", "default", "symbols", "value",
    ];
    keys.contains(&word) || role(word).is_some()
}

fn role(word: &str) -> Option<Role> {
    match word {
        "claim" => Some(Role::Claim),
        "premise" => Some(Role::Premise),
        "definition" => Some(Role::Definition),
        _ => None,
    }
}

fn verdict(word: &str) -> Result<Verdict, String> {
    match word {
        "proved" => Ok(Verdict::Proved),
        "refuted" => Ok(Verdict::Refuted),
        "conditional" => Ok(Verdict::Conditional),
        "unread" => Ok(Verdict::Unread),
        _ => Err(format!("`expect {word}`: proved, refuted, conditional or unread is")),
    }
}

/// The labels in `(9), (11) and \eqref{eq:law}`; none in `nothing`.
fn labels(text: &str) -> Vec<String> {
    if text.trim() == "nothing" {
        return Vec::new();
    }
    let text = text.replace(" and ", ",");
    let parts = text.split(',').map(str::trim).filter(|part| !part.is_empty());
    let alone = |part: &str| -> String {
        let part = part
            .strip_prefix(r"\eqref")
            .or(part.strip_prefix(r"\ref"))
            .unwrap_or(part);
        let inner = part
            .strip_prefix(['(', '{'])
            .and_then(|part| part.strip_suffix([')', '}']));
        inner.unwrap_or(part).trim().to_owned()
    };
    parts.map(alone).collect()
}

/// The parts between these signs, outside braces, without blanks around them.
fn parted(text: &str, by: char) -> Vec<&str> {
    let (mut parts, mut depth, mut start) = (Vec::new(), 0_i32, 0);
    for (at, c) in text.char_indices() {
        match c {
            '{' | '[' | '(' => depth += 1,
            '}' | ']' | ')' => depth -= 1,
            _ if c == by && depth <= 0 => {
                parts.push(text.get(start..at).unwrap_or_default().trim());
                start = at + c.len_utf8();
            }
            _ => {}
        }
    }
    parts.push(text.get(start..).unwrap_or_default().trim());
    parts
}

/// The kinds of symbols.
const KINDS: [&str; 18] = [
    "only",
    "parameters",
    "generic",
    "positive",
    "at_most_one",
    "nonnegative",
    "nonzero",
    "integers",
    "complex",
    "indices",
    "times",
    "states",
    "continuous",
    "functions",
    "periods",
    "abbreviations",
    "relations",
    "maps",
];

/// The symbols that parts such as `positive T_1, T_2` or `functions F' = f` declare.
fn symbols(parts: &[&str]) -> Result<RawSymbols, String> {
    let mut symbols = RawSymbols::default();
    for part in parts {
        let (kind, rest) = part.split_once(char::is_whitespace).unwrap_or((part, ""));
        let names: Vec<String> = parted(rest, ',')
            .into_iter()
            .filter(|name| !name.is_empty())
            .map(str::to_owned)
            .collect();
        let is_kind = |name: &&String| name.split_once(' ').is_some_and(|(word, _)| KINDS.contains(&word));
        if let Some(name) = names.iter().find(is_kind) {
            return Err(format!(
                "`{name}` stands behind a comma: kinds of symbols are parted by `;`"
            ));
        }
        let list = match kind {
            "only" if rest.is_empty() => {
                symbols.only = true;
                continue;
            }
            "parameters" => &mut symbols.parameters,
            "generic" => &mut symbols.generic,
            "positive" => &mut symbols.positive,
            "at_most_one" => &mut symbols.at_most_one,
            "nonnegative" => &mut symbols.nonnegative,
            "nonzero" => &mut symbols.nonzero,
            "integers" => &mut symbols.integers,
            "complex" => &mut symbols.complex,
            "indices" => &mut symbols.indices,
            "times" => &mut symbols.times,
            "states" => &mut symbols.states,
            "continuous" => &mut symbols.continuous,
            "functions" => {
                add(&mut symbols.functions, names.iter().flat_map(|name| function(name)));
                continue;
            }
            "periods" => {
                add(&mut symbols.periods, names);
                continue;
            }
            "abbreviations" => {
                add(&mut symbols.abbreviations, names);
                continue;
            }
            "relations" => {
                add(&mut symbols.relations, names);
                continue;
            }
            "maps" => {
                let (name, map) =
                    map(rest).ok_or_else(|| format!("`{part}`: `M of x, y by u, v` or `M = A B` is a map"))?;
                symbols.maps.insert(name, map);
                continue;
            }
            _ if !rest.is_empty() && nearest(kind, KINDS).is_some() => {
                let meant = nearest(kind, KINDS).unwrap_or_default();
                return Err(format!("`{kind}` is no kind of symbols; did you mean `{meant}`?"));
            }
            // names alone are parameters
            _ => {
                symbols
                    .parameters
                    .extend(parted(part, ',').into_iter().map(str::to_owned));
                continue;
            }
        };
        list.extend(names);
    }
    Ok(symbols)
}

/// What all the comments on symbols declare together, with what goes without saying.
pub(super) fn completed(mut symbols: RawSymbols) -> Result<RawSymbols, String> {
    // functions are of time, where nothing else is said to run
    let functions = symbols.functions.pairs().map_err(|fault| fault.message)?;
    if !functions.is_empty() && symbols.times.is_empty() && !symbols.parameters.iter().any(|name| name == "t") {
        symbols.times.push("t".to_owned());
    }
    // what is a derivative is a function too
    let derivatives = functions.iter().map(|(_, derivative)| derivative.clone());
    let is_name = |text: &String| !text.is_empty() && !text.contains([' ', '+', '-', '*', '/', '^', '(']);
    let undeclared = derivatives.filter(|name| is_name(name) && functions.iter().all(|(known, _)| known != name));
    add(&mut symbols.functions, undeclared.collect::<Vec<_>>());
    Ok(symbols)
}

fn add(to: &mut Pairs, more: impl IntoIterator<Item = String>) {
    if let Pairs::List(list) = to {
        list.extend(more);
    }
}

/// `F' = f`, or `F = f` as in a sheet, says that f is the derivative of F, and declares both; `f` alone that it is a function.
fn function(text: &str) -> Vec<String> {
    match text.split_once('=') {
        Some((left, right)) => {
            let (left, right) = (left.trim().trim_end_matches('\''), right.trim());
            vec![format!("{left} = {right}")]
        }
        None => vec![text.to_owned()],
    }
}

fn map(text: &str) -> Option<(String, MapEntry)> {
    if let Some((name, product)) = text.split_once('=') {
        return Some((name.trim().to_owned(), MapEntry::Product(product.trim().to_owned())));
    }
    let (name, rest) = text.split_once(" of ")?;
    let (of, by) = rest.split_once(" by ")?;
    let list = |text: &str| parted(text, ',').into_iter().map(str::to_owned).collect();
    let (of, by) = (list(of), list(by));
    Some((name.trim().to_owned(), MapEntry::Of { of, by }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_keys_of_a_comment_are_read_and_others_named() {
        let found = keys(
            r"claim; follows from (9), (11) and \eqref{eq:law}; with r = r_B; where \Delta = {a; b}; expect refuted",
        )
        .unwrap();
        let [
            Key::Role(Role::Claim),
            Key::FollowsFrom(from),
            Key::With(with),
            Key::Where(own),
            Key::Expect(Verdict::Refuted),
        ] = found.as_slice()
        else {
            panic!("{found:?}");
        };
        assert_eq!(
            (from.join(" "), with.as_str(), own.as_str()),
            ("9 11 eq:law".into(), "r = r_B", r"\Delta = {a; b}")
        );
        for (text, word) in [
            ("clam", "`clam`"),
            ("expect right", "expect right"),
            ("default x", "default x"),
            ("symbols positiv m", "did you mean `positive`?"),
            ("claim, follows from (1)", "parted by `;`"),
            ("folows from (1)", "did you mean `follows`?"),
            ("asume x > 0", "did you mean `assume`?"),
            ("symbols maps M", "maps"),
        ] {
            assert!(keys(text).unwrap_err().contains(word), "{text}");
        }
    }

    #[test]
    fn a_misspelt_audit_is_told_from_prose() {
        for text in [
            "audti: claim",
            "adit: premise; label a",
            "Audit : claim",
            "AUDIT: symbols a, b",
            "audits: follows from (1)",
            "audit claim; follows from (1)",
        ] {
            assert!(keys(text).unwrap_err().contains("did you mean `audit:`"), "{text}");
        }
        for text in [
            "audited by two people",
            "audit: claim",
            "Audit: see the report",
            "edit: claim",
            "audit with care",
            "audit claim 3 again",
            "claim",
            "",
        ] {
            assert!(!is_misspelt(text), "{text}");
        }
    }

    #[test]
    fn a_value_says_its_quantity_scene_and_settings() {
        let found = keys("value orbits.velocities[0], scene fig02, motion.d=0.4, row.word=BT").unwrap();
        assert!(matches!(found.as_slice(), [Key::Value { quantity, scene, set }]
            if quantity == "orbits.velocities[0]" && scene == "fig02" && set.join(";") == "motion.d=0.4;row.word=BT"));
    }

    #[test]
    fn symbols_are_those_of_a_sheet() {
        let found = keys(r"symbols a, b; positive T_1; functions F' = f; maps P of x_{k+1} by x_k").unwrap();
        let [Key::Symbols(Some(symbols))] = found.as_slice() else {
            panic!("{found:?}");
        };
        let symbols = completed((**symbols).clone()).unwrap();
        assert_eq!(
            (&symbols.parameters[..], &symbols.positive[..]),
            (&["a", "b"].map(str::to_owned)[..], &["T_1".to_owned()][..])
        );
        assert_eq!(symbols.times, ["t"]);
        assert_eq!(
            symbols.functions.pairs().unwrap(),
            [("F".into(), "f".into()), ("f".into(), String::new())]
        );
        assert!(matches!(symbols.maps.get("P"), Some(MapEntry::Of { of, .. }) if of == &["x_{k+1}"]));
    }
}
