//! `sweep` as a script sees it: columns, order, what depends on nothing but the scene, and what it refuses.

use crate::common::program::{program, run, scratch};
use vibro_audit::impact::{Start, Widening};
use vibro_audit::model::{Motion, Side};
use vibro_audit::number::Sequence;
use vibro_audit::orbit::{AtRelease, Averaging, AveragingLength, LongRun, Statistics, SteadyState};
use vibro_audit::scene::{MeanOver, Scene, find};

/// `sweep SCENE --format csv` with these overrides and flags.
fn arguments<'a>(scene: &'a str, sets: &[&'a str], flags: &[&'a str]) -> Vec<&'a str> {
    let mut arguments = vec!["sweep", scene, "--format", "csv"];
    arguments.extend(sets.iter().flat_map(|set| ["--set", set]));
    arguments.extend(flags);
    arguments
}

/// A CSV, by column.
pub(super) struct Sheet {
    pub columns: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Sheet {
    pub fn of(text: &str) -> Self {
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect());
        let columns = lines.next().unwrap();
        let rows = lines.collect();
        Self { columns, rows }
    }

    fn swept(scene: &str, sets: &[&str]) -> Self {
        Self::of(&run(&arguments(scene, sets, &[])).succeeded())
    }

    pub fn summary(scene: &str, sets: &[&str]) -> Self {
        Self::of(&run(&arguments(scene, sets, &["--summary"])).succeeded())
    }

    pub fn texts(&self, column: &str) -> Vec<&str> {
        let index = self.columns.iter().position(|name| name == column).unwrap();
        self.rows.iter().map(|row| row[index].as_str()).collect()
    }

    pub fn numbers(&self, column: &str) -> Vec<f64> {
        self.texts(column).iter().map(|text| text.parse().unwrap()).collect()
    }
}

const FEW: [&str; 3] = ["sweep.points=5", "sweep.impacts=80", "sweep.keep=7"];

#[test]
fn the_columns_are_those_that_scripts_rely_on() {
    let swept = Sheet::swept("fig03", &FEW);
    assert_eq!(swept.columns, ["d", "impact", "side", "phase", "velocity", "voltage"]);
    let d: Vec<f64> = [0.1, 0.2, 0.3, 0.4, 0.5].iter().flat_map(|d| [*d; 7]).collect();
    assert_eq!(swept.numbers("d"), d);
    assert_eq!(swept.texts("impact")[..7], ["74", "75", "76", "77", "78", "79", "80"]);
    for ((side, velocity), phase) in swept
        .texts("side")
        .iter()
        .zip(swept.numbers("velocity"))
        .zip(swept.numbers("phase"))
    {
        assert_eq!(*side == "bottom", velocity > 0.0);
        assert!((0.0..std::f64::consts::TAU).contains(&phase));
    }
    assert!(swept.numbers("voltage").iter().all(|voltage| *voltage > 0.0));
    let summary = Sheet::summary("fig03", &FEW);
    let columns = "d,word,periods,impacts,mean_voltage,lyapunov,digits,mean_over,\
                   mean_voltage_error,voltage_rate,voltage_rate_error,lyapunov_error,error_met";
    assert_eq!(summary.columns.join(","), columns);
    assert_eq!(summary.numbers("d"), [0.1, 0.2, 0.3, 0.4, 0.5]);
    let by_incline = ["sweep.over=incline", "sweep.from=0", "sweep.to=pi/3"];
    let sets: Vec<&str> = FEW.into_iter().chain(by_incline).collect();
    let swept = Sheet::swept("fig03", &sets);
    assert_eq!(swept.columns[..2], ["incline", "d"]);
    assert!((swept.numbers("incline")[34] - std::f64::consts::FRAC_PI_3).abs() < 1e-15);
    assert!(swept.numbers("d").iter().all(|d| *d == 0.26));
}

