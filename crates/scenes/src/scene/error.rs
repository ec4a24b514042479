//! Why a scene cannot be used: what, where, and what is allowed.

use super::{Over, Want};
use dynamics::model::{DeviceError, MembraneError, MotionError};
use std::fmt;
use texmath::Place;

/// Where a value was given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// In the file.
    File(Place),
    /// On the command line, as `--set` with this argument.
    Set(String),
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(place) => place.fmt(f),
            Self::Set(argument) => write!(f, "--set {argument}"),
        }
    }
}

/// A scene that cannot be used.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneError {
    /// The file as the user gave it, `stdin`, or the name of a built-in scene.
    pub name: String,
    /// Where in it, where there is such a place.
    pub origin: Option<Origin>,
    /// What is wrong.
    pub problem: Box<SceneProblem>,
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.name)?;
        if let Some(origin) = &self.origin {
            write!(f, "{origin}: ")?;
        }
        self.problem.fmt(f)
    }
}

impl std::error::Error for SceneError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&*self.problem)
    }
}

/// What is wrong with a scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneProblem {
    /// Not TOML.
    #[error("{0}")]
    Syntax(String),
    /// A name that means nothing.
    #[error("there is no {what} {found}; {instead}")]
    Unknown {
        /// `key` or `section`.
        what: &'static str,
        /// As it was given.
        found: String,
        /// What was probably meant, and what there is.
        instead: String,
    },
    /// A value out of range or of the wrong kind.
    #[error("{key} is {found}, must be {allowed}")]
    Value {
        /// The key with its section.
        key: String,
        /// As it was given.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// A key that is required.
    #[error("{}{key} ({meaning}){where_to}", .by.map_or("missing: ".to_string(), |want| format!("`{want}` requires ")))]
    Missing {
        /// What requires it.
        by: Option<Want>,
        /// The key with its section.
        key: String,
        /// What it is.
        meaning: String,
        /// Whether its section is there.
        where_to: String,
    },
    /// Gravity both ways.
    #[error(
        "g is given twice, by motion.g and by [device]; leave one of them out, or change device.incline instead of motion.g"
    )]
    TwoGravities,
    /// An override that is none.
    #[error("write key=value, as in --set motion.d=0.3{0}")]
    Override(String),
    /// Under `--strict`: a key that nothing requires.
    #[error("nothing that is asked for requires {0}; leave it out, or do without --strict")]
    Unneeded(String),
    /// A value of the swept parameter that is none.
    #[error("{over} cannot be {found} in a sweep")]
    Swept {
        /// What is swept.
        over: Over,
        /// Its value.
        found: String,
    },
    /// The parameters give no motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The device has no scales.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The membrane is none.
    #[error(transparent)]
    Membrane(#[from] MembraneError),
}
