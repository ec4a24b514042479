//! An energy diagram: the voltage of each impact, and its mean.

use super::claim::{self, Claim};
use super::diagram::{BOTTOM, TOP};
use super::parameter::Parameter;
use crate::report::plot::{Axis, Colour, Dash, Panel, Point, Series, Stroke};

/// All that an energy diagram shows, in volts.
#[derive(Clone, Debug, PartialEq)]
pub struct Energy {
    pub parameter: Parameter,
    /// Of each impact at the bottom: the parameter and the voltage.
    pub bottom: Vec<Point>,
    /// Of each impact at the top.
    pub top: Vec<Point>,
    /// The mean voltage at each value; NaN where there is none.
    pub mean: Vec<Point>,
}

/// Volts are shown in thousands.
pub(super) const LABEL: &str = "output voltage  [kV]";

pub(super) fn in_thousands(points: &[Point]) -> Vec<Point> {
    points.iter().map(|(x, volts)| (*x, volts / 1000.0)).collect()
}

impl Energy {
    /// The panel, with what is printed of it, also in volts.
    pub fn panel(&self, claims: &[Claim]) -> Panel {
        let mut panel = Panel::new(self.parameter.axis(), Axis::new(LABEL));
        panel.heading = "Output voltage".to_owned();
        let mean = Stroke {
            colour: Colour::Black,
            dash: Dash::Solid,
            width: 2.0,
        };
        panel.series = vec![
            Series::dots("bottom impacts, U\u{2096}", in_thousands(&self.bottom), BOTTOM),
            Series::dots("top impacts, U\u{2096}", in_thousands(&self.top), TOP),
            Series::line("mean voltage", in_thousands(&self.mean), mean),
        ];
        let claims: Vec<Claim> = claims
            .iter()
            .map(|claim| Claim {
                at: (claim.at.0, claim.at.1 / 1000.0),
                printed: format!("{} V", claim.printed),
                ..claim.clone()
            })
            .collect();
        panel.series.extend(claim::series(&claims));
        panel
    }
}
