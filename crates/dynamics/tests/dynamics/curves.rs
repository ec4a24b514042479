//! Curves of bifurcations over two parameters: none is lost along random lines, and each point is what it is said to be.

use dynamics::model::{Motion, MotionError};
use dynamics::orbit::{
    BifurcationKind, BifurcationPoint, CurvePoint, Family, OneOneBranches, OneOneCurves, OrbitOptions, ParameterPlane,
    RoundedOrbit, SpecialPoint, Word, find, shoot_bifurcation,
};
use numbers::{Analytic, DoubleDouble, Interval, Sequence};
use std::f64::consts::PI;

/// Devices over d and r_B.
#[derive(Clone, Copy, Debug)]
struct Devices {
    g: f64,
    /// `None`: that of the bottom.
    r_t: Option<f64>,
    d: [f64; 2],
    r_b: [f64; 2],
}

/// The paper's device with r_T = .5, with r_T = .3, and devices without gravity and with like walls.
const DEVICES: [Devices; 3] = [
    Devices {
        g: 0.12201,
        r_t: Some(0.5),
        d: [0.1, 0.6],
        r_b: [0.2, 0.8],
    },
    Devices {
        g: 0.12201,
        r_t: Some(0.3),
        d: [0.1, 0.6],
        r_b: [0.2, 0.8],
    },
    Devices {
        g: 0.0,
        r_t: None,
        d: [0.1, 1.2],
        r_b: [0.2, 0.9],
    },
];

/// Devices along a straight line from one place to another, as its parameter goes from 0 to 1.
#[derive(Clone, Copy, Debug)]
struct Line {
    devices: Devices,
    ends: [[f64; 2]; 2],
}

impl Family for Line {
    fn motion_at<T: Analytic>(&self, part: &T) -> Result<Motion<T>, MotionError> {
        let [from, to] = self.ends;
        let at = |i: usize| T::from_f64(from[i]) + T::from_f64(to[i] - from[i]) * part.clone();
        ParameterPlane::motion_at(&self.devices, [&at(0), &at(1)])
    }

    fn is_symmetric(&self) -> bool {
        self.devices.r_t.is_none()
    }
}

impl ParameterPlane for Devices {
    type Line = Along;

    fn motion_at<T: Analytic>(&self, [d, r_b]: [&T; 2]) -> Result<Motion<T>, MotionError> {
        let r_t = self.r_t.map_or_else(|| r_b.clone(), T::from_f64);
        Motion::new(T::from_f64(self.g), d.clone(), r_b.clone(), r_t)
    }

    fn ranges(&self) -> [Interval<f64>; 2] {
        [self.d, self.r_b].map(|[from, to]| Interval::new(from, to))
    }

    fn line(&self, fixed: usize, index: u32, count: u32) -> (Along, f64) {
        let [from, to] = [self.d, self.r_b][fixed];
        let part = f64::from(index) / f64::from(count);
        let value = from * (1.0 - part) + to * part;
        let devices = *self;
        (Along { devices, fixed, value }, value)
    }

    fn is_symmetric(&self) -> bool {
        self.r_t.is_none()
    }
}

/// Devices along one of the parameters.
#[derive(Clone, Copy, Debug)]
struct Along {
    devices: Devices,
    fixed: usize,
    value: f64,
}

impl Family for Along {
    fn motion_at<T: Analytic>(&self, other: &T) -> Result<Motion<T>, MotionError> {
        let value = T::from_f64(self.value);
        let at = if self.fixed == 0 {
            [&value, other]
        } else {
            [other, &value]
        };
        ParameterPlane::motion_at(&self.devices, at)
    }

    fn is_symmetric(&self) -> bool {
        self.devices.r_t.is_none()
    }
}

impl Devices {
    fn curves(&self) -> Vec<Vec<CurvePoint>> {
        let curves = OneOneCurves::new(*self, 1, 8, &OrbitOptions::DEFAULT).expect("curves");
        assert!(curves.undecided().is_empty());
        curves.collect()
    }

