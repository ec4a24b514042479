//! One branch of a curve: from a point on it, in both directions, to where it ends.

use crate::orbit::continuation::curve::{CurveEquations, dot};
use crate::orbit::continuation::segment::CertifiedSegment;
use crate::orbit::continuation::test_functions::TestFunctions;
use crate::orbit::options::OrbitOptions;
use std::ops::Range;

/// The first step, in radians and ranges of a parameter.
const FIRST_STEP: f64 = 0.01;

/// A step may be so much longer than the one before.
const GROWTH: f64 = 1.6;

/// A step that would end so near to the end of a range that this times its length leaves it goes there.
const REACH: f64 = 1.25;

/// Newton's method may go this part of a step from its prediction.
const NEAR: f64 = 0.1;

/// The least cosine between the tangents at both ends of a step.
const STRAIGHT: f64 = 0.9;

/// Steps tried where none can be proved, as where two branches cross: over the point rather than onto it.
const LEAPS: [f64; 4] = [1e-4, 1e-3, 3e-3, 1e-2];

/// A curve that is followed through the ranges of its parameters.
pub(crate) trait Continued: CurveEquations {
    /// What is looked at along it.
    type Functions: Clone;

    /// How far the steps go.
    fn options(&self) -> &OrbitOptions;

    /// Which coordinates are places of parameters in their ranges, from 0 to 1.
    fn places(&self) -> Range<usize>;

    /// The test functions at a point; `None` where there is no motion.
    fn functions(&self, point: &[f64]) -> Option<Self::Functions>;

    /// Why the branch ends at a point, or before it, other than by a range.
    fn ends(&self, node: &BranchPoint<Self::Functions>) -> Option<BranchEnd>;

    /// A point in all coordinates that mean the same, those near another one.
    fn images(&self, point: &[f64], near: &[f64]) -> Vec<Vec<f64>>;
}

/// A point of a branch.
#[derive(Clone, Debug)]
pub(crate) struct BranchPoint<T = TestFunctions> {
    /// Of motions of a word the phases, and the place in the range of the parameter.
    pub point: Vec<f64>,
    /// Along the branch.
    pub tangent: Vec<f64>,
    pub functions: T,
}

/// Why a branch ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BranchEnd {
    /// The parameter leaves its range.
    Range,
    /// A velocity or a time is 0 between the last two motions.
    Slow,
    /// It comes back to where it started.
    Closed,
    /// The motion repeats itself before its word ends, or two impacts come together.
    Shorter,
    /// No step on could be made.
    Lost,
}

/// A branch in one piece.
#[derive(Clone, Debug)]
pub(crate) struct Branch<T = TestFunctions> {
    /// In order along it.
    pub nodes: Vec<BranchPoint<T>>,
    /// The proof for each piece between two of them; `None` where it was leapt over.
    pub segments: Vec<Option<CertifiedSegment>>,
    /// At the first node and at the last.
    pub ends: [BranchEnd; 2],
}

impl<T: Clone> Branch<T> {
    /// The branch through a point of a curve.
    pub fn through<S: Continued<Functions = T>>(curve: &S, point: Vec<f64>) -> Option<Self> {
        let tangent = curve.first_tangent(&point)?;
        let functions = curve.functions(&point)?;
        let start = BranchPoint {
            point,
            tangent,
            functions,
        };
        let mut onwards = Continuation::new(curve, start.clone());
        let end = onwards.walk();
        if end == BranchEnd::Closed {
            let Continuation { nodes, segments, .. } = onwards;
            let ends = [BranchEnd::Closed; 2];
            return Some(Self { nodes, segments, ends });
        }
        let back = start.tangent.iter().map(|part| -part).collect();
        let mut backwards = Continuation::new(curve, BranchPoint { tangent: back, ..start });
        let start = backwards.walk();
        let (mut nodes, mut segments) = (backwards.nodes, backwards.segments);
        nodes.reverse();
        segments.reverse();
        for node in &mut nodes {
            node.tangent.iter_mut().for_each(|part| *part = -*part);
        }
        nodes.pop();
        nodes.extend(onwards.nodes);
        segments.extend(onwards.segments);
        let ends = [start, end];
        Some(Self { nodes, segments, ends })
    }

    /// Whether it is proved to pass through a solution within `room` of a point.
    pub fn holds(&self, curve: &impl Continued<Functions = T>, point: &[f64], room: f64) -> bool {
        let pieces = self.segments.iter().zip(self.nodes.windows(2));
        let mut near = pieces.filter_map(|(segment, pair)| Some((segment.as_ref()?, &pair[0].point, &pair[1].point)));
        near.any(|(segment, from, to)| {
            let is_beside = |i: usize| {
                let (low, high) = (from[i].min(to[i]), from[i].max(to[i]));
                point[i] >= low - segment.radius && point[i] <= high + segment.radius
            };
            curve.places().all(is_beside)
                && curve
                    .images(point, from)
                    .iter()
                    .any(|listed| segment.holds(listed, room))
        })
    }
}

