//! The 1-1 motions followed over a sweep, and every bifurcation on the way.

use crate::model::Exact;
use crate::model::MotionError;
use crate::orbit::bifurcation::one_one::{Bifurcations, LocatedBifurcation, bifurcations};
use crate::orbit::bifurcation::point::BifurcationPoint;
use crate::orbit::equations::conditions::BifurcationKind;
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::family::Family;
use crate::orbit::find::{FoundOrbits, pairs};
use crate::orbit::inconclusive::Inconclusive;
use crate::orbit::interval_box::{IntervalBox, joined};
use crate::orbit::options::OrbitOptions;
use crate::orbit::output::{Output, OutputPrecision};
use crate::orbit::parallel::each;
use crate::orbit::solve::cover::{Cover, CoverError};
use crate::orbit::solve::isolate::{SearchLimits, isolate};
use crate::orbit::solve::one_one::OneOneSearch;
use crate::orbit::word::Word;
use numbers::Interval;

/// The ends of a piece of the range that is covered by itself are in this ratio at most: at a small d motions change with
/// d itself, not with the range.
const RATIO: f64 = 6.0;

/// Boxes in which something stays undecided are covered again so often with those that touch as one, which is soon done;
/// then each by itself, as long as these are few.
const TOGETHER: u32 = 7;
const MOST_BOXES: usize = 1500;

/// The 1-1 motions of so many periods, prepared over a range of a parameter: their curve is covered once, and motions
/// at a value are looked for in the cover alone.
pub struct OneOneBranches<F> {
    family: F,
    periods: u32,
    /// Piece by piece.
    covers: Vec<Cover>,
    options: OrbitOptions,
}

/// An event that could not be told from none, or to the last digit.
#[derive(Clone, Debug, PartialEq)]
pub enum OpenBifurcation {
    /// None, one or several, in (T_1, psi, parameter).
    Box {
        /// Which.
        event: BifurcationKind,
        /// The forcing periods of the motions.
        periods: u32,
        /// Where.
        cell: IntervalBox<f64, 3>,
    },
    /// One that is there.
    LocatedBifurcation {
        /// Which.
        event: BifurcationKind,
        /// The forcing periods of the motions.
        periods: u32,
        /// Where, in (T_1, psi, parameter).
        cell: IntervalBox<f64, 3>,
        /// What is open.
        why: Inconclusive,
    },
}

impl OpenBifurcation {
    /// Whether these leave no event out: of each of them it is proved that it is there.
    pub fn are_all_there(open: &[Self]) -> bool {
        !open.iter().any(|open| matches!(open, Self::Box { .. }))
    }

    /// Where it is or may be, in (T_1, psi, parameter).
    pub fn cell(&self) -> &IntervalBox<f64, 3> {
        match self {
            Self::Box { cell, .. } | Self::LocatedBifurcation { cell, .. } => cell,
        }
    }
}

impl std::fmt::Display for OpenBifurcation {
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
            Self::LocatedBifurcation { event, cell, why, .. } => {
                write!(f, "a {event} at {}: {why}", cell[2].midpoint())
            }
        }
    }
}

impl<F: Family + Sync> OneOneBranches<F> {
    /// Covers the curve for parameters in `range`.
    ///
    /// # Errors
    /// A range in which a parameter of the motion cannot be; `Uncovered` under another forcing than cos(pi t).
    pub fn new(family: F, periods: u32, range: Interval<f64>, options: &OrbitOptions) -> Result<Self, CoverError> {
        let covers = each(&pieces(range), |piece| Cover::new(&family, periods, *piece, options));
        let covers = covers.into_iter().collect::<Result<_, _>>()?;
        Ok(Self {
            family,
            periods,
            covers,
            options: *options,
        })
    }

