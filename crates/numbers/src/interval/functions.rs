//! The functions of intervals: as narrow as the values at the ends and the extremes between them allow.

use super::{Interval, greatest, least};
use crate::{Analytic, Endpoint};

/// The sign of a result of one operation: -1 or 1, and 0 where rounding leaves it open.
fn certain_sign<E: Endpoint>(value: &E) -> i8 {
    if value.below() > E::zero() {
        1
    } else if value.above() < E::zero() {
        -1
    } else {
        0
    }
}

/// `value`, and 0 without a sign for what is not above 0: the angle of a negative zero is -pi.
fn positive<E: Endpoint>(value: &E) -> E {
    if *value > E::zero() { value.clone() } else { E::zero() }
}

impl<E: Endpoint> Interval<E> {
    /// The angles over numbers `x` for ordinates that are not below 0.
    fn angle_above(&self, x: &Self) -> Self {
        // in the upper half plane the angle falls with x, and rises with y to the right of the axis
        let (low, high) = (positive(&self.low), positive(&self.high));
        let first = if x.high >= E::zero() { &low } else { &high };
        let last = if x.low >= E::zero() { &high } else { &low };
        let from = first.bounded_atan2(&x.high);
        let to = last.bounded_atan2(&x.low);
        let from = if from.is_zero() { from } else { from.below() };
        Self::bounded(greatest(from, E::zero()), to.above())
    }

    /// Sine and cosine by the signs of the slopes at the ends, which say what lies between them as long as two
    /// zeros of a slope do not: below a width of 3. Wider ones in halves, down to the fourth part of a turn.
    fn sincos_in_parts(&self, depth: u8) -> (Self, Self) {
        let unit = || Self::new(-E::one(), E::one());
        if !self.is_finite() || depth == 0 {
            return (unit(), unit());
        }
        let width = self.width();
        if width < E::from_integer(3) {
            return self.sincos_narrow();
        }
        if width >= E::from_integer(7) {
            return (unit(), unit());
        }
        let (left, right) = self.halves();
        let (left, right) = (left.sincos_in_parts(depth - 1), right.sincos_in_parts(depth - 1));
        (left.0.hull(&right.0), left.1.hull(&right.1))
    }

    #[inline]
    fn sincos_narrow(&self) -> (Self, Self) {
        let (sin_low, cos_low) = self.low.bounded_sincos();
        if self.low == self.high {
            return (Self::clipped(&sin_low, &sin_low), Self::clipped(&cos_low, &cos_low));
        }
        let (sin_high, cos_high) = self.high.bounded_sincos();
        let (from_sin, to_sin) = (certain_sign(&sin_low), certain_sign(&sin_high));
        let (from_cos, to_cos) = (certain_sign(&cos_low), certain_sign(&cos_high));
        let mut sin = Self::clipped(&least(sin_low.clone(), sin_high.clone()), &greatest(sin_low, sin_high));
        let mut cos = Self::clipped(&least(cos_low.clone(), cos_high.clone()), &greatest(cos_low, cos_high));
        // sin' = cos and cos' = -sin
        sin.reach((from_cos, to_cos), (from_sin, to_sin));
        cos.reach((-from_sin, -to_sin), (from_cos, to_cos));
        (sin, cos)
    }

    /// The values of sine or cosine from `low` to `high`, rounded outward within [-1, 1]; 0 only at 0.
    #[inline]
    fn clipped(low: &E, high: &E) -> Self {
        let one = E::one();
        let from = if low.is_zero() { low.clone() } else { low.below() };
        let to = if high.is_zero() { high.clone() } else { high.above() };
        Self::bounded(greatest(from, -one.clone()), least(to, one))
    }

