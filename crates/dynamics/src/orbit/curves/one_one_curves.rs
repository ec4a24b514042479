//! All curves of bifurcations of 1-1 motions over two parameters that lines across their rectangle lead to.

use crate::orbit::bifurcation::one_one::LocatedBifurcation;
use crate::orbit::continuation::branch::Branch;
use crate::orbit::continuation::extended_system::place_of;
use crate::orbit::curves::curve_system::{CurveCondition, CurveFunctions, CurveSystem, PLACES};
use crate::orbit::curves::follow::{CurvePoint, lost, points};
use crate::orbit::curves::queue::{CurveQueue, PlaneCurves, Start, scanned_lines};
use crate::orbit::equations::conditions::{BifurcationCondition, BifurcationKind};
use crate::orbit::family::ParameterPlane;
use crate::orbit::interval_box::IntervalBox;
use crate::orbit::one_one_branches::OneOneBranches;
use crate::orbit::options::OrbitOptions;
use crate::orbit::parallel::each;
use crate::orbit::solve::cover::CoverError;
use numbers::{Analytic, Interval};

/// The curves of folds, period doublings, symmetry breakings and grazings of 1-1 motions that take so many periods, one
/// after the other, computed as they are asked for.
///
/// Along lines across the rectangle, its sides among them, every bifurcation is found and proved
/// ([`OneOneBranches`]); each is followed in both directions to where its curve ends, if it lies on no curve that is
/// known. Each point is proved by itself, and from each to the next it is proved that one curve leads there
/// (Krawczyk's test with the place along the step as a parameter). **Complete are the crossings with these lines**: a
/// closed curve between them is not seen.
pub struct OneOneCurves<P: ParameterPlane> {
    curves: PairCurves<P>,
    undecided: Vec<(BifurcationKind, IntervalBox<f64, 4>)>,
    queue: CurveQueue<PairCurves<P>>,
}

/// The equations of the curves of 1-1 motions.
struct PairCurves<P> {
    plane: P,
    periods: u32,
    options: OrbitOptions,
}

impl<P: ParameterPlane> OneOneCurves<P> {
    /// Looks for bifurcations along the sides and along `lines` - 1 lines between them, in both directions; at least 1.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn new(plane: P, periods: u32, lines: u32, options: &OrbitOptions) -> Result<Self, CoverError> {
        let scanned = scanned_lines(lines);
        let found = each(&scanned, |(fixed, index)| {
            let (line, value) = plane.line(*fixed, *index, lines);
            let along = OneOneBranches::new(line, periods, plane.ranges()[1 - fixed], options)?;
            Ok::<_, CoverError>((value, along.located()))
        });
        let mut curves = Self {
            curves: PairCurves {
                plane,
                periods,
                options: *options,
            },
            undecided: Vec::new(),
            queue: CurveQueue::new(),
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
                curves.queue.starts.extend(curves.curves.start(located, place));
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
}

impl<P: ParameterPlane> PairCurves<P> {
    /// The point of a curve that a bifurcation is.
    fn start(&self, located: &LocatedBifurcation, (fixed, parameters): (usize, [f64; 2])) -> Option<Start<Self>> {
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
            point,
            lost: PLACES.start + fixed,
        })
    }
}

impl<P: ParameterPlane> PlaneCurves for PairCurves<P> {
    type Condition = CurveCondition;
    type Functions = CurveFunctions;
    type Curve<'a>
        = CurveSystem<'a, P>
    where
        P: 'a;
    /// The coordinate that is fixed along the line.
    type Lost = usize;

    fn curve(&self, condition: &CurveCondition) -> CurveSystem<'_, P> {
        CurveSystem {
            plane: &self.plane,
            periods: self.periods,
            conditions: vec![condition.clone()],
            options: self.options,
        }
    }

    fn points(&self, condition: &CurveCondition, branch: &Branch<CurveFunctions>) -> Vec<CurvePoint> {
        points(&self.curve(condition), branch)
    }

    fn lost(&self, start: &Start<Self>) -> Vec<CurvePoint> {
        lost(&self.curve(&start.condition), &start.point, start.lost)
    }
}

impl<P: ParameterPlane> Iterator for OneOneCurves<P> {
    /// The points of a curve in order along it; of one that could not be followed, the bifurcation on the line, `Lost`.
    type Item = Vec<CurvePoint>;

    fn next(&mut self) -> Option<Vec<CurvePoint>> {
        self.queue.next(&self.curves)
    }
}
