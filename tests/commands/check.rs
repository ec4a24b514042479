//! Golden values as their users meet them: the paper's, and a directory of one's own with everything that can be
//! wrong about it.

use crate::common::program::{Ran, Scratch, run, scratch};
use std::collections::HashSet;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

const HEADER: &str = "id,place,scene,set,quantity,printed,unit,expected,rests_on,note";
const SCENE: &str = "[device]\ncapsule_mass = 0.1245\nforcing_amplitude = 5.0\nincline = \"pi/6\"\ngravity = 9.8\n\
                     [motion]\nd = 0.26\nr_b = 0.5\nr_t = 0.5\n";
/// A row that holds.
const RIGHT: &str = "g,section 2,scenes/own.toml,,motion.g,0.12201,,reproduced,forcing_amplitude,";

fn check(arguments: &[&str]) -> Ran {
    run(&[&["check"], arguments].concat())
}

/// A directory of golden values of its own for each test, removed at its end.
pub struct Golden(Scratch);

impl Golden {
    fn new(name: &str, rows: &[&str]) -> Self {
        let golden = Self(scratch(name));
        fs::create_dir(golden.0.join("scenes")).unwrap();
        golden.write("printed.csv", format!("{HEADER}\n{}\n", rows.join("\n")));
        golden.write("scenes/own.toml", SCENE);
        golden
    }

    /// The paper's own directory, copied, with those of its printed rows alone; without the certified values, each of which
    /// costs a search.
    pub fn paper(name: &str, is_kept: impl FnMut(&&str) -> bool) -> Self {
        let golden = Self::new(name, &[]);
        copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/paper"), &golden.0);
        fs::remove_dir_all(golden.0.join("reference")).unwrap();
        let text = golden.0.read("printed.csv");
        let rows: Vec<&str> = text.lines().skip(1).filter(is_kept).collect();
        golden.write("printed.csv", format!("{HEADER}\n{}\n", rows.join("\n")));
        golden
    }

    fn write(&self, file: &str, text: impl AsRef<[u8]>) {
        self.0.file(file, text);
    }

    pub fn path(&self) -> &str {
        self.0.to_str().unwrap()
    }

    /// Status and rows by id: verdict, expected, reason.
    fn verdicts(&self) -> (Option<i32>, Vec<[String; 4]>) {
        let ran = check(&[self.path(), "--format", "csv"]);
        let mut reader = csv::Reader::from_reader(ran.stdout.as_bytes());
        let headers = reader.headers().unwrap().clone();
        let rows = reader.records().map(|record| {
            let record = record.unwrap();
            ["id", "verdict", "expected", "reason"].map(|name| {
                let index = headers.iter().position(|column| column == name).unwrap();
                record[index].to_owned()
            })
        });
        (ran.status, rows.collect())
    }

    /// Asserts that the directory is refused: status 2, nothing on stdout, one message that has `words`.
    fn assert_refused(&self, words: &[&str]) {
        assert_refused(&[self.path()], words);
    }
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).unwrap();
        }
    }
}

fn assert_refused(arguments: &[&str], words: &[&str]) {
    let ran = check(arguments);
    let message = ran.stderr;
    assert_eq!(ran.status, Some(2), "{arguments:?}: {message}");
    // a row that is at fault has no verdict, the others have theirs
    let verdicts = ran.stdout;
    assert!(verdicts.lines().count() <= 4, "{arguments:?}: {verdicts}");
    assert!(
        message.starts_with("error: ") && message.trim_end().lines().count() == 1,
        "{message}"
    );
    assert!(!message.contains("panicked"), "{message}");
    for word in words {
        assert!(message.contains(word), "{arguments:?} does not say `{word}`: {message}");
    }
}

#[test]
fn a_directory_of_one_s_own_is_held_against_its_own_scenes() {
    let golden = Golden::new("own", &[RIGHT]);
    let (status, rows) = golden.verdicts();
    assert_eq!(status, Some(0));
    assert_eq!(rows, [["g", "reproduced", "reproduced", ""].map(str::to_owned)]);
    golden.write("scenes/own.toml", SCENE.replace("9.8", "9.9"));
    let (status, rows) = golden.verdicts();
    assert_eq!(status, Some(1));
    let reason = &rows[0][3];
    assert!(
        reason.starts_with(
            "EXPECTED reproduced, IS wrong: differs from the 3rd figure on: printed 0.12201, computed 0.123255"
        ),
        "{reason}"
    );
}

