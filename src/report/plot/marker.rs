//! Markers: told apart by their form, with colour or without.

use super::TENTHS;
use super::colour::Colour;
use super::paper::{Area, Drawn};
use plotters::element::{Circle, PathElement, Polygon};
use plotters::style::{Color, ShapeStyle};

/// The outline of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    Circle,
    Square,
    Diamond,
    /// Point up.
    Triangle,
    /// Point down.
    Wedge,
    /// x
    Cross,
    /// +
    Plus,
}

/// How a point is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marker {
    pub colour: Colour,
    pub form: Form,
    /// Whether the outline is filled; a cross has no inside.
    pub filled: bool,
    /// In pixels across.
    pub size: f64,
}

/// The outline of an open marker, in tenths of a pixel.
const OUTLINE: u32 = 15;

impl Marker {
    /// A small filled circle, one of many.
    pub const fn dot(colour: Colour, size: f64) -> Self {
        Self {
            colour,
            form: Form::Circle,
            filled: true,
            size,
        }
    }

    /// An open marker, through which what it marks is seen.
    pub const fn open(colour: Colour, form: Form) -> Self {
        Self {
            colour,
            form,
            filled: false,
            size: 9.0,
        }
    }

    /// A filled marker.
    pub const fn filled(colour: Colour, form: Form) -> Self {
        Self {
            colour,
            form,
            filled: true,
            size: 8.0,
        }
    }

    /// Draws one at a point of the grid.
    pub(super) fn draw(&self, area: &Area, (x, y): (i32, i32)) -> Drawn {
        let half = (self.size * TENTHS / 2.0).round() as i32;
        let style = self.style();
        // of one area with a circle of this width
        let (side, tip) = (half * 9 / 10, half * 12 / 10);
        let corners = match self.form {
            Form::Circle => return area.draw(&Circle::new((x, y), half, style)),
            Form::Cross => {
                return self.strokes(
                    area,
                    [
                        [(x - side, y - side), (x + side, y + side)],
                        [(x - side, y + side), (x + side, y - side)],
                    ],
                );
            }
            Form::Plus => return self.strokes(area, [[(x - tip, y), (x + tip, y)], [(x, y - tip), (x, y + tip)]]),
            Form::Square => vec![
                (x - side, y - side),
                (x + side, y - side),
                (x + side, y + side),
                (x - side, y + side),
            ],
            Form::Diamond => vec![(x, y - tip), (x + tip, y), (x, y + tip), (x - tip, y)],
            Form::Triangle => vec![(x, y - tip), (x + tip, y + side), (x - tip, y + side)],
            Form::Wedge => vec![(x, y + tip), (x + tip, y - side), (x - tip, y - side)],
        };
        if self.filled {
            return area.draw(&Polygon::new(corners, style));
        }
        let closed: Vec<(i32, i32)> = corners.iter().chain(corners.first()).copied().collect();
        area.draw(&PathElement::new(closed, style))
    }

    fn strokes(&self, area: &Area, strokes: [[(i32, i32); 2]; 2]) -> Drawn {
        let style = self.colour.pen().stroke_width(OUTLINE + 5);
        for ends in strokes {
            area.draw(&PathElement::new(ends.to_vec(), style))?;
        }
        Ok(())
    }

    fn style(&self) -> ShapeStyle {
        let pen = self.colour.pen();
        if self.filled {
            pen.filled()
        } else {
            pen.stroke_width(OUTLINE)
        }
    }
}
