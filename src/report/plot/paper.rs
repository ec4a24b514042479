//! Where `plotters` draws: an SVG with coordinates in tenths of a pixel, like shapes joined in one path.
//!
//! The backend that comes with `plotters` writes an element for each point, on whole pixels: a diagram of some
//! thousand impacts would take megabytes and show steps.

use super::TENTHS;
use super::text::{typeset, width};
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind};
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontStyle,
    FontTransform,
};
use std::convert::Infallible;
use std::fmt::Write;

/// An area of the paper, and what drawing on it answers.
pub(super) type Area<'a> = DrawingArea<Paper<'a>, Shift>;
pub(super) type Drawn = Result<(), DrawingAreaErrorKind<Infallible>>;

/// A figure that cannot be laid out.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the figure cannot be drawn: {0}")]
pub struct PlotError(pub(super) String);

impl From<DrawingAreaErrorKind<Infallible>> for PlotError {
    fn from(error: DrawingAreaErrorKind<Infallible>) -> Self {
        Self(error.to_string())
    }
}

type Done = Result<(), DrawingErrorKind<Infallible>>;

/// The family that all text is in.
const FAMILY: &str = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

/// How far below its anchor the base line of text is, in units of the font's size.
const BELOW_TOP: f64 = 0.76;
const BELOW_MIDDLE: f64 = 0.35;
const ABOVE_BOTTOM: f64 = 0.24;

/// An SVG being written.
pub(super) struct Paper<'a> {
    out: &'a mut String,
    size: (u32, u32),
    path: Option<Path>,
}

/// Shapes of one look, not yet written.
struct Path {
    look: Look,
    data: String,
    at: BackendCoord,
}

#[derive(Clone, Copy, PartialEq)]
enum Look {
    Stroke {
        colour: Ink,
        width: u32,
    },
    /// Circles so wide.
    Dots {
        colour: Ink,
        width: u32,
    },
    Fill {
        colour: Ink,
    },
    /// Rectangles, of which neighbours leave no seam.
    Cells {
        colour: Ink,
    },
}

#[derive(Clone, Copy, PartialEq)]
struct Ink {
    rgb: (u8, u8, u8),
    alpha: f64,
}

impl From<BackendColor> for Ink {
    fn from(colour: BackendColor) -> Self {
        Self {
            rgb: colour.rgb,
            alpha: colour.alpha,
        }
    }
}

impl Ink {
    fn hex(self) -> String {
        let (red, green, blue) = self.rgb;
        if red % 17 == 0 && green % 17 == 0 && blue % 17 == 0 {
            return format!("#{:x}{:x}{:x}", red / 17, green / 17, blue / 17);
        }
        format!("#{red:02x}{green:02x}{blue:02x}")
    }

    fn opacity(self, of: &str) -> String {
        if self.alpha < 1.0 {
            format!(" {of}-opacity=\"{:.2}\"", self.alpha)
        } else {
            String::new()
        }
    }
}

impl<'a> Paper<'a> {
    /// White paper so many pixels wide and high, whose SVG goes to `out`.
    pub fn new(out: &'a mut String, (width, height): (f64, f64)) -> Self {
        let size = [width, height].map(|side| (side * TENTHS).round() as u32);
        let tenths = TENTHS as u32;
        push(
            out,
            format_args!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\" font-family=\"{FAMILY}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
                size[0].div_ceil(tenths),
                size[1].div_ceil(tenths),
                size[0],
                size[1]
            ),
        );
        Self {
            out,
            size: (size[0], size[1]),
            path: None,
        }
    }

    /// The path of this look, started at `to` or moved there.
    fn moved(&mut self, look: Look, to: BackendCoord) -> &mut Path {
        let continued = self.path.as_ref().is_some_and(|path| path.look == look);
        if continued {
            // a closed shape leaves its end open to doubt: begin anew by an absolute move
            let path = self.path.get_or_insert_with(|| Path::new(look, to));
            path.move_to(to);
            return path;
        }
        self.flush();
        self.path.insert(Path::new(look, to))
    }

    /// Writes the shapes that wait.
    fn flush(&mut self) {
        let Some(Path { look, data, .. }) = self.path.take() else {
            return;
        };
        match look {
            Look::Stroke { colour, width } => push(
                self.out,
                format_args!(
                    "<path fill=\"none\" stroke=\"{}\"{} stroke-width=\"{width}\" d=\"{data}\"/>\n",
                    colour.hex(),
                    colour.opacity("stroke")
                ),
            ),
            Look::Dots { colour, width } => push(
                self.out,
                format_args!(
                    "<path stroke=\"{}\"{} stroke-width=\"{width}\" stroke-linecap=\"round\" d=\"{data}\"/>\n",
                    colour.hex(),
                    colour.opacity("stroke")
                ),
            ),
            Look::Fill { colour } | Look::Cells { colour } => push(
                self.out,
                format_args!(
                    "<path fill=\"{}\"{}{} d=\"{data}\"/>\n",
                    colour.hex(),
                    colour.opacity("fill"),
                    match look {
                        Look::Cells { .. } => " shape-rendering=\"crispEdges\"",
                        _ => "",
                    }
                ),
            ),
        }
    }
}

