//! Where a command writes: stdout, or a file that is there whole or not at all.

use crate::stop::Token;
use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// A place to write to.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub enum Output {
    /// Standard output. A reader that stops reading (`| head`) is not an error.
    #[default]
    Stdout,
    /// A file that the user named, replaced as a whole once everything is written. A link keeps being a link: the file
    /// that it points to is replaced.
    File(PathBuf),
    /// A file whose name the program chose, in a directory that the user named; as [`Output::File`], but never through a
    /// symbolic link, which somebody else may have put there.
    Member(PathBuf),
}

/// A file or stdout that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {place}: {problem}")]
pub struct OutputError {
    /// `stdout`, or the path as the user gave it.
    pub place: String,
    /// What failed.
    pub problem: OutputProblem,
}

/// What failed.
#[derive(Debug, thiserror::Error)]
pub enum OutputProblem {
    /// The path is a directory.
    #[error("it is a directory; name a file in it")]
    Directory,
    /// The directory holds something.
    #[error("the directory is not empty; name a new one, or remove it")]
    NotEmpty,
    /// The directory that the file would be in does not exist.
    #[error("there is no directory {0}; create it first")]
    NoDirectory(String),
    /// A link to nothing: writing would replace the link, or make a file elsewhere.
    #[error("it is a link to {0}, which is not there; name a file, or remove the link")]
    Dangling(String),
    /// A symbolic link where the program chose the name.
    #[error("it is a symbolic link to {0}, which is not followed; remove the link, or choose another directory")]
    Link(String),
    /// A device or a pipe where the program chose the name.
    #[error("it is not a regular file; remove it, or choose another directory")]
    NotRegular,
    /// Another process writes the file or the directory.
    #[error("another run is writing it; try again when that has ended")]
    Busy,
    /// The file is one that the command reads.
    #[error("it is read as an input, which would be lost; choose another file")]
    Input,
    /// What is to be written was stopped on its way, and may lack a part.
    #[error("the computation was stopped")]
    Stopped,
    /// The file exists and is protected.
    #[error("it is read-only; choose another file or change its permissions")]
    ReadOnly,
    /// The system refused to open, write or rename.
    #[error("{doing}: {source}")]
    System {
        /// What was being done.
        doing: &'static str,
        /// The system's answer.
        source: io::Error,
    },
}

impl OutputProblem {
    pub(super) fn system(doing: &'static str) -> impl Fn(io::Error) -> Self {
        move |source| Self::System { doing, source }
    }
}

/// The files and directories that were read from, links followed.
static INPUTS: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// The files themselves, whatever they are called: of hard links, and of a file behind standard input.
static FILES: Mutex<BTreeSet<[u64; 2]>> = Mutex::new(BTreeSet::new());

/// Takes note of a file, or of a directory with the files in it, that is read: no output replaces it from now on.
pub fn note_input(path: &Path) {
    if let (Ok(path), Ok(mut inputs)) = (path.canonicalize(), INPUTS.lock()) {
        inputs.insert(path);
    }
    note_file(fs::metadata(path));
}

/// The same of what standard input is, where that is a file.
pub fn note_stdin() {
    #[cfg(unix)]
    {
        use std::os::fd::AsFd;
        let own = io::stdin().as_fd().try_clone_to_owned();
        note_file(own.and_then(|own| File::from(own).metadata()));
    }
}

/// Forgets all inputs that were noted, so that a later command of the same process may write what an earlier one has read.
pub fn forget_inputs() {
    if let Ok(mut inputs) = INPUTS.lock() {
        inputs.clear();
    }
    if let Ok(mut files) = FILES.lock() {
        files.clear();
    }
}

fn note_file(found: io::Result<fs::Metadata>) {
    let found = found.ok().filter(fs::Metadata::is_file);
    if let (Some(file), Ok(mut files)) = (found.as_ref().and_then(identity), FILES.lock()) {
        files.insert(file);
    }
}

/// What tells a file from all others, where the system says.
fn identity(found: &fs::Metadata) -> Option<[u64; 2]> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        Some([found.dev(), found.ino()])
    }
    #[cfg(not(unix))]
    {
        let _ = found;
        None
    }
}

fn is_input(path: &Path) -> bool {
    let known = INPUTS.lock();
    let is_known = known.is_ok_and(|inputs| path.ancestors().take(2).any(|place| inputs.contains(place)));
    let file = fs::metadata(path).ok().as_ref().and_then(identity);
    let files = FILES.lock();
    is_known || file.is_some_and(|file| files.is_ok_and(|files| files.contains(&file)))
}

