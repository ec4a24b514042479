//! The figures of a paper on vibro-impacts, as panels to be plotted, from numbers that any command may have computed.
//!
//! Colour tells what is meant, and so does a form: bottom impacts are circles and top impacts triangles; what is
//! stable is a solid line, what is not a dashed one, and what would pass through a wall a dotted one; a printed value
//! that is reproduced is a ring, one that is wrong a cross.

mod branch;
mod claim;
mod comparison;
mod curves;
mod diagram;
mod displacement;
mod energy;
mod extremes;
mod map;
mod optimum;
mod parameter;
mod portrait;
mod score;
mod step;
mod strand;
mod trade;

pub use branch::Bifurcation;
pub use claim::Claim;
pub use comparison::{Curve, comparison};
pub use curves::{BifurcationCurve, BifurcationCurves};
pub use diagram::{Diagram, Impact};
pub use displacement::displacement;
pub use energy::Energy;
pub use extremes::extremes;
pub use map::{HeatMap, Layer, UNDECIDED};
pub use optimum::{BestValue, Slice, slices};
pub use parameter::Parameter;
pub use portrait::{Path, Portrait};
pub use score::{digits, work_precision};
pub use step::{Course, Quantity, Step};
pub use trade::trades;
