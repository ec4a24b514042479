//! The parameters and the start of a scene's motion as typed, over any number: at one value, or along a sweep.

use super::error::SceneError;
use super::harmonics::{Harmonics, driven};
use super::key;
use super::sweep::Over;
use super::{Quantity, Scene};
use dynamics::model::{Exact, Motion, MotionError, Parameters, gravity_component};
use dynamics::orbit::Family;
use numbers::Analytic;
use std::cmp::Ordering;

/// Gravity along the capsule, as typed; `None` where that key is swept.
// One a scene: its size is nothing.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Debug, PartialEq)]
enum Gravity<Q> {
    /// `motion.g`
    Component(Option<Q>),
    /// `[device]`
    Device {
        capsule_mass: Q,
        forcing_amplitude: Option<Q>,
        incline: Option<Q>,
        gravity: Q,
    },
}

/// All that a motion needs, checked; what is swept is left open. As typed, or over one number for a whole sweep
/// ([`Setting::over_number`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Setting<Q = Quantity> {
    gravity: Gravity<Q>,
    d: Option<Q>,
    r_b: Option<Q>,
    r_t: Option<Q>,
    has_top: bool,
    /// Where it is not the paper's.
    harmonics: Option<Harmonics<Q>>,
}

impl Scene {
    /// The parameters of the motion, without a sweep.
    ///
    /// # Errors
    /// As [`Scene::motion`].
    pub fn setting(&self) -> Result<Setting, SceneError> {
        self.motion::<f64>()?;
        self.setting_without(&[])
    }

    /// The parameters of the motion along the scene's sweep.
    ///
    /// # Errors
    /// As [`Scene::sweep`] and [`Scene::motion`].
    pub fn swept_setting(&self) -> Result<Setting, SceneError> {
        let sweep = self.sweep()?;
        for end in [&sweep.from, &sweep.to] {
            self.swept::<f64>(sweep.over, end)?;
        }
        self.setting_without(&[sweep.over])
    }

    /// The parameters of the motion, what is swept left open.
    pub(super) fn setting_without(&self, swept: &[Over]) -> Result<Setting, SceneError> {
        let keys = self.motion_keys(swept);
        let open = |key: &'static key::Key| keys.contains(&key).then(|| self.number(key)).transpose();
        let gravity = if keys.contains(&&key::GRAVITY) {
            Gravity::Device {
                capsule_mass: self.number(&key::CAPSULE_MASS)?,
                forcing_amplitude: open(&key::FORCING_AMPLITUDE)?,
                incline: open(&key::INCLINE)?,
                gravity: self.number(&key::GRAVITY)?,
            }
        } else {
            Gravity::Component(open(&key::G)?)
        };
        Ok(Setting {
            gravity,
            d: open(&key::D)?,
            r_b: open(&key::R_B)?,
            r_t: open(&key::R_T)?,
            has_top: self.has_top()?,
            harmonics: self.harmonics()?,
        })
    }
}

impl<Q: Clone> Setting<Q> {
    /// The same with a value for one parameter that is left open.
    pub(super) fn with(mut self, over: Over, value: &Q) -> Self {
        if over == Over::R {
            return self.with(Over::RB, value).with(Over::RT, value);
        }
        let place = match (over, &mut self.gravity) {
            (Over::D, _) => &mut self.d,
            (Over::RB, _) => &mut self.r_b,
            (Over::RT, _) => &mut self.r_t,
            (Over::G, Gravity::Component(g)) => g,
            (Over::Incline, Gravity::Device { incline, .. }) => incline,
            (Over::ForcingAmplitude, Gravity::Device { forcing_amplitude, .. }) => forcing_amplitude,
            // both walls above; not read where g is given
            (Over::R | Over::G | Over::Incline | Over::ForcingAmplitude, _) => return self,
        };
        *place = Some(value.clone());
        self
    }
}

impl Setting {
    /// The same over `T`: what is typed is rounded or enclosed once, not at each value of a sweep.
    pub fn over_number<T: Analytic>(&self) -> Setting<T> {
        let value = |typed: &Option<Quantity>| typed.as_ref().map(Quantity::value);
        let gravity = match &self.gravity {
            Gravity::Component(g) => Gravity::Component(value(g)),
            Gravity::Device {
                capsule_mass,
                forcing_amplitude,
                incline,
                gravity,
            } => Gravity::Device {
                capsule_mass: capsule_mass.value(),
                forcing_amplitude: value(forcing_amplitude),
                incline: value(incline),
                gravity: gravity.value(),
            },
        };
        Setting {
            gravity,
            d: value(&self.d),
            r_b: value(&self.r_b),
            r_t: value(&self.r_t),
            has_top: self.has_top,
            harmonics: self.harmonics.as_ref().map(Harmonics::over_number),
        }
    }

    fn is_weightless(&self) -> bool {
        let is_zero = |typed: &Quantity| typed.sign() == Ordering::Equal;
        match &self.gravity {
            Gravity::Component(g) => g.as_ref().is_some_and(is_zero),
            Gravity::Device { incline, gravity, .. } => is_zero(gravity) || incline.as_ref().is_some_and(is_zero),
        }
    }
}

impl<T: Analytic> Setting<T> {
    /// The motion with `swept` for what is left open.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn at(&self, swept: &T) -> Result<Motion<T>, MotionError> {
        let or_swept = |value: &Option<T>| value.as_ref().unwrap_or(swept).clone();
        let g = match &self.gravity {
            Gravity::Component(g) => or_swept(g),
            Gravity::Device {
                capsule_mass,
                forcing_amplitude,
                incline,
                gravity,
            } => gravity_component(
                capsule_mass.clone(),
                or_swept(forcing_amplitude),
                &or_swept(incline),
                gravity.clone(),
            ),
        };
        let motion = match self.has_top {
            true => Motion::new(g, or_swept(&self.d), or_swept(&self.r_b), or_swept(&self.r_t)),
            false => Motion::one_wall(g, or_swept(&self.r_b)),
        };
        driven(motion?, self.harmonics.clone())
    }
}

impl Exact for Quantity {
    fn value<T: Analytic>(&self) -> T {
        Self::value(self)
    }
}

impl Parameters for Setting {
    /// Nothing is left open where the setting came from [`Scene::setting`]; else what is swept is 0.
    fn motion<T: Analytic>(&self) -> Result<Motion<T>, MotionError> {
        self.over_number().at(&T::zero())
    }
}

impl Family for Setting {
    fn motion_at<T: Analytic>(&self, parameter: &T) -> Result<Motion<T>, MotionError> {
        self.over_number().at(parameter)
    }

    fn is_symmetric(&self) -> bool {
        if !self.has_top || self.harmonics.as_ref().is_some_and(|harmonics| !harmonics.is_odd()) {
            return false;
        }
        // what is left open has one value
        let is_one = |r: &Quantity| r.compared_with_one() == Ordering::Equal;
        // the cosine of the paper is its own reversal too
        let is_reversed = self.harmonics.is_none() && self.r_b.as_ref().is_some_and(is_one);
        self.r_b == self.r_t && (self.is_weightless() || is_reversed)
    }
}

/// A setting at one value of what is swept, as typed.
#[derive(Clone, Copy, Debug)]
pub(super) struct At<'a> {
    pub setting: &'a Setting,
    pub value: &'a Quantity,
}

impl Parameters for At<'_> {
    fn motion<T: Analytic>(&self) -> Result<Motion<T>, MotionError> {
        self.setting.over_number().at(&self.value.value())
    }
}
