//! Dual numbers of num-dual as numbers of ours: derivatives through the motion itself.
//!
//! `Dual<T>` works over f32, f64, [`Wide`](super::Wide), [`Counted`](super::Counted) and over itself. It does not
//! work over [`Rational`](super::Rational): num-dual wants a sine of whatever stands inside, and exact rationals
//! have none; exact derivatives are the business of the algebra side.
//!
//! `==` and `is_zero` of num-dual look at the real part alone. Compare the parts.

use super::{Analytic, Field};
pub use num_dual::Dual;
use num_dual::DualNum;

/// The variable of a derivative: value `value`, derivative 1.
pub fn seeded<T: Field>(value: T) -> Dual<T> {
    Dual::new(value, T::one())
}

impl<T: Field + DualNum> Field for Dual<T> {
    fn from_integer(value: i64) -> Self {
        Dual::from_re(T::from_integer(value))
    }
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        // one division of the inner number, where that of dual numbers would be five operations
        Dual::from_re(T::from_ratio(numerator, denominator))
    }
}

/// The chain rule on the functions of the inner number, so that each is evaluated once. Where a function has no
/// derivative (the root at 0, the arc cosine at the ends, the angle at the origin), the dual part is what the
/// inner division by zero gives: an infinity, NaN, or `Wide`'s invalid state.
impl<T: Analytic + DualNum> Analytic for Dual<T> {
    fn pi() -> Self {
        Dual::from_re(T::pi())
    }

    fn sqrt(&self) -> Self {
        let root = Analytic::sqrt(&self.re);
        let twice = root.clone() + root.clone();
        Dual::new(root, self.eps.clone() / twice)
    }

    fn sincos(&self) -> (Self, Self) {
        let (sin, cos) = self.re.sincos();
        let slope_of_sin = cos.clone() * self.eps.clone();
        let slope_of_cos = -(sin.clone() * self.eps.clone());
        (Dual::new(sin, slope_of_sin), Dual::new(cos, slope_of_cos))
    }

    fn acos(&self) -> Self {
        // (1 - x)(1 + x) keeps its digits where 1 - x² cancels, near the ends
        let below = T::one() - self.re.clone();
        let above = T::one() + self.re.clone();
        let slope = -(self.eps.clone() / Analytic::sqrt(&(below * above)));
        Dual::new(Analytic::acos(&self.re), slope)
    }

    fn atan2(&self, x: &Self) -> Self {
        let angle = Analytic::atan2(&self.re, &x.re);
        // divided by the larger coordinate first, so that the squares cannot overflow
        let slope = if self.re.to_f64().abs() <= x.re.to_f64().abs() {
            let ratio = self.re.clone() / x.re.clone();
            let square = T::one() + ratio.clone() * ratio.clone();
            (self.eps.clone() - ratio * x.eps.clone()) / (x.re.clone() * square)
        } else {
            let ratio = x.re.clone() / self.re.clone();
            let square = T::one() + ratio.clone() * ratio.clone();
            (ratio * self.eps.clone() - x.eps.clone()) / (self.re.clone() * square)
        };
        Dual::new(angle, slope)
    }

    fn powf(&self, exponent: &Self) -> Self {
        let value = Analytic::powf(&self.re, &exponent.re);
        let one_less = exponent.re.clone() - T::one();
        let by_base = exponent.re.clone() * Analytic::powf(&self.re, &one_less) * self.eps.clone();
        // x^p ln x tends to 0 with x for p > 0, where the product itself is 0 times an infinity
        let by_exponent = if value.is_zero() {
            T::zero()
        } else {
            value.clone() * self.re.ln() * exponent.eps.clone()
        };
        Dual::new(value, by_base + by_exponent)
    }

    fn from_f64(value: f64) -> Self {
        Dual::from_re(<T as Analytic>::from_f64(value))
    }

    fn to_f64(&self) -> f64 {
        self.re.to_f64()
    }

    fn unit() -> Self {
        Dual::from_re(T::unit())
    }

    fn constant(&self) -> Self {
        Dual::from_re(self.re.constant())
    }

    fn epsilon() -> Self {
        Dual::from_re(<T as Analytic>::epsilon())
    }
}

#[cfg(test)]
mod tests {
    use super::super::Wide;
    use super::*;

    type Number = Wide<40>;

    /// The derivative at `at` by a central difference of order 2 in 40 digits, exact to f64.
    fn difference(function: impl Fn(&Number) -> Number, at: f64) -> f64 {
        let (at, step) = (Number::from_f64(at), Number::from_f64(1e-15));
        let rise = function(&(at.clone() + step.clone())) - function(&(at - step.clone()));
        (rise / (step.clone() + step)).to_f64()
    }

