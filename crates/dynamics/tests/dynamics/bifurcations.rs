//! Bifurcations of the 1-1 orbits along the gap: each is where it must be, and the orbits change in number there alone.

use dynamics::model::{Motion, MotionError, Side};
use dynamics::orbit::{
    BifurcationKind, BifurcationPoint, Family, FoundOrbits, OneOneBranches, OrbitKind, OrbitOptions, Parameters,
    RoundedOrbit, Word, find,
};
use numbers::{Analytic, Interval};
use std::f64::consts::{PI, TAU};

/// g in hundred thousandths, restitutions in hundredths, so that they are the same in every number.
#[derive(Clone, Copy, Debug)]
struct Along {
    g: i64,
    r_b: i64,
    r_t: i64,
}

impl Family for Along {
    fn motion_at<T: Analytic>(&self, d: &T) -> Result<Motion<T>, MotionError> {
        // a quotient is rounded outwards: 100/100 would reach beyond 1
        let part = |hundredths| {
            if hundredths == 100 {
                T::one()
            } else {
                T::from_ratio(hundredths, 100)
            }
        };
        let [r_b, r_t] = [self.r_b, self.r_t].map(part);
        Motion::new(T::from_ratio(self.g, 100_000), d.clone(), r_b, r_t)
    }

    fn is_symmetric(&self) -> bool {
        self.r_b == self.r_t && (self.g == 0 || self.r_b == 100)
    }
}

impl Along {
    fn mirrored(self) -> Self {
        Self {
            g: -self.g,
            r_b: self.r_t,
            r_t: self.r_b,
        }
    }

    fn found(&self, d: f64, periods: u32) -> Vec<RoundedOrbit> {
        let FoundOrbits { orbits, open, .. } = find(&self.fixed(&d), &Word::pair(), periods).expect("a search");
        assert!(open.is_empty(), "{self:?} {d} {open:?}");
        orbits.into_iter().filter(|row| row.periods == periods).collect()
    }
}

/// A family over a range of d, with every event in it.
struct Sweep {
    family: Along,
    periods: u32,
    range: [f64; 2],
    events: Vec<BifurcationPoint>,
}

impl Sweep {
    fn new(family: Along, periods: u32, range: [f64; 2]) -> Self {
        let prepared = prepared(&family, periods, range);
        let (events, open) = prepared.bifurcations();
        assert!(open.is_empty(), "{family:?} {open:?}");
        Self {
            family,
            periods,
            range,
            events,
        }
    }
}

fn prepared(family: &Along, periods: u32, [from, to]: [f64; 2]) -> OneOneBranches<&Along> {
    OneOneBranches::new(family, periods, Interval::new(from, to), &OrbitOptions::DEFAULT).expect("a cover")
}

fn along(g: i64, r_b: i64, r_t: i64) -> Along {
    Along { g, r_b, r_t }
}

/// The paper's gravity at pi/6.
const PAPER: i64 = 12_201;

/// Families of all kinds: of the paper, heavy, light, weightless and equal, elastic, of two and three periods.
fn sweeps() -> Vec<Sweep> {
    [
        (along(PAPER, 50, 50), 1, [0.1, 1.0]),
        (along(PAPER, 60, 30), 1, [0.1, 1.0]),
        (along(-40_000, 30, 80), 1, [0.05, 0.9]),
        (along(110_000, 80, 80), 1, [0.3, 2.0]),
        (along(0, 50, 50), 1, [0.1, 0.9]),
        (along(0, 90, 90), 1, [0.21, 1.2]),
        (along(1, 50, 50), 1, [0.1, 0.9]),
        (along(PAPER, 100, 100), 1, [0.2, 0.9]),
        (along(0, 100, 100), 1, [0.25, 0.9]),
        (along(PAPER, 60, 30), 2, [0.2, 0.9]),
        (along(PAPER, 50, 50), 3, [0.3, 0.7]),
    ]
    .map(|(family, periods, range)| Sweep::new(family, periods, range))
    .into_iter()
    .collect()
}

static SWEEPS: std::sync::LazyLock<Vec<Sweep>> = std::sync::LazyLock::new(sweeps);

/// How many orbits an event makes or ends.
fn change(event: &BifurcationPoint) -> usize {
    match event.kind {
        BifurcationKind::Fold | BifurcationKind::SymmetryBreaking => 2,
        // the other orbits that graze pass through the wall and are listed on both sides
        BifurcationKind::Grazing if event.trace.is_infinite() => 1,
        _ => 0,
    }
}

