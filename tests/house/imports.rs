//! Who may use whom: two stacks that meet once, and no circles within a folder.
//!
//! The files are read as text, up to their tests: a path that begins with `crate::` or `super::` is a use. Both are written
//! so that this suffices: never `use crate::{...}`.

use super::File;
use std::collections::{BTreeMap, BTreeSet};

/// The folders that each may use besides itself. The formulas know no ball, the dynamics know no TeX; what follows
/// `reference` may use both and what stands before it.
fn allowed(folder: &str) -> Option<&'static [&'static str]> {
    Some(match folder {
        "number" | "stop" | "markup" => &[],
        "tex" | "model" => &["number"],
        "claim" => &["number", "tex"],
        // What accepts a proof shares nothing with what looks for it.
        "kernel" => &["number", "tex", "claim"],
        "algebra" => &["number", "kernel"],
        "prove" => &["number", "tex", "claim", "kernel", "algebra"],
        "impact" => &["number", "model"],
        "orbit" => &["number", "model", "impact"],
        "reference" => &BOTH,
        // Proof and evidence share nothing: an error of the one must not repeat itself in the other.
        "evidence" => &["number", "tex", "claim", "model", "impact", "orbit", "reference"],
        // A repair is sieved by evidence and accepted by a proof.
        "repair" | "accuracy" => &LATER[..10],
        "scene" => &[
            "number",
            "tex",
            "claim",
            "model",
            "impact",
            "orbit",
            "reference",
            "evidence",
            "accuracy",
        ],
        "report" => &LATER[..13],
        "cli" => &LATER,
        _ => return None,
    })
}

const BOTH: [&str; 6] = ["number", "tex", "claim", "model", "impact", "orbit"];
const LATER: [&str; 14] = [
    "number",
    "tex",
    "claim",
    "model",
    "impact",
    "orbit",
    "kernel",
    "prove",
    "reference",
    "evidence",
    "repair",
    "accuracy",
    "scene",
    "report",
];

/// The code of a file without its comments and its tests, with the number of each line.
fn code(file: &File) -> impl Iterator<Item = (usize, &str)> {
    let tests = file.text.find("\n#[cfg(test)]\nmod ").unwrap_or(file.text.len());
    let lines = file.text[..tests].lines().enumerate();
    lines.map(|(index, line)| (index + 1, line.split("//").next().unwrap_or(line)))
}

/// The paths from the crate that a file uses, with their lines.
fn uses(file: &File) -> Vec<(usize, Vec<String>)> {
    let path = file.path.trim_start_matches("src/").trim_end_matches(".rs");
    let module: Vec<&str> = path.trim_end_matches("/mod").split('/').collect();
    let mut found = Vec::new();
    for (line, text) in code(file) {
        let starts = text.match_indices("crate::").map(|(at, _)| (at, 0));
        // of `super::super::x` the last one counts, with those before it
        let supers = text
            .match_indices("super::")
            .filter(|(at, _)| !text[at + 7..].starts_with("super::"));
        let supers = supers.map(|(at, _)| (at, 1 + text[..at].matches("super::").count()));
        for (at, ups) in starts.chain(supers) {
            if text[..at].ends_with('$') {
                continue;
            }
            let rest = &text[at + 7..];
            let names = rest.split("::").map_while(|part| {
                let end = part.find(|c: char| !c.is_alphanumeric() && c != '_');
                let name = &part[..end.unwrap_or(part.len())];
                (!name.is_empty()).then(|| (name.to_owned(), end.is_some()))
            });
            let mut ended = false;
            let names = names
                .take_while(|(_, ends)| !std::mem::replace(&mut ended, *ends))
                .map(|(name, _)| name);
            let base = match ups {
                0 => &[],
                ups => &module[..module.len().saturating_sub(ups)],
            };
            let base = base.iter().map(|part| (*part).to_owned());
            found.push((line, base.chain(names).collect()));
        }
    }
    found
}

/// What is wrong with what files use of other folders.
pub fn against_the_stack(sources: &[File]) -> Vec<String> {
    let mut complaints = Vec::new();
    for file in sources
        .iter()
        .filter(|file| !["src/lib.rs", "src/main.rs"].contains(&&*file.path))
    {
        let folder = file
            .path
            .trim_start_matches("src/")
            .split(['/', '.'])
            .next()
            .unwrap_or("");
        let Some(allowed) = allowed(folder) else {
            complaints.push(format!(
                "{}: give `{folder}` its place in tests/house/imports.rs",
                file.path
            ));
            continue;
        };
        for (line, path) in uses(file) {
            let used = path.first().map_or("*", String::as_str);
            if ![folder, "stop", "markup"].contains(&used) && !allowed.contains(&used) {
                complaints.push(format!("{}:{line}: `{folder}` may not use `{used}`", file.path));
            }
        }
    }
    complaints
}