#[test]
fn at_the_values_of_the_paper_are_its_motions_and_voltages() {
    for (scene, d, word, impacts, voltage) in [
        ("fig02", "0.26", "BT", "2", 37876.794),
        ("fig02", "0.4", "BT", "2", 49816.458),
        ("fig03", "0.33", "BT", "2", 47272.052),
        ("fig03", "0.26", "BTT", "3", 28526.39),
        ("fig03", "0.5", "BT", "2", 61152.5467),
        ("fig08", "0.5", "BT", "2", 61054.3835),
    ] {
        let from = format!("sweep.from={d}");
        let summary = Sheet::summary(scene, &[&from, "sweep.points=1"]);
        let row = (
            summary.texts("word")[0],
            summary.texts("periods")[0],
            summary.texts("impacts")[0],
        );
        assert_eq!(row, (word, "1", impacts), "{scene} {d}");
        assert_eq!(summary.texts("mean_over"), ["periods"]);
        let found = summary.numbers("mean_voltage")[0];
        // within one unit of the last figure
        let unit = if voltage == 28526.39 { 0.01 } else { 0.001 };
        assert!((found - voltage).abs() <= unit, "{scene} {d}: {found}");
    }
}

#[test]
fn the_mean_is_that_of_the_impacts_it_counts() {
    let sets = ["sweep.points=9", "start.velocity=23"];
    let (swept, summary) = (Sheet::swept("fig05", &sets), Sheet::summary("fig05", &sets));
    for (index, d) in summary.numbers("d").into_iter().enumerate() {
        let rows = swept.numbers("d").into_iter().zip(swept.numbers("voltage"));
        let voltages: Vec<f64> = rows.filter(|row| row.0 == d).map(|row| row.1).collect();
        let counted: usize = summary.texts("impacts")[index].parse().unwrap();
        // one cycle of a chatter may be longer than what is kept
        let Some(last) = voltages.len().checked_sub(counted) else {
            continue;
        };
        let mean = voltages[last..].iter().sum::<f64>() / counted as f64;
        let found = summary.numbers("mean_voltage")[index];
        assert!((mean - found).abs() <= 1e-7 * found, "{d}: {mean} {found}");
    }
}

#[test]
fn a_motion_that_rests_has_a_star_in_its_word() {
    let summary = Sheet::summary("fig03", &["sweep.from=0.17", "sweep.to=0.19", "sweep.points=5"]);
    assert_eq!(
        (summary.texts("word"), summary.texts("periods")),
        (vec!["BT*"; 5], vec!["1"; 5])
    );
    // each of the impacts that are listed of a chatter counts
    assert!(
        summary
            .texts("impacts")
            .iter()
            .all(|impacts| impacts.parse().is_ok_and(|impacts: u32| impacts > 8))
    );
    assert_eq!(summary.texts("mean_over"), ["periods"; 5]);
    let heavy = ["sweep.over=g", "sweep.from=1.5", "sweep.points=1"];
    let summary = Sheet::summary("fig03", &heavy);
    assert_eq!(
        (summary.texts("word"), summary.texts("periods")),
        (vec!["B*"], vec![""])
    );
    // at rest for ever it makes no impact, and has no mean
    assert_eq!(
        (summary.texts("impacts"), summary.texts("mean_voltage")),
        (vec!["0"], vec![""])
    );
    let swept = Sheet::swept("fig03", &heavy);
    assert_eq!(swept.texts("impact")[0], "1");
    assert!(swept.rows.len() < 60 && swept.numbers("velocity").iter().all(|velocity| velocity.abs() >= 1e-6));
}

#[test]
fn rows_are_the_same_bytes_however_many_threads_there_are() {
    let sets = ["sweep.points=101", "start.velocity=67"];
    for (scene, flags) in [
        ("fig04", &[][..]),
        ("fig03", &["--summary"]),
        ("fig02", &["--format", "json"]),
    ] {
        let flags: Vec<&str> = flags.to_vec();
        let mut arguments = arguments(scene, &sets, &[]);
        if flags.contains(&"json") {
            arguments.retain(|argument| !["--format", "csv"].contains(argument));
        }
        arguments.extend(flags);
        let outputs = [1, 2, 7].map(|threads| program(&arguments).threads(threads).run().stdout);
        assert!(
            outputs[0].len() > 2000 && outputs.iter().all(|output| *output == outputs[0]),
            "{scene}"
        );
    }
}

