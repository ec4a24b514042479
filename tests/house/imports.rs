//! Who may use whom: two stacks that meet once, and no circles of files.
//!
//! The files are read as text, up to their tests: a path that begins with `crate::` or `super::` is a use.

use super::File;
use std::collections::{BTreeMap, BTreeSet};

/// The folders of `src`, and the crates under the names that `src/lib.rs` gives them, that each may use besides itself. What
/// the crates use is Cargo's, and [`CRATES`] says.
fn allowed(folder: &str) -> Option<&'static [&'static str]> {
    Some(match folder {
        // A repair is sieved by evidence and accepted by a proof.
        "repair" => &["number", "tex", "claim", "evidence", "prove"],
        "report" => &LATER[..13],
        "cli" => &LATER,
        _ => return None,
    })
}

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
    "accuracy",
    "scene",
    "repair",
    "report",
];

/// The crates of ours that each may depend on. The formulas know no ball, but for evidence, which follows motions. What
/// accepts a proof shares nothing with what looks for it, nor proof with evidence: an error of the one must not repeat itself
/// in the other.
pub const CRATES: [(&str, &[&str]); 10] = [
    ("stop", &[]),
    ("numbers", &[]),
    ("texmath", &["numbers"]),
    ("dynamics", &["numbers", "stop"]),
    ("claims", &["kernel", "numbers", "texmath"]),
    ("kernel", &["numbers"]),
    ("prover", &["claims", "kernel", "numbers", "stop", "texmath"]),
    ("evidence", &["claims", "dynamics", "numbers", "texmath"]),
    ("scenes", &["dynamics", "numbers", "stop", "texmath"]),
    (
        "accuracy",
        &["claims", "dynamics", "numbers", "scenes", "stop", "texmath"],
    ),
];

/// The crates of ours that a Cargo.toml names.
pub fn dependencies(manifest: &str) -> BTreeSet<String> {
    let lines = manifest.lines().filter_map(|line| line.strip_prefix("vibro-"));
    lines
        .filter_map(|line| Some(line.split_once(['.', ' '])?.0.to_owned()))
        .collect()
}

/// The code of a file without its comments and its tests.
fn code(file: &File) -> String {
    let tests = file.text.find("\n#[cfg(test)]\nmod ").unwrap_or(file.text.len());
    let lines = file.text[..tests].lines();
    let code: Vec<&str> = lines.map(|line| line.split("//").next().unwrap_or(line)).collect();
    code.join("\n")
}

/// The names of the modules that lead to a file, a `mod.rs` or the root of a crate, which has none.
fn module(file: &File) -> Vec<String> {
    let path = file.path.trim_start_matches("src/").trim_end_matches(".rs");
    let names = path.trim_end_matches("/mod").split('/').map(str::to_owned);
    names.filter(|name| name != "lib").collect()
}

fn is_mod(file: &File) -> bool {
    file.path.ends_with("/mod.rs") || file.path == "src/lib.rs"
}

/// Adds the paths behind `path` of a tree such as `a::{b, c::d as e}`, each with the name that it has from there on; what
/// follows the tree.
fn read_tree<'t>(mut text: &'t str, mut path: Vec<String>, found: &mut Vec<(Vec<String>, String)>) -> &'t str {
    let name = |text: &'t str| {
        let end = text.find(|c: char| !c.is_alphanumeric() && c != '_');
        text.split_at(end.unwrap_or(text.len()))
    };
    loop {
        if let Some(inner) = text.strip_prefix('{') {
            text = inner.trim_start();
            while !text.is_empty() && !text.starts_with('}') {
                let rest = read_tree(text, path.clone(), found);
                text = rest[rest.find([',', '}']).unwrap_or(rest.len())..]
                    .trim_start_matches(|c: char| c == ',' || c.is_whitespace());
            }
            return text.strip_prefix('}').unwrap_or(text);
        }
        let (next, rest) = name(text);
        path.extend((!next.is_empty()).then(|| next.to_owned()));
        match rest.strip_prefix("::") {
            Some(rest) if !next.is_empty() => text = rest,
            _ => {
                let renamed = rest.strip_prefix(" as ").map(|rest| name(rest).0);
                found.push((path, renamed.unwrap_or(next).to_owned()));
                return rest;
            }
        }
    }
}

