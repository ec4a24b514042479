//! What the looks of a figure mean, in rows below its panels.

use super::TENTHS;
use super::marker::Marker;
use super::paper::{Area, Drawn};
use super::series::{SHADE, Series, Shape, Stroke};
use super::text::width;
use plotters::element::{PathElement, Rectangle};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{BLACK, Color, FontDesc, IntoFont};

/// Sizes in pixels.
const FONT: f64 = 12.0;
const ROW: f64 = 19.0;
const SAMPLE: f64 = 24.0;
const GAP: f64 = 6.0;
const BETWEEN: f64 = 14.0;
/// Around a sample of cells, in tenths of a pixel.
const EDGE: u32 = 7;

/// The names of the series of all panels, in rows.
pub(super) struct Legend<'a> {
    rows: Vec<Vec<(String, &'a Shape)>>,
}

impl<'a> Legend<'a> {
    /// As many to a row as `room` pixels hold, each in the first that has room; a name stands once.
    pub fn new(series: impl IntoIterator<Item = &'a Series>, room: f64) -> Self {
        let mut named: Vec<&Series> = Vec::new();
        for one in series {
            match named.iter_mut().find(|known| known.name == one.name) {
                // a panel may have none of what another has
                Some(known) if known.is_empty() => *known = one,
                Some(_) => {}
                None if one.name.is_empty() => {}
                None => named.push(one),
            }
        }
        let mut rows: Vec<Vec<(String, &Shape)>> = Vec::new();
        let mut left: Vec<f64> = Vec::new();
        for one in named {
            let text = if one.is_empty() {
                format!("{} (no points)", one.name)
            } else {
                one.name.clone()
            };
            let taken = SAMPLE + GAP + width(&text) * FONT + BETWEEN;
            let place = left.iter().position(|left| taken <= *left).unwrap_or(rows.len());
            if place == rows.len() {
                rows.push(Vec::new());
                left.push(room);
            }
            if let (Some(row), Some(left)) = (rows.get_mut(place), left.get_mut(place)) {
                row.push((text, &one.shape));
                *left -= taken;
            }
        }
        Self { rows }
    }

    /// In pixels.
    pub fn height(&self) -> f64 {
        ROW * self.rows.len() as f64
    }

    /// Draws it from a point of the grid on.
    pub fn draw(&self, area: &Area, (left, top): (i32, i32)) -> Drawn {
        let font: FontDesc = ("sans-serif", FONT * TENTHS).into_font();
        let style = font.color(&BLACK).pos(Pos::new(HPos::Left, VPos::Center));
        let tenths = |pixels: f64| (pixels * TENTHS).round() as i32;
        for (number, row) in self.rows.iter().enumerate() {
            let middle = top + tenths(ROW * (number as f64 + 0.5));
            let mut x = left;
            for (text, shape) in row {
                sample(area, shape, (x, middle))?;
                area.draw_text(text, &style, (x + tenths(SAMPLE + GAP), middle))?;
                x += tenths(SAMPLE + GAP + width(text) * FONT + BETWEEN);
            }
        }
        Ok(())
    }
}

fn sample(area: &Area, shape: &Shape, (left, middle): (i32, i32)) -> Drawn {
    let wide = (SAMPLE * TENTHS) as i32;
    let centre = (left + wide / 2, middle);
    match shape {
        Shape::Dots { marker, .. } => {
            // one dot alone would be missed
            let size = marker.size.max(3.5);
            let marker = Marker { size, ..*marker };
            [-70, 0, 70]
                .iter()
                .try_for_each(|off| marker.draw(area, (centre.0 + off, middle)))
        }
        Shape::Marks { marker, .. } => marker.draw(area, centre),
        Shape::Line { stroke, .. } | Shape::Horizontals { stroke, .. } | Shape::Verticals { stroke, .. } => {
            line(area, stroke, &[(left, middle), (left + wide, middle)])
        }
        Shape::Marked { stroke, marker, .. } => {
            line(area, stroke, &[(left, middle), (left + wide, middle)])?;
            marker.draw(area, centre)
        }
        Shape::Bands { colour, .. } => {
            let corners = [(left, middle - 45), (left + wide, middle + 45)];
            area.draw(&Rectangle::new(corners, colour.pen().mix(SHADE).filled()))
        }
        Shape::Cells { colour, .. } => {
            let corners = [(left, middle - 45), (left + wide, middle + 45)];
            area.draw(&Rectangle::new(corners, colour.pen().filled()))?;
            // white is seen by its edge
            area.draw(&Rectangle::new(corners, BLACK.stroke_width(EDGE)))
        }
    }
}

/// A line on the grid.
pub(super) fn line(area: &Area, stroke: &Stroke, points: &[(i32, i32)]) -> Drawn {
    let style = stroke.colour.pen().stroke_width((stroke.width * TENTHS).round() as u32);
    for piece in stroke.dash.pieces(points) {
        area.draw(&PathElement::new(piece, style))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::{Colour, Dash};
    use super::*;

    #[test]
    fn names_fill_rows_and_an_empty_series_says_so() {
        let stroke = Stroke {
            colour: Colour::Black,
            dash: Dash::Solid,
            width: 1.0,
        };
        let named = |name: &str, points| Series::line(name, points, stroke);
        let series = [
            named("one", vec![(0.0, 0.0)]),
            named("one", vec![(0.0, 0.0)]),
            named("", vec![(0.0, 0.0)]),
            named("two", vec![(f64::NAN, 0.0)]),
        ];
        let texts = |room: f64| -> Vec<Vec<String>> {
            let legend = Legend::new(&series, room);
            let row = |row: &Vec<(String, &Shape)>| row.iter().map(|(text, _)| text.clone()).collect();
            legend.rows.iter().map(row).collect()
        };
        assert_eq!(texts(400.0), [["one", "two (no points)"]]);
        assert_eq!(texts(10.0), [["one"], ["two (no points)"]]);
    }
}
