//! Where golden files lie: in the binary, or in a directory that stands alone wherever it is copied.

use super::{Certified, Fault, Printed};
use crate::input::{open_regular, read_at_most};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

/// The file that every directory of golden values has.
pub const PRINTED: &str = "printed.csv";

/// The folder of certified values, which a directory may have.
const REFERENCE: &str = "reference";

/// The folder of scenes, which a directory may have.
const SCENES: &str = "scenes";

/// The longest file that is read: 16 MB.
const MOST_BYTES: u64 = 16 << 20;

/// The paper's own files, by their paths in `golden/paper/`.
const BUILT_IN: &[(&str, &str)] = &[
    (PRINTED, include_str!("../../golden/paper/printed.csv")),
    (
        "reference/bifurcations.csv",
        include_str!("../../golden/paper/reference/bifurcations.csv"),
    ),
    (
        "reference/orbits.csv",
        include_str!("../../golden/paper/reference/orbits.csv"),
    ),
    (
        "reference/sweeps.csv",
        include_str!("../../golden/paper/reference/sweeps.csv"),
    ),
    ("equations.toml", include_str!("../../golden/paper/equations.toml")),
];

/// Whether a path leads nowhere out of the directory that it is relative to.
fn stays_within(relative: &str) -> bool {
    let mut parts = Path::new(relative).components();
    parts.all(|part| matches!(part, Component::Normal(_) | Component::CurDir))
}

/// A directory of golden values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Directory {
    /// The paper's, in the binary.
    BuiltIn,
    /// Anyone's.
    At(PathBuf),
    /// Anyone's with files, by their paths relative to it, that are not written yet.
    Draft(PathBuf, BTreeMap<String, String>),
}

