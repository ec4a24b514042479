//! A curve of bifurcations as the points that are reported: its steps, its special points and its ends.

use crate::model::Side;
use crate::orbit::bifurcation::one_one::KnownMotion;
use crate::orbit::bifurcation::point::{BifurcationPoint, EnclosedBifurcation};
use crate::orbit::continuation::branch::{Branch, BranchEnd, BranchPoint};
use crate::orbit::continuation::extended_system::parameter_at;
use crate::orbit::continuation::segment::CertifiedSegment;
use crate::orbit::curves::curve_system::{CurveCondition, CurveFunctions, CurveSystem, PLACES, TOUCH, across};
use crate::orbit::curves::special_points::{Found, SAME, SpecialPoint, on_piece};
use crate::orbit::equations::conditions::BifurcationCondition::{MultiplierOne, ZeroVelocity};
use crate::orbit::family::ParameterPlane;
use numbers::{Doubles, Interval};

/// A point of a curve of bifurcations over two parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// What it is on the curve.
    pub special: SpecialPoint,
    /// The motion there; `parameter` is the first of the two. The error bound is that of both parameters too, and stands for
    /// a proof that there is such a point.
    pub motion: BifurcationPoint,
    /// The second parameter.
    pub y: f64,
    /// Whether it is known if the ball keeps between the walls, and by how much.
    pub has_clearance: bool,
    /// Whether it is proved that one curve of such bifurcations, and no other beside it, leads here from the point before;
    /// `None` at the first point.
    pub is_joined: Option<bool>,
}

/// The points of a branch, in order.
pub(crate) fn points<P: ParameterPlane>(
    curve: &CurveSystem<'_, P>,
    branch: &Branch<CurveFunctions>,
) -> Vec<CurvePoint> {
    let nodes = &branch.nodes;
    let is_beyond = |index: usize| curve.is_beyond(&nodes[index]);
    let mut told = Told {
        curve,
        points: Vec::new(),
        before: None,
    };
    if !is_beyond(0) {
        told.node(&nodes[0], branch.ends[0], None);
    }
    let last = nodes.len() - 1;
    for (index, segment) in branch.segments.iter().enumerate() {
        let (starts_beyond, ends_beyond) = (is_beyond(index), is_beyond(index + 1));
        let mut found = on_piece(curve, &nodes[index], &nodes[index + 1]);
        let mut end = if index + 1 == last {
            branch.ends[1]
        } else {
            BranchEnd::Shorter
        };
        // what lies behind the end of the curve is not on it
        if starts_beyond {
            match found.iter().rposition(is_end) {
                Some(first) => drop(found.drain(..first)),
                None => end = BranchEnd::Lost,
            }
        }
        if ends_beyond {
            match found.iter().position(is_end) {
                Some(last) => found.truncate(last + 1),
                None => told.lose(),
            }
        }
        for found in found {
            told.special(&found, segment.as_ref());
        }
        if !ends_beyond {
            told.node(&nodes[index + 1], end, segment.as_ref());
        }
    }
    told.points
}

/// The one point known of a curve that could not be followed, on the line where this coordinate is fixed.
pub(crate) fn lost<P: ParameterPlane>(curve: &CurveSystem<'_, P>, at: &[f64], fixed: usize) -> Vec<CurvePoint> {
    let mut told = Told {
        curve,
        points: Vec::new(),
        before: None,
    };
    let line = curve.with(CurveCondition::Place(fixed, at[fixed]));
    told.push(&line, at, SpecialPoint::Lost, false, None);
    told.points
}

/// Returns true if the curve ends at a special point: an impact has velocity 0, or the touch comes together with its impact.
fn is_end(found: &Found) -> bool {
    match found.condition {
        CurveCondition::Bifurcation(ZeroVelocity(_)) => true,
        CurveCondition::TouchPush => found.at[TOUCH].abs() < SAME,
        _ => false,
    }
}

/// The points told so far.
struct Told<'a, P> {
    curve: &'a CurveSystem<'a, P>,
    points: Vec<CurvePoint>,
    before: Option<(Vec<f64>, Option<f64>)>,
}

