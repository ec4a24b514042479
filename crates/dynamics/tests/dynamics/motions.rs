//! Motions of all kinds, and the paper's own equations (9) to (13) of their 1-1 orbits: nothing here is the
//! library's search, so that its answers are checked by something else.

#![allow(dead_code)] // each test uses a part

use dynamics::model::{Motion, Side};
use dynamics::orbit::RoundedOrbit;
use nalgebra::{Matrix4, Vector4};
use numbers::{Analytic, Dual, Field, Sequence, Wide, seeded};
use std::f64::consts::{PI, TAU};

pub type Digits = Wide<40>;

/// The impacts of a 1-1 orbit: what (9) to (12) are equations in.
#[derive(Clone, Debug)]
pub struct Pair<T> {
    /// At the bottom, at the top.
    pub velocities: [T; 2],
    /// Of the flight after each.
    pub times: [T; 2],
    /// Of the forcing cos(phase) at each.
    pub phases: [T; 2],
}

impl<T: Analytic> Pair<T> {
    /// As printed in a row.
    pub fn printed(row: &RoundedOrbit) -> Self {
        let both = |values: &[f64]| [T::from_f64(values[0]), T::from_f64(values[1])];
        let [velocities, times, phases] = [&row.velocities, &row.times, &row.phases].map(|values| both(values));
        Self {
            velocities,
            times,
            phases,
        }
    }

    /// With (13) put in: T_2 = 2 n - T_1, and the phase at the top pi T_1 after that at the bottom.
    pub fn closed([v, w, t_1, phase]: &[T; 4], periods: u32) -> Self {
        let t_2 = T::from_integer(2 * i64::from(periods)) - t_1.clone();
        Self {
            velocities: [v.clone(), w.clone()],
            times: [t_1.clone(), t_2],
            phases: [phase.clone(), phase.clone() + T::pi() * t_1.clone()],
        }
    }

    /// [(9), (10), (11), (12)], right side less left side.
    pub fn residuals(&self, motion: &Motion<T>) -> [T; 4] {
        let forced = |phase: &T| {
            let (sin, cos) = phase.sincos();
            (sin / T::pi(), -cos / (T::pi() * T::pi()))
        };
        let fly = |from: usize, side: Side, climb: T| {
            let to = 1 - from;
            let [start, end] = [from, to].map(|impact| forced(&self.phases[impact]));
            let (t, g) = (self.times[from].clone(), motion.g().clone());
            let launch = -(motion.restitution(side).clone() * self.velocities[from].clone());
            let arrival = launch.clone() + g.clone() * t.clone() + end.0 - start.0.clone();
            let fall = launch * t.clone() + g * t.clone() * t.clone() * T::from_ratio(1, 2);
            let moved = fall + end.1 - start.1 - start.0 * t;
            [arrival - self.velocities[to].clone(), moved - climb]
        };
        let [nine, ten] = fly(0, Side::Bottom, -motion.d().clone());
        let [eleven, twelve] = fly(1, Side::Top, motion.d().clone());
        [nine, ten, eleven, twelve]
    }
}

/// The orbit near a printed one in 40 digits, by Newton's method on (9) to (12) with derivatives from dual numbers.
pub fn improved(motion: &Motion<f64>, row: &RoundedOrbit) -> Pair<Digits> {
    let wide = motion.convert(|&x| Digits::from_f64(x)).expect("the same numbers");
    let lifted = motion
        .convert(|&x| Dual::from_re(Digits::from_f64(x)))
        .expect("the same numbers");
    let mut at = [row.velocities[0], row.velocities[1], row.times[0], row.phases[0]].map(Digits::from_f64);
    for _ in 0..8 {
        let columns: [[Dual<Digits>; 4]; 4] = std::array::from_fn(|column| {
            let point: [Dual<Digits>; 4] = std::array::from_fn(|i| {
                let value = at[i].clone();
                if i == column {
                    seeded(value)
                } else {
                    Dual::from_re(value)
                }
            });
            Pair::closed(&point, row.periods).residuals(&lifted)
        });
        let rows = std::array::from_fn(|i| std::array::from_fn(|column: usize| columns[column][i].eps.clone()));
        let step = solved(rows, columns[0].each_ref().map(|value| value.re.clone()));
        for (unknown, step) in at.iter_mut().zip(step) {
            *unknown -= step;
        }
    }
    let mut pair = Pair::closed(&at, row.periods);
    let left = pair.residuals(&wide).map(|residual| residual.to_f64().abs());
    assert!(
        left.iter().all(|residual| *residual < 1e-30),
        "{left:?} {motion:?} {row:?}"
    );
    let turn = Digits::from_integer(2) * Digits::pi();
    for (phase, printed) in pair.phases.iter_mut().zip(&row.phases) {
        let turns = ((phase.to_f64() - printed) / TAU).round() as i64;
        *phase -= Digits::from_integer(turns) * turn.clone();
    }
    pair
}

