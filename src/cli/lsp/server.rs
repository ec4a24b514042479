//! The protocol: documents that are open, and a thread that decides what they say in their last version.

use super::analysis::{Analysis, Read};
use super::lines::{Position, Range, position};
use super::memory::Memory;
use crate::claim;
use crate::cli::STACK;
use crate::cli::caller::during;
use crate::cli::jsonrpc::{
    CONTENT_MODIFIED, Error, Frame, INVALID_REQUEST, Message, NOT_INITIALIZED, Out, PARSE_ERROR, REQUEST_CANCELLED,
    failure, message, notification, success,
};
use crate::prove;
use crate::stop::Token;
use serde_json::{Value, json};
use std::collections::{HashMap, VecDeque};
use std::io::{BufRead, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Instant;

/// The longest message that is read, in bytes.
const LONGEST_MESSAGE: usize = 32 << 20;

/// The documents that may be open at once.
const MOST_DOCUMENTS: usize = 1000;

/// Serves until the client says `exit`, or the input ends; returns true if it was shut down before.
pub fn serve(input: &mut dyn BufRead, output: impl Write + Send + 'static) -> bool {
    let shared = Arc::new(Shared {
        out: Out::with_lengths(output),
        state: Mutex::default(),
        wake: Condvar::new(),
    });
    let worker = worker(Arc::clone(&shared));
    let mut server = Server {
        shared,
        stage: Stage::New,
    };
    // an input that cannot be read has ended
    while let Ok(Some(frame)) = message(input, LONGEST_MESSAGE) {
        let problem = match frame {
            Frame::Whole(bytes) => match serde_json::from_slice(&bytes) {
                Ok(value) => match server.take(value) {
                    true => continue,
                    false => break,
                },
                Err(problem) => Error::new(PARSE_ERROR, format!("the message is no JSON: {problem}")),
            },
            Frame::TooLong => Error::new(
                INVALID_REQUEST,
                format!("a message has at most {} MB", LONGEST_MESSAGE >> 20),
            ),
            Frame::NoLength => Error::new(PARSE_ERROR, "a message begins with the header `Content-Length: N`"),
        };
        server.shared.out.send(&failure(&Value::Null, &problem));
    }
    let mut state = server.shared.state();
    state.is_ending = true;
    state.documents.values().for_each(|document| document.token.stop());
    drop(state);
    server.shared.wake.notify_all();
    if let Some(worker) = worker {
        let _ = worker.join();
    }
    server.stage == Stage::ShutDown
}

/// A request that waits for the analysis of a version.
struct Waiting {
    id: Value,
    asked: Asked,
}

/// The question of a request about a document.
#[derive(Clone, Copy)]
enum Asked {
    Hover(Position),
    Actions(Range),
}

/// An open document.
struct Open {
    path: PathBuf,
    text: Arc<str>,
    version: i64,
    /// Stops the analysis of this version.
    token: Token,
    /// The analysis of this version, and whether it has the repairs.
    analysis: Option<(Analysis, bool)>,
    waiting: Vec<Waiting>,
    memory: Arc<Memory>,
}

/// State of the thread that reads and the thread that decides.
#[derive(Default)]
struct State {
    documents: HashMap<String, Open>,
    /// Documents whose last version is not looked at yet, the one that changed first in front.
    changed: VecDeque<String>,
    is_ending: bool,
    /// True if the client takes edits with the version of their document.
    has_versions: bool,
}

struct Shared {
    out: Out,
    state: Mutex<State>,
    wake: Condvar,
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn refuse(&self, waiting: Vec<Waiting>, code: i64, problem: &str) {
        for Waiting { id, .. } in waiting {
            self.out.send(&failure(&id, &Error::new(code, problem)));
        }
    }

    /// Publishes the analysis of a version, unless there is a later one, and answers what waits for it. Returns
    /// true if it was.
    fn publish(&self, job: &Job, analysis: Analysis, is_whole: bool) -> bool {
        let mut state = self.state();
        let has_versions = state.has_versions;
        let Some(document) = state.documents.get_mut(&job.uri) else {
            return false;
        };
        if document.version != job.version || job.token.is_stopped() {
            return false;
        }
        self.out.send(&notification(
            "textDocument/publishDiagnostics",
            json!({ "uri": job.uri, "version": job.version, "diagnostics": analysis.diagnostics() }),
        ));
        let is_ready = |own: &mut Waiting| is_whole || matches!(own.asked, Asked::Hover(_));
        let ready: Vec<Waiting> = document.waiting.extract_if(.., is_ready).collect();
        for Waiting { id, asked } in ready {
            let answer = match asked {
                Asked::Hover(at) => analysis.hover(at),
                Asked::Actions(range) => analysis.actions(range, &job.uri, job.version, has_versions),
            };
            self.out.send(&success(&id, answer));
        }
        document.analysis = Some((analysis, is_whole));
        true
    }
}

/// A version of a document that is to be analysed.
struct Job {
    uri: String,
    path: PathBuf,
    text: Arc<str>,
    version: i64,
    token: Token,
    memory: Arc<Memory>,
}

/// Starts the thread that analyses documents, the last version of each.
fn worker(shared: Arc<Shared>) -> Option<JoinHandle<()>> {
    let thread = thread::Builder::new().name("analysis".to_owned()).stack_size(STACK);
    let work = move || {
        while let Some(job) = next(&shared) {
            let run = || job.token.during(|| analyse(&shared, &job));
            // a panic is a fault of ours, which ends no server
            if catch_unwind(AssertUnwindSafe(|| during(None, run))).is_err() {
                let text = "an analysis ended in a panic: this is a fault of vibro-audit, please report it";
                log(&shared, 1, text);
                shared.publish(&job, Analysis::default(), true);
            }
        }
    };
    thread.spawn(work).ok()
}

/// Waits for a document that has changed; `None` at the end.
fn next(shared: &Shared) -> Option<Job> {
    let mut state = shared.state();
    loop {
        if state.is_ending {
            return None;
        }
        while let Some(uri) = state.changed.pop_front() {
            if let Some(document) = state.documents.get(&uri) {
                return Some(Job {
                    path: document.path.clone(),
                    text: Arc::clone(&document.text),
                    version: document.version,
                    token: document.token.clone(),
                    memory: Arc::clone(&document.memory),
                    uri,
                });
            }
        }
        state = shared.wake.wait(state).unwrap_or_else(PoisonError::into_inner);
    }
}

fn log(shared: &Shared, kind: u8, text: &str) {
    let params = json!({ "type": kind, "message": text });
    shared.out.send(&notification("window/logMessage", params));
}

/// Analyses a version: the verdicts first, then the repairs of what is refuted.
fn analyse(shared: &Shared, job: &Job) {
    let (start, options) = (Instant::now(), prove::Options::default());
    let read = claim::vocabulary()
        .map_err(|fault| fault.to_string())
        .and_then(|symbols| Read::new(&job.path, &job.text, &symbols, &options).map_err(|failure| failure.to_string()));
    let read = match read {
        Ok(Some(read)) => read,
        Ok(None) => {
            shared.publish(job, Analysis::default(), true);
            return;
        }
        Err(problem) => {
            log(shared, 2, &problem);
            shared.publish(job, Analysis::default(), true);
            return;
        }
    };
    let reading = start.elapsed();
    let (analysis, anew, lacks_repairs) = read.decide(&job.text, &job.memory, &options, false);
    let is_current = shared.publish(job, analysis, !lacks_repairs);
    if is_current {
        let text = format!(
            "version {}: {anew} formulas decided anew in {} ms, of which {} ms to read the text",
            job.version,
            start.elapsed().as_millis(),
            reading.as_millis(),
        );
        log(shared, 4, &text);
    }
    if is_current && lacks_repairs {
        let (analysis, ..) = read.decide(&job.text, &job.memory, &options, true);
        shared.publish(job, analysis, true);
    }
}

/// The stage of the handshake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    New,
    Running,
    ShutDown,
}

