//! The 1-1 orbits of motions of all kinds: what each must satisfy, and that none is missed or invented.

use crate::motions;

use dynamics::model::{Flight, Forcing, Impact, Motion, Passage, Side, next_impact};
use dynamics::orbit::{FoundOrbits, OneOneEquations, OrbitKind, RoundedOrbit, SearchLimits, Word, find, isolate};
use motions::{Digits, Pair, improved, is_near, motion_of, planted, scanned, scenes};
use nalgebra::Matrix2;
use numbers::{Analytic, DoubleDouble, Dual, Field, Interval, Sequence, seeded};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

/// A motion, the most periods, and all its orbits.
struct Case {
    motion: Motion<f64>,
    periods: u32,
    found: FoundOrbits,
}

impl Case {
    fn new((motion, periods): (Motion<f64>, u32)) -> Self {
        let found = find(&motion, &Word::pair(), periods).expect("a search");
        Self { motion, periods, found }
    }

    fn of(&self, periods: u32) -> impl Iterator<Item = &RoundedOrbit> {
        self.found.orbits.iter().filter(move |row| row.periods == periods)
    }
}

static GALLERY: LazyLock<Vec<Case>> = LazyLock::new(|| scenes(1).take(150).map(Case::new).collect());

/// Every orbit of the gallery with its motion.
fn gallery() -> impl Iterator<Item = (&'static Motion<f64>, &'static RoundedOrbit)> {
    GALLERY
        .iter()
        .flat_map(|case| case.found.orbits.iter().map(move |row| (&case.motion, row)))
}

#[test]
fn the_gallery_has_orbits_of_all_kinds_and_nothing_open() {
    let count = |is: fn(&Motion<f64>, &RoundedOrbit) -> bool| gallery().filter(|(motion, row)| is(motion, row)).count();
    for (name, number) in [
        ("admissible", count(|_, row| row.admissible)),
        ("inadmissible", count(|_, row| !row.admissible)),
        ("stable", count(|_, row| row.stable)),
        ("focus", count(|_, row| row.kind == OrbitKind::Focus)),
        ("node", count(|_, row| row.kind == OrbitKind::Node)),
        ("saddle", count(|_, row| row.kind == OrbitKind::Saddle)),
        ("of three periods", count(|_, row| row.periods == 3)),
        ("weightless", count(|motion, _| *motion.g() == 0.0)),
        ("heavy", count(|motion, _| motion.g().abs() > 1.0)),
        (
            "elastic",
            count(|motion, row| row.determinant == 1.0 && *motion.d() > 0.0),
        ),
    ] {
        assert!(number >= 3, "{number} {name}");
    }
    for case in GALLERY.iter() {
        assert!(case.found.open.is_empty(), "{:?} {:?}", case.motion, case.found.open);
    }
}

// ---- what every orbit satisfies

/// The law, or what breaks it.
type Law = fn(&Motion<f64>, &RoundedOrbit) -> Result<(), String>;

fn hold(law: Law) {
    for (motion, row) in gallery() {
        if let Err(broken) = law(motion, row) {
            panic!("{broken}: {motion:?} {row:?}");
        }
    }
}

fn ensure(holds: bool, otherwise: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(otherwise()) }
}

#[test]
fn the_determinant_is_the_product_of_squared_restitutions() {
    hold(determinant);
}

fn determinant(motion: &Motion<f64>, row: &RoundedOrbit) -> Result<(), String> {
    let product = (motion.restitution(Side::Bottom) * motion.restitution(Side::Top)).powi(2);
    ensure((row.determinant - product).abs() <= 1e-15 * product, || {
        format!("determinant {}", row.determinant)
    })
}

#[test]
fn printed_values_satisfy_9_to_13_within_the_bound_times_the_derivative() {
    hold(residuals);
}

