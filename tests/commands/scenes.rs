//! Scenes as their user meets them: what is read, what is refused and how, what is left alone.

use crate::common::program::{Ran, program, run, scratch};
use proptest::prelude::*;
use std::fs;
use vibro_audit::model::Side;
use vibro_audit::number::{Analytic, Wide};
use vibro_audit::scene::{BUILT_IN, Begin, Over, Quantity, Scene, SceneError, SceneProblem, Want, find};

/// A scene that lacks nothing for any want.
const WHOLE: &str = r#"
title = "mine"
want = ["orbits"]
words = ["BT", "BTT"]
max_periods = 3
digits = 20
[device]
capsule_mass = 0.1245
forcing_amplitude = 5.0
angular_frequency = "5 pi"
incline = "pi/6"
gravity = 9.8
[motion]
d = 0.26
r_b = 0.6
r_t = 0.3
[membrane]
ball_mass = 0.0035
stiffness = 4.0847e5
exponent = 2.6
ball_radius = 0.005
membrane_radius = 0.0063
input_voltage = 2000.0
[start]
phase = 6.18
velocity = 0.5293
[sweep]
over = "d"
from = 0.1
to = 0.5
points = 401
impacts = 500
keep = 60
start = "follow"
[map]
x = { over = "d", from = 0.1, to = 0.5, points = 21 }
y = { over = "r_t", from = 0.2, to = 0.8, points = 11 }
impacts = 400
[box]
r_t = [0.2, 0.8]
margin = 0.1
clearance = 0.01
[basins]
impacts = 400
[basins.phase]
from = 0
to = 6
points = 3
[basins.velocity]
from = 0
to = 1
points = 2
"#;

/// Without unit.
const BARE: &str = "motion = { g = 0.1, d = 0.26, r_b = 0.6, r_t = 0.3 }\n";

fn words(scene: &Scene) -> Vec<String> {
    scene.words().unwrap().iter().map(ToString::to_string).collect()
}

fn whole() -> Scene {
    Scene::read(WHOLE, "whole.toml").unwrap()
}

fn set(scene: &Scene, sets: &[&str]) -> Scene {
    let mut scene = scene.clone();
    for argument in sets {
        scene.set(argument).unwrap();
    }
    scene
}

/// What is said of `text` when `wants` are asked of it.
fn refusal(text: &str, wants: &[Want]) -> String {
    let checked = Scene::read(text, "x.toml").and_then(|scene| scene.check(wants));
    checked.map_or_else(|error| error.to_string(), |()| "accepted".to_string())
}

fn assert_says(message: &str, words: &[&str]) {
    for word in words {
        assert!(message.contains(word), "`{word}` is not said: {message}");
    }
}

#[test]
fn a_whole_scene_is_read_to_the_last_key() {
    let scene = whole();
    scene.check(&Want::ALL).unwrap();
    assert_eq!(scene.notes(&Want::ALL).unwrap(), []);
    assert_eq!(scene.title().unwrap(), Some("mine"));
    assert_eq!(scene.want().unwrap(), [Want::Orbits]);
    assert_eq!(words(&scene), ["BT", "BTT"]);
    assert_eq!((scene.max_periods().unwrap(), scene.digits().unwrap()), (3, 20));
    let motion = scene.motion::<f64>().unwrap();
    let restitutions = [Side::Bottom, Side::Top].map(|side| *motion.restitution(side));
    assert_eq!((*motion.d(), restitutions), (0.26, [0.6, 0.3]));
    assert!((motion.g() - 0.12201).abs() < 1e-15);
    let start = scene.start().unwrap();
    assert_eq!(
        [start.phase.to_string(), start.velocity.to_string()],
        ["6.18", "0.5293"]
    );
    let sweep = scene.sweep().unwrap();
    assert_eq!((sweep.over, sweep.points), (Over::D, 401));
    let diagram = scene.diagram().unwrap();
    assert_eq!((diagram.impacts, diagram.keep, diagram.start), (500, 60, Begin::Follow));
    let scales = scene.scales::<f64>().unwrap();
    assert!((scales.velocity - 8.032128514).abs() < 1e-9 && (scales.time - 0.2).abs() < 1e-15);
}

