//! `audit` of several files, of documents with printed numbers, and against a baseline: one document of the format, one status.

use crate::common::program::{Ran, program, scratch};
use std::path::Path;

fn json(ran: &Ran) -> serde_json::Value {
    serde_json::from_str(&ran.stdout).unwrap_or_else(|error| panic!("{error}: {}", ran.stderr))
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
    let scratch = scratch("numbers");
    scratch.file("notes.md", NOTES);
    let of = |format: &str| {
        let ran = scratch.run(&["audit", "notes.md", "--format", format]);
        assert_eq!(ran.status, Some(0), "{format}: {}", ran.stderr);
        ran
    };
    let both = json(&of("json"));
    let keys: Vec<&String> = both.as_object().expect("one object").keys().collect();
    assert_eq!(keys, ["formulas", "numbers"]);
    assert_eq!(
        (&both["formulas"][0]["verdict"], &both["numbers"][0]["verdict"]),
        (&"refuted".into(), &"reproduced".into())
    );
    let csv = of("csv").stdout;
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
    for line in of("jsonl").stdout.lines() {
        serde_json::from_str::<serde_json::Map<_, _>>(line).unwrap_or_else(|error| panic!("{error}: {line:?}"));
    }
    assert!(json(&of("sarif"))["runs"].is_array());
    let junit = of("junit").stdout;
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
    let scratch = scratch("baseline");
    scratch.file(
        "notes.md",
        NOTES.replace("; expect refuted", "").replace("0.83272", "0.9"),
    );
    for format in ["json", "jsonl", "csv", "sarif"] {
        scratch.run(&["audit", "notes.md", "--format", format, "--out", "known"]);
        let ran = scratch.run(&["audit", "notes.md", "--baseline", "known", "--format", "json"]);
        // the number is no finding that a baseline knows
        assert_eq!(ran.status, Some(1), "{format}: {}", ran.stderr);
        assert!(!ran.stderr.contains("not found any more"), "{format}: {}", ran.stderr);
        assert_eq!(json(&ran)["formulas"][0]["expected"], "refuted", "{format}");
    }
}

