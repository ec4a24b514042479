//! The files around a document: what it includes, and the preamble of the document that includes it.

use super::note;
use super::source::{DOCUMENT_AT_MOST, Source};
use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The most directories between that of a document and that of its project, if no version control says where it begins.
const HIGHEST: usize = 3;

/// Files that are looked at in one directory for one that includes the document, and files of a preamble.
const MOST_FILES: usize = 200;

/// The longest file that is looked at so, and the longest preamble, in bytes.
const LONGEST: usize = 1 << 20;

/// The most files of a preamble that may lie in each other.
const DEEPEST: usize = 4;

/// Commands that name files in which a preamble has macros of the author's own.
const TAKING_IN: [&str; 4] = [r"\input", r"\include", r"\usepackage", r"\RequirePackage"];

/// The text that defines macros, and the files that it was taken from, each once.
#[derive(Default)]
struct Preamble {
    text: String,
    files: HashSet<PathBuf>,
}

/// The directories of a document and its project.
pub struct Files {
    /// That of the document.
    own: PathBuf,
    /// The highest one that the project may lie in.
    top: PathBuf,
    /// The document that includes this one.
    root: Option<PathBuf>,
}

impl Files {
    /// Looks for the document that includes the one at a path with this text: by its comment `% !TEX root = ...`, or upward.
    pub fn around(path: &Path, text: &str) -> Self {
        let own = directory(path);
        let ancestors = ancestors(&own);
        let top = ancestors.last().cloned().unwrap_or_else(|| own.clone());
        let mut files = Self { own, top, root: None };
        files.root = match declared_root(text) {
            Some(name) => files.find(&files.own, name).filter(|path| files.holds(path)),
            None if is_root(text) || path.extension().is_none_or(|extension| extension != "tex") => None,
            None => ancestors.iter().find_map(|directory| root_in(directory, path)),
        };
        if let Some(root) = &files.root {
            note(&format!("{}: macros of {} are used", path.display(), root.display()));
        }
        files
    }

    /// The text of a file that the document includes, by its name from the directory of the document or of the one that includes it,
    /// or from one above within the project, which authors name in `TEXINPUTS`.
    ///
    /// # Errors
    /// Why there is none: it is missing, cannot be read, or lies outside the project.
    pub fn included(&self, name: &str) -> Result<String, String> {
        let root = self.root.as_deref().map(directory);
        let path = std::iter::once(&self.own)
            .chain(&root)
            .find_map(|directory| self.find(directory, name))
            .or_else(|| self.find_above(name))
            .ok_or("there is no such file")?;
        if !self.holds(&path) {
            return Err(format!("it leads out of {}", self.top.display()));
        }
        let text = Source::File(path).read_document(DOCUMENT_AT_MOST);
        text.map_err(|error| error.problem.to_string())
    }

    /// Returns the text that defines macros before the document begins: the preamble of the one that includes it, and packages that
    /// lie beside either.
    pub fn preamble(&self, text: &str) -> String {
        let mut preamble = Preamble::default();
        if let Some(root) = &self.root
            && let Some(own) = text_of(root)
        {
            let end = own.find(r"\begin{document}").unwrap_or(own.len());
            self.take(
                own.get(..end).unwrap_or_default(),
                &directory(root),
                DEEPEST,
                &mut preamble,
            );
        }
        let packages = taken_in(text).filter(|(command, _)| command.ends_with("ackage"));
        for (_, name) in packages {
            self.take_file(name, &self.own, DEEPEST, &mut preamble);
        }
        preamble.text
    }

    /// Appends a text without comments, and the files that it takes in.
    fn take(&self, text: &str, directory: &Path, depth: usize, preamble: &mut Preamble) {
        let plain: Vec<&str> = text.lines().map(without_comment).collect();
        let plain = plain.join("\n");
        if preamble.text.len() + plain.len() > LONGEST {
            return;
        }
        for (_, name) in taken_in(&plain) {
            self.take_file(name, directory, depth, preamble);
        }
        preamble.text.push_str(&plain);
        preamble.text.push('\n');
    }

    fn take_file(&self, name: &str, directory: &Path, depth: usize, preamble: &mut Preamble) {
        let Some(depth) = depth.checked_sub(1) else { return };
        for name in name.split(',').map(str::trim).filter(|name| !name.is_empty()) {
            let path = self.find(directory, name).or_else(|| self.find_above(name));
            let path = path.filter(|path| self.holds(path));
            let new = path.filter(|path| preamble.files.len() < MOST_FILES && preamble.files.insert(path.clone()));
            if let Some(text) = new.and_then(|path| text_of(&path)) {
                self.take(&text, directory, depth, preamble);
            }
        }
    }

    /// True for a file of the project.
    fn holds(&self, path: &Path) -> bool {
        matches!((path.canonicalize(), self.top.canonicalize()), (Ok(path), Ok(top)) if path.starts_with(&top))
    }

