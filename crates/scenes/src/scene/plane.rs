//! The two parameters of `[branch]`, and the motions over them.

use super::key::{self, ExtentKeys};
use super::setting::Setting;
use super::sweep::{Extent, Over};
use super::{Quantity, Scene, SceneError};
use dynamics::model::{Motion, MotionError};
use dynamics::orbit::{Family, ParameterPlane};
use numbers::{Analytic, Interval};

/// Into how many parts the lines on which curves are looked for divide each side, where the scene does not say.
const LINES: u32 = 8;

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

impl Scene {
    /// The two parameters of `[branch]`, and the motions there.
    ///
    /// # Errors
    /// A key of `[branch]` that is lacking or out of its range, x and y that are one parameter or of which one leaves the
    /// other unread, a range of one value.
    pub fn plane(&self) -> Result<Plane, SceneError> {
        let [x, y] = [self.extent(ExtentKeys::X)?, self.extent(ExtentKeys::Y)?];
        for (keys, Extent { from, to, .. }) in [(ExtentKeys::X, &x), (ExtentKeys::Y, &y)] {
            if from == to {
                let allowed = format!("other than {}", keys.from.path());
                return Err(self.wrong(keys.to, self.require(keys.to, None)?, allowed));
            }
        }
        self.check_pair(
            ExtentKeys::Y.over,
            (x.over, [&x.from, &x.to]),
            (y.over, [&y.from, &y.to]),
        )?;
        let setting = self.setting_without(&[x.over, y.over])?;
        Ok(Plane {
            setting,
            x,
            y,
            lines: self.count_or(&key::LINES, LINES)?,
        })
    }
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
