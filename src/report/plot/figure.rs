//! A figure: panels side by side and below each other.

use super::TENTHS;
use super::draw;
use super::legend::Legend;
use super::panel::Panel;
use super::paper::{Paper, PlotError};
use super::png::png;
use super::text::fitting;
#[cfg(test)]
use crate::model::calls::{self, Call};
use plotters::drawing::IntoDrawingArea;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{BLACK, FontDesc, FontStyle, IntoFont};
use std::path::Path;

/// Panels under one title.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Above all; may be empty.
    pub title: String,
    /// How many panels stand side by side.
    pub columns: usize,
    pub panels: Vec<Panel>,
    /// Width and height of a panel with its labels, in pixels; the legend stands below all.
    pub panel_size: (f64, f64),
}

/// Heights in pixels.
const TITLE: f64 = 34.0;
const FOOT: f64 = 10.0;
/// Between the panels and the legend.
const APART: f64 = 6.0;
/// Left and right of the title and the legend.
const MARGIN: f64 = 14.0;
/// Fonts in pixels.
const TITLE_FONT: f64 = 16.0;
/// The sides that a panel may have, in pixels: less has no room for labels, more overflows the grid.
const SIDES: std::ops::RangeInclusive<f64> = 200.0..=10_000.0;
/// The most panels.
const MOST_PANELS: usize = 100;

impl Figure {
    /// Panels side by side, in the size of a page's width.
    pub fn new(title: impl Into<String>, panels: Vec<Panel>) -> Self {
        Self {
            title: title.into(),
            columns: panels.len().max(1),
            panels,
            panel_size: (450.0, 350.0),
        }
    }

    /// The figure as a file of this name has it: a PNG where it ends in `.png`, else an SVG.
    ///
    /// # Errors
    /// Those of [`Figure::svg`]; of a PNG letters that its fonts lack.
    pub fn bytes(&self, path: Option<&Path>) -> Result<Vec<u8>, PlotError> {
        let svg = self.svg()?;
        let extension = path.and_then(Path::extension);
        match extension.is_some_and(|extension| extension.eq_ignore_ascii_case("png")) {
            true => png(&svg),
            false => Ok(svg.into_bytes()),
        }
    }

    /// The figure as an SVG: the same bytes for the same figure, text of 12 pixels or more.
    ///
    /// # Errors
    /// No panel or more than a hundred, and panels too small for their labels or too large.
    pub fn svg(&self) -> Result<String, PlotError> {
        #[cfg(test)]
        calls::count(Call::Figure);
        let (width, height) = self.panel_size;
        if !(SIDES.contains(&width) && SIDES.contains(&height)) {
            return Err(PlotError(format!(
                "a panel of {width} x {height} pixels; from {} to {} are possible",
                SIDES.start(),
                SIDES.end()
            )));
        }
        if self.panels.is_empty() || self.panels.len() > MOST_PANELS {
            let count = self.panels.len();
            return Err(PlotError(format!(
                "{count} panels; from 1 to {MOST_PANELS} are possible"
            )));
        }
        let columns = self.columns.clamp(1, self.panels.len());
        let rows: Vec<&[Panel]> = self.panels.chunks(columns).collect();
        let wide = width * columns as f64;
        let legend = Legend::new(self.panels.iter().flat_map(|panel| &panel.series), wide - 2.0 * MARGIN);
        let above = if self.title.is_empty() { 0.0 } else { TITLE };
        let below = above + height * rows.len() as f64;
        let size = (wide, below + APART + legend.height() + FOOT);
        let mut out = String::new();
        {
            let area = Paper::new(&mut out, size).into_drawing_area();
            let tenths = |pixels: f64| (pixels * TENTHS).round() as i32;
            let title_font = fitting(&self.title, TITLE_FONT, wide - 2.0 * MARGIN);
            let font: FontDesc = ("sans-serif", title_font * TENTHS).into_font().style(FontStyle::Bold);
            let style = font.color(&BLACK).pos(Pos::new(HPos::Center, VPos::Center));
            area.draw_text(&self.title, &style, (tenths(size.0 / 2.0), tenths(TITLE / 2.0 + 2.0)))?;
            // frames below each other begin at one x
            let own = |panels: &&[Panel], column: usize| panels.get(column).map(|panel| draw::beside(panel, height));
            let beside = |column| rows.iter().filter_map(|row| own(row, column)).fold(0.0, f64::max);
            for (row, panels) in rows.iter().enumerate() {
                for (column, panel) in panels.iter().enumerate() {
                    let corner = (width * column as f64, above + height * row as f64);
                    let corner = (tenths(corner.0), tenths(corner.1));
                    draw::panel(&area, panel, corner, self.panel_size, beside(column))?;
                }
            }
            legend.draw(&area, (tenths(MARGIN), tenths(below + APART)))?;
            area.present()?;
        }
        Ok(out)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, Colour, Dash, Form, Mark, Marker, Point, Series, Shape, Stroke};
    use super::*;

