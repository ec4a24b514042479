//! What a simulated motion is spelled with: impacts, and chatters that come to rest.

use crate::impact::{Event, Kind};
use crate::model::Side;
use std::f64::consts::TAU;

/// One impact, or a chatter that comes to rest.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// The wall.
    pub side: Side,
    /// Whether it is a chatter that comes to rest.
    pub rests: bool,
    /// The instant of the first impact.
    pub turns: i64,
    pub phase: f64,
    /// In size, of the first impact.
    pub speed: f64,
    /// Where its events begin in the list, and where they end.
    pub from: usize,
    pub to: usize,
}

impl Symbol {
    pub fn text(&self) -> &'static str {
        match (self.side, self.rests) {
            (Side::Bottom, false) => "B",
            (Side::Top, false) => "T",
            (Side::Bottom, true) => "B*",
            (Side::Top, true) => "T*",
        }
    }

    /// The whole turns from `before` to here, where this is the same event again to a tolerance: of the phase, rad, and
    /// of the speed as a part of `scale`.
    pub fn turns_since(&self, before: &Self, scale: f64, tolerance: f64) -> Option<i64> {
        let apart = self.phase - before.phase;
        let wrapped = (apart / TAU).round();
        let same = self.side == before.side
            && self.rests == before.rests
            && (apart - wrapped * TAU).abs() <= tolerance
            && (self.speed - before.speed).abs() <= tolerance * scale;
        // the phases are in [0, 2 pi): wrapped is -1, 0 or 1
        same.then_some(self.turns - before.turns + wrapped as i64)
    }
}

/// The symbols of a list of events: all impacts on one wall that lead to a rest without another event between are one.
pub fn symbols(events: &[Event<f64>]) -> Vec<Symbol> {
    let mut symbols = Vec::with_capacity(events.len());
    for (index, event) in events.iter().enumerate() {
        add(&mut symbols, index, event);
    }
    symbols
}

/// Adds what event number `index` says to the symbols before it.
pub fn add(symbols: &mut Vec<Symbol>, index: usize, event: &Event<f64>) {
    let mut letter = Symbol {
        side: event.side,
        rests: event.kind == Kind::Rest,
        turns: event.turns,
        phase: event.phase,
        speed: event.velocity.abs(),
        from: index,
        to: index + 1,
    };
    match event.kind {
        Kind::Impact => symbols.push(letter),
        Kind::Rest => {
            while let Some(first) = symbols.pop_if(|last| !last.rests && last.side == event.side) {
                letter = Symbol {
                    rests: true,
                    to: index + 1,
                    ..first
                };
            }
            symbols.push(letter);
        }
        Kind::Release | Kind::Undecided => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chatter_takes_in_all_impacts_on_its_wall_since_the_last_other_event() {
        let event = |kind, side, turns| Event {
            kind,
            side,
            turns,
            phase: 1.0,
            velocity: 0.5,
        };
        let (top, bottom) = (Side::Top, Side::Bottom);
        let events = [
            event(Kind::Impact, top, 0),
            event(Kind::Impact, bottom, 1),
            event(Kind::Impact, bottom, 2),
            event(Kind::Rest, bottom, 3),
            event(Kind::Release, bottom, 4),
            event(Kind::Impact, bottom, 5),
            event(Kind::Impact, bottom, 6),
            event(Kind::Rest, bottom, 7),
            event(Kind::Impact, bottom, 8),
        ];
        let symbols = symbols(&events);
        let spelled: Vec<&str> = symbols.iter().map(Symbol::text).collect();
        assert_eq!(spelled, ["T", "B*", "B*", "B"]);
        assert_eq!((symbols[1].turns, symbols[2].turns), (1, 5));
        assert_eq!((symbols[1].from, symbols[1].to), (1, 4));
    }
}
