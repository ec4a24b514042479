//! The sheets of `tests/attacks`, and the truth that stands in their first lines.

use std::path::{Path, PathBuf};

/// The sheets, in order.
pub fn sheets() -> Vec<PathBuf> {
    let mut found = Vec::new();
    below(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/attacks"), &mut found);
    found
}

fn below(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            below(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "toml") {
            found.push(path);
        }
    }
}

/// The sheets that this run takes: one in three, chosen by name; all of them where corpora are run whole.
pub fn sampled() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let name = |path: &Path| {
        path.strip_prefix(root)
            .unwrap_or(path)
            .to_string_lossy()
            .replace('\\', "/")
    };
    let all = sheets().into_iter();
    all.filter(|path| super::sample::takes(&name(path), 3)).collect()
}

/// The truth that the first lines of a sheet say of one claim by its label, or of the last.
pub fn truth(text: &str, label: &str, is_last: bool) -> Option<String> {
    said(text, "truth", label, is_last)
}

/// Returns true if a sheet says that one claim has no value at any point.
pub fn has_no_points(text: &str, label: &str, is_last: bool) -> bool {
    said(text, "points", label, is_last).as_deref() == Some("none")
}

fn said(text: &str, of_what: &str, label: &str, is_last: bool) -> Option<String> {
    let of = |prefix: &str| {
        text.lines()
            .find_map(|line| line.strip_prefix(prefix))
            .map(|word| word.trim().to_string())
    };
    of(&format!("# {of_what} {label}:")).or_else(|| if is_last { of(&format!("# {of_what}:")) } else { None })
}
