//! The command `simulate`, and the laws that whole motions obey.

use crate::common::program::{run, scratch};
use std::f64::consts::{PI, TAU};
use vibro_audit::impact::{Event, Extent, History, Kind, Simulation, Start, history, history_in_decimals};
use vibro_audit::model::{Motion, Side};
use vibro_audit::number::{Analytic, Rung, Sequence, Wide};
use vibro_audit::orbit::{Word, find};

fn printed(arguments: &[&str]) -> Vec<Vec<String>> {
    let text = run(arguments).succeeded();
    text.lines()
        .map(|line| line.split(',').map(str::to_owned).collect())
        .collect()
}

fn number(field: &str) -> f64 {
    field.parse().expect("a number")
}

const RESTING: [&str; 6] = ["simulate", "fig03", "--set", "motion.d=0.18", "--format", "csv"];

#[test]
fn the_columns_are_those_that_scripts_rely_on_and_row_1_is_the_start() {
    let rows = printed(&[&RESTING[..], &["--impacts", "3"]].concat());
    assert_eq!(rows[0].join(","), "event,time,phase,side,velocity,kind,digits,number");
    assert_eq!(rows.len(), 4);
    assert_eq!(rows[1][..6].join(","), "1,0.0,6.18,bottom,0.5293,impact");
    for (index, row) in rows.iter().skip(1).enumerate() {
        assert_eq!(row[0], (index + 1).to_string());
        assert!(number(&row[6]) >= 12.0, "{row:?}");
    }
}

#[test]
fn a_chatter_is_listed_to_one_millionth_then_rests_and_is_released_where_cos_is_minus_g() {
    let rows = printed(&[&RESTING[..], &["--until", "6.5"]].concat());
    let kinds: Vec<&str> = rows.iter().map(|row| row[5].as_str()).collect();
    let rest = kinds.iter().position(|kind| *kind == "rest").expect("a rest");
    assert_eq!(kinds[rest + 1], "release");
    assert!((10..=20).contains(&rest), "{rest}");
    assert!(rows[1..rest].iter().all(|row| number(&row[4]).abs() >= 1e-6));
    assert!(number(&rows[rest - 1][4]).abs() < 1e-5);
    let g = 0.1245 * 9.8 * (PI / 6.0).sin() / 5.0;
    let release = TAU - (-g).acos();
    assert!((number(&rows[rest + 1][2]) - release).abs() < 1e-14);
    assert_eq!(rows[rest + 2][3], "bottom");
    // FACTS.md, where it was found by programs of other people
    assert!((number(&rows[rest + 2][4]) - 0.604_802_329_470_283_5).abs() < 1e-15);
}

#[test]
fn last_shows_the_end_of_the_same_rows() {
    let all = printed(&[&RESTING[..], &["--impacts", "40"]].concat());
    let last = printed(&[&RESTING[..], &["--impacts", "40", "--last", "5"]].concat());
    assert_eq!(last[1..], all[all.len() - 5..]);
}

#[test]
fn until_and_impacts_end_where_the_first_of_them_is_reached() {
    let time = printed(&[&RESTING[..], &["--until", "5", "--impacts", "400"]].concat());
    assert!(time.iter().skip(1).all(|row| number(&row[1]) <= 5.0));
    let impacts = printed(&[&RESTING[..], &["--until", "500", "--impacts", "4"]].concat());
    assert_eq!(impacts.len(), 5);
}

#[test]
fn more_digits_are_those_of_the_shorter_row_and_more() {
    let f64_rows = printed(&[&RESTING[..], &["--impacts", "60"]].concat());
    let forty = printed(&[&RESTING[..], &["--impacts", "60", "--digits", "40"]].concat());
    assert_eq!(f64_rows.len(), forty.len());
    for (narrow, wide) in f64_rows.iter().zip(&forty).skip(1) {
        assert_eq!([&narrow[3], &narrow[5]], [&wide[3], &wide[5]]);
        assert_eq!(wide[6], "40");
        let allowed = 10_f64.powf(-number(&narrow[6]));
        let apart = |column: usize| (number(&narrow[column]) - number(&wide[column])).abs();
        assert!(apart(2) <= allowed, "{narrow:?} {wide:?}");
        for column in [1, 4] {
            assert!(
                apart(column) <= allowed * number(&wide[column]).abs(),
                "{narrow:?} {wide:?}"
            );
        }
    }
}

