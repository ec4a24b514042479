//! An energy diagram: the voltage of each impact, and its mean.

use super::claim::{self, Claim};
use super::diagram::{BOTTOM, TOP};
use super::parameter::Parameter;
use crate::report::plot::{Axis, Colour, Dash, Marker, Panel, Point, Series, Stroke};

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

/// A change from one value to the next by more than this part of all changes is a jump.
const JUMP: f64 = 0.12;

/// A mean over the parameter, broken where it jumps: from one value to the next the motion is another, and nothing
/// lies between.
pub(super) fn parted(points: &[Point]) -> Vec<Point> {
    let finite = points.iter().map(|point| point.1).filter(|value| value.is_finite());
    let (low, high) = finite.fold((f64::MAX, f64::MIN), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    let mut parted: Vec<Point> = Vec::new();
    for point in points {
        let jumps = parted
            .last()
            .is_some_and(|last| (last.1 - point.1).abs() > JUMP * (high - low));
        if jumps {
            parted.push((f64::NAN, f64::NAN));
        }
        parted.push(*point);
    }
    parted
}

/// The values between two jumps, which are no line.
pub(super) fn alone(points: &[Point]) -> Vec<Point> {
    let parted = parted(points);
    let lines = parted.split(|point| point.1.is_nan());
    lines
        .filter(|line| line.len() == 1)
        .flat_map(|line| line.iter().copied())
        .collect()
}

/// How large such a value is drawn.
pub(super) const ALONE: f64 = 3.0;

impl Energy {
    /// The panel, with what is printed of it, also in volts.
    pub fn panel(&self, claims: &[Claim]) -> Panel {
        let mut panel = Panel::new(self.parameter.axis(), Axis::new(LABEL));
        panel.heading = "Voltage of the impacts".to_owned();
        let mean = Stroke {
            colour: Colour::Black,
            dash: Dash::Solid,
            width: 2.0,
        };
        panel.series = vec![
            Series::dots("simulated impacts, bottom", in_thousands(&self.bottom), BOTTOM),
            Series::dots("simulated impacts, top", in_thousands(&self.top), TOP),
            Series::line("mean voltage", parted(&in_thousands(&self.mean)), mean),
            Series::dots("", alone(&in_thousands(&self.mean)), Marker::dot(mean.colour, ALONE)),
        ];
        panel.series.extend(claim::series(&claim::in_kilovolts(claims)));
        panel
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_is_broken_where_it_jumps_and_nowhere_else() {
        let points = [
            (0.1, 10.0),
            (0.2, 10.5),
            (0.3, 20.0),
            (0.4, f64::NAN),
            (0.5, 20.0),
            (0.6, 20.1),
        ];
        let parted = parted(&points);
        let breaks: Vec<usize> = (0..parted.len()).filter(|&index| parted[index].0.is_nan()).collect();
        assert_eq!((parted.len(), breaks), (7, vec![2]));
        assert_eq!(alone(&points), [(0.3, 20.0)]);
    }
}