/// How a path is to be written.
enum Target {
    /// Beside this path, then renamed to it; links are already followed.
    Replace(PathBuf),
    /// A device or a pipe: renaming a file to it would destroy it.
    Direct(PathBuf),
}

/// Whether two paths are of one file, or would be: links and ways round are followed.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    let place = |path: &Path| {
        let there = path.canonicalize();
        there.or_else(|_| {
            Ok::<_, io::Error>(
                directory_of(path)
                    .canonicalize()?
                    .join(path.file_name().unwrap_or_default()),
            )
        })
    };
    a == b || matches!((place(a), place(b)), (Ok(a), Ok(b)) if a == b)
}

impl Output {
    /// The file, where it is one.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::Stdout => None,
            Self::File(path) | Self::Member(path) => Some(path),
        }
    }

    /// Looks whether the place can be written, so that no long computation is lost to a wrong path.
    pub fn check(&self) -> Result<(), OutputError> {
        match self {
            Self::Stdout => Ok(()),
            Self::File(path) => target(path).map(drop).map_err(|problem| self.error(problem)),
            Self::Member(path) => member(path).map(drop).map_err(|problem| self.error(problem)),
        }
    }

    /// Calls `print` with a buffered writer and brings what it wrote to the place. A file is written beside its
    /// path and renamed; on any error nothing of it remains, and what stood there before stands unharmed.
    ///
    /// Of a computation that was stopped before nothing is written; of one that is stopped meanwhile no file is made, and
    /// what is on stdout is as whole as `print` leaves it.
    pub fn write(&self, print: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), OutputError> {
        unless_stopped().map_err(|problem| self.error(problem))?;
        match self {
            Self::Stdout => write_stdout(print),
            // a file behind it has more in it than this
            Self::File(path) if path == Path::new("/dev/stdout") => match target(path) {
                Err(OutputProblem::Input) => Err(OutputProblem::Input),
                _ => write_stdout(print),
            },
            Self::File(path) => target(path).and_then(|target| target.write(print)),
            Self::Member(path) => member(path).and_then(|target| target.write(print)),
        }
        .map_err(|problem| self.error(problem))
    }

    fn error(&self, problem: OutputProblem) -> OutputError {
        let place = match self {
            Self::Stdout => "stdout".to_owned(),
            Self::File(path) | Self::Member(path) => path.display().to_string(),
        };
        OutputError { place, problem }
    }
}

pub(super) fn unless_stopped() -> Result<(), OutputProblem> {
    match Token::current().is_stopped() {
        true => Err(OutputProblem::Stopped),
        false => Ok(()),
    }
}

fn write_stdout(print: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), OutputProblem> {
    let mut writer = BufWriter::new(io::stdout().lock());
    let written = print(&mut writer).and_then(|()| writer.flush());
    // Without this, a dropped BufWriter would try once more to write what has just failed.
    drop(writer.into_parts());
    unless_broken_pipe(written).map_err(OutputProblem::system("writing"))
}

fn write_direct(path: &Path, print: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), OutputProblem> {
    let file = OpenOptions::new()
        .write(true)
        .open(path)
        .map_err(OutputProblem::system("opening"))?;
    let mut writer = BufWriter::new(file);
    let written = print(&mut writer).and_then(|()| writer.flush());
    drop(writer.into_parts());
    unless_broken_pipe(written).map_err(OutputProblem::system("writing"))
}

fn unless_broken_pipe(written: io::Result<()>) -> io::Result<()> {
    match written {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        other => other,
    }
}

impl Target {
    fn write(self, print: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), OutputProblem> {
        match self {
            Self::Replace(path) => replace(&path, print),
            Self::Direct(path) => write_direct(&path, print),
        }
    }
}

/// Refuses a symbolic link, a device and a pipe; returns true if there is a regular file.
fn is_regular(path: &Path) -> Result<bool, OutputProblem> {
    match fs::symlink_metadata(path) {
        Ok(found) if found.is_symlink() => {
            let to = fs::read_link(path).map(|to| to.display().to_string());
            Err(OutputProblem::Link(to.unwrap_or_default()))
        }
        Ok(found) if found.is_dir() => Err(OutputProblem::Directory),
        Ok(found) if !found.is_file() => Err(OutputProblem::NotRegular),
        Ok(_) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(OutputProblem::system("opening")(error)),
    }
}

/// Returns the target of a file whose name the program chose.
fn member(path: &Path) -> Result<Target, OutputProblem> {
    is_regular(path)?;
    target(path)
}

/// Opens a file whose name the program chose, for reading and writing, and locks it; makes it if it does not exist.
///
/// # Errors
/// A symbolic link or what is not a regular file, a file that another process has locked, and the errors of the system.
pub fn open_locked(path: &Path) -> Result<File, OutputError> {
    opened(path).map_err(|problem| Output::Member(path.to_owned()).error(problem))
}

