//! The crates num-dual and roots at the work of the table, as their users would: Newton's method on the paper's
//! equations with Jacobians by dual numbers, Brent's method on brackets found by scanning.

#[path = "../timing.rs"]
mod timing;

use nalgebra::{SVector, Vector2};
use num_dual::{DualNum, jacobian};
use roots::{SimpleConvergency, find_root_brent};
use std::f64::consts::PI;
use std::hint::black_box;
use timing::{say, seconds};

const G: f64 = 0.12201;

fn closeness() -> SimpleConvergency<f64> {
    SimpleConvergency {
        eps: 1e-14,
        max_iter: 100,
    }
}

/// An impact: the phase of the forcing, the side (1 bottom, -1 top), the velocity just before.
type Impact = (f64, f64, f64);

/// The next impact: steps of 1/20 until the ball is beyond a wall, then Brent's method. Grazing impacts and chatter
/// within a step are missed.
fn next((phase, side, velocity): Impact, r: [f64; 2], d: f64) -> Option<Impact> {
    let u = -velocity * if side > 0.0 { r[0] } else { r[1] };
    let (sin, cos) = phase.sin_cos();
    let z = |s: f64| side * d / 2.0 + s * (u + G * s / 2.0 - sin / PI) - ((PI * s + phase).cos() - cos) / (PI * PI);
    let (mut before, step) = (1e-9, 0.05);
    for _ in 0..1000 {
        let after = before + step;
        let end = z(after);
        if end.abs() > d / 2.0 {
            let wall = end.signum();
            let s = find_root_brent(before, after, |s| z(s) - wall * d / 2.0, &mut closeness()).ok()?;
            let there = (phase + PI * s).rem_euclid(2.0 * PI);
            return Some((there, wall, u + G * s + (there.sin() - sin) / PI));
        }
        before = after;
    }
    None
}

/// (10) and (12) of the 1-1 motion with its velocities from (14) and (9), for r_B = r_T = 0.5.
fn balance<D: DualNum<Primitive = f64> + Copy>(phase: D, t_1: D, d: f64) -> [D; 4] {
    let r = 0.5;
    let t_2 = -t_1 + 2.0;
    let ((s_0, c_0), (s_1, c_1)) = (phase.sin_cos(), (phase + t_1 * PI).sin_cos());
    let rise = t_1 * G + (s_1 - s_0) / PI;
    let v = (-rise * (1.0 + r) + 2.0 * G) / (1.0 - r * r);
    let w = rise - v * r;
    let down = t_1 * (t_1 * (G / 2.0) - v * r - s_0 / PI) - (c_1 - c_0) / (PI * PI) + d;
    let up = t_2 * (t_2 * (G / 2.0) - w * r - s_1 / PI) - (c_0 - c_1) / (PI * PI) - d;
    [down, up, v, w]
}

/// (phase, T_1) by Newton's method.
fn orbit(guess: [f64; 2], d: f64) -> Option<[f64; 2]> {
    let mut point = Vector2::from(guess);
    for _ in 0..20 {
        let residual = |x: SVector<_, 2>| {
            let [down, up, ..] = balance(x[0], x[1], d);
            SVector::from([down, up])
        };
        let (value, slopes) = jacobian(residual, &point);
        let step = slopes.try_inverse()? * value;
        point -= step;
        if step.norm() < 1e-9 {
            return Some(point.into());
        }
    }
    None
}

/// Tr(DP) + 1 + Det(DP), 0 where the period doubles: (18) with (20) and (21).
fn above_doubling([phase, t_1]: [f64; 2], d: f64) -> f64 {
    let [.., v, w] = balance(phase, t_1, d);
    let (a, b) = (G + phase.cos(), G + (phase + PI * t_1).cos());
    let one = |start: f64, end: f64, before: f64, after: f64, t: f64| {
        let [by_t, by_v] = [(start * t - 0.5 * before) / after, 0.5 * t / after];
        [[by_t, by_v], [end * by_t - start, end * by_v - 0.5]]
    };
    let (first, second) = (one(a, b, v, w, t_1), one(b, a, w, v, 2.0 - t_1));
    let trace: f64 = (0..2)
        .flat_map(|i| (0..2).map(move |j| (i, j)))
        .map(|(i, j)| second[i][j] * first[j][i])
        .sum();
    trace + 1.0 + 0.0625
}

fn main() {
    let text = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>();
    for (task, r, d) in [("impact-focus", [0.5, 0.5], 0.4), ("impact-three", [0.6, 0.3], 0.26)] {
        let start = (6.18, 1.0, 0.5293);
        let run = || (0..100).try_fold(black_box(start), |impact, _| next(impact, r, d));
        let answers = run()
            .map(|(phase, _, velocity)| text(&[phase, velocity]))
            .unwrap_or_default();
        say(task, "roots (Rust), scan", seconds(run) / 100.0, &answers);
    }
    let guess = [0.95 * 0.4893951147, 1.05 * 1.1165006593];
    let whole = || {
        let [phase, t_1] = orbit(black_box(guess), 0.4)?;
        let [.., v, w] = balance(phase, t_1, 0.4);
        Some([t_1, v, w])
    };
    say(
        "orbit",
        "num-dual (Rust)",
        seconds(whole),
        &whole().map(|found| text(&found)).unwrap_or_default(),
    );
    let doubling = || {
        let near = orbit([0.14811268, 1.31700614], 0.26)?;
        let above = |d: f64| orbit(near, d).map_or(f64::NAN, |found| above_doubling(found, d));
        find_root_brent(
            black_box(0.245),
            0.26,
            above,
            &mut SimpleConvergency {
                eps: 1e-12,
                max_iter: 100,
            },
        )
        .ok()
    };
    let found = doubling().map(|d| text(&[d])).unwrap_or_default();
    say("doubling", "roots + num-dual (Rust)", seconds(doubling), &found);
}
