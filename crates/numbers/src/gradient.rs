//! Dual numbers of num-dual that carry several derivatives at once.
//!
//! One pass gives `N` columns of a Jacobian where `Dual<T>` gives one.

use super::{Analytic, Dual, Field, seeded};
use num_dual::{DualNum, DualSVec};

/// A value with its derivatives by `N` variables.
pub type Gradient<T, const N: usize> = DualSVec<T, N>;

impl<T: Field + DualNum, const N: usize> Field for Gradient<T, N> {
    fn from_integer(value: i64) -> Self {
        Self::from_re(T::from_integer(value))
    }
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        Self::from_re(T::from_ratio(numerator, denominator))
    }
}

/// The functions of [`Dual`], with its slope for each variable.
impl<T: Analytic + DualNum, const N: usize> Analytic for Gradient<T, N> {
    fn pi() -> Self {
        Self::from_re(T::pi())
    }
    fn sqrt(&self) -> Self {
        chained(self, Analytic::sqrt(&seeded(self.re.clone())))
    }
    fn sincos(&self) -> (Self, Self) {
        let (sin, cos) = self.re.sincos();
        let (slope_of_sin, slope_of_cos) = (&self.eps * cos.clone(), &self.eps * -sin.clone());
        (Self::new(sin, slope_of_sin), Self::new(cos, slope_of_cos))
    }
    fn acos(&self) -> Self {
        chained(self, Analytic::acos(&seeded(self.re.clone())))
    }
    fn atan2(&self, x: &Self) -> Self {
        chained_twice(self, x, Analytic::atan2)
    }
    fn powf(&self, exponent: &Self) -> Self {
        chained_twice(self, exponent, Analytic::powf)
    }
    fn from_f64(value: f64) -> Self {
        Self::from_re(<T as Analytic>::from_f64(value))
    }
    fn to_f64(&self) -> f64 {
        self.re.to_f64()
    }
    fn unit() -> Self {
        Self::from_re(T::unit())
    }
    fn constant(&self) -> Self {
        Self::from_re(self.re.constant())
    }
    fn epsilon() -> Self {
        Self::from_re(<T as Analytic>::epsilon())
    }
}

/// A function of one number, of which `value` has the value and the slope.
fn chained<T: DualNum, const N: usize>(inner: &Gradient<T, N>, value: Dual<T>) -> Gradient<T, N> {
    Gradient::new(value.re, &inner.eps * value.eps)
}

/// A function of two numbers.
fn chained_twice<T: Field + DualNum, const N: usize>(
    x: &Gradient<T, N>,
    y: &Gradient<T, N>,
    function: impl Fn(&Dual<T>, &Dual<T>) -> Dual<T>,
) -> Gradient<T, N> {
    let constant = |number: &Gradient<T, N>| Dual::from_re(number.re.clone());
    let by_x = function(&seeded(x.re.clone()), &constant(y));
    let by_y = function(&constant(x), &seeded(y.re.clone()));
    Gradient::new(by_x.re, &x.eps * by_x.eps + &y.eps * by_y.eps)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Interval;
    use nalgebra::{Const, U1};

    fn function<T: Analytic>(x: &T, y: &T) -> T {
        let (sin, cos) = (x.clone() * y.clone()).sincos();
        (sin + T::from_ratio(7, 3)).sqrt() / y.clone() + cos.acos() * x.atan2(y) - y.powf(x)
    }

    #[test]
    fn each_derivative_is_that_of_one_dual_number() {
        let (x, y) = (0.7_f64, 1.3_f64);
        let both = function(
            &Gradient::<_, 2>::from_re(x).derivative(0),
            &Gradient::<_, 2>::from_re(y).derivative(1),
        );
        let slopes = both.eps.unwrap_generic(Const::<2>, U1);
        let by_x = function(&seeded(x), &Dual::from_re(y));
        let by_y = function(&Dual::from_re(x), &seeded(y));
        assert!((both.re - by_x.re).abs() < 1e-15);
        assert!((slopes[0] - by_x.eps).abs() < 1e-14 && (slopes[1] - by_y.eps).abs() < 1e-14);
    }

    #[test]
    fn over_intervals_every_derivative_is_enclosed() {
        let around = |x: f64| Interval::<f64>::new(x - 1e-3, x + 1e-3);
        let enclosed = function(
            &Gradient::<_, 2>::from_re(around(0.7)).derivative(0),
            &Gradient::<_, 2>::from_re(around(1.3)).derivative(1),
        );
        let slopes = enclosed.eps.unwrap_generic(Const::<2>, U1);
        for (x, y) in [(0.6991_f64, 1.2992_f64), (0.7, 1.3), (0.7009, 1.2993), (0.6995, 1.3009)] {
            let by_x = function(&seeded(x), &Dual::from_re(y));
            let by_y = function(&Dual::from_re(x), &seeded(y));
            assert!(enclosed.re.contains(&by_x.re));
            assert!(slopes[0].contains(&by_x.eps) && slopes[1].contains(&by_y.eps));
        }
    }
}