#[test]
fn orbits_change_in_number_at_folds_symmetry_breakings_and_velocities_of_0_alone() {
    let mut changes = 0;
    for Sweep {
        family,
        periods,
        range: [from, to],
        events,
    } in SWEEPS.iter()
    {
        let prepared = prepared(family, *periods, [*from, *to]);
        let steps = 160;
        let grid: Vec<f64> = (0..=steps)
            .map(|step| from + (to - from) * (f64::from(step) + 0.37) / f64::from(steps + 1))
            .collect();
        let counts = prepared.points(&grid).expect("a search");
        for (found, d) in counts.iter().zip(&grid) {
            assert!(
                found.open.is_empty(),
                "{family:?} over {periods} at {d}: {:?}",
                found.open
            );
        }
        for (pair, ends) in counts.windows(2).zip(grid.windows(2)) {
            let between: Vec<&BifurcationPoint> = events
                .iter()
                .filter(|event| ends[0] < event.d && event.d < ends[1] && change(event) > 0)
                .collect();
            let allowed: usize = between.iter().map(|event| change(event)).sum();
            let moved = pair[0].orbits.len().abs_diff(pair[1].orbits.len());
            let all = if between.len() < 2 {
                moved == allowed
            } else {
                moved <= allowed && (allowed - moved).is_multiple_of(2)
            };
            assert!(all, "{family:?} over {periods} in {ends:?}: {moved} for {between:?}");
            changes += moved;
        }
    }
    assert!(changes > 20, "{changes}");
}

#[test]
fn prepared_orbits_are_those_of_the_search_at_that_value() {
    for Sweep {
        family,
        periods,
        range: [from, to],
        events,
    } in SWEEPS.iter()
    {
        let prepared = prepared(family, *periods, [*from, *to]);
        let mut values: Vec<f64> = (0..=6)
            .map(|step| (from + (to - from) * f64::from(step) / 6.0).clamp(*from, *to))
            .collect();
        // and next to events, where orbits are close
        let beside = events.iter().flat_map(|event| [event.d - 1e-9, event.d + 1e-9]);
        values.extend(beside.filter(|d| (*from..=*to).contains(d)));
        for d in values {
            let orbits = prepared.orbits(&d).expect("a search").orbits;
            let known = family.found(d, *periods);
            assert_eq!(orbits.len(), known.len(), "{family:?} over {periods} at {d}");
            for orbit in &orbits {
                // as sets: a phase of 0 within rounding may be listed first or last
                let same = known.iter().filter(|known| apart(orbit, known) < 1e-14);
                assert_eq!(same.count(), 1, "{orbit:?} {known:?}");
            }
        }
    }
}