#[test]
fn what_is_not_said_has_its_default() {
    let scene = Scene::read(BARE, "x.toml").unwrap();
    assert_eq!(words(&scene), ["BT"]);
    assert_eq!((scene.max_periods().unwrap(), scene.digits().unwrap()), (1, 12));
    assert_eq!((scene.title().unwrap(), scene.want().unwrap()), (None, vec![]));
    scene.check(&[Want::Orbits]).unwrap();
    assert_eq!(scene.motion::<f64>().unwrap().g(), &0.1);
}

#[test]
fn a_scene_is_evaluated_from_what_was_typed_not_from_its_f64() {
    let wide = |n: f64, d: f64| Wide::<40>::from_f64(n) / Wide::from_f64(d);
    let motion = whole().motion::<Wide<40>>().unwrap();
    for (found, exact) in [
        (motion.d(), wide(13.0, 50.0)),
        (motion.restitution(Side::Bottom), wide(3.0, 5.0)),
        (motion.g(), wide(12201.0, 100_000.0)),
    ] {
        assert!((found.clone() - exact).to_f64().abs() < 1e-39);
    }
}

#[test]
fn the_membrane_is_read_and_one_that_cannot_be_is_named_with_its_place() {
    let membrane = whole().membrane::<f64>().unwrap();
    assert!((membrane.deflection(&8.0) / 0.0216 - 1.0).abs() < 0.01);
    let error = |sets: &[&str]| set(&whole(), sets).membrane::<f64>().unwrap_err().to_string();
    assert_says(
        &error(&["membrane.stiffness=-1"]),
        &["whole.toml", "--set", "stiffness", "above 0"],
    );
    let narrow = set(&whole(), &["membrane.ball_radius=0.0063"]);
    for error in [
        narrow.membrane::<f64>().unwrap_err(),
        narrow.check(&[Want::Voltage]).unwrap_err(),
    ] {
        let words = ["whole.toml: line 22", "membrane_radius is 0.0063", "above ball_radius"];
        assert_says(&error.to_string(), &words);
    }
    narrow.check(&[Want::Sweep]).unwrap();
}

#[test]
fn what_no_want_requires_may_be_wrong_or_missing() {
    let broken = set(
        &whole(),
        &[
            "membrane.stiffness=-1",
            "sweep.over=moon",
            "start.phase=nan",
            "device.angular_frequency=0",
        ],
    );
    broken.check(&[Want::Orbits]).unwrap();
    broken.motion::<f64>().unwrap();
    let notes = broken.notes(&[Want::Orbits]).unwrap();
    for key in [
        "membrane.stiffness",
        "sweep.over",
        "start.phase",
        "device.angular_frequency",
    ] {
        assert!(notes.iter().any(|note| note.key == key), "{key}");
    }
    assert!(!notes.iter().any(|note| note.key.starts_with("motion.")));
    let problem = |key: &str| {
        notes
            .iter()
            .find(|note| note.key == key)
            .and_then(|note| note.problem.clone())
    };
    assert!(problem("device.angular_frequency").is_some_and(|problem| problem.contains("above 0")));
    assert_eq!(problem("device.incline"), None);
    assert_says(
        &broken.refuse_unneeded(&[Want::Orbits]).unwrap_err().to_string(),
        &["--strict", "angular_frequency"],
    );
    for (want, key) in [
        (Want::Voltage, "membrane.stiffness"),
        (Want::Branch, "sweep.over"),
        (Want::Impacts, "start.phase"),
    ] {
        assert_says(&broken.check(&[want]).unwrap_err().to_string(), &[key]);
    }
}

