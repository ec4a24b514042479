//! Parts of a run: joined they are the run byte for byte, and nothing else is joined; a run that was stopped goes on to the
//! same bytes.

use crate::common::program::{Ran, Scratch, program, scratch};
use std::fs;
use std::io::Write;
use std::process::{Child, Command};
use vibro_audit::report::{Checksum, SummedLines};

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

/// Rows under two lines as a run writes them that may be gone on with: each with a sum behind it.
fn summed(text: &str) -> String {
    let rows = text.match_indices('\n').nth(1).map_or(text.len(), |(end, _)| end + 1);
    let (head, rows) = text.split_at(rows);
    let mut written = head.as_bytes().to_vec();
    let mut lines = SummedLines::behind(&mut written, Checksum::default());
    lines.write_all(rows.as_bytes()).unwrap();
    String::from_utf8(written).unwrap()
}

/// A part that was changed, with the sum of what it is now.
fn with_its_sum(part: &str) -> String {
    let lines: Vec<&str> = part.lines().collect();
    let (tail, rest) = lines.split_last().unwrap();
    let mut sum = Checksum::default();
    rest[1..].iter().for_each(|line| sum.add_line(line));
    format!("{}\n{}, {sum}\n", rest.join("\n"), tail.rsplit_once(", ").unwrap().0)
}

/// A directory in which a run and its parts are written.
struct Parts(Scratch);

impl Parts {
    #[track_caller]
    fn new(name: &str) -> Self {
        Self(scratch(name))
    }

    fn run(&self, arguments: &[&str]) -> Ran {
        self.0.run(arguments)
    }

    /// Starts a run that is to be stopped.
    #[cfg(unix)]
    fn start(&self, arguments: &[&str]) -> Child {
        program(arguments).within(&*self.0).spawn()
    }

    #[track_caller]
    fn printed(&self, arguments: &[&str]) -> String {
        self.run(arguments).succeeded()
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

    fn merged(&self, files: &[String]) -> Ran {
        let files = files.iter().map(String::as_str);
        self.run(&["merge"].into_iter().chain(files).collect::<Vec<_>>())
    }

    #[track_caller]
    fn refused(&self, files: &[String], word: &str) {
        self.merged(files).refused(&[word]);
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
        assert!(whole.matches('\n').count() > 12);
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
    let whole = here.0.read("2.csv");
    let lines: Vec<&str> = whole.lines().collect();
    let changed = |name: &str, lines: &[&str]| {
        here.0.file(name, lines.join("\n") + "\n");
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
        here.refused(&changed("other.csv", &other.lines().collect::<Vec<_>>()), "two runs");
    }
    here.refused(&["nowhere.csv".to_owned()], "nowhere.csv");
    // a part is never written over
    let ran = here.run(&["merge", "1.csv", "2.csv", "3.csv", "--out", "2.csv"]);
    assert_eq!(ran.status, Some(2));
    assert_eq!(here.0.read("2.csv"), whole);
    // an attractor that the table does not have, and a table of other rows
    let files = here.parts(&SEVERAL, 2);
    let whole = here.0.read("2.csv");
    let lines: Vec<&str> = whole.lines().collect();
    let (last, rest) = lines.split_last().unwrap();
    let without_one = [rest.split_last().unwrap().1, &[*last]].concat().join("\n") + "\n";
    for text in [whole.replacen(",1\n", ",9\n", 1), without_one] {
        here.0.file("2.csv", with_its_sum(&text));
        here.refused(&files, "its attractors are not those of its rows");
        here.0.file("2.csv", text);
        here.refused(&files, "was changed");
    }
    here.0.file("2.csv", with_its_sum(&whole));
    here.merged(&files).succeeded();
}

/// The numbers of some columns of each row, NaN where there is none.
fn numbers<const N: usize>(table: &str, columns: [&str; N]) -> Vec<[f64; N]> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let header = reader.headers().unwrap().clone();
    let places = columns.map(|column| header.iter().position(|name| name == column).unwrap());
    let row = |row: csv::StringRecord| places.map(|place| row[place].parse().unwrap_or(f64::NAN));
    reader.records().map(|found| row(found.unwrap())).collect()
}

#[test]
fn the_parts_of_a_search_for_an_optimum_enclose_it_together_within_the_gap() {
    let here = Parts::new("optimum");
    let command = [
        "optimise",
        "fig03",
        "--gap",
        "1e-3",
        "--set",
        "box={d = [0.3, 0.5], r_b = [0.5, 0.7]}",
    ];
    let whole = here.printed(&[&command[..], &["--format", "csv"]].concat());
    let whole = numbers(&whole, ["low", "high", "value"]);
    for of in [1, 3] {
        let files = here.parts(&command, of);
        let merged = here.merged(&files);
        let text = merged.succeeded();
        assert!(
            text.lines().nth(1).is_some_and(|line| line.contains(",true,")),
            "{text}"
        );
        let gaps = numbers(&text, ["gap"]);
        assert!(gaps[0][0] <= 1e-3, "{text}");
        let merged = numbers(&text, ["low", "high", "value"]);
        assert_eq!(merged.len(), whole.len());
        for (&[low, high, value], &[other_low, other_high, other]) in merged.iter().zip(&whole) {
            assert!(
                low <= value && value <= high && low <= other_high && other_low <= high,
                "{text}"
            );
            assert!((value - other).abs() <= 1e-2 * other.abs(), "{text}");
        }
    }
    // searched to another gap it is another search
    let other = [&command[..3], &["1e-2"], &command[4..]].concat();
    let other = here.printed(&[&other[..], &["--format", "csv", "--shard", "2/3"]].concat());
    here.0.file("2.csv", other);
    here.refused(&["1.csv", "2.csv", "3.csv"].map(str::to_owned), "two runs");
    let none = ["optimise", "fig03", "--set", "box={d = [3, 4], r_b = [0.1, 0.2]}"];
    let files = here.parts(&none, 2);
    assert_eq!(here.merged(&files).stdout.lines().count(), 1);
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
        let ran = here.run(arguments);
        let error = ran.stderr;
        assert_eq!(ran.status, Some(2), "{arguments:?}: {error}");
        assert!(error.contains(word), "{arguments:?}: {error}");
    }
}