/// Writing to a string does not fail.
fn push(out: &mut String, text: std::fmt::Arguments) {
    let _ = out.write_fmt(text);
}

impl Path {
    fn new(look: Look, (x, y): BackendCoord) -> Self {
        Self {
            look,
            data: format!("M{x} {y}"),
            at: (x, y),
        }
    }

    /// Two numbers, parted by a sign or a space.
    fn pair(&mut self, command: char, (x, y): (i32, i32)) {
        self.data.push(command);
        let space = if y < 0 { "" } else { " " };
        push(&mut self.data, format_args!("{x}{space}{y}"));
    }

    fn move_to(&mut self, to: BackendCoord) {
        self.pair('m', (to.0 - self.at.0, to.1 - self.at.1));
        self.at = to;
    }

    fn line_to(&mut self, to: BackendCoord) {
        if to != self.at {
            self.pair('l', (to.0 - self.at.0, to.1 - self.at.1));
            self.at = to;
        }
    }
}

impl DrawingBackend for Paper<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Done {
        Ok(())
    }

    fn present(&mut self) -> Done {
        self.flush();
        Ok(())
    }

    fn draw_pixel(&mut self, point: BackendCoord, color: BackendColor) -> Done {
        let look = Look::Fill { colour: color.into() };
        self.moved(look, point).data.push_str("h1v1h-1z");
        Ok(())
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Done {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (left, top): BackendCoord,
        (right, bottom): BackendCoord,
        style: &S,
        fill: bool,
    ) -> Done {
        let colour = style.color().into();
        let look = if fill {
            Look::Cells { colour }
        } else {
            Look::Stroke {
                colour,
                width: style.stroke_width(),
            }
        };
        let path = self.moved(look, (left, top));
        let (width, height) = (right - left, bottom - top);
        push(&mut path.data, format_args!("h{width}v{height}h{}z", -width));
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Done {
        let mut points = path.into_iter();
        let Some(first) = points.next() else { return Ok(()) };
        let look = Look::Stroke {
            colour: style.color().into(),
            width: style.stroke_width(),
        };
        let path = self.moved(look, first);
        points.for_each(|point| path.line_to(point));
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(&mut self, (x, y): BackendCoord, radius: u32, style: &S, fill: bool) -> Done {
        let colour = style.color().into();
        if fill {
            let look = Look::Dots {
                colour,
                width: 2 * radius,
            };
            self.moved(look, (x, y)).data.push_str("h0");
            return Ok(());
        }
        let look = Look::Stroke {
            colour,
            width: style.stroke_width(),
        };
        let (r, across) = (radius as i32, 2 * radius as i32);
        let path = self.moved(look, (x - r, y));
        push(
            &mut path.data,
            format_args!("a{r} {r} 0 1 0 {across} 0a{r} {r} 0 1 0 {} 0", -across),
        );
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, vert: I, style: &S) -> Done {
        let mut corners = vert.into_iter();
        let Some(first) = corners.next() else { return Ok(()) };
        let look = Look::Fill {
            colour: style.color().into(),
        };
        let path = self.moved(look, first);
        corners.for_each(|corner| path.line_to(corner));
        path.data.push('z');
        // closing returns to the first corner
        path.at = first;
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, (x, y): BackendCoord) -> Done {
        self.flush();
        let size = style.size();
        let drop = match style.anchor().v_pos {
            VPos::Top => BELOW_TOP,
            VPos::Center => BELOW_MIDDLE,
            VPos::Bottom => -ABOVE_BOTTOM,
        };
        let anchor = match style.anchor().h_pos {
            HPos::Left => "",
            HPos::Center => " text-anchor=\"middle\"",
            HPos::Right => " text-anchor=\"end\"",
        };
        let turned = match style.transform() {
            FontTransform::None => 0,
            FontTransform::Rotate90 => 90,
            FontTransform::Rotate180 => 180,
            FontTransform::Rotate270 => -90,
        };
        let turn = match turned {
            0 => String::new(),
            degrees => format!(" transform=\"rotate({degrees} {x} {y})\""),
        };
        let weight = match style.style() {
            FontStyle::Bold => " font-weight=\"bold\"",
            _ => "",
        };
        let ink = Ink::from(style.color());
        let fill = match ink.rgb {
            (0, 0, 0) => String::new(),
            _ => format!(" fill=\"{}\"", ink.hex()),
        };
        let base = y + (drop * size).round() as i32;
        push(
            self.out,
            format_args!(
                "<text x=\"{x}\" y=\"{base}\" font-size=\"{size}\"{anchor}{weight}{fill}{turn}>{}</text>\n",
                typeset(text, size)
            ),
        );
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let size = style.size();
        Ok(((width(text) * size).ceil() as u32, size.ceil() as u32))
    }
}

impl Drop for Paper<'_> {
    fn drop(&mut self) {
        self.flush();
        self.out.push_str("</svg>\n");
    }
}
