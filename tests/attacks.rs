//! Sheets made to attack the verdicts, from many fields. The truth of each stands in its first lines and was
//! established by other means (`tests/attacks/verify.py`): no verdict may be wrong, and few undecided.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use vibro_audit::claim::{Sheet, Verdict, vocabulary};
use vibro_audit::prove::{Options, decide};

/// The sheets below a folder, in order.
fn sheets(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            sheets(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "toml") {
            found.push(path);
        }
    }
}

/// The truth that the first lines of a sheet state: of one claim by its label, or of the last.
fn truth(text: &str, label: &str, last: bool) -> Option<String> {
    let of = |prefix: &str| {
        text.lines()
            .find_map(|line| line.strip_prefix(prefix))
            .map(|word| word.trim().to_string())
    };
    of(&format!("# truth {label}:")).or_else(|| if last { of("# truth:") } else { None })
}

#[test]
fn no_verdict_is_wrong_and_few_are_undecided() {
    let mut paths = Vec::new();
    sheets(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/attacks"), &mut paths);
    assert!(paths.len() >= 600, "{}", paths.len());
    let only = std::env::var("ATTACK").ok();
    let mut wrong = Vec::new();
    // by class: claims, undecided
    let mut classes: BTreeMap<String, (usize, usize)> = BTreeMap::new();
    for path in paths {
        let shown = path.display().to_string();
        if only.as_ref().is_some_and(|only| !shown.contains(only.as_str())) {
            continue;
        }
        let class = path
            .parent()
            .and_then(Path::file_name)
            .unwrap()
            .to_string_lossy()
            .into_owned();
        let text = std::fs::read_to_string(&path).unwrap();
        let sheet = match Sheet::read(&text, &vocabulary().unwrap()) {
            Ok(sheet) => sheet,
            Err(fault) => {
                if truth(&text, "", true).as_deref() != Some("unread") {
                    wrong.push(format!("{shown}: {fault}"));
                }
                continue;
            }
        };
        let claims: Vec<usize> = (0..sheet.entries.len()).filter(|&n| sheet.is_claim(n)).collect();
        for &position in &claims {
            let label = sheet.entries[position].label.clone();
            let Some(truth) = truth(&text, &label, claims.last() == Some(&position)) else {
                continue;
            };
            let start = std::time::Instant::now();
            let decision = decide(&sheet, position, &Options::default());
            let taken = start.elapsed();
            let class = classes.entry(class.clone()).or_default();
            class.0 += 1;
            let right = match (truth.as_str(), decision.verdict) {
                ("true", Verdict::Proved) | ("false", Verdict::Refuted) | ("unread", Verdict::Unread) => true,
                ("contradictory" | "unread", Verdict::Undecided) => true,
                ("true" | "false", Verdict::Undecided) => {
                    class.1 += 1;
                    println!(
                        "undecided ({truth}): {shown} ({label}) {:?}: {}",
                        taken, decision.reason
                    );
                    true
                }
                _ => false,
            };
            if taken.as_secs_f64() > 1.0 {
                println!("slow: {shown} {taken:?}");
            }
            if !right {
                wrong.push(format!(
                    "{shown} ({label}): {truth}, but {}: {}",
                    decision.verdict, decision.reason
                ));
            }
        }
    }
    let (claims, undecided) = classes
        .values()
        .fold((0, 0), |sum, class| (sum.0 + class.0, sum.1 + class.1));
    for (class, (claims, undecided)) in &classes {
        println!("{class}: {undecided} of {claims} undecided");
    }
    println!("in all {undecided} of {claims} undecided");
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}
