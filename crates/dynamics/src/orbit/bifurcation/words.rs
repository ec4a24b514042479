//! The bifurcations of motions of any word: their equations beside those of the word, proved and located.

use crate::model::Side;
use crate::orbit::bifurcation::point::{BifurcationPoint, EnclosedBifurcation, clearance_at};
use crate::orbit::continuation::extended_system::ExtendedSystem;
use crate::orbit::continuation::test_functions::TestFunctions;
use crate::orbit::equations::conditions::{BifurcationCondition, BifurcationKind, touch_excess};
use crate::orbit::equations::duals::{Linearised, by_duals, unknown};
use crate::orbit::equations::flight::{LaunchedFlight, OrbitImpact};
use crate::orbit::equations::square_system::SquareSystem;
use crate::orbit::equations::words::WordEquations;
use crate::orbit::family::Family;
use crate::orbit::inconclusive::{Inconclusive, Property};
use crate::orbit::interval_box::IntervalBox;
use crate::orbit::orbit::{first_of, flight_jacobians};
use crate::orbit::solve::krawczyk::{ProvedRoot, prove, prove_over};
use crate::orbit::solve::newton::{Ending, newton_by_duals};
use crate::orbit::stability::{determinant, trace};
use crate::orbit::word::Word;
use num_dual::DualNum;
use numbers::{Analytic, DoubleDouble, Doubles, Endpoint, Field, Interval, Rung};

/// The equations of a word and a condition, in the phases, the parameter and, for a touch, its time.
pub(crate) struct ConditionedWord<'a, F> {
    pub extended: &'a ExtendedSystem<F>,
    pub condition: BifurcationCondition,
    pub listing: Listing,
}

/// How the motion at a bifurcation, of a word that may be shorter, makes one of the word followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Listing {
    /// As it is.
    Plain,
    /// Gone through twice.
    Twice,
    /// This impact, of velocity 0, counted twice.
    Doubled(usize),
}

/// The unknowns of most words, and the most there are: the phases of the longest word, the parameter and the time of a
/// touch. The equations are compiled for these two numbers alone.
const FEW: usize = 8;
const UNKNOWNS: usize = Word::LONGEST + 2;

/// How Newton's method ends: from a good guess it takes four steps.
const ENDING: Ending = Ending {
    most_steps: 20,
    last_step: 1e-10,
    growth: 4.0,
    rounding: 0.0,
};

/// The widest box tried for a proof, in radians, times and parts of the range, and how often a tenth of it.
const WIDEST: f64 = 1e-3;
const TENTHS: i32 = 9;

/// A clearance known this well to be 0 is given as 0.
const ZERO_CLEARANCE: f64 = 1e-25;

/// A point with 0 for the unknowns that a word does not have.
fn padded<const D: usize>(point: &[f64]) -> [f64; D] {
    std::array::from_fn(|i| point.get(i).copied().unwrap_or(0.0))
}

/// Evaluates the left sides of the equations of a word and of a condition, a touch a time `after` into its flight.
pub(crate) fn conditioned<T: Analytic>(
    system: &WordEquations<T>,
    condition: BifurcationCondition,
    phases: &[T],
    after: &T,
) -> Option<Vec<T>> {
    let mut values = system.residuals(phases);
    let impacts = system.orbit_impacts(phases);
    let sides: Vec<Side> = system.word.sides().collect();
    match condition {
        BifurcationCondition::ZeroVelocity(impact) => values.push(impacts.get(impact)?.velocity.clone()),
        BifurcationCondition::Touch(flight, wall) => {
            let path = LaunchedFlight::after(&system.motion, *sides.get(flight)?, impacts.get(flight)?);
            values.extend(touch_excess(&path, wall, after));
        }
        condition => values.push(condition.multiplier_excess(&flight_jacobians(&sides, &system.motion, &impacts))),
    }
    Some(values)
}

