//! Periodic motions of general words, against the model they never call: its flights, its maps, its many digits.

use dynamics::impact::{Simulation, Start};
use dynamics::model::{Forcing, Impact, Leg, Map, Motion, Order, Passage, Side, next_impact};
use dynamics::orbit::{Inconclusive, Orbit, OrbitOptions, Property, RoundedOrbit, Word, find, search_word};
use nalgebra::Matrix2;
use numbers::{Analytic, DoubleDouble, Field, Interval, Rung, Sequence, Wide};
use std::f64::consts::PI;
use std::sync::LazyLock;

type Digits = Wide<40>;
type Line = Interval<f64>;

/// g in hundred thousandths, d in thousandths, restitutions in hundredths, so that they are the same in every number.
#[derive(Clone, Copy, Debug)]
struct Case {
    g: i64,
    d: i64,
    r_b: i64,
    r_t: i64,
}

impl Case {
    fn motion<T: Analytic>(self) -> Motion<T> {
        let [d, r_b, r_t] = [(self.d, 1000), (self.r_b, 100), (self.r_t, 100)].map(|(n, of)| T::from_ratio(n, of));
        Motion::new(T::from_ratio(self.g, 100_000), d, r_b, r_t).expect("a motion")
    }

    /// Upside down: the walls exchanged, gravity reversed.
    fn mirrored(self) -> Self {
        Self {
            g: -self.g,
            d: self.d,
            r_b: self.r_t,
            r_t: self.r_b,
        }
    }

    fn orbits(self, word: &str, periods: u32) -> Vec<Orbit<f64>> {
        let motion = self.motion::<Line>();
        let cycles =
            search_word(&word.parse().expect("a word"), periods, &motion, &OrbitOptions::DEFAULT).expect("a search");
        assert!(cycles.iter().all(|cycle| cycle.is_certified()), "{self:?} {word}");
        cycles
            .iter()
            .filter_map(|cycle| settled(cycle.orbit(&motion)))
            .collect()
    }

    fn rows(self, word: &str, periods: u32) -> Vec<RoundedOrbit> {
        self.orbits(word, periods).iter().map(Orbit::rounded).collect()
    }
}

/// An orbit that f64 can tell all about; the few that need a wider number are not what is tested here.
fn settled(orbit: Result<Orbit<f64>, Inconclusive>) -> Option<Orbit<f64>> {
    match orbit {
        Err(Inconclusive::Undecided { .. } | Inconclusive::Backwards { .. }) => None,
        orbit => Some(orbit.expect("an orbit")),
    }
}

/// The paper's device at pi/6.
fn paper(d: i64, r_b: i64, r_t: i64) -> Case {
    let g = 12_201;
    Case { g, d, r_b, r_t }
}

const WORDS: [(&str, u32); 8] = [
    ("B", 1),
    ("BT", 1),
    ("BT", 2),
    ("BTT", 1),
    ("BBT", 1),
    ("BTBT", 2),
    ("BTT", 2),
    ("BTBTT", 2),
];

/// Cases of all kinds, with the orbits of each word.
static GALLERY: LazyLock<Vec<(Case, RoundedOrbit)>> = LazyLock::new(gallery);

fn gallery() -> Vec<(Case, RoundedOrbit)> {
    let mut sequence = Sequence::new(11);
    let mut draw = |low: f64, high: f64| sequence.between(low, high) as i64;
    let mut found = Vec::new();
    for _ in 0..6 {
        let case = Case {
            g: draw(-60_000.0, 110_000.0),
            d: draw(50.0, 600.0),
            r_b: draw(20.0, 95.0),
            r_t: draw(20.0, 95.0),
        };
        for (word, periods) in WORDS {
            found.extend(case.rows(word, periods).into_iter().map(|row| (case, row)));
        }
    }
    found
}

fn impact<T: Analytic>(row: &RoundedOrbit, index: usize) -> Impact<T> {
    let side = row.word.sides().nth(index).expect("an impact");
    let time = T::from_f64(row.phases[index]) / T::pi();
    let velocity = T::from_f64(row.velocities[index]);
    Impact { side, time, velocity }
}

