//! Rows along the approach to an extreme, by which digits left are a curve over the distance.

use super::StressError;
use super::approach::{Approach, CHAOS, GAP, GRAVITY, GRAZING, IMPACTS, LOSSLESS};
use super::impacts::{Setup, SimulatedImpact};
use super::lanes;
use super::long;
use super::motion::{self, Scene, Triple};
use super::quantity::{Exact, Quantity, Visitor, rows};
use super::row::{StressRow, place};
use dynamics::model::{Flight, Forcing, Impact, Motion, Side};
use numbers::{Analytic, Field};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// A row at a distance from an extreme.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveRow {
    /// The extreme.
    pub approach: Approach,
    /// The distance, or the length that grows.
    pub distance: f64,
    /// What is left there.
    pub row: StressRow,
}

/// A motion that is followed, or searched for.
enum Followed {
    Scene(Scene),
    Impact(SimulatedImpact),
    /// So many impacts near a motion that attracts.
    Long(u32),
}

/// What is followed at a distance from an extreme; `None` where there is nothing.
type AtDistance = fn(f64) -> Option<Followed>;

/// The extremes that a motion is followed to.
const MOTIONS: [(Approach, AtDistance); 9] = [
    (LOSSLESS, |near| scene(LOSSLESS, [0.12201, 0.4, 1.0 - near, 1.0 - near])),
    (LOSSLESS, |near| {
        impact([0.12201, 0.3, 1.0 - near, 1.0 - near, 0.7, 0.6], lanes::IMPACTS)
    }),
    (GRAVITY, |near| scene(GRAVITY, [1.0 - near, 1.5, 0.8, 0.8])),
    (GRAVITY, |near| {
        impact([1.0 - near, 0.3, 0.6, 0.3, 0.7, 0.6], lanes::IMPACTS)
    }),
    (GAP, |near| scene(GAP, [0.12201, near, 0.5, 0.5])),
    (GAP, |near| impact([0.12201, near, 0.9, 0.8, 0.7, 0.02], lanes::IMPACTS)),
    (GRAZING, |near| {
        let [g, r, phase, velocity] = GRAZED;
        impact([g, highest()? * (1.0 - near), r, r, phase, velocity], 2)
    }),
    // errors grow by a digit in two impacts
    (CHAOS, |length| {
        impact([0.12201, 1.7, 0.8, 0.8, 3.1, 2.0], length.round() as u32)
    }),
    (IMPACTS, |length| {
        Some(Followed::Long(2 * (0.5 * length).round() as u32))
    }),
];

/// g, r at both walls, and phase and velocity of the impact at the bottom after which the top is grazed.
const GRAZED: [f64; 4] = [0.12201, 0.6, 0.5, 0.3];

/// Steps of Newton's method from a tenth to all digits.
const STEPS: usize = 12;

fn scene(approach: Approach, parameters: [f64; 4]) -> Option<Followed> {
    Some(Followed::Scene(Scene {
        case: approach.name,
        parameters,
        periods: 1,
    }))
}

fn impact(inputs: [f64; 6], impacts: u32) -> Option<Followed> {
    Some(Followed::Impact(SimulatedImpact {
        inputs,
        setup: Setup::Paper,
        impacts,
    }))
}

/// How high the ball flies after the impact of [`GRAZED`]: the gap at which it grazes the top.
fn highest() -> Option<f64> {
    let [g, r, phase, velocity] = GRAZED.map(<Exact as Analytic>::from_f64);
    let forcing = Forcing::harmonic(&Exact::from(0.0));
    // the gap has no say before the end of a flight
    let motion = Motion::new(g, Exact::from(1.0), r.clone(), r).ok()?;
    let start = Impact {
        side: Side::Bottom,
        time: phase / Exact::pi(),
        velocity,
    };
    let flight = Flight::after(&motion, &forcing, &start).ok()?;
    let tenths = (1..20_i64).map(|tenths| Exact::from_ratio(tenths, 10));
    let falls = |time: &Exact| Side::Top.signed(flight.state(time).velocity) < 0.0;
    let mut time = tenths.into_iter().find(falls)?;
    for _ in 0..STEPS {
        let state = flight.state(&time);
        time -= state.velocity / state.acceleration;
    }
    Some(Side::Top.signed(flight.state(&time).displacement).to_f64())
}

