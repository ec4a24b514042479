//! Who may use whom: two stacks that meet once.

use super::File;
use super::source::{Token, tokens};

const NUMBER: &[&str] = &["number"];
const BOTH: &[&str] = &["number", "tex", "claim", "model", "impact", "orbit"];
const PROOF: &[&str] = &["kernel", "prove"];

/// The folders in order, and what each may use besides itself. The formulas know no ball, the dynamics know no TeX;
/// what follows `reference` may use both and what stands before it.
fn allowed(folder: &str) -> Option<Vec<&'static str>> {
    let both = |more: &[&'static str]| [BOTH, more].concat();
    let allowed = match folder {
        "number" | "stop" | "markup" => vec![],
        "tex" | "model" => NUMBER.to_vec(),
        "claim" => vec!["number", "tex"],
        // What accepts a proof shares nothing with what looks for it.
        "kernel" => vec!["number", "tex", "claim"],
        "algebra" => vec!["number", "kernel"],
        "prove" => vec!["number", "tex", "claim", "kernel", "algebra"],
        "impact" => vec!["number", "model"],
        "orbit" => vec!["number", "model", "impact"],
        "reference" => both(&[]),
        // Proof and evidence share nothing: an error of the one must not repeat itself in the other.
        "evidence" => both(&["reference"]),
        // A repair is sieved by evidence and accepted by a proof.
        "repair" => [PROOF, &both(&["reference", "evidence"])].concat(),
        "accuracy" => [PROOF, &both(&["reference", "evidence"])].concat(),
        "scene" => both(&["reference", "evidence", "accuracy"]),
        "report" => [PROOF, &both(&["reference", "evidence", "repair", "accuracy", "scene"])].concat(),
        "cli" => [
            PROOF,
            &both(&["reference", "evidence", "repair", "accuracy", "scene", "report"]),
        ]
        .concat(),
        _ => return None,
    };
    Some([&allowed[..], &["stop", "markup"]].concat())
}

/// What is wrong with the arrows between the folders of these sources, tests at the foot of a file included.
pub fn check(sources: &[File]) -> Vec<String> {
    sources.iter().flat_map(check_file).collect()
}

fn check_file(file: &File) -> Vec<String> {
    let parts: Vec<&str> = file
        .path
        .trim_start_matches("src/")
        .trim_end_matches(".rs")
        .split('/')
        .collect();
    let (folder, module) = match parts.as_slice() {
        // The two crate roots put the folders together and may name any of them.
        ["lib" | "main"] => return Vec::new(),
        // What every computation may look at, and which knows none; and what writes markup, which knows none either.
        [single @ ("stop" | "markup")] => (*single, parts.as_slice()),
        [folder, .., "mod"] => (*folder, &parts[..parts.len() - 1]),
        [folder, ..] => (*folder, parts.as_slice()),
        [] => return Vec::new(),
    };
    let Some(allowed) = allowed(folder) else {
        return vec![format!(
            "{}: `{folder}` has no place in the house; give it one in tests/house/arrows.rs",
            file.path
        )];
    };
    let mut complaints = Vec::new();
    for (line, used) in uses(&tokens(&file.text), module) {
        if used == folder || allowed.contains(&used.as_str()) {
            continue;
        }
        let known = self::allowed(&used).is_some();
        let why = if known {
            "stands after it or in the other stack"
        } else {
            "is no folder of the house"
        };
        complaints.push(format!("{}:{line}: `{folder}` uses `{used}`, which {why}", file.path));
    }
    complaints
}