impl Directory {
    /// Where it lies, unless in the binary.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::BuiltIn => None,
            Self::At(path) | Self::Draft(path, _) => Some(path),
        }
    }

    /// How errors name a file of it.
    pub fn name(&self, relative: &str) -> String {
        match self.path() {
            None => format!("golden/paper/{relative}"),
            Some(path) => path.join(relative).display().to_string(),
        }
    }

    /// Whether a file lies in the directory at this path relative to it.
    pub fn has(&self, relative: &str) -> bool {
        let is_file = |path: &Path| path.join(relative).is_file();
        stays_within(relative) && self.path().is_some_and(is_file)
    }

    /// The text of a file by its path relative to the directory.
    ///
    /// # Errors
    /// A path that leads out of the directory; a file that is missing, no text, or cannot be read.
    pub fn read(&self, relative: &str) -> Result<String, Fault> {
        let fault = |message: String| Fault::of_file(&self.name(relative), message);
        if !stays_within(relative) {
            return Err(fault(
                "the path leads out of the directory, which must stand alone wherever it is copied".to_owned(),
            ));
        }
        match self {
            Self::Draft(_, files) if files.contains_key(relative) => Ok(files[relative].clone()),
            Self::BuiltIn => {
                let found = BUILT_IN.iter().find(|(name, _)| *name == relative);
                let text = found.map(|(_, text)| (*text).to_owned());
                text.ok_or_else(|| fault("there is no such built-in file".to_owned()))
            }
            Self::At(directory) | Self::Draft(directory, _) => {
                let file = open_regular(&directory.join(relative));
                let bytes = file.and_then(|file| read_at_most(file, MOST_BYTES));
                let bytes = bytes.map_err(|error| fault(self.why(relative, &error)))?;
                String::from_utf8(bytes).map_err(|error| {
                    let at = error.utf8_error().valid_up_to();
                    fault(format!("it is not UTF-8 from byte {at} on; save it as UTF-8"))
                })
            }
        }
    }

    fn why(&self, relative: &str, error: &io::Error) -> String {
        match (self.path(), error.kind()) {
            (Some(directory), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) if !directory.is_dir() => {
                format!(
                    "there is no directory {}; `check DIR --add` makes one",
                    directory.display()
                )
            }
            (_, io::ErrorKind::NotFound) if relative == PRINTED => {
                "there is no such file; a directory of golden values has one, which `check DIR --add` alone makes"
                    .to_owned()
            }
            (_, io::ErrorKind::NotFound) => "there is no such file".to_owned(),
            (_, io::ErrorKind::IsADirectory) => "it is a directory, not a file".to_owned(),
            (_, io::ErrorKind::FileTooLarge) => {
                format!(
                    "it has more than {} MB; no file of golden values is that long",
                    MOST_BYTES >> 20
                )
            }
            _ => error.to_string(),
        }
    }

    /// The rows of `printed.csv`.
    ///
    /// # Errors
    /// The file is missing, empty or makes no sense.
    pub fn printed(&self) -> Result<Vec<Printed>, Fault> {
        Printed::read(&self.name(PRINTED), &self.read(PRINTED)?)
    }

    /// The reference files by their paths relative to the directory, in the order of their names; none where there
    /// is no folder `reference/`.
    ///
    /// # Errors
    /// The folder cannot be listed, or has no file.
    pub fn reference_files(&self) -> Result<Vec<String>, Fault> {
        let Some(path) = self.path() else {
            let names = BUILT_IN.iter().map(|(name, _)| (*name).to_owned());
            return Ok(names.filter(|name| name.starts_with("reference/")).collect());
        };
        let files = self.listed(path, REFERENCE, ".csv")?;
        if files.is_empty() && path.join(REFERENCE).exists() {
            let message = "it has no .csv file; remove the folder, or put back what it had";
            return Err(Fault::of_file(&self.name(REFERENCE), message));
        }
        Ok(files)
    }

    /// The scenes in the folder `scenes/` that no row names, by their paths relative to the directory, in the order of
    /// their names; none of the paper's own, which are built in.
    ///
    /// # Errors
    /// The folder cannot be listed.
    pub fn unused_scenes(&self, printed: &[Printed], certified: &[Certified]) -> Result<Vec<String>, Fault> {
        let records = printed
            .iter()
            .map(|row| &row.record)
            .chain(certified.iter().map(|row| &row.record));
        let plain = |path: &str| -> PathBuf {
            let parts = Path::new(path).components();
            parts.filter(|part| *part != Component::CurDir).collect()
        };
        let used: Vec<PathBuf> = records.map(|record| plain(record.field("scene"))).collect();
        let mut scenes = match self.path() {
            Some(path) => self.listed(path, SCENES, ".toml")?,
            None => Vec::new(),
        };
        scenes.retain(|scene| !used.contains(&plain(scene)));
        Ok(scenes)
    }

    /// The files of a folder whose names end so, by their paths relative to the directory, in the order of their names.
    fn listed(&self, directory: &Path, folder: &str, end: &str) -> Result<Vec<String>, Fault> {
        let fault = |error: io::Error| Fault::of_file(&self.name(folder), error.to_string());
        let entries = match fs::read_dir(directory.join(folder)) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(fault(error)),
        };
        let mut files = Vec::new();
        for entry in entries {
            let name = entry.map_err(fault)?.file_name();
            let name = name.to_string_lossy();
            // Editors and --bless itself leave hidden files beside the one they write.
            if name.ends_with(end) && !name.starts_with('.') {
                files.push(format!("{folder}/{name}"));
            }
        }
        files.sort();
        Ok(files)
    }

    /// The rows of every reference file.
    ///
    /// # Errors
    /// A file is empty or makes no sense.
    pub fn certified(&self) -> Result<Vec<Certified>, Fault> {
        let mut rows = Vec::new();
        for file in self.reference_files()? {
            // a fault names the whole path; a row the same wherever the directory is copied
            let read = Certified::read(&self.name(&file), &self.read(&file)?)?;
            rows.extend(read.into_iter().map(|row| Certified {
                file: file.clone(),
                ..row
            }));
        }
        Ok(rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_paper_prints_at_least_twenty_five_numbers_and_words() {
        let rows = Directory::BuiltIn.printed();
        assert!(rows.as_ref().is_ok_and(|rows| rows.len() >= 25), "{:?}", rows.err());
    }

    #[test]
    fn a_path_that_leads_out_of_the_directory_is_refused() {
        let directory = Directory::At(std::env::temp_dir());
        for path in ["../printed.csv", "/etc/hosts", "scenes/../../x"] {
            let message = directory
                .read(path)
                .map_or_else(|fault| fault.to_string(), |_| String::new());
            assert!(message.contains("leads out of the directory"), "{path}: {message}");
        }
    }

    #[test]
    fn a_missing_directory_and_a_missing_file_are_told_apart() {
        let of = |path: PathBuf| {
            Directory::At(path)
                .printed()
                .map_or_else(|fault| fault.to_string(), |_| String::new())
        };
        assert!(of(PathBuf::from("no/such/directory")).contains("there is no directory no/such/directory"));
        assert!(of(Path::new(env!("CARGO_MANIFEST_DIR")).join("src")).contains("there is no such file"));
    }
}
