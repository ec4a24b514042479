//! Periodic motions: all 1-1 motions of a scene, motions of other words, their stability, clearance and bifurcations; and
//! what simulated motions come to in the long run.
//!
//! One pipeline: `equations/` states what holds at a motion and at a bifurcation, `solve/` finds and proves solutions,
//! `continuation/` follows branches of them along a parameter, `bifurcation/` detects and locates the special points, and
//! the files of this folder put these together: [`find`] at one value of the parameters, [`OneOneBranches`] and
//! [`WordBranches`] over a range. `shooting/` confirms by other equations, `long_run/` looks at simulated motions.
//!
//! Every value of an [`Orbit`] is an enclosure. The forcing is that of the motion; all 1-1 motions are found, by proof,
//! under the paper's cos(pi t) between two walls alone ([`is_covered`]). Uses
//! `number/`, `model/` and, for what a simulated motion comes to, `impact/`.

mod bifurcation;
mod clearance;
mod continuation;
mod curves;
mod equations;
mod family;
mod find;
mod inconclusive;
mod interval_box;
mod long_run;
mod one_one_branches;
mod optimum;
mod options;
// the folder holds periodic motions, the file one of them
#[allow(clippy::module_inception)]
mod orbit;
mod output;
mod parallel;
mod proved_orbit;
mod rounding;
mod shooting;
mod solve;
mod stability;
mod voltages;
mod word;
mod word_branches;

pub use crate::model::{Exact, Parameters};
pub use bifurcation::one_one::{Bifurcations, CROSSING, LocatedBifurcation, bifurcations};
pub use bifurcation::point::{BifurcationPoint, EnclosedBifurcation};
pub use clearance::OrbitFlight;
pub use curves::follow::CurvePoint;
pub use curves::one_one_curves::OneOneCurves;
pub use curves::special_points::SpecialPoint;
pub use curves::word_curves::WordCurves;
pub use equations::conditions::{BifurcationCondition, BifurcationKind};
pub use equations::flight::{FlightBoundaryDerivatives, FlightBoundaryValues, LaunchedFlight, OrbitImpact};
pub use equations::one_one::OneOneEquations;
pub use equations::one_one_bifurcations::{ConditionedOneOne, SymmetricOneOne};
pub use equations::square_system::Decision;
pub use equations::words::WordEquations;
pub use family::{Family, Fixed, ParameterPlane};
pub use find::{FoundOrbits, OpenOrbit, find, find_as, is_covered};
pub use inconclusive::{Inconclusive, Property};
pub use interval_box::IntervalBox;
pub use long_run::attractor::{Attractor, LONGEST_WRITTEN};
pub use long_run::cycle_means::CycleMeans;
pub use long_run::lyapunov::{largest_multiplier, lyapunov};
pub use long_run::resting::RestingCycle;
pub use long_run::statistics::{
    AtRelease, Averaging, AveragingLength, Estimate, FREQUENCIES, LongRun, OfImpact, RunningMeans, Statistics,
};
pub use long_run::steady_state::{Settling, SteadyState};
pub use one_one_branches::{OneOneBranches, OpenBifurcation};
pub use optimum::design::{Choice, Devices, Gap, Pull, Range, Unit};
pub use optimum::incumbent::ProvedDevice;
pub use optimum::local_word::{ProvedWordDevice, local_optimum};
pub use optimum::record::{SearchBatch, SearchOutcomes, SearchRecord};
pub use optimum::search::{Optimum, OptimumLimits, OptimumPart, OptimumProgress, optimum, optimum_recorded};
pub use optimum::supremum::Active;
pub use options::OrbitOptions;
pub use orbit::{Orbit, flight_jacobians};
pub use output::{Output, OutputPrecision, most_figures};
pub use proved_orbit::ProvedOrbit;
pub use rounding::RoundedOrbit;
pub use shooting::confirm::{confirm_bifurcation, confirm_orbit};
pub use shooting::return_map::{ShootingError, ShootingSolution, shoot, shoot_bifurcation};
pub use solve::cover::{Cover, CoverError};
pub use solve::isolate::{Isolation, SearchLimits, isolate};
pub use solve::krawczyk::{ProvedRoot, prove, prove_over, sharpen};
pub use solve::one_one::{OneOneSearch, isolate_one_one, newton_one_one, newton_one_one_bifurcation};
pub use solve::refine::refine_one_one;
pub use solve::words::{WordOrbit, search_word, search_word_from};
pub use stability::{FlightJacobian, Multiplier, OrbitKind, determinant, loss_factor, multipliers, trace};
pub use voltages::{EnclosedVoltage, OrbitVoltages, VoltageEndpoint};
pub use word::{Word, WordError};
pub use word_branches::WordBranches;
