//! The orbits that the paper prints are orbits of the map: velocities, phases, trace and determinant.

use dynamics::model::{Device, Forcing, Impact, Leg, Map, Motion, Pair, Passage, Side, next_impact};
use nalgebra::{Matrix2, Vector2};
use num_dual::DualNum;
use numbers::{Analytic, Field, Wide};

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
            let leg = map.apply_through(motion, &forcing, &from).expect("a leg of the cycle");
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
            let first = Map::P1.apply(&narrow, &forcing, &near(*phase, velocities[0])).ok()?;
            let second = Map::P2.apply(&narrow, &forcing, &first.to).ok()?;
            Some((first.to.velocity - velocities[1]).abs() + (second.to.velocity - velocities[0]).abs())
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
            let (v, t, g) = (leg.from.velocity.clone(), leg.duration.clone(), motion.g().clone());
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
        (26, 1.0, [0.701_713_431_4, -0.555_471_663_0, -0.120_467_944_8]),
        (25, 0.922_895, [0.689_791_804_6, -0.536_755_275_2, -0.124_511_561_2]),
    ];
    for (d, phase, velocities) in cases {
        let motion = motion::<f64>(6, d, 60, 30);
        // it attracts strongly: fly along first, then close it
        let forcing = Forcing::harmonic(&0.0);
        let mut impact = near::<f64>(phase, velocities[0]);
        for _ in 0..300 {
            impact = next_impact(&motion, &forcing, &impact).expect("a flight").to;
        }
        while impact.side != Side::Bottom {
            impact = next_impact(&motion, &forcing, &impact).expect("a flight").to;
        }
        let wide = motion_and(&impact, d);
        let legs = cycle(&wide.0, &[Map::P1, Map::P4, Map::P2], wide.1);
        for (leg, printed) in legs.iter().zip(velocities) {
            assert!(
                (leg.from.velocity.to_f64() - printed).abs() < 1e-10,
                "{printed} at d = {d}"
            );
        }
        assert!(d != 25 || ((legs[0].from.time.clone() * Digits::pi()).to_f64() - phase).abs() < 1e-6);
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
        for product in [pair.product(Passage::by_formula), pair.product(Passage::by_duals)] {
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
