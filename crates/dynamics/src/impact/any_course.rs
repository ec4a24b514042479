//! The course of a motion under its own forcing.

use super::course::{Course, Witness};
use super::event::Event;
use super::growth::Growth;
use super::scaled::{Departure, Scaled};
use super::start::Start;
use super::waves::{Cosine, Several, Waves};
use crate::model::{Motion, Side};
use numbers::Analytic;

/// A motion, every impact of it, under the cosine of the paper or several harmonics.
#[derive(Clone, Debug)]
pub(super) enum AnyCourse<T: Analytic> {
    Cosine(Course<T, Cosine<T>>),
    Several(Box<Course<T, Several<T>>>),
}

/// The same of either.
macro_rules! either {
    ($course:expr, $inner:ident => $of:expr) => {
        match $course {
            AnyCourse::Cosine($inner) => $of,
            AnyCourse::Several($inner) => $of,
        }
    };
}

impl<T: Analytic> AnyCourse<T> {
    /// The motion from `start` on.
    pub fn new(motion: &Motion<T>, start: &Start<T>) -> Self {
        match motion.other_forcing() {
            None => Self::Cosine(Course::new(motion, start)),
            Some(_) => Self::Several(Box::new(Course::new(motion, start))),
        }
    }

    /// Calls [`Course::released`].
    pub fn released(motion: &Motion<T>, side: Side, near: f64) -> Option<Self> {
        Some(match motion.other_forcing() {
            None => Self::Cosine(Course::released(motion, side, near)?),
            Some(_) => Self::Several(Box::new(Course::released(motion, side, near)?)),
        })
    }

    /// Calls [`Course::complete_to`].
    pub fn complete_to(&mut self, error: f64) {
        either!(self, course => course.complete_to(error));
    }

    /// The growth of errors from the start on.
    pub fn growth(&self) -> Growth {
        fn of<T: Analytic, W: Waves<T>>(course: &Course<T, W>) -> Growth {
            let mut growth = Growth::new(course.scaled());
            if let Some([phase, speed]) = course.start_in_flight() {
                growth.begin(phase, speed);
            }
            growth
        }
        either!(self, course => of(course))
    }

    /// Returns true if impacts on a wall lose nothing.
    pub fn is_lossless(&self, side: Side) -> bool {
        either!(self, course => course.scaled().restitution(side).is_one())
    }

    /// Calls [`Course::resume`].
    pub fn resume(&mut self, event: &Event<T>) {
        either!(self, course => course.resume(event));
    }

    /// The departure after the latest event, if that was an impact and ordinary flights may follow.
    pub fn departure(&self) -> Option<&Departure<T, Cosine<T>>> {
        match self {
            Self::Cosine(course) => course.departure().filter(|_| self.ordinary().is_some()),
            Self::Several(_) => None,
        }
    }

    /// Goes on from a departure under the cosine of the paper.
    pub fn depart(&mut self, from: Departure<T, Cosine<T>>, turns: i64) {
        if let Self::Cosine(course) = self {
            course.depart(from, turns);
        }
    }

    /// The data of ordinary flights; none where the motion has no such.
    pub fn ordinary(&self) -> Option<&Scaled<T, Cosine<T>>> {
        match self {
            Self::Cosine(course) => Some(course.scaled()).filter(|scaled| {
                let [bottom, top] = &scaled.restitution;
                scaled.has_top && !bottom.is_zero() && !top.is_zero()
            }),
            Self::Several(_) => None,
        }
    }

    /// Calls [`Course::goes_on_like`].
    pub fn goes_on_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Cosine(one), Self::Cosine(other)) => one.goes_on_like(other),
            (Self::Several(one), Self::Several(other)) => one.goes_on_like(other),
            _ => false,
        }
    }

    /// Calls [`Course::widened`].
    pub fn widened<U: Analytic>(&self, motion: &Motion<U>, convert: impl Fn(&T) -> U) -> Option<AnyCourse<U>> {
        Some(match self {
            Self::Cosine(course) => AnyCourse::Cosine(course.widened(motion, convert)?),
            Self::Several(course) => AnyCourse::Several(Box::new(course.widened(motion, convert)?)),
        })
    }

    /// Calls [`Course::advance`].
    #[inline]
    pub fn advance(&mut self, witness: impl Witness<T>) -> Option<Event<T>> {
        either!(self, course => course.advance(witness))
    }
}
