//! Events against the maps of the model, wider numbers and closed forms.

use super::*;
use crate::model::{Forcing, Impact, Side, next_impact};
use numbers::{DoubleDouble, Field, Sequence, Wide};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

fn motion(g: f64, d: f64, r_b: f64, r_t: f64) -> Motion<f64> {
    Motion::new(g, d, r_b, r_t).expect("a motion")
}

fn start(phase: f64, velocity: f64) -> Start<f64> {
    Start::impact(Side::Bottom, phase, velocity)
}

fn events(motion: &Motion<f64>, start: &Start<f64>, count: usize) -> Vec<Event<f64>> {
    Simulation::new(motion, start).take(count).collect()
}

prop_compose! {
    /// Motions of the paper's range and well around it, many of which chatter.
    fn motions()(g in -1.4..1.4, d in 0.05..2.0, r_b in 0.05..1.0, r_t in 0.05..1.0) -> Motion<f64> {
        motion(g, d, r_b, r_t)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// model::next_impact brackets each rise and fall anew and shares no code with the flights here.
    #[test]
    fn each_impact_is_the_one_that_brackets_find(motion in motions(), phase in 0.0..TAU, velocity in 0.0..3.0) {
        let forcing = Forcing::harmonic(&0.0);
        let list = events(&motion, &start(phase, velocity), 40);
        for pair in list.windows(2) {
            let [before, after] = pair else { continue };
            let fast = [before, after].iter().all(|event| event.velocity.abs() > 1e-4);
            if !fast {
                continue;
            }
            let impact = Impact { side: before.side, time: before.phase / PI, velocity: before.velocity };
            // a contact that the other means calls grazing is not compared
            let Ok(leg) = next_impact(&motion, &forcing, &impact) else { continue };
            prop_assert_eq!(leg.to.side, after.side);
            let phase = (leg.to.time * PI - after.phase + PI).rem_euclid(TAU) - PI;
            let blur = 1e-12 / after.velocity.abs() + 1e-13 * leg.duration.abs();
            prop_assert!(phase.abs() < blur, "{} {}", phase, leg.duration);
            prop_assert!((leg.to.velocity - after.velocity).abs() < blur);
        }
    }

    #[test]
    fn turns_of_the_start_and_the_mirror_image_change_nothing_else(motion in motions(), phase in 0.0..TAU, velocity in 0.0..3.0) {
        let start = start(phase, velocity);
        let mirrored = Start::impact(Side::Top, phase + PI, -velocity);
        let turned = Start { phase: phase + 3.0 * TAU, ..start.clone() };
        let mut followed = Simulation::new(&motion, &start).with_growth();
        let mut image = Simulation::new(&motion.mirrored().expect("two walls"), &mirrored).with_growth();
        let mut turned = Simulation::new(&motion, &turned).with_growth();
        for _ in 0..20 {
            let [event, image_event, turned_event] = [followed.next(), image.next(), turned.next()];
            let growth = [followed.tracked(), image.tracked(), turned.tracked()];
            if growth.iter().any(|growth| !growth.holds()) {
                break;
            }
            let (Some(event), Some(image), Some(turned)) = (event, image_event, turned_event) else { break };
            prop_assert_eq!((image.kind, image.side), (event.kind, event.side.opposite()));
            prop_assert_eq!((turned.kind, turned.side), (event.kind, event.side));
            // phases shifted by turns are rounded more
            let [phases, velocities] = [Growth::phase_error, Growth::velocity_error].map(|error| growth.map(error).iter().sum::<f64>() * 10.0);
            for (phase, velocity) in [(image.phase - PI, -image.velocity), (turned.phase, turned.velocity)] {
                let apart = (phase - event.phase + PI).rem_euclid(TAU) - PI;
                prop_assert!(apart.abs() <= phases && (velocity - event.velocity).abs() <= velocities);
            }
        }
    }

    /// Dense sampling in many digits of the closed form (4), which shares nothing with the pieces.
    #[test]
    fn between_two_events_the_ball_is_within_the_walls(motion in motions(), phase in 0.0..TAU, velocity in 0.0..3.0) {
        type Number = Wide<40>;
        let wide = motion.convert(|value| Number::from_f64(*value)).expect("a motion");
        let forcing = Forcing::harmonic(&Number::from_f64(0.0));
        let list: Vec<Event<Number>> = Simulation::new(&wide, &start(phase, velocity).convert(|v| Number::from_f64(*v))).take(8).collect();
        for pair in list.windows(2) {
            let [before, after] = pair else { continue };
            if matches!(after.kind, Kind::Rest | Kind::Release) {
                continue;
            }
            let time = before.phase.clone() / Number::pi();
            let launch = -(wide.restitution(before.side).clone() * before.velocity.clone());
            let flight = crate::model::Flight::launched(&wide, &forcing, before.side, &time, launch).expect("a flight");
            let end = after.time(&before.phase) - Number::from_f64(2.0 * before.turns as f64);
            let half = wide.d().clone() * Number::from_f64(0.5);
            for part in 1..50 {
                let z = flight.position(&(end.clone() * Number::from_ratio(part, 50)));
                let beyond = z.to_f64().abs() - half.to_f64();
                prop_assert!(beyond < 1e-15, "{} of the way: {}", part, beyond);
            }
            let z = flight.position(&end);
            let there = after.side.signed(half);
            prop_assert!((z - there).to_f64().abs() < 1e-30);
        }
    }
}

/// How the estimated errors compare with the true ones along these motions: velocities compared, those whose error is
/// larger than its estimate, the largest such ratio, and the median over-estimate.
fn estimates(seeds: std::ops::Range<u64>) -> (usize, usize, f64, f64) {
    let mut over: Vec<f64> = Vec::new();
    for seed in seeds {
        let mut sequence = Sequence::new(seed);
        let [g, d, r_b, r_t] = [(-0.9, 0.9), (-3.0, 1.0), (0.05, 1.0), (0.05, 1.0)]
            .map(|(low, high): (f64, f64)| sequence.between(low, high));
        let motion = motion(g, 10_f64.powf(d), r_b, r_t);
        let start = start(sequence.between(0.0, TAU), sequence.between(0.0, 3.0));
        let wide = motion
            .convert(|value| DoubleDouble::from_f64(*value))
            .expect("a motion");
        let mut narrow = Simulation::new(&motion, &start).with_growth();
        let exact = Simulation::new(&wide, &start.convert(|value| DoubleDouble::from_f64(*value)));
        for exact in exact.take(60) {
            let Some(event) = narrow.next() else { break };
            let growth = narrow.growth().expect("followed");
            if !growth.holds() || growth.phase_error() > 1e-6 {
                break;
            }
            assert_eq!((event.kind, event.side), (exact.kind, exact.side), "{seed}");
            let error = (exact.velocity - DoubleDouble::from_f64(event.velocity)).to_f64().abs();
            if error > 0.0 {
                over.push(growth.velocity_error() / error);
                let digits = i32::try_from(growth.digits(event.velocity)).expect("few");
                assert!(
                    error <= event.velocity.abs() * 10_f64.powi(-digits),
                    "{seed}: {event:?}"
                );
            }
        }
    }
    over.sort_by(f64::total_cmp);
    let below = over.iter().filter(|over| **over < 1.0).count();
    (over.len(), below, 1.0 / over[0], over[over.len() / 2])
}

#[test]
fn the_error_of_a_velocity_is_estimated_within_a_digit_and_hardly_ever_too_low() {
    let (compared, below, worst, median) = estimates(0..2000);
    assert!(
        compared > 40_000 && below * 400 <= compared,
        "{below} of {compared}, {worst} times"
    );
    assert!(worst < 10.0 && (1.0..=10.0).contains(&median), "{worst} {median}");
}

#[test]
#[ignore = "a minute: part of .ci/long"]
fn the_error_of_a_velocity_is_estimated_on_120000_motions() {
    let (compared, below, worst, median) = estimates(1_000_000..1_120_000);
    println!("{below} of {compared} too low, at most {worst} times; over-estimated {median} times in the median");
    assert!(below * 400 <= compared && worst < 10.0 && median <= 10.0);
}

/// g and a phase, the angle after which the flight that leaves the bottom there after an impact of 0.9 turns back, with
/// r_b = 0.5, and how high it is then, in units without pi.
fn turning_point() -> ([f64; 2], f64, f64) {
    let (g, phase) = (0.12_f64, 5.6_f64);
    let (sin, cos) = phase.sin_cos();
    let launch = 0.5 * 0.9 * PI;
    let mut x: f64 = 1.2;
    for _ in 0..60 {
        let w = launch + sin - g * x - (phase + x).sin();
        x += w / ((phase + x).cos() + g);
    }
    let height = (launch + sin) * x - 0.5 * g * x * x - cos + (phase + x).cos();
    ([g, phase], x, height)
}

#[test]
fn a_grazing_contact_is_found_however_slightly_it_enters() {
    // The flight from the bottom at this phase turns back at the top; d puts the wall `depth` before that point.
    let ([g, phase], x, height) = turning_point();
    for depth in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let next = |d: f64| events(&motion(g, d, 0.5, 0.5), &start(phase, 0.9), 2).swap_remove(1);
        let (entering, missing) = (next(height / (PI * PI) - depth), next(height / (PI * PI) + depth));
        assert_eq!((entering.kind, entering.side), (Kind::Impact, Side::Top), "{depth}");
        // the velocity that such a depth leaves, under the push there
        let speed = (2.0 * depth * ((phase + x).cos() + g)).sqrt();
        assert!(
            (entering.velocity / -speed - 1.0).abs() < 5.0 * depth.sqrt() + 1e-15 / depth,
            "{depth}"
        );
        assert!(missing.time(&phase) > x / PI + 0.1, "{depth}");
    }
}

