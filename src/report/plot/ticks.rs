//! Where an axis has its ticks, and what stands at them.

use super::span::Span;
use std::f64::consts::PI;

/// The form of the numbers of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Ticks {
    /// Decimals: 1, 2 or 5 times a power of ten apart.
    #[default]
    Decimals,
    /// Multiples and simple fractions of pi.
    Pi,
    /// Powers of ten of numbers whose logarithms (to base 10) are drawn.
    Powers,
    /// The same where minus the logarithms are drawn, so that the numbers fall from left to right.
    FallingPowers,
}

/// A tick: where it is, and what stands there.
pub(super) type Tick = (f64, String);

/// The powers of ten of a step that are written out in digits.
const PLAIN: std::ops::RangeInclusive<i32> = -6..=4;

/// The fractions of pi that a step may be.
const FRACTIONS: [i32; 5] = [12, 6, 4, 2, 1];

/// The numbers between two powers of ten that have ticks where few powers are shown.
const BETWEEN: [f64; 3] = [1.0, 2.0, 5.0];

impl Ticks {
    /// Returns at most `most` ticks, at least 2 where there is room for them.
    pub(super) fn over(self, span: &Span, most: usize) -> Vec<Tick> {
        match self {
            Self::Decimals => decimals(span, most),
            Self::Pi => fractions_of_pi(span, most),
            Self::Powers => powers(span, most, 1.0),
            Self::FallingPowers => powers(span, most, -1.0),
        }
    }
}

/// Ticks at round numbers, each the nearest f64, with as many decimals as the step has.
fn decimals(span: &Span, most: usize) -> Vec<Tick> {
    let (factor, power) = round_step(span.length() / most.max(1) as f64);
    let step = factor * decimal(1.0, power);
    multiples(span, step)
        .map(|number| decimal(number * factor, power))
        .filter(|value| span.contains(*value))
        .map(|value| (value, label(value, power)))
        .collect()
}

/// Returns the least of 1, 2, 5 times a power of ten that is `rough` or more: the factor and the power.
fn round_step(rough: f64) -> (f64, i32) {
    let power = rough.log10().floor() as i32;
    let mut factors = [1.0, 2.0, 5.0].into_iter();
    match factors.find(|factor| factor * decimal(1.0, power) >= rough) {
        Some(factor) => (factor, power),
        None => (1.0, power + 1),
    }
}

/// The numbers by which a step is to be multiplied to lie in a span.
fn multiples(span: &Span, step: f64) -> impl Iterator<Item = f64> + use<> {
    let first = (span.low() / step).ceil();
    let count = ((span.high() / step).floor() - first).clamp(0.0, 1000.0) as u32;
    (0..=count).map(move |number| first + f64::from(number))
}

/// Returns the text of a tick, with as many decimals as the step has.
fn label(value: f64, power: i32) -> String {
    // -0 is 0
    let value = if value == 0.0 { 0.0 } else { value };
    let text = if PLAIN.contains(&power) {
        format!("{value:.*}", usize::try_from(-power).unwrap_or(0))
    } else {
        // fifteen figures hide the rounding of the last
        let short: f64 = format!("{value:.14e}").parse().unwrap_or(value);
        format!("{short:e}")
    };
    signed(&text)
}

fn signed(text: &str) -> String {
    text.replace('-', "\u{2212}")
}

/// Ticks at multiples of a simple fraction of pi; decimals where the span is too short or too long for these.
fn fractions_of_pi(span: &Span, most: usize) -> Vec<Tick> {
    let rough = span.length() / PI / most.max(1) as f64;
    let step = FRACTIONS.into_iter().find(|parts| 1.0 / f64::from(*parts) >= rough);
    let Some(parts) = step.filter(|parts| span.length() > 2.0 * PI / f64::from(*parts)) else {
        return decimals(span, most);
    };
    multiples(span, PI / f64::from(parts))
        .map(|number| (number * PI / f64::from(parts), of_pi(number as i32, parts)))
        .filter(|(value, _)| span.contains(*value))
        .collect()
}

/// A fraction of pi in lowest terms.
fn of_pi(number: i32, parts: i32) -> String {
    let divides = |divisor: &i32| number % divisor == 0 && parts % divisor == 0;
    let common = (1..=parts).rev().find(divides).unwrap_or(1);
    let above = match number / common {
        0 => return "0".to_owned(),
        1 => "\u{3c0}".to_owned(),
        -1 => "-\u{3c0}".to_owned(),
        number => format!("{number}\u{3c0}"),
    };
    signed(&match parts / common {
        1 => above,
        below => format!("{above}/{below}"),
    })
}

