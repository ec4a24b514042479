//! Periodic motions: all 1-1 motions of a scene, motions of general words, their stability, clearance and bifurcations.
//!
//! Every value of an [`Orbit`] is an enclosure. The forcing is the paper's cos(pi t), of phase 0 at t = 0. Uses
//! `number/`, `model/` and, for what a simulated motion comes to, `impact/`.

mod along;
mod arc;
mod attractor;
mod balance;
mod bifurcation;
mod branch;
mod cell;
mod certify;
mod chord;
mod clearance;
mod confirm;
mod cover;
mod curve;
mod cycle;
mod equations;
mod event;
mod family;
mod find;
mod follow;
mod gauge;
mod happening;
mod instant;
mod isolate;
mod leap;
mod letter;
mod lyapunov;
mod mark;
mod moment;
mod nearest;
mod newton;
mod one_to_one;
// the folder holds periodic motions, the file one of them
#[allow(clippy::module_inception)]
mod orbit;
mod parallel;
mod refine;
mod repeat;
mod returning;
mod root;
mod rounded;
mod settled;
mod slopes;
mod stability;
mod strand;
mod system;
mod triple;
mod unsettled;
mod wanted;
mod word;

pub use crate::model::{Exact, Parameters};
pub use attractor::{Attractor, LONGEST_WORD, SETTLED};
pub use balance::Balance;
pub use bifurcation::{Bifurcations, CROSSING, Located, bifurcations};
pub use branch::{OpenEvent, Prepared};
pub use cell::Cell;
pub use clearance::Path;
pub use confirm::{confirmed, confirmed_at};
pub use cover::{Cover, CoverError};
pub use cycle::{Cycle, search, search_from};
pub use equations::{Conditioned, Symmetric, Touching};
pub use event::{Condition, Event, Touch};
pub use family::{Family, Fixed};
pub use find::{Found, Open, Proved, find, find_as};
pub use follow::Followed;
pub use instant::{Enclosed, Instant, narrowed};
pub use isolate::{Isolation, Limits, isolate};
pub use leap::{Leap, Slopes, System};
pub use lyapunov::lyapunov;
pub use moment::Moment;
pub use nearest::{nearest, nearest_event};
pub use one_to_one::{Equations, Search, one_to_one};
pub use orbit::{Fix, Orbit, links};
pub use refine::refined;
pub use returning::{NoReturn, Returning, returning, returning_at};
pub use root::{Root, prove, sharpen};
pub use rounded::Rounded;
pub use settled::Settled;
pub use stability::{Kind, Link, Multiplier, determinant, loss_factor, multipliers, trace};
pub use system::Decision;
pub use triple::{Sixteen, Slopes as TripleSlopes, Triple};
pub use unsettled::{Question, Unsettled};
pub use wanted::{Goal, Wanted, most_figures};
pub use word::{Word, WordError};
