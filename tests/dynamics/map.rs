//! `map` as a script sees it: each point is that of a sweep through it.

use super::sweep::Sheet;
use crate::common::program::{program, run};
use vibro_audit::impact::{Event, Kind, Simulation, Start};
use vibro_audit::model::{Motion, Side};
use vibro_audit::number::{Analytic, DoubleDouble, Sequence};
use vibro_audit::orbit::{Attractor, OrbitOptions};

/// `map SCENE --format csv` with these overrides.
fn arguments<'a>(scene: &'a str, sets: &[&'a str]) -> Vec<&'a str> {
    let mut arguments = vec!["map", scene, "--format", "csv", "--set", MAP];
    arguments.extend(sets.iter().flat_map(|set| ["--set", set]));
    arguments
}

fn mapped(scene: &str, sets: &[&str]) -> Sheet {
    Sheet::of(&run(&arguments(scene, sets)).succeeded())
}

/// The map of the device of Fig. 3 whose overrides follow.
const MAP: &str = r#"map={impacts = 500, x = {over = "d", from = 0.1, to = 0.5, points = 201}, y = {over = "r_b", from = 0.3, to = 0.9, points = 121}}"#;

const FEW: [&str; 3] = ["map.x.points=6", "map.y.points=3", "map.impacts=90"];

/// What `sweep --summary` and `map` both tell.
const SHARED: [&str; 10] = [
    "word",
    "periods",
    "impacts",
    "mean_voltage",
    "mean_voltage_error",
    "voltage_rate",
    "voltage_rate_error",
    "lyapunov",
    "lyapunov_error",
    "digits",
];

/// Holds every row of a map of fig03 against sweeps over d, for each value of y one, with these overrides there.
fn assert_swept(sets: &[&str], overrides: &[&[&str]]) {
    let few = FEW.iter().chain(sets).copied().collect::<Vec<_>>();
    let map = mapped("fig03", &few);
    assert_eq!(map.rows.len(), 6 * overrides.len());
    for (row, own) in overrides.iter().enumerate() {
        let swept = ["sweep.points=6", "sweep.impacts=90", "sweep.keep=1"];
        let all: Vec<&str> = swept.iter().chain(*own).copied().collect();
        let sweep = Sheet::summary("fig03", &all);
        assert_eq!(sweep.rows.len(), 6);
        for column in SHARED {
            let along_x = &map.texts(column)[6 * row..6 * row + 6];
            assert_eq!(along_x, sweep.texts(column), "{column} of {own:?}");
        }
        assert_eq!(map.texts("x")[6 * row..6 * row + 6], sweep.texts("d"));
    }
}

#[test]
fn the_columns_are_those_that_scripts_rely_on() {
    let map = mapped("fig03", &FEW);
    let columns = "x,y,start,word,periods,impacts,mean_voltage,mean_voltage_error,voltage_rate,voltage_rate_error,\
                   lyapunov,lyapunov_error,digits";
    assert_eq!(map.columns.join(","), columns);
    assert_eq!(map.numbers("y")[5..7], [0.3, 0.6]);
    assert_eq!(map.numbers("x")[..7], [0.1, 0.18, 0.26, 0.34, 0.42, 0.5, 0.1]);
    assert!(map.texts("start").iter().all(|start| *start == "0"));
}

#[test]
fn each_row_along_x_is_the_sweep_at_that_y() {
    assert_swept(&[], &[&["motion.r_b=0.3"], &["motion.r_b=0.6"], &["motion.r_b=0.9"]]);
    let by_force = ["map.y.over=forcing_amplitude", "map.y.from=4", "map.y.to=6"];
    let force = [
        "device.forcing_amplitude=4",
        "device.forcing_amplitude=5",
        "device.forcing_amplitude=6",
    ];
    assert_swept(&by_force, &force.each_ref().map(std::slice::from_ref));
    let by_incline = ["map.y.over=incline", "map.y.from=0", "map.y.to=pi/3"];
    let incline = ["device.incline=0", "device.incline=pi/6", "device.incline=pi/3"];
    assert_swept(&by_incline, &incline.each_ref().map(std::slice::from_ref));
    let following = ["map.start=follow"];
    let follow = |r_b| ["sweep.start=follow", r_b];
    let rows = [
        follow("motion.r_b=0.3"),
        follow("motion.r_b=0.6"),
        follow("motion.r_b=0.9"),
    ];
    assert_swept(&following, &rows.each_ref().map(|row| row.as_slice()));
}

#[test]
fn every_start_has_a_row_along_x_at_each_y() {
    let starts = "map.starts=[{phase = 6.18, velocity = 0.5293}, {phase = \"pi/2\", velocity = 1}]";
    let [here, there] = [
        ["start.phase=6.18", "start.velocity=0.5293"],
        ["start.phase=pi/2", "start.velocity=1"],
    ];
    let at = |start: [&'static str; 2], r_b| [start[0], start[1], r_b];
    let rows = ["motion.r_b=0.3", "motion.r_b=0.6", "motion.r_b=0.9"].map(|r_b| [at(here, r_b), at(there, r_b)]);
    let rows: Vec<&[&str]> = rows.iter().flatten().map(|row| row.as_slice()).collect();
    assert_swept(&[starts], &rows);
    let map = mapped("fig03", &[starts, "map.x.points=1", "map.y.points=2", "map.impacts=9"]);
    assert_eq!(map.texts("start"), ["0", "1", "0", "1"]);
}

#[test]
fn gravity_may_be_given_where_the_device_gives_it_too() {
    let sets = [
        "map.x.points=1",
        "map.y.over=g",
        "map.y.from=0",
        "map.y.to=0.4",
        "map.y.points=2",
        "map.impacts=300",
    ];
    let map = mapped("fig03", &sets);
    let device = [
        "device.incline=0",
        "sweep.points=1",
        "sweep.impacts=300",
        "sweep.keep=1",
    ];
    let sweep = Sheet::summary("fig03", &device);
    assert_eq!(map.texts("voltage_rate")[0], sweep.texts("voltage_rate")[0]);
}

#[test]
fn what_is_not_wanted_is_empty_and_needs_nothing() {
    let word = "map.want=[\"word\"]";
    let sets: Vec<&str> = FEW.into_iter().chain([word, "membrane.stiffness=-1"]).collect();
    let map = mapped("fig03", &sets);
    for column in [
        "mean_voltage",
        "voltage_rate",
        "voltage_rate_error",
        "lyapunov",
        "digits",
    ] {
        assert!(map.texts(column).iter().all(|text| text.is_empty()), "{column}");
    }
    assert!(map.texts("word").iter().any(|word| !word.is_empty()));
    let rate = "map.want=voltage_rate";
    let sets: Vec<&str> = FEW.into_iter().chain([rate]).collect();
    let map = mapped("fig03", &sets);
    assert!(map.texts("voltage_rate").iter().all(|text| !text.is_empty()));
    assert!(map.texts("word").iter().all(|text| text.is_empty()));
}

#[test]
fn rows_are_the_same_bytes_however_many_threads_compute_them() {
    for sets in [&FEW[..], &["map.x.points=1500", "map.y.points=2", "map.impacts=20"]] {
        let texts = [1, 3].map(|threads| program(arguments("fig03", sets)).threads(threads).run().stdout);
        assert!(texts[0].len() > 1000 && texts.iter().all(|text| *text == texts[0]));
    }
}

#[test]
fn what_cannot_be_mapped_is_refused_before_anything_is_written() {
    for (set, words) in [
        ("map.y.over=d", &["map.y.over", "another parameter than d"][..]),
        ("map.y.over=mass", &["map.y.over", "one of d, r_b"]),
        ("map.y.to=1.2", &["map.y.to is 1.2", "from 0 to 1"]),
        ("map.y.to=0.3", &["other than map.y.from"]),
        ("map.x.points=0", &["map.x.points is 0", "an integer from 1"]),
        ("map.x.from=NaN", &["map.x.from"]),
        ("map.impacts=0", &["map.impacts is 0"]),
        ("map.keep=501", &["map.keep is 501", "at most map.impacts, 500"]),
        ("map.start=never", &["never", "each"]),
        ("map.want=[]", &["map.want", "some of word"]),
        ("map.want=[\"words\"]", &["words", "did you mean word?"]),
        ("map.starts=[]", &["map.starts", "a list of starts"]),
        ("map.starts=[1]", &["map.starts", "a list of starts"]),
        ("map.starts=[{phase=1}]", &["map.starts", "velocity"]),
        ("map.starts=[{phase=1, velocity=-1}]", &["velocity is -1", "0 or more"]),
        ("map.starts=[{phase=1, velocity=1, side=1}]", &["not side"]),
        ("map.z.points=1", &["map.z", "map.x"]),
        ("map.x=1", &["map.x is a section"]),
        ("map.x={form = 1}", &["map.x.form", "did you mean from?"]),
    ] {
        run(&arguments("fig03", &[set])).refused(words);
    }
    let both = ["map.x.over=g", "map.y.over=incline", "map.x.from=0", "map.y.from=0"];
    run(&arguments("fig03", &both)).refused(&["not both g and incline"]);
    let text = "motion = { g = 0.1, r_t = 0.5 }\nstart = { phase = 1, velocity = 1 }\n";
    let without = program(["map", "-"]).input(text).run();
    without.refused(&["`map` requires map.x.over"]);
}

/// The word and the periods that a motion in 31 digits comes to within so many impacts.
fn in_many_digits(motion: &Motion<f64>, start: &Start<f64>, impacts: usize) -> Option<(String, Option<i64>)> {
    let wide = |value: &f64| DoubleDouble::from_f64(*value);
    let motion = motion.convert(wide).expect("a motion");
    let mut events: Vec<Event<f64>> = Vec::new();
    let mut left = impacts;
    for event in Simulation::new(&motion, &start.convert(wide)) {
        events.push(event.convert(DoubleDouble::to_f64));
        left -= usize::from(event.kind == Kind::Impact);
        if left == 0 {
            break;
        }
    }
    let found = Attractor::of(&events, &OrbitOptions::DEFAULT)?;
    Some((found.word, found.periods))
}

#[test]
fn at_200_random_points_a_map_says_what_31_digits_say_wherever_it_claims_a_digit() {
    let mut sequence = Sequence::new(18);
    let (mut claimed, mut cycles) = (0, 0);
    for _ in 0..5 {
        let g = sequence.between(-0.4, 0.4);
        let r_t = sequence.between(0.3, 0.8);
        let [d, r_b] =
            [0.08, 0.3].map(|low| [sequence.between(low, low + 0.1), sequence.between(low + 0.2, low + 0.5)]);
        let scene = format!(
            "motion = {{ g = {g}, r_t = {r_t} }}\nstart = {{ phase = 6.18, velocity = 0.5293 }}\n\
             [map]\nimpacts = 500\nwant = [\"word\", \"lyapunov\"]\n\
             x = {{ over = \"d\", from = {}, to = {}, points = 10 }}\n\
             y = {{ over = \"r_b\", from = {}, to = {}, points = 4 }}\n",
            d[0], d[1], r_b[0], r_b[1]
        );
        let mapped = program(["map", "-", "--format", "csv"]).input(&scene).run();
        let map = Sheet::of(&mapped.succeeded());
        assert_eq!(map.rows.len(), 40);
        for row in 0..40 {
            let [d, r_b] = ["x", "y"].map(|column| map.numbers(column)[row]);
            let motion = Motion::new(g, d, r_b, r_t).expect("a motion");
            let start = Start::impact(Side::Bottom, 6.18, 0.5293);
            if map.texts("digits")[row] == "0" {
                continue;
            }
            claimed += 1;
            let word = map.texts("word")[row];
            let is_cycle = !word.is_empty();
            // a map follows what has not repeated yet for `options.settling_impacts` more
            let exact = in_many_digits(&motion, &start, 500)
                .or_else(|| is_cycle.then(|| in_many_digits(&motion, &start, 20_500)).flatten());
            // a cycle through a rest is looked for farther than within these impacts; what comes to one comes to no other
            let rests = |word: &str| word.contains('*');
            match &exact {
                None if rests(word) => continue,
                Some((exact, _)) if rests(exact) && rests(word) => continue,
                _ => {}
            }
            let periods = map.texts("periods")[row].parse().ok();
            let told = (!word.is_empty()).then(|| (word.to_owned(), periods));
            assert_eq!(told, exact, "g {g} d {d} r {r_b} {r_t}");
            cycles += usize::from(told.is_some());
        }
    }
    assert!(claimed > 60 && cycles > 20, "{claimed} {cycles}");
}

#[test]
fn a_rest_after_errors_have_taken_the_motion_over_has_no_digits() {
    // by 40 digits it settles on BT; in f64 it drifts into a rest, which forgets what was before
    let scene = "motion = { g = -0.6696425720858179, r_t = 0.827 }\nstart = { phase = 4.485, velocity = 1.382 }\n\
                 [map]\nimpacts = 1000\nwant = [\"word\", \"lyapunov\"]\n\
                 x = { over = \"d\", from = 0.455, to = 0.456, points = 1 }\n\
                 y = { over = \"r_b\", from = 0.605, to = 0.606, points = 1 }\n";
    let mapped = program(["map", "-", "--format", "csv"]).input(scene).run();
    let map = Sheet::of(&mapped.stdout);
    let told = (map.texts("word")[0], map.texts("digits")[0]);
    assert!(told.0 == "BT" || told.1 == "0", "{told:?}");
}
