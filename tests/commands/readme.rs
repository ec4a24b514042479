//! What the README and the guide show is what happens.

use std::collections::BTreeMap;
use std::process::Command;

use super::check;

const README: &str = include_str!("../../README.md");
const GUIDE: [&str; 9] = [
    include_str!("../../doc/sheets.md"),
    include_str!("../../doc/numbers.md"),
    include_str!("../../doc/orbits.md"),
    include_str!("../../doc/simulation.md"),
    include_str!("../../doc/scenes.md"),
    include_str!("../../doc/accuracy.md"),
    include_str!("../../doc/solvers.md"),
    include_str!("../../doc/documents.md"),
    include_str!("../../doc/library.md"),
];

fn block(language: &str, first: &str) -> String {
    let fence = format!("```{language}\n");
    let mut blocks = README
        .split(&fence)
        .skip(1)
        .filter_map(|rest| rest.split("\n```").next());
    blocks
        .find(|block| block.starts_with(first))
        .unwrap_or_else(|| panic!("no block `{first}`"))
        .to_string()
}

fn run(arguments: &[&str]) -> (Option<i32>, String) {
    let run = Command::new(env!("CARGO_BIN_EXE_vibro-audit"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("the binary");
    (run.status.code(), String::from_utf8_lossy(&run.stdout).into_owned())
}

/// Runs `command` over a file with the block of the README that starts with `first`.
fn run_on(command: &str, first: &str, rest: &[&str]) -> (Option<i32>, String) {
    let name = format!("vibro-audit-readme-{}-{command}.toml", std::process::id());
    let path = std::env::temp_dir().join(name);
    std::fs::write(&path, block("toml", first)).expect("a temporary file");
    let mut arguments = vec![command, path.to_str().expect("a path")];
    arguments.extend(rest);
    let answer = run(&arguments);
    std::fs::remove_file(&path).expect("the temporary file");
    answer
}

/// Every line that is shown, up to its `...`, starts a line that is printed.
fn assert_shown(shown: &str, printed: &str) {
    for line in shown.lines().filter(|line| *line != "...") {
        let start = line.trim_end_matches("...");
        assert!(
            printed.lines().any(|printed| printed.starts_with(start)),
            "`{start}` is not in\n{printed}"
        );
    }
}

#[test]
fn the_sheet_of_the_readme_is_decided_as_it_says() {
    let (status, table) = run_on("audit", "# my-sheet.toml", &["--format", "csv"]);
    assert_eq!(status, Some(0), "{table}");
    let shown = block("text", "$ vibro-audit audit my-sheet");
    assert_shown(shown.split_once('\n').expect("output").1, &table);
}

#[test]
fn the_scene_of_the_readme_has_its_two_orbits() {
    let (status, table) = run_on("orbits", "# my-scene.toml", &["--format", "csv"]);
    assert_eq!((status, table.lines().count()), (Some(0), 3), "{table}");
}

#[test]
fn the_output_that_readme_and_guide_show_is_what_the_program_prints() {
    let pages = std::iter::once(README).chain(GUIDE);
    let shown = pages.flat_map(|page| page.split("```text\n$ ").skip(1));
    let mut seen = 0;
    let mut by_command = BTreeMap::from([("check --format csv", check::BUILT_IN.1.clone())]);
    for rest in shown {
        let (command, output) = rest.split_once('\n').expect("output below a command");
        let arguments = command
            .strip_prefix("cargo run --release -- ")
            .or_else(|| command.strip_prefix("vibro-audit "))
            .expect("a command of this program");
        if arguments.contains("my-sheet.toml") {
            continue;
        }
        let printed = by_command
            .entry(arguments)
            .or_insert_with(|| run(&arguments.split(' ').collect::<Vec<_>>()).1);
        assert_shown(output.split("\n```").next().expect("a block"), printed);
        seen += 1;
    }
    assert!(seen >= 12, "only {seen} examples are run");
}

#[test]
fn the_guide_lists_each_of_its_pages() {
    let guide = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("doc");
    let summary = std::fs::read_to_string(guide.join("SUMMARY.md")).expect("a table of contents");
    for entry in std::fs::read_dir(&guide).expect("the guide") {
        let name = entry.expect("a file").file_name().into_string().expect("a name");
        if name.ends_with(".md") && name != "SUMMARY.md" {
            assert!(summary.contains(&format!("]({name})")), "{name} is not listed");
        }
    }
    for link in summary.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
        assert!(guide.join(link).is_file(), "{link} is not there");
    }
}
