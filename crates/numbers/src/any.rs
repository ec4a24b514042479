//! A number whose type is chosen when the program runs: one copy of a computation counts its operations in every type.

use super::derivable::Elementary;
use super::{Analytic, Digits, DoubleDouble, Endpoint, Field, Machine, Rung, Wide, at_digits};
use num_dual::DualNum;
use std::cell::Cell;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Rem, Sub};

thread_local! {
    /// The type of the constants made on this thread.
    static SET: Cell<Rung> = const { Cell::new(Rung::Double) };
}

/// A number of one of the types of [`Rung`]. Its values are those of that type, bit for bit.
///
/// Operands of one operation are of one type, that of the [`of_type`] they are computed under; numbers of two types
/// give the invalid number.
#[derive(Clone, Debug)]
pub enum Any {
    /// f32
    Single(f32),
    /// f64
    Double(f64),
    /// [`DoubleDouble`]
    DoubleDouble(DoubleDouble),
    /// [`Wide`](super::Wide)
    Wide(Digits),
}

/// The computation with [`Any`] of this type, on this thread. May be nested.
pub fn of_type<R>(rung: Rung, computation: impl FnOnce() -> R) -> R {
    /// Puts back what was set before, after a panic as well.
    struct Before(Rung);
    impl Drop for Before {
        fn drop(&mut self) {
            SET.set(self.0);
        }
    }
    let _before = Before(SET.replace(rung));
    match rung {
        Rung::Wide(digits) => at_digits(digits, computation),
        _ => computation(),
    }
}

/// A constant of the type that is set.
macro_rules! constant {
    ($method:path $(, $argument:expr)*) => {{
        fn made<T: Analytic + Endpoint>(function: impl Fn() -> T) -> T {
            function()
        }
        match SET.get() {
            Rung::Single => Any::Single(made::<f32>(|| $method($($argument),*))),
            Rung::Double => Any::Double(made::<f64>(|| $method($($argument),*))),
            Rung::DoubleDouble => Any::DoubleDouble(made::<DoubleDouble>(|| $method($($argument),*))),
            Rung::Wide(_) => Any::Wide(made::<Digits>(|| $method($($argument),*))),
        }
    }};
}

/// What a function of one number gives, in its own type.
macro_rules! mapped {
    ($number:expr, $x:ident => $value:expr) => {
        match $number {
            Any::Single($x) => Any::Single($value),
            Any::Double($x) => Any::Double($value),
            Any::DoubleDouble($x) => Any::DoubleDouble($value),
            Any::Wide($x) => Any::Wide($value),
        }
    };
}

/// What a function of one number gives, in a type that does not depend on it.
macro_rules! told {
    ($number:expr, $x:ident => $value:expr) => {
        match $number {
            Any::Single($x) => $value,
            Any::Double($x) => $value,
            Any::DoubleDouble($x) => $value,
            Any::Wide($x) => $value,
        }
    };
}

/// What a function of two numbers gives.
macro_rules! joined {
    ($one:expr, $other:expr, $x:ident, $y:ident => $value:expr) => {
        match ($one, $other) {
            (Any::Single($x), Any::Single($y)) => Any::Single($value),
            (Any::Double($x), Any::Double($y)) => Any::Double($value),
            (Any::DoubleDouble($x), Any::DoubleDouble($y)) => Any::DoubleDouble($value),
            (Any::Wide($x), Any::Wide($y)) => Any::Wide($value),
            _ => Any::Wide(Digits::INVALID),
        }
    };
}

/// A pair of functions of one number.
macro_rules! paired {
    ($number:expr, $x:ident => $value:expr) => {{
        fn both<T>((one, other): (T, T), of: impl Fn(T) -> Any) -> (Any, Any) {
            (of(one), of(other))
        }
        match $number {
            Any::Single($x) => both($value, Any::Single),
            Any::Double($x) => both($value, Any::Double),
            Any::DoubleDouble($x) => both($value, Any::DoubleDouble),
            Any::Wide($x) => both($value, Any::Wide),
        }
    }};
}

impl fmt::Display for Any {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        told!(self, x => x.fmt(f))
    }
}

impl PartialEq for Any {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(std::cmp::Ordering::Equal)
    }
}

impl PartialOrd for Any {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        match (self, other) {
            (Self::Single(x), Self::Single(y)) => x.partial_cmp(y),
            (Self::Double(x), Self::Double(y)) => x.partial_cmp(y),
            (Self::DoubleDouble(x), Self::DoubleDouble(y)) => x.partial_cmp(y),
            (Self::Wide(x), Self::Wide(y)) => x.partial_cmp(y),
            _ => None,
        }
    }
}

macro_rules! operation {
    ($trait:ident, $method:ident) => {
        impl $trait for Any {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                joined!(self, other, x, y => $trait::$method(x, y))
            }
        }
    };
}
operation!(Add, add);
operation!(Sub, sub);
operation!(Mul, mul);
operation!(Div, div);
operation!(Rem, rem);

impl Neg for Any {
    type Output = Self;
    fn neg(self) -> Self {
        mapped!(self, x => -x)
    }
}

impl num_traits::Zero for Any {
    fn zero() -> Self {
        constant!(Field::from_integer, 0)
    }
    fn is_zero(&self) -> bool {
        told!(self, x => num_traits::Zero::is_zero(x))
    }
}

