//! A directory of files that is there whole or not at all.

use super::output::{OutputError, OutputProblem, TEMPORARIES, Temporary, directory_of, temporary_name, unless_stopped};
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A new directory. It is filled under another name beside its own, which it gets once it is finished; until then, a
/// file in it has the ending `part` while it is written. What is not finished is removed.
pub struct NewDirectory {
    path: PathBuf,
    temporary: Temporary,
}

impl NewDirectory {
    /// Begins a directory at a path where nothing stands, or an empty directory.
    ///
    /// # Errors
    /// A path that is taken, or beside which nothing can be written.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        let error = |problem| OutputError {
            place: path.display().to_string(),
            problem,
        };
        let system = |doing| move |source| error(OutputProblem::System { doing, source });
        match fs::read_dir(path) {
            Ok(entries) => {
                if entries.count() > 0 {
                    return Err(error(OutputProblem::NotEmpty));
                }
            }
            Err(source) if source.kind() == io::ErrorKind::NotFound && !path.is_symlink() => {}
            Err(source) => return Err(system("reading the directory")(source)),
        }
        // a link to an empty directory stays a link
        let path = path.canonicalize().unwrap_or_else(|_| path.components().collect());
        let parent = directory_of(&path);
        fs::create_dir_all(parent).map_err(system("creating the directory it is in"))?;
        let mut last = io::Error::from(io::ErrorKind::AlreadyExists);
        for attempt in 0..100 {
            let beside = parent.join(temporary_name(&path, attempt));
            // a signal that comes now waits until the directory is in the list
            let Ok(mut temporaries) = TEMPORARIES.lock() else {
                return Err(error(OutputProblem::Stopped));
            };
            match fs::create_dir(&beside) {
                Ok(()) => {
                    temporaries.insert(beside.clone());
                    let temporary = Temporary::new(beside);
                    return Ok(Self { path, temporary });
                }
                Err(source) if source.kind() == io::ErrorKind::AlreadyExists => last = source,
                Err(source) => return Err(system("creating a temporary directory beside it")(source)),
            }
        }
        Err(system("creating a temporary directory beside it")(last))
    }

    /// Writes a new file in the directory.
    ///
    /// # Errors
    /// A name that is taken; the system's answer.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<(), OutputError> {
        let file = self.temporary.path().join(name);
        let part = self.temporary.path().join(format!("{name}.part"));
        // once the directory is removed for the end of the program, nothing is put there any more
        let lock = || TEMPORARIES.lock().map_err(|_| io::Error::other("stopped"));
        let written = || {
            let mut opened = {
                let _temporaries = lock()?;
                OpenOptions::new().write(true).create_new(true).open(&part)?
            };
            opened.write_all(content)?;
            opened.sync_all()?;
            let _temporaries = lock()?;
            if file.exists() {
                return Err(io::Error::from(io::ErrorKind::AlreadyExists));
            }
            fs::rename(&part, &file)
        };
        written().map_err(|source| OutputError {
            place: self.path.join(name).display().to_string(),
            problem: OutputProblem::System {
                doing: "writing a new file",
                source,
            },
        })
    }

    /// Gives the directory its name.
    ///
    /// # Errors
    /// Where the computation was stopped, or something stands at the path by now.
    pub fn finish(mut self) -> Result<(), OutputError> {
        let error = |problem| OutputError {
            place: self.path.display().to_string(),
            problem,
        };
        unless_stopped().map_err(error)?;
        // an end by a signal waits here, or comes before and has removed it
        let temporaries = TEMPORARIES.lock();
        let renamed = fs::rename(self.temporary.path(), &self.path).map_err(|source| {
            error(OutputProblem::System {
                doing: "renaming the temporary directory",
                source,
            })
        });
        drop(temporaries);
        renamed?;
        self.temporary.keep();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Scratch(PathBuf);

    impl Scratch {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("vibro-audit-directory-{}-{name}", std::process::id()));
            fs::create_dir_all(&path).unwrap();
            Self(path)
        }

        fn names(&self) -> Vec<String> {
            let entries = fs::read_dir(&self.0).unwrap();
            let names = entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
            names.collect()
        }
    }

    impl Drop for Scratch {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn a_directory_appears_once_it_is_finished() {
        let scratch = Scratch::new("whole");
        let path = scratch.0.join("a/proofs");
        let directory = NewDirectory::create(&path).unwrap();
        directory.write("1.py", b"one").unwrap();
        assert!(!path.exists());
        directory.finish().unwrap();
        assert_eq!(fs::read_to_string(path.join("1.py")).unwrap(), "one");
        assert_eq!(scratch.names(), ["a"]);
        assert_eq!(fs::read_dir(scratch.0.join("a")).unwrap().count(), 1);
        let error = NewDirectory::create(&path).err().unwrap();
        assert!(error.to_string().contains("name a new one"), "{error}");
    }

    #[test]
    fn an_empty_directory_is_filled_and_an_unfinished_one_removed() {
        let scratch = Scratch::new("empty");
        let path = scratch.0.join("proofs");
        let directory = NewDirectory::create(&path).unwrap();
        directory.write("1.py", b"one").unwrap();
        assert!(directory.write("1.py", b"two").is_err());
        drop(directory);
        assert!(scratch.names().is_empty());
        fs::create_dir(&path).unwrap();
        let directory = NewDirectory::create(&path).unwrap();
        directory.write("1.py", b"one").unwrap();
        directory.finish().unwrap();
        assert_eq!(fs::read_dir(&path).unwrap().count(), 1);
        assert_eq!(scratch.names(), ["proofs"]);
        // what a name that is a file would be lost to
        fs::write(scratch.0.join("file"), "kept").unwrap();
        assert!(NewDirectory::create(&scratch.0.join("file")).is_err());
    }
}
