//! Motions whose parameters are known exactly, over any number.

use crate::model::{Motion, MotionError, Side};
use crate::number::{Analytic, Rational};

/// The parameters of one motion, over any number: enclosed by intervals, to many digits, as f64.
pub trait Parameters {
    /// The motion over `T`, each parameter rounded or enclosed as `T` does.
    ///
    /// # Errors
    /// A parameter out of its range.
    fn motion<T: Analytic>(&self) -> Result<Motion<T>, MotionError>;
}

/// The numbers of an f64 motion, taken as exact.
impl Parameters for Motion<f64> {
    fn motion<T: Analytic>(&self) -> Result<Motion<T>, MotionError> {
        self.convert(|&parameter| T::from_f64(parameter))
    }
}

/// A value known exactly, over any number.
pub trait Exact {
    /// The value, rounded or enclosed as `T` does.
    fn value<T: Analytic>(&self) -> T;
}

impl Exact for f64 {
    fn value<T: Analytic>(&self) -> T {
        T::from_f64(*self)
    }
}

impl Exact for Rational {
    fn value<T: Analytic>(&self) -> T {
        // No field of numbers with more than one element and characteristic 0 has a denominator of 0.
        self.embed().unwrap_or_else(T::zero)
    }
}

/// Motions along one swept parameter.
pub trait Family {
    /// The motion at a value of the parameter.
    ///
    /// # Errors
    /// A parameter out of its range.
    fn motion_at<T: Analytic>(&self, parameter: &T) -> Result<Motion<T>, MotionError>;

    /// Whether each motion is its own mirror image: r_B = r_T and g = 0; or, with r_B = r_T = 1, its own reversal.
    /// Then motions with T_1 = T_2 are a branch of their own, and others part from it.
    fn is_symmetric(&self) -> bool;

    /// The parameters at one value.
    fn fixed<'a, V: Exact>(&'a self, value: &'a V) -> Fixed<'a, Self, V>
    where
        Self: Sized,
    {
        Fixed { family: self, value }
    }
}

/// A motion of a family, at an exact value of the parameter.
pub struct Fixed<'a, F, V> {
    family: &'a F,
    value: &'a V,
}

impl<F: Family, V: Exact> Parameters for Fixed<'_, F, V> {
    fn motion<T: Analytic>(&self) -> Result<Motion<T>, MotionError> {
        self.family.motion_at(&self.value.value::<T>())
    }
}

/// The motions of a base one along its gap d.
impl Family for Motion<f64> {
    fn motion_at<T: Analytic>(&self, parameter: &T) -> Result<Motion<T>, MotionError> {
        let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| T::from_f64(*self.restitution(side)));
        Motion::new(T::from_f64(*self.g()), parameter.clone(), r_b, r_t)
    }

    fn is_symmetric(&self) -> bool {
        let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| *self.restitution(side));
        r_b == r_t && (*self.g() == 0.0 || r_b == 1.0)
    }
}
