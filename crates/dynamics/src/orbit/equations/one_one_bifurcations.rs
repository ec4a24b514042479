//! The equations of the bifurcations of 1-1 motions, as systems to be isolated.

use crate::model::{MotionError, Side};
use crate::orbit::equations::conditions::BifurcationCondition;
use crate::orbit::equations::duals::{Linearised, by_duals, unknown};
use crate::orbit::equations::one_one::{OneOneEquations, SharedTerms};
use crate::orbit::equations::square_system::{Decision, SquareSystem, not_excluded};
use crate::orbit::equations::touch::FlightFromImpact;
use crate::orbit::family::Family;
use crate::orbit::interval_box::IntervalBox;
use num_dual::DualNum;
use num_traits::Zero;
use numbers::{Analytic, Endpoint, Field, Interval};

/// h_1, h_2 and the equations of a condition, in (T_1, psi, parameter) or, for a touch, (T_1, psi, parameter, time
/// from the impact at the wall that is touched).
pub struct ConditionedOneOne<'a, F> {
    /// The motions.
    pub family: &'a F,
    /// The forcing periods they take.
    pub periods: u32,
    /// What holds at the bifurcation.
    pub condition: BifurcationCondition,
    /// Boxes of (T_1, psi, parameter) in which nothing is looked for: around events that solve the equations doubly.
    pub apart: Vec<IntervalBox<f64, 3>>,
}

/// Where the branch of symmetric motions, T_1 = T_2 = n, has a multiplier of 1, in (psi, parameter).
///
/// There one of h_1, h_2 vanishes on the whole line T_1 = n, so that their sum is the other; and the determinant of
/// their derivatives by (T_1, psi) is 0 where a second branch crosses, or where this one turns.
pub struct SymmetricOneOne<'a, F> {
    /// The motions.
    pub family: &'a F,
    /// The forcing periods they take.
    pub periods: u32,
}

/// Where the trace of half the motion is 0 on the branch of weightless symmetric motions, in (psi, parameter).
///
/// There DP is the square of one flight and a mirror, and Tr(DP) + 2 r² the square of (1 + r) f(t_k) T_1 / w - 2 r v / w:
/// it touches 0 and does not cross it, so that nothing happens; nor does Tr(DP) come down to -(1 + r^4).
pub struct HalvedOneOne<'a, F> {
    /// The motions.
    pub family: &'a F,
    /// The forcing periods they take.
    pub periods: u32,
}

/// What is 0 where a condition holds: one value, and 0 beside it, or both values of a touch, a time `from_impact` from the
/// impact at the wall that is touched.
pub(crate) fn condition_excess<T: Analytic>(
    condition: BifurcationCondition,
    balance: &OneOneEquations<T>,
    at: &SharedTerms<T>,
    from_impact: &T,
) -> [T; 2] {
    match condition {
        BifurcationCondition::ZeroVelocity(impact) => {
            let [v, w] = balance.scaled_velocities_at(at);
            [if impact == 0 { v } else { w }, T::zero()]
        }
        BifurcationCondition::Touch(flight, wall) => {
            FlightFromImpact::new(balance, (flight, wall), at).touch_excess(from_impact)
        }
        condition => {
            let level = condition.trace(&balance.loss_factor()).unwrap_or_else(T::zero);
            [balance.trace_above_at(&level, at), T::zero()]
        }
    }
}

impl<F: Family> ConditionedOneOne<'_, F> {
    /// The left sides, over any number: in `D` = 4 unknowns for a touch, 3 for the other conditions.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn equations<T: Analytic, const D: usize>(&self, at: &[T; D]) -> Result<[T; D], MotionError> {
        let [t_1, middle, parameter] = [&at[0], &at[1], &at[2]];
        let balance = OneOneEquations::new(&self.family.motion_at(parameter)?, self.periods);
        let shared = balance.parts(t_1, middle);
        let [first, second] = balance.residual_at(&shared);
        let [excess, velocity] = condition_excess(self.condition, &balance, &shared, &at[D - 1]);
        let mut values = [first, second, excess, velocity].into_iter();
        Ok(std::array::from_fn(|_| values.next().unwrap_or_else(T::zero)))
    }
}

impl<F: Family, E: Endpoint, const D: usize> SquareSystem<E, D> for ConditionedOneOne<'_, F>
where
    Interval<E>: DualNum,
{
    fn linearised(&self, cell: &IntervalBox<E, D>) -> Linearised<Interval<E>, D> {
        by_duals(|at| self.equations(at).ok(), cell).unwrap_or_else(unknown)
    }

    fn values(&self, cell: &IntervalBox<E, D>) -> IntervalBox<E, D> {
        self.equations(cell).unwrap_or_else(|_| unknown().0)
    }

    fn is_wanted(&self, cell: &IntervalBox<E, D>) -> bool {
        self.wanted(cell).is_ok()
    }

    /// Evaluates the cheapest values first; all share the sines of the box.
    fn examined(&self, cell: &IntervalBox<E, D>) -> Result<[IntervalBox<E, D>; D], Decision> {
        if let Some((balance, at)) = self.wanted(cell)? {
            not_excluded(&balance.residual_at(&at))?;
            let excess = condition_excess(self.condition, &balance, &at, &cell[D - 1]);
            let excluding = excess.iter().position(|value| !value.contains_zero());
            excluding.map_or(Ok(()), |equation| Err(Decision::Excluded(2 + equation)))?;
        }
        Ok(SquareSystem::<E, D>::linearised(self, cell).1)
    }
}

