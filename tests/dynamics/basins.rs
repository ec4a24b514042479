//! `basins` as a script sees it: each start is told where a single simulation of it goes.

use super::sweep::Sheet;
use crate::common::program::{program, run};
use std::f64::consts::TAU;
use vibro_audit::impact::{Event, Kind, Simulation, Start};
use vibro_audit::model::{Motion, Side};
use vibro_audit::number::Sequence;
use vibro_audit::orbit::Word;

const STARTS: &str =
    "basins={impacts = 3000, phase = {from = 0, to = 6, points = 7}, velocity = {from = 0, to = 1.5, points = 4}}";

/// The starts, and what they come to.
struct Basins {
    starts: Sheet,
    attractors: Sheet,
}

impl Basins {
    fn of(text: &str) -> Self {
        let (starts, attractors) = text.split_once("\n\n").expect("two tables");
        Self {
            starts: Sheet::of(starts),
            attractors: Sheet::of(attractors),
        }
    }

    fn asked(arguments: &[&str], stdin: &str) -> Self {
        let asked = program([&["basins"], arguments, &["--format", "csv"]].concat());
        Self::of(&asked.input(stdin).run().succeeded())
    }

    /// A column of the attractor that a start comes to.
    fn of_start(&self, start: usize, column: &str) -> Option<&str> {
        let number: usize = self.starts.texts("attractor")[start].parse().ok()?;
        Some(self.attractors.texts(column)[number - 1])
    }
}

fn joined(text: &str) -> Vec<f64> {
    let parts = text.split(';').filter(|part| !part.is_empty());
    parts.map(|part| part.parse().unwrap()).collect()
}

/// So many events of a motion from this number on.
fn events(motion: &Motion<f64>, phase: f64, velocity: f64, first: usize, count: usize) -> Vec<Event<f64>> {
    let side = Side::Bottom;
    let simulation = Simulation::new(motion, &Start::impact(side, phase, velocity));
    simulation.skip(first).take(count).collect()
}

/// Whether an event is one of the impacts of a row, to 1e-5.
fn is_among(event: &Event<f64>, phases: &[f64], velocities: &[f64]) -> bool {
    phases.iter().zip(velocities).any(|(phase, velocity)| {
        let apart = (event.phase - phase).abs();
        apart.min(TAU - apart) < 1e-5 && (event.velocity - velocity).abs() < 1e-5
    })
}

#[test]
fn at_random_devices_each_start_goes_where_its_simulation_does() {
    let mut sequence = Sequence::new(18);
    let (mut cycles, mut rests, mut chaos, mut several, mut short) = (0, 0, 0, 0, 0);
    for device in 0..20 {
        let g = sequence.between(-0.5, 0.5);
        let d = sequence.between(0.05, 0.5);
        let [r_b, r_t] = [(); 2].map(|()| sequence.between(0.25, 0.9));
        let scene = format!("motion = {{ g = {g}, d = {d}, r_b = {r_b}, r_t = {r_t} }}\n");
        let found = Basins::asked(&["-", "--set", STARTS], &scene);
        let motion = Motion::new(g, d, r_b, r_t).unwrap();
        let [phases, velocities] = ["phase", "velocity"].map(|column| found.starts.numbers(column));
        assert_eq!(phases.len(), 28);
        several += usize::from(found.attractors.rows.len() > 1);
        for start in 0..28 {
            let told = |column| found.of_start(start, column).expect("decided");
            let events = |first, count| events(&motion, phases[start], velocities[start], first, count);
            let at = || {
                format!(
                    "device {device}, start {start}, g {g} d {d} r {r_b} {r_t}: {}",
                    told("word")
                )
            };
            if told("word").is_empty() {
                chaos += 1;
                // it has not repeated by then; later it may
                let last = events(2400, 601);
                let mut before = last.iter().take(600);
                assert!(
                    before.all(|event| (event.velocity - last[600].velocity).abs() > 1e-9),
                    "{}",
                    at()
                );
                continue;
            }
            let late = events(4000, 2000);
            let has_rest = late.is_empty() || late.iter().any(|event| event.kind == Kind::Rest);
            assert_eq!(has_rest, told("word").contains('*'), "{}", at());
            if has_rest {
                rests += 1;
                continue;
            }
            cycles += 1;
            let is_short = told("word").len() <= Word::LONGEST;
            short += usize::from(is_short);
            assert_eq!(is_short, !told("error_bound").is_empty(), "{}", at());
            let impacts = [joined(told("phases")), joined(told("velocities"))];
            assert!(
                late.iter().all(|event| is_among(event, &impacts[0], &impacts[1])),
                "{}",
                at()
            );
            let periods: i64 = told("periods").parse().unwrap();
            assert_eq!(late[told("word").len()].turns - late[0].turns, periods, "{}", at());
        }
        let fractions: f64 = found.attractors.numbers("fraction").iter().sum();
        let counted: f64 = found.attractors.numbers("starts").iter().sum();
        assert!((fractions - 1.0).abs() < 1e-12 && counted == 28.0);
    }
    assert!(cycles > 200 && short > 150 && rests > 100 && chaos > 100 && several > 2);
}