fn opened(path: &Path) -> Result<File, OutputProblem> {
    let is_there = is_regular(path)?;
    let mut options = OpenOptions::new();
    // a new one is made only where nothing stands, so that nothing is followed
    let file = options.read(true).write(true).create_new(!is_there).open(path);
    let file = file.map_err(OutputProblem::system("opening"))?;
    match file.try_lock() {
        Ok(()) if is_at(&file, path) => Ok(file),
        // replaced, or removed by the run that had it, since it was looked at
        Ok(()) | Err(TryLockError::WouldBlock) => Err(OutputProblem::Busy),
        Err(TryLockError::Error(error)) => Err(OutputProblem::system("locking")(error)),
    }
}

/// Returns true if a path leads, without a link at its end, to an opened file, as far as the system tells.
pub(super) fn is_at(file: &File, path: &Path) -> bool {
    let identities = |(own, there): (fs::Metadata, fs::Metadata)| identity(&own) == identity(&there);
    let found = file.metadata().and_then(|own| Ok((own, fs::symlink_metadata(path)?)));
    found.is_ok_and(identities)
}

fn target(path: &Path) -> Result<Target, OutputProblem> {
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(OutputProblem::Directory),
        Ok(found) if !found.is_file() => Ok(Target::Direct(path.to_owned())),
        Ok(found) if found.permissions().readonly() => Err(OutputProblem::ReadOnly),
        // A link keeps being a link: what it points to is replaced.
        Ok(_) => match path.canonicalize() {
            Ok(path) if is_input(&path) => Err(OutputProblem::Input),
            Ok(path) => Ok(Target::Replace(path)),
            Err(error) => Err(OutputProblem::system("following links")(error)),
        },
        Err(error) if error.kind() == io::ErrorKind::NotFound => match fs::read_link(path) {
            Ok(to) => Err(OutputProblem::Dangling(to.display().to_string())),
            Err(_) => new_file(path),
        },
        Err(source) => Err(OutputProblem::System {
            doing: "opening",
            source,
        }),
    }
}

/// A path where nothing stands yet: its directory must.
fn new_file(path: &Path) -> Result<Target, OutputProblem> {
    let ends_as_directory = path.as_os_str().to_string_lossy().ends_with(std::path::MAIN_SEPARATOR);
    if path.file_name().is_none() || ends_as_directory {
        return Err(OutputProblem::Directory);
    }
    match directory_of(path) {
        directory if directory.is_dir() => Ok(Target::Replace(path.to_owned())),
        directory => Err(OutputProblem::NoDirectory(directory.display().to_string())),
    }
}

pub(super) fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

fn replace(path: &Path, print: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), OutputProblem> {
    let before = fs::metadata(path).ok().map(|before| before.permissions());
    let (temporary, file) =
        create_beside(path, before.is_some()).map_err(OutputProblem::system("creating a temporary file beside it"))?;
    // Removes the temporary on every way out but success, a panic in `print` included.
    let mut guard = Temporary::new(temporary);
    let mut writer = BufWriter::new(file);
    let written = print(&mut writer).and_then(|()| writer.flush());
    let (file, _) = writer.into_parts();
    written
        .and_then(|()| file.sync_all())
        .map_err(OutputProblem::system("writing"))?;
    unless_stopped()?;
    if let Some(before) = before {
        file.set_permissions(before)
            .map_err(OutputProblem::system("keeping its permissions"))?;
    }
    drop(file);
    // an end by a signal waits here, or comes before and has removed it
    let _temporaries = TEMPORARIES.lock();
    fs::rename(&guard.path, path).map_err(OutputProblem::system("renaming the temporary file"))?;
    guard.keep();
    Ok(())
}

/// A new file beside `path`, hidden, under a name that nothing has yet.
///
/// Where it will replace a file nobody else may read it: that one's permissions may be as narrow.
fn create_beside(path: &Path, replaces: bool) -> io::Result<(PathBuf, File)> {
    const ATTEMPTS: u32 = 100;
    let mut last = io::Error::from(io::ErrorKind::AlreadyExists);
    for attempt in 0..ATTEMPTS {
        let beside = directory_of(path).join(temporary_name(path, attempt));
        let mut options = OpenOptions::new();
        options.write(true).create_new(true);
        #[cfg(unix)]
        if replaces {
            std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        }
        #[cfg(not(unix))]
        let _ = replaces;
        // a signal that comes now waits until the file is in the list
        let mut temporaries = TEMPORARIES.lock().map_err(|_| io::Error::other("stopped"))?;
        match options.open(&beside) {
            Ok(file) => {
                temporaries.insert(beside.clone());
                return Ok((beside, file));
            }
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => last = error,
            Err(error) => return Err(error),
        }
    }
    Err(last)
}

