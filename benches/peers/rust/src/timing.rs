//! The seconds one job takes, and the line that says so.

use cpu_time::ThreadTime;
use std::hint::black_box;
use std::time::Duration;

/// The least mean time of one job, s of this thread, over nine batches of at least 20 ms: what else the machine does
/// only adds.
pub fn seconds<R>(mut job: impl FnMut() -> R) -> f64 {
    let mut batch = |repeats: u32| {
        let start = ThreadTime::now();
        for _ in 0..repeats {
            black_box(job());
        }
        start.elapsed()
    };
    let mut repeats = 1;
    while batch(repeats) < Duration::from_millis(20) {
        repeats *= 2;
    }
    let times = (0..9).map(|_| batch(repeats).as_secs_f64() / f64::from(repeats));
    times.fold(f64::INFINITY, f64::min)
}

/// A line for `run`: task, tool, seconds, answers.
pub fn say(task: &str, tool: &str, seconds: f64, answers: &[String]) {
    println!("{task}\t{tool}\t{seconds:e}\t{}", answers.join(";"));
}
