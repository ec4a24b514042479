//! One branch of motions: from a motion on it, in both directions, to where it ends.

use crate::orbit::continuation::extended_system::{ExtendedSystem, dot};
use crate::orbit::continuation::segment::CertifiedSegment;
use crate::orbit::continuation::test_functions::TestFunctions;
use crate::orbit::family::Family;
use crate::orbit::interval_box::apart;
use crate::orbit::solve::starts::{brought_near, listed_from};
use crate::orbit::solve::words::WordOrbit;
use std::f64::consts::PI;

/// The first step, in radians and ranges of the parameter.
const FIRST_STEP: f64 = 0.01;

/// A step may be so much longer than the one before.
const GROWTH: f64 = 1.6;

/// Newton's method may go this part of a step from its prediction.
const NEAR: f64 = 0.1;

/// The least cosine between the tangents at both ends of a step.
const STRAIGHT: f64 = 0.9;

/// Steps tried where none can be proved, as where two branches cross: over the point rather than onto it.
const LEAPS: [f64; 4] = [1e-4, 1e-3, 3e-3, 1e-2];

/// A motion of a branch.
#[derive(Clone, Debug)]
pub(crate) struct BranchPoint {
    /// The phases, and the place in the range of the parameter.
    pub point: Vec<f64>,
    /// Along the branch.
    pub tangent: Vec<f64>,
    pub functions: TestFunctions,
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
pub(crate) struct Branch {
    /// In order along it.
    pub nodes: Vec<BranchPoint>,
    /// The proof for each piece between two of them; `None` where it was leapt over.
    pub segments: Vec<Option<CertifiedSegment>>,
    /// At the first node and at the last.
    pub ends: [BranchEnd; 2],
}

impl Branch {
    /// The branch through a motion at a place of the range.
    pub fn through(extended: &ExtendedSystem<impl Family>, phases: &[f64], place: f64) -> Option<Self> {
        let mut point = phases.to_vec();
        point.push(place);
        let tangent = extended.first_tangent(&point)?;
        let functions = TestFunctions::new(&extended.at_place(&place)?, phases);
        let start = BranchPoint {
            point,
            tangent,
            functions,
        };
        let mut onwards = Continuation::new(extended, start.clone());
        let end = onwards.walk();
        if end == BranchEnd::Closed {
            let Continuation { nodes, segments, .. } = onwards;
            let ends = [BranchEnd::Closed; 2];
            return Some(Self { nodes, segments, ends });
        }
        let back = start.tangent.iter().map(|part| -part).collect();
        let mut backwards = Continuation::new(extended, BranchPoint { tangent: back, ..start });
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

    /// Whether it passes through a motion at a place of the range.
    pub fn holds(&self, extended: &ExtendedSystem<impl Family>, cycle: &WordOrbit, place: f64) -> bool {
        let firsts: Vec<usize> = std::iter::once(0).chain(extended.word.symmetries()).collect();
        let pieces = self.segments.iter().zip(self.nodes.windows(2));
        let mut near = pieces.filter_map(|(segment, pair)| Some((segment.as_ref()?, &pair[0].point, &pair[1].point)));
        near.any(|(segment, from, to)| {
            let last = from.len() - 1;
            let (low, high) = (from[last].min(to[last]), from[last].max(to[last]));
            place >= low - segment.radius
                && place <= high + segment.radius
                && firsts.iter().any(|first| {
                    let mut listed = brought_near(&listed_from(cycle.phases(), *first, extended.periods), from[0]);
                    listed.push(place);
                    segment.holds(&listed, 1e-9)
                })
        })
    }

    /// The phases of likely motions at a place of the range, by cubic interpolation.
    pub fn proposals(&self, place: f64) -> Vec<Vec<f64>> {
        let pairs = self.nodes.windows(2);
        pairs.flat_map(|pair| proposals(&pair[0], &pair[1], place)).collect()
    }
}

/// The cubic through two motions with their tangents, at a part of the way.
pub(crate) fn between(one: &BranchPoint, other: &BranchPoint, part: f64) -> Vec<f64> {
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
struct Continuation<'a, F> {
    extended: &'a ExtendedSystem<F>,
    nodes: Vec<BranchPoint>,
    segments: Vec<Option<CertifiedSegment>>,
}

/// What a step comes to.
enum Step {
    Next(BranchPoint),
    /// At the end of the range.
    Last(BranchPoint),
}

impl<'a, F: Family> Continuation<'a, F> {
    fn new(extended: &'a ExtendedSystem<F>, start: BranchPoint) -> Self {
        let nodes = vec![start];
        let segments = Vec::new();
        Self {
            extended,
            nodes,
            segments,
        }
    }