#[test]
fn a_list_of_no_words_and_fewer_most_impacts_than_impacts_are_refused() {
    let error = set(&whole(), &["words=[]"])
        .check(&[Want::Orbits])
        .unwrap_err()
        .to_string();
    assert_says(&error, &["words", "a list of words"]);
    let fewer = set(&whole(), &["sweep.error=0.01", "sweep.most_impacts=10"]);
    assert_says(
        &fewer.check(&[Want::Sweep]).unwrap_err().to_string(),
        &["most_impacts", "at least sweep.impacts, 500"],
    );
}

#[test]
fn each_want_requires_its_own_sections() {
    let lines: Vec<&str> = WHOLE.lines().collect();
    let without = |key: &str| {
        let left = lines.iter().filter(|line| !line.starts_with(&format!("{key} ")));
        left.copied().collect::<Vec<_>>().join("\n")
    };
    let required: [(&str, &[Want]); 9] = [
        (
            "r_b",
            &[
                Want::Orbits,
                Want::Branch,
                Want::Impacts,
                Want::Sweep,
                Want::Trajectory,
                Want::Map,
                Want::Basins,
                Want::Optimum,
            ],
        ),
        (
            "d",
            &[
                Want::Orbits,
                Want::Impacts,
                Want::Trajectory,
                Want::Basins,
                Want::Optimum,
            ],
        ),
        (
            "incline",
            &[
                Want::Orbits,
                Want::Branch,
                Want::Impacts,
                Want::Sweep,
                Want::Trajectory,
                Want::Map,
                Want::Basins,
                Want::Optimum,
            ],
        ),
        ("phase", &[Want::Impacts, Want::Sweep, Want::Trajectory, Want::Map]),
        ("points", &[Want::Branch, Want::Sweep, Want::Basins]),
        ("keep", &[Want::Sweep]),
        ("exponent", &[Want::Voltage, Want::Map, Want::Optimum]),
        ("angular_frequency", &[Want::Voltage, Want::Map, Want::Optimum]),
        ("words", &[]),
    ];
    for (key, by) in required {
        for want in Want::ALL {
            let message = refusal(&without(key), &[want]);
            if by.contains(&want) {
                assert_says(
                    &message,
                    &["x.toml: ", &format!("`{want}` requires "), &format!(".{key} (")],
                );
            } else {
                assert_eq!(message, "accepted", "{want} without {key}");
            }
        }
    }
    let message = refusal(BARE, &[Want::Sweep]);
    assert_says(
        &message,
        &["`sweep` requires sweep.over", "there is no section [sweep]"],
    );
}

