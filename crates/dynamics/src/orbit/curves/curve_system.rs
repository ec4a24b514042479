//! The equations of curves of bifurcations and of the special points on them, in both parameters.

use crate::model::{Motion, Side};
use crate::orbit::continuation::branch::{BranchEnd, BranchPoint, Continued};
use crate::orbit::continuation::curve::{CurveEquations, dot};
use crate::orbit::continuation::extended_system::parameter_at;
use crate::orbit::continuation::test_functions::{TestFunctions, WALLS, crossings};
use crate::orbit::curves::coefficient::{breaking_coefficient, doubling_coefficient};
use crate::orbit::equations::conditions::{BifurcationCondition, BifurcationKind};
use crate::orbit::equations::duals::{Linearised, by_duals, rows_by_duals, unknown};
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::equations::one_one_bifurcations::condition_excess;
use crate::orbit::equations::square_system::SquareSystem;
use crate::orbit::equations::touch::{FlightFromImpact, time_from_impact};
use crate::orbit::equations::words::WordEquations;
use crate::orbit::family::ParameterPlane;
use crate::orbit::interval_box::IntervalBox;
use crate::orbit::options::OrbitOptions;
use crate::orbit::solve::krawczyk::{ProvedRoot, prove};
use crate::orbit::solve::newton::{Ending, newton_by_duals};
use crate::orbit::word::Word;
use num_dual::DualNum;
use numbers::{Analytic, Dual, Interval};
use std::f64::consts::TAU;
use std::ops::Range;

/// T_1, psi, the places of both parameters in their ranges, and of each touch, at most two, the time from
/// the impact at the wall that it touches.
pub(crate) const UNKNOWNS: usize = 6;

/// Where the parameters stand, and the first time of a touch.
pub(crate) const PLACES: Range<usize> = 2..4;
pub(crate) const TOUCH: usize = 4;

/// How Newton's method ends: from a good guess it takes four steps.
const ENDING: Ending = Ending {
    most_steps: 20,
    last_step: 1e-11,
    growth: 4.0,
    rounding: 0.0,
};

/// The widest box tried for a proof, and how often a tenth of it.
const WIDEST: f64 = 1e-4;
const TENTHS: i32 = 8;

/// What holds on a curve, or at a point of it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum CurveCondition {
    /// A bifurcation.
    Bifurcation(BifurcationCondition),
    /// A branch of other motions crosses that of motions with T_1 = T_2, where each is its own mirror image.
    SymmetryBreaking,
    /// The branch of motions with T_1 = T_2 turns, where each is its own mirror image.
    SymmetricFold,
    /// A fold of the curve of folds over the plane: the kernel of the equations in (T_1, psi) is along the curve. Of the
    /// equations the sum with these weights is taken.
    Cusp([f64; 2]),
    /// The cubic coefficient of a period doubling is 0, by these kernels.
    DegenerateFlip([usize; 2]),
    /// The cubic coefficient of a symmetry breaking is 0; this equation vanishes on the symmetric motions.
    DegeneratePitchfork(usize),
    /// f + g is 0 at this impact.
    Push(usize),
    /// f + g is 0 at the first touch.
    TouchPush,
    /// A parameter is at this place.
    Place(usize, f64),
    /// The point lies in the plane across this normal, at this offset.
    Across(Vec<f64>, f64),
}

impl CurveCondition {
    /// What happens on a curve of it.
    pub fn kind(&self) -> BifurcationKind {
        match self {
            Self::Bifurcation(condition) => condition.kind(),
            Self::SymmetryBreaking | Self::DegeneratePitchfork(_) => BifurcationKind::SymmetryBreaking,
            Self::Cusp(_) | Self::SymmetricFold => BifurcationKind::Fold,
            Self::DegenerateFlip(_) => BifurcationKind::PeriodDoubling,
            Self::Push(_) | Self::TouchPush | Self::Place(..) | Self::Across(..) => BifurcationKind::Grazing,
        }
    }

    pub fn is_touch(&self) -> bool {
        matches!(self, Self::Bifurcation(BifurcationCondition::Touch(..)))
    }
}

