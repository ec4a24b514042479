//! Scenes with a forcing of their own, one wall, starts in flight and plastic impacts, through the program.

use crate::common::program::{run, scratch};

/// The rows of a table, by column.
fn rows(text: &str) -> Vec<Vec<(String, String)>> {
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().expect("columns");
    let named = |line: Vec<&str>| {
        let cells = names.iter().zip(line);
        cells
            .map(|(name, cell)| ((*name).to_owned(), cell.to_owned()))
            .collect()
    };
    lines.map(named).collect()
}

fn cell<'a>(row: &'a [(String, String)], name: &str) -> &'a str {
    let found = row.iter().find(|(own, _)| own == name);
    &found.unwrap_or_else(|| panic!("{name}: {row:?}")).1
}

fn number(row: &[(String, String)], name: &str) -> f64 {
    cell(row, name)
        .split(';')
        .next()
        .unwrap_or_default()
        .parse()
        .expect(name)
}

const SQUARE: &str = "examples/square.toml";
const TABLE: &str = "examples/table.toml";

#[test]
fn a_start_in_flight_is_where_the_trajectory_begins_and_its_first_impact_the_first_row() {
    let path = rows(
        &run(&[
            "trajectory",
            SQUARE,
            "--samples",
            "401",
            "--until",
            "2",
            "--format",
            "csv",
        ])
        .succeeded(),
    );
    assert_eq!((number(&path[0], "z"), number(&path[0], "zdot")), (0.05, 0.0));
    let impacts = rows(&run(&["simulate", SQUARE, "--impacts", "3", "--format", "csv"]).succeeded());
    let (time, side) = (number(&impacts[0], "time"), cell(&impacts[0], "side"));
    let before = path
        .iter()
        .rfind(|row| number(row, "time") < time)
        .expect("a time before");
    let wall = if side == "bottom" { 0.15 } else { -0.15 };
    assert!(
        time > 0.1 && (number(before, "z") - wall).abs() < 0.01,
        "{time} {before:?}"
    );
    let proved = rows(&run(&["simulate", SQUARE, "--impacts", "3", "--proved", "--format", "csv"]).succeeded());
    for (row, other) in impacts.iter().zip(&proved) {
        assert!((number(row, "time") - number(other, "time")).abs() <= number(other, "time_error_bound") + 1e-14);
        assert!(number(other, "time_error_bound") < 1e-12);
    }
}

#[test]
fn orbits_under_harmonics_are_proved_and_never_said_to_be_all() {
    for command in ["orbits", "branch"] {
        let rows = rows(&run(&[command, SQUARE, "--format", "csv"]).succeeded());
        assert!(!rows.is_empty());
        for row in &rows {
            assert_eq!(cell(row, "complete"), "false", "{row:?}");
        }
        let proved = rows.iter().filter(|row| !cell(row, "error_bound").is_empty());
        assert!(proved.count() * 10 >= rows.len() * 9, "{command}");
    }
    // one cosine that is written out is the paper's, and no more is claimed of it
    let paper = ["orbits", "fig02", "--set", "motion.d=0.3", "--format", "csv"];
    let written = [&paper[..], &["--set", "forcing.cosines=[1]"]].concat();
    let (paper, written) = (rows(&run(&paper).succeeded()), rows(&run(&written).succeeded()));
    assert!(paper.iter().all(|row| cell(row, "complete") == "true"));
    assert!(written.iter().all(|row| cell(row, "complete") == "false"));
    for row in &written {
        let same = paper
            .iter()
            .any(|other| (number(row, "velocities") - number(other, "velocities")).abs() < 1e-12);
        assert!(same, "{row:?}");
    }
}

#[test]
fn a_stable_orbit_under_harmonics_is_what_a_sweep_comes_to() {
    let orbits = rows(&run(&["orbits", SQUARE, "--set", "motion.d=0.4", "--format", "csv"]).succeeded());
    let stable = orbits
        .iter()
        .find(|row| cell(row, "stable") == "true" && cell(row, "admissible") == "true");
    let stable = stable.expect("a stable orbit");
    let set = "sweep={over = \"d\", from = 0.4, to = 0.5, points = 2, impacts = 2000, keep = 2, start = \"each\"}";
    let swept = rows(&run(&["sweep", SQUARE, "--set", set, "--format", "csv"]).succeeded());
    let bottom = swept
        .iter()
        .find(|row| cell(row, "side") == "bottom")
        .expect("a bottom impact");
    assert!((number(bottom, "velocity") - number(stable, "velocities")).abs() < 1e-10);
}

