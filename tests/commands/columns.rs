//! What `--columns` says of every command is what the command writes.

use crate::common::program::{run, scratch};
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use vibro_audit::cli::{described, described_commands, schema};
use vibro_audit::report::Form;

/// The form of a value is the one described.
fn is_of(form: Form, value: &Value) -> bool {
    let is_number = |value: &Value| value.is_number() || value.as_str().is_some_and(|text| text.parse::<f64>().is_ok());
    match form {
        Form::Text => value.is_string(),
        Form::Number => is_number(value),
        Form::Numbers => value.as_array().is_some_and(|list| list.iter().all(is_number)),
        Form::Integer => value.is_i64(),
        Form::Flag => value.is_boolean(),
        Form::Decimal => value
            .as_str()
            .is_some_and(|text| text.is_empty() || text.parse::<f64>().is_ok()),
    }
}

fn assert_row(command: &str, row: &Map<String, Value>) {
    for (column, value) in row.iter().filter(|(column, _)| !column.ends_with("_values")) {
        let Some(known) = described(command).find(|known| known.column == *column) else {
            panic!("{command}: `{column}` is not described")
        };
        let is_text_that_is_short = (command, &**column) == ("check", "computed") && value.is_number();
        assert!(
            is_of(known.form, value) || is_text_that_is_short || (known.is_optional && value.is_null()),
            "{command}: {column} is {value}, said to be {:?}, optional {}",
            known.form,
            known.is_optional
        );
    }
    for known in described(command).filter(|known| !known.is_optional) {
        assert!(row.contains_key(&known.column), "{command}: no {}", known.column);
    }
}

/// A few starts at the bottom.
const BASINS: &str =
    "basins={impacts = 80, phase = {from = 0, to = 6, points = 3}, velocity = {from = 0, to = 1, points = 2}}";

