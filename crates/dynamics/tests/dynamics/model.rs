//! The motion against the equations and symmetries that it must obey.

use dynamics::model::{Flight, FlightError, Forcing, Impact, Motion, Order, Pair, Passage, Side, Watch, next_impact};
use nalgebra::Matrix2;
use numbers::{Analytic, Dual, Wide, seeded};
use proptest::prelude::*;
use std::f64::consts::TAU;

type Digits = Wide<40>;

/// A motion, a forcing of several harmonics and an impact with a clear velocity.
fn start() -> impl Strategy<Value = (Motion<f64>, Forcing<f64>, Impact<f64>)> {
    let motion = (-1.5..1.5_f64, 0.05..1.5_f64, 0.1..1.0_f64, 0.1..1.0_f64);
    let impact = (any::<bool>(), 0.0..2.0_f64, 0.1..1.5_f64);
    let forcing = prop_oneof![
        (0.0..TAU).prop_map(|phase| Forcing::harmonic(&phase)),
        (0.1..1.0_f64, -0.5..0.5_f64, -0.5..0.5_f64, -0.3..0.3_f64).prop_filter_map("a forcing", |(a, b, c, d)| {
            Forcing::periodic(2.0, &[a, b], &[c, 0.0, d]).ok()
        }),
    ];
    (motion, forcing, impact).prop_filter_map("a motion", |((g, d, r_b, r_t), forcing, (bottom, time, speed))| {
        let side = if bottom { Side::Bottom } else { Side::Top };
        let motion = Motion::new(g, d, r_b, r_t).ok()?;
        Some((
            motion,
            forcing,
            Impact {
                side,
                time,
                velocity: side.sign() * speed,
            },
        ))
    })
}

fn widened(
    motion: &Motion<f64>,
    forcing: &Forcing<f64>,
    impact: &Impact<f64>,
) -> (Motion<Digits>, Forcing<Digits>, Impact<Digits>) {
    let wide = |value: &f64| Digits::from_f64(*value);
    let motion = motion.convert(wide).expect("the same numbers");
    let Impact { side, time, velocity } = impact;
    (
        motion,
        forcing.convert(wide),
        Impact {
            side: *side,
            time: wide(time),
            velocity: wide(velocity),
        },
    )
}

