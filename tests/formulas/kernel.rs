//! The kernel against whoever searches for certificates: what it must not accept, whatever it is handed.
//!
//! `attacks` holds one test for each hole that was found by reading: a certificate or a witness that was accepted
//! once, and the wrong verdict that it would have made. `rules` goes through the rules one by one; `refusals` breaks one
//! condition at a time. `mutants.py` breaks the kernel's own code, a line at a time, and says what these tests do not
//! notice.

#![cfg(feature = "kernel")]

mod attacks;
mod axioms;
#[cfg(feature = "audit")]
mod breaks;
mod digits;
mod forge;
mod refusals;
mod rules;

/// The two verdicts are made in one place each.
#[test]
fn only_the_verdicts_of_the_kernel_are_verdicts() {
    let mut open = vec![std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src")];
    let mut made = Vec::new();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(std::fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        for line in text.lines().map(str::trim).filter(|line| !line.starts_with("//")) {
            let is_made = ["Proved {", "Refuted {"].iter().any(|word| {
                line.contains(word) && !["struct", "impl", "enum"].iter().any(|before| line.contains(before))
            });
            if is_made {
                made.push(format!("{}: {line}", path.file_name().unwrap().to_string_lossy()));
            }
        }
    }
    made.sort();
    let expected = [
        "verdict.rs: Ok(Proved {",
        "verdict.rs: Ok(Refuted { nowhere: true })",
        "verdict.rs: Ok(true) => Evaluated::Fails(Refuted { nowhere: false }),",
    ];
    let of_kernel: Vec<&String> = made.iter().filter(|line| line.starts_with("verdict.rs")).collect();
    assert_eq!(of_kernel, expected, "{made:#?}");
}
