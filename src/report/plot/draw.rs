//! One panel: its frame, its axes, and all that stands in it.

use super::TENTHS;
use super::clip;
use super::label::{Rect, Room};
use super::legend::line;
use super::marker::Marker;
use super::panel::{ColourBar, Panel};
use super::paper::{Area, Drawn, PlotError};
use super::scale::Scale;
use super::series::{Mark, Point, SHADE, Shape, Stroke};
use super::span::Span;
use super::text::{fitting, width};
use super::ticks::{Tick, Ticks};
use plotters::chart::ChartBuilder;
use plotters::element::{PathElement, Rectangle};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{BLACK, Color, FontDesc, FontStyle, FontTransform, IntoFont, RGBColor, WHITE};
use std::collections::HashSet;

/// Fonts in pixels.
const TICK_FONT: f64 = 12.5;
const AXIS_FONT: f64 = 14.0;
const LABEL_FONT: f64 = 12.0;
const HEADING_FONT: f64 = 14.0;
/// Lengths in pixels.
const HEADING: f64 = 24.0;
const BOTTOM: f64 = 50.0;
const RIGHT: f64 = 16.0;
const TICK: f64 = 5.0;
/// From the tick labels' left to the panel's edge.
const BESIDE: f64 = 34.0;
/// Left of the axis' label.
const LEFT: f64 = 6.0;
/// From the frame to a bar of colours, its width, and from its tick labels to its label.
const BAR_APART: f64 = 12.0;
const BAR: f64 = 14.0;
const BAR_BESIDE: f64 = 30.0;
/// Pixels for each tick.
const X_ROOM: f64 = 50.0;
const Y_ROOM: f64 = 32.0;
/// Tenths of a pixel.
const DOT: i32 = 30;
/// A label so near to a mark would be taken for its own.
const NEAR: i32 = 100;
const FRAME: u32 = 12;
const GRID: u32 = 7;
const LEADER: u32 = 8;
const GRID_COLOUR: RGBColor = RGBColor(225, 225, 225);

/// Where data go on the grid.
struct Frame<'a, 'b, F> {
    area: &'a Area<'b>,
    x: Span,
    y: Span,
    rect: Rect,
    map: F,
}

/// The width in pixels of the widest text.
fn widest(ticks: &[Tick]) -> f64 {
    ticks.iter().map(|tick| width(&tick.1)).fold(0.0, f64::max) * TICK_FONT
}

/// The ticks of the y axis of a panel so many pixels high.
fn y_ticks(panel: &Panel, high: f64) -> (Span, Vec<Tick>) {
    let y = span(panel, &panel.y.range, |point| point.1);
    let ticks = panel.y.ticks.over(&y, ((high - HEADING - BOTTOM) / Y_ROOM) as usize);
    (y, ticks)
}

/// The room in pixels that a panel needs at the left of its frame.
pub(super) fn beside(panel: &Panel, high: f64) -> f64 {
    BESIDE + widest(&y_ticks(panel, high).1)
}