/// Ticks at powers of ten, and between them where few are shown; `sign` is -1 where minus the logarithms are drawn.
fn powers(span: &Span, most: usize, sign: f64) -> Vec<Tick> {
    let (factor, power) = round_step((span.length() / most.max(1) as f64).max(1.0));
    let step = factor * decimal(1.0, power);
    let whole: Vec<f64> = multiples(span, step).map(|number| number * step).collect();
    if whole.len() > 2 || span.length() > DECADES {
        let text = |at: f64| signed(&format!("$10^{}$", sign * at + 0.0));
        return whole.into_iter().map(|at| (at, text(at))).collect();
    }
    let from = (sign * span.low()).min(sign * span.high()).floor() as i32;
    let decades = (from..=from.saturating_add(2)).flat_map(|power| BETWEEN.map(|factor| (factor, power)));
    decades
        .map(|(factor, power)| (sign * (factor.log10() + f64::from(power)), factor, power))
        .filter(|(at, ..)| span.contains(*at))
        .map(|(at, factor, power)| match power {
            -3..=4 => (at, decimal(factor, power).to_string()),
            _ => (at, signed(&format!("${factor}\u{b7}10^{power}$"))),
        })
        .collect()
}

/// Over more powers of ten only these have ticks.
const DECADES: f64 = 2.5;

/// The most steps of a scale of colours; there are 10 or more.
const STEPS: f64 = 24.0;

/// Returns the edges of equal steps of a round length over all finite values, so that 0 between them is one.
pub fn round_edges(values: &[f64]) -> Vec<f64> {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    if finite().next().is_none() {
        return Vec::new();
    }
    let (low, high) = finite().fold((f64::MAX, f64::MIN), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    let span = Span::new(low, high);
    let (factor, power) = round_step(span.length() / STEPS);
    let step = factor * decimal(1.0, power);
    // within a rounding of an edge is at it
    let (first, last) = ((span.low() / step + 1e-9).floor(), (span.high() / step - 1e-9).ceil());
    let count = (last - first).clamp(1.0, STEPS + 2.0) as u32;
    (0..=count)
        .map(|number| decimal((first + f64::from(number)) * factor, power))
        .collect()
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
        texts(Ticks::Decimals, low, high, most)
    }

    fn texts(ticks: Ticks, low: f64, high: f64, most: usize) -> Vec<String> {
        let found = ticks.over(&Span::new(low, high), most);
        found.into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn phases_are_multiples_of_pi_in_lowest_terms() {
        let halves = ["0", "\u{3c0}/2", "\u{3c0}", "3\u{3c0}/2", "2\u{3c0}"];
        assert_eq!(texts(Ticks::Pi, -0.1, 6.4, 6), halves);
        assert_eq!(texts(Ticks::Pi, -0.1, 6.4, 8), halves);
        assert_eq!(
            texts(Ticks::Pi, -0.6, 0.6, 7)[..3],
            ["\u{2212}\u{3c0}/6", "\u{2212}\u{3c0}/12", "0"]
        );
        for (low, high) in [(0.5, 0.7), (0.0, 1e6)] {
            assert_eq!(texts(Ticks::Pi, low, high, 5), texts(Ticks::Decimals, low, high, 5));
        }
    }

    #[test]
    fn logarithms_are_powers_of_ten_and_between_few_powers_other_numbers() {
        assert_eq!(texts(Ticks::Powers, 0.9, 3.1, 7), ["$10^1$", "$10^2$", "$10^3$"]);
        assert_eq!(
            texts(Ticks::FallingPowers, 0.0, 14.2, 4),
            ["$10^0$", "$10^\u{2212}5$", "$10^\u{2212}10$"]
        );
        // steps of five powers, of which only two lie within
        assert_eq!(
            texts(Ticks::FallingPowers, 0.5, 14.5, 5),
            ["$10^\u{2212}5$", "$10^\u{2212}10$"]
        );
        assert_eq!(texts(Ticks::Powers, 0.0, 1.75, 7), ["1", "2", "5", "10", "20", "50"]);
        assert_eq!(
            texts(Ticks::FallingPowers, 1.0, 2.0, 7),
            ["0.01", "0.02", "0.05", "0.1"]
        );
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
                let ticks = Ticks::Decimals.over(&span, 7);
                assert!((2..=8).contains(&ticks.len()), "{span:?} {ticks:?}");
                for (value, label) in ticks {
                    assert!(span.contains(value) && label.len() <= 12, "{label}");
                }
            }
        }
    }

    #[test]
    fn steps_of_colours_are_round_and_zero_is_an_edge() {
        let edges = round_edges(&[0.0, 80.0]);
        assert!(edges.len() == 17 && edges[1] == 5.0 && edges[16] == 80.0, "{edges:?}");
        let edges = round_edges(&[-3.1, f64::NEG_INFINITY, f64::NAN, 1.0]);
        assert_eq!((edges[0], edges[edges.len() - 1]), (-3.2, 1.0));
        assert!(edges.contains(&0.0));
        assert_eq!(round_edges(&[46.2, 144.0]).len(), 21);
        assert!(round_edges(&[f64::NAN]).is_empty());
        for alone in [0.0, 2.0, -1e-300, 1e300] {
            let edges = round_edges(&[alone, alone]);
            assert!(
                edges.windows(2).all(|pair| pair[0] < pair[1]) && edges.len() > 1,
                "{edges:?}"
            );
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
            for ticks in [Ticks::Decimals, Ticks::Pi, Ticks::Powers, Ticks::FallingPowers] {
                assert!(texts(ticks, low, high, 6).len() <= 10);
            }
        }
    }
}