    /// The file of a name in the nearest directory above that of the document, within the project.
    fn find_above(&self, name: &str) -> Option<PathBuf> {
        ancestors(&self.own)
            .iter()
            .skip(1)
            .find_map(|directory| self.find(directory, name))
    }

    /// The file of a name, with or without its extension.
    fn find(&self, directory: &Path, name: &str) -> Option<PathBuf> {
        let names = [format!("{name}.tex"), format!("{name}.sty"), name.to_owned()];
        names
            .iter()
            .map(|name| directory.join(name))
            .find(|path| path.is_file())
    }
}

/// The directory of a file.
pub fn directory(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// A directory and those above it that its project may begin in, up to the one under version control.
fn ancestors(directory: &Path) -> Vec<PathBuf> {
    let mut found = vec![directory.to_owned()];
    let mut whole = directory.canonicalize().ok();
    while let Some(own) = whole.filter(|own| found.len() <= HIGHEST && !own.join(".git").exists()) {
        whole = own.parent().map(Path::to_owned);
        found.extend(whole.clone());
    }
    found
}

fn text_of(path: &Path) -> Option<String> {
    let is_short = fs::metadata(path).is_ok_and(|file| file.is_file() && file.len() <= LONGEST as u64);
    // a pipe is not opened: that waits for its writer
    let bytes = if is_short { fs::read(path).ok()? } else { return None };
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

/// Returns a line without its comment.
fn without_comment(line: &str) -> &str {
    let end = line.match_indices('%').map(|(at, _)| at).find(|&at| {
        let before = line.get(..at).unwrap_or_default();
        (before.len() - before.trim_end_matches('\\').len()) % 2 == 0
    });
    line.get(..end.unwrap_or(line.len())).unwrap_or_default()
}

/// The name that `% !TEX root = ...` among the first lines gives.
fn declared_root(text: &str) -> Option<&str> {
    text.lines().take(20).find_map(|line| {
        let said = line.trim().strip_prefix('%')?.trim().strip_prefix("!TEX root")?;
        Some(said.trim().strip_prefix('=')?.trim())
    })
}

fn is_root(text: &str) -> bool {
    let mut lines = text.lines().map(without_comment);
    lines.any(|line| line.contains(r"\begin{document}") || line.contains(r"\documentclass"))
}

/// The document of a directory that includes the one at a path, or the only one that is a whole document.
fn root_in(directory: &Path, path: &Path) -> Option<PathBuf> {
    let own = path.canonicalize().ok()?;
    let entries = fs::read_dir(directory).ok()?.flatten().map(|entry| entry.path());
    let mut names: Vec<PathBuf> = entries
        .filter(|file| file.extension().is_some_and(|extension| extension == "tex"))
        .take(MOST_FILES)
        .collect();
    names.sort();
    let whole: Vec<(PathBuf, String)> = names
        .into_iter()
        .filter_map(|name| text_of(&name).map(|text| (name, text)))
        .filter(|(_, text)| is_root(text))
        .collect();
    let includes = |(_, text): &&(PathBuf, String)| {
        taken_in(text).any(|(_, name)| {
            let named = [directory.join(format!("{name}.tex")), directory.join(name)];
            named
                .iter()
                .any(|file| file.canonicalize().is_ok_and(|file| file == own))
        })
    };
    let root = whole.iter().find(includes).or(match whole.as_slice() {
        [only] => Some(only),
        _ => None,
    });
    root.map(|(name, _)| name.clone())
}

/// The names that a text takes in, each with the command that does.
fn taken_in(text: &str) -> impl Iterator<Item = (&'static str, &str)> {
    TAKING_IN.into_iter().flat_map(move |command| {
        text.match_indices(command).filter_map(move |(at, _)| {
            let mut rest = text.get(at + command.len()..)?;
            if rest.starts_with('[') {
                rest = rest.get(rest.find(']')? + 1..)?;
            }
            let name = rest.strip_prefix('{')?.split('}').next()?;
            Some((command, name.trim()))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_names_the_document_that_includes_this_one() {
        assert_eq!(declared_root("% !TEX root = ../main.tex\n"), Some("../main.tex"));
        assert_eq!(declared_root("x"), None);
    }

    #[test]
    fn a_comment_is_no_part_of_a_line() {
        assert_eq!(without_comment(r"a \% b % c"), r"a \% b ");
        assert_eq!(without_comment("% all"), "");
    }

    #[test]
    fn files_are_named_by_the_commands_that_take_them_in() {
        let text = r"\input{a} \usepackage[x]{b, c} \include{d/e} \includegraphics{f}";
        let names: Vec<&str> = taken_in(text).map(|(_, name)| name).collect();
        assert_eq!(names, ["a", "d/e", "b, c"]);
    }
}