/// The folders that the file of `module` names, with the lines; `*` is all of them at once.
fn uses(tokens: &[Token], module: &[&str]) -> Vec<(usize, String)> {
    let mut walk = Walk {
        tokens,
        at: 0,
        found: Vec::new(),
    };
    let mut inner: Vec<(usize, String)> = Vec::new();
    let mut depth = 0_usize;
    while let Some(token) = tokens.get(walk.at) {
        let after_dollar = walk.at > 0 && tokens[walk.at - 1].text == "$";
        let is_path = walk.is(1, "::") && !after_dollar;
        match token.text.as_str() {
            "crate" if is_path => walk.path(&[]),
            "vibro_audit" if is_path => walk.path(&[]),
            "super" => {
                let here: Vec<&str> = module
                    .iter()
                    .copied()
                    .chain(inner.iter().map(|(_, name)| &**name))
                    .collect();
                walk.path(&here);
            }
            "crate" if walk.is(1, "as") => {
                walk.found.push((token.line, "*".to_owned()));
                walk.at += 1;
            }
            "mod" if walk.is(2, "{") => {
                depth += 1;
                inner.push((depth, tokens[walk.at + 1].text.clone()));
                walk.at += 3;
            }
            text => {
                depth += usize::from(text == "{");
                if text == "}" {
                    inner.retain(|&(opened, _)| opened < depth);
                    depth = depth.saturating_sub(1);
                }
                walk.at += 1;
            }
        }
    }
    walk.found
}

struct Walk<'a> {
    tokens: &'a [Token],
    at: usize,
    found: Vec<(usize, String)>,
}

impl Walk<'_> {
    fn is(&self, ahead: usize, text: &str) -> bool {
        self.tokens.get(self.at + ahead).is_some_and(|token| token.text == text)
    }

    /// Reads one path or tree of paths from within the module `here`, as far as it takes to know the folder.
    fn path(&mut self, here: &[&str]) {
        let mut here = here.to_vec();
        while let Some(token) = self.tokens.get(self.at) {
            match token.text.as_str() {
                "crate" | "vibro_audit" => here.clear(),
                "super" => drop(here.pop()),
                "self" if !here.is_empty() => {}
                "{" => return self.group(&here),
                // Still inside this file's own folder: whatever follows is too.
                _ if !here.is_empty() => return,
                "*" | "self" | ")" => return self.found.push((token.line, "*".to_owned())),
                name => {
                    self.found.push((token.line, name.to_owned()));
                    self.at += 1;
                    return;
                }
            }
            self.at += 1;
            if !self.is(0, "::") {
                return;
            }
            self.at += 1;
        }
    }

    /// Reads `{a::b, c::{d, e}}`: each element on its own.
    fn group(&mut self, here: &[&str]) {
        let mut depth = 0_usize;
        while let Some(token) = self.tokens.get(self.at) {
            let text = token.text.as_str();
            self.at += 1;
            match text {
                "{" => depth += 1,
                "}" => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                return;
            }
            let begins = depth == 1 && matches!(text, "{" | ",");
            if begins && !self.is(0, "}") {
                self.path(here);
            }
        }
    }
}

#[cfg(test)]
fn complaints(path: &str, text: &str) -> Vec<String> {
    check(&[File::new(path, text)])
}