impl Followed {
    fn rows(&self, triple: &Triple, case: &'static str) -> Result<Vec<StressRow>, StressError> {
        match self {
            Self::Scene(scene) => motion::rows(triple, scene),
            Self::Impact(impact) => impact.rows(case),
            Self::Long(impacts) => long::rows(case, *impacts, 0.0),
        }
    }

    /// The length that is followed, where the distance is one.
    fn length(&self) -> Option<u32> {
        match self {
            Self::Scene(_) => None,
            Self::Impact(impact) => Some(impact.impacts),
            Self::Long(impacts) => Some(*impacts),
        }
    }
}

/// The rows along some approaches.
pub(super) struct Curves {
    wanted: Vec<Approach>,
    rows: Vec<CurveRow>,
}

impl Curves {
    /// Of the approaches that have `only` in their names, none yet.
    ///
    /// # Errors
    /// `NoExtreme`.
    pub fn new(only: Option<&str>) -> Result<Self, StressError> {
        let is_wanted = |approach: &Approach| only.is_none_or(|only| approach.name.contains(only));
        let wanted: Vec<Approach> = Approach::ALL.into_iter().filter(is_wanted).collect();
        if wanted.is_empty() {
            return Err(StressError::NoExtreme {
                name: only.unwrap_or_default().to_owned(),
                known: Approach::ALL.map(|approach| approach.name).join(", "),
            });
        }
        let rows = Vec::new();
        Ok(Self { wanted, rows })
    }

    /// Adds the motions that are followed.
    ///
    /// # Errors
    /// Of a row.
    pub fn add_motions(&mut self, triple: &Triple) -> Result<(), StressError> {
        for (approach, at_distance) in MOTIONS {
            let Some(distances) = self.distances(approach) else {
                continue;
            };
            let mut points: Vec<(f64, Followed)> = Vec::new();
            for distance in distances {
                let case = approach.name;
                let fault = || StressError::Point {
                    case,
                    at: place(&[approach.distance], &[distance]),
                };
                let followed = at_distance(distance).ok_or_else(fault)?;
                let length = followed.length().filter(|_| approach.grows()).map(f64::from);
                points.push((length.unwrap_or(distance), followed));
            }
            // short lengths are the same one after rounding
            points.dedup_by_key(|(distance, _)| *distance);
            self.add(approach, &points, |followed| followed.rows(triple, approach.name))?;
        }
        Ok(())
    }

    /// All of them, extreme by extreme.
    pub fn into_rows(self) -> Vec<CurveRow> {
        let mut rows = self.rows;
        rows.sort_by_key(|row| Approach::ALL.iter().position(|approach| *approach == row.approach));
        rows
    }

    /// The distances of an approach that is wanted.
    fn distances(&self, approach: Approach) -> Option<Vec<f64>> {
        let distances = || approach.exponents().into_iter().map(|exponent| 10_f64.powf(exponent));
        self.wanted.contains(&approach).then(|| distances().collect())
    }

    fn add<P: Sync>(
        &mut self,
        approach: Approach,
        points: &[(f64, P)],
        rows: impl Fn(&P) -> Result<Vec<StressRow>, StressError> + Sync,
    ) -> Result<(), StressError> {
        let found = points.par_iter().map(|(distance, point)| {
            let curve_row = |row| CurveRow {
                approach,
                distance: *distance,
                row,
            };
            Ok(rows(point)?.into_iter().map(curve_row).collect())
        });
        let found: Result<Vec<Vec<CurveRow>>, StressError> = found.collect();
        self.rows.extend(found?.into_iter().flatten());
        Ok(())
    }
}

impl Visitor for Curves {
    fn visit(&mut self, quantity: &impl Quantity) -> Result<(), StressError> {
        let approach = quantity.approach();
        let Some(distances) = self.distances(approach) else {
            return Ok(());
        };
        let points: Vec<(f64, Vec<f64>)> = distances
            .iter()
            .zip(approach.exponents())
            .flat_map(|(distance, exponent)| quantity.near(exponent).into_iter().map(|dials| (*distance, dials)))
            .collect();
        self.add(approach, &points, |dials| {
            let inputs = quantity.set(dials);
            rows(quantity, &inputs)?.ok_or_else(|| StressError::Point {
                case: quantity.case(),
                at: place(quantity.inputs(), &inputs),
            })
        })
    }
}
