//! What a motion does after many impacts.

use crate::impact::{Event, Kind};
use crate::orbit::long_run::attractor::Attractor;
use crate::orbit::long_run::resting::Releases;
use crate::orbit::options::OrbitOptions;
use stop;

/// The impacts among which a cycle is looked for, at least: two cycles of which each has a long chatter; or
const WINDOW: usize = 512;
/// so many times the longest word, of which three cycles must be there.
const CYCLES: usize = 4;

/// A release forgets what was before: after so many rests and releases without an impact there is none any more.
const IDLE: u32 = 4;

/// The impacts after which a motion asks whether to go on.
pub(crate) const BETWEEN_STOPS: u64 = 1024;

/// The last impacts of a motion, and what it has come to.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyState {
    /// The number of the first impact that is kept; the start impact has 1.
    pub first: u64,
    /// The last impacts, in order.
    pub kept: Vec<Event<f64>>,
    /// What the motion has come to, where it repeats itself or rests for ever; none where that was not looked for.
    pub attractor: Option<Attractor>,
    /// The last release that was the second or a later one from its wall: the motion repeats from it on.
    pub release: Option<Event<f64>>,
    /// The last event: the impact at which counting stopped, or what ended the motion before.
    pub end: Option<Event<f64>>,
}

impl SteadyState {
    /// Follows a motion to impact number `impacts`, or to its end where that comes first, and keeps the last `keep`
    /// impacts. Memory holds twice `keep` or 1024 of them, whichever is more.
    pub fn after(events: impl IntoIterator<Item = Event<f64>>, impacts: u32, keep: u32) -> Self {
        Settling::new(impacts, keep, &OrbitOptions::DEFAULT).along(events)
    }

    /// The same impacts, for less: what the motion has come to is not looked for.
    pub fn listed(events: impl IntoIterator<Item = Event<f64>>, impacts: u32, keep: u32) -> Self {
        Settling::listed(impacts, keep).along(events)
    }
}

/// A motion that is followed to what it comes to, event by event.
#[derive(Clone, Debug)]
pub struct Settling {
    window: Window,
    rests: Rests,
    keep: usize,
    /// How what it has come to is looked for, if it is.
    looked_for: Option<OrbitOptions>,
    /// The impacts that are held at least.
    most: usize,
    /// The impact that ends it.
    last: u64,
    /// Of an impact this is to cost next to nothing: all else is done now and then, at the impacts of these numbers.
    next_cut: u64,
    next_look: u64,
}

impl Settling {
    /// To impact number `impacts`; the last `keep` impacts are kept.
    pub fn new(impacts: u32, keep: u32, options: &OrbitOptions) -> Self {
        let least = WINDOW.max(CYCLES * options.longest_word as usize);
        Self::holding(impacts, keep, (keep as usize).max(least), Some(*options))
    }

    /// The same impacts, for less: what the motion has come to is not looked for.
    pub fn listed(impacts: u32, keep: u32) -> Self {
        Self::holding(impacts, keep, keep as usize, None)
    }

    fn holding(impacts: u32, keep: u32, most: usize, looked_for: Option<OrbitOptions>) -> Self {
        let (last, most) = (u64::from(impacts), most.min(impacts as usize));
        let next_cut = last.min(2 * most as u64);
        Self {
            window: Window {
                events: Vec::with_capacity((2 * most).min(impacts as usize)),
                impacts: 0,
                release: None,
            },
            rests: Rests::default(),
            keep: keep as usize,
            looked_for,
            most,
            last,
            next_cut,
            next_look: next_cut.min(BETWEEN_STOPS),
        }
    }

    /// Takes in the next event; `false` where no more are wanted.
    #[inline]
    pub fn take(&mut self, event: &Event<f64>) -> bool {
        if event.kind != Kind::Impact {
            return !self.rests.go_on_for_ever(&mut self.window, event.clone());
        }
        self.window.events.push(event.clone());
        self.window.impacts += 1;
        self.window.impacts != self.next_look || self.goes_on()
    }

    fn goes_on(&mut self) -> bool {
        let window = &mut self.window;
        if window.impacts == self.next_cut {
            window.cut(self.most);
            self.next_cut = self.last.min(self.next_cut + self.most as u64);
        }
        self.next_look = self.next_cut.min(window.impacts + BETWEEN_STOPS);
        window.impacts != self.last && stop::goes_on()
    }

    /// What the motion has come to by now.
    pub fn steady_state(mut self) -> SteadyState {
        self.window.cut(self.most);
        let attractor = self
            .looked_for
            .and_then(|options| Attractor::of(&self.window.events, &options));
        SteadyState {
            attractor,
            ..self.window.into_settled(self.keep)
        }
    }

