//! What each point of two parameters comes to, in colours.

use super::parameter::Parameter;
use crate::report::plot::{Axis, Colour, ColourBar, Form, Mark, Marker, Panel, Point, Series, Shape, round_edges};
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
    /// Points with a label, on top of each layer, and what they are.
    pub marks: (String, Vec<Mark>),
}

/// One thing that was found at each point, row by row along x.
#[derive(Clone, Debug, PartialEq)]
pub enum Layer {
    /// A number with its name and unit; NaN where there is none.
    Values {
        name: String,
        unit: String,
        values: Vec<f64>,
        /// The least and the largest value that has a colour; of the values themselves where nothing is said.
        ends: Option<(f64, f64)>,
    },
    /// A word; empty where there is none, [`UNDECIDED`] where it is not known.
    Words { name: String, words: Vec<String> },
}

/// The words that have a colour of their own, the most frequent ones.
const MOST_WORDS: usize = Colour::LINES.len() - 1;

/// What stands for what does not repeat, and for all words without a colour.
const NO_WORD: &str = "does not repeat";
const OTHERS: &str = "other motions";
pub const UNDECIDED: &str = "not decided";

impl HeatMap {
    /// A panel for each layer.
    pub fn panels(&self) -> Vec<Panel> {
        self.layers.iter().map(|layer| self.panel(layer)).collect()
    }

    /// The panel of a layer.
    pub(super) fn panel(&self, layer: &Layer) -> Panel {
        let axis = |parameter: &Parameter, count| {
            let ends = [0, count].map(|at| edge(parameter, count, at));
            let ends = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            Axis::over(parameter.label.clone(), ends).with_ticks(parameter.ticks)
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
                let edges = match ends {
                    Some((low, high)) => round_edges(&[*low, *high]),
                    None => round_edges(values),
                };
                if let [first, .., last] = edges.as_slice() {
                    let steps = edges.len() - 1;
                    panel.bar = Some(ColourBar {
                        label: format!("{name}  [{unit}]"),
                        ends: (*first, *last),
                        colours: (0..steps).map(|step| Colour::level(step, steps)).collect(),
                    });
                }
                (name, by_step(&edges, values))
            }
            Layer::Words { name, words } => (name, by_word(words)),
        };
        panel.heading = capitalised(name);
        panel.series.extend(classes.into_iter().map(|(name, colour, is_in)| {
            let corners = self.cells(&is_in);
            Series {
                name,
                shape: Shape::Cells { corners, colour },
            }
        }));
        let (name, marks) = &self.marks;
        if !marks.is_empty() {
            let size = 11.0;
            let [inside, edge] = [
                Marker::filled(Colour::White, Form::Circle),
                Marker::open(Colour::Black, Form::Circle),
            ];
            let without_labels = marks.iter().map(|mark| Mark {
                label: String::new(),
                ..mark.clone()
            });
            let inner = Series::marks("", without_labels.collect(), Marker { size, ..inside });
            let outer = Series::marks(name.clone(), marks.clone(), Marker { size, ..edge });
            panel.series.extend([inner, outer]);
        }
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

/// The points within each step between two edges; what is infinite is grey.
fn by_step(edges: &[f64], values: &[f64]) -> Vec<Class> {
    let steps = edges.len().saturating_sub(1);
    let step = |value: f64| {
        let above = edges.iter().skip(1).filter(|edge| **edge <= value).count();
        above.min(steps.saturating_sub(1))
    };
    let mut classes: Vec<Class> = (0..steps)
        .map(|number| {
            let is_in = |value: &f64| value.is_finite() && step(*value) == number;
            let is_in = values.iter().map(is_in).collect();
            (String::new(), Colour::level(number, steps), is_in)
        })
        .collect();
    let infinite: Vec<bool> = values.iter().map(|value| value.is_infinite()).collect();
    if infinite.contains(&true) {
        classes.push(("infinite".to_owned(), Colour::Grey, infinite));
    }
    classes
}

/// The text with its first letter as a capital.
fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(letters).collect()
}

/// The most frequent words, and the rest together.
fn by_word(words: &[String]) -> Vec<Class> {
    let mut counts: HashMap<&str, usize> = HashMap::new();
    for word in words.iter().filter(|word| !word.is_empty() && *word != UNDECIDED) {
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
        classes.push((OTHERS.to_owned(), Colour::LightGrey, words.iter().map(is_in).collect()));
    }
    for (name, word, colour) in [(NO_WORD, "", Colour::DarkGrey), (UNDECIDED, UNDECIDED, Colour::White)] {
        if words.iter().any(|own| own == word) {
            classes.push((name.to_owned(), colour, is(word)));
        }
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
            marks: (String::new(), Vec::new()),
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
        let classes = by_step(&round_edges(&values), &values);
        for (point, value) in values.iter().enumerate() {
            let count = classes.iter().filter(|(_, _, is_in)| is_in[point]).count();
            assert_eq!(count, usize::from(!value.is_nan()), "{value}");
        }
        let scaled = map(layer.clone()).panel(&layer);
        let bar = scaled.bar.expect("a bar of colours");
        assert_eq!(
            (bar.label.as_str(), bar.ends, bar.colours.len()),
            ("rate  [V]", (1.0, 9.0), 16)
        );
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
    fn a_value_at_an_edge_is_in_the_step_above_and_the_largest_in_the_last() {
        let values: Vec<f64> = (0..=80).map(f64::from).collect();
        let classes = by_step(&round_edges(&values), &values);
        assert!(classes[15].2[80] && classes[0].2[0] && classes[2].2[10] && !classes[1].2[10]);
        assert!(by_step(&round_edges(&[f64::NAN]), &[f64::NAN]).is_empty());
    }

    #[test]
    fn words_that_are_none_have_greys_of_their_own() {
        let words = ["BT", "", UNDECIDED, "a", "b", "c", "d", "e", "f", "g"].map(str::to_owned);
        let greys: Vec<(String, Colour)> = by_word(&words)
            .into_iter()
            .map(|(name, colour, _)| (name, colour))
            .filter(|(_, colour)| !Colour::LINES.contains(colour))
            .collect();
        assert_eq!(
            greys,
            [
                (OTHERS.to_owned(), Colour::LightGrey),
                (NO_WORD.to_owned(), Colour::DarkGrey),
                (UNDECIDED.to_owned(), Colour::White)
            ]
        );
    }

    #[test]
    fn what_is_marked_stands_over_the_cells_with_its_label() {
        let mut marked = map(Layer::Words {
            name: "word".to_owned(),
            words: vec!["BT".to_owned(); 6],
        });
        let mark = Mark {
            at: (0.2, 0.5),
            label: "1".to_owned(),
        };
        marked.marks = ("attractor".to_owned(), vec![mark]);
        let last = marked.panels()[0].series.last().cloned().expect("marks");
        let Shape::Marks { marks, .. } = &last.shape else {
            panic!("{last:?}")
        };
        assert_eq!((last.name.as_str(), marks[0].label.as_str()), ("attractor", "1"));
    }
}