/// Draws a panel of a size in pixels with its upper left corner at a point of the grid, and so much room at the left of its
/// frame.
pub(super) fn panel(
    area: &Area,
    panel: &Panel,
    (left, top): (i32, i32),
    (wide, high): (f64, f64),
    beside: f64,
) -> Result<(), PlotError> {
    let tenths = |pixels: f64| (pixels * TENTHS).round() as i32;
    let x = span(panel, &panel.x.range, |point| point.0);
    let (y, y_ticks) = y_ticks(panel, high);
    let most = ((high - HEADING - BOTTOM) / Y_ROOM) as usize;
    let bar = panel.bar.as_ref().map(|bar| {
        let span = Span::new(bar.ends.0, bar.ends.1);
        let ticks = Ticks::Decimals.over(&span, most);
        (bar, span, ticks)
    });
    let right = match &bar {
        Some((_, _, ticks)) => BAR_APART + BAR + TICK + widest(ticks) + BAR_BESIDE,
        None => RIGHT,
    };
    let room = wide - LEFT - beside - right;
    let x_ticks = panel.x.ticks.over(&x, (room / X_ROOM) as usize);

    let heading_font = fitting(&panel.heading, HEADING_FONT, wide - LEFT - beside);
    let heading: FontDesc = ("sans-serif", heading_font * TENTHS).into_font().style(FontStyle::Bold);
    let at = (left + tenths(LEFT + beside), top + tenths(HEADING / 2.0));
    let style = heading.color(&BLACK).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw_text(&panel.heading, &style, at)?;

    let body = area
        .clone()
        .shrink((left, top + tenths(HEADING)), (tenths(wide), tenths(high - HEADING)));
    let mut chart = ChartBuilder::on(&body)
        .margin_left(tenths(LEFT))
        .margin_right(tenths(right))
        .x_label_area_size(tenths(BOTTOM))
        .y_label_area_size(tenths(beside))
        .build_cartesian_2d(
            Scale {
                span: x,
                ticks: x_ticks,
            },
            Scale {
                span: y,
                ticks: y_ticks,
            },
        )?;
    let font = |pixels: f64| ("sans-serif", pixels * TENTHS).into_font();
    // one size for both, so that neither is cut
    let axis_font = fitting(&panel.x.label, AXIS_FONT, room);
    let axis_font = fitting(&panel.y.label, axis_font, high - HEADING);
    chart
        .configure_mesh()
        .bold_line_style(GRID_COLOUR.stroke_width(GRID))
        .light_line_style(GRID_COLOUR.stroke_width(GRID))
        .axis_style(BLACK.stroke_width(FRAME))
        .set_all_tick_mark_size(tenths(TICK))
        .label_style(font(TICK_FONT))
        .axis_desc_style(font(axis_font))
        .x_desc(panel.x.label.as_str())
        .y_desc(panel.y.label.as_str())
        .draw()?;
    let (columns, rows) = chart.plotting_area().get_pixel_range();
    let frame = Frame {
        area,
        x,
        y,
        rect: Rect {
            left: columns.start,
            top: rows.start,
            width: columns.end - columns.start,
            height: rows.end - rows.start,
        },
        map: |point: Point| chart.backend_coord(&point),
    };
    frame.fill(panel)?;
    match bar {
        Some((bar, span, ticks)) => colour_bar(area, bar, &span, &ticks, frame.rect, axis_font),
        None => Ok(()),
    }
}

/// Draws a bar of colours at the right of a frame.
fn colour_bar(
    area: &Area,
    bar: &ColourBar,
    span: &Span,
    ticks: &[Tick],
    frame: Rect,
    axis_font: f64,
) -> Result<(), PlotError> {
    let tenths = |pixels: f64| (pixels * TENTHS).round() as i32;
    let left = frame.left + frame.width + tenths(BAR_APART);
    let right = left + tenths(BAR);
    let bottom = frame.top + frame.height;
    let place = |part: f64| bottom - (part * f64::from(frame.height)).round() as i32;
    let steps = bar.colours.len().max(1) as f64;
    for (index, colour) in bar.colours.iter().enumerate() {
        let [from, to] = [index, index + 1].map(|edge| place(edge as f64 / steps));
        area.draw(&Rectangle::new([(left, to), (right, from)], colour.pen().filled()))?;
    }
    let edge = [(left, frame.top), (right, bottom)];
    area.draw(&Rectangle::new(edge, BLACK.stroke_width(FRAME)))?;
    let font = |pixels: f64| -> FontDesc { ("sans-serif", pixels * TENTHS).into_font() };
    let style = font(TICK_FONT).color(&BLACK).pos(Pos::new(HPos::Left, VPos::Center));
    let mut widest = 0.0_f64;
    for (value, text) in ticks {
        let y = place((value - span.low()) / span.length());
        let tick = vec![(right, y), (right + tenths(TICK), y)];
        area.draw(&PathElement::new(tick, BLACK.stroke_width(FRAME)))?;
        area.draw_text(text, &style, (right + tenths(TICK + 3.0), y))?;
        widest = widest.max(width(text) * TICK_FONT);
    }
    let font = font(axis_font).transform(FontTransform::Rotate270);
    let style = font.color(&BLACK).pos(Pos::new(HPos::Center, VPos::Center));
    let beside = right + tenths(TICK + widest + 0.5 * BAR_BESIDE + 2.0);
    Ok(area.draw_text(&bar.label, &style, (beside, frame.top + frame.height / 2))?)
}

