//! No golden file lies about unused: each is named by who uses it, or its directory is.

use super::File;

/// The golden files that no user names, neither by path nor by their own directory's path.
pub fn check(golden: &[String], users: &[File]) -> Vec<String> {
    let unused = golden.iter().filter(|path| {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        // All of golden/ at once would excuse every file in it.
        let folder_counts = folder.contains('/');
        !users
            .iter()
            .any(|user| names(&user.text, path) || (folder_counts && names(&user.text, folder)))
    });
    unused
        .map(|path| format!("{path}: no source, test, bench, README or CI script names it or its directory"))
        .collect()
}

/// Whether `path` stands in `text` as a whole: not as the head of a longer path.
fn names(text: &str, path: &str) -> bool {
    text.match_indices(path).any(|(at, _)| {
        let after = &text[at + path.len()..];
        let after = after.strip_prefix('/').unwrap_or(after);
        !after.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '_' | '-'))
            && !after
                .strip_prefix('.')
                .is_some_and(|rest| rest.starts_with(char::is_alphanumeric))
    })
}

#[cfg(test)]
fn unused(path: &str, user: &str) -> bool {
    !check(&[path.to_owned()], &[File::new("crates/claims/src/paper.rs", user)]).is_empty()
}

#[test]
fn a_file_that_nobody_names_is_found() {
    assert!(unused("golden/paper/symbols.toml", ""));
    assert!(unused(
        "golden/paper/symbols.toml",
        "include_str!(\"../golden/paper/equations.toml\")"
    ));
    assert!(unused(
        "golden/paper/symbols.toml",
        "golden/paper/symbols.toml.old golden/paper/symbols.tomlx"
    ));
    assert!(unused("golden/notes.txt", "everything in golden/ is data"));
}

#[test]
fn a_file_named_by_itself_or_by_its_directory_is_used() {
    assert!(!unused(
        "golden/paper/symbols.toml",
        "include_str!(\"../../golden/paper/symbols.toml\")"
    ));
    assert!(!unused("golden/paper/symbols.toml", "See golden/paper/symbols.toml."));
    assert!(!unused(
        "golden/paper/scenes/fig02.toml",
        "const SCENES: &str = \"golden/paper/scenes\";"
    ));
    assert!(!unused(
        "golden/paper/scenes/fig02.toml",
        "`golden/paper/scenes/` holds them"
    ));
}
