//! What a panel shows.

use super::colour::Colour;
use super::dash::Dash;
use super::marker::Marker;

/// x and y.
pub type Point = (f64, f64);

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    pub colour: Colour,
    pub dash: Dash,
    /// In pixels.
    pub width: f64,
}

/// A point that stands out.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Where.
    pub at: Point,
    /// What stands beside it; may be empty.
    pub label: String,
}

/// Things of one look and one name.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What the legend calls it; where it is empty, the legend is silent.
    pub name: String,
    /// What is drawn.
    pub shape: Shape,
}

/// How much of its colour a band has.
pub(super) const SHADE: f64 = 0.25;

/// What is drawn. Points that are not finite are left out and break lines.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A cloud of points.
    Dots { points: Vec<Point>, marker: Marker },
    /// Points joined in order.
    Line { points: Vec<Point>, stroke: Stroke },
    /// Points joined in order, with markers at some places, by which lines of one dash are told apart.
    Marked {
        points: Vec<Point>,
        stroke: Stroke,
        marked: Vec<Point>,
        marker: Marker,
    },
    /// Single points, each with a label or none.
    Marks { marks: Vec<Mark>, marker: Marker },
    /// Lines across the panel at values of x.
    Verticals { at: Vec<f64>, stroke: Stroke },
    /// Lines across the panel at values of y.
    Horizontals { at: Vec<f64>, stroke: Stroke },
    /// Shaded from one value of x to another, across the panel.
    Bands { spans: Vec<(f64, f64)>, colour: Colour },
    /// Filled rectangles, each from one corner to the opposite one.
    Cells { corners: Vec<[Point; 2]>, colour: Colour },
}

impl Series {
    /// A cloud of points.
    pub fn dots(name: impl Into<String>, points: Vec<Point>, marker: Marker) -> Self {
        let shape = Shape::Dots { points, marker };
        Self {
            name: name.into(),
            shape,
        }
    }

    /// Points joined in order; a NaN breaks the line.
    pub fn line(name: impl Into<String>, points: Vec<Point>, stroke: Stroke) -> Self {
        let shape = Shape::Line { points, stroke };
        Self {
            name: name.into(),
            shape,
        }
    }

    /// Single points with labels.
    pub fn marks(name: impl Into<String>, marks: Vec<Mark>, marker: Marker) -> Self {
        let shape = Shape::Marks { marks, marker };
        Self {
            name: name.into(),
            shape,
        }
    }

    /// Lines across the panel at values of x.
    pub fn verticals(name: impl Into<String>, at: Vec<f64>, stroke: Stroke) -> Self {
        let shape = Shape::Verticals { at, stroke };
        Self {
            name: name.into(),
            shape,
        }
    }

    /// Whether there is nothing finite to be drawn.
    pub(super) fn is_empty(&self) -> bool {
        let finite = |(x, y): &Point| x.is_finite() && y.is_finite();
        match &self.shape {
            Shape::Dots { points, .. } | Shape::Line { points, .. } | Shape::Marked { points, .. } => {
                !points.iter().any(finite)
            }
            Shape::Marks { marks, .. } => !marks.iter().any(|mark| finite(&mark.at)),
            Shape::Verticals { at, .. } | Shape::Horizontals { at, .. } => !at.iter().any(|value| value.is_finite()),
            Shape::Bands { spans, .. } => !spans.iter().any(finite),
            Shape::Cells { corners, .. } => !corners.iter().any(|ends| ends.iter().all(finite)),
        }
    }

    /// Every finite point, which the axes should reach. Guide lines and bands do not stretch an axis.
    pub(super) fn points(&self) -> impl Iterator<Item = Point> + '_ {
        let points: Box<dyn Iterator<Item = Point>> = match &self.shape {
            Shape::Dots { points, .. } | Shape::Line { points, .. } | Shape::Marked { points, .. } => {
                Box::new(points.iter().copied())
            }
            Shape::Marks { marks, .. } => Box::new(marks.iter().map(|mark| mark.at)),
            _ => Box::new(std::iter::empty()),
        };
        points.filter(|(x, y)| x.is_finite() && y.is_finite())
    }
}
