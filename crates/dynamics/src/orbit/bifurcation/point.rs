//! The motion at a bifurcation: enclosed, and rounded to a row of a table. The same for 1-1 motions and other words.

use crate::model::{Motion, Side};
use crate::orbit::equations::conditions::{BifurcationCondition, BifurcationKind};
use crate::orbit::equations::flight::OrbitImpact;
use crate::orbit::inconclusive::{Inconclusive, Property, undecided};
use crate::orbit::interval_box::larger;
use crate::orbit::orbit::{clearance, reduced};
use crate::orbit::solve::starts::listed_from;
use crate::orbit::word::Word;
use numbers::{Analytic, Endpoint, Field, Interval, Rung, Telling, Told};
use std::f64::consts::PI;

/// Where an impact has velocity 0, a flight starts and ends on the wall itself. Its turning points are those of the motion
/// with this velocity instead, towards the wall: on the side of the bifurcation on which there are motions.
const NEARLY_ZERO_VELOCITY: f64 = 1e-14;

/// And the flight before is followed until so long before it ends, where it has a velocity.
const NEARLY_ENDED: f64 = 1e-9;

/// A bifurcation of periodic motions, as numbers: a row of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct BifurcationPoint<N = f64> {
    /// What happens.
    pub kind: BifurcationKind,
    /// The word of the motions followed, from the impact that the lists start with.
    pub word: Word,
    /// The forcing periods of the motions followed.
    pub periods: u32,
    /// The value of the swept parameter.
    pub parameter: N,
    /// The gap.
    pub d: N,
    /// Of the impacts, in [0, 2 pi); one for each letter of the word, as in the two lists below.
    pub phases: Vec<N>,
    /// Just before each impact.
    pub velocities: Vec<N>,
    /// Of the flight after each impact.
    pub times: Vec<N>,
    /// Of the derivative of the map; infinite where an impact has velocity 0.
    pub trace: N,
    /// The least distance from a wall at the turning points strictly inside the flights, 0 at a touch; infinite where no
    /// flight turns.
    pub clearance: N,
    /// Whether the ball keeps between the walls, the touch itself allowed.
    pub admissible: bool,
    /// No parameter, gap, phase, velocity or time above is farther than this from the exact one. `None` where there is no
    /// proof that such a bifurcation exists, and where an enclosure is too wide for the figures of a decimal.
    pub error_bound: Option<N>,
    /// The number type of the enclosures.
    pub computed_in: Rung,
}

impl BifurcationPoint {
    /// Returns the word in the spelling that all its rotations share, and the phases of its impacts, which increase
    /// along it.
    pub(crate) fn listed(&self) -> Option<(Word, Vec<f64>)> {
        let later = self.times.iter().scan(*self.phases.first()?, |phase, time| {
            let here = *phase;
            *phase += PI * time;
            Some(here)
        });
        let phases: Vec<f64> = later.collect();
        let spelled = self.word.spelled();
        let first = (0..spelled.impacts()).find(|first| self.word.rotated(*first) == spelled)?;
        Some((spelled, listed_from(&phases, first, self.periods)))
    }
}

impl<N: Told> BifurcationPoint<N> {
    /// The same in f64.
    pub fn nearest(&self) -> BifurcationPoint {
        let list = |values: &[N]| values.iter().map(Told::to_f64).collect();
        BifurcationPoint {
            kind: self.kind,
            word: self.word.clone(),
            periods: self.periods,
            parameter: self.parameter.to_f64(),
            d: self.d.to_f64(),
            phases: list(&self.phases),
            velocities: list(&self.velocities),
            times: list(&self.times),
            trace: self.trace.to_f64(),
            clearance: self.clearance.to_f64(),
            admissible: self.admissible,
            error_bound: self.error_bound.as_ref().map(Told::to_f64),
            computed_in: self.computed_in,
        }
    }
}

/// A bifurcation of which every value is an enclosure; see [`BifurcationPoint`] for what they are.
#[derive(Clone, Debug, PartialEq)]
pub struct EnclosedBifurcation<E: Endpoint> {
    pub(crate) kind: BifurcationKind,
    pub(crate) word: Word,
    pub(crate) periods: u32,
    pub(crate) parameter: Interval<E>,
    pub(crate) d: Interval<E>,
    pub(crate) impacts: Vec<OrbitImpact<Interval<E>>>,
    /// `None` where it is infinite.
    pub(crate) trace: Option<Interval<E>>,
    /// `None` where no flight turns.
    pub(crate) clearance: Option<Interval<E>>,
    pub(crate) admissible: bool,
    /// Whether it is proved that there is such a bifurcation in these intervals.
    pub(crate) certified: bool,
}

