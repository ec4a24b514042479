//! vibro-audit at the work of the table, called as a library.

#[path = "../timing.rs"]
mod timing;
#[path = "../../../../work/mod.rs"]
mod work;

use timing::{say, seconds};
use vibro_audit::impact::{Event, Kind, Simulation};
use vibro_audit::number::{Interval, Wide};

/// Shortest decimals that read back to the same f64.
fn decimals(values: &[f64]) -> Vec<String> {
    values.iter().map(f64::to_string).collect()
}

fn midpoint(interval: &Interval<Wide<50>>) -> String {
    interval.midpoint().to_decimal(50)
}

fn impacts() {
    for (task, r_b, r_t, d) in [("impact-focus", 0.5, 0.5, 0.4), ("impact-three", 0.6, 0.3, 0.26)] {
        let last = Simulation::new(&work::motion(d, r_b, r_t), &work::start()).nth(100);
        let answers = last
            .map(|event| decimals(&[event.phase, event.velocity]))
            .unwrap_or_default();
        say(task, "vibro-audit", seconds(work::impact(r_b, r_t, d)), &answers);
    }
}

/// The fastest of the last 60 of 500 impacts, the start's being the first.
fn fastest(events: impl Iterator<Item = Event<f64>>) -> f64 {
    let impacts = events.filter(|event| event.kind == Kind::Impact);
    let last = impacts.take(500).skip(440);
    last.map(|event| event.velocity.abs()).fold(0.0, f64::max)
}

fn main() {
    let before = seconds(work::latency());
    impacts();
    let start = work::start();
    let ends: Vec<f64> = work::gaps()
        .iter()
        .map(|motion| fastest(Simulation::new(motion, &start)))
        .collect();
    say("sweep", "vibro-audit", seconds(work::sweep()), &decimals(&ends));
    let mut orbit = work::orbit();
    let found = orbit().map(|[t_1, _, v, w]| decimals(&[t_1, v, w])).unwrap_or_default();
    say("orbit", "vibro-audit", seconds(orbit), &found);
    let mut doubling = work::doubling();
    let found = doubling().map(|[_, _, d]| decimals(&[d])).unwrap_or_default();
    say("doubling", "vibro-audit", seconds(doubling), &found);
    let mut all = work::all_orbits();
    let count = all().to_string();
    say("all-orbits", "vibro-audit", seconds(all), &[count]);
    let mut many = work::many_digits();
    let orbit = many();
    let answers = [&orbit.times[0], &orbit.velocities[0], &orbit.velocities[1]].map(midpoint);
    say("orbit-50", "vibro-audit", seconds(many), &answers);
    let mut proof = work::proof();
    let verdict = proof().verdict.to_string();
    say("proof-22", "vibro-audit", seconds(proof), &[verdict]);
    let after = seconds(work::latency());
    say("latency", "one f64 sin_cos", before.min(after), &[]);
}
