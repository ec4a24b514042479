//! Rocq, where it is installed: the library of the prover, compiled once, and texts that it accepts or refuses.

use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use vibro_audit::prove::rocq::LIBRARY;

/// What each text rests on.
const HEAD: &str = "Require Import VibroClaims.\nRequire Import Reals Lra Lia Coquelicot.Coquelicot.\nOpen Scope R_scope.\n\
                    Set Default Timeout 100.\n";

/// The folder of the compiled library; none, and a word, where there is no Rocq.
pub fn library() -> Option<&'static PathBuf> {
    static FOLDER: OnceLock<Option<PathBuf>> = OnceLock::new();
    let made = FOLDER.get_or_init(|| {
        let has = Command::new("coqc").arg("--version").output();
        if !has.is_ok_and(|output| output.status.success()) {
            eprintln!("skipped: no coqc here (Debian: apt-get install coq libcoq-coquelicot libcoq-interval)");
            return None;
        }
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("rocq");
        std::fs::create_dir_all(&folder).unwrap();
        for (name, text) in LIBRARY {
            std::fs::write(folder.join(name), text).unwrap();
            let output = Command::new("coqc").arg(name).current_dir(&folder).output().unwrap();
            assert!(
                output.status.success(),
                "{name}: {}",
                String::from_utf8_lossy(&output.stderr)
            );
        }
        Some(folder)
    });
    made.as_ref()
}

/// What one Rocq says of texts, each in a module of its own: nothing where all theorems of these names are accepted, else its error.
pub fn checked(folder: &PathBuf, texts: &[String], theorems: &[&str]) -> Vec<Option<String>> {
    let mut input = HEAD.to_owned();
    for (number, text) in texts.iter().enumerate() {
        let is_head = |line: &&str| {
            ["Require", "Open Scope", "Print Assumptions"]
                .iter()
                .any(|word| line.starts_with(word))
        };
        let body: Vec<&str> = text.lines().filter(|line| !is_head(line)).collect();
        input += &format!("Module M{number}.\n{}\nAbort All.\nEnd M{number}.\n", body.join("\n"));
        for theorem in theorems {
            if text.contains(&format!("Theorem {theorem} ")) {
                input += &format!("Goal True. idtac \"ASKED {number}\". exact I. Qed.\nCheck M{number}.{theorem}.\n");
            }
        }
        input += &format!("Goal True. idtac \"END {number}\". exact I. Qed.\n");
    }
    let mut process = Command::new("coqtop")
        .args(["-q", "-Q", ".", ""])
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = process.stdin.take().unwrap();
    let writer = std::thread::spawn(move || pipe.write_all(input.as_bytes()));
    // it says errors on the error stream, in the order of commands
    let output = process.wait_with_output().unwrap();
    // one that has ended reads no more
    let _ = writer.join().unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let faults = String::from_utf8_lossy(&output.stderr);
    // a file may end the program, as by the memory that it takes; what follows is checked by another one
    let ended = (0..texts.len())
        .find(|number| !said.contains(&format!("END {number}\n")))
        .unwrap_or(texts.len());
    let rest = match texts.get(ended + 1..) {
        Some(rest) if !rest.is_empty() => checked(folder, rest, theorems),
        _ => Vec::new(),
    };
    (0..texts.len().min(ended + 1))
        .map(|number| {
            let from = if number == 0 {
                0
            } else {
                said.find(&format!("END {}\n", number - 1)).unwrap_or(said.len())
            };
            let to = said.find(&format!("END {number}\n")).unwrap_or(said.len());
            let own = said.get(from..to).unwrap_or_default();
            let asked = theorems
                .iter()
                .filter(|theorem| texts[number].contains(&format!("Theorem {theorem} ")))
                .count();
            let found = theorems
                .iter()
                .filter(|theorem| own.contains(&format!("M{number}.{theorem}\n")))
                .count();
            let is_accepted = asked > 0 && found == asked;
            let fault = || {
                let at = faults.find(&format!("Check M{number}.")).unwrap_or(0);
                let before = faults.get(..at).unwrap_or_default();
                let start = before.rfind("Error:").unwrap_or(0);
                before
                    .get(start..)
                    .unwrap_or_default()
                    .chars()
                    .take(300)
                    .collect::<String>()
            };
            (!is_accepted).then(fault)
        })
        .chain(rest)
        .collect()
}
