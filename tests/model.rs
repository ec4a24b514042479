//! The motion against the equations it is said to obey, and against the orbits that the paper prints.

use nalgebra::{Matrix2, Vector2};
use num_dual::DualNum;
use proptest::prelude::*;
use std::f64::consts::TAU;
use vibro_audit::model::{
    Device, Flight, FlightError, Forcing, Impact, Leg, Map, Motion, Order, Pair, Passage, Side,
    Watch, next_impact,
};
use vibro_audit::number::{Analytic, Dual, Field, Wide, seeded};

type Digits = Wide<40>;

/// The paper's device at incline pi/`part`; A and omega are those that give its printed numbers.
fn gravity<T: Analytic>(part: i64) -> T {
    let device = Device {
        capsule_mass: T::from_ratio(1245, 10_000),
        forcing_amplitude: T::from_integer(5),
        angular_frequency: T::from_integer(5) * T::pi(),
        incline: T::pi() / T::from_integer(part),
        gravity: T::from_ratio(98, 10),
    };
    device.scales().expect("the paper's device").g
}

/// d and restitutions in hundredths, so that they are the same in every number.
fn motion<T: Analytic>(part: i64, d: i64, r_b: i64, r_t: i64) -> Motion<T> {
    let [d, r_b, r_t] = [d, r_b, r_t].map(|hundredths| T::from_ratio(hundredths, 100));
    Motion::new(gravity(part), d, r_b, r_t).expect("the paper's motion")
}

/// The cycle of `maps` that closes near `start`, by Newton's method with the derivative from dual numbers.
fn cycle<T: Analytic + DualNum>(motion: &Motion<T>, maps: &[Map], start: Impact<T>) -> Vec<Leg<T>> {
    let forcing = Forcing::harmonic(&T::zero());
    let mut start = start;
    for _ in 0..12 {
        let mut legs: Vec<Leg<T>> = Vec::new();
        let mut derivative = Matrix2::identity();
        for map in maps {
            let from = legs.last().map_or(&start, |leg| &leg.to).clone();
            let leg = map
                .apply_through(motion, &forcing, &from)
                .expect("a leg of the cycle");
            let passage = Passage::new(motion, &forcing, &from, &leg.duration);
            derivative = passage.by_duals().expect("no grazing") * derivative;
            legs.push(leg);
        }
        let end = &legs[legs.len() - 1].to;
        let late = end.time.clone() - start.time.clone();
        let late = late.clone() - T::from_integer((late.to_f64() / 2.0).round() as i64 * 2);
        let residual = Vector2::new(late, end.velocity.clone() - start.velocity.clone());
        if residual
            .iter()
            .all(|part| part.to_f64().abs() <= 16.0 * <T as Analytic>::epsilon().to_f64())
        {
            return legs;
        }
        let [a, b, c, d] = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|at| derivative[at].clone());
        let (a, d) = (a - T::one(), d - T::one());
        let determinant = a.clone() * d.clone() - b.clone() * c.clone();
        let (x, y) = (residual[0].clone(), residual[1].clone());
        start.time -= (d * x.clone() - b * y.clone()) / determinant.clone();
        start.velocity -= (a * y - c * x) / determinant;
    }
    panic!("Newton's method does not settle");
}

fn near<T: Analytic>(phase: f64, velocity: f64) -> Impact<T> {
    let time = T::from_f64(phase) / T::pi();
    Impact {
        side: Side::Bottom,
        time,
        velocity: T::from_f64(velocity),
    }
}

/// A printed 1-1 orbit: incline part, d, r_B, r_T in hundredths, phase, velocities, duration where known.
type Printed = ((i64, i64, i64, i64), f64, [f64; 2], Option<f64>);

const PRINTED: [Printed; 3] = [
    (
        (6, 26, 50, 50),
        0.148_112_68,
        [0.677_448_503_7, -0.514_768_503_7],
        Some(1.317_006_14),
    ),
    (
        (6, 40, 50, 50),
        0.489_395_114_7,
        [0.832_720_225_1, -0.670_040_225_1],
        Some(1.116_500_659_3),
    ),
    (
        (6, 33, 60, 30),
        1.213_872_912_7,
        [0.729_027_814_5, -0.709_557_310_2],
        Some(0.669_472_737_5),
    ),
];

