//! Periodic motions under forcings with harmonics, on one wall and after plastic impacts, against a return map that is
//! written down here in 60 digits and shares no equation with the library.

use dynamics::model::{Forcing, Motion, Side};
use dynamics::orbit::{
    BifurcationKind, BifurcationPoint, Cover, CoverError, OneOneBranches, OrbitOptions, RoundedOrbit, Word,
    WordBranches, find, is_covered, isolate_one_one,
};
use numbers::{Analytic, Interval, Sequence, Wide};
use std::f64::consts::{PI, TAU};

type Digits = Wide<60>;

fn digits(value: f64) -> Digits {
    Digits::from_f64(value)
}

/// A motion by its numbers: g, d, r_B, r_T, and the amplitudes of cos(n pi t) and sin(n pi t), n = 1, 2, ...
#[derive(Clone, Debug)]
struct Device {
    parameters: [f64; 4],
    cosines: Vec<f64>,
    sines: Vec<f64>,
}

impl Device {
    fn random(sequence: &mut Sequence) -> Self {
        let parameters =
            [(-0.4, 0.4), (0.1, 0.6), (0.2, 0.9), (0.2, 0.9)].map(|(low, high)| sequence.between(low, high));
        let mut amplitudes = |count: usize| {
            (0..count)
                .map(|n| sequence.between(-1.0, 1.0) / (n + 1) as f64)
                .collect()
        };
        let (cosines, sines) = (amplitudes(3), amplitudes(4));
        Self {
            parameters,
            cosines,
            sines,
        }
    }

    fn with_d(&self, d: f64) -> Self {
        let [g, _, r_b, r_t] = self.parameters;
        Self {
            parameters: [g, d, r_b, r_t],
            ..self.clone()
        }
    }

    fn motion(&self) -> Motion<f64> {
        let [g, d, r_b, r_t] = self.parameters;
        let forcing = Forcing::periodic(2.0, &self.cosines, &self.sines).expect("a forcing");
        let motion = Motion::new(g, d, r_b, r_t).expect("a motion");
        motion.with_forcing(forcing).expect("of period 2")
    }

    /// [f, F_1, F_2] at a time, term by term.
    fn forced<T: Analytic>(&self, time: &T) -> [T; 3] {
        let mut sums = [T::zero(), T::zero(), T::zero()];
        for n in 0..self.cosines.len().max(self.sines.len()) {
            let rate = T::from_integer(n as i64 + 1) * T::pi();
            let (sin, cos) = (rate.clone() * time.clone()).sincos();
            let amplitude = |list: &[f64]| T::from_f64(list.get(n).copied().unwrap_or(0.0));
            let [a, b] = [&self.cosines, &self.sines].map(|list| amplitude(list));
            let along = a.clone() * cos.clone() + b.clone() * sin.clone();
            sums[0] += along.clone();
            sums[1] += (a * sin - b * cos) / rate.clone();
            sums[2] -= along / (rate.clone() * rate);
        }
        sums
    }

    fn restitution(&self, side: Side) -> Digits {
        digits(self.parameters[if side == Side::Bottom { 2 } else { 3 }])
    }

    /// Z less its value at the start, and the velocity, a time after a launch.
    fn moved<T: Analytic>(&self, start: &T, launch: &T, after: &T) -> [T; 2] {
        let ([_, f1, f2], [_, g1, g2]) = (self.forced(start), self.forced(&(start.clone() + after.clone())));
        let gained = T::from_f64(self.parameters[0]) * after.clone();
        let fallen = gained.clone() * after.clone() * T::from_ratio(1, 2);
        let path = launch.clone() * after.clone() + fallen + g2 - f2 - f1.clone() * after.clone();
        [path, launch.clone() + gained + g1 - f1]
    }

    fn climb(&self, from: Side, to: Side) -> Digits {
        match (from, to) {
            (Side::Bottom, Side::Top) => -digits(self.parameters[1]),
            (Side::Top, Side::Bottom) => digits(self.parameters[1]),
            _ => digits(0.0),
        }
    }

    /// The time and the velocity of the first impact again after a lap from [time, velocity], each flight near a known
    /// duration; and all impacts on the way.
    fn lap(&self, word: &Word, start: [Digits; 2], durations: &[f64]) -> ([Digits; 2], Vec<[Digits; 2]>) {
        let sides: Vec<Side> = word.sides().collect();
        let [mut time, mut velocity] = start;
        let mut impacts = Vec::new();
        for (index, duration) in durations.iter().enumerate() {
            impacts.push([time.clone(), velocity.clone()]);
            let (from, to) = (sides[index], sides[(index + 1) % sides.len()]);
            let launch = -self.restitution(from) * velocity.clone();
            let mut after = digits(*duration);
            for _ in 0..8 {
                let [path, speed] = self.moved(&time, &launch, &after);
                after -= (path - self.climb(from, to)) / speed;
            }
            velocity = self.moved(&time, &launch, &after)[1].clone();
            time += after;
        }
        ([time, velocity], impacts)
    }