impl Branch {
    /// The phases of likely motions at a place of the range, by cubic interpolation.
    pub fn proposals(&self, place: f64) -> Vec<Vec<f64>> {
        let pairs = self.nodes.windows(2);
        pairs.flat_map(|pair| proposals(&pair[0], &pair[1], place)).collect()
    }
}

/// The cubic through two motions with their tangents, at a part of the way.
pub(crate) fn between<T>(one: &BranchPoint<T>, other: &BranchPoint<T>, part: f64) -> Vec<f64> {
    let length = distance(&one.point, &other.point);
    let (s, rest) = (part, 1.0 - part);
    let weights = [
        rest * rest * (1.0 + 2.0 * s),
        s * s * (3.0 - 2.0 * s),
        length * s * rest * rest,
        -length * s * s * rest,
    ];
    let value = |i: usize| {
        let parts = [one.point[i], other.point[i], one.tangent[i], other.tangent[i]];
        dot(&weights, &parts)
    };
    (0..one.point.len()).map(value).collect()
}

/// Places at which a piece is looked at for turns within it.
const PIECES: usize = 8;

fn proposals(one: &BranchPoint, other: &BranchPoint, place: f64) -> Vec<Vec<f64>> {
    let last = one.point.len() - 1;
    let turns = one.tangent[last] * other.tangent[last] <= 0.0;
    let pieces = if turns { PIECES } else { 1 };
    let ahead = |part: f64| between(one, other, part)[last] - place;
    let mut found = Vec::new();
    let mut low = (0.0, ahead(0.0));
    for piece in 1..=pieces {
        let part = piece as f64 / pieces as f64;
        let high = (part, ahead(part));
        if low.1 == 0.0 || low.1 * high.1 < 0.0 || (piece == pieces && high.1 == 0.0) {
            let (mut near, mut far) = (low, high);
            for _ in 0..50 {
                let part = 0.5 * (near.0 + far.0);
                let middle = (part, ahead(part));
                if (middle.1 < 0.0) == (near.1 < 0.0) && near.1 != 0.0 {
                    near = middle;
                } else {
                    far = middle;
                }
            }
            let part = if low.1 == 0.0 { low.0 } else { far.0 };
            let mut phases = between(one, other, part);
            phases.truncate(last);
            found.push(phases);
        }
        low = high;
    }
    found
}

pub(crate) fn distance(one: &[f64], other: &[f64]) -> f64 {
    let squares = one.iter().zip(other).map(|(one, other)| (one - other) * (one - other));
    squares.sum::<f64>().sqrt()
}

/// The way in one direction.
struct Continuation<'a, S: Continued> {
    curve: &'a S,
    nodes: Vec<BranchPoint<S::Functions>>,
    segments: Vec<Option<CertifiedSegment>>,
}

/// What a step comes to.
enum Step<T> {
    Next(BranchPoint<T>),
    /// At the end of a range.
    Last(BranchPoint<T>),
}

/// A step with its proof, if it has one, and its length.
type Stepped<T> = (Step<T>, Option<CertifiedSegment>, f64);

impl<'a, S: Continued> Continuation<'a, S> {
    fn new(curve: &'a S, start: BranchPoint<S::Functions>) -> Self {
        let nodes = vec![start];
        let segments = Vec::new();
        Self { curve, nodes, segments }
    }

    fn walk(&mut self) -> BranchEnd {
        let mut length = FIRST_STEP;
        for _ in 0..self.curve.options().most_steps {
            let here = self.nodes[self.nodes.len() - 1].clone();
            let leaves = |i: usize| {
                let (place, ahead) = (here.point[i], here.tangent[i]);
                (place <= 0.0 && ahead < 0.0) || (place >= 1.0 && ahead > 0.0)
            };
            if self.curve.places().any(leaves) {
                return BranchEnd::Range;
            }
            let Some((step, segment, used)) = self.proved_step(&here, length).or_else(|| self.leap(&here)) else {
                return BranchEnd::Lost;
            };
            let (node, is_last) = match step {
                Step::Next(node) => (node, false),
                Step::Last(node) => (node, true),
            };
            let end = self.curve.ends(&node);
            self.nodes.push(node);
            self.segments.push(segment);
            match end {
                Some(BranchEnd::Slow) => return BranchEnd::Slow,
                _ if is_last => return BranchEnd::Range,
                Some(end) => return end,
                None if self.is_closed() => return BranchEnd::Closed,
                None => {}
            }
            length = (used * GROWTH).min(self.curve.options().longest_step);
        }
        BranchEnd::Lost
    }