/// The thread that reads.
struct Server {
    shared: Arc<Shared>,
    stage: Stage,
}

/// Returns a text of the parameters by its path.
fn text<'v>(params: &'v Value, path: &str) -> Result<&'v str, Error> {
    let found = params.pointer(path).and_then(Value::as_str);
    found.ok_or_else(|| {
        Error::params(format!(
            "`{}` should be a string",
            path.trim_start_matches('/').replace('/', ".")
        ))
    })
}

impl Server {
    /// Takes a message. Returns false at the last one.
    fn take(&mut self, value: Value) -> bool {
        match Message::read(value) {
            Ok(Message::Request { id, method, params }) => {
                let response = match self.request(&id, &method, &params) {
                    Ok(Some(result)) => success(&id, result),
                    Ok(None) => return true,
                    Err(error) => failure(&id, &error),
                };
                self.shared.out.send(&response);
            }
            Ok(Message::Notification { method, .. }) if method == "exit" => return false,
            // what is wrong with a notification has no answer
            Ok(Message::Notification { method, params }) => {
                if let Err(error) = self.notified(&method, params) {
                    log(&self.shared, 2, &format!("{method}: {}", error.message));
                }
            }
            Ok(Message::Response) => {}
            Err(response) => self.shared.out.send(&response),
        }
        true
    }

