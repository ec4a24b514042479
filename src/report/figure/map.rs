//! What each point of two parameters comes to, in colours.

use super::parameter::Parameter;
use crate::report::plot::{Axis, Colour, Panel, Point, Series, Shape};
use std::collections::HashMap;

/// A grid of two parameters with what was found at each of its points.
#[derive(Clone, Debug)]
pub struct HeatMap {
    pub x: Parameter,
    pub y: Parameter,
    /// How many values along x and along y, evenly spaced between the ends.
    pub points: [usize; 2],
    /// A panel for each.
    pub layers: Vec<Layer>,
}

/// One thing that was found at each point, row by row along x.
#[derive(Clone, Debug, PartialEq)]
pub enum Layer {
    /// A number with its name and unit; NaN where there is none.
    Values {
        name: String,
        unit: String,
        values: Vec<f64>,
        /// The least and the largest value of the colours; of the values themselves where nothing is said.
        ends: Option<(f64, f64)>,
    },
    /// A word; empty where there is none.
    Words { name: String, words: Vec<String> },
}

/// The words that have a colour of their own, the most frequent ones.
const MOST_WORDS: usize = Colour::LINES.len() - 1;

/// What stands for what does not repeat, and for all words without a colour.
const NO_WORD: &str = "does not repeat";
const OTHERS: &str = "other words";

impl HeatMap {
    /// A panel for each layer.
    pub fn panels(&self) -> Vec<Panel> {
        self.layers.iter().map(|layer| self.panel(layer)).collect()
    }

    /// The panel of a layer.
    pub(super) fn panel(&self, layer: &Layer) -> Panel {
        let axis = |parameter: &Parameter, count| {
            let ends = [0, count].map(|at| edge(parameter, count, at));
            Axis::over(parameter.label.clone(), (ends[0].min(ends[1]), ends[0].max(ends[1])))
        };
        let [columns, rows] = self.points;
        let mut panel = Panel::new(axis(&self.x, columns), axis(&self.y, rows));
        let (name, classes) = match layer {
            Layer::Values {
                name,
                unit,
                values,
                ends,
            } => {
                let scale = match ends {
                    Some((low, high)) => Scale::of(&[*low, *high]),
                    None => Scale::of(values),
                };
                let colours = scale.edges.iter().skip(1).zip(0..).map(|(_, step)| Colour::Level(step));
                panel.series.push(Series {
                    name: scale.told(name, unit),
                    shape: Shape::Scale {
                        colours: colours.collect(),
                    },
                });
                (name, scale.classes(values))
            }
            Layer::Words { name, words } => (name, by_word(words)),
        };
        panel.heading.clone_from(name);
        panel.series.extend(classes.into_iter().map(|(name, colour, is_in)| {
            let corners = self.cells(&is_in);
            Series {
                name,
                shape: Shape::Cells { corners, colour },
            }
        }));
        panel
    }

    /// The cells of a class: neighbours along x as one.
    pub(super) fn cells(&self, is_in: &[bool]) -> Vec<[Point; 2]> {
        let [columns, _] = self.points;
        let mut cells = Vec::new();
        for (row, own) in is_in.chunks(columns.max(1)).enumerate() {
            let mut start = None;
            for column in 0..=own.len() {
                let is_here = own.get(column) == Some(&true);
                match start {
                    None if is_here => start = Some(column),
                    Some(from) if !is_here => {
                        let corner = |column, row| {
                            let [columns, rows] = self.points;
                            (edge(&self.x, columns, column), edge(&self.y, rows, row))
                        };
                        cells.push([corner(from, row), corner(column, row + 1)]);
                        start = None;
                    }
                    _ => {}
                }
            }
        }
        cells
    }
}

/// Where cell number `at` of so many begins along a parameter: its value lies in the middle.
fn edge(parameter: &Parameter, count: usize, at: usize) -> f64 {
    let (one, other) = parameter.ends;
    // the only one has a width too
    let step = match count {
        0 | 1 => 0.1 * one.abs().max(1e-3),
        _ => (other - one) / (count - 1) as f64,
    };
    one + step * (at as f64 - 0.5)
}

/// A class of points: its name, its colour, and which they are.
type Class = (String, Colour, Vec<bool>);

/// The steps of a scale of colours.
struct Scale {
    /// Where they begin and end: one edge more than steps; none where there is no value.
    edges: Vec<f64>,
    /// How many of the steps lie below 0, where some do and some do not.
    below_zero: usize,
}

impl Scale {
    /// Equal steps from the least to the largest value; where 0 lies between, it is an edge, and equal steps lie on its sides.
    fn of(values: &[f64]) -> Self {
        let finite = || values.iter().copied().filter(|value| value.is_finite());
        let (low, high) = (
            finite().fold(f64::INFINITY, f64::min),
            finite().fold(f64::NEG_INFINITY, f64::max),
        );
        let levels = usize::from(Colour::LEVELS);
        let between = |from: f64, to: f64, steps: usize| {
            (0..steps).map(move |step| from + (to - from) * step as f64 / steps as f64)
        };
        let below_zero = match low < 0.0 && 0.0 < high {
            true => ((levels as f64 * low / (low - high)).round() as usize).clamp(1, levels - 1),
            false => 0,
        };
        let edges: Vec<f64> = match (low.partial_cmp(&high), below_zero) {
            (Some(std::cmp::Ordering::Less), 0) => between(low, high, levels).chain([high]).collect(),
            (Some(std::cmp::Ordering::Less), _) => between(low, 0.0, below_zero)
                .chain(between(0.0, high, levels - below_zero))
                .chain([high])
                .collect(),
            (Some(std::cmp::Ordering::Equal), _) => vec![low, high],
            _ => Vec::new(),
        };
        Self { edges, below_zero }
    }