#[test]
fn a_last_figure_changed_by_five_changes_verdict_and_status() {
    for printed in ["0.12206", "0.12196"] {
        let golden = Golden::new(&format!("five-{printed}"), &[&RIGHT.replace("0.12201", printed)]);
        let (status, rows) = golden.verdicts();
        assert_eq!((status, rows[0][1].as_str()), (Some(1), "rounded"), "{printed}");
    }
}

#[test]
fn missing_and_empty_files_are_failures_and_never_created() {
    assert_refused(&["no/such/directory"], &["there is no directory no/such/directory"]);
    let golden = Golden::new("missing", &[RIGHT]);
    fs::remove_file(golden.0.join("printed.csv")).unwrap();
    golden.assert_refused(&["printed.csv", "there is no such file", "`check DIR --add` alone makes"]);
    assert!(!golden.0.join("printed.csv").exists());
    for (text, words) in [
        ("", "it is empty"),
        ("\n \n", "it is empty"),
        (HEADER, "has a header and no rows"),
    ] {
        golden.write("printed.csv", text);
        golden.assert_refused(&["printed.csv", words]);
    }
    golden.write("printed.csv", [0xff, 0xfe, 0x00]);
    golden.assert_refused(&["printed.csv", "not UTF-8 from byte 0"]);
    let file = golden.0.join("scenes/own.toml");
    assert_refused(&[file.to_str().unwrap()], &["there is no directory"]);
    fs::remove_file(golden.0.join("printed.csv")).unwrap();
    fs::create_dir(golden.0.join("printed.csv")).unwrap();
    golden.assert_refused(&["it is a directory"]);
}

/// The arguments that add a row of the scene `scenes/own.toml`, which is right as it stands.
const ADDED: [&str; 10] = [
    "--add",
    "added",
    "--place",
    "section 2, \"g\"",
    "--scene",
    "scenes/own.toml",
    "--quantity",
    "motion.g",
    "--printed",
    "0.12201",
];