#[test]
fn the_printed_orbits_are_fixed_points_of_the_map_to_their_last_figure() {
    for ((part, d, r_b, r_t), phase, velocities, duration) in PRINTED {
        let motion = motion::<Digits>(part, d, r_b, r_t);
        let legs = cycle(&motion, &[Map::P1, Map::P2], near(phase, velocities[0]));
        assert!(
            (legs[0].from.velocity.to_f64() - velocities[0]).abs() < 1e-10,
            "bottom at d = {d}"
        );
        assert!(
            (legs[0].to.velocity.to_f64() - velocities[1]).abs() < 1e-10,
            "top at d = {d}"
        );
        let found = (legs[0].from.time.clone() * Digits::pi()).to_f64();
        assert!((found - phase).abs() < 1e-8, "phase {found} at d = {d}");
        let found = legs[0].duration.to_f64();
        assert!(
            duration.is_none_or(|duration| (found - duration).abs() < 1e-8),
            "T_1 = {found} at d = {d}"
        );
    }
}

#[test]
fn the_orbits_printed_with_velocities_alone_are_fixed_points_too() {
    let cases = [
        ((6, 50, 60, 30), [0.886_872_082_6, -0.903_827_178_6]),
        ((3, 50, 60, 30), [0.947_189_536_0, -0.840_652_476_6]),
    ];
    for ((part, d, r_b, r_t), velocities) in cases {
        let motion = motion::<Digits>(part, d, r_b, r_t);
        // no phase is printed: it is looked for where the two maps give the printed velocities
        let narrow = self::motion::<f64>(part, d, r_b, r_t);
        let forcing = Forcing::harmonic(&0.0);
        let miss = |phase: &f64| {
            let first = Map::P1
                .apply(&narrow, &forcing, &near(*phase, velocities[0]))
                .ok()?;
            let second = Map::P2.apply(&narrow, &forcing, &first.to).ok()?;
            Some(
                (first.to.velocity - velocities[1]).abs()
                    + (second.to.velocity - velocities[0]).abs(),
            )
        };
        let key = |phase: &f64| miss(phase).unwrap_or(f64::INFINITY);
        let phases = (0..628).map(|step| f64::from(step) / 100.0);
        let phase = phases.min_by(|a, b| key(a).total_cmp(&key(b)));
        let legs = cycle(
            &motion,
            &[Map::P1, Map::P2],
            near(phase.expect("a phase"), velocities[0]),
        );
        assert!((legs[0].from.velocity.to_f64() - velocities[0]).abs() < 1e-10);
        assert!((legs[0].to.velocity.to_f64() - velocities[1]).abs() < 1e-10);
    }
}

#[test]
fn the_printed_orbits_satisfy_9_to_13_to_forty_digits() {
    for ((part, d, r_b, r_t), phase, velocities, _) in PRINTED {
        let motion = motion::<Digits>(part, d, r_b, r_t);
        let forcing = Forcing::harmonic(&Digits::from_f64(0.0));
        let legs = cycle(&motion, &[Map::P1, Map::P2], near(phase, velocities[0]));
        for (leg, wall) in legs.iter().zip([-motion.d().clone(), motion.d().clone()]) {
            let (start, end) = (forcing.at(&leg.from.time), forcing.at(&leg.to.time));
            let r = motion.restitution(leg.from.side).clone();
            let (v, t, g) = (
                leg.from.velocity.clone(),
                leg.duration.clone(),
                motion.g().clone(),
            );
            // (9), (11)
            let arrival = g.clone() * t.clone() - r.clone() * v.clone() + end.f1 - start.f1.clone();
            assert!((leg.to.velocity.clone() - arrival).to_f64().abs() < 1e-38);
            // (10), (12)
            let fall = g * t.clone() * t.clone() * Digits::from_ratio(1, 2) - r * v * t.clone();
            let reached = fall + end.f2 - start.f2 - start.f1 * t;
            assert!((reached - wall).to_f64().abs() < 1e-38);
        }
        // (13)
        let period = legs[0].duration.clone() + legs[1].duration.clone();
        assert!((period.to_f64() - 2.0).abs() < 1e-15);
        assert!(
            (legs[1].to.velocity.clone() - legs[0].from.velocity.clone())
                .to_f64()
                .abs()
                < 1e-38
        );
    }
}

