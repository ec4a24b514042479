//! What the README and the guide show is what happens.

use super::check;
use crate::common::program::{self, Scratch, scratch};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

const README: &str = include_str!("../../README.md");
const GUIDE: [(&str, &str); 13] = [
    ("first", include_str!("../../doc/first.md")),
    ("sheets", include_str!("../../doc/sheets.md")),
    ("numbers", include_str!("../../doc/numbers.md")),
    ("golden", include_str!("../../doc/golden.md")),
    ("orbits", include_str!("../../doc/orbits.md")),
    ("simulation", include_str!("../../doc/simulation.md")),
    ("restitution", include_str!("../../doc/restitution.md")),
    ("scenes", include_str!("../../doc/scenes.md")),
    ("accuracy", include_str!("../../doc/accuracy.md")),
    ("solvers", include_str!("../../doc/solvers.md")),
    ("documents", include_str!("../../doc/documents.md")),
    ("library", include_str!("../../doc/library.md")),
    ("editors", include_str!("../../doc/editors.md")),
];

/// The language and the text of each block of a page.
fn blocks(page: &str) -> impl Iterator<Item = (&str, &str)> {
    let fenced = page.split("\n```").skip(1).step_by(2);
    fenced.filter_map(|block| block.split_once('\n'))
}

/// A directory in which the blocks of a page that begin with the name of a file, as `# my-sheet.toml`, are these files.
fn directory(name: &str, page: &str) -> Scratch {
    let directory = scratch(name);
    for (_, text) in blocks(page) {
        let first = text.lines().next().unwrap_or_default();
        let named = first.strip_prefix("# ").or(first.strip_prefix("% "));
        if let Some(file) = named.filter(|file| file.ends_with(".toml") || file.ends_with(".tex")) {
            directory.file(file, text);
        }
    }
    directory
}

/// Types a command of a page into a shell.
fn run(command: &str, directory: &Path) -> (Option<i32>, String) {
    let program = Path::new(program::PATH).parent().expect("a directory");
    let path = std::env::var_os("PATH").unwrap_or_default();
    let places = std::iter::once(program.to_owned()).chain(std::env::split_paths(&path));
    let run = Command::new("sh")
        .args(["-c", &command.replace("cargo run --", "vibro-audit")])
        .current_dir(directory)
        .env("PATH", std::env::join_paths(places).expect("paths"))
        .output()
        .expect("a shell");
    (run.status.code(), String::from_utf8_lossy(&run.stdout).into_owned())
}

/// The commands that a block shows, each with what it shows of their output; `\\` ends a line that goes on.
fn shown(block: &str) -> Vec<(String, String)> {
    let joined = block.replace("\\\n", "");
    let commands = joined
        .strip_prefix("$ ")
        .into_iter()
        .flat_map(|rest| rest.split("\n$ "));
    commands
        .map(|shown| shown.split_once('\n').unwrap_or((shown, "")))
        .map(|(command, output)| (command.to_owned(), output.to_owned()))
        .collect()
}

/// Every line that is shown, up to its `...`, starts a line that is printed.
fn assert_shown(shown: &str, printed: &str) {
    for line in shown.lines().filter(|line| !matches!(*line, "" | "...")) {
        let start = line.trim_end_matches("...");
        assert!(
            printed.lines().any(|printed| printed.starts_with(start)),
            "`{start}` is not in\n{printed}"
        );
    }
}

#[test]
fn the_slip_in_the_sheet_of_the_readme_is_found_and_mended() {
    let directory = directory("readme-files", README);
    let (status, table) = run("vibro-audit audit fall.toml --repair --format csv", &directory);
    assert_eq!(status, Some(1), "{table}");
    assert!(
        table.contains("speed,refuted,proved") && table.contains("(H - h)"),
        "{table}"
    );
}

#[test]
fn the_readme_is_short_and_names_the_paper() {
    assert!(README.lines().count() <= 150);
    assert!(README.lines().all(|line| line.chars().count() <= 140));
    let title = "vibro-impact energy harvester under asymmetric restitution";
    for (name, text) in [
        ("README.md", README),
        ("CITATION.cff", include_str!("../../CITATION.cff")),
        (
            "golden/paper/equations.toml",
            include_str!("../../golden/paper/equations.toml"),
        ),
    ] {
        let joined = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(joined.contains(title), "{name}");
    }
}

#[test]
fn the_output_that_readme_and_guide_show_is_what_the_program_prints() {
    let mut seen = 0;
    let known = "vibro-audit check --format csv".to_owned();
    let mut by_command = BTreeMap::from([(known, (Some(0), check::BUILT_IN.1.clone()))]);
    for (name, page) in std::iter::once(("readme", README)).chain(GUIDE) {
        let directory = directory(name, page);
        for (command, output) in blocks(page)
            .filter(|(kind, _)| *kind == "text")
            .flat_map(|(_, block)| shown(block))
        {
            let command = command.replace("cargo run --", "vibro-audit");
            // what reads no file prints the same on each page
            let (status, printed) = match command.contains(['/', '.']) {
                true => run(&command, &directory),
                false => {
                    let known = by_command.entry(command.clone());
                    known.or_insert_with(|| run(&command, &directory)).clone()
                }
            };
            assert!(matches!(status, Some(0 | 1)), "{name}: {command} ends with {status:?}");
            assert_shown(&output, &printed);
            seen += 1;
        }
    }
    assert!(seen >= 20, "only {seen} examples are run");
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