/// 1-1 motions of a plane of parameters on which conditions hold: one makes a curve, two make points.
#[derive(Clone, Debug)]
pub(crate) struct CurveSystem<'a, P> {
    pub plane: &'a P,
    pub periods: u32,
    /// What holds on the curve comes first.
    pub conditions: Vec<CurveCondition>,
    pub options: OrbitOptions,
}

impl<P: ParameterPlane> CurveSystem<'_, P> {
    /// The same with one condition more.
    pub fn with(&self, condition: CurveCondition) -> Self {
        let mut conditions = self.conditions.clone();
        conditions.push(condition);
        Self { conditions, ..*self }
    }

    /// What holds on the curve.
    pub fn own(&self) -> &CurveCondition {
        &self.conditions[0]
    }

    /// How many unknowns there are.
    pub fn unknowns(&self) -> usize {
        TOUCH + self.conditions.iter().filter(|condition| condition.is_touch()).count()
    }

    /// Whether the curve is one of motions with T_1 = T_2.
    fn is_symmetric(&self) -> bool {
        matches!(
            self.own(),
            CurveCondition::SymmetryBreaking | CurveCondition::SymmetricFold
        )
    }

    /// Whether there is no such motion at a node: it lies behind the end of the curve.
    pub fn is_beyond(&self, node: &BranchPoint<CurveFunctions>) -> bool {
        self.ends(node) == Some(BranchEnd::Slow)
    }

    /// The motion at places of both parameters.
    pub fn motion<T: Analytic>(&self, places: &[T]) -> Option<Motion<T>> {
        let [x, y] = self.plane.ranges();
        let (x, y) = (parameter_at(&x, &places[0]), parameter_at(&y, &places[1]));
        self.plane.motion_at([&x, &y]).ok()
    }

    /// The left sides. `None` where the parameters can have no such values.
    fn equations<T: Analytic + DualNum>(&self, at: &[T]) -> Option<Vec<T>> {
        let motion = self.motion(&at[PLACES])?;
        let balance = OneOneEquations::new(&motion, self.periods);
        let (t_1, middle) = (&at[0], &at[1]);
        let shared = balance.parts(t_1, middle);
        let [first, second] = balance.residual_at(&shared);
        let mut values = if self.is_symmetric() {
            // one of the two vanishes on the whole line
            vec![first + second, t_1.clone() - T::from_integer(i64::from(self.periods))]
        } else {
            vec![first, second]
        };
        let mut after = at[TOUCH..].iter();
        for condition in &self.conditions {
            match condition {
                CurveCondition::Bifurcation(condition @ BifurcationCondition::Touch(..)) => {
                    values.extend(condition_excess(*condition, &balance, &shared, after.next()?));
                }
                CurveCondition::Bifurcation(condition) => {
                    let [excess, _] = condition_excess(*condition, &balance, &shared, t_1);
                    values.push(excess);
                }
                CurveCondition::SymmetryBreaking => {
                    let [[a, b], [c, d]] = balance.slopes_at(&shared);
                    values.push(a * d - b * c);
                }
                CurveCondition::SymmetricFold => {
                    let [[_, first], [_, second]] = balance.slopes_at(&shared);
                    values.push(first + second);
                }
                CurveCondition::Cusp(weights) => values.push(self.cusp(&motion, [t_1, middle], *weights)?),
                CurveCondition::DegenerateFlip(kernels) => {
                    values.push(doubling_coefficient(&motion, self.periods, [t_1, middle], *kernels)?);
                }
                CurveCondition::DegeneratePitchfork(odd) => {
                    values.push(breaking_coefficient(&motion, self.periods, [t_1, middle], *odd)?);
                }
                CurveCondition::Push(impact) => {
                    let phase = &balance.phases(t_1, middle)[*impact];
                    values.push(phase.sincos().1 + motion.g().clone());
                }
                CurveCondition::TouchPush => {
                    let seen = FlightFromImpact::new(&balance, self.touch()?, &shared);
                    values.push(seen.acceleration(&at[TOUCH]));
                }
                CurveCondition::Place(coordinate, place) => {
                    values.push(at[*coordinate].clone() - <T as Analytic>::from_f64(*place));
                }
                CurveCondition::Across(normal, offset) => {
                    let terms = normal.iter().zip(at);
                    values.push(terms.fold(<T as Analytic>::from_f64(-offset), |sum, (part, side)| {
                        sum + <T as Analytic>::from_f64(*part) * side.clone()
                    }));
                }
            }
        }
        Some(values)
    }

    /// The flight and the wall of the touch that holds on the curve.
    pub fn touch(&self) -> Option<(usize, Side)> {
        match self.own() {
            CurveCondition::Bifurcation(BifurcationCondition::Touch(flight, wall)) => Some((*flight, *wall)),
            _ => None,
        }
    }

    /// The derivative of the curve's condition along the kernel of the sum of the equations with these weights.
    fn cusp<T: Analytic + DualNum>(&self, motion: &Motion<T>, [t_1, middle]: [&T; 2], weights: [f64; 2]) -> Option<T> {
        let CurveCondition::Bifurcation(condition) = self.own() else {
            return None;
        };
        let slopes = OneOneEquations::new(motion, self.periods).linearised(t_1, middle).1;
        let [by_t, by_psi] = std::array::from_fn(|column| {
            let parts = slopes.iter().zip(weights);
            parts.fold(T::zero(), |sum, (row, weight)| {
                sum + <T as Analytic>::from_f64(weight) * row[column].clone()
            })
        });
        let lifted = motion.convert(|value| Dual::from_re(value.clone())).ok()?;
        let balance = OneOneEquations::new(&lifted, self.periods);
        let along = [Dual::new(t_1.clone(), -by_psi), Dual::new(middle.clone(), by_t)];
        let [excess, _] = condition_excess(*condition, &balance, &balance.parts(&along[0], &along[1]), &along[0]);
        Some(excess.eps)
    }

    /// As many equations for every number of conditions, so that the proofs are compiled once: unknowns that there are not
    /// are 0.
    fn padded<T: Analytic + DualNum>(&self, at: &[T; UNKNOWNS]) -> Option<[T; UNKNOWNS]> {
        let mut values = self.equations(&at[..self.unknowns()])?;
        values.extend(at[values.len()..].iter().cloned());
        values.try_into().ok()
    }

    /// The value of the last condition, in f64.
    pub fn excess(&self, point: &[f64]) -> Option<f64> {
        self.equations(point)?.pop()
    }

    /// The solution that Newton's method leads to from a guess.
    pub fn solved(&self, guess: &[f64]) -> Option<Vec<f64>> {
        let guess = std::array::from_fn(|i| guess.get(i).copied().unwrap_or(0.0));
        let point = newton_by_duals(guess, &ENDING, |at| self.padded(at))?;
        Some(point[..self.unknowns()].to_vec())
    }

    /// The proof that there is one solution about a point, where there are as many equations as unknowns.
    pub fn proved(&self, point: &[f64]) -> Option<ProvedRoot<f64, UNKNOWNS>> {
        let point = std::array::from_fn(|i| point.get(i).copied().unwrap_or(0.0));
        (0..TENTHS).find_map(|tenths| prove(self, &point, &[WIDEST * 0.1_f64.powi(tenths); UNKNOWNS]))
    }
}