impl num_traits::One for Any {
    fn one() -> Self {
        constant!(Field::from_integer, 1)
    }
}

impl Field for Any {
    fn from_integer(value: i64) -> Self {
        constant!(Field::from_integer, value)
    }
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        constant!(Field::from_ratio, numerator, denominator)
    }
}

derivable!([] Any);

impl Any {
    pub(crate) fn elementary(&self, function: Elementary) -> Self {
        mapped!(self, x => match function {
            Elementary::Cbrt => DualNum::cbrt(x),
            Elementary::Exp => DualNum::exp(x),
            Elementary::Exp2 => DualNum::exp2(x),
            Elementary::ExpM1 => DualNum::exp_m1(x),
            Elementary::Ln => DualNum::ln(x),
            Elementary::Log2 => DualNum::log2(x),
            Elementary::Log10 => DualNum::log10(x),
            Elementary::Ln1p => DualNum::ln_1p(x),
            Elementary::Tan => DualNum::tan(x),
            Elementary::Asin => DualNum::asin(x),
            Elementary::Atan => DualNum::atan(x),
            Elementary::Sinh => DualNum::sinh(x),
            Elementary::Cosh => DualNum::cosh(x),
            Elementary::Tanh => DualNum::tanh(x),
            Elementary::Asinh => DualNum::asinh(x),
            Elementary::Acosh => DualNum::acosh(x),
            Elementary::Atanh => DualNum::atanh(x),
        })
    }
}

impl Analytic for Any {
    fn pi() -> Self {
        constant!(Analytic::pi)
    }
    fn sqrt(&self) -> Self {
        mapped!(self, x => Analytic::sqrt(x))
    }
    fn sincos(&self) -> (Self, Self) {
        paired!(self, x => x.sincos())
    }
    fn acos(&self) -> Self {
        mapped!(self, x => Analytic::acos(x))
    }
    fn atan2(&self, x: &Self) -> Self {
        joined!(self, x, y, x => Analytic::atan2(y, x))
    }
    fn powf(&self, exponent: &Self) -> Self {
        joined!(self, exponent, x, y => Analytic::powf(x, y))
    }
    fn from_f64(value: f64) -> Self {
        constant!(Analytic::from_f64, value)
    }
    fn to_f64(&self) -> f64 {
        told!(self, x => Analytic::to_f64(x))
    }
    fn epsilon() -> Self {
        constant!(Analytic::epsilon)
    }
}

impl Endpoint for Any {
    // only one type has none, and there the half line is the whole line too
    const INFINITE: bool = false;

    fn below(&self) -> Self {
        mapped!(self, x => x.below())
    }
    fn above(&self) -> Self {
        mapped!(self, x => x.above())
    }
    fn lowest() -> Self {
        constant!(Endpoint::lowest)
    }
    fn highest() -> Self {
        constant!(Endpoint::highest)
    }
    fn is_finite(&self) -> bool {
        told!(self, x => Endpoint::is_finite(x))
    }
    fn rung() -> Rung {
        SET.get()
    }
    fn bounded_sincos(&self) -> (Self, Self) {
        paired!(self, x => x.bounded_sincos())
    }
    fn bounded_acos(&self) -> Self {
        mapped!(self, x => x.bounded_acos())
    }
    fn bounded_atan2(&self, x: &Self) -> Self {
        joined!(self, x, y, x => y.bounded_atan2(x))
    }
    fn bounded_powf(&self, exponent: &Self) -> Self {
        joined!(self, exponent, x, y => x.bounded_powf(y))
    }
    fn bounded_exp(&self) -> Self {
        mapped!(self, x => x.bounded_exp())
    }
    fn bounded_ln(&self) -> Self {
        mapped!(self, x => x.bounded_ln())
    }
}

impl Machine for Any {
    fn to_wide<const DIGITS: usize>(&self) -> Wide<DIGITS> {
        told!(self, x => Machine::to_wide(x))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Counted;
    use super::*;

    fn formula<T: Analytic>() -> T {
        let x = T::from_ratio(1, 3);
        let (sin, cos) = x.sincos();
        (sin * T::pi() + Analytic::sqrt(&x)) / Analytic::atan2(&cos, &x) - Field::to_power(&x, 3)
    }

    #[test]
    fn values_are_those_of_the_type_that_is_set() {
        let told = |rung| of_type(rung, || formula::<Any>().to_string());
        assert_eq!(told(Rung::Single), formula::<f32>().to_string());
        assert_eq!(told(Rung::Double), formula::<f64>().to_string());
        assert_eq!(told(Rung::DoubleDouble), formula::<DoubleDouble>().to_string());
        assert_eq!(told(Rung::Wide(50)), formula::<Wide<50>>().to_string());
        let counted = of_type(Rung::DoubleDouble, || formula::<Counted<Any>>().to_string());
        assert_eq!(counted, formula::<DoubleDouble>().to_string());
    }

    #[test]
    fn numbers_of_two_types_have_no_sum() {
        let one = |rung| of_type(rung, || Any::from_f64(1.0));
        let (single, double) = (one(Rung::Single), one(Rung::Double));
        assert!((single.clone() + double.clone()).to_f64().is_nan() && single != double);
    }
}