    /// Answers a request; `None` where the answer follows later.
    fn request(&mut self, id: &Value, method: &str, params: &Value) -> Result<Option<Value>, Error> {
        match (self.stage, method) {
            (Stage::New, "initialize") => {
                self.stage = Stage::Running;
                let path = "/capabilities/workspace/workspaceEdit/documentChanges";
                self.shared.state().has_versions = params.pointer(path) == Some(&Value::Bool(true));
                Ok(Some(capabilities()))
            }
            (Stage::New, _) => Err(Error::new(NOT_INITIALIZED, "`initialize` comes first")),
            (Stage::ShutDown, _) => Err(Error::new(INVALID_REQUEST, "the server is shut down")),
            (Stage::Running, "initialize") => Err(Error::new(INVALID_REQUEST, "`initialize` is sent once")),
            (Stage::Running, "shutdown") => {
                self.stage = Stage::ShutDown;
                Ok(Some(Value::Null))
            }
            (Stage::Running, "textDocument/hover") => {
                let at = params.get("position").and_then(position);
                let at = at.ok_or_else(|| Error::params("`position` should have `line` and `character`"))?;
                self.ask(id, params, Asked::Hover(at))
            }
            (Stage::Running, "textDocument/codeAction") => {
                let range = params.get("range").and_then(Range::read);
                let range = range.ok_or_else(|| Error::params("`range` should have `start` and `end`"))?;
                self.ask(id, params, Asked::Actions(range))
            }
            (Stage::Running, method) => Err(Error::method(method)),
        }
    }

    /// Answers from the analysis of the last version, or lets the request wait for it.
    fn ask(&self, id: &Value, params: &Value, asked: Asked) -> Result<Option<Value>, Error> {
        let uri = text(params, "/textDocument/uri")?;
        let mut state = self.shared.state();
        let has_versions = state.has_versions;
        let Some(document) = state.documents.get_mut(uri) else {
            return Err(Error::params(format!("the document {uri} is not open")));
        };
        Ok(match (&document.analysis, asked) {
            (Some((analysis, _)), Asked::Hover(at)) => Some(analysis.hover(at)),
            (Some((analysis, true)), Asked::Actions(range)) => {
                Some(analysis.actions(range, uri, document.version, has_versions))
            }
            _ => {
                let id = id.clone();
                document.waiting.push(Waiting { id, asked });
                None
            }
        })
    }

