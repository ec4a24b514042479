//! A phase portrait: velocity over place, between the walls.

use super::claim::{self, Claim};
use crate::report::plot::{Axis, Colour, Dash, Marker, Panel, Point, Series, Shape, Stroke};

/// One flight after the other: what a trajectory is sampled to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    pub times: Vec<f64>,
    /// Z
    pub places: Vec<f64>,
    /// Zdot; just before an impact where there is one.
    pub velocities: Vec<f64>,
    /// X, the middle of the capsule.
    pub capsule: Vec<f64>,
    /// x, the ball.
    pub ball: Vec<f64>,
}

/// All that a phase portrait shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Portrait {
    /// The distance of the walls.
    pub gap: f64,
    /// The lines between the impacts, each (Z, Zdot).
    pub flights: Vec<Vec<Point>>,
    /// Zdot before and after each impact, and where.
    pub impacts: Vec<(f64, f64, f64)>,
}

impl Portrait {
    /// The panel, with what is printed of it: at (Z, Zdot).
    pub fn panel(&self, claims: &[Claim]) -> Panel {
        let half = self.gap / 2.0;
        let (reach, far) = (1.12 * half, 2.0 * half);
        let mut panel = Panel::new(
            Axis::over(
                "relative displacement, $Z$  [$A\u{3c0}\u{b2}/(M\u{3c9}\u{b2})$]",
                (-reach, reach),
            ),
            Axis::new("relative velocity, $\u{17b}$  [$A\u{3c0}/(M\u{3c9})$]"),
        );
        panel.heading = "Phase portrait".to_owned();
        let stroke = |colour, dash, width| Stroke { colour, dash, width };
        let joined = |lines: Vec<Vec<Point>>| -> Vec<Point> {
            let apart = lines.into_iter().map(|mut line| {
                line.push((f64::NAN, f64::NAN));
                line
            });
            apart.flatten().collect()
        };
        let jumps = self
            .impacts
            .iter()
            .map(|&(z, before, after)| vec![(z, before), (z, after)]);
        let before = |is_bottom: bool| -> Vec<Point> {
            let own = self.impacts.iter().filter(|(z, ..)| (*z > 0.0) == is_bottom);
            own.map(|&(z, before, _)| (z, before)).collect()
        };
        let sized = |marker: Marker| Marker { size: 6.0, ..marker };
        panel.series = vec![
            Series {
                name: "walls: top $\u{2212}d/2$, bottom $+d/2$".to_owned(),
                shape: Shape::Bands {
                    spans: vec![(-far, -half), (half, far)],
                    colour: Colour::Grey,
                },
            },
            Series::verticals("", vec![-half, half], stroke(Colour::Black, Dash::Solid, 1.0)),
            Series::line(
                "flight between impacts",
                joined(self.flights.clone()),
                stroke(Colour::Blue, Dash::Solid, 1.5),
            ),
            Series::line(
                "jump at an impact",
                joined(jumps.collect()),
                stroke(Colour::Vermillion, Dash::Dashed, 2.2),
            ),
            Series::dots(
                "before a bottom impact",
                before(true),
                sized(Marker {
                    colour: Colour::Black,
                    ..super::diagram::BOTTOM
                }),
            ),
            Series::dots(
                "before a top impact",
                before(false),
                sized(Marker {
                    colour: Colour::Black,
                    ..super::diagram::TOP
                }),
            ),
        ];
        panel.series.extend(claim::series(claims));
        panel
    }
}
