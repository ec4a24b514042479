//! `audit` of several files, of documents with printed numbers, and against a baseline: one document of the format, one status.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A directory of its own, gone when it goes out of scope.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("vibro-audit-audits-{}-{name}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn file(&self, name: &str, text: &str) {
        fs::write(self.0.join(name), text).unwrap();
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).unwrap()
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn run(directory: &Path, arguments: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_vibro-audit");
    let run = Command::new(program).args(arguments).current_dir(directory).output();
    run.expect("it runs")
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn json(output: &Output) -> serde_json::Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {}", stderr(output)))
}

/// A document with formulas and a printed number, of which one is refuted, as is said.
const NOTES: &str = r"# Notes
<!-- audit: symbols a, b; positive m -->
$$ (a+b)^2 = a^2 + b^2a$$ <!-- audit: claim; expect refuted -->
```math
m a = a m
```
| t | v |
|---|---|
| 1 | 0.83272 | <!-- audit: value orbits.velocities[0], scene fig02, motion.d=0.4 -->
";

const RIGHT: &str = "% audit: symbols a, b\n% audit: claim\n\\begin{equation}\na + b = b + a\n\\end{equation}\n";
const WRONG: &str = "% audit: symbols a, b\n% audit: claim\n\\begin{equation}\na - b = b - a\n\\end{equation}\n";
const SHEET: &str = "[symbols]\nparameters = ['x']\n[[equation]]\nlabel = 's'\nrole = 'claim'\ntex = 'x + x = 2 x'\n";

#[test]
fn a_document_with_printed_numbers_is_one_document_of_each_format() {
    let scratch = Scratch::new("numbers");
    scratch.file("notes.md", NOTES);
    let of = |format: &str| {
        let output = run(&scratch.0, &["audit", "notes.md", "--format", format]);
        assert_eq!(output.status.code(), Some(0), "{format}: {}", stderr(&output));
        output
    };
    let both = json(&of("json"));
    let keys: Vec<&String> = both.as_object().expect("one object").keys().collect();
    assert_eq!(keys, ["formulas", "numbers"]);
    assert_eq!(
        (&both["formulas"][0]["verdict"], &both["numbers"][0]["verdict"]),
        (&"refuted".into(), &"reproduced".into())
    );
    let csv = stdout(&of("csv"));
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let head = reader.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = reader
        .records()
        .map(|row| row.expect("as long as the header"))
        .collect();
    let cell = |row: usize, name: &str| rows[row][head.iter().position(|own| own == name).unwrap()].to_owned();
    assert_eq!(rows.len(), 3, "{csv}");
    assert_eq!(
        [cell(0, "verdict"), cell(2, "verdict"), cell(2, "id")],
        ["refuted", "reproduced", "number-1"]
    );
    for line in stdout(&of("jsonl")).lines() {
        serde_json::from_str::<serde_json::Map<_, _>>(line).unwrap_or_else(|error| panic!("{error}: {line:?}"));
    }
    assert!(json(&of("sarif"))["runs"].is_array());
    let junit = stdout(&of("junit"));
    assert_eq!(
        roxmltree::Document::parse(&junit)
            .unwrap()
            .root_element()
            .tag_name()
            .name(),
        "testsuites"
    );
}

#[test]
fn each_format_of_a_document_with_wrong_numbers_is_a_baseline_of_its_formulas() {
    let scratch = Scratch::new("baseline");
    scratch.file(
        "notes.md",
        &NOTES.replace("; expect refuted", "").replace("0.83272", "0.9"),
    );
    for format in ["json", "jsonl", "csv", "sarif"] {
        run(&scratch.0, &["audit", "notes.md", "--format", format, "--out", "known"]);
        let output = run(
            &scratch.0,
            &["audit", "notes.md", "--baseline", "known", "--format", "json"],
        );
        // the number is no finding that a baseline knows
        assert_eq!(output.status.code(), Some(1), "{format}: {}", stderr(&output));
        assert!(
            !stderr(&output).contains("not found any more"),
            "{format}: {}",
            stderr(&output)
        );
        assert_eq!(json(&output)["formulas"][0]["expected"], "refuted", "{format}");
    }
}

