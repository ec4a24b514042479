//! Capsule and ball over time.

use super::portrait::Path;
use crate::report::plot::{Axis, Colour, Dash, Marker, Panel, Point, Series, Stroke};

/// The ends of a capsule `gap` long, the ball, and where the ball is at each impact (time and place).
pub fn displacement(path: &Path, gap: f64, impacts: &[Point]) -> Panel {
    let mut panel = Panel::new(
        Axis::new("time $t$  [$\u{3c0}/\u{3c9}$]"),
        Axis::new("displacement  [$A\u{3c0}\u{b2}/(M\u{3c9}\u{b2})$]"),
    );
    panel.heading = "Motion of capsule and ball".to_owned();
    let over_time = |values: &[f64], off: f64| -> Vec<Point> {
        let values = values.iter().map(|value| value + off);
        path.times.iter().copied().zip(values).collect()
    };
    let stroke = |colour, dash, width| Stroke { colour, dash, width };
    // Z = X - x is +d/2 at the bottom: the ball is then d/2 below the middle
    panel.series = vec![
        Series::line(
            "top of the capsule",
            over_time(&path.capsule, gap / 2.0),
            stroke(Colour::Blue, Dash::Solid, 1.4),
        ),
        Series::line(
            "bottom of the capsule",
            over_time(&path.capsule, -gap / 2.0),
            stroke(Colour::Blue, Dash::Dashed, 1.4),
        ),
        Series::line(
            "ball",
            over_time(&path.ball, 0.0),
            stroke(Colour::Vermillion, Dash::Solid, 2.0),
        ),
        Series::dots("impacts", impacts.to_vec(), Marker::dot(Colour::Black, 5.0)),
    ];
    panel
}
