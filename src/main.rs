//! The binary: everything it does is in the library.

use std::process::ExitCode;
use vibro_audit::cli::{STACK, run};

fn main() -> ExitCode {
    // if there are threads already, they are kept
    let _ = rayon::ThreadPoolBuilder::new().stack_size(STACK).build_global();
    let work = || run(std::env::args_os()).into();
    let thread = std::thread::Builder::new().name("main".to_owned()).stack_size(STACK);
    match thread.spawn(work) {
        Ok(running) => running.join().unwrap_or_else(|_| ExitCode::from(101)),
        Err(_) => work(),
    }
}
