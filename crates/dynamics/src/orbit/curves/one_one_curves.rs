//! All curves of bifurcations of 1-1 motions over two parameters that lines across their rectangle lead to.

use crate::orbit::bifurcation::one_one::LocatedBifurcation;
use crate::orbit::continuation::branch::Branch;
use crate::orbit::continuation::curve::{CurveEquations, dot};
use crate::orbit::continuation::extended_system::place_of;
use crate::orbit::curves::curve_system::{CurveCondition, CurveFunctions, CurveSystem, PLACES};
use crate::orbit::curves::follow::{CurvePoint, lost, points};
use crate::orbit::equations::conditions::{BifurcationCondition, BifurcationKind};
use crate::orbit::family::ParameterPlane;
use crate::orbit::interval_box::IntervalBox;
use crate::orbit::one_one_branches::OneOneBranches;
use crate::orbit::options::OrbitOptions;
use crate::orbit::parallel::each;
use crate::orbit::solve::cover::CoverError;
use numbers::{Analytic, Interval};
use std::collections::VecDeque;

/// A bifurcation found on a line is known to this, in radians, times and parts of a range.
const ROOM: f64 = 1e-9;

/// Newton's method may not lead farther than this from one.
const NEAR: f64 = 1e-4;

/// A bifurcation found on a line, from which its curve is followed.
struct Start {
    condition: CurveCondition,
    /// The coordinate that is fixed along the line.
    fixed: usize,
    point: Vec<f64>,
}

/// The curves of folds, period doublings, symmetry breakings and grazings of 1-1 motions that take so many periods, one
/// after the other, computed as they are asked for.
///
/// Along lines across the rectangle, its sides among them, every bifurcation is found and proved
/// ([`OneOneBranches`]); each is followed in both directions to where its curve ends, if it lies on no curve that is
/// known. Each point is proved by itself, and from each to the next it is proved that one curve leads there
/// (Krawczyk's test with the place along the step as a parameter). **Complete are the crossings with these lines**: a
/// closed curve between them is not seen.
pub struct OneOneCurves<P> {
    plane: P,
    periods: u32,
    options: OrbitOptions,
    starts: VecDeque<Start>,
    undecided: Vec<(BifurcationKind, IntervalBox<f64, 4>)>,
    known: Vec<(CurveCondition, Branch<CurveFunctions>)>,
}

