//! Somebody's own program, run over the problems.

use std::io::{Read, Write};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};
use stop;

/// A command line for `sh -c`.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// The command line; `{tolerance}` in it stands for the tolerance.
    pub command: String,
    /// How long it may run, s.
    pub limit: f64,
}

/// What a program wrote, and how long it ran.
#[derive(Clone, Debug, PartialEq)]
pub struct Ran {
    /// All of its stdout.
    pub stdout: String,
    /// Wall time from its start to its end, s.
    pub seconds: f64,
}

/// A program that did not answer.
#[derive(Debug, thiserror::Error)]
pub enum ProgramError {
    /// There is no shell, or no process.
    #[error("cannot run `{command}`: {error}")]
    Start {
        /// The command line.
        command: String,
        /// What the system says.
        error: std::io::Error,
    },
    /// It took too long.
    #[error("`{command}` still ran after {limit} s and was ended; give it more by --limit{stderr}")]
    Limit {
        /// The command line.
        command: String,
        /// The limit, s.
        limit: f64,
        /// The last it said, each line after a line break.
        stderr: String,
    },
    /// It says itself that it failed.
    #[error("`{command}` ended with {status}{stderr}")]
    Failed {
        /// The command line.
        command: String,
        /// How it ended.
        status: ExitStatus,
        /// The last it said, each line after a line break.
        stderr: String,
    },
    /// It wrote more than answers.
    #[error("`{command}` wrote more than {MOST} bytes; answers take some ten thousand")]
    Long {
        /// The command line.
        command: String,
    },
    /// It wrote no text.
    #[error("what `{command}` wrote is not UTF-8 from byte {at} on")]
    NotText {
        /// The command line.
        command: String,
        /// The first byte that is none.
        at: usize,
    },
}

/// The environment variable that holds the tolerance.
pub const VARIABLE: &str = "VIBRO_TOLERANCE";

/// The bytes of an answer, at most.
const MOST: usize = 64 << 20;

/// The lines of stderr that an error repeats.
const LINES: usize = 5;

impl Program {
    /// Runs the program at a tolerance, which it finds in `VIBRO_TOLERANCE`; `stdin` is all it reads.
    ///
    /// # Errors
    /// It cannot be started, does not end in time, fails, or writes no text or without end.
    pub fn run(&self, tolerance: &str, stdin: &str) -> Result<Ran, ProgramError> {
        let command = self.command.replace("{tolerance}", tolerance);
        let start = Instant::now();
        let error = |error| ProgramError::Start {
            command: command.clone(),
            error,
        };
        let mark = mark();
        let mut child = spawn(&command, tolerance, &mark).map_err(error)?;
        let id = child.id();
        feed(&mut child, stdin);
        let stdout = child.stdout.take().map(|stdout| gather(stdout, MOST + 1));
        let stderr = child.stderr.take().map(|stderr| gather(stderr, MOST));
        let ended = aside(move || (child.wait(), Instant::now()));

        let limit = Duration::try_from_secs_f64(self.limit).unwrap_or(Duration::MAX);
        let left = || limit.saturating_sub(start.elapsed());
        let wait = |from: &Option<Receiver<Vec<u8>>>| {
            let none = || Ok(Vec::new());
            from.as_ref().map_or_else(none, |from| received(from, left()))
        };
        let whole = received(&ended, limit).and_then(|end| Ok((end, wait(&stdout)?, wait(&stderr)?)));
        // whatever it has started ends with it
        kill(id, &mark);
        let Ok(((status, end), stdout, stderr_text)) = whole else {
            let said = stderr.and_then(|from| from.recv_timeout(Duration::from_secs(1)).ok());
            let (limit, stderr) = (self.limit, last_lines(&said.unwrap_or_default()));
            return Err(ProgramError::Limit { command, limit, stderr });
        };
        // before the status: a program of which no more is read may die of that
        if stdout.len() > MOST {
            return Err(ProgramError::Long { command });
        }
        let status = status.map_err(error)?;
        if !status.success() {
            let stderr = last_lines(&stderr_text);
            return Err(ProgramError::Failed {
                command,
                status,
                stderr,
            });
        }
        let seconds = (end - start).as_secs_f64();
        match String::from_utf8(stdout) {
            Ok(stdout) => Ok(Ran { stdout, seconds }),
            Err(error) => {
                let at = error.utf8_error().valid_up_to();
                Err(ProgramError::NotText { command, at })
            }
        }
    }
}

