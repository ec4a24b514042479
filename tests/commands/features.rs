//! That the library without features needs the crates that the guide says, and no other.

use std::collections::BTreeSet;
use std::process::Command;
use toml::{Table, Value};

const GUIDE: &str = include_str!("../../doc/library.md");
const MANIFEST: &str = include_str!("../../Cargo.toml");

/// The crates that the GUIDE lists, each in backticks between the two marks.
fn listed() -> BTreeSet<String> {
    let list = GUIDE
        .split_once("<!-- crates without features -->")
        .and_then(|(_, rest)| rest.split_once("<!-- end -->"))
        .expect("the marked list")
        .0;
    list.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The number of crates in the GUIDE's row of these features.
fn counted(features: &str) -> usize {
    let start = format!("| {features} |");
    let row = GUIDE.lines().find(|line| line.starts_with(&start)).expect("a row");
    let cell = row.split('|').nth(3).expect("a third cell");
    cell.trim().parse().expect("a number of crates")
}

fn manifest() -> Table {
    MANIFEST.parse().expect("TOML")
}

fn is_optional(dependency: &Value) -> bool {
    dependency.get("optional").and_then(Value::as_bool) == Some(true)
}

/// All crates that are built with these features, the library's own left out: `name version`.
fn built(features: &str) -> BTreeSet<String> {
    let flags = "tree --locked --offline --edges normal --prefix none --no-default-features --features";
    let run = Command::new(env!("CARGO"))
        .args(flags.split(' '))
        .arg(features)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let text = String::from_utf8(run.stdout).expect("text");
    let names = text
        .lines()
        .map(|line| line.split(' ').take(2).collect::<Vec<_>>().join(" "));
    names.filter(|name| !name.starts_with("vibro-audit ")).collect()
}

#[test]
fn without_features_the_crates_are_those_that_the_readme_lists() {
    let manifest = manifest();
    let dependencies = manifest["dependencies"].as_table().expect("a table");
    let always: BTreeSet<String> = dependencies
        .iter()
        .filter(|(_, dependency)| !is_optional(dependency))
        .map(|(name, _)| name.clone())
        .collect();
    assert_eq!(always, listed());
    let names: BTreeSet<String> = built("")
        .iter()
        .map(|name| name.split(' ').next().expect("a name").to_owned())
        .collect();
    assert!(always.is_subset(&names), "{names:?}");
    // what is behind a feature is nowhere below either
    for (name, _) in dependencies.iter().filter(|(_, dependency)| is_optional(dependency)) {
        assert!(!names.contains(name), "{name}");
    }
}

#[test]
fn the_readme_counts_the_crates_of_each_choice_of_features() {
    assert_eq!(built("").len(), counted("none"));
    // clap and toml need other crates on other systems
    if cfg!(target_os = "linux") {
        assert_eq!(built("audit").len(), counted("`audit`"));
        assert_eq!(built("cli").len(), counted("`cli`, the default"));
    }
}

#[test]
fn every_optional_crate_is_behind_a_feature_that_the_default_has() {
    let manifest = manifest();
    let features = manifest["features"].as_table().expect("a table");
    let mut open = vec!["default"];
    let mut reached = BTreeSet::new();
    while let Some(feature) = open.pop() {
        for part in features[feature].as_array().expect("a list") {
            let part = part.as_str().expect("a name");
            match part.strip_prefix("dep:") {
                Some(name) => drop(reached.insert(name.to_owned())),
                None => open.push(part),
            }
        }
    }
    let dependencies = manifest["dependencies"].as_table().expect("a table");
    for (name, _) in dependencies.iter().filter(|(_, dependency)| is_optional(dependency)) {
        assert!(
            reached.contains(name),
            "{name} is optional and no feature of the default brings it"
        );
    }
}
