//! Intervals inside num-dual's dual numbers: derivatives that are enclosed as well.
//!
//! Rigorous in `Dual<Interval<_>>` through our own traits: the four operations, integer powers, root, sine and cosine,
//! arc cosine, angle and power; and of `DualNum`'s own methods on an interval itself also exponential, logarithm,
//! tangent, arc sine, arc tangent and size. **Not offered** are the others (cube root, powers and logarithms of 2 and
//! 10, hyperbolic functions, remainder): they give the whole line. num-dual's own derivatives of those, of `abs` and of
//! the spherical Bessel functions rest on constants of 53 bits or on comparisons and are not rigorous.

use super::Interval;
use crate::derivable::Elementary;
use crate::{Analytic, Endpoint, Field};
use std::cmp::Ordering;
use std::fmt;
use std::ops::Rem;

/// Only where it holds for all numbers of both: intervals that share more than an end have no order, and equal
/// ones are equal.
impl<E: Endpoint> PartialOrd for Interval<E> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        if self == other {
            Some(Ordering::Equal)
        } else if self.high < other.low {
            Some(Ordering::Less)
        } else if self.low > other.high {
            Some(Ordering::Greater)
        } else {
            None
        }
    }
}

impl<E: Endpoint> Rem for Interval<E> {
    type Output = Self;
    /// Not offered: the whole line.
    fn rem(self, _: Self) -> Self {
        Self::whole()
    }
}

impl<E: Endpoint + fmt::Display> num_traits::Signed for Interval<E> {
    /// All sizes; around 0 they begin at 0.
    fn abs(&self) -> Self {
        self.size()
    }
    fn abs_sub(&self, other: &Self) -> Self {
        let above = self.clone() - other.clone();
        above.size().hull(&<Self as num_traits::Zero>::zero())
    }
    /// From -1 to 1 where the sign is open.
    fn signum(&self) -> Self {
        let one = <Self as num_traits::One>::one();
        if self.is_positive() {
            one
        } else if self.is_negative() {
            -one
        } else {
            one.hull(&-one.clone())
        }
    }
    fn is_positive(&self) -> bool {
        Self::is_positive(self)
    }
    fn is_negative(&self) -> bool {
        Self::is_negative(self)
    }
}

derivable!([E: Endpoint + fmt::Display] Interval<E>, own signs and assigning);

impl<E: Endpoint> Interval<E> {
    pub(crate) fn elementary(&self, function: Elementary) -> Self {
        let one = <Self as num_traits::One>::one();
        match function {
            Elementary::Exp => {
                let low = self.low.bounded_exp().below();
                Self::new(super::greatest(low, E::zero()), self.high.bounded_exp().above())
            }
            Elementary::Ln if self.is_positive() => {
                Self::new(self.low.bounded_ln().below(), self.high.bounded_ln().above())
            }
            Elementary::Tan => {
                let (sin, cos) = self.sincos();
                sin / cos
            }
            Elementary::Asin if !self.acos().is_whole() => Self::pi() / Self::from_integer(2) - self.acos(),
            Elementary::Atan => Analytic::atan2(self, &one),
            _ => Self::whole(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DoubleDouble, Dual, Wide, seeded};
    use num_dual::DualNum;
    use num_traits::Signed;

    type Line = Interval<f64>;

    #[test]
    fn functions_that_are_not_rigorous_give_the_whole_line() {
        let x = Line::new(1.0, 2.0);
        let none = [
            x.cbrt(),
            x.exp2(),
            x.log10(),
            x.log2(),
            x.sinh(),
            x.acosh(),
            x % x,
            (-x).ln(),
            (x + x).asin(),
        ];
        assert!(none.iter().all(Line::is_whole));
    }

    #[test]
    fn sizes_and_signs_around_zero_claim_no_sign() {
        let x = Line::new(-1.0, 2.0);
        assert_eq!(Signed::abs(&x), Line::new(0.0, 2.0));
        assert_eq!(Signed::signum(&x), Line::new(-1.0, 1.0));
        assert!(Signed::abs_sub(&x, &x).contains(&3.0) && Signed::abs_sub(&x, &x).contains(&0.0));
        assert!(!Signed::is_positive(&x) && !Signed::is_negative(&x));
    }

    #[test]
    fn only_what_holds_for_all_numbers_is_an_order() {
        let [a, b, c] = [(0.0, 1.0), (1.0, 2.0), (1.5, 3.0)].map(|(low, high)| Line::new(low, high));
        assert!(a < c && a.partial_cmp(&b).is_none() && b.partial_cmp(&c).is_none());
        assert!(a < 1.5 && a.partial_cmp(&0.5).is_none());
    }

    #[test]
    fn functions_of_an_interval_hold_those_of_its_numbers() {
        let x = Line::new(0.25, 0.5);
        for at in [0.25, 0.3, 0.5] {
            let exact = Wide::<40>::from_f64(at);
            for (all, one) in [
                (x.exp(), exact.exp()),
                (x.ln(), exact.ln()),
                (x.tan(), exact.tan()),
                (x.asin(), exact.asin()),
                (x.atan(), exact.atan()),
            ] {
                assert!(all.contains(&one.to_f64()) && all.width() < 0.75, "{all} {one}");
            }
        }
    }

    /// All that is rigorous in dual numbers, in one formula.
    fn formula<T: Analytic>(x: &T) -> T {
        let (sin, cos) = (x.clone() * T::from_integer(3)).sincos();
        let angle = Analytic::atan2(&sin, x) + Analytic::acos(&(cos.clone() * T::from_ratio(1, 2)));
        let power = Analytic::powf(x, &(T::from_ratio(5, 2) + x.clone()));
        Analytic::sqrt(&(angle * power + T::one())) / (cos + T::from_integer(2)) - sin.to_power(2)
    }

    #[test]
    fn derivatives_of_intervals_enclose_those_of_their_numbers() {
        let exact = formula(&seeded(Wide::<60>::from_ratio(4, 5)));
        let narrow: Dual<Line> = formula(&seeded(Line::from_ratio(4, 5)));
        let bits = |x: f64| Wide::<60>::from_f64(x);
        for (part, exact) in [(narrow.re, &exact.re), (narrow.eps, &exact.eps)] {
            assert!(
                bits(part.low()) <= *exact && *exact <= bits(part.high()) && part.width() < 1e-12,
                "{part}"
            );
        }
        let double: Dual<Interval<DoubleDouble>> = formula(&seeded(Interval::from_ratio(4, 5)));
        for (part, exact) in [(double.re, &exact.re), (double.eps, &exact.eps)] {
            let (low, high) = (part.low().to_wide::<60>(), part.high().to_wide::<60>());
            assert!(
                low <= *exact && *exact <= high && (high - low).to_f64() < 1e-26,
                "{part}"
            );
        }
        let broad: Dual<Line> = formula(&seeded(Line::new(0.79, 0.81)));
        assert!(narrow.re.is_inside(&broad.re) && narrow.eps.is_inside(&broad.eps));
    }
}
