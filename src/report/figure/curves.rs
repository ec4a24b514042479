//! Curves of bifurcations over two parameters, and the special points on them.

use super::parameter::Parameter;
use crate::orbit::{BifurcationKind, SpecialPoint};
use crate::report::plot::{Colour, Dash, Form, Mark, Marker, Panel, Point, Series, Stroke};

/// A curve, from point to point.
#[derive(Clone, Debug, PartialEq)]
pub struct BifurcationCurve {
    pub kind: BifurcationKind,
    /// Where, and whether the motion keeps between the walls.
    pub points: Vec<(Point, bool)>,
}

/// The curves over a rectangle of two parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct BifurcationCurves {
    pub x: Parameter,
    pub y: Parameter,
    pub curves: Vec<BifurcationCurve>,
    /// The points that have a name.
    pub special: Vec<(SpecialPoint, Point)>,
}

const KINDS: [(BifurcationKind, &str, Colour); 4] = [
    (BifurcationKind::PeriodDoubling, "period doubling", Colour::Blue),
    (BifurcationKind::Fold, "fold", Colour::Vermillion),
    (BifurcationKind::SymmetryBreaking, "symmetry breaking", Colour::Green),
    (BifurcationKind::Grazing, "grazing", Colour::Black),
];

const POINTS: [(SpecialPoint, &str, Form); 6] = [
    (SpecialPoint::Cusp, "cusp", Form::Wedge),
    (
        SpecialPoint::DegenerateFlip,
        "degenerate period doubling",
        Form::Diamond,
    ),
    (
        SpecialPoint::DegeneratePitchfork,
        "degenerate symmetry breaking",
        Form::Diamond,
    ),
    // there are the points of the other curve, too
    (SpecialPoint::Grazing, "grazing meets another curve", Form::Circle),
    (SpecialPoint::DoubleGrazing, "double grazing", Form::Square),
    (SpecialPoint::DegenerateGrazing, "grazing with $f + g = 0$", Form::Cross),
];

const WIDTH: f64 = 1.6;
const EDGED: f64 = 3.6;

impl BifurcationCurves {
    /// A panel of them alone.
    pub fn panel(&self) -> Panel {
        let mut panel = Panel::new(self.x.axis(), self.y.axis());
        panel.heading = "Curves on which motions bifurcate".to_owned();
        panel.series = self.series();
        panel
    }

    /// What is drawn of them, as in a panel over both parameters: dotted where the motion passes through a wall.
    pub fn series(&self) -> Vec<Series> {
        let mut series = Vec::new();
        for (kind, name, colour) in KINDS {
            for (admissible, dash) in [(true, Dash::Solid), (false, Dash::Dotted)] {
                let own = self.curves.iter().filter(|curve| curve.kind == kind);
                let points: Vec<Point> = own.flat_map(|curve| runs(&curve.points, admissible)).collect();
                if points.is_empty() {
                    continue;
                }
                let name = if admissible {
                    name.to_owned()
                } else {
                    format!("{name} of an unphysical motion (through a wall)")
                };
                // over cells of any colour a line is seen by its white edges
                let stroke = |colour, dash, width| Stroke { colour, dash, width };
                series.push(Series::line(
                    "",
                    points.clone(),
                    stroke(Colour::White, Dash::Solid, EDGED),
                ));
                series.push(Series::line(name, points, stroke(colour, dash, WIDTH)));
            }
        }
        for (point, name, form) in POINTS {
            let own = self.special.iter().filter(|(special, _)| *special == point);
            let marks: Vec<Mark> = own
                .map(|(_, at)| Mark {
                    at: *at,
                    label: String::new(),
                })
                .collect();
            if !marks.is_empty() {
                // seen over cells of any colour
                let [inside, edge] = [Marker::filled(Colour::White, form), Marker::open(Colour::Black, form)];
                series.push(Series::marks(
                    "",
                    marks.clone(),
                    Marker {
                        size: edge.size,
                        ..inside
                    },
                ));
                series.push(Series::marks(name, marks, edge));
            }
        }
        series
    }
}

/// The pieces of a curve between points of which the first is admissible or not, with breaks between them.
fn runs(points: &[(Point, bool)], admissible: bool) -> Vec<Point> {
    let mut run = Vec::new();
    for pair in points.windows(2) {
        // a change lies at a grazing, which is admissible itself
        if (pair[0].1 && pair[1].1) == admissible {
            if run.last() != Some(&pair[0].0) {
                run.push(pair[0].0);
            }
            run.push(pair[1].0);
        } else if run.last().is_some_and(|last: &Point| last.0.is_finite()) {
            run.push((f64::NAN, f64::NAN));
        }
    }
    if !run.is_empty() {
        run.push((f64::NAN, f64::NAN));
    }
    run
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::plot::Shape;

    #[test]
    fn a_curve_is_dotted_where_its_motion_cannot_be_and_has_no_gap() {
        let flags = [true, true, false, false];
        let points = flags
            .iter()
            .zip(0..)
            .map(|(flag, x)| ((f64::from(x), 1.0), *flag))
            .collect();
        let drawn = BifurcationCurves {
            x: Parameter::new("d", (0.0, 3.0)),
            y: Parameter::new("r_b", (0.0, 1.0)),
            curves: vec![BifurcationCurve {
                kind: BifurcationKind::Fold,
                points,
            }],
            special: vec![(SpecialPoint::Cusp, (1.0, 1.0)), (SpecialPoint::Step, (2.0, 1.0))],
        };
        let series = drawn.series();
        let series: Vec<Series> = series.into_iter().filter(|series| !series.name.is_empty()).collect();
        let names: Vec<&str> = series.iter().map(|series| series.name.as_str()).collect();
        assert_eq!(names, ["fold", "fold of an unphysical motion (through a wall)", "cusp"]);
        let xs = |series: &Series| match &series.shape {
            Shape::Line { points, .. } => points.iter().map(|point| point.0).filter(|x| x.is_finite()).collect(),
            _ => Vec::new(),
        };
        assert_eq!((xs(&series[0]), xs(&series[1])), (vec![0.0, 1.0], vec![1.0, 2.0, 3.0]));
    }
}