    fn notified(&mut self, method: &str, mut params: Value) -> Result<(), Error> {
        if self.stage != Stage::Running {
            return Ok(());
        }
        let version = params
            .pointer("/textDocument/version")
            .and_then(Value::as_i64)
            .unwrap_or_default();
        match method {
            "textDocument/didOpen" => {
                let uri = text(&params, "/textDocument/uri")?.to_owned();
                let language = text(&params, "/textDocument/languageId").unwrap_or_default();
                let path = path_of(&uri, language);
                let text = text(&params, "/textDocument/text")?.to_owned();
                self.set(uri, Some(path), version, text)
            }
            "textDocument/didChange" => {
                let uri = text(&params, "/textDocument/uri")?.to_owned();
                // the last one has the whole text, as the server asked for
                let changes = params.get_mut("contentChanges").and_then(Value::as_array_mut);
                let text = changes.and_then(Vec::pop).map(|mut change| change["text"].take());
                match text {
                    Some(Value::String(text)) => self.set(uri, None, version, text),
                    _ => Err(Error::params("`contentChanges` should have the whole text")),
                }
            }
            // what a document includes may have changed
            "textDocument/didSave" | "workspace/didChangeWatchedFiles" => {
                let state = self.shared.state();
                let open = state.documents.iter();
                let open = open.map(|(uri, document)| (uri.clone(), document.version, document.text.to_string()));
                let open: Vec<_> = open.collect();
                drop(state);
                open.into_iter()
                    .try_for_each(|(uri, version, text)| self.set(uri, None, version, text))
            }
            "textDocument/didClose" => {
                let uri = text(&params, "/textDocument/uri")?;
                let mut state = self.shared.state();
                if let Some(document) = state.documents.remove(uri) {
                    document.token.stop();
                    self.shared
                        .refuse(document.waiting, CONTENT_MODIFIED, "the document is closed");
                    let params = json!({ "uri": uri, "diagnostics": [] });
                    self.shared
                        .out
                        .send(&notification("textDocument/publishDiagnostics", params));
                }
                Ok(())
            }
            "$/cancelRequest" => {
                let mut state = self.shared.state();
                let waiting = state.documents.values_mut().map(|document| &mut document.waiting);
                let is_it = |own: &mut Waiting| Some(&own.id) == params.get("id");
                let cancelled = waiting.flat_map(|waiting| waiting.extract_if(.., is_it)).collect();
                self.shared.refuse(cancelled, REQUEST_CANCELLED, "cancelled");
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Sets the text of a document, which is open already where no path is given.
    fn set(&self, uri: String, path: Option<PathBuf>, version: i64, text: String) -> Result<(), Error> {
        let mut state = self.shared.state();
        let known = state.documents.remove(&uri);
        let (path, memory) = match (path, &known) {
            (_, Some(open)) => (open.path.clone(), Arc::clone(&open.memory)),
            (Some(path), None) => (path, Arc::default()),
            (None, None) => return Err(Error::params(format!("the document {uri} is not open"))),
        };
        if let Some(open) = known {
            open.token.stop();
            self.shared
                .refuse(open.waiting, CONTENT_MODIFIED, "the text has changed");
        } else if state.documents.len() >= MOST_DOCUMENTS {
            return Err(Error::params(format!("{MOST_DOCUMENTS} documents are open already")));
        }
        let open = Open {
            path,
            text: text.into(),
            version,
            token: Token::new(),
            analysis: None,
            waiting: Vec::new(),
            memory,
        };
        state.documents.insert(uri.clone(), open);
        if !state.changed.contains(&uri) {
            state.changed.push_back(uri);
        }
        self.shared.wake.notify_all();
        Ok(())
    }
}

fn capabilities() -> Value {
    json!({
        "capabilities": {
            "positionEncoding": "utf-16",
            "textDocumentSync": { "openClose": true, "change": 1, "save": true },
            "hoverProvider": true,
            "codeActionProvider": { "codeActionKinds": ["quickfix"] },
        },
        "serverInfo": { "name": env!("CARGO_PKG_NAME"), "version": env!("CARGO_PKG_VERSION") },
    })
}

/// Returns the path of the file that a URI names; of a text that is not saved yet, a name with the ending of
/// its language.
fn path_of(uri: &str, language: &str) -> PathBuf {
    let ending = match language {
        "latex" | "tex" | "plaintex" | "context" => "tex",
        "markdown" | "quarto" | "rmd" => "md",
        "toml" => "toml",
        _ => "",
    };
    let Some(rest) = uri.strip_prefix("file://") else {
        return PathBuf::from(format!("untitled.{ending}"));
    };
    // behind the name of a host
    let path = rest.find('/').map_or("", |start| rest.get(start..).unwrap_or_default());
    let path = decoded(path);
    // file:///c:/a.tex
    let bytes = path.as_bytes();
    let has_drive = bytes.get(1).is_some_and(u8::is_ascii_alphabetic) && bytes.get(2) == Some(&b':');
    PathBuf::from(if has_drive { path.trim_start_matches('/') } else { &path })
}

/// Undoes the escapes of a URI.
fn decoded(text: &str) -> String {
    let hex = |byte: Option<&u8>| {
        char::from(*byte?)
            .to_digit(16)
            .and_then(|digit| u8::try_from(digit).ok())
    };
    let (mut bytes, mut rest) = (Vec::new(), text.as_bytes());
    while let Some((&first, behind)) = rest.split_first() {
        let escaped = hex(behind.first()).zip(hex(behind.get(1))).filter(|_| first == b'%');
        bytes.push(escaped.map_or(first, |(high, low)| 16 * high + low));
        rest = behind
            .get(if escaped.is_some() { 2.. } else { 0.. })
            .unwrap_or_default();
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_uri_names_a_path() {
        for (uri, language, path) in [
            ("file:///home/a/my%20paper.tex", "latex", "/home/a/my paper.tex"),
            ("file:///c%3A/a.md", "markdown", "c:/a.md"),
            ("file://localhost/a/%C3%A4.tex", "", "/a/\u{e4}.tex"),
            ("untitled:Untitled-1", "latex", "untitled.tex"),
            ("file:///a%2", "", "/a%2"),
        ] {
            assert_eq!(path_of(uri, language), PathBuf::from(path), "{uri}");
        }
    }
}
