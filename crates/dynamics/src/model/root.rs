//! The root of a function that is monotone between two bracketing times.

use numbers::Analytic;

/// A function's value, its slope, and the size of the terms that the value is summed from.
pub struct Sample<T> {
    /// Of the function.
    pub value: T,
    /// Its derivative.
    pub slope: T,
    /// Of the terms that the value is summed from.
    pub size: f64,
}

/// More evaluations than any precision of use needs: bisection alone halves a bracket this often.
const MOST_EVALUATIONS: usize = 1000;

/// Within this many roundings of the summed terms a value is 0 as far as the number can tell.
const NOISE_ROUNDINGS: f64 = 2.0;

/// Two times between which a function changes sign, once, and its values there.
pub struct Bracket<'a, T> {
    /// The earlier.
    pub low: &'a T,
    /// The later.
    pub high: &'a T,
    /// Of the function there.
    pub values: [f64; 2],
}

/// The root in `bracket`. Newton's method from where a straight line would cross, kept inside the bracket by
/// bisection, in the precision of `T`.
///
/// Accurate to the noise of the function divided by its slope, or to the spacing of `T`. Always ends.
pub fn root<T: Analytic>(bracket: &Bracket<T>, function: impl Fn(&T) -> Sample<T>) -> T {
    let epsilon = T::epsilon().to_f64();
    let (mut low, mut high) = (bracket.low.clone(), bracket.high.clone());
    let [below, above] = bracket.values;
    let rising = below < above;
    let part = below.abs() / (below.abs() + above.abs());
    let part = T::from_f64(if part.is_finite() { part } else { 0.5 });
    let mut time = low.clone() + (high.clone() - low.clone()) * part;
    for _ in 0..MOST_EVALUATIONS {
        let sample = function(&time);
        let value = sample.value.to_f64();
        let step = sample.value / sample.slope;
        let next = time.clone() - step.clone();
        let inside = (next.clone() - low.clone()).to_f64() >= 0.0 && (high.clone() - next.clone()).to_f64() >= 0.0;
        if value.abs() <= NOISE_ROUNDINGS * epsilon * sample.size {
            return if inside { next } else { time };
        }
        if (value < 0.0) == rising {
            low = time.clone();
        } else {
            high = time.clone();
        }
        let next = if inside { next } else { middle(&low, &high) };
        let moved = (next.clone() - time).to_f64().abs();
        time = next;
        // the middle of two neighbours is one of them
        if moved <= epsilon * time.to_f64().abs() || moved.is_nan() {
            return time;
        }
    }
    time
}

fn middle<T: Analytic>(low: &T, high: &T) -> T {
    low.clone() + (high.clone() - low.clone()) * T::from_ratio(1, 2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use numbers::{Field, Wide};

    fn cubic<T: Analytic>(x: &T, level: &T) -> Sample<T> {
        let square = x.clone() * x.clone();
        let value = square.clone() * x.clone() - level.clone();
        Sample {
            size: value.to_f64().abs() + 2.0 * level.to_f64(),
            value,
            slope: T::from_integer(3) * square,
        }
    }

    fn found<T: Analytic>(low: T, high: T, function: impl Fn(&T) -> Sample<T>) -> T {
        let values = [&low, &high].map(|at| function(at).value.to_f64());
        root(
            &Bracket {
                low: &low,
                high: &high,
                values,
            },
            function,
        )
    }

    #[test]
    fn a_root_is_found_to_the_last_digit_in_every_number() {
        assert!((found(0.0, 5.0, |x| cubic(x, &2.0)) - 2.0_f64.cbrt()).abs() < 1e-15);
        assert!((found(0.0, 5.0, |x| cubic(x, &2.0_f32)) - 2.0_f32.cbrt()).abs() < 3e-7);
        let two = Wide::<40>::from_f64(2.0);
        let cube_root = found(Wide::from_f64(0.0), Wide::from_f64(5.0), |x| cubic(x, &two));
        assert!((Field::to_power(&cube_root, 3) - two).to_f64().abs() < 1e-40);
    }

    #[test]
    fn where_the_slope_vanishes_bisection_takes_over() {
        let flat = |x: &f64| Sample {
            value: (x - 1.0).powi(3),
            slope: 3.0 * (x - 1.0).powi(2),
            size: 0.0,
        };
        assert!((found(-4.0, 3.0, flat) - 1.0).abs() < 1e-5);
        let falling = |x: &f64| Sample {
            value: 0.25 - x,
            slope: 0.0,
            size: 1.0,
        };
        assert!((found(0.0, 1.0, falling) - 0.25).abs() < 1e-15);
    }

    #[test]
    fn what_is_no_number_ends() {
        let none = |_: &f64| Sample {
            value: f64::NAN,
            slope: f64::NAN,
            size: f64::NAN,
        };
        assert!((0.0..=1.0).contains(&found(0.0, 1.0, none)));
    }
}