    /// The place of a point, each side of the rectangle from 0 to 1.
    fn place(&self, point: &CurvePoint) -> [f64; 2] {
        let part = |[from, to]: [f64; 2], value: f64| (value - from) / (to - from);
        [part(self.d, point.motion.parameter), part(self.r_b, point.y)]
    }

    /// A line from one side of the rectangle to another.
    fn random_line(&self, sequence: &mut Sequence) -> Line {
        let sides = [sequence.draw() % 4, sequence.draw() % 3];
        let sides = [sides[0], (sides[0] + 1 + sides[1]) % 4];
        let ends = sides.map(|side| {
            let part = sequence.between(0.02, 0.98);
            let end = (side % 2) as f64;
            let [x, y] = if side < 2 { [end, part] } else { [part, end] };
            let at = |[from, to]: [f64; 2], part: f64| from * (1.0 - part) + to * part;
            [at(self.d, x), at(self.r_b, y)]
        });
        Line { devices: *self, ends }
    }
}

/// Where a piece of a curve crosses a line: the kind, the part of the line and the motion's first flight.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    kind: BifurcationKind,
    part: f64,
    time: f64,
}

/// The crossings of curves with a line, by linear interpolation.
fn crossings(line: &Line, curves: &[Vec<CurvePoint>]) -> Vec<Crossing> {
    let [from, to] = line.ends;
    let along = [to[0] - from[0], to[1] - from[1]];
    let beside = |point: &CurvePoint| {
        let [x, y] = [point.motion.parameter - from[0], point.y - from[1]];
        along[0] * y - along[1] * x
    };
    let mut found = Vec::new();
    for pair in curves.iter().flat_map(|curve| curve.windows(2)) {
        let [one, other] = [beside(&pair[0]), beside(&pair[1])];
        if one * other >= 0.0 {
            continue;
        }
        let share = one / (one - other);
        let between = |of: fn(&CurvePoint) -> f64| of(&pair[0]) * (1.0 - share) + of(&pair[1]) * share;
        let [x, y] = [between(|point| point.motion.parameter), between(|point| point.y)];
        let part = if along[0].abs() > along[1].abs() {
            (x - from[0]) / along[0]
        } else {
            (y - from[1]) / along[1]
        };
        let time = between(|point| point.motion.times[0]);
        if (0.0..=1.0).contains(&part) {
            found.push(Crossing {
                kind: pair[0].motion.kind,
                part,
                time,
            });
        }
    }
    found
}

/// Steps are chords: so far, in parts of the line and in time, a crossing of one may lie from that of its curve.
const APART: f64 = 0.02;

/// The crossings with random lines are the bifurcations along them: each has its own. Returns how many there were.
fn compare(devices: &Devices, curves: &[Vec<CurvePoint>], seed: u64, lines: usize) -> usize {
    let mut sequence = Sequence::new(seed);
    let mut seen = 0;
    for _ in 0..lines {
        let line = devices.random_line(&mut sequence);
        let (mut expected, open) = OneOneBranches::new(line, 1, Interval::new(0.0, 1.0), &OrbitOptions::DEFAULT)
            .expect("a cover")
            .bifurcations();
        assert!(open.is_empty(), "{line:?} {open:?}");
        expected.retain(|event| event.kind != BifurcationKind::NodeFocus);
        let mut found = crossings(&line, curves);
        for event in &expected {
            let apart = |crossing: &Crossing| {
                let apart = (crossing.part - event.parameter)
                    .abs()
                    .max((crossing.time - event.times[0]).abs());
                if crossing.kind == event.kind {
                    apart
                } else {
                    f64::INFINITY
                }
            };
            let nearest = (0..found.len()).min_by(|one, other| apart(&found[*one]).total_cmp(&apart(&found[*other])));
            let nearest = nearest.filter(|nearest| apart(&found[*nearest]) < APART);
            let nearest = nearest.unwrap_or_else(|| panic!("{line:?}: no curve at {event:?}; there are {found:?}"));
            found.swap_remove(nearest);
            seen += 1;
        }
        assert!(found.is_empty(), "{line:?}: no bifurcation at {found:?}");
    }
    seen
}