/// The paths from the crate that a file uses, with their lines.
fn uses(file: &File) -> Vec<(usize, Vec<String>)> {
    let (text, module) = (code(file), module(file));
    let mut found = Vec::new();
    let starts = text.match_indices("crate::").map(|(at, _)| (at, 0));
    // of `super::super::x` the last one counts, with those before it
    let supers = text
        .match_indices("super::")
        .filter(|(at, _)| !text[at + 7..].starts_with("super::"));
    let supers = supers.map(|(at, _)| {
        let before = &text[..at];
        let apart = before.trim_end_matches("super::");
        (at, 1 + (before.len() - apart.len()) / "super::".len())
    });
    for (at, ups) in starts.chain(supers) {
        if text[..at].ends_with('$') {
            continue;
        }
        let base = match ups {
            0 => &[],
            ups => &module[..module.len().saturating_sub(ups)],
        };
        let mut paths = Vec::new();
        read_tree(&text[at + 7..], base.to_vec(), &mut paths);
        let line = 1 + text[..at].matches('\n').count();
        found.extend(paths.into_iter().map(|(path, _)| (line, path)));
    }
    found
}

/// What the `mod.rs` of a folder takes from what lies in it, under the names by which others find it there.
fn exports(file: &File) -> impl Iterator<Item = (String, Vec<String>)> {
    let (text, module) = (code(file), module(file));
    let mut found = Vec::new();
    for (at, word) in text.match_indices("use ") {
        read_tree(&text[at + word.len()..], module.clone(), &mut found);
    }
    found
        .into_iter()
        .map(move |(path, name)| ([module.clone(), vec![name]].concat().join("/"), path))
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
            if ![folder, "stop", "markup", "checksum", "input"].contains(&used) && !allowed.contains(&used) {
                complaints.push(format!("{}:{line}: `{folder}` may not use `{used}`", file.path));
            }
        }
    }
    complaints
}

/// Files, and sub-folders of a folder, that use each other in circles. What a file takes from a `mod.rs` that has it from
/// another file is used of that one; what stands in the `mod.rs` itself says of no file that it is used.
pub fn circles(sources: &[File]) -> Vec<String> {
    let name = |file: &File| module(file).join("/");
    let (folders, files): (Vec<&File>, Vec<&File>) = sources.iter().partition(|file| is_mod(file));
    let names: BTreeSet<String> = files.iter().map(|file| name(file)).collect();
    let modules: BTreeSet<String> = sources.iter().map(name).collect();
    let exports = folders.into_iter().flat_map(exports).filter(|(name, path)| {
        let child = path.iter().take(name.split('/').count());
        // of a module and what is called like it, a path names the module
        !modules.contains(name) && modules.contains(&child.cloned().collect::<Vec<_>>().join("/"))
    });
    let exports: BTreeMap<String, Vec<String>> = exports.collect();
    let used_by = |file: &File| -> BTreeSet<String> {
        let own = name(file);
        let used = uses(file)
            .into_iter()
            .filter_map(|(_, path)| file_of(path, &names, &exports));
        used.filter(|used| *used != own).collect()
    };
    let files: BTreeMap<String, BTreeSet<String>> = files.iter().map(|file| (name(file), used_by(file))).collect();
    // what lies right in a folder of `src` is in no sub-folder
    let sub_folder = |module: &str| {
        let (folder, _) = module.rsplit_once('/')?;
        folder.contains('/').then(|| folder.to_owned())
    };
    let mut folders: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (file, used) in &files {
        let there = used.iter().filter_map(|used| sub_folder(used));
        if let Some(here) = sub_folder(file) {
            let others = there.filter(|there| *there != here);
            folders.entry(here.clone()).or_default().extend(others);
        }
    }
    let circles = [circle(files), circle(folders)].into_iter();
    circles
        .filter(|circle| !circle.is_empty())
        .map(|circle| format!("{circle:?} import each other in circles"))
        .collect()
}