    /// Dual part in f64, difference in 40 digits and derivative by hand agree at every point.
    fn agree(
        dual: impl Fn(&Dual<f64>) -> Dual<f64>,
        wide: impl Fn(&Number) -> Number,
        hand: impl Fn(f64) -> f64,
        points: &[f64],
    ) {
        for &at in points {
            let slope = dual(&seeded(at)).eps;
            let scale = slope.abs().max(1e-300);
            assert!(
                (slope - difference(&wide, at)).abs() < 1e-13 * scale,
                "difference at {at}"
            );
            assert!((slope - hand(at)).abs() < 1e-13 * scale, "by hand at {at}");
            assert_eq!(
                dual(&Dual::from_re(at)).eps.abs(),
                0.0,
                "a constant has no slope, at {at}"
            );
        }
    }

    #[test]
    fn the_root_has_the_slope_of_half_its_reciprocal() {
        let points = [1e-6, 0.3, 1.0, 2.0, 1e12];
        agree(Analytic::sqrt, Analytic::sqrt, |x| 0.5 / x.sqrt(), &points);
    }

    #[test]
    fn sine_and_cosine_have_each_other_as_slopes() {
        let points = [-7.0, -1.0, 0.25, 1.0, 2.0, 3.0, 40.0];
        agree(|x| x.sincos().0, |x| x.sincos().0, f64::cos, &points);
        agree(|x| x.sincos().1, |x| x.sincos().1, |x| -x.sin(), &points);
    }

    #[test]
    fn the_arc_cosine_keeps_its_slope_close_to_the_ends() {
        let hand = |x: f64| -1.0 / ((1.0 - x) * (1.0 + x)).sqrt();
        let points = [-0.999_999, -0.5, 0.0, 0.122, 0.9, 0.999_999];
        agree(Analytic::acos, Analytic::acos, hand, &points);
    }

    #[test]
    fn the_angle_has_its_slope_in_every_quadrant_and_in_both_arguments() {
        let points = [-3.0, -0.2, 0.2, 3.0];
        for other in [-2.0_f64, -0.5, 0.5, 2.0] {
            let square = |x: f64| x * x + other * other;
            let (dual, wide) = (Dual::from_re(other), Number::from_f64(other));
            agree(
                |y| Analytic::atan2(y, &dual),
                |y| Analytic::atan2(y, &wide),
                |y| other / square(y),
                &points,
            );
            agree(
                |x| Analytic::atan2(&dual, x),
                |x| Analytic::atan2(&wide, x),
                |x| -other / square(x),
                &points,
            );
        }
    }

    #[test]
    fn the_angle_of_huge_and_tiny_points_has_a_finite_slope() {
        let slope = |size: f64| Analytic::atan2(&seeded(size), &Dual::from_re(size)).eps;
        assert!((slope(1e200) * 2e200 - 1.0).abs() < 1e-15);
        assert!((slope(1e-200) * 2e-200 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_real_power_has_a_slope_in_base_and_exponent() {
        let points = [0.2, 1.0, 2.6, 11.0];
        let (dual, wide) = (Dual::from_re(2.5), Number::from_f64(2.5));
        let by_base = |x: f64| 2.5 * x.powf(1.5);
        agree(
            |x| Analytic::powf(x, &dual),
            |x| Analytic::powf(x, &wide),
            by_base,
            &points,
        );
        let by_exponent = |p: f64| 2.5_f64.powf(p) * 2.5_f64.ln();
        agree(
            |p| Analytic::powf(&dual, p),
            |p| Analytic::powf(&wide, p),
            by_exponent,
            &points,
        );
    }

    #[test]
    fn a_power_of_zero_has_a_slope_that_is_a_number() {
        let slope = Analytic::powf(&seeded(0.0_f64), &Dual::from_re(2.5)).eps;
        assert_eq!(slope, 0.0);
    }

    #[test]
    fn nested_duals_give_second_derivatives() {
        let x = Dual::new(seeded(0.7_f64), Dual::from_re(1.0));
        let second = |y: Dual<Dual<f64>>| y.eps.eps;
        assert!((second(x.sincos().0) + 0.7_f64.sin()).abs() < 1e-15);
        assert!((second(Analytic::sqrt(&x)) + 0.25 * 0.7_f64.powf(-1.5)).abs() < 1e-15);
        let by_hand = -0.7 / (1.0 - 0.49_f64).powf(1.5);
        assert!((second(Analytic::acos(&x)) - by_hand).abs() < 1e-14);
        assert_eq!(x.constant().re.eps, 0.0);
        assert_eq!(x.constant().eps.re, 0.0);
    }

    #[test]
    fn over_a_wide_number_the_slope_has_all_its_digits() {
        let x = seeded(Number::from_ratio(1, 3));
        let identity = |slope: Number, by_hand: Number| (slope - by_hand).to_f64().abs();
        let root = Analytic::sqrt(&x);
        let half = Number::from_ratio(1, 2);
        assert!(identity(root.eps, half / Analytic::sqrt(&x.re)) < 1e-40);
        let (sin, cos) = x.sincos();
        assert!(identity(sin.eps, cos.re.clone()) < 1e-40);
        assert!(identity(cos.eps, -sin.re) < 1e-40);
    }
}