impl<F: Family> ConditionedWord<'_, F> {
    /// As many equations for every word, so that the proofs are compiled for few numbers of unknowns: those that a word
    /// does not have are 0, by equations of their own. `None` where the parameter can have no such value.
    fn equations<T: Analytic, const D: usize>(&self, at: &[T; D]) -> Option<[T; D]> {
        let count = self.extended.impacts();
        let system = self.extended.at(&at[count])?;
        let mut values = conditioned(&system, self.condition, &at[..count], &at[(count + 1).min(D - 1)])?;
        let own = values.len();
        values.extend(at[own..].iter().cloned());
        values.try_into().ok()
    }

    /// The solution that Newton's method leads to from a guess at all unknowns.
    pub fn solved(&self, guess: &[f64]) -> Option<Vec<f64>> {
        if guess.len() <= FEW {
            self.solved_among::<FEW>(guess)
        } else {
            self.solved_among::<UNKNOWNS>(guess)
        }
    }

    fn solved_among<const D: usize>(&self, guess: &[f64]) -> Option<Vec<f64>> {
        let point = newton_by_duals::<D>(padded(guess), &ENDING, |at| self.equations(at))?;
        Some(point[..guess.len()].to_vec())
    }

    /// The bifurcation at a point, proved where that can be.
    pub fn located(&self, point: &[f64]) -> Option<BifurcationPoint> {
        self.enclosed_at(point).map(|(found, _)| found)
    }

    /// The same, with the box of all unknowns in which it is proved to be, if it is.
    pub fn enclosed_at(&self, point: &[f64]) -> Option<(BifurcationPoint, Option<Vec<Interval<f64>>>)> {
        let proved = if point.len() <= FEW {
            self.proved_among::<FEW>(point)
        } else {
            self.proved_among::<UNKNOWNS>(point)
        };
        proved.map(|(found, cell)| (found, Some(cell))).or_else(|| {
            let cell: Vec<Interval<DoubleDouble>> = point.iter().map(|side| Interval::from_f64(*side)).collect();
            Some((self.row(&cell, false)?, None))
        })
    }

    /// Proved in f64, then located as well as double-double can.
    fn proved_among<const D: usize>(&self, point: &[f64]) -> Option<(BifurcationPoint, Vec<Interval<f64>>)> {
        let unknowns = point.len();
        let point = padded::<D>(point);
        let place = self.extended.impacts();
        let scale = |i: usize| {
            if i == place { self.extended.range.width() } else { 1.0 }
        };
        let root: ProvedRoot<f64, D> = (0..TENTHS).find_map(|tenths| {
            let half_widths = std::array::from_fn(|i| WIDEST * 0.1_f64.powi(tenths) * scale(i));
            prove(self, &point, &half_widths)
        })?;
        let cell = prove_over::<f64, DoubleDouble, D>(self, &root)?;
        Some((self.row(&cell[..unknowns], true)?, root.enclosure[..unknowns].to_vec()))
    }

    fn row<E: Endpoint>(&self, cell: &[Interval<E>], certified: bool) -> Option<BifurcationPoint> {
        let row = self.enclosed(cell, certified).ok()?.rounded(&Doubles);
        Some(BifurcationPoint {
            computed_in: Rung::Double,
            ..row
        })
    }

    fn enclosed<E: Endpoint>(
        &self,
        cell: &[Interval<E>],
        certified: bool,
    ) -> Result<EnclosedBifurcation<E>, Inconclusive> {
        let open = |what| Inconclusive::Undecided { what };
        let (phases, rest) = cell.split_at(self.extended.impacts());
        let parameter = &rest[0];
        let system = self.extended.at(parameter).ok_or(open(Property::Existence))?;
        let mut impacts = system.orbit_impacts(phases);
        if let BifurcationCondition::ZeroVelocity(impact) = self.condition {
            impacts[impact].velocity = Interval::from_integer(0);
        }
        let sides: Vec<Side> = system.word.sides().collect();
        let touches = |clearance: &Interval<E>| match self.condition {
            BifurcationCondition::Touch(..) => true,
            // a motion that repeats itself but for this impact touches the wall in its other round as well
            BifurcationCondition::ZeroVelocity(_) => clearance.radius().to_f64() < ZERO_CLEARANCE,
            _ => false,
        };
        let kept = clearance_at(self.condition, (&sides, &system.motion), &impacts, 0.0, touches);
        let (clearance, admissible) = match kept {
            Err(_) if !certified => self.likely_clearance(cell),
            kept => kept?,
        };
        let jacobians = flight_jacobians(&sides, &system.motion, &impacts);
        let once = match self.condition {
            BifurcationCondition::ZeroVelocity(_) => None,
            _ => Some(trace(&jacobians)),
        };
        let trace = match self.listing {
            Listing::Twice => once.map(|once| once.square() - Interval::from_integer(2) * determinant(&jacobians)),
            _ => once,
        };
        let (word, periods, mut impacts) = self.listed(impacts);
        let first = first_of(&word, &impacts);
        impacts.rotate_left(first);
        Ok(EnclosedBifurcation {
            kind: if self.listing == Listing::Twice {
                BifurcationKind::PeriodDoubling
            } else {
                self.condition.kind()
            },
            word: word.rotated(first),
            periods,
            parameter: parameter.clone(),
            d: system.motion.d().clone(),
            impacts,
            trace,
            clearance,
            admissible,
            certified,
        })
    }

    /// The clearance in f64, of which nothing is proved.
    fn likely_clearance<E: Endpoint>(&self, cell: &[Interval<E>]) -> (Option<Interval<E>>, bool) {
        let point: Vec<f64> = cell.iter().map(Analytic::to_f64).collect();
        let (phases, rest) = point.split_at(self.extended.impacts());
        let system = self.extended.at(&rest[0]);
        let clearance = system.map_or(f64::INFINITY, |system| TestFunctions::new(&system, phases).clearance());
        let enclosed = clearance.is_finite().then(|| Interval::from_f64(clearance));
        (enclosed, clearance >= 0.0)
    }

    /// The impacts of the word that is followed.
    fn listed<E: Endpoint>(
        &self,
        mut impacts: Vec<OrbitImpact<Interval<E>>>,
    ) -> (Word, u32, Vec<OrbitImpact<Interval<E>>>) {
        let (word, periods) = (&self.extended.word, self.extended.periods);
        match self.listing {
            Listing::Plain => (word.clone(), periods, impacts),
            // the word that was followed is twice this one
            Listing::Twice => (
                word.twice().unwrap_or_else(|| word.clone()),
                2 * periods,
                [impacts.clone(), impacts].concat(),
            ),
            Listing::Doubled(impact) => {
                let mut again = impacts[impact].clone();
                again.time = Interval::from_integer(0);
                impacts.insert(impact, again);
                (word.doubled(impact), periods, impacts)
            }
        }
    }
}

impl<F: Family, E: Endpoint, const D: usize> SquareSystem<E, D> for ConditionedWord<'_, F>
where
    Interval<E>: DualNum,
{
    fn linearised(&self, cell: &IntervalBox<E, D>) -> Linearised<Interval<E>, D> {
        by_duals(|at| self.equations(at), cell).unwrap_or_else(unknown)
    }

    fn values(&self, cell: &IntervalBox<E, D>) -> IntervalBox<E, D> {
        self.equations(cell).unwrap_or_else(|| unknown().0)
    }
}