    fn along(mut self, events: impl IntoIterator<Item = Event<f64>>) -> SteadyState {
        for event in events {
            if !self.take(&event) {
                break;
            }
        }
        self.steady_state()
    }
}

/// What a window has seen besides impacts.
#[derive(Clone, Debug, Default)]
struct Rests {
    releases: Releases,
    /// Rests and releases since the last impact, and the number of that.
    idle: u32,
    since: u64,
}

impl Rests {
    /// Adds an event that is no impact; whether the ball is rested and released for ever, without an impact that is listed.
    #[cold]
    fn go_on_for_ever(&mut self, window: &mut Window, event: Event<f64>) -> bool {
        if self.releases.is_second(&event) {
            window.release = Some(event.clone());
        }
        window.events.push(event);
        self.idle = if self.since == window.impacts { self.idle + 1 } else { 1 };
        self.since = window.impacts;
        self.idle > IDLE
    }
}

/// The last events of a motion, with so many impacts among them at least, if there were as many.
#[derive(Clone, Debug)]
struct Window {
    events: Vec<Event<f64>>,
    /// All impacts so far.
    impacts: u64,
    /// The last release that closes a cycle.
    release: Option<Event<f64>>,
}

impl Window {
    /// Lets go of what is before the last `most` impacts, and of the events between that and the first of these.
    fn cut(&mut self, most: usize) {
        let impacts = self.events.iter().enumerate().rev();
        let mut impacts = impacts.filter(|(_, event)| event.kind == Kind::Impact);
        // up to the impact before the first that is kept
        if let Some((before, _)) = impacts.nth(most) {
            self.events.drain(..=before);
        }
    }

    /// The last `keep` impacts, and the end.
    fn into_settled(mut self, keep: usize) -> SteadyState {
        let impacts = self.events.iter().rev().filter(|event| event.kind == Kind::Impact);
        let mut kept: Vec<Event<f64>> = impacts.take(keep).cloned().collect();
        kept.reverse();
        SteadyState {
            first: self.impacts + 1 - kept.len() as u64,
            kept,
            attractor: None,
            release: self.release,
            end: self.events.pop(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Side;

    fn event(kind: Kind, turns: i64) -> Event<f64> {
        let (side, phase, velocity) = (Side::Bottom, 1.0, 0.5);
        Event {
            kind,
            side,
            turns,
            phase,
            velocity,
        }
    }

    #[test]
    fn the_last_impacts_are_kept_with_their_numbers() {
        let settled = SteadyState::after((0..).map(|turn| event(Kind::Impact, turn)), 2000, 60);
        assert_eq!((settled.first, settled.kept.len()), (1941, 60));
        assert_eq!(settled.kept[0].turns, 1940);
        assert_eq!(settled.end, settled.kept.last().cloned());
        assert_eq!(
            settled.attractor.map(|found| (found.word, found.periods)),
            Some(("B".to_owned(), Some(1)))
        );
    }

    #[test]
    fn of_a_motion_that_ends_there_is_what_there_is() {
        let events = [event(Kind::Impact, 0), event(Kind::Impact, 1), event(Kind::Rest, 2)];
        let settled = SteadyState::after(events, 500, 60);
        assert_eq!((settled.first, settled.kept.len()), (1, 2));
        assert_eq!(settled.end.map(|end| end.kind), Some(Kind::Rest));
        assert_eq!(settled.attractor.map(|found| found.word).as_deref(), Some("B*"));
        for keep in [1, 2, 60] {
            let all = (0..).map(|turn| event(Kind::Impact, turn)).take(700);
            let [looked, listed] = [
                SteadyState::after(all.clone(), 600, keep),
                SteadyState::listed(all, 600, keep),
            ];
            let attractor = None;
            assert_eq!(SteadyState { attractor, ..looked }, listed);
        }
        let none = SteadyState::after([], 500, 60);
        assert_eq!((none.first, none.kept.len(), none.end), (1, 0, None));
    }

    #[test]
    fn rests_and_releases_are_not_counted() {
        let turn = |turn| [Kind::Impact, Kind::Rest, Kind::Release].map(|kind| event(kind, turn));
        let settled = SteadyState::after((0..).flat_map(turn), 10, 3);
        assert_eq!((settled.first, settled.kept.len()), (8, 3));
        assert!(settled.kept.iter().all(|event| event.kind == Kind::Impact));
        assert_eq!(settled.attractor.map(|found| found.word).as_deref(), Some("B*"));
    }
}