#[test]
fn the_three_impact_orbit_of_fig_3_is_bottom_top_top() {
    let cases = [
        (
            26,
            1.0,
            [0.701_713_431_4, -0.555_471_663_0, -0.120_467_944_8],
        ),
        (
            25,
            0.922_895,
            [0.689_791_804_6, -0.536_755_275_2, -0.124_511_561_2],
        ),
    ];
    for (d, phase, velocities) in cases {
        let motion = motion::<f64>(6, d, 60, 30);
        // it attracts strongly: fly along first, then close it
        let forcing = Forcing::harmonic(&0.0);
        let mut impact = near::<f64>(phase, velocities[0]);
        for _ in 0..300 {
            impact = next_impact(&motion, &forcing, &impact)
                .expect("a flight")
                .to;
        }
        while impact.side != Side::Bottom {
            impact = next_impact(&motion, &forcing, &impact)
                .expect("a flight")
                .to;
        }
        let wide = motion_and(&impact, d);
        let legs = cycle(&wide.0, &[Map::P1, Map::P4, Map::P2], wide.1);
        for (leg, printed) in legs.iter().zip(velocities) {
            assert!(
                (leg.from.velocity.to_f64() - printed).abs() < 1e-10,
                "{printed} at d = {d}"
            );
        }
        assert!(
            d != 25 || ((legs[0].from.time.clone() * Digits::pi()).to_f64() - phase).abs() < 1e-6
        );
    }
}

fn motion_and(impact: &Impact<f64>, d: i64) -> (Motion<Digits>, Impact<Digits>) {
    let [time, velocity] = [impact.time, impact.velocity].map(Digits::from_f64);
    (
        motion(6, d, 60, 30),
        Impact {
            side: impact.side,
            time,
            velocity,
        },
    )
}

fn pair<T: Analytic>(motion: &Motion<T>, legs: &[Leg<T>]) -> Pair<T> {
    let forcing = Forcing::harmonic(&T::zero());
    let from = &legs[0].from;
    Pair::new(
        motion,
        &forcing,
        &from.time,
        &from.velocity,
        [&legs[0].duration, &legs[1].duration],
    )
}

#[test]
fn on_the_printed_orbits_trace_and_determinant_are_those_of_the_product() {
    for ((part, d, r_b, r_t), phase, velocities, _) in PRINTED {
        let motion = motion::<Digits>(part, d, r_b, r_t);
        let pair = pair(
            &motion,
            &cycle(&motion, &[Map::P1, Map::P2], near(phase, velocities[0])),
        );
        let trace = pair.trace_by_formula().expect("no grazing");
        let determinant = pair.determinant_by_formula().expect("no grazing");
        for product in [
            pair.product(Passage::by_formula),
            pair.product(Passage::by_duals),
        ] {
            let product = product.expect("no grazing");
            assert!(
                (product.trace() - trace.clone()).to_f64().abs() < 1e-36,
                "trace at d = {d}"
            );
            let found = product[(0, 0)].clone() * product[(1, 1)].clone();
            let found = found - product[(0, 1)].clone() * product[(1, 0)].clone();
            assert!(
                (found - determinant.clone()).to_f64().abs() < 1e-36,
                "determinant at d = {d}"
            );
        }
        // FACTS: on a 1-1 orbit the determinant is (r_B r_T)²
        let both = motion.restitution(Side::Bottom).clone() * motion.restitution(Side::Top).clone();
        assert!((determinant - both.clone() * both).to_f64().abs() < 1e-38);
        if d == 40 {
            assert!((trace.to_f64() + 0.371_267_776).abs() < 1e-9);
        }
    }
}

