//! A panel: two axes and what stands between them.

use super::series::Series;

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it measures, with the unit.
    pub label: String,
    /// From where to where; around all points with a small margin where nothing is said.
    pub range: Option<(f64, f64)>,
}

impl Axis {
    /// An axis around all points.
    pub fn new(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            range: None,
        }
    }

    /// An axis with ends of its own.
    pub fn over(label: impl Into<String>, range: (f64, f64)) -> Self {
        Self {
            label: label.into(),
            range: Some(range),
        }
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
}

impl Panel {
    /// Empty axes.
    pub const fn new(x: Axis, y: Axis) -> Self {
        Self {
            heading: String::new(),
            x,
            y,
            series: Vec::new(),
        }
    }
}