/// A hidden name for what becomes the file or directory at a path.
pub(super) fn temporary_name(path: &Path, attempt: u32) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    // A long name with something added might pass the limit of the file system.
    let name: String = name.chars().take(40).collect();
    format!(".{name}.{}-{attempt}.tmp", std::process::id())
}

/// The temporary files and directories that there are now.
pub(super) static TEMPORARIES: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Removes what is half written, for a program that is about to end: from now on no file is finished.
pub fn remove_temporaries() {
    if let Ok(temporaries) = TEMPORARIES.lock() {
        for path in temporaries.iter() {
            remove(path);
        }
        // nobody may finish one any more
        std::mem::forget(temporaries);
    }
}

/// A temporary file or directory, removed unless it is kept.
pub(super) struct Temporary {
    path: PathBuf,
    keep: bool,
}

impl Temporary {
    pub(super) fn new(path: PathBuf) -> Self {
        Self { path, keep: false }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Keeps it: it has another name by now.
    pub(super) fn keep(&mut self) {
        self.keep = true;
    }
}

/// Removes a temporary file or directory. Nothing is to be done where even this fails; the error that led here is reported.
fn remove(path: &Path) {
    let _ = match path.is_dir() {
        true => fs::remove_dir_all(path),
        false => fs::remove_file(path),
    };
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Ok(mut temporaries) = TEMPORARIES.lock() {
            temporaries.remove(&self.path);
        }
        if !self.keep {
            remove(&self.path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An empty directory of its own for each test, removed at its end.
    struct Scratch(PathBuf);

    impl Scratch {
        fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("vibro-audit-output-{}-{name}", std::process::id()));
            fs::create_dir_all(&path).unwrap();
            Self(path)
        }

        fn names(&self) -> Vec<String> {
            let entries = fs::read_dir(&self.0).unwrap();
            entries
                .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
                .collect()
        }
    }

    impl Drop for Scratch {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    fn write(path: &Path, text: &str) -> Result<(), OutputError> {
        Output::File(path.to_owned()).write(|to| to.write_all(text.as_bytes()))
    }

    #[test]
    fn a_file_is_written_whole_and_replaced_whole() {
        let scratch = Scratch::new("whole");
        let path = scratch.0.join("table.csv");
        write(&path, "one").unwrap();
        write(&path, "two").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "two");
        assert_eq!(scratch.names(), ["table.csv"]);
    }

    #[test]
    fn an_error_midway_leaves_the_old_file_and_no_temporary() {
        let scratch = Scratch::new("midway");
        let path = scratch.0.join("table.csv");
        write(&path, "old").unwrap();
        let error = Output::File(path.clone())
            .write(|to| {
                to.write_all(&[b'x'; 100_000])?;
                Err(io::Error::from(io::ErrorKind::StorageFull))
            })
            .unwrap_err();
        assert!(error.to_string().contains("table.csv: writing: "), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(scratch.names(), ["table.csv"]);
    }

    #[test]
    fn a_directory_is_refused_and_a_missing_one_is_named() {
        let scratch = Scratch::new("directory");
        let onto = Output::File(scratch.0.clone()).check().unwrap_err();
        assert!(matches!(onto.problem, OutputProblem::Directory), "{onto}");
        let into = Output::File(scratch.0.join("none/table.csv")).check().unwrap_err();
        assert!(into.to_string().contains("there is no directory"), "{into}");
        let slash = Output::File(scratch.0.join("new/")).check().unwrap_err();
        assert!(matches!(slash.problem, OutputProblem::Directory), "{slash}");
        assert!(scratch.names().is_empty());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link_and_a_device_a_device() {
        let scratch = Scratch::new("link");
        let (file, link) = (scratch.0.join("file"), scratch.0.join("link"));
        write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write(&link, "new").unwrap();
        assert!(link.is_symlink());
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
        write(Path::new("/dev/null"), "nothing").unwrap();
        assert!(!Path::new("/dev/null").is_file());
    }

    #[cfg(unix)]
    #[test]
    fn a_read_only_file_is_left_alone() {
        let scratch = Scratch::new("protected");
        let path = scratch.0.join("golden.csv");
        write(&path, "golden").unwrap();
        let mut permissions = fs::metadata(&path).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&path, permissions).unwrap();
        let error = write(&path, "new").unwrap_err();
        assert!(matches!(error.problem, OutputProblem::ReadOnly), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "golden");
    }
}