impl<P: ParameterPlane> OneOneCurves<P> {
    /// Looks for bifurcations along the sides and along `lines` - 1 lines between them, in both directions; at least 1.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn new(plane: P, periods: u32, lines: u32, options: &OrbitOptions) -> Result<Self, CoverError> {
        // the sides first
        let mut scanned: Vec<(usize, u32)> = Vec::new();
        for index in [0, lines].into_iter().chain(1..lines) {
            scanned.extend([(0, index), (1, index)]);
        }
        let found = each(&scanned, |(fixed, index)| {
            let (line, value) = plane.line(*fixed, *index, lines);
            let along = OneOneBranches::new(line, periods, plane.ranges()[1 - fixed], options)?;
            Ok::<_, CoverError>((value, along.located()))
        });
        let mut curves = Self {
            plane,
            periods,
            options: *options,
            starts: VecDeque::new(),
            undecided: Vec::new(),
            known: Vec::new(),
        };
        for ((fixed, _), found) in scanned.into_iter().zip(found) {
            let (value, found) = found?;
            let with_value = |parameter: f64| {
                if fixed == 0 {
                    [value, parameter]
                } else {
                    [parameter, value]
                }
            };
            for located in &found.located {
                let place = (fixed, with_value(located.parameter().midpoint()));
                curves.starts.extend(curves.start(located, place));
            }
            for (kind, [t_1, middle, parameter]) in found.undecided {
                if kind == BifurcationKind::NodeFocus {
                    continue;
                }
                let line = Interval::point(value);
                let [x, y] = if fixed == 0 {
                    [line, parameter]
                } else {
                    [parameter, line]
                };
                curves.undecided.push((kind, [t_1, middle, x, y]));
            }
        }
        Ok(curves)
    }

    /// The boxes in (T_1, psi, x, y) on the lines in which there may be bifurcations.
    pub fn undecided(&self) -> &[(BifurcationKind, IntervalBox<f64, 4>)] {
        &self.undecided
    }

    /// The point of a curve that a bifurcation is.
    fn start(&self, located: &LocatedBifurcation, (fixed, parameters): (usize, [f64; 2])) -> Option<Start> {
        let [t_1, middle, _] = located.cell(self.periods).map(|side| side.midpoint());
        let ranges = self.plane.ranges();
        let mut point = vec![t_1, middle];
        point.extend((0..2).map(|i| place_of(&ranges[i], parameters[i])));
        let condition = match located {
            LocatedBifurcation::Condition(condition, _) if condition.kind() == BifurcationKind::NodeFocus => {
                return None;
            }
            LocatedBifurcation::Condition(condition, _) => CurveCondition::Bifurcation(*condition),
            LocatedBifurcation::Touch(condition, root) => {
                point.push(root.enclosure[3].to_f64());
                CurveCondition::Bifurcation(*condition)
            }
            LocatedBifurcation::Crossing(_) if self.plane.is_symmetric() => CurveCondition::SymmetryBreaking,
            LocatedBifurcation::Turn(_) if self.plane.is_symmetric() => CurveCondition::SymmetricFold,
            LocatedBifurcation::Crossing(_) | LocatedBifurcation::Turn(_) => {
                CurveCondition::Bifurcation(BifurcationCondition::MultiplierOne)
            }
        };
        Some(Start {
            condition,
            fixed: PLACES.start + fixed,
            point,
        })
    }

    /// Returns true if a start lies on a curve that was followed.
    fn is_known(&self, start: &Start) -> bool {
        let curve = self.system(&start.condition);
        let mut own = self.known.iter().filter(|(known, _)| *known == start.condition);
        own.any(|(_, branch)| branch.holds(&curve, &start.point, ROOM))
    }

    /// Follows the curve through a start; `None` where no curve is found there.
    fn follow(&self, start: &Start) -> Option<Branch<CurveFunctions>> {
        let curve = self.system(&start.condition);
        let at = &start.point;
        // on a side of the rectangle, exactly on it
        let side = PLACES.into_iter().find(|i| at[*i] < ROOM || at[*i] > 1.0 - ROOM);
        let (mut point, moved) = match side {
            Some(i) => curve.solved_at(at, i, at[i].round())?,
            None => {
                let tangent = curve.first_tangent(at)?;
                curve.corrected(at, &tangent, dot(at, &tangent))?
            }
        };
        point[PLACES]
            .iter_mut()
            .for_each(|place| *place = place.clamp(0.0, 1.0));
        (moved < NEAR).then(|| Branch::through(&curve, point))?
    }

    fn system(&self, condition: &CurveCondition) -> CurveSystem<'_, P> {
        CurveSystem {
            plane: &self.plane,
            periods: self.periods,
            conditions: vec![condition.clone()],
            options: self.options,
        }
    }
}

impl<P: ParameterPlane> Iterator for OneOneCurves<P> {
    /// The points of a curve in order along it; of one that could not be followed, the bifurcation on the line, `Lost`.
    type Item = Vec<CurvePoint>;

    fn next(&mut self) -> Option<Vec<CurvePoint>> {
        loop {
            let start = self.starts.pop_front()?;
            if self.is_known(&start) {
                continue;
            }
            let curve = self.system(&start.condition);
            let lost = || lost(&curve, &start.point, start.fixed);
            let Some(branch) = self.follow(&start) else {
                return Some(lost());
            };
            let points = points(&curve, &branch);
            let points = if points.is_empty() { lost() } else { points };
            self.known.push((start.condition, branch));
            return Some(points);
        }
    }
}