#[test]
fn of_what_follows_a_dip_that_rounding_may_close_nothing_is_claimed() {
    // as above: the flight from the bottom turns back before the top, so near that its error at the dip decides
    let ([g, phase], _, height) = turning_point();
    for (depth, holds) in [(1e-10, true), (1e-12, true), (2e-15, false), (1e-15, false)] {
        let mut simulation = Simulation::new(&motion(g, height / (PI * PI) + depth, 0.5, 0.5), &start(phase, 0.9));
        simulation = simulation.with_growth();
        let next = simulation.nth(1).expect("an impact");
        assert_eq!(
            (next.kind, simulation.tracked().holds()),
            (Kind::Impact, holds),
            "{depth}"
        );
    }
}

#[test]
fn a_ball_at_rest_is_released_where_f_plus_g_changes_sign() {
    let g = 0.3_f64;
    let list = events(&motion(g, 0.5, 0.6, 0.6), &start(0.2, 0.0), 3);
    let kinds: Vec<Kind> = list.iter().map(|event| event.kind).collect();
    assert_eq!(kinds, [Kind::Impact, Kind::Rest, Kind::Release]);
    assert_eq!(list[2].phase, (-g).acos());
    // where nothing presses, it leaves at once
    let list = events(&motion(g, 0.5, 0.6, 0.6), &start(2.5, 0.0), 2);
    assert_eq!(list[1].kind, Kind::Impact);
    assert!(list[1].time(&2.5) > 0.1);
}

