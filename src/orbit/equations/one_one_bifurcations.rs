//! The equations of the bifurcations of 1-1 motions, as systems to be isolated.

use crate::model::{MotionError, Side};
use crate::number::{Analytic, Dual, Endpoint, Field, Interval};
use crate::orbit::equations::conditions::{Condition, Touch};
use crate::orbit::equations::duals::by_duals;
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::equations::square_system::SquareSystem;
use crate::orbit::family::Family;
use crate::orbit::interval_box::IntervalBox;
use crate::orbit::solve::one_one::may_fly;
use num_dual::DualNum;

/// h_1, h_2 and a condition, in (T_1, psi, parameter).
pub struct Conditioned<'a, F> {
    /// The motions.
    pub family: &'a F,
    /// n
    pub periods: u32,
    /// What holds at the event.
    pub condition: Condition,
    /// Boxes in which nothing is looked for: around events that solve the equations doubly.
    pub apart: Vec<IntervalBox<f64, 3>>,
}

/// h_1, h_2 and a contact of velocity 0 within a flight, in (T_1, psi, parameter, time into the flight).
pub struct Touching<'a, F> {
    /// The motions.
    pub family: &'a F,
    /// n
    pub periods: u32,
    /// Which flight and wall.
    pub touch: Touch,
}

/// Where the branch of symmetric motions, T_1 = T_2 = n, has a multiplier of 1, in (psi, parameter).
///
/// There one of h_1, h_2 vanishes on the whole line T_1 = n, so that their sum is the other; and the determinant of
/// their derivatives by (T_1, psi) is 0 where a second branch crosses, or where this one turns.
pub struct Symmetric<'a, F> {
    /// The motions.
    pub family: &'a F,
    /// n
    pub periods: u32,
}

/// Where the trace of half the motion is 0 on the branch of weightless symmetric motions, in (psi, parameter).
///
/// There DP is the square of one flight and a mirror, and Tr(DP) + 2 r² the square of (1 + r) f(t_k) T_1 / w - 2 r v / w:
/// it touches 0 and does not cross it, so that nothing happens; nor does Tr(DP) come down to -(1 + r^4).
pub struct Halved<'a, F> {
    /// The motions.
    pub family: &'a F,
    /// n
    pub periods: u32,
}

/// What a parameter out of range gives: nothing is known.
fn unknown<E: Endpoint, const D: usize>() -> (IntervalBox<E, D>, [IntervalBox<E, D>; D]) {
    let whole = || std::array::from_fn(|_| Interval::whole());
    (whole(), std::array::from_fn(|_| whole()))
}

/// Equations in `D` unknowns of which the third, or the second of two, is the parameter.
fn linearised<E: Endpoint, const D: usize>(
    equations: impl Fn(&[Dual<Interval<E>>; D]) -> Result<[Dual<Interval<E>>; D], MotionError>,
    cell: &IntervalBox<E, D>,
) -> (IntervalBox<E, D>, [IntervalBox<E, D>; D])
where
    Interval<E>: DualNum,
{
    let whole = || Dual::new(Interval::whole(), Interval::whole());
    by_duals(
        |at| equations(at).unwrap_or_else(|_| std::array::from_fn(|_| whole())),
        cell,
    )
}

impl<F: Family> Conditioned<'_, F> {
    /// The left sides, over any number.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn equations<T: Analytic>(&self, [t_1, middle, parameter]: &[T; 3]) -> Result<[T; 3], MotionError> {
        let balance = OneOneEquations::new(&self.family.motion_at(parameter)?, self.periods);
        let [first, second] = balance.residual(t_1, middle);
        Ok([first, second, self.condition.excess(&balance, t_1, middle)])
    }
}