fn residuals(motion: &Motion<f64>, row: &RoundedOrbit) -> Result<(), String> {
    let bound = row.error_bound.ok_or("no bound")?;
    let pair = Pair::<Digits>::printed(row);
    let wide = motion.convert(|&x| Digits::from_f64(x)).expect("the same numbers");
    let lifted = motion
        .convert(|&x| Dual::from_re(Digits::from_f64(x)))
        .expect("the same numbers");
    // the sum of sizes of the derivatives by the six printed values
    let mut sizes = [0.0; 4];
    for unknown in 0..6 {
        let lift = |list: usize, values: &[Digits; 2]| -> [Dual<Digits>; 2] {
            std::array::from_fn(|i| {
                let value = values[i].clone();
                if 2 * list + i == unknown {
                    seeded(value)
                } else {
                    Dual::from_re(value)
                }
            })
        };
        let moved = Pair {
            velocities: lift(0, &pair.velocities),
            times: lift(1, &pair.times),
            phases: lift(2, &pair.phases),
        };
        for (size, residual) in sizes.iter_mut().zip(moved.residuals(&lifted)) {
            *size += residual.eps.to_f64().abs();
        }
    }
    for (residual, size) in pair.residuals(&wide).iter().zip(sizes) {
        let residual = residual.to_f64().abs();
        // what is quadratic in the bound stays far below a part in a million of it
        ensure(residual <= size * bound * (1.0 + 1e-6), || {
            format!("residual {residual:e}, bound {bound:e} times {size}")
        })?;
    }
    let [t_1, t_2] = &pair.times;
    let total = t_1.clone() + t_2.clone() - Digits::from_integer(2 * i64::from(row.periods));
    ensure(total.to_f64().abs() <= 2.0 * bound, || "(13)".into())?;
    let ahead = pair.phases[1].clone() - pair.phases[0].clone() - Digits::pi() * t_1.clone();
    let turns = Digits::from_integer((ahead.to_f64() / TAU).round() as i64);
    let off = (ahead - turns * Digits::from_integer(2) * Digits::pi()).to_f64().abs();
    ensure(off <= (2.0 + PI) * bound, || format!("the phases are {off:e} off"))
}

/// The farthest that a printed value is from the orbit of 40 digits.
fn error(motion: &Motion<f64>, row: &RoundedOrbit) -> f64 {
    let [exact, printed] = [improved(motion, row), Pair::printed(row)];
    let apart = |[a, b]: &[Digits; 2], [c, d]: &[Digits; 2]| {
        let [one, other] = [a.clone() - c.clone(), b.clone() - d.clone()];
        one.to_f64().abs().max(other.to_f64().abs())
    };
    apart(&exact.velocities, &printed.velocities)
        .max(apart(&exact.times, &printed.times))
        .max(apart(&exact.phases, &printed.phases))
}

#[test]
fn printed_values_are_within_the_bound_of_forty_digits_and_the_bound_is_no_more_than_needed() {
    hold(within);
    let errors = gallery().map(|(motion, row)| (error(motion, row), row.error_bound.expect("certified")));
    let tight: Vec<bool> = errors.map(|(error, bound)| bound <= 10.0 * error).collect();
    let number = tight.iter().filter(|tight| **tight).count();
    assert!(20 * number >= 19 * tight.len(), "{number} of {}", tight.len());
}

fn within(motion: &Motion<f64>, row: &RoundedOrbit) -> Result<(), String> {
    let (error, bound) = (error(motion, row), row.error_bound.ok_or("no bound")?);
    ensure(error <= bound && bound < 2e-15, || {
        format!("off by {error:e}, bound {bound:e}")
    })
}

/// The product of the derivatives of both maps, in 40 digits, by dual numbers.
fn product(motion: &Motion<f64>, row: &RoundedOrbit) -> Matrix2<Digits> {
    let wide = motion.convert(|&x| Digits::from_f64(x)).expect("the same numbers");
    let pair = improved(motion, row);
    let forcing = Forcing::harmonic(&Digits::from_f64(0.0));
    let jacobian = |index: usize, side: Side| {
        let time = pair.phases[index].clone() / Digits::pi();
        let velocity = pair.velocities[index].clone();
        let impact = Impact { side, time, velocity };
        let passage = Passage::new(&wide, &forcing, &impact, &pair.times[index]);
        passage.by_duals().expect("no grazing")
    };
    jacobian(1, Side::Top) * jacobian(0, Side::Bottom)
}