#[test]
fn several_files_are_one_table_with_the_worst_status() {
    let scratch = Scratch::new("several");
    scratch.file("right.tex", RIGHT);
    scratch.file("wrong.tex", WRONG);
    scratch.file("sheet.toml", SHEET);
    scratch.file("notes.md", NOTES);
    scratch.file("broken.toml", "[[equation]\n");
    let files = |output: &Output| -> Vec<String> {
        let rows = json(output);
        let rows = rows.as_array().expect("one array").iter();
        rows.map(|row| format!("{} {}", row["file"].as_str().unwrap(), row["verdict"].as_str().unwrap()))
            .collect()
    };
    let output = run(&scratch.0, &["audit", "right.tex", "sheet.toml", "--format", "json"]);
    assert_eq!(
        (output.status.code(), files(&output)),
        (
            Some(0),
            vec!["right.tex proved".to_owned(), "sheet.toml proved".to_owned()]
        )
    );
    let output = run(&scratch.0, &["audit", "wrong.tex", "right.tex", "--format", "json"]);
    assert_eq!(
        (output.status.code(), files(&output)),
        (
            Some(1),
            vec!["wrong.tex refuted".to_owned(), "right.tex proved".to_owned()]
        )
    );
    // one that cannot be used, or is not there, stops no other
    let all = ["audit", "broken.toml", "wrong.tex", "none.tex", "sheet.toml"];
    let output = run(&scratch.0, &[&all[..], &["--format", "json"]].concat());
    assert_eq!(
        (output.status.code(), files(&output)),
        (
            Some(2),
            vec!["wrong.tex refuted".to_owned(), "sheet.toml proved".to_owned()]
        )
    );
    assert!(stderr(&output).contains("broken.toml") && stderr(&output).contains("none.tex"));
    // the last column, and none of one file
    let head = |arguments: &[&str]| {
        let output = run(&scratch.0, &[arguments, &["--format", "csv"]].concat());
        stdout(&output).lines().next().unwrap_or_default().to_owned()
    };
    assert!(head(&["audit", "right.tex", "sheet.toml"]).ends_with(",file"));
    assert!(head(&["audit", "notes.md", "sheet.toml"]).ends_with(",file"));
    assert!(!head(&["audit", "right.tex"]).contains("file"));
    // the others are one document too
    let both = ["audit", "wrong.tex", "notes.md"];
    let log = json(&run(&scratch.0, &[&both[..], &["--format", "sarif"]].concat()));
    let uris: Vec<&str> = log["runs"][0]["results"]
        .as_array()
        .unwrap()
        .iter()
        .map(|result| {
            result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
                .as_str()
                .unwrap()
        })
        .collect();
    assert_eq!(
        (log["runs"].as_array().unwrap().len(), uris),
        (1, vec!["wrong.tex", "notes.md"])
    );
    let junit = stdout(&run(&scratch.0, &[&both[..], &["--format", "junit"]].concat()));
    let junit = roxmltree::Document::parse(&junit).unwrap();
    let classes: Vec<&str> = junit
        .descendants()
        .filter_map(|node| node.attribute("classname"))
        .collect();
    assert_eq!(classes.len(), 4);
    assert!(
        classes[0].starts_with("wrong.tex:") && classes[3].starts_with("notes.md:"),
        "{classes:?}"
    );
    let both = json(&run(&scratch.0, &[&both[..], &["--format", "json"]].concat()));
    assert_eq!(both["formulas"].as_array().unwrap().len(), 3);
    assert_eq!(both["numbers"][0]["file"], "notes.md");
    // what a baseline knows of any of them
    run(
        &scratch.0,
        &["audit", "wrong.tex", "right.tex", "--format", "sarif", "--out", "known"],
    );
    let output = run(&scratch.0, &["audit", "right.tex", "wrong.tex", "--baseline", "known"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}

#[test]
fn a_report_for_machines_names_what_cannot_be_used() {
    let scratch = Scratch::new("unusable");
    scratch.file(
        "paper.tex",
        "% audit: symbols a\n\\[ a + a = 2 a \\]\nThe velocity is 0.677 % audit: value orbits.velocitys[0], scene fig02\n\
         and 0.677 % audit: vlaue orbits.velocities[0], scene fig02\n",
    );
    scratch.file("broken.toml", "[symbols]\nparameters = ['a'\n");
    for (arguments, wanted) in [
        (
            &["paper.tex"][..],
            &["paper.tex 3: there is no column `velocitys`", "paper.tex 4: `vlaue "][..],
        ),
        (&["broken.toml"], &["broken.toml 2: "]),
        (&["none.tex", "broken.toml"], &["none.tex -: ", "broken.toml 2: "]),
    ] {
        let of = |format: &str| {
            let output = run(&scratch.0, &[&["audit"], arguments, &["--format", format]].concat());
            assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
            output
        };
        let log = json(&of("sarif"));
        let results = log["runs"][0]["results"].as_array().unwrap();
        let mut found: Vec<String> = Vec::new();
        for result in results.iter().filter(|result| result["ruleId"] == "input-unusable") {
            let place = &result["locations"][0]["physicalLocation"];
            let line = place["region"]["startLine"]
                .as_i64()
                .map_or("-".to_owned(), |line| line.to_string());
            let message = result["message"]["text"]
                .as_str()
                .unwrap()
                .trim_start_matches("(input) unusable: ");
            let file = place["artifactLocation"]["uri"].as_str().unwrap();
            assert_eq!(result["level"], "error");
            found.push(format!("{file} {line}: {message}"));
        }
        assert_eq!(found.len(), wanted.len(), "{found:?}");
        for part in wanted {
            assert!(found.iter().any(|found| found.contains(part)), "{part}: {found:?}");
        }
        let junit = stdout(&of("junit"));
        let junit = roxmltree::Document::parse(&junit).unwrap();
        let failed = junit
            .descendants()
            .filter(|node| node.attribute("type") == Some("unusable"));
        assert_eq!(failed.count(), wanted.len());
    }
}

#[test]
fn what_is_of_one_file_is_refused_for_several() {
    let scratch = Scratch::new("one");
    scratch.file("right.tex", RIGHT);
    scratch.file("wrong.tex", WRONG);
    for (flag, arguments) in [
        ("--explain", &["--explain", "1"][..]),
        ("--draft", &["--draft"]),
        ("--proof", &["--proof", "proofs"]),
        ("--repair-into", &["--repair-into", "mended.tex"]),
        ("--format html", &["--format", "html"]),
    ] {
        let output = run(&scratch.0, &[&["audit", "right.tex", "wrong.tex"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{flag}");
        assert!(
            stderr(&output).contains(&format!("{flag} is of one file, and 2 are named")),
            "{}",
            stderr(&output)
        );
        assert!(output.stdout.is_empty());
    }
    assert!(!scratch.0.join("proofs").exists() && !scratch.0.join("mended.tex").exists());
    let output = run(&scratch.0, &["audit", "-", "-"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("read once"), "{}", stderr(&output));
}

#[test]
fn the_hook_takes_any_name_of_a_file() {
    let hook = include_str!("../../.pre-commit-hooks.yaml");
    let field = |name: &str| {
        let line = hook.lines().find_map(|line| line.trim().strip_prefix(name));
        line.unwrap_or_else(|| panic!("no {name}")).trim().to_owned()
    };
    assert_eq!(
        (field("entry:"), field("args:")),
        ("vibro-audit audit".to_owned(), "[--]".to_owned())
    );
    let scratch = Scratch::new("hook");
    scratch.file("main.tex", RIGHT);
    scratch.file("--out=main.tex", WRONG);
    scratch.file("--format=json", SHEET);
    // as pre-commit calls it: entry, args, names of files
    let output = run(
        &scratch.0,
        &["audit", "--", "--out=main.tex", "main.tex", "--format=json"],
    );
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert_eq!(scratch.read("main.tex"), RIGHT);
    assert!(stdout(&output).contains("--out=main.tex"));
}

#[test]
fn the_example_for_ci_passes_as_shipped() {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/ci");
    let commands = include_str!("../../examples/ci/README.md")
        .lines()
        .filter_map(|line| line.strip_prefix("$ "));
    let commands: Vec<Vec<&str>> = commands.map(|line| line.split_whitespace().skip(1).collect()).collect();
    assert!(!commands.is_empty());
    for command in &commands {
        let output = run(&directory, command);
        assert_eq!(output.status.code(), Some(0), "{command:?}: {}", stderr(&output));
        assert!(
            stdout(&output).contains("known from the baseline") && output.stderr.is_empty(),
            "{}",
            stderr(&output)
        );
    }
    // what the workflow runs, and what makes the baseline
    let scratch = Scratch::new("ci");
    let out = scratch.0.join("audit.sarif").display().to_string();
    let marked = [
        "audit",
        "paper.tex",
        "--repair",
        "--baseline",
        "baseline.sarif",
        "--format",
        "sarif",
        "--out",
        &out,
    ];
    let output = run(&directory, &marked);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let output = run(&directory, &["audit", "paper.tex", "--format", "sarif"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        stdout(&output),
        include_str!("../../examples/ci/baseline.sarif"),
        "make it anew"
    );
}

#[test]
fn a_baseline_of_another_version_is_refused() {
    let scratch = Scratch::new("version");
    scratch.file("right.tex", RIGHT);
    let old = include_str!("../../examples/ci/baseline.sarif").replace("vibroAudit/v2", "vibroAudit/v1");
    scratch.file("old.sarif", &old);
    let output = run(&scratch.0, &["audit", "right.tex", "--baseline", "old.sarif"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    let said = stderr(&output);
    assert!(
        said.contains("old.sarif") && said.contains("version v1") && said.contains("make the baseline anew"),
        "{said}"
    );
}

#[test]
fn repairs_are_written_beside_their_formulas_and_into_no_string() {
    let scratch = Scratch::new("mended");
    let sheet = "title = '''\ntex = 'a - b = b - a'\n'''\n[symbols]\nparameters = ['a', 'b']\n\n[[equation]]\n\
        label = 'one'\nrole = 'claim'\ntex = '''\ntex = \na - b = b - a'''\n\n[[equation]]\nlabel = 'two'\n\
        role = 'claim'\n  tex = \"\"\"(a + b)^2 = \\\n    a^2 + a b + b^2\"\"\" # tex = 'x'\n\n[[equation]]\n\
        label = 'three'\nrole = 'claim'\ntex = 'a b = b a'\n";
    let sheet = sheet.replace("tex = \na - b", "\na - b");
    scratch.file("sheet.toml", &sheet);
    let output = run(&scratch.0, &["audit", "sheet.toml", "--repair-into", "mended.toml"]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let mended = scratch.read("mended.toml");
    let value = |text: &str| text.parse::<toml::Table>().unwrap();
    assert_eq!(value(&mended), value(&sheet));
    let (told, rest): (Vec<&str>, Vec<&str>) = mended
        .lines()
        .partition(|line| line.trim_start().starts_with("# repair of ("));
    assert_eq!(rest, sheet.lines().collect::<Vec<_>>());
    assert_eq!(told.len(), 2, "{mended}");
    let lines: Vec<&str> = mended.lines().collect();
    for (label, key) in [("one", "tex = '''"), ("two", "  tex = \"\"\"")] {
        let place = lines
            .iter()
            .position(|line| line.contains(&format!("# repair of ({label})")))
            .unwrap();
        assert!(lines[place + 1].starts_with(key), "{mended}");
    }
}