/// Gauss's elimination, the largest pivot of each column first.
fn solved(mut rows: [[Digits; 4]; 4], mut right: [Digits; 4]) -> [Digits; 4] {
    for column in 0..4 {
        let size = |row: &usize| rows[*row][column].to_f64().abs();
        let pivot = (column..4).max_by(|a, b| size(a).total_cmp(&size(b))).expect("a row");
        rows.swap(column, pivot);
        right.swap(column, pivot);
        for row in (0..4).filter(|row| *row != column) {
            let factor = rows[row][column].clone() / rows[column][column].clone();
            let above = rows[column].clone();
            for (entry, pivot) in rows[row].iter_mut().zip(above).skip(column) {
                *entry -= factor.clone() * pivot;
            }
            let part = factor * right[column].clone();
            right[row] -= part;
        }
    }
    std::array::from_fn(|i| right[i].clone() / rows[i][i].clone())
}

/// Motions over the whole range, with periods of 1 to 3: g from -2 to 2, 0 and tiny ones among them, d from 0.001
/// to 5, restitutions from 0.02 to 1, exactly 1 and equal pairs among them.
pub fn scenes(seed: u64) -> impl Iterator<Item = (Motion<f64>, u32)> {
    let mut sequence = Sequence::new(seed);
    std::iter::from_fn(move || {
        let mut one_of = |count: u64| sequence.draw() % count;
        let (gravity, gap, pair, bottom, top, periods) =
            (one_of(10), one_of(2), one_of(3), one_of(8), one_of(8), one_of(3));
        let g = match gravity {
            0 => 0.0,
            1 => {
                let tiny = 10_f64.powf(sequence.between(-12.0, -2.0));
                if sequence.draw().is_multiple_of(2) { tiny } else { -tiny }
            }
            2..=5 => sequence.between(-0.3, 0.3),
            _ => sequence.between(-2.0, 2.0),
        };
        // most motions have a d below 1
        let d = if gap == 0 {
            10_f64.powf(sequence.between(-3.0, 5_f64.log10()))
        } else {
            sequence.between(0.02, 0.9)
        };
        let mut r = |kind: u64| if kind == 0 { 1.0 } else { sequence.between(0.02, 1.0) };
        let r_b = r(bottom);
        let r_t = if pair == 0 { r_b } else { r(top) };
        let motion = Motion::new(g, d, r_b, r_t).expect("a motion");
        Some((motion, 1 + periods as u32))
    })
}

/// Motions made around an orbit: T_1, the phase and the restitutions are drawn, and (9) to (12), linear in v, w, g
/// and d, give the rest. With the orbit, as [v, w, T_1, phase at the bottom], and its periods.
pub fn planted(seed: u64) -> impl Iterator<Item = (Motion<f64>, u32, [f64; 4])> {
    let mut sequence = Sequence::new(seed);
    std::iter::from_fn(move || {
        loop {
            let periods = 1 + (sequence.draw() % 3) as u32;
            let total = 2.0 * f64::from(periods);
            let t_1 = sequence.between(0.02, total - 0.02);
            // halfway through the first flight: every fourth near a half turn, where the circle is cut
            let middle = if sequence.draw().is_multiple_of(4) {
                PI + sequence.between(-0.05, 0.05)
            } else {
                sequence.between(0.0, TAU)
            };
            let phase = middle - 0.5 * PI * t_1;
            let [r_b, r_t] = [sequence.between(0.05, 1.0), sequence.between(0.05, 1.0)];
            if let Some((g, d, [v, w])) = motion_of(r_b, r_t, t_1, phase, periods)
                && (1e-3..5.0).contains(&d)
                && g.abs() < 2.0
                && v > 1e-3
                && w < -1e-3
            {
                let motion = Motion::new(g, d, r_b, r_t).expect("a motion");
                return Some((motion, periods, [v, w, t_1, phase]));
            }
        }
    })
}