#[test]
fn trace_multipliers_kind_and_stability_are_those_of_the_product_of_jacobians() {
    hold(stability);
}

fn stability(motion: &Motion<f64>, row: &RoundedOrbit) -> Result<(), String> {
    let entries = product(motion, row);
    let trace = entries.trace();
    let [a, b, c, d] = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|at| entries[at].clone());
    let determinant = a * d - b * c;
    let near = (trace.to_f64() - row.trace).abs() <= 4.0 * f64::EPSILON * row.trace.abs();
    ensure(near, || format!("trace {}", trace.to_f64()))?;
    let product = row.determinant;
    let off = (determinant.to_f64() - product).abs();
    ensure(off <= 1e-14 * product + 1e-25 * (1.0 + row.trace.powi(2)), || {
        format!("determinant off by {off:e}")
    })?;
    // the roots of x² - trace x + determinant, without cancellation
    let restitutions = [Side::Bottom, Side::Top].map(|side| Digits::from_f64(*motion.restitution(side)));
    let root = restitutions[0].clone() * restitutions[1].clone();
    let determinant = root.clone() * root;
    let apart = trace.clone() * trace.clone() - Digits::from_integer(4) * determinant.clone();
    let is_focus = apart.to_f64() < 0.0;
    let half = trace * Digits::from_ratio(1, 2);
    let sizes = if is_focus {
        [determinant.to_f64().sqrt(); 2]
    } else {
        let reach = apart.sqrt() * Digits::from_ratio(1, 2);
        let larger = if half.to_f64() < 0.0 {
            half - reach
        } else {
            half + reach
        };
        [larger.to_f64().abs(), (determinant.clone() / larger).to_f64().abs()]
    };
    let level = (1.0 - sizes[0]).abs();
    ensure(
        level < 1e-12 || row.stable == (sizes[0] < 1.0 && sizes[1] < 1.0),
        || format!("multipliers of size {sizes:?}"),
    )?;
    let kind = match (is_focus, sizes[0] > 1.0) {
        (true, _) => OrbitKind::Focus,
        (false, true) => OrbitKind::Saddle,
        (false, false) => OrbitKind::Node,
    };
    ensure((level < 1e-12 && !is_focus) || kind == row.kind, || format!("{kind}"))?;
    let printed = row
        .multipliers
        .each_ref()
        .map(|multiplier| multiplier.re.hypot(multiplier.im));
    let mut sorted = [printed[0].max(printed[1]), printed[0].min(printed[1])];
    sorted[1] = sorted[1].max(0.0);
    let near = |i: usize| (sorted[i] - sizes[i]).abs() <= 1e-14 * sizes[i];
    ensure(near(0) && near(1), || format!("multipliers {printed:?}, not {sizes:?}"))
}

fn flight(motion: &Motion<f64>, row: &RoundedOrbit, index: usize) -> Flight<f64> {
    Flight::after(motion, &Forcing::harmonic(&0.0), &impact(row, index)).expect("a flight")
}

fn impact(row: &RoundedOrbit, index: usize) -> Impact<f64> {
    Impact {
        side: [Side::Bottom, Side::Top][index],
        time: row.phases[index] / PI,
        velocity: row.velocities[index],
    }
}

#[test]
fn clearance_and_admissible_are_those_of_densely_sampled_flights() {
    hold(clearance);
}

