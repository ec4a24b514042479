//! Small systems whose solutions are known by hand.

use super::*;
use crate::orbit::solve::krawczyk::{distinct_phases, is_shifted};
use numbers::Analytic;
use numbers::{DoubleDouble, Field};

/// x² + y² = 1 and y = level.
struct Circle {
    level: f64,
}

impl<E: Endpoint> SquareSystem<E, 2> for Circle {
    fn linearised(&self, [x, y]: &IntervalBox<E, 2>) -> (IntervalBox<E, 2>, [IntervalBox<E, 2>; 2]) {
        let (one, two) = (Interval::<E>::from_integer(1), Interval::<E>::from_integer(2));
        let values = [
            x.square() + y.square() - one.clone(),
            y.clone() - Interval::from_f64(self.level),
        ];
        let slopes = [
            [two.clone() * x.clone(), two * y.clone()],
            [Interval::from_integer(0), one],
        ];
        (values, slopes)
    }
}

/// (phase, x): sin(phase) = x, x = 1/2.
struct Sine;

impl SquareSystem<f64, 2> for Sine {
    fn linearised(&self, [phase, x]: &IntervalBox<f64, 2>) -> (IntervalBox<f64, 2>, [IntervalBox<f64, 2>; 2]) {
        let (sin, cos) = phase.sincos();
        let [zero, one] = [0, 1].map(Interval::from_integer);
        ([sin - *x, *x - Interval::from_ratio(1, 2)], [[cos, -one], [zero, one]])
    }
}

fn square<E: Endpoint>(reach: f64) -> IntervalBox<E, 2> {
    // not around 0, so that no cell is cut at a solution
    let side = Interval::new(E::from_f64(-reach), E::from_f64(1.1 * reach));
    [side.clone(), side]
}

fn found<E: Endpoint>(level: f64) -> Isolation<E, 2> {
    let limits = SearchLimits {
        finest: 1e-9,
        most_cells: 20_000,
    };
    isolate(&Circle { level }, vec![square(3.0)], Vec::new(), limits)
}

#[test]
fn two_crossings_are_two_roots_and_each_enclosure_holds_its_own() {
    let found = found::<f64>(0.6);
    assert!(found.is_complete() && found.roots.len() == 2, "{:?}", found.roots);
    for exact in [-0.8, 0.8] {
        let holds = |root: &&ProvedRoot<f64, 2>| (root.enclosure[0].midpoint() - exact).abs() < 1e-15;
        assert_eq!(found.roots.iter().filter(holds).count(), 1);
    }
    for root in &found.roots {
        assert!(root.enclosure.iter().all(|side| side.width() < 1e-14));
        assert!(is_subset(&root.enclosure, &root.unique));
    }
}

#[test]
fn two_roots_a_millionth_apart_are_told_apart() {
    // x = ±sqrt(1 - level²), 5e-7 from 0
    let found = found::<f64>(1.0 - 1.25e-13);
    assert!(found.is_complete() && found.roots.len() == 2, "{found:?}");
}

#[test]
fn a_double_root_is_undecided_and_no_root() {
    let found = found::<f64>(1.0);
    assert!(found.roots.is_empty() && !found.undecided.is_empty());
    assert!(
        found
            .undecided
            .iter()
            .any(|cell| cell[0].contains(&0.0) && cell[1].contains(&1.0))
    );
}

#[test]
fn what_f64_leaves_undecided_a_wider_number_decides() {
    // nearer than cells get in f64
    let level = 1.0 - f64::EPSILON;
    let fine = SearchLimits {
        finest: 1e-18,
        most_cells: 20_000,
    };
    let near = [Interval::new(-1e-6, 1.1e-6), Interval::new(0.999, 1.001)];
    let near = near.map(|side| Interval::new(DoubleDouble::from_f64(side.low()), DoubleDouble::from_f64(side.high())));
    let found = isolate(&Circle { level }, vec![near], Vec::new(), fine);
    assert!(found.is_complete() && found.roots.len() == 2, "{found:?}");
}

#[test]
fn where_there_is_no_root_every_cell_says_so() {
    let found = found::<f64>(1.1);
    assert!(found.roots.is_empty() && found.is_complete());
    let none = |decision: &Decision| matches!(decision, Decision::Excluded(_) | Decision::Emptied);
    assert!(found.decided.iter().all(|(_, decision)| none(decision)));
}

#[test]
fn cells_that_run_out_leave_the_rest_undecided() {
    let limits = SearchLimits {
        finest: 1e-9,
        most_cells: 3,
    };
    let found = isolate(&Circle { level: 0.6 }, vec![square::<f64>(3.0)], Vec::new(), limits);
    assert!(!found.is_complete());
}

#[test]
fn no_proof_where_no_root_is_two_are_or_one_is_double() {
    let prove = |level: f64, point: [f64; 2], half: f64| prove(&Circle { level }, &point, &[half, half]);
    assert!(prove(1.1, [0.0, 1.1], 0.5).is_none());
    assert!(prove(0.6, [0.0, 0.6], 0.9).is_none());
    assert!(prove(1.0, [0.0, 1.0], 1e-3).is_none());
    assert!(prove(0.6, [1.2, 0.6], 0.1).is_none(), "a root beside the box");
    assert!(prove(0.6, [0.81, 0.6], 0.1).is_some());
}

#[test]
fn a_root_in_a_box_that_its_first_image_nearly_fills_is_narrowed_to_rounding() {
    // the largest box that proves the root, up to a thousandth
    let wide = (1..1000).rev().map(|part| f64::from(part) * 1e-3);
    let root = wide
        .into_iter()
        .find_map(|half| prove(&Circle { level: 0.6 }, &[0.8, 0.6], &[half, half]));
    let root = root.expect("a proof");
    assert!(
        root.unique[0].width() > 0.5 && root.enclosure[0].width() < 1e-14,
        "{root:?}"
    );
}

#[test]
fn a_root_found_again_a_turn_later_is_one() {
    let limits = SearchLimits {
        finest: 1e-9,
        most_cells: 20_000,
    };
    let cells = vec![[Interval::new(-3.0, 9.0), Interval::new(-1.0, 1.0)]];
    let found = isolate(&Sine, cells, Vec::new(), limits);
    // pi/6 and 5 pi/6, and both a turn later
    assert_eq!(found.roots.len(), 4);
    assert_eq!(distinct_phases(found.roots.clone(), 0).len(), 2);
    assert!(is_shifted(&found.roots[0], &found.roots[0], 0));
}

#[test]
fn known_roots_stand_first_and_are_not_found_twice() {
    let known = prove(&Circle { level: 0.6 }, &[0.8, 0.6], &[0.1, 0.1]).expect("a proof");
    let limits = SearchLimits {
        finest: 1e-9,
        most_cells: 20_000,
    };
    let found = isolate(&Circle { level: 0.6 }, vec![square(3.0)], vec![known.clone()], limits);
    assert_eq!(found.roots.len(), 2, "{:?}", found.roots);
    assert_eq!(found.roots[0], known);
}