fn span(panel: &Panel, range: &Option<(f64, f64)>, part: impl Fn(Point) -> f64) -> Span {
    match range {
        Some((one, other)) => Span::new(*one, *other),
        None => Span::around(panel.series.iter().flat_map(|series| series.points()).map(part)),
    }
}

impl<F: Fn(Point) -> (i32, i32)> Frame<'_, '_, F> {
    fn fill(&self, panel: &Panel) -> Result<(), PlotError> {
        let Rect {
            left,
            top,
            width,
            height,
        } = self.rect;
        if panel.series.iter().all(|series| series.is_empty()) {
            let font: FontDesc = ("sans-serif", AXIS_FONT * TENTHS).into_font();
            let style = font.color(&BLACK).pos(Pos::new(HPos::Center, VPos::Center));
            self.area
                .draw_text("no points", &style, (left + width / 2, top + height / 2))?;
        }
        let mut room = self.room(panel);
        for series in &panel.series {
            match &series.shape {
                Shape::Dots { points, marker } => self.dots(points, marker)?,
                Shape::Line { points, stroke } => self.line(points, stroke)?,
                Shape::Marked {
                    points,
                    stroke,
                    marked,
                    marker,
                } => {
                    self.line(points, stroke)?;
                    self.dots(marked, marker)?;
                }
                Shape::Verticals { at, stroke } => {
                    for x in at {
                        self.line(&[(*x, self.y.low()), (*x, self.y.high())], stroke)?;
                    }
                }
                Shape::Horizontals { at, stroke } => {
                    for y in at {
                        self.line(&[(self.x.low(), *y), (self.x.high(), *y)], stroke)?;
                    }
                }
                Shape::Bands { spans, colour } => {
                    for (from, to) in spans.iter().filter(|(from, to)| from.is_finite() && to.is_finite()) {
                        let side = |x: f64| x.clamp(self.x.low(), self.x.high());
                        let corners = [(side(*from), self.y.high()), (side(*to), self.y.low())].map(&self.map);
                        let style = colour.pen().mix(SHADE).filled();
                        self.area.draw(&Rectangle::new(corners, style))?;
                    }
                }
                Shape::Cells { corners, colour } => {
                    let inside = |(x, y): Point| {
                        let x = x.clamp(self.x.low(), self.x.high());
                        (x, y.clamp(self.y.low(), self.y.high()))
                    };
                    for ends in corners {
                        let ends = ends.map(inside).map(&self.map);
                        self.area.draw(&Rectangle::new(ends, colour.pen().filled()))?;
                    }
                }
                Shape::Marks { marks, marker } => self.marks(marks, marker, &mut room)?,
            }
        }
        let corners = [(left, top), (left + width, top + height)];
        self.area.draw(&Rectangle::new(corners, BLACK.stroke_width(FRAME)))?;
        Ok(())
    }

