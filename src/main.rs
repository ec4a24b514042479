//! The binary: everything it does is in the library.

#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::todo,
        clippy::unimplemented,
        clippy::unreachable
    )
)]

fn main() -> std::process::ExitCode {
    vibro_audit::cli::run(std::env::args_os()).into()
}
