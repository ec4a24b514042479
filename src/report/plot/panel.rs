//! A panel: two axes and what stands between them.

use super::colour::Colour;
use super::series::Series;
use super::ticks::Ticks;

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it measures, with the unit.
    pub label: String,
    /// From where to where; around all points with a small margin where nothing is said.
    pub range: Option<(f64, f64)>,
    /// The form of its numbers.
    pub ticks: Ticks,
}

impl Axis {
    /// An axis around all points.
    pub fn new(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            range: None,
            ticks: Ticks::default(),
        }
    }

    /// An axis with ends of its own.
    pub fn over(label: impl Into<String>, range: (f64, f64)) -> Self {
        Self {
            label: label.into(),
            range: Some(range),
            ticks: Ticks::default(),
        }
    }

    /// The axis with its numbers written in another way.
    pub fn with_ticks(self, ticks: Ticks) -> Self {
        Self { ticks, ..self }
    }
}

/// Axes, and what stands between them, in the order in which it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Above the frame; may be empty.
    pub heading: String,
    pub x: Axis,
    pub y: Axis,
    pub series: Vec<Series>,
    /// The key to the colours of its cells, at the right of the frame.
    pub bar: Option<ColourBar>,
}

/// A scale of colours in equal steps.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourBar {
    /// The quantity, with its unit.
    pub label: String,
    /// The beginning of the first step and the end of the last one.
    pub ends: (f64, f64),
    /// The colours of the steps, from the least on.
    pub colours: Vec<Colour>,
}

impl Panel {
    /// Empty axes.
    pub const fn new(x: Axis, y: Axis) -> Self {
        Self {
            heading: String::new(),
            x,
            y,
            series: Vec::new(),
            bar: None,
        }
    }
}