    fn walk(&mut self) -> BranchEnd {
        let mut length = FIRST_STEP;
        for _ in 0..self.extended.options.most_steps {
            let here = self.nodes[self.nodes.len() - 1].clone();
            let (place, ahead) = (here.point[here.point.len() - 1], here.tangent[here.tangent.len() - 1]);
            if (place <= 0.0 && ahead < 0.0) || (place >= 1.0 && ahead > 0.0) {
                return BranchEnd::Range;
            }
            let Some((step, segment, used)) = self.proved_step(&here, length).or_else(|| self.leap(&here)) else {
                return BranchEnd::Lost;
            };
            let (node, is_last) = match step {
                Step::Next(node) => (node, false),
                Step::Last(node) => (node, true),
            };
            let moves = node.functions.moves();
            let shorter = self.is_shorter(&node);
            self.nodes.push(node);
            self.segments.push(segment);
            if !moves {
                return BranchEnd::Slow;
            }
            if is_last {
                return BranchEnd::Range;
            }
            if shorter {
                return BranchEnd::Shorter;
            }
            if self.is_closed() {
                return BranchEnd::Closed;
            }
            length = (used * GROWTH).min(self.extended.options.longest_step);
        }
        BranchEnd::Lost
    }

    /// The longest step not above `length` that can be proved, half of it by half.
    fn proved_step(&self, here: &BranchPoint, length: f64) -> Option<(Step, Option<CertifiedSegment>, f64)> {
        let mut length = length;
        while length > self.extended.options.shortest_step {
            if let Some(step) = self.step(here, length) {
                let (Step::Next(node) | Step::Last(node)) = &step;
                if let Some(segment) = CertifiedSegment::prove(self.extended, &here.point, &node.point) {
                    return Some((step, Some(segment), length));
                }
            }
            length *= 0.5;
        }
        None
    }

    fn leap(&self, here: &BranchPoint) -> Option<(Step, Option<CertifiedSegment>, f64)> {
        LEAPS
            .iter()
            .find_map(|length| Some((self.step(here, *length)?, None, FIRST_STEP.min(*length))))
    }

    fn step(&self, here: &BranchPoint, length: f64) -> Option<Step> {
        let last = here.point.len() - 1;
        let ahead = |length: f64| -> Vec<f64> {
            let pairs = here.point.iter().zip(&here.tangent);
            pairs.map(|(at, part)| at + length * part).collect()
        };
        let guess = ahead(length);
        let end = if guess[last] > 1.0 {
            Some(1.0)
        } else if guess[last] < 0.0 {
            Some(0.0)
        } else {
            None
        };
        let (point, moved) = match end {
            Some(end) => {
                let part = (end - here.point[last]) / here.tangent[last];
                self.extended.solved_at(&ahead(part), end)?
            }
            None => self
                .extended
                .corrected(&guess, &here.tangent, dot(&guess, &here.tangent))?,
        };
        if moved > NEAR * length || !(0.0..=1.0).contains(&point[last]) {
            return None;
        }
        let tangent = self.extended.tangent(&point, &here.tangent)?;
        if dot(&tangent, &here.tangent) < STRAIGHT {
            return None;
        }
        let phases = &point[..last];
        let functions = TestFunctions::new(&self.extended.at_place(&point[last])?, phases);
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

    /// Whether the branch came round to its first motion.
    fn is_closed(&self) -> bool {
        let (Some(start), Some(Some(segment))) = (self.nodes.first(), self.segments.last()) else {
            return false;
        };
        if self.nodes.len() < 4 {
            return false;
        }
        let from = &self.nodes[self.nodes.len() - 2].point;
        let last = from.len() - 1;
        let firsts = std::iter::once(0).chain(self.extended.word.symmetries());
        firsts.into_iter().any(|first| {
            let listed = listed_from(&start.point[..last], first, self.extended.periods);
            let mut listed = brought_near(&listed, from[0]);
            listed.push(start.point[last]);
            segment.holds(&listed, 0.0)
        })
    }

    /// Whether a motion all but repeats itself, or two of its impacts all but come together.
    fn is_shorter(&self, node: &BranchPoint) -> bool {
        let last = node.point.len() - 1;
        let phases = &node.point[..last];
        let mut repeats = self.extended.word.symmetries().map(|first| {
            let listed = listed_from(phases, first, self.extended.periods);
            apart(&brought_near(&listed, phases[0]), phases)
        });
        let shortest = node.functions.times.iter().copied().fold(f64::INFINITY, f64::min);
        repeats.any(|apart| apart < TOGETHER) || PI * shortest < TOGETHER
    }
}

/// This near, in radians, a motion of a shorter word is taken to be the end of the branch.
pub(crate) const TOGETHER: f64 = 1e-4;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;
    use crate::number::Interval;
    use crate::orbit::options::OrbitOptions;
    use crate::orbit::solve::words::search_word;

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
            let branch = Branch::through(&extended, cycle.phases(), place).expect("a branch");
            assert!(
                branch.ends.iter().all(|end| *end != BranchEnd::Lost),
                "{:?}",
                branch.ends
            );
            assert!(branch.segments.iter().all(Option::is_some));
            assert!(branch.holds(&extended, cycle, place));
            let near = |phases: &Vec<f64>| apart(&brought_near(phases, PI), cycle.phases()) < 1e-6;
            assert!(branch.proposals(place).iter().any(near));
        }
    }
}