/// Adds a row whose arguments are `ADDED` but for these, the last of which win.
fn add(golden: &Path, other: &[(&str, &str)]) -> (Option<i32>, String, String) {
    let mut arguments = vec![golden.to_str().unwrap().to_owned()];
    for pair in ADDED.chunks(2) {
        let value = other
            .iter()
            .find(|(name, _)| *name == pair[0])
            .map_or(pair[1], |(_, value)| value);
        arguments.push(format!("{}={value}", pair[0]));
    }
    let more = other.iter().filter(|(name, _)| !ADDED.contains(name));
    arguments.extend(more.map(|(name, value)| format!("{name}={value}")));
    let ran = check(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
    (ran.status, ran.stdout, ran.stderr)
}

#[test]
fn a_row_is_added_where_its_verdict_is_the_expected_one() {
    let golden = Golden::new("add", &[RIGHT]);
    let before = golden.0.read("printed.csv");
    let (status, table, message) = add(&golden.0, &[("--format", "csv"), ("--unit", "m")]);
    assert_eq!(status, Some(0), "{message}");
    assert!(
        table.lines().count() == 2 && table.contains(",reproduced,reproduced,"),
        "{table}"
    );
    assert!(message.contains("`added` is line 3 of "), "{message}");
    let after = golden.0.read("printed.csv");
    let row = "added,\"section 2, \"\"g\"\"\",scenes/own.toml,,motion.g,0.12201,m,reproduced,,\n";
    assert_eq!(after, before + row);
    assert_eq!(golden.verdicts().0, Some(0));
    // what is not as expected is shown, not added, and the message says how it would be
    let wrong = [("--add", "other"), ("--printed", "-0.5")];
    let (status, table, message) = add(&golden.0, &wrong);
    assert_eq!(status, Some(1), "{message}");
    assert!(table.contains("EXPECTED reproduced, IS wrong"), "{table}");
    assert!(
        message.contains("`other` is not added") && message.contains("--expected wrong"),
        "{message}"
    );
    assert_eq!(golden.0.read("printed.csv"), after);
    let (status, ..) = add(
        &golden.0,
        &[&wrong[..], &[("--expected", "wrong"), ("--set", "motion.d=0.3")]].concat(),
    );
    assert_eq!(status, Some(0));
    let added = golden.0.read("printed.csv");
    assert!(
        added.ends_with("scenes/own.toml,motion.d=0.3,motion.g,-0.5,,wrong,,\n"),
        "{added}"
    );
}

#[test]
fn the_first_row_makes_a_directory_that_stands_alone() {
    let scratch = Golden::new("begin", &[]);
    let scene = scratch.0.join("scenes/own.toml");
    let [mine, other] = ["mine/deep", "other"].map(|name| scratch.0.join(name));
    let of_file = [("--scene", scene.to_str().unwrap())];
    let (status, _, message) = add(&mine, &of_file);
    assert_eq!(status, Some(0), "{message}");
    assert!(message.contains("the scene is copied to"), "{message}");
    assert_eq!(fs::read_to_string(mine.join("scenes/own.toml")).unwrap(), SCENE);
    let text = fs::read_to_string(mine.join("printed.csv")).unwrap();
    assert!(text.starts_with(&format!("{HEADER}\nadded,")), "{text}");
    // the same scene is there, another of its name is not written over
    let again = [of_file[0], ("--add", "again")];
    assert_eq!(add(&mine, &again).0, Some(0));
    scratch.write("scenes/own.toml", SCENE.replace("0.26", "0.27"));
    let (status, _, message) = add(&mine, &[of_file[0], ("--add", "third")]);
    assert_eq!(status, Some(2));
    assert!(message.contains("another scene than"), "{message}");
    fs::rename(&mine, &other).unwrap();
    let moved = check(&[other.to_str().unwrap()]);
    assert_eq!(moved.status, Some(0), "{}", moved.stdout);
    // of what cannot be a row nothing remains
    let (status, ..) = add(&mine, &[of_file[0], ("--quantity", "motion.speed")]);
    assert!(status == Some(2) && !mine.exists());
}

#[test]
fn a_scene_that_no_row_names_is_said() {
    let golden = Golden::new("unused", &[&RIGHT.replace("scenes/own.toml", "./scenes/own.toml")]);
    golden.write("scenes/other.toml", SCENE);
    let ran = check(&[golden.path()]);
    let message = ran.stderr;
    assert_eq!(ran.status, Some(0), "{message}");
    assert!(
        message.contains("scenes/other.toml: no row names this scene") && !message.contains("own.toml"),
        "{message}"
    );
}

#[test]
fn numbers_are_held_as_papers_print_them_and_each_verdict_can_be_expected() {
    // the computed value is 0.12201, and 0.101675 of six newtons
    let rows = [
        ("a", r"1.2201 \times 10^{-1}", "reproduced"),
        ("b", "0.12202(2)", "reproduced"),
        ("c", "0.12", "reproduced"),
        ("d", r"0.1219 \pm 0.0002", "reproduced"),
        ("e", "0.1016", "truncated"),
        ("f", "0.1221", "off-by-one"),
        ("g", "0.1225", "rounded"),
        ("h", "0.13", "off-by-one"),
        ("i", "0.2", "off-by-one"),
        ("j", "0.9", "wrong"),
    ];
    let expecting = |expected: fn(&'static str) -> &'static str| {
        let row = |(id, printed, verdict)| {
            let expected = expected(verdict);
            let set = if id == "e" { "device.forcing_amplitude=6" } else { "" };
            format!("{id},p,scenes/own.toml,{set},motion.g,{printed},,{expected},,")
        };
        let lines: Vec<String> = rows.map(row).to_vec();
        let golden = Golden::new("as-printed", &lines.iter().map(String::as_str).collect::<Vec<_>>());
        let (status, found) = golden.verdicts();
        let found: Vec<String> = found.into_iter().map(|row| row[1].clone()).collect();
        assert_eq!(found, rows.map(|row| row.2));
        status
    };
    assert_eq!(expecting(|verdict| verdict), Some(0));
    assert_eq!(expecting(|_| "reproduced"), Some(1));
}

#[test]
fn rows_that_are_added_at_once_are_all_there() {
    let scratch = Golden::new("at-once", &[]);
    let mine = scratch.0.join("mine/deep");
    let scene = scratch.0.join("scenes/own.toml");
    let ids: Vec<String> = (1..=6).map(|number| format!("row-{number}")).collect();
    std::thread::scope(|scope| {
        for id in &ids {
            let given = [("--scene", scene.to_str().unwrap()), ("--add", id.as_str())];
            let mine = &mine;
            scope.spawn(move || assert_eq!(add(mine, &given).0, Some(0)));
        }
    });
    let text = fs::read_to_string(mine.join("printed.csv")).unwrap();
    let mut found: Vec<&str> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').next().unwrap())
        .collect();
    found.sort_unstable();
    assert_eq!(found, ids);
    let mut names: Vec<String> = fs::read_dir(&mine)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert_eq!(names, ["printed.csv", "scenes"]);
}

#[test]
fn what_makes_no_row_is_refused_by_column_and_changes_nothing() {
    let golden = Golden::new("add-bad", &[RIGHT]);
    let before = golden.0.read("printed.csv");
    let printed = golden.0.join("printed.csv");
    for (other, words) in [
        (("--add", "g"), "--add, column `id`: `g` stands on line 2 already"),
        (("--add", " "), "--add, column `id`: it is empty"),
        (("--place", ""), "--add, column `place`: it is empty"),
        (
            ("--quantity", "speed"),
            "--add, column `quantity`: `speed` is no quantity",
        ),
        (("--quantity", ""), "--add, column `quantity`: it is empty"),
        (
            ("--quantity", "motion.speed"),
            "--add, column `quantity`: there is no column `speed`",
        ),
        (("--printed", "NaN"), "--add, column `printed`: `NaN` is not a number"),
        (("--set", "motion.d"), "--add, column `set`: `motion.d` is no setting"),
        (("--set", "motion.r_b=2"), "from 0 to 1"),
        (("--scene", "none.toml"), "none.toml: there is no such file"),
        (("--scene", "fig99"), "no built-in scene `fig99`"),
        (("--scene", ""), "--add: no scene is named"),
        (
            ("--expected", "undecided"),
            "--add, column `expected`: `undecided` is no verdict to expect",
        ),
        (("--out", printed.to_str().unwrap()), "cannot hold both"),
    ] {
        let (status, table, message) = add(&golden.0, &[other]);
        assert!(status == Some(2) && table.is_empty(), "{other:?}: {message}");
        assert!(
            message.starts_with("error: ") && message.contains(words),
            "{other:?}: {message}"
        );
        assert_eq!(fs::read_to_string(&printed).unwrap(), before, "{other:?}");
    }
    // a file that makes no sense is named, whatever the row
    golden.write("printed.csv", before.replacen("reproduced", "right", 1));
    let (status, _, message) = add(&golden.0, &[]);
    assert_eq!(status, Some(2));
    assert!(message.contains("printed.csv, line 2, column `expected`"), "{message}");
    for arguments in [
        &["--add", "a", "--place", "p", "--printed", "1"][..],
        &["golden", "--place", "p"],
        &["golden", "--add", "a"],
    ] {
        let ran = check(arguments);
        assert_eq!(ran.status, Some(2), "{arguments:?}");
    }
}

#[test]
fn what_is_wrong_in_printed_csv_is_named_by_file_line_and_column() {
    for (case, row, words) in [
        (
            "verdict",
            "a,p,scenes/own.toml,,motion.g,1,,right,,",
            vec![
                "line 3, column `expected`",
                "`right` is no verdict",
                "reproduced, truncated, off-by-one, rounded, wrong and undetermined",
            ],
        ),
        (
            "number",
            "a,p,scenes/own.toml,,motion.g,1.2.3,,wrong,,",
            vec!["line 3, column `printed`", "`1.2.3` is not a number"],
        ),
        (
            "nan",
            "a,p,scenes/own.toml,,motion.g,NaN,,wrong,,",
            vec!["column `printed`", "`NaN` is not a number"],
        ),
        (
            "empty",
            "a,p,scenes/own.toml,,motion.g,,,wrong,,",
            vec!["column `printed`", "it is empty"],
        ),
        (
            "twice",
            "g,p,scenes/own.toml,,motion.g,1,,wrong,,",
            vec!["line 3, column `id`", "`g` stands on line 2 already"],
        ),
        (
            "short",
            "a,p,scenes/own.toml",
            vec!["line 3", "3 fields where the header has 10"],
        ),
        (
            "quote",
            "a,\"p,scenes/own.toml,,motion.g,1,,wrong,,",
            vec!["line 3", "double quotes"],
        ),
        (
            "column",
            "a,p,scenes/own.toml,,motion.speed,1,,wrong,,",
            vec!["column `quantity`", "no column `speed`", "g, d, r_b, r_t"],
        ),
        (
            "quantity",
            "a,p,scenes/own.toml,,speed,1,,wrong,,",
            vec!["column `quantity`", "`speed` is no quantity"],
        ),
        (
            "command",
            "a,p,scenes/own.toml,,sail.d,1,,wrong,,",
            vec!["line 3", "no command `sail`", "inferred"],
        ),
        (
            "set",
            "a,p,scenes/own.toml,d,motion.d,1,,wrong,,",
            vec!["column `set`", "`d` is no setting"],
        ),
        (
            "key",
            "a,p,scenes/own.toml,motion.e=1,motion.d,1,,wrong,,",
            vec!["line 3", "scenes/own.toml", "motion.e"],
        ),
        (
            "value",
            "a,p,scenes/own.toml,motion.r_b=1.5,motion.d,1,,wrong,,",
            vec!["line 3", "1.5", "from 0 to 1"],
        ),
        (
            "nan-value",
            "a,p,scenes/own.toml,motion.d=nan,motion.d,1,,wrong,,",
            vec!["line 3", "nan"],
        ),
        (
            "row",
            "a,p,scenes/own.toml,row.d=9,motion.d,1,,wrong,,",
            vec!["column `quantity`", "no row is meant; there are: d=0.26"],
        ),
        (
            "scene",
            "a,p,scenes/other.toml,,motion.d,1,,wrong,,",
            vec!["line 3", "scenes/other.toml", "no such file"],
        ),
        (
            "name",
            "a,p,fig99,,motion.d,1,,wrong,,",
            vec!["line 3", "no built-in scene `fig99`"],
        ),
        (
            "outside",
            "a,p,../own.toml,,motion.d,1,,wrong,,",
            vec!["line 3", "leads out of the directory"],
        ),
        (
            "word",
            "a,p,,row.label=9,audit.verdict,0.5,,wrong,,",
            vec!["equations.toml", "no such file"],
        ),
    ] {
        let golden = Golden::new(&format!("bad-{case}"), &[RIGHT, row]);
        let words: Vec<&str> = words.into_iter().chain(["printed.csv"]).collect();
        golden.assert_refused(&words);
    }
}

#[test]
fn another_header_is_refused_with_the_right_one() {
    let golden = Golden::new("header", &[RIGHT]);
    let text = format!("{HEADER}\n{RIGHT}\n");
    golden.write("printed.csv", text.replacen("expected", "wanted", 1));
    golden.assert_refused(&["line 1", "`wanted` and no `expected`", HEADER]);
    golden.write("printed.csv", RIGHT);
    golden.assert_refused(&["line 1", HEADER]);
}

#[test]
fn a_built_in_scene_may_be_named() {
    let golden = Golden::new("named", &[&RIGHT.replace("scenes/own.toml", "fig02")]);
    assert_eq!(golden.verdicts().0, Some(0));
}

#[test]
fn a_decided_claim_is_a_quantity_too() {
    let golden = Golden::new("claim", &["a,(9),,row.label=own,audit.verdict,proved,,wrong,,"]);
    golden.write(
        "equations.toml",
        "[[equation]]\nlabel = \"given\"\nrole = \"premise\"\ntex = 'd = r_B'\n\
         [[equation]]\nlabel = \"own\"\nrole = \"claim\"\ntex = 'd = r_T'\nfollows_from = [\"given\"]\n",
    );
    let (status, rows) = golden.verdicts();
    assert_eq!(status, Some(0), "{rows:?}");
    assert_eq!(rows[0][3], "printed proved, it is refuted");
}

#[test]
fn what_the_paper_leaves_open_is_undetermined() {
    let golden = Golden::new(
        "open",
        &["a,Table 1,,,,omega,rad/s,undetermined,,Table 1 prints no frequency"],
    );
    let (status, rows) = golden.verdicts();
    assert_eq!((status, rows[0][1].as_str()), (Some(0), "undetermined"));
}

#[test]
fn reference_files_are_read_as_strictly() {
    let golden = Golden::new("reference", &[RIGHT]);
    fs::create_dir(golden.0.join("reference")).unwrap();
    golden.assert_refused(&["reference", "no .csv file"]);
    let header = "id,scene,set,quantity,value,by,confirmed_by";
    for (text, words) in [
        (String::new(), "it is empty"),
        (header.to_owned(), "a header and no rows"),
        (
            format!("{header}\na,scenes/own.toml,,motion.g,abc,x,y\n"),
            "column `value`: `abc` is not a number",
        ),
        (
            format!("{header}\na,scenes/own.toml,,motion.g,,x,y\n"),
            "column `value`: it is empty; `check DIR --bless`",
        ),
        (
            format!("{header}\na,scenes/own.toml,,motion.g.max,1,x,y\n"),
            "without .min, .max",
        ),
    ] {
        golden.write("reference/device.csv", text);
        golden.assert_refused(&["device.csv", words]);
    }
    golden.write(
        "reference/device.csv",
        format!("{header}\na,scenes/own.toml,,motion.g,0.122010000000000000000000000000,x,y\n"),
    );
    let (status, rows) = golden.verdicts();
    assert_eq!((status, rows.len()), (Some(0), 2), "{rows:?}");
    golden.write(
        "reference/device.csv",
        format!("{header}\na,scenes/own.toml,,motion.g,0.122010000001000000000000000000,x,y\n"),
    );
    let (status, rows) = golden.verdicts();
    assert_eq!((status, rows[1][1].as_str()), (Some(1), "wrong"), "{rows:?}");
}

#[test]
fn a_row_that_cannot_be_compared_stops_no_other() {
    let golden = Golden::new(
        "goes-on",
        &[
            &RIGHT.replace("scenes/", "scenes/no-"),
            &RIGHT.replace("g,section", "h,section"),
        ],
    );
    let ran = check(&[golden.path(), "--format", "junit"]);
    let text = ran.stdout;
    assert_eq!(ran.status, Some(2), "{text}");
    assert!(text.contains("<testcase name=\"h\" classname=\"section 2\""), "{text}");
    assert!(
        text.contains("<failure type=\"unusable\"") && text.contains("line 2"),
        "{text}"
    );
}

#[test]
fn blessing_never_touches_what_is_printed() {
    assert_refused(&["--bless"], &["name it"]);
    let golden = Golden::new("bless", &[&RIGHT.replace("0.12201", "0.5")]);
    let before = golden.0.read("printed.csv");
    assert_refused(
        &[golden.path(), "--bless"],
        &["no folder reference/", "none is created"],
    );
    assert_eq!(golden.0.read("printed.csv"), before);
    assert!(!golden.0.join("reference").exists());
}

#[test]
fn junit_reports_one_test_a_row_and_other_commands_have_none() {
    let golden = Golden::new(
        "junit",
        &[
            RIGHT,
            &RIGHT.replace("g,section", "h,section").replace("0.12201", "0.5"),
        ],
    );
    let ran = check(&[golden.path(), "--format", "junit"]);
    let text = ran.stdout;
    assert_eq!(ran.status, Some(1));
    assert!(
        text.contains("<testsuite name=\"vibro-audit\" tests=\"2\" failures=\"1\""),
        "{text}"
    );
    assert!(
        text.contains("<testcase name=\"g\" classname=\"section 2\"/>"),
        "{text}"
    );
    assert!(
        text.contains("<failure type=\"wrong\" message=\"EXPECTED reproduced, IS wrong: "),
        "{text}"
    );
    let other = run(&["stress", "--format", "junit"]);
    other.refused(&["[possible values: text, csv, json, jsonl, markdown]"]);
}

#[test]
fn a_full_disk_is_an_error_and_no_partial_file() {
    if !Path::new("/dev/full").exists() {
        return;
    }
    let golden = Golden::new("full", &[RIGHT]);
    let ran = check(&[golden.path(), "--out", "/dev/full"]);
    assert_eq!(ran.status, Some(2));
}

/// `check` of the built-in values, the slowest command, once for all tests: its status and its CSV.
pub static BUILT_IN: LazyLock<(Option<i32>, String)> = LazyLock::new(|| {
    let ran = check(&["--format", "csv"]);
    (ran.status, ran.stdout)
});

#[test]
fn the_paper_s_values_are_all_as_expected() {
    let (status, built_in) = &*BUILT_IN;
    assert_eq!(*status, Some(0), "{built_in}");
    // one row of each scene stands alone wherever it is copied; what is inferred is so from all of them
    let mut scenes = HashSet::new();
    let copied = Golden::paper("copy", |row| {
        let scene = row.split(',').find(|field| field.starts_with("scenes/"));
        scene.is_some_and(|scene| !row.contains(",inferred.") && scenes.insert(scene.to_owned()))
    });
    let ran = check(&[copied.path(), "--format", "csv"]);
    let there = ran.stdout;
    assert!(ran.status == Some(0) && there.lines().count() > 8, "{there}");
    for line in there.lines() {
        assert!(built_in.lines().any(|row| row == line), "{line} is not in\n{built_in}");
    }
}

/// The printed number with its last figure changed by five, up or down, as the figure allows; a range is no number: its
/// ends may move without the value leaving it.
fn changed(printed: &str) -> Option<String> {
    printed.parse::<f64>().ok()?;
    let at = printed.rfind(|c: char| c.is_ascii_digit())?;
    let figure: u8 = printed.as_bytes()[at] - b'0';
    let other = if figure < 5 { figure + 5 } else { figure - 5 };
    Some(format!("{}{other}{}", &printed[..at], &printed[at + 1..]))
}

#[test]
fn every_reproduced_figure_changed_by_five_changes_its_row_and_the_status() {
    let golden = Golden::paper("changed", |_| true);
    let text = golden.0.read("printed.csv");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    // all of them in one run: no row that prints a number is computed from others
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(HEADER.split(',')).unwrap();
    let mut tried = 0;
    for record in reader.records().map(Result::unwrap) {
        let Some(other) = changed(&record[5]).filter(|_| &record[7] == "reproduced") else {
            continue;
        };
        assert!(!record[4].starts_with("inferred."), "{record:?}");
        tried += 1;
        let fields = record.iter().enumerate();
        writer
            .write_record(fields.map(|(column, field)| if column == 5 { &other } else { field }))
            .unwrap();
    }
    golden.write("printed.csv", writer.into_inner().unwrap());
    let (status, after) = golden.verdicts();
    assert_eq!((status, after.len()), (Some(1), tried));
    for row in after {
        assert!(
            row[1] != "reproduced" && row[3].starts_with("EXPECTED reproduced, "),
            "{row:?}"
        );
    }
    assert!(tried >= 15, "only {tried} rows print a number that is reproduced");
}

#[test]
fn a_printed_pair_changed_by_five_excludes_the_amplitude_of_the_scenes() {
    let golden = Golden::paper("pair", |_| true);
    let text = golden.0.read("printed.csv");
    let amplitude = |text: String| {
        let wanted =
            |line: &&str| line.starts_with("id,") || line.contains("amplitude") || line.contains("row.word=BT,");
        golden.write(
            "printed.csv",
            text.lines().filter(wanted).collect::<Vec<_>>().join("\n"),
        );
        let (_, rows) = golden.verdicts();
        rows.into_iter().find(|row| row[0] == "table1-amplitude").unwrap()
    };
    let [_, verdict, _, reason] = amplitude(text.clone());
    assert_eq!(verdict, "wrong");
    assert!(
        reason.contains("no other than [4.99994, 5.00006] reproduces"),
        "{reason}"
    );
    for (printed, changed) in [(",0.83272,", ",0.83277,"), (",-0.514769,", ",-0.514764,")] {
        let [_, verdict, _, reason] = amplitude(text.replacen(printed, changed, 1));
        assert_eq!(verdict, "undecided", "{printed}: {reason}");
        assert!(
            reason.contains("contradict each other") || reason.contains("not the scene's 5"),
            "{reason}"
        );
    }
}