#[test]
fn what_cannot_be_simulated_is_refused_by_name() {
    for (arguments, words) in [
        (&["simulate", "fig03", "--until", "NaN"][..], "finite"),
        (&["simulate", "fig03", "--until", "-1"], "at least 0"),
        (&["simulate", "fig03", "--impacts", "0"], "1"),
        (&["simulate", "fig03", "--set", "start.velocity=-1"], "start.velocity"),
        (&["simulate", "fig03", "--set", "motion.r_b=1.5"], "motion.r_b"),
        (&["simulate", "fig11"], "motion.d"),
        (&["simulate", "fig03", "--digits", "1000"], "1000"),
        (&["simulate", "nothing"], "nothing"),
    ] {
        run(arguments).refused(&[words]);
    }
}

fn motion(g: f64, d: f64, r_b: f64, r_t: f64) -> Motion<f64> {
    Motion::new(g, d, r_b, r_t).expect("a motion")
}

#[test]
fn proved_events_come_with_bounds_that_hold_and_end_where_they_can_no_longer() {
    let rows = printed(&[&RESTING[..], &["--impacts", "40", "--proved"]].concat());
    let bounds = "time_error_bound,phase_error_bound,velocity_error_bound";
    assert_eq!(
        rows[0].join(","),
        format!("event,time,phase,side,velocity,kind,digits,number,{bounds}")
    );
    let plain = printed(&[&RESTING[..], &["--impacts", "40", "--digits", "50"]].concat());
    assert_eq!(rows.len(), plain.len());
    for (row, exact) in rows.iter().zip(&plain).skip(1) {
        assert_eq!((&row[3], &row[5]), (&exact[3], &exact[5]));
        for (value, bound) in [(1, 8), (2, 9), (4, 10)] {
            let apart = Wide::<60>::from_f64(number(&row[value])) - Wide::parse(&exact[value]).expect("a number");
            assert!(apart.to_f64().abs() <= number(&row[bound]), "{row:?} {exact:?}");
            assert!(number(&row[bound]) < 1e-11, "{row:?}");
        }
    }
}

#[test]
fn digits_of_proved_events_are_those_of_the_decimals_that_are_printed() {
    let scene =
        "motion = { g = 1, d = 0.026747, r_b = 0.5616, r_t = 1e-9 }\nstart = { phase = 3.3183, velocity = 0.01006 }\n";
    let scratch = scratch("digits");
    let file = scratch.file("scene.toml", scene);
    let asked = |digits: &str| {
        let own = ["--impacts", "6", "--proved", "--digits", digits, "--format", "csv"];
        printed(&[&["simulate", &file][..], &own].concat())
    };
    for (row, exact) in asked("25").iter().zip(&asked("60")).skip(2) {
        let [told, exact] = [row, exact].map(|row| Wide::<80>::parse(&row[4]).expect("a number"));
        let error = ((told - exact.clone()) / exact).to_f64().abs();
        assert!(-error.log10() >= number(&row[6]) - 0.01, "{row:?}: {error}");
    }
}

fn start(phase: f64, velocity: f64) -> Start<f64> {
    Start::impact(Side::Bottom, phase, velocity)
}

fn told(motion: &Motion<f64>, start: &Start<f64>, impacts: u64, digits: u32) -> History<f64> {
    let extent = Extent {
        impacts,
        until: f64::INFINITY,
        digits,
        proved: false,
    };
    history(motion, start, &extent, usize::MAX, Rung::Double).expect("a motion")
}

/// Errors grow by a digit in two impacts.
fn chaotic() -> (Motion<f64>, Start<f64>) {
    (motion(0.12201, 1.7, 0.8, 0.8), start(3.1, 2.0))
}

#[test]
fn chaos_is_held_by_wider_numbers_without_being_asked_and_told_as_statistics_beyond_them() {
    let (motion, start) = chaotic();
    let held = told(&motion, &start, 100, 6);
    assert!(held.rows.iter().all(|row| row.digits >= 6) && held.known.lost_at.is_none());
    assert!(held.known.number > Rung::Double, "f64 cannot hold it");
    let lost = told(&motion, &start, 1000, 6);
    let from = lost.known.lost_at.expect("no number holds it for ever");
    assert!(from > 250, "{from}");
    // the last digit goes shortly before the bound of the error does
    assert!(lost.rows.iter().all(|row| row.event < from || row.digits == 0));
    assert!(lost.rows.iter().all(|row| row.event > from - 20 || row.digits > 0));
    assert_eq!(lost.rows.iter().filter(|row| row.kind == Kind::Impact).count(), 1000);
    // a rest wipes all errors out; whether there is one beyond what holds is left to rounding
    let rest = lost.rows.iter().find(|row| row.kind == Kind::Rest);
    let lyapunov = lost.known.lyapunov;
    match rest {
        Some(row) => assert!(row.event > from && lyapunov == f64::NEG_INFINITY, "{row:?} {lyapunov}"),
        None => assert!(lyapunov > 0.2, "{lyapunov}"),
    }
    assert!(held.known.lyapunov > 0.2, "{}", held.known.lyapunov);
}