#[test]
fn a_value_that_cannot_be_is_refused_with_place_and_range() {
    let cases: [(&str, &str, &str); 31] = [
        ("d", "0", "above 0"),
        ("d", "-0.26", "above 0"),
        ("d", "nan", "finite number"),
        ("d", "inf", "finite number"),
        ("d", "-inf", "finite number"),
        ("d", "true", "finite number"),
        ("d", "[0.26]", "finite number"),
        ("d", "\"wide\"", "finite number"),
        ("d", "2020-01-01", "finite number"),
        ("d", "{ x = 1 }", "finite number"),
        ("d", "1e400", "1e100"),
        ("d", "1e-400", "1e-100"),
        ("r_b", "-1e-30", "from 0 to 1"),
        ("r_b", "1.0000000000000000000000001", "from 0 to 1"),
        ("r_t", "-0.5", "from 0 to 1"),
        ("r_t", "\"pi/3\"", "from 0 to 1"),
        ("capsule_mass", "0.0", "above 0"),
        ("forcing_amplitude", "-5", "above 0"),
        ("gravity", "-9.8", "0 or more"),
        ("incline", "\"6/pi\"", "pi/6"),
        ("velocity", "-0.5", "0 or more"),
        ("digits", "0", "from 1 to"),
        ("digits", "12.0", "integer"),
        ("max_periods", "-1", "from 1 to"),
        ("max_periods", "99999999999999999999999", "from 1 to"),
        ("points", "0", "from 1 to"),
        ("keep", "501", "at most sweep.impacts, 500"),
        ("over", "\"rb\"", "did you mean r_b?"),
        ("from", "0.0", "above 0, as d is"),
        ("to", "0.10", "other than sweep.from"),
        ("words", "[\"BT\", \"TTB\"]", "\"BTT\""),
    ];
    for (key, value, allowed) in cases {
        let number = WHOLE
            .lines()
            .position(|line| line.starts_with(&format!("{key} ")))
            .unwrap();
        let text: String = WHOLE
            .lines()
            .enumerate()
            .map(|(n, line)| {
                if n == number {
                    format!("{key} = {value}\n")
                } else {
                    format!("{line}\n")
                }
            })
            .collect();
        let message = refusal(&text, &Want::ALL);
        assert_says(
            &message,
            &["x.toml: ", &format!("line {}, column ", number + 1), key, allowed],
        );
    }
    for (key, value) in [
        ("want", "[\"orbits\", \"moon\"]"),
        ("want", "3"),
        ("title", "3"),
        ("start", "\"never\""),
    ] {
        let scene = match key {
            "start" => set(&whole(), &["sweep.start=never"]),
            _ => set(&whole(), &[&format!("{key}={value}")]),
        };
        let asked: [Result<(), SceneError>; 3] = [
            scene.want().map(drop),
            scene.title().map(drop),
            scene.diagram().map(drop),
        ];
        assert_eq!(
            asked.iter().filter(|result| result.is_err()).count(),
            1,
            "{key} = {value}"
        );
    }
}

#[test]
fn what_physics_allows_is_accepted() {
    for sets in [
        &["device.incline=-pi/6"][..],
        &["motion.r_b=1", "motion.r_t=1.0"],
        &["device.gravity=0"],
        &["device.gravity=1000"],
        &["start.velocity=67", "start.phase=-20 pi"],
        &["sweep.from=0.5", "sweep.to=0.1"],
        &["sweep.over=r_b", "sweep.from=0.01", "sweep.to=1"],
        &["sweep.over=g", "sweep.from=-2", "sweep.to=2"],
        &["words=B"],
    ] {
        set(&whole(), sets).check(&Want::ALL).unwrap();
    }
}

#[test]
fn gravity_is_given_once() {
    let both = format!("{WHOLE}\n").replace("[motion]", "[motion]\ng = 0.1");
    assert_says(
        &refusal(&both, &[Want::Orbits]),
        &["line 14, column 5", "motion.g", "[device]"],
    );
    let neither = "motion = { d = 0.26, r_b = 0.6, r_t = 0.3 }";
    assert_says(
        &refusal(neither, &[Want::Orbits]),
        &["`orbits` requires motion.g", "[device]"],
    );
}

#[test]
fn a_sweep_replaces_its_parameter_and_nothing_else() {
    let quantity = |text: &str| Quantity::read(text).unwrap();
    let scene = whole();
    let base = scene.motion::<f64>().unwrap();
    for (over, value, g, d, r_b, r_t) in [
        (Over::D, "0.4", 0.12201, 0.4, 0.6, 0.3),
        (Over::RB, "0.9", 0.12201, 0.26, 0.9, 0.3),
        (Over::RT, "1", 0.12201, 0.26, 0.6, 1.0),
        (Over::Incline, "pi/2", 0.24402, 0.26, 0.6, 0.3),
        (Over::Incline, "0", 0.0, 0.26, 0.6, 0.3),
        (Over::G, "-1.5", -1.5, 0.26, 0.6, 0.3),
        (Over::ForcingAmplitude, "10", 0.061005, 0.26, 0.6, 0.3),
    ] {
        let motion = scene.swept::<f64>(over, &quantity(value)).unwrap();
        assert!((motion.g() - g).abs() < 1e-15, "{over}: {}", motion.g());
        let found = [
            motion.d(),
            motion.restitution(Side::Bottom),
            motion.restitution(Side::Top),
        ];
        assert_eq!(found, [&d, &r_b, &r_t], "{over}");
    }
    for (over, value) in [(Over::D, "0"), (Over::RB, "1.1"), (Over::ForcingAmplitude, "-5")] {
        let error = scene.swept::<f64>(over, &quantity(value)).unwrap_err();
        assert!(matches!(*error.problem, SceneProblem::Swept { .. }), "{error}");
    }
    assert_eq!(scene.swept::<f64>(Over::D, &quantity("0.26")).unwrap(), base);
    let bare = Scene::read(BARE, "x").unwrap();
    for over in [Over::Incline, Over::ForcingAmplitude] {
        let error = bare.swept::<f64>(over, &quantity("1")).unwrap_err();
        assert_says(&error.to_string(), &["there is no section [device]"]);
    }
    let scales = scene
        .swept_scales::<f64>(Over::ForcingAmplitude, &quantity("10"))
        .unwrap();
    assert!((scales.velocity - 2.0 * 8.032128514).abs() < 1e-8);
}