    /// Trace and determinant of the derivative of a lap, by central differences of 1e-20.
    fn derivative(&self, word: &Word, start: &[Digits; 2], durations: &[f64]) -> [Digits; 2] {
        let step = digits(1e-20);
        let column = |which: usize| {
            let ends = [step.clone(), -step.clone()].map(|step| {
                let mut moved = start.clone();
                moved[which] += step;
                self.lap(word, moved, durations).0
            });
            let [above, below] = ends;
            [0, 1].map(|i| (above[i].clone() - below[i].clone()) / (step.clone() + step.clone()))
        };
        let ([a, c], [b, d]) = (column(0), column(1));
        [a.clone() + d.clone(), a * d - b * c]
    }

    /// The least distance from a wall at the extrema of 4000 samples of each flight; infinite where there is none.
    fn sampled_clearance(&self, orbit: &RoundedOrbit) -> f64 {
        let has_top = self.parameters[1] > 0.0;
        let mut least = f64::INFINITY;
        for ((side, phase), (velocity, time)) in orbit
            .word
            .sides()
            .zip(&orbit.phases)
            .zip(orbit.velocities.iter().zip(&orbit.times))
        {
            let (start, launch) = (phase / PI, -self.restitution(side).to_f64() * velocity);
            let at = |step: usize| time * step as f64 / 4000.0;
            let states: Vec<[f64; 2]> = (0..=4000).map(|step| self.moved(&start, &launch, &at(step))).collect();
            for pair in states.windows(2).filter(|pair| pair[0][1] * pair[1][1] < 0.0) {
                let inwards = -side.sign() * 0.5 * (pair[0][0] + pair[1][0]);
                least = least.min(inwards);
                if has_top {
                    least = least.min(self.parameters[1] - inwards);
                }
            }
        }
        least
    }

    /// Holds an orbit against the return map: that it closes, its impacts, trace, determinant, stability and clearance.
    fn check(&self, orbit: &RoundedOrbit) {
        let bound = orbit.error_bound.expect("a proof");
        let start = [digits(orbit.phases[0] / PI), digits(orbit.velocities[0])];
        let ([time, velocity], impacts) = self.lap(&orbit.word, start.clone(), &orbit.times);
        let [trace, determinant] = self
            .derivative(&orbit.word, &start, &orbit.times)
            .map(|value| value.to_f64());
        let room = (bound + 1e-14) * (1.0 + trace.abs()) * 1e3;
        let late = (time - start[0].clone()).to_f64() - 2.0 * f64::from(orbit.periods);
        assert!(
            late.abs() < room && (velocity.to_f64() - orbit.velocities[0]).abs() < room,
            "{self:?} {orbit:?}"
        );
        for ([time, velocity], (phase, speed)) in impacts.iter().zip(orbit.phases.iter().zip(&orbit.velocities)) {
            let turned = (time.to_f64() * PI - phase + PI).rem_euclid(TAU) - PI;
            assert!(
                turned.abs() < room && (velocity.to_f64() - speed).abs() < room,
                "{self:?} {orbit:?}"
            );
        }
        assert!(
            (trace - orbit.trace).abs() < room * 1e2 * (1.0 + trace.abs()),
            "{trace} {orbit:?}"
        );
        assert!(
            (determinant - orbit.determinant).abs() < 1e-12 + room,
            "{determinant} {orbit:?}"
        );
        assert_eq!(
            orbit.stable,
            orbit.trace.abs() < 1.0 + orbit.determinant && orbit.determinant < 1.0
        );
        let clearance = self.sampled_clearance(orbit);
        assert!(
            clearance == orbit.clearance || (clearance - orbit.clearance).abs() < 1e-5,
            "{clearance} {orbit:?} {self:?}"
        );
        assert_eq!(orbit.admissible, orbit.clearance > 0.0);
    }
}

fn word(text: &str) -> Word {
    text.parse().expect("a word")
}

#[test]
fn orbits_under_harmonics_are_fixed_points_of_a_return_map_in_60_digits() {
    let mut sequence = Sequence::new(49);
    let (mut admissible, mut beyond, mut stable) = (0, 0, 0);
    for _ in 0..10 {
        let device = Device::random(&mut sequence);
        for text in ["BT", "B", "BTT", "BBT"] {
            let found = find(&device.motion(), &word(text), 1).expect("a search");
            assert!(!found.is_complete(&word(text), 1));
            for orbit in &found.orbits {
                device.check(orbit);
                admissible += usize::from(orbit.admissible);
                beyond += usize::from(!orbit.admissible);
                stable += usize::from(orbit.stable);
            }
        }
    }
    assert!(
        admissible > 10 && beyond > 1 && stable > 3,
        "{admissible} {beyond} {stable}"
    );
}

