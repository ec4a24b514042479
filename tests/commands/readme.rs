//! What the README and the guide show is what happens.

use super::check;
use crate::common::program::{self, Scratch, scratch};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

const README: &str = include_str!("../../README.md");
/// Pages outside of `doc/` whose examples are run like those of the guide.
const OTHERS: [&str; 1] = ["golden/restitution/README.md"];

/// Returns the path and the text of each page of the guide, and of the others.
fn guide() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut pages: Vec<String> = OTHERS.map(str::to_owned).to_vec();
    for folder in ["doc", "doc/reference"] {
        for entry in std::fs::read_dir(root.join(folder)).expect("the guide") {
            let name = entry.expect("a file").file_name().into_string().expect("a name");
            if name.ends_with(".md") {
                pages.push(format!("{folder}/{name}"));
            }
        }
    }
    pages.sort();
    let read = |page: String| {
        let text = std::fs::read_to_string(root.join(&page)).expect("a page");
        (page, text)
    };
    pages.into_iter().map(read).collect()
}

/// The language and the text of each block of a page.
fn blocks(page: &str) -> impl Iterator<Item = (&str, &str)> {
    let fenced = page.split("\n```").skip(1).step_by(2);
    fenced.filter_map(|block| block.split_once('\n'))
}

/// A directory with `examples/`, in which the blocks of a page that begin with the name of a file, as `# my-sheet.toml`, are
/// these files.
fn directory(name: &str, page: &str) -> Scratch {
    let directory = scratch(name);
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    std::os::unix::fs::symlink(examples, directory.join("examples")).expect("a link");
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
    let readme = ("readme".to_owned(), README.to_owned());
    for (name, page) in std::iter::once(readme).chain(guide()) {
        let directory = directory(&name.replace('/', "-"), &page);
        for (command, output) in blocks(&page)
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
    assert!(seen >= 50, "only {seen} examples are run");
}

#[test]
fn the_guide_lists_each_of_its_pages() {
    let doc = Path::new(env!("CARGO_MANIFEST_DIR")).join("doc");
    let summary = std::fs::read_to_string(doc.join("SUMMARY.md")).expect("a table of contents");
    for (page, _) in guide() {
        if let Some(name) = page.strip_prefix("doc/").filter(|name| *name != "SUMMARY.md") {
            assert!(summary.contains(&format!("]({name})")), "{name} is not listed");
        }
    }
    for link in summary.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
        assert!(doc.join(link).is_file(), "{link} is not there");
    }
}
