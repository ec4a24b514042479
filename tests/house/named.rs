//! Files of the project that the guide names are there.

use super::{File, assert_clean, files};
use std::path::Path;

/// The folders whose files are spoken of by their path.
const FOLDERS: [&str; 4] = ["crates/", "src/", "tests/", "benches/"];

/// A complaint for each path within backquotes that leads to nothing from the root of the project.
fn complaints(page: &File, is_there: &dyn Fn(&str) -> bool) -> Vec<String> {
    // an example in a block names files of its reader
    let prose = page.text.split("```").step_by(2);
    let quoted = prose.flat_map(|text| text.split('`').skip(1).step_by(2));
    let paths = quoted.filter(|quoted| {
        FOLDERS.iter().any(|folder| quoted.starts_with(folder)) && !quoted.contains(['*', ' ', '$', '{', ':'])
    });
    paths
        .filter(|path| !is_there(path))
        .map(|path| format!("{} names `{path}`, which is not there", page.path))
        .collect()
}

#[test]
fn a_path_that_leads_nowhere_is_found() {
    let page = File::new(
        "doc/a.md",
        "`src/a.rs`, `src/b.rs`, `b.rs`\n```\n`src/c.rs`\n```\n`src/*.rs`",
    );
    let found = complaints(&page, &|path| path == "src/a.rs");
    assert_eq!(found, ["doc/a.md names `src/b.rs`, which is not there"]);
}

#[test]
fn every_file_that_the_guide_names_is_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let pages: Vec<File> = ["README.md", "tests/README.md", "doc"]
        .into_iter()
        .flat_map(files)
        .collect();
    let pages = pages.iter().filter(|page| page.path.ends_with(".md"));
    let found: Vec<String> = pages
        .flat_map(|page| complaints(page, &|path| root.join(path).exists()))
        .collect();
    assert_clean(&found);
}
