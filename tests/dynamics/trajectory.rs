//! `trajectory` as its user meets it: columns, units, ends, and the laws of motion in the printed numbers.

use crate::common::program::{Ran, run};

fn trajectory(arguments: &[&str]) -> Ran {
    run(&[&["trajectory"], arguments].concat())
}

/// The header, and the rows with empty fields as NaN; the command succeeds.
fn rows(arguments: &[&str]) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = trajectory(&[arguments, &["--format", "csv"]].concat()).succeeded();
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let rows = reader.records().map(|record| {
        let record = record.unwrap();
        record.iter().map(|field| field.parse().unwrap_or(f64::NAN)).collect()
    });
    (header, rows.collect())
}

fn column(header: &[String], rows: &[Vec<f64>], name: &str) -> Vec<f64> {
    let index = header.iter().position(|column| column == name).unwrap();
    rows.iter().map(|row| row[index]).collect()
}

#[test]
fn the_columns_of_the_design_come_first_and_reach_from_end_to_end() {
    let (header, rows) = rows(&["fig13", "--samples", "11"]);
    assert_eq!(header[..6], ["time", "phase", "z", "zdot", "capsule", "ball"]);
    let times = column(&header, &rows, "time");
    assert_eq!(
        times,
        (0..11).map(f64::from).collect::<Vec<_>>(),
        "the paper's t_final is 10"
    );
    let (_, one) = self::rows(&["fig13", "--samples", "1"]);
    assert_eq!(one.len(), 1);
    // the start impact before it happens
    assert_eq!(one[0][..4], [0.0, 0.922_985, 0.125, 0.689_829]);
}

#[test]
fn in_si_every_column_is_its_unit_times_the_number() {
    let (header, rows) = rows(&["fig03", "--samples", "200"]);
    let of = |name| column(&header, &rows, name);
    // the paper's device: pi/omega = 0.2 s, A pi²/(M omega²) = 5/(0.1245 · 25) m, A pi/(M omega) = 1/(0.1245) m/s
    let (time, length, velocity) = (0.2, 5.0 / (0.1245 * 25.0), 1.0 / 0.1245);
    for (plain, si, unit) in [
        ("time", "time_s", time),
        ("z", "z_m", length),
        ("zdot", "zdot_m_s", velocity),
        ("capsule", "capsule_m", length),
        ("ball", "ball_m", length),
    ] {
        for (plain, si) in of(plain).into_iter().zip(of(si)) {
            assert!((plain * unit - si).abs() < 1e-14, "{plain} {si}");
        }
    }
    let without = ["fig12", "--samples", "3"];
    let (header, rows) = self::rows(&without);
    assert!(column(&header, &rows, "z_m").iter().all(|value| value.is_nan()));
    let told = trajectory(&without).stderr;
    assert!(
        told.contains("SI are empty") && told.contains("angular_frequency"),
        "{told}"
    );
}

#[test]
fn the_ball_stays_between_the_walls_and_is_where_its_columns_say() {
    for (scene, d) in [("fig03", 0.26), ("fig04", 0.18), ("fig06", 0.3), ("fig10", 0.37)] {
        let gap = format!("motion.d={d}");
        let (header, rows) = rows(&[scene, "--set", &gap, "--until", "40", "--samples", "4001"]);
        assert_eq!(rows.len(), 4001);
        let of = |name| column(&header, &rows, name);
        let (z, zdot, phases) = (of("z"), of("zdot"), of("phase"));
        let (capsule, ball) = (of("capsule"), of("ball"));
        for index in 0..rows.len() {
            assert!(z[index].abs() <= d / 2.0 + 1e-12, "{scene} row {index}: {}", z[index]);
            assert!((capsule[index] - z[index] - ball[index]).abs() < 1e-15);
            let middle = -phases[index].cos() / std::f64::consts::PI.powi(2);
            assert!((capsule[index] - middle).abs() < 1e-15);
        }
        // no jump: between two samples the ball moves by no more than its greatest speed allows
        let most = zdot.iter().fold(0.0, |most: f64, speed| most.max(speed.abs())) + 0.03;
        assert!(
            z.windows(2).all(|pair| (pair[1] - pair[0]).abs() < most * 0.01),
            "{scene}"
        );
    }
}

#[test]
fn without_a_wall_one_energy_is_kept_and_the_other_changes_by_the_power() {
    // ten time units of one flight, from phase 0 and elastic, so that the start does not count either
    let sets = ["motion.d=100", "motion.r_b=1", "start.phase=0", "start.velocity=5"];
    let mut arguments = vec!["fig12", "--samples", "2001"];
    arguments.extend(sets.iter().flat_map(|set| ["--set", set]));
    let (header, rows) = rows(&arguments);
    let of = |name| column(&header, &rows, name);
    let ball = of("ball_energy");
    assert!(ball.iter().all(|energy| (energy - ball[0]).abs() < 1e-12));
    // d/dt (Zdot²/2 - g Z) = f Zdot, by Simpson's rule over two steps of 0.005
    let (energy, zdot, phase) = (of("energy"), of("zdot"), of("phase"));
    let power = |index: usize| phase[index].cos() * zdot[index];
    for index in (1..2000).step_by(2).skip(1) {
        let work = 0.005 / 3.0 * (power(index - 1) + 4.0 * power(index) + power(index + 1));
        assert!((energy[index + 1] - energy[index - 1] - work).abs() < 1e-9, "{index}");
    }
}

#[test]
fn the_end_may_be_an_impact() {
    let (header, rows) = rows(&["fig12", "--impacts", "3", "--samples", "50"]);
    let last = |name| *column(&header, &rows, name).last().unwrap();
    // a whole cycle of 1-1 motion: bottom, top, bottom again after one period
    assert!((last("time") - 2.0).abs() < 1e-5 && (last("z") - 0.165).abs() < 1e-14);
    assert!(
        (last("zdot") - 0.729_028).abs() < 1e-5,
        "the velocity before the impact"
    );
}

#[test]
fn what_cannot_be_asked_is_refused() {
    for (arguments, words) in [
        (vec!["fig12", "--samples", "0"], "--samples"),
        (vec!["fig12", "--until=-1"], "--until"),
        (vec!["fig12", "--until", "NaN"], "above 0"),
        (vec!["fig12", "--until", "3", "--impacts", "3"], "--impacts"),
        (vec!["fig12", "--set", "start.velocity=-1"], "start.velocity"),
    ] {
        trajectory(&arguments).refused(&[words]);
    }
}