impl<E: Endpoint> EnclosedBifurcation<E> {
    /// The bifurcation in the numbers of `rounding`.
    pub fn rounded<R: Telling<E>>(&self, rounding: &R) -> BifurcationPoint<R::Number> {
        let phases: Vec<Interval<E>> = self.impacts.iter().map(|impact| reduced(&impact.phase)).collect();
        let phases: Vec<_> = phases.iter().map(not_below_zero).collect();
        let list = |of: fn(&OrbitImpact<Interval<E>>) -> &Interval<E>| -> Vec<R::Number> {
            self.impacts.iter().map(|impact| rounding.tell(of(impact))).collect()
        };
        let or_infinite =
            |value: &Option<Interval<E>>| value.as_ref().map_or_else(Told::infinite, |value| rounding.tell(value));
        let others = self.impacts.iter().flat_map(|impact| [&impact.velocity, &impact.time]);
        let bounded: Vec<&Interval<E>> = phases.iter().chain(others).chain([&self.parameter, &self.d]).collect();
        let errors = bounded.iter().map(|value| rounding.error(&rounding.tell(value), value));
        let error = errors.fold(E::zero(), larger);
        // the clearance beside an impact of velocity 0 has twelve figures in any number
        let known = bounded
            .into_iter()
            .chain(&self.trace)
            .all(|value| rounding.holds(value));
        BifurcationPoint {
            kind: self.kind,
            word: self.word.clone(),
            periods: self.periods,
            parameter: rounding.tell(&self.parameter),
            d: rounding.tell(&self.d),
            phases: phases.iter().map(|phase| rounding.tell(phase)).collect(),
            velocities: list(|impact| &impact.velocity),
            times: list(|impact| &impact.time),
            trace: or_infinite(&self.trace),
            clearance: or_infinite(&self.clearance),
            admissible: self.admissible,
            error_bound: (self.certified && known).then(|| rounding.bound(error)),
            computed_in: E::rung(),
        }
    }
}

/// A reduced phase; the middle of an interval around 0 may lie a rounding below it, and 0 is then what is printed.
pub(crate) fn not_below_zero<E: Endpoint>(phase: &Interval<E>) -> Interval<E> {
    if phase.midpoint() < E::zero() {
        Interval::from_integer(0)
    } else {
        phase.clone()
    }
}

/// The clearance of the motion at a bifurcation, `None` where no flight turns, and whether it keeps between the walls. Of
/// impacts of velocity 0 the clearance is known within `margin`; one that contains 0 is 0 where `touches` says so.
///
/// # Errors
/// `Undecided` where the clearance may have either sign.
pub(crate) fn clearance_at<E: Endpoint>(
    condition: BifurcationCondition,
    (sides, motion): (&[Side], &Motion<Interval<E>>),
    impacts: &[OrbitImpact<Interval<E>>],
    margin: f64,
    touches: impl Fn(&Interval<E>) -> bool,
) -> Result<(Option<Interval<E>>, bool), Inconclusive> {
    let mut moved = impacts.to_vec();
    let has_zero_velocity = matches!(condition, BifurcationCondition::ZeroVelocity(_));
    if has_zero_velocity {
        // several at once, where the motion is its own mirror image
        for (index, impact) in impacts.iter().enumerate() {
            if impact.velocity.contains_zero() {
                let before = (index + impacts.len() - 1) % impacts.len();
                moved[index].velocity = Interval::from_f64(sides[index].sign() * NEARLY_ZERO_VELOCITY);
                moved[before].time -= Interval::from_f64(NEARLY_ENDED);
            }
        }
    }
    let Some(mut clearance) = clearance(sides, motion, &moved)? else {
        return Ok((None, true));
    };
    if has_zero_velocity {
        clearance += Interval::new(E::from_f64(-margin), E::from_f64(margin));
    }
    if !clearance.contains_zero() {
        let positive = clearance.is_positive();
        return Ok((Some(clearance), positive));
    }
    if touches(&clearance) {
        return Ok((Some(Interval::from_integer(0)), true));
    }
    undecided(Property::Clearance)
}