fn clearance(motion: &Motion<f64>, row: &RoundedOrbit) -> Result<(), String> {
    let sampled = |samples: u32| {
        (0..2)
            .map(|index| least(motion, row, index, samples))
            .fold(f64::INFINITY, f64::min)
    };
    // the flight is bounded by its speed, and the samples by its rounding
    let size = 1e-13 * (1.0 + row.velocities[0].abs() + row.velocities[1].abs());
    let agree = |least: f64| least == row.clearance || (least - row.clearance).abs() <= size;
    // two turns between two samples are seen by closer ones
    let found = [500, 20_000].map(|samples| {
        if agree(sampled(500)) {
            row.clearance
        } else {
            sampled(samples)
        }
    });
    ensure(agree(found[1]), || format!("clearance {found:?}"))?;
    ensure(row.admissible == (row.clearance > 0.0), || "admissible".into())
}

/// The least distance from a wall over the turning points strictly inside a flight.
fn least(motion: &Motion<f64>, row: &RoundedOrbit, index: usize, samples: u32) -> f64 {
    let flight = flight(motion, row, index);
    let at = |sample: u32| row.times[index] * f64::from(sample) / f64::from(samples);
    let velocity = |time: f64| flight.state(&time).velocity;
    let mut nearest = f64::INFINITY;
    for sample in 0..samples {
        let (mut low, mut high) = (at(sample), at(sample + 1));
        let rising = velocity(high) > 0.0;
        if (velocity(low) > 0.0) == rising {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (velocity(middle) > 0.0) == rising {
                high = middle
            } else {
                low = middle
            }
        }
        nearest = nearest.min(0.5 * motion.d() - flight.position(&high).abs());
    }
    nearest
}

#[test]
fn the_simulated_ball_follows_an_admissible_orbit_and_leaves_an_inadmissible_one() {
    hold(simulation);
}

fn simulation(motion: &Motion<f64>, row: &RoundedOrbit) -> Result<(), String> {
    let speed = row.velocities[0].min(-row.velocities[1]);
    if speed < 1e-4 || row.clearance.abs() < 1e-9 {
        return Ok(()); // rounding decides
    }
    let forcing = Forcing::harmonic(&0.0);
    let follows = |index: usize| {
        let next = 1 - index;
        next_impact(motion, &forcing, &impact(row, index)).is_ok_and(|leg| {
            let near = 1e-12 * (1.0 + row.times[index].powi(2)) / speed.min(1.0);
            leg.to.side == impact(row, next).side
                && (leg.to.velocity - row.velocities[next]).abs() < near
                && (leg.duration - row.times[index]).abs() < near
        })
    };
    ensure((follows(0) && follows(1)) == row.admissible, || {
        "simulated otherwise".into()
    })
}

#[test]
fn the_trace_is_that_of_the_simulated_map_of_dual_numbers() {
    let mut number = 0;
    for (motion, row) in gallery().filter(|(_, row)| row.admissible) {
        let speed = row.velocities[0].min(-row.velocities[1]);
        if speed < 1e-2 || row.clearance < 1e-6 {
            continue;
        }
        let lift = |value: &f64| Dual::from_re(*value);
        let dual = motion.convert(lift).expect("the same numbers");
        let forcing = Forcing::harmonic(&Dual::from_re(0.0));
        let Impact { side, time, velocity } = impact(row, 0);
        let starts = [
            Impact {
                side,
                time: seeded(time),
                velocity: lift(&velocity),
            },
            Impact {
                side,
                time: lift(&time),
                velocity: seeded(velocity),
            },
        ];
        let ends = starts.map(|start| {
            let leg = next_impact(&dual, &forcing, &start).expect("a flight");
            next_impact(&dual, &forcing, &leg.to).expect("a flight").to
        });
        let trace = ends[0].time.eps + ends[1].velocity.eps;
        let size = 1.0
            + ends
                .iter()
                .map(|end| end.time.eps.abs() + end.velocity.eps.abs())
                .sum::<f64>();
        assert!(
            (trace - row.trace).abs() < 1e-11 * size * size / speed,
            "{trace}: {motion:?} {row:?}"
        );
        number += 1;
    }
    assert!(number > 20, "{number}");
}