    /// Extended by the extremes that the signs of the slope at both ends show to be inside. Where a sign is open
    /// the extreme may be at that end, and the sign of the value there says which.
    #[inline]
    fn reach(&mut self, slopes: (i8, i8), values: (i8, i8)) {
        if slopes.0 == slopes.1 && slopes.0 != 0 {
            return;
        }
        let one = E::one();
        let top =
            (slopes.0 > 0 && slopes.1 < 0) || (slopes.0 == 0 && values.0 >= 0) || (slopes.1 == 0 && values.1 >= 0);
        let bottom =
            (slopes.0 < 0 && slopes.1 > 0) || (slopes.0 == 0 && values.0 <= 0) || (slopes.1 == 0 && values.1 <= 0);
        if top {
            self.high = one.clone();
        }
        if bottom {
            self.low = -one;
        }
    }
}

impl<E: Endpoint> Analytic for Interval<E> {
    fn pi() -> Self {
        Self::around(&E::pi())
    }

    /// The roots of what is not negative in the interval; the whole line where all is negative.
    #[inline]
    fn sqrt(&self) -> Self {
        if self.is_negative() {
            return Self::whole();
        }
        let high = Analytic::sqrt(&self.high);
        let high = if high.is_zero() { high } else { high.above() };
        if self.is_positive() {
            Self::bounded(Analytic::sqrt(&self.low).below(), high)
        } else {
            Self::bounded(E::zero(), high)
        }
    }

    /// As narrow as the values at the ends and the extremes between them allow, for angles of any size; [-1, 1]
    /// for a width of a whole turn.
    #[inline]
    fn sincos(&self) -> (Self, Self) {
        self.sincos_in_parts(4)
    }

    /// The arc cosines of what is in [-1, 1]; the whole line where nothing is.
    fn acos(&self) -> Self {
        let one = E::one();
        if self.low > one || self.high < -one.clone() {
            return Self::whole();
        }
        let (low, high) = if self.is_whole() {
            (-one.clone(), one)
        } else {
            (greatest(self.low(), -one.clone()), least(self.high(), one))
        };
        let (from, to) = (high.bounded_acos(), low.bounded_acos());
        let to = if to.is_zero() { to } else { to.above() };
        Self::bounded(greatest(from.below(), E::zero()), to)
    }

    /// All angles, in (-pi, pi], where 0 has no sign; that whole range where the box holds the origin or crosses the
    /// negative axis.
    fn atan2(&self, x: &Self) -> Self {
        let (zero, pi) = (E::zero(), E::pi().above());
        let crosses = self.low < zero && self.high >= zero && !x.is_positive();
        let origin = self.contains_zero() && x.contains_zero();
        if crosses || origin || self.is_whole() || x.is_whole() {
            return Self::bounded(-pi.clone(), pi);
        }
        if self.low >= zero {
            return self.angle_above(x);
        }
        if self.high < zero {
            return -(-self.clone()).angle_above(x);
        }
        let right = |y: &E| Self::around(&y.bounded_atan2(&x.low));
        right(&self.low).hull(&right(&self.high))
    }

    /// The whole line where the base is not known to be 0 or more.
    fn powf(&self, exponent: &Self) -> Self {
        let defined = self.low >= E::zero();
        if !defined || exponent.is_whole() {
            return Self::whole();
        }
        // exponent times logarithm is largest and least at corners; one ulp more than the bound, since few
        // implementations of this function are proved
        let corner = |base: &E, exponent: &E| {
            let power = base.bounded_powf(exponent);
            Self::new(greatest(power.below().below(), E::zero()), power.above().above())
        };
        let (low, high) = (positive(&self.low), positive(&self.high));
        let mut all = corner(&low, &exponent.low).hull(&corner(&high, &exponent.low));
        if exponent.low != exponent.high {
            all = all.hull(&corner(&low, &exponent.high));
            all = all.hull(&corner(&high, &exponent.high));
        }
        all
    }

    /// The number itself; around it where `E` is narrower than f64.
    fn from_f64(value: f64) -> Self {
        let nearest = E::from_f64(value);
        if !nearest.is_finite() || nearest.to_f64() == value {
            return Self::point(nearest);
        }
        Self::around(&nearest)
    }

    /// The nearest f64 to the midpoint.
    fn to_f64(&self) -> f64 {
        self.midpoint().to_f64()
    }

    fn unit() -> Self {
        Self::bounded(-E::one(), E::one())
    }

