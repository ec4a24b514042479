//! Work without the interpreter's lock, which Ctrl-C and an exception from another thread end.

use super::fault;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use vibro_audit::cli::STACK;
use vibro_audit::stop::Token;

/// How often the interpreter is asked whether to go on.
const PAUSE: Duration = Duration::from_millis(50);

/// How long stopped work may take to its next step; after it nobody waits for it.
const GRACE: Duration = Duration::from_secs(2);

/// The threads that compute, and the process that they belong to.
static POOL: Mutex<Option<(u32, &'static ThreadPool)>> = Mutex::new(None);

/// The threads of this process. One that was forked has none of its parent's.
fn pool() -> PyResult<&'static ThreadPool> {
    let mut pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let own = std::process::id();
    match *pool {
        Some((process, pool)) if process == own => Ok(pool),
        _ => {
            let made = ThreadPoolBuilder::new().stack_size(STACK).build();
            let made = made.map_err(|error| PyRuntimeError::new_err(format!("no threads: {error}")))?;
            let made: &'static ThreadPool = Box::leak(Box::new(made));
            *pool = Some((own, made));
            Ok(made)
        }
    }
}

/// What `work` comes to.
///
/// # Errors
/// The exception that ended it, which then leaves nothing behind.
pub fn run<R: Send + 'static>(py: Python<'_>, work: impl FnOnce() -> R + Send + 'static) -> PyResult<R> {
    let token = Token::new();
    let (send, receive) = sync_channel(1);
    let under = token.clone();
    pool()?.spawn(move || {
        // a panic, which is a fault of ours, drops `send` and is told as such
        if let Ok(found) = catch_unwind(AssertUnwindSafe(|| under.during(work))) {
            let _ = send.send(found);
        }
    });
    let receive = Mutex::new(receive);
    let wait = |pause: Duration| {
        py.detach(|| {
            let receive = receive.lock().unwrap_or_else(PoisonError::into_inner);
            receive.recv_timeout(pause)
        })
    };
    loop {
        match wait(PAUSE) {
            Ok(found) => return Ok(found),
            Err(RecvTimeoutError::Disconnected) => return Err(fault("the computation ended in a panic")),
            // a statement is where the interpreter raises what another thread has asked it to
            Err(RecvTimeoutError::Timeout) => {
                if let Err(error) = py.check_signals().and_then(|()| py.run(c"pass", None, None)) {
                    token.stop();
                    let _ = wait(GRACE);
                    return Err(error);
                }
            }
        }
    }
}
