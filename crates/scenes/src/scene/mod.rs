//! Scenes: what a person wants to know, of which device and motion.
//!
//! A [`Scene`] is a TOML file. What is wanted decides what is read: a section that
//! no [`Want`] requires is neither checked nor modelled. Numbers are kept exactly as typed ([`Quantity`]), so that a
//! scene can be evaluated over any number type.
//!
//! ```
//! use scenes::scene::{Scene, Want};
//!
//! let mut scene = Scene::read("motion = { g = 0.1, d = 0.26, r_b = 0.6, r_t = 0.3 }", "mine.toml")?;
//! scene.set("motion.d=0.3")?;
//! scene.check(&[Want::Orbits])?;
//! assert_eq!(scene.motion::<f64>()?.d(), &0.3);
//!
//! let error = scene.check(&[Want::Voltage]).unwrap_err();
//! assert!(error.to_string().starts_with("mine.toml: `voltage` requires membrane.ball_mass"), "{error}");
//! # Ok::<(), scenes::scene::SceneError>(())
//! ```

mod basins;
mod builtin;
mod choice;
mod described_keys;
mod document;
mod error;
mod explain;
mod following;
mod harmonics;
mod key;
mod need;
mod pace;
mod plane;
mod points;
mod quantity;
#[allow(clippy::module_inception)]
mod scene;
mod setting;
mod start;
mod sweep;
mod value;
mod want;

pub use basins::{BasinPoint, BasinPoints, ReachedAttractor, ReachedAttractors};
pub use builtin::{BUILT_IN, built_in, find};
pub use choice::{BoxChoice, LocalChoice};
pub use described_keys::{KeyDescription, described_keys};
pub use error::{Origin, SceneError, SceneProblem};
pub use following::{MeanOver, Means};
pub use key::{MOST_DIGITS, has_key, path_of_key};
pub use need::Note;
pub use plane::Plane;
pub use points::{MapPoint, MapPoints, Point, Points};
pub use quantity::{Quantity, QuantityError};
pub use scene::Scene;
pub use setting::Setting;
pub use start::Start;
pub use sweep::{Begin, Diagram, Extent, Map, MapWant, Over, Spaced, StartGrid, Sweep};
pub use want::Want;
