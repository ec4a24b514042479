//! The events of a motion, one after the other, as they are listed.

use super::any_course::AnyCourse;
use super::chatter::LISTED;
use super::event::{Event, Kind};
use super::growth::Growth;
use super::scaled::Departure;
use super::start::Start;
use super::waves::Cosine;
#[cfg(any(test, feature = "calls"))]
use crate::model::calls::{self, Call};
use crate::model::{Motion, Side};
use numbers::Analytic;

/// A chatter of more impacts below [`LISTED`] than this is not completed but listed, as one that never ends.
const MOST_HIDDEN: usize = 100_000_000;

/// A motion from a start on, under its own forcing; an iterator over its events, the start impact first. A start in flight
/// is no event: the first is the impact that ends it.
///
/// Impacts are found without a time step: none is missed or invented that rounding does not hide, and one that it
/// hides is an event of the kind [`Kind::Undecided`], the last one; so is a start that is no impact (NaN, infinite, away
/// from its wall). Impacts of a chatter that completes are listed
/// down to [`LISTED`]; its rest follows at the phase where they accumulate, exact to the precision of the number, then
/// the release where f + g changes its sign, at cos(phase) = -g under the forcing of the paper. The motion ends after a rest that nothing releases (|g| >= 1), after an undecided
/// contact, and where the ball never reaches a wall again.
///
/// Phase and velocity of each impact are those of the map from the impact before to a few roundings of the number;
/// how such errors grow from one to the next is what [`Growth`] follows.
///
/// Source: (3), (4), (8); the ends of chatter from the expansion in chatter.rs.
#[derive(Clone, Debug)]
pub struct Simulation<T: Analytic> {
    pub(super) course: AnyCourse<T>,
    pub(super) growth: Growth,
    is_tracked: bool,
    has_started: bool,
    /// The events since the last impact that was listed.
    idle: u32,
    /// Whether a chatter that does not complete is being listed whole.
    exhaustive: bool,
}

impl<T: Analytic> Simulation<T> {
    /// The motion from `start` on.
    pub fn new(motion: &Motion<T>, start: &Start<T>) -> Self {
        Self::of(AnyCourse::new(motion, start), start.position.is_some())
    }

    /// The motion of a ball that rests on `side`, from its release on, which is the first event: at the phase of release
    /// nearest to `near`, rad, where there are several; `None` where nothing ever releases it.
    pub fn released(motion: &Motion<T>, side: Side, near: f64) -> Option<Self> {
        Some(Self::of(AnyCourse::released(motion, side, near)?, true))
    }

    fn of(course: AnyCourse<T>, has_started: bool) -> Self {
        Self {
            growth: course.growth(),
            course,
            is_tracked: false,
            has_started,
            idle: 0,
            exhaustive: false,
        }
    }

    /// The same, following how rounding errors grow; some tens of nanoseconds more per impact.
    pub fn with_growth(mut self) -> Self {
        self.is_tracked = true;
        self
    }

    /// The same, no longer following how rounding errors grow: from here on nothing is claimed.
    pub(super) fn without_growth(mut self) -> Self {
        self.is_tracked = false;
        self.growth.lose();
        self
    }

    /// The same, completing a chatter in closed form as soon as that leaves no more than this error of the phase: in a
    /// wide number of which few digits are asked, that spares hundreds of impacts.
    pub fn completing_to(mut self, error: f64) -> Self {
        self.course.complete_to(error);
        self
    }

    /// Whether the ball has been rested and released twice over without an impact of [`LISTED`] or more: a release forgets
    /// what was before, so that this goes on for ever.
    pub fn is_idle(&self) -> bool {
        self.idle > 4
    }

    /// Whether the same motion, at another of its impacts, goes on from there as from here, number for number: it goes
    /// round for ever. False where that cannot be told.
    pub fn goes_on_like(&self, other: &Self) -> bool {
        self.exhaustive == other.exhaustive && self.course.goes_on_like(&other.course)
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
        self.has_started = true;
        self.growth.lose();
    }

    /// Goes on from an impact of [`LISTED`] or more, so many turns after the start.
    pub(super) fn depart(&mut self, from: Departure<T, Cosine<T>>, turns: i64) {
        self.course.depart(from, turns);
        (self.has_started, self.exhaustive, self.idle) = (true, false, 0);
    }

    /// The next event of a flight whose end this number cannot tell, in a wider one, if that can.
    pub(super) fn widened<U: Analytic>(&self, motion: &Motion<U>, convert: impl Fn(&T) -> U) -> Option<Event<U>> {
        let mut wider = Simulation::of(self.course.widened(motion, convert)?, true);
        wider.next().filter(|event| event.kind != Kind::Undecided)
    }

    #[inline(always)]
    fn advance(&mut self) -> Option<Event<T>> {
        #[cfg(any(test, feature = "calls"))]
        calls::count(Call::Step);
        if !self.is_tracked {
            return self.course.advance(());
        }
        #[cfg(any(test, feature = "calls"))]
        calls::count(Call::Growth);
        self.course.advance(&mut self.growth)
    }

    /// The rest that the chatter which goes on with `event` ends with, if it does.
    fn completion(&self, event: &Event<T>) -> Option<(Self, Event<T>)> {
        let mut ahead = self.clone();
        for _ in 0..MOST_HIDDEN {
            let next = ahead.advance()?;
            match next.kind {
                Kind::Rest => return Some((ahead, next)),
                Kind::Impact if next.side == event.side && next.velocity.to_f64().abs() < LISTED => {}
                _ => return None,
            }
        }
        None
    }

    /// The next event that is listed.
    #[inline(always)]
    fn listed(&mut self) -> Option<Event<T>> {
        let event = self.advance()?;
        let is_start = !std::mem::replace(&mut self.has_started, true);
        if event.kind != Kind::Impact || event.velocity.to_f64().abs() >= LISTED {
            self.exhaustive = false;
            return Some(event);
        }
        // the start impact is a row, however slow
        let never_completes = self.course.is_lossless(event.side);
        if self.exhaustive || is_start || never_completes {
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

impl<T: Analytic> Iterator for Simulation<T> {
    type Item = Event<T>;

    // a call that hands the event over in memory would cost as much as the rest of a step besides the flight
    #[inline(always)]
    fn next(&mut self) -> Option<Event<T>> {
        let event = self.listed()?;
        self.idle = if event.kind == Kind::Impact { 0 } else { self.idle + 1 };
        Some(event)
    }
}

#[cfg(test)]
mod tests;
