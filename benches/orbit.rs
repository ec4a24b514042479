//! Orbits and bifurcations, beside one f64 sin_cos: the figures DESIGN asks for are multiples of its latency. All
//! orbits of a d, cold, and the 50-digit orbit are in figures.rs.

mod work;

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use vibro_audit::number::Interval;
use vibro_audit::orbit::{
    BifurcationCondition, ConditionedOneOne, OneOneBranches, OrbitOptions, newton_one_one_bifurcation, prove,
};
use vibro_audit::scene::{self, Scene};

fn orbits(criterion: &mut Criterion) {
    criterion.bench_function("sincos, latency (L)", |b| b.iter(work::latency()));
    criterion.bench_function("1-1 orbit from a 5% wrong guess, with its velocities", |b| {
        b.iter(work::orbit())
    });
    criterion.bench_function("period doubling from a guess, parameters as f64", |b| {
        b.iter(work::doubling())
    });
}

fn sweeps(criterion: &mut Criterion) {
    let text = scene::find("fig02").expect("a built-in scene");
    let scene = Scene::read(text, "fig02").expect("a scene");
    let setting = scene.swept_setting().expect("a sweep");
    let prepared = OneOneBranches::new(&setting, 1, Interval::new(0.1, 0.5), &OrbitOptions::DEFAULT).expect("a cover");
    let mut d = 0.1;
    criterion.bench_function("all orbits of a d, prepared", |b| {
        b.iter(|| {
            d = if d > 0.499 { 0.1 } else { d + 0.001 };
            prepared.at(black_box(&d))
        });
    });
    criterion.bench_function("every bifurcation of Fig. 2", |b| b.iter(|| prepared.bifurcations()));
    let system = ConditionedOneOne {
        family: &setting,
        periods: 1,
        condition: BifurcationCondition::MultiplierMinusOne,
        apart: Vec::new(),
    };
    let guess = [1.3, 2.2, 0.26];
    criterion.bench_function("period doubling from a guess, parameters of a scene", |b| {
        b.iter(|| newton_one_one_bifurcation(&system, black_box(guess)));
    });
    criterion.bench_function("the same, proved", |b| {
        b.iter(|| {
            prove(
                &system,
                &newton_one_one_bifurcation(&system, black_box(guess))?,
                &[1e-4; 3],
            )
        });
    });
}

criterion_group!(benches, orbits, sweeps);
criterion_main!(benches);
