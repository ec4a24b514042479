//! Enclosures against wider numbers.

use super::*;
use crate::impact::Simulation;
use numbers::{Sequence, Wide};

type Digits = Wide<60>;

fn enclosure<E: Endpoint>(motion: &Motion<f64>, start: &Start<f64>) -> Enclosure<E> {
    let motion = motion.convert(|value| Interval::from_f64(*value)).expect("a motion");
    Enclosure::new(&motion, &start.convert(|value| Interval::from_f64(*value)))
}

/// The events that are proved, each checked against many digits; and whether the last of them is really the last.
fn proved<E: Endpoint>(motion: &Motion<f64>, start: &Start<f64>, count: usize) -> usize {
    let wide = motion.convert(|value| Digits::from_f64(*value)).expect("a motion");
    let mut followed = Simulation::new(&wide, &start.convert(|value| Digits::from_f64(*value)));
    let mut enclosed = enclosure::<E>(motion, start);
    for number in 0..count {
        let said = format!("{motion:?} {start:?} event {number}");
        let Some(event) = enclosed.next() else {
            assert_eq!(followed.next(), None, "{said}");
            return number;
        };
        if event.kind == Kind::Undecided {
            assert_eq!(enclosed.next(), None, "{said}");
            return number;
        }
        let exact = followed.next().expect(&said);
        assert_eq!((event.kind, event.side), (exact.kind, exact.side), "{said}");
        let turns = Digits::from_integer(2 * (exact.turns - event.turns)) * Digits::pi();
        for (enclosed, exact) in [(&event.phase, exact.phase + turns), (&event.velocity, exact.velocity)] {
            let below = Digits::from_f64(enclosed.low().to_f64().next_down());
            let above = Digits::from_f64(enclosed.high().to_f64().next_up());
            assert!(Interval::new(below, above).contains(&exact), "{said}: {event:?}");
        }
    }
    count
}

fn drawn(drawn: &mut Sequence) -> (Motion<f64>, Start<f64>) {
    let mut draw = |low, high| drawn.between(low, high);
    // a third each of gravity as drawn, none and almost as strong as the forcing, and of losses
    let g = [draw(-1.4, 1.4), 0.0, 1.0 + draw(-1e-8, 1e-8), draw(-1e-9, 1e-9)];
    let restitutions = [[draw(0.05, 1.0), draw(0.05, 1.0)], [1.0, 1.0], [1e-9, 0.5]];
    let g = g[draw(0.0, 4.0) as usize];
    let [r_b, r_t] = restitutions[draw(0.0, 3.0) as usize];
    let motion = Motion::new(g, 10_f64.powf(draw(-4.0, 2.0)), r_b, r_t).expect("a motion");
    let velocity = [0.0, 1e-8, draw(0.0, 3.0), draw(0.0, 3.0)][draw(0.0, 4.0) as usize];
    let side = [Side::Bottom, Side::Top][draw(0.0, 2.0) as usize];
    let start = Start::impact(side, draw(-50.0, 50.0), side.signed(velocity));
    (motion, start)
}

#[test]
fn every_event_lies_in_its_enclosure_and_none_is_missed_or_invented() {
    let mut sequence = Sequence::new(2026);
    let mut events = 0;
    for number in 0..120 {
        let (motion, start) = drawn(&mut sequence);
        events += match number % 4 {
            0 => proved::<Wide<30>>(&motion, &start, 20),
            _ => proved::<f64>(&motion, &start, 40),
        };
    }
    assert!(events > 2000, "{events}");
}

#[test]
fn on_a_motion_that_attracts_enclosures_stay_as_narrow_as_they_are() {
    let motion = Motion::new(0.12201, 0.26, 0.6, 0.3).expect("a motion");
    let start = Start::impact(Side::Bottom, 6.18, 0.5293);
    let mut events = enclosure::<f64>(&motion, &start);
    let widest = events
        .by_ref()
        .take(2000)
        .map(|event| event.phase.width())
        .fold(0.0, f64::max);
    assert!(widest < 1e-11, "{widest}");
    assert_eq!(events.next().map(|event| event.kind), Some(Kind::Impact));
}

#[test]
fn what_is_no_start_is_no_event() {
    let motion = Motion::new(0.1, 0.26, 0.6, 0.3).expect("a motion");
    for (phase, velocity) in [(f64::NAN, 1.0), (1.0, -1.0), (1.0, f64::INFINITY), (1e300, 1.0)] {
        let start = Start::impact(Side::Bottom, phase, velocity);
        let kinds: Vec<Kind> = enclosure::<f64>(&motion, &start)
            .map(|event| event.kind)
            .take(3)
            .collect();
        assert_eq!(kinds, [Kind::Undecided], "{phase} {velocity}");
    }
}
