//! A motion in f64 that asks wider numbers about what f64 cannot decide.

use super::event::{Event, Kind};
use super::growth::Growth;
use super::simulation::Simulation;
use super::start::Start;
use crate::model::Motion;
use numbers::{Analytic, Digits, DoubleDouble, at_digits};

/// The events of a motion in f64. A contact that rounding hides is decided in double-double, else in 50 digits, from the
/// departure before as f64 has it, and the motion goes on from there; so it ends undecided only where those cannot tell.
///
/// For what is asked of many motions, or of very long ones: each event follows from the one before to the precision of
/// f64, and [`Growth`] says how far that still tells the motion from the start.
#[derive(Clone, Debug)]
pub struct Widening {
    motion: Motion<f64>,
    pub(super) simulation: Simulation<f64>,
}

impl Widening {
    /// The motion from `start` on, the start impact first.
    pub fn new(motion: &Motion<f64>, start: &Start<f64>) -> Self {
        Self {
            motion: motion.clone(),
            simulation: Simulation::new(motion, start).with_growth(),
        }
    }

    /// The same where nobody asks what holds: [`Widening::growth`] claims nothing, and an impact costs as little as one of
    /// [`Simulation`]. The events are the same.
    pub fn without_growth(self) -> Self {
        Self {
            simulation: self.simulation.without_growth(),
            ..self
        }
    }

    /// What follows after `event`, from which no digits are claimed.
    pub fn after(motion: &Motion<f64>, event: &Event<f64>) -> Self {
        let mut next = Self::new(motion, &Start::from(event));
        next.simulation.resume(event);
        next
    }

    /// Whether the ball is rested and released for ever, without an impact that is listed.
    pub fn is_idle(&self) -> bool {
        self.simulation.is_idle()
    }

    /// How errors have grown up to the latest event.
    pub fn growth(&self) -> &Growth {
        self.simulation.tracked()
    }

    /// The contact that f64 cannot tell, in a wider number, if that decides it.
    fn decided<T: Analytic>(&self) -> Option<Event<f64>> {
        let motion = self.motion.convert(|value| T::from_f64(*value)).ok()?;
        let event = self.simulation.widened(&motion, |value| T::from_f64(*value))?;
        Some(event.convert(T::to_f64))
    }

    /// The contact that f64 leaves undecided, if a wider number decides it: the motion goes on from there.
    #[cold]
    fn resolved(&mut self) -> Option<Event<f64>> {
        let decided = self
            .decided::<DoubleDouble>()
            .or_else(|| at_digits(50, || self.decided::<Digits>()))?;
        self.simulation.resume(&decided);
        Some(decided)
    }
}

impl Iterator for Widening {
    type Item = Event<f64>;

    #[inline(always)]
    fn next(&mut self) -> Option<Event<f64>> {
        let event = self.simulation.next()?;
        match event.kind {
            Kind::Undecided => Some(self.resolved().unwrap_or(event)),
            _ => Some(event),
        }
    }
}
