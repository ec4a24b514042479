//! What the README shows is what happens.

use std::process::Command;

const README: &str = include_str!("../README.md");

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

fn audit(arguments: &[&str]) -> (Option<i32>, String) {
    let run = Command::new(env!("CARGO_BIN_EXE_vibro-audit"))
        .arg("audit")
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("the binary");
    (run.status.code(), String::from_utf8_lossy(&run.stdout).into_owned())
}

#[test]
fn the_sheet_of_the_readme_is_decided_as_it_says() {
    let path = std::env::temp_dir().join(format!("vibro-audit-readme-{}.toml", std::process::id()));
    std::fs::write(&path, block("toml", "# my-sheet.toml")).expect("a temporary file");
    let (status, table) = audit(&[path.to_str().expect("a path"), "--format", "csv"]);
    std::fs::remove_file(&path).expect("the temporary file");
    assert_eq!(status, Some(0), "{table}");
    for line in block("text", "$ vibro-audit audit my-sheet").lines().skip(1) {
        let shown = line.trim_end_matches("...");
        assert!(
            table.lines().any(|row| row.starts_with(shown)),
            "`{shown}` is not in\n{table}"
        );
    }
}

#[test]
fn the_output_that_the_readme_shows_is_what_the_program_prints() {
    for (first, arguments) in [
        ("$ cargo run --release -- audit", vec![]),
        ("$ vibro-audit audit --explain 14", vec!["--explain", "14"]),
    ] {
        let (_, printed) = audit(&arguments);
        for line in block("text", first).lines().skip(1).filter(|line| *line != "...") {
            assert!(printed.contains(line), "`{line}` is not in\n{printed}");
        }
    }
}