/// A notebook as Jupyter writes it: a cell of code, then one with this text.
fn notebook(text: &str) -> String {
    let lines = |text: &str| text.split_inclusive('\n').map(str::to_owned).collect::<Vec<_>>();
    let cells = serde_json::json!([
        {"cell_type": "code", "execution_count": null, "outputs": [], "source": lines("print('$$ 1 = 2 $$')\n")},
        {"cell_type": "markdown", "source": lines(text)},
    ]);
    let all = serde_json::json!({"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5});
    format!("{all:#}\n")
}

#[test]
fn notebooks_and_quarto_documents_are_read_as_markdown_with_the_lines_of_the_file() {
    let text =
        "---\ntitle: Fall\n---\n\n$$ (a+b)^2 = a^2 + b^2 $$ {#eq-square}\n\n<!-- audit: claim -->\n$$ 2 a = a + a $$\n";
    let claim = format!(
        "<!-- audit: symbols a, b; claim; expect refuted -->\n{}",
        text.replace("---", "***")
    );
    let scratch = scratch("kinds");
    for (name, text) in [
        ("notes.qmd", text.to_owned()),
        ("notes.Rmd", text.to_owned()),
        ("notes.ipynb", notebook(text)),
    ] {
        scratch.file(name, &text);
        let rows = json(&scratch.run(&["audit", name, "--format", "json"]));
        let line = |formula: &str| 1 + text.lines().position(|line| line.contains(formula)).unwrap();
        let found = |row: usize| {
            rows[row]["place"]
                .as_str()
                .unwrap()
                .split(':')
                .next()
                .unwrap()
                .parse::<usize>()
        };
        assert_eq!(rows.as_array().unwrap().len(), 2, "{name}: {rows}");
        assert_eq!(rows[0]["label"], "eq-square", "{name}");
        assert_eq!(
            (found(0), found(1)),
            (Ok(line("(a+b)^2")), Ok(line("2 a = a + a"))),
            "{name}: {rows}"
        );
        assert_eq!(rows[1]["verdict"], "proved", "{name}");
    }
    // a repair is a comment in the cell, which changes no verdict
    scratch.file("claim.ipynb", notebook(&claim));
    let ran = scratch.run(&["audit", "claim.ipynb", "--repair-into", "mended.ipynb"]);
    assert_eq!(ran.status, Some(0), "{}", ran.stderr);
    let mended = std::fs::read_to_string(scratch.path("mended.ipynb")).unwrap();
    let cells: serde_json::Value = serde_json::from_str(&mended).expect("still a notebook");
    let cell = cells["cells"][1]["source"].to_string();
    assert!(cell.contains("<!-- repair of (eq-square)"), "{cell}");
    assert_eq!(scratch.run(&["audit", "mended.ipynb"]).status, Some(0));
    // what is no notebook is no panic and no empty pass
    scratch.file("broken.ipynb", "{\"cells\": 1}");
    let ran = scratch.run(&["audit", "broken.ipynb"]);
    assert_eq!(ran.status, Some(2));
    assert!(ran.stderr.contains("broken.ipynb: no notebook"), "{}", ran.stderr);
}

#[test]
fn standard_input_has_the_name_and_the_neighbours_of_the_file_it_stands_for() {
    let scratch = scratch("stdin");
    std::fs::create_dir_all(scratch.path("part")).unwrap();
    scratch.file("part/macros.tex", "\\newcommand{\\both}{a + b}\n");
    let text = "\\input{macros}\n$$ \\both = b + a $$\n";
    let named = ["audit", "-", "--stdin-name", "part/paper.tex", "--format", "json"];
    let ran = program(named).within(scratch.path("")).input(text).run();
    assert_eq!(json(&ran)[0]["verdict"], "proved", "{}", ran.stderr);
    assert!(ran.stderr.contains("part/paper.tex: "), "{}", ran.stderr);
    // no form is guessed where the name says it
    let sheet = ["audit", "-", "--stdin-name", "sheet.toml"];
    assert_eq!(program(sheet).input(SHEET).run().status, Some(0));
    let without = scratch.run(&["audit", "part/macros.tex", "--stdin-name", "paper.tex"]);
    assert_eq!(without.status, Some(2));
    assert!(without.stderr.contains("--stdin-name names `-`"), "{}", without.stderr);
}

#[test]
fn several_files_are_one_table_with_the_worst_status() {
    let scratch = scratch("several");
    scratch.file("right.tex", RIGHT);
    scratch.file("wrong.tex", WRONG);
    scratch.file("sheet.toml", SHEET);
    scratch.file("notes.md", NOTES);
    scratch.file("broken.toml", "[[equation]\n");
    let files = |ran: &Ran| -> Vec<String> {
        let rows = json(ran);
        let rows = rows.as_array().expect("one array").iter();
        rows.map(|row| format!("{} {}", row["file"].as_str().unwrap(), row["verdict"].as_str().unwrap()))
            .collect()
    };
    let ran = scratch.run(&["audit", "right.tex", "sheet.toml", "--format", "json"]);
    assert_eq!(
        (ran.status, files(&ran)),
        (
            Some(0),
            vec!["right.tex proved".to_owned(), "sheet.toml proved".to_owned()]
        )
    );
    let ran = scratch.run(&["audit", "wrong.tex", "right.tex", "--format", "json"]);
    assert_eq!(
        (ran.status, files(&ran)),
        (
            Some(1),
            vec!["wrong.tex refuted".to_owned(), "right.tex proved".to_owned()]
        )
    );
    // one that cannot be used, or is not there, stops no other
    let all = ["audit", "broken.toml", "wrong.tex", "none.tex", "sheet.toml"];
    let ran = scratch.run(&[&all[..], &["--format", "json"]].concat());
    assert_eq!(
        (ran.status, files(&ran)),
        (
            Some(2),
            vec!["wrong.tex refuted".to_owned(), "sheet.toml proved".to_owned()]
        )
    );
    assert!(ran.stderr.contains("broken.toml") && ran.stderr.contains("none.tex"));
    // the last column, and none of one file
    let head = |arguments: &[&str]| {
        let ran = scratch.run(&[arguments, &["--format", "csv"]].concat());
        ran.stdout.lines().next().unwrap_or_default().to_owned()
    };
    assert!(head(&["audit", "right.tex", "sheet.toml"]).ends_with(",file"));
    assert!(head(&["audit", "notes.md", "sheet.toml"]).ends_with(",file"));
    assert!(!head(&["audit", "right.tex"]).contains("file"));
    // the others are one document too
    let both = ["audit", "wrong.tex", "notes.md"];
    let log = json(&scratch.run(&[&both[..], &["--format", "sarif"]].concat()));
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
    let junit = scratch.run(&[&both[..], &["--format", "junit"]].concat()).stdout;
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
    let both = json(&scratch.run(&[&both[..], &["--format", "json"]].concat()));
    assert_eq!(both["formulas"].as_array().unwrap().len(), 3);
    assert_eq!(both["numbers"][0]["file"], "notes.md");
    // what a baseline knows of any of them
    scratch.run(&["audit", "wrong.tex", "right.tex", "--format", "sarif", "--out", "known"]);
    scratch
        .run(&["audit", "right.tex", "wrong.tex", "--baseline", "known"])
        .succeeded();
}

#[test]
fn a_report_for_machines_names_what_cannot_be_used() {
    let scratch = scratch("unusable");
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
            let ran = scratch.run(&[&["audit"], arguments, &["--format", format]].concat());
            assert_eq!(ran.status, Some(2), "{}", ran.stderr);
            ran
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
        let junit = of("junit").stdout;
        let junit = roxmltree::Document::parse(&junit).unwrap();
        let failed = junit
            .descendants()
            .filter(|node| node.attribute("type") == Some("unusable"));
        assert_eq!(failed.count(), wanted.len());
    }
}

#[test]
fn what_is_of_one_file_is_refused_for_several() {
    let scratch = scratch("one");
    scratch.file("right.tex", RIGHT);
    scratch.file("wrong.tex", WRONG);
    for (flag, arguments) in [
        ("--explain", &["--explain", "1"][..]),
        ("--draft", &["--draft"]),
        ("--proof", &["--proof", "proofs"]),
        ("--repair-into", &["--repair-into", "mended.tex"]),
        ("--format html", &["--format", "html"]),
    ] {
        let ran = scratch.run(&[&["audit", "right.tex", "wrong.tex"], arguments].concat());
        ran.refused(&[&format!("{flag} is of one file, and 2 are named")]);
    }
    assert!(!scratch.join("proofs").exists() && !scratch.join("mended.tex").exists());
    let ran = scratch.run(&["audit", "-", "-"]);
    assert_eq!(ran.status, Some(2));
    assert!(ran.stderr.contains("read once"), "{}", ran.stderr);
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
    let scratch = scratch("hook");
    scratch.file("main.tex", RIGHT);
    scratch.file("--out=main.tex", WRONG);
    scratch.file("--format=json", SHEET);
    // as pre-commit calls it: entry, args, names of files
    let ran = scratch.run(&["audit", "--", "--out=main.tex", "main.tex", "--format=json"]);
    assert_eq!(ran.status, Some(1), "{}", ran.stderr);
    assert_eq!(scratch.read("main.tex"), RIGHT);
    assert!(ran.stdout.contains("--out=main.tex"));
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
        let ran = program(command).within(&directory).run();
        assert_eq!(ran.status, Some(0), "{command:?}: {}", ran.stderr);
        assert!(
            ran.stdout.contains("known from the baseline") && ran.stderr.is_empty(),
            "{}",
            ran.stderr
        );
    }
    // what the workflow runs, and what makes the baseline
    let scratch = scratch("ci");
    let out = scratch.path("audit.sarif");
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
    program(marked).within(&directory).run().succeeded();
    let ran = program(["audit", "paper.tex", "--format", "sarif"])
        .within(&directory)
        .run();
    assert_eq!(ran.status, Some(1));
    assert_eq!(
        ran.stdout,
        include_str!("../../examples/ci/baseline.sarif"),
        "make it anew"
    );
}