    const THIN: Stroke = Stroke {
        colour: Colour::Blue,
        dash: Dash::Dashed,
        width: 1.5,
    };

    fn wave(count: u32) -> Vec<Point> {
        (0..count)
            .map(|index| f64::from(index) / 100.0)
            .map(|x| (x, x.sin()))
            .collect()
    }

    /// One of everything, and what cannot be drawn.
    fn everything() -> Figure {
        let mark = |x: f64, label: &str| Mark {
            at: (x, 0.5),
            label: label.to_owned(),
        };
        let mut first = Panel::new(Axis::new("d (1)"), Axis::over("velocity <1>", (-1.0, 1.0)));
        first.heading = "left & right".to_owned();
        first.series = vec![
            Series {
                name: "shaded".to_owned(),
                shape: Shape::Bands {
                    spans: vec![(1.0, 2.0), (f64::NAN, 3.0)],
                    colour: Colour::Sky,
                },
            },
            Series::dots("points", wave(500), Marker::dot(Colour::Black, 1.6)),
            Series::line(
                "broken",
                vec![(0.0, 0.0), (f64::NAN, 0.0), (1.0, f64::INFINITY), (2.0, 0.0)],
                THIN,
            ),
            Series::line("line", wave(500), THIN),
            Series::verticals("guide", vec![2.5, f64::NAN], THIN),
            Series {
                name: "level".to_owned(),
                shape: Shape::Horizontals {
                    at: vec![0.25],
                    stroke: THIN,
                },
            },
        ];
        for form in [
            Form::Circle,
            Form::Square,
            Form::Diamond,
            Form::Triangle,
            Form::Wedge,
            Form::Cross,
            Form::Plus,
        ] {
            let marks = vec![mark(3.0, "a < b"), mark(f64::NAN, "nowhere")];
            first.series.push(Series::marks(
                format!("{form:?}"),
                marks.clone(),
                Marker::open(Colour::Green, form),
            ));
            first
                .series
                .push(Series::marks("", marks, Marker::filled(Colour::Purple, form)));
        }
        let mut second = Panel::new(Axis::new("t"), Axis::new("Z"));
        second.series = vec![Series::dots(
            "nothing",
            vec![(f64::NAN, 1.0)],
            Marker::dot(Colour::Black, 1.0),
        )];
        Figure::new("Everything & more", vec![first, second])
    }

    #[test]
    fn a_figure_is_xml_that_says_all_it_should_in_text() {
        let svg = everything().svg().unwrap();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let texts: Vec<&str> = document.descendants().filter_map(|node| node.text()).collect();
        for wanted in [
            "Everything & more",
            "left & right",
            "d (1)",
            "velocity <1>",
            "points",
            "guide",
            "Wedge",
            "a < b",
            "nothing (no points)",
            "no points",
            "\u{2212}0.5",
        ] {
            assert!(texts.contains(&wanted), "{wanted}: {texts:?}");
        }
        assert!(!texts.contains(&"nowhere") && !svg.contains("NaN") && !svg.contains("inf"));
    }