fn passages(case: Case, row: &RoundedOrbit) -> Vec<Passage<f64>> {
    let (motion, forcing) = (case.motion(), Forcing::harmonic(&0.0));
    let passage = |index| Passage::new(&motion, &forcing, &impact(row, index), &row.times[index]);
    (0..row.phases.len()).map(passage).collect()
}

#[test]
fn the_three_impact_orbits_of_fig_3_are_those_of_many_digits() {
    // FACTS: by a program with 40 digits that shares nothing with this one
    let known = [
        (260, None, [0.701_713_431_4, -0.555_471_663_0, -0.120_467_944_8]),
        (
            250,
            Some(0.922_895),
            [0.689_791_804_6, -0.536_755_275_2, -0.124_511_561_2],
        ),
    ];
    for (d, phase, velocities) in known {
        let rows = paper(d, 60, 30).rows("BTT", 1);
        assert_eq!(rows.len(), 1);
        let row = &rows[0];
        let pairs = row.velocities.iter().zip(velocities);
        assert!(
            pairs.into_iter().all(|(found, known)| (found - known).abs() < 1e-10),
            "{row:?}"
        );
        assert!(
            phase.is_none_or(|phase: f64| (row.phases[0] - phase).abs() < 1e-6),
            "{row:?}"
        );
        assert!(row.stable && row.admissible && row.clearance > 0.01);
    }
}

#[test]
fn the_printed_pairs_are_orbits_of_the_word_bt() {
    let known = [
        (
            paper(260, 50, 50),
            [0.677_448_503_7, -0.514_768_503_7],
            0.148_112_68,
            1.317_006_14,
        ),
        (
            paper(400, 50, 50),
            [0.832_720_225_1, -0.670_040_225_1],
            0.489_395_114_7,
            1.116_500_659_3,
        ),
        (
            paper(330, 60, 30),
            [0.729_027_814_5, -0.709_557_310_2],
            1.213_872_912_7,
            0.669_472_737_5,
        ),
    ];
    for (case, velocities, phase, time) in known {
        let rows = case.rows("BT", 1);
        let is_known = |row: &&RoundedOrbit| (row.velocities[0] - velocities[0]).abs() < 1e-9;
        let row = rows.iter().find(is_known).expect("the printed orbit");
        assert!((row.velocities[1] - velocities[1]).abs() < 1e-10 && (row.times[0] - time).abs() < 1e-8);
        assert!((row.phases[0] - phase).abs() < 1e-8 && row.stable && row.admissible);
    }
}

#[test]
fn an_orbit_that_passes_through_the_top_says_so() {
    // FACTS: where it doubles its period the 1-1 orbit has already passed the wall, which it grazes at d = .26122
    let below = paper(259, 60, 30).rows("BT", 1);
    assert!(below.len() == 1 && !below[0].admissible && below[0].clearance < 0.0);
    let above = paper(262, 60, 30).rows("BT", 1);
    assert!(above.len() == 1 && above[0].admissible && above[0].clearance > 0.0);
}

#[test]
fn every_orbit_satisfies_9_to_13_in_forty_digits_within_its_bound() {
    assert!(GALLERY.len() > 30, "{}", GALLERY.len());
    for (case, row) in GALLERY.iter() {
        let bound = row.error_bound.expect("certified");
        let exact = improved(*case, row);
        let printed = [&row.phases, &row.velocities, &row.times];
        for (printed, exact) in printed.iter().zip(&exact) {
            for (printed, exact) in printed.iter().zip(exact) {
                let apart = (Digits::from_f64(*printed) - exact.clone()).to_f64().abs();
                assert!(
                    apart <= bound,
                    "{printed} is off by {apart:e}, bound {bound:e}: {case:?}"
                );
            }
        }
    }
}