/// The g, d and [v, w] of the one motion that has an orbit with this T_1 and phase at the bottom.
pub fn motion_of(r_b: f64, r_t: f64, t_1: f64, phase: f64, periods: u32) -> Option<(f64, f64, [f64; 2])> {
    let t_2 = 2.0 * f64::from(periods) - t_1;
    let forced = |phase: f64| (phase.sin() / PI, -phase.cos() / (PI * PI));
    let [(f_1, f_2), (e_1, e_2)] = [forced(phase), forced(phase + PI * t_1)];
    // v, w, g, d
    let matrix = Matrix4::new(
        -r_b,
        -1.0,
        t_1,
        0.0,
        -r_b * t_1,
        0.0,
        0.5 * t_1 * t_1,
        1.0,
        -1.0,
        -r_t,
        t_2,
        0.0,
        0.0,
        -r_t * t_2,
        0.5 * t_2 * t_2,
        -1.0,
    );
    let right = -Vector4::new(e_1 - f_1, e_2 - f_2 - f_1 * t_1, f_1 - e_1, f_2 - e_2 - e_1 * t_2);
    let solution = matrix.lu().solve(&right)?;
    let [v, w, g, d] = [solution[0], solution[1], solution[2], solution[3]];
    solution.iter().all(|value| value.is_finite()).then_some((g, d, [v, w]))
}

/// Likely orbits as [v, w, T_1, phase at the bottom], by a dense scan: at a given T_1, (9) to (12) are linear in v,
/// w, sin(phase) and cos(phase), and their determinants have no pole where sin² + cos² = 1 is multiplied out.
/// Orbits closer than the grid, and whole families at one T_1, escape it.
pub fn scanned(motion: &Motion<f64>, periods: u32, points: u32) -> Vec<[f64; 4]> {
    let [g, d] = [*motion.g(), *motion.d()];
    let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| *motion.restitution(side));
    let total = 2.0 * f64::from(periods);
    let columns = |t_1: f64| {
        let t_2 = total - t_1;
        let (sin, cos) = (PI * t_1).sin_cos();
        // of F_1, and of F_2, at the end less at the start: what multiplies sin(phase), cos(phase)
        let (s_1, c_1) = ((cos - 1.0) / PI, sin / PI);
        let (s_2, c_2) = (sin / (PI * PI), -(cos - 1.0) / (PI * PI));
        let (top_s, top_c) = (cos / PI, sin / PI);
        [
            Vector4::new(-r_b, -r_b * t_1, -1.0, 0.0),
            Vector4::new(-1.0, 0.0, -r_t, -r_t * t_2),
            Vector4::new(s_1, s_2 - t_1 / PI, -s_1, -s_2 - top_s * t_2),
            Vector4::new(c_1, c_2, -c_1, -c_2 - top_c * t_2),
            -Vector4::new(g * t_1, 0.5 * g * t_1 * t_1 + d, g * t_2, 0.5 * g * t_2 * t_2 - d),
        ]
    };
    let parts = |t_1: f64| {
        let [v, w, s, c, right] = columns(t_1);
        let det = |a, b, c, d| Matrix4::from_columns(&[a, b, c, d]).determinant();
        [det(v, w, right, c), det(v, w, s, right), det(v, w, s, c)]
    };
    let excess = |t_1: f64| {
        let [sin, cos, all] = parts(t_1);
        sin * sin + cos * cos - all * all
    };
    let at = |index: u32| total * f64::from(index) / f64::from(points * periods);
    let mut found = Vec::new();
    let mut before = excess(at(1) * 1e-3);
    for index in 1..points * periods {
        let after = excess(at(index));
        if before * after < 0.0 {
            let (mut low, mut high) = (at(index - 1), at(index));
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                let same = excess(middle) * before > 0.0;
                if same { low = middle } else { high = middle }
            }
            let [sin, cos, all] = parts(low);
            let (sin, cos) = (sin / all, cos / all);
            if (sin * sin + cos * cos - 1.0).abs() < 1e-6 {
                let solution = velocities(&columns(low), sin, cos);
                found.push([solution[0], solution[1], low, sin.atan2(cos)]);
            }
        }
        before = after;
    }
    found
}

fn velocities([v, w, s, c, right]: &[Vector4<f64>; 5], sin: f64, cos: f64) -> [f64; 2] {
    // least squares: which of the four equations carry them depends on T_1
    let rest = right - s * sin - c * cos;
    let (vv, vw, ww) = (v.dot(v), v.dot(w), w.dot(w));
    let determinant = vv * ww - vw * vw;
    let (a, b) = (v.dot(&rest), w.dot(&rest));
    [(ww * a - vw * b) / determinant, (vv * b - vw * a) / determinant]
}

/// Whether a row is near [v, w, T_1, phase at the bottom].
pub fn is_near(row: &RoundedOrbit, [v, w, t_1, phase]: &[f64; 4], tolerance: f64) -> bool {
    let around = (row.phases[0] - phase).rem_euclid(TAU);
    (row.velocities[0] - v).abs() < tolerance
        && (row.velocities[1] - w).abs() < tolerance
        && (row.times[0] - t_1).abs() < tolerance
        && around.min(TAU - around) < tolerance
}