#[test]
fn whole_periods_later_and_under_a_shifted_forcing_an_orbit_is_the_same_one() {
    for (motion, row) in gallery().filter(|(_, row)| row.admissible && row.clearance > 1e-6) {
        let speed = row.velocities[0].min(-row.velocities[1]);
        for (shift, later) in [(0.0, 8.0), (1.25, 0.0), (-2.5, 2.0)] {
            let mut start = impact(row, 0);
            start.time += later - shift / PI;
            let leg = next_impact(motion, &Forcing::harmonic(&shift), &start).expect("a flight");
            let near = 1e-11 * (1.0 + row.times[0].powi(2)) / speed.min(1.0);
            assert!((leg.to.velocity - row.velocities[1]).abs() < near, "{motion:?} {row:?}");
            assert!((leg.duration - row.times[0]).abs() < near, "{motion:?} {row:?}");
        }
    }
}

// ---- none missed, none invented

#[test]
fn the_mirrored_motion_has_the_mirrored_orbits() {
    for case in GALLERY.iter() {
        mirror(case).unwrap_or_else(|broken| panic!("{broken}: {:?}", case.motion));
    }
}

/// Walls exchanged, gravity reversed, phases half a turn on: the top impact is the bottom one of the image.
fn mirror(case: &Case) -> Result<(), String> {
    let images = Case::new((case.motion.mirrored().expect("two walls"), case.periods))
        .found
        .orbits;
    ensure(images.len() == case.found.orbits.len(), || {
        format!("{} and {} orbits", case.found.orbits.len(), images.len())
    })?;
    for row in &case.found.orbits {
        let image = [-row.velocities[1], -row.velocities[0], row.times[1], row.phases[1] + PI];
        let near = |other: &&RoundedOrbit| other.periods == row.periods && is_near(other, &image, 1e-14 * (2.0 + TAU));
        let found = images.iter().filter(near).collect::<Vec<_>>();
        ensure(found.len() == 1, || format!("{} images of {row:?}", found.len()))?;
        let close = |a: f64, b: f64| a == b || (a - b).abs() <= 1e-14 * (1.0 + a.abs());
        let same = close(found[0].trace, row.trace)
            && close(found[0].clearance, row.clearance)
            && (found[0].kind, found[0].stable, found[0].admissible) == (row.kind, row.stable, row.admissible);
        ensure(same, || format!("{:?} is not the image of {row:?}", found[0]))?;
    }
    Ok(())
}

#[test]
fn an_orbit_that_a_motion_was_made_around_is_found() {
    for (motion, periods, orbit) in planted(2).take(150) {
        planted_is_found(&motion, periods, &orbit).unwrap_or_else(|broken| panic!("{broken}: {motion:?}"));
    }
}

fn planted_is_found(motion: &Motion<f64>, periods: u32, orbit: &[f64; 4]) -> Result<(), String> {
    let found = find(motion, &Word::pair(), periods).expect("a search");
    // near a fold the rounding of g and d moves an orbit by the root of it
    let near = |row: &&RoundedOrbit| row.periods == periods && is_near(row, orbit, 1e-6);
    let number = found.orbits.iter().filter(near).count();
    ensure(number == 1 || (number == 0 && !found.open.is_empty()), || {
        format!("{number} orbits near {orbit:?} over {periods}")
    })
}

