//! DP at one point by closed form, dual numbers and differences; and one impact, for scale.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use vibro_audit::model::{Forcing, Impact, Motion, Order, Pair, Passage, Side, next_impact};

fn dp(criterion: &mut Criterion) {
    let Ok(motion) = Motion::new(0.12201, 0.4, 0.5, 0.5) else {
        return;
    };
    let forcing = Forcing::harmonic(&0.0);
    // the stable orbit of Fig. 2 at d = 0.4
    let (time, velocity, durations) = (0.155_779_3, 0.832_720_225_1, [1.116_500_659_3, 0.883_499_340_7]);
    let pair = Pair::new(&motion, &forcing, &time, &velocity, [&durations[0], &durations[1]]);
    let mut group = criterion.benchmark_group("dp");
    group.bench_function("sincos", |b| b.iter(|| black_box(0.7_f64).sin_cos()));
    group.bench_function("formula", |b| b.iter(|| black_box(&pair).by_formula()));
    group.bench_function("trace-22", |b| b.iter(|| black_box(&pair).trace_by_formula()));
    group.bench_function("determinant-23", |b| {
        b.iter(|| black_box(&pair).determinant_by_formula())
    });
    group.bench_function("dual", |b| b.iter(|| black_box(&pair).product(Passage::by_duals)));
    for (name, order) in [("difference-2", Order::Two), ("difference-4", Order::Four)] {
        group.bench_function(name, |b| {
            b.iter(|| black_box(&pair).product(|passage| passage.by_differences(order)))
        });
    }
    let impact = Impact {
        side: Side::Bottom,
        time,
        velocity,
    };
    group.bench_function("next-impact", |b| {
        b.iter(|| next_impact(&motion, &forcing, black_box(&impact)))
    });
    group.finish();
}

criterion_group!(benches, dp);
criterion_main!(benches);
