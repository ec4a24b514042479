//! Data to an SVG or PNG: panels with axes, series and a legend, in one [`Figure`]. Knows of no scene and no ball.
//!
//! The layout is that of `plotters`; what is written is ours: text that can be searched, coordinates to a
//! tenth of a pixel, a cloud of points in one path. The same data give the same bytes.
//!
//! ```
//! use vibro_audit::report::plot::{Axis, Colour, Dash, Figure, Panel, Series, Stroke};
//!
//! let stroke = Stroke { colour: Colour::Blue, dash: Dash::Solid, width: 1.5 };
//! let line = Series::line("Z", vec![(0.0, 0.0), (1.0, 0.5)], stroke);
//! let panel = Panel { series: vec![line], ..Panel::new(Axis::new("t (1)"), Axis::new("Z (1)")) };
//! let svg = Figure::new("A flight", vec![panel]).svg()?;
//! assert!(svg.starts_with("<svg ") && svg.contains("A flight"));
//! # Ok::<(), vibro_audit::report::plot::PlotError>(())
//! ```

mod clip;
mod colour;
mod dash;
mod draw;
mod figure;
mod label;
mod legend;
mod marker;
mod panel;
mod paper;
mod png;
mod scale;
mod series;
mod span;
mod text;
mod ticks;

pub use colour::Colour;
pub use dash::Dash;
pub use figure::Figure;
pub use marker::{Form, Marker};
pub use panel::{Axis, ColourBar, Panel};
pub use paper::PlotError;
pub use series::{Mark, Point, Series, Shape, Stroke};
pub(super) use text::{Level, pieces};
pub use ticks::{Ticks, round_edges};

/// Pixels are counted in tenths: one on the drawing's own grid is a tenth of one on the page.
const TENTHS: f64 = 10.0;