impl<P: ParameterPlane> Told<'_, P> {
    /// A node, which is an end or none.
    fn node(&mut self, node: &BranchPoint<CurveFunctions>, end: BranchEnd, segment: Option<&CertifiedSegment>) {
        let edge = PLACES
            .into_iter()
            .find(|i| node.point[*i] <= 0.0 || node.point[*i] >= 1.0);
        let (condition, special) = match (end, edge) {
            (BranchEnd::Range, Some(i)) => (CurveCondition::Place(i, node.point[i]), SpecialPoint::Edge),
            (BranchEnd::Closed, _) if !self.points.is_empty() => {
                (across(&node.point, &node.tangent), SpecialPoint::Closed)
            }
            (BranchEnd::Lost, _) => (across(&node.point, &node.tangent), SpecialPoint::Lost),
            _ => (across(&node.point, &node.tangent), SpecialPoint::Step),
        };
        self.push(&self.curve.with(condition), &node.point, special, false, segment);
    }

    /// Reports a special point on a piece.
    fn special(&mut self, found: &Found, segment: Option<&CertifiedSegment>) {
        let Found { point, condition, at } = found;
        let grazes = matches!(point, SpecialPoint::Grazing | SpecialPoint::DoubleGrazing) || is_end(found);
        let system = match (condition, self.curve.touch()) {
            // the touch is the impact itself, which has velocity 0 while f + g is 0
            (CurveCondition::TouchPush, Some((_, wall))) if is_end(found) => {
                let impact = usize::from(wall == Side::Top);
                CurveSystem {
                    conditions: vec![
                        CurveCondition::Bifurcation(ZeroVelocity(impact)),
                        CurveCondition::Push(impact),
                    ],
                    ..*self.curve
                }
            }
            _ => self.curve.with(condition.clone()),
        };
        self.push(&system, &at[..system.unknowns()], *point, grazes, segment);
    }

    /// Marks the last point as one from which no end of the curve was found.
    fn lose(&mut self) {
        if let Some(last) = self.points.last_mut() {
            last.special = SpecialPoint::Lost;
        }
    }

    /// The solution of a square system about a point.
    fn push(
        &mut self,
        system: &CurveSystem<'_, P>,
        at: &[f64],
        special: SpecialPoint,
        grazes: bool,
        segment: Option<&CertifiedSegment>,
    ) {
        let root = system.proved(at);
        let mut cell: Vec<Interval<f64>> = match &root {
            Some(root) => root.enclosure[..at.len()].to_vec(),
            None => at.iter().map(|side| Interval::point(*side)).collect(),
        };
        for condition in &system.conditions {
            if let CurveCondition::Place(coordinate, place) = condition {
                cell[*coordinate] = Interval::point(*place);
            }
        }
        // without its time the touch is at its impact
        let mut middle: Vec<f64> = cell.iter().map(Interval::midpoint).collect();
        middle.resize(middle.len().max(self.curve.unknowns()), 0.0);
        let widest = cell.iter().map(|side| side.width()).fold(0.0, f64::max);
        let here = (middle, root.is_some().then_some(widest));
        let holds = |segment: &CertifiedSegment, (point, room): &(Vec<f64>, Option<f64>)| {
            let dimension = self.curve.unknowns();
            room.is_some_and(|room| segment.holds(&point[..dimension], room))
        };
        let is_joined = self
            .before
            .as_ref()
            .map(|before| segment.is_some_and(|segment| holds(segment, &here) && holds(segment, before)));
        if let Some(point) = motion_at(system, &cell, root.is_some(), grazes) {
            let (motion, y, has_clearance) = point;
            self.points.push(CurvePoint {
                special,
                motion,
                y,
                has_clearance,
                is_joined,
            });
            self.before = Some(here);
        }
    }
}

