//! `optimise`: the best device of a box, against certified orbits on a grid and local searches, and as a script sees it.

use crate::common::program::{Program, program};
use vibro_audit::number::Sequence;
use vibro_audit::orbit::{Active, Optimum, OptimumLimits, OptimumPart, Word, find, optimum};
use vibro_audit::scene::{Scene, built_in};

/// The device of Fig. 3 with a box and overrides.
fn scene(sets: &[&str]) -> Scene {
    let mut scenes = built_in().unwrap().into_iter();
    let mut scene = scenes.find(|scene| scene.name() == "fig03").unwrap();
    for set in sets {
        scene.set(set).unwrap();
    }
    scene
}

fn best(scene: &Scene, gap: f64) -> Optimum {
    let limits = OptimumLimits {
        gap,
        most_boxes: 500_000,
        part: OptimumPart::WHOLE,
    };
    let mut last = f64::INFINITY;
    let found = optimum(&scene.choice().unwrap().choice, limits, |progress| {
        // no device that was dropped comes back
        assert!(progress.most <= last * (1.0 + 1e-12), "{progress:?}");
        last = progress.most;
    });
    assert!(found.is_complete, "{found:?}");
    found
}

/// Volts per forcing period of the best certified orbit of fig03 with these overrides that is stable and admissible.
fn rate(scene: &Scene, sets: &[String]) -> Option<f64> {
    let mut scene = scene.clone();
    for set in sets {
        scene.set(set).unwrap();
    }
    let found = find(&scene.setting().unwrap(), &Word::pair(), scene.max_periods().unwrap()).unwrap();
    let (membrane, unit) = (
        scene.membrane::<f64>().unwrap(),
        scene.scales::<f64>().unwrap().velocity,
    );
    let orbits = found.orbits.iter().filter(|orbit| orbit.stable && orbit.admissible);
    let rates = orbits.map(|orbit| {
        let voltages = orbit
            .velocities
            .iter()
            .map(|velocity| membrane.voltage(&(velocity * unit)));
        voltages.sum::<f64>() / f64::from(orbit.periods)
    });
    rates.reduce(f64::max)
}

const WHOLE: &str = "box={d = [0.1, 0.5], r_b = [0.3, 0.7], r_t = [0.3, 0.7]}";

#[test]
fn no_certified_orbit_of_a_grid_and_no_local_search_beats_the_optimum() {
    let scene = scene(&[WHOLE]);
    let found = best(&scene, 1e-3);
    let device = found.device.as_ref().unwrap();
    let at = |[d, r_b, r_t]: [f64; 3]| {
        let sets = [("d", d), ("r_b", r_b), ("r_t", r_t)].map(|(key, value)| format!("motion.{key}={value}"));
        rate(&scene, &sets)
    };
    let low = [0.1, 0.3, 0.3];
    let mut highest = 0.0_f64;
    let mut seen = 0;
    for index in 0..9 * 7 * 7 {
        let steps = [index % 9, index / 9 % 7, index / 63];
        let parts = [
            f64::from(steps[0]) / 8.0,
            f64::from(steps[1]) / 6.0,
            f64::from(steps[2]) / 6.0,
        ];
        if let Some(rate) = at(std::array::from_fn(|i| (low[i] + 0.4 * parts[i]).min(low[i] + 0.4))) {
            highest = highest.max(rate);
            seen += 1;
        }
    }
    // random steps that get shorter, from 200 random devices
    let mut sequence = Sequence::new(4);
    for _ in 0..200 {
        let mut here: [f64; 3] = low.map(|low| sequence.between(low, low + 0.4));
        let mut there = at(here).unwrap_or(0.0);
        for step in 0..30 {
            let reach = 0.2 * 0.85_f64.powi(step);
            let next = std::array::from_fn(|i| (here[i] + sequence.between(-reach, reach)).clamp(low[i], low[i] + 0.4));
            if let Some(rate) = at(next).filter(|rate| *rate > there) {
                (here, there) = (next, rate);
            }
        }
        highest = highest.max(there);
    }
    assert!(seen > 100, "{seen}");
    assert!(highest <= found.most, "{highest} {}", found.most);
    assert!(
        highest <= device.rate.high() * (1.0 + 1e-12) && highest > 0.99 * found.most,
        "{highest}"
    );
    // the device found has the motion that `orbits` finds there
    let alone = at(std::array::from_fn(|i| {
        [0, 2, 3].map(|place| device.parameters[place].midpoint())[i]
    }));
    assert!((alone.unwrap() - device.rate.midpoint()).abs() < 1e-6);
}

