//! Sine and cosine of a small angle, less the first terms of their series.

use numbers::{Analytic, Endpoint, Field, Interval};

/// The largest angle, in size, for which [`Swing`] is meant.
pub(super) const REACH: f64 = 0.5;

/// `sin x`, `1 - cos x`, `x - sin x` and `x²/2 - 1 + cos x`, each with its full relative accuracy.
#[derive(Clone, Debug)]
pub(super) struct Swing<T> {
    pub sin: T,
    pub fall: T,
    pub lag: T,
    pub rest: T,
}

impl<T: Analytic> Swing<T> {
    /// By series; `x` at most [`REACH`] in size. `epsilon` is that of the number, which a wide one is slow to tell.
    #[inline]
    pub fn of(x: &T, epsilon: f64) -> Self {
        let square = x.clone() * x.clone();
        // written out: through a closure this takes a fifth more of each impact
        let tails = [tail(&square, 4, epsilon), tail(&square, 5, epsilon)];
        Self::from_tails(x, square, tails)
    }

    #[inline]
    fn from_tails(x: &T, square: T, [odd, even]: [T; 2]) -> Self {
        let lag = x.clone() * square.clone() * T::from_ratio(1, 6) * odd;
        let rest = square.clone() * square.clone() * T::from_ratio(1, 24) * even;
        Self {
            sin: x.clone() - lag.clone(),
            fall: square * T::from_ratio(1, 2) - rest.clone(),
            lag,
            rest,
        }
    }
}

impl<E: Endpoint> Swing<Interval<E>> {
    /// Enclosed, with what the series leaves out; `x` at most [`REACH`] in size.
    pub fn enclosing(x: &Interval<E>) -> Self {
        let square = x.square();
        let tails = [4, 5].map(|n| enclosed_tail(&square, n));
        Self::from_tails(x, square, tails)
    }
}

/// [`tail`], enclosed: its terms alternate and fall for z below 1, so that the sum lies between any two partial sums that
/// follow each other.
fn enclosed_tail<E: Endpoint>(z: &Interval<E>, n: i64) -> Interval<E> {
    let smallest = <E as Analytic>::epsilon().to_f64() / 8.0;
    let (mut sum, mut term) = (Interval::<E>::from_integer(1), Interval::<E>::from_integer(1));
    for pair in 0_i64.. {
        let first = n + 2 * pair;
        term = -(term * z.clone()) / Interval::from_integer(first * (first + 1));
        let next = sum.clone() + term.clone();
        let goes_on = term.magnitude().to_f64() > smallest;
        if !goes_on {
            return sum.hull(&next);
        }
        sum = next;
    }
    sum
}

/// `1 - z/(n(n+1)) (1 - z/((n+2)(n+3)) (1 - ...))`, to the precision of the number.
#[inline]
fn tail<T: Analytic>(z: &T, n: i64, epsilon: f64) -> T {
    let size = z.to_f64();
    if epsilon > 1e-17 {
        // z to the number of terms, over the product of the divisors, stays below 2^-53
        return if size < 1e-5 {
            terms::<T, 2>(z, n)
        } else if size < 3e-3 {
            terms::<T, 4>(z, n)
        } else {
            terms::<T, 7>(z, n)
        };
    }
    // how large the terms are is told by f64, which a wide number is slow to be read into
    let (mut sum, mut term, mut left) = (T::one(), T::one(), 1.0);
    let smallest = epsilon / 8.0;
    for pair in 0_i64.. {
        let first = n + 2 * pair;
        let divisor = first * (first + 1);
        term = -(term * z.clone()) / T::from_integer(divisor);
        sum += term.clone();
        left *= size / divisor as f64;
        // NaN ends it as well
        if left > smallest {
            continue;
        }
        break;
    }
    sum
}

/// So many terms, from the last to the first; the divisors are constants to the compiler.
#[inline]
fn terms<T: Analytic, const TERMS: i64>(z: &T, n: i64) -> T {
    let mut sum = T::one();
    for pair in (0..TERMS).rev() {
        let first = n + 2 * pair;
        sum = T::one() - z.clone() * T::from_ratio(1, first * (first + 1)) * sum;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use numbers::{DoubleDouble, Wide};

    fn exact(x: f64) -> [Wide<100>; 4] {
        let x = Wide::<100>::from_f64(x);
        let (sin, cos) = x.sincos();
        let fall = Wide::from_f64(1.0) - cos;
        let half = Wide::from_f64(0.5);
        [sin.clone(), fall.clone(), x.clone() - sin, x.clone() * x * half - fall]
    }

    fn worst<T: Analytic>(x: f64, narrow: impl Fn(&T) -> Wide<100>) -> f64 {
        let Swing { sin, fall, lag, rest } = Swing::of(&T::from_f64(x), T::epsilon().to_f64());
        let ours = [sin, fall, lag, rest];
        let apart = ours.iter().zip(exact(x)).map(|(ours, exact)| {
            let apart = (narrow(ours) - exact.clone()) / exact;
            apart.to_f64().abs()
        });
        apart.fold(0.0, f64::max)
    }

    #[test]
    fn each_keeps_its_relative_accuracy_down_to_the_smallest_angles() {
        for size in [1e-30, 1e-9, 3.1e-3, 3.2e-3, 0.0547, 0.0548, 0.2, 0.4999] {
            for x in [size, -size] {
                assert!(worst::<f64>(x, |ours| Wide::from_f64(*ours)) < 1e-15, "{x}");
                let double = |ours: &DoubleDouble| {
                    Wide::<100>::from_f64(ours.to_f64())
                        + Wide::from_f64((*ours - DoubleDouble::from_f64(ours.to_f64())).to_f64())
                };
                assert!(worst::<DoubleDouble>(x, double) < 1e-30, "{x}");
                assert!(worst::<Wide<50>>(x, |ours| ours.convert()) < 1e-49, "{x}");
            }
        }
    }
}