impl<P: ParameterPlane> SquareSystem<f64, UNKNOWNS> for CurveSystem<'_, P> {
    fn linearised(&self, cell: &IntervalBox<f64, UNKNOWNS>) -> Linearised<Interval<f64>, UNKNOWNS> {
        by_duals(|at| self.padded(at), cell).unwrap_or_else(unknown)
    }

    fn values(&self, cell: &IntervalBox<f64, UNKNOWNS>) -> IntervalBox<f64, UNKNOWNS> {
        self.padded(cell).unwrap_or_else(|| unknown().0)
    }
}

impl<P: ParameterPlane> CurveEquations for CurveSystem<'_, P> {
    fn linearised(&self, point: &[f64]) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
        rows_by_duals(|at| self.equations(at), point)
    }

    fn values(&self, cell: &[Interval<f64>]) -> Option<Vec<Interval<f64>>> {
        self.equations(cell)
    }

    fn slopes(&self, cell: &[Interval<f64>]) -> Option<Vec<Vec<Interval<f64>>>> {
        Some(rows_by_duals(|at| self.equations(at), cell)?.1)
    }
}

/// What is looked at along a curve.
#[derive(Clone, Debug)]
pub(crate) struct CurveFunctions {
    /// Those of the motion, without the touch that holds on the curve.
    pub motion: TestFunctions,
    /// The time of the touch from the impact at its wall, and how long the rest of the flight lasts.
    pub around_touch: Option<[f64; 2]>,
}

