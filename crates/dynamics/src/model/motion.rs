//! The non-dimensional parameters of a motion.

use super::forcing::{Forcing, ForcingError};
use numbers::Analytic;
use std::fmt;
use std::sync::Arc;

/// A wall of the capsule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// Z = +d/2, where impacts have positive velocity.
    Bottom,
    /// Z = -d/2, where impacts have negative velocity.
    Top,
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Bottom => "bottom",
            Self::Top => "top",
        })
    }
}

impl Side {
    /// The other wall.
    pub fn opposite(self) -> Self {
        match self {
            Self::Bottom => Self::Top,
            Self::Top => Self::Bottom,
        }
    }

    /// The sign of Z at the wall, and of the velocity towards it.
    pub fn sign(self) -> f64 {
        match self {
            Self::Bottom => 1.0,
            Self::Top => -1.0,
        }
    }

    /// `value` for the bottom, `-value` for the top.
    pub fn signed<T: Analytic>(self, value: T) -> T {
        match self {
            Self::Bottom => value,
            Self::Top => -value,
        }
    }
}

/// A parameter that no motion can have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// The gravity component is NaN or infinite.
    #[error("g is {found}, must be a finite number")]
    Gravity {
        /// What was given.
        found: f64,
    },
    /// The period of the forcing is not 2.
    #[error("the period of the forcing is {found}, must be 2, which is the unit of time")]
    Period {
        /// What was given.
        found: f64,
    },
    /// A forcing that is none.
    #[error(transparent)]
    Forcing(#[from] ForcingError),
    /// The gap is not positive.
    #[error("d is {found}, must be finite and above 0")]
    Gap {
        /// What was given.
        found: f64,
    },
    /// There is no wall at the top.
    #[error("there is one wall, the bottom: no impact at the top and no gap")]
    NoTop,
    /// A restitution is outside [0, 1].
    #[error("{name} is {found}, must be from 0 to 1")]
    Restitution {
        /// `r_b` or `r_t`.
        name: &'static str,
        /// What was given.
        found: f64,
    },
}

/// What fixes the motion: gravity along the capsule, gap, restitutions and forcing.
///
/// Two walls and the forcing cos(pi t) of the paper, unless [`Motion::one_wall`] or [`Motion::with_forcing`] says
/// otherwise. Units: time 2 is the period of the forcing, lengths and velocities as [`Scales`](super::Scales) says.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion<T> {
    g: T,
    d: T,
    r_b: T,
    r_t: T,
    has_top: bool,
    /// Where it is not the paper's.
    forcing: Option<Arc<Forcing<T>>>,
}

impl<T: Analytic> Motion<T> {
    /// A motion with gravity `g` (any finite number), gap `d` > 0, restitutions `r_b`, `r_t` in [0, 1]: 0 is a plastic
    /// impact, after which the ball rests until f + g pulls it off.
    ///
    /// # Errors
    /// What is out of range or NaN, by name.
    pub fn new(g: T, d: T, r_b: T, r_t: T) -> Result<Self, MotionError> {
        let found = g.to_f64();
        if !found.is_finite() {
            return Err(MotionError::Gravity { found });
        }
        let found = d.to_f64();
        if !(found > 0.0 && found.is_finite()) {
            return Err(MotionError::Gap { found });
        }
        for (name, r) in [("r_b", &r_b), ("r_t", &r_t)] {
            let found = r.to_f64();
            // 1 - r as well: a wide r just above 1 rounds to 1 in f64
            let room = (T::one() - r.clone()).to_f64();
            if !(found >= 0.0 && room >= 0.0) {
                return Err(MotionError::Restitution { name, found });
            }
        }
        Ok(Self {
            g,
            d,
            r_b,
            r_t,
            has_top: true,
            forcing: None,
        })
    }

    /// A ball on a shaken table: the bottom alone, with gravity `g` and restitution `r`. The wall is at Z = 0, and `d`
    /// is 0.
    ///
    /// # Errors
    /// What is out of range or NaN, by name.
    pub fn one_wall(g: T, r: T) -> Result<Self, MotionError> {
        let motion = Self::new(g, T::one(), r, T::zero())?;
        Ok(Self {
            d: T::zero(),
            has_top: false,
            ..motion
        })
    }

    /// The same under another forcing.
    ///
    /// # Errors
    /// A period other than 2: the unit of time is half of it.
    pub fn with_forcing(self, forcing: Forcing<T>) -> Result<Self, MotionError> {
        let found = forcing.period().to_f64();
        if found != 2.0 {
            return Err(MotionError::Period { found });
        }
        Ok(Self {
            forcing: Some(Arc::new(forcing)),
            ..self
        })
    }

    /// The forcing, of period 2.
    pub fn forcing(&self) -> Forcing<T> {
        match &self.forcing {
            None => Forcing::harmonic(&T::zero()),
            Some(forcing) => (**forcing).clone(),
        }
    }

    /// The forcing where it is not the cos(pi t) of the paper.
    pub fn other_forcing(&self) -> Option<&Forcing<T>> {
        self.forcing.as_deref()
    }

    /// f + g at a phase of the forcing, pi t.
    pub fn push(&self, phase: &T) -> T {
        let Some(forcing) = &self.forcing else {
            return phase.sincos().1 + self.g.clone();
        };
        forcing.harmonics().fold(self.g.clone(), |sum, (order, cosine, sine)| {
            let (sin, cos) = (T::from_integer(order) * phase.clone()).sincos();
            sum + (cosine.clone() * cos + sine.clone() * sin)
        })
    }

