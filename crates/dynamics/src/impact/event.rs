//! What happens to the ball, in order.

use crate::model::Side;
use numbers::Analytic;
use std::fmt;

/// What happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// The ball reaches a wall and leaves it with -r times its velocity.
    Impact,
    /// A chatter is complete: the ball lies on the wall.
    Rest,
    /// f + g changes sign and the ball leaves the wall it lay on, with velocity 0.
    Release,
    /// Rounding hides whether the ball touches the wall; what follows is not known.
    Undecided,
}

impl Kind {
    /// The word in the column `kind`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Impact => "impact",
            Self::Rest => "rest",
            Self::Release => "release",
            Self::Undecided => "undecided",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Something that happens at a wall.
///
/// The instant is a phase and a count of whole turns: in absolute time rounding errors would grow with time.
#[derive(Clone, Debug, PartialEq)]
pub struct Event<T> {
    /// What.
    pub kind: Kind,
    /// At which wall.
    pub side: Side,
    /// The whole turns of the forcing, counted as those of the phase that the motion started with.
    pub turns: i64,
    /// The phase of the forcing, rad, in [0, 2 pi).
    pub phase: T,
    /// Zdot just before: positive at the bottom, negative at the top, 0 at rest and release.
    pub velocity: T,
}

impl<T> Event<T> {
    /// The same, so many turns later.
    pub(super) fn later(mut self, turns: i64) -> Self {
        self.turns += turns;
        self
    }

    /// The same event over another number.
    pub fn convert<U>(&self, convert: impl Fn(&T) -> U) -> Event<U> {
        Event {
            kind: self.kind,
            side: self.side,
            turns: self.turns,
            phase: convert(&self.phase),
            velocity: convert(&self.velocity),
        }
    }
}

impl<T: Analytic> Event<T> {
    /// The time since the start, of phase `start` as it was given; the period of the forcing is 2.
    pub fn time(&self, start: &T) -> T {
        T::from_integer(2 * self.turns) + (self.phase.clone() - start.clone()) / T::pi()
    }

    /// The time from here to a later event of the same motion.
    pub fn time_to(&self, later: &Self) -> T {
        T::from_integer(2 * (later.turns - self.turns)) + (later.phase.clone() - self.phase.clone()) / T::pi()
    }
}