impl<P: ParameterPlane> Continued for CurveSystem<'_, P> {
    type Functions = CurveFunctions;

    fn options(&self) -> &OrbitOptions {
        &self.options
    }

    fn places(&self) -> Range<usize> {
        PLACES
    }

    fn functions(&self, point: &[f64]) -> Option<CurveFunctions> {
        let motion = self.motion(&point[PLACES])?;
        let balance = OneOneEquations::new(&motion, self.periods);
        let phases = balance.phases(&point[0], &point[1]);
        let system = WordEquations {
            motion,
            word: Word::pair(),
            periods: self.periods,
        };
        let mut motion = TestFunctions::new(&system, &phases);
        let mut around_touch = None;
        match self.own() {
            CurveCondition::Bifurcation(BifurcationCondition::Touch(flight, wall)) => {
                let (from_impact, time) = (point[TOUCH], motion.times[*flight]);
                let after = time_from_impact((*flight, *wall), from_impact, time);
                forget(&mut motion, *flight, *wall, |turn| (turn - after).abs() < OWN_TOUCH);
                around_touch = Some([from_impact, time - from_impact]);
            }
            CurveCondition::Bifurcation(BifurcationCondition::ZeroVelocity(impact)) => {
                let (wall, before) = (WALLS[*impact], 1 - *impact);
                let end = motion.times[before];
                forget(&mut motion, *impact, wall, |turn| turn < OWN_TOUCH);
                forget(&mut motion, before, wall, |turn| turn > end - OWN_TOUCH);
            }
            _ => {}
        }
        Some(CurveFunctions { motion, around_touch })
    }

    fn ends(&self, node: &BranchPoint<CurveFunctions>) -> Option<BranchEnd> {
        let CurveFunctions {
            motion, around_touch, ..
        } = &node.functions;
        let mut speeds = motion.speeds.iter().enumerate();
        // of the impact of velocity 0 the sign is rounding, and of the other one where without gravity it has velocity 0 too
        let slow = matches!(
            self.own(),
            CurveCondition::Bifurcation(BifurcationCondition::ZeroVelocity(_))
        );
        let own = |impact| *self.own() == CurveCondition::Bifurcation(BifurcationCondition::ZeroVelocity(impact));
        let moves = speeds.all(|(impact, speed)| *speed > if slow { -STILL } else { 0.0 } || own(impact));
        let mut times = motion.times.iter().chain(around_touch.iter().flatten());
        (!moves || times.any(|time| *time <= 0.0)).then_some(BranchEnd::Slow)
    }

    fn images(&self, point: &[f64], near: &[f64]) -> Vec<Vec<f64>> {
        let mut image = point.to_vec();
        image[1] -= TAU * ((point[1] - near[1]) / TAU).round();
        vec![image]
    }
}

/// A turning point this near, in time and distance, is the touch or the impact of the curve itself.
const OWN_TOUCH: f64 = 1e-6;

/// Velocities below this are 0 up to rounding.
pub(crate) const STILL: f64 = 1e-12;

/// Leaves out what is a grazing of the curve itself: turns of a flight at a wall, at times that `is_own` tells.
fn forget(motion: &mut TestFunctions, flight: usize, wall: Side, is_own: impl Fn(f64) -> bool) {
    let index = usize::from(wall == Side::Top);
    let turns = &mut motion.turns[flight];
    turns.retain(|turn| !(is_own(turn.after) && turn.distances[index].abs() < OWN_TOUCH));
    motion.crossings[flight] = crossings(turns);
}

/// The plane across a direction through a point.
pub(crate) fn across(point: &[f64], normal: &[f64]) -> CurveCondition {
    CurveCondition::Across(normal.to_vec(), dot(point, normal))
}
