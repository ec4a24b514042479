//! The five figures that matter, and L before and after them: `benches/compare` holds them against a saved baseline.
//! All run on one thread, whose own time is measured, so that what else the machine does counts little.

mod work;

use cpu_time::ThreadTime;
use criterion::measurement::{Measurement, ValueFormatter, WallTime};
use criterion::{Criterion, criterion_group, criterion_main};
use std::time::Duration;

/// The time this thread computes.
struct Computing;

impl Measurement for Computing {
    type Intermediate = ThreadTime;
    type Value = Duration;

    fn start(&self) -> ThreadTime {
        ThreadTime::now()
    }

    fn end(&self, start: ThreadTime) -> Duration {
        start.elapsed()
    }

    fn add(&self, one: &Duration, other: &Duration) -> Duration {
        *one + *other
    }

    fn zero(&self) -> Duration {
        Duration::ZERO
    }

    fn to_f64(&self, value: &Duration) -> f64 {
        WallTime.to_f64(value)
    }

    fn formatter(&self) -> &dyn ValueFormatter {
        WallTime.formatter()
    }
}

fn figures(criterion: &mut Criterion<Computing>) {
    criterion.bench_function("L", |b| b.iter(work::latency()));
    criterion.bench_function("one-impact", |b| b.iter(work::impact(0.5, 0.5, 0.4)));
    criterion.bench_function("sweep-401x500", |b| b.iter(work::sweep()));
    criterion.bench_function("all-orbits-cold", |b| b.iter(work::all_orbits()));
    criterion.bench_function("orbit-50-digits", |b| b.iter(work::many_digits()));
    criterion.bench_function("proof-22", |b| b.iter(work::proof()));
    criterion.bench_function("L-again", |b| b.iter(work::latency()));
}

criterion_group! {
    name = benches;
    config = Criterion::default().with_measurement(Computing).warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
    targets = figures
}
criterion_main!(benches);
