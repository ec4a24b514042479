//! The protocol: the handshake, calls on a thread of their own, progress and cancelling.

use super::guide::{INSTRUCTIONS, RESOURCES};
use super::tools::{self, Call};
use crate::cli::STACK;
use crate::cli::jsonrpc::{
    Error, Frame, INVALID_REQUEST, Message, Out, PARSE_ERROR, SERVER_BUSY, failure, line, notification, success,
};
use crate::cli::progress::Watch;
use crate::stop::Token;
use serde_json::{Value, json};
use std::collections::HashMap;
use std::io::{BufRead, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// The versions of the protocol that are spoken, the newest first.
const VERSIONS: [&str; 3] = ["2025-06-18", "2025-03-26", "2024-11-05"];

/// The version with batches: several messages in one array.
const WITH_BATCHES: &str = "2025-03-26";

/// The longest line that is read, in bytes.
const LONGEST_LINE: usize = 32 << 20;

/// The calls that may wait for the one that runs.
const MOST_CALLS: usize = 16;

/// The time between two notifications of progress.
const PAUSE: Duration = Duration::from_millis(100);

/// The code of the protocol for a resource that is not there.
const RESOURCE_NOT_FOUND: i64 = -32_002;

/// Serves until the input ends and every call is answered.
pub fn serve(input: &mut dyn BufRead, output: impl Write + Send + 'static) {
    let shared = Arc::new(Shared {
        out: Out::lines(output),
        calls: Mutex::default(),
    });
    let (send, receive) = sync_channel(MOST_CALLS);
    let worker = worker(Arc::clone(&shared), receive);
    let mut server = Server {
        version: VERSIONS[0],
        shared,
        jobs: send,
    };
    // an input that cannot be read has ended
    while let Ok(Some(frame)) = line(input, LONGEST_LINE) {
        match frame {
            Frame::TooLong | Frame::NoLength => {
                let problem = format!(
                    "a message has at most {} MB; give the path of a long file",
                    LONGEST_LINE >> 20
                );
                let error = Error::new(INVALID_REQUEST, problem);
                server.shared.out.send(&failure(&Value::Null, &error));
            }
            Frame::Whole(line) if line.trim_ascii().is_empty() => {}
            Frame::Whole(line) => match serde_json::from_slice(&line) {
                Ok(value) => server.take(value),
                Err(problem) => {
                    let error = Error::new(PARSE_ERROR, format!("a message is one line of JSON: {problem}"));
                    server.shared.out.send(&failure(&Value::Null, &error));
                }
            },
        }
    }
    let Server { jobs, .. } = server;
    // the worker ends behind the last call
    drop(jobs);
    if let Some(worker) = worker {
        let _ = worker.join();
    }
}

/// State of the thread that reads and the thread that computes.
struct Shared {
    out: Out,
    /// The calls that are not answered yet, by their ids as JSON.
    calls: Mutex<HashMap<String, Token>>,
}

impl Shared {
    fn calls(&self) -> std::sync::MutexGuard<'_, HashMap<String, Token>> {
        self.calls.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The destination of a response: the output, or the array of a batch.
#[derive(Clone, Default)]
struct Destination(Option<Arc<Batch>>);

/// The responses to a batch, which are sent together when the last part of it is dropped.
struct Batch {
    shared: Arc<Shared>,
    responses: Mutex<Vec<Value>>,
}

impl Drop for Batch {
    fn drop(&mut self) {
        let responses = std::mem::take(self.responses.get_mut().unwrap_or_else(PoisonError::into_inner));
        if !responses.is_empty() {
            self.shared.out.send(&Value::Array(responses));
        }
    }
}

impl Destination {
    fn respond(&self, shared: &Shared, response: Value) {
        match &self.0 {
            None => shared.out.send(&response),
            Some(batch) => batch
                .responses
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .push(response),
        }
    }
}

/// A call of a tool.
struct Job {
    id: Value,
    call: Call,
    token: Token,
    /// The token under which the client asks for progress.
    progress: Option<Value>,
    destination: Destination,
}

/// The thread that reads.
struct Server {
    version: &'static str,
    shared: Arc<Shared>,
    jobs: SyncSender<Job>,
}

impl Server {
    /// Takes what a line has: a message, or a batch of them.
    fn take(&mut self, value: Value) {
        let Value::Array(batch) = value else {
            return self.message(value, &Destination::default());
        };
        let invalid = |problem: &str| failure(&Value::Null, &Error::new(INVALID_REQUEST, problem));
        if self.version != WITH_BATCHES {
            let problem = format!("version {} has no batches: send each message in a line", self.version);
            self.shared.out.send(&invalid(&problem));
        } else if batch.is_empty() {
            self.shared.out.send(&invalid("the batch is empty"));
        } else {
            let destination = Destination(Some(Arc::new(Batch {
                shared: Arc::clone(&self.shared),
                responses: Mutex::default(),
            })));
            for message in batch {
                self.message(message, &destination);
            }
        }
    }

    fn message(&mut self, value: Value, destination: &Destination) {
        match Message::read(value) {
            Ok(Message::Request { id, method, params }) => {
                let response = match self.request(&id, &method, params, destination) {
                    Ok(Some(result)) => success(&id, result),
                    // the worker answers
                    Ok(None) => return,
                    Err(error) => failure(&id, &error),
                };
                destination.respond(&self.shared, response);
            }
            Ok(Message::Notification { method, params }) if method == "notifications/cancelled" => {
                let id = params.get("requestId").unwrap_or(&Value::Null).to_string();
                if let Some(token) = self.shared.calls().get(&id) {
                    token.stop();
                }
            }
            Ok(Message::Notification { .. } | Message::Response) => {}
            Err(response) => destination.respond(&self.shared, response),
        }
    }

    /// Answers a request; `None` where the worker does.
    fn request(
        &mut self,
        id: &Value,
        method: &str,
        params: Value,
        destination: &Destination,
    ) -> Result<Option<Value>, Error> {
        Ok(Some(match method {
            "initialize" => self.initialize(&params)?,
            "ping" => json!({}),
            "tools/list" => json!({ "tools": tools::list() }),
            "resources/list" => json!({ "resources": RESOURCES.map(|resource| resource.described()).to_vec() }),
            "resources/templates/list" => json!({ "resourceTemplates": [] }),
            "resources/read" => {
                let uri = params.get("uri").and_then(Value::as_str);
                let uri = uri.ok_or_else(|| Error::params("`uri` should be a string"))?;
                let resource = RESOURCES.into_iter().find(|resource| resource.uri == uri);
                let Some(resource) = resource else {
                    let known: Vec<&str> = RESOURCES.iter().map(|resource| resource.uri).collect();
                    let problem = format!("there is no resource `{uri}`; there are: {}", known.join(", "));
                    return Err(Error::new(RESOURCE_NOT_FOUND, problem));
                };
                json!({ "contents": [resource.content()] })
            }
            "tools/call" => {
                self.call(id, params, destination)?;
                return Ok(None);
            }
            method => return Err(Error::method(method)),
        }))
    }

    fn initialize(&mut self, params: &Value) -> Result<Value, Error> {
        let asked = params.get("protocolVersion").and_then(Value::as_str);
        let asked = asked.ok_or_else(|| Error::params("`protocolVersion` should be a string, as \"2025-06-18\""))?;
        let known = VERSIONS.into_iter().find(|version| *version == asked);
        self.version = known.unwrap_or(VERSIONS[0]);
        Ok(json!({
            "protocolVersion": self.version,
            "capabilities": { "tools": {}, "resources": {} },
            "serverInfo": {
                "name": env!("CARGO_PKG_NAME"),
                "title": "vibro-audit: formulas proved or refuted",
                "version": env!("CARGO_PKG_VERSION"),
            },
            "instructions": INSTRUCTIONS,
        }))
    }

    /// Hands a call to the worker.
    fn call(&mut self, id: &Value, mut params: Value, destination: &Destination) -> Result<(), Error> {
        let progress = params.pointer("/_meta/progressToken").cloned();
        let arguments = params.get_mut("arguments").map_or(Value::Null, Value::take);
        let name = params.get("name").and_then(Value::as_str);
        let call = Call::read(
            name.ok_or_else(|| Error::params("`name` should name a tool"))?,
            arguments,
        )?;
        let token = Token::new();
        let job = Job {
            id: id.clone(),
            call,
            token: token.clone(),
            progress: progress.filter(|token| token.is_string() || token.is_number()),
            destination: destination.clone(),
        };
        let key = id.to_string();
        // entered before it runs, so that it is there to be removed
        let mut calls = self.shared.calls();
        if calls.contains_key(&key) {
            return Err(Error::new(INVALID_REQUEST, "a call with this `id` is not answered yet"));
        }
        match self.jobs.try_send(job) {
            Ok(()) => {
                calls.insert(key, token);
                Ok(())
            }
            Err(TrySendError::Full(_)) => {
                let problem = format!("{MOST_CALLS} calls wait already: wait for answers, or cancel some");
                Err(Error::new(SERVER_BUSY, problem))
            }
            Err(TrySendError::Disconnected(_)) => Err(Error::new(SERVER_BUSY, "no thread can be started")),
        }
    }
}

/// Starts the thread that computes, one call after the other; each uses every core.
fn worker(shared: Arc<Shared>, jobs: Receiver<Job>) -> Option<JoinHandle<()>> {
    let thread = thread::Builder::new().name("calls".to_owned()).stack_size(STACK);
    let work = move || {
        for job in jobs {
            let response = (!job.token.is_stopped()).then(|| answer(&shared, &job));
            shared.calls().remove(&job.id.to_string());
            // a call that is cancelled has no response
            if let Some(response) = response.filter(|_| !job.token.is_stopped()) {
                job.destination.respond(&shared, response);
            }
        }
    };
    thread.spawn(work).ok()
}

fn answer(shared: &Shared, job: &Job) -> Value {
    let watch = Arc::new(Watch::default());
    let run = || job.token.during(|| watch.during(|| job.call.run()));
    // a panic is a fault of ours, which ends no server
    let run = || catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|_| tools::fault());
    let result = match &job.progress {
        None => run(),
        Some(progress) => thread::scope(|scope| {
            let (done, is_done) = sync_channel::<()>(0);
            let (watch, by_steps) = (&watch, job.call.counts_steps());
            let report = move || {
                let mut last = 0;
                while is_done.recv_timeout(PAUSE) == Err(RecvTimeoutError::Timeout) {
                    let (now, total) = match (by_steps, watch.seen()) {
                        (true, _) => (job.token.steps(), None),
                        (false, Some((now, total))) => (now, Some(total)),
                        (false, None) => continue,
                    };
                    if now > last && !job.token.is_stopped() {
                        last = now;
                        let mut params = json!({ "progressToken": progress, "progress": now });
                        if let Some(total) = total {
                            params["total"] = total.into();
                        }
                        shared.out.send(&notification("notifications/progress", params));
                    }
                }
            };
            let reporting = scope.spawn(report);
            let result = run();
            drop(done);
            let _ = reporting.join();
            result
        }),
    };
    success(&job.id, result)
}