#[test]
fn a_sweep_downwards_is_the_sweep_upwards_from_its_end() {
    let up = Sheet::swept("fig02", &FEW);
    let down: Vec<&str> = FEW.into_iter().chain(["sweep.from=0.5", "sweep.to=0.1"]).collect();
    let down = Sheet::swept("fig02", &down);
    let turned: Vec<&Vec<String>> = down.rows.chunks(7).rev().flatten().collect();
    assert_eq!(turned, up.rows.iter().collect::<Vec<_>>());
}

#[test]
fn where_a_value_follows_it_starts_from_the_last_impact_of_the_one_before() {
    let sets = [
        "sweep.start=follow",
        "sweep.points=6",
        "sweep.impacts=30",
        "sweep.keep=30",
    ];
    let swept = Sheet::swept("fig02", &sets);
    let state = |row: &Vec<String>| row[2..5].to_vec();
    let values: Vec<&[Vec<String>]> = swept.rows.chunks(30).collect();
    assert_eq!(values.len(), 6);
    for pair in values.windows(2) {
        assert_eq!(state(&pair[0][29]), state(&pair[1][0]));
    }
    let each = Sheet::swept("fig02", &["sweep.points=6", "sweep.impacts=30", "sweep.keep=30"]);
    assert_eq!(swept.rows[..30], each.rows[..30]);
    assert_ne!(swept.rows[30], each.rows[30]);
}

#[test]
fn following_up_and_down_shows_hysteresis_and_threads_change_nothing() {
    // the 1-1 motion attracts down to its grazing at .2612, the motion of three impacts up to .28
    let range = |from, to| vec!["sweep.start=follow", "sweep.points=31", "sweep.keep=12", from, to];
    let up = Sheet::summary("fig03", &range("sweep.from=0.24", "sweep.to=0.3"));
    let down = Sheet::summary("fig03", &range("sweep.from=0.3", "sweep.to=0.24"));
    assert_eq!((up.texts("word")[0], up.texts("word")[30]), ("BTT", "BT"));
    let mut back = down.texts("word");
    back.reverse();
    assert_eq!((back[0], back[30]), ("BTT", "BT"));
    let change = |words: &[&str]| words.iter().filter(|word| **word == "BTT").count();
    assert!(
        change(&up.texts("word")) > change(&back),
        "{:?} {back:?}",
        up.texts("word")
    );
    let sets = range("sweep.from=0.24", "sweep.to=0.3");
    let outputs = [1, 2, 7].map(|threads| program(arguments("fig03", &sets, &[])).threads(threads).run().stdout);
    assert!(outputs.iter().all(|output| *output == outputs[0]));
}