#[test]
fn an_optimum_lies_at_a_corner_at_a_bifurcation_or_nowhere() {
    let corner = best(&scene(&[WHOLE]), 1e-4);
    assert_eq!(corner.attained, Some(true));
    assert_eq!(corner.active, [Active::High(0), Active::High(2), Active::Low(3)]);
    let wider = best(
        &scene(&["box={d = [0.1, 0.6], r_b = [0.2, 0.8], r_t = [0.2, 0.8]}"]),
        1e-4,
    );
    assert_eq!(
        (wider.attained, &wider.active[..]),
        (Some(true), &[Active::High(0), Active::High(2)][..])
    );
    // r_T is in the middle of its range: the voltage has no slope there
    assert!(wider.sensitivities.unwrap()[3].abs() < 1.0 && wider.most > corner.most);

    let doubling = best(
        &scene(&["box={d = [0.1, 0.6], r_b = [0.2, 1], r_t = [0.2, 0.8]}"]),
        1e-4,
    );
    assert_eq!(doubling.attained, Some(false));
    assert!(
        doubling.active.contains(&Active::PeriodDoubling),
        "{:?}",
        doubling.active
    );
    let orbit = &doubling.device.as_ref().unwrap().orbit;
    assert!((orbit.trace.midpoint() + 1.0 + orbit.determinant.midpoint()).abs() < 1e-5);
    // with a margin there is a best one
    let held = best(
        &scene(&["box={d = [0.1, 0.6], r_b = [0.2, 1], r_t = [0.2, 0.8], margin = 0.1}"]),
        1e-4,
    );
    assert_eq!(held.attained, Some(true));
    assert!(held.most < doubling.device.as_ref().unwrap().rate.low());

    let symmetric = ["motion.r_b=0.5", "motion.r_t=0.5"];
    let grazing = best(&scene(&[&symmetric[..], &["box={d = [0.1, 0.25]}"]].concat()), 1e-4);
    assert_eq!(
        (grazing.attained, &grazing.active[..]),
        (Some(false), &[Active::Grazing][..])
    );
    assert!(grazing.place.unwrap()[0].width() < 1e-6);

    let none = best(&scene(&["box={d = [0.21, 0.23]}"]), 1e-4);
    assert!(none.device.is_none() && none.place.is_none() && none.most < 0.0);
    // where every restitution is 1 nothing attracts
    let elastic = best(&scene(&["box={d = [0.1, 0.5]}", "motion.r_b=1", "motion.r_t=1"]), 1e-4);
    assert!(elastic.device.is_none() && elastic.place.is_none());
}

#[test]
fn a_device_that_is_its_own_mirror_image_and_held_restitutions_are_no_exception() {
    let sets = [
        "device.incline=0",
        "motion.r_b=0.5",
        "motion.r_t=0.5",
        "box={d = [0.1, 0.9]}",
    ];
    let scene = scene(&sets);
    let found = best(&scene, 1e-6);
    let device = found.device.as_ref().unwrap();
    assert!((device.parameters[0].midpoint() - 0.9).abs() < 1e-9 && found.attained == Some(true));
    assert!((device.orbit.times[0].midpoint() - 1.0).abs() < 1e-12);
    for d in ["0.9", "0.85", "0.4"] {
        let rate = rate(&scene, &[format!("motion.d={d}")]).unwrap();
        assert!(rate <= found.most && (d != "0.9" || rate >= device.rate.low() * (1.0 - 1e-12)));
    }
}