/// |a - b| against the size of the larger, or against 1 below that.
fn apart(a: f64, b: f64) -> f64 {
    (a - b).abs() / a.abs().max(b.abs()).max(1.0)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn a_flight_ends_at_a_wall_and_touches_none_before((motion, forcing, impact) in start()) {
        let Ok(flight) = Flight::after(&motion, &forcing, &impact) else { return Ok(()) };
        let Ok(crossing) = flight.crossing(Watch::Both) else { return Ok(()) };
        let end = flight.state(&crossing.duration);
        // the time is rounded, so the place is off by velocity times that rounding
        let slack = 1e-14 * (1.0 + crossing.duration * (end.velocity.abs() + crossing.duration));
        prop_assert!((end.displacement - flight.target(crossing.side)).abs() < slack);
        prop_assert!(crossing.side.sign() * end.velocity >= -1e-7);
        for step in 1..1000 {
            let place = flight.position(&(crossing.duration * f64::from(step) / 1000.0));
            prop_assert!(place.abs() < 0.5 * motion.d() + slack, "outside at step {step}");
        }
    }

    #[test]
    fn pieces_between_turnings_and_proved_steps_find_the_same_crossing(
        (motion, _, impact) in start(), phase in 0.0..TAU
    ) {
        let forcing = Forcing::harmonic(&phase);
        // a second harmonic that is there and does nothing sends the same flight the other way
        let also = Forcing::periodic(2.0, &[phase.cos(), 1e-300], &[-phase.sin()]).expect("a forcing");
        let one = next_impact(&motion, &forcing, &impact);
        let other = next_impact(&motion, &also, &impact);
        match (one, other) {
            (Ok(one), Ok(other)) => {
                prop_assume!(one.to.velocity.abs() > 1e-4);
                prop_assert_eq!(one.to.side, other.to.side);
                prop_assert!(apart(one.duration, other.duration) < 1e-10);
                prop_assert!(apart(one.to.velocity, other.to.velocity) < 1e-10);
            }
            (one, other) => prop_assert_eq!(one.is_err(), other.is_err()),
        }
    }

    #[test]
    fn work_of_the_forcing_is_the_change_of_energy((motion, forcing, impact) in start(), s in 0.0..3.0_f64) {
        // d/dt (Zdot²/2 - g Z) = f Zdot, not 0 as the paper's "constant energy between impacts" has it
        let lift = |value: &f64| Dual::from_re(*value);
        let (dual, ahead) = (motion.convert(lift).expect("the same numbers"), forcing.convert(lift));
        let start = Impact { side: impact.side, time: lift(&impact.time), velocity: lift(&impact.velocity) };
        let Ok(flight) = Flight::after(&dual, &ahead, &start) else { return Ok(()) };
        let time = seeded(s);
        let state = flight.state(&time);
        let energy = state.velocity * state.velocity * Dual::from_re(0.5) - *dual.g() * flight.position(&time);
        let forced = forcing.at(&(impact.time + s)).f;
        prop_assert!((energy.eps - forced * state.velocity.re).abs() < 1e-13);
    }

    #[test]
    fn a_flight_is_the_same_one_forcing_period_later((motion, forcing, impact) in start(), later in 1_i64..1000) {
        let mut moved = impact.clone();
        moved.time += 2.0 * later as f64;
        let (one, other) = (next_impact(&motion, &forcing, &impact), next_impact(&motion, &forcing, &moved));
        let (Ok(one), Ok(other)) = (one, other) else { return Ok(()) };
        // adding the periods rounds the time, and an arrival magnifies that by 1 / velocity at most
        prop_assume!(one.to.velocity.abs() > 1e-2);
        prop_assert_eq!(one.to.side, other.to.side);
        prop_assert!(apart(one.duration, other.duration) < 1e-10);
        let late = (one.to.time - other.to.time).abs();
        prop_assert!(late.min(2.0 - late) < 1e-10);
    }

    #[test]
    fn the_mirror_image_flies_to_the_mirrored_wall((motion, _, impact) in start(), phase in 0.0..TAU) {
        // walls and restitutions exchanged, gravity reversed, phase + pi: a time shift by 1
        let forcing = Forcing::harmonic(&phase);
        let mirrored = Impact { side: impact.side.opposite(), time: impact.time + 1.0, velocity: -impact.velocity };
        let one = next_impact(&motion, &forcing, &impact);
        let other = next_impact(&motion.mirrored().expect("two walls"), &forcing, &mirrored);
        let (Ok(one), Ok(other)) = (one, other) else { return Ok(()) };
        prop_assume!(one.to.velocity.abs() > 1e-2);
        prop_assert_eq!(one.to.side, other.to.side.opposite());
        prop_assert!(apart(one.duration, other.duration) < 1e-12);
        prop_assert!(apart(one.to.velocity, -other.to.velocity) < 1e-11);
    }

    #[test]
    fn f64_flies_as_forty_digits_do((motion, forcing, impact) in start()) {
        let (wide_motion, wide_forcing, wide_impact) = widened(&motion, &forcing, &impact);
        let narrow = next_impact(&motion, &forcing, &impact);
        let wide = next_impact(&wide_motion, &wide_forcing, &wide_impact);
        let (Ok(narrow), Ok(wide)) = (narrow, wide) else { return Ok(()) };
        let speed = wide.to.velocity.to_f64().abs();
        prop_assume!(speed > 1e-4);
        prop_assert_eq!(narrow.to.side, wide.to.side);
        // the displacement, rounded to 1e-15 of its terms, is divided by the velocity of arrival
        let size = 1.0 + wide.duration.to_f64().powi(2);
        prop_assert!((narrow.duration - wide.duration.to_f64()).abs() < 4e-15 * size / speed.min(1.0));
        prop_assert!((narrow.to.velocity + -wide.to.velocity.to_f64()).abs() < 1e-14 * size / speed.min(1.0));
    }

    #[test]
    fn closed_form_entries_are_the_dual_entries_and_the_differences((motion, forcing, impact) in start()) {
        let (motion, forcing, impact) = widened(&motion, &forcing, &impact);
        let Ok(leg) = next_impact(&motion, &forcing, &impact) else { return Ok(()) };
        let speed = leg.to.velocity.to_f64().abs();
        prop_assume!(speed > 1e-2 && leg.duration.to_f64() < 20.0);
        let passage = Passage::new(&motion, &forcing, &impact, &leg.duration);
        let formula = passage.by_formula().expect("no grazing");
        let through = |entries: Matrix2<Digits>, tolerance: f64| {
            formula.iter().zip(entries.iter()).all(|(a, b)| {
                (a.clone() - b.clone()).to_f64().abs() < tolerance * (1.0 + a.to_f64().abs()) / speed.powi(3)
            })
        };
        prop_assert!(through(passage.by_duals().expect("no grazing"), 1e-36), "duals");
        // 50 digits are carried: steps of 1e-17 and 1e-10 leave 30 and 36 digits, times higher derivatives, which
        // grow as powers of 1/speed
        if let Ok(entries) = passage.by_differences(Order::Two) {
            prop_assert!(through(entries, 1e-25), "order 2");
        }
        if let Ok(entries) = passage.by_differences(Order::Four) {
            prop_assert!(through(entries, 1e-26), "order 4");
        }
    }

    #[test]
    fn the_map_of_dual_numbers_has_the_derivative_of_the_map((motion, forcing, impact) in start()) {
        let Ok(leg) = next_impact(&motion, &forcing, &impact) else { return Ok(()) };
        let speed = leg.to.velocity.abs();
        prop_assume!(speed > 1e-2 && leg.duration < 20.0);
        let entries = Passage::new(&motion, &forcing, &impact, &leg.duration).by_formula().expect("no grazing");
        let lift = |value: &f64| Dual::from_re(*value);
        let (dual_motion, dual_forcing) = (motion.convert(lift).expect("the same"), forcing.convert(lift));
        let seed = |time, velocity| Impact { side: impact.side, time, velocity };
        let by_time = seed(seeded(impact.time), lift(&impact.velocity));
        let by_velocity = seed(lift(&impact.time), seeded(impact.velocity));
        for (column, start) in [by_time, by_velocity].iter().enumerate() {
            let leg = next_impact(&dual_motion, &dual_forcing, start).expect("the same flight");
            let scale = 1e-11 * (1.0 + entries.abs().max()) / speed;
            prop_assert!((leg.to.time.eps - entries[(0, column)]).abs() < scale);
            prop_assert!((leg.to.velocity.eps - entries[(1, column)]).abs() < scale);
        }
    }

    #[test]
    fn trace_and_determinant_of_a_closed_pair_are_those_of_the_product(
        g in -1.0..1.0_f64, r_b in 0.1..1.0_f64, r_t in 0.1..1.0_f64,
        time in 0.0..2.0_f64, first in 0.1..1.9_f64, velocity in 0.1..2.0_f64, phase in 0.0..TAU
    ) {
        let wide = Digits::from_f64;
        let motion = Motion::new(wide(g), wide(1.0), wide(r_b), wide(r_t)).expect("a motion");
        let forcing = Forcing::harmonic(&wide(phase));
        let durations = [wide(first), wide(2.0) - wide(first)];
        let pair = Pair::new(&motion, &forcing, &wide(time), &wide(velocity), [&durations[0], &durations[1]]);
        let (Ok(product), Ok(trace)) = (pair.product(Passage::by_formula), pair.trace_by_formula()) else {
            return Ok(())
        };
        let size = product.iter().map(|entry| entry.to_f64().abs()).fold(1.0, f64::max);
        prop_assume!(size < 1e5);
        prop_assert!((product.trace() - trace).to_f64().abs() < 1e-34 * size);
        let [a, b, c, d] = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|at| product[at].clone());
        let determinant = pair.determinant_by_formula().expect("no grazing");
        prop_assert!((a * d - b * c - determinant).to_f64().abs() < 1e-34 * size * size);
    }
}

