//! The periodic motions of a word along a sweep, and the branches that part from them.

use super::Failure;
use crate::number::Interval;
use crate::orbit::{
    BifurcationPoint, Family, FoundOrbits, OneOneBranches, OpenBifurcation, OrbitOptions, Output, Word, WordBranches,
    is_covered,
};
use crate::scene::{Quantity, Setting, Sweep};

/// A search for motions at a value of the sweep.
pub(super) enum Motions {
    /// Those of which all are found.
    Pairs(OneOneBranches<Setting>),
    /// Any others: the branches that a search leads to, or that part from another one.
    Others(WordBranches<Setting>),
}

/// Events that are no farther apart, in ranges of the parameter, are one.
const SAME: f64 = 1e-9;

/// Velocities of an impact that are no farther apart are one.
const NEAR: f64 = 1e-6;

impl Motions {
    /// Those of a word over so many periods.
    pub fn new(
        setting: &Setting,
        sweep: &Sweep,
        word: &Word,
        periods: u32,
        options: &OrbitOptions,
    ) -> Result<Self, Failure> {
        let range = nearest(sweep);
        let middle = setting.motion_at(&Interval::point(range.midpoint()))?;
        if is_covered(&middle, word) {
            let [from, to] = [&sweep.from, &sweep.to].map(|end| end.value::<Interval<f64>>());
            let prepared = OneOneBranches::new(setting.clone(), periods, from.hull(&to), options)?;
            return Ok(Self::Pairs(prepared));
        }
        // the ends as f64: rounded outward they reach beyond a restitution of 1
        let followed = WordBranches::new(setting.clone(), word, periods, range, options)?;
        Ok(Self::Others(followed))
    }

    /// Their bifurcations, in f64, and what is open of those that are all found.
    pub fn bifurcations(&self) -> (Vec<BifurcationPoint>, Vec<OpenBifurcation>) {
        match self {
            Self::Pairs(prepared) => prepared.bifurcations(),
            Self::Others(followed) => (followed.bifurcations(), Vec::new()),
        }
    }

    /// The motions at each of the values.
    pub fn points_as<W: Output>(
        &self,
        wanted: &W,
        values: &[Quantity],
    ) -> Result<Vec<FoundOrbits<W::Number>>, Failure> {
        Ok(match self {
            Self::Pairs(prepared) => prepared.points_as(wanted, values)?,
            Self::Others(followed) => followed.points_as(wanted, values)?,
        })
    }

    /// Returns true if the motions that were followed are among these.
    fn has(&self, followed: &WordBranches<Setting>) -> bool {
        match self {
            Self::Pairs(_) => followed.word().0 == Word::pair(),
            Self::Others(own) => own.has(followed),
        }
    }

    /// The branches that part from these, and so many times on from those. Words and periods that are `known` are
    /// followed by themselves.
    pub fn parting(
        &self,
        setting: &Setting,
        sweep: &Sweep,
        options: &OrbitOptions,
        switches: u32,
        known: &[(Word, u32)],
    ) -> Vec<WordBranches<Setting>> {
        if switches == 0 {
            return Vec::new();
        }
        let is_known = |followed: &WordBranches<Setting>| known.contains(&followed.word()) || self.has(followed);
        let switched =
            |event: &BifurcationPoint| WordBranches::switched(setting.clone(), event, nearest(sweep), options);
        let width = nearest(sweep).width();
        parting(&self.bifurcations().0, &switched, width, switches, &is_known)
    }
}

fn parting(
    events: &[BifurcationPoint],
    switched: &dyn Fn(&BifurcationPoint) -> Option<WordBranches<Setting>>,
    width: f64,
    switches: u32,
    is_known: &dyn Fn(&WordBranches<Setting>) -> bool,
) -> Vec<WordBranches<Setting>> {
    let mut found = Vec::new();
    // where a branch that has been followed parts: it may leave and come back; mirror images part at one parameter
    let mut left: Vec<(f64, Vec<f64>)> = Vec::new();
    for event in events {
        let is_near = |velocity: &f64| {
            event
                .velocities
                .first()
                .is_some_and(|own| (own - velocity).abs() < NEAR)
        };
        let is_here = |(at, velocities): &(f64, Vec<f64>)| {
            (at - event.parameter).abs() < SAME * width && velocities.iter().any(is_near)
        };
        if left.iter().any(is_here) {
            continue;
        }
        let Some(followed) = switched(event).filter(|followed| !is_known(followed)) else {
            continue;
        };
        let own = followed.bifurcations();
        left.extend(own.iter().map(|event| (event.parameter, event.velocities.clone())));
        let further = match switches {
            1 => Vec::new(),
            _ => parting(&own, switched, width, switches - 1, &|other| {
                is_known(other) || followed.has(other)
            }),
        };
        found.push(followed);
        found.extend(further);
    }
    found
}

/// The range of a sweep, its ends as f64.
fn nearest(sweep: &Sweep) -> Interval<f64> {
    let [from, to] = [&sweep.from, &sweep.to].map(|end| end.value::<f64>());
    Interval::new(from.min(to), from.max(to))
}