#[test]
fn a_forcing_amplitude_changes_the_unit_of_length_and_the_capsule_keeps_its_own() {
    // at 5 N, d = 0.4
    let length = 0.4 * 5.0 / (0.1245 * 25.0);
    let held = format!("device.capsule_length={length}");
    let scene = scene(&[
        &held,
        "box={forcing_amplitude = [4, 6], r_b = [0.5, 0.7], r_t = [0.3, 0.5]}",
    ]);
    let found = best(&scene, 1e-4);
    let device = found.device.as_ref().unwrap();
    for amplitude in [4.0, 4.5, 5.0, 5.5, 6.0] {
        for [r_b, r_t] in [[0.7, 0.3], [0.5, 0.5], [0.6, 0.35]] {
            let sets = [
                format!("device.forcing_amplitude={amplitude}"),
                format!("motion.d={}", 0.4 * 5.0 / amplitude),
                format!("motion.r_b={r_b}"),
                format!("motion.r_t={r_t}"),
            ];
            assert!(rate(&scene, &sets).is_none_or(|rate| rate <= found.most));
        }
    }
    let [amplitude, _, r_b, r_t] = device.parameters.map(|value| value.midpoint());
    let sets = [
        format!("device.forcing_amplitude={amplitude}"),
        format!("motion.d={}", 2.0 / amplitude),
        format!("motion.r_b={r_b}"),
        format!("motion.r_t={r_t}"),
    ];
    let alone = rate(&scene, &sets).unwrap();
    assert!(
        (alone / device.rate.midpoint() - 1.0).abs() < 1e-9,
        "{alone} {}",
        device.rate
    );
}

/// The search in a box of the device of Fig. 3, on two threads.
fn optimised(sets: &[&str], flags: &[&str]) -> Program {
    let mut arguments = vec!["optimise", "fig03", "--format", "csv"];
    arguments.extend(sets.iter().flat_map(|set| ["--set", set]));
    program([&arguments, flags].concat()).threads(2)
}

#[test]
fn the_columns_are_those_that_scripts_rely_on_whatever_the_threads() {
    let text = optimised(&[WHOLE], &["--gap", "1e-3"]).run().stdout;
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(
        rows[0].join(","),
        "quantity,low,high,value,attained,active,sensitivity,gap,boxes,complete,error_bound"
    );
    let names: Vec<&str> = rows[1..].iter().map(|row| row[0]).collect();
    assert_eq!(names, ["voltage_rate", "d", "incline", "r_b", "r_t"]);
    assert_eq!((rows[1][4], rows[1][5], rows[1][9]), ("true", "d;r_b;r_t", "true"));
    let actives: Vec<&str> = rows[2..].iter().map(|row| row[5]).collect();
    assert_eq!(actives, ["high", "held", "high", "low"]);
    for row in &rows[1..] {
        let [low, high, value] = [1, 2, 3].map(|column| row[column].parse::<f64>().unwrap());
        assert!(low <= value && value <= high, "{row:?}");
    }
    let one = optimised(&[WHOLE], &["--gap", "1e-3"]).threads(1).run();
    assert_eq!(text, one.stdout);
}

#[test]
fn a_box_without_a_stable_motion_is_said_and_is_no_error() {
    let ran = optimised(&["box={d = [0.21, 0.23]}"], &["--require-complete"]).run();
    assert_eq!(ran.status, Some(0));
    assert_eq!(ran.stdout.lines().count(), 1, "{}", ran.stdout);
    assert!(ran.stderr.contains("no device of the box"), "{}", ran.stderr);
    // a gap out of reach is said, and fails where completeness is required
    let ran = optimised(&[WHOLE], &["--gap", "1e-15", "--require-complete"]).run();
    assert_eq!(ran.status, Some(1));
    assert!(ran.stderr.contains("was not reached"));
}

