//! The best device of a box, and what the devices around it are worth.

use super::map::{HeatMap, Layer};
use super::parameter::Parameter;
use crate::report::plot::{Axis, Colour, Dash, Form, Mark, Marker, Panel, Point, Series, Shape, Stroke};

/// Devices along one or two parameters of a box, the others being those of the best device.
#[derive(Clone, Debug)]
pub struct Slice {
    /// One parameter or two, with where the best device is in each.
    pub parameters: Vec<(Parameter, Option<BestValue>)>,
    /// How many values of each, evenly spaced between the ends.
    pub points: usize,
    /// The largest voltage of each device, row by row along the first parameter; NaN where it has no motion as asked.
    pub values: Vec<f64>,
    /// The parameters that do not vary.
    pub heading: String,
}

/// A parameter of the best device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BestValue {
    /// That of the device found.
    pub found: f64,
    /// Between which values it is proved to be.
    pub proved: (f64, f64),
}

impl BestValue {
    /// Whether where it is proved to be is seen beside the device found.
    fn is_seen(&self, parameter: &Parameter) -> bool {
        let ((from, to), (one, other)) = (self.proved, parameter.ends);
        to - from > SEEN * (other - one).abs()
    }
}

/// What the figure of an optimum calls things.
const NAME: &str = "voltage per forcing period";
const UNIT: &str = "kV";
const NOTHING: &str = "no stable motion as asked";
const PROVED: &str = "region proved to hold the best device";

const EDGE: Stroke = Stroke {
    colour: Colour::Vermillion,
    dash: Dash::Solid,
    width: 1.6,
};

/// What is longer than this part of an axis is seen beside a mark.
const SEEN: f64 = 0.02;

/// A panel for each slice, of one scale of colours; `best` is what the best device is called.
pub fn slices(slices: &[Slice], best: &str) -> Vec<Panel> {
    let all = slices.iter().flat_map(|slice| &slice.values);
    let finite = all.copied().filter(|value| value.is_finite());
    let ends = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    slices.iter().map(|slice| slice.panel(ends, best)).collect()
}

impl Slice {
    fn panel(&self, ends: (f64, f64), best: &str) -> Panel {
        let mut panel = match self.parameters.as_slice() {
            [(x, at)] => self.line(x, *at, best),
            [(x, at_x), (y, at_y), ..] => self.map([x, y], [*at_x, *at_y], ends, best),
            [] => Panel::new(Axis::new(""), Axis::new("")),
        };
        panel.heading.clone_from(&self.heading);
        panel
    }

    /// The voltage over the only parameter.
    fn line(&self, x: &Parameter, at: Option<BestValue>, best: &str) -> Panel {
        let (from, to) = x.ends;
        let last = (self.points.max(2) - 1) as f64;
        let points = self.values.iter().enumerate();
        let points: Vec<Point> = points
            .map(|(index, value)| (from + (to - from) * index as f64 / last, value / 1000.0))
            .collect();
        let mut panel = Panel::new(x.axis(), Axis::new(format!("{NAME}  [kV]")));
        if let Some(best_value) = at {
            if best_value.is_seen(x) {
                panel.series.push(Series {
                    name: PROVED.to_owned(),
                    shape: Shape::Bands {
                        spans: vec![best_value.proved],
                        colour: EDGE.colour,
                    },
                });
            }
            panel.series.push(Series::verticals(best, vec![best_value.found], EDGE));
        }
        let colour = Colour::Blue;
        // a point between two without a motion has no line
        panel
            .series
            .push(Series::dots("", points.clone(), Marker::dot(colour, 2.5)));
        panel.series.push(Series::line(NAME, points, Stroke { colour, ..EDGE }));
        panel
    }

    /// The voltage over two parameters, in colours.
    fn map(&self, [x, y]: [&Parameter; 2], at: [Option<BestValue>; 2], ends: (f64, f64), best: &str) -> Panel {
        let layer = Layer::Values {
            name: NAME.to_owned(),
            unit: UNIT.to_owned(),
            values: self.values.iter().map(|volts| volts / 1000.0).collect(),
            ends: Some((ends.0 / 1000.0, ends.1 / 1000.0)),
        };
        let map = HeatMap {
            x: x.clone(),
            y: y.clone(),
            points: [self.points, self.points],
            layers: Vec::new(),
            marks: (String::new(), Vec::new()),
        };
        let mut panel = map.panel(&layer);
        let nothing: Vec<bool> = self.values.iter().map(|value| value.is_nan()).collect();
        let corners = map.cells(&nothing);
        panel.series.push(Series {
            name: NOTHING.to_owned(),
            shape: Shape::Cells {
                corners,
                colour: Colour::LightGrey,
            },
        });
        if let [Some(at_x), Some(at_y)] = at {
            let ((left, right), (low, high)) = (at_x.proved, at_y.proved);
            // a smaller frame lies within the ring
            if at_x.is_seen(x) || at_y.is_seen(y) {
                let around = vec![(left, low), (right, low), (right, high), (left, high), (left, low)];
                panel.series.push(Series::line(PROVED, around, EDGE));
            }
            let mark = Mark {
                at: (at_x.found, at_y.found),
                label: String::new(),
            };
            let marker = Marker {
                size: 12.0,
                ..Marker::open(Colour::Black, Form::Circle)
            };
            panel.series.push(Series::marks(best, vec![mark], marker));
        }
        panel
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_device_has_a_colour_of_one_scale_and_the_best_one_a_mark() {
        let at = |found, proved| Some(BestValue { found, proved });
        let [d, r_b] = ["d", "r_b"].map(|name| Parameter::new(name, (0.0, 1.0)));
        let slice = |values: Vec<f64>| Slice {
            parameters: vec![(d.clone(), at(1.0, (0.9, 1.0))), (r_b.clone(), at(0.0, (0.0, 0.0)))],
            points: 2,
            values,
            heading: "r_t = 0.3".to_owned(),
        };
        let panels = slices(&[slice(vec![1e3, 9e3, f64::NAN, 3e3]), slice(vec![4e3; 4])], "best");
        for panel in &panels {
            let named = |name: &str| panel.series.iter().find(|series| series.name == name);
            let bar = panel.bar.as_ref().expect("a bar of colours");
            assert_eq!(
                (bar.label.as_str(), bar.ends),
                ("voltage per forcing period  [kV]", (1.0, 9.0))
            );
            assert!(named("best").is_some() && named(PROVED).is_some());
            let cells = panel.series.iter().filter_map(|series| match &series.shape {
                Shape::Cells { corners, .. } => Some(corners.len()),
                _ => None,
            });
            // neighbours along x are one
            assert!([2, 4].contains(&cells.sum::<usize>()), "{panel:?}");
        }
        let alone = Slice {
            parameters: vec![(d.clone(), None)],
            ..slice(vec![f64::NAN, 2000.0])
        };
        let panel = &slices(&[alone], "best")[0];
        let [_, series] = &panel.series[..] else {
            panic!("{panel:?}")
        };
        let Shape::Line { points, .. } = &series.shape else {
            panic!("{series:?}")
        };
        assert!(points[0].1.is_nan() && points[1] == (1.0, 2.0));
    }
}