#[test]
fn beside_a_fold_two_orbits_are_found_and_beyond_it_none_wherever_the_phase_is() {
    let mut number = 0;
    let mut sequence = Sequence::new(6);
    for draw in 0..120 {
        let [r_b, r_t] = [sequence.between(0.1, 1.0), sequence.between(0.1, 1.0)];
        let periods = 1 + draw % 2;
        // every other next to where the circle is cut
        let psi = if draw % 4 < 2 {
            PI + sequence.between(-0.03, 0.03)
        } else {
            sequence.between(0.0, TAU)
        };
        for (g, d, t_1) in folds(r_b, r_t, psi, periods) {
            let near = |d: f64| {
                let motion = Motion::new(g, d, r_b, r_t).expect("a motion");
                let found = find(&motion, &Word::pair(), periods).expect("a search");
                assert!(found.open.is_empty(), "{motion:?} {:?}", found.open);
                let is_near = |row: &&RoundedOrbit| {
                    let middle = row.phases[0] + 0.5 * PI * row.times[0] - psi;
                    row.periods == periods && (row.times[0] - t_1).abs() < 0.02 && (0.5 * middle).sin().abs() < 0.01
                };
                found.orbits.iter().filter(is_near).count()
            };
            let mut counts = [near(d - 1e-7), near(d + 1e-7)];
            counts.sort_unstable();
            assert_eq!(counts, [0, 2], "g {g} d {d} r {r_b} {r_t} T_1 {t_1} psi {psi}");
            number += 1;
        }
    }
    assert!(number >= 10, "{number}");
}

/// (g, d, T_1) at the folds of orbits with this psi: where the derivatives of (9) to (12) by v, w, T_1 and the phase
/// have determinant 0, by differences.
fn folds(r_b: f64, r_t: f64, psi: f64, periods: u32) -> Vec<(f64, f64, f64)> {
    let singular = |t_1: f64| {
        let phase = psi - 0.5 * PI * t_1;
        let (g, d, [v, w]) = motion_of(r_b, r_t, t_1, phase, periods)?;
        let lifted = Motion::new(g, d, r_b, r_t).ok()?.convert(|&x| Dual::from_re(x)).ok()?;
        let at = [v, w, t_1, phase];
        let columns: [[f64; 4]; 4] = std::array::from_fn(|column| {
            let point = std::array::from_fn(|i| {
                if i == column {
                    seeded(at[i])
                } else {
                    Dual::from_re(at[i])
                }
            });
            Pair::closed(&point, periods).residuals(&lifted).map(|value| value.eps)
        });
        let wanted = v > 0.02 && w < -0.02 && (0.02..3.0).contains(&d) && g.abs() < 1.5;
        wanted.then(|| {
            (
                g,
                d,
                nalgebra::Matrix4::from_fn(|row, column| columns[column][row]).determinant(),
            )
        })
    };
    let total = 2.0 * f64::from(periods);
    let at = |index: u32| total * f64::from(index) / 400.0;
    let mut found = Vec::new();
    for index in 1..399 {
        let (mut low, mut high) = (at(index), at(index + 1));
        let (Some(before), Some(after)) = (singular(low), singular(high)) else {
            continue;
        };
        if before.2 * after.2 >= 0.0 {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let same = singular(middle).is_some_and(|value| value.2 * before.2 > 0.0);
            if same { low = middle } else { high = middle }
        }
        found.extend(singular(low).map(|(g, d, _)| (g, d, low)));
    }
    found
}

#[test]
fn a_dense_scan_of_the_curve_finds_no_orbit_that_is_missing() {
    let mut number = 0;
    for case in GALLERY.iter() {
        number += scan(case, 1500).unwrap_or_else(|broken| panic!("{broken}: {:?}", case.motion));
    }
    assert!(number > 150, "{number}");
}

/// The number of orbits that the scan finds, all of them known.
fn scan(case: &Case, points: u32) -> Result<usize, String> {
    let mut number = 0;
    for periods in 1..=case.periods {
        for likely in scanned(&case.motion, periods, points) {
            if likely[0] < 1e-6 || likely[1] > -1e-6 {
                continue;
            }
            let known = case.of(periods).any(|row| is_near(row, &likely, 1e-5));
            ensure(known, || format!("{likely:?} over {periods} is missing"))?;
            number += 1;
        }
    }
    Ok(number)
}

#[test]
fn a_search_in_double_double_from_other_pieces_finds_as_many_orbits() {
    for case in GALLERY.iter().take(20) {
        counted(case).unwrap_or_else(|broken| panic!("{broken}: {:?}", case.motion));
    }
}

