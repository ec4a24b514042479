//! What a signal ends: computations at their next step, and where that takes too long everything, with nothing half
//! written left behind.

use crate::report::remove_temporaries;
use crate::stop::Token;
use std::sync::OnceLock;
use std::time::Duration;

/// How long a computation may take to its next step.
const GRACE: Duration = Duration::from_secs(2);

/// The status of a program that a signal has ended, as shells tell it of SIGINT.
pub const STATUS: u8 = 130;

/// The token that SIGINT, SIGTERM and SIGHUP stop.
pub fn token() -> &'static Token {
    static TOKEN: OnceLock<Token> = OnceLock::new();
    TOKEN.get_or_init(|| {
        let token = Token::new();
        let stopped = token.clone();
        // where no handler can be set a signal ends the program as it is
        let _ = ctrlc::set_handler(move || {
            stopped.stop();
            std::thread::sleep(GRACE);
            remove_temporaries();
            std::process::exit(i32::from(STATUS));
        });
        token
    })
}