#[test]
fn where_chaos_can_no_longer_be_proved_the_rows_end() {
    let (motion, start) = chaotic();
    let extent = Extent {
        impacts: 100_000,
        until: f64::INFINITY,
        digits: 6,
        proved: true,
    };
    let held = history(&motion, &start, &extent, usize::MAX, Rung::Double).expect("a motion");
    let last = held.rows.back().expect("a row");
    assert_eq!(
        (last.kind, last.digits, last.bounds),
        (Kind::Undecided, 0, Some([f64::INFINITY; 3]))
    );
    assert!(held.rows.len() > 250, "{}", held.rows.len());
    assert!(
        held.rows
            .iter()
            .all(|row| row.digits > 0 || row.event > last.event - 20)
    );
}

#[test]
fn the_digits_claimed_hold_against_a_hundred_more() {
    let mut sequence = Sequence::new(4);
    for _ in 0..40 {
        let [g, d, r_b, r_t] = [(-0.3, 0.4), (0.05, 0.8), (0.2, 1.0), (0.2, 1.0)]
            .map(|(low, high): (f64, f64)| sequence.between(low, high));
        let (motion, start) = (
            motion(g, d, r_b, r_t),
            start(sequence.between(0.0, TAU), sequence.between(0.0, 2.0)),
        );
        let extent = Extent {
            impacts: 80,
            until: f64::INFINITY,
            digits: 100,
            proved: false,
        };
        let exact = history_in_decimals(&motion, &start, &extent, usize::MAX, Rung::DoubleDouble).expect("a motion");
        let rows = told(&motion, &start, 80, 3).rows;
        for (row, exact) in rows.iter().zip(&exact.rows) {
            if row.digits == 0 || exact.digits < 30 {
                break;
            }
            assert_eq!((row.kind, row.side), (exact.kind, exact.side), "{motion:?} {start:?}");
            let allowed = 10_f64.powi(-i32::try_from(row.digits).expect("few"));
            let apart = |told: f64, exact: &str| {
                let exact = Wide::<100>::parse(exact).expect("a number");
                (Wide::from_f64(told) - exact).to_f64().abs()
            };
            let circle = |apart: f64| apart.min((apart - TAU).abs());
            assert!(
                circle(apart(row.phase, exact.phase.as_str())) <= allowed,
                "{row:?} {exact:?}"
            );
            assert!(
                apart(row.velocity, exact.velocity.as_str()) <= allowed * row.velocity.abs(),
                "{row:?} {exact:?}"
            );
            assert!(
                apart(row.time, exact.time.as_str()) <= allowed * row.time,
                "{row:?} {exact:?}"
            );
        }
    }
}

#[test]
fn wide_numbers_find_the_contacts_that_f64_finds() {
    for d in [0.16, 0.22, 0.31] {
        let (motion, start) = (motion(0.12201, d, 0.3, 0.6), start(6.18, 0.5293));
        let extent = Extent {
            impacts: 80,
            until: f64::INFINITY,
            digits: 20,
            proved: false,
        };
        let wide = history_in_decimals(&motion, &start, &extent, usize::MAX, Rung::DoubleDouble).expect("a motion");
        let narrow = told(&motion, &start, 80, 6);
        assert_eq!(wide.rows.len(), narrow.rows.len(), "{d}");
        for (wide, narrow) in wide.rows.iter().zip(&narrow.rows) {
            assert_eq!((wide.kind, wide.side), (narrow.kind, narrow.side), "{d}: {narrow:?}");
        }
    }
}

#[test]
fn a_motion_without_an_impact_to_list_ends() {
    for (g, d, phase, velocity) in [(0.99999, 0.26, 1.0, 0.2), (0.0, 1e-10, 1.0, 0.2), (0.0, 5.0, PI, 1e-20)] {
        let rows = told(&motion(g, d, 0.6, 0.3), &start(phase, velocity), 50, 6);
        assert!(rows.known.has_ended, "{g} {d}");
    }
}