#[test]
fn a_baseline_of_another_version_is_refused() {
    let scratch = scratch("version");
    scratch.file("right.tex", RIGHT);
    let old = include_str!("../../examples/ci/baseline.sarif").replace("vibroAudit/v2", "vibroAudit/v1");
    scratch.file("old.sarif", &old);
    let ran = scratch.run(&["audit", "right.tex", "--baseline", "old.sarif"]);
    assert_eq!(ran.status, Some(2), "{}", ran.stderr);
    let said = ran.stderr;
    assert!(
        said.contains("old.sarif") && said.contains("version v1") && said.contains("make the baseline anew"),
        "{said}"
    );
}

#[test]
fn repairs_are_written_beside_their_formulas_and_into_no_string() {
    let scratch = scratch("mended");
    let sheet = "title = '''\ntex = 'a - b = b - a'\n'''\n[symbols]\nparameters = ['a', 'b']\n\n[[equation]]\n\
        label = 'one'\nrole = 'claim'\ntex = '''\ntex = \na - b = b - a'''\n\n[[equation]]\nlabel = 'two'\n\
        role = 'claim'\n  tex = \"\"\"(a + b)^2 = \\\n    a^2 + a b + b^2\"\"\" # tex = 'x'\n\n[[equation]]\n\
        label = 'three'\nrole = 'claim'\ntex = 'a b = b a'\n";
    let sheet = sheet.replace("tex = \na - b", "\na - b");
    scratch.file("sheet.toml", &sheet);
    let ran = scratch.run(&["audit", "sheet.toml", "--repair-into", "mended.toml"]);
    assert_eq!(ran.status, Some(1), "{}", ran.stderr);
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