#[test]
fn the_columns_of_every_command_are_as_described() {
    let scratch = scratch("described");
    std::fs::create_dir_all(scratch.join("golden/reference")).expect("a directory");
    let path = |name: &str| scratch.path(name);
    let answers = scratch.file("answers.csv", "problem,quantity,answer\nimpact-fast,time,1.7\n");
    let sheet = scratch.file(
        "sheet.toml",
        "[[equation]]\nlabel = 'a'\nrole = 'claim'\ntex = '(T + d)^2 = T^2 + d^2'\n",
    );
    scratch.file(
        "golden/printed.csv",
        "id,place,scene,set,quantity,printed,unit,expected,rests_on,note\n\
         a,p. 1,fig02,motion.d=0.4,orbits.velocities[0],0.83272,,reproduced,,\n",
    );
    scratch.file(
        "golden/reference/mine.csv",
        "id,scene,set,quantity,value,by,confirmed_by\nb,fig02,motion.d=0.4,orbits.trace,,,\n",
    );
    let words = "words=[\"BT\", \"BBT\", \"B\"]";
    let few = ["--set", "sweep.points=3"];
    let swept = [
        "--set",
        "sweep.over=r_b",
        "--set",
        "sweep.from=0.4",
        "--set",
        "sweep.to=0.6",
        "--set",
        "sweep.points=2",
    ];
    let (golden, pages, figures, files) = (path("golden"), path("man"), path("figures"), path("files"));
    let runs: &[(&str, Vec<&str>)] = &[
        ("audit", vec!["audit"]),
        ("audit", vec!["audit", &sheet, "--repair"]),
        ("check --bless", vec!["check", &golden, "--bless"]),
        ("check", vec!["check", &golden]),
        ("orbits", vec!["orbits", "fig02", "--set", words]),
        ("orbits", vec!["orbits", "fig02", "--digits", "30"]),
        ("branch", [&["branch", "fig02", "--set", words][..], &few].concat()),
        ("branch", [&["branch", "fig03"][..], &swept].concat()),
        (
            "simulate",
            vec!["simulate", "fig03", "--set", "motion.d=0.18", "--until", "6.5"],
        ),
        (
            "simulate",
            vec!["simulate", "fig03", "--impacts", "9", "--proved", "--digits", "20"],
        ),
        ("trajectory", vec!["trajectory", "fig12", "--samples", "5"]),
        ("trajectory", vec!["trajectory", "fig02", "--samples", "5"]),
        ("sweep", [&["sweep", "fig03"][..], &few].concat()),
        ("sweep", [&["sweep", "fig03"][..], &swept].concat()),
        (
            "sweep --summary",
            [&["sweep", "fig03", "--summary", "--set", "sweep.error=0.1"][..], &few].concat(),
        ),
        ("plot all", [&["plot", "all", "--out", &figures][..], &few].concat()),
        ("scenes", vec!["scenes"]),
        ("run", [&["run", "fig03", "--out", &files][..], &few].concat()),
        ("trade", vec!["trade", "multipliers"]),
        ("trade --problems", vec!["trade", "multipliers", "--problems"]),
        (
            "trade --advise",
            vec!["trade", "--advise", "digits=3,task=multipliers/random"],
        ),
        (
            "map",
            vec![
                "map",
                "fig03",
                "--set",
                r#"map={impacts = 80, x = {over = "d", from = 0.1, to = 0.5, points = 9}, y = {over = "r_b", from = 0.3, to = 0.9, points = 2}}"#,
            ],
        ),
        ("basins", vec!["basins", "fig03", "--set", BASINS]),
        (
            "basins --attractors",
            vec!["basins", "fig03", "--set", BASINS, "--attractors"],
        ),
        (
            "optimise",
            vec!["optimise", "fig03", "--set", "box={d = [0.3, 0.5], r_b = [0.5, 0.7]}"],
        ),
        ("stress", vec!["stress", "Delta"]),
        ("stress --curve", vec!["stress", "Delta", "--curve"]),
        ("problems", vec!["problems", "--level", "easy"]),
        ("problems", vec!["problems", "--level", "easy", "--without-answers"]),
        ("problems --solve", vec!["problems", "--solve", "--kind", "impact"]),
        ("score", vec!["score", &answers, "--kind", "impact"]),
        (
            "score",
            vec![
                "score",
                "--exec",
                "cat >/dev/null; echo problem,quantity,answer",
                "--kind",
                "impact",
            ],
        ),
        (
            "score --summary",
            vec!["score", &answers, "--kind", "impact", "--summary"],
        ),
        (
            "score --summary",
            vec![
                "score",
                "--exec",
                "cat >/dev/null; echo problem,quantity,answer",
                "--kind",
                "impact",
                "--summary",
            ],
        ),
        ("man", vec!["man", &pages]),
    ];
    let mut shown = BTreeSet::new();
    for (command, arguments) in runs {
        let text = run(&[&arguments[..], &["--format", "json"]].concat()).stdout;
        let rows: Vec<Map<String, Value>> =
            serde_json::from_str(&text).unwrap_or_else(|error| panic!("{arguments:?}: {error} in {text:.400}"));
        assert!(!rows.is_empty(), "{arguments:?}");
        let first = text.lines().nth(1).unwrap_or_default();
        let places = described(command).filter_map(|known| first.find(&format!("\"{}\":", known.column)));
        assert!(places.is_sorted(), "{command}: the order is another");
        for row in &rows {
            assert_row(command, row);
            let there = row.iter().filter(|(_, value)| !value.is_null());
            shown.extend(there.map(|(column, _)| (*command, column.clone())));
        }
    }
    // every column that is described was seen, but those that only other scenes have
    let rare = ["incline", "g", "forcing_amplitude", "provided", "r_t"];
    for command in described_commands() {
        for known in described(command) {
            let is_seen = shown
                .iter()
                .any(|(own, column)| *own == command && *column == known.column);
            assert!(
                is_seen || rare.contains(&&*known.column) || known.is_optional,
                "{command}: {}",
                known.column
            );
        }
    }
    let seen: BTreeSet<&str> = shown.iter().map(|(command, _)| *command).collect();
    assert_eq!(seen, described_commands().into_iter().collect(), "every command is run");
}

#[test]
fn columns_are_printed_as_a_table_and_as_a_schema() {
    let table = run(&["--columns", "sweep --summary", "--format", "csv"]).stdout;
    assert!(
        table.starts_with("command,column,type,unit,optional,meaning,version\n"),
        "{table}"
    );
    assert_eq!(table.lines().count(), described("sweep --summary").count() + 1);
    let printed: Value = serde_json::from_str(&run(&["--columns", "orbits", "--schema"]).stdout).expect("JSON");
    assert_eq!(printed, schema("orbits"));
    assert!(printed.pointer("/items/properties/velocities/anyOf").is_some());
}

#[test]
fn a_command_that_has_no_columns_is_refused_and_named() {
    for arguments in [
        &["--columns", "sweeps"][..],
        &["--schema"],
        &["--columns", "orbits", "scenes"],
        &["--digits", "3"],
    ] {
        let message = run(arguments).refused(&[]);
        assert!(!message.is_empty(), "{arguments:?}");
    }
}

#[test]
fn shells_complete_and_manuals_name_every_command() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = run(&["completions", shell]).stdout;
        assert!(
            ["orbits", "digits", "completions"]
                .iter()
                .all(|word| script.contains(word)),
            "{shell}"
        );
    }
    let scratch = scratch("man");
    run(&["man", &scratch.path("pages")]);
    let page = |name: &str| scratch.read(&format!("pages/{name}"));
    assert!(page("vibro-audit.1").contains("orbits"));
    assert!(page("vibro-audit-simulate.1").contains("impacts"));
}
