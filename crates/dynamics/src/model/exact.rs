//! Values and motions that are known exactly, over any number.

use super::motion::{Motion, MotionError};
use numbers::{Analytic, Rational};

/// The parameters of one motion, over any number: enclosed by intervals, to many digits, as f64.
pub trait Parameters {
    /// The motion over `T`, each parameter rounded or enclosed as `T` does.
    ///
    /// # Errors
    /// A parameter out of its range.
    fn motion<T: Analytic>(&self) -> Result<Motion<T>, MotionError>;
}

impl<P: Parameters> Parameters for &P {
    fn motion<T: Analytic>(&self) -> Result<Motion<T>, MotionError> {
        (*self).motion()
    }
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