#[test]
fn a_few_random_lines_meet_curves_where_branches_bifurcate() {
    let curves = DEVICES[0].curves();
    assert!(compare(&DEVICES[0], &curves, 5, 8) > 20);
}

#[test]
#[ignore = "a minute: part of .ci/long"]
fn the_curves_cross_50_random_lines_where_branches_bifurcate() {
    for devices in DEVICES {
        let curves = devices.curves();
        let seen = compare(&devices, &curves, 2026, 50);
        println!("{devices:?}: {seen} crossings with 50 lines, none lost");
    }
}

/// The bifurcation of a kind on the line through a point, by the return map and its derivative in double-double: how
/// far along the line it is from the point.
fn shot(devices: &Devices, point: &CurvePoint, kind: BifurcationKind, fixed: usize) -> f64 {
    let values = [point.motion.parameter, point.y];
    let along = Along {
        devices: *devices,
        fixed,
        value: values[fixed],
    };
    let sign = if kind == BifurcationKind::PeriodDoubling {
        -1.0
    } else {
        1.0
    };
    let near = BifurcationPoint {
        kind,
        parameter: values[1 - fixed],
        trace: sign,
        ..point.motion.clone()
    };
    let found = shoot_bifurcation::<DoubleDouble>(&along, &near);
    let (parameter, _) = found.unwrap_or_else(|why| panic!("{kind:?} {why} {point:?}"));
    (parameter.to_f64() - near.parameter).abs()
}

/// Number `index` of a curve with the parameter that the curve moves less along.
fn across(devices: &Devices, curve: &[CurvePoint], index: usize) -> usize {
    let neighbours = [index.saturating_sub(1), (index + 1).min(curve.len() - 1)];
    let [one, other] = neighbours.map(|index| devices.place(&curve[index]));
    usize::from((other[1] - one[1]).abs() > (other[0] - one[0]).abs())
}

#[test]
fn every_point_is_proved_and_a_bifurcation_by_the_return_map_too() {
    let devices = &DEVICES[0];
    let mut names = Vec::new();
    for curve in devices.curves() {
        assert!(curve.len() > 2 && curve[0].is_joined.is_none());
        for (index, point) in curve.iter().enumerate() {
            assert_eq!(point.is_joined, (index > 0).then_some(true), "{point:?}");
            assert!(point.motion.error_bound.is_some_and(|bound| bound < 1e-12), "{point:?}");
            let inside = devices
                .place(point)
                .iter()
                .all(|part| (-1e-14..1.0 + 1e-14).contains(part));
            let on_side = devices
                .place(point)
                .iter()
                .any(|part| part.min(1.0 - part).abs() < 1e-12);
            assert!(inside && on_side == (point.special == SpecialPoint::Edge), "{point:?}");
            let kind = point.motion.kind;
            let second = match point.special {
                SpecialPoint::Step if index % 7 != 0 => continue,
                SpecialPoint::Step | SpecialPoint::Edge => None,
                SpecialPoint::Grazing | SpecialPoint::DoubleGrazing => Some(BifurcationKind::Grazing),
                SpecialPoint::Fold => Some(BifurcationKind::Fold),
                SpecialPoint::PeriodDoubling => Some(BifurcationKind::PeriodDoubling),
                SpecialPoint::Cusp => {
                    names.push(point.special);
                    folds_meet(devices, point);
                    continue;
                }
                other => panic!("{other} {point:?}"),
            };
            names.extend(second.map(|_| point.special));
            let fixed = across(devices, &curve, index);
            for kind in [Some(kind), second].into_iter().flatten() {
                let apart = shot(devices, point, kind, fixed);
                assert!(apart < 1e-11, "{kind:?} {apart} {point:?}");
            }
        }
    }
    for name in [
        SpecialPoint::Cusp,
        SpecialPoint::Grazing,
        SpecialPoint::Fold,
        SpecialPoint::PeriodDoubling,
    ] {
        assert!(names.contains(&name), "{name}");
    }
}

