//! Parts of a run: joined they are the run byte for byte, and nothing else is joined.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const MAP: &str = r#"map={impacts = 60, starts = [{phase = 6.18, velocity = 0.53}, {phase = 1, velocity = 2}], x = {over = "d", from = 0.1, to = 0.5, points = 5}, y = {over = "r_b", from = 0.3, to = 0.9, points = 4}}"#;

/// A device with several attractors.
const BASINS: &str =
    "basins={impacts = 400, phase = {from = 0, to = 6, points = 11}, velocity = {from = 0, to = 1.5, points = 3}}";
const SEVERAL: [&str; 6] = [
    "basins",
    "fig03",
    "--set",
    BASINS,
    "--set",
    "motion={d = 0.22, r_b = 0.8, r_t = 0.8}",
];

struct Parts(PathBuf);

impl Parts {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("merge-{name}"));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn run(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_vibro-audit"));
        command.current_dir(&self.0).args(arguments).output().unwrap()
    }

    fn printed(&self, arguments: &[&str]) -> Vec<u8> {
        let output = self.run(arguments);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{arguments:?}: {error}");
        output.stdout
    }

    /// The files of all parts of a command.
    fn parts(&self, command: &[&str], of: u32) -> Vec<String> {
        let part = |number: u32| {
            let (file, shard) = (format!("{number}.csv"), format!("{number}/{of}"));
            self.printed(&[command, &["--format", "csv", "--shard", &shard, "--out", &file]].concat());
            file
        };
        (1..=of).map(part).collect()
    }

    fn merged(&self, files: &[String]) -> Output {
        let files = files.iter().map(String::as_str);
        self.run(&["merge"].into_iter().chain(files).collect::<Vec<_>>())
    }

    #[track_caller]
    fn refused(&self, files: &[String], word: &str) {
        let output = self.merged(files);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{files:?}: {error}");
        assert!(error.contains(word) && output.stdout.is_empty(), "{files:?}: {error}");
    }
}

#[test]
fn parts_in_any_order_are_the_one_run_byte_for_byte() {
    let here = Parts::new("bytes");
    let sweep = [
        "sweep",
        "fig03",
        "--set",
        "sweep.points=13",
        "--set",
        "sweep.impacts=90",
        "--set",
        "sweep.start=each",
    ];
    let summary = [&sweep[..], &["--summary"]].concat();
    for (command, all) in [
        (&["map", "fig03", "--set", MAP][..], &[1, 3, 8, 11][..]),
        (&sweep, &[4]),
        (&summary, &[1, 5, 20]),
        (&SEVERAL, &[1, 2, 7, 40]),
    ] {
        let whole = here.printed(&[command, &["--format", "csv"]].concat());
        assert!(whole.iter().filter(|byte| **byte == b'\n').count() > 12);
        for of in all {
            let mut files = here.parts(command, *of);
            files.reverse();
            let merged = here.merged(&files);
            assert_eq!(merged.stdout, whole, "{command:?} in {of}");
        }
    }
}

#[test]
fn what_is_not_all_of_one_run_is_refused_and_nothing_is_written() {
    let here = Parts::new("refused");
    let command = ["map", "fig03", "--set", MAP];
    let files = here.parts(&command, 3);
    here.refused(&files[..2], "missing: 3");
    here.refused(&[&files[..], &files[1..2]].concat(), "twice");
    let whole = fs::read_to_string(here.0.join("2.csv")).unwrap();
    let lines: Vec<&str> = whole.lines().collect();
    let changed = |name: &str, lines: &[&str]| {
        fs::write(here.0.join(name), lines.join("\n") + "\n").unwrap();
        [files[0].clone(), name.to_owned(), files[2].clone()]
    };
    here.refused(&changed("cut.csv", &lines[..lines.len() - 1]), "cut short");
    here.refused(&changed("less.csv", &[&lines[..4], &lines[5..]].concat()), "cut short");
    here.refused(&changed("none.csv", &lines[1..]), "no part of a run");
    here.refused(&changed("empty.csv", &[]), "no part of a run");
    for other in [
        ["map", "fig03", "--set", MAP, "--set", "motion.r_t=0.4"],
        ["map", "fig03", "--set", MAP, "--set", "map.impacts=61"],
    ] {
        let other = here.printed(&[&other[..], &["--format", "csv", "--shard", "2/3"]].concat());
        let other = String::from_utf8(other).unwrap();
        here.refused(&changed("other.csv", &other.lines().collect::<Vec<_>>()), "two runs");
    }
    here.refused(&["nowhere.csv".to_owned()], "nowhere.csv");
    // a part is never written over
    let output = here.run(&["merge", "1.csv", "2.csv", "3.csv", "--out", "2.csv"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(fs::read_to_string(here.0.join("2.csv")).unwrap(), whole);
    // an attractor that the table does not have, and a table of other rows
    let files = here.parts(&SEVERAL, 2);
    let whole = fs::read_to_string(here.0.join("2.csv")).unwrap();
    let lines: Vec<&str> = whole.lines().collect();
    let (last, rest) = lines.split_last().unwrap();
    let without_one = [rest.split_last().unwrap().1, &[*last]].concat().join("\n") + "\n";
    for text in [whole.replacen(",1\n", ",9\n", 1), without_one] {
        fs::write(here.0.join("2.csv"), text).unwrap();
        here.refused(&files, "its attractors are not those of its rows");
    }
}

#[test]
fn what_has_no_parts_is_refused() {
    let here = Parts::new("none");
    for (arguments, word) in [
        (&["map", "fig03", "--set", MAP, "--shard", "1/2"][..], "--format csv"),
        (
            &["map", "fig03", "--set", MAP, "--format", "csv", "--shard", "3/2"],
            "3/16",
        ),
        (
            &[
                "sweep",
                "fig03",
                "--set",
                "sweep.start=follow",
                "--format",
                "csv",
                "--shard",
                "1/2",
            ],
            "follow",
        ),
    ] {
        let output = here.run(arguments);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(error.contains(word), "{arguments:?}: {error}");
    }
}
