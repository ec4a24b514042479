//! The binary: everything it does is in the library.

fn main() -> std::process::ExitCode {
    vibro_audit::cli::run(std::env::args_os()).into()
}