/// Along lines on one side of a cusp there are two folds near it, on the other side none.
fn folds_meet(devices: &Devices, cusp: &CurvePoint) {
    let at = [cusp.motion.parameter, cusp.y];
    let counts = [-1e-3, 1e-3].map(|beside| {
        let along = Along {
            devices: *devices,
            fixed: 0,
            value: at[0] + beside,
        };
        let near = Interval::new(at[1] - 0.02, at[1] + 0.02);
        let (found, open) = OneOneBranches::new(along, 1, near, &OrbitOptions::DEFAULT)
            .expect("a cover")
            .bifurcations();
        assert!(open.is_empty());
        found.iter().filter(|event| event.kind == BifurcationKind::Fold).count()
    });
    assert_eq!(counts, [2, 0]);
}

/// Motions of twice the period part from a period doubling to one side of it before a degenerate one, to the other behind it.
#[test]
fn at_a_degenerate_period_doubling_motions_of_twice_the_period_change_sides() {
    let devices = Devices {
        g: 0.12201,
        r_t: Some(0.9),
        d: [0.55, 0.68],
        r_b: [0.66, 0.75],
    };
    let curves = devices.curves();
    let points = curves.iter().flatten();
    let degenerate: Vec<&CurvePoint> = points
        .filter(|point| point.special == SpecialPoint::DegenerateFlip)
        .collect();
    let [point] = degenerate[..] else {
        panic!("{degenerate:?}")
    };
    assert!(point.motion.error_bound.is_some_and(|bound| bound < 1e-11) && point.is_joined == Some(true));
    assert!(shot(&devices, point, BifurcationKind::PeriodDoubling, 0) < 1e-11);
    let sides = [-0.03, 0.03].map(|beside| {
        let along = Along {
            devices,
            fixed: 0,
            value: point.motion.parameter + beside,
        };
        let range = Interval::new(point.y - 0.02, point.y + 0.02);
        let (events, _) = OneOneBranches::new(along, 1, range, &OrbitOptions::DEFAULT)
            .expect("a cover")
            .bifurcations();
        let doubling = |event: &&BifurcationPoint| event.kind == BifurcationKind::PeriodDoubling;
        let apart = |event: &BifurcationPoint| (event.parameter - point.y).abs();
        let doubling = events
            .iter()
            .filter(doubling)
            .min_by(|one, other| apart(one).total_cmp(&apart(other)));
        let doubling = doubling.expect("a period doubling");
        let word: Word = "BTBT".parse().expect("a word");
        let parts = |side: f64| {
            let r_b = doubling.parameter + 2e-6 * side;
            let found = find(&along.fixed(&r_b), &word, 2).expect("a search");
            let is_near =
                |orbit: &RoundedOrbit| (0..4).all(|i| (orbit.velocities[i] - doubling.velocities[i % 2]).abs() < 0.06);
            found.orbits.iter().any(|orbit| orbit.word == word && is_near(orbit))
        };
        [-1.0, 1.0].map(parts)
    });
    assert!(
        sides == [[true, false], [false, true]] || sides == [[false, true], [true, false]],
        "{sides:?}"
    );
}

/// Where an impact has velocity 0 and f + g is 0 curves of folds, period doublings and both grazings meet.
#[test]
fn a_degenerate_grazing_is_where_four_curves_meet() {
    let devices = Devices {
        g: 0.62,
        r_t: Some(0.4),
        d: [0.08, 0.13],
        r_b: [0.6, 0.8],
    };
    let curves = devices.curves();
    let all = || curves.iter().flatten();
    let degenerate: Vec<&CurvePoint> = all()
        .filter(|point| point.special == SpecialPoint::DegenerateGrazing)
        .collect();
    let first = degenerate.first().expect("a degenerate grazing");
    for point in &degenerate {
        let motion = &point.motion;
        assert!(motion.error_bound.is_some_and(|bound| bound < 1e-12), "{point:?}");
        let slow = usize::from(motion.velocities[1].abs() < motion.velocities[0].abs());
        let push = motion.phases[slow].cos() + devices.g;
        assert!(motion.velocities[slow].abs() < 1e-12 && push.abs() < 1e-12, "{point:?}");
        assert!((motion.parameter - first.motion.parameter).hypot(point.y - first.y) < 1e-12);
    }
    let here = |point: &&CurvePoint| (point.motion.parameter - first.motion.parameter).hypot(point.y - first.y) < 1e-12;
    let kinds: Vec<BifurcationKind> = all().filter(here).map(|point| point.motion.kind).collect();
    for kind in [
        BifurcationKind::Fold,
        BifurcationKind::PeriodDoubling,
        BifurcationKind::Grazing,
    ] {
        assert!(kinds.contains(&kind), "{kind} {kinds:?}");
    }
    assert!(degenerate.len() == 2 && curves.iter().all(|curve| curve.len() < 1500));
}

