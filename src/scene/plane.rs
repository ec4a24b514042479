//! The two parameters of `[branch]`, and the motions over them.

use super::Quantity;
use super::setting::Setting;
use super::sweep::Over;
use crate::model::{Motion, MotionError};
use crate::number::{Analytic, Interval};
use crate::orbit::{Family, ParameterPlane};

/// Into how many parts the lines on which curves are looked for divide each side, where the scene does not say.
pub(super) const LINES: u32 = 8;

/// A parameter and the ends of its range, which may be in either order.
#[derive(Clone, Debug, PartialEq)]
pub struct Extent {
    /// The parameter.
    pub over: Over,
    /// One end.
    pub from: Quantity,
    /// The other end.
    pub to: Quantity,
}

/// The motions over the two parameters of `[branch]`, and where curves are looked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    pub(super) setting: Setting,
    /// The first parameter.
    pub x: Extent,
    /// The second parameter.
    pub y: Extent,
    /// Into how many parts the lines on which curves are looked for divide each side.
    pub lines: u32,
}

impl ParameterPlane for Plane {
    type Line = Setting;

    fn motion_at<T: Analytic>(&self, [x, y]: [&T; 2]) -> Result<Motion<T>, MotionError> {
        let setting = self.setting.over_number().with(self.x.over, x).with(self.y.over, y);
        setting.at(&T::zero())
    }

    fn ranges(&self) -> [Interval<f64>; 2] {
        [&self.x, &self.y].map(|Extent { from, to, .. }| {
            let [from, to] = [from, to].map(Quantity::value::<f64>);
            Interval::new(from.min(to), from.max(to))
        })
    }

    fn line(&self, fixed: usize, index: u32, count: u32) -> (Setting, f64) {
        let Extent { over, from, to } = if fixed == 0 { &self.x } else { &self.y };
        let value = from.towards(to, index, count);
        (self.setting.clone().with(*over, &value), value.value())
    }

    fn is_symmetric(&self) -> bool {
        // a restitution that is a parameter by itself is not that of the other wall
        ![self.x.over, self.y.over].contains(&Over::RB) && Family::is_symmetric(&self.setting)
    }
}