#[test]
fn an_unknown_name_is_answered_with_the_nearest() {
    for (text, words) in [
        (
            "titel = 1",
            &["line 1, column 1", "no key titel", "did you mean title?"][..],
        ),
        (
            "[motion]\n  dd = 1",
            &["line 2, column 3", "no key motion.dd", "did you mean d?", "r_b, r_t"],
        ),
        (
            "[motoin]",
            &["line 1, column 2", "no section [motoin]", "did you mean motion?"],
        ),
        ("[device]\nball_mass = 1", &["did you mean membrane.ball_mass?"]),
        ("[motion.d]\nx = 1", &["accepted"]),
        ("motion = 3", &["motion is 3", "a line [motion]"]),
        ("[[sweep]]\nover = \"d\"", &["sweep is", "a line [sweep]"]),
        ("\"é\" = 1", &["line 1, column 1", "no key é", "there are"]),
    ] {
        assert_says(&refusal(text, &[]), words);
    }
}

#[test]
fn malformed_toml_is_refused_with_its_place() {
    for (text, place) in [
        ("title = \"", "line 1"),
        ("[motion]\nd = 0.1\nd = 0.2", "line 3"),
        ("[motion]\nd = = 1", "line 2, column 5"),
        ("[motion\nd = 1", "line 1"),
        ("\n\n%", "line 3"),
    ] {
        assert_says(&refusal(text, &[]), &["x.toml: ", place]);
    }
    let deep = format!("words = {}", "[".repeat(100_000));
    assert_says(&refusal(&deep, &[]), &["x.toml: line 1"]);
    let deep = format!("words = {}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert_says(&refusal(&deep, &[]), &["x.toml: line 1"]);
}

proptest! {
    #[test]
    fn what_is_set_is_what_is_read(d in 1_u32..100_000, r in 1_u32..=1000, words in "[BT]{1,3}", turns in -50_i32..50) {
        let mut scene = whole();
        scene.set(&format!("motion.d={d}e-4")).unwrap();
        scene.set(&format!(" motion.r_b = {r}e-3 ")).unwrap();
        scene.set(&format!("start.phase={turns} pi/7")).unwrap();
        scene.set(&format!("words=[\"B{words}T\"]")).unwrap();
        let motion = scene.motion::<f64>().unwrap();
        prop_assert_eq!(*motion.d(), f64::from(d) / 1e4);
        prop_assert_eq!(*motion.restitution(Side::Bottom), f64::from(r) / 1e3);
        prop_assert_eq!(scene.start().unwrap().phase, Quantity::read(&format!("{turns} pi/7")).unwrap());
        prop_assert_eq!(scene.words().unwrap(), [format!("B{words}T").parse().unwrap()]);
        // In the file the same values mean the same.
        let text = WHOLE.replace("d = 0.26", &format!("d = {d}e-4")).replace("r_b = 0.6", &format!("r_b = {r}e-3"));
        prop_assert_eq!(Scene::read(&text, "x").unwrap().motion::<f64>().unwrap(), motion);
    }

    #[test]
    fn garbage_is_refused_or_read_but_never_panics(text in "(\\PC|\n){0,60}", at in 0_usize..700) {
        if let Ok(scene) = Scene::read(&text, "x") {
            let _ = scene.check(&Want::ALL);
        }
        let at = (0..=at.min(WHOLE.len())).rev().find(|&n| WHOLE.is_char_boundary(n)).unwrap();
        let (before, after) = WHOLE.split_at(at);
        for spoilt in [format!("{before}{text}{after}"), before.to_string(), after.to_string()] {
            if let Ok(scene) = Scene::read(&spoilt, "x") {
                let _ = scene.explain(&Want::ALL, |_| true);
                let _ = (scene.want(), scene.title(), scene.motion::<f64>());
            }
        }
        let mut scene = whole();
        let _ = scene.set(&text);
        for key in ["motion.d", "device.incline", "words", "want", "sweep.over", "sweep.points", "digits"] {
            let _ = scene.set(&format!("{key}={text}"));
        }
        let _ = (scene.check(&Want::ALL), scene.want());
    }

    #[test]
    fn a_number_is_refused_or_within_its_range(text in "-?[0-9]{0,3}(\\.[0-9]{0,3})?(e-?[0-9]{1,3})?( ?pi)?(/[0-9]{1,2})?") {
        let mut scene = whole();
        if scene.set(&format!("motion.r_t={text}")).is_ok() && let Ok(motion) = scene.motion::<f64>() {
            let r = *motion.restitution(Side::Top);
            prop_assert!((0.0..=1.0).contains(&r), "{} gave {}", text, r);
        }
    }
}

/// What a run prints that has nothing to say besides.
fn printed(ran: Ran) -> String {
    assert!(ran.stderr.is_empty(), "{}", ran.stderr);
    ran.succeeded()
}

fn assert_refused(ran: Ran, words: &[&str]) {
    let message = ran.refused(words);
    assert!(message.starts_with("error: "), "{message}");
}

#[test]
fn the_built_in_scenes_are_listed_and_printed_to_start_from() {
    let list = printed(run(&["scenes", "--format", "csv"]));
    let mut lines = list.lines();
    assert_eq!(lines.next(), Some("name,title,want"));
    let names: Vec<&str> = lines.filter_map(|line| line.split(',').next()).collect();
    assert_eq!(names, BUILT_IN.iter().map(|(name, _)| *name).collect::<Vec<_>>());
    assert_eq!((names.first(), names.last()), (Some(&"fig02"), Some(&"fig14")));
    for name in names {
        assert_eq!(printed(run(&["scenes", name])), find(name).unwrap());
    }
    assert_refused(
        run(&["scenes", "fig3"]),
        &["no built-in scene fig3", "did you mean fig03?", "fig02, fig03"],
    );
    assert_refused(run(&["scenes", "../paper"]), &["no built-in scene ../paper"]);
}

#[test]
fn every_built_in_scene_is_explained_and_has_nothing_to_spare() {
    for (name, _) in BUILT_IN {
        let text = printed(run(&["run", name, "--explain", "--strict"]));
        assert_says(&text, &["wanted", "modelled", "read", "device.capsule_mass = 0.1245"]);
        assert!(!text.contains("left alone"), "{text}");
    }
}

#[test]
fn the_explanation_follows_what_is_wanted() {
    let explain = |wants: &str| printed(run(&["run", "fig02", "--set", &format!("want=[{wants}]"), "--explain"]));
    let orbits = explain("'orbits'");
    assert_says(
        &orbits,
        &["no membrane", "left alone", "membrane.ball_mass (line", "g = 0.12201"],
    );
    let voltage = explain("'orbits', 'voltage'");
    assert_says(&voltage, &["membrane.ball_mass = 0.0035 (line", "8.032128514 m/s"]);
    assert!(!voltage.contains("membrane.ball_mass (line"));
    assert_refused(
        run(&["run", "fig02", "--set", "want=orbits", "--strict", "--explain"]),
        &["fig02: line", "device.angular_frequency", "--strict"],
    );
}

#[test]
fn every_want_has_its_file_and_a_scene_without_one_is_refused() {
    let scene = format!("want = [\"trajectory\", \"impacts\"]\n{BARE}start = {{ phase = 1, velocity = 0.5 }}\n");
    let scratch = scratch("wants");
    let out = scratch.join("out");
    let all = program(["run", "-", "--out", &scratch.path("out")]).input(scene).run();
    assert_eq!(all.status, Some(0));
    for file in ["trajectory.csv", "simulate.csv"] {
        assert!(out.join(file).exists(), "{file}");
    }
    assert_eq!(fs::read_dir(&out).unwrap().count(), 2);
    assert_refused(
        program(["run", "-"]).input(BARE).run(),
        &["stdin: missing: want", "orbits, branch"],
    );
    let none = program(["run", "-", "--set", "want=[]"]).input(BARE).run();
    assert_refused(none, &["want is []", "some of orbits, branch"]);
}

#[test]
fn a_scene_comes_from_a_file_stdin_or_by_its_name() {
    let scratch = scratch("files");
    let path = |name: &str| scratch.path(name);
    scratch.file("mine.toml", WHOLE);
    scratch.file("binary.toml", b"title = \"\xff\x00\"");
    scratch.file("empty.toml", "");
    assert_says(
        &printed(run(&["run", &path("mine.toml"), "--explain"])),
        &["mine (", "words = [\"BT\", \"BTT\"]"],
    );
    assert_says(
        &printed(program(["run", "-", "--explain"]).input(WHOLE).run()),
        &["mine (stdin)"],
    );
    assert_refused(run(&["run", &path("none.toml")]), &["none.toml", "no such file"]);
    assert_refused(run(&["run", "fig03.toml"]), &["fig03.toml", "no such file"]);
    assert_refused(
        run(&["run", "fg03"]),
        &["no built-in scene fg03", "did you mean fig03?"],
    );
    assert_refused(run(&["run", &path("")]), &["directory"]);
    assert_refused(run(&["run", &path("binary.toml")]), &["binary.toml", "UTF-8", "byte 9"]);
    assert_refused(run(&["run", &path("empty.toml")]), &["empty.toml: missing: want"]);
    assert_refused(run(&["run"]), &["SCENE"]);
}

#[test]
fn an_override_that_is_none_is_named_as_it_was_given() {
    for (argument, words) in [
        (
            "motion.dd=0.3",
            &["--set motion.dd=0.3", "no key motion.dd", "did you mean d?"][..],
        ),
        ("moton.d=0.3", &["--set moton.d=0.3", "did you mean motion?"]),
        ("motion.d", &["--set motion.d:", "key=value"]),
        ("motion=0.3", &["motion is a section"]),
        ("motion.d=", &["--set motion.d=:", "key=value"]),
        ("motion.d=[", &["--set motion.d=[:", "key=value"]),
        ("motion.d=0", &["--set motion.d=0: motion.d is 0, must be above 0"]),
        ("motion.d=NaN", &["motion.d is NaN"]),
        ("motion.g=0.1", &["--set motion.g=0.1", "g is given twice"]),
        ("", &["key=value"]),
    ] {
        assert_refused(run(&["run", "fig02", "--explain", "--set", argument]), words);
    }
    assert_refused(run(&["run", "fig02", "--set"]), &["--set"]);
    let twice = ["--set", "motion.d=0.3", "--set", "motion.d=0.4"];
    let text = printed(run(&[&["run", "fig02", "--explain"], &twice[..]].concat()));
    assert_says(&text, &["motion.d = 0.4 (--set motion.d=0.4)"]);
}