#[test]
fn where_it_attracts_a_certified_orbit_is_what_the_motion_comes_to() {
    let mut met = 0;
    for (g, d, r_b, r_t) in [
        (0.12201, 0.4, 0.5, 0.5),
        (0.12201, 0.33, 0.6, 0.3),
        (0.21132, 0.5, 0.6, 0.3),
        (1.1, 1.572303, 0.8, 0.8),
    ] {
        let motion = motion(g, d, r_b, r_t);
        let found = find(&motion, &Word::pair(), 1).expect("a search");
        for orbit in found.orbits.iter().filter(|orbit| orbit.stable && orbit.admissible) {
            met += 1;
            let near = start(orbit.phases[0] + 1e-6, orbit.velocities[0] * (1.0 + 1e-6));
            let last: Vec<Event<f64>> = Simulation::new(&motion, &near).skip(4000).take(2).collect();
            let bound = orbit.error_bound.expect("proved") + 1e-13;
            for event in last {
                let index = usize::from(event.side == Side::Top);
                assert!((event.velocity - orbit.velocities[index]).abs() < bound, "{motion:?}");
                assert!((event.phase - orbit.phases[index]).abs() < bound, "{motion:?}");
            }
        }
    }
    assert!(met >= 4, "{met}");
}

#[test]
fn differences_of_the_simulated_map_have_the_trace_and_determinant_of_the_orbit() {
    type Number = Wide<50>;
    let wide = |value: &f64| Number::from_f64(*value);
    for (g, d, r_b, r_t) in [
        (0.12201, 0.4, 0.5, 0.5),
        (0.12201, 0.26, 0.6, 0.3),
        (0.3, 0.7, 0.9, 0.8),
    ] {
        let motion = motion(g, d, r_b, r_t);
        for word in ["BT", "BTT"] {
            let word: Word = word.parse().expect("a word");
            let found = find(&motion, &word, 1).expect("a search");
            for orbit in found.orbits.iter().filter(|orbit| orbit.admissible) {
                let exact = motion.convert(wide).expect("a motion");
                let flown = |phase: Number, velocity: Number| {
                    let start = Start::impact(Side::Bottom, phase, velocity);
                    let end = Simulation::new(&exact, &start)
                        .nth(orbit.velocities.len())
                        .expect("an impact");
                    assert_eq!(end.side, Side::Bottom);
                    [
                        end.phase.clone() + Number::from_f64(TAU) * Number::from_f64(end.turns as f64),
                        end.velocity,
                    ]
                };
                let (phase, velocity) = (wide(&orbit.phases[0]), wide(&orbit.velocities[0]));
                let step = Number::from_f64(1e-9);
                let twice = step.clone() + step.clone();
                let slope = |plus: [Number; 2], minus: [Number; 2]| {
                    let [a, b] = plus;
                    let [c, d] = minus;
                    [((a - c) / twice.clone()).to_f64(), ((b - d) / twice.clone()).to_f64()]
                };
                let by_phase = slope(
                    flown(phase.clone() + step.clone(), velocity.clone()),
                    flown(phase.clone() - step.clone(), velocity.clone()),
                );
                let by_velocity = slope(
                    flown(phase.clone(), velocity.clone() + step.clone()),
                    flown(phase.clone(), velocity.clone() - step.clone()),
                );
                let trace = by_phase[0] + by_velocity[1];
                let determinant = by_phase[0] * by_velocity[1] - by_phase[1] * by_velocity[0];
                let size = 1.0 + orbit.trace.abs();
                assert!(
                    (trace - orbit.trace).abs() < 1e-8 * size,
                    "{word}: {trace} {}",
                    orbit.trace
                );
                assert!((determinant - orbit.determinant).abs() < 1e-8 * size * size, "{word}");
            }
        }
    }
}

#[test]
fn the_run_that_the_paper_calls_chaotic_rests_at_every_gap() {
    let g = 0.1245 * 9.8 * (PI / 6.0).sin() / 5.0;
    for index in 0..401 {
        let motion = motion(g, 0.1 + 0.001 * f64::from(index), 0.3, 0.6);
        let mut events = Simulation::new(&motion, &start(6.18, 0.5293)).take(500);
        assert!(events.any(|event| event.kind == Kind::Rest), "{index}");
    }
}