/// The environment variable by which a program, and all that it has started, is known.
const MARK: &str = "VIBRO_AUDIT_RUN";

/// Ends every process with the mark `$2`, those in groups of their own as well, and the group of `$1`; twice, for one that
/// was just being started.
const END: &str = "end() { for n in 1 2; do for p in $(grep -lzxs \"$2\" /proc/[0-9]*/environ); do \
                   p=${p#/proc/}; kill -s KILL ${p%/environ}; done; done; kill -s KILL -- -$1; }";

/// Runs `$1`, in a group of its own so that all it starts can be ended with it. An interrupt from the keyboard does not
/// reach that group: something in it looks whether `$2`, this process, is still there, and ends all with the mark `$3`
/// where not.
const SHELL: &str = "(trap '' HUP; while kill -0 $2; do sleep 1; done; end $$ $3) </dev/null >/dev/null 2>&1 & \
                     export \"$3\"; exec sh -c \"$1\"";

/// A mark that no other run has.
fn mark() -> String {
    static RUNS: AtomicU64 = AtomicU64::new(0);
    let run = RUNS.fetch_add(1, Ordering::Relaxed);
    format!("{MARK}={}-{run}", std::process::id())
}

fn spawn(command: &str, tolerance: &str, mark: &str) -> std::io::Result<Child> {
    let mut shell = Command::new("sh");
    let own = std::process::id().to_string();
    let script = format!("{END}\n{SHELL}");
    shell
        .args(["-c", &script, "sh", command, &own, mark])
        .env(VARIABLE, tolerance);
    shell
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut shell, 0);
    shell.spawn()
}

/// Ends the group that a shell of this id leads, and whatever has its mark.
fn kill(id: u32, mark: &str) {
    let mut kill = Command::new("sh");
    kill.args(["-c", &format!("{END}\nend {id} '{mark}'")]);
    // where the group has ended in this moment there is nothing to end
    let _ = kill.stdout(Stdio::null()).stderr(Stdio::null()).status();
}

/// What comes within a time, unless the computation is stopped.
fn received<T>(from: &Receiver<T>, limit: Duration) -> Result<T, RecvTimeoutError> {
    let end = Instant::now().checked_add(limit);
    loop {
        let left = end.map_or(PAUSE, |end| end.saturating_duration_since(Instant::now()));
        match from.recv_timeout(left.min(PAUSE)) {
            Err(RecvTimeoutError::Timeout) if left > PAUSE && stop::goes_on() => {}
            other => return other,
        }
    }
}

/// Between two looks whether to go on.
const PAUSE: Duration = Duration::from_millis(50);

/// What `work` comes to, done beside.
fn aside<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Receiver<T> {
    let (send, receive) = mpsc::channel();
    thread::spawn(move || {
        // nobody listens any more where the time was up
        let _ = send.send(work());
    });
    receive
}

/// Writes all of its input, beside: it may answer before it has read everything, or read nothing at all.
fn feed(child: &mut Child, text: &str) {
    if let Some(mut stdin) = child.stdin.take() {
        let text = text.to_owned();
        // one that does not read its input closes the pipe: its choice
        aside(move || stdin.write_all(text.as_bytes()).is_ok());
    }
}

/// Reads up to so many bytes, beside.
fn gather(from: impl Read + Send + 'static, most: usize) -> Receiver<Vec<u8>> {
    aside(move || {
        let mut bytes = Vec::new();
        // what was read before a failure is still worth telling
        let _ = from.take(most as u64).read_to_end(&mut bytes);
        bytes
    })
}

