//! Runs of the program `vibro-audit`, and the directories in which they write.

use std::ffi::OsStr;
use std::io::Write;
use std::ops::Deref;
use std::panic::Location;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// The path of the program.
pub const PATH: &str = env!("CARGO_BIN_EXE_vibro-audit");

/// A run to come: with nothing on standard input, in the root of the repository, unless said otherwise.
pub struct Program {
    command: Command,
    input: Option<String>,
}

/// The program with these arguments.
pub fn program<A: AsRef<OsStr>>(arguments: impl IntoIterator<Item = A>) -> Program {
    let mut command = Command::new(PATH);
    command
        .args(arguments)
        // the program says to `.ci/mutants` for which test it runs
        .env("RUNNING_TEST", std::thread::current().name().unwrap_or_default())
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdin(Stdio::null());
    Program { command, input: None }
}

/// Runs the program with these arguments.
pub fn run(arguments: &[&str]) -> Ran {
    program(arguments).run()
}

impl Program {
    /// With this text on standard input.
    pub fn input(mut self, text: impl Into<String>) -> Self {
        self.input = Some(text.into());
        self
    }

    /// In this directory.
    pub fn within(mut self, directory: impl AsRef<Path>) -> Self {
        self.command.current_dir(directory);
        self
    }

    /// On so many threads.
    pub fn threads(mut self, count: u32) -> Self {
        self.command.env("RAYON_NUM_THREADS", count.to_string());
        self
    }

    /// Runs it to its end.
    pub fn run(mut self) -> Ran {
        if self.input.is_some() {
            self.command.stdin(Stdio::piped());
        }
        self.command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = self.command.spawn().expect("the program");
        // written beside what is read: neither side waits for the other
        let writing = self.input.zip(child.stdin.take()).map(|(text, mut stdin)| {
            // a program that refuses its arguments does not read on
            std::thread::spawn(move || drop(stdin.write_all(text.as_bytes())))
        });
        let output = child.wait_with_output().expect("an end");
        if let Some(writing) = writing {
            writing.join().expect("all is written");
        }
        let text = |bytes| String::from_utf8(bytes).unwrap_or_else(|error| panic!("{:?}: {error}", self.command));
        Ran {
            status: output.status.code(),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
            command: format!("{:?}", self.command),
        }
    }

    /// Starts it, and leaves what it says unheard, for tests that stop it.
    pub fn spawn(mut self) -> Child {
        self.command.stdout(Stdio::null()).stderr(Stdio::null());
        self.command.spawn().expect("the program")
    }

    /// Returns the command, for tests that connect its input and output by themselves.
    pub fn command(self) -> Command {
        self.command
    }
}

/// The result of a run.
#[derive(Debug)]
pub struct Ran {
    /// The exit status; `None` where a signal ended the run.
    pub status: Option<i32>,
    pub stdout: String,
    pub stderr: String,
    command: String,
}

impl Ran {
    /// Returns what it printed; the status must be 0.
    #[track_caller]
    pub fn succeeded(self) -> String {
        let (command, message) = (self.command, self.stderr);
        assert_eq!(self.status, Some(0), "{command}: {message}\n{}", self.stdout);
        self.stdout
    }

    /// The message with which it refused: status 2, nothing on stdout, and these words on stderr.
    #[track_caller]
    pub fn refused(self, words: &[&str]) -> String {
        let (command, message) = (self.command, self.stderr);
        assert_eq!(self.status, Some(2), "{command}: {message}");
        assert!(self.stdout.is_empty(), "{command} printed on stdout: {}", self.stdout);
        assert!(!message.contains("panicked"), "{command}: {message}");
        for word in words {
            assert!(message.contains(word), "{command} does not say `{word}`: {message}");
        }
        message
    }
}

/// An empty directory of a test's own, removed when it goes out of scope.
pub struct Scratch(PathBuf);

/// An empty directory; the names need to differ within a file of tests alone.
#[track_caller]
pub fn scratch(name: &str) -> Scratch {
    let file = Location::caller()
        .file()
        .trim_start_matches("tests")
        .trim_end_matches(".rs");
    let file = file.replace(['/', '\\'], "-");
    let own = format!("{}-{name}-{}", file.trim_start_matches('-'), std::process::id());
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(own);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("a directory");
    Scratch(path)
}

impl Scratch {
    /// The path of what has this name in it.
    pub fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().expect("a path of UTF-8").to_owned()
    }

    /// Writes a file, and returns its path.
    pub fn file(&self, name: &str, text: impl AsRef<[u8]>) -> String {
        std::fs::write(self.0.join(name), text).expect("a file");
        self.path(name)
    }

    /// The text of a file.
    #[track_caller]
    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The names of what is in it, in order.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.0).expect("a directory");
        let mut names: Vec<String> = entries
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// Runs the program here with these arguments.
    pub fn run(&self, arguments: &[&str]) -> Ran {
        program(arguments).within(&self.0).run()
    }
}

impl Deref for Scratch {
    type Target = Path;

    fn deref(&self) -> &Path {
        &self.0
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