#[test]
fn a_cycle_is_the_proved_orbit_and_gives_its_voltage() {
    let voltage = "want=[\"basins\", \"voltage\"]";
    let found = Basins::asked(
        &["fig03", "--set", STARTS, "--set", "motion.d=0.4", "--set", voltage],
        "",
    );
    assert_eq!(found.starts.columns.join(","), "phase,velocity,attractor");
    let orbits = run(&["orbits", "fig03", "--set", "motion.d=0.4", "--format", "csv"]);
    let orbits = Sheet::of(&orbits.succeeded());
    let stable = orbits
        .texts("stable")
        .iter()
        .position(|stable| *stable == "true")
        .unwrap();
    assert_eq!(found.attractors.texts("word")[0], "BT");
    for column in ["phases", "velocities"] {
        let [told, exact] = [found.attractors.texts(column)[0], orbits.texts(column)[stable]].map(joined);
        assert!(
            told.iter().zip(&exact).all(|(one, other)| (one - other).abs() < 1e-14),
            "{column}"
        );
    }
    let swept = Sheet::summary("fig03", &["sweep.points=1", "sweep.from=0.4", "sweep.impacts=3000"]);
    let [rate, exact] = [
        found.attractors.numbers("voltage_rate")[0],
        swept.numbers("voltage_rate")[0],
    ];
    assert!((rate - exact).abs() < 1e-9 * exact, "{rate} {exact}");
}

#[test]
fn the_attractors_alone_are_the_second_table() {
    let arguments = [
        "basins",
        "fig03",
        "--set",
        STARTS,
        "--set",
        "motion.d=0.45",
        "--format",
        "csv",
    ];
    let both = run(&arguments).succeeded();
    let alone = run(&[&arguments[..], &["--attractors"]].concat()).succeeded();
    assert_eq!(both.split_once("\n\n").unwrap().1, alone);
    let texts = [1, 2, 5].map(|threads| program(arguments).threads(threads).run().stdout);
    assert!(texts.iter().all(|text| *text == both));
}

#[test]
fn what_is_no_grid_of_starts_is_refused() {
    for (set, words) in [
        (
            "basins.phase.points=0",
            &["basins.phase.points is 0", "an integer from 1"][..],
        ),
        ("basins.phase.to=0", &["other than basins.phase.from"]),
        ("basins.velocity.from=-1", &["basins.velocity.from is -1", "0 or more"]),
        ("basins.velocity.to=NaN", &["basins.velocity.to"]),
        ("basins.impacts=0", &["basins.impacts is 0"]),
        (
            "basins.keep=4000",
            &["basins.keep is 4000", "at most basins.impacts, 3000"],
        ),
        ("basins.speed=1", &["basins.speed"]),
    ] {
        run(&["basins", "fig03", "--set", STARTS, "--set", set]).refused(words);
    }
    let text = "motion = { g = 0.1, d = 0.3, r_b = 0.5, r_t = 0.5 }\n";
    let without = program(["basins", "-"]).input(text).run();
    without.refused(&["`basins` requires basins.phase.from"]);
}

#[test]
fn the_attractors_of_some_devices_are_as_they_are_written_down() {
    let ran = run(&["check", "golden/basins", "--format", "csv"]);
    assert_eq!(ran.status, Some(0), "{}\n{}", ran.stdout, ran.stderr);
    assert!(ran.stdout.lines().count() > 18, "{}", ran.stdout);
}