    /// [`Motion::other_forcing`], shared.
    pub(crate) fn shared_forcing(&self) -> Option<Arc<Forcing<T>>> {
        self.forcing.clone()
    }

    /// Returns true if there is a wall at the top.
    pub fn has_top(&self) -> bool {
        self.has_top
    }

    /// M g0 sin(beta) / A: gravity along the capsule in units of the forcing.
    pub fn g(&self) -> &T {
        &self.g
    }

    /// The gap between the walls; 0 where there is one wall, which is then at Z = 0.
    pub fn d(&self) -> &T {
        &self.d
    }

    /// The restitution of a wall.
    pub fn restitution(&self, side: Side) -> &T {
        match side {
            Side::Bottom => &self.r_b,
            Side::Top => &self.r_t,
        }
    }

    /// The same motion over another number, each parameter through `convert`.
    ///
    /// # Errors
    /// As [`Motion::new`], where a narrower number rounds a parameter out of its range.
    pub fn convert<U: Analytic>(&self, convert: impl Fn(&T) -> U) -> Result<Motion<U>, MotionError> {
        let [g, d, r_b, r_t] = [&self.g, &self.d, &self.r_b, &self.r_t].map(&convert);
        let motion = match self.has_top {
            true => Motion::new(g, d, r_b, r_t)?,
            false => Motion::one_wall(g, r_b)?,
        };
        Ok(Motion {
            forcing: self.forcing.as_ref().map(|forcing| Arc::new(forcing.convert(&convert))),
            ..motion
        })
    }

    /// The motion seen upside down: walls exchanged, gravity reversed. Its flights, half a period later (phase + pi), are
    /// the mirror images of this one's. `None` of a motion without a top.
    pub fn mirrored(&self) -> Option<Self> {
        let forcing = self.forcing.as_ref();
        self.has_top.then(|| Self {
            has_top: true,
            forcing: forcing.map(|forcing| Arc::new(forcing.mirrored())),
            g: -self.g.clone(),
            d: self.d.clone(),
            r_b: self.r_t.clone(),
            r_t: self.r_b.clone(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use numbers::Wide;

    #[test]
    fn what_physics_allows_is_a_motion() {
        for (g, d, r) in [(-2.0, 1e-9, 1.0), (0.0, 1e9, 1e-9), (1.1, 1.57, 0.8), (0.1, 0.3, 0.0)] {
            let motion = Motion::new(g, d, r, r).map(|motion| (*motion.g(), *motion.d()));
            assert_eq!(motion, Ok((g, d)));
        }
    }

    #[test]
    fn what_is_out_of_range_is_named() {
        let error = |g, d, r_b, r_t| Motion::new(g, d, r_b, r_t).err().map(|error| error.to_string());
        let says = |text: &str| Some(text.to_string());
        assert_eq!(
            error(f64::NAN, 0.3, 0.5, 0.5),
            says("g is NaN, must be a finite number")
        );
        assert_eq!(error(0.1, 0.0, 0.5, 0.5), says("d is 0, must be finite and above 0"));
        assert!(error(0.1, f64::NAN, 0.5, 0.5).is_some() && error(0.1, f64::INFINITY, 0.5, 0.5).is_some());
        assert_eq!(error(0.1, 0.3, -0.1, 0.5), says("r_b is -0.1, must be from 0 to 1"));
        assert_eq!(error(0.1, 0.3, 0.5, 1.5), says("r_t is 1.5, must be from 0 to 1"));
        assert!(error(0.1, 0.3, 0.5, f64::NAN).is_some());
    }

    #[test]
    fn a_restitution_above_one_by_thirty_digits_is_still_above_one() {
        let number = Wide::<40>::from_f64;
        let above = number(1.0) + number(1e-30);
        assert!(Motion::new(number(0.1), number(0.3), above, number(0.5)).is_err());
    }

    #[test]
    fn the_mirror_image_of_the_mirror_image_is_the_motion() {
        let forcing = Forcing::periodic(2.0, &[1.0, 0.3, -0.2], &[0.1, 0.4]).expect("a forcing");
        let motion = Motion::new(0.1, 0.3, 0.6, 0.2).expect("a motion");
        for motion in [motion.clone(), motion.with_forcing(forcing).expect("of period 2")] {
            let image = motion.mirrored().expect("two walls");
            assert_eq!(image.mirrored().as_ref(), Some(&motion));
            for t in [0.1_f64, 0.7, 1.6] {
                let later = image.forcing().at(&(t + 1.0));
                assert!((later.f + motion.forcing().at(&t).f).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn one_wall_is_at_0_and_has_no_mirror_image() {
        let table = Motion::one_wall(0.2, 0.5).expect("a motion");
        assert_eq!((*table.d(), table.has_top(), table.mirrored()), (0.0, false, None));
        assert_eq!(table.convert(|value| *value), Ok(table.clone()));
        assert!(Motion::one_wall(f64::NAN, 0.5).is_err() && Motion::one_wall(0.2, 1.5).is_err());
    }

    #[test]
    fn a_forcing_of_another_period_is_refused() {
        let forcing = Forcing::periodic(1.7, &[1.0], &[]).expect("a forcing");
        let motion = Motion::new(0.1, 0.3, 0.6, 0.2).expect("a motion");
        assert_eq!(
            motion.with_forcing(forcing).err(),
            Some(MotionError::Period { found: 1.7 })
        );
    }
}
