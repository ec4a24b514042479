//! That the files of a folder import each other in no circle, nor do its sub-folders.

use super::File;
use super::source::tokens;
use std::collections::{BTreeMap, BTreeSet};

/// The nodes that each node uses.
type Uses = BTreeMap<String, BTreeSet<String>>;

/// What is wrong with the imports between the files below `folder`. Paths start at the crate; what a file takes from a
/// `mod.rs` says of no file that it is used. What only tests see is left out.
pub fn check(sources: &[File], folder: &str) -> Vec<String> {
    let root = format!("src/{folder}/");
    let module = |file: &File| file.path["src/".len()..file.path.len() - ".rs".len()].to_owned();
    let inside = || sources.iter().filter(|file| file.path.starts_with(&root));
    let names: BTreeSet<String> = inside().map(module).collect();
    let (mut files, mut folders) = (Uses::new(), Uses::new());
    for file in inside().filter(|file| !file.path.ends_with("/mod.rs")) {
        let name = module(file);
        for used in used(&file.text, &names) {
            if let (Some(here), Some(there)) = (sub_folder(&name), sub_folder(&used))
                && here != there
            {
                folders.entry(here).or_default().insert(there);
            }
            files.entry(name.clone()).or_default().insert(used);
        }
    }
    let circles = [&files, &folders].into_iter().filter_map(circle);
    circles
        .map(|circle| format!("{} import each other in a circle", circle.join(", ")))
        .collect()
}

/// The folder within its folder that a file stands in.
fn sub_folder(module: &str) -> Option<String> {
    module
        .rsplit_once('/')
        .map(|(folder, _)| folder)
        .filter(|folder| folder.contains('/'))
        .map(str::to_owned)
}

/// The files that paths in `text` lead to.
fn used(text: &str, names: &BTreeSet<String>) -> BTreeSet<String> {
    let tokens: Vec<_> = tokens(text).into_iter().filter(|token| !token.test).collect();
    let starts = (0..tokens.len()).filter(|at| tokens[*at].text == "crate");
    let path = |start: usize| {
        let parts = tokens[start + 1..]
            .chunks(2)
            .take_while(|pair| pair[0].text == "::" && pair.len() == 2);
        let mut path = String::new();
        parts
            .map(|pair| {
                path = format!("{path}/{}", pair[1].text);
                path.trim_start_matches('/').to_owned()
            })
            .find(|path| names.contains(path))
    };
    starts.filter_map(path).collect()
}

/// The nodes that are left where those that use nothing of the rest are taken away, again and again: those of circles, and
/// what uses them.
fn circle(uses: &Uses) -> Option<Vec<String>> {
    let mut left: BTreeSet<&String> = uses.keys().collect();
    loop {
        let stays = |node: &&&String| uses[**node].iter().any(|used| left.contains(used));
        let rest: BTreeSet<&String> = left.iter().filter(|node| stays(node)).copied().collect();
        if rest.len() == left.len() {
            return (!left.is_empty()).then(|| left.into_iter().cloned().collect());
        }
        left = rest;
    }
}

#[cfg(test)]
fn complaints(files: &[(&str, &str)]) -> Vec<String> {
    let files: Vec<File> = files.iter().map(|(path, text)| File::new(path, text)).collect();
    check(&files, "orbit")
}

#[test]
fn a_circle_of_files_and_one_of_folders_are_found() {
    let files = [
        ("src/orbit/find.rs", "use crate::orbit::output::Output;"),
        ("src/orbit/output.rs", "fn f() -> crate::orbit::find::Found {}"),
    ];
    assert_eq!(
        complaints(&files),
        ["orbit/find, orbit/output import each other in a circle"]
    );
    let folders = [
        ("src/orbit/solve/a.rs", "use crate::orbit::equations::b::{B, C};"),
        ("src/orbit/equations/b.rs", ""),
        ("src/orbit/equations/c.rs", "use crate::orbit::solve::d;"),
        ("src/orbit/solve/d.rs", ""),
    ];
    assert_eq!(
        complaints(&folders),
        ["orbit/equations, orbit/solve import each other in a circle"]
    );
}

#[test]
fn what_leads_one_way_is_left_alone() {
    let files = [
        ("src/orbit/mod.rs", "mod find; pub use find::Found;"),
        (
            "src/orbit/find.rs",
            "use crate::orbit::solve::a::A; use crate::number::Field;",
        ),
        (
            "src/orbit/solve/a.rs",
            "// crate::orbit::find\n#[cfg(test)] mod tests { use crate::orbit::find::find; }",
        ),
    ];
    assert_eq!(complaints(&files), Vec::<String>::new());
}
