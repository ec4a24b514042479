//! What happens to a motion of any word at special values of a parameter, as equations beside those of the word.

use crate::model::{Motion, Side};
use crate::number::{Analytic, Dual, Endpoint, Interval};
use crate::orbit::continuation::extended_system::ExtendedSystem;
use crate::orbit::equations::conditions::{BifurcationKind, contact};
use crate::orbit::equations::duals::by_duals;
use crate::orbit::equations::square_system::SquareSystem;
use crate::orbit::equations::words::WordEquations;
use crate::orbit::family::Family;
use crate::orbit::interval_box::IntervalBox;
use crate::orbit::orbit::{OrbitImpact, flight_jacobians};
use crate::orbit::stability::{FlightJacobian, product};
use crate::orbit::word::Word;
use num_dual::DualNum;

/// A condition on the impacts of a motion, explicit and without poles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mark {
    /// Tr(DP) = -(1 + Det(DP)).
    MultiplierMinusOne,
    /// Tr(DP) = 1 + Det(DP).
    MultiplierOne,
    /// Tr(DP) is twice the product of the restitutions.
    DoublePositive,
    /// Tr(DP) is minus twice the product of the restitutions.
    DoubleNegative,
    /// This impact has velocity 0.
    Slow(usize),
    /// The flight after this impact touches this wall, the touch a further unknown.
    Touch(usize, Side),
}

impl Mark {
    /// Those that ask for a multiplier.
    pub const MULTIPLIERS: [Self; 4] = [
        Self::MultiplierMinusOne,
        Self::MultiplierOne,
        Self::DoublePositive,
        Self::DoubleNegative,
    ];

    /// What the mark means; a multiplier of 1 is a fold but for the crossings of branches.
    pub fn event(self) -> BifurcationKind {
        match self {
            Self::MultiplierMinusOne => BifurcationKind::PeriodDoubling,
            Self::MultiplierOne => BifurcationKind::Fold,
            Self::DoublePositive | Self::DoubleNegative => BifurcationKind::NodeFocus,
            Self::Slow(_) | Self::Touch(..) => BifurcationKind::Grazing,
        }
    }

    /// (Tr(DP) - level) times the velocities of all impacts, for the marks that ask for a multiplier.
    pub fn multiplier_excess<T: Analytic>(self, links: &[FlightJacobian<T>]) -> T {
        let (matrix, velocities) = product(links);
        let root = links
            .iter()
            .fold(T::one(), |root, link| root * link.restitution.clone());
        let sum = T::one() + root.clone() * root.clone();
        let twice = root.clone() + root;
        let level = match self {
            Self::MultiplierMinusOne => -sum,
            Self::MultiplierOne => sum,
            Self::DoublePositive => twice,
            _ => -twice,
        };
        matrix.trace() - level * velocities
    }

    /// What is 0 at the mark.
    fn excess<T: Analytic>(self, system: &WordEquations<T>, fixes: &[OrbitImpact<T>], after: Option<&T>) -> Vec<T> {
        let sides: Vec<Side> = system.word.sides().collect();
        match (self, after) {
            (Self::Slow(impact), _) => vec![fixes[impact].velocity.clone()],
            (Self::Touch(flight, wall), Some(after)) => {
                touch(&system.motion, sides[flight], &fixes[flight], wall, after).to_vec()
            }
            _ => vec![self.multiplier_excess(&flight_jacobians(&sides, &system.motion, fixes))],
        }
    }
}

/// [`contact`] of the flight after an impact.
pub(crate) fn touch<T: Analytic>(
    motion: &Motion<T>,
    side: Side,
    fix: &OrbitImpact<T>,
    wall: Side,
    after: &T,
) -> [T; 2] {
    let launch = -(motion.restitution(side).clone() * fix.velocity.clone());
    contact([motion.g(), motion.d()], [side, wall], launch, &fix.phase, after)
}

/// The equations of a word and those of a mark, in the phases, the parameter and, for a touch, its time.
pub(crate) struct Marked<'a, F> {
    pub along: &'a ExtendedSystem<F>,
    pub mark: Mark,
}

impl<F: Family> Marked<'_, F> {
    pub fn unknowns(&self) -> usize {
        let touch = matches!(self.mark, Mark::Touch(..));
        self.along.impacts() + 1 + usize::from(touch)
    }

    pub fn equations<T: Analytic>(&self, at: &[T]) -> Option<Vec<T>> {
        let count = self.along.impacts();
        let (phases, rest) = at.split_at(count);
        let system = self.along.at(&rest[0])?;
        let mut values = system.residuals(phases);
        let fixes = system.fixes(phases);
        values.extend(self.mark.excess(&system, &fixes, rest.get(1)));
        Some(values)
    }
}

/// The most unknowns there are: the phases of the longest word, the parameter and the time of a touch.
pub(crate) const UNKNOWNS: usize = Word::LONGEST + 2;

impl<F: Family> Marked<'_, F> {
    /// As many equations for every word, so that the proofs are compiled once: unknowns that a word does not have
    /// are 0, by equations of their own.
    pub fn padded<T: Analytic>(&self, at: &[T; UNKNOWNS]) -> Option<[T; UNKNOWNS]> {
        let (own, idle) = at.split_at(self.unknowns());
        let mut values = self.equations(own)?;
        values.extend(idle.iter().cloned());
        values.try_into().ok()
    }
}

impl<F: Family, E: Endpoint> SquareSystem<E, UNKNOWNS> for Marked<'_, F>
where
    Interval<E>: DualNum,
{
    fn linearised(
        &self,
        cell: &IntervalBox<E, UNKNOWNS>,
    ) -> (IntervalBox<E, UNKNOWNS>, [IntervalBox<E, UNKNOWNS>; UNKNOWNS]) {
        let unknown = || Dual::new(Interval::whole(), Interval::whole());
        by_duals(
            |at| self.padded(at).unwrap_or_else(|| std::array::from_fn(|_| unknown())),
            cell,
        )
    }

    fn values(&self, cell: &IntervalBox<E, UNKNOWNS>) -> IntervalBox<E, UNKNOWNS> {
        self.padded(cell)
            .unwrap_or_else(|| std::array::from_fn(|_| Interval::whole()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Map;
    use crate::orbit::equations::words::FlightBoundaryValues;

    #[test]
    fn a_flight_is_at_its_walls_where_it_starts_and_ends() {
        let motion = Motion::new(0.12, 0.3, 0.6, 0.4).expect("a motion");
        let walls = [Side::Bottom, Side::Top];
        for (map, start, end) in [
            (Map::P1, 0.4, 2.0),
            (Map::P2, 2.0, 5.1),
            (Map::P3, 0.4, 3.0),
            (Map::P4, 1.0, 4.0),
        ] {
            let leap = FlightBoundaryValues::new(&motion, map, &start, &end);
            let side = map.from();
            let fix = OrbitImpact {
                phase: start,
                velocity: -leap.launch / motion.restitution(side),
                time: (end - start) / std::f64::consts::PI,
            };
            let [at_start, launch] = touch(&motion, side, &fix, side, &0.0);
            let [at_end, arrival] = touch(&motion, side, &fix, map.to(), &fix.time);
            assert!(at_start == 0.0 && (launch - leap.launch).abs() < 1e-15);
            assert!(at_end.abs() < 1e-15 && (arrival - leap.arrival).abs() < 1e-14);
            let [one, other] = walls.map(|wall| touch(&motion, side, &fix, wall, &0.3)[0]);
            assert!((one + other - motion.d()).abs() < 1e-15);
        }
    }
}