/// Every command that goes on, with enough rows to be cut anywhere.
fn resumed() -> Vec<Vec<&'static str>> {
    let swept = [
        "sweep",
        "fig03",
        "--set",
        "sweep.points=13",
        "--set",
        "sweep.impacts=90",
    ];
    let each = ["--set", "sweep.start=each"];
    let over = [
        "--set",
        "sweep.over=r_b",
        "--set",
        "sweep.from=0.4",
        "--set",
        "sweep.to=0.8",
    ];
    vec![
        vec!["map", "fig03", "--set", MAP],
        [&swept[..], &each, &["--summary"]].concat(),
        [&swept[..], &each].concat(),
        [&swept[..], &each, &over].concat(),
        SEVERAL.to_vec(),
    ]
}

#[test]
fn a_run_that_was_stopped_goes_on_to_the_same_bytes_wherever_it_was_cut() {
    let here = Parts::new("resume");
    let csv = ["--format", "csv"];
    let to = ["--format", "csv", "--resume", "--out", "rows.csv"];
    let [file, part] = ["rows.csv", "rows.csv.part"].map(|name| here.0.join(name));
    for command in resumed() {
        let whole = here.printed(&[&command[..], &csv].concat());
        let text = here.printed(&[&command[..], &csv, &["--shard", "1/1"]].concat());
        // what a run has written before its end: rows, and a line that is cut
        let rows = text
            .split("\n\n")
            .next()
            .unwrap()
            .split("\n# end")
            .next()
            .unwrap()
            .to_owned()
            + "\n";
        let rows = summed(&rows);
        let ends: Vec<usize> = rows.match_indices('\n').map(|(at, _)| at + 1).collect();
        let cuts = [
            0,
            5,
            ends[0],
            ends[1],
            ends[1] + 3,
            ends[2],
            ends[ends.len() / 2],
            rows.len() - 4,
            rows.len(),
        ];
        for cut in cuts {
            let _ = fs::remove_file(&file);
            fs::write(&part, &rows[..cut]).unwrap();
            here.printed(&[&command[..], &to].concat());
            let found = fs::read_to_string(&file).unwrap();
            assert!(found == whole, "{command:?} cut at {cut} of {}", rows.len());
            assert!(!part.exists());
        }
        // a row that was changed, is missing, or was never written
        let middle = ends[ends.len() / 2];
        let next = ends[ends.len() / 2 + 1];
        let changed = rows[middle..next].replacen(|c: char| c.is_ascii_digit(), "7", 3);
        for text in [
            [&rows[..middle], &changed, &rows[next..]].concat(),
            [&rows[..middle], &rows[next..]].concat(),
            format!("{rows}hello,world\n"),
        ] {
            let _ = fs::remove_file(&file);
            fs::write(&part, &text).unwrap();
            let ran = here.run(&[&command[..], &to].concat());
            let error = ran.stderr;
            assert!(ran.status == Some(2) && error.contains("rows.csv.part:"), "{error}");
            assert!(!file.exists() && fs::read_to_string(&part).unwrap() == text);
        }
        fs::remove_file(&part).unwrap();
    }
}