#[test]
fn at_the_very_zero_of_f_plus_g_a_ball_at_rest_stays_where_pressing_begins() {
    // cos = -g, and f + g rises through 0 there
    let phase = 4.0 * PI / 3.0;
    for r in [0.5, 0.99, 1.0] {
        let list = events(&motion(0.5, 0.3, r, r), &start(phase, 0.0), 3);
        let kinds: Vec<Kind> = list.iter().map(|event| event.kind).collect();
        assert_eq!(kinds, [Kind::Impact, Kind::Rest, Kind::Release], "{r}");
        assert_eq!(list[1].phase, phase);
    }
}

#[test]
fn the_start_is_listed_as_it_was_given() {
    for velocity in [1e-10, 1e-7, 0.1, 67.0] {
        assert_eq!(
            events(&motion(0.1, 0.3, 0.5, 0.5), &start(6.18, velocity), 1)[0].velocity,
            velocity
        );
    }
}

#[test]
fn gravity_beyond_the_forcing_ends_a_motion_on_its_wall() {
    for (g, speed, wall) in [(1.1, 0.4, Side::Bottom), (-1.5, 0.0, Side::Top)] {
        let last = events(&motion(g, 0.5, 0.6, 0.6), &start(0.0, speed), 1000).pop();
        assert_eq!(last.map(|last| (last.kind, last.side)), Some((Kind::Rest, wall)));
    }
}