/// Phases, velocities and times in 40 digits: Newton's method on (9) to (13) with all of them as unknowns, from the
/// printed values. Written here from the paper, so that the equations of the search are checked by others.
fn improved(case: Case, row: &RoundedOrbit) -> [Vec<Digits>; 3] {
    let count = row.phases.len();
    let motion = case.motion::<Digits>();
    let wide = |values: &[f64]| values.iter().map(|value| Digits::from_f64(*value)).collect::<Vec<_>>();
    let mut unknowns = [wide(&row.velocities), wide(&row.times), wide(&row.phases[..1])].concat();
    let equations = |unknowns: &[Digits]| equations(&motion, row, unknowns);
    let derivative = nalgebra::DMatrix::from_fn(2 * count + 1, 2 * count + 1, |equation, unknown| {
        // differences in 40 digits: twenty of them are left
        let step = Digits::from_f64(1e-20);
        let mut moved = unknowns.clone();
        moved[unknown] += step.clone();
        ((equations(&moved)[equation].clone() - equations(&unknowns)[equation].clone()) / step).to_f64()
    });
    let inverse = derivative.try_inverse().expect("an isolated orbit");
    for _ in 0..6 {
        let residuals = equations(&unknowns);
        for (unknown, value) in unknowns.iter_mut().enumerate() {
            for (equation, residual) in residuals.iter().enumerate() {
                *value -= Digits::from_f64(inverse[(unknown, equation)]) * residual.clone();
            }
        }
    }
    assert!(
        equations(&unknowns)
            .iter()
            .all(|residual| residual.to_f64().abs() < 1e-33)
    );
    let (velocities, times) = (unknowns[..count].to_vec(), unknowns[count..2 * count].to_vec());
    let turn = Digits::from_integer(2) * Digits::pi();
    let mut phase = unknowns[2 * count].clone();
    let phases = (0..count).map(|index| {
        let turns = ((phase.to_f64() - row.phases[index]) / turn.to_f64()).round() as i64;
        let reduced = phase.clone() - Digits::from_integer(turns) * turn.clone();
        phase += Digits::pi() * times[index].clone();
        reduced
    });
    [phases.collect(), velocities, times]
}

/// (9), (11) and (10), (12) of each flight, and (13): velocities, then times, then the first phase.
fn equations(motion: &Motion<Digits>, row: &RoundedOrbit, unknowns: &[Digits]) -> Vec<Digits> {
    let count = row.phases.len();
    let (velocities, times) = (&unknowns[..count], &unknowns[count..2 * count]);
    let forcing = Forcing::harmonic(&Digits::from_f64(0.0));
    let mut time = unknowns[2 * count].clone() / Digits::pi();
    let mut equations = Vec::new();
    for (index, map) in row.word.flights().enumerate() {
        let end_time = time.clone() + times[index].clone();
        let (start, end) = (forcing.at(&time), forcing.at(&end_time));
        let launch = -(motion.restitution(map.from()).clone() * velocities[index].clone());
        let (t, g) = (times[index].clone(), motion.g().clone());
        let arrival = g.clone() * t.clone() + launch.clone() + end.f1 - start.f1.clone();
        equations.push(arrival - velocities[(index + 1) % count].clone());
        let fall = g * t.clone() * t.clone() * Digits::from_ratio(1, 2) + launch * t.clone();
        let climb = match map {
            Map::P1 => -motion.d().clone(),
            Map::P2 => motion.d().clone(),
            Map::P3 | Map::P4 => Digits::from_f64(0.0),
        };
        equations.push(fall + end.f2 - start.f2 - start.f1 * t - climb);
        time = end_time;
    }
    let whole = times.iter().fold(Digits::from_f64(0.0), |sum, time| sum + time.clone());
    equations.push(whole - Digits::from_integer(2 * i64::from(row.periods)));
    equations
}

#[test]
fn trace_and_determinant_are_those_of_the_maps_by_duals_and_by_differences() {
    for (case, row) in GALLERY.iter() {
        let passages = passages(*case, row);
        let product = |means: &dyn Fn(&Passage<f64>) -> Option<Matrix2<f64>>| {
            let start = Some(Matrix2::identity());
            passages
                .iter()
                .fold(start, |product, passage| Some(means(passage)? * product?))
        };
        let duals = product(&|passage| passage.by_duals().ok()).expect("no grazing");
        // a velocity near 0 makes both large, and divides the rounding of the point
        let size = 1.0 + duals.abs().max();
        assert!((duals.trace() - row.trace).abs() < 1e-9 * size, "{case:?} {row:?}");
        let by_hand: f64 = row.word.sides().map(|side| restitution(*case, side).powi(2)).product();
        assert!((row.determinant - by_hand).abs() < 1e-14);
        assert!(size > 1e3 || (duals.determinant() - by_hand).abs() < 1e-9);
        if let Some(differences) = product(&|passage| passage.by_differences(Order::Four).ok()) {
            assert!(
                (differences.trace() - row.trace).abs() < 1e-5 * size,
                "{case:?} {row:?}"
            );
        }
    }
}