proptest! {
    #[test]
    fn any_bits_whatever_give_an_answer_or_an_error_and_no_panic(
        bits in prop::array::uniform8(any::<u64>()), several in any::<bool>(), top in any::<bool>()
    ) {
        let [g, d, r_b, r_t, time, velocity, phase, amplitude] = bits.map(f64::from_bits);
        // restitutions are seldom in range as bits
        let part = |value: f64| if value.abs() > 1.0 { 1.0 / value.abs() } else { value.abs() };
        let Ok(motion) = Motion::new(g, d.abs(), part(r_b), part(r_t)) else { return Ok(()) };
        let both = Forcing::periodic(part(phase), &[amplitude, 0.3], &[]).ok();
        let forcing = both.filter(|_| several).unwrap_or_else(|| Forcing::harmonic(&phase));
        let side = if top { Side::Top } else { Side::Bottom };
        let impact = Impact { side, time, velocity: side.sign() * velocity.abs() };
        if let Ok(leg) = next_impact(&motion, &forcing, &impact) {
            prop_assert!(leg.duration >= 0.0);
            let passage = Passage::new(&motion, &forcing, &impact, &leg.duration);
            let _ = (passage.by_formula(), passage.by_duals(), passage.by_differences(Order::Four));
        }
    }
}

#[test]
fn without_gravity_and_drift_a_ball_floats_for_ever() {
    let motion = Motion::new(0.0, 2.0, 0.5, 0.5).expect("a motion");
    // released so that r v cancels F_1(t): no mean velocity, and the swing of 2/pi² stays between the walls
    let flight = Flight::launched(&motion, &Forcing::harmonic(&0.0), Side::Bottom, &1.0, -1e-300).expect("a flight");
    assert_eq!(flight.crossing(Watch::Both), Err(FlightError::Unending));
}

