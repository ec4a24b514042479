//! Dual numbers of num-dual that carry several derivatives at once, over f64.
//!
//! One pass gives `N` columns of a Jacobian where `Dual<f64>` gives one.

use super::{Analytic, Field};
use num_dual::{DualNum, DualSVec64};

/// A value with its derivatives by `N` variables.
pub type Gradient<const N: usize> = DualSVec64<N>;

impl<const N: usize> Field for Gradient<N> {
    fn from_integer(value: i64) -> Self {
        Self::from_re(value as f64)
    }
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        Self::from_re(numerator as f64 / denominator as f64)
    }
}

impl<const N: usize> Analytic for Gradient<N> {
    fn pi() -> Self {
        Self::from_re(std::f64::consts::PI)
    }
    fn sqrt(&self) -> Self {
        DualNum::sqrt(self)
    }
    fn sincos(&self) -> (Self, Self) {
        DualNum::sin_cos(self)
    }
    fn acos(&self) -> Self {
        DualNum::acos(self)
    }
    fn atan2(&self, x: &Self) -> Self {
        DualNum::atan2(self, *x)
    }
    fn powf(&self, exponent: &Self) -> Self {
        DualNum::powd(self, *exponent)
    }
    fn from_f64(value: f64) -> Self {
        Self::from_re(value)
    }
    fn to_f64(&self) -> f64 {
        self.re
    }
    fn constant(&self) -> Self {
        Self::from_re(self.re)
    }
    fn epsilon() -> Self {
        Self::from_re(f64::EPSILON)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Dual, seeded};
    use super::*;
    use nalgebra::{Const, U1};

    fn function<T: Analytic>(x: &T, y: &T) -> T {
        let (sin, cos) = (x.clone() * y.clone()).sincos();
        (sin + T::from_ratio(7, 3)).sqrt() / y.clone() + cos.acos() * x.atan2(y) - y.powf(x)
    }

    #[test]
    fn each_derivative_is_that_of_one_dual_number() {
        let (x, y) = (0.7, 1.3);
        let both = function(
            &Gradient::<2>::from_re(x).derivative(0),
            &Gradient::<2>::from_re(y).derivative(1),
        );
        let slopes = both.eps.unwrap_generic(Const::<2>, U1);
        let by_x = function(&seeded(x), &Dual::from_re(y));
        let by_y = function(&Dual::from_re(x), &seeded(y));
        assert!((both.re - by_x.re).abs() < 1e-15);
        assert!((slopes[0] - by_x.eps).abs() < 1e-14 && (slopes[1] - by_y.eps).abs() < 1e-14);
    }
}