#[test]
fn the_cascade_of_the_table_is_followed_from_doubling_to_doubling() {
    let rows = rows(&run(&["branch", TABLE, "--format", "csv", "--set", "sweep.points=3"]).succeeded());
    let flips = |word: &str| {
        let own = rows
            .iter()
            .filter(|row| cell(row, "word") == word && cell(row, "kind") == "period-doubling");
        own.map(|row| number(row, "g")).collect::<Vec<_>>()
    };
    let [one, two, four, eight] = ["B", "BB", "BBBB", "BBBBBBBB"].map(flips);
    // in closed form, of Bapat, Sankar and Popplewell 1986
    let r = 0.5_f64;
    let exact = ((std::f64::consts::PI * (1.0 - r) / (1.0 + r)).powi(2)
        + (2.0 * (1.0 + r * r) / (1.0 + r).powi(2)).powi(2))
    .sqrt()
    .recip();
    assert!(one.len() == 1 && (one[0] - exact).abs() < 1e-13, "{one:?}");
    // each begins where the one before doubles, and doubles in its turn
    assert!(two.contains(&one[0]) && two.len() == 2, "{two:?}");
    let next = two.iter().find(|at| **at != one[0]).expect("a doubling");
    assert!(four.contains(next) && four.len() == 2, "{four:?}");
    let last = four.iter().find(|at| *at != next).expect("a doubling");
    assert!(eight.contains(last), "{eight:?}");
    // by about Feigenbaum's 4.67
    let ratio = (one[0] - next) / (next - last);
    assert!((4.0..6.0).contains(&ratio), "{ratio}");
}

#[test]
fn mirror_images_double_at_one_gap_and_both_are_followed() {
    let set = [
        "branch",
        "fig02",
        "--set",
        "device.incline=0",
        "--set",
        "options.switches=1",
        "--set",
        "sweep.points=3",
        "--set",
        "sweep.from=0.15",
        "--set",
        "sweep.to=0.3",
        "--format",
        "csv",
    ];
    let rows = rows(&run(&set).succeeded());
    let of_kind = |word: &str| {
        let own = rows
            .iter()
            .filter(|row| cell(row, "kind") == "period-doubling" && cell(row, "word") == word);
        own.map(|row| (number(row, "d"), cell(row, "velocities").to_owned()))
            .collect::<Vec<_>>()
    };
    let (flips, doubled) = (of_kind("BT"), of_kind("BTBT"));
    assert_eq!(flips.len(), 2, "{flips:?}");
    for (d, velocities) in &flips {
        let mut own = doubled
            .iter()
            .filter(|(at, other)| (at - d).abs() < 1e-9 && other.starts_with(&velocities[..9]));
        assert!(own.next().is_some(), "{d} {velocities}: {doubled:?}");
    }
}

#[test]
fn a_device_of_another_word_is_a_proved_motion_and_no_bound_of_all() {
    let rows = rows(
        &run(&[
            "optimise",
            "examples/optimum.toml",
            "--set",
            "words=BTT",
            "--format",
            "csv",
        ])
        .succeeded(),
    );
    let rate = &rows[0];
    assert!(cell(rate, "high").is_empty() && cell(rate, "complete") == "false");
    assert!(
        number(rate, "low") <= number(rate, "value") && number(rate, "low") > 100_000.0,
        "{rate:?}"
    );
    assert!(
        rows[1..]
            .iter()
            .all(|row| cell(row, "low").is_empty() && number(row, "value").is_finite())
    );
    let both = run(&[
        "optimise",
        "examples/optimum.toml",
        "--set",
        "words=[\"BT\", \"BTT\"]",
        "--gap",
        "0.5",
    ]);
    assert!(both.stderr.contains("BT alone is searched"), "{}", both.stderr);
}

#[test]
fn curves_of_other_words_pass_through_the_bifurcations_on_their_lines() {
    let set =
        "branch={lines = 1, x = {over = \"g\", from = 0.5, to = 0.9}, y = {over = \"r_b\", from = 0.4, to = 0.6}}";
    let curves = rows(&run(&["branch", TABLE, "--format", "csv", "--set", set]).succeeded());
    let flips: Vec<_> = curves
        .iter()
        .filter(|row| cell(row, "kind") == "period-doubling")
        .collect();
    assert!(flips.len() > 4, "{}", curves.len());
    for row in flips {
        let (g, r) = (number(row, "g"), number(row, "r_b"));
        let sum =
            (std::f64::consts::PI * (1.0 - r) / (1.0 + r)).powi(2) + (2.0 * (1.0 + r * r) / (1.0 + r).powi(2)).powi(2);
        assert!((g - sum.sqrt().recip()).abs() < 1e-12, "{row:?}");
    }
}

