//! The kernel against whoever searches for certificates: what it must not accept, whatever it is handed.
//!
//! `attacks` holds one test for each hole that was found by reading: a certificate or a witness that was accepted
//! once, and the wrong verdict that it would have made. `rules` goes through the rules one by one; `refusals` breaks one
//! condition at a time. `mutants.py` breaks the kernel's own code, a line at a time, and says what these tests do not
//! notice.

mod attacks;
mod axioms;
mod breaks;
mod digits;
mod forge;
mod refusals;
mod rules;

/// The code of each file of src and of the crates, without comments and tests, by its path.
fn code() -> Vec<(String, String)> {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let (mut open, mut found) = (vec![root.join("src"), root.join("crates")], Vec::new());
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(std::fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = std::fs::read_to_string(&path).unwrap();
            let text = text.split("\n#[cfg(test)]\nmod ").next().unwrap_or_default();
            let lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
            let name = path.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/");
            found.push((name, lines.collect::<Vec<_>>().join("\n")));
        }
    }
    found.sort();
    found
}

/// The values that the kernel gives are made in one place each; their fields are private, so that no other file can.
#[test]
fn the_kernel_makes_its_values_in_one_place_each() {
    let code = code();
    let (_, text) = code
        .iter()
        .find(|(name, _)| name == "crates/kernel/src/verdict.rs")
        .unwrap();
    let is_made = |line: &&str| {
        ["Proved {", "Refuted {"].iter().any(|word| line.contains(word))
            && !["struct", "impl", "enum"].iter().any(|before| line.contains(before))
    };
    let made: Vec<&str> = text.lines().map(str::trim).filter(is_made).collect();
    let expected = [
        "Ok(true) => Evaluated::Fails(Refuted { nowhere: false }),",
        "Ok(Proved {",
        "Ok(Refuted { nowhere: true })",
    ];
    let sorted = |mut lines: Vec<&str>| {
        lines.sort_unstable();
        lines.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(sorted(made), sorted(expected.to_vec()));
}

/// The functions that name one of the two verdicts as a value, and why they may.
const MAKERS: [(&str, &str, &str); 8] = [
    (
        "crates/claims/src/document/comment.rs",
        "verdict",
        "a verdict that is expected",
    ),
    (
        "crates/prover/src/decision.rs",
        "accept_proofs",
        "takes what the kernel accepted of each question",
    ),
    (
        "crates/prover/src/decision.rs",
        "accept_refutation",
        "takes what the kernel accepted",
    ),
    (
        "crates/prover/src/decision.rs",
        "conclude",
        "takes decisions on goals, which are all proved",
    ),
    (
        "crates/prover/src/decision.rs",
        "on_doubts",
        "keeps a verdict of the kernel back that rests on second values",
    ),
    (
        "crates/prover/src/decision.rs",
        "settle_second_values",
        "gives it back where these are proved",
    ),
    (
        "crates/prover/src/script.rs",
        "verdict",
        "the kind of what was found, which is compared with a verdict",
    ),
    (
        "crates/evidence/src/judgement.rs",
        "trial",
        "the verdict that evidence is looked for against",
    ),
];

/// Returns the functions that use a verdict as a value, beyond comparisons and patterns, and those that set the verdict
/// of a decision to what claims something: other than a plain `undecided`, `unread`, `given` or `suspect`.
fn makers(file: &str, text: &str) -> Vec<(String, String)> {
    let (mut function, mut found) = (String::new(), Vec::new());
    for line in text.lines().map(str::trim) {
        if let Some((_, after)) = line.split_once("fn ")
            && line.contains('(')
        {
            function = after.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        }
        let is_own = |path: &str| path != "Self::" || file == "crates/claims/src/verdict.rs";
        for path in ["Verdict::", "Self::"].into_iter().filter(|path| is_own(path)) {
            for (at, _) in line.match_indices(path) {
                let (before, after) = (line[..at].trim_end(), &line[at + path.len()..]);
                let is_verdict = ["Proved", "Refuted", "default", "{", "*"]
                    .iter()
                    .any(|name| after.starts_with(name));
                let is_compared = before.ends_with("==") || before.ends_with("!=");
                let is_matched = (after.contains("=>") && !before.contains("=>"))
                    || before.contains("matches!(")
                    || before.ends_with("let");
                if is_verdict && !is_compared && !is_matched {
                    found.push((file.to_owned(), function.clone()));
                }
            }
        }
        let set = line.split_once(".verdict = ").or_else(|| {
            let in_literal = line.split_once("verdict: ").filter(|(before, _)| before.is_empty());
            in_literal.filter(|_| line.ends_with(',') && file.starts_with("crates/prover/"))
        });
        let is_open = |value: &str| {
            ["Undecided", "Unread", "Given", "Suspect"]
                .iter()
                .any(|name| value.contains(name))
        };
        // the type of a field
        if set.is_some_and(|(_, value)| !is_open(value) && value != "Verdict,") {
            found.push((file.to_owned(), function.clone()));
        }
    }
    found.sort();
    found.dedup();
    found
}

#[test]
fn only_the_verdicts_of_the_kernel_are_verdicts() {
    let made: Vec<(String, String)> = code().iter().flat_map(|(file, text)| makers(file, text)).collect();
    let allowed =
        |(file, function): &&(String, String)| MAKERS.iter().any(|(known, name, _)| known == file && name == function);
    let others: Vec<_> = made.iter().filter(|maker| !allowed(maker)).collect();
    assert!(others.is_empty(), "a verdict that the kernel did not give: {others:?}");
    for (file, function, _) in MAKERS {
        let is_made = made.iter().any(|(other, name)| other == file && name == function);
        assert!(is_made, "{file}: `{function}` makes no verdict any more");
    }
}

#[test]
fn a_verdict_of_any_other_place_is_found() {
    let of = |line: &str| makers("crates/prover/src/lib.rs", &format!("fn thin() {{\n    {line}\n}}")).len();
    for line in [
        "decision.verdict = Verdict::Proved;",
        "verdict: Verdict::Refuted,",
        "return Verdict::Proved;",
        "true => Verdict::Proved,",
        "let verdict = Verdict::Refuted;",
        "use crate::claim::Verdict::{Proved, Refuted};",
        "decision.verdict = decision.expected;",
        "verdict: other,",
        "verdicts.push(Verdict::Proved);",
    ] {
        assert_eq!(of(line), 1, "{line}");
    }
    for line in [
        "if decision.verdict == Verdict::Proved {",
        "Verdict::Proved => shown.push(found),",
        "matches!(found.verdict, Verdict::Refuted | Verdict::Unread)",
        "decision.verdict = Verdict::Undecided;",
    ] {
        assert_eq!(of(line), 0, "{line}");
    }
}