/// Nothing proposed, the square cut elsewhere, and another number.
fn counted(case: &Case) -> Result<(), String> {
    type Line = Interval<DoubleDouble>;
    let motion = case.motion.convert(|&x| Line::from_f64(x)).expect("the same numbers");
    let line = |low: f64, high: f64| Line::new(DoubleDouble::from_f64(low), DoubleDouble::from_f64(high));
    for periods in 1..=case.periods {
        let balance = OneOneEquations::new(&motion, periods);
        let total = 2.0 * f64::from(periods);
        let times = [line(0.0, 0.413 * total), line(0.413 * total, total)];
        // one turn from elsewhere, a little more than whole
        let phases = [line(0.3, 2.9), line(2.9, 0.3 + TAU + 1e-9)];
        let cells = times
            .iter()
            .flat_map(|time| phases.iter().map(move |phase| [*time, *phase]));
        let limits = SearchLimits {
            finest: 1e-16,
            most_cells: 400_000,
        };
        let isolation = isolate(&balance, cells.collect(), Vec::new(), limits);
        ensure(isolation.is_complete(), || {
            format!("{} undecided", isolation.undecided.len())
        })?;
        let mut distinct: Vec<[f64; 2]> = Vec::new();
        for root in &isolation.roots {
            let [t_1, middle] = &root.enclosure;
            let [v, w] = balance.velocities(t_1, middle);
            let [t_1, middle] = [t_1.to_f64(), middle.to_f64()];
            let known =
                |[time, other]: &[f64; 2]| (time - t_1).abs() < 1e-12 && (0.5 * (middle - other)).sin().abs() < 1e-12;
            // a proof reaches beyond the pieces, to negative times
            let moves = v.is_positive() && w.is_negative() && (0.0..total).contains(&t_1);
            if moves && !distinct.iter().any(known) {
                distinct.push([t_1, middle]);
            }
        }
        let number = case.of(periods).count();
        ensure(distinct.len() == number, || {
            format!("{} orbits, not {number}", distinct.len())
        })?;
    }
    Ok(())
}

/// All of the above on 10,000 motions, and 10,000 planted ones:
/// `cargo test --release --test orbits ten_thousand -- --ignored --nocapture`
#[test]
#[ignore = "minutes in release"]
fn every_law_holds_on_ten_thousand_motions() {
    let laws: [(&str, Law); 6] = [
        ("determinant", determinant),
        ("residuals", residuals),
        ("bound", within),
        ("stability", stability),
        ("clearance", clearance),
        ("simulation", simulation),
    ];
    let cases: Vec<_> = scenes(3).take(10_000).collect();
    let outcomes = cases.into_par_iter().map(|drawn| {
        let case = Case::new(drawn);
        let mut broken: Vec<String> = case.found.open.iter().map(|open| format!("open: {open}")).collect();
        for row in &case.found.orbits {
            for (name, law) in laws {
                broken.extend(
                    law(&case.motion, row)
                        .err()
                        .map(|why| format!("{name}: {why}: {row:?}")),
                );
            }
        }
        broken.extend(mirror(&case).err().map(|why| format!("mirror: {why}")));
        broken.extend(scan(&case, 3000).err().map(|why| format!("scan: {why}")));
        broken.extend(counted(&case).err().map(|why| format!("count: {why}")));
        for broken in &broken {
            println!("{broken}: {:?}", case.motion);
        }
        (case.found.orbits.len(), broken.len())
    });
    let (orbits, broken) = outcomes.reduce(|| (0, 0), |one, other| (one.0 + other.0, one.1 + other.1));
    println!("{orbits} orbits of 10,000 motions, {broken} laws broken");
    let missed = planted(4).take(10_000).filter(|(motion, periods, orbit)| {
        let outcome = planted_is_found(motion, *periods, orbit);
        outcome
            .inspect_err(|why| println!("planted: {why}: {motion:?}"))
            .is_err()
    });
    let missed = missed.count();
    println!("{missed} of 10,000 planted orbits missed");
    assert_eq!((broken, missed), (0, 0));
}
