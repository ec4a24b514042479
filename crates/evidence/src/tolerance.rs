//! Every tolerance of the witnesses, with its reason.

/// The largest residual of a premise, relative to the size of its terms, at a point taken: some hundred roundings.
pub const PREMISE: f64 = 1e-13;

/// The same over 40 digits: the steps of the polishing shrink the residual by ten digits each.
pub const PREMISE_WIDE: f64 = 1e-32;

/// The same of a point that is refined: so far below that a point beside a double root must move, by a hundred times, and so
/// far above the roundings of 40 digits that every other one is there.
pub const PREMISE_REFINED: f64 = 1e-36;

/// The same of laws at times that no row holds them at.
pub const LAWS_WIDE: f64 = 1e-25;

/// A row whose part that is new against the rows before it is smaller than this, relative to the row itself, says
/// nothing new: rows are right to about 1e-14, and points are drawn without special properties.
pub const DEPENDENT: f64 = 1e-9;

/// What stands between bars is 0 at a point where it is smaller: points are of the size of 1, and solved to 1e-13.
pub const CORNER: f64 = 1e-9;

/// The last refinement of a derivative, relative to its size: in f64 what a flight close to grazing leaves, in 40
/// digits far below the gap that tells equal sides from others.
pub const SLOPE: f64 = 1e-11;
/// See [`SLOPE`].
pub const SLOPE_WIDE: f64 = 1e-28;

/// A proved claim with fewer digits than this in f64 is looked at again in 40 digits.
pub const DOUBTFUL_PROOF: f64 = 9.0;

/// A refuted claim with more digits than this at every point in f64 is looked at again in 40 digits.
pub const DOUBTFUL_REFUTATION: f64 = 9.0;

/// Relative gaps in 40 digits: below the first the sides are equal, above the second they differ; between the two
/// nothing is said. A formula that is wrong only by a term of 1e-24 of its size is told apart in 40 digits.
pub const EQUAL_WIDE: f64 = 1e-25;
/// See [`EQUAL_WIDE`].
pub const APART_WIDE: f64 = 1e-24;

/// The same where no premise had to be solved: some hundred roundings.
pub const APART_EXACT: f64 = 1e-36;

/// The same where sums, integrals or limits are found by steps that never end: their errors are below 1e-26 of their size.
pub const APART_INEXACT: f64 = 1e-22;

/// A gap in f64 that is no error of such steps, which are below 1e-9, though it is found in no more digits.
pub const COARSE: f64 = 1e-4;

/// A gap in 40 digits that changes by more than this part when the point is refined further is one of the point.
pub const STEADY: f64 = 1e-3;

/// How well the paper's own motion (9) to (12) is met at a point before the maps of `model/` are asked.
pub const MOTION: f64 = 1e-11;

/// The most digits said of an f64 comparison: half a rounding.
pub const MOST_DIGITS: f64 = 16.0;

/// A factor is 0 at a point where it is less than this part of its terms: many times the residual of a premise.
pub const VANISHING: f64 = 1e-9;

/// In 40 digits a difference between sides that is not greater may be what rounding leaves of 0, or its root: points and
/// their values are not small in themselves.
pub const ROUNDED_AWAY: f64 = 1e-18;