#[test]
fn parts_go_on_too_and_are_merged() {
    let here = Parts::new("resume-parts");
    let command = ["map", "fig03", "--set", MAP, "--format", "csv"];
    let whole = here.printed(&command);
    let files: Vec<String> = (1..=3)
        .map(|number| {
            let (file, shard) = (format!("{number}.csv"), format!("{number}/3"));
            let shard = ["--shard", &shard];
            let written = here.printed(&[&command[..], &shard].concat());
            let some: String = written.lines().take(4).map(|line| format!("{line}\n")).collect();
            here.0.file(&format!("{file}.part"), summed(&some));
            here.printed(&[&command[..], &shard, &["--resume", "--out", &file]].concat());
            assert_eq!(here.0.read(&file), written);
            file
        })
        .collect();
    assert_eq!(here.merged(&files).stdout, whole);
}

#[cfg(unix)]
#[test]
fn a_kill_leaves_the_rows_and_nothing_else() {
    let here = Parts::new("kill");
    let many = r#"map={impacts = 4000, x = {over = "d", from = 0.1, to = 0.5, points = 40}, y = {over = "r_b", from = 0.3, to = 0.9, points = 25}}"#;
    let command = ["map", "fig03", "--set", many, "--format", "csv"];
    let to = ["--resume", "--out", "rows.csv"];
    let rows = || fs::read_to_string(here.0.join("rows.csv.part")).map_or(0, |text| text.lines().count());
    let mut stopped = 0;
    for signal in ["INT", "KILL"] {
        let mut running = here.start(&[&command[..], &to].concat());
        let before = rows();
        let start = std::time::Instant::now();
        while rows() <= before + 2 && running.try_wait().unwrap().is_none() && start.elapsed().as_secs() < 60 {
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        // nobody else writes the rows meanwhile
        let beside = here.run(&[&command[..], &to].concat());
        if running.try_wait().unwrap().is_none() {
            assert_eq!(beside.status, Some(2));
            assert!(beside.stderr.contains("another run is writing it"));
        }
        let id = running.id().to_string();
        Command::new("kill")
            .args([&format!("-{signal}"), &id])
            .status()
            .unwrap();
        let status = running.wait().unwrap();
        if !status.success() {
            stopped += 1;
            assert_eq!(here.0.names(), ["rows.csv.part"], "{signal}");
        }
    }
    assert!(stopped > 0, "the runs were over before they could be stopped");
    here.printed(&[&command[..], &to].concat());
    let whole = here.printed(&command);
    assert!(here.0.read("rows.csv") == whole);
    assert!(!here.0.join("rows.csv.part").exists());
}

/// A search of some seconds.
const SEARCH: [&str; 6] = [
    "optimise",
    "fig03",
    "--gap",
    "1e-3",
    "--set",
    r#"box={d = [0.1, 0.5], r_b = [0.3, 0.7], r_t = [0.3, 0.7], incline = [0, "pi/2"]}"#,
];

#[cfg(unix)]
#[test]
fn a_search_that_was_stopped_goes_on_to_the_same_bytes_from_what_it_had_written() {
    let here = Parts::new("resume-search");
    let whole = here.printed(&[&SEARCH[..], &["--format", "csv"]].concat());
    let to = ["--format", "csv", "--resume", "--out", "best.csv"];
    let command = [&SEARCH[..], &to].concat();
    let [file, part] = ["best.csv", "best.csv.part"].map(|name| here.0.join(name));
    let lines = || fs::read_to_string(&part).map_or(0, |text| text.lines().count());
    let mut stopped = 0;
    for signal in ["INT", "KILL", "KILL"] {
        let mut running = here.start(&command);
        let before = lines();
        let start = std::time::Instant::now();
        while lines() <= before && running.try_wait().unwrap().is_none() && start.elapsed().as_secs() < 60 {
            std::thread::sleep(std::time::Duration::from_millis(10));
        }
        let id = running.id().to_string();
        Command::new("kill")
            .args([&format!("-{signal}"), &id])
            .status()
            .unwrap();
        if !running.wait().unwrap().success() {
            stopped += 1;
            assert_eq!(here.0.names(), ["best.csv.part"], "{signal}");
            assert!(lines() > before, "{signal}");
        }
    }
    assert!(stopped > 0, "the searches were over before they could be stopped");
    // what is there is not searched again, and is refused where it was changed or is of another search
    let text = fs::read_to_string(&part).unwrap();
    let end = text.rfind('\n').unwrap() + 1;
    let rows: Vec<&str> = text[..end].lines().collect();
    let with = |change: &dyn Fn(&mut Vec<String>)| {
        let mut rows: Vec<String> = rows.iter().map(|row| (*row).to_owned()).collect();
        change(&mut rows);
        rows.join("\n") + "\n"
    };
    let middle = rows.len() / 2;
    let digit = rows[middle].find(",0.").unwrap() + 3;
    for (changed, word) in [
        (
            with(&|rows| rows[middle].replace_range(digit..=digit, "")),
            "is not what this run",
        ),
        (
            with(&|rows| {
                // a box that is left is said to be dropped
                let left = rows[middle].find(|c: char| c.is_ascii_digit()).unwrap();
                let ends = rows[middle][left..].find([';', ' ']).unwrap() + left;
                rows[middle].replace_range(left..ends, "");
            }),
            "is not what this run",
        ),
        (with(&|rows| rows.swap(middle, middle + 1)), "is not what this run"),
        (with(&|rows| drop(rows.remove(middle))), "is not what this run"),
        (with(&|rows| rows[2] = String::new()), "is not what this run"),
        (
            with(&|rows| rows[0] = rows[0].replace("gap 0.001", "gap 0.01")),
            "of another run",
        ),
    ] {
        fs::write(&part, &changed).unwrap();
        let ran = here.run(&command);
        let error = ran.stderr;
        assert_eq!(ran.status, Some(2), "{error}");
        assert!(error.contains(word) && !file.exists(), "{error}");
        assert_eq!(fs::read_to_string(&part).unwrap(), changed);
    }
    // cut anywhere it goes on
    for cut in [5, end / 2] {
        fs::write(&part, &text[..cut]).unwrap();
        here.printed(&command);
        assert!(fs::read_to_string(&file).unwrap() == whole, "cut at {cut} of {end}");
        assert!(!part.exists());
        fs::remove_file(&file).unwrap();
    }
}

#[test]
fn a_part_of_a_search_goes_on_too() {
    let here = Parts::new("resume-search-part");
    let command = [
        "optimise", "fig03", "--gap", "1e-3", "--format", "csv", "--shard", "2/3",
    ];
    let command = [
        &command[..],
        &["--set", "box={d = [0.3, 0.5], r_b = [0.5, 0.7], r_t = [0.3, 0.7]}"],
    ]
    .concat();
    let whole = here.printed(&command);
    here.printed(&[&command[..], &["--resume", "--out", "2.csv"]].concat());
    assert!(here.0.read("2.csv") == whole);
    assert_eq!(here.0.names().len(), 1);
}

#[test]
fn what_cannot_go_on_is_refused_and_the_rows_stay() {
    let here = Parts::new("resume-refused");
    let command = ["map", "fig03", "--set", MAP];
    let refused = |arguments: &[&str], word: &str| {
        let ran = here.run(&[&command[..], arguments].concat());
        let error = ran.stderr;
        assert_eq!(ran.status, Some(2), "{arguments:?}: {error}");
        assert!(error.contains(word), "{arguments:?}: {error}");
    };
    refused(&["--resume", "--format", "csv"], "add --out FILE");
    refused(&["--resume", "--out", "rows.txt"], "add --format csv");
    let to = ["--resume", "--format", "csv", "--out", "rows.csv"];
    refused(
        &[&to[..], &["--set", "map.start=follow"]].concat(),
        "follows the one before",
    );
    here.0
        .file("rows.csv.part", "# vibro-audit part 1 of 1: map 0.1.0 0123\nx,y\n1,2\n");
    refused(&to, "of another run");
    assert!(here.0.read("rows.csv.part").ends_with("1,2\n"));
}

#[test]
fn a_page_of_basins_has_the_starts_and_leaves_the_attractors_in_their_file() {
    let here = Parts::new("page");
    let page = ["--set", "want=[\"basins\"]", "--format", "html", "--out", "all"];
    here.printed(&[&["run"][..], &SEVERAL[1..], &page].concat());
    let text = here.0.read("all/report.html");
    assert!(text.contains("attractor") && !text.contains("fraction_error"));
    assert!(here.0.read("all/basins.csv").contains("fraction_error"));
}