    fn epsilon() -> Self {
        Self::point(<E as Analytic>::epsilon())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    type Line = Interval<f64>;

    fn between(low: f64, high: f64) -> Line {
        Line::new(low, high)
    }

    #[test]
    fn sine_and_cosine_are_as_narrow_as_the_extremes_inside_allow() {
        let near = |a: Line, low: f64, high: f64| (a.low() - low).abs() < 1e-15 && (a.high() - high).abs() < 1e-15;
        let sin = |low: f64, high: f64| between(low, high).sincos().0;
        let cos = |low: f64, high: f64| between(low, high).sincos().1;
        assert!(near(sin(0.0, 1.0), 0.0, 1.0_f64.sin()) && near(cos(0.0, 1.0), 1.0_f64.cos(), 1.0));
        assert!(near(sin(1.0, 2.0), 1.0_f64.sin(), 1.0) && near(cos(-1.0, 0.5), 1.0_f64.cos(), 1.0));
        assert!(near(sin(-2.0, -1.0), -1.0, -(1.0_f64.sin())) && near(cos(3.0, 3.5), -1.0, 3.5_f64.cos()));
        assert!(near(sin(1.0, 5.5), -1.0, 1.0) && near(sin(1.7, 7.8), -1.0, 7.8_f64.sin()));
        assert!(near(sin(0.0, 6.5), -1.0, 1.0));
        let top = FRAC_PI_2.next_down();
        assert_eq!(sin(top.next_down(), top).high(), 1.0);
        let huge = 6381956970095103.0 * 2.0_f64.powi(797);
        assert!(cos(huge, huge).width() < 1e-33 && sin(huge, huge).high() == 1.0);
        assert!(near(sin(huge, huge.next_up()), -1.0, 1.0));
        assert!(cos(1e22, 1e22).contains(&0.5232147853951389));
    }

    #[test]
    fn arc_cosine_and_root_leave_out_what_is_outside_their_domain() {
        assert!(between(1.5, 2.0).acos().is_whole() && between(-2.0, -1.0).sqrt().is_whole());
        assert_eq!(between(1.0, 2.0).acos(), Line::point(0.0));
        let all = between(-3.0, 3.0).acos();
        assert!(all.low() == 0.0 && all.high() == PI.next_up());
        assert_eq!(between(-1.0, 0.0).sqrt(), Line::point(0.0));
        assert!(between(-1.0, 4.0).sqrt().contains(&2.0) && between(-1.0, 4.0).sqrt().low() == 0.0);
    }

    #[test]
    fn the_angle_is_right_in_every_quadrant_and_whole_across_the_cut() {
        let angle = |y: (f64, f64), x: (f64, f64)| Analytic::atan2(&between(y.0, y.1), &between(x.0, x.1));
        for (y, x) in [
            ((1.0, 2.0), (1.0, 3.0)),
            ((1.0, 2.0), (-1.0, 3.0)),
            ((1.0, 2.0), (-4.0, -3.0)),
            ((-2.0, -1.0), (-4.0, -3.0)),
            ((-2.0, -1.0), (-4.0, 3.0)),
            ((-2.0, 1.0), (1.0, 3.0)),
            ((0.0, 1.0), (-2.0, -1.0)),
        ] {
            let found = angle(y, x);
            let corners = [y.0.atan2(x.0), y.0.atan2(x.1), y.1.atan2(x.0), y.1.atan2(x.1)];
            let low = corners.into_iter().fold(f64::INFINITY, f64::min);
            let high = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
            assert!(found.low() <= low && found.high() >= high, "{found}");
            assert!(low - found.low() < 1e-15 && found.high() - high < 1e-15, "{found}");
        }
        for (y, x) in [
            ((-1.0, 1.0), (-2.0, -1.0)),
            ((0.0, 1.0), (-1.0, 1.0)),
            ((-1.0, 0.0), (-2.0, -1.0)),
        ] {
            assert!(angle(y, x).low() <= -PI && angle(y, x).high() > PI);
        }
    }
}
