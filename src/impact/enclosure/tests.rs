//! Enclosures against wider numbers.

use super::*;
use crate::impact::Simulation;
use crate::number::{Sequence, Wide};
use std::f64::consts::TAU;

type Digits = Wide<60>;

fn enclosure<E: Endpoint>(motion: &Motion<f64>, start: &Start<f64>) -> Enclosure<E> {
    let motion = motion.convert(|value| Interval::from_f64(*value)).expect("a motion");
    Enclosure::new(&motion, &start.convert(|value| Interval::from_f64(*value)))
}

/// The events of a motion and their enclosures, as far as either tells.
fn agree<E: Endpoint>(motion: &Motion<f64>, start: &Start<f64>, count: usize) -> usize {
    let wide = motion.convert(|value| Digits::from_f64(*value)).expect("a motion");
    let followed = Simulation::new(&wide, &start.convert(|value| Digits::from_f64(*value)));
    let mut proved = 0;
    for (event, exact) in enclosure::<E>(motion, start).zip(followed).take(count) {
        if event.kind == Kind::Undecided {
            break;
        }
        let said = format!("{motion:?} {start:?} event {proved}: {event:?} and {exact:?}");
        assert_eq!((event.kind, event.side), (exact.kind, exact.side), "{said}");
        let [phase, velocity] = [&event.phase, &event.velocity].map(|value| {
            let [low, high] = [value.low(), value.high()].map(|end| end.to_f64());
            Interval::new(Digits::from_f64(low).below(), Digits::from_f64(high).above())
        });
        let turns = Digits::from_integer(2 * (exact.turns - event.turns)) * Digits::pi();
        let closed = |value: &Interval<Digits>, exact: &Digits| value.contains(exact);
        assert!(closed(&phase, &(exact.phase.clone() + turns)), "{said}");
        assert!(closed(&velocity, &exact.velocity), "{said}");
        proved += 1;
    }
    proved
}

#[test]
fn every_event_lies_in_its_enclosure_and_none_is_missed_or_invented() {
    let mut drawn = Sequence::new(2026);
    let mut proved = 0;
    for _ in 0..60 {
        let mut draw = |low, high| drawn.between(low, high);
        let motion = Motion::new(draw(-1.4, 1.4), draw(0.05, 2.0), draw(0.05, 1.0), draw(0.05, 1.0)).expect("a motion");
        let start = Start {
            side: Side::Bottom,
            phase: draw(0.0, TAU),
            velocity: draw(0.0, 3.0),
        };
        let n = agree::<f64>(&motion, &start, 60);
        println!("{motion:?} {start:?} {n}");
        proved += n;
    }
    assert!(proved > 1000, "{proved}");
}
