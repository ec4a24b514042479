//! The motion of any word at a bifurcation: located to the last digit, proved, and what a table says of it.

use crate::model::Side;
use crate::number::{Analytic, DoubleDouble, Dual, Endpoint, Field, Interval, seeded};
use crate::orbit::bifurcation::instant::{SHORTLY, SLOWLY, prove_over};
use crate::orbit::continuation::test_functions::TestFunctions;
use crate::orbit::equations::conditions::BifurcationKind;
use crate::orbit::equations::word_conditions::{Mark, Marked, UNKNOWNS};
use crate::orbit::family::Family;
use crate::orbit::inconclusive::{Inconclusive, Property};
use crate::orbit::orbit::{OrbitImpact, clearance, first_of, flight_jacobians, reduced};
use crate::orbit::rounding::error_of;
use crate::orbit::solve::krawczyk::{ProvedRoot, prove};
use crate::orbit::stability::trace;
use crate::orbit::word::Word;
use nalgebra::{SMatrix, SVector};

/// A bifurcation of a motion of any word, in f64.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// What happens.
    pub event: BifurcationKind,
    /// The word of the motions followed, from the impact that the lists start with.
    pub word: Word,
    /// n
    pub periods: u32,
    /// The value of the swept parameter.
    pub parameter: f64,
    /// The gap.
    pub d: f64,
    /// Of the impacts, in [0, 2 pi).
    pub phases: Vec<f64>,
    /// Just before each.
    pub velocities: Vec<f64>,
    /// Of the flight after each.
    pub times: Vec<f64>,
    /// Of the derivative of the map; infinite where an impact has velocity 0.
    pub trace: f64,
    /// The least distance from a wall at the turning points strictly inside the flights, 0 at a touch; infinite
    /// where nothing turns.
    pub clearance: f64,
    /// Whether the ball keeps between the walls, the touch itself allowed.
    pub admissible: bool,
    /// No parameter, phase, velocity or time above is farther than this from the exact one. `None` where there is no
    /// proof that such an event exists.
    pub error_bound: Option<f64>,
}

/// How the motion at an event, of a word that may be shorter, makes one of the word followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Listing {
    /// As it is.
    Plain,
    /// Gone through twice.
    Twice,
    /// This impact, of velocity 0, counted twice.
    Doubled(usize),
}

/// Newton steps to an event: from a good guess it takes four.
const MOST_STEPS: usize = 20;
const SETTLED: f64 = 1e-10;

/// The widest box tried for a proof, in radians, times and parts of the range, and how often a tenth of it.
const WIDEST: f64 = 1e-3;
const TENTHS: i32 = 9;

/// A clearance known this well to be 0 is told as 0.
const NOTHING: f64 = 1e-25;

/// An event that Newton's method found or not, to be proved.
pub(crate) struct Candidate<'a, 'b, F> {
    pub marked: &'b Marked<'a, F>,
    pub listing: Listing,
}

/// A point with 0 for the unknowns that a word does not have.
fn padded(point: &[f64]) -> [f64; UNKNOWNS] {
    std::array::from_fn(|i| point.get(i).copied().unwrap_or(0.0))
}