#[test]
fn maps_and_basins_take_the_same_motions() {
    let x = "map={impacts = 300, keep = 20, want = [\"word\"], x = {over = \"g\", from = 0.6, to = 0.8, points = 3}, \
             y = {over = \"r_b\", from = 0.4, to = 0.5, points = 2}, \
             starts = [{phase = 2.2, velocity = 1.0}, {phase = 0, velocity = 0.1, z = -0.5}]}";
    let map = rows(&run(&["map", TABLE, "--set", x, "--format", "csv"]).succeeded());
    assert_eq!(map.len(), 12);
    assert!(map.iter().any(|row| cell(row, "word") == "B") && map.iter().any(|row| cell(row, "word") == "BB"));
    let basins =
        "basins={impacts = 500, phase = {from = 0, to = 6, points = 4}, velocity = {from = 0.2, to = 1, points = 3}}";
    let set = [
        "basins",
        TABLE,
        "--set",
        "motion.g=0.75",
        "--set",
        basins,
        "--format",
        "csv",
    ];
    let told = run(&set).succeeded();
    assert!(told.contains(",B,1,"), "{told}");
}

#[test]
fn plastic_impacts_rest_at_once() {
    let set = [
        "simulate",
        "fig02",
        "--set",
        "motion.r_b=0",
        "--set",
        "motion.d=0.3",
        "--impacts",
        "20",
        "--format",
        "csv",
    ];
    let rows = rows(&run(&set).succeeded());
    let rests = rows
        .windows(2)
        .filter(|pair| cell(&pair[1], "kind") == "rest" && cell(&pair[0], "side") == "bottom");
    let mut count = 0;
    for pair in rests {
        count += 1;
        assert_eq!(cell(&pair[0], "phase"), cell(&pair[1], "phase"));
    }
    assert!(count > 3, "{rows:?}");
}

#[test]
fn what_does_not_go_together_is_refused_with_the_key() {
    for (arguments, wanted) in [
        (
            &["optimise", "examples/optimum.toml", "--set", "motion.walls=bottom"][..],
            "motion.walls",
        ),
        (
            &[
                "sweep",
                TABLE,
                "--set",
                "sweep={over = \"d\", from = 0.1, to = 0.2, points = 2, impacts = 9, keep = 1, start = \"each\"}",
                "--set",
                "start={phase = 0, velocity = 1}",
                "--set",
                "motion.g=0.5",
            ],
            "sweep.over",
        ),
        (&["simulate", SQUARE, "--set", "start.z=0.2"], "start.z"),
        (&["simulate", SQUARE, "--set", "start.side=top"], "start.side"),
        (
            &[
                "simulate",
                "fig02",
                "--set",
                "motion.d=0.3",
                "--set",
                "start.velocity=-1",
            ],
            "start.velocity",
        ),
        (
            &["simulate", "fig02", "--set", "motion.d=0.3", "--set", "start.side=left"],
            "start.side",
        ),
        (
            &[
                "simulate",
                TABLE,
                "--set",
                "start={phase = 0, velocity = 1, side = \"top\"}",
                "--set",
                "motion.g=0.5",
            ],
            "start.side",
        ),
        (&["orbits", TABLE, "--set", "motion.g=0.5", "--set", "words=BT"], "top"),
        (
            &["orbits", SQUARE, "--set", "forcing.cosines=[1, \"x\"]"],
            "forcing.cosines",
        ),
        (&["orbits", SQUARE, "--set", "motion.walls=none"], "motion.walls"),
        (&["orbits", SQUARE, "--set", "motion.r_b=-0.1"], "from 0 to 1"),
    ] {
        let ran = run(arguments);
        assert_eq!(ran.status, Some(2), "{arguments:?}: {}", ran.stderr);
        assert!(ran.stderr.contains(wanted), "{arguments:?}: {}", ran.stderr);
    }
}

/// The scenes are golden/table/scenes/table.toml and golden/table/scenes/bouncing.toml.
#[test]
fn the_textbook_on_the_shaken_table_is_reproduced() {
    let ran = run(&["check", "golden/table", "--format", "csv"]);
    assert_eq!(ran.status, Some(0), "{}", ran.stderr);
    assert_eq!(rows(&ran.stdout).len(), 7);
    let scratch = scratch("driven-elsewhere");
    let moved = scratch.run(&[
        "check",
        concat!(env!("CARGO_MANIFEST_DIR"), "/golden/table"),
        "--format",
        "csv",
    ]);
    assert_eq!(moved.status, Some(0), "{}", moved.stderr);
}