/// The last lines, each after a line break.
fn last_lines(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
    let from = lines.len().saturating_sub(LINES);
    lines[from..].iter().map(|line| format!("\n  {line}")).collect()
}

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use super::*;

    fn run(command: &str, limit: f64) -> Result<Ran, ProgramError> {
        let command = command.to_owned();
        Program { command, limit }.run("1e-6", "one\ntwo\n")
    }

    #[test]
    fn it_reads_the_problems_and_knows_the_tolerance() {
        let ran = run("cat; echo $VIBRO_TOLERANCE {tolerance}", 20.0).unwrap();
        assert_eq!(ran.stdout, "one\ntwo\n1e-6 1e-6\n");
        assert!(ran.seconds > 0.0 && ran.seconds < 20.0);
    }

    #[test]
    fn a_failure_is_told_with_the_last_it_said() {
        let error = run("for i in 1 2 3 4 5 6 7; do echo line $i >&2; done; exit 3", 20.0)
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("exit status: 3") && error.ends_with("line 6\n  line 7"),
            "{error}"
        );
        assert!(!error.contains("line 2"), "{error}");
        let error = run("no-such-program-at-all", 20.0).unwrap_err().to_string();
        assert!(error.contains("127") && error.contains("not found"), "{error}");
    }

    #[test]
    fn one_that_does_not_end_is_ended_with_all_it_started() {
        let start = Instant::now();
        let error = run("echo so far >&2; sleep 60 | sleep 60", 0.3)
            .unwrap_err()
            .to_string();
        assert!(error.contains("after 0.3 s") && error.contains("so far"), "{error}");
        assert!(start.elapsed().as_secs_f64() < 20.0);
    }

    #[test]
    fn what_it_leaves_behind_counts_while_it_may_still_write() {
        assert_eq!(
            run("echo done; sleep 2 > /dev/null 2>&1 &", 20.0).unwrap().stdout,
            "done\n"
        );
        let error = run("echo done; sleep 60 &", 0.3).unwrap_err().to_string();
        assert!(error.contains("after 0.3 s"), "{error}");
    }

    #[test]
    fn one_that_reads_nothing_and_one_that_writes_no_text_are_told_apart() {
        let long = "x".repeat(1 << 20);
        let ran = Program {
            command: "true".to_owned(),
            limit: 20.0,
        }
        .run("1", &long)
        .unwrap();
        assert_eq!(ran.stdout, "");
        let error = run("printf 'ab\\377'", 20.0).unwrap_err().to_string();
        assert!(error.contains("not UTF-8 from byte 2"), "{error}");
    }

    /// Whether a process with these arguments is there.
    fn is_running(arguments: &str) -> bool {
        let wanted = arguments.split(' ').flat_map(|word| [word, "\0"]).collect::<String>();
        let mut processes = std::fs::read_dir("/proc").unwrap().flatten();
        processes
            .any(|process| std::fs::read(process.path().join("cmdline")).is_ok_and(|line| line == wanted.as_bytes()))
    }

    #[test]
    fn what_has_a_group_of_its_own_ends_with_it_too() {
        for (command, limit) in [
            ("setsid sleep 98761 & exit 0", 3.0),
            ("setsid sleep 98762 & sleep 98763", 0.5),
        ] {
            let _ = run(command, limit);
            std::thread::sleep(Duration::from_millis(200));
        }
        assert!(
            !["sleep 98761", "sleep 98762", "sleep 98763"]
                .into_iter()
                .any(is_running)
        );
    }

    #[test]
    fn a_program_is_ended_where_the_computation_is_stopped() {
        let token = stop::Token::new();
        let other = token.clone();
        std::thread::spawn(move || {
            std::thread::sleep(Duration::from_millis(300));
            other.stop();
        });
        let start = Instant::now();
        let ended = token.during(|| run("sleep 98764", 60.0));
        assert!(ended.is_err() && start.elapsed() < Duration::from_secs(10));
        assert!(!is_running("sleep 98764"));
    }
}
