//! The rules of the house, held by tests: who may use whom, that no files import each other in circles, and that no golden
//! file lies about unused. Each rule is a function that is itself shown sources that break it. That nothing panics by its own word is
//! clippy's to say: each `lib.rs` denies it.

mod golden;
mod guide;
mod imports;
mod named;

use std::fs;
use std::path::Path;

/// A file by its path from the root of the project, with `/` between the parts.
#[derive(Clone, Debug)]
struct File {
    path: String,
    text: String,
}

impl File {
    fn new(path: &str, text: &str) -> Self {
        Self {
            path: path.to_owned(),
            text: text.to_owned(),
        }
    }
}

/// Every file under `place`, a folder or a file of the project, in the order of their paths. What is not there
/// gives none: a project without golden files yet has none to check.
fn files(place: &str) -> Vec<File> {
    let mut found = Vec::new();
    collect(&Path::new(env!("CARGO_MANIFEST_DIR")).join(place), place, &mut found);
    found.sort_by(|left, right| left.path.cmp(&right.path));
    found
}

fn collect(path: &Path, name: &str, found: &mut Vec<File>) {
    // a crate's way to golden/ is none of its files
    if path.is_symlink() {
        return;
    }
    if path.is_dir() {
        for entry in fs::read_dir(path).unwrap() {
            let entry = entry.unwrap();
            let child = format!("{name}/{}", entry.file_name().to_string_lossy());
            collect(&entry.path(), &child, found);
        }
    } else if path.is_file() {
        let text = String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned();
        found.push(File {
            path: name.to_owned(),
            text,
        });
    }
}

/// The sources of the program.
fn sources() -> Vec<File> {
    let sources = rust("src");
    assert!(sources.len() > 5, "the sources were not found");
    sources
}

fn rust(place: &str) -> Vec<File> {
    let all = files(place).into_iter();
    all.filter(|file| file.path.ends_with(".rs")).collect()
}

/// The sources of each other crate, by their paths from its own directory.
fn crates() -> Vec<Vec<File>> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates");
    let names = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().file_name());
    let crates: Vec<Vec<File>> = names
        .map(|name| {
            let place = format!("crates/{}/", name.to_string_lossy());
            let of_crate = |file: File| File::new(&file.path[place.len()..], &file.text);
            rust(&format!("{place}src")).into_iter().map(of_crate).collect()
        })
        .collect();
    assert!(
        crates.iter().all(|sources| !sources.is_empty()),
        "a crate without sources"
    );
    crates
}

fn assert_clean(complaints: &[String]) {
    assert!(
        complaints.is_empty(),
        "{} complaints\n{}",
        complaints.len(),
        complaints.join("\n")
    );
}

#[test]
fn each_folder_uses_only_what_stands_before_it_in_its_stack() {
    assert_clean(&imports::against_the_stack(&sources()));
}

#[test]
fn each_crate_depends_only_on_what_it_may() {
    let mut named = Vec::new();
    for file in files("crates")
        .into_iter()
        .filter(|file| file.path.ends_with("Cargo.toml"))
    {
        let name = file.path.split('/').nth(1).unwrap_or_default().to_owned();
        let allowed = imports::CRATES.iter().find(|(known, _)| *known == name);
        let (_, allowed) = allowed.unwrap_or_else(|| panic!("give `{name}` its place in tests/house/imports.rs"));
        let others = imports::dependencies(&file.text);
        let others: Vec<&String> = others
            .iter()
            .filter(|other| !allowed.contains(&other.as_str()))
            .collect();
        assert!(others.is_empty(), "`{name}` may not depend on {others:?}");
        named.push(name);
    }
    assert_eq!(named.len(), imports::CRATES.len(), "{named:?}");
}

#[test]
fn files_import_each_other_in_no_circle() {
    assert_clean(&imports::circles(&sources()));
    for sources in crates() {
        assert_clean(&imports::circles(&sources));
    }
}

#[test]
fn every_golden_file_is_named_where_it_is_used() {
    let places = ["src", "crates", "tests", "benches", "README.md", ".ci"];
    // These tests name golden files that do not exist, to show that the check can fail.
    let users: Vec<File> = places
        .into_iter()
        .flat_map(files)
        .filter(|file| !file.path.starts_with("tests/house/"))
        .collect();
    let golden: Vec<String> = files("golden").into_iter().map(|file| file.path).collect();
    assert_clean(&golden::check(&golden, &users));
}