/// The equations of the motions in a box, and what their values share.
type Shared<E> = (OneOneEquations<Interval<E>>, SharedTerms<Interval<E>>);

impl<F: Family> ConditionedOneOne<'_, F> {
    /// The equations over a box in which something may be looked for; `None` where the parameter leaves its range.
    fn wanted<E: Endpoint, const D: usize>(&self, cell: &IntervalBox<E, D>) -> Result<Option<Shared<E>>, Decision> {
        let rounded = |side: &Interval<E>| Interval::new(side.low().to_f64(), side.high().to_f64());
        let apart = |other: &IntervalBox<f64, 3>| {
            let mut sides = cell.iter().zip(other);
            sides.all(|(side, other)| rounded(side).is_subset(other))
        };
        if self.apart.iter().any(apart) {
            return Err(Decision::Unwanted);
        }
        let Ok(motion) = self.family.motion_at(&cell[2]) else {
            return Ok(None);
        };
        let balance = OneOneEquations::new(&motion, self.periods);
        let at = balance.parts(&cell[0], &cell[1]);
        let is_wanted = balance.may_fly(&cell[0], &balance.scaled_velocities_at(&at))
            && match self.condition {
                BifurcationCondition::Touch(flight, wall) => {
                    may_touch(&balance, (flight, wall), &at, [&cell[0], &cell[D - 1]])
                }
                _ => true,
            };
        if is_wanted {
            Ok(Some((balance, at)))
        } else {
            Err(Decision::Unwanted)
        }
    }
}

/// Returns true unless it is certain that a flight does not touch a wall that it starts or ends at: the time must lie within
/// the flight, and f + g must change sign between the impact and the touch.
fn may_touch<E: Endpoint>(
    balance: &OneOneEquations<Interval<E>>,
    (flight, wall): (usize, Side),
    at: &SharedTerms<Interval<E>>,
    [t_1, from_impact]: [&Interval<E>; 2],
) -> bool {
    let lasts = if flight == 0 {
        t_1.clone()
    } else {
        balance.total() - t_1.clone()
    };
    if (lasts - from_impact.clone()).is_negative() || from_impact.is_negative() {
        return false;
    }
    let seen = FlightFromImpact::new(balance, (flight, wall), at);
    let until = Interval::zero().hull(from_impact);
    seen.acceleration(&until).contains_zero()
}

impl<F: Family> SymmetricOneOne<'_, F> {
    fn equations<T: Analytic>(&self, [middle, parameter]: &[T; 2]) -> Result<[T; 2], MotionError> {
        let balance = OneOneEquations::new(&self.family.motion_at(parameter)?, self.periods);
        let t_1 = T::from_integer(i64::from(self.periods));
        let ([first, second], [[a, b], [c, d]]) = balance.linearised(&t_1, middle);
        Ok([first + second, a * d - b * c])
    }

    /// Whether the branch of symmetric motions itself turns here, rather than a second one crossing it.
    pub fn may_turn(&self, [middle, parameter]: &IntervalBox<f64, 2>) -> bool {
        let Ok(motion) = self.family.motion_at(parameter) else {
            return true;
        };
        let t_1 = Interval::from_integer(i64::from(self.periods));
        let (_, [[_, first], [_, second]]) = OneOneEquations::new(&motion, self.periods).linearised(&t_1, middle);
        (first + second).contains_zero()
    }
}

impl<F: Family, E: Endpoint> SquareSystem<E, 2> for SymmetricOneOne<'_, F>
where
    Interval<E>: DualNum,
{
    fn linearised(&self, cell: &IntervalBox<E, 2>) -> Linearised<Interval<E>, 2> {
        by_duals(|at| self.equations(at).ok(), cell).unwrap_or_else(unknown)
    }

    fn is_wanted(&self, [middle, parameter]: &IntervalBox<E, 2>) -> bool {
        let t_1 = Interval::from_integer(i64::from(self.periods));
        self.family.motion_at(parameter).map_or(true, |motion| {
            let balance = OneOneEquations::new(&motion, self.periods);
            balance.may_fly(&t_1, &balance.scaled_velocities(&t_1, middle))
        })
    }
}

impl<F: Family> HalvedOneOne<'_, F> {
    fn equations<T: Analytic>(&self, [middle, parameter]: &[T; 2]) -> Result<[T; 2], MotionError> {
        let balance = OneOneEquations::new(&self.family.motion_at(parameter)?, self.periods);
        let t_1 = T::from_integer(i64::from(self.periods));
        let [first, second] = balance.residual(&t_1, middle);
        let [v, _] = balance.velocities(&t_1, middle);
        let [start, _] = balance.phases(&t_1, middle);
        let r = balance.restitution(Side::Bottom);
        let half = (T::one() + r.clone()) * start.sincos().1 * t_1 - T::from_integer(2) * r * v;
        Ok([first + second, half])
    }
}

impl<F: Family, E: Endpoint> SquareSystem<E, 2> for HalvedOneOne<'_, F>
where
    Interval<E>: DualNum,
{
    fn linearised(&self, cell: &IntervalBox<E, 2>) -> Linearised<Interval<E>, 2> {
        by_duals(|at| self.equations(at).ok(), cell).unwrap_or_else(unknown)
    }
}
