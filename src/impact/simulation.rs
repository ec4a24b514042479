//! The events of a motion, one after the other, as they are listed.

use super::course::{Course, Step};
use super::event::{Event, Kind};
use super::growth::Growth;
use crate::model::{Motion, Side};
use crate::number::Analytic;

/// Impacts of a chatter that completes are listed down to this velocity.
pub const LISTED: f64 = 1e-6;

/// A chatter of more impacts below [`LISTED`] than this is not completed but listed, as one that never ends.
const MOST_HIDDEN: usize = 100_000_000;

/// The impact that a motion starts with.
#[derive(Clone, Debug, PartialEq)]
pub struct Start<T> {
    /// The wall.
    pub side: Side,
    /// The phase of the forcing, rad; any.
    pub phase: T,
    /// Zdot just before: at least 0 at the bottom, at most 0 at the top.
    pub velocity: T,
}

impl<T> Start<T> {
    /// The same start over another number.
    pub fn convert<U>(&self, convert: impl Fn(&T) -> U) -> Start<U> {
        Start {
            side: self.side,
            phase: convert(&self.phase),
            velocity: convert(&self.velocity),
        }
    }
}

impl<T: Analytic> From<&Event<T>> for Start<T> {
    fn from(event: &Event<T>) -> Self {
        Self {
            side: event.side,
            phase: event.phase.clone(),
            velocity: event.velocity.clone(),
        }
    }
}

/// A motion from a start on; an iterator over its events, the start impact first.
///
/// Impacts are found without a time step: none is missed or invented that rounding does not hide, and one that it
/// hides is an event of the kind [`Kind::Undecided`], the last one. Impacts of a chatter that completes are listed
/// down to [`LISTED`]; its rest follows at the phase where they accumulate, exact to the precision of the number, then
/// the release at cos(phase) = -g. The motion ends after a rest that nothing releases (|g| >= 1), after an undecided
/// contact, and where the ball never reaches a wall again.
///
/// Phase and velocity of each impact are those of the map from the impact before to a few roundings of the number;
/// how such errors grow from one to the next is what [`Growth`] follows.
///
/// Source: (3), (4), (8); the ends of chatter from the expansion in chatter.rs.
#[derive(Clone, Debug)]
pub struct Simulation<T> {
    course: Course<T>,
    growth: Growth,
    is_tracked: bool,
    /// Whether a chatter that does not complete is being listed whole.
    exhaustive: bool,
}

impl<T: Analytic> Simulation<T> {
    /// The motion from `start` on.
    pub fn new(motion: &Motion<T>, start: &Start<T>) -> Self {
        let course = Course::new(motion, start);
        Self {
            growth: Growth::new(course.scaled()),
            course,
            is_tracked: false,
            exhaustive: false,
        }
    }

    /// The same, following how rounding errors grow; some tens of nanoseconds more per impact.
    pub fn with_growth(mut self) -> Self {
        self.is_tracked = true;
        self
    }

    /// How rounding errors have grown up to the latest event; `None` where it is not followed.
    pub fn growth(&self) -> Option<&Growth> {
        self.is_tracked.then_some(&self.growth)
    }

    pub(super) fn tracked(&self) -> &Growth {
        &self.growth
    }

    /// Goes on after `event`, whatever this motion came to by itself; of what follows nothing is claimed.
    pub(super) fn resume(&mut self, event: &Event<T>) {
        self.course.resume(event);
        self.growth.lose();
    }

    fn advance(&mut self) -> Option<(Event<T>, Step<T>)> {
        let (event, step) = self.course.advance()?;
        if self.is_tracked {
            self.growth.follow(self.course.scaled(), &event, &step);
        }
        Some((event, step))
    }

    /// The rest that the chatter which goes on with `event` ends with, if it does.
    fn completion(&self, event: &Event<T>) -> Option<(Self, Event<T>)> {
        let mut ahead = self.clone();
        for _ in 0..MOST_HIDDEN {
            let (next, _) = ahead.advance()?;
            match next.kind {
                Kind::Rest => return Some((ahead, next)),
                Kind::Impact if next.side == event.side && next.velocity.to_f64().abs() < LISTED => {}
                _ => return None,
            }
        }
        None
    }
}

impl<T: Analytic> Iterator for Simulation<T> {
    type Item = Event<T>;

    fn next(&mut self) -> Option<Event<T>> {
        let (event, step) = self.advance()?;
        if event.kind != Kind::Impact || event.velocity.to_f64().abs() >= LISTED {
            self.exhaustive = false;
            return Some(event);
        }
        // the start impact is a row, however slow
        if self.exhaustive || matches!(step, Step::Start) {
            return Some(event);
        }
        match self.completion(&event) {
            Some((ahead, rest)) => {
                *self = ahead;
                Some(rest)
            }
            None => {
                self.exhaustive = true;
                Some(event)
            }
        }
    }
}