/// Files, and sub-folders, of a folder that use each other in circles; the files left where those that use none of the
/// rest are taken away, again and again. What a file takes from a `mod.rs` says of no file that it is used.
pub fn circles(sources: &[File], folder: &str) -> Vec<String> {
    let root = format!("src/{folder}/");
    let inside = || {
        sources
            .iter()
            .filter(|file| file.path.starts_with(&root) && !file.path.ends_with("/mod.rs"))
    };
    let module = |file: &File| file.path["src/".len()..file.path.len() - ".rs".len()].to_owned();
    let names: BTreeSet<String> = inside().map(module).collect();
    let (mut files, mut folders) = (BTreeMap::new(), BTreeMap::new());
    for file in inside() {
        let name = module(file);
        let used = uses(file).into_iter().filter_map(|(_, path)| {
            let mut ends = (1..=path.len()).map(|end| path[..end].join("/"));
            ends.find(|path| names.contains(path))
        });
        let used: BTreeSet<String> = used.filter(|used| *used != name).collect();
        let sub_folder = |module: &str| module.rsplit_once('/').map(|(folder, _)| folder.to_owned());
        for (here, there) in used
            .iter()
            .filter_map(|used| Some((sub_folder(&name)?, sub_folder(used)?)))
        {
            if here != there && here != folder && there != folder {
                folders.entry(here).or_insert_with(BTreeSet::new).insert(there);
            }
        }
        files.insert(name, used);
    }
    let circle = |mut left: BTreeMap<String, BTreeSet<String>>| {
        loop {
            let before = left.len();
            let names: BTreeSet<String> = left.keys().cloned().collect();
            left.retain(|_, used| used.iter().any(|used| names.contains(used)));
            if left.len() == before {
                return names;
            }
        }
    };
    let circles = [circle(files), circle(folders)]
        .into_iter()
        .filter(|circle| !circle.is_empty());
    circles
        .map(|circle| format!("{circle:?} import each other in a circle"))
        .collect()
}

fn complaints(path: &str, text: &str) -> Vec<String> {
    against_the_stack(&[File::new(path, text)])
}

#[test]
fn a_use_against_the_stack_is_found() {
    for (path, text) in [
        ("src/number/rational.rs", "use crate::algebra::Poly;"),
        ("src/algebra/poly.rs", "fn f(x: &crate::tex::Tree) {}"),
        ("src/claim/proof.rs", "use super::super::impact;"),
        ("src/claim/mod.rs", "use super::impact::next;"),
        ("src/claim/deep/er.rs", "use super::super::super::model::X;"),
        ("src/evidence/dual.rs", "use crate::kernel::Term;"),
        ("src/kernel/term.rs", "use crate::prove::Decision;"),
        ("src/report/csv.rs", "use crate::cli::Exit;"),
        ("src/claim/proof.rs", "use crate::{number::Field, model::Motion};"),
        ("src/tex/read.rs", "use crate::*;"),
        ("src/util/mod.rs", ""),
    ] {
        assert_eq!(complaints(path, text).len(), 1, "{path}: {text}");
    }
}

#[test]
fn a_use_along_the_stack_is_left_alone() {
    for (path, text) in [
        (
            "src/algebra/poly.rs",
            "use crate::number::Field; use super::*; use crate::algebra::x;",
        ),
        (
            "src/claim/proof.rs",
            "// crate::model\nuse super::Sheet; pub(crate) fn f() {}",
        ),
        (
            "src/claim/deep/er.rs",
            "use super::super::Sheet;\n#[cfg(test)]\nmod tests { use crate::model::X; }",
        ),
        ("src/number/mod.rs", "macro_rules! m { () => { $crate::tex::x } }"),
        ("src/lib.rs", "pub use crate::claim::Sheet;"),
    ] {
        assert_eq!(complaints(path, text), [""; 0], "{path}: {text}");
    }
}

#[test]
fn circles_of_files_and_of_folders_are_found_and_nothing_else_is() {
    let found = |files: &[(&str, &str)]| {
        let files: Vec<File> = files.iter().map(|(path, text)| File::new(path, text)).collect();
        circles(&files, "orbit").len()
    };
    assert_eq!(
        found(&[
            ("src/orbit/find.rs", "use crate::orbit::output::Output;"),
            ("src/orbit/output.rs", "fn f() -> super::find::Found {}"),
        ]),
        1
    );
    assert_eq!(
        found(&[
            ("src/orbit/solve/a.rs", "use crate::orbit::equations::b::{B, C};"),
            ("src/orbit/equations/b.rs", ""),
            ("src/orbit/equations/c.rs", "use crate::orbit::solve::d::D;"),
            ("src/orbit/solve/d.rs", ""),
        ]),
        1
    );
    assert_eq!(
        found(&[
            ("src/orbit/mod.rs", "mod find; pub use find::Found;"),
            ("src/orbit/find.rs", "use crate::orbit::solve::a::A;"),
            (
                "src/orbit/solve/a.rs",
                "// crate::orbit::find::x\n#[cfg(test)]\nmod tests { use crate::orbit::find::find; }"
            ),
        ]),
        0
    );
}