    /// Every motion at one value of the range, proved, and the boxes left undecided.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn at(&self, value: &impl Exact) -> Result<OneOneSearch, MotionError> {
        let parameter: Interval<f64> = value.value();
        let balance = OneOneEquations::new(&self.family.motion_at(&parameter)?, self.periods);
        let limits = SearchLimits {
            finest: self.options.finest_cell,
            most_cells: self.options.most_cells as usize * self.periods as usize,
        };
        let cells = self.covers.iter().flat_map(|cover| cover.at(parameter)).collect();
        let isolation = isolate(&balance, cells, Vec::new(), limits);
        Ok(OneOneSearch::new(self.periods, 0, isolation, &balance))
    }

    /// Every motion at one value of the range.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn orbits(&self, value: &impl Exact) -> Result<FoundOrbits, MotionError> {
        self.orbits_as(&OutputPrecision::DOUBLES, value)
    }

    /// The same, told as they are wanted.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn orbits_as<W: Output>(&self, wanted: &W, value: &impl Exact) -> Result<FoundOrbits<W::Number>, MotionError> {
        let periods = self.periods;
        let search = self.at(value)?;
        let fixed = self.family.fixed(value);
        let mut found = FoundOrbits::new(true);
        let undecided = &search.isolation.undecided;
        let settled = pairs(wanted, &fixed, periods, &search.motions, undecided, &mut found.open)?;
        found.take(&Word::pair(), periods, settled);
        Ok(found)
    }

    /// Every motion at each of the values, in their order, on all cores.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn points<V: Exact + Sync>(&self, values: &[V]) -> Result<Vec<FoundOrbits>, MotionError> {
        self.points_as(&OutputPrecision::DOUBLES, values)
    }

    /// The same, told as they are wanted.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn points_as<W: Output, V: Exact + Sync>(
        &self,
        wanted: &W,
        values: &[V],
    ) -> Result<Vec<FoundOrbits<W::Number>>, MotionError> {
        each(values, |value| self.orbits_as(wanted, value))
            .into_iter()
            .collect()
    }

    /// Every bifurcation over the range, in order of the parameter, and what is open.
    pub fn bifurcations(&self) -> (Vec<BifurcationPoint>, Vec<OpenBifurcation>) {
        self.bifurcations_as(&OutputPrecision::DOUBLES)
    }

    /// Every bifurcation over the range, proved, in order of the parameter, and the boxes in which one could not be told.
    pub fn located(&self) -> Bifurcations {
        let mut found = Bifurcations::default();
        for piece in each(&self.covers, |cover| self.settled(cover)) {
            found.add(piece);
        }
        let place = |located: &LocatedBifurcation| located.parameter().midpoint();
        found.located.sort_by(|one, other| place(one).total_cmp(&place(other)));
        found
    }

    /// The same, told as they are wanted.
    pub fn bifurcations_as<W: Output>(&self, wanted: &W) -> (Vec<BifurcationPoint<W::Number>>, Vec<OpenBifurcation>) {
        let periods = self.periods;
        let found = self.located();
        let open = found.undecided.into_iter();
        let mut open: Vec<OpenBifurcation> = open
            .map(|(event, cell)| OpenBifurcation::Box { event, periods, cell })
            .collect();
        let mut points = Vec::new();
        for located in found.located {
            match wanted.bifurcation(&self.family, periods, &located) {
                Ok(point) => points.push(point),
                Err(why) => open.push(OpenBifurcation::LocatedBifurcation {
                    event: located.kind(),
                    periods,
                    cell: located.cell(periods),
                    why,
                }),
            }
        }
        (points, open)
    }

    /// The events over one cover; the boxes in which some stay undecided are covered again, finer, by themselves.
    fn settled(&self, cover: &Cover) -> Bifurcations {
        let mut found = bifurcations(&self.family, cover);
        let mut cover = cover.clone();
        for round in 0..self.options.most_covers {
            let mut boxes: Vec<IntervalBox<f64, 3>> = found.undecided.iter().map(|(_, cell)| *cell).collect();
            if round < TOGETHER || boxes.len() > MOST_BOXES {
                boxes = joined(&boxes, 0.0);
            }
            if boxes.is_empty() {
                break;
            }
            let Ok(finer) = cover.within(&self.family, &boxes, &self.options) else {
                break;
            };
            found.undecided.clear();
            found.add(bifurcations(&self.family, &finer));
            cover = finer;
        }
        found.join();
        found
    }
}

/// The range in pieces that are covered by themselves.
fn pieces(range: Interval<f64>) -> Vec<Interval<f64>> {
    let (low, high) = (range.low(), range.high());
    if low <= 0.0 {
        return vec![range];
    }
    // by logarithms: the ratio of the ends may be beyond f64
    let (from, to) = (low.ln(), high.ln());
    let count = ((to - from) / RATIO.ln()).ceil().max(1.0);
    let end = |index: f64| match index {
        0.0 => low,
        index if index == count => high,
        index => (from + (to - from) * index / count).exp(),
    };
    (0..count as u32)
        .map(f64::from)
        .map(|index| Interval::new(end(index), end(index + 1.0)))
        .collect()
}
