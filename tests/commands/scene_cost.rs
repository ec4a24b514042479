//! What a sweep costs as a scene, beside the bare loop over the same impacts.
//!
//! A measurement, so only where it is asked for: `cargo test --release --test commands scene_cost -- --ignored --nocapture`.
//! That the steps are the same, one by one, is counted at each run in src/cli/modelled.rs.

use std::hint::black_box;
use std::time::{Duration, Instant};
use vibro_audit::impact::{Kind, Origin, Simulation};
use vibro_audit::model::Motion;
use vibro_audit::orbit::{Family, Parameters};
use vibro_audit::scene::{Scene, find};

/// Runs of each, in turn; the least time is that of the quietest moment.
const RUNS: usize = 200;

fn scene() -> Scene {
    let mut scene = Scene::read(find("fig03").expect("built in"), "fig03").expect("a scene");
    scene.set(r#"want=["sweep"]"#).expect("no voltage");
    scene
}

/// The sweep as `vibro-audit sweep` has it, up to where rows are written.
#[inline(never)]
fn swept(scene: &Scene) -> f64 {
    let points = scene.points().expect("a sweep").listed();
    points.map(|point| last(&point.expect("a point").settled.kept)).sum()
}

fn last(kept: &[vibro_audit::impact::Event<f64>]) -> f64 {
    kept.last().map_or(0.0, |event| event.velocity)
}

/// Impacts and nothing else.
#[inline(never)]
fn bare(motions: &[Motion<f64>], scene: &Scene) -> f64 {
    let start = scene.start().expect("a start").start();
    let of = |motion| {
        let impacts = Simulation::new(motion, &start).filter(|event| event.kind == Kind::Impact);
        impacts.take(500).fold(0.0, |_, event| event.velocity)
    };
    motions.iter().map(of).sum()
}

fn timed(work: impl FnOnce() -> f64) -> (Duration, f64) {
    let start = Instant::now();
    let result = black_box(work());
    (start.elapsed(), result)
}

#[test]
#[ignore = "a measurement"]
fn a_sweep_of_a_scene_ends_where_the_bare_loop_does_at_a_cost_that_is_printed() {
    let scene = scene();
    let setting = scene.swept_setting().expect("a setting");
    let values = scene.sweep().expect("a sweep");
    let motions: Vec<Motion<f64>> = values
        .values()
        .map(|value| setting.fixed(&value).motion().expect("a motion"))
        .collect();
    // one thread for the scene as for the loop
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    let mut least = [Duration::MAX; 2];
    for _ in 0..RUNS {
        let (by_loop, expected) = timed(|| bare(&motions, &scene));
        let (by_scene, found) = pool.install(|| timed(|| swept(&scene)));
        assert_eq!(found, expected);
        least = [least[0].min(by_loop), least[1].min(by_scene)];
    }
    let [by_loop, by_scene] = least.map(|time| time.as_secs_f64());
    let more = by_scene / by_loop - 1.0;
    println!(
        "bare loop {by_loop:.6} s, scene {by_scene:.6} s: {:.2}% more",
        100.0 * more
    );
    assert!(more <= 0.02, "{more}");
}