#[test]
fn what_cannot_be_a_box_is_refused() {
    for (set, words) in [
        ("box={dd = [0.1, 0.5]}", &["box.dd", "did you mean d?", "r_b, r_t"][..]),
        ("box={stiffness = [1, 2]}", &["box.stiffness", "membrane.stiffness"]),
        (
            "box={d = [0.5, 0.1]}",
            &["box.d is [0.5, 0.1]", "from the lower number"],
        ),
        ("box={d = [nan, 0.5]}", &["box.d", "a finite number"]),
        ("box={d = [0.1, inf]}", &["box.d", "a finite number"]),
        ("box={d = [0, 0.5]}", &["box.d is 0", "above 0, as d is"]),
        ("box={r_b = [0.3, 1.2]}", &["box.r_b is 1.2", "from 0 to 1"]),
        ("box={r_t = [0, 1]}", &["box.r_t is 0", "above 0 and at most 1"]),
        ("box={d = 0.3}", &["box.d is 0.3", "a list of two numbers"]),
        ("box={d = [0.1, 0.2, 0.3]}", &["box.d", "a list of two numbers"]),
        ("box={d = [0.1, 0.2], margin = -1}", &["box.margin is -1", "0 or more"]),
        ("box={g = [0, 1], incline = [0, 1]}", &["box.g", "box.incline"]),
        (
            "box={d = [0.1, 0.2], forcing_amplitude = [4, 6]}",
            &["requires device.capsule_length"],
        ),
        ("box={forcing_amplitude = [4, 6]}", &["requires device.capsule_length"]),
        ("box={}", &["`optimum` requires box.d"]),
        ("box=1", &["box is a section"]),
    ] {
        optimised(&[set], &[]).run().refused(words);
    }
    let both = [
        "device.capsule_length=0.6",
        "box={d = [0.1, 0.2], forcing_amplitude = [4, 6]}",
    ];
    let ran = optimised(&both, &[]).run();
    assert_eq!(ran.status, Some(2));
    assert!(ran.stderr.contains("keeps its length"));
    for gap in ["0", "1", "-1e-3", "NaN"] {
        let ran = optimised(&[WHOLE], &["--gap", gap]).run();
        assert_eq!(ran.status, Some(2), "{gap}");
    }
    let bare = "motion = { g = 0.1, d = 0.3, r_b = 0.5, r_t = 0.5 }\nbox.d = [0.1, 0.5]\n";
    let ran = program(["optimise", "-"]).input(bare).threads(1).run();
    assert_eq!(ran.status, Some(2));
    assert!(ran.stderr.contains("requires membrane.ball_mass"));
}

#[test]
fn the_worked_examples_are_as_they_are_printed() {
    for (directory, rows) in [("golden/optimum", 16), ("golden/restitution", 27)] {
        let ran = program(["check", directory, "--format", "csv"]).threads(2).run();
        assert_eq!(ran.status, Some(0), "{}\n{}", ran.stdout, ran.stderr);
        assert!(ran.stdout.lines().count() > rows, "{}", ran.stdout);
    }
}

#[test]
fn a_box_of_one_device_has_that_or_none() {
    for d in ["0.1", "0.15", "0.3"] {
        let fixed = format!("box={{d = [{d}, {d}], r_b = [0.5, 0.5], r_t = [0.5, 0.5]}}");
        let found = best(&scene(&[&fixed]), 1e-6);
        let sets = [format!("motion={{d = {d}, r_b = 0.5, r_t = 0.5}}")];
        let alone = rate(&scene(&[]), &sets);
        assert_eq!(found.device.is_some(), alone.is_some(), "{d}: {found:?} {alone:?}");
    }
}
