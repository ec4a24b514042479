//! The 1-1 motions followed over a sweep, and every bifurcation on the way.

use super::bifurcation::bifurcations;
use super::cell::Cell;
use super::cover::{Cover, CoverError};
use super::event::Event;
use super::family::Family;
use super::find::{Found, pairs};
use super::instant::Instant;
use super::isolate::{Limits, isolate};
use super::one_to_one::{Equations, FINEST, Search};
use super::parallel::each;
use super::unsettled::Unsettled;
use super::wanted::{Goal, Wanted};
use super::{Balance, Word};
use crate::model::Exact;
use crate::model::MotionError;
use crate::number::{Analytic, Interval};

/// The cells spent at one value before it is left undecided.
const MOST_CELLS: usize = 100_000;

/// The 1-1 motions of so many periods, prepared over a range of a parameter: their curve is covered once, and motions
/// at a value are looked for in the cover alone.
pub struct Prepared<'a, F> {
    family: &'a F,
    cover: Cover,
}

/// An event that could not be told from none, or to the last digit.
#[derive(Clone, Debug, PartialEq)]
pub enum OpenEvent {
    /// None, one or several, in (T_1, psi, parameter).
    Box {
        /// Which.
        event: Event,
        /// The forcing periods of the motions.
        periods: u32,
        /// Where.
        cell: Cell<f64, 3>,
    },
    /// One that is there.
    Located {
        /// Which.
        event: Event,
        /// About where.
        parameter: f64,
        /// What is open.
        why: Unsettled,
    },
}

impl std::fmt::Display for OpenEvent {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Box {
                event,
                periods,
                cell: [t_1, psi, parameter],
            } => write!(
                f,
                "BT over {periods} forcing periods: undecided whether there is a {event} at {parameter} (T_1 in {t_1}, \
                 phase {psi} halfway through the first flight)"
            ),
            Self::Located { event, parameter, why } => write!(f, "a {event} at {parameter}: {why}"),
        }
    }
}

impl<'a, F: Family + Sync> Prepared<'a, F> {
    /// Covers the curve for parameters in `range`.
    ///
    /// # Errors
    /// A range in which a parameter of the motion cannot be.
    pub fn new(family: &'a F, periods: u32, range: Interval<f64>) -> Result<Self, CoverError> {
        let cover = Cover::new(family, periods, range)?;
        Ok(Self { family, cover })
    }

    /// Every motion at one value of the range, proved, and the boxes left undecided.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn at(&self, value: &impl Exact) -> Result<Search, MotionError> {
        let parameter: Interval<f64> = value.value();
        let balance = Balance::new(&self.family.motion_at(&parameter)?, self.cover.periods);
        let limits = Limits {
            finest: FINEST,
            most_cells: MOST_CELLS,
        };
        let system = Equations(&balance);
        let isolation = isolate(&system, self.cover.at(parameter), Vec::new(), limits);
        Ok(Search::new(self.cover.periods, 0, isolation, &system))
    }

    /// Every motion at one value of the range.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn orbits(&self, value: &impl Exact) -> Result<Found, MotionError> {
        self.orbits_as(&Goal::DOUBLES, value)
    }

    /// The same, told as they are wanted.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn orbits_as<W: Wanted>(&self, wanted: &W, value: &impl Exact) -> Result<Found<W::Number>, MotionError> {
        let periods = self.cover.periods;
        let search = self.at(value)?;
        let fixed = self.family.fixed(value);
        let mut found = Found::new();
        let undecided = &search.isolation.undecided;
        let settled = pairs(wanted, &fixed, periods, &search.motions, undecided, &mut found.open)?;
        found.take(&Word::pair(), periods, settled);
        Ok(found)
    }

    /// Every motion at each of the values, in their order, on all cores.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn points<V: Exact + Sync>(&self, values: &[V]) -> Result<Vec<Found>, MotionError> {
        self.points_as(&Goal::DOUBLES, values)
    }

    /// The same, told as they are wanted.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn points_as<W: Wanted, V: Exact + Sync>(
        &self,
        wanted: &W,
        values: &[V],
    ) -> Result<Vec<Found<W::Number>>, MotionError> {
        each(values, |value| self.orbits_as(wanted, value))
            .into_iter()
            .collect()
    }

    /// Every bifurcation over the range, in order of the parameter, and what is open.
    pub fn bifurcations(&self) -> (Vec<Instant>, Vec<OpenEvent>) {
        self.bifurcations_as(&Goal::DOUBLES)
    }

    /// The same, told as they are wanted.
    pub fn bifurcations_as<W: Wanted>(&self, wanted: &W) -> (Vec<Instant<W::Number>>, Vec<OpenEvent>) {
        let periods = self.cover.periods;
        let found = bifurcations(self.family, &self.cover);
        let open = found.undecided.into_iter();
        let mut open: Vec<OpenEvent> = open
            .map(|(event, cell)| OpenEvent::Box { event, periods, cell })
            .collect();
        let mut instants = Vec::new();
        for located in found.located {
            match wanted.instant(self.family, periods, &located) {
                Ok(instant) => instants.push(instant),
                Err(why) => open.push(OpenEvent::Located {
                    event: located.event(),
                    parameter: located.parameter().to_f64(),
                    why,
                }),
            }
        }
        (instants, open)
    }
}