/// The motion of a solution in a box, its second parameter, and whether its clearance is known.
fn motion_at<P: ParameterPlane>(
    system: &CurveSystem<'_, P>,
    cell: &[Interval<f64>],
    is_proved: bool,
    grazes: bool,
) -> Option<(BifurcationPoint, f64, bool)> {
    let motion = system.motion(&cell[PLACES])?;
    let [x, y]: [Interval<f64>; 2] =
        std::array::from_fn(|i| parameter_at(&system.plane.ranges()[i], &cell[PLACES.start + i]));
    // an impact of velocity 0, of any of the conditions, has an infinite trace
    let slow = system.conditions.iter().find_map(|condition| match condition {
        CurveCondition::Bifurcation(slow @ ZeroVelocity(_)) => Some(*slow),
        _ => None,
    });
    let own = match system.own() {
        CurveCondition::Bifurcation(own) => *own,
        _ => MultiplierOne,
    };
    let touches = system.conditions.iter().any(CurveCondition::is_touch);
    let known = KnownMotion {
        kind: system.own().kind(),
        condition: slow.unwrap_or(own),
        motion: &motion,
        periods: system.periods,
        place: [x, cell[0], cell[1]],
    };
    let clearance = known.clearance(grazes || touches);
    let has_clearance = clearance.is_ok();
    let enclosed = EnclosedBifurcation {
        certified: is_proved,
        ..known.with(clearance.unwrap_or((None, false)))
    };
    let mut point = enclosed.rounded(&Doubles);
    let middle = y.midpoint();
    let error = (y.high() - middle).max(middle - y.low()).next_up();
    point.error_bound = point.error_bound.map(|bound| bound.max(error));
    Some((point, middle, has_clearance))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Motion, MotionError};
    use crate::orbit::continuation::curve::{CurveEquations, dot};
    use crate::orbit::equations::conditions::BifurcationCondition;
    use numbers::Analytic;

    /// The paper's device over d and r_B.
    struct Device;

    impl ParameterPlane for Device {
        type Line = Motion<f64>;

        fn motion_at<T: Analytic>(&self, [d, r_b]: [&T; 2]) -> Result<Motion<T>, MotionError> {
            Motion::new(
                T::from_ratio(12_201, 100_000),
                d.clone(),
                r_b.clone(),
                T::from_ratio(1, 2),
            )
        }

        fn ranges(&self) -> [Interval<f64>; 2] {
            [Interval::new(0.1, 0.6), Interval::new(0.2, 0.8)]
        }

        fn line(&self, _: usize, _: u32, _: u32) -> (Motion<f64>, f64) {
            (Motion::new(0.122_01, 0.3, 0.5, 0.5).expect("a motion"), 0.5)
        }

        fn is_symmetric(&self) -> bool {
            false
        }
    }

    #[test]
    fn steps_that_adjoin_share_their_point_and_a_step_off_the_curve_is_not_proved() {
        let curve = CurveSystem {
            plane: &Device,
            periods: 1,
            conditions: vec![CurveCondition::Bifurcation(BifurcationCondition::MultiplierMinusOne)],
            options: crate::orbit::options::OrbitOptions::DEFAULT,
        };
        // FACTS: the period doubling at d = .25107018538986923, r .5 .5; from the orbit at .26
        let guess = [1.317, 0.1481 + 0.5 * std::f64::consts::PI * 1.317, 0.302, 0.5];
        let start = curve
            .with(CurveCondition::Place(3, 0.5))
            .solved(&guess)
            .expect("a start");
        assert!(
            (start[2] - (0.251_070_185_389_869_23 - 0.1) / 0.5).abs() < 1e-12,
            "{start:?}"
        );
        let branch = Branch::through(&curve, start).expect("a branch");
        assert_eq!(branch.ends, [BranchEnd::Range; 2]);
        let segments: Vec<&CertifiedSegment> = branch.segments.iter().flatten().collect();
        assert!(segments.len() == branch.segments.len() && segments.len() > 20);
        for (index, node) in branch.nodes.iter().enumerate() {
            let beside = [index.checked_sub(1), Some(index)].into_iter().flatten();
            for segment in beside.filter_map(|index| segments.get(index)) {
                assert!(segment.holds(&node.point, 1e-11), "{index}");
            }
        }
        for (pair, segment) in branch.nodes.windows(2).zip(&segments) {
            let (from, to) = (&pair[0].point, &pair[1].point);
            let chord: Vec<f64> = to.iter().zip(from).map(|(to, from)| to - from).collect();
            for part in [0.25, 0.5, 0.75] {
                let guess: Vec<f64> = from
                    .iter()
                    .zip(&chord)
                    .map(|(from, chord)| from + part * chord)
                    .collect();
                let (point, _) = curve.corrected(&guess, &chord, dot(&guess, &chord)).expect("a point");
                assert!(segment.holds(&point, 1e-11));
            }
            let mut off = to.clone();
            off[0] += 2.0 * segment.radius;
            assert!(!segment.holds(&off, 0.0) && CertifiedSegment::prove(&curve, from, &off).is_none());
        }
        // the special points are those of the curve's points, in order of the second parameter
        let points = points(&curve, &branch);
        let rising = points
            .windows(2)
            .all(|pair| (pair[0].y < pair[1].y) == (points[0].y < points[1].y));
        assert!(rising && points.iter().skip(1).all(|point| point.is_joined == Some(true)));
    }
}