#[test]
fn an_orbit_found_in_f64_is_the_forty_digit_one_to_fifteen() {
    for ((part, d, r_b, r_t), phase, velocities, _) in PRINTED {
        let narrow = motion::<f64>(part, d, r_b, r_t);
        let found = cycle(&narrow, &[Map::P1, Map::P2], near(phase, velocities[0]));
        let exact = cycle(
            &motion::<Digits>(part, d, r_b, r_t),
            &[Map::P1, Map::P2],
            near(phase, velocities[0]),
        );
        for (found, exact) in found.iter().zip(&exact) {
            assert!((found.from.velocity - exact.from.velocity.to_f64()).abs() < 2e-15);
            assert!((found.duration - exact.duration.to_f64()).abs() < 1e-14);
        }
    }
}

/// A motion, a forcing of several harmonics and an impact with a clear velocity.
fn start() -> impl Strategy<Value = (Motion<f64>, Forcing<f64>, Impact<f64>)> {
    let motion = (-1.5..1.5_f64, 0.05..1.5_f64, 0.1..1.0_f64, 0.1..1.0_f64);
    let impact = (any::<bool>(), 0.0..2.0_f64, 0.1..1.5_f64);
    let forcing = prop_oneof![
        (0.0..TAU).prop_map(|phase| Forcing::harmonic(&phase)),
        (0.1..1.0_f64, -0.5..0.5_f64, -0.5..0.5_f64, -0.3..0.3_f64)
            .prop_filter_map("a forcing", |(a, b, c, d)| {
                Forcing::periodic(2.0, &[a, b], &[c, 0.0, d]).ok()
            }),
    ];
    (motion, forcing, impact).prop_filter_map(
        "a motion",
        |((g, d, r_b, r_t), forcing, (bottom, time, speed))| {
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
        },
    )
}

fn widened(
    motion: &Motion<f64>,
    forcing: &Forcing<f64>,
    impact: &Impact<f64>,
) -> (Motion<Digits>, Forcing<Digits>, Impact<Digits>) {
    let wide = |value: &f64| Digits::from_f64(*value);
    let motion = motion.convert(wide).expect("the same numbers");
    let Impact {
        side,
        time,
        velocity,
    } = impact;
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
        let other = next_impact(&motion.mirrored(), &forcing, &mirrored);
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

#[test]
fn without_gravity_and_drift_a_ball_floats_for_ever() {
    let motion = Motion::new(0.0, 2.0, 0.5, 0.5).expect("a motion");
    // released so that r v cancels F_1(t): no mean velocity, and the swing of 2/pi² stays between the walls
    let flight = Flight::launched(
        &motion,
        &Forcing::harmonic(&0.0),
        Side::Bottom,
        &1.0,
        -1e-300,
    )
    .expect("a flight");
    assert_eq!(flight.crossing(Watch::Both), Err(FlightError::Unending));
}

#[test]
fn a_second_derivative_passes_through_the_map() {
    // d²v/dv² of P1 by nested duals against a difference of first derivatives
    let forcing = Forcing::harmonic(&0.0);
    let motion = motion::<f64>(6, 40, 50, 50);
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
    let awkward = [
        f64::NAN,
        f64::INFINITY,
        -0.0,
        0.0,
        1e-308,
        1e-17,
        1e17,
        1e300,
        -1.0,
    ];
    let forcing = Forcing::harmonic(&0.0);
    let motion = motion::<f64>(6, 26, 60, 30);
    for side in [Side::Bottom, Side::Top] {
        for time in awkward {
            for velocity in awkward {
                let impact = Impact {
                    side,
                    time,
                    velocity,
                };
                if let Ok(leg) = next_impact(&motion, &forcing, &impact) {
                    assert!(leg.duration > 0.0 && leg.to.velocity.is_finite());
                }
            }
        }
    }
}
