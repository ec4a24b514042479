//! Orbits and bifurcations, beside one f64 sin_cos: the figures DESIGN asks for are multiples of its latency.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use vibro_audit::model::Motion;
use vibro_audit::number::{Interval, Wide};
use vibro_audit::orbit::{
    Balance, Condition, Conditioned, Orbit, Parameters, Prepared, Proved, nearest, nearest_event, one_to_one, prove,
};
use vibro_audit::scene::{self, Scene, Setting};

fn setting(set: &str) -> Setting {
    let text = scene::find("fig02").expect("a built-in scene");
    let mut scene = Scene::read(text, "fig02").expect("a scene");
    scene.set(set).expect("a key");
    scene.setting().expect("a motion")
}

/// The latency of one pair: each argument waits for the last result.
fn latency(criterion: &mut Criterion) {
    criterion.bench_function("sin_cos, latency (L)", |b| {
        let mut x = 1.0_f64;
        b.iter(|| {
            let (sin, cos) = x.sin_cos();
            x = sin + cos + 0.5;
            x
        });
    });
}

fn orbits(criterion: &mut Criterion) {
    let exact = setting("motion.d=0.4").motion::<f64>().expect("a motion");
    let balance = Balance::new(&exact, 1);
    let orbit = nearest(&balance, [1.1, 2.2]).expect("the orbit");
    let guess = [orbit[0] * 1.05, orbit[1] * 0.95];
    criterion.bench_function("1-1 orbit from a 5% wrong guess", |b| {
        b.iter(|| nearest(&balance, black_box(guess)));
    });
    let enclosed: Motion<Interval<f64>> = Parameters::motion(&exact).expect("a motion");
    criterion.bench_function("all orbits of a d, cold", |b| {
        b.iter(|| one_to_one(black_box(&enclosed), 1))
    });
    let search = one_to_one(&enclosed, 1);
    let proved = Proved::Pair {
        root: &search.motions[0],
        periods: 1,
    };
    criterion.bench_function("50-digit orbit, bounded", |b| {
        b.iter(|| -> Result<Orbit<Wide<50>>, _> { black_box(&proved).orbit(&exact) });
    });
}

fn sweeps(criterion: &mut Criterion) {
    let text = scene::find("fig02").expect("a built-in scene");
    let scene = Scene::read(text, "fig02").expect("a scene");
    let setting = scene.swept_setting().expect("a sweep");
    let prepared = Prepared::new(&setting, 1, Interval::new(0.1, 0.5)).expect("a cover");
    let mut d = 0.1;
    criterion.bench_function("all orbits of a d, prepared", |b| {
        b.iter(|| {
            d = if d > 0.499 { 0.1 } else { d + 0.001 };
            prepared.at(black_box(&d))
        });
    });
    criterion.bench_function("every bifurcation of Fig. 2", |b| b.iter(|| prepared.bifurcations()));
    let system = Conditioned {
        family: &setting,
        periods: 1,
        condition: Condition::MultiplierMinusOne,
        apart: Vec::new(),
    };
    let guess = [1.3, 2.2, 0.26];
    criterion.bench_function("period doubling from a guess", |b| {
        b.iter(|| nearest_event(&system, black_box(guess)));
    });
    criterion.bench_function("period doubling from a guess, proved", |b| {
        b.iter(|| prove(&system, &nearest_event(&system, black_box(guess))?, &[1e-4; 3]));
    });
}

criterion_group!(benches, latency, orbits, sweeps);
criterion_main!(benches);