    #[test]
    fn text_is_legible_and_no_line_is_a_hairline() {
        let svg = everything().svg().unwrap();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let root = document.root_element();
        let number = |node: roxmltree::Node, name: &str| node.attribute(name).and_then(|text| text.parse::<f64>().ok());
        let view: Vec<f64> = root
            .attribute("viewBox")
            .unwrap()
            .split(' ')
            .map(|side| side.parse().unwrap())
            .collect();
        let pixel = view[2] / number(root, "width").unwrap();
        for node in document.descendants() {
            assert!(number(node, "font-size").is_none_or(|size| size / pixel >= 11.0));
            assert!(number(node, "stroke-width").is_none_or(|width| width / pixel >= 0.7));
        }
    }

    #[test]
    fn the_same_figure_is_the_same_bytes() {
        assert_eq!(everything().svg(), everything().svg());
    }

    #[test]
    fn a_point_drawn_a_thousand_times_takes_no_more_room_than_once() {
        let size = |points: Vec<Point>| {
            let mut panel = Panel::new(Axis::over("x", (0.0, 1.0)), Axis::over("y", (0.0, 1.0)));
            panel.series = vec![Series::dots("points", points, Marker::dot(Colour::Black, 1.5))];
            Figure::new("", vec![panel]).svg().unwrap().len()
        };
        assert_eq!(size(vec![(0.5, 0.5); 1000]), size(vec![(0.5, 0.5)]));
        let cloud: Vec<Point> = (0..30_000)
            .map(|i| (f64::from(i * 7919 % 30_011) / 30_011.0, f64::from(i) / 30_000.0))
            .collect();
        assert!(size(cloud) < 330_000);
    }

    #[test]
    fn lines_on_each_other_are_drawn_once_so_that_dashes_stay_dashes() {
        let size = |points: Vec<Point>| {
            let mut panel = Panel::new(Axis::over("x", (0.0, 1.0)), Axis::over("y", (0.0, 1.0)));
            panel.series = vec![Series::line("line", points, THIN)];
            Figure::new("", vec![panel]).svg().unwrap().len()
        };
        let points: Vec<Point> = (0..=10).map(|i| (f64::from(i) / 10.0, 0.5)).collect();
        let broken = [&points[..], &[(f64::NAN, 0.0)]].concat();
        // the other one from its middle on, and backwards
        let both = broken.iter().chain(points[4..].iter().rev()).copied().collect();
        assert_eq!(size(both), size(points));
    }

    #[test]
    fn frames_below_each_other_begin_at_one_x() {
        let panel = |most: f64| Panel::new(Axis::over("x", (0.0, 1.0)), Axis::over("y", (0.0, most)));
        let mut figure = Figure::new("", vec![panel(1.0), panel(1e-7)]);
        figure.columns = 1;
        let svg = figure.svg().unwrap();
        let document = roxmltree::Document::parse(&svg).unwrap();
        // the numbers of the y axes end at their ticks
        let numbers = document
            .descendants()
            .filter(|node| node.attribute("text-anchor") == Some("end"));
        let mut ends: Vec<&str> = numbers.filter_map(|node| node.attribute("x")).collect();
        assert!(ends.len() > 4);
        ends.dedup();
        assert_eq!(ends.len(), 1);
    }

    #[test]
    fn what_cannot_be_laid_out_is_an_error() {
        let mut figure = everything();
        for size in [(0.0, 300.0), (300.0, f64::NAN), (1e9, 1e9)] {
            figure.panel_size = size;
            assert!(figure.svg().unwrap_err().to_string().contains("pixels"));
        }
        assert!(Figure::new("", Vec::new()).svg().is_err());
    }
}