/// The file in which a path ends, by way of what a `mod.rs` takes from what lies in its folder.
fn file_of(mut path: Vec<String>, names: &BTreeSet<String>, exports: &BTreeMap<String, Vec<String>>) -> Option<String> {
    loop {
        let mut starts = (1..=path.len()).rev().map(|end| (end, path[..end].join("/")));
        let (end, start) = starts.find(|(_, start)| names.contains(start) || exports.contains_key(start))?;
        match exports.get(&start) {
            Some(from) => path = [from, &path[end..]].concat(),
            None => return Some(start),
        }
    }
}

/// The modules left where those that use none of the rest, or of which none of the rest makes use, are taken away, again and
/// again.
fn circle(mut left: BTreeMap<String, BTreeSet<String>>) -> BTreeSet<String> {
    loop {
        let names: BTreeSet<String> = left.keys().cloned().collect();
        let used: BTreeSet<String> = left.values().flatten().cloned().collect();
        left.retain(|name, uses| used.contains(name) && !uses.is_disjoint(&names));
        if left.len() == names.len() {
            return names;
        }
    }
}

fn complaints(path: &str, text: &str) -> Vec<String> {
    against_the_stack(&[File::new(path, text)])
}

#[test]
fn a_dependency_is_found_whichever_way_it_is_written() {
    let found = dependencies(
        "name = \"vibro-claims\"\nvibro-kernel.workspace = true\nvibro-stop = { path = \"../stop\" }\nserde = \"1\"\n",
    );
    assert_eq!(found, BTreeSet::from(["kernel".to_owned(), "stop".to_owned()]));
}

#[test]
fn a_use_against_the_stack_is_found() {
    for (path, text) in [
        ("src/repair/poly.rs", "fn f(x: &crate::report::Table) {}"),
        ("src/repair/proof.rs", "use super::super::scene;"),
        ("src/repair/mod.rs", "use super::kernel::next;"),
        ("src/repair/deep/er.rs", "use super::super::super::kernel::X;"),
        ("src/report/csv.rs", "use crate::cli::Exit;"),
        ("src/repair/proof.rs", "use crate::{number::Field, kernel::Term};"),
        ("src/report/read.rs", "use crate::*;"),
        ("src/util/mod.rs", ""),
    ] {
        assert_eq!(complaints(path, text).len(), 1, "{path}: {text}");
    }
}

#[test]
fn a_use_along_the_stack_is_left_alone() {
    for (path, text) in [
        (
            "src/repair/poly.rs",
            "use crate::number::Field; use super::*; use crate::repair::x;",
        ),
        (
            "src/repair/proof.rs",
            "// crate::kernel\nuse super::Sheet; pub(crate) fn f() {}",
        ),
        (
            "src/repair/deep/er.rs",
            "use super::super::Sheet;\n#[cfg(test)]\nmod tests { use crate::kernel::X; }",
        ),
        ("src/repair/mod.rs", "macro_rules! m { () => { $crate::prove::x } }"),
        ("src/lib.rs", "pub use crate::claim::Sheet;"),
    ] {
        assert_eq!(complaints(path, text), [""; 0], "{path}: {text}");
    }
}

#[test]
fn circles_of_files_and_of_folders_are_found_and_nothing_else_is() {
    let found = |files: &[(&str, &str)]| {
        let files: Vec<File> = files.iter().map(|(path, text)| File::new(path, text)).collect();
        circles(&files).len()
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
    for text in [
        "use super::Found;",
        "use super::{Found, Other};",
        "use crate::orbit::{self, Found as F};",
    ] {
        assert_eq!(
            found(&[
                ("src/orbit/mod.rs", "mod find;\npub use find::{\n    Find as Found,\n};"),
                ("src/orbit/find.rs", "use super::solve::{\n    b,\n    a::{A, B},\n};"),
                ("src/orbit/solve.rs", ""),
                ("src/orbit/solve/a.rs", &text.replace("super::", "super::super::")),
            ]),
            1,
            "{text}"
        );
    }
    assert_eq!(
        found(&[
            ("src/lib.rs", "mod find;\nmod solve;\npub use find::Found;"),
            ("src/find.rs", "use crate::solve::Solve;"),
            ("src/solve.rs", "use super::Found;"),
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