impl<F: Family, E: Endpoint> SquareSystem<E, 3> for Conditioned<'_, F>
where
    Interval<E>: DualNum,
{
    fn linearised(&self, cell: &IntervalBox<E, 3>) -> (IntervalBox<E, 3>, [IntervalBox<E, 3>; 3]) {
        linearised(|at| self.equations(at), cell)
    }

    fn values(&self, cell: &IntervalBox<E, 3>) -> IntervalBox<E, 3> {
        self.equations(cell).unwrap_or_else(|_| unknown().0)
    }

    fn is_wanted(&self, cell: &IntervalBox<E, 3>) -> bool {
        let rounded = cell
            .each_ref()
            .map(|side| Interval::new(side.low().to_f64(), side.high().to_f64()));
        let apart = |other: &IntervalBox<f64, 3>| rounded.iter().zip(other).all(|(side, other)| side.is_subset(other));
        let [t_1, middle, parameter] = cell;
        !self.apart.iter().any(apart) && may_move(self.family, self.periods, t_1, middle, parameter)
    }
}

impl<F: Family> Touching<'_, F> {
    fn equations<T: Analytic>(&self, [t_1, middle, parameter, after]: &[T; 4]) -> Result<[T; 4], MotionError> {
        let balance = OneOneEquations::new(&self.family.motion_at(parameter)?, self.periods);
        let [first, second] = balance.residual(t_1, middle);
        let [distance, velocity] = self.touch.excess(&balance, t_1, middle, after);
        Ok([first, second, distance, velocity])
    }
}

impl<F: Family, E: Endpoint> SquareSystem<E, 4> for Touching<'_, F>
where
    Interval<E>: DualNum,
{
    fn linearised(&self, cell: &IntervalBox<E, 4>) -> (IntervalBox<E, 4>, [IntervalBox<E, 4>; 4]) {
        linearised(|at| self.equations(at), cell)
    }

    fn values(&self, cell: &IntervalBox<E, 4>) -> IntervalBox<E, 4> {
        self.equations(cell).unwrap_or_else(|_| unknown().0)
    }

    fn is_wanted(&self, [t_1, middle, parameter, after]: &IntervalBox<E, 4>) -> bool {
        let Ok(motion) = self.family.motion_at(parameter) else {
            return true;
        };
        let balance = OneOneEquations::new(&motion, self.periods);
        may_move(self.family, self.periods, t_1, middle, parameter) && self.touch.may_be(&balance, t_1, middle, after)
    }
}

impl<F: Family> Symmetric<'_, F> {
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

impl<F: Family, E: Endpoint> SquareSystem<E, 2> for Symmetric<'_, F>
where
    Interval<E>: DualNum,
{
    fn linearised(&self, cell: &IntervalBox<E, 2>) -> (IntervalBox<E, 2>, [IntervalBox<E, 2>; 2]) {
        linearised(|at| self.equations(at), cell)
    }

    fn is_wanted(&self, [middle, parameter]: &IntervalBox<E, 2>) -> bool {
        let t_1 = Interval::from_integer(i64::from(self.periods));
        may_move(self.family, self.periods, &t_1, middle, parameter)
    }
}

impl<F: Family> Halved<'_, F> {
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

impl<F: Family, E: Endpoint> SquareSystem<E, 2> for Halved<'_, F>
where
    Interval<E>: DualNum,
{
    fn linearised(&self, cell: &IntervalBox<E, 2>) -> (IntervalBox<E, 2>, [IntervalBox<E, 2>; 2]) {
        linearised(|at| self.equations(at), cell)
    }
}

/// Whether v >= 0 >= w somewhere in the cell, with T_1 and T_2 not negative; so it may be where the parameter leaves its
/// range.
fn may_move<E: Endpoint>(
    family: &impl Family,
    periods: u32,
    t_1: &Interval<E>,
    middle: &Interval<E>,
    parameter: &Interval<E>,
) -> bool {
    family.motion_at(parameter).map_or(true, |motion| {
        let balance = OneOneEquations::new(&motion, periods);
        may_fly(&balance, t_1, &balance.scaled_velocities(t_1, middle))
    })
}