const BARE: &str = "want = [\"sweep\"]
motion = { g = 0.12, d = 0.4, r_b = 0.5, r_t = 0.5 }
start = { phase = 6.18, velocity = 0.5293 }
sweep = { over = \"r_t\", from = 0.9, to = 1, points = 3, impacts = 20, keep = 20, start = \"each\" }
";

#[test]
fn without_a_voltage_wanted_no_membrane_is_looked_at() {
    let asked = |scene: &str| program(["sweep", "-", "--format", "csv"]).input(scene).run();
    let bare = asked(BARE);
    let text = bare.stdout;
    assert!(
        text.starts_with("r_t,d,impact,side,phase,velocity,voltage\n0.9,0.4,1,bottom,6.18,0.5293,\n"),
        "{text}"
    );
    assert!(bare.stderr.contains("no voltage"));
    assert!(text.lines().skip(1).all(|line| line.ends_with(',')));
    assert!(
        text.lines().any(|line| line.starts_with("1.0,0.4,20,")),
        "the last value is 1"
    );
    let broken = ["want=['sweep']", "membrane.stiffness=-1", "sweep.points=1"];
    assert_eq!(Sheet::swept("fig03", &broken).texts("voltage")[0], "");
    let wanted = ["membrane.stiffness=-1", "sweep.points=1"];
    run(&arguments("fig03", &wanted, &[])).refused(&["membrane.stiffness is -1"]);
    // a scene that does not say what it wants
    let lines = find("fig03").unwrap().lines().filter(|line| !line.starts_with("want"));
    let text = lines
        .collect::<Vec<_>>()
        .join("\n")
        .replace("points = 401", "points = 1");
    let with_membrane = Sheet::of(&asked(&text).stdout);
    assert_ne!(with_membrane.texts("voltage")[0], "");
}

#[test]
fn what_cannot_be_swept_is_refused_before_anything_is_written() {
    for (sets, words) in [
        (
            &["sweep.keep=501"][..],
            &["sweep.keep is 501", "at most sweep.impacts, 500"][..],
        ),
        (&["sweep.start=never"], &["never", "each"]),
        (&["sweep.error=0"], &["sweep.error is 0", "above 0"]),
        (&["sweep.most_impacts=0"], &["sweep.most_impacts is 0"]),
        (
            &["sweep.impacts=1000000000", "sweep.keep=1000000000"],
            &["sweep.keep is 1000000000", "1000000"],
        ),
        (&["sweep.from=0"], &["sweep.from is 0", "above 0"]),
        (&["sweep.from=NaN"], &["sweep.from is NaN"]),
        (&["sweep.to=0.1"], &["sweep.to", "other than sweep.from"]),
        (&["sweep.points=0"], &["sweep.points is 0"]),
        (&["sweep.over=moon"], &["moon", "forcing_amplitude"]),
        (&["start.velocity=-1"], &["start.velocity is -1"]),
        (
            &["membrane.membrane_radius=0.004"],
            &["membrane_radius is 0.004", "ball_radius"],
        ),
    ] {
        for flags in [&[][..], &["--summary"]] {
            run(&arguments("fig03", sets, flags)).refused(words);
        }
    }
    let lacking = BARE.replace("start = {", "# start = {");
    let lacking = program(["sweep", "-"]).input(&lacking).run();
    lacking.refused(&["`sweep` requires start.phase"]);
    let junit = program(["sweep", "-", "--format", "junit"]).input(BARE).run();
    junit.refused(&["[possible values: text, csv, json, jsonl, markdown]"]);
    run(&["sweep", "fig12"]).refused(&["`sweep` requires sweep.over"]);
    run(&["sweep"]).refused(&["SCENE"]);
    let scratch = scratch("refused");
    let out = scratch.path("none/sweep.csv");
    run(&["sweep", "fig03", "--out", &out]).refused(&["there is no directory"]);
    let out = scratch.path("sweep.csv");
    run(&["sweep", "fig03", "--out", &out, "--set", "sweep.keep=0"]).refused(&["sweep.keep"]);
    assert_eq!(scratch.names().len(), 0);
}

#[test]
fn every_format_has_all_rows_and_a_file_is_what_stdout_would_be() {
    let sets = ["--set", "sweep.points=21", "--set", "sweep.keep=60"];
    let with = |flags: &[&str]| run(&[&["sweep", "fig03"], &sets[..], flags].concat()).succeeded();
    let csv = with(&["--format", "csv"]);
    let rows = csv.lines().count() - 1;
    assert_eq!(rows, 21 * 60);
    let json: serde_json::Value = serde_json::from_str(&with(&["--format", "json"])).unwrap();
    let array = json.as_array().unwrap();
    assert_eq!(array.len(), rows);
    let first: Vec<&str> = csv.lines().nth(1).unwrap().split(',').collect();
    assert_eq!(array[0]["velocity"].as_f64(), first[4].parse().ok());
    assert_eq!(with(&["--format", "markdown"]).lines().count(), rows + 2);
    let text = with(&[]);
    assert_eq!(text.lines().count(), rows + 2, "one line a row: it fits a terminal");
    let scratch = scratch("formats");
    let out = scratch.path("sweep.csv");
    assert_eq!(with(&["--format", "csv", "--out", &out]), "");
    assert_eq!(scratch.read("sweep.csv"), csv);
}

#[test]
fn run_writes_the_diagram_and_its_summary() {
    let scratch = scratch("run");
    let out = scratch.to_str().unwrap();
    let told = run(&[
        "run",
        "fig14",
        "--set",
        "sweep.points=3",
        "--out",
        out,
        "--format",
        "csv",
    ])
    .succeeded();
    assert!(
        told.contains("sweep.csv,180") && told.contains("summary.csv,3"),
        "{told}"
    );
    for (file, flags) in [("sweep.csv", &[][..]), ("summary.csv", &["--summary"])] {
        let alone = run(&arguments("fig14", &["sweep.points=3"], flags)).succeeded();
        assert_eq!(scratch.read(file), alone);
    }
}

#[test]
fn the_library_gives_the_points_that_the_command_prints() {
    let mut scene = Scene::read(find("fig03").unwrap(), "fig03").unwrap();
    for set in FEW {
        scene.set(set).unwrap();
    }
    let points: Vec<_> = scene.points().unwrap().map(Result::unwrap).collect();
    let swept = Sheet::swept("fig03", &FEW);
    let velocities = points
        .iter()
        .flat_map(|point| point.settled.kept.iter().map(|event| event.velocity));
    assert_eq!(velocities.collect::<Vec<_>>(), swept.numbers("velocity"));
    let voltages = points.iter().flat_map(|point| point.voltages.clone().unwrap());
    assert_eq!(voltages.collect::<Vec<_>>(), swept.numbers("voltage"));
    assert_eq!(points[4].means.as_ref().unwrap().over, MeanOver::Periods);
}

#[test]
fn the_summary_says_how_far_it_can_be_relied_on() {
    let summary = Sheet::summary("fig02", &["sweep.from=0.4", "sweep.points=1"]);
    // a focus: both multipliers have the size of the root of the determinant, (r_b r_t)²
    assert!((summary.numbers("lyapunov")[0] - 0.25_f64.ln() / 2.0).abs() < 1e-9);
    assert!(summary.numbers("digits")[0] >= 12.0);
    let summary = Sheet::summary("fig03", &["sweep.from=0.18", "sweep.points=1"]);
    assert_eq!(summary.texts("lyapunov"), ["-inf"]);
    let summary = Sheet::summary("fig04", &["sweep.points=41"]);
    // none of a motion that rests now and then and has no cycle that 200 digits can tell
    let rates = summary
        .texts("lyapunov")
        .into_iter()
        .map(|rate| rate.parse::<f64>().ok());
    let rows = summary
        .texts("word")
        .into_iter()
        .zip(rates)
        .zip(summary.numbers("digits"));
    let rows: Vec<(&str, f64, f64)> = rows
        .filter_map(|((word, rate), digits)| Some((word, rate?, digits)))
        .collect();
    assert!(rows.len() >= 38, "{rows:?}");
    let chaotic = rows
        .iter()
        .filter(|(word, rate, digits)| word.is_empty() && *rate > 0.05 && *digits == 0.0);
    assert!(chaotic.count() >= 5, "{rows:?}");
    assert!(
        rows.iter().all(|(word, rate, _)| word.is_empty() || *rate < 0.0),
        "{rows:?}"
    );
}

/// g, d, r_b and r_t with a start from which the motion is chaotic.
const CHAOTIC: [[f64; 4]; 10] = [
    [0.144, 0.171, 0.700, 0.905],
    [0.270, 0.256, 0.395, 0.726],
    [0.264, 0.310, 0.579, 0.709],
    [0.225, 0.336, 0.650, 0.891],
    [0.105, 0.365, 0.889, 0.426],
    [0.053, 0.473, 0.469, 0.821],
    [0.117, 0.086, 0.762, 0.734],
    [0.179, 0.189, 0.939, 0.648],
    [0.014, 0.132, 0.915, 0.825],
    [0.048, 0.214, 0.386, 0.925],
];

/// The statistics over so many impacts from a start of this number; `None` where the motion repeats.
fn measured(motion: &Motion<f64>, start: u64, impacts: u32) -> Option<Statistics> {
    let mut sequence = Sequence::new(start);
    let (phase, velocity) = (sequence.between(0.0, std::f64::consts::TAU), sequence.between(0.2, 1.2));
    let side = Side::Bottom;
    let settled = SteadyState::after(
        Widening::new(motion, &Start::impact(side, phase, velocity)).without_growth(),
        500,
        60,
    );
    if settled.attractor.is_some() || settled.release.is_some() {
        return None;
    }
    let measure = Averaging {
        motion,
        length: AveragingLength {
            impacts,
            error: None,
            most: impacts,
        },
        voltage: Some(&|impact| impact.velocity.abs().powf(1.1)),
        with_growth: true,
        at_release: AtRelease::Ends { followed: None },
    };
    match measure.after(&settled.end?) {
        LongRun::Measured(found) => Some(found),
        LongRun::Released(..) | LongRun::Repeats(_) => None,
    }
}

/// How many of 100 intervals of 95% hold the value, by statistic, at each of these devices.
fn coverage(devices: &[[f64; 4]], replications: u64) -> Vec<[f64; 3]> {
    let each = |found: &Statistics| [found.voltage, found.rate, found.lyapunov].map(|mean| mean.expect("a mean"));
    let covered = devices.iter().enumerate().map(|(device, [g, d, r_b, r_t])| {
        let motion = Motion::new(*g, *d, *r_b, *r_t).unwrap();
        let start = |index: u64| 1000 * device as u64 + index;
        // long enough for its own error to be a thirtieth of those that are judged
        let long = |from: u64| {
            (from..)
                .find_map(|index| measured(&motion, start(index), 500_000))
                .unwrap()
        };
        let long = [0, 100, 200].map(|from| each(&long(from)));
        let value = long[0];
        // where several chaotic attractors live side by side, no one value is to be held
        for (one, other) in long.iter().flatten().zip(value.iter().cycle()) {
            let error = one.error.expect("an error") + other.error.expect("an error");
            let apart = (one.value - other.value).abs();
            assert!(apart <= 4.0 * error, "{motion:?} comes to several: {long:?}");
        }
        let (mut covered, mut count) = ([0.0; 3], 0.0);
        for found in (0..replications).filter_map(|index| measured(&motion, start(index), 500)) {
            count += 1.0;
            for ((mean, value), covered) in each(&found).iter().zip(&value).zip(&mut covered) {
                let reach = 2.093 * mean.error.expect("an error");
                *covered += f64::from((mean.value - value.value).abs() <= reach);
            }
        }
        assert!(count >= 0.4 * replications as f64, "{motion:?} is not chaotic: {count}");
        covered.map(|covered| 100.0 * covered / count)
    });
    covered.collect()
}

#[test]
fn intervals_of_95_percent_hold_the_mean_in_500_replications() {
    let covered = coverage(&CHAOTIC, 500);
    for (device, covered) in CHAOTIC.iter().zip(&covered) {
        println!("{device:?}: {covered:?}");
        assert!(
            covered.iter().all(|covered| (90.0..=99.6).contains(covered)),
            "{device:?}: {covered:?}"
        );
    }
    // of 500 with 99 in a hundred each, half are above 99 by chance
    let sharp = covered.iter().flatten().filter(|covered| **covered <= 99.0).count();
    assert!(sharp >= 27, "{covered:?}");
}

#[test]
fn a_cycle_through_a_rest_is_seen_however_long() {
    let scene = "[motion]\ng = 0.5\nd = 0.35\nr_b = 0.5\nr_t = 0.5\n[start]\nphase = 4.671\nvelocity = 6.5\n[sweep]\n\
                 over = \"d\"\nfrom = 0.35\nto = 0.36\npoints = 1\nimpacts = 500\nkeep = 60\nstart = \"each\"\n";
    let swept = program(["sweep", "-", "--summary", "--format", "csv"]).input(scene);
    let summary = Sheet::of(&swept.run().stdout);
    assert_eq!(
        (
            summary.texts("periods"),
            summary.texts("lyapunov"),
            summary.texts("impacts")
        ),
        (vec!["41"], vec!["-inf"], vec!["86"])
    );
    let word = summary.texts("word")[0];
    assert_eq!((word.matches('*').count(), word.starts_with('B')), (1, true));
    // with r_b = 0.6, r_t = 0.3, d = 0.1 errors grow so fast that 244 periods need 200 digits
    let long = Sheet::summary("fig03", &["sweep.points=1"]);
    assert_eq!((long.texts("periods"), long.texts("digits")), (vec!["244"], vec!["0"]));
}

#[test]
fn the_rate_of_the_voltage_does_not_depend_on_where_a_chatter_is_listed_to() {
    let scene = Scene::read(find("fig03").unwrap(), "fig03").unwrap();
    let (membrane, unit) = (
        scene.membrane::<f64>().unwrap(),
        scene.scales::<f64>().unwrap().velocity,
    );
    let summary = Sheet::summary("fig03", &["sweep.from=0.18", "sweep.points=1"]);
    let swept = Sheet::swept("fig03", &["sweep.from=0.18", "sweep.points=1"]);
    let speeds: Vec<f64> = swept.numbers("velocity");
    let cycle = &speeds[speeds.len() - 2 * summary.numbers("impacts")[0] as usize..];
    let first = cycle.iter().position(|velocity| *velocity > 0.0).unwrap();
    let cycle = &cycle[first..];
    let length = 1 + cycle[1..].iter().position(|velocity| *velocity > 0.0).unwrap();
    let listed_to = |least: f64| -> f64 {
        let voltage = |speed: f64| membrane.voltage(&(speed.abs() * unit));
        let listed: Vec<f64> = cycle[..length]
            .iter()
            .copied()
            .filter(|speed| speed.abs() >= least)
            .collect();
        let last = *listed.last().unwrap();
        let tail = (1..200).map(|power| voltage(last * 0.3_f64.powi(power)));
        listed.iter().map(|speed| voltage(*speed)).sum::<f64>() + tail.sum::<f64>()
    };
    let rate = summary.numbers("voltage_rate")[0];
    // of the impacts of a chatter, each 0.3 times as fast as the one before but for the bend of the acceleration
    for (least, apart) in [(1e-6, 1e-9), (1e-5, 1e-8), (1e-3, 1e-5)] {
        let by_hand = listed_to(least);
        assert!((rate - by_hand).abs() <= apart * rate, "{least}: {rate} {by_hand}");
    }
    assert_eq!(summary.texts("voltage_rate_error"), ["0.0"]);
}

#[test]
fn an_error_that_is_asked_for_is_met_or_said_not_to_be() {
    let sets = ["sweep.from=0.28", "sweep.points=1", "sweep.error=0.002"];
    let summary = Sheet::summary("fig04", &sets);
    assert_eq!(
        (summary.texts("word"), summary.texts("error_met")),
        (vec![""], vec!["true"])
    );
    assert!(summary.numbers("mean_voltage_error")[0] <= 0.002 * summary.numbers("mean_voltage")[0]);
    assert!(summary.numbers("impacts")[0] >= 1000.0 && summary.numbers("lyapunov_error")[0] > 0.0);
    let few: Vec<&str> = sets.into_iter().chain(["sweep.most_impacts=600"]).collect();
    let summary = Sheet::summary("fig04", &few);
    assert_eq!(
        (summary.texts("error_met"), summary.texts("impacts")),
        (vec!["false"], vec!["500"])
    );
    let lossless = ["sweep.from=0.36", "sweep.points=1", "motion.r_b=1", "motion.r_t=1"];
    assert_eq!(Sheet::summary("fig04", &lossless).texts("mean_voltage_error"), [""]);
}

/// A device that comes to a cycle through a rest only after a chaotic transient of some thousand impacts.
const LATE_REST: &str = r#"
want = ["sweep", "voltage"]
[device]
capsule_mass = 0.1245
forcing_amplitude = 5.0
angular_frequency = "5 pi"
incline = 0.3349
gravity = 9.8
[membrane]
ball_mass = 0.0035
stiffness = 4.0847e5
exponent = 2.6
ball_radius = 0.005
membrane_radius = 0.0063
input_voltage = 2000.0
[motion]
r_b = 0.627
r_t = 0.627
[start]
phase = 4.221
velocity = 0.64
[sweep]
over = "d"
from = 0.062
to = 0.062
points = 1
impacts = 500
keep = 60
start = "each"
"#;

fn late_rest(sets: &[&str]) -> Vec<String> {
    let swept = program(arguments("-", sets, &["--summary"])).input(LATE_REST);
    let text = swept.run().succeeded();
    let row = text.lines().nth(1).unwrap();
    row.split(',').map(str::to_owned).collect()
}

#[test]
fn a_cycle_through_a_rest_is_found_after_a_transient_however_few_impacts_are_asked_for() {
    for impacts in [500, 1000, 2000, 5000] {
        let row = late_rest(&[&format!("sweep.impacts={impacts}")]);
        let [periods, count] = [&row[2], &row[3]];
        assert_eq!((periods.as_str(), count.as_str()), ("14", "74"), "{impacts}: {row:?}");
        let [mean, rate] = [4, 9].map(|column| row[column].parse::<f64>().unwrap());
        // the means of the cycle are known to these decimals
        assert!(
            (mean - 7775.92).abs() < 0.005 && (rate - 41_101.3).abs() < 0.05,
            "{row:?}"
        );
    }
}

/// Devices like that of [`LATE_REST`], some with a rest: the means after few impacts are those of a long run, or of the cycle
/// that it comes to, within the standard errors that are given.
#[test]
fn standard_errors_hold_the_long_run_of_devices_that_rest_late() {
    let mut sequence = Sequence::new(12);
    let (mut scores, mut cycles) = (Vec::new(), 0);
    for _ in 0..12 {
        let mut between = |low: f64, high: f64| sequence.between(low, high);
        let device = [
            format!("device.incline={}", between(0.15, 0.5)),
            format!("motion.r_b={}", between(0.55, 0.7)),
            format!("motion.r_t={}", between(0.55, 0.7)),
            format!("start.phase={}", between(0.0, std::f64::consts::TAU)),
            format!("start.velocity={}", between(0.2, 1.0)),
        ];
        let d = between(0.05, 0.08);
        let gap = [format!("sweep.from={d}"), format!("sweep.to={d}")];
        let run = |impacts: &str| {
            let sets: Vec<&str> = device.iter().chain(&gap).map(String::as_str).chain([impacts]).collect();
            late_rest(&sets)
        };
        let [few, many] = ["sweep.impacts=500", "sweep.impacts=100000"].map(run);
        cycles += usize::from(few[7] == "periods");
        for (value, error) in [(4, 8), (9, 10)] {
            let number = |row: &[String], column: usize| row[column].parse::<f64>().unwrap();
            let apart = (number(&few, value) - number(&many, value)).abs();
            // what two runs round differently
            let rounding = 1e-9 * number(&many, value);
            scores.push(apart / number(&few, error).hypot(number(&many, error)).max(rounding));
        }
    }
    // 2.09 standard errors are to hold in 95%: of 24, 4 or more outside have a probability of 3%; none is far outside
    let outside = scores.iter().filter(|score| **score > 2.09).count();
    assert!(outside <= 3 && scores.iter().all(|score| *score < 4.0), "{scores:?}");
    assert!((2..12).contains(&cycles), "{cycles} devices come to a cycle");
}
