//! Where an axis has its ticks, and what stands at them.

use super::span::Span;

/// Ticks at round numbers: 1, 2 or 5 times a power of ten apart.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ticks {
    /// Where, each the f64 nearest to a round number.
    pub at: Vec<f64>,
    /// The power of ten that the step is a multiple of.
    power: i32,
}

/// The powers of ten of a step that are written out in digits.
const PLAIN: std::ops::RangeInclusive<i32> = -6..=4;

impl Ticks {
    /// At most `most` ticks, at least 2 where there is room for them.
    pub fn new(span: &Span, most: usize) -> Self {
        let rough = span.length() / most.max(1) as f64;
        let mut power = rough.log10().floor() as i32;
        let mut factor = 1;
        for candidate in [1, 2, 5, 10] {
            factor = candidate;
            if f64::from(candidate) * decimal(1.0, power) >= rough {
                break;
            }
        }
        if factor == 10 {
            (factor, power) = (1, power + 1);
        }
        let step = f64::from(factor) * decimal(1.0, power);
        let first = (span.low() / step).ceil();
        let count = ((span.high() / step).floor() - first).clamp(0.0, 1000.0) as u32;
        let at = (0..=count)
            .map(|number| decimal((first + f64::from(number)) * f64::from(factor), power))
            .filter(|value| span.contains(*value))
            .collect();
        Self { at, power }
    }

    /// What stands at a tick: as many decimals as the step has, no more.
    pub fn label(&self, value: f64) -> String {
        // -0 is 0
        let value = if value == 0.0 { 0.0 } else { value };
        let text = if PLAIN.contains(&self.power) {
            format!("{value:.*}", usize::try_from(-self.power).unwrap_or(0))
        } else {
            // fifteen figures hide the rounding of the last
            let short: f64 = format!("{value:.14e}").parse().unwrap_or(value);
            format!("{short:e}")
        };
        text.replace('-', "\u{2212}")
    }
}

/// `integer` times a power of ten, rounded once where a power is exact.
fn decimal(integer: f64, power: i32) -> f64 {
    if power < 0 {
        integer / 10_f64.powi(-power)
    } else {
        integer * 10_f64.powi(power)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64, most: usize) -> Vec<String> {
        let ticks = Ticks::new(&Span::new(low, high), most);
        ticks.at.iter().map(|value| ticks.label(*value)).collect()
    }

    #[test]
    fn ticks_are_round_and_say_no_more_than_they_know() {
        assert_eq!(labels(0.1, 0.5, 5), ["0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(
            labels(-1.04, 1.04, 6),
            ["\u{2212}1.0", "\u{2212}0.5", "0.0", "0.5", "1.0"]
        );
        assert_eq!(labels(0.084, 0.516, 8), ["0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(
            labels(0.0, 70_000.0, 8),
            ["0", "10000", "20000", "30000", "40000", "50000", "60000", "70000"]
        );
    }

    #[test]
    fn no_label_shows_a_rounding_and_ticks_stay_in_the_span() {
        for exponent in -200..200 {
            for (low, high) in [(0.1, 0.7), (-0.3, 0.3), (2.9, 3.1), (-7.0, -1.0)] {
                let scale = 10_f64.powi(exponent);
                let span = Span::new(low * scale, high * scale);
                let ticks = Ticks::new(&span, 7);
                assert!((2..=8).contains(&ticks.at.len()), "{span:?} {ticks:?}");
                for value in &ticks.at {
                    let label = ticks.label(*value);
                    assert!(span.contains(*value) && label.len() <= 12, "{label}");
                }
            }
        }
    }

    #[test]
    fn extreme_spans_have_ticks_or_none_but_never_fail() {
        for (low, high) in [
            (-1e300, 1e300),
            (1e-320, 2e-320),
            (1.0, 1.0 + 1e-12),
            (0.0, f64::INFINITY),
        ] {
            assert!(labels(low, high, 6).len() <= 8);
        }
    }
}