#[test]
fn one_cosine_given_as_a_forcing_has_the_orbits_of_the_complete_search_and_claims_less() {
    for d in [0.2, 0.3, 0.45] {
        let plain = Motion::new(0.12201, d, 0.6, 0.3).expect("a motion");
        let forcing = Forcing::periodic(2.0, &[1.0], &[]).expect("a forcing");
        let given = plain.clone().with_forcing(forcing).expect("of period 2");
        let [all, by_words] = [&plain, &given].map(|motion| find(motion, &Word::pair(), 2).expect("a search"));
        assert!(all.is_complete(&Word::pair(), 1) && !by_words.is_complete(&Word::pair(), 1));
        assert!(is_covered(&plain, &Word::pair()) && !is_covered(&given, &Word::pair()));
        assert_eq!(all.orbits.len(), by_words.orbits.len());
        for (one, other) in all.orbits.iter().zip(&by_words.orbits) {
            let lists = [(&one.phases, &other.phases), (&one.velocities, &other.velocities)];
            let mut pairs = lists.into_iter().flat_map(|(one, other)| one.iter().zip(other));
            assert!(pairs.all(|(one, other)| (one - other).abs() < 1e-14));
            let [one_clear, other_clear] = [one, other].map(|orbit| orbit.clearance);
            assert!(one_clear == other_clear || (one_clear - other_clear).abs() < 1e-14);
            assert!(one.kind == other.kind && one.admissible == other.admissible);
        }
    }
}

#[test]
fn no_cover_is_claimed_under_another_forcing() {
    let device = Device::random(&mut Sequence::new(1));
    let motion = device.motion();
    let range = Interval::new(0.2, 0.3);
    let options = &OrbitOptions::DEFAULT;
    assert_eq!(
        Cover::new(&motion, 1, range, options).err(),
        Some(CoverError::Uncovered)
    );
    assert!(matches!(
        OneOneBranches::new(&motion, 1, range, options),
        Err(CoverError::Uncovered)
    ));
    let search = isolate_one_one(
        &motion.convert(|value| Interval::point(*value)).expect("a motion"),
        1,
        options,
    );
    assert!(!search.isolation.is_complete() && search.motions.is_empty());
}

/// The part by which a multiplier condition fails at a bifurcation, in 60 digits.
fn excess(device: &Device, event: &BifurcationPoint) -> f64 {
    let start = [digits(event.phases[0] / PI), digits(event.velocities[0])];
    let [trace, determinant] = device
        .derivative(&event.word, &start, &event.times)
        .map(|value| value.to_f64());
    match event.kind {
        BifurcationKind::PeriodDoubling => trace + 1.0 + determinant,
        BifurcationKind::Fold | BifurcationKind::SymmetryBreaking => trace - 1.0 - determinant,
        BifurcationKind::NodeFocus => trace * trace - 4.0 * determinant,
        BifurcationKind::Grazing => 0.0,
    }
}

#[test]
fn bifurcations_under_harmonics_are_where_the_return_map_has_them() {
    let mut sequence = Sequence::new(7);
    let mut kinds = std::collections::BTreeMap::new();
    for _ in 0..4 {
        let device = Device::random(&mut sequence);
        for text in ["BT", "BTT"] {
            let branches = WordBranches::new(
                device.motion(),
                &word(text),
                1,
                Interval::new(0.1, 0.6),
                &OrbitOptions::DEFAULT,
            );
            let branches = branches.expect("branches");
            assert_eq!(branches.branches().1, 0, "{device:?} {text}");
            for event in branches.bifurcations() {
                // a motion of a shorter word twice is where the period of that doubles
                if event.error_bound.is_none() || event.kind == BifurcationKind::PeriodDoubling && event.trace > 0.0 {
                    continue;
                }
                let excess = excess(&device.with_d(event.parameter), &event);
                assert!(excess.abs() < 1e-9, "{excess:e} {event:?}");
                *kinds.entry(event.kind).or_insert(0) += 1;
            }
        }
    }
    use BifurcationKind::{Fold, Grazing, NodeFocus, PeriodDoubling};
    assert!(
        [Fold, Grazing, NodeFocus, PeriodDoubling]
            .iter()
            .all(|kind| kinds.contains_key(kind)),
        "{kinds:?}"
    );
}
