//! Impacts and sweeps, beside one f64 sin_cos: the figures DESIGN asks for are multiples of its latency.

mod work;

use criterion::{Criterion, criterion_group, criterion_main};
use rayon::prelude::*;
use std::hint::black_box;
use vibro_audit::impact::{Batch, Instructions, Kind, Simulation, Start, Widening};
use vibro_audit::model::{Motion, Side};
use vibro_audit::number::{DoubleDouble, Wide};
use vibro_audit::scene::{self, Scene};

fn motion(g: f64, d: f64, r_b: f64, r_t: f64) -> Motion<f64> {
    Motion::new(g, d, r_b, r_t).expect("a motion")
}

fn start() -> Start<f64> {
    Start::impact(Side::Bottom, 6.18, 0.5293)
}

/// g of the paper's device at pi/6.
fn g() -> f64 {
    let text = scene::find("fig02").expect("a built-in scene");
    let scene = Scene::read(text, "fig02").expect("a scene");
    *scene.motion::<f64>().expect("a motion").g()
}

fn latency(criterion: &mut Criterion) {
    criterion.bench_function("sincos, latency (L)", |b| b.iter(work::latency()));
}

fn impacts(criterion: &mut Criterion) {
    for (r_b, r_t, d) in [(0.5, 0.5, 0.4), (0.6, 0.3, 0.26)] {
        let motion = motion(g(), d, r_b, r_t);
        let name = format!("one impact, r {r_b} {r_t} d {d}");
        criterion.bench_function(&name, |b| {
            let mut simulation = Simulation::new(&motion, &start());
            b.iter(|| simulation.next());
        });
        criterion.bench_function(&format!("{name}, with the growth of errors"), |b| {
            let mut simulation = Simulation::new(&motion, &start()).with_growth();
            b.iter(|| simulation.next());
        });
    }
    let motion = motion(g(), 0.4, 0.5, 0.5);
    criterion.bench_function("one impact in double-double", |b| {
        let convert = |value: &f64| <DoubleDouble as vibro_audit::number::Analytic>::from_f64(*value);
        let motion = motion.convert(convert).expect("a motion");
        let mut simulation = Simulation::new(&motion, &start().convert(convert));
        b.iter(|| simulation.next());
    });
    criterion.bench_function("one impact in 50 digits", |b| {
        let convert = |value: &f64| <Wide<50> as vibro_audit::number::Analytic>::from_f64(*value);
        let motion = motion.convert(convert).expect("a motion");
        let mut simulation = Simulation::new(&motion, &start().convert(convert));
        b.iter(|| simulation.next());
    });
}

/// 1024 impacts of 64 orbits from starts close to each other, by each path of this machine.
fn many(criterion: &mut Criterion) {
    for (r_b, r_t, d) in [(0.5, 0.5, 0.4), (0.6, 0.3, 0.26)] {
        let near = |index: i32| Start {
            phase: 6.18 + 0.001 * f64::from(index),
            ..start()
        };
        let orbits: Vec<_> = (0..64).map(|index| (motion(g(), d, r_b, r_t), near(index))).collect();
        for instructions in Instructions::all() {
            let name = format!("65536 impacts of 64 orbits, r {r_b} {r_t} d {d}, {instructions:?}");
            criterion.bench_function(&name, |b| {
                b.iter(|| {
                    let mut sum = 0.0;
                    Batch::new(black_box(&orbits))
                        .on(instructions)
                        .run(1024, |_, event| sum += event.velocity);
                    sum
                });
            });
        }
    }
}

/// The gaps of Fig. 3.
fn gaps() -> Vec<Motion<f64>> {
    (0..401)
        .map(|index| motion(g(), 0.1 + 0.001 * f64::from(index), 0.6, 0.3))
        .collect()
}

/// 500 impacts, through rests; the sum of the velocities, so that nothing is left out.
fn run(events: impl Iterator<Item = vibro_audit::impact::Event<f64>>) -> f64 {
    let impacts = events.filter(|event| event.kind == Kind::Impact);
    impacts.take(500).map(|event| event.velocity).sum()
}

fn sweeps(criterion: &mut Criterion) {
    let gaps = gaps();
    criterion.bench_function("401 gaps x 500 impacts, one core", |b| {
        b.iter(|| {
            gaps.iter()
                .map(|motion| run(Simulation::new(motion, black_box(&start()))))
                .sum::<f64>()
        });
    });
    let orbits: Vec<_> = gaps.iter().map(|motion| (motion.clone(), start())).collect();
    for instructions in Instructions::all() {
        criterion.bench_function(
            &format!("401 gaps x 500 impacts, one core, in lanes, {instructions:?}"),
            |b| {
                b.iter(|| {
                    let mut sum = 0.0;
                    Batch::new(black_box(&orbits))
                        .on(instructions)
                        .run(500, |_, event| sum += event.velocity);
                    sum
                });
            },
        );
    }
    criterion.bench_function("401 gaps x 500 impacts, every core", |b| {
        b.iter(|| {
            gaps.par_iter()
                .map(|motion| run(Simulation::new(motion, black_box(&start()))))
                .sum::<f64>()
        });
    });
    criterion.bench_function(
        "401 gaps x 500 impacts, one core, undecided contacts widened, growth of errors",
        |b| {
            b.iter(|| {
                gaps.iter()
                    .map(|motion| run(Widening::new(motion, black_box(&start()))))
                    .sum::<f64>()
            });
        },
    );
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = latency, impacts, many, sweeps
}
criterion_main!(benches);