/// Without gravity a ball of r_B = r_T breaks its symmetry where the folds of unlike walls meet.
#[test]
fn the_cusp_without_gravity_is_where_the_symmetry_breaks() {
    let devices = Devices {
        g: 0.0,
        r_t: Some(0.5),
        d: [0.2, 0.4],
        r_b: [0.3, 0.8],
    };
    let curves = devices.curves();
    let cusps: Vec<&CurvePoint> = curves
        .iter()
        .flatten()
        .filter(|point| point.special == SpecialPoint::Cusp)
        .collect();
    let [cusp] = cusps[..] else { panic!("{cusps:?}") };
    let symmetric = Motion::new(0.0, 0.3, 0.5, 0.5).expect("a motion");
    let (events, _) = OneOneBranches::new(symmetric, 1, Interval::new(0.2, 0.4), &OrbitOptions::DEFAULT)
        .expect("a cover")
        .bifurcations();
    let breaking = events
        .iter()
        .find(|event| event.kind == BifurcationKind::SymmetryBreaking);
    let breaking = breaking.expect("a symmetry breaking");
    assert!((cusp.motion.parameter - breaking.parameter).abs() < 1e-12 && (cusp.y - 0.5).abs() < 1e-12);
    assert!((cusp.motion.times[0] - 1.0).abs() < 1e-12);
    // the ball that stands still touches both walls at d = 4/(2 pi²), whatever they are
    let still = 2.0 / (PI * PI);
    let stands = |curve: &&Vec<CurvePoint>| curve.iter().all(|point| (point.motion.parameter - still).abs() < 1e-12);
    let standing = curves
        .iter()
        .filter(|curve| curve.len() > 2)
        .find(stands)
        .expect("a curve");
    assert!(standing.iter().all(|point| point.is_joined != Some(false)));
}

/// Devices over g and r = r_B = r_T, at one gap.
#[derive(Clone, Copy, Debug)]
struct LikeWalls {
    d: f64,
    g: [f64; 2],
    r: [f64; 2],
}

/// Those with one of the two parameters fixed.
#[derive(Clone, Copy, Debug)]
struct OfLikeWalls {
    d: f64,
    fixed: usize,
    value: f64,
}

impl Family for OfLikeWalls {
    fn motion_at<T: Analytic>(&self, other: &T) -> Result<Motion<T>, MotionError> {
        let value = T::from_f64(self.value);
        let [g, r] = if self.fixed == 0 {
            [value, other.clone()]
        } else {
            [other.clone(), value]
        };
        Motion::new(g, T::from_f64(self.d), r.clone(), r)
    }

    fn is_symmetric(&self) -> bool {
        false
    }
}

impl ParameterPlane for LikeWalls {
    type Line = OfLikeWalls;

    fn motion_at<T: Analytic>(&self, [g, r]: [&T; 2]) -> Result<Motion<T>, MotionError> {
        Motion::new(g.clone(), T::from_f64(self.d), r.clone(), r.clone())
    }

    fn ranges(&self) -> [Interval<f64>; 2] {
        [self.g, self.r].map(|[from, to]| Interval::new(from, to))
    }

    fn line(&self, fixed: usize, index: u32, count: u32) -> (OfLikeWalls, f64) {
        let [from, to] = [self.g, self.r][fixed];
        let part = f64::from(index) / f64::from(count);
        let value = from * (1.0 - part) + to * part;
        let d = self.d;
        (OfLikeWalls { d, fixed, value }, value)
    }

