//! A lock on a directory, for a command that reads files of it and writes them anew.

use super::output::{OutputError, OutputProblem, is_at};
use crate::stop::Token;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

/// The time that a command waits for another one that writes the directory.
const PATIENCE: Duration = Duration::from_secs(600);

/// The time between two attempts.
const PAUSE: Duration = Duration::from_millis(20);

/// The time after which a user is told what is waited for.
const SILENCE: Duration = Duration::from_secs(1);

/// An exclusive lock on a directory. The system ends it with the process, so that none is left behind.
#[derive(Debug)]
pub struct DirectoryLock {
    /// The directories that were made for it, the outermost first.
    made: Vec<PathBuf>,
    _file: File,
}

impl DirectoryLock {
    /// Makes the directory if there is none, and locks it. While another process has locked it, waits up to ten minutes;
    /// `tell` is called once if that takes more than a second. Directories that were made are removed when the lock is
    /// dropped, unless there is something in them.
    ///
    /// # Errors
    /// A directory that cannot be made or locked, one that stays locked, and a run that was stopped while it waited.
    pub fn acquire(directory: &Path, tell: impl FnOnce()) -> Result<Self, OutputError> {
        locked(directory, tell).map_err(|problem| {
            let place = directory.display().to_string();
            OutputError { place, problem }
        })
    }
}

impl Drop for DirectoryLock {
    fn drop(&mut self) {
        // one with something in it stays
        for directory in self.made.iter().rev() {
            let _ = fs::remove_dir(directory);
        }
    }
}

fn locked(directory: &Path, tell: impl FnOnce()) -> Result<DirectoryLock, OutputProblem> {
    let (started, token, mut tell) = (Instant::now(), Token::current(), Some(tell));
    loop {
        let missing = directory
            .ancestors()
            .take_while(|place| !place.as_os_str().is_empty() && !place.exists());
        let mut made: Vec<PathBuf> = missing.map(Path::to_owned).collect();
        made.reverse();
        fs::create_dir_all(directory).map_err(OutputProblem::system("creating the directory"))?;
        match opened(directory).map_err(OutputProblem::system("opening")) {
            Ok(file) => match file.try_lock() {
                Ok(()) if is_at(&file, &place(directory)) => return Ok(DirectoryLock { made, _file: file }),
                // removed by the run that had made it: begin anew
                Ok(()) | Err(TryLockError::WouldBlock) => {}
                Err(TryLockError::Error(error)) => return Err(OutputProblem::system("locking")(error)),
            },
            Err(_) if !directory.exists() => {}
            Err(problem) => return Err(problem),
        }
        if token.is_stopped() {
            return Err(OutputProblem::Stopped);
        }
        if started.elapsed() > PATIENCE {
            return Err(OutputProblem::Busy);
        }
        if started.elapsed() > SILENCE
            && let Some(tell) = tell.take()
        {
            tell();
        }
        thread::sleep(PAUSE);
    }
}

/// Returns the path of what is locked, without a link at its end.
#[cfg(unix)]
fn place(directory: &Path) -> PathBuf {
    directory.canonicalize().unwrap_or_else(|_| directory.to_owned())
}

#[cfg(unix)]
fn opened(directory: &Path) -> io::Result<File> {
    File::open(directory)
}

/// Where a directory cannot be locked, a file in it is, which stays.
#[cfg(not(unix))]
fn place(directory: &Path) -> PathBuf {
    directory.join(".lock")
}

#[cfg(not(unix))]
fn opened(directory: &Path) -> io::Result<File> {
    File::options()
        .write(true)
        .create(true)
        .truncate(false)
        .open(place(directory))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time_has_a_directory_and_one_made_for_nothing_is_gone() {
        let directory = std::env::temp_dir().join(format!("vibro-audit-lock-{}", std::process::id()));
        let inner = directory.join("a/b");
        let lock = DirectoryLock::acquire(&inner, || {}).unwrap();
        let other = File::open(&inner).unwrap();
        assert!(matches!(other.try_lock(), Err(TryLockError::WouldBlock)));
        let waiting = {
            let inner = inner.clone();
            thread::spawn(move || DirectoryLock::acquire(&inner, || {}).map(drop))
        };
        thread::sleep(5 * PAUSE);
        assert!(!waiting.is_finished());
        drop(lock);
        // the one that waited has made it anew, and removed it
        waiting.join().unwrap().unwrap();
        assert!(!directory.exists());
        let lock = DirectoryLock::acquire(&inner, || {}).unwrap();
        fs::write(inner.join("kept"), "").unwrap();
        drop(lock);
        assert!(inner.join("kept").exists());
        fs::remove_dir_all(&directory).unwrap();
    }
}
