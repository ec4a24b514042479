//! Curves of bifurcations followed from points on lines across the rectangle of two parameters: each once, on every core.

use crate::orbit::continuation::branch::{Branch, Continued};
use crate::orbit::continuation::curve::dot;
use crate::orbit::curves::follow::CurvePoint;
use crate::orbit::parallel::each;
use std::collections::VecDeque;

/// A bifurcation found on a line is known to this, in radians, times and parts of a range.
pub(crate) const ROOM: f64 = 1e-9;

/// Newton's method may not lead farther than this from one.
const NEAR: f64 = 1e-4;

/// The curves of one kind of motions over a plane of parameters.
pub(crate) trait PlaneCurves: Sync {
    /// The condition that holds on a curve.
    type Condition: PartialEq + Sync;
    /// The test functions along it.
    type Functions: Clone + Send + Sync;
    /// Its equations.
    type Curve<'a>: Continued<Functions = Self::Functions>
    where
        Self: 'a;
    /// The data for the row of a bifurcation whose curve cannot be followed.
    type Lost: Sync;

    /// The equations of the curves on which a condition holds.
    fn curve(&self, condition: &Self::Condition) -> Self::Curve<'_>;

    /// The points of a curve, in order along it.
    fn points(&self, condition: &Self::Condition, branch: &Branch<Self::Functions>) -> Vec<CurvePoint>;

    /// The one point that is known of a curve that could not be followed.
    fn lost(&self, start: &Start<Self>) -> Vec<CurvePoint>;
}

/// A bifurcation on a line, from which its curve is followed.
pub(crate) struct Start<C: PlaneCurves + ?Sized> {
    pub condition: C::Condition,
    /// In the coordinates of the curve.
    pub point: Vec<f64>,
    pub lost: C::Lost,
}

/// The curves that starts lead to, one after the other: a start on a curve that was followed before leads to none.
pub(crate) struct CurveQueue<C: PlaneCurves> {
    pub starts: VecDeque<Start<C>>,
    followed: Vec<Followed<C>>,
    ready: VecDeque<Vec<CurvePoint>>,
}

/// A start, and the curve that it leads to, if it can be followed.
type Followed<C> = (Start<C>, Option<Branch<<C as PlaneCurves>::Functions>>);

impl<C: PlaneCurves> CurveQueue<C> {
    pub fn new() -> Self {
        Self {
            starts: VecDeque::new(),
            followed: Vec::new(),
            ready: VecDeque::new(),
        }
    }

    /// The points of the next curve; of one that cannot be followed, the start.
    ///
    /// Follows as many starts at once as there are threads. One that turns out to lie on the curve of another is
    /// dropped, so that what comes out does not depend on their number.
    pub fn next(&mut self, curves: &C) -> Option<Vec<CurvePoint>> {
        while self.ready.is_empty() {
            let mut batch: Vec<Start<C>> = Vec::new();
            while batch.len() < rayon::current_num_threads() {
                let Some(start) = self.starts.pop_front() else { break };
                if !self.is_known(curves, &start) {
                    batch.push(start);
                }
            }
            if batch.is_empty() {
                return None;
            }
            let branches = each(&batch, |start| follow(&curves.curve(&start.condition), &start.point));
            let before = self.followed.len();
            for (start, branch) in batch.into_iter().zip(branches) {
                if !self.is_known(curves, &start) {
                    self.followed.push((start, branch));
                }
            }
            self.ready.extend(each(&self.followed[before..], |(start, branch)| {
                let points = branch.as_ref().map(|branch| curves.points(&start.condition, branch));
                points
                    .filter(|points| !points.is_empty())
                    .unwrap_or_else(|| curves.lost(start))
            }));
        }
        self.ready.pop_front()
    }

    /// Returns true if a start lies on a curve that was followed.
    fn is_known(&self, curves: &C, start: &Start<C>) -> bool {
        let curve = curves.curve(&start.condition);
        self.followed.iter().any(|(other, branch)| {
            let branch = branch.as_ref().filter(|_| other.condition == start.condition);
            branch.is_some_and(|branch| branch.holds(&curve, &start.point, ROOM))
        })
    }
}

/// Follows the curve through a point in both directions; `None` where no curve is found there.
fn follow<S: Continued>(curve: &S, at: &[f64]) -> Option<Branch<S::Functions>> {
    // on a side of the rectangle, exactly on it
    let side = curve.places().find(|i| at[*i] < ROOM || at[*i] > 1.0 - ROOM);
    let (mut point, moved) = match side {
        Some(i) => curve.solved_at(at, i, at[i].round())?,
        None => {
            let tangent = curve.first_tangent(at)?;
            curve.corrected(at, &tangent, dot(at, &tangent))?
        }
    };
    for i in curve.places() {
        point[i] = point[i].clamp(0.0, 1.0);
    }
    (moved < NEAR).then(|| Branch::through(curve, point))?
}

/// The lines across a rectangle on which starts are looked for, its sides first: the parameter that is held, 0 or 1, and
/// at which of the values from 0 to `lines`.
pub(crate) fn scanned_lines(lines: u32) -> Vec<(usize, u32)> {
    let indices = [0, lines].into_iter().chain(1..lines);
    indices.flat_map(|index| [(0, index), (1, index)]).collect()
}
