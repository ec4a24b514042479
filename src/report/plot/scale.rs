//! An axis as `plotters` lays it out: where a number goes, where the ticks are, what stands at them.

use super::span::Span;
use super::ticks::Tick;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use std::ops::Range;

/// What an axis shows, with its ticks.
#[derive(Clone, Debug)]
pub(super) struct Scale {
    pub span: Span,
    pub ticks: Vec<Tick>,
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let part = (value - self.span.low()) / self.span.length();
        // a number far out of the span must not leave the range of the grid
        let part = part.clamp(-10.0, 10.0);
        (f64::from(from) + part * (f64::from(to) - f64::from(from))).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            Vec::new()
        } else {
            self.ticks.iter().map(|tick| tick.0).collect()
        }
    }

    fn range(&self) -> Range<f64> {
        self.span.low()..self.span.high()
    }
}

impl ValueFormatter<f64> for Scale {
    fn format_ext(&self, value: &f64) -> String {
        let own = self.ticks.iter().find(|tick| tick.0 == *value);
        own.map_or(String::new(), |tick| tick.1.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_an_axis_are_those_of_the_frame() {
        let span = Span::new(0.1, 0.5);
        let ticks = Vec::new();
        let scale = Scale { span, ticks };
        let places = [0.1, 0.5, 0.3, 1e300, f64::NAN].map(|value| scale.map(&value, (1000, 200)));
        assert_eq!(places, [1000, 200, 600, -7000, 0]);
    }
}