    /// The longest step not above `length` that can be proved, half of it by half.
    fn proved_step(&self, here: &BranchPoint<S::Functions>, length: f64) -> Option<Stepped<S::Functions>> {
        let mut length = length;
        while length > self.curve.options().shortest_step {
            if let Some(step) = self.step(here, length) {
                let (Step::Next(node) | Step::Last(node)) = &step;
                if let Some(segment) = CertifiedSegment::prove(self.curve, &here.point, &node.point) {
                    return Some((step, Some(segment), length));
                }
            }
            length *= 0.5;
        }
        None
    }

    fn leap(&self, here: &BranchPoint<S::Functions>) -> Option<Stepped<S::Functions>> {
        LEAPS
            .iter()
            .find_map(|length| Some((self.step(here, *length)?, None, FIRST_STEP.min(*length))))
    }

    fn step(&self, here: &BranchPoint<S::Functions>, length: f64) -> Option<Step<S::Functions>> {
        let ahead = |length: f64| -> Vec<f64> {
            let pairs = here.point.iter().zip(&here.tangent);
            pairs.map(|(at, part)| at + length * part).collect()
        };
        let guess = ahead(length);
        // the end of a range on the way, and how far it is: one so near that no step would be left to it counts
        let beyond = ahead(REACH * length);
        let ends = self.curve.places().filter_map(|i| {
            let end = if beyond[i] > 1.0 {
                1.0
            } else if beyond[i] < 0.0 {
                0.0
            } else {
                return None;
            };
            Some((i, end, (end - here.point[i]) / here.tangent[i]))
        });
        let end = ends.min_by(|(_, _, one), (_, _, other)| one.total_cmp(other));
        let (point, moved) = match end {
            Some((i, end, part)) => self.curve.solved_at(&ahead(part), i, end)?,
            None => self
                .curve
                .corrected(&guess, &here.tangent, dot(&guess, &here.tangent))?,
        };
        if moved > NEAR * length || !self.curve.places().all(|i| (0.0..=1.0).contains(&point[i])) {
            return None;
        }
        let tangent = self.curve.tangent(&point, &here.tangent)?;
        if dot(&tangent, &here.tangent) < STRAIGHT {
            return None;
        }
        let functions = self.curve.functions(&point)?;
        let node = BranchPoint {
            point,
            tangent,
            functions,
        };
        Some(if end.is_some() {
            Step::Last(node)
        } else {
            Step::Next(node)
        })
    }

    /// Whether the branch came round to its first point.
    fn is_closed(&self) -> bool {
        let (Some(start), Some(Some(segment))) = (self.nodes.first(), self.segments.last()) else {
            return false;
        };
        if self.nodes.len() < 4 {
            return false;
        }
        let from = &self.nodes[self.nodes.len() - 2].point;
        let images = self.curve.images(&start.point, from);
        images.iter().any(|listed| segment.holds(listed, 0.0))
    }
}

/// This near, in radians, a motion of a shorter word is taken to be the end of the branch.
pub(crate) const TOGETHER: f64 = 1e-4;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;
    use crate::orbit::continuation::extended_system::ExtendedSystem;
    use crate::orbit::family::Family;
    use crate::orbit::interval_box::apart;
    use crate::orbit::solve::starts::brought_near;
    use crate::orbit::solve::words::search_word;
    use numbers::Interval;
    use std::f64::consts::PI;

    #[test]
    fn a_branch_passes_through_every_motion_it_was_proved_to() {
        let family = Motion::new(0.12201, 0.3, 0.6, 0.3).expect("a motion");
        let extended = ExtendedSystem {
            family: &family,
            word: "BTT".parse().expect("a word"),
            periods: 1,
            range: Interval::new(0.1, 0.5),
            options: OrbitOptions::DEFAULT,
        };
        let place = extended.place(0.2);
        let at = |place: f64| {
            family
                .motion_at(&extended.parameter(&Interval::point(place)))
                .expect("a motion")
        };
        let cycles = search_word(&extended.word, 1, &at(place), &OrbitOptions::DEFAULT).expect("a search");
        assert!(!cycles.is_empty());
        for cycle in &cycles {
            let branch = Branch::through(&extended, [cycle.phases(), &[place]].concat()).expect("a branch");
            assert!(
                branch.ends.iter().all(|end| *end != BranchEnd::Lost),
                "{:?}",
                branch.ends
            );
            assert!(branch.segments.iter().all(Option::is_some));
            assert!(branch.holds(&extended, &[cycle.phases(), &[place]].concat(), 1e-9));
            let near = |phases: &Vec<f64>| apart(&brought_near(phases, PI), cycle.phases()) < 1e-6;
            assert!(branch.proposals(place).iter().any(near));
        }
    }
}