fn restitution(case: Case, side: Side) -> f64 {
    *case.motion::<f64>().restitution(side)
}

#[test]
fn the_multipliers_tell_the_kind() {
    for (_, row) in GALLERY.iter() {
        let [one, other] = &row.multipliers;
        let size = one.re.hypot(one.im);
        assert_eq!(row.stable, size < 1.0 && other.re.hypot(other.im) < 1.0);
        assert!((one.re + other.re - row.trace).abs() <= 1e-14 * (1.0 + size));
        assert!((one.re * other.re - one.im * other.im - row.determinant).abs() <= 1e-14 * (1.0 + size));
    }
}

#[test]
fn the_mirrored_motion_has_the_mirrored_orbits() {
    for case in [paper(250, 60, 30), paper(200, 30, 60)] {
        for (word, periods) in [("BT", 1), ("BTT", 1), ("B", 1), ("BT", 2)] {
            let rows = case.rows(word, periods);
            let mirrored = word.parse::<Word>().expect("a word").mirrored().to_string();
            let images = case.mirrored().rows(&mirrored, periods);
            assert_eq!(rows.len(), images.len(), "{case:?} {word}");
            for row in &rows {
                // impacts in another order: as sets
                let near = |image: &RoundedOrbit| {
                    let same = (image.trace - row.trace).abs() < 1e-9 * (1.0 + row.trace.abs());
                    let velocities = row.velocities.iter().zip(&row.phases).all(|(velocity, phase)| {
                        let impacts = image.velocities.iter().zip(&image.phases);
                        impacts.into_iter().any(|(other, later)| {
                            let half = (later - phase - std::f64::consts::PI).rem_euclid(std::f64::consts::TAU);
                            (velocity + other).abs() < 1e-10 && half.sin().abs() < 1e-9 && half.cos() > 0.0
                        })
                    });
                    let clearance = image.clearance == row.clearance || (image.clearance - row.clearance).abs() < 1e-10;
                    same && velocities && clearance && image.kind == row.kind
                };
                assert!(images.iter().any(near), "{row:?} {images:?}");
            }
        }
    }
}

#[test]
fn the_simulated_ball_follows_an_admissible_orbit_and_leaves_an_inadmissible_one() {
    let (mut followed, mut left) = (0, 0);
    for (case, row) in GALLERY.iter() {
        let (motion, forcing) = (case.motion::<f64>(), Forcing::harmonic(&0.0));
        // impact by impact, each from the orbit itself: an unstable orbit would be left after a round
        let arrives = |index: usize| {
            let next = (index + 1) % row.phases.len();
            let Ok(Leg { to, duration, .. }) = next_impact(&motion, &forcing, &impact(row, index)) else {
                return false;
            };
            // the rounding of the start, divided by the velocity of arrival
            let near = 1e-12 / row.velocities[next].abs();
            let wanted = impact::<f64>(row, next);
            to.side == wanted.side
                && (to.velocity - wanted.velocity).abs() < near
                && (duration - row.times[index]).abs() < near
        };
        let all = (0..row.phases.len()).all(arrives);
        assert_eq!(all, row.admissible, "{case:?} {row:?}");
        followed += i32::from(all);
        left += i32::from(!all);
    }
    assert!(followed > 5 && left > 5, "{followed} {left}");
}