    /// What labels should not hide: marks, points and lines. Guide lines may be crossed.
    fn room(&self, panel: &Panel) -> Room {
        let mut room = Room::new(self.rect);
        let is_labelled = |mark: &Mark| !mark.label.is_empty();
        let shapes = || panel.series.iter().map(|series| &series.shape);
        let labelled = |shape: &Shape| matches!(shape, Shape::Marks { marks, .. } if marks.iter().any(is_labelled));
        if !shapes().any(labelled) {
            return room;
        }
        for shape in shapes() {
            match shape {
                Shape::Marks { marks, marker } => {
                    let side = marker.size * 1.2 * TENTHS;
                    room.keep_apart((side / 2.0) as i32 + 5);
                    let shown = marks.iter().filter(|mark| self.shows(&mark.at));
                    let around = side as i32 + 2 * NEAR;
                    shown.for_each(|mark| room.take(Rect::around((self.map)(mark.at), around)));
                }
                Shape::Dots { points, .. } => {
                    let shown = points.iter().filter(|point| self.shows(point));
                    let known: HashSet<(i32, i32)> = shown.map(|point| (self.map)(*point)).collect();
                    known.into_iter().for_each(|at| room.take(Rect::around(at, DOT)));
                }
                Shape::Line { points, .. } | Shape::Marked { points, .. } => {
                    for piece in clip::pieces(points, &self.x, &self.y) {
                        let grid: Vec<(i32, i32)> = piece.into_iter().map(&self.map).collect();
                        for ends in grid.windows(2) {
                            along(ends[0], ends[1]).for_each(|at| room.take(Rect::around(at, DOT)));
                        }
                    }
                }
                _ => {}
            }
        }
        room
    }

    /// Each point of the grid once.
    fn dots(&self, points: &[Point], marker: &Marker) -> Drawn {
        let mut known = HashSet::new();
        for point in points.iter().filter(|point| self.shows(point)) {
            let at = (self.map)(*point);
            if known.insert(at) {
                marker.draw(self.area, at)?;
            }
        }
        Ok(())
    }

    /// Each stretch of the grid once: the dashes of two lines on each other would fill each other's gaps.
    fn line(&self, points: &[Point], stroke: &Stroke) -> Drawn {
        let mut known = HashSet::new();
        for piece in clip::pieces(points, &self.x, &self.y) {
            let mut grid: Vec<(i32, i32)> = piece.into_iter().map(&self.map).collect();
            grid.dedup();
            let mut drawn = |ends: &[(i32, i32)]| !known.insert((ends[0].min(ends[1]), ends[0].max(ends[1])));
            let mut part: Vec<(i32, i32)> = grid.first().copied().into_iter().collect();
            for ends in grid.windows(2) {
                if drawn(ends) {
                    if part.len() > 1 {
                        line(self.area, stroke, &part)?;
                    }
                    part.clear();
                }
                part.push(ends[1]);
            }
            if part.len() > 1 || grid.len() == 1 {
                line(self.area, stroke, &part)?;
            }
        }
        Ok(())
    }

    fn marks(&self, marks: &[Mark], marker: &Marker, room: &mut Room) -> Drawn {
        let font: FontDesc = ("sans-serif", LABEL_FONT * TENTHS).into_font();
        let style = font.color(&BLACK).pos(Pos::new(HPos::Left, VPos::Center));
        for mark in marks.iter().filter(|mark| self.shows(&mark.at)) {
            let at = (self.map)(mark.at);
            marker.draw(self.area, at)?;
            if mark.label.is_empty() {
                continue;
            }
            let size = [width(&mark.label) * LABEL_FONT + 4.0, LABEL_FONT * 1.2].map(|side| (side * TENTHS) as i32);
            let place = room.place(at, (size[0], size[1]));
            let corners = [
                (place.left, place.top),
                (place.left + place.width, place.top + place.height),
            ];
            self.area.draw(&Rectangle::new(corners, WHITE.mix(0.8).filled()))?;
            if let Some(ends) = room.leader(&place, at) {
                self.area
                    .draw(&PathElement::new(ends.to_vec(), BLACK.stroke_width(LEADER)))?;
            }
            self.area
                .draw_text(&mark.label, &style, (place.left + 20, place.top + place.height / 2))?;
        }
        Ok(())
    }

    fn shows(&self, (x, y): &Point) -> bool {
        self.x.contains(*x) && self.y.contains(*y)
    }
}

/// Points of the grid from one to another, close enough for none to be missed.
fn along(from: (i32, i32), to: (i32, i32)) -> impl Iterator<Item = (i32, i32)> {
    let steps = ((to.0 - from.0).abs().max((to.1 - from.1).abs()) / DOT).max(1);
    (0..=steps).map(move |step| {
        let at = |from: i32, to: i32| from + (to - from) * step / steps;
        (at(from.0, to.0), at(from.1, to.1))
    })
}
