//! The floating-point numbers of the machine.

use super::{Analytic, Field};

macro_rules! real {
    ($float:ident) => {
        impl Field for $float {
            fn from_integer(value: i64) -> Self {
                value as $float
            }
        }

        impl Analytic for $float {
            fn pi() -> Self {
                std::$float::consts::PI
            }
            fn sqrt(&self) -> Self {
                $float::sqrt(*self)
            }
            fn sincos(&self) -> (Self, Self) {
                $float::sin_cos(*self)
            }
            fn acos(&self) -> Self {
                $float::acos(*self)
            }
            fn atan2(&self, x: &Self) -> Self {
                $float::atan2(*self, *x)
            }
            fn powf(&self, exponent: &Self) -> Self {
                $float::powf(*self, *exponent)
            }
            fn from_f64(value: f64) -> Self {
                value as $float
            }
            fn to_f64(&self) -> f64 {
                f64::from(*self)
            }
            fn epsilon() -> Self {
                $float::EPSILON
            }
        }
    };
}
real!(f32);
real!(f64);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_are_exact_where_the_type_holds_them_and_rounded_once_beyond() {
        assert_eq!(f64::from_integer(1 << 53), 9_007_199_254_740_992.0);
        assert_eq!(f32::from_integer(16_777_217), 16_777_216.0);
        assert_eq!(f64::from_ratio(1, 3), 1.0 / 3.0);
    }

    #[test]
    fn outside_its_domain_a_function_is_not_a_number() {
        assert!(Analytic::sqrt(&-1.0_f64).is_nan());
        assert!(Analytic::acos(&1.5_f32).is_nan());
        assert!(Analytic::sincos(&f64::INFINITY).0.is_nan());
    }

    #[test]
    fn an_integer_power_is_the_repeated_product() {
        assert_eq!(Field::to_power(&3.0_f64, 5), 243.0);
        assert_eq!(Field::to_power(&2.0_f64, -3), 0.125);
        assert_eq!(Field::to_power(&0.0_f64, 0), 1.0);
    }

    /// A number that has only what the trait asks for, so that Kahan's formula itself is run.
    #[test]
    fn kahans_formula_finds_the_epsilon_of_both_floats() {
        let third = 4.0_f64 / 3.0 - 1.0;
        assert_eq!((3.0 * third - 1.0).abs(), <f64 as Analytic>::epsilon());
        let third = 4.0_f32 / 3.0 - 1.0;
        assert_eq!((3.0 * third - 1.0).abs(), <f32 as Analytic>::epsilon());
    }
}