#[test]
fn in_double_double_the_bound_is_the_rounding_of_what_is_printed_and_in_many_digits_it_is_the_same_orbit() {
    for (case, word, periods) in [
        (paper(260, 60, 30), "BTT", 1),
        (paper(250, 60, 30), "BTBT", 2),
        (paper(440, 60, 30), "BT", 2),
    ] {
        let word: Word = word.parse().expect("a word");
        let cycles = search_word(
            &word,
            periods,
            &case.motion::<Interval<DoubleDouble>>(),
            &OrbitOptions::DEFAULT,
        )
        .expect("a search");
        assert!(!cycles.is_empty());
        for cycle in &cycles {
            let narrow = cycle.orbit(&case.motion::<Line>()).expect("decided");
            let double = cycle.orbit(&case.motion::<Interval<DoubleDouble>>()).expect("decided");
            let wide = cycle.orbit(&case.motion::<Interval<Wide<50>>>()).expect("decided");
            let row = double.rounded();
            let largest = row.phases.iter().fold(1.0_f64, |largest, phase| largest.max(*phase));
            let bound = row.error_bound.expect("certified");
            assert!(
                bound <= 0.5 * f64::EPSILON * 4.0 && bound <= f64::EPSILON * largest,
                "{bound:e}"
            );
            assert_eq!(
                row,
                RoundedOrbit {
                    error_bound: Some(bound),
                    computed_in: Rung::DoubleDouble,
                    ..wide.rounded()
                }
            );
            let digits = |orbit: &Orbit<Wide<50>>| orbit.velocities.iter().all(|value| value.width().to_f64() < 1e-47);
            assert!(digits(&wide), "{wide:?}");
            for (one, other) in narrow.velocities.iter().zip(&wide.velocities) {
                assert!(Wide::from_f64(one.low()) < other.low() && other.high() < Wide::from_f64(one.high()));
            }
        }
    }
}

#[test]
fn what_f64_cannot_tell_a_wider_number_can() {
    // FACTS: to 17 digits the period doubling of the 1-1 orbit; f64 is left with node or saddle
    let motion = |d: &str| {
        let d = Wide::<50>::parse(d).expect("a number");
        let [g, r_b, r_t] = [(12_201, 100_000), (3, 5), (3, 10)].map(|(n, of)| Interval::from_ratio(n, of));
        Motion::new(g, Interval::point(d), r_b, r_t).expect("a motion")
    };
    let near = motion("0.25905782991527197");
    let cycles = search_word(&Word::pair(), 1, &near, &OrbitOptions::DEFAULT).expect("a search");
    assert_eq!(cycles.len(), 1);
    let line = near.convert(|value| Line::new(value.low().to_f64().next_down(), value.high().to_f64().next_up()));
    let undecided = cycles[0].orbit(&line.expect("a motion"));
    let what = Property::Kind;
    assert_eq!(undecided, Err(Inconclusive::Undecided { what }));
    let orbit = cycles[0].orbit(&near).expect("decided");
    assert!((orbit.trace.to_f64() + 1.0 + orbit.determinant.to_f64()).abs() < 1e-12);
}

#[test]
fn figures_of_a_motion_without_a_proof_hold_however_short_its_flights_are() {
    for r_t in [1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
        let motion = Motion::new(0.1, 0.26, 0.6, r_t).expect("a motion");
        let found = find(&motion, &"BTT".parse().expect("a word"), 1).expect("a search");
        let [row] = &found.orbits[..] else {
            panic!("{r_t}: {:?}", found.orbits)
        };
        // the hop at the top, to first order in its speed
        let close = |one: f64, other: f64| (one / other - 1.0).abs() < 1e-4;
        let launch = r_t * row.velocities[1].abs();
        let push = (row.phases[1].cos() + motion.g()).abs();
        assert!(close(row.velocities[2], -launch), "{row:?}");
        assert!(close(row.times[1], 2.0 * launch / push), "{row:?}");
        assert!(
            close(row.phases[2] - row.phases[1], PI * row.times[1]) || r_t < 1e-8,
            "{row:?}"
        );
        // and the flight before, by the laws (3) and (4)
        let wide = motion.convert(|value| Digits::from_f64(*value)).expect("a motion");
        let start = Start::impact(Side::Bottom, row.phases[0], row.velocities[0]);
        let start = start.convert(|value| Digits::from_f64(*value));
        let top = Simulation::new(&wide, &start)
            .nth(1)
            .expect("an impact")
            .convert(Analytic::to_f64);
        assert!(
            close(top.velocity, row.velocities[1]) && close(top.phase, row.phases[1]),
            "{top:?} {row:?}"
        );
    }
}
