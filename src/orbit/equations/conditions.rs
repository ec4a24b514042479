//! What happens to a 1-1 motion at special values of a parameter, as equations beside those of [`OneOneEquations`].

use crate::model::Side;
use crate::number::{Analytic, Endpoint, Interval};
use crate::orbit::equations::one_one::OneOneEquations;
use num_traits::Zero;
use std::fmt;

/// A bifurcation of codimension one, or a change of kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum BifurcationKind {
    /// A multiplier is -1: Tr(DP) = -(1 + Det(DP)).
    PeriodDoubling,
    /// A multiplier is 1, Tr(DP) = 1 + Det(DP), where the branch turns back in the parameter.
    Fold,
    /// A multiplier is 1 where a branch of symmetric motions (T_1 = T_2) crosses one of motions that are not.
    SymmetryBreaking,
    /// The multipliers meet on the real axis: Tr(DP) = 2 r_B r_T or -2 r_B r_T.
    NodeFocus,
    /// The motion touches a wall with velocity 0, at one of its impacts or within a flight.
    Grazing,
}

impl fmt::Display for BifurcationKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::PeriodDoubling => "period-doubling",
            Self::Fold => "fold",
            Self::SymmetryBreaking => "symmetry-breaking",
            Self::NodeFocus => "node-focus",
            Self::Grazing => "grazing",
        })
    }
}

/// A condition on (T_1, psi) of a 1-1 motion: one equation, explicit and without poles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// Tr(DP) = -(1 + Det(DP)).
    MultiplierMinusOne,
    /// Tr(DP) = 1 + Det(DP).
    MultiplierOne,
    /// Tr(DP) = 2 r_B r_T.
    DoublePositive,
    /// Tr(DP) = -2 r_B r_T.
    DoubleNegative,
    /// The impact at this wall has velocity 0.
    SlowImpact(Side),
}

impl Condition {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::MultiplierMinusOne,
        Self::MultiplierOne,
        Self::DoublePositive,
        Self::DoubleNegative,
        Self::SlowImpact(Side::Bottom),
        Self::SlowImpact(Side::Top),
    ];

    /// What the condition means. A multiplier of 1 is a fold but for the crossings of branches, told apart elsewhere.
    pub fn event(self) -> BifurcationKind {
        match self {
            Self::MultiplierMinusOne => BifurcationKind::PeriodDoubling,
            Self::MultiplierOne => BifurcationKind::Fold,
            Self::DoublePositive | Self::DoubleNegative => BifurcationKind::NodeFocus,
            Self::SlowImpact(_) => BifurcationKind::Grazing,
        }
    }

    /// 0 where the condition holds.
    pub fn excess<T: Analytic>(self, balance: &OneOneEquations<T>, t_1: &T, middle: &T) -> T {
        let sum = || T::one() + balance.determinant();
        let twice = || T::from_integer(2) * balance.loss_factor();
        let level = match self {
            Self::MultiplierMinusOne => -sum(),
            Self::MultiplierOne => sum(),
            Self::DoublePositive => twice(),
            Self::DoubleNegative => -twice(),
            Self::SlowImpact(side) => {
                let [v, w] = balance.scaled_velocities(t_1, middle);
                return if side == Side::Bottom { v } else { w };
            }
        };
        balance.trace_above(&level, t_1, middle)
    }
}

/// [the distance from a wall, the velocity], a time `after` into a flight, by (4) and (3); both 0 at a touch.
///
/// Of the flight: g and d, the walls [from, to be touched], the velocity just after the impact and its phase.
pub(crate) fn contact<T: Analytic>(
    [g, d]: [&T; 2],
    [from, wall]: [Side; 2],
    launch: T,
    phase: &T,
    after: &T,
) -> [T; 2] {
    let pi = T::pi();
    let (start_sin, start_cos) = phase.sincos();
    let (sin, cos) = (phase.clone() + pi.clone() * after.clone()).sincos();
    let pull = g.clone() * after.clone();
    let carried = start_sin / pi.clone();
    let velocity = launch.clone() + pull.clone() + sin / pi.clone() - carried.clone();
    let moved = (launch - carried + pull * T::from_ratio(1, 2)) * after.clone() + (start_cos - cos) / (pi.clone() * pi);
    let inwards = -from.signed(moved);
    let distance = if wall == from { inwards } else { d.clone() - inwards };
    [distance, velocity]
}

/// A contact of velocity 0 within a flight of a 1-1 motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Touch {
    /// The wall that the flight starts from.
    pub from: Side,
    /// The wall touched.
    pub wall: Side,
}

impl Touch {
    /// The four there may be.
    pub const ALL: [Self; 4] = [
        Self {
            from: Side::Bottom,
            wall: Side::Bottom,
        },
        Self {
            from: Side::Bottom,
            wall: Side::Top,
        },
        Self {
            from: Side::Top,
            wall: Side::Bottom,
        },
        Self {
            from: Side::Top,
            wall: Side::Top,
        },
    ];

    /// [the distance from the wall, the velocity], a time `after` into the flight; both 0 at a touch.
    pub fn excess<T: Analytic>(self, balance: &OneOneEquations<T>, t_1: &T, middle: &T, after: &T) -> [T; 2] {
        let [v, w] = balance.velocities(t_1, middle);
        let [at_bottom, at_top] = balance.phases(t_1, middle);
        let (r, before, phase) = match self.from {
            Side::Bottom => (balance.restitution(Side::Bottom), v, at_bottom),
            Side::Top => (balance.restitution(Side::Top), w, at_top),
        };
        let walls = [self.from, self.wall];
        contact([balance.g(), balance.d()], walls, -(r * before), &phase, after)
    }

    /// Whether such a contact may be, for certain `false` only where it cannot: the time must lie within the flight,
    /// and a flight leaves a wall, or comes to it, and touches it besides, only where the acceleration changes sign
    /// in between.
    pub fn may_be<E: Endpoint>(
        self,
        balance: &OneOneEquations<Interval<E>>,
        t_1: &Interval<E>,
        middle: &Interval<E>,
        after: &Interval<E>,
    ) -> bool {
        let lasts = match self.from {
            Side::Bottom => t_1.clone(),
            Side::Top => balance.total() - t_1.clone(),
        };
        let left = lasts.clone() - after.clone();
        if left.is_negative() || after.is_negative() {
            return false;
        }
        let [at_bottom, at_top] = balance.phases(t_1, middle);
        let start = if self.from == Side::Bottom { at_bottom } else { at_top };
        let at = |time: Interval<E>| start.clone() + Interval::pi() * time;
        let over = if self.from == self.wall {
            at(Interval::zero().hull(after))
        } else {
            at(after.hull(&lasts))
        };
        (over.sincos().1 + balance.g().clone()).contains_zero()
    }
}