#[test]
fn without_loss_a_chatter_goes_on_to_the_release_and_is_listed_as_it_comes() {
    let slowest = events(&motion(0.5, 0.3, 1.0, 1.0), &start(0.5, 1e-9), 5);
    assert!(slowest.len() == 5 && slowest.iter().all(|event| event.kind == Kind::Impact));
    let list = events(&motion(0.0, 0.5, 1.0, 1.0), &start(0.0, 1e-3), 2000);
    let away = list.iter().position(|event| event.side == Side::Top).expect("the top");
    assert!(away > 100, "{away}");
    assert!(list.iter().all(|event| event.kind == Kind::Impact));
}

#[test]
fn long_flights_skip_whole_turns_and_end_where_they_must() {
    let d = 1e6;
    let list = events(&motion(0.0, d, 0.5, 0.5), &start(1.0, 2.0), 2);
    // drift: launch plus sin / pi, against the bottom of the mean motion
    let drift = 1.0 + 1.0_f64.sin() / PI;
    let time = list[1].time(&1.0);
    assert!((time * drift / d - 1.0).abs() < 1e-6, "{time}");
    let list = events(&motion(1.0, d, 0.5, 0.5), &start(1.0, 2.0), 2);
    assert_eq!(list[1].side, Side::Bottom);
}

#[test]
fn a_ball_that_floats_or_grazes_for_ever_is_not_followed_for_ever() {
    // without gravity, launched so that the mean velocity vanishes: it touches its wall, with velocity 0, each turn
    let list = events(&motion(0.0, 5.0, 0.5, 0.5), &start(PI, 0.0), 10);
    assert!(list.len() < 10);
}

#[test]
fn errors_on_a_motion_that_attracts_stay_small_for_a_million_impacts() {
    let motion = motion(0.12201, 0.4, 0.5, 0.5);
    let mut simulation = Simulation::new(&motion, &start(6.18, 0.5293)).with_growth();
    let last = simulation.nth(1_000_000 - 1).expect("an impact");
    let growth = simulation.growth().expect("followed");
    assert!(growth.phase_error() < 1e-13 && growth.velocity_error() < 1e-13);
    // the state a hundred thousand periods before is the same
    let earlier = Simulation::new(&motion, &start(6.18, 0.5293))
        .nth(800_000 - 1)
        .expect("an impact");
    assert!((last.velocity - earlier.velocity).abs() < growth.velocity_error() * 2.0);
}

#[test]
fn a_touch_that_rounding_hides_is_told_with_the_phase_at_which_it_is() {
    let motion = motion(0.1, 0.4, 0.5, 0.5);
    let second = |velocity: f64| events(&motion, &start(1.0, velocity), 2).pop().expect("two events");
    // between a flight that comes back and one that reaches the other wall
    let (mut low, mut high) = (0.05, 3.0);
    assert_eq!([second(low).side, second(high).side], [Side::Bottom, Side::Top]);
    let touch = loop {
        let middle = 0.5 * (low + high);
        assert!(low < middle && middle < high, "no flight touches within rounding");
        match second(middle) {
            event if event.kind == Kind::Undecided => break event,
            event if event.side == Side::Top => high = middle,
            _ => low = middle,
        }
    };
    // the slower flight hits the wall that the touching one touches
    let hit = second(low * (1.0 - 1e-9));
    let apart = (touch.phase - hit.phase + PI).rem_euclid(TAU) - PI;
    assert_eq!((hit.kind, hit.side), (Kind::Impact, touch.side));
    assert!(apart.abs() < 1e-3, "{apart}");
}