#[test]
fn a_second_derivative_passes_through_the_map() {
    // d²v/dv² of P1 by nested duals against a difference of first derivatives
    let forcing = Forcing::harmonic(&0.0);
    let motion = Motion::new(0.12201, 0.4, 0.5, 0.5).expect("a motion");
    let slope = |velocity: f64| {
        let impact = Impact {
            side: Side::Bottom,
            time: 0.156,
            velocity,
        };
        let leg = next_impact(&motion, &forcing, &impact).expect("a flight");
        Passage::new(&motion, &forcing, &impact, &leg.duration)
            .by_formula()
            .expect("no grazing")[(1, 1)]
    };
    let lift = |value: &f64| Dual::from_re(Dual::from_re(*value));
    let impact = Impact {
        side: Side::Bottom,
        time: lift(&0.156),
        velocity: Dual::new(seeded(0.83), Dual::from_re(1.0)),
    };
    let dual_motion = motion.convert(lift).expect("the same");
    let leg = next_impact(&dual_motion, &forcing.convert(lift), &impact).expect("a flight");
    let difference = (slope(0.83 + 1e-5) - slope(0.83 - 1e-5)) / 2e-5;
    assert!((leg.to.velocity.eps.eps - difference).abs() < 1e-8 * difference.abs().max(1.0));
}

#[test]
fn any_start_whatever_gives_an_answer_or_an_error_and_no_panic() {
    let awkward = [f64::NAN, f64::INFINITY, -0.0, 0.0, 1e-308, 1e-17, 1e17, 1e300, -1.0];
    let forcing = Forcing::harmonic(&0.0);
    let motion = Motion::new(0.12201, 0.26, 0.6, 0.3).expect("a motion");
    for side in [Side::Bottom, Side::Top] {
        for time in awkward {
            for velocity in awkward {
                let impact = Impact { side, time, velocity };
                if let Ok(leg) = next_impact(&motion, &forcing, &impact) {
                    assert!(leg.duration > 0.0 && leg.to.velocity.is_finite());
                }
            }
        }
    }
}
