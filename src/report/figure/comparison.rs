//! Mean voltages side by side.

use super::claim::{self, Claim};
use super::energy::{ALONE, LABEL, alone, in_thousands, parted};
use super::parameter::Parameter;
use crate::report::plot::{Axis, Colour, Dash, Form, Marker, Panel, Point, Series, Shape, Stroke};

/// The mean voltage of one device over the parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    pub name: String,
    /// Curves of one group have one colour and one form.
    pub group: usize,
    /// The first of a group is solid, the others are dashed.
    pub member: usize,
    /// Parameter and volts; NaN where there is no mean.
    pub mean: Vec<Point>,
}

const COLOURS: [Colour; 6] = [
    Colour::Black,
    Colour::Vermillion,
    Colour::Purple,
    Colour::Blue,
    Colour::Green,
    Colour::Orange,
];
const FORMS: [Form; 6] = [
    Form::Circle,
    Form::Square,
    Form::Triangle,
    Form::Diamond,
    Form::Wedge,
    Form::Plus,
];
const DASHES: [Dash; 3] = [Dash::Solid, Dash::Dashed, Dash::DashDot];

/// How many forms stand along a curve.
const FORMS_ALONG: usize = 8;

/// The curves in one panel, with what is printed of them, in volts.
pub fn comparison(parameter: &Parameter, curves: &[Curve], claims: &[Claim]) -> Panel {
    let mut panel = Panel::new(parameter.axis(), Axis::new(format!("mean {LABEL}")));
    for curve in curves {
        let (colour, form) = (COLOURS[curve.group % COLOURS.len()], FORMS[curve.group % FORMS.len()]);
        let dash = DASHES[curve.member.min(DASHES.len() - 1)];
        let mean = in_thousands(&curve.mean);
        let every = (mean.len() / FORMS_ALONG).max(1);
        // forms of different curves would hide one another at the same values
        let first = every * (2 * curve.group + curve.member) / (2 * COLOURS.len());
        let marked = mean.iter().skip(first).step_by(every).copied().collect();
        let marker = Marker {
            filled: curve.member == 0,
            size: 6.5,
            ..Marker::open(colour, form)
        };
        let width = 1.6;
        let shape = Shape::Marked {
            points: parted(&mean),
            stroke: Stroke { colour, dash, width },
            marked,
            marker,
        };
        let name = curve.name.clone();
        panel.series.push(Series { name, shape });
        panel
            .series
            .push(Series::dots("", alone(&mean), Marker::dot(colour, ALONE)));
    }
    panel.series.extend(claim::series(&claim::in_kilovolts(claims)));
    panel
}