impl<F: Family> Candidate<'_, '_, F> {
    /// Where Newton's method settles from a guess at all unknowns.
    pub fn settled(&self, guess: &[f64]) -> Option<Vec<f64>> {
        let mut point = padded(guess);
        let mut last = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let (values, slopes) = self.linearised(&point)?;
            let step = slopes.try_inverse()? * values;
            let size = step.amax();
            let settles = size < 4.0 * last; // NaN does not
            if !settles {
                return None;
            }
            for (coordinate, step) in point.iter_mut().zip(step.iter()) {
                *coordinate -= step;
            }
            if size < SETTLED {
                return Some(point[..guess.len()].to_vec());
            }
            last = size;
        }
        None
    }

    /// The event at a point, proved where that can be.
    pub fn moment(&self, point: &[f64]) -> Option<Moment> {
        self.proved(point).or_else(|| self.likely(point))
    }

    fn linearised(
        &self,
        point: &[f64; UNKNOWNS],
    ) -> Option<(SVector<f64, UNKNOWNS>, SMatrix<f64, UNKNOWNS, UNKNOWNS>)> {
        let mut values = SVector::zeros();
        let mut slopes = SMatrix::zeros();
        for column in 0..UNKNOWNS {
            let at = std::array::from_fn(|i| {
                if i == column {
                    seeded(point[i])
                } else {
                    Dual::from_re(point[i])
                }
            });
            for (row, value) in self.marked.padded(&at)?.iter().enumerate() {
                values[row] = value.re;
                slopes[(row, column)] = value.eps;
            }
        }
        Some((values, slopes))
    }

    /// Proved in f64, then located as well as double-double can.
    fn proved(&self, point: &[f64]) -> Option<Moment> {
        let unknowns = point.len();
        let point = padded(point);
        let place = self.marked.along.impacts();
        let scale = |i: usize| {
            if i == place {
                self.marked.along.range.width()
            } else {
                1.0
            }
        };
        let root: ProvedRoot<f64, UNKNOWNS> = (0..TENTHS).find_map(|tenths| {
            let half_widths = std::array::from_fn(|i| WIDEST * 0.1_f64.powi(tenths) * scale(i));
            prove(self.marked, &point, &half_widths)
        })?;
        let cell = prove_over::<f64, DoubleDouble, UNKNOWNS>(self.marked, &root)?;
        self.told(&cell[..unknowns], true).ok()
    }

    /// The event without a proof: what its numbers are in f64.
    fn likely(&self, point: &[f64]) -> Option<Moment> {
        let cell: Vec<Interval<DoubleDouble>> = point.iter().map(|side| Interval::from_f64(*side)).collect();
        self.told(&cell, false).ok()
    }

    fn told<E: Endpoint>(&self, cell: &[Interval<E>], certified: bool) -> Result<Moment, Inconclusive> {
        let open = |what| Inconclusive::Undecided { what };
        let Marked { along, mark } = self.marked;
        let (phases, rest) = cell.split_at(along.impacts());
        let parameter = &rest[0];
        let system = along.at(parameter).ok_or(open(Property::Existence))?;
        let mut fixes = system.fixes(phases);
        if let Mark::Slow(impact) = mark {
            fixes[*impact].velocity = Interval::from_integer(0);
        }
        let sides: Vec<Side> = system.word.sides().collect();
        let (clearance, admissible) = match self.kept(&system.motion, &sides, &fixes) {
            Err(_) if !certified => self.guessed(&cell.iter().map(Analytic::to_f64).collect::<Vec<_>>()),
            kept => kept?,
        };
        let trace = match mark {
            Mark::Slow(_) => f64::INFINITY,
            _ => {
                let links = flight_jacobians(&sides, &system.motion, &fixes);
                let once = trace(&links);
                match self.listing {
                    Listing::Twice => {
                        let determinant = crate::orbit::stability::determinant(&links);
                        (once.square() - Interval::from_integer(2) * determinant).to_f64()
                    }
                    _ => once.to_f64(),
                }
            }
        };
        let (word, periods, fixes) = self.listed(fixes);
        let first = first_of(&word, &fixes);
        let fixes: Vec<_> = fixes.iter().cycle().skip(first).take(fixes.len()).collect();
        let d = system.motion.d().clone();
        let columns: [Vec<Interval<E>>; 3] = [
            fixes.iter().map(|fix| reduced(&fix.phase)).collect(),
            fixes.iter().map(|fix| fix.velocity.clone()).collect(),
            fixes.iter().map(|fix| fix.time.clone()).collect(),
        ];
        let values = columns.iter().flatten().chain([parameter, &d]);
        let error = values.map(|value| error_of(value.to_f64(), value)).fold(0.0, f64::max);
        let printed = |values: &[Interval<E>]| values.iter().map(Analytic::to_f64).collect::<Vec<f64>>();
        let [phases, velocities, times] = columns.each_ref().map(|column| printed(column));
        Ok(Moment {
            event: if self.listing == Listing::Twice {
                BifurcationKind::PeriodDoubling
            } else {
                mark.event()
            },
            word: word.rotated(first),
            periods,
            parameter: parameter.to_f64(),
            d: d.to_f64(),
            phases: phases.into_iter().map(|phase| phase.max(0.0)).collect(),
            velocities,
            times,
            trace,
            clearance,
            admissible,
            error_bound: certified.then_some(error),
        })
    }

    /// The clearance, and whether the motion keeps between the walls.
    fn kept<E: Endpoint>(
        &self,
        motion: &crate::model::Motion<Interval<E>>,
        sides: &[Side],
        fixes: &[OrbitImpact<Interval<E>>],
    ) -> Result<(f64, bool), Inconclusive> {
        let mut fixes = fixes.to_vec();
        if let Mark::Slow(slow) = self.marked.mark {
            let before = (slow + fixes.len() - 1) % fixes.len();
            fixes[slow].velocity = Interval::from_f64(sides[slow].sign() * SLOWLY);
            fixes[before].time -= Interval::from_f64(SHORTLY);
        }
        let Some(clearance) = clearance(sides, motion, &fixes)? else {
            return Ok((f64::INFINITY, true));
        };
        if clearance.contains_zero() {
            return match self.marked.mark {
                Mark::Touch(..) => Ok((0.0, true)),
                // a motion that repeats itself but for this impact touches the wall in its other round as well
                Mark::Slow(_) if clearance.radius().to_f64() < NOTHING => Ok((0.0, true)),
                _ => Err(Inconclusive::Undecided {
                    what: Property::Clearance,
                }),
            };
        }
        Ok((clearance.to_f64(), clearance.is_positive()))
    }

    /// The same in f64.
    fn guessed(&self, point: &[f64]) -> (f64, bool) {
        let (phases, rest) = point.split_at(self.marked.along.impacts());
        let gauge = self
            .marked
            .along
            .at(&rest[0])
            .map(|system| TestFunctions::new(&system, phases));
        let clearance = gauge.map_or(f64::INFINITY, |gauge| gauge.clearance());
        (clearance, clearance >= 0.0)
    }

    /// The impacts of the word that is followed.
    fn listed<E: Endpoint>(&self, fixes: Vec<OrbitImpact<Interval<E>>>) -> (Word, u32, Vec<OrbitImpact<Interval<E>>>) {
        let along = self.marked.along;
        match self.listing {
            Listing::Plain => (along.word.clone(), along.periods, fixes),
            Listing::Twice => (along.word.twice(), 2 * along.periods, [fixes.clone(), fixes].concat()),
            Listing::Doubled(impact) => {
                let mut fixes = fixes;
                let mut again = fixes[impact].clone();
                again.time = Interval::from_integer(0);
                fixes.insert(impact, again);
                (along.word.doubled(impact), along.periods, fixes)
            }
        }
    }
}