#[test]
fn a_use_against_the_arrows_is_found_in_every_spelling() {
    let broken = [
        ("src/number/rational.rs", "use crate::algebra::Poly;"),
        ("src/algebra/poly.rs", "fn f(x: &crate::tex::Tree) {}"),
        ("src/claim/proof.rs", "pub(in crate::report) fn f() {}"),
        ("src/claim/proof.rs", "use crate::{number::Field, model::Motion};"),
        (
            "src/claim/proof.rs",
            "use crate::{tex::{self, Tree}, number::{Field}, orbit};",
        ),
        ("src/claim/proof.rs", "use super::super::impact;"),
        ("src/claim/mod.rs", "use super::impact::next;"),
        ("src/claim/mod.rs", "use super::{tex::Tree, orbit::Word};"),
        ("src/claim/proof.rs", "use super::{Sheet, super::scene::Scene};"),
        ("src/claim/proof.rs", "use self::super::super::scene;"),
        ("src/claim/proof.rs", "mod inner { use super::super::super::model::X; }"),
        (
            "src/claim/proof.rs",
            "#[cfg(test)] mod tests { use crate::model::Motion; }",
        ),
        ("src/claim/deep/er.rs", "use super::super::super::model;"),
        ("src/claim.rs", "use crate::model::Motion;"),
        ("src/orbit/word.rs", "let x = crate::tex::read();"),
        ("src/evidence/dual.rs", "use crate::algebra::Poly;"),
        ("src/evidence/dual.rs", "use crate::kernel::Term;"),
        ("src/evidence/dual.rs", "use crate::prove::Decision;"),
        ("src/kernel/term.rs", "use crate::algebra::Poly;"),
        ("src/kernel/term.rs", "use crate::prove::Decision;"),
        ("src/claim/sheet.rs", "use crate::kernel::Term;"),
        ("src/algebra/poly.rs", "use crate::claim::Sheet;"),
        ("src/scene/key.rs", "use crate::kernel::Term;"),
        ("src/report/csv.rs", "use crate::cli::Exit;"),
        ("src/cli/audit.rs", "use vibro_audit::nowhere::X;"),
        ("src/tex/read.rs", "use crate::*;"),
        ("src/tex/read.rs", "use crate as root;"),
        ("src/tex/read.rs", "use crate::{self as root};"),
        ("src/tex/mod.rs", "use super::*;"),
        ("src/tex/read.rs", "use crate::Reexported;"),
    ];
    for (path, text) in broken {
        assert_eq!(
            complaints(path, text).len(),
            1,
            "{path}: {text}: {:?}",
            complaints(path, text)
        );
    }
}

#[test]
fn a_use_along_the_arrows_is_left_alone() {
    let right = [
        (
            "src/algebra/poly.rs",
            "use crate::number::{Field, Rational}; use super::*; use crate::algebra::x;",
        ),
        (
            "src/claim/proof.rs",
            "use crate::{number::Field, tex::{Tree, Name}}; use super::Sheet;",
        ),
        (
            "src/claim/proof.rs",
            "// crate::model\nlet s = \"crate::model\"; pub(crate) fn f() {} pub(super) fn g() {}",
        ),
        (
            "src/claim/proof.rs",
            "#[cfg(test)] mod tests { use super::*; use super::super::Sheet; }",
        ),
        (
            "src/claim/proof.rs",
            "mod a { } use super::Sheet; fn f() { { } } use super::Other;",
        ),
        (
            "src/orbit/mod.rs",
            "use super::{model::Motion, impact}; mod word; pub use word::Word;",
        ),
        (
            "src/evidence/dual.rs",
            "use crate::{tex::Tree, claim::Sheet, model::Motion, reference};",
        ),
        (
            "src/prove/search.rs",
            "use crate::{kernel::Term, algebra::Poly, claim::Sheet, tex::Tree, number::Rational};",
        ),
        ("src/number/mod.rs", "macro_rules! m { () => { $crate::tex::x } }"),
        ("src/lib.rs", "pub use crate::claim::Sheet;"),
        (
            "src/cli/audit.rs",
            "use crate::report::Table; use serde::ser::Serializer; use nalgebra::model;",
        ),
    ];
    for (path, text) in right {
        assert!(
            complaints(path, text).is_empty(),
            "{path}: {text}: {:?}",
            complaints(path, text)
        );
    }
}

#[test]
fn a_folder_without_a_place_is_an_error() {
    for path in ["src/util/mod.rs", "src/helpers.rs"] {
        let found = complaints(path, "");
        assert!(
            found.len() == 1 && found[0].contains("no place in the house"),
            "{found:?}"
        );
    }
}

#[test]
fn a_complaint_names_file_line_and_both_folders() {
    let found = complaints("src/tex/read.rs", "\n\nuse crate::model::Motion;");
    assert_eq!(
        found,
        ["src/tex/read.rs:3: `tex` uses `model`, which stands after it or in the other stack"]
    );
}