    fn is_symmetric(&self) -> bool {
        false
    }
}

/// Around the degenerate grazing at g = -.28997, r = .33914.
const NEAR_DEGENERATE: LikeWalls = LikeWalls {
    d: 0.3462,
    g: [-0.295, -0.27],
    r: [0.30, 0.35],
};

/// Touches close to a degenerate grazing, by an independent solution of (9) to (12) and of the touch.
#[test]
fn a_curve_of_touches_is_followed_through_the_neighbourhood_of_a_degenerate_grazing() {
    for [r, g] in [
        [0.3345, -0.287_641_494_139_692],
        [0.335, -0.287_893_505_854_113],
        [0.336, -0.288_397_039_515_872],
        [0.337, -0.288_899_833_330_255],
        [0.338, -0.289_401_721_059_183],
    ] {
        let plane = LikeWalls {
            r: [0.30, r],
            ..NEAR_DEGENERATE
        };
        let found = OneOneCurves::new(plane, 2, 1, &OrbitOptions::DEFAULT).expect("curves");
        assert!(found.undecided().is_empty());
        let curves: Vec<Vec<CurvePoint>> = found.collect();
        // the values have 15 decimals
        let is_at = |point: &CurvePoint| point.y == r && (point.motion.parameter - g).abs() < 1e-14;
        let ends = |curve: &&Vec<CurvePoint>| is_at(&curve[0]) || is_at(&curve[curve.len() - 1]);
        let through: Vec<&Vec<CurvePoint>> = curves.iter().filter(ends).collect();
        let [curve] = through[..] else {
            panic!("{} curves lead to {g} {r}", through.len());
        };
        assert!(curve.iter().all(|point| point.motion.kind == BifurcationKind::Grazing));
        let other = if is_at(&curve[0]) {
            &curve[curve.len() - 1]
        } else {
            &curve[0]
        };
        assert!(other.special == SpecialPoint::Edge && curve.len() > 20, "{other:?}");
        for point in curves.iter().flatten() {
            assert!(
                point.special != SpecialPoint::Lost && point.is_joined != Some(false),
                "{point:?}"
            );
        }
    }
}

/// A curve of touches has the point where it ends: there the touch and its impact are one.
#[test]
fn a_curve_of_touches_ends_at_a_degenerate_grazing_to_which_every_step_is_proved() {
    let found = OneOneCurves::new(NEAR_DEGENERATE, 2, 1, &OrbitOptions::DEFAULT).expect("curves");
    assert!(found.undecided().is_empty());
    let curves: Vec<Vec<CurvePoint>> = found.collect();
    let ends = curves.iter().flat_map(|curve| [&curve[0], &curve[curve.len() - 1]]);
    let degenerate = ends
        .filter(|end| end.motion.kind == BifurcationKind::Grazing && end.special == SpecialPoint::DegenerateGrazing);
    // of the four curves that meet there only that of touches ends as a grazing
    assert_eq!(degenerate.count(), 1);
    for point in curves.iter().flatten() {
        assert!(
            point.special != SpecialPoint::Lost && point.is_joined != Some(false),
            "{point:?}"
        );
    }
}

#[test]
fn a_curve_that_is_left_before_its_end_says_so() {
    let few = OrbitOptions {
        most_steps: 3,
        ..OrbitOptions::DEFAULT
    };
    let curves: Vec<Vec<CurvePoint>> = OneOneCurves::new(NEAR_DEGENERATE, 2, 1, &few)
        .expect("curves")
        .collect();
    assert!(!curves.is_empty());
    let has_end = |point: &CurvePoint| match point.special {
        SpecialPoint::Edge | SpecialPoint::Grazing | SpecialPoint::DegenerateGrazing => true,
        SpecialPoint::Lost => false,
        other => panic!("a curve ends at a {other}"),
    };
    let ends: Vec<bool> = curves
        .iter()
        .flat_map(|curve| [has_end(&curve[0]), has_end(&curve[curve.len() - 1])])
        .collect();
    assert!(ends.contains(&true) && ends.contains(&false), "{ends:?}");
}
