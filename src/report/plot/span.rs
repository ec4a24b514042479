//! What an axis shows.

/// An interval of finite numbers, longer than nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    low: f64,
    high: f64,
}

/// How much longer than the data an axis is, at each end.
const MARGIN: f64 = 0.04;

/// How far an axis reaches to each side of a number that is alone, relative to it.
const ALONE: f64 = 0.05;

/// Beyond this size numbers are not drawn: their differences might overflow.
const LARGEST: f64 = 1e300;

impl Span {
    /// From one end to the other, in either order. An interval so short that f64 could not part it is made longer;
    /// what is not finite gives 0 to 1.
    pub fn new(one: f64, other: f64) -> Self {
        let (low, high) = (one.min(other), one.max(other));
        if !(one.abs() <= LARGEST && other.abs() <= LARGEST) {
            return Self { low: 0.0, high: 1.0 };
        }
        let least = low.abs().max(high.abs()) * 1e-9;
        if high - low > least {
            return Self { low, high };
        }
        let half = match low.abs() {
            _ if high > low => least,
            0.0 => 1.0,
            size => size * ALONE,
        };
        let middle = low + (high - low) / 2.0;
        Self {
            low: middle - half,
            high: middle + half,
        }
    }

    /// Around all finite `values`, with a margin; 0 to 1 where there is none.
    pub fn around(values: impl Iterator<Item = f64>) -> Self {
        let finite = values.filter(|value| value.abs() <= LARGEST);
        let ends = finite.fold(None, |ends: Option<(f64, f64)>, value| {
            Some(ends.map_or((value, value), |(low, high)| (low.min(value), high.max(value))))
        });
        let Some((low, high)) = ends else {
            return Self::new(0.0, 1.0);
        };
        let span = Self::new(low, high);
        let margin = MARGIN * span.length();
        Self::new(span.low - margin, span.high + margin)
    }

    pub fn low(&self) -> f64 {
        self.low
    }

    pub fn high(&self) -> f64 {
        self.high
    }

    pub fn length(&self) -> f64 {
        self.high - self.low
    }

    pub fn contains(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_holds_its_data_with_a_margin() {
        let span = Span::around([0.5, f64::NAN, 0.1, f64::INFINITY].into_iter());
        assert!(span.low() < 0.1 && span.low() > 0.08 && span.high() > 0.5 && span.high() < 0.52);
    }

    #[test]
    fn no_data_or_one_number_still_give_an_axis() {
        assert_eq!(Span::around(std::iter::empty()), Span::new(0.0, 1.0));
        for value in [0.0, 3.0, -1e-20, 1e299, 1e300] {
            let span = Span::around([value].into_iter());
            assert!(span.length() > 0.0 && span.length().is_finite(), "{span:?}");
        }
        assert_eq!(Span::new(f64::NAN, 1.0), Span::new(1.0, 0.0));
    }
}
