//! The conditions that a motion meets at a bifurcation, and the kinds of bifurcations.

use crate::model::Side;
use crate::orbit::equations::flight::LaunchedFlight;
use crate::orbit::stability::{FlightJacobian, loss_factor, product};
use numbers::Analytic;
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

/// A condition on a motion of any word, explicit and without poles. Impacts and flights are counted from 0 in the order of
/// the word; flight k follows impact k.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BifurcationCondition {
    /// Tr(DP) = -(1 + Det(DP)).
    MultiplierMinusOne,
    /// Tr(DP) = 1 + Det(DP).
    MultiplierOne,
    /// Tr(DP) is twice the product of the restitutions.
    DoublePositive,
    /// Tr(DP) is minus twice the product of the restitutions.
    DoubleNegative,
    /// This impact has velocity 0.
    ZeroVelocity(usize),
    /// The flight after this impact touches this wall with velocity 0; the time of the touch is a further unknown.
    Touch(usize, Side),
}

impl BifurcationCondition {
    /// The conditions on a multiplier.
    pub const MULTIPLIERS: [Self; 4] = [
        Self::MultiplierMinusOne,
        Self::MultiplierOne,
        Self::DoublePositive,
        Self::DoubleNegative,
    ];

    /// The bifurcation that the condition means. A multiplier of 1 is a fold but where branches cross, which is told apart
    /// elsewhere.
    pub fn kind(self) -> BifurcationKind {
        match self {
            Self::MultiplierMinusOne => BifurcationKind::PeriodDoubling,
            Self::MultiplierOne => BifurcationKind::Fold,
            Self::DoublePositive | Self::DoubleNegative => BifurcationKind::NodeFocus,
            Self::ZeroVelocity(_) | Self::Touch(..) => BifurcationKind::Grazing,
        }
    }

    /// Tr(DP) where the condition holds, for the conditions on a multiplier; `loss` is the product of the restitutions.
    pub fn trace<T: Analytic>(self, loss: &T) -> Option<T> {
        let sum = || T::one() + loss.clone() * loss.clone();
        let twice = || loss.clone() + loss.clone();
        match self {
            Self::MultiplierMinusOne => Some(-sum()),
            Self::MultiplierOne => Some(sum()),
            Self::DoublePositive => Some(twice()),
            Self::DoubleNegative => Some(-twice()),
            Self::ZeroVelocity(_) | Self::Touch(..) => None,
        }
    }

    /// (Tr(DP) - its value where the condition holds) times the velocities of all impacts, which has no pole; 0 for a
    /// condition that is not on a multiplier, and for one on a node and a focus after a plastic impact, where no motion
    /// is a focus.
    pub fn multiplier_excess<T: Analytic>(self, jacobians: &[FlightJacobian<T>]) -> T {
        let loss = loss_factor(jacobians);
        let Some(level) = self.trace(&loss) else {
            return T::zero();
        };
        if self.kind() == BifurcationKind::NodeFocus && loss.is_zero() {
            return T::zero();
        }
        let (matrix, velocities) = product(jacobians);
        matrix.trace() - level * velocities
    }
}

/// [the distance from the wall, the velocity], a time `after` into a flight; both 0 at a touch.
pub fn touch_excess<T: Analytic>(flight: &LaunchedFlight<T>, wall: Side, after: &T) -> [T; 2] {
    [flight.distance(wall, after), flight.velocity(after)]
}
