//! Motions along one parameter, or over two, over any number.

use crate::model::{Exact, Motion, MotionError, Parameters, Side};
use numbers::{Analytic, Interval};

/// Motions along one swept parameter.
pub trait Family {
    /// The motion at a value of the parameter.
    ///
    /// # Errors
    /// A parameter out of its range.
    fn motion_at<T: Analytic>(&self, parameter: &T) -> Result<Motion<T>, MotionError>;

    /// Whether each motion is its own mirror image: r_B = r_T and g = 0; or, with r_B = r_T = 1, its own reversal;
    /// under the forcing cos(pi t).
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

/// Motions over a rectangle of two parameters.
pub trait ParameterPlane: Sync {
    /// The motions along a side of the rectangle, or a line beside it.
    type Line: Family + Sync;

    /// The motion at values of both parameters.
    ///
    /// # Errors
    /// A parameter out of its range.
    fn motion_at<T: Analytic>(&self, parameters: [&T; 2]) -> Result<Motion<T>, MotionError>;

    /// The ranges of both.
    fn ranges(&self) -> [Interval<f64>; 2];

    /// The motions along the other parameter where number `fixed`, 0 or 1, has value number `index`, from 0, of `count` + 1
    /// evenly spaced ones from end to end of its range; and that value.
    fn line(&self, fixed: usize, index: u32, count: u32) -> (Self::Line, f64);

    /// Whether each motion is its own mirror image, as in [`Family::is_symmetric`].
    fn is_symmetric(&self) -> bool;
}

impl<F: Family> Family for &F {
    fn motion_at<T: Analytic>(&self, parameter: &T) -> Result<Motion<T>, MotionError> {
        (**self).motion_at(parameter)
    }

    fn is_symmetric(&self) -> bool {
        (**self).is_symmetric()
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

/// The motions of a base one along its gap d, under its forcing. A motion with one wall has no gap.
impl Family for Motion<f64> {
    fn motion_at<T: Analytic>(&self, parameter: &T) -> Result<Motion<T>, MotionError> {
        if !self.has_top() {
            return Err(MotionError::NoTop);
        }
        let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| T::from_f64(*self.restitution(side)));
        let motion = Motion::new(T::from_f64(*self.g()), parameter.clone(), r_b, r_t)?;
        match self.other_forcing() {
            None => Ok(motion),
            Some(forcing) => motion.with_forcing(forcing.convert(|value| T::from_f64(*value))),
        }
    }

    fn is_symmetric(&self) -> bool {
        let [r_b, r_t] = [Side::Bottom, Side::Top].map(|side| *self.restitution(side));
        self.other_forcing().is_none() && r_b == r_t && (*self.g() == 0.0 || r_b == 1.0)
    }
}