    /// What the legend says.
    fn told(&self, name: &str, unit: &str) -> String {
        let (Some(low), Some(high)) = (self.edges.first(), self.edges.last()) else {
            return name.to_owned();
        };
        let (low, high, steps) = (shown(*low), shown(*high), self.edges.len() - 1);
        match self.below_zero {
            0 => format!("{name}: {low} to {high} {unit} in {steps} steps"),
            below => format!(
                "{name}: {low} to 0 {unit} in {below} steps, 0 to {high} in {}",
                steps - below
            ),
        }
    }

    /// The points within each step; what is infinite is grey.
    fn classes(&self, values: &[f64]) -> Vec<Class> {
        let step = |value: f64| {
            let above = self.edges.iter().skip(1).filter(|edge| **edge <= value).count();
            above.min(self.edges.len().saturating_sub(2))
        };
        let steps = 0..self.edges.len().saturating_sub(1);
        let mut classes: Vec<Class> = steps
            .map(|number| {
                let is_in = |value: &f64| value.is_finite() && step(*value) == number;
                (
                    String::new(),
                    Colour::Level(number as u8),
                    values.iter().map(is_in).collect(),
                )
            })
            .collect();
        let infinite: Vec<bool> = values.iter().map(|value| value.is_infinite()).collect();
        if infinite.contains(&true) {
            classes.push(("infinite".to_owned(), Colour::Grey, infinite));
        }
        classes
    }
}

/// Three figures.
fn shown(value: f64) -> String {
    let value: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    value.to_string()
}

/// The most frequent words, and the rest together.
fn by_word(words: &[String]) -> Vec<Class> {
    let mut counts: HashMap<&str, usize> = HashMap::new();
    for word in words.iter().filter(|word| !word.is_empty()) {
        *counts.entry(word).or_default() += 1;
    }
    let mut known: Vec<(&str, usize)> = counts.into_iter().collect();
    known.sort_by(|one, other| other.1.cmp(&one.1).then(one.0.cmp(other.0)));
    let (shown, rest) = known.split_at(known.len().min(MOST_WORDS));
    let is = |word: &str| words.iter().map(|own| own == word).collect::<Vec<bool>>();
    let colours = Colour::LINES.into_iter().skip(1);
    let mut classes: Vec<Class> = shown
        .iter()
        .zip(colours)
        .map(|((word, _), colour)| ((*word).to_owned(), colour, is(word)))
        .collect();
    if !rest.is_empty() {
        let is_in = |own: &String| rest.iter().any(|(word, _)| word == own);
        classes.push((OTHERS.to_owned(), Colour::Grey, words.iter().map(is_in).collect()));
    }
    if words.iter().any(String::is_empty) {
        classes.push((NO_WORD.to_owned(), Colour::Black, is("")));
    }
    classes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(layer: Layer) -> HeatMap {
        HeatMap {
            x: Parameter::new("d", (0.1, 0.3)),
            y: Parameter::new("r_b", (0.4, 0.5)),
            points: [3, 2],
            layers: vec![layer],
        }
    }

    #[test]
    fn every_point_is_in_one_class_and_neighbours_are_one_cell() {
        let values = vec![1.0, 1.0, 9.0, f64::NEG_INFINITY, f64::NAN, 9.0];
        let layer = Layer::Values {
            name: "rate".to_owned(),
            unit: "V".to_owned(),
            values: values.clone(),
            ends: None,
        };
        let classes = Scale::of(&values).classes(&values);
        for (point, value) in values.iter().enumerate() {
            let count = classes.iter().filter(|(_, _, is_in)| is_in[point]).count();
            assert_eq!(count, usize::from(!value.is_nan()), "{value}");
        }
        let scaled = map(layer.clone()).panel(&layer);
        assert_eq!(scaled.series[0].name, "rate: 1 to 9 V in 8 steps");
        let panel = map(layer).panel(&Layer::Words {
            name: "word".to_owned(),
            words: ["BT", "BT", "", "BTT", "BT", "BT"].map(str::to_owned).to_vec(),
        });
        let cells: Vec<(&str, usize)> = panel
            .series
            .iter()
            .map(|series| match &series.shape {
                Shape::Cells { corners, .. } => (series.name.as_str(), corners.len()),
                _ => ("", 0),
            })
            .collect();
        assert_eq!(cells, [("BT", 2), ("BTT", 1), (NO_WORD, 1)]);
        let Shape::Cells { corners, .. } = &panel.series[0].shape else {
            panic!("cells")
        };
        let [(left, low), (right, high)] = corners[0];
        assert!((left - 0.05).abs() < 1e-12 && (right - 0.25).abs() < 1e-12);
        assert!((low - 0.35).abs() < 1e-12 && (high - 0.45).abs() < 1e-12);
    }

    #[test]
    fn steps_are_equal_and_zero_is_an_edge() {
        let values: Vec<f64> = (0..=80).map(f64::from).collect();
        let scale = Scale::of(&values);
        assert_eq!(scale.edges, [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0]);
        let classes = scale.classes(&values);
        assert!(classes[7].2[80] && classes[0].2[0] && classes[1].2[10] && !classes[0].2[10]);
        let scale = Scale::of(&[-3.0, f64::NEG_INFINITY, 1.0]);
        assert_eq!((scale.below_zero, scale.edges[6], scale.edges[7]), (6, 0.0, 0.5));
        assert_eq!(
            scale.told("exponent", "1/s"),
            "exponent: -3 to 0 1/s in 6 steps, 0 to 1 in 2"
        );
        assert_eq!(Scale::of(&[2.0, 2.0]).classes(&[2.0, 2.0]).len(), 1);
        assert!(Scale::of(&[f64::NAN]).classes(&[f64::NAN]).is_empty());
    }
}