fn apart(one: &RoundedOrbit, other: &RoundedOrbit) -> f64 {
    let pairs = [(&one.velocities, &other.velocities), (&one.times, &other.times)];
    let differences = pairs
        .iter()
        .flat_map(|(a, b)| a.iter().zip(b.iter()))
        .map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// The orbit nearest to the motion of an event, in times and velocities.
fn nearest(orbits: &[RoundedOrbit], event: &BifurcationPoint) -> Option<RoundedOrbit> {
    let distance = |row: &&RoundedOrbit| {
        let times = (row.times[0] - event.times[0]).abs();
        let velocities: f64 = (0..2).map(|i| (row.velocities[i] - event.velocities[i]).abs()).sum();
        let around = (row.phases[0] - event.phases[0]).rem_euclid(TAU);
        times + velocities + around.min(TAU - around)
    };
    let nearest = orbits.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    (distance(&nearest) < 0.05).then(|| nearest.clone())
}

#[test]
fn the_trace_crosses_its_level_and_the_clearance_0_at_each_event() {
    let mut number = 0;
    for sweep in SWEEPS.iter() {
        for event in &sweep.events {
            let step = 1e-7;
            let alone = |other: &&BifurcationPoint| (other.d - event.d).abs() < 4.0 * step;
            if sweep.events.iter().filter(alone).count() > 1 {
                continue;
            }
            let sides = [-step, step].map(|step| sweep.family.found(event.d + step, sweep.periods));
            let near = [0, 1].map(|side| nearest(&sides[side], event));
            let what = || format!("{:?} {event:?}", sweep.family);
            match (event.kind, &near) {
                (BifurcationKind::PeriodDoubling | BifurcationKind::NodeFocus, [Some(below), Some(above)]) => {
                    let signs = [below, above].map(|row| row.trace - event.trace);
                    assert!(signs[0] * signs[1] < 0.0, "{signs:?}: {}", what());
                    let size = signs[0].abs() + signs[1].abs();
                    assert!(size < 1e-2 * (1.0 + event.trace.abs()), "{signs:?}: {}", what());
                    if event.kind == BifurcationKind::NodeFocus {
                        assert_ne!(below.kind, above.kind, "{}", what());
                    } else {
                        // without a loss nothing is stable, but the multipliers still leave the circle
                        let saddles = [below, above].map(|row| row.kind == OrbitKind::Saddle);
                        assert_ne!(saddles[0], saddles[1], "{}", what());
                    }
                }
                (BifurcationKind::Grazing, [Some(below), Some(above)]) if event.trace.is_finite() => {
                    let signs = [below.clearance, above.clearance].map(|clearance| clearance.min(1.0));
                    // where it is not least, another turning point lies beyond a wall
                    let other = signs.iter().all(|clearance| *clearance < -1e-3);
                    assert!(other || signs[0] * signs[1] < 0.0, "{signs:?}: {}", what());
                    assert!(
                        other || signs.iter().any(|clearance| clearance.abs() < 1e-4),
                        "{}",
                        what()
                    );
                }
                (BifurcationKind::Grazing, [below, above]) => {
                    assert!(sides[0].len().abs_diff(sides[1].len()) == 1, "{}", what());
                    let slow = below
                        .iter()
                        .chain(above)
                        .map(|row| row.velocities[0].min(-row.velocities[1]));
                    assert!(slow.fold(f64::INFINITY, f64::min) < 1e-4, "{}", what());
                }
                (BifurcationKind::Fold | BifurcationKind::SymmetryBreaking, _) => {
                    assert!(sides[0].len().abs_diff(sides[1].len()) == 2, "{}", what());
                }
                _ => panic!("no orbit beside it: {}", what()),
            }
            number += 1;
        }
    }
    assert!(number > 60, "{number}");
}

#[test]
fn each_event_satisfies_its_own_equation_in_its_range_and_is_listed_once() {
    for sweep in SWEEPS.iter() {
        let [r_b, r_t] = [sweep.family.r_b, sweep.family.r_t].map(|hundredths| hundredths as f64 / 100.0);
        let (sum, twice) = (1.0 + (r_b * r_t).powi(2), 2.0 * r_b * r_t);
        for (index, event) in sweep.events.iter().enumerate() {
            let holds = match event.kind {
                BifurcationKind::PeriodDoubling => (event.trace + sum).abs() < 1e-14,
                BifurcationKind::Fold | BifurcationKind::SymmetryBreaking => (event.trace - sum).abs() < 1e-14,
                BifurcationKind::NodeFocus => (event.trace.abs() - twice).abs() < 1e-14,
                BifurcationKind::Grazing if event.trace.is_infinite() => {
                    event.velocities.iter().any(|v| v.abs() < 1e-15)
                }
                BifurcationKind::Grazing => event.clearance <= 0.0,
            };
            assert!(holds, "{:?} {event:?}", sweep.family);
            assert!(
                event.error_bound.is_some_and(|bound| bound < 1e-15 * (1.0 + TAU)) && event.parameter == event.d,
                "{event:?}"
            );
            let [from, to] = sweep.range;
            assert!((from..=to).contains(&event.d), "{:?} {event:?}", sweep.family);
            let twin = sweep.events[..index].iter().find(|other| {
                let same = other.kind == event.kind && (other.d - event.d).abs() < 1e-12;
                same && (0..2).all(|i| (other.times[i] - event.times[i]).abs() < 1e-12)
                    && (0.5 * (other.phases[0] - event.phases[0])).sin().abs() < 1e-12
            });
            assert!(twin.is_none(), "{:?} {event:?} {twin:?}", sweep.family);
        }
    }
}

#[test]
fn the_mirrored_family_has_the_mirrored_events() {
    for Sweep {
        family,
        periods,
        range,
        events,
    } in SWEEPS.iter().filter(|sweep| !sweep.family.is_symmetric())
    {
        let images = Sweep::new(family.mirrored(), *periods, *range).events;
        assert_eq!(images.len(), events.len(), "{family:?}");
        for event in events {
            let is_image = |image: &&BifurcationPoint| {
                let near = |a: f64, b: f64| (a - b).abs() < 1e-14 * (1.0 + a.abs());
                let half = 0.5 * (image.phases[0] - event.phases[1] - PI);
                image.kind == event.kind
                    && near(image.d, event.d)
                    && near(image.times[0], event.times[1])
                    && near(image.velocities[0], -event.velocities[1])
                    && near(image.velocities[1], -event.velocities[0])
                    && half.sin().abs() < 1e-14
                    && image.admissible == event.admissible
            };
            assert_eq!(
                images.iter().filter(is_image).count(),
                1,
                "{family:?} {event:?} {images:?}"
            );
        }
    }
}

#[test]
fn a_weightless_equal_pair_grazes_both_walls_at_once_and_that_is_told() {
    for (r_b, r_t, periods) in [(90, 90, 1), (90, 90, 2), (40, 40, 3), (30, 60, 2)] {
        let family = along(0, r_b, r_t);
        let (events, open) = prepared(&family, periods, [0.2, 0.21]).bifurcations();
        assert!(open.is_empty(), "{open:?}");
        let at = 2.0 / (PI * PI);
        let there = events.iter().filter(|event| (event.d - at).abs() < 1e-15);
        let graze = there.filter(|event| event.kind == BifurcationKind::Grazing && event.admissible);
        assert!(graze.count() >= 1, "{r_b} {r_t} {periods}");
    }
}

// ---- what another program found

/// A printed decimal: its value, and a unit of its last digit.
fn printed(text: &str) -> (f64, f64) {
    let places = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    (text.parse().expect("a number"), 10_f64.powi(-(places as i32)))
}

/// Within a unit of the last printed digit; of 17 digits, the rounding of f64 besides.
fn is_printed(value: f64, text: &str) -> bool {
    let (printed, unit) = printed(text);
    (value - printed).abs() <= unit + 0.5 * f64::EPSILON * printed.abs()
}

/// g, d, r_B, r_T, n, and of an orbit: velocities, phase, T_1, trace, as far as known; whether stable, admissible.
///
/// Made with 40 digits by programs that share nothing with this one.
const ORBITS: &str = "
0.12201 0.26 0.5 0.5 1 .6774485037 -.5147685037 .14811268 1.31700614 - yes yes
0.12201 0.4 0.5 0.5 1 .8327202251 -.6700402251 .4893951147 1.1165006593 -.371267776 yes yes
0.12201 0.33 0.6 0.3 1 .7290278145 -.7095573102 1.2138729127 .6694727375 - yes yes
0.12201 0.5 0.6 0.3 1 .8868720826 -.9038271786 - - - yes yes
0.21132751902 0.5 0.6 0.3 1 .9471895360 -.8406524766 - - - yes yes
0.12201 0.44 0.6 0.3 2 .3487994046 -.0538761903 2.971325889 2.903711820 371.7 no yes
0 0.3 0.5 0.5 1 .6342775152 - .5214758826 1 - - -
0 0.3 0.5 0.5 1 - - 3.038326 1 - - -
1.1 1.572303 0.8 0.8 1 2.526425477 -1.304203255 - - -.7088 yes -
";

#[test]
fn the_orbits_that_another_program_found_are_found_to_every_digit() {
    for line in ORBITS.lines().filter(|line| !line.is_empty()) {
        let fields: Vec<&str> = line.split(' ').collect();
        let number = |i: usize| fields[i].parse::<f64>().expect("a number");
        let motion = Motion::new(number(0), number(1), number(2), number(3)).expect("a motion");
        let periods = number(4) as u32;
        let found = find(&motion, &Word::pair(), periods).expect("a search");
        let agrees = |value: f64, field: usize| fields[field] == "-" || is_printed(value, fields[field]);
        let says = |truth: bool, field: usize| fields[field] == "-" || (fields[field] == "yes") == truth;
        let known = found.orbits.iter().filter(|row| {
            row.periods == periods
                && agrees(row.velocities[0], 5)
                && agrees(row.velocities[1], 6)
                && agrees(row.phases[0], 7)
                && agrees(row.times[0], 8)
                && agrees(row.trace, 9)
                && says(row.stable, 10)
                && says(row.admissible, 11)
        });
        assert_eq!(known.count(), 1, "{line}: {:?}", found.orbits);
    }
}

/// g in hundred thousandths, restitutions in hundredths, the event, d, and whether admissible where known. Source as
/// above.
const EVENTS: &str = "
12201 50 50 period-doubling 0.25107018538986923 -
12201 60 30 period-doubling 0.25905782991527197 no
12201 50 50 node-focus 0.30027738273209416 -
12201 50 50 node-focus 0.48721575758240395 -
12201 50 50 node-focus 0.158 -
12201 50 50 node-focus 0.174 -
12201 50 50 node-focus 0.660 -
12201 50 50 node-focus 0.951 -
12201 60 30 grazing 0.2612231724143 yes
";

#[test]
fn the_bifurcations_that_another_program_found_are_found_to_every_digit() {
    for line in EVENTS.lines().filter(|line| !line.is_empty()) {
        let fields: Vec<&str> = line.split(' ').collect();
        let [g, r_b, r_t] = [0, 1, 2].map(|i| fields[i].parse().expect("a number"));
        let is_family = |sweep: &&Sweep| {
            let Along {
                g: other,
                r_b: bottom,
                r_t: top,
            } = sweep.family;
            (other, bottom, top, sweep.periods) == (g, r_b, r_t, 1)
        };
        let sweep = SWEEPS.iter().find(is_family).expect("a sweep");
        let known = sweep.events.iter().filter(|event| {
            event.kind.to_string() == fields[3]
                && is_printed(event.d, fields[4])
                && (fields[5] == "-" || event.admissible == (fields[5] == "yes"))
        });
        assert_eq!(known.count(), 1, "{line}");
    }
}

#[test]
fn every_parameter_type_gives_the_same_motion() {
    let family = along(PAPER, 60, 30);
    let motion = family.fixed(&0.25).motion::<f64>().expect("a motion");
    assert_eq!((*motion.d(), *motion.restitution(Side::Top)), (0.25, 0.3));
    let narrow: Motion<Interval<f64>> = family.fixed(&0.25).motion().expect("a motion");
    assert!(narrow.g().contains(&0.12201) && narrow.d().contains(&0.25));
}

/// Kinds and places of the events over a range.
fn events(family: &Along, periods: u32, range: [f64; 2]) -> Vec<(BifurcationKind, f64)> {
    let (events, open) = prepared(family, periods, range).bifurcations();
    assert!(open.is_empty(), "{family:?} {range:?} {open:?}");
    events.iter().map(|event| (event.kind, event.parameter)).collect()
}

#[test]
fn over_a_wide_range_the_events_are_those_of_its_parts() {
    let ranges = [
        (along(PAPER, 50, 50), vec![0.1, 0.22, 0.3, 1.0, 250.0]),
        (along(19_700, 43, 21), vec![0.1, 0.2, 0.25, 3.0, 300.0]),
        (along(30_660, 30, 20), vec![0.02, 0.05, 0.1, 0.5, 3.0]),
        (along(0, 50, 50), vec![0.05, 0.3, 20.0]),
    ];
    for (family, ends) in ranges {
        let whole = events(&family, 1, [ends[0], *ends.last().unwrap()]);
        let parts: Vec<_> = ends
            .windows(2)
            .flat_map(|part| events(&family, 1, [part[0], part[1]]))
            .collect();
        assert_eq!(whole.len(), parts.len(), "{family:?} {whole:?} {parts:?}");
        for ((event, at), (other, there)) in whole.iter().zip(&parts) {
            assert!(
                event == other && (at / there - 1.0).abs() < 1e-13,
                "{family:?} {at} {there}"
            );
        }
    }
}

#[test]
fn events_that_wide_ranges_lost_are_found() {
    let holds = |found: &[(BifurcationKind, f64)], event, at: f64| {
        found
            .iter()
            .any(|(other, there)| *other == event && (there / at - 1.0).abs() < 1e-13)
    };
    let found = events(&along(PAPER, 50, 50), 1, [0.1, 250.0]);
    assert!(
        holds(&found, BifurcationKind::NodeFocus, 0.300_277_382_732_094_14),
        "{found:?}"
    );
    let found = events(&along(19_700, 43, 21), 1, [0.1, 300.0]);
    assert!(
        holds(&found, BifurcationKind::Fold, 0.221_666_364_289_678_06),
        "{found:?}"
    );
    let found = events(&along(12_200, 50, 50), 1, [2e-3, 10.0]);
    assert!(
        holds(&found, BifurcationKind::PeriodDoubling, 0.004_153_745_486_343_401),
        "{found:?}"
    );
    // beside the turn of the symmetric motions at 2.87, on which no other has its multipliers meet
    for (r, at) in [
        (50, 2.864_788_975_654_116),
        (40, 2.228_169_203_286_535),
        (80, 8.594_366_926_962_348),
    ] {
        for range in [[0.8 * at, 1.05 * at], [0.5 * at, 1.5 * at]] {
            let found = events(&along(0, r, r), 3, range);
            assert!(
                holds(&found, BifurcationKind::NodeFocus, at),
                "{r} {range:?}: {found:?}"
            );
        }
    }
}
